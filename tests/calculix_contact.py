"""CalculiX's contact beside the library's: the same meshes, matrix, supports and motions.

    python3 calculix_contact.py OUT

Two blocks whose nodes do not match, pressed and then shifted with friction, and a curved block on a
flat one (Hertz, a quarter, without friction). CalculiX writes its stiffness matrix, which the
library takes, pairs by dual mortar and solves; and CalculiX solves the same motions by its own
contact, surface to surface with a penalty. The forces between the bodies must agree to 1 %. CCX names
CalculiX, default ccx; all files go to OUT. Times are printed, not judged.
"""

import os
import pathlib
import resource
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "c_examples" / "python"))
import signorini  # noqa: E402

CCX = os.environ.get("CCX", "ccx")
AGREE = 0.01  # of the largest normal force; the penalty's penetration costs a tenth of it
PENALTY = 1000.0  # contact stiffness of CalculiX over Young's modulus and a block's height


class Mesh:
    """Blocks of 8-node bricks; nodes counted from 0, those of CalculiX from 1."""

    def __init__(self):
        self.nodes = np.zeros((0, 3))
        self.elements, self.blocks = [], []

    def block(self, lines, young):
        """A block between grid lines. Returns its nodes as an array by x, y, z."""
        shape = tuple(len(line) for line in lines)
        places = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
        at = len(self.nodes) + np.arange(len(places)).reshape(shape)
        self.nodes = np.vstack([self.nodes, places])
        first = len(self.elements)
        for i, j, k in np.ndindex(*(n - 1 for n in shape)):
            low, high = ([at[i, j, m], at[i + 1, j, m], at[i + 1, j + 1, m], at[i, j + 1, m]]
                         for m in (k, k + 1))
            self.elements.append(low + high)
        self.blocks.append((range(first, len(self.elements)), at, young))
        return at

    def side(self, block, upper, reach=np.inf):
        """Elements and faces of a lower or an upper side within `reach`, seen from outside."""
        elements, at, _ = self.blocks[block]
        level = set(at[:, :, -1 if upper else 0].ravel().tolist())
        picked, faces = [], []
        for element in elements:
            nodes = self.elements[element]
            face = nodes[4:] if upper else nodes[3::-1]
            if level.issuperset(face) and self.nodes[face, :2].max() < reach:
                picked.append(element)
                faces.append(face)
        return picked, faces


def lines_of(keyword, numbers, width=8):
    rows = [numbers[k:k + width] for k in range(0, len(numbers), width)]
    return keyword + "\n" + "".join(", ".join(str(n) for n in row) + ",\n" for row in rows)


