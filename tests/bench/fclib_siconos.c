#define _GNU_SOURCE

#include "fclib_siconos.h"
#include "dense.h"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <NumericsSparseMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#define SPACE(name, id, blocks, iterations) \
    {name, 3, SICONOS_FRICTION_3D_##id, 0, blocks, iterations}
#define GAUSS_SEIDEL(name, local, blocks) \
    {name, 3, SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_ONECONTACT_##local, blocks, 1000000}

/* The solvers that are fast as a rule come first: they limit the time of the others. */
const struct siconos_solver siconos_solvers[] = {
    SPACE("NSGS, blocks", NSGS, 1, 1000000),
    GAUSS_SEIDEL("NSGS by projection, blocks", ProjectionOnConeWithLocalIteration, 1),
    SPACE("NSN_AC, blocks", NSN_AC, 1, 1000),
    SPACE("NSN_FB, blocks", NSN_FB, 1, 1000),
    SPACE("VI_EG, blocks", VI_EG, 1, 1000000),
    SPACE("PROX, blocks", PROX, 1, 1000),
    SPACE("NSGS", NSGS, 0, 1000000),
    GAUSS_SEIDEL("NSGS by projection", ProjectionOnConeWithLocalIteration, 0),
    SPACE("NSN_AC", NSN_AC, 0, 1000),
    SPACE("NSN_FB", NSN_FB, 0, 1000),
    SPACE("VI_EG", VI_EG, 0, 1000000),
    SPACE("PROX", PROX, 0, 1000),
    SPACE("ACLMFP", ACLMFP, 0, 1000000),
    {"NSGS, blocks", 2, SICONOS_FRICTION_2D_NSGS, 0, 1, 1000000},
    {"NSGS", 2, SICONOS_FRICTION_2D_NSGS, 0, 0, 1000000},
    {"CPG", 2, SICONOS_FRICTION_2D_CPG, 0, 0, 1000000},
    {"Lemke", 2, SICONOS_FRICTION_2D_LEMKE, 0, 0, 1000000},
};
const size_t siconos_solver_count = sizeof siconos_solvers / sizeof *siconos_solvers;

double seconds_used(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void limit_time(double seconds)
{
    const double whole = floor(seconds);
    const struct itimerval limit = {.it_value = {.tv_sec = (time_t)whole,
        .tv_usec = (suseconds_t)(1e6 * (seconds - whole))}};
    setitimer(ITIMER_PROF, &limit, NULL);
}

/* W in blocks of a contact each, without those that are zero. */
static NumericsMatrix *in_blocks(const struct local_form *form)
{
    const int n = (int)form->size;
    NumericsMatrix *sparse = NM_create(NM_SPARSE, n, n);
    NM_triplet_alloc(sparse, n);
    sparse->matrix2->origin = NSM_TRIPLET;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double value = form->W[(size_t)i + (size_t)j * form->size];
            if (value != 0.0)
                CSparseMatrix_entry(sparse->matrix2->triplet, i, j, value);
        }
    SparseBlockStructuredMatrix *blocks = SBM_new();
    SBM_from_csparse(form->dim, NM_csc(sparse), blocks);
    NM_clear(sparse);
    free(sparse);
    return NM_create_from_data(NM_SPARSE_BLOCK, n, n, blocks);
}

static NumericsMatrix *dense(const struct local_form *form)
{
    const int n = (int)form->size;
    return NM_create_from_data(NM_DENSE, n, n, form->W);
}

double siconos_solve(const struct siconos_solver *solver, const struct local_form *form,
                     double tolerance, double limit, double *r)
{
    NumericsMatrix *M = solver->blocks ? in_blocks(form) : dense(form);
    FrictionContactProblem data = {.dimension = form->dim,
        .numberOfContacts = (int)form->contacts, .M = M, .q = form->q, .mu = form->mu};
    double *u = need(form->size);
    SolverOptions *options = solver_options_create(solver->id);
    numerics_set_verbose(0);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = solver->iterations;
    if (solver->local != 0)
        solver_options_update_internal(options, 0, solver->local);
    memset(r, 0, form->size * sizeof *r);

    limit_time(limit);
    const double began = seconds_used();
    if (form->dim == 2)
        fc2d_driver(&data, r, u, options);
    else
        fc3d_driver(&data, r, u, options);
    const double took = seconds_used() - began;

    solver_options_delete(options);
    M->matrix0 = solver->blocks ? M->matrix0 : NULL; /* the form's */
    NM_clear(M);
    free(M);
    free(u);
    return took;
}
