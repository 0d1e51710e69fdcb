"""The Python package: contact pairs from two meshes, as arrays and as meshio reads them.

    python3 tests/python/meshes.py
"""

import itertools
import os
import sys
import unittest
import warnings
from types import SimpleNamespace

import numpy as np

from common import ROOT

import signorini
from signorini import _skin as skins

sys.path.insert(0, os.path.join(ROOT, "c_examples", "3d"))
import brick_mesh  # noqa: E402

CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1.0]])
# One cell of each kind by its corners, and its volume (area in the plane).
CELLS = {
    "triangle": (CUBE[[0, 1, 3], :2], 1 / 2), "quad": (CUBE[:4, :2], 1.0), "tetra": (CUBE[[0, 1, 3, 4]], 1 / 6),
    "hexahedron": (CUBE, 1.0), "wedge": (CUBE[[0, 1, 3, 4, 5, 7]], 1 / 2), "pyramid": (CUBE[[0, 1, 2, 3, 4]], 1 / 3),
}
QUADRATIC = {"triangle": ("triangle6",), "quad": ("quad8", "quad9"), "tetra": ("tetra10",),
             "hexahedron": ("hexahedron20", "hexahedron27"), "wedge": ("wedge15",), "pyramid": ("pyramid13",)}


def with_mid_nodes(kind, corners, name):
    """Coordinates of a quadratic cell."""
    _, edges, faces = skins._SHAPES[kind]
    at = [*corners, *(corners[list(edge)].mean(axis=0) for edge in edges)]
    if name == "hexahedron27":
        at += [corners[list(face)].mean(axis=0) for face in faces]
    if name in ("quad9", "hexahedron27"):
        at.append(corners.mean(axis=0))
    return np.array(at)


def outward(at, face):
    """Area vector of a plane face by its corners, and its centre."""
    places = at[face[:skins.corners(face, at.shape[1])]]
    if at.shape[1] == 2:
        along = places[1] - places[0]
        return np.array([along[1], -along[0]]), places.mean(axis=0)
    area = sum(np.cross(places[i] - places[0], places[i + 1] - places[0]) for i in range(1, len(places) - 1)) / 2
    return area, places.mean(axis=0)


class Skins(unittest.TestCase):
    def check(self, at, blocks, volume):
        """Gauss's theorem on x: the area vectors of a closed surface sum to 0, x . a over them to D volumes."""
        faces = skins.skin(at, blocks)
        vectors, centres = zip(*(outward(at, face) for face in faces))
        np.testing.assert_allclose(np.sum(vectors, axis=0), 0, atol=1e-14)
        flux = sum(vector @ centre for vector, centre in zip(vectors, centres))
        self.assertAlmostEqual(flux, at.shape[1] * volume, places=13)
        return faces

    def test_faces_beyond_the_pairs_whose_nodes_have_no_rows(self):
        """Two squares on springs; the host has dropped the upper nodes, which it holds, and all faces of the skin are asked."""
        cells = {"quad": [[0, 1, 3, 2]]}
        lower = np.array([[0, 0], [1, 0], [0, 1], [1, 1.0]])
        contact = signorini.pair_meshes((lower + [0, 1], cells), (lower, cells),
                                        dofs=np.array([0, 1, 2, 3, 12, 13, 14, 15, 4, 5, 6, 7, 8, 9, 10, 11]).reshape(8, 2))
        model = signorini.Model.from_surfaces((np.ones(12), np.arange(12), np.arange(13)), contact)
        load = np.tile([0, -1.0], 6)
        result = model.solve(load, mu=0.0)
        self.assertEqual(result.status, signorini.Status.SOLVED)
        np.testing.assert_allclose(result.F[:, 0], 0, atol=1e-12)
        with self.assertRaisesRegex(ValueError, "at least 16"):
            contact.penetration(model.recover(result.d, load))

    def test_one_cell_of_each_kind_in_both_orientations(self):
        mirrored = np.array([-1.0, 1, 1])
        for kind, (corners, volume) in CELLS.items():
            for name in (kind, *QUADRATIC[kind]):
                at = corners if name == kind else with_mid_nodes(kind, corners, name)
                for places in (at, at * mirrored[:at.shape[1]]):
                    faces = self.check(places, [(name, np.arange(len(places))[None, :])], volume)
                    for face in faces:  # mid nodes in the middle of the corners beside them
                        count = skins.corners(face, places.shape[1])
                        for place, mid in enumerate(face[count:2 * count]):
                            between = face[place], face[(place + 1) % count]
                            np.testing.assert_allclose(places[mid], places[list(between)].mean(axis=0), atol=1e-15)
                        for centre in face[2 * count:]:
                            np.testing.assert_allclose(places[centre], places[face[:count]].mean(axis=0), atol=1e-15)

    def test_faces_between_cells_are_left_out(self):
        blocks = brick_mesh.two_blocks(wide=3, deep=2, narrow=2, high=1)
        faces = self.check(blocks.at, [("hexahedron", blocks.bricks)], 30 * 30 * 20 + 15 * 15 * 7.5)
        self.assertEqual(len(faces), 2 * 9 + 4 * 6 + 2 * 4 + 4 * 2)


