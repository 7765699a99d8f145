#!/bin/sh
# SPDX-License-Identifier: MIT
# one_number.sh [PROBLEM...] - make onenumber: problem x accuracy, the error reached and the work over that of the best
# fixed set-up; all problems also into the documents, with the pictures of the card.  With SEARCH="PROBLEM ..." or SEARCH=all the
# fixed set-ups of these are searched before, and replace those in tests/study/one-number.txt.  CERTIFY: numbers for --vary with
# which the bound of the error is judged; of two and more also its sources.
set -eu
B=${B:-build}
here=$(dirname "$0")
fixed=$here/one-number.txt
mkdir -p "$B/study"

all='masses duffing pol stiff heat load damped switch relay rates tube'

search() { # search PROBLEM...: JOBS at a time; the rows of the others stay, and so do those of runs
    for problem in "$@"; do echo "$problem"; done |
        xargs -P "${JOBS:-2}" -I{} sh -c '"$0" {} >"$1/one-number-{}.txt"' "$B/study_one_number" "$B/study"
    for problem in $all; do
        case " $* " in
        *" $problem "*) cat "$B/study/one-number-$problem.txt" ;;
        *) grep "^[a-z]*,$problem," "$fixed" | grep -v ^run ;;
        esac
    done >"$B/study/one-number.txt"
    grep ^run "$fixed" >>"$B/study/one-number.txt" || true
    cp "$B/study/one-number.txt" "$fixed"
}

if [ "${SEARCH:-}" = all ]; then search $all; elif [ "${SEARCH:-}" ]; then search $SEARCH; fi
for python in python3 /usr/bin/python3; do command -v $python >/dev/null && break; done
passed=0
$python "$here/one_number.py" "$B/adaptive" "$@" || passed=$?
$python "$here/sure.py" "$B/adaptive" "$B/study" "$@" || passed=$?
[ $# = 0 ] || exit $passed
if command -v gnuplot >/dev/null; then $python "$here/card.py" "$B/study/card"; fi
$python tests/scripts/figures.py "$B" card blind facts restricted restricted-all one one-all one-cells one-sure one-pulse
exit $passed
