/*
 * Models in flexibility form: closed forms, certificates, refusals.
 */

#include "check.h"
#include "everything.h"

#include <math.h>
#include <string.h>

/* A node on springs of stiffness 2 in a corner: floor (normal -y, tangent x) and wall (normal x,
 * tangent y), as W = B B' / 2 with the rows n and t of both. */
static const double corner[16] = {
    0.5, 0, 0, -0.5, /* floor, normal */
    0, 0.5, 0.5, 0,  /* floor, tangent */
    0, 0.5, 0.5, 0,  /* wall, normal */
    -0.5, 0, 0, 0.5, /* wall, tangent */
};
static const double half[2] = {0.5, 0.5};

/* Pressed into the corner by (1, -1) the node stays. N + T = 1 for N of one plane and T of the
 * other; the smallest forces have T = mu N, N = 1 / (1 + mu). The tolerance is 1e-10. */
static void corner_node(void)
{
    const double q[4] = {0.5, 0.5, 0.5, -0.5};
    const double gaps[2] = {0.0, 0.0};
    double d[4], F[4], same[4];
    int32_t state[2];
    signorini_report report;
    signorini_report_default(&report, sizeof report);
    CHECK_STATUS(solve_flexibility(2, 2, corner, 4, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                             NULL, NULL, d, F, state, &report, NULL),
                 0);
    for (int pair = 0; pair < 2; pair++) {
        CHECK(fabs(F[2 * pair] + 1.0 / 1.5) < 1e-9);
        CHECK(fabs(fabs(F[2 * pair + 1]) - 0.5 / 1.5) < 1e-9);
        CHECK(fabs(d[2 * pair]) < 1e-9 && fabs(d[2 * pair + 1]) < 1e-9);
    }
    CHECK(report.eta <= 1e-10 && report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN);
    CHECK_STATUS(solve_flexibility(2, 2, corner, 4, q, gaps, SIGNORINI_LAW_COULOMB, half,
                                             NULL, NULL, d, same, NULL, NULL, NULL),
                 0);
    CHECK(memcmp(F, same, sizeof F) == 0);
}

