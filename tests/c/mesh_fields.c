/* A mesh with fields in a .vtu file: what is read back by the rules of the format has the bits that were written. */

#include "check.h"

#include <stdlib.h>

enum { NODES = 5 };

static const char *const path = "mesh_fields.vtu";
static const double x[2 * NODES] = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0.5};
/* A quadrilateral and a triangle, counted from 1. */
static const int32_t types[2] = {9, 5};
static const int64_t start[3] = {1, 5, 8}, nodes[7] = {1, 2, 3, 4, 2, 5, 3};

static signorini_mesh the_mesh(void)
{
    return (signorini_mesh){.struct_size = sizeof(signorini_mesh), .dim = 2, .nodes = NODES,
        .coordinates = x, .cells = 2, .index_base = 1, .cell_types = types, .cell_start = start,
        .cell_nodes = nodes};
}

/* The place of a letter in the alphabet of base64; -1: none. */
static int digit(char letter)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = letter ? strchr(letters, letter) : NULL;
    return found ? (int)(found - letters) : -1;
}

/* Nonzero if the array `name` of the file has these bytes, behind their number. */
static int has(const char *file, const char *name, const void *bytes, size_t count)
{
    char mark[64];
    unsigned char data[512];
    uint64_t told;
    size_t length = 0;
    unsigned bits = 0, value = 0;
    snprintf(mark, sizeof mark, "Name=\"%s\"", name);
    const char *at = strstr(file, mark);
    at = at ? strchr(at, '\n') : NULL;
    for (at = at ? at + 1 : ""; digit(*at) >= 0 && length < sizeof data; at++) {
        value = (value << 6 | (unsigned)digit(*at)) & 0xFFFFFF;
        bits += 6;
        if (bits >= 8) data[length++] = (unsigned char)(value >> (bits -= 8));
    }
    memcpy(&told, data, sizeof told);
    return length == sizeof told + count && told == count && !memcmp(data + sizeof told, bytes, count);
}

static char *read_back(void)
{
    static char text[16384];
    FILE *file = fopen(path, "r");
    const size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
    text[length] = '\0';
    if (file) fclose(file);
    return text;
}

/* Vectors of the plane have a third component of 0 in the file. */
static const double *in_space(const double *vectors)
{
    static double space[3 * NODES];
    for (int i = 0; i < NODES; i++) {
        space[3 * i] = vectors[2 * i];
        space[3 * i + 1] = vectors[2 * i + 1];
    }
    return space;
}

static void fields_are_kept(void)
{
    const signorini_mesh mesh = the_mesh();
    double u[2 * NODES], force[2 * NODES], far[NODES], own[NODES];
    for (int i = 0; i < 2 * NODES; i++) {
        u[i] = 0.1 * i;
        force[i] = i ? -1e-300 / (i + 1) : 0;
    }
    for (int i = 0; i < NODES; i++) {
        far[i] = i ? i / 7.0 : INFINITY;
        own[i] = 1e300 / (i + 1);
    }
    const signorini_field fields[3] = {
        {.struct_size = sizeof *fields, .components = 1, .name = "own & other", .values = own},
        {.struct_size = sizeof *fields, .components = 1, .name = "far", .values = far},
        {.struct_size = sizeof *fields, .components = 2, .name = "force", .values = force}};
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 0, NULL, 3, fields), 0);
    const char *const file = read_back();
    const int64_t counted_from_0[7] = {0, 1, 2, 3, 1, 4, 2}, ends[2] = {4, 7};
    const unsigned char kinds[2] = {9, 5};
    CHECK(has(file, "Points", in_space(x), 3 * sizeof x / 2));
    CHECK(has(file, "connectivity", counted_from_0, sizeof counted_from_0));
    CHECK(has(file, "offsets", ends, sizeof ends));
    CHECK(has(file, "types", kinds, sizeof kinds));
    CHECK(has(file, "displacement", in_space(u), 3 * sizeof u / 2));
    CHECK(has(file, "own &amp; other", own, sizeof own));
    CHECK(has(file, "far", far, sizeof far));
    CHECK(has(file, "force", in_space(force), 3 * sizeof force / 2));
    /* Nothing is written that is not given. */
    CHECK_STATUS(signorini_mesh_write(path, &mesh, NULL, 0, NULL, 1, fields), 0);
    CHECK(has(read_back(), "own &amp; other", own, sizeof own));
    CHECK(!strstr(read_back(), "traction") && !strstr(read_back(), "displacement"));
    CHECK(remove(path) == 0);
}

