/*
 * A body slides over a hump by many elements, and back by a little: large sliding in small steps,
 * over a curved surface. slide.h has a drawing, and the driving force by statics.
 *
 * Pairs belong to one place of the bodies. So each step makes them anew at the coordinates of now,
 * and solves for an increment of the displacements: the load is what is out of balance without
 * contact, f - K u. Normals and gaps of a curved surface change within the step. So each step is
 * solved twice: on the pairs of its beginning, and then, without moving further, on those of its
 * end. What has slipped in the step stands at the slave nodes, in global axes: it is carried over to
 * the new pairs, along their own tangents, as their reference slip. What slips in all, which a law
 * of wear needs, stands at the nodes too.
 *
 *     sliding [DIR]
 *
 * With DIR, it also writes DIR/sliding.vtu, the last step forth, for ParaView. It returns 0 if every
 * check passed.
 */

#include "../common/checks.h"
#include "slide.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define MU 0.3

/* Steps that press, drive forth by 1.5 mm each, rest, and drive back by 0.02 mm each. An element of
 * the slider is 2.8 mm long. */
enum { FORTH = 32, REST = FORTH + 1, STEPS = REST + 4 };

static double move_of(int step)
{
    return step == 0 || step == REST ? 0.0 : step <= FORTH ? 1.5 : -0.02;
}

struct slide {
    struct brick_mesh *mesh;
    signorini_faces slave, master;
    int64_t n_fixed, fixed[DOFS];
    double moves[DOFS], f[DOFS], u[DOFS];
    double path[NODES]; /* how far each slave node has slipped in all */

    /* Slip in the step. */
    double slip[DOFS]; /* at the slave nodes, in global axes */
    double d[3 * LAYER], F[3 * LAYER], slip0[2 * LAYER];
    int32_t state[LAYER];
    signorini_resultant sum;
    double work; /* of friction, by what nodes have slipped under their normal forces */
};

/* The slip of the step so far along the tangents of the pairs, with the opposite sign: slips count
 * from there. */
static void carry_over(const struct slide *slide, const signorini_surface_data *pairs,
                       double slip0[])
{
    const int64_t *node = pairs->nodes;
    const double *normal = pairs->normals;
    const double *tangent = pairs->tangents;

    for (int64_t pair = 0; pair < pairs->pairs; pair++) {
        const double *n = &normal[3 * pair], *t = &tangent[3 * pair];
        const double *slip = &slide->slip[3 * node[pair]];
        slip0[2 * pair] = slip0[2 * pair + 1] = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            const int p = (axis + 1) % 3, q = (axis + 2) % 3;
            slip0[2 * pair] -= slip[axis] * t[axis];
            slip0[2 * pair + 1] -= slip[axis] * (n[p] * t[q] - n[q] * t[p]); /* t2 = n x t1 */
        }
    }
}

/* Solves for an increment on these pairs; supports move by `move`. Returns the status. */
static int32_t increment(struct slide *slide, const signorini_surface_pairs *contact,
                         const signorini_surface_data *pairs, double move)
{
    static double out_of_balance[DOFS], by[DOFS], du[DOFS], friction[LAYER];
    const struct brick_mesh *mesh = slide->mesh;
    const signorini_sparse K = brick_matrix(mesh);
    const signorini_contact_fields at_nodes = {.struct_size = sizeof at_nodes, .slip = slide->slip};
    signorini_model *model;

    brick_residual(mesh, slide->u, slide->f, out_of_balance);
    for (int i = 0; i < DOFS; i++)
        out_of_balance[i] = -out_of_balance[i];
    for (int64_t i = 0; i < slide->n_fixed; i++)
        by[i] = move * slide->moves[i];
    for (int pair = 0; pair < LAYER; pair++)
        friction[pair] = MU;
    carry_over(slide, pairs, slide->slip0);
    int32_t status = signorini_model_new_sparse(&K, slide->n_fixed, slide->fixed,
                                                pairs->rows, NULL, &model);
    if (status != 0)
        return status;
    status = signorini_model_solve(model, 1, out_of_balance, by, pairs->gaps,
                                   SIGNORINI_LAW_COULOMB, friction, slide->slip0, NULL, slide->d,
                                   slide->F, slide->state, NULL, NULL, NULL);
    if (status == 0)
        status = signorini_model_recover(model, 1, out_of_balance, by, slide->d, du);
    if (status == 0)
        status = signorini_surface_fields(contact, NULL, slide->slip0, slide->d, slide->F, NULL,
                                          &at_nodes);
    if (status == 0)
        status = signorini_surface_resultant(contact, slide->slip0, slide->d, slide->F, NULL,
                                             &slide->sum);
    for (int i = 0; status == 0 && i < DOFS; i++)
        slide->u[i] += du[i];
    signorini_model_free(model);
    return status;
}

