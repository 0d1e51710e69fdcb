#include "two_blocks_check.h"

#include <math.h>
#include <stdio.h>

const double twist[STEPS] = {0.0, 100e3, 200e3, 300e3, 400e3};

/* Rounding of sums of some hundred forces; a wrong sign or a missing force is of order 1. */
static const double tiny = 1e-9;

static const double arm = FINE * NARROW / 2; /* half a side of the contact */

/* The library's resultant on the upper block, which is the slave. */
static signorini_resultant resultant_of(const struct check *check, const double slip0[2 * PAIRS],
                                        const double d[SIZE], const double F[SIZE])
{
    signorini_resultant sum = {.struct_size = sizeof sum};
    if (signorini_surface_resultant(check->contact, slip0, d, F, NULL, &sum) != 0)
        sum.force[0] = HUGE_VAL;
    return sum;
}

/* Largest sum of the contact's and the applied forces and moments on the upper block, over the
 * press, or over it times half a side; contact's once by the resultant, once by nodal forces. */
static double unbalanced(const struct check *check, const signorini_resultant *sum,
                         const double F[SIZE], const double f[DOFS])
{
    static double nodal[DOFS];
    double force[3], moment[3], by_nodes[3], moment_by_nodes[3], off = 0.0;

    if (signorini_model_nodal_forces(check->model, F, nodal) != 0)
        return HUGE_VAL;
    brick_resultant(check->mesh, UPPER, nodal, by_nodes, moment_by_nodes);
    brick_resultant(check->mesh, UPPER, f, force, moment);
    for (int axis = 0; axis < 3; axis++) {
        off = fmax(off, fabs(sum->force[axis] + force[axis]) / PRESS);
        off = fmax(off, fabs(sum->moment[axis] + moment[axis]) / (PRESS * arm));
        off = fmax(off, fabs(by_nodes[axis] + force[axis]) / PRESS);
        off = fmax(off, fabs(moment_by_nodes[axis] + moment[axis]) / (PRESS * arm));
    }
    return off;
}

/* A quarter turn, (x, y) to (-y, x), changes neither blocks nor loads. So it must turn the forces
 * of each pair to those of another pair. Returns the largest difference over the largest force.
 * The axes of the pairs are n = -z, t1 = x, t2 = -y. */
static double turned_apart(const double F[SIZE])
{
    double apart = 0.0, largest = 0.0;

    for (int j = 0; j < LINE; j++) {
        for (int i = 0; i < LINE; i++) {
            const double *from = &F[3 * (i + LINE * j)];
            const double *to = &F[3 * ((NARROW - j) + LINE * i)];
            apart = fmax(apart, fabs(to[0] - from[0]));
            apart = fmax(apart, fabs(to[1] - from[2]));
            apart = fmax(apart, fabs(to[2] + from[1]));
            largest = fmax(largest, fabs(from[0]));
        }
    }
    return apart / largest;
}

/* Radius of the slipping pair that is nearest to the middle. */
static double innermost_slip(const struct check *check, const int32_t state[PAIRS])
{
    const double *at = check->pairs.points;
    double radius = HUGE_VAL;

    for (int pair = 0; pair < PAIRS; pair++)
        if (state[pair] == SIGNORINI_STATE_SLIP)
            radius = fmin(radius, hypot(at[3 * pair], at[3 * pair + 1]));
    return radius;
}

struct check check_begin(const struct brick_mesh *mesh, const signorini_surface_pairs *contact,
                         const signorini_model *model)
{
    struct check check = {.mesh = mesh, .contact = contact, .model = model,
                          .pairs = {.struct_size = sizeof check.pairs}};
    signorini_surface_view(contact, &check.pairs);

    printf("signorini %s\n\n%d nodes, %d bricks, mu = %.1f, pressed by %.0f N\n%s\n\n",
           signorini_version(), (int)mesh->nodes, (int)mesh->bricks, MU, PRESS,
           check.pairs.summary);
    judge(&check.checks, check.pairs.pairs == PAIRS);
    printf("a pair for each node of the upper block's bottom\n\n");
    puts("        pairs         slip from   loads            contact forces on the upper block\n"
         "   open slip stick      r, mm     F_z, N  M_z, N m     F_z, N  M_z, N m  friction, J"
         "       eta");
    return check;
}

