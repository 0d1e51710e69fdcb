/*
 * Friction problems of multibody dynamics, solved in flexibility form by this library, which takes
 * W sparse, and by Siconos: `sh tests/bench/fclib.sh FOLDER` builds and runs it.
 *
 *     fclib SECONDS FILE...
 *
 * Files are FCLIB's (HDF5) or Siconos' own (text). All take W made symmetric; of a global form M
 * is, and then it is condensed. Each solver runs on each file in a process of its own, of at most SECONDS of
 * processor time a call, on one thread. What it returns is judged here from the file alone, by the
 * residual of c_examples/fclib/local_form.h: it solves the file if that is at most 1e-9. The table
 * has the fastest solver of Siconos that does, or the one with the least residual. Tolerances are
 * 1e-10 for all. Siconos' solvers measure the error in their own way, so each is tried again with
 * 1e-13 where it stops too early. Times are processor time of the call alone, the least of several
 * calls where they are short.
 */

#define _GNU_SOURCE

#include "dense.h"
#include "fclib_dat.h"
#include "fclib_siconos.h"
#include "local_form.h"
#include "../c/everything.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const double SOLVED = 1e-9, TOLERANCE = 1e-10, TIGHT = 1e-13;

/* Calls are repeated up to so many times, or until they have taken so long. */
enum { CALLS = 20 };
static const double ENOUGH = 0.2;

/* The results that a child leaves to its parent. */
struct answer {
    int finished, status;
    double seconds, r[];
};

/* FCLIB's u = W r + q is our d = W F + q with d = -u, F = -r and -q. */
static double ours(const struct local_form *form, double limit, double *r, int *status)
{
    struct signorini_report report = {.struct_size = sizeof report};
    struct signorini_settings settings;
    const size_t n = form->size;
    double *d = need(n), *q = need(n);
    struct triangle lower = lower_triangle(form);
    const signorini_sparse W = {.struct_size = sizeof W,
        .index_bytes = sizeof *lower.row, .triangle = SIGNORINI_TRIANGLE_LOWER, .size = (int64_t)n,
        .nnz = lower.col_start[n], .col_start = lower.col_start, .row = lower.row,
        .values = lower.values};
    for (size_t i = 0; i < n; i++)
        q[i] = -form->q[i];
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = TOLERANCE;
    limit_time(limit);
    const double began = seconds_used();
    *status = solve_flexibility_sparse(form->dim, (int64_t)form->contacts, &W, q, NULL,
        SIGNORINI_LAW_COULOMB, form->mu, NULL, &settings, d, r, NULL, &report, NULL);
    const double took = seconds_used() - began;
    for (size_t i = 0; i < n; i++)
        r[i] = -r[i];
    triangle_free(&lower);
    free(d);
    free(q);
    return took;
}

/* A solver of Siconos, or ours where it is NULL. */
static double call(const struct siconos_solver *solver, const struct local_form *form,
                   double tolerance, double limit, double *r, int *status)
{
    return solver == NULL ? ours(form, limit, r, status)
                          : siconos_solve(solver, form, tolerance, limit, r);
}

static void child(const struct local_form *form, const struct siconos_solver *solver,
                  double tolerance, double limit, struct answer *answer)
{
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    /* Siconos prints what it likes; the table does not want it. */
    if (solver != NULL && (freopen("/dev/null", "w", stdout) == NULL ||
                           freopen("/dev/null", "w", stderr) == NULL))
        _exit(1);
    answer->seconds = call(solver, form, tolerance, limit, answer->r, &answer->status);
    if (solver == NULL && answer->status != 0)
        fprintf(stderr, "    status %d: %s\n", answer->status, signorini_last_error());
    answer->finished = 1;
    int status;
    double *again = need(form->size), all = answer->seconds;
    for (int calls = 1; calls < CALLS && all < ENOUGH; calls++) {
        const double took = call(solver, form, tolerance, limit, again, &status);
        answer->seconds = fmin(answer->seconds, took);
        all += took;
    }
    _exit(0);
}

