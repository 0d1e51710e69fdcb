/*
 * Models in flexibility form of a sparse matrix: closed forms island by island, the dense form, refusals.
 */

#include "check.h"
#include "everything.h"

#include <math.h>
#include <string.h>

/* Lower triangles of two nodes in corners, as in flexibility.c: pairs 0 and 2 are the first node's,
 * 1 and 3 the second's, which is twice as flexible. */
static const int32_t col_start[9] = {0, 2, 4, 6, 8, 9, 10, 11, 12};
static const int32_t row[12] = {0, 5, 1, 4, 2, 7, 3, 6, 4, 5, 6, 7};
static const double values[12] = {0.5, -0.5, 0.5, 0.5, 1, -1, 1, 1, 0.5, 0.5, 1, 1};
static const double half[4] = {0.5, 0.5, 0.5, 0.5};
/* Pressed into their corners by (1, -1). */
static const double q[8] = {0.5, 0.5, 1, 1, 0.5, -0.5, 1, -1};

static signorini_sparse corners(void)
{
    signorini_sparse W = {.struct_size = sizeof W, .index_bytes = 4, .size = 8, .nnz = 12};
    W.col_start = col_start;
    W.row = row;
    W.values = values;
    return W;
}

/* As of one node: N = 1 / (1 + mu) and T = mu N for each pair, whatever the flexibility. */
static void two_corners(void)
{
    const signorini_sparse W = corners();
    double d[8], F[8];
    int32_t state[4];
    signorini_report report;
    signorini_report_default(&report, sizeof report);
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, NULL, d, F, state, &report, NULL),
                 0);
    for (int pair = 0; pair < 4; pair++) {
        CHECK(fabs(F[2 * pair] + 1.0 / 1.5) < 1e-9);
        CHECK(fabs(fabs(F[2 * pair + 1]) - 0.5 / 1.5) < 1e-9);
        CHECK(fabs(d[2 * pair]) < 1e-9 && fabs(d[2 * pair + 1]) < 1e-9);
        CHECK(state[pair] != SIGNORINI_STATE_OPEN);
    }
    CHECK(report.eta <= 1e-10 && report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN);
    CHECK(report.pairs_open == 0 && report.iterations > 0);
}

/* The dense entry on the same matrix, and the sparse one on all its entries, by 8 bytes from 1. */
static void other_forms(void)
{
    signorini_sparse W = corners();
    double all[64] = {0}, d[8], F[8], dense[8], d_dense[8], full[64];
    int64_t start[9], rows[64], nnz = 0;
    for (int j = 0; j < 8; j++)
        for (int k = col_start[j]; k < col_start[j + 1]; k++)
            all[row[k] + 8 * j] = all[j + 8 * row[k]] = values[k];
    CHECK_STATUS(solve_flexibility(2, 4, all, 8, q, NULL, SIGNORINI_LAW_COULOMB, half, NULL,
                                             NULL, d_dense, dense, NULL, NULL, NULL),
                 0);
    for (int j = 0; j < 8; j++) {
        start[j] = nnz + 1;
        for (int i = 0; i < 8; i++) {
            if (all[i + 8 * j] == 0) continue;
            rows[nnz] = i + 1;
            full[nnz++] = all[i + 8 * j];
        }
    }
    start[8] = nnz + 1;
    W.index_bytes = 8;
    W.index_base = 1;
    W.triangle = SIGNORINI_TRIANGLE_FULL;
    W.nnz = nnz;
    W.col_start = start;
    W.row = rows;
    W.values = full;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, NULL, d, F, NULL, NULL, NULL),
                 0);
    for (int i = 0; i < 8; i++) CHECK(fabs(F[i] - dense[i]) < 1e-9 && fabs(d[i] - d_dense[i]) < 1e-9);
}

