"""The Python package: second solutions, proofs that there is none, certificates, frames, loads.

    python3 tests/python/solutions.py
"""

import unittest

import numpy as np

from common import LOAD, K

import bar_mesh
import signorini
from signorini import State, Status, Uniqueness


class Proof(unittest.TestCase):
    """Klarbring's pair with one solution, stuck at zero: F = -f, exactly."""

    stiffness, load = np.array([[2.0, 1.0], [1.0, 1.0]]), [1.0, 0.25]

    def test_of_a_result(self):
        plain = signorini.solve(self.stiffness, self.load, 0.0, 0.5)
        self.assertEqual(plain.report.proof, signorini.Proof.NOT_ASKED)
        self.assertEqual((plain.radius_d, plain.radius_F), (None, None))
        result = signorini.solve(self.stiffness, self.load, 0.0, 0.5, proof=True)
        self.assertEqual(result.report.proof, signorini.Proof.PROVED)
        self.assertTrue((abs(result.d) <= result.radius_d).all())
        self.assertTrue((abs(result.F + self.load) <= result.radius_F).all())
        self.assertLess(result.radius_F.max(), 1e-14)
        # Friction is just enough: on the boundary of two states.
        edge = signorini.solve(self.stiffness, [1.0, 0.5], 0.0, 0.5, proof=True)
        self.assertEqual((edge.status, edge.report.proof),
                         (Status.SOLVED, signorini.Proof.NOT_PROVED))

    def test_of_displacements(self):
        found = signorini.prove(self.stiffness, self.load, 0.0, 0.5, d=[0, 1e-9])
        self.assertTrue((found.radius_d >= [0, 1e-9]).all() and found.radius_d.max() < 2e-9)
        self.assertIsNone(signorini.prove(self.stiffness, self.load, 0.0, 0.5, d=[0, 0],
                                          state=[State.SLIP]))
        with self.assertRaisesRegex(ValueError, "state has the shape"):
            signorini.prove(self.stiffness, self.load, 0.0, 0.5, d=[0, 0], state=[1, 2])
        model = signorini.Model.condensed(self.stiffness)
        again = model.prove(self.load, 0.0, 0.5, d=[0, 1e-9])
        for one, other in zip(again, found):
            np.testing.assert_array_equal(one, other)
        self.assertIsNone(model.prove(self.load, 0.0, 0.5, d=[0, 0], state=[State.SLIP]))


