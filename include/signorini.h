/*
 * signorini: unilateral contact with friction for existing finite-element codes.
 *
 * Sections:
 *
 *     1  One call            a matrix that you have condensed
 *     2  Your own matrix     a whole sparse matrix with contact pairs, two bodies, a flexibility
 *     3  Many load cases     solve, recover, certify
 *     4  Fine tuning         settings, report, second solutions, LCPs, versions
 *     5  What may change     behind SIGNORINI_UNSTABLE: proofs, products in the place of a matrix
 *
 * signorini_surface.h makes the contact pairs from the faces of two meshes and writes files for
 * ParaView; signorini_file.h writes and reads problems, for bug reports.
 *
 * The problem. P pairs in dimension D (2 or 3) have N = D P unknowns: a relative displacement d and
 * a contact force F with one normal and D - 1 tangential components each, ordered pair by pair as
 * (n, t) or (n, t1, t2).
 *
 *     K d = f + F                                        equilibrium
 *     d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0        unilateral contact
 *     |F_t| <= mu |F_n|  and
 *         stick:  d_t = slip0, the reference slip        Coulomb friction
 *         slip:   d_t - slip0 = -lambda F_t, lambda >= 0, |F_t| = mu |F_n|
 *
 * K is the stiffness matrix condensed on the contact components: symmetric, positive definite, or
 * semi-definite where contact alone supports a body.
 *
 * Signs and units. n is the outward normal of the body: d_n > 0 moves towards the obstacle, F_n < 0
 * presses. F, the force of the contact on the body, and f are nodal forces, not stresses. Any
 * consistent set of units serves. Example: above a plane, with n = (0, -1) and t = (1, 0),
 * d_n = -u_y and d_t = u_x. Transform f likewise; the entries K_nt change their sign.
 *
 * Arguments stand in one order: model or file; sizes; the problem; settings or tolerance; results.
 * Matrices are column-major, each followed by its leading dimension. An argument may be NULL where
 * its description says so, and where the array has no entries. An array that a call writes must not
 * overlap another array of the call. No array of yours is used after the call.
 *
 * Status. What a call returns, unless its description says more; signorini_last_error() tells why:
 *
 *     0          solved and certified on your data: report.eta <= settings.tolerance
 *     > 0        the results are no solution: SIGNORINI_STATUS_... tells what they are
 *     -k         the k-th argument is wrong; nothing was written
 *     <= -1000   out of memory, a file that cannot be read or written, a caught defect
 *
 * Structures begin with struct_size, which you set to sizeof: ..._default does, and so does
 * signorini_model_data data = {sizeof data}. No byte beyond it is read or written. Programs and
 * libraries of different versions work together: fields that one does not know are zero or keep
 * their defaults. A field that asks for what the library does not have is refused.
 *
 * Threads. Several threads may call at once, with the same model, problem or settings too, as long
 * as none frees or changes them (but see SIGNORINI_START_PREVIOUS). A thread that is cancelled
 * (pthread_cancel, deferred) ends after its call. The library starts threads only where
 * settings.threads asks for them. Calls need 64 KiB of stack.
 *
 * The library never prints, exits, reads the environment, handles signals or opens files that you
 * do not name. Inside a call floating-point traps and flush-to-zero are off; on return they are
 * as before. The same input gives the same bits on the same machine.
 *
 * Memory. A call to which the system refuses memory ends with SIGNORINI_STATUS_OUT_OF_MEMORY and
 * holds nothing; the next call works. For that a call first obtains as much address space as it may
 * need (signorini_solve_memory). Where limited (ulimit -v), a call needs twice its memory, a
 * thread's first call 72 MiB more. One refused request of the C library ends the process: 40 bytes
 * at each thread's first product of matrices.
 */

#ifndef SIGNORINI_H
#define SIGNORINI_H

#include <stdint.h>
#if UINTPTR_MAX <= 0xffffffffu
#error "signorini needs 64 bits"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ============================================================================================
 * 1  One call
 * ========================================================================================== */

typedef struct signorini_settings signorini_settings;
typedef struct signorini_report signorini_report;
typedef struct signorini_extra signorini_extra;

/* Friction law: how large |F_t| may be. friction holds its parameters for each pair. */
#define SIGNORINI_LAW_FRICTIONLESS 0 /**< No friction: F_t = 0. */
#define SIGNORINI_LAW_COULOMB 1      /**< Coulomb: |F_t| <= mu |F_n|. friction: mu >= 0. */
#define SIGNORINI_LAW_TRESCA 2 /**< Tresca: |F_t| <= g, open or closed. friction: g >= 0; force. */
/**
 * Coulomb with cohesion and a tension cut-off: F_n <= a, (d_n - gap) (F_n - a) = 0,
 * |F_t| <= b - mu F_n. friction: (mu, b, a), mu >= 0, the tension a >= 0 at which the pair opens,
 * the cohesion b >= mu a; forces. No memory: an open pair, even with gap +inf, carries
 * a, and friction up to b - mu a; a pair breaks if its b and a are 0 in later load steps.
 */
#define SIGNORINI_LAW_COHESIVE 3
/**
 * Orthotropic, 3D only: (F_1 / mu1)^2 + (F_2 / mu2)^2 <= F_n^2. friction: (mu1, mu2, angle),
 * coefficients > 0, at most 1e6 times apart, and the angle of axis 1 from t1 towards t2, radians.
 * The pair slips along the normal of this ellipse at -F_t (associated rule).
 */
