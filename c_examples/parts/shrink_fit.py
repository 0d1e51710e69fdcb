"""A hub shrunk on a shaft, then turned until it slips: 0.02 mm of interference at a radius of 30 mm, friction 0.15.

    python3 c_examples/parts/shrink_fit.py [OUT]

The inner surface of the shaft is held, the outer one of the hub is turned; plane strain. The meshes do not match.
Pressure, stiffness and torque at slip by Lame's closed form for rings. mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, arc, line, patch, slab
from loaded_pin import on_circle
from part import Part, Zone, dofs, told

INNER, RADIUS, OUTER, LENGTH = 20.0, 30.0, 60.0, 10.0
INTERFERENCE, MU, YOUNG, POISSON = 0.02, 0.15, 210000.0, 0.3


def pressure():
    """Contact pressure of two rings of which the far surfaces do not move, plane strain."""
    young, poisson = YOUNG / (1 - POISSON ** 2), POISSON / (1 - POISSON)

    def stiffness(held):
        share = (held / RADIUS) ** 2
        return (young / (1 - poisson ** 2) * ((1 + poisson) + (1 - poisson) * share)
                / (RADIUS * abs(1 - share)))
    return INTERFERENCE / (1 / stiffness(INNER) + 1 / stiffness(OUTER))


def turned(torque):
    """The angle by which a torque turns the outer surface against the inner one, without slip."""
    shear = YOUNG / 2 / (1 + POISSON)
    return torque / (4 * np.pi * shear * LENGTH) * (1 / INNER ** 2 - 1 / OUTER ** 2)


def part(shaft=24, hub=32):
    """The model. Numbers of bricks around."""
    mesh = Bricks()
    for body, low, high, cells, layers in (("shaft", INNER, RADIUS, shaft, 2), ("hub", RADIUS, OUTER, hub, 4)):
        for start in (0, 90, 180, 270):
            inner, outer = (arc((0, 0), radius, start, start + 90) for radius in (low, high))
            region = patch(line(inner(0.0), outer(0.0)), line(inner(1.0), outer(1.0)), inner, outer)
            mesh.block(body, slab(region, LENGTH), (layers, cells // 4, 1), YOUNG, POISSON)
    mesh.join()
    held = mesh.nodes("shaft", on_circle(INNER))
    outside = mesh.nodes("hub", on_circle(OUTER))
    fixed = set(dofs(np.unique(mesh.bricks), 2)) | set(dofs(held, 0, 1))
    at, steps = mesh.at[outside], []
    for share in (0.0, 0.5, 1.5):
        angle = share * turned(MU * pressure() * 2 * np.pi * RADIUS ** 2 * LENGTH)
        motion = angle * np.column_stack([-at[:, 1], at[:, 0]]).ravel()
        steps.append((np.zeros(3 * len(mesh.at)), dict(zip(dofs(outside, 0, 1), motion))))
    zone = Zone(("shaft", on_circle(RADIUS)), ("hub", on_circle(RADIUS)), MU, gap=-INTERFERENCE)
    def swollen(at):
        radius = np.hypot(at[:, 0], at[:, 1])
        factor = 1 + INTERFERENCE * (radius - INNER) / (RADIUS - INNER) / radius
        return at * np.column_stack([factor, factor, np.ones(len(at))])
    return Part(mesh, {"fit": zone}, sorted(fixed), steps, shapes={"shaft": swollen})


def main():
    model = part()
    results = model.solve()
    slip = MU * pressure() * 2 * np.pi * RADIUS ** 2 * LENGTH
    mean = -results[0][0].zone("fit").F[:, 0].sum() / model.pairs["fit"].areas.sum()
    _, pressures = model.pressures(0, "fit")
    print(f"{len(results[0][0].d)} pairs, pressures from {pressures.min():.1f} to {pressures.max():.1f} MPa")
    told("pressure, MPa", mean, pressure(), 0.005, "Lame")
    # The hub resists: the moment on the shaft is that of the hub's turn.
    moments = [model.pairs["fit"].resultant(result.zone("fit")).moment[2] for result, _ in results]
    told("torque at half the angle of slip, N mm", moments[1], slip / 2, 0.005, "Lame, without slip")
    told("torque at one and a half of it, N mm", moments[2], slip, 0.005, "mu p 2 pi R^2 L")
    model.write("shrink_fit")


if __name__ == "__main__":
    main()
