#!/bin/sh
# Makes a source tarball that builds without a network: the files of the project and, in vendor/, those of all
# crates that Cargo.lock names.
#
#     sh c_examples/install/source.sh [OUT]
#
# It goes to OUT, by default target/source: signorini-VERSION.tar.gz. Unpack it, and `cargo build --release --locked
# --offline` or any script of c_examples builds the library. The same files give the same bytes; their time is that of
# the commit, or SOURCE_DATE_EPOCH.
set -eu

script=source
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh source.sh [OUT]"
find_cargo
for tool in cargo tar gzip; do
    command -v "$tool" >/dev/null || die "$tool is missing"
done
out=${1:-$root/target/source}
mkdir -p -- "$out" || die "cannot create the directory $out"
out=$(CDPATH='' cd -- "$out" && pwd)
version=$(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")
name=signorini-$version
work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT

# The files that git knows, as they are now; without git all of the fixed top level.
cd "$root"
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    epoch=$(git log -1 --format=%ct)
    git ls-files
else
    epoch=$(date -r Cargo.toml +%s)
    find Cargo.toml Cargo.lock README.md CHANGELOG.md LICENSE-* .cargo-deny.toml .rustfmt.toml src include \
        c_examples tests -type f
fi >"$work/files"
epoch=${SOURCE_DATE_EPOCH:-$epoch}
mkdir -p "$work/$name/.cargo"
tar cf - -T "$work/files" | tar xf - -C "$work/$name"

say "copying the crates: cargo vendor"
# It prints the configuration that names the copies; with --quiet it does not.
(cd "$work/$name" && cargo vendor --locked --versioned-dirs vendor 2>"$work/said" >.cargo/config.toml) || {
    cat "$work/said" >&2
    die "cargo vendor has failed"
}
grep -q '^directory = "vendor"' "$work/$name/.cargo/config.toml" || die "cargo vendor names no copies"
tar --sort=name --mtime="@$epoch" --mode=u=rwX,go=rX --owner=0 --group=0 --numeric-owner -cf - -C "$work" "$name" |
    gzip -9n >"$out/$name.tar.gz.part"
mv -f "$out/$name.tar.gz.part" "$out/$name.tar.gz"
say "$out/$name.tar.gz"
