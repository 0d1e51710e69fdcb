! signorini: unilateral contact with friction, for Fortran 2008.
!
! Compile this file with your program: the module has no object code of its own to be delivered.
!
!     call contact_solve(k, f, gap, d, force, info, friction=mu, message=message)
!
! d are the relative displacements and force the contact forces of size(gap) pairs of nodes, ordered
! pair by pair as (n, t) or (n, t1, t2), for the condensed stiffness k, the loads f and the gaps. The
! body's outward normal is n, force(n) < 0 presses. The problem, the signs and the units are those
! of signorini.h.
!
! Calls and types:
!     contact_solve    a condensed problem in one call
!     contact_solve_flexibility  the same by a matrix that turns forces into displacements
!     contact_solve_flexibility_sparse  the same by a sparse one
!     contact_certify  measures displacements of any origin
!     contact_prove    proves that a solution exists next to displacements of any origin
!     lcp_solve        a linear complementarity problem (LCP)
!     contact_model    a type: a structure that is reduced once and solved for many load cases;
!                      call model%new_condensed, %new_two_body, %new_flexibility or
!                      %new_flexibility_sparse, %new_sparse or %new_sparse_rows, %new_surfaces,
!                      %new_operator, then %solve, %certify, %prove, %recover, %nodal_forces, %frames,
!                      %condensed_load, %stiffness, %view, at the end %release
!     contact_equations  a type: equations between degrees of freedom, for a model of a sparse matrix
!     contact_surfaces a type: contact pairs that the library makes from the faces of two meshes; call
!                      %pair or %pair_obstacle, model%new_surfaces, then %fields, %resultant,
!                      %write, at the end %release; several zones: %join and %table
!     contact_operator a type to extend: a host that gives products and solutions in the place of a
!                      matrix; model%new_operator takes it
! The functions signorini_... are those of signorini.h, signorini_surface.h and signorini_file.h,
! argument by argument: files, and whatever else is not above. These headers are their reference;
! what they have behind SIGNORINI_UNSTABLE may still change here too.
!
! Arguments that many calls have:
!     friction  the law's parameters, pair by pair. Without it there is no friction.
!     law       an integer, int(SIGNORINI_LAW_...) where integers have 8 bytes by an option:
!               SIGNORINI_LAW_COULOMB (the default with friction: coefficients mu),
!               SIGNORINI_LAW_TRESCA (thresholds g, forces); with three parameters a pair
!               SIGNORINI_LAW_COHESIVE (mu, cohesion b, tension a) and, in 3D,
!               SIGNORINI_LAW_ORTHOTROPIC, _ORTHOTROPIC_COLLINEAR (mu1, mu2, angle); with four
!               SIGNORINI_LAW_BY_PAIR (the pair's own law, its parameters, and zeros); without
!               friction SIGNORINI_LAW_TIED.
!     slip0     reference slip: tangential displacements at which a sticking pair stays, dim - 1 for
!               each pair. Absent: zeros, the total law. The d_t of the last load step: the
!               incremental law.
!     method, tolerance, max_iterations  overrule what settings say.
!     settings  type(signorini_settings): all settings. As declared it holds the defaults.
!     state     SIGNORINI_STATE_OPEN, _SLIP or _STICK of each pair.
!     report    type(signorini_report): how good the result is, and how it was found.
!     motion    if info is SIGNORINI_STATUS_NO_EQUILIBRIUM, a motion that proves it; otherwise zeros.
!     escape    the same as the bodies would move, without the lift that a proof needs: draw this one.
!     second_d, second_force, second_state  a second solution if report%second is 1, otherwise
!               zeros. Ask for it by settings%search = SIGNORINI_SEARCH_OTHERS.
!     info      0: solved and certified. > 0: SIGNORINI_STATUS_..., results were written but are
!               not a solution. -k: the k-th argument in the parentheses of your call, counted as
!               if none was left out, is wrong, and nothing was written. CONTACT_WRONG_MODEL: so
!               is the model itself. <= -1000: internal, memory, a file. Of %pair,
!               %pair_obstacle and %pair_rigid the k of search_distance stands for settings too, and
!               of %join -1 for all that is wrong in a zone: message tells which it is.
!     message   a sentence of any length that tells what is wrong and where, or, if info is 0, the
!               remarks on the solution, most often none. Indices in it count from 1.
module signorini
    use, intrinsic :: iso_c_binding
    implicit none
    public

    ! The model has not been made, has been released, or has not what is asked for.
    integer, parameter :: CONTACT_WRONG_MODEL = -99

    ! Friction laws, and how many numbers of friction each has for each pair (tests/sources/bindings.rs)
    integer(c_int32_t), parameter :: SIGNORINI_LAW_FRICTIONLESS = 0
    integer(c_int32_t), parameter :: SIGNORINI_LAW_COULOMB = 1
    integer(c_int32_t), parameter :: SIGNORINI_LAW_TRESCA = 2
    integer(c_int32_t), parameter :: SIGNORINI_LAW_COHESIVE = 3
    integer(c_int32_t), parameter :: SIGNORINI_LAW_ORTHOTROPIC = 4
    integer(c_int32_t), parameter :: SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR = 5
    integer(c_int32_t), parameter :: SIGNORINI_LAW_BY_PAIR = 6
    integer(c_int32_t), parameter :: SIGNORINI_LAW_TIED = 7
    integer, parameter, private :: law_numbers(0:7) = [0, 1, 1, 3, 3, 3, 4, 0]

    integer(c_int32_t), parameter :: SIGNORINI_STATUS_SOLVED = 0
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_ITERATION_LIMIT = 1
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_TIME_LIMIT = 2
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_CANCELLED = 3
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_NO_EQUILIBRIUM = 4
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_STALLED = 5
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_NOT_A_SOLUTION = 6
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_NOT_PROVED = 7
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_MEMORY_LIMIT = 8
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_INTERNAL = -1000
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_OUT_OF_MEMORY = -1001
    integer(c_int32_t), parameter :: SIGNORINI_STATUS_FILE = -1002
    integer(c_int32_t), parameter :: SIGNORINI_STATE_OPEN = 0
    integer(c_int32_t), parameter :: SIGNORINI_STATE_SLIP = 1
    integer(c_int32_t), parameter :: SIGNORINI_STATE_STICK = 2
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_AUTO = 0
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_SOR_NESTED = 1
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_SOR_DIAGONAL = 2
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_LEMKE = 3
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_BLOCK_PIVOTING = 4
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_NEWTON = 5
    integer(c_int32_t), parameter :: SIGNORINI_METHOD_PATH = 6
    integer(c_int32_t), parameter :: SIGNORINI_START_PREVIOUS = 2
    integer(c_int32_t), parameter :: SIGNORINI_SEARCH_OFF = 0
    integer(c_int32_t), parameter :: SIGNORINI_SEARCH_OTHERS = 1
    integer(c_int32_t), parameter :: SIGNORINI_UNIQUENESS_NOT_KNOWN = 0
    integer(c_int32_t), parameter :: SIGNORINI_UNIQUENESS_UNIQUE = 1
    integer(c_int32_t), parameter :: SIGNORINI_UNIQUENESS_SEVERAL = 2
    integer(c_int32_t), parameter :: SIGNORINI_PROOF_NOT_ASKED = 0
    integer(c_int32_t), parameter :: SIGNORINI_PROOF_PROVED = 1
    integer(c_int32_t), parameter :: SIGNORINI_PROOF_NOT_PROVED = 2
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_NONE = 0
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_CYCLE = 1
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_SINGULAR = 2
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_UNSTABLE = 3
    integer(c_int32_t), parameter :: SIGNORINI_FALLBACK_INACCURATE = 4
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_GAPS_NEGATIVE = 1
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_FRICTION_LARGE = 2
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_FREE_MOTION = 4
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_HELD_BY_ROUNDING = 8
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_NEEDS_LOW_PART = 16
    integer(c_int32_t), parameter :: SIGNORINI_REMARK_GAPS_PASSED = 32
    integer(c_int32_t), parameter :: SIGNORINI_TRIANGLE_LOWER = 0
    integer(c_int32_t), parameter :: SIGNORINI_TRIANGLE_UPPER = 1
    integer(c_int32_t), parameter :: SIGNORINI_TRIANGLE_FULL = 2
    integer(c_int32_t), parameter :: SIGNORINI_MODEL_STIFFNESS = 0
    integer(c_int32_t), parameter :: SIGNORINI_MODEL_FULL_SPACE = 1
    integer(c_int32_t), parameter :: SIGNORINI_MODEL_OPERATOR = 2
    integer(c_int32_t), parameter :: SIGNORINI_MODEL_FLEXIBILITY = 3
    integer(c_int32_t), parameter :: SIGNORINI_PAIRING_DUAL_MORTAR = 0
    integer(c_int32_t), parameter :: SIGNORINI_PAIRING_NODE_TO_SURFACE = 1
    integer(c_int32_t), parameter :: SIGNORINI_NORMALS_AVERAGED = 0
    integer(c_int32_t), parameter :: SIGNORINI_NORMALS_FACES = 1
    integer(c_int32_t), parameter :: SIGNORINI_RIMS_FOLD = 0
    integer(c_int32_t), parameter :: SIGNORINI_RIMS_KEEP = 1
    integer(c_int32_t), parameter :: SIGNORINI_RIMS_FOLD_LITTLE = 2
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_PLANE = 0
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_CYLINDER = 1
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_SPHERE = 2
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_FACES = 3
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_CONE = 4
    integer(c_int32_t), parameter :: SIGNORINI_OBSTACLE_TORUS = 5
    integer(c_int32_t), parameter :: SIGNORINI_PROBLEM_CONTACT = 0
    integer(c_int32_t), parameter :: SIGNORINI_PROBLEM_LCP = 1
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_MAJOR = 0
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_MINOR = 9
    integer(c_int32_t), parameter :: SIGNORINI_VERSION_PATCH = 0
    integer(c_int32_t), parameter :: SIGNORINI_ABI_VERSION = 3

    ! A variable of these types is ready to use: struct_size is that of the structure, settings have
    ! their defaults, and all pointers are null.
    integer, parameter, private :: address_bytes = storage_size(0_c_intptr_t) / 8

    type, bind(C) :: signorini_progress
        integer(c_int64_t) :: iterations = 0
        real(c_double) :: eta = 0
        real(c_double) :: elapsed = 0
        real(c_double) :: reduced = 0
        integer(c_int64_t) :: memory = 0
    end type

    type, bind(C) :: signorini_settings
        integer(c_int32_t) :: struct_size = 80 + 2 * address_bytes
        integer(c_int32_t) :: method = SIGNORINI_METHOD_AUTO
        real(c_double) :: tolerance = 1e-10_c_double
        real(c_double) :: omega = 0
        real(c_double) :: damping = 0
        integer(c_int64_t) :: max_iterations = 200000
        real(c_double) :: time_limit = 0
        integer(c_int32_t) :: warm_start = 0
        integer(c_int32_t) :: search = SIGNORINI_SEARCH_OFF
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
        integer(c_int32_t) :: proof = 0
        integer(c_int32_t) :: reserved = 0
        integer(c_int64_t) :: memory_limit = 0
        integer(c_int32_t) :: full_space = 0
        integer(c_int32_t) :: threads = 1
    end type

    ! stiffness, inverse, held and precondition are c_funloc of bind(C) functions: see the header.
    type, bind(C) :: signorini_operator
        integer(c_int32_t) :: struct_size = 32 + 7 * address_bytes
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: pairs = 0
        type(c_funptr) :: stiffness = c_null_funptr
        type(c_funptr) :: inverse = c_null_funptr
        type(c_funptr) :: held = c_null_funptr
        type(c_ptr) :: units = c_null_ptr
        type(c_ptr) :: user = c_null_ptr
        integer(c_int64_t) :: unknowns = 0
        type(c_ptr) :: place = c_null_ptr
        type(c_funptr) :: precondition = c_null_funptr
        real(c_double) :: accuracy = 0
    end type

    type, bind(C) :: signorini_report
        integer(c_int32_t) :: struct_size = 176
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
        integer(c_int64_t) :: pairs_open = 0
        integer(c_int64_t) :: pairs_slipping = 0
        integer(c_int64_t) :: pairs_sticking = 0
        integer(c_int64_t) :: factorisations = 0
        integer(c_int32_t) :: first_method = 0
        integer(c_int32_t) :: fallback = 0
        integer(c_int32_t) :: orientation = 0
        integer(c_int32_t) :: second = 0
        real(c_double) :: error_d = 0
        real(c_double) :: error_force = 0
        integer(c_int32_t) :: proof = 0
        integer(c_int32_t) :: remarks = 0
    end type

    type, bind(C) :: signorini_extra
        integer(c_int32_t) :: struct_size = 8 + 8 * address_bytes
        integer(c_int32_t) :: reserved = 0
        type(c_ptr) :: motion = c_null_ptr
        type(c_ptr) :: second_d = c_null_ptr
        type(c_ptr) :: second_force = c_null_ptr
        type(c_ptr) :: second_state = c_null_ptr
        type(c_ptr) :: radius_d = c_null_ptr
        type(c_ptr) :: radius_force = c_null_ptr
        type(c_ptr) :: escape = c_null_ptr
        type(c_ptr) :: d_low = c_null_ptr
    end type

    type, bind(C) :: signorini_sparse
        integer(c_int32_t) :: struct_size = 32 + 4 * address_bytes
        integer(c_int32_t) :: index_bytes = 0
        integer(c_int32_t) :: index_base = 0
        integer(c_int32_t) :: triangle = SIGNORINI_TRIANGLE_LOWER
        integer(c_int64_t) :: size = 0
        integer(c_int64_t) :: nnz = 0
        type(c_ptr) :: col_start = c_null_ptr
        type(c_ptr) :: row = c_null_ptr
        type(c_ptr) :: values = c_null_ptr
        type(c_ptr) :: order = c_null_ptr
    end type

    type, bind(C) :: signorini_equations
        integer(c_int32_t) :: struct_size = 16 + 4 * address_bytes
        integer(c_int32_t) :: reserved = 0
        integer(c_int64_t) :: count = 0
        type(c_ptr) :: dependent = c_null_ptr
        type(c_ptr) :: start = c_null_ptr
        type(c_ptr) :: dofs = c_null_ptr
        type(c_ptr) :: coefficients = c_null_ptr
    end type

    type, bind(C) :: signorini_pairs
        integer(c_int32_t) :: struct_size = 16 + 11 * address_bytes
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: count = 0
        type(c_ptr) :: slaves = c_null_ptr
        type(c_ptr) :: master_start = c_null_ptr
        type(c_ptr) :: masters = c_null_ptr
        type(c_ptr) :: weights = c_null_ptr
        type(c_ptr) :: normals = c_null_ptr
        type(c_ptr) :: tangents = c_null_ptr
        type(c_ptr) :: row_start = c_null_ptr
        type(c_ptr) :: row_nodes = c_null_ptr
        type(c_ptr) :: row_weights = c_null_ptr
        type(c_ptr) :: row_vectors = c_null_ptr
        type(c_ptr) :: equations = c_null_ptr
    end type

    type, bind(C) :: signorini_model_data
        integer(c_int32_t) :: struct_size = 48 + 2 * address_bytes
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: pairs = 0
        integer(c_int64_t) :: host_size = -1
        integer(c_int64_t) :: fixed = 0
        integer(c_int64_t) :: memory = -1
        integer(c_int32_t) :: kind = 0
        integer(c_int32_t) :: dependent = 0
        type(c_ptr) :: k = c_null_ptr
        type(c_ptr) :: frames = c_null_ptr
    end type

    type, bind(C) :: signorini_faces
        integer(c_int32_t) :: struct_size = 16 + 2 * address_bytes
        integer(c_int32_t) :: face_nodes = 0
        integer(c_int64_t) :: count = 0
        type(c_ptr) :: start = c_null_ptr
        type(c_ptr) :: nodes = c_null_ptr
    end type

    type, bind(C) :: signorini_obstacle
        integer(c_int32_t) :: struct_size = 80 + 2 * address_bytes
        integer(c_int32_t) :: kind = 0
        real(c_double) :: point(3) = 0
        real(c_double) :: direction(3) = 0
        real(c_double) :: radius = 0
        integer(c_int32_t) :: hollow = 0
        integer(c_int32_t) :: reserved = 0
        integer(c_int64_t) :: nodes = 0
        type(c_ptr) :: coordinates = c_null_ptr
        type(c_ptr) :: faces = c_null_ptr
    end type

    type, bind(C) :: signorini_surface_settings
        integer(c_int32_t) :: struct_size = 168 + 11 * address_bytes
        integer(c_int32_t) :: pairing = 0
        real(c_double) :: search_distance = 0
        integer(c_int32_t) :: index_base = 0
        integer(c_int32_t) :: dofs_per_node = 0
        type(c_ptr) :: node_dofs = c_null_ptr
        integer(c_int64_t) :: symmetry_planes = 0
        type(c_ptr) :: symmetry_axes = c_null_ptr
        type(c_ptr) :: symmetry_at = c_null_ptr
        integer(c_int32_t) :: normals = 0
        integer(c_int32_t) :: rims = 0
        integer(c_int32_t) :: axisymmetric = 0
        integer(c_int32_t) :: fitted = 0
        real(c_double) :: time_limit = 0
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
        type(c_ptr) :: slave_shape = c_null_ptr
        type(c_ptr) :: master_shape = c_null_ptr
        real(c_double) :: close_within = 0
        real(c_double) :: clearance = 0
        type(c_ptr) :: symmetry_normals = c_null_ptr
        integer(c_int64_t) :: sectors = 0
        type(c_ptr) :: sector_point = c_null_ptr
        type(c_ptr) :: sector_axis = c_null_ptr
        real(c_double) :: tangent(3) = 0
        real(c_double) :: period(3) = 0
        real(c_double) :: second_period(3) = 0
        integer(c_int32_t) :: keep_turns = 0
        integer(c_int32_t) :: reserved = 0
        integer(c_int64_t) :: n_fixed = 0
        type(c_ptr) :: fixed = c_null_ptr
    end type

    ! The arrays belong to the pairs; contact_surfaces has copies of those that hosts use most.
    type, bind(C) :: signorini_surface_data
        integer(c_int32_t) :: struct_size = 112 + 16 * address_bytes
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: pairs = 0
        type(c_ptr) :: rows = c_null_ptr
        type(c_ptr) :: gaps = c_null_ptr
        type(c_ptr) :: areas = c_null_ptr
        type(c_ptr) :: normals = c_null_ptr
        type(c_ptr) :: tangents = c_null_ptr
        type(c_ptr) :: points = c_null_ptr
        type(c_ptr) :: nodes = c_null_ptr
        integer(c_int64_t) :: n_unpaired = 0
        type(c_ptr) :: unpaired = c_null_ptr
        integer(c_int64_t) :: n_folded = 0
        type(c_ptr) :: folded = c_null_ptr
        integer(c_int64_t) :: n_uncovered = 0
        type(c_ptr) :: uncovered = c_null_ptr
        type(c_ptr) :: summary = c_null_ptr
        integer(c_int64_t) :: slave_faces = 0
        real(c_double) :: slave_area = 0
        real(c_double) :: covered_area = 0
        real(c_double) :: search_distance = 0
        integer(c_int64_t) :: not_opposed = 0
        integer(c_int64_t) :: boxes_searched = 0
        integer(c_int64_t) :: on_symmetry = 0
        integer(c_int64_t) :: n_beyond = 0
        type(c_ptr) :: beyond = c_null_ptr
        type(c_ptr) :: beyond_distances = c_null_ptr
        type(c_ptr) :: folded_distances = c_null_ptr
        integer(c_int64_t) :: n_zones = 0
        type(c_ptr) :: zone_start = c_null_ptr
        type(c_ptr) :: friction = c_null_ptr
    end type

    type, bind(C) :: signorini_contact_zone
        integer(c_int32_t) :: struct_size = 8 + 3 * address_bytes
        integer(c_int32_t) :: law = 0
        type(c_ptr) :: contact = c_null_ptr
        type(c_ptr) :: name = c_null_ptr
        type(c_ptr) :: friction = c_null_ptr
    end type

    type, bind(C) :: signorini_contact_fields
        integer(c_int32_t) :: struct_size = 8 + 5 * address_bytes
        integer(c_int32_t) :: reserved = 0
        type(c_ptr) :: pressure = c_null_ptr
        type(c_ptr) :: traction = c_null_ptr
        type(c_ptr) :: clearance = c_null_ptr
        type(c_ptr) :: slip = c_null_ptr
        type(c_ptr) :: state = c_null_ptr
    end type

    type, bind(C) :: signorini_resultant
        integer(c_int32_t) :: struct_size = 72
        integer(c_int32_t) :: reserved = 0
        real(c_double) :: force(3) = 0
        real(c_double) :: moment(3) = 0
        real(c_double) :: friction_work = 0
        real(c_double) :: pressed_area = 0
    end type

    type, bind(C) :: signorini_penetration
        integer(c_int32_t) :: struct_size = 72
        integer(c_int32_t) :: points = 0
        real(c_double) :: depth = 0
        real(c_double) :: point(3) = 0
        integer(c_int64_t) :: face = 0
        integer(c_int64_t) :: node = 0
        integer(c_int64_t) :: master_face = 0
        integer(c_int64_t) :: zone = 0
    end type

    type, bind(C) :: signorini_mesh
        integer(c_int32_t) :: struct_size = 32 + 4 * address_bytes
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: nodes = 0
        type(c_ptr) :: coordinates = c_null_ptr
        integer(c_int64_t) :: cells = 0
        integer(c_int32_t) :: index_base = 0
        integer(c_int32_t) :: cell_type = 0
        type(c_ptr) :: cell_types = c_null_ptr
        type(c_ptr) :: cell_start = c_null_ptr
        type(c_ptr) :: cell_nodes = c_null_ptr
    end type

    type, bind(C) :: signorini_zone
        integer(c_int32_t) :: struct_size = 8 + 6 * address_bytes
        integer(c_int32_t) :: reserved = 0
        type(c_ptr) :: contact = c_null_ptr
        type(c_ptr) :: gap = c_null_ptr
        type(c_ptr) :: slip0 = c_null_ptr
        type(c_ptr) :: d = c_null_ptr
        type(c_ptr) :: force = c_null_ptr
        type(c_ptr) :: state = c_null_ptr
    end type

    type, bind(C) :: signorini_field
        integer(c_int32_t) :: struct_size = 8 + 2 * address_bytes
        integer(c_int32_t) :: components = 0
        type(c_ptr) :: name = c_null_ptr
        type(c_ptr) :: values = c_null_ptr
    end type

    type, bind(C) :: signorini_problem_data
        integer(c_int32_t) :: struct_size = 32 + 7 * address_bytes
        integer(c_int32_t) :: kind = 0
        integer(c_int32_t) :: law = 0
        integer(c_int32_t) :: dim = 0
        integer(c_int64_t) :: pairs = 0
        integer(c_int64_t) :: size = 0
        type(c_ptr) :: matrix = c_null_ptr
        type(c_ptr) :: rhs = c_null_ptr
        type(c_ptr) :: gap = c_null_ptr
        type(c_ptr) :: friction = c_null_ptr
        type(c_ptr) :: slip0 = c_null_ptr
        type(c_ptr) :: cover = c_null_ptr
        type(c_ptr) :: remark = c_null_ptr
    end type

    interface
        integer(c_int32_t) function signorini_solve(dim, pairs, k, ldk, f, gap, law, friction, slip0, &
            settings, d, force, state, report, extra) bind(C)
            import
            integer(c_int32_t), value :: dim, law
            integer(c_int64_t), value :: pairs, ldk
            real(c_double), intent(in) :: k(*), f(*), gap(*)
            type(c_ptr), value :: friction, slip0, settings, state, report, extra
            real(c_double), intent(inout) :: d(*)
            real(c_double), intent(out) :: force(*)
        end function
        type(c_ptr) function signorini_last_error() bind(C)
            import
        end function
        type(c_ptr) function signorini_status_string(status) bind(C)
            import
            integer(c_int32_t), value :: status
        end function
        integer(c_int32_t) function signorini_model_new_sparse(k, n_fixed, fixed, pairs, settings, model) &
            bind(C)
            import
            type(signorini_sparse), intent(in) :: k
            integer(c_int64_t), value :: n_fixed
            type(c_ptr), value :: fixed, settings
            type(signorini_pairs), intent(in) :: pairs
            type(c_ptr), intent(out) :: model
        end function
        integer(c_int32_t) function signorini_model_new_condensed(dim, pairs, k, ldk, settings, model) &
            bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs, ldk
            real(c_double), intent(in) :: k(*)
            type(c_ptr), value :: settings
            type(c_ptr), intent(out) :: model
        end function
        integer(c_int32_t) function signorini_model_new_two_body(dim, pairs, k_a, lda, k_b, ldb, settings, &
            model) bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs, lda, ldb
            real(c_double), intent(in) :: k_a(*), k_b(*)
            type(c_ptr), value :: settings
            type(c_ptr), intent(out) :: model
        end function
        integer(c_int32_t) function signorini_model_new_flexibility(dim, pairs, w, ldw, model) bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs, ldw
            real(c_double), intent(in) :: w(*)
            type(c_ptr), intent(out) :: model
        end function
        integer(c_int32_t) function signorini_model_new_flexibility_sparse(dim, pairs, w, model) bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: pairs
            type(signorini_sparse), intent(in) :: w
            type(c_ptr), intent(out) :: model
        end function
        subroutine signorini_model_free(model) bind(C)
            import
            type(c_ptr), value :: model
        end subroutine
        integer(c_int32_t) function signorini_model_view(model, data) bind(C)
            import
            type(c_ptr), value :: model
            type(signorini_model_data), intent(inout) :: data
        end function
        integer(c_int32_t) function signorini_model_solve(model, cases, f, prescribed, gap, law, friction, &
            slip0, settings, d, force, state, status, report, extra) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed, friction, slip0, settings, state, status, report, extra
            integer(c_int64_t), value :: cases
            real(c_double), intent(in) :: gap(*)
            integer(c_int32_t), value :: law
            real(c_double), intent(inout) :: d(*), force(*)
        end function
        integer(c_int32_t) function signorini_model_recover(model, cases, f, prescribed, d, u) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed
            integer(c_int64_t), value :: cases
            real(c_double), intent(in) :: d(*)
            real(c_double), intent(out) :: u(*)
        end function
        integer(c_int32_t) function signorini_model_nodal_forces(model, force, nodal) bind(C)
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: force(*)
            real(c_double), intent(out) :: nodal(*)
        end function
        integer(c_int32_t) function signorini_model_condensed_load(model, f, prescribed, load) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed
            real(c_double), intent(out) :: load(*)
        end function
        integer(c_int32_t) function signorini_model_certify(model, f, prescribed, gap, law, friction, &
            slip0, tolerance, d, force, state, report) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed, friction, slip0, force, state, report
            real(c_double), intent(in) :: gap(*), d(*)
            integer(c_int32_t), value :: law
            real(c_double), value :: tolerance
        end function
        integer(c_int32_t) function signorini_settings_default(settings, struct_size) bind(C)
            import
            type(signorini_settings), intent(inout) :: settings
            integer(c_int32_t), value :: struct_size
        end function
        integer(c_int64_t) function signorini_solve_memory(n) bind(C)
            import
            integer(c_int64_t), value :: n
        end function
        type(c_ptr) function signorini_remark_string(remark) bind(C)
            import
            integer(c_int32_t), value :: remark
        end function
        integer(c_int32_t) function signorini_report_default(report, struct_size) bind(C)
            import
            type(signorini_report), intent(inout) :: report
            integer(c_int32_t), value :: struct_size
        end function
        integer(c_int32_t) function signorini_extra_default(extra, struct_size) bind(C)
            import
            type(signorini_extra), intent(inout) :: extra
            integer(c_int32_t), value :: struct_size
        end function
        integer(c_int32_t) function signorini_lcp_solve(n, m, ldm, q, cover, settings, w, z, y, report) &
            bind(C)
            import
            integer(c_int64_t), value :: n, ldm
            real(c_double), intent(in) :: m(*), q(*)
            type(c_ptr), value :: cover, settings, y, report
            real(c_double), intent(out) :: w(*), z(*)
        end function
        type(c_ptr) function signorini_version() bind(C)
            import
        end function
        ! Fortran knows no upper case: the name of C is that of the constant.
        integer(c_int32_t) function signorini_library_abi_version() bind(C, name="signorini_abi_version")
            import
        end function
        integer(c_int32_t) function signorini_model_new_operator(k, model) bind(C)
            import
            type(signorini_operator), intent(in) :: k
            type(c_ptr), intent(out) :: model
        end function
        integer(c_int32_t) function signorini_model_prove(model, f, prescribed, gap, law, friction, slip0, &
            d, state, force, radius_d, radius_force) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed, friction, slip0, state, force, radius_d, radius_force
            real(c_double), intent(in) :: gap(*), d(*)
            integer(c_int32_t), value :: law
        end function
        integer(c_int32_t) function signorini_surface_settings_default(settings, struct_size) bind(C)
            import
            type(signorini_surface_settings), intent(out) :: settings
            integer(c_int32_t), value :: struct_size
        end function
        integer(c_int32_t) function signorini_surface_pair(dim, nodes, coordinates, slave, master, &
            settings, contact) bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: nodes
            type(c_ptr), value :: coordinates, slave, master, settings
            type(c_ptr), intent(out) :: contact
        end function
        integer(c_int32_t) function signorini_surface_pair_obstacle(dim, nodes, coordinates, slave, &
            obstacle, settings, contact) bind(C)
            import
            integer(c_int32_t), value :: dim
            integer(c_int64_t), value :: nodes
            type(c_ptr), value :: coordinates, slave, obstacle, settings
            type(c_ptr), intent(out) :: contact
        end function
        subroutine signorini_surface_free(contact) bind(C)
            import
            type(c_ptr), value :: contact
        end subroutine
        integer(c_int32_t) function signorini_surface_view(contact, data) bind(C)
            import
            type(c_ptr), value :: contact
            type(signorini_surface_data), intent(inout) :: data
        end function
        integer(c_int32_t) function signorini_surface_join(n_zones, zones, joined) bind(C)
            import
            integer(c_int64_t), value :: n_zones
            type(c_ptr), value :: zones
            type(c_ptr), intent(out) :: joined
        end function
        integer(c_int32_t) function signorini_surface_table(joined, d, force, state, text, size) bind(C)
            import
            type(c_ptr), value :: joined, d, force, state, text
            integer(c_int64_t), value :: size
        end function
        integer(c_int32_t) function signorini_surface_fields(contact, gap, slip0, d, force, state, fields) &
            bind(C)
            import
            type(c_ptr), value :: contact, gap, slip0, d, force, state, fields
        end function
        integer(c_int32_t) function signorini_surface_resultant(contact, slip0, d, force, point, &
            resultant) bind(C)
            import
            type(c_ptr), value :: contact, slip0, d, force, point, resultant
        end function
        integer(c_int32_t) function signorini_surface_adjust(contact, within, coordinates) bind(C)
            import
            type(c_ptr), value :: contact, coordinates
            real(c_double), value :: within
        end function
        integer(c_int32_t) function signorini_surface_penetration(contact, u, penetration) bind(C)
            import
            type(c_ptr), value :: contact, u, penetration
        end function
        integer(c_int32_t) function signorini_mesh_write(path, mesh, u, n_zones, zones, n_fields, fields) &
            bind(C)
            import
            type(c_ptr), value :: path, mesh, u, zones, fields
            integer(c_int64_t), value :: n_zones, n_fields
        end function
        integer(c_int32_t) function signorini_problem_write(path, dim, pairs, k, ldk, f, gap, law, &
            friction, slip0, remark) bind(C)
            import
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t), value :: dim, law
            integer(c_int64_t), value :: pairs, ldk
            real(c_double), intent(in) :: k(*), f(*), gap(*)
            type(c_ptr), value :: friction, slip0, remark
        end function
        integer(c_int32_t) function signorini_model_write(model, path, f, prescribed, gap, law, friction, &
            slip0, remark) bind(C)
            import
            type(c_ptr), value :: model, f, prescribed, friction, slip0, remark
            character(kind=c_char), intent(in) :: path(*)
            real(c_double), intent(in) :: gap(*)
            integer(c_int32_t), value :: law
        end function
        integer(c_int32_t) function signorini_lcp_write(path, n, m, ldm, q, cover, remark) bind(C)
            import
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int64_t), value :: n, ldm
            real(c_double), intent(in) :: m(*), q(*)
            type(c_ptr), value :: cover, remark
        end function
        integer(c_int32_t) function signorini_problem_read(path, problem) bind(C)
            import
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), intent(out) :: problem
        end function
        subroutine signorini_problem_free(problem) bind(C)
            import
            type(c_ptr), value :: problem
        end subroutine
        integer(c_int32_t) function signorini_problem_view(problem, data) bind(C)
            import
            type(c_ptr), value :: problem
            type(signorini_problem_data), intent(inout) :: data
        end function
        ! The sentence of signorini_last_error with indices that count from 1, of Fortran 77.
        subroutine sgmesg(text, ltext) bind(C, name="sgmesg_")
            import
            character(kind=c_char), intent(inout) :: text(*)
            integer(c_int32_t), intent(in) :: ltext
        end subroutine
    end interface

    ! A host that gives products and solutions in the place of a matrix, for model%new_operator: say a code
    ! on several processes. Extend it; write stiffness, and inverse or held, and say which there are. x and
    ! y have dim * pairs entries. info is 0; another number ends the call of the library, whose sentence
    ! tells it. They must not call this library.
    type, abstract :: contact_operator
        logical :: has_inverse = .true., has_held = .false.
    contains
        ! y = K x, with the stiffness K in relative displacements; symmetric, positive semi-definite
        procedure(operator_product), deferred :: stiffness
        ! y = W x, with W near the inverse of K, symmetric and positive definite: the contact free
        procedure :: inverse => operator_inverse
        ! y = 0 where held, and K y = x elsewhere; unless changed, held is that of the call before
        procedure :: held => operator_held
    end type

    abstract interface
        subroutine operator_product(self, x, y, info)
            import :: contact_operator, c_double
            class(contact_operator), intent(inout) :: self
            real(c_double), intent(in) :: x(:)
            real(c_double), intent(out) :: y(:)
            integer, intent(inout) :: info
        end subroutine
    end interface

    ! A host where the library finds it.
    type, private :: operator_place
        class(contact_operator), pointer :: host => null()
        integer :: size = 0
    end type

    ! A structure, reduced to its contact pairs. Copies of it are the same model: release it once.
    type :: contact_model
        type(c_ptr) :: handle = c_null_ptr
        integer :: dim = 0, pairs = 0, fixed = 0
        type(operator_place), pointer, private :: place => null()
    contains
        procedure :: new_flexibility => model_new_flexibility
        procedure :: new_flexibility_sparse => model_new_flexibility_sparse
        procedure :: new_condensed => model_new_condensed
        procedure :: new_two_body => model_new_two_body
        procedure :: new_sparse => model_new_sparse
        procedure :: new_sparse_rows => model_new_sparse_rows
        procedure :: new_surfaces => model_new_surfaces
        procedure :: new_operator => model_new_operator
        procedure :: view => model_view
        procedure :: host_size => model_host_size
        procedure :: stiffness => model_stiffness
        procedure :: frames => model_frames
        procedure :: condensed_load => model_condensed_load
        procedure :: solve => model_solve
        procedure :: certify => model_certify
        procedure :: prove => model_prove
        procedure :: recover => model_recover
        procedure :: nodal_forces => model_nodal_forces
        procedure :: release => model_release
    end type

    ! Equations between degrees of freedom, u(dependent(i)) = sum of coefficients(k) * u(dofs(k)), k from start(i) to
    ! start(i + 1) - 1. signorini_equations in signorini.h says what they may be:
    !     contact_equations(dependent, start, dofs, coefficients)
    type :: contact_equations
        integer, allocatable :: dependent(:), start(:), dofs(:)
        real(c_double), allocatable :: coefficients(:)
    end type

    ! Contact pairs from surfaces. Copies of it are the same pairs: release it once.
    !     dim, pairs, nodes      dimension, number of pairs, number of nodes of the mesh
    !     data                   what was found, with n_folded, on_symmetry and so on, as signorini_surface.h
    !                            has it
    !     node(pairs)            slave node of each pair, counted from 1
    !     gap(pairs), area(pairs)
    !     normal(dim, pairs), tangent(dim, pairs), point(dim, pairs): unit vectors, the first tangent,
    !                            and where the force of each pair acts
    type :: contact_surfaces
        type(c_ptr) :: handle = c_null_ptr
        integer :: dim = 0, pairs = 0, nodes = 0, dofs = 0
        integer, private :: dofs_of_faces = 0
        type(signorini_surface_data) :: data
        integer, allocatable :: node(:)
        real(c_double), allocatable :: gap(:), area(:), normal(:, :), tangent(:, :), point(:, :)
        ! Of joined zones: zone i has the pairs zone_start(i) + 1 to zone_start(i + 1); numbers for
        ! SIGNORINI_LAW_BY_PAIR.
        integer, allocatable :: zone_start(:)
        real(c_double), allocatable :: friction(:)
    contains
        procedure :: pair => surfaces_pair
        procedure :: pair_obstacle => surfaces_pair_obstacle
        procedure :: pair_rigid => surfaces_pair_rigid
        procedure :: join => surfaces_join
        procedure :: summary => surfaces_summary
        procedure :: table => surfaces_table
        procedure :: fields => surfaces_fields
        procedure :: resultant => surfaces_resultant
        procedure :: penetration => surfaces_penetration
        procedure :: adjust => surfaces_adjust
        procedure :: write => surfaces_write
        procedure :: release => surfaces_release
    end type

    ! The first argument that is wrong, and a sentence about it; position 0: none is.
    type, private :: refusal
        integer :: position = 0
        character(len=512) :: sentence = ''
    end type

    ! Faces in the form of C.
    type, private :: face_lists
        type(signorini_faces) :: faces
        integer(c_int64_t), allocatable :: starts(:), nodes(:)
    end type

    ! The arguments of a pairing, with the arrays that its structures point to.
    type, private :: preparation
        type(signorini_surface_settings) :: settings
        integer(c_int32_t), allocatable :: axes(:)
        real(c_double), allocatable :: at(:)
        integer(c_int64_t), allocatable :: dofs(:)
        type(face_lists) :: slave, other
    end type

    private :: text_of, finish, refused, refuse, check_size, check_shape
    private :: check_finite, check_case, check_pairs, check_square, check_dim, check_data, check_starts, check_second
    private :: check_model, check_masters, choose_law, choose_settings, place_of_settings
    private :: check_surfaces, list_faces, check_results, prepare, keep_pairs, keep_arrays, reals_of, address2, finish_sparse
    private :: sparse_matrix, check_components, flat_position, dimension_of, check_found, no_stiffness
    private :: operator_inverse, operator_held, received, call_stiffness, call_inverse, call_held
    private :: address, address_of_extra, copy_states, entries, number, text, tuple, keep_sizes

