#!/bin/sh
# SPDX-License-Identifier: MIT
# tree.sh [CARD] - the decision tree: tree.txt, with its line @card replaced by one leaf for each row of the card, the table
# of calls in ../ACCURACY.md.  So no call stands in two places.
set -eu
cd "$(dirname "$0")"
card=${1:-../ACCURACY.md}
[ -f "$card" ] || card=/dev/null

leaves() {
    awk -F'|' '
        function quoted(text, start) { # the first `...` in text that starts so
            while (match(text, /`[^`]*`/)) {
                found = substr(text, RSTART + 1, RLENGTH - 2)
                if (index(found, start) == 1) return found
                text = substr(text, RSTART + RLENGTH)
            }
            return ""
        }
        /^<!-- figures card/ { card = 1; next }
        /^<!-- end/ { card = 0 }
        card && /^\| error/ { for (i = 2; i < NF; i++) if ($i ~ /stiff/) stiff = i }
        card && /^\| 1e-/ {
            error = $2
            gsub(/ /, "", error)
            data = quoted($0, "wf_make(")
            sub(/wf_make\(\.\., /, "wf_make(\\&w, n, ", data)
            sub(/, \.\.\)/, ", columns, mem, sizeof mem)", data)
            if (!n++) print "** The error to reach, relative to the largest value"
            print "- " error
            print "| " data ";"
            if ($0 ~ /WF_SLOPE/) print "| wf_push(w, t1, WF_SLOPE); /* at the end of each step */"
            else print "| rk_dense(&step, 0.25, 0, v); /* and at 0.5, 0.75, 1 of each step */"
            print "| " quoted($0, "iqn_set(") ";"
            method = ""
            while (match($stiff, /`[a-z0-9]+`/)) {
                method = substr($stiff, RSTART + 1, RLENGTH - 2)
                $stiff = substr($stiff, RSTART + RLENGTH)
            }
            print "| T = " quoted($0, "rk_find(") ";" (method == "" ? "" : " /* a stiff side: " method " */")
        }' "$card"
}
leaves | awk '/^@card/ { while ((getline line < "-") > 0) print line; next } { print }' tree.txt
