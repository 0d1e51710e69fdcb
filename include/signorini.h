/*
 * signorini: unilateral contact with Coulomb friction for existing finite-element codes.
 *
 * The problem. For n pairs in dimension D (2 or 3), each with one normal and D - 1 tangential
 * components of a relative displacement d, ordered pair by pair (n, t) or (n, t1, t2):
 *
 *     K d = f + F                                               equilibrium
 *     d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0               unilateral contact
 *     |F_t| <= mu |F_n|,  d_t = slip            inside the cone Coulomb friction
 *                         d_t - slip = -lambda F_t on it, lambda >= 0
 *
 * K is the stiffness matrix condensed on the contact components: symmetric, positive definite or
 * only semi-definite (bodies held by nothing but contact).
 *
 * Ways in. signorini_solve, signorini_tresca and signorini_lcp_solve take plain arrays and do all in
 * one call. A signorini_model reduces what you have once, a condensed matrix, two of them, or your
 * whole sparse matrix with contact pairs, then solves load cases and recovers displacements.
 * signorini_certify measures displacements that you have from elsewhere.
 *
 * Signs. n is the outward normal of the body: d_n > 0 moves towards the obstacle, F_n < 0 presses.
 * F is the force that the contact exerts on the body. f and F are nodal forces, not stresses.
 * Example: above a plane, with n = (0, -1) and t = (1, 0), d_n = -u_y and d_t = u_x; loads turn
 * likewise, and of the stiffness the mixed entries K_nt change their sign.
 * Units are yours: any consistent set, and no result depends on it but for its unit.
 *
 * In a condensed matrix, a component that you hold fixed stays as a decoupled row: zero off the
 * diagonal, positive on it, zero load.
 *
 * Arrays are plain, 64-bit floating point, matrices column-major with a leading dimension. NULL is
 * allowed where a parameter says so. What is written to overlaps nothing else. With n = 0 no array
 * is looked at.
 *
 * Status. Every call that computes returns an int32_t:
 *     0          solved, and certified on your data: report.eta <= settings.tolerance
 *     > 0        results were written but are not a solution; SIGNORINI_... says which
 *     -k         the k-th argument is wrong; nothing was written
 *     <= -1000   out of memory, a file that cannot be read or written, a caught defect
 * signorini_last_error() tells in a sentence what and where; entries count from 0: K[row,column].
 *
 * Files. signorini_problem_save, signorini_model_save_case and the like write a problem to a file
 * that can be mailed; signorini_problem_load gets it back with the same bits.
 *
 * The library never prints, exits, reads the environment, installs handlers or starts threads, and
 * it touches no file but the one that such a call names. It keeps your floating-point environment:
 * traps and flush-to-zero are off inside and back on return. Calls from several threads at once are
 * safe. The same input gives the same bits on the same machine.
 */


#ifndef SIGNORINI_H
#define SIGNORINI_H

#include <stdint.h>

/**
 * Solved and certified: eta <= tolerance.
 */
#define SIGNORINI_SOLVED 0

/**
 * max_iterations used up; the results are the best iterate so far.
 */
#define SIGNORINI_ITERATION_LIMIT 1

/**
 * time_limit used up; the results are the best iterate so far.
 */
#define SIGNORINI_TIME_LIMIT 2

/**
 * The progress callback returned nonzero; the results are the best iterate so far.
 */
#define SIGNORINI_CANCELLED 3

/**
 * Proved: no equilibrium exists. d is the motion of escape (largest component 1), the forces are
 * zero. For a bare complementarity problem: no w, z >= 0 satisfy w = q + M z, and z proves it.
 */
#define SIGNORINI_NO_EQUILIBRIUM 4

/**
 * The method cannot go on (rounding, a cycle, a ray that proves nothing); the results are its best
 * iterate. Of SIGNORINI_METHOD_AUTO: no method found a solution or a proof that there is none.
 */
#define SIGNORINI_STALLED 5

/**
 * Of signorini_certify: the displacements are not a solution.
 */
#define SIGNORINI_NOT_A_SOLUTION 6

/**
 * A defect of the library was caught; the results are undefined.
 */
#define SIGNORINI_INTERNAL -1000

/**
 * Not enough memory; nothing was written.
 */
#define SIGNORINI_OUT_OF_MEMORY -1001

/**
 * A file cannot be read or written; signorini_last_error() names it, the line, and what is wrong.
 */
#define SIGNORINI_FILE -1002

/**
 * Major version of this header.
 */
#define SIGNORINI_VERSION_MAJOR 0

/**
 * Minor version of this header.
 */
#define SIGNORINI_VERSION_MINOR 1

/**
 * Patch version of this header.
 */
#define SIGNORINI_VERSION_PATCH 0

