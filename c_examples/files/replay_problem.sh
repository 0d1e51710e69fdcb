#!/bin/sh
# Solves a problem again that a host has written to a file by signorini_problem_write or the like.
#
#     sh c_examples/files/replay_problem.sh FILE [METHOD [TOLERANCE]]
#
# METHOD is auto (the default), nested, diagonal, lemke, pivot, newton or path. Builds the library,
# compiles the program against it (CC names the C compiler, default cc) and runs it. It ends with 0
# if the problem is solved, 1 if it is not, 2 if the file is wrong. All that is built goes to
# target/.
set -eu

script=replay_problem
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -ge 1 ] && [ $# -le 3 ] || die "usage: sh replay_problem.sh FILE [METHOD [TOLERANCE]]"
[ -r "$1" ] || die "cannot read the file $1"
check_tools

prepare
compile replay_problem files/replay_problem.c common/watch.c

say "running it"
echo
exec "$build/replay_problem" "$@"
