/*
 * Solves a friction problem of the Frictional Contact Library (FCLIB): an HDF5 file that libfclib
 * reads (Debian: libfclib-dev).
 *
 *     solve_fclib FILE
 *
 * It returns 0 if the problem is solved, 1 if it is not, 2 if the file or the arguments are wrong.
 *
 * FCLIB's local form: reactions r and relative velocities u of contacts, m components ordered
 * contact by contact as (N, T) or (N, T, S), with
 *
 *     u = W r + q,      C* contains u^, C contains r, u^ . r = 0,      u^ = u + mu |u_T| e_N,
 *
 * C the cone |r_T| <= mu r_N, C* its dual. In words: u_N >= 0, r_N >= 0, u_N r_N = 0, and
 * |r_T| <= mu r_N, with u_T = 0 or u_T = -lambda r_T, lambda >= 0, |r_T| = mu r_N.
 *
 * This library's flexibility form: d = W F + q', d_n <= gap, F_n <= 0, (d_n - gap) F_n = 0, and
 * d_t = 0 or d_t = -lambda F_t with |F_t| = mu |F_n|. FCLIB's u opens a contact where u_N > 0, our d
 * closes it where d_n > 0; r presses on the body, and so does F where F_n < 0. So all components
 * change sign, the order of components stays, and the gap is closed at d = 0:
 *
 *     d = -u,    F = -r,    W = W,    q' = -q,    gap = 0,    slip0 = 0.
 *
 * Check: W F + q' = -(W r + q) = -u = d. d_n = -u_N <= 0, F_n = -r_N <= 0, and
 * d_t = -u_T = lambda r_T = -lambda F_t. Velocities and impulses may take the place of
 * displacements and forces.
 *
 * W is handed over sparse: contacts that no entry ties to each other are solved by themselves.
 * W of rigid bodies with more contacts than they have freedom is singular: reactions are not unique
 * then, and another program may have found others.
 */

#include "dense.h"
#include "local_form.h"
#include "signorini.h"

#include <fclib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SOLVED, NOT_SOLVED, WRONG };

/* W of files is symmetric up to rounding. Single precision is the least that a program which wrote
 * the file may have had. */
static const double ASYMMETRY = 1e-6;

/* Reactions of another origin beside ours. */
static void print_other(const char *what, const struct local_form *form, const double *other,
                        const double *r)
{
    double largest = 0.0, difference = 0.0;
    for (size_t i = 0; i < form->size; i++) {
        largest = fmax(largest, fabs(r[i]));
        difference = fmax(difference, fabs(r[i] - other[i]));
    }
    printf("%-9s residual %.1e, differs by %.1e of the largest reaction\n", what,
           local_form_residual(form, other), largest > 0.0 ? difference / largest : difference);
}

static void print_others(const char *path, const struct local_form *form, const double *r)
{
    if (file_has(path, "/solution")) {
        struct fclib_solution *solution = fclib_read_solution(path);
        if (solution != NULL) {
            print_other("solution", form, solution->r, r);
            fclib_delete_solutions(solution, 1);
        }
    }
    if (file_has(path, "/guesses")) {
        int count = 0;
        struct fclib_solution *guesses = fclib_read_guesses(path, &count);
        for (int k = 0; guesses != NULL && k < count; k++) {
            char what[32];
            snprintf(what, sizeof what, "guess %d", k + 1);
            print_other(what, form, guesses[k].r, r);
        }
        if (guesses != NULL)
            fclib_delete_solutions(guesses, count);
    }
}

/* Solves d = W F - q; leaves the reactions r = -F. */
static int32_t solve(const struct local_form *form, double *r)
{
    const size_t n = form->size;
    struct signorini_report report = {.struct_size = sizeof report};
    double *d = need(n), *q = need(n), *gap = need(form->contacts);
    signorini_model *model = NULL;
    for (size_t i = 0; i < form->contacts; i++)
        gap[i] = 0;
    for (size_t i = 0; i < n; i++)
        q[i] = -form->q[i];
    struct triangle lower = lower_triangle(form);
    const signorini_sparse W = {.struct_size = sizeof W,
        .index_bytes = sizeof *lower.row, .triangle = SIGNORINI_TRIANGLE_LOWER, .size = (int64_t)n,
        .nnz = lower.col_start[n], .col_start = lower.col_start, .row = lower.row,
        .values = lower.values};
    int32_t status = signorini_model_new_flexibility_sparse(form->dim, (int64_t)form->contacts, &W,
                                                            &model);
    if (status == 0)
        status = signorini_model_solve(model, 1, q, NULL, gap, SIGNORINI_LAW_COULOMB, form->mu, NULL,
                                       NULL, d, r, NULL, NULL, &report, NULL);
    signorini_model_free(model);
    triangle_free(&lower);
    for (size_t i = 0; i < n; i++)
        r[i] = -r[i];
    free(d);
    free(q);
    free(gap);

    printf("status    %d, %s\n", (int)status, signorini_status_string(status));
    if (status != SIGNORINI_STATUS_SOLVED)
        printf("          %s\n", signorini_last_error());
    if (status >= 0) {
        printf("eta       %.1e, %lld iterations, %lld factorisations\n", report.eta,
               (long long)report.iterations, (long long)report.factorisations);
        printf("contacts  %lld open, %lld slip, %lld stick\n", (long long)report.pairs_open,
               (long long)report.pairs_slipping, (long long)report.pairs_sticking);
        printf("residual  %.1e, of the problem as the file has it\n",
               local_form_residual(form, r));
        for (int32_t remark = 1; remark <= report.remarks; remark *= 2)
            if (report.remarks & remark)
                printf("remark    %s\n", signorini_remark_string(remark));
    }
    return status;
}

int main(int argc, char **argv)
{
    struct local_form form;
    if (argc != 2) {
        fprintf(stderr, "usage: %s FILE\n", argv[0]);
        return WRONG;
    }
    const char *wrong = local_form_read(argv[1], &form);
    if (wrong == NULL && form.asymmetry > ASYMMETRY) {
        wrong = "W is not symmetric: this library needs a symmetric matrix";
        local_form_free(&form);
    }
    if (wrong != NULL) {
        fprintf(stderr, "%s: %s\n", argv[1], wrong);
        return WRONG;
    }
    printf("signorini %s\nfile      %s\nproblem   FCLIB, %s form, dim %d, %zu contacts, m = %zu\n",
           signorini_version(), argv[1], form.found, form.dim, form.contacts, form.size);
    double *r = need(form.size);
    const int32_t status = solve(&form, r);
    if (status >= 0)
        print_others(argv[1], &form, r);
    free(r);
    local_form_free(&form);
    return status == SIGNORINI_STATUS_SOLVED ? SOLVED : NOT_SOLVED;
}