/**
 * Version of the binary interface that this header describes; compare it with
 * signorini_abi_version() after dlopen.
 */
#define SIGNORINI_ABI_VERSION 1

/**
 * The default: chooses, checks and falls back. Without friction block pivoting, with friction in 2D
 * Newton's method; where these fail Lemke's; in the end, and with friction in 3D, sweeps.
 */
#define SIGNORINI_METHOD_AUTO 0

/**
 * Coulomb friction as a sequence of Tresca problems, g <- mu |F_n|, each by projected
 * over-relaxed Gauss-Seidel.
 */
#define SIGNORINI_METHOD_SOR_NESTED 1

/**
 * Projected over-relaxed Gauss-Seidel with the friction threshold updated inside the sweep.
 */
#define SIGNORINI_METHOD_SOR_DIAGONAL 2

/**
 * Lemke's method, for frictionless contact and for friction in 2D. It ends at a solution for every
 * mu if K is positive definite.
 */
#define SIGNORINI_METHOD_LEMKE 3

/**
 * Block principal pivoting, for frictionless contact: every mu must be 0.
 */
#define SIGNORINI_METHOD_PIVOT 4

/**
 * Newton's method on the states of the pairs, in 2D. It may fail, and says so.
 */
#define SIGNORINI_METHOD_NEWTON 5

/**
 * Of other solutions tell what the solution itself shows. The default.
 */
#define SIGNORINI_SEARCH_OFF 0

/**
 * Prove that the solution is the only one, or look for a second; 2D. It costs several times the
 * solution.
 */
#define SIGNORINI_SEARCH_OTHERS 1

/**
 * The same, and return the second solution in the place of the first if there is one.
 */
#define SIGNORINI_SEARCH_RETURN_SECOND 2

/**
 * A pair is apart: no normal force, and no tangential one but that of signorini_tresca.
 */
#define SIGNORINI_OPEN 0

/**
 * A pair touches and |F_t| = mu |F_n|: it slides. Every frictionless contact, at rest or not, is of
 * this state.
 */
#define SIGNORINI_SLIP 1

/**
 * A pair sticks: d_t = slip.
 */
#define SIGNORINI_STICK 2

/**
 * Whether there are other solutions is not known.
 */
#define SIGNORINI_NOT_KNOWN 0

/**
 * Proved: the solution is the only one.
 */
#define SIGNORINI_UNIQUE 1

/**
 * Proved: there are other solutions.
 */
#define SIGNORINI_SEVERAL 2

/**
 * The method that was tried first ended it.
 */
#define SIGNORINI_FALLBACK_NONE 0

/**
 * The first method's states repeated in a cycle.
 */
#define SIGNORINI_FALLBACK_CYCLE 1

/**
 * The first method met a singular system.
 */
#define SIGNORINI_FALLBACK_SINGULAR 2

/**
 * The first method found a solution of orientation -1, beside which there are others if K is
 * positive definite.
 */
#define SIGNORINI_FALLBACK_UNSTABLE 3

/**
 * The first method found no accurate solution.
 */
#define SIGNORINI_FALLBACK_INACCURATE 4

/**
 * Entries with row >= column are stored, by columns (or row <= column, by rows).
 */
#define SIGNORINI_LOWER 0

/**
 * Entries with row <= column are stored, by columns (or row >= column, by rows).
 */
#define SIGNORINI_UPPER 1

/**
 * All entries are stored, by columns or by rows.
 */
#define SIGNORINI_FULL 2

/**
 * A problem of signorini_problem_load is one of signorini_solve.
 */
#define SIGNORINI_PROBLEM_COULOMB 0

/**
 * A problem of signorini_problem_load is one of signorini_tresca.
 */
#define SIGNORINI_PROBLEM_TRESCA 1

/**
 * A problem of signorini_problem_load is one of signorini_lcp_solve.
 */
#define SIGNORINI_PROBLEM_LCP 2

/**
 * A structure, reduced to its contact pairs: what every load case shares. Made by
 * signorini_model_new_..., released by signorini_model_free. It does not change, and every function
 * that takes it const may be called from several threads at once.
 */
typedef struct signorini_model signorini_model;

/**
 * A problem that was read from a file, by signorini_problem_load; released by
 * signorini_problem_free. It does not change, and several threads may use it at once.
 */
typedef struct signorini_problem signorini_problem;

/**
 * What a progress callback is told. New fields may follow in later versions.
 */
typedef struct signorini_progress {
  /**
   * Sweeps, pivots or linear systems done.
   */
  int64_t iterations;
  /**
   * Latest measured eta; infinite before the first measurement.
   */
  double eta;
  /**
   * Seconds since the call began.
   */
  double elapsed;
} signorini_progress;

