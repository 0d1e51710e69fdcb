"""Sparse matrices, and the other arguments of Model.sparse: supports, contact pairs."""

from itertools import combinations

import numpy as np

from ._arrays import at, doubles, fit, indices, integers, reals
from ._constants import Triangle, chosen
from ._equations import Equations
from ._structures import Pairs, Sparse, sized

_ROUNDING = 1e-6  # of coordinates with seven digits
_SUMMED = 1e-12  # of what is added up: rounding of a sum


class Matrix:
    """A sparse matrix; structure: signorini_sparse."""

    def __init__(self, K, triangle, order=None, name="K"):
        triangle = chosen("triangle", Triangle, triangle)
        data, rows, starts = _compressed(name, K)
        self.values = doubles(reals(f"data of {name}", data))
        rows, starts = integers(f"indices of {name}", rows), integers(f"indptr of {name}", starts)
        if self.values.ndim != 1 or rows.shape != self.values.shape:
            raise ValueError(f"data and indices of {name} have the shapes {self.values.shape} and "
                             f"{rows.shape}: give one value and one row for each entry")
        if starts.ndim != 1 or not len(starts):
            raise ValueError(f"indptr of {name} has the shape {starts.shape}: give the begin of each "
                             f"column and the end of the last one, shape (columns + 1,)")
        if starts[-1] != len(rows):
            raise ValueError(f"indptr of {name} ends with {starts[-1]}, but {name} has {len(rows)} "
                             f"entries: end it with their number")
        kind = np.int32 if rows.dtype == np.int32 else np.int64
        self.rows, self.starts = indices(rows, kind), indices(starts, kind)
        self.order = None if order is None else _order(order, len(starts) - 1, kind)
        self.structure = sized(
            Sparse, index_bytes=self.rows.itemsize, index_base=0, triangle=triangle,
            size=len(starts) - 1, nnz=len(rows), col_start=at(self.starts), row=at(self.rows),
            values=at(self.values), order=at(self.order),
        )
        self.shape = (len(self), len(self))

    def __len__(self):
        return len(self.starts) - 1

    def resisted(self, u):
        """For each row whether u meets a force in it that is not rounding, and whether u meets an entry at all."""
        columns = np.repeat(np.arange(len(self)), np.diff(self.starts))
        parts = [(self.values, self.rows, columns)]
        if self.structure.triangle != Triangle.FULL:
            off = self.rows != columns
            parts.append((self.values[off], columns[off], self.rows[off]))
        force, terms = np.zeros((2, len(self)))
        for values, rows, of in parts:
            force += np.bincount(rows, values * u[of], len(self))
            terms += np.bincount(rows, abs(values * u[of]), len(self))
        return abs(force) > _SUMMED * terms, terms > 0

    def given(self):
        """(data, indices, indptr) of its own."""
        return self.values.copy(), self.rows.copy(), self.starts.copy()


