! Mistakes that users of the module make, and what they are told: a row for each, with info and the sentence,
! and whether the words that name the mistake are there.
program mistakes
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp) :: k(4, 4), f(4), gap(2), mu(2), d(4), force(4), u(4), values(4), normals(2, 2), at(2, 4)
    integer :: info, failed, start(5), row(4), slaves(2, 2)
    type(contact_model) :: model
    type(contact_surfaces) :: surfaces
    type(signorini_report) :: report
    character(len=511) :: message

    failed = 0
    k = reshape([real(dp) :: 4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4], [4, 4])
    f = [2._dp, 1.5_dp, 3._dp, 0.5_dp]
    gap = 0
    mu = 0.3_dp
    start = [1, 2, 3, 4, 5]
    row = [1, 2, 3, 4]
    values = 1
    slaves = reshape([1, 2, 3, 4], [2, 2])
    normals = reshape([0, -1, 0, -1], [2, 2])

    print '(a)', '| mistake | interface | info | sentence |'
    print '(a)', '|---|---|---|---|'
    call contact_solve(k, f, gap, d, force, info, friction=mu(1:1), message=message)
    call told('friction of one pair', -8, 'friction has 1 entry, it must have 2')
    call contact_solve(k(:, 1:3), f, gap, d, force, info, message=message)
    call told('k is not square', -1, 'k has the shape (4, 3), it must be (4, 4)')
    call contact_solve(k, f(1:3), gap, d, force, info, message=message)
    call told('f of another size', -2, 'f has 3 entries')
    call contact_solve(k, f, gap, d(1:2), force, info, message=message)
    call told('d of the pairs', -4, 'd has 2 entries, it must have 4')
    call model%new_condensed(3, k, info, message)
    call told('dim 3 for a plane k', -2, 'k has the shape (4, 4), its rows must be a multiple of dim (3)')
    call model%new_two_body(2, k, k(1:2, 1:2), info, message)
    call told('bodies of two sizes', -3, 'k_b has the shape (2, 2), it must be (4, 4)')
    call sparse(start - 1, row, -1, 'counted from 0', 'col_start(1) is 0, it must be 1')
    call sparse(start, row - 1, -3, 'rows counted from 0', 'row(1)')
    call sparse(start, row(1:3), -2, 'row one too short', 'row has 3 entries, it must have 4')
    call sparse(start(1:3), row, -1, 'size is the number of nodes', 'col_start(3) is 3, it must be 5')
    normals(:, 2) = 0
    call sparse(start, row, -5, 'a normal not set', 'pair 2: its normal is zero')
    normals(2, 2) = -1
    slaves = reshape([1, 2, 1, 1], [2, 2])
    call sparse(start, row, -5, 'a dof for both axes', 'pair 2: its slave has degree of freedom 1 twice')
    slaves = reshape([1, 2, 3, 4], [2, 2])
    call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
        masters=slaves, weights=[1._dp, 1._dp], message=message)
    call told('master_start forgotten', -9, 'master_start is missing')
    call sparse(start, row, 0, 'right', '')
    call model%solve(f(1:2), gap, d, force, info, message=message)
    call told('loads of the pairs', -1, 'f has 2 entries, it must have 4')
    call model%recover(f, d, u(1:2), info, message=message)
    call told('displacements of the pairs', -3, 'u has 2 entries, it must have 4')

    ! A line above another one, each the outline of its body.
    at = reshape([real(dp) :: 0, 0, 1, 0, 1, 0, 0, 0], [2, 4])
    call surfaces%pair(at, reshape([1, 2], [2, 1]), reshape([3, 4], [2, 1]), info, message=message)
    call told('right', 0, '')
    call surfaces%adjust(0.1_dp, at(:, 1:3), info, message)
    call told('coordinates of some nodes', -2, 'coordinates has the shape (2, 3), it must be (2, 4)')
    call surfaces%release()

    ! The bits of a NaN.
    f(2) = transfer(9221120237041090560_c_int64_t, f(2))
    call contact_solve_flexibility(k, f, gap, d, force, info, message=message)
    call told('q with a NaN', -2, 'q(2) is not finite')
    call contact_solve_flexibility_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, f, gap, d, force, info, &
        message=message)
    call told('q of a sparse flexibility with a NaN', -5, 'q(2) is not finite')
    f(2) = 1.5_dp

    ! Right in themselves: remarks.
    call contact_solve(k, f, gap - 0.1_dp, d, force, info, friction=mu, report=report, message=message)
    call remarked('gap of the wrong sign', SIGNORINI_REMARK_GAPS_NEGATIVE)
    call contact_solve(k, f, gap, d, force, info, friction=100*mu, report=report, message=message)
    call remarked('mu in percent', SIGNORINI_REMARK_FRICTION_LARGE)
    k = 0
    k(1, 1) = 1
    k(3, 3) = 1
    call contact_solve(k, [1._dp, 0._dp, 1._dp, 0._dp], gap, d, force, info, report=report, message=message)
    call remarked('nothing holds it along the plane', SIGNORINI_REMARK_FREE_MOTION)

    call model%release()
    if (failed /= 0) stop 1
    print '(a)', 'mistakes in Fortran: each is named'
contains
    subroutine sparse(start, row, wanted, mistake, words)
        integer, intent(in) :: start(:), row(:), wanted
        character(len=*), intent(in) :: mistake, words
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            message=message)
        call told(mistake, wanted, words)
    end subroutine

    subroutine told(mistake, wanted, words)
        character(len=*), intent(in) :: mistake, words
        integer, intent(in) :: wanted
        print '(3a, i0, 3a)', '| ', mistake, ' | F90 | ', info, ' | ', trim(message), ' |'
        if (info == wanted .and. index(message, words) /= 0) return
        print '(a, i0, 2a)', '   FAIL: wanted ', wanted, ': ', words
        failed = failed + 1
    end subroutine

    subroutine remarked(mistake, remark)
        character(len=*), intent(in) :: mistake
        integer(c_int32_t), intent(in) :: remark
        call told(mistake, 0, 'remark: ' // signorini_remark_text(remark))
        if (report%remarks == remark) return
        print '(a, i0, a, i0)', '   FAIL: remarks ', report%remarks, ', wanted ', remark
        failed = failed + 1
    end subroutine
end program
