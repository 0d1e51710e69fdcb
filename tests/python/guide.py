"""The functions of the guide's chapters on large sliding and on questions do what the chapters say.

    python3 tests/python/guide.py WORK      WORK has them in large_sliding.py and questions.py
"""

import os
import sys
import tempfile
import unittest

import numpy as np

from common import ROOT

sys.path.insert(0, os.path.join(ROOT, "c_examples", "3d"))
import brick_mesh  # noqa: E402
import signorini  # noqa: E402

MU = 0.3


class Matrix:
    """A matrix with all that the function asks of one of scipy: columns, and products."""

    def __init__(self, compressed):
        self.data, self.indices, self.indptr = compressed
        self.shape = (len(self.indptr) - 1,) * 2

    def tocsc(self, copy):
        return self

    def sum_duplicates(self):
        """There are none."""

    def __matmul__(self, x):
        per_entry = np.repeat(x, np.diff(self.indptr)) * self.data
        return np.bincount(self.indices, per_entry, minlength=len(x))


class Sliding(unittest.TestCase):
    """Two blocks; the bottom stays, the top goes down by 0.01 mm and then along x."""

    def setUp(self):
        self.blocks = brick_mesh.two_blocks(wide=16, deep=2, narrow=4, high=2)
        top = np.flatnonzero(np.isclose(self.blocks.at[:, 2], 15))
        self.fixed = np.r_[self.blocks.held, 3 * top, 3 * top + 1, 3 * top + 2]
        self.count = len(top)

    def moves(self, along):
        moves = np.zeros((1 + len(along), len(self.fixed)))
        first = len(self.blocks.held)
        moves[0, first + 2 * self.count:] = -0.01
        moves[1:, first:first + self.count] = np.reshape(along, (-1, 1))
        return moves

    def forces(self, moves):
        blocks = self.blocks
        return np.array(list(slide(blocks.at, Matrix(blocks.matrix), blocks.slave, blocks.master,
                                   self.fixed, moves, MU)))

    def test_over_several_elements(self):
        forces = self.forces(self.moves([3.0] * 11))
        pressed = forces[1:, 2]
        # All pairs slip along x. Normals turn with the faces of now, by the strains: 1e-2 mm in 35 mm.
        np.testing.assert_allclose(-forces[1:, 0] / pressed, MU, rtol=1e-3)
        np.testing.assert_allclose(forces[:, 1], 0, atol=1e-8 * pressed.mean())
        # The chapter says so; the force of the first step has no friction in it.
        np.testing.assert_allclose(pressed, pressed.mean(), rtol=0.015)

    def test_friction_remembers_without_a_reference_slip(self):
        """Partial slip and its reversal: as pairs that stay the same with the slip of the step before."""
        moves = self.moves([0.001, 0.002, 0.004, -0.003])
        blocks = self.blocks
        contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
        model = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=self.fixed)
        slip0, wanted = 0.0, []
        for step in range(len(moves)):
            result = model.solve(np.zeros(blocks.at.size), mu=MU, slip0=slip0,
                                 prescribed=moves[:step + 1].sum(axis=0))
            slip0 = result.d[:, 1:]
            wanted.append(contact.resultant(result).force)
        wanted = np.array(wanted)
        # The pairs of now are those of the start turned and stretched by strains below 1e-3.
        np.testing.assert_allclose(self.forces(moves), wanted, atol=1e-3 * wanted[:, 2].max())


class Zones(unittest.TestCase):
    """Three lines above each other, each node on a spring: the closed form stands in tests/c/questions.c."""

    def test_a_node_is_master_and_slave(self):
        at = np.array([[0, 0.3], [1, 0.3], [0, 0.1], [1, 0.1], [0, 0], [1, 0]])
        springs = (np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13))
        contacts = {name: signorini.pair_surfaces(at, [[upper, upper + 1]], [[upper + 3, upper + 2]])
                    for name, upper in (("upper", 0), ("lower", 2))}
        load = np.zeros(12)
        load[[1, 3]] = -4
        parts = solve_zones(springs, contacts, load, [], {"upper": 0.3, "lower": 0.2})
        upper, lower = parts["upper"], parts["lower"]
        self.assertEqual(upper.status, signorini.Status.SOLVED)
        # To 1e-9: results are certified to 1e-10 of forces of size one.
        np.testing.assert_allclose(upper.F, [[-3.2, 0]] * 2, atol=1e-9)
        np.testing.assert_allclose(lower.F, [[-2, 0]] * 2, atol=1e-9)
        np.testing.assert_allclose(contacts["upper"].resultant(upper).force, [0, 6.4, 0], atol=1e-9)
        np.testing.assert_allclose(contacts["lower"].resultant(lower).force, [0, 4, 0], atol=1e-9)

    def test_a_deck_ties_two_nodes(self):
        """The nodes of a line on springs of 1 move as the other nodes do, also on springs of 1, down by 4 / 2."""
        at = np.array([[0, 0.5], [1, 0.5], [0, 9], [1, 9]])
        springs = (np.ones(12), np.arange(12), np.arange(13))
        floor = signorini.pair_obstacle(at, [[0, 1]], signorini.Plane([0, -9], [0, 1]),
                                        dofs=[[0, 1], [3, 4], [6, 7], [9, 10]])
        load = np.zeros(12)
        load[[7, 10]] = -4
        with tempfile.TemporaryDirectory() as folder:
            deck = os.path.join(folder, "tied.inp")
            with open(deck, "w", encoding="ascii") as file:
                file.write("*EQUATION\n2\n1,2,1.,3,2,-1.\n2\n2,2,1.,4,2,-1.\n")
            result, u = solve_deck(deck, springs, floor, load, [], 0.3)
        self.assertEqual(result.status, signorini.Status.SOLVED)
        np.testing.assert_allclose(u[[1, 4, 7, 10]], -2, atol=1e-12)

    def test_rows_are_those_of_the_library(self):
        """A model of the rows has the stiffness of the model of the pairs, bit by bit."""
        blocks = brick_mesh.two_blocks(wide=3, deep=2, narrow=2, high=1)
        contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
        mine = signorini.Model.sparse(blocks.matrix, rows=contact.rows, normals=contact.normals,
                                      tangents=contact.tangents, fixed=blocks.held)
        ours = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=blocks.held)
        np.testing.assert_array_equal(mine.stiffness, ours.stiffness)
        np.testing.assert_array_equal(mine.frames, ours.frames)

    def test_no_pairs_have_no_rows(self):
        at = np.array([[0, 50], [1, 50], [0, 0], [1, 0.0]])
        self.assertEqual(signorini.pair_surfaces(at, [[0, 1]], [[3, 2]]).rows, [])


