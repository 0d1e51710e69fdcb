/*
 * signorini: unilateral contact with friction for existing finite-element codes.
 *
 * Sections of this header, in the order of need:
 *
 *     1  One call            a matrix that you have condensed on the contact components
 *     2  Your own matrix     a whole sparse matrix with contact pairs, two bodies, a flexibility
 *     3  Many load cases     solve, recover, certify
 *     4  Fine tuning         settings, report, second solutions, LCPs, versions
 *     5  What may change     behind SIGNORINI_UNSTABLE
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
 *         stick:  d_t = slip0                            Coulomb friction
 *         slip:   d_t - slip0 = -lambda F_t, lambda >= 0, |F_t| = mu |F_n|
 *
 * K is the stiffness matrix condensed on the contact components: symmetric, positive definite or
 * semi-definite (bodies supported by nothing but contact). slip0 is the reference slip: the d_t at
 * which a sticking pair stays. SIGNORINI_LAW_... lists the other friction laws.
 *
 * Signs. n is the outward normal of the body: d_n > 0 moves towards the obstacle, F_n < 0 presses.
 * F is the force of the contact on the body. f and F are nodal forces, not stresses. Example: above
 * a plane, with n = (0, -1) and t = (1, 0), d_n = -u_y and d_t = u_x. Transform f in the same way;
 * the mixed entries K_nt change their sign.
 *
 * Units are yours: any consistent set.
 *
 * A component that you hold fixed stays in a condensed matrix as a decoupled row: zero off the
 * diagonal, positive on the diagonal, zero load.
 *
 * Arguments have one order in all functions: the model or file that the call works on; sizes; the
 * problem (K, ldk, f, prescribed, gap, law, friction, slip0); settings or tolerance; results (d, F,
 * state, status); report; extra. Matrices are column-major, each followed by its leading dimension.
 * Numbers are 64-bit. An argument may be NULL where its description says so, and where the array
 * has no entries. An array that a call writes must not overlap another array of the call.
 *
 * Status. Every call that computes returns an int32_t:
 *
 *     0          solved and certified on your data: report.eta <= settings.tolerance
 *     > 0        the results are written but are not a solution: SIGNORINI_STATUS_...; with
 *                SIGNORINI_STATUS_MEMORY_LIMIT nothing was written
 *     -k         the k-th argument is wrong; nothing was written
 *     <= -1000   out of memory, a file that cannot be read or written, a caught defect
 *
 * signorini_last_error() says in a sentence what is wrong and where. Entries count from 0:
 * K[row,column].
 *
 * Structures begin with struct_size, which you set to sizeof: ..._default does, and so does
 * signorini_model_data data = {sizeof data}. A program and a library of different versions work
 * together: fields that one of them does not know are zero or keep their defaults. A field that
 * asks for what the library does not have is refused.
 *
 * Threads. Calls from several threads at once are safe, on the same model or problem too, as long
 * as no thread frees it. The library never prints, exits, reads the environment or handles signals.
 * It starts threads only where settings.threads asks for them. It opens only the files that you
 * name. It keeps your floating-point environment: inside a call traps and flush-to-zero are off;
 * on return they are as before. The same input gives the same bits on the same machine. A thread
 * that is cancelled (pthread_cancel, deferred) ends after its call. Calls need 64 KiB of stack.
 *
 * Memory. A call to which the system refuses memory ends with SIGNORINI_STATUS_OUT_OF_MEMORY and
 * holds nothing; the next call works. For that each call obtains, before its work begins, as much
 * address space as it may need: signorini_solve_memory. It costs nothing while it is not touched,
 * but counts where address space is limited (ulimit -v): there a call needs twice its memory. One
 * request of the C library ends the process if it is refused: 40 bytes at the first product of
 * matrices of each thread.
 */

#ifndef SIGNORINI_H
#define SIGNORINI_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ============================================================================================
 * 1  One call
 *
 * signorini_solve takes a condensed problem on plain arrays. settings, report and extra may be
 * NULL; their structures stand in section 4.
 * ========================================================================================== */

typedef struct signorini_settings signorini_settings;
typedef struct signorini_report signorini_report;
typedef struct signorini_extra signorini_extra;

/* Friction law: how large |F_t| may be. */
/** No friction: F_t = 0. friction may be NULL and is not read. */
#define SIGNORINI_LAW_FRICTIONLESS 0
/** Coulomb: |F_t| <= mu |F_n|. friction holds mu >= 0, one for each pair. */
#define SIGNORINI_LAW_COULOMB 1
/** Tresca: |F_t| <= g, open or closed. friction holds g >= 0, one for each pair; force. */
#define SIGNORINI_LAW_TRESCA 2
/**
 * Coulomb with cohesion and a tension cut-off: F_n <= a, (d_n - gap) (F_n - a) = 0,
 * |F_t| <= b - mu F_n. friction holds three numbers for each pair, (mu, b, a): mu >= 0; a >= 0,
 * the tension at which the pair opens, force; b >= mu a, the cohesion, force. The law has no
 * memory: an open pair carries the tension F_n = a and a friction of up to b - mu a, however far
 * it is open (gap +inf too). To let a pair break, the host sets its b and a to 0 in the load steps
 * after it opened.
 */
#define SIGNORINI_LAW_COHESIVE 3
/**
 * Orthotropic, 3D only: (F_1 / mu1)^2 + (F_2 / mu2)^2 <= F_n^2, an ellipse. friction holds three
 * numbers for each pair, (mu1, mu2, angle): the coefficients along axis 1 and 2, both > 0 and at
 * most 1e6 times apart, and the angle of axis 1 from t1 towards t2 in radians. The pair slips along
 * the normal of the ellipse at -F_t (associated rule): of all forces in the ellipse F_t takes the
 * most work from the slip.
 */
#define SIGNORINI_LAW_ORTHOTROPIC 4
/** As SIGNORINI_LAW_ORTHOTROPIC, but the pair slips opposite to F_t (collinear rule). */
#define SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR 5

