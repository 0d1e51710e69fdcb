#!/bin/sh
# Installs the library as users do and uses what was installed, all in target/install-test.
#
#     sh tests/install.sh
#
# By CMake and by c_examples/install/install.sh; in a prefix with a space in its name, and
# staged by DESTDIR; programs by pkg-config and by CMake, shared, static and with -static, by CMake in
# Fortran too; beside other Rust archives; the header in every dialect; `cargo package`; a Rust program that
# depends on the crate. It ends at the first thing that is wrong, and with 77 if it skipped anything.
set -eu
LC_ALL=C
export LC_ALL
unset DESTDIR PREFIX LIBDIR CMAKE_INSTALL_PREFIX PKG_CONFIG_PATH PKG_CONFIG_LIBDIR LD_LIBRARY_PATH

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
sources=$root/tests/install
work=$root/target/install-test
cc=${CC:-cc}
CARGO_TARGET_DIR=$root/target
export CARGO_TARGET_DIR

say() { printf 'install: %s\n' "$*"; }
die() {
    say "$*" >&2
    exit 1
}
# Runs a command and shows what it printed if it fails.
quietly() {
    "$@" >"$work/log" 2>&1 || {
        cat "$work/log"
        die "failed: $*"
    }
}
[ "$(uname -s)" = Linux ] || {
    say "SKIPPED: this test knows Linux only"
    exit 77
}
for tool in cargo rustc cmake pkg-config nm readelf "${cc%% *}"; do
    command -v "$tool" >/dev/null || die "$tool is missing (Debian: rustc cargo cmake pkg-config gcc)"
done
rm -rf "$work"
mkdir -p "$work"
interface=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")

# ---- install ----

by_cmake="$work/by cmake"
by_script="$work/by script"
quietly cmake -S "$root/c_examples" -B "$work/build" -DBUILD_TESTING=OFF \
    -DCMAKE_INSTALL_PREFIX=/nowhere -DCMAKE_INSTALL_LIBDIR=lib
quietly cmake --build "$work/build"
quietly cmake --install "$work/build" --prefix "$by_cmake"
quietly env PREFIX="$by_script" sh "$root/c_examples/install/install.sh"

# Staged: written below DESTDIR, for a prefix that need not exist yet. It is then moved there.
final=$work/final
quietly env DESTDIR="$work/stage" cmake --install "$work/build" --prefix "$final"
quietly env DESTDIR="$work/stage2" PREFIX="$final" LIBDIR=lib/deep \
    sh "$root/c_examples/install/install.sh"
[ ! -e "$final" ] || die "something was installed past DESTDIR"
for stage in stage stage2; do
    if grep -rIl "$work/$stage" "$work/$stage"; then die "these files name the stage"; fi
done

listing() { (cd "$1" && find . ! -type d | sort); }
[ "$(listing "$by_cmake")" = "$(listing "$by_script")" ] || {
    listing "$by_cmake"
    listing "$by_script"
    die "CMake and the script do not install the same files"
}
cmp "$by_cmake/lib/libsignorini.a" "$by_script/lib/libsignorini.a" ||
    die "CMake and the script do not make the same static library"
for name in signorini.f90 signorini.inc; do
    [ -f "$by_script/include/$name" ] || die "$name was not installed"
done
say "the same $(listing "$by_script" | wc -l) files by CMake and by the script, staged and not"

# ---- libraries ----

