/*
 * Contact with friction in PETSc, on any number of processes, without a factor: the library runs on
 * process 0 and asks for products and for cycles of multigrid (section 5 of signorini.h). For each
 * question process 0 sends a command, and the others, which wait in a loop, take their part in
 * the answer (multigrid.c). body.h has a drawing, and how the matrix is made.
 *
 *     mpirun -n 2 contact -edge 12                     a cube of 12 x 12 x 12 nodes on a ball
 *     mpirun -n 2 contact -edge 30 -layers 4           a plate
 *     mpirun -n 2 contact -edge 9 -foundation 8        on a foundation of another mesh
 *
 * -check compares with the library alone on the whole matrix; -forces FILE writes the contact
 * forces, -tolerance the certificate that is asked. Options of PETSc choose the multigrid. Returns 0
 * if every check passed.
 */

#include "multigrid.h"

#include "../../3d/brick_mesh.h"
#include "../../common/checks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

static const double friction = 0.3, agree = 1e-8;
static const char *multigrid = "-pc_gamg_threshold -1 -mg_levels_ksp_max_it 3";

struct found {
    double *d, *F, *mu;
    int32_t *state;
    signorini_report report;
};

static void insist(const char *what, int32_t status)
{
    if (status == 0)
        return;
    fprintf(stderr, "%s: %d: %s\n", what, (int)status, signorini_last_error());
    MPI_Abort(PETSC_COMM_WORLD, EXIT_FAILURE);
}

static void *obtain(int64_t count, size_t bytes)
{
    void *memory = calloc(count > 0 ? (size_t)count : 1, bytes);
    if (memory == NULL)
        insist("memory", SIGNORINI_STATUS_OUT_OF_MEMORY);
    return memory;
}

static struct found found_new(const struct body *body)
{
    const int64_t pairs = body->pairs.pairs;
    struct found found = {.d = obtain(3 * pairs, sizeof(double)),
                          .F = obtain(3 * pairs, sizeof(double)),
                          .mu = obtain(pairs, sizeof(double)),
                          .state = obtain(pairs, sizeof(int32_t))};
    for (int64_t pair = 0; pair < pairs; pair++)
        found.mu[pair] = friction;
    signorini_report_default(&found.report, sizeof found.report);
    return found;
}

static void found_free(struct found *found)
{
    free(found->d);
    free(found->F);
    free(found->mu);
    free(found->state);
}

static void solve(const signorini_model *model, const struct body *body, const double *load,
                  const double *moved, double tolerance, struct found *found)
{
    signorini_settings settings;

    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = tolerance;
    insist("contact", signorini_model_solve(model, 1, load, moved, body->pairs.gaps,
                                            SIGNORINI_LAW_COULOMB, found->mu, NULL, &settings,
                                            found->d, found->F, found->state, NULL,
                                            &found->report, NULL));
}

/* ---- The library alone ------------------------------------------------------------------------ */

static struct brick_mesh *whole_mesh(const struct body *body)
{
    struct box boxes[MOST_BOXES];
    double *lines[MOST_BOXES][3];

    for (PetscInt box = 0; box < body->boxes; box++) {
        for (int axis = 0; axis < 3; axis++) {
            const PetscInt nodes = axis < 2 ? body->edge[box] : body->layers[box];
            lines[box][axis] = obtain(nodes, sizeof(double));
            for (PetscInt node = 0; node < nodes; node++)
                lines[box][axis][node] = body_line(body, box, axis, node);
            boxes[box].cells[axis] = (int)nodes - 1;
            boxes[box].lines[axis] = lines[box][axis];
        }
    }
    struct brick_mesh *mesh = brick_mesh_new((int)body->boxes, boxes, (struct material){1.0, 0.3});
    for (PetscInt box = 0; box < body->boxes; box++)
        for (int axis = 0; axis < 3; axis++)
            free(lines[box][axis]);
    if (mesh == NULL)
        insist("mesh", SIGNORINI_STATUS_OUT_OF_MEMORY);
    return mesh;
}

static void solve_alone(const struct body *body, double tolerance, struct found *found)
{
    struct brick_mesh *mesh = whole_mesh(body);
    int64_t *fixed = obtain(mesh->dofs, sizeof *fixed), count = 0;
    double *moved = obtain(mesh->dofs, sizeof *moved), *load = obtain(mesh->dofs, sizeof *load);
    signorini_model *model;
    double u[3];

    for (PetscInt i = 0; i < body->unknowns; i++) {
        if (!body_held(body, i / 3, u))
            continue;
        moved[count] = u[i % 3];
        fixed[count++] = i;
    }
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = sizeof *mesh->starts,
                                .triangle = SIGNORINI_TRIANGLE_FULL, .size = mesh->dofs,
                                .nnz = mesh->starts[mesh->dofs], .col_start = mesh->starts,
                                .row = mesh->rows, .values = mesh->values};
    insist("model", signorini_model_new_sparse(&K, count, fixed, body->pairs.rows, NULL, &model));
    solve(model, body, load, moved, tolerance, found);
    signorini_model_free(model);
    free(fixed);
    free(moved);
    free(load);
    brick_mesh_free(mesh);
}

static double apart(const double *a, const double *b, int64_t count)
{
    double off = 0.0, most = 0.0;
    for (int64_t i = 0; i < count; i++) {
        off = fmax(off, fabs(a[i] - b[i]));
        most = fmax(most, fabs(b[i]));
    }
    return off / most;
}

