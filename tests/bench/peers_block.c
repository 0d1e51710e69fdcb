#include "peers_block.h"

#include <math.h>
#include "../c/everything.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS = 8, ELEMENT = 3 * CORNERS, NEIGHBOURS = 27 };

static const double width = 40.0, young = 13000.0, poisson = 0.2;

/* Nodes are numbered along x, then y, then upwards from the plane. */
struct block {
    size_t side, layers; /* nodes along an edge of the contact face; elements upwards */
    double *heights;     /* of the layers */
    double height;
    size_t size; /* degrees of freedom */
    int64_t *starts, *rows_of; /* the assembled matrix, both triangles */
    double *values;
    signorini_model *model;
};

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t node_at(const struct block *block, size_t x, size_t y, size_t z)
{
    return (z * block->side + y) * block->side + x;
}

/* The first layer is about as high as an element is wide, and the others grow by one ratio; it is 1
 * in columns, whose elements are cubes. */
static void choose_heights(struct block *block)
{
    const double first = width / (double)(block->side - 1);
    double low = 1.0, high = 16.0, sum = 0.0;
    for (int step = 0; step < 60; step++) {
        const double middle = 0.5 * (low + high);
        sum = 0.0;
        for (size_t i = 0; i < block->layers; i++)
            sum += first * pow(middle, (double)i);
        *(sum < block->height ? &low : &high) = middle;
    }
    sum = 0.0;
    for (size_t i = 0; i < block->layers; i++)
        sum += pow(low, (double)i);
    for (size_t i = 0; i < block->layers; i++)
        block->heights[i] = block->height * pow(low, (double)i) / sum;
}

/* Stiffness of a brick; corner a is at the upper end of x, y, z where bits 0, 1, 2 of a are set. */
static void element(double w, double h, double k[ELEMENT][ELEMENT])
{
    const double gauss = 1.0 / sqrt(3.0), edge[3] = {w, w, h};
    const double shear = young / (2.0 * (1.0 + poisson));
    const double lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    const double weight = w * w * h / 8.0;
    memset(k, 0, ELEMENT * ELEMENT * sizeof(double));
    for (int point = 0; point < CORNERS; point++) {
        double slope[CORNERS][3]; /* derivatives of the shape functions */
        for (int a = 0; a < CORNERS; a++)
            for (int i = 0; i < 3; i++) {
                slope[a][i] = (a >> i & 1 ? 2.0 : -2.0) / edge[i] / 8.0;
                for (int j = 0; j < 3; j++)
                    if (j != i)
                        slope[a][i] *= 1.0 + ((a >> j & 1) == (point >> j & 1) ? gauss : -gauss);
            }
        for (int a = 0; a < CORNERS; a++)
            for (int b = 0; b < CORNERS; b++) {
                double product = 0.0;
                for (int i = 0; i < 3; i++)
                    product += slope[a][i] * slope[b][i];
                for (int i = 0; i < 3; i++)
                    for (int j = 0; j < 3; j++)
                        k[3 * a + i][3 * b + j] +=
                            weight * (lame * slope[a][i] * slope[b][j] +
                                      shear * slope[a][j] * slope[b][i] +
                                      (i == j ? shear * product : 0.0));
            }
    }
}

/* Every node meets its neighbours in the cube around it, in ascending order. */
static void pattern(struct block *block)
{
    const size_t n = block->side, up = block->layers + 1;
    size_t used = 0;
    block->size = 3 * n * n * up;
    block->starts = need(block->size + 1, sizeof *block->starts);
    block->rows_of = need(3 * NEIGHBOURS * block->size, sizeof *block->rows_of);
    block->values = need(3 * NEIGHBOURS * block->size, sizeof *block->values);
    for (size_t column = 0; column < block->size; column++) {
        const size_t node = column / 3, x = node % n, y = node / n % n, z = node / (n * n);
        block->starts[column] = (int64_t)used;
        for (size_t c = z - (z > 0); c <= smaller(z + 1, up - 1); c++)
            for (size_t b = y - (y > 0); b <= smaller(y + 1, n - 1); b++)
                for (size_t a = x - (x > 0); a <= smaller(x + 1, n - 1); a++)
                    for (size_t axis = 0; axis < 3; axis++)
                        block->rows_of[used++] = (int64_t)(3 * node_at(block, a, b, c) + axis);
    }
    block->starts[block->size] = (int64_t)used;
}

static void add(struct block *block, size_t row, size_t column, double value)
{
    int64_t low = block->starts[column], high = block->starts[column + 1] - 1;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (block->rows_of[middle] < (int64_t)row)
            low = middle + 1;
        else
            high = middle;
    }
    block->values[low] += value;
}

static void assemble(struct block *block)
{
    for (size_t z = 0; z < block->layers; z++) {
        double k[ELEMENT][ELEMENT];
        element(width / (double)(block->side - 1), block->heights[z], k);
        for (size_t y = 0; y + 1 < block->side; y++)
            for (size_t x = 0; x + 1 < block->side; x++) {
                size_t dof[ELEMENT];
                for (size_t a = 0; a < ELEMENT; a++) {
                    const size_t corner = a / 3;
                    dof[a] = 3 * node_at(block, x + (corner & 1), y + (corner >> 1 & 1),
                                         z + (corner >> 2)) + a % 3;
                }
                for (size_t b = 0; b < ELEMENT; b++)
                    for (size_t a = 0; a < ELEMENT; a++)
                        add(block, dof[a], dof[b], k[a][b]);
            }
    }
}

