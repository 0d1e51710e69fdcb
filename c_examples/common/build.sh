# Sourced by the scripts that build and run an example: what they have in common.
#
# The script sets `script`, its name for messages, and `root`, the directory of Cargo.toml. Then
# `prepare` builds the library, and `compile NAME SOURCE...` compiles sources, named from c_examples
# on, against it to $build/NAME. CC names the C compiler, default cc. All goes to target/.
# shellcheck shell=sh disable=SC2154

say() { printf '%s: %s\n' "$script" "$*"; }
die() {
    say "$*" >&2
    exit 1
}

examples=$root/c_examples
build=$root/target/c_examples
cc=${CC:-cc}

# rustup installs cargo where PATH may not lead. One that is too old is refused here, in words that help.
find_cargo() {
    command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
    command -v cargo >/dev/null || return 0
    wanted=$(sed -n 's/^rust-version = "\([0-9.]*\)".*/\1/p' "$root/Cargo.toml")
    given=$(cargo --version | sed -n 's/^cargo \([0-9]*\.[0-9]*\).*/\1/p')
    oldest=$(printf '%s\n%s\n' "$wanted" "$given" | sort -t . -k 1,1n -k 2,2n | head -n 1)
    [ "$oldest" = "$wanted" ] ||
        die "cargo ${given:-of no version} is too old, $wanted is needed: 'rustup update', or https://rustup.rs"
}

check_tools() {
    find_cargo
    command -v cargo >/dev/null || die "cargo is missing: install Rust, https://rustup.rs"
    # CC may hold options after the name of the compiler.
    command -v "${cc%% *}" >/dev/null ||
        die "the C compiler '$cc' is missing: install one, or set CC"
}

prepare() {
    say "building the library: cargo build --release --locked"
    (cd "$root" && cargo build --release --locked --target-dir "$root/target")

    # The program asks for the shared library by the name that the library has inside, next to
    # itself.
    case $(uname -s) in
    Darwin)
        built=libsignorini.dylib
        name=$built
        here=@loader_path
        ;;
    *)
        built=libsignorini.so
        name=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")
        name=$built.$name
        here=\$ORIGIN
        ;;
    esac
    library=$root/target/release/$built
    [ -f "$library" ] || die "no library at $library: is build.target set in a cargo configuration?"

    # Under temporary names first: another script may be running.
    mkdir -p "$build/lib"
    cp "$library" "$build/lib/$name.$$"
    mv -f "$build/lib/$name.$$" "$build/lib/$name"
}

compile() {
    program=$1
    shift
    say "compiling the program: $cc"
    # shellcheck disable=SC2086 # options in CC
    (cd "$examples" &&
        $cc -std=c11 -O2 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I "$root/include" \
            -o "$build/$program.$$" "$@" "$build/lib/$name" -lm "-Wl,-rpath,$here/lib")
    mv -f "$build/$program.$$" "$build/$program"
}
