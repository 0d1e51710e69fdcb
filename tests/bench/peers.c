/*
 * Ours beside Siconos: the same matrices, one program, one run. See peers.sh.
 *
 *     peers MOST SECONDS [OUT]
 *
 * MOST is the largest number of pairs, SECONDS the CPU time that a call may take. The document goes
 * to standard output and OUT/peers.md, every row to OUT/peers.csv.
 */

#include "peers_table.h"

#include <limits.h>
#include <malloc.h>
#include <signorini.h>
#include <stdlib.h>
#include <string.h>

struct results {
    struct row *rows;
    size_t count;
};

static void run_all(const struct problem *problem, double limit, struct outcome *outcome,
                    struct results *results)
{
    struct row *rows = &results->rows[results->count];
    size_t count = 0, states[3];
    fprintf(stderr, "%s, %s, %zu pairs, mu %g\n", family_name(problem->family),
            geometry_name(problem->geometry), problem->contact.pairs, problem->mu);
    for (size_t k = 0; k < our_solver_count + siconos_solver_count; k++) {
        const struct solver *solver =
            k < our_solver_count ? &our_solvers[k] : &siconos_solvers[k - our_solver_count];
        if (solver->family == problem->family)
            judge(solver, problem, limit, outcome, &rows[count++]);
    }
    for (int round = 0; round < 2; round++)
        for (size_t k = 0; k < count; k++)
            time_again(problem, limit, outcome, &rows[k]);
    compare(rows, count, states);
    results->count += count;

    for (size_t k = 0; k < count; k++)
        fprintf(stderr, "  %-10s %-13s %10.4g ms %8d iterations  eta %8.1e  %s%s\n",
                rows[k].solver->library, rows[k].solver->name, rows[k].ms, rows[k].iterations,
                rows[k].eta, rows[k].status, rows[k].fell_back ? ", by a second method" : "");
    /* A problem without open, sliding and sticking pairs says little. */
    fprintf(stderr, "  %zu open, %zu slip, %zu stick\n", states[0], states[1], states[2]);
}

static void stop(const char *what)
{
    fprintf(stderr, "peers: %s\n", what);
    exit(1);
}

static void frictionless(enum geometry geometry, size_t pairs, double limit,
                         struct outcome *outcome, struct results *results)
{
    struct problem problem = {.family = FRICTIONLESS, .geometry = geometry};
    /* Deep waves: about half of the pairs stay open. */
    const char *wrong = contact_new(geometry, pairs, 4e-3, &problem.contact);
    if (wrong != NULL)
        stop(wrong);
    if (frictionless_forms(&problem.contact, &problem.stiffness, &problem.flexibility) != 0)
        stop("the condensed stiffness is not positive definite");
    problem.mu_of = need(pairs, sizeof *problem.mu_of);
    run_all(&problem, limit, outcome, results);
    free(problem.mu_of);
    lcp_free(&problem.stiffness);
    lcp_free(&problem.flexibility);
    contact_free(&problem.contact);
}

static void friction(enum geometry geometry, size_t pairs, double limit, struct outcome *outcome,
                     struct results *results)
{
    static const double mu[] = {0.1, 0.3, 1.0};
    struct problem problem = {.family = FRICTION_2D, .geometry = geometry};
    const char *wrong =
        contact_new(geometry, pairs, geometry == BAR ? 0.0 : 4e-3, &problem.contact);
    if (wrong != NULL)
        stop(wrong);
    if (friction_form(&problem.contact, &problem.flexibility) != 0)
        stop("the condensed stiffness is not positive definite");
    problem.mu_of = need(pairs, sizeof *problem.mu_of);
    for (size_t m = 0; m < sizeof mu / sizeof mu[0]; m++) {
        problem.mu = mu[m];
        for (size_t i = 0; i < pairs; i++)
            problem.mu_of[i] = mu[m];
        run_all(&problem, limit, outcome, results);
    }
    free(problem.mu_of);
    lcp_free(&problem.flexibility);
    contact_free(&problem.contact);
}

static FILE *open_in(const char *directory, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *file = fopen(path, "w");
    if (file == NULL)
        stop(path);
    return file;
}

/* After every size, so that a run that is ended early leaves what it has. */
static void save(const char *directory, const struct results *results, const char *versions,
                 double limit)
{
    FILE *csv = open_in(directory, "peers.csv"), *markdown = open_in(directory, "peers.md");
    write_csv(csv, results->rows, results->count);
    write_markdown(markdown, results->rows, results->count, versions, limit);
    fclose(csv);
    fclose(markdown);
}

int main(int argc, char **argv)
{
    static const size_t sizes[] = {33, 129, 513, 1025, 2049};
    if (argc < 3)
        stop("peers MOST SECONDS [OUT]");
    const size_t most = (size_t)strtoul(argv[1], NULL, 10);
    const double limit = strtod(argv[2], NULL);
    const char *threads = getenv("OPENBLAS_NUM_THREADS");
    if (threads == NULL || strcmp(threads, "1") != 0)
        stop("set OPENBLAS_NUM_THREADS=1: thread CPU time sees one thread");
    /* Freed memory stays with the process, as in a host that solves again and again. Otherwise the
     * clock shows how often the system hands out pages, which depends on what lies in memory. */
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    struct results results = {need(4096, sizeof(struct row)), 0};
    struct outcome *outcome = outcome_new(2 * 2049);
    char versions[512];
    snprintf(versions, sizeof versions, "signorini %s, Siconos %s, BLAS of both Siconos and the "
             "preparation: %s.", signorini_version(), SICONOS, blas_name());

    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0] && sizes[s] <= most; s++)
        for (int geometry = BAR; geometry <= TWO_BLOCKS; geometry++) {
            frictionless((enum geometry)geometry, sizes[s], limit, outcome, &results);
            if (sizes[s] <= 1025)
                friction((enum geometry)geometry, sizes[s], limit, outcome, &results);
            if (argc > 3)
                save(argv[3], &results, versions, limit);
        }

    write_markdown(stdout, results.rows, results.count, versions, limit);
    free(results.rows);
    return 0;
}
