"""The Python package: results draw themselves.

    python3 tests/python/plots.py WORK      WORK: a directory for the pictures
"""

import os
import sys
import unittest
from unittest import mock

import numpy as np

import matplotlib

from common import LOAD, ROOT, K

import signorini

matplotlib.use("Agg")
sys.path.insert(0, os.path.join(ROOT, "c_examples", "3d"))
import bar_mesh  # noqa: E402
import brick_mesh  # noqa: E402

WORK = "."


def bar():
    """The bar on the plane, paired by the library, with gaps of 0: its pairs are nodes of the lower side."""
    bar = bar_mesh.assemble()
    count = len(bar.contact)
    at = np.zeros((len(bar.load) // 2, 2))
    at[bar.contact[:, 0] // 2, 0] = np.linspace(0, 40, count)
    nodes = bar.contact[:, 0] // 2
    contact = signorini.pair_obstacle(at, np.column_stack([nodes[:-1], nodes[1:]]), signorini.Plane([0, 0], [0, 1]))
    return signorini.Model.from_surfaces(bar.matrix, contact, fixed=bar.held).solve(bar.load, mu=1.0)


class Plots(unittest.TestCase):
    def save(self, axes, name):
        path = os.path.join(WORK, name + ".png")
        axes.figure.savefig(path, dpi=110)
        self.assertGreater(os.path.getsize(path), 5000)
        matplotlib.pyplot.close(axes.figure)

    def test_in_2d_over_the_surface(self):
        result = bar()
        axes = result.plot()
        x, pressure = axes.lines[0].get_data()
        np.testing.assert_allclose(x, np.linspace(0, 40, len(x)), atol=1e-12)
        np.testing.assert_allclose(pressure, -result.F[:, 0] / result.contact.areas)
        states = sum(len(dots.get_offsets()) for dots in axes.collections)
        self.assertEqual(states, len(x))
        self.save(axes, "result_2d")

    def test_curves_end_where_a_part_of_the_surface_does(self):
        at = np.array([[0.0, 0], [1, 0], [6, 0], [7, 0]])
        contact = signorini.pair_obstacle(at, [[0, 1], [2, 3]], signorini.Plane([0, 0], [0, 1]))
        F = -np.column_stack([np.arange(1.0, 5), np.zeros(4)])
        result = signorini.Result(0 * F, F, np.full(4, signorini.State.STICK), 0, "", *[None] * 3)._replace(contact=contact)
        axes = result.plot()
        x, pressure = axes.lines[0].get_data()
        np.testing.assert_array_equal(np.isnan(x), [False, False, True, False, False])
        np.testing.assert_array_equal(np.isnan(pressure), np.isnan(x))
        matplotlib.pyplot.close(axes.figure)

    def test_two_results_on_the_same_axes_are_both_seen(self):
        F = np.tile([-1.0, 0, 0], (2, 1))
        result = signorini.Result(0 * F, F, np.full(2, signorini.State.STICK), 0, "", *[None] * 3)
        at = np.array([[0.0, 0, 0], [1, 1, 0]])
        axes = result.plot(at=at)
        result.plot(axes, at=at + 5)
        for low, high in (axes.get_xlim(), axes.get_ylim()):
            self.assertLessEqual(low, 0)
            self.assertGreaterEqual(high, 6)
        matplotlib.pyplot.close(axes.figure)
        flat = matplotlib.pyplot.figure().add_subplot()
        with self.assertRaisesRegex(ValueError, 'make them by add_subplot\\(projection="3d"\\)'):
            result.plot(flat, at=at)
        matplotlib.pyplot.close(flat.figure)
        with self.assertRaisesRegex(ValueError, "has no pairs"):
            result._replace(d=F[:0], F=F[:0], state=result.state[:0]).plot()

    def test_in_3d_on_the_faces(self):
        blocks = brick_mesh.two_blocks()
        contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
        model = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=blocks.held)
        result = model.solve(blocks.press + 3e5 * blocks.twist, mu=0.6)
        axes = result.plot()
        drawn = axes.collections[0]
        pressure = contact.fields(result).pressure[blocks.slave].mean(axis=1)
        np.testing.assert_allclose(drawn.get_array(), pressure)
        self.save(axes, "result_3d")
        self.save(result._replace(contact=None).plot(at=contact.points), "result_3d_places")

    def test_of_two_skins_the_faces_over_the_master(self):
        blocks = brick_mesh.two_blocks(wide=3, deep=1, narrow=2, high=1)
        low = int(blocks.bricks[:9].max()) + 1
        meshes = [(at, {"hexahedron": bricks}) for at, bricks in
                  ((blocks.at[low:], blocks.bricks[9:] - low), (blocks.at[:low], blocks.bricks[:9]))]
        contact = signorini.pair_meshes(*meshes)
        F = np.tile([-1.0, 0, 0], (contact.pairs, 1))
        result = signorini.Result(0 * F, F, np.full(len(F), signorini.State.STICK), 0, "", *[None] * 3)._replace(contact=contact)
        axes = result.plot()
        self.assertEqual(len(axes.collections[0].get_array()), len(blocks.slave))
        matplotlib.pyplot.close(axes.figure)

    def test_without_a_surface(self):
        result = signorini.solve(K, LOAD, 0, 0.3)
        axes = result.plot()
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), [1, 2])
        self.assertIs(result.plot(axes), axes)
        self.save(axes, "result_pairs")
        axes = result.plot(at=[[3, 0], [1, 0]])
        np.testing.assert_allclose(np.diff(axes.lines[0].get_xdata()), 2)
        self.save(axes, "result_2d_places")
        with self.assertRaisesRegex(ValueError, r"at has the shape \(2, 3\): give the place of each pair"):
            result.plot(at=np.zeros((2, 3)))

    def test_without_matplotlib(self):
        with mock.patch.dict(sys.modules, {"matplotlib": None, "matplotlib.pyplot": None}):
            with self.assertRaisesRegex(ImportError, "needs matplotlib: pip install matplotlib"):
                signorini.solve(K, LOAD, 0, 0.3).plot()


if __name__ == "__main__":
    WORK = sys.argv.pop(1)
    unittest.main()
