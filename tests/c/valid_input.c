/*
 * Valid input is handled, the odd as well as the ordinary: answers in closed form, statuses above
 * zero, optional arguments, and structures of older programs.
 */

#include "chains.h"
#include "check.h"

#include <stddef.h>

enum {
    AUTO = SIGNORINI_METHOD_AUTO,
    NESTED = SIGNORINI_METHOD_SOR_NESTED,
    DIAGONAL = SIGNORINI_METHOD_SOR_DIAGONAL,
    LEMKE = SIGNORINI_METHOD_LEMKE,
    BLOCK_PIVOTING = SIGNORINI_METHOD_BLOCK_PIVOTING,
    NEWTON = SIGNORINI_METHOD_NEWTON,
    PATH = SIGNORINI_METHOD_PATH
};

/* Nonzero if a method is for problems of this dimension, with friction or without. */
static int fits(int32_t method, int32_t dim, int friction)
{
    switch (method) {
    case LEMKE: return dim == 2 || !friction;
    case BLOCK_PIVOTING: return !friction;
    case NEWTON: return dim == 2;
    default: return 1;
    }
}

/* Results of a call, for up to two pairs. */
typedef struct answer {
    double d[6], F[6], motion[6];
    int32_t state[2];
    signorini_report report;
} answer;

/* A problem of one or two pairs without padding. */
typedef struct small {
    int32_t dim;
    int64_t pairs;
    const double *K, *f, *gap, *mu, *slip0;
} small;

#define PROBLEM(...) (&(small){__VA_ARGS__})

static signorini_settings settings_for(int32_t method)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.method = method;
    return settings;
}

static answer blank(void)
{
    answer a;
    memset(&a, 0xFF, sizeof a);
    a.report.struct_size = sizeof a.report;
    return a;
}

/* Every report says this, whatever the problem. */
static void check_report(const signorini_report *report, int32_t status, int64_t pairs)
{
    CHECK(report->struct_size == sizeof *report);
    CHECK_STATUS(report->status, status);
    CHECK(report->second == 0 || report->second == 1);
    CHECK(report->uniqueness >= SIGNORINI_UNIQUENESS_NOT_KNOWN &&
          report->uniqueness <= SIGNORINI_UNIQUENESS_SEVERAL);
    CHECK(report->orientation >= -1 && report->orientation <= 1);
    CHECK(report->fallback >= SIGNORINI_FALLBACK_NONE);
    CHECK(report->fallback <= SIGNORINI_FALLBACK_INACCURATE);
    CHECK(report->fallback != SIGNORINI_FALLBACK_NONE || report->first_method == report->method);
    CHECK(report->factorisations >= 0 && report->refactorisations >= 0);
    CHECK(report->iterations >= 0);
    CHECK(report->pairs_open + report->pairs_slipping + report->pairs_sticking == pairs);
    CHECK(report->pairs_open >= 0 && report->pairs_slipping >= 0 && report->pairs_sticking >= 0);
    CHECK(status != SIGNORINI_STATUS_SOLVED || report->eta <= 1e-10);
    /* A solved problem has a sentence for its remarks. */
    const int is_silent = status == SIGNORINI_STATUS_SOLVED && report->remarks == 0;
    CHECK(is_silent == (signorini_last_error()[0] == '\0'));
}

/* A leading dimension without padding; it is at least 1. */
static int64_t leading(int64_t n)
{
    return n > 1 ? n : 1;
}

/* The motion of escape: zeros, or a proof that no equilibrium exists under Coulomb's law. */
static void check_motion(const small *p, const double *r, int32_t status)
{
    const int32_t dim = p->dim;
    const int64_t n = dim * p->pairs;
    double most = 0, work = 0;
    for (int64_t i = 0; i < n; i++) {
        most = fmax(most, fabs(r[i]));
        if (n > 0) work += p->f[i] * r[i];
    }
    if (status != SIGNORINI_STATUS_NO_EQUILIBRIUM) {
        CHECK(most == 0);
        return;
    }
    CHECK(most == 1 && work > 0);
    for (int64_t i = 0; i < n; i++) {
        double force = 0;
        for (int64_t j = 0; j < n; j++) force += p->K[i + n * j] * r[j];
        CHECK(fabs(force) <= 1e-10 * p->K[i + n * i]);
    }
    /* F . r >= 0 for all F of the cone if -r_n >= mu |r_t|; a pair that never touches has no F. */
    for (int64_t pair = 0; pair < p->pairs; pair++) {
        const double *part = r + dim * pair, t = dim == 2 ? fabs(part[1]) : hypot(part[1], part[2]);
        const double mu = p->mu ? p->mu[pair] : 0;
        CHECK(isinf(p->gap[pair]) || part[0] + mu * t <= 1e-12);
    }
}

static answer solved(const small *p, int32_t law, int32_t method, int32_t expected)
{
    answer a = blank();
    const signorini_settings settings = settings_for(method);
    signorini_extra extra;
    CHECK_STATUS(signorini_extra_default(&extra, sizeof extra), 0);
    extra.motion = a.motion;
    CHECK_STATUS(signorini_solve(p->dim, p->pairs, p->K, leading(p->dim * p->pairs), p->f, p->gap,
                                 law, p->mu, p->slip0, &settings, a.d, a.F, a.state, &a.report,
                                 &extra),
                 expected);
    check_report(&a.report, expected, p->pairs);
    check_motion(p, a.motion, expected);
    return a;
}

static answer coulomb(const small *p, int32_t method, int32_t expected)
{
    const answer a = solved(p, SIGNORINI_LAW_COULOMB, method, expected);
    /* The default tells which it chose. */
    CHECK(method == AUTO ? a.report.method != AUTO : a.report.method == method);
    CHECK(method == AUTO || a.report.fallback == SIGNORINI_FALLBACK_NONE);
    return a;
}

static answer tresca(const small *p, int32_t method, int32_t expected)
{
    return solved(p, SIGNORINI_LAW_TRESCA, method, expected);
}

/* Solves by each method that applies, and compares with the closed form. */
static void agrees(int line, const small *p, const double *d, const double *F,
                   const int32_t *state)
{
    int friction = 0;
    for (int i = 0; i < p->pairs; i++) friction = friction || p->mu[i] != 0;
    small bare = *p;
    bare.mu = NULL;
    /* Without friction twice: mu = 0, and the law that has no parameters. */
    for (int32_t round = 0; round < 2 * (PATH + 1); round++) {
        const int32_t method = round / 2;
        const int frictionless = round % 2;
        if (!fits(method, p->dim, friction) || (frictionless && friction)) continue;
        const int failed_before = checks_failed;
        const answer a = frictionless ? solved(&bare, SIGNORINI_LAW_FRICTIONLESS, method,
                                               SIGNORINI_STATUS_SOLVED)
                                      : coulomb(p, method, SIGNORINI_STATUS_SOLVED);
        for (int i = 0; i < p->dim * p->pairs; i++) {
            CHECK_NEAR(a.d[i], d[i]);
            CHECK_NEAR(a.F[i], F[i]);
        }
        for (int i = 0; i < p->pairs; i++) CHECK(a.state[i] == state[i]);
        if (checks_failed > failed_before && checks_failed <= MOST_PRINTED)
            printf("... by method %d, called at line %d\n", (int)method, line);
    }
}