check_libraries() {
    library=$1/libsignorini.so.$interface
    sh "$root/tests/symbols.sh" "$library" "$1/libsignorini.a"
    newest=$(readelf -VW "$library" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
    [ "$(printf 'GLIBC_2.36\n%s\n' "$newest" | sort -V | tail -n 1)" = GLIBC_2.36 ] ||
        die "the library needs $newest, and Debian 12 has 2.36"
    say "the library needs glibc ${newest#GLIBC_}, Debian 12 has 2.36"
}
check_libraries "$by_script/lib"

# Names that the standard library may do without must stay weak: older C libraries do not have them.
for name in pidfd_spawnp pidfd_getpid posix_spawn_file_actions_addchdir; do
    if nm -P --undefined-only "$by_script/lib/libsignorini.a" | grep -q "^$name U"; then
        die "the static library cannot do without $name"
    fi
done

# ---- programs ----

# Programs can be static if a libc.a is there.
static_works=no
printf 'int main(void) { return 0; }\n' >"$work/empty.c"
if $cc -static "$work/empty.c" -o "$work/empty" 2>/dev/null && "$work/empty"; then
    static_works=yes
else
    say "programs with -static: skipped, the C library has no static form here"
fi

# The program links what it should: the shared library, or not.
links_shared() {
    readelf -d "$1" 2>/dev/null | grep -q "NEEDED.*libsignorini.so.$interface]"
}

# by_pkg_config PREFIX LIBDIR OPTION...: OPTIONs are those of pkg-config that find the prefix.
by_pkg_config() {
    prefix=$1
    directory=$2
    shift 2
    PKG_CONFIG_PATH=$directory/pkgconfig
    export PKG_CONFIG_PATH
    flags=$(pkg-config "$@" --cflags --libs signorini)
    eval "$cc -std=c11 \"\$sources/host.c\" $flags \"-Wl,-rpath,\$directory\" -o \"\$work/shared\""
    "$work/shared" >/dev/null
    links_shared "$work/shared" || die "$work/shared does not use the shared library"

    # Without the shared library at hand -lsignorini is the static one.
    rm -rf "$work/archive"
    mkdir "$work/archive"
    ln -s "$directory/libsignorini.a" "$work/archive"
    flags=$(pkg-config "$@" --static --cflags --libs signorini)
    eval "$cc -std=c11 \"\$sources/host.c\" -L\"\$work/archive\" $flags -o \"\$work/static\""
    if links_shared "$work/static"; then die "$work/static uses the shared library"; fi
    "$work/static" >/dev/null
    if [ $static_works = yes ]; then
        # The C library warns that its name service would not be static.
        eval "quietly $cc -std=c11 -static \"\$sources/host.c\" $flags -o \"\$work/all_static\""
        "$work/all_static" >/dev/null
    fi
    unset PKG_CONFIG_PATH
    say "programs by pkg-config from $prefix"
}

# The programs of tests/install/CMakeLists.txt in Fortran, where there is a compiler.
fortran_by_cmake() {
    if [ ! -e "$work/consumer/fortran" ]; then
        command -v gfortran >/dev/null && die "CMake has made no program in Fortran"
        say "Fortran by CMake: SKIPPED, there is no compiler"
        skipped=yes
        return
    fi
    grep '^pair ' "$root/README.md" >"$work/expected"
    for name in fortran fortran_static fortran_77; do
        "$work/consumer/$name" | diff "$work/expected" - || die "the program $name prints something else"
    done
    links_shared "$work/consumer/fortran" || die "the target signorini::fortran is not shared"
    if links_shared "$work/consumer/fortran_static"; then die "signorini::fortran_static is shared"; fi
}

# by_cmake_package PREFIX LIBDIR: where CMake does not look, it is told the place of the package.
by_cmake_package() {
    case $2 in
    lib) where=-DCMAKE_PREFIX_PATH=$1 ;;
    *) where=-Dsignorini_DIR=$1/$2/cmake/signorini ;;
    esac
    rm -rf "$work/consumer"
    quietly cmake -S "$sources" -B "$work/consumer" "$where" -DWANTED="$interface" \
        -DEXAMPLES="$root/c_examples"
    quietly cmake --build "$work/consumer"
    "$work/consumer/shared" >/dev/null
    "$work/consumer/static" >/dev/null
    links_shared "$work/consumer/shared" || die "the target signorini::signorini is not shared"
    if links_shared "$work/consumer/static"; then die "the target signorini::static is shared"; fi
    fortran_by_cmake
    if [ $static_works = yes ]; then
        quietly cmake -S "$sources" -B "$work/consumer" -DCMAKE_EXE_LINKER_FLAGS=-static
        quietly cmake --build "$work/consumer" --target static
        "$work/consumer/static" >/dev/null
    fi
    for wanted in "${interface%.*}.$((${interface#*.} + 1))" "$interface.1000" 99; do
        if cmake -S "$sources" -B "$work/refused" "$where" -DWANTED="$wanted" >"$work/log" 2>&1
        then
            die "CMake takes version $wanted"
        fi
        grep -q 'requested version' "$work/log" || die "CMake fails, but not for the version"
        rm -rf "$work/refused"
    done
    say "programs by CMake from $1; versions that are too high are refused"
}

for prefix in "$by_cmake" "$by_script"; do
    by_pkg_config "$prefix" "$prefix/lib"
    by_cmake_package "$prefix" lib
