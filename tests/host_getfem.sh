#!/bin/sh
# GetFEM as the host: its tangent matrix to the library, and the same contact forces as from its own
# contact brick.
#
#     sh tests/host_getfem.sh [--require]
#
# Without a Python that has GetFEM it is skipped and ends with 77; with
# --require it fails.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

# Debian installs python3-getfem for its own Python; another one may come first in PATH.
python=
for candidate in /usr/bin/python3 python3; do
    if "$candidate" -c 'import getfem, numpy' >/dev/null 2>&1; then
        python=$candidate
        break
    fi
done
if [ -z "$python" ]; then
    echo "host_getfem: no python3 has GetFEM (python3-getfem in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "host_getfem: SKIPPED"
    exit 77
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
# The library of this tree, and no files of Python beside its sources.
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE
unset SIGNORINI_LIBRARY
"$python" "$root/c_examples/hosts/getfem/getfem_bar.py"
echo "host_getfem: passed"
