/*
 * Closed forms for two equal balls that touch in a circle, each taken as a half-space.
 *
 * H. Hertz (1882): pressed. C. Cattaneo (1938), R. D. Mindlin (1949): then shifted. J. L. Lubkin
 * (1951): or twisted. Slip enters from the rim, so that the pairs within a radius c stick. The
 * traction of a twist is the sum of those under rigid discs of radius s, c <= s <= a, that are
 * glued on and turned by w(s) ds, with w(s) = mu p0 E(k) / (2 G s), k^2 = 1 - s^2 / a^2, and the
 * complete elliptic integral E. Both balls turn so far.
 *
 * Forces in N, lengths in mm, stresses in MPa.
 */

#ifndef HERTZ_THEORY_H
#define HERTZ_THEORY_H

#include "brick_element.h"

struct hertz {
    struct material material; /* of both balls */
    double gap_radius;        /* R: the gap is r^2 / 2 R */
    double a;                 /* radius of the contact */
    double mu;
    /* what follows from these */
    double force, pressure, approach; /* P, largest pressure p0, motion to each other */
};

struct hertz hertz_pressed(struct material material, double gap_radius, double a, double mu);

/* p at the radius r. */
double hertz_pressure(const struct hertz *h, double r);

/* Shifted until only the pairs within c stick: the force Q, the motion of the balls to each other,
 * and the traction at r. */
double shift_force(const struct hertz *h, double c);
double shift_motion(const struct hertz *h, double c);
double shift_traction(const struct hertz *h, double c, double r);

/* Twisted likewise: the moment M, the relative rotation, the traction. */
double twist_moment(const struct hertz *h, double c);
double twist_rotation(const struct hertz *h, double c);
double twist_traction(const struct hertz *h, double c, double r);

/* A load on the surface of a half-space, around the origin. */
struct load {
    double force[3], moment; /* along x, y, z; about z */
    double spread;           /* root mean square of the forces' distance from the origin */
};

/*
 * Adds to u the displacement at a point of the half-space z <= 0, far from a load on its surface
 * (Boussinesq, Cerruti). Four forces at the distance `spread` from the origin stand for the load:
 * they have its second moments, so that what is left out falls as (a / distance)^4 beside the rest.
 * The moment has the field of a center of rotation, exact to (a / distance)^2.
 */
void add_far_field(struct material material, const struct load *load, const double at[3],
                   double u[3]);

#endif
