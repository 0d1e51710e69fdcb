! Pairs from surfaces by the module: rows by hand, a block on a rigid plane and on another line, and what
! is refused.
!
! Nodes 1 and 2 are a line of one element, 0 to 1, 0.1 above a line of two elements, -1 to 2. Each degree of
! freedom stands on a spring of stiffness 2.
program surfaces_test
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    real(dp), parameter :: places(2, 5) = reshape([0._dp, 0.1_dp, 1._dp, 0.1_dp, -1._dp, 0._dp, 0.5_dp, &
        0._dp, 2._dp, 0._dp], [2, 5])
    integer, parameter :: slave(3, 1) = reshape([1, 2, 0], [3, 1]), master(2, 2) = reshape([5, 4, 4, 3], [2, 2])
    type(contact_surfaces) :: surfaces, joined
    type(contact_model) :: model
    type(signorini_resultant) :: sums
    type(signorini_penetration) :: passed
    real(c_double), allocatable :: moved(:, :)
    type(signorini_obstacle) :: plane
    real(dp) :: d(4), force(4), load(10), pressure(5), traction(2, 5), clearance(5), apart(2, 5), u(10)
    real(dp), parameter :: halves(2, 4) = reshape([0._dp, 0.1_dp, 1._dp, 0.1_dp, 0._dp, 0._dp, 2._dp, 0._dp], [2, 4])
    type(signorini_surface_settings) :: lists
    integer(c_int32_t), target :: across = 1
    real(dp), target :: origin = 0
    integer :: info, failed, i, state(2), node_state(5), starts(11), rows(10)
    character(len=256) :: message

    failed = 0
    starts = [(i, i=1, 11)]
    rows = starts(:10)
    call surfaces%pair(places, slave, master, info, message=message)
    call expect('pair', info == 0 .and. message == '' .and. surfaces%pairs == 2 .and. surfaces%dim == 2)
    call expect('gaps', all(abs(surfaces%gap - 0.1_dp) < 1d-15) .and. all(abs(surfaces%area - 0.5_dp) < 1d-15))
    call expect('frames', all(abs(surfaces%normal - reshape([0, -1, 0, -1], [2, 2])) < 1d-15) .and. &
        all(abs(surfaces%tangent - reshape([1, 0, 1, 0], [2, 2])) < 1d-15))
    call expect('nodes', all(surfaces%node == [1, 2]) .and. all(abs(surfaces%point - places(:, :2)) < 1d-15))
    call expect('summary', index(surfaces%summary(), '2 pairs on 100.00 %') == 1)

    ! The half to the right of x = 0: its plane by arguments, and by the lists of settings, which count from 1.
    call surfaces%pair(halves, slave, reshape([4, 3], [2, 1]), info, symmetry_axes=[1], symmetry_at=[0._dp])
    call expect('half', info == 0 .and. surfaces%pairs == 2 .and. surfaces%data%on_symmetry == 1)
    lists%symmetry_planes = 1
    lists%symmetry_axes = c_loc(across)
    lists%symmetry_at = c_loc(origin)
    call surfaces%pair(halves, slave, reshape([4, 3], [2, 1]), info, settings=lists)
    call expect('half by settings', info == 0 .and. surfaces%pairs == 2 .and. surfaces%data%on_symmetry == 1)
    call surfaces%pair(places, slave, master, info)

    ! Pressed down by 1 at each node: all move by statics of springs; without friction the forces of the
    ! contact are those that the other line has, and nothing else acts on it.
    call model%new_surfaces(starts, rows, [(2._dp, i=1, 10)], SIGNORINI_TRIANGLE_LOWER, surfaces, info, &
        message=message)
    call expect('model', info == 0 .and. message == '')
    load = 0
    load([2, 4]) = -1
    call model%solve(load, surfaces%gap, d, force, info, state=state)
    call expect('solution', info == 0 .and. all(state == SIGNORINI_STATE_SLIP))
    call surfaces%resultant(d, force, sums, info, point=[0.5_dp, 0._dp])
    call model%recover(load, d, u, info)
    call expect('force', info == 0 .and. abs(sums%force(2) + 2*sum(u([6, 8, 10]))) < 1d-9)
    call expect('moment', all(abs(sums%moment) < 1d-9) .and. abs(sums%pressed_area - 1) < 1d-12)

    ! The same pairs as a zone with a name and a law: a tie moves as one, 1 on springs of 2 and 2 where the lower line has
    ! a node below, and half as stiff a share elsewhere; what it carries is what acts on the upper line less its springs.
    call joined%join([surfaces], ['the bolt'], info, [int(SIGNORINI_LAW_COULOMB)], message=message)
    call expect('law without numbers', info == -5 .and. index(message, 'numbers has 0 rows: the law 1 of zone 1') > 0)
    call joined%join([surfaces], ['the bolt'], info, [int(SIGNORINI_LAW_COHESIVE)], reshape([0.3_dp], [1, 1]), message)
    call expect('law with few numbers', info == -5 .and. index(message, 'has 3 parameters') > 0)
    call joined%join([surfaces], ['the bolt'], info, numbers=reshape([0.3_dp], [1, 1]), message=message)
    call expect('numbers without laws', info == -4 .and. index(message, 'laws is missing') > 0)
    call joined%join([surfaces], ['the bolt'], info, [int(SIGNORINI_LAW_TIED)], reshape([0.3_dp], [1, 1]), message)
    call expect('numbers of a tie', info == -5 .and. index(message, 'has no parameters') > 0)
    call joined%join([surfaces], ['the bolt'], info, [int(SIGNORINI_LAW_TIED)], reshape([0._dp], [1, 1]), message)
    call expect('zeros of a tie', info == 0)
    call joined%join([surfaces], ['the bolt'], info, [int(SIGNORINI_LAW_TIED)], message=message)
    call expect('join', info == 0 .and. message == '' .and. joined%pairs == 2 .and. all(joined%zone_start == [0, 2]))
    call expect('friction', all(abs(joined%friction - [7, 0, 0, 0, 7, 0, 0, 0]) < 1d-15))
    call expect('summary of zones', index(joined%summary(), 'the bolt: 2 pairs on') == 1)
    call model%new_surfaces(starts, rows, [(2._dp, i=1, 10)], SIGNORINI_TRIANGLE_LOWER, joined, info)
    call model%solve(load, [0._dp, 0._dp], d, force, info, law=int(SIGNORINI_LAW_BY_PAIR), friction=joined%friction, &
        state=state)
    call expect('tie', info == 0 .and. all(state == SIGNORINI_STATE_STICK) .and. all(d == 0))
    call joined%resultant(d, force, sums, info)
    call model%recover(load, d, u, info)
    call expect('force of the tie', info == 0 .and. abs(sums%force(2) - (2 + 2*sum(u([2, 4])))) < 1d-9)
    call expect('table', index(joined%table(d, force, state), new_line('a') // 'the bolt  ') > 0 .and. &
        index(joined%table(d, force, state), '       2        0        0        2') > 0)
    call joined%join([surfaces, surfaces], ['one', 'two'], info, message=message)
    call expect('shared face', info == -1 .and. index(message, "slave face 1 of zone 'two' is slave face 1 of zone 'one'") > 0)
    call joined%release()
    call model%new_surfaces(starts, rows, [(2._dp, i=1, 10)], SIGNORINI_TRIANGLE_LOWER, surfaces, info)
    call model%solve(load, surfaces%gap, d, force, info, state=state)
    pressure = -7
    node_state = -1
    call surfaces%fields(d, force, info, state=state, pressure=pressure, traction=traction, &
        clearance=clearance, node_state=node_state, message=message)
    call expect('fields', info == 0 .and. message == '' .and. &
        all(abs(pressure(:2) + force([1, 3])/surfaces%area) < 1d-12))
    call expect('directions', all(abs(traction(2, :2) - pressure(:2)) < 1d-12) .and. &
        all(abs(clearance(:2)) < 1d-9) .and. all(node_state == SIGNORINI_STATE_SLIP))
    call surfaces%penetration(u, passed, info, message=message)
    call expect('nothing has passed', info == 0 .and. message == '' .and. passed%points == 0)
    ! A node of no face, behind the others or with numbers far beyond, needs no displacements; a node of a face does.
    call joined%pair(reshape([places, 9._dp, 9._dp], [2, 6]), slave, master, info)
    call joined%penetration(u, passed, info, message=message)
    call expect('a node behind the others', info == 0 .and. message == '' .and. passed%points == 0)
    call joined%pair(reshape([places, 9._dp, 9._dp], [2, 6]), slave, master, info, &
        dofs=reshape([(i, i=1, 10), 1000001, 1000002], [2, 6]))
    call joined%penetration(u, passed, info, message=message)
    call expect('a node of any number', info == 0 .and. message == '' .and. passed%points == 0)
    call joined%penetration(u(:9), passed, info, message=message)
    call expect('a node of a face', info == -1 .and. index(message, 'u has 9 entries') == 1)
    moved = places
    call surfaces%adjust(1d-9, moved, info, message=message)
    call expect('all are further apart', info == 0 .and. message == '' .and. all(abs(moved - places) <= 0))
    call surfaces%write('surfaces.vtu', places, master, 3, d, force, info, u, state, message=message)
    call expect('file', info == 0 .and. message == '')
    open (newunit=i, file='surfaces.vtu', status='old')
    close (i, status='delete')
    call surfaces%write('no/folder/x.vtu', places, master, 3, d, force, info)
    call expect('no file', info == SIGNORINI_STATUS_FILE)
    call surfaces%fields(d(:3), force, info, message=message)
    call expect('short d', info == -1 .and. index(message, 'd has 3 entries, it must have 4') == 1)
    call model%release()
    call surfaces%release()
    call surfaces%fields(d, force, info, message=message)
    call expect('released', info == CONTACT_WRONG_MODEL .and. index(message, 'there are no pairs') == 1)

    plane%kind = SIGNORINI_OBSTACLE_PLANE
    plane%point = [0, -1, 0]
    plane%direction = [0, 3, 0]
    call surfaces%pair_obstacle(places, slave, plane, info, dofs_per_node=6)
    call expect('plane', info == 0 .and. all(abs(surfaces%gap - 1.1_dp) < 1d-15))
    call surfaces%pair_rigid(places, slave, places(:, 3:), master - 2, info, message=message)
    call expect('rigid', info == 0 .and. message == '' .and. surfaces%pairs == 2 .and. &
        all(abs(surfaces%gap - 0.1_dp) < 1d-15))
    call surfaces%pair_rigid(places, slave, places(:, 3:), master, info, message=message)
    call expect('rigid node', info == -4 .and. index(message, 'obstacle face 1 has node 5, the') == 1)
    ! Node 1 stands on the line x = 0: its pair has no friction across it, that of node 2 has.
    call surfaces%pair(places, slave, master, info, symmetry_axes=[1], symmetry_at=[0._dp], message=message)
    call expect('symmetry', info == 0 .and. message == '' .and. surfaces%data%on_symmetry == 1)
    call model%new_surfaces(starts, rows, [(2._dp, i=1, 10)], SIGNORINI_TRIANGLE_LOWER, surfaces, info, &
        fixed=[1], message=message)
    load = 0
    load([2, 3, 4]) = [-1._dp, 0.1_dp, -1._dp]
    call model%solve(load, surfaces%gap, d, force, info, friction=[0.3_dp, 0.3_dp], message=message)
    call expect('no slip', info == 0 .and. d(2) == 0 .and. force(2) == 0 .and. abs(force(4)) > 0)
    call surfaces%pair(places, slave, master, info, symmetry_axes=[3], symmetry_at=[0._dp], message=message)
    call expect('axis', info == -6 .and. index(message, 'there is no axis 3, the last one is 2') > 0)
    call surfaces%pair(places, slave, master, info, symmetry_axes=[1, 2], symmetry_at=[0._dp], message=message)
    call expect('both', info == -10 .and. index(message, 'symmetry_axes has 2 entries and symmetry_at 1') == 1)
    call the_choices()
    apart = places
    apart(2, :2) = 9
    call surfaces%pair(apart, slave, master, info)
    call expect('never meet', info == 0 .and. surfaces%pairs == 0 .and. &
        index(surfaces%summary(), 'no pairs: nothing lies opposite') == 1)

    call surfaces%pair(places, reshape([2, 2], [2, 1]), master, info, message=message)
    call expect('twice', info == -2 .and. message == 'slave face 1 has node 2 twice')
    call surfaces%pair(places, slave, reshape([5, 6], [2, 1]), info, message=message)
    call expect('missing', info == -3 .and. index(message, 'master face 1 has node 6, the') == 1)
    call surfaces%pair(places, slave, master, info, pairing=5, message=message)
    call expect('pairing', info == -5)
    call surfaces%pair(places, slave, master, info, search_distance=0._dp, message=message)
    call expect('distance', info == -6)
    call surfaces%pair(places, slave, master, info, dofs=master, message=message)
    call expect('dofs', info == -7)
    plane%direction = 0
    call surfaces%pair_obstacle(places, slave, plane, info, message=message)
    call expect('direction', info == -3 .and. index(message, 'outward direction is zero') > 0)

    if (failed /= 0) stop 1
    print '(a)', 'surfaces: pairs, fields, obstacles, refusals'
contains
    ! The side and the bottom of a block, a sharp edge at node 2, over a floor that ends under a tenth of the last face.
    subroutine the_choices()
        real(dp), parameter :: around(2, 6) = reshape([0._dp, 1.1_dp, 0._dp, 0.1_dp, 1._dp, 0.1_dp, 1.2_dp, &
            0.1_dp, -1._dp, 0._dp, 1.02_dp, 0._dp], [2, 6])
        integer, parameter :: sides(2, 3) = reshape([1, 2, 2, 3, 3, 4], [2, 3])
        integer, parameter :: floor(2, 1) = reshape([6, 5], [2, 1])
        type(signorini_surface_settings) :: limits
        type(signorini_obstacle), target :: plane
        ! By dual mortar the side, which lies over nothing, has no say in the averaged normal.
        real(dp), parameter :: averaged(2, 2) = reshape([0._dp, -1._dp, -sqrt(0.5_dp), -sqrt(0.5_dp)], [2, 2])
        integer :: pairing, rims
        do pairing = SIGNORINI_PAIRING_DUAL_MORTAR, SIGNORINI_PAIRING_NODE_TO_SURFACE
            call surfaces%pair(around, sides, floor, info, pairing=pairing, search_distance=0.5_dp, &
                normals=int(SIGNORINI_NORMALS_AVERAGED), message=message)
            call expect('averaged', info == 0 .and. all(abs(surfaces%normal(:, 1) - averaged(:, pairing + 1)) < 1d-15))
            call surfaces%pair(around, sides, floor, info, pairing=pairing, search_distance=0.5_dp, &
                normals=int(SIGNORINI_NORMALS_FACES), message=message)
            call expect('of faces', info == 0 .and. all(abs(surfaces%normal(:, 1) - [0, -1]) < 1d-15))
        end do
        do rims = SIGNORINI_RIMS_FOLD, SIGNORINI_RIMS_FOLD_LITTLE
            call surfaces%pair(around, sides, floor, info, search_distance=0.5_dp, rims=rims, message=message)
            call expect('rims', info == 0 .and. surfaces%pairs == merge(3, 2, rims == SIGNORINI_RIMS_KEEP))
            call expect('folded', surfaces%data%n_folded == merge(1, 0, rims /= SIGNORINI_RIMS_KEEP))
        end do
        call surfaces%pair_rigid(around(:, :4), sides, around(:, 5:), floor - 4, info, search_distance=0.5_dp, &
            normals=int(SIGNORINI_NORMALS_FACES), rims=int(SIGNORINI_RIMS_KEEP), message=message)
        call expect('rigid choices', info == 0 .and. surfaces%data%n_folded == 0 .and. surfaces%pairs == 3)
        limits%time_limit = 1e-12_dp
        call surfaces%pair(around, sides, floor, info, search_distance=0.5_dp, message=message, settings=limits)
        call expect('time limit', info == SIGNORINI_STATUS_TIME_LIMIT)
        limits%time_limit = 0
        limits%axisymmetric = 1
        call surfaces%pair(reshape([0._dp, 0._dp, 1._dp, 0._dp, 0._dp, 0._dp, 1._dp, 0._dp], [2, 4]), &
            sides(:, 1:1), reshape([4, 3], [2, 1]), info, message=message, settings=limits)
        call expect('rings', info == 0 .and. abs(sum(surfaces%area) - acos(-1._dp)) < 1d-14)
        limits%axisymmetric = 0
        limits%clearance = -0.5_dp
        plane = signorini_obstacle(kind=SIGNORINI_OBSTACLE_PLANE, point=[7._dp, 0.2_dp, 0._dp], &
            direction=[0._dp, 1._dp, 0._dp])
        limits%slave_shape = c_loc(plane)
        call surfaces%pair(reshape([0._dp, 0.1_dp, 1._dp, 0.1_dp, -1._dp, 0._dp, 2._dp, 0._dp], [2, 4]), &
            reshape([1, 2], [2, 1]), reshape([4, 3], [2, 1]), info, message=message, settings=limits)
        call expect('true shape', info == 0 .and. all(abs(surfaces%gap - (0.2_dp - 0.5_dp)) < 1d-14))
        call surfaces%pair(around, sides, floor, info, normals=2, message=message)
        call expect('normals', info == -11 .and. message == 'there is no choice of normals 2')
        call surfaces%pair(around, sides, floor, info, rims=-1, message=message)
        call expect('no rims', info == -12 .and. message == 'there is no choice of rims -1')
        call surfaces%pair(around, sides, floor, info, pairing=int(SIGNORINI_PAIRING_NODE_TO_SURFACE), &
            rims=int(SIGNORINI_RIMS_KEEP), message=message)
        call expect('no cover', info == -6 .and. index(message, 'rims: nodes against surfaces have no cover') == 1)
    end subroutine

    subroutine expect(what, holds)
        character(len=*), intent(in) :: what
        logical, intent(in) :: holds
        if (holds) return
        failed = failed + 1
        print '(a, ": wrong, info ", i0, " ", a)', what, info, trim(message)
    end subroutine
end program
