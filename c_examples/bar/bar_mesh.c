#include "bar_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The assembled equations; of the stiffness only the lower triangle is used, column by column. */
struct equations {
    size_t size;
    double *stiffness;
    double *load;
};

static double *entry(const struct equations *eq, size_t i, size_t j)
{
    return i >= j ? &eq->stiffness[i + j * eq->size] : &eq->stiffness[j + i * eq->size];
}

/* Number of a displacement component, direction 0 = x, 1 = y. Rows of nodes are counted upwards
 * from the contact side but numbered from the top: the contact side comes last, and what
 * elimination leaves over is its condensed stiffness. */
static size_t component(const struct bar *bar, size_t column, size_t row, size_t direction)
{
    return 2 * ((bar->rows - row) * BAR_PAIRS + column) + direction;
}

static double row_height(const struct bar *bar, size_t row)
{
    double sum = 0.0;
    for (size_t i = 0; i < bar->rows; i++)
        sum += pow(bar->ratio, (double)i);
    return bar->height * pow(bar->ratio, (double)row) / sum;
}

/* Stiffness of a rectangle in plane strain; nodes anticlockwise from the lower left. */
static void element_stiffness(const struct bar *bar, double width, double height, double k[8][8])
{
    static const double corner_x[4] = {-1, 1, 1, -1};
    static const double corner_y[4] = {-1, -1, 1, 1};
    const double gauss = 1.0 / sqrt(3.0);
    const double nu = bar->poisson;
    const double shear = bar->young / (2.0 * (1.0 + nu));
    const double axial = 2.0 * shear * (1.0 - nu) / (1.0 - 2.0 * nu);
    const double cross = 2.0 * shear * nu / (1.0 - 2.0 * nu);
    const double weight = width * height / 4.0;

    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++)
            k[i][j] = 0.0;

    for (int point = 0; point < 4; point++) {
        double dx[4], dy[4]; /* derivatives of the shape functions */
        for (int a = 0; a < 4; a++) {
            dx[a] = corner_x[a] * (1.0 + corner_y[a] * gauss * corner_y[point]) / (2.0 * width);
            dy[a] = corner_y[a] * (1.0 + corner_x[a] * gauss * corner_x[point]) / (2.0 * height);
        }
        for (int a = 0; a < 4; a++) {
            for (int b = 0; b < 4; b++) {
                k[2 * a][2 * b] += weight * (axial * dx[a] * dx[b] + shear * dy[a] * dy[b]);
                k[2 * a][2 * b + 1] += weight * (cross * dx[a] * dy[b] + shear * dy[a] * dx[b]);
                k[2 * a + 1][2 * b] += weight * (cross * dy[a] * dx[b] + shear * dx[a] * dy[b]);
                k[2 * a + 1][2 * b + 1] += weight * (axial * dy[a] * dy[b] + shear * dx[a] * dx[b]);
            }
        }
    }
}

static void assemble_stiffness(const struct bar *bar, struct equations *eq)
{
    static const size_t right[4] = {0, 1, 1, 0};
    static const size_t up[4] = {0, 0, 1, 1};

    for (size_t row = 0; row < bar->rows; row++) {
        double k[8][8];
        element_stiffness(bar, bar->width / BAR_COLUMNS, row_height(bar, row), k);
        for (size_t column = 0; column < BAR_COLUMNS; column++) {
            size_t at[8];
            for (size_t i = 0; i < 8; i++)
                at[i] = component(bar, column + right[i / 2], row + up[i / 2], i % 2);
            for (size_t i = 0; i < 8; i++)
                for (size_t j = 0; j < 8; j++)
                    if (at[i] >= at[j])
                        *entry(eq, at[i], at[j]) += k[i][j];
        }
    }
}

/* Consistent nodal loads: each edge gives half of its resultant to both of its ends. */
static void assemble_loads(const struct bar *bar, struct equations *eq)
{
    const double top = bar->top_pressure * bar->width / BAR_COLUMNS;
    for (size_t column = 0; column < BAR_COLUMNS; column++) {
        eq->load[component(bar, column, bar->rows, 1)] -= top / 2.0;
        eq->load[component(bar, column + 1, bar->rows, 1)] -= top / 2.0;
    }
    for (size_t row = 0; row < bar->rows; row++) {
        const double side = bar->side_pressure * row_height(bar, row);
        eq->load[component(bar, 0, row, 0)] += side / 2.0;
        eq->load[component(bar, 0, row + 1, 0)] += side / 2.0;
    }
}

/* Holds one component at zero. It stays as a decoupled row with its own diagonal entry, which is
 * how the library expects a held component of the contact side. */
static void hold(struct equations *eq, size_t held)
{
    for (size_t i = 0; i < eq->size; i++)
        if (i != held)
            *entry(eq, i, held) = 0.0;
    eq->load[held] = 0.0;
}

/* Eliminates the first `count` components by Cholesky's method (in its root-free form L D L').
 * The rest of the equations is S = K_cc - K_ci K_ii^-1 K_ic and f_c - K_ci K_ii^-1 f_i. */
