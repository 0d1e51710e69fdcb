#include "peers_forms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The LAPACK that Siconos is linked with; Debian has no header of it without -dev packages. */
void dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info);
void dpotri_(const char *uplo, const int *n, double *a, const int *lda, int *info);
void dtrsm_(const char *side, const char *uplo, const char *trans, const char *diag, const int *m,
            const int *n, const double *alpha, const double *a, const int *lda, double *b,
            const int *ldb);
void dgetrf_(const int *m, const int *n, double *a, const int *lda, int *pivots, int *info);
void dsyrk_(const char *uplo, const char *trans, const int *n, const int *k, const double *alpha,
            const double *a, const int *lda, const double *beta, double *c, const int *ldc);
char *openblas_get_config(void);

const char *blas_name(void)
{
    return openblas_get_config();
}

void product(size_t size, const double *M, const double *x, double *y)
{
    memset(y, 0, size * sizeof *y);
    for (size_t j = 0; j < size; j++) {
        const double *column = &M[j * size];
        for (size_t i = 0; i < size; i++)
            y[i] += column[i] * x[j];
    }
}

double norm(size_t size, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < size; i++)
        sum += x[i] * x[i];
    return sqrt(sum);
}

/* The solvers get both triangles, equal to the last bit. */
static void mirror(size_t size, double *M)
{
    for (size_t j = 0; j < size; j++)
        for (size_t i = j + 1; i < size; i++)
            M[j + i * size] = M[i + j * size];
}

static int invert(size_t size, double *M)
{
    const int n = (int)size;
    int info;
    dpotrf_("L", &n, M, &n, &info);
    if (info == 0)
        dpotri_("L", &n, M, &n, &info);
    mirror(size, M);
    return info;
}

static void lcp_new(struct lcp *lcp, size_t size)
{
    lcp->size = size;
    lcp->M = need(size * size, sizeof *lcp->M);
    lcp->q = need(size, sizeof *lcp->q);
}

void lcp_free(struct lcp *lcp)
{
    free(lcp->M);
    free(lcp->q);
}

int frictionless_forms(const struct contact *contact, struct lcp *stiffness,
                       struct lcp *flexibility)
{
    const size_t n = contact->pairs, both = 2 * n;
    const int size = (int)n, with_load = size + 1;
    const double one = 1.0, minus = -1.0;
    int info;
    double *tangential = need(n * n, sizeof *tangential);
    double *mixed = need(n * (n + 1), sizeof *mixed); /* K_tn, and f_t in the last column */

    lcp_new(stiffness, n);
    lcp_new(flexibility, n);
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) {
            tangential[i + j * n] = contact->K[2 * i + 1 + (2 * j + 1) * both];
            mixed[i + j * n] = contact->K[2 * i + 1 + 2 * j * both];
            stiffness->M[i + j * n] = contact->K[2 * i + 2 * j * both];
        }
    for (size_t i = 0; i < n; i++) {
        mixed[i + n * n] = contact->f[2 * i + 1];
        stiffness->q[i] = contact->f[2 * i];
    }

    /* S = K_nn - K_nt K_tt^-1 K_tn; q = f_n - K_nt K_tt^-1 f_t - S gap. */
    dpotrf_("L", &size, tangential, &size, &info);
    dtrsm_("L", "L", "N", "N", &size, &with_load, &one, tangential, &size, mixed, &size);
    dsyrk_("L", "T", &size, &size, &minus, mixed, &size, &one, stiffness->M, &size);
    mirror(n, stiffness->M);
    double *closing = need(n, sizeof *closing);
    product(n, stiffness->M, contact->gap, closing);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++)
            stiffness->q[j] -= mixed[i + j * n] * mixed[i + n * n];
        stiffness->q[j] -= closing[j];
    }
    free(closing);
    free(tangential);
    free(mixed);

    /* w = q + S z is z = -S^-1 q + S^-1 w. */
    if (info == 0) {
        memcpy(flexibility->M, stiffness->M, n * n * sizeof(double));
        info = invert(n, flexibility->M);
        product(n, flexibility->M, stiffness->q, flexibility->q);
        for (size_t i = 0; i < n; i++)
            flexibility->q[i] = -flexibility->q[i];
    }
    return info;
}

int friction_form(const struct contact *contact, struct lcp *flexibility)
{
    const size_t size = contact->dim * contact->pairs;
    lcp_new(flexibility, size);
    memcpy(flexibility->M, contact->K, size * size * sizeof(double));
    const int info = invert(size, flexibility->M);
    friction_load(contact, flexibility);
    return info;
}

void friction_load(const struct contact *contact, struct lcp *flexibility)
{
    const size_t dim = contact->dim, size = flexibility->size;
    product(size, flexibility->M, contact->f, flexibility->q);
    for (size_t i = 0; i < size; i++)
        flexibility->q[i] = (i % dim == 0 ? contact->gap[i / dim] : 0.0) - flexibility->q[i];
}

double factorisation_ms(const struct contact *contact)
{
    const int n = (int)(contact->dim * contact->pairs);
    const size_t bytes = (size_t)n * (size_t)n * sizeof(double);
    double *A = need((size_t)n * (size_t)n, sizeof *A), least = INFINITY;
    int *pivots = need((size_t)n, sizeof *pivots), info;
    for (int call = 0; call < 3; call++) {
        memcpy(A, contact->K, bytes);
        const double begin = thread_seconds();
        dgetrf_(&n, &n, A, &n, pivots, &info);
        least = fmin(least, thread_seconds() - begin);
    }
    free(A);
    free(pivots);
    return 1e3 * least;
}
