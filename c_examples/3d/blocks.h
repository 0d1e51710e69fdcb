/*
 * The host's part of the two blocks: mesh, supports, pairs and loads.
 *
 *        z                 | press
 *        |            +----v----+
 *     20 |            |  upper  |<- twist about z, by forces on its top face
 *      0 |        +---+=========+---+      contact: 9 x 9 pairs of nodes
 *        |        |      lower      |
 *    -40 |        +-----------------+      held
 *                -50 -40   0   40  50   x, y
 *
 * Lengths in mm, forces in N, stresses in MPa.
 */

#ifndef BLOCKS_H
#define BLOCKS_H

#include "brick_contact.h"

enum {
    LOWER, UPPER,         /* the boxes of the mesh */
    WIDE = 10, DEEP = 4,  /* cells of the lower block, along x and y, and along z */
    NARROW = 8, HIGH = 2, /* cells of the upper block */
    LINE = NARROW + 1,    /* pairs along a side of the contact; row by row, x first */
    PAIRS = LINE * LINE,
    SIZE = 3 * PAIRS,
    NODES = (WIDE + 1) * (WIDE + 1) * (DEEP + 1) + LINE * LINE * (HIGH + 1),
    DOFS = 3 * NODES,
    FIXED = 3 * (WIDE + 1) * (WIDE + 1), /* they have the lowest numbers */
};

#define CELL 10.0      /* side of a cell */
#define PRESS 40000.0  /* force on the upper block, downwards */

/* NULL if there is not enough memory. */
struct brick_mesh *blocks_mesh(void);

/* The nodes of the pairs. `contact` has room for PAIRS of them. */
void blocks_pairs(const struct brick_mesh *mesh, struct contact *contact);

/* The degrees of freedom of the bottom. */
void blocks_fixed(int64_t fixed[FIXED]);

/* Nodal loads: the press, and a moment about z, N mm. */
void blocks_loads(const struct brick_mesh *mesh, double twist, double f[DOFS]);

/* The area that each pair stands for. */
void blocks_areas(double area[PAIRS]);

#endif