class Flexibility(unittest.TestCase):
    """A node on springs of stiffness 2, pressed by (1, -1) on floor and wall; tests/flexibility/closed_forms.rs."""

    W = np.array([[1, 0, 0, -1], [0, 1, 1, 0], [0, 1, 1, 0], [-1, 0, 0, 1]]) / 2
    q = np.array([1, 1, 1, -1]) / 2

    def test_corner(self):
        result = signorini.solve_flexibility(self.W, self.q, mu=0.25)
        self.assertEqual(result.status, Status.SOLVED)
        np.testing.assert_allclose(abs(result.F), [[0.8, 0.2], [0.8, 0.2]], atol=1e-8)
        np.testing.assert_allclose(result.d, np.zeros((2, 2)), atol=1e-8)
        again = signorini.solve_flexibility(self.W, self.q, mu=0.25, start=result.F)
        np.testing.assert_allclose(again.F, result.F, atol=1e-8)

    def test_one_pair(self):
        """It sticks where friction holds q / W: F = -q / W."""
        for q in ([2.0, 0.5], [[2.0, 0.5]]):
            result = signorini.solve_flexibility(np.eye(2) / 2, q, mu=0.3)
            self.assertEqual(result.status, Status.SOLVED)
            np.testing.assert_allclose(result.F, [[-4.0, -1.0]], atol=1e-12)

    def test_sparse(self):
        lower = ([0.5, -0.5, 0.5, 0.5, 0.5, 0.5], [0, 3, 1, 2, 2, 3], [0, 2, 4, 5, 6])
        result = signorini.solve_flexibility(lower, self.q, mu=0.25, triangle="lower")
        self.assertEqual(result.status, Status.SOLVED)
        np.testing.assert_allclose(abs(result.F), [[0.8, 0.2], [0.8, 0.2]], atol=1e-8)
        again = signorini.solve_flexibility(lower, self.q, mu=0.25, triangle="lower", start=result.F)
        np.testing.assert_allclose(again.F, result.F, atol=1e-8)
        with self.assertRaisesRegex(signorini.SignoriniError, "not in the triangle"):
            signorini.solve_flexibility(lower, self.q, mu=0.25, triangle="upper")
        with self.assertRaisesRegex(ValueError, "indptr of W ends with 6"):
            signorini.solve_flexibility((lower[0][:5], lower[1][:5], lower[2]), self.q)
        with self.assertRaisesRegex(signorini.SignoriniError, "W is zero"):
            signorini.solve_flexibility(([], [], [0] * 5), self.q)

    def test_refusals(self):
        with self.assertRaisesRegex(signorini.SignoriniError, "W is zero"):
            signorini.solve_flexibility(np.zeros((2, 2)), [0, 0])
        with self.assertRaisesRegex(ValueError, "q"):
            signorini.solve_flexibility(self.W, self.q[:3])

    def test_model(self):
        model = signorini.Model.flexibility(self.W)
        self.assertEqual((model.kind, model.pairs, model.host_size), (signorini.ModelKind.FLEXIBILITY, 2, 4))
        self.assertGreater(model.memory, 0)
        results = model.solve([self.q, 2 * self.q], 0.0, 0.25)
        for factor, result in enumerate(results, 1):
            self.assertEqual(result.status, Status.SOLVED)
            np.testing.assert_allclose(abs(result.F), factor * np.array([[0.8, 0.2], [0.8, 0.2]]), atol=1e-8)
        found = model.certify(self.q, 0.0, 0.25, d=results[0].d, F=results[0].F)
        self.assertEqual(found.status, Status.SOLVED)
        np.testing.assert_array_equal(found.F, results[0].F)
        wrong = model.certify(self.q, 0.0, 0.25, d=results[0].d, F=2 * results[0].F)
        self.assertEqual(wrong.status, Status.NOT_A_SOLUTION)
        # Forces that d does not tell are asked for; a missing matrix is named.
        with self.assertRaisesRegex(TypeError, "F is None: give the forces too"):
            model.certify(self.q, 0.0, 0.25, d=results[0].d)
        with self.assertRaisesRegex(signorini.SignoriniError, "the model has a flexibility"):
            model.stiffness  # pylint: disable=pointless-statement
        with self.assertRaisesRegex(ValueError, "W has the shape"):
            signorini.Model.flexibility(self.W, dim=3)


class Klarbring(unittest.TestCase):
    """One pair with three solutions in closed form; tests/solve/klarbring.rs has the source."""

    stiffness = np.array([[2.0, 1.0], [1.0, 1.0]])

    def known(self, tangential):
        """Displacements and states: stuck, sliding, open."""
        return [([0, 0], State.STICK), ([0, 2 - tangential], State.SLIP),
                ([1 - tangential, 2 * tangential - 1], State.OPEN)]

    def which(self, result, tangential):
        for number, (d, state) in enumerate(self.known(tangential)):
            if abs(result.d[0] - d).max() <= 1e-9:
                self.assertEqual(result.state[0], state)
                forces = self.stiffness @ d - [1.0, tangential]
                np.testing.assert_allclose(result.F[0], forces, atol=1e-9)
                return number
        self.fail(f"{result.d} is none of the three")

    def two_of_three(self, result, tangential):
        self.assertIs(result.status, Status.SOLVED)
        self.assertIs(result.report.uniqueness, Uniqueness.SEVERAL)
        second = result.second
        self.assertEqual((second.status, second.message), (Status.SOLVED, "solved"))
        self.assertLessEqual(second.report.eta, 1e-10)
        self.assertEqual((second.motion, second.second), (None, None))
        self.assertNotEqual(self.which(result, tangential), self.which(second, tangential))

    def test_a_second_solution_has_its_own_place(self):
        for tangential in (1.1, 1.5, 1.9):
            for method in ("auto", "newton", "lemke"):
                for start in (None, *[d for d, _ in self.known(tangential)]):
                    self.two_of_three(
                        signorini.solve(self.stiffness, [1.0, tangential], 0.0, 2.0, method=method,
                                        search="others", start=start), tangential)

    def test_of_several_cases(self):
        model = signorini.Model.condensed(self.stiffness)
        several = [2.0, 0.4, 2.0]  # below 1/2 the solution is the only one
        loads = [[1.0, 1.1], [1.0, 1.5], [1.0, 1.9]]
        first, unique, last = model.solve(loads, 0.0, np.reshape(several, (3, 1)), search="others")
        self.two_of_three(first, 1.1)
        self.two_of_three(last, 1.9)
        self.assertEqual((unique.second, unique.report.uniqueness), (None, Uniqueness.UNIQUE))


