"""The Python package: models of which the host gives products and solutions alone.

    python3 tests/python/operators.py
"""

import unittest

import numpy as np

from common import LOAD, K

import signorini
from signorini import Status

SIZE = len(K)


def with_held(changes):
    """Solutions with components held, by numpy; notes each change."""
    def held(mask, changed, x):
        changes.append(changed)
        y, free = np.zeros(SIZE), ~mask
        y[free] = np.linalg.solve(K[np.ix_(free, free)], x[free])
        return y
    return held


class Operators(unittest.TestCase):
    """A model of functions has the solution of the matrix itself. Both residuals are below 1e-12 of forces of size 1, and K is well
    conditioned: displacements and forces agree to 1e-10."""

    def setUp(self):
        self.expected = signorini.solve(K, LOAD, 0.0, 0.3, tolerance=1e-12)
        self.assertEqual(self.expected.status, Status.SOLVED)

    def assert_same(self, model, **settings):
        result = model.solve(LOAD, 0.0, 0.3, tolerance=1e-12, **settings)
        self.assertEqual(result.status, Status.SOLVED)
        np.testing.assert_allclose(result.d, self.expected.d, atol=1e-10)
        np.testing.assert_allclose(result.F, self.expected.F, atol=1e-10)
        np.testing.assert_array_equal(result.state, self.expected.state)

    def test_products(self):
        model = signorini.Model.operator(2, SIZE // 2, lambda x: K @ x, lambda x: x / np.diag(K))
        self.assertEqual((model.dim, model.pairs, model.host_size), (2, SIZE // 2, SIZE))
        self.assert_same(model)
        self.assertTrue(model.certify(LOAD, 0.0, 0.3, d=self.expected.d).report.eta < 1e-12)

    def test_solutions_with_components_held(self):
        changes = []
        model = signorini.Model.operator(2, SIZE // 2, lambda x: K @ x, held=with_held(changes),
                                         units=np.diag(K))
        self.assert_same(model)
        self.assertTrue(changes and changes[0])

    def test_a_preconditioner_on_all_unknowns(self):
        """Two further unknowns come first, each on springs of 1 to a component and to the ground: condensed they are a spring
        of 1/2. The preconditioner is a diagonal."""
        A = np.zeros((SIZE + 2, SIZE + 2))
        A[2:, 2:] = K + np.diag([1.0, 1.0] + [0.0] * (SIZE - 2))
        A[:2, :2], A[:2, 2:4], A[2:4, :2] = 2 * np.eye(2), -np.eye(2), -np.eye(2)
        condensed = A[2:, 2:] - A[2:, :2] @ A[:2, 2:] / 2
        place, changes = 2 + np.arange(SIZE).reshape(-1, 2), []

        def precondition(mask, springs, changed, r):
            changes.append(changed)
            diagonal = np.diag(A).copy()
            diagonal[place[:, 1]] += springs[:, 0, 0]
            self.assertEqual(mask.shape, (SIZE,))
            return r / diagonal

        model = signorini.Model.preconditioned(lambda x: A @ x, precondition, place, np.diag(A))
        self.assertEqual((model.dim, model.pairs, model.host_size), (2, SIZE // 2, SIZE + 2))
        load = np.concatenate([[0.0, 0.0], LOAD])
        self.expected = signorini.solve(condensed, LOAD, 0.0, 0.3, tolerance=1e-12)
        result = model.solve(load, 0.0, 0.3, tolerance=1e-12)
        self.assertEqual(result.status, Status.SOLVED)
        np.testing.assert_allclose(result.d, self.expected.d, atol=1e-10)
        np.testing.assert_allclose(result.F, self.expected.F, atol=1e-10)
        self.assertTrue(changes[0] and len(changes) == result.report.outer_iterations)
        with self.assertRaisesRegex(ValueError, r"place has the shape \(2,\)"):
            signorini.Model.preconditioned(lambda x: A @ x, precondition, [2, 3], np.diag(A))

    def test_what_a_function_raises_goes_on(self):
        broken = []

        def stiffness(x):
            if broken:
                raise ZeroDivisionError("the host's own")
            return K @ x

        model = signorini.Model.operator(2, SIZE // 2, stiffness, lambda x: x)
        broken.append(True)
        for call in (lambda: model.solve(LOAD, 0.0, 0.3),
                     lambda: model.certify(LOAD, 0.0, 0.3, d=self.expected.d)):
            with self.assertRaisesRegex(ZeroDivisionError, "the host's own"):
                call()
        broken.clear()
        self.assert_same(model)

    def test_refusals(self):
        with self.assertRaisesRegex(ValueError, r"inverse returns the shape \(2,\): give"):
            signorini.Model.operator(2, SIZE // 2, lambda x: K @ x, lambda x: x[:2])
        with self.assertRaisesRegex(TypeError, "stiffness is 3: give a function"):
            signorini.Model.operator(2, SIZE // 2, 3)
        with self.assertRaisesRegex(signorini.SignoriniError, "symmetric"):
            signorini.Model.operator(2, SIZE // 2, lambda x: np.triu(K) @ x, lambda x: x)
        with self.assertRaisesRegex(signorini.SignoriniError, "inverse"):
            signorini.Model.operator(2, SIZE // 2, lambda x: K @ x)


if __name__ == "__main__":
    unittest.main()
