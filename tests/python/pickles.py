"""What is pickled and copied is made again in another process, with the same bits.

    python3 tests/python/pickles.py
"""

import copy
import functools
import os
import pickle
import subprocess
import sys
import unittest
import warnings

import numpy as np

import common
import signorini

from surfaces import MASTER, NODES, SLAVE

# Each degree of freedom of NODES on a spring.
SPRINGS = (np.arange(1.0, 11.0), np.arange(10), np.arange(11))
# Two rings around the origin, a quarter of them.
RING = np.array([radius * np.array([np.cos(angle), np.sin(angle)]) for radius in (1.1, 1.0)
                 for angle in (0, np.pi / 4, np.pi / 2)])
LOAD = np.array([0.0, -1.0, 0.3, -2.0] + [0.0] * 6)
NAMES = ("d", "F", "state")


def again(thing):
    """By pickle, and by a deep copy."""
    return pickle.loads(pickle.dumps(thing)), copy.deepcopy(thing)


def in_another_process(thing, ask):
    """What a new process finds that unpickles a thing: ask, a text, is an expression of it."""
    program = ("import pickle, sys; import common; data = sys.stdin.buffer.read(); thing = pickle.loads(data); "
               f"sys.stdout.buffer.write(pickle.dumps({ask}))")
    here = os.path.dirname(os.path.abspath(__file__))
    done = subprocess.run([sys.executable, "-c", program], input=pickle.dumps(thing), stdout=subprocess.PIPE, check=True,
                          cwd=here)
    return pickle.loads(done.stdout)


