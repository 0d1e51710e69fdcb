! A body touches a plane with two pairs, through the module of include/signorini.f90.
program first
    use signorini
    implicit none
    real(c_double), parameter :: k(4, 4) = reshape([real(c_double) :: &
        4, 1, -1, 0,   1, 4, 0, -1,   -1, 0, 4, 1,   0, -1, 1, 4], [4, 4])
    ! Loads: > 0 in n presses on the obstacle.
    real(c_double), parameter :: f(4) = [2.0d0, 1.5d0, 3.0d0, 0.5d0]
    real(c_double), parameter :: gap(2) = 0, mu(2) = 0.3d0
    character(len=5), parameter :: names(0:2) = ['open ', 'slip ', 'stick']
    real(c_double) :: d(4), force(4)
    integer :: state(2), info, i
    character(len=200) :: message

    call contact_solve(k, f, gap, mu, d, force, info, state=state, tolerance=1d-12, message=message)
    if (info /= SIGNORINI_SOLVED) then
        print '(a, i0, 2a)', 'status ', info, ': ', trim(message)
        stop 1
    end if
    do i = 1, 2
        print '(a, i1, 3a, f6.4, a, f6.4, a, f7.4, a, f7.4)', 'pair ', i, ' ', names(state(i)), &
            ' d_n ', d(2*i - 1), ' d_t ', d(2*i), '  F_n ', force(2*i - 1), ' F_t ', force(2*i)
    end do
end program
