/*
 * The system refuses memory, at every request in turn: once, and from there on. A call must end as it does
 * with memory, or with SIGNORINI_STATUS_OUT_OF_MEMORY; it must hold nothing then, and work again. Each trial
 * is a child process, so that one that dies is counted. Linux with glibc.
 *
 *     out_of_memory [TRIALS [SCENARIO]]
 *
 * TRIALS of each scenario and kind, evenly over its requests; 0: every request.
 */

#define _POSIX_C_SOURCE 200809L

#include "failing_malloc.h"

#include "memory_scenarios.h"

#include <pthread.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { AS_BEFORE, OUT_OF_MEMORY, OTHER_STATUS, HOLDS_MEMORY, UNUSABLE, DIED, OUTCOMES };

static const char *const names[OUTCOMES] = {"as before", "out of memory", "other status",
                                            "holds memory", "unusable", "died"};

/* Trials of a scenario and kind if nobody says how many. */
enum { TRIALS = 25 };

/* A run that a thread of its own makes, whose first call it is. */
struct work {
    const struct scenario *scenario;
    struct world *world;
    int64_t first, last;
    int32_t status;
};

static void *run(void *argument)
{
    struct work *work = argument;
    heap_watch(1);
    heap.first = work->first;
    heap.last = work->last;
    work->status = work->scenario->run(work->world);
    heap.watching = 0;
    return NULL;
}

/* The status on this thread, or on a new one. */
static int32_t status_of(struct work *work, int fresh)
{
    pthread_t thread;
    if (!fresh) run(work);
    else if (pthread_create(&thread, NULL, run, work) || pthread_join(thread, NULL)) work->status = 1;
    return work->status;
}

/* The child's outcome. */
static int outcome(struct work work, int32_t expected)
{
    const int64_t before = heap.living;
    const int fresh = work.scenario->kind == NEW_THREAD;
    const int32_t status = status_of(&work, fresh);
    if (heap.living != before) return HOLDS_MEMORY;
    if (status != expected && status != SIGNORINI_STATUS_OUT_OF_MEMORY) {
        printf("%s, request %lld: status %d\n", work.scenario->name, (long long)work.first,
               (int)status);
        fflush(stdout);
        return OTHER_STATUS;
    }
    work.first = INT64_MAX;
    if (status_of(&work, fresh) != expected) return UNUSABLE;
    return status == expected ? AS_BEFORE : OUT_OF_MEMORY;
}

static int trial(struct work work, int32_t expected)
{
    fflush(stdout);
    const pid_t child = fork();
    /* Rust says on stderr which request it could not go on without. */
    if (child == 0) _exit(outcome(work, expected));
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return DIED;
    return WIFEXITED(status) && WEXITSTATUS(status) < DIED ? WEXITSTATUS(status) : DIED;
}

/* Both kinds of a scenario. Returns how many trials there were. */
static int64_t tried(const struct scenario *scenario, struct world *world, int64_t most,
                     int64_t found[OUTCOMES])
{
    int64_t trials = 0;
    struct work work = {scenario, world, INT64_MAX, INT64_MAX, 0};
    /* The first run makes all that is made once and stays. */
    scenario->run(world);
    const int32_t expected = status_of(&work, scenario->kind == NEW_THREAD);
    const int64_t requests = heap.requests;
    CHECK_STATUS(expected, scenario->expected);
    const int64_t step = most && requests > most ? requests / most : 1;
    for (work.first = 1; work.first <= requests; work.first += step)
        for (int once = 0; once < 2; once++, trials++) {
            work.last = once ? work.first : INT64_MAX;
            found[trial(work, expected)]++;
        }
    printf("%-34s %9lld %7lld", scenario->name, (long long)requests, (long long)trials);
    for (int i = 0; i < OUTCOMES; i++) printf(" %13lld", (long long)found[i]);
    printf("\n");
    /*
     * A thread's first product of matrices registers what is to be freed when the thread ends. The C library
     * takes 40 bytes for that, and aborts if it cannot have them: refused alone, from there on, and from the
     * request before. A thread that a call starts does so before anything else, and the others wait.
     */
    const int begins = scenario->kind == NEW_THREAD || scenario->kind == TWO_THREADS;
    CHECK(found[DIED] <= (begins ? 3 : 0));
    CHECK(trials == found[AS_BEFORE] + found[OUT_OF_MEMORY] + found[DIED]);
    return trials;
}

