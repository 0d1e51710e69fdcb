#include "peers_held.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../c/everything.h"

/* Bodies of bricks with 2^dim nodes, on a grid that is bent upwards in the middle by `rise`; half-spaces have no mesh. */
enum support { TOP, ENDS, ONE_END, HALF_SPACE };
enum shape { BALL, RIDGES, ROUGH };

struct family {
    const char *name;
    size_t dim;
    enum support support;
    double height;  /* beside the length */
    size_t layers;  /* of elements */
    double rise;    /* of an arch, beside its length */
    double spread;  /* moduli of elements are exp(spread x), x between -1 and 1 */
    enum shape shape;
    double open;    /* part of the pairs */
    double slide;   /* of the held face, beside its approach */
};

static const struct family families[] = {
    {"random block 2D", 2, TOP, 0.5, 6, 0.0, 2.0, ROUGH, 0.7, 0.3},
    {"thin strip 2D", 2, TOP, 0.05, 2, 0.0, 0.0, RIDGES, 0.7, 0.3},
    {"beam 2D", 2, ONE_END, 0.1, 3, 0.0, 0.0, BALL, 0.7, 0.1},
    {"arch 2D", 2, ENDS, 0.1, 3, 0.2, 0.0, BALL, 0.8, 0.1},
    {"half-plane 2D", 2, HALF_SPACE, 0.0, 0, 0.0, 0.0, BALL, 0.7, 0.1},
    {"random block 3D", 3, TOP, 0.5, 4, 0.0, 2.0, ROUGH, 0.7, 0.3},
    {"thin plate 3D", 3, TOP, 0.05, 1, 0.0, 0.0, RIDGES, 0.6, 0.3},
    {"plate held at its ends 3D", 3, ENDS, 0.1, 2, 0.0, 0.0, BALL, 0.7, 0.1},
    {"arch 3D", 3, ENDS, 0.15, 2, 0.2, 1.0, RIDGES, 0.8, 0.2},
    {"half-space 3D", 3, HALF_SPACE, 0.0, 0, 0.0, 0.0, BALL, 0.8, 0.1},
};
const size_t held_count = sizeof families / sizeof families[0];

static const double approach = 1e-3, young = 1e4, poisson = 0.3;

const char *held_name(size_t family)
{
    return families[family].name;
}

size_t held_dim(size_t family)
{
    return families[family].dim;
}

/* Numbers between -1 and 1, the same in every run. */
static double draw(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1.0;
}

/* ---- meshes: along x, then y, then upwards, which is the last axis ---- */

struct grid {
    size_t dim, count[3]; /* nodes along each axis, 1 where there is none */
    double *places;       /* three for each node */
};

static size_t nodes(const struct grid *grid)
{
    return grid->count[0] * grid->count[1] * grid->count[2];
}

static void place_nodes(struct grid *grid, const struct family *family)
{
    const size_t *count = grid->count;
    grid->places = need(3 * nodes(grid), sizeof *grid->places);
    for (size_t node = 0; node < nodes(grid); node++) {
        double *at = &grid->places[3 * node];
        const size_t step[3] = {node % count[0], node / count[0] % count[1],
                                node / (count[0] * count[1])};
        for (int axis = 0; axis < 3; axis++)
            at[axis] = count[axis] > 1 ? (double)step[axis] / (double)(count[axis] - 1) : 0.0;
        at[2] = family->height * at[2] + family->rise * 4.0 * at[0] * (1.0 - at[0]);
    }
}

/* Slopes of the shape functions in a corner of Gauss, turned to x, y, z; returns the volume that belongs to it. */
static double slopes_at(size_t dim, double (*at)[3], size_t point, double (*slope)[3])
{
    const double gauss = 1.0 / sqrt(3.0);
    const size_t corners = (size_t)1 << dim;
    double local[8][3], jacobian[3][3] = {{0}}, adjoint[3][3], det = 0.0;
    for (size_t a = 0; a < corners; a++)
        for (size_t i = 0; i < dim; i++) {
            local[a][i] = a >> i & 1 ? 0.5 : -0.5;
            for (size_t j = 0; j < dim; j++)
                if (j != i)
                    local[a][i] *= 0.5 * (1.0 + ((a >> j & 1) == (point >> j & 1) ? gauss : -gauss));
            for (size_t j = 0; j < dim; j++)
                jacobian[i][j] += local[a][i] * at[a][dim == 2 && j == 1 ? 2 : j];
        }
    if (dim == 2)
        jacobian[2][2] = 1.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            adjoint[j][i] = jacobian[a][c] * jacobian[b][d] - jacobian[a][d] * jacobian[b][c];
        }
    for (int i = 0; i < 3; i++)
        det += jacobian[0][i] * adjoint[i][0];
    for (size_t a = 0; a < corners; a++)
        for (size_t j = 0; j < dim; j++) {
            slope[a][j] = 0.0;
            for (size_t i = 0; i < dim; i++)
                slope[a][j] += adjoint[j][i] * local[a][i] / det;
        }
    return fabs(det);
}

