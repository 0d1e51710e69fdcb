/*
 * A bolted junction: closed by a pressing ring, then put under inner pressure, and relieved of it,
 * after section 4.2 of F. Lebon, M. Raous, D. Boulegues, "Contact with friction modeling for the
 * study of a bolted junction". The paper gives no dimensions: those of junction_mesh.h are ours.
 *
 * This is a host program of the kind that the library is for. It meshes and assembles three parts,
 * of which nothing but contact holds two, into one sparse matrix (junction_mesh.c). The library
 * makes a model of it (`new_model`) and then solves each load step for five friction coefficients
 * at once (`run`): friction remembers the slip of the step before. `check_host` gets the
 * displacements of all nodes back. The rest shows the results (junction_output.c) and checks them
 * (junction_check.c).
 *
 *     bolted_junction [DIR]
 *
 * With DIR, it also writes
 *     DIR/bolted_junction.csv          all pairs in all steps, for every friction coefficient; mm,
 *                                      and N over the whole circumference
 *     DIR/junction_mu0.3_STEP.vtk      for mu = 0.3 and each step (closing, p10, p20, p30, p40,
 *                                      p0): mesh, displacements (mm), axial stress (MPa) at the
 *                                      nodes, sigma_zz, and of the elements, and the number
 *                                      of the part, for ParaView or alike
 *
 * On a terminal a line tells how far a call is; Ctrl-C ends the program after the file that it is
 * writing, with the status 130 (watch.c). Otherwise it returns 0 if every check passed.
 */

#include "junction_check.h"
#include "signorini.h"
#include "../common/watch.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double closing_pressure = 60.0;                                      /* MPa */
static const double ring_area = 3.14159265358979323846 * (100.0 * 100.0 - 80.0 * 80.0); /* mm2 */

static double now(void)
{
#ifdef TIME_UTC
    struct timespec time;
    timespec_get(&time, TIME_UTC);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
#else
    /* An older library of Windows, where this is the time on the wall. */
    return (double)clock() / CLOCKS_PER_SEC;
#endif
}

/* The slave of each pair is the node of the lower part; its outward normal points upwards, and
 * the tangent outwards. Nodes match, so that each slave has one master. */
static int32_t new_model(const struct junction *junction, struct signorini_model **model)
{
    int64_t slaves[2 * PAIRS], masters[2 * PAIRS], master_starts[PAIRS + 1];
    double weights[PAIRS], normals[2 * PAIRS], tangents[2 * PAIRS];
    const struct signorini_sparse K = {.struct_size = sizeof K,
                                       .index_bytes = 4,
                                       .index_base = 0,
                                       .triangle = SIGNORINI_TRIANGLE_FULL,
                                       .size = DOFS,
                                       .nnz = junction->starts[DOFS],
                                       .col_start = junction->starts,
                                       .row = junction->rows,
                                       .values = junction->values};
    const struct signorini_pairs pairs = {.struct_size = sizeof pairs,
                                          .dim = 2,
                                          .count = PAIRS,
                                          .slaves = slaves,
                                          .master_start = master_starts,
                                          .masters = masters,
                                          .weights = weights,
                                          .normals = normals,
                                          .tangents = tangents};

    for (int i = 0; i < PAIRS; i++) {
        for (int axis = 0; axis < 2; axis++) {
            slaves[2 * i + axis] = 2 * junction->lower[i] + axis;
            masters[2 * i + axis] = 2 * junction->upper[i] + axis;
            normals[2 * i + axis] = axis == 1;
            tangents[2 * i + axis] = axis == 0;
        }
        master_starts[i] = i;
        weights[i] = 1.0;
    }
    master_starts[PAIRS] = PAIRS;
    return signorini_model_new_sparse(&K, FIXED, junction->fixed, &pairs, NULL, model);
}

