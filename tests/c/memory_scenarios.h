/*
 * Calls of every kind on problems of some hundred kilobytes, for the tests of memory. A scenario releases
 * what it has made, and returns the first status that is not 0.
 */

#ifndef MEMORY_SCENARIOS_H
#define MEMORY_SCENARIOS_H

#include "chains.h"
#include "check.h"
#include "lattice.h"

#include "../../c_examples/3d/brick_mesh.h"

#include <stdlib.h>

enum { LOWER, UPPER };
enum { MOST_DOFS = 1500, PLANE = 60, SPACE = 30, SMALL = 6, MANY = 34, CUBE = 8, WIDE = 200 };

struct world {
    chain plane, space, small, loose, wide;
    lattice cube;
    double *ellipses, *cohesion, *ties, *more;
    double *lcp, q[2 * PLANE], w[2 * PLANE], z[2 * PLANE];
    struct brick_mesh *mesh;
    int64_t lower[64][4], upper[64][4], fixed[MOST_DOFS];
    int64_t n_fixed;
    signorini_faces top, bottom;
    double loads[MANY * MOST_DOFS], many[MANY * MOST_DOFS];
    double load[2 * MOST_DOFS], d[4 * MOST_DOFS], F[4 * MOST_DOFS], u[MOST_DOFS];
    double gap[2 * MOST_DOFS], mu[2 * MOST_DOFS];
    int32_t state[2 * MOST_DOFS];
    /* Arrays of one call, off the stack. */
    double K[4 * PLANE * PLANE], short_load[2 * PLANE], radius[3 * SPACE], normals[3 * 25];
    int64_t slaves[3 * 25], more_fixed[MOST_DOFS];
    int64_t W_start[2 * PLANE + 1], W_row[4 * PLANE * PLANE];
};

struct scenario {
    const char *name;
    int32_t (*run)(struct world *world);
    int32_t expected;
    int kind;
};

/* A scenario on a thread whose first call it is; one whose call starts a thread. */
enum { NEW_THREAD = 1, TWO_THREADS = 2 };

/* ---- Data ---------------------------------------------------------------------------------- */

static const double x_lower[] = {0, 0.2, 0.4, 0.7, 1}, x_upper[] = {0, 0.2, 0.45, 0.6, 0.8, 1};
static const double z_lower[] = {-0.8, -0.5, -0.3, 0}, z_upper[] = {0, 0.2, 0.4, 0.6};

static void add_blocks(struct world *world)
{
    const struct box boxes[2] = {{{4, 4, 3}, {x_lower, x_lower, z_lower}},
                                 {{5, 5, 3}, {x_upper, x_upper, z_upper}}};
    world->mesh = brick_mesh_new(2, boxes, (struct material){1000, 0.3});
    const struct brick_mesh *mesh = world->mesh;
    if (!mesh || mesh->dofs > MOST_DOFS) abort();
    world->top = (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 4,
                                   .count = brick_faces(mesh, LOWER, 1, world->lower),
                                   .nodes = world->lower[0]};
    world->bottom = (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 4,
                                      .count = brick_faces(mesh, UPPER, 0, world->upper),
                                      .nodes = world->upper[0]};
    for (int32_t node = 0; node < mesh->nodes; node++)
        for (int axis = 0; axis < 3; axis++)
            if (mesh->at[node][axis] == (axis < 2 ? 0.0 : -0.8))
                world->fixed[world->n_fixed++] = 3 * node + axis;
    for (int j = 0; j <= 5; j++)
        for (int i = 0; i <= 5; i++) {
            const int32_t node = brick_node(mesh, UPPER, i, j, 3);
            world->load[3 * node + 2] = -1;
            world->load[3 * node] = 0.1;
        }
    /* Cases that press the lower block against what is above it. */
    for (int c = 0; c < MANY; c++)
        for (int j = 0; j <= 4; j++)
            for (int i = 0; i <= 4; i++) {
                const int32_t node = brick_node(mesh, LOWER, i, j, 3);
                world->loads[c * mesh->dofs + 3 * node + 2] = 1 + 0.01 * c;
                world->loads[c * mesh->dofs + 3 * node] = 0.2;
            }
}

