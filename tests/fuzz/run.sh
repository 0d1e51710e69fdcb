#!/bin/sh
# Fuzzing of the C interface, of the entries of Fortran 77 and of problem files.
#
#     sh tests/fuzz/run.sh                      each entry, 10,000 inputs that are always the same, or 5 seconds
#     sh tests/fuzz/run.sh SECONDS [SEED]       each entry for a time
#     sh tests/fuzz/run.sh --libfuzzer SECONDS  with clang's libFuzzer, AddressSanitizer on both sides
#     sh tests/fuzz/run.sh --replay ENTRY FILE  one input
#
# Each entry replays its corpus, tests/fuzz/corpus/ENTRY, then tries new inputs. The last line counts. What stops
# an entry is left in target/fuzz/found.ENTRY, and the script fails at its end. A small corpus is kept: one input
# for each defect that was found.
#
# ENTRIES names entries, default all. CC names the C compiler, default cc; CLANG that of --libfuzzer, default
# clang. libFuzzer sees the branches of the library if it is built by a compiler of the LLVM of rustc or older;
# rustc takes RUSTC_BOOTSTRAP=1 for its sanitizers.
set -u
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
here=$root/tests/fuzz
work=$root/target/fuzz
all="solve certify flexibility lcp model sparse surface file fortran fortran_64 fortran_models fortran_models_64"
entries=${ENTRIES:-$all}
die() {
    echo "fuzz: $*" >&2
    exit 1
}

mode=driver
seconds=5
executions=10000
seed=1
case ${1-} in
--libfuzzer)
    mode=libfuzzer
    seconds=${2:?usage: sh tests/fuzz/run.sh --libfuzzer SECONDS}
    ;;
--replay)
    mode=replay
    entries=${2:?usage: sh tests/fuzz/run.sh --replay ENTRY FILE}
    file=${3:?usage: sh tests/fuzz/run.sh --replay ENTRY FILE}
    ;;
'') ;;
*)
    seconds=$1
    executions=1000000000
    seed=${2:-1}
    ;;
esac

if [ "$(uname -s)" != Linux ]; then
    echo "fuzz: SKIPPED: the harness is for Linux"
    exit 77
fi
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
mkdir -p "$work/lib"

if [ "$mode" = libfuzzer ]; then
    compiler=${CLANG:-clang}
    command -v "$compiler" >/dev/null || die "$compiler is missing: install clang and libclang-rt-dev, or set CLANG"
    triple=$(rustc -vV | sed -n 's/^host: //p')
    # Coverage of the library's branches as libFuzzer reads it, and AddressSanitizer.
    flags="-Zsanitizer=address -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=3"
    flags="$flags -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table"
    (cd "$root" && RUSTC_BOOTSTRAP=1 RUSTFLAGS="$flags" cargo rustc --release --locked --lib \
        --crate-type staticlib --target "$triple" --target-dir "$work/sanitized") || die "the build failed"
    library=$work/sanitized/$triple/release/libsignorini.a
    options="-fsanitize=fuzzer,address"
else
    compiler=${CC:-cc}
    (cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target") ||
        die "the build failed"
    soname=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")
    library=$work/lib/libsignorini.so.$soname
    cp "$root/target/release/libsignorini.so" "$library.$$" && mv -f "$library.$$" "$library" || exit 1
    options=$here/driver.c
fi

# compile ENTRY
compile() {
    source=${1%_64}
    wide=
    [ "$source" = "$1" ] || wide=-DWIDE
    # shellcheck disable=SC2086,SC2016 # options; the linker's own variable
    $compiler -std=c11 -D_GNU_SOURCE -g -O1 -Wall -Wextra $wide -I "$root/include" -o "$work/$1.$mode" \
        "$here/$source.c" "$here/fuzz.c" "$here/judge.c" $options "$library" \
        -lm -lpthread -ldl '-Wl,-rpath,$ORIGIN/lib' || die "$1 does not compile"
}

# Prints the corpus of an entry: nothing at first.
corpus() {
    find "$here/corpus/${1%_64}" -type f 2>/dev/null | sort
}

failed=
total=0
for entry in $entries; do
    compile "$entry"
    rm -f "$work/found.$entry"
    log=$work/$entry.log
    case $mode in
    replay)
        exec "$work/$entry.$mode" "$file"
        ;;
    driver)
        # shellcheck disable=SC2046 # names without spaces
        (cd "$work" && "./$entry.$mode" "-seconds=$seconds" "-executions=$executions" "-seed=$seed" "-found=$work/found.$entry" \
            $(corpus "$entry")) >"$log" 2>&1
        result=$?
        count=$(sed -n 's/.* \([0-9]*\) executions in .*/\1/p' "$log")
        ;;
    libfuzzer)
        mkdir -p "$work/grown.$entry"
        # shellcheck disable=SC2046
        (cd "$work" && "./$entry.$mode" "-max_total_time=$seconds" -max_len=1024 -timeout=60 -detect_leaks=1 \
            -print_final_stats=1 "-artifact_prefix=$work/found.$entry." "$work/grown.$entry" \
            $([ ! -d "$here/corpus/${entry%_64}" ] || echo "$here/corpus/${entry%_64}")) >"$log" 2>&1
        result=$?
        count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
        ;;
    esac
    if [ "$result" -ne 0 ]; then
        failed="$failed $entry"
        echo "fuzz: $entry FAILED, its input is in $work/found.$entry:"
        grep FOUND "$log" || tail -n 5 "$log"
    else
        echo "fuzz: $entry: $count executions"
    fi
    total=$((total + ${count:-0}))
done
[ -z "$failed" ] || die "$total executions; failed:$failed"
echo "fuzz: $total executions, nothing found"
