#!/bin/sh
# Makes a release: the source tarball, the Debian packages built from it without a network, and their checksums.
#
#     sh c_examples/install/release.sh [OUT]
#
# All goes to OUT, by default target/release_files, and nothing is signed. By the same compiler the same commit gives
# the same bytes in any folder (sh tests/release.sh --twice): no path of this machine is in the shared library, and all
# times are that of the commit or SOURCE_DATE_EPOCH. Before that: the version in Cargo.toml and its section in
# CHANGELOG.md agree, and sh tests/run.sh --hosts has passed. MAINTAINER is as for debian.sh. To publish, tag the commit
# vVERSION.
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
if command -v dh >/dev/null && command -v dh_python3 >/dev/null; then
    sh "$examples/install/debian.sh" "$out/signorini-$version.tar.gz"
    if dpkg-deb --fsys-tarfile "$out"/libsignorini[0-9]*"_$version"-*.deb |
        tar xOf - --wildcards "./usr/lib/*.so.$version" | grep -aqF -e "${TMPDIR:-/tmp}/" -e "${HOME:-/root}/"; then
        die "a path of this machine is in libsignorini.so.$version"
    fi
else
    say "no Debian packages: debhelper or dh-python is missing"
fi
(cd "$out" && for file in *"$version"*.tar.?z *"$version"*.dsc *"$version"*.deb; do
    [ ! -f "$file" ] || sha256sum "$file"
done | tee SHA256SUMS)
say "$out/SHA256SUMS"
