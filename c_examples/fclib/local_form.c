#include "local_form.h"
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

/* M is factorised as a dense matrix here: this many rows take 800 megabytes. */
enum { MOST_FREEDOMS = 10000 };

enum storage { TRIPLETS = 0, BY_COLUMNS = -1, BY_ROWS = -2 }; /* fclib_matrix.nz; >= 0: triplets */

/* The matrix as a dense one, or NULL if an index is out of range. Of triplets p has the columns and
 * i the rows, as in CSparse: FCLIB's header says the reverse, but files that Siconos has written
 * have it so. */
static double *dense(const struct fclib_matrix *matrix)
{
    const int rows = matrix->m, columns = matrix->n;
    const int outer = matrix->nz == BY_ROWS ? rows : columns;
    const int count = matrix->nz >= TRIPLETS ? matrix->nz : matrix->p[outer];
    double *A = need((size_t)rows * (size_t)columns);
    for (int k = 0, at = 0; k < count; k++) {
        if (matrix->nz < TRIPLETS)
            while (at < outer && matrix->p[at + 1] <= k)
                at++;
        const int first = matrix->nz < TRIPLETS ? at : matrix->p[k], second = matrix->i[k];
        const int row = matrix->nz == BY_ROWS ? first : second;
        const int column = matrix->nz == BY_ROWS ? second : first;
        if (row < 0 || row >= rows || column < 0 || column >= columns) {
            free(A);
            return NULL;
        }
        A[(size_t)row + (size_t)column * (size_t)rows] += matrix->x[k];
    }
    return A;
}

static double *copy(const double *x, size_t count)
{
    double *y = need(count);
    memcpy(y, x, count * sizeof *y);
    return y;
}

/* Makes W its symmetric part; returns how far it was from it, relative to the diagonal. */
static double make_symmetric(size_t n, double *W)
{
    double asymmetry = 0.0;
    for (size_t j = 0; j < n; j++)
        for (size_t i = j + 1; i < n; i++) {
            double *lower = &W[i + j * n], *upper = &W[j + i * n];
            const double difference = fabs(*lower - *upper);
            if (difference > 0.0)
                asymmetry = fmax(asymmetry, difference / sqrt(W[i + i * n] * W[j + j * n]));
            *lower = *upper = 0.5 * (*lower + *upper);
        }
    return asymmetry;
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
    form->W = dense(problem->W);
    if (form->W == NULL)
        return "an index of W is out of range";
    form->asymmetry = make_symmetric(form->size, form->W);
    return NULL;
}

/* With M = L L' and Y = L^-1 H: W = Y' Y, q = Y' L^-1 f + w. */
static void condense(size_t n, const double *L, double *H, const struct fclib_global *problem,
                     struct local_form *form)
{
    const size_t m = form->size;
    double *load = copy(problem->f, n);
    forward(n, L, load);
    for (size_t j = 0; j < m; j++)
        forward(n, L, &H[j * n]);
    form->W = need(m * m);
    for (size_t j = 0; j < m; j++) {
        form->q[j] += dot(n, &H[j * n], load);
        for (size_t i = j; i < m; i++)
            form->W[i + j * m] = form->W[j + i * m] = dot(n, &H[i * n], &H[j * n]);
    }
    free(load);
}

const char *local_form_of_global(const struct fclib_global *problem, struct local_form *form)
{
    const char *wrong = NULL;
    const size_t n = (size_t)problem->M->m;
    if (problem->G != NULL && problem->G->n > 0)
        return "the problem has equality constraints (G): eliminate lambda first";
    if (problem->M->n != problem->M->m || problem->H->m != problem->M->m ||
        problem->H->n % problem->spacedim != 0)
        return "the sizes of M and H do not match each other or the space dimension";
    if (problem->M->m > MOST_FREEDOMS)
        return "M has more than 10000 rows: condense it by a sparse factorisation first";
    form->found = "global";
    form->dim = problem->spacedim;
    form->size = (size_t)problem->H->n;
    form->contacts = form->size / (size_t)form->dim;
    form->q = copy(problem->w, form->size);
    form->mu = copy(problem->mu, form->contacts);
    double *L = dense(problem->M), *H = dense(problem->H);
    if (L == NULL || H == NULL)
        wrong = "an index of M or H is out of range";
    else if (cholesky(n, L) < n)
        wrong = "M is not positive definite: this example cannot condense it";
    else
        condense(n, L, H, problem, form);
    free(L);
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
