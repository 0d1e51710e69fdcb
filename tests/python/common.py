"""Parts that the tests of the Python package share: the package itself, and small problems."""

import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
PYTHON = os.path.join(ROOT, "c_examples", "python")
sys.path[:0] = [PYTHON, os.path.join(ROOT, "c_examples", "bar")]

# Two pairs of the README's first program.
K = np.array([[4, 1, -1, 0], [1, 4, 0, -1], [-1, 0, 4, 1], [0, -1, 1, 4]])
LOAD = [2, 1.5, 3, 0.5]


def text(*parts):
    with open(os.path.join(ROOT, *parts), encoding="utf-8") as file:
        return file.read()


def chain(pairs=60):
    """K of a long chain, on which slow methods take long, and a load."""
    K = np.kron(2 * np.eye(pairs) - np.eye(pairs, k=1) - np.eye(pairs, k=-1), np.eye(2))
    return K, np.tile([1.0, 0.5], pairs)
