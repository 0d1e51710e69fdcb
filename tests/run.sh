#!/bin/sh
# Every test of the project: sh tests/run.sh [--install] [--hosts]
#
# Formatting, lints, the Rust tests, the documentation, the C and Fortran programs, the installation,
# the scripts, and the replay of the examples. It ends at the first step that fails, with its name.
# It writes to target/ alone. It says what it skips, and the last line says how many steps that were.
#
# --install  root's apt-get brings missing compilers, CMake, pkg-config and numpy. Without it a terminal is
#            asked; without a terminal nothing is installed.
# --hosts    nothing is skipped for want of a package: all are asked for, the finite-element codes of the
#            examples among them.

set -u
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
cd "$root" || exit 1
target=$root/target
began=$(date +%s)

hosts=
install=
for option; do
    case $option in
    --hosts) hosts=--require ;;
    --install) install=yes ;;
    *)
        echo "usage: sh tests/run.sh [--install] [--hosts]"
        exit 2
        ;;
    esac
done

# One place for everything that is built, whatever the caller has set.
CARGO_TARGET_DIR=$target
CARGO_TERM_COLOR=${CARGO_TERM_COLOR:-never}
export CARGO_TARGET_DIR CARGO_TERM_COLOR
unset CARGO_BUILD_TARGET RUSTFLAGS RUSTDOCFLAGS DESTDIR PREFIX LIBDIR

# ---- tools ----

have() {
    command -v "$1" >/dev/null 2>&1
}

have cargo || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin

# A Python that has the modules named; Debian's may not be the first in PATH.
python_with() {
    for candidate in "${PYTHON:-python3}" python3 /usr/bin/python3; do
        "$candidate" -c "import $1" >/dev/null 2>&1 && echo "$candidate" && return
    done
    return 1
}

# The parallel MUMPS: the header alone may be that of the sequential one.
have_parallel_mumps() {
    [ -f /usr/include/dmumps_c.h ] || return 1
    echo 'int main(void) { return 0; }' | mpicc -x c - -ldmumps -o /dev/null >/dev/null 2>&1
}

have_fclib() {
    pkg-config --exists fclib hdf5 2>/dev/null
}

# Debian's names of the packages that are missing: what every test needs, ...
needed_packages() {
    have cc || echo gcc libc6-dev
    have make || echo make
    have cmake && have ctest || echo cmake
    have nm && have readelf || echo binutils
    have pkg-config || echo pkgconf
}

# ... what some do, ...
wanted_packages() {
    have gfortran || echo gfortran
    python_with numpy >/dev/null || echo python3-numpy
}

# ... and what --hosts asks for.
host_packages() {
    have c++ || echo g++
    have valgrind || echo valgrind
    have abidiff || echo abigail-tools
    have dpkg-buildpackage && have dh && have dh_python3 || echo dpkg-dev debhelper dh-python
    have ccx || echo calculix-ccx
    /usr/bin/python3 -c 'import getfem' >/dev/null 2>&1 || echo python3-getfem
    python_with numpy,matplotlib,PIL >/dev/null || echo python3-numpy python3-matplotlib python3-pil
    /usr/bin/python3 -c 'import hypothesis' >/dev/null 2>&1 || echo python3-hypothesis
    /usr/bin/python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || echo python3-venv
    [ -f /usr/include/mumps_seq/mpif.h ] || echo libmumps-seq-dev
    have mpicc && have mpirun || echo libopenmpi-dev openmpi-bin
    have_parallel_mumps || echo libmumps-dev
    have octave-cli && have mkoctfile || echo octave octave-dev
    have_fclib || echo libfclib-dev
    pkg-config --exists petsc 2>/dev/null || echo libpetsc-real-dev
}

# macOS has another nm, no readelf, and its compilers come otherwise.
if [ "$(uname -s)" = Darwin ]; then
    needed_packages() {
        have cc || echo xcode-select
        have cmake && have ctest || echo cmake
    }
fi

missing() {
    needed_packages
    wanted_packages
    [ -z "$hosts" ] || host_packages
}

# True if apt-get may install the packages: by the option, or by an answer.
may_install() {
    have apt-get && [ "$(id -u)" = 0 ] || return 1
    [ -z "$install" ] || return 0
    [ -t 0 ] || return 1
    printf 'tests/run.sh: install %sby apt-get? [y/N] ' "$packages"
    read -r answer && [ "$answer" = y ]
}