/**
 * Called before each sweep, pivot or linear system; a nonzero result cancels the call
 * (SIGNORINI_CANCELLED). It runs on the calling thread in the default floating-point environment. It must return: no
 * longjmp, no exception, and no call of this library.
 */
typedef int32_t (*signorini_progress_fn)(void *user, const struct signorini_progress *progress);

/**
 * How to solve. Fill it by signorini_settings_default(), then change what you like.
 */
typedef struct signorini_settings {
  /**
   * sizeof(signorini_settings) of the program; later fields than it covers have their defaults.
   */
  uint32_t struct_size;
  /**
   * SIGNORINI_METHOD_...; default SIGNORINI_METHOD_AUTO.
   */
  int32_t method;
  /**
   * Solved means eta <= tolerance; 1e-15 to 0.1, default 1e-10.
   */
  double tolerance;
  /**
   * Over-relaxation factor between 0 and 2; default 0: chosen from the measured rate.
   */
  double omega;
  /**
   * Damping of the nested method's threshold update, in (0, 1]; default 0: chosen from the
   * measured rate.
   */
  double damping;
  /**
   * Most sweeps (SOR), pivots (Lemke) or linear systems (Newton, block pivoting), at least 1;
   * default 200000.
   */
  int64_t max_iterations;
  /**
   * Most seconds of wall time; 0, the default, and infinity: no limit.
   */
  double time_limit;
  /**
   * Nonzero: the method starts from what d holds, Newton's and block pivoting from the states that
   * it has. Default 0: sweeps start from zero, these two from all pairs in contact and at rest.
   * Lemke's method does not use a start.
   */
  int32_t warm_start;
  /**
   * SIGNORINI_SEARCH_...: what to find out about other solutions; default SIGNORINI_SEARCH_OFF.
   */
  int32_t search;
  /**
   * Called before each sweep, pivot or linear system; default NULL.
   */
  signorini_progress_fn progress;
  /**
   * Handed to progress; default NULL.
   */
  void *user;
} signorini_settings;

/**
 * How good a result is. Before the call: report.struct_size = sizeof report; all else is written by
 * it. Forces and lengths are in the units of the problem.
 */
typedef struct signorini_report {
  /**
   * sizeof(signorini_report) of the program: no more than that is written.
   */
  uint32_t struct_size;
  /**
   * What the call returned.
   */
  int32_t status;
  /**
   * The method that ended it, SIGNORINI_METHOD_...; of signorini_certify 0.
   */
  int32_t method;
  /**
   * SIGNORINI_NOT_KNOWN, _UNIQUE or _SEVERAL.
   */
  int32_t uniqueness;
  /**
   * Sweeps, pivots or linear systems, of all methods that were tried.
   */
  int64_t iterations;
  /**
   * Threshold updates of the nested method.
   */
  int64_t outer_iterations;
  /**
   * How often Lemke's tableau was computed anew because accuracy was lost.
   */
  int64_t refactorisations;
  /**
   * Residual of the natural map relative to the forces, without unit; 0 at exact solutions
   * only.
   */
  double eta;
  /**
   * Rounding of K d relative to the forces, without unit; beyond 1e-6 nothing is certified.
   */
  double rounding;
  /**
   * Largest d_n - gap, a length; 0 if none.
   */
  double penetration;
  /**
   * Largest tensile (positive) normal component of K d - f, a force; 0 if none.
   */
  double tension;
  /**
   * Largest excess of the tangential part of K d - f over its bound, a force; 0 if none.
   */
  double cone_excess;
  /**
   * Largest component of K d - f - F, a force.
   */
  double equilibrium;
  /**
   * Over-relaxation factor at the end; 0 if there is none.
   */
  double omega;
  /**
   * Damping at the end; 0 if there is none.
   */
  double damping;
  /**
   * Pairs that are open.
   */
  int64_t open;
  /**
   * Pairs that slide.
   */
  int64_t slip;
  /**
   * Pairs that stick.
   */
  int64_t stick;
  /**
   * Dense factorisations of Newton's method and of block pivoting.
   */
  int64_t factorisations;
  /**
   * The method that was tried first, SIGNORINI_METHOD_...
   */
  int32_t first_method;
  /**
   * Why it did not end it, SIGNORINI_FALLBACK_...
   */
  int32_t fallback;
  /**
   * Sign of the determinant of the system of equations that the states select: +1, or -1 for
   * an unstable solution, beside which there are at least two others if K is positive definite;
   * 0 if not known.
   */
  int32_t orientation;
  /**
   * 0.
   */
  int32_t reserved;
} signorini_report;

/**
 * A sparse symmetric stiffness matrix, by columns or by rows, which is the same.
 */