#define SIGNORINI_LAW_ORTHOTROPIC 4
/** As SIGNORINI_LAW_ORTHOTROPIC, but the pair slips opposite to F_t (collinear rule). */
#define SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR 5
/** A law for each pair. friction: (law, p1, p2, p3), its law and parameters, unused ones 0. */
#define SIGNORINI_LAW_BY_PAIR 6
#define SIGNORINI_LAW_TIED 7 /**< Tied: d_n = gap, d_t = slip0, whatever F; gap +inf: free. */

/* State of a pair. */
/**
 * The pair is apart: F_n = 0, with cohesion F_n = a; F_t = 0 except under Tresca's law and
 * cohesion. A pair with pressure and friction below 1e-11 of the largest load or force is open too.
 */
#define SIGNORINI_STATE_OPEN 0
/** The pair touches and slips: |F_t| is at its bound. Frictionless: every pair that touches. */
#define SIGNORINI_STATE_SLIP 1
#define SIGNORINI_STATE_STICK 2 /**< The pair sticks: d_t = slip0. */

/**
 * Solves a contact problem that you have condensed on the N = dim * pairs contact components.
 *
 * @param dim       space dimension, 2 or 3
 * @param pairs     number of contact pairs, 0 allowed
 * @param K         condensed stiffness, N columns of N entries, both triangles; force / length;
 *                  symmetric to 1e-9 of the diagonal, positive semi-definite, not zero:
 *                  signorini_solve checks a part of this, a model all. A row of zeros is a
 *                  component that nothing resists. A component that you hold fixed keeps its
 *                  row: zero off the diagonal, positive on it, zero load. If the body can move
 *                  freely and touches at two or three points, use a model
 * @param ldk       entries from one column of K to the next, at least max(1, N)
 * @param f         condensed nodal loads, N; force
 * @param gap       initial gap of each pair; length; negative: interference; +infinity: no contact
 * @param law       SIGNORINI_LAW_..., the friction law
 * @param friction  parameters of the law, pair by pair; NULL if it has none
 * @param slip0     reference slip, dim - 1 for each pair; length; NULL: zero. In load steps hand
 *                  over the d_t of the step before
 * @param settings  NULL: the defaults
 * @param d         out: relative displacements, N; in: the start if settings->warm_start
 * @param F         out: contact forces, N. They obey the contact law; K d = f + F holds up to
 *                  report->equilibrium
 * @param state     out: SIGNORINI_STATE_... of each pair; may be NULL
 * @param report    out: how good the result is; set its struct_size before; may be NULL
 * @param extra     arrays for further results; may be NULL
 */
int32_t signorini_solve(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                        const double *gap, int32_t law, const double *friction, const double *slip0,
                        const signorini_settings *settings, double *d, double *F, int32_t *state,
                        signorini_report *report, const signorini_extra *extra);

/**
 * Says in one sentence what was wrong in the last call on this thread, such as "K[12,7] is not
 * finite" (row, column; entries count from 0); after a solution its remarks, else nothing. A call
 * that releases leaves it. UTF-8, at most 511 bytes, never NULL. The text belongs to the thread,
 * until its next call.
 */
const char *signorini_last_error(void);

/* Status of a call. */
#define SIGNORINI_STATUS_SOLVED 0          /**< Solved and certified. */
#define SIGNORINI_STATUS_ITERATION_LIMIT 1 /**< max_iterations is used up: best iterate. */
#define SIGNORINI_STATUS_TIME_LIMIT 2      /**< time_limit is used up: best iterate. */
#define SIGNORINI_STATUS_CANCELLED 3       /**< The progress callback cancelled: best iterate. */
/**
 * Proved: no equilibrium exists (LCP: no w, z >= 0 satisfy w = q + M z). extra->motion (LCP: y) is
 * the proof. d, F and state hold the last iterate.
 */
#define SIGNORINI_STATUS_NO_EQUILIBRIUM 4
/** The method, or each that AUTO tries, cannot go on; nothing is proved: best iterate. */
#define SIGNORINI_STATUS_STALLED 5
#define SIGNORINI_STATUS_NOT_A_SOLUTION 6  /**< Certify: the displacements are no solution. */
/** Prove: no solution is proved to exist; there may be one. */
#define SIGNORINI_STATUS_NOT_PROVED 7
/** The call may need more than memory_limit: nothing was computed or written. */
#define SIGNORINI_STATUS_MEMORY_LIMIT 8
#define SIGNORINI_STATUS_INTERNAL -1000 /**< A caught defect of the library: results undefined. */
/** Out of memory: only earlier load cases were written. */
#define SIGNORINI_STATUS_OUT_OF_MEMORY -1001
#define SIGNORINI_STATUS_FILE -1002        /**< A file cannot be read or written. */

/** Static text for any status, such as "solved"; never NULL. */
const char *signorini_status_string(int32_t status);

/* ============================================================================================
 * 2  Your own matrix
 *
 * A model reduces your matrix to the contact pairs, once; section 3 solves load cases with it. H is
 * the number of entries of your load and displacement vectors. A constructor returns the status; if
 * it is not 0, the model is NULL.
 * ========================================================================================== */

/* Which entries are stored. */
#define SIGNORINI_TRIANGLE_LOWER 0 /**< Entries with row >= column. */
#define SIGNORINI_TRIANGLE_UPPER 1 /**< Entries with row <= column. */
#define SIGNORINI_TRIANGLE_FULL 2  /**< All entries. */

typedef struct signorini_sparse signorini_sparse;
typedef struct signorini_equations signorini_equations;
typedef struct signorini_pairs signorini_pairs;
typedef struct signorini_model_data signorini_model_data;

