#include "factor.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    BEGIN = -1, END = -2, SOLVE = 3, /* JOB */
    /*
     * ICNTL(14), percent beyond the estimate: of a small matrix on several processes MUMPS may
     * estimate too little, and ends with INFOG(1) = -9.
     */
    MORE_MEMORY = 200,
    DISTRIBUTED_MATRIX = 3,          /* ICNTL(18) */
    DISTRIBUTED_LOAD = 10,           /* ICNTL(20) */
    DISTRIBUTED_SOLUTION = 1         /* ICNTL(21) */
};

/* The numbers of MUMPS's guide. */
#define ICNTL(i) icntl[(i) - 1]
#define INFO(i) info[(i) - 1]
#define INFOG(i) infog[(i) - 1]

void *obtain(size_t count, size_t size)
{
    void *memory = calloc(count > 0 ? count : 1, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory: %zu entries of %zu bytes\n", count, size);
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    }
    return memory;
}

int factor_run(struct factor *factor, int job)
{
    factor->mumps.job = job;
    dmumps_c(&factor->mumps);
    return factor->mumps.INFOG(1) < 0 ? factor->mumps.INFOG(1) : 0;
}

/* ---- The matrix ---------------------------------------------------------------------------- */

/* One triangle of the part. MUMPS adds what several processes give of one entry. */
static void give_pattern(struct factor *factor)
{
    const struct part *part = factor->part;
    const struct brick_mesh *mesh = part->mesh;
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    const size_t most = (size_t)mesh->starts[mesh->dofs];
    int32_t count = 0;

    mumps->irn_loc = obtain(most, sizeof *mumps->irn_loc);
    mumps->jcn_loc = obtain(most, sizeof *mumps->jcn_loc);
    mumps->a_loc = obtain(most, sizeof *mumps->a_loc);
    factor->place = obtain(most, sizeof *factor->place);
    for (int32_t column = 0; column < mesh->dofs; column++) {
        for (int32_t at = mesh->starts[column]; at < mesh->starts[column + 1]; at++) {
            if (mesh->rows[at] < column)
                continue;
            mumps->irn_loc[count] = part->number[mesh->rows[at]] + 1;
            mumps->jcn_loc[count] = part->number[column] + 1;
            factor->place[count++] = at;
        }
    }
    mumps->nnz_loc = count;
}

int factor_begin(struct factor *factor, const struct part *part)
{
    *factor = (struct factor){.part = part};
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    mumps->comm_fortran = (MUMPS_INT)MPI_Comm_c2f(MPI_COMM_WORLD);
    mumps->par = 1; /* process 0 works with the others */
    mumps->sym = 1; /* positive definite */
    const int status = factor_run(factor, BEGIN);
    if (status != 0)
        return status;
    for (int i = 1; i <= 4; i++)
        mumps->ICNTL(i) = 0; /* silence */
    mumps->ICNTL(14) = MORE_MEMORY;
    mumps->ICNTL(18) = DISTRIBUTED_MATRIX;
    mumps->n = TOTAL;
    give_pattern(factor);
    return 0;
}

static int is_held(int32_t dof, const int32_t *held)
{
    return block_held(dof) || (held != NULL && dof < SIZE && held[contact_component(dof)]);
}

void factor_fill(struct factor *factor, const int32_t *held)
{
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    for (int64_t i = 0; i < mumps->nnz_loc; i++) {
        const int32_t row = mumps->irn_loc[i] - 1, column = mumps->jcn_loc[i] - 1;
        const int keep = row == column || !(is_held(row, held) || is_held(column, held));
        mumps->a_loc[i] = keep ? factor->part->mesh->values[factor->place[i]] : 0.0;
    }
}

/* ---- Solutions ----------------------------------------------------------------------------- */

struct entry {
    double value;
    int dof;
};

/* MUMPS leaves each unknown where it eliminates it. It goes to the parts that hold its node. */
static void bring_home(const struct part *part, int count, const int *dof, const double *value,
                       double u[])
{
    int *to = obtain((size_t)part->parts, sizeof *to), *from = obtain((size_t)part->parts, sizeof *from);
    int *out = obtain((size_t)part->parts + 1, sizeof *out);
    int *in = obtain((size_t)part->parts + 1, sizeof *in);
    const int bytes = sizeof(struct entry);

    for (int rank = 0; rank < part->parts; rank++) {
        for (int i = 0; i < count; i++)
            to[rank] += bytes * part_holds(rank, part->parts, dof[i] - 1);
        out[rank + 1] = out[rank] + to[rank];
    }
    struct entry *sent = obtain((size_t)(out[part->parts] / bytes), sizeof *sent), *next = sent;
    for (int rank = 0; rank < part->parts; rank++)
        for (int i = 0; i < count; i++)
            if (part_holds(rank, part->parts, dof[i] - 1))
                *next++ = (struct entry){value[i], dof[i] - 1};
    MPI_Alltoall(to, 1, MPI_INT, from, 1, MPI_INT, MPI_COMM_WORLD);
    for (int rank = 0; rank < part->parts; rank++)
        in[rank + 1] = in[rank] + from[rank];
    const int received = in[part->parts] / bytes;
    struct entry *got = obtain((size_t)received, sizeof *got);
    MPI_Alltoallv(sent, to, out, MPI_BYTE, got, from, in, MPI_BYTE, MPI_COMM_WORLD);
    for (int i = 0; i < received; i++)
        u[part_place(part, got[i].dof)] = got[i].value;
    free(to), free(from), free(out), free(in), free(sent), free(got);
}

int factor_solve_given(struct factor *factor, double u[])
{
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    const int count = mumps->INFO(23); /* unknowns that this process will hold */
    int *dof = obtain((size_t)count, sizeof *dof);
    double *value = obtain((size_t)count, sizeof *value);

    mumps->ICNTL(21) = DISTRIBUTED_SOLUTION;
    mumps->nrhs = 1;
    mumps->lsol_loc = count;
    mumps->isol_loc = dof;
    mumps->sol_loc = value;
    const int status = factor_run(factor, SOLVE);
    if (status == 0)
        bring_home(factor->part, count, dof, value, u);
    mumps->isol_loc = NULL;
    mumps->sol_loc = NULL;
    free(dof);
    free(value);
    return status;
}

int factor_solve(struct factor *factor, double share[], double u[])
{
    const int dofs = factor->part->mesh->dofs;
    DMUMPS_STRUC_C *mumps = &factor->mumps;
    int *dof = obtain((size_t)dofs, sizeof *dof);

    for (int i = 0; i < dofs; i++)
        dof[i] = factor->part->number[i] + 1;
    mumps->ICNTL(20) = DISTRIBUTED_LOAD;
    mumps->nloc_rhs = dofs;
    mumps->lrhs_loc = dofs;
    mumps->irhs_loc = dof;
    mumps->rhs_loc = share;
    const int status = factor_solve_given(factor, u);
    mumps->irhs_loc = NULL;
    mumps->rhs_loc = NULL;
    free(dof);
    return status;
}

void factor_end(struct factor *factor)
{
    factor_run(factor, END);
    free(factor->mumps.irn_loc);
    free(factor->mumps.jcn_loc);
    free(factor->mumps.a_loc);
    free(factor->place);
    *factor = (struct factor){0};
}
