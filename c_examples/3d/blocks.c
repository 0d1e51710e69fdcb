#include "blocks.h"

#include <math.h>

static const struct material steel = {210000.0, 0.3};
static const double pressed = 20.0; /* the press acts on the nodes with |x| and |y| up to here */

struct brick_mesh *blocks_mesh(void)
{
    double wide[WIDE + 1], narrow[NARROW + 1], deep[DEEP + 1], high[HIGH + 1];

    for (int i = 0; i <= WIDE; i++)
        wide[i] = CELL * (i - WIDE / 2);
    for (int i = 0; i <= NARROW; i++)
        narrow[i] = CELL * (i - NARROW / 2);
    for (int i = 0; i <= DEEP; i++)
        deep[i] = CELL * (i - DEEP);
    for (int i = 0; i <= HIGH; i++)
        high[i] = CELL * i;
    const struct box boxes[2] = {{{WIDE, WIDE, DEEP}, {wide, wide, deep}},
                                 {{NARROW, NARROW, HIGH}, {narrow, narrow, high}}};
    return brick_mesh_new(2, boxes, steel);
}

void blocks_pairs(const struct brick_mesh *mesh, struct contact *contact)
{
    const int rim = (WIDE - NARROW) / 2;

    contact->pairs = PAIRS;
    for (int pair = 0; pair < PAIRS; pair++) {
        const int i = pair % LINE, j = pair / LINE;
        contact->lower[pair] = brick_node(mesh, LOWER, i + rim, j + rim, DEEP);
        contact->upper[pair] = brick_node(mesh, UPPER, i, j, 0);
    }
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

void blocks_areas(double area[PAIRS])
{
    for (int pair = 0; pair < PAIRS; pair++) {
        const int i = pair % LINE, j = pair / LINE;
        area[pair] = CELL * CELL * (i % NARROW == 0 ? 0.5 : 1.0) * (j % NARROW == 0 ? 0.5 : 1.0);
    }
}
