/*
 * The functions of the guide for hosts, c_examples/GUIDE.md, do what it says. They come into this
 * program as they stand there: tests/readme.sh cuts them out into guide_1.h and guide_2.h.
 */

#include "guide_1.h"
#include "guide_2.h"

#include "check.h"

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

    CHECK_STATUS(signorini_model_new_condensed(2, PAIRS, K, N, &model), 0);
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

/* Of a linear host one iteration from anywhere leads to the solution. */
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

    CHECK_STATUS(signorini_model_new_condensed(3, 1, K_3, 3, &model), 0);
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

int main(void)
{
    check_load_steps();
    check_contact_iteration();
    check_three_dimensions();
    return check_summary("guide");
}
