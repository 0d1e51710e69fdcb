"""A sector of a body that repeats about an axis or along lines: its boundaries, and the equations of their nodes."""

from collections import namedtuple
from itertools import product

import numpy as np

from ._arrays import fit, reals
from ._equations import nodal_dofs, turned_equations
from ._mesh import points

_NEAR = 1e-6  # of the size of the mesh: places are the same
_FACTORS = np.array([73856093, 19349663, 83492791])  # that different cells seldom have one key

Sector = namedtuple("Sector", "count point axis", defaults=[(0.0, 0.0, 1.0)])
Sector.__doc__ = """One of count sectors of a body that repeats about an axis.

count: number of sectors of the whole.  point: of the axis, (D,).  axis: its direction, (3,); in 2D not read. The second
boundary is the first one turned about it, right-handed; its displacements are those of the first, turned, as
sector_equations gives them.
"""

Period = namedtuple("Period", "way second", defaults=[None])
Period.__doc__ = """A part of a body that repeats along a line without end, or along two, in the place of a Sector.

way: from the first boundary of the part to the second, (D,). Displacements of both are the same, as sector_equations
gives them.  second: the same along the second line; None: there is none.
"""


def sector_equations(coordinates, sector, *, bodies=None, dofs=None):
    """Equations of the nodes on the second boundary of a Sector, u = turn @ u' of those on the first; and of nodes on its axis.
    Of a Period u = u'.

    coordinates: of all nodes, (n, D).  bodies: a number for each node, (n,), that tells nodes of two bodies apart that
    stand at one place; None: no two do.  dofs: of each node, (n, D); None: D * node + axis. Leave dofs of the second
    boundary out of fixed, and put the loads of its nodes where they act.
    """
    coordinates = points(coordinates)
    count, dim = coordinates.shape
    dofs = np.arange(dim * count).reshape(count, dim) if dofs is None else nodal_dofs("dofs", dofs)
    sector = checked(sector)
    first_of = {}
    motions = _motions(sector, dim)
    for place, motion in enumerate(motions):
        images, on_axis = _boundaries(coordinates, motion, bodies)
        seconds = {}
        for node, same in images:
            if len(same) > 1:
                raise ValueError(f"the image of node {node} is at the place of nodes {same[0]} and {same[1]}: give bodies, "
                                 "which tells them apart")
            if node not in seconds:  # of two sectors, each boundary is the image of the other
                seconds[same[0]] = node
        if not seconds and place < 2:  # a way that was given
            moved = f"shifted by {motion[2]}, a way of the Period" if isinstance(sector, Period) else (
                f"turned by one of {sector.count} sectors about the axis")
            raise ValueError(f"no node is the image of another, {moved}: nodes of the two boundaries must match")
        first_of = {**seconds, **first_of}
    second, first = list(first_of), list(first_of.values())
    # At a corner of two ways the image of an image has the pair.
    for _ in motions[1:]:
        first = [first_of.get(node, node) for node in first]
    found = turned_equations(dofs[second], dofs[first], motions[0][0])
    if not on_axis:
        return found
    # A turn leaves the part along the axis.
    axis = _axis(sector, dim)
    kept = abs(axis).argmax()
    return found + [(int(dofs[node, c]), [int(dofs[node, kept])] * (dim - 2), [axis[c] / axis[kept]] * (dim - 2))
                    for node in on_axis for c in range(dim) if dim == 2 or c != kept]


def checked(sector):
    """The Sector or Period of a caller, whose place and axis are not looked at; a tuple is a Sector too."""
    if isinstance(sector, Period):
        return sector
    try:
        sector = Sector(*sector)
    except TypeError:
        raise TypeError(f"sector is {sector!r}: give a Sector, its count, a point of its axis and the direction of "
                        "that, or a Period") from None
    if not isinstance(sector.count, (int, np.integer)) or sector.count < 2:
        raise ValueError(f"count of a Sector is {sector.count!r}: give the number of sectors of the whole, an integer of at "
                         "least 2, or a Period in the place of a Sector")
    return sector


