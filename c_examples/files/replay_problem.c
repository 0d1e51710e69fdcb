/*
 * Solves a problem again that a host has written to a file, by signorini_problem_write or the like:
 * for a case that came by mail.
 *
 *     replay_problem FILE [METHOD [TOLERANCE]]
 *
 * METHOD is auto (the default), nested, diagonal, lemke, pivot, newton or path. It returns 0 if the
 * problem is solved, 1 if it is not, 2 if the file or the arguments are wrong, 130 after Ctrl-C.
 */

#include "signorini_file.h"
#include "../common/watch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SOLVED, NOT_SOLVED, WRONG };

static const char *const methods[] = {"auto", "nested", "diagonal", "lemke", "pivot", "newton",
                                       "path"};
enum { METHODS = sizeof methods / sizeof *methods };

static const char *method_name(int32_t method)
{
    return method >= 0 && method < METHODS ? methods[method] : "?";
}

static const char *uniqueness(int32_t code)
{
    switch (code) {
    case SIGNORINI_UNIQUENESS_UNIQUE: return "yes";
    case SIGNORINI_UNIQUENESS_SEVERAL: return "no, there are others";
    default: return "not known";
    }
}

static const char *law_name(int32_t law)
{
    switch (law) {
    case SIGNORINI_LAW_FRICTIONLESS: return "no friction";
    case SIGNORINI_LAW_COULOMB: return "Coulomb friction";
    case SIGNORINI_LAW_TRESCA: return "Tresca friction";
    case SIGNORINI_LAW_COHESIVE: return "friction with cohesion";
    case SIGNORINI_LAW_ORTHOTROPIC: return "orthotropic friction";
    case SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR: return "orthotropic friction, collinear slip";
    case SIGNORINI_LAW_BY_PAIR: return "a friction law for each pair";
    case SIGNORINI_LAW_TIED: return "tied";
    default: return "a law that this program does not know";
    }
}

static int print_problem(const struct signorini_problem_data *problem, const char *path)
{
    printf("signorini %s\nfile      %s\n", signorini_version(), path);
    if (*problem->remark != '\0')
        printf("remark    %s\n", problem->remark);
    switch (problem->kind) {
    case SIGNORINI_PROBLEM_CONTACT:
        printf("problem   contact, %s, dim %d, %lld pairs, N = %lld\n",
               law_name(problem->law), (int)problem->dim,
               (long long)problem->pairs,
               (long long)problem->size);
        return 1;
    case SIGNORINI_PROBLEM_LCP:
        printf("problem   linear complementarity (LCP), n = %lld%s\n",
               (long long)problem->size,
               problem->cover != NULL ? ", with a covering vector" : "");
        return 1;
    default: printf("problem   of a kind that this program does not know\n"); return 0;
    }
}

static int32_t solve(const struct signorini_problem_data *problem,
                     const struct signorini_settings *settings, double *x, double *y,
                     struct signorini_report *report)
{
    const int64_t n = problem->size, ld = n > 0 ? n : 1;

    if (problem->kind == SIGNORINI_PROBLEM_CONTACT)
        return signorini_solve(problem->dim, problem->pairs, problem->matrix, ld, problem->rhs,
                               problem->gap, problem->law, problem->friction, problem->slip0,
                               settings, x, y, NULL, report, NULL);
    return signorini_lcp_solve(n, problem->matrix, ld, problem->rhs, problem->cover, settings, x, y,
                               NULL, report);
}

static void print_report(const struct signorini_report *report, int contact)
{
    printf("method    %s", method_name(report->method));
    if (report->first_method != report->method)
        printf(", after %s", method_name(report->first_method));
    printf(": %lld iterations, %lld outer, %lld factorisations, %lld refactorisations\n",
           (long long)report->iterations, (long long)report->outer_iterations,
           (long long)report->factorisations, (long long)report->refactorisations);
    printf("eta       %.3e\n", report->eta);
    if (!contact)
        return;
    printf("rounding  %.3e\n", report->rounding);
    printf("excess    penetration %.3e, tension %.3e, friction %.3e, equilibrium %.3e\n",
           report->penetration, report->tension, report->cone_excess, report->equilibrium);
    printf("pairs     %lld open, %lld slip, %lld stick\n", (long long)report->pairs_open,
           (long long)report->pairs_slipping, (long long)report->pairs_sticking);
    printf("the only solution: %s\n", uniqueness(report->uniqueness));
    for (int32_t remark = 1; remark <= report->remarks; remark *= 2)
        if (report->remarks & remark)
            printf("remark    %s\n", signorini_remark_string(remark));
}

static int replay(const struct signorini_problem_data *problem,
                  const struct signorini_settings *settings)
{
    const size_t size = (size_t)problem->size + 1;
    struct signorini_report report = {.struct_size = sizeof report};
    double *x = malloc(size * sizeof *x), *y = malloc(size * sizeof *y);
    int32_t status;

    if (x == NULL || y == NULL) {
        fputs("not enough memory for the results\n", stderr);
        free(x);
        free(y);
        return NOT_SOLVED;
    }
    puts("solving");
    fflush(stdout);
    status = solve(problem, settings, x, y, &report);
    watch_erase();
    free(x);
    free(y);

    printf("status    %d, %s\n", (int)status, signorini_status_string(status));
    if (status != SIGNORINI_STATUS_SOLVED)
        printf("          %s\n", signorini_last_error());
    if (status >= 0)
        print_report(&report, problem->kind != SIGNORINI_PROBLEM_LCP);
    if (status == SIGNORINI_STATUS_CANCELLED)
        return watch_end();
    return status == SIGNORINI_STATUS_SOLVED ? SOLVED : NOT_SOLVED;
}

/* The method and tolerance of the command line; 0 if there is none like it. */
static int choose(int argc, char **argv, struct signorini_settings *settings)
{
    if (argc > 2) {
        int method = 0;
        while (method < METHODS && strcmp(argv[2], methods[method]) != 0)
            method++;
        if (method == METHODS)
            return 0;
        settings->method = method;
    }
    if (argc > 3) {
        char *end;
        settings->tolerance = strtod(argv[3], &end);
        if (end == argv[3] || *end != '\0')
            return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    struct signorini_problem *problem;
    struct signorini_problem_data data = {.struct_size = sizeof data};
    struct signorini_settings settings;
    int result = WRONG;

    signorini_settings_default(&settings, sizeof settings);
    if (argc < 2 || argc > 4 || !choose(argc, argv, &settings)) {
        fprintf(stderr, "usage: %s FILE [METHOD [TOLERANCE]]\nmethods:", argv[0]);
        for (int method = 0; method < METHODS; method++)
            fprintf(stderr, " %s", methods[method]);
        fputs("\n", stderr);
        return WRONG;
    }
    if (signorini_problem_read(argv[1], &problem) != 0 ||
        signorini_problem_view(problem, &data) != 0) {
        fprintf(stderr, "%s\n", signorini_last_error());
        return WRONG;
    }
    watch_begin();
    watch_calls(&settings);
    if (print_problem(&data, argv[1]))
        result = replay(&data, &settings);
    signorini_problem_free(problem);
    return result;
}
