! The idiomatic layer of the module: sizes that it finds out, optional arguments, results.
program layer
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp) :: k(4, 4), f(4), gap(2), mu(2), d(4), force(4), other(4), z(4), u(8), wide(8, 8)
    integer :: info, state(2), failed
    type(signorini_report) :: report
    type(contact_model) :: model
    character(len=256) :: message

    failed = 0
    k = reshape([real(dp) :: 4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4], [4, 4])
    f = [2._dp, 1.5_dp, 3._dp, 0.5_dp]
    gap = 0
    mu = 0.3_dp

    call expect('version', signorini_library_abi_version() == SIGNORINI_ABI_VERSION)
    call contact_solve(k, f, gap, d, force, info, friction=mu, state=state, report=report, message=message)
    ! The numbers of the README.
    call expect('solve', info == 0 .and. message == '')
    call expect('states', all(state == [SIGNORINI_STATE_SLIP, SIGNORINI_STATE_STICK]))
    call expect('forces', all(abs(force - [-1.7568_dp, -0.5270_dp, -3._dp, -0.7432_dp]) < 1e-4_dp))
    call expect('report', report%eta <= 1e-10_dp .and. report%pairs_open == 0 .and. &
        report%pairs_slipping == 1 .and. report%pairs_sticking == 1)
    call contact_certify(k, f, gap, d, info, friction=mu, force=other, state=state, report=report)
    call expect('certificate', info == SIGNORINI_STATUS_SOLVED .and. all(abs(other - force) < 1e-9_dp))
    call expect('its states', all(state == [SIGNORINI_STATE_SLIP, SIGNORINI_STATE_STICK]))
    call contact_certify(k, f, gap, d + 1e-3_dp, info, friction=mu, message=message)
    call expect('no solution', info == SIGNORINI_STATUS_NOT_A_SOLUTION .and. message /= '')

    call contact_prove(k, f, gap, d, info, friction=mu, state=state, force=other, radius_d=z, message=message)
    call expect('proof', info == SIGNORINI_STATUS_SOLVED .and. all(abs(other - force) < 1e-12_dp))
    call expect('its radius', all(z >= 0 .and. z < 1e-14_dp) .and. message == '')
    state(1) = SIGNORINI_STATE_STICK
    call contact_prove(k, f, gap, d, info, friction=mu, state=state, radius_d=z, message=message)
    call expect('no proof', info == SIGNORINI_STATUS_NOT_PROVED .and. all(z < 0) .and. message /= '')
    call contact_prove(k, f, gap, d, info, friction=mu, state=[1, 7], message=message)
    call expect('no state', info == -9 .and. index(message, 'state') > 0)

    ! A part of a larger matrix, and every second entry of an array.
    wide = 0
    wide(1:4, 1:4) = k
    u(1::2) = f
    call contact_solve(wide(1:4, 1:4), u(1::2), gap, other, force, info, friction=mu)
    call expect('sections', info == 0 .and. all(other == d))
    call contact_solve(k, f, gap, other, force, info, friction=mu, slip0=d(2::2), &
        method=int(SIGNORINI_METHOD_SOR_NESTED), tolerance=1e-12_dp)
    call expect('slip0 and method', info == 0)
    call lcp_solve(k, -f, other, z, info)
    call expect('LCP', info == 0 .and. all(abs(matmul(k, z) - f - other) < 1e-9_dp) .and. all(z >= 0))
    call contact_solve(k, f, gap, other, force, info, friction=mu, &
        method=int(SIGNORINI_METHOD_SOR_DIAGONAL), max_iterations=1)
    call expect('limit', info == SIGNORINI_STATUS_ITERATION_LIMIT)

    call laws
    call structures
    call escape
    call second_solution
    call infeasible

    call model%new_condensed(2, k, info)
    call expect('condensed model', info == 0 .and. model%host_size() == 4)
    call model%solve(f, gap, other, force, info, friction=mu, state=state)
    call expect('its case', info == 0 .and. all(abs(other - d) < 1e-9_dp))
    call model%prove(f, gap, d, info, friction=mu, force=other, radius_d=z, message=message)
    call expect('proof of a model', info == SIGNORINI_STATUS_SOLVED .and. all(abs(other - force) < 1e-9_dp) .and. &
        all(z >= 0 .and. z < 1e-8_dp) .and. message == '')
    call model%stiffness(wide(1:4, 1:4), info)
    call expect('its stiffness', info == 0 .and. all(wide(1:4, 1:4) == k))
    call model%new_two_body(2, k, k, info)
    call expect('two bodies', info == 0 .and. model%host_size() == 8)
    call model%solve([f, f], gap, other, force, info, friction=mu)
    call expect('their case', info == 0)
    call model%recover([f, f], other, u, info)
    call expect('their displacements', info == 0 .and. all(abs(u(1:4) + u(5:8) - other) < 1e-9_dp))
    call model%release()
    call expect('released', model%host_size() == -1)
    call oblique
    call flexibility

    if (failed /= 0) stop 1
    print '(a)', 'the layer of the module: all as expected'