static int32_t condense(struct block *block, struct contact *contact)
{
    const size_t n = contact->pairs, held = 3 * n, first_held = block->size - held;
    int64_t *slaves = need(3 * n, sizeof *slaves), *fixed = need(held, sizeof *fixed);
    double *normals = need(3 * n, sizeof *normals), *tangents = need(3 * n, sizeof *tangents);
    for (size_t i = 0; i < 3 * n; i++) {
        slaves[i] = (int64_t)i;
        fixed[i] = (int64_t)(first_held + i);
        normals[i] = i % 3 == 2 ? -1.0 : 0.0;
        tangents[i] = i % 3 == 0 ? 1.0 : 0.0;
    }
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
        .triangle = SIGNORINI_TRIANGLE_FULL, .size = (int64_t)block->size,
        .nnz = block->starts[block->size], .col_start = block->starts, .row = block->rows_of,
        .values = block->values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 3, .count = (int64_t)n,
        .slaves = slaves, .normals = normals, .tangents = tangents};
    int32_t status =
        signorini_model_new_sparse(&K, (int64_t)held, fixed, &pairs, NULL, &block->model);
    if (status == 0)
        status = copy_stiffness(block->model, contact->K);
    free(slaves);
    free(fixed);
    free(normals);
    free(tangents);
    return status;
}

struct block *block_new(size_t side, size_t slenderness, struct contact *contact)
{
    struct block *block = need(1, sizeof *block);
    const size_t elements = side - 1;
    block->side = side;
    /* Few in blocks, so that large ones condense in seconds. */
    block->layers = slenderness > 0 ? slenderness * elements : 5;
    block->height = slenderness > 0 ? (double)slenderness * width : width;
    block->heights = need(block->layers, sizeof *block->heights);
    *contact = (struct contact){.dim = 3, .pairs = side * side};
    contact->K = need(9 * contact->pairs * contact->pairs, sizeof *contact->K);
    contact->f = need(3 * contact->pairs, sizeof *contact->f);
    contact->gap = need(contact->pairs, sizeof *contact->gap);
    choose_heights(block);
    pattern(block);
    assemble(block);
    if (condense(block, contact) == 0)
        return block;
    block_free(block);
    return NULL;
}

void block_free(struct block *block)
{
    signorini_model_free(block->model);
    free(block->heights);
    free(block->starts);
    free(block->rows_of);
    free(block->values);
    free(block);
}

/* ---- loads ---- */

/* Small motion of the upper face: translation, and rotation about its centre. */
struct motion {
    double along[3]; /* x, y, z */
    double about[3];
};

/* Strain of the pressed body; a shear of twice that gives a shear stress of about the pressure. */
static const double strain = 5e-4;

static struct motion motion_of(const struct block *block, enum geometry geometry, double mu)
{
    const double press = strain * block->height, half = width / 2.0;
    const double shear = 2.0 * (1.0 + poisson) * mu * press; /* all would slide */
    struct motion motion = {.along = {0.0, 0.0, -press}};
    switch (geometry) {
    case BLOCK_SHIFT:
        motion.along[0] = 0.6 * shear;
        break;
    case BLOCK_TWIST:
        motion.about[2] = 0.7 * shear / half;
        break;
    case BLOCK_TILT: /* one edge lifts */
        motion.about[1] = 2.0 * press / half;
        motion.along[1] = 0.3 * shear;
        break;
    case BLOCK_WAVES:
        motion.along[0] = motion.along[1] = 0.3 * shear;
        break;
    case BLOCK_RIM:
        motion.along[0] = 0.3 * shear;
        motion.about[2] = 0.3 * shear / half;
        break;
    default: /* a column bends and twists */
        motion.along[0] = 6e-4 * block->height * block->height / width;
        motion.about[2] = 0.7 * shear / half;
    }
    return motion;
}

static double gap_at(const struct block *block, enum geometry geometry, double x, double y)
{
    const double pi = acos(-1.0), press = strain * block->height, half = width / 2.0;
    const double from_centre = hypot(x, y) / half;
    if (geometry == BLOCK_WAVES)
        return 0.4 * press * (1.0 - cos(2.0 * pi * x / half) * cos(1.5 * pi * y / half));
    if (geometry == BLOCK_RIM)
        return 2.0 * press * pow(fmax(0.0, from_centre - 0.6), 2.0);
    return 0.0;
}

int block_load(const struct block *block, enum geometry geometry, double mu,
               struct contact *contact)
{
    const struct motion move = motion_of(block, geometry, mu);
    const double step = width / (double)(block->side - 1);
    double *load = need(block->size, sizeof *load);
    double *prescribed = need(3 * contact->pairs, sizeof *prescribed);
    for (size_t i = 0; i < contact->pairs; i++) {
        const double x = step * (double)(i % block->side) - width / 2.0;
        const double y = step * (double)(i / block->side) - width / 2.0;
        prescribed[3 * i] = move.along[0] - move.about[2] * y;
        prescribed[3 * i + 1] = move.along[1] + move.about[2] * x;
        prescribed[3 * i + 2] = move.along[2] + move.about[0] * y - move.about[1] * x;
        contact->gap[i] = gap_at(block, geometry, x, y);
    }
    const int32_t status =
        signorini_model_condensed_load(block->model, load, prescribed, contact->f);
    free(load);
    free(prescribed);
    return status;
}
