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
table() { "$B/table" --svg none "$@" >"$dir/out" 2>&1; }

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
    'fails  *order 5 of b: ' 'fails  *order 6 of bhat: ' '|R| <= 1 on \[-3.02, 0\] and i\[-0.00, 0.00\]' 'c is the sum of each row$'
says crouzeix4 'order 4, A-stable, |R| = 0.63 at infinity, a stage outside the step' \
    '3 stages, diagonally implicit, order 4, a stage outside the step$' 'A-stable, .* 0.63 at infinity'
says radau_ia 'Radau IA: order 5, fully implicit, L-stable' '3 stages, fully implicit, order 5$' 'L-stable'
says ars232 'order 2 together; the halves: |R| of the explicit one is that of order 3, the other is L-stable' \
    'ars232_e: 3 stages, explicit, order 2$' '\[-2.51, 0\] and i\[-1.73, 1.73\]' \
    'ars232_i: 3 stages, diagonally implicit, order 2, stiffly accurate' 'L-stable' 'together: order 2$' 'order 3 of both: sum bE_i aI_ij cE_j = 1/6 is off by 4.0e-02$'
says ssp2_332 'order 2 together, SSP coefficient 2 of the explicit half, L-stable implicit half' 'SSP  *coefficient 2$' \
    'together: order 2$' 'L-stable'
says radau_iia 'Radau IIA: its own polynomial, bounded, with the number' 'L-stable' 'stages   order 3, weak stage order 3' \
    'dense    order 3, 4 inside a stiff step, bounded by 1.008 for stiff parts'
says kvaerno3 'Kvaerno 4(2)3 of 13 digits: polished on its order conditions, with dense output; L-stable' 'holds to 1.9e-11 only$' \
    'polished on the order conditions; no number moves by more than 1.7e-11$' 'c is the sum of each row$' 'L-stable' 'dense    order 3, '
says rkf45 'Fehlberg: constants of Dormand and Prince, stability of the pair, exact fractions' \
    'error    A_5 = 0.00184; of the pair Ahat_6 = 0.00336, B = 2.02, C = 0.833; D = 8$' 'pair     |Rhat| <= 1 on \[-3.67, 0\]' \
    '^    -1. / 360, 0, 128. / 4275, 2197. / 75240, -1. / 50, -2. / 55,$'

# the same forms by other ways of writing; stability and SSP of tables that everybody knows
wrote() { # wrote NAME PATTERN TEXT: of a text on standard input
    printf "$3" | table -
    grep -q -- "$2" "$dir/out"
    report $? "$1"
}
wrote 'rows without c and bar, brackets: Heun' '2 stages, explicit, order 2$' '[0, 0]\n[1, 0]\nb = [1/2, 1/2]\n'
wrote 'c in front without a bar: the same' '2 stages, explicit, order 2$' '0 0 0\n1 1 0\nb 1/2 1/2\n'
wrote 'a minus sign, a root and a point of a paper' 'L-stable' '1−√2/2 | 1 − √(2)/2\n1 | √2·.5 1−√2/2\n-----\n | √2/2 1-√2/2\n'
wrote 'the theta method with 1/3: |R| <= 1 on [-6, 0] only, 2 at infinity' '\[-6.00, 0\].*not A-stable.* 2 at infinity' '1/3|1/3\nb|1\n'
wrote 'midpoint steps 2 h and -h: |R| = 1 on the imaginary axis, a pole to its left' 'not A-stable: up to 1 ' '1|1\n3/2|2 -1/2\nb|2 -1\n'
wrote 'implicit Euler is SSP for every step' 'for steps of every size' '1|1\nb|1\n'
wrote 'SSP coefficient of Shu and Osher, order 3: 1' 'SSP  *coefficient 1$' '0|\n1|1\n1/2|1/4 1/4\nb|1/6 1/6 2/3\n'
wrote 'SSP coefficient of the midpoint rule: 2' 'SSP  *coefficient 2$' '1/2|1/2\nb|1\n'
wrote 'Kutta: [-2.78, 0] and 2.82 i, dense output of order 3' 'i.-2.82, 2.82' '0|\n1/2|1/2\n1/2|0 1/2\n1|0 0 1\nb|1/6 1/3 1/3 1/6\n'
wrote 'the same is not SSP' 'SSP  *coefficient 0$' '0|\n1/2|1/2\n1/2|0 1/2\n1|0 0 1\nb|1/6 1/3 1/3 1/6\n'
wrote 'blanks in brackets stand between no numbers' '2 stages, explicit, order 2$' '0|\n1|(3 -2)\nb|1/2 1/2\n'
wrote 'the same, numbers of 7 digits: order 3 and what it rests on' 'order 4 of b holds to .*only' \
    '0|\n.5|.5\n.5|0 .5\n1|0 0 1\nb|.1666667 .3333333 .3333333 .1666667\n'

