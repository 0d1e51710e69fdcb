#include "junction_mesh.h"
#include "junction_element.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double pitch = ELEMENT_SIDE;

enum { A, B, C };

/* The parts, in lines of the grid. */
static const struct rectangle {
    int part, r0, r1, z0, z1;
} rectangles[] = {
    {A, 16, 24, 0, 32},  /* tube 40-60 x 0-80 mm */
    {A, 16, 48, 32, 48}, /* flange 40-120 x 80-120 */
    {A, 40, 48, 48, 60}, /* heel 100-120 x 120-150 */
    {B, 0, 36, 48, 60},  /* cover 0-90 x 120-150 */
    {C, 24, 48, 60, 66}, /* ring 60-120 x 150-165 */
};

static const struct interface {
    int lower, upper, z, r0, r1;
} interfaces[ZONES] = {{A, B, 48, 16, 36}, {B, C, 60, 24, 36}, {A, C, 60, 40, 48}};

/* ---- Mesh ---------------------------------------------------------------------------------- */

/* Does a rectangle of the part hold the point r, z? `side` = 1 asks for the element above and to
 * the right of it. */
static int inside(int part, int r, int z, int side)
{
    for (size_t i = 0; i < sizeof rectangles / sizeof *rectangles; i++) {
        const struct rectangle *it = &rectangles[i];
        if (it->part == part && r >= it->r0 && r + side <= it->r1 && z >= it->z0 &&
            z + side <= it->z1)
            return 1;
    }
    return 0;
}

static void mesh(struct junction *j)
{
    int32_t node = 0, element = 0, pair = 0, fixed = 0;

    for (int part = 0; part < PARTS; part++) {
        for (int z = 0; z < GRID_Z; z++) {
            for (int r = 0; r < GRID_R; r++) {
                j->node_at[part][z][r] = -1;
                if (!inside(part, r, z, 0))
                    continue;
                j->node_at[part][z][r] = node;
                j->r[node] = pitch * r;
                j->z[node] = pitch * z;
                j->part[node] = part;
                if (r == 0) /* the axis */
                    j->fixed[fixed++] = 2 * node;
                if (z == 0) /* the tube's end */
                    j->fixed[fixed++] = 2 * node + 1;
                node += 1;
            }
        }
        for (int z = 0; z < GRID_Z; z++) {
            for (int r = 0; r < GRID_R; r++) {
                if (!inside(part, r, z, 1))
                    continue;
                j->corners[element][0] = j->node_at[part][z][r];
                j->corners[element][1] = j->node_at[part][z][r + 1];
                j->corners[element][2] = j->node_at[part][z + 1][r + 1];
                j->corners[element][3] = j->node_at[part][z + 1][r];
                element += 1;
            }
        }
    }
    for (int zone = 0; zone < ZONES; zone++) {
        const struct interface *it = &interfaces[zone];
        for (int r = it->r0; r <= it->r1; r++) {
            j->lower[pair] = j->node_at[it->lower][it->z][r];
            j->upper[pair] = j->node_at[it->upper][it->z][r];
            j->zone[pair] = zone + 1;
            pair += 1;
        }
    }
}

/* ---- Assembly ------------------------------------------------------------------------------ */

/* The nodes that share an element with a node, ascending. */
struct neighbours {
    int count;
    int32_t nodes[NEIGHBOURS];
};

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

static double *entry(struct junction *j, int32_t row, int32_t column)
{
    int32_t at = j->starts[column];
    while (j->rows[at] != row)
        at += 1;
    return &j->values[at];
}

static void assemble(struct junction *j, struct neighbours *neighbours)
{
    int32_t at = 0;

    for (size_t e = 0; e < ELEMENTS; e++)
        for (size_t a = 0; a < 4; a++)
            for (size_t b = 0; b < 4; b++)
                connect(&neighbours[j->corners[e][a]], j->corners[e][b]);

    for (int32_t column = 0; column < DOFS; column++) {
        const struct neighbours *list = &neighbours[column / 2];
        j->starts[column] = at;
        for (int32_t i = 0; i < 2 * list->count; i++)
            j->rows[at++] = 2 * list->nodes[i / 2] + i % 2;
    }
    j->starts[DOFS] = at;

    for (size_t e = 0; e < ELEMENTS; e++) {
        const int32_t *corners = j->corners[e];
        double k[8][8];
        element_stiffness(j->part[corners[0]], j->r[corners[0]], k);
        for (int m = 0; m < 8; m++)
            for (int n = 0; n < 8; n++)
                *entry(j, 2 * corners[m / 2] + m % 2, 2 * corners[n / 2] + n % 2) += k[m][n];
    }
}

