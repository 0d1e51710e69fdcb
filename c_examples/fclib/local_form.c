#include "local_form.h"
#include "bodies.h"
#include "dense.h"

#include <fclib.h>
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int file_has(const char *path, const char *group)
{
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    const int found = file >= 0 && H5Lexists(file, group, H5P_DEFAULT) > 0;
    if (file >= 0)
        H5Fclose(file);
    return found;
}

enum storage { TRIPLETS = 0, BY_COLUMNS = -1, BY_ROWS = -2 }; /* fclib_matrix.nz; >= 0: triplets */

/* The entries of the matrix; 0 if an index is out of range. Of triplets p has the columns and i the
 * rows, as in CSparse: FCLIB's header says the reverse, but files that Siconos has written have it
 * so. */
static int take_entries(const struct fclib_matrix *matrix, struct entries *entries)
{
    const int rows = matrix->m, columns = matrix->n;
    const int outer = matrix->nz == BY_ROWS ? rows : columns;
    const int count = matrix->nz >= TRIPLETS ? matrix->nz : matrix->p[outer];
    const size_t room = (size_t)(count > 0 ? count : 0);
    *entries = (struct entries){room, need_integers(room), need_integers(room), need(room)};
    for (int k = 0, at = 0; k < count; k++) {
        if (matrix->nz < TRIPLETS)
            while (at < outer && matrix->p[at + 1] <= k)
                at++;
        const int first = matrix->nz < TRIPLETS ? at : matrix->p[k], second = matrix->i[k];
        const int row = matrix->nz == BY_ROWS ? first : second;
        const int column = matrix->nz == BY_ROWS ? second : first;
        if (row < 0 || row >= rows || column < 0 || column >= columns)
            return 0;
        entries->row[k] = row;
        entries->column[k] = column;
        entries->value[k] = matrix->x[k];
    }
    return 1;
}

static void entries_free(struct entries *entries)
{
    free(entries->row);
    free(entries->column);
    free(entries->value);
}

static void append(struct entries *entries, int64_t row, int64_t column, double value)
{
    entries->row[entries->count] = row;
    entries->column[entries->count] = column;
    entries->value[entries->count++] = value;
}

/* The entries of a matrix that is symmetric, of which some files have one triangle alone. */
static int take_symmetric(const struct fclib_matrix *matrix, struct entries *whole)
{
    struct entries stored;
    const int found = take_entries(matrix, &stored);
    size_t below = 0, above = 0;
    for (size_t k = 0; found && k < stored.count; k++) {
        below += stored.value[k] != 0.0 && stored.row[k] > stored.column[k];
        above += stored.value[k] != 0.0 && stored.row[k] < stored.column[k];
    }
    const int is_half = (below == 0) != (above == 0);
    const size_t room = 2 * stored.count;
    *whole = (struct entries){0, need_integers(room), need_integers(room), need(room)};
    for (size_t k = 0; found && k < stored.count; k++) {
        const int64_t row = stored.row[k], column = stored.column[k];
        append(whole, row, column, stored.value[k]);
        if (is_half && row != column)
            append(whole, column, row, stored.value[k]);
    }
    entries_free(&stored);
    return found;
}

/* The matrix as a dense one, or NULL if an index is out of range. */
static double *dense(const struct fclib_matrix *matrix, int is_symmetric)
{
    struct entries entries;
    double *A = NULL;
    if (is_symmetric ? take_symmetric(matrix, &entries) : take_entries(matrix, &entries)) {
        A = need((size_t)matrix->m * (size_t)matrix->n);
        for (size_t k = 0; k < entries.count; k++)
            A[entries.row[k] + entries.column[k] * matrix->m] += entries.value[k];
    }
    entries_free(&entries);
    return A;
}

static double *copy(const double *x, size_t count)
{
    double *y = need(count);
    memcpy(y, x, count * sizeof *y);
    return y;
}

const char *local_form_of_local(const struct fclib_local *problem, struct local_form *form)
{
    if (problem->V != NULL && problem->V->n > 0)
        return "the problem has equality constraints (V, R): eliminate lambda first";
    if (problem->W->m != problem->W->n || problem->W->m % problem->spacedim != 0)
        return "W is not square, or its size is not a multiple of the space dimension";
    form->found = "local";
    form->dim = problem->spacedim;
    form->size = (size_t)problem->W->m;
    form->contacts = form->size / (size_t)form->dim;
    form->q = copy(problem->q, form->size);
    form->mu = copy(problem->mu, form->contacts);
    form->W = dense(problem->W, 1);
    if (form->W == NULL)
        return "an index of W is out of range";
    form->asymmetry = make_symmetric(form->size, form->W);
    return NULL;
}

