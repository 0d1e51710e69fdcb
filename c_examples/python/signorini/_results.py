"""Results of the calls."""

import ctypes
import numbers
from collections import namedtuple

import numpy as np

from ._arrays import at
from ._constants import Proof, State, Status
from ._library import check
from ._structures import Extra, Report, sized

Progress = namedtuple("Progress", "iterations eta elapsed reduced memory")
Progress.__doc__ = """Progress of a call, as its progress function is told.

iterations: sweeps, pivots or linear systems done.  eta: the latest, infinite before the first.
elapsed: seconds since the call began.
reduced: share of a reduction, as of Model.sparse, or of a pairing that is done, 0 to 1; 1 while a case is solved.
memory: bytes that the reduction needs in all, told before they are taken; otherwise 0.
"""

_Fields = namedtuple("_Fields", "d F state status message report motion second radius_d radius_F "
                     "escape contact penetration frames gaps slip0", defaults=8 * (None,))


class Result(_Fields):
    """Solution of a contact problem, or the last iterate.

    d: relative displacements, (P, D); length.  F: contact forces, (P, D); force.  state: of each pair
    (State), (P,).  Unless status is SOLVED these are the best or last iterate.
    status: a Status.  message: the same in words.
    report: the fields of signorini_report, with members of Method, Uniqueness, Fallback and Remark.
    motion: with status NO_EQUILIBRIUM a motion that proves it, (P, D), largest component 1; else None.
    second: a second solution, a Result whose report is measured as certify does, or None. What
    uniqueness proves needs no second solution; ask for one by search="others".
    radius_d, radius_F: if report.proof is PROVED (ask for it by proof=True) a solution with these
    states exists within these distances of d and of F, (P, D); else None.
    escape: with status NO_EQUILIBRIUM the motion with which the bodies escape, (P, D), largest
    component 1, without the lift that a proof needs: draw this one; with status STALLED the motion
    along which bodies move away as supports are let go, if they do, which proves nothing; else None.
    contact: the SurfacePairs of the model; of a model with several zones an object with their names, whose pairs zone gives;
    or None.
    penetration: with pairs from surfaces and status SOLVED the Penetration of what has passed through the other side
    without a pair, of which solve warns; None: nothing has.
    frames: of a zone that shares pairs with others, where they cut a smooth surface, normal and tangents of each pair, as
    Model.frames has them; None: those of contact.
    gaps, slip0: with pairs from surfaces those of the case, gaps of several zones by zone or for all pairs; None: the case had
    none. fields, resultant and write take them.

    A result can be pickled, without its contact: a load history goes on from a file by start=result.d and slip0.
    Model.with_contact gives it the contact of a model again.
    """

    __slots__ = ()

    def __getnewargs__(self):
        """For pickle and copy: all but contact, which belongs to this process."""
        return tuple(self._replace(contact=None))

    def zone(self, name):
        """The part of a zone of Model.from_surfaces: a Result, whose contact is that zone's SurfacePairs.

        The force of a pair that zones share, where they cut a smooth surface, is shared by their areas, and its d counts
        from the gap of the zone. Such a pair has one slip0, that of the first of its zones, which the part of each has.
        """
        return self._zones().of(self, name)

    def table(self):
        """Pairs by state, pressed area and force of each zone: a list of (zone, pairs, open, slip, stick,
        pressed_area, force), named so. Pairs that zones share are in the rows of each, with their parts of the force; the table
        of the C interface has them in the first zone alone. Pairs without the name of a zone are one, "contact"."""
        return (self.contact or self._zones()).table(self)

    def _zones(self):
        if not hasattr(self.contact, "places"):
            raise ValueError("the model has no zones with names: give Model.from_surfaces a dict of them; a result that was "
                             "unpickled or copied has none any more: Model.with_contact gives it those of the model")
        return self.contact

    def plot(self, axes=None, *, at=None):
        """Draws contact forces and states by matplotlib; returns its axes, which you show or save.

        With pairs from surfaces: in 2D pressure and traction along the slave's surface, of several zones one after the other;
        in 3D the pressure on the slave's faces, with the edges of what presses and of what sticks, and at some hundred
        pairs marks of their states and arrows of their tractions. With at, the places of the pairs, (P, D): forces at
        them. Otherwise forces pair by pair.
        axes: where to draw, in 3D axes with projection="3d"; None: new ones. Zones on the same axes in 3D have one scale
        of colours, and the next result of a zone takes the place of its last.
        """
        from ._plot import plot  # only now: matplotlib takes its time

        return plot(self, axes, at)


