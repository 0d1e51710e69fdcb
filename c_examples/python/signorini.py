"""Unilateral contact with Coulomb friction on numpy arrays: the library signorini by ctypes.

    import signorini
    result = signorini.solve(K, f, gap=0.0, mu=0.3)
    print(result.status, result.message, result.report.eta)
    print(result.d[:, 0], result.F[:, 0], result.state)

For P pairs in dimension D (2 or 3), N = D * P, ordered pair by pair (n, t) or (n, t1, t2):

    K d = f + F                                     equilibrium
    d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0     unilateral contact
    |F_t| <= mu |F_n|                               Coulomb friction: d_t = slip inside the cone,
                                                    d_t - slip = -lambda F_t, lambda >= 0, on it

Signs: n is the outward normal of the body; d_n > 0 moves towards the obstacle, F_n < 0 presses, F
is the force on the body. f and F are nodal forces. Units are yours, also those of the results. gap,
mu, g and slip may be one number for all pairs. Vectors of N entries may have the shape (P, D).
signorini.h is the reference; it also says what each field of a report is.

Settings are keywords of everything that solves: method ("auto", "sor_nested", "sor_diagonal",
"lemke", "pivot", "newton"), tolerance, omega, damping, max_iterations, time_limit, search ("off",
"others", "return_second"), and progress, a function of a Progress; it cancels the call by a true
result, or by an exception (such as that of Ctrl-C), which goes on after the call. It must not call
this module. Without one, Ctrl-C waits for the end of the call.

The shared library is the one that load() names, or the environment variable SIGNORINI_LIBRARY, or
that of ../../target/release, or that of the system. Needs numpy. Threads may share everything here.
"""

import ctypes
import os
import signal
import sys
import threading
import weakref
from collections import namedtuple
from types import SimpleNamespace

import numpy as np

ABI_VERSION = 1  # of the signorini.h that this module is written for
SOLVED, ITERATION_LIMIT, TIME_LIMIT, CANCELLED, NO_EQUILIBRIUM, STALLED, NOT_A_SOLUTION = range(7)
OPEN, SLIP, STICK = range(3)
METHODS = ("auto", "sor_nested", "sor_diagonal", "lemke", "pivot", "newton")
SEARCHES = ("off", "others", "return_second")
UNIQUENESS = ("not_known", "unique", "several")
FALLBACKS = ("none", "cycle", "singular", "unstable", "inaccurate")
TRIANGLES = ("lower", "upper", "full")

i32, i64, real, address = ctypes.c_int32, ctypes.c_int64, ctypes.c_double, ctypes.c_void_p


class SignoriniError(RuntimeError):
    """A wrong argument, an internal error, or a library that cannot be used.

    status: what the call returned (negative); None if the library cannot be used.
    """

    def __init__(self, message, status=None):
        super().__init__(message)
        self.status = status


Progress = namedtuple("Progress", "iterations eta elapsed")
Result = namedtuple("Result", "d F state report status message")
Result.__doc__ = """What a call has found.

d: relative displacements, (P, D).  F: contact forces, (P, D).  state: OPEN, SLIP or STICK, (P,).
report: the fields of signorini_report, methods and the like by their names.
status: SOLVED, or what the results are instead.  message: the same in words.
"""
LcpResult = namedtuple("LcpResult", "w z report status message")


# ---- the structures of signorini.h ----


class _Told(ctypes.Structure):
    _fields_ = [("iterations", i64), ("eta", real), ("elapsed", real)]


_Callback = ctypes.CFUNCTYPE(i32, address, ctypes.POINTER(_Told))


class _Settings(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32), ("method", i32), ("tolerance", real), ("omega", real),
        ("damping", real), ("max_iterations", i64), ("time_limit", real), ("warm_start", i32),
        ("search", i32), ("progress", _Callback), ("user", address),
    ]


