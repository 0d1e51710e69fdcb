/*
 * Two blocks: the upper one lies on the lower one, held by nothing but contact and friction. It is
 * pressed down in the middle, then twisted more and more.
 *
 *        z                 | press
 *        |            +----v----+
 *     30 |            |  upper  |<- twist about z, by forces on its top face
 *      0 |        +---+=========+---+      contact: 9 x 9 pairs of nodes, 80 mm by 80 mm
 *        |        |      lower      |
 *    -40 |        +-----------------+      held
 *                -50 -40   0   40  50   x, y; mm, N, MPa
 *
 * This is a host program of the kind that the library is for. It meshes and assembles both blocks
 * into one sparse matrix (brick_mesh.c). The library makes a model of it (brick_contact.c) and
 * solves one load step after the other (`run`): friction remembers the slip of the step before.
 * The rest shows the answers and checks them against statics: the upper block has six rigid motions,
 * so that contact must give exactly the opposite of the six applied resultants.
 *
 *     two_blocks [DIR]
 *
 * With DIR, it also writes DIR/two_blocks.csv, the pairs after the last step that has a solution, and
 * DIR/two_blocks.vtk, the blocks in that step, for ParaView or alike. It returns 0 if every check
 * passed. two_blocks.f90 and two_blocks.py are the same program.
 */

#include "brick_contact.h"
#include "brick_vtk.h"
#include "../common/checks.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LOWER, UPPER, /* the boxes */
    WIDE = 10, DEEP = 4,    /* cells of the lower block, of 10 mm */
    NARROW = 8, HIGH = 3,   /* of the upper block */
    LINE = NARROW + 1,      /* nodes along a side of the contact */
    PAIRS = LINE * LINE,
    SIZE = 3 * PAIRS,
    NODES = (WIDE + 1) * (WIDE + 1) * (DEEP + 1) + LINE * LINE * (HIGH + 1),
    DOFS = 3 * NODES,
    FIXED = 3 * (WIDE + 1) * (WIDE + 1),
    STEPS = 5,
};

static const double pitch = 10.0;                    /* mm */
static const struct material steel = {210000.0, 0.3}; /* MPa */
static const double mu = 0.3;
static const double press = 40000.0; /* N */

/* The twist of each step, N mm. */
static const double twist[STEPS] = {0.0, 50e3, 100e3, 150e3, 200e3};
/* Rounding of sums of some hundred forces; errors of the host would be of order 1. */
static const double tiny = 1e-9;

struct answer {
    double d[SIZE], F[SIZE]; /* (n, t1, t2) of each pair; mm, N */
    int32_t state[PAIRS];
};

/* ---- The host ------------------------------------------------------------------------------ */

static struct brick_mesh *new_mesh(void)
{
    double wide[WIDE + 1], narrow[NARROW + 1], deep[DEEP + 1], high[HIGH + 1];

    for (int i = 0; i <= WIDE; i++)
        wide[i] = pitch * (i - WIDE / 2);
    for (int i = 0; i <= NARROW; i++)
        narrow[i] = pitch * (i - NARROW / 2);
    for (int i = 0; i <= DEEP; i++)
        deep[i] = pitch * (i - DEEP);
    for (int i = 0; i <= HIGH; i++)
        high[i] = pitch * i;
    const struct box boxes[2] = {{{WIDE, WIDE, DEEP}, {wide, wide, deep}},
                                 {{NARROW, NARROW, HIGH}, {narrow, narrow, high}}};
    return brick_mesh_new(2, boxes, steel);
}

/* The pairs row by row, x first; the bottom of the lower block is held. */
static int32_t new_model(const struct brick_mesh *mesh, struct contact *contact,
                         signorini_model **model)
{
    const int rim = (WIDE - NARROW) / 2;
    int64_t fixed[FIXED];

    for (int pair = 0; pair < PAIRS; pair++) {
        const int i = pair % LINE, j = pair / LINE;
        contact->lower[pair] = brick_node(mesh, LOWER, i + rim, j + rim, DEEP);
        contact->upper[pair] = brick_node(mesh, UPPER, i, j, 0);
    }
    for (int i = 0; i < FIXED; i++) /* the nodes of the lowest layer have the first numbers */
        fixed[i] = i;
    return contact_model(mesh, contact, FIXED, fixed, model);
}

