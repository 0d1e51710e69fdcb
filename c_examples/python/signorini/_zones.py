"""Contact zones by name, in one model."""

from collections import namedtuple

import numpy as np

from ._arrays import reals
from ._constants import State
from ._sparse import ContactPairs
from ._surfaces import SurfacePairs

ZoneSums = namedtuple("ZoneSums", "zone pairs open slip stick pressed_area force")
ZoneSums.__doc__ = """A row of Result.table().

zone: its name.  pairs: how many; open, slip, stick: of them in each state.  pressed_area: of the pairs that
press.  force: of the contact on the slave's body, (3,).
"""


class Zones:
    """Pairs of several zones, one zone after the other."""

    def __init__(self, contacts):
        if not contacts:
            raise ValueError("zones is empty: give at least one zone, its name and its SurfacePairs")
        for name, contact in contacts.items():
            if not isinstance(contact, SurfacePairs):
                raise TypeError(f"zones[{name!r}] is a {type(contact).__name__}: give what pair_surfaces or "
                                f"pair_obstacle returns")
        self.contacts = dict(contacts)
        ends = np.cumsum([0, *(contact.pairs for contact in self.contacts.values())])
        self.places = {name: slice(begin, end) for name, begin, end in zip(self.contacts, ends, ends[1:])}

    def all(self, name):
        """An array of all zones."""
        return np.concatenate([getattr(contact, name) for contact in self.contacts.values()])

    def rows(self, equations):
        """The pairs of all zones."""
        rows = [row for contact in self.contacts.values() for row in contact.rows]
        return ContactPairs(None, self.all("normals"), None, None, self.all("tangents"), rows,
                            equations)

    def joined(self, what, values):
        """Numbers for each pair from those of each zone by name; other values as they are."""
        if not isinstance(values, dict):
            return values
        self._check(what, values)
        parts = []
        for name, contact in self.contacts.items():
            part = reals(f"{what}[{name!r}]", values[name])
            own = part.shape[:1] == (contact.pairs,)
            parts.append(part if own else np.broadcast_to(part, (contact.pairs, *part.shape)))
        if len({part.shape[1:] for part in parts}) > 1:
            shapes = ", ".join(f"{name!r} {part.shape}" for name, part in zip(self.contacts, parts))
            raise ValueError(f"{what} has as many numbers for a pair in one zone as in another: {shapes}")
        return np.concatenate(parts)

    def _check(self, what, values):
        known = ", ".join(map(repr, self.contacts))
        for name in values:
            if name not in self.contacts:
                raise KeyError(f"{what} names the zone {name!r}, there is none: the zones are {known}")
        for name in self.contacts:
            if name not in values:
                raise KeyError(f"{what} lacks the zone {name!r}: give numbers for each of {known}")

    def of(self, result, name):
        """The part of a result that belongs to a zone."""
        self._check("zone", {**dict.fromkeys(self.contacts), name: None})
        place = self.places[name]
        cut = ("d", "F", "state", "motion", "radius_d", "radius_F", "escape")
        parts = {field: None if getattr(result, field) is None else getattr(result, field)[place] for field in cut}
        second = None if result.second is None else self.of(result.second, name)
        return result._replace(contact=self.contacts[name], second=second, **parts)

    def table(self, result):
        """A ZoneSums for each zone."""
        sums = []
        for name, contact in self.contacts.items():
            part = self.of(result, name)
            found = contact.resultant(part)
            count = {state: int((part.state == state).sum()) for state in (State.OPEN, State.SLIP, State.STICK)}
            sums.append(ZoneSums(name, contact.pairs, *count.values(), found.pressed_area, found.force))
        return sums
