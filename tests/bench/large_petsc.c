/*
 * The first load case of large_rows.rs without friction by PETSc's SNESVI, on the problem that large_problem.rs has
 * written:
 *
 *     large_petsc PROBLEM CASE DIM BLAS
 *
 * The reduced-space active-set method, SNESVINEWTONRSLS, on the whole sparse matrix: each step solves for the
 * displacements that are not on their obstacles, by the Cholesky factor of MUMPS. The pairs' normal is (0, -1) or
 * (0, 0, -1), so that gaps bound the last component of a node from below.
 *
 * Prints one row of large.csv, and as a line with # the sum of the normal forces. CPU seconds of the process, from the arrays
 * on; eta as the library measures it: the residual of the natural map relative to the larger of loads and contact
 * forces.
 */

#include <petscsnes.h>

#include <math.h>

#define PROGRAM "large_petsc"
#include "large_problem.h"

/* Both triangles by rows. */
static PetscErrorCode assemble(const struct problem *p, Mat *K)
{
    PetscInt *counts;
    PetscCall(PetscCalloc1(p->size, &counts));
    for (int64_t j = 0; j < p->size; j++) {
        for (int64_t k = p->starts[j]; k < p->starts[j + 1]; k++) {
            counts[j]++;
            if (p->rows[k] != j) counts[p->rows[k]]++;
        }
    }
    PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, (PetscInt)p->size, (PetscInt)p->size, 0, counts, K));
    PetscCall(PetscFree(counts));
    for (PetscInt j = 0; j < p->size; j++) {
        for (int64_t k = p->starts[j]; k < p->starts[j + 1]; k++) {
            const PetscInt i = (PetscInt)p->rows[k];
            PetscCall(MatSetValue(*K, i, j, p->values[k], INSERT_VALUES));
            if (i != j) PetscCall(MatSetValue(*K, j, i, p->values[k], INSERT_VALUES));
        }
    }
    PetscCall(MatAssemblyBegin(*K, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*K, MAT_FINAL_ASSEMBLY));
    PetscCall(MatSetOption(*K, MAT_SPD, PETSC_TRUE));
    return 0;
}

struct context {
    Mat K;
    Vec load;
};

/* K u - f. */
static PetscErrorCode residual(SNES snes, Vec u, Vec r, void *data)
{
    const struct context *context = data;
    (void)snes;
    PetscCall(MatMult(context->K, u, r));
    return VecAXPY(r, -1, context->load);
}

/* The matrix of linear elasticity does not change. */
static PetscErrorCode jacobian(SNES snes, Vec u, Mat J, Mat P, void *data)
{
    (void)snes, (void)u, (void)J, (void)P, (void)data;
    return 0;
}

static PetscErrorCode solve(struct context *context, Vec u, Vec lower)
{
    Vec upper, r;
    SNES snes;
    KSP ksp;
    PC pc;
    PetscCall(VecDuplicate(u, &upper));
    PetscCall(VecDuplicate(u, &r));
    PetscCall(VecSet(upper, PETSC_INFINITY));
    PetscCall(SNESCreate(PETSC_COMM_SELF, &snes));
    PetscCall(SNESSetType(snes, SNESVINEWTONRSLS));
    PetscCall(SNESSetFunction(snes, r, residual, context));
    PetscCall(SNESSetJacobian(snes, context->K, context->K, jacobian, context));
    PetscCall(SNESVISetVariableBounds(snes, lower, upper));
    /* |K u - f| on the free unknowns, of that at the start. */
    PetscCall(SNESSetTolerances(snes, 0, 1e-11, 0, 200, 10000));
    PetscCall(SNESGetKSP(snes, &ksp));
    PetscCall(KSPSetType(ksp, KSPPREONLY));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCCHOLESKY));
    PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    PetscCall(SNESSetFromOptions(snes));
    PetscCall(SNESSolve(snes, NULL, u));
    SNESConvergedReason reason;
    PetscInt steps;
    PetscCall(SNESGetConvergedReason(snes, &reason));
    PetscCall(SNESGetIterationNumber(snes, &steps));
    printf("# PETSc: %d steps, converged reason %d\n", (int)steps, (int)reason);
    PetscCall(SNESDestroy(&snes));
    PetscCall(VecDestroy(&r));
    PetscCall(VecDestroy(&upper));
    if (reason <= 0) die("SNESVI does not converge");
    return 0;
}

int main(int count, char **words)
{
    if (count != 5) die("usage: large_petsc PROBLEM CASE DIM BLAS");
    const char *name = words[2], *blas = words[4];
    const int dim = atoi(words[3]);
    const struct problem p = read_problem(words[1], dim);
    struct context context;
    Vec u, lower, force;
    double *at, *bound, *contact, pressure = 0, lacking = 0, forces = 0, loads = 0;

    PetscCall(PetscInitializeNoArguments());
    const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
    PetscCall(assemble(&p, &context.K));
    PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, (PetscInt)p.size, p.load, &context.load));
    PetscCall(VecDuplicate(context.load, &u));
    PetscCall(VecDuplicate(u, &lower));
    PetscCall(VecDuplicate(u, &force));
    PetscCall(VecSet(lower, PETSC_NINFINITY));
    PetscCall(VecGetArray(lower, &bound));
    for (int64_t pair = 0; pair < p.contact / dim; pair++)
        bound[p.size - p.contact + dim * pair + dim - 1] = -p.gap[pair];
    PetscCall(VecRestoreArray(lower, &bound));
    PetscCall(solve(&context, u, lower));
    const double spent = seconds(CLOCK_PROCESS_CPUTIME_ID) - begin;

    PetscCall(residual(NULL, u, force, &context));
    PetscCall(VecGetArray(u, &at));
    PetscCall(VecGetArray(lower, &bound));
    PetscCall(VecGetArray(force, &contact));
    for (int64_t i = 0; i < p.size; i++) {
        double left = contact[i];
        if (bound[i] > PETSC_NINFINITY) {
            double diagonal = 0;
            for (int64_t k = p.starts[i]; k < p.starts[i + 1]; k++)
                if (p.rows[k] == i) diagonal = p.values[k];
            /* The natural map: the force where the node is apart, else how deep it is. */
            left = fmin(contact[i], diagonal * (at[i] - bound[i]));
            pressure -= contact[i];
            forces += contact[i] * contact[i];
        }
        lacking += left * left;
        loads += p.load[i] * p.load[i];
    }
    printf("# PETSc: without friction: pressure %.12e\n", pressure);
    printf("%s,%d,%lld,%lld,petsc,%s,without friction,%.4f,%ld,%.1e,%s\n", name, dim,
           (long long)p.size, (long long)p.contact, blas, spent, peak(),
           sqrt(lacking / fmax(loads, forces)), "Solved");
    return 0;
}
