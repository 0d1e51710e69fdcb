# Sourced by tests/fortran.sh and tests/host_mumps.sh, which set `script`, their name for messages.
#
# The library is that of target/release, which has been built. FC names the Fortran compiler,
# default gfortran. All goes to target/fortran. tests/platforms.sh sets BUILT and WORK, the library and the place of
# another platform, and RUNNER, which runs its programs.
# shellcheck shell=sh disable=SC2154

say() { printf '%s: %s\n' "$script" "$*"; }
die() {
    say "$*" >&2
    exit 1
}

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=${WORK:-$root/target/fortran}
release=${BUILT:-$root/target/release}
runner=${RUNNER:-}
fc=${FC:-gfortran}
flags="-O1 -Wall -Werror -ffpe-trap=invalid,zero,overflow"

shared_library=libsignorini.so
libraries="-lm -lpthread -ldl"
if [ -f "$release/signorini.dll" ]; then
    shared_library=signorini.dll
    # gfortran's own libraries go into the program.
    flags="$flags -static"
    libraries="-lkernel32 -lntdll -luserenv -lws2_32 -ldbghelp"
fi
[ -f "$release/libsignorini.a" ] && [ -f "$release/$shared_library" ] ||
    die "no library in $release: cargo build --release"
mkdir -p "$work"
cp "$release/$shared_library" "$work/$shared_library.$$"
mv -f "$work/$shared_library.$$" "$work/$shared_library"
soname=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' "$root/Cargo.toml")
[ "$shared_library" = signorini.dll ] || ln -sf libsignorini.so "$work/libsignorini.so.$soname"

# compile NAME static|shared OPTION... SOURCE...
compile() (
    name=$1
    kind=$2
    shift 2
    # Modules of two programs that are built with other options must not meet: gfortran looks for
    # them where it runs before it looks elsewhere.
    mkdir -p "$work/$name.mod"
    cd "$work/$name.mod"
    case $kind in
    # shellcheck disable=SC2086 # several options
    static) set -- "$@" "$release/libsignorini.a" $libraries ;;
    # shellcheck disable=SC2016 # the linker's own variable
    shared) set -- "$@" "$work/$shared_library" '-Wl,-rpath,$ORIGIN' ;;
    esac
    # shellcheck disable=SC2086 # several options
    "$fc" $flags -J"$work/$name.mod" -I"$root/include" "$@" -o "$work/$name"
)

# run NAME: a program that has been compiled.
run() {
    program=$work/$1
    [ ! -f "$program.exe" ] || program=$program.exe
    if [ -n "$runner" ]; then "$runner" "$program"; else "$program"; fi
}

# Runs a program that prints `node NUMBER STATE d_n d_t F_n F_t` and compares with the solution in
# c_examples/bar/bar_reference.h: largest difference relative to the largest value, at most 1e-9.
compare() {
    run "$1" >"$work/$1.out" || { cat "$work/$1.out"; die "$1 failed"; }
    awk -v name="$1" '
        function judge(what, off, largest) {
            printf "%s: %s off by %.1e of the largest (limit 1e-09)\n", name, what, off / largest
            if (!(off <= 1e-9 * largest)) failed = 1
        }
        function apart(a, b) { return a < b ? b - a : a - b }
        FNR == NR && /reference_d\[/ { part = "d"; line = 0; next }
        FNR == NR && /reference_F\[/ { part = "F"; line = 0; next }
        FNR == NR && /^};/ { part = "" }
        FNR == NR && part != "" {
            gsub(/[,{}]/, " "); line++
            wanted[part, line, 1] = $1 + 0; wanted[part, line, 2] = $2 + 0; lines[part] = line
        }
        FNR == NR { next }
        $1 == "node" {
            nodes++
            if (NF != 7) failed = 1
            open += $3 == 0; slip += $3 == 1; stick += $3 == 2
            for (k = 1; k <= 2; k++) {
                x = apart($(3 + k) + 0, wanted["d", nodes, k]); if (x > off_d) off_d = x
                x = apart(0, wanted["d", nodes, k]); if (x > most_d) most_d = x
                x = apart($(5 + k) + 0, wanted["F", nodes, k]); if (x > off_F) off_F = x
                x = apart(0, wanted["F", nodes, k]); if (x > most_F) most_F = x
            }
        }
        END {
            if (nodes != 33 || lines["d"] != 33 || lines["F"] != 33) {
                print name ": " nodes + 0 " nodes, " lines["d"] + 0 " references, not 33"
                exit 1
            }
            judge("displacements", off_d, most_d)
            judge("forces", off_F, most_F)
            print name ": " open + 0 " open, " slip + 0 " slip, " stick + 0 " stick"
            if (open != 3 || slip != 15 || stick != 15) failed = 1
            exit failed
        }' "$root/c_examples/bar/bar_reference.h" "$work/$1.out" || die "$1: not the bar's solution"
}
