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
sed -n 's/^#define \(SIGNORINI_[A-Z0-9_]*\) \(-\{0,1\}[0-9]\{1,\}\)\( .*\)\{0,1\}$/\1 = \2/p' \
    "$root/include/signorini.h" | sort >"$work/wanted"
sed -n 's/^ *integer(c_int32_t), parameter :: \(SIGNORINI_.*\)$/\1/p' "$module" | sort >"$work/given"
[ -s "$work/wanted" ] || die "no constant found in the header"
diff "$work/wanted" "$work/given" || die "constants of signorini.f90 are not those of signorini.h"
say "signorini.f90 has the $(wc -l <"$work/wanted" | tr -d ' ') constants of the header"
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
        if (match(text, /^[^"]*name="[a-z_0-9]+"/) && fortran) {
            name = substr(text, 1, RLENGTH - 1)
            sub(/.*"/, "", name)
        }
        print name, n
    }
}'
sed '/^#/d; s/^ *\*.*//; s/\/\*.*//; s/\/\/.*//' "$root/include/signorini.h" |
    awk -v start='signorini_[a-z_0-9]+\\(' -v fortran=0 "$count" | sort >"$work/wanted"
sed -n '/^    interface/,/^    end interface/p' "$module" | sed '/^ *end /d; s/!.*//' |
    awk -v start='(function|subroutine) signorini_[a-z_0-9]+\\(' -v fortran=1 "$count" |
    sort >"$work/given"
[ -s "$work/wanted" ] || die "no function found in the header"
diff "$work/wanted" "$work/given" || die "functions of signorini.f90 are not those of signorini.h"
say "signorini.f90 has the $(wc -l <"$work/wanted" | tr -d ' ') functions of the header"

# ---- programs ----

# The names for 8-byte integers.
wide="-cpp -fdefault-integer-8"
for name in SOLV CERT LCPS MODL TWOB OPER OPEH SPAR SPAW FRAM CASE RECV NODF FREE MESG \
    SURF SURC SMOD SGAP SFLD SVTU SUMM SFRE; do
    wide="$wide -DSG$name=SG${name}_64"
done
hosts=$root/c_examples/hosts/fortran
tests=$root/tests/fortran

runs() {
    "$work/$1" >"$work/$1.out" 2>&1 || { cat "$work/$1.out"; die "$1 failed"; }
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
    compile "operator_77_$kind" "$kind" "$tests/operator.f"
    runs "operator_77_$kind"
    # shellcheck disable=SC2086
    compile "operator_77_64_$kind" "$kind" $wide "$tests/operator.f"
    runs "operator_77_64_$kind"
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
    compile "operator_90_$kind" "$kind" -std=f2008 "$module" "$tests/operator.f90"
    runs "operator_90_$kind"
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
