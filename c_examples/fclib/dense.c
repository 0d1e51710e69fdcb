#include "dense.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void *cleared(size_t count, size_t bytes)
{
    void *memory = calloc(count > 0 ? count : 1, bytes);
    if (memory == NULL) {
        fprintf(stderr, "not enough memory for %zu numbers\n", count);
        exit(EXIT_FAILURE);
    }
    return memory;
}

double *need(size_t count)
{
    return cleared(count, sizeof(double));
}

int64_t *need_integers(size_t count)
{
    return cleared(count, sizeof(int64_t));
}

double dot(size_t n, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

double make_symmetric(size_t n, double *A)
{
    double asymmetry = 0.0;
    for (size_t j = 0; j < n; j++)
        for (size_t i = j + 1; i < n; i++) {
            double *lower = &A[i + j * n], *upper = &A[j + i * n];
            const double difference = fabs(*lower - *upper);
            if (difference > 0.0)
                asymmetry = fmax(asymmetry, difference / sqrt(A[i + i * n] * A[j + j * n]));
            *lower = *upper = 0.5 * (*lower + *upper);
        }
    return asymmetry;
}

size_t cholesky(size_t n, double *A)
{
    for (size_t j = 0; j < n; j++) {
        double *column = &A[j * n];
        const double diagonal = column[j];
        for (size_t k = 0; k < j; k++) {
            const double factor = A[j + k * n];
            if (factor != 0.0) /* bodies that do not meet leave many zeros */
                for (size_t i = j; i < n; i++)
                    column[i] -= factor * A[i + k * n];
        }
        if (!(column[j] > (double)n * DBL_EPSILON * diagonal))
            return j;
        const double root = sqrt(column[j]);
        for (size_t i = j; i < n; i++)
            column[i] /= root;
    }
    return n;
}

void forward(size_t n, const double *L, double *x)
{
    for (size_t j = 0; j < n; j++) {
        x[j] /= L[j + j * n];
        if (x[j] != 0.0)
            for (size_t i = j + 1; i < n; i++)
                x[i] -= L[i + j * n] * x[j];
    }
}
