/*
 * Output and checks of two_blocks.c: statics, the law of friction, the symmetry of the problem, the
 * host's own equations, and that the library proves where no equilibrium exists.
 */

#ifndef TWO_BLOCKS_CHECK_H
#define TWO_BLOCKS_CHECK_H

#include "../common/checks.h"
#include "blocks.h"

#define MU 0.6

enum { STEPS = 5 };

extern const double twist[STEPS]; /* N mm */

struct check {
    struct checks checks;
    const struct brick_mesh *mesh;
    const signorini_surface_pairs *contact;
    signorini_surface_data pairs; /* what contact holds */
    const signorini_model *model;
    double off, excess, turned, least_work; /* of all steps */
};

/* Prints the heading. */
struct check check_begin(const struct brick_mesh *mesh, const signorini_surface_pairs *contact,
                         const signorini_model *model);

/* Prints and measures a load step; slip0 is that which the step began with. */
void check_step(struct check *check, int step, const double f[DOFS], const double slip0[2 * PAIRS],
                const double d[SIZE], const double F[SIZE], const int32_t state[PAIRS],
                const signorini_report *report);

/* Judges all steps and the last answer; slip0 is that which the last step began with. */
void check_end(struct check *check, const double f[DOFS], const double u[DOFS],
               const double F[SIZE], const int32_t state[PAIRS], const double slip0[2 * PAIRS]);

/* Writes DIR/two_blocks.csv and DIR/two_blocks.vtu. */
void check_files(struct check *check, const char *directory, const double slip0[2 * PAIRS],
                 const double u[DOFS], const double d[SIZE], const double F[SIZE],
                 const int32_t state[PAIRS]);

#endif
