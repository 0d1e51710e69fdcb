#include "brick_mesh.h"

#include <stdlib.h>

/* At most 3 x 3 x 3 nodes share a brick with a node, itself included. */
enum { NEIGHBOURS = 27 };

struct neighbours {
    int count;
    int32_t nodes[NEIGHBOURS]; /* ascending */
};

/* ---- Mesh ---------------------------------------------------------------------------------- */

int32_t brick_node(const struct brick_mesh *mesh, int box, int i, int j, int k)
{
    const int32_t *size = mesh->size[box];
    return mesh->first[box] + i + size[0] * (j + size[1] * k);
}

static void place_nodes(struct brick_mesh *mesh, const struct box box[])
{
    for (int b = 0; b < mesh->boxes; b++) {
        for (int k = 0; k <= box[b].cells[2]; k++) {
            for (int j = 0; j <= box[b].cells[1]; j++) {
                for (int i = 0; i <= box[b].cells[0]; i++) {
                    double *at = mesh->at[brick_node(mesh, b, i, j, k)];
                    at[0] = box[b].lines[0][i];
                    at[1] = box[b].lines[1][j];
                    at[2] = box[b].lines[2][k];
                }
            }
        }
    }
}

static void place_bricks(struct brick_mesh *mesh, const struct box box[])
{
    static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    int32_t brick = 0;

    for (int b = 0; b < mesh->boxes; b++)
        for (int k = 0; k < box[b].cells[2]; k++)
            for (int j = 0; j < box[b].cells[1]; j++)
                for (int i = 0; i < box[b].cells[0]; i++, brick++)
                    for (int c = 0; c < 8; c++)
                        mesh->corners[brick][c] = brick_node(mesh, b, i + corner[c][0],
                                                             j + corner[c][1], k + corner[c][2]);
}

int64_t brick_faces(const struct brick_mesh *mesh, int box, int top, int64_t faces[][4])
{
    const int32_t *size = mesh->size[box];
    const int k = top ? size[2] - 1 : 0;
    int64_t count = 0;

    for (int j = 0; j + 1 < size[1]; j++) {
        for (int i = 0; i + 1 < size[0]; i++, count++) {
            if (faces == NULL)
                continue;
            faces[count][0] = brick_node(mesh, box, i, j, k);
            faces[count][1] = brick_node(mesh, box, i + top, j + !top, k);
            faces[count][2] = brick_node(mesh, box, i + 1, j + 1, k);
            faces[count][3] = brick_node(mesh, box, i + !top, j + top, k);
        }
    }
    return count;
}

/* ---- Assembly ------------------------------------------------------------------------------ */

static void connect(struct neighbours *list, int32_t node)
{
    int at = 0;
    while (at < list->count && list->nodes[at] < node)
        at += 1;
    if (at < list->count && list->nodes[at] == node)
        return;
    for (int i = list->count; i > at; i--)
        list->nodes[i] = list->nodes[i - 1];
    list->nodes[at] = node;
    list->count += 1;
}

/* The columns of the three degrees of freedom of a node have the same rows: those of its
 * neighbours. */
static int make_pattern(struct brick_mesh *mesh)
{
    struct neighbours *lists = calloc((size_t)mesh->nodes, sizeof *lists);
    int32_t at = 0;

    if (lists == NULL)
        return 0;
    for (int32_t brick = 0; brick < mesh->bricks; brick++)
        for (int a = 0; a < 8; a++)
            for (int b = 0; b < 8; b++)
                connect(&lists[mesh->corners[brick][a]], (int32_t)mesh->corners[brick][b]);
    for (int32_t node = 0; node < mesh->nodes; node++)
        at += 9 * lists[node].count;
    mesh->rows = malloc((size_t)at * sizeof *mesh->rows);
    mesh->values = calloc((size_t)at, sizeof *mesh->values);
    if (mesh->rows != NULL && mesh->values != NULL) {
        at = 0;
        for (int32_t column = 0; column < mesh->dofs; column++) {
            const struct neighbours *list = &lists[column / 3];
            mesh->starts[column] = at;
            for (int32_t i = 0; i < 3 * list->count; i++)
                mesh->rows[at++] = 3 * list->nodes[i / 3] + i % 3;
        }
        mesh->starts[mesh->dofs] = at;
    }
    free(lists);
    return mesh->rows != NULL && mesh->values != NULL;
}

