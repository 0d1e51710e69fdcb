/* signorini_model_certify and signorini_model_prove of any displacements. */

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    const problem p = a_problem();
    double *d = numbers(p.n), *F = or_null(outputs(p.n), 8);
    int32_t *state = or_null(states(p.pairs), 8), *given = NULL;
    signorini_report *report = or_null(a_report(), 8);
    double *radius_d = outputs(p.n), *radius_F = or_null(outputs(p.n), 8);
    if (p.pairs > 0 && rarely(2)) {
        given = input((size_t)p.pairs, sizeof *given);
        for (int64_t i = 0; i < p.pairs; i++) given[i] = (int32_t)between(sane() ? 0 : -1, sane() ? 2 : 3);
    }
    const double tolerance = sane() ? 1e-8 : number();
    const int64_t pairs = size_or_wrong(p.pairs), ld = size_or_wrong(p.ld);
    arm();
    int32_t status = certify_condensed(p.dim, pairs, p.K, ld, p.f, p.gap, p.law, p.friction, p.slip0,
                                       tolerance, d, F, state, report);
    check_arrays(status);
    check_status(status, 14);
    if (status == 0 && pairs == p.pairs && F) judge_solution(&p, tolerance, d, F, state, report);
    if (F) as_input(F);
    if (state) as_input(state);
    if (report) as_input(report);
    double *force = outputs(p.n);
    arm();
    status = prove_condensed(p.dim, pairs, p.K, ld, p.f, p.gap, p.law, p.friction, p.slip0, d, given,
                             force, radius_d, radius_F);
    check_arrays(status);
    check_status(status, 14);
    if (status < 0 || pairs != p.pairs) return 0;
    REQUIRE(status == 0 || status == SIGNORINI_STATUS_NOT_PROVED);
    for (int64_t i = 0; i < p.n; i++)
        REQUIRE(status == 0 ? radius_d[i] >= 0 && isfinite(radius_d[i]) : radius_d[i] == -1);
    return 0;
}