struct junction *junction_new(void)
{
    struct junction *junction = calloc(1, sizeof *junction);
    struct neighbours *neighbours = calloc(NODES, sizeof *neighbours);

    if (junction != NULL && neighbours != NULL) {
        mesh(junction);
        assemble(junction, neighbours);
    } else {
        free(junction);
        junction = NULL;
    }
    free(neighbours);
    return junction;
}

/* ---- Loads --------------------------------------------------------------------------------- */

/* Adds a pressure on the edge between two nodes, in one direction: what each node gets is the
 * integral of its shape function, by two Gauss points. */
static void press(const struct junction *j, int32_t first, int32_t second, int direction,
                  double pressure, double *f)
{
    for (int point = 0; point < 2; point++) {
        const double second_share = (1.0 + (point == 0 ? -1.0 : 1.0) / sqrt(3.0)) / 2.0;
        const double first_share = 1.0 - second_share;
        const double radius = first_share * j->r[first] + second_share * j->r[second];
        const double force = pressure * 2.0 * pi * radius * pitch / 2.0;
        f[2 * first + direction] += first_share * force;
        f[2 * second + direction] += second_share * force;
    }
}

void junction_loads(const struct junction *junction, double closing, double inner, double f[DOFS])
{
    const struct junction *j = junction;

    for (size_t i = 0; i < DOFS; i++)
        f[i] = 0.0;
    for (int r = 32; r < 40; r++) { /* 80 to 100 mm */
        press(j, j->node_at[C][66][r], j->node_at[C][66][r + 1], 1, -closing, f);
        press(j, j->node_at[A][32][r], j->node_at[A][32][r + 1], 1, closing, f);
    }
    for (int z = 0; z < 48; z++) /* the bore, 0 to 120 mm */
        press(j, j->node_at[A][z][16], j->node_at[A][z + 1][16], 0, inner, f);
    for (int r = 0; r < 16; r++) /* the cover, up to 40 mm */
        press(j, j->node_at[B][48][r], j->node_at[B][48][r + 1], 1, inner, f);
}

/* ---- Results ------------------------------------------------------------------------------- */

void junction_stress(const struct junction *junction, const double u[DOFS], double at_nodes[NODES],
                     double of_elements[ELEMENTS])
{
    int elements[NODES] = {0};

    for (size_t node = 0; node < NODES; node++)
        at_nodes[node] = 0.0;
    for (size_t e = 0; e < ELEMENTS; e++) {
        const int32_t *corners = junction->corners[e];
        double own[8], at_corners[4];
        for (int i = 0; i < 8; i++)
            own[i] = u[2 * corners[i / 2] + i % 2];
        of_elements[e] = element_stress(junction->part[corners[0]], junction->r[corners[0]], own,
                                        at_corners);
        for (int a = 0; a < 4; a++) {
            at_nodes[corners[a]] += at_corners[a];
            elements[corners[a]] += 1;
        }
    }
    for (size_t node = 0; node < NODES; node++)
        at_nodes[node] /= elements[node];
}

double junction_residual(const struct junction *junction, const double u[DOFS],
                         const double f[DOFS])
{
    double largest = 0.0;
    size_t next = 0; /* the fixed components ascend */

    for (int64_t row = 0; row < DOFS; row++) {
        double residual = -f[row];
        if (next < FIXED && junction->fixed[next] == row) {
            next += 1;
            continue;
        }
        /* The matrix is symmetric: its rows are its columns. */
        for (int32_t at = junction->starts[row]; at < junction->starts[row + 1]; at++)
            residual += junction->values[at] * u[junction->rows[at]];
        largest = fmax(largest, fabs(residual));
    }
    return largest;
}