#define AGREES(p, d, F, ...) agrees(__LINE__, p, d, F, (const int32_t[]){__VA_ARGS__})

static const double zero[6], none[2] = {0, 0}, half[2] = {0.5, 0.5};

/* ---- the three states in closed form ---- */

static void a_pair_that_opens_moves_freely(void)
{
    /* K d = f: (2, 1) from [[4, 1], [1, 3]]. */
    const double K[] = {4, 1, 1, 3}, f[] = {9, 5}, d[] = {2, 1}, gap[] = {2.5};
    AGREES(PROBLEM(2, 1, K, f, gap, half, NULL), d, zero, SIGNORINI_STATE_OPEN);
    AGREES(PROBLEM(2, 1, K, f, gap, none, NULL), d, zero, SIGNORINI_STATE_OPEN);
}

static void an_infinite_gap_never_closes(void)
{
    const double K[] = {2, 0, 0, 4}, f[] = {6000, 8}, d[] = {3000, 2}, gap[] = {INFINITY};
    AGREES(PROBLEM(2, 1, K, f, gap, half, NULL), d, zero, SIGNORINI_STATE_OPEN);
    AGREES(PROBLEM(2, 1, K, f, gap, none, NULL), d, zero, SIGNORINI_STATE_OPEN);
    /* One pair of two. The second presses with 1 and sticks. */
    const double K2[16] = {2, [5] = 2, [10] = 2, [15] = 2}, f2[] = {2, 0, 1, 0.25};
    const double gap2[] = {INFINITY, 0}, d2[] = {1, 0, 0, 0}, F2[] = {0, 0, -1, -0.25};
    AGREES(PROBLEM(2, 2, K2, f2, gap2, half, NULL), d2, F2, SIGNORINI_STATE_OPEN,
           SIGNORINI_STATE_STICK);
}

static void a_negative_gap_presses_without_load(void)
{
    const double K[] = {4, 0, 0, 1}, gap[] = {-0.5}, d[] = {-0.5, 0}, F[] = {-2, 0};
    AGREES(PROBLEM(2, 1, K, zero, gap, none, NULL), d, F, SIGNORINI_STATE_SLIP);
    AGREES(PROBLEM(2, 1, K, zero, gap, half, NULL), d, F, SIGNORINI_STATE_STICK);
}

static void a_pair_inside_the_cone_sticks(void)
{
    const double K[] = {5, 0, 0, 3}, f[] = {10, 1}, F[] = {-10, -1}, gap[] = {0};
    AGREES(PROBLEM(2, 1, K, f, gap, half, NULL), zero, F, SIGNORINI_STATE_STICK);
    const double huge[] = {1e10};
    AGREES(PROBLEM(2, 1, K, f, gap, huge, NULL), zero, F, SIGNORINI_STATE_STICK);
}

static void all_pairs_stick_in_3d(void)
{
    const double K[36] = {4, [7] = 4, [14] = 4, [21] = 4, [28] = 4, [35] = 4,
                          [3] = 1, [18] = 1, [11] = 1, [31] = 1};
    const double f[] = {5, 1, -1, 7, -2, 0.5}, F[] = {-5, -1, 1, -7, 2, -0.5};
    AGREES(PROBLEM(3, 2, K, f, none, half, NULL), zero, F, SIGNORINI_STATE_STICK,
           SIGNORINI_STATE_STICK);
}

static void a_pair_on_the_cone_slips(void)
{
    const double K[] = {5, 0, 0, 3}, f[] = {10, 8}, gap[] = {0}, d[] = {0, 1}, F[] = {-10, -5};
    AGREES(PROBLEM(2, 1, K, f, gap, half, NULL), d, F, SIGNORINI_STATE_SLIP);
    const double f2[] = {10, -8}, d2[] = {0, -1}, F2[] = {-10, 5};
    AGREES(PROBLEM(2, 1, K, f2, gap, half, NULL), d2, F2, SIGNORINI_STATE_SLIP);
}

static void a_slipping_pair_with_coupling(void)
{
    /* 2 d_t = 5 - (4 - d_t) / 2 */
    const double K[] = {2, 1, 1, 2}, f[] = {4, 5}, gap[] = {0}, d[] = {0, 2}, F[] = {-2, -1};
    AGREES(PROBLEM(2, 1, K, f, gap, half, NULL), d, F, SIGNORINI_STATE_SLIP);
}

static void a_pair_slips_along_its_load_in_3d(void)
{
    /* A load of 15 along (3, 4) / 5 against 5 of friction, stiffness 2. */
    const double K[9] = {7, [4] = 2, [8] = 2}, f[] = {10, 9, 12}, gap[] = {0};
    const double d[] = {0, 3, 4}, F[] = {-10, -3, -4};
    AGREES(PROBLEM(3, 1, K, f, gap, half, NULL), d, F, SIGNORINI_STATE_SLIP);
}

static void some_pairs_have_no_friction(void)
{
    const double K[16] = {2, [5] = 2, [10] = 2, [15] = 2}, f[] = {2, 0.5, 2, 0.5};
    const double mu[] = {0, 0.5}, d[] = {0, 0.25, 0, 0}, F[] = {-2, 0, -2, -0.5};
    AGREES(PROBLEM(2, 2, K, f, none, mu, NULL), d, F, SIGNORINI_STATE_SLIP, SIGNORINI_STATE_STICK);
    const double minus[] = {-0.0, -0.0}, d2[] = {0, 0.25, 0, 0.25}, F2[] = {-2, 0, -2, 0};
    AGREES(PROBLEM(2, 2, K, f, none, minus, NULL), d2, F2, SIGNORINI_STATE_SLIP,
           SIGNORINI_STATE_SLIP);
}

static void no_load_no_force(void)
{
    const double K[] = {2, 1, 1, 2}, touching[] = {0}, apart[] = {0.25};
    AGREES(PROBLEM(2, 1, K, zero, touching, half, NULL), zero, zero, SIGNORINI_STATE_OPEN);
    AGREES(PROBLEM(2, 1, K, zero, apart, none, NULL), zero, zero, SIGNORINI_STATE_OPEN);
    const answer a = coulomb(PROBLEM(2, 1, K, zero, touching, half, NULL), NESTED, 0);
    CHECK(a.report.eta == 0 && a.report.equilibrium == 0 && a.report.penetration == 0);
}

