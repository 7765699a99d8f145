#!/bin/sh
# SPDX-License-Identifier: MIT
# size.sh - text size and compile time of each header, beside version 0.1.0 (from the history where this is a clone, else as
# recorded with gcc 12 on x86-64).  Compile time is processor time, the least of three.  Appends goals to $BENCH_NOTES/goals.
set -u
cc=${CC:-cc}
old=8914c22 # the last of 0.1.0
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/new" "$dir/old"

measure() { # measure FOLDER HEADER PREFIX: bytes of text and of data, seconds
    printf '#define %s_IMPLEMENTATION\n#include "%s"\n' "$3" "$2" >"$1/a.c"
    least=
    for k in 1 2 3; do
        { TIMEFORMAT='%U'; time -p $cc -std=c99 -O2 -c -I"$1" -o "$1/a.o" "$1/a.c"; } 2>"$1/time" || return 1
        least="$least $(awk '$1 == "user" { print $2 }' "$1/time")"
    done
    size "$1/a.o" | awk -v t="$least" 'NR == 2 { n = split(t, s); m = s[1]; for (i = 2; i <= n; i++) if (s[i] < m) m = s[i]
        print $1, $2, m }'
}

command -v size >/dev/null || { echo 'text size: no size (Debian: binutils)'; exit 0; }
echo
echo "text and data in KB, compile time in seconds, $cc -O2, beside 0.1.0:"
printf '%-12s %8s %8s %7s %7s   ratio of text, of time\n' header KB before s before
for h in waveform:WF:36.6:1.9 iqn:IQN:47.4:2.1 rk:RK:79.0:2.6; do
    IFS=: read -r name prefix kb seconds <<HERE
$h
HERE
    cp "$name.h" "$dir/new"
    now=$(measure "$dir/new" "$name.h" "$prefix")
    if git show "$old:$name.h" >"$dir/old/$name.h" 2>/dev/null; then then=$(measure "$dir/old" "$name.h" "$prefix"); from='in this run'
    else then=$(echo "$kb $seconds" | awk '{ print $1 * 1000, 0, $2 }'); from='recorded'; fi
    echo "$now $then" | awk -v name="$name.h" -v from="$from" -v notes="${BENCH_NOTES:-}" '{
        kb = ($1 + $2) / 1000; was = ($4 + $5) / 1000
        printf "%-12s %8.1f %8.1f %7.2f %7.2f   %.2f %.2f (%s)\n", name, kb, was, $3, $6, kb / was, $3 / $6, from
        if (notes != "") {
            printf "text and data of %s, / 0.1.0\t%.3g\t1.25\n", name, kb / was >>(notes "/goals")
            printf "compile time of %s, / 0.1.0\t%.3g\t1.25\n", name, $3 / $6 >>(notes "/goals")
            printf "size %s\t%.1f\t%.1f\n", name, kb, was >>(notes "/rows")
            printf "compile %s\t%.2f\t%.2f\n", name, $3, $6 >>(notes "/rows")
        } }'
done
