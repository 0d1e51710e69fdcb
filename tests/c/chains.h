/* Problems of any size for the programs that need more than a few pairs. */

#ifndef CHAINS_H
#define CHAINS_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct chain {
    int32_t dim;
    int64_t pairs;
    int64_t n;
    double *K, *f, *gap, *mu, *d, *F;
    int32_t *state;
} chain;

static inline double *chain_numbers(int64_t count)
{
    double *numbers = calloc((size_t)count, sizeof *numbers);
    if (!numbers) abort();
    return numbers;
}

/* Numbers of no pattern in (-1, 1), the same on every machine. */
static inline double chain_draw(uint64_t *seed)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*seed >> 33) / 1073741824.0 - 1.0;
}

/*
 * Nodes on a line, each tied to the next by springs of stiffness 1 (all components, with some
 * coupling) and to the ground by weak ones, pressed and dragged by loads of no pattern. Positive
 * definite. The weaker the ground, the slower any sweeping method.
 */
static inline chain chain_new(int32_t dim, int64_t pairs, double ground, uint64_t seed)
{
    chain c = {.dim = dim, .pairs = pairs, .n = dim * pairs};
    c.K = chain_numbers(c.n * c.n);
    c.f = chain_numbers(c.n);
    c.gap = chain_numbers(pairs);
    c.mu = chain_numbers(pairs);
    c.d = chain_numbers(c.n);
    c.F = chain_numbers(c.n);
    c.state = calloc((size_t)pairs, sizeof *c.state);
    if (!c.state) abort();
    for (int64_t i = 0; i < c.n; i++) {
        c.K[i + c.n * i] += ground;
        /* The spring between i and j = i + dim, of a strain that mixes neighbouring components. */
        if (i + dim < c.n) {
            const int64_t node = i / dim, other = dim * node + (i + 1) % dim;
            const int64_t at[4] = {i, i + dim, other, other + dim};
            const double strain[4] = {-1, 1, -0.25, 0.25};
            for (int a = 0; a < 4; a++)
                for (int b = 0; b < 4; b++) c.K[at[a] + c.n * at[b]] += strain[a] * strain[b];
        }
    }
    for (int64_t pair = 0; pair < pairs; pair++) {
        c.f[dim * pair] = 0.6 + chain_draw(&seed);
        for (int32_t t = 1; t < dim; t++) c.f[dim * pair + t] = 0.5 * chain_draw(&seed);
        c.gap[pair] = 0.1 * (1 + chain_draw(&seed));
        c.mu[pair] = 0.3 * (1 + chain_draw(&seed));
    }
    return c;
}

static inline void chain_free(chain *c)
{
    free(c->K);
    free(c->f);
    free(c->gap);
    free(c->mu);
    free(c->d);
    free(c->F);
    free(c->state);
}

#endif
