"""Planes of symmetry that supports show, and that a pairing was not told."""

import numpy as np

from ._text import tell

AXES = "xyz"


def warn_of_planes(contact, fixed, name=None):
    """Warns of planes across which supports hold a slave node with a pair and the master node that it faces most.

    All nodes that they hold along an axis, and not along all, stand in the plane.
    """
    fixed = set(np.asarray(fixed).tolist())
    held = [[] for _ in range(contact.dim)]
    if not fixed or not contact.pairs:
        return
    for node, (dofs, weights) in zip(contact.nodes, contact.rows):
        if dofs.ndim == 1:  # by degree of freedom, those of each node in turn
            dofs = dofs.reshape(-1, contact.dim)
            weights = weights.reshape(-1, contact.dim, contact.dim).trace(axis1=1, axis2=2)
        both = dofs[[weights.argmax(), weights.argmin()]] if weights.min() < 0 else []
        across = [axis for axis in range(contact.dim) if len(both) and all(pair[axis] in fixed for pair in both)]
        for axis in across if len(across) < contact.dim else []:
            held[axis].append(node)
    for axis, nodes in enumerate(held):
        if not nodes or axis in contact.symmetry_axes:
            continue
        places = contact.coordinates[nodes, axis]
        rounding = 1e-9 * np.ptp(contact.coordinates, axis=0).max()
        if np.ptp(places) <= rounding:
            of = f"zone {name!r}: " if name else ""
            place = 0.0 if abs(places[0]) <= rounding else places[0]
            tell(f"{of}supports hold both sides across the plane {AXES[axis]} = {place:g}: if it is a plane of symmetry, give "
                 f"symmetry=[({axis}, {place:g})] to pair_surfaces")
