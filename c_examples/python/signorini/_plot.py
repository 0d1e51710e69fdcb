"""Pictures of a result, by matplotlib, which is imported when one is drawn."""

import numpy as np

from ._arrays import reals
from ._constants import State

COLOURS = {State.OPEN: "0.6", State.SLIP: "tab:orange", State.STICK: "tab:blue"}
_MISSING = "a picture needs matplotlib: pip install matplotlib (Debian: python3-matplotlib)"


def plot(result, axes, at):
    """The picture of Result.plot: axes."""
    try:
        import matplotlib.pyplot as pyplot
    except ImportError:
        raise ImportError(_MISSING) from None
    pairs, dim = result.F.shape
    if at is not None:
        at = reals("at", at)
        if at.shape != (pairs, dim):
            raise ValueError(f"at has the shape {at.shape}: give the place of each pair, shape {(pairs, dim)}")
    if not pairs:
        raise ValueError("the result has no pairs: there is nothing to draw")
    whole = at is None and hasattr(result.contact, "slave_faces")
    space = dim == 3 and (whole or at is not None)
    if axes is not None and (axes.name == "3d") != space:
        wanted = 'add_subplot(projection="3d")' if space else "add_subplot()"
        raise ValueError(f"axes are of another dimension than the picture: make them by {wanted}, or leave them out")
    if axes is None:
        axes = pyplot.figure(layout="constrained").add_subplot(projection="3d" if space else None)
    if whole:
        (_surface if dim == 3 else _line)(result, axes)
    elif at is None:
        _curves(result, axes, np.arange(1.0, pairs + 1), "pair", "force", result.F)
    elif dim == 3:
        _dots(result, axes, at)
    else:
        _curves(result, axes, _along(at), "along the contact", "force", result.F)
    return axes


def _curves(result, axes, x, x_label, y_label, values, parts=None):
    """Normal and tangential values over x, with the states as colours; curves end where a part does."""
    order = np.argsort(x, kind="stable")
    parts = np.zeros(len(x)) if parts is None else parts
    ends = np.flatnonzero(np.diff(parts[order])) + 1
    tangential = values[:, 1] if values.shape[1] == 2 else np.hypot(values[:, 1], values[:, 2])
    for numbers, style, name in ((-values[:, 0], "-", "normal, pressed"), (tangential, "--", "tangential")):
        drawn = (np.insert(ordered[order], ends, np.nan) for ordered in (x, numbers))
        axes.plot(*drawn, style, color="0.3", linewidth=1, label=name, zorder=1)
    for state, colour in COLOURS.items():
        of = result.state == state
        if of.any():
            axes.scatter(x[of], -values[of, 0], color=colour, s=18, label=state.name.lower(), zorder=2)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.legend()


def _line(result, axes):
    """In 2D: pressure and traction of the pairs over the arc of the slave's surface."""
    contact = result.contact
    arc = _arcs(contact)
    x, parts = np.array([arc[node] for node in contact.nodes.tolist()]).T
    _curves(result, axes, x, "along the slave's surface", "force / area", result.F / contact.areas[:, None], parts)


def _arcs(contact):
    """Length of the way along the lines of the slave to each of their nodes, and the number of the chain of lines."""
    at, onward, ends = contact.coordinates, {}, set()
    for face in contact.drawn_faces:
        nodes = [int(node) for node in face]
        nodes = nodes if len(nodes) == 2 else [nodes[0], nodes[2], nodes[1]]
        onward.update(zip(nodes, nodes[1:]))
        ends.update(nodes[1:])
    arc, length = {}, 0.0
    # Chains from their first nodes; what is left are closed ones, from any.
    for chain, node in enumerate([*(first for first in onward if first not in ends), *onward]):
        while node not in arc:
            arc[node] = length, chain
            if node not in onward:
                break
            length += float(np.linalg.norm(at[onward[node]] - at[node]))
            node = onward[node]
    return arc


def _surface(result, axes):
    """In 3D: pressure on the slave's faces, and tangential tractions as arrows."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    contact = result.contact
    fields = contact.fields(result)
    faces = [face[:3 if len(face) in (3, 6) else 4] for face in contact.drawn_faces]
    pressure = np.array([fields.pressure[face].mean() for face in faces])
    before = _limits(axes)
    drawn = Poly3DCollection([contact.coordinates[face] for face in faces], cmap="viridis",
                             edgecolor="0.5", linewidth=0.3, alpha=0.9)
    drawn.set_array(pressure)
    drawn.set_zorder(1)
    axes.computed_zorder = False  # arrows and dots lie on the faces, not in them
    axes.add_collection3d(drawn)
    axes.figure.colorbar(drawn, ax=axes, label="pressure, force / area", shrink=0.7, pad=0.12)
    _arrows(axes, contact, result)
    _legend(axes, result, contact.points)
    _frame(axes, np.vstack([before, contact.coordinates[np.unique(np.concatenate(faces))]]))


def _arrows(axes, contact, result):
    """Tangential tractions of the pairs as arrows, the longest a tenth of the picture."""
    second = np.cross(contact.normals, contact.tangents)
    traction = (result.F[:, 1:2] * contact.tangents + result.F[:, 2:3] * second) / contact.areas[:, None]
    largest = np.linalg.norm(traction, axis=1).max(initial=0.0)
    if largest > 0:
        size = 0.1 * np.ptp(contact.points, axis=0).max()
        axes.quiver(*contact.points.T, *(traction * size / largest).T, color="crimson", linewidth=1.2, zorder=2,
                    label="traction along the surface")


def _dots(result, axes, at):
    """In 3D without faces: normal forces as colours at given places."""
    before = _limits(axes)
    drawn = axes.scatter(*at.T, c=-result.F[:, 0], cmap="viridis", depthshade=False)
    axes.figure.colorbar(drawn, ax=axes, label="normal force, pressed", shrink=0.7, pad=0.12)
    _frame(axes, np.vstack([before, at]))


def _legend(axes, result, at):
    for state, colour in COLOURS.items():
        of = result.state == state
        if of.any():
            axes.scatter(*at[of].T, color=colour, s=14, depthshade=False, zorder=3,
                         label=state.name.lower())
    axes.legend(loc="upper left")


def _limits(axes):
    """The corners of what axes show; none of empty ones."""
    limits = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()]).T
    return limits if axes.has_data() else np.empty((0, 3))


def _frame(axes, at):
    """Limits that show all points, in one scale."""
    low, high = at.min(axis=0), at.max(axis=0)
    middle, half = (low + high) / 2, max((high - low).max(), 1e-300) / 2
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half),
             zlim=(middle[2] - half, middle[2] + half), xlabel="x", ylabel="y", zlabel="z")


def _along(at):
    """Places on the line in which points spread most."""
    centred = at - at.mean(axis=0)
    return centred @ np.linalg.svd(centred, full_matrices=False)[2][0]
