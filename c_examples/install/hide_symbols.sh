#!/bin/sh
# Makes a static library that shows the names of the shared one and no others.
#
#     sh c_examples/install/hide_symbols.sh ARCHIVE SHARED OUT
#
# cargo's archive shows thousands of names: those of Rust's standard library and of every crate in
# it. A program that links a second Rust archive may then have two definitions of one name, and the
# linker refuses them or, worse, takes one for both. So all objects that the functions of SHARED
# reach become one object whose other names are local.
#
# NM, LD, OBJCOPY and AR name the tools, which are those of GNU. Where they are missing OUT is the
# archive as it is, and a sentence says so.
set -eu

[ $# -eq 3 ] || {
    echo "usage: sh hide_symbols.sh ARCHIVE SHARED OUT" >&2
    exit 2
}
archive=$1
shared=$2
out=$3
nm=${NM:-nm}
ld=${LD:-ld}
objcopy=${OBJCOPY:-objcopy}
ar=${AR:-ar}

work=$(mktemp -d "${TMPDIR:-/tmp}/signorini.XXXXXX")
trap 'rm -rf "$work"' EXIT

as_it_is() {
    echo "hide_symbols: $1: the static library also shows the names of Rust's standard library," \
        "and may not link with a second Rust archive" >&2
    cp "$archive" "$work/as_it_is.a"
    mv -f "$work/as_it_is.a" "$out"
    exit 0
}

for tool in "$nm" "$ld" "$objcopy" "$ar"; do
    command -v "$tool" >/dev/null || as_it_is "$tool is missing"
done
# Groups of sections that any Rust archive may have are dissolved: if the linker kept another
# archive's copy of one, our local names for its parts would lead nowhere.
"$ld" --help 2>/dev/null | grep -q -e --force-group-allocation ||
    as_it_is "$ld does not know --force-group-allocation"

"$nm" -DP --defined-only "$shared" | sed 's/[ @].*//' | sort -u >"$work/names"
[ -s "$work/names" ] || {
    echo "hide_symbols: $shared exports nothing" >&2
    exit 1
}

# Without --gc-sections, which makes weak references strong: the standard library looks that way for
# functions that older C libraries do not have. The host's linker may still be told to use it.
set --
while read -r name; do
    set -- "$@" -u "$name"
done <"$work/names"
"$ld" -r --force-group-allocation "$@" -o "$work/all.o" "$archive"

# Along go debugging information and bitcode of the standard library; the latter makes tools that
# are older than Rust's LLVM stumble.
"$objcopy" --keep-global-symbols="$work/names" --strip-debug \
    --remove-section=.llvmbc --remove-section=.llvmcmd "$work/all.o" "$work/signorini.o"
"$ar" rcD "$work/hidden.a" "$work/signorini.o"
"$ar" s "$work/hidden.a"
mv -f "$work/hidden.a" "$out"
