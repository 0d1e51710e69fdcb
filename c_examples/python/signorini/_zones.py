"""Contact zones by name, in one model."""

import ctypes
from collections import namedtuple

import numpy as np

from ._arrays import at, copied, reals
from ._constants import State
from ._law import Friction
from ._library import Owner, Remade, check, library
from ._structures import ContactZone, SurfaceData, address, i64, real, sized
from ._surfaces import SurfacePairs, write_zones

ZoneSums = namedtuple("ZoneSums", "zone pairs open slip stick pressed_area force")
ZoneSums.__doc__ = """A row of Result.table().

zone: its name.  pairs: how many; open, slip, stick: of them in each state.  pressed_area: of the pairs that
press.  force: of the contact on the slave's body, (3,).
"""


class Zone:
    """A contact zone with a law of its own, for Model.from_surfaces.

    contact: SurfacePairs.  mu, g, law, friction: as for solve, the numbers of one pair for all pairs of the zone.
    """

    def __init__(self, contact, mu=None, *, g=None, law=None, friction=None):
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


class Zones(Remade):
    """Pairs of several zones, one zone after the other; contacts: the SurfacePairs by name."""

    def __init__(self, contacts):
        if not contacts:
            raise ValueError("zones is empty: give at least one zone, its name and its SurfacePairs")
        self._made_of = (dict(contacts),)
        # Without a zone that has a law, the law of a case is that of all pairs.
        self.has_laws = any(isinstance(zone, Zone) for zone in contacts.values())
        zones = {name: zone if isinstance(zone, Zone) else Zone(zone) for name, zone in contacts.items()}
        self.contacts = {name: zone.contact for name, zone in zones.items()}
        for name, contact in self.contacts.items():
            if not isinstance(name, str):
                raise TypeError(f"zones names a zone {name!r}: give a text as its name")
            if not isinstance(contact, SurfacePairs):
                raise TypeError(f"zones[{name!r}] is a {type(contact).__name__}: give what pair_surfaces or "
                                f"pair_obstacle returns")
        self._join(zones)

    def __reduce__(self):
        return type(self), self._made_of

    def __getattr__(self, name):
        raise AttributeError(f"the pairs of several zones have no {name}: ask those of one, result.zone(name).contact")

    # The pairs of all zones for the library, with equations between degrees of freedom.
    with_equations = SurfacePairs.with_equations

    def _join(self, zones):
        """The pairs of all zones as one object of the library."""
        functions, handle, data = library(), address(), sized(SurfaceData)
        numbers = [zone.numbers(name) for name, zone in zones.items()]
        given = (ContactZone * len(zones))(*[
            sized(ContactZone, law=zone.friction.law, contact=zone.contact._handle, name=name.encode(), friction=at(own))
            for (name, zone), own in zip(zones.items(), numbers)])
        check(functions, functions.surface_join(len(zones), given, ctypes.byref(handle)))
        self._owner = Owner(functions.surface_free, handle.value)
        check(functions, functions.surface_view(handle, ctypes.byref(data)))
        self.summary, self.structure = data.summary.decode(), data.rows

        def array(name, shape, kind=real):
            found = copied(getattr(data, name), shape, kind)
            return np.zeros(shape, kind) if found is None else found

        pairs, dim = data.pairs, data.dim
        self.friction, self._paired_gaps = array("friction", (pairs, 4)), array("gaps", (pairs,))
        self._areas, self._tangents = array("areas", (pairs,)), array("tangents", (pairs, dim))
        self._normals = array("normals", (pairs, dim))
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
        # The first zone that has a joined pair tells its numbers.
        self._of_own = np.concatenate(list(self.places.values()))
        self._first = np.unique(self._of_own, return_index=True)[1]

    def gaps(self):
        """The gaps of all pairs, from those of the zones' contacts."""
        return self.joined("gap", {name: contact.gaps for name, contact in self.contacts.items()})

    def joined(self, what, values):
        """Numbers for each pair from those of each zone by name; other values as they are.

        A pair of several zones has the numbers of the first; but the gap of all of its parts, while they are those paired.
        """
        if not isinstance(values, dict):
            return values
        self._check(what, values)
        parts = []
        for name, contact in self.contacts.items():
            part = reals(f"{what}[{name!r}]", values[name])
            own = part.shape[:1] == (contact.pairs,)
            if part.ndim > 1 and not own:
                raise ValueError(f"{what}[{name!r}] has the shape {part.shape}: give the numbers of one pair, or of each of "
                                 f"its {contact.pairs} pairs; for cases that differ an array for the pairs of all zones, "
                                 "one zone after the other")
            parts.append(part if own else np.broadcast_to(part, (contact.pairs, *part.shape)))
        if len({part.shape[1:] for part in parts}) > 1:
            shapes = ", ".join(f"{name!r} {part.shape}" for name, part in zip(self.contacts, parts))
            raise ValueError(f"{what} has as many numbers for a pair in one zone as in another: {shapes}")
        own = np.concatenate(parts)
        found = own[self._first]
        if what == "gap" and own.ndim == 1:
            paired = np.concatenate([contact._paired_gaps for contact in self.contacts.values()])
            changes = np.bincount(self._of_own, own != paired, len(found))
            found = np.where(changes == 0, self._paired_gaps, found)
        return found

    def _check(self, what, values):
        known = ", ".join(map(repr, self.contacts))
        for name in values:
            if name not in self.contacts:
                raise KeyError(f"{what} names the zone {name!r}, there is none: the zones are {known}")
        for name in self.contacts:
            if name not in values:
                raise KeyError(f"{what} lacks the zone {name!r}: give numbers for each of {known}")

    def of(self, result, name):
        """The part of a result that belongs to a zone, in the frames of its own pairs.

        The force of a pair of several zones is shared by areas, so that each has the pressure.
        """
        self._check("zone", {**dict.fromkeys(self.contacts), name: None})
        place, contact = self.places[name], self.contacts[name]
        cut = ("d", "F", "state", "motion", "radius_d", "radius_F", "escape")
        parts = {field: None if getattr(result, field) is None else getattr(result, field)[place] for field in cut}
        share = contact.areas / self._areas[place]
        shared = np.flatnonzero(share != 1)
        for field in ("F", "radius_F"):
            if parts[field] is not None:
                parts[field][shared] *= share[shared, None]
        for field in ("d", "F", "motion", "escape"):
            if parts[field] is not None:
                self._turn(parts[field], contact, place, shared)
        second = None if result.second is None else self.of(result.second, name)
        return result._replace(contact=self.contacts[name], second=second, **parts)

    def _turn(self, vectors, contact, place, shared):
        """Turns tangential parts from the frames of joined pairs to those of a zone's own, in 3D."""
        if contact.dim == 2 or not len(shared):
            return
        joined = place[shared]
        first = self._tangents[joined]
        second = np.cross(self._normals[joined], first)
        along, across = (np.sum(contact.tangents[shared] * tangent, axis=1) for tangent in (first, second))
        size = np.hypot(along, across)
        c, s, (one, two) = along / size, across / size, vectors[shared, 1:].T
        vectors[shared, 1:] = np.array([c * one + s * two, c * two - s * one]).T

    def write(self, path, cells, result, u=None, *, slip0=None, gap=None):
        """Writes the mesh of the zones with the fields of all to one file; see SurfacePairs.write.

        slip0, gap: those of the step, in arrays for all pairs or dicts by the names of zones.
        """
        def by_zone(what, values):
            values = self.joined(what, values)
            return [np.asarray(values)[place] if np.ndim(values) else values for place in self.places.values()]

        parts = [self.of(result, name) for name in self.contacts]
        write_zones(path, cells, list(zip(self.contacts.values(), parts, by_zone("slip0", slip0), by_zone("gap", gap))), u)

    def penetration(self, u):
        """The deepest Penetration of all zones, or None."""
        found = [contact.penetration(u) for contact in self.contacts.values()]
        return max((one for one in found if one), key=lambda one: one.depth, default=None)

    def table(self, result):
        """A ZoneSums for each zone."""
        sums = []
        for name, contact in self.contacts.items():
            part = self.of(result, name)
            found = contact.resultant(part)
            count = {state: int((part.state == state).sum()) for state in (State.OPEN, State.SLIP, State.STICK)}
            sums.append(ZoneSums(name, contact.pairs, *count.values(), found.pressed_area, found.force))
        return sums