class _Report(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32), ("status", i32), ("method", i32), ("uniqueness", i32),
        ("iterations", i64), ("outer_iterations", i64), ("refactorisations", i64), ("eta", real),
        ("rounding", real), ("penetration", real), ("tension", real), ("cone_excess", real),
        ("equilibrium", real), ("omega", real), ("damping", real), ("open", i64), ("slip", i64),
        ("stick", i64), ("factorisations", i64), ("first_method", i32), ("fallback", i32),
        ("orientation", i32), ("reserved", i32),
    ]

    def plain(self):
        names = [name for name, _ in self._fields_ if name not in ("struct_size", "reserved")]
        values = {name: getattr(self, name) for name in names}
        for name, words in (("method", METHODS), ("first_method", METHODS),
                            ("uniqueness", UNIQUENESS), ("fallback", FALLBACKS)):
            if 0 <= values[name] < len(words):
                values[name] = words[values[name]]
        return SimpleNamespace(**values)


class _Sparse(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32), ("index_bytes", i32), ("base", i32), ("triangle", i32),
        ("size", i64), ("entries", i64), ("starts", address), ("rows", address),
        ("values", address),
    ]


class _Pairs(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32), ("dim", i32), ("pairs", i64), ("slaves", address),
        ("master_starts", address), ("masters", address), ("weights", address),
        ("normals", address), ("tangents", address),
    ]


# ---- the library ----

_FLAT = [i32, i64, address, i64, *[address] * 9]  # signorini_solve and signorini_tresca
_SIGNATURES = {
    "version": (ctypes.c_char_p, []),
    "status_string": (ctypes.c_char_p, [i32]),
    "last_error": (ctypes.c_char_p, []),
    "settings_default": (i32, [address, ctypes.c_uint32]),
    "solve": (i32, _FLAT),
    "tresca": (i32, _FLAT),
    "certify": (i32, [i32, i64, address, i64, *[address] * 4, real, *[address] * 4]),
    "lcp_solve": (i32, [i64, address, i64, *[address] * 5]),
    "model_new_condensed": (i32, [i32, i64, address, i64, address]),
    "model_new_two_body": (i32, [i32, i64, address, i64, address, i64, address]),
    "model_new_sparse": (i32, [address, i64, address, address, address]),
    "model_free": (None, [address]),
    "model_host_size": (i64, [address]),
    "model_stiffness": (i32, [address, address]),
    "model_solve": (i32, [address, i64, *[address] * 11]),
    "model_recover": (i32, [address] * 5),
    "model_nodal_forces": (i32, [address] * 3),
}
_loaded = None


def load(path=None):
    """Loads the library, from path if it is given, and has this module use it from now on."""
    global _loaded
    _loaded = _open(path)
    return _loaded.version().decode()


def _open(path):
    end = {"darwin": ".dylib", "win32": ".dll"}.get(sys.platform, ".so")
    name = ("" if sys.platform == "win32" else "lib") + "signorini" + end
    here = os.path.dirname(os.path.abspath(__file__))
    built = os.path.join(here, os.pardir, os.pardir, "target", "release", name)
    named = path or os.environ.get("SIGNORINI_LIBRARY")
    if named:
        places = [os.path.abspath(named)]
    else:
        places = ([built] if os.path.exists(built) else []) + [name, name + ".0.1"]
    reasons = []
    for place in places:
        try:
            library = ctypes.CDLL(place)
        except OSError as error:
            reasons.append(str(error))
            continue
        _bind(library, place)
        return SimpleNamespace(
            **{name: getattr(library, "signorini_" + name) for name in _SIGNATURES}
        )
    raise SignoriniError(
        "the library signorini cannot be loaded (" + "; ".join(reasons) + "): build it by "
        "cargo build --release, or set SIGNORINI_LIBRARY to its path"
    )


def _bind(library, place):
    # Before all else: of another interface nothing else may be called.
    if not hasattr(library, "signorini_abi_version"):
        raise SignoriniError(f"{place} is not the library signorini")
    library.signorini_abi_version.restype = i32
    found = library.signorini_abi_version()
    if found != ABI_VERSION:
        raise SignoriniError(
            f"{place} has the binary interface {found}, but this module is written for "
            f"{ABI_VERSION}: use the signorini.py that belongs to the library"
        )
    for name, (result, arguments) in _SIGNATURES.items():
        function = getattr(library, "signorini_" + name, None)
        if function is None:
            raise SignoriniError(f"{place} has no signorini_{name}: it is older than this module")
        function.restype, function.argtypes = result, arguments


