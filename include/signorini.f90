! signorini: unilateral contact with Coulomb friction, for Fortran.
!
! Compile this file with your program: the module has no object code of its own to be delivered.
!
! Two layers. The functions signorini_... are those of signorini.h, argument by argument: that
! header is their reference. In front of them stand contact_solve, contact_tresca, contact_certify,
! lcp_solve and the type contact_model, which take assumed-shape arrays, optional arguments and
! default integers, find the sizes out by themselves and count from 1.
!
! Of these, info is the status of signorini.h: 0 solved and certified; > 0 results were written but
! are not a solution; < 0 an argument is wrong. message, of any length, is a sentence that tells
! what and where; where it is the library's own, entries in it count from 0: K[row,column].
module signorini
    use, intrinsic :: iso_c_binding
    implicit none
    public

    integer(c_int32_t), parameter :: SIGNORINI_SOLVED = 0
    integer(c_int32_t), parameter :: SIGNORINI_ITERATION_LIMIT = 1
    integer(c_int32_t), parameter :: SIGNORINI_TIME_LIMIT = 2
    integer(c_int32_t), parameter :: SIGNORINI_CANCELLED = 3
    integer(c_int32_t), parameter :: SIGNORINI_NO_EQUILIBRIUM = 4
    integer(c_int32_t), parameter :: SIGNORINI_STALLED = 5
    integer(c_int32_t), parameter :: SIGNORINI_NOT_A_SOLUTION = 6
    integer(c_int32_t), parameter :: SIGNORINI_INTERNAL = -1000
    integer(c_int32_t), parameter :: SIGNORINI_OUT_OF_MEMORY = -1001
    integer(c_int32_t), parameter :: SIGNORINI_FILE = -1002
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_MAJOR = 0
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_MINOR = 1
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_PATCH = 0
    integer(c_int32_t), parameter :: SIGNORINI_ABI_VERSION = 1
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_AUTO = 0
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_SOR_NESTED = 1
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_SOR_DIAGONAL = 2
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_LEMKE = 3
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_PIVOT = 4
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_NEWTON = 5
    integer(c_int32_t), parameter :: SIGNORINI_SEARCH_OFF = 0
    integer(c_int32_t), parameter :: SIGNORINI_SEARCH_OTHERS = 1
    integer(c_int32_t), parameter :: SIGNORINI_SEARCH_RETURN_SECOND = 2
    integer(c_int32_t), parameter :: SIGNORINI_OPEN = 0
    integer(c_int32_t), parameter :: SIGNORINI_SLIP = 1
    integer(c_int32_t), parameter :: SIGNORINI_STICK = 2
    integer(c_int32_t), parameter :: SIGNORINI_NOT_KNOWN = 0
    integer(c_int32_t), parameter :: SIGNORINI_UNIQUE = 1
    integer(c_int32_t), parameter :: SIGNORINI_SEVERAL = 2
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_NONE = 0
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_CYCLE = 1
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_SINGULAR = 2
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_UNSTABLE = 3
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_INACCURATE = 4
    integer(c_int32_t), parameter :: SIGNORINI_LOWER = 0
    integer(c_int32_t), parameter :: SIGNORINI_UPPER = 1
    integer(c_int32_t), parameter :: SIGNORINI_FULL = 2
    integer(c_int32_t), parameter :: SIGNORINI_PROBLEM_COULOMB = 0
    integer(c_int32_t), parameter :: SIGNORINI_PROBLEM_TRESCA = 1
    integer(c_int32_t), parameter :: SIGNORINI_PROBLEM_LCP = 2

    type, bind(C) :: signorini_progress
        integer(c_int64_t) :: iterations = 0
        real(c_double) :: eta = 0
        real(c_double) :: elapsed = 0
    end type

    type, bind(C) :: signorini_settings
        integer(c_int32_t) :: struct_size = 0
        integer(c_int32_t) :: method = 0
        real(c_double) :: tolerance = 0
        real(c_double) :: omega = 0
        real(c_double) :: damping = 0
        integer(c_int64_t) :: max_iterations = 0
        real(c_double) :: time_limit = 0
        integer(c_int32_t) :: warm_start = 0
        integer(c_int32_t) :: search = 0
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
    end type

    type, bind(C) :: signorini_report
        integer(c_int32_t) :: struct_size = 0
        integer(c_int32_t) :: status = 0
        integer(c_int32_t) :: method = 0
        integer(c_int32_t) :: uniqueness = 0
        integer(c_int64_t) :: iterations = 0
        integer(c_int64_t) :: outer_iterations = 0
        integer(c_int64_t) :: refactorisations = 0
        real(c_double) :: eta = 0
        real(c_double) :: rounding = 0
        real(c_double) :: penetration = 0
        real(c_double) :: tension = 0
        real(c_double) :: cone_excess = 0
        real(c_double) :: equilibrium = 0
        real(c_double) :: omega = 0
        real(c_double) :: damping = 0
        integer(c_int64_t) :: open = 0
        integer(c_int64_t) :: slip = 0
        integer(c_int64_t) :: stick = 0
        integer(c_int64_t) :: factorisations = 0
        integer(c_int32_t) :: first_method = 0
        integer(c_int32_t) :: fallback = 0
        integer(c_int32_t) :: orientation = 0
        integer(c_int32_t) :: reserved = 0
    end type

    type, bind(C) :: signorini_sparse
        integer(c_int32_t) :: struct_size = 0
        integer(c_int32_t) :: index_bytes = 0
        integer(c_int32_t) :: base = 0
        integer(c_int32_t) :: triangle = 0
        integer(c_int64_t) :: size = 0
        integer(c_int64_t) :: entries = 0
        type(c_ptr) :: starts = c_null_ptr
        type(c_ptr) :: rows = c_null_ptr
        type(c_ptr) :: values = c_null_ptr
    end type

    type, bind(C) :: signorini_pairs
        integer(c_int32_t) :: struct_size = 0
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: pairs = 0
        type(c_ptr) :: slaves = c_null_ptr
        type(c_ptr) :: master_starts = c_null_ptr
        type(c_ptr) :: masters = c_null_ptr
        type(c_ptr) :: weights = c_null_ptr
        type(c_ptr) :: normals = c_null_ptr
        type(c_ptr) :: tangents = c_null_ptr
    end type

    interface
        function signorini_version() &
            bind(C, name="signorini_version") result(answer)
            import
            type(c_ptr) :: answer
        end function
        ! Fortran knows no upper case: the name of C is that of the constant.
        function signorini_library_abi_version() &
            bind(C, name="signorini_abi_version") result(answer)
            import
            integer(c_int32_t) :: answer
        end function
        function signorini_status_string(status) &
            bind(C, name="signorini_status_string") result(answer)
            import
            integer(c_int32_t), value :: status
            type(c_ptr) :: answer
        end function
        function signorini_last_error() &
            bind(C, name="signorini_last_error") result(answer)
            import
            type(c_ptr) :: answer
        end function
        function signorini_settings_default(settings, struct_size) &
            bind(C, name="signorini_settings_default") result(answer)
            import
            type(signorini_settings), intent(out) :: settings
            integer(c_int32_t), value :: struct_size
            integer(c_int32_t) :: answer
        end function
        function signorini_solve(dim, pairs, k, ldk, f, gap, mu, slip, settings, d, force, &
            state, report) &
            bind(C, name="signorini_solve") result(answer)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            real(c_double), intent(in) :: f(*)
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: mu(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: settings
            real(c_double), intent(inout) :: d(*)
            real(c_double), intent(out) :: force(*)
            type(c_ptr), value :: state
            type(c_ptr), value :: report
            integer(c_int32_t) :: answer
        end function
        function signorini_tresca(dim, pairs, k, ldk, f, gap, g, slip, settings, d, force, &
            state, report) &
            bind(C, name="signorini_tresca") result(answer)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            real(c_double), intent(in) :: f(*)
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: g(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: settings
            real(c_double), intent(inout) :: d(*)
            real(c_double), intent(out) :: force(*)
            type(c_ptr), value :: state
            type(c_ptr), value :: report
            integer(c_int32_t) :: answer
        end function
        function signorini_certify(dim, pairs, k, ldk, f, gap, mu, slip, tolerance, d, force, &
            state, report) &
            bind(C, name="signorini_certify") result(answer)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            real(c_double), intent(in) :: f(*)
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: mu(*)
            type(c_ptr), value :: slip
            real(c_double), value :: tolerance
            real(c_double), intent(in) :: d(*)
            type(c_ptr), value :: force
            type(c_ptr), value :: state
            type(c_ptr), value :: report
            integer(c_int32_t) :: answer
        end function
        function signorini_lcp_solve(n, m, ldm, q, settings, w, z, report) &
            bind(C, name="signorini_lcp_solve") result(answer)
            import
            integer(c_int64_t), value :: n
            real(c_double), intent(in) :: m(*)
            integer(c_int64_t), value :: ldm
            real(c_double), intent(in) :: q(*)
            type(c_ptr), value :: settings
            real(c_double), intent(out) :: w(*)
            real(c_double), intent(out) :: z(*)
            type(c_ptr), value :: report
            integer(c_int32_t) :: answer
        end function
        function signorini_lcp_lemke(n, m, ldm, q, cover, settings, w, z, report) &
            bind(C, name="signorini_lcp_lemke") result(answer)
            import
            integer(c_int64_t), value :: n
            real(c_double), intent(in) :: m(*)
            integer(c_int64_t), value :: ldm
            real(c_double), intent(in) :: q(*)
            type(c_ptr), value :: cover
            type(c_ptr), value :: settings
            real(c_double), intent(out) :: w(*)
            real(c_double), intent(out) :: z(*)
            type(c_ptr), value :: report
            integer(c_int32_t) :: answer
        end function
        function signorini_model_new_condensed(dim, pairs, k, ldk, model) &
            bind(C, name="signorini_model_new_condensed") result(answer)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            type(c_ptr), intent(out) :: model
            integer(c_int32_t) :: answer
        end function
        function signorini_model_new_two_body(dim, pairs, k_a, lda, k_b, ldb, model) &
            bind(C, name="signorini_model_new_two_body") result(answer)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k_a(*)
            integer(c_int64_t), value :: lda
            real(c_double), intent(in) :: k_b(*)
            integer(c_int64_t), value :: ldb
            type(c_ptr), intent(out) :: model
            integer(c_int32_t) :: answer
        end function
        function signorini_model_new_sparse(k, fixed, dofs, pairs, model) &
            bind(C, name="signorini_model_new_sparse") result(answer)
            import
            type(signorini_sparse), intent(in) :: k
            integer(c_int64_t), value :: fixed
            type(c_ptr), value :: dofs
            type(signorini_pairs), intent(in) :: pairs
            type(c_ptr), intent(out) :: model
            integer(c_int32_t) :: answer
        end function
        subroutine signorini_model_free(model) &
            bind(C, name="signorini_model_free")
            import
            type(c_ptr), value :: model
        end subroutine
        function signorini_model_host_size(model) &
            bind(C, name="signorini_model_host_size") result(answer)
            import
            type(c_ptr), value :: model
            integer(c_int64_t) :: answer
        end function
        function signorini_model_stiffness(model, k) &
            bind(C, name="signorini_model_stiffness") result(answer)
            import
            type(c_ptr), value :: model
            real(c_double), intent(out) :: k(*)
            integer(c_int32_t) :: answer
        end function
        function signorini_model_solve(model, cases, f, prescribed, gap, mu, slip, settings, &
            d, force, state, report, status) &
            bind(C, name="signorini_model_solve") result(answer)
            import
            type(c_ptr), value :: model
            integer(c_int64_t), value :: cases
            real(c_double), intent(in) :: f(*)
            type(c_ptr), value :: prescribed
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: mu(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: settings
            real(c_double), intent(inout) :: d(*)
            real(c_double), intent(out) :: force(*)
            type(c_ptr), value :: state
            type(c_ptr), value :: report
            type(c_ptr), value :: status
            integer(c_int32_t) :: answer
        end function
        function signorini_model_recover(model, f, prescribed, d, u) &
            bind(C, name="signorini_model_recover") result(answer)
            import
            type(c_ptr), value :: model
            type(c_ptr), value :: f
            type(c_ptr), value :: prescribed
            real(c_double), intent(in) :: d(*)
            real(c_double), intent(out) :: u(*)
            integer(c_int32_t) :: answer
        end function
        function signorini_model_nodal_forces(model, force, nodal) &
            bind(C, name="signorini_model_nodal_forces") result(answer)
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: force(*)
            real(c_double), intent(out) :: nodal(*)
            integer(c_int32_t) :: answer
        end function
        function signorini_problem_save(path, dim, pairs, k, ldk, f, gap, mu, slip, remark) &
            bind(C, name="signorini_problem_save") result(answer)
            import
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            real(c_double), intent(in) :: f(*)
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: mu(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: remark
            integer(c_int32_t) :: answer
        end function
        function signorini_tresca_save(path, dim, pairs, k, ldk, f, gap, g, slip, remark) &
            bind(C, name="signorini_tresca_save") result(answer)
            import
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            real(c_double), intent(in) :: k(*)
            integer(c_int64_t), value :: ldk
            real(c_double), intent(in) :: f(*)
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: g(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: remark
            integer(c_int32_t) :: answer
        end function
        function signorini_lcp_save(path, n, m, ldm, q, cover, remark) &
            bind(C, name="signorini_lcp_save") result(answer)
            import
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int64_t), value :: n
            real(c_double), intent(in) :: m(*)
            integer(c_int64_t), value :: ldm
            real(c_double), intent(in) :: q(*)
            type(c_ptr), value :: cover
            type(c_ptr), value :: remark
            integer(c_int32_t) :: answer
        end function
        function signorini_model_save_case(model, path, f, prescribed, gap, mu, slip, remark) &
            bind(C, name="signorini_model_save_case") result(answer)
            import
            type(c_ptr), value :: model
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), value :: f
            type(c_ptr), value :: prescribed
            real(c_double), intent(in) :: gap(*)
            real(c_double), intent(in) :: mu(*)
            type(c_ptr), value :: slip
            type(c_ptr), value :: remark
            integer(c_int32_t) :: answer
        end function
        function signorini_problem_load(path, problem) &
            bind(C, name="signorini_problem_load") result(answer)
            import
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), intent(out) :: problem
            integer(c_int32_t) :: answer
        end function
        subroutine signorini_problem_free(problem) &
            bind(C, name="signorini_problem_free")
            import
            type(c_ptr), value :: problem
        end subroutine
        function signorini_problem_kind(problem) &
            bind(C, name="signorini_problem_kind") result(answer)
            import
            type(c_ptr), value :: problem
            integer(c_int32_t) :: answer
        end function
        function signorini_problem_dim(problem) &
            bind(C, name="signorini_problem_dim") result(answer)
            import
            type(c_ptr), value :: problem
            integer(c_int32_t) :: answer
        end function
        function signorini_problem_pairs(problem) &
            bind(C, name="signorini_problem_pairs") result(answer)
            import
            type(c_ptr), value :: problem
            integer(c_int64_t) :: answer
        end function
        function signorini_problem_size(problem) &
            bind(C, name="signorini_problem_size") result(answer)
            import
            type(c_ptr), value :: problem
            integer(c_int64_t) :: answer
        end function
        function signorini_problem_matrix(problem) &
            bind(C, name="signorini_problem_matrix") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_vector(problem) &
            bind(C, name="signorini_problem_vector") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_gap(problem) &
            bind(C, name="signorini_problem_gap") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_friction(problem) &
            bind(C, name="signorini_problem_friction") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_slip(problem) &
            bind(C, name="signorini_problem_slip") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_cover(problem) &
            bind(C, name="signorini_problem_cover") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
        function signorini_problem_remark(problem) &
            bind(C, name="signorini_problem_remark") result(answer)
            import
            type(c_ptr), value :: problem
            type(c_ptr) :: answer
        end function
    end interface

    ! A structure, reduced to its contact pairs. Copies of it are the same model: release it once.
    type :: contact_model
        type(c_ptr) :: handle = c_null_ptr
        integer :: dim = 0, pairs = 0, fixed = 0
    contains
        procedure :: new_condensed => model_new_condensed
        procedure :: new_two_body => model_new_two_body
        procedure :: new_sparse => model_new_sparse
        procedure :: host_size => model_host_size
        procedure :: solve => model_solve
        procedure :: recover => model_recover
        procedure :: nodal_forces => model_nodal_forces
        procedure :: release => model_release
    end type

    private :: condensed, text_of, finish, refuse, fill, address, copy_states, number

contains

    ! The last sentence of the library on this thread.
    function signorini_message() result(text)
        character(len=:), allocatable :: text
        text = text_of(signorini_last_error())
    end function

    ! A short description of a status.
    function signorini_status_text(info) result(text)
        integer, intent(in) :: info
        character(len=:), allocatable :: text
        text = text_of(signorini_status_string(number(info)))
    end function

    ! Condensed contact with Coulomb friction: the dimension is size(f) / size(gap).
    subroutine contact_solve(k, f, gap, mu, d, force, info, slip, state, report, method, tolerance, &
            max_iterations, settings, message)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), mu(:)
        real(c_double), intent(inout), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: slip(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        character(len=*), intent(out), optional :: message
        call condensed(.false., k, f, gap, mu, d, force, info, slip, state, report, method, &
            tolerance, max_iterations, settings, message)
    end subroutine

    ! The same with friction thresholds g.
    subroutine contact_tresca(k, f, gap, g, d, force, info, slip, state, report, method, tolerance, &
            max_iterations, settings, message)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), g(:)
        real(c_double), intent(inout), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: slip(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        character(len=*), intent(out), optional :: message
        call condensed(.true., k, f, gap, g, d, force, info, slip, state, report, method, &
            tolerance, max_iterations, settings, message)
    end subroutine

    subroutine condensed(thresholds, k, f, gap, friction, d, force, info, slip, state, report, &
            method, tolerance, max_iterations, settings, message)
        logical, intent(in) :: thresholds
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), friction(:)
        real(c_double), intent(inout), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: slip(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        integer(c_int32_t), target :: states(size(gap))
        integer(c_int32_t) :: dim, status
        integer :: n
        n = size(f)
        dim = number(n / max(1, size(gap)))
        if (size(gap) == 0) dim = 2
        if (dim * size(gap) /= n) call refuse(info, 5, 'f has no whole number of components a pair', message)
        if (dim * size(gap) /= n) return
        if (size(k, 2) /= n) call refuse(info, 3, 'k has not as many columns as f has entries', message)
        if (size(k, 2) /= n) return
        if (size(friction) /= size(gap)) call refuse(info, 7, 'friction and gap differ in size', message)
        if (size(friction) /= size(gap)) return
        if (present(slip)) then
            if (size(slip) /= n - size(gap)) call refuse(info, 8, 'slip has a wrong size', message)
            if (size(slip) /= n - size(gap)) return
        end if
        if (size(d) /= n) call refuse(info, 10, 'd and f differ in size', message)
        if (size(d) /= n) return
        if (size(force) /= n) call refuse(info, 11, 'force and f differ in size', message)
        if (size(force) /= n) return
        if (present(state)) then
            if (size(state) /= size(gap)) call refuse(info, 12, 'state and gap differ in size', message)
            if (size(state) /= size(gap)) return
        end if
        call fill(chosen, method, tolerance, max_iterations, settings)
        measured%struct_size = number(int(c_sizeof(measured)))
        if (thresholds) then
            status = signorini_tresca(dim, int(size(gap), c_int64_t), k, int(max(1, size(k, 1)), c_int64_t), &
                f, gap, friction, address(slip), c_loc(chosen), d, force, c_loc(states), c_loc(measured))
        else
            status = signorini_solve(dim, int(size(gap), c_int64_t), k, int(max(1, size(k, 1)), c_int64_t), &
                f, gap, friction, address(slip), c_loc(chosen), d, force, c_loc(states), c_loc(measured))
        end if
        call finish(status, info, message)
        if (status >= 0) call copy_states(states, state)
        if (present(report)) report = measured
    end subroutine

    ! Measures displacements d of any origin on the data of a condensed problem.
    subroutine contact_certify(k, f, gap, mu, d, tolerance, info, slip, report, message)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), mu(:), d(:)
        real(c_double), intent(in) :: tolerance
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: slip(:)
        type(signorini_report), intent(out), optional :: report
        character(len=*), intent(out), optional :: message
        type(signorini_report), target :: measured
        integer(c_int32_t) :: status
        integer :: n, dim
        logical :: fits
        n = size(f)
        dim = 2
        if (size(gap) > 0) dim = n / size(gap)
        fits = dim * size(gap) == n .and. size(k, 2) == n .and. size(mu) == size(gap) .and. size(d) == n
        if (present(slip)) fits = fits .and. size(slip) == n - size(gap)
        if (.not. fits) call refuse(info, 2, 'k, f, gap, mu, slip and d do not fit each other', message)
        if (.not. fits) return
        measured%struct_size = number(int(c_sizeof(measured)))
        status = signorini_certify(number(dim), int(size(gap), c_int64_t), k, &
            int(max(1, size(k, 1)), c_int64_t), f, gap, mu, address(slip), tolerance, d, c_null_ptr, &
            c_null_ptr, c_loc(measured))
        call finish(status, info, message)
        if (present(report)) report = measured
    end subroutine

    ! w = q + m z, w >= 0, z >= 0, w . z = 0.
    subroutine lcp_solve(m, q, w, z, info, report, method, tolerance, max_iterations, message)
        real(c_double), intent(in), contiguous :: m(:, :), q(:)
        real(c_double), intent(out), contiguous :: w(:), z(:)
        integer, intent(out) :: info
        type(signorini_report), intent(out), optional :: report
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        logical :: fits
        fits = size(m, 2) == size(q) .and. size(w) == size(q) .and. size(z) == size(q)
        if (.not. fits) call refuse(info, 1, 'm, q, w and z do not fit each other', message)
        if (.not. fits) return
        call fill(chosen, method, tolerance, max_iterations)
        measured%struct_size = number(int(c_sizeof(measured)))
        call finish(signorini_lcp_solve(int(size(q), c_int64_t), m, int(max(1, size(m, 1)), c_int64_t), q, &
            c_loc(chosen), w, z, c_loc(measured)), info, message)
        if (present(report)) report = measured
    end subroutine

    subroutine model_new_condensed(self, dim, k, info, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        real(c_double), intent(in), contiguous :: k(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        call self%release()
        self%dim = dim
        self%pairs = size(k, 2) / max(1, dim)
        call finish(signorini_model_new_condensed(number(dim), int(self%pairs, c_int64_t), k, &
            int(max(1, size(k, 1)), c_int64_t), self%handle), info, message)
    end subroutine

    subroutine model_new_two_body(self, dim, k_a, k_b, info, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        real(c_double), intent(in), contiguous :: k_a(:, :), k_b(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        call self%release()
        self%dim = dim
        self%pairs = size(k_a, 2) / max(1, dim)
        if (size(k_b, 2) /= size(k_a, 2)) call refuse(info, 5, 'k_a and k_b differ in size', message)
        if (size(k_b, 2) /= size(k_a, 2)) return
        call finish(signorini_model_new_two_body(number(dim), int(self%pairs, c_int64_t), k_a, &
            int(max(1, size(k_a, 1)), c_int64_t), k_b, int(max(1, size(k_b, 1)), c_int64_t), self%handle), &
            info, message)
    end subroutine

    ! Of a whole sparse matrix by columns: starts(size + 1), rows, values, all counted from 1. Each
    ! pair has a column in slaves and normals. Without masters the obstacle is rigid.
    subroutine model_new_sparse(self, starts, rows, values, triangle, slaves, normals, info, fixed, &
            master_starts, masters, weights, tangents, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: starts(:), rows(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        integer, intent(in) :: slaves(:, :)
        real(c_double), intent(in), contiguous, target :: normals(:, :)
        integer, intent(out) :: info
        integer, intent(in), optional :: fixed(:), master_starts(:), masters(:, :)
        real(c_double), intent(in), contiguous, target, optional :: weights(:), tangents(:, :)
        character(len=*), intent(out), optional :: message
        type(signorini_sparse) :: matrix
        type(signorini_pairs) :: pairs
        integer(c_int64_t), allocatable, target :: held(:), of_slaves(:, :), begins(:), of_masters(:, :)
        integer(c_int64_t) :: held_count
        logical :: fits
        call self%release()
        fits = size(starts) > 0 .and. size(rows) == size(values) .and. all(shape(slaves) == shape(normals))
        if (present(tangents)) fits = fits .and. all(shape(tangents) == shape(normals))
        if (present(masters) .neqv. present(weights)) fits = .false.
        if (present(masters) .neqv. present(master_starts)) fits = .false.
        if (fits .and. present(masters)) then
            fits = size(master_starts) == size(slaves, 2) + 1 .and. size(masters, 2) == size(weights) &
                .and. size(masters, 1) == size(slaves, 1)
            if (fits) fits = master_starts(size(master_starts)) == size(weights) + 1
        end if
        if (.not. fits) call refuse(info, 4, 'the arrays of the matrix or of the pairs do not fit each other', message)
        if (.not. fits) return
        allocate (held(0))
        if (present(fixed)) held = int(fixed, c_int64_t)
        held_count = size(held)
        if (held_count == 0) held = [0_c_int64_t]
        allocate (of_slaves(size(slaves, 1), size(slaves, 2)))
        of_slaves = int(slaves, c_int64_t)
        self%dim = size(slaves, 1)
        self%pairs = size(slaves, 2)
        self%fixed = int(held_count)
        matrix%struct_size = number(int(c_sizeof(matrix)))
        matrix%index_bytes = storage_size(starts) / 8
        matrix%base = 1
        matrix%triangle = triangle
        matrix%size = size(starts) - 1
        matrix%entries = size(values)
        matrix%starts = c_loc(starts)
        if (size(rows) > 0) matrix%rows = c_loc(rows)
        matrix%values = address(values)
        pairs%struct_size = number(int(c_sizeof(pairs)))
        pairs%dim = number(self%dim)
        pairs%pairs = self%pairs
        if (self%pairs > 0) then
            pairs%slaves = c_loc(of_slaves)
            pairs%normals = c_loc(normals)
            if (present(tangents)) pairs%tangents = c_loc(tangents)
        end if
        if (present(masters)) then
            begins = int(master_starts, c_int64_t)
            allocate (of_masters(size(masters, 1), size(masters, 2)))
            of_masters = int(masters, c_int64_t)
            pairs%master_starts = c_loc(begins)
            if (size(weights) > 0) pairs%masters = c_loc(of_masters)
            pairs%weights = address(weights)
        end if
        call finish(signorini_model_new_sparse(matrix, held_count, c_loc(held), pairs, self%handle), &
            info, message)
    end subroutine

    ! Entries of a load or displacement vector of the model's host; -1 without a model.
    function model_host_size(self) result(entries)
        class(contact_model), intent(in) :: self
        integer :: entries
        entries = int(signorini_model_host_size(self%handle))
    end function

    ! One load case.
    subroutine model_solve(self, f, gap, mu, d, force, info, prescribed, slip, state, report, method, &
            tolerance, max_iterations, settings, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous :: f(:), gap(:), mu(:)
        real(c_double), intent(inout), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:), slip(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        integer(c_int32_t), target :: states(self%pairs)
        integer(c_int32_t) :: status
        logical :: fits
        fits = size(f) == self%host_size() .and. size(gap) == self%pairs .and. size(mu) == self%pairs &
            .and. size(d) == self%dim * self%pairs .and. size(force) == self%dim * self%pairs
        if (present(prescribed)) fits = fits .and. size(prescribed) == self%fixed
        if (present(slip)) fits = fits .and. size(slip) == (self%dim - 1) * self%pairs
        if (present(state)) fits = fits .and. size(state) == self%pairs
        if (.not. fits) call refuse(info, 1, 'the model and the arrays do not fit each other', message)
        if (.not. fits) return
        call fill(chosen, method, tolerance, max_iterations, settings)
        measured%struct_size = number(int(c_sizeof(measured)))
        status = signorini_model_solve(self%handle, 1_c_int64_t, f, address(prescribed), gap, mu, &
            address(slip), c_loc(chosen), d, force, c_loc(states), c_loc(measured), c_null_ptr)
        call finish(status, info, message)
        if (status >= 0) call copy_states(states, state)
        if (present(report)) report = measured
    end subroutine

    ! Displacements u of the host from d.
    subroutine model_recover(self, f, d, u, info, prescribed, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(in), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: u(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:)
        character(len=*), intent(out), optional :: message
        logical :: fits
        fits = size(f) == self%host_size() .and. size(u) == size(f) .and. size(d) == self%dim * self%pairs
        if (present(prescribed)) fits = fits .and. size(prescribed) == self%fixed
        if (.not. fits) call refuse(info, 1, 'the model and the arrays do not fit each other', message)
        if (.not. fits) return
        call finish(signorini_model_recover(self%handle, address(f), address(prescribed), d, u), info, message)
    end subroutine

    ! Contact forces as a nodal force vector of the host.
    subroutine model_nodal_forces(self, force, nodal, info, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous :: force(:)
        real(c_double), intent(out), contiguous :: nodal(:)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        logical :: fits
        fits = size(nodal) == self%host_size() .and. size(force) == self%dim * self%pairs
        if (.not. fits) call refuse(info, 1, 'the model and the arrays do not fit each other', message)
        if (.not. fits) return
        call finish(signorini_model_nodal_forces(self%handle, force, nodal), info, message)
    end subroutine

    subroutine model_release(self)
        class(contact_model), intent(inout) :: self
        call signorini_model_free(self%handle)
        self%handle = c_null_ptr
        self%dim = 0
        self%pairs = 0
        self%fixed = 0
    end subroutine

    subroutine refuse(info, position, sentence, message)
        integer, intent(out) :: info
        integer, intent(in) :: position
        character(len=*), intent(in) :: sentence
        character(len=*), intent(out), optional :: message
        info = -position
        if (present(message)) message = sentence
    end subroutine

    subroutine finish(status, info, message)
        integer(c_int32_t), intent(in) :: status
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        info = int(status)
        if (present(message)) message = signorini_message()
    end subroutine

    subroutine fill(chosen, method, tolerance, max_iterations, settings)
        type(signorini_settings), intent(out) :: chosen
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        integer(c_int32_t) :: status
        status = signorini_settings_default(chosen, number(int(c_sizeof(chosen))))
        if (present(settings) .and. status == 0) chosen = settings
        if (present(method)) chosen%method = number(method)
        if (present(tolerance)) chosen%tolerance = tolerance
        if (present(max_iterations)) chosen%max_iterations = max_iterations
    end subroutine

    subroutine copy_states(states, state)
        integer(c_int32_t), intent(in) :: states(:)
        integer, intent(out), optional :: state(:)
        if (present(state)) state = int(states)
    end subroutine

    ! Of an array that may be absent, or empty.
    function address(array) result(pointer)
        real(c_double), intent(in), contiguous, target, optional :: array(:)
        type(c_ptr) :: pointer
        pointer = c_null_ptr
        if (present(array)) then
            if (size(array) > 0) pointer = c_loc(array)
        end if
    end function

    pure function number(value) result(narrow)
        integer, intent(in) :: value
        integer(c_int32_t) :: narrow
        narrow = int(value, c_int32_t)
    end function

    function text_of(pointer) result(text)
        type(c_ptr), intent(in) :: pointer
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: length, i
        call c_f_pointer(pointer, letters, [512])
        length = 0
        do while (letters(length + 1) /= c_null_char)
            length = length + 1
        end do
        allocate (character(len=length) :: text)
        do i = 1, length
            text(i:i) = letters(i)
        end do
    end function
end module
