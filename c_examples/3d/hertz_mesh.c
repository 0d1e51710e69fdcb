#include "hertz_mesh.h"

#include <math.h>
#include <stdlib.h>

enum { LOWER, UPPER, MOST_LINES = 64 };

static const double half_width = 3.0; /* L, in radii of the contact */

/* ---- Lines of the mesh --------------------------------------------------------------------- */

/* The ratio by which `count` cells must grow, the first to ratio times h, to fill `length`. */
static double growth(double h, int count, double length)
{
    double low = 1.0, high = 10.0;

    for (int halving = 0; halving < 60; halving++) {
        const double ratio = (low + high) / 2.0;
        double sum = 0.0, cell = h;
        for (int i = 0; i < count; i++)
            sum += cell *= ratio;
        if (sum < length)
            low = ratio;
        else
            high = ratio;
    }
    return (low + high) / 2.0;
}

/* Lines from 0 on: `even` cells of side h, then `graded` ones up to `length`. */
static void half_lines(double h, int even, int graded, double length, double lines[])
{
    const double ratio = growth(h, graded, length - even * h);
    double cell = h;

    for (int i = 0; i <= even; i++)
        lines[i] = i * h;
    for (int i = 0; i < graded; i++)
        lines[even + i + 1] = lines[even + i] + (cell *= ratio);
    lines[even + graded] = length;
}

/* ---- The mesh ------------------------------------------------------------------------------ */

static int on_cut(const struct brick_mesh *bricks, int box, int i, int j, int k)
{
    const int32_t *size = bricks->size[box];
    return i == 0 || i == size[0] - 1 || j == 0 || j == size[1] - 1 ||
           k == (box == LOWER ? 0 : size[2] - 1);
}

/* Cut faces, box by box; with fixed = NULL they are only counted. */
static int64_t cut_faces(const struct brick_mesh *bricks, int64_t *fixed)
{
    int64_t count = 0;

    for (int box = 0; box < bricks->boxes; box++) {
        const int32_t *size = bricks->size[box];
        for (int32_t node = bricks->first[box]; node < bricks->first[box + 1]; node++) {
            const int32_t number = node - bricks->first[box];
            if (!on_cut(bricks, box, number % size[0], number / size[0] % size[1],
                        number / (size[0] * size[1])))
                continue;
            for (int axis = 0; axis < 3; axis++, count++)
                if (fixed != NULL)
                    fixed[count] = 3 * (int64_t)node + axis;
        }
    }
    return count;
}

static void make_pairs(struct hertz_mesh *mesh, int rim, const struct hertz *hertz)
{
    const struct brick_mesh *bricks = mesh->bricks;

    for (int32_t pair = 0; pair < mesh->contact.pairs; pair++) {
        const int i = pair % mesh->line + rim, j = pair / mesh->line + rim;
        const int32_t lower = brick_node(bricks, LOWER, i, j, bricks->size[LOWER][2] - 1);
        const double *at = bricks->at[lower];
        mesh->contact.lower[pair] = lower;
        mesh->contact.upper[pair] = brick_node(bricks, UPPER, i, j, 0);
        mesh->gap[pair] = (at[0] * at[0] + at[1] * at[1]) / (2.0 * hertz->gap_radius);
    }
}

int hertz_mesh_make(struct hertz_mesh *mesh, const struct hertz *hertz, int cells)
{
    const double length = half_width * hertz->a;
    /* The square of pairs reaches a quarter beyond the contact. From there on each cell is larger
     * by a quarter to a half: numbers in proportion to `cells` refine the whole mesh. */
    const int even = cells + (cells + 3) / 4, graded = 3 * cells / 4;
    const int half = even + graded, deep = cells + 1;
    double from_middle[MOST_LINES], across[2 * MOST_LINES], up[MOST_LINES], down[MOST_LINES];

    *mesh = (struct hertz_mesh){.cell = hertz->a / cells, .line = 2 * even + 1};
    mesh->contact.pairs = mesh->line * mesh->line;
    half_lines(mesh->cell, even, graded, length, from_middle);
    half_lines(mesh->cell, 1, deep - 1, length, up);
    for (int i = 0; i <= half; i++) {
        across[half + i] = from_middle[i];
        across[half - i] = -from_middle[i];
    }
    for (int k = 0; k <= deep; k++)
        down[deep - k] = -up[k];
    const struct box boxes[2] = {{{2 * half, 2 * half, deep}, {across, across, down}},
                                 {{2 * half, 2 * half, deep}, {across, across, up}}};

    mesh->bricks = brick_mesh_new(2, boxes, hertz->material);
    if (mesh->bricks == NULL)
        return 0;
    const size_t pairs = (size_t)mesh->contact.pairs;
    mesh->n_fixed = cut_faces(mesh->bricks, NULL);
    mesh->contact.lower = malloc(pairs * sizeof *mesh->contact.lower);
    mesh->contact.upper = malloc(pairs * sizeof *mesh->contact.upper);
    mesh->gap = malloc(pairs * sizeof *mesh->gap);
    mesh->fixed = malloc((size_t)mesh->n_fixed * sizeof *mesh->fixed);
    if (mesh->contact.lower == NULL || mesh->contact.upper == NULL || mesh->gap == NULL ||
        mesh->fixed == NULL)
        return 0;
    cut_faces(mesh->bricks, mesh->fixed);
    make_pairs(mesh, graded, hertz);
    return 1;
}

void hertz_mesh_free(struct hertz_mesh *mesh)
{
    brick_mesh_free(mesh->bricks);
    free(mesh->contact.lower);
    free(mesh->contact.upper);
    free(mesh->gap);
    free(mesh->fixed);
}

/* ---- Loads --------------------------------------------------------------------------------- */

/* The mirror image at z = 0 of the load's opposite. */
static struct load reaction(const struct load *load)
{
    const double *force = load->force;
    return (struct load){{-force[0], -force[1], force[2]}, -load->moment, load->spread};
}

void hertz_mesh_prescribe(const struct hertz_mesh *mesh, const struct hertz *hertz,
                          const struct motion *motion, double prescribed[])
{
    const struct brick_mesh *bricks = mesh->bricks;
    const struct load press = reaction(&motion->press), friction = reaction(&motion->friction);

    for (int64_t i = 0; i < mesh->n_fixed; i += 3) {
        const int32_t node = (int32_t)(mesh->fixed[i] / 3);
        const double *at = bricks->at[node];
        double *u = &prescribed[i];
        u[0] = u[1] = u[2] = 0.0;
        if (node < bricks->first[UPPER]) {
            add_far_field(hertz->material, &motion->press, at, u);
            add_far_field(hertz->material, &motion->friction, at, u);
        } else {
            const double image[3] = {at[0], at[1], -at[2]};
            add_far_field(hertz->material, &press, image, u);
            add_far_field(hertz->material, &friction, image, u);
            u[0] += motion->shift - motion->rotation * at[1];
            u[1] += motion->rotation * at[0];
            u[2] = -u[2] - motion->approach;
        }
    }
}
