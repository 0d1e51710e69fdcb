"""Contact pairs from two meshes: arrays, or objects like those of meshio."""

import numpy as np

from ._arrays import integers, reals
from ._constants import Pairing, chosen
from ._library import SignoriniError
from ._matrices import check_matrices
from ._mesh import TYPES, points
from ._sector import checked, without_axis, without_cuts
from ._skin import corners, dimension, skin, turned
from ._surfaces import Cone, Cylinder, Plane, RigidFaces, Sphere, Torus, pair_obstacle, pair_surfaces

# Faces look the same way if the cosine between their normals is above this.
SAME_WAY = 0.7

# Cells that are faces, by the dimension of the space.
FACES = {2: ("line", "line3"), 3: ("triangle", "triangle6", "quad", "quad8", "quad9")}

# Areas are the same if their quotient is above this: the rest is rounding.
SAME_AREA = 1 - 1e-6


def pair_meshes(slave, master, *, slave_faces=None, master_faces=None, fixed=(), **pairing):
    """Pairs the faces of two meshes that may touch: SurfacePairs.

    slave, master: a mesh each, (coordinates, cells) with cells as for write_mesh, or an object with
    points and cells as meshio reads it. Nodes count on: those of the slave's mesh, then those of
    the master's. The same object twice: one mesh with both bodies, whose nodes count once. master
    may be a Plane, Sphere, Cylinder, Cone, Torus or RigidFaces.
    slave_faces, master_faces: None, the whole skin of the mesh, of a sector without its boundaries, of a body of revolution without
    its axis; the name of a set of cells or of a physical group, of faces or of the cells whose skin is meant; a function of
    coordinates, (n, D), that tells for each node whether its faces of the skin belong, which they do if all of their
    nodes do; or faces, as for pair_surfaces, in nodes of their mesh, which are on its skin, or cells of it. Faces that lie on the
    skin are turned to the outside; those of the slave that lie over nothing and look elsewhere than those beside
    them over the master have no say in the normals of pairs. slave_faces, uncovered and beyond count all faces, and
    penetration asks all.
    Coordinates with a third column that is the same everywhere are those of a plane mesh if no cell
    has a volume. The rest: as for pair_surfaces.
    """
    sector = None if pairing.get("sector") is None else checked(pairing["sector"])
    is_of_rings = bool(pairing.get("axisymmetric", False))
    first = _Mesh("slave", slave, sector, is_of_rings)
    if isinstance(master, (Plane, Sphere, Cylinder, Cone, Torus, RigidFaces)):
        if master_faces is not None:
            raise ValueError("master_faces is given, but master is an obstacle: leave it out")
        if slave_faces is None:
            raise ValueError("master is an obstacle, which any face may lie opposite to: give slave_faces")
        return pair_obstacle(first.coordinates, first.faces("slave_faces", slave_faces), master, **pairing)
    pairing = {**pairing, "fixed": fixed}
    faces = first.faces("slave_faces", slave_faces)
    if master is slave:
        if slave_faces is None or master_faces is None:
            raise ValueError("slave and master are one mesh: give slave_faces and master_faces")
        others = first.faces("master_faces", master_faces)
        return _covered(first.coordinates, faces, others, pairing)
    second = _Mesh("master", master, sector, is_of_rings)
    if second.coordinates.shape[1] != first.coordinates.shape[1]:
        raise ValueError(f"slave has {first.coordinates.shape[1]} coordinates for each node and master "
                         f"{second.coordinates.shape[1]}: give two meshes of one dimension")
    before = len(first.coordinates)
    others = [[before + node for node in face] for face in second.faces("master_faces", master_faces)]
    try:
        return _covered(np.vstack([first.coordinates, second.coordinates]), faces, others, pairing)
    except SignoriniError as error:
        for side, given in (("slave", slave_faces), ("master", master_faces)):
            if given is None and f"shape of the {side}" in str(error):
                raise SignoriniError(f"{error}: give {side}_faces, those on the shape, in the place of the whole skin",
                                     error.status) from None
        if None in (slave_faces, master_faces) and "stand at one place" in str(error):
            raise SignoriniError(f"{error}, or give slave_faces and master_faces, those in contact, in the place of whole "
                                 "skins", error.status) from None
        raise


def check_owners(matrices, triangle, slave, master, pairing):
    """Refuses matrices that are not those of two meshes, or of one and an obstacle."""
    if "dofs" in pairing:
        return
    meshes, is_of_rings = [_Mesh("slave", slave)], bool(pairing.get("axisymmetric", False))
    if master is not slave and not isinstance(master, (Plane, Sphere, Cylinder, Cone, Torus, RigidFaces)):
        meshes.append(_Mesh("master", master))
    per_node = pairing.get("dofs_per_node") or meshes[0].coordinates.shape[1]
    check_matrices(matrices, triangle, meshes, per_node, is_of_rings)


