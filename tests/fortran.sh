#!/bin/sh
# Fortran: the module has every call and constant of the header; the examples in Fortran 77 and 2008
# compile without a warning, run with trapping and find the bar's known solution; bad input ends in
# INFO and a sentence. Each against the static and the shared library, Fortran 77 with both widths
# of integers.
#
#     sh tests/fortran.sh [--require]
#
# Without gfortran it is skipped and ends with 77; with --require it fails.
set -eu
LC_ALL=C
export LC_ALL

script=fortran
if ! command -v "${FC:-gfortran}" >/dev/null 2>&1; then
    echo "fortran: SKIPPED: no Fortran compiler '${FC:-gfortran}' (Debian: gfortran), or set FC"
    [ "${1:-}" != --require ] || exit 1
    exit 77
fi
# shellcheck source=tests/fortran/build.sh
. "$(dirname -- "$0")/fortran/build.sh"

# ---- the module against the header ----

module=$root/include/signorini.f90
# Those that may still change too.
headers="$root/include/signorini.h $root/include/signorini_surface.h $root/include/signorini_file.h"
# same WHAT: the lists wanted and given, of the headers and of the module, are equal.
same() {
    [ -s "$work/wanted" ] || die "no $1 found in the headers"
    diff "$work/wanted" "$work/given" || die "$1 of signorini.f90 are not those of the headers"
    say "signorini.f90 has the $(wc -l <"$work/wanted" | tr -d ' ') $1 of the headers"
}
# shellcheck disable=SC2086 # several files
sed -n 's/^#define \(SIGNORINI_[A-Z0-9_]*\) \(-\{0,1\}[0-9]\{1,\}\)\( .*\)\{0,1\}$/\1 = \2/p' $headers |
    sort >"$work/wanted"
sed -n 's/^ *integer(c_int32_t), parameter :: \(SIGNORINI_.*\)$/\1/p' "$module" | sort >"$work/given"
same constants
# Names and numbers of arguments of the functions.
count='{ text = text " " $0 }
END {
    while (match(text, start)) {
        text = substr(text, RSTART)
        match(text, /[a-z_0-9]+\(/)
        name = substr(text, RSTART, RLENGTH - 1)
        text = substr(text, RSTART + RLENGTH)
        list = substr(text, 1, index(text, ")") - 1)
        n = list ~ /^ *(void)? *$/ ? 0 : gsub(/,/, ",", list) + 1
        if (match(text, /^[ &)]*bind\(C, name="[a-z_0-9]+"/)) {
            name = substr(text, 1, RLENGTH - 1)
            sub(/.*"/, "", name)
        }
        print name, n
    }
}'
# shellcheck disable=SC2086
sed '/^#/d; s/^ *\*.*//; s/\/\*.*//; s/\/\/.*//' $headers |
    awk -v start='signorini_[a-z_0-9]+\\(' "$count" | sort >"$work/wanted"
sed -n '/^    interface/,/^    end interface/p' "$module" | sed '/^ *end /d; s/!.*//' |
    awk -v start='(function|subroutine) signorini_[a-z_0-9]+\\(' "$count" | sort >"$work/given"
same functions
# Fields of the structures with their widths, in order. Fortran knows no upper case: F is force there.
# shellcheck disable=SC2086
cat $headers | awk '
    /^ *\*/ { next }
    { sub(/ *\/\*.*/, "") }
    /^struct [a-z_]+ \{$/ { name = $2; next }
    /^\};$/ { name = "" }
    name != "" && /;$/ {
        width = /\*/ || /_fn / ? "address" : $1 ~ /int64/ ? "8" : $1 ~ /int32/ ? "4" : "real"
        field = $NF
        gsub(/[*;]/, "", field)
        sub(/\[3\]/, "(3)", field)
        sub(/^F$/, "force", field)
        sub(/_F$/, "_force", field)
        print name, tolower(field), width
    }' >"$work/wanted"
awk '
    /^    type, bind\(C\) ::/ { name = $4; next }
    /^    end type/ { name = "" }
    name != "" && / :: / {
        print name, $3, /c_ptr|c_funptr/ ? "address" : /c_int64_t/ ? "8" : /c_int32_t/ ? "4" : "real"
    }' "$module" >"$work/given"
sort -s -k 1,1 "$work/wanted" -o "$work/wanted"
sort -s -k 1,1 "$work/given" -o "$work/given"
same fields

# ---- programs ----

# The names for 8-byte integers.
wide="-cpp -fdefault-integer-8"
for name in SOLV LCPS SPAR CASE RECV FREE MESG SURF SMOD SGAP SFLD SUMM SFRE; do
    wide="$wide -DSG$name=SG${name}_64"
done
hosts=$root/c_examples/hosts/fortran
tests=$root/tests/fortran

runs() {
    run "$1" >"$work/$1.out" 2>&1 || { cat "$work/$1.out"; die "$1 failed"; }
    say "$1: $(tail -n 1 "$work/$1.out")"
}

for kind in static shared; do
    compile "skyline_$kind" "$kind" "$hosts/skyline.f"
    compare "skyline_$kind"
    # shellcheck disable=SC2086 # several options
    compile "skyline_64_$kind" "$kind" $wide "$hosts/skyline.f"
    compare "skyline_64_$kind"
    compile "bad_input_$kind" "$kind" "$tests/bad_input.f"
    runs "bad_input_$kind"
    # shellcheck disable=SC2086
    compile "bad_input_64_$kind" "$kind" $wide "$tests/bad_input.f"
    runs "bad_input_64_$kind"
    compile "two_blocks_$kind" "$kind" "$tests/two_blocks.f"
    runs "two_blocks_$kind"
    # shellcheck disable=SC2086
    compile "two_blocks_64_$kind" "$kind" $wide "$tests/two_blocks.f"
    runs "two_blocks_64_$kind"
    compile "widths_$kind" "$kind" "$tests/widths.f90"
    runs "widths_$kind"
    compile "bar_sparse_$kind" "$kind" -std=f2008 "$module" "$hosts/bar_mesh.f90" \
        "$hosts/bar_sparse.f90"
    compare "bar_sparse_$kind"
    compile "layer_$kind" "$kind" -std=f2008 "$module" "$tests/layer.f90"
    runs "layer_$kind"
    compile "refusals_$kind" "$kind" -std=f2008 "$module" "$tests/refusals.f90"
    runs "refusals_$kind"
    compile "mistakes_$kind" "$kind" -std=f2008 "$module" "$tests/mistakes.f90"
    runs "mistakes_$kind"
    compile "counting_$kind" "$kind" -std=f2008 "$module" "$tests/counting.f90"
    runs "counting_$kind"
    compile "rows_$kind" "$kind" "$module" "$tests/rows.f90"
    runs "rows_$kind"
    compile "surfaces_$kind" "$kind" -std=f2008 "$module" "$tests/surfaces.f90"
    runs "surfaces_$kind"
    compile "operator_$kind" "$kind" -std=f2008 "$module" "$tests/operator.f90"
    runs "operator_$kind"
done
for name in layer refusals mistakes counting rows surfaces operator; do
    # shellcheck disable=SC2086 # several options
    compile "${name}_64" shared $wide "$module" "$tests/$name.f90"
    runs "${name}_64"
done
compile bar_sparse_64 shared -fdefault-integer-8 "$module" "$hosts/bar_mesh.f90" \
    "$hosts/bar_sparse.f90"
compare bar_sparse_64
say "all programs passed"