contains

    ! The sentence of the last call of the library on this thread; its indices count from 1.
    function signorini_message() result(text)
        character(len=:), allocatable :: text
        character(len=512) :: buffer
        call sgmesg(buffer, len(buffer, c_int32_t))
        text = trim(buffer)
    end function

    ! A short description of a status.
    function signorini_status_text(info) result(text)
        integer, intent(in) :: info
        character(len=:), allocatable :: text
        text = text_of(signorini_status_string(number(info)))
    end function

    ! A short description of one remark, such as SIGNORINI_REMARK_FREE_MOTION; report%remarks is a sum of them.
    function signorini_remark_text(remark) result(text)
        integer(c_int32_t), intent(in) :: remark
        character(len=:), allocatable :: text
        text = text_of(signorini_remark_string(remark))
    end function

    ! Solves a condensed contact problem of n = size(f) unknowns, size(f) / size(gap) for each pair.
    ! k(n, n), f(n), gap(pairs), d(n), force(n), slip0(n - pairs).
    subroutine contact_solve(k, f, gap, d, force, info, law, friction, slip0, method, tolerance, &
            max_iterations, settings, state, report, motion, second_d, second_force, second_state, &
            message, escape)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:)
        real(c_double), intent(inout), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: force(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: law, method, max_iterations
        real(c_double), intent(in), contiguous, target, optional :: friction(:), slip0(:)
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        integer, intent(out), optional :: state(:), second_state(:)
        type(signorini_report), intent(out), optional :: report
        real(c_double), intent(out), contiguous, target, optional :: motion(:), second_d(:), second_force(:)
        real(c_double), intent(out), contiguous, target, optional :: escape(:)
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        type(signorini_extra), target :: extra
        integer(c_int32_t), target :: states(size(gap)), second_states(size(gap))
        type(refusal) :: wrong
        integer(c_int32_t) :: which, status
        integer :: n, pairs
        n = size(f)
        pairs = size(gap)
        call check_data(wrong, shape(k), n, pairs, 'k', 'f')
        call check_size(wrong, 4, 'd', size(d), n, 'as many as f')
        call check_size(wrong, 5, 'force', size(force), n, 'as many as f')
        call choose_law(wrong, 7, pairs, which, law, friction)
        if (present(slip0)) call check_size(wrong, 9, 'slip0', size(slip0), n - pairs, 'dim - 1 for each pair')
        call choose_settings(wrong, 10, chosen, method, tolerance, max_iterations, settings)
        if (present(state)) call check_size(wrong, 14, 'state', size(state), pairs, 'one for each pair')
        call check_second(wrong, 16, n, pairs, motion, second_d, second_force, second_state)
        if (present(escape)) call check_size(wrong, 21, 'escape', size(escape), n, 'as many as d')
        if (refused(wrong, info, message)) return
        extra = address_of_extra(second_states, motion, second_d, second_force, escape)
        status = signorini_solve(number(dimension_of(n, pairs)), int(pairs, c_int64_t), k, &
            int(max(1, n), c_int64_t), f, gap, which, address(friction), address(slip0), &
            c_loc(chosen), d, force, c_loc(states), c_loc(measured), c_loc(extra))
        call finish(status, info, message, [2, 3, 1, 1, 2, 3, 7, 8, 9, &
            place_of_settings(10, method, settings), 4, 5, 14, 15, 16])
        if (status >= 0) call copy_states(states, state)
        if (status >= 0) call copy_states(second_states, second_state)
        if (present(report)) report = measured
    end subroutine

    ! Solves a contact problem in flexibility form, d = W force + q with the free displacements q; W
    ! may be singular. w(n, n), q(n), d(n), force(n), slip0(n - pairs). force is the start if settings
    ! ask for one. motion holds the pressing forces that prove SIGNORINI_STATUS_NO_EQUILIBRIUM.
    subroutine contact_solve_flexibility(w, q, gap, d, force, info, law, friction, slip0, method, &
            tolerance, max_iterations, settings, state, report, motion, message)
        real(c_double), intent(in), contiguous :: w(:, :), q(:), gap(:)
        real(c_double), intent(inout), contiguous :: d(:), force(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: law, method, max_iterations
        real(c_double), intent(in), contiguous, target, optional :: friction(:), slip0(:)
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        real(c_double), intent(out), contiguous, target, optional :: motion(:)
        character(len=*), intent(out), optional :: message
        type(contact_model) :: model
        type(refusal) :: wrong
        call check_data(wrong, shape(w), size(q), size(gap), 'w', 'q')
        call check_finite(wrong, 2, 'q', q)
        if (refused(wrong, info, message)) return
        call model%new_flexibility(dimension_of(size(q), size(gap)), w, info, message)
        info = flat_position(info, -1, -1)
        if (info /= 0) return
        call model%solve(q, gap, d, force, info, law=law, friction=friction, slip0=slip0, method=method, &
            tolerance=tolerance, max_iterations=max_iterations, settings=settings, state=state, &
            report=report, motion=motion, message=message)
        info = flat_position(info, 1, 0)
        call model%release()
    end subroutine

    ! contact_solve_flexibility with a sparse W, stored by columns as for new_sparse: col_start(n + 1), row(nnz) ascending
    ! in each column and counted from 1, values(nnz), triangle: which entries are stored. Pairs that no
    ! entry ties to each other are solved by themselves. If the library finds something wrong in the
    ! matrix, info is the position of values; message tells the array.
    subroutine contact_solve_flexibility_sparse(col_start, row, values, triangle, q, gap, d, force, info, &
            law, friction, slip0, method, tolerance, max_iterations, settings, state, report, motion, &
            message)
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        real(c_double), intent(in), contiguous :: q(:), gap(:)
        real(c_double), intent(inout), contiguous :: d(:), force(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: law, method, max_iterations
        real(c_double), intent(in), contiguous, target, optional :: friction(:), slip0(:)
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        real(c_double), intent(out), contiguous, target, optional :: motion(:)
        character(len=*), intent(out), optional :: message
        type(contact_model) :: model
        type(refusal) :: wrong
        call check_components(wrong, 5, size(q), size(gap), 'q')
        call check_size(wrong, 1, 'col_start', size(col_start), size(q) + 1, 'one more than q')
        call check_finite(wrong, 5, 'q', q)
        if (refused(wrong, info, message)) return
        call model%new_flexibility_sparse(dimension_of(size(q), size(gap)), col_start, row, values, &
            triangle, info, message)
        info = flat_position(info, -1, -1)
        if (info /= 0) return
        call model%solve(q, gap, d, force, info, law=law, friction=friction, slip0=slip0, method=method, &
            tolerance=tolerance, max_iterations=max_iterations, settings=settings, state=state, &
            report=report, motion=motion, message=message)
        info = flat_position(info, 4, 3)
        call model%release()
    end subroutine

    ! Measures displacements d of any origin on the data of a condensed problem. info is 0 if they
    ! are a solution up to tolerance, SIGNORINI_STATUS_NOT_A_SOLUTION if not.
    subroutine contact_certify(k, f, gap, d, info, law, friction, slip0, tolerance, force, state, &
            report, message)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), d(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: law
        real(c_double), intent(in), contiguous, target, optional :: friction(:), slip0(:)
        real(c_double), intent(in), optional :: tolerance
        real(c_double), intent(inout), contiguous, target, optional :: force(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        character(len=*), intent(out), optional :: message
        type(contact_model) :: model
        type(refusal) :: wrong
        call check_data(wrong, shape(k), size(f), size(gap), 'k', 'f')
        if (refused(wrong, info, message)) return
        call model%new_condensed(dimension_of(size(f), size(gap)), k, info, message)
        info = flat_position(info, -1, -1)
        if (info /= 0) return
        call model%certify(f, gap, d, info, law=law, friction=friction, slip0=slip0, tolerance=tolerance, &
            force=force, state=state, report=report, message=message)
        info = flat_position(info, 1, 0)
        call model%release()
    end subroutine

    ! Proves that a solution exists next to the displacements d, of any origin: model%prove for the data
    ! of a condensed problem.
    subroutine contact_prove(k, f, gap, d, info, law, friction, slip0, state, force, radius_d, &
            radius_force, message)
        real(c_double), intent(in), contiguous :: k(:, :), f(:), gap(:), d(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: law
        real(c_double), intent(in), contiguous, target, optional :: friction(:), slip0(:)
        integer, intent(in), optional :: state(:)
        real(c_double), intent(out), contiguous, target, optional :: force(:), radius_d(:), radius_force(:)
        character(len=*), intent(out), optional :: message
        type(contact_model) :: model
        type(refusal) :: wrong
        call check_data(wrong, shape(k), size(f), size(gap), 'k', 'f')
        if (refused(wrong, info, message)) return
        call model%new_condensed(dimension_of(size(f), size(gap)), k, info, message)
        info = flat_position(info, -1, -1)
        if (info /= 0) return
        call model%prove(f, gap, d, info, law=law, friction=friction, slip0=slip0, state=state, &
            force=force, radius_d=radius_d, radius_force=radius_force, message=message)
        info = flat_position(info, 1, 0)
        call model%release()
    end subroutine

    ! The position in a flat call of an argument of the model's call, info < 0: the first four, which are
    ! the case's own data, stand `early` places further on, the optional ones `late`.
    pure function flat_position(info, early, late) result(moved)
        integer, intent(in) :: info, early, late
        integer :: moved
        moved = info
        if (info < 0 .and. info > CONTACT_WRONG_MODEL) moved = info - merge(early, late, info >= -4)
    end function

    pure function dimension_of(n, pairs) result(dim)
        integer, intent(in) :: n, pairs
        integer :: dim
        dim = max(2, n / max(1, pairs))
    end function

    ! An LCP: w = q + m z, w >= 0, z >= 0, w . z = 0, with m(n, n), q(n), w(n), z(n). infeasible_by(n):
    ! if info is SIGNORINI_STATUS_NO_EQUILIBRIUM, y >= 0 with m^T y <= 0 and q . y < 0, which proves
    ! that no w >= 0 and z >= 0 satisfy w = q + m z; otherwise zeros. cover(n): the covering vector of
    ! Lemke's method, positive; absent: chosen.
    subroutine lcp_solve(m, q, w, z, info, method, tolerance, max_iterations, settings, &
            infeasible_by, report, message, cover)
        real(c_double), intent(in), contiguous :: m(:, :), q(:)
        real(c_double), intent(in), contiguous, target, optional :: cover(:)
        real(c_double), intent(out), contiguous :: w(:), z(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        real(c_double), intent(out), contiguous, target, optional :: infeasible_by(:)
        type(signorini_report), intent(out), optional :: report
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        type(refusal) :: wrong
        integer :: n
        n = size(q)
        call check_shape(wrong, 1, 'm', shape(m), [n, n], 'a row and a column for each entry of q')
        call check_size(wrong, 3, 'w', size(w), n, 'as many as q')
        call check_size(wrong, 4, 'z', size(z), n, 'as many as q')
        call choose_settings(wrong, 6, chosen, method, tolerance, max_iterations, settings)
        if (present(infeasible_by)) &
            call check_size(wrong, 10, 'infeasible_by', size(infeasible_by), n, 'as many as q')
        if (present(cover)) call check_size(wrong, 13, 'cover', size(cover), n, 'as many as q')
        if (refused(wrong, info, message)) return
        call finish(signorini_lcp_solve(int(n, c_int64_t), m, int(max(1, n), c_int64_t), q, &
            address(cover), c_loc(chosen), w, z, address(infeasible_by), c_loc(measured)), info, message, &
            [2, 1, 1, 2, 13, place_of_settings(6, method, settings), 3, 4, 10, 11])
        if (present(report)) report = measured
    end subroutine

    ! A model of the condensed stiffness k(n, n), n = dim * pairs. settings: callback, time_limit and memory_limit.
    subroutine model_new_condensed(self, dim, k, info, message, settings)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        real(c_double), intent(in), contiguous :: k(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(signorini_settings), intent(in), target, optional :: settings
        type(refusal) :: wrong
        integer :: pairs
        call self%release()
        call check_dim(wrong, 1, dim)
        call check_square(wrong, 2, 'k', shape(k), dim)
        if (refused(wrong, info, message)) return
        pairs = size(k, 2) / dim
        call finish(signorini_model_new_condensed(number(dim), int(pairs, c_int64_t), k, &
            int(max(1, size(k, 1)), c_int64_t), address_of_settings(settings), self%handle), info, message, &
            [1, 2, 2, 2, 5])
        call keep_sizes(self)
    end subroutine

    ! A model of two bodies that face each other in the same frames: k_a(n, n) and k_b(n, n),
    ! n = dim * pairs. A load of the model is that of the first body, then that of the second. settings: as for
    ! new_condensed.
    subroutine model_new_two_body(self, dim, k_a, k_b, info, message, settings)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        real(c_double), intent(in), contiguous :: k_a(:, :), k_b(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(signorini_settings), intent(in), target, optional :: settings
        type(refusal) :: wrong
        integer :: pairs
        call self%release()
        call check_dim(wrong, 1, dim)
        call check_square(wrong, 2, 'k_a', shape(k_a), dim)
        call check_shape(wrong, 3, 'k_b', shape(k_b), shape(k_a), 'as k_a')
        if (refused(wrong, info, message)) return
        pairs = size(k_a, 2) / dim
        call finish(signorini_model_new_two_body(number(dim), int(pairs, c_int64_t), k_a, &
            int(max(1, size(k_a, 1)), c_int64_t), k_b, int(max(1, size(k_b, 1)), c_int64_t), &
            address_of_settings(settings), self%handle), info, message, [1, 2, 2, 2, 3, 3, 6])
        call keep_sizes(self)
    end subroutine

    ! A model in flexibility form, d = W force + q: w(n, n), n = dim * pairs, may be singular. The f of its
    ! load cases are the free displacements q. In %solve force is the start if settings ask for one, and
    ! motion holds the pressing forces that prove SIGNORINI_STATUS_NO_EQUILIBRIUM; in %certify force is
    ! needed and not changed.
    subroutine model_new_flexibility(self, dim, w, info, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        real(c_double), intent(in), contiguous :: w(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call self%release()
        call check_dim(wrong, 1, dim)
        call check_square(wrong, 2, 'w', shape(w), dim)
        if (refused(wrong, info, message)) return
        call finish(signorini_model_new_flexibility(number(dim), int(size(w, 2) / dim, c_int64_t), w, &
            int(max(1, size(w, 1)), c_int64_t), self%handle), info, message, [1, 2, 2, 2])
        call keep_sizes(self)
    end subroutine

    ! new_flexibility with a sparse w, stored as for new_sparse.
    subroutine model_new_flexibility_sparse(self, dim, col_start, row, values, triangle, info, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        integer :: n
        call self%release()
        call check_dim(wrong, 1, dim)
        call check_sparse(wrong, 2, col_start, row, values, triangle)
        n = size(col_start) - 1
        if (wrong%position == 0 .and. mod(n, max(1, dim)) /= 0) call refuse(wrong, 2, 'col_start has ' // &
            entries(n + 1) // ', it must have 1 more than a multiple of dim (' // text(dim) // ')')
        if (refused(wrong, info, message)) return
        call finish(signorini_model_new_flexibility_sparse(number(dim), int(n / dim, c_int64_t), &
            sparse_matrix(col_start, row, values, triangle), self%handle), info, message, [1, 4, 4])
        call keep_sizes(self)
    end subroutine

    ! A model of a whole sparse symmetric matrix of n rows by columns, whose indices count from 1:
    ! col_start(n + 1), row(nnz) ascending in each column, values(nnz), triangle: which entries are
    ! stored, SIGNORINI_TRIANGLE_LOWER, _UPPER or _FULL.
    !
    ! slaves(dim, pairs): degrees of freedom of each slave node. normals(dim, pairs), outward from the
    ! slave's body. tangents(dim, pairs): the first tangents; absent: chosen. fixed: degrees of
    ! freedom that supports hold.
    ! masters(dim, m): degrees of freedom of all master nodes, weights(m), master_start(pairs + 1):
    ! those of pair i are master_start(i) to master_start(i + 1) - 1. Without masters the obstacle
    ! is rigid. order: the order of elimination, each degree of freedom once; absent: chosen. settings:
    ! progress, user, time_limit, memory_limit, full_space and threads count. If the library finds something
    ! wrong in the matrix, info is the position of values, if in the pairs or equations, that of slaves; message
    ! tells the array.
    subroutine model_new_sparse(self, col_start, row, values, triangle, slaves, normals, info, fixed, &
            master_start, masters, weights, tangents, message, order, settings, equations)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        integer, intent(in) :: slaves(:, :)
        real(c_double), intent(in), contiguous, target :: normals(:, :)
        integer, intent(out) :: info
        integer, intent(in), optional :: fixed(:), master_start(:), masters(:, :)
        real(c_double), intent(in), contiguous, target, optional :: weights(:), tangents(:, :)
        character(len=*), intent(out), optional :: message
        integer, intent(in), contiguous, target, optional :: order(:)
        type(signorini_settings), intent(in), optional :: settings
        type(contact_equations), intent(in), optional :: equations
        type(signorini_pairs) :: pairs
        integer(c_int64_t), allocatable, target :: of_slaves(:), begins(:), of_masters(:)
        type(refusal) :: wrong
        call self%release()
        call check_sparse(wrong, 1, col_start, row, values, triangle)
        call check_pairs(wrong, 6, 'normals', shape(normals), shape(slaves))
        call check_masters(wrong, 9, shape(slaves), master_start, masters, weights)
        if (present(tangents)) call check_pairs(wrong, 12, 'tangents', shape(tangents), shape(slaves))
        if (present(order)) call check_size(wrong, 14, 'order', size(order), size(col_start) - 1, &
            'as many as the matrix has columns')
        if (present(equations)) call check_equations(wrong, 16, equations)
        if (refused(wrong, info, message)) return
        of_slaves = int([slaves], c_int64_t)
        if (size(slaves) > 0) pairs%slaves = c_loc(of_slaves)
        if (present(masters)) then
            begins = int(master_start, c_int64_t)
            of_masters = int([masters], c_int64_t)
            pairs%master_start = c_loc(begins)
            if (size(masters) > 0) pairs%masters = c_loc(of_masters)
            pairs%weights = address(weights)
        end if
        call make_sparse(self, col_start, row, values, triangle, pairs, normals, tangents, fixed, &
            info, message, [3, 8, 8, 5, 15], order, settings, equations)
    end subroutine

    ! new_sparse with general rows: each pair is a list of nodes with signed weights.
    ! row_nodes(dim, m): degrees of freedom of all nodes, row_weights(m): positive on the side whose
    ! outward normal is given, negative on the other, of sum 0 in a pair, and 1 against a rigid
    ! obstacle; row_start(pairs + 1): those of pair i are row_start(i) to row_start(i + 1) - 1. If
    ! the library finds something wrong in the pairs, info is the position of row_nodes.
    subroutine model_new_sparse_rows(self, col_start, row, values, triangle, row_start, row_nodes, &
            row_weights, normals, info, fixed, tangents, message, equations)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        integer, intent(in) :: row_start(:), row_nodes(:, :)
        real(c_double), intent(in), contiguous, target :: row_weights(:), normals(:, :)
        integer, intent(out) :: info
        integer, intent(in), optional :: fixed(:)
        real(c_double), intent(in), contiguous, target, optional :: tangents(:, :)
        character(len=*), intent(out), optional :: message
        type(contact_equations), intent(in), optional :: equations
        type(signorini_pairs) :: pairs
        integer(c_int64_t), allocatable, target :: begins(:), of_nodes(:)
        type(refusal) :: wrong
        call self%release()
        call check_sparse(wrong, 1, col_start, row, values, triangle)
        call check_size(wrong, 5, 'row_start', size(row_start), size(normals, 2) + 1, 'one more than pairs')
        call check_shape(wrong, 6, 'row_nodes', shape(row_nodes), [size(normals, 1), size(row_weights)], &
            '(dim, entries of row_weights)')
        call check_starts(wrong, 5, 'row_start', row_start, size(row_weights), 'row_weights has entries')
        if (present(tangents)) call check_shape(wrong, 11, 'tangents', shape(tangents), shape(normals), &
            '(dim, pairs), as normals')
        if (present(equations)) call check_equations(wrong, 13, equations)
        if (refused(wrong, info, message)) return
        begins = int(row_start, c_int64_t)
        of_nodes = int([row_nodes], c_int64_t)
        pairs%row_start = c_loc(begins)
        if (size(row_nodes) > 0) pairs%row_nodes = c_loc(of_nodes)
        pairs%row_weights = address(row_weights)
        call make_sparse(self, col_start, row, values, triangle, pairs, normals, tangents, fixed, &
            info, message, [3, 10, 10, 6, 0], equations=equations)
    end subroutine

    ! Makes a model of a sparse matrix with pairs that have their nodes.
    subroutine make_sparse(self, col_start, row, values, triangle, pairs, normals, tangents, fixed, &
            info, message, positions, order, settings, equations)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        type(signorini_pairs), intent(inout) :: pairs
        real(c_double), intent(in), contiguous, target :: normals(:, :)
        real(c_double), intent(in), contiguous, target, optional :: tangents(:, :)
        integer, intent(in), optional :: fixed(:)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        integer, intent(in) :: positions(5)
        integer, intent(in), contiguous, target, optional :: order(:)
        type(signorini_settings), intent(in), optional :: settings
        type(contact_equations), intent(in), optional :: equations
        pairs%dim = number(size(normals, 1))
        pairs%count = size(normals, 2)
        pairs%normals = address2(normals)
        pairs%tangents = address2(tangents)
        call finish_sparse(self, col_start, row, values, triangle, pairs, fixed, info, message, &
            positions, order, settings, equations)
    end subroutine

    ! A model of a whole sparse matrix, as for new_sparse, with the pairs of surfaces. If the library
    ! finds something wrong in the matrix, info is the position of values, if in the pairs, that of
    ! surfaces. The gap of a load case is surfaces%gap.
    subroutine model_new_surfaces(self, col_start, row, values, triangle, surfaces, info, fixed, message, &
            equations)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        class(contact_surfaces), intent(in) :: surfaces
        integer, intent(out) :: info
        integer, intent(in), optional :: fixed(:)
        character(len=*), intent(out), optional :: message
        type(contact_equations), intent(in), optional :: equations
        type(signorini_pairs), pointer :: pairs
        type(refusal) :: wrong
        call self%release()
        call check_sparse(wrong, 1, col_start, row, values, triangle)
        call check_surfaces(wrong, surfaces, 5)
        if (present(equations)) call check_equations(wrong, 9, equations)
        if (refused(wrong, info, message)) return
        call c_f_pointer(surfaces%data%rows, pairs)
        call finish_sparse(self, col_start, row, values, triangle, pairs, fixed, info, message, &
            [3, 7, 7, 5, 0], equations=equations)
    end subroutine

    ! Makes a model of a sparse matrix with pairs that are complete.
    subroutine finish_sparse(self, col_start, row, values, triangle, pairs, fixed, info, message, &
            positions, order, settings, equations)
        class(contact_model), intent(inout) :: self
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        type(signorini_pairs), intent(in) :: pairs
        integer, intent(in), optional :: fixed(:)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        integer, intent(in) :: positions(5)
        integer, intent(in), contiguous, target, optional :: order(:)
        type(signorini_settings), intent(in), optional :: settings
        type(contact_equations), intent(in), optional :: equations
        type(signorini_settings), target :: chosen
        type(signorini_equations), target :: given
        type(signorini_pairs) :: complete
        type(signorini_sparse) :: matrix
        integer(c_int64_t), allocatable, target :: held(:), dependent(:), start(:), dofs(:)
        real(c_double), allocatable, target :: coefficients(:)
        integer(c_int64_t) :: n_fixed
        matrix = sparse_matrix(col_start, row, values, triangle)
        if (present(order)) then
            if (size(order) > 0) matrix%order = c_loc(order)
        end if
        if (present(settings)) chosen = settings
        complete = pairs
        if (present(equations)) then
            ! An entry more: an address may be that of no array without entries.
            allocate (dependent(size(equations%dependent) + 1), start(size(equations%start)), &
                dofs(size(equations%dofs) + 1), coefficients(size(equations%dofs) + 1))
            dependent(:) = int([equations%dependent, 0], c_int64_t)
            start(:) = int(equations%start, c_int64_t)
            dofs(:) = int([equations%dofs, 0], c_int64_t)
            coefficients(:) = [equations%coefficients, 0._c_double]
            given = signorini_equations(count=size(equations%dependent), dependent=c_loc(dependent), &
                start=c_loc(start), dofs=c_loc(dofs), coefficients=c_loc(coefficients))
            complete%equations = c_loc(given)
        end if
        n_fixed = 0
        if (present(fixed)) n_fixed = size(fixed)
        allocate (held(max(1_c_int64_t, n_fixed)))
        held = 0
        if (n_fixed > 0) held = int(fixed, c_int64_t)
        call finish(signorini_model_new_sparse(matrix, n_fixed, c_loc(held), complete, &
            c_loc(chosen), self%handle), info, message, positions)
        call keep_sizes(self)
    end subroutine

    ! Its sizes, the memory that a load case takes, and how load cases are solved: see signorini.h.
    function model_view(self) result(data)
        class(contact_model), intent(in) :: self
        type(signorini_model_data) :: data
        integer(c_int32_t) :: status
        if (.not. c_associated(self%handle)) return
        status = signorini_model_view(self%handle, data)
        if (status /= 0) data = signorini_model_data()
    end function

    ! Entries of a load or displacement vector of the model's host; -1 without a model.
    function model_host_size(self) result(entries)
        class(contact_model), intent(in) :: self
        integer :: entries
        type(signorini_model_data) :: data
        data = self%view()
        entries = int(data%host_size)
    end function

    ! The condensed stiffness k(n, n), n = dim * pairs.
    subroutine model_stiffness(self, k, info, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(out), contiguous :: k(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(signorini_model_data) :: data
        real(c_double), pointer :: found(:, :)
        type(refusal) :: wrong
        integer :: n
        n = self%dim * self%pairs
        data = self%view()
        call check_model(wrong, self)
        call check_shape(wrong, 1, 'k', shape(k), [n, n], 'dim * pairs rows and columns')
        call check_found(wrong, data%k, n, no_stiffness(data))
        if (refused(wrong, info, message)) return
        info = 0
        if (present(message)) message = ''
        if (n == 0) return
        call c_f_pointer(data%k, found, [n, n])
        k = found
    end subroutine

    ! The frames that the model uses, frames(dim, dim, pairs): frames(:, 1, i) is the normal of pair
    ! i, then come its tangents, all of unit length. A vector d of pair i in global axes is
    ! matmul(frames(:, :, i), d). A model that its host condensed knows none: info is
    ! CONTACT_WRONG_MODEL.
    subroutine model_frames(self, frames, info, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(out), contiguous :: frames(:, :, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(signorini_model_data) :: data
        real(c_double), pointer :: found(:, :, :)
        type(refusal) :: wrong
        data = self%view()
        call check_model(wrong, self)
        call check_shape(wrong, 1, 'frames', shape(frames), [self%dim, self%dim, self%pairs], &
            '(dim, dim, pairs)')
        call check_found(wrong, data%frames, self%pairs, &
            'the model knows no frames: its matrix was condensed in frames of your own')
        if (refused(wrong, info, message)) return
        info = 0
        if (present(message)) message = ''
        if (self%pairs == 0) return
        call c_f_pointer(data%frames, found, shape(frames))
        frames = found
    end subroutine

    ! An array of a model, of so many entries or more, that may not be there.
    subroutine check_found(wrong, array, count, sentence)
        type(refusal), intent(inout) :: wrong
        type(c_ptr), intent(in) :: array
        integer, intent(in) :: count
        character(len=*), intent(in) :: sentence
        if (count > 0 .and. .not. c_associated(array)) call refuse(wrong, CONTACT_WRONG_MODEL, sentence)
    end subroutine

    ! The reason why a model has no stiffness matrix.
    function no_stiffness(data) result(sentence)
        type(signorini_model_data), intent(in) :: data
        character(len=:), allocatable :: sentence
        select case (data%kind)
        case (SIGNORINI_MODEL_FULL_SPACE)
            sentence = 'there is no stiffness matrix: the model is solved in full space'
        case (SIGNORINI_MODEL_OPERATOR)
            sentence = 'there is no stiffness matrix: the model has products of the host'
        case (SIGNORINI_MODEL_FLEXIBILITY)
            sentence = 'there is no stiffness matrix: the model has a flexibility'
        case default
            sentence = 'there is no stiffness matrix: the rows of pairs (' // &
                text(int(data%dependent)) // ' of them) follow from those of other pairs or from supports'
        end select
    end function

    ! The load of a case on the contact components, load(dim * pairs): the f of contact_solve.
    subroutine model_condensed_load(self, f, load, info, prescribed, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(out), contiguous :: load(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:)
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_model(wrong, self)
        call check_case(wrong, self, size(f), 4, prescribed)
        call check_size(wrong, 2, 'load', size(load), self%dim * self%pairs, 'dim * pairs')
        if (refused(wrong, info, message)) return
        call finish(signorini_model_condensed_load(self%handle, address(f), address(prescribed), &
            load), info, message, [CONTACT_WRONG_MODEL, 1, 4, 2])
    end subroutine

    ! Solves one load case: f(host_size()), prescribed: values of the degrees of freedom of fixed,
    ! absent: zeros.
    subroutine model_solve(self, f, gap, d, force, info, prescribed, law, friction, slip0, method, &
            tolerance, max_iterations, settings, state, report, motion, second_d, second_force, &
            second_state, message, escape)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(in), contiguous :: gap(:)
        real(c_double), intent(inout), contiguous :: d(:), force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:), friction(:), slip0(:)
        integer, intent(in), optional :: law, method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        integer, intent(out), optional :: state(:), second_state(:)
        type(signorini_report), intent(out), optional :: report
        real(c_double), intent(out), contiguous, target, optional :: motion(:), second_d(:), second_force(:)
        real(c_double), intent(out), contiguous, target, optional :: escape(:)
        character(len=*), intent(out), optional :: message
        type(signorini_settings), target :: chosen
        type(signorini_report), target :: measured
        type(signorini_extra), target :: extra
        integer(c_int32_t), target :: states(self%pairs), second_states(self%pairs)
        type(refusal) :: wrong
        integer(c_int32_t) :: which, status
        integer :: n, pairs
        pairs = self%pairs
        n = self%dim * pairs
        call check_model(wrong, self)
        call check_case(wrong, self, size(f), 6, prescribed)
        call check_size(wrong, 2, 'gap', size(gap), pairs, 'one for each pair')
        call check_size(wrong, 3, 'd', size(d), n, 'dim * pairs')
        call check_size(wrong, 4, 'force', size(force), n, 'dim * pairs')
        call choose_law(wrong, 7, pairs, which, law, friction)
        if (present(slip0)) call check_size(wrong, 9, 'slip0', size(slip0), n - pairs, 'dim - 1 for each pair')
        call choose_settings(wrong, 10, chosen, method, tolerance, max_iterations, settings)
        if (present(state)) call check_size(wrong, 14, 'state', size(state), pairs, 'one for each pair')
        call check_second(wrong, 16, n, pairs, motion, second_d, second_force, second_state)
        if (present(escape)) call check_size(wrong, 21, 'escape', size(escape), n, 'as many as d')
        if (refused(wrong, info, message)) return
        extra = address_of_extra(second_states, motion, second_d, second_force, escape)
        status = signorini_model_solve(self%handle, 1_c_int64_t, address(f), address(prescribed), gap, &
            which, address(friction), address(slip0), c_loc(chosen), d, force, c_loc(states), &
            c_null_ptr, c_loc(measured), c_loc(extra))
        call finish(status, info, message, [CONTACT_WRONG_MODEL, 1, 1, 6, 2, 7, 8, 9, &
            place_of_settings(10, method, settings), 3, 4, 14, 5, 15, 16])
        if (status >= 0) call copy_states(states, state)
        if (status >= 0) call copy_states(second_states, second_state)
        if (present(report)) report = measured
    end subroutine

    ! Measures displacements d of any origin on a load case of the model. force is set; of a model in
    ! flexibility form, and where pairs depend on each other, it is needed and not changed.
    subroutine model_certify(self, f, gap, d, info, prescribed, law, friction, slip0, tolerance, &
            force, state, report, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(in), contiguous :: gap(:), d(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:), friction(:), slip0(:)
        integer, intent(in), optional :: law
        real(c_double), intent(in), optional :: tolerance
        real(c_double), intent(inout), contiguous, target, optional :: force(:)
        integer, intent(out), optional :: state(:)
        type(signorini_report), intent(out), optional :: report
        character(len=*), intent(out), optional :: message
        type(signorini_settings) :: chosen
        type(signorini_report), target :: measured
        integer(c_int32_t), target :: states(self%pairs)
        type(refusal) :: wrong
        integer(c_int32_t) :: which, status
        integer :: n, pairs
        pairs = self%pairs
        n = self%dim * pairs
        call check_model(wrong, self)
        call check_case(wrong, self, size(f), 5, prescribed)
        call check_size(wrong, 2, 'gap', size(gap), pairs, 'one for each pair')
        call check_size(wrong, 3, 'd', size(d), n, 'dim * pairs')
        call choose_law(wrong, 6, pairs, which, law, friction)
        if (present(slip0)) call check_size(wrong, 8, 'slip0', size(slip0), n - pairs, 'dim - 1 for each pair')
        if (present(force)) call check_size(wrong, 10, 'force', size(force), n, 'dim * pairs')
        if (present(state)) call check_size(wrong, 11, 'state', size(state), pairs, 'one for each pair')
        if (refused(wrong, info, message)) return
        if (present(tolerance)) chosen%tolerance = tolerance
        status = signorini_model_certify(self%handle, address(f), address(prescribed), gap, which, &
            address(friction), address(slip0), chosen%tolerance, d, address(force), c_loc(states), &
            c_loc(measured))
        call finish(status, info, message, [CONTACT_WRONG_MODEL, 1, 5, 2, 6, 7, 8, 9, 3, 10, 11, 12])
        if (status >= 0) call copy_states(states, state)
        if (present(report)) report = measured
    end subroutine

    ! Proves that a solution exists next to the displacements d, of any origin, with the states of the
    ! pairs, those of d if state is absent. force(n): its contact forces; radius_d(n), radius_force(n): it
    ! is within these distances of d and of force, component by component. info is
    ! SIGNORINI_STATUS_NOT_PROVED if it is not proved, which does not say that there is none.
    subroutine model_prove(self, f, gap, d, info, prescribed, law, friction, slip0, state, force, &
            radius_d, radius_force, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(in), contiguous :: gap(:), d(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:), friction(:), slip0(:)
        integer, intent(in), optional :: law, state(:)
        real(c_double), intent(out), contiguous, target, optional :: force(:), radius_d(:), radius_force(:)
        character(len=*), intent(out), optional :: message
        integer(c_int32_t), target :: states(self%pairs)
        type(c_ptr) :: given
        type(refusal) :: wrong
        integer(c_int32_t) :: which, status
        integer :: n, pairs
        pairs = self%pairs
        n = self%dim * pairs
        call check_model(wrong, self)
        call check_case(wrong, self, size(f), 5, prescribed)
        call check_size(wrong, 2, 'gap', size(gap), pairs, 'one for each pair')
        call check_size(wrong, 3, 'd', size(d), n, 'dim * pairs')
        call choose_law(wrong, 6, pairs, which, law, friction)
        if (present(slip0)) call check_size(wrong, 8, 'slip0', size(slip0), n - pairs, 'dim - 1 for each pair')
        if (present(state)) call check_size(wrong, 9, 'state', size(state), pairs, 'one for each pair')
        if (present(force)) call check_size(wrong, 10, 'force', size(force), n, 'dim * pairs')
        if (present(radius_d)) call check_size(wrong, 11, 'radius_d', size(radius_d), n, 'dim * pairs')
        if (present(radius_force)) &
            call check_size(wrong, 12, 'radius_force', size(radius_force), n, 'dim * pairs')
        if (refused(wrong, info, message)) return
        given = c_null_ptr
        if (present(state)) then
            states = int(state, c_int32_t)
            given = c_loc(states)
        end if
        status = signorini_model_prove(self%handle, address(f), address(prescribed), gap, which, &
            address(friction), address(slip0), d, given, address(force), address(radius_d), &
            address(radius_force))
        call finish(status, info, message, [CONTACT_WRONG_MODEL, 1, 5, 2, 6, 7, 8, 3, 9, 10, 11, 12])
    end subroutine

    ! Displacements u(host_size()) of the host that belong to d.
    subroutine model_recover(self, f, d, u, info, prescribed, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: f(:)
        real(c_double), intent(in), contiguous :: d(:)
        real(c_double), intent(out), contiguous :: u(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: prescribed(:)
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_model(wrong, self)
        call check_case(wrong, self, size(f), 5, prescribed)
        call check_size(wrong, 2, 'd', size(d), self%dim * self%pairs, 'dim * pairs')
        call check_size(wrong, 3, 'u', size(u), self%host_size(), 'as many as f')
        if (refused(wrong, info, message)) return
        call finish(signorini_model_recover(self%handle, 1_c_int64_t, address(f), address(prescribed), &
            d, u), info, message, [CONTACT_WRONG_MODEL, 1, 1, 5, 2, 3])
    end subroutine

    ! Contact forces as a nodal force vector nodal(host_size()) of the host.
    subroutine model_nodal_forces(self, force, nodal, info, message)
        class(contact_model), intent(in) :: self
        real(c_double), intent(in), contiguous :: force(:)
        real(c_double), intent(out), contiguous :: nodal(:)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_model(wrong, self)
        call check_size(wrong, 1, 'force', size(force), self%dim * self%pairs, 'dim * pairs')
        call check_size(wrong, 2, 'nodal', size(nodal), self%host_size(), 'those of the host')
        if (refused(wrong, info, message)) return
        call finish(signorini_model_nodal_forces(self%handle, force, nodal), info, message, &
            [CONTACT_WRONG_MODEL, 1, 2])
    end subroutine

    ! A model of products and solutions of a host alone, for dim * pairs relative displacements. The host
    ! must live as long as the model. units(dim * pairs): force per length, of the size of the diagonal
    ! of K; absent: from products. Before it returns some products are checked.
    subroutine model_new_operator(self, dim, pairs, host, info, units, message)
        class(contact_model), intent(inout) :: self
        integer, intent(in) :: dim, pairs
        class(contact_operator), intent(inout), target :: host
        integer, intent(out) :: info
        real(c_double), intent(in), optional, target, contiguous :: units(:)
        character(len=*), intent(out), optional :: message
        type(signorini_operator) :: functions
        type(refusal) :: wrong
        call self%release()
        call check_dim(wrong, 1, dim)
        if (pairs < 0) call refuse(wrong, 2, 'pairs is ' // text(pairs) // ', it must not be negative')
        if (present(units)) call check_size(wrong, 5, 'units', size(units), dim * pairs, 'dim for each pair')
        if (refused(wrong, info, message)) return
        allocate (self%place)
        self%place%host => host
        self%place%size = dim * pairs
        functions%dim = number(dim)
        functions%pairs = int(pairs, c_int64_t)
        functions%stiffness = c_funloc(call_stiffness)
        if (host%has_inverse) functions%inverse = c_funloc(call_inverse)
        if (host%has_held) functions%held = c_funloc(call_held)
        if (present(units)) then
            if (size(units) > 0) functions%units = c_loc(units)
        end if
        functions%user = c_loc(self%place)
        call finish(signorini_model_new_operator(functions, self%handle), info, message, [3, 3])
        call keep_sizes(self)
        if (info /= 0) deallocate (self%place)
    end subroutine

    ! The host says that it has one, and has not written it: the call of the library ends.
    subroutine operator_inverse(self, x, y, info)
        class(contact_operator), intent(inout) :: self
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        y = x
        info = merge(-1, -2, self%has_inverse)
    end subroutine

    ! As operator_inverse.
    subroutine operator_held(self, held, changed, x, y, info)
        class(contact_operator), intent(inout) :: self
        logical, intent(in) :: held(:), changed
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        y = merge(0d0, x, held)
        info = merge(-1, -2, changed .or. self%has_held)
    end subroutine

    ! The host of a call, and the vectors of it.
    subroutine received(user, x, y, place, from, to)
        type(c_ptr), intent(in) :: user, x, y
        type(operator_place), pointer, intent(out) :: place
        real(c_double), pointer, intent(out) :: from(:), to(:)
        call c_f_pointer(user, place)
        call c_f_pointer(x, from, [place%size])
        call c_f_pointer(y, to, [place%size])
    end subroutine

    function call_stiffness(user, x, y) bind(C, name="") result(answer)
        type(c_ptr), value :: user, x, y
        integer(c_int32_t) :: answer
        type(operator_place), pointer :: place
        real(c_double), pointer :: from(:), to(:)
        integer :: info
        call received(user, x, y, place, from, to)
        info = 0
        call place%host%stiffness(from, to, info)
        answer = number(info)
    end function

    function call_inverse(user, x, y) bind(C, name="") result(answer)
        type(c_ptr), value :: user, x, y
        integer(c_int32_t) :: answer
        type(operator_place), pointer :: place
        real(c_double), pointer :: from(:), to(:)
        integer :: info
        call received(user, x, y, place, from, to)
        info = 0
        call place%host%inverse(from, to, info)
        answer = number(info)
    end function

    function call_held(user, held, changed, x, y) bind(C, name="") result(answer)
        type(c_ptr), value :: user, held, x, y
        integer(c_int32_t), value :: changed
        integer(c_int32_t) :: answer
        type(operator_place), pointer :: place
        integer(c_int32_t), pointer :: mask(:)
        real(c_double), pointer :: from(:), to(:)
        integer :: info
        call received(user, x, y, place, from, to)
        call c_f_pointer(held, mask, [place%size])
        info = 0
        call place%host%held(mask /= 0, changed /= 0, from, to, info)
        answer = number(info)
    end function

    subroutine model_release(self)
        class(contact_model), intent(inout) :: self
        call signorini_model_free(self%handle)
        self%handle = c_null_ptr
        if (associated(self%place)) deallocate (self%place)
        call keep_sizes(self)
    end subroutine

    subroutine keep_sizes(self)
        class(contact_model), intent(inout) :: self
        type(signorini_model_data) :: data
        data = self%view()
        self%dim = int(data%dim)
        self%pairs = int(data%pairs)
        self%fixed = int(data%fixed)
    end subroutine

    ! Pairs two surfaces of a mesh. Surfaces that never meet are no error: there are no pairs, and
    ! summary() says why. coordinates(dim, nodes). slave(k, faces), master(k, faces): nodes of each
    ! face, counted from 1; a face with fewer than k nodes ends with zeros. signorini_surface.h tells their
    ! order. pairing: SIGNORINI_PAIRING_DUAL_MORTAR, the default, or _NODE_TO_SURFACE.
    ! search_distance: absent: the default of signorini_surface.h. dofs(dim, nodes): degrees of
    ! freedom of each node; absent: dofs_per_node * (node - 1) + axis, dofs_per_node absent: dim.
    ! symmetry_axes, symmetry_at: planes of symmetry of half and quarter models, the axis across each
    ! of them (1, 2, 3) and where it stands along that axis: pairs on one do not slip across it.
    ! normals: SIGNORINI_NORMALS_AVERAGED, the default, or _FACES. rims: SIGNORINI_RIMS_FOLD, the default,
    ! _KEEP or _FOLD_LITTLE. settings: in the place of the defaults, for axisymmetric, fitted, slave_shape and the fields after it,
    ! time_limit, progress and user; an argument that is present comes before it. Its lists count from 1,
    ! whatever its index_base is.
    subroutine surfaces_pair(self, coordinates, slave, master, info, pairing, search_distance, dofs, &
            dofs_per_node, symmetry_axes, symmetry_at, normals, rims, message, settings)
        class(contact_surfaces), intent(inout) :: self
        real(c_double), intent(in), contiguous, target :: coordinates(:, :)
        integer, intent(in) :: slave(:, :), master(:, :)
        type(signorini_surface_settings), intent(in), optional :: settings
        integer, intent(out) :: info
        integer, intent(in), optional :: pairing, dofs(:, :), dofs_per_node, symmetry_axes(:), normals, rims
        real(c_double), intent(in), optional :: search_distance, symmetry_at(:)
        character(len=*), intent(out), optional :: message
        type(preparation), target :: told
        type(refusal) :: wrong
        call self%release()
        call prepare(wrong, 6, told, shape(coordinates), slave, search_distance, dofs, dofs_per_node, &
            symmetry_axes, symmetry_at, normals, rims, settings)
        if (present(pairing)) then
            told%settings%pairing = number(pairing)
            if (pairing /= SIGNORINI_PAIRING_DUAL_MORTAR .and. pairing /= SIGNORINI_PAIRING_NODE_TO_SURFACE) &
                call refuse(wrong, 5, 'there is no pairing ' // text(pairing))
        end if
        if (refused(wrong, info, message)) return
        call list_faces(master, told%other)
        call finish(signorini_surface_pair(number(size(coordinates, 1)), &
            int(size(coordinates, 2), c_int64_t), address2(coordinates), c_loc(told%slave%faces), &
            c_loc(told%other%faces), c_loc(told%settings), self%handle), info, message, [1, 1, 1, 2, 3, 6])
        if (info == 0) call keep_pairs(self, shape(coordinates), told, told%other%nodes)
    end subroutine

    ! Pairs a surface with a rigid obstacle; the rest as for pair. search_distance absent: no limit.
    subroutine surfaces_pair_obstacle(self, coordinates, slave, obstacle, info, search_distance, dofs, &
            dofs_per_node, symmetry_axes, symmetry_at, message, settings)
        class(contact_surfaces), intent(inout) :: self
        type(signorini_surface_settings), intent(in), optional :: settings
        real(c_double), intent(in), contiguous, target :: coordinates(:, :)
        integer, intent(in) :: slave(:, :)
        type(signorini_obstacle), intent(in), target :: obstacle
        integer, intent(out) :: info
        real(c_double), intent(in), optional :: search_distance, symmetry_at(:)
        integer, intent(in), optional :: dofs(:, :), dofs_per_node, symmetry_axes(:)
        character(len=*), intent(out), optional :: message
        type(preparation), target :: told
        type(refusal) :: wrong
        call self%release()
        call prepare(wrong, 5, told, shape(coordinates), slave, search_distance, dofs, dofs_per_node, &
            symmetry_axes, symmetry_at, settings=settings)
        if (refused(wrong, info, message)) return
        call finish(signorini_surface_pair_obstacle(number(size(coordinates, 1)), &
            int(size(coordinates, 2), c_int64_t), address2(coordinates), c_loc(told%slave%faces), &
            c_loc(obstacle), c_loc(told%settings), self%handle), info, message, [1, 1, 1, 2, 3, 5])
        if (info == 0) call keep_pairs(self, shape(coordinates), told)
    end subroutine

    ! Pairs a surface with a rigid mesh: rigid_coordinates(dim, nodes) and rigid_faces(nodes of a face,
    ! faces) in nodes of its own, counted from 1; corners counterclockwise as the body sees them. The
    ! rest as for pair.
    subroutine surfaces_pair_rigid(self, coordinates, slave, rigid_coordinates, rigid_faces, info, &
            search_distance, dofs, dofs_per_node, symmetry_axes, symmetry_at, normals, rims, message, settings)
        class(contact_surfaces), intent(inout) :: self
        type(signorini_surface_settings), intent(in), optional :: settings
        real(c_double), intent(in), contiguous, target :: coordinates(:, :)
        integer, intent(in) :: slave(:, :)
        real(c_double), intent(in), contiguous, target :: rigid_coordinates(:, :)
        integer, intent(in) :: rigid_faces(:, :)
        integer, intent(out) :: info
        real(c_double), intent(in), optional :: search_distance, symmetry_at(:)
        integer, intent(in), optional :: dofs(:, :), dofs_per_node, symmetry_axes(:), normals, rims
        character(len=*), intent(out), optional :: message
        type(signorini_obstacle), target :: obstacle
        type(preparation), target :: told
        type(refusal) :: wrong
        call self%release()
        if (size(rigid_coordinates, 1) /= size(coordinates, 1)) call refuse(wrong, 3, &
            'rigid_coordinates and coordinates differ in their first size, the dimension')
        call prepare(wrong, 6, told, shape(coordinates), slave, search_distance, dofs, dofs_per_node, &
            symmetry_axes, symmetry_at, normals, rims, settings)
        if (refused(wrong, info, message)) return
        call list_faces(rigid_faces, told%other)
        obstacle%kind = SIGNORINI_OBSTACLE_FACES
        obstacle%nodes = size(rigid_coordinates, 2)
        obstacle%coordinates = address2(rigid_coordinates)
        obstacle%faces = c_loc(told%other%faces)
        call finish(signorini_surface_pair_obstacle(number(size(coordinates, 1)), &
            int(size(coordinates, 2), c_int64_t), address2(coordinates), c_loc(told%slave%faces), &
            c_loc(obstacle), c_loc(told%settings), self%handle), info, message, [1, 1, 1, 2, 4, 6])
        if (info == 0) call keep_pairs(self, shape(coordinates), told)
    end subroutine

    ! Joins the pairs of zones on one mesh, each with a name. laws: of each zone, absent: no friction. numbers(:, zones):
    ! the parameters of each law, one set for all pairs of the zone; of a law without parameters zeros.
    subroutine surfaces_join(self, zones, names, info, laws, numbers, message)
        class(contact_surfaces), intent(inout) :: self
        type(contact_surfaces), intent(in) :: zones(:)
        character(len=*), intent(in) :: names(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: laws(:)
        real(c_double), intent(in), optional :: numbers(:, :)
        character(len=*), intent(out), optional :: message
        type(signorini_contact_zone), allocatable, target :: given(:)
        character(kind=c_char), allocatable, target :: letters(:, :)
        real(c_double), allocatable, target :: friction(:, :)
        type(refusal) :: wrong
        integer :: i, k, given_numbers, given_columns
        call self%release()
        call check_size(wrong, 2, 'names', size(names), size(zones), 'one for each zone')
        if (present(laws)) call check_size(wrong, 4, 'laws', size(laws), size(zones), 'one for each zone')
        if (present(numbers)) call check_size(wrong, 5, 'numbers', size(numbers, 2), size(zones), &
            'a column for each zone')
        given_numbers = 0
        given_columns = 0
        if (present(numbers)) given_columns = size(numbers, 2)
        if (present(numbers)) given_numbers = size(numbers, 1)
        if (present(numbers) .and. .not. present(laws)) call refuse(wrong, 4, 'laws is missing: numbers are those of ' // &
            'the law of each zone, as SIGNORINI_LAW_COULOMB')
        if (present(laws)) then
            do i = 1, size(laws)
                if (laws(i) < 0 .or. laws(i) > ubound(law_numbers, 1) .or. laws(i) == SIGNORINI_LAW_BY_PAIR) cycle
                if (law_numbers(laws(i)) > given_numbers) call refuse(wrong, 5, 'numbers has ' // text(given_numbers) // &
                    ' rows: the law ' // text(laws(i)) // ' of zone ' // text(i) // ' has ' // &
                    text(law_numbers(laws(i))) // ' parameters')
                if (law_numbers(laws(i)) > 0 .or. i > given_columns) cycle
                if (any(abs(numbers(:, i)) > 0)) call refuse(wrong, 5, 'numbers(:, ' // text(i) // ') is not zero, and the ' // &
                    'law ' // text(laws(i)) // ' of zone ' // text(i) // ' has no parameters: give the law of these numbers')
            end do
        end if
        if (refused(wrong, info, message)) return
        allocate (given(size(zones)), letters(len(names) + 1, size(zones)), friction(3, size(zones)))
        letters = c_null_char
        friction = 0
        if (present(numbers)) friction(:min(3, size(numbers, 1)), :) = numbers(:min(3, size(numbers, 1)), :)
        do i = 1, size(zones)
            do k = 1, len_trim(names(i))
                letters(k, i) = names(i)(k:k)
            end do
            if (present(laws)) given(i)%law = number(laws(i))
            given(i)%contact = zones(i)%handle
            given(i)%name = c_loc(letters(1, i))
            if (given(i)%law < 0 .or. given(i)%law > ubound(law_numbers, 1)) cycle
            if (law_numbers(given(i)%law) > 0) given(i)%friction = c_loc(friction(1, i))
        end do
        call finish(signorini_surface_join(size(zones, kind=c_int64_t), c_loc(given), self%handle), info, message, &
            [1, 1, 1])
        if (info /= 0) return
        call keep_arrays(self, [zones(1)%dim, zones(1)%nodes], zones(1)%dofs)
        self%dofs_of_faces = maxval(zones%dofs_of_faces)
    end subroutine

    ! A table of what each zone carries, for a log; empty if that cannot be told.
    function surfaces_table(self, d, force, state) result(text)
        class(contact_surfaces), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: d(:), force(:)
        integer, intent(in) :: state(:)
        character(len=:), allocatable :: text
        character(kind=c_char), allocatable, target :: letters(:)
        integer(c_int32_t), allocatable, target :: states(:)
        integer :: i
        text = ''
        allocate (states(max(1, self%pairs)), letters(512 * (2 + int(self%data%n_zones))))
        if (.not. c_associated(self%handle) .or. size(state) /= self%pairs) return
        if (min(size(d), size(force)) < self%dim * self%pairs) return
        states(:self%pairs) = int(state, c_int32_t)
        if (signorini_surface_table(self%handle, address(d), address(force), c_loc(states), c_loc(letters), &
            size(letters, kind=c_int64_t)) /= 0) return
        do i = 1, size(letters)
            if (letters(i) == c_null_char) exit
            text = text // letters(i)
        end do
    end function

    ! One sentence on what was found.
    function surfaces_summary(self) result(text)
        class(contact_surfaces), intent(in) :: self
        character(len=:), allocatable :: text
        text = ''
        if (c_associated(self%data%summary)) text = text_of(self%data%summary)
    end function

    ! Fields at the nodes of the mesh: pressure(nodes), traction(dim, nodes), clearance(nodes),
    ! slip(dim, nodes), and node_state(nodes), which needs the state of each pair. Nodes that stand in
    ! no pair keep what the arrays hold. slip0: the reference slip of the step; gap: if it was not
    ! that of the surfaces.
    subroutine surfaces_fields(self, d, force, info, state, slip0, gap, pressure, traction, clearance, &
            slip, node_state, message)
        class(contact_surfaces), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: d(:), force(:)
        integer, intent(out) :: info
        integer, intent(in), optional :: state(:)
        real(c_double), intent(in), contiguous, target, optional :: slip0(:), gap(:)
        real(c_double), intent(inout), contiguous, target, optional :: pressure(:), traction(:, :), &
            clearance(:), slip(:, :)
        integer, intent(inout), optional :: node_state(:)
        character(len=*), intent(out), optional :: message
        type(signorini_contact_fields), target :: fields
        integer(c_int32_t), allocatable, target :: states(:), node_states(:)
        type(refusal) :: wrong
        call check_surfaces(wrong, self, CONTACT_WRONG_MODEL)
        call check_results(wrong, self, 1, d, force, 4, state, slip0, gap)
        if (present(pressure)) call check_size(wrong, 7, 'pressure', size(pressure), self%nodes, 'nodes')
        if (present(traction)) call check_shape(wrong, 8, 'traction', shape(traction), &
            [self%dim, self%nodes], '(dim, nodes)')
        if (present(clearance)) call check_size(wrong, 9, 'clearance', size(clearance), self%nodes, 'nodes')
        if (present(slip)) call check_shape(wrong, 10, 'slip', shape(slip), [self%dim, self%nodes], &
            '(dim, nodes)')
        if (present(node_state)) call check_size(wrong, 11, 'node_state', size(node_state), self%nodes, 'nodes')
        if (present(node_state) .and. .not. present(state)) &
            call refuse(wrong, 4, 'state is missing: node_state needs it')
        if (refused(wrong, info, message)) return
        fields%pressure = address(pressure)
        fields%traction = address2(traction)
        fields%clearance = address(clearance)
        fields%slip = address2(slip)
        allocate (states(max(1, self%pairs)), node_states(max(1, self%nodes)))
        states = 0
        if (present(state)) states(:self%pairs) = int(state, c_int32_t)
        if (present(node_state)) then
            node_states(:self%nodes) = int(node_state, c_int32_t)
            fields%state = c_loc(node_states)
        end if
        call finish(signorini_surface_fields(self%handle, address(gap), address(slip0), address(d), &
            address(force), c_loc(states), c_loc(fields)), info, message, &
            [CONTACT_WRONG_MODEL, 6, 5, 1, 2, 4, 7])
        if (info == 0 .and. present(node_state)) node_state = int(node_states(:self%nodes))
    end subroutine

    ! Resultant of the contact forces on the slave's body, about a point(dim), absent: the origin.
    subroutine surfaces_resultant(self, d, force, sums, info, slip0, point, message)
        class(contact_surfaces), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: d(:), force(:)
        type(signorini_resultant), intent(out), target :: sums
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: slip0(:), point(:)
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_surfaces(wrong, self, CONTACT_WRONG_MODEL)
        call check_results(wrong, self, 1, d, force, 4, slip0=slip0)
        if (present(point)) call check_size(wrong, 6, 'point', size(point), self%dim, 'dim')
        if (refused(wrong, info, message)) return
        call finish(signorini_surface_resultant(self%handle, address(slip0), address(d), &
            address(force), address(point), c_loc(sums)), info, message, &
            [CONTACT_WRONG_MODEL, 5, 1, 2, 6, 3])
    end subroutine

    ! What has passed through the other side without a pair, after displacements u of all degrees of freedom.
    subroutine surfaces_penetration(self, u, found, info, message)
        class(contact_surfaces), intent(in) :: self
        real(c_double), intent(in), contiguous, target :: u(:)
        type(signorini_penetration), intent(out), target :: found
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_surfaces(wrong, self, CONTACT_WRONG_MODEL)
        if (size(u) < self%dofs_of_faces) call refuse(wrong, 1, 'u has ' // entries(size(u)) // &
            ', it must have those of all degrees of freedom')
        if (refused(wrong, info, message)) return
        call finish(signorini_surface_penetration(self%handle, address(u), c_loc(found)), info, message, &
            [CONTACT_WRONG_MODEL, 1, 2])
    end subroutine

    ! Moves slave nodes so that the two points of each pair meet that are no further apart than within; coordinates are
    ! those that were paired. Assemble with the moved nodes, and pair again.
    subroutine surfaces_adjust(self, within, coordinates, info, message)
        class(contact_surfaces), intent(in) :: self
        real(c_double), intent(in) :: within
        real(c_double), intent(inout), contiguous, target :: coordinates(:, :)
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        type(refusal) :: wrong
        call check_surfaces(wrong, self, CONTACT_WRONG_MODEL)
        call check_shape(wrong, 2, 'coordinates', shape(coordinates), [self%dim, self%nodes], '(dim, nodes)')
        if (refused(wrong, info, message)) return
        call finish(signorini_surface_adjust(self%handle, within, c_loc(coordinates)), info, message, &
            [CONTACT_WRONG_MODEL, 1, 2])
    end subroutine

    ! Writes a mesh of cells of one of VTK's types, cells(k, number), with displacements u and fields
    ! to a file .vtu, which ParaView opens. Cells of several types, several zones: signorini_mesh_write.
    subroutine surfaces_write(self, path, coordinates, cells, cell_type, d, force, info, u, state, &
            slip0, gap, message)
        class(contact_surfaces), intent(in) :: self
        character(len=*), intent(in) :: path
        real(c_double), intent(in), contiguous, target :: coordinates(:, :)
        integer, intent(in) :: cells(:, :), cell_type
        real(c_double), intent(in), contiguous, target :: d(:), force(:)
        integer, intent(out) :: info
        real(c_double), intent(in), contiguous, target, optional :: u(:), slip0(:), gap(:)
        integer, intent(in), optional :: state(:)
        character(len=*), intent(out), optional :: message
        type(signorini_mesh), target :: mesh
        type(signorini_zone), target :: zone
        character(kind=c_char), allocatable, target :: name(:)
        integer(c_int64_t), allocatable, target :: nodes(:), starts(:)
        integer(c_int32_t), allocatable, target :: states(:)
        type(refusal) :: wrong
        integer :: i
        call check_surfaces(wrong, self, CONTACT_WRONG_MODEL)
        call check_shape(wrong, 2, 'coordinates', shape(coordinates), [self%dim, self%nodes], '(dim, nodes)')
        call check_results(wrong, self, 5, d, force, 9, state, slip0, gap)
        if (present(u)) then
            if (size(u) < self%dofs) call refuse(wrong, 8, 'u has ' // entries(size(u)) // &
                ', it must have those of all degrees of freedom')
        end if
        if (refused(wrong, info, message)) return
        allocate (name(len_trim(path) + 1))
        do i = 1, len_trim(path)
            name(i) = path(i:i)
        end do
        name(size(name)) = c_null_char
        mesh%dim = number(self%dim)
        mesh%nodes = self%nodes
        mesh%coordinates = address2(coordinates)
        mesh%cells = size(cells, 2)
        mesh%index_base = 1
        mesh%cell_type = number(cell_type)
        nodes = [int([cells], c_int64_t), 0_c_int64_t]
        starts = [(1_c_int64_t + size(cells, 1) * int(i, c_int64_t), i=0, size(cells, 2))]
        mesh%cell_start = c_loc(starts)
        mesh%cell_nodes = c_loc(nodes)
        zone%contact = self%handle
        zone%gap = address(gap)
        zone%slip0 = address(slip0)
        zone%d = address(d)
        zone%force = address(force)
        allocate (states(max(1, self%pairs)))
        if (present(state)) then
            states(:self%pairs) = int(state, c_int32_t)
            zone%state = c_loc(states)
        end if
        call finish(signorini_mesh_write(c_loc(name), c_loc(mesh), address(u), 1_c_int64_t, c_loc(zone), &
            0_c_int64_t, c_null_ptr), info, message, [1, 3, 8, 5, 5])
    end subroutine

    subroutine surfaces_release(self)
        class(contact_surfaces), intent(inout) :: self
        call signorini_surface_free(self%handle)
        self%handle = c_null_ptr
        self%dim = 0
        self%pairs = 0
        self%nodes = 0
        self%data = signorini_surface_data()
        if (allocated(self%zone_start)) deallocate (self%zone_start, self%friction)
        if (allocated(self%gap)) deallocate (self%node, self%gap, self%area, self%normal, &
            self%tangent, self%point)
    end subroutine

    ! Copies what the library tells of new pairs.
    subroutine keep_pairs(self, nodes, told, masters)
        class(contact_surfaces), intent(inout) :: self
        integer, intent(in) :: nodes(2)
        type(preparation), intent(in) :: told
        integer(c_int64_t), intent(in), optional :: masters(:)
        integer(c_int64_t), allocatable :: faces(:)
        integer :: dofs, each, i
        dofs = max(nodes(1), int(told%settings%dofs_per_node)) * (nodes(2) - 1) + nodes(1)
        if (allocated(told%dofs)) dofs = int(maxval(told%dofs))
        call keep_arrays(self, nodes, dofs)
        ! The largest number of a node of the faces; the lists end with zeros.
        faces = told%slave%nodes
        if (present(masters)) faces = [faces, masters]
        faces = pack(faces, faces > 0)
        each = max(nodes(1), int(told%settings%dofs_per_node))
        self%dofs_of_faces = 0
        do i = 1, size(faces)
            dofs = each * (int(faces(i)) - 1) + nodes(1)
            if (allocated(told%dofs)) dofs = int(maxval(told%dofs(nodes(1) * (faces(i) - 1) + 1:nodes(1) * faces(i))))
            self%dofs_of_faces = max(self%dofs_of_faces, dofs)
        end do
    end subroutine

    subroutine keep_arrays(self, nodes, dofs)
        class(contact_surfaces), intent(inout) :: self
        integer, intent(in) :: nodes(2), dofs
        integer(c_int64_t), pointer :: numbers(:)
        integer(c_int32_t) :: status
        integer :: n
        status = signorini_surface_view(self%handle, self%data)
        self%dim = nodes(1)
        self%nodes = nodes(2)
        self%pairs = int(self%data%pairs)
        self%dofs = dofs
        if (self%data%n_zones > 0) then
            call c_f_pointer(self%data%zone_start, numbers, [self%data%n_zones + 1])
            self%zone_start = int(numbers)
            self%friction = reals_of(self%data%friction, 4 * self%pairs)
        end if
        allocate (self%node(self%pairs))
        if (self%pairs > 0) then
            call c_f_pointer(self%data%nodes, numbers, [self%pairs])
            self%node = int(numbers)
        end if
        n = self%dim * self%pairs
        self%gap = reals_of(self%data%gaps, self%pairs)
        self%area = reals_of(self%data%areas, self%pairs)
        self%normal = reshape(reals_of(self%data%normals, n), [self%dim, self%pairs])
        self%tangent = reshape(reals_of(self%data%tangents, n), [self%dim, self%pairs])
        self%point = reshape(reals_of(self%data%points, n), [self%dim, self%pairs])
    end subroutine

    ! A copy of an array of the library.
    function reals_of(pointer, count) result(copy)
        type(c_ptr), intent(in) :: pointer
        integer, intent(in) :: count
        real(c_double) :: copy(count)
        real(c_double), pointer :: found(:)
        if (count == 0) return
        call c_f_pointer(pointer, found, [count])
        copy = found
    end function

    ! The slave and the settings of a pairing; search_distance at the position `first`, the others behind it.
    subroutine prepare(wrong, first, told, nodes, slave, search_distance, dofs, dofs_per_node, &
            symmetry_axes, symmetry_at, normals, rims, settings)
        type(refusal), intent(inout) :: wrong
        type(signorini_surface_settings), intent(in), optional :: settings
        integer, intent(in) :: first, nodes(2), slave(:, :)
        type(preparation), intent(inout), target :: told
        real(c_double), intent(in), optional :: search_distance, symmetry_at(:)
        integer, intent(in), optional :: dofs(:, :), dofs_per_node, symmetry_axes(:), normals, rims
        integer :: axes, places
        call check_dim(wrong, 1, nodes(1))
        call list_faces(slave, told%slave)
        if (present(settings)) told%settings = settings
        told%settings%index_base = 1
        if (present(search_distance)) then
            told%settings%search_distance = search_distance
            if (.not. search_distance > 0) call refuse(wrong, first, 'search_distance must be positive')
        end if
        if (present(dofs_per_node)) then
            told%settings%dofs_per_node = number(dofs_per_node)
            if (dofs_per_node < nodes(1)) call refuse(wrong, first + 2, 'dofs_per_node is ' // &
                text(dofs_per_node) // ', it must be at least dim')
        end if
        if (present(dofs)) then
            call check_shape(wrong, first + 1, 'dofs', shape(dofs), nodes, '(dim, nodes), as coordinates')
            if (any(dofs < 1)) call refuse(wrong, first + 1, 'dofs must count from 1')
            told%dofs = int([dofs], c_int64_t)
            if (size(told%dofs) > 0) told%settings%node_dofs = c_loc(told%dofs)
        end if
        axes = 0
        places = 0
        if (present(symmetry_axes)) axes = size(symmetry_axes)
        if (present(symmetry_at)) places = size(symmetry_at)
        if (axes /= places) call refuse(wrong, first + 4, 'symmetry_axes has ' // text(axes) // &
            ' entries and symmetry_at ' // text(places) // ': give both for each plane')
        if (axes > 0 .and. axes == places) then
            told%axes = int([symmetry_axes], c_int32_t)
            told%at = [symmetry_at]
            told%settings%symmetry_planes = axes
            told%settings%symmetry_axes = c_loc(told%axes)
            told%settings%symmetry_normals = c_null_ptr
            told%settings%symmetry_at = c_loc(told%at)
        end if
        if (present(normals)) then
            told%settings%normals = number(normals)
            if (normals < SIGNORINI_NORMALS_AVERAGED .or. normals > SIGNORINI_NORMALS_FACES) &
                call refuse(wrong, first + 5, 'there is no choice of normals ' // text(normals))
        end if
        if (present(rims)) then
            told%settings%rims = number(rims)
            if (rims < SIGNORINI_RIMS_FOLD .or. rims > SIGNORINI_RIMS_FOLD_LITTLE) &
                call refuse(wrong, first + 6, 'there is no choice of rims ' // text(rims))
        end if
    end subroutine

    ! Faces, of which those with fewer nodes end with zeros.
    subroutine list_faces(given, list)
        integer, intent(in) :: given(:, :)
        type(face_lists), intent(inout), target :: list
        integer :: face, count_of
        allocate (list%starts(size(given, 2) + 1), list%nodes(size(given) + 1))
        list%nodes = 0
        list%starts(1) = 1
        do face = 1, size(given, 2)
            count_of = size(given, 1)
            do while (count_of > 0)
                if (given(count_of, face) /= 0) exit
                count_of = count_of - 1
            end do
            list%nodes(list%starts(face):list%starts(face) + count_of - 1) = &
                int(given(:count_of, face), c_int64_t)
            list%starts(face + 1) = list%starts(face) + count_of
        end do
        list%faces%count = size(given, 2)
        list%faces%start = c_loc(list%starts)
        list%faces%nodes = c_loc(list%nodes)
    end subroutine

    subroutine check_surfaces(wrong, surfaces, position)
        type(refusal), intent(inout) :: wrong
        class(contact_surfaces), intent(in) :: surfaces
        integer, intent(in) :: position
        if (.not. c_associated(surfaces%handle)) call refuse(wrong, position, &
            'there are no pairs: pair or pair_obstacle makes them')
    end subroutine

    ! d and force from the position `first` on; state, slip0 and gap from the position `second` on.
    subroutine check_results(wrong, self, first, d, force, second, state, slip0, gap)
        type(refusal), intent(inout) :: wrong
        class(contact_surfaces), intent(in) :: self
        integer, intent(in) :: first, second
        real(c_double), intent(in) :: d(:), force(:)
        integer, intent(in), optional :: state(:)
        real(c_double), intent(in), optional :: slip0(:), gap(:)
        integer :: n
        n = self%dim * self%pairs
        call check_size(wrong, first, 'd', size(d), n, 'dim * pairs')
        call check_size(wrong, first + 1, 'force', size(force), n, 'dim * pairs')
        if (present(state)) call check_size(wrong, second, 'state', size(state), self%pairs, 'one for each pair')
        if (present(slip0)) call check_size(wrong, second + 1, 'slip0', size(slip0), n - self%pairs, &
            'dim - 1 for each pair')
        if (present(gap)) call check_size(wrong, second + 2, 'gap', size(gap), self%pairs, 'one for each pair')
    end subroutine

    ! Notes what is wrong, if nothing has been wrong before.
    subroutine refuse(wrong, position, sentence)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position
        character(len=*), intent(in) :: sentence
        if (wrong%position /= 0) return
        wrong%position = position
        wrong%sentence = sentence
    end subroutine

    ! Hands over what is wrong, if anything is.
    function refused(wrong, info, message)
        type(refusal), intent(in) :: wrong
        integer, intent(inout) :: info
        character(len=*), intent(inout), optional :: message
        logical :: refused
        refused = wrong%position /= 0
        if (.not. refused) return
        info = -abs(wrong%position)
        if (present(message)) message = wrong%sentence
    end function

    subroutine check_size(wrong, position, name, found, wanted, meaning)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, found, wanted
        character(len=*), intent(in) :: name, meaning
        if (found /= wanted) call refuse(wrong, position, name // ' has ' // entries(found) // &
            ', it must have ' // text(wanted) // ': ' // meaning)
    end subroutine

    subroutine check_finite(wrong, position, name, values)
        use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position
        character(len=*), intent(in) :: name
        real(c_double), intent(in) :: values(:)
        integer :: k
        do k = 1, size(values)
            if (ieee_is_finite(values(k))) cycle
            call refuse(wrong, position, name // '(' // text(k) // ') is not finite')
            return
        end do
    end subroutine

    subroutine check_shape(wrong, position, name, found, wanted, meaning)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, found(:), wanted(:)
        character(len=*), intent(in) :: name, meaning
        if (any(found /= wanted)) call refuse(wrong, position, name // ' has the shape ' // &
            tuple(found) // ', it must be ' // tuple(wanted) // ': ' // meaning)
    end subroutine

    ! The structure of a sparse matrix whose arrays were checked.
    function sparse_matrix(col_start, row, values, triangle) result(matrix)
        integer, intent(in), contiguous, target :: col_start(:), row(:)
        real(c_double), intent(in), contiguous, target :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        type(signorini_sparse) :: matrix
        matrix%index_bytes = storage_size(col_start) / 8
        matrix%index_base = 1
        matrix%triangle = triangle
        matrix%size = size(col_start) - 1
        matrix%nnz = size(values)
        matrix%col_start = c_loc(col_start)
        if (size(row) > 0) matrix%row = c_loc(row)
        matrix%values = address(values)
    end function

    ! A sparse matrix: col_start at the position `first`, then row, values, triangle.
    subroutine check_sparse(wrong, first, col_start, row, values, triangle)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: first, col_start(:), row(:)
        real(c_double), intent(in) :: values(:)
        integer(c_int32_t), intent(in) :: triangle
        call check_size(wrong, first + 1, 'row', size(row), size(values), 'as many as values')
        call check_starts(wrong, first, 'col_start', col_start, size(values), 'values has entries')
        if (triangle < SIGNORINI_TRIANGLE_LOWER .or. triangle > SIGNORINI_TRIANGLE_FULL) call refuse(wrong, &
            first + 3, 'triangle is ' // text(int(triangle)) // ', it must be SIGNORINI_TRIANGLE_LOWER, _UPPER or _FULL')
    end subroutine

    ! An array of vectors, one for each pair.
    subroutine check_pairs(wrong, position, name, found, wanted)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, found(2), wanted(2)
        character(len=*), intent(in) :: name
        call check_shape(wrong, position, name, found, wanted, '(dim, pairs), as slaves')
    end subroutine

    subroutine check_dim(wrong, position, dim)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, dim
        if (dim /= 2 .and. dim /= 3) &
            call refuse(wrong, position, 'dim is ' // text(dim) // ', it must be 2 or 3')
    end subroutine

    ! A matrix with a row and a column for each component of each pair.
    subroutine check_square(wrong, position, name, found, dim)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, found(2), dim
        character(len=*), intent(in) :: name
        if (found(1) /= found(2)) call refuse(wrong, position, name // ' has the shape ' // tuple(found) &
            // ', it must be square')
        if (wrong%position /= 0) return
        if (mod(found(1), dim) /= 0) call refuse(wrong, position, name // ' has the shape ' // &
            tuple(found) // ', its rows must be a multiple of dim (' // text(dim) // '): dim for each pair')
    end subroutine

    ! The data of a condensed problem: k at position 1, n loads at 2, pairs at 3.
    subroutine check_data(wrong, found, n, pairs, matrix, vector)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: found(2), n, pairs
        character(len=*), intent(in) :: matrix, vector
        call check_components(wrong, 2, n, pairs, vector)
        call check_shape(wrong, 1, matrix, found, [n, n], &
            'a row and a column for each entry of ' // vector)
    end subroutine

    ! A vector of n entries for all components of pairs.
    subroutine check_components(wrong, position, n, pairs, vector)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, n, pairs
        character(len=*), intent(in) :: vector
        if (n /= 2 * pairs .and. n /= 3 * pairs) call refuse(wrong, position, vector // ' has ' // &
            entries(n) // ' and gap ' // text(pairs) // ': ' // vector // &
            ' must have 2 (2D) or 3 (3D) for each of gap')
    end subroutine

    subroutine check_model(wrong, self)
        type(refusal), intent(inout) :: wrong
        class(contact_model), intent(in) :: self
        if (.not. c_associated(self%handle)) call refuse(wrong, CONTACT_WRONG_MODEL, &
            'there is no model: new_condensed, new_two_body, new_flexibility, ' // &
            'new_flexibility_sparse, new_sparse, new_sparse_rows, new_surfaces or new_operator makes one')
    end subroutine

    ! The load of a model at position 1 and its prescribed values.
    subroutine check_case(wrong, self, loads, position, prescribed)
        type(refusal), intent(inout) :: wrong
        class(contact_model), intent(in) :: self
        integer, intent(in) :: loads, position
        real(c_double), intent(in), optional :: prescribed(:)
        call check_size(wrong, 1, 'f', loads, self%host_size(), 'the degrees of freedom of the host')
        if (present(prescribed)) call check_size(wrong, position, 'prescribed', size(prescribed), &
            self%fixed, 'one for each of fixed')
    end subroutine

    ! Where columns or the masters of pairs start: from 1 to behind the last of count.
    subroutine check_starts(wrong, position, name, starts, count, last)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, starts(:), count
        character(len=*), intent(in) :: name, last
        integer :: n
        n = size(starts)
        if (n == 0) call refuse(wrong, position, name // ' is empty, it must have at least the entry 1')
        if (wrong%position /= 0) return
        if (starts(1) /= 1) call refuse(wrong, position, name // '(1) is ' // text(starts(1)) // &
            ', it must be 1: indices count from 1')
        if (starts(n) /= count + 1) call refuse(wrong, position, name // '(' // text(n) // ') is ' // &
            text(starts(n)) // ', it must be ' // text(count + 1) // ': one more than ' // last)
    end subroutine

    subroutine check_equations(wrong, position, equations)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position
        type(contact_equations), intent(in) :: equations
        logical :: complete
        complete = allocated(equations%dependent) .and. allocated(equations%start) .and. &
            allocated(equations%dofs) .and. allocated(equations%coefficients)
        if (.not. complete) call refuse(wrong, position, 'equations: an array is not allocated')
        if (wrong%position /= 0) return
        call check_size(wrong, position, 'equations%start', size(equations%start), &
            size(equations%dependent) + 1, 'one more than dependent')
        call check_size(wrong, position, 'equations%coefficients', size(equations%coefficients), &
            size(equations%dofs), 'as many as dofs')
        call check_starts(wrong, position, 'equations%start', equations%start, size(equations%dofs), &
            'dofs has entries')
    end subroutine

    ! master_start, masters and weights from a position on: all or none.
    subroutine check_masters(wrong, first, pairs, master_start, masters, weights)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: first, pairs(2)
        integer, intent(in), optional :: master_start(:), masters(:, :)
        real(c_double), intent(in), optional :: weights(:)
        character(len=*), parameter :: together = ' is missing: master_start, masters and weights belong together'
        if (.not. (present(master_start) .or. present(masters) .or. present(weights))) return
        if (.not. present(master_start)) call refuse(wrong, first, 'master_start' // together)
        if (.not. present(masters)) call refuse(wrong, first + 1, 'masters' // together)
        if (.not. present(weights)) call refuse(wrong, first + 2, 'weights' // together)
        if (wrong%position /= 0) return
        call check_size(wrong, first, 'master_start', size(master_start), pairs(2) + 1, 'one more than pairs')
        call check_shape(wrong, first + 1, 'masters', shape(masters), [pairs(1), size(weights)], &
            '(dim, entries of weights)')
        call check_starts(wrong, first, 'master_start', master_start, size(weights), 'weights has entries')
    end subroutine

    ! motion, second_d, second_force and second_state from a position on.
    subroutine check_second(wrong, first, n, pairs, motion, second_d, second_force, second_state)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: first, n, pairs
        real(c_double), intent(in), optional :: motion(:), second_d(:), second_force(:)
        integer, intent(in), optional :: second_state(:)
        character(len=*), parameter :: as_d = 'as many as d'
        if (present(motion)) call check_size(wrong, first, 'motion', size(motion), n, as_d)
        if (present(second_d)) call check_size(wrong, first + 1, 'second_d', size(second_d), n, as_d)
        if (present(second_force)) &
            call check_size(wrong, first + 2, 'second_force', size(second_force), n, as_d)
        if (present(second_state)) &
            call check_size(wrong, first + 3, 'second_state', size(second_state), pairs, 'one for each pair')
    end subroutine

    ! The law at a position and its parameters at the next one.
    subroutine choose_law(wrong, position, pairs, chosen, law, friction)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: position, pairs
        integer(c_int32_t), intent(out) :: chosen
        integer, intent(in), optional :: law
        real(c_double), intent(in), optional :: friction(:)
        integer :: numbers
        character(len=:), allocatable :: asked
        chosen = SIGNORINI_LAW_FRICTIONLESS
        if (present(friction)) chosen = SIGNORINI_LAW_COULOMB
        if (present(law)) chosen = number(law)
        if (chosen < lbound(law_numbers, 1) .or. chosen > ubound(law_numbers, 1)) return
        numbers = law_numbers(chosen)
        if (numbers == 0) return
        asked = text(numbers) // ' for each pair'
        if (numbers == 1) asked = 'one for each pair'
        if (.not. present(friction)) call refuse(wrong, position + 1, 'friction is missing: the law ' &
            // text(int(chosen)) // ' has parameters, ' // asked)
        if (present(friction)) call check_size(wrong, position + 1, 'friction', size(friction), &
            numbers * pairs, asked)
    end subroutine

    ! The settings of a call: the defaults, or `settings`, with what the arguments from the position
    ! `first` (method, tolerance, max_iterations) say. Those two that are wrong by themselves are
    ! found by an LCP without unknowns, in which only settings can be wrong.
    subroutine choose_settings(wrong, first, chosen, method, tolerance, max_iterations, settings)
        type(refusal), intent(inout) :: wrong
        integer, intent(in) :: first
        type(signorini_settings), intent(out) :: chosen
        integer, intent(in), optional :: method, max_iterations
        real(c_double), intent(in), optional :: tolerance
        type(signorini_settings), intent(in), optional :: settings
        type(signorini_settings) :: one
        if (present(tolerance)) one%tolerance = tolerance
        if (present(tolerance)) call try(first + 1)
        one = signorini_settings()
        if (present(max_iterations)) one%max_iterations = max_iterations
        if (present(max_iterations)) call try(first + 2)
        if (present(settings)) chosen = settings
        if (present(method)) chosen%method = number(method)
        if (present(tolerance)) chosen%tolerance = tolerance
        if (present(max_iterations)) chosen%max_iterations = max_iterations
    contains
        subroutine try(position)
            integer, intent(in) :: position
            type(signorini_settings), target :: tried
            real(c_double) :: m(1), q(1), w(1), z(1)
            integer(c_int32_t) :: status
            tried = one
            m = 0
            q = 0
            status = signorini_lcp_solve(0_c_int64_t, m, 1_c_int64_t, q, c_null_ptr, c_loc(tried), w, z, &
                c_null_ptr, c_null_ptr)
            if (status < 0) call refuse(wrong, position, signorini_message())
        end subroutine
    end subroutine

    ! The position of the argument that chooses the method, if the library refuses the settings.
    pure function place_of_settings(first, method, settings) result(position)
        integer, intent(in) :: first
        integer, intent(in), optional :: method
        type(signorini_settings), intent(in), optional :: settings
        integer :: position
        position = first + 3
        if (present(method) .and. .not. present(settings)) position = first
    end function

    ! The status of a call of C: positions(k) is the position here of its argument k.
    subroutine finish(status, info, message, positions)
        integer(c_int32_t), intent(in) :: status
        integer, intent(out) :: info
        character(len=*), intent(out), optional :: message
        integer, intent(in) :: positions(:)
        info = int(status)
        if (info < 0 .and. -info <= size(positions)) info = -abs(positions(-info))
        if (present(message)) message = signorini_message()
    end subroutine

    subroutine copy_states(states, state)
        integer(c_int32_t), intent(in) :: states(:)
        integer, intent(out), optional :: state(:)
        if (present(state)) state = int(states)
    end subroutine

    function address_of_extra(second_states, motion, second_d, second_force, escape) result(extra)
        integer(c_int32_t), intent(in), target :: second_states(:)
        real(c_double), intent(in), contiguous, target, optional :: motion(:), second_d(:), second_force(:)
        real(c_double), intent(in), contiguous, target, optional :: escape(:)
        type(signorini_extra) :: extra
        extra%motion = address(motion)
        extra%second_d = address(second_d)
        extra%second_force = address(second_force)
        extra%escape = address(escape)
        if (size(second_states) > 0) extra%second_state = c_loc(second_states)
    end function

    ! Absent: the defaults.
    function address_of_settings(settings) result(pointer)
        type(signorini_settings), intent(in), target, optional :: settings
        type(c_ptr) :: pointer
        pointer = c_null_ptr
        if (present(settings)) pointer = c_loc(settings)
    end function

    ! Address of an array that may be absent, or empty.
    function address(array) result(pointer)
        real(c_double), intent(in), contiguous, target, optional :: array(:)
        type(c_ptr) :: pointer
        pointer = c_null_ptr
        if (present(array)) then
            if (size(array) > 0) pointer = c_loc(array)
        end if
    end function

    ! Address of an array of vectors.
    function address2(array) result(pointer)
        real(c_double), intent(in), contiguous, target, optional :: array(:, :)
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

    pure function text(value) result(digits)
        integer, intent(in) :: value
        character(len=:), allocatable :: digits
        character(len=24) :: buffer
        write (buffer, '(i0)') value
        digits = trim(buffer)
    end function

    pure function entries(count) result(words)
        integer, intent(in) :: count
        character(len=:), allocatable :: words
        words = text(count) // ' entries'
        if (count == 1) words = '1 entry'
    end function

    pure function tuple(sizes) result(words)
        integer, intent(in) :: sizes(:)
        character(len=:), allocatable :: words
        integer :: i
        words = '(' // text(sizes(1))
        do i = 2, size(sizes)
            words = words // ', ' // text(sizes(i))
        end do
        words = words // ')'
    end function

    function text_of(pointer) result(text)
        type(c_ptr), intent(in) :: pointer
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: length, i
        call c_f_pointer(pointer, letters, [huge(0_c_int32_t)])
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
