"""Arrays of the caller as the library takes them.

A shape is compared, never guessed: what does not fit is refused in a sentence that names the
argument, its shape, and the shape that is asked.
"""

import ctypes

import numpy as np


def at(array):
    """Address of an array; None for None."""
    return None if array is None else array.ctypes.data


def copied(pointer, shape, kind=ctypes.c_double):
    """A copy of an array of the library; None for NULL."""
    if not pointer:
        return None
    return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(kind)), shape).copy()


def fit(name, values, shapes, asked, *, cases=None, scalar=False, optional=False, elsewhere=None):
    """64-bit numbers of one of the shapes, which all mean the last one.

    asked: the shapes in words.  scalar: one number for all is fine.  cases: the result has a
    leading axis of that many; values without one are the same in every case.  optional: None for
    None.  elsewhere: a function of shape: the dim, another one, in which it would fit, or None.
    """
    if values is None and optional:
        return None
    if values is None:
        raise TypeError(f"{name} is None: give {asked}")
    array = reals(name, values)
    lead = () if cases is None else (cases,)
    meant = lead + shapes[-1]
    if array.shape in shapes:
        array = np.broadcast_to(array.reshape(shapes[-1]), meant)
    elif array.shape in [lead + shape for shape in shapes]:
        array = array.reshape(meant)
    elif scalar and array.ndim == 0:
        array = np.broadcast_to(array, meant)
    else:
        if cases is not None:
            asked += f", the same for all {cases} cases, or an axis of {cases} before it"
        if array.ndim == 2 and array.shape[::-1] in shapes:
            asked += "; the transpose fits"
        elif elsewhere is not None and (dim := elsewhere(array.shape)) is not None:
            asked += f"; the shape is that of dim={dim}, and dim is {5 - dim}"
        raise ValueError(f"{name} has the shape {array.shape}: give {asked}")
    return doubles(array)


def per_pair(name, values, pairs, dim, cases=None, optional=False):
    """One number for each pair of a problem of dim * pairs unknowns."""
    asked = f"one number for each of the {pairs} pairs, shape {(pairs,)}, or one for all"
    return fit(name, values, [(pairs,)], asked, cases=cases, scalar=True, optional=optional,
               elsewhere=_elsewhere(pairs, dim, lambda pairs, dim: [(pairs,)]))


def several(name, values, count, pairs, dim, cases=None):
    """Three or four numbers for each pair."""
    array = reals(name, values)
    if array.shape == (count,):
        array = np.broadcast_to(array, (pairs, count))
    word = {3: "three", 4: "four"}[count]
    asked = (f"{word} numbers for each of the {pairs} pairs, shape {(pairs, count)}, or ({count},) "
             "for all")
    return fit(name, array, [(pairs, count)], asked, cases=cases,
               elsewhere=_elsewhere(pairs, dim, lambda pairs, dim: [(pairs, count)]))


def components(name, values, pairs, dim, *, tangential=False, cases=None, scalar=False,
               optional=False):
    """dim numbers for each pair, or dim - 1 tangential ones."""
    def shapes(pairs, dim):
        width = dim - 1 if tangential else dim
        return [(pairs * width,), (pairs, width)]

    flat, rows = shapes(pairs, dim)
    asked = f"the numbers of the {pairs} pairs one pair after the other, shape {flat} or {rows}"
    asked += ", or one for all" if scalar else ""
    return fit(name, values, [flat, rows], asked, cases=cases, scalar=scalar, optional=optional,
               elsewhere=_elsewhere(pairs, dim, shapes))


def _elsewhere(pairs, dim, shapes):
    """For fit: whether a shape is one of shapes(pairs, dim) of the same size in the other dim."""
    other = 5 - dim
    if (dim * pairs) % other:
        return None
    fitting = shapes(dim * pairs // other, other)
    return lambda shape: other if shape in fitting else None


def reals(name, values):
    """Real numbers of any shape and width."""
    if hasattr(values, "tocsc"):
        raise TypeError(f"{name} is a scipy sparse matrix: give an array, {name}.toarray()")
    if values is None:
        raise TypeError(f"{name} is None: give real numbers")
    if isinstance(values, dict):
        raise TypeError(f"{name} is a dict, which the zones of a model have: give real numbers")
    array = _array(name, values)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} holds {array.dtype}, not real numbers")
    return array


