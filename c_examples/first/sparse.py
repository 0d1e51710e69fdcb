"""Two bars in a row along x, from a whole sparse matrix: bar A pushes on bar B across a gap.

    wall 0|--A--o1   gap   2o--B--|3 wall      node i has the degrees of freedom 2 i and 2 i + 1
"""

import os
import sys

import numpy as np

# The package is in c_examples/python. Where it is installed this line is not needed.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import signorini  # noqa: E402

# Each bar: 100 along x, 10 along y. Lower triangle by columns, rows ascending.
values = np.array([100, -100, 10, -10, 100, 10] * 2, dtype=float)
rows = np.array([0, 2, 1, 3, 2, 3, 4, 6, 5, 7, 6, 7])
starts = np.array([0, 2, 4, 5, 6, 8, 10, 11, 12])  # or a scipy.sparse matrix in their place

# One pair: node 1 faces node 2; its outward normal is x, so that its tangent is y.
model = signorini.Model.sparse((values, rows, starts), slaves=[[2, 3]], normals=[[1, 0]],
                               masters=[[[4, 5]]], fixed=[0, 1, 6, 7], triangle="lower")
f = np.array([0, 0, 30, 6, 0, 0, 0, 0.0])  # load on node 1
result = model.solve(f, gap=0.1, mu=0.2)
if result.status != signorini.Status.SOLVED:
    raise SystemExit(f"status {result.status}: {result.message}")
u = model.recover(result.d, f)
print(f"F_n {result.F[0, 0]:.4f} F_t {result.F[0, 1]:.4f}  "
      f"node 1 {u[2]:.4f} {u[3]:.4f}  node 2 {u[4]:.4f} {u[5]:.4f}")
