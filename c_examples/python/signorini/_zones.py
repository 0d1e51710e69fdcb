"""Contact zones by name, in one model."""

import ctypes
import re
from collections import Counter

import numpy as np

from ._arrays import at, copied, fit, reals
from ._constants import Law
from ._law import Friction
from ._library import Owner, Remade, SignoriniError, check, library
from ._structures import ContactZone, SurfaceData, address, i64, real, sized
from ._surfaces import SurfacePairs, frames_of
from ._text import tell, zone_bytes


class Zone:
    """A contact zone with a law of its own, for Model.from_surfaces.

    contact: SurfacePairs.  mu, g, law, friction: as for solve, the numbers of one pair for all pairs of the zone.
    """

    def __init__(self, contact, mu=None, *, g=None, law=None, friction=None):
        _check("contact", contact)
        self.contact, self.friction = contact, Friction(mu, g, law, friction)

    def numbers(self, name):
        """The parameters of the law, an array; None if it has none."""
        asked = self.friction.law.numbers
        if not asked:
            return None
        found = np.ravel(reals(f"zones[{name!r}]: {self.friction.name}", self.friction.values))
        if found.size != asked:
            raise ValueError(f"zones[{name!r}]: {self.friction.name} has {found.size} numbers: give the {asked} of one "
                             "pair, for all pairs of the zone")
        return np.ascontiguousarray(found)


def _check(name, contact):
    if not isinstance(contact, SurfacePairs):
        raise TypeError(f"{name} is a {type(contact).__name__}: give what pair_surfaces or pair_obstacle returns")


def by_name(zones):
    """A list of (name, contact) as a dict."""
    try:
        count = Counter(name for name, _ in zones)
    except (TypeError, ValueError):
        raise TypeError("contact is a list of what has no names: give (name, SurfacePairs) for each zone") from None
    for name in count:
        if count[name] > 1:
            raise ValueError(f"two zones are named {name!r}: give each a name of its own")
    return dict(zones)


