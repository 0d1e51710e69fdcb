/*
 * Contact of two boxes whose nodes face each other on a level plane, in the library's terms.
 *
 * The slave of each pair is the node of the lower box. Its outward normal is z, its tangents are x
 * and y. So d = (u_z, u_x, u_y) of the lower node less those of the upper node, and F is the force
 * (F_z, F_x, F_y) on the lower node: F_n < 0 presses it down, and -F acts on the upper node.
 */

#ifndef BRICK_CONTACT_H
#define BRICK_CONTACT_H

#include "brick_mesh.h"
#include "signorini_surface.h"

struct contact {
    int32_t pairs;
    int32_t *lower, *upper; /* the nodes of each pair */
};

/* The library's findings. The pairs one after the other, (n, t1, t2) for each in d and F. */
struct answer {
    double *d, *F;
    int32_t *state;
};

/* The assembled matrix and the mesh as the library takes them: they point into the mesh. */
signorini_sparse brick_matrix(const struct brick_mesh *mesh);
signorini_mesh brick_cells(const struct brick_mesh *mesh);

/*
 * Makes the library's model of the assembled mesh. Returns what signorini_model_new_sparse returns,
 * or SIGNORINI_STATUS_OUT_OF_MEMORY.
 */
int32_t contact_model(const struct brick_mesh *mesh, const struct contact *contact,
                      int64_t n_fixed, const int64_t fixed[], signorini_model **model);

/* Largest excess of |F_t| over mu |F_n|, and of F_n over 0: 0 if every force is admissible. */
double contact_excess(int32_t pairs, const double F[], double mu);

#endif
