"""The pressure on the faces of surfaces in 3D, by matplotlib: one picture of all zones on its axes.

Marks, arrows and borders are flat shapes of the surface itself, of areas that are shares of it: they cover as little of a
fine mesh as of a coarse one, and of a small picture as of a large one.
"""

import numpy as np

from matplotlib import colors, patheffects
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ._constants import State
from ._plot import MARKED, STATES
from ._surfaces import frames_of

# The flat parts that a face of so many nodes is drawn as.
_PARTS = {3: [[0, 1, 2]], 4: [[0, 1, 2, 3]], 6: [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
          8: [[0, 4, 7], [4, 1, 5], [5, 2, 6], [7, 6, 3], [4, 5, 6, 7]],
          9: [[0, 4, 8, 7], [4, 1, 5, 8], [8, 5, 2, 6], [7, 8, 6, 3]]}
# The shares of the surface that marks and borders cover at most.
_MARKS, _BORDERS = 0.05, 0.03
# The largest and the least width of borders, of the side of a square of the surface's area; thinner ones would be a haze.
_WIDE, _THIN = 0.006, 0.0015
# The smallest and the largest letters of the legend, in points.
_LETTERS = 5.0, 8.5
# Faces from which on their edges would hide them.
_EDGED = 1500


def _around(corners, turn=0.0):
    """Places of a regular polygon of the area 1."""
    angle = 2 * np.pi * np.arange(corners) / corners + turn
    return np.column_stack([np.cos(angle), np.sin(angle)]) / np.sqrt(corners / 2 * np.sin(2 * np.pi / corners))


# The shapes of marks; by them colours are not needed.
_SHAPES = {State.OPEN: _around(12), State.SLIP: _around(3, np.pi / 2), State.STICK: _around(4, np.pi / 4)}
# An arrow from the origin, of the length 1.
_ARROW = np.array([[0.0, 0.03], [0.65, 0.03], [0.65, 0.12], [1, 0], [0.65, -0.12], [0.65, -0.03], [0, -0.03]])


class _OnFaces(Poly3DCollection):
    """Flat shapes of one colour on the faces of a picture, which are not seen where a face is before them."""

    def __init__(self, picture, polygons, zorder, color):
        super().__init__(polygons, facecolor=color, edgecolor="none", zorder=zorder)
        self.picture, self.middles, self.color = picture, np.array(polygons).mean(axis=1), colors.to_rgba(color)

    def do_3d_projection(self, *renderer):
        self.set_facecolor(np.where(self.picture.hidden(self.middles)[:, None], 0.0, self.color))
        return super().do_3d_projection(*renderer)


class Picture:
    """What the plots of results have drawn on 3D axes together."""

    def __init__(self, axes):
        self.axes, self.parts, self.over, self.limits = axes, [], [], None
        axes.computed_zorder = False  # marks and arrows lie on the faces, not in them
        self.faces = Poly3DCollection([np.zeros((3, 3))], cmap="viridis", zorder=1)
        self.faces.signorini = self

    def add(self, results):
        """Draws the surfaces of more zones, or their next results, in one scale with those that are there."""
        new = [_Part(result) for result in results]
        others = [part for part in self.parts if all(part.contact is not one.contact for one in new)]
        self.parts = others + new
        for drawn in self.over:
            drawn.remove()
        polygons = [polygon for part in self.parts for polygon in part.polygons]
        self.faces.set_verts(polygons)
        self.triangles = np.array([polygon[[0, k, k + 1]] for polygon in polygons for k in range(1, len(polygon) - 1)])
        pressure = np.concatenate([part.pressure for part in self.parts])
        self.faces.set_array(pressure)
        # Zero is in the scale, so that colours of a uniform pressure do not show its rounding.
        self.faces.set_clim(min(pressure.min(), 0.0), max(pressure.max(), 0.0) or 1.0)
        if self.faces not in self.axes.collections:
            self.axes.add_collection3d(self.faces)
            self.axes.figure.colorbar(self.faces, ax=self.axes, label="contact pressure (force per area)", shrink=0.7, pad=0.12)
        edged = len(polygons) <= _EDGED
        self.faces.set(edgecolor=(0, 0, 0, 0.25) if edged else "none", linewidth=0.3, antialiased=edged)
        self._choose()
        self.over = [*self._borders(), *self._arrows(), *self._marks()]
        self._legend()

    def _legend(self):
        """The legend below the axes, in letters of a thirtieth of their height within limits."""
        points = 72 * self.axes.figure.get_figheight() * self.axes.get_position().height
        self.axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.03), ncol=2, fontsize=np.clip(points / 30, *_LETTERS))

    def _choose(self):
        """Chooses the pairs that have marks and arrows, all if they are few, and how large these are."""
        area = sum(part.area for part in self.parts)
        if sum(len(part.state) for part in self.parts) > MARKED:
            for part in self.parts:
                part.marked = np.concatenate([_apart(part.points, np.flatnonzero(part.state == state), np.sqrt(area / MARKED))
                                              for state in STATES])
        marked = max(sum(len(part.marked) for part in self.parts), MARKED // 4)
        for part in self.parts:
            part.apart = np.sqrt(min(area / marked, part.area / max(len(part.marked), 1)))

    def _shapes(self, polygons, zorder, color):
        """Flat shapes on the faces."""
        drawn = _OnFaces(self, polygons, zorder, color)
        self.axes.add_collection3d(drawn)
        return drawn

    def hidden(self, points):
        """Tells which points are behind a face, as the axes are turned now."""
        seen = self.axes.get_proj()
        # As deep as that a point may lie under facets of its own surface.
        step = max(part.apart for part in self.parts) / 4
        depth = [_projected(seen, points + step * axis)[:, 2] for axis in np.eye(3)]
        points = _projected(seen, points)
        points[:, 2] -= np.abs(depth - points[:, 2]).sum(axis=0)
        return _behind(points, _projected(seen, self.triangles))

    def _named(self, label, **named):
        """A line of the legend."""
        return self.axes.plot([], [], [], label=label, **named)[0]

    def _borders(self):
        """Lines between pairs of different states."""
        outlined = [patheffects.Stroke(linewidth=2.5, foreground="black"), patheffects.Normal()]
        for name, color, of in (("edge of contact", "white", lambda state: state > State.OPEN),
                                ("edge of what sticks", "black", lambda state: state == State.STICK)):
            found = [ribbon for part in self.parts for ribbon in part.borders(of)]
            if found:
                yield self._shapes(found, 2, color)
                yield self._named(name, color=color, linewidth=1.5, path_effects=outlined)

    def _arrows(self):
        """Tractions along the surfaces, the longest as long as pairs with an arrow are apart."""
        acting = [part for part in self.parts if part.largest > 0]
        if acting:
            largest, size = max(part.largest for part in acting), min(part.apart / part.largest for part in acting)
            found = [arrow for part in self.parts for arrow in part.arrows(size)]
            yield self._shapes(found, 3, "crimson")
            yield self._named(f"traction along the surface, at most {largest:.3g}", color="crimson", marker=r"$\rightarrow$",
                              markersize=10, linestyle="none")

    def _marks(self):
        """States, by colours and shapes."""
        for state, (name, color, marker) in STATES.items():
            shape = _SHAPES[state]
            if any((part.state == state).any() for part in self.parts):
                # Of each a rim in black, so that it is seen on any colour.
                for size, zorder, filled in ((1.0, 4, "black"), (0.75, 5, color)):
                    yield self._shapes([mark for part in self.parts for mark in part.marks(state, size * shape)], zorder, filled)
                yield self._named(name, color=color, marker=marker, markeredgecolor="black", linestyle="none")


class _Part:
    """A surface with what acts on it."""

    def __init__(self, result):
        contact = result.contact
        fields, at = contact.fields(result), contact.coordinates
        self.contact, self.node_state = contact, fields.state
        self.flat = [face[part] for face in contact.drawn_faces for part in _PARTS[len(face)]]
        self.polygons = [at[face] for face in self.flat]
        self.pressure = self._over(np.add, fields.pressure) / np.array([len(face) for face in self.flat])
        self.state, self.points, self.area = result.state, contact.points, contact.areas.sum()
        frames = frames_of(contact.normals, contact.tangents) if result.frames is None else result.frames
        self.axes, self.traction = frames[:, 1:], result.F[:, 1:] / contact.areas[:, None]
        self.largest = np.linalg.norm(self.traction, axis=1).max(initial=0.0)
        self.marked, self.apart = np.arange(contact.pairs), 0.0

    def _over(self, of, values):
        """A sum or another number of each flat part, of values of its nodes."""
        starts = np.cumsum([0, *map(len, self.flat)])[:-1]
        return of.reduceat(values[np.concatenate(self.flat)], starts)

    def marks(self, state, shape):
        """The shape at the marked pairs of a state."""
        of = self.marked[self.state[self.marked] == state]
        size = np.sqrt(_MARKS) * self.apart
        return self.points[of, None] + size * np.einsum("ck,pki->pci", shape, self.axes[of])

    def arrows(self, size):
        """Arrows of the tractions of marked pairs."""
        of = self.marked[self.traction[self.marked].any(axis=1)]
        along = self.traction[of] * size
        both = np.stack([along, np.column_stack([-along[:, 1], along[:, 0]])], axis=1)
        return self.points[of, None] + np.einsum("ck,pkj,pji->pci", _ARROW, both, self.axes[of])

    def borders(self, of):
        """Ribbons between nodes of which a condition on states is true and false, along the borders of their parts of faces."""
        inside = of(self.node_state)
        begins, ends, across = [], [], []
        for part in np.flatnonzero(self._over(np.logical_or, inside) & ~self._over(np.logical_and, inside)):
            face, polygon = self.flat[part], self.polygons[part]
            beside = np.roll(np.arange(len(face)), -1)
            cut = inside[face] != inside[face[beside]]
            middle = polygon.mean(axis=0)
            normal = np.cross(polygon[1] - polygon[0], polygon[-1] - polygon[0])
            for corner in np.flatnonzero(cut):
                begins.append((polygon[corner] + polygon[beside[corner]]) / 2)
                ends.append(middle)
                across.append(np.cross(normal, ends[-1] - begins[-1]))
        if not begins:
            return []
        begins, ends, across = np.array(begins), np.array(ends), np.array(across)
        length = np.linalg.norm(ends - begins, axis=1).sum()
        wide = min(_BORDERS * self.area / length, _WIDE * np.sqrt(self.area))
        if wide < _THIN * np.sqrt(self.area):
            return []
        across *= wide / 2 / np.linalg.norm(across, axis=1, keepdims=True)
        return np.stack([begins - across, begins + across, ends + across, ends - across], axis=1)


def _apart(points, of, distance):
    """Numbers of points, of some, that are no nearer to each other than a distance."""
    kept = []
    while len(of):
        kept.append(of[0])
        of = of[np.linalg.norm(points[of] - points[of[0]], axis=1) >= distance]
    return np.array(kept, np.int64)


def _projected(seen, points):
    """Places on the picture, and depths, by a projection (4, 4)."""
    found = points @ seen[:, :3].T + seen[:, 3]
    return found[..., :3] / found[..., 3:]


def _behind(points, triangles):
    """Tells which points on a picture, with their depths, have one of triangles before them."""
    hidden = np.zeros(len(points), bool)
    order = points[:, 0].argsort()
    low, high = (np.searchsorted(points[order, 0], ends(triangles[..., 0], axis=1)) for ends in (np.min, np.max))
    count = high - low
    of = np.repeat(np.arange(len(triangles)), count)
    point = order[np.arange(len(of)) - np.repeat(np.cumsum(count) - count - low, count)]
    a, b, c = np.moveaxis(triangles[of], 1, 0)
    b, c, p = b - a, c - a, points[point] - a
    size = b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):  # triangles that are seen from their side
        to_b = (p[:, 0] * c[:, 1] - p[:, 1] * c[:, 0]) / size
        to_c = (b[:, 0] * p[:, 1] - b[:, 1] * p[:, 0]) / size
        inside = (to_b >= 0) & (to_c >= 0) & (to_b + to_c <= 1)
        hidden[point[inside & (to_b * b[:, 2] + to_c * c[:, 2] < p[:, 2])]] = True
    return hidden
