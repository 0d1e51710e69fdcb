#!/bin/sh
# The two blocks of c_examples/3d in C, Fortran and Python: each program checks its answer against
# statics, and the three answers are the same, pair by pair.
#
#     sh tests/two_blocks.sh [--require]
#
# FC and PYTHON name the compiler and the Python, default gfortran and python3. A language that is
# missing is skipped, and it ends with 77; with --require it fails.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/two_blocks
examples=$root/c_examples/3d
release=$root/target/release
python=${PYTHON:-python3}
fc=${FC:-gfortran}
skipped=

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
rm -rf -- "$work"
mkdir -p -- "$work/c" "$work/fortran" "$work/python"
cd "$work"
unset SIGNORINI_LIBRARY

missing() {
    echo "two_blocks, $1: '$2' is missing"
    [ "$required" != yes ] || exit 1
    echo "two_blocks, $1: SKIPPED"
    skipped=yes
}

# runs LANGUAGE COMMAND...: it must find its answer balanced, and write it.
runs() {
    language=$1
    shift
    "$@" "$work/$language" >"$language.out" 2>&1 ||
        { cat "$language.out"; echo "two_blocks: $language failed"; exit 1; }
    echo "two_blocks, $language: $(grep 'balance the loads' "$language.out" | sed 's/^ *PASS *//')"
}

# same LANGUAGE: its answer is C's. The programs add the same numbers in another order: rounding,
# some 1e-13 of the largest displacement or force, and no more than 1e-9.
same() {
    awk -F ', *' -v name="$1" '
        function size(x) { return x < 0 ? -x : x }
        FNR == 1 { next }
        FNR == NR { for (k = 1; k <= 9; k++) wanted[FNR, k] = $k; lines = FNR; next }
        {
            compared++
            if (NF != 9 || $9 != wanted[FNR, 9] || $1 != wanted[FNR, 1] + 0 ||
                $2 != wanted[FNR, 2] + 0) failed = 1
            for (k = 3; k <= 8; k++) {
                kind = k <= 5 ? "d" : "F"
                x = size($k - wanted[FNR, k]); if (x > off[kind]) off[kind] = x
                x = size(wanted[FNR, k] + 0); if (x > most[kind]) most[kind] = x
            }
        }
        END {
            printf "two_blocks, %s: %d pairs, d off by %.0e, F by %.0e of the largest of C\n", name,
                compared, off["d"] / most["d"], off["F"] / most["F"]
            if (compared != 81 || lines != 82) failed = 1
            exit (failed || off["d"] > 1e-9 * most["d"] || off["F"] > 1e-9 * most["F"])
        }' c/two_blocks.csv "$1/two_blocks.csv" || { echo "two_blocks: $1 is not C"; exit 1; }
}

required=
[ "${1-}" != --require ] || required=yes

# two_blocks.c holds all that contact adds to a host: at most 60 lines after the comment at its top.
lines=$(sed '1,/^ \*\/$/d' "$examples/two_blocks.c" | grep -c '')
[ "$lines" -le 60 ] || { echo "two_blocks: two_blocks.c has $lines lines"; exit 1; }
echo "two_blocks: $lines lines of C"
# shellcheck disable=SC2086 # options in CC
${CC:-cc} -std=c11 -O2 -Wall -Wextra -Wpedantic -Werror -I"$root/include" "$examples/two_blocks.c" \
    "$examples/two_blocks_check.c" "$examples/blocks.c" "$examples/brick_element.c" \
    "$examples/brick_mesh.c" \
    "$examples/brick_contact.c" "$examples/brick_output.c" "$examples/../common/checks.c" \
    "$release/libsignorini.a" -lm -lpthread -ldl -o two_blocks_c
runs c ./two_blocks_c

if command -v "$fc" >/dev/null 2>&1; then
    "$fc" -std=f2008 -O1 -Wall -Werror -ffpe-trap=invalid,zero,overflow \
        "$root/include/signorini.f90" "$examples/brick_mesh.f90" "$examples/two_blocks.f90" \
        "$release/libsignorini.a" -lm -lpthread -ldl -o two_blocks_fortran
    runs fortran ./two_blocks_fortran
    same fortran
else
    missing Fortran "$fc"
fi

if "$python" -c 'import numpy' >/dev/null 2>&1; then
    runs python "$python" "$examples/two_blocks.py"
    same python
else
    missing Python "$python with numpy"
fi
[ -z "$skipped" ] || exit 77