static struct world *world_new(void)
{
    struct world *world = calloc(1, sizeof *world);
    if (!world) abort();
    world->plane = chain_new(2, PLANE, 0.05, 1);
    world->space = chain_new(3, SPACE, 0.05, 2);
    world->small = chain_new(2, SMALL, 0.5, 7);
    /* A body that nothing holds, pulled away. */
    world->loose = chain_new(2, SMALL, 0, 7);
    world->wide = chain_new(2, WIDE, 0.5, 7);
    for (int64_t i = 0; i < world->loose.n; i++) world->loose.f[i] = i % 2 ? 0 : -1;
    world->ellipses = chain_numbers(3 * SPACE);
    world->cohesion = chain_numbers(3 * PLANE);
    world->ties = chain_numbers(4 * PLANE);
    for (int pair = 0; pair < SPACE; pair++) {
        world->ellipses[3 * pair] = 0.2;
        world->ellipses[3 * pair + 1] = 0.4;
        world->ellipses[3 * pair + 2] = 0.3;
    }
    for (int pair = 0; pair < PLANE; pair++) {
        double *own = world->ties + 4 * pair;
        own[0] = pair % 4 ? SIGNORINI_LAW_COULOMB : SIGNORINI_LAW_TIED;
        own[1] = pair % 4 ? 0.3 : 0;
        own[2] = own[3] = 0;
        world->cohesion[3 * pair] = 0.3;
        world->cohesion[3 * pair + 1] = 0.1;
        world->cohesion[3 * pair + 2] = 0.05;
    }
    world->more = chain_numbers(3 * world->plane.n);
    for (int64_t i = 0; i < 3 * world->plane.n; i++)
        world->more[i] = world->plane.f[i % world->plane.n] * (1 + (double)(i / world->plane.n));
    for (int64_t i = 0; i < 2 * MOST_DOFS; i++) {
        world->mu[i] = 0.3;
        world->gap[i] = i < 3 * PLANE ? world->plane.gap[i % PLANE] : 0;
    }
    for (int i = 0; i < 2 * PLANE; i++) world->q[i] = i % 3 ? -1 : 0.5;
    add_blocks(world);
    world->cube = lattice_new(CUBE);
    return world;
}

static void world_free(struct world *world)
{
    chain_free(&world->plane);
    chain_free(&world->space);
    chain_free(&world->small);
    chain_free(&world->loose);
    chain_free(&world->wide);
    free(world->ellipses);
    free(world->cohesion);
    free(world->ties);
    free(world->more);
    lattice_free(&world->cube);
    brick_mesh_free(world->mesh);
    free(world);
}

/* ---- Condensed problems -------------------------------------------------------------------- */

static int32_t flat(chain *c, int32_t method, int32_t law, const double *friction, int proof,
                    int search)
{
    signorini_settings settings;
    signorini_report report = {.struct_size = sizeof report};
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    if (status) return status;
    settings.method = method;
    settings.proof = proof;
    settings.search = search;
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, law, friction, NULL, &settings,
                           c->d, c->F, c->state, &report, NULL);
}

#define FLAT(name, which, method, law, friction, proof, search)                                    \
    static int32_t name(struct world *w)                                                           \
    {                                                                                              \
        return flat(&w->which, method, law, friction, proof, search);                              \
    }

FLAT(plane_auto, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_smooth, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_FRICTIONLESS, NULL, 0, 0)
FLAT(plane_nested, plane, SIGNORINI_METHOD_SOR_NESTED, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_diagonal, plane, SIGNORINI_METHOD_SOR_DIAGONAL, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_lemke, plane, SIGNORINI_METHOD_LEMKE, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_pivoting, plane, SIGNORINI_METHOD_BLOCK_PIVOTING, SIGNORINI_LAW_FRICTIONLESS, NULL, 0, 0)
FLAT(plane_newton, plane, SIGNORINI_METHOD_NEWTON, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_path, plane, SIGNORINI_METHOD_PATH, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 0)
FLAT(plane_tresca, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_TRESCA, w->plane.mu, 0, 0)
FLAT(plane_cohesive, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COHESIVE, w->cohesion, 0, 0)
FLAT(plane_tied, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_BY_PAIR, w->ties, 0, 0)
FLAT(plane_others, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->plane.mu, 0, 1)
FLAT(plane_proof, plane, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->plane.mu, 1, 0)
FLAT(space_auto, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->space.mu, 0, 0)
FLAT(space_smooth, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_FRICTIONLESS, NULL, 0, 0)
FLAT(space_nested, space, SIGNORINI_METHOD_SOR_NESTED, SIGNORINI_LAW_COULOMB, w->space.mu, 0, 0)
FLAT(space_newton, space, SIGNORINI_METHOD_NEWTON, SIGNORINI_LAW_COULOMB, w->space.mu, 0, 0)
FLAT(space_path, space, SIGNORINI_METHOD_PATH, SIGNORINI_LAW_COULOMB, w->space.mu, 0, 0)
FLAT(space_ellipse, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_ORTHOTROPIC, w->ellipses, 0, 0)
FLAT(space_collinear, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR, w->ellipses,
     0, 0)