/* Pairs of one line of the mesh, from node `first` to node `second`, with a plane 0.1 away. */
static signorini_surface_pairs *against_plane(int64_t first, int64_t second, int32_t dofs_per_node)
{
    const int64_t line[2] = {first, second};
    const double *const a = &x[2 * first], *const b = &x[2 * second];
    /* The body lies to the left of the line: the plane to the right. */
    const double out[2] = {b[1] - a[1], a[0] - b[0]};
    const signorini_faces faces = {.struct_size = sizeof faces, .face_nodes = 2, .count = 1, .nodes = line};
    const signorini_obstacle plane = {.struct_size = sizeof plane, .kind = SIGNORINI_OBSTACLE_PLANE,
        .point = {a[0] + 0.1 * out[0], a[1] + 0.1 * out[1]}, .direction = {-out[0], -out[1]}};
    signorini_surface_settings settings;
    signorini_surface_pairs *contact = NULL;
    signorini_surface_settings_default(&settings, sizeof settings);
    settings.dofs_per_node = dofs_per_node;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, NODES, x, &faces, &plane, &settings, &contact), 0);
    return contact;
}

/* The lower and the left side of the square: a file has the bits that signorini_surface_fields gives zone after zone;
 * 0 and state -1 elsewhere. Nodes have three degrees of freedom. */
static void zones_are_kept(void)
{
    const signorini_mesh mesh = the_mesh();
    double pressure[NODES] = {0}, clearance[NODES] = {0}, traction[2 * NODES] = {0}, slip[2 * NODES] = {0};
    double u[3 * NODES], moved[2 * NODES];
    int32_t state[NODES] = {-1, -1, -1, -1, -1};
    const double d[2][4] = {{0.1, 0.02, 0.05, -0.03}, {-0.7, 0.4, 0.1, 0.6}};
    const double F[2][4] = {{-2, 0.5, 0, 0}, {0, 0, -3.25, 1.5}}, slip0[2] = {0.01, -0.02};
    const int32_t states[2][2] = {{1, 0}, {0, 2}};
    for (int i = 0; i < 3 * NODES; i++) u[i] = 0.1 * i;
    for (int i = 0; i < 2 * NODES; i++) moved[i] = u[3 * (i / 2) + i % 2];
    signorini_zone zones[2] = {{.struct_size = sizeof *zones}, {.struct_size = sizeof *zones}};
    for (int k = 0; k < 2; k++) {
        zones[k].contact = k ? against_plane(3, 0, 3) : against_plane(0, 1, 3);
        zones[k].d = d[k];
        zones[k].F = F[k];
        zones[k].state = states[k];
        zones[k].slip0 = k ? NULL : slip0;
        const signorini_contact_fields wanted = {.struct_size = sizeof wanted, .pressure = pressure,
            .traction = traction, .clearance = clearance, .slip = slip, .state = state};
        CHECK(surface_data(zones[k].contact).pairs == 2);
        CHECK_STATUS(signorini_surface_fields(zones[k].contact, NULL, zones[k].slip0, d[k], F[k], states[k],
                                              &wanted), 0);
    }
    /* By hand: half of the side of length 1 belongs to each node. */
    CHECK(pressure[1] == 0 && pressure[2] == 0 && state[2] == -1);
    CHECK_NEAR(pressure[3] + pressure[0], 6.5);
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 2, zones, 0, NULL), 0);
    const char *file = read_back();
    CHECK(has(file, "displacement", in_space(moved), 3 * sizeof moved / 2));
    CHECK(has(file, "pressure", pressure, sizeof pressure));
    CHECK(has(file, "clearance", clearance, sizeof clearance));
    CHECK(has(file, "traction", in_space(traction), 3 * sizeof traction / 2));
    CHECK(has(file, "slip", in_space(slip), 3 * sizeof slip / 2));
    CHECK(has(file, "state", state, sizeof state));
    /* States that one zone does not have are left out. */
    zones[1].state = NULL;
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 2, zones, 0, NULL), 0);
    file = read_back();
    CHECK(has(file, "slip", in_space(slip), 3 * sizeof slip / 2) && !strstr(file, "\"state\""));
    CHECK(remove(path) == 0);
    /* Zones that number degrees of freedom otherwise, of another mesh, without pairs. */
    signorini_surface_pairs *const two = against_plane(0, 1, 2);
    const signorini_zone numbered[2] = {zones[0], {.struct_size = sizeof *zones, .contact = two, .d = d[0], .F = F[0]}};
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 2, numbered, 0, NULL), -5);
    CHECK_TEXT(signorini_last_error(), "zones 1: it numbers degrees of freedom otherwise");
    signorini_mesh other = mesh;
    other.nodes = NODES - 1;
    other.cells = 1;
    CHECK_STATUS(signorini_mesh_write(path, &other, u, 1, zones, 0, NULL), -5);
    CHECK_TEXT(signorini_last_error(), "its pairs are of 5 nodes");
    signorini_zone none = zones[0];
    none.contact = NULL;
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 1, &none, 0, NULL), -5);
    CHECK_TEXT(signorini_last_error(), "contact is NULL");
    none = zones[0];
    none.d = NULL;
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 1, &none, 0, NULL), -5);
    none = zones[0];
    none.reserved = 1;
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 1, &none, 0, NULL), -5);
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, -1, zones, 0, NULL), -4);
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, 1, NULL, 0, NULL), -5);
    CHECK(fopen(path, "r") == NULL);
    signorini_surface_free(two);
    for (int k = 0; k < 2; k++) signorini_surface_free((signorini_surface_pairs *)zones[k].contact);
}

