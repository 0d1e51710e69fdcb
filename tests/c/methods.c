/*
 * Answers to a caller about methods and other solutions: the choice of the default, several
 * solutions, the certificate of displacements from elsewhere, LCPs. Answers
 * in closed form.
 */

#include "chains.h"
#include "check.h"

#include <stddef.h>

enum {
    AUTO = SIGNORINI_METHOD_AUTO,
    LEMKE = SIGNORINI_METHOD_LEMKE,
    BLOCK_PIVOTING = SIGNORINI_METHOD_BLOCK_PIVOTING,
    NEWTON = SIGNORINI_METHOD_NEWTON
};

static signorini_settings settings_for(int32_t method)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.method = method;
    return settings;
}

static signorini_report blank_report(void)
{
    signorini_report report;
    memset(&report, 0xFF, sizeof report);
    report.struct_size = sizeof report;
    return report;
}

/* ---- several solutions ---- */

/*
 * Klarbring's pair, f = (1, 1.5): with mu = 2 it sticks, slips by 0.5 under the pressure 0.5 or
 * opens to (-0.5, 2); the second one is unstable, k_tt - mu k_nt = -1. With mu = 0.4 it is one of a
 * kind: 2 mu < 1.
 */
static const double klarbring_K[] = {2, 1, 1, 1}, klarbring_f[] = {1, 1.5}, touching[] = {0};
static const double known_d[3][2] = {{0, 0}, {0, 0.5}, {-0.5, 2}};
static const double known_F[3][2] = {{-1, -1.5}, {-0.5, -1}, {0, 0}};
static const int32_t known_state[] = {SIGNORINI_STATE_STICK, SIGNORINI_STATE_SLIP,
                                      SIGNORINI_STATE_OPEN};

/* Which of the three an answer is, to 1e-9; checks its forces and state. */
static int which(const double *d, const double *F, int32_t state)
{
    for (int i = 0; i < 3; i++) {
        if (fabs(d[0] - known_d[i][0]) > 1e-9 || fabs(d[1] - known_d[i][1]) > 1e-9) continue;
        CHECK_NEAR(F[0], known_F[i][0]);
        CHECK_NEAR(F[1], known_F[i][1]);
        CHECK(state == known_state[i]);
        return i;
    }
    CHECK(!"one of the three solutions");
    return -1;
}

/* Room for a second solution; NaN before. */
typedef struct other {
    double d[2], F[2];
    int32_t state;
} other;

static int klarbring_with(double mu, const signorini_settings *settings, double *d,
                          signorini_report *report, other *second)
{
    double F[2];
    int32_t state;
    signorini_extra extra;
    memset(second, 0xFF, sizeof *second);
    CHECK_STATUS(signorini_extra_default(&extra, sizeof extra), 0);
    extra.second_d = second->d;
    extra.second_F = second->F;
    extra.second_state = &second->state;
    *report = blank_report();
    CHECK_STATUS(signorini_solve(2, 1, klarbring_K, 2, klarbring_f, touching, SIGNORINI_LAW_COULOMB,
                                 &mu, NULL, settings, d, F, &state, report, &extra),
                 SIGNORINI_STATUS_SOLVED);
    CHECK(report->eta <= 1e-10 && (report->second == 0 || report->second == 1));
    return mu > 1 ? which(d, F, state) : -1;
}

static int klarbring(double mu, const signorini_settings *settings, double *d,
                     signorini_report *report)
{
    other second;
    return klarbring_with(mu, settings, d, report, &second);
}

static void the_second_solution_has_its_own_arrays(void)
{
    const int32_t methods[] = {AUTO, LEMKE, NEWTON};
    for (int i = 0; i < 3; i++) {
        signorini_settings settings = settings_for(methods[i]);
        signorini_report report;
        other second;
        double d[2];
        settings.search = SIGNORINI_SEARCH_OTHERS;
        const int first = klarbring_with(2, &settings, d, &report, &second);
        CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_SEVERAL && report.second == 1);
        CHECK(report.orientation == 0 || report.orientation == (first == 1 ? -1 : 1));
        CHECK(which(second.d, second.F, second.state) != first);
        /* One of a kind: no second one, and zeros. */
        klarbring_with(0.4, &settings, d, &report, &second);
        CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_UNIQUE && report.second == 0);
        CHECK(second.d[0] == 0 && second.d[1] == 0 && second.F[0] == 0 && second.F[1] == 0);
        CHECK(second.state == SIGNORINI_STATE_OPEN);
    }
}

