! The idiomatic layer of the module: sizes that it finds out, optional arguments, refusals.
program layer
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp) :: k(4, 4), f(4), gap(2), mu(2), d(4), force(4), other(4), z(4), u(8), wide(8, 8)
    integer :: info, state(2), failed
    type(signorini_report) :: report
    type(signorini_settings) :: settings
    type(contact_model) :: model
    character(len=256) :: message

    failed = 0
    k = reshape([real(dp) :: 4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4], [4, 4])
    f = [2._dp, 1.5_dp, 3._dp, 0.5_dp]
    gap = 0
    mu = 0.3_dp

    call expect('version', signorini_abi_fits())
    call contact_solve(k, f, gap, mu, d, force, info, state=state, report=report, message=message)
    ! The numbers of the README.
    call expect('solve', info == 0 .and. message == '' .and. all(state == [SIGNORINI_SLIP, SIGNORINI_STICK]))
    call expect('forces', all(abs(force - [-1.7568_dp, -0.5270_dp, -3._dp, -0.7432_dp]) < 1e-4_dp))
    call expect('report', report%eta <= 1e-10_dp .and. report%slip == 1 .and. report%stick == 1)
    call contact_certify(k, f, gap, mu, d, 1e-9_dp, info)
    call expect('certificate', info == SIGNORINI_SOLVED)
    call contact_certify(k, f, gap, mu, d + 1, 1e-9_dp, info, message=message)
    call expect('no solution', info == SIGNORINI_NOT_A_SOLUTION .and. message /= '')

    ! A part of a larger matrix, and every second entry of an array.
    wide = 0
    wide(1:4, 1:4) = k
    u(1::2) = f
    call contact_solve(wide(1:4, 1:4), u(1::2), gap, mu, other, force, info)
    call expect('sections', info == 0 .and. all(other == d))
    call contact_solve(k, f, gap, mu, other, force, info, method=SIGNORINI_METHOD_SOR_NESTED, &
        slip=d(2::2), tolerance=1e-12_dp)
    call expect('slip and method', info == 0)
    call contact_tresca(k, f, gap, [0.5_dp, 0.7_dp], other, force, info, method=SIGNORINI_METHOD_SOR_NESTED)
    call expect('Tresca', info == 0 .and. all(abs(force(2::2)) <= [0.5_dp, 0.7_dp] + 1e-9_dp))
    call lcp_solve(k, -f, other, z, info)
    call expect('LCP', info == 0 .and. all(abs(matmul(k, z) - f - other) < 1e-9_dp) .and. all(z >= 0))
    call contact_solve(k, f, gap, mu, other, force, info, method=SIGNORINI_METHOD_SOR_DIAGONAL, max_iterations=1)
    call expect('limit', info == SIGNORINI_ITERATION_LIMIT)
    info = signorini_settings_default(settings, int(c_sizeof(settings), c_int32_t))
    settings%omega = 3
    call contact_solve(k, f, gap, mu, other, force, info, settings=settings, message=message)
    call expect('settings', info == -9 .and. message /= '')

    call contact_solve(k, f, gap, mu(1:1), other, force, info, message=message)
    call expect('size of mu', info == -7 .and. message /= '')
    call contact_solve(k(:, 1:3), f, gap, mu, other, force, info, message=message)
    call expect('size of k', info == -3 .and. message /= '')
    call contact_solve(k(1:3, :), f, gap, mu, other, force, info, message=message)
    call expect('rows of k', info == -4 .and. message /= '')
    call contact_solve(k, f, gap, mu, other(1:3), force, info, message=message)
    call expect('size of d', info == -10 .and. message /= '')

    call model%solve(f, gap, mu, other, force, info, message=message)
    call expect('no model', info < 0 .and. message /= '')
    call model%new_condensed(2, k, info)
    call expect('condensed model', info == 0 .and. model%host_size() == 4)
    call model%solve(f, gap, mu, other, force, info, state=state)
    call expect('its case', info == 0 .and. all(abs(other - d) < 1e-9_dp))
    call model%new_two_body(2, k, k, info)
    call expect('two bodies', info == 0 .and. model%host_size() == 8)
    call model%solve([f, f], gap, mu, other, force, info)
    call expect('their case', info == 0)
    call model%recover([f, f], other, u, info)
    call expect('their displacements', info == 0 .and. all(abs(u(1:4) + u(5:8) - other) < 1e-9_dp))
    call model%recover(f, other, u, info, message=message)
    call expect('size of f', info == -1 .and. message /= '')
    call model%new_sparse([0, 1, 2], [0, 1], [1._dp, 1._dp], SIGNORINI_LOWER, reshape([1, 2], [2, 1]), &
        reshape([0._dp, -1._dp], [2, 1]), info, message=message)
    call expect('index base', info == -1 .and. message /= '')
    call model%new_sparse([1, 2, 3], [1, 2], [1._dp, 1._dp], SIGNORINI_LOWER, reshape([1, 2], [2, 1]), &
        reshape([0._dp, -1._dp], [2, 1]), info, message=message)
    call expect('sparse model', info == 0 .and. model%host_size() == 2)
    call model%release()
    call expect('released', model%host_size() == -1)
    if (failed /= 0) stop 1
    print '(a)', 'the layer of the module: all as expected'
contains
    logical function signorini_abi_fits()
        signorini_abi_fits = signorini_library_abi_version() == SIGNORINI_ABI_VERSION
    end function

    subroutine expect(what, passed)
        character(len=*), intent(in) :: what
        logical, intent(in) :: passed
        if (passed) return
        print '(3a, i0)', 'FAIL: ', what, ', info = ', info
        failed = failed + 1
    end subroutine
end program
