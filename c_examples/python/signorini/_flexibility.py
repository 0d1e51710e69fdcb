"""Problems in flexibility form: d = W F + q."""

from ._arrays import components, dimension, pairs_of, reals
from ._model import Model, flexibility


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
    W, q = flexibility(W, triangle), reals("q", q)
    dim = dimension(dim, q.shape, len(W), gap)
    q = components("q", q, pairs_of("W", W, dim), dim).ravel()  # (1, D) would be a case of one pair, not its q
    return Model.flexibility(W, dim=dim).solve(q, gap, mu, g=g, law=law, friction=friction, slip0=slip0,
                                               start=start, **settings)
