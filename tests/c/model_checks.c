/*
 * A model's answers about itself and displacements: sizes, frames, the loads that a case condenses
 * to, certificates, and the further results of each case of a block.
 */

#include "check.h"

/* ---- a sparse model in 3D: two pairs on a rigid obstacle, each component on a spring ---- */

enum { DIM = 3, PAIRS = 2, SIZE = 9, N = DIM * PAIRS };

/* Degrees of freedom 6 to 8 belong to a node behind, which is fixed along z. */
static signorini_model *block(const double *normals, const double *tangents)
{
    const int32_t starts[SIZE + 1] = {0, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    const int32_t rows[] = {0, 6, 1, 2, 3, 4, 5, 6, 7, 8};
    const double values[] = {3, -1, 4, 5, 6, 7, 8, 2, 1, 1};
    const int64_t fixed[] = {8}, slaves[] = {0, 1, 2, 3, 4, 5};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 4, .index_base = 0,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = SIZE, .nnz = 10,
                                .col_start = starts, .row = rows, .values = values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = DIM, .count = PAIRS,
                                   .slaves = slaves, .normals = normals, .tangents = tangents};
    signorini_model *model;
    CHECK_STATUS(signorini_model_new_sparse(&K, 1, fixed, &pairs, NULL, &model), 0);
    return model;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Orthonormal, right-handed, the normal along the given one. */
static void check_frame(const double *frame, const double *normal)
{
    double third[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) CHECK_NEAR(dot(frame + 3 * i, frame + 3 * j), i == j);
    CHECK_NEAR(dot(frame, normal), sqrt(dot(normal, normal)));
    cross(frame, frame + 3, third);
    for (int i = 0; i < 3; i++) CHECK_NEAR(third[i], frame[6 + i]);
}

static void frames_are_those_of_the_pairs(void)
{
    const double normals[N] = {1, -2, 2, 0, 0, -7}, tangents[N] = {4, 1, -1, 1, 1, 0};
    double frames[DIM * N];
    signorini_model *model = block(normals, NULL);
    CHECK(model_data(model).dim == DIM && model_data(model).pairs == PAIRS);
    CHECK(model_data(model).host_size == SIZE);
    CHECK_STATUS(copy_frames(model, frames), 0);
    for (int pair = 0; pair < PAIRS; pair++) check_frame(frames + 9 * pair, normals + 3 * pair);
    /* The axis most across (1, -2, 2) is x: t1 = x times n = (0, -2, -2) / sqrt(8). */
    CHECK_NEAR(frames[3], 0);
    CHECK_NEAR(frames[4], -sqrt(0.5));
    CHECK_NEAR(frames[5], -sqrt(0.5));
    CHECK_STATUS(signorini_model_view(model, NULL), -2);
    signorini_model_free(model);

    /* Given tangents keep their direction. */
    model = block(normals, tangents);
    CHECK_STATUS(copy_frames(model, frames), 0);
    for (int pair = 0; pair < PAIRS; pair++) check_frame(frames + 9 * pair, normals + 3 * pair);
    CHECK_NEAR(frames[12], sqrt(0.5));
    CHECK_NEAR(frames[13], sqrt(0.5));
    CHECK_NEAR(frames[14], 0);
    signorini_model_free(model);
}

/* With frames, forces turn to global axes: the same as the nodal forces of the model. */
static void forces_turn_by_the_frames(void)
{
    const double normals[N] = {1, -2, 2, 0, 0, -7}, F[N] = {-5, 1, 2, -3, 0.5, -0.25};
    double frames[DIM * N], nodal[SIZE];
    signorini_model *model = block(normals, NULL);
    CHECK_STATUS(copy_frames(model, frames), 0);
    CHECK_STATUS(signorini_model_nodal_forces(model, F, nodal), 0);
    for (int pair = 0; pair < PAIRS; pair++)
        for (int axis = 0; axis < DIM; axis++) {
            double force = 0;
            for (int c = 0; c < DIM; c++)
                force += frames[9 * pair + 3 * c + axis] * F[DIM * pair + c];
            CHECK_NEAR(nodal[DIM * pair + axis], force);
        }
    signorini_model_free(model);
}

static void condensed_models_have_no_frames(void)
{
    const double K[4] = {2, 1, 1, 2};
    double frames[4] = {7, 7, 7, 7};
    signorini_model *model;
    CHECK_STATUS(signorini_model_new_condensed(2, 1, K, 2, NULL, &model), 0);
    CHECK(model_data(model).dim == 2 && model_data(model).pairs == 1);
    CHECK_STATUS(copy_frames(model, frames), -1);
    CHECK(model_data(model).frames == NULL);
    CHECK(frames[0] == 7);
    signorini_model_free(model);
    CHECK_STATUS(signorini_model_new_two_body(2, 1, K, 2, K, 2, NULL, &model), 0);
    CHECK_STATUS(copy_frames(model, frames), -1);
    signorini_model_free(model);
}

/* ---- loads ---- */

/*
 * By hand: n = (0, 0, -1), t1 = (1, 0, 0), t2 = (0, -1, 0) on both pairs. Degree of freedom 6, of
 * stiffness 2, hangs on x of pair 0 by -1: f_x of that pair becomes f_0 + f_6 / 2.
 */
static void loads_are_condensed(void)
{
    const double normals[N] = {0, 0, -1, 0, 0, -1}, tangents[N] = {1, 0, 0, 1, 0, 0};
    const double f[SIZE] = {1, 2, 3, 4, 5, 6, 8, 9, 10}, wrong[SIZE] = {NAN};
    const double expected[N] = {-3, 1 + 8. / 2, -2, -6, 4, -5};
    const double prescribed[1] = {0.5}, bad[1] = {INFINITY};
    double load[N], K[N * N];
    signorini_model *model = block(normals, tangents);
    CHECK_STATUS(signorini_model_condensed_load(model, f, NULL, load), 0);
    for (int i = 0; i < N; i++) CHECK_NEAR(load[i], expected[i]);
    /* Nothing couples with the fixed degree of freedom. */
    CHECK_STATUS(signorini_model_condensed_load(model, f, prescribed, load), 0);
    for (int i = 0; i < N; i++) CHECK_NEAR(load[i], expected[i]);
    CHECK_STATUS(copy_stiffness(model, K), 0);
    CHECK_NEAR(K[N + 1], 3 - 1. / 2);

    CHECK_STATUS(signorini_model_condensed_load(model, NULL, NULL, load), -2);
    CHECK_STATUS(signorini_model_condensed_load(model, wrong, NULL, load), -2);
    CHECK_TEXT(signorini_last_error(), "f[0] is not finite");
    CHECK_STATUS(signorini_model_condensed_load(model, f, bad, load), -3);
    CHECK_STATUS(signorini_model_condensed_load(model, f, NULL, NULL), -4);
    signorini_model_free(model);

    /* A prescribed value loads what it is coupled with: -K_01 times the value. */
    const int64_t starts[] = {0, 2, 3, 4}, rows[] = {0, 2, 1, 2}, fixed[] = {2}, slaves[] = {0, 1};
    const double values[] = {3, -1.5, 4, 2}, normal[] = {1, 0}, nothing[3] = {0};
    const signorini_sparse chain = {sizeof chain, 8, 0, SIGNORINI_TRIANGLE_LOWER, 3, 4, starts,
                                    rows, values, NULL};
    const signorini_pairs pair = {.struct_size = sizeof pair, .dim = 2, .count = 1,
                                  .slaves = slaves, .normals = normal};
    CHECK_STATUS(signorini_model_new_sparse(&chain, 1, fixed, &pair, NULL, &model), 0);
    CHECK_STATUS(signorini_model_condensed_load(model, nothing, prescribed, load), 0);
    CHECK_NEAR(load[0], 1.5 * 0.5);
    CHECK_NEAR(load[1], 0);
    signorini_model_free(model);
}

/* ---- the certificate ---- */

static void the_certificate_agrees_with_the_solution(void)
{
    const double normals[N] = {1, -2, 2, 0, 0, -7}, gap[PAIRS] = {0.01, -0.02};
    const double f[SIZE] = {9, -4, 5, 3, 1, -8, 1, 2, 3}, slip0[4] = {0.01, 0, 0, -0.02};
    const int32_t laws[] = {SIGNORINI_LAW_FRICTIONLESS, SIGNORINI_LAW_COULOMB,
                            SIGNORINI_LAW_TRESCA};
    const double friction[PAIRS] = {0.3, 0.5};
    signorini_model *model = block(normals, NULL);
    for (int i = 0; i < 3; i++) {
        const double *parameters = i == 0 ? NULL : friction;
        double d[N], F[N], measured[N];
        int32_t state[PAIRS], states[PAIRS];
        signorini_report solved, report;
        CHECK_STATUS(signorini_report_default(&solved, sizeof solved), 0);
        CHECK_STATUS(signorini_report_default(&report, sizeof report), 0);
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, laws[i], parameters, slip0, NULL,
                                           d, F, state, NULL, &solved, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK_STATUS(signorini_model_certify(model, f, NULL, gap, laws[i], parameters, slip0, 1e-10,
                                             d, measured, states, &report),
                     SIGNORINI_STATUS_SOLVED);
        /* eta of a solution is that of d before it is rounded to doubles; rounding covers it. */
        CHECK(fabs(report.eta - solved.eta) <= solved.rounding);
        CHECK(report.status == SIGNORINI_STATUS_SOLVED);
        CHECK(memcmp(measured, F, sizeof F) == 0 && memcmp(states, state, sizeof state) == 0);

        d[3] += 1e-4;
        CHECK_STATUS(signorini_model_certify(model, f, NULL, gap, laws[i], parameters, slip0, 1e-10,
                                             d, NULL, NULL, &report),
                     SIGNORINI_STATUS_NOT_A_SOLUTION);
        CHECK(report.eta > 1e-10 && report.status == SIGNORINI_STATUS_NOT_A_SOLUTION);
        CHECK_TEXT(signorini_last_error(), "not a solution");
    }
    signorini_model_free(model);
}

static void bad_certificates(void)
{
    const double normals[N] = {1, -2, 2, 0, 0, -7}, gap[PAIRS] = {0}, mu[PAIRS] = {0};
    const double f[SIZE] = {0}, nan[N] = {0, NAN};
    double d[N] = {0};
    signorini_model *model = block(normals, NULL);
#define BAD(status, part, ...)                                                                    \
    do {                                                                                          \
        CHECK_STATUS(signorini_model_certify(model, __VA_ARGS__, NULL, NULL, NULL), status);      \
        CHECK_TEXT(signorini_last_error(), part);                                                 \
    } while (0)
    BAD(-2, "f is NULL", NULL, NULL, gap, 1, mu, NULL, 1e-10, d);
    BAD(-3, "prescribed[0]", f, nan + 1, gap, 1, mu, NULL, 1e-10, d);
    BAD(-4, "gap[1] is NaN", f, NULL, nan, 1, mu, NULL, 1e-10, d);
    BAD(-5, "law is 8", f, NULL, gap, 8, mu, NULL, 1e-10, d);
    BAD(-6, "friction is NULL", f, NULL, gap, 1, NULL, NULL, 1e-10, d);
    BAD(-6, "mu[1] is not finite", f, NULL, gap, 1, nan, NULL, 1e-10, d);
    BAD(-7, "slip0[1] is not finite", f, NULL, gap, 1, mu, nan, 1e-10, d);
    BAD(-8, "tolerance is 0", f, NULL, gap, 1, mu, NULL, 0, d);
    BAD(-9, "d is NULL", f, NULL, gap, 1, mu, NULL, 1e-10, NULL);
    BAD(-9, "d[1] is not finite", f, NULL, gap, 1, mu, NULL, 1e-10, nan);
    CHECK_STATUS(signorini_model_certify(model, f, NULL, gap, 0, NULL, NULL, 1e-10, d, d, NULL,
                                         NULL),
                 -10);
    signorini_model_free(model);
}

/* ---- further results, a column a case ---- */

/* A body tied along (1, 1) leaves in the second of three cases; the others stay where they are. */
static void each_case_has_its_own_motion(void)
{
    enum { CASES = 3 };
    const double K[4] = {1, -1, -1, 1}, f[2 * CASES] = {1, 0.1, -1, -1, 1, -0.1};
    const double gap[CASES] = {0}, mu[CASES] = {0.25, 0.25, 0.25};
    double d[2 * CASES], F[2 * CASES], motion[2 * CASES], second_d[2 * CASES];
    double escape[2 * CASES];
    int32_t status[CASES], second_state[CASES] = {7, 7, 7};
    signorini_extra extra;
    signorini_model *model;
    CHECK_STATUS(signorini_extra_default(&extra, sizeof extra), 0);
    extra.motion = motion;
    extra.escape = escape;
    extra.second_d = second_d;
    extra.second_state = second_state;
    CHECK_STATUS(signorini_model_new_condensed(2, 1, K, 2, NULL, &model), 0);
    CHECK_STATUS(signorini_model_solve(model, CASES, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                       NULL, d, F, NULL, status, NULL, &extra),
                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
    for (int c = 0; c < CASES; c++) {
        const double expected = c == 1 ? -1 : 0;
        CHECK_STATUS(status[c], c == 1 ? SIGNORINI_STATUS_NO_EQUILIBRIUM : SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(motion[2 * c], expected);
        CHECK_NEAR(motion[2 * c + 1], expected);
        CHECK_NEAR(escape[2 * c], expected);
        CHECK_NEAR(escape[2 * c + 1], expected);
        CHECK(second_d[2 * c] == 0 && second_d[2 * c + 1] == 0 && second_state[c] == 0);
    }
    signorini_model_free(model);
}

/* ---- many cases at once ---- */

enum { MANY = 70 }; /* more than two blocks */

/*
 * Two nodes touch planes across x. Case c presses the second one by 1 + c, and pulls the node behind by
 * g = 0.1 c along x, which moves by g / 2, as its spring is 2, and presses the first node by as much, as the
 * spring between them is -1.
 */
static void many_cases_at_once(void)
{
    static double f[MANY][SIZE], values[MANY], gap[MANY][PAIRS], mu[MANY][PAIRS], d[MANY][N];
    static double F[MANY][N], u[MANY][SIZE], before[MANY][SIZE];
    static int32_t status[MANY];
    const double normals[N] = {1, 0, 0, 1, 0, 0};
    signorini_settings settings;
    signorini_model *model = block(normals, NULL);
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    for (int c = 0; c < MANY; c++) {
        f[c][3] = 1 + c;
        f[c][6] = 0.1 * c;
        values[c] = 0.01 * c;
        mu[c][0] = mu[c][1] = 0.3;
    }
    for (int start = 0; start <= SIGNORINI_START_PREVIOUS; start++) {
        settings.warm_start = start;
        memset(d, 0, sizeof d);
        CHECK_STATUS(signorini_model_solve(model, MANY, f[0], values, gap[0], SIGNORINI_LAW_COULOMB,
                                           mu[0], NULL, &settings, d[0], F[0], NULL, status, NULL,
                                           NULL),
                     0);
        CHECK_STATUS(signorini_model_recover(model, MANY, f[0], values, d[0], u[0]), 0);
        for (int c = 0; c < MANY; c++) {
            double one[SIZE];
            CHECK_STATUS(status[c], 0);
            /* Both nodes are held by their planes. */
            CHECK_NEAR(d[c][0], 0);
            CHECK_NEAR(F[c][0], -0.1 * c / 2);
            CHECK_NEAR(F[c][3], -(1. + c));
            CHECK_NEAR(u[c][6], 0.1 * c / 2);
            CHECK_NEAR(u[c][3], 0);
            CHECK_NEAR(u[c][8], 0.01 * c);
            CHECK_STATUS(signorini_model_recover(model, 1, f[c], values + c, d[c], one), 0);
            for (int i = 0; i < SIZE; i++) CHECK_NEAR(u[c][i], one[i]);
        }
    }

    /* One by one: each call goes on where the one before has ended. */
    settings.warm_start = SIGNORINI_START_PREVIOUS;
    for (int c = 0; c < MANY; c++) {
        double one[N] = {NAN, NAN, NAN, NAN, NAN, NAN}, force[N];
        CHECK_STATUS(signorini_model_solve(model, 1, f[c], values + c, gap[c],
                                           SIGNORINI_LAW_COULOMB, mu[c], NULL, &settings, one,
                                           force, NULL, NULL, NULL, NULL),
                     0);
        for (int i = 0; i < N; i++) {
            CHECK_NEAR(one[i], d[c][i]);
            CHECK_NEAR(force[i], F[c][i]);
        }
    }

    /* Bad input: of each array, with the case; nothing is written. */
    memcpy(before, u, sizeof u);
#define RECOVER(result, part, ...)                                                                 \
    do {                                                                                           \
        CHECK_STATUS(signorini_model_recover(__VA_ARGS__), result);                          \
        CHECK_TEXT(signorini_last_error(), part);                                                  \
        CHECK(memcmp(before, u, sizeof u) == 0);                                                   \
    } while (0)
    RECOVER(-1, "model", NULL, MANY, f[0], values, d[0], u[0]);
    RECOVER(-2, "cases is -1", model, -1, f[0], values, d[0], u[0]);
    RECOVER(-2, "too many", model, INT64_MAX, f[0], values, d[0], u[0]);
    RECOVER(-5, "d is NULL", model, MANY, f[0], values, NULL, u[0]);
    RECOVER(-6, "u is NULL", model, MANY, f[0], values, d[0], NULL);
    RECOVER(-6, "u overlaps f", model, MANY, u[0], values, d[0], u[0]);
    RECOVER(-6, "u overlaps d", model, MANY, f[0], values, u[MANY - 2], u[0]);
    f[69][2] = NAN;
    RECOVER(-3, "case 69: f[2] is not finite", model, MANY, f[0], values, d[0], u[0]);
    values[33] = INFINITY;
    RECOVER(-4, "case 33: prescribed[0] is not finite", model, MANY, f[0], values, d[0], u[0]);
    d[32][1] = -NAN;
    RECOVER(-5, "case 32: d[1] is not finite", model, MANY, f[0], values, d[0], u[0]);
    RECOVER(-5, "d[1] is not finite", model, 1, f[0], values, d[32], u[0]);
    CHECK_STATUS(signorini_model_recover(model, 0, NULL, NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_recover(model, 3, NULL, NULL, d[0], u[0]), 0);
    for (int c = 0; c < 3; c++) CHECK(u[c][8] == 0);

    /* One wrong case in the second block. */
    CHECK_STATUS(signorini_model_solve(model, 40, f[0], NULL, gap[0], SIGNORINI_LAW_COULOMB, mu[0],
                                       NULL, &settings, d[0], F[0], NULL, status, NULL, NULL),
                 0);
    f[35][0] = NAN;
    CHECK_STATUS(signorini_model_solve(model, 40, f[0], NULL, gap[0], SIGNORINI_LAW_COULOMB, mu[0],
                                       NULL, &settings, d[0], F[0], NULL, status, NULL, NULL),
                 -3);
    CHECK_TEXT(signorini_last_error(), "case 35: f[0] is not finite");
    for (int c = 0; c < 40; c++) CHECK_STATUS(status[c], c == 35 ? -3 : 0);
    signorini_model_free(model);
}

int main(void)
{
    frames_are_those_of_the_pairs();
    forces_turn_by_the_frames();
    condensed_models_have_no_frames();
    loads_are_condensed();
    the_certificate_agrees_with_the_solution();
    bad_certificates();
    each_case_has_its_own_motion();
    many_cases_at_once();
    return check_summary("model_checks");
}
