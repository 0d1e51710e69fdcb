/*
 * Judges in quadruple precision. Formulas are those of signorini.h; nothing is shared with the library.
 */

#include "fuzz.h"

#include <float.h>

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

enum { MOST = 16 };

/* Half a unit in the last place of 1. */
static const double UNIT = DBL_EPSILON / 2;

/* Few roundings of a number that is computed in doubles. */
static const double DIGITS = 1e-14;

/*
 * Numbers below this size may be lost to underflow; forces already where they are this small beside the largest, as the
 * library computes in units in which that is about 1.
 */
static const double LEAST = 1e-290;

static quad magnitude(quad x)
{
    return x < 0 ? -x : x;
}

static quad larger(quad x, quad y)
{
    return x > y ? x : y;
}

/* A root by Newton's method from that of a double. */
static quad root(quad x)
{
    if (x <= 0) return 0;
    /* Numbers whose double over- or underflows are taken by their sixteenth power. */
    quad factor = 1;
    const quad big = 1e240;
    for (; x > big; factor *= big) x /= big * big;
    for (; x < 1 / big; factor /= big) x *= big * big;
    quad y = sqrt((double)x);
    for (int i = 0; i < 3; i++) y = (y + x / y) / 2;
    return y * factor;
}

static quad length(const quad *v, int64_t n)
{
    quad sum = 0;
    for (int64_t i = 0; i < n; i++) sum += v[i] * v[i];
    return root(sum);
}

/* The law of a pair. */
static int32_t law_of(const problem *p, int64_t pair)
{
    return p->law == SIGNORINI_LAW_BY_PAIR ? (int32_t)p->friction[4 * pair] : p->law;
}

/* Its numbers. */
static const double *numbers_of(const problem *p, int64_t pair)
{
    if (!p->friction) return NULL;
    return p->friction + per_pair(p->law) * pair + (p->law == SIGNORINI_LAW_BY_PAIR);
}

/* Slope, offset and tension of the bound on |F_t| of a pair: |F_t| <= offset - slope min(F_n, tension). */
static void bound_of(const problem *p, int64_t pair, double *slope, double *offset, double *tension)
{
    *slope = *offset = *tension = 0;
    const double *numbers = numbers_of(p, pair);
    switch (law_of(p, pair)) {
    case SIGNORINI_LAW_COULOMB: *slope = numbers[0]; break;
    case SIGNORINI_LAW_TRESCA: *offset = numbers[0]; break;
    case SIGNORINI_LAW_COHESIVE:
        *slope = numbers[0];
        *offset = numbers[1];
        *tension = numbers[2];
        break;
    default: break;
    }
}

static int is_ellipse(int32_t law)
{
    return law == SIGNORINI_LAW_ORTHOTROPIC || law == SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR;
}

static int has(const problem *p, int (*is)(int32_t law))
{
    for (int64_t pair = 0; pair < p->pairs; pair++)
        if (is(law_of(p, pair))) return 1;
    return 0;
}

/* Laws whose forces may work against a motion without end. */
static int resists(int32_t law)
{
    return is_ellipse(law) || law == SIGNORINI_LAW_TRESCA || law == SIGNORINI_LAW_COHESIVE;
}

static int is_free(const problem *p, int64_t pair)
{
    return isinf(p->gap ? p->gap[pair] : 0);
}

/* A tied pair carries any force; a free one none. */
static void judge_tied(const problem *p, int64_t pair, const double *part, const int32_t *state)
{
    for (int c = 0; c < p->dim; c++) REQUIRE(isfinite(part[c]) && (!is_free(p, pair) || part[c] == 0));
    if (state) REQUIRE(state[pair] >= SIGNORINI_STATE_OPEN && state[pair] <= SIGNORINI_STATE_STICK);
}

