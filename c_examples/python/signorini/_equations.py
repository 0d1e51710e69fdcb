"""Equations between degrees of freedom: for the library, of turned axes and rigid bodies, and from decks."""

import ctypes
from math import isfinite

import numpy as np

from ._arrays import at, doubles, fit, indices, integers, reals
from ._mpc import mpc
from ._structures import EquationList, sized


_OF_THE_MODEL = "give coordinates, along the axes of the model"
_TURNED = 7  # numbers of an *INSTANCE that turns its part: two points of an axis, and an angle
_NEAR = 1e-6  # of the size of a section: nodes are at one place
ORTHOGONAL = 1e-3  # axes are orthogonal unit vectors to this: decks have few digits


class Equations:
    """A list of equations; structure: signorini_equations."""

    def __init__(self, equations):
        asked = "give (dependent, dofs, coefficients) for each: a dof number, and as many numbers as dofs"
        try:
            parts = [(dependent, dofs, coefficients) for dependent, dofs, coefficients in equations]
        except (TypeError, ValueError):
            raise ValueError(f"equations is no list of equations: {asked}") from None
        dependent, terms, factors = [], [], []
        for k, (of, dofs, coefficients) in enumerate(parts):
            of, dofs = (integers(f"equations[{k}]", numbers) for numbers in (of, dofs))
            coefficients = reals(f"equations[{k}]", coefficients)
            if of.ndim or dofs.ndim != 1 or coefficients.shape != dofs.shape:
                raise ValueError(f"equations[{k}] has the shapes {of.shape}, {dofs.shape} and "
                                 f"{coefficients.shape}: {asked}")
            dependent.append(int(of))
            terms.append(np.asarray(dofs, np.int64))
            factors.append(np.asarray(coefficients, np.float64))
        self.dependent = indices(np.array(dependent, np.int64))
        self.start = indices(np.cumsum([0, *map(len, terms)]))
        self.dofs = indices(np.concatenate([np.zeros(0, np.int64), *terms]))
        self.coefficients = doubles(np.concatenate([np.zeros(0), *factors]))
        self.structure = sized(
            EquationList, count=len(parts), dependent=at(self.dependent), start=at(self.start),
            dofs=at(self.dofs), coefficients=at(self.coefficients))
        self.address = ctypes.addressof(self.structure)

    def given(self):
        """The list of which they were made."""
        ends = zip(self.start, self.start[1:])
        return [(int(of), self.dofs[begin:end], self.coefficients[begin:end])
                for of, (begin, end) in zip(self.dependent, ends)]

    def held(self, fixed):
        """fixed, and the degrees of freedom that depend on no others than these, ascending."""
        known, places = np.unique(np.concatenate([self.dependent, self.dofs]), return_inverse=True)
        dependent, dofs = np.split(places, [len(self.dependent)])
        is_held, rows = np.isin(known, fixed), np.repeat(np.arange(len(dependent)), np.diff(self.start))
        while True:  # dependents may depend on others, in no circle
            free = np.bincount(rows, ~is_held[dofs] & (self.coefficients != 0), len(dependent))
            if is_held[dependent[free == 0]].all():
                return np.union1d(fixed, known[is_held])
            is_held[dependent[free == 0]] = True

    def extended(self, u, enough=None):
        """u, and behind its end what the equations give to those that depend on it; so many entries are enough, None: all.

        The work is that of the equations, whatever their numbers.
        """
        size = 1 + int(max(len(u) - 1, self.dependent.max(initial=-1), self.dofs.max(initial=-1)))
        size = size if enough is None else max(len(u), min(size, enough))
        known, places = np.unique(np.concatenate([self.dependent, self.dofs]), return_inverse=True)
        dependent, dofs = np.split(places, [len(self.dependent)])
        found, has_row = np.zeros(len(known)), known < len(u)
        found[has_row] = u[known[has_row]]
        beyond, rows = ~has_row[dependent], np.repeat(np.arange(len(dependent)), np.diff(self.start))
        while True:  # dependents may depend on others, in no circle
            sums = np.bincount(rows, self.coefficients * found[dofs], len(dependent))
            if np.array_equal(found[dependent[beyond]], sums[beyond], equal_nan=True):
                break
            found[dependent[beyond]] = sums[beyond]
        whole = np.concatenate([u, np.zeros(size - len(u))])
        asked = known < size
        whole[known[asked]] = found[asked]
        return whole

    def gathered(self, forces):
        """Forces on all degrees of freedom, with those on dependents as forces on what these depend on."""
        known, places = np.unique(np.concatenate([self.dependent, self.dofs]), return_inverse=True)
        dependent, dofs = np.split(places, [len(self.dependent)])
        found, has_row = np.zeros(len(known)), known < len(forces)
        found[has_row] = forces[known[has_row]]
        rows = np.repeat(np.arange(len(dependent)), np.diff(self.start))
        while found[dependent].any():  # dependents may depend on others, in no circle
            moved = found[dependent]
            found[dependent] = 0.0
            found += np.bincount(dofs, self.coefficients * moved[rows], len(known))
        whole = np.array(forces)
        whole[known[has_row]] = found[has_row]
        return whole


