#include "peers_mesh.h"

#include <math.h>
#include "../c/everything.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One rectangle of four-node elements in plane strain. Rows of nodes count from the contact side,
 * which is the lower one, or of a body below the upper one. */
struct body {
    size_t first; /* number of its first degree of freedom */
    int below;
    double young;
};

struct mesh {
    size_t columns; /* of nodes */
    size_t rows;    /* of elements */
    double ratio;   /* of heights, from row to row away from the contact */
    double *heights;
    size_t bodies;
    struct body body[2];
    size_t size;
    int64_t *starts; /* the assembled matrix, both triangles */
    int64_t *rows_of;
    double *values;
    double *load;
    size_t held;
    int64_t *held_dofs;
    double *prescribed;
};

static const double width = 40.0, height = 40.0, poisson = 0.2;
static const double side_pressure = 10.0;
static const double approach = 0.0154; /* of the upper side: about the pressure 5 of the paper */
static const double shift = 0.01;     /* of the upper block, sideways */

void *need(size_t count, size_t size)
{
    void *memory = calloc(count > 0 ? count : 1, size);
    if (memory == NULL) {
        fprintf(stderr, "peers: not enough memory for %zu x %zu bytes\n", count, size);
        exit(1);
    }
    return memory;
}

/* Heights that grow from twice the width of a column: fine meshes stay fine where it matters. */
static void choose_heights(struct mesh *mesh)
{
    const double first = 2.0 * width / (double)(mesh->columns - 1);
    double low = 1.0, high = 4.0;
    for (int step = 0; step < 60; step++) {
        const double middle = 0.5 * (low + high);
        double sum = 0.0;
        for (size_t i = 0; i < mesh->rows; i++)
            sum += first * pow(middle, (double)i);
        *(sum < height ? &low : &high) = middle;
    }
    mesh->ratio = low;
    double sum = 0.0;
    for (size_t i = 0; i < mesh->rows; i++)
        sum += pow(low, (double)i);
    for (size_t i = 0; i < mesh->rows; i++)
        mesh->heights[i] = height * pow(low, (double)i) / sum;
}

static size_t dof(const struct mesh *mesh, const struct body *body, size_t column, size_t row,
                  int axis)
{
    return body->first + 2 * (row * mesh->columns + column) + (size_t)axis;
}

/* Every node meets its neighbours in the square around it, so the place of an entry is known. */
static size_t place(const struct mesh *mesh, const size_t node[2], int axis, const size_t other[2],
                    size_t column_dof)
{
    const size_t left = node[0] > 0, right = node[0] + 1 < mesh->columns;
    const size_t before = node[1] > 0;
    const size_t across = other[0] + left - node[0], along = other[1] + before - node[1];
    const size_t nodes = along * (left + 1 + right) + across;
    return (size_t)mesh->starts[column_dof] + 2 * nodes + (size_t)axis;
}

/* The rows of one column: all components of the nodes around its own. */
static size_t pattern_of(const struct mesh *mesh, const struct body *body, size_t column,
                         size_t row, size_t used)
{
    for (size_t r = row - (row > 0); r <= row + 1 && r <= mesh->rows; r++)
        for (size_t c = column - (column > 0); c <= column + 1 && c < mesh->columns; c++)
            for (int axis = 0; axis < 2; axis++)
                mesh->rows_of[used++] = (int64_t)dof(mesh, body, c, r, axis);
    return used;
}

static void pattern(struct mesh *mesh)
{
    const size_t nodes_up = mesh->rows + 1;
    mesh->size = mesh->bodies * 2 * mesh->columns * nodes_up;
    mesh->starts = need(mesh->size + 1, sizeof *mesh->starts);
    mesh->rows_of = need(18 * mesh->size, sizeof *mesh->rows_of);
    mesh->values = need(18 * mesh->size, sizeof *mesh->values);
    size_t used = 0;
    for (size_t b = 0; b < mesh->bodies; b++)
        for (size_t row = 0; row < nodes_up; row++)
            for (size_t column = 0; column < mesh->columns; column++)
                for (int axis = 0; axis < 2; axis++) {
                    mesh->starts[dof(mesh, &mesh->body[b], column, row, axis)] = (int64_t)used;
                    used = pattern_of(mesh, &mesh->body[b], column, row, used);
                }
    mesh->starts[mesh->size] = (int64_t)used;
}

