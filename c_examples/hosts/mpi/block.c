#include "block.h"

#include <stdlib.h>

static const struct material steel = {210000.0, 0.3};
static const double side = 10.0;                       /* of a brick */
static const double traction[3] = {3.0, 1.0, -12.0};   /* on the upper face, force / area */
static const double hollow = 8e-7;                     /* gap / square of the distance */
static const double friction = 0.4;

/* ---- Cuts ---------------------------------------------------------------------------------- */

/* The layer of nodes across x at which a part begins; that of part `parts` is the end. */
static int first_layer(int rank, int parts)
{
    return (int)((long)rank * LONG / parts);
}

static int layer_of(int32_t dof)
{
    return dof / 3 % (LONG + 1);
}

int part_holds(int rank, int parts, int32_t dof)
{
    const int layer = layer_of(dof);
    return first_layer(rank, parts) <= layer && layer <= first_layer(rank + 1, parts);
}

int block_owner(int parts, int32_t dof)
{
    int rank = parts - 1;
    while (!part_holds(rank, parts, dof))
        rank -= 1;
    return rank;
}

int32_t part_place(const struct part *part, int32_t dof)
{
    const int32_t line = dof / 3 / (LONG + 1); /* the node's line along x */
    const int32_t along = layer_of(dof) - first_layer(part->rank, part->parts);
    return 3 * (along + part->mesh->size[0][0] * line) + dof % 3;
}

static int32_t number_of(const struct part *part, int32_t place)
{
    const int32_t nodes = part->mesh->size[0][0];
    const int32_t along = place / 3 % nodes + first_layer(part->rank, part->parts);
    return 3 * (along + (LONG + 1) * (place / 3 / nodes)) + place % 3;
}

/* ---- Mesh and loads ------------------------------------------------------------------------ */

static struct brick_mesh *mesh_between(int first, int last)
{
    double x[LONG + 1], y[WIDE + 1], z[HIGH + 1];

    for (int i = first; i <= last; i++)
        x[i - first] = side * i;
    for (int i = 0; i <= WIDE; i++)
        y[i] = side * i;
    for (int i = 0; i <= HIGH; i++)
        z[i] = side * i;
    const struct box box = {{last - first, WIDE, HIGH}, {x, y, z}};
    return brick_mesh_new(1, &box, steel);
}

/* A quarter of what acts on each face goes to each of its nodes. */
static int load_top(struct part *part)
{
    const int64_t count = brick_faces(part->mesh, 0, 1, NULL);
    int64_t(*faces)[4] = malloc((size_t)count * sizeof *faces);

    if (faces == NULL)
        return 1;
    brick_faces(part->mesh, 0, 1, faces);
    for (int64_t i = 0; i < 4 * count; i++)
        for (int axis = 0; axis < 3; axis++)
            part->load[3 * faces[i / 4][i % 4] + axis] += traction[axis] * side * side / 4.0;
    free(faces);
    return 0;
}

int part_new(int rank, int parts, struct part *part)
{
    *part = (struct part){.rank = rank, .parts = parts};
    part->mesh = mesh_between(first_layer(rank, parts), first_layer(rank + 1, parts));
    if (part->mesh == NULL)
        return 1;
    part->number = malloc((size_t)part->mesh->dofs * sizeof *part->number);
    part->load = calloc((size_t)part->mesh->dofs, sizeof *part->load);
    if (part->number == NULL || part->load == NULL || load_top(part) != 0) {
        part_free(part);
        return 1;
    }
    for (int32_t place = 0; place < part->mesh->dofs; place++) {
        part->number[place] = number_of(part, place);
        if (block_held(part->number[place]))
            part->load[place] = 0.0; /* the support takes it */
    }
    return 0;
}

void part_free(struct part *part)
{
    brick_mesh_free(part->mesh);
    free(part->number);
    free(part->load);
    *part = (struct part){0};
}

int block_held(int32_t dof)
{
    return dof >= SIZE && layer_of(dof) == LONG;
}

/* ---- Contact ------------------------------------------------------------------------------- */

int32_t contact_component(int32_t dof)
{
    static const int component[3] = {1, 2, 0};
    return dof - dof % 3 + component[dof % 3];
}

double contact_sign(int32_t dof)
{
    return dof % 3 == 0 ? 1.0 : -1.0;
}

/* The ground is a ridge along y: it touches half-way, and falls away to both ends. */
void block_contact(double gap[PAIRS], double mu[PAIRS])
{
    for (int pair = 0; pair < PAIRS; pair++) {
        const double distance = side * (pair % (LONG + 1) - LONG / 2);
        gap[pair] = hollow * distance * distance;
        mu[pair] = friction;
    }
}
