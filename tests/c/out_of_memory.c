/*
 * The system refuses memory, at every request in turn: once, and from there on. A call must end as it does
 * with memory, or with SIGNORINI_STATUS_OUT_OF_MEMORY; it must hold nothing then, and work again. Each trial
 * is a child process, so that one that dies is counted. Linux with glibc.
 *
 *     out_of_memory [TRIALS]
 *
 * TRIALS of each scenario and kind, evenly over its requests; 0: every request.
 */

#define _POSIX_C_SOURCE 200809L

#include "failing_malloc.h"

#include "memory_scenarios.h"

#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { AS_BEFORE, OUT_OF_MEMORY, OTHER_STATUS, HOLDS_MEMORY, UNUSABLE, DIED, OUTCOMES };

static const char *const names[OUTCOMES] = {"as before", "out of memory", "other status",
                                            "holds memory", "unusable", "died"};

/* Trials of a scenario and kind if nobody says how many. */
enum { TRIALS = 40 };

/* What the child finds. */
static int outcome(const struct scenario *scenario, struct world *world, int64_t first, int64_t last,
                   int32_t expected)
{
    const int64_t before = heap.living;
    heap_watch(1);
    heap.first = first;
    heap.last = last;
    const int32_t status = scenario->run(world);
    heap.watching = 0;
    if (heap.living != before) return HOLDS_MEMORY;
    if (status != expected && status != SIGNORINI_STATUS_OUT_OF_MEMORY) {
        printf("%s, request %lld: status %d (%s)\n", scenario->name, (long long)first, (int)status,
               signorini_last_error());
        fflush(stdout);
        return OTHER_STATUS;
    }
    if (scenario->run(world) != expected) return UNUSABLE;
    return status == expected ? AS_BEFORE : OUT_OF_MEMORY;
}

static int trial(const struct scenario *scenario, struct world *world, int64_t first, int64_t last,
                 int32_t expected)
{
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        /* Rust says on stderr which request it could not go on without. */
        _exit(outcome(scenario, world, first, last, expected));
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return DIED;
    return WIFEXITED(status) && WEXITSTATUS(status) < DIED ? WEXITSTATUS(status) : DIED;
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
        int64_t found[OUTCOMES] = {0}, tried = 0;
        if (only && strcmp(only, scenario->name)) continue;
        /* What is made once and stays is there after the first run. */
        scenario->run(world);
        heap_watch(1);
        const int32_t expected = scenario->run(world);
        heap.watching = 0;
        const int64_t requests = heap.requests;
        CHECK_STATUS(expected, scenario->expected);
        const int64_t step = most && requests > most ? requests / most : 1;
        for (int64_t first = 1; first <= requests; first += step)
            for (int once = 0; once < 2; once++) {
                found[trial(scenario, world, first, once ? first : INT64_MAX, expected)]++;
                tried++;
            }
        printf("%-34s %9lld %7lld", scenario->name, (long long)requests, (long long)tried);
        for (int i = 0; i < OUTCOMES; i++) printf(" %13lld", (long long)found[i]);
        printf("\n");
        for (int i = 0; i < OUTCOMES; i++) sums[i] += found[i];
        all += tried;
        CHECK(tried == found[AS_BEFORE] + found[OUT_OF_MEMORY]);
    }
    printf("%-34s %9s %7lld", "all", "", (long long)all);
    for (int i = 0; i < OUTCOMES; i++) printf(" %13lld", (long long)sums[i]);
    printf("\n");
    sentence(world);
    world_free(world);
    return check_summary("out_of_memory");
}
