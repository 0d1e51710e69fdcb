! Two blocks of 8-node bricks: mesh and assembly, as a small stand-in for your own code. It is the mesh
! of blocks.h: two blocks on each other, trilinear bricks of 10 and 7.5 mm, 2 x 2 x 2 Gauss points; mm, N,
! MPa.
! Node i has the degrees of freedom 3 i - 2, 3 i - 1, 3 i: u_x, u_y, u_z. x is numbered first, z last.
module brick_mesh
    implicit none
    integer, parameter :: dp = kind(1d0)
    integer, parameter :: wide = 10, deep = 4  ! cells of the lower block, along x and y, and along z
    integer, parameter :: narrow = 8, high = 2 ! cells of the upper block
    integer, parameter :: line = narrow + 1, pairs = line*line
    integer, parameter :: below = (wide + 1)**2*(deep + 1), nodes = below + pairs*(high + 1)
    integer, parameter :: bricks = wide**2*deep + narrow**2*high
    integer, parameter :: components = 3*nodes, held = 3*(wide + 1)**2
    real(dp), parameter :: coarse = 10, fine = 7.5_dp, young = 210000, poisson = 0.3_dp
contains
    ! Node at the crossing of three lines, which count from 0.
    pure integer function lower_node(i, j, k)
        integer, intent(in) :: i, j, k
        lower_node = 1 + i + (wide + 1)*(j + (wide + 1)*k)
    end function

    pure integer function upper_node(i, j, k)
        integer, intent(in) :: i, j, k
        upper_node = below + 1 + i + line*(j + line*k)
    end function

    ! The faces that may touch, anticlockwise as seen from outside: the bottom of the upper block is the
    ! slave, the top of the lower one the master. And the nodes on the top of the upper block.
    subroutine place_faces(slave, master, top)
        integer, intent(out) :: slave(4, narrow**2), master(4, wide**2), top(line**2)
        integer :: i, j
        do j = 0, narrow - 1
            do i = 0, narrow - 1
                slave(:, 1 + i + narrow*j) = [upper_node(i, j, 0), upper_node(i, j + 1, 0), &
                    upper_node(i + 1, j + 1, 0), upper_node(i + 1, j, 0)]
            end do
        end do
        do j = 0, wide - 1
            do i = 0, wide - 1
                master(:, 1 + i + wide*j) = [lower_node(i, j, deep), lower_node(i + 1, j, deep), &
                    lower_node(i + 1, j + 1, deep), lower_node(i, j + 1, deep)]
            end do
        end do
        top = [((upper_node(i, j, high), i=0, narrow), j=0, narrow)]
    end subroutine

    subroutine place_nodes(at)
        real(dp), intent(out) :: at(3, nodes)
        integer :: i, j, k
        do k = 0, deep
            do j = 0, wide
                do i = 0, wide
                    at(:, lower_node(i, j, k)) = coarse*[i - wide/2, j - wide/2, k - deep]
                end do
            end do
        end do
        do k = 0, high
            do j = 0, narrow
                do i = 0, narrow
                    at(:, upper_node(i, j, k)) = fine*[i - narrow/2, j - narrow/2, k]
                end do
            end do
        end do
    end subroutine

    ! The corners of each brick: the lower face anticlockwise from above, then the upper face.
    subroutine place_bricks(corners)
        integer, intent(out) :: corners(8, bricks)
        integer :: i, j, k, c, brick
        integer, parameter :: x(8) = [0, 1, 1, 0, 0, 1, 1, 0], y(8) = [0, 0, 1, 1, 0, 0, 1, 1], &
            z(8) = [0, 0, 0, 0, 1, 1, 1, 1]
        brick = 0
        do k = 0, deep - 1
            do j = 0, wide - 1
                do i = 0, wide - 1
                    brick = brick + 1
                    corners(:, brick) = [(lower_node(i + x(c), j + y(c), k + z(c)), c=1, 8)]
                end do
            end do
        end do
        do k = 0, high - 1
            do j = 0, narrow - 1
                do i = 0, narrow - 1
                    brick = brick + 1
                    corners(:, brick) = [(upper_node(i + x(c), j + y(c), k + z(c)), c=1, 8)]
                end do
            end do
        end do
    end subroutine

    ! The whole matrix by columns. The three columns of a node have the same rows: those of the nodes
    ! that share a brick with it, at most 27.
    subroutine assemble(corners, col_start, row, values)
        integer, intent(in) :: corners(8, bricks)
        integer, allocatable, intent(out) :: col_start(:), row(:)
        real(dp), allocatable, intent(out) :: values(:)
        integer, allocatable :: near(:, :)
        integer :: many(nodes), first(nodes + 1), a, b, c, i, brick, node, at
        real(dp) :: k(24, 24)
        allocate (near(27, nodes))
        many = 0
        do brick = 1, bricks
            do a = 1, 8
                do b = 1, 8
                    call connect(near(:, corners(a, brick)), many(corners(a, brick)), corners(b, brick))
                end do
            end do
        end do
        first(1) = 1
        do node = 1, nodes
            first(node + 1) = first(node) + 9*many(node)
        end do
        allocate (col_start(components + 1), row(first(nodes + 1) - 1), values(first(nodes + 1) - 1))
        do node = 1, nodes
            do c = 1, 3
                at = first(node) + 3*many(node)*(c - 1)
                col_start(3*node - 3 + c) = at
                row(at:at + 3*many(node) - 1) = [((3*near(b, node) - 3 + i, i=1, 3), b=1, many(node))]
            end do
        end do
        col_start(components + 1) = first(nodes + 1)

        values = 0
        do brick = 1, bricks
            ! All bricks of a block are the same cube.
            if (brick == 1) k = element(coarse)
            if (brick == wide**2*deep + 1) k = element(fine)
            do a = 1, 8
                node = corners(a, brick)
                do b = 1, 8
                    i = findloc(near(:many(node), node), corners(b, brick), dim=1)
                    do c = 1, 3
                        at = first(node) + 3*many(node)*(c - 1) + 3*(i - 1)
                        values(at:at + 2) = values(at:at + 2) + k(3*b - 2:3*b, 3*a - 3 + c)
                    end do
                end do
            end do
        end do
    end subroutine

    ! Inserts a node in an ascending list, unless it is there.
    subroutine connect(list, many, node)
        integer, intent(inout) :: list(27), many
        integer, intent(in) :: node
        integer :: at
        if (any(list(:many) == node)) return
        at = count(list(:many) < node) + 1
        list(at + 1:many + 1) = list(at:many)
        list(at) = node
        many = many + 1
    end subroutine

    ! Stiffness of a cube.
    function element(cell) result(k)
        real(dp), intent(in) :: cell
        real(dp) :: k(24, 24), shear, cross, g(3, 8), factor(3)
        integer, parameter :: place(3, 8) = reshape([-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, &
            -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, 8])
        integer :: p, a, b, i, j
        shear = young/(2*(1 + poisson))
        cross = 2*shear*poisson/(1 - 2*poisson)
        k = 0
        do p = 1, 8
            do a = 1, 8
                factor = 1 + place(:, a)*place(:, p)/sqrt(3d0)
                g(:, a) = place(:, a)*cshift(factor, 1)*cshift(factor, 2)/(4*cell)
            end do
            do a = 1, 8
                do b = 1, 8
                    do i = 1, 3
                        do j = 1, 3
                            k(3*a - 3 + i, 3*b - 3 + j) = k(3*a - 3 + i, 3*b - 3 + j) + &
                                (cell/2)**3*(cross*g(i, a)*g(j, b) + shear*g(j, a)*g(i, b))
                        end do
                        k(3*a - 3 + i, 3*b - 3 + i) = k(3*a - 3 + i, 3*b - 3 + i) + &
                            (cell/2)**3*shear*dot_product(g(:, a), g(:, b))
                    end do
                end do
            end do
        end do
    end function
end module
