/*
 * The bolted junction: its solutions, and how they are shown.
 */

#ifndef JUNCTION_OUTPUT_H
#define JUNCTION_OUTPUT_H

#include "junction_mesh.h"

#include <stddef.h>
#include <stdint.h>

enum { STEPS = 6, MOST_CASES = 5 };

struct step {
    const char *name;
    double inner; /* MPa */
};

extern const struct step steps[STEPS];

/* Load steps for several friction coefficients side by side: arrays as the library has them,
 * one column for each coefficient. */
struct history {
    size_t cases;
    double mu[MOST_CASES];
    double d[STEPS][MOST_CASES][SIZE]; /* relative displacements, (n, t) for each pair */
    double F[STEPS][MOST_CASES][SIZE]; /* contact forces on the lower part, likewise */
    int32_t state[STEPS][MOST_CASES][PAIRS];
};

/* Pressing force of a zone, N. */
double zone_force(const struct junction *junction, const double F[SIZE], int zone);

/* Largest opening of all pairs, mm. */
double largest_opening(const double d[SIZE]);

/* States of a zone from its smallest radius outward: o open, s slip, . stick. */
void zone_states(const struct junction *junction, const int32_t state[PAIRS], int zone,
                 char text[PAIRS + 1]);

void print_history(const struct junction *junction, const struct history *history);

/* Both return 0, or -1 with the reason in errno. */
int write_junction_csv(const char *path, const struct junction *junction,
                       const struct history *history);
int write_junction_vtk(const char *path, const char *title, const struct junction *junction,
                       const double u[DOFS]);

#endif
