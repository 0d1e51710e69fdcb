/*
 * The library's own time on many pairs: an operator model on a grid of pairs in space whose products are quick,
 * so that the time is that of the law, of Newton's method, of GMRES and of the certificate.
 *
 *     million_pairs SIDE      SIDE x SIDE pairs; prints a row of a table
 */
#define _GNU_SOURCE
#include "../c/everything.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

struct grid { int64_t side, products, inverses; double seconds; };

static double cpu_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* In each direction 5 on the diagonal, -1 to the four neighbours; 0.5 between normal and first tangent. */
static int32_t stiffness(void *user, const double *x, double *y)
{
    struct grid *grid = user;
    const int64_t n = grid->side;
    const double began = cpu_seconds();
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = 0; j < n; j++) {
            const int64_t at = 3 * (i * n + j);
            for (int64_t k = at; k < at + 3; k++)
                y[k] = 5 * x[k] - (i > 0 ? x[k - 3 * n] : 0) - (i < n - 1 ? x[k + 3 * n] : 0)
                     - (j > 0 ? x[k - 3] : 0) - (j < n - 1 ? x[k + 3] : 0);
            y[at] += 0.5 * x[at + 1];
            y[at + 1] += 0.5 * x[at];
        }
    grid->products++;
    grid->seconds += cpu_seconds() - began;
    return 0;
}

static int32_t inverse(void *user, const double *x, double *y)
{
    struct grid *grid = user;
    const double began = cpu_seconds();
    for (int64_t k = 0; k < 3 * grid->side * grid->side; k++)
        y[k] = x[k] / 5;
    grid->inverses++;
    grid->seconds += cpu_seconds() - began;
    return 0;
}

/* Loads that press everywhere and push in waves, over gaps in waves: some pairs slip, some stick. */
static void fill(int64_t side, double *f, double *gap, double *mu)
{
    for (int64_t p = 0; p < side * side; p++) {
        const double x = (double)(p % side) / (double)side, y = (double)(p / side) / (double)side;
        gap[p] = 0.1 * sin(7 * x) * cos(9 * y) + 0.1;
        mu[p] = 0.3;
        f[3 * p] = 1 + 0.5 * sin(20 * x);
        f[3 * p + 1] = 0.3 * cos(11 * y);
        f[3 * p + 2] = 0.2;
    }
}

int main(int count, char **words)
{
    const int64_t side = count == 2 ? atoll(words[1]) : 0, pairs = side * side;
    struct grid grid = {.side = side};
    const signorini_operator K = {.struct_size = sizeof K, .dim = 3, .pairs = pairs, .stiffness = stiffness,
        .inverse = inverse, .user = &grid};
    const size_t bytes = sizeof(double) * (size_t)pairs;
    double *f = malloc(3 * bytes), *d = malloc(3 * bytes), *F = malloc(3 * bytes);
    double *gap = malloc(bytes), *mu = malloc(bytes);
    signorini_report report = {.struct_size = sizeof report};
    signorini_model *model = NULL;

    if (side < 1 || !f || !d || !F || !gap || !mu) {
        fprintf(stderr, "million_pairs SIDE: no number, or no memory\n");
        return 1;
    }
    fill(side, f, gap, mu);
    int32_t status = signorini_model_new_operator(&K, &model);
    grid = (struct grid){.side = side};
    const double began = cpu_seconds();
    if (status == 0)
        status = signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d, F, NULL, NULL,
                                       &report, NULL);
    const double seconds = cpu_seconds() - began - grid.seconds;
    if (status != 0) {
        fprintf(stderr, "status %d: %s\n", (int)status, signorini_last_error());
        return 1;
    }
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("| %lld | %lld | %lld + %lld | %.0f %% | %.1f s | %.1f GB | %.1f GB |\n", (long long)pairs,
           (long long)report.iterations, (long long)grid.products, (long long)grid.inverses,
           100.0 * (double)report.pairs_sticking / (double)pairs, seconds, (double)usage.ru_maxrss / 1e6,
           (double)model_data(model).memory / 1e9);
    signorini_model_free(model);
    free(f);
    free(d);
    free(F);
    free(gap);
    free(mu);
    return 0;
}
