"""Linear complementarity problems (LCP)."""

import ctypes

import numpy as np

from ._arrays import at, fit, square
from ._call import Call
from ._constants import Method, Status
from ._library import check, library
from ._results import LcpResult
from ._structures import Report, sized
from ._text import path_bytes, remark_bytes


def lcp_solve(M, q, **settings):
    """Solves the LCP w = q + M z, w >= 0, z >= 0, w . z = 0. Returns an LcpResult.

    M: (n, n).  q: n.  method is "auto", "block_pivoting" or "lemke".
    """
    M, q, _ = _data(M, q)
    return _solve(M, q, None, settings)


def lcp_lemke(M, q, cover=None, **settings):
    """Solves the same by Lemke's method. cover: covering vector, n positive numbers; None: ones."""
    M, q, cover = _data(M, q, cover)
    return _solve(M, q, cover, {**settings, "method": Method.LEMKE})


def write_lcp(path, M, q, cover=None, *, remark=None):
    """Writes an LCP to a file, as write does."""
    M, q, cover = _data(M, q, cover)
    functions = library()
    check(functions, functions.lcp_write(path_bytes(path), len(M), at(M), max(1, len(M)), at(q),
                                         at(cover), remark_bytes(remark)))


def _data(M, q, cover=None):
    M = square("M", M)
    shape = (len(M),)
    asked = f"one number for each row of M, shape {shape}"
    cover = fit("cover", cover, [shape], asked, optional=True)
    return M, fit("q", q, [shape], asked), cover


def _solve(M, q, cover, settings):
    functions = library()
    call, size = Call(functions, settings), len(M)
    w, z, y, report = np.zeros(size), np.zeros(size), np.zeros(size), sized(Report)
    status, message = check(functions, *call.run(
        functions.lcp_solve, size, at(M), max(1, size), at(q), at(cover), call.at(), at(w), at(z),
        at(y), ctypes.byref(report),
    ))
    proof = y if status == Status.NO_EQUILIBRIUM else None
    return LcpResult(w, z, status, message, report.plain(), proof)
