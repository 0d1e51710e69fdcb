#include "junction_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void check_balance(struct checks *checks, const struct junction *junction,
                   const struct history *history, double closing_force)
{
    const double pi = 3.14159265358979323846, bore = 40.0, limit = 1e-9;
    double ring = 0.0, cover = 0.0;
    int passed = 1;

    for (size_t s = 0; s < STEPS; s++) {
        for (size_t i = 0; i < history->cases; i++) {
            const double *F = history->F[s][i];
            const double force[ZONES] = {zone_force(junction, F, 1), zone_force(junction, F, 2),
                                         zone_force(junction, F, 3)};
            const double inside = steps[s].inner * pi * bore * bore;
            ring = fmax(ring, fabs(force[1] + force[2] - closing_force));
            cover = fmax(cover, fabs(force[1] - force[0] - inside));
            passed = passed && isfinite(force[0] + force[1] + force[2]);
        }
    }
    judge(checks, passed && ring <= limit * closing_force);
    printf("zone 2 + zone 3 = %.3f kN, the closing force, in every step: off by %.0e of it\n",
           closing_force / 1000.0, ring / closing_force);
    judge(checks, passed && cover <= limit * closing_force);
    printf("zone 2 - zone 1 = p pi 40^2, the force on the cover, in every step: off by %.0e\n",
           cover / closing_force);
}

/*
 * Prototype computation of this junction, with the same elements: an independent program in Python
 * (numpy). Forces in kN and openings in um, as it printed them.
 */
static const struct prototype {
    double mu;
    size_t step;
    const char *states[ZONES];
    double forces[ZONES];
    double opening;
} prototypes[] = {
    {0.0, 0, {"ooooooossssssssssssss", "ooossssssssss", "ssssssooo"}, {429.6, 429.6, 249.0}, 1.7},
    {0.3, 0, {"ooosss...............", "oossssss.....", "....ssooo"}, {422.3, 422.3, 256.3}, 1.4},
    {0.3, 2, {"ooooooooooooossssss..", "sssssssssss..", "...sssooo"}, {301.3, 401.8, 276.8}, 18.0},
    {0.3, 4, {"oooooooooooooooooosss", "sssssssssssss", "......soo"}, {170.0, 371.0, 307.5}, 56.8},
    {0.3, 5, {"ooooooooosssssssss...", "oooossss....s", ".....ssoo"}, {430.7, 430.7, 247.9}, 2.2},
};

static int same_digits(double computed, double printed)
{
    return fabs(computed - printed) <= 0.05 * (1.0 + 1e-9);
}

void check_prototype(struct checks *checks, const struct junction *junction,
                     const struct history *history)
{
    for (size_t p = 0; p < sizeof prototypes / sizeof *prototypes; p++) {
        const struct prototype *known = &prototypes[p];
        int states = 1, forces = 1;
        size_t i = 0;
        while (i + 1 < history->cases && history->mu[i] != known->mu)
            i += 1;
        for (int zone = 1; zone <= ZONES; zone++) {
            const double force = zone_force(junction, history->F[known->step][i], zone);
            char text[PAIRS + 1];
            zone_states(junction, history->state[known->step][i], zone, text);
            states = states && strcmp(text, known->states[zone - 1]) == 0;
            forces = forces && same_digits(force / 1000.0, known->forces[zone - 1]);
        }
        judge(checks, states);
        printf("mu = %.1f, %s: all states as in the prototype\n", known->mu,
               steps[known->step].name);
        judge(checks, forces);
        printf("mu = %.1f, %s: forces as in the prototype, %.1f, %.1f, %.1f kN\n", known->mu,
               steps[known->step].name, known->forces[0], known->forces[1], known->forces[2]);
        judge(checks, same_digits(1000.0 * largest_opening(history->d[known->step][i]),
                                  known->opening));
        printf("mu = %.1f, %s: largest opening as in the prototype, %.1f um\n", known->mu,
               steps[known->step].name, known->opening);
    }
}

void check_stress(struct checks *checks, const struct junction *junction, const double u[DOFS])
{
    const double known_lowest = -69.0, known_highest = 11.0; /* MPa, as printed there */
    double at_nodes[NODES], of_elements[ELEMENTS];
    double lowest = INFINITY, highest = -INFINITY;

    junction_stress(junction, u, at_nodes, of_elements);
    for (size_t e = 0; e < ELEMENTS; e++) {
        lowest = fmin(lowest, of_elements[e]);
        highest = fmax(highest, of_elements[e]);
    }
    judge(checks, fabs(lowest - known_lowest) <= 0.5 && fabs(highest - known_highest) <= 0.5);
    printf("mu = 0.3, closing: sigma_zz of the elements %.1f to %.1f MPa; prototype %.0f, %.0f\n",
           lowest, highest, known_lowest, known_highest);
}

/* Largest difference of any component, relative to the largest of the expected values. */
static double difference(const double *computed, const double *expected)
{
    double worst = 0.0, largest = 0.0;
    for (size_t i = 0; i < SIZE; i++) {
        if (!isfinite(computed[i]))
            return INFINITY;
        worst = fmax(worst, fabs(computed[i] - expected[i]));
        largest = fmax(largest, fabs(expected[i]));
    }
    return worst / largest;
}

void check_unloading(struct checks *checks, const struct history *history)
{
    for (size_t i = 0; i < history->cases; i++) {
        const double forces = difference(history->F[STEPS - 1][i], history->F[0][i]);
        const double motion = difference(history->d[STEPS - 1][i], history->d[0][i]);
        size_t changed = 0;
        for (size_t pair = 0; pair < PAIRS; pair++)
            changed += history->state[STEPS - 1][i][pair] != history->state[0][i][pair];
        if (history->mu[i] > 0.0) {
            judge(checks, forces > 0.01 && motion > 0.01 && changed > 0);
            printf("mu = %.1f: unloading leaves forces that differ by %.0f %% of the largest, and "
                   "%zu other states\n",
                   history->mu[i], 100.0 * forces, changed);
        } else {
            judge(checks, forces <= 1e-9 && motion <= 1e-9 && changed == 0);
            puts("mu = 0.0: unloading leaves nothing");
        }
    }
}

void check_same(struct checks *checks, const char *what, const struct history *expected,
                size_t expected_case, const struct history *computed, size_t computed_case)
{
    const double limit = 1e-9;
    double forces = 0.0, motion = 0.0;
    size_t changed = 0;

    for (size_t s = 0; s < STEPS; s++) {
        forces = fmax(forces, difference(computed->F[s][computed_case],
                                         expected->F[s][expected_case]));
        motion = fmax(motion, difference(computed->d[s][computed_case],
                                         expected->d[s][expected_case]));
        for (size_t pair = 0; pair < PAIRS; pair++)
            changed += computed->state[s][computed_case][pair] !=
                       expected->state[s][expected_case][pair];
    }
    judge(checks, forces <= limit && motion <= limit && changed == 0);
    printf("%s, all steps: displacements off by %.0e, forces by %.0e of the largest, %zu states\n",
           what, motion, forces, changed);
}