/* The second node between walls closer than itself: p = (-1, -1) moves nothing, and 0.1 - 0.2 < 0. */
static void one_contradicts(void)
{
    const int32_t start[9] = {0, 1, 2, 4, 6, 7, 8, 9, 10};
    const int32_t rows[10] = {0, 1, 2, 6, 3, 7, 4, 5, 6, 7};
    const double walls[10] = {0.5, 0.5, 0.5, -0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5};
    const double free[8] = {1, 0, 0.3, 0, -1, 0, -0.3, 0}, gap[4] = {0, 0.1, 0, -0.2};
    double d[8], F[8], motion[8];
    signorini_sparse W = corners();
    signorini_extra extra;
    signorini_extra_default(&extra, sizeof extra);
    extra.motion = motion;
    W.nnz = 10;
    W.col_start = start;
    W.row = rows;
    W.values = walls;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, free, gap, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, NULL, d, F, NULL, NULL, &extra),
                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
    CHECK_TEXT(signorini_last_error(), "the gaps of pairs 1, 3 contradict each other");
    for (int i = 0; i < 8; i++) CHECK(fabs(motion[i] + (i == 2 || i == 6)) < 1e-9);
    /* The others: pushed back by 1 over a flexibility of 1/2, and open. */
    CHECK_NEAR(F[0], -2);
    CHECK_NEAR(F[4], 0);
    CHECK_NEAR(d[4], -1);
}

/* Settings: a start, and limits. */
static void settings_count(void)
{
    const signorini_sparse W = corners();
    double d[8], F[8], again[8];
    signorini_settings settings;
    signorini_report report, second;
    signorini_report_default(&report, sizeof report);
    signorini_report_default(&second, sizeof second);
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, &settings, d, F, NULL, &report, NULL),
                 0);
    memcpy(again, F, sizeof F);
    settings.warm_start = 1;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, &settings, d, again, NULL, &second, NULL),
                 0);
    CHECK(second.iterations <= report.iterations);
    for (int i = 0; i < 8; i++) CHECK(fabs(F[i] - again[i]) < 1e-9);
    settings.warm_start = 0;
    settings.memory_limit = 1000;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, &settings, d, F, NULL, &report, NULL),
                 SIGNORINI_STATUS_MEMORY_LIMIT);
    CHECK_TEXT(signorini_last_error(), "the largest island has 2 pairs: 0, 2");
    settings.memory_limit = 0;
    settings.max_iterations = 1;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &W, q, NULL, SIGNORINI_LAW_COULOMB, half,
                                                    NULL, &settings, d, F, NULL, &report, NULL),
                 SIGNORINI_STATUS_ITERATION_LIMIT);
    CHECK_TEXT(signorini_last_error(), "of 2 islands are solved");
}

static void nothing_to_do(void)
{
    const int32_t start[1] = {0};
    const signorini_sparse W = {.struct_size = sizeof W, .index_bytes = 4, .col_start = start};
    CHECK_STATUS(solve_flexibility_sparse(3, 0, &W, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL,
                                                    NULL, NULL, NULL, NULL, NULL, NULL, NULL),
                 0);
}