FLAT(space_others, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->space.mu, 0, 1)
FLAT(space_proof, space, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->space.mu, 1, 0)
FLAT(small_auto, small, SIGNORINI_METHOD_AUTO, SIGNORINI_LAW_COULOMB, w->small.mu, 0, 0)

/* The matrix of the chain as flexibility. */
static int32_t flexibility(struct world *w)
{
    const chain *c = &w->plane;
    return solve_flexibility(2, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB,
                                       c->mu, NULL, NULL, w->d, w->F, w->state, NULL, NULL);
}

/*
 * A flexibility that does not feel half of the forces, of pairs with and without ties: rounds with springs, in which ties
 * are taken out before Newton's method begins, are the calls that stand deepest on the stack.
 */
static int32_t flexibility_tied(struct world *w)
{
    enum { PAIRS = 50, SIZE = 2 * PAIRS, RANK = PAIRS + 1 };
    static const int32_t laws[] = {SIGNORINI_LAW_COULOMB, SIGNORINI_LAW_TRESCA, SIGNORINI_LAW_COHESIVE,
                                   SIGNORINI_LAW_COULOMB, SIGNORINI_LAW_FRICTIONLESS, SIGNORINI_LAW_TIED};
    static double W[SIZE * SIZE], factor[SIZE * RANK], q[SIZE], gap[PAIRS], law[4 * PAIRS];
    uint64_t seed = 56;
    for (int i = 0; i < SIZE * RANK; i++) factor[i] = chain_draw(&seed);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double *row = factor + RANK * (i % SIZE), *column = factor + RANK * (i / SIZE);
        W[i] = 0;
        for (int k = 0; k < RANK; k++) W[i] += row[k] * column[k];
    }
    for (int i = 0; i < SIZE; i++) q[i] = chain_draw(&seed);
    for (int pair = 0; pair < PAIRS; pair++) {
        double *own = law + 4 * pair;
        own[0] = laws[pair % 6];
        own[1] = pair % 6 < 4 ? 0.3 : 0;
        own[2] = pair % 6 == 2 ? 0.2 : 0;
        own[3] = pair % 6 == 2 ? 0.1 : 0;
        gap[pair] = pair % 3 ? 0 : 0.05;
    }
    return solve_flexibility(2, PAIRS, W, SIZE, q, gap, SIGNORINI_LAW_BY_PAIR, law, NULL, NULL, w->d, w->F,
                             w->state, NULL, NULL);
}

/* Models that keep a matrix of more than a megabyte, more than a call has in reserve before it asks for any. */
static int32_t wide_models(struct world *w)
{
    const chain *c = &w->wide;
    signorini_model *flexible = NULL, *condensed = NULL, *two = NULL;
    int32_t status = signorini_model_new_flexibility(c->dim, c->pairs, c->K, c->n, &flexible);
    if (!status) status = signorini_model_new_condensed(c->dim, c->pairs, c->K, c->n, NULL, &condensed);
    if (!status)
        status = signorini_model_new_two_body(c->dim, c->pairs, c->K, c->n, c->K, c->n, NULL, &two);
    signorini_model_free(flexible);
    signorini_model_free(condensed);
    signorini_model_free(two);
    return status;
}

/* The flexibility as a sparse one, cut into two islands: parts on the diagonal of a definite matrix are definite. */
static int32_t flexibility_sparse(struct world *w)
{
    const chain *c = &w->plane;
    signorini_sparse W = {.struct_size = sizeof W, .index_bytes = 8, .size = c->n,
                          .col_start = w->W_start, .row = w->W_row, .values = w->K};
    const int64_t cut = 2 * (PLANE / 3);
    for (int64_t j = 0; j < c->n; j++) {
        w->W_start[j] = W.nnz;
        for (int64_t i = j; i < c->n; i++) {
            if (c->K[i + c->n * j] == 0 || (i < cut) != (j < cut)) continue;
            w->W_row[W.nnz] = i;
            w->K[W.nnz++] = c->K[i + c->n * j];
        }
    }
    w->W_start[c->n] = W.nnz;
    return solve_flexibility_sparse(2, c->pairs, &W, c->f, c->gap, SIGNORINI_LAW_COULOMB,
                                              c->mu, NULL, NULL, w->d, w->F, w->state, NULL, NULL);
}

/* A refusal, with its sentence. */
static int32_t refusal(struct world *w)
{
    const double kept = w->plane.K[17];
    w->plane.K[17] = NAN;
    const int32_t status = plane_auto(w);
    w->plane.K[17] = kept;
    return status;
}

