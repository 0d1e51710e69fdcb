#include "service.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>

enum { ANALYSE_AND_FACTORISE = 4, FACTORISE_AGAIN = 2 }; /* JOB */

/* ---- Each process's part in the answers ------------------------------------------------------ */

/* Sums up what the parts have at the contact nodes: y on process 0. */
static void add_up(const double contact[SIZE], double *y)
{
    MPI_Reduce(contact, y, SIZE, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
}

/*
 * u: contact nodes displaced by x, or not at all where x is NULL, and the rest in equilibrium with
 * `loads` times the loads.
 */
static int displace(struct service *service, const double *x, double loads)
{
    const struct part *part = service->part;
    const int32_t dofs = part->mesh->dofs;
    double *load = obtain((size_t)dofs, sizeof *load), *rest = obtain((size_t)dofs, sizeof *rest);

    for (int32_t i = 0; i < dofs; i++) {
        const int32_t dof = part->number[i];
        const int moved = x != NULL && dof < SIZE;
        service->u[i] = moved ? contact_sign(dof) * x[contact_component(dof)] : 0.0;
        load[i] = loads * part->load[i];
    }
    brick_residual(part->mesh, service->u, load, service->force);
    for (int32_t i = 0; i < dofs; i++) {
        const int32_t dof = part->number[i];
        service->force[i] = dof < SIZE || block_held(dof) ? 0.0 : -service->force[i];
    }
    const int status = factor_solve(&service->inside, service->force, rest);
    for (int32_t i = 0; i < dofs; i++)
        service->u[i] += rest[i];
    free(load);
    free(rest);
    return status;
}

/* y on process 0: the forces that hold the contact nodes, less `loads` times the loads on them. */
static void contact_forces(struct service *service, double loads, double *y)
{
    const struct part *part = service->part;
    const int32_t dofs = part->mesh->dofs;
    double contact[SIZE] = {0}, *load = obtain((size_t)dofs, sizeof *load);

    for (int32_t i = 0; i < dofs; i++)
        load[i] = loads * part->load[i];
    brick_residual(part->mesh, service->u, load, service->force);
    for (int32_t i = 0; i < dofs; i++) {
        const int32_t dof = part->number[i];
        if (dof < SIZE)
            contact[contact_component(dof)] = contact_sign(dof) * service->force[i];
    }
    add_up(contact, y);
    free(load);
}

/* The owner alone of a node on a cut gives the force and tells the displacement. */
static int solution(struct service *service, const double x[SIZE], double *y)
{
    const struct part *part = service->part;
    double contact[SIZE] = {0};

    for (int32_t i = 0; i < part->mesh->dofs; i++) {
        const int32_t dof = part->number[i];
        service->force[i] = 0.0;
        if (dof < SIZE && !service->held[contact_component(dof)] &&
            block_owner(part->parts, dof) == part->rank)
            service->force[i] = contact_sign(dof) * x[contact_component(dof)];
    }
    const int status = factor_solve(&service->free, service->force, service->u);
    for (int32_t i = 0; i < part->mesh->dofs; i++) {
        const int32_t dof = part->number[i];
        if (dof < SIZE && block_owner(part->parts, dof) == part->rank)
            contact[contact_component(dof)] = contact_sign(dof) * service->u[i];
    }
    add_up(contact, y);
    return status;
}

static int factorise(struct service *service)
{
    factor_fill(&service->free, service->held);
    return factor_run(&service->free, FACTORISE_AGAIN);
}

static int obey(struct service *service, enum command command, const double *x, double *y)
{
    int status = 0;

    switch (command) {
    case PRODUCT:
        status = displace(service, x, 0.0);
        contact_forces(service, 0.0, y);
        return status;
    case SOLUTION:
        return solution(service, x, y);
    case FACTORISE:
        return factorise(service);
    case LOADS: /* held contact nodes need these forces against the loads: the opposite */
        status = displace(service, NULL, 1.0);
        contact_forces(service, 1.0, y);
        for (int i = 0; service->part->rank == 0 && i < SIZE; i++)
            y[i] = -y[i];
        return status;
    case DISPLACEMENTS:
        return displace(service, x, 1.0);
    case END:
        break;
    }
    return 0;
}

/* ---- Commands ------------------------------------------------------------------------------ */

int service_ask(struct service *service, enum command command, const int32_t *held,
                const double *x, double *y)
{
    int sent = command;
    double shared[SIZE] = {0};

    if (x != NULL)
        memcpy(shared, x, sizeof shared);
    if (held != NULL)
        memcpy(service->held, held, sizeof service->held);
    MPI_Bcast(&sent, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Bcast(service->held, SIZE, MPI_INT32_T, 0, MPI_COMM_WORLD);
    MPI_Bcast(shared, SIZE, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    return obey(service, command, shared, y);
}

void service_wait(struct service *service)
{
    int command = END;
    double shared[SIZE];

    do {
        MPI_Bcast(&command, 1, MPI_INT, 0, MPI_COMM_WORLD);
        MPI_Bcast(service->held, SIZE, MPI_INT32_T, 0, MPI_COMM_WORLD);
        MPI_Bcast(shared, SIZE, MPI_DOUBLE, 0, MPI_COMM_WORLD);
        obey(service, (enum command)command, shared, NULL);
    } while (command != END);
}

/* ---- Beginning and end --------------------------------------------------------------------- */

int service_begin(struct service *service, const struct part *part)
{
    int32_t all[SIZE];
    int status;

    *service = (struct service){.part = part};
    service->u = obtain((size_t)part->mesh->dofs, sizeof *service->u);
    service->force = obtain((size_t)part->mesh->dofs, sizeof *service->force);
    for (int i = 0; i < SIZE; i++)
        all[i] = 1;
    status = factor_begin(&service->inside, part);
    if (status != 0)
        return status;
    factor_fill(&service->inside, all);
    status = factor_run(&service->inside, ANALYSE_AND_FACTORISE);
    if (status != 0)
        return status;
    status = factor_begin(&service->free, part);
    if (status != 0)
        return status;
    factor_fill(&service->free, service->held);
    return factor_run(&service->free, ANALYSE_AND_FACTORISE);
}

void service_end(struct service *service)
{
    factor_end(&service->inside);
    factor_end(&service->free);
    free(service->u);
    free(service->force);
    *service = (struct service){0};
}