class Pickles(unittest.TestCase):
    def same(self, found, expected):
        for name in NAMES:
            np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))

    def same_pairs(self, found, expected):
        for name in ("gaps", "areas", "normals", "tangents", "points", "nodes", "unpaired", "folded", "coordinates"):
            np.testing.assert_array_equal(getattr(found, name), getattr(expected, name), name)
        self.assertEqual((found.summary, found.report), (expected.summary, expected.report))
        for (dofs, weights), (others, own) in zip(found.rows, expected.rows, strict=True):
            np.testing.assert_array_equal(dofs, others)
            np.testing.assert_array_equal(weights, own)

    def test_pairs_keep_what_they_were_made_of(self):
        told = []
        dofs, nodes = 2 * np.arange(5)[:, None] + [0, 1], NODES.copy()
        shape = signorini.Plane([0, 0], [0, 1])
        rigid = signorini.RigidFaces(NODES[2:], [[2, 1], [1, 0]])
        for contact in (
            signorini.pair_surfaces(nodes, SLAVE, MASTER, dofs=dofs, clearance=-0.05, rims="keep", progress=told.append),
            signorini.pair_surfaces(nodes, SLAVE, MASTER, master_shape=shape, symmetry=[(0, 0.0)]),
            signorini.pair_surfaces(nodes, SLAVE, MASTER, pairing="node_to_surface"),
            signorini.pair_obstacle(nodes, SLAVE, shape, axisymmetric=True),
            signorini.pair_obstacle(nodes, SLAVE, rigid),
            signorini.pair_surfaces(RING, [[2, 1], [1, 0]], [[3, 4], [4, 5]], sector=signorini.Sector(4, [0, 0])),
        ):
            contact.gaps[0] = 0.125
            expected = copy.copy(contact)
            dofs[:], nodes[:] = 0, 0.5
            for found in again(contact):
                self.same_pairs(found, expected)
                self.assertIsNot(found.gaps, contact.gaps)
            dofs[:], nodes[:] = 2 * np.arange(5)[:, None] + [0, 1], NODES

    def test_models_of_each_kind_have_the_same_bits(self):
        W = np.linalg.inv(common.K)
        sparse = (np.array([2.0, 1, 3]), np.array([0, 1, 1]), np.array([0, 2, 3]))
        models = [
            (signorini.Model.condensed(common.K, time_limit=1000.0), common.LOAD),
            (signorini.Model.two_body(common.K, common.K), common.LOAD * 2),
            (signorini.Model.flexibility(W), common.LOAD),
            (signorini.Model.flexibility(sparse, triangle="lower"), [1.0, 0.5]),
            (signorini.Model.sparse(SPRINGS, [[0, 1], [2, 3]], [0, -1], fixed=[9], full_space=True,
                                    equations=((of, [2], [1.0]) for of in (4,))), LOAD),
        ]
        for model, load in models:
            expected = model.solve(load, 0.1, 0.3)
            for found in (*again(model), copy.copy(model)):
                self.assertEqual((found.kind, found.pairs, found.host_size), (model.kind, model.pairs, model.host_size))
                self.same(found.solve(load, 0.1, 0.3), expected)

    def test_a_model_keeps_its_matrix_and_its_pairs(self):
        contact = signorini.pair_surfaces(NODES, SLAVE, MASTER)
        values = SPRINGS[0].copy()
        equations = [(10, [0, 1], [1.0, 2.0])]
        model = signorini.Model.from_surfaces((values, *SPRINGS[1:]), contact, fixed=[9], equations=equations)
        expected, u = model.solve(LOAD, mu=0.3), model.extended(np.ones(10))
        values[:] = 1e3
        equations.clear()
        for found in again(model):
            self.same(found.solve(LOAD, mu=0.3), expected)
            self.same_pairs(found.contact, contact)
            np.testing.assert_array_equal(found.extended(np.ones(10)), u)
        one, other = pickle.loads(pickle.dumps((contact, model)))
        self.assertIs(other.contact, one)
        found = in_another_process(model, f"thing.solve({LOAD.tolist()}, mu=0.3)")
        self.same(found, expected)

    def test_zones(self):
        mu = np.array([0.3])
        contacts = {"rail": signorini.Zone(signorini.pair_surfaces(NODES, SLAVE, MASTER), mu)}
        model = signorini.Model.from_surfaces(SPRINGS, contacts)
        expected = model.solve(LOAD)
        mu[:] = 0.0
        for found in again(model):
            result = found.solve(LOAD)
            self.same(result, expected)
            self.same(result.zone("rail"), expected.zone("rail"))
        for zone in again(contacts["rail"]):
            self.same_pairs(zone.contact, contacts["rail"].contact)
        for zones in again(expected.contact):
            self.assertEqual(zones.summary, expected.contact.summary)

    def test_pairs_of_a_mesh_without_the_faces_that_lie_over_nothing(self):
        """Those pairs know all faces given; the model of a mesh is made again without a second warning."""
        nodes = np.array([[0, 0.1], [1, 0.1], [2, 0.1], [2, 1.0], [0, 1.0], [-1, 0], [1.5, 0], [1.5, -1], [-1, -1]])
        upper, lower = (nodes[:5], {"line": [[0, 1], [1, 2], [2, 3], [3, 4], [4, 0]]}), (nodes[5:], {"line": [[1, 0]]})
        contact = signorini._meshes.pair_meshes(upper, lower, slave_faces=upper[1]["line"], master_faces=[[1, 0]])
        for found in again(contact):
            self.same_pairs(found, contact)
            self.assertEqual([face.tolist() for face in found.slave_faces], [face.tolist() for face in contact.slave_faces])
            self.assertEqual(found.penetration(np.zeros(18)), contact.penetration(np.zeros(18)))
        alone = signorini.pair_surfaces(NODES + np.array([[0, 5]] * 2 + [[0, 0]] * 3), SLAVE, MASTER)
        with self.assertWarns(UserWarning):
            model = signorini.Model.from_surfaces(SPRINGS, alone)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            again(model)

    def test_functions_of_the_host_stay_in_their_process(self):
        model = signorini.Model.operator(2, 2, functools.partial(np.dot, common.K), lambda x: np.linalg.solve(common.K, x))
        for take in (pickle.dumps, copy.deepcopy):
            with self.assertRaisesRegex(TypeError, "a model of functions of the host belongs to this process"):
                take(model)
        np.testing.assert_array_equal(copy.copy(model).solve(common.LOAD, 0.1, 0.3).d,
                                      model.solve(common.LOAD, 0.1, 0.3).d)


if __name__ == "__main__":
    unittest.main()