/**
 * A sparse symmetric matrix by columns (CSC), stiffness or flexibility. For a matrix by rows
 * (CSR) pass the rows as columns, and LOWER for UPPER.
 */
struct signorini_sparse {
    uint32_t struct_size; /**< sizeof(signorini_sparse). */
    int32_t index_bytes;  /**< Width of col_start, row and order: 4 for int32_t, 8 for int64_t. */
    /** Number of the first row, 0 or 1: all degrees of freedom of the call count from it. */
    int32_t index_base;
    int32_t triangle;     /**< SIGNORINI_TRIANGLE_... */
    int64_t size;         /**< Number of rows and columns. */
    int64_t nnz;          /**< Number of stored entries. */
    /** Start of each column in row and values, size + 1 entries from index_base. */
    const void *col_start;
    const void *row;      /**< Row of each entry, ascending in each column. */
    const double *values; /**< The entries; a stiffness: force / length. */
    /**
     * Each degree of freedom once, in the order of elimination, size entries. NULL: chosen. The
     * places of fixed ones and slaves do not matter; those with the same neighbours, as of one
     * node, go together. Not read for a flexibility, nor in full space.
     */
    const void *order;
};

/**
 * Equations u[dependent] = sum of coefficient * u[dof], without terms 0: constraints, rigid
 * bodies, turned axes, cyclic sectors. Pairs may name dependents. Those of K are eliminated, with
 * their loads; others have any number. Contact forces come out on the rest.
 */
struct signorini_equations {
    uint32_t struct_size;       /**< sizeof(signorini_equations). */
    int32_t reserved;           /**< 0. */
    int64_t count;              /**< Number of equations. */
    const int64_t *dependent;   /**< One of each equation, not in fixed. */
    const int64_t *start;       /**< Start of each equation's terms, as master_start. */
    const int64_t *dofs;        /**< Degree of freedom of each term. */
    const double *coefficients; /**< Of each term. */
};

/**
 * Contact pairs: each has a slave node, a point that faces it, and a normal. The point is
 * interpolated between master nodes on other bodies; without masters it is on a rigid obstacle:
 *     u_slave = sum of weight * u_master + n d_n + t d_t      (3D: + t1 d_t1 + t2 d_t2)
 *
 * General rows, as of mortar methods: slaves, master_start, masters and weights are NULL, and
 * n d_n + t d_t = sum of row_weight * u over nodes or, as of rigid bodies, of row_vector * u over
 * degrees of freedom.
 *
 * A node may stand in any number of pairs, as slave and master, and be fixed. Where a pair is held
 * along its normal or a tangent, d and F are zero there, and prescribed values that move it are
 * refused. Pairs may depend on each other, as those of a node on two planes: then contact forces
 * are not unique.
 */
struct signorini_pairs {
    uint32_t struct_size;                 /**< sizeof(signorini_pairs). */
    int32_t dim;                          /**< Space dimension, 2 or 3. */
    int64_t count;                        /**< Number of pairs. */
    const int64_t *slaves; /**< Degrees of freedom of each slave node, in the order of the axes. */
    /** Start of each pair's masters, count + 1 entries from index_base. NULL: no pair has any. */
    const int64_t *master_start;
    const int64_t *masters;               /**< Those of each master node. */
    /** Weight of each master node, negative ones too; those of a pair sum to 1. */
    const double *weights;
    /** Normal of each pair, dim entries, outward from the slave's body, of any length. */
    const double *normals;
    /**
     * First tangent of each pair, dim entries, orthogonal to the normal to 1e-5; t2 = n x t1. NULL:
     * chosen. 2D: n turned by +90 degrees. 3D: as supports hold, else e x n, e the first axis most
     * across n.
     */
    const double *tangents;
    /** General rows: start of each pair's nodes, as master_start; else NULL. */
    const int64_t *row_start;
    const int64_t *row_nodes;             /**< Those of each node. */
    /**
     * Weight of each node: positive on the side whose outward normal is given, else negative.
     * Those of a pair sum to 0, and against a rigid obstacle to 1.
     */
    const double *row_weights;
    /**
     * dim numbers for each of row_nodes, which are degrees of freedom then; row_weights is NULL.
     */
    const double *row_vectors;
    const signorini_equations *equations; /**< NULL: none. */
};

/** A structure reduced to its contact pairs, for all load cases. */
typedef struct signorini_model signorini_model;

/**
 * Makes a model of your whole sparse stiffness matrix with contact pairs, for any number of bodies
 * and contact zones. H = K->size.
 *
 * If the condensed model needs more than memory_limit, or than the system has, the model is in
 * full space (data.kind): load cases are solved by Newton's method; methods other than AUTO and
 * NEWTON, search and settings.proof are refused. Dependent pairs are condensed.
 *
 * @param K         the stiffness of all degrees of freedom, the fixed ones too
 * @param n_fixed,fixed  number of fixed degrees of freedom, and these
 * @param pairs     the contact pairs
 * @param settings  NULL: the defaults. It reads progress, user, time_limit, memory_limit, threads
 *                  and full_space
 * @param model     out: the model
 */
int32_t signorini_model_new_sparse(const signorini_sparse *K, int64_t n_fixed, const int64_t *fixed,
                                   const signorini_pairs *pairs, const signorini_settings *settings,
                                   signorini_model **model);

/**
 * Makes a model of a body that you have condensed, on a rigid obstacle: d = u, H = N.
 *
 * @param dim,pairs,K,ldk  as for signorini_solve
 * @param settings,model   as for signorini_model_new_sparse; full_space has no effect
 */
