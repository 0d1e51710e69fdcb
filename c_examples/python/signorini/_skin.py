"""The faces of cells: those on the skin of a mesh, with their nodes as the library wants them."""

import numpy as np

# Corners and edges of the cells that have an inside, with the corners of their faces. The mid nodes
# of quadratic cells follow their corners in the order of the edges (VTK's, and meshio's).
_TRIANGLE = (3, ((0, 1), (1, 2), (2, 0)), ((0, 1), (1, 2), (2, 0)))
_QUAD = (4, ((0, 1), (1, 2), (2, 3), (3, 0)), ((0, 1), (1, 2), (2, 3), (3, 0)))
_TETRA = (4, ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)))
_HEXAHEDRON = (
    8,
    ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    # In the order of the nodes in their centres, of cells with 27 nodes.
    ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
)
_WEDGE = (
    6,
    ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
)
_PYRAMID = (
    5,
    ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
)
_SHAPES = {
    "triangle": _TRIANGLE, "triangle6": _TRIANGLE, "quad": _QUAD, "quad8": _QUAD, "quad9": _QUAD,
    "tetra": _TETRA, "tetra10": _TETRA, "hexahedron": _HEXAHEDRON, "hexahedron20": _HEXAHEDRON,
    "hexahedron27": _HEXAHEDRON, "wedge": _WEDGE, "wedge15": _WEDGE, "pyramid": _PYRAMID,
    "pyramid13": _PYRAMID,
}
_PLANE = ("triangle", "triangle6", "quad", "quad8", "quad9")
_CENTRES = 20  # the first node in the centre of a face, of cells with 27 nodes


def dimension(types):
    """The dimension of the largest cells of these types: 3, 2 or, if there are none with an inside, 0."""
    if any(name in _SHAPES and name not in _PLANE for name in types):
        return 3
    return 2 if any(name in _PLANE for name in types) else 0


def corners(face, dim):
    """Number of corners of a face by the number of its nodes."""
    if dim == 2:
        return 2
    return 3 if len(face) in (3, 6) else 4


def skin(coordinates, blocks):
    """Faces that belong to one cell alone, as lists of nodes, seen from outside counterclockwise.

    blocks: (type, nodes of the cells). Cells of another dimension than the coordinates are passed over.
    """
    dim = coordinates.shape[1]
    found = {}
    for name, cells in blocks:
        if dimension([name]) != dim:
            continue
        for cell in cells:
            for face in _faces(name, cell):
                key = frozenset(face[:corners(face, dim)])
                found[key] = None if key in found else (face, cell)
    return [_outward(face, cell, coordinates) for face, cell in filter(None, found.values())]


def turned(face, dim):
    """A face seen from its other side."""
    count = corners(face, dim)
    first, mids, centre = face[:count], face[count:2 * count], face[2 * count:]
    if dim == 2:
        return first[::-1] + face[2:]
    return first[:1] + first[:0:-1] + mids[::-1] + centre


def _faces(name, cell):
    """Nodes of each face of a cell: corners, then mid nodes, then the centre. Of cells with corners that are one node, as bricks that are
    wedges, faces have each node once, and such as have become a line or a point are left out."""
    count, edges, faces = _SHAPES[name]
    mids = {}
    if len(cell) >= count + len(edges):
        mids = {frozenset(edge): cell[count + place] for place, edge in enumerate(edges)}
    for place, face in enumerate(faces):
        around = list(zip(face, face[1:] + face[:1]))[:1 if len(face) == 2 else None]
        nodes = [cell[corner] for corner in face]
        nodes += [mids[frozenset(edge)] for edge in around if mids]
        if name == "hexahedron27":
            nodes.append(cell[_CENTRES + place])
        yield from _distinct([int(node) for node in nodes], len(face))


def _distinct(nodes, count):
    """The nodes of a face with so many corners, with each corner once and the mid nodes of edges that are left; none if it has no area."""
    ring, mids = nodes[:count], nodes[count:2 * count]
    kept = [k for k, node in enumerate(ring) if node != ring[(k + 1) % count]]
    if len(kept) == count:
        return [nodes]
    own = [ring[k] for k in kept] + [mids[k] for k in kept if mids]
    return [own] if len(kept) == 3 and len(set(own)) == len(own) else []


def _outward(face, cell, coordinates):
    """The face, turned if its normal leads into its cell."""
    dim = coordinates.shape[1]
    at = coordinates[face[:corners(face, dim)]]
    if dim == 2:
        along = at[1] - at[0]
        normal = np.array([along[1], -along[0]])  # the body lies to the left of the line
    else:
        normal = np.cross(at[2] - at[0], at[-1] - at[1] if len(at) == 4 else at[2] - at[1])
    inside = coordinates[cell].mean(axis=0) - at.mean(axis=0)
    return turned(face, dim) if normal @ inside > 0 else face
