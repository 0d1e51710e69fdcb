# Sourced by tests/platforms.sh: messages, what each platform needs, and the build of the library for a target.
# shellcheck shell=sh disable=SC2154

say() { printf '%s: %s\n' "$script" "$*"; }
die() {
    say "$*" >&2
    exit 1
}
have() { command -v "$1" >/dev/null 2>&1; }

# A compiler that has this target, as the value of RUSTC: rustup's, or Debian's with the source of the standard
# library, for which `unstable` is set.
compiler_of() {
    unstable=
    RUSTC=$(command -v rustc || echo rustc)
    cargo=$(command -v cargo || echo cargo)
    [ ! -d "$("$RUSTC" --print target-libdir --target "$1" 2>/dev/null)" ] || return 0
    RUSTC=/usr/bin/rustc
    cargo=/usr/bin/cargo
    unstable="-Zbuild-std=std,panic_unwind"
    [ -x "$RUSTC" ] && [ -x "$cargo" ] && [ -d "$("$RUSTC" --print sysroot)/lib/rustlib/src/rust/library/std" ]
}

# Debian's names of packages that a platform lacks.
missing_of() {
    have cmake && have ctest || echo cmake
    case $1 in
    windows)
        compiler_of x86_64-pc-windows-gnu || have rustup || echo rustc-web cargo-web rust-web-src
        have x86_64-w64-mingw32-gcc || echo gcc-mingw-w64-x86-64
        have x86_64-w64-mingw32-g++ || echo g++-mingw-w64-x86-64
        have x86_64-w64-mingw32-gfortran || echo gfortran-mingw-w64-x86-64
        [ -x "$wine" ] || echo wine64
        ;;
    aarch64)
        compiler_of aarch64-unknown-linux-gnu || have rustup || echo rustc-web cargo-web rust-web-src
        have aarch64-linux-gnu-gcc || echo gcc-aarch64-linux-gnu
        have aarch64-linux-gnu-g++ || echo g++-aarch64-linux-gnu
        have aarch64-linux-gnu-gfortran || echo gfortran-aarch64-linux-gnu
        have qemu-aarch64-static || echo qemu-user-static
        ;;
    musl) have musl-gcc || echo musl-tools ;;
    macos)
        have llvm-nm && have llvm-objdump || echo llvm
        have python3 || echo python3-venv
        ;;
    esac
}
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)

# Targets of a platform that rustup is to bring.
missing_targets() {
    case $1 in
    windows) targets=x86_64-pc-windows-gnu ;;
    aarch64) targets=aarch64-unknown-linux-gnu ;;
    musl) targets=x86_64-unknown-linux-musl ;;
    macos) targets="aarch64-apple-darwin x86_64-apple-darwin" ;;
    esac
    case $1 in
    windows | aarch64) ! compiler_of "$targets" || return 0 ;;
    esac
    for target in $targets; do
        [ -d "$(rustc --print target-libdir --target "$target" 2>/dev/null)" ] || printf '%s ' "$target"
    done
}

# Zig, a C compiler for macOS: the PyPI package `ziglang`, in an environment of its own.
zig=$work/zig/bin/python

# True if the platform has all it needs, or has been given it.
tools_of() {
    packages=$(missing_of "$1" | sort -u | tr '\n' ' ')
    if [ -n "$packages" ] && [ -n "$install" ]; then
        say "installing: $packages"
        # shellcheck disable=SC2086 # a list of words
        { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $packages; } \
            >"$work/apt.log" 2>&1 </dev/null || { tail -n 5 "$work/apt.log"; return 1; }
        packages=$(missing_of "$1" | sort -u | tr '\n' ' ')
    fi
    [ -z "$packages" ] || { say "$1 lacks (Debian's names): $packages"; return 1; }
    targets=$(missing_targets "$1")
    if [ -n "$targets" ] && [ -n "$install" ] && have rustup; then
        # shellcheck disable=SC2086
        rustup --quiet target add $targets || return 1
        targets=
    fi
    [ -z "$targets" ] || { say "$1 lacks: rustup target add $targets"; return 1; }
    [ "$1" != macos ] || has_zig
}
has_zig() {
    "$zig" -m ziglang version >/dev/null 2>&1 && return
    [ -n "$install" ] ||
        { say "macos lacks: python3 -m venv $work/zig && $work/zig/bin/pip install ziglang"; return 1; }
    python3 -m venv "$work/zig" && "$work/zig/bin/pip" install --quiet ziglang
}

# library_for TARGET: the library as `built`.
library_for() {
    compiler_of "$1"
    built=$root/target/$1/release
    say "building the library for $1: $("$RUSTC" --version)${unstable:+, with its standard library}"
    # With rustup's compiler named, cargo would build again what it has built for this machine.
    # shellcheck disable=SC2086 # an option or none
    (cd "$root" && { [ -z "$unstable" ] || export RUSTC RUSTC_BOOTSTRAP=1; } &&
        "$cargo" build --quiet --release --locked --lib $unstable --target "$1" --target-dir "$root/target")
}
