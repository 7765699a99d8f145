#!/bin/sh
# SPDX-License-Identifier: MIT
# snippets.sh - what is printed for copying works: every code block of README.md, ACCURACY.md, TROUBLE.md and EXTREMES.md,
# every SYNOPSIS of the headers and every recipe of rk.h, as it stands, in the surroundings that tests/scripts/snippets.txt
# pairs it with, compiled as C99 and as C++11 and run; each compares numbers with an answer found another way.  A block without
# a pair fails, and so does a pair without a block.  In a document a block is fenced, or indented by four columns after an
# empty line; in a SYNOPSIS the lines indented by six or more, in RECIPES by nine.  Prints TAP; reads CC, CXX.
set -u
cc=${CC:-cc} cxx=${CXX:-c++}
warn='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror'
top=$(cd "$(dirname "$0")/../.." && pwd)
pairs=${1:-$top/tests/scripts/snippets.txt}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
count=0

# Blocks to DOCUMENT.1, DOCUMENT.2, ..
readme() {
    awk -v out="${1##*/}." '
        /^```/ { fenced = !fenced; if (fenced) n++; next }
        !fenced && /^    / && (indented || empty) { if (!indented) n++; indented = 1; print substr($0, 5) >(out n); next }
        { empty = /^$/; if (!empty) indented = 0 }
        fenced { print >(out n) }' "$top/$1"
}
synopsis() {
    awk -v out="$1.1" '
        /^   SYNOPSIS$/ { inside = 1; next }
        inside && /^   [A-Z][A-Z -]+/ { exit }
        inside && /^      / { print substr($0, 7) >out }
        inside && /^$/ { print >out }' "$top/$1"
}
# The code of each recipe, lines indented by nine or more, to DOCUMENT.2, DOCUMENT.3, ..
recipes() {
    awk -v out="$1." '
        BEGIN { n = 1 }
        /^\/\* ---- RECIPES/ { inside = 1; next }
        /^\/\* ---- NOTES/ { exit }
        inside && /^   [A-Z]/ { fresh = 1 }
        inside && /^         / { if (fresh) n++; fresh = 0; print substr($0, 10) >(out n) }' "$top/$1"
}
readme README.md
readme examples/ACCURACY.md
for h in waveform iqn rk; do synopsis $h.h; done
recipes rk.h
readme examples/TROUBLE.md
readme examples/EXTREMES.md

# Pairs to pair.1, pair.2, ..; their first lines "## DOCUMENT: text of the block" and "## what to do" to a list.
awk '/^## / && !again { n++; print substr($0, 4) >"list"; again = 1; next }
     /^## / { print substr($0, 4) >"list"; again = 0; printf "" >("pair." n); next }
     n && !again { print >("pair." n) }' "$pairs"

report() { # report OK NAME
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else echo "not ok $count - $2"; sed 's/^/# /' log | head -20; fi
}
language() { # language NAME SUFFIX COMPILE...: builds and runs whole.SUFFIX
    name=$1 suffix=$2
    shift 2
    cp whole "whole.$suffix"
    { "$@" "whole.$suffix" -o "whole_$suffix" -lm && "./whole_$suffix"; } >log 2>&1
    report $? "$name"
}

cp "$top/waveform.h" "$top/iqn.h" "$top/rk.h" "$top/tests/scripts/recipes.h" .
k=0
while IFS= read -r which && IFS= read -r action; do
    k=$((k + 1))
    document=${which%%: *} text=${which#*: }
    found=$(grep -lF -e "$text" "$document".[0-9]* 2>/dev/null)
    if [ "$(echo "$found" | grep -c .)" != 1 ]; then
        echo "found in: $found" >log
        report 1 "$document: one block with \"$text\""
        continue
    fi
    awk -v block="$found" '$0 == "@" { while ((getline line <block) > 0) print line; next } { print }' "pair.$k" >whole
    mv "$found" "done.$found"
    case $action in
    c | 'c todo')
        todo=${action#c}
        language "$document: $text (C99)${todo:+ # TODO}" c $cc -std=c99 $warn -O2 -I.
        language "$document: $text (C++11)${todo:+ # TODO}" cc $cxx -std=c++11 $warn -O2 -I.
        [ -f "whole.$document" ] || cp whole "whole.$document" # the first: the SYNOPSIS
        ;;
    sh)
        CC=$cc TOP=$top sh -e whole >log 2>&1
        report $? "$document: $text"
        ;;
    elsewhere*) count=$((count + 1)) && echo "ok $count - $document: $text # SKIP $action" ;;
    *) echo "$action" >log && report 1 "$document: $text: known action" ;;
    esac
done <list

# The SYNOPSIS of rk.h is right for every explicit table with a pair
for name in heun midpoint ssp33 ssp43 ssp104 bs3 ss4 tsit5 verner6; do
    sed "s/\"dp5\"/\"$name\"/" whole.rk.h >whole
    language "rk.h: the SYNOPSIS with $name" c $cc -std=c99 $warn -O2 -I.
done

for left in README.md.* ACCURACY.md.* TROUBLE.md.* EXTREMES.md.* waveform.h.* iqn.h.* rk.h.*; do
    [ -f "$left" ] || continue
    head -3 "$left" >log
    report 1 "$left is paired in tests/scripts/snippets.txt"
done
echo "1..$count"
