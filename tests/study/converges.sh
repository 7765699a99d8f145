#!/bin/sh
# SPDX-License-Identifier: MIT
# converges.sh - make converges: where the coupling of the tube stops converging, over the stiffness of the wall and the
# length of a time window, in three ways: x is the areas, x is the pressures, and these with 400 pairs and iterations.
# Twenty windows, three runs with inputs moved by 1e-13; iterations in a window, "-" where a window of a run has no answer.
# Writes tests/study/converges.txt, from which make card draws.
set -eu
B=${B:-build}
here=$(dirname "$0")
export OPENBLAS_NUM_THREADS=1 LC_ALL=C

# iterations OPTIONS...: in a window, the mean of three runs
iterations() {
    for seed in 1 2 3; do
        SCENE_PERTURB=$seed "$B/tube" --settings kit --windows 20 "$@" 2>/dev/null |
            awk '$1 == "total" { n = $2 } $1 == "unconverged" { bad = $2 } END { print n == "" || bad ? "-" : n / 20 }'
    done | awk '$1 == "-" { bad = 1 } { sum += $1 } END { print bad ? "-" : sum / NR }'
}

# One cell of the map; the exponents count quarters of a decade.
cell() {
    wall=$(awk "BEGIN { printf \"%.6g\", 10^($1 / 4) }")
    window=$(awk "BEGIN { printf \"%.6g\", 0.73 * 10^($2 / 4) }") # no multiple of the inflow's half period
    set -- --wall "$wall" --dt "$window"
    echo "$wall,$window,$(iterations "$@" --columns 100 --most 100),$(iterations "$@" --columns 100 --most 100 --unknown pressure),$(
        iterations "$@" --columns 400 --most 400 --unknown pressure)"
}

if [ $# = 2 ]; then
    cell "$1" "$2"
    exit
fi
{
    echo 'wall,window,areas,pressures,pressures with 400 pairs'
    for wall in $(seq -8 8); do for window in $(seq -14 -1); do echo "$wall $window"; done; done |
        xargs -P "${JOBS:-2}" -n 2 sh "$0" | sort -t, -k1,1g -k2,2g
} >"$B/converges.txt"
cp "$B/converges.txt" "$here/converges.txt"
awk -F, 'NR > 1 { cells++; for (i = 3; i <= 5; i++) n[i] += $i != "-" }
    END { printf "cells that converge, of %d: by the areas %d, by the pressures %d, with 400 pairs %d\n", cells, n[3], n[4], n[5] }' "$here/converges.txt"
