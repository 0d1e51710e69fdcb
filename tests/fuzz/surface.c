/* Pairs from two surfaces or a surface and an obstacle, and what a solution means on them. */

#include "fuzz.h"

enum { NODES = 18 };

/* Faces of 2 to 9 nodes, some over the grid of their side, some of any nodes. */
static signorini_faces *some_faces(int32_t dim, int64_t base, int64_t first, int64_t nodes)
{
    static const int counts[2][6] = {{2, 2, 3, 2, 2, 3}, {3, 4, 4, 6, 8, 9}};
    const int each = sane() || !rarely(16) ? counts[dim - 2][between(0, 5)] : (int)between(0, 12);
    const int64_t count = between(0, 3);
    signorini_faces *faces = input(1, sizeof *faces);
    faces->struct_size = sizeof *faces;
    faces->count = count;
    int64_t *of = input((size_t)(each * count), sizeof *of);
    for (int64_t i = 0; i < each * count; i++) {
        of[i] = base + first + (i % each + i / each + between(0, 1)) % nodes;
        if (!sane() && rarely(8)) of[i] += between(-20, 20);
    }
    faces->nodes = of;
    if (rarely(2)) {
        int64_t *start = input((size_t)count + 1, sizeof *start);
        for (int64_t i = 0; i <= count; i++) start[i] = base + each * i;
        if (!sane() && rarely(4) && count > 0) start[between(0, count - 1)] += between(-2, 2);
        faces->start = start;
    } else {
        faces->face_nodes = each;
    }
    return faces;
}

static void use(const signorini_surface_pairs *contact, int32_t dim, int64_t nodes)
{
    const int64_t pairs = surface_data(contact).pairs, n = dim * pairs;
    REQUIRE(pairs >= 0 && pairs <= nodes && surface_data(contact).summary[0] != '\0');
    const double *gaps = surface_data(contact).gaps, *areas = surface_data(contact).areas;
    const double *normals = surface_data(contact).normals;
    const double *tangents = surface_data(contact).tangents;
    REQUIRE(pairs == 0 || surface_data(contact).rows->count == pairs);
    for (int64_t i = 0; i < pairs; i++) {
        double square = 0, across = 0;
        for (int c = 0; c < dim; c++) {
            square += normals[dim * i + c] * normals[dim * i + c];
            across += normals[dim * i + c] * tangents[dim * i + c];
        }
        /* Coordinates of 1e308 have no finite distances. */
        if (sane()) REQUIRE(isfinite(gaps[i]) && isfinite(areas[i]));
        REQUIRE(fabs(square - 1) < 1e-12 && fabs(across) < 1e-12);
    }
    const double *d = numbers(n), *F = numbers(n), *point = rarely(2) ? numbers(dim) : NULL;
    int32_t *state = input((size_t)pairs, sizeof *state);
    for (int64_t i = 0; i < pairs; i++) state[i] = (int32_t)between(0, sane() ? 2 : 3);
    signorini_contact_fields *fields = input(1, sizeof *fields);
    fields->struct_size = sizeof *fields;
    fields->pressure = or_null(outputs(nodes), 8);
    fields->traction = or_null(outputs(dim * nodes), 8);
    fields->clearance = or_null(outputs(nodes), 8);
    fields->slip = or_null(outputs(dim * nodes), 8);
    fields->state = or_null(states(nodes), 8);
    signorini_resultant *resultant = output(1, sizeof *resultant);
    resultant->struct_size = sizeof *resultant;
    arm();
    int32_t status = signorini_surface_fields(contact, NULL, NULL, d, F, state, fields);
    check_arrays(status);
    check_status(status, 7);
    arm();
    status = signorini_surface_resultant(contact, NULL, d, F, point, resultant);
    check_arrays(status);
    check_status(status, 6);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    const int32_t dim = (int32_t)between(2, 3);
    const int64_t half = between(2, NODES / 2), nodes = 2 * half, base = rarely(2);
    double *x = input((size_t)(dim * nodes), sizeof *x);
    for (int64_t i = 0; i < nodes; i++) {
        /* Two grids, one above the other, each node moved a little. */
        x[dim * i] = (double)(i % half % 3);
        if (dim == 3) x[dim * i + 1] = (double)(i % half / 3);
        x[dim * i + dim - 1] = i < half ? 0 : 0.25;
        for (int c = 0; c < dim; c++) {
            if (rarely(2)) x[dim * i + c] += sane() ? (int8_t)byte() / 256.0 : number();
        }
    }
    const signorini_faces *slave = some_faces(dim, base, 0, half);
    const signorini_faces *master = some_faces(dim, base, half, half);
    signorini_surface_settings *settings = NULL;
    if (base || rarely(2)) {
        settings = input(1, sizeof *settings);
        REQUIRE(signorini_surface_settings_default(settings, sizeof *settings) == 0);
        settings->index_base = (int32_t)base;
        settings->pairing = (int32_t)between(0, sane() ? 1 : 2);
        if (rarely(4)) settings->normals = (int32_t)between(0, sane() ? 1 : 2);
        if (rarely(4)) settings->rims = (int32_t)between(0, sane() ? 1 : 2);
        if (rarely(4)) settings->search_distance = fabs(number());
        if (!sane() && rarely(8)) settings->dofs_per_node = (int32_t)between(-1, 7);
    }
    signorini_obstacle *obstacle = input(1, sizeof *obstacle);
    obstacle->struct_size = sizeof *obstacle;
    obstacle->kind = (int32_t)between(0, sane() ? 2 : 4);
    for (int c = 0; c < 3; c++) {
        obstacle->point[c] = number();
        obstacle->direction[c] = number();
    }
    obstacle->radius = sane() ? 0.5 + fabs(number()) : number();
    obstacle->hollow = rarely(2);
    const int rigid = rarely(3);
    signorini_surface_pairs *contact = NULL;
    arm();
    const int32_t status =
        rigid ? signorini_surface_pair_obstacle(dim, size_or_wrong(nodes), x, slave, obstacle,
                                                settings, &contact)
              : signorini_surface_pair(dim, size_or_wrong(nodes), x, slave, master, settings,
                                       &contact);
    check_arrays(status);
    check_status(status, 7);
    REQUIRE((status == 0) == (contact != NULL));
    if (!contact) return 0;
    use(contact, dim, nodes);
    signorini_surface_free(contact);
    return 0;
}