typedef struct signorini_sparse {
  /**
   * sizeof(signorini_sparse).
   */
  uint32_t struct_size;
  /**
   * 4 if starts and rows are arrays of int32_t, 8 if of int64_t. Other numbers are int64_t always.
   */
  int32_t index_bytes;
  /**
   * 0 or 1: what the first row, and the first entry of starts, are called. Degrees of freedom in
   * other arguments of the same call are counted from it too.
   */
  int32_t base;
  /**
   * SIGNORINI_LOWER, SIGNORINI_UPPER or SIGNORINI_FULL.
   */
  int32_t triangle;
  /**
   * Number of rows and columns.
   */
  int64_t size;
  /**
   * Number of entries.
   */
  int64_t entries;
  /**
   * Begin of each column in rows and values, and where the last one ends: size + 1.
   */
  const void *starts;
  /**
   * Row of each entry, ascending in each column.
   */
  const void *rows;
  /**
   * Entries; force / length.
   */
  const double *values;
} signorini_sparse;

/**
 * Contact pairs: a slave node, the point that faces it, and a normal. The slave's displacement is
 * u_slave = sum of weight * u_master + d_n n + d_t t (+ ...), so that the gap closes at d_n = gap.
 * A node is a slave in one pair at the most, and no master is a slave. A slave may be fixed along an
 * axis only where its masters are fixed too and the axis is its normal or a tangent: along it the
 * pair is held, d and F are zero.
 */
typedef struct signorini_pairs {
  /**
   * sizeof(signorini_pairs).
   */
  uint32_t struct_size;
  /**
   * Space dimension, 2 or 3.
   */
  int32_t dim;
  /**
   * Number of pairs.
   */
  int64_t pairs;
  /**
   * Degrees of freedom of each slave node, dim for each pair, in the order of the axes.
   */
  const int64_t *slaves;
  /**
   * Begin of each pair's masters in masters and weights, and where the last ones end:
   * pairs + 1, counted from base. No masters: a rigid obstacle. NULL: no masters at all.
   */
  const int64_t *master_starts;
  /**
   * Degrees of freedom of each master node, dim for each; NULL if there are none.
   */
  const int64_t *masters;
  /**
   * Weight of each master node; those of a pair sum to 1; NULL if there are none.
   */
  const double *weights;
  /**
   * Normal of each pair, dim entries, outward from the slave's body, of any length.
   */
  const double *normals;
  /**
   * First tangent of each pair, dim entries; NULL: chosen, in 2D the normal turned by +90 degrees.
   */
  const double *tangents;
} signorini_pairs;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the library, such as "0.1.0". Static; never NULL.
 */
const char *signorini_version(void);

/**
 * Version of the binary interface of the library. It equals SIGNORINI_ABI_VERSION of the header
 * that a program was compiled with, or the two do not fit.
 */
int32_t signorini_abi_version(void);

/**
 * A short description of a status, such as "solved". Static; never NULL, whatever the number.
 */
const char *signorini_status_string(int32_t status);

/**
 * What the last call on this thread found, in one sentence, such as "K[12,7] is not finite":
 * for every status other than 0; empty after a call that returned 0.
 *
 * @return UTF-8 text of at most 511 bytes that belongs to the library and to the calling thread;
 *         the next call of the library on this thread overwrites it. Never NULL.
 */
const char *signorini_last_error(void);

/**
 * Fills settings with their defaults and sets struct_size.
 *
 * @param settings     not NULL
 * @param struct_size  sizeof(signorini_settings); no more than that is written
 * @return 0, or -1 or -2 for the argument that is wrong
 */
int32_t signorini_settings_default(struct signorini_settings *settings, uint32_t struct_size);

/**
 * Solves a condensed contact problem with Coulomb friction.
 *
 * N = dim * pairs. Arrays must not overlap.
 *
 * @param dim       space dimension, 2 or 3
 * @param pairs     number of contact pairs, 0 allowed
 * @param K         condensed stiffness, N columns of N entries, column-major, both triangles,
 *                  symmetric, positive semi-definite, positive diagonal; force / length
 * @param ldk       entries from one column of K to the next, at least max(1, N)
 * @param f         condensed nodal loads, N; force
 * @param gap       initial gaps, one for each pair; length; negative: interference, +infinity:
 *                  never touches
 * @param mu        friction coefficients, one for each pair, at least 0
 * @param slip      tangential displacement at which friction is at rest, dim - 1 for each pair;
 *                  length; NULL: zero (total law). The last converged d_t gives the incremental
 *                  law.
 * @param settings  NULL: the defaults
 * @param d         out: relative displacements, N; in: the start if settings->warm_start
 * @param F         out: contact forces, N; they obey the law, and K d = f + F up to
 *                  report->equilibrium
 * @param state     out: SIGNORINI_OPEN, _SLIP or _STICK, one for each pair; NULL: not wanted
 * @param report    out; set report->struct_size before the call; NULL: not wanted
 * @return 0 solved and certified; > 0 results were written but are not a solution; -k the k-th
 *         argument is wrong, nothing was written; <= -1000 internal. signorini_last_error()
 *         tells in words.
 */
