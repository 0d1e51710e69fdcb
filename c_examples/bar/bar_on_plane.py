#!/usr/bin/env python3
"""Draws the bar on the plane: what bar_on_plane.c has computed and the paper's Table 1, and how the
zones of contact depend on friction, which it computes by the Python package.

    sh c_examples/replay.sh OUT
    python3 c_examples/bar/bar_on_plane.py OUT      writes two pictures, OUT/bar_on_plane.png
                                                    and OUT/bar_friction.png

Needs numpy and matplotlib.
"""

import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

sys.dont_write_bytecode = True  # what is built goes to target/
# The package is in c_examples/python.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import bar_mesh  # noqa: E402
import signorini  # noqa: E402

# Table 1 of F. Lebon, M. Raous, D. Boulegues, "Contact with friction modeling for the study of a
# bolted junction", nodes 1 to 32: u^t, F^n, F^t; displacements in mm, forces in daN for 1 mm. What
# the paper has as small as 1e-27 is 0 here.
TABLE = np.array([
    [14.7e-3, 0.000333, -0.00214],
    [13.7e-3, 0.000195, -0.000395],
    [12.8e-3, 0.000138, -0.000504],
    [11.8e-3, -1.16, -1.16],
    [10.7e-3, -2.16, -2.16],
    [9.68e-3, -2.84, -2.83],
    [8.65e-3, -3.4, -3.4],
    [7.65e-3, -3.87, -3.87],
    [6.67e-3, -4.29, -4.29],
    [5.76e-3, -4.66, -4.66],
    [4.87e-3, -5.01, -5.01],
    [4.03e-3, -5.33, -5.33],
    [3.24e-3, -5.64, -5.64],
    [2.5e-3, -5.95, -5.95],
    [1.82e-3, -6.27, -6.27],
    [1.2e-3, -6.61, -6.61],
    [0.667e-3, -6.99, -6.99],
    [0.244e-3, -7.5, -7.5],
    [0.0, -8.16, -7.61],
    [0.0, -8.59, -8.07],
    [0.0, -8.68, -8.33],
    [0.0, -8.75, -8.73],
    [0.0, -8.8, -8.23],
    [0.0, -8.87, -2.79],
    [0.0, -8.9, -2.41],
    [0.0, -8.94, -2.06],
    [0.0, -8.96, -1.73],
    [0.0, -8.99, -1.41],
    [0.0, -9.01, -1.11],
    [0.0, -9.04, -0.827],
    [0.0, -9.04, -0.542],
    [0.0, -9.07, -0.26],
])

# Wrong digits of the text that we have, corrected by meshes fitted to all other entries: node, F^t.
CORRECTIONS = {20: -5.07, 21: -4.33, 22: -3.73, 23: -3.23}

COLORS = {"open": "#e8f1fa", "slip": "#fff3cf", "stick": "#e9e9e9"}


