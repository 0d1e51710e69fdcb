/*
 * The bolted junction: what its solutions are checked against. Every check prints one line.
 */

#ifndef JUNCTION_CHECK_H
#define JUNCTION_CHECK_H

#include "../common/checks.h"
#include "junction_output.h"

#include <stddef.h>

/* The ring carries the closing load to zones 2 and 3; the cover carries the inner pressure and
 * what zone 1 bears to zone 2. */
void check_balance(struct checks *checks, const struct junction *junction,
                   const struct history *history, double closing_force);

/* States, forces and openings that are known from another program. */
void check_prototype(struct checks *checks, const struct junction *junction,
                     const struct history *history);

/* The displacements u of mu = 0.3, closed: axial stress against that program's. */
void check_stress(struct checks *checks, const struct junction *junction, const double u[DOFS]);

/* Back at the closing load, friction leaves another state than before; without friction none. */
void check_unloading(struct checks *checks, const struct history *history);

/* Two methods, the same answer: a case of one history against a case of another. */
void check_same(struct checks *checks, const char *what, const struct history *expected,
                size_t expected_case, const struct history *computed, size_t computed_case);

#endif