/* No equilibrium, and the motion of escape. */
static int32_t escape(struct world *w)
{
    chain *c = &w->loose;
    double motion[2 * SMALL], away[2 * SMALL];
    signorini_extra extra;
    int32_t status = signorini_extra_default(&extra, sizeof extra);
    if (status) return status;
    extra.motion = motion;
    extra.escape = away;
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, NULL, c->d, c->F, c->state, NULL, &extra);
}

static int32_t certified(struct world *w)
{
    chain *c = &w->space;
    const int32_t status = space_auto(w);
    if (status) return status;
    return certify_condensed(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                             NULL, 1e-8, c->d, c->F, c->state, NULL);
}

static int32_t proved(struct world *w)
{
    chain *c = &w->space;
    const int32_t status = space_auto(w);
    if (status) return status;
    return prove_condensed(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, c->d, NULL, c->F, w->radius, NULL);
}

static int32_t lcp(struct world *w)
{
    int32_t status = signorini_lcp_solve(w->plane.n, w->plane.K, w->plane.n, w->q, NULL, NULL, w->w, w->z,
                                         NULL, NULL);
    if (status) return status;
    return lemke(w->plane.n, w->plane.K, w->plane.n, w->q, NULL, NULL, w->w, w->z,
                               NULL, NULL);
}

/* ---- Files --------------------------------------------------------------------------------- */

static int32_t files(struct world *w)
{
    chain *c = &w->plane;
    signorini_problem *problem = NULL;
    const char *const path = "out_of_memory.mtx";
    int32_t status = signorini_problem_write(path, c->dim, c->pairs, c->K, c->n, c->f, c->gap,
                                             SIGNORINI_LAW_COULOMB, c->mu, NULL, "a remark");
    if (!status) status = signorini_problem_read(path, &problem);
    signorini_problem_free(problem);
    remove(path);
    return status;
}

static int32_t lcp_files(struct world *w)
{
    signorini_problem *problem = NULL;
    const char *const path = "out_of_memory_lcp.mtx";
    int32_t status = signorini_lcp_write(path, w->plane.n, w->plane.K, w->plane.n, w->q, NULL, NULL);
    if (!status) status = signorini_problem_read(path, &problem);
    signorini_problem_free(problem);
    remove(path);
    return status;
}

static int32_t absent_file(struct world *w)
{
    signorini_problem *problem = NULL;
    (void)w;
    return signorini_problem_read("no/such/file.mtx", &problem);
}

/* ---- Models -------------------------------------------------------------------------------- */

static int32_t condensed_model(struct world *w)
{
    chain *c = &w->plane;
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_condensed(c->dim, c->pairs, c->K, c->n, NULL, &model);
    if (!status)
        status = signorini_model_solve(model, 3, w->more, NULL, w->gap, SIGNORINI_LAW_COULOMB, w->mu,
                                       NULL, NULL, w->d, w->F, w->state, NULL, NULL, NULL);
    if (!status) status = copy_stiffness(model, w->K);
    if (!status) status = signorini_model_condensed_load(model, w->more, NULL, w->short_load);
    if (!status) status = signorini_model_recover(model, 1, w->more, NULL, w->d, w->u);
    if (!status) status = signorini_model_nodal_forces(model, w->F, w->u);
    if (!status)
        status = signorini_model_certify(model, w->more, NULL, w->gap, SIGNORINI_LAW_COULOMB, w->mu,
                                         NULL, 1e-8, w->d, NULL, NULL, NULL);
    if (!status)
        status = signorini_model_write(model, "out_of_memory_case.mtx", w->more, NULL, w->gap,
                                       SIGNORINI_LAW_COULOMB, w->mu, NULL, NULL);
    remove("out_of_memory_case.mtx");
    signorini_model_free(model);
    return status;
}

/* Load cases of one call on two threads, three on each. */
static int32_t two_threads(struct world *w)
{
    enum { CASES = 6 };
    chain *c = &w->small;
    double loads[CASES * 2 * SMALL], gaps[CASES * SMALL], d[CASES * 2 * SMALL], F[CASES * 2 * SMALL];
    int32_t state[CASES * SMALL], status_of_case[CASES];
    signorini_model *model = NULL;
    signorini_settings settings;
    for (int k = 0; k < CASES; k++) {
        for (int i = 0; i < 2 * SMALL; i++) loads[2 * SMALL * k + i] = (1 + 0.1 * k) * c->f[i];
        memcpy(gaps + SMALL * k, c->gap, SMALL * sizeof *gaps);
    }
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    settings.threads = 2;
    if (!status) status = signorini_model_new_condensed(c->dim, c->pairs, c->K, c->n, NULL, &model);
    if (!status)
        status = signorini_model_solve(model, CASES, loads, NULL, gaps, SIGNORINI_LAW_COULOMB, w->mu,
                                       NULL, &settings, d, F, state, status_of_case, NULL, NULL);
    signorini_model_free(model);
    return status;
}

