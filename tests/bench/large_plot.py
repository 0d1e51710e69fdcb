"""How large models grow: a table and a picture of the reductions in large.csv, which large.sh writes.

    python3 tests/bench/large_plot.py OUT/large.csv OUT/large.png

The table goes to standard output: CPU seconds and peak memory of each reduction against the unknowns, and the
exponents from one size to the next. Of a library that ran with several kernels of its BLAS the fastest run counts.
The case "bar" is left out, since its contact line is longer than that of the others, and cubes with a part of their face
in contact (26-67). The picture needs matplotlib.
"""

import csv
import math
import sys

NAMES = {
    "signorini": "signorini, condensed matrix",
    "mumps": "MUMPS, Schur complement",
    "cholmod": "CHOLMOD, the factor alone",
}


def read(path):
    """The fastest run of each dimension, library and size: {(dim, library): {unknowns: (seconds, megabytes)}}."""
    lines = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            in_part = row["dim"] == "3" and "-" in row["case"]
            if row["step"] not in ("reduce", "factor") or row["case"] == "bar" or in_part:
                continue
            line = lines.setdefault((int(row["dim"]), row["library"]), {})
            size, cost = int(row["unknowns"]), (float(row["cpu_s"]), float(row["peak_mb"]))
            line[size] = min(cost, line.get(size, cost))
    return {key: dict(sorted(line.items())) for key, line in sorted(lines.items())}


def table(lines):
    """A table in Markdown."""
    print("| | unknowns | CPU s | grows as n to the | peak MB | grows as n to the |")
    print("|---|--:|--:|--:|--:|--:|")
    for (dim, library), line in lines.items():
        before = None
        for size, cost in line.items():
            exponents = ["", ""]
            if before:
                ratio = math.log(size / before[0])
                exponents = [f"{math.log(b / a) / ratio:.2f}" for a, b in zip(before[1], cost)]
            print(f"| {dim}D {library} | {size} | {cost[0]:.2f} | {exponents[0]} | {cost[1]:.0f} | {exponents[1]} |")
            before = size, cost


def picture(lines, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    dims = sorted({dim for dim, _ in lines})
    figure, rows = plt.subplots(2, len(dims), figsize=(4.6 * len(dims), 6.4), squeeze=False, sharex="col")
    for column, dim in enumerate(dims):
        for row, label in enumerate(["CPU time of the reduction, s", "peak memory, MB"]):
            axes = rows[row][column]
            for (of, library), line in lines.items():
                if of == dim:
                    costs = [cost[row] for cost in line.values()]
                    axes.loglog(list(line), costs, "o-", label=NAMES.get(library, library))
            axes.grid(True, which="both", linewidth=0.3)
            axes.set_ylabel(label)
        rows[0][column].set_title(f"{dim}D, one line of contact" if dim == 2 else f"{dim}D, one face of contact")
        rows[0][column].legend(fontsize=8)
        rows[1][column].set_xlabel("unknowns")
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main(words):
    if len(words) != 2:
        sys.exit("usage: python3 tests/bench/large_plot.py large.csv large.png")
    lines = read(words[0])
    if not lines:
        sys.exit(f"{words[0]} has no reduction: run sh tests/bench/large.sh first")
    table(lines)
    try:
        picture(lines, words[1])
    except ImportError:
        print("large_plot: no picture without matplotlib", file=sys.stderr)


main(sys.argv[1:])
