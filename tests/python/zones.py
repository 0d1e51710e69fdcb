"""Several contact zones in one model: three lines above each other, each node on a spring, in closed form.

Springs of 1, 2 and 4, gaps of 0.2 and 0.1, loads of 4 on the upper lines, downwards: the gaps close, and with the
pressures p and q of a node  (4 - p) / 1 - (4 + p - q) / 2 = 0.2  and  (4 + p - q) / 2 - q / 4 = 0.1,
so p = 92 / 35, q = 30 / 7.
"""

import os
import pickle
import tempfile
import unittest
import warnings
from xml.etree import ElementTree

import numpy as np

import common  # noqa: F401 (the package's place)
import signorini
from signorini import State, Status

from surfaces import arrays_of

LINES = np.array([[0, 0.3], [1, 0.3], [0, 0.1], [1, 0.1], [0, 0], [1, 0]])


class Zones(unittest.TestCase):

    def setUp(self):
        springs = (np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13))
        self.contacts = {name: signorini.pair_surfaces(LINES, [[upper, upper + 1]], [[upper + 3, upper + 2]])
                         for name, upper in (("above", 0), ("below", 2))}
        self.model = signorini.Model.from_surfaces(springs, self.contacts)
        self.load = np.zeros(12)
        self.load[[1, 3, 5, 7]] = -4

    def test_a_list_of_them_is_their_dict(self):
        springs = (np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13))
        model = signorini.Model.from_surfaces(springs, list(self.contacts.items()))
        self.assertEqual(*(repr(one.solve(self.load, mu=0.3).table()) for one in (model, self.model)))

    def test_forces_are_those_of_the_closed_form(self):
        p, q = np.linalg.solve([[1.5, -0.5], [-0.5, 0.75]], [4 - 2 - 0.2, 2 - 0.1])
        result = self.model.solve(self.load, mu=0.3)
        self.assertEqual(result.status, Status.SOLVED)
        for name, pressure in (("above", p), ("below", q)):
            part = result.zone(name)
            # Results are certified to 1e-10 of forces of size four.
            np.testing.assert_allclose(part.F, [[-pressure, 0]] * 2, atol=1e-9)
            self.assertIs(part.contact, self.contacts[name])
        for row, pressure in zip(result.table(), (p, q)):
            self.assertEqual((row.pairs, row.open, row.slip + row.stick), (2, 0, 2))
            np.testing.assert_allclose(row.force, [0, 2 * pressure, 0], atol=1e-9)
            self.assertAlmostEqual(row.pressed_area, 1)

    def test_what_passes_through_without_a_pair_is_told(self):
        """The upper line falls by 4 / 1 and the middle one by 4 / 2: the upper one passes through by 2 - 0.2."""
        above = signorini.pair_surfaces(LINES, [[0, 1]], [[3, 2]], search_distance=0.05)
        contacts = {"above": above, "below": self.contacts["below"]}
        springs = (np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13))
        held = self.model.solve(self.load, mu=0.3)
        self.assertIsNone(held.penetration)
        model = signorini.Model.from_surfaces(springs, contacts)
        with self.assertWarnsRegex(UserWarning, "3 nodes and middles .* have passed .* larger search_distance"):
            result = model.solve(self.load, mu=0.3)
        middle = (4 / 2 - 0.1) / (1 / 2 + 1 / 4) / 4 + 0.1  # what the middle line falls by on the lower one
        self.assertAlmostEqual(result.penetration.depth, 4 - middle - 0.2, delta=1e-8)
        self.assertEqual(result.penetration.points, 3)
        self.assertAlmostEqual(result.penetration.point[1], 0.3 - 4)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertIsNone(model.solve(self.load, mu=0.3, penetration=False).penetration)
        pickled = pickle.loads(pickle.dumps(result))
        self.assertEqual(pickled.penetration.sentence, result.penetration.sentence)
        with self.assertWarnsRegex(UserWarning, "have passed"):
            loads = np.outer([1.0, 0.0, 0.5] * 20, self.load)
            depths = [one.penetration and one.penetration.depth for one in model.solve(loads, mu=0.3)]
        self.assertEqual(depths[:2], [result.penetration.depth, None])
        self.assertTrue(0 < depths[2] < depths[0])
        self.assertEqual(depths, depths[:3] * 20)
        # One pair that never touches, and rounding, say nothing of the others; a clearance of 4 lets all pass by.
        gaps = contacts["below"].gaps
        for below in ([gaps[0], np.inf], gaps + 1e-12):
            with self.assertWarnsRegex(UserWarning, "have passed"):
                self.assertIsNotNone(model.solve(self.load, {"above": [], "below": below}, 0.3).penetration)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertIsNone(model.solve(self.load, {"above": [], "below": gaps + 4.0}, 0.3).penetration)

    def test_larger_gaps_let_pass_by_where_they_are(self):
        """Two lines of five nodes on springs over a fixed line, far from each other; the middle of each has a pair, and the others
        are beyond its search distance and fall through by 1 - 0.2."""
        one = np.array([[0, 0.2], [1, 0.2], [2, 0.01], [3, 0.2], [4, 0.2], [0, 0], [2, 0], [4, 0.0]])
        at = np.vstack([one, one + [10, 0]])
        lines = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
        contacts = {name: signorini.pair_surfaces(at, first + lines, first + np.array([[6, 5], [7, 6]]), search_distance=0.05,
                                                  pairing="node_to_surface")
                    for name, first in (("left", 0), ("right", 8))}
        fixed = np.concatenate([np.arange(2 * first + 10, 2 * first + 16) for first in (0, 8)])
        load = np.zeros((16, 2))
        load[[0, 1, 3, 4, 8, 9, 11, 12], 1] = -1
        springs = np.ones(32), np.arange(32), np.arange(33)
        both = {"both": signorini.pair_surfaces(at, np.vstack([lines, 8 + lines]), [[6, 5], [7, 6], [14, 13], [15, 14]],
                                                search_distance=0.05, pairing="node_to_surface")}
        # Penetration without a larger gap is told, by zone and within a zone.
        for zones, gaps in ((contacts, {"left": 0.0, "right": 1.0}), (both, {"both": [0.0, 1.0]})):
            model = signorini.Model.from_surfaces(springs, zones, fixed=fixed)
            load[8:13, 1] *= 0.9  # the left one falls deeper
            with self.assertWarnsRegex(UserWarning, "have passed"):
                found = model.solve(load.ravel(), gaps, 0.0).penetration
            self.assertAlmostEqual(found.point[1], 0.2 - 1)
            self.assertLess(found.point[0], 5)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                wide = {name: 1.0 for name in zones}
                self.assertIsNone(model.solve(load.ravel(), wide, 0.0).penetration)
        # A zone without a pair stands on bodies of its own.
        at[2, 1] = 0.2
        none = signorini.pair_surfaces(at, lines, [[6, 5], [7, 6]], search_distance=0.05, pairing="node_to_surface")
        with self.assertWarnsRegex(UserWarning, "no pairs"):
            model = signorini.Model.from_surfaces(springs, {"left": none, "right": contacts["right"]}, fixed=fixed)
        with self.assertWarnsRegex(UserWarning, "have passed"):
            self.assertLess(model.solve(load.ravel(), {"left": 0.0, "right": 1.0}, 0.0).penetration.point[0], 5)

    def test_gaps_of_a_step_at_a_cut(self):
        """A line over a plane in two zones, each node on a spring of 1 and pressed by 1. A zone without an obstacle takes none of
        the other's; parts of a result have the clearances of the step's gaps, from those of their own zone."""
        x = np.array([[0, 0], [1, 0], [2, 0.0]])
        plane = signorini.Plane((0, 0), (0, 1))
        zones = {name: signorini.pair_obstacle(x, [[node, node + 1]], plane) for name, node in (("left", 0), ("right", 1))}
        K = np.ones(6), np.arange(6), np.arange(7)
        load = np.tile([0, -1.0], 3)
        model = signorini.Model.from_surfaces(K, zones)
        # A node of the cut has the mean gap of those zones that have an obstacle.
        for gap, fallen in (({"left": 0.25, "right": np.inf}, [0.25, 0.25, 1]), ({"left": 0.25, "right": 0.5}, [0.25, 0.375, 0.5]),
                            ({"left": np.inf, "right": np.inf}, [1, 1, 1]), (0.5, [0.5, 0.5, 0.5])):
            result = model.solve(load, gap, penetration=False)
            self.assertEqual(result.status, Status.SOLVED)
            np.testing.assert_allclose(-model.recover(result.d, load)[1::2], fallen, atol=1e-12)
            for name, nodes in (("left", [0, 1]), ("right", [1, 2])):
                own = gap[name] if isinstance(gap, dict) else gap
                if np.isinf(own):
                    continue
                part = result.zone(name)
                # What presses is closed, as far as the zone can tell.
                clearance = zones[name].fields(part, gap=np.full(2, own)).clearance[nodes]
                np.testing.assert_allclose(clearance, 0, atol=1e-12)

    def line(self, K):
        """A line over a plane in two zones, and its model; K: of each node in (u_x, u_y), d = (-u_y, u_x)."""
        x = np.array([[0, 0], [1, 0], [2, 0.0]])
        plane = signorini.Plane((0, 0), (0, 1))
        zones = {name: signorini.pair_obstacle(x, [[node, node + 1]], plane) for name, node in (("left", 0), ("right", 1))}
        rows = 2 * np.repeat(np.arange(3), 4) + np.tile([0, 1], 6)
        return zones, signorini.Model.from_surfaces((np.tile(np.ravel(K), 3), rows, 2 * np.arange(7)), zones)

    def test_parts_have_the_gaps_and_slips_of_their_case(self):
        """Springs of 1, pushed by (1, -2) over gaps; thresholds of 1 / 4 leave motions of 3 / 4. The middle pair has the slip0 of
        the left zone."""
        zones, model = self.line(np.eye(2))
        gap, slip0 = {"left": 0.25, "right": 0.5}, {"left": 0.125, "right": 0.375}
        load = np.tile([1.0, -2.0], 3)
        solved = model.solve(load, gap, g=0.25, slip0=slip0, penetration=False)
        gap["left"] = 7.0  # the caller's dict changes for the next step
        measured = model.certify(load, {"left": 0.25, "right": 0.5}, g=0.25, slip0=slip0, d=solved.d)
        slips, work = [0.625, 0.625, 0.375], {"left": 0.25 * 0.625 * 1.5, "right": 0.25 * (0.625 / 2 + 0.375)}
        for result in solved, measured, pickle.loads(pickle.dumps(solved))._replace(contact=solved.contact):
            self.assertEqual(result.status, Status.SOLVED)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "line.vtu")
                result.contact.write(path, {"line": [[0, 1], [1, 2]]}, result)
                written = arrays_of(path)
            np.testing.assert_allclose(written["clearance"], 0, atol=1e-9)
            np.testing.assert_allclose(written["slip"][:, 0], slips, atol=1e-9)
            for (name, contact), nodes in zip(zones.items(), ([0, 1], [1, 2])):
                part = result.zone(name)
                fields = contact.fields(part)
                np.testing.assert_allclose(fields.clearance[nodes], 0, atol=1e-9)
                np.testing.assert_allclose(fields.slip[nodes, 0], np.take(slips, nodes), atol=1e-9)
                self.assertAlmostEqual(contact.resultant(part).friction_work, work[name])
                np.testing.assert_allclose(contact.fields(part, slip0=0.0, gap=9.0).slip[nodes, 0], 0.75, atol=1e-9)
        alone = signorini.Model.from_surfaces((np.ones(6), np.arange(6), np.arange(7)), {"left": zones["left"]})
        result = alone.solve(load, {"left": 0.75}, 0.0, penetration=False)
        for given in result, result.zone("left"), alone.solve(load, 0.75, 0.0, penetration=False):
            np.testing.assert_allclose(zones["left"].fields(given).clearance, 0, atol=1e-9)

    def test_a_second_solution_has_the_gaps_of_its_case(self):
        """Klarbring's pair at each node, moved by the gap there: a mean one in the middle."""
        zones, model = self.line([[1, -1], [-1, 2]])
        gap, means = {"left": 0.25, "right": 0.5}, np.array([0.25, 0.375, 0.5])
        load = np.column_stack([1.5 + means, -1 - 2 * means]).ravel()
        result = model.solve(load, gap, 2.0, search="others", penetration=False)
        self.assertIsNotNone(result.second)
        for one in result, result.second:
            clearance = means + model.recover(one.d, load)[1::2]
            for (name, contact), nodes in zip(zones.items(), ([0, 1], [1, 2])):
                np.testing.assert_allclose(contact.fields(one.zone(name)).clearance[nodes], clearance[nodes], atol=1e-9)

    def test_numbers_of_each_zone(self):
        """A push that friction holds in one zone slides in the other."""
        self.load[[0, 2]] = 0.5  # the upper line alone
        held = self.model.solve(self.load, mu={"above": 0.9, "below": [0.9, 0.9]})
        slid = self.model.solve(self.load, mu={"above": 1e-3, "below": [0.9, 0.9]})
        self.assertEqual([held.status, slid.status], [Status.SOLVED] * 2)
        self.assertTrue((held.zone("above").state == State.STICK).all())
        self.assertTrue((slid.zone("above").state == State.SLIP).all())
        wide = self.model.solve(self.load, {"above": 9.0, "below": self.contacts["below"].gaps}, 0.3)
        self.assertTrue((wide.zone("above").state == State.OPEN).all())
        alone = self.model.solve(self.load, {"above": 9.0, "below": 9.0}, friction={"above": [0.1, 0, 0], "below": 3 * [0]},
                                 law="cohesive")
        np.testing.assert_allclose(alone.F, 0, atol=1e-9)

    def test_one_file_has_all_zones(self):
        """The lowest line is pressed by the middle one alone, the upper one presses alone: p and q of the closed form."""
        result, p, q = self.model.solve(self.load, mu=0.3), 92 / 35, 30 / 7
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "zones.vtu")
            u = self.model.recover(result.d, self.load)
            for gap in None, {"above": 0.2, "below": self.contacts["below"].gaps}, [0.2, 0.2, 0.1, 0.1]:
                result.contact.write(path, {"line": [[0, 1], [2, 3], [4, 5]]}, result, u, slip0=0.0, gap=gap)
                found = arrays_of(path)
                np.testing.assert_allclose(found["pressure"][[0, 1, 4, 5]], 2 * np.array([p, p, q, q]), atol=1e-8)
                down = [4 - p, 4 - p, (4 + p - q) / 2, (4 + p - q) / 2, q / 4, q / 4]
                np.testing.assert_allclose(-found["displacement"][:, 1], down, atol=1e-8)
                np.testing.assert_allclose(found["clearance"], 0, atol=1e-8)

    def test_each_zone_has_its_law(self):
        """A tie above and given thresholds below, pushed aside: the tie holds, the threshold is reached."""
        zones = {"above": signorini.Zone(self.contacts["above"], law="tied"),
                 "below": signorini.Zone(self.contacts["below"], g=0.125)}
        springs = (np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13))
        model = signorini.Model.from_surfaces(springs, zones)
        self.load[[0, 2]] = 6
        result = model.solve(self.load, {"above": 0.0, "below": self.contacts["below"].gaps})
        self.assertEqual(result.status, Status.SOLVED)
        above, below = result.zone("above"), result.zone("below")
        self.assertTrue((above.state == State.STICK).all())
        np.testing.assert_array_equal(above.d, 0)
        self.assertTrue((below.state == State.SLIP).all())
        np.testing.assert_allclose(np.abs(below.F[:, 1]), 0.125, atol=1e-9)
        # Both upper lines go aside as one, by springs of 1 and 2 against 6 less the threshold; the lowest one by the rest.
        u = model.recover(result.d, self.load)
        np.testing.assert_allclose(u[[0, 4, 8]], [(6 - 0.125) / 3, (6 - 0.125) / 3, 0.125 / 4], atol=1e-9)
        with self.assertWarnsRegex(UserWarning, "the law coulomb of the case is that of all pairs, and unties 'above': leave it out"):
            whole = model.solve(self.load, mu=0.0)
        self.assertTrue((whole.state == State.SLIP).all(), "a law of the case stands for those of the zones")
        with self.assertWarnsRegex(UserWarning, "the law frictionless of the case .* unties 'above'"):
            np.testing.assert_array_equal(model.solve(self.load, law="frictionless").F[:, 1], 0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            model.solve(self.load, law="tied")

    def test_a_surface_that_is_cut(self):
        """A line of two faces, a zone each, on nodes with springs of 1 over a line on springs of 2: where p presses a node,
        p = 2 (1 - 0.1) / 3 with its load of 1, the middle one is a node of both zones."""
        at = np.array([[0, 0.1], [1, 0.1], [2, 0.1], [0, 0], [1, 0], [2, 0]])
        springs = (np.repeat([1.0, 2.0], 6), np.arange(12), np.arange(13))
        contacts = {"left": signorini.pair_surfaces(at, [[0, 1]], [[4, 3], [5, 4]]),
                    "right": signorini.pair_surfaces(at, [[1, 2]], [[4, 3], [5, 4]])}
        zones = {"left": signorini.Zone(contacts["left"], 0.2), "right": signorini.Zone(contacts["right"], law="tied")}
        model = signorini.Model.from_surfaces(springs, zones)
        self.assertEqual(model.pairs, 3)
        load, p = np.zeros(12), 2 * (1 - 0.1) / 3
        load[1:6:2] = -1
        load[2] = 1.0
        result = model.solve(load)
        left, right = result.zone("left"), result.zone("right")
        # The law of the middle node is that of the first zone: it slides, by 1 - 0.2 p against 0.2 p / 2.
        self.assertEqual(result.state.tolist(), [State.STICK, State.SLIP, State.STICK])
        np.testing.assert_allclose(np.abs(left.d[1, 1]), 1 - 0.3 * p, atol=1e-9)
        np.testing.assert_array_equal(left.d[1], right.d[0])
        for part, force in (left, [p, p / 2]), (right, [p / 2, p]):
            np.testing.assert_allclose(-part.F[:, 0], force, atol=1e-9)
        fields = [part.contact.fields(part).pressure[1] for part in (left, right)]
        np.testing.assert_allclose(fields, p, atol=1e-9)
        forces = [row.force[1] for row in result.table()]
        np.testing.assert_allclose(forces, 1.5 * p, atol=1e-9)
        self.assertIn("1 pairs of later zones are in those of the same nodes", result.contact.summary)
        # Its slip is that of the first zone, at which a large threshold holds it.
        with self.assertWarnsRegex(UserWarning, "the law tresca of the case .* unties 'right'"):
            stays = model.solve(load, g=100.0, slip0={"left": [0.5, 0.25], "right": 0.125})
        np.testing.assert_allclose(stays.d[:, 1], [0.5, 0.25, 0.125], atol=1e-9)
        # The middle node has the mean of the gaps of both.
        gaps = {name: contact.gaps for name, contact in contacts.items()}
        np.testing.assert_array_equal(model.solve(load, gaps).d, result.d)
        wide = model.solve(load, {"left": 5.0, "right": contacts["right"].gaps})
        self.assertEqual(wide.state.tolist(), [State.OPEN, State.OPEN, State.STICK])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "cut.vtu")
            result.contact.write(path, {"line": [[0, 1], [1, 2]]}, result)
            np.testing.assert_allclose(arrays_of(path)["pressure"][1], p, atol=1e-9)

    def test_a_node_of_two_zones_has_the_frames_of_each(self):
        """A plate that is cut, whose second half is seen as leaning a little, so that its first tangent is another one."""
        at = np.array([[x, y, z] for z in (0.1, 0.0) for y in (0.0, 1.0) for x in (0.0, 1.0, 2.0)])
        at[[2, 5], 2] += 1e-3
        contacts = {name: signorini.pair_surfaces(at, [[x, x + 3, x + 4, x + 1]], [[6, 7, 10, 9], [7, 8, 11, 10]])
                    for name, x in (("left", 0), ("right", 1))}
        springs = (np.repeat([1.0, 2.0], 18), np.arange(36), np.arange(37))
        model = signorini.Model.from_surfaces(springs, contacts)
        load = np.zeros(36)
        load[0:18:3], load[1:18:3], load[2:18:3] = 0.7, 0.4, -1.0
        result = model.solve(load, mu=0.1)
        self.assertEqual((result.status, model.pairs), (Status.SOLVED, 6))
        for name, contact in contacts.items():
            part = result.zone(name)
            host = contact.resultant(part).force
            # Friction is against the push; leaning by 1e-3 turns forces by so much.
            np.testing.assert_allclose(host[:2] / host[2], 0.1 * np.array([-0.7, -0.4]) / np.hypot(0.7, 0.4), atol=3e-3)
            for node, d in zip(contact.nodes, part.d):
                pair = np.flatnonzero(contact.nodes == node)[0]
                first = contact.tangents[pair]
                moved = d[1] * first + d[2] * np.cross(contact.normals[pair], first)
                np.testing.assert_allclose(moved[1] / moved[0], 4 / 7, atol=5e-3)

    def test_names_are_told(self):
        with self.assertRaisesRegex(KeyError, "mu names the zone 'bolt', there is none: the zones are 'above', 'below'"):
            self.model.solve(self.load, mu={"bolt": 0.1})
        with self.assertRaisesRegex(KeyError, "mu lacks the zone 'below'"):
            self.model.solve(self.load, mu={"above": 0.1})
        with self.assertRaisesRegex(ValueError, "zones is empty"):
            signorini.Model.from_surfaces(np.eye(2), {})
        with self.assertRaisesRegex(TypeError, "zones\\['bolt'\\] is a int"):
            signorini.Model.from_surfaces(np.eye(2), {"bolt": 3})
        with self.assertRaisesRegex(ValueError, "zones\\['bolt'\\]: mu has 2 numbers: give the 1 of one pair"):
            signorini.Model.from_surfaces(np.eye(2), {"bolt": signorini.Zone(self.contacts["above"], [0.1, 0.2])})
        for wrong, name in ((lambda: signorini.Zone(5, 0.3), "contact"),
                            (lambda: signorini.Model.from_surfaces(np.eye(2), {"bolt": 5}), r"zones\['bolt'\]")):
            with self.assertRaisesRegex(TypeError, f"{name} is a int: give what pair_surfaces or pair_obstacle returns"):
                wrong()
        with self.assertRaisesRegex(signorini.SignoriniError, "slave face 0 of zone 'two' is slave face 0 of zone 'one'"):
            signorini.Model.from_surfaces(np.eye(2), dict.fromkeys(("one", "two"), self.contacts["above"]))
        below = self.contacts["below"]
        listed = signorini.Model.from_surfaces((np.ones(12), np.arange(12), np.arange(13)), list(self.contacts.items()))
        self.assertEqual(listed.contact, self.contacts)
        with self.assertRaisesRegex(ValueError, "two zones are named 'line': give each a name of its own"):
            signorini.Model.from_surfaces(np.eye(2), [("line", self.contacts["above"]), ("line", below)])
        with self.assertRaisesRegex(TypeError, r"a list of what has no names: give \(name, SurfacePairs\)"):
            signorini.Model.from_surfaces(np.eye(2), [below])
        with self.assertRaisesRegex(TypeError, "zones names a zone 1: give a text"):
            signorini.Model.from_surfaces(np.eye(2), {1: self.contacts["above"]})
        named = [(name, self.contacts["above"]) for name in ("plate", "plate")]
        with self.assertRaisesRegex(ValueError, "two zones are named 'plate': give each a name of its own"):
            signorini.Model.from_surfaces(np.eye(2), named)
        for wrong in [self.contacts["above"]], [("above", *self.contacts.values())]:
            with self.assertRaisesRegex(TypeError, r"give \(name, SurfacePairs\) for each zone"):
                signorini.Model.from_surfaces(np.eye(2), wrong)
        with self.assertRaisesRegex(ValueError, r"gap\['above'\] has the shape \(3, 2\): .* of its 2 pairs; for cases"):
            self.model.solve(np.array([self.load] * 3), {"above": np.zeros((3, 2)), "below": 0.0}, 0.3)
        with self.assertRaisesRegex(ValueError, r"mu\['above'\] has the shape \(3,\): give one number, or those, shape \(2,\)"):
            self.model.solve(self.load, mu={"above": [0.1, 0.2, 0.3], "below": 0.1})
        with self.assertRaisesRegex(signorini.SignoriniError, r"zones\['above'\].*mu\[0\] is -1"):
            signorini.Model.from_surfaces(np.eye(2), {"above": signorini.Zone(self.contacts["above"], -1.0)})
        alone = signorini.solve(common.K, common.LOAD, 0.0, 0.3)
        with self.assertRaisesRegex(ValueError, "the model has no zones with names"):
            alone.zone("above")
        result = self.model.solve(self.load)
        with self.assertRaisesRegex(KeyError, "zone names the zone 'bolt', there is none"):
            result.zone("bolt")
        with self.assertRaisesRegex(AttributeError, r"several zones have no areas: ask those of one, result.zone\(name\)"):
            print(result.contact.areas)
        with self.assertRaisesRegex(ValueError, "was unpickled or copied has none any more: Model.with_contact"):
            pickle.loads(pickle.dumps(result)).table()

    def test_tables_of_what_has_no_names_and_of_what_was_unpickled(self):
        """The middle line alone on the lowest one: it presses by 4 / 2 less the gap over the springs of 2 and 4."""
        alone = signorini.Model.from_surfaces((np.repeat([1.0, 2.0, 4.0], 4), np.arange(12), np.arange(13)), self.contacts["below"])
        result, q = alone.solve(self.load, mu=0.3, penetration=False), (4 / 2 - 0.1) / (1 / 2 + 1 / 4)
        for found in result, alone.with_contact(pickle.loads(pickle.dumps(result))):
            row, = found.table()
            self.assertEqual((row.zone, row.pairs, row.open, row.slip + row.stick), ("contact", 2, 0, 2))
            np.testing.assert_allclose(row.force, [0, 2 * q, 0], atol=1e-9)
            self.assertAlmostEqual(row.pressed_area, 1)
        whole = self.model.solve(self.load, mu=0.3)
        again = self.model.with_contact(pickle.loads(pickle.dumps(whole)))
        for row, wanted in zip(again.table(), whole.table(), strict=True):
            self.assertEqual(row[:-1], wanted[:-1])
            np.testing.assert_array_equal(row.force, wanted.force)
        np.testing.assert_array_equal(again.zone("below").F, whole.zone("below").F)
        with self.assertRaisesRegex(ValueError, r"result.d has the shape \(2, 2\): give a result of this model"):
            self.model.with_contact(result)

    def test_a_result_can_be_pickled(self):
        part = self.model.solve(self.load, mu=0.3).zone("below")
        again = pickle.loads(pickle.dumps(part))
        self.assertIsNone(again.contact)
        for name in ("d", "F", "state"):
            np.testing.assert_array_equal(getattr(again, name), getattr(part, name))
        self.assertEqual((again.status, again.report), (part.status, part.report))

    def test_steps_are_a_series_of_files(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, f"step & {step}.vtu") for step in range(3)]
            series = os.path.join(folder, "all.pvd")
            with self.assertRaisesRegex(FileNotFoundError, "write the steps before their series"):
                signorini.write_series(series, names)
            for step, name in enumerate(names):
                result = self.model.solve((1 + step) * self.load, mu=0.3).zone("above")
                self.contacts["above"].write(name, {"line": [[0, 1], [2, 3], [4, 5]]}, result)
            with self.assertRaisesRegex(ValueError, "give an increasing number for each of the 3 files"):
                signorini.write_series(series, names, [0.0, 1.0])
            for last in (1.0, 0.5):
                with self.assertRaisesRegex(ValueError, r"times\[2\] is not above times\[1\]: give an increasing number"):
                    signorini.write_series(series, names, [0.0, 1.0, last])
            with self.assertRaisesRegex(ValueError, r"times\[1\] is not finite"):
                signorini.write_series(series, names, [0.0, np.nan, 1.0])
            with self.assertRaisesRegex(TypeError, "files is '.*': give a list of paths"):
                signorini.write_series(series, names[0])
            signorini.write_series(series, names, [0.0, 0.5, 2.0])
            steps = ElementTree.parse(series).getroot().findall("Collection/DataSet")
            self.assertEqual([(float(step.get("timestep")), step.get("file")) for step in steps],
                             [(time, os.path.basename(name)) for time, name in zip([0.0, 0.5, 2.0], names)])
            for step in steps:
                ElementTree.parse(os.path.join(folder, step.get("file")))
            latin = os.fsdecode(os.fsencode(names[0][:-4]) + b"\xe4.vtu")
            with open(series, "rb") as file, open(latin, "wb"):
                before = file.read()
            with self.assertRaisesRegex(ValueError, "no UTF-8, which a .pvd is: give the file another name"):
                signorini.write_series(series, [latin])
            with open(series, "rb") as file:
                self.assertEqual(file.read(), before)
            os.remove(latin)
            signorini.write_series(os.fsencode(series), [os.fsencode(name) for name in names], [0.0, 0.5, 2.0])
            with open(series, "rb") as file:
                self.assertEqual(file.read(), before)
            self.assertEqual(sorted(os.listdir(folder)), sorted(map(os.path.basename, [*names, series])))

    def test_many_cases_and_certify(self):
        loads = np.array([self.load, 2 * self.load])
        one, two = self.model.solve(loads, mu={"above": 0.3, "below": 0.1})
        self.assertGreater(-two.zone("below").F[0, 0], -one.zone("below").F[0, 0])
        measured = self.model.certify(self.load, None, {"above": 0.3, "below": 0.1}, d=one.d)
        self.assertEqual(measured.status, Status.SOLVED)
        np.testing.assert_allclose(measured.zone("above").F, one.zone("above").F, atol=1e-9)