/* Walls on both sides, closer than the body: p = (-1, -1) moves nothing, and 0.1 - 0.2 < 0. */
static void walls_too_close(void)
{
    const double W[16] = {0.5, 0, -0.5, 0, 0, 0.5, 0, -0.5, -0.5, 0, 0.5, 0, 0, -0.5, 0, 0.5};
    const double q[4] = {0.3, 0.0, -0.3, 0.0}, gap[2] = {0.1, -0.2};
    double d[4], F[4], motion[4];
    signorini_extra extra;
    signorini_extra_default(&extra, sizeof extra);
    extra.motion = motion;
    CHECK_STATUS(solve_flexibility(2, 2, W, 4, q, gap, SIGNORINI_LAW_COULOMB, half, NULL,
                                             NULL, d, F, NULL, NULL, &extra),
                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
    CHECK_TEXT(signorini_last_error(), "contradict each other");
    CHECK(fabs(motion[0] + 1.0) < 1e-9 && fabs(motion[2] + 1.0) < 1e-9);
    CHECK(motion[1] == 0.0 && motion[3] == 0.0);
}

/* d and F of a solution are measured together: neither tells the other. */
static void certified(void)
{
    const double q[4] = {0.5, 0.5, 0.5, -0.5}, gap[2] = {0, 0};
    double d[4], F[4], K[16], load[4];
    int32_t state[2] = {7, 7};
    signorini_report report;
    signorini_model *model = NULL;
    signorini_report_default(&report, sizeof report);
    CHECK_STATUS(signorini_model_new_flexibility(2, 2, corner, 4, &model), 0);
    CHECK(model_data(model).kind == SIGNORINI_MODEL_FLEXIBILITY && model_data(model).host_size == 4);
    CHECK(!model_data(model).K && !model_data(model).frames && model_data(model).fixed == 0);
    CHECK_STATUS(signorini_model_solve(model, 1, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, NULL, d, F,
                                       NULL, NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_certify(model, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, 1e-10, d, F,
                                         state, &report), 0);
    CHECK(report.eta <= 1e-10 && state[0] != 7 && state[1] != 7);
    d[0] += 1e-3;
    CHECK_STATUS(signorini_model_certify(model, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, 1e-10, d, F,
                                         NULL, NULL), SIGNORINI_STATUS_NOT_A_SOLUTION);
    d[0] -= 1e-3;
    F[0] = NAN;
    CHECK_STATUS(signorini_model_certify(model, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, 1e-10, d, F,
                                         NULL, NULL), -10);
    CHECK_TEXT(signorini_last_error(), "F[0] is not finite");
    CHECK_STATUS(signorini_model_certify(model, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, 1e-10, d, NULL,
                                         NULL, NULL), -10);
    CHECK_STATUS(copy_stiffness(model, K), -1);
    CHECK_STATUS(signorini_model_condensed_load(model, q, NULL, load), -1);
    CHECK_TEXT(signorini_last_error(), "flexibility form");
    CHECK_STATUS(signorini_model_prove(model, q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL, d, NULL, NULL,
                                       NULL, NULL), -1);
    CHECK_STATUS(signorini_model_write(model, "not_written", q, NULL, gap, SIGNORINI_LAW_COULOMB, half, NULL,
                                       NULL), -1);
    CHECK_STATUS(signorini_model_recover(model, 1, q, NULL, d, load), 0);
    CHECK(memcmp(load, d, sizeof d) == 0);
    signorini_model_free(model);
}

static void nothing_to_do(void)
{
    CHECK_STATUS(solve_flexibility(3, 0, NULL, 1, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL,
                                             NULL, NULL, NULL, NULL, NULL, NULL, NULL),
                 0);
}

static void refusals(void)
{
    const double q[4] = {0.5, 0.5, 0.5, -0.5}, nan_q[4] = {0.0, NAN, 0.0, 0.0}, zero[16] = {0.0};
    const double wrong_gap[2] = {0.0, NAN}, wrong_mu[2] = {0.5, -0.1};
    double d[4] = {0}, F[4] = {0}, skew[16];
    memcpy(skew, corner, sizeof skew);
    skew[1] = 0.25;
    const struct {
        int32_t dim;
        int64_t pairs;
        const double *W;
        int64_t ldw;
        const double *q, *gap;
        int32_t law;
        const double *mu;
        double *d, *F;
        int32_t status;
        const char *said;
    } cases[] = {
        {4, 2, corner, 4, q, NULL, 1, half, d, F, -1, "dim is 4"},
        {2, -2, corner, 4, q, NULL, 1, half, d, F, -2, "pairs is -2"},
        {2, 2, NULL, 4, q, NULL, 1, half, d, F, -3, "W is NULL"},
        {2, 2, skew, 4, q, NULL, 1, half, d, F, -3, "W is not symmetric"},
        {2, 2, zero, 4, q, NULL, 1, half, d, F, -3, "W is zero"},
        {2, 2, corner, 3, q, NULL, 1, half, d, F, -4, "leading dimension of W is 3"},
        {2, 2, corner, 4, nan_q, NULL, 1, half, d, F, -3, "f[1] is not finite"},
        {2, 2, corner, 4, q, wrong_gap, 1, half, d, F, -5, "gap[1]"},
        {2, 2, corner, 4, q, NULL, 77, half, d, F, -6, "law"},
        {2, 2, corner, 4, q, NULL, 1, wrong_mu, d, F, -7, "[1]"},
        {2, 2, corner, 4, q, NULL, 1, half, NULL, F, -10, "d is NULL"},
        {2, 2, corner, 4, q, NULL, 1, half, d, NULL, -11, "F is NULL"},
        {2, 2, corner, 4, q, NULL, 1, half, d, d, -11, "overlap"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        CHECK_STATUS(solve_flexibility(cases[i].dim, cases[i].pairs, cases[i].W,
                                                 cases[i].ldw, cases[i].q, cases[i].gap,
                                                 cases[i].law, cases[i].mu, NULL, NULL, cases[i].d,
                                                 cases[i].F, NULL, NULL, NULL),
                     cases[i].status);
        CHECK_TEXT(signorini_last_error(), cases[i].said);
    }
    const double wrong_slip[2] = {0, NAN};
    signorini_settings settings;
    CHECK_STATUS(solve_flexibility(2, 2, corner, 4, q, NULL, 1, half, wrong_slip, NULL, d, F,
                                             NULL, NULL, NULL), -8);
    CHECK_TEXT(signorini_last_error(), "slip0[1]");
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.warm_start = 1;
    F[2] = NAN;
    CHECK_STATUS(solve_flexibility(2, 2, corner, 4, q, NULL, 1, half, NULL, &settings, d, F,
                                             NULL, NULL, NULL), -11);
    CHECK_TEXT(signorini_last_error(), "F[2] is not finite");
    settings.warm_start = 0;
    settings.tolerance = -1;
    CHECK_STATUS(solve_flexibility(2, 2, corner, 4, q, NULL, 1, half, NULL, &settings, d, F,
                                             NULL, NULL, NULL), -9);
}

int main(void)
{
    corner_node();
    walls_too_close();
    certified();
    nothing_to_do();
    refusals();
    return check_summary("flexibility");
}
