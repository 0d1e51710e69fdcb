/*
 * The host's mesh of the two blocks, with supports and loads. The nodes of the blocks do not match.
 *
 *        z                 | press
 *        |            +----v----+
 *     15 |            |  upper  |<- twist about z, by forces on its top face
 *      0 |        +---+=========+---+      9 x 9 nodes of the upper block on 11 x 11 of the lower one
 *        |        |      lower      |
 *    -40 |        +-----------------+      held
 *                -50 -30   0   30  50   x, y
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
    LINE = NARROW + 1,    /* nodes along a side of the contact; row by row, x first */
    PAIRS = LINE * LINE,  /* one for each of them */
    SIZE = 3 * PAIRS,
    NODES = (WIDE + 1) * (WIDE + 1) * (DEEP + 1) + LINE * LINE * (HIGH + 1),
    DOFS = 3 * NODES,
    FIXED = 3 * (WIDE + 1) * (WIDE + 1), /* they have the lowest numbers */
};

#define COARSE 10.0    /* side of a cell of the lower block */
#define FINE 7.5       /* and of the upper one */
#define PRESS 40000.0  /* force on the upper block, downwards */

/* NULL if there is not enough memory. */
struct brick_mesh *blocks_mesh(void);

/* The faces of the upper block that may touch, the slave, and of the lower one, the master. */
signorini_faces blocks_slave(const struct brick_mesh *mesh);
signorini_faces blocks_master(const struct brick_mesh *mesh);

/* The degrees of freedom of the bottom. */
void blocks_fixed(int64_t fixed[FIXED]);

/* Nodal loads: the press, and a moment about z, N mm. */
void blocks_loads(const struct brick_mesh *mesh, double twist, double f[DOFS]);

#endif
