"""A recipe for Conan 2: `conan create c_examples/install`. It needs Rust, and a network or crates that are there."""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain
from conan.tools.files import copy, load


class Signorini(ConanFile):
    name = "signorini"
    description = "Unilateral contact with Coulomb friction for existing finite-element codes"
    license = "MIT OR Apache-2.0"
    package_type = "shared-library"  # a static one lies beside it
    settings = "os", "arch", "compiler", "build_type"

    def _clone(self):
        return os.path.join(self.recipe_folder, os.pardir, os.pardir)

    def set_version(self):
        self.version = re.search(r'^version = "(.*)"', load(self, os.path.join(self._clone(), "Cargo.toml")), re.M)[1]

    def export_sources(self):
        for pattern in ("Cargo.*", "LICENSE-*", "src/*", "include/*", "tests/*", "c_examples/*"):
            copy(self, pattern, src=self._clone(), dst=self.export_sources_folder)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BUILD_TESTING"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder="c_examples")
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The CMake package of the library says more than Conan's generators would.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "signorini")]
        self.cpp_info.libs = ["signorini"]
