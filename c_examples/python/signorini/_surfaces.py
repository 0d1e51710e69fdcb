"""Contact pairs from surfaces, and what a solution means on them."""

import copy
import ctypes
import functools
from collections import namedtuple
from types import SimpleNamespace

import numpy as np

from ._arrays import at, components, copied, doubles, fit, indices, integers, number, per_pair, reals
from ._call import Call
from ._constants import Normals, Obstacle, Pairing, Rims, State, Status, chosen, member
from ._equations import Equations
from ._library import Owner, Remade, SignoriniError, check, library
from ._mesh import Cells, points
from ._sector import Period, checked, ways_of
from ._sparse import supports
from ._structures import (ContactFields, Faces, NodalField, Pairs, PenetrationData, ResultantSums, RigidObstacle,
                          SurfaceData, SurfaceSettings, Zone, address, i32, i64, real, sized)

_PASS_BY = 2.0  # where gaps are larger than those of the coordinates, surfaces pass by so many times the difference

Plane = namedtuple("Plane", "point outward")
Plane.__doc__ = """A rigid half space, in 2D a half plane.

point: of its face.  outward: the direction out of it, of any length.
"""

Sphere = namedtuple("Sphere", "centre radius hollow", defaults=[False])
Sphere.__doc__ = """A rigid ball, in 2D a disc.  hollow: the body is inside, as in a bowl."""

Cylinder = namedtuple("Cylinder", "point axis radius hollow", defaults=[False])
Cylinder.__doc__ = """A rigid round bar of any length, in 3D.

point: of its axis.  axis: its direction.  hollow: the body is inside, as in a bore.
"""

Cone = namedtuple("Cone", "point to_apex radius hollow", defaults=[False])
Cone.__doc__ = """A rigid cone that widens from its apex without end, in 3D.

point: the middle of one of its circles.  to_apex: from there to the apex.  radius: of that circle.  hollow:
the body is inside, as in a countersink.
"""

Torus = namedtuple("Torus", "centre axis radius ring hollow", defaults=[False])
Torus.__doc__ = """A rigid torus, in 3D.

axis: the direction across the ring.  radius: of the tube.  ring: radius of the circle in the middle of the
tube.  hollow: the body is inside of the tube.
"""

RigidFaces = namedtuple("RigidFaces", "coordinates faces")
RigidFaces.__doc__ = """A rigid mesh with nodes of its own, such as the triangles of a drawing.

coordinates: (n, D).  faces: as slave of pair_surfaces; corners counterclockwise as the body sees
them, in 2D the obstacle to the left of a line.
"""

Fields = namedtuple("Fields", "pressure traction clearance slip state")
Fields.__doc__ = """Fields at the n nodes of the mesh, in its axes. Nodes in no pair have 0, and state -1.

pressure: positive presses, (n,).  traction: force of the contact on the node's own body over area,
(n, D).  clearance: what is left of the gap, (n,).  slip: motion along the surface against the
other body since slip0, (n, D).  state: of its pair (State), (n,).
"""

Resultant = namedtuple("Resultant", "force moment friction_work pressed_area")
Resultant.__doc__ = """Sums over a contact zone, over whole rings if it is axisymmetric.

force: of the contact on the slave's body, (3,).  moment: about the point, (3,).  friction_work:
what friction takes in the step.  pressed_area: of the pairs that press.
"""

ZoneSums = namedtuple("ZoneSums", "zone pairs open slip stick pressed_area force")
ZoneSums.__doc__ = """A row of Result.table().

zone: its name.  pairs: how many; open, slip, stick: of them in each state.  pressed_area: of the pairs that
press.  force: of the contact on the slave's body, (3,).
"""

Penetration = namedtuple("Penetration", "points depth point face node master_face sentence")
Penetration.__doc__ = """What has passed through the other side, without a pair or as its pairs slide far; the deepest point of it.

points: number of slave nodes and of middles of slave faces that have, and of nodes of the master through other slave
faces.  depth: along its normal, of a rigid shape its distance from the shape.
point: where, moved, (3,).  face: its slave face, or that which a node of the master has passed through.  node: of either
side; -1: the middle of the face, or a node of a rigid mesh.
master_face: the face that it has passed through; -1: a shape.  sentence: the same in words.
"""


