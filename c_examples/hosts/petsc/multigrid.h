/*
 * Products and preconditionings by all processes, at the command of process 0.
 *
 * The preconditioner is one cycle of GAMG for A with components of d held and with springs. It is
 * built anew when these change; nobody asks how near it comes.
 */

#ifndef MULTIGRID_H
#define MULTIGRID_H

#define SIGNORINI_UNSTABLE /* for operators, which may still change; body.h includes signorini.h */
#include "body.h"

struct multigrid {
    const struct body *body;
    Mat M; /* A with components held and springs */
    PC cycle;
    Vec x, y;
    Vec whole; /* x or y on process 0 */
    VecScatter gather;
    int32_t *held;
    double *springs;
    PetscInt *unknowns; /* held ones of this process */
    int products, cycles, builds;
};

/* Collective. */
PetscErrorCode multigrid_new(const struct body *body, struct multigrid *grid);
PetscErrorCode multigrid_free(struct multigrid *grid);

/* Process 0: the functions of signorini_operator, `user` the multigrid. */
int32_t multigrid_product(void *user, const double *x, double *y);
int32_t multigrid_precondition(void *user, const int32_t *held, const double *springs,
                               int32_t changed, const double *r, double *z);

/* Process 0: the diagonal of A and the load; then the others, which wait, go on. */
int32_t multigrid_diagonal(struct multigrid *grid, double *diagonal);
int32_t multigrid_load(struct multigrid *grid, double *load);
int32_t multigrid_end(struct multigrid *grid);

/* The other processes: take their part until the end. */
PetscErrorCode multigrid_wait(struct multigrid *grid);

#endif
