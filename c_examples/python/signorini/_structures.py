"""The structures of the headers. The tests compare them with the header and with the library."""

import ctypes
from types import SimpleNamespace

from ._constants import Fallback, Method, Proof, Remark, Status, Uniqueness, member

i32, i64, u32 = ctypes.c_int32, ctypes.c_int64, ctypes.c_uint32
real, address = ctypes.c_double, ctypes.c_void_p


class Told(ctypes.Structure):
    """signorini_progress"""

    _fields_ = [
        ("iterations", i64), ("eta", real), ("elapsed", real), ("reduced", real), ("memory", i64),
    ]


Callback = ctypes.CFUNCTYPE(i32, address, ctypes.POINTER(Told))
_numbers = ctypes.POINTER(real)
ProductFunction = ctypes.CFUNCTYPE(i32, address, _numbers, _numbers)
HeldFunction = ctypes.CFUNCTYPE(i32, address, ctypes.POINTER(i32), i32, _numbers, _numbers)
PreconditionFunction = ctypes.CFUNCTYPE(i32, address, ctypes.POINTER(i32), _numbers, i32, _numbers,
                                        _numbers)


class Settings(ctypes.Structure):
    """signorini_settings"""

    _fields_ = [
        ("struct_size", u32), ("method", i32), ("tolerance", real), ("omega", real),
        ("damping", real), ("max_iterations", i64), ("time_limit", real), ("warm_start", i32),
        ("search", i32), ("progress", Callback), ("user", address), ("proof", i32),
        ("reserved", i32), ("memory_limit", i64), ("full_space", i32), ("threads", i32),
    ]


class Report(ctypes.Structure):
    """signorini_report"""

    _fields_ = [
        ("struct_size", u32), ("status", i32), ("method", i32), ("uniqueness", i32),
        ("iterations", i64), ("outer_iterations", i64), ("refactorisations", i64), ("eta", real),
        ("rounding", real), ("penetration", real), ("tension", real), ("cone_excess", real),
        ("equilibrium", real), ("omega", real), ("damping", real), ("pairs_open", i64),
        ("pairs_slipping", i64), ("pairs_sticking", i64), ("factorisations", i64),
        ("first_method", i32), ("fallback", i32), ("orientation", i32), ("second", i32),
        ("error_d", real), ("error_F", real), ("proof", i32), ("remarks", i32),
    ]

    families = {"status": Status, "method": Method, "first_method": Method,
                "uniqueness": Uniqueness, "fallback": Fallback, "proof": Proof}

    def plain(self):
        """The fields with members of their families. What `second` tells, Result.second is."""
        values = {name: getattr(self, name) for name, _ in self._fields_}
        del values["struct_size"], values["second"]
        for name, family in self.families.items():
            values[name] = member(family, values[name])
        values["remarks"] = Remark(values["remarks"])
        return SimpleNamespace(**values)


class Extra(ctypes.Structure):
    """signorini_extra"""

    _fields_ = [
        ("struct_size", u32), ("reserved", i32), ("motion", address), ("second_d", address),
        ("second_F", address), ("second_state", address), ("radius_d", address),
        ("radius_F", address), ("escape", address),
        ("d_low", address),
    ]


class Sparse(ctypes.Structure):
    """signorini_sparse"""

    _fields_ = [
        ("struct_size", u32), ("index_bytes", i32), ("index_base", i32), ("triangle", i32),
        ("size", i64), ("nnz", i64), ("col_start", address), ("row", address),
        ("values", address), ("order", address),
    ]


class Operator(ctypes.Structure):
    """signorini_operator"""

    _fields_ = [
        ("struct_size", u32), ("dim", i32), ("pairs", i64), ("stiffness", ProductFunction),
        ("inverse", ProductFunction), ("held", HeldFunction), ("units", address),
        ("user", address), ("unknowns", i64), ("place", address),
        ("precondition", PreconditionFunction), ("accuracy", real),
    ]


class EquationList(ctypes.Structure):
    """signorini_equations"""

    _fields_ = [
        ("struct_size", u32), ("reserved", i32), ("count", i64), ("dependent", address),
        ("start", address), ("dofs", address), ("coefficients", address),
    ]


class Pairs(ctypes.Structure):
    """signorini_pairs"""

    _fields_ = [
        ("struct_size", u32), ("dim", i32), ("count", i64), ("slaves", address),
        ("master_start", address), ("masters", address), ("weights", address),
        ("normals", address), ("tangents", address), ("row_start", address),
        ("row_nodes", address), ("row_weights", address), ("row_vectors", address),
        ("equations", address),
    ]


class ModelData(ctypes.Structure):
    """signorini_model_data"""

    _fields_ = [
        ("struct_size", u32), ("dim", i32), ("pairs", i64), ("host_size", i64), ("fixed", i64),
        ("memory", i64), ("kind", i32), ("dependent", i32), ("K", address), ("frames", address),
    ]


