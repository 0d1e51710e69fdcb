"""signorini.py: what it returns, what it refuses, and in which words.

    python3 tests/python/results.py
"""

import re
import unittest

import numpy as np

from common import LOAD, K, chain, text

import bar_mesh
import signorini


def reference(name):
    """An array of bar_reference.h."""
    header = text("c_examples", "bar", "bar_reference.h")
    body = re.search(name + r"\[BAR_SIZE\] = \{(.*?)\}", header, re.S)[1]
    return np.array([float(word) for word in body.split(",") if word.strip()]).reshape(-1, 2)


class Bar(unittest.TestCase):
    def test_is_that_of_the_reference(self):
        bar = bar_mesh.assemble()
        model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        whole = model.solve(bar.load, gap=0.0, mu=1.0, tolerance=1e-13)
        condensed = signorini.solve(*bar_mesh.condense(bar), gap=0.0, mu=1.0, tolerance=1e-13)
        for result in (whole, condensed):
            self.assertEqual((result.status, result.message), (signorini.SOLVED, "solved"))
            for name in ("d", "F"):
                expected = reference("reference_" + name)
                off = abs(getattr(result, name) - expected).max() / abs(expected).max()
                self.assertLess(off, 1e-9, name)
            self.assertEqual(list(result.state), [0] * 3 + [1] * 15 + [2] * 15)
            report = result.report
            self.assertEqual((report.open, report.slip, report.stick), (3, 15, 15))
            self.assertIn(report.method, signorini.METHODS)
        u = model.recover(whole.d, bar.load)
        np.testing.assert_array_equal(u[bar.contact], whole.d[:, ::-1] * [1, -1])
        nodal = model.nodal_forces(whole.F)
        np.testing.assert_array_equal(nodal[bar.contact], whole.F[:, ::-1] * [1, -1])

    def test_is_the_same_by_other_triangles_and_widths(self):
        bar = bar_mesh.assemble()
        data, rows, starts = bar.matrix
        columns = np.repeat(np.arange(len(bar.load)), np.diff(starts))
        first = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held).stiffness
        for triangle, kept in (("lower", rows >= columns), ("upper", rows <= columns)):
            begins = np.concatenate([[0], np.cumsum(np.bincount(columns[kept]))]).astype(np.int32)
            part = (data[kept], rows[kept].astype(np.int32), begins)
            model = signorini.Model.sparse(part, bar.contact, [0, -1], fixed=bar.held,
                                           triangle=triangle)
            np.testing.assert_allclose(model.stiffness, first, rtol=1e-12, atol=1e-8)

    def test_from_scipy(self):
        try:
            from scipy.sparse import csc_matrix
        except ImportError:
            self.skipTest("scipy is not installed")
        bar = bar_mesh.assemble()
        given = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        for matrix in (csc_matrix(bar.matrix), csc_matrix(bar.matrix).tocoo()):
            model = signorini.Model.sparse(matrix, bar.contact, [0, -1], fixed=bar.held)
            np.testing.assert_array_equal(model.stiffness, given.stiffness)


