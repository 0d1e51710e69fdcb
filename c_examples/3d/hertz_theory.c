#include "hertz_theory.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double shear_modulus(struct material material)
{
    return material.young / (2.0 * (1.0 + material.poisson));
}

/* ---- Pressed ------------------------------------------------------------------------------- */

struct hertz hertz_pressed(struct material material, double gap_radius, double a, double mu)
{
    /* Two bodies: 1 / E* = 2 (1 - nu^2) / E. */
    const double modulus = material.young / (2.0 * (1.0 - material.poisson * material.poisson));
    struct hertz h = {material, gap_radius, a, mu, 0.0, 0.0, 0.0};

    h.approach = a * a / gap_radius;
    h.force = 4.0 / 3.0 * modulus * a * a * a / gap_radius;
    h.pressure = 2.0 * a * modulus / (pi * gap_radius);
    return h;
}

/* Height at r of the half ellipsoid over a disc. */
static double dome(double radius, double r)
{
    return r < radius ? sqrt(1.0 - (r / radius) * (r / radius)) : 0.0;
}

double hertz_pressure(const struct hertz *h, double r)
{
    return h->pressure * dome(h->a, r);
}

/* ---- Shifted ------------------------------------------------------------------------------- */

double shift_force(const struct hertz *h, double c)
{
    return h->mu * h->force * (1.0 - pow(c / h->a, 3.0));
}

double shift_motion(const struct hertz *h, double c)
{
    const double one = 3.0 * h->mu * h->force / (16.0 * h->a) * (2.0 - h->material.poisson) /
                       shear_modulus(h->material);
    return 2.0 * one * (1.0 - c * c / (h->a * h->a));
}

double shift_traction(const struct hertz *h, double c, double r)
{
    return h->mu * h->pressure * (dome(h->a, r) - c / h->a * dome(c, r));
}

/* ---- Twisted ------------------------------------------------------------------------------- */

/* The complete elliptic integral E of k^2 = 1 - other^2, 0 < other <= 1, and K - E, by the
 * arithmetic-geometric mean: it doubles the number of correct digits in each turn. */
static double elliptic(double other, double *difference)
{
    double a = 1.0, b = other, weight = 0.5, sum = 0.5 * (1.0 - other * other);

    for (int turn = 0; turn < 8; turn++) {
        const double c = (a - b) / 2.0, mean = (a + b) / 2.0;
        b = sqrt(a * b);
        a = mean;
        weight *= 2.0;
        sum += weight * c * c;
    }
    const double K = pi / (2.0 * a);
    *difference = K * sum;
    return K - *difference;
}

/* Integral of f over an interval: Simpson's rule, for smooth functions. */
static double integral(double (*f)(const struct hertz *, double, double), const struct hertz *h,
                       double r, double from, double to)
{
    enum { PARTS = 64 };
    const double step = (to - from) / PARTS;
    double sum = f(h, r, from) + f(h, r, to);

    for (int i = 1; i < PARTS; i++)
        sum += (i % 2 == 1 ? 4.0 : 2.0) * f(h, r, from + step * i);
    return sum * step / 3.0;
}

/* A disc of radius s has the moment 16/3 G s^3 w ds: the integrand is s^2 E. */
static double disc_moment(const struct hertz *h, double unused, double s)
{
    double difference;
    (void)unused;
    return s * s * elliptic(s / h->a, &difference);
}

/* Its traction is 4/pi G w r ds / sqrt(s^2 - r^2): with s^2 = r^2 + t^2 smooth in t. */
static double disc_traction(const struct hertz *h, double r, double t)
{
    const double s = hypot(r, t);
    double difference;
    return elliptic(s / h->a, &difference) / (s * s);
}

double twist_moment(const struct hertz *h, double c)
{
    return 8.0 / 3.0 * h->mu * h->pressure * integral(disc_moment, h, 0.0, c, h->a);
}

double twist_rotation(const struct hertz *h, double c)
{
    double difference;
    elliptic(c / h->a, &difference);
    return 2.0 * h->mu * h->pressure / (2.0 * shear_modulus(h->material)) * difference;
}

double twist_traction(const struct hertz *h, double c, double r)
{
    if (r >= c)
        return h->mu * hertz_pressure(h, r);
    return 2.0 / pi * h->mu * h->pressure * r *
           integral(disc_traction, h, r, sqrt(c * c - r * r), sqrt(h->a * h->a - r * r));
}

/* ---- Far away ------------------------------------------------------------------------------ */

/* One force at the origin. The formulas have the depth as z: -z here, and so is the force's. */
static void add_force(struct material material, const double force[3], double x, double y,
                      double depth, double u[3])
{
    const double soft = 1.0 - 2.0 * material.poisson;
    const double scale = 1.0 / (4.0 * pi * shear_modulus(material));
    const double R = sqrt(x * x + y * y + depth * depth), R3 = R * R * R, s = R + depth;
    const double press = -force[2], along = force[0] * x + force[1] * y;

    const double radial = press * (depth / R3 - soft / (R * s)) +
                          along * (1.0 / R3 - soft / (R * s * s));
    const double direct = 1.0 / R + soft / s;
    const double deep = press * ((1.0 + soft) / R + depth * depth / R3) +
                        along * (depth / R3 + soft / (R * s));

    u[0] += scale * (radial * x + direct * force[0]);
    u[1] += scale * (radial * y + direct * force[1]);
    u[2] -= scale * deep;
}

void add_far_field(struct material material, const struct load *load, const double at[3],
                   double u[3])
{
    static const double place[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const double R = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    const double turn = load->moment / (4.0 * pi * shear_modulus(material) * R * R * R);
    const double quarter[3] = {load->force[0] / 4.0, load->force[1] / 4.0, load->force[2] / 4.0};

    for (int i = 0; i < 4; i++)
        add_force(material, quarter, at[0] - load->spread * place[i][0],
                  at[1] - load->spread * place[i][1], -at[2], u);
    u[0] -= turn * at[1];
    u[1] += turn * at[0];
}