/* State of a pair. */
/**
 * The pair is apart: F_n = 0, with cohesion F_n = a; F_t = 0 but under Tresca's law and cohesion.
 * Pressure counts as none if it and its friction are below 1e-11 of the largest load or force.
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
 * @param K         condensed stiffness, N columns of N entries, column-major, both triangles;
 *                  symmetric, positive semi-definite; force / length. A row of zeros is a component
 *                  that nothing resists. Small entries on the diagonal are taken as they are: of a
 *                  free body on two or three points make a model, which knows rounding. That K is
 *                  positive semi-definite is checked by pairs of entries alone; models check it
 * @param ldk       entries from one column of K to the next, at least max(1, N)
 * @param f         condensed nodal loads, N; force
 * @param gap       initial gaps, one for each pair; length; negative: interference; +infinity:
 *                  the pair never touches
 * @param law       SIGNORINI_LAW_..., the friction law of all pairs
 * @param friction  parameters of the law, pair by pair; may be NULL if frictionless
 * @param slip0     reference slip: the tangential displacement d_t0 at which a sticking pair has
 *                  no motion, dim - 1 for each pair; length; NULL: zero. In load steps hand over
 *                  the d_t of the step before.
 * @param settings  NULL: the defaults
 * @param d         out: relative displacements, N; in: the start if settings->warm_start
 * @param F         out: contact forces, N. They obey the contact law; K d = f + F holds up to
 *                  report->equilibrium.
 * @param state     out: SIGNORINI_STATE_... of each pair; may be NULL
 * @param report    out: the measures of the result; set report->struct_size before the call, as
 *                  signorini_report_default does; may be NULL
 * @param extra     the motion of escape, a second solution; may be NULL
 * @return 0: solved and certified; > 0: the results are not a solution, SIGNORINI_STATUS_... says
 *         which; -k: the k-th argument is wrong, nothing was written; <= -1000: out of memory or
 *         a defect
 */
int32_t signorini_solve(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                        const double *gap, int32_t law, const double *friction, const double *slip0,
                        const signorini_settings *settings, double *d, double *F, int32_t *state,
                        signorini_report *report, const signorini_extra *extra);

/**
 * Says what was wrong in the last call on this thread, in one sentence, such as "K[12,7] is not
 * finite". Empty after a call that returned 0; a call that releases leaves the sentence.
 *
 * @return UTF-8 text of at most 511 bytes, never NULL. It belongs to the calling thread; the next
 *         call of the library on this thread overwrites it.
 */
const char *signorini_last_error(void);

/* What a call returns, besides -k for a wrong argument. */
#define SIGNORINI_STATUS_SOLVED 0          /**< Solved and certified: eta <= tolerance. */
#define SIGNORINI_STATUS_ITERATION_LIMIT 1 /**< max_iterations is used up: best iterate. */
#define SIGNORINI_STATUS_TIME_LIMIT 2      /**< time_limit is used up: best iterate. */
#define SIGNORINI_STATUS_CANCELLED 3       /**< The progress callback cancelled: best iterate. */
/**
 * Proved: no equilibrium exists (LCP: no w, z >= 0 satisfy w = q + M z). extra->motion (LCP: y) is
 * the proof. d, F, states and counts are those of the last iterate: not a solution.
 */
#define SIGNORINI_STATUS_NO_EQUILIBRIUM 4
/**
 * The method cannot go on (rounding, a cycle, a ray that proves nothing); the results are its best
 * iterate. With SIGNORINI_METHOD_AUTO: no method found a solution or a proof that there is none.
 */
#define SIGNORINI_STATUS_STALLED 5
#define SIGNORINI_STATUS_NOT_A_SOLUTION 6  /**< Certify: the displacements are no solution. */
/** Prove: no solution is proved to exist, which does not say that there is none. */
#define SIGNORINI_STATUS_NOT_PROVED 7
/**
 * The call may need more than memory_limit: nothing was solved or factorised, no results were
 * written.
 */
#define SIGNORINI_STATUS_MEMORY_LIMIT 8
#define SIGNORINI_STATUS_INTERNAL -1000 /**< A caught defect of the library: results undefined. */
/**
 * Out of memory: no results were written, but those of earlier load cases; the call holds nothing.
 */
#define SIGNORINI_STATUS_OUT_OF_MEMORY -1001
#define SIGNORINI_STATUS_FILE -1002        /**< A file cannot be read or written. */

/** A short description of a status, such as "solved". Static text; never NULL, for any number. */
const char *signorini_status_string(int32_t status);

/* ============================================================================================
 * 2  Your own matrix
 *
 * A model reduces what you have to the contact pairs, once: your whole sparse matrix, a condensed
 * matrix, two of them, or a flexibility. Section 3 solves load cases with it.
 * ========================================================================================== */

/* Which entries of a sparse symmetric matrix are stored. */
#define SIGNORINI_TRIANGLE_LOWER 0 /**< Stored are the entries with row >= column. */
#define SIGNORINI_TRIANGLE_UPPER 1 /**< Stored are the entries with row <= column. */
#define SIGNORINI_TRIANGLE_FULL 2  /**< All entries are stored. */

typedef struct signorini_sparse signorini_sparse;
typedef struct signorini_pairs signorini_pairs;
typedef struct signorini_model_data signorini_model_data;

/**
 * A sparse symmetric matrix by columns (CSC), stiffness or flexibility. Hand over a matrix by rows
 * (CSR) as its transpose: its rows are the columns here, and its LOWER is UPPER. The library only
 * reads it during the call.
 */
struct signorini_sparse {
    uint32_t struct_size; /**< sizeof(signorini_sparse). */
    int32_t index_bytes;  /**< Width of col_start and row: 4 for int32_t, 8 for int64_t. */
    /**
     * 0 or 1: the number of the first row. col_start, row and the degrees of freedom in all other
     * arguments of the call count from it.
     */
    int32_t index_base;
    int32_t triangle;     /**< Which entries are stored, SIGNORINI_TRIANGLE_... */
    int64_t size;         /**< Number of rows and columns. */
    int64_t nnz;          /**< Number of stored entries. */
    /** Start of each column in row and values, size + 1 entries; the last is index_base + nnz. */
    const void *col_start;
    const void *row;      /**< Row of each entry, ascending in each column; nnz entries. */
    const double *values; /**< The entries, nnz; a stiffness: force / length. */
    /**
     * Order of elimination: each degree of freedom once, the first to go first, size entries of
     * index_bytes. NULL: chosen. Fixed degrees of freedom and slaves are passed over; those with
     * the same neighbours, as of one node, go together. A flexibility has none: not looked at.
     */
    const void *order;
};

