/*
 * Dense linear algebra of this example, column-major and without a library: each is a few lines,
 * and M is factorised once. For thousands of rows take LAPACK's dpotrf and dtrsm.
 */

#ifndef DENSE_H
#define DENSE_H

#include <stddef.h>
#include <stdint.h>

/* Memory set to zero, or the end of the program. */
double *need(size_t count);
int64_t *need_integers(size_t count);

/* Makes A its symmetric part; returns how far it was from it, relative to the diagonal. */
double make_symmetric(size_t n, double *A);

/* A = L L': L replaces the lower triangle of A, n x n. Returns n, or the row at which A is not
 * positive definite: what is left of its diagonal is within the rounding of its elimination. */
size_t cholesky(size_t n, double *A);

/* x = L^-1 x. */
void forward(size_t n, const double *L, double *x);

double dot(size_t n, const double *x, const double *y);

#endif