static void an_unstable_solution_is_known_by_its_orientation(void)
{
    signorini_settings settings = settings_for(NEWTON);
    signorini_report report;
    settings.warm_start = 1;
    for (int i = 0; i < 3; i++) {
        double d[2] = {known_d[i][0], known_d[i][1]};
        CHECK(klarbring(2, &settings, d, &report) == i);
        CHECK(report.orientation == (i == 1 ? -1 : 1));
        CHECK(i != 1 || report.uniqueness == SIGNORINI_UNIQUENESS_SEVERAL);
        CHECK(report.method == NEWTON && report.first_method == NEWTON);
        CHECK(report.fallback == SIGNORINI_FALLBACK_NONE);
    }
    /* The default does not stay there. */
    settings.method = AUTO;
    double d[2] = {known_d[1][0], known_d[1][1]};
    CHECK(klarbring(2, &settings, d, &report) != 1);
    CHECK(report.first_method == NEWTON && report.fallback == SIGNORINI_FALLBACK_UNSTABLE);
    CHECK(report.orientation == 1 && report.uniqueness == SIGNORINI_UNIQUENESS_SEVERAL);
}

/* ---- the default ---- */

static void the_default_says_what_it_chose(void)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        for (int friction = 0; friction < 2; friction++) {
            chain c = chain_new(dim, 12, 0.5, 9);
            for (int64_t i = 0; i < c.pairs; i++) c.mu[i] *= friction;
            signorini_report report = blank_report();
            CHECK_STATUS(signorini_solve(dim, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB,
                                         c.mu, NULL, NULL, c.d, c.F, c.state, &report, NULL),
                         SIGNORINI_STATUS_SOLVED);
            CHECK(report.method > AUTO && report.method <= SIGNORINI_METHOD_PATH);
            /* The header says which method is first. */
            const int32_t first =
                friction ? SIGNORINI_METHOD_NEWTON : SIGNORINI_METHOD_BLOCK_PIVOTING;
            CHECK(report.first_method == first);
            const int direct = report.method == BLOCK_PIVOTING || report.method == NEWTON;
            CHECK(direct == (report.factorisations > 0));
            chain_free(&c);
        }
    }
}

/* ---- the certificate ---- */

static void displacements_of_any_origin_are_measured(void)
{
    /* One pair slips by 1, one is open. */
    const double K[16] = {5, [5] = 3, [10] = 1, [15] = 1}, f[4] = {10, 8, -1, 0};
    const double gap[2] = {0, 0.5}, mu[2] = {0.5, 0.5}, d[4] = {0, 1, -1, 0};
    double F[4];
    int32_t state[2];
    signorini_report report = blank_report();
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-15, d, F,
                                   state, &report),
                 SIGNORINI_STATUS_SOLVED);
    CHECK(signorini_last_error()[0] == '\0');
    CHECK(report.status == SIGNORINI_STATUS_SOLVED && report.eta == 0 &&
          report.struct_size == sizeof report);
    CHECK(report.pairs_open == 1 && report.pairs_slipping == 1 && report.pairs_sticking == 0);
    CHECK(state[0] == SIGNORINI_STATE_SLIP && state[1] == SIGNORINI_STATE_OPEN);
    CHECK(F[0] == -10 && F[1] == -5 && F[2] == 0 && F[3] == 0);
    CHECK(report.iterations == 0 && report.factorisations == 0 && report.second == 0);
    CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN && report.orientation == 0);

    /* 0.25 into the obstacle, pulled at by 5 * 0.25 too little, and not slid far enough. */
    const double off[4] = {0.25, 0.5, -1, 0};
    report = blank_report();
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 0.1, off, F,
                                   state, &report),
                 SIGNORINI_STATUS_NOT_A_SOLUTION);
    CHECK_TEXT(signorini_last_error(), "not a solution");
    CHECK_TEXT(signorini_last_error(), "eta is");
    CHECK(report.status == SIGNORINI_STATUS_NOT_A_SOLUTION);
    CHECK_NEAR(report.penetration, 0.25);
    /* K d - f = (-8.75, -6.5): 6.5 against 0.5 * 8.75. */
    CHECK_NEAR(report.cone_excess, 6.5 - 4.375);
    CHECK_NEAR(report.equilibrium, 6.5 - 4.375);
    CHECK_NEAR(F[0], -8.75);
    CHECK_NEAR(F[1], -4.375);
    /* |(5 * 0.25, -6.5 + 4.375)| / |f|, as |f| = sqrt(165) is larger than |K d - f|. */
    CHECK_NEAR(report.eta, hypot(1.25, 2.125) / sqrt(165));

    /* Pulled. */
    const double pulled[4] = {3, 1, -1, 0}, far_gap[2] = {3, 0.5};
    report = blank_report();
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, far_gap, SIGNORINI_LAW_COULOMB, mu, NULL, 0.1,
                                   pulled, NULL, NULL, &report),
                 SIGNORINI_STATUS_NOT_A_SOLUTION);
    CHECK_NEAR(report.tension, 5);
    /* Unwanted outputs may be NULL, and inputs may be one array. */
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-10, d,
                                   NULL, NULL, NULL), 0);
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, f, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-10, f,
                                   NULL, NULL, NULL),
                 SIGNORINI_STATUS_NOT_A_SOLUTION);
    CHECK_STATUS(certify_condensed(2, 0, NULL, 1, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL, NULL,
                                   0.1, NULL, NULL, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    /* The tolerance decides. */
    const double near_it[4] = {0, 1 + 1e-6, -1, 0};
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-5,
                                   near_it, NULL, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(certify_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-8,
                                   near_it, NULL, NULL, NULL),
                 SIGNORINI_STATUS_NOT_A_SOLUTION);
}

