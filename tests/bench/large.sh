#!/bin/sh
# Cost of large models, in one table: CPU time and peak memory of the reduction, of the first load case, and
# of a further one; and where MUMPS and CHOLMOD are, beside them.
#
#     sh tests/bench/large.sh OUT [CASE ...]
#
# Runs `cargo bench --bench large_rows` and writes OUT/large.csv, with the columns
#
#     case,dim,unknowns,contact_dofs,library,blas,step,cpu_s,peak_mb,eta,status
#
# OUT/threads.csv, the reduction on one and on two threads, as large_threads.c says; OUT/large.txt, with what the runs
# say of them; and the growth of time and memory: OUT/growth.md, and
# OUT/large.png where PYTHON, default python3, has matplotlib. A CASE is block, bar, square-NODES, the nodes
# along an edge of a cube, or these with the number of pairs, as in 26-67; the default takes some minutes and 2 GB; 47 takes more than two minutes and 5.5 GB by
# itself. Each case and library is a process of its own, so that peaks are those of the case. Times are those of
# one thread; on a busy machine they are longer.
#
# The libraries beside ours are compiled from large_peers.c and large_petsc.c where their headers are (names of Debian:
# libmumps-seq-dev, libsuitesparse-dev, libopenblas-dev, petsc-dev); CC names the compiler. They condense (MUMPS),
# factor (CHOLMOD), or solve without friction (PETSc's SNESVI) on the same matrix, right after ours and with OpenBLAS
# on one thread: as it chooses its kernels, and, on a CPU with AVX-512, with the kernels for that too, as an OpenBLAS
# that does not know the CPU takes others. Beside PETSc's time stands ours of `reduce` and `without friction`.
set -eu
LC_ALL=C
export LC_ALL

say() { printf 'large: %s\n' "$*" >&2; }
die() {
    say "$*"
    exit 1
}

[ $# -ge 1 ] || die "usage: sh tests/bench/large.sh OUT [block | bar | square-NODES | NODES | NODES-PAIRS] ..."
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
mkdir -p -- "$1" || die "cannot create the directory $1"
out=$(CDPATH='' cd -- "$1" && pwd)
shift
[ $# -gt 0 ] || set -- bar square-56 square-112 square-224 square-448 13 18 26-67 26-333 26 33
for case in "$@"; do
    case $case in
    block | bar) continue ;;
    esac
    edge=${case#square-}
    case ${edge%-*} in
    *[!0-9]* | '' | 0 | 1) die "$case is no case: block, bar, square-NODES, NODES or NODES-PAIRS, with 2 nodes or more" ;;
    esac
    case ${edge##*-} in
    *[!0-9]* | '' | 0) die "$case is no case: PAIRS is a number from 1 on" ;;
    esac
done

cd "$root"
say "building"
cargo build --release --quiet --bench large_rows || die "the build failed"
cargo build --release --quiet || die "the build failed"
mkdir -p target/bench
${CC:-cc} -O2 -std=c11 -D_GNU_SOURCE -Iinclude tests/bench/large_threads.c target/release/libsignorini.a \
    -o target/bench/large_threads -lm -lpthread -ldl || die "large_threads.c does not compile"
echo "case,dim,unknowns,contact_dofs,threads,wall_s,cpu_s,caller_cpu_s,bits" >"$out/threads.csv"
echo "case,dim,unknowns,contact_dofs,library,blas,step,cpu_s,peak_mb,eta,status" >"$out/large.csv"
: >"$out/large.txt"

peers=
headers=${SUITESPARSE:-/usr/include/suitesparse}
sequential=${MUMPS_SEQ:-/usr/include/mumps_seq}
if [ -f "$headers/cholmod.h" ] && [ -f "$sequential/mpi.h" ]; then
    peers=target/bench/large_peers
    ${CC:-cc} -O2 -std=c11 -D_GNU_SOURCE -I"$headers" -I"$sequential" tests/bench/large_peers.c -o $peers \
        -ldmumps_seq -lcholmod -lm || die "large_peers.c does not compile"
else
    say "without libmumps-seq-dev and libsuitesparse-dev there is nothing beside the condensation"
fi
petsc=
if command -v mpicc >/dev/null && pkg-config --exists petsc 2>/dev/null; then
    petsc=target/bench/large_petsc
    # shellcheck disable=SC2046 # options
    OMPI_CC=${CC:-cc} mpicc -O2 -std=c11 -D_GNU_SOURCE $(pkg-config --cflags petsc) tests/bench/large_petsc.c -o $petsc \
        $(pkg-config --libs petsc) -lm || die "large_petsc.c does not compile"
else
    say "without petsc-dev there is nothing beside the solution without friction"
fi
kernels=default
! grep -q avx512f /proc/cpuinfo 2>/dev/null || kernels="default SkylakeX"
OMP_NUM_THREADS=1
OPENBLAS_NUM_THREADS=1
SIGNORINI_LARGE_MATRIX=$root/target/bench/large.matrix
export OMP_NUM_THREADS OPENBLAS_NUM_THREADS SIGNORINI_LARGE_MATRIX

# The kernels of OpenBLAS.
set_kernels() {
    unset OPENBLAS_CORETYPE
    [ "$1" = default ] || export OPENBLAS_CORETYPE="$1"
}

# Adds the rows of a run to the table.
note() {
    printf '%s\n' "$1" | grep -v -e '^#' -e '^case,' >>"$out/large.csv"
    printf '%s\n' "$1" >>"$out/large.txt"
}

# beside LIBRARY BLAS: the case by another library.
beside() {
    case $1 in
    petsc) "$petsc" "$SIGNORINI_LARGE_MATRIX" "$case" $dim "$2" ;;
    *) "$peers" "$SIGNORINI_LARGE_MATRIX" "$1" "$case" $dim "$2" ;;
    esac
}

for case in "$@"; do
    say "$case"
    rows=$(cargo bench --quiet --bench large_rows -- "$case") || die "$case did not end"
    note "$rows"
    dim=3
    case $case in block | bar | square-*) dim=2 ;; esac
    target/bench/large_threads "$SIGNORINI_LARGE_MATRIX" "$case" $dim 1 2 >>"$out/threads.csv" ||
        die "$case on two threads did not end"
    for library in ${peers:+mumps cholmod} ${petsc:+petsc}; do
        for blas in $kernels; do
            say "$case, $library, kernels of OpenBLAS: $blas"
            set_kernels "$blas"
            rows=$(beside $library "OpenBLAS-$blas") || die "$library did not end"
            note "$rows"
        done
    done
    rm -f "$SIGNORINI_LARGE_MATRIX"
done
python=${PYTHON:-python3}
if command -v "$python" >/dev/null; then
    "$python" tests/bench/large_plot.py "$out/large.csv" "$out/large.png" >"$out/growth.md" || say "no growth table"
fi
say "wrote $out/large.csv and $out/large.txt"
