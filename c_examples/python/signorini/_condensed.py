"""Condensed problems: solve, certify, prove, write."""

from ._arrays import at, components, dimension, pairs_of, per_pair, reals, stiffness
from ._call import Call
from ._law import Friction
from ._library import check, library
from ._model import Case, Model
from ._results import Output
from ._text import path_bytes, remark_bytes


class _Data:
    """Data of a condensed problem in the library's layout."""

    def __init__(self, K, f, gap, friction, slip0, dim):
        K, f = stiffness("K", K), reals("f", f)
        self.dim = dim = dimension(dim, f.shape, len(K), gap)
        self.pairs = pairs = pairs_of("K", K, dim)
        self.K = K
        self.case = Case(
            components("f", f, pairs, dim), None, per_pair("gap", gap, pairs, dim), friction.law,
            friction.numbers(pairs, dim),
            components("slip0", slip0, pairs, dim, tangential=True, scalar=True, optional=True),
        )

    def arguments(self):
        """dim, pairs, K, ldk, f, gap, law, friction, slip0 of the C calls."""
        f, _, *others = self.case.arguments()
        return [self.dim, self.pairs, at(self.K), max(1, len(self.K)), f, *others]

    def model(self):
        """A model of the matrix."""
        return Model.condensed(self.K, dim=self.dim)


def solve(K, f, gap, mu=None, *, g=None, law=None, friction=None, slip0=None, dim=None,
          start=None, **settings):
    """Solves a condensed contact problem. Returns a Result.

    K: stiffness, (N, N), symmetric, positive semi-definite; force / length.  f: loads, N; force.
    gap: initial gaps, P; length; infinite: no obstacle.
    mu: friction coefficients, P (Coulomb).  g: friction thresholds, P; force (Tresca).  Neither: no
    friction; both: ValueError.
    law, friction: another law, a member of Law or its name in lower case, and its three numbers for
    each pair, (P, 3), or (3,) for all: "cohesive", (mu, b, a); in 3D "orthotropic" and
    "orthotropic_collinear", (mu1, mu2, angle). "by_pair": a law for each pair, (P, 4), the Law of
    the pair, its numbers, and zeros. "tied", without friction: d is the gap and slip0, whatever F.
    slip0: reference slip, the tangential displacement at which a sticking pair stays, P (D - 1);
    length; None: zero. The last converged d[:, 1:] gives the incremental law.
    dim: D; None: 3 if f has the shape (P, 3), else 2.  start: d to start from, N, or None.
    """
    data = _Data(K, f, gap, Friction(mu, g, law, friction), slip0, dim)
    functions = library()
    call = Call(functions, settings, start is not None)
    start = components("start", start, data.pairs, data.dim, optional=True)
    output = Output(1, data.pairs, data.dim, start)
    status, message = check(functions, *call.run(
        functions.solve, *data.arguments(), call.at(), *output.solution(), *output.more()
    ))
    return output.result(0, status, message, lambda d: data.model().certify_case(
        data.case, d, call.settings.tolerance))


def certify(K, f, gap, mu=None, *, d, g=None, law=None, friction=None, slip0=None, dim=None,
            tolerance=1e-10):
    """Measures displacements d of any origin, N, on the data of solve. Returns a Result.

    Its status is SOLVED if report.eta <= tolerance, NOT_A_SOLUTION if not; F are the forces that
    obey the law nearest to K d - f.
    """
    data = _Data(K, f, gap, Friction(mu, g, law, friction), slip0, dim)
    d = components("d", d, data.pairs, data.dim)
    return data.model().certify_case(data.case, d, tolerance)


def prove(K, f, gap, mu=None, *, d, state=None, g=None, law=None, friction=None, slip0=None,
          dim=None):
    """Proves that a solution exists next to displacements d of any origin, N, on the data of solve.

    state: its states, P; None: those of d.  Returns an Enclosure, or None: not proved, which does
    not say that there is none.
    """
    data = _Data(K, f, gap, Friction(mu, g, law, friction), slip0, dim)
    return data.model().prove_case(data.case, components("d", d, data.pairs, data.dim), state)


def write(path, K, f, gap, mu=None, *, g=None, law=None, friction=None, slip0=None, dim=None,
          remark=None):
    """Writes the problem of solve to a file, which read gives back with the same bits.

    path: the file, replaced if it exists.  remark: one line for who reads the file, or None.
    """
    data = _Data(K, f, gap, Friction(mu, g, law, friction), slip0, dim)
    functions = library()
    check(functions, functions.problem_write(path_bytes(path), *data.arguments(),
                                             remark_bytes(remark)))