class Case:
    """A mesh with what holds it, the motions of its upper end, and friction."""

    def __init__(self, name, mesh, fixed, top, motions, mu, sides):
        self.name, self.mesh, self.fixed, self.top = name, mesh, fixed, top
        self.motions, self.mu, self.sides = motions, mu, sides  # sides: slave, master

    def deck(self):
        mesh = self.mesh
        text = "*NODE, NSET=ALL\n" + "".join(
            f"{k + 1}, {x:.16g}, {y:.16g}, {z:.16g}\n" for k, (x, y, z) in enumerate(mesh.nodes))
        for number, (elements, _, young) in enumerate(mesh.blocks):
            text += f"*ELEMENT, TYPE=C3D8, ELSET=B{number}\n"
            text += "".join(f"{e + 1}, " + ", ".join(str(n + 1) for n in mesh.elements[e]) + "\n"
                            for e in elements)
            text += (f"*MATERIAL, NAME=M{number}\n*ELASTIC\n{young}, 0.3\n*DENSITY\n1.\n"
                     f"*SOLID SECTION, ELSET=B{number}, MATERIAL=M{number}\n")
        return text

    def run(self, out, suffix, text, wanted):
        """Runs CalculiX on a deck, one thread; returns its CPU seconds."""
        job = out / f"{self.name}_{suffix}"
        job.with_suffix(".inp").write_text(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(job.with_suffix(".log"), "w") as log:
            subprocess.run([CCX, "-i", job.name], cwd=out, stdout=log, stderr=log,
                           env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not job.with_suffix(wanted).exists():
            sys.exit(f"CalculiX wrote no {job.name}{wanted}: see {job}.log")
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def matrix(self, out):
        """CalculiX's stiffness, lower triangle by columns."""
        self.run(out, "matrix", self.deck() +
                 "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n", ".sti")
        job = out / f"{self.name}_matrix"
        dofs = [line.strip().split(".") for line in open(job.with_suffix(".dof")) if line.strip()]
        place = np.array([3 * (int(node) - 1) + int(axis) - 1 for node, axis in dofs])
        upper = np.loadtxt(job.with_suffix(".sti"))
        i, j = (place[upper[:, c].astype(int) - 1] for c in (0, 1))
        row, column = np.maximum(i, j), np.minimum(i, j)
        order = np.lexsort((row, column))
        size = 3 * len(self.mesh.nodes)
        start = np.searchsorted(column[order], np.arange(size + 1))
        return start, row[order], upper[order, 2]

    def library(self, out):
        """Forces of the contact on the slave's body in each step, in axes, and CPU seconds."""
        start, row, values = self.matrix(out)
        held = [3 * node + axis for node, axis in self.fixed]
        top = [3 * node + axis for node in self.top for axis in range(3)]
        moved = [dof for dof in top if dof not in set(held)]
        begin = time.process_time()
        slave, master = (faces for _, faces in self.sides)
        contact = signorini.pair_surfaces(self.mesh.nodes, slave, master)
        model = signorini.Model.from_surfaces((values, row, start), contact, fixed=held + moved,
                                              triangle="lower")
        forces, slip = [], None
        for motion in self.motions:
            prescribed = np.concatenate([np.zeros(len(held)), [motion[dof % 3] for dof in moved]])
            result = model.solve(np.zeros(3 * len(self.mesh.nodes)), gap=contact.gaps, mu=self.mu,
                                 slip0=slip, prescribed=prescribed)
            if result.status != 0:
                sys.exit(f"{self.name}: {result.message}")
            forces.append(contact.resultant(result).force)
            slip = result.d[:, 1:]
        return np.array(forces), time.process_time() - begin, contact.pairs

    def calculix(self, out):
        """Solves by CalculiX's own contact: reactions of the upper end, and CPU seconds."""
        faces = {True: "S2", False: "S1"}
        text = self.deck()
        for name, (elements, _), upper in zip(("SLAVE", "MASTER"), self.sides, (False, True)):
            text += f"*SURFACE, NAME={name}, TYPE=ELEMENT\n"
            text += "".join(f"{e + 1}, {faces[upper]}\n" for e in elements)
        young = self.mesh.blocks[0][2]
        text += ("*SURFACE INTERACTION, NAME=I\n"
                 f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{PENALTY * young}\n")
        if self.mu > 0:
            text += f"*FRICTION\n{self.mu}, {PENALTY * young}\n"
        text += "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n"
        text += lines_of("*NSET, NSET=TOP", [node + 1 for node in self.top])
        text += "*BOUNDARY\n" + "".join(f"{node + 1}, {axis + 1}, {axis + 1}\n"
                                        for node, axis in self.fixed)
        held = set(self.fixed)
        for motion in self.motions:
            text += "*STEP, INC=1000\n*STATIC\n0.5, 1.\n*BOUNDARY\n"
            text += "".join(f"{node + 1}, {axis + 1}, {axis + 1}, {motion[axis]}\n"
                            for node in self.top for axis in range(3) if (node, axis) not in held)
            text += "*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000\nRF\n*END STEP\n"
        seconds = self.run(out, "contact", text, ".dat")
        lines = open(out / f"{self.name}_contact.dat").read().splitlines()
        totals = [[float(x) for x in lines[k + 2].split()] for k, line in enumerate(lines)
                  if "total force" in line]
        if len(totals) != len(self.motions):
            sys.exit(f"CalculiX did not end all steps: see {out / self.name}_contact.log")
        # Forces at the upper end balance those on the slave, but for planes of symmetry.
        return -np.array(totals), seconds


def two_blocks():
    mesh = Mesh()
    grid = np.linspace(0, 1, 12)
    low = mesh.block((1.4 * grid - 0.2, 1.4 * grid - 0.2, np.linspace(-1, 0, 7)), 1000.0)
    high = mesh.block((np.linspace(0, 1, 10), np.linspace(0, 1, 10), np.linspace(0, 1, 7)), 2000.0)
    fixed = [(node, axis) for node in low[:, :, 0].ravel() for axis in range(3)]
    motions = [(0, 0, -0.001), (0.0002, 0, -0.001), (0.0006, 0, -0.001)]
    return Case("two_blocks", mesh, fixed, high[:, :, -1].ravel().tolist(), motions, 0.3,
                [mesh.side(1, False), mesh.side(0, True)])


def hertz(cells=6):
    """Contacts reach 1 in bodies of 8; the upper one is curved with the radius 20."""
    mesh = Mesh()

    def lines(fine):
        steps = [fine] * int(round(1.5 / fine))
        while sum(steps) < 8:
            steps.append(1.5 * steps[-1])
        line = np.concatenate([[0], np.cumsum(steps)])
        return np.where(line > 1.5 + 1e-9, 1.5 + (line - 1.5) * 6.5 / (line[-1] - 1.5), line)

    flat, curved = lines(1.5 / cells), lines(1.5 / round(1.25 * cells))
    deep = flat[[0, 1, 2, 4, *range(cells, len(flat))]]
    low = mesh.block((flat, flat, -deep[::-1]), 1000.0)
    high = mesh.block((curved, curved, deep), 2000.0)
    part = mesh.nodes[high.ravel()]
    radius = np.hypot(part[:, 0], part[:, 1])
    bent = np.minimum(radius, 3.0)
    part[:, 2] += (radius - bent / 2) * bent / 20.0 * (1 - part[:, 2] / 8.0)
    mesh.nodes[high.ravel()] = part
    fixed = [(node, axis) for node, place in enumerate(mesh.nodes) for axis in range(2)
             if place[axis] == 0]
    fixed += [(node, 2) for node in low[:, :, 0].ravel()]
    reach = 1.5 + 1e-6
    return Case("hertz", mesh, fixed, high[:, :, -1].ravel().tolist(), [(0, 0, -0.045)], 0.0,
                [mesh.side(1, False, reach), mesh.side(0, True, reach)])


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    failed = False
    for case in (two_blocks(), hertz()):
        ours, seconds, pairs = case.library(out)
        theirs, other = case.calculix(out)
        # Tangential forces of a quarter are those of its planes of symmetry.
        axes = [2] if case.mu == 0 else [0, 1, 2]
        size = np.abs(theirs[:, 2:]).max()
        off = np.abs(ours - theirs)[:, axes].max() / size
        for step, (a, b) in enumerate(zip(ours, theirs)):
            print(f"calculix_contact, {case.name} step {step + 1}: forces", np.round(a[axes], 5),
                  "CalculiX", np.round(b[axes], 5))
        print(f"calculix_contact, {case.name}: {pairs} pairs, {3 * len(case.mesh.nodes)} unknowns; "
              f"forces off by {100 * off:.2f} %; {seconds:.2f} s, CalculiX {other:.2f} s")
        failed |= not off <= AGREE
    sys.exit("calculix_contact: forces differ by more than 1 %" if failed else 0)


if __name__ == "__main__":
    main()
