#!/bin/sh
# Fortran: the module has all that the header has; the programs in Fortran 77 and 2008 compile without
# a warning, run under trapping, and find the bar's forces; wrong arguments get a sentence.
#
#     sh tests/fortran.sh [--require]
#
# FC names the compiler, default gfortran. Without it all is skipped, or fails with --require.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/fortran
fc=${FC:-gfortran}
module=$root/include/signorini.f90
header=$root/include/signorini.h

# Every number and every function of the header, in the module.
grep -oE '^#define SIGNORINI_[A-Z0-9_]+ -?[0-9]+$' "$header" | while read -r _ name value; do
    grep -q "parameter :: $name = $value\$" "$module" ||
        { echo "fortran: signorini.f90 lacks $name = $value"; exit 1; }
done
grep -oE '\bsignorini_[a-z0-9_]+\(' "$header" | tr -d '(' | sort -u | while read -r name; do
    grep -q "bind(C, name=\"$name\")" "$module" ||
        { echo "fortran: signorini.f90 lacks $name"; exit 1; }
done
echo "fortran: the module has every number and function of the header"

if ! command -v "$fc" >/dev/null; then
    echo "fortran: '$fc' is missing (gfortran in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "fortran: SKIPPED"
    exit 0
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
ln -sf libsignorini.so "$root/target/release/libsignorini.so.0.1"
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# build LINK PROGRAM SOURCE...: with warnings as errors, and trapping at run time.
build() {
    link=$1
    program=$2
    shift 2
    if [ "$link" = static ]; then
        set -- "$@" "$root/target/release/libsignorini.a" -lm -lpthread -ldl
    else
        set -- "$@" "-L$root/target/release" -lsignorini "-Wl,-rpath,$root/target/release"
    fi
    "$fc" -Wall -Werror -g -ffpe-trap=invalid,zero,overflow "-I$root/include" -J. -o "$program" "$@"
}

# The forces and displacements that a host prints, against those of bar_reference.h: nodal
# displacements in mm and forces in daN; what the hosts print has 13 digits.
compare() {
    awk '/reference_d\[|reference_F\[/ { in_it = 1; which++; next } /};/ { in_it = 0 }
        in_it { gsub(/[{},]/, " "); for (i = 1; i <= NF; i++) print which, $i }' \
        "$root/c_examples/bar_reference.h" >reference
    awk 'NR == FNR { value[$1, ++count[$1]] = $2; size = $2 < 0 ? -$2 : $2
            if (size > most[$1]) most[$1] = size; next }
        $1 == "node" { n++; for (q = 0; q < 4; q++) {
            which = q < 2 ? 1 : 2
            off = $(NF - 3 + q) - value[which, 2 * n - 1 + q % 2]; if (off < 0) off = -off
            if (off / most[which] > worst[which]) worst[which] = off / most[which] } }
        END { if (n != 33 || count[1] != 66 || count[2] != 66) { print "not 33 nodes"; exit 1 }
            printf "%d nodes, displacements off by %.0e and forces by %.0e of the largest\n",
                n, worst[1], worst[2]
            exit !(worst[1] < 1e-9 && worst[2] < 1e-9) }' reference "$1"
}

hosts=$root/c_examples/hosts
for link in static shared; do
    build $link "skyline.$link" -std=legacy "$hosts/skyline.f"
    "./skyline.$link" >printed
    echo "fortran 77, skyline solver, $link: $(compare printed)"
    build $link "sparse.$link" -std=f2018 "$module" "$hosts/bar_mesh.f90" "$hosts/bar_sparse.f90"
    "./sparse.$link" >printed
    echo "fortran 2008, sparse matrix, $link: $(compare printed)"
done

names='SGSOLV SGTRES SGCERT SGLCPS SGMODL SGTWOB SGSPAR SGCASE SGRECV SGNODF SGFREE SGMESG'
wide="-cpp -fdefault-integer-8"
for name in $names; do
    wide="$wide -D$name=${name}_64"
done
# shellcheck disable=SC2086 # several options
build static skyline.wide -std=legacy $wide "$hosts/skyline.f"
./skyline.wide >printed
echo "fortran 77 with 8-byte integers: $(compare printed)"

build static bad_input -std=legacy "$root/tests/fortran/bad_input.f"
./bad_input
"$fc" -w -std=legacy -o widths "$root/tests/fortran/widths.f90" \
    "$root/target/release/libsignorini.a" -lm -lpthread -ldl
./widths
echo "fortran: wrong arguments and integers of the wrong width get a sentence"
