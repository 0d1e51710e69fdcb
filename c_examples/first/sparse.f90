! Two bars in a row along x, from a whole sparse matrix: bar A pushes on bar B across a gap.
!
!     wall 1|--A--o2   gap   3o--B--|4 wall      node i has the degrees of freedom 2 i - 1 and 2 i
program sparse
    use signorini
    implicit none
    ! Each bar: 100 along x, 10 along y. Lower triangle by columns, rows ascending.
    integer, parameter :: col_start(9) = [1, 3, 5, 6, 7, 9, 11, 12, 13]
    integer, parameter :: row(12) = [1, 3, 2, 4, 3, 4, 5, 7, 6, 8, 7, 8]
    real(c_double), parameter :: values(12) = real([100, -100, 10, -10, 100, 10, &
        100, -100, 10, -10, 100, 10], c_double)
    ! One pair: node 2 faces node 3; its outward normal is x, so that its tangent is y.
    integer, parameter :: slave(2, 1) = reshape([3, 4], [2, 1]), master(2, 1) = reshape([5, 6], [2, 1])
    real(c_double), parameter :: normal(2, 1) = reshape([1d0, 0d0], [2, 1])
    real(c_double), parameter :: f(8) = [0d0, 0d0, 30d0, 6d0, 0d0, 0d0, 0d0, 0d0] ! load on node 2
    real(c_double) :: d(2), force(2), u(8)
    type(contact_model) :: model
    character(len=200) :: message
    integer :: info

    call model%new_sparse(col_start, row, values, SIGNORINI_TRIANGLE_LOWER, slave, normal, info, &
        fixed=[1, 2, 7, 8], master_start=[1, 2], masters=master, weights=[1d0], message=message)
    if (info == 0) call model%solve(f, [0.1d0], d, force, info, friction=[0.2d0], message=message)
    if (info == 0) call model%recover(f, d, u, info, message=message)
    if (info /= 0) then
        print '(a, i0, 2a)', 'status ', info, ': ', trim(message)
        stop 1
    end if
    print '(a, f8.4, a, f7.4, 2(a, 2(1x, f6.4)))', 'F_n ', force(1), ' F_t ', force(2), &
        '  node 1', u(3:4), '  node 2', u(5:6)
    call model%release()
end program
