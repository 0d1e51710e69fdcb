#!/bin/sh
# The Python package over the library, and the scripts that draw with it.
#
#     sh tests/scripts.sh [--require]
#
# PYTHON names the Python, default python3. Without numpy it is skipped, or fails if --require is
# given; the pictures need matplotlib and PIL too. It ends with 77 if it skipped anything.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/scripts\ of\ python
python=${PYTHON:-python3}

if ! "$python" -c 'import numpy' >/dev/null 2>&1; then
    echo "scripts: '$python' has no numpy (python3 and python3-numpy in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "scripts: SKIPPED"
    exit 77
fi

command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
(cd "$root" && cargo build --quiet --release --locked --lib --target-dir "$root/target")
rm -rf -- "$work"
mkdir -p -- "$work"
touch -- "$work/began"
unset SIGNORINI_LIBRARY
for name in results shapes mistakes solutions operators progress surfaces meshes zones pickles equations sectors rings; do
    "$python" -B "$root/tests/python/$name.py"
done
for part in loaded_pin cylinder pin_in_lug shrink_fit dovetail bolted_plates; do
    echo "scripts: c_examples/parts/$part.py"
    "$python" -B "$root/c_examples/parts/$part.py" "$work"
    [ -s "$work/$part.vtu" ]
done
"$python" -B "$root/tests/python/files.py" "$work"
"$python" -B "$root/tests/python/library.py" "${CC:-cc}" "$work"
if "$python" -c 'import hypothesis' >/dev/null 2>&1; then
    HYPOTHESIS_STORAGE_DIRECTORY=$work/hypothesis "$python" -B "$root/tests/python/arrays.py"
else
    echo "scripts: '$python' has no hypothesis (python3-hypothesis in Debian): arrays of any kind SKIPPED"
    [ "${1-}" != --require ] || exit 1
fi

if ! "$python" -c 'import matplotlib, PIL' >/dev/null 2>&1; then
    echo "scripts: '$python' has no matplotlib (python3-matplotlib in Debian)"
    [ "${1-}" != --require ] || exit 1
    echo "scripts: pictures SKIPPED"
    exit 77
fi
"$python" -B "$root/tests/python/plots.py" "$work"
# Without the files to draw: one sentence that says what to run.
mkdir -- "$work/empty"
for pair in bar/bar_on_plane:replay junction/bolted_junction:junction 3d/hertz:3d; do
    script=$root/c_examples/${pair%:*}.py
    [ -x "$script" ] || { echo "scripts: $script cannot be run as a command"; exit 1; }
    if "$python" "$script" "$work/empty" >"$work/said" 2>&1; then
        echo "scripts: $script needs no files"
        exit 1
    fi
    [ "$(wc -l <"$work/said")" -eq 1 ] || { cat "$work/said"; exit 1; }
    grep -q "run sh c_examples/${pair#*:}.sh .* first" "$work/said" || { cat "$work/said"; exit 1; }
done
sh "$root/c_examples/replay.sh" "$work/out" >"$work/replay.log" 2>&1 ||
    { cat "$work/replay.log"; exit 1; }
sh "$root/c_examples/junction.sh" "$work/out" >"$work/junction.log" 2>&1 ||
    { cat "$work/junction.log"; exit 1; }
sh "$root/c_examples/3d.sh" "$work/out" >"$work/3d.log" 2>&1 ||
    { cat "$work/3d.log"; exit 1; }
# From another directory: the scripts find the package and the library by their own place.
for script in bar/bar_on_plane junction/bolted_junction 3d/hertz; do
    (cd "$work" && "$python" "$root/c_examples/$script.py" out)
done
for picture in bar_on_plane bar_friction bolted_junction hertz; do
    [ -s "$work/out/$picture.png" ] || { echo "scripts: no picture $picture.png"; exit 1; }
done
[ -z "$(find "$root/c_examples" -name __pycache__ -newer "$work/began")" ] ||
    { echo "scripts: Python left files"; exit 1; }
echo "scripts: passed, pictures in $work/out"