/* Calls of one process, a request refused in each, and all from it on: what one leaves does not reach the next. */
static void one_after_the_other(struct world *world)
{
    int32_t (*const calls[])(struct world *) = {plane_lemke, space_newton, sparse_model, lcp};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        CHECK_STATUS(calls[i](world), 0);
        const int64_t before = heap.living;
        heap_watch(1);
        CHECK_STATUS(calls[i](world), 0);
        heap.watching = 0;
        const int64_t requests = heap.requests, step = requests > TRIALS ? requests / TRIALS : 1;
        for (int64_t first = 1; first <= requests; first += step)
            for (int once = 0; once < 2; once++) {
                heap_watch(1);
                heap.first = first;
                heap.last = once ? first : INT64_MAX;
                const int32_t status = calls[i](world);
                heap.watching = 0;
                CHECK(status == 0 || status == SIGNORINI_STATUS_OUT_OF_MEMORY);
                CHECK(heap.living == before);
            }
        CHECK_STATUS(calls[i](world), 0);
    }
}

/* The sentence needs no memory. */
static void sentence(struct world *world)
{
    heap_watch(1);
    heap.first = 1;
    CHECK_STATUS(plane_lemke(world), SIGNORINI_STATUS_OUT_OF_MEMORY);
    heap.watching = 0;
    CHECK_TEXT(signorini_last_error(), "not enough memory");
    CHECK_STATUS(plane_lemke(world), 0);
    CHECK_TEXT("", signorini_last_error());
}

/*
 * Nodes on springs above a plane, so many that the system refuses a condensed matrix: the model is in full space, asked
 * for or not, and the springs carry what the plane does not. Pairs that depend on each other need the matrix.
 */
static void no_room_for_a_condensed_matrix(void)
{
    enum { NODES = 3000, SIZE = 2 * NODES };
    /* A dense matrix of 288 MB is refused; a load case wants half of that. */
    const size_t least = 8u * SIZE * SIZE;
    static int64_t starts[SIZE + 1], rows[SIZE], slaves[SIZE];
    static double springs[SIZE], normals[SIZE], load[SIZE], gap[NODES], mu[NODES], d[SIZE], F[SIZE];
    for (int i = 0; i < SIZE; i++) {
        starts[i + 1] = i + 1;
        rows[i] = slaves[i] = i;
        springs[i] = 4;
        normals[i] = i % 2 ? -1 : 0;
        load[i] = i % 4 == 1 ? -8 : i % 4 == 3 ? 8 : 0;
    }
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = SIZE, .nnz = SIZE,
                                .col_start = starts, .row = rows, .values = springs};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = NODES,
                                   .slaves = slaves, .normals = normals};
    signorini_settings settings;
    signorini_settings_default(&settings, sizeof settings);
    for (settings.full_space = 0; settings.full_space < 2; settings.full_space++) {
        signorini_model *model = NULL;
        signorini_model_data data = {.struct_size = sizeof data};
        heap_watch(least);
        heap.first = 1;
        CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, &pairs, &settings, &model), 0);
        CHECK(settings.full_space ? heap.refused == 0 : heap.refused > 0);
        CHECK_STATUS(signorini_model_view(model, &data), 0);
        CHECK(data.kind == SIGNORINI_MODEL_FULL_SPACE);
        CHECK_STATUS(signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL,
                                           d, F, NULL, NULL, NULL, NULL), 0);
        heap.watching = 0;
        signorini_model_free(model);
        /* The first node is pressed, the second one lifted by 8 / 4. */
        CHECK_NEAR(d[0], 0);
        CHECK_NEAR(F[0], -8);
        CHECK_NEAR(d[2], -2);
        CHECK_NEAR(F[2], 0);
    }
    slaves[2] = slaves[0], slaves[3] = slaves[1];
    settings.full_space = 1;
    signorini_model *model = NULL;
    heap_watch(least);
    heap.first = 1;
    CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, &pairs, &settings, &model),
                 SIGNORINI_STATUS_OUT_OF_MEMORY);
    heap.watching = 0;
}

int main(int count, char **argument)
{
    const int64_t most = count > 1 ? atoll(argument[1]) : TRIALS;
    const char *only = count > 2 ? argument[2] : NULL;
    int64_t sums[OUTCOMES] = {0}, all = 0;
    struct world *world = world_new();
    printf("%-34s %9s %7s", "scenario", "requests", "tried");
    for (int i = 0; i < OUTCOMES; i++) printf(" %13s", names[i]);
    printf("\n");
    for (const struct scenario *scenario = scenarios; scenario->name; scenario++) {
        int64_t found[OUTCOMES] = {0};
        if (only && strcmp(only, scenario->name)) continue;
        all += tried(scenario, world, most, found);
        for (int i = 0; i < OUTCOMES; i++) sums[i] += found[i];
    }
    printf("%-34s %9s %7lld", "all", "", (long long)all);
    for (int i = 0; i < OUTCOMES; i++) printf(" %13lld", (long long)sums[i]);
    printf("\n");
    one_after_the_other(world);
    sentence(world);
    no_room_for_a_condensed_matrix();
    world_free(world);
    return check_summary("out_of_memory");
}
