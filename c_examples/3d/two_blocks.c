/*
 * Two blocks: the upper one lies on the lower one, held by nothing but contact and friction. It is
 * pressed in the middle, so that its corners lift, and then twisted more and more. blocks.h has a
 * drawing.
 *
 * This is a host program of the kind that the library is for. It meshes and assembles both blocks
 * into one sparse matrix (blocks.c, brick_mesh.c). The library makes a model of it
 * (brick_contact.c) and solves one load step after the other (`run`): friction remembers the slip
 * of the step before. The rest shows the answers and checks them. The upper block has six rigid
 * motions, so that the contact forces must balance the loads on it exactly, three forces and three
 * moments.
 *
 *     two_blocks [DIR]
 *
 * With DIR, it also writes DIR/two_blocks.csv, the pairs after the last step, and
 * DIR/two_blocks.vtk, the blocks after it, for ParaView or alike. It returns 0 if every check
 * passed. two_blocks.f90 and two_blocks.py are the same program.
 */

#include "blocks.h"
#include "brick_output.h"
#include "../common/checks.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 5 };

static const double mu = 0.6;
static const double twist[STEPS] = {0.0, 100e3, 200e3, 300e3, 400e3}; /* N mm */

/* Rounding of sums of some hundred forces; a wrong sign or a missing force is of order 1. */
static const double tiny = 1e-9;

/* ---- What is checked ----------------------------------------------------------------------- */

struct balance {
    double force[3], moment[3]; /* of contact, on the upper block */
    double off; /* largest sum with the loads, over the press, or over it times half a side */
};

static struct balance balance_of(const struct brick_mesh *mesh, const signorini_model *model,
                                 const double F[SIZE], const double f[DOFS])
{
    const double arm = CELL * NARROW / 2;
    static double nodal[DOFS];
    double force[3], moment[3];
    struct balance balance = {.off = 0.0};

    if (signorini_model_nodal_forces(model, F, nodal) != 0)
        return (struct balance){.off = HUGE_VAL};
    brick_resultant(mesh, UPPER, nodal, balance.force, balance.moment);
    brick_resultant(mesh, UPPER, f, force, moment);
    for (int axis = 0; axis < 3; axis++) {
        balance.off = fmax(balance.off, fabs(balance.force[axis] + force[axis]) / PRESS);
        balance.off = fmax(balance.off, fabs(balance.moment[axis] + moment[axis]) / (PRESS * arm));
    }
    return balance;
}

/* A quarter turn, (x, y) to (-y, x), changes neither blocks nor loads. So it must turn the forces
 * of each pair to those of another pair. Returns the largest difference over the largest force. */
static double turned_apart(const double F[SIZE])
{
    double apart = 0.0, largest = 0.0;

    for (int j = 0; j < LINE; j++) {
        for (int i = 0; i < LINE; i++) {
            const double *from = &F[3 * (i + LINE * j)];
            const double *to = &F[3 * ((NARROW - j) + LINE * i)];
            apart = fmax(apart, fabs(to[0] - from[0]));
            apart = fmax(apart, fabs(to[1] + from[2]));
            apart = fmax(apart, fabs(to[2] - from[1]));
            largest = fmax(largest, fabs(from[0]));
        }
    }
    return apart / largest;
}

/* The host's own equations, K u = f + contact forces, at all nodes that are not held. */
static void check_host(struct checks *checks, const struct brick_mesh *mesh, const double u[DOFS],
                       const double f[DOFS], const double nodal[DOFS])
{
    static double all[DOFS], residual[DOFS];
    double worst = 0.0;

    for (int i = 0; i < DOFS; i++)
        all[i] = f[i] + nodal[i];
    brick_residual(mesh, u, all, residual);
    for (int i = FIXED; i < DOFS; i++)
        worst = fmax(worst, fabs(residual[i]) / PRESS);
    judge(checks, worst <= tiny);
    printf("K u = f + contact forces at all nodes: off by %.0e of the press\n", worst);
}