done
for stage in stage/lib stage2/lib/deep; do
    libdir=${stage#*/}
    rm -rf "$final"
    cp -R "$work/${stage%%/*}$final" "$final"
    by_pkg_config "$final" "$final/$libdir"
    by_cmake_package "$final" "$libdir"
    # Another place than was said, for those who unpack a staged tree anywhere.
    rm -rf "$work/moved"
    mv "$final" "$work/moved"
    [ "$libdir" != lib ] || by_pkg_config "$work/moved" "$work/moved/lib" --define-prefix
    by_cmake_package "$work/moved" "$libdir"
done

# ---- beside other Rust archives ----

installed=$by_script/lib/libsignorini.a
other() {
    name=$1
    shift
    quietly rustc --edition 2024 -O --crate-name "$name" --out-dir "$work" "$@" "$sources/other.rs"
}
with_other() {
    # shellcheck disable=SC2086 # options in CC
    quietly $cc -DOTHER -I "$by_script/include" "$sources/host.c" "$1" "$2" \
        -lutil -lrt -lpthread -lm -ldl -o "$work/with_other"
    "$work/with_other" >/dev/null
}
# Its own standard library; that and all of Rust in one piece, which cargo's archive does not link
# with; the same build of a dependency a second time; and with its own names hidden as ours are,
# where panics must still be caught.
other plain --crate-type staticlib --crate-type cdylib
other whole --crate-type staticlib -C lto=fat
# shellcheck disable=SC2012 # names by cargo
faer=$(ls -t "$root"/target/release/deps/libfaer-*.rlib | head -n 1)
other copy --crate-type staticlib --cfg faer --extern "faer=$faer" \
    -L "dependency=$root/target/release/deps"
sh "$root/c_examples/install/hide_symbols.sh" "$work/libplain.a" "$work/libplain.so" \
    "$work/libhidden.a"
for name in plain whole copy hidden; do
    with_other "$installed" "$work/lib$name.a"
    with_other "$work/lib$name.a" "$installed"
done
say "programs with a second Rust archive: four kinds, in both orders"

# ---- the header ----

header() {
    compiler=$1
    language=$2
    shift 2
    printf '#include <signorini.h>\n#include <signorini.h>\nint main(void) { return 0; }\n' \
        >"$work/header.$language"
    for dialect in "$@"; do
        # shellcheck disable=SC2086 # options in CC
        quietly $compiler "-std=$dialect" -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
            -I "$by_script/include" "$work/header.$language"
    done
    say "the header: $*"
}
header "$cc" c c99 c11 c17
if command -v "${CXX:-c++}" >/dev/null; then
    header "${CXX:-c++}" cc c++11 c++20
else
    say "the header in C++: SKIPPED, there is no C++ compiler"
    skipped=yes
fi

# ---- the package ----

# It builds from nothing but what is in it.
quietly env CARGO_PROFILE_DEV_DEBUG=0 cargo package --allow-dirty --offline
if grep '^warning' "$work/log"; then die "cargo package warns"; fi
say "cargo package"

# ---- a Rust program ----

# dependent NAME FEATURES: a program that depends on the crate, with its own allocator and panic hook.
dependent() {
    mkdir -p "$work/$1/src"
    cp "$sources/dependent.rs" "$work/$1/src/main.rs"
    cp "$root/Cargo.lock" "$work/$1"
    printf '[package]\nname = "%s"\nversion = "1.0.0"\nedition = "2024"\n\n[workspace]\n
[dependencies]\nsignorini = { path = "%s", %s }\n' "$1" "$root" "$2" >"$work/$1/Cargo.toml"
    CARGO_PROFILE_DEV_DEBUG=0 cargo run --offline --manifest-path "$work/$1/Cargo.toml" \
        >"$work/log" 2>&1
}
dependent plain_dependent 'features = []' || {
    cat "$work/log"
    die "a Rust program with its own allocator and panic hook does not keep them"
}
if dependent asking_dependent 'features = ["c-allocator"]'; then
    die "a Rust program that asks for the allocator does not get it"
fi
grep -q 'global_allocator.*conflicts' "$work/log" || {
    cat "$work/log"
    die "a program with two allocators fails, but not for that"
}
say "a Rust program keeps its allocator and its panic hook unless it asks"
[ "${skipped:-}" != yes ] || exit 77
