#!/bin/sh
# Ours beside Siconos on contact problems of growing size: one program, one run, the same matrices.
#
#     sh tests/bench/peers.sh [OUT]
#
# Builds the library, compiles tests/bench/peers*.c against it and Siconos (CC names the C compiler,
# default cc) and runs it. A Markdown document goes to standard output, and with OUT, a directory,
# to OUT/peers.md; OUT/peers.csv has every row. All else goes to target/bench. It takes more than an
# hour, most of it for peers that do not end. These variables choose less of it:
#
#     SIGNORINI_PEERS_LEAST, _MOST   smallest and largest number of pairs (both 25: half a minute)
#     SIGNORINI_PEERS_SECONDS        CPU time that a call may take, default 30
#     SIGNORINI_PEERS_FAMILY         frictionless, friction2d, friction3d or held; default all
set -eu
LC_ALL=C
export LC_ALL

say() { printf 'peers: %s\n' "$*" >&2; }
die() {
    say "$*"
    exit 1
}

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/target/bench
cc=${CC:-cc}

[ $# -le 1 ] || die "usage: sh tests/bench/peers.sh [OUT]"
if [ $# -eq 1 ]; then
    mkdir -p -- "$1" || die "cannot create the directory $1"
    set -- "$(CDPATH='' cd -- "$1" && pwd)"
fi

# ---- tools ----

# Siconos of Debian is linked with OpenBLAS and the LAPACK of the system, which must be OpenBLAS'
# too: a slow reference LAPACK would not be fair.
package=libsiconos-numerics-dev
headers=/usr/include/siconos
if [ ! -f "$headers/numerics/fc3d_Solvers.h" ]; then
    if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
        say "installing $package libopenblas0"
        DEBIAN_FRONTEND=noninteractive
        export DEBIAN_FRONTEND
        { apt-get update && apt-get install -y --no-install-recommends $package libopenblas0; } \
            >/dev/null 2>&1 </dev/null || true
    fi
    [ -f "$headers/numerics/fc3d_Solvers.h" ] ||
        die "install first (names of Debian and Ubuntu): $package libopenblas0"
fi
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
command -v cargo >/dev/null || die "cargo is missing: install Rust, https://rustup.rs"
command -v "${cc%% *}" >/dev/null || die "the C compiler '$cc' is missing: install one, or set CC"
version=$(dpkg-query -W -f '${Version}' $package 2>/dev/null) || version=unknown

# ---- the program ----

say "building the library: cargo build --release --locked"
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target") >&2
mkdir -p "$build"
say "compiling the program: $cc"
# shellcheck disable=SC2086 # options in CC
(cd "$root/tests/bench" &&
    $cc -std=c11 -O3 -march=native -Wall -Wextra -Wpedantic -Wshadow -Werror \
        -D_POSIX_C_SOURCE=200809L "-DSICONOS=\"$version\"" \
        -I "$root/include" -isystem "$headers" -isystem "$headers/numerics" \
        -o "$build/peers.$$" peers.c peers_mesh.c peers_block.c peers_forms.c peers_siconos.c \
        peers_held.c peers_ours.c peers_child.c peers_judge.c peers_table.c \
        "$root/target/release/libsignorini.a" \
        -lsiconos_numerics -l:libopenblas.so.0 -lm -lpthread -ldl)
mv -f "$build/peers.$$" "$build/peers"

OPENBLAS_NUM_THREADS=1
OMP_NUM_THREADS=1
export OPENBLAS_NUM_THREADS OMP_NUM_THREADS
lapack=$(ldd "$build/peers" | sed -n 's/.*liblapack\.so\.3 => \([^ ]*\).*/\1/p')
say "LAPACK of the peers: $(readlink -f "$lapack")"
# OpenBLAS takes kernels of 2004 on a processor that is newer than it.
if [ -z "${OPENBLAS_CORETYPE:-}" ] && OPENBLAS_VERBOSE=2 "$build/peers" 2>&1 | grep -q '^Core: Prescott'; then
    case " $(sed -n 's/^flags.*: //p' /proc/cpuinfo | head -n 1) " in
    *" avx512f "*) OPENBLAS_CORETYPE=SkylakeX ;;
    *" avx2 "*) OPENBLAS_CORETYPE=Haswell ;;
    esac
    [ -z "${OPENBLAS_CORETYPE:-}" ] || export OPENBLAS_CORETYPE
fi
say "kernels of OpenBLAS: $(OPENBLAS_VERBOSE=2 "$build/peers" 2>&1 | sed -n 's/^Core: //p')"

exec "$build/peers" "${SIGNORINI_PEERS_LEAST:-0}" "${SIGNORINI_PEERS_MOST:-2049}" \
    "${SIGNORINI_PEERS_SECONDS:-30}" "${SIGNORINI_PEERS_FAMILY:-all}" "$@"