/* Forces on the top of the upper block: the press on the inner 5 x 5 nodes, the twist on all of
 * them, across the radius and in proportion to it. */
static void loads(const struct brick_mesh *mesh, double moment, double f[DOFS])
{
    const double middle = 2.0 * pitch;
    double polar = 0.0; /* sum of the squared radii */
    int inner = 0;

    for (int i = 0; i < DOFS; i++)
        f[i] = 0.0;
    for (int i = 0; i < PAIRS; i++) {
        const double *at = mesh->at[brick_node(mesh, UPPER, i % LINE, i / LINE, HIGH)];
        polar += at[0] * at[0] + at[1] * at[1];
        inner += fabs(at[0]) <= middle && fabs(at[1]) <= middle;
    }
    for (int i = 0; i < PAIRS; i++) {
        const int32_t node = brick_node(mesh, UPPER, i % LINE, i / LINE, HIGH);
        const double *at = mesh->at[node];
        f[3 * node] = -moment * at[1] / polar;
        f[3 * node + 1] = moment * at[0] / polar;
        if (fabs(at[0]) <= middle && fabs(at[1]) <= middle)
            f[3 * node + 2] = -press / inner;
    }
}

/* ---- What is seen -------------------------------------------------------------------------- */

/* One letter for each pair, seen from above. */
static void print_map(const int32_t state[PAIRS])
{
    for (int j = LINE - 1; j >= 0; j--) {
        fputs("        ", stdout);
        for (int i = 0; i < LINE; i++)
            printf(" %c", "os."[state[i + LINE * j]]);
        putchar('\n');
    }
}

/* Slip works its way from the rim to the middle: how far it has come. */
static double innermost_slip(const struct brick_mesh *mesh, const struct contact *contact,
                             const int32_t state[PAIRS])
{
    double radius = HUGE_VAL;
    for (int pair = 0; pair < PAIRS; pair++) {
        const double *at = mesh->at[contact->lower[pair]];
        if (state[pair] == SIGNORINI_STATE_SLIP)
            radius = fmin(radius, hypot(at[0], at[1]));
    }
    return radius;
}

/* ---- What is checked ----------------------------------------------------------------------- */

/* The upper block floats: contact forces and loads on it have no resultant. Returns the largest
 * component of force over the press, or of moment over the press times the contact's half side. */
static double imbalance(const struct brick_mesh *mesh, const signorini_model *model,
                        const double F[SIZE], const double f[DOFS], double force[3],
                        double moment[3])
{
    const double arm = pitch * NARROW / 2;
    static double nodal[DOFS];
    double applied_force[3], applied_moment[3], worst = 0.0;

    if (signorini_model_nodal_forces(model, F, nodal) != 0)
        return HUGE_VAL;
    brick_resultant(mesh, UPPER, nodal, force, moment);
    brick_resultant(mesh, UPPER, f, applied_force, applied_moment);
    for (int axis = 0; axis < 3; axis++) {
        worst = fmax(worst, fabs(force[axis] + applied_force[axis]) / press);
        worst = fmax(worst, fabs(moment[axis] + applied_moment[axis]) / (press * arm));
    }
    return worst;
}

/* A quarter turn, (x, y) to (-y, x), brings blocks and loads to themselves, and so the answer:
 * forces of each pair against those of the pair that it turns to, turned; over the largest. */
static double turned_apart(const double F[SIZE])
{
    double worst = 0.0, largest = 0.0;
    for (int j = 0; j < LINE; j++) {
        for (int i = 0; i < LINE; i++) {
            const double *from = &F[3 * (i + LINE * j)];
            const double *to = &F[3 * ((NARROW - j) + LINE * i)];
            worst = fmax(worst, fabs(to[0] - from[0]));
            worst = fmax(worst, fabs(to[1] + from[2]));
            worst = fmax(worst, fabs(to[2] - from[1]));
            largest = fmax(largest, fabs(from[0]));
        }
    }
    return worst / largest;
}

