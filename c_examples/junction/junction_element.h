/*
 * The element of the bolted junction: an axisymmetric four-node square with 2x2 Gauss points.
 * Displacements (u_r, u_z) of its corners, anticlockwise from the lower left.
 */

#ifndef JUNCTION_ELEMENT_H
#define JUNCTION_ELEMENT_H

#define ELEMENT_SIDE 2.5 /* mm */

/* Stiffness of an element of a part, over the whole circumference. */
void element_stiffness(int part, double inner_radius, double k[8][8]);

/* Axial stress at the corners, bilinear through the Gauss points. Returns the points' mean. */
double element_stress(int part, double inner_radius, const double u[8], double at_corners[4]);

#endif
