#!/bin/sh
# Makes a Debian source package and its packages: libsignorini with the number of the interface, which programs need to
# run, libsignorini-dev, which they are built with, and python3-signorini.
#
#     sh c_examples/install/debian.sh [--chroot] [TARBALL]
#
# TARBALL   a source tarball; without it source.sh makes one in target/debian. All packages go beside it.
# --chroot  for a release: in a new system with nothing but Build-Depends the packages are built without a network,
#           the programs in C tested, and lintian finds no error; in a second one they are installed, and the first
#           example prints what README says. It needs mmdebstrap. SUITE is a release of Debian, by default this one.
#
# Otherwise this machine's own cargo builds them, without tests. MAINTAINER is who answers for them, "Name <address>".
set -eu

script=debian
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

chroot=
[ "${1-}" != --chroot ] || { chroot=yes; shift; }
[ $# -le 1 ] || die "usage: sh debian.sh [--chroot] [TARBALL]"
find_cargo
for tool in cargo dpkg-buildpackage dh dh_python3 cmake ${chroot:+mmdebstrap}; do
    command -v "$tool" >/dev/null ||
        die "$tool is missing: install Rust, and Debian's dpkg-dev debhelper dh-python cmake ${chroot:+mmdebstrap}"
done
version=$(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")
interface=${version%.*}
name=signorini_$version
tarball=${1-}
if [ -z "$tarball" ]; then
    tarball=$root/target/debian/signorini-$version.tar.gz
    sh "$examples/install/source.sh" "$root/target/debian"
fi
out=$(CDPATH='' cd -- "$(dirname -- "$tarball")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT

# ---- the source package ----

cp "$tarball" "$work/$name.orig.tar.gz"
tar xzf "$tarball" -C "$work"
tree=$work/signorini-$version
[ -d "$tree" ] || die "$tarball does not hold signorini-$version"
cp -R "$tree/c_examples/install/debian" "$tree/debian"
maintainer=${MAINTAINER:-signorini <signorini@localhost>}
sed -i -e "s/@maintainer@/$maintainer/" -e "s/@interface@/$interface/" \
    -e "s/@rust@/$(sed -n 's/^rust-version = "\(.*\)"/\1/p' "$tree/Cargo.toml")/" "$tree/debian/control"
for end in docs install; do
    mv "$tree/debian/libsignorini.$end" "$tree/debian/libsignorini$interface.$end"
done
mkdir "$tree/debian/source"
echo "3.0 (quilt)" >"$tree/debian/source/format"
cat >"$tree/debian/changelog" <<ENTRY
signorini ($version-1) unstable; urgency=medium

  * Version $version: /usr/share/doc/libsignorini$interface/changelog.gz.

 -- $maintainer  $(date -uRd "@${SOURCE_DATE_EPOCH:-$(stat -c %Y "$tree/Cargo.toml")}")
ENTRY
# The names in capitals, and those without an underscore at the end, are for Windows.
sed -n -e "1i libsignorini.so.$interface libsignorini$interface #MINVER#\n* Build-Depends-Package: libsignorini-dev" \
    -e "s/^ *\(signorini_.*\|sg.*_\)\$/ \1@Base $version/p" "$tree/include/signorini.def" \
    >"$tree/debian/libsignorini$interface.symbols"
sh "$tree/debian/copyright.sh" "$tree" >"$tree/debian/copyright"
rm "$tree/debian/copyright.sh"
(cd "$work" && dpkg-source --build "signorini-$version") >"$work/log" 2>&1 ||
    { cat "$work/log"; die "dpkg-source has failed"; }

# ---- the packages ----

# in_a_new_system FILE...: a minimal system gets the files in /build, runs $work/steps there, and gives /build back.
in_a_new_system() {
    # shellcheck disable=SC2016 # "$1" is the system's folder
    mmdebstrap --quiet --variant=buildd --format=null --customize-hook='mkdir "$1/build"' \
        --customize-hook="copy-in $work/steps $* /build" --customize-hook='chroot "$1" sh -eu /build/steps' \
        --customize-hook="sync-out /build $work/built" \
        "${SUITE:-$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)}" /dev/null
}

mkdir "$work/built"
if [ -n "$chroot" ]; then
    # Nobody answers to the address of a machine; MAINTAINER has another.
    lintian="lintian --allow-root --fail-on error"
    [ -n "${MAINTAINER-}" ] || lintian="$lintian --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog"
    cat >"$work/steps" <<STEPS
cd /build
dpkg-source --extract *.dsc tree >log
apt-get --yes --no-install-recommends build-dep ./tree >log
(cd tree && unshare --net dpkg-buildpackage --no-sign) >log 2>&1 || { tail -n 40 log; exit 1; }
grep 'tests passed' log
rm -r tree
apt-get --yes --no-install-recommends install lintian >log
$lintian *.changes
STEPS
    say "building in a new system of nothing but Build-Depends, without a network"
    in_a_new_system "$work/$name-1.dsc" "$work/$name-1.debian.tar.xz" "$work/$name.orig.tar.gz"
    cat >"$work/steps" <<STEPS
apt-get --yes --no-install-recommends install /build/*.deb gfortran pkgconf >/dev/null
sh /build/first
STEPS
    say "installing in another new system"
    in_a_new_system "$work"/built/*.deb "$tree/debian/tests/first"
else
    say "building by $(cargo --version): dpkg-buildpackage"
    # debhelper has a HOME of its own.
    (cd "$tree" && RUSTUP_HOME=${RUSTUP_HOME:-$HOME/.rustup} DEB_BUILD_OPTIONS="nocheck ${DEB_BUILD_OPTIONS-}" \
        dpkg-buildpackage --build=binary --no-check-builddeps --no-sign) >"$work/log" 2>&1 ||
        { tail -n 40 "$work/log"; die "dpkg-buildpackage has failed"; }
    mv "$work"/*.deb "$work/built"
fi
for file in "$work/$name"*.dsc "$work/$name"*.tar.?z "$work"/built/*.deb; do
    mv -f "$file" "$out"
    say "$out/$(basename "$file")"
done
