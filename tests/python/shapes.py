"""The Python package: shapes and kinds of arrays are compared, and refused in one sentence.

    python3 tests/python/shapes.py
"""

import unittest

import numpy as np

from common import LOAD, K

import signorini

IDENTITY = np.eye(12)
SPRINGS = (np.ones(6), np.arange(6), np.arange(7))  # three nodes in 2D, each on springs


class Refused(unittest.TestCase):
    def refused(self, kind, parts, call, *arguments, **keywords):
        with self.assertRaises(kind) as caught:
            call(*arguments, **keywords)
        sentence = str(caught.exception)
        for part in [parts] if isinstance(parts, str) else parts:
            self.assertIn(part, sentence)
        self.assertNotIn("\n", sentence)
        return caught.exception

    def test_loads(self):
        solve = signorini.solve
        for parts, load, keywords in (
            (["f has the shape (3,)", "shape (12,) or (6, 2)"], LOAD[:3], {}),
            (["f has the shape ()", "shape (12,) or (6, 2)"], 1.0, {}),
            (["f has the shape (2, 6)", "shape (12,) or (6, 2)", "transpose"], np.ones((2, 6)), {}),
            (["f has the shape (3, 4)", "shape (12,) or (4, 3)", "transpose"], np.ones((3, 4)),
             {"dim": 3}),
            (["f has the shape (4, 3)", "dim is 2", "dim=3", "(6, 2)"], np.ones((4, 3)),
             {"dim": 2}),
            (["f has the shape (6, 2)", "dim is 3", "dim=2", "(4, 3)"], np.ones((6, 2)),
             {"dim": 3}),
        ):
            self.refused(ValueError, parts, solve, IDENTITY, load, 0.0, 0.3, **keywords)
        self.refused(ValueError, ["f has the shape (2, 3)", "dim=3", "(3, 2)"], solve, np.eye(6),
                     np.ones((2, 3)), 0.0, 0.3)
        self.refused(ValueError, "f is no array, its rows differ in length", solve, K,
                     [[1.0, 2.0], [1.0]], 0.0, 0.3)
        self.refused(TypeError, "start is a Result: give one of its arrays, such as d", solve, K, LOAD, 0.0, 0.3,
                     start=solve(K, LOAD, 0.0, 0.3))

    def test_numbers_of_the_pairs(self):
        solve = signorini.solve
        for name, numbers in (("gap", 4), ("mu", 4), ("g", 3)):
            self.refused(ValueError, [f"{name} has the shape ({numbers},)", "each of the 2 pairs",
                                      "shape (2,)", "one for all"],
                         solve, K, LOAD, **{"gap": 0.0, name: np.zeros(numbers)})
        self.refused(ValueError, ["slip0 has the shape (4,)", "shape (2,) or (2, 1)"], solve, K,
                     LOAD, 0.0, 0.3, slip0=np.zeros(4))
        self.refused(ValueError, ["slip0 has the shape (4,)", "shape (8,) or (4, 2)"], solve,
                     IDENTITY, np.ones(12), 0.0, 0.3, dim=3, slip0=np.zeros(4))
        self.refused(ValueError, ["start has the shape (2,)", "shape (4,) or (2, 2)"], solve, K,
                     LOAD, 0.0, 0.3, start=[0, 0])
        self.refused(ValueError, ["d has the shape (2,)", "shape (4,) or (2, 2)"],
                     signorini.certify, K, LOAD, 0.0, 0.3, d=[0, 0])
        self.refused(ValueError, ["mu and g", "mu for Coulomb", "g for given thresholds"], solve, K,
                     LOAD, 0.0, 0.3, g=1.0)

    def test_numbers_of_other_laws(self):
        solve, model = signorini.solve, signorini.Model.condensed(K)
        for call in (lambda **law: solve(K, LOAD, 0.0, **law),
                     lambda **law: model.solve(LOAD, 0.0, **law),
                     lambda **law: signorini.certify(K, LOAD, 0.0, d=LOAD, **law)):
            for friction in (np.zeros(2), np.zeros((3, 2)), np.zeros((4, 3)), 1.0, np.zeros(6)):
                self.refused(ValueError, [f"friction has the shape {np.shape(friction)}",
                                          "three numbers for each of the 2 pairs", "shape (2, 3)",
                                          "(3,) for all"], call, law="cohesive", friction=friction)
            self.refused(ValueError, ["friction has the shape (3,)", "four numbers for each of the 2 "
                                      "pairs", "shape (2, 4)"], call, law="by_pair",
                         friction=[1, 0.3, 0])
            self.refused(TypeError, ["friction is None", "cohesive"], call, law="cohesive")
            self.refused(ValueError, "friction is given without a law", call, friction=[1, 2, 3])
            self.refused(ValueError, ["law is 'viscous', not one of", "cohesive"], call,
                         law="viscous", friction=[1, 2, 3])
            self.refused(ValueError, "law is given, and mu or g", call, law="cohesive", mu=0.3,
                         friction=[1, 2, 3])
            self.refused(ValueError, "the law is frictionless", call, law="frictionless",
                         friction=[1, 2, 3])
            for law, friction, parts in (
                ("cohesive", [0.5, 0.1, 1.0], ["friction[1] (b of pair 0) is 0.1", "mu a"]),
                ("cohesive", [[0, 1, 1], [0, 1, -1.0]], ["friction[5] (a of pair 1) is -1"]),
                ("orthotropic", [0.5, 0.1, 0.0], ["dim is 2", "Coulomb's law"]),
                ("by_pair", [[1, 1, 0, 0], [2, 1, 1, 0]], ["friction[6] (p2 of pair 1) is 1"]),
            ):
                self.refused(signorini.SignoriniError, parts, call, law=law, friction=friction)
        self.refused(signorini.SignoriniError, ["friction[3] (mu1 of pair 1) is 0", "positive"],
                     solve, np.eye(6), np.ones(6), 0.0, law="orthotropic", dim=3,
                     friction=[[1, 1, 0], [0, 1, 0]])

    def test_the_other_dimension(self):
        """12 unknowns are 6 pairs in 2D, or 4 in 3D."""
        flat, solve = np.ones(12), signorini.solve
        model = {dim: signorini.Model.condensed(IDENTITY, dim=dim) for dim in (2, 3)}
        self.refused(ValueError, ["gap has the shape (4,)", "dim=3", "f of shape (4, 3)"], solve,
                     IDENTITY, flat, np.zeros(4), 0.3)
        for dim, other, pairs in ((2, 3, 4), (3, 2, 6)):
            hint = [f"the shape is that of dim={other}", f"dim is {dim}"]
            for name, shape in (("gap", (pairs,)), ("mu", (pairs,)), ("slip0", (pairs, other - 1)),
                                ("start", (pairs, other))):
                given = {"gap": 0.0, "mu": 0.3, name: np.zeros(shape)}
                self.refused(ValueError, [f"{name} has the shape {shape}", *hint], solve, IDENTITY,
                             flat, dim=dim, **given)
                self.refused(ValueError, [f"{name} has the shape {shape}", *hint],
                             model[dim].solve, flat, **given)
            self.refused(ValueError, ["f has the shape", *hint], model[dim].solve,
                         np.ones((pairs, other)), 0.0)
            self.refused(ValueError, ["d has the shape", *hint], model[dim].recover,
                         np.ones((pairs, other)), None)
            self.refused(ValueError, ["friction has the shape", *hint], solve, IDENTITY, flat, 0.0,
                         dim=dim, law="cohesive", friction=np.ones((pairs, 3)))

    def test_nothing(self):
        model = signorini.Model.condensed(K)
        for parts, call in (
            ("K is None", lambda: signorini.solve(None, LOAD, 0.0)),
            ("f is None", lambda: signorini.solve(K, None, 0.0)),
            (["gap is None", "each of the 2 pairs"], lambda: signorini.solve(K, LOAD, None)),
            (["d is None", "shape (4,)"], lambda: signorini.certify(K, LOAD, 0.0, d=None)),
            ("f is None", lambda: model.solve(None, 0.0)),
            (["d is None", "shape (4,)"], lambda: model.recover(None, None)),
            (["q is None", "each row of M"], lambda: signorini.lcp_solve(np.eye(2), None)),
            ("slaves is None", lambda: signorini.Model.sparse(SPRINGS, None, [0, -1])),
            ("normals is None", lambda: signorini.Model.sparse(SPRINGS, [[0, 1]], None)),
        ):
            self.refused(TypeError, parts, call)

    def test_condensed_matrices(self):
        solve = signorini.solve
        self.refused(ValueError, ["K has the shape (3, 4)", "square"], solve, K[:3], LOAD, 0, 0.3)
        self.refused(ValueError, ["K has the shape ()", "square"], solve, 3.0, LOAD, 0, 0.3)
        self.refused(ValueError, ["K has the shape (4, 4)", "dim is 3", "3 rows"], solve, K, LOAD,
                     0, 0.3, dim=3)
        self.refused(ValueError, ["K has the shape (9, 9)", "dim is 2"], solve, np.eye(9),
                     np.ones(9), 0, 0.3)
        for dim in (1, 2.0):
            self.refused(ValueError, f"dim is {dim}: give 2 or 3", solve, K, LOAD, 0, 0.3, dim=dim)
        for part, name in ((np.tril(K), "lower"), (np.triu(K), "upper")):
            self.refused(ValueError, ["K has the shape (4, 4)", f"only its {name} triangle",
                                      "K + K.T"], solve, part, LOAD, 0, 0.3)
            self.refused(ValueError, ["K_B", f"only its {name} triangle"],
                         signorini.Model.two_body, K, part)
        self.refused(ValueError, ["K_B has the shape (2, 2)", "(4, 4)"], signorini.Model.two_body,
                     K, np.eye(2))
        self.refused(TypeError, "K holds complex128, not real", solve, K * 1j, LOAD, 0, 0.3)
        self.refused(TypeError, "f holds <U1, not real", solve, K, ["a"] * 4, 0, 0.3)

    def test_sparse_and_dense(self):
        class Sparse:
            """A scipy sparse matrix is known by this."""

            shape = (4, 4)
            tocsc = None

        for call in (lambda: signorini.solve(Sparse(), LOAD, 0.0, 0.3),
                     lambda: signorini.Model.condensed(Sparse())):
            self.refused(TypeError, ["K is a scipy sparse matrix", "use Model.sparse",
                                     "condense it first"], call)
        self.refused(TypeError, ["f is a scipy sparse matrix", "f.toarray()"], signorini.solve, K,
                     Sparse(), 0.0, 0.3)
        sparse = signorini.Model.sparse
        self.refused(TypeError, ["K is an array of the shape (4, 4)", "scipy sparse matrix",
                                 "(data, indices, indptr)", "Model.condensed"], sparse, K, [[0, 1]],
                     [0, -1])
        self.refused(TypeError, "K is a list", sparse, K.tolist(), [[0, 1]], [0, -1])

    def test_sparse_matrices(self):
        for kind, parts, matrix in (
            (ValueError, ["indptr of K ends with 1", "2 entries"], ([1.0, 1.0], [0, 1], [0, 1])),
            (ValueError, ["data and indices of K have the shapes (2,) and (3,)"],
             ([1.0, 1.0], [0, 1, 2], [0, 1, 2])),
            (ValueError, ["indptr of K has the shape (0,)"], ([], [], [])),
            (TypeError, "indices of K holds float64", ([1.0, 1.0], [0.5, 1.0], [0, 1, 2])),
        ):
            self.refused(kind, parts, signorini.Model.sparse, matrix, [[0, 1]], [0, -1])
        self.refused(ValueError, "triangle is 'all', not one of lower, upper, full",
                     signorini.Model.sparse, SPRINGS, [[0, 1]], [0, -1], triangle="all")

    def test_pairs(self):
        for kind, parts, slaves, normals, keywords in (
            (ValueError, ["slaves has the shape (2,)", "dof numbers of each slave node",
                          "shape (pairs, dim)"], [0, 1], [0, -1], {}),
            (ValueError, "slaves has the shape (1, 4)", [[0, 1, 2, 3]], [0, -1], {}),
            (TypeError, "slaves holds float64", [[0.0, 1.0]], [0, -1], {}),
            (ValueError, ["normals has the shape (3,)", "shape (1, 2)", "shape (2,)"], [[0, 1]],
             [0, -1, 0], {}),
            (ValueError, ["fixed has the shape (1, 2)", "shape (count,)"], [[0, 1]], [0, -1],
             {"fixed": [[2, 3]]}),
            (TypeError, ["fixed holds bool", "numpy.flatnonzero(fixed)"], [[0, 1]], [0, -1],
             {"fixed": [False] * 5 + [True]}),
            (ValueError, ["masters has 2 entries", "each of the 1 pairs"], [[0, 1]], [0, -1],
             {"masters": [[2, 3], [4, 5]]}),
            (ValueError, ["masters[0] has the shape (3,)", "shape (masters, 2)"], [[0, 1]], [0, -1],
             {"masters": [[2, 3, 4]]}),
            (ValueError, ["weights is None", "pair 0 has 2 masters"], [[0, 1]], [0, -1],
             {"masters": [[[2, 3], [4, 5]]]}),
            (ValueError, ["weights[0] has the shape (1,)", "2 masters", "shape (2,)"], [[0, 1]],
             [0, -1], {"masters": [[[2, 3], [4, 5]]], "weights": [[1.0]]}),
            (ValueError, "weights is given without masters", [[0, 1]], [0, -1],
             {"weights": [[1.0]]}),
        ):
            self.refused(kind, parts, signorini.Model.sparse, SPRINGS, slaves, normals, **keywords)

    def test_models(self):
        model = signorini.Model.sparse(SPRINGS, [[0, 1], [2, 3]], [0, -1], fixed=[4, 5])
        solve, load = model.solve, np.ones(6)
        for parts, call in (
            (["f has the shape (4,)", "each degree of freedom of the host", "shape (6,)"],
             lambda: solve(np.ones(4), 0.0)),
            (["f has the shape (3, 2)", "shape (6,)"], lambda: solve(np.ones((3, 2)), 0.0)),
            (["gap has the shape (3,)", "each of the 2 pairs", "all 4 cases", "an axis of 4"],
             lambda: solve(np.ones((4, 6)), np.zeros(3))),
            (["prescribed has the shape (3,)", "each of the 2 fixed", "shape (2,)"],
             lambda: solve(load, 0.0, prescribed=np.zeros(3))),
            (["F has the shape (3,)", "shape (4,) or (2, 2)"],
             lambda: model.nodal_forces(np.zeros(3))),
            (["d has the shape (6,)", "shape (4,) or (2, 2)"], lambda: model.recover(load, load)),
            (["d has the shape (6,)"], lambda: model.certify(load, 0.0, d=load)),
            (["f has the shape (4,)", "shape (6,)"], lambda: model.condensed_load(np.ones(4))),
        ):
            self.refused(ValueError, parts, call)

    def test_lcps_and_settings(self):
        self.refused(ValueError, ["q has the shape (1,)", "each row of M", "shape (2,)"],
                     signorini.lcp_solve, np.eye(2), [1.0])
        self.refused(ValueError, "cover has the shape (3,)", signorini.lcp_lemke, np.eye(2),
                     [1.0, 1.0], np.ones(3))
        solve = signorini.solve
        for kind, parts, keywords in (
            (TypeError, ["tolerence is not a setting", "tolerance"], {"tolerence": 1e-9}),
            (ValueError, "method is 'Lemke', not one of auto", {"method": "Lemke"}),
            (ValueError, "method is 17, not one of auto", {"method": 17}),
            (ValueError, "search is 'return_second', not one of off, others",
             {"search": "return_second"}),
            (TypeError, "tolerance is 'small'", {"tolerance": "small"}),
            (ValueError, "max_iterations is 18446744073709551617: give at most",
             {"max_iterations": 2**64 + 1}),
            (TypeError, "progress is 3: give a function", {"progress": 3}),
        ):
            self.refused(kind, parts, solve, K, LOAD, 0.0, 0.3, **keywords)