/* Adds the slips of the step to the paths of what is pressed. */
static void wear(struct slide *slide, const signorini_surface_data *pairs)
{
    const int64_t *node = pairs->nodes;

    slide->work = 0.0;
    for (int64_t pair = 0; pair < pairs->pairs; pair++) {
        const double *slip = &slide->slip[3 * node[pair]], press = -slide->F[3 * pair];
        const double length = sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
        if (press <= 0.0)
            continue;
        slide->path[node[pair]] += length;
        slide->work += MU * press * length;
    }
}

/* One step: an increment on the pairs of its beginning, and one on those of its end. With a path it
 * writes the mesh and the fields of the end to this file. */
static int32_t make_step(struct slide *slide, double move, const char *path)
{
    static double at[DOFS];
    const struct brick_mesh *mesh = slide->mesh;
    int32_t status = 0;

    for (int i = 0; i < DOFS; i++)
        slide->slip[i] = 0.0;
    for (int pass = 0; pass < 2 && status == 0; pass++) {
        signorini_surface_pairs *contact;
        signorini_surface_data pairs = {.struct_size = sizeof pairs};
        for (int i = 0; i < DOFS; i++)
            at[i] = mesh->at[i / 3][i % 3] + slide->u[i];
        status = signorini_surface_pair(3, NODES, at, &slide->slave, &slide->master, NULL, &contact);
        if (status != 0)
            break;
        status = signorini_surface_view(contact, &pairs);
        if (status == 0)
            status = increment(slide, contact, &pairs, pass == 0 ? move : 0.0);
        if (status == 0 && pass == 1) {
            wear(slide, &pairs);
            if (path != NULL) {
                const signorini_mesh cells = brick_cells(mesh);
                const signorini_zone zone = {.struct_size = sizeof zone, .contact = contact,
                    .slip0 = slide->slip0, .d = slide->d, .F = slide->F, .state = slide->state};
                status = signorini_mesh_write(path, &cells, slide->u, 1, &zone, 0, NULL);
            }
        }
        signorini_surface_free(contact);
    }
    return status;
}

/* ---- Checks -------------------------------------------------------------------------------- */

struct check {
    struct checks checks;
    double off, jump;              /* of the driving force from statics, over the press */
    double unbalanced;             /* of the contact's vertical force, over the press */
    double driven, taken, by_hand; /* work of the drive and of friction, from the second step on */
    double last, force[STEPS];     /* off in the step before; driving force over the press */
};

static void measure(struct check *check, const struct slide *slide, int step, double x)
{
    const double force = -slide->sum.force[0] / PRESS, off = force - slide_statics(MU, x);

    check->force[step] = force;
    check->unbalanced = fmax(check->unbalanced, fabs(slide->sum.force[2] / PRESS - 1.0));
    if (step > 1 && step <= FORTH) {
        check->off = fmax(check->off, fabs(off));
        if (step > 2)
            check->jump = fmax(check->jump, fabs(off - check->last));
        check->driven += PRESS * force * move_of(step);
        check->taken += slide->sum.friction_work;
        check->by_hand += slide->work;
    }
    check->last = off;
    printf("%5d %9.2f %10.4f %10.4f %10.1f %12.1f\n", step, x, force, slide_statics(MU, x),
           slide->sum.pressed_area, slide->sum.friction_work);
}

