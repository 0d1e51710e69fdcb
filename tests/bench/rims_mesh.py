"""Unstructured solids by gmsh, and their stiffness: tetrahedra with 4 and 10 nodes, bricks with 20."""

import itertools

import gmsh
import numpy as np
import scipy.sparse as sp

# Of each kind gmsh's number, edges in the order of its mid nodes, and its sides as seen from outside.
TET_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
BRICK_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
TET_SIDES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
BRICK_SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TET = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
BRICK = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                  [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], float)
KINDS = {"tet4": (4, TET, [], TET_SIDES), "tet10": (11, TET, TET_EDGES, TET_SIDES),
         "hex20": (17, BRICK, BRICK_EDGES, BRICK_SIDES)}


class Element:
    """A kind of element: derivatives of its functions at its points of integration, and its sides."""

    def __init__(self, kind):
        self.number, corners, edges, sides = KINDS[kind]
        self.corners = len(corners)
        nodes = np.array([*corners, *(corners[list(edge)].mean(axis=0) for edge in edges)])
        powers = [p for p in itertools.product(range(3), repeat=3) if self.spans(kind, p)]
        powers = np.array(powers)
        coefficients = np.linalg.inv(np.prod(nodes[:, None] ** powers, axis=2)).T
        self.points, self.slopes = (self.cube if self.corners == 8 else self.tetrahedron)(), []
        for at, _ in self.points:
            along = []
            for axis in range(3):
                lower = np.maximum(powers - np.eye(3, dtype=int)[axis], 0)
                along.append(coefficients @ (powers[:, axis] * np.prod(at ** lower, axis=1)))
            self.slopes.append(np.stack(along, axis=1))
        between = {frozenset(edge): self.corners + k for k, edge in enumerate(edges)}
        self.sides = np.array([side + tuple(between[frozenset((a, b))] for a, b in zip(side, side[1:] + side[:1])
                                            if between) for side in sides])

    @staticmethod
    def spans(kind, powers):
        return powers.count(2) < 2 if kind == "hex20" else sum(powers) <= (1 if kind == "tet4" else 2)

    @staticmethod
    def cube():
        at, weight = np.polynomial.legendre.leggauss(3)
        return [(at[list(k)], weight[list(k)].prod()) for k in np.ndindex(3, 3, 3)]

    @staticmethod
    def tetrahedron():
        at, weight = np.polynomial.legendre.leggauss(3)
        at, weight, points = (at + 1) / 2, weight / 2, []
        for i, j, k in np.ndindex(3, 3, 3):
            rest, last = 1 - at[i], (1 - at[i]) * (1 - at[j])
            points.append((np.array([at[i], rest * at[j], last * at[k]]),
                           weight[i] * weight[j] * weight[k] * rest ** 2 * (1 - at[j])))
        return points

    def stiffness(self, at, elements, young, poisson):
        shear = young / 2 / (1 + poisson)
        cross = 2 * shear * poisson / (1 - 2 * poisson)
        count = elements.shape[1]
        K = np.zeros((len(elements), count, 3, count, 3))
        for slope, (_, weight) in zip(self.slopes, self.points):
            jacobian = np.einsum("nk,mni->mki", slope, at[elements])
            gradient = np.einsum("mik,nk->mni", np.linalg.inv(jacobian), slope)
            volume = weight * np.linalg.det(jacobian)
            if volume.min() <= 0:
                raise ValueError("an element is turned over")
            outer = np.einsum("mai,mbj->maibj", gradient, gradient) * volume[:, None, None, None, None]
            K += cross * outer + shear * outer.transpose(0, 1, 4, 3, 2)
            inner = shear * np.einsum("maibi->mab", outer)
            for axis in range(3):
                K[:, :, axis, :, axis] += inner
        dof = (3 * elements[:, :, None] + np.arange(3)).reshape(len(elements), -1)
        rows, columns = np.broadcast_arrays(dof[:, :, None], dof[:, None, :])
        K = sp.coo_matrix((K.ravel(), (rows.ravel(), columns.ravel())), shape=(3 * len(at),) * 2).tocsc()
        return (K + K.T) / 2

    def skin(self, elements):
        """Faces of one element alone, (f, k) nodes."""
        faces = elements[:, self.sides].reshape(-1, self.sides.shape[1])
        corners = np.sort(faces[:, :3 if self.corners == 4 else 4], axis=1)
        _, back, times = np.unique(corners, axis=0, return_inverse=True, return_counts=True)
        return faces[times[back.ravel()] == 1]


def solid(kind, size, seed, build, triangles=6):
    """Coordinates and elements of a body of this size of elements. `build` makes its shape, tetrahedra or, by a sweep
    of quadrilaterals, bricks; `triangles` is gmsh's Mesh.Algorithm of surfaces: 6 is its default, 5 Delaunay's."""
    element = Element(kind)
    gmsh.initialize()
    for name, value in (("General.Terminal", 0), ("Mesh.RandomSeed", seed), ("Mesh.MeshSizeMin", size),
                        ("Mesh.MeshSizeMax", size), ("Mesh.SecondOrderIncomplete", 1), ("Mesh.Algorithm", triangles),
                        ("Mesh.RecombineAll", int(kind == "hex20"))):
        gmsh.option.setNumber(name, value)
    build(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    if kind != "tet4":
        gmsh.model.mesh.setOrder(2)
    tags, at, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, int)
    place[tags] = np.arange(len(tags))
    (number,), _, (nodes,) = gmsh.model.mesh.getElements(3)
    if number != element.number:
        raise ValueError(f"gmsh made elements {number}, not {element.number}")
    gmsh.finalize()
    elements = place[nodes.reshape(-1, len(element.slopes[0]))]
    used, elements = np.unique(elements, return_inverse=True)
    return at.reshape(-1, 3)[used], elements.reshape(-1, len(element.slopes[0]))


def two(kind, bodies, materials):
    """Two bodies in one mesh: coordinates, K, the number of nodes of the first one, and the faces of each."""
    element, first = Element(kind), len(bodies[0][0])
    K = sp.block_diag([element.stiffness(*body, *material) for body, material in zip(bodies, materials)]).tocsc()
    K.sort_indices()
    faces = [element.skin(bodies[0][1]), element.skin(bodies[1][1]) + first]
    return np.vstack([at for at, _ in bodies]), K, first, faces