void check_step(struct check *check, int step, const double f[DOFS], const double slip0[2 * PAIRS],
                const double d[SIZE], const double F[SIZE], const int32_t state[PAIRS],
                const signorini_report *report)
{
    const signorini_resultant sum = resultant_of(check, slip0, d, F);

    check->off = fmax(check->off, unbalanced(check, &sum, F, f));
    check->excess = fmax(check->excess, contact_excess(PAIRS, F, MU));
    check->turned = fmax(check->turned, turned_apart(F));
    check->least_work = fmin(check->least_work, sum.friction_work);
    printf("%7d %4d %5d %10.1f %10.1f %9.1f %10.1f %9.1f %12.5f %9.0e\n", (int)report->pairs_open,
           (int)report->pairs_slipping, (int)report->pairs_sticking, innermost_slip(check, state),
           -PRESS, 1e-3 * twist[step], sum.force[2], 1e-3 * sum.moment[2],
           1e-3 * sum.friction_work, report->eta);
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

/* The host's own equations, K u = f + contact forces, at all nodes that are not held. */
static void check_host(struct check *check, const double u[DOFS], const double f[DOFS],
                       const double F[SIZE])
{
    static double all[DOFS], residual[DOFS];
    double worst = 0.0;
    const int32_t status = signorini_model_nodal_forces(check->model, F, all);

    for (int i = 0; i < DOFS; i++)
        all[i] += f[i];
    brick_residual(check->mesh, u, all, residual);
    for (int i = FIXED; i < DOFS; i++)
        worst = fmax(worst, fabs(residual[i]) / PRESS);
    judge(&check->checks, status == 0 && worst <= tiny);
    printf("K u = f + contact forces at all nodes: off by %.0e of the press\n", worst);
}

/* Friction holds at most mu times the press at the largest radius. With a larger twist there is no
 * equilibrium, and the library must prove it. */
static void check_limit(struct check *check, const double slip0[2 * PAIRS])
{
    static double f[DOFS], d[SIZE], F[SIZE], friction[PAIRS];
    const double limit = MU * PRESS * sqrt(2.0) * arm;

    for (int pair = 0; pair < PAIRS; pair++)
        friction[pair] = MU;
    blocks_loads(check->mesh, 1.01 * limit, f);
    const int32_t status = signorini_model_solve(
        check->model, 1, f, NULL, check->pairs.gaps, SIGNORINI_LAW_COULOMB,
        friction, slip0, NULL, d, F, NULL, NULL, NULL, NULL);
    judge(&check->checks, status == SIGNORINI_STATUS_NO_EQUILIBRIUM);
    printf("twist of %.0f N m, 1 %% more than friction can hold: status %d, %s\n", 1.01e-3 * limit,
           (int)status, signorini_status_string(status));
}

void check_end(struct check *check, const double f[DOFS], const double u[DOFS],
               const double F[SIZE], const int32_t state[PAIRS], const double slip0[2 * PAIRS])
{
    struct checks *checks = &check->checks;

    print_map(state);
    judge(checks, check->off <= tiny);
    printf("contact forces balance the loads, 3 forces and 3 moments: off by %.0e\n", check->off);
    judge(checks, check->excess <= tiny * PRESS);
    printf("no tension, |F_t| <= mu |F_n|: exceeded by %.0e N\n", check->excess);
    judge(checks, check->turned <= tiny);
    printf("a quarter turn changes nothing: off by %.0e of the largest force\n", check->turned);
    judge(checks, check->least_work >= -tiny);
    printf("friction takes work: at least %.0e N mm a step\n", check->least_work);
    check_host(check, u, f, F);
    check_limit(check, slip0);
}

static void say(struct check *check, const char *path, int written, const char *reason)
{
    judge(&check->checks, written);
    printf(written ? "wrote %s\n" : "cannot write %s: %s\n", path, reason);
}

static int write_pairs(const struct check *check, const char *path, const double d[SIZE],
                       const double F[SIZE], const int32_t state[PAIRS])
{
    const double *at = check->pairs.points;
    FILE *file = fopen(path, "w");

    if (file == NULL)
        return 0;
    fputs("x,y,d_n,d_t1,d_t2,F_n,F_t1,F_t2,state\n", file);
    for (int pair = 0; pair < PAIRS; pair++) {
        fprintf(file, "%.12g,%.12g", at[3 * pair], at[3 * pair + 1]);
        for (int i = 0; i < 6; i++) /* + 0.0 turns -0.0 into 0.0 */
            fprintf(file, ",%.12e", (i < 3 ? d : F)[3 * pair + i % 3] + 0.0);
        fprintf(file, ",%s\n", state_name(state[pair]));
    }
    const int lost = ferror(file);
    return fclose(file) == 0 && !lost;
}

void check_files(struct check *check, const char *directory, const double slip0[2 * PAIRS],
                 const double u[DOFS], const double d[SIZE], const double F[SIZE],
                 const int32_t state[PAIRS])
{
    const signorini_mesh cells = brick_cells(check->mesh);
    char path[4096];

    snprintf(path, sizeof path, "%s/two_blocks.csv", directory);
    say(check, path, write_pairs(check, path, d, F, state), "an error of the system");
    snprintf(path, sizeof path, "%s/two_blocks.vtu", directory);
    const signorini_zone zone = {.struct_size = sizeof zone, .contact = check->contact,
                                 .slip0 = slip0, .d = d, .F = F, .state = state};
    const int32_t status = signorini_mesh_write(path, &cells, u, 1, &zone, 0, NULL);
    say(check, path, status == 0, signorini_last_error());
}
