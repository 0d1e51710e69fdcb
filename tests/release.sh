#!/bin/sh
# A cargo that is too old is refused in a sentence; and with --require a release is made: the tarball builds without
# a network, the shared library has no path of this machine, and the packages have documentation and examples.
#
#     sh tests/release.sh [--require | --twice]
#
# With --twice it is made again in another folder: all hashes are the same.
#
# Without an option the release, which builds all crates once more, is skipped, and it ends with 77.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/release
rm -rf -- "$work"
mkdir -p -- "$work/bin"
die() {
    echo "release: $*"
    exit 1
}

printf '#!/bin/sh\necho "cargo 1.60.0 (abcdef 2022-01-01)"\n' >"$work/bin/cargo"
chmod 755 "$work/bin/cargo"
for name in replay install/install install/source; do
    if PATH=$work/bin:$PATH sh "$root/c_examples/$name.sh" >"$work/said" 2>&1; then
        die "$name.sh takes cargo 1.60"
    fi
    grep -q "cargo 1.60 is too old, [0-9.]* is needed: 'rustup update'" "$work/said" ||
        { cat "$work/said"; die "$name.sh says something else"; }
done
echo "release: an old cargo is refused"

if [ $# -eq 0 ]; then
    echo "release: SKIPPED: the release itself (--require makes it)"
    exit 77
fi
# release FOLDER: makes one there.
release() {
    mkdir -p "$work/$1/build"
    TMPDIR=$work/$1/build sh "$root/c_examples/install/release.sh" "$work/$1"
}
release out
(cd "$work/out" && sha256sum -c SHA256SUMS)
if [ "$1" = --twice ]; then
    release again
    diff "$work/out/SHA256SUMS" "$work/again/SHA256SUMS" || die "a second release in another folder is not the same"
fi
for package in "$work"/out/libsignorini-dev_*.deb; do
    [ -f "$package" ] || continue
    dpkg-deb -c "$package" >"$work/contents"
    for file in README.md guide/first.md guide/drawings/signs.svg examples/first/sparse.c changelog.gz copyright; do
        grep -q "/usr/share/doc/libsignorini-dev/$file" "$work/contents" || die "$package lacks $file"
    done
done
echo "release: passed"
