"""Matrices of two meshes: each is of its own mesh, and none is exchanged or given twice."""

import numpy as np

from ._skin import dimension
from ._sparse import columns_of, entries_of, resists_turns

_ROUNDING = 1e-6  # of coordinates with seven digits
_NONE = 1e-12  # of the largest entry: an entry is none
_AT, _WEIGHTS = np.polynomial.legendre.leggauss(4)

_SAME = "the two matrices are both of one mesh: give one for each, that of the slave first"
_TURNS = "one of them resists turns of its own mesh and none of the other mesh"
_STRETCHES = "one of them has the forces of stretched rings of the other mesh and not of its own"
_CELLS = "one of them joins nodes that have no cell of its own mesh in common, and of the other mesh all have one"


def check_matrices(matrices, triangle, meshes, per_node, is_of_rings):
    """Refuses matrices that are not those of the meshes, slave's first, whose nodes have so many degrees of freedom."""
    sizes, asked = [columns_of(K) for K in matrices], [per_node * len(mesh.coordinates) for mesh in meshes]
    if len(sizes) == 1 and sizes[0] < sum(asked):
        both = "the two meshes have" if len(asked) == 2 else "the mesh has"
        raise ValueError(f"K has {sizes[0]} columns, {both} {sum(asked)} degrees of freedom: give the matrix of all"
                         + (", or (K of the slave's mesh, K of the master's)" if len(asked) == 2 else ""))
    if len(sizes) == 2 and sizes != asked:
        exchanged = "exchange them" if sizes == asked[::-1] else "give one for each mesh, that of the slave first"
        raise ValueError(f"the two matrices have {sizes[0]} and {sizes[1]} columns, the meshes of slave and master "
                         f"{' and '.join(map(str, asked))} degrees of freedom: {exchanged}")
    if len(meshes) < 2:
        return
    parts = [entries_of(K, triangle) for K in matrices]
    if None in parts:  # the library says what is wrong with them
        return
    first, found = "the two matrices are exchanged", None
    if len(parts) == 1:
        first = "K has the block of the master's mesh before that of the slave's"
        parts, found = _blocks(parts[0], asked)
    found = found or asked[0] == asked[1] and _exchanged(parts, meshes, per_node, is_of_rings)
    if found:
        raise ValueError(found if found == _SAME else f"{first}: {found}; give that of the slave first")


def _blocks(entries, asked):
    """The blocks of a matrix of two meshes, and what tells that their order is exchanged, or None."""
    def split(at):
        values, rows, columns = entries
        inside = (rows < sum(asked)) & (columns < sum(asked)) & (abs(values) > _NONE * abs(values).max(initial=0.0))
        lower, left = rows[inside] < at, columns[inside] < at
        parts = [tuple((array[inside] - at * behind * (k > 0))[own] for k, array in enumerate(entries))
                 for behind, own in ((False, lower & left), (True, ~lower & ~left))]
        return parts, (lower != left).any()
    (parts, is_joined), (exchanged, would_be) = split(asked[0]), split(asked[1])
    if is_joined and not would_be and all(len(values) for values, *_ in exchanged):
        return parts, f"its first {asked[1]} degrees of freedom are joined with none of the others"
    return parts, None


def _exchanged(parts, meshes, per_node, is_of_rings):
    """What tells that matrices of one size are exchanged, or one of them given twice; or None."""
    places = [mesh.coordinates for mesh in meshes]
    is_plane = places[0].shape[1] == 2
    tests = [(_CELLS, lambda part, mesh: _joins_others(part, mesh, per_node))] if is_plane else []
    if is_of_rings:
        tests.append((_STRETCHES, lambda part, mesh: not _is_of_rings(part, mesh)))
    elif per_node == places[0].shape[1]:
        tests.append((_TURNS, lambda part, mesh: resists_turns(part, mesh.coordinates)))
    for what, is_strange in tests:
        own, other = ([is_strange(part, mesh) for part, mesh in zip(parts, order)] for order in (meshes, meshes[::-1]))
        wrong = [mine and not others for mine, others in zip(own, other)]
        right = [others and not mine for mine, others in zip(own, other)]
        if any(wrong):
            return _SAME if any(right) else what
    return None


def _joins_others(part, mesh, per_node):
    """Does a matrix have entries between nodes that no cell of the mesh has both of?"""
    values, rows, columns = part
    count = len(mesh.coordinates)
    known = [nodes[:, a] * count + nodes[:, b] for kind, nodes in mesh.blocks if dimension([kind])
             for a in range(nodes.shape[1]) for b in range(nodes.shape[1])]
    is_some = abs(values) > _NONE * abs(values).max(initial=0.0)
    joined = np.unique(rows[is_some] // per_node * count + columns[is_some] // per_node)
    return not np.isin(joined, np.concatenate([np.arange(count) * (count + 1), *known])).all()


def _is_of_rings(part, mesh):
    """Is a matrix that of rings of one isotropic material? Where all radii or all heights are stretched stresses are uniform, and
    nodal forces are those of their tractions on the skin."""
    values, rows, columns = part
    x, forces = mesh.coordinates, np.zeros_like(mesh.coordinates)
    for face in mesh.skin:
        face = np.asarray(face)
        ends, off = x[face[:2]], (x[face[2]] - x[face[:2]].mean(axis=0) if len(face) > 2 else np.zeros(2))
        # A line of 2 or 3 nodes: straight, and a bulge of the middle.
        way = 0.5 * (ends[1] - ends[0]) - 2 * np.outer(_AT, off)
        at = ends.mean(axis=0) + np.outer(_AT, 0.5 * (ends[1] - ends[0])) + np.outer(1 - _AT ** 2, off)
        shapes = np.stack([(1 - _AT) / 2, (1 + _AT) / 2])
        if len(face) > 2:
            shapes = np.vstack([shapes - (1 - _AT ** 2) / 2, 1 - _AT ** 2])
        outward = np.stack([way[:, 1], -way[:, 0]], 1) * (_WEIGHTS * at[:, 0])[:, None]
        np.add.at(forces, face, shapes @ outward)
    stresses = []
    for axis in (0, 1):
        u = np.zeros_like(x)
        u[:, axis] = x[:, axis] - (0.0 if axis == 0 else x[:, 1].mean())
        found = np.bincount(rows, values * u.ravel()[columns], x.size).reshape(-1, 2)
        stress = (found * forces).sum(axis=0) / (forces * forces).sum(axis=0)
        if not (abs(found - stress * forces) <= _ROUNDING * abs(found).max()).all():
            return False
        stresses.append(stress)
    (across, along), (beside, ahead) = stresses  # 2 (lame + shear), 2 lame; lame, lame + 2 shear
    size = _ROUNDING * abs(np.array(stresses)).max()
    return abs(along - 2 * beside) <= size and abs(ahead + beside - across) <= size