static void element(size_t dim, double (*at)[3], double modulus, double k[24][24])
{
    const double shear = modulus / (2.0 * (1.0 + poisson));
    const double lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    const size_t corners = (size_t)1 << dim;
    memset(k, 0, 24 * 24 * sizeof(double));
    for (size_t point = 0; point < corners; point++) {
        double s[8][3];
        const double weight = slopes_at(dim, at, point, s);
        for (size_t a = 0; a < corners; a++)
            for (size_t b = 0; b < corners; b++) {
                double product = 0.0;
                for (size_t i = 0; i < dim; i++)
                    product += s[a][i] * s[b][i];
                for (size_t i = 0; i < dim; i++)
                    for (size_t j = 0; j < dim; j++)
                        k[dim * a + i][dim * b + j] +=
                            weight * (lame * s[a][i] * s[b][j] + shear * s[a][j] * s[b][i] +
                                      (i == j ? shear * product : 0.0));
            }
    }
}

/* The assembled matrix: every node meets its neighbours in the grid, in ascending order. */
struct assembled {
    size_t size;
    int64_t *starts, *rows;
    double *values;
};

static void pattern(const struct grid *grid, struct assembled *K)
{
    const size_t *n = grid->count, dim = grid->dim;
    size_t used = 0;
    K->size = dim * nodes(grid);
    K->starts = need(K->size + 1, sizeof *K->starts);
    K->rows = need(81 * K->size, sizeof *K->rows);
    K->values = need(81 * K->size, sizeof *K->values);
    for (size_t column = 0; column < K->size; column++) {
        const size_t node = column / dim;
        const size_t x = node % n[0], y = node / n[0] % n[1], z = node / (n[0] * n[1]);
        K->starts[column] = (int64_t)used;
        for (size_t c = z - (z > 0); c <= z + 1 && c < n[2]; c++)
            for (size_t b = y - (y > 0); b <= y + 1 && b < n[1]; b++)
                for (size_t a = x - (x > 0); a <= x + 1 && a < n[0]; a++)
                    for (size_t axis = 0; axis < dim; axis++)
                        K->rows[used++] = (int64_t)(dim * ((c * n[1] + b) * n[0] + a) + axis);
    }
    K->starts[K->size] = (int64_t)used;
}

static void add(struct assembled *K, size_t row, size_t column, double value)
{
    int64_t at = K->starts[column];
    while (K->rows[at] != (int64_t)row)
        at++;
    K->values[at] += value;
}

static void assemble(const struct grid *grid, double spread, struct assembled *K)
{
    const size_t *n = grid->count, dim = grid->dim, corners = (size_t)1 << dim;
    uint64_t state = 1;
    for (size_t node = 0; node < nodes(grid); node++) {
        const size_t x = node % n[0], y = node / n[0] % n[1], z = node / (n[0] * n[1]);
        if (x + 1 == n[0] || (dim == 3 && y + 1 == n[1]) || z + 1 == n[2])
            continue;
        double at[8][3], k[24][24];
        size_t of[8];
        for (size_t a = 0; a < corners; a++) {
            of[a] = node + (a & 1);
            of[a] += dim == 3 ? n[0] * (a >> 1 & 1) + n[0] * n[1] * (a >> 2) : n[0] * (a >> 1);
            memcpy(at[a], &grid->places[3 * of[a]], sizeof at[a]);
        }
        element(dim, at, young * exp(spread * draw(&state)), k);
        for (size_t b = 0; b < dim * corners; b++)
            for (size_t a = 0; a < dim * corners; a++)
                add(K, dim * of[a / dim] + a % dim, dim * of[b / dim] + b % dim, k[a][b]);
    }
}