/* A problem whose products two threads share. */
static int32_t one_on_two_threads(struct world *w)
{
    const chain *c = &w->wide;
    signorini_settings settings;
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    settings.threads = 2;
    if (!status)
        status = signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB,
                                 c->mu, NULL, &settings, w->d, w->F, w->state, NULL, NULL);
    return status;
}

/* A reduction that two threads share. */
static int32_t shared_reduction(struct world *w)
{
    const lattice *l = &w->cube;
    signorini_model *model = NULL;
    signorini_settings settings;
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    settings.threads = 2;
    if (!status)
        status = signorini_model_new_sparse(&l->K, l->n_fixed, l->fixed, &l->pairs, &settings,
                                                   &model);
    signorini_model_free(model);
    return status;
}

static int32_t two_bodies(struct world *w)
{
    chain *c = &w->space;
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_two_body(c->dim, c->pairs, c->K, c->n, c->K, c->n, NULL, &model);
    if (!status)
        status = signorini_model_solve(model, 1, w->load, NULL, w->gap, SIGNORINI_LAW_COULOMB, w->mu,
                                       NULL, NULL, w->d, w->F, w->state, NULL, NULL, NULL);
    if (!status) status = signorini_model_recover(model, 1, w->load, NULL, w->d, w->u);
    signorini_model_free(model);
    return status;
}

/* Calls that are one series, in which every second pair stays open. */
static int32_t series(struct world *w)
{
    static double gap[64];
    chain *c = &w->space;
    signorini_model *model = NULL;
    signorini_settings settings;
    for (int64_t pair = 0; pair < c->pairs && pair < 64; pair++)
        gap[pair] = pair % 2 ? 10 : c->gap[pair];
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    settings.warm_start = SIGNORINI_START_PREVIOUS;
    if (!status) status = signorini_model_new_condensed(c->dim, c->pairs, c->K, c->n, NULL, &model);
    for (int step = 0; step < 3 && !status; step++)
        status = signorini_model_solve(model, 1, c->f, NULL, gap, SIGNORINI_LAW_COULOMB, c->mu, NULL,
                                       &settings, w->d, w->F, w->state, NULL, NULL, NULL);
    signorini_model_free(model);
    return status;
}

static signorini_sparse matrix_of(const struct brick_mesh *mesh)
{
    return (signorini_sparse){.struct_size = sizeof(signorini_sparse), .index_bytes = 4,
                              .triangle = SIGNORINI_TRIANGLE_FULL, .size = mesh->dofs,
                              .nnz = mesh->starts[mesh->dofs], .col_start = mesh->starts,
                              .row = mesh->rows, .values = mesh->values};
}

/* Each top node of the lower block against a plane; many load cases in full space or condensed. */
static int32_t sparse_cases(struct world *w, int64_t cases, int32_t full_space)
{
    const signorini_sparse K = matrix_of(w->mesh);
    int64_t *const slaves = w->slaves, *const fixed = w->more_fixed;
    int64_t n_fixed = w->n_fixed;
    double *const normals = w->normals;
    signorini_model *model = NULL;
    signorini_settings settings;
    for (int j = 0, pair = 0; j <= 4; j++)
        for (int i = 0; i <= 4; i++, pair++) {
            for (int axis = 0; axis < 3; axis++)
                slaves[3 * pair + axis] = 3 * brick_node(w->mesh, LOWER, i, j, 3) + axis;
            normals[3 * pair + 2] = 1;
        }
    memcpy(fixed, w->fixed, sizeof w->fixed);
    /* The upper block stands on its top. */
    for (int j = 0; j <= 5; j++)
        for (int i = 0; i <= 5; i++)
            fixed[n_fixed++] = 3 * brick_node(w->mesh, UPPER, i, j, 3) + 2;
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 3, .count = 25,
                                   .slaves = slaves, .normals = normals};
    int32_t status = signorini_settings_default(&settings, sizeof settings);
    settings.full_space = full_space;
    if (!status)
        status = signorini_model_new_sparse(&K, n_fixed, fixed, &pairs, &settings, &model);
    if (!status)
        status = signorini_model_solve(model, cases, w->loads, NULL, w->gap, SIGNORINI_LAW_COULOMB,
                                       w->mu, NULL, NULL, w->d, w->F, w->state, NULL, NULL, NULL);
    if (!status) status = signorini_model_recover(model, 1, w->load, NULL, w->d, w->u);
    if (!status) status = signorini_model_recover(model, cases, w->loads, NULL, w->d, w->many);
    if (!status) status = signorini_model_nodal_forces(model, w->F, w->u);
    signorini_model_free(model);
    return status;
}