def pair_surfaces(coordinates, slave, master, *, pairing="dual_mortar", search_distance=0.0,
                  dofs=None, dofs_per_node=0, symmetry=(), normals="averaged", rims="fold",
                  axisymmetric=False, slave_shape=None, master_shape=None, fitted=False,
                  close_within=0.0, clearance=0.0, time_limit=0.0, progress=None, sector=None, tangent=None,
                  keep_turns=False, fixed=()):
    """Pairs two surfaces of a mesh: SurfacePairs. Surfaces that never meet give no pairs.

    coordinates: of all nodes, (n, D).  slave, master: nodes of each face, (F, k), or a list of
    lists for faces of several kinds; counted from 0. In 2D lines of 2 or 3 nodes, the body to the
    left of a line; in 3D triangles (3, 6) and quadrilaterals (4, 8, 9), counterclockwise from
    outside; corners first, then mid nodes, then the centre.
    pairing: "dual_mortar" or "node_to_surface".  search_distance: the largest one along the normal;
    0: overlapping surfaces up to the size of the largest slave face, and not through the body behind it;
    open ones up to that too, or if that is larger up to the radius of the smaller side, the largest
    distance of a node from the mean of its nodes. Of masters behind each other the nearest counts.
    dofs: degrees of freedom of each node, (n, D); None: dofs_per_node * node + axis, dofs_per_node
    0: D.
    symmetry: planes of symmetry of a half or quarter model, pairs of the axis across each and where
    it stands along it: [(0, 0.0), (1, 0.0)], or of a direction (D,), with all digits, for a skewed one at an angle a:
    [((-sin(a), cos(a), 0), 0.0)]. Pairs on one neither move nor carry a force across it.
    sector: the Sector that the mesh is of a body that repeats about an axis, or the Period of one that repeats along a
    line or two; pairs are those of the whole.
    normals: "averaged" over all slave faces at a node, or of the "faces" in contact: slave faces over
    the master by dual mortar, the nearest master face by "node_to_surface".
    rims: slave nodes with less than half of their area over the master, corners of faces with mid nodes with less than
    three tenths, "fold" into the nearest nodes of their faces, or "keep" pairs of their own; "fold_little": those with less than three tenths fold, so that
    more pairs resolve the rim. By "node_to_surface" the default alone.
    axisymmetric: lines in 2D are meridians of bodies of revolution about the axis x = 0; areas are those
    of whole rings, and so must be stiffness and loads.
    slave_shape, master_shape: the true shape of a side, of which its faces are facets, as a Plane, Sphere,
    Cylinder, Cone or Torus; None: its faces. Gaps are measured to it; hollow has no say. By dual mortar.
    fitted: sides without a shape are curved through their nodes, by normals fitted to the nodes around; edges of more
    than 35 degrees stay sharp.
    close_within: gaps of at most this size become zero.  clearance: is added to every gap then; negative: an
    interference.
    tangent: in 3D the direction of first tangents, (3,), as nearly as the tangent plane of each pair allows, from which the
    angle of orthotropic friction counts; None: the axis most across the normals of all pairs, of equal ones the first.
    keep_turns: for sides that are tied: rows keep rigid turns of both, also where facets of curved sides do not fit.
    fixed: the fixed degrees of freedom of the model, if supports hold both sides in one place: a slave node that they hold along
    its normal, beside one that moves and over a master that they hold, then has no pair, as at rims. Its force would be any number.
    time_limit: seconds; 0: none.  progress: as for solve; a function that cancels, or the limit, raises
    SignoriniError.
    """
    slave, master = _Faces("slave", slave), _Faces("master", master)
    return SurfacePairs("surface_pair", coordinates, slave, master, pairing,
                        search_distance, dofs, dofs_per_node, symmetry, normals, rims, axisymmetric,
                        (slave_shape, master_shape, fitted, close_within, clearance), sector, tangent, keep_turns,
                        fixed, time_limit, progress)


