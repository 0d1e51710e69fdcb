! Refusals of the module's layer: info is the position in the call, message names the array.
program refusals
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp) :: k(4, 4), f(4), gap(2), mu(2), d(4), force(4), z(4), u(8), frames(2, 2, 2), nan
    integer :: info, state(2), failed
    type(signorini_settings) :: settings
    type(contact_model) :: model
    character(len=256) :: message

    failed = 0
    k = reshape([real(dp) :: 4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4], [4, 4])
    f = [2._dp, 1.5_dp, 3._dp, 0.5_dp]
    gap = 0
    mu = 0.3_dp
    nan = transfer(9221120237041090560_c_int64_t, nan)

    call contact_solve(k, f(1:3), gap, d, force, info, friction=mu, message=message)
    call expect(-2, 'f has 3 entries and gap 2')
    call contact_solve(k(:, 1:3), f, gap, d, force, info, friction=mu, message=message)
    call expect(-1, 'k has the shape (4, 3), it must be (4, 4)')
    call contact_solve(k, f, gap, d(1:3), force, info, friction=mu, message=message)
    call expect(-4, 'd has 3 entries, it must have 4')
    call contact_solve(k, f, gap, d, force(1:1), info, friction=mu, message=message)
    call expect(-5, 'force has 1 entry, it must have 4')
    call contact_solve(k, f, gap, d, force, info, law=8, friction=mu, message=message)
    call expect(-7, 'law is 8')
    call contact_solve(k, f, gap, d, force, info, law=int(SIGNORINI_LAW_COULOMB), message=message)
    call expect(-8, 'friction is missing')
    call contact_solve(k, f, gap, d, force, info, friction=mu(1:1), message=message)
    call expect(-8, 'friction has 1 entry, it must have 2')
    call contact_solve(k, f, gap, d, force, info, friction=-mu, message=message)
    call expect(-8, '(1)')
    call contact_solve(k, f, gap, d, force, info, friction=mu, slip0=f, message=message)
    call expect(-9, 'slip0 has 4 entries, it must have 2')
    call contact_solve(k, f, gap, d, force, info, friction=mu, method=9, message=message)
    call expect(-10, 'method 9')
    call contact_solve(k, f, gap, d, force, info, friction=mu, method=1, tolerance=0.5_dp, message=message)
    call expect(-11, 'tolerance is 0.5')
    call contact_solve(k, f, gap, d, force, info, friction=mu, max_iterations=0, message=message)
    call expect(-12, 'max_iterations is 0')
    settings%omega = 3
    call contact_solve(k, f, gap, d, force, info, friction=mu, settings=settings, message=message)
    call expect(-13, 'omega is 3')
    call contact_solve(k, f, gap, d, force, info, friction=mu, state=state(1:1), message=message)
    call expect(-14, 'state has 1 entry')
    call contact_solve(k, f, gap, d, force, info, friction=mu, motion=u, message=message)
    call expect(-16, 'motion has 8 entries')
    call contact_solve(k, f, gap, d, force, info, friction=mu, second_d=u, message=message)
    call expect(-17, 'second_d')
    call contact_solve(k, f, gap, d, force, info, friction=mu, second_force=u, message=message)
    call expect(-18, 'second_force')
    call contact_solve(k, f, gap, d, force, info, friction=mu, second_state=state(1:1), message=message)
    call expect(-19, 'second_state has 1 entry, it must have 2')
    ! Refusals of the library have the position here too, and count from 1.
    k(3, 2) = nan
    call contact_solve(k, f, gap, d, force, info, friction=mu, message=message)
    call expect(-1, 'K(3,2)')
    call lcp_solve(k, f, d, z, info, message=message)
    call expect(-1, 'M(3,2)')
    k(3, 2) = 0
    f(4) = nan
    call contact_solve(k, f, gap, d, force, info, friction=mu, message=message)
    call expect(-2, 'f(4)')
    call contact_certify(k, f, gap, d, info, friction=mu, message=message)
    call expect(-2, 'f(4)')
    f(4) = 0.5_dp
    gap(2) = nan
    call contact_solve(k, f, gap, d, force, info, message=message)
    call expect(-3, 'gap(2)')
    gap(2) = 0
    call contact_certify(k, f, gap, d, info, friction=mu, tolerance=2._dp, message=message)
    call expect(-9, 'tolerance is 2')
    d = [0._dp, 0._dp, nan, 0._dp]
    call contact_certify(k, f, gap, d, info, friction=mu, message=message)
    call expect(-4, 'd(3)')
    call lcp_solve(k, f, d, z(1:2), info, message=message)
    call expect(-4, 'z has 2 entries, it must have 4')

    call model%solve(f, gap, d, force, info, friction=mu, message=message)
    call expect(CONTACT_WRONG_MODEL, 'there is no model')
    call model%new_condensed(3, k, info, message)
    call expect(-2, 'k has the shape (4, 4), its rows must be a multiple of dim (3)')
    call model%new_condensed(4, k, info, message)
    call expect(-1, 'dim is 4')
    call model%new_condensed(2, k(:, 1:2), info, message)
    call expect(-2, 'must be square')
    call model%new_two_body(3, k, k, info, message)
    call expect(-2, 'k_a has the shape (4, 4), its rows must be a multiple of dim (3)')
    call model%new_two_body(2, k, k(1:2, 1:2), info, message)
    call expect(-3, 'k_b has the shape (2, 2), it must be (4, 4)')
    call model%new_condensed(2, k, info, message, settings=signorini_settings(memory_limit=-1))
    call expect(-5, 'memory_limit is -1')
    call model%new_condensed(2, k, info, message, settings=signorini_settings(memory_limit=1))
    call expect(int(SIGNORINI_STATUS_MEMORY_LIMIT), 'memory_limit allows')
    call model%new_two_body(2, k, k, info, message, settings=signorini_settings(memory_limit=-1))
    call expect(-6, 'memory_limit is -1')
    call model%new_condensed(2, k, info, message)
    call expect(0, '')
    call model%frames(frames, info, message)
    call expect(CONTACT_WRONG_MODEL, 'frames')
    call model%solve(f(1:2), gap, d, force, info, message=message)
    call expect(-1, 'f has 2 entries, it must have 4')
    call model%solve(f, gap, d, force, info, prescribed=gap, message=message)
    call expect(-6, 'prescribed has 2 entries, it must have 0')
    call model%solve([1._dp, 0._dp, nan, 0._dp], gap, d, force, info, message=message)
    call expect(-1, 'f(3)')
    call model%recover(f, d, u, info, message=message)
    call expect(-3, 'u has 8 entries, it must have 4')
    call model%nodal_forces(force(1:2), u, info, message=message)
    call expect(-1, 'force has 2 entries')
    call model%condensed_load(f, u, info, message=message)
    call expect(-2, 'load has 8 entries, it must have 4')
    call model%certify(f, gap, u, info, message=message)
    call expect(-3, 'd has 8 entries')
    call sparse
    call model%release()

    if (failed /= 0) stop 1
    print '(a)', 'refusals of the module: each with its position and its array'
