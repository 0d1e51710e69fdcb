#!/bin/sh
# Mutants: small changes of the source, each of which some test should notice. Which ones do not?
#
#     sh tests/mutants.sh [FILE | PATTERN]...
#     sh tests/mutants.sh --planted [WORD]...
#
# Without a word: the rooms that decide what is true, certificate and proof, law, reduce, existence, rigid motions, mortar
# and ffi/args.rs, some 3000 mutants and a day or two on one core. A file (src/certificate/escape.rs) takes a
# quarter of an hour. Of a room a random part may do: MUTANTS_SHARD=3/10 takes the fourth tenth. MUTANTS_TESTS names the
# rooms of tests, default all that bear on these.
#
# With --planted: those that once no test noticed, tests/mutants/planted.txt, or of them those that hold a word.
#
# Needs cargo-mutants (cargo install --locked cargo-mutants), or python3 for --planted. It writes to target/mutants, where
# mutants.out/missed.txt lists what survived; the source stays as it is. Survivors are judged by hand: a test that
# is not among these may notice them, they may change a bound, or the speed, or nothing at all. Ends with 2, or 1 of
# planted ones, if some survived, with 77 if cargo-mutants is missing.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/mutants
cd -- "$root"
if [ "${1-}" = --planted ]; then
    shift
    exec python3 tests/mutants/planted.py "$@"
fi
cargo mutants --version >/dev/null 2>&1 || {
    echo "mutants: skipped: no cargo-mutants: cargo install --locked cargo-mutants"
    exit 77
}
tests=${MUTANTS_TESTS:-certificate law problem proof reduce model flexibility operator surface solve}

[ $# -gt 0 ] || set -- 'src/certificate/**' 'src/law/**' 'src/reduce/**' src/ffi/args.rs \
    src/solve/uniqueness/existence.rs 'src/solve/rigid/**' src/surface/mortar.rs
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
