#!/bin/sh
# Every test of the project: sh tests/run.sh
#
# Formatting, lints, the Rust tests, the documentation, the C programs, and the replay of the
# examples. It ends at the first step that fails, with its name. What it needs and does not find it
# installs by apt-get if it may, and names it otherwise. It writes to target/ alone.

set -u
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
cd "$root" || exit 1
target=$root/target
began=$(date +%s)

# One place for everything that is built, whatever the caller has set.
CARGO_TARGET_DIR=$target
CARGO_TERM_COLOR=${CARGO_TERM_COLOR:-never}
export CARGO_TARGET_DIR CARGO_TERM_COLOR
unset CARGO_BUILD_TARGET RUSTFLAGS RUSTDOCFLAGS DESTDIR

# ---- tools ----

have() {
    command -v "$1" >/dev/null 2>&1
}

have cargo || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin

# Debian's names of the packages that are missing.
missing_packages() {
    have cc || echo gcc libc6-dev
    have make || echo make
    have cmake && have ctest || echo cmake
    have nm && have readelf || echo binutils
    have valgrind || echo valgrind
}

# macOS has another nm, no readelf and no valgrind.
if [ "$(uname -s)" = Darwin ]; then
    missing_packages() {
        have cc || echo xcode-select
        have cmake && have ctest || echo cmake
    }
fi

packages=$(missing_packages | tr '\n' ' ')
if [ -n "$packages" ] && have apt-get && [ "$(id -u)" = 0 ]; then
    echo "== installing: $packages"
    DEBIAN_FRONTEND=noninteractive
    export DEBIAN_FRONTEND
    log=$(apt-get update 2>&1 </dev/null) || echo "$log"
    # shellcheck disable=SC2086 # a list of words
    log=$(apt-get install -y --no-install-recommends $packages 2>&1 </dev/null) || echo "$log"
    packages=$(missing_packages | tr '\n' ' ')
fi
if ! have cargo; then
    echo "tests/run.sh: install Rust (https://rustup.rs) $packages" | sed 's/) \(.\)/) and: \1/'
    exit 1
fi
if [ -n "$packages" ]; then
    echo "tests/run.sh: install first (names of Debian and Ubuntu): $packages"
    exit 1
fi

# ---- steps ----

# Runs a step under its heading; ends everything if it fails.
step() {
    name=$1
    shift
    echo
    echo "== $name"
    "$@" </dev/null
    result=$?
    if [ "$result" -ne 0 ]; then
        echo
        echo "== FAILED: $name ($* ended with $result)"
        exit 1
    fi
}

skip() {
    echo
    echo "== $1: skipped, $2"
}

documentation() {
    RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --locked
}

c_configure() {
    cmake -S c_examples -B "$target/c"
}

c_build() {
    cmake --build "$target/c"
}

c_test() (
    cd "$target/c" && ctest --output-on-failure
)

if cargo fmt --version >/dev/null 2>&1; then
    step "format" cargo fmt --check
else
    skip "format" "rustfmt is not installed"
fi
if cargo clippy --version >/dev/null 2>&1; then
    step "lints" cargo clippy --release --all-targets --locked -- -D warnings
else
    skip "lints" "clippy is not installed"
fi
step "Rust tests" cargo test --release --locked
step "Rust documentation" documentation
step "C programs: configure" c_configure
step "C programs: build" c_build
step "C programs: test" c_test
step "replay of Table 1" sh c_examples/replay.sh
step "bolted junction" sh c_examples/junction.sh

echo
echo "== all tests passed in $(($(date +%s) - began)) s"
