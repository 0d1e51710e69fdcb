/*
 * The part of one process of a block on an uneven ground, cut across x:
 *
 *      z        pressure and traction
 *      |     v  v  v  v  v  v  v  v  v
 *      |    +-----+-----+-----+-----+|
 *      |    |  0  |  1  |  2  |  3  |o|   held in all directions, but for the contact nodes
 *      |    +-----+-----+-----+-----+
 *      |    =========================     contact nodes on the ground
 *      +------------------------------- x
 *
 * Each process meshes, assembles and loads its own bricks. Nodes on a cut belong to two parts: what
 * the parts tell of them, entries of the matrix and nodal loads, is to be added.
 *
 * A degree of freedom of the whole block has one number on all processes, from 0. The lowest SIZE of
 * them are those of the contact nodes. Lengths in mm, forces in N.
 */

#ifndef BLOCK_H
#define BLOCK_H

#include "../../3d/brick_mesh.h"
#define SIGNORINI_UNSTABLE /* for operators, which may still change */
#include "signorini.h"

enum {
    LONG = 24, WIDE = 6, HIGH = 6,     /* bricks along x, y, z */
    PAIRS = (LONG + 1) * (WIDE + 1),   /* the contact nodes */
    SIZE = 3 * PAIRS,
    TOTAL = SIZE * (HIGH + 1),         /* degrees of freedom of the whole block */
    HELD = 3 * (WIDE + 1) * HIGH       /* of these, held */
};

struct part {
    int rank, parts;
    struct brick_mesh *mesh; /* the bricks of this part */
    int32_t *number;         /* of the mesh's degrees of freedom in the whole block */
    double *load;            /* of the part's faces; mesh->dofs entries */
};

/*
 * Makes part `rank` of `parts`, at most LONG of them. Part 0 of 1 is the whole block, and there
 * number[i] is i. Returns 0, or 1 if there is not enough memory.
 */
int part_new(int rank, int parts, struct part *part);

void part_free(struct part *part);

/* Nonzero if the support holds the degree of freedom. */
int block_held(int32_t dof);

/* Nonzero if a part holds the degree of freedom; the part that owns it: of two on a cut the right one. */
int part_holds(int rank, int parts, int32_t dof);
int block_owner(int parts, int32_t dof);

/* The place of a degree of freedom in a part that holds it. */
int32_t part_place(const struct part *part, int32_t dof);

/*
 * The library's (n, t1, t2) with n = (0, 0, -1), t1 = (1, 0, 0), t2 = (0, -1, 0): the component that
 * belongs to a degree of freedom of a contact node, and its sign.
 */
int32_t contact_component(int32_t dof);
double contact_sign(int32_t dof);

/* Gaps and coefficients of friction of the pairs. */
void block_contact(double gap[PAIRS], double mu[PAIRS]);

#endif