Enclosure = namedtuple("Enclosure", "F radius_d radius_F")
Enclosure.__doc__ = """A solution that is proved to exist.

F: its contact forces, (P, D); force.  radius_d, radius_F: it is within these distances of the
displacements given and of F, component by component, (P, D).
"""

LcpResult = namedtuple("LcpResult", "w z status message report y")
LcpResult.__doc__ = """Solution of an LCP, or the last iterate.

w, z: n.  Unless status is SOLVED these are the best or last iterate.
status: a Status.  message: the same in words.  report: as that of a Result.
y: with status NO_EQUILIBRIUM a proof that no solution exists, n: y >= 0, M' y <= 0, q . y < 0; else
None.
"""


class Output:
    """Arrays that the library writes to, for one case or several."""

    def __init__(self, cases, pairs, dim, start=None):
        shape = (cases, pairs, dim)
        self.d = np.full(shape, np.nan) if start is None else np.array(start).reshape(shape)
        self.F, self.state = np.full(shape, np.nan), np.full(shape[:2], -1, np.int32)
        self.motion, self.escape = np.zeros(shape), np.zeros(shape)
        self.second_d, self.second_F = np.zeros(shape), np.zeros(shape)
        self.radius_d, self.radius_F = np.zeros(shape), np.zeros(shape)
        self.second_state = np.zeros(shape[:2], np.int32)
        self.report = (Report * cases)(*[sized(Report) for _ in range(cases)])
        self.extra = sized(Extra, motion=at(self.motion), second_d=at(self.second_d),
                           second_F=at(self.second_F), second_state=at(self.second_state),
                           radius_d=at(self.radius_d), radius_F=at(self.radius_F),
                           escape=at(self.escape))

    def solution(self):
        """Arguments d, F, state."""
        return [at(self.d), at(self.F), at(self.state)]

    def more(self):
        """Arguments report, extra."""
        return [ctypes.byref(self.report), ctypes.byref(self.extra)]

    def result(self, case, status, message, measure):
        """Result of a case; if its arguments are wrong its numbers are NaN.

        measure: certify, of displacements.
        """
        motion = escape = second = report = radius_d = radius_F = None
        if status < 0:
            self.d[case] = np.nan
        else:
            report = self.report[case].plain()
            if status == Status.SOLVED and len(self.state[case]) and (self.state[case] == State.OPEN).all():
                message += "; every pair is open: if they should touch, look at gaps, normals and loads"
            if self.report[case].second:
                # The forces and states are those that the library found with it.
                second = measure(self.second_d[case])._replace(
                    F=self.second_F[case], state=self.second_state[case]
                )
            if status == Status.NO_EQUILIBRIUM:
                motion = self.motion[case]
            if self.escape[case].any():
                escape = self.escape[case]
            if report.proof == Proof.PROVED:
                radius_d, radius_F = self.radius_d[case], self.radius_F[case]
        return Result(self.d[case], self.F[case], self.state[case], status, message, report,
                      motion, second, radius_d, radius_F, escape)


def certified(functions, data, tolerance, d, F=None):
    """Result of signorini_model_certify.

    data: the arguments before the tolerance.  d: (P, D).  F: where d does not determine the forces.
    """
    if not isinstance(tolerance, numbers.Real):
        raise TypeError(f"tolerance is {tolerance!r}: give a number")
    F = np.zeros_like(d) if F is None else F.copy()
    state, report = np.zeros(len(d), np.int32), sized(Report)
    status = functions.model_certify(*data, tolerance, at(d), at(F), at(state), ctypes.byref(report))
    status, message = check(functions, status)
    return Result(d, F, state, status, message, report.plain(), None, None)