/* All steps, for all friction coefficients of the history side by side. */
static int run(struct checks *checks, const struct junction *junction,
               const struct signorini_model *model, int32_t method, struct history *history)
{
    static double f[MOST_CASES][DOFS];
    double gap[MOST_CASES][PAIRS], mu[MOST_CASES][PAIRS], slip[MOST_CASES][PAIRS];
    struct signorini_settings settings;
    struct signorini_report report[MOST_CASES];

    signorini_settings_default(&settings, sizeof settings);
    settings.method = method;
    settings.tolerance = 1e-13; /* far below the 1e-9 that the checks ask for */
    settings.proof = 1; /* that solutions with these states exist */
    watch_calls(&settings);

    for (size_t i = 0; i < history->cases; i++) {
        report[i].struct_size = sizeof report[i];
        for (size_t pair = 0; pair < PAIRS; pair++) {
            gap[i][pair] = 0.0;
            mu[i][pair] = history->mu[i];
            slip[i][pair] = 0.0;
        }
    }
    for (size_t s = 0; s < STEPS; s++) {
        const double begin = now();
        int64_t iterations = 0;
        int32_t status;
        int proved = 1;

        for (size_t i = 0; i < history->cases; i++)
            junction_loads(junction, closing_pressure, steps[s].inner, f[i]);

        status = signorini_model_solve(model, (int64_t)history->cases, f[0], NULL, gap[0],
                                       SIGNORINI_LAW_COULOMB, mu[0], slip[0], &settings,
                                       history->d[s][0], history->F[s][0], history->state[s][0],
                                       NULL, report, NULL);
        watch_erase();
        if (watch_interrupted())
            return 0;

        for (size_t i = 0; i < history->cases; i++)
            proved = proved && report[i].proof == SIGNORINI_PROOF_PROVED;
        judge(checks, status == SIGNORINI_STATUS_SOLVED && proved);
        if (status != SIGNORINI_STATUS_SOLVED) {
            printf("%-8s %s: %s\n", steps[s].name, signorini_status_string(status),
                   signorini_last_error());
            return 0;
        }
        printf("%-8s %s in", steps[s].name, proved ? "solved, proved," : "solved, not proved,");
        for (size_t i = 0; i < history->cases; i++) {
            printf(" %lld", (long long)report[i].iterations);
            iterations += report[i].iterations;
            for (size_t pair = 0; pair < PAIRS; pair++)
                slip[i][pair] = history->d[s][i][2 * pair + 1];
        }
        printf(" %s, %.1f ms\n",
               method == SIGNORINI_METHOD_AUTO    ? "linear systems"
               : method == SIGNORINI_METHOD_LEMKE ? "pivots"
                                                  : "sweeps",
               1e3 * (now() - begin));
    }
    return 1;
}

/* With the displacements of all nodes and the contact forces on them, the host's own equations
 * hold and the pairs have the relative displacements that the library found. */
static void check_host(struct checks *checks, const struct junction *junction,
                       const struct signorini_model *model, const struct history *history,
                       size_t drawn)
{
    static double f[DOFS], u[DOFS], contact[DOFS];
    double unbalanced = 0.0, mismatch = 0.0, largest_load = 0.0, largest_motion = 0.0;
    int computed = 1;

    for (size_t s = 0; s < STEPS; s++) {
        for (size_t i = 0; i < history->cases; i++) {
            const double *d = history->d[s][i];
            junction_loads(junction, closing_pressure, steps[s].inner, f);
            computed = computed && signorini_model_recover(model, 1, f, NULL, d, u) == 0 &&
                       signorini_model_nodal_forces(model, history->F[s][i], contact) == 0;
            for (size_t k = 0; k < DOFS; k++) {
                largest_load = fmax(largest_load, fabs(f[k]));
                f[k] += contact[k];
            }
            if (s == 0 && i == drawn)
                check_stress(checks, junction, u);
            unbalanced = fmax(unbalanced, junction_residual(junction, u, f));
            for (size_t pair = 0; pair < PAIRS; pair++) {
                const int32_t lower = 2 * junction->lower[pair], upper = 2 * junction->upper[pair];
                mismatch = fmax(mismatch, fabs(u[lower + 1] - u[upper + 1] - d[2 * pair]));
                mismatch = fmax(mismatch, fabs(u[lower] - u[upper] - d[2 * pair + 1]));
                largest_motion = fmax(largest_motion, fabs(d[2 * pair]));
            }
        }
    }
    judge(checks, computed && unbalanced <= 1e-9 * largest_load);
    printf("K u = f + contact forces at all nodes: off by %.0e of the largest load\n",
           unbalanced / largest_load);
    judge(checks, computed && mismatch <= 1e-9 * largest_motion);
    printf("u of the nodes fits d of the pairs: off by %.0e of the largest opening\n",
           mismatch / largest_motion);
}

/* DIR/name; NULL if it is too long. */
static const char *path_to(const char *directory, const char *name, char path[4096])
{
    const int length = snprintf(path, 4096, "%s/%s", directory, name);
    return length > 0 && length < 4096 ? path : NULL;
}

static void report_file(struct checks *checks, const char *path, int written)
{
    judge(checks, written);
    if (written)
        printf("wrote %s\n", path);
    else
        printf("cannot write %s: %s\n", path != NULL ? path : "a file",
               path != NULL ? strerror(errno) : "its name is too long");
}