def _library():
    if _loaded is None:
        load()
    return _loaded


# ---- arrays ----


def _reals(name, values, shape=None, order="C", fill=False):
    """64-bit numbers of a shape; None for None. With fill, fewer numbers are repeated."""
    if values is None:
        return None
    array = np.asarray(values)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} holds {array.dtype}, not real numbers")
    if shape is not None and array.shape != shape:
        if array.size == np.prod(shape, dtype=int) and array.ndim > 0:
            array = array.reshape(shape)
        elif fill and array.shape in ((), *(shape[i:] for i in range(1, len(shape)))):
            array = np.broadcast_to(array, shape)
        else:
            raise ValueError(f"{name} has the shape {array.shape}, not {shape}")
    return np.require(array, np.float64, [order, "ALIGNED"])


def _indices(name, values, shape, kinds=(np.int64,)):
    if values is None:
        return None
    array = np.asarray(values)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} holds {array.dtype}, not integers")
    if shape is not None:
        if array.size != np.prod(shape, dtype=int):
            raise ValueError(f"{name} has the shape {array.shape}, not {shape}")
        array = array.reshape(shape)
    kind = array.dtype if array.dtype in kinds else kinds[0]
    return np.require(array, kind, ["C", "ALIGNED"])


def _square(name, values):
    array = _reals(name, values, order="F")
    if array.ndim != 2 or array.shape[0] != array.shape[1]:
        raise ValueError(f"{name} has the shape {array.shape}, not that of a square matrix")
    return array


def _condensed(name, values, dim):
    array = _square(name, values)
    if dim not in (2, 3) or len(array) % dim:
        raise ValueError(f"{name} has {len(array)} rows, not {dim} for each pair (dim is {dim})")
    return array, len(array) // dim


def _at(array):
    return None if array is None else array.ctypes.data


# ---- settings, results ----


class _Call:
    """Settings of one call, with its progress function and what came of it."""

    def __init__(self, library, settings, start=None):
        self.library, self.error, self.pending, self.inside = library, None, None, False
        self.settings = _Settings()
        library.settings_default(ctypes.byref(self.settings), ctypes.sizeof(_Settings))
        self.progress = settings.pop("progress", None)
        known = ("method", "tolerance", "omega", "damping", "max_iterations", "time_limit",
                 "search")
        for name, value in settings.items():
            if name not in known:
                raise TypeError(f"{name} is not a setting; settings: {', '.join(known)}, progress")
            words = {"method": METHODS, "search": SEARCHES}.get(name, ())
            if isinstance(value, str):
                if value not in words:
                    raise ValueError(f"{name} is {value!r}, not one of {', '.join(words)}")
                value = words.index(value)
            setattr(self.settings, name, value)
        self.settings.warm_start = start is not None
        if self.progress is not None:
            self.settings.progress = _Callback(self._tell)

    def _tell(self, _, told):
        try:
            try:
                self.inside = True
                self._interrupt()
                told = told.contents
                cancel = self.progress(Progress(told.iterations, told.eta, told.elapsed))
            finally:
                self.inside = False
            return 1 if cancel else 0
        except BaseException as error:  # none may cross the library; run() raises it
            self.error = error
            return 1

    def _interrupt(self):
        if self.pending is not None:
            (handler, *rest), self.pending = self.pending, None
            handler(*rest)

    def run(self, function, *arguments):
        """Calls a function of the library; raises what its status or the progress function ask."""
        previous = signal.getsignal(signal.SIGINT) if self.progress is not None else None
        watch = callable(previous) and threading.current_thread() is threading.main_thread()
        if watch:
            # Python would raise KeyboardInterrupt at the door of _tell, where ctypes drops it.
            def handle(number, frame):
                self.pending = (previous, number, frame)
                if self.inside:
                    self._interrupt()

            signal.signal(signal.SIGINT, handle)
        try:
            status = function(*arguments)
        finally:
            if watch:
                signal.signal(signal.SIGINT, previous)
        message = self.library.last_error().decode()
        if self.error is not None:
            raise self.error
        self._interrupt()
        return status, message

    def at(self):
        return ctypes.byref(self.settings)


