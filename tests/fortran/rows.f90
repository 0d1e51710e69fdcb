! General rows: lists of nodes with signed weights, by the module and by Fortran 77; equations between degrees of
! freedom.
!
! Node A (degrees of freedom 1, 2) and node B (3, 4), each on springs of stiffness 2.
program rows
    use signorini
    implicit none
    integer, parameter :: dp = c_double
    integer, parameter :: starts(5) = [1, 2, 3, 4, 5], places(4) = [1, 2, 3, 4]
    real(dp), parameter :: springs(4) = 2
    type(contact_model) :: model
    real(dp) :: k(2, 2), d(4), force(4), nodal(4), shared(4, 4), none(4), eta
    integer :: info, failed, first(2), two(2, 2), state(1), sweeps
    integer(c_int64_t) :: handle
    character(len=256) :: message

    failed = 0
    ! A on B: two springs of 2 in a row are one of 1.
    two = reshape([1, 2, 3, 4], [2, 2])
    call model%new_sparse_rows(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, [1, 3], two, &
        [1._dp, -1._dp], reshape([0._dp, -1._dp], [2, 1]), info, message=message)
    call expect('row', info == 0 .and. message == '')
    call model%stiffness(k, info)
    call expect('stiffness', info == 0 .and. all(abs(k - reshape([1, 0, 0, 1], [2, 2])) < 1e-14_dp))
    call model%release()

    ! A by numbers beyond the matrix, in axes that are turned by a quarter: its x is -u(2), its y is u(1).
    two = reshape([7, 8, 3, 4], [2, 2])
    call model%new_sparse_rows(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, [1, 3], two, &
        [1._dp, -1._dp], reshape([0._dp, -1._dp], [2, 1]), info, message=message, equations=quarter())
    call expect('equations', info == 0 .and. message == '')
    ! n = (0, -1) and t = (1, 0): the force (1, 3) on A.
    call model%nodal_forces([-3._dp, 1._dp], nodal, info)
    call expect('their forces', info == 0 .and. all(abs(nodal - [3._dp, -1._dp, -1._dp, -3._dp]) < 1e-14_dp))
    call model%release()
    call model%new_sparse(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, reshape([7, 8], [2, 1]), &
        reshape([0._dp, -1._dp], [2, 1]), info, message=message, equations=quarter())
    call expect('equations of a slave', info == 0 .and. message == '')
    call model%release()
    call model%new_sparse(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, reshape([7, 8], [2, 1]), &
        reshape([0._dp, -1._dp], [2, 1]), info, message=message, &
        equations=contact_equations([7, 8], [1, 2, 3], [2, 8], [-1._dp, 1._dp]))
    call expect('a circle', info == -5 .and. index(message, 'equation 2: its dependent degree of freedom') == 1 &
        .and. index(message, 'by way of 8') > 0)
    call model%new_sparse(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, reshape([7, 8], [2, 1]), &
        reshape([0._dp, -1._dp], [2, 1]), info, message=message, &
        equations=contact_equations([7, 8], [1, 3], [2, 1], [-1._dp, 1._dp]))
    call expect('starts of equations', info == -16 .and. index(message, 'equations%start has 2 entries') == 1)

    ! A on the floor and at a wall, pressed by (1, -1): the smallest forces share the load.
    two = reshape([1, 2, 1, 2], [2, 2])
    call model%new_sparse_rows(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, [1, 2, 3], two, &
        [1._dp, 1._dp], reshape([0._dp, -1._dp, 1._dp, 0._dp], [2, 2]), info)
    call expect('corner', info == 0)
    call model%solve([1._dp, -1._dp, 0._dp, 0._dp], [0._dp, 0._dp], d, force, info, &
        friction=[0.25_dp, 0.25_dp])
    call expect('its solution', info == 0 .and. all(abs(d) < 1e-8_dp))
    call expect('its forces', all(abs(abs(force) - [0.8_dp, 0.2_dp, 0.8_dp, 0.2_dp]) < 1e-8_dp))
    call model%certify([1._dp, -1._dp, 0._dp, 0._dp], [0._dp, 0._dp], d, info, friction=[0.25_dp, 0.25_dp], &
        force=force)
    call expect('certificate of d and forces', info == 0)
    none = 0
    call model%certify([1._dp, -1._dp, 0._dp, 0._dp], [0._dp, 0._dp], d, info, friction=[0.25_dp, 0.25_dp], &
        force=none)
    call expect('other forces', info == SIGNORINI_STATUS_NOT_A_SOLUTION)
    call model%nodal_forces(force, nodal, info)
    call expect('nodal forces', info == 0 .and. &
        all(abs(nodal - [-1._dp, 1._dp, 0._dp, 0._dp]) < 1e-8_dp))
    call model%stiffness(shared, info, message)
    call expect('no stiffness', info < 0 .and. index(message, 'the rows of pair') > 0)
    call model%release()

    call model%new_sparse_rows(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, [1, 3], two, &
        [1._dp, 1._dp], reshape([0._dp, -1._dp], [2, 1]), info, message=message)
    call expect('weights', info == -6 .and. index(message, 'pair 1: its signed weights sum to 2') > 0)
    call model%new_sparse_rows(starts, places, springs, SIGNORINI_TRIANGLE_LOWER, [1, 2], two, &
        [1._dp, 1._dp], reshape([0._dp, -1._dp], [2, 1]), info, message=message)
    call expect('starts', info == -5)

    ! That node as a flexibility of 1/2: W = B B' / 2 of floor and wall, and q = B f / 2.
    shared = reshape([1, 0, 0, -1, 0, 1, 1, 0, 0, 1, 1, 0, -1, 0, 0, 1], [4, 4]) / 2._dp
    call contact_solve_flexibility(shared, [1, 1, 1, -1] / 2._dp, [0._dp, 0._dp], d, force, info, &
        friction=[0.25_dp, 0.25_dp], message=message)
    call expect('flexibility', info == 0 .and. message == '' .and. all(abs(d) < 1e-8_dp))
    call expect('its forces', all(abs(abs(force) - [0.8_dp, 0.2_dp, 0.8_dp, 0.2_dp]) < 1e-8_dp))
    ! By columns, its lower triangle.
    call contact_solve_flexibility_sparse([1, 3, 5, 6, 7], [1, 4, 2, 3, 3, 4], &
        [1, -1, 1, 1, 1, 1] / 2._dp, SIGNORINI_TRIANGLE_LOWER, [1, 1, 1, -1] / 2._dp, [0._dp, 0._dp], &
        d, force, info, friction=[0.25_dp, 0.25_dp], message=message)
    call expect('sparse flexibility', info == 0 .and. message == '' .and. all(abs(d) < 1e-8_dp))
    call expect('forces of it', all(abs(abs(force) - [0.8_dp, 0.2_dp, 0.8_dp, 0.2_dp]) < 1e-8_dp))
    call contact_solve_flexibility_sparse([1, 3, 5, 6, 7], [1, 4, 2, 3, 3, 4], &
        [1, -1, 1, 1, -1, 1] / 2._dp, SIGNORINI_TRIANGLE_LOWER, [1, 1, 1, -1] / 2._dp, [0._dp, 0._dp], &
        d, force, info, message=message)
    call expect('no sparse one', info == -3 .and. index(message, 'W(3,3) is -0.5') > 0)
    call contact_solve_flexibility_sparse([1, 3, 5, 6], [1, 4, 2, 3, 3], &
        [1, -1, 1, 1, 1] / 2._dp, SIGNORINI_TRIANGLE_LOWER, [1, 1, 1, -1] / 2._dp, [0._dp, 0._dp], &
        d, force, info, message=message)
    call expect('size of it', info == -1 .and. index(message, 'col_start has 4 entries') > 0)
    shared(2, 2) = -1
    call contact_solve_flexibility(shared, [1, 1, 1, -1] / 2._dp, [0._dp, 0._dp], d, force, info, &
        message=message)
    call expect('no flexibility', info == -1 .and. index(message, 'W(2,2) is -1') > 0)
    call contact_solve_flexibility(shared, [1._dp, 1._dp], [0._dp, 0._dp], d, force, info, &
        message=message)
    call expect('its size', info < 0 .and. index(message, 'q has 2 entries') > 0)

    ! Fortran 77, with the row of the beginning: SLAVE(1,1) is -1.
    first = -1
    two = reshape([1, 2, 3, 4], [2, 2])
    call SGSPAR(4, 4, starts, places, springs, 0, 0, first, 2, 1, first, 2, [1, 3], two, &
        [1._dp, -1._dp], [0._dp, -1._dp], 0, [0._dp], handle, info)
    call expect('SGSPAR', info == 0)
    ! A pressed on B by 4: both springs take 2 each, and yield by 1.
    call SGCASE(handle, [0._dp, -4._dp, 0._dp, 0._dp], [0._dp], [0._dp], 0, [0._dp], [0._dp], 0, 0._dp, 0, &
        d, force, state, eta, sweeps, info)
    call expect('SGCASE', info == 0 .and. all(abs(force(:2) - [-2, 0]) < 1e-9_dp) .and. eta <= 1e-10_dp)
    call SGRECV(handle, [0._dp, -4._dp, 0._dp, 0._dp], [0._dp], d, nodal, info)
    call expect('SGRECV', info == 0 .and. all(abs(nodal - [0, -1, 0, -1]) < 1e-9_dp))
    call SGFREE(handle, info)
    call SGSPAR(4, 4, starts, places, springs, 0, 0, first, 2, 1, first, 0, [1, 3], two, &
        [1._dp, -1._dp], [0._dp, -1._dp], 0, [0._dp], handle, info)
    call expect('no nodes', info == -12)

    if (failed /= 0) stop 1
    print '(a)', 'rows: as pairs, and in a corner'
contains
    function quarter()
        type(contact_equations) :: quarter
        quarter = contact_equations([8, 7], [1, 2, 3], [1, 2], [1._dp, -1._dp])
    end function

    subroutine expect(what, holds)
        character(len=*), intent(in) :: what
        logical, intent(in) :: holds
        if (holds) return
        failed = failed + 1
        print '(a, ": wrong, info ", i0, " ", a)', what, info, trim(message)
    end subroutine
end program
