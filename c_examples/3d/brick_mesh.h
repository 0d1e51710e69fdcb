/*
 * Boxes of 8-node bricks, meshed and assembled: a small stand-in for your own code.
 *
 * Node i has the degrees of freedom 3 i, 3 i + 1 and 3 i + 2: u_x, u_y, u_z. Every box has nodes of
 * its own, also where two boxes touch: contact joins them.
 */

#ifndef BRICK_MESH_H
#define BRICK_MESH_H

#include "brick_element.h"

#include <stdint.h>

enum { MOST_BOXES = 2 };

struct box {
    int cells[3];           /* bricks along x, y, z */
    const double *lines[3]; /* cells + 1 ascending coordinates along x, y, z */
};

struct brick_mesh {
    int boxes;
    int32_t nodes, bricks, dofs;
    int32_t first[MOST_BOXES + 1]; /* first node of each box; the last entry is `nodes` */
    int32_t size[MOST_BOXES][3];   /* nodes of each box along x, y, z */
    double (*at)[3];               /* coordinates of the nodes */
    int64_t (*corners)[8];         /* nodes of the bricks, in the order of VTK_HEXAHEDRON */

    /* The stiffness matrix without supports, both triangles, in compressed columns. */
    int32_t *starts, *rows;
    double *values;
};

/* Meshes and assembles boxes of one material. NULL if there is not enough memory. */
struct brick_mesh *brick_mesh_new(int boxes, const struct box box[], struct material material);

/* Moves all nodes, as to curved surfaces, and assembles anew. */
void brick_mesh_move(struct brick_mesh *mesh, struct material material,
                     void (*move)(int box, double at[3]));

void brick_mesh_free(struct brick_mesh *mesh);

/* The node at the crossing of three lines of a box. */
int32_t brick_node(const struct brick_mesh *mesh, int box, int i, int j, int k);

/*
 * The faces of a box at its top, or at its bottom: the nodes of each, anticlockwise as seen from
 * outside. Returns their number; with `faces` NULL it does nothing else.
 */
int64_t brick_faces(const struct brick_mesh *mesh, int box, int top, int64_t faces[][4]);

/* residual = K u - f, the forces that hold the nodes; `dofs` entries each. */
void brick_residual(const struct brick_mesh *mesh, const double u[], const double f[],
                    double residual[]);

/* Sum of the nodal forces on a box, and of their moments about the origin. */
void brick_resultant(const struct brick_mesh *mesh, int box, const double f[], double force[3],
                     double moment[3]);

#endif