const char *local_form_of_global(const struct fclib_global *problem, struct local_form *form)
{
    const char *wrong = NULL;
    if (problem->G != NULL && problem->G->n > 0)
        return "the problem has equality constraints (G): eliminate lambda first";
    if (problem->M->n != problem->M->m || problem->H->m != problem->M->m ||
        problem->H->n % problem->spacedim != 0)
        return "the sizes of M and H do not match each other or the space dimension";
    form->found = "global";
    form->dim = problem->spacedim;
    form->size = (size_t)problem->H->n;
    form->contacts = form->size / (size_t)form->dim;
    form->q = copy(problem->w, form->size);
    form->mu = copy(problem->mu, form->contacts);
    struct entries M;
    double *H = dense(problem->H, 0);
    if (!take_symmetric(problem->M, &M) || H == NULL) {
        wrong = "an index of M or H is out of range";
    } else {
        struct bodies bodies = bodies_of((size_t)problem->M->m, &M);
        form->W = need(form->size * form->size);
        wrong = condense(&bodies, &M, form->size, H, problem->f, form->W, form->q,
                         &form->asymmetry);
        bodies_free(&bodies);
    }
    entries_free(&M);
    free(H);
    return wrong;
}

const char *local_form_read(const char *path, struct local_form *form)
{
    const char *wrong;
    *form = (struct local_form){0};
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* what is wrong is said once, here */
    if (H5Fis_hdf5(path) <= 0)
        return "no HDF5 file of this name can be read";
    if (file_has(path, "/fclib_local")) {
        struct fclib_local *problem = fclib_read_local(path);
        if (problem == NULL)
            return "FCLIB cannot read /fclib_local";
        wrong = local_form_of_local(problem, form);
        fclib_delete_local(problem);
        free(problem);
    } else if (file_has(path, "/fclib_global")) {
        struct fclib_global *problem = fclib_read_global(path);
        if (problem == NULL)
            return "FCLIB cannot read /fclib_global";
        wrong = local_form_of_global(problem, form);
        fclib_delete_global(problem);
        free(problem);
    } else {
        wrong = "the file has neither /fclib_local nor /fclib_global: rolling friction is no law "
                "of this library";
    }
    if (wrong != NULL)
        local_form_free(form);
    return wrong;
}

void local_form_free(struct local_form *form)
{
    free(form->W);
    free(form->q);
    free(form->mu);
    form->W = form->q = form->mu = NULL;
}

struct triangle lower_triangle(const struct local_form *form)
{
    const size_t n = form->size;
    int64_t count = 0;
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++)
            count += form->W[i + j * n] != 0.0;
    struct triangle lower = {need_integers(n + 1), need_integers((size_t)count),
                             need((size_t)count)};
    count = 0;
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j; i < n; i++) {
            if (form->W[i + j * n] == 0.0)
                continue;
            lower.row[count] = (int64_t)i;
            lower.values[count++] = form->W[i + j * n];
        }
        lower.col_start[j + 1] = count;
    }
    return lower;
}

void triangle_free(struct triangle *lower)
{
    free(lower->col_start);
    free(lower->row);
    free(lower->values);
}

/* |r - P(z)| of one contact, z = r - rho u^. */
static double distance(size_t dim, double mu, const double *r, const double *z)
{
    const double normal = z[0], tangential = sqrt(dot(dim - 1, &z[1], &z[1]));
    double projected[3] = {0.0, 0.0, 0.0}, sum = 0.0;
    if (tangential <= mu * normal) {
        memcpy(projected, z, dim * sizeof *z);
    } else if (mu * tangential > -normal) {
        projected[0] = (normal + mu * tangential) / (1.0 + mu * mu);
        for (size_t c = 1; c < dim; c++)
            projected[c] = mu * projected[0] * z[c] / tangential;
    }
    for (size_t c = 0; c < dim; c++)
        sum += (r[c] - projected[c]) * (r[c] - projected[c]);
    return sqrt(sum);
}

double local_form_residual(const struct local_form *form, const double *r)
{
    const size_t dim = (size_t)form->dim, n = form->size;
    double largest = 0.0, worst = 0.0;
    for (size_t a = 0; a < form->contacts; a++) {
        double u[3], z[3], stiffest = 0.0;
        for (size_t c = 0; c < dim; c++) {
            const size_t at = dim * a + c;
            u[c] = form->q[at] + dot(n, &form->W[at * n], r); /* symmetric: a column is a row */
            stiffest = fmax(stiffest, form->W[at + at * n]);
            largest = fmax(largest, fabs(r[at]));
        }
        u[0] += form->mu[a] * sqrt(dot(dim - 1, &u[1], &u[1]));
        for (size_t c = 0; c < dim; c++)
            z[c] = r[dim * a + c] - u[c] / stiffest;
        worst = fmax(worst, distance(dim, form->mu[a], &r[dim * a], z));
    }
    return largest > 0.0 ? worst / largest : worst;
}
