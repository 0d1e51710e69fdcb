#!/bin/sh
# CalculiX as the host: the forces that it reports for the library's displacements are those of the
# library, to the digits that it prints; matrix files that are not whole are told, not used.
#
#     sh tests/host_calculix.sh [--require]
#
# Without CalculiX (ccx, or what CCX names) it is skipped and ends with 77; with
# --require it fails.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
build=$root/target/c_examples
work=$root/target/tests/host\ calculix

if ! command -v "${CCX:-ccx}" >/dev/null; then
    echo "host_calculix: CalculiX ('${CCX:-ccx}') is not installed (calculix-ccx in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "host_calculix: SKIPPED"
    exit 77
fi

rm -rf -- "$work"
mkdir -p -- "$work"
sh "$root/c_examples/hosts/calculix/calculix.sh" "$work/run"

# A directory with the files of the run, of which the test then spoils one.
spoiled() {
    rm -rf -- "$work/spoiled"
    mkdir -- "$work/spoiled"
    cp -- "$work/run/bar_matrix.sti" "$work/run/bar_matrix.dof" "$work/run/bar_loads.inc" \
        "$work/spoiled"
}

# The program must refuse the spoiled files with a sentence that holds $1, and write nothing.
refused() {
    if "$build/bar_contact" "$work/spoiled" >"$work/said" 2>&1; then
        echo "host_calculix: not refused: $1"
        exit 1
    fi
    if ! grep -q "$1" "$work/said" || [ -e "$work/spoiled/bar_contact.inc" ]; then
        echo "host_calculix: not refused as it should be, $1:"
        cat "$work/said"
        exit 1
    fi
    echo "refused: $1"
}

spoiled
rm -- "$work/spoiled/bar_matrix.sti"
refused "cannot open the .dof and the .sti file"
spoiled
sed '100s/.*/garbage/' "$work/run/bar_matrix.sti" >"$work/spoiled/bar_matrix.sti"
refused "a line that is not row, column, value"
spoiled
sed '2s/.*/2 1 5.0/' "$work/run/bar_matrix.sti" >"$work/spoiled/bar_matrix.sti"
refused "not an upper triangle"
spoiled
head -n 300 "$work/run/bar_matrix.dof" >"$work/spoiled/bar_matrix.dof"
refused "not an upper triangle"
spoiled
head -n 3000 "$work/run/bar_matrix.sti" >"$work/spoiled/bar_matrix.sti"
refused "is missing, it must be positive"
spoiled
sed '3s/.*/1;2;3/' "$work/run/bar_loads.inc" >"$work/spoiled/bar_loads.inc"
refused "not node,direction,value"

echo "host_calculix: passed"
