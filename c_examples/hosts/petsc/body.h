/*
 * A cube that is pressed on a ball, or on a foundation of another mesh, and shifted:
 *
 *      +-----------+   held, moved down, tilted and shifted
 *      |   cube    |
 *      +-----------+   slave side
 *     ~ ball ~  or  +---------------+   master side
 *                   |  foundation   |
 *                   +---------------+   held
 *
 * Rows of PETSc are the unknowns of the library: displacements, and in the place of those of a slave
 * node the relative displacements d of its pair. u = T x, with T from the rows of the pairs,
 *
 *     D u_slave + sum w u_other = R d,   R = (n, t1, t2) as columns,
 *
 * and the matrix is A = T' K T, K the stiffness of the mesh; it is assembled brick by brick, T' k T.
 * Lengths in units of the cube's edge.
 */

#ifndef BODY_H
#define BODY_H

#include "signorini_surface.h"

#include <petscksp.h>

enum { MOST_BOXES_OF_BODY = 2 };

struct body {
    PetscInt boxes, nodes, unknowns;
    PetscInt edge[MOST_BOXES_OF_BODY];      /* nodes of a box along x and y, */
    PetscInt layers[MOST_BOXES_OF_BODY];    /* and along z */
    double height;                          /* of the cube, or of a plate in its place */
    PetscInt first[MOST_BOXES_OF_BODY + 1]; /* first node of a box */
    double *at;                             /* coordinates of the nodes */
    signorini_surface_pairs *contact;
    signorini_surface_data pairs;
    int64_t *place;                         /* the unknown of each component of d */
    Mat A;                                  /* fixed unknowns are rows of their own */
    Vec load;                               /* of A: what the motion of the supports loads */
    MatNullSpace rigid;                     /* rigid motions in x, for GAMG */
};

/*
 * Collective. `edge` nodes along x and y, `layers` along z, in bricks that are cubes; of the foundation as
 * many along each edge; 0: the ball. Of a plate its motion is smaller and the ball is larger.
 */
PetscErrorCode body_new(PetscInt edge, PetscInt layers, PetscInt of_foundation, struct body *body);

PetscErrorCode body_free(struct body *body);

/* The displacement of a node that a support holds, and whether one does. */
int body_held(const struct body *body, PetscInt node, double u[3]);

/* The coordinate of the nodes of a line across an axis. */
double body_line(const struct body *body, PetscInt box, int axis, PetscInt node);

/* The node at the crossing of three lines of a box. */
PetscInt body_node(const struct body *body, PetscInt box, PetscInt i, PetscInt j, PetscInt k);

/* R of a pair: its normal and tangents. */
void body_frame(const struct body *body, int64_t pair, double R[3][3]);

/* Collective: A without supports (body_matrix.c). */
PetscErrorCode body_assemble(struct body *body);

#endif
