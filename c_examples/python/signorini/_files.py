"""Problem files."""

import ctypes
from collections import namedtuple

import numpy as np

from ._arrays import copied
from ._condensed import solve
from ._constants import Law, Problem
from ._lcp import lcp_lemke, lcp_solve
from ._library import check, library
from ._structures import ProblemData, address, sized
from ._text import path_bytes


class ContactProblem(namedtuple("ContactProblem", "K f gap mu g slip0 dim remark law friction")):
    """A contact problem of a file: the arguments of solve, and the remark of who wrote it.

    f: (P, D).  slip0: (P, D - 1).  mu and g: P, or None, as the law of friction is.  law and
    friction: a Law and (P, 3) or (P, 4) of a law with several numbers, Law.TIED and None, or None.
    """

    __slots__ = ()

    def solve(self, **settings):
        """Solves it. Returns a Result."""
        return solve(self.K, self.f, self.gap, self.mu, g=self.g, law=self.law,
                     friction=self.friction, slip0=self.slip0, dim=self.dim, **settings)


class LcpProblem(namedtuple("LcpProblem", "M q cover remark")):
    """An LCP of a file: the arguments of lcp_solve, or of lcp_lemke if cover is not None."""

    __slots__ = ()

    def solve(self, **settings):
        """Solves it. Returns an LcpResult."""
        if self.cover is None:
            return lcp_solve(self.M, self.q, **settings)
        return lcp_lemke(self.M, self.q, self.cover, **settings)


def read(path):
    """Reads a problem file. Returns a ContactProblem or an LcpProblem."""
    functions, handle = library(), address()
    check(functions, functions.problem_read(path_bytes(path), ctypes.byref(handle)))
    try:
        return _taken(functions, handle)
    finally:
        functions.problem_free(handle)


def _taken(functions, handle):
    problem = sized(ProblemData)
    check(functions, functions.problem_view(handle, ctypes.byref(problem)))
    dim, pairs, size = problem.dim, problem.pairs, problem.size

    def array(name, *shape):
        found = copied(getattr(problem, name), shape)
        return np.zeros(shape) if found is None and not np.prod(shape) else found

    matrix, remark = array("matrix", size, size).T, problem.remark.decode()
    if problem.kind == Problem.LCP:
        return LcpProblem(matrix, array("rhs", size), array("cover", size), remark)
    law = Law(problem.law)
    several = law.numbers > 1
    numbers = array("friction", pairs, law.numbers) if several else array("friction", pairs)
    return ContactProblem(
        matrix, array("rhs", pairs, dim), array("gap", pairs),
        numbers if law == Law.COULOMB else None, numbers if law == Law.TRESCA else None,
        array("slip0", pairs, dim - 1), dim, remark,
        law if several or law == Law.TIED else None, numbers if several else None,
    )