def without_cuts(faces, coordinates, sector):
    """The faces of a skin but for those in its boundaries, which are no surface of the whole."""
    boundaries = []
    for motion in _motions(sector, coordinates.shape[1]):
        images, on_axis = _boundaries(coordinates, motion, None)
        boundaries += [{node for node, _ in images}.union(on_axis), set(on_axis).union(*(same for _, same in images))]
    return [face for face in faces if not any(nodes.issuperset(face) for nodes in boundaries)]


def without_axis(faces, coordinates):
    """Faces of a body of revolution without those on its axis x = 0, which no other body reaches."""
    on_axis = np.abs(coordinates[:, 0]) <= _NEAR * np.ptp(coordinates, axis=0).max()
    return [face for face in faces if not on_axis[list(face)].all()]


def _axis(sector, dim):
    axis = np.array([0.0, 0.0, 1.0]) if dim == 2 else fit("axis", sector.axis, [(3,)], "a direction, shape (3,)")
    if not 0 < np.linalg.norm(axis) < np.inf:
        raise ValueError(f"axis of the Sector is {axis}: give its direction")
    return axis / np.linalg.norm(axis)


def ways_of(period, dim):
    """The ways of a Period."""
    given = {"way": period.way} if period.second is None else period._asdict()
    ways = [fit(name, way, [(dim,)], f"a way, shape {(dim,)}") for name, way in given.items()]
    for name, way in zip(given, ways):
        if not (np.isfinite(way).all() and way.any()):
            raise ValueError(f"{name} of the Period is {way}: give the way from a first boundary to a second")
    if np.linalg.matrix_rank([way / np.linalg.norm(way) for way in ways], _NEAR) < len(ways):
        raise ValueError("way and second of the Period are along one line: give the shorter one alone")
    return ways


def _motions(sector, dim):
    """Those from a first boundary to a second, x -> turn @ (x - point) + shift + point: turn, point, shift."""
    if isinstance(sector, Period):
        ways = ways_of(sector, dim)
        if len(ways) == 2:  # a part may touch its image at a corner alone, or along a third line
            ways += [ways[0] + ways[1], ways[0] - ways[1]]
        return [(np.eye(dim), np.zeros(dim), way) for way in ways]
    # The turn by the formula of Rodrigues.
    angle, (x, y, z) = 2 * np.pi / sector.count, _axis(sector, dim)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)[:dim, :dim]
    return [(turn, fit("point", sector.point, [(dim,)], f"a place, shape {(dim,)}"), np.zeros(dim))]


def _boundaries(coordinates, motion, bodies):
    """Nodes on a first boundary, each with those of its body at its image on the second, and nodes on the axis."""
    count, dim = coordinates.shape
    turn, point, shift = motion
    bodies = np.zeros(count) if bodies is None else fit("bodies", bodies, [(count,)], f"a number for each node, ({count},)")
    arms, near = coordinates - point, _NEAR * np.ptp(coordinates, axis=0).max()
    images = arms @ turn.T + shift
    own, others = (np.floor(x / (2 * near)).astype(np.int64) for x in (arms, images))
    cells = {}
    for node, cell in enumerate(map(tuple, own.tolist())):
        cells.setdefault(cell, []).append(node)
    # Few images are near a node: those in or beside a cell whose key a node's cell has.
    keys = np.unique(own @ _FACTORS[:dim])
    near_one = np.zeros(count, bool)
    for step in product((-1, 0, 1), repeat=dim):
        wanted = (others + step) @ _FACTORS[:dim]
        near_one |= keys[np.searchsorted(keys, wanted) % len(keys)] == wanted
    found, on_axis = [], []
    for node in map(int, np.flatnonzero(near_one)):
        image = images[node]
        if np.linalg.norm(image - arms[node]) <= near:
            on_axis.append(node)
            continue
        around = product(*((cell - 1, cell, cell + 1) for cell in others[node].tolist()))
        same = [other for cell in around for other in cells.get(cell, ())
                if bodies[other] == bodies[node] and np.linalg.norm(arms[other] - image) <= near]
        if same:
            found.append((node, same))
    return found, on_axis
