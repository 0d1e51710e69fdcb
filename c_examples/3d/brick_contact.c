#include "brick_contact.h"

#include <math.h>
#include <stdlib.h>

signorini_sparse brick_matrix(const struct brick_mesh *mesh)
{
    return (signorini_sparse){.struct_size = sizeof(signorini_sparse),
                              .index_bytes = 4,
                              .index_base = 0,
                              .triangle = SIGNORINI_TRIANGLE_FULL,
                              .size = mesh->dofs,
                              .nnz = mesh->starts[mesh->dofs],
                              .col_start = mesh->starts,
                              .row = mesh->rows,
                              .values = mesh->values};
}

signorini_mesh brick_cells(const struct brick_mesh *mesh)
{
    return (signorini_mesh){.struct_size = sizeof(signorini_mesh),
                            .dim = 3,
                            .nodes = mesh->nodes,
                            .coordinates = mesh->at[0],
                            .cells = mesh->bricks,
                            .cell_type = 12, /* VTK_HEXAHEDRON */
                            .cell_nodes = mesh->corners[0]};
}

int32_t contact_model(const struct brick_mesh *mesh, const struct contact *contact,
                      int64_t n_fixed, const int64_t fixed[], signorini_model **model)
{
    const size_t count = (size_t)contact->pairs;
    int64_t *numbers = malloc((7 * count + 1) * sizeof *numbers);
    double *reals = malloc((7 * count) * sizeof *reals);
    int32_t status = SIGNORINI_STATUS_OUT_OF_MEMORY;

    if (numbers != NULL && reals != NULL) {
        int64_t *slaves = numbers, *masters = slaves + 3 * count;
        int64_t *master_start = masters + 3 * count;
        double *normals = reals, *tangents = normals + 3 * count, *weights = tangents + 3 * count;

        for (size_t pair = 0; pair < count; pair++) {
            for (size_t axis = 0; axis < 3; axis++) {
                slaves[3 * pair + axis] = 3 * (int64_t)contact->lower[pair] + (int64_t)axis;
                masters[3 * pair + axis] = 3 * (int64_t)contact->upper[pair] + (int64_t)axis;
                normals[3 * pair + axis] = axis == 2;  /* z */
                tangents[3 * pair + axis] = axis == 0; /* x, so that t2 = n x t1 is y */
            }
            master_start[pair] = (int64_t)pair; /* one master for each slave: nodes match */
            weights[pair] = 1.0;
        }
        master_start[count] = (int64_t)count;

        const signorini_sparse K = brick_matrix(mesh);
        const signorini_pairs pairs = {.struct_size = sizeof pairs,
                                       .dim = 3,
                                       .count = contact->pairs,
                                       .slaves = slaves,
                                       .master_start = master_start,
                                       .masters = masters,
                                       .weights = weights,
                                       .normals = normals,
                                       .tangents = tangents};
        status = signorini_model_new_sparse(&K, n_fixed, fixed, &pairs, NULL, model);
    }
    free(numbers);
    free(reals);
    return status;
}

double contact_excess(int32_t pairs, const double F[], double mu)
{
    double excess = 0.0;
    for (int32_t pair = 0; pair < pairs; pair++) {
        const double normal = F[3 * pair];
        const double tangential = hypot(F[3 * pair + 1], F[3 * pair + 2]);
        excess = fmax(excess, fmax(normal, tangential - mu * fabs(normal)));
    }
    return excess;
}
