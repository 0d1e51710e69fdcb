/*
 * The stiffness matrix that CalculiX writes in a step *FREQUENCY, SOLVER=MATRIXSTORAGE:
 *     JOB.dof   what each row is, "node.direction"
 *     JOB.sti   entries "row column value" of the upper triangle, column by column, counted from 1
 * Degrees of freedom that the deck holds, or ties to others, have no row.
 */

#ifndef MATRIX_FILES_H
#define MATRIX_FILES_H

#include "signorini.h"

#include <stddef.h>
#include <stdint.h>

struct dof {
    long node;
    int direction; /* 1 to 3 */
};

struct matrix_files {
    size_t size, entries, spare;
    int64_t written; /* rows of the files; what was added comes after them */
    struct dof *dofs; /* one for each row */
    int64_t *starts;  /* one for each column, and the end */
    int64_t *rows;
    double *values;
};

/* Reads both files and leaves room for `spare` held degrees of freedom more. Returns NULL, or a
 * message that says what went wrong. matrix_release is needed in both cases. */
const char *matrix_read(struct matrix_files *matrix, const char *job, size_t spare);

/* The row of a degree of freedom; -1 if the matrix does not have it. */
int64_t matrix_row(const struct matrix_files *matrix, long node, int direction);

/* Adds a row for a degree of freedom that the deck holds, coupled to no other. Returns it, or -1 if
 * no room is left. */
int64_t matrix_add_held(struct matrix_files *matrix, long node, int direction);

/* The matrix as the library reads it; it points into the files' one. */
signorini_sparse matrix_view(const struct matrix_files *matrix);

void matrix_release(struct matrix_files *matrix);

#endif