/* The host's own equations, K u = f + contact forces, at all nodes that are not held. */
static double host_residual(const struct brick_mesh *mesh, const double u[DOFS],
                            const double f[DOFS], const double nodal[DOFS])
{
    static double all[DOFS], residual[DOFS];
    double worst = 0.0;

    for (int i = 0; i < DOFS; i++)
        all[i] = f[i] + nodal[i];
    brick_residual(mesh, u, all, residual);
    for (int i = FIXED; i < DOFS; i++)
        worst = fmax(worst, fabs(residual[i]));
    return worst / press;
}

/* ---- Load steps ---------------------------------------------------------------------------- */

static int32_t solve(const signorini_model *model, const double f[DOFS], const double slip0[],
                     struct answer *answer, signorini_report *report)
{
    static double gap[PAIRS], friction[PAIRS];
    signorini_settings settings;

    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-12; /* far below what the checks ask for */
    signorini_report_default(report, sizeof *report);
    for (int pair = 0; pair < PAIRS; pair++) {
        gap[pair] = 0.0;
        friction[pair] = mu;
    }
    return signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, friction, slip0,
                                 &settings, answer->d, answer->F, answer->state, NULL, report,
                                 NULL);
}

/* All steps; `answer` is that of the last one. */
static int run(struct checks *checks, const struct brick_mesh *mesh, const struct contact *contact,
               const signorini_model *model, struct answer *answer)
{
    static double f[DOFS];
    double slip0[2 * PAIRS] = {0.0}, unbalanced = 0.0, excess = 0.0, turned = 0.0;

    puts("\n twist  open slip stick  slip from   contact forces on the upper block     eta  systems\n"
         "   N m                       r, mm     F_x     F_y     F_z, N   M_z, N m");
    for (int step = 0; step < STEPS; step++) {
        double force[3], moment[3];
        signorini_report report;

        loads(mesh, twist[step], f);
        const int32_t status = solve(model, f, slip0, answer, &report);
        if (status != SIGNORINI_STATUS_SOLVED) {
            judge(checks, 0);
            printf("twist of %.0f N m: %s: %s\n", 1e-3 * twist[step],
                   signorini_status_string(status), signorini_last_error());
            return 0;
        }
        unbalanced = fmax(unbalanced, imbalance(mesh, model, answer->F, f, force, moment));
        excess = fmax(excess, contact_excess(PAIRS, answer->F, mu));
        turned = fmax(turned, turned_apart(answer->F));
        printf("%6.0f %5d %4d %5d %10.1f %7.1f %7.1f %10.1f %10.1f %7.0e %8d\n",
               1e-3 * twist[step], (int)report.pairs_open, (int)report.pairs_slipping,
               (int)report.pairs_sticking, innermost_slip(mesh, contact, answer->state), force[0],
               force[1], force[2], 1e-3 * moment[2], report.eta, (int)report.iterations);

        /* Friction remembers: where a pair is now, it sticks in the next step. */
        for (int pair = 0; pair < PAIRS; pair++) {
            slip0[2 * pair] = answer->d[3 * pair + 1];
            slip0[2 * pair + 1] = answer->d[3 * pair + 2];
        }
    }
    puts("\n        The last step from above: o open, s slip, . stick");
    print_map(answer->state);
    putchar('\n');
    judge(checks, unbalanced <= tiny);
    printf("contact forces and loads balance, 3 forces and 3 moments: off by %.0e\n", unbalanced);
    judge(checks, excess <= tiny * press);
    printf("no tension, |F_t| <= mu |F_n|: exceeded by %.0e N\n", excess);
    judge(checks, turned <= tiny);
    printf("a quarter turn changes nothing: off by %.0e of the largest force\n", turned);
    return 1;
}

/* No friction forces can hold a twist of more than mu times the press times the largest radius:
 * the library must not call any answer a solution. */
static void check_limit(struct checks *checks, const struct brick_mesh *mesh,
                        const signorini_model *model, const double slip0[2 * PAIRS])
{
    static double f[DOFS];
    static struct answer answer;
    const double limit = mu * press * sqrt(2.0) * pitch * NARROW / 2;
    signorini_report report;

    loads(mesh, 1.01 * limit, f);
    const int32_t status = solve(model, f, slip0, &answer, &report);
    judge(checks, status > 0);
    printf("twist of %.0f N m, 1 %% more than friction can ever hold: %s\n", 1.01e-3 * limit,
           signorini_status_string(status));
}

