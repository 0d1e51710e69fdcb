#include "junction_element.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const double side = ELEMENT_SIDE;
static const double poisson = 0.3;
static const double young[3] = {200000.0, 200000.0, 210000.0}; /* MPa; parts A, B, C */

static const double corner_r[4] = {-1, 1, 1, -1};
static const double corner_z[4] = {-1, -1, 1, 1};

/* At a Gauss point: the strains rr, zz, tt (around the axis) and rz that each displacement of the
 * corners gives, and the volume that the point stands for. */
static double strains(double inner_radius, int point, double strain[4][8])
{
    const double r = corner_r[point] / sqrt(3.0), z = corner_z[point] / sqrt(3.0);
    const double radius = inner_radius + side * (1.0 + r) / 2.0;

    for (int a = 0; a < 4; a++) {
        const double value = (1.0 + corner_r[a] * r) * (1.0 + corner_z[a] * z) / 4.0;
        const double dr = corner_r[a] * (1.0 + corner_z[a] * z) / (2.0 * side);
        const double dz = corner_z[a] * (1.0 + corner_r[a] * r) / (2.0 * side);
        strain[0][2 * a] = dr;
        strain[0][2 * a + 1] = 0.0;
        strain[1][2 * a] = 0.0;
        strain[1][2 * a + 1] = dz;
        strain[2][2 * a] = value / radius;
        strain[2][2 * a + 1] = 0.0;
        strain[3][2 * a] = dz;
        strain[3][2 * a + 1] = dr;
    }
    return 2.0 * pi * radius * side * side / 4.0;
}

static void elasticity(int part, double law[4][4])
{
    const double shear = young[part] / (2.0 * (1.0 + poisson));
    const double cross = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);

    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            law[i][k] = i < 3 && k < 3 ? cross : 0.0;
    for (int i = 0; i < 3; i++)
        law[i][i] += 2.0 * shear;
    law[3][3] = shear;
}

void element_stiffness(int part, double inner_radius, double k[8][8])
{
    double law[4][4];

    elasticity(part, law);
    for (int m = 0; m < 8; m++)
        for (int n = 0; n < 8; n++)
            k[m][n] = 0.0;
    for (int point = 0; point < 4; point++) {
        double strain[4][8];
        const double volume = strains(inner_radius, point, strain);
        for (int n = 0; n < 8; n++) {
            for (int i = 0; i < 4; i++) {
                double stress = 0.0;
                for (int l = 0; l < 4; l++)
                    stress += law[i][l] * strain[l][n];
                for (int m = 0; m < 8; m++)
                    k[m][n] += volume * strain[i][m] * stress;
            }
        }
    }
}

double element_stress(int part, double inner_radius, const double u[8], double at_corners[4])
{
    double law[4][4], at_point[4] = {0.0};

    elasticity(part, law);
    for (int point = 0; point < 4; point++) {
        double strain[4][8];
        strains(inner_radius, point, strain);
        for (int n = 0; n < 8; n++)
            for (int l = 0; l < 4; l++)
                at_point[point] += law[1][l] * strain[l][n] * u[n];
    }
    for (int a = 0; a < 4; a++) {
        at_corners[a] = 0.0;
        for (int point = 0; point < 4; point++)
            at_corners[a] += at_point[point] *
                             (1.0 + sqrt(3.0) * corner_r[a] * corner_r[point]) *
                             (1.0 + sqrt(3.0) * corner_z[a] * corner_z[point]) / 4.0;
    }
    return (at_point[0] + at_point[1] + at_point[2] + at_point[3]) / 4.0;
}
