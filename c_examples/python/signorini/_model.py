"""Models: a structure reduced to its contact pairs."""

import contextlib
import copy
import ctypes
import warnings
from collections import namedtuple

import numpy as np

from ._arrays import (at, components, copied, fit, indices, integers, pairs_of, per_pair, reals,
                      stiffness)
from ._call import NAMES, OF_MODELS, Call
from ._constants import START_PREVIOUS, Law, ModelKind, Status, member
from ._equations import Equations
from ._law import Friction
from ._library import Owner, Remade, SignoriniError, check, library
from ._meshes import check_owners, pair_meshes
from ._operator import HostFunctions
from ._results import Enclosure, Output, Result, certified
from ._sparse import ContactPairs, Matrix, entries_of, is_sparse, side_by_side, supports
from ._structures import ModelData, address, sized
from ._surfaces import SurfacePairs
from ._symmetry import (warn_of_facets, warn_of_gaps, warn_of_nodes_beside, warn_of_numbers, warn_of_overlaps, warn_of_planes,
                        warn_of_repeats, warn_of_rings, warn_of_slips, warn_of_supports)
from ._text import path_bytes, remark_bytes, tell
from ._zones import Zones, by_name

_UNTOUCHED = np.iinfo(np.int32).min
_AT_ONCE = 32  # cases whose displacements of the host are there at a time
_LOADS_OF_THE_CASE = object()  # what recover is given where its caller forgot f
_NO_STIFFNESS = {
    ModelKind.STIFFNESS: "the rows of pairs ({dependent} of them) follow from those of other pairs or from supports",
    ModelKind.FULL_SPACE: "the model is solved in full space",
    ModelKind.OPERATOR: "the model has products of the host",
    ModelKind.FLEXIBILITY: "the model has a flexibility",
}


class Case(namedtuple("Case", "f prescribed gap law friction slip0")):
    """Loads and data of one case or several, in the library's layout."""

    __slots__ = ()

    def arguments(self):
        return [self.law if name == "law" else at(value) for name, value in
                zip(self._fields, self)]

    def of(self, case):
        """One of several cases."""
        return Case(*[value if name == "law" or value is None else value[case]
                       for name, value in zip(self._fields, self)])


def _given(f):
    """The loads that a caller gave; None is none."""
    if f is _LOADS_OF_THE_CASE:
        raise TypeError("f is missing: give the loads with which d was solved, or None for "
                        "displacements without loads, such as result.escape")
    return f


def _held(fixed, equations):
    """What supports hold, and what follows from that by equations."""
    return fixed if equations is None else Equations(equations).held(fixed)


def flexibility(W, triangle):
    """W of a problem in flexibility form: an array by columns, or a Matrix."""
    return Matrix(W, triangle, name="W") if is_sparse(W) else stiffness("W", W)


