#!/bin/sh
# The binary interface against that of the first header of this ABI, tests/c/older_header.h: every function is
# still there with its types, and structures have grown at their ends only. Both headers become libraries with
# debugging information, which abidiff compares. That the library is what the headers say, tests/sources/header.rs
# and tests/c/layout.c see to.
#
#     sh tests/abi.sh [--require]
#
# Without abidiff (Debian: abigail-tools) it is skipped and ends with 77; with --require it fails.
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/abi
cc=${CC:-cc}
if ! command -v abidiff >/dev/null 2>&1; then
    echo "abi: SKIPPED: abidiff is not installed (Debian: abigail-tools)"
    [ "${1:-}" != --require ] || exit 1
    exit 77
fi
mkdir -p "$work"

# A library of the functions that a header declares, each with an empty body.
library() {
    awk '/^typedef/ { type = 1 }
        { if (!type) sub(/\);$/, ") { __builtin_trap(); }"); print }
        /;$/ { type = 0 }' "$2" >"$work/$1.c"
    # shellcheck disable=SC2086 # options in CC
    $cc -g -shared -fPIC -w -fno-eliminate-unused-debug-types -o "$work/$1.so" "$work/$1.c"
}

# Structures begin with their size: later versions add fields at the end.
printf '[suppress_type]\n  name_regexp = ^signorini_\n  has_data_member_inserted_at = end\n' \
    >"$work/allowed"
# The places of the fields that programs of then know, as a header has them.
places() {
    {
        echo '#include <stddef.h>'
        echo '#include <stdio.h>'
        echo "#include \"$2\""
        echo 'int main(void) {'
        sed 's/\/\*.*//' "$root/tests/c/older_header.h" | awk '
            /^struct [a-z_]* \{/ { name = $2 }
            /^};/ { name = "" }
            name != "" && /;$/ {
                field = $NF
                gsub(/[;*]/, "", field)
                printf "printf(\"%s.%s %%zu %%zu\\n\", offsetof(struct %s, %s), sizeof ((struct %s *)0)->%s);\n",
                    name, field, name, field, name, field
            }'
        echo 'return 0; }'
    } >"$work/$1.places.c"
    # shellcheck disable=SC2086
    $cc -w -o "$work/$1.places" "$work/$1.places.c"
    "$work/$1.places" >"$work/$1.places.txt"
    [ -s "$work/$1.places.txt" ]
}

# compare NAME HEADER: whether nothing breaks a program. Added functions are no break. That a type has grown at its
# end hides from abidiff what else became of it, so the places of fields are compared beside.
compare() {
    library "$1" "$2"
    abidiff --suppressions "$work/allowed" --no-added-syms "$work/then.so" "$work/$1.so" \
        >"$work/$1.log" 2>&1 || return 1
    places "$1" "$2" && diff "$work/then.places.txt" "$work/$1.places.txt" >>"$work/$1.log"
}

# The headers of now as one; what stands behind SIGNORINI_UNSTABLE is not held.
for name in signorini signorini_surface signorini_file; do
    grep -v '#include "signorini.h"' "$root/include/$name.h"
done >"$work/headers.h"

library then "$root/tests/c/older_header.h"
places then "$root/tests/c/older_header.h"
compare now "$work/headers.h" || { cat "$work/now.log"; echo "abi: programs that are already built break"; exit 1; }

# It sees breaks: a field in the middle, another type of an argument, a function that is gone.
broken() {
    sed "$2" "$work/headers.h" >"$work/$1.h"
    cmp -s "$work/$1.h" "$work/headers.h" && { echo "abi: nothing to break: $1"; exit 1; }
    if compare "$1" "$work/$1.h"; then
        echo "abi: a break is not seen: $1"
        exit 1
    fi
}
broken field 's/^    double tolerance;/    double before; double tolerance;/'
broken argument 's/^int32_t signorini_solve(int32_t dim, int64_t pairs/int32_t signorini_solve(int32_t dim, int32_t pairs/'
broken function 's/^int32_t signorini_abi_version(void);//'
echo "abi: $(grep -c '__builtin_trap' "$work/then.c") functions and \
$(wc -l <"$work/then.places.txt" | tr -d ' ') fields of the first header are as they were"
