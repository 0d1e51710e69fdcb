/*
 * The solvers of both libraries behind one interface.
 */

#ifndef PEERS_SOLVERS_H
#define PEERS_SOLVERS_H

#include "peers_forms.h"

enum family { FRICTIONLESS, FRICTION_2D, FRICTION_3D };

/* One problem for every solver, made before any clock runs. */
struct problem {
    enum family family;
    enum geometry geometry;
    double mu;
    double *mu_of; /* one for each pair */
    struct contact contact;
    struct lcp stiffness;   /* FRICTIONLESS */
    struct lcp flexibility; /* of every family; empty where no peer runs */
    double lu_ms;           /* factorisation_ms() of this body; 0 where it is not asked */
};

/* Meaning of a solver's numbers. */
enum answer {
    OPENINGS,      /* x: openings, y: pressures */
    PRESSURES,     /* x: pressures, y: openings */
    DISPLACEMENTS, /* x: relative displacements (n, t) or (n, t1, t2) */
    REACTIONS      /* x: reactions, y: velocities, as Siconos has them */
};

/* The results of a call, in memory that both processes see. */
struct outcome {
    int finished;
    int code; /* 0: the solver says that it succeeded */
    int iterations;
    int fell_back; /* ours: the method that came first did not end it */
    double seconds; /* thread CPU time of the call, the least of all calls */
    double *x, *y;
};

struct solver {
    enum family family;
    const char *library;
    const char *name;
    enum answer answer;
    int iterative; /* its tolerance decides about its time */
    size_t most;   /* pairs: larger problems it is not given; 0: all are */
    int id;        /* what `call` is to do */
    void (*call)(const struct solver *solver, const struct problem *problem, double tolerance,
                 struct outcome *outcome);
};

extern const struct solver our_solvers[], siconos_solvers[];
extern const size_t our_solver_count, siconos_solver_count;

/* Once in each process, before its first call. */
void siconos_prepare(void);

#endif