/* Stiffness of a rectangle; nodes anticlockwise from the lower left. */
static void element(double young, double w, double h, double k[8][8])
{
    static const double corner_x[4] = {-1, 1, 1, -1}, corner_y[4] = {-1, -1, 1, 1};
    const double gauss = 1.0 / sqrt(3.0);
    const double shear = young / (2.0 * (1.0 + poisson));
    const double axial = 2.0 * shear * (1.0 - poisson) / (1.0 - 2.0 * poisson);
    const double cross = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    const double weight = w * h / 4.0;

    memset(k, 0, 64 * sizeof(double));
    for (int point = 0; point < 4; point++) {
        double dx[4], dy[4]; /* derivatives of the shape functions */
        for (int a = 0; a < 4; a++) {
            dx[a] = corner_x[a] * (1.0 + corner_y[a] * gauss * corner_y[point]) / (2.0 * w);
            dy[a] = corner_y[a] * (1.0 + corner_x[a] * gauss * corner_x[point]) / (2.0 * h);
        }
        for (int a = 0; a < 4; a++)
            for (int b = 0; b < 4; b++) {
                k[2 * a][2 * b] += weight * (axial * dx[a] * dx[b] + shear * dy[a] * dy[b]);
                k[2 * a][2 * b + 1] += weight * (cross * dx[a] * dy[b] + shear * dy[a] * dx[b]);
                k[2 * a + 1][2 * b] += weight * (cross * dy[a] * dx[b] + shear * dx[a] * dy[b]);
                k[2 * a + 1][2 * b + 1] += weight * (axial * dy[a] * dy[b] + shear * dx[a] * dx[b]);
            }
    }
}

static void assemble(struct mesh *mesh, const struct body *body)
{
    static const size_t right[4] = {0, 1, 1, 0}, up[4] = {0, 0, 1, 1};
    for (size_t row = 0; row < mesh->rows; row++) {
        double k[8][8];
        element(body->young, width / (double)(mesh->columns - 1), mesh->heights[row], k);
        for (size_t column = 0; column + 1 < mesh->columns; column++) {
            size_t node[4][2];
            for (int a = 0; a < 4; a++) {
                node[a][0] = column + right[a];
                node[a][1] = row + (body->below ? 1 - up[a] : up[a]);
            }
            for (int j = 0; j < 8; j++) {
                const size_t *of = node[j / 2];
                const size_t at = dof(mesh, body, of[0], of[1], j % 2);
                for (int i = 0; i < 8; i++)
                    mesh->values[place(mesh, of, i % 2, node[i / 2], at)] += k[i][j];
            }
        }
    }
}

static void hold(struct mesh *mesh, size_t at, double value)
{
    mesh->held_dofs[mesh->held] = (int64_t)at;
    mesh->prescribed[mesh->held++] = value;
}

static void hold_and_load(struct mesh *mesh, enum geometry geometry)
{
    const struct body *top = &mesh->body[0];
    const size_t last = mesh->columns - 1;
    mesh->load = need(mesh->size, sizeof *mesh->load);
    mesh->held_dofs = need(4 * mesh->columns + mesh->rows + 1, sizeof *mesh->held_dofs);
    mesh->prescribed = need(4 * mesh->columns + mesh->rows + 1, sizeof *mesh->prescribed);
    for (size_t column = 0; column <= last; column++) {
        hold(mesh, dof(mesh, top, column, mesh->rows, 1), -approach);
        if (geometry == TWO_BLOCKS) {
            hold(mesh, dof(mesh, top, column, mesh->rows, 0), shift);
            for (int axis = 0; axis < 2; axis++)
                hold(mesh, dof(mesh, &mesh->body[1], column, mesh->rows, axis), 0.0);
        }
    }
    if (geometry == BAR)
        for (size_t row = 0; row <= mesh->rows; row++) {
            hold(mesh, dof(mesh, top, last, row, 0), 0.0);
            if (row < mesh->rows) {
                const double half = side_pressure * mesh->heights[row] / 2.0;
                mesh->load[dof(mesh, top, 0, row, 0)] += half;
                mesh->load[dof(mesh, top, 0, row + 1, 0)] += half;
            }
        }
}

/* The condensed load: what the pairs carry while they are kept at d = 0, all else in equilibrium.
 * No solver is needed for it. */