class Calls(unittest.TestCase):
    def test_solve_takes_any_layout(self):
        expected = signorini.solve(K.astype(float), LOAD, 0.0, 0.3)
        np.testing.assert_allclose(expected.F[:, 0], [-1.7568, -3], atol=1e-4)
        every_other = np.zeros((8, 8))
        every_other[::2, ::2] = K
        for stiffness, load, gap, mu in (
            (K, LOAD, 0, 0.3),
            (np.asfortranarray(K, float), np.reshape(LOAD, (2, 2)), [0, 0], [0.3, 0.3]),
            (every_other[::2, ::2], np.array(LOAD, np.float32), np.zeros(2), np.full(2, 0.3)),
            (K.astype(">f8"), LOAD, 0.0, 0.3),
        ):
            result = signorini.solve(stiffness, load, gap, mu)
            np.testing.assert_array_equal(result.d, expected.d)
            np.testing.assert_array_equal(result.F, expected.F)
            np.testing.assert_array_equal(result.state, [signorini.SLIP, signorini.STICK])

    def test_solve_in_3d(self):
        result = signorini.solve(np.eye(3) * 2, [1, 3, 4], 0.0, 0.5, dim=3)
        np.testing.assert_allclose(result.F, [[-1, -0.3, -0.4]], rtol=1e-9)  # cone of radius 0.5
        self.assertEqual(result.d.shape, (1, 3))

    def test_tresca_and_slip(self):
        result = signorini.tresca(K, LOAD, 0.0, [0.1, 5.0], slip=[0.0, 0.01])
        np.testing.assert_allclose(result.F[0, 1], -0.1, rtol=1e-9)
        self.assertEqual(result.d[1, 1], 0.01)

    def test_start_and_settings(self):
        first = signorini.solve(K, LOAD, 0.0, 0.3, method="sor_nested", tolerance=1e-12)
        start = first.d.copy()
        again = signorini.solve(K, LOAD, 0.0, 0.3, method="sor_nested", tolerance=1e-12,
                                start=start)
        self.assertLess(again.report.iterations, first.report.iterations)
        self.assertEqual(again.report.method, "sor_nested")
        np.testing.assert_array_equal(start, first.d)
        limited = signorini.solve(*chain(), 0.01, 0.3, method="sor_nested", max_iterations=2)
        self.assertEqual(limited.status, signorini.ITERATION_LIMIT)
        self.assertEqual(limited.report.status, signorini.ITERATION_LIMIT)
        self.assertTrue(limited.message)
        unique = signorini.solve(K, LOAD, 0.0, 0.3, search="others").report.uniqueness
        self.assertEqual(unique, "unique")

    def test_no_equilibrium_is_a_result(self):
        result = signorini.solve(np.diag([1.0, 1.0]) - 0.0, [1, 0], np.inf, 0.0)
        self.assertEqual(result.status, signorini.SOLVED)
        floating = [[1, 0, -1, 0], [0, 1, 0, 0], [-1, 0, 1, 0], [0, 0, 0, 1]]
        result = signorini.solve(floating, [-1, 0, -1, 0], 0.0, 0.0)
        self.assertEqual(result.status, signorini.NO_EQUILIBRIUM)
        np.testing.assert_allclose(result.d[:, 0], [-1, -1], rtol=1e-9)

    def test_certify(self):
        solved = signorini.solve(K, LOAD, 0.0, 0.3)
        self.assertEqual(signorini.certify(K, LOAD, 0.0, 0.3, solved.d).status, signorini.SOLVED)
        other = signorini.certify(K, LOAD, 0.0, 0.3, solved.d * 1.1, tolerance=1e-3)
        self.assertEqual(other.status, signorini.NOT_A_SOLUTION)
        self.assertGreater(other.report.eta, 1e-3)

    def test_lcp_of_an_unsymmetric_matrix(self):
        M, q = np.array([[2.0, 1.0], [0.0, 1.0]]), np.array([-3.0, -1.0])
        for method in ("auto", "lemke"):
            result = signorini.lcp_solve(M, q, method=method)
            self.assertEqual(result.status, signorini.SOLVED)
            np.testing.assert_allclose(result.z, [1, 1])
            np.testing.assert_allclose(q + M @ result.z, result.w, atol=1e-12)
        none = signorini.lcp_solve([[0.0]], [-1.0])
        self.assertEqual(none.status, signorini.NO_EQUILIBRIUM)

    def test_empty_problem(self):
        self.assertEqual(signorini.solve(np.zeros((0, 0)), [], 0.0, 0.3).d.shape, (0, 2))


class Models(unittest.TestCase):
    def test_condensed_cases(self):
        model = signorini.Model.condensed(K)
        self.assertEqual((model.host_size, model.pairs, model.dim), (4, 2, 2))
        loads = np.outer([1, 2, 3], LOAD)
        results = model.solve(loads, 0.0, [[0.3, 0.3], [-1, 0.3], [0.5, 0.5]])
        self.assertEqual([r.status for r in results], [0, -6, 0])
        self.assertIn("mu[0]", results[1].message)
        self.assertTrue(np.isnan(results[1].d).all() and results[1].report is None)
        one = signorini.solve(K, loads[2], 0.0, 0.5)
        np.testing.assert_allclose(results[2].F, one.F, rtol=1e-12)
        np.testing.assert_array_equal(model.solve(LOAD, 0.0, 0.3).d, results[0].d)
        np.testing.assert_array_equal(model.stiffness, K)
        self.assertEqual(model.solve(np.zeros((0, 4)), 0.0, 0.3), [])

    def test_two_bodies(self):
        springs = np.diag([2.0, 3.0]), np.diag([6.0, 5.0])
        model = signorini.Model.two_body(*springs)
        self.assertEqual(model.host_size, 4)
        result = model.solve([4, 0, 0, 0], 0.0, 0.2)
        np.testing.assert_allclose(result.F, [[-3, 0]], atol=1e-12)  # 4 spread over 2 and 6
        u = model.recover(result.d, [4, 0, 0, 0])
        np.testing.assert_allclose(u, [0.5, 0, -0.5, 0], atol=1e-12)

    def test_masters_with_weights(self):
        # Node 0 above the middle of nodes 1 and 2, all on springs.
        k = (np.ones(6), np.arange(6), np.arange(7))
        model = signorini.Model.sparse(k, [[0, 1]], [[0, -1]], masters=[[[2, 3], [4, 5]]],
                                       weights=[[0.5, 0.5]])
        load = [0, -3, 0, 0, 0, 0]
        result = model.solve(load, 0.0, 0.0)
        u = model.recover(result.d, load)
        np.testing.assert_allclose(u, [0, -1, 0, -1, 0, -1], atol=1e-12)
        np.testing.assert_allclose(model.nodal_forces(result.F), [0, 2, 0, -1, 0, -1], atol=1e-12)

    def test_matching_masters_and_supports(self):
        k = (np.ones(4), np.arange(4), np.arange(5))
        model = signorini.Model.sparse(k, [[0, 1]], [0, -1], masters=[[2, 3]], fixed=[2, 3])
        result = model.solve([0, 0, 0, 0], 0.0, 0.0, prescribed=[0, 0.25])
        u = model.recover(result.d, [0, 0, 0, 0], prescribed=[0, 0.25])
        np.testing.assert_allclose(u, [0, 0.25, 0, 0.25], atol=1e-12)