int32_t signorini_model_new_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk,
                                      const signorini_settings *settings, signorini_model **model);

/**
 * Makes a model of two bodies that you have condensed on matching contact nodes, each in its own
 * outward frame: n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. One body may float; a motion
 * that neither resists is refused. Loads and displacements are [A; B], H = 2 N.
 *
 * @param dim,pairs,settings,model  as for signorini_model_new_condensed
 * @param K_A,lda,K_B,ldb  stiffness of each body, as K and ldk for signorini_solve
 */
int32_t signorini_model_new_two_body(int32_t dim, int64_t pairs, const double *K_A, int64_t lda,
                                     const double *K_B, int64_t ldb,
                                     const signorini_settings *settings, signorini_model **model);

/**
 * Makes a model in flexibility form: d = W F + q takes the place of K d = f + F. Contact, friction
 * and signs stay. In load cases f holds q, the relative displacements without contact forces, and
 * F the start if settings.warm_start is set; H = N. W may be singular, as with redundant pairs:
 * then contact forces are not unique, and report.uniqueness is never UNIQUE.
 *
 * Codes with u = W r + q, where u_N >= 0 opens a contact and r_N >= 0 presses (FCLIB, Siconos,
 * most multibody codes), hand over -q; then u = -d and r = -F. Velocities and impulses may take
 * the places of displacements and forces.
 *
 * report.eta is relative to the larger of F and q, the latter turned into a force. If open pairs
 * move freely by far more than forces undo elsewhere, ask for a smaller tolerance.
 * SIGNORINI_STATUS_NO_EQUILIBRIUM proves that the gaps contradict each other. If friction wedges
 * bodies, SIGNORINI_STATUS_STALLED follows, and the sentence names the pairs whose forces grow.
 *
 * @param dim,pairs,model  as for signorini_model_new_condensed
 * @param W,ldw  flexibility, as K and ldk for signorini_solve, but length / force, and not zero. A
 *               row of zeros is a component that nothing moves
 */
int32_t signorini_model_new_flexibility(int32_t dim, int64_t pairs, const double *W, int64_t ldw,
                                        signorini_model **model);

/**
 * Makes a model in flexibility form of a sparse matrix. Pairs that no entry of W ties to each
 * other are islands, each solved as a dense problem of its own; the largest decides the memory.
 *
 * The status is that of the worst island; an island without equilibrium does not stop the others.
 * At a limit, or where the callback cancels, islands that are left keep the start. report.method,
 * omega and damping are those of the largest island with the status; counts are sums.
 *
 * @param dim,pairs,model  as for signorini_model_new_condensed
 * @param W  W->size = N; rows of zeros need not be stored; stored zeros tie nothing
 */
int32_t signorini_model_new_flexibility_sparse(int32_t dim, int64_t pairs,
                                               const signorini_sparse *W, signorini_model **model);

/** Releases a model. NULL is allowed. */
void signorini_model_free(signorini_model *model);

/* Kind of a model. */
#define SIGNORINI_MODEL_STIFFNESS 0   /**< A condensed stiffness matrix K. */
#define SIGNORINI_MODEL_FULL_SPACE 1  /**< Factors of the sparse stiffness matrix. */
#define SIGNORINI_MODEL_OPERATOR 2    /**< Your products and solutions. */
#define SIGNORINI_MODEL_FLEXIBILITY 3 /**< The flexibility form, d = W F + q. */

/** The content of a model. */
struct signorini_model_data {
    uint32_t struct_size; /**< sizeof(signorini_model_data). */
    int32_t dim;          /**< Space dimension. */
    int64_t pairs;        /**< Number of pairs. */
    int64_t host_size;    /**< H. */
    int64_t fixed;        /**< Number of fixed degrees of freedom. */
    /**
     * Most bytes that a load case may take beside the model and your arrays. A call works on up to
     * 32 cases at once, each with some more vectors of H entries.
     */
    int64_t memory;
    int32_t kind;         /**< SIGNORINI_MODEL_... */
    /** Number of pairs whose rows (nearly) follow from other pairs or supports. */
    int32_t dependent;
    /**
     * Stiffness in relative displacements, N columns of N entries. NULL if kind is not
     * SIGNORINI_MODEL_STIFFNESS, or pairs depend on each other.
     */
    const double *K;
    /**
     * Frames of the pairs, to turn d and F to global axes: normal and tangents, unit vectors of
     * dim entries, vector = n d_n + t d_t. NULL: you condensed in frames of your own.
     */
    const double *frames;
};

/** Fills data. Its arrays live as long as the model. */
int32_t signorini_model_view(const signorini_model *model, signorini_model_data *data);

/* ============================================================================================
 * 3  Many load cases
 * ========================================================================================== */

/**
 * Solves load cases. Every array has a column for each case, without space between. A case that is
 * wrong or not solved does not stop the others. Only the status is written of a case that is
 * wrong, or had not begun when the callback cancelled.
 *
 * Many cases in one call share work: they cost less than one by one, and the last digits depend on
 * the cases before.
 *
 * @param model,cases  the model; number of load cases, 0 allowed
 * @param f            your nodal loads, H a case
 * @param prescribed   values of the fixed degrees of freedom, in the order of fixed; NULL: zero
 * @param gap,law,friction,slip0,settings,d,F,state,extra  as for signorini_solve
 * @param status       out: status of each case, -k for the k-th argument of this call; may be NULL
 * @param report       out: one a case, each with its struct_size set; may be NULL
 * @return 0: every case is solved; otherwise the status of the first that is not, which
 *         signorini_last_error names
 */
