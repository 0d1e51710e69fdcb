#!/bin/sh
# The README's C example compiles as it stands, statically and shared, and prints what the README
# says; the functions of the guide for hosts compile and do what it says. The library has been built in
# target/release.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/readme
mkdir -p "$work"
cd "$root"

# The blocks of a kind: what stands between ```KIND and ```.
block() {
    awk -v kind="$1" '$0 == "```" kind { inside = 1; next } $0 == "```" { inside = 0 } inside' README.md
}

block c >"$work/first.c"
[ "$(grep -c . "$work/first.c")" -le 32 ] || { echo "the README's example is too long"; exit 1; }
grep '^pair ' README.md >"$work/expected"
[ -s "$work/expected" ]

ln -sf libsignorini.so target/release/libsignorini.so.0.1
flags="-std=c11 -Wall -Wextra -Wpedantic -Werror -Iinclude"
# The README's two lines, with warnings as errors.
# shellcheck disable=SC2086 # several flags
${CC:-cc} $flags "$work/first.c" target/release/libsignorini.a -lm -lpthread -ldl -o "$work/static"
# shellcheck disable=SC2086
${CC:-cc} $flags "$work/first.c" -Ltarget/release -lsignorini "-Wl,-rpath,$PWD/target/release" \
    -o "$work/shared"
for program in static shared; do
    "$work/$program" >"$work/printed"
    diff "$work/expected" "$work/printed"
    echo "README example, $program: prints what the README says"
done

# The guide's blocks, one file each, and the program that calls them.
for number in 1 2; do
    awk -v want="$number" '$0 == "```c" { inside = ++number == want; next } $0 == "```" { inside = 0 }
        inside' c_examples/GUIDE.md >"$work/guide_$number.h"
done
# shellcheck disable=SC2086 # several flags
${CC:-cc} $flags -Itests/c -I"$work" tests/c/guide.c target/release/libsignorini.a \
    -lm -lpthread -ldl -o "$work/guide"
"$work/guide"