/**
 * Contact pairs: each has a slave node, a point that faces it on other bodies, and a normal. The
 * point is interpolated between master nodes. The slave's displacement is
 * u_slave = sum of weight * u_master + n d_n + t d_t (3D: + t1 d_t1 + t2 d_t2),
 * so that the gap is closed at d_n = gap.
 *
 * General rows, as mortar methods make them: leave slaves, master_start, masters and weights NULL
 * and set row_start, row_nodes and row_weights. Each pair is then a list of nodes with signed
 * weights, and n d_n + t d_t = sum of row_weight * u.
 *
 * A node may stand in any number of pairs, as slave and as master, and may be fixed. Where slave
 * and masters are all fixed along an axis, which is the normal or a tangent, d and F are zero along
 * it. Pairs may depend on each other, such as those of a node on two planes, or of two surfaces
 * that are each other's slaves: then contact forces are not unique, and the model has no
 * signorini_model_stiffness. The library only reads the structure during the call.
 */
struct signorini_pairs {
    uint32_t struct_size; /**< sizeof(signorini_pairs). */
    int32_t dim;          /**< Space dimension, 2 or 3. */
    int64_t count;        /**< Number of pairs. */
    /** Degrees of freedom of each slave node, dim for each pair, in the order of the axes. */
    const int64_t *slaves;
    /**
     * Start of each pair's masters in masters and weights, count + 1 entries, counted from
     * index_base. A pair without masters faces a rigid obstacle. NULL: no pair has masters;
     * masters and weights must be NULL too.
     */
    const int64_t *master_start;
    /** Degrees of freedom of each master node, dim for each; may be NULL if there are none. */
    const int64_t *masters;
    /**
     * Weight of each master node; may be NULL if there are none. The weights of a pair sum to 1;
     * negative weights are allowed.
     */
    const double *weights;
    /** Normal of each pair, dim entries, outward from the slave's body, of any length. */
    const double *normals;
    /**
     * First tangent of each pair, dim entries, orthogonal to the normal to 1e-5. NULL: chosen.
     * 2D: the normal turned by +90 degrees. 3D: t1 = e x n with the axis e that is most across the
     * normal. In 3D always t2 = n x t1; signorini_model_frames returns all.
     */
    const double *tangents;
    /**
     * General rows: start of each pair's nodes in row_nodes and row_weights, count + 1 entries,
     * counted from index_base. NULL: pairs of slaves and masters. A struct_size without this field
     * and the next two is right too: they are NULL then.
     */
    const int64_t *row_start;
    /** Degrees of freedom of each node, dim for each, in the order of the axes. */
    const int64_t *row_nodes;
    /**
     * Weight of each node: positive on the side whose outward normal is given, negative on the
     * other. Those of a pair sum to 0, and against a rigid obstacle to 1.
     */
    const double *row_weights;
};

/**
 * A structure that is reduced to its contact pairs: what all load cases share. Made by
 * signorini_model_new_..., released by signorini_model_free. It does not change: several threads
 * may use one at once (but see SIGNORINI_START_PREVIOUS). It holds copies: your arrays may go once
 * the model is made.
 */
typedef struct signorini_model signorini_model;

/**
 * Makes a model of your whole sparse stiffness matrix with contact pairs, for any number of bodies
 * and contact zones. Bodies that only contact supports are allowed. Loads and displacements of the
 * host have H = K->size entries.
 *
 * The call takes progress, user, time_limit, memory_limit, threads and full_space of the settings.
 * The callback is told the share that is done and, before memory is taken, how much is needed. It
 * is not called while the order of elimination is chosen (2 s for 1e5 nodes). A call that was ended
 * holds nothing.
 *
 * If the condensed matrix needs more than memory_limit, the model is in full space: no condensed
 * matrix is formed. Load cases are solved by Newton's method with GMRES on a sparse factor, which
 * each load case makes anew a few times; methods AUTO and NEWTON alone, no search, no proof. Pairs
 * that depend on each other are condensed all the same. K->order is not read for it.
 *
 * @param K         the stiffness matrix of all degrees of freedom, the fixed ones too
 * @param n_fixed   number of fixed degrees of freedom
 * @param fixed     the fixed degrees of freedom, counted from K->index_base; may be NULL if n_fixed
 *                  is 0
 * @param pairs     the contact pairs
 * @param settings  NULL: no callback, no limits, one thread
 * @param model     out: the model; NULL unless 0 is returned
 * @return 0; SIGNORINI_STATUS_CANCELLED, _TIME_LIMIT or _MEMORY_LIMIT; -k: the k-th argument is
 *         wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_sparse(const signorini_sparse *K, int64_t n_fixed, const int64_t *fixed,
                                   const signorini_pairs *pairs, const signorini_settings *settings,
                                   signorini_model **model);

/**
 * Makes a model of a body that you have condensed, on a rigid obstacle: d = u. Loads and
 * displacements of the host have H = N entries.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs
 * @param K      condensed stiffness, N = dim * pairs columns, as for signorini_solve
 * @param ldk    entries from one column to the next, at least max(1, N)
 * @param model  out: the model; NULL unless 0 is returned
 * @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk,
                                      signorini_model **model);

/**
 * Makes a model of two bodies that you have condensed on matching contact nodes, each in its own
 * outward frame: n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. One body may float. A motion
 * that neither body resists is refused. Loads and displacements of the host are [A; B], H = 2 N
 * entries.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs
 * @param K_A    condensed stiffness of body A, N = dim * pairs columns
 * @param lda    entries from one column to the next, at least max(1, N)
 * @param K_B    condensed stiffness of body B
 * @param ldb    entries from one column to the next, at least max(1, N)
 * @param model  out: the model; NULL unless 0 is returned
 * @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_two_body(int32_t dim, int64_t pairs, const double *K_A, int64_t lda,
                                     const double *K_B, int64_t ldb, signorini_model **model);

/**
 * Makes a model in flexibility form, as codes of rigid and multibody dynamics have it: d = W F + q
 * takes the place of K d = f + F. Contact, friction and signs stay. In the load cases of
 * signorini_model_solve f holds the free displacements q, the relative displacements without
 * contact forces; F holds the start if settings.warm_start is set. Loads and displacements of the
 * host have H = N entries.
 *
 * W = H M^-1 H' may be singular, as where pairs are redundant: four feet of a rigid table, a node
 * on two planes. Contact forces are not unique then. From the start zero the smallest ones are
 * returned, if states of pairs do not change during the iteration. No solution is said to be the
 * only one.
 *
 * report.eta is the residual of the law and of d - q - W F, in the units 1 / W_nn for the normal of
 * a pair and one over the largest eigenvalue of its tangential block for its tangents. It is
 * relative to the larger of F, less the part that moves nothing, and the units times q. Where pairs
 * that stay apart have free displacements far above those that forces undo, ask for a smaller
 * tolerance.
 *
 * Codes that write u = W r + q with u_N >= 0 where a contact opens and r_N >= 0 where it presses
 * (FCLIB, Siconos, most multibody codes) change all signs but those of W: hand over -q; then u = -d
 * and r = -F. Velocities and impulses may take the places of displacements and forces.
 *
 * SIGNORINI_STATUS_NO_EQUILIBRIUM proves that the gaps contradict each other: no forces move the
 * bodies to where every gap is kept. Bodies that friction wedges are not proved: the status is
 * SIGNORINI_STATUS_STALLED, and signorini_last_error names the pairs whose forces grow.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs, 0 allowed
 * @param W      flexibility, N = dim * pairs columns of N entries, column-major, both triangles;
 *               symmetric, positive semi-definite, not zero; length / force. A row of zeros is a
 *               component that nothing moves
 * @param ldw    entries from one column of W to the next, at least max(1, N)
 * @param model  out: the model; NULL unless 0 is returned
 * @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_flexibility(int32_t dim, int64_t pairs, const double *W, int64_t ldw,
                                        signorini_model **model);

/**
 * Makes a model in flexibility form of a sparse matrix.
 *
 * Pairs that no entry of W ties to each other are islands, such as heaps of bodies that do not
 * touch. Each is solved by itself as a dense problem of its size; the result is measured as a whole
 * on W. So the time is the sum of those of the islands, and the memory that of the largest. Where
 * settings.memory_limit allows less, a load case ends with SIGNORINI_STATUS_MEMORY_LIMIT before its
 * work begins, and signorini_last_error names the largest island.
 *
 * The status is that of the worst island. SIGNORINI_STATUS_NO_EQUILIBRIUM of one proves that the
 * whole has none; the other islands are solved all the same, from the smallest to the largest. At a
 * limit, or where the callback cancels, the islands that are left keep the start. report.method,
 * omega and damping are those of the largest island with the status; counts are sums over all
 * islands.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs, 0 allowed
 * @param W      flexibility, W->size = dim * pairs; symmetric, positive semi-definite, not zero;
 *               length / force. A component that nothing moves has a row of zeros, which need not
 *               be stored; stored zeros tie nothing. W->order is not read
 * @param model  out: the model; NULL unless 0 is returned
 * @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_flexibility_sparse(int32_t dim, int64_t pairs,
                                               const signorini_sparse *W, signorini_model **model);

/** Releases a model. NULL is allowed. */
void signorini_model_free(signorini_model *model);

