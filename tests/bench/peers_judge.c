#include "peers_judge.h"

#include <math.h>
#include "../c/everything.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Contact forces of a pair that an answer of this family means. */
static size_t forces_of_pair(enum family family)
{
    return family == FRICTION_3D ? 3 : family == FRICTION_2D ? 2 : 1;
}

static size_t force_size(const struct problem *problem)
{
    return problem->contact.pairs * forces_of_pair(problem->family);
}

/* Largest entries of the rows: they carry openings to the unit of pressures. */
static double largest_of_row(const struct lcp *lcp, size_t i)
{
    double largest = 0.0;
    for (size_t j = 0; j < lcp->size; j++)
        largest = fmax(largest, fabs(lcp->M[j + i * lcp->size]));
    return largest;
}

/* |min(q + S z, m z)| / max(|q|, |S z|) of openings z, the library's own measure, and the pressures
 * that they mean. */
static double eta_of_openings(const struct lcp *lcp, const double *scale, const double *z,
                              double *force)
{
    const size_t n = lcp->size;
    double *Sz = need(n, sizeof *Sz), *residual = need(n, sizeof *residual);
    product(n, lcp->M, z, Sz);
    for (size_t i = 0; i < n; i++) {
        const double w = lcp->q[i] + Sz[i];
        residual[i] = fmin(w, scale[i] * z[i]);
        force[i] = fmax(0.0, w - scale[i] * z[i]);
    }
    double eta = norm(n, residual) / fmax(norm(n, lcp->q), norm(n, Sz));
    for (size_t i = 0; i < n; i++)
        if (!isfinite(z[i]))
            eta = NAN;
    free(Sz);
    free(residual);
    return eta;
}

/* Openings and pressures come with rounding of their own. An answer is measured as it is, and with
 * the openings of pairs that press set to zero: the better of both counts. */
static double certify_lcp(const struct problem *problem, enum answer kind,
                          const struct outcome *outcome, double *force)
{
    const size_t n = problem->stiffness.size;
    const double *opening = kind == OPENINGS ? outcome->x : outcome->y;
    const double *pressure = kind == OPENINGS ? outcome->y : outcome->x;
    double *scale = need(n, sizeof *scale), *other = need(n, sizeof *other);
    double *other_force = need(n, sizeof *other_force);
    for (size_t i = 0; i < n; i++) {
        scale[i] = largest_of_row(&problem->stiffness, i);
        other[i] = pressure[i] > scale[i] * opening[i] ? 0.0 : opening[i];
    }
    double eta = eta_of_openings(&problem->stiffness, scale, opening, force);
    const double second = eta_of_openings(&problem->stiffness, scale, other, other_force);
    if (!(eta <= second)) {
        eta = second;
        memcpy(force, other_force, n * sizeof *force);
    }
    free(scale);
    free(other);
    free(other_force);
    return eta;
}

static double eta_of_displacements(const struct problem *problem, const double *d, double *F)
{
    const struct contact *contact = &problem->contact;
    const int64_t n = (int64_t)contact->pairs, dim = (int64_t)contact->dim;
    signorini_report report = {.struct_size = sizeof report};
    const int32_t status =
        certify_condensed((int32_t)dim, n, contact->K, dim * n, contact->f, contact->gap,
                          SIGNORINI_LAW_COULOMB, problem->mu_of, NULL, SOLVED_ETA, d, F, NULL,
                          &report);
    return status >= 0 ? report.eta : NAN;
}

/* Reactions r are the displacements d = (gap, 0) - q - W r. They too are measured as they are, and
 * with pairs that press put on the obstacle, those inside the cone at rest. */
static double certify_reactions(const struct problem *problem, const struct outcome *outcome,
                                double *force)
{
    const struct contact *contact = &problem->contact;
    const size_t dim = contact->dim, size = dim * contact->pairs;
    const double *r = outcome->x;
    double *d = need(size, sizeof *d), *other_force = need(size, sizeof *other_force);
    product(size, problem->flexibility.M, r, d);
    for (size_t i = 0; i < size; i++)
        d[i] = (i % dim == 0 ? contact->gap[i / dim] : 0.0) - problem->flexibility.q[i] - d[i];
    double eta = eta_of_displacements(problem, d, force);
    for (size_t i = 0; i < size; i += dim) {
        const double stiff = contact->K[i * (size + 1)], gap = contact->gap[i / dim];
        if (r[i] > stiff * (gap - d[i])) {
            d[i] = gap;
            if (norm(dim - 1, &r[i + 1]) + stiff * norm(dim - 1, &d[i + 1]) < problem->mu * r[i])
                for (size_t c = 1; c < dim; c++)
                    d[i + c] = 0.0;
        }
    }
    const double second = eta_of_displacements(problem, d, other_force);
    if (!(eta <= second)) {
        eta = second;
        memcpy(force, other_force, size * sizeof *force);
    }
    free(d);
    free(other_force);
    return eta;
}

double certify(const struct problem *problem, enum answer kind, const struct outcome *outcome,
               double *force)
{
    if (kind == OPENINGS || kind == PRESSURES)
        return certify_lcp(problem, kind, outcome, force);
    if (kind == REACTIONS)
        return certify_reactions(problem, outcome, force);
    const struct contact *contact = &problem->contact;
    double *F = need(contact->dim * contact->pairs, sizeof *F);
    const double eta = eta_of_displacements(problem, outcome->x, F);
    for (size_t i = 0; i < force_size(problem); i++)
        force[i] = problem->family != FRICTIONLESS ? F[i] : -F[2 * i];
    free(F);
    return eta;
}

