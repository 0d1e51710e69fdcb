/*
 * A program of an older version: it knows the declarations of then, and runs with the library of today. Answers
 * are closed forms.
 */

#include "older_header.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* The sizes of then. */
_Static_assert(sizeof(signorini_settings) == 96, "settings");
_Static_assert(sizeof(signorini_report) == 176, "report");
_Static_assert(sizeof(signorini_extra) == 64, "extra");
_Static_assert(sizeof(signorini_sparse) == 64, "sparse");
_Static_assert(sizeof(signorini_pairs) == 88, "pairs");
_Static_assert(sizeof(signorini_progress) == 40, "progress");

static int failed;

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            printf("older_program.c:%d: %s (%s)\n", __LINE__, #condition, signorini_last_error()); \
            failed = 1;                                                                            \
        }                                                                                          \
    } while (0)

static int near(double value, double expected)
{
    return fabs(value - expected) <= 1e-9;
}

static int32_t count(void *user, const signorini_progress *progress)
{
    int *calls = user;
    *calls += progress->iterations >= 0 && progress->elapsed >= 0;
    return 0;
}

/* Pressed by 10 and pushed by 8 against 5 of friction: it slips by (8 - 5) / 3. */
static void one_call(void)
{
    const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5};
    /* The bytes behind each structure of then are the program's own. */
    struct { signorini_settings settings; unsigned char own[64]; } in;
    struct { signorini_report report; double d[2], F[2]; } out;
    struct { signorini_extra extra; unsigned char own[64]; } more;
    double motion[2];
    int calls = 0;
    memset(&in, 0xEE, sizeof in);
    memset(&out, 0xEE, sizeof out);
    memset(&more, 0xEE, sizeof more);
    CHECK(signorini_settings_default(&in.settings, sizeof in.settings) == 0);
    CHECK(signorini_report_default(&out.report, sizeof out.report) == 0);
    CHECK(signorini_extra_default(&more.extra, sizeof more.extra) == 0);
    CHECK(in.own[0] == 0xEE && more.own[0] == 0xEE);
    in.settings.progress = count;
    in.settings.user = &calls;
    more.extra.motion = motion;
    CHECK(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &in.settings, out.d,
                          out.F, NULL, &out.report, &more.extra) == SIGNORINI_STATUS_SOLVED);
    CHECK(near(out.d[0], 0) && near(out.d[1], 1) && near(out.F[0], -10) && near(out.F[1], -5));
    CHECK(out.report.status == 0 && out.report.eta <= 1e-10 && out.report.pairs_slipping == 1);
    CHECK(out.report.second == 0 && motion[0] == 0 && motion[1] == 0 && calls > 0);
    signorini_model *model = NULL;
    CHECK(signorini_model_new_condensed(2, 1, K, 2, NULL, &model) == 0);
    CHECK(signorini_model_certify(model, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-9, out.d, NULL,
                                  NULL, &out.report) == 0);
    signorini_model_free(model);
}

/* Two bars in a row: closing the gap takes (30 / 100 - 0.1) / (1 / 100 + 1 / 100) = 10 and friction 2 of the 6. */
static void sparse_matrix(void)
{
    enum { H = 8 };
    const int32_t col_start[H + 1] = {0, 2, 4, 5, 6, 8, 10, 11, 12};
    const int32_t row[12] = {0, 2, 1, 3, 2, 3, 4, 6, 5, 7, 6, 7};
    const double values[12] = {100, -100, 10, -10, 100, 10, 100, -100, 10, -10, 100, 10};
    const int64_t fixed[4] = {0, 1, 6, 7}, slave[2] = {2, 3}, start[2] = {0, 1}, master[2] = {4, 5};
    const double weight[1] = {1}, normal[2] = {1, 0}, gap[1] = {0.1}, mu[1] = {0.2};
    const double f[H] = {[2] = 30, [3] = 6};
    struct { signorini_sparse K; unsigned char own[64]; } matrix;
    struct { signorini_pairs pairs; unsigned char own[64]; } contact;
    memset(&matrix, 0xEE, sizeof matrix);
    memset(&contact, 0xEE, sizeof contact);
    matrix.K = (signorini_sparse){.struct_size = sizeof matrix.K, .index_bytes = 4, .size = H,
        .triangle = SIGNORINI_TRIANGLE_LOWER, .nnz = 12, .col_start = col_start, .row = row,
        .values = values};
    contact.pairs = (signorini_pairs){.struct_size = sizeof contact.pairs, .dim = 2, .count = 1,
        .slaves = slave, .master_start = start, .masters = master, .weights = weight,
        .normals = normal};
    double d[2], F[2], u[H];
    int32_t status[1];
    signorini_model *model = NULL;
    signorini_report report = {.struct_size = sizeof report};
    CHECK(signorini_model_new_sparse(&matrix.K, 4, fixed, &contact.pairs, NULL, &model) == 0);
    CHECK(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d, F,
                                NULL, status, &report, NULL) == 0);
    CHECK(signorini_model_recover(model, 1, f, NULL, d, u) == 0);
    CHECK(near(F[0], -10) && near(F[1], -2) && near(u[2], 0.2) && near(u[4], 0.1));
    struct { signorini_model_data data; unsigned char own[64]; } shown;
    memset(&shown, 0xEE, sizeof shown);
    shown.data.struct_size = sizeof shown.data;
    CHECK(signorini_model_view(model, &shown.data) == 0);
    CHECK(shown.data.host_size == H && shown.data.pairs == 1 && shown.data.K && shown.own[0] == 0xEE);
    signorini_model_free(model);
}

int main(void)
{
    CHECK(signorini_abi_version() == SIGNORINI_ABI_VERSION);
    one_call();
    sparse_matrix();
    printf("older_program: %s\n", failed ? "FAILED" : "runs with this library");
    return failed;
}
