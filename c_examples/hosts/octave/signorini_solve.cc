// The library as a function of GNU Octave. octave.sh builds it.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octave/oct.h>

#include "signorini.h"

static void check_count(const char *name, const NDArray &array, octave_idx_type asked,
                        const char *what)
{
    if (array.numel() != asked)
        error("signorini_solve: %s has %ld entries: give %ld, %s", name,
              static_cast<long>(array.numel()), static_cast<long>(asked), what);
}

DEFUN_DLD(signorini_solve, arguments, ,
          "[d, F, state, eta] = signorini_solve (K, f, gap, mu, dim = 2, slip0 = zeros)\n\
\n\
Solves a condensed contact problem with Coulomb friction (signorini.h).\n\
\n\
K: N x N, N = dim * P; f: N; gap, mu: P, or one number for all; slip0 (reference slip):\n\
(dim - 1) * P.\n\
d, F: dim x P, a column (n, t) or (n, t1, t2) for each pair; d(1,:) > 0 moves towards the\n\
obstacle, F(1,:) < 0 presses.  state: 1 x P; 0 open, 1 slips, 2 sticks.  eta: the\n\
residual.  What is not solved is an error.")
{
    const int count = arguments.length();
    if (count < 4 || count > 6)
        print_usage();
    const char *const names[] = {"K", "f", "gap", "mu", "dim", "slip0"};
    for (int k = 0; k < count; k++)
        if (arguments(k).iscomplex())
            error("signorini_solve: %s is complex: give real numbers", names[k]);
    const Matrix K = arguments(0).xmatrix_value("signorini_solve: K is not a real matrix");
    const NDArray f = arguments(1).xarray_value("signorini_solve: f is not a real array");
    NDArray gap = arguments(2).xarray_value("signorini_solve: gap is not a real array");
    NDArray mu = arguments(3).xarray_value("signorini_solve: mu is not a real array");
    const int dim = count > 4 ? arguments(4).xint_value("signorini_solve: dim is not a number") : 2;
    NDArray slip0;
    if (count > 5)
        slip0 = arguments(5).xarray_value("signorini_solve: slip0 is not a real array");

    const octave_idx_type size = K.rows();
    if (K.columns() != size || (dim != 2 && dim != 3) || size % dim != 0)
        error("signorini_solve: K must be square, with dim rows for each pair, dim 2 or 3");
    const octave_idx_type pairs = size / dim;
    if (gap.numel() == 1)
        gap = NDArray(dim_vector(pairs, 1), gap(0));
    if (mu.numel() == 1)
        mu = NDArray(dim_vector(pairs, 1), mu(0));
    check_count("f", f, size, "dim for each pair");
    check_count("gap", gap, pairs, "one for each pair, or one for all");
    check_count("mu", mu, pairs, "one for each pair, or one for all");
    if (slip0.numel() != 0)
        check_count("slip0", slip0, size - pairs, "dim - 1 for each pair");

    Matrix d(dim, pairs, 0.0), F(dim, pairs, 0.0);
    std::vector<int32_t> states(pairs);
    signorini_report report;
    signorini_report_default(&report, sizeof report);
    const int32_t status = ::signorini_solve(
        dim, pairs, K.data(), size > 0 ? size : 1, f.data(), gap.data(), SIGNORINI_LAW_COULOMB,
        mu.data(), slip0.numel() != 0 ? slip0.data() : nullptr, nullptr, d.fortran_vec(),
        F.fortran_vec(), states.data(), &report, nullptr);
    if (status != SIGNORINI_STATUS_SOLVED)
        error("signorini_solve: %s", signorini_last_error());
    NDArray state(dim_vector(1, pairs));
    std::copy(states.begin(), states.end(), state.fortran_vec());
    return ovl(d, F, state, report.eta);
}
