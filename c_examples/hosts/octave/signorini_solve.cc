// The library as a function of GNU Octave. octave.sh builds it.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octave/oct.h>

#include "signorini.h"

DEFUN_DLD(signorini_solve, arguments, ,
          "[d, F, state, eta] = signorini_solve (K, f, gap, mu, dim = 2, slip = zeros)\n\
\n\
Solves a condensed contact problem with Coulomb friction (signorini.h).\n\
\n\
K: N x N, N = dim * P; f: N; gap, mu: P, or one number for all; slip: (dim - 1) * P.\n\
d, F: dim x P, a column (n, t) or (n, t1, t2) for each pair; d(1,:) > 0 moves towards the\n\
obstacle, F(1,:) < 0 presses.  state: 1 x P; 0 open, 1 slides, 2 sticks.  eta: the\n\
residual.  What is not solved is an error.")
{
    const int count = arguments.length();
    if (count < 4 || count > 6)
        print_usage();
    const Matrix K = arguments(0).xmatrix_value("signorini_solve: K is not a real matrix");
    const NDArray f = arguments(1).xarray_value("signorini_solve: f is not a real array");
    NDArray gap = arguments(2).xarray_value("signorini_solve: gap is not a real array");
    NDArray mu = arguments(3).xarray_value("signorini_solve: mu is not a real array");
    const int dim = count > 4 ? arguments(4).xint_value("signorini_solve: dim is not a number") : 2;
    NDArray slip;
    if (count > 5)
        slip = arguments(5).xarray_value("signorini_solve: slip is not a real array");

    const octave_idx_type size = K.rows();
    if (K.columns() != size || (dim != 2 && dim != 3) || size % dim != 0)
        error("signorini_solve: K must be square, with dim rows for each pair, dim 2 or 3");
    const octave_idx_type pairs = size / dim;
    if (gap.numel() == 1)
        gap = NDArray(dim_vector(pairs, 1), gap(0));
    if (mu.numel() == 1)
        mu = NDArray(dim_vector(pairs, 1), mu(0));
    if (f.numel() != size || gap.numel() != pairs || mu.numel() != pairs ||
        (slip.numel() != 0 && slip.numel() != size - pairs))
        error("signorini_solve: f has N entries, gap and mu P, slip (dim - 1) * P");

    Matrix d(dim, pairs, 0.0), F(dim, pairs, 0.0);
    std::vector<int32_t> states(pairs);
    signorini_report report;
    report.struct_size = sizeof report;
    const int32_t status = ::signorini_solve(
        dim, pairs, K.data(), size > 0 ? size : 1, f.data(), gap.data(), mu.data(),
        slip.numel() != 0 ? slip.data() : nullptr, nullptr, d.fortran_vec(), F.fortran_vec(),
        states.data(), &report);
    if (status != SIGNORINI_SOLVED)
        error("signorini_solve: %s", signorini_last_error());
    NDArray state(dim_vector(1, pairs));
    std::copy(states.begin(), states.end(), state.fortran_vec());
    return ovl(d, F, state, report.eta);
}