/* ---- Files --------------------------------------------------------------------------------- */

static int write_csv(const char *path, const struct brick_mesh *mesh,
                     const struct contact *contact, const struct answer *answer)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fputs("x,y,d_n,d_t1,d_t2,F_n,F_t1,F_t2,state\n", file);
    for (int pair = 0; pair < PAIRS; pair++) {
        const double *at = mesh->at[contact->lower[pair]];
        fprintf(file, "%.1f,%.1f", at[0], at[1]);
        for (int i = 0; i < 3; i++)
            fprintf(file, ",%.12e", answer->d[3 * pair + i]);
        for (int i = 0; i < 3; i++)
            fprintf(file, ",%.12e", answer->F[3 * pair + i]);
        fprintf(file, ",%s\n", state_name(answer->state[pair]));
    }
    const int failed = ferror(file);
    return fclose(file) != 0 || failed ? -1 : 0;
}

/* Displacements of all nodes, and with DIR the files. */
static void finish(struct checks *checks, const char *directory, const struct brick_mesh *mesh,
                   const struct contact *contact, const signorini_model *model,
                   const struct answer *answer)
{
    static double f[DOFS], u[DOFS], nodal[DOFS];
    double area[PAIRS];
    char path[4096];

    loads(mesh, twist[STEPS - 1], f);
    if (signorini_model_recover(model, f, NULL, answer->d, u) != 0 ||
        signorini_model_nodal_forces(model, answer->F, nodal) != 0) {
        judge(checks, 0);
        printf("no displacements: %s\n", signorini_last_error());
        return;
    }
    const double residual = host_residual(mesh, u, f, nodal);
    judge(checks, residual <= tiny);
    printf("K u = f + contact forces at all nodes: off by %.0e of the press\n", residual);
    if (directory == NULL)
        return;

    for (int pair = 0; pair < PAIRS; pair++) {
        const int i = pair % LINE, j = pair / LINE;
        area[pair] = pitch * pitch * (i % NARROW == 0 ? 0.5 : 1.0) * (j % NARROW == 0 ? 0.5 : 1.0);
    }
    snprintf(path, sizeof path, "%s/two_blocks.csv", directory);
    judge(checks, write_csv(path, mesh, contact, answer) == 0);
    printf("%s: %s\n", path, strerror(errno));
    snprintf(path, sizeof path, "%s/two_blocks.vtk", directory);
    judge(checks, write_vtk(path, "two blocks, pressed and twisted; mm, N, MPa", mesh, contact, u,
                            nodal, answer->state, area) == 0);
    printf("%s: %s\n", path, strerror(errno));
}

int main(int argc, char **argv)
{
    static struct answer answer;
    static int32_t lower[PAIRS], upper[PAIRS];
    struct contact contact = {PAIRS, lower, upper};
    struct checks checks = {0, 0};
    signorini_model *model = NULL;

    if (argc > 2) {
        fprintf(stderr, "usage: %s [DIR]\n", argv[0]);
        return EXIT_FAILURE;
    }
    struct brick_mesh *mesh = new_mesh();
    if (mesh == NULL) {
        fputs("not enough memory for the mesh\n", stderr);
        return EXIT_FAILURE;
    }
    const int32_t status = new_model(mesh, &contact, &model);
    if (status != 0) {
        judge(&checks, 0);
        printf("model: %s: %s\n", signorini_status_string(status), signorini_last_error());
    } else if (run(&checks, mesh, &contact, model, &answer)) {
        double slip0[2 * PAIRS];
        for (int i = 0; i < 2 * PAIRS; i++)
            slip0[i] = answer.d[3 * (i / 2) + 1 + i % 2];
        check_limit(&checks, mesh, model, slip0);
        finish(&checks, argc == 2 ? argv[1] : NULL, mesh, &contact, model, &answer);
    }
    signorini_model_free(model);
    brick_mesh_free(mesh);
    return conclude(&checks);
}