static double *entry(struct brick_mesh *mesh, int32_t row, int32_t column)
{
    int32_t low = mesh->starts[column], high = mesh->starts[column + 1] - 1;

    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (mesh->rows[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return &mesh->values[low];
}

static void assemble(struct brick_mesh *mesh, struct material material)
{
    for (int32_t brick = 0; brick < mesh->bricks; brick++) {
        const int64_t *corners = mesh->corners[brick];
        double at[8][3], k[24][24];
        for (int a = 0; a < 8; a++)
            for (int axis = 0; axis < 3; axis++)
                at[a][axis] = mesh->at[corners[a]][axis];
        brick_stiffness(at, material, k);
        for (int m = 0; m < 24; m++)
            for (int n = 0; n < 24; n++)
                *entry(mesh, (int32_t)(3 * corners[m / 3] + m % 3),
                       (int32_t)(3 * corners[n / 3] + n % 3)) += k[m][n];
    }
}

struct brick_mesh *brick_mesh_new(int boxes, const struct box box[], struct material material)
{
    struct brick_mesh *mesh = calloc(1, sizeof *mesh);

    if (mesh == NULL)
        return NULL;
    mesh->boxes = boxes;
    for (int b = 0; b < boxes; b++) {
        int32_t nodes = 1, bricks = 1;
        for (int axis = 0; axis < 3; axis++) {
            mesh->size[b][axis] = box[b].cells[axis] + 1;
            nodes *= box[b].cells[axis] + 1;
            bricks *= box[b].cells[axis];
        }
        mesh->first[b + 1] = mesh->first[b] + nodes;
        mesh->bricks += bricks;
    }
    mesh->nodes = mesh->first[boxes];
    mesh->dofs = 3 * mesh->nodes;
    mesh->at = malloc((size_t)mesh->nodes * sizeof *mesh->at);
    mesh->corners = malloc((size_t)mesh->bricks * sizeof *mesh->corners);
    mesh->starts = malloc(((size_t)mesh->dofs + 1) * sizeof *mesh->starts);
    if (mesh->at != NULL && mesh->corners != NULL && mesh->starts != NULL) {
        place_nodes(mesh, box);
        place_bricks(mesh, box);
        if (make_pattern(mesh)) {
            assemble(mesh, material);
            return mesh;
        }
    }
    brick_mesh_free(mesh);
    return NULL;
}

void brick_mesh_move(struct brick_mesh *mesh, struct material material,
                     void (*move)(int box, double at[3]))
{
    for (int box = 0; box < mesh->boxes; box++)
        for (int32_t node = mesh->first[box]; node < mesh->first[box + 1]; node++)
            move(box, mesh->at[node]);
    for (int32_t entry = 0; entry < mesh->starts[mesh->dofs]; entry++)
        mesh->values[entry] = 0.0;
    assemble(mesh, material);
}

void brick_mesh_free(struct brick_mesh *mesh)
{
    if (mesh == NULL)
        return;
    free(mesh->at);
    free(mesh->corners);
    free(mesh->starts);
    free(mesh->rows);
    free(mesh->values);
    free(mesh);
}

/* ---- Results ------------------------------------------------------------------------------- */

void brick_residual(const struct brick_mesh *mesh, const double u[], const double f[],
                    double residual[])
{
    /* The matrix is symmetric: its rows are its columns. */
    for (int32_t row = 0; row < mesh->dofs; row++) {
        residual[row] = -f[row];
        for (int32_t at = mesh->starts[row]; at < mesh->starts[row + 1]; at++)
            residual[row] += mesh->values[at] * u[mesh->rows[at]];
    }
}

void brick_resultant(const struct brick_mesh *mesh, int box, const double f[], double force[3],
                     double moment[3])
{
    for (int axis = 0; axis < 3; axis++)
        force[axis] = moment[axis] = 0.0;
    for (int32_t node = mesh->first[box]; node < mesh->first[box + 1]; node++) {
        for (int axis = 0; axis < 3; axis++) {
            const int p = (axis + 1) % 3, q = (axis + 2) % 3;
            force[axis] += f[3 * node + axis];
            moment[axis] += mesh->at[node][p] * f[3 * node + q];
            moment[axis] -= mesh->at[node][q] * f[3 * node + p];
        }
    }
}
