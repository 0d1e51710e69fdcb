"""Mistakes that users make, and what the Python package says: a table, and whether it names them.

    python3 tests/python/mistakes.py
"""

import unittest
import warnings

import numpy as np

import rings
from common import LOAD, K

import signorini
from signorini import Model, Remark, pair_meshes, solve

# Three nodes in the plane, each degree of freedom on a spring; the first two are slaves on y = 0.
SPRINGS = np.ones(6), np.arange(6), np.arange(7)
SLAVES, DOWN = np.arange(4).reshape(2, 2), [0, -1]
PRESS = np.array([0, -1, 0, -1, 0, 0.0])
# A square of two rows of nodes, and one above it whose nodes match.
SQUARE = np.array([[x, y] for y in (0, 1, 1, 2) for x in (0, 1)], float)


class Scipy:
    """A scipy sparse matrix is known by this."""

    shape = (4, 4)
    tocsc = None


def model(**keywords):
    return Model.sparse(SPRINGS, SLAVES, DOWN, **keywords)


def with_more(K, more):
    """The sum of two sparse matrices."""
    size = len(K[2]) - 1
    dense = np.zeros((size, size))
    for data, rows, starts in (K, more):
        dense[np.repeat(np.arange(size), np.diff(starts)), rows] += data
    columns, rows = np.nonzero(dense)
    return dense[columns, rows], rows, np.searchsorted(columns, np.arange(size + 1))


def over_a_plane(plane=signorini.Plane((0, 0), (0, 1))):
    return signorini.pair_obstacle(np.array([[0, 0], [1, 0], [2, 0.0]]), [[0, 1]], plane)


def loads(*shape):
    return np.ones(shape)