def _finish(library, status, message):
    if status < 0:
        raise SignoriniError(message, status)
    return message or library.status_string(status).decode()


def _report():
    return _Report(struct_size=ctypes.sizeof(_Report))


def _flat(function, K, f, gap, friction, slip, dim, start, settings):
    library = _library()
    K, pairs = _condensed("K", K, dim)
    call = _Call(library, settings, start)
    given = [K, _reals("f", f, (len(K),)), _reals("gap", gap, (pairs,), fill=True),
             _reals("mu" if function == "solve" else "g", friction, (pairs,), fill=True),
             _reals("slip", slip, (pairs, dim - 1), fill=True)]
    d = np.zeros((pairs, dim))
    if start is not None:
        d[:] = _reals("start", start, (pairs, dim))
    F, state, report = np.zeros((pairs, dim)), np.zeros(pairs, np.int32), _report()
    at = [_at(array) for array in given]
    status, message = call.run(
        getattr(library, function), dim, pairs, at[0], max(1, len(K)), *at[1:], call.at(),
        _at(d), _at(F), _at(state), ctypes.byref(report),
    )
    message = _finish(library, status, message)
    return Result(d, F, state, report.plain(), status, message)


# ---- calls ----


def solve(K, f, gap, mu, slip=None, *, dim=2, start=None, **settings):
    """Solves a condensed contact problem with Coulomb friction. Returns a Result.

    K: stiffness, (N, N), symmetric, positive semi-definite; force / length.  f: loads, N; force.
    gap: initial gaps, P; length.  mu: friction coefficients, P.
    slip: tangential displacement at which friction is at rest, (P, D - 1), None: zero; the last
    converged d[:, 1:] gives the incremental law.  start: d to start from, N, or None.
    """
    return _flat("solve", K, f, gap, mu, slip, dim, start, settings)


def tresca(K, f, gap, g, slip=None, *, dim=2, start=None, **settings):
    """Solves the problem with friction thresholds g, P, forces, in the place of mu |F_n|."""
    return _flat("tresca", K, f, gap, g, slip, dim, start, settings)


def certify(K, f, gap, mu, d, slip=None, *, dim=2, tolerance=1e-10):
    """Measures displacements d of any origin, N, on the data of solve. Returns a Result.

    Its status is SOLVED if report.eta <= tolerance, NOT_A_SOLUTION if not; F are the forces that
    obey the law nearest to K d - f.
    """
    library = _library()
    K, pairs = _condensed("K", K, dim)
    given = [K, _reals("f", f, (len(K),)), _reals("gap", gap, (pairs,), fill=True),
             _reals("mu", mu, (pairs,), fill=True),
             _reals("slip", slip, (pairs, dim - 1), fill=True)]
    d = _reals("d", d, (pairs, dim)).copy()
    F, state, report = np.zeros((pairs, dim)), np.zeros(pairs, np.int32), _report()
    at = [_at(array) for array in given]
    status = library.certify(dim, pairs, at[0], max(1, len(K)), *at[1:], tolerance, _at(d), _at(F),
                             _at(state), ctypes.byref(report))
    message = _finish(library, status, library.last_error().decode())
    return Result(d, F, state, report.plain(), status, message)


def lcp_solve(M, q, **settings):
    """Solves w = q + M z, w >= 0, z >= 0, w . z = 0. M: (n, n).  q: n. Returns an LcpResult.

    method is "auto", "pivot" or "lemke". With status NO_EQUILIBRIUM no solution exists, and z
    proves it: z >= 0, M' z <= 0, q . z < 0.
    """
    library = _library()
    M = _square("M", M)
    q = _reals("q", q, (len(M),))
    call = _Call(library, settings)
    w, z, report = np.zeros(len(M)), np.zeros(len(M)), _report()
    status, message = call.run(library.lcp_solve, len(M), _at(M), max(1, len(M)), _at(q), call.at(),
                               _at(w), _at(z), ctypes.byref(report))
    return LcpResult(w, z, report.plain(), status, _finish(library, status, message))


