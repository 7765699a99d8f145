#!/bin/sh
# SPDX-License-Identifier: MIT
# size.sh - text size and compile time of each header, beside version 0.1.0 (from the history where this is a clone, else as
# recorded with gcc 12 on x86-64), and beside the headers in the folder BENCH_OLD.  Compile time is processor time; both versions
# are compiled in turn, seven times, and the ratio is the median of the seven: other jobs then slow both alike.  Appends goals to
# $BENCH_NOTES/goals.
set -u
cc=${CC:-cc}
first=8914c22 # the last of 0.1.0
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/new" "$dir/old"

compile() { # compile FOLDER: seconds of processor time
    { time -p $cc -std=c99 -O2 -c -I"$1" -o "$1/a.o" "$1/a.c"; } 2>"$1/time" || return 1
    awk '$1 == "user" { print $2 }' "$1/time"
}
what='text and data'
bytes() { size "$1/a.o" | awk -v what="$what" 'NR == 2 { print what == "text" ? $1 : $1 + $2 }'; }
median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# row NAME PREFIX VERSION TEXT TIME [KB SECONDS]: beside $dir/old, with goals for both ratios; KB, SECONDS: as recorded, where it is not there
row() {
    from='in this run'
    [ -s "$dir/old/$1.h" ] || from=recorded
    cp "$1.h" "$dir/new"
    for f in new old; do printf '#define %s_IMPLEMENTATION\n#include "%s.h"\n' "$2" "$1" >"$dir/$f/a.c"; done
    for k in 1 2 3 4 5 6 7; do
        t=${7:-}
        [ "$from" = recorded ] || t=$(compile "$dir/old")
        echo "$(compile "$dir/new") $t"
    done >"$dir/times"
    was=$(awk -v kb="${6:-}" 'BEGIN { print 1000 * kb }')
    [ "$from" = recorded ] || was=$(bytes "$dir/old")
    s=$(awk '{ print $1 }' "$dir/times" | median) t=$(awk '{ print $2 }' "$dir/times" | median)
    ratio=$(awk '{ print $1 / $2 }' "$dir/times" | median)
    echo "$(bytes "$dir/new") $was $s $t $ratio" | awk -v name="$1.h" -v version="$3" -v text="$4" -v time="$5" -v from="$from" -v what="$what" -v notes="${BENCH_NOTES:-}" '{
        kb = $1 / 1000; was = $2 / 1000
        printf "%-12s %8.1f %8.1f %7.2f %7.2f   %.3f %.3f (%s)\n", name, kb, was, $3, $4, kb / was, $5, from
        if (notes != "") {
            printf "%s of %s, / %s\t%.4g\t%s\n", what, name, version, kb / was, text >>(notes "/goals")
            printf "compile time of %s, / %s\t%.3g\t%s\n", name, version, $5, time >>(notes "/goals")
            printf "size %s%s\t%.1f\t%.1f\n", name, version == "0.1.0" ? "" : " " version, kb, was >>(notes "/rows")
            printf "compile %s%s\t%.2f\t%.2f\n", name, version == "0.1.0" ? "" : " " version, $3, $4 >>(notes "/rows")
        } }'
}

head() { printf '\n%s in KB, compile time in seconds, %s -O2, beside %s:\n%-12s %8s %8s %7s %7s   ratio of text, of time\n' "$what" "$cc" "$1" header KB before s before; }

command -v size >/dev/null || { echo 'text size: no size (Debian: binutils)'; exit 0; }
head 0.1.0
for h in waveform:WF:36.6:1.9 iqn:IQN:47.4:2.1 rk:RK:79.0:2.6; do
    IFS=: read -r name prefix kb seconds <<HERE
$h
HERE
    git show "$first:$name.h" >"$dir/old/$name.h" 2>/dev/null
    row "$name" "$prefix" 0.1.0 1.25 1.25 "$kb" "$seconds"
done
[ "${BENCH_OLD:-}" ] || exit 0
what=text
head "$BENCH_OLD"
for h in waveform:WF iqn:IQN rk:RK; do
    cp "$BENCH_OLD/${h%:*}.h" "$dir/old" && row "${h%:*}" "${h#*:}" "the other" 1.05 1.05
done
