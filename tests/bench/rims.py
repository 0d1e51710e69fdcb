"""Pressures at rims of unstructured meshes of gmsh: of a pressure that is linear, and of a pin longer than its lug.

    python3 tests/bench/rims.py [linear] [pin] [matching] [delaunay]

It needs gmsh (PyPI), numpy and scipy. mm, N, MPa.

linear: two blocks of tetrahedra hang over each other by a part of an element, 36 models, of 4 and 10 nodes; the exact
displacements are those of a pressure p (1 + 0.3 x + 0.8 y), or p. The largest errors of pressures.
pin: a pin of 16 mm in a lug of 10 mm, clearance 0.05, pushed by its end; beside the same pin partitioned where the lug
ends, of which the faces under the lug alone are slaves. The lateral force besides on the same mesh whose rows are all kept:
the difference is what folding adds.
delaunay: the pin on meshes whose surfaces have Delaunay's triangles, which differ more in shape.
matching: the partitioned pin whose nodes are those of the lug, and its mirror image: the lateral force that a mesh has of its
own, as it is not symmetric.
"""

import os
import sys

import numpy as np
from scipy.interpolate import griddata

from rims_mesh import solid, two

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "c_examples", "python"))
import signorini  # noqa: E402

PRESSURE = 7.0
YOUNG = ((2000.0, 0.3), (500.0, 0.2))
RADIUS, LUG, END, OUTER, CLEARANCE, PUSH = 10.0, 10.0, 16.0, 25.0, 0.05, 0.1
MU = 0.0, 0.2
SIZES = 2.8, 2.6, 2.5, 2.4, 2.3, 2.2, 2.1, 2.0, 1.8, 1.5


def exact(at, young, poisson, growth):
    """Displacements of a bar under a pressure along z that grows along x and y."""
    x, y, z = at.T
    a, b = (-PRESSURE * value / young for value in growth)
    strain = PRESSURE / young
    return np.stack([
        strain * poisson * x - a / 2 * (z * z + poisson * (x * x - y * y)) - poisson * b * x * y,
        strain * poisson * y - b / 2 * (z * z + poisson * (y * y - x * x)) - poisson * a * x * y,
        -strain * z + (a * x + b * y) * z], axis=1)


def clipped(polygon, window):
    """The part of a polygon in a window."""
    for axis, bound, sign in [(axis, bound, sign) for axis in (0, 1) for bound, sign in zip(window[axis], (1, -1))]:
        kept = []
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            a, b = sign * (p[axis] - bound), sign * (q[axis] - bound)
            if a >= 0:
                kept.append(p)
            if a * b < 0:
                kept.append(p + a / (a - b) * (q - p))
        polygon = kept
    return polygon


def nodal_forces(at, faces, window, pressure):
    """Nodal forces of a pressure on the part of triangles in a window: exact."""
    s, w = np.polynomial.legendre.leggauss(5)
    s, w = (s + 1) / 2, w / 2
    points = [(s[i], (1 - s[i]) * s[j], w[i] * w[j] * (1 - s[i])) for i, j in np.ndindex(5, 5)]
    force = np.zeros(len(at))
    for face in faces:
        corners = at[face[:3], :2]
        sides = np.stack([corners[1] - corners[0], corners[2] - corners[0]], axis=1)
        polygon = clipped(list(corners), window)
        for a, b in zip(polygon[1:], polygon[2:]):
            for r, t, weight in points:
                p = polygon[0] + r * (a - polygon[0]) + t * (b - polygon[0])
                area = abs(np.linalg.det([a - polygon[0], b - polygon[0]]))
                r, t = np.linalg.solve(sides, p - corners[0])
                q = np.array([1 - r - t, r, t])
                shape = q if len(face) == 3 else np.append(q * (2 * q - 1), 4 * q * np.roll(q, -1))
                force[face] += weight * area * pressure(*p) * shape
    return force