def pair_obstacle(coordinates, slave, obstacle, *, search_distance=0.0, dofs=None,
                  dofs_per_node=0, symmetry=(), normals="averaged", rims="fold", axisymmetric=False,
                  slave_shape=None, master_shape=None, fitted=False, close_within=0.0, clearance=0.0,
                  time_limit=0.0, progress=None, sector=None, tangent=None):
    """Pairs a surface with a rigid Plane, Sphere, Cylinder, Cone, Torus or RigidFaces: SurfacePairs.

    The rest: as for pair_surfaces; search_distance 0: no limit, and with RigidFaces as there.
    symmetry, normals, rims and master_shape are read for RigidFaces alone: a shape has normals of its own. slave_shape and
    fitted tell where mid nodes on chords belong.
    """
    coordinates = points(coordinates)
    slave, rigid = _Faces("slave", slave), _Rigid(obstacle, coordinates.shape[1])
    return SurfacePairs("surface_pair_obstacle", coordinates, slave, rigid,
                        Pairing.DUAL_MORTAR, search_distance, dofs, dofs_per_node, symmetry, normals,
                        rims, axisymmetric, (slave_shape, master_shape, fitted, close_within, clearance),
                        sector, tangent, False, (), time_limit, progress)


# Of the making of SurfacePairs: what belongs to one process.
_OF_THIS_PROCESS = ("_functions", "_handle", "_owner", "structure", "_made_of")
_SIDES, _NUMBERS = slice(2, 4), slice(6, 8)  # of what they are made of: both sides, and dofs with dofs_per_node


