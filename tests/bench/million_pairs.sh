#!/bin/sh
# The library's own time on up to a million pairs in space, by an operator model whose products are quick.
#
#     sh tests/bench/million_pairs.sh
#
# CPU seconds of one thread without those of the products, and peak memory of the process. It writes to target/ alone.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
work=$root/target/bench
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
mkdir -p -- "$work"
"${CC:-cc}" -std=gnu11 -O2 -Wall -Wextra -Wpedantic -Werror -I"$root/include" \
    "$root/tests/bench/million_pairs.c" "$root/target/release/libsignorini.a" -lm -lpthread -ldl \
    -o "$work/million_pairs"

echo "| pairs | systems | products with K_rel + W | stick | library | peak | bound told |"
echo "|---|---|---|---|---|---|---|"
for side in 300 577 1000; do
    "$work/million_pairs" "$side"
done
