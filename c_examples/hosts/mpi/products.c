/*
 * A host on several processes that multiplies and solves, and condenses nothing: no process holds
 * more than its part of the matrix and its share of two factors. The library runs on process 0 and
 * asks for products (signorini_model_new_operator). For each question process 0 sends a command,
 * and the others, which wait in a loop, take their part in the answer. block.h has a
 * drawing.
 *
 *     mpirun -n 4 products
 *
 * It solves twice: with products and solutions of the block with the contact free, then with
 * solutions where contact components are held, for which the host factorises again when they
 * change. Process 0 compares with the library alone on the whole matrix; it returns 0 if every
 * check passed.
 */

#include "serial.h"
#include "service.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How often the library asked. */
struct asked {
    struct service *service;
    int products, solutions, factorisations; /* the last: not counting the two of the start */
    int fails_at;                            /* the product that is said to have failed; 0: none */
};

enum { FAILURE = 42 };

/* ---- What the library calls, on process 0. A number other than 0 ends its call. --------------- */

static int32_t stiffness(void *user, const double *x, double *y)
{
    struct asked *asked = user;
    const int32_t status = service_ask(asked->service, PRODUCT, NULL, x, y);
    asked->products += 1;
    return asked->products == asked->fails_at ? FAILURE : status;
}

static int32_t inverse(void *user, const double *x, double *y)
{
    struct asked *asked = user;
    asked->solutions += 1;
    return service_ask(asked->service, SOLUTION, NULL, x, y);
}

static int32_t held_solution(void *user, const int32_t *held, int32_t changed, const double *x,
                             double *y)
{
    struct asked *asked = user;
    if (changed) {
        const int32_t status = service_ask(asked->service, FACTORISE, held, NULL, NULL);
        if (status != 0)
            return status;
        asked->factorisations += 1;
    }
    asked->solutions += 1;
    return service_ask(asked->service, SOLUTION, NULL, x, y);
}

/* ---- Process 0 ----------------------------------------------------------------------------- */

/* signorini_model_new_operator takes so many at most in 3D, as its description says. */
enum { MOST_PRODUCTS = 160, MOST_SOLUTIONS = 70, MOST_CHANGES = 14 };

static void judge_counts(const struct asked *asked, int with_held, struct checks *checks)
{
    judge(checks, with_held ? asked->solutions <= MOST_SOLUTIONS &&
                                  asked->factorisations <= MOST_CHANGES
                            : asked->products <= MOST_PRODUCTS && asked->solutions <= MOST_PRODUCTS);
    printf("asked for %d products, %d solutions, %d further factorisations\n", asked->products,
           asked->solutions, asked->factorisations);
}

static int32_t solve(const signorini_model *model, const double f[SIZE], struct found *found)
{
    static double gap[PAIRS], mu[PAIRS];
    const signorini_settings settings = block_settings();

    block_contact(gap, mu);
    signorini_report_default(&found->report, sizeof found->report);
    return signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings,
                                 found->d, found->F, found->state, NULL, &found->report, NULL);
}

/* A callback that fails ends the call of the library; model and processes can go on. */
static void check_failure(const signorini_model *model, const double f[SIZE], struct asked *asked,
                          struct checks *checks)
{
    static struct found unfinished;
    const struct asked before = *asked;

    asked->fails_at = asked->products + 3; /* in the middle of the load case */
    const int32_t status = solve(model, f, &unfinished);
    judge(checks, status == -1 && strstr(signorini_last_error(), "42") != NULL);
    printf("a product that fails: status %d, %s\n", (int)status, signorini_last_error());
    *asked = before;
}

static void solve_contact(struct service *service, int with_held, struct found *found,
                          struct checks *checks)
{
    static double f[SIZE];
    struct asked asked = {.service = service};
    const signorini_operator K = {.struct_size = sizeof K,
                                  .dim = 3,
                                  .pairs = PAIRS,
                                  .stiffness = stiffness,
                                  .inverse = with_held ? NULL : inverse,
                                  .held = with_held ? held_solution : NULL,
                                  .user = &asked};
    signorini_model *model;

    insist("loads", service_ask(service, LOADS, NULL, NULL, f));
    insist("model", signorini_model_new_operator(&K, &model));
    check_failure(model, f, &asked, checks);
    insist("contact", solve(model, f, found));
    signorini_model_free(model);
    /* The displacements stay where they are found: each process has those of its part. */
    insist("displacements", service_ask(service, DISPLACEMENTS, NULL, found->d, NULL));
    insist("end", service_ask(service, END, NULL, NULL, NULL));
    printf("products, %s: %d processes, %d unknowns, %d pairs; eta %.1e\n",
           with_held ? "components held" : "contact free", service->part->parts, (int)TOTAL,
           (int)PAIRS, found->report.eta);
    judge_counts(&asked, with_held, checks);
}

int main(int argc, char **argv)
{
    static struct found found;
    static struct service service;
    struct checks checks = {0, 0};
    struct part part;
    int rank, parts, result = EXIT_SUCCESS;

    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &parts);
    insist("more processes than cells along x", parts > LONG);
    insist("mesh", part_new(rank, parts, &part));
    insist("MUMPS", service_begin(&service, &part));
    for (int with_held = 0; with_held <= 1; with_held++) {
        if (rank == 0)
            solve_contact(&service, with_held, &found, &checks);
        else
            service_wait(&service);
        compare_with_serial(&part, &found, service.u, &checks);
    }
    service_end(&service);
    if (rank == 0)
        result = conclude(&checks);
    part_free(&part);
    MPI_Finalize();
    return result;
}