class Pairs(unittest.TestCase):
    def setUp(self):
        self.blocks = brick_mesh.two_blocks(wide=6, deep=2, narrow=4, high=2)
        self.below = int(self.blocks.bricks[:6 * 6 * 2].max()) + 1
        at, bricks = self.blocks.at, self.blocks.bricks
        cut = 6 * 6 * 2
        self.lower = at[:self.below], {"hexahedron": bricks[:cut]}
        self.upper = at[self.below:], {"hexahedron": bricks[cut:] - self.below}
        self.by_faces = signorini.pair_surfaces(at, self.blocks.slave, self.blocks.master)

    def same(self, contact, other=None):
        """Both have equal pairs, whatever the numbers of their nodes."""
        other = other or self.by_faces
        self.assertEqual(contact.pairs, other.pairs)
        for name in ("points", "normals", "gaps", "areas"):
            np.testing.assert_allclose(getattr(contact, name), getattr(other, name), atol=1e-12, err_msg=name)

    def test_the_axis_of_revolution_has_no_contact(self):
        at = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
        upper, lower = (at + [0, 1], {"quad": [[0, 1, 2, 3]]}), (at, {"quad": [[0, 1, 2, 3]]})
        contact = signorini.pair_meshes(upper, lower, axisymmetric=True)
        self.assertEqual((contact.report.slave_faces, contact.pairs), (3, 2))

    def test_skins_of_two_meshes(self):
        self.same(signorini.pair_meshes(self.upper, self.lower))

    def test_one_mesh_with_sets(self):
        cut = 6 * 6 * 2
        mesh = SimpleNamespace(
            points=self.blocks.at,
            cells=[SimpleNamespace(type="hexahedron", data=self.blocks.bricks),
                   SimpleNamespace(type="quad", data=self.blocks.slave[:, ::-1])],  # turned into the body
            cell_sets={"upper": [np.arange(cut, len(self.blocks.bricks)), None],
                       "lower": [np.arange(cut), np.zeros(0, int)],
                       "sole": [None, np.arange(len(self.blocks.slave))]},
            field_data={"floor": np.array([7, 3])},
            cell_data={"gmsh:physical": [np.where(np.arange(len(self.blocks.bricks)) < cut, 7, 8),
                                         np.full(len(self.blocks.slave), 9)]},
        )
        of_sole = np.isin(np.arange(len(self.blocks.at)), self.blocks.slave)
        for slave in ("upper", "sole", self.blocks.slave, lambda at: of_sole):
            for master in ("lower", "floor", self.blocks.master):
                self.same(signorini.pair_meshes(mesh, mesh, slave_faces=slave, master_faces=master))
        for words, arguments in (
            ("slave_faces: slave has no set 'side'; sets: floor, lower, sole, upper", {"slave_faces": "side"}),
            ("give slave_faces and master_faces", {}),
            ("chooses no face", {"slave_faces": lambda at: at[:, 2] > 99}),
            ("return a truth value", {"slave_faces": lambda at: at}),
        ):
            with self.assertRaisesRegex(ValueError, words):
                signorini.pair_meshes(mesh, mesh, **{"master_faces": "lower", **arguments} if arguments else {})

    def test_obstacles(self):
        floor = signorini.Plane([0, 0, -0.25], [0, 0, 1])
        contact = signorini.pair_meshes(self.upper, floor, slave_faces=lambda at: at[:, 2] == 0)
        np.testing.assert_allclose(contact.gaps, 0.25, atol=1e-14)
        self.assertAlmostEqual(contact.areas.sum(), 30.0 ** 2)
        for arguments, words in (({}, "give slave_faces"), ({"master_faces": "x"}, "leave it out")):
            with self.assertRaisesRegex(ValueError, words):
                signorini.pair_meshes(self.upper, floor, **arguments)

    def test_the_reach_is_that_of_the_whole_skins(self):
        """A column of one cell, 6 high, on a block: half the diagonal of its box is 3.1, its largest face 6.1 wide; of the
        face that lies over the block they are 0.7 and 1.4."""
        column, block = CUBE * [1, 1, 6], CUBE * [40, 40, 10] - [20, 20, 10]
        cell = {"hexahedron": [range(8)]}
        for gap in (0.5, 2.0, -2.0):
            contact = signorini.pair_meshes((column + [0, 0, gap], cell), (block, cell))
            np.testing.assert_allclose(contact.gaps, [gap] * 4, atol=1e-12)
            np.testing.assert_allclose(contact.normals, [[0, 0, -1]] * 4, atol=1e-12)
            self.assertAlmostEqual(contact.areas.sum(), 1)

    def test_faces_count_as_given_and_all_are_asked_for_what_passes_through(self):
        """Two cubes as one mesh, of which one stands on a plate and the other 0.2 above it, beyond the search distance, and
        then falls by 0.9."""
        cubes, cells = np.vstack([CUBE, CUBE + [3, 0, 0.2]]), {"hexahedron": [range(8), range(8, 16)]}
        plate = CUBE * [8, 8, 1] - [2, 2, 1], {"hexahedron": [range(8)]}
        contact = signorini.pair_meshes((cubes, cells), plate, search_distance=0.1)
        self.assertEqual((contact.pairs, len(contact.slave_faces), len(contact.uncovered)), (4, 12, 11))
        sole = {8, 9, 10, 11}
        self.assertEqual([set(contact.slave_faces[face]) for face in contact.beyond], [sole])
        self.assertIn(f"face {contact.beyond[0]}, at 0.2", contact.summary)
        u = np.zeros((24, 3))
        self.assertIsNone(contact.penetration(u))
        u[8:16, 2] = -0.9
        found = contact.penetration(u)
        self.assertAlmostEqual(found.depth, 0.7, places=12)
        self.assertEqual((found.points, set(contact.slave_faces[found.face])), (5, sole))

    def test_groups_of_two_dimensions_may_have_one_number(self):
        lower, sole = self.lower, self.blocks.slave - self.below
        mesh = SimpleNamespace(
            points=self.upper[0], cells=[("quad", sole), ("hexahedron", self.upper[1]["hexahedron"])],
            field_data={"sole": np.array([1, 2]), "body": np.array([1, 3])},
            cell_data={"gmsh:physical": [np.ones(len(sole), int), np.ones(len(self.upper[1]["hexahedron"]), int)]})
        for name, faces in (("sole", len(sole)), ("body", 4 * 4 * 2 + 4 * 4 * 2)):
            contact = signorini.pair_meshes(mesh, lower, slave_faces=name)
            self.assertEqual(contact.report.slave_faces, faces)
            self.same(contact)

    def test_bricks_that_are_wedges(self):
        """A brick two edges of which are one has a skin of triangles and quadrilaterals, seen from outside, with mid nodes or without; so
        has a quadrilateral that is a triangle."""
        at = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1.0]])
        brick = [0, 1, 2, 0, 3, 4, 5, 3]
        edges = {tuple(sorted(pair)): None for pair in itertools.combinations(range(6), 2)}
        mids = {pair: 6 + k for k, pair in enumerate(edges)}
        middle = np.vstack([at, [at[list(pair)].mean(axis=0) for pair in mids]])
        pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
        ends = [tuple(sorted((brick[a], brick[b]))) for a, b in pairs]
        quadratic = brick + [mids.get(pair, pair[0]) for pair in ends]
        for nodes, cells in (at, {"hexahedron": [brick]}), (middle, {"hexahedron20": [quadratic]}):
            faces = signorini._meshes._Mesh("mesh", (nodes, cells)).skin
            self.assertEqual(sorted(map(len, faces)), [3, 3, 4, 4, 4] if len(nodes) == 6 else [6, 6, 8, 8, 8])
            for face in faces:
                count = 3 if len(face) in (3, 6) else 4
                corners = nodes[face[:count]]
                outward = np.cross(corners[2] - corners[0], corners[-1] - corners[1] if count == 4 else corners[2] - corners[1])
                self.assertGreater(outward @ (corners.mean(axis=0) - at.mean(axis=0)), 0)
                for k, mid in enumerate(face[count:]):
                    np.testing.assert_allclose(nodes[mid], (corners[k] + corners[(k + 1) % count]) / 2)
        square = np.array([[0, 0], [1, 0], [0, 1.0]])
        self.assertEqual(len(signorini._meshes._Mesh("mesh", (square, {"quad": [[0, 1, 2, 2]]})).skin), 3)

    def test_cells_and_shapes_that_do_not_fit_are_named(self):
        at, bricks = self.upper[0], self.upper[1]["hexahedron"]
        for cells, words in (({"hexahedron": bricks, "wedge18": [range(18)]}, "slave: there is no type of cells 'wedge18'; "
                              "types: .*wedge15"),
                             ({"hexa": bricks}, "there is no type of cells 'hexa'; types: .* hexahedron,"),
                             (bricks, "slave: its cells have no type: give them as {'hexahedron': array}")):
            with self.assertRaisesRegex(ValueError, words):
                signorini.pair_meshes((at, cells), self.lower)
        floor = signorini.Plane(at.min(axis=0), [0, 0, -1])
        with self.assertRaisesRegex(signorini.SignoriniError, "shape of the slave: (node|face) .*: give slave_faces"):
            signorini.pair_meshes(self.upper, self.lower, slave_shape=floor)
        with self.assertRaisesRegex(signorini.SignoriniError, "shape of the master: (node|face) .*: give master_faces"):
            signorini.pair_meshes(self.upper, self.lower, master_shape=floor)

    def test_a_plane_mesh_with_three_coordinates(self):
        square = np.column_stack([CUBE[:4, :2], np.full(4, 3.0)])
        below = square - [0.3, 1.1, 0]
        contact = signorini.pair_meshes((square, {"quad": [[0, 1, 2, 3]]}), (below, {"quad": [[3, 2, 1, 0]]}))
        self.assertEqual((contact.dim, contact.pairs), (2, 2))
        np.testing.assert_allclose(contact.normals, [[0, -1]] * 2, atol=1e-14)
        np.testing.assert_allclose(contact.gaps, 0.1, atol=1e-14)
        bent = square + np.array([[0, 0, 0]] * 3 + [[0, 0, 0.1]])
        for mesh, kind, words in (
            ((bent, {"quad": [[0, 1, 2, 3]]}), ValueError, "slave has 3 coordinates .* cells of dimension 2"),
            ((square, {"quad": [[1, 2, 3, 4]]}), ValueError, "has the node 4, and there are 4 nodes"),
            ((square, {"line": [[0, 1]]}), ValueError, "no cells with an inside: give slave_faces"),
            ([1, 2, 3], TypeError, "slave is a list: give"),
        ):
            with self.assertRaisesRegex(kind, words):
                signorini.pair_meshes(mesh, (below, {"quad": [[0, 1, 2, 3]]}))

    def test_supports_by_equations(self):
        """Two bars of 5 and 7 squares, whose ends follow one node each, which is fixed, some through another one: their pairs are
        those of ends that are fixed themselves, and fewer than those of free ends."""
        def bar(count, low):
            x = 5 * np.arange(count + 1) / count
            at = np.vstack([np.column_stack([x, np.full_like(x, low + up)]) for up in (0, 1)])
            first = np.arange(count)
            cells = np.column_stack([first, first + 1, first + count + 2, first + count + 1])
            return at, {"quad": cells}

        slave, master = bar(5, 1.0), bar(7, 0.0)
        at = np.vstack([slave[0], master[0]])
        ends = [np.flatnonzero((at[:, 0] == x) & (part == body))
                for part in [np.arange(len(at)) >= len(slave[0])] for body in (0, 1) for x in (0, 5)]
        heads = [end[0] for end in ends]
        follow = [(2 * node + axis, [2 * before + axis], [1.0]) for end in ends for before, node in itertools.pairwise(end)
                  for axis in (0, 1)]
        size = 2 * len(at)
        K = np.ones(size), np.arange(size), np.arange(size + 1)

        def model(fixed, **settings):
            return signorini.Model.from_meshes(
                K, slave, master, fixed=fixed, settings=settings,
                slave_faces=lambda at: at[:, 1] == 1, master_faces=lambda at: at[:, 1] == 1)
        dofs = (2 * np.array(heads)[:, None] + [0, 1]).ravel()
        held = model((2 * np.concatenate(ends)[:, None] + [0, 1]).ravel())
        by_equations, by_fixed = model(dofs, equations=follow[::-1]).contact, held.contact
        self.assertLess(by_fixed.pairs, model(()).contact.pairs)
        np.testing.assert_array_equal(by_equations.nodes, by_fixed.nodes)
        for (dofs_of, weights), (known, exact) in zip(by_equations.rows, by_fixed.rows, strict=True):
            np.testing.assert_array_equal(dofs_of, known)
            np.testing.assert_array_equal(weights, exact)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for gap in (None, by_fixed.gaps + 0.1, by_fixed.gaps - 0.1):
                held.solve(np.zeros(size), gap)
        self.assertRegex("; ".join(str(warning.message) for warning in caught),
                         "^gap at slave node [14] is -0.1, a penetration, beside supports that hold both sides: [^;]*$")

    def test_model(self):
        """The two bodies apart, with a matrix each, give the forces of both in one matrix."""
        blocks, cut = self.blocks, 3 * self.below
        data, rows, starts = blocks.matrix
        split = starts[cut]
        lower = data[:split], rows[:split], starts[:cut + 1]
        upper = data[split:], rows[split:] - cut, starts[cut:] - split
        count = len(blocks.at) * 3 - cut
        model = signorini.Model.from_meshes((upper, lower), self.upper, self.lower, fixed=count + blocks.held)
        load = np.concatenate([blocks.press[cut:], blocks.press[:cut]])
        result = model.solve(load, mu=0.6)
        whole = signorini.Model.from_surfaces(blocks.matrix, self.by_faces, fixed=blocks.held)
        expected = whole.solve(blocks.press, mu=0.6)
        self.assertEqual(result.status, signorini.Status.SOLVED)
        # Both are certified to 1e-10 of the forces; conditions are some 1e3.
        np.testing.assert_allclose(result.F, expected.F, atol=1e-7 * abs(expected.F).max())
        self.assertIs(result.contact, model.contact)
        sparse = signorini.Model.from_meshes((upper, lower), self.upper, self.lower, fixed=count + blocks.held,
                                             settings={"full_space": True})
        self.assertEqual(sparse.kind, signorini.ModelKind.FULL_SPACE)
        np.testing.assert_allclose(sparse.solve(load, mu=0.6).F, result.F, atol=1e-7 * abs(expected.F).max())
        with self.assertRaisesRegex(TypeError, "gap is None"):
            signorini.Model.condensed(np.eye(2)).solve([1, 1])


if __name__ == "__main__":
    unittest.main()
