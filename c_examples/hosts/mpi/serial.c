#include "serial.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static const double limit = 1e-9;      /* of the largest entry */
static const double tolerance = 1e-12; /* of both runs */

signorini_settings block_settings(void)
{
    signorini_settings settings;
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = tolerance;
    return settings;
}

void insist(const char *what, int status)
{
    if (status == 0)
        return;
    fprintf(stderr, "%s: %d: %s\n", what, status, signorini_last_error());
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
}

/* ---- One process --------------------------------------------------------------------------- */

static signorini_model *serial_model(const struct part *whole)
{
    static int64_t held[HELD], slaves[SIZE];
    static double normals[SIZE], tangents[SIZE];
    const struct brick_mesh *mesh = whole->mesh;
    signorini_model *model;
    int count = 0;

    for (int32_t dof = 0; dof < TOTAL; dof++)
        if (block_held(dof))
            held[count++] = dof;
    for (int i = 0; i < SIZE; i++) {
        slaves[i] = i;
        normals[i] = i % 3 == 2 ? -1.0 : 0.0;
        tangents[i] = i % 3 == 0 ? 1.0 : 0.0;
    }
    const signorini_sparse K = {.struct_size = sizeof K,
                                .index_bytes = sizeof *mesh->starts,
                                .triangle = SIGNORINI_TRIANGLE_FULL,
                                .size = mesh->dofs,
                                .nnz = mesh->starts[mesh->dofs],
                                .col_start = mesh->starts,
                                .row = mesh->rows,
                                .values = mesh->values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 3, .count = PAIRS,
                                   .slaves = slaves, .normals = normals, .tangents = tangents};
    insist("serial model", signorini_model_new_sparse(&K, HELD, held, &pairs, NULL, &model));
    return model;
}

static void solve_serially(struct found *found, double u[TOTAL])
{
    struct part whole;
    double gap[PAIRS], mu[PAIRS];
    const signorini_settings settings = block_settings();

    insist("serial mesh", part_new(0, 1, &whole));
    signorini_model *model = serial_model(&whole);
    block_contact(gap, mu);
    insist("serial solution",
           signorini_model_solve(model, 1, whole.load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                 &settings, found->d, found->F, found->state, NULL, NULL, NULL));
    insist("serial displacements", signorini_model_recover(model, 1, whole.load, NULL, found->d, u));
    signorini_model_free(model);
    part_free(&whole);
}

/* ---- Comparison ---------------------------------------------------------------------------- */

/* The larger one; infinity where a value is not a number, which fmax passes over. */
static double larger(double most, double value)
{
    if (isnan(value))
        return INFINITY;
    return value > most ? value : most;
}

static void compare(struct checks *checks, const char *what, double off, double largest)
{
    judge(checks, off <= limit * largest);
    printf("%s: off by %.1e of the largest, limit %.0e\n", what, off / largest, limit);
}

static void compare_pairs(const struct found *found, const struct found *serial,
                          struct checks *checks)
{
    double off_d = 0.0, off_F = 0.0, most_d = 0.0, most_F = 0.0;
    int counts[3] = {0, 0, 0}, same = 0;

    for (int i = 0; i < SIZE; i++) {
        off_d = larger(off_d, fabs(found->d[i] - serial->d[i]));
        off_F = larger(off_F, fabs(found->F[i] - serial->F[i]));
        most_d = larger(most_d, fabs(serial->d[i]));
        most_F = larger(most_F, fabs(serial->F[i]));
    }
    for (int pair = 0; pair < PAIRS; pair++) {
        same += found->state[pair] == serial->state[pair];
        counts[serial->state[pair]] += 1;
    }
    compare(checks, "relative displacements", off_d, most_d);
    compare(checks, "contact forces", off_F, most_F);
    judge(checks, same == PAIRS && counts[0] > 0 && counts[1] > 0 && counts[2] > 0);
    printf("states: %d of %d the same; %d open, %d slip, %d stick\n", same, PAIRS, counts[0],
           counts[1], counts[2]);
}

void compare_with_serial(const struct part *part, const struct found *found, const double u[],
                         struct checks *checks)
{
    static struct found serial;
    static double wanted[TOTAL];
    double off = 0.0, largest_off, most = 0.0;

    if (part->rank == 0) {
        solve_serially(&serial, wanted);
        compare_pairs(found, &serial, checks);
    }
    MPI_Bcast(wanted, TOTAL, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    for (int32_t i = 0; i < part->mesh->dofs; i++)
        off = larger(off, fabs(u[i] - wanted[part->number[i]]));
    for (int i = 0; i < TOTAL; i++)
        most = larger(most, fabs(wanted[i]));
    MPI_Reduce(&off, &largest_off, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (part->rank == 0)
        compare(checks, "displacements on all processes", largest_off, most);
}
