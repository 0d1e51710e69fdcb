/*
 * Two bars in a row along x, from a whole sparse matrix: bar A pushes on bar B across a gap.
 *
 *     wall 0|--A--o1   gap   2o--B--|3 wall      node i has the degrees of freedom 2 i and 2 i + 1
 */
#include <signorini.h>
#include <stdio.h>

int main(void)
{
    /* Each bar: 100 along x, 10 along y. Lower triangle by columns, rows ascending. */
    const int32_t col_start[9] = {0, 2, 4, 5, 6, 8, 10, 11, 12};
    const int32_t row[12] = {0, 2, 1, 3, 2, 3, 4, 6, 5, 7, 6, 7};
    const double values[12] = {100, -100, 10, -10, 100, 10, 100, -100, 10, -10, 100, 10};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 4, .size = 8, .nnz = 12,
        .triangle = SIGNORINI_TRIANGLE_LOWER, .col_start = col_start, .row = row, .values = values};
    const int64_t fixed[4] = {0, 1, 6, 7};

    /* One pair: node 1 faces node 2; its outward normal is x, so that its tangent is y. The load
     * acts on node 1. */
    const int64_t slave[2] = {2, 3}, master_start[2] = {0, 1}, master[2] = {4, 5};
    const double f[8] = {[2] = 30, [3] = 6}, weight = 1, normal[2] = {1, 0}, gap = 0.1, mu = 0.2;
    const signorini_pairs pair = {.struct_size = sizeof pair, .dim = 2, .count = 1, .slaves = slave,
        .master_start = master_start, .masters = master, .weights = &weight, .normals = normal};
    double d[2], F[2], u[8];
    signorini_model *model = NULL;

    int32_t status = signorini_model_new_sparse(&K, 4, fixed, &pair, NULL, &model);
    if (status == 0)
        status = signorini_model_solve(model, 1, f, NULL, &gap, SIGNORINI_LAW_COULOMB, &mu, NULL,
                                       NULL, d, F, NULL, NULL, NULL, NULL);
    if (status == 0)
        status = signorini_model_recover(model, 1, f, NULL, d, u);
    if (status == 0)
        printf("F_n %.4f F_t %.4f  node 1 %.4f %.4f  node 2 %.4f %.4f\n", F[0], F[1], u[2], u[3],
               u[4], u[5]);
    else
        fprintf(stderr, "status %d: %s\n", (int)status, signorini_last_error());
    signorini_model_free(model);
    return status != 0;
}
