/*
 * Piles of rigid bodies that touch on faces, four pairs for each two neighbours: W has a low rank,
 * and forces are not unique.
 *
 * A solution exists whatever the friction: at the motion by which all bodies leave the middle, each
 * as fast as it is far, the pairs of a face open at one speed along their normal, and none slips
 * (V. Acary, F. Cadoux, C. Lemarechal, J. Malick: A formulation of the linear discrete Coulomb
 * friction problem via convex optimization. ZAMM 91 (2011) 155-175).
 */

#include "check.h"

#include <stdint.h>
#include <stdlib.h>

enum { BODIES = 8, FREEDOMS = 6 * BODIES, NEIGHBOURS = 4, MOST = 12 * BODIES * NEIGHBOURS };

/* A number in -1..1 (D. E. Knuth's linear congruential generator MMIX). */
static double number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int32_t)(*state >> 32) / 2147483648.0;
}

static void cross(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double distance(const double *a, const double *b)
{
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/* Nonzero if b is one of the nearest bodies of a. */
static int is_neighbour(double middle[BODIES][3], int a, int b)
{
    int nearer = 0;
    for (int c = 0; c < BODIES; c++)
        nearer += c != a && distance(middle[a], middle[c]) < distance(middle[a], middle[b]);
    return nearer < NEIGHBOURS;
}

/* The closing velocities at the face between two bodies, by the velocities of their middles and by
 * their rotations; masses of 1, moments of inertia of 1 / 25. */
static int add_face(double rows[MOST][FREEDOMS], int n, double middle[BODIES][3], int a, int b)
{
    static const double corners[4][2] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, apart = distance(middle[a], middle[b]);
    double axes[3][3];
    for (int i = 0; i < 3; i++)
        axes[0][i] = (middle[b][i] - middle[a][i]) / apart;
    cross(axes[0], fabs(axes[0][0]) < 0.7 ? x : y, axes[1]);
    const double length = sqrt(pow(axes[1][0], 2) + pow(axes[1][1], 2) + pow(axes[1][2], 2));
    for (int i = 0; i < 3; i++)
        axes[1][i] /= length;
    cross(axes[0], axes[1], axes[2]);
    for (int corner = 0; corner < 4; corner++)
        for (int axis = 0; axis < 3; axis++, n++)
            for (int side = 0; side < 2; side++) {
                const int body = side ? b : a;
                const double sign = side ? -1.0 : 1.0;
                double arm[3], turn[3];
                for (int i = 0; i < 3; i++)
                    arm[i] = 0.5 * (middle[a][i] + middle[b][i]) - middle[body][i] +
                             0.1 * (corners[corner][0] * axes[1][i] + corners[corner][1] * axes[2][i]);
                cross(arm, axes[axis], turn);
                for (int i = 0; i < 3; i++) {
                    rows[n][6 * body + i] = sign * axes[axis][i];
                    rows[n][6 * body + 3 + i] = 5.0 * sign * turn[i];
                }
            }
    return n;
}

/* The status for random velocities of bodies that are drawn to the middle. */
static int solve(uint64_t seed)
{
    static double rows[MOST][FREEDOMS], W[MOST * MOST], q[MOST], d[MOST], F[MOST];
    static double gap[MOST], mu[MOST];
    double middle[BODIES][3], velocity[FREEDOMS];
    uint64_t state = seed;
    int n = 0;
    memset(rows, 0, sizeof rows);
    for (int i = 0; i < 3 * BODIES; i++)
        middle[i / 3][i % 3] = number(&state);
    for (int a = 0; a < BODIES; a++)
        for (int b = a + 1; b < BODIES; b++)
            if (is_neighbour(middle, a, b) || is_neighbour(middle, b, a))
                n = add_face(rows, n, middle, a, b);
    for (int i = 0; i < FREEDOMS; i++)
        velocity[i] = number(&state) - (i % 6 < 3 ? 2.0 * middle[i / 6][i % 6] : 0.0);
    for (int i = 0; i < n; i++) {
        q[i] = 0.0;
        for (int k = 0; k < FREEDOMS; k++)
            q[i] += rows[i][k] * velocity[k];
        for (int j = 0; j <= i; j++) {
            double sum = 0.0;
            for (int k = 0; k < FREEDOMS; k++)
                sum += rows[i][k] * rows[j][k];
            W[i + n * j] = W[j + n * i] = sum;
        }
    }
    for (int i = 0; i < n / 3; i++)
        mu[i] = 1.0;
    return solve_flexibility(3, n / 3, W, n, q, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                       NULL, d, F, NULL, NULL, NULL);
}

int main(void)
{
    /* The rounds of 7 and 28 come to rest without a solution, and begin again with the path. */
    for (uint64_t seed = 1; seed <= 40; seed++)
        CHECK_STATUS(solve(seed), SIGNORINI_STATUS_SOLVED);
    return check_summary("piles");
}
