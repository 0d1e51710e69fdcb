! The bar on the plane by a host on several processes that has MUMPS: each process assembles some
! columns of the bar, MUMPS leaves the Schur complement and the condensed loads on process 0, where
! the library finds the contact forces, and each process gets a part of the displacements. Process 0
! prints d_n, d_t, F_n, F_t of each node of the contact side, in mm and daN, and all compare with the
! library alone on the whole matrix. At most 32 processes.
program mumps_schur_mpi
    use bar_mesh
    use signorini
    implicit none
    include 'mpif.h'
    include 'dmumps_struc.h'
    integer, parameter :: n = 2*pairs
    real(dp), parameter :: tolerance = 1d-13, limit = 1d-9
    type(dmumps_struc) :: id
    integer :: error, rank, processes, info, p, state(pairs), from(n)
    real(dp) :: d(n), force(n), turn(n), load(components), whole(components), gap(pairs), mu(pairs)
    character(len=256) :: message

    call mpi_init(error)
    call mpi_comm_rank(mpi_comm_world, rank, error)
    call mpi_comm_size(mpi_comm_world, processes, error)
    gap = 0
    mu = 1
    ! (u_x, u_y) to (d_n, d_t) = (-u_y, u_x): mixed entries of the stiffness change their sign.
    do p = 1, pairs
        from(2*p - 1:2*p) = [2*p, 2*p - 1]
        turn(2*p - 1:2*p) = [-1d0, 1d0]
    end do

    id%comm = mpi_comm_world
    id%par = 1
    id%sym = 1
    id%job = -1
    call dmumps(id)
    id%icntl(1:4) = 0
    id%icntl(14) = 200 ! MUMPS estimates too little memory for a small matrix on several processes.
    call give_matrix
    call condense
    if (rank == 0) call solve_contact
    call expand
    call compare
    id%job = -2
    call dmumps(id)
    call mpi_finalize(error)
