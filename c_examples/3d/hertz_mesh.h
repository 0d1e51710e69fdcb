/*
 * Two halves of space, cut down to two blocks of bricks around the contact of two balls.
 *
 * The lower block is -L <= x, y <= L, -L <= z <= 0, the upper block its mirror image. The mesh is
 * even around the contact, with square cells, and grows outwards and downwards from there. The cut
 * faces get the displacements that the rest of the half-space would give them (add_far_field).
 */

#ifndef HERTZ_MESH_H
#define HERTZ_MESH_H

#include "brick_contact.h"
#include "hertz_theory.h"

/* How the upper ball moves to the lower one, and the loads on the lower ball by contact. */
struct motion {
    double approach, shift, rotation; /* along -z, along x, about z */
    struct load press, friction;
};

struct hertz_mesh {
    double cell;               /* h: side of the cells at the contact */
    struct brick_mesh *bricks; /* box 0 is the lower block, box 1 the upper one */
    int line;                  /* pairs along a side of the contact square; row by row, x first */
    struct contact contact;
    double *gap;               /* of the pairs */
    int64_t n_fixed;
    int64_t *fixed;            /* the degrees of freedom of the cut faces */
};

/* Meshes and assembles, with 4 to 30 cells along the radius of the contact. Returns 0 if there is
 * not enough memory; hertz_mesh_free after that, too. */
int hertz_mesh_make(struct hertz_mesh *mesh, const struct hertz *hertz, int cells);

void hertz_mesh_free(struct hertz_mesh *mesh);

/* Displacements of the fixed degrees of freedom, in their order. */
void hertz_mesh_prescribe(const struct hertz_mesh *mesh, const struct hertz *hertz,
                          const struct motion *motion, double prescribed[]);

#endif