int32_t signorini_model_solve(const signorini_model *model, int64_t cases, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0,
                              const signorini_settings *settings, double *d, double *F,
                              int32_t *state, int32_t *status, signorini_report *report,
                              const signorini_extra *extra);

/**
 * Your displacements from the relative ones; many cases cost less in one call. If u overflows in a
 * case, those before it may be written.
 *
 * @param model,cases,prescribed  as for signorini_model_solve
 * @param f  nodal loads, H a case; NULL: zero, as for a motion of escape
 * @param d  relative displacements, N a case
 * @param u  out: displacements, H a case
 */
int32_t signorini_model_recover(const signorini_model *model, int64_t cases, const double *f,
                                const double *prescribed, const double *d, double *u);

/**
 * Contact forces as your nodal forces. Sparse model: F by the signed weights. Two bodies: F on
 * both, each in its own frame. Condensed model: F itself.
 *
 * @param model  the model
 * @param F      contact forces, N
 * @param nodal  out: nodal forces, H
 */
int32_t signorini_model_nodal_forces(const signorini_model *model, const double *F, double *nodal);

/**
 * Relative loads of a load case: the f that signorini_solve takes with the K of
 * signorini_model_data. There are none if pairs depend on each other.
 *
 * @param model,f,prescribed  as for signorini_model_solve
 * @param load  out: relative loads, N
 */
int32_t signorini_model_condensed_load(const signorini_model *model, const double *f,
                                       const double *prescribed, double *load);

/**
 * Measures relative displacements of any origin on a load case.
 *
 * @param model,f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
 * @param tolerance     largest eta of a solution, 1e-15 to 0.1
 * @param d             the displacements, N
 * @param F             out: the contact forces that obey the law and are nearest to K d - f, N;
 *                      may be NULL. In flexibility form, and where pairs depend on each other, in:
 *                      the forces to be measured with d
 * @param state,report  as for signorini_solve
 * @return 0: a solution; SIGNORINI_STATUS_NOT_A_SOLUTION: none; or another status
 */
int32_t signorini_model_certify(const signorini_model *model, const double *f,
                                const double *prescribed, const double *gap, int32_t law,
                                const double *friction, const double *slip0, double tolerance,
                                const double *d, double *F, int32_t *state,
                                signorini_report *report);

/* ============================================================================================
 * 4  Fine tuning
 * ========================================================================================== */

/* ---- How to solve -------------------------------------------------------------------------- */

#define SIGNORINI_METHOD_AUTO 0           /**< Methods in turn, until one finds a solution. */
/** Projected over-relaxed Gauss-Seidel (SOR) on a sequence of Tresca problems, g <- mu |F_n|. */
#define SIGNORINI_METHOD_SOR_NESTED 1
/** Sweeps that update the threshold after each pair; not for Tresca's law. */
#define SIGNORINI_METHOD_SOR_DIAGONAL 2
/** Lemke's method, without friction or in 2D. If K is positive definite it ends at a solution. */
#define SIGNORINI_METHOD_LEMKE 3
#define SIGNORINI_METHOD_BLOCK_PIVOTING 4 /**< Block principal pivoting, without friction. */
#define SIGNORINI_METHOD_NEWTON 5         /**< Newton's method; it may fail. */
/** With friction: a path that ends at a solution; it exists if K is definite. */
#define SIGNORINI_METHOD_PATH 6

/** Report only what the solution itself proves about other solutions. */
#define SIGNORINI_SEARCH_OFF 0
/** Prove that the solution is unique, or look for a second one. It costs several solutions. */
#define SIGNORINI_SEARCH_OTHERS 1

typedef struct signorini_progress signorini_progress;

/** Later versions may add fields at the end. */
struct signorini_progress {
    int64_t iterations; /**< Sweeps, pivots or linear systems done. */
    double eta;         /**< Latest measured eta; infinite before the first measurement. */
    double elapsed;     /**< Seconds since the call began. */
    /** Share of a reduction or a pairing that is done, 0 to 1; 1 in a load case. */
    double reduced;
    /** Bytes that this reduction needs in all, told before they are taken; otherwise 0. */
    int64_t memory;
};

/**
 * Called before each sweep, pivot or linear system, between them in long work, and often while
 * models are made or surfaces paired. A nonzero result cancels: SIGNORINI_STATUS_CANCELLED, or
 * what was found. It runs on the calling thread, in the default floating-point environment. It
 * must return (no longjmp, no exception), and not call this library.
 */
typedef int32_t (*signorini_progress_fn)(void *user, const signorini_progress *progress);