contains
    subroutine run(job)
        integer, intent(in) :: job
        id%job = job
        call dmumps(id)
        if (id%infog(1) < 0) then
            print '(a, i0, a, i0)', 'MUMPS: INFOG(1) = ', id%infog(1), ', INFOG(2) = ', id%infog(2)
            call give_up
        end if
    end subroutine

    subroutine give_up
        call mpi_abort(mpi_comm_world, 1, error)
    end subroutine

    ! The matrix of this process's columns, and its shares of the loads: MUMPS adds what several
    ! processes give of an entry. A held component stays as a decoupled row with a diagonal entry,
    ! from process 0, and no load.
    subroutine give_matrix
        integer :: held(rows + 1), first, last, own, t, node
        logical :: mine(components)
        first = rank*columns/processes + 1
        last = (rank + 1)*columns/processes
        own = 36*rows*(last - first + 1)
        held = bar_held()
        id%icntl(18) = 3
        id%n = components
        id%nz_loc = own
        if (rank == 0) id%nz_loc = own + rows + 1
        allocate (id%irn_loc(id%nz_loc), id%jcn_loc(id%nz_loc), id%a_loc(id%nz_loc))
        call bar_assemble(id%irn_loc(1:own), id%jcn_loc(1:own), id%a_loc(1:own), load, first, last)
        do t = 1, own
            if (any(held == id%irn_loc(t)) .or. any(held == id%jcn_loc(t))) id%a_loc(t) = 0
        end do
        if (rank == 0) then
            id%irn_loc(own + 1:) = held
            id%jcn_loc(own + 1:) = held
            id%a_loc(own + 1:) = 13000
        end if
        load(held) = 0

        ! Loads of the nodes of these columns.
        do p = 1, components
            node = mod((p - 1)/2, pairs)
            mine(p) = node >= first - 1 .and. node <= last
        end do
        id%nloc_rhs = count(mine)
        id%lrhs_loc = id%nloc_rhs
        allocate (id%irhs_loc(id%nloc_rhs), id%rhs_loc(id%nloc_rhs))
        id%irhs_loc = pack([(p, p=1, components)], mine)
        id%rhs_loc = pack(load, mine)
    end subroutine

    ! The Schur complement, both triangles by columns on process 0; SCHUR must be there on all.
    subroutine condense
        id%icntl(19) = 3
        id%size_schur = n
        allocate (id%listvar_schur(n), id%schur(n*n), id%redrhs(n))
        id%listvar_schur = [(p, p=1, n)]
        id%nprow = 1
        id%npcol = 1
        id%mblock = 100
        id%nblock = 100
        id%schur_lld = n
        call run(4)
        id%nrhs = 1
        id%lredrhs = n
        id%icntl(20) = 10
        id%icntl(21) = 1
        id%lsol_loc = id%info(23)
        allocate (id%isol_loc(id%lsol_loc), id%sol_loc(id%lsol_loc))
        id%icntl(26) = 1
        call run(3)
    end subroutine

    subroutine solve_contact
        type(contact_model) :: model
        real(dp) :: schur(n, n), k(n, n), f(n)
        schur = reshape(id%schur, [n, n])
        k = spread(turn, 2, n)*spread(turn, 1, n)*schur(from, from)
        f = turn*id%redrhs(from)
        call model%new_condensed(2, k, info, message=message)
        call check
        call model%solve(f, gap, d, force, info, friction=mu, tolerance=tolerance, state=state, &
            message=message)
        call check
        call model%release()
        call bar_print(state, d, force)
    end subroutine

    subroutine check
        if (info == 0) return
        print '(a, i0, 2a)', 'info = ', info, ': ', trim(message)
        call give_up
    end subroutine

    ! Back: the solution on the contact side in, a part of the whole one out on each process.
    subroutine expand
        if (rank == 0) id%redrhs(from) = turn*d
        id%icntl(26) = 2
        call run(3)
    end subroutine

    ! `whole` on process 0: the displacements as the library finds them by itself.
    subroutine solve_alone
        integer :: i(triplets), j(triplets), starts(components + 1), slaves(2, pairs)
        integer, allocatable :: lines(:)
        real(dp) :: value(triplets), normals(2, pairs), all_load(components), serial(n), reaction(n)
        real(dp), allocatable :: values(:)
        type(contact_model) :: model
        call bar_assemble(i, j, value, all_load)
        call bar_compress(i, j, value, starts, lines, values)
        slaves = reshape([(p, p=1, n)], [2, pairs])
        normals(1, :) = 0
        normals(2, :) = -1
        call model%new_sparse(starts, lines, values, SIGNORINI_TRIANGLE_LOWER, slaves, normals, info, &
            fixed=bar_held(), message=message)
        call check
        call model%solve(all_load, gap, serial, reaction, info, friction=mu, tolerance=tolerance, &
            message=message)
        call check
        call model%recover(all_load, serial, whole, info, message=message)
        call check
        call model%release()
    end subroutine

    subroutine compare
        real(dp) :: off, largest, told, all_told
        if (rank == 0) call solve_alone
        call mpi_bcast(whole, components, mpi_double_precision, 0, mpi_comm_world, error)
        off = maxval(abs(id%sol_loc - whole(id%isol_loc)))/maxval(abs(whole))
        call mpi_reduce(off, largest, 1, mpi_double_precision, mpi_max, 0, mpi_comm_world, error)
        told = id%lsol_loc
        call mpi_reduce(told, all_told, 1, mpi_double_precision, mpi_sum, 0, mpi_comm_world, error)
        if (rank /= 0) return
        print '(i0, a, i0, a, es8.1, a)', nint(all_told), ' displacements on ', processes, &
            ' processes, off by', largest, ' of the largest (limit 1e-09)'
        if (.not. largest <= limit .or. nint(all_told) /= components) call give_up
    end subroutine
end program