static int is_held(const struct grid *grid, enum support support, size_t node)
{
    const size_t *n = grid->count, x = node % n[0];
    if (support == TOP)
        return node / (n[0] * n[1]) + 1 == n[2];
    return node >= n[0] * n[1] && (x == 0 || (support == ENDS && x + 1 == n[0]));
}

/* Condenses a body whose held face comes down and slides. */
static int32_t condense(const struct grid *grid, const struct assembled *K,
                        const struct family *family, struct contact *contact)
{
    const size_t dim = grid->dim, n = contact->pairs, most = dim * nodes(grid);
    int64_t *slaves = need(dim * n, sizeof *slaves), *fixed = need(most, sizeof *fixed);
    double *normals = need(dim * n, sizeof *normals), *tangents = need(dim * n, sizeof *tangents);
    double *load = need(most, sizeof *load), *prescribed = need(most, sizeof *prescribed);
    size_t held = 0;
    for (size_t i = 0; i < dim * n; i++) {
        slaves[i] = (int64_t)i;
        normals[i] = i % dim == dim - 1 ? -1.0 : 0.0;
        tangents[i] = i % dim == 0 ? 1.0 : 0.0;
    }
    for (size_t i = 0; i < most; i++)
        if (is_held(grid, family->support, i / dim)) {
            fixed[held] = (int64_t)i;
            prescribed[held++] =
                i % dim == dim - 1 ? -approach : i % dim == 0 ? family->slide * approach : 0.0;
        }
    const signorini_sparse matrix = {.struct_size = sizeof matrix, .index_bytes = 8,
        .triangle = SIGNORINI_TRIANGLE_FULL, .size = (int64_t)K->size, .nnz = K->starts[K->size],
        .col_start = K->starts, .row = K->rows, .values = K->values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = (int32_t)dim,
        .count = (int64_t)n, .slaves = slaves, .normals = normals, .tangents = tangents};
    signorini_model *model = NULL;
    int32_t status =
        signorini_model_new_sparse(&matrix, (int64_t)held, fixed, &pairs, NULL, &model);
    if (status == 0)
        status = copy_stiffness(model, contact->K);
    if (status == 0)
        status = signorini_model_condensed_load(model, load, prescribed, contact->f);
    signorini_model_free(model);
    free(slaves);
    free(fixed);
    free(normals);
    free(tangents);
    free(load);
    free(prescribed);
    return status;
}

static int32_t meshed(const struct family *family, struct grid *grid, struct contact *contact)
{
    struct assembled K;
    pattern(grid, &K);
    assemble(grid, family->spread, &K);
    const int32_t status = condense(grid, &K, family, contact);
    free(K.starts);
    free(K.rows);
    free(K.values);
    return status;
}

/* ---- half-spaces: flexibility of patches, of which the stiffness is the inverse ---- */

void dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info);
void dpotri_(const char *uplo, const int *n, double *a, const int *lda, int *info);

/* Displacements along i by a force along j (0: down), after Boussinesq and Cerruti, and Flamant; without what couples
 * normals with tangents. `h` is the side of a patch. */
static double influence(size_t dim, size_t i, size_t j, double dx, double dy, double h)
{
    const double pi = acos(-1.0), shear = young / (2.0 * (1.0 + poisson)), r = hypot(dx, dy);
    if ((i == 0) != (j == 0))
        return 0.0;
    if (dim == 2)
        return 2.0 * (1.0 - poisson * poisson) / (pi * young) *
               (r > 0.0 ? log(4.0 / r) : log(8.0 / h) + 1.0);
    const double self = 4.0 * log(1.0 + sqrt(2.0)) / h, along = i == 1 ? dx : dy;
    if (i == 0)
        return (1.0 - poisson) / (2.0 * pi * shear) * (r > 0.0 ? 1.0 / r : self);
    if (r == 0.0)
        return i == j ? (1.0 - poisson / 2.0) * self / (2.0 * pi * shear) : 0.0;
    const double other = i == j ? along * along : dx * dy;
    return ((i == j ? 1.0 - poisson : 0.0) / r + poisson * other / (r * r * r)) /
           (2.0 * pi * shear);
}

