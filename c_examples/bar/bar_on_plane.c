/*
 * The bar on the plane: Table 1 of F. Lebon, M. Raous, D. Boulegues, "Contact with friction
 * modeling for the study of a bolted junction", computed again.
 *
 * This is a host program of the kind that the library is for. It meshes and assembles the bar,
 * condenses it on its contact side (bar_mesh.c) and has the library find contact and friction:
 * `solve` below is all that it takes, or `solve_sparse` to leave condensation to the library. The
 * rest shows the results and checks them against what is known about them (bar_check.c).
 *
 *     bar_on_plane [DIR]      with DIR, it also writes DIR/bar_on_plane.csv
 *
 * On a terminal a line tells how far a call is; Ctrl-C ends the program after the file that it is
 * writing, with the status 130 (watch.c). Otherwise it returns 0 if every check passed.
 */

#include "bar_check.h"
#include "bar_mesh.h"
#include "signorini.h"
#include "../common/watch.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The name of the steps that a method counts. */
static const char *steps_of(int32_t method)
{
    switch (method) {
    case SIGNORINI_METHOD_SOR_NESTED:
    case SIGNORINI_METHOD_SOR_DIAGONAL:
        return "sweeps";
    case SIGNORINI_METHOD_LEMKE:
        return "pivots";
    default:
        return "linear systems";
    }
}

static int solve(struct checks *checks, const char *name, int32_t method,
                 const struct condensed_bar *bar, double friction, struct solution *solution)
{
    double gap[BAR_PAIRS], mu[BAR_PAIRS];
    struct signorini_settings settings;
    struct signorini_report report;
    int32_t status;

    for (size_t i = 0; i < BAR_PAIRS; i++) {
        gap[i] = 0.0;
        mu[i] = friction;
    }
    signorini_settings_default(&settings, sizeof settings);
    settings.method = method;
    settings.tolerance = 1e-13; /* far below the 1e-9 that the checks ask for */
    watch_calls(&settings);
    report.struct_size = sizeof report;

    status = signorini_solve(2, BAR_PAIRS, bar->K, BAR_SIZE, bar->f, gap, SIGNORINI_LAW_COULOMB, mu,
                             NULL, &settings, solution->d, solution->F, solution->state, &report,
                             NULL);
    watch_erase();
    if (watch_interrupted())
        return 0;

    judge(checks, status == SIGNORINI_STATUS_SOLVED);
    printf("%s: %s", name, signorini_status_string(status));
    if (status == SIGNORINI_STATUS_SOLVED)
        printf(" in %lld %s, eta = %.0e\n", (long long)report.iterations,
               steps_of(report.method), report.eta);
    else
        printf(": %s\n", signorini_last_error());
    for (int32_t remark = 1; status >= 0 && remark <= report.remarks; remark *= 2)
        if (report.remarks & remark)
            printf("    remark: %s\n", signorini_remark_string(remark));
    return status == SIGNORINI_STATUS_SOLVED;
}

static int condense(struct checks *checks, const struct bar *bar, struct condensed_bar *condensed)
{
    const char *problem = bar_condense(bar, condensed);
    if (problem != NULL) {
        judge(checks, 0);
        printf("condensing the bar: %s\n", problem);
    }
    return problem == NULL;
}

static void save(struct checks *checks, const char *directory, const struct bar *bar,
                 const struct solution *solution)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/bar_on_plane.csv", directory);
    const int fits = length > 0 && (size_t)length < sizeof path;
    const int written = fits && write_csv(path, bar, solution) == 0;

    judge(checks, written);
    if (written)
        printf("wrote %s\n", path);
    else
        printf("cannot write %s: %s\n", path, fits ? strerror(errno) : "the name is too long");
}

/* Friction coefficient 1: by the default method, Lemke's, and both forms of the paper's. */
static void table1(struct checks *checks, const struct condensed_bar *condensed,
                   const struct bar *bar, const char *directory)
{
    static const struct {
        const char *name;
        int32_t method;
    } others[] = {{"Lemke", SIGNORINI_METHOD_LEMKE},
                  {"nested SOR", SIGNORINI_METHOD_SOR_NESTED},
                  {"diagonal SOR", SIGNORINI_METHOD_SOR_DIAGONAL}};
    struct solution solution;

    puts("Table 1: mu = 1, 32 x 5 elements");
    if (solve(checks, "default method", SIGNORINI_METHOD_AUTO, condensed, 1.0, &solution)) {
        print_table1(&solution);
        check_zones(checks, &solution, 3, 15);
        check_reference(checks, &solution);
        check_table1(checks, &solution);
        if (directory != NULL)
            save(checks, directory, bar, &solution);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (solve(checks, others[i].name, others[i].method, condensed, 1.0, &solution)) {
            check_zones(checks, &solution, 3, 15);
            check_reference(checks, &solution);
        }
    }
}

static void frictionless(struct checks *checks, const struct condensed_bar *condensed,
                         const struct bar *bar)
{
    struct solution solution;

    puts("\nThe same bar without friction, mu = 0");
    /* Nothing opens. All closed is where Lemke's method starts, so that it needs no pivot here. */
    if (solve(checks, "Lemke", SIGNORINI_METHOD_LEMKE, condensed, 0.0, &solution)) {
        check_zones(checks, &solution, 0, BAR_PAIRS);
        check_frictionless(checks, bar, &solution);
    }
    if (solve(checks, "default method", SIGNORINI_METHOD_AUTO, condensed, 0.0, &solution)) {
        check_zones(checks, &solution, 0, BAR_PAIRS);
        check_frictionless(checks, bar, &solution);
    }
    if (solve(checks, "SOR", SIGNORINI_METHOD_SOR_NESTED, condensed, 0.0, &solution)) {
        check_zones(checks, &solution, 0, BAR_PAIRS);
        check_frictionless(checks, bar, &solution);
    }
}

