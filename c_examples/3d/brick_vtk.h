/*
 * The answer as a file for ParaView or alike.
 */

#ifndef BRICK_VTK_H
#define BRICK_VTK_H

#include "brick_contact.h"

/*
 * Writes a file in VTK's legacy format: the mesh with
 *     displacement   u of the nodes
 *     contact_force  nodal, the contact forces on the nodes, as signorini_model_nodal_forces has them
 *     pressure       at the pairs, the pressing force over the area that the pair stands for
 *     state          0 open, 1 slip, 2 stick, -1 where there is no pair
 * Returns 0, or -1 with the reason in errno.
 */
int write_vtk(const char *path, const char *title, const struct brick_mesh *mesh,
              const struct contact *contact, const double u[], const double nodal[],
              const int32_t state[], const double area[]);

#endif