void judge_law(const problem *p, const double *F, const int32_t *state)
{
    quad lost = LEAST;
    for (int64_t i = 0; i < p->dim * p->pairs; i++) lost = larger(lost, LEAST * magnitude(F[i]));
    for (int64_t pair = 0; pair < p->pairs; pair++) {
        const double *part = F + p->dim * pair;
        if (law_of(p, pair) == SIGNORINI_LAW_TIED) {
            judge_tied(p, pair, part, state);
            continue;
        }
        double slope, offset, tension;
        bound_of(p, pair, &slope, &offset, &tension);
        for (int c = 0; c < p->dim; c++) REQUIRE(isfinite(part[c]));
        REQUIRE(part[0] <= tension);
        REQUIRE(!is_free(p, pair) || part[0] == tension);
        if (state) {
            REQUIRE(state[pair] >= SIGNORINI_STATE_OPEN && state[pair] <= SIGNORINI_STATE_STICK);
            REQUIRE(state[pair] != SIGNORINI_STATE_OPEN || part[0] == tension);
        }
        const quad t[2] = {part[1], p->dim == 3 ? part[2] : 0};
        const quad pressure = tension - (quad)part[0] - tension;
        const double *of = numbers_of(p, pair);
        if (is_ellipse(law_of(p, pair))) {
            /* Ellipses so flat that their form overflows are not judged. */
            if (fmin(of[0], of[1]) < 1e-100 || fmax(of[0], of[1]) > 1e100 || pressure > 1e150) continue;
            const quad c = cos(of[2]), s = sin(of[2]);
            const quad along[2] = {(c * t[0] + s * t[1]) / of[0], (c * t[1] - s * t[0]) / of[1]};
            /* The rounding of the angle turns the axes. */
            const quad turned = 64 * UNIT * length(t, 2) * (1 / (quad)of[0] + 1 / (quad)of[1]);
            REQUIRE(length(along, 2) <= pressure * (1 + 1e-12) + turned + lost);
        } else {
            REQUIRE(length(t, 2) <= (slope * pressure + offset) * (1 + DIGITS) + lost);
        }
    }
}

/* K d - f, and the sums of its parts. */
static void forces(const problem *p, const double *d, quad *force, quad *parts)
{
    for (int64_t i = 0; i < p->n; i++) {
        force[i] = -(quad)p->f[i];
        parts[i] = 0;
        for (int64_t j = 0; j < p->n; j++) {
            const quad product = (quad)p->K[i + p->ld * j] * d[j];
            force[i] += product;
            parts[i] += magnitude(product);
        }
    }
}

/* The largest eigenvalue of the tangential block of a pair. */
static quad tangential(const problem *p, int64_t pair)
{
    const int64_t t = p->dim * pair + 1;
    const quad a = p->K[t + p->ld * t];
    if (p->dim == 2) return a;
    const quad b = p->K[t + p->ld * (t + 1)], c = p->K[t + 1 + p->ld * (t + 1)];
    const quad half[2] = {(a - c) / 2, b};
    return (a + c) / 2 + length(half, 2);
}

/*
 * The natural residual at d, and what rounding d to doubles may be of it:
 * e_n = max(k_n (d_n - gap), F_n - a); e_t = F_t + g h where the trial y = k_t (d_t - slip0) - F_t = |y| h is
 * longer than the bound g, else k_t (d_t - slip0). A change of F by u |K| |d| changes e_n by no more, e_t by
 * twice that and mu times that of F_n.
 */
static quad residual(const problem *p, const double *d, const quad *force, const quad *parts,
                     quad *rounding)
{
    quad sum = 0, error = 0;
    for (int64_t pair = 0; pair < p->pairs; pair++) {
        const int64_t i = p->dim * pair;
        double slope, offset, tension;
        bound_of(p, pair, &slope, &offset, &tension);
        /* A stiffness that a condensation has rounded to below zero is no unit: the pair's stands for it. */
        const quad own_t = tangential(p, pair), own_n = p->K[i + p->ld * i];
        const quad k_t = own_t > 0 ? own_t : own_n, k_n = own_n > 0 ? own_n : own_t;
        if (law_of(p, pair) == SIGNORINI_LAW_TIED) {
            for (int c = 0; c < p->dim; c++) {
                const double from = c == 0 ? p->gap[pair] : p->slip0 ? p->slip0[(p->dim - 1) * pair + c - 1] : 0;
                const quad k = c == 0 ? k_n : k_t, apart = k * ((quad)d[i + c] - from);
                const quad off = is_free(p, pair) ? force[i + c] : apart;
                const quad change = parts[i + c] + k * magnitude(d[i + c]);
                sum += off * off;
                error += change * change;
            }
            continue;
        }
        quad e = force[i] - tension, change = parts[i];
        if (!isinf(p->gap[pair])) e = larger(e, k_n * ((quad)d[i] - p->gap[pair]));
        sum += e * e;
        error += change * change;
        const quad bound = slope * larger(-force[i], -tension) + offset;
        quad slip[2] = {0, 0}, trial[2] = {0, 0};
        for (int c = 0; c + 1 < p->dim; c++) {
            const double from = p->slip0 ? p->slip0[(p->dim - 1) * pair + c] : 0;
            slip[c] = k_t * ((quad)d[i + 1 + c] - from);
            trial[c] = slip[c] - force[i + 1 + c];
        }
        const quad size = length(trial, 2);
        for (int c = 0; c + 1 < p->dim; c++) {
            const quad own = k_t * magnitude(d[i + 1 + c]);
            e = size > bound ? force[i + 1 + c] + bound * (trial[c] / size) : slip[c];
            change = 2 * parts[i + 1 + c] + slope * parts[i] + own;
            sum += e * e;
            error += change * change;
        }
    }
    *rounding = UNIT * root(error);
    return root(sum);
}

