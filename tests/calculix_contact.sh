#!/bin/sh
# CalculiX's own contact, surface to surface, beside the library's on the same meshes and matrices: the
# forces agree to 1 %. calculix_contact.py says how; it prints the times of both.
#
#     sh tests/calculix_contact.sh [--require]
#     sh tests/calculix_contact.sh --parts [PART ...]
#
# With --parts it compares the real parts of c_examples/parts instead, some minutes: calculix_parts.py says how.
# CCX and PYTHON name CalculiX and the Python, default ccx and python3. Without CalculiX or numpy it is
# skipped and ends with 77; with --require it fails.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
python=${PYTHON:-python3}

missing() {
    echo "calculix_contact: $1 is not installed ($2 in Debian)"
    [ "$required" != yes ] || exit 1
    echo "calculix_contact: SKIPPED"
    exit 77
}

required=
script=calculix_contact
case ${1-} in
    --require) required=yes; shift ;;
    --parts) required=yes; script=calculix_parts; shift ;;
esac
command -v "${CCX:-ccx}" >/dev/null || missing "CalculiX ('${CCX:-ccx}')" calculix-ccx
"$python" -c 'import numpy' >/dev/null 2>&1 || missing "numpy of $python" python3-numpy

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
unset SIGNORINI_LIBRARY
exec "$python" "$root/tests/$script.py" "$root/target/tests/$script" "$@"
