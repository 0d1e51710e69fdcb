"""The Python package: results draw themselves.

    python3 tests/python/plots.py WORK      WORK: a directory for the pictures
"""

import os
import sys
import unittest
import warnings
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


def acted(contact, F, state):
    """A result of these forces and states."""
    return signorini.Result(0 * F, F, np.asarray(state, np.int32), 0, "", *[None] * 3)._replace(contact=contact)


def sheet(cells, wide=1.0, start=0.0, across=(0, 1), quadratic=False):
    """Squares of a sheet on a plane, with pressures, tractions and all three states: a result."""
    step = 2 if quadratic else 1
    line = np.arange(step * cells + 1)
    row, at = len(line), np.zeros((len(line) ** 2, 3))
    at[:, across] = np.stack(np.meshgrid(line, line, indexing="ij"), axis=2).reshape(-1, 2) * wide / line[-1]
    at[:, across[0]] += start
    around = ([0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]) if quadratic else ([0, 0], [1, 0], [1, 1], [0, 1])
    squares = [[(step * i + x) * row + step * j + y for x, y in around] for i in range(cells) for j in range(cells)]
    outward = np.delete(np.eye(3), across, axis=1).T[0]
    contact = signorini.pair_obstacle(at, squares, signorini.Plane([0, 0, 0], outward))
    away = ((contact.points[:, across] - at[:, across].mean(axis=0)) ** 2).sum(axis=1) / wide ** 2
    pressure = np.maximum(0.2 - away, 0) * wide
    F = np.column_stack([-pressure, 0.3 * pressure, 0 * pressure]) * contact.areas[:, None]
    state = np.where(pressure == 0, signorini.State.OPEN, np.where(away > 0.1, signorini.State.SLIP, signorini.State.STICK))
    return acted(contact, F, state)


def pixels(axes):
    """The picture that axes are on, (rows, columns, 3), without a new layout."""
    figure = axes.figure
    figure.canvas.draw()
    figure.set_layout_engine("none")
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)


def covered(axes, faces):
    """The share of the pixels of faces that other things on the axes change; these are not seen afterwards."""
    whole = pixels(axes)
    for other in (*axes.collections, *axes.lines):
        other.set_visible(other is faces)
    alone = pixels(axes)
    faces.set_visible(False)
    seen = (alone != pixels(axes)).any(axis=2)
    return ((whole != alone).any(axis=2) & seen).sum() / seen.sum()


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

    def test_marks_leave_faces_of_any_number_to_be_seen(self):
        for cells, quadratic in (3, False), (10, False), (40, False), (20, True):
            result = sheet(cells, quadratic=quadratic)
            axes = result.plot()
            faces = axes.collections[0]
            # Corners of squares, and of the four parts of each with nine nodes.
            self.assertEqual(len(faces.get_array()), cells ** 2 * (4 if quadratic else 1))
            with warnings.catch_warnings():
                warnings.simplefilter("error")  # of a layout that has no room
                share = covered(axes, faces)
            self.assertTrue(0 < share < 0.25, f"{share} of {cells} x {cells} faces are covered")
            matplotlib.pyplot.close(axes.figure)

    def test_states_that_alternate_hide_nothing(self):
        result = sheet(30)
        pairs = len(result.F)
        axes = result._replace(state=np.arange(pairs, dtype=np.int32) % 2 + signorini.State.SLIP).plot()
        self.assertLess(covered(axes, axes.collections[0]), 0.25)
        matplotlib.pyplot.close(axes.figure)

    def test_zones_on_the_same_axes_have_one_scale(self):
        parts = [sheet(6), sheet(6, wide=4.0, start=2.0)]
        axes = parts[0].plot()
        parts[1].plot(axes)
        drawn = [one for one in axes.collections if one.get_array() is not None]
        scales = {one.get_clim() for one in drawn}
        pressures = [part.contact.fields(part).pressure[np.array(part.contact.slave_faces)].mean(axis=1) for part in parts]
        # From zero to the largest of both, on one bar.
        self.assertEqual(len(scales), 1)
        np.testing.assert_allclose([*scales][0], (0, max(map(np.max, pressures))))
        np.testing.assert_allclose(np.concatenate([one.get_array() for one in drawn]), np.concatenate(pressures))
        self.assertEqual(len(axes.figure.axes), 2)
        words = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(len(words), len(set(words)))
        self.save(axes, "result_3d_zones")

    def test_the_next_result_of_a_zone_takes_the_place_of_the_last(self):
        result = sheet(4)
        axes = result.plot()
        result._replace(F=2 * result.F).plot(axes)
        pressure = result.contact.fields(result).pressure[np.array(result.contact.slave_faces)].mean(axis=1)
        np.testing.assert_allclose(axes.collections[0].get_array(), 2 * pressure)
        axes.clear()
        result.plot(axes)
        np.testing.assert_allclose(axes.collections[0].get_array(), pressure)
        matplotlib.pyplot.close(axes.figure)

    def test_marks_behind_faces_are_not_seen(self):
        behind, front = sheet(6), sheet(1, wide=10.0, start=-5.0, across=(1, 2))
        axes = behind.plot()
        axes.view_init(elev=0, azim=0)
        # Along x a sheet in the plane of y and z at x = 0 hides what is at x < 0.
        front._replace(F=0 * front.F, state=0 * front.state).plot(axes)
        axes.figure.canvas.draw()
        picture = axes.collections[0].signorini
        places = np.array([[-1.0, 0, 5], [1, 0, 5], [-1, 7, 5]])
        np.testing.assert_array_equal(picture.hidden(places), [True, False, False])
        matplotlib.pyplot.close(axes.figure)

    def test_several_zones_are_drawn_together(self):
        at = np.array([[0.0, 0], [1, 0], [2, 0], [5, 1], [7, 1]])
        planes = {"low": signorini.pair_obstacle(at, [[0, 1], [1, 2]], signorini.Plane([0, 0], [0, 1])),
                  "high": signorini.pair_obstacle(at, [[3, 4]], signorini.Plane([0, 1], [0, 1]))}
        model = signorini.Model.from_surfaces((np.ones(10), np.arange(10), np.arange(11)), planes)
        result = model.solve(np.tile([0.0, -1], 5), mu=0.3)
        axes = result.plot()
        x, pressure = axes.lines[0].get_data()
        np.testing.assert_array_equal(x, [0, 1, 2, np.nan, 2, 4])
        np.testing.assert_allclose(pressure, [2, 1, 2, np.nan, 1, 1])
        self.assertEqual([text.get_text() for text in axes.texts], ["low", "high"])
        self.save(axes, "result_2d_zones")

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
