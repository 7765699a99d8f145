#!/bin/sh
# SPDX-License-Identifier: MIT
# scenes.sh - the scenes against the published numbers that they print beside their own.  Prints TAP; reads B.
set -u
B=${B:-build}
count=0

report() { # report STATUS NAME
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else
        echo "not ok $count - $2"
        sed 's/^/# /' "$B/scene.out"
    fi
}

# near KEY TOLERANCE: |KEY - published_KEY| <= TOLERANCE in the last output
near() {
    awk -v key="$1" -v tol="$2" '$1 == key { a = $2; n++ } $1 == "published_" key { b = $2; n++ }
        END { exit !(n == 2 && a - b <= tol && b - a <= tol) }' "$B/scene.out"
}

oscillator() { # oscillator TOLERANCE OPTIONS...
    tolerance=$1
    shift
    "$B/oscillator" "$@" >"$B/scene.out" 2>&1
    near e_A "$tolerance" && near e_B "$tolerance"
    report $? "oscillator $* within $tolerance"
}

e_A_only() {
    tolerance=$1
    shift
    "$B/oscillator" "$@" >"$B/scene.out" 2>&1
    near e_A "$tolerance"
    report $? "oscillator $*: e_A within $tolerance"
}

for window in 0.2 0.1 0.05; do
    oscillator 1e-10 --window $window --degree 1 --substeps 0
    oscillator 1e-10 --window $window --degree 1 --substeps 1
    oscillator 1e-10 --window $window --degree 3 --substeps 1
    # weakly coupled: quasi-Newton reaches the same answer
    oscillator 1e-10 --window $window --acceleration ils
    oscillator 1e-10 --window $window --acceleration reduced
done
e_A_only 1e-10 --window 0.1 --na 4 --nb 32
e_A_only 1e-10 --window 0.05 --na 4 --nb 64
e_A_only 1e-10 --window 0.025 --na 4 --nb 128