static void what_is_solved_is_certified(void)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        chain c = chain_new(dim, 15, 0.3, 10);
        double *F = chain_numbers(c.n), *slip = chain_numbers(c.n);
        uint64_t seed = 11;
        for (int64_t i = 0; i < (dim - 1) * c.pairs; i++) slip[i] = 0.1 * chain_draw(&seed);
        int32_t state[15];
        signorini_report solved = blank_report(), measured = blank_report();
        CHECK_STATUS(signorini_solve(dim, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB,
                                     c.mu, slip, NULL, c.d, c.F, c.state, &solved, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK_STATUS(certify_condensed(dim, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB,
                                       c.mu, slip, 1e-10, c.d, F, state, &measured),
                     SIGNORINI_STATUS_SOLVED);
        /* eta of a solution is that of d before it is rounded to doubles; rounding covers it. */
        CHECK(measured.rounding == solved.rounding);
        CHECK(fabs(measured.eta - solved.eta) <= solved.rounding);
        CHECK(measured.penetration == solved.penetration && measured.tension == solved.tension);
        CHECK(measured.equilibrium == solved.equilibrium);
        CHECK(measured.pairs_open == solved.pairs_open &&
              measured.pairs_slipping == solved.pairs_slipping);
        CHECK(memcmp(F, c.F, (size_t)c.n * sizeof *F) == 0);
        CHECK(memcmp(state, c.state, sizeof state) == 0);
        free(F);
        free(slip);
        chain_free(&c);
    }
}

/* ---- LCPs ---- */

static int32_t lcp(int32_t method, int64_t n, const double *M, const double *q, double *w,
                   double *z, double *y)
{
    const signorini_settings settings = settings_for(method);
    signorini_report report = blank_report();
    const int32_t status =
        signorini_lcp_solve(n, M, n > 1 ? n : 1, q, NULL, &settings, w, z, y, &report);
    CHECK_STATUS(report.status, status);
    CHECK(method == AUTO ? report.method == BLOCK_PIVOTING || report.method == LEMKE
                         : report.method == method);
    CHECK(report.second == 0 && report.orientation == 0);
    CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN);
    CHECK((status == SIGNORINI_STATUS_SOLVED) == (signorini_last_error()[0] == '\0'));
    return status;
}

