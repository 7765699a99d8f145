#!/bin/sh
# SPDX-License-Identifier: MIT
# table.sh - build/table on tableaus of the literature that rk.h does not store, beside their published properties; a
# published misprint and some public ones; wrong input; the C text that it prints, compiled and run.  Prints TAP; reads B, CC.
set -u
B=${B:-build}
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
tables=$top/tests/tables
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
count=0

report() { # report STATUS NAME
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else
        echo "not ok $count - $2"
        sed 's/^/# /' "$dir/out" | head -20
    fi
}
table() { "$B/table" --svg "$dir/out.svg" "$@" >"$dir/out" 2>&1; }

# says FILE NAME LINE...: every LINE, a basic regular expression, is found in what the tool says of the file
says() {
    file=$1 name=$2 missing=0
    shift 2
    table "$tables/$file.txt" || missing=1
    for text; do grep -q -- "$text" "$dir/out" || { missing=1; echo "# not found: $text"; }; done
    report $missing "$file: $name"
}
says rkf45 'Fehlberg 4(5): order 4, pair 5; -3.02 on the real axis' 'rkf45: 6 stages, explicit, order 4, pair 5$' '\[-3.02, 0\] and i\[-0.00, 0.00\]'
says crouzeix4 'order 4, A-stable, |R(-inf)| = 0.63' '3 stages, diagonally implicit, order 4, ' 'A-stable.* 0.63'
says radau_ia 'order 5, fully implicit, L-stable' '3 stages, fully implicit, order 5$' 'L-stable'
says ars232 'order 2 together, explicit half and L-stable half' 'ars232_e: 3 stages, explicit, order 2$' \
    'ars232_i: 3 stages, diagonally implicit, order 2, stiffly accurate' 'L-stable' 'together: order 2$'
says ssp2_332 'order 2 together, SSP coefficient 2 of the explicit half' 'SSP  *coefficient 2$' 'together: order 2$'

echo "1..$count"