static int eliminate(struct equations *eq, size_t count)
{
    const size_t n = eq->size;
    for (size_t k = 0; k < count; k++) {
        const double *pivot_column = &eq->stiffness[k * n];
        if (!(pivot_column[k] > 0.0))
            return -1;
        for (size_t j = k + 1; j < n; j++) {
            const double factor = pivot_column[j] / pivot_column[k];
            double *column = &eq->stiffness[j * n];
            if (factor == 0.0)
                continue;
            for (size_t i = j; i < n; i++)
                column[i] -= factor * pivot_column[i];
            eq->load[j] -= factor * eq->load[k];
        }
    }
    return 0;
}

/* Turns the contact side's components (u_x, u_y) into (d_n, d_t) = (-u_y, u_x). The stiffness turns
 * on both sides, so that only its mixed entries change their sign. */
static void to_contact_frame(const struct equations *eq, struct condensed_bar *condensed)
{
    static const size_t from[2] = {1, 0};
    static const double sign[2] = {-1.0, 1.0};
    const size_t first = eq->size - BAR_SIZE;

    for (size_t j = 0; j < BAR_SIZE; j++) {
        const size_t column = first + 2 * (j / 2) + from[j % 2];
        condensed->f[j] = sign[j % 2] * eq->load[column];
        for (size_t i = 0; i < BAR_SIZE; i++) {
            const size_t row = first + 2 * (i / 2) + from[i % 2];
            condensed->K[i + j * BAR_SIZE] = sign[i % 2] * sign[j % 2] * *entry(eq, row, column);
        }
    }
}

static int allocate(const struct bar *bar, struct equations *eq)
{
    eq->size = 2 * BAR_PAIRS * (bar->rows + 1);
    eq->stiffness = calloc(eq->size * eq->size, sizeof *eq->stiffness);
    eq->load = calloc(eq->size, sizeof *eq->load);
    return eq->stiffness != NULL && eq->load != NULL;
}

static void release(struct equations *eq)
{
    free(eq->stiffness);
    free(eq->load);
}

const char *bar_condense(const struct bar *bar, struct condensed_bar *condensed)
{
    struct equations eq;
    const char *problem = NULL;

    if (!allocate(bar, &eq)) {
        problem = "not enough memory for the stiffness matrix";
        goto done;
    }
    assemble_stiffness(bar, &eq);
    assemble_loads(bar, &eq);
    for (size_t row = 0; row <= bar->rows; row++)
        hold(&eq, component(bar, BAR_COLUMNS, row, 0));
    if (eliminate(&eq, eq.size - BAR_SIZE) != 0) {
        problem = "the stiffness matrix of the interior is not positive definite";
        goto done;
    }
    to_contact_frame(&eq, condensed);
done:
    release(&eq);
    return problem;
}

/* Copies the entries that are not zero, column by column. */
static int compress(const struct equations *eq, struct sparse_bar *sparse)
{
    const size_t n = eq->size;
    size_t used = 0;

    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++)
            sparse->entries += eq->stiffness[i + j * n] != 0.0;
    sparse->starts = malloc((n + 1) * sizeof *sparse->starts);
    sparse->rows = malloc(sparse->entries * sizeof *sparse->rows);
    sparse->values = malloc(sparse->entries * sizeof *sparse->values);
    if (sparse->starts == NULL || sparse->rows == NULL || sparse->values == NULL)
        return -1;
    for (size_t j = 0; j < n; j++) {
        sparse->starts[j] = (int64_t)used;
        for (size_t i = j; i < n; i++) {
            if (eq->stiffness[i + j * n] != 0.0) {
                sparse->rows[used] = (int64_t)i;
                sparse->values[used++] = eq->stiffness[i + j * n];
            }
        }
    }
    sparse->starts[n] = (int64_t)used;
    return 0;
}

const char *bar_assemble(const struct bar *bar, struct sparse_bar *sparse)
{
    struct equations eq;
    const char *problem = NULL;

    memset(sparse, 0, sizeof *sparse);
    sparse->held_count = bar->rows + 1;
    sparse->held = malloc(sparse->held_count * sizeof *sparse->held);
    if (!allocate(bar, &eq) || sparse->held == NULL) {
        problem = "not enough memory for the stiffness matrix";
        goto done;
    }
    assemble_stiffness(bar, &eq);
    assemble_loads(bar, &eq);
    for (size_t row = 0; row <= bar->rows; row++)
        sparse->held[row] = (int64_t)component(bar, BAR_COLUMNS, row, 0);
    for (size_t i = 0; i < BAR_SIZE; i++)
        sparse->contact[i] = (int64_t)component(bar, i / 2, 0, i % 2);
    sparse->size = eq.size;
    sparse->load = eq.load; /* moves */
    eq.load = NULL;
    if (compress(&eq, sparse) != 0)
        problem = "not enough memory for the sparse matrix";
done:
    release(&eq);
    return problem;
}

void bar_release(struct sparse_bar *sparse)
{
    free(sparse->starts);
    free(sparse->rows);
    free(sparse->values);
    free(sparse->load);
    free(sparse->held);
}
