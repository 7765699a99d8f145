#!/bin/sh
# SPDX-License-Identifier: MIT
# one_number.sh - make onenumber: problem x accuracy, the error reached and the work over that of the best fixed set-up;
# table and CSV in $B/trade, the picture also in tests/study.
set -eu
B=${B:-build}
here=$(dirname "$0")
mkdir -p "$B/trade"
"$B/study_one_number" "$B/trade" "$B/adaptive" "$@" | tee "$B/trade/one-number.md"
for problem in pol load; do
    "$B/adaptive" --problem $problem --accuracy 1e-6 --log "$B/trade/one-number-$problem-windows" >/dev/null
done
if [ $# = 0 ] && command -v gnuplot >/dev/null; then
    gnuplot -e "T='$B/trade'" "$here/one_number.gp"
    [ "$(wc -c <"$B/trade/one-number.svg")" -lt 60000 ] && cp "$B/trade/one-number.svg" "$here"
    echo "picture: $B/trade/one-number.svg"
fi