/* How a model solves its load cases: data.kind. */
#define SIGNORINI_MODEL_STIFFNESS 0   /**< A condensed stiffness matrix K. */
/** Factors of the sparse stiffness matrix: no condensed matrix is formed. */
#define SIGNORINI_MODEL_FULL_SPACE 1
#define SIGNORINI_MODEL_OPERATOR 2    /**< Products and solutions of the host. */
#define SIGNORINI_MODEL_FLEXIBILITY 3 /**< The flexibility form, d = W F + q. */

/** The content of a model. Arrays live as long as the model. */
struct signorini_model_data {
    uint32_t struct_size; /**< sizeof(signorini_model_data) in your program; no more is written. */
    int32_t dim;          /**< Space dimension, 2 or 3. */
    int64_t pairs;        /**< Number of contact pairs. */
    int64_t host_size;    /**< H, the entries of a load or displacement vector of the host. */
    int64_t fixed;        /**< Number of fixed degrees of freedom: the entries of prescribed. */
    /**
     * Most bytes that a load case of signorini_model_solve may take beside the model and your
     * arrays. Many load cases take them in turn; up to 32 at a time take some vectors of H entries
     * each besides.
     */
    int64_t memory;
    int32_t kind;         /**< SIGNORINI_MODEL_..., by which load cases are solved. */
    /** Number of pairs whose rows follow from those of other pairs or from supports. */
    int32_t dependent;
    /**
     * The stiffness matrix in relative displacements, N columns of N entries; leading dimension N.
     * NULL: there is none, as the kind is another or pairs depend on each other.
     */
    const double *K;
    /**
     * The frames of the pairs, to turn d and F to global axes: for each pair the normal, then the
     * tangents, each a unit vector of dim entries; vector = n d_n + t d_t (2D) or
     * n d_n + t1 d_t1 + t2 d_t2 (3D). NULL: the matrix was condensed in frames of your own.
     */
    const double *frames;
};

/**
 * Shows a model: fills data, whose arrays live as long as the model.
 *
 * @param model  the model
 * @param data   out: set data->struct_size before the call
 * @return 0; -k: the k-th argument is wrong
 */
int32_t signorini_model_view(const signorini_model *model, signorini_model_data *data);

/* ============================================================================================
 * 3  Many load cases
 * ========================================================================================== */

/**
 * Solves load cases, one after the other. Every array has a column for each case, without space
 * between the columns. All cases have the same law. A case that is wrong or not solved does not
 * stop the others; the d, F, state, report and extra of a wrong case are not written. Many cases
 * in one call cost less than one by one: loads of sparse models are condensed together, and with
 * friction in 3D the elimination of pairs that stay open serves the next cases. The last digits of
 * a result depend on the cases before it in the call. A case alone depends on itself only.
 *
 * Load steps with friction: in each step hand over as slip0 the d_t of the step before, zero at
 * first. The model keeps no state, but with SIGNORINI_START_PREVIOUS.
 *
 * @param model       the model
 * @param cases       number of load cases, 0 allowed
 * @param f           nodal loads of the host, H = signorini_model_host_size entries a case
 * @param prescribed  values of the fixed degrees of freedom, in the order of fixed; NULL: zero
 * @param gap         gaps, one for each pair
 * @param law         SIGNORINI_LAW_..., the friction law of all pairs
 * @param friction    parameters of the law, pair by pair; may be NULL if frictionless
 * @param slip0       reference slip, dim - 1 for each pair; NULL: zero
 * @param settings    NULL: the defaults; a progress callback is called in each case in turn
 * @param d           out: relative displacements, N = dim * pairs entries a case; in: the starts
 *                    if settings->warm_start
 * @param F           out: contact forces, N entries a case
 * @param state       out: SIGNORINI_STATE_... of each pair; may be NULL
 * @param status      out: status of each case, as signorini_solve returns it, -k standing for the
 *                    k-th argument of this call; may be NULL
 * @param report      out: one for each case; set struct_size in each one before the call; may be
 *                    NULL
 * @param extra       the motion of escape, a second solution; may be NULL
 * @return 0: every case is solved; otherwise the status of the first case that is not, which
 *         signorini_last_error names; -k: the k-th argument is wrong
 */
