/*
 * One measure for every answer, of whatever library, and what it makes of a run.
 */

#ifndef PEERS_JUDGE_H
#define PEERS_JUDGE_H

#include "peers_child.h"

/* Certified to this: solved. A peer that says "solved" with more than the second is wrong. */
#define SOLVED_ETA 1e-12
#define USABLE_ETA 1e-8

struct row {
    const struct solver *solver;
    enum geometry geometry;
    size_t pairs;
    double mu;
    double ms; /* 0: none was measured */
    double lu_ms; /* the yardstick of the problem; 0: none */
    int iterations;
    double tolerance; /* that its solver was given */
    int fell_back;    /* ours: the method that came first did not end it */
    double eta;       /* NaN: no answer */
    double rel_error; /* of the contact forces, to the best certified answer of the problem */
    char status[24];
    double *force; /* until the problem is done */
};

/* Eta of an answer, and the contact forces that it means, `flexibility.size` or fewer of them. */
double certify(const struct problem *problem, enum answer kind, const struct outcome *outcome,
               double *force);

/* Runs a solver until the certificate accepts its answer, at the loosest tolerance that does. Each
 * run is one call. */
void judge(const struct solver *solver, const struct problem *problem, double limit,
           struct outcome *outcome, struct row *row);

/* Takes the time of a short call again, and again: the least of all counts. Called for all solvers
 * in turn, more than once, it lets no solver have a slow moment of the machine for itself. */
void time_again(const struct problem *problem, double limit, struct outcome *outcome,
                struct row *row);

/* Fills rel_error of the rows of one problem, counts the pairs that are open, slip and stick in its
 * best answer, and frees the forces. */
void compare(struct row *rows, size_t count, size_t states[3]);

int is_solved(const struct row *row);

#endif