int32_t signorini_solve(int32_t dim,
                        int64_t pairs,
                        const double *K,
                        int64_t ldk,
                        const double *f,
                        const double *gap,
                        const double *mu,
                        const double *slip,
                        const struct signorini_settings *settings,
                        double *d,
                        double *F,
                        int32_t *state,
                        struct signorini_report *report);

/**
 * Solves a condensed contact problem with given friction thresholds (Tresca): |F_t| <= g, open or
 * closed.
 *
 * The arguments are those of signorini_solve, with g in the place of mu. The method
 * SIGNORINI_METHOD_SOR_DIAGONAL is not for given thresholds.
 *
 * @param dim       space dimension, 2 or 3
 * @param pairs     number of contact pairs, 0 allowed
 * @param K         condensed stiffness, N columns of N entries; force / length
 * @param ldk       entries from one column of K to the next, at least max(1, N)
 * @param f         condensed nodal loads, N; force
 * @param gap       initial gaps, one for each pair; length
 * @param g         friction thresholds, one for each pair, at least 0; force
 * @param slip      tangential displacement at rest, dim - 1 for each pair; length; NULL: zero
 * @param settings  NULL: the defaults
 * @param d         out: relative displacements, N; in: the start if settings->warm_start
 * @param F         out: contact forces, N
 * @param state     out: state of each pair; NULL: not wanted
 * @param report    out; set report->struct_size before the call; NULL: not wanted
 * @return as signorini_solve
 */
int32_t signorini_tresca(int32_t dim,
                         int64_t pairs,
                         const double *K,
                         int64_t ldk,
                         const double *f,
                         const double *gap,
                         const double *g,
                         const double *slip,
                         const struct signorini_settings *settings,
                         double *d,
                         double *F,
                         int32_t *state,
                         struct signorini_report *report);

/**
 * Measures displacements of any origin, say of another solver, on the data of a condensed contact
 * problem with Coulomb friction: what decides whether this library calls a result solved.
 *
 * @param dim       space dimension, 2 or 3
 * @param pairs     number of contact pairs, 0 allowed
 * @param K         condensed stiffness, as for signorini_solve
 * @param ldk       entries from one column of K to the next, at least max(1, N)
 * @param f         condensed nodal loads, N
 * @param gap       initial gaps, one for each pair
 * @param mu        friction coefficients, one for each pair
 * @param slip      tangential displacement at rest, dim - 1 for each pair; NULL: zero
 * @param tolerance largest eta of a solution, 1e-15 to 0.1
 * @param d         relative displacements to be measured, N
 * @param F         out: contact forces that obey the law, nearest to K d - f, N; NULL: not wanted
 * @param state     out: state of each pair; NULL: not wanted
 * @param report    out: the measures; set report->struct_size before the call; NULL: not wanted
 * @return 0: d is a solution, report->eta <= tolerance; SIGNORINI_NOT_A_SOLUTION: it is not;
 *         -k the k-th argument is wrong, nothing was written
 */
int32_t signorini_certify(int32_t dim,
                          int64_t pairs,
                          const double *K,
                          int64_t ldk,
                          const double *f,
                          const double *gap,
                          const double *mu,
                          const double *slip,
                          double tolerance,
                          const double *d,
                          double *F,
                          int32_t *state,
                          struct signorini_report *report);

/**
 * Solves the linear complementarity problem w = q + M z, w >= 0, z >= 0, w . z = 0.
 *
 * By default block principal pivoting, which solves most problems with a symmetric positive definite
 * M in a handful of factorisations, then Lemke's method. Arrays must not overlap.
 *
 * @param n         number of unknowns, 0 allowed
 * @param M         n columns of n entries, column-major
 * @param ldm       entries from one column of M to the next, at least max(1, n)
 * @param q         n
 * @param settings  NULL: the defaults; method is SIGNORINI_METHOD_AUTO, _PIVOT or _LEMKE; omega,
 *                  damping, warm_start and search, though they must be valid, have no effect
 * @param w         out: n
 * @param z         out: n; with SIGNORINI_NO_EQUILIBRIUM a y >= 0 with M' y <= 0, q . y < 0
 * @param report    out; set report->struct_size before the call; NULL: not wanted
 * @return as signorini_solve
 */
