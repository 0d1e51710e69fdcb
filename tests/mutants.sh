#!/bin/sh
# Mutants: small changes of the source, each of which some test should notice. Which ones do not?
#
#     sh tests/mutants.sh [--again] [--planted] [FILE | FOLDER]...
#
# Without a word: the rooms that decide what is true, certificate and proof, law, reduce, existence, rigid motions, mortar
# and ffi/args.rs, some 3400 mutants. A word chooses those below a folder, or of a file (src/certificate/escape.rs).
# With --planted: those that once no test noticed, tests/mutants/planted.txt, each on the tests that it names; with --again
# what survived in the last run.
# MUTANTS_TESTS names the rooms of tests, default all that bear on these; MUTANTS_LONGEST the processor seconds of a test
# beyond which it is left out, MUTANTS_SECONDS those of a mutant after which it counts as survived.
#
# How it is done stands in tests/mutants/mutants.py. It needs cargo-mutants (cargo install --locked cargo-mutants) and
# python3, and writes to target/mutants; the source stays as it is. Survivors are judged by hand: a test that is not
# among these may notice them, they may change a bound, or the speed, or nothing at all. Ends with 1 if some survived,
# with 77 if cargo-mutants is missing.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
cd -- "$root"
cargo mutants --version >/dev/null 2>&1 || {
    echo "mutants: skipped: no cargo-mutants: cargo install --locked cargo-mutants"
    exit 77
}
mkdir -p -- "$root/target/mutants"
exec nice python3 tests/mutants/mutants.py "$@"