wrote 'Gauss of two stages: its polynomial is bounded' 'dense    order 2, 3 inside a stiff step, bounded by 1.000' \
    '1/2-sqrt(3)/6|1/4 1/4-sqrt(3)/6\n1/2+sqrt(3)/6|1/4+sqrt(3)/6 1/4\nb|1/2 1/2\n'
wrote 'Julia: 1//3' 'order 3$' '0|\n1//3|1//3\n2//3|0 2//3\nb|1//4 0 3//4\n'
wrote 'Fortran: 1.d0/3, 0.75_wp' 'order 3$' '0|\n1.d0/3|1.d0/3.d0\n2/3|0 2.0D+00/3\nb|0.25_wp 0 7.5d-1\n'
printf '0 & \\\\\n\\frac{1}{3} & \\frac{1}{3} \\\\\n\\tfrac{2}{3} & 0 & \\frac{2}{3} \\\\ \\hline\n & \\frac{1}{4} & 0 & \\frac{3}{4} \\\\\n' >"$dir/latex"
table "$dir/latex"
grep -q '3 stages, explicit, order 3$' "$dir/out" && grep -q '^    1. / 4, 0, 3. / 4,$' "$dir/out"
report $? 'LaTeX: fractions, rows of & and two backslashes, hline'
wrote 'decimals of 7 digits become the fractions that they stand for' 'polished on the order conditions; no number moves by more than 3.3e-08' \
    '0|\n.5|.5\n.5|0 .5\n1|0 0 1\nb|.1666667 .3333333 .3333333 .1666667\n'
printf 'order 4\n0|\n1/2|1/2\nb|0 1\n' | table -
[ $? = 1 ] && grep -q 'CLAIMED  order 4, pair 0: found 2, 0$' "$dir/out"
report $? 'an order that is claimed and does not hold: exit 1'
printf 'order 2\n0|\n1/2|1/2\nb|0 1\n' | table -
report $? 'one that holds: exit 0'
sed 's#1932/2197#1923/2197#' "$tables/rkf45.txt" | table -
[ $? = 1 ]
report $? 'a table that may have a misprint: exit 1'
{
    printf 'name dp5\n0|\n1/5|1/5\n3/10|3/40 9/40\n4/5|44/45 -56/15 32/9\n8/9|19372/6561 -25360/2187 64448/6561 -212/729\n'
    printf '1|9017/3168 -355/33 46732/5247 49/176 -5103/18656\n1|35/384 0 500/1113 125/192 -2187/6784 11/84\n'
    printf 'b|35/384 0 500/1113 125/192 -2187/6784 11/84 0\nbhat|5179/57600 0 7571/16695 393/640 -92097/339200 187/2100 1/40\n'
} | table --form rk -
sed -n '/rk__dp5\[\]/,/^};/p' "$dir/out" >"$dir/dp5" && sed -n '/rk__dp5\[\]/,/^};/p' "$top/rk.h" | diff - "$dir/dp5" >>"$dir/out" &&
    grep -q '^    RK__PAIR_SA(dp5, 7, 5, 4, 4, 4, 0),$' "$dir/out"
report $? 'dp5 in the form of rk.h is what stands in rk.h'

# ---- misprints ----
table "$tables/tsit5_paper.txt"
[ $? = 1 ] && grep -q 'MISPRINT? line 14: bhat_7 = 1/66 for 1/40 gives order 4 of bhat$' "$dir/out" &&
    grep -q 'order 1 of bhat: sum bhat_i = 1/1 is off by 9.8e-03$' "$dir/out" && grep -q 'bhat does not sum to 1' "$dir/out"