static void lcps_in_closed_form(void)
{
    const int32_t methods[] = {AUTO, BLOCK_PIVOTING, LEMKE};
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6}, plenty[] = {3, 0}, mixed[] = {-1, 2};
    const double identity[] = {1, 0, 0, 1}, P[] = {1, 0, 0, -4, 1, 0, 0, -4, 1}, q3[] = {1, -1, -2};
    double w[3], z[3], y[3];
    for (int i = 0; i < 3; i++) {
        memset(y, 0xFF, sizeof y);
        CHECK_STATUS(lcp(methods[i], 2, M, q, w, z, y), SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(z[0], 4.0 / 3);
        CHECK_NEAR(z[1], 7.0 / 3);
        CHECK(w[0] == 0 && w[1] == 0 && y[0] == 0 && y[1] == 0);
        CHECK_STATUS(lcp(methods[i], 2, identity, mixed, w, z, y), SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(z[0], 1);
        CHECK_NEAR(w[1], 2);
        CHECK(w[0] == 0 && z[1] == 0);
        CHECK_STATUS(lcp(methods[i], 2, M, plenty, w, z, y), SIGNORINI_STATUS_SOLVED);
        CHECK(z[0] == 0 && z[1] == 0 && w[0] == 3 && w[1] == 0);
        CHECK_STATUS(lcp(methods[i], 0, NULL, NULL, NULL, NULL, NULL), SIGNORINI_STATUS_SOLVED);
        /* A P-matrix that is neither symmetric nor positive definite. */
        CHECK_STATUS(lcp(methods[i], 3, P, q3, w, z, y), SIGNORINI_STATUS_SOLVED);
        for (int j = 0; j < 3; j++) {
            CHECK(z[j] >= 0 && w[j] >= 0 && z[j] * w[j] == 0);
            CHECK_NEAR(q3[j] + P[j] * z[0] + P[j + 3] * z[1] + P[j + 6] * z[2] - w[j], 0);
        }
    }
    /* Padding is not looked at; what is not wanted may be NULL. */
    const double padded[] = {2, 1, NAN, NAN, 1, 2};
    CHECK_STATUS(signorini_lcp_solve(2, padded, 4, q, NULL, NULL, w, z, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(z[1], 7.0 / 3);
}

static void lcps_without_solution(void)
{
    /* w1 = -1 - z2: y = (1, 0) proves that nothing is feasible. */
    const double skew[] = {0, 1, -1, 0}, q[] = {-1, 3};
    double w[2], z[2], y[2];
    for (int32_t method = AUTO; method <= LEMKE; method += LEMKE) {
        CHECK_STATUS(lcp(method, 2, skew, q, w, z, y), SIGNORINI_STATUS_NO_EQUILIBRIUM);
        CHECK(y[0] >= 0 && y[1] >= 0);
        CHECK(skew[0] * y[0] + skew[1] * y[1] <= 1e-12);
        CHECK(skew[2] * y[0] + skew[3] * y[1] <= 1e-12);
        CHECK(q[0] * y[0] + q[1] * y[1] < 0);
        CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
        CHECK(signorini_last_error()[0] != '\0');
    }
    /* By block pivoting alone it is not decided, and nothing is claimed. */
    CHECK(lcp(BLOCK_PIVOTING, 2, skew, q, w, z, y) > 0);
    CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
    CHECK(y[0] == 0 && y[1] == 0);
}

static int32_t cancel(void *user, const signorini_progress *progress)
{
    (void)progress;
    return ++*(int *)user == 1;
}

static void budgets_of_lcps(void)
{
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    const int32_t methods[] = {AUTO, BLOCK_PIVOTING, LEMKE};
    for (int i = 0; i < 3; i++) {
        int calls = 0;
        double w[2] = {NAN, NAN}, z[2] = {NAN, NAN};
        signorini_settings settings = settings_for(methods[i]);
        signorini_report report = blank_report();
        settings.progress = cancel;
        settings.user = &calls;
        CHECK_STATUS(signorini_lcp_solve(2, M, 2, q, NULL, &settings, w, z, NULL, &report),
                     SIGNORINI_STATUS_CANCELLED);
        CHECK(calls == 1 && report.iterations == 0);
        CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
        CHECK_TEXT(signorini_last_error(), "cancelled");
    }
}

int main(void)
{
    the_second_solution_has_its_own_arrays();
    an_unstable_solution_is_known_by_its_orientation();
    the_default_says_what_it_chose();
    displacements_of_any_origin_are_measured();
    what_is_solved_is_certified();
    lcps_in_closed_form();
    lcps_without_solution();
    budgets_of_lcps();
    return check_summary("methods");
}
