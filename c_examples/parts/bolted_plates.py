"""A bolt through two plates in three dimensions: brought to its pretension, then pulled until the plates open.

    python3 c_examples/parts/bolted_plates.py [OUT]

A quarter of a bolt M10 with head and nut and of two round plates, three contact zones with friction 0.2, and a
section through the bolt whose shortening is one more unknown: its load is the pretension, then it is locked. The shortening beside
the resiliences of VDI 2230 (2003). Then the plates are pulled apart, under the head and the nut, as VDI has it with the load
introduction factor n = 1: what the bolt takes of the pull and the load at which the plates open are VDI's figures. Pulled beside
the head the plates take more of it. The force in the locked section is the reaction of its shortening. Once the plates are apart
the bolt carries all of it. mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, arc, line, patch
from part import Part, Zone, dofs, signorini, told

SHANK, HOLE, HEAD, PLATE = 5.0, 5.5, 8.0, 24.0  # radii
HIGH, THICK = 7.0, 15.0  # of a head, of a plate
YOUNG, MU, PRETENSION = 210000.0, 0.2, 20000.0
PULLS = 2000.0, 6000.0, 10000.0, 14000.0, 18000.0, 20000.0, 21000.0, 22000.0, 24000.0, 25000.0


def tower(mesh, body, region, cells, levels):
    """A plane region between two heights as a body, or a part of one."""
    low, high = levels[0], levels[-1]

    def place(r, s, t):
        return np.concatenate([region(r, s), (low + t * (high - low))[..., None]], axis=-1)
    mesh.block(body, place, (*cells, (np.asarray(levels) - low) / (high - low)), YOUNG)


def disc(mesh, body, radius, cells, levels):
    """A quarter of a disc."""
    half = 0.55 * radius
    corner = np.array([0.9 * half, 0.9 * half])
    region = patch(line((0, 0), (half, 0)), line((0, half), corner), line((0, 0), (0, half)),
                   line((half, 0), corner))
    tower(mesh, body, region, (cells, cells), levels)
    edges = [(line((half, 0), corner), 0, 45), (line(corner, (0, half)), 45, 90)]
    for inner, start, end in edges:
        outer = arc((0, 0), radius, start, end)
        region = patch(line(inner(0.0), outer(0.0)), line(inner(1.0), outer(1.0)), inner, outer)
        tower(mesh, body, region, (2, cells), levels)


def ring(mesh, body, radii, cells, levels):
    """A quarter of a ring; radii of its circles of nodes."""
    for start in (0, 45):
        inner, outer = (arc((0, 0), radius, start, start + 45) for radius in (radii[0], radii[-1]))
        region = patch(line(inner(0.0), outer(0.0)), line(inner(1.0), outer(1.0)), inner, outer)
        share = (np.asarray(radii) - radii[0]) / (radii[-1] - radii[0])
        tower(mesh, body, region, (share, cells), levels)


def bodies(cells):
    mesh = Bricks()
    shank, head = np.linspace(0, THICK, 5), np.linspace(THICK, THICK + HIGH, 4)
    for body, side in (("upper bolt", 1), ("lower bolt", -1)):
        for levels in (shank, head):
            disc(mesh, body, SHANK, cells, side * levels[::side])
        ring(mesh, body, [SHANK, HOLE, 6.7, HEAD], cells, side * head[::side])
    radii = [HOLE, 6.5, HEAD, 10, 12.5, 16, 20, PLATE]
    for body, side in (("upper plate", 1), ("lower plate", -1)):
        ring(mesh, body, radii, cells + 1, side * np.linspace(0, THICK, 6)[::side])
    mesh.join()
    return mesh


def level(height, low=0.0, high=PLATE):
    """A test of coordinates: they are at this height, between two radii."""
    def test(at):
        radius = np.hypot(at[:, 0], at[:, 1])
        return (abs(at[:, 2] - height) < 1e-6) & (radius > low - 1e-6) & (radius < high + 1e-6)
    return test


def parts(cells=3, pulls=PULLS, under_head=False):
    """The assembly to be tightened, and a function of the shortening that makes the locked one, with its loads."""
    mesh = bodies(cells)
    zones = {"head": Zone(("upper bolt", level(THICK, SHANK, HEAD)), ("upper plate", level(THICK)), MU),
             "plates": Zone(("upper plate", level(0)), ("lower plate", level(0)), MU),
             "nut": Zone(("lower bolt", level(-THICK, SHANK, HEAD)), ("lower plate", level(-THICK)), MU)}
    sides = [mesh.nodes(body, level(0.0)) for body in ("upper bolt", "lower bolt")]
    upper, lower = ([nodes[k] for k in np.lexsort(mesh.at[nodes].T.round(6))] for nodes in sides)
    shortening = 3 * len(mesh.at)
    axes = np.arange(3)
    equations = signorini.section_equations(3 * np.array(upper)[:, None] + axes,
                                            3 * np.array(lower)[:, None] + axes, shortening, [0, 0, 1])
    fixed = {dof for axis in (0, 1) for dof in dofs(np.flatnonzero(mesh.at[:, axis] < 1e-6), axis)}
    fixed |= set(dofs(mesh.nodes("lower bolt", level(0, high=0)), 2))
    fixed -= set(dofs(upper, 0, 1, 2))
    tight = np.zeros(3 * len(mesh.at) + 1)
    tight[shortening] = PRETENSION / 4
    pull = np.zeros_like(tight)
    for body, side in (("upper plate", 1), ("lower plate", -1)):
        faces = mesh.faces(body, level(side * THICK, *((HOLE, HEAD) if under_head else (HEAD, 12.5))))
        load = mesh.load(faces, np.array([0.0, 0.0, side]))
        pull[:-1] += load / abs(load.sum()) / 4
    common = dict(symmetry=((0, 0.0), (1, 0.0)), equations=equations, unknowns=1)

    def locked(value):
        return Part(mesh, zones, sorted(fixed), [(force * pull, {shortening: value}) for force in (0.0, *pulls)],
                    **common)
    return Part(mesh, zones, sorted(fixed), [(tight, {})], **common), locked


def resiliences():
    """Of the bolt and of the plates, mm / N (VDI 2230, 5.1)."""
    length, area = 2 * THICK, np.pi * SHANK ** 2
    bolt = (length + 2 * 0.4 * 2 * SHANK) / (YOUNG * area)  # 0.4 d for the head, 0.4 d for the nut's engagement
    ratio, beta = PLATE / HEAD, length / (2 * HEAD)
    slope = 0.362 + 0.032 * np.log(beta / 2) + 0.153 * np.log(ratio)
    head, hole, widest = 2 * HEAD, 2 * HOLE, 2 * HEAD + length * slope
    if widest > 2 * PLATE:
        raise SystemExit("the plates are narrower than the cone of pressure")
    cone = (head + hole) * (head + length * slope - hole) / ((head - hole) * (head + length * slope + hole))
    return bolt, 2 * np.log(cone) / (YOUNG * np.pi * hole * slope)


def force(model, result, zone):
    """How hard a zone presses, of the whole bolt."""
    return 4 * abs(model.pairs[zone].resultant(result.zone(zone)).force[2])


def pulled(part, K, slip, pulls):
    """What the bolt takes of a first pull, and the load at which the plates open, of a locked bolt."""
    forces, pressed = [], []
    for pull, (result, _), (loads, motions) in zip((0.0, *pulls), part.solve(K, slip), part.steps):
        forces.append(force(part, result, "head"))
        clamped = force(part, result, "plates")
        pressed.append(clamped)
        report = result.report
        print(f"pull {pull:6.0f} N: bolt {forces[-1]:8.1f}, plates pressed by {clamped:8.1f}; "
              f"{report.pairs_open} pairs open, {report.factorisations} systems")
        told("  bolt = plates + pull, N", forces[-1], clamped + pull, 1e-6, "equilibrium")
        # The shortening is the last of the supports.
        section = part.model.reactions(result, loads, [0.0] * len(part.fixed) + list(motions.values()))[-1]
        told("  section of the bolt, N", 4 * section, forces[-1], 1e-6, "equilibrium")
    told("locked, force under the head, N", forces[0], PRETENSION, 1e-6, "the step before")
    told("bolt at the last pull, N", forces[-1], pulls[-1], 1e-6, "statics: the plates are apart")
    # Plates part from the outside in, and the force ratio grows before they are apart.
    last = max(k for k, clamped in enumerate(pressed) if clamped > 0)
    at, falls = (0.0, *pulls)[last - 1:last + 1], pressed[last - 1] - pressed[last]
    return (forces[1] - forces[0]) / pulls[0], at[1] + pressed[last] * (at[1] - at[0]) / falls


def main():
    tightened, _ = parts()
    K = tightened.mesh.stiffness()
    (result, u), = tightened.solve(K)
    bolt, plates = resiliences()
    told("pretension, force under the head, N", force(tightened, result, "head"), PRETENSION, 1e-6,
         "equilibrium")
    told("shortening, mm", u[-1], PRETENSION * (bolt + plates), 0.1, "VDI 2230, resiliences")
    _, locked = parts(under_head=True)
    print("pulled under the head and the nut")
    taken, opens = pulled(locked(u[-1]), K, result.d[:, 1:], PULLS)
    ratio = plates / (bolt + plates)
    told("force ratio, n = 1", taken, ratio, 0.02, "VDI 2230, resiliences")
    told("opening load, N", opens, PRETENSION / (1 - ratio), 0.01, "VDI 2230, pretension / (1 - force ratio)")
    _, locked = parts()
    print("pulled beside the head and the nut")
    model = locked(u[-1])
    beside, opens = pulled(model, K, result.d[:, 1:], PULLS)
    print(f"force ratio {beside:.3f}, n = {beside / taken:.2f} of VDI 2230: the plates take more of a pull beside the head")
    if not 0 < beside < taken:
        raise SystemExit("a pull beside the head is taken by the plates in part")
    told("opening load, N", opens, PRETENSION / (1 - beside), 0.02, "pretension / (1 - this force ratio)")
    model.write("bolted_plates")


if __name__ == "__main__":
    main()
