/*
 * Dense linear algebra of this example, column-major and without a library: each is a few lines,
 * and W is needed once. For thousands of contacts take LAPACK's dpotrf and dpotri.
 */

#ifndef DENSE_H
#define DENSE_H

#include <stddef.h>

/* Memory set to zero, or the end of the program. */
double *need(size_t count);

/* A = L L': L replaces the lower triangle of A, n x n. Returns n, or the row at which A is not
 * positive definite: what is left of its diagonal is within the rounding of its elimination. */
size_t cholesky(size_t n, double *A);

/* x = L^-1 x and x = L^-T x. */
void forward(size_t n, const double *L, double *x);
void backward(size_t n, const double *L, double *x);

/* K = (L L')^-1, both triangles equal to the last bit. */
void inverse(size_t n, const double *L, double *K);

double dot(size_t n, const double *x, const double *y);

#endif
