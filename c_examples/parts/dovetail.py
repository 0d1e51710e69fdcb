"""A dovetail root in its slot, as of a blade: pulled by 3000 N for each mm of half the model, then let go to a half.

    python3 c_examples/parts/dovetail.py [OUT]

Flanks at 45 degrees, friction 0.15, plane strain. While all of the flank slips, statics alone say how hard it
presses: N = F sqrt(2) / (1 + mu). When the pull falls, friction turns and holds the root in the slot. mm, N, MPa.
"""

import numpy as np

from bricks import Bricks, graded, line, patch, slab
from part import Part, Zone, dofs, told

PULL, MU, YOUNG = 3000.0, 0.15, 210000.0


def part(cells=14, mu=MU):
    """The half x >= 0, with this number of bricks along the root's flank."""
    mesh = Bricks()

    def quad(body, corners, divisions):
        a, b, c, d = corners
        region = patch(line(a, b), line(d, c), line(a, d), line(b, c))
        mesh.block(body, slab(region, 1.0), (*divisions, 1), YOUNG)
    quad("root", [(0, 0), (10, 0), (10, 20), (0, 20)], (8, graded(1.0, 4.0, 20)))
    quad("root", [(0, -10), (20, -10), (10, 0), (0, 0)], (8, cells))
    quad("root", [(0, -20), (20, -20), (20, -10), (0, -10)], (8, 6))
    # The slot's flank begins after the root's and ends after it.
    quad("disc", [(22, -12), (60, -12), (60, 20), (11, -1)], (graded(1.0, 6.0, 40), cells + 2))
    quad("disc", [(22, -40), (60, -40), (60, -12), (22, -12)], (graded(1.0, 6.0, 40), 10))
    mesh.join()
    fixed = set(dofs(np.unique(mesh.bricks), 2))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 0] < 1e-6), 0))
    fixed |= set(dofs(np.flatnonzero(mesh.at[:, 0] > 60 - 1e-6), 0, 1))
    pull = mesh.load(mesh.faces("root", lambda at: at[:, 1] > 20 - 1e-6), np.array([0, PULL / 10, 0]))
    steps = [(share * pull, {}) for share in (0.5, 1.0, 0.5)]

    def flank(at):
        return abs(at[:, 0] + at[:, 1] - 10) < 1e-6
    return Part(mesh, {"flank": Zone(("root", flank), ("disc", flank), mu)}, sorted(fixed), steps)


def main():
    model = part()
    results = model.solve()
    for share, (result, _) in zip((0.5, 1.0, 0.5), results):
        force = model.pairs["flank"].resultant(result.zone("flank")).force
        normal, along = -(force[0] + force[1]) / np.sqrt(2), (force[0] - force[1]) / np.sqrt(2)
        counts = result.report
        print(f"pull {share * PULL:.0f} N: {counts.pairs_open} pairs open, {counts.pairs_slipping} slip, "
              f"{counts.pairs_sticking} stick; friction over normal force {along / normal:+.3f}")
        told("  F = (N + T) / sqrt(2), N", (normal + along) / np.sqrt(2), share * PULL, 1e-6, "equilibrium")
        if counts.pairs_sticking == 0:
            told("  normal force of the flank, N", normal, np.sqrt(2) * share * PULL / (1 + MU), 1e-6, "statics")
    model.write("dovetail")


if __name__ == "__main__":
    main()
