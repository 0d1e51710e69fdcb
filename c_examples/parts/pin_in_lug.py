"""A pin in the hole of a wide sheet, with clearance: the contact grows with the load and soon is wide.

    python3 c_examples/parts/pin_in_lug.py [OUT]

The angle of contact by A. Persson's closed form for a disc in the hole of an infinite sheet of the same material
(On the stress distribution of cylindrical elastic bodies in contact, 1964), frictionless; plane strain. mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, arc, graded, line, patch, slab
from loaded_pin import on_circle, pin
from part import Part, Zone, dofs, told

RADIUS, CLEARANCE, YOUNG = 10.0, 0.02, 210000.0
WIDE = 25 * RADIUS


def part(loads=(200.0, 1000.0, 4000.0), around=16, mu=0.0):
    """The model of the half y >= 0: loads in N for each mm of it."""
    mesh = Bricks()
    growing = graded(2.0 * RADIUS / around / 2, 4 * RADIUS, WIDE - RADIUS)
    corners = {0: (WIDE, 0), 45: (WIDE, WIDE), 135: (-WIDE, WIDE), 180: (-WIDE, 0)}
    for start, end in ((0, 45), (45, 135), (135, 180)):
        inner, outer = arc((0, 0), RADIUS, start, end), line(corners[start], corners[end])
        region = patch(line(inner(0.0), outer(0.0)), line(inner(1.0), outer(1.0)), inner, outer)
        cells = (around + 3) * (end - start) // 45
        mesh.block("sheet", slab(region, 1.0), (growing, cells, 1), YOUNG)
    pin(mesh, around, 6, RADIUS, YOUNG)
    mesh.join()
    fixed = set(dofs(np.unique(mesh.bricks), 2))
    fixed |= set(dofs(np.flatnonzero(abs(mesh.at[:, 1]) < 1e-6), 1))
    fixed |= set(dofs(np.flatnonzero(abs(mesh.at[:, 0]) > WIDE - 1e-6), 0, 1))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 1] > WIDE - 1e-6), 0, 1))
    centre = mesh.nodes("pin", lambda at: np.hypot(at[:, 0], at[:, 1]) < 1e-6)
    steps = []
    for force in loads:
        load = np.zeros(3 * len(mesh.at))
        load[dofs(centre, 0)] = force / len(centre)
        steps.append((load, {}))
    # Both are meshed with the radius of the hole. The pin touches the hole at angle 0; there the gap begins.
    zone = Zone(("pin", on_circle(RADIUS)), ("sheet", on_circle(RADIUS)), mu,
                gap=lambda at: CLEARANCE * (1 - at[:, 0] / RADIUS))
    shapes = {"pin": lambda at: at * [1 - CLEARANCE / RADIUS, 1 - CLEARANCE / RADIUS, 1] + [CLEARANCE, 0, 0]}
    return Part(mesh, {"pin in sheet": zone}, sorted(fixed), steps, shapes=shapes, symmetry=((1, 0.0),))


def persson(force, clearance=CLEARANCE, young=YOUNG, poisson=0.3):
    """Half of the angle of contact in degrees."""
    def asked(b):
        return (2 - np.log(b * b + 1) - 2 * b ** 4) / (np.pi * (b * b + 1) * b * b)
    b = np.linspace(1e-3, 0.914, 200001)
    wanted = young / (1 - poisson ** 2) * clearance / force
    return np.degrees(2 * np.arctan(np.interp(-wanted, -asked(b), b)))


def main():
    model = part()
    for step, (result, _) in enumerate(model.solve()):
        nodes, pressures = model.pressures(step, "pin in sheet")
        at = model.mesh.at[nodes]
        angle = np.degrees(np.arctan2(at[:, 1], at[:, 0]))
        force = 2 * model.steps[step][0].sum()
        ends = (angle[pressures > 0].max() + angle[pressures <= 0].min()) / 2
        # The end of the contact lies between two nodes, 1.4 degrees apart.
        told(f"{force:.0f} N, half angle of contact, degrees", ends, persson(force), 0.7 / ends, "Persson")
    model.write("pin_in_lug")


if __name__ == "__main__":
    main()