class ContactPairs:
    """Contact pairs; structure: signorini_pairs."""

    def __init__(self, slaves, normals, masters, weights, tangents, rows, equations=None):
        self.slaves = self.starts = self.masters = self.weights = None
        self.equations = None if equations is None else Equations(equations)
        if rows is None:
            names, (count, dim) = ("master_start", "masters", "weights"), self._of_slaves(
                slaves, masters, weights)
        else:
            if not (slaves is None and masters is None and weights is None):
                raise ValueError("rows is given with slaves, masters or weights: a row names all "
                                 "nodes of its pair, leave the others out")
            names, (count, dim) = self._of_rows(rows)
        self.normals, self.tangents = (
            _vectors(name, given, count, dim, name == "tangents")
            for name, given in (("normals", normals), ("tangents", tangents))
        )
        nodes = dict(zip(names, (at(self.starts), at(self.masters), at(self.weights))))
        self.structure = sized(
            Pairs, dim=dim, count=count, slaves=at(self.slaves), normals=at(self.normals),
            tangents=at(self.tangents), equations=self.equations and self.equations.address,
            **nodes,
        )

    def _of_slaves(self, slaves, masters, weights):
        if slaves is None:
            raise TypeError("slaves is None: give the slave nodes, or rows")
        slaves = integers("slaves", slaves)
        if slaves.ndim != 2 or slaves.shape[1] not in (2, 3):
            raise ValueError(f"slaves has the shape {slaves.shape}: give the dof numbers of each "
                             f"slave node, shape (pairs, dim), dim 2 or 3")
        self.slaves, (count, dim) = indices(slaves), slaves.shape
        if masters is not None:
            self._take(masters, weights, count, dim)
        elif weights is not None:
            raise ValueError("weights is given without masters: give both, or neither")
        return count, dim

    def _of_rows(self, rows):
        asked = ("give (dofs, weights) for each pair: the dof numbers of its nodes, (k, D), and k weights; or k dof "
                 "numbers and (k, D) vectors")
        try:
            nodes = [dofs for dofs, _ in rows]
            weights = [weights for _, weights in rows]
        except (TypeError, ValueError):
            raise ValueError(f"rows is no list of pairs: {asked}") from None
        shapes = {np.shape(dofs)[1:] for dofs in nodes}
        if shapes == {()}:
            return ("row_start", "row_nodes", "row_vectors"), self._of_dofs(nodes, weights, asked)
        if len(shapes) != 1 or shapes not in ({(2,)}, {(3,)}):
            raise ValueError(f"rows has nodes of the shapes {sorted(shapes)}: {asked}, D 2 or 3")
        (dim,), count = shapes.pop(), len(nodes)
        self._take(nodes, weights, count, dim)
        return ("row_start", "row_nodes", "row_weights"), (count, dim)

    def _of_dofs(self, dofs, vectors, asked):
        dofs = [integers(f"rows[{pair}]", of) for pair, of in enumerate(dofs)]
        vectors = [reals(f"rows[{pair}]", of) for pair, of in enumerate(vectors)]
        dim = vectors[0].shape[-1] if vectors[0].ndim else 0
        for pair, (of, numbers) in enumerate(zip(dofs, vectors)):
            if dim not in (2, 3) or numbers.shape != (*of.shape, dim):
                raise ValueError(f"rows[{pair}] has the shapes {of.shape} and {numbers.shape}: {asked}")
        self.starts = indices(np.cumsum([0, *map(len, dofs)]))
        self.masters = indices(np.concatenate(dofs))
        self.weights = doubles(np.concatenate(vectors))
        return len(dofs), dim

    def _take(self, masters, weights, count, dim):
        _one_each("masters", masters, count)
        nodes = [_nodes(f"masters[{pair}]", of, dim) for pair, of in enumerate(masters)]
        sizes = [len(of) for of in nodes]
        if weights is None:
            several = [pair for pair, size in enumerate(sizes) if size > 1]
            if several:
                raise ValueError(f"weights is None, but pair {several[0]} has "
                                 f"{sizes[several[0]]} masters: give their weights")
            weights = [[1.0] * size for size in sizes]
        _one_each("weights", weights, count)
        weights = [
            fit(f"weights[{pair}]", of, [(size,)], f"one number for each of the {size} masters of "
                f"that pair, shape {(size,)}")
            for pair, (of, size) in enumerate(zip(weights, sizes))
        ]
        self.starts = indices(np.cumsum([0, *sizes]))
        self.masters = indices(np.concatenate([np.zeros((0, dim), np.int64), *nodes]))
        self.weights = np.concatenate([np.zeros(0), *weights])


def supports(fixed):
    """Numbers of the fixed degrees of freedom."""
    fixed = integers("fixed", fixed)
    if fixed.ndim != 1:
        raise ValueError(f"fixed has the shape {fixed.shape}: give the dof numbers in one list, "
                         f"shape (count,)")
    return indices(fixed)


def columns_of(K):
    """Number of columns of a sparse matrix."""
    return len(_compressed("K", K)[2]) - 1


def resists_turns(entries, places):
    """Does a stiffness matrix of such values, rows and columns resist small turns of its nodes, which are at these places, (n, D)?"""
    data, rows, columns = entries
    arms = places - places.mean(axis=0)
    for a, b in combinations(range(arms.shape[1]), 2):
        u = np.zeros_like(arms)
        u[:, a], u[:, b] = -arms[:, b], arms[:, a]
        force, stiffness = (np.bincount(rows, parts, arms.size) for parts in (data * u.ravel()[columns], abs(data)))
        if (abs(force) > _ROUNDING * abs(u).max() * stiffness).any():
            return True
    return False


