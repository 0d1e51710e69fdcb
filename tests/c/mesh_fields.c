/* A mesh with fields in a .vtu file: what is read back by the rules of the format has the bits that were written. */

#define _POSIX_C_SOURCE 200809L

#include "check.h"

#include <stdlib.h>
#include <unistd.h>

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

/* Whether the array `name` of the file has these bytes, behind their number. */
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
    double u[2 * NODES], traction[2 * NODES], slip[2 * NODES], pressure[NODES], clearance[NODES], own[NODES];
    int32_t state[NODES];
    for (int i = 0; i < 2 * NODES; i++) {
        u[i] = 0.1 * i;
        traction[i] = -1.0 / (i + 1);
        slip[i] = 1e-300 * i;
    }
    for (int i = 0; i < NODES; i++) {
        pressure[i] = 3.5 - i;
        clearance[i] = i ? i / 7.0 : INFINITY;
        own[i] = 1e300 / (i + 1);
        state[i] = i - 1;
    }
    const signorini_contact_fields contact = {.struct_size = sizeof contact, .pressure = pressure,
        .traction = traction, .clearance = clearance, .slip = slip, .state = state};
    const signorini_field fields[2] = {
        {.struct_size = sizeof *fields, .components = 1, .name = "own & other", .values = own},
        {.struct_size = sizeof *fields, .components = 2, .name = "force", .values = traction}};
    CHECK_STATUS(signorini_mesh_write(path, &mesh, u, &contact, 2, fields), 0);
    const char *const file = read_back();
    const int64_t counted_from_0[7] = {0, 1, 2, 3, 1, 4, 2}, ends[2] = {4, 7};
    const unsigned char kinds[2] = {9, 5};
    CHECK(has(file, "Points", in_space(x), 3 * sizeof x / 2));
    CHECK(has(file, "connectivity", counted_from_0, sizeof counted_from_0));
    CHECK(has(file, "offsets", ends, sizeof ends));
    CHECK(has(file, "types", kinds, sizeof kinds));
    CHECK(has(file, "displacement", in_space(u), 3 * sizeof u / 2));
    CHECK(has(file, "pressure", pressure, sizeof pressure));
    CHECK(has(file, "clearance", clearance, sizeof clearance));
    CHECK(has(file, "traction", in_space(traction), 3 * sizeof traction / 2));
    CHECK(has(file, "slip", in_space(slip), 3 * sizeof slip / 2));
    CHECK(has(file, "state", state, sizeof state));
    CHECK(has(file, "own &amp; other", own, sizeof own));
    CHECK(has(file, "force", in_space(traction), 3 * sizeof traction / 2));
    /* What is not given is left out. */
    const signorini_contact_fields few = {.struct_size = sizeof few, .pressure = pressure};
    CHECK_STATUS(signorini_mesh_write(path, &mesh, NULL, &few, 0, NULL), 0);
    CHECK(has(read_back(), "pressure", pressure, sizeof pressure));
    CHECK(!strstr(read_back(), "traction") && !strstr(read_back(), "displacement"));
    CHECK(remove(path) == 0);
}

static void refused(int32_t status, const char *part, const signorini_mesh *mesh,
                    const signorini_contact_fields *contact, const signorini_field *field)
{
    CHECK_STATUS(signorini_mesh_write(path, mesh, NULL, contact, field != NULL, field), status);
    CHECK_TEXT(signorini_last_error(), part);
    CHECK(access(path, F_OK) != 0);
}

static void refusals(void)
{
    const double values[2 * NODES] = {0};
    const signorini_mesh mesh = the_mesh();
    const signorini_field good = {.struct_size = sizeof good, .components = 1, .name = "a", .values = values};
    signorini_mesh other = mesh;
    signorini_field field = good;
    signorini_contact_fields contact = {.struct_size = 16};
    other.index_base = 7;
    refused(-2, "index_base is 7", &other, NULL, NULL);
    other = mesh;
    other.nodes = INT64_MAX;
    refused(-2, "coordinates cannot have", &other, NULL, NULL);
    /* 2^63 bytes, half of all addresses. */
    other.nodes = INT64_C(1) << 59;
    refused(-2, "coordinates cannot have", &other, NULL, NULL);
    other = mesh;
    other.cell_types = NULL;
    other.cell_type = 99;
    other.cell_start = NULL;
    refused(-2, "99", &other, NULL, NULL);
    refused(-4, "contact: struct_size is 16", &mesh, &contact, NULL);
    field.name = NULL;
    refused(-6, "a name is NULL", &mesh, NULL, &field);
    field.name = "\xFF";
    refused(-6, "not UTF-8", &mesh, NULL, &field);
    field.name = "two\nlines";
    refused(-6, "not printable", &mesh, NULL, &field);
    field = good;
    field.components = 3;
    refused(-6, "a has 3 components, it needs 1 or 2", &mesh, NULL, &field);
    field = good;
    field.values = NULL;
    refused(-6, "values is NULL", &mesh, NULL, &field);
}

int main(void)
{
    fields_are_kept();
    refusals();
    return check_summary("mesh_fields");
}