static int32_t sparse_model(struct world *w)
{
    return sparse_cases(w, 1, 0);
}

static int32_t sparse_many(struct world *w)
{
    return sparse_cases(w, MANY, 0);
}

static int32_t full_space_cases(struct world *w)
{
    return sparse_cases(w, 2, 1);
}

/* A node on two planes: rows that depend on each other. */
static int32_t dependent_rows(struct world *w)
{
    static const int64_t starts[] = {0, 1, 2, 3, 4}, rows[] = {0, 1, 2, 3};
    static const double springs[] = {2, 2, 2, 2};
    static const int64_t twice[] = {0, 1, 0, 1};
    static const double planes[] = {0, -1, 1, 0}, load[] = {1, -1, 0, 0}, gap[] = {0, 0};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = 4, .nnz = 4,
                                .col_start = starts, .row = rows, .values = springs};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = 2,
                                   .slaves = twice, .normals = planes};
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_sparse(&K, 0, NULL, &pairs, NULL, &model);
    if (!status)
        status = signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, w->mu, NULL,
                                       NULL, w->d, w->F, NULL, NULL, NULL, NULL);
    signorini_model_free(model);
    return status;
}

/* A rod on two pairs by degree of freedom, whose ends follow from its middle by a chain of equations. */
static int32_t equations(struct world *w)
{
    enum { CHAIN = 50 };
    static const int64_t starts[] = {0, 1, 2, 3, 4}, rows[] = {0, 1, 2, 3}, pair_start[] = {0, 2, 4};
    static const double springs[] = {2, 2, 2, 2}, load[] = {1, -1, 0, 0}, gap[] = {0, 0};
    static const double down[] = {0, -1, 0, -1}, vectors[] = {1, 0, 0, 1, 1, 0, 0, 1};
    const int64_t ends[] = {0, 100 + CHAIN - 1, 2, 3};
    int64_t dependent[CHAIN], start[CHAIN + 1], dofs[CHAIN];
    double ones[CHAIN];
    for (int64_t i = 0; i < CHAIN; i++) {
        dependent[i] = 100 + i;
        start[i] = i;
        dofs[i] = i ? 99 + i : 1;
        ones[i] = 1;
    }
    start[CHAIN] = CHAIN;
    const signorini_equations chain = {.struct_size = sizeof chain, .count = CHAIN, .dependent = dependent,
                                       .start = start, .dofs = dofs, .coefficients = ones};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = 4, .nnz = 4,
                                .col_start = starts, .row = rows, .values = springs};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = 2, .normals = down,
                                   .row_start = pair_start, .row_nodes = ends, .row_vectors = vectors,
                                   .equations = &chain};
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_sparse(&K, 0, NULL, &pairs, NULL, &model);
    if (!status)
        status = signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, w->mu, NULL,
                                       NULL, w->d, w->F, NULL, NULL, NULL, NULL);
    signorini_model_free(model);
    return status;
}

/* Products with the matrix of the chain, and with the inverse of its diagonal. */
static int32_t product(void *user, const double *x, double *y)
{
    const chain *c = user;
    for (int64_t i = 0; i < c->n; i++) {
        y[i] = 0;
        for (int64_t j = 0; j < c->n; j++) y[i] += c->K[i + c->n * j] * x[j];
    }
    return 0;
}

static int32_t inverse(void *user, const double *x, double *y)
{
    const chain *c = user;
    for (int64_t i = 0; i < c->n; i++) y[i] = x[i] / c->K[i + c->n * i];
    return 0;
}

static int32_t solve_by(struct world *w, const signorini_operator *K)
{
    const chain *c = &w->plane;
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_operator(K, &model);
    if (!status)
        status = signorini_model_solve(model, 1, c->f, NULL, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                                       NULL, NULL, w->d, w->F, w->state, NULL, NULL, NULL);
    signorini_model_free(model);
    return status;
}

static int32_t operator_model(struct world *w)
{
    chain *c = &w->plane;
    const signorini_operator K = {.struct_size = sizeof K, .dim = 2, .pairs = c->pairs,
                                  .stiffness = product, .inverse = inverse, .user = c};
    return solve_by(w, &K);
}

/* The inverse of the diagonal with springs, as the preconditioner of all unknowns. */
static int32_t precondition(void *user, const int32_t *held, const double *springs, int32_t changed,
                            const double *r, double *z)
{
    const chain *c = user;
    (void)held, (void)changed;
    for (int64_t i = 0; i < c->n; i++)
        z[i] = r[i] / (c->K[i + c->n * i] + (i % 2 ? springs[i / 2] : 0));
    return 0;
}

