"""The Python package: pairs from surfaces, fields on them, files of meshes.

    python3 tests/python/surfaces.py
"""

import base64
import copy
import gc
import os
import re
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import numpy as np

from common import ROOT

import signorini

sys.path.insert(0, os.path.join(ROOT, "c_examples", "3d"))
import brick_mesh  # noqa: E402

# A line of one element, 0 to 1, 0.1 above one of two elements, -1 to 2.
NODES = np.array([[0, 0.1], [1, 0.1], [-1, 0], [0.5, 0], [2, 0]])
SLAVE, MASTER = [[0, 1]], [[4, 3], [3, 2]]


def arrays_of(path):
    """The arrays of a .vtu file by their names."""
    with open(path, encoding="ascii") as file:
        text = file.read()
    kinds = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}
    found = {}
    pattern = r'<DataArray type="(\w+)" Name="(\w+)" NumberOfComponents="(\d)" format="binary">\n(.*)\n'
    for kind, name, width, data in re.findall(pattern, text):
        data = base64.b64decode(data)
        assert int.from_bytes(data[:8], "little") == len(data) - 8
        values = np.frombuffer(data[8:], kinds[kind])
        found[name] = values if width == "1" else values.reshape(-1, int(width))
    return found


class Pairs(unittest.TestCase):
    def test_the_share_of_the_summary_is_that_of_all_faces_given(self):
        """Of three slave faces of the length 1 one lies over a near master, one over a far one, and one over nothing."""
        x = [[0, 0], [1, 0], [2, 0], [3, 0], [0, -0.1], [1, -0.1], [1.2, -9], [1.8, -9]]
        found = signorini.pair_surfaces(x, [[0, 1], [1, 2], [2, 3]], [[5, 4], [7, 6]], search_distance=0.5, rims="keep")
        self.assertIn("on 33.33 % of the slave area", found.summary)
        self.assertIn("1 slave faces point at a master beyond the search distance of 0.5, the nearest, face 1, at 9",
                      found.summary)
        self.assertEqual((found.uncovered.tolist(), found.beyond.tolist()), ([1, 2], [1]))

    def test_first_tangents(self):
        """A flat face whose nodes stand off it by rounding has one first tangent: that of an axis, or as it is asked for."""
        square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
        x = np.concatenate([square + [[0, 0, 1e-16], [0, 0, 0], [0, 0, -3e-16], [0, 0, 2e-16]], square])
        for tangent, expected in ((None, [1, 0, 0]), ((0, 5, 1), [0, 1, 0]), ((1, -1, 0), [np.sqrt(0.5), -np.sqrt(0.5), 0])):
            found = signorini.pair_surfaces(x, [[3, 2, 1, 0]], [[4, 5, 6, 7]], tangent=tangent)
            np.testing.assert_allclose(found.tangents, [expected] * 4, atol=1e-14)
            np.testing.assert_array_equal(copy.deepcopy(found).tangents, found.tangents)
        with self.assertRaisesRegex(signorini.SignoriniError, "tangent: NaN, 0, 0 is no direction"):
            signorini.pair_surfaces(x, [[3, 2, 1, 0]], [[4, 5, 6, 7]], tangent=(np.nan, 0, 0))
        with self.assertRaisesRegex(ValueError, "tangent has the shape"):
            signorini.pair_surfaces(x, [[3, 2, 1, 0]], [[4, 5, 6, 7]], tangent=(1, 0))

    def test_adjusted(self):
        contact, down = signorini.pair_surfaces(NODES, SLAVE, MASTER), NODES.copy()
        down[:2, 1] = 0
        np.testing.assert_allclose(contact.adjusted(), down, atol=1e-15)
        np.testing.assert_array_equal(contact.adjusted(0.05), NODES)
        with self.assertRaisesRegex(signorini.SignoriniError, "within is -1, it must not be negative"):
            contact.adjusted(-1)
        np.testing.assert_allclose(contact.adjusted(moves=2), down, atol=1e-15)
        for within, moves in ((np.inf, 0), (0.05, 2)):
            with self.assertRaisesRegex(ValueError, "give at least 1, and 1 with a limit within"):
                contact.adjusted(within, moves)

    def test_copies_hold_the_pairs_too(self):
        functions = signorini._library.library()
        with mock.patch.object(functions, "surface_free", wraps=functions.surface_free) as free:
            contact = signorini.pair_surfaces(NODES, SLAVE, MASTER)
            again, rows = copy.copy(contact), contact.rows
            del contact
            gc.collect()
            free.assert_not_called()
            np.testing.assert_array_equal(again.rows[0][1], rows[0][1])
            del again
            gc.collect()
            free.assert_called_once()

    def test_changed_gaps_are_those_of_fields(self):
        """A line on springs is pressed down by more than its gap, with a clearance: what is closed has none left."""
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER)
        contact.gaps += 0.1
        model = signorini.Model.from_surfaces((np.ones(10), np.arange(10), np.arange(11)), contact, fixed=range(4, 10))
        result = model.solve([0, -0.4, 0, -0.4] + [0] * 6, mu=0.0)
        np.testing.assert_allclose(result.d[:, 0], 0.2, atol=1e-12)
        np.testing.assert_allclose(contact.fields(result).clearance[:2], 0, atol=1e-12)
        np.testing.assert_allclose(contact.fields(result, gap=0.3).clearance[:2], 0.1, atol=1e-12)

    def test_by_hand(self):
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER)
        self.assertEqual((contact.dim, contact.pairs), (2, 2))
        np.testing.assert_allclose(contact.gaps, 0.1, atol=1e-15)
        np.testing.assert_allclose(contact.areas, 0.5, atol=1e-15)
        np.testing.assert_allclose(contact.normals, [[0, -1]] * 2, atol=1e-15)
        np.testing.assert_allclose(contact.points, NODES[:2], atol=1e-15)
        self.assertEqual(contact.nodes.tolist(), [0, 1])
        self.assertEqual(contact.report.uncovered, 0)
        self.assertIn("2 pairs on 100.00 % of the slave area", contact.summary)

    def test_faces_of_several_kinds_and_other_degrees_of_freedom(self):
        places = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0.0]])
        floor = signorini.Plane([0, 0, -0.5], [0, 0, 1])
        faces = [[0, 3, 2, 1], [1, 2, 4]]  # seen from below
        for more in ({}, {"dofs_per_node": 6}, {"dofs": 7 * np.arange(5)[:, None] + [0, 1, 2]}):
            contact = signorini.pair_obstacle(places, faces, floor, **more)
            np.testing.assert_allclose(contact.areas.sum(), 1.5)
            np.testing.assert_allclose(contact.gaps, 0.5)

    def test_obstacles(self):
        below = NODES - [0.5, -1.1]
        for obstacle, gap in ((signorini.Sphere([0, 0], 1.0), 0.3),
                              (signorini.Sphere([0, 0], 2.0, hollow=True), 0.7)):
            slave = SLAVE if gap == 0.3 else [[1, 0]]
            contact = signorini.pair_obstacle(below, slave, obstacle)
            np.testing.assert_allclose(contact.gaps, gap)  # (0.5, 1.2) is 1.3 from the centre
        with self.assertRaisesRegex(ValueError, "Plane.* has a place or a direction of 2 numbers: give 3"):
            signorini.pair_obstacle(np.eye(3), [[0, 1, 2]], signorini.Plane([0, 0], [0, 1]))
        with self.assertRaisesRegex(TypeError, "give a Plane, Sphere, Cylinder, Cone"):
            signorini.pair_obstacle(NODES, SLAVE, "floor")

    def test_a_rigid_mesh(self):
        lower = [[node - 2 for node in face] for face in MASTER]
        contact = signorini.pair_obstacle(NODES, SLAVE, signorini.RigidFaces(NODES[2:], lower))
        both = signorini.pair_surfaces(NODES, SLAVE, MASTER)
        np.testing.assert_array_equal(contact.gaps, both.gaps)
        with self.assertRaisesRegex(signorini.SignoriniError, "obstacle face 0 has node 4"):
            signorini.pair_obstacle(NODES, SLAVE, signorini.RigidFaces(NODES[2:], MASTER))

    def test_planes_of_symmetry(self):
        # Node 0 stands on the line x = 0: it is all that its row names across it.
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER, symmetry=[(0, 0.0)])
        self.assertEqual(contact.report.on_symmetry, 1)
        self.assertIn("1 of the pairs on planes of symmetry", contact.summary)
        self.assertEqual(signorini.pair_surfaces(NODES, SLAVE, MASTER).report.on_symmetry, 0)
        model = signorini.Model.from_surfaces((np.full(10, 2.0), np.arange(10), np.arange(11)), contact, fixed=[0])
        load = np.zeros(10)
        load[[1, 3, 2]] = -1, -1, 0.1
        result = model.solve(load, gap=contact.gaps, mu=0.3)
        self.assertEqual((result.d[0, 1], result.F[0, 1]), (0, 0))
        self.assertNotEqual(result.F[1, 1], 0)

    def test_choices(self):
        # The side and the bottom of a block, a sharp edge at node 1; a tenth of the last face is covered.
        nodes = np.array([[0, 1.1], [0, 0.1], [1, 0.1], [1.2, 0.1], [-1, 0], [1.02, 0]])
        sides, floor = [[0, 1], [1, 2], [2, 3]], [[5, 4]]
        for pairing in signorini.Pairing:
            # Against surfaces the side has its say.
            averaged = [0, -1] if pairing == signorini.Pairing.DUAL_MORTAR else [-np.sqrt(0.5)] * 2
            for normals, normal in (("averaged", averaged), (signorini.Normals.FACES, [0, -1])):
                contact = signorini.pair_surfaces(nodes, sides, floor, pairing=pairing, normals=normals,
                                                  search_distance=0.5)
                np.testing.assert_allclose(contact.normals[0], normal, atol=1e-15)
        for rims, numbers in (("fold", (2, 1)), (signorini.Rims.KEEP, (3, 0))):
            contact = signorini.pair_surfaces(nodes, sides, floor, rims=rims, search_distance=0.5)
            report = contact.report
            self.assertEqual((report.pairs, report.folded), numbers)
            np.testing.assert_allclose(contact.folded_distances, [0.2] * report.folded)
            self.assertEqual(contact.unpaired.tolist(), [0, 3] if report.pairs == 2 else [0])
        rigid = signorini.pair_obstacle(nodes[:4], sides, signorini.RigidFaces(nodes[4:], [[1, 0]]),
                                        normals="faces", rims="keep", search_distance=0.5)
        np.testing.assert_allclose(rigid.normals, [[0, -1]] * 3, atol=1e-15)

    def test_limits_and_rings(self):
        told = []
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER, progress=told.append)
        self.assertTrue(contact.pairs > 0 and told and 0 <= told[0].reduced <= 1)
        for limits, part in (({"time_limit": 1e-12}, "time limit"), ({"progress": lambda told: True}, "cancelled")):
            with self.assertRaisesRegex(signorini.SignoriniError, part):
                signorini.pair_surfaces(NODES, SLAVE, MASTER, **limits)
        with self.assertRaises(ZeroDivisionError):
            signorini.pair_surfaces(NODES, SLAVE, MASTER, progress=lambda told: 1 / 0)
        disc = np.array([[0.0, 0], [1, 0], [0, 0], [1, 0]])
        contact = signorini.pair_surfaces(disc, [[0, 1]], [[3, 2]], axisymmetric=True)
        np.testing.assert_allclose(contact.areas, np.pi * np.array([1, 2]) / 3)

    def test_true_shapes(self):
        """Arcs of one division of 60 degrees, the outer one wider, at the radii 1 and 1.01; spheres."""
        circle = signorini.Sphere([0, 0], 1.0)
        for kind, dim in (("arcs", 2), ("cylinders", 3)):
            inner, outer = (np.array([[-np.sin(half), np.cos(half)], [np.sin(half), np.cos(half)]])
                            for half in np.radians([30, 40]))
            nodes = np.concatenate([inner, 1.01 * outer])
            slave, master, shapes = [[1, 0]], [[2, 3]], (circle, circle._replace(radius=1.01))
            if dim == 3:
                nodes = np.array([[x, y, z] for x, y in nodes for z in (0.0, 1.0)])
                slave, master = [[2, 0, 1, 3]], [[4, 6, 7, 5]]
                shapes = [signorini.Cylinder([0, 0, 5], [0, 0, 1], radius) for radius in (1.0, 1.01)]
            found = [signorini.pair_surfaces(nodes, slave, master, slave_shape=slave_shape,
                                             master_shape=master_shape, close_within=within, clearance=-0.5)
                     for slave_shape, master_shape, within in ((*shapes, 0), (None, None, 0), (*shapes, 0.1))]
            for contact, gap in zip(found, (0.01, 1.01 * np.cos(np.radians(40)) - np.cos(np.radians(30)), 0.0)):
                np.testing.assert_allclose(contact.gaps, [gap - 0.5] * 2 ** (dim - 1), atol=1e-12, err_msg=kind)
        around = np.radians(np.arange(0, 181, 20))
        circles = np.concatenate([r * np.column_stack([np.cos(around), np.sin(around)]) for r in (1.0, 1.01)])
        lines = np.column_stack([np.arange(9), np.arange(1, 10)])
        contact = signorini.pair_surfaces(circles, lines[1:-1], lines[:, ::-1] + 10, fitted=True)
        np.testing.assert_allclose(contact.gaps, 0.01, atol=1e-5)
        with self.assertRaisesRegex(TypeError, "is no shape"):
            signorini.pair_surfaces(nodes, slave, master, slave_shape=3.0)

    def test_cone_and_torus(self):
        """Above a cone of 45 degrees whose apex is the origin, and beside a ring of the tube 0.5."""
        nodes, face = np.array([[1.0, 0, 0], [2, 0, 0], [2, 1, 0]]), [[0, 2, 1]]
        cone = signorini.Cone([0, 0, -3], [0, 0, 3], 3.0)
        contact = signorini.pair_obstacle(nodes, face, cone, clearance=1.0)
        across = np.linalg.norm(nodes[:, :2], axis=1)
        np.testing.assert_allclose(contact.gaps, across * np.sqrt(0.5) + 1)
        contact = signorini.pair_obstacle(nodes, face, signorini.Torus([0, 0, 0], [0, 0, 7], 0.5, 4.0))
        np.testing.assert_allclose(contact.gaps, 4 - across - 0.5)
        for ring in (0.0, -4.0):
            with self.assertRaisesRegex(ValueError, "give a positive radius"):
                signorini.pair_obstacle(nodes, face, signorini.Torus([0, 0, 0], [0, 0, 7], 0.5, ring))
        with self.assertRaisesRegex(ValueError, r"axis of a Torus is \[0 0 0\]: give the direction across its ring"):
            signorini.pair_obstacle(nodes, face, signorini.Torus([0, 0, 0], [0, 0, 0], 0.5, 4.0))

    def test_never_meet(self):
        apart = NODES + np.array([[0, 5]] * 2 + [[0, 0]] * 3)
        contact = signorini.pair_surfaces(apart, SLAVE, MASTER)
        self.assertEqual((contact.pairs, contact.gaps.shape), (0, (0,)))
        self.assertEqual(contact.unpaired.tolist(), [0, 1])
        self.assertEqual(contact.uncovered.tolist(), [0])
        self.assertIn("nothing lies opposite", contact.summary)
        self.assertEqual(contact.beyond.tolist(), [0])
        self.assertIn("1 slave faces point at a master beyond the search distance", contact.summary)

    def test_refusals(self):
        for kind, part, arguments, keywords in (
            (ValueError, r"coordinates has the shape \(10,\)", (NODES.ravel(), SLAVE, MASTER), {}),
            (ValueError, r"slave has the shape \(2,\)", (NODES, np.array([0, 1]), MASTER), {}),
            (TypeError, r"slave\[0\] holds float64", (NODES, [[0.0, 1.0]], MASTER), {}),
            (ValueError, "pairing is 'mortar'", (NODES, SLAVE, MASTER), {"pairing": "mortar"}),
            (ValueError, "normals is 'mean'", (NODES, SLAVE, MASTER), {"normals": "mean"}),
            (ValueError, "rims is 'cut'", (NODES, SLAVE, MASTER), {"rims": "cut"}),
            (signorini.SignoriniError, "rims: nodes against surfaces have no cover", (NODES, SLAVE, MASTER),
             {"pairing": "node_to_surface", "rims": "keep"}),
            (ValueError, r"dofs has the shape", (NODES, SLAVE, MASTER), {"dofs": [1, 2]}),
            (signorini.SignoriniError, "slave face 0 has node 1 twice", (NODES, [[1, 1]], MASTER), {}),
            (signorini.SignoriniError, "search_distance is -1", (NODES, SLAVE, MASTER),
             {"search_distance": -1}),
            (TypeError, "search_distance is None: give a number", (NODES, SLAVE, MASTER), {"search_distance": None}),
            (TypeError, "master is a Plane: .* pair_obstacle", (NODES, SLAVE, signorini.Plane((0, 0), (0, 1))), {}),
            (TypeError, "slave is None: give the nodes", (NODES, None, MASTER), {}),
            (ValueError, r"symmetry\[0\] names axis 0.5: give 0 or 1, or a direction", (NODES, SLAVE, MASTER),
             {"symmetry": [(0.5, 0.0)]}),
            (ValueError, r"symmetry\[1\] names axis 2: give 0 or 1", (NODES, SLAVE, MASTER),
             {"symmetry": [(1, 9.0), (2, 0.0)]}),
            (ValueError, r"symmetry\[0\] has the shape \(3,\)", (NODES, SLAVE, MASTER),
             {"symmetry": [((0, 1, 0), 0.0)]}),
            (signorini.SignoriniError, "its normal 0, 0, 0 is no direction in 2 dimensions", (NODES, SLAVE, MASTER),
             {"symmetry": [((0, 0), 0.0)]}),
            (ValueError, "count of a Sector is 0", (NODES, SLAVE, MASTER), {"sector": (0, (0, 0))}),
            (ValueError, "count of a Sector is 1: give", (NODES, SLAVE, MASTER), {"sector": (1, (0, 0))}),
            (ValueError, r"count of a Sector is 5\.0: .* an integer", (NODES, SLAVE, MASTER), {"sector": (5.0, (0, 0))}),
            (TypeError, "sector is 5: give a Sector", (NODES, SLAVE, MASTER), {"sector": 5}),
            (TypeError, r"symmetry is \(1, 0\.0\): give a list of planes", (NODES, SLAVE, MASTER), {"symmetry": (1, 0.0)}),
            (TypeError, "symmetry is None: give a list", (NODES, SLAVE, MASTER), {"symmetry": None}),
            (TypeError, r"symmetry is \[\(0, \(0, 0\)\)\]: .* a number", (NODES, SLAVE, MASTER), {"symmetry": [(0, (0, 0))]}),
            (signorini.SignoriniError, "a body of revolution has no sector", (NODES, SLAVE, MASTER),
             {"sector": (3, (0, 0)), "axisymmetric": True}),
            (signorini.SignoriniError, "axis 0 at 0.5, has slave nodes on both sides, 0 and 1",
             (NODES, SLAVE, MASTER), {"symmetry": [(0, 0.5)]}),
        ):
            with self.assertRaisesRegex(kind, part):
                signorini.pair_surfaces(*arguments, **keywords)
        with self.assertRaisesRegex(ValueError, "zones is empty"):
            signorini.Model.from_surfaces((np.ones(2), np.arange(2), np.arange(3)), [])
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER)
        with self.assertRaisesRegex(TypeError, "result is a ndarray: give what Model.solve returned"):
            contact.resultant(np.zeros(4))
        with self.assertRaisesRegex(TypeError, "cells is None: give the nodes of the cells"):
            signorini.write_mesh("nowhere.vtu", NODES, None)