def turned_equations(dofs, own, turn):
    """Equations u = turn @ u' of nodes: turned axes, and images of a cyclic sector.

    dofs: those that follow, (n, D).  own: those of u', (n, D): of the same nodes in their own axes, or of the
    nodes whose images they are.  turn: (D, D), or (n, D, D); its columns are the own axes, orthogonal unit vectors, of
    which the nearest exact ones are taken.
    """
    dofs, own = nodal_dofs("dofs", dofs), nodal_dofs("own", own)
    count, dim = dofs.shape
    if own.shape != dofs.shape:
        raise ValueError(f"own has the shape {own.shape}: give as many as dofs, shape {dofs.shape}")
    turn = np.broadcast_to(reals("turn", turn), (count, dim, dim))
    off = abs(turn.swapaxes(1, 2) @ turn - np.eye(dim)).max(axis=(1, 2), initial=0.0)
    if not (off < ORTHOGONAL).all():
        raise ValueError(f"turn of node {off.argmax()} is no rotation: give orthogonal unit vectors as its columns, with more "
                         f"digits, as products of columns are off by {off.max():.1e}")
    # Newton's iteration towards the nearest orthogonal axes: each step squares the error, the last one below rounding. Zeros stay.
    for _ in range(3):
        turn = turn @ (3.0 * np.eye(dim) - turn.swapaxes(1, 2) @ turn) / 2.0
    return [(int(dofs[i, axis]), own[i], turn[i, axis]) for i in range(count) for axis in range(dim)]


def section_equations(dofs, opposite, shortening, axis, coordinates=None):
    """Equations of a section through a body, as of a bolt, with its shortening as one more unknown.

    The body is meshed in two, with two nodes at each place of the section: u[dofs] = u[opposite] - axis u[shortening].
    dofs, opposite: of the nodes on its two sides, (n, D).  shortening: the dof number of the unknown, a further row of
    K without entries. Its load is the force of the section, positive if it pulls; fixed, its value is the shortening.
    axis: the direction from the side of opposite to that of dofs, of any length, (D,).
    coordinates: places of the nodes of both sides, of dofs and of opposite, two of (n, D): nodes of opposite may stand in any
    order then, and each side must have one at each place of the other; None: nodes of both stand in one order.
    """
    dofs, opposite = nodal_dofs("dofs", dofs), nodal_dofs("opposite", opposite)
    count, dim = dofs.shape
    if opposite.shape != dofs.shape:
        raise ValueError(f"opposite has the shape {opposite.shape}: give as many as dofs, shape {dofs.shape}")
    if coordinates is not None:
        opposite = opposite[_across(coordinates, dofs.shape)]
    axis = fit("axis", axis, [(dim,)], f"a direction, shape {(dim,)}")
    if not 0 < np.linalg.norm(axis) < np.inf:
        raise ValueError(f"axis is {axis}: give the direction across the section")
    axis = axis / np.linalg.norm(axis)
    return [(int(dofs[i, c]), [int(opposite[i, c]), int(shortening)], [1.0, -axis[c]])
            for i in range(count) for c in range(dim)]


def _across(coordinates, shape):
    """For each node of a section's side that on the other side, at the same place."""
    asked = f"the places of the nodes of dofs and of opposite, two arrays of shape {shape}"
    try:
        own, others = (fit(f"coordinates[{side}]", places, [shape], asked) for side, places in enumerate(coordinates))
    except TypeError:
        raise TypeError(f"coordinates is a {type(coordinates).__name__}: give {asked}") from None
    near, found = _NEAR * np.ptp(own, axis=0).max(initial=0.0), []
    for node, place in enumerate(own):
        away = np.linalg.norm(others - place, axis=1)
        found.append(int(away.argmin()))
        if not away[found[-1]] <= near:
            raise ValueError(f"no node of opposite is at the place of node {node} of dofs, {place}, the nearest, {found[-1]}, is "
                             f"{away.min():.1e} away: give the nodes of both sides of one section, which must match")
    if len(set(found)) < len(found):
        raise ValueError("two nodes of dofs are at the place of one of opposite: give each node of the section once")
    return found


