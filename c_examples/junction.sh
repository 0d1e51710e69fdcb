#!/bin/sh
# Computes the bolted junction with the C host program of this directory.
#
#     sh c_examples/junction.sh [OUT]
#
# Builds the library, compiles the program against it (CC names the C compiler, default cc) and runs
# it. With OUT, a directory, it also writes OUT/bolted_junction.csv and OUT/junction_mu0.3_STEP.vtk,
# which bolted_junction.py draws. All else goes to target/.
set -eu

script=junction
# shellcheck source=c_examples/build.sh
. "$(dirname -- "$0")/build.sh"

[ $# -le 1 ] || die "usage: sh junction.sh [OUT]"
check_tools
if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

prepare
compile bolted_junction bolted_junction.c junction_mesh.c junction_element.c junction_output.c \
    junction_check.c checks.c watch.c

say "running it"
echo
"$build/bolted_junction" "$@"
