#!/bin/sh
# SPDX-License-Identifier: MIT
# page.sh - what can be tested of examples/page without a browser: every leaf of its decision tree compiles and runs; the
# program behind it has the published errors of the scene.  The rest: make pagetest.  Prints TAP; reads B, CC.
set -u
B=${B:-build}
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
count=0

report() { # report STATUS NAME
    count=$((count + 1))
    if [ "$1" = 0 ]; then echo "ok $count - $2"; else
        echo "not ok $count - $2"
        sed 's/^/# /' "$dir/out" | head -20
    fi
}

tree=$dir/tree.txt
sh "$top/examples/page/tree.sh" >"$tree"

# A program with all leaves, one behind the other: "- NAME" begins one, "| CALL" is a line of it.
awk '
    BEGIN { print "#include \"leaves.h\"\nint main(void)\n{" }
    /^- / { if (n++) print "    end();"; name = substr($0, 3); gsub(/"/, "\\\"", name); print "    begin(\"" name "\");" }
    /^\| / { print "    " substr($0, 3) }
    END { print "    end();\n    if (!G) return 1;\n    (void)status, (void)pairs, (void)history, (void)j;\n    return 0;\n}"; print n >"/dev/stderr" }
' "$tree" >"$dir/leaves.c" 2>"$dir/number"
number=$(cat "$dir/number")
{ "$cc" -std=c99 -Wall -Wextra -Wpedantic -Werror -O1 -I"$top" -I"$top/tests/page" "$dir/leaves.c" -o "$dir/leaves" -lm &&
    "$dir/leaves"; } >"$dir/out" 2>&1
report $? "decision tree: all $number leaves compile and run"

# Every marked line has one of the five marks; every leaf has calls.
awk '/^(#|-|\*+|\||>) / { if ($1 == "-") { if (leaf && !calls) bad = 1; leaf = 1; calls = 0 } if ($1 == "|") calls++; next } { print; bad = 1 }
     END { exit bad || !leaf || !calls }' "$tree" >"$dir/out" 2>&1
report $? 'decision tree: every line has a mark, every leaf its calls'

# Each row of the card is a leaf.
if [ -f "$top/examples/ACCURACY.md" ]; then
    rows=$(awk '/^<!-- figures card/ { card = 1 } /^<!-- end/ { card = 0 } card && /^\| 1e-/ { n++ } END { print n + 0 }' "$top/examples/ACCURACY.md")
    grep '^- 1e-' "$tree" >"$dir/out"
    [ "$rows" -gt 0 ] && [ "$(wc -l <"$dir/out")" = "$rows" ]
    report $? "decision tree: the $rows rows of the card"
fi

# The tables that tree.txt names are those that rk.h recommends.
awk 'FNR == 1 { file++ }
    file == 1 && /^      Which one:/ { list = 1; next }
    file == 1 && list && !/^         / { list = 0 }
    file == 1 && list { gsub(/[,:;]/, " "); for (i = 1; i <= NF; i++) recommended[$i] = 1 }
    file == 2 && match($0, /rk_find\("[a-z0-9]*"/) { n++; name = substr($0, RSTART + 9, RLENGTH - 10); if (!(name in recommended)) { print name; bad = 1 } }
    END { exit bad || n < 5 }' "$top/rk.h" "$top/examples/page/tree.txt" >"$dir/out" 2>&1
report $? 'decision tree: the Runge-Kutta tables of tree.txt are those that rk.h recommends'

# Window ends, sub-steps, cubic: the published errors, at the tolerance set
errors() { echo "$1" | "$B/masses" | awk 'NR == 2 { print $1, $2 }'; }
while read -r setting a b; do
    errors "$setting" >"$dir/out"
    awk -v a="$a" -v b="$b" 'function off(x, y) { return x / y - 1 > 1e-7 || y / x - 1 > 1e-7 } { exit off($1, a) || off($2, b) }' "$dir/out"
    report $? "masses, $setting: the published errors"
done <<END
5,5,100,1,0,0,0.5,1e-10,0,0,3 3.3437602237727053 1.7357639088739552
10,5,100,1,1,0,0.5,1e-10,0,0,3 0.0125680395524709 0.0121802269844953
20,5,100,3,1,3,0.5,1e-11,0,0,3 3.28319292609e-05 3.15984740062e-05
END
echo "1..$count"
