! The bar on the plane in Fortran 2008: the whole sparse matrix goes to the library, which condenses
! it, finds contact and friction, and recovers the displacements of the whole mesh. It prints
! d_n, d_t, F_n, F_t of each node of the contact side, in mm and daN.
program bar_sparse
    use bar_mesh
    use signorini
    implicit none
    integer :: i(triplets), j(triplets), starts(components + 1), slaves(2, pairs), state(pairs), info, p
    integer, allocatable :: lines(:)
    real(dp) :: value(triplets), load(components), normals(2, pairs), gap(pairs), mu(pairs)
    real(dp) :: d(2*pairs), force(2*pairs), u(components), nodal(components)
    real(dp), allocatable :: values(:)
    type(contact_model) :: model
    type(signorini_report) :: report
    character(len=256) :: message

    call bar_assemble(i, j, value, load)
    call bar_compress(i, j, value, starts, lines, values)
    slaves = reshape([(p, p=1, 2*pairs)], [2, pairs])
    normals(1, :) = 0
    normals(2, :) = -1
    gap = 0
    mu = 1

    call model%new_sparse(starts, lines, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
        fixed=bar_held(), message=message)
    if (info /= 0) call give_up
    call model%solve(load, gap, d, force, info, friction=mu, tolerance=1d-13, state=state, &
        report=report, message=message)
    if (info /= SIGNORINI_STATUS_SOLVED) call give_up
    call model%recover(load, d, u, info, message=message)
    if (info /= 0) call give_up
    call model%nodal_forces(force, nodal, info, message=message)
    if (info /= 0) call give_up
    call model%release()

    print '(a, es8.1)', 'solved and certified, eta =', report%eta
    call bar_print(state, d, force)
    ! On the contact side d_n = -u_y, d_t = u_x, and what holds the bar up is its load.
    if (maxval(abs(u(2:2*pairs:2) + d(1::2))) > 1d-15) stop 2
    if (maxval(abs(u(1:2*pairs:2) - d(2::2))) > 1d-15) stop 3
    if (abs(sum(nodal(2::2)) - 200) > 1d-8) stop 4
contains
    subroutine give_up
        print '(a, i0, 2a)', 'info = ', info, ': ', trim(message)
        stop 1
    end subroutine
end program