def rigid_equations(dofs, coordinates, reference, motion):
    """Equations of the nodes of a rigid body, u = U + theta x (place - reference).

    dofs: of the nodes, (n, D).  coordinates: their places, (n, D).  reference: the place of U, (D,).  motion: the
    dof numbers of U and theta, 6, in the plane 3.
    """
    dofs = nodal_dofs("dofs", dofs)
    count, dim = dofs.shape
    arms = fit("coordinates", coordinates, [(count, dim)], f"one place for each node, shape {(count, dim)}")
    arms = arms - fit("reference", reference, [(dim,)], f"a place, shape {(dim,)}")
    motion, size = integers("motion", motion), 3 * (dim - 1)
    if motion.shape != (size,):
        raise ValueError(f"motion has the shape {motion.shape}: give the dof numbers of U and theta, shape {(size,)}")
    found = []
    for numbers, arm in zip(dofs, arms):
        if dim == 2:
            turns = np.array([[-arm[1]], [arm[0]]])
        else:
            x, y, z = arm
            turns = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
        for axis in range(dim):
            moves = np.concatenate([np.eye(dim)[axis], turns[axis]])
            found.append((int(numbers[axis]), motion, moves))
    return found


def read_equations(path, number=None, coordinates=None):
    """The equations of the *EQUATION and *MPC cards of a deck of CalculiX or Abaqus.

    The first term of each *EQUATION is dependent, and the first node of each *MPC: BEAM, LINK, LINEAR, PIN, SLIDER and
    TIE, for small motions. Other types are refused by name: write them as *EQUATION.
    number: a function of node and direction, both as in the deck, that gives a dof number, or None if the node has no
    such direction; None: 3 * (node - 1) + direction - 1, without rotations.  coordinates: a dict of nodes and their
    places; None: the *NODE cards of the deck. Nodes are numbers: sets of nodes, cards with options, *INCLUDE, *TRANSFORM and
    a number in two *PARTs are refused, and without coordinates *NODE, SYSTEM=C or S, *SYSTEM, *NMAP and turned *INSTANCEs.
    BEAM is that of Abaqus, which turns with its node: what CalculiX calls so keeps a distance, as LINK.
    """
    cards, begun, place = _Cards(path, number or _solid, coordinates), "", 0
    with open(path, encoding="utf-8-sig", errors="replace") as deck:
        for place, line in enumerate(map(str.strip, deck), 1):
            if "\0" in line:
                cards.fail(place, "a NUL character, as a deck in UTF-16 has them: save it as UTF-8 or ASCII")
            if not line or line.startswith("**"):
                continue
            # A card that ends with a comma goes on, but with no number.
            if begun and not line.startswith("*") and not line[0].isdigit():
                line = f"{begun} {line}"
            elif begun:
                cards.line(place, begun, _words(begun))
            begun = line if line.startswith("*") and line.endswith(",") else ""
            if not begun:
                cards.line(place, line, _words(line))
    if begun:
        cards.line(place, begun, _words(begun))
    return cards.end()


def _words(line):
    return [word.strip() for word in line.split(",")]


def _solid(node, direction):
    return 3 * (node - 1) + direction - 1 if 1 <= direction <= 3 else None