contains
    ! One pair under f = (2, 1) on K = (4 1; 1 4), which slips. Without friction 4 d_t = 1, with
    ! mu = 0.3 and the pressure 2 - d_t 4 d_t = 1 - 0.3 (2 - d_t), with the threshold 0.3 4 d_t = 0.7.
    subroutine laws
        real(dp), parameter :: k(2, 2) = reshape([real(dp) :: 4, 1, 1, 4], [2, 2]), f(2) = [2, 1]
        real(dp), parameter :: gap(1) = 0, parameter(1) = 0.3_dp
        real(dp), parameter :: wanted(0:2) = [0.25_dp, 0.4_dp/3.7_dp, 0.175_dp]
        real(dp) :: d(2), force(2), by_model(2)
        type(contact_model) :: model
        integer :: law
        call model%new_condensed(2, k, info)
        do law = int(SIGNORINI_LAW_FRICTIONLESS), int(SIGNORINI_LAW_TRESCA)
            call contact_solve(k, f, gap, d, force, info, law=law, friction=parameter)
            call expect('law', info == 0 .and. abs(d(2) - wanted(law)) < 1e-9_dp)
            call model%solve(f, gap, by_model, force, info, law=law, friction=parameter)
            call expect('law of a model', info == 0 .and. all(abs(by_model - d) < 1e-9_dp))
            call contact_certify(k, f, gap, d, info, law=law, friction=parameter)
            call expect('law of a certificate', info == 0)
            call model%certify(f, gap, d, info, law=law, friction=parameter, force=by_model)
            call expect('certificate of a model', info == 0 .and. all(abs(by_model - force) < 1e-9_dp))
            call model%certify(f, gap, d + [0._dp, 1e-3_dp], info, law=law, friction=parameter)
            call expect('moved away', info == SIGNORINI_STATUS_NOT_A_SOLUTION)
        end do
        call contact_solve(k, f, gap, d, force, info)
        call expect('no law', info == 0 .and. abs(d(2) - wanted(0)) < 1e-9_dp)
        call contact_solve(k, f, gap, d, force, info, friction=parameter)
        call expect('Coulomb', info == 0 .and. abs(d(2) - wanted(1)) < 1e-9_dp)
        call model%release()
        ! With the cohesion 0.2: 4 d_t = 1 - 0.3 (2 - d_t) - 0.2.
        call contact_solve(k, f, gap, d, force, info, law=int(SIGNORINI_LAW_COHESIVE), &
            friction=[0.3_dp, 0.2_dp, 0.1_dp])
        call expect('cohesion', info == 0 .and. abs(d(2) - 0.2_dp/3.7_dp) < 1e-9_dp)
        call contact_solve(k, f, gap, d, force, info, law=int(SIGNORINI_LAW_COHESIVE), friction=parameter)
        call expect('three for each pair', info == -8)
        call contact_solve(k, f, gap, d, force, info, law=int(SIGNORINI_LAW_ORTHOTROPIC), &
            friction=[0.3_dp, 0.2_dp, 0.1_dp])
        call expect('orthotropic in the plane', info == -7)
    end subroutine

    ! A variable as declared is ready to use: it holds the numbers that the library fills in.
    subroutine structures
        type(signorini_settings) :: settings, wanted
        type(signorini_report) :: report, blank
        type(signorini_extra) :: extra, nothing
        type(signorini_sparse) :: sparse
        type(signorini_pairs) :: pairs
        type(signorini_operator) :: operator
        type(signorini_model_data) :: model
        type(signorini_faces) :: faces
        type(signorini_obstacle) :: obstacle
        type(signorini_surface_settings) :: choices
        type(signorini_surface_data) :: surface
        type(signorini_contact_fields) :: fields
        type(signorini_resultant) :: sums
        type(signorini_mesh) :: mesh
        type(signorini_zone) :: zone
        type(signorini_field) :: field
        type(signorini_problem_data) :: problem
        integer(c_int32_t) :: status(3)
        status(1) = signorini_settings_default(wanted, int(c_sizeof(wanted), c_int32_t))
        status(2) = signorini_report_default(blank, int(c_sizeof(blank), c_int32_t))
        status(3) = signorini_extra_default(nothing, int(c_sizeof(nothing), c_int32_t))
        call expect('initialisers', all(status == 0))
        call expect('sizes', settings%struct_size == wanted%struct_size .and. &
            report%struct_size == blank%struct_size .and. extra%struct_size == nothing%struct_size)
        call expect('sizes of what a model is made of', sparse%struct_size == c_sizeof(sparse) .and. &
            pairs%struct_size == c_sizeof(pairs) .and. operator%struct_size == c_sizeof(operator) .and. &
            model%struct_size == c_sizeof(model))
        call expect('sizes of surfaces', faces%struct_size == c_sizeof(faces) .and. &
            obstacle%struct_size == c_sizeof(obstacle) .and. choices%struct_size == c_sizeof(choices) .and. &
            surface%struct_size == c_sizeof(surface) .and. fields%struct_size == c_sizeof(fields) .and. &
            sums%struct_size == c_sizeof(sums))
        call expect('sizes for files', mesh%struct_size == c_sizeof(mesh) .and. &
            zone%struct_size == c_sizeof(zone) .and. field%struct_size == c_sizeof(field) .and. &
            problem%struct_size == c_sizeof(problem))
        call expect('settings', settings%method == wanted%method .and. &
            same(settings%tolerance, wanted%tolerance) .and. same(settings%omega, wanted%omega) .and. &
            same(settings%damping, wanted%damping) .and. settings%max_iterations == wanted%max_iterations)
        call expect('more settings', same(settings%time_limit, wanted%time_limit) .and. &
            settings%warm_start == wanted%warm_start .and. settings%search == wanted%search .and. &
            .not. c_associated(wanted%progress) .and. .not. c_associated(wanted%user))
        call contact_solve(k, f, gap, other, force, info, friction=mu, settings=settings)
        call expect('settings as declared', info == 0 .and. all(other == d))
    end subroutine

    pure logical function same(a, b)
        real(dp), intent(in) :: a, b
        same = .not. (a < b .or. a > b)
    end function

    ! K (1, 1) = 0, and the load pulls the pair off along -(1, 1).
    subroutine escape
        real(dp), parameter :: k(2, 2) = reshape([real(dp) :: 1, -1, -1, 1], [2, 2]), f(2) = -1
        real(dp), parameter :: gap(1) = 0
        real(dp) :: d(2), force(2), motion(2), drawn(2)
        type(contact_model) :: model
        call contact_solve(k, f, gap, d, force, info, motion=motion, message=message, escape=drawn)
        call expect('no equilibrium', info == SIGNORINI_STATUS_NO_EQUILIBRIUM .and. message /= '')
        call expect('motion of escape', all(abs([motion, drawn] + 1) < 1e-12_dp))
        call model%new_condensed(2, k, info)
        call model%solve(f, gap, d, force, info, motion=motion, escape=drawn)
        call expect('motion of a model', info == SIGNORINI_STATUS_NO_EQUILIBRIUM .and. &
            all(abs([motion, drawn] + 1) < 1e-12_dp))
        call model%solve(-f, gap, d, force, info, friction=[2._dp], motion=motion, escape=drawn)
        call expect('no motion', info == 0 .and. maxval(abs([motion, drawn])) <= 0)
        call model%release()
    end subroutine

    ! Klarbring's pair, K = (2 1; 1 1), f = (1, 1.5), mu = 2: it sticks at (0, 0), slips to (0, 0.5) or
    ! opens to (-0.5, 2). A. Klarbring, Ingenieur-Archiv 60 (1990) 529-541.
    subroutine second_solution
        real(dp), parameter :: k(2, 2) = reshape([real(dp) :: 2, 1, 1, 1], [2, 2]), f(2) = [1._dp, 1.5_dp]
        real(dp), parameter :: gap(1) = 0, mu(1) = 2
        real(dp), parameter :: known(2, 0:2) = reshape([-0.5_dp, 2._dp, 0._dp, 0.5_dp, 0._dp, 0._dp], [2, 3])
        real(dp) :: d(2), force(2), second(2), of_second(2)
        integer :: state(1), second_state(1)
        type(signorini_settings) :: settings
        type(signorini_report) :: report
        settings%search = SIGNORINI_SEARCH_OTHERS
        call contact_solve(k, f, gap, d, force, info, friction=mu, settings=settings, state=state, &
            report=report, second_d=second, second_force=of_second, second_state=second_state)
        call expect('several', info == 0 .and. report%second == 1 .and. &
            report%uniqueness == SIGNORINI_UNIQUENESS_SEVERAL .and. state(1) /= second_state(1))
        call expect('first solution', all(abs(d - known(:, state(1))) < 1e-9_dp))
        call expect('second solution', all(abs(second - known(:, second_state(1))) < 1e-9_dp))
        call expect('its forces', all(abs(matmul(k, second) - f - of_second) < 1e-9_dp))
        call contact_solve(k, f, gap, d, force, info, friction=[0.5_dp], settings=settings, &
            report=report, second_d=second)
        call expect('one solution', info == 0 .and. report%second == 0 .and. maxval(abs(second)) <= 0)
    end subroutine

    ! w = -1 - z has no w, z >= 0, as y = 1 shows: -y <= 0 and q y < 0.
    subroutine infeasible
        real(dp) :: m(1, 1), w(1), z(1), y(1)
        m = 0
        call lcp_solve(m, [-1._dp], w, z, info, infeasible_by=y)
        call expect('infeasible LCP', info == SIGNORINI_STATUS_NO_EQUILIBRIUM .and. y(1) > 0)
    end subroutine

    ! The pair of `laws` by its flexibility W = inverse(4 1; 1 4), with the free displacements W f.
    subroutine flexibility
        real(dp), parameter :: w(2, 2) = reshape([real(dp) :: 4, -1, -1, 4], [2, 2])/15
        real(dp), parameter :: free(2) = [7, 2]/15._dp, gap(1) = 0, mu(1) = 0.3_dp
        real(dp) :: d(2), force(2), none(2, 2)
        type(signorini_model_data) :: data
        call model%new_flexibility(2, w, info, message)
        call expect('flexibility', info == 0 .and. model%host_size() == 2 .and. model%pairs == 1)
        data = model%view()
        call expect('its view', data%kind == SIGNORINI_MODEL_FLEXIBILITY .and. data%memory > 0 .and. &
            .not. c_associated(data%k))
        call model%solve(free, gap, d, force, info, friction=mu, state=state(1:1))
        call expect('case of a flexibility', info == 0 .and. abs(d(2) - 0.4_dp/3.7_dp) < 1e-9_dp .and. &
            abs(force(2) - 0.3_dp*force(1)) < 1e-9_dp .and. state(1) == SIGNORINI_STATE_SLIP)
        call model%certify(free, gap, d, info, friction=mu, force=force, message=message)
        call expect('its certificate', info == 0 .and. message == '')
        call model%certify(free, gap, d + 1, info, friction=mu, force=force)
        call expect('no solution of it', info == SIGNORINI_STATUS_NOT_A_SOLUTION)
        call model%stiffness(none, info, message)
        call expect('no stiffness', info == CONTACT_WRONG_MODEL .and. index(message, 'flexibility') > 0)
        call model%release()
        call model%new_flexibility(2, reshape([1._dp, 0._dp], [2, 1]), info, message)
        call expect('square', info == -2 .and. index(message, 'w has the shape (2, 1)') == 1)
        call model%new_flexibility_sparse(2, [1, 2, 3, 4], [1, 2, 3], [1._dp, 1._dp, 1._dp], &
            SIGNORINI_TRIANGLE_LOWER, info, message)
        call expect('whole pairs', info == -2 .and. index(message, 'col_start has 4 entries') == 1)
    end subroutine

    ! A point on springs of stiffness 2 before a rigid wall, in 3D, with an oblique normal.
    subroutine oblique
        real(dp), parameter :: f(3) = [1, 2, 3], normal(3) = [2, -1, 2], gap(1) = 0.1_dp
        real(dp) :: frames(3, 3, 1), t(3, 3), load(3), d(3), force(3), u(3), nodal(3)
        integer :: i
        call model%new_sparse([1, 2, 3, 4], [1, 2, 3], [2._dp, 2._dp, 2._dp], SIGNORINI_TRIANGLE_LOWER, &
            reshape([1, 2, 3], [3, 1]), reshape(normal, [3, 1]), info, message=message)
        call expect('sparse model', info == 0 .and. model%host_size() == 3)
        call model%frames(frames, info)
        t = frames(:, :, 1)
        call expect('frames', info == 0 .and. all(abs(matmul(transpose(t), t) - &
            reshape([real(dp) :: 1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])) < 1e-14_dp))
        call expect('normal', all(abs(t(:, 1) - normal/3) < 1e-15_dp))
        call expect('second tangent', all(abs(cross(t(:, 1), t(:, 2)) - t(:, 3)) < 1e-14_dp))
        call model%condensed_load(f, load, info)
        call expect('condensed load', info == 0 .and. all(abs(matmul(t, load) - f) < 1e-13_dp))
        call model%solve(f, gap, d, force, info, friction=[0.3_dp])
        call expect('oblique case', info == 0 .and. abs(d(1) - gap(1)) < 1e-9_dp)
        call model%certify(f, gap, d, info, friction=[0.3_dp])
        call expect('oblique certificate', info == 0)
        call model%recover(f, d, u, info)
        call expect('oblique displacement', info == 0 .and. all(abs(matmul(t, d) - u) < 1e-14_dp))
        call model%nodal_forces(force, nodal, info)
        call expect('oblique force', info == 0 .and. all(abs([(2*u(i) - f(i) - nodal(i), i=1, 3)]) < 1e-9_dp))
        call model%release()
    end subroutine

    pure function cross(a, b) result(c)
        real(dp), intent(in) :: a(3), b(3)
        real(dp) :: c(3)
        c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
    end function

    subroutine expect(what, passed)
        character(len=*), intent(in) :: what
        logical, intent(in) :: passed
        if (passed) return
        print '(3a, i0, 2a)', 'FAIL: ', what, ', info = ', info, ', ', trim(message)
        failed = failed + 1
    end subroutine
end program
