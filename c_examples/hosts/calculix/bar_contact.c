/*
 * CalculiX as the host: contact and friction for the bar on the plane, whose stiffness matrix
 * CalculiX has written.
 *
 *     bar_contact DIR
 *
 * It reads DIR/bar_matrix.sti, DIR/bar_matrix.dof and the loads DIR/bar_loads.inc, has the library
 * reduce the matrix and find contact, and writes the displacements of the contact side as *BOUNDARY
 * to DIR/bar_contact.inc, for a static step of CalculiX. DIR/bar_forces.csv says which total
 * external forces that step should report at each contact node.
 *
 * A deck of your own needs other contact nodes, normals, gaps and coefficients: all else stays.
 */

#include "../../bar/bar_check.h"
#include "matrix_files.h"
#include "signorini.h"

#include <stdio.h>
#include <stdlib.h>

/* The contact side: nodes 1 to 33, in this order. Rows (x, y) of each of them. */
static int64_t contact[BAR_SIZE];

static FILE *open_in(const char *directory, const char *name, const char *mode)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s", directory, name);
    return length > 0 && (size_t)length < sizeof path ? fopen(path, mode) : NULL;
}

static const char *read_matrix(struct matrix_files *matrix, const char *directory)
{
    char job[4096];
    const int length = snprintf(job, sizeof job, "%s/bar_matrix", directory);
    const char *problem;

    if (length < 0 || (size_t)length >= sizeof job)
        return "the name of the directory is too long";
    problem = matrix_read(matrix, job, BAR_SIZE);
    if (problem != NULL)
        return problem;
    /* CalculiX's matrix lacks the component that the deck holds, u_x of node 33. A pair has all its
     * components: this one comes back as a row that is held. */
    for (int i = 0; i < BAR_SIZE; i++) {
        const long node = i / 2 + 1;
        const int direction = i % 2 + 1;
        contact[i] = matrix_row(matrix, node, direction);
        if (contact[i] < 0)
            contact[i] = matrix_add_held(matrix, node, direction);
    }
    return NULL;
}

/* The lines node,direction,value of *CLOAD. CalculiX does not write loads with its matrix. */
static const char *read_loads(const struct matrix_files *matrix, const char *directory,
                              double *load)
{
    FILE *const file = open_in(directory, "bar_loads.inc", "r");
    const char *problem = NULL;
    long node;
    int direction;
    double value;

    if (file == NULL)
        return "cannot open bar_loads.inc";
    while (fscanf(file, "%ld,%d,%lf", &node, &direction, &value) == 3) {
        const int64_t row = matrix_row(matrix, node, direction);
        if (row >= 0)
            load[row] += value;
    }
    if (!feof(file))
        problem = "bar_loads.inc has a line that is not node,direction,value";
    fclose(file);
    return problem;
}

/* d and F of the pairs, and the contact forces on every row. Returns NULL, or what went wrong. */
static const char *solve(const struct matrix_files *matrix, const double *load,
                         struct solution *solution, double *nodal)
{
    static char problem[512];
    int64_t held[BAR_SIZE];
    double gap[BAR_PAIRS], mu[BAR_PAIRS], normal[BAR_SIZE];
    signorini_model *model = NULL;
    signorini_settings settings;
    const signorini_sparse view = matrix_view(matrix);
    const signorini_pairs pairs = {.struct_size = sizeof pairs,
                                   .dim = 2,
                                   .count = BAR_PAIRS,
                                   .slaves = contact,
                                   .normals = normal}; /* no masters: the plane is rigid */
    int64_t fixed = 0;
    int32_t status;

    for (int64_t row = matrix->written; row < view.size; row++)
        held[fixed++] = row;
    for (size_t i = 0; i < BAR_PAIRS; i++) {
        gap[i] = 0.0;
        mu[i] = 1.0;
        normal[2 * i] = 0.0;
        normal[2 * i + 1] = -1.0;
    }
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-12;

    status = signorini_model_new_sparse(&view, fixed, held, &pairs, NULL, &model);
    if (status == SIGNORINI_STATUS_SOLVED)
        status = signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                       &settings, solution->d, solution->F, solution->state, NULL,
                                       NULL, NULL);
    if (status == SIGNORINI_STATUS_SOLVED)
        status = signorini_model_nodal_forces(model, solution->F, nodal);
    /* Before signorini_model_free: each call of the library has a sentence of its own. */
    snprintf(problem, sizeof problem, "%s", signorini_last_error());
    signorini_model_free(model);
    return status == SIGNORINI_STATUS_SOLVED ? NULL : problem;
}

/* n = (0, -1) and, turned by +90 degrees, t = (1, 0): u_x = d_t, u_y = -d_n. What is held keeps its
 * own *BOUNDARY. */
static const char *write_results(const struct matrix_files *matrix, const char *directory,
                                 const double *load, const struct solution *solution,
                                 const double *nodal)
{
    FILE *const boundary = open_in(directory, "bar_contact.inc", "w");
    FILE *const forces = open_in(directory, "bar_forces.csv", "w");
    const char *problem = NULL;

    if (boundary == NULL || forces == NULL) {
        problem = "cannot write bar_contact.inc and bar_forces.csv";
    } else {
        fputs("*BOUNDARY\n", boundary);
        fputs("node,direction,external force\n", forces);
        for (int i = 0; i < BAR_SIZE; i++) {
            const int node = i / 2 + 1, direction = i % 2 + 1;
            const double u = i % 2 == 0 ? solution->d[i + 1] : -solution->d[i - 1];
            if (contact[i] >= matrix->written)
                continue;
            /* 20 characters are what CalculiX reads: not one digit more. */
            fprintf(boundary, "%d,%d,%d,%.12e\n", node, direction, direction, u + 0.0);
            /* CalculiX's RF is the total external force: reaction and load. */
            fprintf(forces, "%d,%d,%.15g\n", node, direction,
                    nodal[contact[i]] + load[contact[i]]);
        }
    }
    if (boundary != NULL && fclose(boundary) != 0)
        problem = "cannot write bar_contact.inc";
    if (forces != NULL && fclose(forces) != 0)
        problem = "cannot write bar_forces.csv";
    return problem;
}

int main(int argc, char **argv)
{
    struct checks checks = {0, 0};
    struct matrix_files matrix;
    struct solution solution;
    double *load = NULL, *nodal = NULL;

    if (argc != 2) {
        fprintf(stderr, "usage: %s DIR\n", argv[0]);
        return EXIT_FAILURE;
    }
    const char *problem = read_matrix(&matrix, argv[1]);
    if (problem == NULL) {
        load = calloc(matrix.size, sizeof *load);
        nodal = calloc(matrix.size, sizeof *nodal);
        if (load == NULL || nodal == NULL)
            problem = "not enough memory";
    }
    if (problem == NULL)
        problem = read_loads(&matrix, argv[1], load);
    if (problem == NULL)
        problem = solve(&matrix, load, &solution, nodal);
    if (problem == NULL)
        problem = write_results(&matrix, argv[1], load, &solution, nodal);

    judge(&checks, problem == NULL);
    printf("contact on CalculiX's matrix of %lld rows: %s\n", (long long)matrix.written,
           problem == NULL ? "solved" : problem);
    if (problem == NULL) {
        check_zones(&checks, &solution, 3, 15);
        check_reference(&checks, &solution);
    }
    free(load);
    free(nodal);
    matrix_release(&matrix);
    return conclude(&checks);
}
