#!/bin/sh
# Replays Table 1 of the paper with the C host program bar/bar_on_plane.c.
#
#     sh c_examples/replay.sh [OUT]
#
# Builds the library, compiles the program against it (CC names the C compiler, default cc) and runs
# it. With OUT, a directory, it also writes OUT/bar_on_plane.csv,
# which bar/bar_on_plane.py draws. All else goes to target/.
set -eu

script=replay
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh replay.sh [OUT]"
check_tools
if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

prepare
compile bar_on_plane bar/bar_on_plane.c bar/bar_mesh.c bar/bar_check.c common/checks.c \
    common/watch.c

say "running it"
echo
"$build/bar_on_plane" "$@"