static void compare(const struct body *body, double tolerance, const struct found *found,
                    struct checks *checks)
{
    struct found alone = found_new(body);
    const int64_t pairs = body->pairs.pairs;
    int counts[3] = {0, 0, 0};

    solve_alone(body, tolerance, &alone);
    const double of_d = apart(found->d, alone.d, 3 * pairs);
    const double of_F = apart(found->F, alone.F, 3 * pairs);
    judge(checks, of_d <= agree);
    printf("relative displacements: %.1e from those of the library alone\n", of_d);
    judge(checks, of_F <= agree);
    printf("contact forces: %.1e from those of the library alone\n", of_F);
    for (int64_t pair = 0; pair < pairs; pair++)
        counts[alone.state[pair]] += 1;
    /* The whole cube stays on the foundation. */
    judge(checks, (counts[0] > 0) == (body->boxes == 1) && counts[1] > 0 && counts[2] > 0);
    printf("%d pairs are open, %d slip, %d stick\n", counts[0], counts[1], counts[2]);
    found_free(&alone);
}

/* ---- Process 0 ------------------------------------------------------------------------------- */

static void write_forces(const char *name, const struct body *body, const struct found *found)
{
    const size_t count = (size_t)(3 * body->pairs.pairs);
    FILE *file = fopen(name, "wb");
    if (file == NULL || fwrite(found->F, sizeof(double), count, file) != count || fclose(file) != 0)
        insist(name, SIGNORINI_STATUS_FILE);
}

static struct found solve_by_multigrid(struct multigrid *grid, double tolerance)
{
    const struct body *body = grid->body;
    double *load = obtain(body->unknowns, sizeof *load);
    double *diagonal = obtain(body->unknowns, sizeof *diagonal);
    struct found found = found_new(body);
    signorini_model *model;

    insist("load", multigrid_load(grid, load));
    insist("diagonal", multigrid_diagonal(grid, diagonal));
    const signorini_operator K = {.struct_size = sizeof K, .dim = 3, .pairs = body->pairs.pairs,
                                  .stiffness = multigrid_product, .units = diagonal, .user = grid,
                                  .unknowns = body->unknowns, .place = body->place,
                                  .precondition = multigrid_precondition};
    insist("model", signorini_model_new_operator(&K, &model));
    solve(model, body, load, NULL, tolerance, &found);
    insist("end", multigrid_end(grid));
    signorini_model_free(model);
    free(load);
    free(diagonal);
    return found;
}

/* CPU seconds and the largest memory, added up over the processes. */
static PetscErrorCode used(double sum[2])
{
    struct rusage usage;

    PetscFunctionBeginUser;
    getrusage(RUSAGE_SELF, &usage);
    const double own[2] = {(double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec +
                               (double)usage.ru_stime.tv_sec,
                           (double)usage.ru_maxrss / 1e3};
    PetscCallMPI(MPI_Allreduce(own, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
    PetscFunctionReturn(0);
}

static PetscErrorCode run(int *result)
{
    struct body body;
    struct multigrid grid;
    struct found found = {0};
    struct checks checks = {0, 0};
    PetscInt edge = 12, layers = 0, of_foundation = 0;
    PetscReal tolerance = 1e-10;
    PetscBool check = PETSC_FALSE, writes;
    PetscMPIInt rank, parts;
    char file[PETSC_MAX_PATH_LEN];
    double before[2], after[2];

    PetscFunctionBeginUser;
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-edge", &edge, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-layers", &layers, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-foundation", &of_foundation, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-tolerance", &tolerance, NULL));
    PetscCall(PetscOptionsGetBool(NULL, NULL, "-check", &check, NULL));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-forces", file, sizeof file, &writes));
    PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &parts));
    PetscCall(body_new(edge, layers > 0 ? layers : edge, of_foundation, &body));
    PetscCall(multigrid_new(&body, &grid));
    PetscCall(used(before));
    if (rank == 0)
        found = solve_by_multigrid(&grid, tolerance);
    else
        PetscCall(multigrid_wait(&grid));
    PetscCall(used(after));
    if (rank == 0) {
        printf("%d processes, %d unknowns, %d pairs: eta %.1e; %d multigrids, %d cycles, %d products; "
               "%.1f CPU s (mesh and matrix %.1f), %.0f MB (%.0f)\n",
               parts, (int)body.unknowns, (int)body.pairs.pairs, found.report.eta, grid.builds,
               grid.cycles, grid.products, after[0] - before[0], before[0], after[1], before[1]);
        judge(&checks, found.report.eta <= tolerance);
        printf("the certificate holds\n");
        if (check)
            compare(&body, tolerance, &found, &checks);
        if (writes)
            write_forces(file, &body, &found);
        *result = conclude(&checks);
        found_free(&found);
    }
    PetscCall(multigrid_free(&grid));
    PetscCall(body_free(&body));
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    int result = EXIT_SUCCESS;

    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    /* Options of the command line come after this, and count. */
    PetscCall(PetscOptionsInsertString(NULL, multigrid));
    PetscCall(PetscOptionsInsert(NULL, &argc, &argv, NULL));
    PetscCall(run(&result));
    PetscCall(PetscFinalize());
    return result;
}
