#!/bin/sh
# SPDX-License-Identifier: MIT
# figures.sh - the card examples/ACCURACY.md, its pictures and what the other documents take from the same data are what
# tests/study holds (figures.py --check); a figure, a datum or a script that changes alone is noticed; the card stays a card.
# Prints TAP.
set -u
top=$(cd "$(dirname "$0")/../.." && pwd)
for python in python3 /usr/bin/python3 ''; do command -v "${python:-true}" >/dev/null && break; done
[ "$python" ] || { echo '1..0 # SKIP python3 is not installed'; exit 0; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
count=0

report() { # report STATUS NAME
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else echo "not ok $count - $2"; sed 's/^/# /' "$dir/log"; fi
}
check() { (cd "$1" && $python -B tests/scripts/figures.py --check) >"$dir/log" 2>&1; }
notices() { # notices NAME FILE SED: a copy in which one file is changed fails
    rm -rf "$dir/copy"
    mkdir -p "$dir/copy/examples" "$dir/copy/tests/study" "$dir/copy/tests/scripts"
    cp "$top/README.md" "$top/rk.h" "$dir/copy"
    cp "$top"/examples/*.md "$top"/examples/*.svg "$dir/copy/examples"
    cp "$top"/tests/study/*.md "$top"/tests/study/*.txt "$top"/tests/study/card.* "$dir/copy/tests/study"
    cp "$top/tests/scripts/figures.py" "$dir/copy/tests/scripts"
    sed -i "$3" "$dir/copy/$2"
    ! cmp -s "$top/$2" "$dir/copy/$2" && ! check "$dir/copy"
    report $? "$1 is noticed"
}

check "$top"
report $? 'tables and pictures are those of the data in tests/study'
notices 'a figure of the card that was typed in' examples/ACCURACY.md 's/^| 1e-6 |\(.*\) 1\.[0-9]/| 1e-6 |\1 1.9/'
notices 'a run that is another' tests/study/one-number.txt 's/^run,masses,1e-06,.*/run,masses,1e-06,9e-7,9999/'
notices 'a map that was not drawn again' tests/study/converges.txt '$s/.$/9/'
notices 'a picture that is older than its script' tests/study/card.gp 's/What a digit costs/What it costs/'
lines=$(wc -l <"$top/examples/ACCURACY.md")
echo "$lines lines" >"$dir/log"
[ "$lines" -le 80 ]
report $? 'the card has at most 80 lines'
echo "1..$count"
