#!/bin/sh
# SPDX-License-Identifier: MIT
# multirate.sh - runs of build/rates that take one tolerance: every coupling with an embedded solution, eight problems (seven
# that do not amplify errors; the settings were chosen on the first three), tolerances 1e-3 to 1e-6, and 1e-8 from order 3
# on; by shares and decoupled.  A line a run: problem, coupling, tolerance, control, error in tolerances, slow and fast
# evaluations, order.  Two minutes.
B=${B:-build}
couplings='ERK22a,2 ERK33a,3 ERK45a,4 IRK21a,2 ESDIRK34a,3 ESDIRK46a,4 SR21,2 SR32,3 SR43,4 MERK21,2 MERK32,3 MERK43,4 MERK54,5'
run() { # run NAME OPTIONS
    name=$1
    shift
    for coupling in $couplings; do
        order=${coupling#*,} method=${coupling%,*}
        for tolerance in 1e-3 1e-4 1e-5 1e-6 $([ "$order" -gt 2 ] && echo 1e-8); do
            for control in shares decoupled; do
                "$B/rates" "$@" --method "$method" --tolerance $tolerance --control $control |
                    awk -v head="$name $method $tolerance $control" -v order="$order" '$1 == "evaluations" { n = $2 " " $3 }
                        $1 == "error_per_tolerance" { print head, $2, n, order; ok = 1 } END { if (!ok) print head, "gives-up" }'
            done
        done
    done
}
run kpr --problem kpr
run brusselator --problem brusselator
run springs --problem springs
run exchange --problem exchange
run kpr50 --problem kpr --scale 50 --G -5 --e 0.2
run brusselator3 --problem brusselator --end 3
run springs100 --problem springs --scale 25 --end 5
run falling --problem falling