/** Fill it by signorini_settings_default(), then change what you like. */
struct signorini_settings {
    uint32_t struct_size;           /**< sizeof(signorini_settings). */
    int32_t method;                 /**< SIGNORINI_METHOD_...; default SIGNORINI_METHOD_AUTO. */
    double tolerance; /**< Solved means eta <= tolerance; 1e-15 to 0.1, default 1e-10. */
    double omega; /**< Over-relaxation factor, 0 to 2; default 0: chosen from the measured rate. */
    double damping; /**< Damping of the threshold update, 0 to 1; default 0: chosen likewise. */
    /** Most sweeps, pivots or linear systems, at least 1; default 200000. */
    int64_t max_iterations;
    /**
     * Most seconds of wall time; 0, the default, and infinity: no limit. A factorisation that would
     * take longer is not begun.
     */
    double time_limit;
    /**
     * Nonzero: start from what d holds, block pivoting from its states. Default 0: start from d =
     * 0, block pivoting from all pairs closed. Lemke's method has no start.
     * SIGNORINI_START_PREVIOUS: from the case before.
     */
    int32_t warm_start;
    int32_t search;                 /**< SIGNORINI_SEARCH_...; default SIGNORINI_SEARCH_OFF. */
    signorini_progress_fn progress; /**< Progress callback; default NULL. */
    void *user;                     /**< First argument of progress; default NULL. */
    /**
     * Nonzero: prove that the solution exists, and where: report.proof, extra.radius_d and
     * radius_F; default 0. It costs one to five solutions.
     */
    int32_t proof;
    int32_t reserved;               /**< 0. */
    /** Most bytes that a solution, or making a model, may need; default 0: no limit. */
    int64_t memory_limit;
    int32_t full_space; /**< Nonzero: a sparse model is always in full space; default 0. */
    /**
     * Most threads of a call, at most one a processor; default 1; 0 stands for 1. They end before
     * the call does, and get no signals. If the system refuses memory to a thread that begins, the
     * process may end.
     *
     * Several cases of signorini_model_solve: each thread solves a part of them, and takes
     * signorini_model_data.memory, to which memory_limit applies. The same number gives the same
     * bits.
     *
     * One case, a callback, SIGNORINI_START_PREVIOUS, and other calls: at most 64 share large
     * factorisations and products. Any number gives the same bits. In those of a sparse matrix
     * each takes 8 bytes an unknown and up to 1 MB.
     */
    int32_t threads;
};

/** Fills settings with their defaults; struct_size is sizeof(signorini_settings). */
int32_t signorini_settings_default(signorini_settings *settings, uint32_t struct_size);

/**
 * Most bytes that a call with n unknowns may take beside your arrays, with any method, law (ties:
 * 8 n n more) and setting: signorini_solve with n = dim * pairs, and signorini_lcp_solve. Some MiB
 * that each thread keeps are not counted. -1 if n is negative.
 */
int64_t signorini_solve_memory(int64_t n);

/* ---- How good the result is ---------------------------------------------------------------- */

#define SIGNORINI_UNIQUENESS_NOT_KNOWN 0 /**< Not known. */
#define SIGNORINI_UNIQUENESS_UNIQUE 1    /**< Proved: there is no other solution. */
#define SIGNORINI_UNIQUENESS_SEVERAL 2   /**< There are others, by an estimate of errors. */

/* Proof of a solution. */
#define SIGNORINI_PROOF_NOT_ASKED 0 /**< settings.proof is 0. */
/**
 * Proved: the problem (of a model: the condensed one) has a solution with these states, each
 * double taken as an exact number.
 */
#define SIGNORINI_PROOF_PROVED 1
/** Not proved: a pair at the boundary of two states, K badly conditioned, or no time. */
#define SIGNORINI_PROOF_NOT_PROVED 2

/* Why the first method was abandoned. */
#define SIGNORINI_FALLBACK_NONE 0       /**< The first method succeeded. */
#define SIGNORINI_FALLBACK_CYCLE 1      /**< Its states repeated. */
#define SIGNORINI_FALLBACK_SINGULAR 2   /**< It met a singular system. */
#define SIGNORINI_FALLBACK_UNSTABLE 3   /**< It found an unstable solution (orientation -1). */
#define SIGNORINI_FALLBACK_INACCURATE 4 /**< It found no accurate solution. */

/* Remarks: legal, and often a mistake. */
/** Every finite gap is negative: interference everywhere, or wrong sign. */
#define SIGNORINI_REMARK_GAPS_NEGATIVE 1
/** A coefficient of friction is above 10: in percent, or another array? */
#define SIGNORINI_REMARK_FRICTION_LARGE 2
/**
 * Without friction bodies may move freely: a support may be missing. Not sought in full space, nor
 * for dependent pairs.
 */
#define SIGNORINI_REMARK_FREE_MOTION 4
#define SIGNORINI_REMARK_HELD_BY_ROUNDING 8 /**< Only rounding of K holds a body. */
/** d rounded to doubles misses the tolerance, d + extra.d_low meets it. */
#define SIGNORINI_REMARK_NEEDS_LOW_PART 16
#define SIGNORINI_REMARK_GAPS_PASSED 32 /**< Large penetration beside gaps: forces may be wrong. */

/** Static text for one remark, such as "every gap is negative"; never NULL. */
const char *signorini_remark_string(int32_t remark);

/**
 * How good a result is, and how it was found. Set struct_size; a call writes all other fields.
 * K d - f is the contact force that d requires.
 */