def overhanging(kind, sizes, seed, over, upper_is_slave, growth):
    """Relative errors of pressures, those at nodes that took in others, and the pairs."""
    def box(low, shift, high):
        return lambda shapes: shapes.addBox(*shift, low, 1, 1, high - low)
    bodies = [solid(kind, sizes[0], seed, box(-0.8, (0, 0), 0.0)), solid(kind, sizes[1], seed, box(0.0, over, 0.6))]
    at, K, first, faces = two(kind, bodies, YOUNG)
    faces = [face[(abs(at[face][..., 2]) < 1e-9).all(axis=1)] for face in faces]
    u = np.vstack([exact(body, *material, growth) for (body, _), material in zip(bodies, YOUNG)])
    window = [(shift, 1.0) for shift in over]

    def pressure(x, y):
        return PRESSURE * (1 + growth[0] * x + growth[1] * y)
    load = K @ u.ravel()
    for face, sign in zip(faces, (1, -1)):
        load[2::3] += sign * nodal_forces(at, face, window, pressure)
    fixed = list(3 * np.flatnonzero(at[:, 2] < -0.8 + 1e-9) + 2)
    for body, level in ((0, -0.8), (1, 0.6)):
        nodes = np.flatnonzero((abs(at[:, 2] - level) < 1e-9) & ((np.arange(len(at)) >= first) == body))
        near, far = (nodes[np.argmin(at[nodes] @ [sign, 1, 0])] for sign in (1, -1))
        fixed += [3 * near, 3 * near + 1, 3 * far + 1]
    pairs = signorini.pair_surfaces(at, *(faces[::-1] if upper_is_slave else faces))
    model = signorini.Model.from_surfaces((K.data, K.indices, K.indptr), pairs, fixed=np.array(fixed))
    result = model.solve(load, gap=pairs.gaps, mu=0.0, prescribed=u.ravel()[fixed], tolerance=1e-12)
    found = -result.F[:, 0] / pairs.areas / pressure(*at[pairs.nodes, :2].T) - 1
    return abs(found), np.isin(pairs.nodes, pairs.folded[:, 1]), pairs


def linear():
    shares = (0.03, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.99)
    for kind, sizes in (("tet4", (0.14, 0.11)), ("tet10", (0.22, 0.16))):
        worst = np.zeros(4)
        for seed in range(18):
            ours = sizes if seed < 9 else sizes[::-1]
            over = shares[seed % 9] * ours[1] * np.array([1, 0.5 + seed / 18])
            error, receives, pairs = overhanging(kind, ours, seed + 1, over, seed % 2 == 0, (0.3, 0.8))
            uniform, *_ = overhanging(kind, ours, seed + 1, over, seed % 2 == 0, (0.0, 0.0))
            far = pairs.folded_distances.max(initial=0) / max(ours)
            worst = np.maximum(worst, [error.max(), error[receives].max(initial=0), uniform.max(), far])
        print(f"{kind}, 18 models: all nodes {worst[0]:.1%}, receivers {worst[1]:.1%}, uniform {worst[2]:.1e}, "
              f"farthest fold {worst[3]:.1f} elements", flush=True)


def pin_in_lug(kind, size, seed, partitioned, triangles=6):
    """The two bodies."""
    def pin(shapes):
        if kind == "hex20":
            # Where it is not partitioned no layer ends with the lug.
            cells, ends = ([4, 2], [LUG / END, 1]) if partitioned else ([7], [1])
            shapes.extrude([(2, shapes.addDisk(0, 0, 0, RADIUS, RADIUS))], 0, 0, END, numElements=cells,
                           heights=ends, recombine=True)
        elif partitioned:
            parts = [(3, shapes.addCylinder(0, 0, low, 0, 0, high - low, RADIUS))
                     for low, high in ((0, LUG), (LUG, END))]
            shapes.fragment(parts[:1], parts[1:])
        else:
            shapes.addCylinder(0, 0, 0, 0, 0, END, RADIUS)

    def lug(shapes):
        discs = [[(2, shapes.addDisk(0, 0, 0, radius, radius))] for radius in (OUTER, RADIUS)]
        ring, _ = shapes.cut(*discs)
        shapes.extrude(ring, 0, 0, LUG, numElements=[4] if kind == "hex20" else [], recombine=kind == "hex20")
    return [solid(kind, size, seed, pin, triangles), solid(kind, size, seed + 1, lug, triangles)]


