/*
 * A cube of EDGE^3 nodes with three degrees of freedom each: K = L x M, with L the Laplacian of the graph in which each
 * node has its up to 26 neighbours, and M a definite matrix of three rows. The upper face is fixed, the lower one stands
 * over a rigid plane. Its factorisation has small subtrees and large panels.
 */

#ifndef LATTICE_H
#define LATTICE_H

#include "everything.h"

#include <stdlib.h>

typedef struct lattice {
    int64_t edge, size, n_fixed, *col_start, *row, *fixed, *slaves;
    double *values, *normals, *load, *gap, *mu;
    signorini_sparse K;
    signorini_pairs pairs;
} lattice;

static inline void *lattice_array(int64_t count)
{
    void *array = calloc((size_t)count, sizeof(double));
    if (!array) abort();
    return array;
}

static inline void lattice_free(lattice *l)
{
    free(l->col_start), free(l->row), free(l->fixed), free(l->slaves);
    free(l->values), free(l->normals), free(l->load), free(l->gap), free(l->mu);
}

/* The neighbours of a node with larger numbers, and how many it has in all. */
static inline int lattice_neighbours(int64_t edge, int64_t node, int64_t *larger, int *all)
{
    const int64_t x = node % edge, y = node / edge % edge, z = node / (edge * edge);
    int count = 0;
    *all = 0;
    for (int64_t c = z - 1; c <= z + 1; c++)
        for (int64_t b = y - 1; b <= y + 1; b++)
            for (int64_t a = x - 1; a <= x + 1; a++) {
                const int64_t other = a + edge * (b + edge * c);
                const int inside = a >= 0 && a < edge && b >= 0 && b < edge && c >= 0 && c < edge;
                if (!inside || other == node) continue;
                ++*all;
                if (other > node) larger[count++] = other;
            }
    return count;
}

static inline lattice lattice_new(int64_t edge)
{
    const int64_t face = edge * edge, nodes = face * edge;
    lattice l = {.edge = edge, .size = 3 * nodes};
    l.col_start = lattice_array(l.size + 1);
    l.row = lattice_array(3 * l.size * 14);
    l.values = lattice_array(3 * l.size * 14);
    l.fixed = lattice_array(3 * face);
    l.slaves = lattice_array(3 * face);
    l.normals = lattice_array(3 * face);
    l.load = lattice_array(l.size);
    l.gap = lattice_array(face);
    l.mu = lattice_array(face);
    int64_t entries = 0;
    for (int64_t j = 0; j < l.size; j++) {
        int64_t larger[26];
        int all;
        const int count = lattice_neighbours(edge, j / 3, larger, &all);
        for (int k = -1; k < count; k++)
            for (int64_t axis = k < 0 ? j % 3 : 0; axis < 3; axis++) {
                l.row[entries] = 3 * (k < 0 ? j / 3 : larger[k]) + axis;
                l.values[entries++] = (k < 0 ? all : -1) * (axis == j % 3 ? 1.1 : 0.1);
            }
        l.col_start[j + 1] = entries;
    }
    for (int64_t i = 0; i < 3 * face; i++) {
        l.slaves[i] = i;
        l.fixed[l.n_fixed++] = l.size - 3 * face + i;
        l.normals[i] = i % 3 == 2 ? -1 : 0;
    }
    for (int64_t i = 0; i < face; i++) {
        l.gap[i] = 1e-3 * (double)(i % 7);
        l.mu[i] = 0.3;
    }
    for (int64_t i = 0; i < nodes; i++) {
        l.load[3 * i] = 0.2 * (double)(i % 3);
        l.load[3 * i + 2] = -1;
    }
    l.K = (signorini_sparse){.struct_size = sizeof l.K, .index_bytes = 8, .size = l.size, .nnz = entries,
                             .triangle = SIGNORINI_TRIANGLE_LOWER, .col_start = l.col_start,
                             .row = l.row, .values = l.values};
    l.pairs = (signorini_pairs){.struct_size = sizeof l.pairs, .dim = 3, .count = face,
                                .slaves = l.slaves, .normals = l.normals};
    return l;
}

#endif