# one sample in a window: the order of the error between windows of 0.05 and 0.025
e_A_of() { "$B/oscillator" --substeps 0 "$@" | awk '$1 == "e_A" { print $2 }'; }
for row in 'linear, without history 1.5 2.5' 'history 3 4.5 --history 2' 'hermite 3.5 4.5 --hermite 1' 'hermite, degree_5 3.8 5 --hermite 1 --history 1 --degree 5'; do
    name=${row%% [0-9]*}
    set -- ${row#"$name" }
    low=$1 high=$2
    shift 2
    awk -v a="$(e_A_of --window 0.05 "$@")" -v b="$(e_A_of --window 0.025 "$@")" -v low="$low" -v high="$high" \
        'BEGIN { order = log(a / b) / log(2); exit !(order > low && order < high) }'
    report $? "oscillator, one sample in a window, $name: order between $low and $high"
done

"$B/tube" >"$B/scene.out" 2>&1
awk '$1 == "window" { mine[$2] = $4 } $1 == "published_window" { theirs[$2] = $4; n++ }
    $1 == "total" { total = $2 }
    END { for (k in theirs) if (mine[k] != theirs[k]) exit 1; exit !(n == 8 && total >= 846 * 0.98 && total <= 846 * 1.02) }' "$B/scene.out"
report $? 'tube: the published counts of windows 1 to 8, the total within 2 %'

total() { # total LIMIT: everything converged, in fewer iterations
    awk -v limit="$1" '$1 == "total" { total = $2 } $1 == "unconverged" { open = $2 } END { exit !(total > 0 && total < limit && open == 0) }' "$B/scene.out"
}
"$B/tube" --settings kit >"$B/scene.out" 2>&1
total 824
report $? 'tube: the defaults of iqn.h need fewer iterations than the published 846 and 824'
"$B/tube" --settings kit --predict 2 >"$B/scene.out" 2>&1
total 720
report $? 'tube: a quadratic first guess saves one iteration in a window'

"$B/multirate" --method all >"$B/scene.out" 2>&1
awk 'function off(a, b) { return a > 1.01 * b || a < 0.99 * b }
    / order / { for (i = 1; i <= NF; i++) if ($i == "u") { u = ++n % 2 ? $(i + 1) : u; if (n % 2 == 0 && off(u, $(i + 1))) bad = 1 }
                                          else if ($i == "v") { v = ++m % 2 ? $(i + 1) : v; if (m % 2 == 0 && off(v, $(i + 1))) bad = 1 } }
    END { exit !(n == 28 && m == 28 && !bad) }' "$B/scene.out"
report $? 'multirate: 14 couplings within 1 % of the reference errors'

"$B/heat" >"$B/scene.out" 2>&1
near T_gamma 5e-12 && near iterations 0
report $? 'heat: air against steel, the published iterations and temperature'
"$B/heat" --pair water_steel --method relaxation --dt 4.292860405911973 --steps 1,1 >"$B/scene.out" 2>&1
awk '$1 == "theta" { t = $2 } END { exit !(t - 0.6986351162403851 <= 1e-15 && 0.6986351162403851 - t <= 1e-15) }' "$B/scene.out"
report $? 'heat: the closed-form relaxation factor to 15 digits'
"$B/manufactured" >"$B/scene.out" 2>&1
awk '$1 == "e_A" { a = $2 } $1 == "published_e_A" { b = $2 } END { exit !(a > 0 && a <= b) }' "$B/scene.out"
report $? 'manufactured: Gauss 2, no larger an error than published'

"$B/conservation" >"$B/scene.out" 2>&1
awk '$1 == "imbalance_integral" || $1 == "imbalance_project" { n++; if ($2 > 1e-14 || $2 < -1e-14) bad = 1 }
    $1 == "imbalance_sampling" && ($2 > 1e-4 || $2 < -1e-4) { n++ } END { exit bad || n != 3 }' "$B/scene.out"
report $? 'conservation: what is sent arrives to 1e-14, where sampling loses 1e-4 and more'

# the coupled problems at their extremes
for pair in air_steel steel_air water_steel steel_water air_water water_air; do
    "$B/heat" --pair $pair --n 20 --columns 200 --filter 1e-12 --iterations 100 >"$B/scene.out" 2>&1 &&
        awk '$1 == "iterations" && $2 < 60 { found = 1 } END { exit !found }' "$B/scene.out"
    report $? "heat, $pair: heat capacities up to 2700 apart, either side first, converges"
done
"$B/tube" --settings kit --windows 5 --wall 1e4 >"$B/scene.out" 2>&1 && total 40
report $? 'tube, a wall 1e4 times as stiff: converges'
"$B/tube" --settings kit --windows 5 --wall 1e-3 >"$B/scene.out" 2>&1
[ $? = 1 ] && grep -q diverges "$B/scene.out"
report $? 'tube, a wall of 1e-3 of the stiffness: says that it diverges, and exits 1'
awk -v below="$(e_A_of --window 0.2 --na 1 --substeps 1)" -v above="$(e_A_of --window 0.25 --na 1 --substeps 1)" \
    'BEGIN { exit !(below < 10 && above > 100) }'
report $? 'oscillator, one step of Runge-Kutta 4 in a window: bounded below its limit 2.83 on the imaginary axis, not above'

for bad in 'oscillator --window 0.3' 'oscillator --degree 10' 'oscillator --nonsense 1' 'oscillator --na' 'tube --method newton' 'tube --omega nan' 'multirate --method none' 'heat --pair air' 'manufactured --method rk4'; do
    "$B"/$bad >"$B/scene.out" 2>&1
    [ $? = 2 ] && [ -s "$B/scene.out" ]
    report $? "$bad: a message and exit 2"
done
for scene in oscillator tube multirate heat manufactured conservation; do
    "$B/$scene" -h >"$B/scene.out" 2>&1 && grep -q -- -- "$B/scene.out"
    report $? "$scene -h lists the options"
done
rm -f "$B/scene.out"
echo "1..$count"
