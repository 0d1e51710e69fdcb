/*
 * Products and solutions by all processes, at the command of process 0.
 *
 * Two factors of the whole block lie on the processes: one with every contact component held, for
 * products with the relative stiffness; and one with some of them held, at first none, for
 * solutions. The relative stiffness K_rel itself is never formed: K_rel x is the force on the
 * contact nodes where they are displaced by x and the rest of the block is in equilibrium.
 *
 * x and y are the library's, of SIZE components, (n, t1, t2) for each pair.
 */

#ifndef SERVICE_H
#define SERVICE_H

#include "factor.h"

enum command {
    PRODUCT,       /* y = K_rel x */
    SOLUTION,      /* K_rel y = x in the components that are not held, y = 0 in the others */
    FACTORISE,     /* hold other components */
    LOADS,         /* y: the condensed loads */
    DISPLACEMENTS, /* u, on each process: contact displacements x, under the loads */
    END            /* the others leave their loop */
};

struct service {
    const struct part *part;
    struct factor inside, free; /* with every contact component held; with some or none */
    int32_t held[SIZE];         /* those of `free` */
    double *u, *force;          /* of the part */
};

/* Collective. Returns 0 or a negative number of MUMPS. */
int service_begin(struct service *service, const struct part *part);

/*
 * Process 0: sends a command and takes its own part in it. held is read by FACTORISE, x by
 * PRODUCT, SOLUTION and DISPLACEMENTS; y is written by PRODUCT, SOLUTION and LOADS. Those that are
 * not used may be NULL. Returns 0 or a negative number of MUMPS: the service goes on in both cases.
 */
int service_ask(struct service *service, enum command command, const int32_t *held,
                const double *x, double *y);

/* The other processes: obey until END. */
void service_wait(struct service *service);

void service_end(struct service *service);

#endif
