#!/usr/bin/env python3
"""Two blocks, the upper one held by nothing but contact and friction, pressed and then twisted more
and more: two_blocks.c in Python.

    cargo build --release
    python3 c_examples/3d/two_blocks.py [DIR]       with DIR, writes DIR/two_blocks.csv
                                                    and DIR/two_blocks.vtu

Needs numpy. It ends with 0 if the contact forces balance the loads.
"""

import os
import sys

import numpy as np

sys.dont_write_bytecode = True  # what is built goes to target/
# The package is in c_examples/python.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import brick_mesh  # noqa: E402
import signorini  # noqa: E402

MU = 0.6
TWISTS = [0.0, 100e3, 200e3, 300e3, 400e3]  # N mm
TINY = 1e-9  # rounding of sums of some hundred forces, relative


def resultant(at, force):
    """Sum of nodal forces (P, 3), and of their moments about the origin."""
    return np.concatenate([force.sum(axis=0), np.cross(at, force).sum(axis=0)])


def write_csv(path, at, result):
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,d_n,d_t1,d_t2,F_n,F_t1,F_t2,state\n")
        for place, d, F, state in zip(at, result.d, result.F, result.state):
            numbers = ",".join(f"{value:.12e}" for value in [*place[:2], *d, *F])
            file.write(f"{numbers},{signorini.State(state).name.lower()}\n")


def main():
    blocks = brick_mesh.two_blocks()
    contact = signorini.pair_surfaces(blocks.at, blocks.slave, blocks.master)
    model = signorini.Model.from_surfaces(blocks.matrix, contact, fixed=blocks.held)
    print(contact.summary)
    slip0, off = 0.0, 0.0
    print("twist, N m   open slip stick   M_z, N m       eta")
    for twist in TWISTS:
        load = blocks.press + twist * blocks.twist
        result = model.solve(load, gap=contact.gaps, mu=MU, slip0=slip0, tolerance=1e-12)
        if result.status != signorini.Status.SOLVED:
            sys.exit(f"twist of {twist} N mm: {result.message}")
        slip0 = result.d[:, 1:]  # friction remembers

        sums = contact.resultant(result)
        on_upper = np.concatenate([sums.force, sums.moment])
        applied = resultant(blocks.at, load.reshape(-1, 3))
        off = max(off, abs((on_upper + applied) / ([40e3] * 3 + [40e3 * 30.0] * 3)).max())
        counts = np.bincount(result.state, minlength=3)
        print(f"{twist / 1e3:10.0f} {counts[0]:6} {counts[1]:4} {counts[2]:5} "
              f"{on_upper[5] / 1e3:10.1f} {result.report.eta:9.0e}")
    print(f"contact forces balance the loads: off by {off:.0e}")
    if len(sys.argv) == 2:
        write_csv(os.path.join(sys.argv[1], "two_blocks.csv"), contact.points, result)
        contact.write(os.path.join(sys.argv[1], "two_blocks.vtu"), {"hexahedron": blocks.bricks},
                      result, model.recover(result.d, load))
    return 0 if off <= TINY else 1


if __name__ == "__main__":
    sys.exit(main())
