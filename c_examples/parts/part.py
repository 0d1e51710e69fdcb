"""A part with contact, and its load steps by the library."""

import os
import sys
from dataclasses import dataclass, field

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import signorini  # noqa: E402


@dataclass
class Zone:
    """Two sides that may touch: each a body, and the surface on which a function of coordinates is true."""

    slave: tuple
    master: tuple
    mu: float
    gap: object = None  # a number or a function of the pairs' places, for sides of one radius; None: as measured

    def gaps(self, pairs):
        """The gaps of its pairs."""
        if self.gap is None:
            return pairs.gaps
        return self.gap(pairs.points) if callable(self.gap) else np.full(pairs.pairs, self.gap)


@dataclass
class Part:
    """A mesh with its contact zones, its supports and its load steps."""

    mesh: object
    zones: dict
    fixed: list  # degrees of freedom that do not move
    steps: list  # of each step its loads, and a dict of further degrees of freedom with their displacements
    symmetry: tuple = ()  # planes of symmetry that cross the zones: (axis, where)
    equations: tuple = ()  # between degrees of freedom
    unknowns: int = 0  # further ones behind those of the mesh, without stiffness
    shapes: dict = field(default_factory=dict)  # of a body that is meshed in another shape: its true coordinates
    found: list = field(default_factory=list)

    def true_shape(self):
        """Coordinates of all nodes, with the gaps of the zones in them, for a code that takes no gaps."""
        at = self.mesh.at.copy()
        for body, shape in self.shapes.items():
            nodes = self.mesh.nodes(body, lambda at: at[:, 0] == at[:, 0])
            at[nodes] = shape(at[nodes])
        return at

    def solve(self, K=None, slip=0.0):
        """Pairs the zones, reduces the matrix, solves the steps. Returns a list of (result, u). K: the stiffness
        matrix of the mesh, if it is there. slip: of all pairs, from which the first step begins."""
        mesh, moved = self.mesh, list(self.steps[0][1])
        pairs = {name: signorini.pair_surfaces(mesh.at, mesh.faces(*zone.slave), mesh.faces(*zone.master),
                                               symmetry=self.symmetry)
                 for name, zone in self.zones.items()}
        gaps = {name: zone.gaps(pairs[name]) for name, zone in self.zones.items()}
        friction = {name: zone.mu for name, zone in self.zones.items()}
        fixed = np.concatenate([self.fixed, moved]).astype(int)
        data, indices, starts = mesh.stiffness() if K is None else K
        K = data, indices, np.append(starts, [starts[-1]] * self.unknowns).astype(int)
        self.model = signorini.Model.from_surfaces(K, pairs, fixed=fixed, equations=self.equations or None)
        results = []
        for loads, motions in self.steps:
            prescribed = np.concatenate([np.zeros(len(self.fixed)), [motions[dof] for dof in moved]])
            result = self.model.solve(loads, gap=gaps, mu=friction, slip0=slip, prescribed=prescribed)
            if result.status != signorini.Status.SOLVED:
                raise SystemExit(result.message)
            slip = result.d[:, 1:]
            results.append((result, self.model.recover(result.d, loads, prescribed)))
        self.pairs, self.found = pairs, results
        return results

    def pressures(self, step, zone):
        """Nodes of a zone's pairs with their pressures in a step."""
        result, pairs = self.found[step][0], self.pairs[zone]
        return pairs.nodes, -result.zone(zone).F[:, 0] / pairs.areas

    def write(self, name):
        """Writes the last step for ParaView, if the command names a directory: OUT/name.vtu."""
        if len(sys.argv) > 1:
            zone = next(iter(self.zones))
            result, u = self.found[-1]
            path = os.path.join(sys.argv[1], name + ".vtu")
            self.pairs[zone].write(path, self.mesh.cells(), result.zone(zone), u)


def dofs(nodes, *axes):
    """Degrees of freedom of nodes along axes."""
    return [3 * int(node) + axis for node in nodes for axis in axes]


def told(name, found, expected, within, source):
    """Prints a figure beside that of its source, and ends the program if they are further apart than `within`."""
    off = found / expected - 1
    print(f"{name:44} {found:11.4g} {expected:11.4g} {round(100 * off, 2) + 0.0:+8.2f} %   {source}")
    if not abs(off) <= within:
        raise SystemExit(f"{name}: off by {100 * off:.2f} %, more than {100 * within:.2f} %")
