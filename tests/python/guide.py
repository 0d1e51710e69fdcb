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

MU = 0.3


class Matrix:
    """What the function asks of a matrix of scipy: columns, and products."""

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
    def test_two_blocks(self):
        blocks = brick_mesh.two_blocks(wide=16, deep=2, narrow=4, high=2)
        top = np.flatnonzero(np.isclose(blocks.at[:, 2], 15))
        fixed = np.r_[blocks.held, 3 * top, 3 * top + 1, 3 * top + 2]
        # The bottom stays; the top goes down by 0.01 mm, then 11 times by 3 mm along x.
        moves = np.zeros((12, len(fixed)))
        first, count = len(blocks.held), len(top)
        moves[0, first + 2 * count:] = -0.01
        moves[1:, first:first + count] = 3.0
        forces = np.array(list(slide(blocks.at, Matrix(blocks.matrix), blocks.slave,
                                     blocks.master, fixed, moves, MU)))
        pressed = forces[1:, 2]
        # All pairs slip along x. Normals turn with the faces of now, by the strains: 1e-2 mm in 35 mm.
        np.testing.assert_allclose(-forces[1:, 0] / pressed, MU, rtol=1e-3)
        np.testing.assert_allclose(forces[:, 1], 0, atol=1e-8 * pressed.mean())
        # What the chapter says; the force of the first step has no friction in it.
        np.testing.assert_allclose(pressed, pressed.mean(), rtol=0.015)


if __name__ == "__main__":
    sys.path.insert(0, sys.argv.pop(1))
    from large_sliding import slide
    unittest.main()
