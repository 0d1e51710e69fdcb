/*
 * Threads and processes of a host: a thread that is cancelled during a call, small stacks, a
 * fork with objects that both sides then use, calls that the host leaves by a jump, and callbacks that stop a call
 * at every place. Nothing is held afterwards. Linux with glibc.
 */

#define _POSIX_C_SOURCE 200809L

#include "failing_malloc.h"

#include "memory_scenarios.h"

#include <fenv.h>
#include <pthread.h>
#include <setjmp.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- A thread that is cancelled ------------------------------------------------------------- */

struct run {
    const struct scenario *scenario;
    struct world *world;
    int32_t status;
};

static void *run(void *argument)
{
    struct run *run = argument;
    run->status = run->scenario->run(run->world);
    pthread_testcancel();
    return NULL;
}

/*
 * Cancelled before its call begins, so that every place in it that the system lets a thread end at is met.
 * The call ends as always, and then the thread.
 */
static void *cancelled(void *argument)
{
    pthread_cancel(pthread_self());
    return run(argument);
}

static void cancellation(struct world *world)
{
    /* The C library keeps what it makes for the first thread that is cancelled. */
    struct run warm = {scenarios, world, -77};
    pthread_t first;
    CHECK(pthread_create(&first, NULL, cancelled, &warm) == 0 && pthread_join(first, NULL) == 0);
    for (const struct scenario *scenario = scenarios; scenario->name; scenario++) {
        struct run work = {scenario, world, -77};
        pthread_t thread;
        void *end = NULL;
        const int64_t before = heap.living;
        CHECK(pthread_create(&thread, NULL, cancelled, &work) == 0);
        CHECK(pthread_join(thread, &end) == 0);
        CHECK(end == PTHREAD_CANCELED);
        CHECK_STATUS(work.status, scenario->expected);
        if (!check_result(__FILE__, __LINE__, heap.living == before))
            printf("%s: %lld pieces are left\n", scenario->name, (long long)(heap.living - before));
    }
}

/* ---- Small stacks --------------------------------------------------------------------------- */

/* 64 KiB, or the least that the system gives, in bytes. */
static size_t small_stack_size(void)
{
    const long least = sysconf(_SC_THREAD_STACK_MIN);
    return least > 64 << 10 ? (size_t)least : 64 << 10;
}

static void small_stack(struct world *world, const struct scenario *scenario)
{
    /* A stack that is too small ends the process: the child's. */
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        struct run work = {scenario, world, -77};
        pthread_attr_t attributes;
        pthread_t thread;
        if (pthread_attr_init(&attributes) || pthread_attr_setstacksize(&attributes, small_stack_size()) ||
            pthread_create(&thread, &attributes, run, &work))
            _exit(2);
        pthread_join(thread, NULL);
        _exit(work.status != scenario->expected);
    }
    int status = -1;
    CHECK(child > 0 && waitpid(child, &status, 0) == child);
    if (!check_result(__FILE__, __LINE__, status == 0))
        printf("%s: status %x with a stack of %zu KiB\n", scenario->name, (unsigned)status,
               small_stack_size() >> 10);
}

static void small_stacks(struct world *world)
{
    for (const struct scenario *scenario = scenarios; scenario->name; scenario++)
        small_stack(world, scenario);
}

/* ---- Fork ----------------------------------------------------------------------------------- */

static volatile int busy_ends;

/* Calls all the time, so that the fork finds a thread in a call. */
static void *busy(void *argument)
{
    while (!busy_ends) small_auto(argument);
    return NULL;
}

/* Both sides of a fork use and release the objects that were there before. */
static int use_and_release(struct world *w, signorini_model *model, signorini_surface_pairs *contact,
                           signorini_problem *problem)
{
    chain *c = &w->plane;
    int32_t status = signorini_model_solve(model, 1, w->more, NULL, w->gap, SIGNORINI_LAW_COULOMB,
                                           w->mu, NULL, NULL, w->d, w->F, w->state, NULL, NULL, NULL);
    if (!status) status = plane_auto(w);
    if (!status) status = surface_data(contact).pairs > 0 ? 0 : 1;
    if (!status) status = problem_data(problem).size == c->n ? 0 : 1;
    signorini_model_free(model);
    signorini_surface_free(contact);
    signorini_problem_free(problem);
    return status != 0;
}

