#include "brick_output.h"
#include "../common/checks.h"

#include <stdio.h>
#include <stdlib.h>

int write_csv(const char *path, const struct brick_mesh *mesh, const struct contact *contact,
              const struct answer *answer)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fputs("x,y,d_n,d_t1,d_t2,F_n,F_t1,F_t2,state\n", file);
    for (int32_t pair = 0; pair < contact->pairs; pair++) {
        const double *at = mesh->at[contact->lower[pair]];
        fprintf(file, "%.12g,%.12g", at[0], at[1]);
        for (int i = 0; i < 3; i++)
            fprintf(file, ",%.12e", answer->d[3 * pair + i] + 0.0); /* + 0.0 turns -0.0 into 0.0 */
        for (int i = 0; i < 3; i++)
            fprintf(file, ",%.12e", answer->F[3 * pair + i] + 0.0);
        fprintf(file, ",%s\n", state_name(answer->state[pair]));
    }
    const int failed = ferror(file);
    return fclose(file) != 0 || failed ? -1 : 0;
}

/* ---- VTK ----------------------------------------------------------------------------------- */

static void write_mesh(FILE *file, const struct brick_mesh *mesh)
{
    fprintf(file, "POINTS %ld double\n", (long)mesh->nodes);
    for (int32_t node = 0; node < mesh->nodes; node++)
        fprintf(file, "%.9g %.9g %.9g\n", mesh->at[node][0], mesh->at[node][1], mesh->at[node][2]);
    fprintf(file, "CELLS %ld %ld\n", (long)mesh->bricks, 9 * (long)mesh->bricks);
    for (int32_t brick = 0; brick < mesh->bricks; brick++) {
        fputs("8", file);
        for (int a = 0; a < 8; a++)
            fprintf(file, " %ld", (long)mesh->corners[brick][a]);
        fputc('\n', file);
    }
    fprintf(file, "CELL_TYPES %ld\n", (long)mesh->bricks);
    for (int32_t brick = 0; brick < mesh->bricks; brick++)
        fputs("12\n", file); /* VTK_HEXAHEDRON */
}

static void write_vectors(FILE *file, const char *name, int32_t nodes, const double values[])
{
    fprintf(file, "VECTORS %s double\n", name);
    for (int32_t node = 0; node < nodes; node++)
        fprintf(file, "%.9g %.9g %.9g\n", values[3 * node], values[3 * node + 1],
                values[3 * node + 2]);
}

static void write_scalars(FILE *file, const char *name, int32_t nodes, const double values[])
{
    fprintf(file, "SCALARS %s double 1\nLOOKUP_TABLE default\n", name);
    for (int32_t node = 0; node < nodes; node++)
        fprintf(file, "%.9g\n", values[node]);
}

int write_vtk(const char *path, const char *title, const struct brick_mesh *mesh,
              const struct contact *contact, const int32_t state[], const double area[],
              const double u[], const double nodal[])
{
    double *pressure = calloc((size_t)mesh->nodes, sizeof *pressure);
    double *states = malloc((size_t)mesh->nodes * sizeof *states);
    FILE *file = pressure != NULL && states != NULL ? fopen(path, "w") : NULL;
    int failed = 1;

    if (file != NULL) {
        for (int32_t node = 0; node < mesh->nodes; node++)
            states[node] = -1.0;
        for (int32_t pair = 0; pair < contact->pairs; pair++) {
            const int32_t lower = contact->lower[pair], upper = contact->upper[pair];
            pressure[lower] = pressure[upper] = nodal[3 * upper + 2] / area[pair];
            states[lower] = states[upper] = state[pair];
        }
        fprintf(file, "# vtk DataFile Version 3.0\n%s\nASCII\nDATASET UNSTRUCTURED_GRID\n", title);
        write_mesh(file, mesh);
        fprintf(file, "POINT_DATA %ld\n", (long)mesh->nodes);
        write_vectors(file, "displacement", mesh->nodes, u);
        write_vectors(file, "contact_force", mesh->nodes, nodal);
        write_scalars(file, "pressure", mesh->nodes, pressure);
        write_scalars(file, "state", mesh->nodes, states);
        failed = ferror(file);
        failed = fclose(file) != 0 || failed;
    }
    free(pressure);
    free(states);
    return failed ? -1 : 0;
}