static void a_load_may_be_small_against_the_gap(void)
{
    /* 1 N on a steel part a millimetre away moves it by 1e-8 of that gap, or less. */
    const double K[] = {2, 1, 1, 2}, gap[] = {3};
    for (double load = 1; load > 1e-30; load *= 1e-3) {
        const double f[] = {5 * load, 4 * load};
        for (int32_t method = AUTO; method <= PATH; method++) {
            for (int friction = 0; friction <= fits(method, 2, 1); friction++) {
                const answer a = coulomb(PROBLEM(2, 1, K, f, gap, friction ? half : none, NULL),
                                         method, SIGNORINI_STATUS_SOLVED);
                CHECK_NEAR(a.d[0] / load, 2);
                CHECK_NEAR(a.d[1] / load, 1);
                CHECK(a.F[0] == 0 && a.F[1] == 0 && a.state[0] == SIGNORINI_STATE_OPEN);
            }
        }
    }
}

static void a_fixed_component_is_a_decoupled_row(void)
{
    /* The tangential component of the second pair, in both directions of sliding of the first. */
    const double K[16] = {3, 0, 1, 0, 0, 2, 0, 0, 1, 0, 3, 0, 0, 0, 0, 1e6};
    const double f[] = {4, 5, 4, 0}, d[] = {0, 1.5, 0, 0}, F[] = {-4, -2, -4, 0};
    AGREES(PROBLEM(2, 2, K, f, none, half, NULL), d, F, SIGNORINI_STATE_SLIP,
           SIGNORINI_STATE_STICK);
    /* A fixed normal component: no force, open. */
    const double f2[] = {4, 5, 0, 0};
    const double K2[16] = {3, [5] = 2, [10] = 1e6, [15] = 1e6};
    const double F2[] = {-4, -2, 0, 0};
    AGREES(PROBLEM(2, 2, K2, f2, none, half, NULL), d, F2, SIGNORINI_STATE_SLIP,
           SIGNORINI_STATE_OPEN);
}

static void friction_sticks_at_the_reference_slip(void)
{
    const double K[] = {5, 0, 0, 4}, f[] = {10, 2}, gap[] = {0}, slip[] = {0.25};
    const double d[] = {0, 0.25}, F[] = {-10, -1};
    AGREES(PROBLEM(2, 1, K, f, gap, half, slip), d, F, SIGNORINI_STATE_STICK);
    const answer a = coulomb(PROBLEM(2, 1, K, f, gap, half, slip), NESTED, 0);
    CHECK(a.d[1] == slip[0]);
    /* It slides back when the load is gone: 4 * 2 = 8 against 5. */
    const double far_slip[] = {2}, back[] = {0, 1.25}, f0[] = {10, 0}, F0[] = {-10, 5};
    AGREES(PROBLEM(2, 1, K, f0, gap, half, far_slip), back, F0, SIGNORINI_STATE_SLIP);
    /* Without friction nothing rests. */
    const double d1[] = {0, 0.5}, F1[] = {-10, 0};
    AGREES(PROBLEM(2, 1, K, f, gap, none, far_slip), d1, F1, SIGNORINI_STATE_SLIP);
    const double K3[9] = {5, [4] = 4, [8] = 4}, f3[] = {10, 2, -2}, slip3[] = {0.25, -0.25};
    const double d3[] = {0, 0.25, -0.25}, F3[] = {-10, -1, 1};
    AGREES(PROBLEM(3, 1, K3, f3, gap, half, slip3), d3, F3, SIGNORINI_STATE_STICK);
}