int32_t signorini_model_solve(const signorini_model *model, int64_t cases, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0,
                              const signorini_settings *settings, double *d, double *F,
                              int32_t *state, int32_t *status, signorini_report *report,
                              const signorini_extra *extra);

/**
 * Displacements of the host from the relative ones. Every array has a column for each case, without
 * space between the columns. Of a sparse model many cases at once cost a fraction of what they cost
 * one by one.
 *
 * @param model       the model
 * @param cases       number of load cases, 0 allowed
 * @param f           nodal loads, H entries a case; NULL: zero, as for a motion of escape
 * @param prescribed  values of the fixed degrees of freedom; NULL: zero
 * @param d           relative displacements, N entries a case
 * @param u           out: displacements, H entries a case
 * @return 0; -k: the k-th argument is wrong, in the case that signorini_last_error names. Numbers
 *         so large that u overflows are found on the way: cases before may be written then
 */
int32_t signorini_model_recover(const signorini_model *model, int64_t cases, const double *f,
                                const double *prescribed, const double *d, double *u);

/**
 * Contact forces as a nodal force vector of the host. Sparse model: F on the slaves, the opposite
 * on the masters; general rows: F by the signed weights. Two bodies: F on both, each in its own
 * frame. Condensed model: F itself.
 *
 * @param model  the model
 * @param F      contact forces, N entries
 * @param nodal  out: nodal forces, H entries
 * @return 0; -k: the k-th argument is wrong
 */
int32_t signorini_model_nodal_forces(const signorini_model *model, const double *F, double *nodal);

/**
 * Relative loads of one load case: the f that signorini_solve takes beside the matrix of
 * signorini_model_stiffness. There are none if rows of pairs depend on each other.
 *
 * @param model       the model
 * @param f           nodal loads of the host, H entries
 * @param prescribed  values of the fixed degrees of freedom; NULL: zero
 * @param load        out: relative loads, N entries
 * @return 0; -k: the k-th argument is wrong
 */
int32_t signorini_model_condensed_load(const signorini_model *model, const double *f,
                                       const double *prescribed, double *load);

/**
 * Measures relative displacements of any origin, say of another solver, on a load case of a model.
 * This measure also decides whether a result of this library is called solved.
 *
 * @param model       the model
 * @param f           nodal loads of the host, H entries
 * @param prescribed  values of the fixed degrees of freedom, in the order of fixed; NULL: zero
 * @param gap         gaps, one for each pair
 * @param law         SIGNORINI_LAW_..., the friction law of all pairs
 * @param friction    parameters of the law, pair by pair; may be NULL if frictionless
 * @param slip0       reference slip, dim - 1 for each pair; NULL: zero
 * @param tolerance   largest eta of a solution, 1e-15 to 0.1
 * @param d           relative displacements to be measured, N
 * @param F           out: the contact forces that obey the contact law and are nearest to K d - f,
 *                    N; may be NULL. Where d does not determine the forces, in flexibility form and
 *                    where pairs depend on each other, in: the forces to be measured with d, which
 *                    stay as they are
 * @param state       out: SIGNORINI_STATE_... of each pair; may be NULL
 * @param report      out: the measures; set report->struct_size before the call; may be NULL
 * @return 0: a solution, report->eta <= tolerance; SIGNORINI_STATUS_NOT_A_SOLUTION: none; -k: the
 *         k-th argument is wrong, nothing was written
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

/**
 * The default: chooses a method, checks its result, and falls back to the next one if it fails.
 * Without friction: block pivoting, then Lemke's method. With friction: Newton's method, then the
 * path, in 2D then Lemke's method. At last: sweeps.
 */
#define SIGNORINI_METHOD_AUTO 0
/** Projected over-relaxed Gauss-Seidel (SOR) on a sequence of Tresca problems, g <- mu |F_n|. */
#define SIGNORINI_METHOD_SOR_NESTED 1
/** Sweeps that update the threshold after each pair; not for Tresca's law. */
#define SIGNORINI_METHOD_SOR_DIAGONAL 2
/**
 * Lemke's method, without friction, or with friction in 2D. It ends at a solution for every mu if
 * K is positive definite.
 */
#define SIGNORINI_METHOD_LEMKE 3
/** Block principal pivoting, for contact without friction. */
#define SIGNORINI_METHOD_BLOCK_PIVOTING 4
/**
 * Newton's method, on the states of the pairs (2D) or the normal map (3D). It may fail; the status
 * says so.
 */
#define SIGNORINI_METHOD_NEWTON 5
/**
 * A path of solutions that leads to one of the problem, with friction. If K is positive
 * definite it exists for every mu, load and gap. AUTO follows it where Newton's method fails.
 */
#define SIGNORINI_METHOD_PATH 6

/** Report only what the solution itself proves about other solutions. The default. */
#define SIGNORINI_SEARCH_OFF 0
/** Prove that the solution is unique, or look for a second one. It costs several solutions. */
#define SIGNORINI_SEARCH_OTHERS 1

typedef struct signorini_progress signorini_progress;

/** A progress callback receives it. Later versions may add fields at the end. */
struct signorini_progress {
    int64_t iterations; /**< Sweeps, pivots or linear systems done. */
    double eta;         /**< Latest measured eta; infinite before the first measurement. */
    double elapsed;     /**< Seconds since the call began. */
    /**
     * Share of the reduction of a sparse matrix that is done, 0 to 1; 1 while a load case is
     * solved.
     */
    double reduced;
    /**
     * Bytes that this reduction needs in all, told before they are taken; 0 before they are known
     * and while a load case is solved.
     */
    int64_t memory;
};

/**
 * A progress callback: called before each sweep, pivot or linear system, and by
 * signorini_model_new_sparse_within some hundred times a second. A nonzero result cancels
 * the call (SIGNORINI_STATUS_CANCELLED). It runs on the calling thread, in the default
 * floating-point environment. It must return: no longjmp, no exception; and it must not call this
 * library.
 */
typedef int32_t (*signorini_progress_fn)(void *user, const signorini_progress *progress);

/**
 * How to solve. Fill it by signorini_settings_default(), then change what you like. The library
 * only reads it, so that several threads may use one.
 */