void judge_solution(const problem *p, double tolerance, const double *d, const double *F,
                    const int32_t *state, const signorini_report *report)
{
    quad force[MOST], parts[MOST], rounding, size = 0, loads[MOST];
    for (int64_t i = 0; i < p->n; i++) REQUIRE(isfinite(d[i]) && isfinite(F[i]));
    judge_law(p, F, state);
    forces(p, d, force, parts);
    quad most = 0, allowed = LEAST;
    for (int64_t i = 0; i < p->n; i++) {
        loads[i] = p->f[i];
        most = larger(most, magnitude(force[i] - F[i]));
        allowed = larger(allowed, 8 * UNIT * (parts[i] + magnitude(p->f[i]) + magnitude(F[i])));
    }
    size = larger(length(loads, p->n), length(force, p->n));
    if (report && report->struct_size == sizeof *report) {
        REQUIRE(report->eta >= 0 && report->eta <= tolerance);
        REQUIRE(report->status == SIGNORINI_STATUS_SOLVED);
        REQUIRE(report->pairs_open + report->pairs_slipping + report->pairs_sticking == p->pairs);
        if (most > report->equilibrium * (1 + DIGITS) + allowed)
            complain("|K d - f - F| is %g, reported %g, rounding %g", (double)most,
                     report->equilibrium, (double)allowed);
    }
    if (has(p, is_ellipse)) return;
    const quad left = residual(p, d, force, parts, &rounding);
    /* The certificate forgives 16 roundings of the rows of bodies that move as far as gaps and slips tell. */
    const double roundings = sane() && p->definite ? 2 : 20;
    if (!(left <= size * tolerance * (1 + DIGITS) + roundings * rounding + LEAST))
        complain("solved, eta is %g, rounding %g, tolerance %g", (double)(left / size),
                 (double)(rounding / size), tolerance);
}

void judge_motion(const problem *p, const double *r)
{
    quad most = 0, work = 0, size = 0, stiffest = 0;
    for (int64_t i = 0; i < p->n; i++) stiffest = larger(stiffest, p->K[i + p->ld * i]);
    if (p->definite) complain("no equilibrium of a definite matrix");
    for (int64_t i = 0; i < p->n; i++) {
        REQUIRE(isfinite(r[i]));
        most = larger(most, magnitude(r[i]));
        work += (quad)p->f[i] * r[i];
        /* A component that nothing resists has the unit of the stiffest one. */
        const quad own = p->K[i + p->ld * i];
        size = larger(size, root(own > 0 ? own : stiffest) * magnitude(r[i]));
    }
    REQUIRE(most == 1);
    if (!has(p, resists)) REQUIRE(work > 0);
    /* Stiffnesses some 1e16 apart in one matrix are beside each other as rounding is: not judged. */
    for (int64_t i = 0; i < p->n; i++) {
        if (!sane()) break;
        quad force = 0;
        for (int64_t j = 0; j < p->n; j++) force += (quad)p->K[i + p->ld * j] * r[j];
        if (magnitude(force) > 1e-7 * root(p->K[i + p->ld * i]) * size + LEAST)
            complain("K r is %g in row %d, %g allowed", (double)force, (int)i,
                     (double)(1e-7 * root(p->K[i + p->ld * i]) * size));
    }
}

