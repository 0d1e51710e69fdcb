#!/usr/bin/env python3
"""Draws two balls that are pressed and then shifted or twisted, from what hertz.c has computed.

    sh c_examples/3d.sh OUT
    python3 c_examples/3d/hertz.py OUT      writes OUT/hertz.png

Needs numpy and matplotlib (which brings PIL). For both load cases: the pressure, the direction in
which each pair slips, and the circle within which the closed form has the pairs stick.
"""

import csv
import io
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from PIL import Image

PANELS = [("shifted", "pressed and shifted along x"), ("twisted", "pressed and twisted about z")]
CONTACT, STICK = 1.0, 0.6  # radii a and c of the closed forms, mm
COLORS = ListedColormap(plt.get_cmap("YlOrRd")(np.linspace(0.03, 0.72, 128)))
VIEW = 1.22  # half of the side of what is drawn, mm


def read(path):
    """The pairs of a load case as a square of rows along x: a dictionary of arrays, and states."""
    with open(path, encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    side = round(len(rows) ** 0.5)
    names = [name for name in rows[0] if name != "state"]
    columns = {name: np.array([float(row[name]) for row in rows]).reshape(side, side)
               for name in names}
    return columns, np.array([row["state"] for row in rows]).reshape(side, side)


def draw(axes, pairs, state, title):
    x, y = pairs["x"], pairs["y"]
    cell = x[0, 1] - x[0, 0]
    pressure = -pairs["F_n"] / cell**2

    shown = axes.imshow(
        np.ma.masked_where(state == "open", pressure), cmap=COLORS, vmin=0, vmax=650,
        origin="lower", extent=[x.min() - cell / 2, x.max() + cell / 2] * 2,
        interpolation="nearest",
    )
    # Pressing alone leaves d_t = 0: what it is now is the slip of the lower ball.
    slip = state == "slip"
    along_x, along_y = -pairs["d_t1"][slip], -pairs["d_t2"][slip]  # the upper ball
    length = np.hypot(along_x, along_y)
    axes.quiver(
        x[slip], y[slip], along_x / length, along_y / length,
        pivot="mid", units="xy", scale=1 / (0.8 * cell), width=0.016, headwidth=4.5,
        headlength=5, headaxislength=4.5, color="#10304f", zorder=3,
    )
    stick, opened = state == "stick", state == "open"
    axes.plot(x[stick], y[stick], "s", ms=3.2, color="black", zorder=3)
    axes.plot(x[opened], y[opened], "o", ms=2.2, mfc="white", mec="0.65", mew=0.6, zorder=2)

    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    for radius, style in ((CONTACT, "-"), (STICK, (0, (4, 2)))):
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color="black", lw=1.1, ls=style)
    label = {"fontsize": 10, "ha": "center", "va": "center",
             "bbox": {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.5}}
    axes.text(0.0, 0.0, "stick", **label)
    axes.text(0.0, 0.8, "slip", **label)
    axes.text(0.97, 0.97, "open", **label)

    axes.set_title(title, fontsize=10.5)
    axes.set_aspect("equal")
    axes.set_xlim(-VIEW, VIEW)
    axes.set_ylim(-VIEW, VIEW)
    axes.set_xticks([-1, -0.5, 0, 0.5, 1])
    axes.set_yticks([-1, -0.5, 0, 0.5, 1])
    axes.set_xlabel("x, mm")
    return shown


def save(figure, path):
    """With few colours, which makes a small file."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110)
    image = Image.open(buffer).convert("RGB")
    image = image.quantize(128, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    image.save(path, optimize=True)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python3 hertz.py OUT")
    out = sys.argv[1]
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 4.9), sharey=True, layout="constrained")
    try:
        for axes, (name, title) in zip(panels, PANELS):
            shown = draw(axes, *read(os.path.join(out, f"hertz_{name}.csv")), title)
    except FileNotFoundError as error:
        sys.exit(f"{error.filename} is missing: run sh c_examples/3d.sh {out} first")
    panels[0].set_ylabel("y, mm")
    bar = figure.colorbar(shown, ax=panels, shrink=0.9, aspect=30, pad=0.01)
    bar.set_label("pressure, MPa")
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.935))  # room for the legend
    figure.legend(
        handles=[
            plt.Line2D([], [], color="black", lw=1.1, label="closed form: radius of contact"),
            plt.Line2D([], [], color="black", lw=1.1, ls=(0, (4, 2)),
                       label="closed form: radius of stick"),
            plt.Line2D([], [], ls="", marker=r"$\rightarrow$", ms=11, color="#10304f",
                       label="direction in which the upper ball slips"),
        ],
        loc="lower center", ncols=3, fontsize=9, frameon=False,
    )
    save(figure, os.path.join(out, "hertz.png"))


if __name__ == "__main__":
    main()
