#!/bin/sh
# Ctrl-C ends the example programs cleanly: the call is cancelled, files are complete or absent, a
# sentence says so, the status is 130. On a terminal a line of progress is shown, elsewhere none.
#
#     sh tests/interrupt.sh
#
# A terminal is made by `script` of util-linux; without it that part is skipped, and
# the test ends with 77. All goes to target/.
set -eu
LC_ALL=C
export LC_ALL

script=interrupt
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=c_examples/common/build.sh
. "$root/c_examples/common/build.sh"

check_tools
prepare
compile replay_problem files/replay_problem.c common/watch.c
compile bolted_junction junction/bolted_junction.c junction/junction_mesh.c \
    junction/junction_element.c junction/junction_output.c junction/junction_check.c \
    common/checks.c common/watch.c

folder=$build/interrupt.$$
mkdir -p "$folder/out"
pid=
# Leaves no program behind.
clean() {
    [ -z "$pid" ] || kill -KILL "$pid" 2>/dev/null || :
    rm -rf "$folder"
}
trap clean EXIT
trap 'exit 1' HUP INT TERM

# A beam of 600 pairs that bends far until it meets the obstacle: many seconds of Gauss-Seidel.
awk 'BEGIN {
    n = 1200
    print "%%MatrixMarket matrix array real general\n% signorini problem 1"
    print "% kind: coulomb\n% dim: 2\n% pairs: 600\n" n, n + 4
    split("6 -4 1", beam)
    for (j = 0; j < n; j++)
        for (i = 0; i < n; i++) {
            apart = i > j ? i - j : j - i
            if (j % 2) print (i == j ? 1 : 0)
            else print (apart % 2 || apart > 4 ? 0 : beam[apart / 2 + 1])
        }
    for (i = 0; i < n; i++) print (i % 2 ? 0 : 1)
    for (i = 0; i < n; i++) print (i % 2 ? 0 : 1e6)
    for (i = 0; i < n; i++) print (i % 2 ? 0 : 0.5)
    for (i = 0; i < n; i++) print 0
}' >"$folder/slow.mtx"

# Waits until a text stands in a file, half a minute at most.
await() {
    tries=0
    until grep -q "$1" "$2" 2>/dev/null; do
        tries=$((tries + 1))
        [ "$tries" -le 300 ] || die "'$1' did not appear in time"
        sleep 0.1
    done
}

# Looks at how the program `pid` ends after an interrupt.
ends() {
    status=0
    wait "$pid" || status=$?
    pid=
    [ "$status" -eq 130 ] || die "$1: the status is $status, not 130"
    grep -q '^interrupted by Ctrl-C' "$folder/err" || die "$1: no sentence on stderr"
}

# ---- a call is cancelled ----

"$build/replay_problem" "$folder/slow.mtx" nested >"$folder/log" 2>"$folder/err" &
pid=$!
await '^solving' "$folder/log"
sleep 0.3
kill -INT "$pid"
ends "a call"
grep -q '^status    3, cancelled' "$folder/log" || die "the call was not cancelled"
[ "$(wc -l <"$folder/err")" -eq 1 ] || die "progress was shown where there is no terminal"
say "a call is cancelled"

# ---- a file that is being written becomes complete, later ones are absent ----

# The program waits at this file until somebody opens it, and again, as it holds more than a pipe
# does, until somebody reads.
mkfifo "$folder/out/bolted_junction.csv"
"$build/bolted_junction" "$folder/out" >"$folder/log" 2>"$folder/err" &
pid=$!
exec 3<"$folder/out/bolted_junction.csv"
kill -INT "$pid"
cat <&3 >"$folder/csv"
exec 3<&-
ends "a file"
# A line for each of 43 pairs in 6 steps for 5 coefficients, and the heading.
[ "$(wc -l <"$folder/csv")" -eq 1291 ] || die "the file that was being written is not complete"
[ "$(ls "$folder/out")" = bolted_junction.csv ] || die "files were begun after Ctrl-C"
say "a file that was begun is completed, no other is begun"

# ---- on a terminal ----

if script --version 2>/dev/null | grep -q util-linux; then
    # Ctrl-C as the terminal gives it.
    (
        await '^solving' "$folder/typescript"
        sleep 0.5
        printf '\003'
        sleep 1
    ) | SHELL=/bin/sh script -qefc "exec '$build/replay_problem' '$folder/slow.mtx' nested" \
        "$folder/typescript" >/dev/null && status=0 || status=$?
    [ "$status" -eq 130 ] || die "on a terminal: the status is $status, not 130"
    grep -q ' iterations, eta ' "$folder/typescript" || die "no progress on a terminal"
    grep -q 'interrupted by Ctrl-C' "$folder/typescript" || die "no sentence on a terminal"
    say "progress is shown on a terminal, and Ctrl-C heard"
else
    say "no 'script' of util-linux: terminals are not tested: SKIPPED"
    exit 77
fi