struct signorini_settings {
    /** sizeof(signorini_settings) in your program; later fields: defaults. */
    uint32_t struct_size;
    int32_t method;                 /**< SIGNORINI_METHOD_...; default SIGNORINI_METHOD_AUTO. */
    double tolerance; /**< Solved means eta <= tolerance; 1e-15 to 0.1, default 1e-10. */
    double omega; /**< Over-relaxation factor, 0 to 2; default 0: chosen from the measured rate. */
    double damping; /**< Damping of the threshold update, to 1; default 0: chosen likewise. */
    /** Most sweeps, pivots or linear systems, at least 1; default 200000. */
    int64_t max_iterations;
    /**
     * Most seconds of wall time; 0 and infinity: no limit; default 0. A factorisation that would
     * take longer is not begun: the call may end before the limit.
     */
    double time_limit;
    /**
     * Nonzero: start from what d holds (Newton in 2D, block pivoting: from its states). Default 0:
     * start from d = 0 (Newton in 2D, block pivoting: from all pairs sticking). Lemke's method has
     * no start. SIGNORINI_START_PREVIOUS: from the solution of the case before.
     */
    int32_t warm_start;
    int32_t search;                 /**< SIGNORINI_SEARCH_...; default SIGNORINI_SEARCH_OFF. */
    signorini_progress_fn progress; /**< Progress callback; default NULL. */
    void *user;                     /**< Passed to progress as its first argument; default NULL. */
    /**
     * Nonzero: prove that the solution exists, and where: report.proof, extra.radius_d and
     * radius_F. It costs one to three solutions, without friction up to five. Default 0.
     */
    int32_t proof;
    int32_t reserved;               /**< 0. */
    /**
     * Most bytes that a solution or signorini_model_new_sparse_within may need; default 0: no
     * limit.
     */
    int64_t memory_limit;
    /**
     * Nonzero: signorini_model_new_sparse_within makes a full-space model, whatever memory_limit
     * says. Default 0: only if the condensed matrix needs more than memory_limit.
     */
    int32_t full_space;
    /**
     * Most threads of a call; default 1, and 0: 1. Threads end before the call does, and get no
     * signals. If the system refuses memory to a thread that begins, the process may end.
     * signorini_model_solve of several cases: each thread has a part of them in a row, and takes
     * the memory that signorini_model_memory tells; memory_limit is that of one. The same number
     * gives the same bits. A call with a callback or with SIGNORINI_START_PREVIOUS has one thread.
     * signorini_model_new_sparse_within, and signorini_model_solve on a model in full space: the
     * threads, of which 64 are the most, share each factorisation. Any number gives the same bits.
     * Each takes 8 bytes for each unknown and up to 1 MB more. All other calls have one thread.
     */
    int32_t threads;
};

/**
 * Fills settings with their defaults and sets struct_size.
 *
 * @param settings     not NULL
 * @param struct_size  sizeof(signorini_settings); no more than that is written
 * @return 0, or -1 or -2 for the argument that is wrong
 */
int32_t signorini_settings_default(signorini_settings *settings, uint32_t struct_size);

/**
 * Most bytes that a call may take beside your arrays, for so many unknowns: signorini_solve with N
 * = dim * pairs, and signorini_lcp_solve. A load case of a model: signorini_model_view. A call
 * takes them for every method, law and setting, and holds as much address space in reserve;
 * settings.memory_limit refuses a call that may need more. Each thread keeps some MiB of its own
 * for matrix products, which are not counted.
 *
 * @param n  number of unknowns
 * @return bytes; -1 if n is negative
 */
int64_t signorini_solve_memory(int64_t n);

/* ---- How good the result is ---------------------------------------------------------------- */

#define SIGNORINI_UNIQUENESS_NOT_KNOWN 0 /**< It is not known whether there are other solutions. */
#define SIGNORINI_UNIQUENESS_UNIQUE 1    /**< Proved: there is no other solution. */
#define SIGNORINI_UNIQUENESS_SEVERAL 2   /**< Proved: there are other solutions. */

/* Is a solution proved to exist? */
#define SIGNORINI_PROOF_NOT_ASKED 0 /**< settings.proof is 0. */
/**
 * Proved: the data, each double taken for the real number that it is, have a solution with these
 * states. Of a model the data are those of its condensed problem, in doubles as the library has
 * made them.
 */
#define SIGNORINI_PROOF_PROVED 1
/**
 * Not proved, which says nothing about whether there is a solution: a pair is at the boundary of
 * two states, or rounding is too large beside the condition of K.
 */
#define SIGNORINI_PROOF_NOT_PROVED 2

/* Why the first method was abandoned. */
#define SIGNORINI_FALLBACK_NONE 0       /**< The first method succeeded. */
#define SIGNORINI_FALLBACK_CYCLE 1      /**< The states of the first method repeated in a cycle. */
#define SIGNORINI_FALLBACK_SINGULAR 2   /**< The first method met a singular system. */
/** The first method found an unstable solution (orientation -1). */
#define SIGNORINI_FALLBACK_UNSTABLE 3
#define SIGNORINI_FALLBACK_INACCURATE 4 /**< The first method found no accurate solution. */

/* Remarks: what is legal and often a mistake. */
/** Every finite gap is negative: interference everywhere, or the sign of gaps is turned round. */
#define SIGNORINI_REMARK_GAPS_NEGATIVE 1
/** A coefficient of friction is above 10: percent, or another array. */
#define SIGNORINI_REMARK_FRICTION_LARGE 2
/**
 * Without friction: the bodies may move without any force, so that d is one of many; a support may
 * be missing. Not looked for in full space, nor where pairs depend on each other.
 */
#define SIGNORINI_REMARK_FREE_MOTION 4

/**
 * A short description of one remark, such as "every gap is negative". Static text; never NULL, for
 * any number.
 */
const char *signorini_remark_string(int32_t remark);

/**
 * How good a result is, and how it was found. Fill it by signorini_report_default() or set
 * struct_size before the call; the call writes all other fields. Forces and lengths are in the
 * units of the problem. K d - f is the contact force that d requires.
 */