/* The whole sparse matrix instead of a condensed one: the library condenses, once, and tells the
 * displacements of the whole mesh. Returns NULL, or what went wrong. */
static const char *solve_sparse(const struct sparse_bar *bar, struct solution *solution, double *u)
{
    static char problem[512];
    double gap[BAR_PAIRS], mu[BAR_PAIRS], normal[BAR_SIZE];
    signorini_model *model = NULL;
    signorini_sparse matrix = {.struct_size = sizeof matrix,
                               .index_bytes = 8,
                               .index_base = 0,
                               .triangle = SIGNORINI_TRIANGLE_LOWER,
                               .size = (int64_t)bar->size,
                               .nnz = (int64_t)bar->entries,
                               .col_start = bar->starts,
                               .row = bar->rows,
                               .values = bar->values};
    signorini_pairs pairs = {.struct_size = sizeof pairs,
                             .dim = 2,
                             .count = BAR_PAIRS,
                             .slaves = bar->contact,
                             .normals = normal}; /* no masters: the plane is rigid */
    signorini_settings settings;
    int32_t status;

    for (size_t i = 0; i < BAR_PAIRS; i++) {
        gap[i] = 0.0;
        mu[i] = 1.0;
        normal[2 * i] = 0.0;
        normal[2 * i + 1] = -1.0;
    }
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-13;

    status =
        signorini_model_new_sparse(&matrix, (int64_t)bar->held_count, bar->held, &pairs, NULL, &model);
    if (status == 0)
        status = signorini_model_solve(model, 1, bar->load, NULL, gap, SIGNORINI_LAW_COULOMB, mu,
                                       NULL, &settings, solution->d, solution->F, solution->state,
                                       NULL, NULL, NULL);
    if (status == 0)
        status = signorini_model_recover(model, 1, bar->load, NULL, solution->d, u);
    /* Before signorini_model_free: each call of the library has a sentence of its own. */
    snprintf(problem, sizeof problem, "%s", signorini_last_error());
    signorini_model_free(model);
    return status == SIGNORINI_STATUS_SOLVED ? NULL : problem;
}

static void whole_matrix(struct checks *checks, const struct bar *bar)
{
    struct sparse_bar sparse;
    struct solution solution;
    const char *problem = bar_assemble(bar, &sparse);
    double *u = malloc((sparse.size + 1) * sizeof *u);
    double difference = 0.0;

    puts("\nThe same bar, mu = 1, handed over as a whole sparse matrix");
    if (problem == NULL && u == NULL)
        problem = "not enough memory";
    if (problem == NULL)
        problem = solve_sparse(&sparse, &solution, u);
    judge(checks, problem == NULL);
    printf("model of %zu components: %s\n", sparse.size, problem == NULL ? "solved" : problem);
    if (problem == NULL) {
        check_zones(checks, &solution, 3, 15);
        check_reference(checks, &solution);
        for (size_t i = 0; i < BAR_PAIRS; i++) {
            difference = fmax(difference, fabs(u[sparse.contact[2 * i]] - solution.d[2 * i + 1]));
            difference = fmax(difference, fabs(u[sparse.contact[2 * i + 1]] + solution.d[2 * i]));
        }
        judge(checks, difference <= 1e-15); /* of 1e-2: they are the same numbers */
        puts("displacements of the whole mesh: (u_x, u_y) = (d_t, -d_n) on the contact side");
    }
    free(u);
    bar_release(&sparse);
}

static void aster(struct checks *checks, const struct condensed_bar *condensed)
{
    struct solution solution;

    puts("\ncode_aster's test SSNV128: mu = 1, 15 daN/mm2 on the side, 32 x 10 equal elements");
    if (solve(checks, "nested SOR", SIGNORINI_METHOD_SOR_NESTED, condensed, 1.0, &solution)) {
        check_zones(checks, &solution, 3, 22);
        check_ssnv128(checks, &solution);
    }
}

int main(int argc, char **argv)
{
    /* The bar of the paper, on the simplest mesh that comes close to its Table 1. */
    struct bar bar = {.width = 40.0,
                      .height = 40.0,
                      .young = 13000.0,
                      .poisson = 0.2,
                      .top_pressure = 5.0,
                      .side_pressure = 10.0,
                      .rows = 5,
                      .ratio = 1.7};
    struct checks checks = {0, 0};
    struct condensed_bar condensed;

    if (argc > 2) {
        fprintf(stderr, "usage: %s [DIR]\n", argv[0]);
        return EXIT_FAILURE;
    }
    printf("signorini %s\n\n", signorini_version());
    watch_begin();

    if (condense(&checks, &bar, &condensed)) {
        table1(&checks, &condensed, &bar, argc == 2 ? argv[1] : NULL);
        if (!watch_interrupted())
            frictionless(&checks, &condensed, &bar);
    }
    if (!watch_interrupted())
        whole_matrix(&checks, &bar);

    bar.side_pressure = 15.0;
    bar.rows = 10;
    bar.ratio = 1.0;
    if (!watch_interrupted() && condense(&checks, &bar, &condensed))
        aster(&checks, &condensed);

    return watch_interrupted() ? watch_end() : conclude(&checks);
}