report $? 'tsit5_paper: the misprint in the program of the paper; exit 1'
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
printf '0 0\n1/2 0\nb 1/2 1/2\n' | table - # of order 1, with 1 for 1/2 of order 2
! grep -q MISPRINT "$dir/out"
report $? 'one condition more by one number is no misprint'
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
wrong 2:11 'the name x is not known' '0 |\n1 | 1/2 * x\nb | 1 0\n'
wrong 2:5 'this number is not finite' '0 |\n1 | 1/0\nb | 1/2 1/2\n'
wrong 1:5 'this number is not finite' 'g = sqrt(-1)\ng | g\nb | 1\n'
wrong 2:5 'this bracket is not closed' '0 |\n1 | (1 + 2\nb | 1/2 1/2\n'
wrong 2:9 'an opening bracket is due' '0 |\n1 | sqrt 2\nb | 1 0\n'
wrong 1:9 'a closing bracket is due' '1 − √(2 | 3\nb | 1\n' # characters, not bytes, are counted
wrong 2:8 'not understood behind a number' '0 |\n1 | 1,5x\nb | 1/2 1/2\n'
wrong 1:5 'a number is due here' '0 | $\nb | 1\n'
wrong 2:8 'the line ends where a number is due' '0 |\n1 | 1 -\nb | 1/2 1/2\n'
wrong 3:2 'the line ends where numbers are due' '0 |\n1 | 1\nb\n'
wrong 2:7 'a second bar' '0 |\n1 | 1 | 2\nb | 1/2 1/2\n'
wrong 1:3 'one number, c, stands in front of the bar' '0 1 |\n1 | 1\nb | 1 1\n'
wrong 2:9 '3 weights, but there are 2 stages' '0 |\n1 | 1 2 3\nb | 1/2 1/2\n'
wrong 3:5 '1 weights, but there are 2 stages' '0 |\n1 | 1\nb | 1/2\n'
wrong 1:3 '2 numbers without a bar: 3 are due, or 4 with c' '0 0\n1 1\n1 2\nb 1 2\n'
wrong 2:1 'some rows have c, others not' '0 |\n1 0\nb | 1/2 1/2\n'
wrong 1:1 'the text ends without rows' ''
wrong 2:1 'the text ends without a row b' '0 |\n1 | 1\n'
wrong 3:1 'a second row b' '0 |\nb | 1\nb | 1\n'
wrong 4:1 'a stage below b' '0 |\n1 | 1\nb | 1/2 1/2\n2 | 1\n'
wrong 4:1 'a second half of this kind' 'explicit\n0 |\nb | 1\nexplicit\n0 |\n'
wrong 6:1 'halves of 1 and 2 stages' 'explicit\n0 |\nb | 1\nimplicit\n1 | 1\n1 | 0 1\n'
wrong 1:6 'a name begins with a letter' 'name 2x\n0 |\nb | 1\n'
for bad in '' "$dir/none" "--dense 11 $tables/rkf45.txt" "--order 4 $tables/rkf45.txt"; do
    "$B/table" $bad >"$dir/out" 2>&1
    status=$?
    [ -s "$dir/out" ] && if [ "$bad" ]; then [ $status = 2 ]; else [ $status = 0 ]; fi
    report $? "table ${bad##*/}: a message"
done

# ---- the picture, and none without gnuplot ----
"$B/table" --svg "$dir/out.svg" "$tables/ars232.txt" >"$dir/out" 2>&1
if command -v gnuplot >/dev/null; then
    grep -q '</svg>' "$dir/out.svg" && grep -q 'ars232_i' "$dir/out.svg" && grep -q 'dense output' "$dir/out.svg"
    report $? 'both stability regions and the dense error in one SVG'
fi
mkdir "$dir/bin" && ln -s "$(command -v sh)" "$dir/bin/sh"
PATH=$dir/bin "$B/table" --svg "$dir/no.svg" "$tables/rkf45.txt" >"$dir/out" 2>&1 && grep -q 'picture  none: install gnuplot' "$dir/out" &&
    grep -q '^static const rk_table rkf45 ' "$dir/out" && [ ! -e "$dir/no.svg" ]
report $? 'without gnuplot it says so, and goes on'

