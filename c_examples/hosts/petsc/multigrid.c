#include "multigrid.h"

#include <string.h>

enum command { PRODUCT, PRECONDITION, BUILD, DIAGONAL, LOAD, END };

/* ---- Each process's part --------------------------------------------------------------------- */

/* A with the components held and the springs of a command. */
static PetscErrorCode build(struct multigrid *grid)
{
    const struct body *body = grid->body;
    const int64_t components = 3 * body->pairs.pairs;
    PetscInt begin, end, count = 0;

    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Bcast(grid->held, (int)components, MPI_INT32_T, 0, PETSC_COMM_WORLD));
    PetscCallMPI(MPI_Bcast(grid->springs, (int)(4 * body->pairs.pairs), MPI_DOUBLE, 0,
                           PETSC_COMM_WORLD));
    PetscCall(MatCopy(body->A, grid->M, SAME_NONZERO_PATTERN));
    PetscCall(MatGetOwnershipRange(grid->M, &begin, &end));
    for (int64_t pair = 0; pair < body->pairs.pairs; pair++) {
        const PetscInt n = (PetscInt)body->place[3 * pair], tangents[2] = {n + 1, n + 2};
        if (n >= begin && n < end)
            PetscCall(MatSetValues(grid->M, 2, tangents, 2, tangents, grid->springs + 4 * pair,
                                   ADD_VALUES));
    }
    PetscCall(MatAssemblyBegin(grid->M, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(grid->M, MAT_FINAL_ASSEMBLY));
    for (int64_t i = 0; i < components; i++)
        if (grid->held[i] && body->place[i] >= begin && body->place[i] < end)
            grid->unknowns[count++] = (PetscInt)body->place[i];
    PetscCall(MatZeroRowsColumns(grid->M, count, grid->unknowns, 1.0 / (double)(body->edge[0] - 1),
                                 NULL, NULL));
    PetscCall(PCSetOperators(grid->cycle, grid->M, grid->M));
    PetscCall(PCSetUp(grid->cycle));
    grid->builds += 1;
    PetscFunctionReturn(0);
}

static PetscErrorCode scatter(struct multigrid *grid, Vec vector, ScatterMode mode)
{
    const Vec from = mode == SCATTER_FORWARD ? vector : grid->whole;
    const Vec to = mode == SCATTER_FORWARD ? grid->whole : vector;

    PetscFunctionBeginUser;
    PetscCall(VecScatterBegin(grid->gather, from, to, INSERT_VALUES, mode));
    PetscCall(VecScatterEnd(grid->gather, from, to, INSERT_VALUES, mode));
    PetscFunctionReturn(0);
}

/* x comes from process 0, and y goes there. */
static PetscErrorCode obey(struct multigrid *grid, enum command command)
{
    PetscFunctionBeginUser;
    if (command == BUILD)
        PetscCall(build(grid));
    if (command == PRODUCT || command == PRECONDITION)
        PetscCall(scatter(grid, grid->x, SCATTER_REVERSE));
    if (command == PRODUCT)
        PetscCall(MatMult(grid->body->A, grid->x, grid->y));
    if (command == PRECONDITION)
        PetscCall(PCApply(grid->cycle, grid->x, grid->y));
    if (command == DIAGONAL)
        PetscCall(MatGetDiagonal(grid->body->A, grid->y));
    if (command == LOAD)
        PetscCall(VecCopy(grid->body->load, grid->y));
    if (command != BUILD && command != END)
        PetscCall(scatter(grid, grid->y, SCATTER_FORWARD));
    PetscFunctionReturn(0);
}

/* ---- Commands of process 0 ------------------------------------------------------------------- */

