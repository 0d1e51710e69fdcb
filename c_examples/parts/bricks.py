"""Meshes of 20-node bricks in numpy, as a small stand-in for your own code: blocks bent to shape, their faces,
their stiffness matrix and loads.

    mesh = Bricks()
    mesh.block("ring", place, (divisions in r, s, t), young=210000.0)
    mesh.join()
    K = mesh.stiffness()
    inside = mesh.faces("ring", lambda at: np.hypot(at[..., 0], at[..., 1]) < 10 + 1e-6)

Nodes and bricks count from 0; the nodes of a brick stand in the order of VTK and of CalculiX. Units are yours.
"""

import numpy as np

CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                    [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4],
                  [0, 4], [1, 5], [2, 6], [3, 7]])
NODES = np.vstack([CORNERS, CORNERS[EDGES].mean(axis=1)]).astype(int)

# The sides S1 to S6 of CalculiX, seen from outside: corners, then the nodes between them.
SIDES = np.array([[0, 3, 2, 1, 11, 10, 9, 8], [4, 5, 6, 7, 12, 13, 14, 15],
                  [0, 1, 5, 4, 8, 17, 12, 16], [1, 2, 6, 5, 9, 18, 13, 17],
                  [2, 3, 7, 6, 10, 19, 14, 18], [3, 0, 4, 7, 11, 16, 15, 19]])

GAUSS = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0]), np.array([5.0, 8.0, 5.0]) / 9


def graded(first, last, length):
    """Places from 0 to 1 of nodes along a line of this length, whose cells grow from `first` to about `last`."""
    cells = max(2, int(np.ceil(2 * length / (first + last))))
    ratio = (last / first) ** (1 / (cells - 1))
    sizes = ratio ** np.arange(cells)
    return np.concatenate([[0.0], np.cumsum(sizes) / sizes.sum()])


def patch(bottom, top, left, right):
    """The plane region between four curves of [0, 1] (transfinite interpolation). Bottom and top run from left to
    right, left and right from the bottom to the top. Returns a function of (r, s)."""
    def place(r, s):
        r, s = r[..., None], s[..., None]
        corners = ((1 - r) * (1 - s) * bottom(0.0) + r * (1 - s) * bottom(1.0)
                   + (1 - r) * s * top(0.0) + r * s * top(1.0))
        return (1 - s) * bottom(r) + s * top(r) + (1 - r) * left(s) + r * right(s) - corners
    return place


