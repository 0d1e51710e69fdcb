"""Two blocks of 8-node bricks in numpy: mesh and assembly, as a small stand-in for your own code.

    import brick_mesh, signorini
    blocks = brick_mesh.two_blocks()
    model = signorini.Model.sparse(blocks.matrix, blocks.lower, [0, 0, 1], fixed=blocks.held,
                                   masters=blocks.upper[:, None], tangents=[1, 0, 0])
    result = model.solve(blocks.press, gap=0.0, mu=0.6)

It is the mesh of blocks.h: two blocks on each other, trilinear bricks of 10 mm, 2 x 2 x 2 Gauss
points; mm, N, MPa.
"""

from collections import namedtuple

import numpy as np

Blocks = namedtuple("Blocks", "at matrix lower upper held press twist")
Blocks.__doc__ = """Two assembled blocks of n nodes.

at: coordinates of the nodes, (n, 3).  matrix: (data, indices, indptr), 3 n columns, all entries.
lower, upper: degrees of freedom (x, y, z) of the two nodes of each pair, (P, 3).  held: those of
the bottom.  press, twist: loads of 40000 N downwards, and of a moment of 1 N mm about z, 3 n each.
"""


def two_blocks(cell=10.0, wide=10, deep=4, narrow=8, high=2, young=210000.0, poisson=0.3,
               press=40000.0):
    """Meshes and assembles the blocks; numbers of cells along their sides. Returns Blocks."""
    below, bricks_below = _box(cell, wide, deep, -cell * deep)
    above, bricks_above = _box(cell, narrow, high, 0.0)
    at = np.vstack([below, above])
    bricks = np.vstack([bricks_below, len(below) + bricks_above])

    # All bricks are the same cube: entry (m, n) of its matrix goes to row m, column n of each.
    dof = (3 * bricks[:, :, None] + [0, 1, 2]).reshape(len(bricks), 24)
    rows, columns = np.repeat(dof, 24, axis=1).ravel(), np.tile(dof, 24).ravel()
    values = np.tile(_element(cell, young, poisson).ravel(), len(bricks))

    rim, line = (wide - narrow) // 2, narrow + 1
    node = np.arange(len(at))
    top = node[:len(below)].reshape(deep + 1, wide + 1, wide + 1)[-1]
    layers = node[len(below):].reshape(high + 1, line, line)
    pairs = [top[rim:rim + line, rim:rim + line].ravel(), layers[0].ravel()]

    loaded = layers[-1].ravel()
    x, y, _ = at[loaded].T
    inner = loaded[(abs(x) <= 2 * cell) & (abs(y) <= 2 * cell)]
    down, turn = np.zeros(3 * len(at)), np.zeros(3 * len(at))
    down[3 * inner + 2] = -press / len(inner)
    turn[3 * loaded], turn[3 * loaded + 1] = np.array([-y, x]) / (x @ x + y @ y)

    lower, upper = (3 * nodes[:, None] + [0, 1, 2] for nodes in pairs)
    return Blocks(at, _compress(rows, columns, values, 3 * len(at)), lower, upper,
                  np.arange(3 * (wide + 1) ** 2), down, turn)


def _box(cell, across, up, bottom):
    """Nodes, x first, and bricks (corners as in VTK_HEXAHEDRON) of a box around the z axis."""
    line = cell * (np.arange(across + 1) - across / 2)
    z, y, x = np.meshgrid(bottom + cell * np.arange(up + 1), line, line, indexing="ij")
    node = np.arange(x.size).reshape(x.shape)
    corners = [node[k:up + k, j:across + j, i:across + i].ravel()
               for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return np.column_stack([x.ravel(), y.ravel(), z.ravel()]), np.column_stack(corners)


def _element(side, young, poisson):
    """Stiffness of a cube, (24, 24)."""
    shear = young / 2 / (1 + poisson)
    cross = 2 * shear * poisson / (1 - 2 * poisson)
    place = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                      [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
    K = np.zeros((8, 3, 8, 3))
    for point in place / np.sqrt(3):
        factor = 1 + place * point
        gradient = place * factor[:, [1, 2, 0]] * factor[:, [2, 0, 1]] / (4 * side)
        K += cross * np.einsum("ai,bj->aibj", gradient, gradient)
        K += shear * np.einsum("aj,bi->aibj", gradient, gradient)
        K += shear * np.einsum("ak,bk,ij->aibj", gradient, gradient, np.eye(3))
    return (side / 2) ** 3 * K.reshape(24, 24)


def _compress(rows, columns, values, size):
    """Sums the triplets of each entry: (data, indices, indptr) by columns, rows ascending."""
    entry, place = np.unique(columns.astype(np.int64) * size + rows, return_inverse=True)
    starts = np.searchsorted(entry, size * np.arange(size + 1))
    return np.bincount(place, values), entry % size, starts