/* ---- Load steps ---------------------------------------------------------------------------- */

static int32_t solve(const signorini_model *model, const double f[DOFS],
                     const double slip0[2 * PAIRS], const struct answer *answer,
                     signorini_report *report)
{
    double gap[PAIRS], friction[PAIRS];
    signorini_settings settings;

    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-12; /* far below the 1e-9 that the checks ask for */
    signorini_report_default(report, sizeof *report);
    for (int pair = 0; pair < PAIRS; pair++) {
        gap[pair] = 0.0;
        friction[pair] = mu;
    }
    return signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, friction, slip0,
                                 &settings, answer->d, answer->F, answer->state, NULL, report,
                                 NULL);
}

/* Radius of the slipping pair that is nearest to the middle. */
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

static void print_map(const int32_t state[PAIRS])
{
    puts("\n        The last step from above: o open, s slip, . stick\n");
    for (int j = LINE - 1; j >= 0; j--) {
        fputs("       ", stdout);
        for (int i = 0; i < LINE; i++)
            printf(" %c", "os."[state[i + LINE * j]]);
        putchar('\n');
    }
    putchar('\n');
}

/* All steps; the answer is that of the last one, and slip0 its slip. */
static int run(struct checks *checks, const struct brick_mesh *mesh, const struct contact *contact,
               const signorini_model *model, const struct answer *answer, double slip0[2 * PAIRS])
{
    static double f[DOFS];
    double off = 0.0, excess = 0.0, turned = 0.0;

    for (int i = 0; i < 2 * PAIRS; i++)
        slip0[i] = 0.0;
    puts("        pairs         slip from   loads            contact forces on the upper block\n"
         "   open slip stick      r, mm     F_z, N  M_z, N m     F_z, N  M_z, N m       eta");
    for (int step = 0; step < STEPS; step++) {
        signorini_report report;

        blocks_loads(mesh, twist[step], f);
        const int32_t status = solve(model, f, slip0, answer, &report);
        if (status != SIGNORINI_STATUS_SOLVED) {
            judge(checks, 0);
            printf("twist of %.0f N m: %s: %s\n", 1e-3 * twist[step],
                   signorini_status_string(status), signorini_last_error());
            return 0;
        }
        const struct balance balance = balance_of(mesh, model, answer->F, f);
        off = fmax(off, balance.off);
        excess = fmax(excess, contact_excess(PAIRS, answer->F, mu));
        turned = fmax(turned, turned_apart(answer->F));
        printf("%7d %4d %5d %10.1f %10.1f %9.1f %10.1f %9.1f %9.0e\n", (int)report.pairs_open,
               (int)report.pairs_slipping, (int)report.pairs_sticking,
               innermost_slip(mesh, contact, answer->state), -PRESS, 1e-3 * twist[step],
               balance.force[2], 1e-3 * balance.moment[2], report.eta);

        /* Friction remembers: a pair that sticks in the next step stays where it is now. */
        for (int pair = 0; pair < PAIRS; pair++) {
            slip0[2 * pair] = answer->d[3 * pair + 1];
            slip0[2 * pair + 1] = answer->d[3 * pair + 2];
        }
    }
    print_map(answer->state);
    judge(checks, off <= tiny);
    printf("contact forces balance the loads, 3 forces and 3 moments: off by %.0e\n", off);
    judge(checks, excess <= tiny * PRESS);
    printf("no tension, |F_t| <= mu |F_n|: exceeded by %.0e N\n", excess);
    judge(checks, turned <= tiny);
    printf("a quarter turn changes nothing: off by %.0e of the largest force\n", turned);
    return 1;
}

/* Friction holds at most mu times the press at the largest radius. With a larger twist there is no
 * equilibrium, and the library must prove it. */
