/*
 * Models of products and solutions: right functions, and functions that are wrong or fail; and models
 * in full space.
 */

#include "check.h"

#include <stdlib.h>

/* A chain of P nodes: along each axis a spring of 1 between neighbours and one of 0.5 to the ground. */
enum { P = 5, N = 2 * P };

/* Faults of a host. */
enum wrong {
    RIGHT, FAILS, NOT_A_NUMBER, UNSYMMETRIC, LEAVES_OUT, RESISTS_NOTHING, INVERTS_NOTHING, MOVES_HELD
};

typedef struct host {
    enum wrong wrong;
    int products, inverses, solutions, changes;
    /* The product that fails, and the solution; 0: none. */
    int fails_at, loses_at;
    /* Components that the host's factor holds; whether it is lost, and how often it was asked for then. */
    int32_t factor[N];
    int lost, stale;
} host;

static double entry(int i, int j)
{
    if (i == j) return i / 2 == 0 || i / 2 == P - 1 ? 1.5 : 2.5;
    return abs(i - j) == 2 ? -1 : 0;
}

static int32_t stiffness(void *user, const double *x, double *y)
{
    host *h = user;
    h->products++;
    if (h->wrong == FAILS || h->products == h->fails_at) return 42;
    for (int i = 0; i < N; i++) {
        if (h->wrong == LEAVES_OUT && i == 4) continue;
        y[i] = 0;
        for (int j = 0; j < N; j++) y[i] += entry(i, j) * x[j];
    }
    if (h->wrong == NOT_A_NUMBER) y[7] = NAN;
    if (h->wrong == RESISTS_NOTHING) memset(y, 0, N * sizeof *y);
    if (h->wrong == UNSYMMETRIC) y[0] += 0.1 * x[1];
    return 0;
}

/* Gaussian elimination of the free components. */
static void solve(const int32_t *held, const double *x, double *y)
{
    double a[N][N + 1];
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) a[i][j] = held[i] || held[j] ? i == j : entry(i, j);
        a[i][N] = held[i] ? 0 : x[i];
    }
    for (int p = 0; p < N; p++)
        for (int i = p + 1; i < N; i++)
            for (int j = N; j >= p; j--) a[i][j] -= a[i][p] / a[p][p] * a[p][j];
    for (int i = N - 1; i >= 0; i--) {
        y[i] = a[i][N];
        for (int j = i + 1; j < N; j++) y[i] -= a[i][j] * y[j];
        y[i] /= a[i][i];
    }
}

static int32_t inverse(void *user, const double *x, double *y)
{
    static const int32_t none[N];
    host *h = user;
    h->inverses++;
    solve(none, x, y);
    if (h->wrong == INVERTS_NOTHING) memset(y, 0, N * sizeof *y);
    return 0;
}

static int32_t held_solution(void *user, const int32_t *held, int32_t changed, const double *x,
                             double *y)
{
    host *h = user;
    h->solutions++;
    h->changes += changed != 0;
    if (h->solutions == h->loses_at) {
        h->lost = 1;
        return 43;
    }
    if (changed) {
        memcpy(h->factor, held, sizeof h->factor);
        h->lost = 0;
    }
    h->stale += h->lost;
    solve(h->factor, x, y);
    /* Linear, symmetric and positive, and wrong. */
    if (h->wrong == MOVES_HELD && held[0]) y[0] = x[0];
    return 0;
}

static signorini_operator of(host *h)
{
    signorini_operator K = {.struct_size = sizeof K, .dim = 2, .pairs = P, .stiffness = stiffness,
                            .inverse = inverse, .user = h};
    return K;
}

static const double f[N] = {1, 0.1, 0.5, 0.6, -0.3, 0.2, 2, -0.4, 1, 1}, mu[P] = {.3, .3, .3, .3, .3},
                    gap[P] = {0, 0.01, 0, 0.02, 0};

static void check_answers(void)
{
    double K[N * N], d[N], F[N], expected[N], forces[N], u[N];
    int32_t state[P];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) K[i + N * j] = entry(i, j);
    CHECK_STATUS(signorini_solve(2, P, K, N, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, expected,
                                 forces, NULL, NULL, NULL), 0);
    for (int with_held = 0; with_held <= 1; with_held++) {
        host h = {0};
        signorini_operator given = of(&h);
        if (with_held) given.held = held_solution;
        signorini_model *model = NULL;
        CHECK_STATUS(signorini_model_new_operator(&given, &model), 0);
        CHECK(model_data(model).dim == 2 && model_data(model).pairs == P);
        CHECK(model_data(model).host_size == N);
        signorini_report report;
        CHECK_STATUS(signorini_report_default(&report, sizeof report), 0);
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d, F, state, NULL, &report, NULL), 0);
        CHECK(report.method == SIGNORINI_METHOD_NEWTON && report.eta <= 1e-10);
        CHECK(with_held ? h.solutions > 0 && h.changes > 0 : h.solutions == 0 && h.inverses > 0);
        for (int i = 0; i < N; i++) {
            CHECK_NEAR(d[i], expected[i]);
            CHECK_NEAR(F[i], forces[i]);
        }
        CHECK_STATUS(signorini_model_certify(model, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                             1e-10, d, NULL, NULL, NULL), 0);
        CHECK_STATUS(signorini_model_recover(model, 1, f, NULL, d, u), 0);
        CHECK(memcmp(u, d, sizeof u) == 0);
        CHECK_STATUS(copy_stiffness(model, K), -1);
        CHECK(model_data(model).kind == SIGNORINI_MODEL_OPERATOR);
        CHECK_STATUS(signorini_model_prove(model, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, d, NULL, NULL,
                                           NULL, NULL), -1);
        CHECK_TEXT(signorini_last_error(), "no condensed matrix");
        signorini_settings settings;
        signorini_settings_default(&settings, sizeof settings);
        settings.method = SIGNORINI_METHOD_LEMKE;
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           &settings, d, F, NULL, NULL, NULL, NULL), -9);
        CHECK_TEXT(signorini_last_error(), "condensed matrix");
        signorini_model_free(model);
    }
}

