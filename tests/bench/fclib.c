/*
 * Files of the Frictional Contact Library, solved in flexibility form by this library, which takes
 * W sparse, and by Siconos: `sh tests/bench/fclib.sh FOLDER` builds and runs it.
 *
 *     fclib SECONDS FILE...
 *
 * Each solver runs on each file in a process of its own, of at most SECONDS of processor time. What
 * it returns is judged here from the file alone, by the residual of c_examples/fclib/local_form.h:
 * it solves the file if that is at most 1e-9. The table has the fastest solver of Siconos that does,
 * or the one with the least residual. Tolerances are 1e-10 for all. Siconos' solvers measure the
 * error in their own way, so each is tried again with 1e-13 where it stops too early.
 */

#include "local_form.h"
#include "signorini.h"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const double SOLVED = 1e-9, TOLERANCE = 1e-10, TIGHT = 1e-13;

/* What a child leaves to its parent. */
struct answer {
    int finished, status;
    double seconds, eta, r[];
};

struct solver {
    const char *name;
    int dim, id, iterations;
};

static const struct solver siconos[] = {
    {"NSGS", 3, SICONOS_FRICTION_3D_NSGS, 1000000},
    {"NSN_AC", 3, SICONOS_FRICTION_3D_NSN_AC, 1000},
    {"NSN_FB", 3, SICONOS_FRICTION_3D_NSN_FB, 1000},
    {"PROX", 3, SICONOS_FRICTION_3D_PROX, 1000},
    {"VI_EG", 3, SICONOS_FRICTION_3D_VI_EG, 1000000},
    {"NSGS", 2, SICONOS_FRICTION_2D_NSGS, 1000000},
    {"CPG", 2, SICONOS_FRICTION_2D_CPG, 1000000},
};

enum { SOLVERS = sizeof siconos / sizeof *siconos };

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* FCLIB's u = W r + q is our d = W F + q with d = -u, F = -r and -q. */
static void ours(const struct local_form *form, struct answer *answer)
{
    struct signorini_report report = {.struct_size = sizeof report};
    struct signorini_settings settings;
    const size_t n = form->size;
    double *d = calloc(n + 1, sizeof *d), *q = calloc(n + 1, sizeof *q);
    if (d == NULL || q == NULL)
        return;
    struct triangle lower = lower_triangle(form);
    const signorini_sparse W = {.struct_size = sizeof W,
        .index_bytes = sizeof *lower.row, .triangle = SIGNORINI_TRIANGLE_LOWER, .size = (int64_t)n,
        .nnz = lower.col_start[n], .col_start = lower.col_start, .row = lower.row,
        .values = lower.values};
    for (size_t i = 0; i < n; i++)
        q[i] = -form->q[i];
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = TOLERANCE;
    answer->status = signorini_flexibility_solve_sparse(
        form->dim, (int64_t)form->contacts, &W, q, NULL, SIGNORINI_LAW_COULOMB, form->mu, NULL,
        &settings, d, answer->r, NULL, &report, NULL);
    if (answer->status != 0)
        fprintf(stderr, "    %s\n", signorini_last_error());
    answer->eta = report.eta;
    for (size_t i = 0; i < n; i++)
        answer->r[i] = -answer->r[i];
    triangle_free(&lower);
    free(d);
    free(q);
}

static void theirs(const struct local_form *form, const struct solver *solver, double tolerance,
                   struct answer *answer)
{
    const int n = (int)form->size;
    double *u = calloc(form->size + 1, sizeof *u);
    NumericsMatrix *M = NM_create_from_data(NM_DENSE, n, n, form->W);
    FrictionContactProblem data = {.dimension = form->dim,
        .numberOfContacts = (int)form->contacts, .M = M, .q = form->q, .mu = form->mu};
    SolverOptions *options = solver_options_create(solver->id);
    numerics_set_verbose(0);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = solver->iterations;
    answer->status = form->dim == 2 ? fc2d_driver(&data, answer->r, u, options)
                                    : fc3d_driver(&data, answer->r, u, options);
}

/* Runs a solver (NULL: ours) in a child; whether it ended. */
static int run(const struct local_form *form, const struct solver *solver, double tolerance,
               unsigned limit, struct answer *answer)
{
    memset(answer, 0, sizeof *answer + form->size * sizeof *answer->r);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit time = {.rlim_cur = limit, .rlim_max = limit};
        setrlimit(RLIMIT_CPU, &time);
        if (solver != NULL && freopen("/dev/null", "w", stdout) == NULL)
            _exit(1);
        const double began = seconds();
        if (solver == NULL)
            ours(form, answer);
        else
            theirs(form, solver, tolerance, answer);
        answer->seconds = seconds() - began;
        answer->finished = 1;
        _exit(0);
    }
    if (child < 0)
        return 0;
    waitpid(child, NULL, 0);
    return answer->finished;
}

static void print_best(const struct local_form *form, unsigned limit, struct answer *answer)
{
    const char *best = "none ended";
    double least = INFINITY, time = 0.0;
    for (int k = 0; k < SOLVERS; k++) {
        if (siconos[k].dim != form->dim)
            continue;
        for (int tight = 0; tight < 2; tight++) {
            if (!run(form, &siconos[k], tight ? TIGHT : TOLERANCE, limit, answer))
                continue;
            const double residual = local_form_residual(form, answer->r);
            const int solves = residual <= SOLVED;
            if (solves ? least > SOLVED || answer->seconds < time : residual < least) {
                least = residual;
                time = answer->seconds;
                best = siconos[k].name;
            }
            if (solves)
                break;
        }
    }
    if (isinf(least))
        printf(" %s | | |\n", best);
    else
        printf(" %s | %.0e | %.4f |\n", best, least, time);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: %s SECONDS FILE...\n", argv[0]);
        return 2;
    }
    const unsigned limit = (unsigned)strtoul(argv[1], NULL, 10);
    int certified = 0, solved = 0, files = 0;
    printf("| file | form | dim | contacts | asymmetry of W | ours: status | eta | residual | s "
           "| Siconos' best | residual | s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int k = 2; k < argc; k++) {
        struct local_form form;
        const char *slash = strrchr(argv[k], '/');
        const char *name = slash != NULL ? slash + 1 : argv[k];
        const char *wrong = local_form_read(argv[k], &form);
        if (wrong != NULL) {
            printf("| %s | not read: %s |\n", name, wrong);
            continue;
        }
        const size_t bytes = sizeof(struct answer) + form.size * sizeof(double);
        struct answer *answer =
            mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (answer == MAP_FAILED)
            return 1;
        printf("| %s | %s | %d | %zu | %.0e |", name, form.found, form.dim, form.contacts,
               form.asymmetry);
        if (run(&form, NULL, TOLERANCE, limit, answer)) {
            const double residual =
                answer->status < 0 ? INFINITY : local_form_residual(&form, answer->r);
            printf(" %d | %.0e | %.0e | %.4f |", answer->status, answer->eta, residual,
                   answer->seconds);
            certified += answer->status == 0;
            solved += residual <= SOLVED;
        } else {
            printf(" time | | | |");
        }
        print_best(&form, limit, answer);
        files++;
        munmap(answer, bytes);
        local_form_free(&form);
    }
    printf("\n%d files: %d certified by this library, %d with a residual of at most %.0e\n", files,
           certified, solved, SOLVED);
    return 0;
}
