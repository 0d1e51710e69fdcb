#!/bin/sh
# Races between threads, in the library and in Rust's standard library: ThreadSanitizer over calls from several threads
# and calls on several threads. A program with a race shows that it is on.
#
#     sh tests/thread_sanitizer.sh
#
# Needs Rust's nightly compiler with the sources of its standard library (rustup toolchain install nightly --component
# rust-src), a C compiler that knows -fsanitize=thread, and Linux on x86-64. It builds everything anew in
# target/thread_sanitizer, which takes some ten minutes. Ends with 77 where a tool is missing.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/thread_sanitizer
machine=x86_64-unknown-linux-gnu
cd -- "$root"
skip() {
    echo "thread_sanitizer: skipped: $*"
    exit 77
}
die() {
    echo "thread_sanitizer: $*" >&2
    exit 1
}
rust=$(rustc +nightly --print sysroot 2>/dev/null) || skip "there is no nightly compiler"
[ -d "$rust/lib/rustlib/src/rust/library" ] ||
    skip "no rust-src: rustup component add rust-src --toolchain nightly"
runtime=$rust/lib/rustlib/$machine/lib/librustc-nightly_rt.tsan.a
[ -f "$runtime" ] || skip "the nightly compiler has no ThreadSanitizer for $machine"
mkdir -p -- "$work"
echo 'int main(void) { return 0; }' >"$work/empty.c"
"${CC:-cc}" -fsanitize=thread -c "$work/empty.c" -o "$work/empty.o" 2>/dev/null ||
    skip "the C compiler does not know -fsanitize=thread"

RUSTFLAGS=-Zsanitizer=thread CARGO_TARGET_DIR="$work" \
    cargo +nightly build --release --lib --locked -Zbuild-std --target "$machine"
library=$work/$machine/release
soname=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' Cargo.toml)
ln -sf libsignorini.so "$library/libsignorini.so.$soname"
nm -D "$library/libsignorini.so" | grep -q __tsan_write8 || die "the library is not instrumented"

# The run-time library is that of the Rust compiler: that of a C compiler may lack what newer code calls. It does not
# know the address space of every kernel unless addresses are not drawn at random.
runs() {
    "${CC:-cc}" -fsanitize=thread -g -O1 -I"$root/include" -c "$root/tests/c/$1.c" -o "$work/$1.o"
    "${CC:-cc}" -rdynamic "$work/$1.o" -o "$work/$1" -Wl,--whole-archive "$runtime" -Wl,--no-whole-archive \
        -L"$library" -lsignorini -Wl,-rpath,"$library" -lm -lpthread -ldl -lrt
    setarch -R "$work/$1" >"$work/$1.out" 2>&1
}
if runs data_race || ! grep -q 'ThreadSanitizer: data race' "$work/data_race.out"; then
    cat "$work/data_race.out"
    die "the race of tests/c/data_race.c was not found"
fi
for name in threads case_threads reduction_threads; do
    runs "$name" || { cat "$work/$name.out"; die "$name failed"; }
    tail -n 1 "$work/$name.out"
done
