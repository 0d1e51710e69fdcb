"""The Python package: which shared library it takes, and whether both fit.

    python3 tests/python/library.py CC WORK       CC: a C compiler; WORK: a directory to write to
"""

import ctypes
import os
import re
import subprocess
import sys
import unittest

import numpy as np

from common import LOAD, PYTHON, ROOT, K, text

import signorini
from signorini import _library as library
from signorini import _structures as structures
from signorini._constants import Obstacle, Problem
from signorini._sparse import Matrix

CC, WORK = "cc", "."
HEADERS = "signorini.h", "signorini_surface.h", "signorini_file.h"
FAMILIES = (signorini.Status, signorini.State, signorini.Law, signorini.Method, signorini.Search,
            signorini.Uniqueness, signorini.Proof, signorini.Fallback, signorini.Remark,
            signorini.Triangle, signorini.ModelKind, signorini.Pairing, signorini.Normals, signorini.Rims,
            Obstacle, Problem)
STRUCTURES = {structures.Told: "progress", structures.Settings: "settings",
              structures.Report: "report", structures.Extra: "extra", structures.Sparse: "sparse",
              structures.EquationList: "equations", structures.Pairs: "pairs", structures.Faces: "faces",
              structures.RigidObstacle: "obstacle", structures.SurfaceSettings: "surface_settings",
              structures.ModelData: "model_data", structures.SurfaceData: "surface_data",
              structures.Zone: "zone", structures.ProblemData: "problem_data",
              structures.Operator: "operator",
              structures.ContactFields: "contact_fields", structures.ResultantSums: "resultant", structures.PenetrationData: "penetration",
              structures.Mesh: "mesh", structures.NodalField: "field"}
MACHINE = 18  # where a file of ELF names the processor
BUILT = os.path.join(ROOT, "target", "release", "libsignorini.so")


def headers():
    """All headers, those with what may still change too, without comments."""
    words = "".join(text("include", name) for name in HEADERS)
    return re.sub(r"/\*.*?\*/", "", words, flags=re.S)


