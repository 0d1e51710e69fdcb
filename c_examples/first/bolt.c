/*
 * A bolt through two plates, as springs along y: it is tightened, locked, and pulled at its head.
 *
 *     head 0 ---+---- 2 ---- o 3   section: u_3 = u_4 - s, s one more unknown
 *               8            o 4
 *             1 o    contact  |
 *             2 o             2
 *               8             |
 *     ground ---+-------------+
 *
 * Node i has the degrees of freedom 2 i along x, which are fixed, and 2 i + 1 along y; s is number
 * 10. In closed form (the joint diagram of VDI 2230): the bolt takes kB / (kB + kP) = 1 / (1 + 4)
 * of a pull P, and the plates open where P is V / (1 - 1 / 5).
 */
#include <signorini.h>
#include <stdio.h>

enum { SHORTENING = 10, SIZE = 11, PULLS = 3 };

static int32_t failed(int32_t status)
{
    if (status != 0)
        fprintf(stderr, "status %d: %s\n", (int)status, signorini_last_error());
    return status;
}

int main(void)
{
    /* Lower triangle by columns; columns along x and that of the shortening have no entries. */
    const int32_t col_start[SIZE + 1] = {0, 0, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7};
    const int32_t row[7] = {1, 3, 7, 3, 5, 7, 9};
    const double values[7] = {8 + 2, -8, -2, 8, 8, 2, 2};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 4, .size = SIZE, .nnz = 7,
        .triangle = SIGNORINI_TRIANGLE_LOWER, .col_start = col_start, .row = row, .values = values};
    const int64_t fixed[6] = {0, 2, 4, 6, 8, SHORTENING}; /* the last one if the bolt is locked */

    const int64_t dependent = 7, start[2] = {0, 2}, dofs[2] = {9, SHORTENING};
    const double coefficients[2] = {1, -1};
    const signorini_equations section = {.struct_size = sizeof section, .count = 1,
        .dependent = &dependent, .start = start, .dofs = dofs, .coefficients = coefficients};
    const int64_t slave[2] = {2, 3}, master_start[2] = {0, 1}, master[2] = {4, 5};
    const double weight = 1, normal[2] = {0, -1}, gap[PULLS] = {0, 0, 0};
    const signorini_pairs plates = {.struct_size = sizeof plates, .dim = 2, .count = 1,
        .slaves = slave, .master_start = master_start, .masters = master, .weights = &weight,
        .normals = normal, .equations = &section};
    double d[2 * PULLS], F[2 * PULLS], u[SIZE * PULLS];

    /* Tightening: the load of the shortening is the force in the bolt. */
    const double tightened[SIZE] = {[SHORTENING] = 100};
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_sparse(&K, 5, fixed, &plates, NULL, &model);
    if (status == 0)
        status = signorini_model_solve(model, 1, tightened, NULL, gap, SIGNORINI_LAW_FRICTIONLESS,
                                       NULL, NULL, NULL, d, F, NULL, NULL, NULL, NULL);
    if (status == 0)
        status = signorini_model_recover(model, 1, tightened, NULL, d, u);
    signorini_model_free(model);
    if (failed(status) != 0)
        return 1;
    printf("shortening %.2f: bolt %.2f, joint %.2f\n", u[SHORTENING], 2 * u[9], -F[0]);

    /* Service: the shortening is fixed at what it came to, and the head is pulled. */
    const double pull[PULLS] = {50, 125, 150};
    double f[SIZE * PULLS] = {0}, locked[6 * PULLS] = {0};
    for (int k = 0; k < PULLS; k++)
        f[SIZE * k + 1] = pull[k], locked[6 * k + 5] = u[SHORTENING];
    model = NULL;
    status = signorini_model_new_sparse(&K, 6, fixed, &plates, NULL, &model);
    if (status == 0)
        status = signorini_model_solve(model, PULLS, f, locked, gap, SIGNORINI_LAW_FRICTIONLESS,
                                       NULL, NULL, NULL, d, F, NULL, NULL, NULL, NULL);
    if (status == 0)
        status = signorini_model_recover(model, PULLS, f, locked, d, u);
    signorini_model_free(model);
    for (int k = 0; k < PULLS && status == 0; k++)
        printf("pull %.2f: bolt %.2f, joint %.2f\n", pull[k], 2 * u[SIZE * k + 9], 0.0 - F[2 * k]);
    return failed(status) != 0;
}