static int32_t preconditioned_model(struct world *w)
{
    chain *c = &w->plane;
    double units[2 * PLANE];
    int64_t place[2 * PLANE];
    for (int64_t i = 0; i < c->n; i++) place[i] = i, units[i] = c->K[i + c->n * i];
    const signorini_operator K = {.struct_size = sizeof K, .dim = 2, .pairs = c->pairs,
                                  .stiffness = product, .units = units, .user = c,
                                  .unknowns = c->n, .place = place, .precondition = precondition};
    return solve_by(w, &K);
}

/* ---- Surfaces ------------------------------------------------------------------------------ */

/* From two surfaces to a file for ParaView. */
static int32_t surfaces_by(struct world *w, int32_t pairing)
{
    const struct brick_mesh *mesh = w->mesh;
    const signorini_sparse K = matrix_of(mesh);
    signorini_surface_settings settings;
    signorini_surface_pairs *contact = NULL;
    signorini_model *model = NULL;
    const signorini_mesh cells = {.struct_size = sizeof cells, .dim = 3, .nodes = mesh->nodes,
                                  .coordinates = mesh->at[0], .cells = mesh->bricks,
                                  .cell_type = 12, .cell_nodes = mesh->corners[0]};
    signorini_resultant sum = {.struct_size = sizeof sum};
    int32_t status = signorini_surface_settings_default(&settings, sizeof settings);
    settings.pairing = pairing;
    if (!status)
        status = signorini_surface_pair(3, mesh->nodes, mesh->at[0], &w->bottom, &w->top, &settings,
                                        &contact);
    if (!status)
        status = signorini_model_new_sparse(&K, w->n_fixed, w->fixed, surface_data(contact).rows, NULL,
                                            &model);
    if (!status)
        status = signorini_model_solve(model, 1, w->load, NULL, surface_data(contact).gaps,
                                       SIGNORINI_LAW_COULOMB, w->mu, NULL, NULL, w->d, w->F,
                                       w->state, NULL, NULL, NULL);
    if (!status) status = signorini_model_recover(model, 1, w->load, NULL, w->d, w->u);
    if (!status)
        status = signorini_surface_resultant(contact, NULL, w->d, w->F, NULL, &sum);
    const signorini_zone zone = {.struct_size = sizeof zone, .contact = contact, .d = w->d, .F = w->F,
                                 .state = w->state};
    if (!status) status = signorini_mesh_write("out_of_memory.vtu", &cells, w->u, 1, &zone, 0, NULL);
    if (!status) status = signorini_mesh_write("out_of_memory.vtu", &cells, w->u, 0, NULL, 0, NULL);
    remove("out_of_memory.vtu");
    signorini_model_free(model);
    signorini_surface_free(contact);
    return status;
}

static int32_t mortar_surfaces(struct world *w)
{
    return surfaces_by(w, SIGNORINI_PAIRING_DUAL_MORTAR);
}

static int32_t node_surfaces(struct world *w)
{
    return surfaces_by(w, SIGNORINI_PAIRING_NODE_TO_SURFACE);
}

static int32_t obstacle(struct world *w)
{
    const struct brick_mesh *mesh = w->mesh;
    const signorini_obstacle plane = {.struct_size = sizeof plane, .kind = SIGNORINI_OBSTACLE_PLANE,
                                      .direction = {0, 0, -1}};
    signorini_surface_pairs *contact = NULL;
    const int32_t status = signorini_surface_pair_obstacle(3, mesh->nodes, mesh->at[0], &w->top,
                                                           &plane, NULL, &contact);
    signorini_surface_free(contact);
    return status;
}

/* Nodes moved onto the other side, and what has passed through it. */
static int32_t moved_surfaces(struct world *w)
{
    const struct brick_mesh *mesh = w->mesh;
    signorini_surface_pairs *contact = NULL;
    signorini_penetration found = {.struct_size = sizeof found};
    int32_t status = signorini_surface_pair(3, mesh->nodes, mesh->at[0], &w->bottom, &w->top, NULL, &contact);
    for (int64_t i = 0; i < mesh->dofs; i++) {
        w->d[i] = mesh->at[0][i];
        w->u[i] = 0;
    }
    if (!status) status = signorini_surface_adjust(contact, 1, w->d);
    if (!status) status = signorini_surface_penetration(contact, w->u, &found);
    signorini_surface_free(contact);
    return status;
}

