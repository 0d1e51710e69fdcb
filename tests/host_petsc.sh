#!/bin/sh
# A host with PETSc on one, two and four processes: products and cycles of its multigrid in the place of a factor
# (c_examples/hosts/petsc). A cube on a ball, and on a foundation whose mesh does not match; each run finds what the
# library finds by itself on the whole matrix.
#
#     sh tests/host_petsc.sh [--require]
#
# Without MPI or PETSc it is skipped and ends with 77; with --require it fails. MPICC, MPIRUN and PKG_CONFIG name the
# tools; PETSC is the name of the library for pkg-config, default petsc.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/host_petsc
examples=$root/c_examples
mpicc=${MPICC:-mpicc}
mpirun=${MPIRUN:-mpirun}
config=${PKG_CONFIG:-pkg-config}
petsc=${PETSC:-petsc}

rm -rf -- "$work"
mkdir -p -- "$work"

missing=
command -v "$mpicc" >/dev/null 2>&1 || missing=" libopenmpi-dev"
command -v "$mpirun" >/dev/null 2>&1 || missing="$missing openmpi-bin"
"$config" --exists "$petsc" 2>/dev/null || missing="$missing pkg-config libpetsc-real-dev"
if [ -n "$missing" ]; then
    echo "host_petsc: SKIPPED: missing (names of Debian):$missing"
    [ "${1-}" != --require ] || exit 1
    exit 77
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")

# The headers of PETSc have warnings of their own.
# shellcheck disable=SC2046 # several words
"$mpicc" -std=c11 -O2 -Wall -Wextra -Wshadow -Werror -I"$root/include" \
    $("$config" --cflags-only-I "$petsc" | sed 's/-I/-isystem /g') "$examples"/hosts/petsc/*.c \
    "$examples/3d/brick_mesh.c" "$examples/3d/brick_element.c" "$examples/common/checks.c" \
    "$root/target/release/libsignorini.a" $("$config" --libs "$petsc") -lm -lpthread -ldl -o "$work/contact"

# shellcheck source=tests/common/mpi.sh
. "$root/tests/common/mpi.sh"

for processes in 1 2 4; do
    for bodies in "-edge 12" "-edge 9 -foundation 8"; do
        # shellcheck disable=SC2086 # several options
        "$mpirun" $options -n "$processes" "$work/contact" $bodies -check || {
            echo "host_petsc: $bodies on $processes processes failed"
            exit 1
        }
    done
done
echo "host_petsc: passed"
