/*
 * The finite-element side of the bolted junction: a small stand-in for your own code.
 *
 *      z, mm                                  closing
 *      165                            +-------vvvvvvv-------+
 *                                     |          C          |  pressing ring
 *      150  +-------------------------2========2+  3=======3
 *           |           B, cover                |  |       |   2, 3: contact with the ring
 *      120  +-----------1=======================1--+       |   1: the seal
 *           ^    inner  |                                  |
 *           ^ pressure >|                A                 |
 *       80  |          >|        +-------^^^^^^^-----------+   the closing load's opposite
 *           |          >|        |
 *        0  |          >|oooooooo|                    u_z = 0
 *           0          40       60       80   90  100     120  r, mm
 *        the axis
 *
 * Axial symmetry, four-node quadrilaterals of 2.5 mm with 2x2 Gauss points, integrated over the
 * whole circumference: forces are in N, lengths in mm, stresses in MPa. The parts A, B and C have
 * their own nodes, which match where they touch.
 */

#ifndef JUNCTION_MESH_H
#define JUNCTION_MESH_H

#include <stddef.h>
#include <stdint.h>

enum {
    GRID_R = 49, /* lines of the grid that all parts lie on */
    GRID_Z = 67,
    PARTS = 3,
    ZONES = 3,
    NODES = 1613,
    ELEMENTS = 1440,
    PAIRS = 43,       /* contact pairs */
    SIZE = 2 * PAIRS, /* a normal and a tangential component for each */
    DOFS = 2 * NODES, /* u_r and u_z of node i are 2 i and 2 i + 1 */
    FIXED = 22,
    NEIGHBOURS = 9 /* at most, a node itself included */
};

struct junction {
    double r[NODES], z[NODES];
    int part[NODES]; /* 0 to 2: A to C */
    int32_t node_at[PARTS][GRID_Z][GRID_R]; /* -1: none */
    int32_t corners[ELEMENTS][4];           /* anticlockwise */
    int32_t lower[PAIRS], upper[PAIRS];     /* the two nodes of a pair; the surface is level */
    int zone[PAIRS];                        /* 1 to 3, each from its smallest radius outward */
    int64_t fixed[FIXED];                   /* components that supports fix */

    /* The stiffness matrix without supports, both triangles, in compressed columns. */
    int32_t starts[DOFS + 1];
    int32_t rows[4 * NEIGHBOURS * NODES];
    double values[4 * NEIGHBOURS * NODES];
};

/* Meshes and assembles the junction. NULL if there is not enough memory; free it by free(). */
struct junction *junction_new(void);

/* Nodal forces of the closing pressure on the ring and under the flange, and of the pressure
 * inside. */
void junction_loads(const struct junction *junction, double closing, double inner, double f[DOFS]);

/* Axial stress: at the nodes, extrapolated from the Gauss points and averaged over the elements;
 * and the mean of each element's Gauss points. */
void junction_stress(const struct junction *junction, const double u[DOFS], double at_nodes[NODES],
                     double of_elements[ELEMENTS]);

/* Largest of |K u - f| among the components that are not held. */
double junction_residual(const struct junction *junction, const double u[DOFS],
                         const double f[DOFS]);

#endif