class Zones(Remade):
    """Pairs of several zones, one zone after the other; contacts: the SurfacePairs by name."""

    def __init__(self, contacts):
        if not contacts:
            raise ValueError("zones is empty: give at least one zone, its name and its SurfacePairs")
        self._made_of = (dict(contacts),)
        # Without a zone that has a law, the law of a case is that of all pairs.
        self.has_laws = any(isinstance(zone, Zone) for zone in contacts.values())
        for name, zone in contacts.items():
            zone_bytes(name)
            if not isinstance(zone, Zone):
                _check(f"zones[{name!r}]", zone)
        zones = {name: zone if isinstance(zone, Zone) else Zone(zone) for name, zone in contacts.items()}
        self.contacts = {name: zone.contact for name, zone in zones.items()}
        self._tied = [name for name, zone in zones.items() if zone.friction.law == Law.TIED]
        self._check_meshes()
        self._join(zones)

    def _check_meshes(self):
        """Refuses zones of different meshes of one size. Slave nodes may have been moved between two pairings."""
        (first, one), *others = self.contacts.items()
        for name, other in others:
            if other.coordinates.shape != one.coordinates.shape:
                continue
            differs = np.any(other.coordinates != one.coordinates, axis=1)
            differs[np.concatenate([np.zeros(0, int), *one.slave_faces, *other.slave_faces]).astype(int)] = False
            if differs.any():
                raise ValueError(f"zone {name!r} is of another mesh than zone {first!r}, as node {differs.argmax()} stands elsewhere: "
                                 "put all meshes into one, and pair parts of that by pair_surfaces")

    def __reduce__(self):
        return type(self), self._made_of

    def __getattr__(self, name):
        raise AttributeError(f"the pairs of several zones have no {name}: ask those of one, result.zone(name).contact")

    def warn_of_ties(self, law):
        """Warns of the zones that the law of a case unties."""
        if self._tied:
            tell(f"the law {law.name.lower()} of the case is that of all pairs, and unties {', '.join(map(repr, self._tied))}: "
                 "leave it out, so that each Zone has its own law, or give SurfacePairs in the place of a tied Zone")

    # Joined pairs are pairs for the library.
    with_equations, _do = SurfacePairs.with_equations, SurfacePairs._do
    _results, _write, _displacements = SurfacePairs._results, SurfacePairs._write, SurfacePairs._displacements

    def _join(self, zones):
        """The pairs of all zones as one object of the library."""
        functions, handle, data = library(), address(), sized(SurfaceData)
        numbers = [zone.numbers(name) for name, zone in zones.items()]
        given = (ContactZone * len(zones))(*[
            sized(ContactZone, law=zone.friction.law, contact=zone.contact._handle, name=zone_bytes(name), friction=at(own))
            for (name, zone), own in zip(zones.items(), numbers)])
        try:
            check(functions, functions.surface_join(len(zones), given, ctypes.byref(handle)))
        except SignoriniError as error:
            named = re.sub(r"zones (\d+)", lambda found: f"zones[{list(zones)[int(found[1])]!r}]", str(error))
            raise SignoriniError(named, error.status) from None
        self._functions, self._handle = functions, handle.value
        self._owner = Owner(functions.surface_free, self._handle)
        self._do("surface_view", ctypes.byref(data))
        self.summary, self.structure = data.summary.decode(), data.rows
        remark = re.search(r"\d+ nodes of such cuts are folded.*", self.summary)
        self.remark = remark and f"zones: {remark[0]}"

        def array(name, shape, kind=real):
            found = copied(getattr(data, name), shape, kind)
            return np.zeros(shape, kind) if found is None else found

        self.pairs, self.dim = pairs, dim = data.pairs, data.dim
        self.friction, self._paired_gaps = array("friction", (pairs, 4)), array("gaps", (pairs,))
        self._areas, self._normals = array("areas", (pairs,)), array("normals", (pairs, dim))
        self._frames = frames_of(self._normals, array("tangents", (pairs, dim)))
        starts = array("zone_start", (len(zones) + 1,), i64)
        self._find(array("nodes", (pairs,), i64), starts)

    def _find(self, nodes, starts):
        """Finds the joined pair of each zone's own pairs: where zones cut a smooth surface, that of an earlier zone."""
        self.places = {}
        for (name, contact), begin, end in zip(self.contacts.items(), starts, starts[1:]):
            is_own = np.isin(contact.nodes, nodes[begin:end])
            places = np.zeros(contact.pairs, np.int64)
            places[is_own] = np.arange(begin, end)
            for pair in np.flatnonzero(~is_own):
                earlier = np.flatnonzero(nodes[:begin] == contact.nodes[pair])
                places[pair] = earlier[(self._normals[earlier] @ contact.normals[pair]).argmax()]
            self.places[name] = places
        # The first zone that has a joined pair tells its numbers, but for its gap, which is the mean of all by area.
        self._of_own = np.concatenate(list(self.places.values()))
        self._first = np.unique(self._of_own, return_index=True)[1]
        self._shares = {name: self.contacts[name].areas / self._areas[place] for name, place in self.places.items()}

    def gaps(self):
        """The gaps of all pairs, from those of the zones' contacts."""
        return self.joined("gap", {name: contact.gaps for name, contact in self.contacts.items()})

    def joined(self, what, values, count=1):
        """Numbers for each pair, count of them, from those of each zone by name; other values as they are.

        A pair of several zones has the numbers of the first, but the mean of their gaps, by area, without infinite ones.
        slip0 of a zone counts along the tangents of its parts of results.
        """
        if not isinstance(values, dict):
            return values
        self._check(what, values)
        if what == "slip0":  # None of a zone: it has not slipped
            values = {name: np.zeros((self.contacts[name].pairs, count)) if slip is None else slip for name, slip in values.items()}
        parts = [self._part(f"{what}[{name!r}]", values[name], contact.pairs, count, count == 1 or what == "slip0")
                 for name, contact in self.contacts.items()]
        if what == "slip0":
            parts = [self._turned_back(name, part) for name, part in zip(self.contacts, parts)]
        own = np.concatenate(parts)
        found = own[self._first]
        return self._mean(own) if what == "gap" else found

    def _turned_back(self, name, slips):
        """Slips of a zone's pairs along the tangents of its parts, along those of joined pairs."""
        slips, shared = slips.reshape(-1, self.dim - 1).copy(), np.flatnonzero(self._shares[name] != 1)
        if len(shared):
            _, turn = self._leaning(self.contacts[name], shared, self._frames[self.places[name][shared]])
            slips[shared] = np.einsum("pij,pi->pj", turn, slips[shared])
        return slips

    def _mean(self, gaps):
        """The mean gap of each pair, by area: of the zones that have an obstacle there, which one with an infinite gap lacks."""
        shares = np.where(np.isinf(gaps) & (gaps > 0), 0.0, np.concatenate(list(self._shares.values())))
        sums, areas = np.zeros((2, self.pairs))
        np.add.at(sums, self._of_own, shares * np.where(shares > 0, gaps, 0.0))
        np.add.at(areas, self._of_own, shares)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(areas > 0, sums / areas, np.inf)

    @staticmethod
    def _part(name, values, pairs, count, scalar):
        """Numbers for each pair of a zone, (pairs,) or (pairs, count)."""
        shapes = [(pairs, 1), (pairs,)] if count == 1 else [(pairs * count,), (pairs, count)]
        one = "one number" if scalar else f"the {count} numbers of one pair"
        asked = (f"{one}, or those, shape {shapes[-1]}, of each of its {pairs} pairs; for cases that differ an array for the "
                 "pairs of all zones, one zone after the other")
        if values is not None and count > 1 and np.shape(values) == (count,):
            values = np.broadcast_to(reals(name, values), shapes[-1])
        return fit(name, values, shapes, asked, scalar=scalar)

    def _check(self, what, values):
        known = ", ".join(map(repr, self.contacts))
        for name in values:
            if name not in self.contacts:
                raise KeyError(f"{what} names the zone {name!r}, there is none: the zones are {known}")
        for name in self.contacts:
            if name not in values:
                raise KeyError(f"{what} lacks the zone {name!r}: give numbers for each of {known}")

    def of(self, result, name):
        """The part of a result that belongs to a zone.

        The force of a pair of several zones is shared by areas, so that each has the pressure, and its motion is that from
        the gap of the zone, so that each has the clearance. It keeps its normal; tangents are those of the zone's own pair.
        """
        if not isinstance(name, str):
            raise TypeError(f"zone is {name!r}: give the name of one zone")
        self._check("zone", {**dict.fromkeys(self.contacts), name: None})
        return self._of(result, name, self._all_gaps(result.gaps))

    def _of(self, result, name, all_gaps):
        """As of, with the gaps of all pairs."""
        place, contact = self.places[name], self.contacts[name]
        cut = ("d", "F", "state", "motion", "radius_d", "radius_F", "escape", "slip0")
        parts = {field: None if getattr(result, field) is None else getattr(result, field)[place] for field in cut}
        share = self._shares[name]
        shared, frames = np.flatnonzero(share != 1), None
        for field in ("F", "radius_F"):
            if parts[field] is not None:
                parts[field][shared] *= share[shared, None]
        if len(shared):
            frames, turn = self._leaning(contact, shared, self._frames[place[shared]])
            bounds = dict.fromkeys(("radius_d", "radius_F"), abs(turn))
            for field, by in {**dict.fromkeys(("d", "F", "motion", "escape"), turn), **bounds}.items():
                if parts[field] is not None:
                    parts[field][shared, 1:] = np.einsum("pij,pj->pi", by, parts[field][shared, 1:])
            if parts["slip0"] is not None:
                parts["slip0"][shared] = np.einsum("pij,pj->pi", turn, parts["slip0"][shared])
            with np.errstate(invalid="ignore"):
                lifted = self._own_gaps(name, result.gaps)[shared] - all_gaps[place[shared]]
            parts["d"][shared, 0] += np.where(np.isfinite(lifted), lifted, 0.0)  # infinite ones never touch
        second = result.second and self.of(result.second, name)
        gaps = None if result.gaps is None else self._own_gaps(name, result.gaps)
        return result._replace(contact=contact, second=second, frames=frames, gaps=gaps, **parts)

    def _kept_gaps(self, gap):
        """Copies of the gaps of a step, by zone."""
        return {name: self._own_gaps(name, gap).copy() for name in self.contacts}

    def _all_gaps(self, gap):
        """The gaps of all pairs in a step."""
        return self.gaps() if gap is None else np.broadcast_to(self.joined("gap", gap), (self.pairs,))

    def _own_gaps(self, name, gap):
        """The gaps of the pairs of a zone in a step."""
        contact = self.contacts[name]
        if gap is None:
            return contact.gaps
        if isinstance(gap, dict):
            return self._part(f"gap[{name!r}]", gap[name], contact.pairs, 1, True)
        return self._all_gaps(gap)[self.places[name]]

    @staticmethod
    def _leaning(contact, shared, joined):
        """Frames of a zone's pairs that lean to the normals of joined ones, and the turns of tangential parts to them."""
        normals, tangents = joined[:, 0], contact.tangents[shared]
        tangents = tangents - np.sum(normals * tangents, axis=1, keepdims=True) * normals
        tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
        frames = frames_of(contact.normals, contact.tangents)
        frames[shared] = frames_of(normals, tangents)
        return frames, np.einsum("pik,pjk->pij", frames[shared, 1:], joined[:, 1:])

    def write(self, path, cells, result, u=None, *, slip0=None, gap=None):
        """Writes the mesh of the zones with the fields of all to one file; see SurfacePairs.write.

        slip0, gap: those of the step, in arrays for all pairs or dicts by the names of zones; None: those of result.
        """
        gap = self._all_gaps(result.gaps if gap is None else gap)
        first = next(iter(self.contacts.values()))
        self._write(path, cells, first, result, u, self.joined("slip0", slip0, self.dim - 1), gap)

    def penetration(self, u):
        """The deepest Penetration of all zones, or None."""
        return _deepest(contact.penetration(u) for contact in self.contacts.values())

    def _passed(self, u, larger):
        """The deepest Penetration of those zones where gaps of a case, larger than those of the pairing by so much, let none pass."""
        return _deepest(contact._passed(u, larger[self.places[name]], 0.0 if contact.pairs else self._beside(contact, larger))
                        for name, contact in self.contacts.items())

    def _beside(self, contact, larger):
        """The largest finite number of the pairs of zones that share nodes with a contact."""
        places = [self.places[name] for name, other in self.contacts.items() if contact._touches(other)]
        found = larger[np.concatenate(places)]
        return found[np.isfinite(found)].max(initial=0.0)

    @property
    def _least(self):
        """Entries of a displacement vector that has the nodes of faces of all zones."""
        return max(contact._least for contact in self.contacts.values())

    def table(self, result):
        """A ZoneSums for each zone."""
        alone, gaps = result._replace(second=None), self._all_gaps(result.gaps)
        return [row for name, contact in self.contacts.items() for row in contact.table(self._of(alone, name, gaps), name)]


def _deepest(found):
    """The deepest of penetrations, each of which may be None."""
    return max(filter(None, found), key=lambda one: one.depth, default=None)
