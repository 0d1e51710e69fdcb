"""The shared library: finding it, the types of its functions, its errors."""

import ctypes
import os
import sys
import weakref
from types import SimpleNamespace

from ._constants import ABI_VERSION, Status, member
from ._structures import address, i32, i64, real, u32

SONAME_VERSION = "0.9"  # of libsignorini.so.0.9
BITS = 64  # of an address in the library
text = ctypes.c_char_p

# Friction in every call: law, its parameters, reference slip.
_LAW = [i32, address, address]
# dim, pairs, K, ldk, f, gap and the law.
_CONDENSED = [i32, i64, address, i64, address, address, *_LAW]
# f, prescribed, gap and the law.
_CASE = [address] * 3 + _LAW

SIGNATURES = {
    "version": (text, []),
    "status_string": (text, [i32]),
    "last_error": (text, []),
    "settings_default": (i32, [address, u32]),
    "report_default": (i32, [address, u32]),
    "extra_default": (i32, [address, u32]),
    "solve": (i32, [*_CONDENSED, *[address] * 6]),
    "lcp_solve": (i32, [i64, address, i64, *[address] * 7]),
    "model_new_condensed": (i32, [i32, i64, address, i64, address, address]),
    "model_new_two_body": (i32, [i32, i64, address, i64, address, i64, address, address]),
    "model_new_flexibility": (i32, [i32, i64, address, i64, address]),
    "model_new_flexibility_sparse": (i32, [i32, i64, address, address]),
    "model_new_sparse": (i32, [address, i64, *[address] * 4]),
    "model_new_operator": (i32, [address] * 2),
    "model_free": (None, [address]),
    "model_view": (i32, [address] * 2),
    "model_solve": (i32, [address, i64, *_CASE, *[address] * 7]),
    "model_certify": (i32, [address, *_CASE, real, *[address] * 4]),
    "model_prove": (i32, [address, *_CASE, *[address] * 5]),
    "model_condensed_load": (i32, [address] * 4),
    "model_recover": (i32, [address, i64, *[address] * 4]),
    "model_nodal_forces": (i32, [address] * 3),
    "model_write": (i32, [address, text, *_CASE, text]),
    "surface_settings_default": (i32, [address, u32]),
    "surface_pair": (i32, [i32, i64, *[address] * 5]),
    "surface_pair_obstacle": (i32, [i32, i64, *[address] * 5]),
    "surface_free": (None, [address]),
    "surface_view": (i32, [address] * 2),
    "surface_join": (i32, [i64, address, address]),
    "surface_table": (i32, [*[address] * 4, text, i64]),
    "surface_fields": (i32, [address] * 7),
    "surface_resultant": (i32, [address] * 6),
    "surface_adjust": (i32, [address, real, address]),
    "surface_penetration": (i32, [address] * 3),
    "mesh_write": (i32, [text, address, address, i64, address, i64, address]),
    "problem_write": (i32, [text, *_CONDENSED, text]),
    "lcp_write": (i32, [text, i64, address, i64, address, address, text]),
    "problem_read": (i32, [text, address]),
    "problem_free": (None, [address]),
    "problem_view": (i32, [address] * 2),
}
_loaded = None


class SignoriniError(RuntimeError):
    """A wrong argument, a file, an internal error, or a library that cannot be used.

    status: what the call returned (negative); None if the library cannot be used.
    """

    __module__ = "signorini"  # what a traceback calls it

    def __init__(self, message, status=None):
        super().__init__(message)
        self.status = status


def load(path=None):
    """Loads the library, from path if it is given; this package uses it from now on.

    Returns its version. Raises SignoriniError if there is none or if it does not fit.
    """
    global _loaded
    _loaded = _open(path)
    return _loaded.version().decode()


def library():
    """The functions of the library, by their names without signorini_."""
    if _loaded is None:
        load()
    return _loaded


class Owner:
    """Frees an object of the library when nothing refers to it any more: copies of what holds it hold it too."""

    def __init__(self, free, handle):
        weakref.finalize(self, free, handle)


class Remade:
    """Pickled and copied deeply by what it was made of, which makes it again; a copy by copy.copy is the same object of
    the library."""

    def __copy__(self):
        found = object.__new__(type(self))
        found.__dict__.update(self.__dict__)
        return found


def check(functions, status, message=None):
    """Raises an error; otherwise the status, and the library's sentence on it."""
    message = functions.last_error().decode() if message is None else message
    status = member(Status, status)
    if status < 0:
        raise SignoriniError(message, status)
    return status, message or functions.status_string(status).decode()


def _open(path):
    bits = 8 * ctypes.sizeof(ctypes.c_void_p)
    if bits != BITS:
        raise SignoriniError(f"the library signorini needs a Python of {BITS} bits, and this one has {bits}")
    end = {"darwin": ".dylib", "win32": ".dll"}.get(sys.platform, ".so")
    name = ("" if sys.platform == "win32" else "lib") + "signorini" + end
    here = os.path.dirname(os.path.abspath(__file__))
    installed = os.path.join(here, name)
    built = os.path.abspath(os.path.join(here, *[os.pardir] * 3, "target", "release", name))
    named = path or os.environ.get("SIGNORINI_LIBRARY")
    if named:
        places = [os.path.abspath(named)]
    else:
        system = [name, f"{name}.{SONAME_VERSION}"]
        places = [place for place in (installed, built) if os.path.exists(place)] + system
    reasons = []
    for place in places:
        try:
            opened = ctypes.CDLL(place)
        except OSError as error:
            reasons.append(str(error))
            continue
        return _bound(opened, place)
    remedy = "build it by cargo build --release, or set SIGNORINI_LIBRARY to its path"
    if os.path.exists(places[0]):
        remedy = "a library that it needs is missing, or it is for another system or processor"
    raise SignoriniError("the library signorini cannot be loaded (" + "; ".join(reasons) + "): " + remedy)


def _bound(opened, place):
    # Before all else: of another interface nothing else may be called.
    if not hasattr(opened, "signorini_abi_version"):
        raise SignoriniError(f"{place} is not the library signorini")
    opened.signorini_abi_version.restype = i32
    found = opened.signorini_abi_version()
    if found != ABI_VERSION:
        raise SignoriniError(
            f"{place} has the binary interface {found}, but this package is written for "
            f"{ABI_VERSION}: use the Python package that belongs to the library"
        )
    functions = SimpleNamespace()
    for name, (result, arguments) in SIGNATURES.items():
        function = getattr(opened, "signorini_" + name, None)
        if function is None:
            raise SignoriniError(f"{place} has no signorini_{name}: it is older than this package")
        function.restype, function.argtypes = result, arguments
        setattr(functions, name, function)
    return functions
