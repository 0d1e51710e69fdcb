"""Equations between degrees of freedom: for the library, of turned axes and rigid bodies, and from decks."""

import ctypes

import numpy as np

from ._arrays import at, doubles, fit, indices, integers, reals
from ._structures import EquationList, sized


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


def turned_equations(dofs, own, turn):
    """Equations u = turn @ u' of nodes: turned axes, and images of a cyclic sector.

    dofs: those that follow, (n, D).  own: those of u', (n, D): of the same nodes in their own axes, or of the
    nodes whose images they are.  turn: (D, D), or (n, D, D); its columns are the own axes.
    """
    dofs, own = _nodes("dofs", dofs), _nodes("own", own)
    count, dim = dofs.shape
    if own.shape != dofs.shape:
        raise ValueError(f"own has the shape {own.shape}: give as many as dofs, shape {dofs.shape}")
    turn = np.broadcast_to(reals("turn", turn), (count, dim, dim))
    return [(int(dofs[i, axis]), own[i], turn[i, axis]) for i in range(count) for axis in range(dim)]


def section_equations(dofs, opposite, shortening, axis):
    """Equations of a section through a body, as of a bolt, with its shortening as one more unknown.

    The body is meshed in two, with two nodes at each place of the section: u[dofs] = u[opposite] - axis u[shortening].
    dofs, opposite: of the nodes on its two sides, (n, D).  shortening: the dof number of the unknown, a further row of
    K without entries. Its load is the force of the section, positive if it pulls; fixed, its value is the shortening.
    axis: the unit vector from the side of opposite to that of dofs, (D,).
    """
    dofs, opposite = _nodes("dofs", dofs), _nodes("opposite", opposite)
    count, dim = dofs.shape
    if opposite.shape != dofs.shape:
        raise ValueError(f"opposite has the shape {opposite.shape}: give as many as dofs, shape {dofs.shape}")
    axis = fit("axis", axis, [(dim,)], f"a unit vector, shape {(dim,)}")
    return [(int(dofs[i, c]), [int(opposite[i, c]), int(shortening)], [1.0, -axis[c]])
            for i in range(count) for c in range(dim)]


def rigid_equations(dofs, coordinates, reference, motion):
    """Equations of the nodes of a rigid body, u = U + theta x (place - reference).

    dofs: of the nodes, (n, D).  coordinates: their places, (n, D).  reference: the place of U, (D,).  motion: the
    dof numbers of U and theta, 6, in the plane 3.
    """
    dofs = _nodes("dofs", dofs)
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


def read_equations(path, number=None):
    """The equations of the *EQUATION cards of a deck of CalculiX or Abaqus; the first term of each is dependent.

    number: a function of node and direction, both as in the deck, that gives a dof number; None:
    3 * (node - 1) + direction - 1. Nodes are numbers: sets of nodes, and cards with REMOVE, are refused.
    """
    number = number or (lambda node, direction: 3 * (node - 1) + direction - 1)
    found, left, terms, reads = [], 0, [], False
    with open(path, encoding="utf-8", errors="replace") as deck:
        for place, line in enumerate(deck, 1):
            words = [word.strip() for word in line.split(",")]
            if line.startswith("**") or not line.strip():
                continue
            if line.startswith("*"):
                if left:
                    raise ValueError(f"{path}, line {place}: {left} terms of the equation before are missing")
                reads = words[0].upper().replace(" ", "") == "*EQUATION"
                if reads and any(words[1:]):
                    raise ValueError(f"{path}, line {place}: {line.strip()}: a card with {words[1]} is not read")
            elif reads:
                try:
                    if not left:
                        left, terms = int(words[0]), []
                        if left < 1:
                            raise ValueError
                        continue
                    words = words[:-1] if words[-1] == "" else words
                    for node, direction, factor in zip(*[iter(words)] * 3, strict=True):
                        terms.append((number(int(node), int(direction)), float(factor.upper().replace("D", "E"))))
                        left -= 1
                except ValueError:
                    raise ValueError(f"{path}, line {place}: {line.strip()}: this is no number of terms, or not node, "
                                     f"direction, coefficient of each") from None
                if left < 0:
                    raise ValueError(f"{path}, line {place}: the equation has more terms than was said")
                if not left:
                    found.append(_solved(terms, path, place))
    if left:
        raise ValueError(f"{path}: {left} terms of the last equation are missing")
    return found


def _solved(terms, path, place):
    (dependent, first), *others = terms
    if not first:
        raise ValueError(f"{path}, line {place}: the coefficient of the first term is 0")
    return dependent, [dof for dof, _ in others], [-factor / first for _, factor in others]


def _nodes(name, values):
    values = integers(name, values)
    if values.ndim != 2 or values.shape[1] not in (2, 3):
        raise ValueError(f"{name} has the shape {values.shape}: give the dof numbers of each node, shape (n, D), D 2 or 3")
    return values