def pressed(kind, bodies, partitioned, pin_is_slave, rims="fold"):
    """Places of the pairs along the circle and the axis, the pairs, and for each of MU pressures and the force across over
    that along."""
    at, K, first, faces = two(kind, bodies, ((210e3, 0.3), (70e3, 0.33)))
    radius = np.hypot(at[:, 0], at[:, 1])
    touching = (abs(radius - RADIUS) < 1e-3) & (at[:, 2] < (LUG if partitioned else END) + 1e-6)
    faces = [face[touching[face].all(axis=1)] for face in faces]
    nodes = np.arange(len(at))
    end, bottom = nodes[(nodes < first) & (at[:, 2] > END - 1e-6)], nodes[at[:, 2] < 1e-6]
    held = nodes[(nodes >= first) & (radius > OUTER - 0.01)]
    fixed = np.concatenate([3 * bottom + 2, 3 * held, 3 * held + 1, 3 * end, 3 * end + 1])
    moved = np.repeat([0.0, -PUSH], [len(fixed) - len(end), len(end)])
    pairs = signorini.pair_surfaces(at, *(faces if pin_is_slave else faces[::-1]), clearance=CLEARANCE,
                                    symmetry=[(2, 0.0)], rims=rims)
    model = signorini.Model.from_surfaces((K.data, K.indices, K.indptr), pairs, fixed=fixed)
    results = [model.solve(np.zeros(3 * len(at)), gap=pairs.gaps, mu=mu, prescribed=moved) for mu in MU]
    x, y, z = at[pairs.nodes].T
    forces = [pairs.resultant(result).force for result in results]
    found = [(-result.F[:, 0] / pairs.areas, force[0] / force[1]) for result, force in zip(results, forces)]
    return (RADIUS * np.arctan2(x, -y), z), pairs, found


def delaunay():
    pin([("tet10", size, seed) for size in (2.8, 2.6, 2.2) for seed in (1, 2, 3)], 5)


def pin(meshes=[("hex20", 3.0, 1)] + [("tet10", size, seed) for size in SIZES for seed in (1, 2, 3)], triangles=6):
    for kind, size, seed in meshes:
        bodies, parts = (pin_in_lug(kind, size, seed, partitioned, triangles) for partitioned in (False, True))
        for pin_is_slave in (True, False):
            place, pairs, found = pressed(kind, bodies, False, pin_is_slave)
            kept = pressed(kind, bodies, False, pin_is_slave, "keep")[2] if len(pairs.folded) else found
            there, _, others = pressed(kind, parts, True, pin_is_slave)
            turn = 2 * np.pi * RADIUS
            around = np.concatenate([there[0] - turn, there[0], there[0] + turn]), np.tile(there[1], 3)
            rim = place[1] > LUG - size
            for mu, (pressure, across), (_, all_rows), (other, beside) in zip(MU, found, kept, others):
                expected = griddata(around, np.tile(other, 3), place)
                nearest = griddata(around, np.tile(other, 3), place, method="nearest")
                off = (pressure - np.where(np.isnan(expected), nearest, expected))[rim] / other.max()
                print(f"{kind} {size}, seed {seed}, {'pin' if pin_is_slave else 'lug'} slave, mu {mu}: "
                      f"{pairs.pairs} pairs, {len(pairs.folded)} folded; largest pressure {pressure.max():.0f}, "
                      f"partitioned {other.max():.0f}, ratio {pressure.max() / other.max():.2f}; rim rms "
                      f"{np.sqrt(np.mean(off ** 2)):.1%}; across {across:.1e}, all rows kept {all_rows:.1e}, by folds "
                      f"{abs(across - all_rows):.1e}, partitioned {beside:.1e}", flush=True)


def matching():
    def fragments(shapes):
        parts = [(3, shapes.addCylinder(0, 0, low, 0, 0, high - low, radius))
                 for low, high, radius in ((0, LUG, RADIUS), (LUG, END, RADIUS), (0, LUG, OUTER))]
        shapes.fragment(parts[:1], parts[1:])
    for size, seed in [(size, seed) for size in (2.8, 2.2) for seed in (1, 2, 3)]:
        at, elements = solid("tet10", size, seed, fragments)
        inside = np.hypot(*at[elements][..., :2].T).max(axis=0) < RADIUS * (1 + 1e-6)
        bodies, mirrored = [], []
        for body in (elements[inside], elements[~inside]):
            used, body = np.unique(body, return_inverse=True)
            bodies.append((at[used], body.reshape(-1, 10)))
            # The image of an element has its first two corners changed.
            mirrored.append((at[used] * [-1, 1, 1], bodies[-1][1][:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]]))
        across = [pressed("tet10", both, True, True)[2][0][1] for both in (bodies, mirrored)]
        print(f"matching tet10 {size}, seed {seed}: across {across[0]:.5e}, mirrored {across[1]:.5e}", flush=True)


if __name__ == "__main__":
    for name in sys.argv[1:] or ["linear", "pin", "matching"]:
        {"linear": linear, "pin": pin, "matching": matching, "delaunay": delaunay}[name]()
