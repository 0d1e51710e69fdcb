#!/bin/sh
# CalculiX as the host: the bar on the plane, from its deck and back.
#
#     sh c_examples/hosts/calculix/calculix.sh [OUT]
#
# CalculiX (ccx, or what CCX names) writes the stiffness matrix of the deck, a C program has the
# library find contact and friction and writes displacements as *BOUNDARY, and CalculiX solves its
# own static step with these: the forces that it reports at the contact nodes must be those of the
# library. With OUT, a directory, all files go there; otherwise all go to target/.
set -eu

script=calculix
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh calculix.sh [OUT]"
check_tools
ccx=${CCX:-ccx}
command -v "$ccx" >/dev/null ||
    die "CalculiX ('$ccx') is missing: install it (calculix-ccx in Debian), or set CCX"
out=${1:-$build/calculix}
mkdir -p -- "$out" || die "cannot create the directory $out"
out=$(CDPATH='' cd -- "$out" && pwd)
host=$examples/hosts/calculix

prepare
compile bar_contact hosts/calculix/bar_contact.c hosts/calculix/matrix_files.c \
    bar/bar_check.c common/checks.c

# ccx may end with 0 after an error: what counts is the file that it should write.
run_ccx() {
    cp -- "$host/$1.inp" "$out"
    rm -f -- "$out/$1.$2"
    say "running CalculiX: $1"
    (cd "$out" && "$ccx" -i "$1" >"$1.log" 2>&1) || die "CalculiX failed, see $out/$1.log"
    [ -s "$out/$1.$2" ] || die "CalculiX wrote no $1.$2, see $out/$1.log"
}

awk -v "mesh=$out/bar_mesh.inc" -v "loads=$out/bar_loads.inc" -f "$host/bar_mesh.awk"
run_ccx bar_matrix sti
"$build/bar_contact" "$out"
run_ccx bar_static dat
awk -f "$host/compare.awk" "$out/bar_forces.csv" "$out/bar_static.dat"