class Blocks(unittest.TestCase):
    """The two blocks of c_examples/3d, whose nodes do not match."""

    def test_fields_are_those_of_the_forces(self):
        blocks = brick_mesh.two_blocks()
        contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
        model = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=blocks.held)
        load = blocks.press + 1e5 * blocks.twist
        result = model.solve(load, gap=contact.gaps, mu=0.6)
        u = model.recover(result.d, load)
        fields = contact.fields(result)
        np.testing.assert_allclose(fields.pressure[contact.nodes], -result.F[:, 0] / contact.areas)
        in_global = np.einsum("pi,pij->pj", result.F, model.frames)
        np.testing.assert_allclose(fields.traction[contact.nodes],
                                   in_global / contact.areas[:, None], atol=1e-12)
        # 1e-9: rounding of sums of some hundred forces, relative to the press.
        sums = contact.resultant(result, [0, 0, 3.0])
        np.testing.assert_allclose(sums.force, in_global.sum(axis=0), atol=1e-9 * 4e4)
        arms = contact.points - [0, 0, 3.0]
        np.testing.assert_allclose(sums.moment, np.cross(arms, in_global).sum(axis=0),
                                   atol=1e-9 * 4e4 * 30)
        self.assertGreater(sums.friction_work, 0)
        self.assertTrue((fields.state[blocks.at[:, 2] != 0] == -1).all())

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "blocks.vtu")
            contact.write(path, {"hexahedron": blocks.bricks}, result, u)
            found = arrays_of(path)
            self.assertTrue((found["displacement"].ravel() == u).all())
            self.assertTrue((found["pressure"] == fields.pressure).all())
            self.assertTrue((found["slip"] == fields.slip).all())
            self.assertTrue((found["state"] == fields.state).all())
            self.assertTrue((found["connectivity"] == blocks.bricks.ravel()).all())
            self.assertTrue((found["types"] == 12).all())
            with self.assertRaisesRegex(ValueError, "displacements of all degrees"):
                contact.write(path, {"hexahedron": blocks.bricks}, result, u[:10])

    def test_slips_beyond_a_face(self):
        """Springs of 1 let a line on another slip by its loads: by more than a face of length 1 is told, on a plane it is not."""
        at = np.array([[0, 0], [1, 0], [2, 0], [0, 0], [1, 0], [2, 0.0]])
        springs, load = (np.ones(12), np.arange(12), np.arange(13)), np.zeros((3, 2))
        load[:, 1] = -1
        lines = signorini.pair_surfaces(at, [[0, 1], [1, 2]], [[5, 4], [4, 3]])
        plane = signorini.pair_obstacle(at, [[0, 1], [1, 2]], signorini.Plane((0, 0), (0, 1)))
        for push, contact, is_told in (1.1, lines, True), (0.9, lines, False), (5.0, plane, False):
            for named in contact, {"line": contact}:
                load[:, 0] = push
                model = signorini.Model.from_surfaces(springs, named)
                with warnings.catch_warnings(record=True) as told:
                    warnings.simplefilter("always")
                    result = model.solve(np.r_[load.ravel(), np.zeros(6)], mu=0.0)
                np.testing.assert_allclose(result.d[:, 1], np.full(3, result.d[0, 1]), atol=1e-12)
                self.assertAlmostEqual(abs(result.d[0, 1]), push)
                of = "zone 'line': " if isinstance(named, dict) else ""
                self.assertEqual([str(one.message).startswith(f"{of}3 pairs slip by more than their faces are long, that of slave node ")
                                  for one in told], [True] * is_told)

    def test_facets_of_a_press_fit(self):
        """Facets of 40 and 24 sides take more than an interference of 1e-3 away: a case is warned of, but one with gaps of its own."""
        def ring(count):
            angles = 2 * np.pi * np.arange(count) / count
            return np.stack([np.cos(angles), np.sin(angles)], 1), np.arange(count)[:, None] + [0, 1]
        (pin, inner), (hole, outer) = ring(24), ring(40)
        places, springs = np.concatenate([pin, hole]), (np.ones(128), np.arange(128), np.arange(129))
        contact = signorini.pair_surfaces(places, inner % 24, 24 + outer[:, ::-1] % 40, clearance=-1e-3)
        for named, of in ((contact, ""), ({"fit": contact}, "zone 'fit': ")):
            model = signorini.Model.from_surfaces(springs, named)
            for gap in None, contact.gaps, {"fit": contact.gaps}, np.stack([contact.gaps] * 2):
                if isinstance(gap, dict) and not of:
                    continue
                loads = np.zeros((2, 128) if np.ndim(gap) == 2 else 128)
                with self.assertWarnsRegex(UserWarning, f"^{of}at 24 pairs facets change .* larger than the interference"):
                    model.solve(loads, gap, mu=0.0)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                model.solve(np.zeros(128), gap=-1e-3, mu=0.0)

    def test_deep_overlaps_beside_pairs(self):
        """Slave faces of 1 / 50 over a line that rises by .1 into their body: those that overlap by more have no pairs, which is warned of."""
        count = 50
        fine = np.stack([np.arange(count + 1) / count, np.zeros(count + 1)], 1)
        places = np.concatenate([fine, [[0.0, -0.0013], [1.0, 0.0987]]])
        slave, size = np.arange(count)[:, None] + [0, 1], 2 * len(places)
        springs = (np.ones(size), np.arange(size), np.arange(size + 1))
        for named, of in ((lambda one: one, ""), (lambda one: {"fit": one}, "zone 'fit': ")):
            contact = signorini.pair_surfaces(places, slave, [[count + 2, count + 1]])
            middles = (np.arange(count) + 0.5) / count
            deep = np.flatnonzero(0.1 * middles - 0.0013 > 1 / count)
            self.assertEqual(contact.beyond.tolist(), deep.tolist())
            most = f"{0.1 * middles[-1] - 0.0013:.4g}"
            with self.assertWarnsRegex(UserWarning, f"^{of}{len(deep)} slave faces overlap a master by more .* face 49 by {most}: .* above {most}"):
                signorini.Model.from_surfaces(springs, named(contact))
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                whole = signorini.pair_surfaces(places, slave, [[count + 2, count + 1]], search_distance=0.1)
                signorini.Model.from_surfaces(springs, named(whole))

    def test_any_mesh(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "plane.vtu")
            cells = [("triangle", [[0, 1, 2]]), ("line", SLAVE)]
            signorini.write_mesh(path, NODES, cells, {"x": NODES, "far": [np.inf] * 5})
            found = arrays_of(path)
            self.assertTrue((found["x"][:, :2] == NODES).all() and (found["x"][:, 2] == 0).all())
            self.assertTrue(np.isinf(found["far"]).all())
            self.assertEqual(found["offsets"].tolist(), [3, 5])
            for part, cells, fields in (
                ("there is no type 'brick'", {"brick": [[0, 1]]}, {}),
                ("field x has the shape", cells, {"x": [1.0]}),
            ):
                with self.assertRaisesRegex(ValueError, part):
                    signorini.write_mesh(path, NODES, cells, fields)
            with self.assertRaisesRegex(signorini.SignoriniError, "cell 0 has 2 nodes"):
                signorini.write_mesh(path, NODES, {"triangle": SLAVE})


if __name__ == "__main__":
    unittest.main()