def read(path):
    with open(path, encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {key: np.array([float(row[key]) for row in rows]) for key in ("x", "ut", "Fn", "Ft")}
    return columns, [row["state"] for row in rows]


def shade(axes, x, states):
    """Marks the zones; each reaches halfway to the next pair of another state."""
    begin, half = 0, (x[1] - x[0]) / 2
    for i in range(1, len(x) + 1):
        if i == len(x) or states[i] != states[begin]:
            left, right = max(x[begin] - half, x[0]), min(x[i - 1] + half, x[-1])
            axes.axvspan(left, right, color=COLORS[states[begin]], lw=0, zorder=0)
            axes.text(
                (left + right) / 2, 1.02, states[begin], ha="center", fontsize=9,
                transform=axes.get_xaxis_transform(),
            )
            begin = i


def draw_table(out):
    try:
        computed, states = read(os.path.join(out, "bar_on_plane.csv"))
    except FileNotFoundError as error:
        sys.exit(f"{error.filename} is missing: run sh c_examples/replay.sh {out} first")
    x = computed["x"]
    table_x = x[: len(TABLE)]
    fixed = np.array([CORRECTIONS.get(node + 1, row[2]) for node, row in enumerate(TABLE)])
    changed = fixed != TABLE[:, 2]

    figure, (forces, slip) = plt.subplots(
        2, 1, figsize=(7.4, 6.6), sharex=True, layout="constrained", height_ratios=[3, 2]
    )
    for key, column, color, name in (("Fn", 1, "C0", "$F^n$"), ("Ft", 2, "C3", "$F^t$")):
        forces.plot(x, -computed[key], color=color, lw=1.4, label=f"{name} computed")
        read_as = fixed if column == 2 else TABLE[:, column]
        forces.plot(
            table_x, -read_as, "o", color=color, ms=4.5, mfc="none", label=f"{name} of Table 1"
        )
    forces.plot(
        table_x[changed], -TABLE[changed, 2], "x", color="0.4", ms=5,
        label="$F^t$ as printed, with a wrong digit",
    )
    forces.set_ylabel("pressing force $-F^n$ and friction $-F^t$,\ndaN for 1 mm of thickness")
    forces.set_ylim(0, 10)
    forces.legend(fontsize=9, loc="upper left", framealpha=0.9)
    forces.set_title("Bar on a plane, $\\mu$ = 1: from the free corner to the symmetry plane\n",
                     fontsize=10)

    slip.plot(x, 1e3 * computed["ut"], color="C2", lw=1.4, label="$u^t$ computed")
    slip.plot(table_x, 1e3 * TABLE[:, 0], "o", color="C2", ms=4.5, mfc="none",
              label="$u^t$ of Table 1")
    slip.set_ylabel("tangential displacement $u^t$, µm")
    slip.set_xlabel("x, mm")
    slip.legend(fontsize=9)
    slip.set_xlim(x[0], x[-1])
    for axes in (forces, slip):
        shade(axes, x, states)
        axes.grid(color="0.85", lw=0.5)
    figure.savefig(os.path.join(out, "bar_on_plane.png"), dpi=100)


def draw_friction(out):
    """Every coefficient from 0 to 2 is a load case of one model."""
    bar = bar_mesh.assemble()
    model = signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held)
    mu = np.linspace(0.0, 2.0, 401)
    results = model.solve(
        np.tile(bar.load, (len(mu), 1)), 0.0, np.tile(mu[:, None], model.pairs)
    )
    for value, result in zip(mu, results):
        if result.status != signorini.Status.SOLVED:
            sys.exit(f"mu = {value}: {result.message}")

    figure, (zones, forces) = plt.subplots(
        2, 1, figsize=(7.4, 6.6), sharex=True, layout="constrained"
    )
    x, half = bar.x, (bar.x[1] - bar.x[0]) / 2
    edges = np.clip(np.append(x - half, x[-1] + half), x[0], x[-1])
    zones.pcolormesh(
        edges, np.append(mu, mu[-1]), [result.state for result in results], vmin=0, vmax=2,
        cmap=ListedColormap(list(COLORS.values())), rasterized=True,
    )
    for at, name in (((1.6, 1.72), "open"), ((9.5, 0.9), "slip"), ((30.0, 1.1), "stick")):
        zones.text(*at, name, ha="center", fontsize=9)
    zones.set_ylabel("friction coefficient $\\mu$")
    zones.set_title("Bar on a plane: 401 friction coefficients, one model", fontsize=10)

    for value, color in ((0.2, "C0"), (0.5, "C2"), (1.0, "C3"), (2.0, "C1")):
        result = results[int(np.argmin(abs(mu - value)))]
        forces.plot(x, -result.F[:, 1], color=color, lw=1.4, label=f"$\\mu$ = {value:g}")
        zones.axhline(value, color=color, lw=0.8, ls=(0, (4, 3)))
    forces.set_ylabel("friction $-F^t$, daN for 1 mm of thickness")
    forces.set_xlabel("x, mm")
    forces.set_xlim(x[0], x[-1])
    forces.grid(color="0.85", lw=0.5)
    forces.legend(fontsize=9)
    figure.savefig(os.path.join(out, "bar_friction.png"), dpi=100)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python3 bar_on_plane.py OUT")
    draw_table(sys.argv[1])
    try:
        draw_friction(sys.argv[1])
    except signorini.SignoriniError as error:
        sys.exit(f"bar_friction.png: {error}")


if __name__ == "__main__":
    main()
