"""The parts of c_examples/parts by the library and by CalculiX' own contact, on the same meshes.

    python3 calculix_parts.py OUT [PART ...]

Bricks of 20 nodes (C3D20); CalculiX pairs surface to surface with a linear penalty, and takes steps of its own
choice. The forces between the bodies of each step, CPU seconds and iterations are printed side by side. CCX names
CalculiX, default ccx; all files go to OUT.
"""

import os
import pathlib
import resource
import subprocess
import sys
import time

import numpy as np

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "c_examples" / "parts"))
import cylinder  # noqa: E402
import dovetail  # noqa: E402
import loaded_pin  # noqa: E402
import pin_in_lug  # noqa: E402
import shrink_fit  # noqa: E402

CCX = os.environ.get("CCX", "ccx")
PENALTY = 50.0  # contact stiffness over Young's modulus of the stiffer body and a millimetre
PARTS = {"loaded_pin": loaded_pin.part, "cylinder": cylinder.part, "pin_in_lug": pin_in_lug.part,
         "shrink_fit": shrink_fit.part, "dovetail": dovetail.part}


def numbers(values, width=8):
    values = [str(value) for value in values]
    return "".join(", ".join(values[k:k + width]) + ",\n" for k in range(0, len(values), width))


def deck(part):
    """The model for CalculiX, without its steps."""
    mesh = part.mesh
    text = "*NODE, NSET=ALL\n" + "".join(f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}\n"
                                         for k, (x, y, z) in enumerate(part.true_shape()))
    for number, name in enumerate(mesh.names):
        text += f"*ELEMENT, TYPE=C3D20, ELSET=E{number}\n"
        for brick in np.flatnonzero(mesh.body == number):
            text += numbers([brick + 1, *(mesh.bricks[brick] + 1)], 11)
        text += (f"*MATERIAL, NAME=M{number}\n*ELASTIC\n{mesh.young[number]}, {mesh.poisson[number]}\n"
                 f"*SOLID SECTION, ELSET=E{number}, MATERIAL=M{number}\n")
    stiff = PENALTY * max(mesh.young)
    for number, zone in enumerate(part.zones.values()):
        for side, surface in (("S", zone.slave), ("T", zone.master)):
            bricks, sides = mesh.sides(*surface)
            text += f"*SURFACE, NAME={side}{number}, TYPE=ELEMENT\n"
            text += "".join(f"{b + 1}, S{s + 1}\n" for b, s in zip(bricks, sides))
        text += (f"*SURFACE INTERACTION, NAME=I{number}\n"
                 f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiff}\n")
        if zone.mu > 0:
            text += f"*FRICTION\n{zone.mu}, {stiff / 10}\n"
        text += f"*CONTACT PAIR, INTERACTION=I{number}, TYPE=SURFACE TO SURFACE\nS{number}, T{number}\n"
    text += "*BOUNDARY\n" + "".join(f"{dof // 3 + 1}, {dof % 3 + 1}\n" for dof in part.fixed)
    return text


def calculix(part, job):
    """Forces on the slave's body of the first zone in each step, CPU seconds and iterations of CalculiX."""
    text = deck(part)
    for loads, motions in part.steps:
        text += "*STEP, INC=1000\n*STATIC\n0.25, 1., 1e-6\n"
        if motions:
            text += "*BOUNDARY\n" + "".join(f"{dof // 3 + 1}, {dof % 3 + 1}, {dof % 3 + 1}, {value:.12g}\n"
                                            for dof, value in motions.items())
        if loads.any():
            text += "*CLOAD, OP=NEW\n" + "".join(f"{dof // 3 + 1}, {dof % 3 + 1}, {loads[dof]:.12g}\n"
                                                 for dof in np.flatnonzero(loads))
        text += "*CONTACT PRINT, SLAVE=S0, MASTER=T0, FREQUENCY=1000\nCF\n*END STEP\n"
    job.with_suffix(".inp").write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(job.with_suffix(".log"), "w") as log:
        subprocess.run([CCX, "-i", job.name], cwd=job.parent, stdout=log, stderr=log,
                       env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    iterations = sum(int(line.split()[3]) for line in open(job.with_suffix(".sta"))
                     if line.split()[:1] and line.split()[0].isdigit())
    return (forces(job.with_suffix(".dat")),
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, iterations)


def forces(path):
    """Total force and moment on the slave at the end of each step."""
    found, lines = [], path.read_text().splitlines() if path.exists() else []
    for k, line in enumerate(lines):
        if "total surface force (fx,fy,fz) and moment about the origin" in line:
            found.append([float(x) for x in lines[k + 2].split()])
    return np.array(found)


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or PARTS:
        part = PARTS[name]()
        K = part.mesh.stiffness()
        begin = time.process_time()
        results = part.solve(K)
        seconds = time.process_time() - begin
        first = next(iter(part.zones))
        ours = [part.pairs[first].resultant(result.zone(first)) for result, _ in results]
        theirs, other, iterations = calculix(part, out / name)
        print(f"{name}: {3 * len(part.mesh.at)} unknowns, {len(results[0][0].d)} pairs, {len(part.steps)} steps: "
              f"library {seconds:.2f} s, {sum(r.report.factorisations for r, _ in results)} systems; "
              f"CalculiX {other:.1f} s, {iterations} iterations, {len(theirs)} steps done")
        for step, one in enumerate(ours):
            print(f"  step {step + 1}: force {one.force[0]:.1f}, {one.force[1]:.1f}, moment {one.moment[2]:.1f}")
            if step < len(theirs):
                print("        CalculiX {:.1f}, {:.1f}, {:.1f}".format(*theirs[step][[0, 1, 5]]), flush=True)


if __name__ == "__main__":
    main()
