/*
 * Answers as files.
 */

#ifndef BRICK_OUTPUT_H
#define BRICK_OUTPUT_H

#include "brick_contact.h"

/*
 * A line for each pair: x and y, d and F in the axes (z, x, y) of the pair, and the state. Returns 0,
 * or -1 with the reason in errno.
 */
int write_csv(const char *path, const struct brick_mesh *mesh, const struct contact *contact,
              const struct answer *answer);

/*
 * For ParaView, by signorini_mesh_write, whose status it returns: the mesh, and at its nodes
 *     displacement   u
 *     contact_force  nodal, as signorini_model_nodal_forces has it
 *     pressure       the pressing force of a pair over the area that it stands for
 *     state          0 open, 1 slip, 2 stick, -1 where there is no pair
 */
int32_t write_vtu(const char *path, const struct brick_mesh *mesh, const struct contact *contact,
                  const int32_t state[], const double area[], const double u[],
                  const double nodal[]);

#endif
