#!/bin/sh
# The guide in c_examples/guide is right: links lead somewhere, names are those of the headers, programs are the files
# that they are said to be and print what the guide says, functions compile and do what it says, and mdBook builds it.
#
#     sh tests/guide.sh [--require]
#
# Fortran, numpy and mdbook that are not there are skipped, and it ends with 77; with --require they fail, but for
# mdbook. MDBOOK names mdbook (cargo install mdbook).
set -eu
LC_ALL=C
export LC_ALL

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
work=$root/target/tests/guide
guide=c_examples/guide
headers="include/signorini.h include/signorini_surface.h include/signorini_file.h"
python=${PYTHON:-python3}
rm -rf "$work"
mkdir -p "$work"
cd "$root"
command -v cargo >/dev/null || PATH=$PATH:${CARGO_HOME:-${HOME:-/root}/.cargo}/bin
CARGO_TARGET_DIR=$root/target
CARGO_TERM_QUIET=true
PYTHONDONTWRITEBYTECODE=1 # nothing beside the sources
export CARGO_TARGET_DIR CARGO_TERM_QUIET PYTHONDONTWRITEBYTECODE
[ "${1-}" != --require ] || require=yes

say() { printf 'guide: %s\n' "$*"; }
die() {
    say "$*"
    exit 1
}
# skip WHAT WHY: with --require it fails.
skip() {
    say "$1: $2"
    [ "${require:-}" != yes ] || exit 1
    say "$1: SKIPPED"
    skipped=yes
}

# ---- links ----

# The anchors of a file: its headings in lower case, punctuation left out, blanks as dashes.
anchors() {
    awk '/^```/ { code = !code } !code && /^#+ / {
        sub(/^#+ /, ""); text = tolower($0); gsub(/[^a-z0-9 _-]/, "", text); gsub(/ /, "-", text); print text }' "$1"
}
# The places that a file links to, without those of the web.
links() {
    awk '/^```/ { code = !code } !code {
        while (match($0, /\]\([^)]*\)/)) { print substr($0, RSTART + 2, RLENGTH - 3); $0 = substr($0, RSTART + RLENGTH) } }' \
        "$1" | grep -v '^https\{0,1\}://' || true
}
count=0
for file in README.md CHANGELOG.md c_examples/*.md "$guide"/*.md; do
    for link in $(links "$file"); do
        place=${link%%#*}
        count=$((count + 1))
        target=$(dirname "$file")/$place
        [ -n "$place" ] || target=$file
        [ -e "$target" ] || die "$file: the link $link leads nowhere"
        case $link in
        *'#'*) anchors "$target" | grep -qx -- "${link#*#}" || die "$file: no heading for the link $link" ;;
        esac
        # So a link holds in the book too, which is built into target/guide; mdbook would make .html of .md.
        case $file:$place in
        "$guide"/*:..*.md) die "$file: the link $link out of the guide is no chapter: name the file in the text" ;;
        "$guide"/*:../../*) ;;
        "$guide"/*:*..*) die "$file: the link $link out of the guide must begin with ../../" ;;
        esac
    done
done
[ "$count" -gt 50 ] || die "only $count links found"
links "$guide/SUMMARY.md" | sort >"$work/listed"
(cd "$guide" && ls -- *.md) | grep -vx SUMMARY.md | sort >"$work/chapters"
diff "$work/chapters" "$work/listed" || die "SUMMARY.md does not list each chapter once"
for picture in "$guide"/drawings/*; do
    grep -q "drawings/$(basename "$picture")" "$guide"/*.md || die "no chapter shows $picture"
done
# Files of the clone that are named in the text, but for those that are made.
grep -ohE '`(sh )?(c_examples|tests|include|src)/[A-Za-z0-9_./*]*' "$guide"/*.md | sed 's/^`//; s/^sh //' | sort -u >"$work/paths"
while read -r place; do
    # shellcheck disable=SC2086 # a pattern
    ls -d $place >/dev/null 2>&1 || die "there is no $place"
done <"$work/paths"
say "$count links, $(wc -l <"$work/paths" | tr -d ' ') files, $(wc -l <"$work/chapters" | tr -d ' ') chapters"

# ---- names ----

# A name that ends in _ stands for a family of names.
grep -ohE '(signorini|SIGNORINI)_[A-Za-z0-9_]*' "$guide"/*.md | sort -u >"$work/names"
while read -r name; do
    case $name in
    signorini_bench* | SIGNORINI_LIBRARY) ;; # a program, a variable of the environment
    *_) grep -q "\\b$name" $headers || die "no name of the header begins with $name" ;;
    *) grep -qw -- "$name" $headers || die "the header has no $name" ;;
    esac
done <"$work/names"
# Fields of structures, as settings.search: a line of the structure ends with the name.
grep -ohE '\b(settings|report|extra)\.[A-Za-z_0-9]+' "$guide"/*.md | sort -u >"$work/fields"
while read -r field; do
    grep -qE "^    [a-z].*[ *]${field#*.}(\\[[0-9]+\\])?;" $headers || die "the header has no field $field"
done <"$work/fields"
say "$(wc -l <"$work/names" | tr -d ' ') names and $(wc -l <"$work/fields" | tr -d ' ') fields of the header"

# ---- programs that are shown ----

# shown FILE LANGUAGE: the block after the comment that names the file.
shown() {
    awk -v mark="<!-- $1 -->" -v open="\`\`\`$2" '$0 == mark { getline; inside = $0 == open; next }
        $0 == "```" { inside = 0 } inside' "$guide"/*.md
}
sed -n 's/^<!-- \(.*\) -->$/\1/p' "$guide"/*.md >"$work/files"
while read -r file; do
    case $file in
    *.c) language=c ;;
    *.f | *.f90) language=fortran ;;
    *) language=python ;;
    esac
    shown "$file" "$language" | diff - "$file" || die "what is shown as $file is another text"
done <"$work/files"
# At most thirty lines, but for comments and empty ones: what somebody reads first.
code() {
    case $1 in
    *.c) sed -e '/^ *\/\*.*\*\/$/d' -e '/^ *\/\*/,/\*\//d' "$1" ;;
    *.f) grep -v '^C' "$1" ;;
    *.f90) grep -v '^ *!' "$1" ;;
    *) sed '/^"""/,/^"""/d' "$1" | grep -v '^#' ;;
    esac
}
while read -r file; do
    lines=$(code "$file" | grep -c .)
    [ "$lines" -le 30 ] || die "$file has $lines lines of code"