/* Takes an answer that is better than what the row has. */
static void take(struct row *row, const struct outcome *outcome, double eta, double *force,
                 size_t size)
{
    row->ms = 1e3 * outcome->seconds;
    row->iterations = outcome->iterations;
    row->fell_back = outcome->fell_back;
    row->eta = eta;
    memcpy(row->force, force, size * sizeof *force);
    snprintf(row->status, sizeof row->status, "%s",
             eta <= SOLVED_ETA ? "solved" : eta <= USABLE_ETA ? "inexact" : "wrong");
}

void judge(const struct solver *solver, const struct problem *problem, double limit,
           struct outcome *outcome, struct row *row)
{
    const size_t size = force_size(problem);
    double *force = need(size, sizeof *force);
    double tolerance = solver->iterative ? 1e-9 : SOLVED_ETA, spent = 0.0;
    /* The result of Siconos' Lemke is exact or not; its tolerance is for its own check alone. */
    if (!solver->iterative && strcmp(solver->library, "siconos") == 0)
        tolerance = 1e-9;

    *row = (struct row){.solver = solver, .geometry = problem->geometry,
        .pairs = problem->contact.pairs, .mu = problem->mu, .lu_ms = problem->lu_ms, .eta = NAN,
        .rel_error = NAN, .force = need(size, sizeof *force)};
    for (int attempt = 0; attempt < 6 && spent < 2.0 * limit; attempt++) {
        const enum ending ending =
            call_in_child(solver, problem, tolerance, 0, limit, outcome);
        spent += ending == OUT_OF_TIME ? limit : outcome->seconds;
        /* An answer to a looser tolerance, if there is one, says more than a failure. */
        const int has_answer = isfinite(row->eta) && row->eta <= USABLE_ETA;
        if (ending != ENDED) {
            if (!has_answer)
                snprintf(row->status, sizeof row->status, "%s",
                         ending == OUT_OF_TIME ? "time_limit" : "crashed");
            break;
        }
        const double eta = certify(problem, solver->answer, outcome, force);
        const int failed = outcome->code != 0 && !(eta <= SOLVED_ETA);
        /* Near the rounding of the data a tighter tolerance costs time and brings nothing: the
         * earlier answer stays unless the new one is clearly better. */
        const int better = !isfinite(row->eta) || eta <= SOLVED_ETA || eta < row->eta / 3.0;
        if (better && !(failed && has_answer)) {
            take(row, outcome, eta, force, size);
            row->tolerance = tolerance;
        }
        if (failed) {
            if (!has_answer)
                snprintf(row->status, sizeof row->status, "failed(%d)", outcome->code);
            break;
        }
        if (eta <= SOLVED_ETA || !solver->iterative || tolerance <= 1e-16)
            break;
        /* As much less as the certificate asks for; far less if the last step changed nothing. */
        const double factor = !better ? 1e-2 : isfinite(eta) ? 0.5 * SOLVED_ETA / eta : 0.1;
        tolerance = fmax(1e-16, tolerance * fmin(0.3, fmax(factor, 1e-3)));
    }
    free(force);
}

void time_again(const struct problem *problem, double limit, struct outcome *outcome,
                struct row *row)
{
    if (row->ms > 0.0 && row->ms < 2000.0 && row->eta <= USABLE_ETA &&
        call_in_child(row->solver, problem, row->tolerance, 1, limit, outcome) == ENDED)
        row->ms = fmin(row->ms, 1e3 * outcome->seconds);
}

int is_solved(const struct row *row)
{
    return strncmp(row->status, "solved", 6) == 0;
}

static void count_states(const struct row *row, size_t states[3])
{
    const size_t step = forces_of_pair(row->solver->family);
    for (size_t i = 0; i < row->pairs; i++) {
        const double normal = fabs(row->force[step * i]);
        const double tangential = norm(step - 1, &row->force[step * i + 1]);
        if (normal == 0.0)
            states[0]++;
        else
            states[tangential < (1.0 - 1e-9) * row->mu * normal ? 2 : 1]++;
    }
}

void compare(struct row *rows, size_t count, size_t states[3])
{
    states[0] = states[1] = states[2] = 0;
    const struct row *best = NULL;
    for (size_t k = 0; k < count; k++)
        if (is_solved(&rows[k]) && (best == NULL || rows[k].eta < best->eta))
            best = &rows[k];
    if (best != NULL)
        count_states(best, states);
    for (size_t k = 0; best != NULL && k < count; k++) {
        if (!isfinite(rows[k].eta))
            continue;
        const size_t size = rows[k].pairs * forces_of_pair(rows[k].solver->family);
        double most = 0.0, difference = 0.0;
        for (size_t i = 0; i < size; i++) {
            most = fmax(most, fabs(best->force[i]));
            difference = fmax(difference, fabs(rows[k].force[i] - best->force[i]));
        }
        rows[k].rel_error = difference / most;
        /* Certified, and yet another: with friction there may be several solutions. */
        if (is_solved(&rows[k]) && rows[k].rel_error > 1e-6)
            snprintf(rows[k].status, sizeof rows[k].status, "solved(another)");
    }
    for (size_t k = 0; k < count; k++) {
        free(rows[k].force);
        rows[k].force = NULL;
    }
}
