! Indices in sentences: Fortran's count from 1 and stand in ( ), those of signorini_last_error count
! from 0 and stand in [ ]; other numbers are the same in both.
program counting
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp) :: k(4, 4), f(4), d(4), force(4), nan
    real(dp), parameter :: gap(2) = 0
    integer :: info, failed, i
    type(contact_model) :: model

    failed = 0
    k = 0
    do i = 1, 4
        k(i, i) = 4
    end do
    f = 1
    d = 0
    nan = transfer(9221120237041090560_c_int64_t, nan)

    call condensed
    call sparse
    call escape
    call cases

    if (failed /= 0) stop 1
    print '(a)', 'counting: from 1 in Fortran, from 0 in C'
contains
    subroutine condensed
        real(dp) :: wrong(4, 4)
        wrong = k
        wrong(3, 2) = nan
        call contact_solve(wrong, f, gap, d, force, info)
        call said('K(3,2) is not finite', 'K[2,1] is not finite')
        call lcp_solve(wrong, f, d, force, info)
        call said('M(3,2) is not finite', 'M[2,1] is not finite')
        wrong(3, 2) = 2
        call contact_solve(wrong, f, gap, d, force, info)
        call said('K(3,2) is 2, K(2,3) is 0', 'K[2,1] is 2, K[1,2] is 0')
        wrong = k
        wrong(4, 4) = 0
        wrong(4, 3) = 1
        wrong(3, 4) = 1
        call model%new_condensed(2, wrong, info)
        call said('K(4,4) is 0, it must be positive', 'K[3,3] is 0, it must be positive')
        call contact_solve(k, [f(1:3), nan], gap, d, force, info)
        call said('f(4) is not', 'f[3] is not')
        call contact_solve(k, f, [0._dp, nan], d, force, info)
        call said('gap(2) is NaN', 'gap[1] is NaN')
        call contact_solve(k, f, gap, d, force, info, friction=[0.5_dp, -1._dp])
        call said('mu(2) is -1, it', 'mu[1] is -1, it')
        call contact_solve(k, f, gap, d, force, info, friction=gap, slip0=[nan, 0._dp])
        call said('slip0(1) is not', 'slip0[0] is not')
        d(2) = nan
        call contact_certify(k, f, gap, d, info)
        call said('d(2) is not', 'd[1] is not')
        d = 0
        ! Brackets and numbers that are no indices.
        call contact_solve(k, f, gap, d, force, info, method=9)
        call said('there is no method 9', 'there is no method 9')
        call lie
    end subroutine

    ! An interval keeps its brackets.
    subroutine lie
        type(signorini_settings) :: settings
        settings%damping = 2
        call contact_solve(k, f, gap, d, force, info, settings=settings)
        call said('damping is 2, it must be 0 (chosen) or lie in (0, 1]', &
            'damping is 2, it must be 0 (chosen) or lie in (0, 1]')
    end subroutine

    ! Two nodes in the plane, each the slave of a pair.
    subroutine sparse
        integer :: slaves(2, 2)
        slaves = reshape([1, 2, 3, 4], [2, 2])
        call try([1, 2, 3, 4, 5], [1, 2, 3, 9], slaves, 1)
        ! The row is the caller's own number.
        call said('row(4), in column 4, is 9', 'row[3], in column 3, is 9')
        call try([1, 3, 3, 4, 5], [1, 1, 3, 4], slaves, 1)
        call said('column 1: row 1 is listed twice, in row(1) and row(2)', &
            'column 0: row 0 is listed twice, in row[0] and row[1]')
        call try([1, 2, 3, 4, 5], [1, 1, 3, 4], slaves, 1)
        call said('K(1,2) is not in the triangle', 'K[0,1] is not in the triangle')
        call try([1, 4, 3, 4, 5], [1, 2, 3, 4], slaves, 1)
        call said('col_start(3) is 3, less than col_start(2), which is 4', &
            'col_start[2] is 3, less than col_start[1], which is 4')
        call try([1, 2, 3, 4, 5], [1, 2, 3, 4], slaves, 5)
        call said('fixed: there is no degree of freedom 5', 'fixed: there is no degree of freedom 4')
        call try([1, 2, 3, 4, 5], [1, 2, 3, 4], slaves - 1, 1)
        call said('slaves(1) is 0, less than 1', 'slaves[0] is 0, less than 1')
        slaves(2, 2) = 5
        call try([1, 2, 3, 4, 5], [1, 2, 3, 4], slaves, 1)
        call said('pair 2: there is no degree of freedom 5', 'pair 1: there is no degree of freedom 4')
        slaves(2, 2) = 3
        call try([1, 2, 3, 4, 5], [1, 2, 3, 4], slaves, 1)
        call said('pair 2: its slave has degree of freedom 3 twice', &
            'pair 1: its slave has degree of freedom 2 twice')
    end subroutine

    subroutine try(start, row, slaves, fixed)
        integer, intent(in) :: start(:), row(:), slaves(:, :), fixed
        real(dp) :: values(4)
        values = 1
        call model%new_sparse(start, row, values, SIGNORINI_TRIANGLE_LOWER, slaves, &
            reshape([0._dp, -1._dp, 0._dp, -1._dp], [2, 2]), info, fixed=[fixed])
    end subroutine

    ! Nothing holds the second pair along -(1, 1), where its load pulls it.
    subroutine escape
        real(dp) :: loose(4, 4), load(4), values(5)
        loose = k
        loose(3, 4) = -4
        loose(4, 3) = -4
        load = [0, 0, -1, -1]
        call contact_solve(loose, load, gap, d, force, info)
        call said('it moves 1 of 2 pairs, most of all pair 2,', 'it moves 1 of 2 pairs, most of all pair 1,')
        call model%new_condensed(2, loose, info)
        call model%solve(load, gap, d, force, info)
        call said('1 of 2 pairs, most of all pair 2 by (-1', '1 of 2 pairs, most of all pair 1 by (-1')
        ! With the normal -y, upwards.
        values = [1, 1, 1, -1, 1]
        call model%new_sparse([1, 2, 3, 5, 6], [1, 2, 3, 4, 4], values, SIGNORINI_TRIANGLE_LOWER, &
            reshape([1, 2, 3, 4], [2, 2]), reshape([0._dp, -1._dp, 0._dp, -1._dp], [2, 2]), info)
        call model%solve(-load, gap, d, force, info)
        call said('2 of the degrees of freedom 3 to 4, most of', '2 of the degrees of freedom 2 to 3, most of')
        call said('; the slave of pair 2 moves along (1', '; the slave of pair 1 moves along (1')
        call model%release()
    end subroutine

    ! The second of two cases is wrong.
    subroutine cases
        real(dp), target :: loads(4, 2)
        real(dp) :: gaps(2, 2), both_d(4, 2), both_force(4, 2)
        type(c_ptr) :: handle
        loads = 1
        loads(3, 2) = nan
        gaps = 0
        info = signorini_model_new_condensed(2_c_int32_t, 2_c_int64_t, k, 4_c_int64_t, c_null_ptr, handle)
        info = signorini_model_solve(handle, 2_c_int64_t, c_loc(loads), c_null_ptr, gaps, &
            SIGNORINI_LAW_FRICTIONLESS, c_null_ptr, c_null_ptr, c_null_ptr, both_d, both_force, &
            c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr)
        call said('case 2: f(3) is not finite', 'case 1: f[2] is not finite')
        call signorini_model_free(handle)
    end subroutine

    ! The last call left the words of Fortran and those of C.
    subroutine said(fortran, c)
        character(len=*), intent(in) :: fortran, c
        character(len=:), allocatable :: message
        message = signorini_message()
        print '(i5, 2a)', info, '  ', message
        if (info /= 0 .and. index(message, fortran) > 0 .and. index(last_error(), c) > 0) return
        print '(6a)', '   FAIL: wanted ', fortran, ', and ', c, ' in ', last_error()
        failed = failed + 1
    end subroutine

    function last_error() result(text)
        character(len=512) :: text
        character(kind=c_char), pointer :: bytes(:)
        call c_f_pointer(signorini_last_error(), bytes, [512])
        text = ''
        do i = 1, 512
            if (bytes(i) == c_null_char) exit
            text(i:i) = bytes(i)
        end do
    end function
end program
