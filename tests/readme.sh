#!/bin/sh
# The README is right: the commands from a clone to a program run as they stand and print what the
# README says, with -static too where that can be; the C example is the file.
#
#     sh tests/readme.sh [--require]
#
# Languages that are not there are skipped, and it ends with 77; with --require they fail.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/readme
python=${PYTHON:-python3}
rm -rf "$work"
mkdir -p "$work"
cd "$root"
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
CARGO_TARGET_DIR=$root/target
CARGO_TERM_QUIET=true
PYTHONDONTWRITEBYTECODE=1 # nothing beside the sources
export CARGO_TARGET_DIR CARGO_TERM_QUIET PYTHONDONTWRITEBYTECODE

grep '^pair ' README.md >"$work/expected"
[ -s "$work/expected" ]
first=c_examples/first/first.c
awk '$0 == "```c" { inside = 1; next } $0 == "```" { inside = 0 } inside' README.md |
    diff - "$first" || { echo "README: its C example is not $first"; exit 1; }
[ "$(grep -c . "$first")" -le 32 ] || { echo "README: its example is too long"; exit 1; }

# The commands of a language: the block that begins with its name.
commands() {
    awk -v name="# $1" '$0 == "```sh" { getline; inside = index($0, name) == 1; next }
        $0 == "```" { inside = 0 } inside' README.md
}

# Succeeds if the C library has a static form.
can_be_static() {
    echo 'int main(void) { return 0; }' >"$work/empty.c"
    ${CC:-cc} -static "$work/empty.c" -o "$work/empty" 2>/dev/null
}

# try LANGUAGE TOOL: the commands as they stand, then with -static.
try() {
    if ! command -v "$2" >/dev/null || { [ "$1" = Python ] && ! "$2" -c 'import numpy' 2>/dev/null; }
    then
        echo "README, $1: '$2' is missing"
        [ "${require:-}" != yes ] || exit 1
        echo "README, $1: SKIPPED"
        skipped=yes
        return
    fi
    commands "$1" >"$work/commands"
    lines=$(grep -c . "$work/commands")
    [ "$lines" -ge 2 ] && [ "$lines" -le 3 ] || { echo "README, $1: $lines commands"; exit 1; }
    sed "s|^python3 |'$python' |" "$work/commands" >"$work/as_they_stand"
    sh -e "$work/as_they_stand" >"$work/printed"
    diff "$work/expected" "$work/printed"
    echo "README, $1: prints what the README says"
    if [ "$1" != Python ] && can_be_static; then
        sed 's/ -o target/ -static&/' "$work/commands" >"$work/static"
        sh -e "$work/static" >"$work/printed" 2>"$work/warnings" ||
            { cat "$work/warnings"; exit 1; }
        diff "$work/expected" "$work/printed"
        echo "README, $1: the same with -static"
    fi
}

[ "${1-}" != --require ] || require=yes
try C cc
try "Fortran 77" gfortran
try "Fortran 90" gfortran
try Python "$python"

# The README's numpy block, as it stands.
if "$python" -c 'import numpy' 2>/dev/null; then
    awk '$0 == "```python" { inside = 1; next } $0 == "```" { inside = 0 } inside' README.md \
        >"$work/block.py"
    PYTHONPATH=$root/c_examples/bar:$root/c_examples/python "$python" "$work/block.py" \
        >"$work/printed"
    grep -q '^solved' "$work/printed"
    echo "README, the bar in numpy: $(head -n 1 "$work/printed" | cut -c 1-30)"
fi
[ "${skipped:-}" != yes ] || exit 77
