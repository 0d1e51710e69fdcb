#!/bin/sh
# Makes a release: the source tarball, the Debian packages built from it without a network, and their checksums.
#
#     sh c_examples/install/release.sh [OUT]
#
# All goes to OUT, by default target/release_files. No path of this machine is in the shared library: the compiler writes
# signorini/ and crates/ instead. Before that: the version in Cargo.toml and its section in CHANGELOG.md agree, and
# sh tests/run.sh --hosts has passed. MAINTAINER is as for debian.sh. To publish, tag the commit vVERSION.
set -eu

script=release
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh release.sh [OUT]"
find_cargo
out=${1:-$root/target/release_files}
mkdir -p -- "$out" || die "cannot create the directory $out"
out=$(CDPATH='' cd -- "$out" && pwd)
version=$(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")
grep -q "^## .*$version" "$root/CHANGELOG.md" || die "CHANGELOG.md has no section of version $version"

sh "$examples/install/source.sh" "$out"
work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT
tar xzf "$out/signorini-$version.tar.gz" -C "$work"
tree=$work/signorini-$version

# The vendored crates lie in the tree too; the standard library has no path of this machine.
RUSTFLAGS="--remap-path-prefix=$tree/vendor=crates --remap-path-prefix=$tree=signorini"
CARGO_NET_OFFLINE=true
export RUSTFLAGS CARGO_NET_OFFLINE
unset CARGO_TARGET_DIR
say "building without a network"
(cd "$tree" && cargo build --quiet --release --locked --offline --lib)
if grep -aqF -e "$work" -e "${HOME:-/root}/" "$tree/target/release/libsignorini.so"; then
    die "a path of this machine is in libsignorini.so"
fi
if command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null; then
    sh "$tree/c_examples/install/debian.sh" "$out"
else
    say "no Debian packages: dpkg-dev is missing"
fi
(cd "$out" && for file in *"$version"*.tar.gz *"$version"*.deb; do
    [ ! -f "$file" ] || sha256sum "$file"
done >SHA256SUMS)
say "$out/SHA256SUMS"
