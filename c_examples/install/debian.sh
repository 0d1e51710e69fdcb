#!/bin/sh
# Makes Debian packages of the library: libsignorini0.2, what programs need to run, and
# libsignorini-dev, what they are built with.
#
#     sh c_examples/install/debian.sh [OUT]
#
# They go to OUT, by default target/debian. MAINTAINER is who answers for them, "Name <address>".
set -eu

script=debian
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -le 1 ] || die "usage: sh debian.sh [OUT]"
find_cargo
for tool in cargo dpkg-deb dpkg-shlibdeps; do
    command -v "$tool" >/dev/null || die "$tool is missing: install Rust and Debian's dpkg-dev"
done
out=${1:-$root/target/debian}
mkdir -p -- "$out" || die "cannot create the directory $out"
out=$(CDPATH='' cd -- "$out" && pwd)
top=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$top"' EXIT

# dpkg-shlibdeps wants the trees in the place that they have in a source package.
work=$top/debian
version=$(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")
interface=${version%.*}
architecture=$(dpkg --print-architecture)
libdir=lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
run=libsignorini$interface
dev=libsignorini-dev

DESTDIR=$work/$dev PREFIX=/usr LIBDIR=$libdir sh "$examples/install/install.sh"
mkdir -p "$work/$run/DEBIAN" "$work/$run/usr/$libdir"
for file in "libsignorini.so.$version" "libsignorini.so.$interface"; do
    mv "$work/$dev/usr/$libdir/$file" "$work/$run/usr/$libdir"
done
chmod 644 "$work/$run/usr/$libdir/libsignorini.so.$version"
strip --strip-unneeded "$work/$run/usr/$libdir/libsignorini.so.$version"

printf 'Source: signorini\n\nPackage: %s\nArchitecture: any\n' "$run" >"$work/control"
depends=$(cd "$top" &&
    dpkg-shlibdeps -O --ignore-missing-info "debian/$run/usr/$libdir/libsignorini.so.$version" |
    sed -n 's/^shlibs:Depends=//p')

# package NAME SECTION DEPENDS SUMMARY
package() {
    documents=$work/$1/usr/share/doc/$1
    mkdir -p "$documents" "$work/$1/DEBIAN"
    cat "$root/LICENSE-MIT" "$root/LICENSE-APACHE" >"$documents/copyright"
    gzip -9n <"$root/CHANGELOG.md" >"$documents/changelog.gz"
    cat >"$work/$1/DEBIAN/control" <<END
Package: $1
Source: signorini
Version: $version-1
Architecture: $architecture
Multi-Arch: same
Maintainer: ${MAINTAINER:-signorini <root@localhost>}
Installed-Size: $(du -sk "$work/$1/usr" | cut -f 1)
Depends: $3
Section: $2
Priority: optional
Description: unilateral contact with Coulomb friction, $4
 Takes stiffness matrices, gaps and loads of a finite-element code through a C
 interface, and gives contact forces, displacements and a certificate.
END
    if [ "$1" = "$run" ]; then
        echo "libsignorini $interface $run (>= $version)" >"$work/$1/DEBIAN/shlibs"
        echo "activate-noawait ldconfig" >"$work/$1/DEBIAN/triggers"
    fi
    dpkg-deb --root-owner-group --build "$work/$1" "$out" >/dev/null
    say "$out/$1_$version-1_$architecture.deb"
}
# Examples for programmers go with what they build with, and keep their places beside each other.
documents=$work/$dev/usr/share/doc/$dev
mkdir -p "$documents/examples"
cp -R "$root/README.md" "$examples/guide" "$examples/LIMITS.md" "$documents"
for example in first bar junction 3d fclib files common hosts; do
    cp -R "$examples/$example" "$documents/examples"
done
find "$documents" -type d -exec chmod 755 {} + -o -type f -exec chmod 644 {} +
package "$run" libs "$depends" "shared library"
package "$dev" libdevel "$run (= $version-1)" "development files"
