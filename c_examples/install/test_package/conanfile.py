"""The programs of tests/install with Conan's package: `conan create` runs them."""

import os

from conan import ConanFile
from conan.tools.cmake import CMake


class Test(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeToolchain", "VirtualRunEnv"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        self.folders.build = os.path.join(os.pardir, os.pardir, os.pardir, "target", "conan")
        self.folders.generators = self.folders.build

    def build(self):
        root = os.path.join(self.recipe_folder, os.pardir, os.pardir, os.pardir)
        cmake = CMake(self)
        cmake.configure(variables={"EXAMPLES": os.path.join(root, "c_examples")},
                        build_script_folder=os.path.join(root, "tests", "install"))
        cmake.build()

    def test(self):
        for name in ("shared", "static"):
            self.run(os.path.join(self.build_folder, name), env="conanrun")
