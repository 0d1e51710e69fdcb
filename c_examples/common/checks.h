/*
 * Tools of the example programs: counting checks, and the names of the states.
 */

#ifndef CHECKS_H
#define CHECKS_H

#include <stdint.h>

struct checks {
    int made, failed;
};

/* Counts a check and opens its line with PASS or FAIL; the caller prints what was checked. */
void judge(struct checks *checks, int passed);

/* Prints the sum of it; returns what `main` returns. */
int conclude(const struct checks *checks);

const char *state_name(int32_t state);

#endif
