#!/bin/sh
# The shared library exports the functions of the headers in include/ and nothing else, has the name of
# its interface, and does not call what a library must not call. The static library of an
# installation shows the same functions and no others.
#
# usage: sh tests/symbols.sh LIBRARY [ARCHIVE]
#
# SYSTEM is the system of the library as `uname -s` says it, by default this one; NM is the nm that reads it.

set -u
LC_ALL=C
export LC_ALL

library=${1:?usage: sh tests/symbols.sh LIBRARY [ARCHIVE]}
archive=${2:-}
headers=$(dirname "$0")/../include
header=$headers/signorini.h
system=${SYSTEM:-$(uname -s)}
nm=${NM:-nm}
failed=0

fail() {
    echo "symbols: $*"
    failed=1
}

# The header without its comments; then every name in front of an opening parenthesis.
code() {
    awk '{
        line = $0
        while (1) {
            if (inside) {
                end = index(line, "*/")
                if (!end) break
                line = substr(line, end + 2)
                inside = 0
            }
            begin = index(line, "/*")
            if (!begin) { sub(/\/\/.*/, "", line); print line; break }
            printf "%s ", substr(line, 1, begin - 1)
            line = substr(line, begin + 2)
            inside = 1
        }
    }' "$headers"/signorini.h "$headers"/signorini_surface.h "$headers"/signorini_file.h
}
declared=$(code | grep -o 'signorini_[a-z0-9_]*(' | tr -d '(' | sort -u)
[ -n "$declared" ] || fail "no function found in $header"
# Those of Fortran 77, which include/signorini.inc documents.
for name in sgsolv sglcps sgspar sgcase sgrecv sgfree sgmesg sgsurf sgsmod sgsgap sgsfld sgsumm sgsfre; do
    declared="$declared
${name}_
${name}_64_"
done
declared=$(echo "$declared" | sort -u)

# macOS puts an underscore in front of every name and has no versions of shared objects.
if [ "$system" = Darwin ]; then
    names() { "$nm" -gP "$@" "$library" | sed 's/^_//; s/ .*//' | sort -u; }
    exported=$(names -U)
    imported=$(names -u)
else
    names() { "$nm" -DP "$@" "$library" | sed 's/[ @].*//' | sort -u; }
    exported=$(names --defined-only)
    imported=$(names --undefined-only)
fi

for name in $declared; do
    echo "$exported" | grep -qx "$name" || fail "$name is declared but not exported"
done
for name in $exported; do
    echo "$declared" | grep -qx "$name" || fail "$name is exported but not declared"
done

# exit and its kin, printing through stdio, signal handlers. (_exit, write and signal come with Rust's
# standard library, which uses them in child processes and for its own last words; sigaltstack is called on
# threads of programs that are Rust's own. Threads are started where settings.threads asks for them alone:
# tests/sources/layering.rs.)
for name in exit _Exit quick_exit atexit on_exit printf fprintf vfprintf puts fputs putchar perror \
    sigaction longjmp __longjmp_chk; do
    echo "$imported" | grep -qx "$name" && fail "it calls $name"
done

if [ "$system" != Darwin ]; then
    version() { sed -n "s/^#define SIGNORINI_VERSION_$1 \([0-9]*\)\( .*\)\{0,1\}$/\1/p" "$header"; }
    wanted=libsignorini.so.$(version MAJOR).$(version MINOR)
    soname=$(readelf -d "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\].*/\1/p')
    [ "$soname" = "$wanted" ] || fail "its SONAME is '$soname', not '$wanted'"

    if [ -n "$archive" ]; then
        shown=$("$nm" -P --defined-only --extern-only "$archive" | awk '$2 ~ /^[A-Za-z]$/ { print $1 }' |
            sort -u)
        [ "$shown" = "$declared" ] || {
            fail "$archive does not show what is declared, but:"
            echo "$shown" | head -n 40
        }
    fi
fi

[ "$failed" = 0 ] && echo "symbols: $(echo "$declared" | wc -l | tr -d ' ') functions, as declared"
exit "$failed"
