#!/bin/sh
# Lines of src that the tests run: of all, and of each file with less than 90 %.
#
#     sh tests/coverage.sh
#
# Needs the tools of LLVM that belong to the compiler (rustup component add llvm-tools), a C compiler, and for the
# entries of Fortran gfortran. The Rust tests, the C regression and the Fortran programs run with an instrumented
# library in target/coverage; campaigns are short. It takes as long as a build of all tests.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/coverage
cd -- "$root"
die() {
    echo "coverage: $*" >&2
    exit 1
}
tools=$(dirname -- "$(find "$(rustc --print sysroot)" -name llvm-profdata | head -n 1)")
[ -x "$tools/llvm-cov" ] || die "no llvm-cov: rustup component add llvm-tools"
rm -rf -- "$work/profiles"
mkdir -p -- "$work/profiles" "$work/programs"
: >"$work/lines"

# The crate and its tests are instrumented, what they depend on is not.
cat >"$work/wrapper" <<'END'
#!/bin/sh
exec "$@" -Cinstrument-coverage
END
chmod 755 "$work/wrapper"
export RUSTC_WORKSPACE_WRAPPER="$work/wrapper" CARGO_TARGET_DIR="$work"
export SIGNORINI_PROPERTY_CASES=20 SIGNORINI_FAR_GAPS=200

# Programs that run from now on leave their profiles in a directory.
profiles_in() {
    mkdir -p -- "$1"
    LLVM_PROFILE_FILE=$1/%8m.profraw
    export LLVM_PROFILE_FILE
}

# Adds what a program or library has run by the profiles of a directory. Each is read by itself: two programs hold
# the same function in different forms, whose counts do not add.
add_lines() {
    "$tools/llvm-profdata" merge -sparse "$1"/*.profraw -o "$1/merged" 2>/dev/null
    "$tools/llvm-cov" export --format=lcov --instr-profile "$1/merged" "$2" 2>/dev/null |
        grep -E '^(SF|DA):' >>"$work/lines"
}

# ---- Rust ----

profiles_in "$work/profiles/build"
cargo test --release --locked --no-run --message-format=json >"$work/built.json"
sed -n 's/.*"executable":"\([^"]*\)".*/\1/p' "$work/built.json" | sort -u >"$work/tests"
while read -r test; do
    # Rules about the source, which run nothing of it.
    case ${test##*/} in sources-*) continue ;; esac
    profiles_in "$work/profiles/${test##*/}"
    CARGO_MANIFEST_DIR=$root "$test" --quiet >"$work/said" 2>&1 || { cat "$work/said"; die "$test failed"; }
    add_lines "$work/profiles/${test##*/}" "$test"
done <"$work/tests"

# ---- C, and Fortran's entries ----

release=$work/release
profiles_in "$work/profiles/build"
cargo build --release --locked --lib
profiles_in "$work/profiles/programs"
soname=$(sed -n '/^version = /{s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p;q;}' Cargo.toml)
ln -sf libsignorini.so "$release/libsignorini.so.$soname"
cd -- "$work/programs"

# runs NAME COMMAND...: builds a program by the rest of the command, and runs it.
runs() {
    name=$1
    shift
    "$@" -o "$name" -L"$release" -lsignorini -Wl,-rpath,"$release" -lm -lpthread -ldl ||
        die "$name cannot be built"
    "./$name" >"$name.out" 2>&1 || { cat "$name.out"; die "$name failed"; }
}

bricks="$root/c_examples/3d/brick_mesh.c $root/c_examples/3d/brick_element.c"
for name in bad_input valid_input methods layout model model_checks operator rows flexibility flexibility_sparse piles \
    environment threads reduction_threads problem_file older_program older_structures fortran_entries mesh_fields \
    memory_told; do
    runs "$name" "${CC:-cc}" -O1 -I"$root/include" "$root/tests/c/$name.c"
done
for name in surfaces out_of_memory processes faults; do
    # shellcheck disable=SC2086 # several sources
    runs "$name" "${CC:-cc}" -O1 -I"$root/include" "$root/tests/c/$name.c" $bricks
done
if command -v "${FC:-gfortran}" >/dev/null 2>&1; then
    module=$root/include/signorini.f90
    for name in bad_input two_blocks; do
        runs "${name}_77" "${FC:-gfortran}" -I"$root/include" "$root/tests/fortran/$name.f"
    done
    for name in layer refusals mistakes counting rows surfaces operator; do
        runs "${name}_90" "${FC:-gfortran}" -I"$root/include" "$module" "$root/tests/fortran/$name.f90"
    done
else
    echo "coverage: no Fortran compiler: its entries are counted by the other programs alone"
fi

# ---- the table ----

add_lines "$work/profiles/programs" "$release/libsignorini.so"
awk -v root="$root/src/" '
    /^SF:/ { file = substr($0, 4); next }
    index(file, root) == 1 {
        split(substr($0, 4), part, ",")
        line = file ":" part[1]
        if (!(line in seen)) { seen[line]; count[file]++; all++ }
        if (part[2] > 0 && !(line in reached)) { reached[line]; covered[file]++; run++ }
    }
    END {
        for (name in count)
            if (covered[name] < 0.9 * count[name])
                printf "%5.1f %% of %4d lines  %s\n", 100 * covered[name] / count[name], count[name], \
                    substr(name, length(root) - 3) | "sort -n"
        close("sort -n")
        printf "%5.1f %% of %d lines of src\n", 100 * run / all, all
    }' "$work/lines"
