"""A recipe for Spack. From the top of a clone, with a network or crates that are there:

    spack repo add c_examples/install/spack
    spack dev-build -d . signorini@0.9.0

A release on a public host takes `url` and the hash that release.sh prints.
"""

import os
import re

from spack.package import *

CLONE = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[os.pardir] * 5)
MANIFEST = open(os.path.join(CLONE, "Cargo.toml"), encoding="utf-8").read()


class Signorini(Package):
    """Unilateral contact with Coulomb friction for existing finite-element codes, behind a C interface."""

    license("MIT OR Apache-2.0")
    version(re.search(r'^version = "(.*)"', MANIFEST, re.M)[1])

    depends_on("rust@" + re.search(r'^rust-version = "(.*)"', MANIFEST, re.M)[1] + ":", type="build")

    sanity_check_is_file = ["include/signorini.h", "lib/libsignorini.a", "lib/pkgconfig/signorini.pc"]

    def install(self, spec, prefix):
        os.environ["PREFIX"] = prefix
        which("sh")(os.path.join("c_examples", "install", "install.sh"))
