"""The Python package: rows by degree of freedom, equations between degrees of freedom, and decks that have them.

    python3 tests/python/equations.py
"""

import os
import tempfile
import unittest
import warnings

import numpy as np

from common import ROOT  # noqa: F401

import signorini

from surfaces import arrays_of

# Any definite matrix serves as a stiffness.
rng = np.random.default_rng(1)


def definite(size):
    factor = rng.normal(size=(size, size))
    return factor @ factor.T + np.eye(size)


def sparse(dense):
    size = len(dense)
    return dense.T.ravel(), np.tile(np.arange(size), size), size * np.arange(size + 1)


class Rows(unittest.TestCase):
    def test_vectors_are_weights_of_nodes(self):
        K = sparse(definite(12))
        nodes = [([[0, 1, 2], [3, 4, 5]], [1, -1]), ([[6, 7, 8]], [1])]
        normals = [[0, 0, -1], [0, 1, 1]]
        vectors = [(np.ravel(dofs), np.kron(np.reshape(weights, (-1, 1)), np.eye(3))) for dofs, weights in nodes]
        mine, theirs = (signorini.Model.sparse(K, rows=rows, normals=normals) for rows in (vectors, nodes))
        np.testing.assert_array_equal(mine.stiffness, theirs.stiffness)

    def test_a_rigid_body(self):
        """Six degrees of freedom, by equations and by vectors that are made here: the host has eliminated."""
        places, reference = rng.normal(size=(4, 3)), np.array([0.3, -0.2, 0.5])
        K, motion, labels = definite(6 + 3), [0, 1, 2, 3, 4, 5], 100 + np.arange(12).reshape(4, 3)
        equations = signorini.rigid_equations(labels, places, reference, motion)
        slave = signorini.Model.sparse(sparse(K), labels[:1], [0, 0, -1], masters=[[[6, 7, 8]]], equations=equations)
        arm = places[0] - reference
        cross = np.array([np.cross(unit, arm) for unit in np.eye(3)])
        vectors = np.concatenate([np.eye(3), cross, -np.eye(3)])
        by_dof = signorini.Model.sparse(sparse(K), rows=[(range(9), vectors)], normals=[0, 0, -1])
        np.testing.assert_allclose(slave.stiffness, by_dof.stiffness, rtol=1e-12)
        self.assertLess(abs(signorini.rigid_equations([[9, 8]], [[2, 3]], [1, 1], [0, 1, 2])[0][2][2] + 2), 1e-15)

    def test_pairs_that_depend_on_others_are_counted(self):
        """Rows of one node of a rigid body are independent; those of more depend on each other, as the distance of two is given."""
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]])
        labels = 10 + np.arange(12).reshape(4, 3)
        equations = signorini.rigid_equations(labels, corners, [0, 0, 0], range(6))
        for count in 1, 2, 4:
            model = signorini.Model.sparse(sparse(np.eye(6)), labels[:count], [0, 0, -1], equations=equations)
            rank = np.linalg.matrix_rank([row for _, _, row in equations[:3 * count]])
            # A pair is counted if any of its three rows follows from others.
            self.assertEqual(rank == 3 * count, model.dependent == 0)
            self.assertLess(model.dependent, count)
        self.assertEqual(signorini.Model.sparse(sparse(np.eye(3)), [[0, 1], [0, 1]], [0, -1]).dependent, 1)
        self.assertEqual(signorini.Model.condensed(np.eye(4)).dependent, 0)

    def test_turned_axes_change_nothing(self):
        K, turn = definite(6), np.array([[0.8, -0.6], [0.6, 0.8]])
        pair = {"slaves": [[2, 3]], "normals": [0, -1], "masters": [[[4, 5]]]}
        plain = signorini.Model.sparse(sparse(K), **pair)
        Q = np.eye(6)
        Q[2:4, 2:4] = turn
        own = dict(pair, slaves=[[20, 21]])
        equations = signorini.turned_equations([[20, 21]], [[2, 3]], turn)
        turned = signorini.Model.sparse(sparse(Q.T @ K @ Q), equations=equations, **own)
        np.testing.assert_allclose(turned.stiffness, plain.stiffness, rtol=1e-12)
        f, d = rng.normal(size=6), [0.1, 0.2]
        np.testing.assert_allclose(Q @ turned.recover(d, Q.T @ f), plain.recover(d, f), rtol=1e-11, atol=1e-12)

    def test_a_section_has_its_force_and_its_shortening(self):
        """A bolt of two springs in the plane, 2 above its section and 4 below, whose head stands on the ground."""
        K = np.eye(7)
        K[1, 1], K[1, 3], K[3, 1], K[3, 3], K[5, 5], K[6, 6] = 2, -2, -2, 2, 4, 0
        equations = signorini.section_equations([[2, 3]], [[4, 5]], 6, [0, 1])
        tightened = signorini.Model.sparse(sparse(K), [[0, 1]], [0, -1], equations=equations)
        f = np.array([0, 0, 0, 0, 0, 0, 6.0])
        result = tightened.solve(f, gap=0.0, mu=0.0)
        np.testing.assert_allclose(result.F[0], [-6, 0], atol=1e-12)
        np.testing.assert_allclose(tightened.recover(result.d, f)[[1, 3, 5, 6]], [0, -3, 1.5, 4.5], atol=1e-12)
        locked = signorini.Model.sparse(sparse(K), [[0, 1]], [0, -1], fixed=[6], equations=equations)
        result = locked.solve([0, 8.0, 0, 0, 0, 0, 0], gap=0.0, mu=0.0, prescribed=[4.5])
        np.testing.assert_allclose(result.d[0, 0], -1.5)  # (8 - 6) (1 / 2 + 1 / 4), against n
        # The head is off, and the bolt carries the load; below it what is left of the pretension presses the head.
        load = np.array([0, 8.0, 0, 0, 0, 0, 0])
        np.testing.assert_allclose(locked.reactions(result, load, [4.5]), [8])
        for pull in (0.0, 2.0, 5.0):
            load[1] = pull
            result = locked.solve(load, gap=0.0, mu=0.0, prescribed=[4.5])
            np.testing.assert_allclose(locked.reactions(result, load, [4.5]), [pull - result.F[0, 0]])
        with self.assertRaisesRegex(ValueError, r"give as many as dofs, shape \(1, 2\)"):
            signorini.section_equations([[2, 3]], [[4, 5], [0, 1]], 6, [0, 1])

    def test_reactions_are_those_of_statics(self):
        """A beam on supports and contact, whose nodes follow two motions through a lever: forces and moments balance."""
        places = np.array([0.0, 1.0, 2.5, 4.0])
        # Node i moves by y + place turn; y is half of a dof with no row, which is a fixed one with none of its entries.
        equations = [(2 * i + 1, [20, 9], [1.0, x]) for i, x in enumerate(places)] + [(20, [8], [0.5])]
        size = 12
        K = np.zeros((size, size))
        K[10, 10] = K[11, 11] = 3.0
        K[0, 0] = K[2, 2] = K[4, 4] = K[6, 6] = 1.0
        K[1, 1] = K[7, 7] = K[10, 11] = K[11, 10] = 2.0  # beds below two nodes, and a spring beside
        for fixed, loads in (([8], {3: -1.0, 7: -2.0}), ([9], {3: 1.0, 5: -3.0}), ([8, 9, 10], {7: -2.0, 11: 0.5})):
            for triangle, part in (("full", K), ("lower", np.tril(K)), ("upper", np.triu(K))):
                f = np.zeros(size)
                for dof, load in loads.items():
                    f[dof] = load
                columns, rows = np.nonzero(part.T)
                matrix = part[rows, columns], rows, np.searchsorted(columns, np.arange(size + 1))
                model = signorini.Model.sparse(matrix, [[2, 3], [6, 7]], [0, -1], fixed=fixed, equations=equations,
                                               triangle=triangle)
                result = model.solve(f, gap=0.0, mu=0.0)
                self.assertEqual(result.status, signorini.Status.SOLVED)
                found = dict(zip(fixed, model.reactions(result, f)))
                u = model.recover(result.d, f)
                up = f[1:8:2] - np.array([2 * u[1], result.F[0, 0], 0, result.F[1, 0] + 2 * u[7]])
                # Virtual work: y moves all nodes by a half of its own motion, the turn each by its place.
                self.assertAlmostEqual(found.get(8, 0.0), -0.5 * up.sum(), delta=1e-9)
                self.assertAlmostEqual(found.get(9, 0.0), -(places * up).sum(), delta=1e-9)
                self.assertAlmostEqual(found.get(10, 0.0), 3 * u[10] + 2 * u[11] - f[10], delta=1e-12)
        with self.assertRaisesRegex(TypeError, "no matrix of the host: its reactions are"):
            signorini.Model.condensed(np.eye(2)).reactions(result, None)

    def test_surfaces_have_equations_too(self):
        """Labels for all nodes, whose equations lead to the matrix: the plain model, bit by bit."""
        places = np.array([[0, 0.1], [1, 0.1], [-1, 0], [0.5, 0], [2, 0]])
        faces, K = ([[0, 1]], [[4, 3], [3, 2]]), sparse(definite(10))
        plain = signorini.Model.from_surfaces(K, signorini.pair_surfaces(places, *faces))
        labels = 50 + np.arange(10).reshape(5, 2)
        contact = signorini.pair_surfaces(places, *faces, dofs=labels)
        equations = [(50 + dof, [dof], [1.0]) for dof in range(10)]
        for pairs in (contact, {"zone": contact}):
            model = signorini.Model.from_surfaces(K, pairs, equations=equations)
            np.testing.assert_array_equal(model.stiffness, plain.stiffness)

    def test_displacements_of_what_has_no_row(self):
        """A line on springs of 1 above a lower one whose nodes have no rows in K, and are held or follow each other."""
        places = np.array([[0, 0.1], [1, 0.1], [0, 0], [1, 0]])
        contact = signorini.pair_surfaces(places, [[0, 1]], [[3, 2]])
        equations = [(4, [6], [2.0]), (6, [0], [0.5]), (5, [], []), (7, [5], [1.0])]
        for pairs in (contact, {"zone": contact}):
            model = signorini.Model.from_surfaces(sparse(np.eye(4)), pairs, equations=equations)
            load = [0.3, -0.4, 0.3, -0.4]
            result = model.solve(load, mu=0.0)
            self.assertEqual(result.status, signorini.Status.SOLVED)
            self.assertIsNone(result.penetration)
            u = model.recover(result.d, load)
            np.testing.assert_allclose(u, [0.3, -0.1, 0.3, -0.1], atol=1e-9)
            np.testing.assert_allclose(model.extended(u), [*u, 0.3, 0, 0.15, 0], atol=1e-9)
        with self.assertRaisesRegex(ValueError, "at least 8; Model.extended adds"):
            contact.penetration(u)
        self.assertIsNone(contact.penetration(model.extended(u)))

    def test_nodes_of_no_face_need_no_displacements(self):
        """A line on springs of 1 above a lower one on springs of 2, pressed by 1, with a node of no face that K does not have, of
        any number: (1 - p) / 1 = 0.1 + p / 2 at each node. The host may have dropped a face's node that it holds."""
        places = np.array([[0, 0.1], [1, 0.1], [0, 0], [1, 0], [5, 5], [3, 0.0]])
        near, far = np.arange(12).reshape(6, 2), np.arange(12).reshape(6, 2)
        far[4], load = 10**15, np.tile([0, -1.0], 2)
        load = np.concatenate([load, np.zeros(4)])
        K, p = sparse(np.diag(np.repeat([1.0, 2.0], 4))), 0.9 / 1.5
        for dofs, master in (None, [[3, 2]]), (near, [[3, 2]]), (far, [[3, 2]]), (near, [[5, 3], [3, 2]]):
            contact = signorini.pair_surfaces(places, [[0, 1]], master, dofs=dofs)
            for pairs in (contact, {"zone": contact}):
                model = signorini.Model.from_surfaces(K, pairs)
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    result = model.solve(load, mu=0.0)
                np.testing.assert_allclose(result.F[:, 0], -p, atol=1e-9)
                u = model.recover(result.d, load)
                if len(master) > 1:
                    self.assertRaisesRegex(ValueError, "u has the shape .8,.: .* at least 12", contact.penetration, u)
                    continue
                self.assertIsNone(contact.penetration(u))
                with tempfile.TemporaryDirectory() as folder:
                    path = os.path.join(folder, "lines.vtu")
                    result.contact.write(path, {"line": [[0, 1], [3, 2]], "vertex": [[4]]}, result, u)
                    moved = arrays_of(path)["displacement"]
                np.testing.assert_allclose(moved[:, 1], [p - 1, p - 1, -p / 2, -p / 2, 0, 0], atol=1e-9)

    def test_a_large_number_costs_nothing(self):
        """A block of 2 nodes falls on a plane, and one of its directions has a second number, the largest that there is."""
        contact = signorini.pair_obstacle([[0, 0.5], [1, 0.5]], [[0, 1]], signorini.Plane((0, 0), (0, 1)))
        equations = [(2**63 - 1, [2**62], [2.0]), (2**62, [1], [1.0])]
        model = signorini.Model.from_surfaces((np.ones(4), np.arange(4), np.arange(5)), contact, equations=equations)
        self.assertEqual(model.solve([0, -1.0, 0, -1.0], mu=0.3).status, signorini.Status.SOLVED)
        few = signorini.Model.from_surfaces((np.ones(4), np.arange(4), np.arange(5)), contact,
                                            equations=[(7, [5], [2.0]), (5, [1], [1.0])])
        np.testing.assert_array_equal(few.extended([1.0, 2, 3, 4]), [1, 2, 3, 4, 0, 2, 0, 4])

    def test_axes_of_few_digits_are_the_nearest_ones(self):
        """The orthogonal factor of the singular value decomposition; zeros and ones stay."""
        exact = np.linalg.qr(np.vander([1, 2, 3.0]))[0]
        for digits in 16, 6, 4, 3:
            left, _, right = np.linalg.svd(exact.round(digits))
            found = np.array([row for _, _, row in signorini.turned_equations([[0, 1, 2]], [[3, 4, 5]], exact.round(digits))])
            np.testing.assert_allclose(found, left @ right, atol=1e-14)
            np.testing.assert_allclose(found.T @ found, np.eye(3), atol=1e-14)
        level = signorini.turned_equations([[0, 1, 2]], [[3, 4, 5]], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        np.testing.assert_array_equal([row for _, _, row in level], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])

    def test_directions_of_any_length_and_turns_that_are_none(self):
        np.testing.assert_allclose(signorini.section_equations([[0, 1, 2]], [[3, 4, 5]], 6, [0, 0, 2])[2][2], [1, -1])
        with self.assertRaisesRegex(ValueError, "axis is .*: give the direction across the section"):
            signorini.section_equations([[0, 1]], [[3, 4]], 6, [0, 0])
        with self.assertRaisesRegex(ValueError, "turn of node 1 is no rotation"):
            signorini.turned_equations([[0, 1], [2, 3]], [[4, 5], [6, 7]], [np.eye(2), np.ones((2, 2))])

    def test_sides_of_a_section_in_any_order(self):
        """By their places nodes have the equations that they have in one order."""
        places = np.array([[x, y, 2.0] for x in range(3) for y in (0, 1, 3)])
        dofs, order = np.arange(27).reshape(9, 3), np.random.default_rng(2).permutation(9)
        opposite = 30 + dofs
        wanted = signorini.section_equations(dofs, opposite, 60, [0, 0, 1])
        found = signorini.section_equations(dofs, opposite[order], 60, [0, 0, 1], (places, places[order] + 1e-7))
        self.assertEqual(found, wanted)
        for others, says in ((places + [0, 0, 0.01], "no node of opposite is at the place of node 0 .* 1.0e-02 away"),
                             (places[[0, 0, *range(2, 9)]], "no node of opposite is at the place of node 1 ")):
            with self.assertRaisesRegex(ValueError, says):
                signorini.section_equations(dofs, opposite, 60, [0, 0, 1], (places, others))
        twice = places[[0, 0, *range(2, 9)]]
        for given, says in (((twice, places), "two nodes of dofs are at the place of one"),
                            (places, r"coordinates\[0\] has the shape \(3,\)")):
            with self.assertRaisesRegex(ValueError, says):
                signorini.section_equations(dofs, opposite, 60, [0, 0, 1], given)

    def test_mistakes(self):
        def refused(kind, part, **changed):
            given = {"slaves": [[2, 3]], "normals": [0, -1]}
            with self.assertRaisesRegex(kind, part):
                signorini.Model.sparse(sparse(np.eye(4)), **{**given, **changed})
        refused(ValueError, "equations is no list of equations", equations=[(1, [2])])
        refused(ValueError, r"equations\[0\] has the shapes", equations=[(1, [2, 3], [1.0])])
        refused(TypeError, r"equations\[0\] holds float64, not integers", equations=[(1, [2.5], [1.0])])
        refused(signorini.SignoriniError, "equation 0: its dependent degree of freedom follows from itself",
                equations=[(7, [7], [1.0])])
        refused(ValueError, r"rows\[0\] has the shapes", slaves=None, rows=[([0, 1], np.eye(3))], normals=[0, 0, 1])
        refused(ValueError, r"rows\[1\] has the shapes", slaves=None,
                rows=[([0, 1], np.eye(2)), ([0, 1], np.eye(3))])
        refused(signorini.SignoriniError, "pair 0: it has no degree of freedom with a vector", slaves=None,
                rows=[([0, 1], np.zeros((2, 2)))])


