/*
 * Our own solvers: default settings but for the tolerance, through the C interface.
 */

#include "peers_solvers.h"

#include "../c/everything.h"

enum { LCP_AUTO, LCP_LEMKE, CONTACT };

static void call(const struct solver *solver, const struct problem *problem, double tolerance,
                 struct outcome *outcome)
{
    const struct lcp *lcp =
        solver->answer == PRESSURES ? &problem->flexibility : &problem->stiffness;
    const struct contact *contact = &problem->contact;
    const int64_t n = (int64_t)contact->pairs;
    const int32_t dim = (int32_t)contact->dim;
    signorini_settings settings;
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = tolerance;
    signorini_report report = {.struct_size = sizeof report};
    int32_t code = 0;

    const double begin = thread_seconds();
    switch (solver->id) {
    case LCP_AUTO:
        code = signorini_lcp_solve(n, lcp->M, n, lcp->q, NULL, &settings, outcome->y, outcome->x, NULL,
                                   &report);
        break;
    case LCP_LEMKE:
        code = lemke(n, lcp->M, n, lcp->q, NULL, &settings, outcome->y, outcome->x,
                                   NULL, &report);
        break;
    case CONTACT:
        code = signorini_solve(dim, n, contact->K, dim * n, contact->f, contact->gap,
                               SIGNORINI_LAW_COULOMB, problem->mu_of, NULL, &settings, outcome->x,
                               outcome->y, NULL, &report, NULL);
        break;
    }
    const double seconds = thread_seconds() - begin;

    outcome->code = code;
    outcome->iterations = (int)report.iterations;
    outcome->fell_back = report.fallback != SIGNORINI_FALLBACK_NONE;
    if (!outcome->finished || seconds < outcome->seconds)
        outcome->seconds = seconds;
    outcome->finished = 1;
}

const struct solver our_solvers[] = {
    {FRICTIONLESS, "signorini", "auto", OPENINGS, 0, 0, LCP_AUTO, call},
    {FRICTIONLESS, "signorini", "auto_contact", DISPLACEMENTS, 0, 0, CONTACT, call},
    {FRICTIONLESS, "signorini", "lemke", OPENINGS, 0, 0, LCP_LEMKE, call},
    {FRICTIONLESS, "signorini", "lemke_W", PRESSURES, 0, 0, LCP_LEMKE, call},
    {FRICTION_2D, "signorini", "auto", DISPLACEMENTS, 0, 0, CONTACT, call},
    {FRICTION_3D, "signorini", "auto", DISPLACEMENTS, 0, 0, CONTACT, call},
};
const size_t our_solver_count = sizeof our_solvers / sizeof our_solvers[0];
