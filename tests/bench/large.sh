#!/bin/sh
# What large models cost, in one table: CPU time and peak memory of the reduction, of the first load case, and
# of a further one.
#
#     sh tests/bench/large.sh OUT [CASE ...]
#
# Runs `cargo bench --bench large_rows` and writes OUT/large.csv, with the columns
#
#     case,dim,unknowns,contact_dofs,library,blas,step,cpu_s,peak_mb,eta,status
#
# and OUT/large.txt, with what the runs say of them. A CASE is block, bar, or the nodes along an edge of
# a cube; the default, block bar 26 33, takes a few minutes and 1.4 GB; 47 takes more than two minutes and 5.5 GB
# by itself. Each case is a process of its own, so that peaks are those of the case. Times are those of one
# thread; on a busy machine they are longer.
set -eu
LC_ALL=C
export LC_ALL

say() { printf 'large: %s\n' "$*" >&2; }
die() {
    say "$*"
    exit 1
}

[ $# -ge 1 ] || die "usage: sh tests/bench/large.sh OUT [block | bar | NODES] ..."
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
mkdir -p -- "$1" || die "cannot create the directory $1"
out=$(CDPATH='' cd -- "$1" && pwd)
shift
[ $# -gt 0 ] || set -- block bar 26 33
for case in "$@"; do
    case $case in
    block | bar) ;;
    *[!0-9]* | '' | 0 | 1) die "$case is no case: block, bar, or a number of nodes from 2 on" ;;
    esac
done

cd "$root"
say "building"
cargo build --release --quiet --bench large_rows || die "the build failed"
echo "case,dim,unknowns,contact_dofs,library,blas,step,cpu_s,peak_mb,eta,status" >"$out/large.csv"
: >"$out/large.txt"
for case in "$@"; do
    say "$case"
    rows=$(cargo bench --quiet --bench large_rows -- "$case") || die "$case did not end"
    printf '%s\n' "$rows" | grep -v -e '^#' -e '^case,' >>"$out/large.csv"
    printf '%s\n' "$rows" >>"$out/large.txt"
done
say "wrote $out/large.csv and $out/large.txt"
