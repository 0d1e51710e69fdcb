#!/bin/sh
# Computes the bolted junction with the C host program junction/bolted_junction.c.
#
#     sh c_examples/junction.sh [OUT]
#
# Builds the library, compiles the program against it (CC names the C compiler, default cc) and runs
# it. With OUT, a directory, it also writes OUT/bolted_junction.csv and OUT/junction_mu0.3_STEP.vtk,
# which junction/bolted_junction.py draws. All else goes to target/.
set -eu

script=junction
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh junction.sh [OUT]"
check_tools
if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

prepare
compile bolted_junction junction/bolted_junction.c junction/junction_mesh.c \
    junction/junction_element.c junction/junction_output.c junction/junction_check.c \
    common/checks.c common/watch.c

say "running it"
echo
"$build/bolted_junction" "$@"
