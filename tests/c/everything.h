/*
 * All of the library for tests: the headers with what may still change, what handles show in one expression,
 * and problems that are measured, proved or solved by a model of their own.
 */

#ifndef EVERYTHING_H
#define EVERYTHING_H

#define SIGNORINI_UNSTABLE
#include "signorini_file.h"
#include "signorini_surface.h"

#include <stdlib.h>
#include <string.h>

/* ---- what handles show; of NULL zeros ---- */

static inline signorini_model_data model_data(const signorini_model *model)
{
    signorini_model_data data = {0};
    data.struct_size = sizeof data;
    signorini_model_view(model, &data);
    return data;
}

static inline signorini_surface_data surface_data(const signorini_surface_pairs *contact)
{
    signorini_surface_data data = {0};
    data.struct_size = sizeof data;
    signorini_surface_view(contact, &data);
    return data;
}

static inline signorini_problem_data problem_data(const signorini_problem *problem)
{
    signorini_problem_data data = {0};
    data.struct_size = sizeof data;
    signorini_problem_view(problem, &data);
    return data;
}

/* Copies the stiffness of a model; -1: there is none. */
static inline int32_t copy_stiffness(const signorini_model *model, double *K)
{
    const signorini_model_data data = model_data(model);
    const int64_t n = data.dim * data.pairs;
    if (n > 0 && !data.K) return -1;
    if (n > 0 && K) memcpy(K, data.K, (size_t)(n * n) * sizeof *K);
    return 0;
}

/* Copies the frames of a model; -1: there are none. */
static inline int32_t copy_frames(const signorini_model *model, double *frames)
{
    const signorini_model_data data = model_data(model);
    if (data.pairs == 0) return 0;
    if (!data.frames || !frames) return -1;
    memcpy(frames, data.frames, (size_t)(data.dim * data.dim * data.pairs) * sizeof *frames);
    return 0;
}

/* ---- calls on a model of their own: the status of the call that fails ---- */

/* signorini_model_certify of a condensed problem. */
static inline int32_t certify_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                              const double *gap, int32_t law, const double *friction, const double *slip0,
                              double tolerance, const double *d, double *F, int32_t *state,
                              signorini_report *report)
{
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_condensed(dim, pairs, K, ldk, NULL, &model);
    if (status == 0)
        status = signorini_model_certify(model, f, NULL, gap, law, friction, slip0, tolerance, d, F, state,
                                         report);
    signorini_model_free(model);
    return status;
}

/* signorini_model_prove of a condensed problem. */
static inline int32_t prove_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                            const double *gap, int32_t law, const double *friction, const double *slip0,
                            const double *d, const int32_t *state, double *F, double *radius_d,
                            double *radius_F)
{
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_condensed(dim, pairs, K, ldk, NULL, &model);
    if (status == 0)
        status = signorini_model_prove(model, f, NULL, gap, law, friction, slip0, d, state, F, radius_d,
                                       radius_F);
    signorini_model_free(model);
    return status;
}

/* One load case of a model in flexibility form, which is released; gap NULL: zero. */
static inline int32_t solve_and_free(signorini_model *model, int64_t pairs, const double *q, const double *gap,
                                     int32_t law, const double *friction, const double *slip0,
                                     const signorini_settings *settings, double *d, double *F, int32_t *state,
                                     signorini_report *report, const signorini_extra *extra)
{
    double *closed = gap || pairs < 1 ? NULL : (double *)calloc((size_t)pairs, sizeof *closed);
    const int32_t status = signorini_model_solve(model, 1, q, NULL, gap ? gap : closed, law, friction, slip0,
                                                 settings, d, F, state, NULL, report, extra);
    free(closed);
    signorini_model_free(model);
    return status;
}

/* One load case in flexibility form with a dense matrix. */
static inline int32_t solve_flexibility(int32_t dim, int64_t pairs, const double *W, int64_t ldw,
                                        const double *q, const double *gap, int32_t law,
                                        const double *friction, const double *slip0,
                                        const signorini_settings *settings, double *d, double *F,
                                        int32_t *state, signorini_report *report,
                                        const signorini_extra *extra)
{
    signorini_model *model = NULL;
    const int32_t status = signorini_model_new_flexibility(dim, pairs, W, ldw, &model);
    if (status != 0) return status;
    return solve_and_free(model, pairs, q, gap, law, friction, slip0, settings, d, F, state, report, extra);
}

/* With a sparse one. */
static inline int32_t solve_flexibility_sparse(int32_t dim, int64_t pairs, const signorini_sparse *W,
                                               const double *q, const double *gap, int32_t law,
                                               const double *friction, const double *slip0,
                                               const signorini_settings *settings, double *d, double *F,
                                               int32_t *state, signorini_report *report,
                                               const signorini_extra *extra)
{
    signorini_model *model = NULL;
    const int32_t status = signorini_model_new_flexibility_sparse(dim, pairs, W, &model);
    if (status != 0) return status;
    return solve_and_free(model, pairs, q, gap, law, friction, slip0, settings, d, F, state, report, extra);
}

/* Lemke's method on an LCP. */
static inline int32_t lemke(int64_t n, const double *M, int64_t ldm, const double *q, const double *cover,
                            const signorini_settings *settings, double *w, double *z, double *y,
                            signorini_report *report)
{
    signorini_settings chosen;
    if (!settings) {
        signorini_settings_default(&chosen, sizeof chosen);
        settings = &chosen;
    } else if (settings->struct_size == sizeof chosen) {
        chosen = *settings;
        settings = &chosen;
    }
    if (settings == &chosen) chosen.method = SIGNORINI_METHOD_LEMKE;
    return signorini_lcp_solve(n, M, ldm, q, cover, settings, w, z, y, report);
}

#endif