static void given_thresholds_by(int32_t method)
{
    const double K[] = {5, 0, 0, 4}, gap[] = {0.5}, g[] = {2};
    /* Open, and the threshold acts all the same. */
    const double f[] = {-1, 6};
    answer a = tresca(PROBLEM(2, 1, K, f, gap, g, NULL), method, SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(a.d[0], -0.2);
    CHECK_NEAR(a.d[1], 1);
    CHECK_NEAR(a.F[0], 0);
    CHECK_NEAR(a.F[1], -2);
    CHECK(a.state[0] == SIGNORINI_STATE_OPEN);
    /* Closed and sliding, whatever the pressure. */
    const double f2[] = {100, -6};
    a = tresca(PROBLEM(2, 1, K, f2, gap, g, NULL), method, SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(a.d[0], 0.5);
    CHECK_NEAR(a.d[1], -1);
    CHECK_NEAR(a.F[0], -97.5);
    CHECK_NEAR(a.F[1], 2);
    CHECK(a.state[0] == SIGNORINI_STATE_SLIP);
    /* Closed and at rest. */
    const double f3[] = {100, 1.5};
    a = tresca(PROBLEM(2, 1, K, f3, gap, g, NULL), method, SIGNORINI_STATUS_SOLVED);
    CHECK(a.d[1] == 0);
    CHECK_NEAR(a.F[1], -1.5);
    CHECK(a.state[0] == SIGNORINI_STATE_STICK);
}

static void given_thresholds(void)
{
    const int32_t methods[] = {AUTO, NESTED, LEMKE, NEWTON, PATH};
    for (int i = 0; i < 4; i++) given_thresholds_by(methods[i]);
    /* No threshold at all. */
    const double K[] = {5, 0, 0, 4}, gap[] = {0.5}, f2[] = {100, -6};
    for (int32_t method = AUTO; method <= PATH; method++) {
        if (method == DIAGONAL) continue; /* It updates thresholds. */
        const answer a = tresca(PROBLEM(2, 1, K, f2, gap, none, NULL), method,
                                SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(a.d[1], -1.5);
        CHECK_NEAR(a.F[0], -97.5);
        CHECK_NEAR(a.F[1], 0);
    }
    const double K3[9] = {5, [4] = 2, [8] = 2}, f3d[] = {-5, 9, 12}, g3[] = {5};
    for (int32_t method = AUTO; method <= NESTED; method++) {
        const answer a = tresca(PROBLEM(3, 1, K3, f3d, gap, g3, NULL), method,
                                SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(a.d[0], -1);
        CHECK_NEAR(a.d[1], 3);
        CHECK_NEAR(a.d[2], 4);
        CHECK_NEAR(a.F[1], -3);
        CHECK_NEAR(a.F[2], -4);
    }
}

/* ---- bodies that nothing but contact holds ---- */

static void a_floating_body_leaves(void)
{
    /* One pair whose components are tied: it can move along (1, 1), and is driven off. */
    const double K[] = {1, -1, -1, 1}, away[] = {-1, -1}, gap[] = {0}, mu[] = {0.25};
    for (int32_t method = AUTO; method <= LEMKE; method++) {
        const answer a = coulomb(PROBLEM(2, 1, K, away, gap, method == LEMKE ? none : mu, NULL),
                                 method, SIGNORINI_STATUS_NO_EQUILIBRIUM);
        CHECK_NEAR(a.motion[0], -1);
        CHECK_NEAR(a.motion[1], -1);
        /* d and F are an iterate and its forces, of the size of problem or motion, not garbage. */
        CHECK(isfinite(a.d[0]) && isfinite(a.d[1]) && a.F[0] <= 0 && fabs(a.F[1]) <= -a.F[0]);
        CHECK_TEXT(signorini_last_error(), "no equilibrium");
    }
    /* Two pairs, a spring between their normals: lifted as a whole. */
    const double K2[16] = {1, [2] = -1, [5] = 1, [8] = -1, [10] = 1, [15] = 1};
    const double lift[] = {-1, 0, -1, 0};
    for (int32_t method = AUTO; method <= LEMKE; method++) {
        const answer a = coulomb(PROBLEM(2, 2, K2, lift, none, none, NULL), method,
                                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
        CHECK_NEAR(a.motion[0], -1);
        CHECK_NEAR(a.motion[1], 0);
        CHECK_NEAR(a.motion[2], -1);
        CHECK_NEAR(a.motion[3], 0);
    }
}

static void a_floating_body_that_is_pressed_stays(void)
{
    const double K[16] = {1, [2] = -1, [5] = 1, [8] = -1, [10] = 1, [15] = 1};
    const double f[] = {1, 0.25, 3, 0}, F[] = {-1, -0.25, -3, 0}, F0[] = {-1, 0, -3, 0};
    const double slid[] = {0, 0.25, 0, 0};
    AGREES(PROBLEM(2, 2, K, f, none, half, NULL), zero, F, SIGNORINI_STATE_STICK,
           SIGNORINI_STATE_STICK);
    AGREES(PROBLEM(2, 2, K, f, none, none, NULL), slid, F0, SIGNORINI_STATE_SLIP,
           SIGNORINI_STATE_SLIP);
}

/* ---- LCPs ---- */

static int32_t lcp(int64_t n, const double *M, const double *q, const double *cover, double *w,
                   double *z)
{
    signorini_report report;
    memset(&report, 0xFF, sizeof report);
    report.struct_size = sizeof report;
    const int32_t status = lemke(n, M, leading(n), q, cover, NULL, w, z, NULL,
                                               &report);
    check_report(&report, status, 0);
    CHECK(report.method == LEMKE);
    return status;
}

static void complementarity_in_closed_form(void)
{
    double w[3], z[3];
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6}, cover[] = {1, 100};
    for (int i = 0; i < 2; i++) {
        CHECK_STATUS(lcp(2, M, q, i ? cover : NULL, w, z), SIGNORINI_STATUS_SOLVED);
        CHECK_NEAR(z[0], 4.0 / 3);
        CHECK_NEAR(z[1], 7.0 / 3);
        CHECK(w[0] == 0 && w[1] == 0);
    }
    const double identity[] = {1, 0, 0, 1}, mixed[] = {-1, 2};
    CHECK_STATUS(lcp(2, identity, mixed, NULL, w, z), SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(z[0], 1);
    CHECK_NEAR(w[1], 2);
    CHECK(w[0] == 0 && z[1] == 0);
    /* A P-matrix that is neither symmetric nor positive definite. */
    const double P[] = {1, 0, 0, -4, 1, 0, 0, -4, 1}, q3[] = {1, -1, -2};
    CHECK_STATUS(lcp(3, P, q3, NULL, w, z), SIGNORINI_STATUS_SOLVED);
    for (int i = 0; i < 3; i++) {
        CHECK(z[i] >= 0 && w[i] >= 0 && z[i] * w[i] == 0);
        CHECK_NEAR(q3[i] + P[i] * z[0] + P[i + 3] * z[1] + P[i + 6] * z[2] - w[i], 0);
    }
    const double plenty[] = {3, 0};
    CHECK_STATUS(lcp(2, M, plenty, NULL, w, z), SIGNORINI_STATUS_SOLVED);
    CHECK(z[0] == 0 && z[1] == 0 && w[0] == 3 && w[1] == 0);
    CHECK_STATUS(lcp(0, NULL, NULL, NULL, NULL, NULL), SIGNORINI_STATUS_SOLVED);
    /* Padding is not looked at. */
    const double padded[] = {2, 1, NAN, NAN, 1, 2};
    CHECK_STATUS(lemke(2, padded, 4, q, NULL, NULL, w, z, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(z[1], 7.0 / 3);
}

static void complementarity_without_solution(void)
{
    double w[2], z[2], y[2];
    /* w1 = -1 - z2: y = (1, 0) proves that nothing is feasible. */
    const double skew[] = {0, 1, -1, 0}, q[] = {-1, 3};
    CHECK_STATUS(lcp(2, skew, q, NULL, w, z), SIGNORINI_STATUS_NO_EQUILIBRIUM);
    CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
    CHECK_STATUS(lemke(2, skew, 2, q, NULL, NULL, w, z, y, NULL),
                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
    CHECK(y[0] >= 0 && y[1] >= 0 && fmax(y[0], y[1]) == 1);
    CHECK(skew[0] * y[0] + skew[1] * y[1] <= 1e-12 && skew[2] * y[0] + skew[3] * y[1] <= 1e-12);
    CHECK(q[0] * y[0] + q[1] * y[1] < 0);
    /* Solvable by (0, 1), but of no class for which Lemke's method must find it. */
    const double other[] = {-2, -2, 1, -2}, q2[] = {-1, 2};
    const int32_t status = lcp(2, other, q2, NULL, w, z);
    CHECK(status == SIGNORINI_STATUS_SOLVED || status == SIGNORINI_STATUS_STALLED);
    CHECK(z[0] >= 0 && z[1] >= 0 && w[0] >= 0 && w[1] >= 0);
}

static void the_contact_settings_do_not_matter_to_it(void)
{
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    double w[2], z[2];
    signorini_settings settings = settings_for(DIAGONAL);
    settings.omega = 1.9;
    settings.damping = 0.5;
    settings.warm_start = 1;
    CHECK_STATUS(lemke(2, M, 2, q, NULL, &settings, w, z, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(z[0], 4.0 / 3);
}

/* ---- arguments ---- */

static void nothing_to_solve(void)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        const small empty = {dim, 0, NULL, NULL, NULL, NULL, NULL};
        for (int32_t method = AUTO; method <= PATH; method++) {
            if (!fits(method, dim, 0)) continue;
            const signorini_settings settings = settings_for(method);
            signorini_report report = {.struct_size = sizeof report};
            CHECK_STATUS(signorini_solve(dim, 0, NULL, 1, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL,
                                         NULL, &settings, NULL, NULL, NULL, &report, NULL),
                         SIGNORINI_STATUS_SOLVED);
            check_report(&report, SIGNORINI_STATUS_SOLVED, 0);
            CHECK(report.eta == 0);
        }
        /* Arrays that are given all the same are left alone. */
        const answer a = tresca(&empty, NESTED, SIGNORINI_STATUS_SOLVED), untouched = blank();
        CHECK(memcmp(a.d, untouched.d, sizeof a.d) == 0);
        CHECK(memcmp(a.F, untouched.F, sizeof a.F) == 0);
        CHECK(memcmp(a.state, untouched.state, sizeof a.state) == 0);
    }
}

static void what_is_not_wanted_may_be_null(void)
{
    const double K[] = {5, 0, 0, 3}, f[] = {10, 8}, gap[] = {0};
    double d[2], F[2];
    CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL, NULL, d, F,
                                 NULL, NULL, NULL), 0);
    CHECK_NEAR(d[1], 1);
    CHECK_NEAR(F[1], -5);
    CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_TRESCA, half, NULL, NULL, d, F,
                                 NULL, NULL, NULL), 0);
    CHECK_NEAR(d[1], 2.5);
    CHECK_NEAR(F[1], -0.5);
    /* The pair under the load (10, 8) on the springs 5 and 3: 3 d_t = 8 - 0.5 * 10 - 1.5. */
    double glue[] = {0.5, 1.5, 2};
    CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COHESIVE, glue, NULL, NULL, d,
                                 F, NULL, NULL, NULL), 0);
    CHECK_NEAR(d[1], 0.5);
    CHECK_NEAR(F[1], -6.5);
    /* Pulled by 12 it opens, 5 d_n = 2 - 12, and carries the tension 2 and the friction 0.5. */
    const double pull[] = {-12, 8};
    CHECK_STATUS(signorini_solve(2, 1, K, 2, pull, gap, SIGNORINI_LAW_COHESIVE, glue, NULL, NULL,
                                 d, F, NULL, NULL, NULL), 0);
    CHECK_NEAR(d[0], -2);
    CHECK_NEAR(F[0], 2);
    CHECK_NEAR(d[1], 2.5);
    CHECK_NEAR(F[1], -0.5);
    const double M[] = {2}, q[] = {-1};
    double w[1], z[1];
    CHECK_STATUS(lemke(1, M, 1, q, NULL, NULL, w, z, NULL, NULL), 0);
    CHECK_NEAR(z[0], 0.5);
}

static void padding_of_the_matrix_is_not_looked_at(void)
{
    chain c = chain_new(3, 8, 0.5, 1);
    const int64_t ldk = c.n + 5;
    /* Not one entry after the last column's: a reader beyond it would leave the allocation. */
    const int64_t entries = (c.n - 1) * ldk + c.n;
    double *K = chain_numbers(entries), *d = chain_numbers(c.n), *F = chain_numbers(c.n);
    for (int64_t k = 0; k < entries; k++) {
        const int64_t row = k % ldk, j = k / ldk;
        K[k] = row < c.n ? c.K[row + c.n * j] : NAN;
    }
    CHECK_STATUS(signorini_solve(3, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB, c.mu,
                                 NULL, NULL, c.d, c.F, NULL, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(signorini_solve(3, c.pairs, K, ldk, c.f, c.gap, SIGNORINI_LAW_COULOMB, c.mu, NULL,
                                 NULL, d, F, NULL, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK(memcmp(d, c.d, (size_t)c.n * sizeof *d) == 0);
    CHECK(memcmp(F, c.F, (size_t)c.n * sizeof *F) == 0);
    free(K);
    free(d);
    free(F);
    chain_free(&c);
}

static void the_same_input_gives_the_same_bits(void)
{
    chain one = chain_new(3, 10, 0.2, 2), two = chain_new(3, 10, 0.2, 2);
    for (int32_t method = AUTO; method <= DIAGONAL; method++) {
        const signorini_settings settings = settings_for(method);
        CHECK_STATUS(signorini_solve(3, one.pairs, one.K, one.n, one.f, one.gap,
                                     SIGNORINI_LAW_COULOMB, one.mu, NULL, &settings, one.d, one.F,
                                     one.state, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK_STATUS(signorini_solve(3, two.pairs, two.K, two.n, two.f, two.gap,
                                     SIGNORINI_LAW_COULOMB, two.mu, NULL, &settings, two.d, two.F,
                                     two.state, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK(memcmp(one.d, two.d, (size_t)one.n * sizeof *one.d) == 0);
        CHECK(memcmp(one.F, two.F, (size_t)one.n * sizeof *one.F) == 0);
        CHECK(memcmp(one.state, two.state, (size_t)one.pairs * sizeof *one.state) == 0);
    }
    chain_free(&one);
    chain_free(&two);
}

/* The contact law on every pair of a larger answer, and equilibrium, measured here. */
static void check_law(const chain *c)
{
    double scale = 0;
    for (int64_t i = 0; i < c->n; i++) scale = fmax(scale, fabs(c->f[i]));
    for (int64_t i = 0; i < c->n; i++) {
        double residual = -c->f[i] - c->F[i];
        for (int64_t j = 0; j < c->n; j++) residual += c->K[i + c->n * j] * c->d[j];
        CHECK(fabs(residual) <= 1e-8 * scale);
    }
    for (int64_t pair = 0; pair < c->pairs; pair++) {
        const double *d = c->d + c->dim * pair, *F = c->F + c->dim * pair;
        const double bound = -c->mu[pair] * F[0];
        const double force = c->dim == 2 ? fabs(F[1]) : hypot(F[1], F[2]);
        const double slide = c->dim == 2 ? fabs(d[1]) : hypot(d[1], d[2]);
        double power = 0;
        for (int32_t t = 1; t < c->dim; t++) power += F[t] * d[t];
        CHECK(F[0] <= 0 && d[0] - c->gap[pair] <= 1e-8);
        CHECK(fabs(F[0] * (d[0] - c->gap[pair])) <= 1e-8);
        CHECK(force <= bound * (1 + 1e-12));
        CHECK(fabs(power + bound * slide) <= 1e-7);
        switch (c->state[pair]) {
        case SIGNORINI_STATE_OPEN: CHECK(F[0] == 0 && force == 0); break;
        case SIGNORINI_STATE_SLIP: CHECK(fabs(force - bound) <= 1e-7); break;
        case SIGNORINI_STATE_STICK: CHECK(slide <= 1e-8); break;
        default: CHECK(!"a state of the header");
        }
    }
}

static void many_pairs_obey_the_law(void)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        for (int32_t method = AUTO; method <= PATH; method++) {
            if (!fits(method, dim, 1)) continue;
            chain c = chain_new(dim, 20, 0.1, 3);
            const signorini_settings settings = settings_for(method);
            signorini_report report = {.struct_size = sizeof report};
            CHECK_STATUS(signorini_solve(dim, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB,
                                         c.mu, NULL, &settings, c.d, c.F, c.state, &report, NULL),
                         SIGNORINI_STATUS_SOLVED);
            check_report(&report, SIGNORINI_STATUS_SOLVED, c.pairs);
            CHECK(report.pairs_open > 0 && report.pairs_slipping > 0 && report.pairs_sticking > 0);
            check_law(&c);
            chain_free(&c);
        }
    }
}

static void a_warm_start_leads_to_the_same_answer(void)
{
    for (int32_t method = AUTO; method <= PATH; method++) {
        if (method == LEMKE || method == BLOCK_PIVOTING) continue; /* No start; no friction. */
        /* 20 pairs, as memcheck runs this: environment.c says of what it accuses more of them, and shows that it errs. */
        chain cold = chain_new(2, 20, 0.02, 4), warm = chain_new(2, 20, 0.02, 4);
        signorini_settings settings = settings_for(method);
        signorini_report first = {.struct_size = sizeof first}, again = first;
        settings.tolerance = 1e-13;
        CHECK_STATUS(signorini_solve(2, cold.pairs, cold.K, cold.n, cold.f, cold.gap,
                                     SIGNORINI_LAW_COULOMB, cold.mu, NULL, &settings, cold.d,
                                     cold.F, NULL, &first, NULL),
                     SIGNORINI_STATUS_SOLVED);
        settings.warm_start = 1;
        /* From far away and from the answer itself. */
        for (int64_t i = 0; i < warm.n; i++) warm.d[i] = i % 3 ? -5 : 7;
        CHECK_STATUS(signorini_solve(2, warm.pairs, warm.K, warm.n, warm.f, warm.gap,
                                     SIGNORINI_LAW_COULOMB, warm.mu, NULL, &settings, warm.d,
                                     warm.F, NULL, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        for (int64_t i = 0; i < warm.n; i++) CHECK_NEAR(warm.d[i], cold.d[i]);
        CHECK_STATUS(signorini_solve(2, warm.pairs, warm.K, warm.n, warm.f, warm.gap,
                                     SIGNORINI_LAW_COULOMB, warm.mu, NULL, &settings, warm.d,
                                     warm.F, NULL, &again, NULL),
                     SIGNORINI_STATUS_SOLVED);
        /* The path's start is near after a few sweeps: one event more or less. */
        CHECK(again.iterations < first.iterations + (method == PATH));
        for (int64_t i = 0; i < warm.n; i++) CHECK_NEAR(warm.d[i], cold.d[i]);
        /* Without one, what d holds is not looked at: not even NaN. */
        settings.warm_start = 0;
        for (int64_t i = 0; i < warm.n; i++) warm.d[i] = NAN;
        CHECK_STATUS(signorini_solve(2, warm.pairs, warm.K, warm.n, warm.f, warm.gap,
                                     SIGNORINI_LAW_COULOMB, warm.mu, NULL, &settings, warm.d,
                                     warm.F, NULL, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK(memcmp(warm.d, cold.d, (size_t)cold.n * sizeof *cold.d) == 0);
        chain_free(&cold);
        chain_free(&warm);
    }
}

static void units_change_nothing_but_the_unit(void)
{
    const double force_units[] = {1e-40, 1e9, 1e40}, length_units[] = {1e-40, 1e-3, 1e40};
    for (int32_t method = AUTO; method <= BLOCK_PIVOTING; method++) {
        chain base = chain_new(3, 8, 0.5, 5);
        signorini_settings settings = settings_for(method);
        settings.tolerance = 1e-12;
        if (!fits(method, 3, 1))
            for (int64_t i = 0; i < base.pairs; i++) base.mu[i] = 0;
        CHECK_STATUS(signorini_solve(3, base.pairs, base.K, base.n, base.f, base.gap,
                                     SIGNORINI_LAW_COULOMB, base.mu, NULL, &settings, base.d,
                                     base.F, base.state, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        for (int k = 0; k < 9; k++) {
            const double force = force_units[k % 3], length = length_units[k / 3];
            chain c = chain_new(3, 8, 0.5, 5);
            memcpy(c.mu, base.mu, (size_t)c.pairs * sizeof *c.mu);
            for (int64_t i = 0; i < c.n * c.n; i++) c.K[i] *= force / length;
            for (int64_t i = 0; i < c.n; i++) c.f[i] *= force;
            for (int64_t i = 0; i < c.pairs; i++) c.gap[i] *= length;
            CHECK_STATUS(signorini_solve(3, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_COULOMB,
                                         c.mu, NULL, &settings, c.d, c.F, c.state, NULL, NULL),
                         SIGNORINI_STATUS_SOLVED);
            for (int64_t i = 0; i < c.n; i++) {
                CHECK_NEAR(c.d[i] / length, base.d[i]);
                CHECK_NEAR(c.F[i] / force, base.F[i]);
            }
            CHECK(memcmp(c.state, base.state, (size_t)c.pairs * sizeof *c.state) == 0);
            chain_free(&c);
        }
        chain_free(&base);
    }
}

static void numbers_beyond_double_precision_are_not_called_a_solution(void)
{
    /* Finite input, with an answer that double precision cannot hold. */
    const double soft[] = {1, 0, 0, 1e-300}, f[] = {1, 1e300}, touching[] = {0};
    const double stiff[] = {1.7e308, 0, 0, 1.7e308}, f2[] = {1.7e308, 1.7e308}, deep[] = {-3};
    const double K[] = {1e10, 0, 0, 1e10}, f3[] = {1, 1}, far_slip[] = {1.7e308};
    for (int32_t method = AUTO; method <= PATH; method++) {
        const double *mu = fits(method, 2, 1) ? half : none;
        const signorini_settings s = settings_for(method);
        double d[2], F[2];
        CHECK(signorini_solve(2, 1, soft, 2, f, touching, SIGNORINI_LAW_COULOMB, mu, NULL, &s, d, F,
                              NULL, NULL, NULL) > 0);
        CHECK(signorini_last_error()[0] != '\0');
        CHECK(signorini_solve(2, 1, stiff, 2, f2, deep, SIGNORINI_LAW_COULOMB, mu, NULL, &s, d, F,
                              NULL, NULL, NULL) > 0);
        CHECK(signorini_last_error()[0] != '\0');
        if (!fits(method, 2, 1)) continue; /* A previous slip does not matter without friction. */
        /* Here it can hold the answer, but not every number on the way. */
        if (signorini_solve(2, 1, K, 2, f3, touching, SIGNORINI_LAW_COULOMB, mu, far_slip, &s, d, F,
                            NULL, NULL, NULL) <= 0) {
            CHECK_NEAR(F[0], -1);
            CHECK_NEAR(F[1], 0.5);
        }
    }
}

/* ---- budgets and the progress callback ---- */

typedef struct watch {
    int calls, cancel_at, in_order, started_at_infinity;
    int64_t last;
    double elapsed;
} watch;

static int32_t on_progress(void *user, const signorini_progress *progress)
{
    watch *seen = user;
    if (seen->calls == 0) seen->started_at_infinity = isinf(progress->eta);
    /* Work between two iterations tells the last count again. */
    const int again = seen->calls > 0 && progress->iterations == seen->last;
    if (!again && progress->iterations != seen->last + 1) seen->in_order = 0;
    if (!(progress->elapsed >= seen->elapsed)) seen->in_order = 0;
    if (!(progress->eta >= 0)) seen->in_order = 0;
    seen->last = progress->iterations;
    seen->elapsed = progress->elapsed;
    seen->calls++;
    return seen->calls == seen->cancel_at ? -7 : 0;
}

static int is_finite(const double *values, int64_t count)
{
    for (int64_t i = 0; i < count; i++)
        if (!isfinite(values[i])) return 0;
    return 1;
}

/* Solves the same chain by one method; d, F, state and report are NaN or garbage before. */
static int32_t limited(chain *c, const signorini_settings *settings, signorini_report *report)
{
    memset(c->d, 0xFF, (size_t)c->n * sizeof *c->d);
    memset(c->F, 0xFF, (size_t)c->n * sizeof *c->F);
    memset(c->state, 0xFF, (size_t)c->pairs * sizeof *c->state);
    memset(report, 0xFF, sizeof *report);
    report->struct_size = sizeof *report;
    const int32_t status = signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap,
                                           SIGNORINI_LAW_COULOMB, c->mu, NULL, settings, c->d, c->F,
                                           c->state, report, NULL);
    check_report(report, status, c->pairs);
    CHECK(is_finite(c->d, c->n) && is_finite(c->F, c->n));
    for (int64_t i = 0; i < c->pairs; i++) CHECK(c->state[i] >= 0 && c->state[i] <= 2);
    return status;
}

static void budgets_end_a_call_with_results(void)
{
    for (int32_t method = AUTO; method <= PATH; method++) {
        chain c = chain_new(2, 20, 1e-3, 8);
        if (!fits(method, 2, 1))
            for (int64_t i = 0; i < c.pairs; i++) c.mu[i] = 0;
        signorini_report report;

        signorini_settings settings = settings_for(method);
        settings.max_iterations = 1;
        const int32_t status = limited(&c, &settings, &report);
        CHECK(report.iterations == 1);
        /* One system may be enough for block pivoting, and one event for the path. */
        if ((method != BLOCK_PIVOTING && method != PATH) || status != SIGNORINI_STATUS_SOLVED) {
            CHECK_STATUS(status, SIGNORINI_STATUS_ITERATION_LIMIT);
            CHECK(report.eta > 1e-10);
            CHECK_TEXT(signorini_last_error(), "max_iterations (1)");
        }

        settings = settings_for(method);
        settings.time_limit = 1e-300;
        CHECK_STATUS(limited(&c, &settings, &report), SIGNORINI_STATUS_TIME_LIMIT);
        CHECK_TEXT(signorini_last_error(), "time_limit");
        settings.time_limit = INFINITY;
        CHECK_STATUS(limited(&c, &settings, &report), SIGNORINI_STATUS_SOLVED);

        watch seen = {.in_order = 1, .last = -1};
        settings = settings_for(method);
        settings.progress = on_progress;
        settings.user = &seen;
        CHECK_STATUS(limited(&c, &settings, &report), SIGNORINI_STATUS_SOLVED);
        /* Newton's method measures the point to which sweeps have led before its first system. */
        const int measured = method == AUTO || method == NEWTON;
        CHECK(seen.in_order && (measured || seen.started_at_infinity));
        CHECK(seen.calls >= report.iterations && seen.last + 1 >= report.iterations);
        CHECK(seen.calls >= 1);
        const int calls = seen.calls;

        for (int at = 1; at <= 3 && at <= calls; at += 2) {
            seen = (watch){.in_order = 1, .last = -1, .cancel_at = at};
            const int32_t ended = limited(&c, &settings, &report);
            CHECK(seen.in_order && seen.calls == at && report.iterations == seen.last);
            /* Before its last system the path stands on a solution; the last calls are questions
             * about one. */
            if ((method == PATH || at == calls) && ended == SIGNORINI_STATUS_SOLVED) {
                CHECK(report.eta <= 1e-10);
                continue;
            }
            CHECK_STATUS(ended, SIGNORINI_STATUS_CANCELLED);
            CHECK_TEXT(signorini_last_error(), "cancelled");
        }
        chain_free(&c);
    }
}

static void budgets_of_the_bare_problem(void)
{
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    double w[2] = {NAN, NAN}, z[2] = {NAN, NAN};
    signorini_report report = {.struct_size = sizeof report};
    signorini_settings settings = settings_for(LEMKE);
    settings.max_iterations = 1;
    CHECK_STATUS(lemke(2, M, 2, q, NULL, &settings, w, z, NULL, &report),
                 SIGNORINI_STATUS_ITERATION_LIMIT);
    check_report(&report, SIGNORINI_STATUS_ITERATION_LIMIT, 0);
    CHECK(report.iterations == 1);
    CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
    watch seen = {.in_order = 1, .last = -1, .cancel_at = 2};
    settings = settings_for(LEMKE);
    settings.progress = on_progress;
    settings.user = &seen;
    CHECK_STATUS(lemke(2, M, 2, q, NULL, &settings, w, z, NULL, &report),
                 SIGNORINI_STATUS_CANCELLED);
    CHECK(seen.calls == 2 && seen.in_order);
    CHECK(w[0] >= 0 && w[1] >= 0 && z[0] >= 0 && z[1] >= 0);
}

/* ---- structures of other versions ---- */

/* A structure of `size` bytes and not one more, so that memory checkers see any access beyond. */
static void *short_structure(uint32_t size, int fill)
{
    char *bytes = malloc(size);
    if (!bytes) abort();
    memset(bytes, fill, size);
    memcpy(bytes, &size, sizeof size);
    return bytes;
}

static void settings_of_an_older_program(void)
{
    const double K[] = {5, 0, 0, 3}, f[] = {10, 8}, gap[] = {0};
    double d[2], F[2];
    for (uint32_t size = 16; size <= sizeof(signorini_settings); size += 8) {
        /* The defaults fill `size` bytes and no more. */
        signorini_settings defaults, copy;
        memset(&copy, 0, sizeof copy);
        CHECK_STATUS(signorini_settings_default(&defaults, sizeof defaults), 0);
        void *block = short_structure(size, 0);
        CHECK_STATUS(signorini_settings_default(block, size), 0);
        memcpy(&copy, block, size);
        CHECK(copy.struct_size == size && copy.method == AUTO && copy.tolerance == 1e-10);
        CHECK(memcmp((char *)&copy + 4, (char *)&defaults + 4, size - 4) == 0);
        /* A program that knows no more than these. */
        CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL, block,
                                     d, F, NULL, NULL, NULL), 0);
        CHECK_NEAR(d[1], 1);
        free(block);
    }
    /* Bytes behind the size are not looked at, be they wrong in every field. */
    const uint32_t sizes[] = {16, 24};
    for (int i = 0; i < 2; i++) {
        signorini_settings settings;
        memset(&settings, 0xFF, sizeof settings);
        settings.struct_size = sizes[i];
        settings.method = LEMKE;
        settings.tolerance = 1e-8;
        if (sizes[i] == 24) settings.omega = 1.5;
        CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, none, NULL,
                                     &settings, d, F, NULL, NULL, NULL),
                     SIGNORINI_STATUS_SOLVED);
        settings.method = DIAGONAL;
        signorini_report report = {.struct_size = sizeof report};
        CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL,
                                     &settings, d, F, NULL, &report, NULL),
                     SIGNORINI_STATUS_SOLVED);
        CHECK(report.method == DIAGONAL && (sizes[i] == 16 || report.omega == 1.5));
    }
}

static void report_of_an_older_program(void)
{
    const double K[] = {5, 0, 0, 3}, f[] = {10, 8}, gap[] = {0};
    double d[2], F[2];
    signorini_report full;
    memset(&full, 0xA5, sizeof full);
    full.struct_size = sizeof full;
    CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL, NULL, d, F,
                                 NULL, &full, NULL), 0);
    for (uint32_t size = 16; size < sizeof full; size += 8) {
        signorini_report part, expected;
        memset(&part, 0xA5, sizeof part);
        part.struct_size = size;
        memcpy(&expected, &part, sizeof part);
        memcpy((char *)&expected + 4, (char *)&full + 4, size - 4);
        CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL, NULL, d,
                                     F, NULL, &part, NULL), 0);
        CHECK(memcmp(&part, &expected, sizeof part) == 0);
        void *block = short_structure(size, 0);
        CHECK_STATUS(signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, half, NULL, NULL, d,
                                     F, NULL, block, NULL), 0);
        CHECK(memcmp(block, &expected, size) == 0);
        free(block);
    }
}

/* ---- words ---- */

static void versions(void)
{
    char text[64];
    snprintf(text, sizeof text, "%d.%d.%d", SIGNORINI_VERSION_MAJOR, SIGNORINI_VERSION_MINOR,
             SIGNORINI_VERSION_PATCH);
    CHECK(strcmp(signorini_version(), text) == 0);
    CHECK(signorini_abi_version() == SIGNORINI_ABI_VERSION);
}

static void every_status_has_its_words(void)
{
    const int32_t known[] = {SIGNORINI_STATUS_SOLVED,          SIGNORINI_STATUS_ITERATION_LIMIT,
                             SIGNORINI_STATUS_TIME_LIMIT,      SIGNORINI_STATUS_CANCELLED,
                             SIGNORINI_STATUS_NO_EQUILIBRIUM,  SIGNORINI_STATUS_STALLED,
                             SIGNORINI_STATUS_NOT_A_SOLUTION,
                             SIGNORINI_STATUS_INTERNAL,        SIGNORINI_STATUS_OUT_OF_MEMORY, -1};
    const int count = sizeof known / sizeof *known;
    const char *unknown = signorini_status_string(12345);
    for (int i = 0; i < count; i++) {
        CHECK(strcmp(signorini_status_string(known[i]), unknown) != 0);
        for (int j = 0; j < i; j++)
            CHECK(strcmp(signorini_status_string(known[i]), signorini_status_string(known[j])));
    }
    for (int32_t k = 1; k <= 15; k++)
        CHECK(strcmp(signorini_status_string(-k), signorini_status_string(-1)) == 0);
    const int32_t garbage[] = {INT32_MIN, INT32_MIN + 1, -1000000, -1002, -500, 7, 99, INT32_MAX};
    for (int i = 0; i < 8; i++) {
        CHECK(signorini_status_string(garbage[i]) != NULL);
        CHECK(signorini_status_string(garbage[i])[0] != '\0');
    }
}

static void the_last_error_is_that_of_the_last_call(void)
{
    const double M[] = {2}, q[] = {-1};
    double w[1], z[1];
    signorini_settings settings;
    CHECK_STATUS(lemke(-1, M, 1, q, NULL, NULL, w, z, NULL, NULL), -1);
    CHECK(signorini_last_error()[0] != '\0');
    /* Asking does not clear it, nor does any call that computes nothing. */
    signorini_status_string(-1);
    signorini_version();
    signorini_abi_version();
    CHECK_TEXT(signorini_last_error(), "n is -1");
    CHECK_STATUS(lemke(1, M, 1, q, NULL, NULL, w, z, NULL, NULL), 0);
    CHECK(signorini_last_error()[0] == '\0');
    CHECK_STATUS(signorini_settings_default(NULL, sizeof settings), -1);
    CHECK(signorini_last_error()[0] != '\0');
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    CHECK(signorini_last_error()[0] == '\0');
}

int main(void)
{
    a_pair_that_opens_moves_freely();
    an_infinite_gap_never_closes();
    a_negative_gap_presses_without_load();
    a_pair_inside_the_cone_sticks();
    all_pairs_stick_in_3d();
    a_pair_on_the_cone_slips();
    a_slipping_pair_with_coupling();
    a_pair_slips_along_its_load_in_3d();
    some_pairs_have_no_friction();
    no_load_no_force();
    a_load_may_be_small_against_the_gap();
    a_fixed_component_is_a_decoupled_row();
    friction_sticks_at_the_reference_slip();
    given_thresholds();
    a_floating_body_leaves();
    a_floating_body_that_is_pressed_stays();
    complementarity_in_closed_form();
    complementarity_without_solution();
    the_contact_settings_do_not_matter_to_it();
    nothing_to_solve();
    what_is_not_wanted_may_be_null();
    padding_of_the_matrix_is_not_looked_at();
    the_same_input_gives_the_same_bits();
    many_pairs_obey_the_law();
    a_warm_start_leads_to_the_same_answer();
    units_change_nothing_but_the_unit();
    numbers_beyond_double_precision_are_not_called_a_solution();
    budgets_end_a_call_with_results();
    budgets_of_the_bare_problem();
    settings_of_an_older_program();
    report_of_an_older_program();
    versions();
    every_status_has_its_words();
    the_last_error_is_that_of_the_last_call();
    return check_summary("valid_input");
}