def doubles(array):
    """Real numbers in the memory layout of the library."""
    return np.require(array, np.float64, ["C", "ALIGNED"])


def integers(name, values):
    """Integers of any shape and width."""
    if values is None:
        raise TypeError(f"{name} is None: give integers")
    array = _array(name, values)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind == "b":
        raise TypeError(f"{name} holds bool, not integers: give numpy.flatnonzero({name})")
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} holds {array.dtype}, not integers")
    return array


def indices(array, kind=np.int64):
    """Integers in the memory layout of the library."""
    return np.require(array, kind, ["C", "ALIGNED"])


def square(name, values):
    """A square matrix by columns."""
    array = reals(name, values)
    if array.ndim != 2 or array.shape[0] != array.shape[1]:
        raise ValueError(f"{name} has the shape {array.shape}: give a square matrix, shape (n, n)")
    return np.require(array, np.float64, ["F", "ALIGNED"])


def stiffness(name, values):
    """A condensed stiffness matrix by columns."""
    if hasattr(values, "tocsc"):
        raise TypeError(f"{name} is a scipy sparse matrix: use Model.sparse, or condense it first")
    array = square(name, values)
    _refuse_one_triangle(name, array)
    return array


def pairs_of(name, array, dim):
    """Number of pairs of a condensed matrix."""
    if dim not in (2, 3) or not isinstance(dim, (int, np.integer)):
        raise ValueError(f"dim is {dim!r}: give 2 or 3")
    if len(array) % dim:
        raise ValueError(f"{name} has the shape {array.shape}, and dim is {dim}: give {dim} rows "
                         f"and columns for each pair, or another dim")
    return len(array) // dim


def dimension(dim, shape, size, gaps):
    """dim; if it is None 3 for loads of the shape (P, 3), else 2.

    shape: of f.  size: N.  gaps: their number tells that of the pairs.
    """
    pairs_by_width = len(shape) == 2 and shape[1] in (2, 3) and shape[0] * shape[1] == size
    if dim is None:
        if shape == (2, 3) and size == 6:
            raise ValueError("f has the shape (2, 3): say dim=3 if that is two pairs in 3D, or "
                             "give f of shape (3, 2) for three pairs in 2D")
        if pairs_by_width:
            return shape[1]
        gap = () if gaps is None else reals("gap", gaps).shape
        if len(gap) == 1 and 3 * gap[0] == size:
            raise ValueError(f"gap has the shape {gap}, which is that of dim=3, and f has the "
                             f"shape {shape}: say dim=3, or give f of shape {(gap[0], 3)}")
        return 2
    if dim in (2, 3) and pairs_by_width and shape[1] != dim and size % dim == 0:
        raise ValueError(f"f has the shape {shape}, and dim is {dim}: give dim={shape[1]}, or f "
                         f"of shape {(size // dim, dim)}")
    return dim


def number(name, value):
    """A real number."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}: give a number") from None


def _array(name, values):
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked numbers: fill them, {name}.filled(number), or leave them out")
    if isinstance(values, (set, frozenset)):
        raise TypeError(f"{name} is a set, which has no order: give sorted({name})")
    try:
        return np.asarray(values)
    except ValueError as error:
        if hasattr(values, "_fields"):  # such as a Result in the place of its d
            raise TypeError(f"{name} is a {type(values).__name__}: give one of its arrays, such as "
                            f"{values._fields[0]}") from None
        raise ValueError(f"{name} is no array, its rows differ in length: {error}") from None


def _refuse_one_triangle(name, array):
    """Both triangles are asked. Ends early at the first entry of each."""
    size = range(len(array))
    upper = any(array[i, i + 1:].any() for i in size)
    lower = any(array[i + 1:, i].any() for i in size)
    if upper != lower:
        raise ValueError(f"{name} has the shape {array.shape}, but holds only its "
                         f"{'upper' if upper else 'lower'} triangle: give both, "
                         f"{name} + {name}.T - numpy.diag(numpy.diag({name}))")
