/*
 * Matrix and factor of the whole block on all processes, by MUMPS: every process gives the entries
 * of its own part, and gets back the displacements of its own part.
 *
 * All functions are collective: every process calls them, in the same order. Those with a result
 * return 0 or INFOG(1) of MUMPS, a negative number, the same on every process.
 */

#ifndef FACTOR_H
#define FACTOR_H

#include "block.h"

#include <dmumps_c.h>
#include <stddef.h>

struct factor {
    const struct part *part;
    DMUMPS_STRUC_C mumps;
    int32_t *place; /* of each entry given to MUMPS in the mesh's values; -1: of a held component */
};

/* Starts MUMPS and gives it the pattern of the matrix. */
int factor_begin(struct factor *factor, const struct part *part);

/*
 * Gives MUMPS the entries. Rows and columns of the support and of the contact components with
 * held[component] != 0 become those of a diagonal matrix; `held` has SIZE entries, NULL: none.
 */
void factor_fill(struct factor *factor, const int32_t *held);

/* Calls MUMPS: 1 analyses, 2 factorises, 4 does both, 3 solves. */
int factor_run(struct factor *factor, int job);

/*
 * Solves with a right-hand side of which every process gives a share, in the order of its mesh:
 * shares of a component on a cut are added. u: the displacements of the part.
 */
int factor_solve(struct factor *factor, double share[], double u[]);

/* As factor_solve, where the caller has set what MUMPS takes its right-hand side from. */
int factor_solve_given(struct factor *factor, double u[]);

void factor_end(struct factor *factor);

/* Memory, or the end of all processes with a message. */
void *obtain(size_t count, size_t size);

#endif