class Model:
    """A structure reduced to its contact pairs, for any number of load cases.

    Made by Model.condensed, Model.two_body or Model.sparse. dim, pairs: D and P.
    host_size: H, the entries of a load or displacement vector of the host.
    stiffness: K_rel, the stiffness in relative displacements, (N, N).
    """

    def __init__(self, make, dim, pairs, fixed, *arguments):
        self._library = _library()
        self.dim, self.pairs, self._fixed = dim, pairs, fixed
        handle = address()
        status = getattr(self._library, make)(*arguments, ctypes.byref(handle))
        _finish(self._library, status, self._library.last_error().decode())
        self._handle = handle.value
        weakref.finalize(self, self._library.model_free, handle.value)
        self.host_size = self._library.model_host_size(handle.value)

    @classmethod
    def condensed(cls, K, *, dim=2):
        """One body on an obstacle. K: condensed stiffness, (N, N). H = N."""
        K, pairs = _condensed("K", K, dim)
        return cls("model_new_condensed", dim, pairs, 0, dim, pairs, _at(K), max(1, len(K)))

    @classmethod
    def two_body(cls, K_A, K_B, *, dim=2):
        """Two bodies on matching contact nodes, each in its own outward frame; d = u_A + u_B.

        K_A, K_B: condensed stiffness, (N, N) each. Loads and displacements are [A; B], H = 2 N.
        """
        K_A, pairs = _condensed("K_A", K_A, dim)
        K_B, other = _condensed("K_B", K_B, dim)
        if pairs != other:
            raise ValueError(f"K_B has {len(K_B)} rows, and K_A {len(K_A)}")
        size = max(1, len(K_A))
        return cls("model_new_two_body", dim, pairs, 0, dim, pairs, _at(K_A), size, _at(K_B), size)

    @classmethod
    def sparse(cls, K, slaves, normals, *, fixed=(), masters=None, weights=None, tangents=None,
               triangle="full"):
        """The whole stiffness matrix of the host, without supports, and contact pairs.

        K: a scipy.sparse matrix, or (data, indices, indptr) by columns, rows ascending; counted
        from 0, as all degrees of freedom here.  triangle: which entries K holds, "full", "lower" or
        "upper".  slaves: degrees of freedom of each slave node, (P, D).  normals: outward from the
        slave's body, (P, D), or one for all.  fixed: degrees of freedom that are held.
        masters: for each pair the degrees of freedom of its master nodes, (k, D); None: rigid
        obstacles.  weights: for each pair those of its masters, k, of sum 1; None: one master each.
        tangents: first tangent of each pair, (P, D); None: in 2D the normal turned by +90 degrees.
        """
        if hasattr(K, "tocsc"):
            K = K.tocsc(copy=True)
            K.sum_duplicates()  # which sorts the rows, too
            K = (K.data, K.indices, K.indptr)
        data, rows, starts = K
        values = _reals("data of K", data)
        rows = _indices("indices of K", rows, values.shape, (np.int64, np.int32))
        starts = _indices("indptr of K", starts, None, (rows.dtype,))
        if triangle not in TRIANGLES:
            raise ValueError(f"triangle is {triangle!r}, not one of {', '.join(TRIANGLES)}")
        if values.ndim != 1 or starts.ndim != 1 or not len(starts) or starts[-1] != len(values):
            raise ValueError("K: the last entry of indptr is not the number of data")
        matrix = _Sparse(ctypes.sizeof(_Sparse), rows.dtype.itemsize, 0, TRIANGLES.index(triangle),
                         len(starts) - 1, len(values), _at(starts), _at(rows), _at(values))

        slaves = np.atleast_2d(np.asarray(slaves))
        count, dim = slaves.shape
        slaves = _indices("slaves", slaves, (count, dim))
        fixed = _indices("fixed", fixed, (np.size(fixed),))
        normals = _reals("normals", normals, (count, dim), fill=True)
        tangents = _reals("tangents", tangents, (count, dim), fill=True)
        first = nodes = None
        if masters is not None:
            if len(masters) != count or (weights is not None and len(weights) != count):
                raise ValueError(f"masters and weights are not for {count} pairs")
            each = [np.reshape(np.asarray(of), (-1, dim)) for of in masters]
            sizes = [len(of) for of in each]
            first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
            nodes = _indices("masters", np.concatenate(each), (sum(sizes), dim))
            weights = [[1.0]] * count if weights is None else weights
            if [np.size(of) for of in weights] != sizes:
                raise ValueError("weights are not one for each master")
            weights = _reals("weights", np.concatenate([np.ravel(of) for of in weights]))
        pairs = _Pairs(ctypes.sizeof(_Pairs), dim, count, _at(slaves), _at(first), _at(nodes),
                       _at(weights), _at(normals), _at(tangents))
        return cls("model_new_sparse", dim, count, len(fixed), ctypes.byref(matrix), len(fixed),
                   _at(fixed), ctypes.byref(pairs))

    @property
    def stiffness(self):
        K = np.zeros((self.dim * self.pairs,) * 2, order="F")
        self._do("model_stiffness", _at(K))
        return K

    def solve(self, f, gap, mu, slip=None, prescribed=None, *, start=None, **settings):
        """Solves a load case, f of H entries: a Result; or several, f of (C, H): a list of them.

        gap, mu, slip, start: as for solve.  prescribed: values of the fixed degrees of freedom;
        None: zero. With several cases each may have a leading axis of C, or be the same for all,
        and a case that is wrong does not stop the others: its status is negative, its numbers are
        NaN, its report is None.
        """
        several = np.ndim(f) == 2 and np.shape(f)[1:] == (self.host_size,)
        cases, pairs, dim = len(f) if several else 1, self.pairs, self.dim
        call = _Call(self._library, settings, start)
        given = [
            _reals("f", f, (cases, self.host_size)),
            _reals("prescribed", prescribed, (cases, self._fixed), fill=True),
            _reals("gap", gap, (cases, pairs), fill=True),
            _reals("mu", mu, (cases, pairs), fill=True),
            _reals("slip", slip, (cases, pairs, dim - 1), fill=True),
        ]
        d = np.full((cases, pairs, dim), np.nan)
        if start is not None:
            d[:] = _reals("start", start, d.shape, fill=True)
        F, state = np.full_like(d, np.nan), np.full((cases, pairs), -1, np.int32)
        untouched = np.iinfo(np.int32).min
        status = np.full(cases, untouched, np.int32)
        reports = (_Report * cases)(*[_report() for _ in range(cases)])
        first, message = call.run(
            self._library.model_solve, self._handle, cases, *[_at(array) for array in given],
            call.at(), _at(d), _at(F), _at(state), ctypes.byref(reports), _at(status),
        )
        if first < 0 and (not several or untouched in status):
            raise SignoriniError(message.removeprefix("case 0: "), first)
        results, told = [], False
        for c in range(cases):
            code = int(status[c])
            words = self._library.status_string(code).decode()
            if code != 0 and not told:  # the library's sentence is of the first of them
                words, told = message.removeprefix(f"case {c}: "), True
            if code < 0:
                d[c] = np.nan
            report = reports[c].plain() if code >= 0 else None
            results.append(Result(d[c], F[c], state[c], report, code, words))
        return results if several else results[0]

    def recover(self, d, f=None, prescribed=None):
        """Displacements of the host, H, of one case: from its d, N, its loads and its supports."""
        f = _reals("f", f, (self.host_size,))
        prescribed = _reals("prescribed", prescribed, (self._fixed,))
        d = _reals("d", d, (self.pairs, self.dim))
        u = np.zeros(self.host_size)
        self._do("model_recover", _at(f), _at(prescribed), _at(d), _at(u))
        return u

    def nodal_forces(self, F):
        """Contact forces F, N, as a nodal force vector of the host, H."""
        F = _reals("F", F, (self.pairs, self.dim))
        nodal = np.zeros(self.host_size)
        self._do("model_nodal_forces", _at(F), _at(nodal))
        return nodal

    def _do(self, function, *arguments):
        status = getattr(self._library, function)(self._handle, *arguments)
        _finish(self._library, status, self._library.last_error().decode())
