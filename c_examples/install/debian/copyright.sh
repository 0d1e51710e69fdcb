#!/bin/sh
# Writes debian/copyright of an unpacked source tarball to the standard output: the project's licences, then those of
# each crate in vendor/ as its manifest and its licence texts say.
#
#     sh copyright.sh TREE
set -eu
cd "$1"

# The words of Debian's format for an expression of Cargo's.
expression() {
    sed -e 's|/| OR |g; s/(\(.*\) OR \(.*\)) AND/\1 OR \2, AND/; s/\<MIT\>/Expat/g; s/ OR / or /g; s/ AND / and /g' \
        -e 's/ WITH LLVM-exception/ with LLVM exception/'
}
# A text as a field's further lines.
field() {
    sed 's/[[:space:]]*$//; s/^$/./; s/^/ /' "$@"
}
# Who has the copyright by a crate's texts, else by its manifest.
holders() {
    {
        cat "$1"/LICEN* "$1"/COPYING* "$1"/COPYRIGHT* 2>/dev/null |
            sed -n 's/^[^A-Za-z]*Copyright *\(([cC])\|©\)* *\([^[{]*\)$/\2/p' | sed '/^s /d; /retained/d; /^notice/d'
        sed -n '/^authors = /{:more; /]/!{N; b more;}; p;}' "$1/Cargo.toml" | tr ',' '\n' | sed -n 's/.*"\(.*\)".*/\1/p'
    } | awk '{ sub(/[. ]*$/, "") } NF && !seen[$0]++' >"$holders"
    [ -s "$holders" ] || echo "the authors of $2" >"$holders"
    field "$holders"
}
holders=$(mktemp)
trap 'rm -f "$holders"' EXIT

cat <<HEAD
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: signorini
Comment: LICENSE-THIRD-PARTY, which is installed beside this file, has the whole texts of what is linked.

Files: *
Copyright: $(sed -n 's/^Copyright (c) //p' LICENSE-MIT)
License: Expat or Apache-2.0
HEAD
for crate in vendor/*; do
    name=${crate#vendor/}
    printf '\nFiles: %s/*\nCopyright:\n' "$crate"
    holders "$crate" "$name"
    printf 'License: %s\n' "$(sed -n 's/^license = "\(.*\)"/\1/p' "$crate/Cargo.toml" | expression)"
done

for licence in Apache-2.0 MPL-2.0 LGPL-2.1; do
    or_later=
    [ $licence != LGPL-2.1 ] || or_later=-or-later
    printf '\nLicense: %s\n On Debian systems its text is in /usr/share/common-licenses/%s.\n' $licence$or_later $licence
done
for licence in Expat:LICENSE-MIT Zlib:vendor/bytemuck-1*/LICENSE-ZLIB Unlicense:vendor/byteorder-*/UNLICENSE \
    BSD-2-Clause:vendor/zerocopy-0*/LICENSE-BSD Unicode-3.0:vendor/unicode-ident-*/LICENSE-UNICODE; do
    printf '\nLicense: %s\n' "${licence%%:*}"
    # shellcheck disable=SC2086 # a pattern
    field ${licence#*:}
done
printf '\nLicense: Apache-2.0 with LLVM exception\n The Apache License 2.0 with these exceptions:\n'
sed -n '/LLVM Exceptions/,$p' vendor/rustix-*/LICENSE-Apache-2.0_WITH_LLVM-exception | field
