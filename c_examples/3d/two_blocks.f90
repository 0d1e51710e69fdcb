! Two blocks, the upper one held by nothing but contact and friction, pressed and then twisted more and
! more: two_blocks.c in Fortran 2008, with the module of include/signorini.f90 and brick_mesh.f90.
!
!     two_blocks [DIR]        with DIR, writes DIR/two_blocks.csv and DIR/two_blocks.vtu
!
! It stops with 0 if the contact forces balance the loads.
program two_blocks
    use brick_mesh
    use signorini
    implicit none
    real(dp), parameter :: mu = 0.6_dp, press = 40000, twists(5) = [0, 100, 200, 300, 400]*1d3
    real(dp), parameter :: rounding = 1d-9 ! rounding of sums of some hundred forces, relative
    integer, allocatable :: col_start(:), row(:)
    real(dp), allocatable :: values(:)
    real(dp) :: at(3, nodes), load(3, nodes), d(3*pairs), force(3*pairs), slip0(2*pairs)
    real(dp) :: u(components), friction(pairs), off
    integer :: corners(8, bricks), slave(4, narrow**2), master(4, wide**2), top(pairs), state(pairs)
    integer :: info, step, p
    type(contact_surfaces) :: surfaces
    type(contact_model) :: model
    type(signorini_report) :: report
    type(signorini_resultant) :: contact
    character(len=256) :: message

    call place_nodes(at)
    call place_bricks(corners)
    call place_faces(slave, master, top)
    call assemble(corners, col_start, row, values)
    call surfaces%pair(at, slave, master, info, message=message)
    if (info /= 0) call give_up
    call model%new_surfaces(col_start, row, values, SIGNORINI_TRIANGLE_FULL, surfaces, info, &
        fixed=[(p, p=1, held)], message=message)
    if (info /= 0) call give_up
    print '(a)', surfaces%summary()

    friction = mu
    d = 0
    off = 0
    print '(a)', 'twist, N m   open slip stick   M_z, N m       eta'
    do step = 1, size(twists)
        slip0 = [(d(3*p - 1:3*p), p=1, pairs)] ! friction remembers
        call place_loads(twists(step))
        call model%solve(reshape(load, [components]), surfaces%gap, d, force, info, friction=friction, &
            slip0=slip0, tolerance=1d-12, state=state, report=report, message=message)
        if (info /= SIGNORINI_STATUS_SOLVED) call give_up

        call surfaces%resultant(d, force, contact, info, message=message)
        if (info /= 0) call give_up
        off = max(off, maxval(abs([contact%force, contact%moment] + resultant(at, load))/press/ &
            [1, 1, 1, 30, 30, 30]))
        print '(i10, i7, i5, i6, f11.1, es10.1)', nint(1d-3*twists(step)), &
            [(count(state == p), p=0, 2)], 1d-3*contact%moment(3), report%eta
    end do
    if (command_argument_count() == 1) call write_files
    call model%release()
    call surfaces%release()
    print '(a, es8.1)', 'contact forces balance the loads: off by', off
    if (off > rounding) stop 1
contains
    subroutine give_up
        print '(a, i0, 2a)', 'info = ', info, ': ', trim(message)
        stop 1
    end subroutine

    ! Forces on the top: the press on the inner 5 x 5 nodes, and across the radius of all nodes, in
    ! proportion to it, those with the moment `twist`.
    subroutine place_loads(twist)
        real(dp), intent(in) :: twist
        integer :: node, p
        real(dp) :: squares
        logical :: inner(pairs)
        squares = sum(at(1:2, top)**2)
        inner = abs(at(1, top)) <= 20 .and. abs(at(2, top)) <= 20
        load = 0
        do p = 1, pairs
            node = top(p)
            load(1:2, node) = twist/squares*[-at(2, node), at(1, node)]
            if (inner(p)) load(3, node) = -press/count(inner)
        end do
    end subroutine

    ! Sum of nodal forces, and of their moments about the origin.
    function resultant(place, nodal)
        real(dp), intent(in) :: place(:, :), nodal(:, :)
        real(dp) :: resultant(6)
        resultant(1:3) = sum(nodal, 2)
        resultant(4) = sum(place(2, :)*nodal(3, :) - place(3, :)*nodal(2, :))
        resultant(5) = sum(place(3, :)*nodal(1, :) - place(1, :)*nodal(3, :))
        resultant(6) = sum(place(1, :)*nodal(2, :) - place(2, :)*nodal(1, :))
    end function

    subroutine write_files
        character(len=5), parameter :: name(0:2) = [character(len=5) :: 'open', 'slip', 'stick']
        character(len=4000) :: directory
        integer :: unit, p
        call get_command_argument(1, directory)
        open (newunit=unit, file=trim(directory)//'/two_blocks.csv', status='replace', action='write')
        write (unit, '(a)') 'x,y,d_n,d_t1,d_t2,F_n,F_t1,F_t2,state'
        do p = 1, pairs
            write (unit, '(8(es20.12, ","), a)') surfaces%point(1:2, p), d(3*p - 2:3*p), &
                force(3*p - 2:3*p), trim(name(state(p)))
        end do
        close (unit)
        call model%recover(reshape(load, [components]), d, u, info, message=message)
        if (info /= 0) call give_up
        call surfaces%write(trim(directory)//'/two_blocks.vtu', at, corners, 12, d, force, info, u, state, &
            slip0, message=message)
        if (info /= 0) call give_up
    end subroutine
end program
