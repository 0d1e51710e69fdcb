#!/bin/sh
# pip installs the Python package from a clone, with the library inside, without a network: as a wheel, in place, and
# from a source distribution.
#
#     sh tests/python_package.sh [--require]
#
# PYTHON names the Python, default python3. Without pip, venv or numpy it is skipped and ends with 77; with --require it
# fails, and the source distribution, which compiles the library once more, is installed too.
set -eu
LC_ALL=C
export LC_ALL
unset SIGNORINI_LIBRARY PYTHONPATH

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/python\ package
python=${PYTHON:-python3}
say() { printf 'python package: %s\n' "$*"; }
die() {
    say "$*"
    exit 1
}
rm -rf -- "$work"
mkdir -p -- "$work"
if ! "$python" -c 'import numpy' >/dev/null 2>&1 ||
    ! "$python" -m venv --system-site-packages "$work/venv" >"$work/log" 2>&1; then
    say "'$python' has no numpy or makes no venv with pip (python3-numpy and python3-venv in Debian)"
    [ "${1-}" != --require ] || exit 1
    say "SKIPPED"
    exit 77
fi
inside=$work/venv/bin/python
CARGO_TARGET_DIR=$root/target
CARGO_NET_OFFLINE=true
CARGO_TERM_QUIET=true
export CARGO_TARGET_DIR CARGO_NET_OFFLINE CARGO_TERM_QUIET

# pip ARGUMENT...: never from an index.
pip() {
    "$inside" -m pip --disable-pip-version-check --no-input "$@" --no-index >"$work/log" 2>&1 ||
        { cat "$work/log"; die "pip $* has failed"; }
}

# The package that is imported lies below $1, its library below $2, and it solves.
uses() {
    (cd "$work" && "$inside" -B - "$1" "$2") <<'END'
import os
import sys

import signorini

with open("/proc/self/maps", encoding="utf-8") if os.path.exists("/proc/self/maps") else open(os.devnull) as maps:
    signorini.load()
    loaded = [line.split(None, 5)[-1].strip() for line in maps if "libsignorini" in line]
assert signorini.__file__.startswith(sys.argv[1]), signorini.__file__
assert all(place.startswith(sys.argv[2]) for place in loaded), loaded
result = signorini.solve([[2, 0], [0, 2]], [1, 1], gap=0, mu=0.3)
assert result.status == signorini.Status.SOLVED and abs(result.F[0, 1] + 0.3) < 1e-9
END
}

pip install --no-deps "$root/c_examples/python"
uses "$work/venv" "$work/venv"
[ -z "$("$inside" -m pip check | grep signorini)" ] || die "pip finds its dependencies broken"
grep -q "^Version: $(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")\$" \
    "$work"/venv/lib/python3*/site-packages/signorini-*.dist-info/METADATA || die "the version is not that of Cargo.toml"
say "installed from a clone: $(du -k "$work"/venv/lib/python3*/site-packages/signorini/libsignorini.* | cut -f 1) kB of library"
pip wheel --no-deps -w "$work/wheel" "$root/c_examples/python"
# Every file with its digest, and no other.
"$inside" - "$work"/wheel/*.whl <<'END'
import base64
import csv
import hashlib
import sys
import zipfile

with zipfile.ZipFile(sys.argv[1]) as wheel:
    names = set(wheel.namelist())
    record, = [name for name in names if name.endswith("/RECORD")]
    rows = list(csv.reader(wheel.read(record).decode().splitlines()))
    assert {row[0] for row in rows} == names
    for name, digest, size in rows:
        data = wheel.read(name)
        if name != record:
            found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            assert (digest, size) == ("sha256=" + found, str(len(data))), name
END
say "wheel: $(ls "$work/wheel")"

"$inside" -m pip uninstall -y signorini >"$work/log" 2>&1
pip install --no-deps -e "$root/c_examples/python"
uses "$root/c_examples/python" "$root/target/release"
"$inside" -m pip uninstall -y signorini >"$work/log" 2>&1
say "installed in place, by pip install -e"

(cd "$root/c_examples/python" && "$inside" -B -c '
import sys
import build_signorini
print(build_signorini.build_sdist(sys.argv[1]))' "$work" >"$work/name")
archive=$work/$(cat "$work/name")
tar tzf "$archive" >"$work/contents"
for name in pyproject.toml PKG-INFO signorini/__init__.py crate/Cargo.lock crate/src/lib.rs crate/LICENSE-MIT; do
    grep -q "^[^/]*/$name\$" "$work/contents" || die "the source distribution lacks $name"
done
if [ "${1-}" = --require ]; then
    # Elsewhere: nothing of the clone is near.
    CARGO_TARGET_DIR=$work/target
    pip install --no-deps "$archive"
    uses "$work/venv" "$work/venv"
    say "installed from the source distribution"
else
    say "source distribution: $(wc -l <"$work/contents" | tr -d ' ') files; SKIPPED: installing it"
    exit 77
fi
