# Compares two tables with a line of names: words and whole numbers are the same, other numbers differ by at most 1e-12
# of the largest of their column. Prints by how much they do.
function size(x) { return x < 0 ? -x : x }
{ sub(/\r$/, "") }
FNR == NR {
    for (k = 1; k <= NF; k++) {
        wanted[FNR, k] = $k
        if (FNR > 1 && size($k) > largest[k]) largest[k] = size($k)
    }
    lines = FNR
    next
}
{
    for (k = 1; k <= NF; k++) {
        if ($k == wanted[FNR, k]) continue
        off = largest[k] > 0 ? size($k - wanted[FNR, k]) / largest[k] : 1
        if ($k !~ /^[-+0-9.e]+$/ || $k !~ /[.e]/) off = 1
        if (off > worst) { worst = off; place = "line " FNR ", column " k ": " $k ", not " wanted[FNR, k] }
    }
}
END {
    if (FNR != lines) place = FNR " lines, not " lines
    if (worst > 1e-12 || FNR != lines) { print place; exit 1 }
    printf "%.0e\n", worst
}
