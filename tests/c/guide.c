/*
 * The functions of the guide for hosts, c_examples/guide, do what it says. They come into this
 * program as they stand there: tests/guide.sh cuts them out, each into a file with its chapter's name.
 */

#include "check.h" /* first: what may still change */

#include "dynamics.h"
#include "load_steps.h"
#include "nonlinear.h"

#include <math.h>

enum { PAIRS = 2, N = 2 * PAIRS };

static const double K[N * N] = {4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4};
static const double gap[PAIRS] = {0.1, 0.0};
static const double mu[PAIRS] = {0.3, 0.3};

static double distance(const double *a, const double *b)
{
    double most = 0.0;
    for (int i = 0; i < N; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Load up and down: the steps are those of single calls that hand on the slip. */
static void check_load_steps(void)
{
    static const double loads[2 * N] = {2, 1.5, 3, 0.5, 2, 0.2, 3, -0.5};
    double slip0[PAIRS] = {0}, d[N], F[N], slip_1[PAIRS] = {0}, d_1[N], F_1[N];
    signorini_model *model;

    CHECK_STATUS(signorini_model_new_condensed(2, PAIRS, K, N, NULL, &model), 0);
    CHECK_STATUS(load_steps(model, 2, loads, gap, mu, slip0, d, F), 0);
    for (int step = 0; step < 2; step++) {
        CHECK_STATUS(signorini_solve(2, PAIRS, K, N, loads + step * N, gap, SIGNORINI_LAW_COULOMB,
                                     mu, slip_1, NULL, d_1, F_1, NULL, NULL, NULL), 0);
        for (int i = 0; i < PAIRS; i++)
            slip_1[i] = d_1[2 * i + 1];
    }
    /* Both are certified to 1e-10 of forces and displacements of size one; K has condition 3. */
    CHECK(distance(d, d_1) < 1e-9);
    CHECK(distance(F, F_1) < 1e-9);
    signorini_model_free(model);
}

/* One iteration from anywhere leads to the solution of a linear host. */
static void check_contact_iteration(void)
{
    static const double f[N] = {2, 1.5, 3, 0.5};
    const double d[N] = {-0.3, 0.2, 0.05, -0.1}, slip0[PAIRS] = {0.02, -0.01};
    double r[N], room[N], c[N], F[N], wanted[N], force[N];

    for (int i = 0; i < N; i++) {
        r[i] = f[i];
        for (int j = 0; j < N; j++)
            r[i] -= K[i + N * j] * d[j];
    }
    CHECK_STATUS(contact_iteration(2, PAIRS, K, r, d, gap, mu, slip0, room, c, F), 0);
    CHECK_STATUS(signorini_solve(2, PAIRS, K, N, f, gap, SIGNORINI_LAW_COULOMB, mu, slip0, NULL,
                                 wanted, force, NULL, NULL, NULL),
                 0);
    for (int i = 0; i < N; i++)
        c[i] += d[i];
    CHECK(distance(c, wanted) < 1e-9); /* as above */
    CHECK(distance(F, force) < 1e-9);
}

/*
 * One pair in 3D, K = 2, mu = 0.5, pressed by 3. Under the tangential load (1.2, 1.6), of size 2, it
 * carries 1.5 and slips by (2 - 1.5) / 2 along the load, to (0.15, 0.2). Unloaded it sticks there.
 */
static void check_three_dimensions(void)
{
    static const double K_3[9] = {2, 0, 0, 0, 2, 0, 0, 0, 2}, loads[6] = {3, 1.2, 1.6, 3, 0, 0};
    const double closed = 0, friction = 0.5, start[3] = {-0.1, 0.05, 0.02}, none[2] = {0};
    double slip0[2] = {0}, d[3], F[3], r[3], room[3], c[3];
    signorini_model *model;

    CHECK_STATUS(signorini_model_new_condensed(3, 1, K_3, 3, NULL, &model), 0);
    CHECK_STATUS(load_steps(model, 2, loads, &closed, &friction, slip0, d, F), 0);
    CHECK(fabs(d[1] - 0.15) < 1e-9 && fabs(d[2] - 0.2) < 1e-9); /* as above */
    CHECK(fabs(slip0[0] - 0.15) < 1e-9 && fabs(slip0[1] - 0.2) < 1e-9);
    CHECK(fabs(F[0] + 3) < 1e-9 && fabs(F[1] - 0.3) < 1e-9 && fabs(F[2] - 0.4) < 1e-9);
    signorini_model_free(model);

    for (int i = 0; i < 3; i++)
        r[i] = loads[i] - 2 * start[i];
    CHECK_STATUS(contact_iteration(3, 1, K_3, r, start, &closed, &friction, none, room, c, F), 0);
    CHECK(fabs(start[0] + c[0]) < 1e-9);
    CHECK(fabs(start[1] + c[1] - 0.15) < 1e-9 && fabs(start[2] + c[2] - 0.2) < 1e-9);
    CHECK(fabs(F[1] + 0.9) < 1e-9 && fabs(F[2] + 1.2) < 1e-9);
}

/*
 * A mass of 2 on springs, without contact: Newmark's method with beta = 1/4 and gamma = 1/2 turns the motion by
 * theta in each step, cos theta = (1 - w) / (1 + w) with w = (omega dt)^2 / 4, and loses nothing.
 */
static void check_free_oscillation(void)
{
    enum { STEPS = 20 };
    const double mass[2] = {2, 2}, none[2] = {0}, spring[2] = {18, 8}, dt = 0.1, far_away = INFINITY;
    const double K_eff[4] = {spring[0] + 4 * mass[0] / (dt * dt), 0, 0, spring[1] + 4 * mass[1] / (dt * dt)};
    double u[2] = {1, -0.5}, v[2] = {0}, a[2], slip0[1] = {0}, d[2], F[2], room[2];
    signorini_model *model;

    for (int i = 0; i < 2; i++)
        a[i] = -spring[i] / mass[i] * u[i];
    CHECK_STATUS(signorini_model_new_condensed(2, 1, K_eff, 2, NULL, &model), 0);
    for (int step = 0; step < STEPS; step++)
        CHECK_STATUS(newmark_step(model, dt, 0.25, 0.5, mass, none, none, &far_away, none, u, v, a, slip0, d, F, room),
                     0);
    for (int i = 0; i < 2; i++) {
        const double w = spring[i] / mass[i] * dt * dt / 4;
        const double wanted = (i == 0 ? 1 : -0.5) * cos(STEPS * acos((1 - w) / (1 + w)));
        CHECK(fabs(u[i] - wanted) < 1e-8); /* twenty steps, each certified to 1e-10 of forces of size 1e3 */
    }
    signorini_model_free(model);
}

/*
 * A free block of mass 2, pressed by 3 and pushed by 2 with mu = 0.5: it slides with the acceleration
 * (2 - 1.5) / 2, which Newmark's method integrates exactly. A force of 1 does not move it.
 */
static void check_sliding_block(void)
{
    enum { STEPS = 8 };
    const double mass[2] = {2, 2}, none[2] = {0}, push[2] = {3, 2}, less[2] = {3, 1}, dt = 0.25, beta = 0.3025;
    const double K_eff[4] = {2 / (beta * dt * dt), 0, 0, 2 / (beta * dt * dt)}, closed = 0, friction = 0.5;
    double u[2] = {0}, v[2] = {0}, a[2] = {0, 0.25}, slip0[1] = {0}, d[2], F[2], room[2];
    const double end = STEPS * dt;
    signorini_model *model;

    CHECK_STATUS(signorini_model_new_condensed(2, 1, K_eff, 2, NULL, &model), 0);
    for (int step = 0; step < STEPS; step++)
        CHECK_STATUS(newmark_step(model, dt, beta, 0.6, mass, none, push, &closed, &friction, u, v, a, slip0, d, F,
                                  room), 0);
    CHECK(fabs(u[0]) < 1e-9 && fabs(u[1] - 0.125 * end * end) < 1e-8); /* as above */
    CHECK(fabs(v[1] - 0.25 * end) < 1e-8 && fabs(slip0[0] - u[1]) < 1e-12);
    CHECK(fabs(F[0] + 3) < 1e-8 && fabs(F[1] + 1.5) < 1e-8);

    u[1] = v[1] = a[1] = slip0[0] = 0;
    CHECK_STATUS(newmark_step(model, dt, beta, 0.6, mass, none, less, &closed, &friction, u, v, a, slip0, d, F, room),
                 0);
    CHECK(fabs(u[1]) < 1e-12 && fabs(F[1] + 1) < 1e-8);
    signorini_model_free(model);
}

/* A damper alone, 3 against a mass of 2: v decays by (1 - x) / (1 + x) in each step, x = 3 dt / (2 * 2). */
static void check_damping(void)
{
    const double mass[2] = {2, 2}, damper[2] = {3, 3}, none[2] = {0}, dt = 0.2, far_away = INFINITY;
    const double K_eff[4] = {2 * 3 / dt + 4 * 2 / (dt * dt), 0, 0, 2 * 3 / dt + 4 * 2 / (dt * dt)};
    double u[2] = {0}, v[2] = {1, -1}, a[2] = {-1.5, 1.5}, slip0[1] = {0}, d[2], F[2], room[2];
    const double x = 3 * dt / 4;
    signorini_model *model;

    CHECK_STATUS(signorini_model_new_condensed(2, 1, K_eff, 2, NULL, &model), 0);
    CHECK_STATUS(newmark_step(model, dt, 0.25, 0.5, mass, damper, none, &far_away, none, u, v, a, slip0, d, F, room),
                 0);
    CHECK(fabs(v[0] - (1 - x) / (1 + x)) < 1e-9 && fabs(v[1] + (1 - x) / (1 + x)) < 1e-9);
    signorini_model_free(model);
}

int main(void)
{
    check_load_steps();
    check_contact_iteration();
    check_three_dimensions();
    check_free_oscillation();
    check_sliding_block();
    check_damping();
    return check_summary("guide");
}