struct signorini_report {
    uint32_t struct_size;     /**< sizeof(signorini_report) in your program; no more is written. */
    int32_t status;           /**< The status of the result, as the call returns it. */
    int32_t method; /**< The method that found the result, SIGNORINI_METHOD_...; certify: 0. */
    int32_t uniqueness;       /**< SIGNORINI_UNIQUENESS_... */
    int64_t iterations;       /**< Sweeps, pivots or linear systems, of all methods tried. */
    /**
     * Threshold updates of the nested method. Where no condensed matrix is formed: solutions with a
     * factor.
     */
    int64_t outer_iterations;
    int64_t refactorisations; /**< How often Lemke's tableau was refactorised to regain accuracy. */
    /**
     * Residual of the contact law relative to the forces, no unit, before d is rounded to doubles;
     * 0 at exact solutions only.
     */
    double eta;
    /**
     * Rounding of d to doubles may add so much to eta, no unit. Above 1e-6 only a d is certified
     * that K resists by more energy than rounding of its entries explains.
     */
    double rounding;
    double penetration;       /**< Largest d_n - gap; length; 0 if none. */
    /** Largest normal part of K d - f beyond the tension of the law, 0 but for cohesion; force. */
    double tension;
    /** Largest excess of the tangential part of K d - f over its bound; force; 0 if none. */
    double cone_excess;
    double equilibrium;       /**< Largest component of K d - f - F; force. */
    double omega;             /**< Over-relaxation factor at the end; 0 if the method has none. */
    double damping;           /**< Damping at the end; 0 if the method has none. */
    int64_t pairs_open;       /**< Pairs of SIGNORINI_STATE_OPEN. */
    int64_t pairs_slipping;   /**< Pairs of SIGNORINI_STATE_SLIP. */
    int64_t pairs_sticking;   /**< Pairs of SIGNORINI_STATE_STICK. */
    /** Dense factorisations by Newton's method and block pivoting. In full space: sparse ones. */
    int64_t factorisations;
    int32_t first_method;     /**< The method that was tried first, SIGNORINI_METHOD_... */
    int32_t fallback;         /**< Why the first method was abandoned, SIGNORINI_FALLBACK_... */
    /**
     * Sign of the determinant of the system of equations that the states select. -1: the solution
     * is unstable; if K is positive definite, at least two others exist. 0: not known.
     */
    int32_t orientation;
    int32_t second;           /**< 1: a second solution was found, see extra; else 0. */
    /**
     * Largest error of a component of d over the largest component of d, no unit. With
     * SIGNORINI_PROOF_PROVED a proved bound. Otherwise what the contraction of the last refinement
     * tells; -1: not known, there was none.
     */
    double error_d;
    /**
     * Largest error of a component of F over the largest component of F and f, no unit; in the
     * same way.
     */
    double error_F;
    int32_t proof;            /**< SIGNORINI_PROOF_... */
    /** Sum of SIGNORINI_REMARK_...: data that are legal and often a mistake; 0: none. */
    int32_t remarks;
};

/**
 * Fills report with zeros and sets struct_size: a report of no call.
 *
 * @param report       not NULL
 * @param struct_size  sizeof(signorini_report); no more than that is written
 * @return 0, or -1 or -2 for the argument that is wrong
 */
int32_t signorini_report_default(signorini_report *report, uint32_t struct_size);

/* ---- More results -------------------------------------------------------------------------- */

/**
 * Results that not every call wants. Fill it by signorini_extra_default(), then set the pointers
 * of the arrays that you want. Each pointer may be NULL. In signorini_model_solve each array has a
 * column for each case.
 */
struct signorini_extra {
    uint32_t struct_size; /**< sizeof(signorini_extra). */
    int32_t reserved;     /**< 0. */
    /**
     * Out: N entries. With SIGNORINI_STATUS_NO_EQUILIBRIUM a motion r that proves the status:
     * K r = 0, and f . r + F . r > 0 for all contact forces F that the law admits. Its largest
     * component is 1. With every other status zeros. With friction it lifts each slipping pair by
     * mu times its slip, as nothing moves: draw escape. In signorini_flexibility_solve the proof
     * is pressing normal forces p: W p = 0, and the sum of p_n (gap - q_n) is positive, p_n < 0
     * where it counts; the largest is -1.
     */
    double *motion;
    /**
     * Out: N entries. If report.second is 1, the relative displacements of a second solution,
     * certified as the first is; otherwise zeros.
     */
    double *second_d;
    /** Out: N entries. Contact forces of the second solution; otherwise zeros. */
    double *second_F;
    /** Out: one for each pair. SIGNORINI_STATE_... of the second solution; otherwise zeros. */
    int32_t *second_state;
    /**
     * Out: N entries. If report.proof is SIGNORINI_PROOF_PROVED: the solution has displacements
     * within this distance of d, component by component; length. Otherwise -1.
     */
    double *radius_d;
    double *radius_F;     /**< Out: N entries. The same of the contact forces and F; force. */
    /**
     * Out: N entries. With SIGNORINI_STATUS_NO_EQUILIBRIUM the motion of escape, which you can
     * draw: K r = 0, no pair approaches its obstacle, pairs that contact presses stay on it,
     * friction opposes the slip, and f . r > 0. It is the motion against a viscosity in each
     * component of the size of its diagonal entry of K, every pair of finite gap touching. Its
     * largest component is 1. With every other status zeros.
     */
    double *escape;
};

/**
 * Fills extra with NULL pointers, so that no array is wanted, and sets struct_size.
 *
 * @param extra        not NULL
 * @param struct_size  sizeof(signorini_extra); no more than that is written
 * @return 0, or -1 or -2 for the argument that is wrong
 */
int32_t signorini_extra_default(signorini_extra *extra, uint32_t struct_size);

/* ---- Linear complementarity problems ------------------------------------------------------- */

/**
 * Solves a linear complementarity problem (LCP): w = q + M z, w >= 0, z >= 0, w . z = 0.
 *
 * SIGNORINI_METHOD_AUTO is block principal pivoting, then Lemke's method (lexicographic: it never
 * cycles). M positive definite or a P-matrix: the problem is solved. M positive semi-definite or
 * copositive-plus: it is solved, or proved infeasible (SIGNORINI_STATUS_NO_EQUILIBRIUM). Any other
 * M: the call may also end in a ray that proves nothing (SIGNORINI_STATUS_STALLED).
 *
 * @param n         number of unknowns, 0 allowed
 * @param M         any matrix, n columns of n entries, column-major
 * @param ldm       entries from one column of M to the next, at least max(1, n)
 * @param q         n
 * @param cover     covering vector of Lemke's method, n positive entries; NULL: ones
 * @param settings  NULL: the defaults; method is SIGNORINI_METHOD_AUTO, _BLOCK_PIVOTING or _LEMKE;
 *                  omega, damping, warm_start and search are checked and have no effect
 * @param w         out: n
 * @param z         out: n
 * @param y         out: n; with SIGNORINI_STATUS_NO_EQUILIBRIUM the proof that no w, z >= 0 satisfy
 *                  w = q + M z: y >= 0, M' y <= 0, q . y < 0; with every other status zeros; may be
 *                  NULL
 * @param report    out: set report->struct_size before the call; may be NULL
 * @return as signorini_solve
 */
