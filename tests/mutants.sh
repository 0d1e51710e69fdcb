#!/bin/sh
# Mutants: small changes of the source, each of which some test should notice. Which ones do not?
#
#     sh tests/mutants.sh [FILE | PATTERN]...
#
# Without a word: certificate, law, reduce and ffi/args.rs, some 2800 mutants and a day or two on one core. A file
# (src/law/gauge.rs) takes half an hour. Of a room a random part may do: MUTANTS_SHARD=3/10 takes the
# fourth tenth. MUTANTS_TESTS names the tests, default those that bear on all rooms and are quick.
#
# Needs cargo-mutants (cargo install --locked cargo-mutants). It writes to target/mutants, where
# mutants.out/missed.txt lists what survived; the source stays as it is. Survivors are judged by hand: a test that
# is not among these may notice them, they may change a bound, or the speed, or nothing at all. Ends with 2 if some
# survived, with 77 if cargo-mutants is missing.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/mutants
cd -- "$root"
cargo mutants --version >/dev/null 2>&1 || {
    echo "mutants: skipped: no cargo-mutants: cargo install --locked cargo-mutants"
    exit 77
}
tests=${MUTANTS_TESTS:-certificate certificate_bounds thresholds escape law law_values law_uses law_pieces \
    law_boundaries law_rounding relation friction_laws properties far_gaps proof model_cases dependent_rows \
    flexibility flexibility_sparse two_body general_rows reductions condensed_rounding motion_words sparse_messages \
    sparse_supports sparse_condensation full_space_bodies operator free_bodies counting bad_input}

[ $# -gt 0 ] || set -- 'src/certificate/**' 'src/law/**' 'src/reduce/**' src/ffi/args.rs
for file in "$@"; do
    shift
    set -- "$@" --file "$file"
done
# The library is built again for each mutant, and these tests are linked, with those inside the library.
set -- "$@" --cargo-arg=--lib
for test in $tests; do
    set -- "$@" --cargo-arg="--test=$test"
done
[ -z "${MUTANTS_SHARD-}" ] || set -- "$@" --shard "$MUTANTS_SHARD" --sharding round-robin

mkdir -p -- "$work"
# An earlier run leaves the library of its last mutant.
rm -rf -- "$work"/target/mutants/.fingerprint/signorini-*
export CARGO_TARGET_DIR="$work/target" SIGNORINI_PROPERTY_CASES=600 SIGNORINI_FAR_GAPS=1000
exec cargo mutants --profile daily --cargo-arg=--locked --jobs 1 --output "$work" --no-shuffle \
    --minimum-test-timeout 60 "$@"
