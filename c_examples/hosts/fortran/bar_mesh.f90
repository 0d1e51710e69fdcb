! The bar on the plane for the hosts in Fortran 90: a small stand-in for your own code. It gives the
! lower triangle of the stiffness as triplets, those of one entry to be summed, and the loads.
! Components (u_x, u_y) node by node, rows of nodes upwards from the contact side: that has the
! first 66. The component x of the last node of each row is held by symmetry.
module bar_mesh
    implicit none
    integer, parameter :: dp = kind(1d0), columns = 32, rows = 5, pairs = columns + 1
    integer, parameter :: components = 2*pairs*(rows + 1), triplets = 36*columns*rows
contains
    ! All of it; or the elements of some columns, first to last, with 36*rows triplets for each column,
    ! and their shares of the loads.
    subroutine bar_assemble(i, j, value, load, first, last)
        integer, intent(out) :: i(:), j(:)
        real(dp), intent(out) :: value(:), load(components)
        integer, intent(in), optional :: first, last
        integer :: row, column, a, b, t, at(8), from, to
        real(dp) :: k(8, 8), width, height
        from = 1
        to = columns
        if (present(first)) from = first
        if (present(last)) to = last
        load = 0
        t = 0
        width = 40d0/columns
        do row = 1, rows
            height = 40d0*1.7d0**(row - 1)*0.7d0/(1.7d0**rows - 1)
            k = element(width, height)
            do column = from, to
                a = pairs*(row - 1) + column
                at = [2*a - 1, 2*a, 2*a + 1, 2*a + 2, 2*(a + pairs) + 1, 2*(a + pairs) + 2, &
                      2*(a + pairs) - 1, 2*(a + pairs)]
                do b = 1, 8
                    do a = 1, b
                        t = t + 1
                        i(t) = max(at(a), at(b))
                        j(t) = min(at(a), at(b))
                        value(t) = k(a, b)
                    end do
                end do
                ! 10 on the side x = 0 and 5 on the top, both inward.
                if (column == 1) load(at([1, 7])) = load(at([1, 7])) + 5*height
                if (row == rows) load(at([6, 8])) = load(at([6, 8])) - 2.5d0*width
            end do
        end do
    end subroutine

    ! Triplets to compressed columns, column by column through one that is full.
    subroutine bar_compress(i, j, value, starts, lines, values)
        integer, intent(in) :: i(:), j(:)
        real(dp), intent(in) :: value(:)
        integer, intent(out) :: starts(:)
        integer, allocatable, intent(out) :: lines(:)
        real(dp), allocatable, intent(out) :: values(:)
        real(dp), allocatable :: full(:, :)
        integer :: t, row, column
        allocate (full(components, components))
        full = 0
        do t = 1, size(value)
            full(i(t), j(t)) = full(i(t), j(t)) + value(t)
        end do
        lines = pack(spread([(row, row=1, components)], 2, components), full /= 0)
        values = pack(full, full /= 0)
        starts(1) = 1
        do column = 1, components
            starts(column + 1) = starts(column) + count(full(:, column) /= 0)
        end do
    end subroutine

    ! Components that the symmetry holds.
    function bar_held() result(held)
        integer :: held(rows + 1), row
        held = [(2*pairs*row - 1, row=1, rows + 1)]
    end function

    ! A rectangle in plane strain, 2 x 2 Gauss points, nodes anticlockwise.
    function element(width, height) result(k)
        real(dp), intent(in) :: width, height
        real(dp) :: k(8, 8), b(3, 8), law(3, 3), shear, point(2)
        real(dp), parameter :: x(4) = [-1, 1, 1, -1], y(4) = [-1, -1, 1, 1]
        integer :: p
        shear = 13000/2.4d0
        law = 0
        law(1:2, 1:2) = 2*shear*0.2d0/0.6d0
        law(1, 1) = 2*shear*0.8d0/0.6d0
        law(2, 2) = law(1, 1)
        law(3, 3) = shear
        k = 0
        do p = 1, 4
            point = [x(p), y(p)]/sqrt(3d0)
            b = 0
            b(1, 1::2) = x*(1 + y*point(2))/(2*width)
            b(2, 2::2) = y*(1 + x*point(1))/(2*height)
            b(3, 1::2) = b(2, 2::2)
            b(3, 2::2) = b(1, 1::2)
            k = k + width*height/4*matmul(transpose(b), matmul(law, b))
        end do
    end function

    subroutine bar_print(state, d, force)
        integer, intent(in) :: state(pairs)
        real(dp), intent(in) :: d(2*pairs), force(2*pairs)
        integer :: i
        do i = 1, pairs
            print '(a, i3, i2, 1p, 4e20.12)', 'node', i, state(i), d(2*i - 1:2*i), force(2*i - 1:2*i)
        end do
    end subroutine
end module
