"""Pictures of a result, by matplotlib, which is imported when one is drawn."""

import numpy as np

from ._arrays import reals
from ._constants import State

# Of each state: name, colour and marker. Of more pairs than so many, about, some have a mark.
STATES = {State.OPEN: ("open", "0.6", "o"), State.SLIP: ("slips", "tab:orange", "^"), State.STICK: ("sticks", "white", "s")}
MARKED = 100
_FORCES = "signorini: forces"
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
    zones = getattr(result.contact, "contacts", None)
    whole = at is None and (zones or hasattr(result.contact, "slave_faces"))
    space = dim == 3 and (whole or at is not None)
    if axes is not None and (axes.name == "3d") != space:
        wanted = 'add_subplot(projection="3d")' if space else "add_subplot()"
        raise ValueError(f"axes are of another dimension than the picture: make them by {wanted}, or leave them out")
    if axes is None:
        axes = pyplot.figure(layout="constrained").add_subplot(projection="3d" if space else None)
    if whole:
        (_surfaces if dim == 3 else _lines)({name: result.zone(name) for name in zones} if zones else {"": result}, axes)
    elif dim == 3 and at is not None:
        _dots(result, axes, at)
    else:
        x, name = (np.arange(1.0, pairs + 1), "number of the pair") if at is None else (_along(at), "along the contact")
        _curves(axes, x, result.F, result.state, (name, "force", "pressing force", "force along the surface"))
    return axes


def _curves(axes, x, values, states, names, parts=None):
    """Normal and tangential values over x, with the states as marks; curves end where a part does."""
    parts = np.zeros(len(x)) if parts is None else parts
    order = np.lexsort((x, parts))
    ends = np.flatnonzero(np.diff(parts[order])) + 1
    tangential = values[:, 1] if values.shape[1] == 2 else np.hypot(values[:, 1], values[:, 2])
    *labels, normal_name, tangential_name = names
    for numbers, style, name in ((-values[:, 0], "-", normal_name), (tangential, "--", tangential_name)):
        drawn = (np.insert(ordered[order], ends, np.nan) for ordered in (x, numbers))
        axes.plot(*drawn, style, color="0.3", linewidth=1, label=name, zorder=1)
    marked = _marked(states[order], parts[order])
    for state, (name, color, marker) in STATES.items():
        of = order[marked & (states[order] == state)]
        if len(of):
            axes.scatter(x[of], -values[of, 0], color=color, marker=marker, s=18, edgecolor="0.3", linewidth=0.5, label=name,
                         zorder=2)
    axes.set(**dict(zip(("xlabel", "ylabel"), labels)))
    handles, named = axes.get_legend_handles_labels()
    axes.legend(*zip(*dict(zip(named, zip(handles, named))).values()))


def _marked(states, parts):
    """Tells which pairs in a row have a mark: all if they are few, else some, and the ends of those of one state if these are few."""
    count = len(states)
    marked = np.arange(count) % -(-count // MARKED) == 0
    ends = np.diff(states + len(State) * np.unique(parts, return_inverse=True)[1]) != 0
    if ends.sum() <= MARKED:
        marked |= np.append(ends, True) | np.append(True, ends)
    return marked


def _lines(parts, axes):
    """In 2D: pressure and traction of the pairs over the arc of the slave's surface, of zones one after the other."""
    x, values, states, chains, start, between = [], [], [], [], 0.0, []
    for number, (name, part) in enumerate(parts.items()):
        contact, arc = part.contact, _arcs(part.contact)
        along = np.array([arc[node] for node in contact.nodes.tolist()]).reshape(-1, 2)
        end = start + max(length for length, _ in arc.values())
        between.append(start)
        x.append(start + along[:, 0])
        values.append(part.F / contact.areas[:, None])
        states.append(part.state)
        chains.append(number + along[:, 1] / len(arc))
        axes.text((start + end) / 2, 1, name, transform=axes.get_xaxis_transform(), ha="center", va="bottom")
        start = end
    where = "along the slave's surface" if len(parts) == 1 else "along the slaves' surfaces, zone after zone"
    names = (f"{where} (length)", "force per area", "pressure", "traction along the surface")
    _curves(axes, *map(np.concatenate, (x, values, states)), names, np.concatenate(chains))
    for place in between[1:]:
        axes.axvline(place, color="0.8", linewidth=0.8, zorder=0)


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


def _surfaces(parts, axes):
    """In 3D: pressure on the slaves' faces, with tangential tractions and states."""
    from ._pressure import Picture

    pictures = (drawn.signorini for drawn in axes.collections if hasattr(drawn, "signorini"))
    picture = next(pictures, None) or Picture(axes)
    # Limits that are not of this picture are of other things on the axes.
    if picture.limits is not None and (_limits(axes) == picture.limits).all():
        others = np.empty((0, 3))
    else:
        others = _limits(axes)
    picture.add(parts.values())
    _frame(axes, np.vstack([others, *(polygon for part in picture.parts for polygon in part.polygons)]))
    picture.limits = _limits(axes)


def _dots(result, axes, at):
    """In 3D without faces: normal forces as colours at given places."""
    before = _limits(axes)
    # Forces on axes have one scale, as pressures do.
    others = [drawn for drawn in axes.collections if drawn.get_gid() == _FORCES]
    drawn = axes.scatter(*at.T, c=-result.F[:, 0], cmap="viridis", depthshade=False, gid=_FORCES)
    forces = np.concatenate([one.get_array() for one in (*others, drawn)])
    if others:
        drawn.set_norm(others[0].norm)
    else:
        axes.figure.colorbar(drawn, ax=axes, label="pressing force", shrink=0.7, pad=0.12)
    drawn.set_clim(min(forces.min(), 0.0), max(forces.max(), 0.0))
    _frame(axes, np.vstack([before, at]))


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
