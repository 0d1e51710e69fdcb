#include "fclib_dat.h"
#include "dense.h"

#include <suitesparse/cs.h> /* first: Siconos leaves the structs of CSparse opaque */

#include <CSparseMatrix.h>
#include <NumericsMatrix.h>
#include <SparseBlockMatrix.h>
#include <fclib.h>
#include <stdio.h>
#include <stdlib.h>

static void add(struct fclib_matrix *triplets, int row, int column, double value)
{
    if (value == 0.0)
        return;
    triplets->i[triplets->nz] = row;
    triplets->p[triplets->nz] = column;
    triplets->x[triplets->nz++] = value;
}

static void make_room(struct fclib_matrix *triplets, size_t count)
{
    triplets->i = calloc(count + 1, sizeof *triplets->i);
    triplets->p = calloc(count + 1, sizeof *triplets->p);
    triplets->x = need(count);
    if (triplets->i == NULL || triplets->p == NULL) {
        fprintf(stderr, "not enough memory for %zu entries\n", count);
        exit(EXIT_FAILURE);
    }
}

/* Siconos' matrix as triplets of FCLIB. Siconos' own conversion drops entries below 2e-16. */
static struct fclib_matrix triplets_of(NumericsMatrix *A)
{
    const size_t rows = (size_t)A->size0, columns = (size_t)A->size1;
    struct fclib_matrix triplets = {.m = A->size0, .n = A->size1};
    if (A->storageType == NM_SPARSE) {
        const CSparseMatrix *sparse = NM_triplet(A);
        make_room(&triplets, (size_t)sparse->nz);
        for (int64_t k = 0; k < sparse->nz; k++)
            add(&triplets, (int)sparse->i[k], (int)sparse->p[k], sparse->x[k]);
        return triplets;
    }
    double *blocks = NULL;
    if (A->storageType == NM_SPARSE_BLOCK)
        SBM_to_dense(A->matrix1, blocks = need(rows * columns));
    const double *dense = blocks != NULL ? blocks : A->matrix0;
    size_t count = 0;
    for (size_t k = 0; k < rows * columns; k++)
        count += dense[k] != 0.0;
    make_room(&triplets, count);
    for (size_t k = 0; k < rows * columns; k++)
        add(&triplets, (int)(k % rows), (int)(k / rows), dense[k]);
    free(blocks);
    return triplets;
}

static void triplets_free(struct fclib_matrix *triplets)
{
    free(triplets->i);
    free(triplets->p);
    free(triplets->x);
}

/* NULL where the file ends too early. */
static double *read_numbers(FILE *file, size_t count)
{
    double *x = need(count);
    for (size_t k = 0; k < count; k++)
        if (fscanf(file, "%lf", &x[k]) != 1) {
            free(x);
            return NULL;
        }
    return x;
}

/* Nonzero if a matrix H of this size comes next: its storage and its size, three whole numbers,
 * where the local form has the first numbers of q. */
static int matrix_follows(FILE *file, int rows, int columns)
{
    const long here = ftell(file);
    int storage = -1, m = -1, n = -1;
    const int found = fscanf(file, "%d %d %d", &storage, &m, &n);
    fseek(file, here, SEEK_SET);
    return found == 3 && storage >= 0 && storage <= 2 && m == rows && n == columns;
}

static const char *read_local(FILE *file, int dim, struct fclib_matrix *W, struct local_form *form)
{
    const char *wrong = "the file ends too early";
    struct fclib_local local = {.W = W, .spacedim = dim};
    local.q = read_numbers(file, (size_t)W->m);
    local.mu = read_numbers(file, (size_t)(W->m / dim));
    if (local.q != NULL && local.mu != NULL)
        wrong = local_form_of_local(&local, form);
    free(local.q);
    free(local.mu);
    return wrong;
}

static const char *read_global(FILE *file, int dim, struct fclib_matrix *M,
                               struct local_form *form)
{
    const char *wrong = "the file ends too early";
    NumericsMatrix *read = NM_new_from_file(file);
    struct fclib_matrix H = triplets_of(read);
    struct fclib_global global = {.M = M, .H = &H, .spacedim = dim};
    NM_clear(read);
    free(read);
    global.f = read_numbers(file, (size_t)M->m);
    global.w = read_numbers(file, (size_t)H.n);
    global.mu = read_numbers(file, (size_t)(H.n / dim));
    if (global.f != NULL && global.w != NULL && global.mu != NULL)
        wrong = local_form_of_global(&global, form);
    free(global.f);
    free(global.w);
    free(global.mu);
    triplets_free(&H);
    return wrong;
}

const char *dat_read(const char *path, struct local_form *form)
{
    const char *wrong = NULL;
    int dim = 0, contacts = 0;
    FILE *file = fopen(path, "r");
    *form = (struct local_form){0};
    if (file == NULL)
        return "it cannot be opened";
    if (fscanf(file, "%d %d", &dim, &contacts) != 2)
        wrong = "it does not begin with a dimension and a number of contacts";
    else if (dim != 2 && dim != 3)
        wrong = "rolling friction is no law of this library";
    else if (contacts < 1)
        wrong = "it has no contacts";
    if (wrong == NULL) {
        NumericsMatrix *read = NM_new_from_file(file);
        struct fclib_matrix matrix = triplets_of(read);
        NM_clear(read);
        free(read);
        wrong = matrix_follows(file, matrix.m, dim * contacts)
                    ? read_global(file, dim, &matrix, form)
                    : read_local(file, dim, &matrix, form);
        triplets_free(&matrix);
    }
    fclose(file);
    if (wrong != NULL)
        local_form_free(form);
    return wrong;
}