static void check_limit(struct checks *checks, const struct brick_mesh *mesh,
                        const signorini_model *model, const double slip0[2 * PAIRS])
{
    static double f[DOFS], d[SIZE], F[SIZE];
    static int32_t state[PAIRS];
    const double limit = mu * PRESS * sqrt(2.0) * CELL * NARROW / 2;
    signorini_report report;

    blocks_loads(mesh, 1.01 * limit, f);
    const int32_t status = solve(model, f, slip0, &(struct answer){d, F, state}, &report);
    judge(checks, status == SIGNORINI_STATUS_NO_EQUILIBRIUM);
    printf("twist of %.0f N m, 1 %% more than friction can hold: status %d, %s\n", 1.01e-3 * limit,
           (int)status, signorini_status_string(status));
}

/* ---- Results ------------------------------------------------------------------------------- */

static void report_file(struct checks *checks, const char *path, int result)
{
    judge(checks, result == 0);
    if (result == 0)
        printf("wrote %s\n", path);
    else
        printf("cannot write %s: %s\n", path, strerror(errno));
}

/* The displacements of all nodes, checked, and with a directory the files. */
static void finish(struct checks *checks, const char *directory, const struct brick_mesh *mesh,
                   const struct contact *contact, const signorini_model *model,
                   const struct answer *answer)
{
    static double f[DOFS], u[DOFS], nodal[DOFS];
    double area[PAIRS];
    char path[4096];

    blocks_loads(mesh, twist[STEPS - 1], f);
    if (signorini_model_recover(model, f, NULL, answer->d, u) != 0 ||
        signorini_model_nodal_forces(model, answer->F, nodal) != 0) {
        judge(checks, 0);
        printf("no displacements: %s\n", signorini_last_error());
        return;
    }
    check_host(checks, mesh, u, f, nodal);
    if (directory == NULL)
        return;
    snprintf(path, sizeof path, "%s/two_blocks.csv", directory);
    report_file(checks, path, write_csv(path, mesh, contact, answer));
    blocks_areas(area);
    snprintf(path, sizeof path, "%s/two_blocks.vtk", directory);
    report_file(checks, path, write_vtk(path, "two blocks, pressed and twisted; mm, N, MPa", mesh,
                                        contact, answer->state, area, u, nodal));
}

int main(int argc, char **argv)
{
    static double d[SIZE], F[SIZE], slip0[2 * PAIRS];
    static int32_t state[PAIRS], lower[PAIRS], upper[PAIRS];
    static int64_t fixed[FIXED];
    const struct answer answer = {d, F, state};
    struct contact contact = {0, lower, upper};
    struct checks checks = {0, 0};
    signorini_model *model = NULL;

    if (argc > 2) {
        fprintf(stderr, "usage: %s [DIR]\n", argv[0]);
        return EXIT_FAILURE;
    }
    struct brick_mesh *mesh = blocks_mesh();
    if (mesh == NULL) {
        fputs("not enough memory for the mesh\n", stderr);
        return EXIT_FAILURE;
    }
    blocks_pairs(mesh, &contact);
    blocks_fixed(fixed);
    printf("signorini %s\n\n%d nodes, %d bricks, %d pairs, mu = %.1f, pressed by %.0f N\n\n",
           signorini_version(), (int)mesh->nodes, (int)mesh->bricks, PAIRS, mu, PRESS);

    const int32_t status = contact_model(mesh, &contact, FIXED, fixed, &model);
    if (status != 0) {
        judge(&checks, 0);
        printf("model: %s: %s\n", signorini_status_string(status), signorini_last_error());
    } else if (run(&checks, mesh, &contact, model, &answer, slip0)) {
        check_limit(&checks, mesh, model, slip0);
        finish(&checks, argc == 2 ? argv[1] : NULL, mesh, &contact, model, &answer);
    }
    signorini_model_free(model);
    brick_mesh_free(mesh);
    return conclude(&checks);
}
