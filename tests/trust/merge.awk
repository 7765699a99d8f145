# SPDX-License-Identifier: MIT
# merge.awk - from the .gcov files (gcov -b -c) of one header in many programs: what share of its lines and branches any of
# them reached, and which not.  -v name=HEADER; with -v brief=1 the shares alone.
/^branch/ {
    key = line SUBSEP $2
    branches[line] = $2 + 1 > branches[line] ? $2 + 1 : branches[line]
    taken[key] += $3 == "taken" ? $4 : 0
    next
}
/^(call|function|unconditional)/ { next }
{
    split($0, field, ":")
    line = field[2] + 0
    count = field[1]
    gsub(/[ *]/, "", count)
    if (line == 0 || count == "-") next
    runs[line] += count ~ /^[0-9]/ ? count : 0
    text[line] = substr($0, index($0, ":") + 1)
    sub(/^[^:]*: */, "", text[line])
    if (line > last) last = line
}
END {
    for (line = 1; line <= last; line++) {
        if (!(line in text)) continue
        lines++
        if (runs[line] == 0) report = report sprintf("%s:%d: never reached: %s\n", name, line, text[line])
        else reached++
        missing = ""
        for (b = 0; b < branches[line]; b++) {
            all++
            if (taken[line, b] > 0) ways++
            else missing = missing " " b
        }
        if (runs[line] > 0 && missing != "")
            report = report sprintf("%s:%d: of %d branches not taken:%s: %s\n", name, line, branches[line], missing, text[line])
    }
    printf "%-10s  lines %6.2f %% of %d   branches %6.2f %% of %d\n", name, 100 * reached / lines, lines, 100 * ways / all, all
    if (!brief) printf "%s", report
}
