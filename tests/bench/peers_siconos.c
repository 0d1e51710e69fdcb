/*
 * The solvers of Siconos, by its own drivers with its own defaults. Changed are: the tolerance, the
 * number of iterations, so that none ends early, and silence. Matrices are dense: Gauss-Seidel on
 * the same matrix stored in blocks of a pair each was tried and takes nine times as long.
 *
 * In space also tried at 25 pairs, and left out: NSGSV, HP, PFP, SOCLCP, DSFP and ADMM, which
 * crashed, did not end or ended with wrong answers; VI_FPP, FPP, EG and TFP, which VI_EG and PROX
 * bettered; NSGS with the quartic local solver, which at times never ends, and with the damped
 * Newton one, which took more time for the same steps than the plain one. NSN_AC_TEST, NSN_NM and
 * PROX, the best of no problem with 225 pairs and mostly far behind, are given no larger ones.
 */

#include "peers_solvers.h"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <LinearComplementarityProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>
#include <lcp_cst.h>
#include <stdlib.h>

/* A solver with another local solver than its own has the id: its own + LOCAL times the other's. */
enum { LOCAL = 10000 };

static int is_newton(int id)
{
    return id == SICONOS_FRICTION_3D_NSN_AC || id == SICONOS_FRICTION_3D_NSN_FB ||
           id == SICONOS_FRICTION_3D_NSN_NM;
}

void siconos_prepare(void)
{
    numerics_set_verbose(0);
}

static void keep(struct outcome *outcome, int code, const SolverOptions *options, double seconds)
{
    outcome->code = code;
    outcome->iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    /* It does not count the first pivot, by which the covering vector enters. */
    if (options->solverId == SICONOS_LCP_LEMKE || options->solverId == SICONOS_FRICTION_2D_LEMKE)
        outcome->iterations++;
    if (!outcome->finished || seconds < outcome->seconds)
        outcome->seconds = seconds;
    outcome->finished = 1;
}

static void call_lcp(const struct solver *solver, const struct problem *problem, double tolerance,
                     struct outcome *outcome)
{
    const struct lcp *lcp =
        solver->answer == OPENINGS ? &problem->stiffness : &problem->flexibility;
    const int n = (int)lcp->size;
    NumericsMatrix *M = NM_create_from_data(NM_DENSE, n, n, lcp->M);
    LinearComplementarityProblem data = {.size = n, .M = M, .q = lcp->q};
    SolverOptions *options = solver_options_create(solver->id);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = solver->id == SICONOS_LCP_NEWTONMIN ? 200 : 100000;
    /* Over-relaxation pays in the stiffness form alone. */
    if (solver->id == SICONOS_LCP_PSOR && options->dSize > SICONOS_LCP_DPARAM_RHO)
        options->dparam[SICONOS_LCP_DPARAM_RHO] = solver->answer == OPENINGS ? 1.8 : 1.0;
    for (int i = 0; i < n; i++)
        outcome->x[i] = outcome->y[i] = 0.0;

    const double begin = thread_seconds();
    const int code = linearComplementarity_driver(&data, outcome->x, outcome->y, options);
    keep(outcome, code, options, thread_seconds() - begin);

    solver_options_delete(options);
    M->matrix0 = NULL; /* ours */
    NM_clear(M);
    free(M);
}

static void call_friction(const struct solver *solver, const struct problem *problem,
                          double tolerance, struct outcome *outcome)
{
    const int n = (int)problem->flexibility.size;
    NumericsMatrix *M = NM_create_from_data(NM_DENSE, n, n, problem->flexibility.M);
    FrictionContactProblem data = {.dimension = 2, .numberOfContacts = n / 2, .M = M,
        .q = problem->flexibility.q, .mu = problem->mu_of};
    SolverOptions *options = solver_options_create(solver->id);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = 100000;
    for (size_t i = 0; i < options->numberOfInternalSolvers; i++) {
        options->internalSolvers[i]->iparam[SICONOS_IPARAM_MAX_ITER] = 100000;
        options->internalSolvers[i]->dparam[SICONOS_DPARAM_TOL] = tolerance;
    }
    for (int i = 0; i < n; i++)
        outcome->x[i] = outcome->y[i] = 0.0;

    const double begin = thread_seconds();
    const int code = fc2d_driver(&data, outcome->x, outcome->y, options);
    keep(outcome, code, options, thread_seconds() - begin);

    solver_options_delete(options);
    M->matrix0 = NULL;
    NM_clear(M);
    free(M);
}