static void save(struct checks *checks, const char *directory, const struct junction *junction,
                 const struct signorini_model *model, const struct history *history, size_t drawn)
{
    static double f[DOFS], u[DOFS];
    char buffer[4096];
    const char *path = path_to(directory, "bolted_junction.csv", buffer);

    report_file(checks, path,
                path != NULL && write_junction_csv(path, junction, history) == 0);
    for (size_t s = 0; s < STEPS && !watch_interrupted(); s++) {
        char name[64], title[128];
        snprintf(name, sizeof name, "junction_mu%.1f_%s.vtk", history->mu[drawn], steps[s].name);
        snprintf(title, sizeof title, "bolted junction, mu = %.1f, step %s; mm, MPa",
                 history->mu[drawn], steps[s].name);
        junction_loads(junction, closing_pressure, steps[s].inner, f);
        path = path_to(directory, name, buffer);
        report_file(checks, path,
                    path != NULL &&
                        signorini_model_recover(model, 1, f, NULL, history->d[s][drawn], u) == 0 &&
                        write_junction_vtk(path, title, junction, u) == 0);
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Prints the cost of a load case once the model exists: medians, with default settings. Not a
 * check, as machines are noisy. */
static void report_cost(const struct junction *junction)
{
    enum { RUNS = 11 };
    static double f[2][DOFS];
    double gap[PAIRS] = {0}, slip[PAIRS] = {0}, mu[PAIRS], d[SIZE], F[SIZE];
    double first[RUNS], further[RUNS];

    for (int pair = 0; pair < PAIRS; pair++)
        mu[pair] = 0.3;
    for (int step = 0; step < 2; step++)
        junction_loads(junction, closing_pressure, steps[step].inner, f[step]);
    for (int run = 0; run < RUNS; run++) {
        struct signorini_model *model = NULL;
        double begin = now();
        if (new_model(junction, &model) != 0)
            return;
        signorini_model_solve(model, 1, f[0], NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d,
                              F, NULL, NULL, NULL, NULL);
        first[run] = now() - begin;
        for (int pair = 0; pair < PAIRS; pair++)
            slip[pair] = d[2 * pair + 1];
        begin = now();
        signorini_model_solve(model, 1, f[1], NULL, gap, SIGNORINI_LAW_COULOMB, mu, slip, NULL, d,
                              F, NULL, NULL, NULL, NULL);
        further[run] = now() - begin;
        signorini_model_free(model);
    }
    qsort(first, RUNS, sizeof *first, ascending);
    qsort(further, RUNS, sizeof *further, ascending);
    printf("\nReduction and first load case: %.2f ms; a further one: %.2f ms, %.1f %% of it\n",
           1e3 * first[RUNS / 2], 1e3 * further[RUNS / 2],
           100.0 * further[RUNS / 2] / first[RUNS / 2]);
}

int main(int argc, char **argv)
{
    static struct history found = {.cases = 5, .mu = {0.0, 0.1, 0.2, 0.3, 0.5}};
    static struct history nested = {.cases = 5, .mu = {0.0, 0.1, 0.2, 0.3, 0.5}};
    static struct history lemke = {.cases = 5, .mu = {0.0, 0.1, 0.2, 0.3, 0.5}};
    static struct history diagonal = {.cases = 1, .mu = {0.3}};
    const size_t drawn = 3; /* mu = 0.3 */
    struct checks checks = {0, 0};
    struct junction *junction;
    struct signorini_model *model = NULL;
    double begin;
    int32_t status;

    if (argc > 2) {
        fprintf(stderr, "usage: %s [DIR]\n", argv[0]);
        return EXIT_FAILURE;
    }
    printf("signorini %s\n\n", signorini_version());
    watch_begin();

    junction = junction_new();
    if (junction == NULL) {
        fputs("not enough memory for the mesh\n", stderr);
        return EXIT_FAILURE;
    }
    begin = now();
    status = new_model(junction, &model);
    judge(&checks, status == 0);
    if (status != 0) {
        printf("model: %s: %s\n", signorini_status_string(status), signorini_last_error());
        goto done;
    }
    printf("%d nodes, %d elements, %d pairs: reduced in %.0f ms\n", NODES, ELEMENTS, PAIRS,
           1e3 * (now() - begin));

    puts("\nDefault method, mu = 0, 0.1, 0.2, 0.3, 0.5");
    if (!run(&checks, junction, model, SIGNORINI_METHOD_AUTO, &found))
        goto done;
    print_history(junction, &found);
    check_balance(&checks, junction, &found, closing_pressure * ring_area);
    check_prototype(&checks, junction, &found);
    check_unloading(&checks, &found);
    check_host(&checks, junction, model, &found, drawn);
    if (argc == 2)
        save(&checks, argv[1], junction, model, &found, drawn);
    if (watch_interrupted())
        goto done;

    puts("\nNested SOR, all coefficients");
    if (run(&checks, junction, model, SIGNORINI_METHOD_SOR_NESTED, &nested))
        for (size_t i = 0; i < nested.cases; i++)
            check_same(&checks, "as the default", &found, i, &nested, i);
    puts("\nLemke's method, all coefficients");
    if (run(&checks, junction, model, SIGNORINI_METHOD_LEMKE, &lemke))
        for (size_t i = 0; i < lemke.cases; i++)
            check_same(&checks, "as the default", &found, i, &lemke, i);
    puts("\nDiagonal SOR, mu = 0.3");
    if (run(&checks, junction, model, SIGNORINI_METHOD_SOR_DIAGONAL, &diagonal))
        check_same(&checks, "as the default", &found, drawn, &diagonal, 0);
    report_cost(junction);
done:
    signorini_model_free(model);
    free(junction);
    return watch_interrupted() ? watch_end() : conclude(&checks);
}
