"""Types of *MPC, for small motions."""

import numpy as np

AXES, DIRECTIONS = range(3), range(6)


def mpc(kind, nodes, place, number):
    """The equations of a card's line. place: a function of a node, its place (3,).  number: of node and direction, a
    dof number, or None if the node has no such direction."""
    kind = kind.upper()
    if kind not in KINDS:
        raise ValueError(f"the type {kind} is not read: write it as *EQUATION, for small motions; types of *MPC that are read are "
                         f"{', '.join(sorted(KINDS))}")
    made, count = KINDS[kind]
    if len(nodes) != count:
        raise ValueError(f"{kind} has {len(nodes)} nodes, it must have {count}")
    return made([_Node(node, place, number) for node in nodes])


class _Node:
    """A node of a line; dof: of its six directions, numbers or None."""

    def __init__(self, name, place, number):
        self.name, self._place = name, place
        self.dof = [number(name, direction + 1) for direction in DIRECTIONS]

    @property
    def place(self):
        try:
            return np.asarray(self._place(self.name), float)
        except KeyError:
            raise ValueError(f"node {self.name} has no place: give coordinates, or *NODE cards before") from None


def _equation(dependent, terms):
    """One equation, of terms (dof number, coefficient) those of a direction that is and is not multiplied by 0."""
    if dependent is None:
        raise ValueError("the first node lacks the direction that depends on the others: give a number that knows it")
    terms = [(dof, factor) for dof, factor in terms if dof is not None and factor != 0]
    return dependent, [dof for dof, _ in terms], [float(factor) for _, factor in terms]


def _same(first, other, directions):
    return [_equation(first.dof[k], [(other.dof[k], 1)])
            for k in directions if first.dof[k] is not None and other.dof[k] is not None]


def _pin(nodes):
    return _same(*nodes, AXES)


def _tie(nodes):
    return _same(*nodes, DIRECTIONS)


def _beam(nodes):
    """A rigid beam from the second node, which turns, to the first."""
    first, other = nodes
    x, y, z = first.place - other.place
    turns = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
    needed = [3 + k for k in AXES for i in AXES if turns[i, k] != 0 and first.dof[i] is not None]
    if any(other.dof[k] is None for k in needed):
        raise ValueError(f"BEAM needs the rotations of node {other.name}: give a number that knows its directions 4 to 6")
    moved = [_equation(first.dof[i], [(other.dof[i], 1), *zip(other.dof[3:], turns[i])])
             for i in AXES if first.dof[i] is not None]
    return moved + _same(first, other, DIRECTIONS[3:])


def _along(start, end):
    """From one node to another, and the axis along which that is longest."""
    way = end.place - start.place
    if not way.any():
        raise ValueError(f"nodes {start.name} and {end.name} are at one place")
    return way, int(np.argmax(abs(way)))


def _link(nodes):
    """The distance stays: nothing moves along the line between the nodes."""
    first, other = nodes
    way, longest = _along(other, first)
    share = way / way[longest]
    terms = [(other.dof[k], share[k]) for k in AXES] + [(first.dof[k], -share[k]) for k in AXES if k != longest]
    return [_equation(first.dof[longest], terms)]


def _on_line(nodes):
    """The place of the first node between the others, from 0 to 1, the way between these and its longest axis."""
    first, start, end = nodes
    way, longest = _along(start, end)
    share = (first.place - start.place) @ way / (way @ way)
    off = np.linalg.norm(first.place - start.place - share * way)
    if off > 1e-6 * np.linalg.norm(way):
        raise ValueError(f"node {first.name} is {off:.3g} off the line from node {start.name} to {end.name}")
    return share, way, longest


def _slider(nodes):
    """The first node stays on the line of the others, and may move along it."""
    first, start, end = nodes
    share, way, longest = _on_line(nodes)
    found = []
    for k in AXES:
        if k == longest or first.dof[k] is None:
            continue
        slope = way[k] / way[longest]
        ends = [(node.dof[axis], factor * weight) for node, weight in ((start, 1 - share), (end, share))
                for axis, factor in ((k, 1), (longest, -slope))]
        found.append(_equation(first.dof[k], [(first.dof[longest], slope), *ends]))
    return found


def _linear(nodes):
    first, start, end = nodes
    share, _, _ = _on_line(nodes)
    return [_equation(first.dof[k], [(start.dof[k], 1 - share), (end.dof[k], share)])
            for k in DIRECTIONS if all(node.dof[k] is not None for node in nodes)]


KINDS = {"BEAM": (_beam, 2), "LINK": (_link, 2), "PIN": (_pin, 2), "TIE": (_tie, 2), "SLIDER": (_slider, 3),
         "LINEAR": (_linear, 3)}
