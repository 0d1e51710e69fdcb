/*
 * A model of products on all unknowns of a host and a preconditioner: a diagonal gives the answers of
 * the condensed matrix, and what is wrong with the structure is named.
 */

#include "check.h"

#include <stdlib.h>

/*
 * A chain of P nodes, along each axis a spring of 1 between neighbours and one of 0.5 to the ground;
 * on each normal component a further node with springs of 1 to it and to the ground. Condensed they
 * are a spring of 0.5. The host numbers them from the end: the further ones first.
 */
enum { P = 5, N = 2 * P, H = N + P };

typedef struct host {
    int products, calls, fails_at, stale;
    int32_t held[N];
    double springs[P];
} host;

static double chain(int i, int j)
{
    if (i == j) return i / 2 == 0 || i / 2 == P - 1 ? 1.5 : 2.5;
    return abs(i - j) == 2 ? -1 : 0;
}

/* Component i of d is unknown H - 1 - i; the further node of pair p is unknown p. */
static double entry(int a, int b)
{
    if (a < P && b < P) return a == b ? 2 : 0;
    if (a < P) return H - 1 - b == 2 * a ? -1 : 0;
    if (b < P) return entry(b, a);
    const int i = H - 1 - a, j = H - 1 - b;
    return chain(i, j) + (i == j && i % 2 == 0 ? 1 : 0);
}

static int32_t product(void *user, const double *x, double *y)
{
    host *h = user;
    h->products++;
    for (int i = 0; i < H; i++) {
        y[i] = 0;
        for (int j = 0; j < H; j++) y[i] += entry(i, j) * x[j];
    }
    return 0;
}

static int32_t precondition(void *user, const int32_t *held, const double *springs, int32_t changed,
                            const double *r, double *z)
{
    host *h = user;
    h->calls++;
    if (h->calls == h->fails_at) return 44;
    const int same = memcmp(held, h->held, sizeof h->held) == 0 &&
                     memcmp(springs, h->springs, sizeof h->springs) == 0;
    h->stale += !same && !changed;
    memcpy(h->held, held, sizeof h->held);
    memcpy(h->springs, springs, sizeof h->springs);
    for (int a = 0; a < H; a++) {
        const int i = H - 1 - a;
        const double spring = a >= P && i % 2 == 1 ? springs[i / 2] : 0;
        z[a] = r[a] / (entry(a, a) + spring);
    }
    return 0;
}

static int64_t place[N];
static double units[H];

static signorini_operator of(host *h)
{
    for (int i = 0; i < N; i++) place[i] = H - 1 - i;
    for (int a = 0; a < H; a++) units[a] = entry(a, a);
    signorini_operator K = {.struct_size = sizeof K, .dim = 2, .pairs = P, .stiffness = product,
                            .units = units, .user = h, .unknowns = H, .place = place,
                            .precondition = precondition};
    return K;
}

static const double f[N] = {1, 0.1, 0.5, 0.6, -0.3, 0.2, 2, -0.4, 1, 1}, mu[P] = {.3, .3, .3, .3, .3},
                    gap[P] = {0, 0.01, 0, 0.02, 0};

static int32_t solve(const signorini_model *model, double *d, double *F, signorini_report *report)
{
    double load[H] = {0};
    for (int i = 0; i < N; i++) load[H - 1 - i] = f[i];
    return signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d,
                                 F, NULL, NULL, report, NULL);
}

static void check_answers(void)
{
    double K[N * N], d[N], F[N], expected[N], forces[N], u[H], nodal[H], load[H] = {0};
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) K[i + N * j] = chain(i, j) + (i == j && i % 2 == 0 ? 0.5 : 0);
    CHECK_STATUS(signorini_solve(2, P, K, N, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, expected,
                                 forces, NULL, NULL, NULL), 0);
    host h = {.held = {-1}};
    const signorini_operator given = of(&h);
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_operator(&given, &model), 0);
    CHECK(model_data(model).host_size == H && model_data(model).kind == SIGNORINI_MODEL_OPERATOR);
    CHECK(h.calls == 0);
    signorini_report report;
    CHECK_STATUS(signorini_report_default(&report, sizeof report), 0);
    CHECK_STATUS(solve(model, d, F, &report), 0);
    CHECK(report.eta <= 1e-10 && report.outer_iterations == h.calls && h.stale == 0);
    for (int i = 0; i < N; i++) {
        CHECK_NEAR(d[i], expected[i]);
        CHECK_NEAR(F[i], forces[i]);
        load[H - 1 - i] = f[i];
    }
    CHECK_STATUS(signorini_model_recover(model, 1, load, NULL, d, u), 0);
    CHECK_STATUS(signorini_model_nodal_forces(model, F, nodal), 0);
    for (int i = 0; i < N; i++) CHECK(u[H - 1 - i] == d[i] && nodal[H - 1 - i] == F[i]);
    for (int p = 0; p < P; p++) {
        CHECK_NEAR(u[p], d[2 * p] / 2);
        CHECK(nodal[p] == 0);
    }
    /* A preconditioner that fails ends the call; then the model serves again. */
    h.fails_at = h.calls + 3;
    CHECK_STATUS(solve(model, d, F, NULL), -1);
    CHECK_TEXT(signorini_last_error(), "the preconditioner has returned 44");
    CHECK_STATUS(solve(model, d, F, NULL), 0);
    for (int i = 0; i < N; i++) CHECK_NEAR(F[i], forces[i]);
    signorini_model_free(model);
}

static void refused(const signorini_operator *given, const char *words)
{
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_operator(given, &model), -1);
    CHECK_TEXT(signorini_last_error(), words);
    CHECK(model == NULL);
}

static void check_refusals(void)
{
    host h = {0};
    signorini_operator given = of(&h);
    given.precondition = NULL;
    refused(&given, "precondition is NULL");
    given = of(&h);
    given.inverse = product;
    refused(&given, "give precondition alone");
    given = of(&h);
    given.unknowns = 0;
    refused(&given, "precondition needs unknowns");
    given.unknowns = -1;
    refused(&given, "unknowns");
    given = of(&h);
    given.units = NULL;
    refused(&given, "units");
    given = of(&h);
    given.place = NULL;
    refused(&given, "place");
    given = of(&h);
    place[3] = H;
    refused(&given, "place[3] is 15, there is no such unknown");
    place[3] = place[0];
    refused(&given, "place[3] is 14, as one before it is");
    place[3] = -1;
    refused(&given, "place[3] is -1");
}

int main(void)
{
    check_answers();
    check_refusals();
    return check_summary("preconditioner");
}