contains
    ! A chain of two degrees of freedom, one pair.
    subroutine sparse
        integer :: start(3), row(2), slaves(2, 1)
        real(dp) :: values(2), normals(2, 1)
        start = [1, 2, 3]
        row = [1, 2]
        slaves(:, 1) = [1, 2]
        values = 1
        normals(:, 1) = [0, -1]
        call try(start - 1, row - 1, values, slaves - 1, normals, -1, 'col_start(1) is 0, it must be 1')
        call try([1, 2, 4], row, values, slaves, normals, -1, 'col_start(3) is 4, it must be 3')
        call try(start, row(1:1), values, slaves, normals, -2, 'row has 1 entry, it must have 2')
        call try(start, row - 1, values, slaves, normals, -3, 'row')
        call try(start, row, values, slaves - 1, normals, -5, 'slaves')
        call try(start, row, values, reshape([1, 9], [2, 1]), normals, -5, 'degree of freedom 9')
        call try(start, row, values, slaves, reshape(normals, [1, 2]), -6, &
            'normals has the shape (1, 2), it must be (2, 1): (dim, pairs)')
        call model%new_sparse(start, row, values, 5_c_int32_t, slaves, normals, info, message=message)
        call expect(-4, 'triangle is 5')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            fixed=[3], message=message)
        call expect(-8, 'degree of freedom 3')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            masters=slaves, weights=[1._dp], message=message)
        call expect(-9, 'master_start is missing')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            master_start=[0, 1], masters=slaves, weights=[1._dp], message=message)
        call expect(-9, 'master_start(1) is 0, it must be 1')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            master_start=[1, 2], masters=slaves(:, [1, 1]), weights=[1._dp], message=message)
        call expect(-10, 'masters has the shape (2, 2), it must be (2, 1)')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            tangents=reshape([1._dp], [1, 1]), message=message)
        call expect(-12, 'tangents has the shape (1, 1)')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            order=[1], message=message)
        call expect(-14, 'order has 1 entry, it must have 2')
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            order=[2, 2], message=message)
        call expect(-3, 'order(2) is 2, as order(1) is')
        settings = signorini_settings(memory_limit=-1)
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            settings=settings, message=message)
        call expect(-15, 'memory_limit is -1')
        settings = signorini_settings(memory_limit=1)
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            settings=settings, order=[2, 1], message=message)
        call expect(int(SIGNORINI_STATUS_MEMORY_LIMIT), 'memory_limit allows')
        call try(start, row, values, slaves, normals, 0, '')
    end subroutine

    subroutine try(start, row, values, slaves, normals, wanted, words)
        integer, intent(in) :: start(:), row(:), slaves(:, :), wanted
        real(dp), intent(in) :: values(:), normals(:, :)
        character(len=*), intent(in) :: words
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            message=message)
        call expect(wanted, words)
    end subroutine

    subroutine expect(wanted, words)
        integer, intent(in) :: wanted
        character(len=*), intent(in) :: words
        print '(i5, 2a)', info, '  ', trim(message)
        if (info == wanted .and. index(message, words) /= 0 .and. (wanted == 0 .eqv. message == '')) return
        print '(a, i0, 2a)', '   FAIL: wanted ', wanted, ': ', words
        failed = failed + 1
    end subroutine
end program