static int32_t condensed_load(const struct mesh *mesh, const signorini_model *model,
                              const int64_t *slaves, struct contact *contact)
{
    double *zero = need(2 * contact->pairs, sizeof *zero);
    double *u = need(mesh->size, sizeof *u);
    int32_t status = signorini_model_recover(model, 1, mesh->load, mesh->prescribed, zero, u);
    for (size_t i = 0; status == 0 && i < 2 * contact->pairs; i++) {
        const size_t at = (size_t)slaves[i];
        double force = mesh->load[at];
        for (int64_t k = mesh->starts[at]; k < mesh->starts[at + 1]; k++)
            force -= mesh->values[k] * u[mesh->rows_of[k]]; /* symmetric: the column is the row */
        for (size_t k = 0; k < mesh->held; k++)
            if (mesh->held_dofs[k] == slaves[i])
                force = 0.0;
        /* (x, y) to (n, t) = (-y, x). */
        contact->f[i % 2 == 0 ? i + 1 : i - 1] = i % 2 == 0 ? force : -force;
    }
    free(zero);
    free(u);
    return status;
}

static int32_t condense(const struct mesh *mesh, struct contact *contact)
{
    const size_t n = contact->pairs;
    int64_t *slaves = need(2 * n, sizeof *slaves), *masters = need(2 * n, sizeof *masters);
    int64_t *starts = need(n + 1, sizeof *starts);
    double *weights = need(n, sizeof *weights);
    double *normals = need(2 * n, sizeof *normals), *tangents = need(2 * n, sizeof *tangents);
    for (size_t i = 0; i < n; i++) {
        for (int axis = 0; axis < 2; axis++) {
            slaves[2 * i + (size_t)axis] = (int64_t)dof(mesh, &mesh->body[0], i, 0, axis);
            if (mesh->bodies == 2)
                masters[2 * i + (size_t)axis] = (int64_t)dof(mesh, &mesh->body[1], i, 0, axis);
        }
        starts[i + 1] = (int64_t)i + 1;
        weights[i] = 1.0;
        normals[2 * i + 1] = -1.0;
        tangents[2 * i] = 1.0;
    }
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
        .triangle = SIGNORINI_TRIANGLE_FULL, .size = (int64_t)mesh->size,
        .nnz = mesh->starts[mesh->size], .col_start = mesh->starts, .row = mesh->rows_of,
        .values = mesh->values};
    signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = (int64_t)n,
        .slaves = slaves, .normals = normals, .tangents = tangents};
    if (mesh->bodies == 2) {
        pairs.master_start = starts;
        pairs.masters = masters;
        pairs.weights = weights;
    }
    signorini_model *model;
    int32_t status =
        signorini_model_new_sparse(&K, (int64_t)mesh->held, mesh->held_dofs, &pairs, NULL, &model);
    if (status == 0)
        status = copy_stiffness(model, contact->K);
    if (status == 0)
        status = condensed_load(mesh, model, slaves, contact);
    signorini_model_free(model);
    free(slaves);
    free(masters);
    free(starts);
    free(weights);
    free(normals);
    free(tangents);
    return status;
}

const char *contact_new(enum geometry geometry, size_t pairs, double wave, struct contact *contact)
{
    const double pi = acos(-1.0);
    struct mesh mesh = {.columns = pairs, .rows = pairs < 100 ? 8 : 10, .bodies = 1};
    contact->dim = 2;
    contact->pairs = pairs;
    contact->K = need(4 * pairs * pairs, sizeof *contact->K);
    contact->f = need(2 * pairs, sizeof *contact->f);
    contact->gap = need(pairs, sizeof *contact->gap);
    for (size_t i = 0; i < pairs; i++)
        contact->gap[i] = wave * (1.0 - cos(6.0 * pi * (double)i / (double)(pairs - 1)));

    mesh.heights = need(mesh.rows, sizeof *mesh.heights);
    choose_heights(&mesh);
    mesh.body[0].young = geometry == BAR ? 13000.0 : 20000.0;
    if (geometry == TWO_BLOCKS) {
        mesh.bodies = 2;
        mesh.body[1] = (struct body){2 * pairs * (mesh.rows + 1), 1, 13000.0};
    }
    pattern(&mesh);
    for (size_t b = 0; b < mesh.bodies; b++)
        assemble(&mesh, &mesh.body[b]);
    hold_and_load(&mesh, geometry);
    const int32_t status = condense(&mesh, contact);
    free(mesh.heights);
    free(mesh.starts);
    free(mesh.rows_of);
    free(mesh.values);
    free(mesh.load);
    free(mesh.held_dofs);
    free(mesh.prescribed);
    return status == 0 ? NULL : signorini_last_error();
}

void contact_free(struct contact *contact)
{
    free(contact->K);
    free(contact->f);
    free(contact->gap);
}
