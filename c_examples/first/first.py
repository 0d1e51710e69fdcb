"""A body touches a plane with two pairs, on numpy arrays."""

import os
import sys

import numpy as np

# The package is in c_examples/python. A program of yours may have it beside itself.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
import signorini  # noqa: E402

K = np.array([[4, 1, -1, 0], [1, 4, 0, -1], [-1, 0, 4, 1], [0, -1, 1, 4]], dtype=float)
f = np.array([2, 1.5, 3, 0.5])  # loads: > 0 in n presses on the obstacle
result = signorini.solve(K, f, gap=0.0, mu=0.3, tolerance=1e-12)
if result.status != signorini.Status.SOLVED:
    raise SystemExit(f"status {result.status}: {result.message}")
for i in range(2):
    d, F = result.d[i], result.F[i]
    name = signorini.State(result.state[i]).name.lower()
    print(f"pair {i + 1} {name:5} d_n {d[0]:.4f} d_t {d[1]:.4f}  F_n {F[0]:.4f} F_t {F[1]:.4f}")