void judge_flexibility(const problem *p, double tolerance, const double *d, const double *F,
                       const int32_t *state)
{
    quad worst = 0, size = 0, rounding = 0, least = 1e300;
    judge_law(p, F, state);
    for (int64_t i = 0; i < p->n; i++) size = larger(size, magnitude(F[i]));
    for (int64_t pair = 0; pair < p->pairs; pair++) {
        for (int c = 0; c < p->dim; c++) {
            const int64_t i = p->dim * pair + c;
            const quad w = c == 0 ? (quad)p->K[i + p->ld * i] : tangential(p, pair);
            quad error = (quad)d[i] - p->f[i], parts = magnitude(p->f[i]);
            for (int64_t j = 0; j < p->n; j++) {
                error -= (quad)p->K[i + p->ld * j] * F[j];
                parts += magnitude((quad)p->K[i + p->ld * j] * F[j]);
            }
            REQUIRE(isfinite(d[i]));
            /* A component that nothing moves has no unit of force: its d is its q. */
            if (w == 0) {
                REQUIRE(magnitude(error) <= 8 * UNIT * parts + LEAST);
                if (p->f[i] != 0) return;
                continue;
            }
            worst = larger(worst, magnitude(error) / w);
            const quad undone = magnitude(p->f[i]) / w;
            size = larger(size, undone);
            if (undone > 0 && undone < least) least = undone;
            /* A product that underflows is off by a subnormal number. */
            const quad lost = UNIT * parts + (quad)DBL_TRUE_MIN * (p->n + 1);
            rounding = larger(rounding, 8 * lost / w);
        }
    }
    /* Free displacements some 1e10 apart: those that are small beside the others are not judged. */
    if (size > 1e10 * least) return;
    /* Forces below 1e-11 of the largest are those of an open pair, and 0: signorini.h, SIGNORINI_STATE_OPEN. */
    if (worst > 8 * fmax(tolerance, 1e-11) * size + (sane() ? 1 : 20) * rounding + LEAST)
        complain("d - W F - q is %g of the forces", (double)(worst / size));
}

/* Rows are measured by the largest of all: the library has one scale for the problem. */
void judge_lcp(int64_t n, const double *M, int64_t ld, const double *q, double tolerance,
               const double *w, const double *z)
{
    quad scale = 0, worst = 0;
    int64_t at = 0;
    for (int64_t i = 0; i < n; i++) {
        REQUIRE(isfinite(w[i]) && isfinite(z[i]) && w[i] >= 0 && z[i] >= 0);
        quad error = (quad)w[i] - q[i], parts = magnitude(q[i]) + w[i];
        for (int64_t j = 0; j < n; j++) {
            error -= (quad)M[i + ld * j] * z[j];
            parts += magnitude((quad)M[i + ld * j] * z[j]);
        }
        /* One of the two numbers should be zero: the smaller is an error. */
        const quad m = magnitude(M[i + ld * i]);
        const quad both = larger(magnitude(error), w[i] < m * z[i] ? (quad)w[i] : m * z[i]);
        scale = larger(scale, parts);
        if (both > worst) { worst = both; at = i; }
    }
    if (worst > (8 * tolerance + 16 * UNIT) * scale + LEAST)
        complain("row %d lacks %g of %g: w %g, z %g", (int)at, (double)worst, (double)scale, w[at],
                 z[at]);
}

void judge_ray(int64_t n, const double *M, int64_t ld, const double *q, const double *y)
{
    quad work = 0;
    for (int64_t i = 0; i < n; i++) {
        REQUIRE(isfinite(y[i]) && y[i] >= 0);
        work += (quad)q[i] * y[i];
    }
    REQUIRE(work < 0);
    for (int64_t j = 0; j < n; j++) {
        quad sum = 0, parts = 0;
        for (int64_t i = 0; i < n; i++) {
            sum += (quad)M[i + ld * j] * y[i];
            parts += magnitude((quad)M[i + ld * j] * y[i]);
        }
        if (sum > 1e-9 * parts + LEAST) complain("M' y is %g in column %d", (double)sum, (int)j);
    }
}
