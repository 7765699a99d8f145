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
    awk -v q="'" '/xlink:href=.#gpDot/ { # all dots of a curve as one path
            split($0, part, q)
            d = d sprintf("M%d,%dh1", part[4], part[6])
            next
        }
        d { print "<path stroke=\"#888888\" d=\"" d "\"/>"; d = "" }
        /[^ \t]/ { sub(/^\t*/, ""); gsub(/ font-family="sans" */, " "); print }' \
        "$B/trade/one-number.svg" >"$B/trade/one-number.new"
    sed -i 's/ stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"//
        s/<svg $/<svg font-family="sans"/' "$B/trade/one-number.new"
    sed -z 's/<g [^>]*>\n<\/g>\n//g' "$B/trade/one-number.new" >"$B/trade/one-number.svg"
    cp "$B/trade/one-number.svg" "$here"
    echo "picture: $B/trade/one-number.svg"
fi
