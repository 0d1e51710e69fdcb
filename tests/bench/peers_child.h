/*
 * A solver's call in a process of its own: what aborts, crashes or never ends there is a result.
 */

#ifndef PEERS_CHILD_H
#define PEERS_CHILD_H

#include "peers_solvers.h"

enum ending { ENDED, CRASHED, OUT_OF_TIME };

/* Memory for outcomes of up to `size` numbers, seen by this process and its children. */
struct outcome *outcome_new(size_t size);

/* Calls the solver once, and with `repeat` again until a tenth of a second is filled, or of `limit`
 * if that is less: three times at the least, but for calls of more than two seconds. A call may
 * take `limit` seconds of CPU time. */
enum ending call_in_child(const struct solver *solver, const struct problem *problem,
                          double tolerance, int repeat, double limit, struct outcome *outcome);

#endif
