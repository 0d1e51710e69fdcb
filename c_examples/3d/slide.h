/*
 * The host's mesh of a body that slides over a hump, with supports and loads: half of it, y >= 0.
 *
 *        z                        | press, constant
 *        |                   +----v----+
 *        |        driven --> |  slider |        bottom: a ball of radius BALL
 *      0 |       ___---------+--.___.--+----___
 *        |   +--                                --+    top: a round bar along y, of radius HUMP
 *    -20 |   +------------------------------------+    held
 *           -40                 0                40   x
 *
 * The two highest layers of nodes of the slider are driven along x: it does not turn, and is free
 * along z. With the middle of the slider at x = X the common tangent of the two surfaces has the
 * slope -X / (BALL + HUMP). Statics then gives the force that drives it, over the press:
 * tan(atan(mu) + atan(slope)).
 *
 * Along the plane of symmetry the slider, whose nodes are slaves, is coarser than the hump: the
 * guide says why, in "Planes of symmetry" of its chapter on pairs.
 *
 * Lengths in mm, forces in N, stresses in MPa.
 */

#ifndef SLIDE_H
#define SLIDE_H

#include "brick_contact.h"

enum {
    HUMP_BOX, SLIDER,                /* the boxes of the mesh */
    LONG = 40, BROAD = 5, DEEP = 4,  /* cells of the hump along x, y, z */
    WIDE = 13, HALF = 5, HIGH = 3,   /* cells of the slider */
    LAYER = (WIDE + 1) * (HALF + 1), /* nodes of the slider in a layer: the slaves */
    NODES = (LONG + 1) * (BROAD + 1) * (DEEP + 1) + LAYER * (HIGH + 1),
    DOFS = 3 * NODES,
};

#define BALL 100.0
#define HUMP 200.0
#define PRESS 3000.0  /* on the half that is modelled */
#define START (-24.0) /* of the middle of the slider */

/* NULL if there is not enough memory. The surfaces touch in a point. */
struct brick_mesh *slide_mesh(void);

/* The faces that may touch: of the slider, the slave, and of the hump, the master. */
signorini_faces slide_slave(const struct brick_mesh *mesh);
signorini_faces slide_master(const struct brick_mesh *mesh);

/* The degrees of freedom that are held or driven, and in `moves` 1 for those that are driven along
 * x. Returns their number. */
int64_t slide_fixed(const struct brick_mesh *mesh, int64_t fixed[DOFS], double moves[DOFS]);

/* Nodal loads: the press on the top of the slider. */
void slide_load(const struct brick_mesh *mesh, double f[DOFS]);

/* The driving force over the press, by statics, with the slider's middle at x. */
double slide_statics(double mu, double x);

#endif
