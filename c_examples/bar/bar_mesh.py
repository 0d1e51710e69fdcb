"""The bar on the plane in numpy: mesh and assembly, as a small stand-in for your own code.

    import bar_mesh, signorini
    bar = bar_mesh.assemble()
    model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
    result = model.solve(bar.load, gap=0.0, mu=1.0)
    u = model.recover(result.d, bar.load)

It is the mesh of bar_mesh.c: plane strain, four-node quadrilaterals, 2 x 2 Gauss points, 40 mm by
40 mm, rows that grow from the contact side y = 0; forces in daN for 1 mm of thickness.
"""

from collections import namedtuple

import numpy as np

Bar = namedtuple("Bar", "x matrix load contact held")
Bar.__doc__ = """An assembled bar of n degrees of freedom.

x: of the contact nodes, from the free corner on, mm.  matrix: (data, indices, indptr), n columns,
all entries.  load: n, daN.  contact: degrees of freedom (x, y) of each contact node, (P, 2).
held: those that the symmetry at x = 40 holds.
"""


def assemble(side_pressure=10.0, top_pressure=5.0, rows=5, ratio=1.7, columns=32, side=40.0,
             young=13000.0, poisson=0.2):
    """Assembles the bar. Pressures push inward, daN/mm2. Returns a Bar."""
    heights = ratio ** np.arange(rows)
    heights *= side / heights.sum()
    x = np.linspace(0.0, side, columns + 1)
    node = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)

    K = np.zeros((2 * node.size,) * 2)
    for row, height in enumerate(heights):
        element = _element(side / columns, height, young, poisson)
        for column in range(columns):
            corners = node[[row, row, row + 1, row + 1], [column, column + 1, column + 1, column]]
            at = (2 * corners[:, None] + [0, 1]).ravel()
            K[np.ix_(at, at)] += element

    # Consistent nodal loads: each edge gives half of its resultant to both of its ends.
    load = np.zeros(len(K))
    top, left = 2 * node[-1] + 1, 2 * node[:, 0]
    for ends in (top[:-1], top[1:]):
        load[ends] -= top_pressure * side / columns / 2
    for ends in (left[:-1], left[1:]):
        load[ends] += side_pressure * heights / 2

    columns_of, rows_of = np.nonzero(K.T)  # column by column, rows ascending
    starts = np.concatenate([[0], np.cumsum(np.bincount(columns_of, minlength=len(K)))])
    contact = 2 * node[0][:, None] + [0, 1]
    return Bar(x, (K[rows_of, columns_of], rows_of, starts), load, contact, 2 * node[:, -1])


def condense(bar):
    """The bar condensed on its contact side, as signorini.solve wants it: K, (N, N), and f, N.

    n = (0, -1), t = (1, 0): d_n = -u_y, d_t = u_x. What is held stays as a decoupled row.
    """
    data, rows, starts = bar.matrix
    K, f = np.zeros((len(bar.load),) * 2), bar.load.copy()
    K[rows, np.repeat(np.arange(len(f)), np.diff(starts))] = data
    for held in bar.held:
        diagonal = K[held, held]
        K[held], K[:, held], K[held, held], f[held] = 0.0, 0.0, diagonal, 0.0
    inner = np.setdiff1d(np.arange(len(f)), bar.contact)
    outer = bar.contact[:, ::-1].ravel()  # (y, x), node by node
    sign = np.tile([-1.0, 1.0], len(bar.contact))
    K_ii, K_io = K[np.ix_(inner, inner)], K[np.ix_(inner, outer)]
    X = np.linalg.solve(K_ii, np.column_stack([K_io, f[inner]]))
    K_c = K[np.ix_(outer, outer)] - K_io.T @ X[:, :-1]
    f_c = f[outer] - K_io.T @ X[:, -1]
    return sign[:, None] * (K_c + K_c.T) / 2 * sign, sign * f_c


def _element(width, height, young, poisson):
    """Stiffness of a rectangle, (8, 8); nodes anticlockwise from the lower left."""
    shear = young / 2 / (1 + poisson)
    cross = 2 * shear * poisson / (1 - 2 * poisson)
    elasticity = np.diag([cross + 2 * shear, cross + 2 * shear, shear])
    elasticity[[0, 1], [1, 0]] = cross
    corner_x, corner_y = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    K = np.zeros((8, 8))
    for x, y in zip(corner_x / np.sqrt(3), corner_y / np.sqrt(3)):
        B = np.zeros((3, 8))
        B[0, ::2] = B[2, 1::2] = corner_x * (1 + corner_y * y) / (2 * width)
        B[1, 1::2] = B[2, ::2] = corner_y * (1 + corner_x * x) / (2 * height)
        K += width * height / 4 * B.T @ elasticity @ B
    return K