struct signorini_report {
    uint32_t struct_size;     /**< sizeof(signorini_report). */
    int32_t status;           /**< The status, as the call returns it. */
    int32_t method; /**< The method that found the result, SIGNORINI_METHOD_...; certify: 0. */
    int32_t uniqueness;       /**< SIGNORINI_UNIQUENESS_... */
    int64_t iterations;       /**< Sweeps, pivots or linear systems, of all methods tried. */
    /** Threshold updates of the nested method; without a condensed K: solutions with a factor. */
    int64_t outer_iterations;
    int64_t refactorisations; /**< How often Lemke's tableau was refactorised. */
    /** Residual of the law relative to the forces, no unit, before d is rounded to doubles. */
    double eta;
    /**
     * Most that rounding d to doubles may add to eta, no unit. Above 1e-6, d is certified only if
     * its energy d . K d is more than rounding of K explains.
     */
    double rounding;
    double penetration;       /**< Largest d_n - gap; length; 0 if none. */
    /** Largest normal part of K d - f beyond the tension of the law; force; 0 if none. */
    double tension;
    /** Largest excess of the tangential part of K d - f over its bound; force; 0 if none. */
    double cone_excess;
    double equilibrium;       /**< Largest component of K d - f - F; force. */
    double omega;             /**< Over-relaxation factor at the end; 0 if the method has none. */
    double damping;           /**< Damping likewise. */
    int64_t pairs_open;       /**< Pairs of SIGNORINI_STATE_OPEN. */
    int64_t pairs_slipping;   /**< Pairs of SIGNORINI_STATE_SLIP. */
    int64_t pairs_sticking;   /**< Pairs of SIGNORINI_STATE_STICK. */
    /** Dense factorisations by Newton's method and block pivoting. In full space: sparse ones. */
    int64_t factorisations;
    int32_t first_method;     /**< The first method, SIGNORINI_METHOD_... */
    int32_t fallback;         /**< SIGNORINI_FALLBACK_... */
    /**
     * Sign of the determinant of the equations that the states select; 0: not known. -1: the
     * solution is unstable; if K is positive definite, at least two others exist.
     */
    int32_t orientation;
    int32_t second;           /**< 1: a second solution was found; else 0. */
    /**
     * Largest error of a component of d over its largest component, no unit: proved with
     * SIGNORINI_PROOF_PROVED, else estimated from the last refinement; -1: not known.
     */
    double error_d;
    double error_F;           /**< Likewise of F, over the largest component of F and f. */
    int32_t proof;            /**< SIGNORINI_PROOF_... */
    int32_t remarks;          /**< Sum of SIGNORINI_REMARK_...; 0: none. */
};

/** Fills report with zeros; struct_size is sizeof(signorini_report). */
int32_t signorini_report_default(signorini_report *report, uint32_t struct_size);

/* ---- More results -------------------------------------------------------------------------- */

/**
 * Further results: arrays of N entries, of cases a column for each. NULL, as
 * signorini_extra_default() sets them: not wanted.
 */
struct signorini_extra {
    uint32_t struct_size;  /**< sizeof(signorini_extra). */
    int32_t reserved;      /**< 0. */
    /**
     * With SIGNORINI_STATUS_NO_EQUILIBRIUM a motion r that proves it, its largest entry 1: K r = 0,
     * and f . r + F . r > 0 for all forces F that the law admits. In flexibility form forces p,
     * pressing normal ones but for ties: W p = 0, p . (g - q) > 0, g gap and reference slip. Else
     * zeros.
     */
    double *motion;
    double *second_d; /**< Displacements of a second solution if report.second is 1; else zeros. */
    double *second_F;      /**< Its contact forces likewise. */
    int32_t *second_state; /**< Its states likewise, one for each pair. */
    /**
     * With SIGNORINI_PROOF_PROVED the solution lies within this distance of d, component by
     * component; length. Else -1.
     */
    double *radius_d;
    double *radius_F;      /**< Likewise of the contact forces; force. */
    /**
     * With SIGNORINI_STATUS_NO_EQUILIBRIUM the motion of escape, its largest entry 1: K r = 0, no
     * pair approaches its obstacle, friction opposes the slip, and f . r > 0, if every pair of
     * finite gap touches. With SIGNORINI_STATUS_STALLED a motion that proves nothing. Else zeros.
     */
    double *escape;
    double *d_low; /**< The last digits of d: d + d_low is what the report measures; length. */
};

/** Fills extra with NULL pointers; struct_size is sizeof(signorini_extra). */
int32_t signorini_extra_default(signorini_extra *extra, uint32_t struct_size);

/* ---- Linear complementarity problems ------------------------------------------------------- */

/**
 * Solves a linear complementarity problem (LCP): w = q + M z, w >= 0, z >= 0, w . z = 0.
 *
 * With SIGNORINI_METHOD_AUTO the problem is solved if M is positive definite or a P-matrix, and
 * solved or proved infeasible (SIGNORINI_STATUS_NO_EQUILIBRIUM) if positive semi-definite or
 * copositive-plus, to condition numbers of 1e10. Any other M may also end in a ray that proves
 * nothing (SIGNORINI_STATUS_STALLED).
 *
 * @param n         number of unknowns, 0 allowed
 * @param M         any matrix, n columns of n entries
 * @param ldm       entries from one column of M to the next, at least max(1, n)
 * @param q         n
 * @param cover     covering vector of Lemke's method, n positive entries; NULL: ones
 * @param settings  NULL: the defaults; method AUTO, BLOCK_PIVOTING or LEMKE; omega, damping,
 *                  warm_start and search have no effect
 * @param w,z       out: n
 * @param y         out: n; may be NULL. With SIGNORINI_STATUS_NO_EQUILIBRIUM the proof: y >= 0,
 *                  M' y <= 0, q . y < 0; else zeros
 * @param report    as for signorini_solve
 */
int32_t signorini_lcp_solve(int64_t n, const double *M, int64_t ldm, const double *q,
                            const double *cover, const signorini_settings *settings, double *w,
                            double *z, double *y, signorini_report *report);

/* ---- Versions ------------------------------------------------------------------------------ */

#define SIGNORINI_VERSION_MAJOR 0 /**< Major version. */
#define SIGNORINI_VERSION_MINOR 9 /**< Minor version. */
#define SIGNORINI_VERSION_PATCH 0 /**< Patch version. */
#define SIGNORINI_ABI_VERSION 3   /**< Binary interface of this header. */

/** Version, such as "0.9.0"; static text. */
const char *signorini_version(void);

/** Binary interface of the library; after dlopen compare SIGNORINI_ABI_VERSION. */
int32_t signorini_abi_version(void);