/*
 * Bounds. Statics is that of one point, and the contact has two elements from its middle to its rim:
 * 1 % of the press is a third of the angle between the normals of two neighbours there. The force
 * falls by 0.5 % of the press in a step; edges of the slider that pass nodes of the hump may add half
 * of that. The slider rises and sinks again, so that the drive works for friction alone, but for
 * forces that are taken at the ends of steps. A slider that rests keeps its forces, but for the
 * normals of its end. Back by so little that not all nodes slip the force falls step by step; without
 * memory it would turn round at once.
 */
static void judge_all(struct check *check)
{
    struct checks *checks = &check->checks;

    putchar('\n');
    judge(checks, check->unbalanced < 1e-8);
    printf("contact carries the press: off by %.0e\n", check->unbalanced);
    judge(checks, check->off < 0.01);
    printf("driving force by statics: off by at most %.2f %% of the press\n", 100.0 * check->off);
    judge(checks, check->jump < 0.0025);
    printf("from step to step it jumps by at most %.2f %% of the press\n", 100.0 * check->jump);
    judge(checks, fabs(check->taken / check->by_hand - 1.0) < 1e-6);
    printf("friction's work is mu * normal force * slip of the nodes: off by %.0e\n",
           fabs(check->taken / check->by_hand - 1.0));
    judge(checks, fabs(check->driven / check->taken - 1.0) < 0.02);
    printf("the drive works for friction alone: %.0f and %.0f N mm\n", check->driven, check->taken);
    judge(checks, fabs(check->force[REST] - check->force[FORTH]) < 0.01);
    printf("at rest forces stay: changed by %.2f %% of the press\n",
           100.0 * fabs(check->force[REST] - check->force[FORTH]));
    int falls = 1;
    for (int step = REST + 1; step < STEPS; step++)
        falls &= check->force[step] < check->force[step - 1] && check->force[step] > 0.0;
    judge(checks, falls);
    printf("back by %.2f mm the force falls step by step, to %.3f of the press\n",
           -(STEPS - REST - 1) * move_of(STEPS), check->force[STEPS - 1]);
}

int main(int argc, char **argv)
{
    static struct slide slide = {.sum = {.struct_size = sizeof slide.sum}};
    static struct check check;
    char path[4096];
    double x = START;
    slide.mesh = slide_mesh();
    if (slide.mesh == NULL) {
        puts("not enough memory");
        return EXIT_FAILURE;
    }
    slide.slave = slide_slave(slide.mesh);
    slide.master = slide_master(slide.mesh);
    slide.n_fixed = slide_fixed(slide.mesh, slide.fixed, slide.moves);
    slide_load(slide.mesh, slide.f);
    snprintf(path, sizeof path, "%s/sliding.vtu", argc == 2 ? argv[1] : ".");
    printf("signorini %s\n\n%d nodes, mu = %.1f, pressed by %.0f N\n\n", signorini_version(),
           (int)NODES, MU, PRESS);
    puts(" step     x, mm  drive / press  statics  area, mm2  friction, N mm");
    for (int step = 0; step < STEPS; step++) {
        const int writes = argc == 2 && step == FORTH;
        const int32_t status = make_step(&slide, move_of(step), writes ? path : NULL);
        if (status != 0) {
            printf("step %d: %s: %s\n", step, signorini_status_string(status),
                   signorini_last_error());
            return EXIT_FAILURE;
        }
        x += move_of(step);
        measure(&check, &slide, step, x);
    }
    judge_all(&check);
    brick_mesh_free(slide.mesh);
    return conclude(&check.checks);
}
