/*
 * Ours beside Siconos: the same matrices, one program, one run. See peers.sh.
 *
 *     peers LEAST MOST SECONDS FAMILY [OUT]
 *
 * LEAST and MOST are the smallest and largest number of pairs, SECONDS the CPU time that a call may
 * take, FAMILY one of frictionless, friction2d, friction3d, held, or all. The document goes to standard
 * output and OUT/peers.md, every row to OUT/peers.csv.
 */

#include "peers_block.h"
#include "peers_held.h"
#include "peers_table.h"

#include <limits.h>
#include <math.h>
#include <malloc.h>
#include "../c/everything.h"
#include <stdlib.h>
#include <string.h>

/* Nodes along an edge of a column; pairs of the largest problem in space that peers are given. */
enum { COLUMN_SIDE = 5, MOST_BESIDE_PEERS = 961 };

/* All solvers are timed again in turns, and more often where the best peer takes less than some ms: a machine may be slow for
   a second. Later turns, and those in space, are of peers within a factor of the best: noise is less. */
enum { TURNS = 2, TURNS_OF_SHORT_CALLS = 8 };
static const double short_ms = 20.0, much_slower = 3.0;

struct results {
    struct row *rows;
    size_t count;
};

static int is_ours(const struct solver *solver)
{
    return strcmp(solver->library, "signorini") == 0;
}

/* Without the flexibility no peer has data. */
static int is_given(const struct solver *solver, const struct problem *problem)
{
    return is_ours(solver) ||
           (problem->flexibility.M != NULL &&
            (solver->most == 0 || problem->contact.pairs <= solver->most));
}

static double best_peer_ms(const struct row *rows, size_t count)
{
    double best = INFINITY;
    for (size_t k = 0; k < count; k++)
        if (!is_ours(rows[k].solver) && rows[k].ms > 0.0 && rows[k].eta <= USABLE_ETA)
            best = fmin(best, rows[k].ms);
    return best;
}

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
        if (solver->family == problem->family && is_given(solver, problem))
            judge(solver, problem, limit, outcome, &rows[count++]);
    }
    for (int turn = 0; turn < TURNS_OF_SHORT_CALLS; turn++) {
        const double best = best_peer_ms(rows, count);
        if (turn >= TURNS && !(best < short_ms))
            break;
        const int all = problem->family != FRICTION_3D && turn < TURNS;
        for (size_t k = 0; k < count; k++)
            if (all || is_ours(rows[k].solver) || rows[k].ms < much_slower * best)
                time_again(problem, limit, outcome, &rows[k]);
        const double lu_ms = problem->lu_ms > 0.0 ? factorisation_ms(&problem->contact) : 0.0;
        for (size_t k = 0; k < count; k++)
            rows[k].lu_ms = fmin(rows[k].lu_ms, lu_ms);
    }
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

/* One body in space under some loads, for every mu. */
static void friction_in_space(size_t side, size_t slenderness, enum geometry first,
                              enum geometry last, double limit, struct outcome *outcome,
                              struct results *results)
{
    static const double mu[] = {0.1, 0.3, 1.0, 3.0};
    struct problem problem = {.family = FRICTION_3D};
    struct contact *contact = &problem.contact;
    struct block *block = block_new(side, slenderness, contact);
    if (block == NULL)
        stop(signorini_last_error());
    if (contact->pairs <= MOST_BESIDE_PEERS &&
        friction_form(contact, &problem.flexibility) != 0)
        stop("the condensed stiffness is not positive definite");
    problem.lu_ms = factorisation_ms(contact);
    /* Who needs more than a hundred factorisations is no rival. */
    limit = fmin(limit, fmax(0.2, 0.1 * problem.lu_ms));
    problem.mu_of = need(contact->pairs, sizeof *problem.mu_of);
    for (problem.geometry = first; problem.geometry <= last; problem.geometry++)
        for (size_t m = 0; m < sizeof mu / sizeof mu[0]; m++) {
            problem.mu = mu[m];
            for (size_t i = 0; i < contact->pairs; i++)
                problem.mu_of[i] = mu[m];
            if (block_load(block, problem.geometry, mu[m], contact) != 0)
                stop(signorini_last_error());
            if (problem.flexibility.M != NULL)
                friction_load(contact, &problem.flexibility);
            run_all(&problem, limit, outcome, results);
        }
    free(problem.mu_of);
    lcp_free(&problem.flexibility);
    contact_free(contact);
    block_free(block);
}

static void all_in_space(size_t side, double limit, struct outcome *outcome,
                         struct results *results)
{
    static const size_t slenderness[] = {10, 20, 40};
    friction_in_space(side, 0, BLOCK_SHIFT, BLOCK_RIM, limit, outcome, results);
    for (size_t k = 0; side == COLUMN_SIDE && k < 3; k++) {
        const enum geometry geometry = (enum geometry)(COLUMN_10 + k);
        friction_in_space(side, slenderness[k], geometry, geometry, limit, outcome, results);
    }
}

