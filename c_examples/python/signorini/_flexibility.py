"""Problems in flexibility form: d = W F + q."""

import ctypes

import numpy as np

from ._arrays import at, components, dimension, pairs_of, per_pair, reals, stiffness
from ._call import Call
from ._law import Friction
from ._library import check, library
from ._results import Output
from ._sparse import Matrix, is_sparse


def solve_flexibility(W, q, gap=0.0, mu=None, *, g=None, law=None, friction=None, slip0=None,
                      dim=None, triangle="full", start=None, **settings):
    """Solves a contact problem in flexibility form, d = W F + q. Returns a Result.

    W: flexibility, (N, N), symmetric, positive semi-definite, singular allowed; length / force. An
    array, a scipy.sparse matrix, or a tuple (data, indices, indptr) by columns, rows ascending. Pairs
    that no entry of a sparse one ties to each other are solved by themselves.  triangle: which
    entries a sparse W holds, "full", "lower" or "upper".
    q: free displacements, those without contact forces, N; length.  start: F to start from, N, or
    None.  All else: as in solve.
    Codes that write u = W r + q with u_N >= 0 and r_N >= 0 hand over -q; then u = -d and r = -F.
    Where W is singular forces need not be unique. With Status.NO_EQUILIBRIUM motion holds pressing
    forces that move nothing: they prove that the gaps contradict each other.
    """
    sparse = Matrix(W, triangle, name="W") if is_sparse(W) else None
    W = stiffness("W", W) if sparse is None else sparse
    q = reals("q", q)
    dim = dimension(dim, q.shape, len(W), gap)
    pairs = pairs_of("W", W, dim)
    chosen = Friction(mu, g, law, friction)
    q, gap = components("q", q, pairs, dim), per_pair("gap", gap, pairs, dim)
    numbers = chosen.numbers(pairs, dim)
    slip0 = components("slip0", slip0, pairs, dim, tangential=True, scalar=True, optional=True)
    functions = library()
    call = Call(functions, settings, start is not None)
    output = Output(1, pairs, dim)
    if start is not None:
        output.F[0] = np.asarray(components("start", start, pairs, dim)).reshape(pairs, dim)
    if sparse is None:
        function, matrix = functions.flexibility_solve, (at(W), max(1, len(W)))
    else:
        function, matrix = functions.flexibility_solve_sparse, (ctypes.byref(sparse.structure),)
    status, message = check(functions, *call.run(
        function, dim, pairs, *matrix, at(q), at(gap), chosen.law, at(numbers), at(slip0),
        call.at(), *output.solution(), *output.more()
    ))
    # No second solution is looked for: there is none to measure.
    return output.result(0, status, message, None)
