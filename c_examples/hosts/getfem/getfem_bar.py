"""GetFEM as the host: the bar on the plane, by its own contact brick and by the library.

    /usr/bin/python3 c_examples/hosts/getfem/getfem_bar.py

GetFEM meshes and assembles the bar. Its tangent matrix and right-hand side go to the library as
they are, a sparse matrix with contact pairs; the same model with GetFEM's own contact brick must
give the same forces. Needs GetFEM (python3-getfem, which Debian installs for its own
/usr/bin/python3) and numpy. The library is found as the Python package says.
"""

import os
import sys

import numpy as np

sys.dont_write_bytecode = True  # what is built goes to target/
# The package is in c_examples/python.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../python"))
import signorini  # noqa: E402

try:
    import getfem as gf
except ImportError:
    sys.exit("getfem_bar: this Python has no GetFEM: python3-getfem in Debian, for its own /usr/bin/python3")

SIDE, COLUMNS, ROWS, RATIO = 40.0, 32, 5, 1.7  # mm; the mesh of bar_mesh.c
YOUNG, POISSON = 13000.0, 0.2  # daN/mm2
TOP, LEFT = 5.0, 10.0  # pressures, daN/mm2, both pushing inward
LIMIT = 1e-9  # of the largest force
CONTACT, SYMMETRY, LOADED_TOP, LOADED_LEFT = 1, 2, 3, 4


def bar():
    """The bar, free on its contact side and unsupported: mesh, field of displacements, model."""
    heights = RATIO ** np.arange(ROWS)
    y = np.concatenate([[0.0], np.cumsum(heights)]) * SIDE / heights.sum()
    mesh = gf.Mesh("cartesian", np.linspace(0, SIDE, COLUMNS + 1), y)
    for region, normal in ((CONTACT, [0, -1]), (SYMMETRY, [1, 0]), (LOADED_TOP, [0, 1]),
                           (LOADED_LEFT, [-1, 0])):
        mesh.set_region(region, mesh.outer_faces_with_direction(normal, 0.01))
    field = gf.MeshFem(mesh, 2)
    field.set_fem(gf.Fem("FEM_QK(2,1)"))
    points = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,3)"))  # 2 x 2 Gauss points

    model = gf.Model("real")
    model.add_fem_variable("u", field)
    model.add_initialized_data("lambda", YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON))
    model.add_initialized_data("mu", YOUNG / 2 / (1 + POISSON))
    model.add_isotropic_linearized_elasticity_brick(points, "u", "lambda", "mu")
    for region, name, force in ((LOADED_TOP, "top", [0, -TOP]), (LOADED_LEFT, "left", [LEFT, 0])):
        model.add_initialized_data(name, force)
        model.add_source_term_brick(points, "u", name, region)
    return field, points, model


def on_side(field, region, along):
    """Degrees of freedom (x, y) of the nodes of a side, one row a node, along an axis."""
    dofs = np.sort(field.basic_dof_on_region(region)).reshape(-1, 2)
    return dofs[np.argsort(field.basic_dof_nodes()[along, dofs[:, 0]])]


def by_library():
    """The model that signorini solves, and the loads."""
    field, _, model = bar()
    model.assembly()
    matrix = model.tangent_matrix()
    starts, rows = matrix.csc_ind()
    contact = on_side(field, CONTACT, 0)
    held = on_side(field, SYMMETRY, 1)[:, 0]
    return signorini.Model.sparse(
        (matrix.csc_val(), rows, starts), contact, [0, -1], fixed=held
    ), model.rhs()


def by_getfem(friction):
    """F_n and F_t of the nodes, (33, 2), by GetFEM's nodal contact condition with friction."""
    field, points, model = bar()
    model.add_initialized_data("H", [[1, 0], [0, 0]])
    model.add_initialized_data("none", [0, 0])
    model.add_generalized_Dirichlet_condition_with_multipliers(points, "u", field, SYMMETRY, "none",
                                                               "H")
    contact = on_side(field, CONTACT, 0)
    count = len(contact)
    normal, tangent = (gf.Spmat("empty", count, field.nbdof()) for _ in range(2))
    for i, (x, y) in enumerate(contact):
        normal.add(i, int(y), -1.0)
        tangent.add(i, int(x), 1.0)
    model.add_variable("normal", count)
    model.add_variable("tangential", count)
    # r, in force / length, is on the way to the solution only. With ten times as much, Newton's
    # method does not get there for mu = 2.
    for name, value in (("r", 1e3), ("friction", friction), ("gap", np.zeros(count)), ("alpha", 1)):
        model.add_initialized_data(name, value)
    model.add_basic_contact_brick("u", "normal", "tangential", "r", normal, tangent, "friction",
                                  "gap", "alpha", 1)
    _, converged = model.solve("max_res", 1e-11, "max_iter", 100)
    if not converged:
        sys.exit(f"GetFEM's own contact condition does not converge for mu = {friction}")
    return np.column_stack([model.variable("normal"), model.variable("tangential")])


def main():
    gf.util_trace_level(0)
    model, load = by_library()
    failed = 0
    for friction in (0.2, 0.5, 1.0, 2.0):
        result = model.solve(load, 0.0, friction, tolerance=1e-13)
        other = by_getfem(friction)
        difference = np.abs(result.F - other)
        difference[-1, 1] = 0.0  # held by the symmetry, which shares that force with friction
        worst = difference.max() / np.abs(other).max()
        passed = result.status == signorini.Status.SOLVED and worst <= LIMIT
        failed += not passed
        states = np.bincount(result.state, minlength=3)
        print(f"  {'PASS' if passed else 'FAIL'}  mu = {friction}: {result.message}; {states[0]} "
              f"open, {states[1]} slip, {states[2]} stick; forces off GetFEM's by {worst:.1e} of "
              f"the largest (limit {LIMIT:g}); sum of F_t {result.F[:, 1].sum():.6f}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
