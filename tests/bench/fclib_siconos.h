/*
 * Solvers of Siconos for a friction problem in local form, by its own drivers.
 */

#ifndef FCLIB_SICONOS_H
#define FCLIB_SICONOS_H

#include "local_form.h"

#include <stddef.h>

struct siconos_solver {
    const char *name;
    int dim, id, local; /* local: another solver of one contact than Gauss-Seidel's own, or 0 */
    int blocks;         /* whether W is stored in blocks of a contact each, else dense */
    int iterations;
};

extern const struct siconos_solver siconos_solvers[];
extern const size_t siconos_solver_count;

/* Solves the problem, from r = 0; returns the seconds of processor time of the driver alone, to
 * which limit applies. */
double siconos_solve(const struct siconos_solver *solver, const struct local_form *form,
                     double tolerance, double limit, double *r);

/* Processor time of this thread. */
double seconds_used(void);

/* SIGPROF ends the process after so much processor time from now on. */
void limit_time(double seconds);

#endif
