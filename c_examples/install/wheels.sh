#!/bin/sh
# Makes Python wheels for other machines from libraries that have been built.
#
#     sh c_examples/install/wheels.sh BUILT PLATFORM OUT
#
# BUILT     the folder of cargo's release for the platform: target/TRIPLE/release
# PLATFORM  win_amd64, macosx_11_0_arm64, manylinux_2_17_x86_64 or manylinux_2_17_aarch64
#
# A library that cargo links here needs the C library of this machine. That of a manylinux wheel is linked anew from
# libsignorini.a for glibc 2.17, by zig: ZIG names it, by default `python3 -m ziglang` (the PyPI package ziglang).
# The unwinder stays that of the system, libgcc_s, which each wheel of this kind may count on.
set -eu

script=wheels
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -eq 3 ] || die "usage: sh wheels.sh BUILT PLATFORM OUT"
built=$(CDPATH='' cd -- "$1" && pwd)
platform=$2
mkdir -p -- "$3"
out=$(CDPATH='' cd -- "$3" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT
zig=${ZIG:-python3 -m ziglang}
interface=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")

# The functions of the shared library that cargo made, and no others.
linked_anew() {
    nm -DP --defined-only "$built/libsignorini.so" | sed 's/[ @].*//' | sort -u >"$work/names"
    {
        echo "{ global:"
        sed 's/$/;/' "$work/names"
        echo "local: *; };"
    } >"$work/exports"
    # shellcheck disable=SC2086,SC2046 # lists of words
    $zig cc -target "$1-linux-gnu.2.17" -shared -nostdlib++ -o "$work/libsignorini.so" \
        "-Wl,-soname,libsignorini.so.$interface" "-Wl,--version-script,$work/exports" -Wl,--gc-sections \
        $(sed 's/^/-Wl,-u,/' "$work/names") "$built/libsignorini.a" "$2" -lm -lpthread -ldl -lc -s
    library=$work/libsignorini.so
}
case $platform in
win_amd64) library=$built/signorini.dll ;;
macosx_11_0_arm64) library=$built/libsignorini.dylib ;;
manylinux_2_17_x86_64) linked_anew x86_64 "$(${CC:-cc} -print-file-name=libgcc_s.so.1)" ;;
manylinux_2_17_aarch64) linked_anew aarch64 "$(aarch64-linux-gnu-gcc -print-file-name=libgcc_s.so.1)" ;;
*) die "unknown platform: $platform" ;;
esac
cd "$examples/python"
SIGNORINI_WHEEL_LIBRARY=$library SIGNORINI_WHEEL_PLATFORM=$platform python3 -B -c '
import sys
import build_signorini
print(build_signorini.build_wheel(sys.argv[1]))' "$out"
