"""The Python package: sectors and periods in coordinates of few digits, as decks have, and boundaries that do not match.

    python3 tests/python/sectors.py
"""

import unittest
import warnings

import numpy as np

from common import ROOT  # noqa: F401

import signorini

SECTORS = 7
ANGLE = 2 * np.pi / SECTORS


def rounded(places, digits):
    """Places in so many digits behind the point, or with a minus in so many digits of each number, as an exponent has them."""
    if digits is None or digits > 0:
        return places if digits is None else np.round(places, digits)
    return np.array([[float(f"{x:.{-digits - 1}e}") for x in place] for place in places])


def lattice(counts, place, cells_at=lambda corner: True):
    """Nodes and cells of a lattice of boxes, in the plane quadrilaterals."""
    steps = np.stack(np.meshgrid(*[np.arange(count + 1) for count in counts], indexing="ij"), -1)
    number = np.arange(steps[..., 0].size).reshape(steps.shape[:-1])
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if len(counts) == 3:
        corners = [(*corner, up) for up in (0, 1) for corner in corners]
    cells = np.stack([number[tuple(slice(at, at + count) for at, count in zip(corner, counts))].ravel() for corner in corners], 1)
    return np.array([place(*step) for step in (steps / np.array(counts)).reshape(-1, len(counts))]), cells


def stiffness(places, cells):
    """Springs between all corners of each cell, which hold its shape, and softer ones to the ground."""
    size, dim = places.size, places.shape[1]
    K = np.zeros((size, size))
    for cell in cells:
        for k, a in enumerate(cell):
            own = dim * a + np.arange(dim)
            K[own, own] += 0.01
            for b in cell[:k]:
                along = places[a] - places[b]
                ends = np.concatenate([along, -along]) / np.linalg.norm(along)
                dofs = np.concatenate([dim * a + np.arange(dim), dim * b + np.arange(dim)])
                K[np.ix_(dofs, dofs)] += np.outer(ends, ends)
    rows, columns = np.nonzero(K.T)[::-1]
    return K[rows, columns], rows, np.searchsorted(columns, np.arange(size + 1))


