#!/bin/sh
# Replays Table 1 of the paper with the C host program of this directory.
#
#     sh c_examples/replay.sh [OUT]
#
# Builds the library, compiles the program against it (CC names the C compiler, default cc) and runs
# it. With OUT, a directory, it also writes OUT/bar_on_plane.csv. All else goes to target/.
set -eu

say() { printf 'replay: %s\n' "$*"; }
die() {
    say "$*" >&2
    exit 1
}

[ $# -le 1 ] || die "usage: sh replay.sh [OUT]"
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
examples=$root/c_examples
build=$root/target/c_examples
cc=${CC:-cc}

command -v cargo >/dev/null || die "cargo is missing: install Rust, https://rustup.rs"
# CC may hold options after the name of the compiler.
command -v "${cc%% *}" >/dev/null || die "the C compiler '$cc' is missing: install one, or set CC"

if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

say "building the library: cargo build --release --locked"
(cd "$root" && cargo build --release --locked --target-dir "$root/target")

# The program asks for the shared library by the name that the library has inside, next to itself.
case $(uname -s) in
Darwin)
    built=libsignorini.dylib
    name=$built
    here=@loader_path
    ;;
*)
    built=libsignorini.so
    name=$built.$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")
    here=\$ORIGIN
    ;;
esac
library=$root/target/release/$built
[ -f "$library" ] || die "no library at $library: is build.target set in a cargo configuration?"

# Under temporary names first: another replay may be running.
mkdir -p "$build/lib"
cp "$library" "$build/lib/$name.$$"
mv -f "$build/lib/$name.$$" "$build/lib/$name"

say "compiling the program: $cc"
# shellcheck disable=SC2086 # options in CC
$cc -std=c11 -O2 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I "$root/include" \
    -o "$build/bar_on_plane.$$" \
    "$examples/bar_on_plane.c" "$examples/bar_mesh.c" "$examples/bar_check.c" "$examples/checks.c" \
    "$build/lib/$name" -lm "-Wl,-rpath,$here/lib"
mv -f "$build/bar_on_plane.$$" "$build/bar_on_plane"

say "running it"
echo
"$build/bar_on_plane" "$@"
