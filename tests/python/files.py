"""The Python package: problem files, written and read back with the same bits.

    python3 tests/python/files.py WORK      WORK: a directory to write to
"""

import os
import sys
import unittest

import numpy as np

from common import LOAD, K

import bar_mesh
import signorini
from signorini import Status

WORK = "."


def path(name):
    return os.path.join(WORK, name)


def positive_definite(rng, size):
    half = rng.normal(size=(size, size))
    return half @ half.T + np.eye(size)


class Files(unittest.TestCase):
    def same(self, given, found):
        np.testing.assert_array_equal(np.asarray(given, float).view(np.int64),
                                      np.asarray(found, float).view(np.int64))

    def test_contact_problems_read_back_with_the_same_bits(self):
        rng = np.random.default_rng(3)
        for dim in (2, 3):
            matrix = positive_definite(rng, 4 * dim)
            matrix = (matrix + matrix.T) / 2
            load, gap = rng.normal(size=(4, dim)) / 3, np.array([0.1, -0.0, np.inf, 1e-300])
            friction, slip0 = rng.random(4), rng.normal(size=(4, dim - 1))
            for law in ("mu", "g", None):
                given = {} if law is None else {law: friction}
                signorini.write(path("case.mtx"), matrix, load, gap, **given, slip0=slip0, dim=dim,
                                remark="units: mm, N; µ of the tests")
                found = signorini.read(path("case.mtx"))
                self.assertIsInstance(found, signorini.ContactProblem)
                self.assertEqual((found.dim, found.remark), (dim, "units: mm, N; µ of the tests"))
                for name, values in (("K", matrix), ("f", load), ("gap", gap), ("slip0", slip0)):
                    self.same(values, getattr(found, name))
                for name in ("mu", "g"):
                    if name == law:
                        self.same(friction, getattr(found, name))
                    else:
                        self.assertIsNone(getattr(found, name))
                solved = signorini.solve(matrix, load, gap, **given, slip0=slip0, dim=dim)
                self.same(solved.d, found.solve().d)

    def test_laws_of_several_numbers_read_back(self):
        rng = np.random.default_rng(5)
        for law, dim, friction in (
            ("cohesive", 2, [0.3, 0.7, 0.1]), ("cohesive", 3, [0.3, 0.7, 0.1]),
            ("orthotropic", 3, [0.3, 0.7, 0.1]), ("orthotropic_collinear", 3, [0.3, 0.7, 0.1]),
            ("by_pair", 2, [[0, 0, 0, 0], [1, 0.3, 0, 0], [2, 0.7, 0, 0], [3, 0.3, 0.7, 0.1]]),
            ("tied", 3, None),
            ("by_pair", 2, [[7, 0, 0, 0], [1, 0.3, 0, 0], [2, 0.7, 0, 0], [0, 0, 0, 0]]),
            ("by_pair", 3, [[4, 0.3, 0.7, 0.1], [5, 0.3, 0.7, 0.1], [1, 0.3, 0, 0], [0, 0, 0, 0]]),
        ):
            matrix, load = positive_definite(rng, 4 * dim), rng.normal(size=(4, dim))
            matrix = (matrix + matrix.T) / 2
            if law not in ("by_pair", "tied"):
                friction = rng.uniform(1, 1.1, size=(4, 3)) * friction
            signorini.write(path("law.mtx"), matrix, load, 0.0, law=law, friction=friction, dim=dim)
            found = signorini.read(path("law.mtx"))
            self.assertEqual(found.law, signorini.Law[law.upper()])
            if friction is None:
                self.assertIsNone(found.friction)
            else:
                self.same(friction, found.friction)
            self.assertIsNone(found.mu)
            self.assertIsNone(found.g)
            solved = signorini.solve(matrix, load, 0.0, law=law, friction=friction, dim=dim)
            self.same(solved.d, found.solve().d)

    def test_lcps_read_back_with_the_same_bits(self):
        rng = np.random.default_rng(4)
        matrix, q = rng.normal(size=(5, 5)), rng.normal(size=5)
        for cover in (None, rng.random(5) + 0.5):
            signorini.write_lcp(path("lcp.mtx"), matrix, q, cover)
            found = signorini.read(path("lcp.mtx"))
            self.assertIsInstance(found, signorini.LcpProblem)
            self.same(matrix, found.M)
            self.same(q, found.q)
            self.assertEqual(found.remark, "")
            if cover is None:
                self.assertIsNone(found.cover)
            else:
                self.same(cover, found.cover)
        signorini.write_lcp(path("lcp.mtx"), np.eye(2), [-1.0, 2.0], [1.0, 2.0])
        np.testing.assert_allclose(signorini.read(path("lcp.mtx")).solve().z, [1, 0])

    def test_a_case_of_a_model(self):
        bar = bar_mesh.assemble()
        model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
        moved = np.linspace(0, 1e-3, len(bar.held))
        for law in ({"mu": 1.0}, {"g": 2.0}, {}):
            model.write(path("bar.mtx"), bar.load, 0.0, **law, prescribed=moved)
            found = signorini.read(path("bar.mtx"))
            self.same(model.stiffness, found.K)
            self.same(model.condensed_load(bar.load, moved), found.f)
            solved = model.solve(bar.load, 0.0, **law, prescribed=moved)
            result = found.solve()
            self.assertIs(result.status, Status.SOLVED)
            self.same(solved.d, result.d)
            self.same(solved.F, result.F)

    def test_what_is_refused(self):
        nowhere = path(os.path.join("nowhere", "case.mtx"))
        for call in (lambda: signorini.write(nowhere, K, LOAD, 0.0, 0.3),
                     lambda: signorini.read(nowhere)):
            with self.assertRaises(signorini.SignoriniError) as caught:
                call()
            self.assertIs(caught.exception.status, Status.FILE)
            self.assertIn("case.mtx", str(caught.exception))
        with self.assertRaisesRegex(ValueError, "path holds a null character"):
            signorini.write("a\0b", K, LOAD, 0.0, 0.3)
        with self.assertRaisesRegex(ValueError, "remark holds a null character"):
            signorini.write(path("null.mtx"), K, LOAD, 0.0, 0.3, remark="a\0b")
        self.assertFalse(os.path.exists(path("null.mtx")))
        with open(path("other.mtx"), "w", encoding="ascii") as file:
            file.write("not a problem\n")
        with self.assertRaises(signorini.SignoriniError) as caught:
            signorini.read(path("other.mtx"))
        self.assertIs(caught.exception.status, Status.FILE)


if __name__ == "__main__":
    WORK = sys.argv[1]
    unittest.main(argv=sys.argv[:1])