/* Faults of the matrix, or of an argument beside it. */
static void refusals(void)
{
    const double nan_q[8] = {0, NAN}, wrong_gap[4] = {0, NAN}, wrong_mu[4] = {0.5, -0.1};
    double d[8] = {0}, F[8] = {0}, changed[12];
    int32_t rows[12];
    signorini_sparse sound = corners(), size = sound, base = sound, width = sound, short_row = sound;
    signorini_sparse nan = sound, large = sound, zero = sound, outside = sound, twice = sound;
    signorini_sparse upper = sound, no_values = sound, small = sound, skew = sound;
    size.size = 7;
    base.index_base = 1;
    width.index_bytes = 2;
    short_row.nnz = 11;
    upper.triangle = SIGNORINI_TRIANGLE_UPPER;
    no_values.values = NULL;
    small.struct_size = 32;
    static const double zeros[12];
    zero.values = zeros;
    memcpy(changed, values, sizeof values);
    changed[3] = NAN;
    nan.values = changed;
    const double too_large[12] = {0.5, -0.6, 0.5, 0.5, 1, -1, 1, 1, 0.5, 0.5, 1, 1};
    large.values = too_large;
    memcpy(rows, row, sizeof row);
    rows[11] = 8;
    outside.row = rows;
    const int32_t same[12] = {0, 0, 1, 4, 2, 7, 3, 6, 4, 5, 6, 7};
    twice.row = same;
    const int32_t skew_start[9] = {0, 2, 4, 5, 6, 7, 8, 9, 10}, skew_row[10] = {0, 1, 0, 1, 2, 3, 4, 5, 6, 7};
    const double skew_values[10] = {1, 0.25, 0.5, 1, 1, 1, 1, 1, 1, 1};
    skew.triangle = SIGNORINI_TRIANGLE_FULL;
    skew.nnz = 10;
    skew.col_start = skew_start;
    skew.row = skew_row;
    skew.values = skew_values;
    const struct {
        int32_t dim;
        int64_t pairs;
        const signorini_sparse *W;
        const double *q, *gap;
        int32_t law;
        const double *mu;
        double *d, *F;
        int32_t status;
        const char *said;
    } cases[] = {
        {4, 4, &sound, q, NULL, 1, half, d, F, -1, "dim is 4"},
        {2, -4, &sound, q, NULL, 1, half, d, F, -2, "pairs is -4"},
        {2, 4, NULL, q, NULL, 1, half, d, F, -3, "W is NULL"},
        {2, 4, &size, q, NULL, 1, half, d, F, -3, "col_start"},
        {2, 3, &sound, q, NULL, 1, half, d, F, -3, "W: size is 8, it must be dim * pairs, which is 6"},
        {2, 4, &base, q, NULL, 1, half, d, F, -3, "index_base is 1"},
        {2, 4, &width, q, NULL, 1, half, d, F, -3, "W: index_bytes is 2"},
        {2, 4, &short_row, q, NULL, 1, half, d, F, -3, "nnz is"},
        {2, 4, &upper, q, NULL, 1, half, d, F, -3, "W[5,0] is not in the triangle"},
        {2, 4, &no_values, q, NULL, 1, half, d, F, -3, "W: values is NULL"},
        {2, 4, &small, q, NULL, 1, half, d, F, -3, "W: struct_size is 32"},
        {2, 4, &zero, q, NULL, 1, half, d, F, -3, "W is zero"},
        {2, 4, &nan, q, NULL, 1, half, d, F, -3, "W[4,1] is not finite"},
        {2, 4, &large, q, NULL, 1, half, d, F, -3, "W[5,0] is -0.6, more than its diagonal allows"},
        {2, 4, &outside, q, NULL, 1, half, d, F, -3, "row[11], in column 7, is 8"},
        {2, 4, &twice, q, NULL, 1, half, d, F, -3, "row 0 is listed twice"},
        {2, 4, &skew, q, NULL, 1, half, d, F, -3, "W is not symmetric: W[1,0] is 0.25"},
        {2, 4, &sound, nan_q, NULL, 1, half, d, F, -3, "f[1] is not finite"},
        {2, 4, &sound, NULL, NULL, 1, half, d, F, -3, "f is NULL"},
        {2, 4, &sound, q, wrong_gap, 1, half, d, F, -5, "gap[1]"},
        {2, 4, &sound, q, NULL, 77, half, d, F, -6, "law"},
        {2, 4, &sound, q, NULL, 1, wrong_mu, d, F, -7, "[1]"},
        {2, 4, &sound, q, NULL, 1, half, NULL, F, -10, "d is NULL"},
        {2, 4, &sound, q, NULL, 1, half, d, NULL, -11, "F is NULL"},
        {2, 4, &sound, q, NULL, 1, half, d, d, -11, "overlap"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        CHECK_STATUS(solve_flexibility_sparse(
                         cases[i].dim, cases[i].pairs, cases[i].W, cases[i].q, cases[i].gap,
                         cases[i].law, cases[i].mu, NULL, NULL, cases[i].d, cases[i].F, NULL, NULL, NULL),
                     cases[i].status);
        CHECK_TEXT(signorini_last_error(), cases[i].said);
    }
    const double wrong_slip[4] = {0, NAN};
    signorini_settings settings;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &sound, q, NULL, 1, half, wrong_slip, NULL, d,
                                                    F, NULL, NULL, NULL), -8);
    CHECK_TEXT(signorini_last_error(), "slip0[1]");
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.tolerance = -1;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &sound, q, NULL, 1, half, NULL, &settings, d,
                                                    F, NULL, NULL, NULL), -9);
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.warm_start = 1;
    F[2] = NAN;
    CHECK_STATUS(solve_flexibility_sparse(2, 4, &sound, q, NULL, 1, half, NULL, &settings, d,
                                                    F, NULL, NULL, NULL), -11);
    CHECK_TEXT(signorini_last_error(), "F[2] is not finite");
}

int main(void)
{
    two_corners();
    other_forms();
    one_contradicts();
    settings_count();
    nothing_to_do();
    refusals();
    return check_summary("flexibility_sparse");
}