/* ============================================================================================
 * 5  What may still change
 *
 * Define SIGNORINI_UNSTABLE before you include this header, and link a library of the same version.
 * ========================================================================================== */

#ifdef SIGNORINI_UNSTABLE

/**
 * settings.warm_start of signorini_model_solve: each case starts from the solution of the last
 * one that was solved, in this call or in earlier ones on the model with this setting; the first
 * one as with 0. They share factors: the model keeps 32 N N bytes at most, until it is released
 * or a call has another start. The same calls in the same order give the same bits; another
 * order may change last digits, and which of several solutions is found. Only one thread of
 * those that share a model may use it. Other calls take it as 0.
 */
#define SIGNORINI_START_PREVIOUS 2

/**
 * Tries to prove that a load case has a solution next to displacements of any origin, in the
 * sense of SIGNORINI_PROOF_PROVED, and bounds its distance. Others may exist.
 *
 * @param model  a model with a condensed matrix
 * @param f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
 * @param d      relative displacements, N
 * @param state  SIGNORINI_STATE_... of each pair; NULL: those of d
 * @param F      out: contact forces of the solution, N; zeros if not proved; may be NULL
 * @param radius_d,radius_F  out: as in signorini_extra; may be NULL
 * @return 0: proved; SIGNORINI_STATUS_NOT_PROVED: not; or another status
 */
int32_t signorini_model_prove(const signorini_model *model, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0, const double *d,
                              const int32_t *state, double *F, double *radius_d, double *radius_F);

/* ---- Products and solutions in the place of a matrix --------------------------------------- */

typedef struct signorini_operator signorini_operator;

/**
 * Your product, y = K_rel x or y = W x, with N entries. Returns 0; another number ends the call of
 * the library, whose sentence tells it. As a progress callback it must return, and not call this
 * library.
 */
typedef int32_t (*signorini_product_fn)(void *user, const double *x, double *y);

/**
 * Your solution with components held: y is 0 where held is nonzero, and K_rel y = x in the other
 * components; x counts only there. All have N entries. changed is 0 if the same components are
 * held as in the call before on this model, and that call has not failed: then a factor may serve
 * again. Returns as signorini_product_fn.
 */
typedef int32_t (*signorini_held_fn)(void *user, const int32_t *held, int32_t changed,
                                     const double *x, double *y);

/**
 * Your preconditioner, with unknowns set: z near the solution of A z = r with components of d held
 * and springs. No accuracy is asked, nor that it is linear or symmetric: one cycle of multigrid
 * serves. held has N entries, nonzero where held; r and z do not count there. springs are to be
 * added to A between the tangential components of each pair: force / length, one number for each
 * pair in 2D, in 3D four, a symmetric, positive semi-definite matrix; those of held components do
 * not count. changed is as in signorini_held_fn, for springs too. Returns as signorini_product_fn.
 */
typedef int32_t (*signorini_precondition_fn)(void *user, const int32_t *held, const double *springs,
                                             int32_t changed, const double *r, double *z);

/**
 * Functions in the place of a matrix that lies on several processes or is never formed. K_rel is
 * the K of signorini_solve.
 */
struct signorini_operator {
    uint32_t struct_size;                   /**< sizeof(signorini_operator). */
    int32_t dim;                            /**< Space dimension. */
    int64_t pairs;                          /**< Number of pairs. */
    /** y = K_rel x; symmetric, positive semi-definite; as exact as the tolerance asks for. */
    signorini_product_fn stiffness;
    /**
     * y = W x, W close to the inverse of K_rel, symmetric, positive definite: a solution with the
     * contact free. NULL: held is used alone.
     */
    signorini_product_fn inverse;
    signorini_held_fn held; /**< In the place of W. May be NULL if inverse is given. */
    /**
     * Positive numbers of the size of the diagonal of K_rel, N; force / length. NULL: one for each
     * direction, from products.
     */
    const double *units;
    void *user;                             /**< First argument of the functions. */
    /**
     * 0: vectors have N entries, those of the pairs. Otherwise H, the number of all your unknowns,
     * of which the components of d are some: then stiffness is y = A x on all of them, exact but
     * for rounding; units is given, H; inverse and held are NULL.
     */
    int64_t unknowns;
    /** With unknowns set: the unknown that is each component of d, from 0, N. */
    const int64_t *place;
    signorini_precondition_fn precondition; /**< With unknowns set. */
    /**
     * Without unknowns: what products and solutions agree to, relative to their sizes; no smaller
     * tolerance can be met. 0: 1e-9.
     */
    double accuracy;
};

/**
 * Makes a model of your functions. They run on the calling threads. Load cases are solved as in
 * full space.
 *
 * With products and solutions of the pairs H = N: loads and displacements are relative. A load
 * case mostly takes up to 160 products (2D: 110) with each of K_rel and W, or 70 solutions with
 * held; bad conditioning, more.
 *
 * With unknowns set A is symmetric, positive semi-definite, and takes the place of a sparse
 * matrix: supports and the turn to the frames of the pairs are in it. A load case takes some 100
 * preconditionings. No motion of a body that nothing holds is found. In eta the size of the loads
 * is known to a thousandth.
 *
 * The call asks for some products, which must be finite, linear, symmetric, positive and the same
 * each time, to 1e-9 or K->accuracy. Later calls return -1 if a function fails or gives a number
 * that is not finite; the model can be used again.
 *
 * @param K      the functions; the structure is copied, with units and place
 * @param model  out: the model
 */
int32_t signorini_model_new_operator(const signorini_operator *K, signorini_model **model);

#endif /* SIGNORINI_UNSTABLE */

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SIGNORINI_H */
