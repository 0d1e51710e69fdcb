/*
 * A block of 3 by 2 elements with four nodes above a rigid plane: 12 nodes from the lower left to
 * the upper right, 24 degrees of freedom (x, y by turns), plane strain, E = 1000, nu = 0.3.
 *
 * Right as it is. A test changes what a user would get wrong, and calls small_block_run.
 */

#ifndef SMALL_BLOCK_H
#define SMALL_BLOCK_H

#include "everything.h"

#include <string.h>

enum { ACROSS = 4, UP = 3, NODES = ACROSS * UP, DOFS = 2 * NODES, PAIRS = ACROSS };

static struct small_block {
    double dense[DOFS * DOFS]; /* column-major, both triangles */
    /* Lower triangle by columns, counted from 0, in both widths. */
    int32_t col_start[DOFS + 2], row[DOFS * DOFS];
    int64_t wide_start[DOFS + 2], wide_row[DOFS * DOFS];
    double values[DOFS * DOFS];
    int64_t n_fixed, fixed[DOFS], slaves[2 * PAIRS], masters[2 * PAIRS], master_start[PAIRS + 1];
    double weights[PAIRS], normals[2 * PAIRS], f[DOFS + 2], gap[PAIRS], mu[PAIRS];
    signorini_sparse K;
    signorini_pairs pairs;
    signorini_report report;
    double d[2 * PAIRS], F[2 * PAIRS], u[DOFS + 2];
    char sentence[512]; /* of the call that ended it */
} block;

static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/* Adds a unit square by 2 x 2 Gauss points. */
static void add_element(const int *node)
{
    const double lambda = 1000 * 0.3 / (1.3 * 0.4), mu = 1000 / 2.6, g = 0.57735026918962576;
    for (int point = 0; point < 4; point++) {
        double h[4][2];
        const double at[2] = {0.5 + g * (corner[point][0] - 0.5), 0.5 + g * (corner[point][1] - 0.5)};
        for (int i = 0; i < 4; i++) {
            const double along = corner[i][0] ? at[0] : 1 - at[0];
            const double up = corner[i][1] ? at[1] : 1 - at[1];
            h[i][0] = (corner[i][0] ? 1 : -1) * up;
            h[i][1] = (corner[i][1] ? 1 : -1) * along;
        }
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                for (int p = 0; p < 2; p++)
                    for (int q = 0; q < 2; q++) {
                        double value = lambda * h[i][p] * h[j][q] + mu * h[i][q] * h[j][p];
                        if (p == q) value += mu * (h[i][0] * h[j][0] + h[i][1] * h[j][1]);
                        block.dense[2 * node[i] + p + DOFS * (2 * node[j] + q)] += 0.25 * value;
                    }
    }
}

/* Stores one triangle or all of the first `size` rows and columns, zeros left out. */
static void store(int size, int triangle, int base)
{
    int nnz = 0;
    for (int j = 0; j < size; j++) {
        block.col_start[j] = nnz + base;
        for (int i = 0; i < size; i++) {
            const double value = i < DOFS && j < DOFS ? block.dense[i + DOFS * j] : 0;
            const int left_out = (triangle == SIGNORINI_TRIANGLE_LOWER && i < j) ||
                                 (triangle == SIGNORINI_TRIANGLE_UPPER && i > j);
            if (value == 0 || left_out) continue;
            block.row[nnz] = i + base;
            block.values[nnz++] = value;
        }
    }
    block.col_start[size] = nnz + base;
    for (int j = 0; j <= size; j++) block.wide_start[j] = block.col_start[j];
    for (int k = 0; k < nnz; k++) block.wide_row[k] = block.row[k];
    block.K = (signorini_sparse){.struct_size = sizeof block.K, .index_bytes = 4,
                                 .triangle = triangle, .size = size, .nnz = nnz,
                                 .index_base = base, .col_start = block.col_start,
                                 .row = block.row, .values = block.values};
}

/* The block as it should be: pressed down, x = 0 a plane of symmetry, friction 0.3. */
static void small_block_prepare(void)
{
    memset(&block, 0, sizeof block);
    for (int j = 0; j + 1 < UP; j++)
        for (int i = 0; i + 1 < ACROSS; i++) {
            const int first = i + ACROSS * j;
            add_element((const int[4]){first, first + 1, first + ACROSS + 1, first + ACROSS});
        }
    store(DOFS, SIGNORINI_TRIANGLE_LOWER, 0);
    for (int j = 0; j < UP; j++) block.fixed[block.n_fixed++] = 2 * ACROSS * j;
    for (int i = 0; i < PAIRS; i++) {
        block.slaves[2 * i] = 2 * i;
        block.slaves[2 * i + 1] = 2 * i + 1;
        block.master_start[i + 1] = i + 1;
        block.masters[2 * i] = 2 * (NODES - 1 - i);
        block.masters[2 * i + 1] = 2 * (NODES - 1 - i) + 1;
        block.weights[i] = 1;
        block.normals[2 * i + 1] = -1;
        block.mu[i] = 0.3;
        block.f[2 * (NODES - 1 - i) + 1] = -1;
    }
    block.pairs = (signorini_pairs){.struct_size = sizeof block.pairs, .dim = 2, .count = PAIRS,
                                    .slaves = block.slaves, .normals = block.normals};
    block.report.struct_size = sizeof block.report;
}

/* Makes the model, solves and recovers; the first status that is not 0. */
static int32_t small_block_run(void)
{
    signorini_model *model;
    int32_t status =
        signorini_model_new_sparse(&block.K, block.n_fixed, block.fixed, &block.pairs, NULL, &model);
    strcpy(block.sentence, signorini_last_error());
    if (status != 0) return status;
    status = signorini_model_solve(model, 1, block.f, NULL, block.gap, SIGNORINI_LAW_COULOMB,
                                   block.mu, NULL, NULL, block.d, block.F, NULL, NULL,
                                   &block.report, NULL);
    if (status == 0) status = signorini_model_recover(model, 1, block.f, NULL, block.d, block.u);
    strcpy(block.sentence, signorini_last_error());
    signorini_model_free(model);
    return status;
}

#endif