class Model(Remade):
    """A structure reduced to its contact pairs, for any number of load cases.

    Made by Model.condensed, Model.two_body, Model.flexibility, Model.sparse, Model.from_surfaces,
    Model.from_meshes or Model.operator.
    dim, pairs: D and P.  host_size: H, the entries of a load or displacement vector of the host.
    kind: a ModelKind.  memory: most bytes that a load case may take beside the model.
    dependent: number of pairs whose rows follow from those of other pairs or from supports. Where most do, as where a
    rigid body is the finer side, a solve takes long: let the other side be the slave.
    contact: the SurfacePairs of which it was made, by name if these were several, or None.
    A model can be pickled, unless it is one of functions of the host: another process makes it again of the same
    matrix, pairs and settings, and its results have the same bits. It keeps copies of these for that, but of a condensed K.
    """

    def __init__(self, make, *arguments, settings=None):
        self._functions, self.contact, self._zones, self._equations = library(), None, None, None
        self._host, self._made_of = contextlib.nullcontext(), None
        handle = address()
        function = getattr(self._functions, make)
        if settings is None:
            check(self._functions, function(*arguments, ctypes.byref(handle)))
        else:
            call = Call(self._functions, settings, names=OF_MODELS)
            status, message = call.run(function, *arguments, call.at(), ctypes.byref(handle))
            if status != 0:
                raise SignoriniError(message, member(Status, status))
        self._handle, self._data = handle.value, sized(ModelData)
        self._owner = Owner(self._functions.model_free, self._handle)
        self._do("model_view", ctypes.byref(self._data))
        self.dim, self.pairs = self._data.dim, self._data.pairs
        self.host_size, self._n_fixed, self.dependent = self._data.host_size, self._data.fixed, self._data.dependent
        self.kind, self.memory = member(ModelKind, self._data.kind), self._data.memory
        # The host's vectors are those of the pairs, but for two bodies and of a whole matrix.
        is_pairwise = make not in ("model_new_two_body", "model_new_sparse")
        pairwise = [(self.pairs, self.dim)] if is_pairwise else []
        self._host_shapes = [*pairwise, (self.host_size,)]
        # A load of the other dimension, to say so: its rows are as long as that dimension.
        other = 5 - self.dim
        self._elsewhere = lambda shape: (
            other if pairwise and shape == (self.host_size // other, other) else None
        )

    def _remember(self, make, *given, settings, contacts=(), **named):
        """Keeps what made the model, but not what watches the making; its contacts stay the same objects."""
        settings = {name: value for name, value in settings.items() if name not in ("progress", "time_limit")}
        memo = {id(one): one for one in contacts}
        self._made_of = (make, *copy.deepcopy((given, {**named, **settings}), memo))
        return self

    def __reduce__(self):
        if self._made_of is None:
            raise TypeError("a model of functions of the host belongs to this process, and can be neither pickled nor copied "
                            "deeply: make it again from what its functions use")
        make, given, named = self._made_of
        # The library has K already.
        given = (self.stiffness,) if make == "condensed" else given
        return _made_again, (type(self), make, given, named)

    @classmethod
    def condensed(cls, K, *, dim=2, **settings):
        """One body on an obstacle. K: condensed stiffness, (N, N). H = N.

        settings: progress, time_limit (seconds), memory_limit (bytes) and threads; a limit that is
        passed, or a progress function that cancels, raises SignoriniError.
        """
        K = stiffness("K", K)
        pairs = pairs_of("K", K, dim)
        model = cls("model_new_condensed", dim, pairs, at(K), max(1, len(K)), settings=settings)
        return model._remember("condensed", dim=dim, settings=settings)

    @classmethod
    def two_body(cls, K_A, K_B, *, dim=2, **settings):
        """Two bodies on matching contact nodes, each in its own outward frame; d = u_A + u_B.

        K_A, K_B: condensed stiffness, (N, N) each. Loads and displacements are [A; B], H = 2 N.
        settings: as for condensed.
        """
        K_A, K_B = stiffness("K_A", K_A), stiffness("K_B", K_B)
        pairs = pairs_of("K_A", K_A, dim)
        if K_B.shape != K_A.shape:
            raise ValueError(f"K_B has the shape {K_B.shape}: give the shape of K_A, {K_A.shape}")
        size = max(1, len(K_A))
        model = cls("model_new_two_body", dim, pairs, at(K_A), size, at(K_B), size,
                    settings=settings)
        return model._remember("two_body", K_A, K_B, dim=dim, settings=settings)

    @classmethod
    def flexibility(cls, W, *, dim=2, triangle="full"):
        """A flexibility: d = W F + q. W, triangle: as for solve_flexibility. H = N.

        The f of a load case are its free displacements q, and start is a force to start from. d does
        not determine F: certify is given both.
        """
        W = W if isinstance(W, Matrix) else flexibility(W, triangle)
        pairs = pairs_of("W", W, dim)
        if isinstance(W, Matrix):
            model = cls("model_new_flexibility_sparse", dim, pairs, ctypes.byref(W.structure))
            triangle = W.structure.triangle
        else:
            model = cls("model_new_flexibility", dim, pairs, at(W), max(1, len(W)))
        given = W.given() if isinstance(W, Matrix) else W
        return model._remember("flexibility", given, dim=dim, triangle=triangle, settings={})

    @classmethod
    def operator(cls, dim, pairs, stiffness, inverse=None, *, held=None, units=None,
                 accuracy=0.0):
        """Products and solutions of the host alone: no matrix is formed. H = N.

        stiffness(x): K_rel x, N.  inverse(x): W x, N, with W close to the inverse of K_rel; may be
        None if held is given.  held(mask, changed, x): y of N entries that is 0 where mask is True,
        and K_rel y = x in the others; changed tells whether mask is another one than before.
        units: force per length of the components, N; None: from products.  accuracy: what the
        answers agree to, relative to their sizes; 0: 1e-9.
        What one of the functions raises, the call of the model raises.
        """
        return cls._of_host(HostFunctions(dim, pairs, units, stiffness=stiffness, inverse=inverse,
                                          held=held, accuracy=accuracy))

    @classmethod
    def preconditioned(cls, product, precondition, place, units):
        """Products and a preconditioner on all unknowns of the host, H of them; d are some of these.

        product(x): A x, H.  precondition(mask, springs, changed, r): z of H entries near the
        solution of A z = r, where components of d in mask, N, are held and springs, (P, D-1, D-1),
        are added to A between the tangents of each pair; no accuracy is asked. changed tells
        whether mask or springs are others than before.  place: the unknowns that are the
        components of d, (P, D).  units: of the size of the diagonal of A, H.
        What one of the functions raises, the call of the model raises.
        """
        place = indices(integers("place", place))
        if place.ndim != 2 or place.shape[1] not in (2, 3):
            raise ValueError(f"place has the shape {place.shape}: give (P, 2) or (P, 3)")
        return cls._of_host(HostFunctions(place.shape[1], len(place), units, place=place,
                                          stiffness=product, precondition=precondition))

    @classmethod
    def _of_host(cls, host):
        with host:
            model = cls("model_new_operator", ctypes.byref(host.structure))
        model._host = host
        return model

    @classmethod
    def sparse(cls, K, slaves=None, normals=None, *, fixed=(), masters=None, weights=None,
               tangents=None, rows=None, equations=None, triangle="full", order=None, **settings):
        """The whole stiffness matrix of the host, without supports, and contact pairs.

        K: a scipy.sparse matrix, or (data, indices, indptr) by columns, rows ascending; counted
        from 0, as all degrees of freedom (dof) here.  triangle: which entries K holds, "full",
        "lower" or "upper".  slaves: dof numbers of each slave node, (P, D).  normals: outward from
        the slave's body, of any length, (P, D), or one for all.  fixed: dof numbers of the
        supports.
        masters: for each pair the dof numbers of its master nodes, (k, D), none of them for a rigid
        obstacle; None: rigid obstacles.  weights: for each pair those of its masters, k, of sum 1;
        None: 1, of one master each.
        tangents: first tangent of each pair, orthogonal to its normal, (P, D), or one for all; None:
        chosen, in 2D the normal turned by +90 degrees. frames gives what the model uses.
        rows: in the place of slaves, masters and weights, for each pair (dofs, weights): the dof
        numbers of all its nodes, (k, D), and k signed weights, positive on the side whose normal is
        given; of sum 0, and 1 against a rigid obstacle. Nodes may stand in any number of pairs. Or
        (dofs, vectors): k dof numbers, and a vector of D numbers for each, (k, D).
        equations: (dependent, dofs, coefficients) for each, u[dependent] = coefficients @ u[dofs], in any order.
        Pairs may name dependents; one that K has is eliminated, others have any number. See
        turned_equations, rigid_equations and read_equations.
        order: order of elimination, each dof number once; None: chosen.  settings: progress,
        time_limit (seconds), memory_limit (bytes), threads and full_space; a limit that is passed,
        or a progress function that cancels, raises SignoriniError. With full_space, or if the
        condensed model needs more than memory_limit, none is made: there is no stiffness then.
        """
        matrix, fixed = Matrix(K, triangle, order), supports(fixed)
        pairs = ContactPairs(slaves, normals, masters, weights, tangents, rows, equations)
        model = cls("model_new_sparse", ctypes.byref(matrix.structure), len(fixed), at(fixed),
                    ctypes.byref(pairs.structure), settings=settings)
        return model._remember(
            "sparse", matrix.given(), slaves, normals, fixed=fixed, masters=masters, weights=weights, tangents=tangents,
            rows=rows, equations=pairs.equations and pairs.equations.given(), triangle=triangle, order=order,
            settings=settings)

    @classmethod
    def from_surfaces(cls, K, contact, *, fixed=(), equations=None, triangle="full", order=None, **settings):
        """The whole stiffness matrix of the host with the pairs of pair_surfaces or pair_obstacle.

        K, fixed, equations, triangle, order, settings: as for sparse.  contact: SurfacePairs; of an axisymmetric one K and
        the loads are those of whole rings. The gap of a load case is contact.gaps, if it is not given.
        Several zones: contact is a dict of SurfacePairs by name, {"bolt": ..., "flange": ...}, or a list of (name, SurfacePairs),
        of which a name that stands twice is refused: a dict has the last of them alone. A node may be slave in one zone and
        master in another; zones that cut a smooth surface have one pair for a node of the cut, with the numbers of the first
        of them and the mean of the gaps, by area. A Zone in the place of SurfacePairs has a law of its own, which a case
        without a law of its own takes; law="frictionless" is one. gap, mu, g, friction and slip0 of a case may then be a dict
        too, with the numbers of each zone; Result.zone gives the part of a zone and Result.table all of them.
        """
        contact = by_name(contact) if isinstance(contact, (list, tuple)) else contact
        zones = Zones(contact) if isinstance(contact, dict) else None
        if zones is None and not isinstance(contact, SurfacePairs):
            raise TypeError(f"contact is a {type(contact).__name__}: give what pair_surfaces or "
                            f"pair_obstacle returns, or a dict or a list of them with the names of zones")
        matrix, fixed = Matrix(K, triangle, order), supports(fixed)
        if zones and zones.remark:
            tell(zones.remark)
        contacts, held = zones.contacts if zones else {None: contact}, _held(fixed, equations)
        for name, one in contacts.items():
            warn_of_planes(one, fixed, name)
            warn_of_supports(one, held, name)
            warn_of_nodes_beside(one, name)
            warn_of_numbers(one, matrix, name)
            warn_of_overlaps(one, name)
            if not one.pairs or "all slave faces look away" in one.summary:
                tell((f"zone {name!r}: " if name else "") + one.summary)
        for name, one in list(contacts.items())[:1]:  # zones are alike
            warn_of_rings(one, matrix, equations is not None, name)
            zone = f"zone {name!r}: " if name else ""
            if one.is_sector and equations is None:
                tell(f"{zone}pairs of a Sector without equations, which hold its boundaries together: give "
                     "equations=sector_equations(coordinates, sector), or those of your own")
        rows = (zones or contact).with_equations(equations)
        if equations is not None:
            warn_of_repeats(contacts, rows.equations)
        model = cls("model_new_sparse", ctypes.byref(matrix.structure), len(fixed), at(fixed),
                    ctypes.byref(rows.structure), settings=settings)
        model.contact, model._zones, model._equations = contact, zones, getattr(rows, "equations", None)
        return model._remember(
            "from_surfaces", matrix.given(), contact, fixed=fixed,
            equations=model._equations and model._equations.given(), triangle=triangle, order=order, settings=settings,
            contacts=zones.contacts.values() if zones else [contact])

    @classmethod
    def from_meshes(cls, K, slave, master, *, slave_faces=None, master_faces=None, fixed=(),
                    triangle="full", settings=None, **pairing):
        """The whole stiffness matrix of the host, with pairs from two meshes that may touch.

        K: as for sparse, or two matrices, of the slave's and of the master's mesh. Degrees of
        freedom are those of the slave's nodes, then those of the master's.  fixed, triangle: as for
        sparse.
        settings: a dict of those of sparse, such as {"full_space": True} or {"equations": ...}.
        slave, master, slave_faces, master_faces and the rest: as for pair_meshes.
        """
        misplaced = [name for name in pairing if name in (*NAMES, "progress", "equations", "order")]
        if misplaced:
            raise TypeError(f"{misplaced[0]} is a setting of the model: give settings={{{misplaced[0]!r}: ...}}")
        if isinstance(K, (tuple, list)) and any(hasattr(one, "tocsc") for one in K) and len(K) != 2:
            raise ValueError(f"K is {len(K)} matrices: give one of all nodes, or two, of the slave's mesh and the master's")
        held = _held(supports(fixed), (settings or {}).get("equations"))
        contact = pair_meshes(slave, master, slave_faces=slave_faces, master_faces=master_faces, fixed=held, **pairing)
        parts = K if isinstance(K, (tuple, list)) and len(K) == 2 else [K]
        check_owners(parts, triangle, slave, master, pairing)
        K = side_by_side(parts) if len(parts) == 2 else K
        return cls.from_surfaces(K, contact, fixed=fixed, triangle=triangle, **(settings or {}))

    @property
    def stiffness(self):
        """K_rel, the stiffness in relative displacements, (N, N)."""
        size = self.dim * self.pairs
        K = copied(self._data.K, (size, size))
        if K is None and size:
            why = _NO_STIFFNESS[self.kind].format(dependent=self.dependent)
            raise SignoriniError(f"there is no stiffness: {why}", -1)
        return np.zeros((0, 0)) if K is None else K.T

    @property
    def frames(self):
        """Normal, then tangents of each pair in the axes of the host, (P, D, D), of unit length.

        numpy.einsum("pi,pij->pj", result.F, model.frames) are the forces in these axes. A model
        that the host condensed in frames of its own raises SignoriniError.
        """
        frames = copied(self._data.frames, (self.pairs, self.dim, self.dim))
        if frames is None and self.pairs:
            raise SignoriniError("the frames are not known: the host condensed in its own", -1)
        return np.zeros((0, self.dim, self.dim)) if frames is None else frames

    def condensed_load(self, f, prescribed=None):
        """Loads of a case on the relative displacements, (P, D). f, prescribed: as for solve."""
        load = np.zeros((self.pairs, self.dim))
        f, prescribed = self._loads(f, prescribed)
        self._do("model_condensed_load", at(f), at(prescribed), at(load))
        return load

    def solve(self, f, gap=None, mu=None, *, g=None, law=None, friction=None, slip0=None,
              prescribed=None, start=None, penetration=True, **settings):
        """Solves a load case, f of H entries: a Result; or several, f of (C, H): a list of them.

        gap, mu, g, law, friction, slip0, start: as for the function solve; gap None: those of
        contact.  prescribed: values of the fixed degrees of freedom, or one for all; None: zero.
        With several cases each may have a leading axis of C, or be the same for all. A case that is
        wrong does not stop the others: its status is negative, its numbers are NaN, its state is -1
        and its report None. start="previous": each case starts from the one before.
        penetration: with pairs from surfaces, look if parts without a pair, or whose pairs slide far, have passed through: a
        warning, and Result.penetration. Where gap is larger than that of the pairing by some length, at pairs around the
        deepest place of a zone, less than twice that is none.
        """
        f = reals("f", f)
        cases = len(f) if f.ndim == 2 and f.shape[1] == self.host_size else None
        data = self._case(f, gap, Friction(mu, g, law, friction), slip0, prescribed, cases)
        warm = START_PREVIOUS if isinstance(start, str) and start == "previous" else None
        start = components("start", None if warm else start, self.pairs, self.dim, cases=cases,
                           optional=True)
        call = Call(self._functions, settings, warm or start is not None)
        count = 1 if cases is None else cases
        output = Output(count, self.pairs, self.dim, start)
        if start is not None and self.kind == ModelKind.FLEXIBILITY:
            output.F[:] = output.d
        status = np.full(count, _UNTOUCHED, np.int32)
        with self._host:
            first, message = call.run(
                self._functions.model_solve, self._handle, count, *data.arguments(), call.at(),
                *output.solution(), at(status), *output.more(),
            )
        if first < 0 and (cases is None or _UNTOUCHED in status):
            raise SignoriniError(message.removeprefix("case 0: "), member(Status, first))
        tolerance, results, told = call.settings.tolerance, [], False
        for c, code in enumerate(member(Status, value) for value in status):
            words = self._functions.status_string(code).decode()
            if (code != 0 or cases is None) and not told:  # the library's sentence is of the first of them
                words, told = message.removeprefix(f"case {c}: ") or words, True
            case = data if cases is None else data.of(c)
            result = output.result(c, code, words, lambda d, case=case: self.certify_case(case, d, tolerance))
            results.append(self._of_case(result, case, gap))
        self._warn_of_slips(results)
        if penetration and self.contact:
            results = self._with_penetration(data, results, cases is None)
        return results[0] if cases is None else results

    def with_contact(self, result):
        """A result of this model that was unpickled or copied, with the contact of the model again, for zone, table and plot."""
        if not isinstance(result, Result):
            raise TypeError(f"result is a {type(result).__name__}: give one Result, of several cases each by itself")
        if np.shape(result.d) != (self.pairs, self.dim):
            raise ValueError(f"result.d has the shape {np.shape(result.d)}: give a result of this model, {(self.pairs, self.dim)}")
        second = result.second and self.with_contact(result.second)
        return result._replace(contact=self._zones or self.contact, second=second)

    def _of_case(self, result, case, gap):
        """A result with its contact and with the slip0 and the gap, as a caller gave it, of its case."""
        if not self.contact:
            return result
        gaps = None if gap is None else self._zones._kept_gaps(gap) if isinstance(gap, dict) else case.gap.copy()
        slip0 = None if case.slip0 is None else case.slip0.reshape(self.pairs, self.dim - 1).copy()
        second = result.second and self._of_case(result.second, case, gap)
        return result._replace(contact=self._zones or self.contact, second=second, gaps=gaps, slip0=slip0)

    def _contacts(self):
        """The contacts with their names and the places of their pairs."""
        if self._zones:
            return [(name, one, self._zones.places[name]) for name, one in self._zones.contacts.items()]
        return [(None, self.contact, slice(None))] if self.contact else []

    def _warn_of_slips(self, results):
        """Warns of pairs that slip by more than their face in one of the solutions."""
        solved = [result for result in results if result.status == Status.SOLVED]
        for name, contact, place in self._contacts():
            for result in solved:
                warn_of_slips(contact, result.d[place], result.state[place], name)

    def _with_penetration(self, data, results, is_alone):
        """Results with what has passed through without a pair in solutions, of which it warns."""
        solved = [c for c, result in enumerate(results) if result.status == Status.SOLVED]
        for begin in range(0, len(solved), _AT_ONCE):
            each = solved[begin:begin + _AT_ONCE]
            f, prescribed, gaps = (value if value is None else (value[None] if is_alone else value)[each]
                                   for value in (data.f, data.prescribed, data.gap))
            d, u = np.stack([results[c].d for c in each]), np.zeros((len(each), self.host_size))
            self._do("model_recover", len(each), at(f), at(prescribed), at(d), at(u))
            for c, own, gap in zip(each, u, gaps):
                results[c] = results[c]._replace(penetration=self._penetration(own, gap))
        return results

    def _penetration(self, u, gap):
        """What has passed through without a pair, of which it warns."""
        contact = self._zones or self.contact
        least = contact._least
        u = self._equations.extended(u, least) if self._equations else u
        # A node of a face without a pair may be held by the host, which has no rows for it.
        u = np.concatenate([u, np.zeros(max(0, least - u.size))])
        found = contact._passed(u, gap - contact._paired_gaps)
        if found:
            tell(found.sentence)
        return found

    def certify(self, f, gap, mu=None, *, d, F=None, g=None, law=None, friction=None, slip0=None,
                prescribed=None, tolerance=1e-10):
        """Measures relative displacements d, N, on the data of one case of solve; see certify.

        F: the forces, N, where d does not determine them: of a model in flexibility form, and where
        the rows of pairs follow from those of others. Elsewhere it is not looked at.
        """
        case = self._case(f, gap, Friction(mu, g, law, friction), slip0, prescribed)
        F = components("F", F, self.pairs, self.dim, optional=True)
        if F is None and (self.kind == ModelKind.FLEXIBILITY or self.dependent):
            raise TypeError("F is None: give the forces too, d does not determine them")
        found = self.certify_case(case, components("d", d, self.pairs, self.dim), tolerance, F)
        return self._of_case(found, case, gap)

    def prove(self, f, gap, mu=None, *, d, state=None, g=None, law=None, friction=None, slip0=None,
              prescribed=None):
        """Proves that a solution exists next to d, N, on the data of one case of solve; see prove."""
        case = self._case(f, gap, Friction(mu, g, law, friction), slip0, prescribed)
        return self.prove_case(case, components("d", d, self.pairs, self.dim), state)

    def write(self, path, f, gap, mu=None, *, g=None, law=None, friction=None, slip0=None,
              prescribed=None, remark=None):
        """Writes the condensed problem of one case of solve to a file; see write."""
        case = self._case(f, gap, Friction(mu, g, law, friction), slip0, prescribed)
        self._do("model_write", path_bytes(path), *case.arguments(), remark_bytes(remark))

    def recover(self, d, f=_LOADS_OF_THE_CASE, prescribed=None):
        """Displacements of the host, H, of one case: from its d, N, its loads f and its supports.

        f is that of the case; None for displacements without loads, such as result.escape.
        """
        f, prescribed = self._loads(_given(f), prescribed, optional=True)
        d = components("d", d, self.pairs, self.dim)
        u = np.zeros(self.host_size)
        self._do("model_recover", 1, at(f), at(prescribed), at(d), at(u))
        return u

    def extended(self, u):
        """Displacements of the host, H, with those behind them that equations of from_surfaces give to degrees of freedom
        without a row of K: as SurfacePairs.penetration and write take them."""
        u = reals("u", u)
        return self._equations.extended(u) if self._equations else u

    def recover_cases(self, d, f=_LOADS_OF_THE_CASE, prescribed=None):
        """Displacements of the host of many cases at once, (C, H): from d of (C, P, D) or (C, N).

        f and prescribed may have a leading axis of C, or be the same for all cases. f may be None, as in
        recover.
        """
        cases = len(d)
        f, prescribed = self._loads(_given(f), prescribed, cases, optional=True)
        d = components("d", d, self.pairs, self.dim, cases=cases)
        u = np.zeros((cases, self.host_size))
        self._do("model_recover", cases, at(f), at(prescribed), at(d), at(u))
        return u

    def nodal_forces(self, F):
        """Contact forces F, N, as a nodal force vector of the host, H."""
        F = components("F", F, self.pairs, self.dim)
        nodal = np.zeros(self.host_size)
        self._do("model_nodal_forces", at(F), at(nodal))
        return nodal

    def reactions(self, result, f=_LOADS_OF_THE_CASE, prescribed=None):
        """Forces of the supports on the bodies, one for each of fixed, of one case.

        result: what solve returned.  f, prescribed: as for recover. They are K u - f - nodal_forces(F), with what equations
        bring from the degrees of freedom that depend on a fixed one: that of the fixed shortening of a section is the section's
        force, positive if it pulls, that of a held reference point the force on the whole rigid body.
        """
        make, given, named = self._made_of or (None, (), {})
        if make not in ("sparse", "from_surfaces"):
            raise TypeError("the model has no matrix of the host: its reactions are K u - f - nodal_forces(F) at the fixed degrees "
                            "of freedom, with K of the host")
        data, rows, columns = entries_of(given[0], named["triangle"])
        u = self.recover(result.d, f, prescribed)
        forces = np.bincount(rows, data * u[columns], self.host_size) - self.nodal_forces(result.F)
        if f is not None:
            forces -= np.ravel(reals("f", f))
        equations = named["equations"] and Equations(named["equations"])
        forces = equations.gathered(forces) if equations else forces
        return forces[np.asarray(named["fixed"], int)]

    def _loads(self, f, prescribed, cases=None, optional=False):
        """f and prescribed in the library's layout."""
        shapes, n_fixed = self._host_shapes, self._n_fixed
        asked = "one load for each degree of freedom of the host, shape "
        asked += " or ".join(str(shape) for shape in reversed(shapes))
        f = fit("f", f, shapes, asked, cases=cases, optional=optional, elsewhere=self._elsewhere)
        asked = (f"one value for each of the {n_fixed} fixed degrees of freedom, shape "
                 f"{(n_fixed,)}, or one for all")
        prescribed = fit("prescribed", prescribed, [(n_fixed,)], asked, cases=cases, scalar=True,
                         optional=True)
        return f, prescribed

    def _case(self, f, gap, friction, slip0, prescribed, cases=None):
        f, prescribed = self._loads(f, prescribed, cases)
        if self._zones is not None:
            gap = self._zones.gaps() if gap is None else self._zones.joined("gap", gap)
            slip0 = self._zones.joined("slip0", slip0, self.dim - 1)
            friction.values = self._zones.joined(friction.name, friction.values, friction.law.numbers)
            if self._zones.has_laws and not friction.is_given:
                friction = Friction(None, None, Law.BY_PAIR, self._zones.friction)
            elif friction.law not in (Law.TIED, Law.BY_PAIR):
                self._zones.warn_of_ties(friction.law)
        elif gap is None and self.contact is not None:
            gap = self.contact.gaps
        gap = per_pair("gap", gap, self.pairs, self.dim, cases)
        if self.contact is not None and (gap == (self._zones or self.contact)._paired_gaps).all(axis=-1).any():
            for name, one, _ in self._contacts():
                warn_of_facets(one, name)
        for name, one, place in self._contacts():
            warn_of_gaps(one, gap[..., place], name)
        return Case(
            f, prescribed, gap, friction.law,
            friction.numbers(self.pairs, self.dim, cases),
            components("slip0", slip0, self.pairs, self.dim, tangential=True, cases=cases,
                       scalar=True, optional=True),
        )

    def certify_case(self, case, d, tolerance, F=None):
        """Result of certify, of a Case and d in the library's layout."""
        with self._host:
            return certified(self._functions, [self._handle, *case.arguments()], tolerance, d.copy(), F)

    def prove_case(self, case, d, state):
        """Result of prove, of a Case and d in the library's layout."""
        if state is not None:
            state = np.ascontiguousarray(state, np.int32)
            if state.shape != (self.pairs,):
                raise ValueError(f"state has the shape {state.shape}, it must be ({self.pairs},)")
        F, radius_d, radius_F = (np.zeros_like(d) for _ in range(3))
        status = self._do("model_prove", *case.arguments(), at(d), at(state), at(F), at(radius_d),
                          at(radius_F))
        return Enclosure(F, radius_d, radius_F) if status == Status.SOLVED else None

    def _do(self, function, *arguments):
        with self._host:
            called = getattr(self._functions, function)
            return check(self._functions, called(self._handle, *arguments))[0]


def _made_again(kind, make, given, named):
    """A model of what it was made of; what was warned of then is known."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return getattr(kind, make)(*given, **named)
