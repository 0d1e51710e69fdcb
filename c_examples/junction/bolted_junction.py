#!/usr/bin/env python3
"""Draws the bolted junction (the paper's figure 3) from what bolted_junction.c has computed.

    sh c_examples/junction.sh OUT
    python3 c_examples/junction/bolted_junction.py OUT      writes OUT/bolted_junction.png

Needs numpy and matplotlib (which brings PIL). mu = 0.3, closed and under the largest inner
pressure: the mesh with displacements times 100, level curves of the axial stress, and the state of
each contact pair.
"""

import csv
import io
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.tri import Triangulation
from PIL import Image

MU = "0.3"
SCALE = 100
PANELS = [("closing", "closed by 678.6 kN"), ("p40", "the same and 40 MPa inside")]
STATES = {
    "open": {"marker": "o", "facecolor": "white", "edgecolor": "black"},
    "slip": {"marker": "^", "facecolor": "gold", "edgecolor": "black"},
    "stick": {"marker": "s", "facecolor": "black", "edgecolor": "white"},
}


def read_vtk(path):
    """Points, quadrilaterals, displacements and axial stress of a legacy VTK file."""
    with open(path, encoding="ascii") as file:
        file.readline()
        file.readline()
        words = iter(file.read().split())

    def numbers(count, kind=float):
        return np.array([kind(next(words)) for _ in range(count)])

    points = quads = displacements = stress = None
    size = 0
    for word in words:
        if word == "POINTS":
            size = int(next(words))
            next(words)
            points = numbers(3 * size).reshape(size, 3)[:, :2]
        elif word == "CELLS":
            count = int(next(words))
            next(words)
            quads = numbers(5 * count, int).reshape(count, 5)[:, 1:]
        elif word == "VECTORS":
            next(words), next(words)
            displacements = numbers(3 * size).reshape(size, 3)[:, :2]
        elif word == "sigma_zz":  # at the nodes
            for _ in range(4):  # double 1 LOOKUP_TABLE default
                next(words)
            stress = numbers(size)
    return points, quads, displacements, stress


def read_pairs(path, step):
    with open(path, encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    return [row for row in rows if row["step"] == step and float(row["mu"]) == float(MU)]


def draw(axes, out, step, title, levels):
    points, quads, displacements, stress = read_vtk(
        os.path.join(out, f"junction_mu{MU}_{step}.vtk")
    )
    moved = points + SCALE * displacements
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    triangulation = Triangulation(moved[:, 0], moved[:, 1], triangles)

    filled = axes.tricontourf(triangulation, stress, levels, cmap="Spectral_r", extend="both")
    axes.tricontour(triangulation, stress, levels, colors="black", linewidths=0.3)
    axes.add_collection(
        PolyCollection(moved[quads], facecolors="none", edgecolors="#00000040", linewidths=0.25)
    )
    draw_outline(axes, points, quads, "0.35", 0.6, (0, (4, 3)))
    draw_outline(axes, moved, quads, "black", 0.9, "-")

    height = {1: 120.0, 2: 150.0, 3: 150.0}
    for state, style in STATES.items():
        at = []
        for row in read_pairs(os.path.join(out, "bolted_junction.csv"), step):
            if row["state"] == state:
                # The nodes of a pair are at the same point; draw halfway between where they are.
                node = np.flatnonzero(
                    (np.abs(points[:, 0] - float(row["r"])) < 1e-6)
                    & (np.abs(points[:, 1] - height[int(row["zone"])]) < 1e-6)
                )
                at.append(moved[node].mean(axis=0))
        if at:
            at = np.array(at)
            axes.scatter(at[:, 0], at[:, 1], s=15, linewidth=0.5, zorder=5, **style)

    for name, at in (("A", (50, 20)), ("B", (20, 136)), ("C", (110, 158))):
        axes.text(*at, name, ha="center", va="center", fontsize=12, weight="bold")
    # Loads: the closing pressure on the ring and under the flange, and the pressure inside.
    style = {"arrowstyle": "-|>", "lw": 0.8, "color": "black", "mutation_scale": 7}
    for r in (82, 86, 90, 94, 98):
        axes.annotate("", (r, 165), (r, 173), arrowprops=style)
        axes.annotate("", (r, 80), (r, 72), arrowprops=style)
    if step.startswith("p"):
        for z in range(8, 120, 16):
            axes.annotate("", (40, z), (32, z), arrowprops=style)
        for r in (4, 14, 24, 34):
            axes.annotate("", (r, 129 - r**2 / 500), (r, 121 - r**2 / 500), arrowprops=style)

    axes.set_title(f"$\\mu$ = {MU}: {title}", fontsize=10)
    axes.set_aspect("equal")
    axes.set_xlim(-3, 126)
    axes.set_ylim(-4, 178)
    axes.set_xlabel("r, mm")
    return filled


def draw_outline(axes, points, quads, color, width, style):
    """The edges that only one element has."""
    edges = np.vstack([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    _, first, count = np.unique(
        np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True
    )
    for a, b in edges[first[count == 1]]:
        axes.plot(points[[a, b], 0], points[[a, b], 1], color=color, lw=width, ls=style)


def save(figure, path):
    """With few colours, which makes a small file."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110)
    image = Image.open(buffer).convert("RGB")
    image = image.quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    image.save(path, optimize=True)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python3 bolted_junction.py OUT")
    out = sys.argv[1]
    levels = np.arange(-80, 81, 10)

    figure, panels = plt.subplots(1, 2, figsize=(9.2, 6.4), sharey=True, layout="constrained")
    try:
        for axes, (step, title) in zip(panels, PANELS):
            filled = draw(axes, out, step, title, levels)
    except FileNotFoundError as error:
        sys.exit(f"{error.filename} is missing: run sh c_examples/junction.sh {out} first")
    panels[0].set_ylabel("z, mm")
    bar = figure.colorbar(filled, ax=panels, shrink=0.9, aspect=35, pad=0.01, ticks=levels[::2])
    bar.set_label("axial stress $\\sigma_{zz}$, MPa")
    handles = [
        plt.Line2D(
            [], [], ls="", ms=5, mew=0.5, marker=style["marker"], label=state,
            mfc=style["facecolor"], mec=style["edgecolor"],
        )
        for state, style in STATES.items()
    ]
    panels[0].legend(
        handles=handles, title="contact pairs", loc="lower right", fontsize=9, title_fontsize=9
    )
    panels[1].text(
        0.98, 0.02, f"displacements × {SCALE}", transform=panels[1].transAxes, ha="right",
        fontsize=9,
    )
    save(figure, os.path.join(out, "bolted_junction.png"))


if __name__ == "__main__":
    main()
