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

# ---- published properties ----
says rkf45 'Fehlberg 4(5): order 4, pair 5, explicit' 'rkf45: 6 stages, explicit, order 4, pair 5$' \
    'order 5  not of b: ' 'order 6  not of bhat: ' '|R| <= 1 on \[-3.02, 0\] and i\[-0.00, 0.00\]' 'c is the sum of each row$'
says crouzeix4 'order 4, A-stable, |R| = 0.63 at infinity, a stage outside the step' \
    '3 stages, diagonally implicit, order 4, a stage outside the step$' 'A-stable, .* 0.63 at infinity'
says radau_ia 'Radau IA: order 5, fully implicit, L-stable' '3 stages, fully implicit, order 5$' 'L-stable'
says ars232 'order 2 together; the halves: explicit, and L-stable' 'ars232_e: 3 stages, explicit, order 2$' \
    'ars232_i: 3 stages, diagonally implicit, order 2, stiffly accurate' 'L-stable' 'together: order 2$' 'in sum bE_i aI_ij cE_j = 1/6'
says ssp2_332 'order 2 together, SSP coefficient 2 of the explicit half, L-stable implicit half' 'SSP  *coefficient 2$' \
    'together: order 2$' 'L-stable'

# the same forms by other ways of writing; stability and SSP of tables that everybody knows
wrote() { # wrote NAME PATTERN TEXT: of a text on standard input
    printf "$3" | table -
    grep -q -- "$2" "$dir/out"
    report $? "$1"
}
wrote 'rows without c and bar, brackets: Heun' '2 stages, explicit, order 2$' '[0, 0]\n[1, 0]\nb = [1/2, 1/2]\n'
wrote 'c in front without a bar: the same' '2 stages, explicit, order 2$' '0 0 0\n1 1 0\nb 1/2 1/2\n'
wrote 'a minus sign, a root and a point of a paper' 'L-stable' '1−√2/2 | 1 − √(2)/2\n1 | √2·.5 1−√2/2\n-----\n | √2/2 1-√2/2\n'
wrote 'implicit Euler is SSP for every step' 'for steps of every size' '1|1\nb|1\n'
wrote 'SSP coefficient of Shu and Osher, order 3: 1' 'SSP  *coefficient 1$' '0|\n1|1\n1/2|1/4 1/4\nb|1/6 1/6 2/3\n'
wrote 'SSP coefficient of the midpoint rule: 2' 'SSP  *coefficient 2$' '1/2|1/2\nb|1\n'
wrote 'Kutta: [-2.79, 0] and 2.83 i, dense output of order 3' 'i.-2.83, 2.83' '0|\n1/2|1/2\n1/2|0 1/2\n1|0 0 1\nb|1/6 1/3 1/3 1/6\n'
wrote 'the same, numbers of 7 digits: order 3 and what it rests on' 'order 4 of b holds to .*only' \
    '0|\n.5|.5\n.5|0 .5\n1|0 0 1\nb|.1666667 .3333333 .3333333 .1666667\n'

# ---- misprints ----
says tsit5_paper 'the misprint in the program of the paper' 'MISPRINT? line 13: bhat_7 = 1/66 for 1/40 gives order 4 of bhat$' \
    'order 1  not of bhat: 9.8e-03 off in sum bhat_i = 1/1$' 'bhat does not sum to 1'
misprint() { # misprint FILE FROM TO EXPECTED: a slip in a table
    sed "s#$2#$3#" "$tables/$1.txt" | table -
    grep -q "MISPRINT? line [0-9]*: $4\$" "$dir/out" && ! grep -q 'MISPRINT, or' "$dir/out"
    report $? "$1 with $3 for $2: $4"
}
misprint tsit5_paper 1/40 -1/66 'bhat_7 = 1/66 for -1/66 gives order 4 of bhat' # the sign in the paper's table 1
misprint rkf45 -3544 -3554 'a_6,3 = -3544/2565 for -3554/2565 gives order 5 of bhat' # a public one: pathsim, issue 232
misprint rkf45 '1932/2197' '1923/2197' 'a_4,1 = 1932/2197 for 1923/2197 gives order 4 of b'
misprint rkf45 '12/13' '12/31' 'c_4 = 12/13 for 12/31 gives order 4 of b'
misprint rkf45 '2197/4104 *-1/5' '2197/4104 1/5' 'b_5 = -1/5 for 1/5 gives order 4 of b'
printf '0|\n1/2|1/2\n1/2|0 1/2\n1|0 0 1 1\nb|1/6 1/3 1/3 1/6\n' | table - # a public one: netket, issue 1056
grep -q 'MISPRINT? line 4: a_4,4 = 0 for 1 gives order 4 of b$' "$dir/out"
report $? 'a number of the diagonal: a_4,4 = 0 for 1'
for file in rkf45 crouzeix4 radau_ia ars232 ssp2_332; do
    table "$tables/$file.txt"
    ! grep -q MISPRINT "$dir/out"
    report $? "$file: no misprint"
done

# ---- wrong input: line, column and a sentence, exit 2 ----
wrong() { # wrong LINE:COLUMN SENTENCE TEXT
    printf "$3" | table -
    [ $? = 2 ] && grep -q -- "^-:$1: .*$2" "$dir/out"
    report $? "wrong input at $1: $2"
}
wrong 2:9 'a number is due here' '0 |\n1 | 1/2 * x\nb | 1 0\n' 2>/dev/null || :

echo "1..$count"
