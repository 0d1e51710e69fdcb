"""A sector of a body that repeats about an axis or along lines: its boundaries, and the equations of their nodes."""

from collections import namedtuple

import numpy as np

from ._arrays import fit
from ._equations import nodal_dofs, turned_equations
from ._mesh import points
from ._near import Spacing, last_digit, near_pairs
from ._text import tell

_NEAR = 1e-6  # of the size of the mesh: places are the same
_ROUNDED = 2e-4  # of the largest coordinate: as far apart two places of one node may be in five digits
# Of the distance between nodes: images that miss by less than the first may be partners, by more than the second are told, and
# by less than the last belong to boundaries. More of that would refuse nodes that are inside, in one of 30 random meshes by a half.
_PARTNER, _TOLD, _MISS = 0.1, 0.01, 0.25

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
    stand at one place; None: no two do. Nodes with a negative one get no equations: those whose neighbours in the next
    sector are not joined with them, and others than those of a mesh.  dofs: of each node, (n, D); None: D * node + axis.
    Leave dofs of the second boundary out of fixed, and put the loads of its nodes where they act.
    Images may miss their nodes by 1e-6 of the size of the mesh, and in coordinates of five digits and more, as those of
    decks, by what these leave open. Nodes of a flat boundary without a partner are refused, and of a curved one those whose
    images miss a node without a partner by less than a quarter of the distance between nodes.
    """
    coordinates = points(coordinates)
    count, dim = coordinates.shape
    dofs = np.arange(dim * count).reshape(count, dim) if dofs is None else nodal_dofs("dofs", dofs)
    sector, parts = checked(sector), _parts(coordinates, bodies)
    limits, first_of, told = _limits(coordinates), {}, (0.0, "")
    motions = _motions(sector, dim)
    for place, motion in enumerate(motions):
        moved = f"shifted by {motion.shift}, a way of the Period" if isinstance(sector, Period) else (
            f"turned by one of {sector.count} sectors about the axis")
        found = [_Boundaries(coordinates, motion, of, limits) for of in parts]
        seconds, on_axis = {}, [node for part in found for node in part.on_axis]
        for node, same in (image for part in found for image in part.images):
            if len(same) > 1:
                raise ValueError(f"the image of node {node} is at the place of nodes {same[0]} and {same[1]}: give bodies, "
                                 "which tells them apart")
            if node not in seconds:  # of two sectors, each boundary is the image of the other
                seconds[same[0]] = node
        missing = next((part.missing for part in found if part.missing), "")
        if not seconds and place < 2:  # a way that was given
            raise ValueError(f"no node is the image of another, {moved}: nodes of the two boundaries must match" +
                             (missing and f"; {missing}"))
        if missing:
            raise ValueError(f"{missing}, {moved}: mesh the two boundaries alike, with coordinates of five digits or more; nodes that "
                             "are not joined with their images have a negative number in bodies")
        told = max([told, *((part.miss, f"{part.told}, {moved}") for part in found)])
        first_of = {**seconds, **first_of}
    if told[0] > _TOLD:
        tell(f"sector_equations: {told[1]}: boundaries that match to {told[0]:.2g} of the distance between nodes alone, give "
             "coordinates with more digits")
    second, first = list(first_of), list(first_of.values())
    # At a corner of two ways the image of an image has the pair.
    for _ in motions[1:]:
        first = [first_of.get(node, node) for node in first]
    found = turned_equations(dofs[second], dofs[first], motions[0].turn)
    if not on_axis:
        return found
    # A turn leaves the part along the axis.
    axis = _axis(sector, dim)
    kept = abs(axis).argmax()
    return found + [(int(dofs[node, c]), [int(dofs[node, kept])] * (dim - 2), [axis[c] / axis[kept]] * (dim - 2))
                    for node in on_axis for c in range(dim) if dim == 2 or c != kept]


def _parts(coordinates, bodies):
    """The nodes of each body."""
    if bodies is None:
        return [np.arange(len(coordinates))]
    bodies = fit("bodies", bodies, [(len(coordinates),)], f"a number for each node, ({len(coordinates)},)")
    return [np.flatnonzero(bodies == body) for body in np.unique(bodies[bodies >= 0])]


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
        found = _Boundaries(coordinates, motion, np.arange(len(coordinates)), _limits(coordinates))
        boundaries += [{node for node, _ in found.images}.union(found.on_axis),
                       set(found.on_axis).union(*(same for _, same in found.images))]
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


class _Motion(namedtuple("_Motion", "turn point shift")):
    """x -> turn @ (x - point) + shift + point."""

    def of(self, x):
        return (x - self.point) @ self.turn.T + self.shift + self.point

    def back(self, x):
        return (x - self.shift - self.point) @ self.turn + self.point


def _motions(sector, dim):
    """Those from a first boundary to a second."""
    if isinstance(sector, Period):
        ways = ways_of(sector, dim)
        if len(ways) == 2:  # a part may touch its image at a corner alone, or along a third line
            ways += [ways[0] + ways[1], ways[0] - ways[1]]
        return [_Motion(np.eye(dim), np.zeros(dim), way) for way in ways]
    # The turn by the formula of Rodrigues.
    angle, (x, y, z) = 2 * np.pi / sector.count, _axis(sector, dim)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)[:dim, :dim]
    return [_Motion(turn, fit("point", sector.point, [(dim,)], f"a place, shape {(dim,)}"), np.zeros(dim))]


def _limits(coordinates):
    """How far apart nodes may be that are one: anywhere, and where the distance between nodes is much larger."""
    near, dim = _NEAR * np.ptp(coordinates, axis=0).max(initial=0.0), coordinates.shape[1]
    rounding = np.sqrt(dim) * last_digit(coordinates.ravel())
    return near, max(near, min(rounding, _ROUNDED * abs(coordinates).max(initial=0.0)))


class _Boundaries:
    """Nodes of a body on a first boundary, each with those at its image on the second, and nodes on the axis.

    images: (node, nodes at its image) for each.  on_axis: nodes that are their own images.  missing: a sentence on nodes
    of a boundary without a partner, or "".  miss: the largest distance of an image from its node, of that between nodes;
    told: a sentence on it.
    """

    def __init__(self, coordinates, motion, of, limits):
        self._of, self._x, self._motion = of, coordinates[of], motion
        self._near, self._rounded = limits
        self.images, self.on_axis, self.missing, self.miss, self.told = [], [], "", 0.0, ""
        if not len(of):
            return
        spacing = Spacing(self._x, self._near)
        limits = np.maximum(_MISS * spacing.at_most, self._rounded)
        nodes, others, away = near_pairs(self._x, motion.of(self._x), limits)
        # One number for each pair that is near.
        known, places = np.unique(np.concatenate([nodes, others]), return_inverse=True)
        spaces = spacing.at(known)[places].reshape(2, -1).min(axis=0)
        allowed = np.maximum(self._near, np.minimum(self._rounded, _PARTNER * spaces))
        self._match((nodes, others, away, spaces), away <= allowed)

    def _match(self, pairs, same):
        nodes, others, away, spaces = pairs
        on_axis = np.unique(nodes[same & (nodes == others)])
        same &= ~np.isin(nodes, on_axis)
        starts = np.flatnonzero(np.diff(nodes[same], prepend=-1))
        firsts = nodes[same][starts]
        self.images = [(node, list(group)) for node, group in
                       zip(self._of[firsts].tolist(), np.split(self._of[others[same]], starts[1:]))]
        self.on_axis = self._of[on_axis].tolist()
        free = ~np.isin(np.arange(len(self._x)), np.concatenate([nodes[same], others[same], on_axis]))
        missed = np.flatnonzero(free[nodes] & free[others] & (away < _MISS * spaces))
        if same.any():
            shares = np.where(same, away / spaces, 0.0)
            worst = shares.argmax()
            self.miss, self.told = shares[worst], self._sentence(nodes[worst], others[worst])
            self._find_missing(free, (nodes[same], others[same], on_axis))
        if len(missed) and not self.missing:
            self.missing = self._sentence(nodes[missed[0]], others[missed[0]])

    def _sentence(self, node, other):
        away = np.linalg.norm(self._motion.of(self._x[node]) - self._x[other])
        return f"the image of node {self._of[node]} misses node {self._of[other]} by {away:.3g}"

    def _find_missing(self, free, boundaries):
        """Looks for nodes without partners in flat boundaries behind which the body has no node."""
        firsts, seconds, on_axis = boundaries
        for on, motion in ((firsts, self._motion.of), (seconds, self._motion.back)):
            plane = self._x[np.concatenate([on, on_axis])]
            middle = plane.mean(axis=0)
            _, lengths, ways = np.linalg.svd(plane - middle, full_matrices=False)
            if len(lengths) < self._x.shape[1] or lengths[-2] <= self._rounded:
                continue
            heights = (self._x - middle) @ ways[-1]
            near = 2 * self._rounded
            is_flat = (abs(heights[np.concatenate([on, on_axis])]) <= near).all()
            if not is_flat or heights.min() < -near and heights.max() > near:
                continue
            left = np.flatnonzero(free & (abs(heights) <= near))
            if not len(left):
                continue
            image = motion(self._x[left[0]])
            nearest = np.linalg.norm(self._x - image, axis=1).argmin()
            pair = (left[0], nearest) if on is firsts else (nearest, left[0])
            self.missing = (f"of the nodes in a boundary {len(left)}, such as node {self._of[left[0]]}, have no partner in the other: "
                            f"{self._sentence(*pair)}")
            return
