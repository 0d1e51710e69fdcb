#include "slide.h"

#include <math.h>
#include <stddef.h>

static const struct material polymer = {3000.0, 0.3};
static const double bottom = -20.0, top = 12.0;

/* A hump along y, which fades towards the bottom; a ball at the underside, which fades upwards. */
static void bend(int box, double at[3])
{
    if (box == HUMP_BOX) {
        at[2] -= at[0] * at[0] / (2.0 * HUMP) * (at[2] - bottom) / -bottom;
    } else {
        at[2] += (at[0] * at[0] + at[1] * at[1]) / (2.0 * BALL) * (top - at[2]) / top;
        at[0] += START;
        at[2] -= START * START / (2.0 * (HUMP + BALL)); /* down to the hump */
    }
}

struct brick_mesh *slide_mesh(void)
{
    static const double deep[DEEP + 1] = {-20.0, -13.0, -8.0, -4.0, 0.0};
    double along[LONG + 1], across[BROAD + 1], wide[WIDE + 1], half[HALF + 1], high[HIGH + 1];

    for (int i = 0; i <= LONG; i++)
        along[i] = 80.0 / LONG * i - 40.0;
    for (int i = 0; i <= BROAD; i++)
        across[i] = 14.0 / BROAD * i;
    for (int i = 0; i <= WIDE; i++)
        wide[i] = 36.0 / WIDE * i - 18.0;
    for (int i = 0; i <= HALF; i++)
        half[i] = 12.0 / HALF * i;
    for (int i = 0; i <= HIGH; i++)
        high[i] = top / HIGH * i;
    const struct box boxes[2] = {{{LONG, BROAD, DEEP}, {along, across, deep}},
                                 {{WIDE, HALF, HIGH}, {wide, half, high}}};
    struct brick_mesh *mesh = brick_mesh_new(2, boxes, polymer);
    if (mesh != NULL)
        brick_mesh_move(mesh, polymer, bend);
    return mesh;
}

static signorini_faces faces_of(int64_t count, int64_t nodes[][4])
{
    return (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 4,
                             .count = count, .nodes = nodes[0]};
}

signorini_faces slide_slave(const struct brick_mesh *mesh)
{
    static int64_t nodes[WIDE * HALF][4];
    const int64_t count = brick_faces(mesh, SLIDER, 0, nodes);
    return faces_of(count, nodes);
}

signorini_faces slide_master(const struct brick_mesh *mesh)
{
    static int64_t nodes[LONG * BROAD][4];
    const int64_t count = brick_faces(mesh, HUMP_BOX, 1, nodes);
    return faces_of(count, nodes);
}

int64_t slide_fixed(const struct brick_mesh *mesh, int64_t fixed[DOFS], double moves[DOFS])
{
    const int32_t driven = mesh->first[SLIDER] + LAYER * (HIGH - 1);
    int64_t count = 0;

    for (int32_t node = 0; node < mesh->nodes; node++) {
        const int at_bottom = mesh->at[node][2] == bottom, is_driven = node >= driven;
        const int is_held[3] = {at_bottom || is_driven,
                                at_bottom || is_driven || mesh->at[node][1] == 0.0, at_bottom};
        for (int axis = 0; axis < 3; axis++) {
            if (!is_held[axis])
                continue;
            moves[count] = is_driven && axis == 0;
            fixed[count++] = 3 * (int64_t)node + axis;
        }
    }
    return count;
}

void slide_load(const struct brick_mesh *mesh, double f[DOFS])
{
    for (int i = 0; i < DOFS; i++)
        f[i] = 0.0;
    for (int32_t node = mesh->nodes - LAYER; node < mesh->nodes; node++)
        f[3 * node + 2] = -PRESS / LAYER;
}

double slide_statics(double mu, double x)
{
    return tan(atan(mu) + atan(-x / (BALL + HUMP)));
}