packages=$(missing | tr '\n' ' ')
if [ -n "$packages" ] && may_install; then
    echo "== installing: $packages"
    DEBIAN_FRONTEND=noninteractive
    export DEBIAN_FRONTEND
    log=$(apt-get update 2>&1 </dev/null) || echo "$log"
    # shellcheck disable=SC2086 # a list of words
    log=$(apt-get install -y --no-install-recommends $packages 2>&1 </dev/null) || echo "$log"
fi
if [ -n "$hosts" ]; then
    packages=$(missing | tr '\n' ' ')
else
    packages=$(needed_packages | tr '\n' ' ')
fi
if ! have cargo; then
    echo "tests/run.sh: install Rust (https://rustup.rs) $packages" | sed 's/) \(.\)/) and: \1/'
    exit 1
fi
if [ -n "$packages" ]; then
    echo "tests/run.sh: install first (names of Debian and Ubuntu), or be root and say --install: $packages"
    exit 1
fi
# shellcheck source=c_examples/common/build.sh
(script=tests/run.sh && . c_examples/common/build.sh && find_cargo) || exit 1
packages=$(missing | tr '\n' ' ')
[ -z "$packages" ] || echo "tests/run.sh: goes on without: $packages"
PYTHON=$(python_with numpy,matplotlib,PIL || python_with numpy || echo python3)
export PYTHON

# ---- steps ----

# The steps of which all or a part was skipped.
skipped=
skipped_steps=0

note_skip() {
    skipped="$skipped${skipped:+, }$1"
    skipped_steps=$((skipped_steps + 1))
}

# Runs a step under its heading; ends everything if it fails. A step that ends with 77 has passed,
# but for what it skipped.
step() {
    name=$1
    shift
    echo
    echo "== $name"
    step_began=$(date +%s)
    "$@" </dev/null
    result=$?
    echo "== $name: $(($(date +%s) - step_began)) s"
    if [ "$result" -eq 77 ]; then
        note_skip "$name"
    elif [ "$result" -ne 0 ]; then
        echo
        echo "== FAILED: $name ($* ended with $result)"
        exit 1
    fi
}

skip() {
    echo
    echo "== $1: skipped, $2"
    note_skip "$1"
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

# The table that the test of this name prints.
faults() (
    cd "$target/c" && ./faults
)

# Every release of clippy has new lints: those of this one count, those of others are shown.
lints() {
    case $(cargo clippy --version) in
    *' 0.1.95 '*) cargo clippy --release --all-targets --locked -- -D warnings ;;
    *) cargo clippy --release --all-targets --locked ;;
    esac
}

if cargo fmt --version >/dev/null 2>&1; then
    step "format" cargo fmt --check
else
    skip "format" "rustfmt is not installed"
fi
if cargo clippy --version >/dev/null 2>&1; then
    step "lints" lints
else
    skip "lints" "clippy is not installed"
fi
if cargo deny --version >/dev/null 2>&1; then
    step "crates and licences" cargo deny --config .cargo-deny.toml check licenses bans sources
else
    skip "crates and licences" "cargo-deny is not installed (cargo install cargo-deny)"
fi
step "Rust tests" cargo test --release --locked
step "Rust documentation" documentation
step "C programs: configure" c_configure
step "C programs: build" c_build
step "C programs: test" c_test
[ ! -x "$target/c/faults" ] || step "faults and outcomes" faults
have valgrind || skip "C programs under valgrind" "valgrind is not installed"
have_fclib || skip "FCLIB files" "libfclib is not installed"
have c++ || skip "the header in C++" "there is no C++ compiler"
step "installation" sh tests/install.sh
step "replay of Table 1" sh c_examples/replay.sh
step "bolted junction" sh c_examples/junction.sh
step "three dimensions" sh c_examples/3d.sh
step "Ctrl-C and progress" sh tests/interrupt.sh
step "fuzzing" sh tests/fuzz/run.sh
if [ -n "${SIGNORINI_THREAD_SANITIZER:-}" ]; then
    step "ThreadSanitizer" sh tests/thread_sanitizer.sh
else
    skip "ThreadSanitizer" "it builds all anew with Rust's nightly compiler: set SIGNORINI_THREAD_SANITIZER=1"
fi
for name in abi readme guide fortran two_blocks scripts python_package host_calculix calculix_contact host_getfem \
    host_mumps host_mpi host_petsc host_octave release; do
    # shellcheck disable=SC2086 # --require or nothing
    step "$name" sh "tests/$name.sh" $hosts
done

echo
seconds=$(($(date +%s) - began))
if [ "$skipped_steps" -eq 0 ]; then
    echo "== all tests passed in $seconds s"
else
    echo "== passed in $seconds s; skipped, wholly or in part, $skipped_steps steps: $skipped"
fi
