"""Two blocks of 8-node bricks in numpy: mesh and assembly, as a small stand-in for your own code.

    import brick_mesh, signorini
    blocks = brick_mesh.two_blocks()
    contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
    model = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=blocks.held)
    result = model.solve(blocks.press, gap=contact.gaps, mu=0.6)

It is the mesh of blocks.h: two blocks on each other, trilinear bricks of 10 and 7.5 mm, 2 x 2 x 2
Gauss points; mm, N, MPa.
"""

from collections import namedtuple

import numpy as np

Blocks = namedtuple("Blocks", "at bricks matrix slave master held press twist")
Blocks.__doc__ = """Two assembled blocks of n nodes.

at: coordinates of the nodes, (n, 3).  bricks: their nodes, (b, 8).  matrix: (data, indices,
indptr), 3 n columns, all entries.  slave, master: faces of the upper and of the lower block that may
touch, (f, 4).  held: degrees of freedom of the bottom.  press, twist: loads of 40000 N downwards, and of a moment of 1 N mm about z, 3 n each.
"""


def two_blocks(coarse=10.0, fine=7.5, wide=10, deep=4, narrow=8, high=2, young=210000.0,
               poisson=0.3, press=40000.0):
    """Meshes and assembles the blocks; numbers of cells along their sides. Returns Blocks."""
    below, bricks_below = _box(coarse, wide, deep, -coarse * deep)
    above, bricks_above = _box(fine, narrow, high, 0.0)
    at = np.vstack([below, above])
    bricks = np.vstack([bricks_below, len(below) + bricks_above])

    # All bricks of a block are the same cube: entry (m, n) of its matrix goes to row m, column n.
    dof = (3 * bricks[:, :, None] + [0, 1, 2]).reshape(len(bricks), 24)
    rows, columns = np.repeat(dof, 24, axis=1).ravel(), np.tile(dof, 24).ravel()
    values = np.concatenate([np.tile(_element(cell, young, poisson).ravel(), len(of_block))
                             for cell, of_block in ((coarse, bricks_below), (fine, bricks_above))])

    loaded = len(at) - np.arange((narrow + 1) ** 2)[::-1] - 1
    x, y, _ = at[loaded].T
    inner = loaded[(abs(x) <= 20) & (abs(y) <= 20)]
    down, turn = np.zeros(3 * len(at)), np.zeros(3 * len(at))
    down[3 * inner + 2] = -press / len(inner)
    turn[3 * loaded], turn[3 * loaded + 1] = np.array([-y, x]) / (x @ x + y @ y)

    # Faces anticlockwise as seen from outside: of the upper block's bottom, of the lower one's top.
    slave = bricks[len(bricks_below):][:narrow ** 2, [0, 3, 2, 1]]
    master = bricks_below[-wide ** 2:, 4:]
    return Blocks(at, bricks, _compress(rows, columns, values, 3 * len(at)), slave, master,
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