class NoEquilibrium(unittest.TestCase):
    floating = [[1, 0, -1, 0], [0, 1, 0, 0], [-1, 0, 1, 0], [0, 0, 0, 1]]
    lifted = [-1, 0, -1, 0]

    def escapes(self, result):
        self.assertIs(result.status, Status.NO_EQUILIBRIUM)
        self.assertTrue(result.message)
        self.assertEqual((result.d.shape, result.F.shape), ((2, 2), (2, 2)))
        self.assertTrue(np.isfinite(result.d).all() and np.isfinite(result.F).all())
        self.assertEqual(np.shape(result.motion), (2, 2))
        # Both pairs lift: nothing resists, and the loads do work.
        np.testing.assert_allclose(result.motion, [[-1, 0], [-1, 0]], atol=1e-9)
        self.assertIsNone(result.second)

    def test_the_motion_of_escape_has_its_own_place(self):
        for friction in ({}, {"mu": 0.3}):
            self.escapes(signorini.solve(self.floating, self.lifted, 0.0, **friction))
        model = signorini.Model.condensed(self.floating)
        self.escapes(model.solve(self.lifted, 0.0, 0.3))
        pressed, lifted = model.solve([np.negative(self.lifted), self.lifted], 0.0, 0.3)
        self.escapes(lifted)
        self.assertIs(pressed.status, Status.SOLVED)
        self.assertIsNone(pressed.motion)
        self.assertIsNone(pressed.escape)

    def test_a_block_that_slides_stays_on_its_plane(self):
        # Pressed by 1 and pushed by 1 at either pair, mu 0.5: the proof lifts it, the body does not.
        free = np.kron([[1, -1], [-1, 1]], np.eye(2))
        for result in (signorini.solve(free, np.ones(4), 0.0, mu=0.5),
                       signorini.Model.condensed(free).solve(np.ones(4), 0.0, 0.5)):
            self.assertIs(result.status, Status.NO_EQUILIBRIUM)
            np.testing.assert_allclose(result.motion, [[-0.5, 1], [-0.5, 1]], atol=1e-9)
            np.testing.assert_allclose(result.escape, [[0, 1], [0, 1]], atol=1e-9)

    def test_no_obstacle_is_no_escape(self):
        result = signorini.solve(np.eye(2), [1, 0], np.inf, 0.0)
        self.assertEqual((result.status, result.motion), (Status.SOLVED, None))
        np.testing.assert_allclose(result.d, [[1, 0]], atol=1e-12)


class Lcps(unittest.TestCase):
    def test_of_an_unsymmetric_matrix(self):
        M, q = np.array([[2.0, 1.0], [0.0, 1.0]]), np.array([-3.0, -1.0])
        for result in (signorini.lcp_solve(M, q), signorini.lcp_solve(M, q, method="lemke"),
                       signorini.lcp_lemke(M, q), signorini.lcp_lemke(M, q, [1.0, 2.0])):
            self.assertEqual((result.status, result.y), (Status.SOLVED, None))
            np.testing.assert_allclose(result.z, [1, 1])
            np.testing.assert_allclose(q + M @ result.z, result.w, atol=1e-12)

    def test_a_proof_that_there_is_none(self):
        M, q = np.array([[0.0, 0.0], [0.0, 1.0]]), np.array([-1.0, -1.0])
        for none in (signorini.lcp_solve(M, q), signorini.lcp_lemke(M, q)):
            self.assertIs(none.status, Status.NO_EQUILIBRIUM)
            self.assertTrue((none.y >= 0).all() and (M.T @ none.y <= 1e-12).all())
            self.assertLess(q @ none.y, 0)
            self.assertEqual((none.z.shape, none.w.shape), ((2,), (2,)))

    def test_cover_is_looked_at(self):
        with self.assertRaisesRegex(signorini.SignoriniError, "cover"):
            signorini.lcp_lemke(np.eye(2), [1.0, 1.0], [1.0, -1.0])