class Taken(unittest.TestCase):
    """Arguments that the sentences ask for are taken."""

    def test_both_shapes_of_a_vector(self):
        expected = signorini.solve(K, LOAD, 0.0, 0.3, slip0=[0.1, 0.2])
        rows = signorini.solve(K, np.reshape(LOAD, (2, 2)), [0, 0], [0.3, 0.3],
                               slip0=[[0.1], [0.2]], start=np.zeros(4))
        np.testing.assert_allclose(rows.F, expected.F, rtol=1e-9)

    def test_dimensions(self):
        rng = np.random.default_rng(1)
        load = rng.normal(size=(4, 3)) + [2.0, 0.0, 0.0]
        told = signorini.solve(IDENTITY, load.ravel(), 0.0, 0.3, dim=3)
        seen = signorini.solve(IDENTITY, load, 0.0, 0.3)
        np.testing.assert_array_equal(seen.F, told.F)
        self.assertEqual(signorini.solve(IDENTITY, load.ravel(), 0.0, 0.3).F.shape, (6, 2))

    def test_three_numbers(self):
        one = signorini.solve(K, LOAD, 0.0, law="cohesive", friction=[0.3, 0.2, 0.1])
        for law in (signorini.Law.COHESIVE, 3):
            rows = signorini.solve(K, LOAD, 0.0, law=law, friction=[[0.3, 0.2, 0.1]] * 2)
            np.testing.assert_array_equal(rows.d, one.d)
        plain = signorini.solve(K, LOAD, 0.0, law="cohesive", friction=[0.3, 0, 0])
        np.testing.assert_array_equal(plain.d, signorini.solve(K, LOAD, 0.0, 0.3).d)
        model = signorini.Model.condensed(K)
        numbers = np.array([[[0.3, 0.2, 0.1]] * 2, [[0.3, 0, 0]] * 2])
        cases = model.solve([LOAD, LOAD], 0.0, law="cohesive", friction=numbers)
        for expected, result in zip((one, plain), cases):
            np.testing.assert_array_equal(expected.d, result.d)

    def test_cases(self):
        model = signorini.Model.condensed(K)
        loads = np.outer([1, 2, 3], LOAD)
        slips = np.array([[0.0, 0.1], [0.0, 0.2], [0.0, 0.3]])
        one = [model.solve(load, 0.0, 5.0, slip0=slip) for load, slip in zip(loads, slips)]
        for slip0 in (slips, slips[:, :, None]):
            all_at_once = model.solve(loads, [0.0, 0.0], np.full((3, 2), 5.0), slip0=slip0)
            for expected, result in zip(one, all_at_once):
                np.testing.assert_array_equal(result.d, expected.d)
        rows = model.solve(np.reshape(LOAD, (2, 2)), 0.0, 5.0, slip0=[0.0, 0.1])
        np.testing.assert_array_equal(rows.d, one[0].d)


if __name__ == "__main__":
    unittest.main()
