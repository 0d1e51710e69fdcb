/*
 * settings.threads: load cases of a call on several threads have the results of one, and the same bits each
 * time; one problem, by each method, has the same bits on any number of threads. Helgrind does not watch this program, as it does not know the atomic numbers by which Rust's threads wait
 * for each other; ThreadSanitizer does: tests/thread_sanitizer.sh.
 */

#include "chains.h"
#include "check.h"

#include <pthread.h>

enum { CASES = 75, PAIRS = 30, N = 3 * PAIRS };

/* Load cases of a model, all in one call. */
typedef struct block {
    double f[CASES][N], gap[CASES][PAIRS], mu[CASES][PAIRS], d[CASES][N], F[CASES][N];
    int32_t state[CASES][PAIRS], status[CASES];
} block;

static int32_t solve_block(const signorini_model *model, block *b, int32_t threads)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.tolerance = 1e-13;
    settings.threads = threads;
    memset(b->d, 0, sizeof b->d);
    return signorini_model_solve(model, CASES, b->f[0], NULL, b->gap[0], SIGNORINI_LAW_COULOMB,
                                 b->mu[0], NULL, &settings, b->d[0], b->F[0], b->state[0],
                                 b->status, NULL, NULL);
}

static void calls_on_several_threads(void)
{
    static block b, one, before;
    chain c = chain_new(3, PAIRS, 0.5, 3);
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_condensed(3, PAIRS, c.K, N, NULL, &model), 0);
    for (int k = 0; k < CASES; k++) {
        for (int i = 0; i < N; i++) b.f[k][i] = (0.5 + 0.01 * k) * c.f[(i + 3 * k) % N];
        memcpy(b.gap[k], c.gap, sizeof b.gap[k]);
        for (int i = 0; i < PAIRS; i++) b.mu[k][i] = 0.3;
    }
    CHECK_STATUS(solve_block(model, &b, 1), 0);
    one = b;
    CHECK_STATUS(solve_block(model, &b, 0), 0);
    CHECK(memcmp(&one, &b, sizeof b) == 0);
    const int32_t counts[] = {2, 3, 8, CASES, 1000};
    for (int i = 0; i < 5; i++) {
        CHECK_STATUS(solve_block(model, &b, counts[i]), 0);
        for (int k = 0; k < CASES; k++) {
            CHECK_STATUS(b.status[k], 0);
            CHECK(memcmp(b.state[k], one.state[k], sizeof b.state[k]) == 0);
            for (int j = 0; j < N; j++) {
                CHECK_NEAR(b.d[k][j], one.d[k][j]);
                CHECK_NEAR(b.F[k][j], one.F[k][j]);
            }
        }
        before = b;
        CHECK_STATUS(solve_block(model, &b, counts[i]), 0);
        CHECK(memcmp(&before, &b, sizeof b) == 0);
    }
    /* Wrong cases on both of two threads: the first one is named, and the others are solved. */
    b.f[70][2] = b.f[20][5] = NAN;
    CHECK_STATUS(solve_block(model, &b, 2), -3);
    CHECK_TEXT(signorini_last_error(), "case 20: f[5] is not finite");
    for (int k = 0; k < CASES; k++) CHECK_STATUS(b.status[k], k == 20 || k == 70 ? -3 : 0);
    CHECK_STATUS(solve_block(model, &b, -1), -9);
    CHECK_TEXT(signorini_last_error(), "threads is -1, it must be 0 (one thread) or more");
    signorini_model_free(model);
    chain_free(&c);
}

enum { MOST = 600 };

/* A callback that ends the call when it is asked so often. */
typedef struct limit {
    pthread_t caller;
    int calls, most, elsewhere;
} limit;

static int32_t told(void *user, const signorini_progress *progress)
{
    limit *l = user;
    (void)progress;
    l->elsewhere += !pthread_equal(l->caller, pthread_self());
    return ++l->calls > l->most;
}

/* What a call tells of a problem. */
typedef struct answer {
    double d[MOST], F[MOST];
    int32_t state[MOST], status;
} answer;

static signorini_settings settings_of(int32_t method, int32_t threads, limit *limit)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.method = method;
    settings.threads = threads;
    /* A method that is slow here has the same bits on its way, too. */
    settings.max_iterations = 40;
    settings.progress = limit ? told : NULL;
    settings.user = limit;
    return settings;
}

static answer solved(const chain *c, int32_t law, const signorini_settings *settings)
{
    answer a = {.status = 0};
    a.status = signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, law,
                               law == SIGNORINI_LAW_FRICTIONLESS ? NULL : c->mu, NULL, settings,
                               a.d, a.F, a.state, NULL, NULL);
    return a;
}

/* 600 unknowns, so many that threads share factorisations, products and the products of sweeps. */
static void one_problem_on_several_threads(int32_t dim, int32_t law)
{
    static answer one, other;
    chain c = chain_new(dim, MOST / dim, 0.5, 7);
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_condensed(dim, c.pairs, c.K, c.n, NULL, &model), 0);
    for (int32_t method = SIGNORINI_METHOD_AUTO; method <= SIGNORINI_METHOD_PATH; method++)
        for (int32_t threads = 1; threads <= 4; threads++) {
            answer *a = threads == 1 ? &one : &other;
            const signorini_settings settings = settings_of(method, threads, NULL);
            *a = solved(&c, law, &settings);
            CHECK(memcmp(&one, a, sizeof one) == 0);
        }
    /* A load case by itself has the bits of one thread, too; the first one of the loop is that of all methods. */
    for (int32_t threads = 1; threads <= 4; threads++) {
        answer *a = threads == 1 ? &one : &other;
        const signorini_settings settings = settings_of(SIGNORINI_METHOD_AUTO, threads, NULL);
        *a = (answer){.status = 0};
        a->status = signorini_model_solve(model, 1, c.f, NULL, c.gap, law,
                                          law == SIGNORINI_LAW_FRICTIONLESS ? NULL : c.mu, NULL,
                                          &settings, a->d, a->F, a->state, NULL, NULL, NULL);
        CHECK(memcmp(&one, a, sizeof one) == 0);
    }
    CHECK_STATUS(one.status, 0);
    /* A callback is asked on the calling thread alone, and not again once it has ended the call. */
    for (int most = 0; most < 40; most += 13)
        for (int32_t threads = 1; threads <= 4; threads++) {
            limit limit = {pthread_self(), 0, most, 0};
            const signorini_settings settings = settings_of(SIGNORINI_METHOD_AUTO, threads, &limit);
            other = solved(&c, law, &settings);
            CHECK(limit.elsewhere == 0 && limit.calls > 0 && limit.calls <= most + 1);
            /* What it ends may be a question about a result that is there already. */
            CHECK(other.status == SIGNORINI_STATUS_CANCELLED || (other.status == 0 && most > 0));
        }
    signorini_model_free(model);
    chain_free(&c);
}

int main(void)
{
    calls_on_several_threads();
    for (int32_t dim = 2; dim <= 3; dim++) {
        one_problem_on_several_threads(dim, SIGNORINI_LAW_FRICTIONLESS);
        one_problem_on_several_threads(dim, SIGNORINI_LAW_COULOMB);
    }
    return check_summary("case_threads");
}