int32_t signorini_lcp_solve(int64_t n,
                            const double *M,
                            int64_t ldm,
                            const double *q,
                            const struct signorini_settings *settings,
                            double *w,
                            double *z,
                            struct signorini_report *report);

/**
 * Solves the linear complementarity problem w = q + M z, w >= 0, z >= 0, w . z = 0 by Lemke's
 * method (lexicographic: it never cycles).
 *
 * M may be any matrix. If it is positive definite or a P-matrix the problem is solved; if it is
 * positive semi-definite or copositive-plus it is solved, or proved infeasible
 * (SIGNORINI_NO_EQUILIBRIUM); otherwise the method may also end in a ray that proves nothing
 * (SIGNORINI_STALLED). Arrays must not overlap.
 *
 * @param n         number of unknowns, 0 allowed
 * @param M         n columns of n entries, column-major
 * @param ldm       entries from one column of M to the next, at least max(1, n)
 * @param q         n
 * @param cover     covering vector, n positive entries; NULL: ones
 * @param settings  NULL: the defaults; method, omega, damping, warm_start and search, though they
 *                  must be valid, have no effect
 * @param w         out: n
 * @param z         out: n; with SIGNORINI_NO_EQUILIBRIUM a y >= 0 with M' y <= 0, q . y < 0
 * @param report    out; set report->struct_size before the call; NULL: not wanted
 * @return as signorini_solve
 */
int32_t signorini_lcp_lemke(int64_t n,
                            const double *M,
                            int64_t ldm,
                            const double *q,
                            const double *cover,
                            const struct signorini_settings *settings,
                            double *w,
                            double *z,
                            struct signorini_report *report);

/**
 * Makes a model of a body that the host has condensed, on an obstacle: d = u.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs
 * @param K      condensed stiffness, N = dim * pairs columns, as in signorini_solve; copied
 * @param ldk    entries from one column to the next, at least max(1, N)
 * @param model  out: the model, NULL unless 0 is returned
 * @return 0; -k the k-th argument is wrong; <= -1000 internal
 */
int32_t signorini_model_new_condensed(int32_t dim,
                                      int64_t pairs,
                                      const double *K,
                                      int64_t ldk,
                                      struct signorini_model **model);

/**
 * Makes a model of two bodies that the host has condensed on matching contact nodes. Each body is
 * in its own outward frame, n_B = -n_A and t_B = -t_A, so that d = u_A + u_B. A motion that neither
 * body resists is refused; one body may float.
 *
 * Loads and displacements of the host are [A; B], 2 N entries.
 *
 * @param dim    space dimension, 2 or 3
 * @param pairs  number of contact pairs
 * @param K_A    condensed stiffness of body A, N = dim * pairs columns; copied
 * @param lda    entries from one column to the next, at least max(1, N)
 * @param K_B    the same of body B
 * @param ldb    the same of body B
 * @param model  out: the model, NULL unless 0 is returned
 * @return 0; -k the k-th argument is wrong; <= -1000 internal
 */
int32_t signorini_model_new_two_body(int32_t dim,
                                     int64_t pairs,
                                     const double *K_A,
                                     int64_t lda,
                                     const double *K_B,
                                     int64_t ldb,
                                     struct signorini_model **model);

/**
 * Makes a model of the host's whole sparse stiffness matrix with contact pairs, for any number of
 * bodies and zones. Parts that only contact holds are fine.
 *
 * Loads and displacements of the host are K->size entries.
 *
 * @param K       the stiffness matrix, without supports; copied
 * @param fixed   number of degrees of freedom that are held
 * @param dofs    these, counted from K->base; NULL if there are none
 * @param pairs   the contact pairs; copied
 * @param model   out: the model, NULL unless 0 is returned
 * @return 0; -k the k-th argument is wrong; <= -1000 internal
 */
int32_t signorini_model_new_sparse(const struct signorini_sparse *K,
                                   int64_t fixed,
                                   const int64_t *dofs,
                                   const struct signorini_pairs *pairs,
                                   struct signorini_model **model);

/**
 * Releases a model. NULL is allowed.
 */
void signorini_model_free(struct signorini_model *model);

/**
 * Entries of a load or displacement vector of the model's host; -1 if model is NULL.
 */
int64_t signorini_model_host_size(const struct signorini_model *model);

/**
 * Copies the stiffness matrix in relative displacements, K_rel.
 *
 * @param model  the model
 * @param K      out: N = dim * pairs columns of N entries, without space between them
 * @return 0; -k the k-th argument is wrong
 */
int32_t signorini_model_stiffness(const struct signorini_model *model, double *K);