def _covered(coordinates, slave, master, pairing):
    """Pairs whose normals are those of slave faces over the master. Against surfaces those that lie over nothing and look elsewhere
    than those beside them are left out for that; faces are counted, and asked for what has passed through them, as all were
    given."""
    whole = pair_surfaces(coordinates, slave, master, **pairing)
    uncovered = set(whole.uncovered.tolist())
    if len(uncovered) in (0, len(slave)):
        return whole
    normals = [_normal(coordinates[face[:corners(face, whole.dim)]]) for face in slave]
    around = {}
    for place, face in enumerate(slave):
        if place not in uncovered:
            for node in face:
                around[node] = around.get(node, 0) + normals[place]
    kept = [place for place, face in enumerate(slave) if place not in uncovered or any(
        node in around and normals[place] @ around[node] > SAME_WAY * np.linalg.norm(around[node]) for node in face)]
    if chosen("pairing", Pairing, pairing.get("pairing", Pairing.DUAL_MORTAR)) == Pairing.DUAL_MORTAR:
        whole.drawn_faces = [whole.slave_faces[place] for place in kept]
        return whole
    faces = [slave[place] for place in kept]
    contact = pair_surfaces(coordinates, faces, master, **pairing)
    if contact.pairs < whole.pairs or contact.report.covered_area < SAME_AREA * whole.report.covered_area:
        # The default limits are those of the faces left, and smaller.
        contact = pair_surfaces(coordinates, faces, master, **{**pairing, "search_distance": whole.report.search_distance})
    if len(contact.beyond):
        contact.summary = contact.summary.rpartition("; ")[0]
    for name in ("slave_faces", "uncovered", "beyond", "beyond_distances", "penetration"):
        setattr(contact, name, getattr(whole, name))
    for name in ("uncovered", "beyond", "slave_faces", "slave_area"):
        setattr(contact.report, name, getattr(whole.report, name))
    share = 100 * contact.report.covered_area / contact.report.slave_area
    contact.summary += f"; of the area of all {len(slave)} faces given {share:.2f} %"
    if len(whole.beyond):
        contact.summary += "; " + whole.summary.rpartition("; ")[2]
    return contact


def _normal(x):
    """Unit normal of a face by its corners, in 2D of a line."""
    if len(x) == 2:
        normal = np.array([x[1, 1] - x[0, 1], x[0, 0] - x[1, 0]])
    else:
        normal = np.cross(x[2] - x[0], x[-1] - x[1])
    return normal / np.linalg.norm(normal)


