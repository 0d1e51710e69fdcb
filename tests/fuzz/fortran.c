/* SGSOLV and SGLCPS, of both widths of integers. */

#include "fortran.h"

static void contact(void)
{
    problem p = a_problem();
    /* Fortran has no NULL: zeros. */
    if (!p.slip0) p.slip0 = input((size_t)(p.n - p.pairs), sizeof *p.slip0);
    const double wanted = rarely(4) ? 1e-8 : 0, tolerance = wanted == 0 ? 1e-10 : wanted;
    const integer *ndim = number_of(sane() || !rarely(16) ? p.dim : between(4, 6) % 5);
    const integer *npair = number_of(size_or_wrong(p.pairs)), *ldk = number_of(size_or_wrong(p.ld));
    const integer *law = number_of(p.law), *method = number_of(!rarely(4) ? 0 : between(0, sane() ? 6 : 9));
    const integer *maxit = number_of(sane() || !rarely(8) ? 200 : between(-3, 3));
    const double *tol = real_of(sane() || !rarely(8) ? wanted : number());
    double *d = output((size_t)p.n, sizeof *d), *r = output((size_t)p.n, sizeof *r);
    double *eta = outputs(1);
    integer *state = integers(p.pairs), *iter = integers(1), info = 77;
    const int right = *ndim == p.dim && *npair == p.pairs && *ldk == p.ld && *tol == wanted;
    arm();
    ENTRY(sgsolv)(ndim, npair, p.K, ldk, p.f, p.gap, law, p.friction, p.slip0, method, tol, maxit, d,
                  r, state, eta, iter, &info);
    check_arrays((int32_t)info);
    check_sentence(info);
    if (p.definite && sane() && *method == 0) REQUIRE(info >= 0);
    if (info != 0 || !right) return;
    judge_solution(&p, tolerance, d, r, narrow(state, p.pairs), NULL);
    REQUIRE(*eta >= 0 && *eta <= tolerance);
}

static void complementarity(void)
{
    const int64_t n = between(0, 8), ld = n > 1 ? n : 1;
    int definite;
    double *m = matrix(n, ld, &definite);
    const double *q = numbers(n);
    const integer *size = number_of(size_or_wrong(n)), *ldm = number_of(size_or_wrong(ld));
    const integer *method = number_of(rarely(2) ? 0 : between(0, 9)), *maxit = number_of(200);
    const double *tol = real_of(0);
    double *w = output((size_t)n, sizeof *w), *z = output((size_t)n, sizeof *z), *eta = outputs(1);
    integer *iter = integers(1), info = 77;
    arm();
    ENTRY(sglcps)(size, m, ldm, q, method, tol, maxit, w, z, eta, iter, &info);
    check_arrays((int32_t)info);
    check_sentence(info);
    if (info == 0 && *size == n && *ldm == ld) judge_lcp(n, m, ld, q, 1e-10, w, z);
    if (info == SIGNORINI_STATUS_NO_EQUILIBRIUM) REQUIRE(!definite);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    if (rarely(4)) complementarity();
    else contact();
    return 0;
}
