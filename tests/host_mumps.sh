#!/bin/sh
# MUMPS in a Fortran 90 host: Schur complement and condensed loads by MUMPS, contact forces by the
# library, the bar's forces in the end.
#
#     sh tests/host_mumps.sh [--require]
#
# Without gfortran and MUMPS (libmumps-seq-dev in Debian) it is skipped, or fails with --require.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/host_mumps
fc=${FC:-gfortran}
mumps=/usr/include/mumps_seq

if ! command -v "$fc" >/dev/null || ! [ -f "$mumps/mpif.h" ]; then
    echo "host_mumps: '$fc' or MUMPS is missing (gfortran and libmumps-seq-dev in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "host_mumps: SKIPPED"
    exit 0
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
rm -rf "$work"
mkdir -p "$work"
cd "$work"

hosts=$root/c_examples/hosts
for program in bar_sparse mumps_schur; do
    "$fc" -Wall -Werror -ffpe-trap=invalid,zero,overflow "-I$mumps" -I/usr/include -J. \
        "$root/include/signorini.f90" "$hosts/bar_mesh.f90" "$hosts/$program.f90" \
        "$root/target/release/libsignorini.a" -ldmumps_seq -lm -lpthread -ldl -o $program
    ./$program | grep "^node" >$program.printed
done
# tests/fortran.sh holds the first to the reference; the second has another condensation, by MUMPS.
paste bar_sparse.printed mumps_schur.printed | awk '$1 == "node" {
        n++
        for (q = 0; q < 4; q++) {
            a = $(NF / 2 - 3 + q); b = $(NF - 3 + q)
            size = a < 0 ? -a : a; off = a - b < 0 ? b - a : a - b
            which = q < 2
            if (size > most[which]) most[which] = size
            if (off > worst[which]) worst[which] = off
        }
    }
    END {
        printf "host_mumps: %d nodes, displacements off by %.0e and forces by %.0e of the largest\n",
            n, worst[1] / most[1], worst[0] / most[0]
        exit !(n == 33 && worst[1] < 1e-9 * most[1] && worst[0] < 1e-9 * most[0])
    }'