static int32_t half_space(const struct family *family, const struct grid *grid,
                          struct contact *contact)
{
    const size_t dim = grid->dim, size = dim * contact->pairs;
    const double h = 1.0 / (double)(grid->count[0] - 1);
    for (size_t j = 0; j < size; j++)
        for (size_t i = 0; i < size; i++) {
            const double *a = &grid->places[3 * (i / dim)], *b = &grid->places[3 * (j / dim)];
            contact->K[i + size * j] =
                influence(dim, i % dim, j % dim, a[0] - b[0], a[1] - b[1], h);
        }
    const int n = (int)size;
    int info;
    dpotrf_("L", &n, contact->K, &n, &info);
    if (info == 0)
        dpotri_("L", &n, contact->K, &n, &info);
    for (size_t j = 0; j < size; j++)
        for (size_t i = j + 1; i < size; i++)
            contact->K[j + i * size] = contact->K[i + j * size];
    /* The far field comes nearer, and slides: f = K u. */
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++)
            contact->f[i] += contact->K[i + size * j] *
                             (j % dim == 0 ? approach : j % dim == 1 ? family->slide * approach : 0.0);
    return info == 0 ? 0 : -1;
}

/* ---- gaps ---- */

static double depth_at(enum shape shape, const double *at, uint64_t *state)
{
    const double pi = acos(-1.0), x = at[0] - 0.5, y = at[1] > 0.0 ? at[1] - 0.5 : 0.0;
    if (shape == RIDGES)
        return 2.0 - cos(6.0 * pi * x) - cos(4.0 * pi * y) + x;
    return shape == BALL ? x * x + y * y : 1.0 + draw(state);
}

/* Scales the gaps until the wanted part of the pairs is open. */
static int32_t choose_gaps(const struct family *family, double mu, struct contact *contact)
{
    const size_t n = contact->pairs, dim = contact->dim;
    double *d = need(dim * n, sizeof *d), *F = need(dim * n, sizeof *F), *of = need(n, sizeof *of);
    double *shape = need(n, sizeof *shape), low = 1e-4, high = 1e4;
    int32_t status = 0;
    memcpy(shape, contact->gap, n * sizeof *shape);
    for (size_t i = 0; i < n; i++)
        of[i] = mu;
    for (int step = 0; step < 16 && status == 0; step++) {
        const double scale = approach * sqrt(low * high);
        size_t open = 0;
        for (size_t i = 0; i < n; i++)
            contact->gap[i] = scale * shape[i];
        status = signorini_solve((int32_t)dim, (int64_t)n, contact->K, (int64_t)(dim * n),
                                 contact->f, contact->gap, SIGNORINI_LAW_COULOMB, of, NULL, NULL, d,
                                 F, NULL, NULL, NULL);
        for (size_t i = 0; i < n; i++)
            open += F[dim * i] == 0.0;
        *((double)open < family->open * (double)n ? &low : &high) = sqrt(low * high);
    }
    free(d);
    free(F);
    free(of);
    free(shape);
    return status;
}

const char *held_new(size_t number, size_t pairs, double mu, struct contact *contact)
{
    const struct family *family = &families[number];
    const size_t dim = family->dim;
    const size_t side = dim == 2 ? pairs : (size_t)(sqrt((double)pairs) + 0.5);
    struct grid grid = {.dim = dim, .count = {side, dim == 2 ? 1 : side, family->layers + 1}};
    const size_t n = grid.count[0] * grid.count[1];
    uint64_t state = 7;
    *contact = (struct contact){.dim = dim, .pairs = n};
    contact->K = need(dim * dim * n * n, sizeof *contact->K);
    contact->f = need(dim * n, sizeof *contact->f);
    contact->gap = need(n, sizeof *contact->gap);
    place_nodes(&grid, family);
    for (size_t i = 0; i < n; i++)
        contact->gap[i] = depth_at(family->shape, &grid.places[3 * i], &state);
    int32_t status = family->support == HALF_SPACE ? half_space(family, &grid, contact)
                                                   : meshed(family, &grid, contact);
    if (status == 0)
        status = choose_gaps(family, mu, contact);
    free(grid.places);
    return status == 0 ? NULL : signorini_last_error();
}
