"""The Python package: what it returns, and how the library's refusals arrive.

    python3 tests/python/results.py
"""

import re
import unittest

import numpy as np

from common import LOAD, K, chain, text

import bar_mesh
import signorini
from signorini import Method, State, Status, Uniqueness


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
            self.assertEqual((result.status, result.message), (Status.SOLVED, "solved"))
            for name in ("d", "F"):
                expected = reference("reference_" + name)
                off = abs(getattr(result, name) - expected).max() / abs(expected).max()
                self.assertLess(off, 1e-9, name)
            self.assertEqual(list(result.state), [0] * 3 + [1] * 15 + [2] * 15)
            report = result.report
            self.assertEqual((report.pairs_open, report.pairs_slipping, report.pairs_sticking),
                             (3, 15, 15))
            self.assertIsInstance(report.method, Method)
            self.assertIs(report.status, Status.SOLVED)
            self.assertIsNone(result.motion)
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
        dense = np.eye(4)
        with self.assertRaisesRegex(TypeError, "K is a scipy sparse matrix: use Model.sparse"):
            signorini.solve(csc_matrix(dense), LOAD, 0.0, 0.3)


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
            np.testing.assert_array_equal(result.state, [State.SLIP, State.STICK])

    def test_solve_in_3d(self):
        result = signorini.solve(np.eye(3) * 2, [1, 3, 4], 0.0, 0.5, dim=3)
        np.testing.assert_allclose(result.F, [[-1, -0.3, -0.4]], rtol=1e-9)  # cone of radius 0.5
        self.assertEqual(result.d.shape, (1, 3))

    def test_laws(self):
        given = signorini.solve(K, LOAD, 0.0, g=[0.1, 5.0], slip0=[0.0, 0.01])
        np.testing.assert_allclose(given.F[0, 1], -0.1, rtol=1e-9)
        self.assertEqual(given.d[1, 1], 0.01)
        # Thresholds act on open pairs, too; friction coefficients do not.
        away = {"K": np.eye(2), "f": [-1.0, 1.0], "gap": 0.0}
        np.testing.assert_allclose(signorini.solve(**away, g=0.25).F, [[0, -0.25]], atol=1e-12)
        np.testing.assert_allclose(signorini.solve(**away, mu=0.25).F, [[0, 0]], atol=1e-12)
        for none in (signorini.solve(K, LOAD, 0.0), signorini.solve(K, LOAD, 0.0, 0.0),
                     signorini.solve(K, LOAD, 0.0, g=0.0),
                     signorini.Model.condensed(K).solve(LOAD, 0.0)):
            self.assertIs(none.status, Status.SOLVED)
            # Both press, d_n = 0, and F_t = 0: 4 d_t1 - d_t2 = 1.5, 4 d_t2 - d_t1 = 0.5.
            np.testing.assert_allclose(none.d, [[0, 6.5 / 15], [0, 3.5 / 15]], atol=1e-9)
            np.testing.assert_allclose(none.F[:, 1], 0, atol=1e-12)

    def test_start_and_settings(self):
        first = signorini.solve(K, LOAD, 0.0, 0.3, method="sor_nested", tolerance=1e-12)
        start = first.d.copy()
        again = signorini.solve(K, LOAD, 0.0, 0.3, method="sor_nested", tolerance=1e-12,
                                start=start)
        self.assertLess(again.report.iterations, first.report.iterations)
        self.assertIs(again.report.method, Method.SOR_NESTED)
        np.testing.assert_array_equal(start, first.d)
        limited = signorini.solve(*chain(), 0.01, 0.3, method="sor_nested", max_iterations=2)
        self.assertEqual(limited.status, Status.ITERATION_LIMIT)
        self.assertEqual(limited.report.status, Status.ITERATION_LIMIT)
        self.assertTrue(limited.message)
        unique = signorini.solve(K, LOAD, 0.0, 0.3, search="others").report.uniqueness
        self.assertIs(unique, Uniqueness.UNIQUE)

    def test_empty_problem(self):
        self.assertEqual(signorini.solve(np.zeros((0, 0)), [], 0.0, 0.3).d.shape, (0, 2))