/**
 * Solves load cases, one after the other. Case c has its own columns in every array; a NULL status
 * array is not wanted. A case that is wrong or not solved does not stop the others; one that is wrong
 * leaves its d, F, state and report as they were.
 *
 * Friction in load steps: hand over as slip the d_t of the step before (zero at first); all state is
 * in your arrays.
 *
 * @param model       the model
 * @param cases       number of load cases, 0 allowed
 * @param f           nodal loads of the host, H = signorini_model_host_size entries a case
 * @param prescribed  values of the fixed degrees of freedom, in their order, a column a case; NULL:
 *                    zero
 * @param gap         gaps, one for each pair and case
 * @param mu          friction coefficients, one for each pair and case
 * @param slip        tangential displacement at rest, dim - 1 for each pair and case; NULL: zero
 * @param settings    NULL: the defaults; a progress callback is told of each case in turn
 * @param d           out: relative displacements, N = dim * pairs entries a case; in: the starts if
 *                    settings->warm_start
 * @param F           out: contact forces, N entries a case
 * @param state       out: state of each pair, a column a case; NULL: not wanted
 * @param report      out: one for each case; set struct_size in each one before the call; NULL: not
 *                    wanted
 * @param status      out: status of each case, as signorini_solve returns it, -k standing for the
 *                    k-th argument of this call; NULL: not wanted
 * @return 0 if every case is solved; otherwise the status of the first that is not, and
 *         signorini_last_error names it; -k the k-th argument is wrong
 */
int32_t signorini_model_solve(const struct signorini_model *model,
                              int64_t cases,
                              const double *f,
                              const double *prescribed,
                              const double *gap,
                              const double *mu,
                              const double *slip,
                              const struct signorini_settings *settings,
                              double *d,
                              double *F,
                              int32_t *state,
                              struct signorini_report *report,
                              int32_t *status);

/**
 * Displacements of the host from the relative ones, for one load case.
 *
 * @param model       the model
 * @param f           nodal loads of the case, H entries; NULL: none, for the motion of a case without
 *                    equilibrium
 * @param prescribed  values of the fixed degrees of freedom; NULL: zero
 * @param d           relative displacements, N entries
 * @param u           out: displacements, H entries
 * @return 0; -k the k-th argument is wrong
 */
int32_t signorini_model_recover(const struct signorini_model *model,
                                const double *f,
                                const double *prescribed,
                                const double *d,
                                double *u);

/**
 * Contact forces as a nodal force vector of the host: of a sparse model on slaves, and the opposite
 * on masters; of two bodies F on both, each in its own frame; of a condensed one F itself.
 *
 * @param model  the model
 * @param F      contact forces, N entries
 * @param nodal  out: nodal forces, H entries
 * @return 0; -k the k-th argument is wrong
 */
int32_t signorini_model_nodal_forces(const struct signorini_model *model,
                                     const double *F,
                                     double *nodal);

/**
 * Writes the problem of signorini_solve to a file, as text that keeps every bit.
 *
 * The file is of the Matrix Market format, one dense matrix of N rows with comments that say what
 * it is: the columns of K, then f, gap and mu in the normal rows, slip in the tangential rows. It
 * is written beside its place under a name that ends in .part and moved there when it is complete.
 * K must be finite; that it is symmetric and semi-definite is not asked here.
 *
 * @param path    name of the file, which is replaced if it exists; bytes as for fopen (UTF-8 on
 *                Windows)
 * @param dim     space dimension, 2 or 3
 * @param pairs   number of contact pairs, 0 allowed
 * @param K       condensed stiffness, as for signorini_solve
 * @param ldk     entries from one column of K to the next, at least max(1, N)
 * @param f       condensed nodal loads, N
 * @param gap     initial gaps, one for each pair
 * @param mu      friction coefficients, one for each pair
 * @param slip    tangential displacement at rest, dim - 1 for each pair; NULL: zero
 * @param remark  one line of UTF-8 for who reads the file, at most 1000 bytes; NULL: none
 * @return 0; -k the k-th argument is wrong; SIGNORINI_FILE: the file cannot be written, and an old
 *         one is as it was
 */
int32_t signorini_problem_save(const char *path,
                               int32_t dim,
                               int64_t pairs,
                               const double *K,
                               int64_t ldk,
                               const double *f,
                               const double *gap,
                               const double *mu,
                               const double *slip,
                               const char *remark);

/**
 * Writes the problem of signorini_tresca to a file. The arguments are those of
 * signorini_problem_save, with g in the place of mu.
 *
 * @param path    name of the file, which is replaced if it exists
 * @param dim     space dimension, 2 or 3
 * @param pairs   number of contact pairs, 0 allowed
 * @param K       condensed stiffness, as for signorini_solve
 * @param ldk     entries from one column of K to the next, at least max(1, N)
 * @param f       condensed nodal loads, N
 * @param gap     initial gaps, one for each pair
 * @param g       friction thresholds, one for each pair
 * @param slip    tangential displacement at rest, dim - 1 for each pair; NULL: zero
 * @param remark  one line of UTF-8, at most 1000 bytes; NULL: none
 * @return as signorini_problem_save
 */