done <"$work/files"
say "$(wc -l <"$work/files" | tr -d ' ') programs are the files that they are said to be"

# The commands of a language in the first chapter, as they stand.
grep '^F_n ' "$guide/first.md" >"$work/expected"
commands() {
    awk -v heading="## $1" '/^## / { here = $0 == heading } here && $0 == "```sh" { inside = 1; next }
        $0 == "```" { inside = 0 } inside' "$guide/first.md"
}
try() {
    if ! command -v "$2" >/dev/null || { [ "$1" = Python ] && ! "$2" -c 'import numpy' 2>/dev/null; }; then
        skip "the first example in $1" "'$2' is missing"
        return
    fi
    commands "$1" | sed "s|^python3 |'$python' |" >"$work/commands"
    [ -s "$work/commands" ] || die "no commands for $1"
    sh -e "$work/commands" >"$work/printed"
    diff "$work/expected" "$work/printed" || die "$1 prints something else"
    say "the first example in $1 prints what the guide says"
}
try C cc
try "Fortran 90" gfortran
try "Fortran 77" gfortran
try Python "$python"

# ---- functions ----

# Each block of a language that is no file goes into CHAPTER.h, .py or .f; a program calls what stands there.
functions() {
    for chapter in "$guide"/*.md; do
        name=$(basename "$chapter" .md)
        awk -v open="\`\`\`$1" 'shown && $0 == open { shown = 0; next } { shown = /^<!-- / }
            $0 == open { inside = 1; next } $0 == "```" { inside = 0 } inside' "$chapter" >"$work/$name.$2"
        [ -s "$work/$name.$2" ] || { rm "$work/$name.$2"; continue; }
        # shellcheck disable=SC2086 # several files
        grep -q "$name$3" $4 || die "$4 does not call what $chapter shows"
    done
}
functions c h '\.h"' "tests/c/guide.c tests/c/questions.c"
functions python py '' tests/python/guide.py
functions fortran f '\.f' tests/fortran/guide.f
flags="-std=c11 -Wall -Wextra -Wpedantic -Werror -Iinclude"
for program in guide questions; do
    # shellcheck disable=SC2086 # several flags
    ${CC:-cc} $flags -Itests/c -I"$work" "tests/c/$program.c" target/release/libsignorini.a \
        -lm -lpthread -ldl -o "$work/$program"
    "$work/$program"
done
if "$python" -c 'import numpy' 2>/dev/null; then
    "$python" -B tests/python/guide.py "$work"
    # Beside its mesh and matrix a host has 15 lines at most, and friction holds the twist: statics.
    two_meshes=c_examples/3d/two_meshes.py
    [ "$(code "$two_meshes" | grep -c .)" -le 15 ] || die "$two_meshes is too long"
    (cd "$work" && PYTHONPATH=$root/c_examples/3d:$root/c_examples/python "$python" -B "$root/$two_meshes") >"$work/printed"
    awk '$2 + 0 != $7 + 0 { wrong = 1 } END { exit wrong || NR != 5 }' "$work/printed" || { cat "$work/printed"; die "$two_meshes"; }
    [ -s "$work/two_meshes.vtu" ] || die "$two_meshes has written no file"
    say "$two_meshes: friction holds the twist in $(wc -l <"$work/printed" | tr -d ' ') steps"
else
    skip "Python" "'$python' has no numpy (python3-numpy in Debian)"
fi
if command -v gfortran >/dev/null; then
    gfortran -std=legacy -Wall -Werror -fimplicit-none -Iinclude -I"$work" tests/fortran/guide.f target/release/libsignorini.a \
        -lm -lpthread -ldl -o "$work/guide_f"
    "$work/guide_f"
else
    skip "Fortran 77" "'gfortran' is missing"
fi

# ---- the book ----

mdbook=${MDBOOK:-mdbook}
if command -v "$mdbook" >/dev/null; then
    "$mdbook" build "$guide" -d "$root/target/guide" >"$work/log" 2>&1 || { cat "$work/log"; die "mdbook fails"; }
    grep -iE 'warn|error' "$work/log" && die "mdbook warns"
    while read -r chapter; do
        page=$root/target/guide/${chapter%.md}.html
        [ "$chapter" != README.md ] || page=$root/target/guide/index.html
        [ -s "$page" ] || die "mdbook has made no $page"
        # Links of the page to places beside it or in the clone; search and fonts are mdbook's own.
        for link in $(grep -oE '(href|src)="[^"#:]+\.(html|svg|md|h|c|f90)[^":]*"' "$page" | sed 's/^[a-z]*="//; s/"$//; s/#.*//'); do
            [ -e "$root/target/guide/$link" ] || die "$page: $link leads nowhere"
        done
    done <"$work/chapters"
    say "mdbook: target/guide/index.html"
else
    say "the book: SKIPPED: mdbook is not installed (cargo install mdbook)"
    skipped=yes
fi
[ "${skipped:-}" != yes ] || exit 77