class SurfacePairs(Remade):
    """P contact pairs from surfaces; made by pair_surfaces or pair_obstacle.

    dim, pairs: D and P.  gaps, areas: (P,).  normals, tangents: unit vectors, (P, D).  points:
    where the force of each pair acts, (P, D).  nodes: slave node of each pair, (P,).
    gaps are yours to change: solve, fields and write take them where neither they nor the case of a result are given any.
    coordinates: those given.  slave_faces: the nodes of each slave face.
    unpaired: slave nodes without a pair.  folded: nodes with little cover, each with the nearest of those
    whose pairs share its row, (k, 2); folded_distances: how far away that is, (k,).  uncovered: slave faces
    that lie over nothing.  beyond: those of them that point at a master beyond the search distance, or
    overlap one by more; beyond_distances: how far away it is, negative where they overlap.
    summary: one sentence.  report: numbers and areas of signorini_surface_data, n_unpaired as
    unpaired and so on.
    They can be pickled: another process pairs the same surfaces again, and has the same bits.
    """

    def __init__(self, make, coordinates, slave, other, pairing, search_distance, dofs,
                 dofs_per_node, symmetry, normals, rims, axisymmetric, gaps, sector, tangent, keep_turns,
                 fixed, time_limit, progress):
        self._functions, self._coordinates = library(), points(coordinates).copy()
        self.node_count, self.dim = self._coordinates.shape
        # Without what watches the pairing: neither time_limit nor progress.
        self._made_of = (make, self._coordinates, slave, other, *copy.deepcopy((
            pairing, search_distance, dofs, dofs_per_node, symmetry, normals, rims, axisymmetric, gaps, sector,
            tangent, keep_turns, fixed)))
        self.slave_faces = self.drawn_faces = slave.lists
        self.coordinates = self._coordinates
        settings = sized(
            SurfaceSettings, pairing=chosen("pairing", Pairing, pairing),
            search_distance=number("search_distance", search_distance), dofs_per_node=dofs_per_node,
            normals=chosen("normals", Normals, normals), rims=chosen("rims", Rims, rims),
            axisymmetric=bool(axisymmetric), keep_turns=bool(keep_turns), time_limit=number("time_limit", time_limit),
        )
        *shapes, settings.fitted, close_within, clearance = gaps
        settings.close_within, settings.clearance = number("close_within", close_within), number("clearance", clearance)
        shapes = [shape and _shape(shape, self.dim) for shape in shapes]
        settings.slave_shape, settings.master_shape = (
            shape and ctypes.addressof(shape) for shape in shapes)
        call = Call(self._functions, {"progress": progress})
        settings.progress = call.settings.progress
        across, places = _planes(symmetry, self.dim)
        # Nodes on the axis of bodies of revolution stand as on a plane of symmetry.
        along = [int(abs(normal).argmax()) for normal in across
                 if np.count_nonzero(abs(normal) > 1e-6 * abs(normal).max()) == 1]
        self.symmetry_axes = along + ([0] if axisymmetric else [])
        settings.symmetry_planes = len(across)
        settings.symmetry_normals, settings.symmetry_at = (at(array) if len(across) else None for array in (across, places))
        self.is_sector, self.is_of_rings = sector is not None, bool(axisymmetric)
        if isinstance(sector, Period):
            for place, way in zip((settings.period, settings.second_period), ways_of(sector, self.dim)):
                place[:self.dim] = way
        elif self.is_sector:
            sector = checked(sector)
            point = fit("point", sector.point, [(self.dim,)], f"a place, shape {(self.dim,)}")
            axis = fit("axis", sector.axis, [(3,)], "a direction, shape (3,)")
            settings.sectors, settings.sector_point, settings.sector_axis = sector.count, at(point), at(axis)
        self._fixed = fixed = indices(supports(fixed))
        self.knows_supports = len(fixed) > 0
        settings.n_fixed, settings.fixed = len(fixed), at(fixed) if len(fixed) else None
        if tangent is not None:
            settings.tangent[:] = fit("tangent", tangent, [(3,)], "a direction, shape (3,)")
        if dofs is not None:
            dofs = indices(integers("dofs", dofs))
            if dofs.shape != self._coordinates.shape:
                raise ValueError(f"dofs has the shape {dofs.shape}: give the degrees of freedom of "
                                 f"each node, shape {self._coordinates.shape}")
            settings.node_dofs = at(dofs)
        handle, data = address(), sized(SurfaceData)
        status, message = call.run(
            getattr(self._functions, make), self.dim, self.node_count, at(self._coordinates),
            ctypes.byref(slave.structure), ctypes.byref(other.structure), ctypes.byref(settings),
            ctypes.byref(handle))
        if status != 0:
            raise SignoriniError(message, member(Status, status))
        self._handle = handle.value
        self._owner = Owner(self._functions.surface_free, self._handle)
        self._do("surface_view", ctypes.byref(data))
        self.report = SimpleNamespace(**{name.removeprefix("n_"): getattr(data, name)
                                         for name, kind in data._fields_ if kind in (i32, i64, real)})
        self.pairs, self.summary = data.pairs, data.summary.decode()
        # Address of the signorini_pairs for the library; it lives as long as this object.
        self.structure = data.rows
        self._read(data)

    def __reduce__(self):
        state = {name: value for name, value in self.__dict__.items() if name not in _OF_THIS_PROCESS}
        return type(self), (*self._made_of, 0.0, None), state

    def _read(self, data):
        """Copies the arrays."""
        def array(name, shape, kind=real):
            found = copied(getattr(data, name), shape, kind)
            return np.zeros(shape, kind) if found is None else found

        pairs, dim = self.pairs, self.dim
        self.gaps, self.areas = (array(name, (pairs,)) for name in ("gaps", "areas"))
        self.normals, self.tangents, self.points = (
            array(name, (pairs, dim)) for name in ("normals", "tangents", "points"))
        self._paired_gaps = self.gaps.copy()  # gaps are the caller's to change
        self.nodes = array("nodes", (pairs,), i64)
        self.unpaired = array("unpaired", (data.n_unpaired,), i64)
        self.folded = array("folded", (data.n_folded, 2), i64)
        self.folded_distances = array("folded_distances", (data.n_folded,))
        self.uncovered = array("uncovered", (data.n_uncovered,), i64)
        self.beyond = array("beyond", (data.n_beyond,), i64)
        self.beyond_distances = array("beyond_distances", (data.n_beyond,))

    @property
    def rows(self):
        """For each pair (dofs, weights): rows of Model.sparse, which takes those of several zones in one list.

        Of a sector and on skewed planes weights are vectors, (k, D), and dofs (k,).
        """
        if not self.pairs:
            return []
        pairs = Pairs.from_address(self.structure)
        ends = copied(pairs.row_start, (self.pairs + 1,), i64)
        each, shared = ((), (self.dim,))[:: 1 if pairs.row_vectors else -1]
        dofs = copied(pairs.row_nodes, (ends[-1], *each), i64)
        weights = copied(pairs.row_vectors or pairs.row_weights, (ends[-1], *shared))
        return [(dofs[begin:end], weights[begin:end]) for begin, end in zip(ends, ends[1:])]

    def with_equations(self, equations):
        """The pairs for the library with equations between degrees of freedom, or None."""
        pairs = SimpleNamespace(structure=Pairs.from_buffer_copy(Pairs.from_address(self.structure)))
        if equations is not None:
            pairs.equations = Equations(equations)
            pairs.structure.equations = pairs.equations.address
        return pairs

    def fields(self, result, *, slip0=None, gap=None):
        """Pressure, traction, clearance, slip and state at all nodes: Fields.

        result: what Model.solve returned.  slip0, gap: those of the step; None: those of result, and if its case had none
        zeros and gaps. Leave slip0 out for a part of a result: a pair that zones share has that of the first of them.
        """
        count, dim = self._coordinates.shape
        found = Fields(np.zeros(count), np.zeros((count, dim)), np.zeros(count),
                       np.zeros((count, dim)), np.full(count, -1, np.int32))
        gap, slip0, d, F, state = self._results(result, slip0, gap)
        places = sized(ContactFields, **{name: at(values) for name, values in
                                         zip(Fields._fields, found)})
        self._do("surface_fields", at(gap), at(slip0), at(d), at(F), at(state),
                 ctypes.byref(places))
        if result.frames is not None:
            # Their vectors over areas in the axes of the mesh.
            moved = np.hstack([np.zeros((self.pairs, 1)), d[:, 1:] - (0.0 if slip0 is None else slip0)])
            for place, vectors in (found.traction, F), (found.slip, self.areas[:, None] * moved):
                own = self._turned(vectors, result.frames)
                only = sized(ContactFields, traction=at(place))
                self._do("surface_fields", None, None, at(d), at(own), None, ctypes.byref(only))
        return found

    def resultant(self, result, point=None, *, slip0=None):
        """Force and moment on the slave's body about a point (D,), None: the origin: Resultant.

        result, slip0: as for fields.
        """
        _, slip0, d, F, _ = self._results(result, slip0, None)
        asked = f"a place, shape {(self.dim,)}"
        point = fit("point", point, [(self.dim,)], asked, optional=True)
        sums, acting = sized(ResultantSums), sized(ResultantSums)
        for of, forces in (sums, F), (acting, self._turned(F, result.frames)):
            self._do("surface_resultant", at(slip0), at(d), at(forces), at(point), ctypes.byref(of))
        return Resultant(np.array(acting.force), np.array(acting.moment), sums.friction_work, sums.pressed_area)

    def table(self, result, name="contact"):
        """A ZoneSums of all pairs, in a list, as Result.table gives it."""
        sums = self.resultant(result)
        count = [int((result.state == state).sum()) for state in (State.OPEN, State.SLIP, State.STICK)]
        return [ZoneSums(name, self.pairs, *count, sums.pressed_area, sums.force)]

    def _turned(self, vectors, frames):
        """Vectors in frames of their own, or None, in those that the library has of the pairs."""
        if frames is None:
            return vectors
        return doubles(np.einsum("pik,pjk,pj->pi", frames_of(self.normals, self.tangents), frames, vectors))

    def adjusted(self, within=np.inf, moves=1):
        """Coordinates of all nodes, with slave nodes moved so that the two points of each pair meet.

        within: the largest distance between them that is closed. A tie of curved sides then follows a rigid turn
        but for little; with keep_turns of pair_surfaces wholly.
        moves: how often; the moved nodes are paired again before the next. A second one leaves less at
        single pairs of quadratic faces. With a limit within one alone: distances are those before.
        Assemble K with these coordinates, and pair them again.
        """
        if not isinstance(moves, (int, np.integer)):
            raise TypeError(f"moves is {moves!r}: give a whole number")
        if moves < 1 or moves > 1 and within < np.inf:
            raise ValueError(f"moves is {moves}: give at least 1, and 1 with a limit within, which is of the distances before")
        contact, coordinates = self, self._coordinates.copy()
        for move in range(moves):
            if move:
                make, _, *settings = self._made_of
                contact = SurfacePairs(make, coordinates, *settings, 0.0, None)
            contact._do("surface_adjust", float(within), at(coordinates))
        return coordinates

    def penetration(self, u):
        """What has passed through the other side, without a pair or as its pairs slide far: a Penetration, or None if nothing has.

        u: displacements of all degrees of freedom, as Model.recover returns them, at least of the nodes of faces. A point
        that has passed through the whole of a rigid shape and is outside again is not found.
        """
        found = sized(PenetrationData)
        u = self._displacements(u)
        self._do("surface_penetration", at(u), ctypes.byref(found))
        if not found.points:
            return None
        place = ", ".join(f"{x:.6g}" for x in found.point[:self.dim])
        what = f"node {found.node}" if found.node >= 0 else f"a point of slave face {found.face}"
        through = f"master face {found.master_face}" if found.master_face >= 0 else "the obstacle"
        sentence = (
            f"{found.points} nodes and middles of slave faces have passed through the other side, the "
            f"deepest, {what} at ({place}), through {through} by {found.depth:.4g}: pair with a larger search_distance, "
            f"let the side with the finer mesh be the slave, or, where pairs slide far, solve in steps and pair the moved meshes")
        return Penetration(found.points, found.depth, np.array(found.point), found.face, found.node,
                           found.master_face, sentence)

    def _passed(self, u, larger, elsewhere=0.0):
        """The Penetration, unless it is within what gaps of a case that are larger by so much around its face let pass.

        Larger gaps are of surfaces that the coordinates do not show, infinite ones of pairs that never touch.
        elsewhere: what those of zones at the same nodes are larger by, which stands for surfaces that have no pairs.
        """
        found = self.penetration(u)
        if not found:
            return None
        allowed = larger[self._around(found.face, np.isfinite(larger))].max(initial=0.0) if self.pairs else elsewhere
        return found if found.depth > _PASS_BY * allowed else None

    def _touches(self, other):
        """Tells if faces of both have a node in common."""
        mine, others = ([node for side in one._made_of[_SIDES] if isinstance(side, _Faces) for node in side.nodes]
                        for one in (self, other))
        return not set(mine).isdisjoint(others)

    def _around(self, face, of):
        """A mask, within another one, of the pairs on slave faces that share a node with a face; of the nearest if there are none."""
        nodes, own = np.concatenate(self.slave_faces), self.slave_faces[face]
        faces = np.repeat(np.arange(len(self.slave_faces)), list(map(len, self.slave_faces)))
        beside = np.isin(faces, faces[np.isin(nodes, own)])
        around = of & np.isin(self.nodes, nodes[beside])
        if around.any() or not of.any():
            return around
        away = np.linalg.norm(self.points - self.coordinates[own].mean(axis=0), axis=1)
        return of & (away == away[of].min())

    def _dofs_of(self, nodes):
        """Degrees of freedom of nodes, (k, D)."""
        dofs, each = self._made_of[_NUMBERS]
        return np.asarray(dofs)[nodes] if dofs is not None else (each or self.dim) * nodes[:, None] + np.arange(self.dim)

    @functools.cached_property
    def face_lengths(self):
        """The length of the longest slave face at each node, between its nodes; 0 of others, (n,)."""
        lengths, kinds = np.zeros(self.node_count), {}
        for face in self.slave_faces:
            kinds.setdefault(len(face), []).append(face)
        for faces in map(np.array, kinds.values()):
            at = self.coordinates[faces]
            longest = np.linalg.norm(at[:, :, None] - at[:, None], axis=3).max(axis=(1, 2))
            np.maximum.at(lengths, faces, longest[:, None])
        return lengths

    @property
    def is_with_obstacle(self):
        """True for pairs with a rigid obstacle."""
        return isinstance(self._made_of[_SIDES][1], _Rigid)

    @property
    def _numbers_every_node_alike(self):
        """True if nodes have D degrees of freedom each, and no others."""
        dofs, each = self._made_of[_NUMBERS]
        return dofs is None and each in (0, None, self.dim)

    @property
    def _least(self):
        """Entries of a displacement vector that has the nodes of faces, whose displacements are asked."""
        asked = self.penetration.__self__  # pair_meshes asks all faces that were given
        nodes = np.concatenate([side.nodes for side in asked._made_of[_SIDES] if isinstance(side, _Faces)])
        return int(self._dofs_of(nodes).max(initial=-1)) + 1

    def _displacements(self, u):
        u = np.require(reals("u", u), np.float64, ["C", "ALIGNED"])
        if u.size < self._least:
            raise ValueError(f"u has the shape {u.shape}: give the displacements of all degrees of "
                             f"freedom, at least {self._least}; Model.extended adds those that equations give")
        return u

    def _of_nodes(self, u):
        """Displacements of all nodes, (n, D), 0 of those beyond the end of u."""
        return np.append(u, 0.0)[np.minimum(self._dofs_of(np.arange(self.node_count)), u.size)]

    def write(self, path, cells, result, u=None, *, slip0=None, gap=None):
        """Writes the mesh, displacements and fields to a file .vtu, which ParaView opens.

        cells: as for write_mesh.  u: displacements of all degrees of freedom, as Model.recover
        returns them, at least of the nodes of faces; other nodes beyond its end stay in their places.  slip0, gap: as
        for fields. Of one of the zones that cut a curved surface, traction and slip at the cut are turned to its own
        normals: result.contact.write of all zones has those of the pairs.
        """
        self._write(path, cells, self, result, u, slip0, gap)

    def _write(self, path, cells, of, result, u, slip0, gap):
        """Writes the mesh of SurfacePairs and the fields."""
        u = None if u is None else doubles(of._of_nodes(self._displacements(u)))
        gap, slip0, d, F, state = self._results(result, slip0, gap)
        zone = sized(Zone, contact=self._handle, gap=at(gap), slip0=at(slip0), d=at(d), F=at(F), state=at(state))
        moved = [] if u is None else [sized(NodalField, components=self.dim, name=b"displacement", values=at(u))]
        Cells(of.coordinates, cells).write(path, None, [zone], moved)

    def _results(self, result, slip0, gap):
        if not hasattr(result, "d"):
            raise TypeError(f"result is a {type(result).__name__}: give what Model.solve returned")
        pairs, dim = self.pairs, self.dim
        d, F = (components(name, getattr(result, name), pairs, dim) for name in ("d", "F"))
        slip0 = getattr(result, "slip0", None) if slip0 is None else slip0
        known = getattr(result, "gaps", None)
        if isinstance(known, dict):  # one zone has all of them
            known = next(iter(known.values())) if len(known) == 1 else None
        gap = next(one for one in (gap, known, self.gaps) if one is not None)
        return (
            per_pair("gap", gap, pairs, dim),
            components("slip0", slip0, pairs, dim, tangential=True, scalar=True, optional=True),
            d, F, np.require(result.state, np.int32, ["C", "ALIGNED"]),
        )

    def _do(self, function, *arguments):
        check(self._functions, getattr(self._functions, function)(self._handle, *arguments))


