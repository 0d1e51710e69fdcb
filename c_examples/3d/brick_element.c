#include "brick_element.h"

#include <math.h>

/* The place of each corner in the cube from -1 to 1 whose image the brick is. */
static const double place[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/* Inverse of a 3 x 3 matrix by cofactors. Returns the determinant. */
static double invert(double a[3][3], double inverse[3][3])
{
    double determinant;

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
            inverse[j][i] = a[p][r] * a[q][s] - a[p][s] * a[q][r];
        }
    }
    determinant = a[0][0] * inverse[0][0] + a[0][1] * inverse[1][0] + a[0][2] * inverse[2][0];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[i][j] /= determinant;
    return determinant;
}

/* At a Gauss point: the gradient of each corner's shape function in space. Returns the volume that
 * the point stands for. */
static double gradients(double corner[8][3], const double point[3], double gradient[8][3])
{
    double local[8][3], jacobian[3][3] = {{0.0}}, inverse[3][3];

    for (int a = 0; a < 8; a++) {
        for (int i = 0; i < 3; i++) {
            const int p = (i + 1) % 3, q = (i + 2) % 3;
            local[a][i] = place[a][i] * (1.0 + place[a][p] * point[p]) *
                          (1.0 + place[a][q] * point[q]) / 8.0;
        }
    }
    for (int a = 0; a < 8; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                jacobian[i][j] += local[a][i] * corner[a][j];

    const double volume = invert(jacobian, inverse);
    for (int a = 0; a < 8; a++) {
        for (int j = 0; j < 3; j++) {
            gradient[a][j] = 0.0;
            for (int i = 0; i < 3; i++)
                gradient[a][j] += inverse[j][i] * local[a][i];
        }
    }
    return volume;
}

void brick_stiffness(double corner[8][3], struct material material, double k[24][24])
{
    const double shear = material.young / (2.0 * (1.0 + material.poisson));
    const double cross = 2.0 * shear * material.poisson / (1.0 - 2.0 * material.poisson);

    for (int m = 0; m < 24; m++)
        for (int n = 0; n < 24; n++)
            k[m][n] = 0.0;
    for (int p = 0; p < 8; p++) {
        const double point[3] = {place[p][0] / sqrt(3.0), place[p][1] / sqrt(3.0),
                                 place[p][2] / sqrt(3.0)};
        double g[8][3];
        const double volume = gradients(corner, point, g);
        for (int a = 0; a < 8; a++) {
            for (int b = 0; b < 8; b++) {
                const double dot = g[a][0] * g[b][0] + g[a][1] * g[b][1] + g[a][2] * g[b][2];
                for (int i = 0; i < 3; i++) {
                    for (int j = 0; j < 3; j++)
                        k[3 * a + i][3 * b + j] +=
                            volume * (cross * g[a][i] * g[b][j] + shear * g[a][j] * g[b][i]);
                    k[3 * a + i][3 * b + i] += volume * shear * dot;
                }
            }
        }
    }
}
