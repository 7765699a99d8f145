#!/bin/sh
# SPDX-License-Identifier: MIT
# mpi.sh - a distributed interface takes the iterations of one rank on any number of ranks, but for the rounding of sums,
# with one sum each.  Prints TAP.
set -u
B=${B:-build}
if ! command -v mpirun >/dev/null || [ ! -x "$B/mpi" ]; then
    echo '1..0 # SKIP no MPI; Debian: openmpi-bin libopenmpi-dev'
    exit 0
fi
[ "$(id -u)" = 0 ] && root=--allow-run-as-root || root=
run() { # run RANKS OPTIONS...
    ranks=$1
    shift
    mpirun $root --oversubscribe -np "$ranks" "$B/mpi" "$@" 2>&1
}
# alike A B: both have converged, in numbers of iterations that differ by 2 % at most
alike() {
    printf '%s\n%s\n' "$1" "$2" | awk '$1 == "iterations" { n[++i] = $2 } $1 == "converged" { c += $2 }
        END { exit !(c == 2 && n[1] > 0 && n[2] <= 1.02 * n[1] && n[1] <= 1.02 * n[2]) }'
}
count=0
one=$(run 1)
for ranks in 2 4 8; do
    out=$(run $ranks)
    sums=$(echo "$out" | awk '$1 == "sums_per_iteration" { print $2 }')
    count=$((count + 1))
    if alike "$one" "$out" && echo "$out" | grep -q "^ranks $ranks$" && [ "$sums" = 1 ]; then
        echo "ok $count - $ranks ranks: the iterations of one rank, one sum each"
    else
        echo "not ok $count - $ranks ranks"
        echo "$out" | sed 's/^/# /'
    fi
done

# a first guess from the windows before: wf_foretell on the misses of all ranks
longer() { run "$1" --windows 20 --predict "$2" | grep -E '^(iterations|converged) '; }
plain=$(longer 1 0) one=$(longer 1 1)
for ranks in 2 4; do
    out=$(longer $ranks 1)
    count=$((count + 1))
    if alike "$one" "$out" && printf '%s\n%s\n' "$plain" "$out" |
        awk '$1 == "iterations" { n[++i] = $2 } $1 == "converged" { c += $2 } END { exit !(c == 2 && n[2] < 0.95 * n[1]) }'; then
        echo "ok $count - $ranks ranks, first guesses: the iterations of one rank, fewer than without"
    else
        echo "not ok $count - $ranks ranks, first guesses"
        printf '%s\n%s\n%s\n' "$plain" "$one" "$out" | sed 's/^/# /'
    fi
done

# two fields on two communicators, one sum over both
one=$(run 1 --fields 2)
for ranks in 2 5; do
    out=$(run $ranks --fields 2) count=$((count + 1))
    if alike "$one" "$out" && printf '%s\n%s\n' "$one" "$out" | awk '/^norm_/ { if (n[$1]) { off = $2 / n[$1] - 1; m += off * off < 1e-16 } n[$1] = $2 }
        $1 == "sums_per_iteration" { sums += $2 } END { exit !(m == 2 && sums == 2) }'; then
        echo "ok $count - two fields on two communicators, $ranks ranks: the iterations and the answer of one rank, one sum each"
    else
        echo "not ok $count - two fields on two communicators, $ranks ranks"
        printf '%s\n%s\n' "$one" "$out" | sed 's/^/# /'
    fi
done

# between window ends: the degree of wf_choose and the estimate of wf_error over all ranks, the error by Newton's method,
# one rank's numbers
traced() { run "$1" --windows 20 --trace 1 | grep -E '^(trace_|chosen_)'; }
one=$(traced 1) out=$(traced 4) count=$((count + 1))
if printf '%s\n%s\n' "$one" "$out" | awk '$1 == "chosen_degree" { d[++m] = $2; next } { v[++n] = $2 }
    function near(a, b) { return a > 0.99 * b && a < 1.01 * b }
    END { exit !(m == 2 && d[1] > 0 && d[1] == d[2] && n == 4 && v[2] > 0 && v[1] > v[2] / 3 && v[1] < 3 * v[2] &&
                 near(v[3], v[1]) && near(v[4], v[2])) }'; then
    echo "ok $count - between window ends, 4 ranks: the degree and the estimate of one rank, within 3 of the error"
else
    echo "not ok $count - between window ends"
    printf '%s\n%s\n' "$one" "$out" | sed 's/^/# /'
fi
echo "1..$count"