def entries_of(K, triangle):
    """Values, rows and columns of all entries of a symmetric sparse matrix; None if it is no matrix."""
    data, rows, starts = _compressed("K", K)
    data = np.asarray(reals("data of K", data), np.float64)
    rows, starts = (np.asarray(integers(f"{name} of K", of), np.int64) for name, of in (("indices", rows), ("indptr", starts)))
    counts = np.diff(starts)
    if counts.min(initial=0) < 0 or not counts.sum() == len(rows) == len(data) or rows.min(initial=0) < 0 or rows.max(
            initial=0) >= len(counts):
        return None
    columns = np.repeat(np.arange(len(counts)), counts)
    if chosen("triangle", Triangle, triangle) != Triangle.FULL:
        off = rows != columns
        data, rows, columns = (np.concatenate([own, other[off]]) for own, other in
                               ((data, data), (rows, columns), (columns, rows)))
    return data, rows, columns


def side_by_side(matrices):
    """Two matrices as one, (data, indices, indptr): the blocks of its diagonal."""
    parts = [_compressed("K", K) for K in matrices]
    before, data, rows, starts = 0, [], [], [np.zeros(1, np.int64)]
    for values, indices_of, starts_of in parts:
        data.append(reals("data of K", values))
        rows.append(before + np.asarray(integers("indices of K", indices_of), np.int64))
        starts.append(starts[-1][-1] + np.asarray(integers("indptr of K", starts_of), np.int64)[1:])
        before += len(starts_of) - 1
    return np.concatenate(data), np.concatenate(rows), np.concatenate(starts)


def _order(order, size, kind):
    order = integers("order", order)
    if order.shape != (size,):
        raise ValueError(f"order has the shape {order.shape}: give each dof number once, shape "
                         f"{(size,)}")
    narrow = np.iinfo(kind)
    # Numbers that do not fit are refused by the library as they would be in 64 bits.
    return indices(np.clip(order, narrow.min, narrow.max), kind)


def is_sparse(matrix):
    """Is a matrix of scipy.sparse, or (data, indices, indptr)?"""
    return hasattr(matrix, "tocsc") or isinstance(matrix, tuple) and len(matrix) == 3


def _compressed(name, K):
    if hasattr(K, "tocsc"):
        if K.shape[0] != K.shape[1]:
            raise ValueError(f"{name} has the shape {K.shape}: give a square matrix, one row for "
                             f"each degree of freedom")
        K = K.tocsc(copy=True)
        K.sum_duplicates()  # which sorts the rows, too
        return K.data, K.indices, K.indptr
    if is_sparse(K):
        return K
    given = f"an array of the shape {K.shape}" if hasattr(K, "shape") else f"a {type(K).__name__}"
    raise TypeError(f"K is {given}: give a scipy sparse matrix or a tuple (data, indices, indptr); "
                    f"for a condensed matrix use Model.condensed")


def _vectors(name, values, count, dim, optional):
    asked = f"one vector for each pair, shape {(count, dim)}, or one for all, shape {(dim,)}"
    if values is not None and np.shape(values) == (dim,):
        values = np.broadcast_to(reals(name, values), (count, dim))
    return fit(name, values, [(count, dim)], asked, optional=optional)


def _one_each(name, lists, count):
    if not hasattr(lists, "__len__") or len(lists) != count:
        entries = f"{len(lists)} entries" if hasattr(lists, "__len__") else "no entries"
        raise ValueError(f"{name} has {entries}: give one list for each of the {count} pairs")


def _nodes(name, values, dim):
    nodes = integers(name, values)
    if nodes.size == 0:
        return np.zeros((0, dim), np.int64)
    if nodes.shape == (dim,):
        return nodes[None, :]
    if nodes.ndim != 2 or nodes.shape[1] != dim:
        raise ValueError(f"{name} has the shape {nodes.shape}: give the dof numbers of each master "
                         f"node of that pair, shape (masters, {dim})")
    return nodes