static void check_refusals(void)
{
    static const struct { enum wrong wrong; const char *words; } cases[] = {
        {FAILS, "has returned 42"},
        {NOT_A_NUMBER, "y[7] is not finite"},
        {UNSYMMETRIC, "not symmetric"},
        {LEAVES_OUT, "y[4] is not finite, or was not written"},
    };
    signorini_model *model = NULL;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        host h = {.wrong = cases[k].wrong};
        const signorini_operator given = of(&h);
        CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
        CHECK_TEXT(signorini_last_error(), cases[k].words);
        CHECK(model == NULL);
    }
    host h = {.wrong = RESISTS_NOTHING};
    signorini_operator given = of(&h);
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_TEXT(signorini_last_error(), "K_rel resists nothing");
    h.wrong = INVERTS_NOTHING;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_TEXT(signorini_last_error(), "W is not positive definite");
    h.wrong = MOVES_HELD;
    given.held = held_solution;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_TEXT(signorini_last_error(), "y[0] is held and is not 0");
    h.wrong = RIGHT;
    given = of(&h);
    given.stiffness = NULL;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_TEXT(signorini_last_error(), "stiffness is NULL");
    given = of(&h);
    given.inverse = NULL;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_TEXT(signorini_last_error(), "give one of them");
    given = of(&h);
    given.dim = 4;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    given = of(&h);
    given.struct_size = 8;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), -1);
    CHECK_STATUS(signorini_model_new_operator(NULL, &model), -1);
    given = of(&h);
    CHECK_STATUS(signorini_model_new_operator(&given, NULL), -2);
}

/* A function that fails later ends the call; then the model serves again. */
static void check_failure(void)
{
    host h = {0};
    const signorini_operator given = of(&h);
    signorini_model *model = NULL;
    double d[N], F[N];
    CHECK_STATUS(signorini_model_new_operator(&given, &model), 0);
    for (int more = 1; more <= 4; more++) {
        h.fails_at = h.products + more;
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d, F, NULL, NULL, NULL, NULL), -1);
        CHECK_TEXT(signorini_last_error(), "K_rel x has returned 42");
        h.fails_at = 0;
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d, F, NULL, NULL, NULL, NULL), 0);
    }
    signorini_model_free(model);
}

/* A host that fails to factorise has no factor: the next call tells it to make one. */
static void check_lost_factor(void)
{
    host h = {0};
    signorini_operator given = of(&h);
    given.inverse = NULL;
    given.held = held_solution;
    signorini_model *model = NULL;
    double d[N], F[N], expected[N];
    CHECK_STATUS(signorini_model_new_operator(&given, &model), 0);
    const int before = h.solutions;
    CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL,
                                       expected, F, NULL, NULL, NULL, NULL), 0);
    const int solutions = h.solutions - before;
    CHECK(solutions > 0);
    for (int at = 1; at <= solutions; at++) {
        h.loses_at = h.solutions + at;
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d, F, NULL, NULL, NULL, NULL), -1);
        CHECK_TEXT(signorini_last_error(), "has returned 43");
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d, F, NULL, NULL, NULL, NULL), 0);
        CHECK(h.stale == 0);
        for (int i = 0; i < N; i++) CHECK_NEAR(d[i], expected[i]);
    }
    signorini_model_free(model);
}

/* The chain as a sparse matrix, every node on the plane. */
static void check_full_space(void)
{
    int64_t col_start[N + 1] = {0}, row[3 * N], slaves[N];
    double values[3 * N], normals[N], d[2][N], F[2][N];
    for (int j = 0; j < N; j++) {
        slaves[j] = j;
        normals[j] = j % 2 ? 0 : 1;
        col_start[j + 1] = col_start[j];
        for (int i = j; i < N; i++)
            if (entry(i, j) != 0) {
                row[col_start[j + 1]] = i;
                values[col_start[j + 1]++] = entry(i, j);
            }
    }
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
        .triangle = SIGNORINI_TRIANGLE_LOWER, .size = N, .nnz = col_start[N],
        .col_start = col_start, .row = row, .values = values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = P,
        .slaves = slaves, .normals = normals};
    signorini_settings settings;
    signorini_settings_default(&settings, sizeof settings);
    for (int full = 0; full <= 1; full++) {
        settings.full_space = full;
        signorini_model *model = NULL;
        CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, &pairs, &settings, &model), 0);
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           NULL, d[full], F[full], NULL, NULL, NULL, NULL), 0);
        double matrix[N * N];
        CHECK_STATUS(copy_stiffness(model, matrix), full ? -1 : 0);
        signorini_model_free(model);
    }
    for (int i = 0; i < N; i++) {
        CHECK_NEAR(d[1][i], d[0][i]);
        CHECK_NEAR(F[1][i], F[0][i]);
    }
    settings.reserved = 1;
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, &pairs, &settings, &model), -5);
    CHECK_TEXT(signorini_last_error(), "reserved is 1");
}

int main(void)
{
    check_answers();
    check_refusals();
    check_failure();
    check_lost_factor();
    check_full_space();
    return check_summary("operator");
}