# Mistake, error, words of its sentence, what a user has written.
REFUSED = (
    ("dim forgotten: f (4, 3), dim 2", ValueError, ["f has the shape (4, 3)", "dim=3"],
     lambda: solve(np.eye(12), loads(4, 3), 0, 0.3, dim=2)),
    ("f of (dim, pairs)", ValueError, ["f has the shape (2, 6)", "transpose"],
     lambda: solve(np.eye(12), loads(2, 6), 0, 0.3)),
    ("f of the free dofs only", ValueError, ["f has the shape (6,)", "shape (12,)"],
     lambda: solve(np.eye(12), loads(6), 0, 0.3)),
    ("gap for each component", ValueError, ["gap has the shape (4,)", "each of the 2 pairs"],
     lambda: solve(K, LOAD, np.zeros(4))),
    ("a scipy matrix to solve", TypeError, ["K is a scipy sparse matrix", "Model.sparse"],
     lambda: solve(Scipy(), LOAD, 0)),
    ("a dense matrix to Model.sparse", TypeError, ["K is an array", "Model.condensed"],
     lambda: Model.sparse(np.eye(6), SLAVES, DOWN)),
    ("slaves are node numbers", ValueError, ["slaves has the shape (2,)", "dof numbers"],
     lambda: Model.sparse(SPRINGS, [0, 1], DOWN)),
    ("fixed is a mask", TypeError, ["fixed holds bool", "flatnonzero"],
     lambda: model(fixed=[False] * 5 + [True])),
    ("fixed is a set", TypeError, ["fixed is a set", "sorted(fixed)"],
     lambda: model(fixed={5})),
    ("gaps with masked numbers", ValueError, ["gap has masked numbers", "gap.filled(number)"],
     lambda: model().solve(PRESS, np.ma.masked_array([0.0, 1e20], [False, True]), 0.3)),
    ("masters without weights", ValueError, ["weights is None", "pair 0 has 2 masters"],
     lambda: Model.sparse(SPRINGS, [[0, 1]], DOWN, masters=[[[2, 3], [4, 5]]])),
    ("recover without f", TypeError, ["f is missing", "with which d was solved"],
     lambda: model().recover(np.zeros((2, 2)))),
    ("recover of many cases without f", TypeError, ["f is missing"],
     lambda: model().recover_cases(np.zeros((3, 2, 2)))),
    ("one triangle to solve", ValueError, ["only its lower triangle", "K + K.T"],
     lambda: solve(np.tril(K), LOAD, 0)),
    ("triangle not told", signorini.SignoriniError, ["K is not symmetric", "if one triangle is stored, triangle must name it"],
     lambda: Model.sparse((np.ones(3), [0, 1, 1], [0, 2, 3]), [[0, 1]], DOWN, triangle="full")),
    ("tol", TypeError, ["tol is not a setting", "tolerance"],
     lambda: solve(K, LOAD, 0, tol=1e-9)),
    ("an unused dof", signorini.SignoriniError, ["nothing resists degree of freedom 5", "fixed"],
     lambda: Model.sparse((np.ones(5), np.arange(5), [0, 1, 2, 3, 4, 5, 5]), SLAVES, DOWN)),
    ("coordinates transposed", ValueError, ["coordinates has the shape", "shape (nodes, dim)"],
     lambda: signorini.pair_surfaces(loads(3, 8), [[2, 3]], [[1, 0]])),
    ("one face listed twice", signorini.SignoriniError, ["slave face 1 and face 0 disagree"],
     lambda: signorini.pair_surfaces(SQUARE, [[4, 5], [4, 5]], [[3, 2]])),
    ("a face upon another one", signorini.SignoriniError, ["slave face 1 lies upon face 0"],
     lambda: signorini.pair_surfaces(np.vstack([SQUARE, SQUARE[4:6]]), [[4, 5], [8, 9]],
                                     [[3, 2]])),
    ("a node on both sides", signorini.SignoriniError, ["node 3", "on the slave side too"],
     lambda: signorini.pair_surfaces(SQUARE, [[2, 3]], [[3, 2]])),
    ("a zone with a null in its name", ValueError, ["zone 'a\\x00b'", "null character"],
     lambda: Model.from_surfaces(SPRINGS, {"a\0b": over_a_plane()})),
    ("a zone with half a character", ValueError, ["zone '\\ud800'", "half of a character"],
     lambda: Model.from_surfaces(SPRINGS, {"\ud800": over_a_plane()})),
    ("no zones", ValueError, ["zones is empty", "at least one"],
     lambda: Model.from_surfaces(SPRINGS, [])),
    ("moves in part", TypeError, ["moves is 1.5", "whole number"],
     lambda: over_a_plane().adjusted(moves=1.5)),
    ("a point of four numbers", ValueError, ["Plane", "of 4 numbers", "give 2"],
     lambda: over_a_plane(signorini.Plane((0, 0, 1, 1), (0, 1)))),
    ("a tolerance to a model", TypeError, ["tolerance is one of solve: give it there", "time_limit"],
     lambda: model(tolerance=1e-6)),
    ("a setting of the model among those of the pairing", TypeError, ["full_space is a setting of the model", "settings="],
     lambda: Model.from_meshes(SPRINGS, None, None, full_space=True)),
    ("three matrices of two meshes", ValueError, ["K is 3 matrices", "one of all nodes, or two"],
     lambda: Model.from_meshes([Scipy()] * 3, None, None)),
    ("results of cases to with_contact", TypeError, ["result is a list", "give one Result"],
     lambda: model().with_contact([])),
    ("the zone of a list", TypeError, ["zone is ['all']", "the name of one zone"],
     lambda: Model.from_surfaces(SPRINGS, {"all": over_a_plane()}).solve(PRESS).zone(["all"])),
    ("mu by zone without zones", TypeError, ["mu is a dict", "real numbers"],
     lambda: model().solve(PRESS, 0, mu={"all": 0.3})),
)

# Mistake, the remark, what a user has written: right in itself.
REMARKED = (
    ("right", Remark(0), lambda: solve(K, LOAD, 0, 0.3)),
    ("gap of the wrong sign", Remark.GAPS_NEGATIVE, lambda: solve(K, LOAD, -0.1, 0.3)),
    ("mu in percent", Remark.FRICTION_LARGE, lambda: solve(K, LOAD, 0, 30)),
    ("both", Remark.GAPS_NEGATIVE | Remark.FRICTION_LARGE, lambda: solve(K, LOAD, -0.1, 30)),
    ("nothing holds it along the plane", Remark.FREE_MOTION,
     lambda: solve(np.diag([1.0, 0.0]), [1.0, 0.0], 0)),
    ("a model of which nothing is wrong", Remark(0), lambda: model().solve(PRESS, 0)),
    ("mu in percent, of a model", Remark.FRICTION_LARGE, lambda: model().solve(PRESS, 0, mu=30)),
)