static void refused(int32_t status, const char *part, const signorini_mesh *mesh,
                    const signorini_field *field)
{
    CHECK_STATUS(signorini_mesh_write(path, mesh, NULL, 0, NULL, field != NULL, field), status);
    CHECK_TEXT(signorini_last_error(), part);
    CHECK(fopen(path, "r") == NULL);
}

static void refusals(void)
{
    const double values[2 * NODES] = {0};
    const signorini_mesh mesh = the_mesh();
    const signorini_field good = {.struct_size = sizeof good, .components = 1, .name = "a", .values = values};
    signorini_mesh other = mesh;
    signorini_field field = good;
    other.index_base = 7;
    refused(-2, "index_base is 7", &other, NULL);
    other = mesh;
    other.nodes = INT64_MAX;
    refused(-2, "coordinates cannot have", &other, NULL);
    /* 2^63 bytes, half of all addresses. */
    other.nodes = INT64_C(1) << 59;
    refused(-2, "coordinates cannot have", &other, NULL);
    other = mesh;
    other.cell_types = NULL;
    other.cell_type = 99;
    other.cell_start = NULL;
    refused(-2, "99", &other, NULL);
    field.struct_size = 16;
    refused(-7, "fields: struct_size is 16", &mesh, &field);
    field = good;
    field.name = NULL;
    refused(-7, "a name is NULL", &mesh, &field);
    field.name = "\xFF";
    refused(-7, "not UTF-8", &mesh, &field);
    field.name = "two\nlines";
    refused(-7, "not printable", &mesh, &field);
    field = good;
    field.components = 3;
    refused(-7, "a has 3 components, it needs 1 or 2", &mesh, &field);
    /* A sentence of 511 bytes is whole; a longer one is cut between words, and says so. */
    char words[1000];
    memset(words, 'w', sizeof words);
    field.name = words;
    words[511 - strlen("fields:  has 3 components, it needs 1 or 2")] = '\0';
    refused(-7, "w has 3 components, it needs 1 or 2", &mesh, &field);
    CHECK(strlen(signorini_last_error()) == 511);
    strcat(words, "w");
    refused(-7, "w has 3 components, it needs 1 ...", &mesh, &field);
    CHECK(strlen(signorini_last_error()) <= 511);
    words[strlen(words)] = 'w';
    words[sizeof words - 1] = '\0';
    refused(-7, "fields: ...", &mesh, &field);
    field = good;
    field.values = NULL;
    refused(-7, "values is NULL", &mesh, &field);
}

int main(void)
{
    fields_are_kept();
    zones_are_kept();
    refusals();
    return check_summary("mesh_fields");
}
