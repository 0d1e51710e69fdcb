/*
 * The 8-node brick: trilinear, isotropic, 2 x 2 x 2 Gauss points.
 */

#ifndef BRICK_ELEMENT_H
#define BRICK_ELEMENT_H

struct material {
    double young, poisson;
};

/*
 * Stiffness of a brick. The displacements are (u_x, u_y, u_z) corner by corner. The corners stand
 * in the order of VTK_HEXAHEDRON: the lower face anticlockwise from above, then the upper face.
 */
void brick_stiffness(double corner[8][3], struct material material, double k[24][24]);

#endif
