#!/bin/sh
# SPDX-License-Identifier: MIT
# one_number.sh [PROBLEM...] - make onenumber: problem x accuracy, the error reached and the work over that of the best
# fixed set-up; tables and CSV in $B/study, the picture and the tables also in tests/study.  With SEARCH="PROBLEM ..." or
# SEARCH=all the fixed set-ups of these are searched before, and replace those in tests/study/one-number.txt.  With
# CERTIFY="11 12" the bound of the error is judged with these starts and rates, and its sources by steps in four, too.
set -eu
B=${B:-build}
here=$(dirname "$0")
fixed=$here/one-number.txt
mkdir -p "$B/study"

search() { # search PROBLEM...: two at a time; the rows of the others stay
    for problem in "$@"; do echo "$problem"; done |
        xargs -P 2 -I{} sh -c '"$0" {} >"$1/one-number-{}.txt"' "$B/study_one_number" "$B/study"
    for problem in "$@"; do
        grep -v "^[a-z]*,$problem," "$fixed" >"$B/study/one-number.txt" || true
        cat "$B/study/one-number.txt" "$B/study/one-number-$problem.txt" >"$fixed"
    done
}

all='masses duffing pol stiff heat load damped switch relay rates tube'
if [ "${SEARCH:-}" = all ]; then search $all; elif [ "${SEARCH:-}" ]; then search $SEARCH; fi
for python in python3 /usr/bin/python3; do command -v $python >/dev/null && break; done
[ $# != 0 ] || whole=1
[ $# != 0 ] || set -- $all
passed=0
$python "$here/one_number.py" "$B/adaptive" "$fixed" "$B/study" "$@" || passed=$?
[ "${whole:-}" ] || exit $passed
if command -v gnuplot >/dev/null; then
    gnuplot -e "T='$B/study'" "$here/one_number.gp"
    awk -v q="'" '/xlink:href=.#gpDot/ { # all dots of a curve as one path
            split($0, part, q)
            d = d sprintf("M%d,%dh1", part[4], part[6])
            next
        }
        d { print "<path stroke=\"#888888\" d=\"" d "\"/>"; d = "" }
        /[^ \t]/ { sub(/^\t*/, ""); gsub(/ font-family="sans" */, " "); print }' \
        "$B/study/one-number.svg" >"$B/study/one-number.new"
    sed -i 's/ stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"//
        s/<svg $/<svg font-family="sans"/' "$B/study/one-number.new"
    sed -z 's/<g [^>]*>\n<\/g>\n//g' "$B/study/one-number.new" >"$B/study/one-number.svg"
    cp "$B/study/one-number.svg" "$here"
    echo "picture: $B/study/one-number.svg"
fi
$python tests/scripts/figures.py "$B" one one-all one-cells one-sure
exit $passed
