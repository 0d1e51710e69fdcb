/*
 * Two blocks: the upper one lies on the lower one, held by nothing but contact and friction. It is
 * pressed in the middle and then twisted more and more, so that its corners lift. blocks.h has a
 * drawing. The nodes of the blocks do not match.
 *
 * This is a host program of the kind that the library is for. It has a mesh and assembles both
 * blocks into one sparse matrix (blocks.c, brick_mesh.c). What it adds for contact is below: the
 * library finds what lies opposite, makes a model, and solves one load step after the other;
 * friction remembers the slip of the step before. two_blocks_check.c shows and checks the answers.
 *
 *     two_blocks [DIR]
 *
 * With DIR, it also writes DIR/two_blocks.csv, the pairs after the last step, and
 * DIR/two_blocks.vtu, the blocks after it, for ParaView. It returns 0 if every check passed.
 * two_blocks.f90 and two_blocks.py are the same program.
 */

#include "two_blocks_check.h"

#include <stdio.h>
#include <stdlib.h>

static int failed(const char *what, int32_t status)
{
    printf("%s: %s: %s\n", what, signorini_status_string(status), signorini_last_error());
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    static double f[DOFS], u[DOFS], d[SIZE], F[SIZE], slip0[2 * PAIRS], friction[PAIRS];
    static int32_t state[PAIRS];
    static int64_t fixed[FIXED];
    signorini_surface_pairs *contact;
    signorini_model *model;
    signorini_settings settings;
    signorini_report report;
    struct brick_mesh *mesh = blocks_mesh();
    if (mesh == NULL) return failed("mesh", SIGNORINI_STATUS_OUT_OF_MEMORY);
    blocks_fixed(fixed);

    const signorini_faces slave = blocks_slave(mesh), master = blocks_master(mesh);
    int32_t status = signorini_surface_pair(3, mesh->nodes, mesh->at[0], &slave, &master, NULL,
                                            &contact);
    if (status != 0) return failed("pairs", status);
    signorini_surface_data pairs = {.struct_size = sizeof pairs};
    signorini_surface_view(contact, &pairs);
    const signorini_sparse K = brick_matrix(mesh);
    status = signorini_model_new_sparse(&K, FIXED, fixed, pairs.rows, NULL, &model);
    if (status != 0) return failed("model", status);
    signorini_settings_default(&settings, sizeof settings);
    signorini_report_default(&report, sizeof report);
    settings.tolerance = 1e-12; /* far below the 1e-9 that the checks ask for */
    for (int pair = 0; pair < PAIRS; pair++) friction[pair] = MU;

    struct check check = check_begin(mesh, contact, model);
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < 2 * PAIRS; i++) /* friction remembers: (n, t1, t2) a pair */
            slip0[i] = d[3 * (i / 2) + 1 + i % 2];
        blocks_loads(mesh, twist[step], f);
        status = signorini_model_solve(model, 1, f, NULL, pairs.gaps,
                                       SIGNORINI_LAW_COULOMB, friction, slip0, &settings, d, F,
                                       state, NULL, &report, NULL);
        if (status != 0) return failed("load step", status);
        check_step(&check, step, f, slip0, d, F, state, &report);
    }
    status = signorini_model_recover(model, 1, f, NULL, d, u);
    if (status != 0) return failed("displacements", status);
    check_end(&check, f, u, F, state, slip0);
    if (argc == 2)
        check_files(&check, argv[1], slip0, u, d, F, state);
    signorini_model_free(model);
    signorini_surface_free(contact);
    brick_mesh_free(mesh);
    return conclude(&check.checks);
}