/* Runs a solver in a child; whether it ended. */
static int run(const struct local_form *form, const struct siconos_solver *solver,
               double tolerance, double limit, struct answer *answer)
{
    memset(answer, 0, sizeof *answer + form->size * sizeof *answer->r);
    fflush(NULL);
    const pid_t pid = fork();
    if (pid < 0) {
        perror("fclib: fork");
        exit(EXIT_FAILURE);
    }
    if (pid == 0)
        child(form, solver, tolerance, limit, answer);
    waitpid(pid, NULL, 0);
    return answer->finished;
}

/* Prints the last columns; returns the seconds of the best solver, infinite if none solves it. */
static double print_best(const struct local_form *form, double limit, struct answer *answer)
{
    const char *best = "none ended";
    double least = INFINITY, time = INFINITY;
    for (size_t k = 0; k < siconos_solver_count; k++) {
        if (siconos_solvers[k].dim != form->dim)
            continue;
        for (int tight = 0; tight < 2; tight++) {
            /* One that takes longer than the best needs no end. */
            const double room = least <= SOLVED ? fmin(limit, 2.0 * time + 0.05) : limit;
            if (!run(form, &siconos_solvers[k], tight ? TIGHT : TOLERANCE, room, answer))
                break;
            const double residual = local_form_residual(form, answer->r);
            const int solves = residual <= SOLVED;
            if (solves ? least > SOLVED || answer->seconds < time : residual < least) {
                least = residual;
                time = answer->seconds;
                best = siconos_solvers[k].name;
            }
            if (solves)
                break;
        }
    }
    if (isinf(least))
        printf(" %s | | |", best);
    else
        printf(" %s | %.0e | %.3g |", best, least, 1e3 * time);
    return least <= SOLVED ? time : INFINITY;
}

struct counts {
    int files, certified, solved, by_siconos, faster;
};

static void compare(const char *name, const struct local_form *form, double limit,
                    struct counts *counts)
{
    const size_t bytes = sizeof(struct answer) + form->size * sizeof(double);
    struct answer *answer =
        mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (answer == MAP_FAILED) {
        perror("fclib: mmap");
        exit(EXIT_FAILURE);
    }
    double time = INFINITY;
    printf("| %s | %s | %d | %zu | %.0e |", name, form->found, form->dim, form->contacts,
           form->asymmetry);
    if (run(form, NULL, TOLERANCE, limit, answer)) {
        const double residual =
            answer->status < 0 ? INFINITY : local_form_residual(form, answer->r);
        if (answer->status < 0) /* refused */
            printf(" %d | | |", answer->status);
        else
            printf(" %d | %.0e | %.3g |", answer->status, residual, 1e3 * answer->seconds);
        counts->certified += answer->status == 0 && residual <= SOLVED;
        counts->solved += residual <= SOLVED;
        if (residual <= SOLVED)
            time = answer->seconds;
    } else {
        printf(" out of time | | |");
    }
    const double theirs = print_best(form, limit, answer);
    if (isfinite(time) && isfinite(theirs))
        printf(" %.2g |\n", time / theirs);
    else
        printf(" |\n");
    counts->files++;
    counts->by_siconos += isfinite(theirs);
    counts->faster += time < theirs;
    munmap(answer, bytes);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: %s SECONDS FILE...\n", argv[0]);
        return 2;
    }
    const double limit = strtod(argv[1], NULL);
    struct counts counts = {0};
    printf("| file | form | dim | contacts | asymmetry | ours: status | residual | ms "
           "| Siconos' best | residual | ms | ratio |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int k = 2; k < argc; k++) {
        struct local_form form;
        const char *slash = strrchr(argv[k], '/'), *end = strrchr(argv[k], '.');
        const char *name = slash != NULL ? slash + 1 : argv[k];
        const char *wrong = end != NULL && strcmp(end, ".dat") == 0
                                ? dat_read(argv[k], &form)
                                : local_form_read(argv[k], &form);
        fprintf(stderr, "%s%s%s\n", name, wrong != NULL ? ": not read: " : "",
                wrong != NULL ? wrong : "");
        if (wrong != NULL)
            continue;
        compare(name, &form, limit, &counts);
        local_form_free(&form);
    }
    printf("\n%d files: %d certified by this library, %d with a residual of at most %.0e; %d by "
           "Siconos; this library is the faster one on %d\n", counts.files, counts.certified,
           counts.solved, SOLVED, counts.by_siconos, counts.faster);
    return 0;
}
