#include "matrix_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *open_file(const char *job, const char *end)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s.%s", job, end);
    return length > 0 && (size_t)length < sizeof path ? fopen(path, "r") : NULL;
}

static size_t count_lines(FILE *file)
{
    size_t count = 0;
    for (int c = getc(file); c != EOF; c = getc(file))
        count += c == '\n';
    rewind(file);
    return count + 1; /* the last one may have no end */
}

static const char *read_dofs(struct matrix_files *matrix, FILE *file, size_t spare)
{
    const size_t room = count_lines(file) + spare;
    struct dof dof;

    matrix->dofs = calloc(room, sizeof *matrix->dofs);
    matrix->starts = calloc(room + 1, sizeof *matrix->starts);
    if (matrix->dofs == NULL || matrix->starts == NULL)
        return "not enough memory";
    /* Two whole numbers: read as a real one, 2.3 less 2 is below 0.3. */
    while (matrix->size + spare < room && fscanf(file, "%ld.%d", &dof.node, &dof.direction) == 2)
        matrix->dofs[matrix->size++] = dof;
    return feof(file) ? NULL : "the .dof file has a line that is not node.direction";
}

static const char *read_entries(struct matrix_files *matrix, FILE *file, size_t spare)
{
    static const char *const disorder =
        "the .sti file is not an upper triangle, column by column, of the rows of the .dof file";
    const int64_t size = (int64_t)matrix->size;
    const size_t room = count_lines(file) + spare;
    long long row, column, begun = 0;
    double value;

    matrix->rows = calloc(room, sizeof *matrix->rows);
    matrix->values = calloc(room, sizeof *matrix->values);
    if (matrix->rows == NULL || matrix->values == NULL)
        return "not enough memory";
    while (matrix->entries + spare < room &&
           fscanf(file, "%lld %lld %lf", &row, &column, &value) == 3) {
        if (row < 1 || row > column || column < begun || column > size)
            return disorder;
        while (begun < column)
            matrix->starts[begun++] = (int64_t)matrix->entries;
        matrix->rows[matrix->entries] = row - 1;
        matrix->values[matrix->entries++] = value;
    }
    while (begun <= size)
        matrix->starts[begun++] = (int64_t)matrix->entries;
    return feof(file) ? NULL : "the .sti file has a line that is not row, column, value";
}

const char *matrix_read(struct matrix_files *matrix, const char *job, size_t spare)
{
    memset(matrix, 0, sizeof *matrix);
    FILE *const dofs = open_file(job, "dof");
    FILE *const entries = open_file(job, "sti");
    const char *problem = NULL;

    if (dofs == NULL || entries == NULL)
        problem = "cannot open the .dof and the .sti file: has CalculiX written them?";
    if (problem == NULL)
        problem = read_dofs(matrix, dofs, spare);
    if (problem == NULL)
        problem = read_entries(matrix, entries, spare);
    if (dofs != NULL)
        fclose(dofs);
    if (entries != NULL)
        fclose(entries);
    matrix->spare = problem == NULL ? spare : 0;
    matrix->written = (int64_t)matrix->size;
    return problem;
}

int64_t matrix_row(const struct matrix_files *matrix, long node, int direction)
{
    for (size_t i = 0; i < matrix->size; i++)
        if (matrix->dofs[i].node == node && matrix->dofs[i].direction == direction)
            return (int64_t)i;
    return -1;
}

int64_t matrix_add_held(struct matrix_files *matrix, long node, int direction)
{
    const size_t new = matrix->size;

    if (matrix->spare == 0)
        return -1;
    matrix->spare -= 1;
    matrix->size += 1;
    matrix->dofs[new] = (struct dof){node, direction};
    matrix->rows[matrix->entries] = (int64_t)new;
    matrix->values[matrix->entries++] = 1.0; /* any positive number: the row is held */
    matrix->starts[new + 1] = (int64_t)matrix->entries;
    return (int64_t)new;
}

signorini_sparse matrix_view(const struct matrix_files *matrix)
{
    return (signorini_sparse){.struct_size = sizeof(signorini_sparse),
                              .index_bytes = 8,
                              .index_base = 0,
                              .triangle = SIGNORINI_TRIANGLE_UPPER,
                              .size = (int64_t)matrix->size,
                              .nnz = (int64_t)matrix->entries,
                              .col_start = matrix->starts,
                              .row = matrix->rows,
                              .values = matrix->values};
}

void matrix_release(struct matrix_files *matrix)
{
    free(matrix->dofs);
    free(matrix->starts);
    free(matrix->rows);
    free(matrix->values);
}
