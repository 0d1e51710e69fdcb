/*
 * Cost of the condensation of large_rows.rs by other libraries, on the matrix that it has written:
 *
 *     large_peers MATRIX mumps   CASE DIM BLAS    Schur complement on the contact unknowns by MUMPS
 *     large_peers MATRIX cholmod CASE DIM BLAS    Cholesky factor by CHOLMOD, contact unknowns last: a part of
 *                                                 the condensation, which has to make the product besides
 *
 * Prints one row of large.csv, and the norm of the Schur complement as a line with #. The file is that of
 * large_problem.rs. CPU seconds of the process, from the matrix on.
 */

#include <cholmod.h>
#include <dmumps_c.h>

#include <math.h>
#include <string.h>

#define PROGRAM "large_peers"
#include "large_problem.h"

/* ---- MUMPS --------------------------------------------------------------------------------- */

enum { BEGIN = -1, ANALYSE_AND_FACTORISE = 4, END = -2, USE_COMM_WORLD = -987654, DEFINITE = 1 };

static void check(const DMUMPS_STRUC_C *mumps)
{
    if (mumps->infog[0] < 0) {
        fprintf(stderr, "large_peers: MUMPS ends with INFOG %d %d\n", mumps->infog[0],
                mumps->infog[1]);
        exit(1);
    }
}

/* The Schur complement, of which MUMPS fills the lower triangle, by rows. */
static void schur(const struct problem *matrix)
{
    DMUMPS_STRUC_C mumps;
    const int64_t contact = matrix->contact, inner = matrix->size - contact;
    int *rows = memory((size_t)matrix->entries, sizeof *rows);
    int *columns = memory((size_t)matrix->entries, sizeof *columns);
    int *list = memory((size_t)contact, sizeof *list);
    double *complement = memory((size_t)(contact * contact), sizeof *complement);
    double sum = 0;

    for (int64_t j = 0; j < matrix->size; j++)
        for (int64_t k = matrix->starts[j]; k < matrix->starts[j + 1]; k++) {
            rows[k] = (int)matrix->rows[k] + 1;
            columns[k] = (int)j + 1;
        }
    for (int64_t i = 0; i < contact; i++) list[i] = (int)(inner + i) + 1;
    memset(&mumps, 0, sizeof mumps);
    mumps.job = BEGIN;
    mumps.par = 1;
    mumps.sym = DEFINITE;
    mumps.comm_fortran = USE_COMM_WORLD;
    dmumps_c(&mumps);
    check(&mumps);
    for (int i = 0; i < 4; i++) mumps.icntl[i] = i == 0 ? 6 : 0; /* errors alone are printed */
    mumps.icntl[13] = 50; /* ICNTL(14): room for what its estimate misses, in percent */
    mumps.icntl[18] = 1;  /* ICNTL(19): the Schur complement on one process */
    mumps.n = (int)matrix->size;
    mumps.nnz = matrix->entries;
    mumps.irn = rows;
    mumps.jcn = columns;
    mumps.a = matrix->values;
    mumps.size_schur = (int)contact;
    mumps.listvar_schur = list;
    mumps.schur = complement;
    mumps.job = ANALYSE_AND_FACTORISE;
    dmumps_c(&mumps);
    check(&mumps);
    for (int64_t i = 0; i < contact; i++)
        for (int64_t j = 0; j <= i; j++)
            sum += (i == j ? 1 : 2) * complement[contact * i + j] * complement[contact * i + j];
    printf("# MUMPS: norm %.15e\n", sqrt(sum));
    mumps.job = END;
    dmumps_c(&mumps);
    free(complement);
    free(list);
    free(columns);
    free(rows);
}

/* ---- CHOLMOD ------------------------------------------------------------------------------- */

/* An order with the contact last: by CAMD in 2D, by METIS of the rest in 3D, as suits each. */
static void order_contact_last(cholmod_sparse *A, const struct problem *matrix, int dim,
                               SuiteSparse_long *order, cholmod_common *common)
{
    const int64_t inner = matrix->size - matrix->contact;
    SuiteSparse_long *set = memory((size_t)matrix->size, sizeof *set);
    int ordered;
    if (dim == 2) {
        for (int64_t i = 0; i < matrix->size; i++) set[i] = i >= inner;
        ordered = cholmod_l_camd(A, NULL, 0, set, order, common);
    } else {
        for (int64_t i = 0; i < inner; i++) set[i] = i;
        cholmod_sparse *whole = cholmod_l_copy(A, 0, 0, common);
        cholmod_sparse *rest = cholmod_l_submatrix(whole, set, inner, set, inner, 0, 1, common);
        rest->stype = 1; /* all entries are there; those below are ignored */
        ordered = cholmod_l_metis(rest, NULL, 0, 1, order, common);
        for (int64_t i = inner; i < matrix->size; i++) order[i] = i;
        cholmod_l_free_sparse(&rest, common);
        cholmod_l_free_sparse(&whole, common);
    }
    if (!ordered) die("CHOLMOD has no order");
    free(set);
}

static void factor(const struct problem *matrix, int dim)
{
    cholmod_common common;
    SuiteSparse_long *order = memory((size_t)matrix->size, sizeof *order);
    cholmod_sparse A = {.nrow = (size_t)matrix->size, .ncol = (size_t)matrix->size,
                        .nzmax = (size_t)matrix->entries, .p = matrix->starts, .i = matrix->rows,
                        .x = matrix->values, .stype = -1, .itype = CHOLMOD_LONG,
                        .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE, .sorted = 1, .packed = 1};
    cholmod_l_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal = CHOLMOD_SUPERNODAL;
    order_contact_last(&A, matrix, dim, order, &common);
    cholmod_factor *L = cholmod_l_analyze_p(&A, order, NULL, 0, &common);
    if (!L || !cholmod_l_factorize(&A, L, &common) || common.status != CHOLMOD_OK)
        die("CHOLMOD has no factor");
    cholmod_l_free_factor(&L, &common);
    cholmod_l_finish(&common);
    free(order);
}

int main(int count, char **words)
{
    if (count != 6) die("usage: large_peers MATRIX mumps|cholmod CASE DIM BLAS");
    const char *library = words[2], *name = words[3], *blas = words[5];
    const int dim = atoi(words[4]);
    const struct problem matrix = read_problem(words[1], dim);
    const int is_mumps = !strcmp(library, "mumps");
    const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
    if (is_mumps)
        schur(&matrix);
    else
        factor(&matrix, dim);
    printf("%s,%d,%lld,%lld,%s,%s,%s,%.4f,%ld,,%s\n", name, dim, (long long)matrix.size,
           (long long)matrix.contact, library, blas, is_mumps ? "reduce" : "factor",
           seconds(CLOCK_PROCESS_CPUTIME_ID) - begin, peak(), is_mumps ? "reduced" : "factorised");
    free(matrix.starts);
    free(matrix.rows);
    free(matrix.values);
    return 0;
}