class Library(unittest.TestCase):
    """Each in a Python of its own."""

    def run_python(self, code, **environment):
        code = f"import sys; sys.path.insert(0, {PYTHON!r})\n" + code
        return subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True,
                              env={**os.environ, **environment}, check=False)

    def fake(self, name, source):
        path = os.path.join(WORK, name)
        with open(path + ".c", "w", encoding="ascii") as file:
            file.write(source)
        subprocess.run([*CC.split(), "-shared", "-fPIC", "-o", path, path + ".c"], check=True)
        return path

    def test_another_interface_is_told(self):
        # All that it has is its number: any other call would crash.
        path = self.fake("libanother.so", "int signorini_abi_version(void) { return 999; }\n")
        code = "import signorini\ntry: signorini.solve([[1, 0], [0, 1]], [1, 0], 0, 0)\n" \
               "except signorini.SignoriniError as error: print(error)"
        for result in (
            self.run_python(code, SIGNORINI_LIBRARY=path),
            self.run_python(f"import signorini\ntry: signorini.load({path!r})\n"
                            "except signorini.SignoriniError as error: print(error)"),
        ):
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("has the binary interface 999, but this package is written for "
                          f"{signorini.ABI_VERSION}", result.stdout)

    def test_what_is_not_it_is_told(self):
        number = signorini.ABI_VERSION
        for path, words in (
            (self.fake("libother.so", "int other(void) { return 1; }\n"), "is not the library"),
            (self.fake("libolder.so",
                       f"int signorini_abi_version(void) {{ return {number}; }}\n"), "is older"),
            (os.path.join(WORK, "nowhere.so"), "cannot be loaded"),
        ):
            with self.assertRaisesRegex(signorini.SignoriniError, words):
                signorini.load(path)
        self.assertEqual(signorini.solve(K, LOAD, 0, 0.3).status, signorini.Status.SOLVED)

    def test_a_library_that_it_needs_is_missing(self):
        needed = self.fake("libneeded.so", "int needed(void) { return 1; }\n")
        path = os.path.join(WORK, "libneedy.so")
        with open(path + ".c", "w", encoding="ascii") as file:
            file.write("int needed(void);\nint signorini_abi_version(void) { return needed(); }\n")
        subprocess.run([*CC.split(), "-shared", "-fPIC", "-o", path, path + ".c", needed], check=True)
        os.remove(needed)
        with self.assertRaisesRegex(signorini.SignoriniError, "libneeded.*a library that it needs is missing"):
            signorini.load(path)

    def test_another_processor_is_told(self):
        path = self.fake("libforeign.so", "int signorini_abi_version(void) { return 0; }\n")
        with open(path, "r+b") as file:
            file.seek(MACHINE)
            file.write(b"\xff\xff")
        with self.assertRaisesRegex(signorini.SignoriniError, "it is for another system or processor"):
            signorini.load(path)

    def test_a_python_of_32_bits_is_told(self):
        code = "import ctypes, signorini\nctypes.sizeof = lambda kind: 4\ntry: signorini.load()\n" \
               "except signorini.SignoriniError as error: print(error)"
        result = self.run_python(code)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("needs a Python of 64 bits, and this one has 32", result.stdout)

    def test_is_found(self):
        version = re.search(r'^version = "(.*)"', text("Cargo.toml"), re.M)[1]
        self.assertEqual(signorini.load(), version)
        if os.path.exists(BUILT):
            code = "import os, signorini; os.chdir('/'); print(signorini.load())"
            found = self.run_python(code, SIGNORINI_LIBRARY=BUILT)
            self.assertEqual((found.stdout.strip(), found.stderr), (version, ""))

    def test_constants_are_those_of_the_header(self):
        constants = dict(re.findall(r"#define SIGNORINI_(\w+) \(?(-?\d+)\)?", headers()))
        self.assertEqual(int(constants["ABI_VERSION"]), signorini.ABI_VERSION)
        for family in FAMILIES:
            prefix = family.__name__.upper().removesuffix("KIND") + "_"
            found = {name[len(prefix):]: int(value) for name, value in constants.items()
                     if name.startswith(prefix)}
            self.assertEqual({each.name: each.value for each in family}, found)

    def test_structures_are_those_of_the_header(self):
        header = headers()
        kinds = {"c_int": "int32_t", "c_uint": "uint32_t", "c_long": "int64_t",
                 "c_longlong": "int64_t", "c_double": "double",
                 "c_double_Array_3": "double"}
        for structure, name in STRUCTURES.items():
            body = re.search(rf"struct signorini_{name} \{{(.*?)\}}", header, re.S)[1]
            fields = [re.match(r"(.*?)\s*(\w+)(?:\[\d\])?$", " ".join(line.split())).groups()
                      for line in body.split(";") if line.strip()]
            # Later versions may have more fields at the end.
            self.assertLessEqual(len(structure._fields_), len(fields))
            for (field, kind), (c_kind, c_name) in zip(structure._fields_, fields):
                self.assertEqual(field, c_name)
                expected = kinds.get(kind.__name__)
                if expected:
                    self.assertEqual(c_kind, expected, field)
                elif kind.__name__ == "CFunctionType":
                    self.assertRegex(c_kind, "signorini_(progress|product|held|precondition)_fn", field)
                else:
                    self.assertTrue(c_kind.endswith("*"), field)

    def test_functions_are_those_of_the_header(self):
        header = headers()
        kinds = {"int32_t": "c_int", "int64_t": ("c_long", "c_longlong"), "uint32_t": "c_uint",
                 "double": "c_double"}
        for name, (_, arguments) in library.SIGNATURES.items():
            declared = re.search(rf"\bsignorini_{name}\(([^)]*)\);", header)[1]
            declared = [] if declared.strip() == "void" else declared.split(",")
            self.assertEqual(len(arguments), len(declared), name)
            for kind, words in zip(arguments, declared):
                pointer = "c_char_p" if "char *" in words else "c_void_p"
                expected = pointer if "*" in words else kinds[words.split()[0]]
                self.assertIn(kind.__name__, expected, f"{name}: {words}")

    def test_sizes_are_those_of_the_library(self):
        functions = library.library()
        too_large = 10**6
        room = ctypes.create_string_buffer(too_large)
        for name, structure in (("settings", structures.Settings), ("report", structures.Report),
                                ("extra", structures.Extra)):
            default = getattr(functions, name + "_default")
            self.assertEqual(default(room, too_large), -2, name)
            self.told(functions, ctypes.sizeof(structure))
            filled = structure()
            self.assertEqual(default(ctypes.byref(filled), ctypes.sizeof(structure)), 0)
            self.assertEqual(filled.struct_size, ctypes.sizeof(structure))
        # A matrix or pairs without a size are told the one that is asked.
        matrix, pairs, model = structures.Sparse(), structures.Pairs(), ctypes.c_void_p()
        arguments = [ctypes.byref(matrix), 0, None, ctypes.byref(pairs), None, ctypes.byref(model)]
        self.assertEqual(functions.model_new_sparse(*arguments), -1)
        self.told(functions, ctypes.sizeof(matrix))
        springs = Matrix((np.ones(2), np.arange(2), np.arange(3)), "full")
        arguments[0] = ctypes.byref(springs.structure)
        self.assertEqual(functions.model_new_sparse(*arguments), -4)
        self.told(functions, ctypes.sizeof(pairs))

    def told(self, functions, size):
        self.assertIn(str(size), re.findall(r"\d+", functions.last_error().decode()))


if __name__ == "__main__":
    CC, WORK = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1])