class Models(unittest.TestCase):
    def test_condensed_cases(self):
        model = signorini.Model.condensed(K)
        self.assertEqual((model.host_size, model.pairs, model.dim), (4, 2, 2))
        loads = np.outer([1, 2, 3], LOAD)
        results = model.solve(loads, 0.0, [[0.3, 0.3], [-1, 0.3], [0.5, 0.5]])
        self.assertEqual([r.status for r in results], [0, -7, 0])
        self.assertIn("mu[0]", results[1].message)
        self.assertTrue(np.isnan(results[1].d).all() and (results[1].state == -1).all())
        self.assertEqual((results[1].report, results[1].motion, results[1].second), (None,) * 3)
        one = signorini.solve(K, loads[2], 0.0, 0.5)
        np.testing.assert_allclose(results[2].F, one.F, rtol=1e-12)
        np.testing.assert_array_equal(model.solve(LOAD, 0.0, 0.3).d, results[0].d)
        np.testing.assert_array_equal(model.stiffness, K)
        self.assertEqual(model.solve(np.zeros((0, 4)), 0.0, 0.3), [])

    def test_many_cases_at_once(self):
        bar = bar_mesh.assemble()
        model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        loads = np.outer(np.linspace(0.5, 1.5, 40), bar.load)  # more than a block of the library
        results = model.solve(loads, 0.0, 0.5)
        for warm, result in zip(model.solve(loads, 0.0, 0.5, start="previous"), results):
            self.assertEqual((warm.status, result.status), (0, 0))
            np.testing.assert_allclose(warm.d, result.d, atol=1e-9 * abs(result.d).max())
        d = np.array([result.d for result in results])
        u = model.recover_cases(d, loads)
        for c in (0, 31, 32, 39):
            one = model.recover(d[c], loads[c])
            np.testing.assert_allclose(u[c], one, atol=1e-12 * abs(one).max())
        np.testing.assert_array_equal(model.recover_cases(d.reshape(40, -1), loads), u)
        self.assertEqual(model.recover_cases(np.zeros((2, model.pairs, 2)), None).shape,
                         (2, model.host_size))
        d[33, 1, 0] = np.nan
        with self.assertRaisesRegex(signorini.SignoriniError, r"case 33: d\[2\] is not finite"):
            model.recover_cases(d, loads)

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
    """By the library; what the package refuses by itself is in shapes.py."""

    def refused(self, words, status, *arguments, **keywords):
        with self.assertRaises(signorini.SignoriniError) as caught:
            signorini.solve(*arguments, **keywords)
        self.assertIn(words, str(caught.exception))
        self.assertEqual(caught.exception.status, status)

    def test_condensed(self):
        bad = K.astype(float)
        bad[1, 2] = np.nan
        self.refused("K[1,2] is not finite", -3, bad, LOAD, 0, 0.3)
        self.refused("f[1] is not finite", -5, K, [1, np.inf, 0, 0], 0, 0.3)
        self.refused("gap[0] is NaN", -6, K, LOAD, np.nan, 0.3)
        self.refused("mu[1]", -8, K, LOAD, 0, [0.3, -1])
        self.refused("g[1]", -8, K, LOAD, 0, g=[0.3, -1])
        self.refused("slip0[1]", -9, K, LOAD, 0, 0.3, slip0=[0, np.nan])
        self.refused("tolerance", -10, K, LOAD, 0, 0.3, tolerance=1.0)
        bad[1, 2] = 2.0
        self.refused("not symmetric", -3, bad, LOAD, 0, 0.3)

    def test_models(self):
        model = signorini.Model.condensed(K)
        with self.assertRaisesRegex(signorini.SignoriniError, "^gap") as caught:
            model.solve(LOAD, np.nan, 0.3)
        self.assertEqual(caught.exception.status, -5)
        with self.assertRaisesRegex(signorini.SignoriniError, "tolerance"):
            model.solve([LOAD, LOAD], 0.0, 0.3, tolerance=1.0)
        with self.assertRaisesRegex(signorini.SignoriniError, "row"):
            signorini.Model.sparse(([1.0, 1.0], [0, 7], [0, 1, 2]), [[0, 1]], [0, -1])


if __name__ == "__main__":
    unittest.main()
