"""Two bolted plates with a washer: four contact zones, eight load steps, beside a mesh twice as fine.

    python3 tests/bench/four_zones.py [--fine]

The parts of c_examples/parts/bolted_plates.py with a washer under the head: head on washer, washer on plate, plate on
plate, nut on plate, friction 0.2; the section of the bolt stays as short as its pretension made it. Of each step the
forces of the zones, systems and CPU seconds; --fine: of the mesh of twice as many bricks along each direction too.
"""

import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "c_examples", "parts"))
import bolted_plates as plates  # noqa: E402
from bricks import Bricks  # noqa: E402
from part import Part, Zone, dofs, signorini  # noqa: E402

WASHER, OUTER = 2.5, 10.0  # thickness and radius
PULLS = (2000.0, 6000.0, 10000.0, 14000.0, 17000.0, 19000.0, 22000.0, 24000.0)


def finer(lines, times):
    """Lines of a mesh, each interval divided."""
    return np.interp(np.arange(times * (len(lines) - 1) + 1) / times, np.arange(len(lines)), lines)


def bodies(times):
    mesh, cells = Bricks(), 3 * times
    shank, hole, head, thick, high = plates.SHANK, plates.HOLE, plates.HEAD, plates.THICK, plates.HIGH
    under = finer([hole, 6.7, head], times)
    for body, side, seat in (("upper bolt", 1, thick + WASHER), ("lower bolt", -1, thick)):
        shaft = finer(np.linspace(0, seat, 5), times)
        top = finer(np.linspace(seat, seat + high, 4), times)
        for levels in (shaft, top):
            plates.disc(mesh, body, shank, cells, side * levels[::side])
        plates.ring(mesh, body, [shank, *under], cells, side * top[::side])
    between = finer([hole, 6.5, head, OUTER], times)
    plates.ring(mesh, "washer", between, cells + 1, finer(np.linspace(thick, thick + WASHER, 3), times))
    radii = finer([hole, 6.5, head, 10, 12.5, 16, 20, plates.PLATE], times)
    for body, side in (("upper plate", 1), ("lower plate", -1)):
        plates.ring(mesh, body, radii, cells + 1, side * finer(np.linspace(0, thick, 6), times)[::side])
    mesh.join()
    return mesh


def part(times):
    """The assembly to be tightened, and a function of the shortening that makes the locked one."""
    mesh, level, thick = bodies(times), plates.level, plates.THICK
    zones = {"head on washer": (("upper bolt", level(thick + WASHER, plates.SHANK)), ("washer", level(thick + WASHER))),
             "washer on plate": (("washer", level(thick)), ("upper plate", level(thick))),
             "plate on plate": (("upper plate", level(0)), ("lower plate", level(0))),
             "nut on plate": (("lower bolt", level(-thick, plates.SHANK)), ("lower plate", level(-thick)))}
    zones = {name: Zone(*sides, plates.MU) for name, sides in zones.items()}
    sides = [mesh.nodes(body, level(0.0)) for body in ("upper bolt", "lower bolt")]
    upper, lower = ([nodes[k] for k in np.lexsort(mesh.at[nodes].T.round(6))] for nodes in sides)
    shortening = 3 * len(mesh.at)
    equations = signorini.section_equations(3 * np.array(upper)[:, None] + np.arange(3),
                                            3 * np.array(lower)[:, None] + np.arange(3), shortening, [0, 0, 1])
    fixed = {dof for axis in (0, 1) for dof in dofs(np.flatnonzero(mesh.at[:, axis] < 1e-6), axis)}
    fixed |= set(dofs(mesh.nodes("lower bolt", level(0, high=0)), 2))
    fixed = sorted(fixed - set(dofs(upper, 0, 1, 2)))
    tight = np.zeros(shortening + 1)
    tight[shortening] = plates.PRETENSION / 4
    pull = np.zeros_like(tight)
    for body, side in (("upper plate", 1), ("lower plate", -1)):
        load = mesh.load(mesh.faces(body, level(side * thick, OUTER, 12.5)), np.array([0.0, 0.0, side]))
        pull[:-1] += load / abs(load.sum()) / 4
    common = dict(symmetry=((0, 0.0), (1, 0.0)), equations=equations, unknowns=1)

    def locked(value):
        return Part(mesh, zones, fixed, [(force * pull, {shortening: value}) for force in (0.0, *PULLS)], **common)
    return Part(mesh, zones, fixed, [(tight, {})], **common), locked


def forces(times):
    """How hard each zone presses after each pull, of the whole bolt."""
    tightened, locked = part(times)
    K = tightened.mesh.stiffness()
    (result, u), = tightened.solve(K)
    model = locked(u[-1])
    solve, seconds = signorini.Model.solve, []

    def timed(self, *arguments, **named):
        begin = time.process_time()
        found = solve(self, *arguments, **named)
        seconds.append(time.process_time() - begin)
        return found
    signorini.Model.solve = timed
    begin = time.process_time()
    results = model.solve(K, result.d[:, 1:])
    whole = time.process_time() - begin
    signorini.Model.solve = solve
    print(f"{len(K[2])} unknowns, {len(results[0][0].d)} pairs; pairing, reduction, nine steps {whole:.2f} s")
    table = []
    for force, took, (result, _) in zip((0.0, *PULLS), seconds, results):
        table.append([4 * abs(model.pairs[name].resultant(result.zone(name)).force[2]) for name in model.zones])
        print(f"pull {force:6.0f} N: " + ", ".join(f"{name} {value:8.1f}" for name, value in zip(model.zones, table[-1]))
              + f"; {result.report.factorisations} systems, {took:.2f} s", flush=True)
    return np.array(table)


if __name__ == "__main__":
    coarse = forces(1)
    if "--fine" in sys.argv:
        apart = np.abs(coarse - forces(2))
        print(f"beside the fine mesh: at most {apart.max() / plates.PRETENSION:.2%} of the pretension")