class _Cards:
    """Cards of a deck, as they are read."""

    def __init__(self, path, number, coordinates):
        self.path, self.number = path, number
        self.places = {} if coordinates is None else coordinates
        self.reads_places = coordinates is None
        self.found, self.left, self.terms, self.card = [], 0, [], ""
        self.open = None  # the place and the words of the *MPC whose nodes may go on
        self.part, self.parts = "", {}  # the *PART of these lines, and that of each node

    def fail(self, place, what):
        raise ValueError(f"{self.path}, line {place}: {what}") from None

    def line(self, place, line, words):
        if line.startswith("*"):
            self.close()
            if self.left:
                self.fail(place, f"{self.left} terms of the equation before are missing")
            self.card = words[0].upper().replace(" ", "")
            if self.card in ("*EQUATION", "*MPC") and any(words[1:]):
                self.fail(place, f"{line}: a card with {words[1]} is not read")
            if self.card == "*TRANSFORM":
                self.fail(place, f"{line}: axes of nodes are not turned: give their equations along the axes of the model, and "
                                 "leave the card out")
            if self.card == "*INCLUDE":
                self.fail(place, f"{line}: the file is not read: put its lines in this place, or read it by itself")
            if self.card in ("*PART", "*ENDPART"):
                self.part = line if self.card == "*PART" else ""
            self.moved(place, line, words)
        elif self.card == "*EQUATION":
            self.equation(place, line, words)
        elif self.card == "*MPC":
            self.mpc(place, line, words)
        elif self.card == "*NODE":
            self.node(place, line, words)
        elif self.card == "*SYSTEM" and self.reads_places:
            self.fail(place, f"*SYSTEM: {line}: places in a system of their own are not read: {_OF_THE_MODEL}")
        elif self.card == "*INSTANCE" and self.reads_places and len(words) >= _TURNED:
            self.fail(place, f"*INSTANCE: {line}: places of a turned part are not read: {_OF_THE_MODEL}")

    def moved(self, place, line, words):
        """Refuses cards with which numbers of *NODE are no coordinates along the axes of the model."""
        options = [word.upper().replace(" ", "") for word in words[1:]]
        turned = [word for word in options if word.startswith("SYSTEM=") and word[len("SYSTEM="):][:1] != "R"]
        if self.reads_places and (self.card == "*NODE" and turned or self.card == "*NMAP"):
            self.fail(place, f"{line}: places in a system of their own are not read: {_OF_THE_MODEL}")

    def node(self, place, line, words):
        try:
            node, at = int(words[0]), [_real(word) if word else 0.0 for word in (words[1:4] + ["", ""])[:3]]
        except ValueError:
            if self.reads_places:
                self.fail(place, f"{line}: this is no node with its coordinates")
            return
        if self.parts.setdefault(node, self.part) != self.part:
            self.fail(place, f"{line}: node {node} is in {self.parts[node] or 'the deck before'} too, and equations do not tell "
                             "which is meant: give nodes of all parts numbers of their own, as a flat deck has them")
        if self.reads_places:
            self.places[node] = at

    def mpc(self, place, line, words):
        words = [word for word in words if word]
        if words[0] == "0" and self.open:  # a line that goes on
            self.open[1].append(line)
            self.open[2].extend(words[1:])
            return
        self.close()
        self.open = place, [line], words

    def close(self):
        """Reads an *MPC of which all lines are known."""
        if not self.open:
            return
        (place, lines, words), self.open = self.open, None
        line = " ".join(lines)
        try:
            nodes = [int(word) for word in words[1:]]
        except ValueError:
            self.fail(place, f"{line}: this is no type with numbers of nodes")
        self.check_nodes(place, line, nodes)
        try:
            self.found += mpc(words[0], nodes, self.places.__getitem__, self.number)
        except ValueError as error:
            self.fail(place, f"{line}: {error}")

    def check_nodes(self, place, line, nodes):
        for node in nodes:
            if node < 1:
                self.fail(place, f"{line}: there is no node {node}, nodes of decks count from 1")

    def equation(self, place, line, words):
        try:
            if not self.left:
                self.left, self.terms = int(words[0]), []
                if self.left < 1:
                    raise ValueError
                return
            words = words[:-1] if words[-1] == "" else words
            terms = [(int(node), int(direction), _real(factor))
                     for node, direction, factor in zip(*[iter(words)] * 3, strict=True)]
        except ValueError:
            self.fail(place, f"{line}: this is no number of terms, or not node, direction, coefficient of each")
        self.check_nodes(place, line, [node for node, _, _ in terms])
        for node, direction, factor in terms:
            dof = self.number(node, direction)
            if dof is None:
                self.fail(place, f"{line}: node {node} has no direction {direction}: give a number that knows it")
            self.terms.append((dof, factor))
            self.left -= 1
        if self.left < 0:
            self.fail(place, "the equation has more terms than was said")
        if not self.left:
            (dependent, first), *others = self.terms
            if not first:
                self.fail(place, "the coefficient of the first term is 0")
            factors = [-factor / first for _, factor in others]
            if not all(map(isfinite, [first, *factors])):
                self.fail(place, "a coefficient, or its part of the first, is beyond the range of numbers")
            self.found.append((dependent, [dof for dof, _ in others], factors))

    def end(self):
        self.close()
        if self.left:
            raise ValueError(f"{self.path}: {self.left} terms of the last equation are missing")
        return self.found


def _real(word):
    return float(word.upper().replace("D", "E"))


def nodal_dofs(name, values):
    values = integers(name, values)
    if values.ndim != 2 or values.shape[1] not in (2, 3):
        raise ValueError(f"{name} has the shape {values.shape}: give the dof numbers of each node, shape (n, D), D 2 or 3")
    return values
