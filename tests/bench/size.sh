#!/bin/sh
# SPDX-License-Identifier: MIT
# size.sh - text size and compile time of each header, beside version 0.1.0 (from the history where this is a clone, else as
# recorded with gcc 12 on x86-64).  Compile time is processor time; both versions are compiled in turn, seven times, and the
# ratio is the median of the seven: other jobs then slow both alike.  Appends goals to $BENCH_NOTES/goals.
set -u
cc=${CC:-cc}
old=8914c22 # the last of 0.1.0
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/new" "$dir/old"

compile() { # compile FOLDER: seconds of processor time
    { time -p $cc -std=c99 -O2 -c -I"$1" -o "$1/a.o" "$1/a.c"; } 2>"$1/time" || return 1
    awk '$1 == "user" { print $2 }' "$1/time"
}
bytes() { size "$1/a.o" | awk 'NR == 2 { print $1 + $2 }'; } # of text and of data
median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

command -v size >/dev/null || { echo 'text size: no size (Debian: binutils)'; exit 0; }
echo
echo "text and data in KB, compile time in seconds, $cc -O2, beside 0.1.0:"
printf '%-12s %8s %8s %7s %7s   ratio of text, of time\n' header KB before s before
for h in waveform:WF:36.6:1.9 iqn:IQN:47.4:2.1 rk:RK:79.0:2.6; do
    IFS=: read -r name prefix kb seconds <<HERE
$h
HERE
    cp "$name.h" "$dir/new"
    from='in this run'
    git show "$old:$name.h" >"$dir/old/$name.h" 2>/dev/null || from=recorded
    for f in new old; do printf '#define %s_IMPLEMENTATION\n#include "%s.h"\n' "$prefix" "$name" >"$dir/$f/a.c"; done
    for k in 1 2 3 4 5 6 7; do
        t=$seconds
        [ "$from" = recorded ] || t=$(compile "$dir/old")
        echo "$(compile "$dir/new") $t"
    done >"$dir/times"
    was=$(awk -v kb="$kb" 'BEGIN { print 1000 * kb }')
    [ "$from" = recorded ] || was=$(bytes "$dir/old")
    s=$(awk '{ print $1 }' "$dir/times" | median) t=$(awk '{ print $2 }' "$dir/times" | median)
    ratio=$(awk '{ print $1 / $2 }' "$dir/times" | median)
    echo "$(bytes "$dir/new") $was $s $t $ratio" | awk -v name="$name.h" -v from="$from" -v notes="${BENCH_NOTES:-}" '{
        kb = $1 / 1000; was = $2 / 1000
        printf "%-12s %8.1f %8.1f %7.2f %7.2f   %.2f %.2f (%s)\n", name, kb, was, $3, $4, kb / was, $5, from
        if (notes != "") {
            printf "text and data of %s, / 0.1.0\t%.3g\t1.25\n", name, kb / was >>(notes "/goals")
            printf "compile time of %s, / 0.1.0\t%.3g\t1.25\n", name, $5 >>(notes "/goals")
            printf "size %s\t%.1f\t%.1f\n", name, kb, was >>(notes "/rows")
            printf "compile %s\t%.2f\t%.2f\n", name, $3, $4 >>(notes "/rows")
        } }'
done
