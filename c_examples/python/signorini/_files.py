"""Problem files."""

import ctypes
from collections import namedtuple

import numpy as np

from ._condensed import solve
from ._constants import Law, Problem
from ._law import TRIPLES
from ._lcp import lcp_lemke, lcp_solve
from ._library import check, library
from ._structures import address
from ._text import path_bytes


class ContactProblem(namedtuple("ContactProblem", "K f gap mu g slip0 dim remark law friction")):
    """A contact problem of a file: the arguments of solve, and the remark of who wrote it.

    f: (P, D).  slip0: (P, D - 1).  mu and g: P, or None, as the law of friction is.  law and
    friction: a Law and (P, 3) of a law with three numbers, or None.
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


def _taken(functions, problem):
    dim, pairs = functions.problem_dim(problem), functions.problem_pairs(problem)
    size = functions.problem_size(problem)

    def array(name, *shape):
        pointer = getattr(functions, "problem_" + name)(problem)
        if not pointer:
            return None if np.prod(shape) else np.zeros(shape)
        return np.ctypeslib.as_array(pointer, shape).copy()

    matrix, remark = array("matrix", size, size).T, functions.problem_remark(problem).decode()
    if functions.problem_kind(problem) == Problem.LCP:
        return LcpProblem(matrix, array("rhs", size), array("cover", size), remark)
    law = Law(functions.problem_law(problem))
    numbers = array("friction", pairs, 3) if law in TRIPLES else array("friction", pairs)
    return ContactProblem(
        matrix, array("rhs", pairs, dim), array("gap", pairs),
        numbers if law == Law.COULOMB else None, numbers if law == Law.TRESCA else None,
        array("slip0", pairs, dim - 1), dim, remark,
        law if law in TRIPLES else None, numbers if law in TRIPLES else None,
    )
