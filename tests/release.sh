#!/bin/sh
# A cargo that is too old is refused in a sentence; and with --require a release is made: the tarball builds without
# a network, the shared library has no path of this machine, and the packages have documentation and examples.
#
#     sh tests/release.sh [--require | --twice]
#
# With --twice it is made again in another folder: the hashes are the same but for the two packages with libraries,
# and the shared library is the same but for its build ID. LLVM gives numbers to the names of some local functions
# (.llvm.11658262545296167773), which were the same in two builds of three; the build ID counts them.
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
# release FOLDER: makes one there, and in FOLDER/comparable what a second one must repeat.
release() {
    mkdir -p "$work/$1/build"
    TMPDIR=$work/$1/build sh "$root/c_examples/install/release.sh" "$work/$1"
    comparable "$1"
}
comparable() {
    grep -v libsignorini "$work/$1/SHA256SUMS" >"$work/$1/comparable"
    for package in "$work/$1"/libsignorini[0-9]*.deb; do
        [ -f "$package" ] || continue
        dpkg-deb --fsys-tarfile "$package" | tar xOf - --wildcards './usr/lib/*.so.*.*.*' >"$work/$1/library"
        objcopy --remove-section=.note.gnu.build-id "$work/$1/library"
        sha256sum <"$work/$1/library" >>"$work/$1/comparable"
    done
}
release out
(cd "$work/out" && sha256sum -c SHA256SUMS)
if [ "$1" = --twice ]; then
    release again
    diff "$work/out/comparable" "$work/again/comparable" || die "a second release in another folder is not the same"
fi
for package in "$work"/out/libsignorini-dev_*.deb; do
    [ -f "$package" ] || continue
    dpkg-deb -c "$package" >"$work/contents"
    for file in README.md guide/first.md guide/drawings/signs.svg examples/first/sparse.c changelog.gz copyright; do
        grep -q "/usr/share/doc/libsignorini-dev/$file" "$work/contents" || die "$package lacks $file"
    done
done
echo "release: passed"
