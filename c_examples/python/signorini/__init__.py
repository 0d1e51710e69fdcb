"""Unilateral contact with friction on numpy arrays: the library signorini by ctypes.

    import signorini
    result = signorini.solve(K, f, gap=0.0, mu=0.3)
    print(result.status, result.message, result.report.eta)
    print(result.d[:, 0], result.F[:, 0], result.state)

For P pairs in dimension D (2 or 3), N = D * P, ordered pair by pair (n, t) or (n, t1, t2):

    K d = f + F                                     equilibrium
    d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0     unilateral contact
    |F_t| <= r                                      friction: d_t = slip0 inside the cone,
                                                    d_t - slip0 = -lambda F_t, lambda >= 0, on it

The law of friction follows from what is given: mu, r = mu |F_n| (Coulomb); g, r = g (Tresca);
neither, r = 0 (frictionless); law and friction, another one (see solve; signorini.h defines it).

Signs: n is the outward normal of the body; d_n > 0 moves towards the obstacle, F_n < 0 presses, F
is the force on the body. f and F are nodal forces. Units are yours, also those of the results.
gap, mu, g and slip0 may be one number for all pairs, friction three. Vectors of N entries may have
the shape (P, D). Any other shape is a ValueError, other kinds of numbers are a TypeError, and what
the library refuses is a SignoriniError. signorini.h is the reference; it also says what each field
of a report is.

Settings are keywords of everything that solves: method and search (a member of Method, of Search,
or its name in lower case), tolerance, omega, damping, max_iterations, time_limit (seconds),
memory_limit (bytes), threads, proof (true: prove that the solution exists, and where), and
progress, a function of a Progress. It cancels the call by a true result, or by an exception (such
as that of Ctrl-C), which goes on after the call. It must not call this module. Without a progress
function, Ctrl-C waits for the end of the call.

From two meshes to pressures:

    contact = signorini.pair_surfaces(coordinates, slave_faces, master_faces)
    model = signorini.Model.from_surfaces(K, contact, fixed=fixed)
    result = model.solve(f, mu=0.3)          # the gaps are those of the surfaces
    u = model.recover(result.d, f)
    contact.write("contact.vtu", {"hexahedron": bricks}, result, u)
    result.plot()                            # with matplotlib

From meshes as meshio reads them, whose faces the library finds:

    model = signorini.Model.from_meshes((K_upper, K_lower), upper, lower, fixed=fixed)

The shared library is the one that load() names, or the environment variable SIGNORINI_LIBRARY, or
the one in this folder, which pip has put there, or that of ../../target/release beside this folder,
or that of the system. Needs numpy. Threads may share everything here.
"""

from ._condensed import certify, prove, solve, write
from ._constants import (ABI_VERSION, Fallback, Law, Method, ModelKind, Normals, Pairing, Proof, Remark,
                         Rims, Search, State, Status, Triangle, Uniqueness)
from ._equations import read_equations, rigid_equations, section_equations, turned_equations
from ._files import ContactProblem, LcpProblem, read
from ._lcp import lcp_lemke, lcp_solve, write_lcp
from ._flexibility import solve_flexibility
from ._library import SignoriniError, load
from ._mesh import write_mesh, write_series
from ._meshes import pair_meshes
from ._model import Model
from ._results import Enclosure, LcpResult, Progress, Result
from ._sector import Period, Sector, sector_equations
from ._surfaces import (Cone, Cylinder, Fields, Penetration, Plane, Resultant, RigidFaces, Sphere, SurfacePairs, Torus,
                        pair_obstacle, pair_surfaces)
from ._zones import Zone

__all__ = [
    "ABI_VERSION", "Cone", "ContactProblem", "Cylinder", "Enclosure", "Fallback", "Fields", "Law", "LcpProblem",
    "LcpResult", "Method", "Model", "ModelKind", "Normals", "Pairing", "Penetration", "Period", "Plane", "Progress", "Proof",
    "Remark", "Result", "Resultant", "RigidFaces", "Rims", "Search", "Sector", "SignoriniError", "Sphere", "State",
    "Status", "SurfacePairs", "Torus", "Triangle", "Uniqueness", "Zone", "certify", "lcp_lemke", "lcp_solve",
    "load", "pair_meshes", "pair_obstacle", "pair_surfaces", "prove", "read", "read_equations", "rigid_equations",
    "section_equations", "sector_equations", "solve", "solve_flexibility", "turned_equations", "write", "write_lcp",
    "write_mesh", "write_series",
]
