"""The function of the guide's chapter on large sliding does what the chapter says.

    python3 tests/python/guide.py WORK      WORK has the function in large_sliding.py
"""

import os
import sys
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


if __name__ == "__main__":
    sys.path.insert(0, sys.argv.pop(1))
    from large_sliding import slide
    unittest.main()
