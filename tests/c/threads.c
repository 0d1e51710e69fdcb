/*
 * Calls from several threads at once get the bits of the same calls one after the other, also on one model, and
 * the last error belongs to its thread. Helgrind watches this program too.
 */

#define _POSIX_C_SOURCE 200809L

#include "chains.h"
#include "check.h"

#include <pthread.h>

enum { THREADS = 4, ROUNDS = 20 };

typedef struct job {
    int number;
    chain expected, c;
    int64_t bits_differ, statuses_differ, sentences_differ;
} job;

/* A model that all threads use, its load case, and the solution. */
static signorini_model *shared;
static chain shared_case;

static pthread_barrier_t barrier;

static int32_t solve(chain *c, int number)
{
    signorini_settings settings;
    if (signorini_settings_default(&settings, sizeof settings)) return -1000;
    settings.method = number % 2 ? SIGNORINI_METHOD_SOR_DIAGONAL : SIGNORINI_METHOD_SOR_NESTED;
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, &settings, c->d, c->F, c->state, NULL, NULL);
}

static int32_t solve_shared(double *d, double *F)
{
    const chain *c = &shared_case;
    return signorini_model_solve(shared, 1, c->f, NULL, c->gap, SIGNORINI_LAW_COULOMB, c->mu, NULL,
                                 NULL, d, F, NULL, NULL, NULL, NULL);
}

/* The shared model once, in arrays of this thread. */
static int shared_differs(void)
{
    const size_t bytes = (size_t)shared_case.n * sizeof(double);
    double *const d = chain_numbers(shared_case.n), *const F = chain_numbers(shared_case.n);
    const int differs = solve_shared(d, F) != SIGNORINI_STATUS_SOLVED ||
                        memcmp(d, shared_case.d, bytes) || memcmp(F, shared_case.F, bytes);
    free(d);
    free(F);
    return differs;
}

static void *work(void *argument)
{
    job *j = argument;
    chain *c = &j->c;
    char sentence[64];
    pthread_barrier_wait(&barrier);
    if (signorini_last_error()[0] != '\0') j->sentences_differ++;
    for (int round = 0; round < ROUNDS; round++) {
        if (solve(c, j->number) != SIGNORINI_STATUS_SOLVED) j->statuses_differ++;
        if (signorini_last_error()[0] != '\0') j->sentences_differ++;
        if (memcmp(c->d, j->expected.d, (size_t)c->n * sizeof *c->d) ||
            memcmp(c->F, j->expected.F, (size_t)c->n * sizeof *c->F) ||
            memcmp(c->state, j->expected.state, (size_t)c->pairs * sizeof *c->state))
            j->bits_differ++;
        if (shared_differs()) j->bits_differ++;
        /* An error of each thread's own, read after all of them have had theirs. */
        c->f[j->number] += NAN;
        if (solve(c, j->number) != -5) j->statuses_differ++;
        pthread_barrier_wait(&barrier);
        snprintf(sentence, sizeof sentence, "f[%d] is not finite", j->number);
        if (strcmp(signorini_last_error(), sentence)) j->sentences_differ++;
        c->f[j->number] = j->expected.f[j->number];
        pthread_barrier_wait(&barrier);
    }
    return NULL;
}

int main(void)
{
    static job jobs[THREADS];
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        jobs[i].number = i;
        jobs[i].expected = chain_new(2 + i % 2, 20 + 7 * i, 0.05, 10 + (uint64_t)i);
        jobs[i].c = chain_new(2 + i % 2, 20 + 7 * i, 0.05, 10 + (uint64_t)i);
        CHECK_STATUS(solve(&jobs[i].expected, i), SIGNORINI_STATUS_SOLVED);
    }
    shared_case = chain_new(2, 30, 0.05, 5);
    CHECK_STATUS(signorini_model_new_condensed(2, shared_case.pairs, shared_case.K, shared_case.n,
                                               NULL, &shared), 0);
    CHECK_STATUS(solve_shared(shared_case.d, shared_case.F), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(signorini_settings_default(NULL, 0), -1);
    CHECK(pthread_barrier_init(&barrier, NULL, THREADS) == 0);
    for (int i = 0; i < THREADS; i++)
        if (pthread_create(&threads[i], NULL, work, &jobs[i])) return 2;
    for (int i = 0; i < THREADS; i++) CHECK(pthread_join(threads[i], NULL) == 0);
    pthread_barrier_destroy(&barrier);
    CHECK_TEXT(signorini_last_error(), "settings is NULL");
    for (int i = 0; i < THREADS; i++) {
        CHECK(jobs[i].statuses_differ == 0);
        CHECK(jobs[i].bits_differ == 0);
        CHECK(jobs[i].sentences_differ == 0);
        chain_free(&jobs[i].expected);
        chain_free(&jobs[i].c);
    }
    signorini_model_free(shared);
    chain_free(&shared_case);
    return check_summary("threads");
}
