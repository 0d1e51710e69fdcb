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
        compiler_of x86_64-pc-windows-gnu || echo rustc-web cargo-web rust-web-src
        have x86_64-w64-mingw32-gcc || echo gcc-mingw-w64-x86-64
        have x86_64-w64-mingw32-g++ || echo g++-mingw-w64-x86-64
        have x86_64-w64-mingw32-gfortran || echo gfortran-mingw-w64-x86-64
        [ -x "$wine" ] || echo wine64
        ;;
    aarch64)
        compiler_of aarch64-unknown-linux-gnu || echo rustc-web cargo-web rust-web-src
        have aarch64-linux-gnu-gcc || echo gcc-aarch64-linux-gnu
        have aarch64-linux-gnu-g++ || echo g++-aarch64-linux-gnu
        have aarch64-linux-gnu-gfortran || echo gfortran-aarch64-linux-gnu
        have qemu-aarch64-static || echo qemu-user-static
        ;;
    musl)
        compiler_of x86_64-unknown-linux-musl || echo rustc-web cargo-web rust-web-src
        have musl-gcc || echo musl-tools
        ;;
    macos)
        compiler_of aarch64-apple-darwin && compiler_of x86_64-apple-darwin || echo rustc-web cargo-web rust-web-src
        ;;
    esac
}
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)

# Zig has a linker for macOS, and what stands for the system's libraries. It is the PyPI package `ziglang`, here in an
# environment of its own.
find_zig() {
    zig=$work/zig/bin/python
    "$zig" -m ziglang version >/dev/null 2>&1 && return
    [ -n "$install" ] || { say "zig is missing (the PyPI package ziglang in $work/zig)"; return 1; }
    python3 -m venv "$work/zig" && "$work/zig/bin/pip" install --quiet ziglang
}

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
    [ "$1" != macos ] || find_zig
}

# library_for TARGET [OPTION...]: the library as `built`; options are those of rustc.
library_for() {
    target=$1
    shift
    compiler_of "$target"
    built=$root/target/$target/release
    say "building the library for $target: $("$RUSTC" --version)${unstable:+, with its standard library}"
    kinds=
    [ "$target" != x86_64-unknown-linux-musl ] || kinds="--crate-type staticlib"
    # shellcheck disable=SC2086 # lists of words
    (cd "$root" && RUSTC=$RUSTC RUSTC_BOOTSTRAP=${unstable:+1} "$cargo" rustc --quiet --release --locked --lib $unstable \
        --target "$target" --target-dir "$root/target" $kinds -- "$@")
}