def turned(places, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([places[:, :2] @ np.array([[c, s], [-s, c]]), places[:, 2:]])


class Rings(unittest.TestCase):
    """A ring on a hub of frames, whose boundaries are curved, and not at the same angles."""

    def bodies(self, count, lean):
        """Places, cells and sides of so many sectors; in the whole nodes at one place are one."""
        places, cells, sides, shares = [], [], [], []
        for radii, steps, start in (((1.0, 1.37), 3, 0.12), ((0.6, 1.0), 4, 0.05)):
            def place(along, out, radii=radii, start=start):
                r = radii[0] + out * (radii[1] - radii[0])
                angle = start + ANGLE * along + lean * np.sin(5 * r)
                return 123.4 * r * np.cos(angle), 123.4 * r * np.sin(angle)
            part, of_part = lattice((steps, 2), place)
            whole, all_cells = part, of_part
            if count > 1:
                copies = np.concatenate([turned(part, k * ANGLE) for k in range(count)])
                _, first, same = np.unique(np.round(copies, 6), axis=0, return_index=True, return_inverse=True)
                whole = copies[first]
                all_cells = same.ravel()[np.concatenate([of_part + k * len(part) for k in range(count)])]
            faces = [[a, b] for cell in all_cells for a, b in zip(cell, np.roll(cell, -1))
                     if (abs(np.hypot(*whole[[a, b]].T) - 123.4) < 1e-6).all()]
            before = sum(map(len, places))
            places.append(whole)
            cells.append(all_cells + before)
            sides.append([[a + before, b + before] for a, b in faces])
        bodies = np.repeat([0, 1], [len(x) for x in places])
        return np.concatenate(places), np.concatenate(cells), sides, bodies

    def solved(self, places, cells, sides, bodies, sector, exact):
        """Displacements under loads that repeat: the ring is pressed, shrunk and dragged, the hub held inside."""
        radii, angles = np.hypot(*exact.T) / 123.4, np.arctan2(exact[:, 1], exact[:, 0])
        # Loads go with the cells of each node, of which a boundary has a part.
        cells_at = np.bincount(cells.ravel(), minlength=len(places))
        along = np.stack([-np.sin(angles), np.cos(angles)], 1)
        load = np.where(radii > 1.2, 0.01 * cells_at * (1 + 0.5 * np.sin(SECTORS * angles)), 0)[:, None]
        load = load * (0.05 * along - np.stack([np.cos(angles), np.sin(angles)], 1))
        held = np.flatnonzero(np.repeat(radii < 0.61, 2))
        equations = None if sector is None else signorini.sector_equations(places, sector, bodies=bodies)
        dependent = {equation[0] for equation in equations or ()}
        contact = signorini.pair_surfaces(places, *sides, sector=sector)
        model = signorini.Model.from_surfaces(stiffness(places, cells), contact, equations=equations,
                                              fixed=[dof for dof in held if dof not in dependent])
        result = model.solve(load.ravel(), gap=-0.1, mu=0.5)
        self.assertEqual(result.status, signorini.Status.SOLVED)
        self.assertTrue((result.F[:, 0] < 0).all())
        return model.recover(result.d, load.ravel()).reshape(-1, 2), contact

    def test_digits_of_decks(self):
        """The solution of the whole, but for what a change of its places by the last digit changes it."""
        sector = signorini.Sector(SECTORS, (0.0, 0.0))
        for lean in (0.0, 0.1):
            whole, part = self.bodies(SECTORS, lean), self.bodies(1, lean)
            u, _ = self.solved(*whole, None, whole[0])
            same = [np.flatnonzero((np.linalg.norm(whole[0] - x, axis=1) < 1e-6) & (whole[3] == body))[0]
                    for x, body in zip(part[0], part[3])]
            largest = abs(u).max()
            for digits in (None, 6, 5, 4, 3, 2, -8, -7, -6, -5):
                with self.subTest(lean=lean, digits=digits), warnings.catch_warnings():
                    warnings.simplefilter("error")
                    places = rounded(part[0], digits)
                    found, contact = self.solved(places, *part[1:], sector, part[0])
                    self.assertEqual(contact.pairs, 3)
                    off = abs(places - part[0]).max()
                    # Bars of 20 and more turn by off / 20, and gaps change by off, each by a few times.
                    self.assertLess(abs(found - u[same]).max(), 10 * off + 1e-9 * largest)

    def test_a_pairing_of_two_zones(self):
        """Half rows of two zones are told in few digits too."""
        places, _, (ring, hub), bodies = self.bodies(1, 0.1)
        zones = {name: signorini.pair_surfaces(np.round(places, 2), faces, hub, sector=(SECTORS, (0.0, 0.0)))
                 for name, faces in (("first", ring[:2]), ("second", ring[2:]))}
        springs = np.ones(places.size), np.arange(places.size), np.arange(places.size + 1)
        equations = signorini.sector_equations(np.round(places, 2), signorini.Sector(SECTORS, (0.0, 0.0)), bodies=bodies)
        with self.assertRaisesRegex(signorini.SignoriniError, "zone 'first' and node .* are images of each other"):
            signorini.Model.from_surfaces(springs, zones, equations=equations)


class Partners(unittest.TestCase):
    """Nodes of a wedge, and of a part of a strip, whose boundaries are flat or not."""

    def wedge(self, lean=0.0, counts=(4, 3, 3)):
        def place(out, along, up):
            r, angle = 1 + out, ANGLE * along + lean * np.sin(3 * out) * np.cos(2 * up)
            return r * np.cos(angle), r * np.sin(angle), up
        places, _ = lattice(counts, place)
        steps = np.stack(np.meshgrid(*[np.arange(count + 1) for count in counts], indexing="ij"), -1).reshape(-1, 3)
        return places, steps

    def test_one_node_that_was_moved(self):
        sector = signorini.Sector(SECTORS, (0.0, 0.0, 0.0))
        for lean in (0.0, 0.3):
            places, steps = self.wedge(lean)
            boundary = np.flatnonzero(steps[:, 1] == 3)
            self.assertEqual(len(signorini.sector_equations(places, sector)), 3 * len(boundary))
            opposite = {tuple(steps[node]): node for node in range(len(steps))}
            for node in boundary:
                first = opposite[(steps[node, 0], 0, steps[node, 2])]
                for moved in (node, first):
                    off = places.copy()
                    off[moved, 2] += 0.05  # of a distance of a third between nodes
                    named = f"the image of node {first} misses node {node} by 0.05, turned by one of {SECTORS} sectors"
                    with self.assertRaisesRegex(ValueError, named + ".*: mesh the two boundaries alike"):
                        signorini.sector_equations(off, sector)
                    self.assertEqual(len(signorini.sector_equations(off, sector, bodies=-1 * np.isin(
                        np.arange(len(off)), [node, first]))), 3 * len(boundary) - 3)

    def test_nodes_of_one_boundary_alone(self):
        """A flat boundary with more nodes than the other, far from all: in another body nothing is said of them."""
        sector = signorini.Sector(SECTORS, (0.0, 0.0, 0.0))
        places, _ = self.wedge()
        for angle, on in ((0, "misses"), (ANGLE, "misses")):
            more = np.vstack([places, [1.6 * np.cos(angle), 1.6 * np.sin(angle), 0.5]])
            with self.assertRaisesRegex(ValueError, f"of the nodes in a boundary 1, such as node {len(places)}, .* {on}"):
                signorini.sector_equations(more, sector)
            found = signorini.sector_equations(more, sector, bodies=1 * (np.arange(len(more)) == len(places)))
            self.assertEqual(len(found), 60)
        # A body that reaches beyond the planes of another one ends elsewhere.
        beside = np.vstack([places, turned(places + [2, 0, 0], -0.5 * ANGLE)])
        bodies = 1 * (np.arange(len(beside)) >= len(places))
        for given in (bodies, None):
            self.assertGreaterEqual(len(signorini.sector_equations(beside, sector, bodies=given)), 60)

    def test_a_period_of_few_digits(self):
        """Of a number that is added to each place digits are cut anew."""
        places, _ = lattice((3, 4), lambda x, y: (x + 0.1 * y * y, 0.7 * y))
        period = signorini.Period((1.0, 0.0))
        for digits in (None, 6, 5, 4):
            self.assertEqual(len(signorini.sector_equations(rounded(places + 1 / 3, digits), period)), 10)
        places[4, 1] += 0.04
        with self.assertRaisesRegex(ValueError, r"the image of node \d+ misses node \d+ by 0.04, shifted by .1. 0.., a way"):
            signorini.sector_equations(places, period)

    def test_gaps_between_neighbours_stay(self):
        """A gap that is more than the last digit is no boundary: balls side by side, and a shroud that another one faces."""
        places, _ = lattice((4, 4), lambda x, y: (0.9998 * x, y + 0.123456 * x * (1 - x)))
        with self.assertRaisesRegex(ValueError, "no node is the image of another, .*; the image of node"):
            signorini.sector_equations(places, signorini.Period((1.0, 0.0)))

    def test_a_part_far_from_the_axis(self):
        """Digits count from the coordinates, not from the size of the part."""
        def place(out, along, up):
            angle = 2 * np.pi / 61 * along
            return (50 + out) * np.cos(angle), (50 + out) * np.sin(angle), up
        places, _ = lattice((3, 4, 2), place)
        for digits in (None, -8, -7, -6, -5):
            found = signorini.sector_equations(rounded(places, digits), signorini.Sector(61, (0.0, 0.0, 0.0)))
            self.assertEqual(len(found), 36)

    def test_little_digits_are_told(self):
        """Nodes so near to each other that the last digit is more than a hundredth of their distance."""
        places, _ = lattice((200, 3), lambda out, along: (
            (1 + 0.4 * out) * np.cos(ANGLE * along), (1 + 0.4 * out) * np.sin(ANGLE * along)))
        sector = signorini.Sector(SECTORS, (0.0, 0.0))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(len(signorini.sector_equations(np.round(places, 6), sector)), 402)
        with self.assertWarnsRegex(UserWarning, r"the image of node \d+ misses node \d+ by .* alone, give coordinates with more digits"):
            self.assertEqual(len(signorini.sector_equations(np.round(places, 4), sector)), 402)


if __name__ == "__main__":
    unittest.main()