static void call_space(const struct solver *solver, const struct problem *problem,
                       double tolerance, struct outcome *outcome)
{
    const int n = (int)problem->flexibility.size;
    const int local = solver->id / LOCAL, id = solver->id % LOCAL;
    NumericsMatrix *M = NM_create_from_data(NM_DENSE, n, n, problem->flexibility.M);
    FrictionContactProblem data = {.dimension = 3, .numberOfContacts = n / 3, .M = M,
        .q = problem->flexibility.q, .mu = problem->mu_of};
    SolverOptions *options = solver_options_create(id);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = is_newton(id) ? 1000 : 1000000;
    if (local > 0)
        solver_options_update_internal(options, 0, local);
    for (int i = 0; i < n; i++)
        outcome->x[i] = outcome->y[i] = 0.0;

    const double begin = thread_seconds();
    const int code = fc3d_driver(&data, outcome->x, outcome->y, options);
    keep(outcome, code, options, thread_seconds() - begin);

    solver_options_delete(options);
    M->matrix0 = NULL;
    NM_clear(M);
    free(M);
}

#define LCP(name, form, iterative, id) \
    {FRICTIONLESS, "siconos", name, form, iterative, 0, id, call_lcp}
#define FRICTION(name, iterative, id) \
    {FRICTION_2D, "siconos", name, REACTIONS, iterative, 0, id, call_friction}
#define SPACE(name, most, id) \
    {FRICTION_3D, "siconos", name, REACTIONS, 1, most, SICONOS_FRICTION_3D_##id, call_space}
#define GAUSS_SEIDEL(name, most, local) \
    SPACE(name, most, NSGS + LOCAL * SICONOS_FRICTION_3D_ONECONTACT_##local)

const struct solver siconos_solvers[] = {
    LCP("lemke_K", OPENINGS, 0, SICONOS_LCP_LEMKE),
    LCP("lemke_W", PRESSURES, 0, SICONOS_LCP_LEMKE),
    LCP("newton_min_K", OPENINGS, 1, SICONOS_LCP_NEWTONMIN),
    LCP("newton_min_W", PRESSURES, 1, SICONOS_LCP_NEWTONMIN),
    LCP("pgs_K", OPENINGS, 1, SICONOS_LCP_PGS),
    LCP("pgs_W", PRESSURES, 1, SICONOS_LCP_PGS),
    LCP("psor_K", OPENINGS, 1, SICONOS_LCP_PSOR),
    LCP("psor_W", PRESSURES, 1, SICONOS_LCP_PSOR),
    FRICTION("nsgs", 1, SICONOS_FRICTION_2D_NSGS),
    FRICTION("cpg", 1, SICONOS_FRICTION_2D_CPG),
    FRICTION("lemke", 0, SICONOS_FRICTION_2D_LEMKE),
    SPACE("nsgs", 0, NSGS),
    GAUSS_SEIDEL("nsgs_cone", 0, ProjectionOnConeWithLocalIteration),
    GAUSS_SEIDEL("nsgs_nsn", 0, NSN),
    SPACE("nsn_ac", 0, NSN_AC),
    SPACE("nsn_ac_test", 225, NSN_AC_TEST),
    SPACE("nsn_fb", 0, NSN_FB),
    SPACE("nsn_nm", 225, NSN_NM),
    SPACE("aclmfp", 0, ACLMFP),
    SPACE("vi_eg", 0, VI_EG),
    SPACE("prox", 225, PROX),
};
const size_t siconos_solver_count = sizeof siconos_solvers / sizeof siconos_solvers[0];
