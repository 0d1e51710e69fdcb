! The bar on the plane by a host that has MUMPS: its factorisation leaves the Schur complement on
! the contact components, its forward elimination the condensed loads, and the library finds the
! contact forces. Then MUMPS goes back to the displacements of the whole mesh. It prints d_n, d_t,
! F_n, F_t of each node of the contact side, in mm and daN.
program mumps_schur
    use bar_mesh
    use signorini
    implicit none
    include 'mpif.h'
    include 'dmumps_struc.h'
    integer, parameter :: n = 2*pairs
    type(dmumps_struc) :: id
    integer :: error, info, p, state(pairs), row, column
    real(dp) :: k(n, n), f(n), gap(pairs), mu(pairs), d(n), force(n), turn(n)
    integer :: from(n)
    character(len=256) :: message

    call mpi_init(error)
    id%comm = mpi_comm_world
    id%par = 1
    id%sym = 2
    id%job = -1
    call dmumps(id)
    id%icntl(1:4) = 0
    id%n = components
    id%nz = triplets + rows + 1
    allocate (id%irn(id%nz), id%jcn(id%nz), id%a(id%nz), id%rhs(id%n))
    call bar_assemble(id%irn(1:triplets), id%jcn(1:triplets), id%a(1:triplets), id%rhs)
    call hold

    ! The Schur complement, both triangles by columns on the one process.
    id%icntl(19) = 3
    id%size_schur = n
    allocate (id%listvar_schur(n), id%schur(n*n), id%redrhs(n))
    id%listvar_schur = [(p, p=1, n)]
    id%nprow = 1
    id%npcol = 1
    id%mblock = 100
    id%nblock = 100
    id%schur_lld = n
    id%job = 4
    call run
    id%nrhs = 1
    id%lrhs = components
    id%lredrhs = n
    id%icntl(26) = 1
    id%job = 3
    call run

    ! (u_x, u_y) to (d_n, d_t) = (-u_y, u_x): mixed entries of the stiffness change their sign.
    do p = 1, pairs
        from(2*p - 1:2*p) = [2*p, 2*p - 1]
        turn(2*p - 1:2*p) = [-1d0, 1d0]
    end do
    do column = 1, n
        do row = 1, n
            ! Symmetric: one triangle of it will do.
            k(row, column) = turn(row)*turn(column) &
                *id%schur(min(from(row), from(column)) + (max(from(row), from(column)) - 1)*n)
        end do
        f(column) = turn(column)*id%redrhs(from(column))
    end do
    gap = 0
    mu = 1
    call contact_solve(k, f, gap, mu, d, force, info, state=state, tolerance=1d-13, message=message)
    if (info /= SIGNORINI_SOLVED) then
        print '(a, i0, 2a)', 'info = ', info, ': ', trim(message)
        stop 1
    end if
    call bar_print(state, d, force)

    ! Back: the solution on the contact side in, the whole one out.
    id%redrhs(from) = turn*d
    id%icntl(26) = 2
    call run
    if (maxval(abs(id%rhs(from) - turn*d)) > 1d-14) stop 3
    print '(a, es20.12)', 'u_x of the upper left corner', id%rhs(2*pairs*rows + 1)
    id%job = -2
    call dmumps(id)
    call mpi_finalize(error)
contains
    subroutine run
        call dmumps(id)
        if (id%infog(1) < 0) then
            print '(a, i0, a, i0)', 'MUMPS: INFOG(1) = ', id%infog(1), ', INFOG(2) = ', id%infog(2)
            stop 2
        end if
    end subroutine

    ! A held component stays as a decoupled row with a diagonal entry and no load.
    subroutine hold
        integer :: held(rows + 1), t
        held = bar_held()
        do t = 1, triplets
            if (any(held == id%irn(t)) .or. any(held == id%jcn(t))) id%a(t) = 0
        end do
        id%irn(triplets + 1:) = held
        id%jcn(triplets + 1:) = held
        id%a(triplets + 1:) = 13000
        id%rhs(held) = 0
    end subroutine
end program