def frames_of(normals, tangents):
    """Normal, then tangents of each pair, (P, D, D)."""
    second = [np.cross(normals, tangents)] if normals.shape[1] == 3 else []
    return np.stack([normals, tangents, *second], axis=1)


class _Faces:
    """Faces of a surface; structure: signorini_faces."""

    def __init__(self, name, faces):
        if faces is None or hasattr(faces, "_fields"):
            given = "None" if faces is None else f"a {type(faces).__name__}"
            raise TypeError(f"{name} is {given}: give the nodes of each face; pair_obstacle takes an obstacle")
        if isinstance(faces, np.ndarray) and faces.ndim != 2:
            raise ValueError(f"{name} has the shape {faces.shape}: give the nodes of each face, "
                             f"shape (faces, nodes), or a list of lists")
        lists = [integers(f"{name}[{face}]", nodes).ravel() for face, nodes in enumerate(faces)]
        self.name, self.lists = name, lists
        self.start = indices(np.cumsum([0, *map(len, lists)]))
        self.nodes = indices(np.concatenate([np.zeros(0, np.int64), *lists]))
        self.structure = sized(Faces, count=len(lists), start=at(self.start), nodes=at(self.nodes))

    def __reduce__(self):
        return _Faces, (self.name, [self.nodes[begin:end] for begin, end in zip(self.start, self.start[1:])])