class Sectors(unittest.TestCase):
    """A ring and a hub of a few faces a sector, shifted, every node on springs that are alike in all directions."""

    def ring(self, sectors, whole, nodes, counts=(3, 4)):
        """Places, faces of ring and hub, and of each node the share of its springs that is here."""
        places, faces, shares = [], [], []
        for start, count, turns_back in zip((0.0, 0.1), counts, (True, False)):
            steps = (sectors if whole else 1) * count * (nodes - 1)
            points = steps if whole else steps + 1
            angles = start + 2 * np.pi / (sectors * count * (nodes - 1)) * np.arange(points)
            first = sum(map(len, places))
            ends = [(first + i, first + (i + nodes - 1) % points) for i in range(0, steps, nodes - 1)]
            mids = [[first + i + 1] for i in range(0, steps, nodes - 1)] if nodes == 3 else [[]] * len(ends)
            faces.append([[*(end[::-1] if turns_back else end), *mid] for end, mid in zip(ends, mids)])
            places.append(np.stack([np.cos(angles), np.sin(angles)], 1))
            share = np.ones(points)
            if not whole:
                share[[0, -1]] = 0.5
            shares.append(share)
        return np.concatenate(places), faces, np.concatenate(shares), len(places[0])

    def test_a_sector_of_a_ring_is_the_whole(self):
        # With one face a sector masters of the next but one count, and for fitted curves those beyond.
        for sectors, nodes, counts, fitted in ((5, 2, (3, 4), False), (5, 3, (3, 4), False), (2, 3, (3, 4), False),
                                               (3, 2, (3, 4), False), (12, 3, (1, 1), False), (12, 2, (1, 2), True)):
            turn = 2 * np.pi / sectors
            found = []
            for whole in (True, False):
                places, (ring, hub), shares, first = self.ring(sectors, whole, nodes, counts)
                angles = np.arctan2(places[:, 1], places[:, 0])
                # Loads that repeat in each sector: the ring is pressed and dragged.
                along = (1 + 0.8 * np.cos(sectors * angles) + 0.3 * np.sin(sectors * angles))[:, None]
                load = -along * places + 0.1 * np.stack([-places[:, 1], places[:, 0]], 1)
                load[first:] = 0
                load *= shares[:, None]
                sector = None if whole else signorini.Sector(sectors, (0.0, 0.0))
                bodies = np.arange(len(places)) >= first
                equations = None if whole else signorini.sector_equations(places, sector, bodies=1 * bodies)
                contact = signorini.pair_surfaces(places, ring, hub, sector=sector, search_distance=0.5, fitted=fitted)
                size, springs = places.size, 10.0 * np.repeat(shares, 2)
                K = springs, np.arange(size), np.arange(size + 1)
                model = signorini.Model.from_surfaces(K, contact, equations=equations)
                result = model.solve(load.ravel(), mu=0.2, gap=contact.gaps + 0.01)
                self.assertEqual(result.status, 0)
                fields = contact.fields(result, gap=contact.gaps + 0.01)
                u = model.recover(result.d, load.ravel()).reshape(-1, 2)
                found.append((places, first, u, fields, contact))
            (places, first, u, fields, contact), (own, end, *of_sector) = found
            # Nodes of the sector among those of the whole, by body and place.
            same = [np.abs(places - x).max(1) + 9 * ((np.arange(len(places)) >= first) != (node >= end))
                    for node, x in enumerate(own)]
            same = np.argmin(same, axis=1)
            for ours, theirs in zip((of_sector[0], *of_sector[1][:4]), (u, *fields[:4])):
                # Rounding of the places and of the solution, relative to the largest.
                np.testing.assert_allclose(ours, theirs[same], atol=1e-11 * abs(theirs).max())
            self.assertEqual(contact.pairs, sectors * of_sector[2].pairs)
            self.assertIn("of the pairs on the boundary of the sector", of_sector[2].summary)

    def strip(self, copies):
        """Places, upper and lower faces of wavy lines over so many periods on each side of one; the node of the part of which
        each is an image, and if it is of the part itself."""
        periods = [0] + [k for k in range(-copies, copies + 1) if k]
        places, faces, images, of_part = [], [], [], []
        for start, count, height in ((0.0, 3, 0.01), (0.1, 4, 0.0)):
            first, at = len(places), {}
            for period in periods:
                for i in range(count + (period in (0, copies))):
                    step = period * count + i
                    at[step] = len(places)
                    x = start + step / count
                    places.append([x, height + 0.01 * np.sin(2 * np.pi * x) + 0.3 * x])
                    images.append(first + step % count)
                    of_part.append(0 <= step < count)
            lines = [[at[step], at[step + 1]] for step in sorted(at)[:-1]]
            faces.append([line[::-1] for line in lines] if start else lines)
        return np.array(places), faces, np.array(images), np.array(of_part)

    def test_a_period_is_a_part_of_many(self):
        """The part beside many of which all copies move as one, and whose pairs beyond the part never touch."""
        found = []
        for copies in (0, 2):
            places, (upper, lower), images, of_part = self.strip(copies)
            dofs = np.arange(places.size).reshape(-1, 2)
            if copies:
                sector, others = None, np.flatnonzero(~of_part)
                equations = signorini.turned_equations(dofs[others], dofs[images[others]], np.eye(2))
            else:
                sector = signorini.Period((1.0, 0.3))
                bodies = np.array([0] * 4 + [1] * 5)
                equations = signorini.sector_equations(places, sector, bodies=bodies)
                self.assertEqual(len(equations), 4)
            contact = signorini.pair_surfaces(places, upper, lower, sector=sector, search_distance=0.2)
            gaps = np.where(of_part[contact.nodes], contact.gaps, np.inf)
            load = np.zeros((len(places), 2))
            load[of_part, 1] = np.where(images[of_part] < 3, -0.1 * (1 + 0.9 * np.cos(images[of_part])), 0)
            load[of_part, 0] = np.where(images[of_part] < 3, 0.01, 0)
            K = 10.0 * np.repeat(of_part, 2), np.arange(places.size), np.arange(places.size + 1)
            model = signorini.Model.from_surfaces(K, contact, equations=equations)
            result = model.solve(load.ravel(), gap=gaps, mu=0.2)
            self.assertEqual(result.status, 0)
            self.assertTrue((result.F[:, 0] < 0).sum() >= 2)
            u = model.recover(result.d, load.ravel()).reshape(-1, 2)
            own = np.argsort(contact.nodes)[:3]
            found.append((u[of_part], contact.areas[own], result.F[own]))
        for ours, theirs in zip(*found):
            # Rounding of places and of the solution.
            np.testing.assert_allclose(ours, theirs, atol=1e-12)
        with self.assertRaisesRegex(ValueError, r"no node is the image of another, shifted by \[0\.9 0\.3\], a way of the Period"):
            signorini.sector_equations(self.strip(0)[0], signorini.Period((0.9, 0.3)))
        with self.assertRaisesRegex(ValueError, "way has the shape"):
            signorini.pair_surfaces(*self.strip(0)[:1], *self.strip(0)[1], sector=signorini.Period((1.0, 0.3, 0.0)))

    def test_two_periods(self):
        """Of a part that repeats along two lines each pair has the area of a cell, and each node is the first of its images."""
        way, other = np.array([3.0, 0.6, 0.3]), np.array([-0.4, 2.0, 0.0])
        steps = np.array([(i, j) for j in range(3) for i in range(4)])
        places = steps @ np.array([way / 3, other / 2])
        faces = [[i + 4 * j, i + 4 * j + 4, i + 4 * j + 5, i + 4 * j + 1] for j in range(2) for i in range(3)]
        outward = np.cross(way, other)
        sector = signorini.Period(way, other)
        contact = signorini.pair_obstacle(places, faces, signorini.Plane((0, 0, 0), outward), sector=sector)
        np.testing.assert_allclose(contact.areas, np.linalg.norm(outward) / 6, rtol=1e-14)
        self.assertEqual(sorted(contact.nodes), [0, 1, 2, 4, 5, 6])
        equations = signorini.sector_equations(places, sector)
        expected = {3 * node + axis: 3 * (i % 3 + 4 * (j % 2)) + axis
                    for node, (i, j) in enumerate(steps) if i == 3 or j == 2 for axis in range(3)}
        found = {of: dofs[np.flatnonzero(turn)] for of, dofs, turn in equations}
        self.assertEqual({of: own.tolist() for of, own in found.items()}, {of: [own] for of, own in expected.items()})
        with self.assertRaisesRegex(ValueError, r"no node is the image of another, shifted by \[-0\.404"):
            signorini.sector_equations(places, signorini.Period(way, 1.01 * other))
        with self.assertRaisesRegex(ValueError, "way and second of the Period are along one line"):
            signorini.pair_obstacle(places, faces, signorini.Plane((0, 0, 0), outward), sector=signorini.Period(way, 2 * way))
        with self.assertRaisesRegex(ValueError, "second has the shape"):
            signorini.sector_equations(places, signorini.Period(way, (1.0, 0.0)))
        with self.assertRaisesRegex(ValueError, r"second of the Period is \[0\. 0\. 0\.\]: give the way"):
            signorini.sector_equations(places, signorini.Period(way, (0.0, 0.0, 0.0)))

        # Faces at two opposite corners have one node in common, though no node is between.
        ends = signorini.pair_obstacle(places, faces[::5], signorini.Plane((0, 0, 0), outward), sector=sector)
        np.testing.assert_allclose(ends.areas[ends.nodes == 0], np.linalg.norm(outward) / 12, rtol=1e-14)
        # Balls repeat, whichever of them is named.
        up, copies = outward / np.linalg.norm(outward), [m * way + n * other for m in range(-2, 3) for n in range(-2, 3)]
        for corner in (0 * way, way, way + other, 0.5 * way + 0.4 * other):
            centre = corner - 0.9 * up
            found = signorini.pair_obstacle(places, faces, signorini.Sphere(centre, 0.8), sector=sector)
            gaps = [min(np.linalg.norm(places[node] - centre - copy) for copy in copies) - 0.8 for node in found.nodes]
            np.testing.assert_allclose(found.gaps, gaps, atol=1e-14)
        for rigid in (signorini.Plane((0, 0, 0), outward + way), signorini.Sphere((0, 0, 0), 9, hollow=True)):
            with self.assertRaisesRegex(signorini.SignoriniError, "a plane or a hollow shape does not repeat: give faces"):
                signorini.pair_obstacle(places, faces, rigid, sector=sector)

    def test_nodes_on_the_axis_stay_there(self):
        axis = np.array([1.0, 2, 2]) / 3
        places = np.array([[0, 0, 0], [3, 0, 0], [-1, 2, 2.0]])
        sector = signorini.Sector(4, (0, 0, 0), axis)
        cross = np.cross(axis, places[1])
        along = axis * (axis @ places[1])
        places[2] = along + cross  # (3, 0, 0), a quarter turned
        equations = {dof: (dofs, numbers) for dof, dofs, numbers in signorini.sector_equations(places, sector)}
        self.assertEqual(set(equations), {0, 2, 6, 7, 8} if abs(axis).argmax() == 1 else {0, 1, 6, 7, 8})
        u = np.zeros(9)
        kept = abs(axis).argmax()
        u[:3][kept], u[3:6] = axis[kept], [0.3, -0.2, 0.5]
        for dof, (dofs, numbers) in equations.items():
            u[dof] = np.dot(u[np.asarray(dofs, int)], numbers)
        np.testing.assert_allclose(u[:3], axis, atol=1e-15)
        # A quarter turn keeps the part along the axis, and turns the rest.
        v = u[3:6]
        np.testing.assert_allclose(u[6:], axis * (axis @ v) + np.cross(axis, v), atol=1e-15)

    def test_the_skin_of_a_sector_is_without_its_boundaries(self):
        """Boundaries are inside of the whole body: the skin pairs as the faces at the interface alone do."""
        def mesh(radii):
            angles = np.pi / 3 * np.arange(4) / 3
            at = np.array([[r * np.cos(a), r * np.sin(a)] for a in angles for r in radii])
            quads = [[3 * i + k, 3 * i + k + 1, 3 * i + k + 4, 3 * i + k + 3] for i in range(3) for k in range(2)]
            return at, {"quad": np.array(quads)}

        def interface(at):
            return abs(np.hypot(*at.T) - 1) < 1e-6

        ring, hub = mesh((1.0, 1.2, 1.5)), mesh((0.5, 0.8, 1.0))
        sector = signorini.Sector(6, (0.0, 0.0))
        whole, named = (signorini.pair_meshes(ring, hub, slave_faces=faces, master_faces=faces, sector=sector)
                        for faces in (None, interface))
        self.assertEqual(whole.nodes.tolist(), named.nodes.tolist())
        np.testing.assert_allclose(whole.areas, named.areas, rtol=1e-12)
        for (dofs, vectors), (others, expected) in zip(whole.rows, named.rows):
            self.assertEqual(dofs.tolist(), others.tolist())
            np.testing.assert_allclose(vectors, expected, atol=1e-12)

        # A ring in two parts, with nodes of their own where they meet: its faces in contact are named.
        at, cells = mesh((1.0, 1.2, 1.5))
        parts = np.vstack([at, at]), {"quad": np.vstack([cells["quad"][::2], cells["quad"][1::2] + len(at)])}
        with self.assertRaisesRegex(signorini.SignoriniError, "at one place on its boundary: .* give slave_faces and master_"):
            signorini.pair_meshes(parts, hub, sector=sector)
        apart = signorini.pair_meshes(parts, hub, slave_faces=interface, sector=sector)
        np.testing.assert_allclose(apart.areas, named.areas, rtol=1e-12)

    def test_a_sector_without_equations(self):
        """Boundaries that nothing holds together are warned of."""
        places, (ring, hub), _, _ = self.ring(5, False, 2)
        springs = np.ones(places.size), np.arange(places.size), np.arange(places.size + 1)
        contact = signorini.pair_surfaces(places, ring, hub, sector=(5, (0.0, 0.0)))
        with self.assertWarnsRegex(UserWarning, "zone 'ring': pairs of a Sector without equations.*: give equations=sector_eq"):
            signorini.Model.from_surfaces(springs, {"ring": contact})

    def test_boundaries_that_do_not_match(self):
        places, (ring, hub), _, first = self.ring(5, False, 2)
        bodies = 1 * (np.arange(len(places)) >= first)
        with self.assertRaisesRegex(ValueError, "no node is the image of another, turned by one of 7 sectors"):
            signorini.sector_equations(places, signorini.Sector(7, (0.0, 0.0)), bodies=bodies)
        twice = np.concatenate([places, places])
        with self.assertRaisesRegex(ValueError, r"the image of node 0 is at the place of nodes 3 and \d+: give bodies"):
            signorini.sector_equations(twice, signorini.Sector(5, (0.0, 0.0)))
        with self.assertRaisesRegex(signorini.SignoriniError, "give the axis of the sector and the number of sectors"):
            signorini.pair_surfaces(places, ring, hub, sector=(9, (0.0, 0.0)))
        # Two zones, each with one boundary of the ring.
        zones = {name: signorini.pair_surfaces(places, faces, hub, sector=(5, (0.0, 0.0)), search_distance=0.5)
                 for name, faces in (("first", ring[:2]), ("second", ring[2:]))}
        springs = np.ones(places.size), np.arange(places.size), np.arange(places.size + 1)
        wanted = "node 0 of zone 'first' and node 3 of zone 'second' are images of each other"
        with self.assertRaisesRegex(signorini.SignoriniError, wanted):
            signorini.Model.from_surfaces(springs, zones)


