#!/bin/sh
# Computes the examples in three dimensions with the C host programs 3d/two_blocks.c, 3d/hertz.c and
# 3d/sliding.c.
#
#     sh c_examples/3d.sh [OUT]
#
# Builds the library, compiles the programs against it (CC names the C compiler, default cc) and
# runs them. With OUT, a directory, they also write OUT/two_blocks and OUT/hertz_CASE, .csv and
# .vtu, and OUT/sliding.vtu; 3d/hertz.py draws the second. All else goes to target/.
set -eu

script=3d
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh 3d.sh [OUT]"
check_tools
if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

prepare
bricks="3d/brick_element.c 3d/brick_mesh.c 3d/brick_contact.c 3d/brick_output.c common/checks.c"
# shellcheck disable=SC2086 # a list of words
compile two_blocks 3d/two_blocks.c 3d/two_blocks_check.c 3d/blocks.c $bricks
# shellcheck disable=SC2086
compile hertz 3d/hertz.c 3d/hertz_study.c 3d/hertz_mesh.c 3d/hertz_theory.c $bricks
# shellcheck disable=SC2086
compile sliding 3d/sliding.c 3d/slide.c $bricks

for program in two_blocks hertz sliding; do
    echo
    say "running $program"
    echo
    "$build/$program" "$@"
done
