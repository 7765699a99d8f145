#!/bin/sh
# SPDX-License-Identifier: MIT
# same.sh [HEADER...] - the headers speak with one voice: what they share is the same text but for the prefix, in the same order.
# P_ stands for the prefix, wf_ iqn_ rk_ and in capitals.  Prints TAP; what differs stands below the line that fails.
#    first line "NAME.h - vVERSION of PROJECT - what it is": whoever finds a copy knows where it comes from
#    chapters   each header has those of the list below; those that several have come in the same order
#    statuses   a name (EARG) has the same number but for the hundreds, and a sentence with the same words up to the first colon;
#               errors -1 to -9 have one meaning in all headers
#    bits       finite, NaN and their loops are the same functions
#    vectors    the chapter "long vectors": a function, macro or paragraph in several headers is the same text
#    texts      the options before the include, P_message, the licence
set -u
top=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -gt 0 ] || set -- "$top/waveform.h" "$top/iqn.h" "$top/rk.h"
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
required='SYNOPSIS|WORDS|DOES NOT|COMPILE-TIME OPTIONS|statuses|to begin with|more|implementation|bits|long vectors|messages|NOTES|HISTORY|LICENSE'
bits='finite|nan|all_finite|bits'

names='' headers=$*
for h; do
    name=$(basename "$h" .h)
    names="$names $name"
    prefix=$(sed -n 's/.*defined(\([A-Z]*\)_IMPLEMENTATION).*/\1/p' "$h" | head -1)
    lower=$(echo "$prefix" | tr 'A-Z' 'a-z')
    sed -E "s/(^|[^A-Za-z])${prefix}_/\\1P_/g; s/(^|[^A-Za-z])${lower}_/\\1p_/g; s/(^|[^A-Za-z])${name}\\.h/\\1header.h/g" "$h" >"$dir/$name.h"
    # Chapters: rulers, and words in capitals at the margin of a comment.
    sed -En 's/^\/\* [-=]{4} ([^-=:]*[^-=: ]).*/\1/p; s/^   ([A-Z][A-Z -]*[A-Z])(  .*|,.*|)$/\1/p' "$dir/$name.h" | awk '!seen[$0]++' >"$dir/$name.chapters"
    # NUMBER NAME SENTENCE of the list of statuses
    awk '/^#define P_STATUSES/ { on = 1; next }
        on { line = $0; more = line ~ /\\ *$/; sub(/ *\\ *$/, "", line); sub(/^ */, "", line); text = text " " line }
        on && !more { exit }
        END {
            count = split(text, part, /(^| )(X|STATUS)\(/)
            for (i = 2; i <= count; i++) {
                name = number = part[i]
                sub(/,.*/, "", name); sub(/^P_/, "", name)
                sub(/^[^,]*, */, "", number); sub(/,.*/, "", number)
                sentence = part[i]; sub(/^[^"]*"/, "", sentence); sub(/"\) *$/, "", sentence); gsub(/" *"/, "", sentence)
                printf "%s%02d\t%s\t%s\n", number < 0 ? "-" : "", (number < 0 ? -number : number) % 100, name, sentence
            }
        }' "$dir/$name.h" >"$dir/$name.statuses"
    awk '/^\/\* [-=]+ long vectors/ { on = 1; print; next } on && /^\/\* [-=][-=][-=][-=] / { exit } on' "$dir/$name.h" >"$dir/$name.vectors"
    # A paragraph to a line, with the name that it defines in front.
    for what in h vectors; do
        awk 'BEGIN { RS = "" } {
                text = $0; gsub(/\n/, "\001", text)
                name = ""
                if (match(text, /(static|define|inline)[^;={\001]*[pP]__[A-Za-z0-9_]+/)) { name = substr(text, RSTART, RLENGTH); sub(/.*[pP]__/, "", name) }
                else if (match(text, /[pP]__[A-Za-z0-9_]+/)) name = substr(text, RSTART + 3, RLENGTH - 3)
                print name "\t" text
            }' "$dir/$name.$what" >"$dir/$name.$what.parts"
    done
    awk '/^   COMPILE-TIME OPTIONS/ { on = 1; print; next } on && (/^ *$/ || /^   [A-Z]/ || /\*\/$/) { exit } on' "$dir/$name.h" >"$dir/$name.options"
    sed -n '/^P_API const char \*p_message(int status)$/,/^}/p' "$dir/$name.h" >"$dir/$name.message"
    sed -n '/Permission is hereby granted/,/\*\//p' "$dir/$name.h" | tr '\n' ' ' | sed 's/  */ /g; s/ *\*\/.*//' >"$dir/$name.licence"
done

report() { # report NAME: ok if standard input, what is wrong, is empty
    cat >"$dir/found"
    verdict=ok
    [ ! -s "$dir/found" ] || verdict='not ok'
    echo "$verdict" >>"$dir/verdicts"
    echo "$verdict $(wc -l <"$dir/verdicts" | tr -d ' ') - $1"
    sed 's/^/# /' "$dir/found" | head -40
}

each() { for name in $names; do echo "$dir/$name.$1"; done; }

for name in $names; do
    echo "$required" | tr '|' '\n' | while read -r chapter; do
        grep -qi "$chapter" "$dir/$name.chapters" || echo "no chapter: $chapter"
    done | report "$name.h: the chapters that every header has"
done

for h in $headers "$(dirname "$0")/../../examples/rk_proof.h"; do
    version=$(awk '/^#define [A-Z_]+_VERSION [0-9]/ { printf "%d.%d.%d", $3 / 10000, $3 / 100 % 100, $3 % 100; exit }' "$h")
    sed -n 3p "$h" | grep -q "^   ${h##*/} - v$version of waveform-iqn-rk - " || echo "${h##*/}, line 3: $(sed -n 3p "$h")"
done | report 'the first line: name, version, project'

# shellcheck disable=SC2046
awk '{ file = FILENAME; sub(/.*\//, "", file); sub(/\..*/, "", file); at[file, $0] = FNR; in_file[$0] = in_file[$0] " " file }
    END {
        for (a in in_file) for (b in in_file) {
            if (a >= b) continue
            split(in_file[a], files, " ")
            before = after = ""
            for (i in files) if ((files[i], b) in at) {
                if (at[files[i], a] < at[files[i], b]) before = before " " files[i]
                else after = after " " files[i]
            }
            if (before && after) print a ", " b ": in this order in" before ", the other way round in" after
        }
    }' $(each chapters) | report 'chapters come in the same order'

# shellcheck disable=SC2046
awk -F '\t' '{ file = FILENAME; sub(/.*\//, "", file); sub(/\..*/, "", file)
        if ($2 in number && number[$2] != $1) print $2 ": " number[$2] " in " first[$2] ", " $1 " in " file
        start = $3; sub(/:.*/, "", start)
        if ($2 in text && text[$2] != start) print $2 ": \"" text[$2] "\" in " first[$2] ", \"" start "\" in " file
        if ($3 in owner && owner[$3] != $2) print "\"" $3 "\" is " owner[$3] " and " $2
        owner[$3] = $2
        if (!($2 in number)) { number[$2] = $1; text[$2] = start; first[$2] = file }
        if ($1 ~ /^-0/ && $1 in meaning && meaning[$1] != $2) print $1 ": " meaning[$1] " and " $2
        meaning[$1] = $2 }' \
    $(each statuses) | report 'statuses: one meaning to a name and a number'
for name in $names; do [ -s "$dir/$name.statuses" ] || echo "$name.h: no list of statuses"; done | report 'each header has its list of statuses'

same() { # same SUFFIX NAMES: parts whose names match and that several headers have are the same text
    # shellcheck disable=SC2046
    awk -F '\t' -v names="^($2)\$" '{ file = FILENAME; sub(/.*\//, "", file); sub(/\..*/, "", file) }
        $1 !~ names || done[file, $1]++ { next }
        $1 in text && text[$1] != $2 { print "p__" $1 " of " first[$1] " and of " file
            a = text[$1]; b = $2; gsub(/\001/, "\n", a); gsub(/\001/, "\n", b); print a; print "--"; print b }
        !($1 in text) { text[$1] = $2; first[$1] = file }' $(each "$1")
}
same h.parts "$bits" | report 'bits are the same functions'
same vectors.parts '.*' | report 'long vectors are the same text'
for name in $names; do [ -s "$dir/$name.vectors" ] || echo "$name.h: no chapter \"long vectors\""; done | report 'each header has the chapter "long vectors"'

for what in options message licence; do
    set -- $names
    one=$1
    shift
    for name; do diff "$dir/$one.$what" "$dir/$name.$what" >"$dir/diff" || { echo "$one.h and $name.h"; cat "$dir/diff"; }; done |
        report "the same text: $what"
done
echo "1..$(wc -l <"$dir/verdicts" | tr -d ' ')"
! grep -q not "$dir/verdicts"