class _Mesh:
    """Coordinates, (n, D), and blocks of cells: (type, nodes)."""

    def __init__(self, name, mesh, sector=None, is_of_rings=False):
        self.name, self.mesh, self.sector, self.is_of_rings = name, mesh, sector, is_of_rings
        if hasattr(mesh, "points") and hasattr(mesh, "cells"):
            coordinates, cells = mesh.points, mesh.cells
        elif isinstance(mesh, tuple) and len(mesh) == 2:
            coordinates, cells = mesh
        else:
            raise TypeError(f"{name} is a {type(mesh).__name__}: give (coordinates, cells), or a mesh as meshio reads "
                            f"it")
        blocks = cells.items() if hasattr(cells, "items") else cells
        self.blocks = [_block(name, block) for block in blocks]
        self.coordinates = _placed(name, points(coordinates), [kind for kind, _ in self.blocks])
        for kind, nodes in self.blocks:
            if nodes.size and (nodes.min() < 0 or nodes.max() >= len(self.coordinates)):
                raise ValueError(f"{name}: a cell of the type {kind} has the node {nodes.max()}, and there are "
                                 f"{len(self.coordinates)} nodes: count them from 0")
        self._skin = None

    @property
    def skin(self):
        if self._skin is None:
            self._skin = skin(self.coordinates, self.blocks)
        return self._skin

    def faces(self, argument, wanted):
        """Faces as lists of nodes, turned to the outside where they lie on the skin."""
        if wanted is None:
            skin = self.skin if self.sector is None else without_cuts(self.skin, self.coordinates, self.sector)
            if self.is_of_rings:
                skin = without_axis(skin, self.coordinates)
            return self._some(skin, f"{self.name} has no cells with an inside: give {argument}")
        if isinstance(wanted, str):
            return self._some(self._of_set(argument, wanted), f"{argument}: the set {wanted!r} has no faces")
        if callable(wanted):
            chosen = np.asarray(wanted(self.coordinates))
            if chosen.dtype != bool or chosen.shape != (len(self.coordinates),):
                raise ValueError(f"{argument} returns the shape {chosen.shape} of {chosen.dtype}: return a truth "
                                 f"value for each of the {len(self.coordinates)} nodes")
            return self._some([face for face in self.skin if chosen[face].all()],
                              f"{argument} chooses no face: there is none of which all nodes are chosen")
        faces = [[int(node) for node in integers(argument, face).ravel()] for face in wanted]
        self._check_places(argument, faces)
        return self._turned(faces)

    def _check_places(self, argument, faces):
        """Refuses faces that are neither on the skin, or a part of one of its faces, nor cells of the mesh."""
        if not self.skin:
            return
        dim, around = self.coordinates.shape[1], {}
        cells = [cell.tolist() for kind, nodes in self.blocks if kind in FACES[dim] for cell in nodes]
        for known in [*self.skin, *cells]:
            for node in known:
                around.setdefault(node, []).append(frozenset(known))
        for place, face in enumerate(faces):
            if face and not any(known.issuperset(face) for known in around.get(face[0], ())):
                raise ValueError(f"{argument}: face {place}, of the nodes {', '.join(map(str, face))}, is not on the skin of "
                                 f"the mesh of the {self.name}: check the number from which its nodes count, from 0 in their "
                                 "own mesh")

    def _some(self, faces, sentence):
        if not faces:
            raise ValueError(sentence)
        return faces

    def _turned(self, faces):
        """Faces as those of the skin with the same corners; others as they are."""
        dim = self.coordinates.shape[1]
        outside = {frozenset(face[:corners(face, dim)]): face for face in self.skin}
        found = []
        for face in faces:
            known = outside.get(frozenset(face[:corners(face, dim)]))
            same = known is None or _goes_as(known[:corners(known, dim)], face[:corners(face, dim)])
            found.append(face if same else turned(face, dim))
        return found

    def _of_set(self, argument, wanted):
        """Faces of a set of cells, or the skin of its cells with an inside."""
        members = self._members(argument, wanted)
        chosen = [(kind, nodes[members[place]]) for place, (kind, nodes) in enumerate(self.blocks)
                  if members[place] is not None and len(members[place])]
        dim = self.coordinates.shape[1]
        inner = [block for block in chosen if dimension([block[0]]) == dim]
        if inner:
            return skin(self.coordinates, inner)
        return self._turned([face.tolist() for kind, nodes in chosen if kind in FACES[dim] for face in nodes])

    def _members(self, argument, wanted):
        """For each block the places of the cells of a set, or None."""
        sets = getattr(self.mesh, "cell_sets", None) or {}
        if wanted in sets:
            return [None if of is None else np.asarray(of, int) for of in sets[wanted]]
        groups = getattr(self.mesh, "field_data", None) or {}
        numbers = (getattr(self.mesh, "cell_data", None) or {}).get("gmsh:physical")
        if wanted in groups and numbers is not None:
            # Groups of different dimensions may have one number; dimension tells 0 of lines.
            number, of_dimension = (int(part) for part in groups[wanted][:2])
            return [np.flatnonzero(np.asarray(of) == number) if (dimension([kind]) or 1) == of_dimension else None
                    for (kind, _), of in zip(self.blocks, numbers)]
        names = ", ".join(sorted([*sets, *groups])) or "none"
        raise ValueError(f"{argument}: {self.name} has no set {wanted!r}; sets: {names}")


def _goes_as(one, other):
    """Does a line, or a face, go through the same corners in the same direction?"""
    if len(one) == 2:
        return one == other
    place = other.index(one[0])
    return other[place:] + other[:place] == one


def _block(name, block):
    try:
        kind, nodes = (block.type, block.data) if hasattr(block, "type") else block
    except (TypeError, ValueError):
        kind = None
    if not isinstance(kind, str):
        raise ValueError(f"{name}: its cells have no type: give them as {{'hexahedron': array}}, with the type as in meshio")
    if kind not in TYPES:
        raise ValueError(f"{name}: there is no type of cells {kind!r}; types: {', '.join(TYPES)}; of others "
                         "give faces to pair_surfaces")
    nodes = integers(f"{name}: cells of the type {kind}", nodes)
    if nodes.ndim != 2:
        raise ValueError(f"{name}: cells of the type {kind} have the shape {nodes.shape}: give the "
                         f"nodes of each, shape (cells, nodes)")
    return kind, nodes


def _placed(name, coordinates, types):
    """Coordinates with as many columns as the cells have dimensions."""
    dim = dimension(types) or coordinates.shape[1]
    if coordinates.shape[1] == dim:
        return coordinates
    if dim == 2 and np.ptp(reals(name, coordinates)[:, 2]) == 0:
        return np.ascontiguousarray(coordinates[:, :2])
    raise ValueError(f"{name} has {coordinates.shape[1]} coordinates for each node, and cells of dimension {dim}: give "
                     f"{dim} coordinates")
