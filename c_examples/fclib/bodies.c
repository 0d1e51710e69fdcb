#include "bodies.h"
#include "dense.h"

#include <math.h>
#include <stdlib.h>

/* A body is factorised as a dense matrix: this many rows take a quarter of a gigabyte. */
enum { MOST_FREEDOMS = 6000 };

/* The row that stands for all that are tied to i. */
static int64_t root(int64_t *parent, int64_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

struct bodies bodies_of(size_t rows, const struct entries *entries)
{
    struct bodies bodies = {0, need_integers(rows + 1), need_integers(rows), need_integers(rows),
                            need_integers(rows)};
    int64_t *parent = bodies.place, *next = need_integers(rows);
    for (size_t i = 0; i < rows; i++)
        parent[i] = (int64_t)i;
    for (size_t k = 0; k < entries->count; k++)
        if (entries->value[k] != 0.0)
            parent[root(parent, entries->row[k])] = root(parent, entries->column[k]);
    /* Roots have their numbers first, then all rows have those of their roots. */
    for (size_t i = 0; i < rows; i++)
        if (parent[i] == (int64_t)i)
            bodies.of[i] = bodies.count++;
    for (size_t i = 0; i < rows; i++) {
        bodies.of[i] = bodies.of[root(parent, (int64_t)i)];
        bodies.first[bodies.of[i] + 1]++;
    }
    for (int64_t b = 0; b < bodies.count; b++)
        bodies.first[b + 1] += bodies.first[b];
    for (size_t i = 0; i < rows; i++) {
        bodies.place[i] = next[bodies.of[i]]++;
        bodies.row[bodies.first[bodies.of[i]] + bodies.place[i]] = (int64_t)i;
    }
    free(next);
    return bodies;
}

void bodies_free(struct bodies *bodies)
{
    free(bodies->first);
    free(bodies->row);
    free(bodies->of);
    free(bodies->place);
}

/* The part of one body. Y = L^-1 H of its rows, for the columns that H has there. */
static void add_body(size_t size, const int64_t *row, const double *L, size_t rows, size_t m,
                     const double *H, const double *f, double *W, double *q)
{
    int64_t *column = need_integers(m);
    size_t columns = 0;
    for (size_t j = 0; j < m; j++) {
        int touches = 0;
        for (size_t i = 0; i < size; i++)
            touches |= H[(size_t)row[i] + j * rows] != 0.0;
        if (touches)
            column[columns++] = (int64_t)j;
    }
    double *Y = need(size * columns), *load = need(size);
    for (size_t i = 0; i < size; i++)
        load[i] = f[row[i]];
    forward(size, L, load);
    for (size_t k = 0; k < columns; k++) {
        const size_t j = (size_t)column[k];
        for (size_t i = 0; i < size; i++)
            Y[i + k * size] = H[(size_t)row[i] + j * rows];
        forward(size, L, &Y[k * size]);
        q[j] += dot(size, &Y[k * size], load);
        for (size_t l = 0; l <= k; l++) {
            const double both = dot(size, &Y[k * size], &Y[l * size]);
            const size_t i = (size_t)column[l];
            W[i + j * m] += both;
            if (i != j)
                W[j + i * m] += both;
        }
    }
    free(column);
    free(Y);
    free(load);
}

const char *condense(const struct bodies *bodies, const struct entries *M, size_t m,
                     const double *H, const double *f, double *W, double *q, double *asymmetry)
{
    const char *wrong = NULL;
    const size_t rows = (size_t)bodies->first[bodies->count];
    int64_t *start = need_integers((size_t)bodies->count + 1);
    for (int64_t b = 0; b < bodies->count; b++) {
        const int64_t size = bodies->first[b + 1] - bodies->first[b];
        start[b + 1] = start[b] + size * size;
        if (size > MOST_FREEDOMS)
            wrong = "M ties more than 6000 rows: condense it by a sparse factorisation first";
    }
    double *blocks = need(wrong == NULL ? (size_t)start[bodies->count] : 0);
    for (size_t k = 0; wrong == NULL && k < M->count; k++) {
        const int64_t i = M->row[k], j = M->column[k], b = bodies->of[i];
        if (M->value[k] != 0.0)
            blocks[start[b] + bodies->place[i] +
                   bodies->place[j] * (bodies->first[b + 1] - bodies->first[b])] += M->value[k];
    }
    for (int64_t b = 0; wrong == NULL && b < bodies->count; b++) {
        const size_t size = (size_t)(bodies->first[b + 1] - bodies->first[b]);
        double *L = &blocks[start[b]];
        *asymmetry = fmax(*asymmetry, make_symmetric(size, L));
        if (cholesky(size, L) < size)
            wrong = "M is not positive definite: this example cannot condense it";
        else
            add_body(size, &bodies->row[bodies->first[b]], L, rows, m, H, f, W, q);
    }
    free(start);
    free(blocks);
    return wrong;
}