class Certificates(unittest.TestCase):
    def test_of_condensed_problems(self):
        for law in ({"mu": 0.3}, {"g": 0.5}, {}):
            for slip0 in (None, [0.05, -0.05]):
                solved = signorini.solve(K, LOAD, 0.0, **law, slip0=slip0)
                same = signorini.certify(K, LOAD, 0.0, **law, slip0=slip0, d=solved.d)
                self.assertEqual((same.status, same.message), (Status.SOLVED, "solved"))
                np.testing.assert_allclose(same.F, solved.F, atol=1e-9)
                np.testing.assert_array_equal(same.state, solved.state)
                for entry in range(4):
                    off = solved.d.copy()
                    off.flat[entry] += 1e-3
                    other = signorini.certify(K, LOAD, 0.0, **law, slip0=slip0, d=off,
                                              tolerance=1e-6)
                    self.assertIs(other.status, Status.NOT_A_SOLUTION)
                    self.assertGreater(other.report.eta, 1e-6)

    def test_of_models(self):
        bar = bar_mesh.assemble()
        model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        solved = model.solve(bar.load, 0.0, 1.0)
        same = model.certify(bar.load, 0.0, 1.0, d=solved.d)
        self.assertIs(same.status, Status.SOLVED)
        self.assertIs(model.certify(bar.load, 0.0, 1.0, d=solved.d * 1.001).status,
                      Status.NOT_A_SOLUTION)
        self.assertIs(model.certify(bar.load, 0.0, 0.5, d=solved.d).status, Status.NOT_A_SOLUTION)

    def test_leaves_what_it_measures(self):
        d = np.ones((2, 2))
        signorini.certify(K, LOAD, 0.0, 0.3, d=d)
        np.testing.assert_array_equal(d, np.ones((2, 2)))


class Rows(unittest.TestCase):
    """Node A (0, 1) and node B (2, 3), each on springs of stiffness 2."""

    springs = (np.full(4, 2.0), np.arange(4), np.arange(5))

    def test_a_row_is_a_pair(self):
        named = signorini.Model.sparse(self.springs, [[0, 1]], [0.0, -1.0], masters=[[[2, 3]]])
        rows = [([[0, 1], [2, 3]], [1.0, -1.0])]
        listed = signorini.Model.sparse(self.springs, normals=[0.0, -1.0], rows=rows)
        for model in (named, listed):  # two springs of 2 in a row are one of 1
            np.testing.assert_allclose(model.stiffness, np.eye(2), atol=1e-14)
            forces = model.nodal_forces(np.array([[-3.0, 1.0]]))
            np.testing.assert_allclose(forces, [1, 3, -1, -3], atol=1e-14)

    def test_a_node_on_two_planes(self):
        rows = [([[0, 1]], [1.0])] * 2
        model = signorini.Model.sparse(self.springs, normals=[[0, -1], [1, 0]], rows=rows)
        result = model.solve([1.0, -1.0, 0.0, 0.0], 0.0, 0.25)
        self.assertIs(result.status, Status.SOLVED)
        np.testing.assert_allclose(result.d, np.zeros((2, 2)), atol=1e-8)
        # N + T = 1 on either plane, and T = mu N: the smallest forces that share the load.
        np.testing.assert_allclose(np.abs(result.F), [[0.8, 0.2], [0.8, 0.2]], atol=1e-8)
        with self.assertRaisesRegex(signorini.SignoriniError, "follow from those of other pairs"):
            model.stiffness  # pylint: disable=pointless-statement
        case = [1.0, -1.0, 0.0, 0.0], 0.0, 0.25
        self.assertEqual(model.certify(*case, d=result.d, F=result.F).status, Status.SOLVED)
        self.assertEqual(model.certify(*case, d=result.d, F=0 * result.F).status, Status.NOT_A_SOLUTION)
        with self.assertRaisesRegex(TypeError, "F is None"):
            model.certify(*case, d=result.d)

    def test_refusals(self):
        sparse, row = signorini.Model.sparse, ([[0, 1], [2, 3]], [1.0, -1.0])
        for part, arguments in (
            ("rows is given with slaves", {"slaves": [[0, 1]], "rows": [row]}),
            ("slaves is None", {}),
            ("rows is no list of pairs", {"rows": [1, 2]}),
            ("weights[0]", {"rows": [(row[0], [1.0])]}),
            ("rows has nodes of the shapes", {"rows": [([[0], [2]], [1.0, -1.0])]}),
        ):
            with self.assertRaises((ValueError, TypeError)) as caught:
                sparse(self.springs, normals=[0.0, -1.0], **arguments)
            self.assertIn(part, str(caught.exception))


