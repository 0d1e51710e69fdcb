"""NAFEMS' cylinder on a block: a steel cylinder of radius 50 mm is pressed on an aluminium block, plane strain.

    python3 c_examples/parts/cylinder.py [OUT]

A quarter of the cylinder with 17.5 kN for each mm, half of the whole. Hertz: half width 6.21 mm, pressure
3585 MPa (A. Konter, Advanced Finite Element Contact Benchmarks, NAFEMS 2006, no. 1; K. L. Johnson, Contact
Mechanics, 4.3). mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, arc, graded, line, patch, slab
from loaded_pin import on_circle
from part import Part, Zone, dofs, told

RADIUS, SIDE, FORCE, MU = 50.0, 100.0, 17500.0, 0.1
STEEL, ALUMINIUM = 210000.0, 70000.0


def part(cell=0.75):
    """The model, with bricks of `cell` mm in the contact."""
    mesh = Bricks()
    half = 0.4 * RADIUS
    # Around the centre (0, RADIUS): the core, and two blocks between it and the circle.
    def at(x, y):
        return np.array([x, y + RADIUS])
    around, across = graded(cell, 8.0, np.pi / 4 * RADIUS), 1 - graded(cell, 8.0, RADIUS - half)[::-1]
    region = patch(line(at(0, -half), at(half, -half)), line(at(0, 0), at(half, 0)),
                   line(at(0, -half), at(0, 0)), line(at(half, -half), at(half, 0)))
    mesh.block("cylinder", slab(region, 1.0), (around, 4, 1), STEEL)
    foot, edge = arc((0, RADIUS), RADIUS, -90, -45), arc((0, RADIUS), RADIUS, -45, 0)
    region = patch(foot, line(at(0, -half), at(half, -half)), line(foot(0.0), at(0, -half)),
                   line(foot(1.0), at(half, -half)))
    mesh.block("cylinder", slab(region, 1.0), (around, 1 - across[::-1], 1), STEEL)
    region = patch(line(at(half, -half), foot(1.0)), line(at(half, 0), edge(1.0)),
                   line(at(half, -half), at(half, 0)), edge)
    mesh.block("cylinder", slab(region, 1.0), (across, 4, 1), STEEL)
    wide, deep = graded(0.9 * cell, 15.0, SIDE), 1 - graded(0.9 * cell, 15.0, 2 * SIDE)[::-1]
    region = patch(line((0, -2 * SIDE), (SIDE, -2 * SIDE)), line((0, 0), (SIDE, 0)),
                   line((0, -2 * SIDE), (0, 0)), line((SIDE, -2 * SIDE), (SIDE, 0)))
    mesh.block("block", slab(region, 1.0), (wide, deep, 1), ALUMINIUM)
    mesh.join()
    fixed = set(dofs(np.unique(mesh.bricks), 2))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 0] < 1e-6), 0))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 1] < -2 * SIDE + 1e-6), 0, 1))
    load = mesh.load(mesh.faces("cylinder", lambda at: at[:, 1] > RADIUS - 1e-6),
                     np.array([0, -FORCE / RADIUS, 0]))
    low, circle = 0.5 * RADIUS, on_circle(RADIUS, (0, RADIUS))
    zone = Zone(("cylinder", lambda at: circle(at) & (at[:, 1] < low)),
                ("block", lambda at: (abs(at[:, 1]) < 1e-6) & (at[:, 0] < low)), MU)
    return Part(mesh, {"foot": zone}, sorted(fixed), [(load, {})], symmetry=((0, 0.0),))


def main():
    model = part()
    (result, _), = model.solve()
    nodes, pressures = model.pressures(0, "foot")
    away = model.mesh.at[nodes, 0]
    stiffness = 1 / ((1 - 0.3 ** 2) * (1 / STEEL + 1 / ALUMINIUM))
    half_width = np.sqrt(8 * FORCE * RADIUS / (np.pi * stiffness))
    print(f"{len(result.d)} pairs, eta {result.report.eta:.1e}")
    # The square of Hertz' pressure falls in proportion to that of the distance, to zero at the half width.
    inside = (pressures > 0.3 * pressures.max()) & (away > 0)
    slope, top = np.polyfit(away[inside] ** 2, pressures[inside] ** 2, 1)
    told("half width, mm", np.sqrt(-top / slope), half_width, 0.02, "Hertz; NAFEMS 6.21")
    told("largest pressure, MPa", np.sqrt(top), 4 * FORCE / (np.pi * half_width), 0.02, "Hertz; NAFEMS 3585")
    model.write("cylinder")


if __name__ == "__main__":
    main()
