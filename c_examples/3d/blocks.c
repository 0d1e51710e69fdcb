#include "blocks.h"

#include <math.h>

static const struct material steel = {210000.0, 0.3};
static const double pressed = 20.0; /* the press acts on the nodes with |x| and |y| up to here */

struct brick_mesh *blocks_mesh(void)
{
    double wide[WIDE + 1], narrow[NARROW + 1], deep[DEEP + 1], high[HIGH + 1];

    for (int i = 0; i <= WIDE; i++)
        wide[i] = COARSE * (i - WIDE / 2);
    for (int i = 0; i <= NARROW; i++)
        narrow[i] = FINE * (i - NARROW / 2);
    for (int i = 0; i <= DEEP; i++)
        deep[i] = COARSE * (i - DEEP);
    for (int i = 0; i <= HIGH; i++)
        high[i] = FINE * i;
    const struct box boxes[2] = {{{WIDE, WIDE, DEEP}, {wide, wide, deep}},
                                 {{NARROW, NARROW, HIGH}, {narrow, narrow, high}}};
    return brick_mesh_new(2, boxes, steel);
}

static signorini_faces faces_of(int64_t count, int64_t nodes[][4])
{
    return (signorini_faces){.struct_size = sizeof(signorini_faces),
                             .face_nodes = 4,
                             .count = count,
                             .nodes = nodes[0]};
}

signorini_faces blocks_slave(const struct brick_mesh *mesh)
{
    static int64_t nodes[NARROW * NARROW][4];
    const int64_t count = brick_faces(mesh, UPPER, 0, nodes);
    return faces_of(count, nodes);
}

signorini_faces blocks_master(const struct brick_mesh *mesh)
{
    static int64_t nodes[WIDE * WIDE][4];
    const int64_t count = brick_faces(mesh, LOWER, 1, nodes);
    return faces_of(count, nodes);
}

void blocks_fixed(int64_t fixed[FIXED])
{
    for (int i = 0; i < FIXED; i++) /* the lowest layer of the lower block is numbered first */
        fixed[i] = i;
}

void blocks_loads(const struct brick_mesh *mesh, double twist, double f[DOFS])
{
    double squares = 0.0; /* of the radii */
    int inner = 0;

    for (int i = 0; i < DOFS; i++)
        f[i] = 0.0;
    for (int top = 0; top < PAIRS; top++) {
        const double *at = mesh->at[brick_node(mesh, UPPER, top % LINE, top / LINE, HIGH)];
        squares += at[0] * at[0] + at[1] * at[1];
        inner += fabs(at[0]) <= pressed && fabs(at[1]) <= pressed;
    }
    for (int top = 0; top < PAIRS; top++) {
        const int32_t node = brick_node(mesh, UPPER, top % LINE, top / LINE, HIGH);
        const double *at = mesh->at[node];
        /* Across the radius and in proportion to it: no resultant but the moment. */
        f[3 * node] = -twist * at[1] / squares;
        f[3 * node + 1] = twist * at[0] / squares;
        if (fabs(at[0]) <= pressed && fabs(at[1]) <= pressed)
            f[3 * node + 2] = -PRESS / inner;
    }
}