class PressFit(unittest.TestCase):
    """A shaft with a bore in a hub, in plane strain: rings of quadrilaterals, 32 and 40 around."""

    YOUNG, POISSON, BORE, RADIUS, RIM = 210000.0, 0.3, 20.0, 50.0, 100.0

    def ring(self, inner, outer, across, around):
        """Coordinates, elements, lines inside and outside with the body on their left, a dense stiffness."""
        turn = 2 * np.pi * np.arange(around) / around
        radius = np.linspace(inner, outer, across + 1)
        at = np.stack([np.outer(np.cos(turn), radius), np.outer(np.sin(turn), radius)], axis=-1).reshape(-1, 2)
        node = np.arange(len(at)).reshape(around, across + 1)
        after = np.roll(node, -1, axis=0)
        quads = np.stack([node[:, :-1], node[:, 1:], after[:, 1:], after[:, :-1]], axis=-1).reshape(-1, 4)
        K = np.zeros((2 * len(at), 2 * len(at)))
        for quad in quads:
            dofs = np.stack([2 * quad, 2 * quad + 1], axis=-1).ravel()
            K[np.ix_(dofs, dofs)] += self.element(at[quad])
        return (at, np.stack([after[:, 0], node[:, 0]], axis=-1), np.stack([node[:, -1], after[:, -1]], axis=-1), K)

    def element(self, x):
        scale = self.YOUNG / (1 + self.POISSON)
        shear, lame = scale / 2, scale * self.POISSON / (1 - 2 * self.POISSON)
        law = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
        K = np.zeros((8, 8))
        for a in (-1 / 3 ** 0.5, 1 / 3 ** 0.5):
            for b in (-1 / 3 ** 0.5, 1 / 3 ** 0.5):
                slopes = np.array([[b - 1, 1 - b, 1 + b, -1 - b], [a - 1, -1 - a, 1 + a, 1 - a]]) / 4
                jacobian = slopes @ x
                h = np.linalg.solve(jacobian, slopes)
                strain = np.zeros((3, 8))
                strain[0, 0::2], strain[1, 1::2], strain[2, 0::2], strain[2, 1::2] = h[0], h[1], h[1], h[0]
                K += np.linalg.det(jacobian) * strain.T @ law @ strain
        return K

    def widening(self, at, other):
        """How far a pressure of 1 moves the circle of this radius of a ring (Lame)."""
        poisson = self.POISSON
        ratio = ((1 - 2 * poisson) * at ** 2 + other ** 2) / abs(other ** 2 - at ** 2)
        return (1 + poisson) / self.YOUNG * ratio * at

    def pressures(self, shaft_around, hub_around, shaft_is_slave, interference):
        shaft, _, outside, K_shaft = self.ring(self.BORE, self.RADIUS, 6, shaft_around)
        hub, inside, _, K_hub = self.ring(self.RADIUS, self.RIM, 8, hub_around)
        at, n = np.vstack([shaft, hub]), len(shaft)
        K = np.zeros((2 * len(at), 2 * len(at)))
        K[:2 * n, :2 * n], K[2 * n:, 2 * n:] = K_shaft, K_hub
        # Three nodes of each ring that the fit moves along the axes alone.
        fixed = [base + 2 * node + axis for base, around, across in ((0, shaft_around, 7), (2 * n, hub_around, 9))
                 for node, axis in ((0, 1), (around // 2 * across, 1), (around // 4 * across, 0))]
        sides = (outside, inside + n) if shaft_is_slave else (inside + n, outside)
        columns, rows = np.nonzero(K)
        sparse = (K[rows, columns], rows, np.searchsorted(columns, np.arange(len(K) + 1)))
        contact, result = press_fit(at, sparse, *sides, fixed, interference,
                                    signorini.Sphere([0, 0], self.RADIUS))
        self.assertEqual(result.status, signorini.Status.SOLVED)
        return -result.F[:, 0] / contact.areas

    def test_pressure_of_a_given_interference(self):
        """Of each pair to 1 %, in the mean to 0.2 %: the circle is a polygon, and the field curved within elements."""
        interference = 0.05
        wanted = interference / (self.widening(self.RADIUS, self.BORE) + self.widening(self.RADIUS, self.RIM))
        for arounds in ((32, 40), (40, 32)):
            for shaft_is_slave in (False, True):
                pressures = self.pressures(*arounds, shaft_is_slave, interference)
                np.testing.assert_allclose(pressures, wanted, rtol=0.01)
                self.assertLess(abs(pressures.mean() / wanted - 1), 0.002)


if __name__ == "__main__":
    sys.path.insert(0, sys.argv.pop(1))
    from large_sliding import slide
    from questions import press_fit, solve_deck, solve_zones
    unittest.main()
