"""signorini.py: which shared library it takes, and whether both fit.

    python3 tests/python/library.py CC WORK       CC: a C compiler; WORK: a directory to write to
"""

import os
import re
import subprocess
import sys
import unittest

from common import LOAD, PYTHON, ROOT, K, text

import signorini

CC, WORK = "cc", "."
BUILT = os.path.join(ROOT, "target", "release", "libsignorini.so")


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
            self.assertIn("has the binary interface 999, but this module is written for "
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
        self.assertEqual(signorini.solve(K, LOAD, 0, 0.3).status, signorini.SOLVED)

    def test_is_found(self):
        version = re.search(r'^version = "(.*)"', text("Cargo.toml"), re.M)[1]
        self.assertEqual(signorini.load(), version)
        if os.path.exists(BUILT):
            code = "import os, signorini; os.chdir('/'); print(signorini.load())"
            found = self.run_python(code, SIGNORINI_LIBRARY=BUILT)
            self.assertEqual((found.stdout.strip(), found.stderr), (version, ""))

    def test_module_is_that_of_the_header(self):
        header = text("include", "signorini.h")
        constants = dict(re.findall(r"#define SIGNORINI_(\w+) (-?\d+)", header))
        self.assertEqual(int(constants["ABI_VERSION"]), signorini.ABI_VERSION)
        for name in ("SOLVED ITERATION_LIMIT TIME_LIMIT CANCELLED NO_EQUILIBRIUM STALLED "
                     "NOT_A_SOLUTION OPEN SLIP STICK").split():
            self.assertEqual(getattr(signorini, name), int(constants[name]), name)
        for prefix, names in (("METHOD", signorini.METHODS), ("SEARCH", signorini.SEARCHES),
                              ("FALLBACK", signorini.FALLBACKS), ("", signorini.UNIQUENESS),
                              ("", signorini.TRIANGLES)):
            for value, name in enumerate(names):
                key = f"{prefix}_{name}".strip("_").upper()
                self.assertEqual(int(constants[key]), value, key)
        header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
        kinds = {"c_int": "int32_t", "c_uint": "uint32_t", "c_long": "int64_t",
                 "c_longlong": "int64_t", "c_double": "double",
                 "CFunctionType": "signorini_progress_fn"}
        for name, structure in (("progress", signorini._Told), ("settings", signorini._Settings),
                                ("report", signorini._Report), ("sparse", signorini._Sparse),
                                ("pairs", signorini._Pairs)):
            body = re.search(rf"struct signorini_{name} \{{(.*?)\}}", header, re.S)[1]
            fields = [re.match(r"(.*?)\s*(\w+)$", " ".join(line.split())).groups()
                      for line in body.split(";") if line.strip()]
            # Later versions may have more fields at the end.
            self.assertLessEqual(len(structure._fields_), len(fields))
            for (field, kind), (c_kind, c_name) in zip(structure._fields_, fields):
                self.assertEqual(field, c_name)
                expected = kinds.get(kind.__name__)
                if expected:
                    self.assertEqual(c_kind, expected, field)
                else:
                    self.assertTrue(c_kind.endswith("*"), field)
        for name, (_, arguments) in signorini._SIGNATURES.items():
            declared = re.search(rf"\bsignorini_{name}\(([^)]*)\);", header)[1]
            count = 0 if declared.strip() == "void" else declared.count(",") + 1
            self.assertEqual(len(arguments), count, name)


if __name__ == "__main__":
    CC, WORK = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1])
