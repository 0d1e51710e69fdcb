"""The Python package: bodies of revolution. A rigid paraboloid on an elastic half space, against Hertz.

    python3 tests/python/rings.py
"""

import os
import sys
import unittest

import numpy as np

from common import ROOT

import signorini

sys.path.insert(0, os.path.join(ROOT, "c_examples", "parts"))
from bricks import GAUSS, graded  # noqa: E402

YOUNG, POISSON, RADIUS, CONTACT = 1000.0, 0.3, 40.0, 1.0
PLACES = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]])


def shapes(at):
    """The shape functions of a quadrilateral of 8 nodes and their derivatives, (8,) and (8, 2)."""
    def values(at):
        factor = 1 + PLACES * at
        corner = factor.prod(axis=1) * ((PLACES * at).sum(axis=1) - 1) / 4
        middle = np.where(PLACES == 0, 1 - at ** 2 + 0 * PLACES, factor).prod(axis=1) / 2
        return np.where((PLACES == 0).any(axis=1), middle, corner)
    slopes = [values(at + 1e-30j * axis).imag / 1e-30 for axis in np.eye(2)]
    return values(at), np.stack(slopes, axis=1)


def mesh(line, depth):
    """Nodes, (n, 2), r and z, and elements of a cylinder below z = 0."""
    r, z = (np.interp(np.arange(2 * len(at) - 1) / 2, np.arange(len(at)), at) for at in (line, -depth[::-1]))
    number = np.full((len(r), len(z)), -1)
    wanted = ~np.logical_and.outer(np.arange(len(r)) % 2 == 1, np.arange(len(z)) % 2 == 1)
    number[wanted] = np.arange(wanted.sum())
    i, j = np.meshgrid(2 * np.arange(len(line) - 1) + 1, 2 * np.arange(len(depth) - 1) + 1, indexing="ij")
    elements = np.stack([number[i + a, j + b] for a, b in PLACES], axis=-1).reshape(-1, 8)
    return np.column_stack([r[np.nonzero(wanted)[0]], z[np.nonzero(wanted)[1]]]), elements, number[:, -1]


def stiffness(at, elements):
    """Of whole rings, (data, indices, indptr)."""
    shear = YOUNG / 2 / (1 + POISSON)
    law = np.full((4, 4), 2 * shear * POISSON / (1 - 2 * POISSON))
    law[3], law[:, 3] = 0, 0
    law += shear * np.diag([2, 2, 2, 1])
    K = np.zeros((len(elements), 16, 16))
    for a, b in np.ndindex(3, 3):
        value, slope = shapes(np.array([GAUSS[0][a], GAUSS[0][b]]))
        jacobian = np.einsum("nk,mni->mki", slope, at[elements])
        gradient = np.einsum("mik,nk->mni", np.linalg.inv(jacobian), slope)
        radius = at[elements, 0] @ value
        strain = np.zeros((len(elements), 4, 8, 2))
        strain[:, 0, :, 0] = strain[:, 3, :, 1] = gradient[:, :, 0]
        strain[:, 1, :, 1] = strain[:, 3, :, 0] = gradient[:, :, 1]
        strain[:, 2, :, 0] = value / radius[:, None]
        strain = strain.reshape(-1, 4, 16)
        weight = GAUSS[1][a] * GAUSS[1][b] * np.linalg.det(jacobian) * 2 * np.pi * radius
        K += np.einsum("m,mai,ab,mbj->mij", weight, strain, law, strain, optimize=True)
    dof = (2 * elements[:, :, None] + [0, 1]).reshape(-1, 16)
    rows, columns = np.repeat(dof, 16, axis=1).ravel(), np.tile(dof, 16).ravel()
    size = 2 * len(at)
    entry, place = np.unique(columns * size + rows, return_inverse=True)
    return np.bincount(place.ravel(), K.ravel()), entry % size, np.searchsorted(entry, size * np.arange(size + 1))


class Hertz(unittest.TestCase):
    def test_a_paraboloid_on_a_half_space(self):
        """Twenty elements of 3 nodes along the radius of the contact. Of the force that is found Hertz gives the radius
        and the largest pressure; the square of the pressure falls in proportion to that of the radius."""
        cell, wide = CONTACT / 20, 40 * CONTACT
        near = np.arange(0, 1.4 * CONTACT + cell / 2, cell)
        line = np.concatenate([near[:-1], near[-1] + (wide - near[-1]) * graded(cell, 4.0, wide - near[-1])])
        at, elements, top = mesh(line, line)
        fixed = np.concatenate([2 * np.flatnonzero(at[:, 0] == 0), 2 * np.flatnonzero(at[:, 0] == wide),
                                2 * np.flatnonzero(at[:, 1] == -wide) + 1])
        inner = top[at[top, 0] < 1.4 * CONTACT - cell / 2]
        faces = np.column_stack([inner[2::2], inner[:-2:2], inner[1:-1:2]])
        contact = signorini.pair_obstacle(at, faces, signorini.Plane([0, 0], [0, -1]), axisymmetric=True)
        model = signorini.Model.from_surfaces(stiffness(at, elements), contact, fixed=fixed)
        depth = CONTACT ** 2 / RADIUS
        r = contact.points[:, 0]
        result = model.solve(np.zeros(2 * len(at)), gap=r ** 2 / (2 * RADIUS) - depth, mu=0.0)
        self.assertIs(result.status, signorini.Status.SOLVED)
        force = -result.F[:, 0].sum()
        pressure = -result.F[:, 0] / contact.areas
        module = YOUNG / (1 - POISSON ** 2)
        radius = (3 * force * RADIUS / (4 * module)) ** (1 / 3)
        largest = 3 * force / (2 * np.pi * radius ** 2)
        inside = (r > 0.1 * radius) & (r < 0.9 * radius)
        slope, top_squared = np.polyfit(r[inside] ** 2, pressure[inside] ** 2, 1)
        self.assertLess(abs(np.sqrt(-top_squared / slope) / radius - 1), 0.005)
        self.assertLess(abs(np.sqrt(top_squared) / largest - 1), 0.005)
        exact = largest * np.sqrt(1 - (r[inside] / radius) ** 2)
        self.assertLess(np.linalg.norm(pressure[inside] - exact) / np.linalg.norm(exact), 0.02)
        print(f"radius off by {100 * (np.sqrt(-top_squared / slope) / radius - 1):.3f} %, largest pressure by "
              f"{100 * (np.sqrt(top_squared) / largest - 1):.3f} %")


if __name__ == "__main__":
    unittest.main()
