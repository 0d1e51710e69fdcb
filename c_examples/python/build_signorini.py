"""Builds the package signorini for pip (PEP 517): Python files and the shared library of cargo.

It asks for nothing but Python and cargo. In a clone the crate is two folders up; in a source
distribution it is in crate/, beside this file. CARGO_TARGET_DIR says where cargo builds, by default
in target/ of the crate.

SIGNORINI_WHEEL_LIBRARY is the path of a library that has been built, and SIGNORINI_WHEEL_PLATFORM the
platform of its wheel, say manylinux_2_17_x86_64: install/wheels.sh sets both.
"""

import base64
import gzip
import hashlib
import io
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
PACKAGE = "signorini"
DESCRIPTION = """\
Contact with Coulomb friction for finite-element codes: stiffness matrices, loads and gaps go in, contact forces and
displacements come out, with a certificate that judges them from these data alone.

    import signorini

    result = signorini.solve([[5, 0], [0, 3]], [10, 8], gap=0, mu=0.5)
    print(result.message, result.d, result.F, result.state)

The library is inside, written in Rust; numpy is all that the package needs, and `result.plot()` needs matplotlib.
"""
# Files and folders that the crate is built from, below its top.
CRATE_FILES = ("Cargo.toml", "Cargo.lock", "README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "LICENSE-THIRD-PARTY")
CRATE_FOLDERS = {"src": "", "include": "", os.path.join("tests", "bench"): ".rs"}  # and the ends of names
LICENCES = ("LICENSE-MIT", "LICENSE-APACHE", "LICENSE-THIRD-PARTY")
WHEN = (1980, 1, 1, 0, 0, 0)  # the same files give the same bytes
READABLE, EXECUTABLE = 0o100644, 0o100755


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel of this platform; returns its name."""
    files = {f"{PACKAGE}/{name}": _read(HERE, PACKAGE, name) for name in _modules()}
    library = _library()
    files[f"{PACKAGE}/{os.path.basename(library)}"] = _read(library)
    return _wheel(wheel_directory, files)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes a wheel that leads to this folder, for pip install -e; the library stays in target/release."""
    _library()
    return _wheel(wheel_directory, {f"{PACKAGE}.pth": (HERE + "\n").encode()})


def build_sdist(sdist_directory, config_settings=None):
    """Writes the source distribution, with all that cargo needs; returns its name."""
    crate = _crate()
    top = f"{PACKAGE}-{_version()}"
    files = {name: _read(HERE, name) for name in ("pyproject.toml", "build_signorini.py")}
    files["PKG-INFO"] = _metadata().encode()
    files.update({f"{PACKAGE}/{name}": _read(HERE, PACKAGE, name) for name in _modules()})
    files.update({f"crate/{name}": _read(crate, name) for name in _crate_files(crate)})
    with gzip.GzipFile(os.path.join(sdist_directory, f"{top}.tar.gz"), "wb", mtime=0) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name, data in sorted(files.items()):
            entry = tarfile.TarInfo(f"{top}/{name}")
            entry.size, entry.mode = len(data), READABLE & 0o777
            archive.addfile(entry, io.BytesIO(data))
    return f"{top}.tar.gz"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Writes the metadata of the wheel without cargo; returns the name of their folder."""
    folder = _folder()
    for name, data in _about().items():
        path = os.path.join(metadata_directory, *name.split("/"))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)
    return folder


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


# ---- the crate ----

def _crate():
    for place in (os.path.join(HERE, "crate"), os.path.join(HERE, os.pardir, os.pardir)):
        if os.path.isfile(os.path.join(place, "Cargo.toml")):
            return os.path.abspath(place)
    raise SystemExit(f"signorini: there is no Cargo.toml in {HERE}/crate or two folders up: install from "
                     f"a whole clone, with pip 21.3 or later, which builds where the sources are")


def _crate_files(crate):
    """Names of the crate's files, from its top."""
    yield from CRATE_FILES
    for folder, end in CRATE_FOLDERS.items():
        for place, _, names in os.walk(os.path.join(crate, folder)):
            for name in names:
                if name.endswith(end):
                    yield os.path.relpath(os.path.join(place, name), crate).replace(os.sep, "/")


def _version():
    return re.search(r'^version = "(.*)"', _read(_crate(), "Cargo.toml").decode(), re.M)[1]


def _library():
    """Builds the shared library; returns its path."""
    built = os.environ.get("SIGNORINI_WHEEL_LIBRARY")
    if built:
        return built
    crate = _crate()
    target = os.path.abspath(os.environ.get("CARGO_TARGET_DIR") or os.path.join(crate, "target"))
    home = os.environ.get("CARGO_HOME") or os.path.join(os.path.expanduser("~"), ".cargo")
    # rustup installs cargo where PATH may not lead.
    path = os.pathsep.join([os.environ.get("PATH", os.defpath), os.path.join(home, "bin")])
    command = ["cargo", "build", "--release", "--locked", "--lib", "--target-dir", target]
    try:
        subprocess.run(command, cwd=crate, check=True, env={**os.environ, "PATH": path})
    except FileNotFoundError:
        raise SystemExit("signorini: cargo is missing: install Rust, https://rustup.rs") from None
    except subprocess.CalledProcessError:
        raise SystemExit("signorini: cargo build has failed, see above") from None
    name = {"darwin": "libsignorini.dylib", "win32": "signorini.dll"}.get(sys.platform, "libsignorini.so")
    return os.path.join(target, "release", name)


# ---- the wheel ----

def _modules():
    return sorted(name for name in os.listdir(os.path.join(HERE, PACKAGE)) if name.endswith(".py"))


def _read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def _folder():
    return f"{PACKAGE}-{_version()}.dist-info"


def _tag():
    """Any Python 3, this platform: the library is loaded by ctypes."""
    platform = os.environ.get("SIGNORINI_WHEEL_PLATFORM") or sysconfig.get_platform()
    return "py3-none-" + re.sub(r"[-.]", "_", platform)


def _metadata():
    return f"""Metadata-Version: 2.4
Name: {PACKAGE}
Version: {_version()}
Summary: Unilateral contact with Coulomb friction for existing finite-element codes
License-Expression: MIT OR Apache-2.0
License-File: LICENSE-MIT
License-File: LICENSE-APACHE
License-File: LICENSE-THIRD-PARTY
Classifier: Topic :: Scientific/Engineering :: Physics
Description-Content-Type: text/markdown
Keywords: contact,friction,finite elements,complementarity
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: plot
Requires-Dist: matplotlib; extra == "plot"

{DESCRIPTION}"""


def _about():
    """Files of the folder of metadata, but RECORD."""
    folder = _folder()
    wheel = f"Wheel-Version: 1.0\nGenerator: build_signorini\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    files = {f"{folder}/METADATA": _metadata().encode(), f"{folder}/WHEEL": wheel.encode()}
    files.update({f"{folder}/licenses/{name}": _read(_crate(), name) for name in LICENCES})
    return files


def _wheel(directory, files):
    files = {**files, **_about()}
    rows = [f"{name},sha256={_digest(data)},{len(data)}" for name, data in files.items()]
    record = f"{_folder()}/RECORD"
    files[record] = "\n".join([*rows, f"{record},,", ""]).encode()
    name = f"{PACKAGE}-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(os.path.join(directory, name), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, WHEN)
            entry.compress_type = zipfile.ZIP_DEFLATED
            text = path.endswith((".py", ".pth")) or ".dist-info/" in path
            entry.external_attr = (READABLE if text else EXECUTABLE) << 16
            archive.writestr(entry, data)
    return name


def _digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