/* A surface on an obstacle as a zone with a law, and its table. */
static int32_t joined_zones(struct world *w)
{
    const struct brick_mesh *mesh = w->mesh;
    const signorini_obstacle plane = {.struct_size = sizeof plane, .kind = SIGNORINI_OBSTACLE_PLANE,
                                      .direction = {0, 0, -1}};
    signorini_contact_zone zone = {.struct_size = sizeof zone, .law = SIGNORINI_LAW_TIED, .name = "top"};
    signorini_surface_pairs *contact = NULL, *joined = NULL;
    int32_t status = signorini_surface_pair_obstacle(3, mesh->nodes, mesh->at[0], &w->top, &plane, NULL,
                                                     &contact);
    zone.contact = contact;
    if (status == 0) status = signorini_surface_join(1, &zone, &joined);
    if (status == 0) {
        static const double zeros[3 * 1024];
        static const int32_t open[1024];
        char text[512];
        status = surface_data(joined).pairs > 1024 ? -1 : signorini_surface_table(joined, zeros, zeros, open, text, sizeof text);
    }
    signorini_surface_free(joined);
    signorini_surface_free(contact);
    return status;
}

static const struct scenario scenarios[] = {
    {"plane, auto", plane_auto, 0, 0},
    {"plane, no friction", plane_smooth, 0, 0},
    {"plane, nested sweeps", plane_nested, 0, 0},
    {"plane, diagonal sweeps", plane_diagonal, 0, 0},
    {"plane, Lemke", plane_lemke, 0, 0},
    {"plane, block pivoting", plane_pivoting, 0, 0},
    {"plane, Newton", plane_newton, 0, 0},
    {"plane, path", plane_path, 0, 0},
    {"plane, Tresca", plane_tresca, 0, 0},
    {"plane, cohesion", plane_cohesive, 0, 0},
    {"plane, ties", plane_tied, 0, 0},
    {"plane, other solutions", plane_others, 0, 0},
    {"plane, proof", plane_proof, 0, 0},
    {"space, auto", space_auto, 0, 0},
    {"space, no friction", space_smooth, 0, 0},
    {"space, nested sweeps", space_nested, 0, 0},
    {"space, Newton", space_newton, 0, 0},
    {"space, path", space_path, 0, 0},
    {"space, ellipse", space_ellipse, 0, 0},
    {"space, ellipse, collinear", space_collinear, 0, 0},
    {"space, other solutions", space_others, 0, 0},
    {"space, proof", space_proof, 0, 0},
    {"six pairs", small_auto, 0, 0},
    {"flexibility", flexibility, 0, 0},
    {"flexibility, ties", flexibility_tied, 0, 0},
    {"models of 200 pairs", wide_models, 0, 0},
    {"sparse flexibility", flexibility_sparse, 0, 0},
    {"certify", certified, 0, 0},
    {"prove", proved, 0, 0},
    {"LCP", lcp, 0, 0},
    {"refusal", refusal, -3, 0},
    {"no equilibrium, escape", escape, SIGNORINI_STATUS_NO_EQUILIBRIUM, 0},
    {"write and read", files, 0, 0},
    {"write and read an LCP", lcp_files, 0, 0},
    {"absent file", absent_file, SIGNORINI_STATUS_FILE, 0},
    {"condensed model, three cases", condensed_model, 0, 0},
    {"load steps in a series", series, 0, 0},
    {"load cases on two threads", two_threads, 0, TWO_THREADS},
    {"one problem on two threads", one_on_two_threads, 0, TWO_THREADS},
    {"reduction on two threads", shared_reduction, 0, TWO_THREADS},
    {"two bodies", two_bodies, 0, 0},
    {"sparse model", sparse_model, 0, 0},
    {"sparse model, many cases", sparse_many, 0, 0},
    {"full space, two cases", full_space_cases, 0, 0},
    {"dependent rows", dependent_rows, 0, 0},
    {"equations", equations, 0, 0},
    {"operator", operator_model, 0, 0},
    {"operator with a preconditioner", preconditioned_model, 0, 0},
    {"mortar surfaces, .vtu", mortar_surfaces, 0, 0},
    {"node-to-surface, .vtu", node_surfaces, 0, 0},
    {"obstacle", obstacle, 0, 0},
    {"joined zones, table", joined_zones, 0, 0},
    {"moved surfaces", moved_surfaces, 0, 0},
    {"new thread: plane, auto", plane_auto, 0, NEW_THREAD},
    {"new thread: space, no friction", space_smooth, 0, NEW_THREAD},
    {"new thread: LCP", lcp, 0, NEW_THREAD},
    {"new thread: condensed model", condensed_model, 0, NEW_THREAD},
    {"new thread: mortar surfaces", mortar_surfaces, 0, NEW_THREAD},
    {NULL, NULL, 0, 0},
};

#endif
