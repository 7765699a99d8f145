#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh - the main job: both scenes with their published set-up, beside the published answers; logs, CSV and a picture.
set -eu
B=${B:-build}
here=$(dirname "$0")

side_by_side() { # one row: the scene's e_A, e_B and the published ones
    awk -v name="$1" '{ v[$1] = $2 }
        END { printf "%-34s %-21s %-21s %8.1e   %-21s %-21s %8.1e   %5.1f\n", name, v["e_A"], v["published_e_A"],
              v["e_A"] - v["published_e_A"], v["e_B"], v["published_e_B"], v["e_B"] - v["published_e_B"], v["iterations"] }'
}

echo 'Two masses, 5 and 100 sub-steps in a window: largest error of each side against the exact solution'
printf '%-34s %-21s %-21s %8s   %-21s %-21s %8s   %s\n' 'window, what is exchanged' e_A published differ e_B published differ iterations
for mode in '1 0 linear, window ends' '1 1 linear, sub-steps' '3 1 cubic, sub-steps'; do
    set -- $mode
    degree=$1 substeps=$2
    shift 2
    for window in 0.2 0.1 0.05; do
        "$B/oscillator" --window $window --degree "$degree" --substeps "$substeps" | side_by_side "$window, $*"
    done
done
"$B/oscillator" --window 0.2 --log "$B/oscillator" >/dev/null

echo
echo 'Constant in a window, e_A: what is lost where the other side is read at the window end alone'
printf '  %-10s %-12s %s\n' window e_A published
for window in 0.1 0.05 0.025 0.0125; do
    "$B/oscillator" --window $window --degree 0 --substeps 0 |
        awk -v w=$window '{ v[$1] = $2 } END { printf "  %-10s %-12.6g %s\n", w, v["e_A"], v["published_e_A"] }'
done

echo
echo 'The same with one sample in a window, e_A: the published cubic falls back to linear, history and Hermite data keep the order'
printf '  %-10s %-12s %-14s %-14s %s\n' window published 'history 2' 'Hermite' 'Hermite, history 1, degree 5'
for window in 0.1 0.05 0.025; do
    printf '  %-10s' $window
    for how in '' '--history 2' '--hermite 1' '--hermite 1 --history 1 --degree 5'; do
        "$B/oscillator" --substeps 0 --window $window $how | awk '$1 == "e_A" { printf " %-13.4g", $2 }'
    done
    echo
done

echo
echo 'Elastic tube, 100 time windows: iterations in each (IQN-ILS, 8 windows reused, QR2 1e-3)'
"$B/tube" --log "$B/tube" >"$B/tube.out" &
job=$!
while kill -0 $job 2>/dev/null; do
    sleep 1
    [ -t 1 ] && [ -f "$B/tube-iterations.log" ] && printf '\r  window %s of 100 ' "$(($(wc -l <"$B/tube-iterations.log") - 1))"
done
wait $job
[ -t 1 ] && printf '\r%-22s\r' ''
awk '$1 == "window" { mine[$2] = $4 } $1 == "published_window" { theirs[$2] = $4 } $1 == "total" { total = $2 }
    $1 == "published_total" { published = $2 }
    END { printf "  window     "; for (k = 1; k <= 8; k++) printf "%4d", k
          printf "   total\n  iterations "; for (k = 1; k <= 8; k++) printf "%4d", mine[k]
          printf "%8d\n  published  ", total; for (k = 1; k <= 8; k++) printf "%4d", theirs[k]
          printf "%8d\n", published }' "$B/tube.out"
for more in '--settings kit' '--settings kit --predict 2'; do
    printf '  with %-28s total %s\n' "$more" "$("$B/tube" $more | awk '$1 == "total" { print $2 }')"
done

if command -v gnuplot >/dev/null; then
    gnuplot -e "B='$B'" "$here/run.gp"
    echo; echo "picture: $B/run.svg"
else
    echo; echo 'no picture: install gnuplot-nox for one'
fi
echo "logs and data: $B/oscillator.csv $B/oscillator-iterations.log $B/oscillator-convergence.log $B/tube-iterations.log $B/tube-convergence.log"
