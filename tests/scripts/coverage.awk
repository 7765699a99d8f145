# SPDX-License-Identifier: MIT
# coverage.awk - from the .gcov files (gcov -b -c) of one header, -v name=HEADER, in many programs: what share of its lines and
# branches any of them reached, and which not.  See coverage.sh.
/^function/ { where = $2; next }
/^(call|unconditional)/ { next }
/^branch/ { # numbered along with the calls of the line; two to a condition, one to each case of a switch
    if (!((line, $2) in taken)) ways[line] = ways[line] " " $2
    taken[line, $2] += $3 == "taken" ? $4 : 0
    next
}
{
    split($0, field, ":")
    line = field[2] + 0
    count = field[1]
    gsub(/[ *]/, "", count)
    if (line == 0 || count == "-") next
    runs[line] += count ~ /^[0-9]/ ? count : 0
    text[line] = $0
    sub(/^[^:]*:[^:]*: */, "", text[line])
    function_of[line] = where
    if (line > last) last = line
}
END {
    for (line = 1; line <= last; line++) {
        if (!(line in text)) continue
        lines++
        if (runs[line] > 0) reached++
        count = split(ways[line], way, " ")
        missed = 0
        which = ""
        for (i = 1; i <= count; i++) {
            if (taken[line, way[i]] > 0) continue
            missed++
            which = which (text[line] ~ /switch/ ? " case " i : sprintf(" %d%s", (i + 1) / 2, i % 2 ? "a" : "b"))
        }
        branches += count
        walked += count - missed
        if (runs[line] > 0 && missed == 0) continue
        what = runs[line] > 0 ? missed " of " count " ways never taken:" which : "never reached"
        printf "%s:%d: %s: %s\n    %s\n", name, line, function_of[line], what, text[line]
    }
    printf "# %-10s lines: %d of %d never reached; branches: %.2f %% of %d taken\n", name,
        lines - reached, lines, branches ? 100 * walked / branches : 100, branches
}
