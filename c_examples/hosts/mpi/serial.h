/*
 * One process solves the problem of all: process 0 has the library condense the whole sparse matrix,
 * and all compare with it what they found together.
 */

#ifndef SERIAL_H
#define SERIAL_H

#include "../../common/checks.h"
#include "block.h"

/* The findings of process 0. */
struct found {
    double d[SIZE], F[SIZE];
    int32_t state[PAIRS];
    signorini_report report;
};

/* The settings of both: their tolerance is far below the 1e-9 that is asked for. */
signorini_settings block_settings(void);

/* Ends all processes with a message if the status is not 0. Any process may call it. */
void insist(const char *what, int status);

/*
 * Solves by one process and compares, within 1e-9 of the largest one: the d and F of process 0, and
 * the displacements u that each process has of its part. The states are the same, and open, slip
 * and stick are all among them. Collective; checks are printed and counted by process 0.
 */
void compare_with_serial(const struct part *part, const struct found *found, const double u[],
                         struct checks *checks);

#endif
