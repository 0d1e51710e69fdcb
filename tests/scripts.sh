#!/bin/sh
# The Python module over the library, signorini.py, and the scripts that draw with it.
#
#     sh tests/scripts.sh [--require]
#
# PYTHON names the Python, default python3. Without numpy it is skipped, or fails if --require is
# given; the pictures need matplotlib and PIL too.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/scripts\ of\ python
python=${PYTHON:-python3}

if ! "$python" -c 'import numpy' >/dev/null 2>&1; then
    echo "scripts: '$python' has no numpy (python3 and python3-numpy in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "scripts: SKIPPED"
    exit 0
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
rm -rf -- "$work"
mkdir -p -- "$work"
unset SIGNORINI_LIBRARY
"$python" -B "$root/tests/python/results.py"
"$python" -B "$root/tests/python/progress.py"
"$python" -B "$root/tests/python/library.py" "${CC:-cc}" "$work"

if ! "$python" -c 'import matplotlib, PIL' >/dev/null 2>&1; then
    echo "scripts: '$python' has no matplotlib (python3-matplotlib in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "scripts: pictures SKIPPED"
    exit 0
fi
sh "$root/c_examples/replay.sh" "$work/out" >"$work/replay.log" 2>&1 ||
    { cat "$work/replay.log"; exit 1; }
sh "$root/c_examples/junction.sh" "$work/out" >"$work/junction.log" 2>&1 ||
    { cat "$work/junction.log"; exit 1; }
for script in bar_on_plane bolted_junction; do
    "$python" "$root/c_examples/$script.py" "$work/out"
done
for picture in bar_on_plane bar_friction bolted_junction; do
    [ -s "$work/out/$picture.png" ] || { echo "scripts: no picture $picture.png"; exit 1; }
done
[ ! -e "$root/c_examples/__pycache__" ] || { echo "scripts: Python left files"; exit 1; }
echo "scripts: passed, pictures in $work/out"
