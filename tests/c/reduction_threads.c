/*
 * settings.threads in the factorisations of a sparse matrix: the same bits on any number of threads, and a callback, on
 * the calling thread, that ends a reduction in the middle. Helgrind does not watch this program, as it does not know the atomic
 * numbers by which Rust's threads wait for each other; ThreadSanitizer does: tests/thread_sanitizer.sh.
 */

#define _POSIX_C_SOURCE 200809L

#include "check.h"
#include "lattice.h"

#include <pthread.h>

enum { EDGE = 16, PAIRS = EDGE * EDGE, N = 3 * PAIRS };

/* The answer of a model. */
typedef struct answer {
    double K[N * N], d[N], F[N], u[3 * EDGE * PAIRS];
    int32_t state[PAIRS];
} answer;

/* Ends the call when so much is done. */
typedef struct limit {
    pthread_t caller;
    double share, seen;
    int calls, elsewhere;
} limit;

static int32_t told(void *user, const signorini_progress *progress)
{
    limit *l = user;
    l->calls++;
    l->elsewhere += !pthread_equal(l->caller, pthread_self());
    if (progress->reduced > l->seen) l->seen = progress->reduced;
    return progress->reduced >= l->share;
}

static int32_t reduced(const lattice *l, int32_t threads, limit *limit, double seconds,
                       signorini_model **model)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.threads = threads;
    settings.time_limit = seconds;
    settings.progress = limit ? told : NULL;
    settings.user = limit;
    return signorini_model_new_sparse(&l->K, l->n_fixed, l->fixed, &l->pairs, &settings, model);
}

static void answers(const lattice *l, signorini_model *model, answer *a)
{
    CHECK_STATUS(copy_stiffness(model, a->K), 0);
    CHECK_STATUS(signorini_model_solve(model, 1, l->load, NULL, l->gap, SIGNORINI_LAW_COULOMB, l->mu,
                                       NULL, NULL, a->d, a->F, a->state, NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_recover(model, 1, l->load, NULL, a->d, a->u), 0);
    signorini_model_free(model);
}

/* Bits do not depend on the number of threads, nor on who does what: each number comes twice. */
static void same_bits(const lattice *l)
{
    static answer one, other;
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_sparse(&l->K, l->n_fixed, l->fixed, &l->pairs, NULL, &model), 0);
    answers(l, model, &one);
    const int32_t counts[] = {0, 1, 2, 3, 2, 3, 1000};
    for (int i = 0; i < 7; i++) {
        CHECK_STATUS(reduced(l, counts[i], NULL, 0, &model), 0);
        answers(l, model, &other);
        CHECK(memcmp(&one, &other, sizeof one) == 0);
    }
}

/* In full space each load case factorises anew. */
static void full_space(const lattice *l)
{
    static answer one, other;
    for (int32_t threads = 1; threads <= 3; threads++) {
        answer *a = threads == 1 ? &one : &other;
        signorini_model *model = NULL;
        signorini_settings settings;
        CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
        settings.threads = threads;
        settings.full_space = 1;
        CHECK_STATUS(signorini_model_new_sparse(&l->K, l->n_fixed, l->fixed, &l->pairs,
                                                       &settings, &model), 0);
        CHECK_STATUS(signorini_model_solve(model, 1, l->load, NULL, l->gap, SIGNORINI_LAW_COULOMB,
                                           l->mu, NULL, &settings, a->d, a->F, a->state, NULL, NULL,
                                           NULL), 0);
        CHECK_STATUS(signorini_model_recover(model, 1, l->load, NULL, a->d, a->u), 0);
        signorini_model_free(model);
        CHECK(memcmp(&one, a, sizeof one) == 0);
    }
}

static void ended(const lattice *l)
{
    const double shares[] = {1e-9, 0.3, 0.6, 2};
    for (int32_t threads = 1; threads <= 3; threads++) {
        signorini_model *model = NULL;
        for (int i = 0; i < 4; i++) {
            limit limit = {pthread_self(), shares[i], 0, 0, 0};
            const int32_t status = reduced(l, threads, &limit, 0, &model);
            CHECK_STATUS(status, limit.seen >= shares[i] ? SIGNORINI_STATUS_CANCELLED : 0);
            CHECK((model == NULL) == (status != 0));
            CHECK(limit.calls > 0 && limit.elsewhere == 0);
            /* It is asked in the middle, and nothing is done twice. */
            CHECK(shares[i] > 1 ? limit.seen > 0.5 && limit.seen <= 1 : status != 0);
            signorini_model_free(model);
        }
        CHECK_STATUS(reduced(l, threads, NULL, 1e-9, &model), SIGNORINI_STATUS_TIME_LIMIT);
        CHECK(model == NULL);
    }
}

/* A matrix that is not definite is refused with the same words, whichever thread comes to it first. */
static void indefinite(lattice *l)
{
    char first[512];
    signorini_model *model = NULL;
    const int64_t places[] = {l->size / 5, l->size / 2, l->size / 3};
    for (int i = 0; i < 3; i++) l->values[l->col_start[places[i]]] *= 0.01;
    for (int32_t threads = 1; threads <= 3; threads++) {
        CHECK_STATUS(reduced(l, threads, NULL, 0, &model), -1);
        CHECK_TEXT(signorini_last_error(), "definite");
        if (threads == 1) strcpy(first, signorini_last_error());
        CHECK(strcmp(first, signorini_last_error()) == 0);
    }
}

int main(void)
{
    lattice l = lattice_new(EDGE);
    same_bits(&l);
    full_space(&l);
    ended(&l);
    indefinite(&l);
    lattice_free(&l);
    return check_summary("reduction_threads");
}