/* The families that no solver was tuned for, of about so many pairs. */
static void held_out(size_t dim, size_t pairs, double limit, struct outcome *outcome,
                     struct results *results)
{
    for (size_t k = 0; k < held_count; k++) {
        struct problem problem = {.family = dim == 2 ? FRICTION_2D : FRICTION_3D,
            .geometry = (enum geometry)(HELD_OUT + k), .mu = 0.3};
        struct contact *contact = &problem.contact;
        if (held_dim(k) != dim)
            continue;
        const char *wrong = held_new(k, pairs, problem.mu, contact);
        if (wrong != NULL)
            stop(wrong);
        if (friction_form(contact, &problem.flexibility) != 0)
            stop("the condensed stiffness is not positive definite");
        problem.lu_ms = factorisation_ms(contact);
        problem.mu_of = need(contact->pairs, sizeof *problem.mu_of);
        for (size_t i = 0; i < contact->pairs; i++)
            problem.mu_of[i] = problem.mu;
        run_all(&problem, fmin(limit, fmax(0.2, 0.1 * problem.lu_ms)), outcome, results);
        free(problem.mu_of);
        lcp_free(&problem.flexibility);
        contact_free(contact);
    }
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

struct wanted {
    size_t least, most; /* pairs */
    const char *family;
};

static int is_wanted(const struct wanted *wanted, const char *name, size_t pairs)
{
    return pairs >= wanted->least && pairs <= wanted->most &&
           (strcmp(wanted->family, "all") == 0 || strcmp(wanted->family, name) == 0);
}

/* The command line without OUT. */
static struct wanted wanted_of(char **argv)
{
    const struct wanted wanted = {(size_t)strtoul(argv[1], NULL, 10),
        (size_t)strtoul(argv[2], NULL, 10), argv[4]};
    int known = strcmp(wanted.family, "all") == 0 || strcmp(wanted.family, "held") == 0;
    for (int family = FRICTIONLESS; family <= FRICTION_3D; family++)
        known |= strcmp(wanted.family, family_name((enum family)family)) == 0;
    if (!known)
        stop("FAMILY is frictionless, friction2d, friction3d, held or all");
    return wanted;
}

int main(int argc, char **argv)
{
    static const size_t sizes[] = {33, 129, 513, 1025, 2049}, sides[] = {5, 15, 31, 45};
    if (argc < 5)
        stop("peers LEAST MOST SECONDS FAMILY [OUT]");
    const struct wanted wanted = wanted_of(argv);
    const double limit = strtod(argv[3], NULL);
    const char *threads = getenv("OPENBLAS_NUM_THREADS");
    if (threads == NULL || strcmp(threads, "1") != 0)
        stop("set OPENBLAS_NUM_THREADS=1: thread CPU time sees one thread");
    /* Freed memory stays with the process, as in a host that solves again and again. Otherwise the
     * clock shows how often the system hands out pages, which depends on what lies in memory. */
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    struct results results = {need(4096, sizeof(struct row)), 0};
    struct outcome *outcome = outcome_new(3 * 2049);
    char versions[512];
    snprintf(versions, sizeof versions, "signorini %s, Siconos %s, BLAS of both Siconos and the "
             "preparation: %s.", signorini_version(), SICONOS, blas_name());

    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (int geometry = BAR; geometry <= TWO_BLOCKS; geometry++) {
            if (is_wanted(&wanted, family_name(FRICTIONLESS), sizes[s]))
                frictionless((enum geometry)geometry, sizes[s], limit, outcome, &results);
            if (is_wanted(&wanted, family_name(FRICTION_2D), sizes[s]) && sizes[s] <= 1025)
                friction((enum geometry)geometry, sizes[s], limit, outcome, &results);
            if (argc > 5)
                save(argv[5], &results, versions, limit);
        }

    for (size_t s = 0; s < sizeof sides / sizeof sides[0]; s++) {
        if (is_wanted(&wanted, family_name(FRICTION_3D), sides[s] * sides[s]))
            all_in_space(sides[s], limit, outcome, &results);
        if (argc > 5)
            save(argv[5], &results, versions, limit);
    }

    static const size_t held[] = {64, 196, 529};
    for (size_t s = 0; s < sizeof held / sizeof held[0]; s++)
        for (size_t dim = 2; dim <= 3; dim++) {
            if (is_wanted(&wanted, "held", held[s]))
                held_out(dim, held[s], limit, outcome, &results);
            if (argc > 5)
                save(argv[5], &results, versions, limit);
        }

    write_markdown(stdout, results.rows, results.count, versions, limit);
    free(results.rows);
    return 0;
}