int32_t signorini_tresca_save(const char *path,
                              int32_t dim,
                              int64_t pairs,
                              const double *K,
                              int64_t ldk,
                              const double *f,
                              const double *gap,
                              const double *g,
                              const double *slip,
                              const char *remark);

/**
 * Writes the problem of signorini_lcp_solve or signorini_lcp_lemke to a file, as
 * signorini_problem_save does: the columns of M, then q and, if given, cover.
 *
 * @param path    name of the file, which is replaced if it exists
 * @param n       number of unknowns, 0 allowed
 * @param M       n columns of n entries, column-major
 * @param ldm     entries from one column of M to the next, at least max(1, n)
 * @param q       n
 * @param cover   covering vector, n positive entries; NULL: none
 * @param remark  one line of UTF-8, at most 1000 bytes; NULL: none
 * @return as signorini_problem_save
 */
int32_t signorini_lcp_save(const char *path,
                           int64_t n,
                           const double *M,
                           int64_t ldm,
                           const double *q,
                           const double *cover,
                           const char *remark);

/**
 * Writes the condensed problem that signorini_model_solve solves for a load case to a file, as
 * signorini_problem_save does. signorini_solve gives the same d and F for it.
 *
 * @param model       the model
 * @param path        name of the file, which is replaced if it exists
 * @param f           nodal loads of the host, H = signorini_model_host_size entries
 * @param prescribed  values of the fixed degrees of freedom, in their order; NULL: zero
 * @param gap         gaps, one for each pair
 * @param mu          friction coefficients, one for each pair
 * @param slip        tangential displacement at rest, dim - 1 for each pair; NULL: zero
 * @param remark      one line of UTF-8, at most 1000 bytes; NULL: none
 * @return as signorini_problem_save
 */
int32_t signorini_model_save_case(const struct signorini_model *model,
                                  const char *path,
                                  const double *f,
                                  const double *prescribed,
                                  const double *gap,
                                  const double *mu,
                                  const double *slip,
                                  const char *remark);

/**
 * Reads a problem from a file. Whatever the file holds, the call ends with a problem or with a
 * sentence that names the line.
 *
 * @param path     name of the file
 * @param problem  out: the problem, NULL unless 0 is returned
 * @return 0; -k the k-th argument is wrong; SIGNORINI_FILE: the file cannot be read, or is not a
 *         complete problem file; SIGNORINI_OUT_OF_MEMORY
 */
int32_t signorini_problem_load(const char *path, struct signorini_problem **problem);

/**
 * Releases a problem. NULL is allowed.
 */
void signorini_problem_free(struct signorini_problem *problem);

/**
 * What kind of problem it is: SIGNORINI_PROBLEM_...; -1 if problem is NULL.
 */
int32_t signorini_problem_kind(const struct signorini_problem *problem);

/**
 * Space dimension, 2 or 3; 0 of a bare complementarity problem; -1 if problem is NULL.
 */
int32_t signorini_problem_dim(const struct signorini_problem *problem);

/**
 * Number of contact pairs; 0 of a bare complementarity problem; -1 if problem is NULL.
 */
int64_t signorini_problem_pairs(const struct signorini_problem *problem);

/**
 * Number of unknowns, N = dim * pairs or n; -1 if problem is NULL.
 */
int64_t signorini_problem_size(const struct signorini_problem *problem);

/**
 * K or M: as many columns as unknowns, without space between them. This and the other arrays of a
 * problem are valid until signorini_problem_free, and NULL if they have no entries.
 */
const double *signorini_problem_matrix(const struct signorini_problem *problem);

/**
 * f or q.
 */
const double *signorini_problem_vector(const struct signorini_problem *problem);

/**
 * Gaps, one for each pair.
 */
const double *signorini_problem_gap(const struct signorini_problem *problem);

/**
 * mu, or g of SIGNORINI_PROBLEM_TRESCA, one for each pair.
 */
const double *signorini_problem_friction(const struct signorini_problem *problem);

/**
 * Tangential displacement at rest, dim - 1 for each pair.
 */
const double *signorini_problem_slip(const struct signorini_problem *problem);

/**
 * Covering vector of a bare complementarity problem; NULL: none.
 */
const double *signorini_problem_cover(const struct signorini_problem *problem);

/**
 * The remark of who wrote the file, UTF-8; empty if there is none or problem is NULL.
 */
const char *signorini_problem_remark(const struct signorini_problem *problem);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SIGNORINI_H */