int32_t signorini_lcp_solve(int64_t n, const double *M, int64_t ldm, const double *q,
                            const double *cover, const signorini_settings *settings, double *w,
                            double *z, double *y, signorini_report *report);

/* ---- Versions ------------------------------------------------------------------------------ */

#define SIGNORINI_VERSION_MAJOR 0 /**< Major version of this header. */
#define SIGNORINI_VERSION_MINOR 2 /**< Minor version of this header. */
#define SIGNORINI_VERSION_PATCH 0 /**< Patch version of this header. */
/** Binary interface of this header; compare it with signorini_abi_version() after dlopen. */
#define SIGNORINI_ABI_VERSION 3

/** Version of the library, such as "0.2.0". Static text; never NULL. */
const char *signorini_version(void);

/**
 * Binary interface of the library. If it differs from the SIGNORINI_ABI_VERSION with which a
 * program was compiled, the two are incompatible.
 */
int32_t signorini_abi_version(void);

/* ============================================================================================
 * 5  What may still change
 *
 * Define SIGNORINI_UNSTABLE before you include this header, and link a library of the same version.
 * ========================================================================================== */

#ifdef SIGNORINI_UNSTABLE

/**
 * settings.warm_start of signorini_model_solve: each case starts from the solution of the last case
 * before that was solved, in this call and in those before it on the model with this setting; the
 * first one as with 0; d needs no start. With friction in 3D the cases share the elimination of
 * pairs that stay open, so that load steps, too, cost less one by one: the model keeps 8 N N bytes
 * at most, until it is released or a call of signorini_model_solve has another start. The last
 * digits of a result depend on these calls, and where there are several solutions which one it is:
 * the same calls in the same order give the same bits. Leave it to one thread of those that share a
 * model. Other calls have one case.
 */
#define SIGNORINI_START_PREVIOUS 2

typedef struct signorini_operator signorini_operator;

/**
 * A product of the host, y = K_rel x or y = W x: x and y have N = dim * pairs entries. Returns 0;
 * another number ends the call of the library, whose sentence tells it. It must return: no longjmp,
 * no exception; and it must not call this library.
 */
typedef int32_t (*signorini_product_fn)(void *user, const double *x, double *y);

/**
 * A solution of the host with components held: y is 0 where held is nonzero, and K_rel y = x in
 * the other components; x does not count where held is nonzero. All have N entries. changed is 0
 * if the same components are held as in the call before on this model, and that call has not
 * failed, so that a factor may serve again. Returns as signorini_product_fn.
 */
typedef int32_t (*signorini_held_fn)(void *user, const int32_t *held, int32_t changed,
                                     const double *x, double *y);

/**
 * Functions of a host in the place of a matrix: say of a code on several processes, with a factor
 * of its own. d and F are those of the pairs, as for signorini_solve, and K_rel is the K there.
 */
struct signorini_operator {
    uint32_t struct_size; /**< sizeof(signorini_operator). */
    int32_t dim;          /**< Space dimension, 2 or 3. */
    int64_t pairs;        /**< Number of contact pairs. */
    /** y = K_rel x; symmetric, positive semi-definite; as exact as the tolerance asks for. */
    signorini_product_fn stiffness;
    /**
     * y = W x, with W close to the inverse of K_rel, symmetric and positive definite: a solution
     * with the contact free. May be NULL if held is given, which is then used alone.
     */
    signorini_product_fn inverse;
    /** A solution with components held, in the place of W. May be NULL if inverse is given. */
    signorini_held_fn held;
    /**
     * Units of force per length of the components, N positive numbers of the size of the diagonal
     * of K_rel. NULL: one for each direction, from products.
     */
    const double *units;
    void *user;           /**< Passed to the functions as their first argument. */
};

/**
 * Makes a model of which you give products and solutions alone, for structures that no one process
 * holds: no matrix is formed. Loads and displacements of the host are the relative ones, H = N
 * entries. Load cases are solved by Newton's method with GMRES, methods AUTO and NEWTON alone, no
 * search, no proof. It takes 20 to 110 products with K_rel and as many with W in 2D, to 160 in 3D;
 * with held 5 to 70 solutions take the place of those with W, between which the components that are
 * held change up to 14 times.
 *
 * Before it returns it asks for some products, of which the answers must be finite, linear,
 * symmetric, positive and the same each time, to 1e-9. Later calls on the model return -1 if a
 * function fails or gives a number that is not finite; the sentence says which one and where, and
 * the model can be used again. Calls from several threads on one model are yours to allow: its
 * functions are called on the threads that call the library.
 *
 * @param K      the functions; the structure is copied, with units
 * @param model  out: the model; NULL unless 0 is returned
 * @return 0; -k: the k-th argument is wrong; <= -1000: out of memory or a defect
 */
int32_t signorini_model_new_operator(const signorini_operator *K, signorini_model **model);

/**
 * Tries to prove that a load case of a model has a solution next to displacements of any origin,
 * say of another solver, and bounds how far it is away.
 *
 * The proof is about the condensed problem: its K, f, gap, friction and slip0, each double taken
 * for the real number that it is, have a solution with these states, each pair clear of the
 * boundaries of its state. All rounding is bounded. It is not proved that there is no other
 * solution.
 *
 * @param model       a model with a condensed matrix
 * @param f           nodal loads of the host, H entries
 * @param prescribed  values of the fixed degrees of freedom; NULL: zero
 * @param gap         gaps, one for each pair
 * @param law         SIGNORINI_LAW_..., the friction law of all pairs
 * @param friction    parameters of the law, pair by pair; may be NULL if frictionless
 * @param slip0       reference slip, dim - 1 for each pair; NULL: zero
 * @param d           relative displacements, N
 * @param state       SIGNORINI_STATE_... of each pair; NULL: those of d
 * @param F           out: contact forces of the solution, N; may be NULL
 * @param radius_d    out: the solution has displacements within this distance of d, component by
 *                    component, N; length; may be NULL
 * @param radius_F    out: the same of the contact forces and F, N; force; may be NULL
 * @return 0: proved; SIGNORINI_STATUS_NOT_PROVED: not, which proves nothing: F holds zeros, the
 *         radii -1; -k: the k-th argument is wrong, nothing was written
 */
int32_t signorini_model_prove(const signorini_model *model, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0, const double *d,
                              const int32_t *state, double *F, double *radius_d, double *radius_F);

#endif /* SIGNORINI_UNSTABLE */

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SIGNORINI_H */
