"""NAFEMS' loaded pin: a steel pin in an aluminium sheet, both of radius 50 mm, with friction 0.1.

    python3 c_examples/parts/loaded_pin.py [OUT]

The sheet is held on its left, the pin pulled to the right by 10 kN for each mm of half the model; plane strain.
A. Konter, Advanced Finite Element Contact Benchmarks, NAFEMS 2006, no. 4, in the form of code_aster's test
SSNP156, which gives the displacement of the hole's edge before the pin. mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, arc, line, patch, slab
from part import Part, Zone, dofs, told

RADIUS, FORCE, MU = 50.0, 10000.0, 0.1


def sheet(mesh, around, across, young=70000.0):
    """The half y >= 0 of the sheet."""
    def ring(start, end, outer, cells):
        first, last = (arc((0, 0), RADIUS, angle, angle)(0.0) for angle in (start, end))
        region = patch(line(first, outer(0.0)), line(last, outer(1.0)),
                       arc((0, 0), RADIUS, start, end), outer)
        mesh.block("sheet", slab(region, 1.0), (across, cells, 1), young)
    ring(0, 90, arc((0, 0), 2 * RADIUS, 0, 90), 2 * around)
    ring(90, 135, line((0, 100), (-100, 100)), around)
    ring(135, 180, line((-100, 100), (-100, 0)), around)
    region = patch(line((-200, 0), (-100, 0)), line((-200, 100), (-100, 100)),
                   line((-200, 0), (-200, 100)), line((-100, 0), (-100, 100)))
    mesh.block("sheet", slab(region, 1.0), (across, around, 1), young)


def pin(mesh, around, across, radius=RADIUS, young=210000.0):
    """The half y >= 0 of a disc: a core with three blocks around it."""
    half = 0.45 * radius
    corners = [(half, 0), (half, half), (-half, half), (-half, 0)]
    region = patch(line(corners[3], corners[0]), line(corners[2], corners[1]),
                   line(corners[3], corners[2]), line(corners[0], corners[1]))
    mesh.block("pin", slab(region, 1.0), (2 * around, around, 1), young)
    for k, (start, end) in enumerate([(0, 45), (45, 135), (135, 180)]):
        inner, outer = line(corners[k], corners[k + 1]), arc((0, 0), radius, start, end)
        region = patch(line(inner(0.0), outer(0.0)), line(inner(1.0), outer(1.0)), inner, outer)
        mesh.block("pin", slab(region, 1.0), (across, around * (2 if k == 1 else 1), 1), young)


def on_circle(radius, centre=(0.0, 0.0)):
    """A test of coordinates: they are on a circle."""
    return lambda at: abs(np.hypot(at[:, 0] - centre[0], at[:, 1] - centre[1]) - radius) < 1e-5


def part(around=12, across=8):
    """The model, with `around` bricks in an eighth of the circle of the pin, a few more in that of the sheet."""
    mesh = Bricks()
    sheet(mesh, around + 3, across)
    pin(mesh, around, across)
    mesh.join()
    everywhere = np.unique(mesh.bricks)
    fixed = set(dofs(everywhere, 2))
    fixed |= set(dofs(np.flatnonzero(abs(mesh.at[:, 1]) < 1e-6), 1))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 0] < -200 + 1e-6), 0, 1))
    centre = mesh.nodes("pin", lambda at: np.hypot(at[:, 0], at[:, 1]) < 1e-6)
    load = np.zeros(3 * len(mesh.at))
    load[dofs(centre, 0)] = FORCE / len(centre)
    zone = Zone(("pin", on_circle(RADIUS)), ("sheet", on_circle(RADIUS)), MU, gap=0.0)
    return Part(mesh, {"pin in sheet": zone}, sorted(fixed), [(load, {})], symmetry=((1, 0.0),))


def main():
    model = part()
    (result, u), = model.solve()
    front = model.mesh.nodes("sheet", lambda at: np.hypot(at[:, 0] - RADIUS, at[:, 1]) < 1e-6)
    force = model.pairs["pin in sheet"].resultant(result.zone("pin in sheet")).force
    print(f"{len(result.d)} pairs, eta {result.report.eta:.1e}, force on the pin {force[0]:.2f} N")
    # They compute with large displacements, here they are small: 0.7 mm of 50.
    told("hole before the pin, displacement, mm", u.reshape(-1, 3)[front, 0].mean(), 0.718, 0.04,
         "code_aster SSNP156")
    model.write("loaded_pin")


if __name__ == "__main__":
    main()