class Mistakes(unittest.TestCase):
    def test_refused(self):
        for mistake, kind, words, call in REFUSED:
            with self.subTest(mistake), self.assertRaises(kind) as caught:
                call()
            sentence = str(caught.exception)
            print(f"| {mistake} | Python | {kind.__name__} | {sentence} |")
            for word in words:
                self.assertIn(word, sentence)

    def test_remarked(self):
        for mistake, remark, call in REMARKED:
            with self.subTest(mistake):
                result = call()
                self.assertEqual(result.status, signorini.Status.SOLVED)
                self.assertEqual(result.report.remarks, remark)
                self.assertEqual("remark" in result.message, remark != 0)
            print(f"| {mistake} | Python | {result.status.name} | {result.report.remarks!r} |")

    def test_a_plane_that_points_away(self):
        for outward, is_told in ([0, 1], False), ([0, -1], True):
            contact = signorini.pair_obstacle(SQUARE, [[0, 1]], signorini.Plane([0, 0], outward))
            self.assertEqual("all slave faces look away from the obstacle" in contact.summary, is_told)
        print(f"| a plane that points away | Python | summary | {contact.summary} |")

    def test_all_pairs_open(self):
        self.assertIn("solved; every pair is open", model().solve(PRESS, 9.0).message)
        self.assertEqual(model().solve(PRESS, 0).message, "solved")

    def test_no_pairs(self):
        far = SQUARE + np.outer(np.arange(8) > 3, [0, 90])
        contact = signorini.pair_surfaces(far, [[4, 5]], [[3, 2]])
        ground = signorini.pair_obstacle(far, [[0, 1]], signorini.Plane([0, 0], [0, 1]))
        for zones in {"cut": contact}, {"ground": ground, "cut": contact}:
            with self.assertWarnsRegex(UserWarning, "zone 'cut': no pairs: .*larger search distance"):
                Model.from_surfaces((np.ones(16), np.arange(16), np.arange(17)), zones)

    def test_supports_that_hold_both_sides(self):
        """Lines of 3 and 2 faces with both first nodes fixed: what is left of the row between the supports is told, unless that
        node is given away, or the fixed ones are held along the lines alone, or the meshes match."""
        def lines(count):
            x = np.r_[np.linspace(0, 1, 3), np.linspace(0, 1, count + 1)]
            at, springs = np.c_[x, 0 * x], (np.ones(2 * len(x)), np.arange(2 * len(x)), np.arange(2 * len(x) + 1))
            return at, [[0, 1], [1, 2]], [[4 + k, 3 + k] for k in range(count)], springs
        at, slave, master, springs = lines(3)
        both = [0, 1, 6, 7]
        for fixed, given, is_told in (both, (), True), ([1, 7], (), True), (both, both, False), ([0, 6], (), False), ([0, 1], (), False):
            contact = signorini.pair_surfaces(at, slave, master, fixed=given)
            self.assertEqual(0 in contact.nodes, not len(given))
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                Model.from_surfaces(springs, {"clamp": contact}, fixed=fixed)
            told = [str(one.message) for one in told if "may be any number" in str(one.message)]
            self.assertEqual(len(told), is_told)
            self.assertTrue(all(one.startswith("zone 'clamp': supports hold slave node 0 along its normal") for one in told))
        at, slave, master, springs = lines(2)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            Model.from_surfaces(springs, signorini.pair_surfaces(at, slave, master), fixed=[0, 1, 6, 7])
        # A clamped face with mid nodes, whose rows have negative weights at slave nodes, over a master that nothing holds.
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        face = np.r_[corners, (corners + np.roll(corners, -1, axis=0)) / 2]
        at = np.c_[np.r_[face, 4 * corners - 2], np.repeat([0.1, 0], [8, 4])]
        contact = signorini.pair_surfaces(at, [[0, 3, 2, 1, 7, 6, 5, 4]], [[8, 9, 10, 11]])
        held = [3 * node + axis for node in (0, 3, 7) for axis in range(3)]
        with warnings.catch_warnings():
            warnings.filterwarnings("error", message=".*may be any number")
            Model.from_surfaces((np.ones(36), np.arange(36), np.arange(37)), contact, fixed=held)
        at = lines(2)[0]
        upper, lower = (at[:3], [("line", slave)]), (lines(3)[0][3:], [("line", [[1, 0], [2, 1], [3, 2]])])
        _, _, _, springs = lines(3)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            model = Model.from_meshes(springs, upper, lower, slave_faces=slave, master_faces=[[1, 0], [2, 1], [3, 2]], fixed=both)
        self.assertEqual(model.contact.nodes.tolist(), [1, 2])

    def test_numbers_of_nodes_that_do_not_turn(self):
        """Two springs of nodes with a rotation each: the numbers of nodes without one take rotations for displacements."""
        def spring(k):
            return np.kron([[1, -1], [-1, 1]], k)
        turning = np.zeros((12, 12))
        turning[:6, :6], turning[6:, 6:] = spring(np.diag([1.0, 1.0, 0.1])), spring(np.diag([1.0, 1.0, 0.1]))
        turning[[2, 5, 8, 11], [2, 5, 8, 11]] += 0.1
        columns = (turning.T.ravel(), np.tile(np.arange(12), 12), np.arange(0, 145, 12))
        at = np.array([[0, 0], [1, 0], [0, 0], [1, 0.0]])
        for dofs, is_told in ({}, True), ({"dofs_per_node": 3}, False), ({"dofs": np.arange(12).reshape(4, 3)[:, :2]}, False):
            contact = signorini.pair_surfaces(at, [[0, 1]], [[3, 2]], **dofs)
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                Model.from_surfaces(columns, contact, fixed=[0, 1, 2, 6, 7, 8])
            of_numbers = [str(one.message) for one in told if "rows for each" in str(one.message)]
            self.assertEqual(of_numbers, [
                "K has 3 rows for each of 4 nodes, and the degrees of freedom of the pairs are those of nodes that have 2: "
                "give dofs_per_node=3 to pair_surfaces, or dofs"] * is_told)

    def test_faces_within_a_mesh(self):
        """Faces whose nodes count from 1 lie within the body, or beyond the mesh, and are named; parts of faces of the skin,
        and cells of the mesh that are faces, may be given."""
        def block(low):
            x = np.array([[a, b, c + low] for c in (0, 1, 2) for b in (0, 1, 2) for a in (0, 1, 2)], float)
            first = np.array([a + 3 * b + 9 * c for c in (0, 1) for b in (0, 1) for a in (0, 1)])
            return x, {"hexahedron": first[:, None] + [0, 1, 4, 3, 9, 10, 13, 12]}
        upper, lower = block(2), block(0)
        below = [[a, a + 3, a + 4, a + 1] for a in (0, 1, 3, 4)]
        above = [[a + 18, a + 19, a + 22, a + 21] for a in (0, 1, 3, 4)]
        self.assertEqual(pair_meshes(upper, lower, slave_faces=below, master_faces=above).pairs, 9)
        says = "is not on the skin of the mesh of the {}: check the number from which its nodes count"
        off = [[node + 1 for node in face] for face in below]
        with self.assertRaisesRegex(ValueError, "slave_faces: face 1, of the nodes 2, 5, 6, 3, " + says.format("slave")):
            pair_meshes(upper, lower, slave_faces=off, master_faces=above)
        off = [[node + 9 for node in face] for face in above]
        with self.assertRaisesRegex(ValueError, "master_faces: face 0, of .* " + says.format("master")):
            pair_meshes(upper, lower, slave_faces=below, master_faces=off)
        halves = [half for a, b, c, d in below for half in ([a, b, c], [a, c, d])]
        self.assertEqual(pair_meshes(upper, lower, slave_faces=halves, master_faces=above).pairs, 9)
        inner = {**lower[1], "quad": np.array([[9, 10, 13, 12]])}
        found = pair_meshes(upper, (lower[0], inner), slave_faces=below, master_faces=inner["quad"], search_distance=2)
        self.assertGreater(found.pairs, 0)

    def test_matrices_of_two_meshes(self):
        """A square on a wider one, whose matrices are exchanged, and of which one is left out."""
        def mesh(low, cells):
            across = np.linspace(0, 1, cells + 1)
            x = np.array([[a, b] for b in (low, low + 1) for a in across])
            return x, {"quad": [[i, i + 1, i + cells + 2, i + cells + 1] for i in range(cells)]}

        def springs(size):
            return np.ones(size), np.arange(size), np.arange(size + 1)
        meshes = mesh(1, 2), mesh(0, 1)
        with self.assertRaisesRegex(ValueError, "8 and 12 columns, .* 12 and 8 degrees of freedom: exchange them"):
            Model.from_meshes((springs(8), springs(12)), *meshes)
        with self.assertRaisesRegex(ValueError, "K has 12 columns, the two meshes have 20 degrees of freedom"):
            Model.from_meshes(springs(12), *meshes)
        self.assertEqual(Model.from_meshes((springs(12), springs(8)), *meshes).host_size, 20)

    def test_matrices_of_equal_size_that_are_exchanged(self):
        """Frames of bars in all sides and diagonals of a quadrilateral; a free frame resists no turn."""
        def frame(x):
            K = np.zeros((8, 8))
            for a in range(4):
                for b in range(a):
                    along = (x[a] - x[b]) / np.linalg.norm(x[a] - x[b])
                    bar = np.concatenate([dofs_of(a), dofs_of(b)])
                    ends = np.concatenate([along, -along])
                    K[np.ix_(bar, bar)] += np.outer(ends, ends)
            return K

        def dofs_of(node):
            return np.array([2 * node, 2 * node + 1])

        def sparse(K):
            rows, columns = np.nonzero(K.T)[::-1]
            return K[rows, columns], rows, np.searchsorted(columns, np.arange(9))
        cells = {"quad": [[0, 1, 3, 2]]}
        lower = np.array([[0, 0], [1, 0], [0, 1], [1, 1.0]])
        upper = np.array([[0.1, 1], [0.8, 1], [0.2, 1.7], [0.9, 1.6]])
        meshes, fixed = ((upper, cells), (lower, cells)), [0, 8, 9, 11]
        stiff = [sparse(frame(x)) for x in (upper, lower)]
        halves = [sparse(np.tril(frame(x))) for x in (upper, lower)]
        for matrices, triangle in ((stiff, "full"), (halves, "lower")):
            self.assertEqual(Model.from_meshes(tuple(matrices), *meshes, fixed=fixed, triangle=triangle).host_size, 16)
            with self.assertRaisesRegex(ValueError, "the two matrices are exchanged: .* give that of the slave first"):
                Model.from_meshes(tuple(matrices[::-1]), *meshes, fixed=fixed, triangle=triangle)
        # A support of one body, as springs, or of both.
        held = sparse(frame(lower) + np.eye(8))
        self.assertEqual(Model.from_meshes((stiff[0], held), *meshes, fixed=[0]).host_size, 16)
        with self.assertRaisesRegex(ValueError, "the two matrices are exchanged"):
            Model.from_meshes((held, stiff[0]), *meshes)

    def test_matrices_of_two_meshes_in_one(self):
        """A matrix of both, with the master first: frames that join no nodes of both, and springs between two of them."""
        def chain(sizes, joined=()):
            K = np.zeros((sum(sizes), sum(sizes)))
            for begin, end in ((0, sizes[0]), (sizes[0], sum(sizes))):
                K[begin:end, begin:end] = 2 * np.eye(end - begin) - np.eye(end - begin, k=1) - np.eye(end - begin, k=-1)
            for a, b in joined:
                K[a, b] = K[b, a] = -0.1
            columns, rows = np.nonzero(K)
            return K[rows, columns], rows, np.searchsorted(columns, np.arange(sum(sizes) + 1))
        across = np.array([0, 0.5, 1])
        slave = np.array([[a, b] for b in (1, 2) for a in across]), {"quad": [[0, 1, 4, 3], [1, 2, 5, 4]]}
        master = np.array([[a, b] for b in (0, 1) for a in (0.0, 1.0)]), {"quad": [[0, 1, 3, 2]]}
        for right in (chain((12, 8)), chain((12, 8), [(3, 15)]), chain((8, 12), [(3, 15)])):
            self.assertEqual(Model.from_meshes(right, slave, master).host_size, 20)
        wrong = "K has the block of the master's mesh before that of the slave's: .*; give that of the slave first"
        with self.assertRaisesRegex(ValueError, wrong):
            Model.from_meshes(chain((8, 12)), slave, master)
        for per_node in (2, 3):
            with self.assertRaisesRegex(ValueError, "exchange them"):
                Model.from_meshes((chain((4 * per_node, 0)), chain((6 * per_node, 0))), slave, master, dofs_per_node=per_node)

    def test_matrices_of_rings(self):
        """Two meshes of rings with as many nodes: of one material by its stresses, of two by the cells that it joins."""
        def mesh(low, high):
            at, elements, _ = rings.mesh(np.array([0.5, 1.0, 2.0]), np.array([0, 0.4, 1.0]) * (high - low))
            return at + [0, high], elements
        slave, master = mesh(1.0, 2.5), mesh(-1.0, 1.0)
        meshes = [(at, {"quad8": elements}) for at, elements in (slave, master)]
        stiff = [rings.stiffness(*of) for of in (slave, master)]
        many = [rings.stiffness(at, elements[:2]) for at, elements in (slave, master)]
        fixed = [1, 43]

        def model(*matrices, cells=meshes, **more):
            whole = {"full": lambda K: K, "lower": lower}[more.get("triangle", "full")]
            return Model.from_meshes(tuple(map(whole, matrices)), *cells, fixed=fixed, axisymmetric=True, **more)

        def lower(K):
            data, rows, starts = K
            columns = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
            kept = rows >= columns
            return data[kept], rows[kept], np.searchsorted(columns[kept], np.arange(len(starts)))
        for more in {}, {"triangle": "lower"}:
            self.assertEqual(model(*stiff, **more).host_size, 84)
            with self.assertRaisesRegex(ValueError, "the two matrices are exchanged: .* stretched rings of the other mesh"):
                model(*stiff[::-1], **more)
            for K in stiff:
                with self.assertRaisesRegex(ValueError, "both of one mesh: give one for each"):
                    model(K, K, **more)
        both = signorini._sparse.side_by_side(stiff[::-1])
        with self.assertRaisesRegex(ValueError, "K has the block of the master's mesh before .* stretched rings"):
            Model.from_meshes(both, *meshes, fixed=fixed, axisymmetric=True)
        # Another material in two elements, and supports as springs: nothing is known, and nothing is refused.
        two = [with_more(K, more) for K, more in zip(stiff, many)]
        self.assertEqual(model(*two).host_size, 84)
        # The nodes of the master count in another order.
        order = 8 * np.arange(21) % 21
        order[[3, 4]] = order[[4, 3]]
        other = master[0][order], {"quad8": np.argsort(order)[master[1]]}
        K = with_more(rings.stiffness(other[0], other[1]["quad8"]), rings.stiffness(other[0], other[1]["quad8"][:2]))
        self.assertEqual(model(two[0], K, cells=(meshes[0], other)).host_size, 84)
        with self.assertRaisesRegex(ValueError, "exchanged: one of them joins nodes that have no cell of its own mesh"):
            model(K, two[0], cells=(meshes[0], other))

    def test_a_plane_of_symmetry_that_is_not_named(self):
        springs, left = (np.ones(16), np.arange(16), np.arange(17)), 2 * np.array([0, 2, 4, 6])

        def warnings_of(fixed, **pairing):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                contact = signorini.pair_surfaces(SQUARE, [[4, 5]], [[3, 2]], **pairing)
                Model.from_surfaces(springs, {"cut": contact}, fixed=fixed)
            return [str(warning.message) for warning in caught]
        sentence = warnings_of(left)[0]
        print(f"| a plane of symmetry that is not named | Python | warning | {sentence} |")
        for word in ("zone 'cut'", "across the plane x = 0", "symmetry=[(0, 0)]"):
            self.assertIn(word, sentence)
        self.assertEqual(warnings_of(left, symmetry=[(0, 0.0)]), [])
        both = warnings_of(2 * np.arange(8))[0]
        self.assertIn("across the planes x = 0 and x = 1: if they are planes of symmetry, give symmetry=[(0, 0), (0, 1)]", both)
        across = (-np.sin(np.pi / 2), np.cos(np.pi / 2))  # 6e-17 along the other axis
        self.assertEqual(warnings_of(left, symmetry=[(across, 0.0)]), [])
        self.assertEqual(warnings_of(np.concatenate([left, left + 1])), [])  # clamped
        self.assertEqual(warnings_of([8]), [])  # the slave alone
        self.assertEqual(warnings_of(left, axisymmetric=True), [])  # the axis of revolution

    def told_of(self, contact, equations=None):
        """The warnings of a model on springs."""
        size = 2 * len(SQUARE)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            Model.from_surfaces((np.ones(size), np.arange(size), np.arange(size + 1)), contact, equations=equations)
        return [str(warning.message) for warning in caught]

    def test_rings_and_plane_bodies(self):
        """Bars in all sides and diagonals of two squares, which resist no motion as a whole; in rings each node has a hoop, which
        resists along x."""
        at, K = SQUARE + [1, 0], np.zeros((16, 16))
        for first in (0, 4):
            for a in range(first, first + 4):
                for b in range(first, a):
                    along = (at[a] - at[b]) / np.linalg.norm(at[a] - at[b])
                    ends, bar = np.concatenate([along, -along]), [2 * a, 2 * a + 1, 2 * b, 2 * b + 1]
                    K[np.ix_(bar, bar)] += np.outer(ends, ends)
        hoops, held = np.diag(np.tile([1.0, 0.0], 8)) * 1e-6, np.diag(np.arange(16) == 0) * 1.0
        says = {False: "K resists a motion of all nodes along x .*: give axisymmetric=True",
                True: "K does not resist a motion of all nodes across the axis .*: give K and loads of whole rings"}
        for stiff, of_rings, is_told in (
                (K, False, False), (K, True, True), (K + hoops, True, False), (K + hoops, False, True), (K + held, False, False),
                (K + hoops + np.diag(np.ones(16)), False, False)):
            for triangle in "full", "lower":
                part = np.tril(stiff) if triangle == "lower" else stiff
                columns, rows = np.nonzero(part.T)
                contact = signorini.pair_surfaces(at, [[4, 5]], [[3, 2]], axisymmetric=of_rings)
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    Model.from_surfaces((part[rows, columns], rows, np.searchsorted(columns, np.arange(17))), contact,
                                        fixed=[0, 1, 3, 8, 9, 11], triangle=triangle)
                self.assertEqual(len(caught), is_told)
                if is_told:
                    self.assertRegex(str(caught[0].message), says[of_rings])

    def test_a_plane_of_symmetry_beside_its_nodes(self):
        for place, distance in (0.0, ""), (-1e-5, "1.0e-5"), (-0.03, "3.0e-2"), (-0.2, ""):
            contact = signorini.pair_surfaces(SQUARE, [[4, 5]], [[3, 2]], symmetry=[(0, place)])
            told = self.told_of({"cut": contact})
            self.assertEqual(len(told), bool(distance))
            for one in told:
                self.assertRegex(one, f"zone 'cut': slave node 4 is {distance} away from plane of symmetry 0 and .* more digits")
                print(f"| a plane beside its nodes | Python | warning | {one} |")

    def test_a_sector_that_the_pairing_was_not_told_of(self):
        """Equations of boundaries, of a period and of a sector; a zone in the middle has no node of them. Equations that are not
        those of boundaries say nothing."""
        repeats, dofs = signorini.Period((1, 0)), np.arange(16).reshape(8, 2)
        period = signorini.sector_equations(SQUARE, repeats, bodies=np.arange(8) // 4)
        faces = [[4, 5]], [[3, 2]]
        says = "by equations slave node 5 is the image of slave node 4, .*: give sector to pair_surfaces"
        self.assertRegex(self.told_of(signorini.pair_surfaces(SQUARE, *faces), period)[0], says)
        self.assertRegex(self.told_of({"cut": signorini.pair_surfaces(SQUARE, *faces)}, period)[0], "^zone 'cut': " + says)
        self.assertEqual(self.told_of(signorini.pair_surfaces(SQUARE, *faces, sector=repeats), period), [])
        rigid = signorini.rigid_equations(dofs[[4, 5]], SQUARE[[4, 5]], [0, 1], [0, 1, 2])
        skewed = signorini.turned_equations(dofs[[4]], [[0, 1]], [[0, -1], [1, 0]])
        for others in rigid, skewed, [(11, [9], [1.0])], [(10, [8], [1.0]), (11, [9], [-1.0])], [(10, [8, 6], [0.5, 0.5])]:
            self.assertEqual(self.told_of(signorini.pair_surfaces(SQUARE, *faces), others), [], others)
        # A quarter of two rings in three zones, or four faces of which all nodes move with one.
        turns = np.arange(5) * np.pi / 8
        ring = np.array([radius * np.array([np.cos(turn), np.sin(turn)]) for radius in (1.1, 1.0) for turn in turns])
        sector = signorini.Sector(4, (0, 0))
        masters = [[5, 6], [6, 7], [7, 8], [8, 9]]
        quarter = signorini.sector_equations(ring, sector)
        plate = [(2 * node + axis, [axis], [1.0]) for node in range(1, 5) for axis in range(2)]
        springs = np.ones(20), np.arange(20), np.arange(21)
        ends, middle, thirds = [[1, 0], [4, 3]], [[2, 1], [3, 2]], {"a": [[1, 0]], "b": [[2, 1], [3, 2]], "c": [[4, 3]]}
        for slaves, lacks, equations, named in (
                ({"ends": ends, "middle": middle}, [], quarter, []), ({"ends": ends, "middle": middle}, ["middle"], quarter, []),
                ({"ends": ends, "middle": middle}, ["ends"], quarter, ["ends"]),
                (thirds, ["a", "b", "c"], quarter, ["a", "c"]), (thirds, ["a", "b", "c"], plate, [])):
            zones = {name: signorini.pair_surfaces(ring, slave, masters, sector=None if name in lacks else sector)
                     for name, slave in slaves.items()}
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                Model.from_surfaces(springs, zones, equations=equations)
            told = [str(warning.message) for warning in caught]
            self.assertEqual([one.split("'")[1] for one in told], named, told)
            self.assertTrue(all("by equations slave node 4 is the image of slave node 0" in one for one in told))
            for one in told:
                print(f"| a sector that a zone was not told of | Python | warning | {one} |")

    def test_warnings_name_the_line_that_calls(self):
        springs, left, cell = (np.ones(16), np.arange(16), np.arange(17)), 2 * np.array([0, 2, 4, 6]), {"quad": [[0, 1, 3, 2]]}
        half = np.ones(8), np.arange(8), np.arange(9)
        near, none = (signorini.pair_surfaces(SQUARE, slave, [[3, 2]]) for slave in ([[4, 5]], []))
        calls = (lambda: Model.from_surfaces(springs, near, fixed=left),
                 lambda: Model.from_surfaces(springs, {"one": none}),
                 lambda: Model.from_meshes((half, half), (SQUARE[4:], cell), (SQUARE[:4], cell), fixed=left))
        for call in calls:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
            self.assertEqual([(one.filename, one.lineno) for one in caught], [(__file__, call.__code__.co_firstlineno)])


if __name__ == "__main__":
    print("| mistake | interface | status | sentence |\n|---|---|---|---|")
    unittest.main()
