/* signorini_solve, then a warm start, and signorini_model_certify and signorini_model_prove on what it found. */

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    const problem p = a_problem();
    const signorini_settings *settings = a_settings();
    const int64_t pairs = size_or_wrong(p.pairs), ld = size_or_wrong(p.ld);
    double *d = outputs(p.n), *F = outputs(p.n);
    int32_t *state = or_null(states(p.pairs), 8);
    signorini_report *report = or_null(a_report(), 8);
    signorini_extra *extra = an_extra(p.n, p.pairs, 1);
    const int32_t law = sane() ? p.law : (int32_t)between(p.law, p.law + rarely(16) * 3);
    /* A law of three numbers is not asked for where there is one. */
    const int32_t asked = per_pair(law) == per_pair(p.law) || law > SIGNORINI_LAW_BY_PAIR ? law : p.law;
    const int aliased = !sane() && rarely(64);
    arm();
    const int32_t status = signorini_solve(p.dim, pairs, p.K, ld, p.f, p.gap, asked, p.friction,
                                           p.slip0, settings, d, aliased ? d : F, state, report,
                                           extra);
    check_arrays(status);
    check_status(status, 15);
    const int chosen = !settings || settings->method == SIGNORINI_METHOD_AUTO;
    if (p.definite && sane() && chosen) REQUIRE(status >= 0);
    if (status < 0 || pairs != p.pairs || asked != p.law || ld != p.ld) return 0;
    REQUIRE(!aliased || p.n == 0);
    if (status == 0 || sane()) judge_law(&p, F, state);
    if (status == SIGNORINI_STATUS_NO_EQUILIBRIUM) {
        if (extra) judge_motion(&p, extra->motion);
        else REQUIRE(!p.definite);
    }
    if (status != SIGNORINI_STATUS_SOLVED) return 0;
    const double tolerance = tolerance_of(settings);
    judge_solution(&p, tolerance, d, F, state, report);
    if (extra && extra->second_d && extra->second_F && report &&
        report->struct_size == sizeof *report && report->second)
        judge_solution(&p, tolerance, extra->second_d, extra->second_F, extra->second_state, NULL);

    as_input(d);
    as_input(F);
    as_input(state);
    if (report) as_input(report);
    if (extra) {
        as_input(extra->motion);
        as_input(extra->second_d);
        as_input(extra->second_F);
        as_input(extra->second_state);
        as_input(extra->radius_d);
        as_input(extra->radius_F);
        as_input(extra->escape);
    }
    double *force = outputs(p.n), *radius_d = outputs(p.n), *radius_F = outputs(p.n);
    signorini_report *measured = a_report();
    arm();
    const int32_t certified = certify_condensed(p.dim, p.pairs, p.K, p.ld, p.f, p.gap, p.law,
                                                p.friction, p.slip0, 0.1, d, force, NULL, measured);
    check_arrays(certified);
    check_status(certified, 14);
    /* A model refuses a matrix that is not positive semi-definite, which signorini_solve does not find. */
    if (certified == -3) return 0;
    REQUIRE(certified == 0 || certified == SIGNORINI_STATUS_NOT_A_SOLUTION);
    if (sane()) judge_law(&p, force, NULL);
    arm();
    const int32_t proved = prove_condensed(p.dim, p.pairs, p.K, p.ld, p.f, p.gap, p.law, p.friction,
                                           p.slip0, d, state, force, radius_d, radius_F);
    check_arrays(proved);
    check_status(proved, 14);
    for (int64_t i = 0; i < p.n; i++) {
        REQUIRE(proved == 0 ? radius_d[i] >= 0 && radius_F[i] >= 0 : radius_d[i] == -1);
        REQUIRE(isfinite(radius_d[i]) && isfinite(radius_F[i]));
    }
    return 0;
}
