"""Planes of symmetry, sectors and periods that supports and equations show, and true shapes, that a pairing was not told."""

import re
from collections import Counter

import numpy as np

from ._constants import State
from ._equations import ORTHOGONAL
from ._text import tell

AXES = "xyz"
_ALONG = 1e-9  # what is left of a unit normal beside axes
_OF_DIE = 0.3  # rows of an obstacle of finite elements are right if so much of them moves
_NEAR = 1e-6  # of the size of the mesh: places are the same


def warn_of_planes(contact, fixed, name=None):
    """Warns of planes across which supports hold a slave node with a pair and the master node that it faces most.

    All nodes that they hold along an axis, and not along all, stand in the plane, or in the two planes of a slab.
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
        ends = places.min(), places.max()
        # A slab has two, and nodes on them alone.
        if np.minimum(places - ends[0], ends[1] - places).max() > rounding:
            continue
        planes = [0.0 if abs(place) <= rounding else place for place in ends[:2 if ends[1] - ends[0] > rounding else 1]]
        across = " and ".join(f"{AXES[axis]} = {place:g}" for place in planes)
        named = ", ".join(f"({axis}, {place:g})" for place in planes)
        of, plane, are = f"zone {name!r}: " if name else "", "plane", "it is a plane"
        if len(planes) > 1:
            plane, are = "planes", "they are planes"
        tell(f"{of}supports hold both sides across the {plane} {across}: if {are} of symmetry, give symmetry=[{named}] to "
             f"pair_surfaces")


def warn_of_supports(contact, fixed, name=None):
    """Warns of slave nodes with a pair, and a master of its row, that supports hold along its normal, where others of the row are free."""
    fixed = np.asarray(fixed)
    if not len(fixed) or not contact.pairs or contact.is_with_obstacle or contact.knows_supports:
        return
    is_fixed = np.zeros(1 + max(*(dofs.max() for dofs, _ in contact.rows), contact._least), bool)
    is_fixed[fixed[fixed < len(is_fixed)]] = True
    held = is_fixed[contact._dofs_of(contact.nodes)]

    def along(normal, free):
        return np.linalg.norm(np.where(free, normal, 0.0), axis=-1) <= _ALONG
    pairs = np.flatnonzero(along(contact.normals, ~held))
    around, rows = _beside(contact, contact.nodes[pairs]), contact.rows
    slave_dofs = contact._dofs_of(np.unique(np.concatenate([np.ravel(face) for face in contact.slave_faces]))).ravel()
    for pair in pairs:
        normal, (dofs, weights) = contact.normals[pair], rows[pair]
        near = contact._dofs_of(np.array(sorted(around[contact.nodes[pair]])))
        if dofs.ndim == 1:  # by degree of freedom: those along the normal
            parts, is_held = weights @ normal, is_fixed[dofs]
        else:
            parts, is_held = weights, along(normal, ~is_fixed[dofs])
        is_master = ~np.isin(dofs if dofs.ndim == 1 else dofs[:, 0], slave_dofs)
        if not (is_held & is_master).any() or not (parts[~is_held] != 0).any():
            continue
        free = parts[is_master & ~is_held].sum() / parts[is_master].sum()
        if free < _OF_DIE or not along(normal, ~is_fixed[near]).all():
            of = f"zone {name!r}: " if name else ""
            tell(f"{of}supports hold slave node {contact.nodes[pair]} along its normal, and the master beside it: all that is left of "
                 "this pair are masters beside the support, so that its force may be any number: give fixed to pair_surfaces, or pair "
                 "by node_to_surface")
            return


def warn_of_gaps(contact, gap, name=None):
    """Warns of cases with penetrations of their own at pairs that have taken in nodes between supports, which these cannot leave."""
    if not contact.knows_supports or not len(contact.folded) or not contact.pairs:
        return
    place = {node: pair for pair, node in enumerate(contact.nodes.tolist())}
    pairs = np.array([place[home] for home in contact.folded[:, 1].tolist()])
    is_free = ~np.isin(contact._dofs_of(contact.folded[:, 0]), contact._fixed)
    pairs = pairs[np.linalg.norm(np.where(is_free, contact.normals[pairs], 0.0), axis=1) <= _ALONG]
    least = np.minimum(contact._paired_gaps[pairs], -1e-12 * abs(contact.coordinates).max())
    if (gap[..., pairs] < least).any():
        worst = pairs[(gap[..., pairs] - least).reshape(-1, len(pairs)).min(axis=0).argmin()]
        tell((f"zone {name!r}: " if name else "") + f"gap at slave node {contact.nodes[worst]} is {gap[..., worst].min():.3g}, a penetration, "
             "beside supports that hold both sides: these cannot part, so that the pressure beside them is too large: give an interference "
             "by clearance to pair_surfaces, which leaves it out there")


def _beside(contact, nodes):
    """Of each of some nodes those of its slave faces."""
    around = {node: set() for node in nodes.tolist()}
    for face in contact.slave_faces if around else []:
        for node in around.keys() & set(face):
            around[node].update(face)
    return around


def warn_of_nodes_beside(contact, name=None):
    """Warns of slave nodes beside a plane of symmetry that the pairing was told, and not on it, as a direction of few digits
    leaves them."""
    for sentence in re.findall("slave node [^;]* away from plane of symmetry [^;]*", contact.summary):
        tell((f"zone {name!r}: " if name else "") + sentence)


def warn_of_numbers(contact, matrix, name=None):
    """Warns of a K with the rows of nodes that turn as well, where the pairs have the numbers of nodes that do not, and K resists
    a motion of all of these numbers along an axis, as that of no body."""
    each = {2: 3, 3: 6}[contact.dim]
    if not contact._numbers_every_node_alike or len(matrix) != each * contact.node_count:
        return
    dofs = contact._dofs_of(np.arange(contact.node_count))
    for axis in dofs.T:
        unit = np.zeros(len(matrix))
        unit[axis] = 1.0
        resists, has_terms = matrix.resisted(unit)
        if 2 * np.count_nonzero(resists[dofs]) <= np.count_nonzero(has_terms[dofs]):
            return
    of = f"zone {name!r}: " if name else ""
    tell(f"{of}K has {each} rows for each of {contact.node_count} nodes, and the degrees of freedom of the pairs are those of nodes "
         f"that have {contact.dim}: give dofs_per_node={each} to pair_surfaces, or dofs")


def warn_of_facets(contact, name=None):
    """Warns of facets that change the interference or clearance of a case, if its gaps are those of the pairing."""
    for sentence in re.findall("at [^;]* pairs facets [^;]*", contact.summary):
        tell((f"zone {name!r}: " if name else "") + sentence)


def warn_of_overlaps(contact, name=None):
    """Warns of slave faces that overlap a master by more than is looked for, if some are beside pairs: these carry what the others should."""
    overlaps = -contact.beyond_distances
    deep = contact.beyond[overlaps > 0].tolist()
    paired = set(contact.nodes.tolist())
    if all(paired.isdisjoint(contact.slave_faces[face]) for face in deep):
        return
    most = overlaps.max()
    tell((f"zone {name!r}: " if name else "") + f"{len(deep)} slave faces overlap a master by more than is looked for, face "
         f"{contact.beyond[overlaps.argmax()]} by {most:.4g}: they have no pairs, and pairs beside them carry what they should: give a "
         f"search_distance above {most:.4g} to pair_surfaces, or leave these faces out if they are not meant to touch")


def warn_of_slips(contact, d, state, name=None):
    """Warns of pairs that slip by more than their face, as their rows hold what they faced before; of an obstacle they hold nothing."""
    if not contact.pairs or contact.is_with_obstacle:
        return
    slips = np.where(state == State.OPEN, 0.0, np.linalg.norm(d[:, 1:], axis=1))
    lengths = contact.face_lengths[contact.nodes]
    far = slips > lengths
    if far.any():
        worst, of = (slips / lengths).argmax(), f"zone {name!r}: " if name else ""
        tell(f"{of}{np.count_nonzero(far)} pairs slip by more than their faces are long, that of slave node {contact.nodes[worst]} by "
             f"{slips[worst]:.3g}, and its face has {lengths[worst]:.3g}: their rows hold what they faced before, so that this may be no "
             "equilibrium of the moved bodies: take smaller steps, and pair again from the moved coordinates")


def warn_of_repeats(contacts, equations):
    """Warns of pairings without a Sector or Period, by name, a slave node of which is the image of another slave node by equations."""
    if all(contact.is_sector for contact in contacts.values()):
        return
    one, slaves = next(iter(contacts.values())), {}
    for name, contact in contacts.items():
        slaves[name] = np.unique(np.concatenate([np.zeros(0, np.int64), *contact.slave_faces]))
    nodes = np.unique(np.concatenate(list(slaves.values())))
    images = _images(nodes, one._dofs_of(nodes), one.coordinates, equations) if len(nodes) else []
    for name, contact in contacts.items():
        pair = next((pair for pair in images if np.isin(pair, slaves[name]).any()), None)
        if not contact.is_sector and pair:
            of = f"zone {name!r}: " if name else ""
            tell(f"{of}by equations slave node {pair[0]} is the image of slave node {pair[1]}, as in a Sector or a Period, and the pairs "
                 "are not those of one: give sector to pair_surfaces, if the body repeats")


def _images(nodes, dofs, coordinates, equations):
    """Pairs of nodes that stand apart, the displacement of the first of which is that of the second, turned, all by one turn."""
    dim, flat, first_of = dofs.shape[1], dofs.ravel(), {}
    order = flat.argsort()

    def place(numbers):
        at = order[np.minimum(np.searchsorted(flat, numbers, sorter=order), flat.size - 1)]
        return np.where(flat[at] == numbers, at, -1)
    own, terms = place(equations.dependent), place(equations.dofs)
    known = np.repeat(np.arange(len(own)), np.diff(equations.start))[(terms >= 0) & (equations.coefficients != 0)]
    for k in np.unique(known[own[known] >= 0]):
        part = slice(equations.start[k], equations.start[k + 1])
        used = equations.coefficients[part] != 0
        to, (node, axis) = terms[part][used], divmod(own[k], dim)
        others = set((to // dim).tolist())
        if (to >= 0).all() and len(others) == 1 and node not in others:
            turn, axes = first_of.setdefault((node, *others), (np.zeros((dim, dim)), set()))
            turn[axis, to % dim] = equations.coefficients[part][used]
            axes.add(axis)
    whole = {pair: turn for pair, (turn, axes) in first_of.items() if len(axes) == dim}
    uses = Counter(first for _, first in whole)
    near = _NEAR * np.ptp(coordinates, axis=0).max()
    found = {}
    for (node, first), turn in whole.items():
        apart = np.linalg.norm(coordinates[nodes[node]] - coordinates[nodes[first]]) > near
        is_turn = abs(turn.T @ turn - np.eye(dim)).max() <= ORTHOGONAL and np.linalg.det(turn) > 0
        if apart and is_turn and uses[first] == 1:  # a rigid plate moves with one node
            found[nodes[node], nodes[first]] = turn
    turns = list(found.values())
    return list(found) if all(abs(turn - turns[0]).max() <= ORTHOGONAL for turn in turns) else []


def warn_of_rings(contact, matrix, has_equations, name=None):
    """Warns of a plane K with pairs of bodies of revolution, and of a K of whole rings with plane pairs: rings resist to be
    widened, and a plane body without supports does not."""
    if contact.dim > len("xy") or not contact.pairs:
        return
    dofs, radii = contact._dofs_of(np.arange(contact.node_count)), contact.coordinates[:, 0]
    has_row = (dofs < len(matrix)).all(axis=1)
    unit = np.zeros((contact.dim, len(matrix)))
    for axis, u in enumerate(unit):
        u[dofs[has_row, axis]] = 1.0
    (wider, has_terms), (higher, _) = (matrix.resisted(u) for u in unit)
    wider, is_stiff = wider[dofs[has_row, 0]], has_terms[dofs[has_row, 0]] & (radii[has_row] > 0)
    of, resists = f"zone {name!r}: " if name else "", wider[is_stiff]
    if contact.is_of_rings and len(resists) and not wider.any():
        tell(f"{of}K does not resist a motion of all nodes across the axis x = 0, as that of a plane body, and the pairs are those of "
             "bodies of revolution: give K and loads of whole rings, or leave axisymmetric out")
    is_plane = has_equations or contact.is_of_rings or radii.min(initial=0.0) < 0
    if not is_plane and len(resists) and resists.all() and not higher.any():
        tell(f"{of}K resists a motion of all nodes along x in each of them, and none along y, as that of bodies of revolution about "
             "x = 0, and the pairs are plane: give axisymmetric=True to pair_surfaces")