class Frames(unittest.TestCase):
    def springs(self, dim, pairs):
        """Free nodes on springs: each node is a slave."""
        size = dim * pairs
        matrix = np.arange(1.0, size + 1), np.arange(size), np.arange(size + 1)
        return matrix, np.arange(size).reshape(pairs, dim)

    def test_are_orthonormal_and_turn_forces(self):
        rng = np.random.default_rng(7)
        for dim in (2, 3):
            matrix, slaves = self.springs(dim, 5)
            normals = rng.normal(size=(5, dim))
            turned = normals[:, ::-1] * [-1, 1] if dim == 2 else np.cross(normals, [1, 2, 3])
            for tangents in (None, turned):
                model = signorini.Model.sparse(matrix, slaves, normals, tangents=tangents)
                frames = model.frames
                self.assertEqual(frames.shape, (5, dim, dim))
                unit = normals / np.linalg.norm(normals, axis=1)[:, None]
                np.testing.assert_allclose(frames[:, 0], unit, atol=1e-15)
                products = frames @ frames.transpose(0, 2, 1)
                np.testing.assert_allclose(products, np.tile(np.eye(dim), (5, 1, 1)), atol=1e-14)
                if tangents is not None:  # the first tangent is the one given
                    self.assertTrue((np.einsum("pi,pi->p", frames[:, 1], tangents) > 0).all())
                result = model.solve(np.repeat(unit, 1, axis=0).ravel() * 3.0, 0.0, 0.3)
                axes = np.einsum("pi,pij->pj", result.F, frames)
                np.testing.assert_allclose(axes.ravel(), model.nodal_forces(result.F), atol=1e-14)
                moved = np.einsum("pi,pij->pj", result.d, frames)
                load = unit.ravel() * 3.0
                np.testing.assert_allclose(moved.ravel(), model.recover(result.d, load),
                                           atol=1e-12)

    def test_of_the_host_are_not_known(self):
        for model in (signorini.Model.condensed(K), signorini.Model.two_body(K, K)):
            with self.assertRaises(signorini.SignoriniError) as caught:
                _ = model.frames
            self.assertEqual(caught.exception.status, -1)


class CondensedLoads(unittest.TestCase):
    def test_are_in_equilibrium_with_the_forces(self):
        bar = bar_mesh.assemble()
        model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        # The first of the supports is on the obstacle, where it must not move.
        for held in (None, 0.0, np.linspace(0, 1e-3, len(bar.held))):
            result = model.solve(bar.load, 0.0, 1.0, prescribed=held, tolerance=1e-13)
            load = model.condensed_load(bar.load, held)
            self.assertEqual(load.shape, (model.pairs, 2))
            forces = model.stiffness @ result.d.ravel() - load.ravel()
            np.testing.assert_allclose(forces, result.F.ravel(), atol=1e-9 * abs(result.F).max())
        own = signorini.Model.condensed(K).condensed_load(LOAD)
        np.testing.assert_array_equal(own.ravel(), LOAD)


if __name__ == "__main__":
    unittest.main()