# ---- the C text compiles, is proved, and has the orders that it claims ----
: >"$dir/tables.h"
for file in rkf45 crouzeix4 radau_ia; do "$B/table" --svg none "$tables/$file.txt" >>"$dir/tables.h"; done
"$B/table" --dense 2 --svg none "$tables/ars232.txt" >>"$dir/tables.h"
sed 's/^name .*/name rkf45more/' "$tables/rkf45.txt" | "$B/table" --dense 4 --extra 3 --svg none - >>"$dir/tables.h"
cat >"$dir/run.c" <<'END'
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "tables.h"
#include <stdio.h>

/* y' = 2 t y (1 - y), y = 1/(1 + exp(-t^2)); two halves: 2 t y and -2 t y^2 */
static double exact(double t) { return 1 / (1 + exp(-t * t)); }
static double f(int p, int halves, double t, double y)
{
    return 2 * t * ((halves == 1 || p == 0 ? y : 0) - (halves == 1 || p == 1 ? y * y : 0));
}

/* A step of size h from y at t, as far as theta; stages by fixed-point iteration. */
static double step(const rk_table *T, int halves, double t, double h, double y, double theta)
{
    const int m = T->stages + T->extra;
    double k[2][16] = {{0}}, z[2][16] = {{0}}, zero = 0;
    int i, j, p;
    for (i = 0; i < 200; i++) {
        for (p = 0; p < halves; p++) {
            rk_table all = T[p]; /* the extra stages, too */
            all.stages = m, all.extra = 0;
            rk_stages(&all, h, 1, p ? &zero : &y, k[p], 1, z[p], 1);
        }
        for (p = 0; p < halves; p++)
            for (j = 0; j < m; j++) k[p][j] = f(p, halves, t + T[p].c[j] * h, z[0][j] + z[1][j]);
    }
    for (p = 0; p < halves; p++) {
        const rk_step s = {&T[p], h, 1, &y, k[p], 1};
        rk_dense(&s, theta, 0, &y);
    }
    return y;
}

/* The error at t = 2. */
static double run(const rk_table *T, int halves, int steps)
{
    const double h = 2. / steps;
    double y = exact(0.);
    int l;
    for (l = 0; l < steps; l++) y = step(T, halves, l * h, h, y, 1.);
    return fabs(y - exact(2.));
}

/* The largest error inside a step from t = 0.6. */
static double largest(const rk_table *T, int halves, double h)
{
    double theta, worst = 0;
    for (theta = .1; theta < .95; theta += .1)
        worst = fmax(worst, fabs(step(T, halves, .6, h, exact(.6), theta) - exact(.6 + theta * h)));
    return worst;
}

static int check(const rk_table *T, int halves, int steps)
{
    const int status = halves == 2 ? rk_check_imex(&T[0], &T[1], NULL) : rk_check(T, NULL);
    const double order = log2(run(T, halves, steps) / run(T, halves, 2 * steps));
    const double inside = log2(largest(T, halves, .04) / largest(T, halves, .02));
    printf("%s: %s; order %d, observed %.2f; dense %d, its error in a step %.2f\n", T->name, rk_message(status), T->order, order,
           T->dense_order, inside);
    return status != RK_OK || fabs(order - T->order) > .2 || inside < T->dense_order + .8;
}

int main(void)
{
    const rk_table ars[2] = {ars232_e, ars232_i};
    int bad = check(&rkf45, 1, 128) + check(&rkf45more, 1, 128) + check(&crouzeix4, 1, 256) + check(&radau_ia, 1, 32);
    bad += check(ars, 2, 256);
    bad += rkf45.order_hat != 5 || rkf45more.dense_order != 4 || rkf45more.extra < 1;
    return bad > 0;
}
END
for compiler in "$cc -std=c99" "${CXX:-c++} -x c++ -std=c++11"; do
    if ! command -v ${compiler%% *} >/dev/null; then continue; fi
    $compiler -Wall -Wextra -Wpedantic -Werror -O1 -I"$top" -I"$top/examples" -I"$dir" -o "$dir/run" "$dir/run.c" -lm >"$dir/out" 2>&1 &&
        "$dir/run" >"$dir/out"
    report $? "${compiler#* }: the C text compiles, rk_check accepts it, orders as observed"
done

echo "1..$count"
