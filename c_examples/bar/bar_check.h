/*
 * The bar on the plane: what its solution is checked against, and how it is shown.
 * Every check prints one line.
 */

#ifndef BAR_CHECK_H
#define BAR_CHECK_H

#include "bar_mesh.h"
#include "../common/checks.h"

#include <stddef.h>
#include <stdint.h>

struct solution {
    double d[BAR_SIZE]; /* displacements, (n, t) for each pair */
    double F[BAR_SIZE]; /* contact forces, likewise */
    int32_t state[BAR_PAIRS];
};

/* From the free corner on: so many open pairs, so many that slip, and the others stick. */
void check_zones(struct checks *checks, const struct solution *solution, size_t open, size_t slip);

/* mu = 1: against the solution of two other solvers on the same mesh. */
void check_reference(struct checks *checks, const struct solution *solution);

/* mu = 1: against the paper's Table 1, whose own mesh is not known. */
void check_table1(struct checks *checks, const struct solution *solution);

/* mu = 0: against the closed form. */
void check_frictionless(struct checks *checks, const struct bar *bar,
                        const struct solution *solution);

/* mu = 1 and the loads of code_aster's test SSNV128: against its displacements. */
void check_ssnv128(struct checks *checks, const struct solution *solution);

/* Prints Table 1 beside the computed values. */
void print_table1(const struct solution *solution);

/* Returns 0, or -1 with the reason in errno. */
int write_csv(const char *path, const struct bar *bar, const struct solution *solution);

#endif