class Decks(unittest.TestCase):
    def read(self, deck, encoding="utf-8", **more):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "deck.inp")
            with open(path, "w", encoding=encoding) as file:
                file.write(deck)
            return signorini.read_equations(path, **more)

    def test_cards(self):
        deck = ("*NODE\n1,0.,0.,0.\n*Equation\n ** a comment\n3\n2,1,2.0,5,1,-1,\n5,2,4.d0\n1\n3,2,1.\n"
                "*BOUNDARY\n3,1\n*EQUATION\n2\n7,3,1.,1,3,-1.\n")
        self.assertEqual(self.read(deck), [(3, [12, 13], [0.5, -2.0]), (7, [], []), (20, [2], [1.0])])
        found = self.read(deck, number=lambda node, direction: 10 * node + direction)
        self.assertEqual(found[0], (21, [51, 52], [0.5, -2.0]))

    def test_encodings(self):
        deck = "*EQUATION\n2\n2,1,1.0,5,1,-1.\n"
        self.assertEqual(self.read(deck, encoding="utf-8-sig"), [(3, [12], [1.0])])
        with self.assertRaisesRegex(ValueError, "line 1: a NUL character, .* save it as UTF-8"):
            self.read(deck, encoding="utf-16")

    def test_types_of_mpc(self):
        """Motions that each type allows obey its equations, and one that it forbids does not: rigid motions, those along
        a line, and those that nothing turns."""
        places = {1: [0.5, 1.5, -0.5], 2: [0, 1, -1], 3: [2, 3, 1], 4: [0, 0, 0]}
        deck = "*NODE\n" + "".join(f"{node}, {x}, {y}, {z}\n" for node, (x, y, z) in places.items())

        def number(node, direction):
            return 6 * (node - 1) + direction - 1

        def motion(shift, turn):
            """Of all nodes: displacements and rotations."""
            moved = [np.add(shift, np.cross(turn, place)) for place in places.values()]
            return np.concatenate([np.append(u, turn) for u in moved])

        def off(line, u):
            found = self.read(f"{deck}*MPC\n{line}\n", number=number)
            return len(found), max(abs(u[dof] - np.dot(u[dofs], factors)) for dof, dofs, factors in found)
        still, rigid = motion([0.3, -0.2, 0.5], [0, 0, 0]), motion([0.3, -0.2, 0.5], [0.1, 0.7, -0.4])
        along, across = np.zeros(24), np.zeros(24)
        along[:3], across[:3] = [1, 1, 1], [1, -1, 0]  # node 1 along and across the line from 2 to 3
        for line, count, allowed, forbidden in (
                ("BEAM, 1, 2", 6, rigid, along), ("Link,1,2,", 1, rigid + across, along),
                ("PIN,1,2", 3, still, rigid), ("TIE,1,2", 6, still, rigid),
                ("SLIDER,1,2,3", 2, rigid + along, across), ("LINEAR,1,2,3", 6, rigid, along)):
            with self.subTest(line):
                self.assertEqual(off(line, allowed)[0], count)
                self.assertLess(off(line, allowed)[1], 1e-15)
                self.assertGreater(off(line, forbidden)[1], 0.1)
        self.assertEqual(self.read("*MPC\nTIE,1\n** more\n0,2\nTIE,3,4\n*STEP\n*MPC\nTIE,5,6\n0"), self.read(
            "*MPC\nTIE,1,2\nTIE,3,4\nTIE,5,6\n"))
        self.assertEqual(self.read("*MPC\nTIE,1,2\n"), [(0, [3], [1.0]), (1, [4], [1.0]), (2, [5], [1.0])])
        for line, part in (("ELBOW,1,2", "the type ELBOW is not read: write it as .EQUATION, .* that are read are BEAM, LINEAR"),
                           ("QUADRATIC,1,2,3,4", "the type QUADRATIC is not read: write it as .EQUATION"),
                           ("PLANE,1,2,3\n0,4", "line 7: PLANE,1,2,3 0,4: the type PLANE is not read"),
                           ("PIN,1\n0,2,3\n0,4", "line 7: PIN,1 0,2,3 0,4: PIN has 4 nodes, it must have 2"),
                           ("0,1,2", "the type 0 is not read"), ("PIN,0,2", "there is no node 0, nodes of decks count from 1"),
                           ("PIN,1,2,3", "PIN has 3 nodes, it must have 2"), ("PIN,SET,2", "no type with numbers"),
                           ("LINK,1,9", "node 9 has no place"), ("SLIDER,4,2,3", "node 4 is 1.41 off the line"),
                           ("LINK,1,1", "nodes 1 and 1 are at one place"),
                           ("BEAM,1,2", "BEAM needs the rotations of node 2")):
            with self.assertRaisesRegex(ValueError, part):
                self.read(f"{deck}*MPC\n{line}\n")
        with self.assertRaisesRegex(ValueError, "LINK,1,2: the first node lacks the direction that depends"):
            self.read(f"{deck}*MPC\nLINK,1,2\n", number=lambda node, direction: None)

    def test_cards_of_two_lines(self):
        for deck in ("*NODE,\n** a comment\nNSET=ALL\n1,0,1,0\n2,1,0,0\n*MPC\nPIN,1,2\n", "*NODE,\n1,0,1,0\n2,1,0,0\n*MPC\nPIN,1,2\n"):
            self.assertEqual(self.read(deck), [(k, [3 + k], [1.0]) for k in range(3)])
        for deck, part in (("*NODE, NSET=N,\n SYSTEM=C\n1,1,0,0\n", "line 2: .NODE, NSET=N, SYSTEM=C: places in a system"),
                           ("*EQUATION,\nREMOVE\n", "line 2: .* a card with REMOVE")):
            with self.assertRaisesRegex(ValueError, part):
                self.read(deck)

    def test_places_along_other_axes(self):
        """A link between nodes at (0, 1, 0) and (1, 0, 0) lets both go aside together, along (1, -1, 0) nothing."""
        link, polar = "*MPC\nLINK,1,2\n", "1,1.,90.,0.\n2,1.,0.,0.\n"
        plain = "1,0.,1.,0.\n2,1.,0.,0.\n"
        wanted = [(0, [3, 4, 1], [1.0, -1.0, 1.0])]
        remedy = "not read: give coordinates, along the axes of the model"
        decks = {"NODE, system = c": f"*NODE, system = c\n{polar}{link}", "NODE, NSET=N, SYSTEM=S": f"*NODE, NSET=N, SYSTEM=S\n{polar}{link}",
                 "SYSTEM: 0,0,0,0,1,0": f"*System\n0,0,0,0,1,0\n*NODE\n{plain}{link}", "NMAP": f"*NODE\n{plain}*NMAP, NSET=N\n0,0,0,0,0,1\n{link}",
                 "INSTANCE: 0,0,0,0,0,1,90.": f"*PART, NAME=P\n*NODE\n{plain}{link}*END PART\n*INSTANCE, NAME=I, PART=P\n1,0,0\n0,0,0,0,0,1,90.\n"}
        for card, deck in decks.items():
            with self.subTest(card):
                with self.assertRaisesRegex(ValueError, rf"line \d+: \*{card}.*{remedy}"):
                    self.read(deck)
                self.assertEqual(self.read(deck, coordinates={1: (0, 1, 0), 2: (1, 0, 0)}), wanted)
        for deck in (f"*NODE, NSET=ALL\n{plain}{link}", f"*NODE, SYSTEM=R\n{plain}{link}", f"*SYSTEM\n*NODE\n{plain}{plain}{link}",
                     f"*PART, NAME=P\n*NODE\n{plain}*NODE\n3,0,0,0\n{link}*END PART\n*INSTANCE, NAME=I, PART=P\n1,0,0\n"):
            self.assertEqual(self.read(deck), wanted)

    def test_a_number_in_two_parts(self):
        deck = "*PART, NAME=A\n*NODE\n1,0,0,0\n2,1,2,3\n*END PART\n*PART, NAME=B\n*NODE\n{},5,0,0\n*END PART\n*MPC\nPIN,1,2\n"
        self.assertEqual(self.read(deck.format(3)), [(k, [3 + k], [1.0]) for k in range(3)])
        for more in {}, {"coordinates": {1: (0, 0, 0), 2: (1, 2, 3)}}:
            with self.assertRaisesRegex(ValueError, r"line 8: 1,5,0,0: node 1 is in \*PART, NAME=A too, .* numbers of their own"):
                self.read(deck.format(1), **more)

    def test_what_is_wrong_is_named(self):
        for deck, part in (("*EQUATION\nx\n", "line 2: x: this is no number of terms"),
                           ("*EQUATION\n2\nSET,1,1.,3,1,1.\n", "line 3: SET,1,1.,3,1,1."),
                           ("*EQUATION\n2\n1,1,1.\n*STEP\n", "line 4: 1 terms of the equation before are missing"),
                           ("*EQUATION\n2\n1,1,1.\n", "1 terms of the last equation are missing"),
                           ("*EQUATION\n1\n1,1,1.,2,1,1.\n", "line 3: the equation has more terms"),
                           ("*EQUATION\n1\n1,1,0.\n", "line 3: the coefficient of the first term is 0"),
                           ("*NODE\n1,0,0\n*INCLUDE, INPUT=more.inc\n", "line 3: .*INPUT=more.inc: the file is not read"),
                           ("*TRANSFORM, NSET=N, TYPE=C\n0,0,0,0,0,1\n", "line 1: .*TYPE=C: axes of nodes are not turned"),
                           ("*EQUATION\n2\n1,1,1.,2,4,1.\n", "line 3: .*: node 2 has no direction 4"),
                           ("*EQUATION\n2\n1,1,1.,2,0,1.\n", "line 3: .*: node 2 has no direction 0"),
                           ("*EQUATION\n2\n1,1,1.,0,1,-1.\n", "line 3: .*: there is no node 0, nodes of decks count from 1"),
                           ("*EQUATION\n1\n-2,1,1.\n", "line 3: .*: there is no node -2"),
                           ("*EQUATION\n2\n1,1,1e400,2,1,-1.\n", "line 3: a coefficient, .* beyond the range of numbers"),
                           ("*EQUATION\n2\n1,1,1.,2,1,inf\n", "line 3: a coefficient, .* beyond the range"),
                           ("*EQUATION\n2\n1,1,1e-300,2,1,1e300\n", "line 3: a coefficient, .* beyond the range"),
                           ("*EQUATION\n2\n1,1,nan,2,1,1.\n", "line 3: a coefficient, .* beyond the range"),
                           ("*MPC, MODE=NODE\n", "line 1: .* a card with MODE=NODE is not read"),
                           ("*EQUATION, REMOVE=ALL\n", "line 1: .* a card with REMOVE=ALL is not read")):
            with self.assertRaisesRegex(ValueError, part):
                self.read(deck)


if __name__ == "__main__":
    unittest.main()