class Refused(unittest.TestCase):
    def refused(self, kind, words, *arguments, **settings):
        with self.assertRaises(kind) as caught:
            signorini.solve(*arguments, **settings)
        self.assertIn(words, str(caught.exception))
        return caught.exception

    def test_by_the_library(self):
        bad = K.astype(float)
        bad[1, 2] = np.nan
        error = self.refused(signorini.SignoriniError, "K[1,2] is not finite", bad, LOAD, 0, 0.3)
        self.assertEqual(error.status, -3)
        self.refused(signorini.SignoriniError, "mu[1]", K, LOAD, 0, [0.3, -1])
        self.refused(signorini.SignoriniError, "tolerance", K, LOAD, 0, 0.3, tolerance=1.0)
        with self.assertRaisesRegex(signorini.SignoriniError, "not symmetric"):
            signorini.Model.condensed(np.triu(K))
        model = signorini.Model.condensed(K)
        with self.assertRaisesRegex(signorini.SignoriniError, "^gap") as caught:
            model.solve(LOAD, np.nan, 0.3)
        self.assertEqual(caught.exception.status, -5)
        with self.assertRaisesRegex(signorini.SignoriniError, "tolerance"):
            model.solve([LOAD, LOAD], 0.0, 0.3, tolerance=1.0)
        with self.assertRaisesRegex(signorini.SignoriniError, "row"):
            signorini.Model.sparse(([1.0, 1.0], [0, 7], [0, 1, 2]), [[0, 1]], [0, -1])

    def test_by_shape_and_kind(self):
        self.refused(ValueError, "f has the shape (3,), not (4,)", K, LOAD[:3], 0, 0.3)
        self.refused(ValueError, "f has the shape (), not (4,)", K, 1.0, 0, 0.3)
        self.refused(ValueError, "gap has the shape (3,)", K, LOAD, [0, 0, 0], 0.3)
        self.refused(ValueError, "square", K[:3], LOAD, 0, 0.3)
        self.refused(ValueError, "square", 3.0, LOAD, 0, 0.3)
        self.refused(ValueError, "3 for each pair", K, LOAD, 0, 0.3, dim=3)
        self.refused(ValueError, "dim is 1", K, LOAD, 0, 0.3, dim=1)
        self.refused(TypeError, "K holds complex128", K * 1j, LOAD, 0, 0.3)
        self.refused(TypeError, "f holds <U1", K, ["a"] * 4, 0, 0.3)
        self.refused(TypeError, "tolerence is not a setting", K, LOAD, 0, 0.3, tolerence=1e-9)
        self.refused(ValueError, "not one of auto", K, LOAD, 0, 0.3, method="magic")
        sparse = signorini.Model.sparse
        for words, K_, slaves in (
            ("number of data", ([1.0, 1.0], [0, 1], [0, 1]), [[0, 1]]),
            ("indices of K holds float64", ([1.0, 1.0], [0.5, 1.0], [0, 1, 2]), [[0, 1]]),
            ("slaves holds float64", ([1.0, 1.0], [0, 1], [0, 1, 2]), [[0.0, 1.0]]),
        ):
            with self.assertRaisesRegex((TypeError, ValueError), words):
                sparse(K_, slaves, [0, -1])


if __name__ == "__main__":
    unittest.main()
