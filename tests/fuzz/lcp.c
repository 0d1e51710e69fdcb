/* signorini_lcp_solve, with some of the inputs by Lemke's method. */

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    const int64_t n = between(0, 8), ld = (n > 1 ? n : 1) + (rarely(4) ? 3 : 0);
    int definite;
    const double *M = matrix(n, ld, &definite), *q = numbers(n);
    const signorini_settings *settings = a_settings();
    const double *cover = rarely(4) ? numbers(n) : NULL;
    double *w = outputs(n), *z = outputs(n), *y = or_null(outputs(n), 8);
    signorini_report *report = or_null(a_report(), 8);
    const int64_t given = size_or_wrong(n), leading = size_or_wrong(ld);
    const int by_lemke = rarely(2);
    arm();
    const int32_t status =
        by_lemke ? lemke(given, M, leading, q, cover, settings, w, z, y, report)
                 : signorini_lcp_solve(given, M, leading, q, cover, settings, w, z, y, report);
    check_arrays(status);
    check_status(status, 10);
    if (status < 0 || status == SIGNORINI_STATUS_MEMORY_LIMIT || given != n || leading != ld) return 0;
    if (status == SIGNORINI_STATUS_SOLVED)
        judge_lcp(n, M, ld, q, tolerance_of(settings), w, z);
    if (status == SIGNORINI_STATUS_NO_EQUILIBRIUM) {
        REQUIRE(!definite);
        if (y) judge_ray(n, M, ld, q, y);
    } else {
        for (int64_t i = 0; y && i < n; i++) REQUIRE(y[i] == 0);
    }
    return 0;
}
