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

int32_t write_vtu(const char *path, const struct brick_mesh *mesh, const struct contact *contact,
                  const int32_t state[], const double area[], const double u[],
                  const double nodal[])
{
    double *pressure = calloc((size_t)mesh->nodes, sizeof *pressure);
    double *states = malloc((size_t)mesh->nodes * sizeof *states);
    int32_t status = SIGNORINI_STATUS_OUT_OF_MEMORY;

    if (pressure != NULL && states != NULL) {
        const signorini_mesh cells = brick_cells(mesh);
        const signorini_field fields[] = {
            {.struct_size = sizeof *fields, .components = 1, .name = "pressure", .values = pressure},
            {.struct_size = sizeof *fields, .components = 1, .name = "state", .values = states},
            {.struct_size = sizeof *fields, .components = 3, .name = "contact_force", .values = nodal}};

        for (int32_t node = 0; node < mesh->nodes; node++)
            states[node] = -1;
        for (int32_t pair = 0; pair < contact->pairs; pair++) {
            const int32_t lower = contact->lower[pair], upper = contact->upper[pair];
            pressure[lower] = pressure[upper] = nodal[3 * upper + 2] / area[pair];
            states[lower] = states[upper] = state[pair];
        }
        status = signorini_mesh_write(path, &cells, u, 0, NULL, 3, fields);
    }
    free(pressure);
    free(states);
    return status;
}