def line(start, end):
    """A straight curve between two points."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    return lambda r: start + np.asarray(r) * (end - start)


def arc(centre, radius, start, end):
    """An arc about a centre between two angles in degrees."""
    def curve(r):
        angle = np.radians(start + np.asarray(r) * (end - start))
        at = np.concatenate([np.cos(angle), np.sin(angle)], axis=-1) if np.ndim(angle) \
            else np.array([np.cos(angle), np.sin(angle)])
        return np.asarray(centre, float) + radius * at
    return curve


def slab(region, thickness):
    """A plane region, a function of (r, s), as a slab from z = 0 on."""
    return lambda r, s, t: np.concatenate([region(r, s), thickness * t[..., None]], axis=-1)


class Bricks:
    """Bodies of 20-node bricks."""

    def __init__(self):
        self.at = np.zeros((0, 3))
        self.bricks = np.zeros((0, 20), int)
        self.body = np.zeros(0, int)
        self.names, self.young, self.poisson = [], [], []

    def block(self, body, place, cells, young=210000.0, poisson=0.3):
        """Adds a block to a body. `place` is a function of (r, s, t), each from 0 to 1; `cells` says into how many
        bricks each is divided, or where."""
        if body not in self.names:
            self.names.append(body)
            self.young.append(young)
            self.poisson.append(poisson)
        lines = [np.linspace(0, 1, cell + 1) if np.ndim(cell) == 0 else np.asarray(cell)
                 for cell in cells]
        fine = [np.interp(np.arange(2 * len(at) - 1) / 2, np.arange(len(at)), at) for at in lines]
        lattice = np.stack(np.meshgrid(*fine, indexing="ij"))
        number = len(self.at) + np.arange(lattice[0].size).reshape(lattice[0].shape)
        first = np.stack(np.meshgrid(*(2 * np.arange(len(at) - 1) for at in lines),
                                     indexing="ij"), axis=-1).reshape(-1, 1, 3)
        index = first + 1 + NODES
        self.at = np.vstack([self.at, place(*lattice).reshape(-1, 3)])
        self.bricks = np.vstack([self.bricks, number[tuple(np.moveaxis(index, -1, 0))]])
        self.body = np.append(self.body, np.full(len(first), self.names.index(body)))

    def join(self, close=1e-6):
        """Makes one node of those of a body that are closer than `close`, and drops those of no brick."""
        nodes, body = np.unique(np.stack([self.bricks.ravel(), np.repeat(self.body, 20)]), axis=1)
        # The shift keeps round numbers away from the limit between two cells of this grid.
        grid = np.floor(self.at[nodes] / close + 0.377).astype(np.int64)
        _, first, label = np.unique(np.column_stack([body, grid]), axis=0, return_index=True,
                                    return_inverse=True)
        place = np.full(len(self.at), -1)
        place[nodes] = label.ravel()
        self.at, self.bricks = self.at[nodes[first]], place[self.bricks]

    def nodes(self, body, where):
        """The nodes of a body at which a function of coordinates (n, 3) is true."""
        nodes = np.unique(self.bricks[self.body == self.names.index(body)])
        return nodes[where(self.at[nodes])]

    def sides(self, body, where):
        """Bricks and sides on the surface of a body all nodes of which obey `where`: two arrays."""
        bricks = np.flatnonzero(self.body == self.names.index(body))
        sides = self.bricks[bricks][:, SIDES]
        corners = np.sort(sides[:, :, :4], axis=-1).reshape(-1, 4)
        _, back, times = np.unique(corners, axis=0, return_inverse=True, return_counts=True)
        outside = (times[back.ravel()] == 1).reshape(len(bricks), 6)
        inside = where(self.at[sides.reshape(-1)]).reshape(sides.shape).all(axis=-1)
        brick, side = np.nonzero(outside & inside)
        return bricks[brick], side

    def faces(self, body, where):
        """The faces of these sides, (f, 8) nodes, seen from outside."""
        brick, side = self.sides(body, where)
        return self.bricks[brick[:, None], SIDES[side]]

    def stiffness(self):
        """The stiffness matrix by columns, all entries: (data, indices, indptr)."""
        shear = np.array(self.young)[self.body] / 2 / (1 + np.array(self.poisson)[self.body])
        ratio = np.array(self.poisson)[self.body]
        cross = 2 * shear * ratio / (1 - 2 * ratio)
        K = np.zeros((len(self.bricks), 20, 3, 20, 3))
        for point, weight in _points(3):
            slope = _slopes(point)
            jacobian = np.einsum("nk,mni->mki", slope, self.at[self.bricks])
            gradient = np.einsum("mik,nk->mni", np.linalg.inv(jacobian), slope)
            volume = weight * np.linalg.det(jacobian)
            if volume.min() <= 0:
                raise ValueError(f"brick {volume.argmin()} is turned over")
            inner = np.einsum("mak,mbk->mab", gradient, gradient) * (volume * shear)[:, None, None]
            outer = np.einsum("mai,mbj->maibj", gradient, gradient)
            K += outer * (volume * cross)[:, None, None, None, None]
            K += outer.transpose(0, 1, 4, 3, 2) * (volume * shear)[:, None, None, None, None]
            for axis in range(3):
                K[:, :, axis, :, axis] += inner
        dof = (3 * self.bricks[:, :, None] + np.arange(3)).reshape(-1, 60)
        rows, columns = np.repeat(dof, 60, axis=1).ravel(), np.tile(dof, 60).ravel()
        size = 3 * len(self.at)
        entry, place = np.unique(columns * size + rows, return_inverse=True)
        return (np.bincount(place.ravel(), K.ravel()), entry % size,
                np.searchsorted(entry, size * np.arange(size + 1)))

    def load(self, faces, traction):
        """Nodal forces of a traction on faces, 3 n: a vector, or a function of coordinates (f, 3)."""
        force = np.zeros((len(self.at), 3))
        for point, weight in _points(2):
            shape, slope = _face_shapes(point)
            at = np.einsum("n,fni->fi", shape, self.at[faces])
            across = np.einsum("nk,fni->kfi", slope, self.at[faces])
            area = np.linalg.norm(np.cross(across[0], across[1]), axis=-1)
            value = np.broadcast_to(traction(at) if callable(traction) else traction, at.shape)
            np.add.at(force, faces, weight * shape[:, None] * (area[:, None] * value)[:, None, :])
        return force.ravel()

    def cells(self):
        """Cells for a file that ParaView opens."""
        return {"hexahedron20": self.bricks}


def _points(dim):
    for index in np.ndindex(*(3,) * dim):
        yield GAUSS[0][list(index)], GAUSS[1][list(index)].prod()


def _slopes(point):
    """Derivatives of the 20 shape functions, (20, 3)."""
    def shapes(at):
        factor = 1 + NODES * at
        corner = factor.prod(axis=1) * ((NODES * at).sum(axis=1) - 2) / 8
        edge = np.where(NODES == 0, 1 - at ** 2 + 0 * NODES, factor).prod(axis=1) / 4
        return np.where((NODES == 0).any(axis=1), edge, corner)
    # They are polynomials: a complex step gives all digits.
    step = 1e-30
    return np.stack([shapes(point + 1j * step * axis).imag / step for axis in np.eye(3)], axis=1)


def _face_shapes(point):
    """The 8 shape functions of a face and their derivatives, (8,) and (8, 2)."""
    nodes = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]])

    def shapes(at):
        factor = 1 + nodes * at
        corner = factor.prod(axis=1) * ((nodes * at).sum(axis=1) - 1) / 4
        edge = np.where(nodes == 0, 1 - at ** 2 + 0 * nodes, factor).prod(axis=1) / 2
        return np.where((nodes == 0).any(axis=1), edge, corner)
    step = 1e-30
    slopes = [shapes(point + 1j * step * axis).imag / step for axis in np.eye(2)]
    return shapes(point), np.stack(slopes, axis=1)
