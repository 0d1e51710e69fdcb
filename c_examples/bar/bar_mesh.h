/*
 * The finite-element side of the bar on the plane: a small stand-in for your own code.
 *
 *                       top_pressure
 *                 | | | | | | | | | | |
 *                 v v v v v v v v v v v
 *               +-----------------------+|
 *            -->|                       |o|   symmetry: u_x = 0 on x = width
 *   side     -->|      E, nu, plane     |o|
 *   pressure -->|         strain        |o|
 *            -->|                       |o|
 *               1=======================33    contact with a rigid plane, y = 0
 *               //////////////////////////    nodes 1 (free corner) to 33 (symmetry)
 *
 * Four-node quadrilaterals with 2x2 Gauss points, 32 equal columns; row heights grow from the
 * contact side by a constant ratio. Lengths in mm, forces in daN for 1 mm of thickness.
 */

#ifndef BAR_MESH_H
#define BAR_MESH_H

#include <stddef.h>
#include <stdint.h>

enum {
    BAR_COLUMNS = 32,
    BAR_PAIRS = BAR_COLUMNS + 1, /* contact nodes, each facing the plane */
    BAR_SIZE = 2 * BAR_PAIRS     /* a normal and a tangential component for each */
};

struct bar {
    double width, height;
    double young, poisson;
    double top_pressure, side_pressure; /* both pushing inward */
    size_t rows;
    double ratio; /* height of a row / height of the row below it */
};

/*
 * The library's arguments, pair by pair (n, t), with n = (0, -1) the outward normal of the contact
 * side and t = (1, 0): d_n = -u_y, d_t = u_x.
 */
struct condensed_bar {
    double K[BAR_SIZE * BAR_SIZE]; /* column-major, both triangles */
    double f[BAR_SIZE];
};

/*
 * Assembles the bar and eliminates every component that is not on the contact side.
 * Returns NULL, or a message that says what went wrong.
 */
const char *bar_condense(const struct bar *bar, struct condensed_bar *condensed);

/* The whole bar, as a host with a sparse solver has it: nothing eliminated, supports apart. */
struct sparse_bar {
    size_t size, entries;
    int64_t *starts, *rows; /* lower triangle by columns, counted from 0 */
    double *values;
    double *load;
    size_t held_count;
    int64_t *held;              /* components that the symmetry holds */
    int64_t contact[BAR_SIZE];  /* u_x and u_y of each contact node */
};

/*
 * Assembles the bar. Returns NULL, or a message that says what went wrong. bar_release is needed
 * in both cases.
 */
const char *bar_assemble(const struct bar *bar, struct sparse_bar *sparse);

void bar_release(struct sparse_bar *sparse);

#endif