class OtherMeshes(unittest.TestCase):
    def test_zones_of_other_meshes_are_refused(self):
        """Masters of as many nodes, at other places: forces would act on the nodes of one of them."""
        slave = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
        lines = {"left": [[1, 0]], "right": [[2, 1]]}
        zones = {}
        for name, from_ in (("left", 0.0), ("right", 1.0)):
            at = np.vstack([slave, [[from_, 0.0], [from_ + 1.0, 0.0]]])
            zones[name] = signorini.pair_surfaces(at, lines[name], [[3, 4]])
        springs = np.ones(10), np.arange(10), np.arange(11)
        with self.assertRaisesRegex(ValueError, "zone 'right' is of another mesh than zone 'left', as node 3 stands elsewhere"):
            signorini.Model.from_surfaces(springs, zones)


class CurvedCut(unittest.TestCase):
    """A ring of 12 faces on a hub of 14, every node on springs of 1 and of 2, in two zones, half of the ring each."""

    def setUp(self):
        def circle(count, first):
            angles = np.tile(2 * np.pi * np.arange(count) / count, 2)
            one = np.arange(first, first + count)
            after, up = np.roll(one, -1), one + count
            return (np.column_stack([np.cos(angles), np.sin(angles), np.repeat([0.0, 0.5], count)]),
                    np.column_stack([one, up, after + count, after]))

        ring, bore = circle(12, 0)
        hub, outside = circle(14, len(ring))
        self.at, self.hub = np.vstack([ring, hub]), outside[:, ::-1]
        self.halves = {"left": bore[:6], "right": bore[6:]}
        self.springs = (np.repeat([1.0, 2.0], [ring.size, hub.size]), np.arange(self.at.size), np.arange(self.at.size + 1))
        # A push aside and a twist, with which all nodes stick at first.
        load = np.zeros_like(self.at)
        load[:24] = [3e-4, 1e-4, 2e-4]
        load[:24, :2] += 1e-4 * ring[:, 1::-1] * [-1, 1]
        self.load = load.ravel()

    def model(self, left, right, **more):
        """The model of zones with clearances."""
        contacts = {name: signorini.pair_surfaces(self.at, self.halves[name], self.hub, clearance=clearance, **more)
                    for name, clearance in (("left", left), ("right", right))}
        return signorini.Model.from_surfaces(self.springs, contacts), contacts

    def test_gaps_by_hand_are_those_of_clearances(self):
        """In all zones, in one of them, and as numbers of the case."""
        for left, right in (-0.02, -0.02), (-0.02, 0.0):
            wanted = self.model(left, right)[0].solve(self.load, mu=0.3)
            model, contacts = self.model(0.0, 0.0)
            gaps = {"left": contacts["left"].gaps + left, "right": contacts["right"].gaps + right}
            np.testing.assert_allclose(model.solve(self.load, gaps, 0.3).F, wanted.F, atol=1e-12)
            for name, contact in contacts.items():
                contact.gaps[:] = gaps[name]
            np.testing.assert_allclose(model.solve(self.load, mu=0.3).F, wanted.F, atol=1e-12)

    def test_zones_balance_the_loads_and_have_the_fields(self):
        for gap in None, {"left": -0.03, "right": -0.02}:
            model, contacts = self.model(-0.02, -0.02)
            for name, contact in contacts.items() if gap else ():
                contact.gaps[:] = gap[name]
            result = model.solve(self.load, mu=0.3)
            self.assertEqual(result.status, Status.SOLVED)
            forces = model.nodal_forces(result.F).reshape(-1, 3)[:24]
            np.testing.assert_allclose(sum(row.force for row in result.table()), forces.sum(axis=0), atol=1e-12)
            parts = {name: pickle.loads(pickle.dumps(result.zone(name))) for name in contacts}
            sums = [contacts[name].resultant(part, [0.1, 0.2, 0.3]) for name, part in parts.items()]
            moment = np.cross(self.at[:24] - [0.1, 0.2, 0.3], forces).sum(axis=0)
            np.testing.assert_allclose(sum(one.moment for one in sums), moment, atol=1e-12)
            # The work of friction: forces along the surface by what they move.
            work = -np.sum(result.F[:, 1:] * result.d[:, 1:])
            self.assertAlmostEqual(sum(one.friction_work for one in sums), work, places=14)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "zones.vtu")
                result.contact.write(path, {"quad": self.hub}, result)
                written = arrays_of(path)
            for name, part in parts.items():
                fields, slaves = contacts[name].fields(part), contacts[name].nodes
                np.testing.assert_allclose(fields.clearance[slaves], 0, atol=1e-15)
                for what in ("pressure", "traction", "slip", "clearance"):
                    np.testing.assert_allclose(getattr(fields, what)[slaves], written[what][slaves], atol=1e-12)
                host = np.einsum("pi,pij->pj", part.F, part.frames) / contacts[name].areas[:, None]
                np.testing.assert_allclose(fields.traction[slaves], host, atol=1e-12)

    def test_the_same_load_again_slips_nowhere(self):
        model, contacts = self.model(-0.02, -0.02)
        first = model.solve(self.load, mu=0.3)
        slips = {name: first.zone(name).d[:, 1:] for name in contacts}
        for slip0 in slips, first.d[:, 1:]:
            result = model.solve(self.load, mu=0.3, slip0=slip0)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "again.vtu")
                result.contact.write(path, {"quad": self.hub}, result, slip0=slip0)
                np.testing.assert_allclose(arrays_of(path)["slip"], 0, atol=1e-12)
        for name, contact in contacts.items():
            np.testing.assert_allclose(contact.fields(result.zone(name), slip0=slips[name]).slip, 0, atol=1e-12)
        # One pair's slip, and one number for all.
        zeros = model.solve(self.load, mu=0.3, slip0={"left": [0, 0], "right": 0.0})
        np.testing.assert_array_equal(zeros.F, first.F)

    def test_slips_of_zones_are_turned_back(self):
        """Ties go where slip0 says, which is a place in space: that of a zone's parts, and of all pairs."""
        model, contacts = self.model(-0.02, -0.02, tangent=[1.0, 2.0, 3.0])
        slips = 1e-3 * np.sin(np.arange(2.0 * model.pairs)).reshape(-1, 2)
        tied = model.solve(self.load, law="tied", slip0=slips)
        parts = {name: tied.zone(name) for name in contacts}
        again = model.solve(self.load, law="tied", slip0={name: part.d[:, 1:] for name, part in parts.items()})
        turned = 0
        for name, contact in contacts.items():
            place = tied.contact.places[name]
            part = parts[name]
            for along, frames in (part.d[:, 1:], part.frames), (again.d[place, 1:], model.frames[place]):
                moved = np.einsum("pi,pij->pj", along, frames[:, 1:])
                np.testing.assert_allclose(moved, np.einsum("pi,pij->pj", slips[place], model.frames[place, 1:]), atol=1e-12)
            turned += np.sum(abs(part.d[:, 1:] - slips[place]) > 1e-5)
        self.assertGreater(turned, 0)

    def test_bounds_of_a_proof_hold_along_the_tangents_of_zones(self):
        """What is within the bounds of a pair of two zones is within those of the part of each: corners are the furthest."""
        model, contacts = self.model(-0.02, -0.02, tangent=[1.0, 2.0, 3.0])
        result = model.solve(self.load, mu=0.01, proof=True)
        self.assertIsNotNone(result.radius_d)
        turned = 0
        for name in contacts:
            part, place = result.zone(name), result.contact.places[name]
            away = np.einsum("pai,pbi->pab", part.frames[:, 1:], model.frames[place, 1:])
            corners = [np.einsum("pab,pb->pa", away, result.radius_d[place, 1:] * signs) for signs in ([1, 1], [1, -1])]
            furthest = np.abs(corners).max(axis=0)
            np.testing.assert_allclose(part.radius_d[:, 1:], furthest, rtol=1e-9)
            turned += np.sum(furthest > 1.01 * result.radius_d[place, 1:])
        self.assertGreater(turned, 0)

    def test_a_zone_that_has_not_slipped(self):
        model, contacts = self.model(-0.02, -0.02)
        nothing, zeros = (model.solve(self.load, mu=0.3, slip0=dict.fromkeys(contacts, slip)) for slip in (None, 0.0))
        np.testing.assert_array_equal(nothing.F, zeros.F)


if __name__ == "__main__":
    unittest.main()
