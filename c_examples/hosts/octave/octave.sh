#!/bin/sh
# GNU Octave as the host: builds the function signorini_solve and runs a small problem with it.
#
#     sh c_examples/hosts/octave/octave.sh [OUT]
#
# Needs mkoctfile and octave-cli (octave and octave-dev in Debian). signorini_solve.oct goes to OUT,
# default target/c_examples/octave; in Octave, addpath of that directory is all that it takes.
set -eu

script=octave
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh octave.sh [OUT]"
check_tools
for tool in mkoctfile octave-cli; do
    command -v "$tool" >/dev/null ||
        die "$tool is missing: install GNU Octave (octave and octave-dev in Debian)"
done
out=${1:-$build/octave}
mkdir -p -- "$out" || die "cannot create the directory $out"
out=$(CDPATH='' cd -- "$out" && pwd)

prepare
say "building signorini_solve.oct: mkoctfile"
cp -- "$build/lib/$name" "$examples/hosts/octave/signorini_solve.cc" "$root/include/signorini.h" \
    "$out"
# mkoctfile hands names with spaces to a shell: it works in OUT, on names without any. The function
# looks for the library next to itself, and the name of that place passes through that shell, too.
origin=$(printf '%s' "$here" | sed 's/\$/\\$/')
(cd "$out" && rm -f signorini_solve.oct &&
    { [ "$name" = "$built" ] || ln -sf "$name" "$built"; } &&
    mkoctfile -Wall -Wextra -I. signorini_solve.cc -L. -lsignorini "-Wl,-rpath,$origin")
[ -f "$out/signorini_solve.oct" ] || die "mkoctfile has built no signorini_solve.oct"

say "running it"
(cd "$out" && octave-cli --quiet --norc --no-history "$examples/hosts/octave/two_pairs.m")
