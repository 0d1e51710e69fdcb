/*
 * A problem in the forms that the solvers take: dense linear algebra, untimed.
 *
 * Frictionless, on the normals: w = q + M z with
 *     stiffness form    z the opening gap - d_n, w the pressure -F_n, M = S, the Schur complement
 *     flexibility form  z the pressure, w the opening, M = S^-1
 * With friction, in the plane and in space, Siconos takes
 *     u = W r + q, W = K^-1, r = -F, u = (gap, 0) - d
 */

#ifndef PEERS_FORMS_H
#define PEERS_FORMS_H

#include "peers_mesh.h"

struct lcp {
    size_t size;
    double *M;
    double *q;
};

/* Both forms of the frictionless problem; not 0 if the matrix is not positive definite. */
int frictionless_forms(const struct contact *contact, struct lcp *stiffness,
                       struct lcp *flexibility);

/* W = K^-1, and q of the problem with friction. */
int friction_form(const struct contact *contact, struct lcp *flexibility);
/* q alone, for another load of the same body. */
void friction_load(const struct contact *contact, struct lcp *flexibility);

/* Milliseconds of one LU factorisation of K by LAPACK: a yardstick. The least of three. */
double factorisation_ms(const struct contact *contact);

void lcp_free(struct lcp *lcp);

/* y = M x, column by column. */
void product(size_t size, const double *M, const double *x, double *y);
/* Euclid's norm. */
double norm(size_t size, const double *x);

/* CPU time of this thread in seconds. */
double thread_seconds(void);

/* The name that the peers' BLAS gives itself. */
const char *blas_name(void);

#endif
