/* signorini_flexibility_solve. */

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    problem p = a_problem();
    const signorini_settings *settings = a_settings();
    const int64_t pairs = size_or_wrong(p.pairs), ld = size_or_wrong(p.ld);
    double *d = outputs(p.n), *F = outputs(p.n), *gap = or_null(p.gap, 4);
    int32_t *state = or_null(states(p.pairs), 8);
    signorini_report *report = or_null(a_report(), 8);
    const signorini_extra *extra = an_extra(p.n, p.pairs, 1);
    arm();
    const int32_t status =
        signorini_flexibility_solve(p.dim, pairs, p.K, ld, p.f, gap, p.law, p.friction, p.slip0,
                                    settings, d, F, state, report, extra);
    check_arrays(status);
    check_status(status, 15);
    if (status < 0 || pairs != p.pairs || ld != p.ld) return 0;
    p.gap = gap;
    if (status == SIGNORINI_STATUS_SOLVED)
        judge_flexibility(&p, tolerance_of(settings), d, F, state);
    return 0;
}