static void forks(struct world *w, struct world *other)
{
    chain *c = &w->plane;
    pthread_t thread;
    CHECK(pthread_create(&thread, NULL, busy, other) == 0);
    for (int round = 0; round < 20; round++) {
        signorini_model *model = NULL;
        signorini_surface_pairs *contact = NULL;
        signorini_problem *problem = NULL;
        const char *const path = "processes.mtx";
        CHECK_STATUS(signorini_model_new_condensed(c->dim, c->pairs, c->K, c->n, NULL, &model), 0);
        CHECK_STATUS(signorini_surface_pair(3, w->mesh->nodes, w->mesh->at[0], &w->bottom, &w->top,
                                            NULL, &contact), 0);
        CHECK_STATUS(signorini_problem_write(path, c->dim, c->pairs, c->K, c->n, c->f, c->gap,
                                             SIGNORINI_LAW_COULOMB, c->mu, NULL, NULL), 0);
        CHECK_STATUS(signorini_problem_read(path, &problem), 0);
        remove(path);
        fflush(stdout);
        const pid_t child = fork();
        if (child == 0) {
            /* A child that hangs is ended by the system. */
            alarm(60);
            _exit(use_and_release(w, model, contact, problem));
        }
        int status = -1;
        CHECK(use_and_release(w, model, contact, problem) == 0);
        CHECK(child > 0 && waitpid(child, &status, 0) == child);
        CHECK(status == 0);
    }
    busy_ends = 1;
    CHECK(pthread_join(thread, NULL) == 0);
}

/* Every request of all threads is refused: the thread that calls is served from its reserve all the time. */
static void forks_while_served(struct world *w, struct world *other)
{
    pthread_t thread;
    CHECK_STATUS(small_auto(w), 0);
    busy_ends = 0;
    CHECK(pthread_create(&thread, NULL, busy, other) == 0);
    heap_watch(1);
    heap.first = 1;
    for (int round = 0; round < 300; round++) {
        fflush(stdout);
        const pid_t child = fork();
        if (child == 0) {
            heap.watching = 0;
            alarm(60);
            _exit(small_auto(w) != 0);
        }
        int status = -1;
        if (!check_result(__FILE__, __LINE__, child > 0 && waitpid(child, &status, 0) == child && status == 0))
            break;
    }
    heap.watching = 0;
    busy_ends = 1;
    CHECK(pthread_join(thread, NULL) == 0);
}

/* ---- A call that the host has left by a jump -------------------------------------------------- */

static jmp_buf outside;

static int32_t jump_out(void *user, const signorini_progress *progress)
{
    (void)user;
    (void)progress;
    longjmp(outside, 1);
}

/* Pages that the process has mapped, touched or not. */
static long pages(void)
{
    long size = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld", &size) != 1) size = -1;
    if (file) fclose(file);
    return size;
}

/* True if the callback has left the call. */
static int jump(const chain *c, const signorini_settings *settings)
{
    if (setjmp(outside)) return 1;
    signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu, NULL,
                    settings, c->d, c->F, c->state, NULL, NULL);
    return 0;
}

/*
 * The header forbids it, and old hosts do it. The next call gives back what the call that was left held of the
 * thread: the host's rounding mode, its cancellation, and the reserve, without which each later call
 * would keep half a megabyte of addresses and more.
 */
