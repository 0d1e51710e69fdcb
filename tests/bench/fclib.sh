#!/bin/sh
# Friction files of multibody dynamics, by this library's flexibility form and by Siconos.
#
#     sh tests/bench/fclib.sh FOLDER [SECONDS]
#
# Builds the library, compiles tests/bench/fclib.c against it, libfclib and Siconos (Debian:
# libfclib-dev, libsiconos-numerics-dev, libopenblas0; CC names the C compiler, default cc) and runs
# it on all files of FOLDER: those of FCLIB end in .hdf5 or .h5, Siconos' own in .dat. A Markdown table
# goes to standard output, the names of files and what is wrong with one to standard error, all else
# to target/bench. Each call may take SECONDS of processor time, default 10.
set -eu
LC_ALL=C
export LC_ALL

die() {
    printf 'fclib: %s\n' "$*" >&2
    exit 1
}

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/target/bench
cc=${CC:-cc}
headers=/usr/include/siconos

[ $# -eq 1 ] || [ $# -eq 2 ] || die "usage: sh tests/bench/fclib.sh FOLDER [SECONDS]"
[ -d "$1" ] || die "$1 is no folder"
folder=$1
seconds=${2:-10}
pkg-config --exists fclib hdf5 2>/dev/null || die "install libfclib-dev first"
[ -f "$headers/numerics/fc3d_Solvers.h" ] ||
    die "install libsiconos-numerics-dev and libopenblas0 first"

set --
for file in "$folder"/*.hdf5 "$folder"/*.h5 "$folder"/*.dat; do
    [ ! -f "$file" ] || set -- "$@" "$file"
done
[ $# -gt 0 ] || die "$folder has no file that ends in .hdf5, .h5 or .dat"

(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target") >&2
mkdir -p "$build"
# shellcheck disable=SC2046,SC2086 # lists of options
(cd "$root/tests/bench" &&
    $cc -std=c11 -O2 -Wall -Wextra -Wpedantic -Wshadow -Werror -D_DEFAULT_SOURCE \
        -I "$root/include" -I "$root/c_examples/fclib" -isystem "$headers" \
        -isystem "$headers/numerics" $(pkg-config --cflags fclib hdf5) \
        -o "$build/fclib" fclib.c fclib_dat.c fclib_siconos.c \
        "$root/c_examples/fclib/local_form.c" "$root/c_examples/fclib/bodies.c" \
        "$root/c_examples/fclib/dense.c" \
        "$root/target/release/libsignorini.a" $(pkg-config --libs fclib hdf5) \
        -lsiconos_numerics -l:libopenblas.so.0 -lm -lpthread -ldl)

OPENBLAS_NUM_THREADS=1
OMP_NUM_THREADS=1
export OPENBLAS_NUM_THREADS OMP_NUM_THREADS
exec "$build/fclib" "$seconds" "$@"
