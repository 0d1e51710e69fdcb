# CalculiX's report at the contact nodes against what the library expects:
#     awk -f compare.awk bar_forces.csv bar_static.dat
# RF has seven digits: the limit is one unit of the last one of the largest force.

FNR == NR { # node,direction,external force
    if (FNR > 1) {
        split($0, part, ",")
        expected[part[1], part[2]] = part[3]
        size = part[3] < 0 ? -part[3] : part[3]
        if (size > largest) largest = size
        count++
    }
    next
}

/^ forces/ { forces = 1; next }
/^ [a-z]/ { forces = 0 }

forces && NF == 4 {
    for (direction = 1; direction <= 2; direction++) {
        if (!(($1, direction) in expected)) continue
        difference = $(direction + 1) - expected[$1, direction]
        if (difference < 0) difference = -difference
        if (difference > worst) worst = difference
        compared++
    }
}

END {
    for (unit = 1e-6; unit * 1e7 <= largest; unit *= 10) {}
    passed = compared == count && count > 0 && worst <= unit
    printf "  %s  CalculiX's own forces at %d of %d degrees of freedom: within %.1e of %.2f\n",
        passed ? "PASS" : "FAIL", compared, count, worst, largest
    exit !passed
}
