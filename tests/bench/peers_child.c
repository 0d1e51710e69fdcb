#define _GNU_SOURCE

#include "peers_child.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct outcome *outcome_new(size_t size)
{
    const size_t bytes = sizeof(struct outcome) + 2 * size * sizeof(double);
    char *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        perror("peers: mmap");
        exit(1);
    }
    struct outcome *outcome = (struct outcome *)(void *)memory;
    outcome->x = (double *)(void *)(memory + sizeof *outcome);
    outcome->y = outcome->x + size;
    return outcome;
}

/* SIGPROF ends the process after so much CPU time. */
static void limit_cpu(double seconds)
{
    const double whole = floor(seconds);
    const struct itimerval limit = {.it_value = {.tv_sec = (time_t)whole,
        .tv_usec = (suseconds_t)(1e6 * (seconds - whole))}};
    setitimer(ITIMER_PROF, &limit, NULL);
}

static void child(const struct solver *solver, const struct problem *problem, double tolerance,
                  int repeat, double limit, struct outcome *outcome)
{
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    limit_cpu(limit);
    alarm((unsigned)(20.0 * limit) + 60); /* one that waits for nothing uses no CPU time */

    /* The peers print what they like; the table does not want it. */
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    siconos_prepare();

    solver->call(solver, problem, tolerance, outcome);
    const double first = outcome->seconds;
    if (repeat && first < 2.0) {
        const double enough = fmin(0.1, 0.1 * limit);
        limit_cpu(5.0 * first + 10.0 * enough); /* one that succeeds once may hang the next time */
        double filled = first;
        for (int calls = 1; calls < 3 || (filled < enough && calls < 2000); calls++) {
            const double begin = thread_seconds();
            solver->call(solver, problem, tolerance, outcome);
            filled += thread_seconds() - begin;
        }
    }
    _exit(0);
}

enum ending call_in_child(const struct solver *solver, const struct problem *problem,
                          double tolerance, int repeat, double limit, struct outcome *outcome)
{
    int status = 0;
    outcome->finished = outcome->fell_back = 0;
    fflush(NULL);
    const pid_t pid = fork();
    if (pid < 0) {
        perror("peers: fork");
        exit(1);
    }
    if (pid == 0)
        child(solver, problem, tolerance, repeat, limit, outcome);
    while (waitpid(pid, &status, 0) < 0)
        continue;
    if (outcome->finished && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return ENDED;
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGALRM ||
                                WTERMSIG(status) == SIGKILL))
        return OUT_OF_TIME;
    return CRASHED;
}