class _Rigid:
    """An obstacle; structure: signorini_obstacle."""

    def __init__(self, obstacle, dim):
        self.made_of = copy.deepcopy((obstacle, dim))
        if isinstance(obstacle, RigidFaces):
            self.coordinates = points(obstacle.coordinates).copy()
            self.faces = _Faces("faces", obstacle.faces)
            self.structure = sized(
                RigidObstacle, kind=Obstacle.FACES, nodes=len(self.coordinates),
                coordinates=at(self.coordinates),
                faces=ctypes.cast(ctypes.byref(self.faces.structure), address))
        else:
            self.structure = _shape(obstacle, dim)

    def __reduce__(self):
        return _Rigid, self.made_of


def _shape(obstacle, dim):
    """A shape in so many dimensions as signorini_obstacle."""
    def three(vector):
        vector = [float(x) for x in vector]
        if not dim <= len(vector) <= 3:
            raise ValueError(f"{obstacle!r} has a place or a direction of {len(vector)} numbers: give {dim}, as the nodes "
                             "have coordinates")
        return (real * 3)(*(vector + [0.0])[:3])

    if isinstance(obstacle, Plane):
        return sized(RigidObstacle, kind=Obstacle.PLANE, point=three(obstacle.point),
                     direction=three(obstacle.outward))
    if isinstance(obstacle, Sphere):
        return sized(RigidObstacle, kind=Obstacle.SPHERE, point=three(obstacle.centre),
                     radius=obstacle.radius, hollow=bool(obstacle.hollow))
    if isinstance(obstacle, Cylinder):
        return sized(RigidObstacle, kind=Obstacle.CYLINDER, point=three(obstacle.point),
                     direction=three(obstacle.axis), radius=obstacle.radius,
                     hollow=bool(obstacle.hollow))
    if isinstance(obstacle, Cone):
        return sized(RigidObstacle, kind=Obstacle.CONE, point=three(obstacle.point),
                     direction=three(obstacle.to_apex), radius=obstacle.radius,
                     hollow=bool(obstacle.hollow))
    if isinstance(obstacle, Torus):
        axis = reals("axis", obstacle.axis)
        if not 0 < np.linalg.norm(axis) < np.inf:
            raise ValueError(f"axis of a Torus is {axis}: give the direction across its ring, of any length but zero")
        if not obstacle.ring > 0:
            raise ValueError(f"ring of a Torus is {obstacle.ring}: give a positive radius")
        return sized(RigidObstacle, kind=Obstacle.TORUS, point=three(obstacle.centre),
                     direction=three(axis * (obstacle.ring / np.linalg.norm(axis))),
                     radius=obstacle.radius, hollow=bool(obstacle.hollow))
    raise TypeError(f"a {type(obstacle).__name__} is no shape: give a Plane, Sphere, Cylinder, Cone or Torus, or as an "
                    f"obstacle RigidFaces")


def _planes(symmetry, dim):
    """Directions across planes of symmetry, and their places."""
    try:
        planes = [(direction, float(place)) for direction, place in symmetry]
    except (TypeError, ValueError):
        raise TypeError(f"symmetry is {symmetry!r}: give a list of planes, for each the axis or the direction across it, and a "
                        "number, where it stands along that: [(0, 0.0)]") from None
    across, places = np.zeros((len(planes), dim)), np.array([place for _, place in planes])
    for k, (direction, _) in enumerate(planes):
        if np.ndim(direction):
            asked = f"the axis or the direction across it, shape {(dim,)}"
            across[k] = fit(f"symmetry[{k}]", direction, [(dim,)], asked)
        elif direction in range(dim):
            across[k, int(direction)] = 1.0
        else:
            raise ValueError(f"symmetry[{k}] names axis {direction}: give {' or '.join(map(str, range(dim)))}, or a "
                             f"direction, and where the plane stands")
    return doubles(across), doubles(places)
