#!/bin/sh
# Other machines: the library is built for them from Linux, and their programs run here, but for those of macOS.
#
#     sh tests/platforms.sh [--install] [PLATFORM...]
#
# PLATFORM   windows (x86_64, MinGW; run by wine), aarch64 (glibc; run by qemu), musl (x86_64, static programs; run as
#            they are) or macos (aarch64 and x86_64; linked and not run, for no emulator has the libraries of macOS).
#            Default: the first three.
# --install  has apt-get, rustup and pip fetch what is missing. Without it nothing is installed, a platform whose tools
#            are missing is named and skipped, and it ends with 77.
#
# The C programs are those of c_examples/CMakeLists.txt, those in Fortran those of tests/fortran.sh: nothing is listed
# here but what is compared. Bar, junction and blocks are solved on this machine too: all numbers agree to 1e-12 of the
# largest of their column, states and counts exactly, and the bar's printed table is the same to the last character.
#
# Not run elsewhere, and why: out_of_memory, processes and faults stand in for functions of glibc, fork or are
# cancelled, and run on Linux alone; valgrind watches this machine's programs. Within the others, limits of file size,
# signals of POSIX and malloc's own settings are left out where the system has none.
#
# The standard library of a target is brought by `rustup target add`. Without rustup, that of Windows and aarch64 is
# compiled from Debian's source of it, rust-web-src, by Debian's compiler, rustc-web; musl and macOS need rustup.
set -u
LC_ALL=C
export LC_ALL

script=platforms
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/platforms
here=$root/tests/platforms
# shellcheck source=tests/platforms/tools.sh
. "$here/tools.sh"
# shellcheck source=tests/platforms/run.sh
. "$here/run.sh"

install=
[ "${1-}" != --install ] || { install=yes; shift; }
[ $# -gt 0 ] || set -- windows aarch64 musl
for platform in "$@"; do
    case $platform in
    windows | aarch64 | musl | macos) ;;
    *) die "unknown: '$platform'; usage: sh tests/platforms.sh [--install] [windows|aarch64|musl|macos...]" ;;
    esac
done
unset CARGO_BUILD_TARGET RUSTFLAGS CARGO_TARGET_DIR CC AR FC SIGNORINI_LIBRARY
mkdir -p "$work"

native || die "this machine's own programs cannot be built"
failed=
skipped=
for platform in "$@"; do
    say "$platform"
    if ! tools_of "$platform"; then
        say "$platform: SKIPPED"
        skipped="$skipped $platform"
    elif ! "run_$platform"; then
        failed="$failed $platform"
    fi
done
echo
[ ! -s "$work/table" ] || cat "$work/table"
[ -z "$skipped" ] || say "skipped:$skipped"
[ -z "$failed" ] || die "failed:$failed"
[ -z "$skipped" ] || exit 77
