#!/bin/sh
# Hosts on two and on four processes, with MUMPS and a matrix that lies on all of them: one that
# condenses (its Schur complement to the library), one that only multiplies and solves. Each finds
# what the library finds by itself on the whole matrix, and displacements come back to the processes.
# The first in C and in Fortran 90.
#
#     sh tests/host_mpi.sh [--require]
#
# Without MPI or the parallel MUMPS it is skipped and ends with 77; with --require it fails. MPICC,
# MPIFORT and MPIRUN name the compilers and the launcher, MUMPS the directory of dmumps_c.h and
# dmumps_struc.h, default /usr/include.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/host_mpi
examples=$root/c_examples
mpi=$examples/hosts/mpi
mpicc=${MPICC:-mpicc}
mpirun=${MPIRUN:-mpirun}
mpifort=${MPIFORT:-mpifort}
mumps=${MUMPS:-/usr/include}

rm -rf -- "$work"
mkdir -p -- "$work"

missing=
command -v "$mpicc" >/dev/null 2>&1 || missing=" libopenmpi-dev"
command -v "$mpirun" >/dev/null 2>&1 || missing="$missing openmpi-bin"
"$mpifort" --version >/dev/null 2>&1 || missing="$missing gfortran"
# The sequential MUMPS has the same header, but another name of the library.
printf 'int main(void) { return 0; }\n' >"$work/empty.c"
[ -f "$mumps/dmumps_c.h" ] &&
    "$mpicc" "$work/empty.c" -ldmumps -o "$work/empty" >/dev/null 2>&1 ||
    missing="$missing libmumps-dev"
if [ -n "$missing" ]; then
    echo "host_mpi: SKIPPED: missing (names of Debian):$missing"
    [ "${1-}" != --require ] || exit 1
    exit 77
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")

# build PROGRAM SOURCE...
build() {
    program=$1
    shift
    "$mpicc" -std=c11 -O2 -Wall -Wextra -Wshadow -Wconversion -Werror -I"$root/include" -I"$mumps" \
        "$mpi/$program.c" "$@" "$mpi/serial.c" "$mpi/factor.c" "$mpi/block.c" \
        "$examples/3d/brick_mesh.c" "$examples/3d/brick_element.c" "$examples/common/checks.c" \
        "$root/target/release/libsignorini.a" -ldmumps -lm -lpthread -ldl -o "$work/$program"
}

# shellcheck source=tests/common/mpi.sh
. "$root/tests/common/mpi.sh"

build schur
build products "$mpi/service.c"
for program in schur products; do
    for processes in 2 4; do
        # shellcheck disable=SC2086 # several options
        "$mpirun" $options -n "$processes" "$work/$program" || {
            echo "host_mpi: $program on $processes processes failed"
            exit 1
        }
    done
done

# The bar, whose solution is known.
script=host_mpi
FC=$mpifort
# shellcheck source=tests/fortran/build.sh
. "$root/tests/fortran/build.sh"
compile mumps_schur_mpi static "-I$mumps" "$root/include/signorini.f90" \
    "$examples/hosts/fortran/bar_mesh.f90" "$examples/hosts/fortran/mumps_schur_mpi.f90" -ldmumps
for processes in 2 4; do
    name=mumps_schur_mpi_$processes
    printf '#!/bin/sh\nexec "%s" %s -n %s "%s"\n' "$mpirun" "$options" "$processes" \
        "$work/mumps_schur_mpi" >"$work/$name"
    chmod +x "$work/$name"
    compare "$name"
    grep 'displacements on' "$work/$name.out"
done
echo "host_mpi: passed"