class Faces(ctypes.Structure):
    """signorini_faces"""

    _fields_ = [
        ("struct_size", u32), ("face_nodes", i32), ("count", i64), ("start", address),
        ("nodes", address),
    ]


class RigidObstacle(ctypes.Structure):
    """signorini_obstacle"""

    _fields_ = [
        ("struct_size", u32), ("kind", i32), ("point", real * 3), ("direction", real * 3),
        ("radius", real), ("hollow", i32), ("reserved", i32), ("nodes", i64),
        ("coordinates", address), ("faces", address),
    ]


class SurfaceSettings(ctypes.Structure):
    """signorini_surface_settings"""

    _fields_ = [
        ("struct_size", u32), ("pairing", i32), ("search_distance", real), ("index_base", i32),
        ("dofs_per_node", i32), ("node_dofs", address), ("symmetry_planes", i64),
        ("symmetry_axes", address), ("symmetry_at", address), ("normals", i32), ("rims", i32),
        ("axisymmetric", i32), ("fitted", i32), ("time_limit", real), ("progress", Callback),
        ("user", address), ("slave_shape", address), ("master_shape", address),
        ("close_within", real), ("clearance", real), ("symmetry_normals", address), ("sectors", i64),
        ("sector_point", address), ("sector_axis", address), ("tangent", real * 3),
        ("period", real * 3), ("second_period", real * 3), ("keep_turns", i32), ("reserved", i32),
        ("n_fixed", i64), ("fixed", address),
    ]


class SurfaceData(ctypes.Structure):
    """signorini_surface_data"""

    _fields_ = [
        ("struct_size", u32), ("dim", i32), ("pairs", i64), ("rows", address), ("gaps", address),
        ("areas", address), ("normals", address), ("tangents", address), ("points", address),
        ("nodes", address), ("n_unpaired", i64), ("unpaired", address), ("n_folded", i64),
        ("folded", address), ("n_uncovered", i64), ("uncovered", address),
        ("summary", ctypes.c_char_p), ("slave_faces", i64), ("slave_area", real),
        ("covered_area", real), ("search_distance", real), ("not_opposed", i64),
        ("boxes_searched", i64), ("on_symmetry", i64), ("n_beyond", i64),
        ("beyond", address), ("beyond_distances", address), ("folded_distances", address),
        ("n_zones", i64), ("zone_start", address), ("friction", address),
    ]


class ContactZone(ctypes.Structure):
    """signorini_contact_zone"""

    _fields_ = [
        ("struct_size", u32), ("law", i32), ("contact", address), ("name", ctypes.c_char_p),
        ("friction", address),
    ]


class ContactFields(ctypes.Structure):
    """signorini_contact_fields"""

    _fields_ = [
        ("struct_size", u32), ("reserved", i32), ("pressure", address), ("traction", address),
        ("clearance", address), ("slip", address), ("state", address),
    ]


class PenetrationData(ctypes.Structure):
    """signorini_penetration"""

    _fields_ = [
        ("struct_size", u32), ("points", i32), ("depth", real), ("point", real * 3), ("face", i64),
        ("node", i64), ("master_face", i64), ("zone", i64),
    ]


class ResultantSums(ctypes.Structure):
    """signorini_resultant"""

    _fields_ = [
        ("struct_size", u32), ("reserved", i32), ("force", real * 3), ("moment", real * 3),
        ("friction_work", real), ("pressed_area", real),
    ]


class Mesh(ctypes.Structure):
    """signorini_mesh"""

    _fields_ = [
        ("struct_size", u32), ("dim", i32), ("nodes", i64), ("coordinates", address),
        ("cells", i64), ("index_base", i32), ("cell_type", i32), ("cell_types", address),
        ("cell_start", address), ("cell_nodes", address),
    ]


class Zone(ctypes.Structure):
    """signorini_zone"""

    _fields_ = [
        ("struct_size", u32), ("reserved", i32), ("contact", address), ("gap", address),
        ("slip0", address), ("d", address), ("F", address), ("state", address),
    ]


class NodalField(ctypes.Structure):
    """signorini_field"""

    _fields_ = [
        ("struct_size", u32), ("components", i32), ("name", ctypes.c_char_p), ("values", address),
    ]


class ProblemData(ctypes.Structure):
    """signorini_problem_data"""

    _fields_ = [
        ("struct_size", u32), ("kind", i32), ("law", i32), ("dim", i32), ("pairs", i64),
        ("size", i64), ("matrix", address), ("rhs", address), ("gap", address),
        ("friction", address), ("slip0", address), ("cover", address),
        ("remark", ctypes.c_char_p),
    ]


def sized(structure, **values):
    """A structure of zeros and of these values, with its size in it."""
    return structure(struct_size=ctypes.sizeof(structure), **values)
