#!/bin/sh
# Installs the library without CMake: libraries, header, the Fortran module's source, signorini.pc,
# the CMake package, licences and a page for man, all that install.cmake installs.
#
#     PREFIX=/usr/local sh c_examples/install/install.sh
#
# PREFIX   where the library will be used, an absolute path; default /usr/local
# LIBDIR   the directory of libraries in PREFIX; default lib
# DESTDIR  put in front of every path that is written, and of none that is written down
#
# It builds the library by cargo. Where cargo is missing, say under sudo, it installs what has been
# built in target/release before.
set -eu

script=install
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

[ $# -eq 0 ] || die "it takes no arguments: set PREFIX, LIBDIR and DESTDIR"
prefix=${PREFIX:-/usr/local}
libdir=${LIBDIR:-lib}
case $prefix in
/*) ;;
*) die "PREFIX is '$prefix', not an absolute path" ;;
esac
case /$libdir/ in
//* | */./* | */../*) die "LIBDIR is '$libdir', not a directory in PREFIX" ;;
esac

# Under sudo cargo would leave files of root in target/.
[ -n "${SUDO_USER-}" ] || find_cargo
if command -v cargo >/dev/null; then
    say "building the library: cargo build --release --locked --lib"
    (cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
else
    say "cargo is missing: installing what has been built before"
fi

version=$(sed -n '/^version = /{s/[^"]*"\([^"]*\)".*/\1/p;q;}' "$root/Cargo.toml")
major=${version%%.*}
rest=${version#*.}
minor=${rest%%.*}
case $(uname -s) in
Darwin)
    built=libsignorini.dylib
    shared_name=$built
    private="-lSystem -lc -lm"
    ;;
*)
    built=libsignorini.so
    shared_name=$built.$version
    private="-lutil -lrt -lpthread -lm -ldl -lc"
    ;;
esac
for file in "$built" libsignorini.a; do
    [ -f "$root/target/release/$file" ] ||
        die "target/release/$file is missing: 'cargo build --release' makes it (https://rustup.rs)"
done

work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT
sh "$examples/install/hide_symbols.sh" "$root/target/release/libsignorini.a" \
    "$root/target/release/$built" "$work/libsignorini.a"

# A path as the right side of a substitution.
quoted() { printf '%s' "$1" | sed 's/[&|\\]/\\&/g'; }

# The package lies below PREFIX as deep as this says.
package=$libdir/cmake/signorini
up=$(printf '%s' "$package" | sed 's|//*|/|g; s|[^/][^/]*|..|g')

# pkg-config wants a backslash in front of a space.
escaped=$(printf '%s' "$prefix" | sed 's/ /\\ /g')
# shellcheck disable=SC2016 # names of pkg-config and CMake
sed -e "s|@prefix@|$(quoted "$escaped")|" -e "s|@libdir@|\${prefix}/$(quoted "$libdir")|" \
    -e 's|@includedir@|${prefix}/include|' -e "s|@version@|$version|" -e "s|@private@|$private|" \
    "$examples/install/signorini.pc.in" >"$work/signorini.pc"

cmake_private=$(printf '%s' "$private" | sed 's/^-l//; s/ -l/;/g')
# shellcheck disable=SC2016
sed -e "s|@PACKAGE_INIT@|get_filename_component(PACKAGE_PREFIX_DIR \"\${CMAKE_CURRENT_LIST_FILE}\" REALPATH)\\
get_filename_component(PACKAGE_PREFIX_DIR \"\${PACKAGE_PREFIX_DIR}/../$up\" ABSOLUTE)|" \
    -e "s|@PACKAGE_libdir@|\${PACKAGE_PREFIX_DIR}/$(quoted "$libdir")|" \
    -e 's|@PACKAGE_includedir@|${PACKAGE_PREFIX_DIR}/include|' -e 's|@PACKAGE_bindir@|${PACKAGE_PREFIX_DIR}/bin|' \
    -e 's|@static_name@|libsignorini.a|' -e "s|@shared_name@|$shared_name|" \
    -e "s|@version@|$version|" -e "s|@private@|$cmake_private|" \
    "$examples/install/signorini-config.cmake.in" >"$work/signorini-config.cmake"

# Before version 1.0 each minor version is its own interface.
cat >"$work/signorini-config-version.cmake" <<END
set(PACKAGE_VERSION "$version")
if(PACKAGE_FIND_VERSION_MAJOR EQUAL $major AND PACKAGE_FIND_VERSION_MINOR EQUAL $minor
        AND PACKAGE_FIND_VERSION VERSION_LESS_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
    if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
        set(PACKAGE_VERSION_EXACT TRUE)
    endif()
else()
    set(PACKAGE_VERSION_COMPATIBLE FALSE)
endif()
END

to=${DESTDIR:-}$prefix
say "installing to $to"
install -d "$to/include" "$to/$libdir/pkgconfig" "$to/$package" "$to/share/doc/signorini" "$to/share/man/man7"
install -m 644 "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$root/LICENSE-THIRD-PARTY" "$to/share/doc/signorini"
install -m 644 "$examples/install/signorini.7" "$to/share/man/man7"
install -m 644 "$root/include/signorini.h" "$root/include/signorini_file.h" \
    "$root/include/signorini_surface.h" "$to/include"
install -m 644 "$root/include/signorini.f90" "$root/include/signorini.inc" "$to/include"
install -m 644 "$work/libsignorini.a" "$to/$libdir"
install -m 755 "$root/target/release/$built" "$to/$libdir/$shared_name"
if [ "$shared_name" != "$built" ]; then
    ln -sf "$shared_name" "$to/$libdir/$built.$major.$minor"
    ln -sf "$built.$major.$minor" "$to/$libdir/$built"
fi
install -m 644 "$work/signorini.pc" "$to/$libdir/pkgconfig"
install -m 644 "$work/signorini-config.cmake" "$work/signorini-config-version.cmake" "$to/$package"
