#!/bin/sh
# The cost of pairing two surfaces in space by the C interface, from 1600 faces a side to 250,000.
#
#     sh tests/bench/pairing.sh
#
# CPU seconds of one thread, memory beyond the host's, and the check for what has passed through. It writes to target/ alone.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
work=$root/target/bench
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
mkdir -p -- "$work"
"${CC:-cc}" -std=gnu11 -O2 -Wall -Wextra -Wpedantic -Werror -I"$root/include" \
    "$root/tests/bench/pairing.c" "$root/target/release/libsignorini.a" -lm -lpthread -ldl \
    -o "$work/pairing"

echo "| nodes of a face | faces a side | pairs | s | us a face | MB | kB a face | check, s | of pairing |"
echo "|---|---|---|---|---|---|---|---|---|"
for cells in 40 100 200 317 500; do
    "$work/pairing" "$cells" 4
done
for cells in 100 224 350; do
    "$work/pairing" "$cells" 3
done
for kind in 6 8 9; do
    for cells in 70 224; do
        "$work/pairing" "$cells" "$kind"
    done
done