static void jumps(struct world *w)
{
    signorini_settings settings;
    int state = -1;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.progress = jump_out;
    CHECK(fesetround(FE_UPWARD) == 0);
    for (int i = 0; i < 3; i++) CHECK(jump(&w->plane, &settings));
    CHECK_STATUS(small_auto(w), 0);
    CHECK(fegetround() == FE_UPWARD);
    fesetround(FE_TONEAREST);
    CHECK(pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &state) == 0 && state == PTHREAD_CANCEL_ENABLE);
    const long before = pages(), page = sysconf(_SC_PAGESIZE);
    for (int i = 0; i < 1000; i++) CHECK_STATUS(small_auto(w), 0);
    /* A tenth of what 1000 reserves take. */
    CHECK(before > 0 && (pages() - before) * page < 50L << 20);
}

/* ---- Callbacks ------------------------------------------------------------------------------ */

struct patience {
    int64_t calls, most;
    int32_t answer;
};

static int32_t impatient(void *user, const signorini_progress *progress)
{
    struct patience *patience = user;
    (void)progress;
    return ++patience->calls > patience->most ? patience->answer : 0;
}

/* Any number but 0 cancels. */
static const int32_t answers[] = {1, -1, INT32_MAX, INT32_MIN};

static void cancelled_solutions(struct world *w)
{
    chain *chains[] = {&w->plane, &w->space};
    for (int which = 0; which < 2; which++)
        for (int32_t method = SIGNORINI_METHOD_AUTO; method <= SIGNORINI_METHOD_PATH; method++)
            for (int64_t most = 0; most < 12; most++) {
                chain *c = chains[which];
                const int pivoting = method == SIGNORINI_METHOD_BLOCK_PIVOTING;
                struct patience patience = {0, most, answers[most % 4]};
                signorini_settings settings;
                CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
                settings.method = method;
                settings.progress = impatient;
                settings.user = &patience;
                const int64_t before = heap.living;
                const int32_t status = signorini_solve(
                    c->dim, c->pairs, c->K, c->n, c->f, c->gap,
                    pivoting ? SIGNORINI_LAW_FRICTIONLESS : SIGNORINI_LAW_COULOMB,
                    pivoting ? NULL : c->mu, NULL, &settings, c->d, c->F, c->state, NULL, NULL);
                CHECK(heap.living == before);
                if (which && method == SIGNORINI_METHOD_LEMKE) CHECK(status == -10);
                /* The best iterate of a call that is cancelled may be the solution already. */
                else CHECK(status == SIGNORINI_STATUS_SOLVED ||
                           (patience.calls > most && status == SIGNORINI_STATUS_CANCELLED));
            }
}

static void cancelled_reductions(struct world *w)
{
    const signorini_sparse K = matrix_of(w->mesh);
    signorini_surface_pairs *contact = NULL;
    CHECK_STATUS(signorini_surface_pair(3, w->mesh->nodes, w->mesh->at[0], &w->bottom, &w->top, NULL,
                                        &contact), 0);
    for (int64_t most = 0; most < 12; most++) {
        struct patience patience = {0, most, answers[most % 4]};
        signorini_model *model = NULL;
        signorini_settings settings;
        CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
        settings.progress = impatient;
        settings.user = &patience;
        const int64_t before = heap.living;
        const int32_t status = signorini_model_new_sparse(
            &K, w->n_fixed, w->fixed, surface_data(contact).rows, &settings, &model);
        CHECK_STATUS(status, patience.calls > most ? SIGNORINI_STATUS_CANCELLED : 0);
        CHECK((model == NULL) == (status != 0));
        signorini_model_free(model);
        CHECK(heap.living == before);
    }
    signorini_surface_free(contact);
}

int main(void)
{
    struct world *world = world_new(), *other = world_new();
    /* The first run makes all that is made once and stays. */
    for (const struct scenario *scenario = scenarios; scenario->name; scenario++)
        CHECK_STATUS(scenario->run(world), scenario->expected);
    cancellation(world);
    small_stacks(world);
    forks(world, other);
    forks_while_served(world, other);
    jumps(world);
    cancelled_solutions(world);
    cancelled_reductions(world);
    world_free(world);
    world_free(other);
    return check_summary("processes");
}
