#!/bin/sh
# GNU Octave as the host: the README's first program through an .oct function.
#
#     sh tests/host_octave.sh [--require]
#
# Without Octave and its compiler script it is skipped and ends with 77; with
# --require it fails.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

if ! command -v octave-cli >/dev/null || ! command -v mkoctfile >/dev/null; then
    echo "host_octave: octave-cli or mkoctfile is not installed (octave and octave-dev in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "host_octave: SKIPPED"
    exit 77
fi

work=$root/target/tests/host\ octave
rm -rf -- "$work"
mkdir -p -- "$work"
sh "$root/c_examples/hosts/octave/octave.sh" "$work" | tee "$work/printed"
# The Octave program prints what the C program of the README prints.
grep '^pair ' "$root/README.md" >"$work/expected"
grep '^pair ' "$work/printed" | diff "$work/expected" -
grep -q 'PASS.*K is not a real matrix' "$work/printed" # the last check: none was left out
echo "host_octave: passed"
