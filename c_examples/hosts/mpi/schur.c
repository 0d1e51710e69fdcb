/*
 * A host on several processes whose solver condenses: MUMPS takes the matrix from all processes and
 * leaves its Schur complement on the contact components, and the condensed loads, on process 0.
 * There the library finds the contact. MUMPS goes back to the displacements of the whole block, of
 * which each process gets those of its part. block.h has a drawing.
 *
 *     mpirun -n 4 schur
 *
 * Process 0 compares with the library alone on the whole matrix; it returns 0 if every check passed.
 */

#include "factor.h"
#include "serial.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    CONDENSE_FACTOR = 4, /* JOB: analyse and factorise */
    SCHUR_FULL = 3,      /* ICNTL(19): both triangles by columns */
    CONDENSE_LOAD = 1,   /* ICNTL(26) */
    EXPAND = 2
};

#define ICNTL(i) icntl[(i) - 1]

/* Contact components come first in the numbers of the block; MUMPS counts from 1. */
static void condense(struct factor *factor, double schur[])
{
    static int components[SIZE];
    DMUMPS_STRUC_C *mumps = &factor->mumps;

    for (int i = 0; i < SIZE; i++)
        components[i] = i + 1;
    mumps->ICNTL(19) = SCHUR_FULL;
    mumps->size_schur = SIZE;
    mumps->listvar_schur = components;
    mumps->nprow = mumps->npcol = 1; /* the Schur complement on process 0 alone */
    mumps->mblock = mumps->nblock = 100;
    mumps->schur_lld = SIZE;
    mumps->schur = schur; /* MUMPS asks for an address on every process */
    factor_fill(factor, NULL);
    insist("MUMPS, factor and Schur complement", factor_run(factor, CONDENSE_FACTOR));
}

static void condense_load(struct factor *factor, double load[], double reduced[])
{
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    double *unused = obtain((size_t)factor->part->mesh->dofs, sizeof *unused);

    mumps->lredrhs = SIZE;
    mumps->redrhs = reduced;
    mumps->ICNTL(26) = CONDENSE_LOAD;
    insist("MUMPS, condensed loads", factor_solve(factor, load, unused));
    free(unused);
}

/* From global axes to the library's (n, t1, t2): a permutation with signs. */
static void solve_contact(const double schur[], const double reduced[], struct found *found)
{
    static double K[SIZE * SIZE], f[SIZE], gap[PAIRS], mu[PAIRS];
    const signorini_settings settings = block_settings();
    signorini_model *model;

    for (int32_t j = 0; j < SIZE; j++) {
        double *column = &K[SIZE * contact_component(j)];
        f[contact_component(j)] = contact_sign(j) * reduced[j];
        for (int32_t i = 0; i < SIZE; i++)
            column[contact_component(i)] = contact_sign(i) * contact_sign(j) * schur[i + SIZE * j];
    }
    block_contact(gap, mu);
    signorini_report_default(&found->report, sizeof found->report);
    insist("model", signorini_model_new_condensed(3, PAIRS, K, SIZE, NULL, &model));
    insist("contact", signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                            &settings, found->d, found->F, found->state, NULL,
                                            &found->report, NULL));
    signorini_model_free(model);
}

int main(int argc, char **argv)
{
    static double schur[SIZE * SIZE], reduced[SIZE];
    static struct found found;
    struct checks checks = {0, 0};
    struct factor factor;
    struct part part;
    int rank, parts, result = EXIT_SUCCESS;

    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &parts);
    insist("more processes than cells along x", parts > LONG);
    insist("mesh", part_new(rank, parts, &part));
    double *u = obtain((size_t)part.mesh->dofs, sizeof *u);

    insist("MUMPS", factor_begin(&factor, &part));
    condense(&factor, schur);
    condense_load(&factor, part.load, reduced);
    if (rank == 0) {
        solve_contact(schur, reduced, &found);
        for (int32_t i = 0; i < SIZE; i++) /* the way back */
            reduced[i] = contact_sign(i) * found.d[contact_component(i)];
    }
    factor.mumps.ICNTL(26) = EXPAND;
    insist("MUMPS, displacements", factor_solve_given(&factor, u));
    factor_end(&factor);

    if (rank == 0)
        printf("schur: %d processes, %d unknowns, %d pairs; eta %.1e\n", parts, (int)TOTAL,
               (int)PAIRS, found.report.eta);
    compare_with_serial(&part, &found, u, &checks);
    if (rank == 0)
        result = conclude(&checks);
    free(u);
    part_free(&part);
    MPI_Finalize();
    return result;
}
