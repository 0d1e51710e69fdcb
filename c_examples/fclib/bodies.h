/*
 * A block-diagonal matrix: rows that entries tie to each other are a body's.
 */

#ifndef BODIES_H
#define BODIES_H

#include <stddef.h>
#include <stdint.h>

/* Entries of a sparse matrix; several at one place add up. */
struct entries {
    size_t count;
    int64_t *row, *column;
    double *value;
};

struct bodies {
    int64_t count;
    int64_t *first; /* rows of body b: row[first[b]] to row[first[b + 1] - 1] */
    int64_t *row;
    int64_t *of, *place; /* of each row: its body, and which of the body's rows it is */
};

struct bodies bodies_of(size_t rows, const struct entries *entries);
void bodies_free(struct bodies *bodies);

/* W = H' M^-1 H and q = q + H' M^-1 f, with the symmetric part of M; asymmetry tells how far M was
 * from it, relative to its diagonal. M has the rows of bodies, H, column-major, as many, and m columns.
 * Returns NULL, or a sentence on what is wrong. */
const char *condense(const struct bodies *bodies, const struct entries *M, size_t m,
                     const double *H, const double *f, double *W, double *q,
                     double *asymmetry);

#endif