static PetscErrorCode ask(struct multigrid *grid, enum command command, const double *x, double *y)
{
    const PetscInt count = grid->body->unknowns;
    int sent = command;
    double *whole;

    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Bcast(&sent, 1, MPI_INT, 0, PETSC_COMM_WORLD));
    if (x != NULL) {
        PetscCall(VecGetArrayWrite(grid->whole, &whole));
        PetscCall(PetscArraycpy(whole, x, count));
        PetscCall(VecRestoreArrayWrite(grid->whole, &whole));
    }
    PetscCall(obey(grid, command));
    if (y != NULL) {
        const double *found;
        PetscCall(VecGetArrayRead(grid->whole, &found));
        PetscCall(PetscArraycpy(y, found, count));
        PetscCall(VecRestoreArrayRead(grid->whole, &found));
    }
    PetscFunctionReturn(0);
}

int32_t multigrid_product(void *user, const double *x, double *y)
{
    struct multigrid *grid = user;
    grid->products += 1;
    return (int32_t)ask(grid, PRODUCT, x, y);
}

int32_t multigrid_precondition(void *user, const int32_t *held, const double *springs,
                               int32_t changed, const double *r, double *z)
{
    struct multigrid *grid = user;
    const int64_t pairs = grid->body->pairs.pairs;

    if (changed) {
        memcpy(grid->held, held, (size_t)(3 * pairs) * sizeof *held);
        memcpy(grid->springs, springs, (size_t)(4 * pairs) * sizeof *springs);
        const PetscErrorCode status = ask(grid, BUILD, NULL, NULL);
        if (status != 0)
            return (int32_t)status;
    }
    grid->cycles += 1;
    return (int32_t)ask(grid, PRECONDITION, r, z);
}

int32_t multigrid_diagonal(struct multigrid *grid, double *diagonal)
{
    return (int32_t)ask(grid, DIAGONAL, NULL, diagonal);
}

int32_t multigrid_load(struct multigrid *grid, double *load)
{
    return (int32_t)ask(grid, LOAD, NULL, load);
}

int32_t multigrid_end(struct multigrid *grid)
{
    return (int32_t)ask(grid, END, NULL, NULL);
}

PetscErrorCode multigrid_wait(struct multigrid *grid)
{
    int command = PRODUCT;

    PetscFunctionBeginUser;
    while (command != END) {
        PetscCallMPI(MPI_Bcast(&command, 1, MPI_INT, 0, PETSC_COMM_WORLD));
        PetscCall(obey(grid, (enum command)command));
    }
    PetscFunctionReturn(0);
}

/* ---- Beginning and end ----------------------------------------------------------------------- */

PetscErrorCode multigrid_new(const struct body *body, struct multigrid *grid)
{
    PetscFunctionBeginUser;
    *grid = (struct multigrid){.body = body};
    PetscCall(MatDuplicate(body->A, MAT_COPY_VALUES, &grid->M));
    PetscCall(MatSetNearNullSpace(grid->M, body->rigid));
    PetscCall(MatCreateVecs(body->A, &grid->x, &grid->y));
    PetscCall(VecScatterCreateToZero(grid->x, &grid->gather, &grid->whole));
    PetscCall(PetscMalloc1(3 * body->pairs.pairs, &grid->held));
    PetscCall(PetscMalloc1(4 * body->pairs.pairs, &grid->springs));
    PetscCall(PetscMalloc1(3 * body->pairs.pairs, &grid->unknowns));
    PetscCall(PCCreate(PETSC_COMM_WORLD, &grid->cycle));
    PetscCall(PCSetType(grid->cycle, PCGAMG));
    PetscCall(PCSetFromOptions(grid->cycle));
    PetscFunctionReturn(0);
}

PetscErrorCode multigrid_free(struct multigrid *grid)
{
    PetscFunctionBeginUser;
    PetscCall(PCDestroy(&grid->cycle));
    PetscCall(MatDestroy(&grid->M));
    PetscCall(VecScatterDestroy(&grid->gather));
    PetscCall(VecDestroy(&grid->whole));
    PetscCall(VecDestroy(&grid->x));
    PetscCall(VecDestroy(&grid->y));
    PetscCall(PetscFree(grid->held));
    PetscCall(PetscFree(grid->springs));
    PetscCall(PetscFree(grid->unknowns));
    PetscFunctionReturn(0);
}
