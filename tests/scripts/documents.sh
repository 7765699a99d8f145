#!/bin/sh
# SPDX-License-Identifier: MIT
# documents.sh [write] - what the documents name exists; write: first bring the sentences of statuses up to date.  Prints TAP; what is wrong stands below the line that fails.
#    links      files and headings that a document points to
#    names      functions, constants and keys of the headers in backquotes
#    commands   targets of make, and programs of build/ that have a source
#    extremes   each row of examples/EXTREMES.md is a test that prints one, and each such test has its row
#    words      README.md has at most 1 900
#    statuses   examples/TROUBLE.md has every status of the headers, by its number, with the sentence that P_message gives
# Reads CC.
set -u
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$top" || exit 1
documents=$(ls ./*.md examples/*.md examples/hosts/*.md tests/*.md tests/study/*.md)

report() { # report NAME: ok if standard input, what is wrong, is empty
    cat >"$dir/found"
    verdict=ok
    [ ! -s "$dir/found" ] || verdict='not ok'
    echo "$verdict" >>"$dir/verdicts"
    echo "$verdict $(wc -l <"$dir/verdicts" | tr -d ' ') - $1"
    sed 's/^/# /' "$dir/found" | head -40
}

# Headings as the anchors that a forge makes of them: small letters, no punctuation, hyphens for blanks.
anchors() {
    awk '/^```/ { fenced = !fenced } !fenced && /^#+ / { sub(/^#+ +/, ""); print tolower($0) }' "$1" | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}
links() { # lines "TARGET" of a document, without those in code
    awk '/^```/ { fenced = !fenced } !fenced && !/^    /' "$1" | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//' | grep -v '^[a-z]*:' | sort -u
}

for document in $documents; do
    links "$document" | while read -r target; do
        file=${target%%#*} anchor=${target#*#}
        path=$document
        [ -z "$file" ] || path=$(dirname "$document")/$file
        if [ ! -e "$path" ]; then
            echo "$document: no file $target"
        elif [ "$anchor" != "$target" ] && ! anchors "$path" | grep -qxF -e "$anchor"; then
            echo "$document: no heading $target"
        fi
    done
done | report 'files and headings that are pointed to'

# Words in backquotes that begin like names of the headers; * and .. stand for any letters.
cat waveform.h iqn.h rk.h examples/rk_proof.h >"$dir/headers"
for document in $documents; do
    grep -oE '`[^`]+`' "$document" | grep -oE '(^|[^A-Za-z0-9_./-])(wf|iqn|rk|WF|IQN|RK)_[A-Za-z0-9_]+[*.]?' | sed 's/^[^A-Za-z]//' | sort -u |
        while read -r name; do
            case $name in
            *_IMPLEMENTATION | *_STATIC | *_API | RK_ENSEMBLE) continue ;;
            *[*.] | *_) grep -qE "(^|[^A-Za-z0-9_])${name%[*.]}" "$dir/headers" ;;
            *) grep -qw -e "$name" "$dir/headers" ;;
            esac || echo "$document: $name"
        done
done | report 'names of the headers'

sed -n 's|^\([a-z]*\):[^=].*|\1|p; s|^\([a-z]*\):$|\1|p' Makefile tests/make/*.mk >"$dir/targets"
for document in $documents; do
    grep -oE '(`|^    )make [a-z]+([^a-z/]|$)' "$document" | sed 's/.*make //; s/[^a-z]//g' | sort -u | while read -r target; do
        grep -qx -e "$target" "$dir/targets" || echo "$document: make $target"
    done
    grep -oE '`build/[a-z0-9_]+[ `]|^    build/[a-z0-9_]+' "$document" | sed 's/.*build\///; s/[^a-z0-9_]//g' | sort -u | while read -r program; do
        find examples tests -name "$program.c" | grep -q . || echo "$document: build/$program"
    done
done | report 'targets and programs'

wc -w README.md | awk '$1 > 1900' | report 'README.md has at most 1 900 words'

# PROGRAM NAME, of the tests that print a row, and of the rows
for file in tests/test_*.c; do
    awk -v program="$(basename "$file" .c)" '/^TEST\(/ { name = $0; sub(/^TEST\(test_/, "", name); sub(/\).*/, "", name) }
        /EXTREME\(/ { print program, name }' "$file"
done | sort -u >"$dir/tests"
sed -n 's/.*| `\(test_[a-z]* [A-Za-z0-9_]*\)` |$/\1/p' examples/EXTREMES.md | sort -u >"$dir/rows"
diff "$dir/tests" "$dir/rows" | sed -n 's/^</a test without a row:/p; s/^>/a row without a test that prints it:/p' | report 'extremes: rows are tests, and tests are rows'

# NUMBER, NAME and sentence as rows of a table; a | in a sentence is \| there.
cat >"$dir/statuses.c" <<'END'
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"
#include <stdio.h>
static void row(int number, const char *name, const char *sentence)
{
    printf("| %d | `%s` | ", number, name);
    for (; *sentence; sentence++) printf(*sentence == '|' ? "\\|" : "%c", *sentence);
    puts(" |");
}
#define OF_WF(name, number, text) row(number, #name, wf_message(number));
#define OF_IQN(name, number, text) row(number, #name, iqn_message(number));
#define OF_RK(name, number, text) row(number, #name, rk_message(number));
int main(void)
{
    WF_STATUSES(OF_WF)
    IQN_STATUSES(OF_IQN)
    RK_STATUSES(OF_RK)
    return 0;
}
END
if $cc -I. "$dir/statuses.c" -o "$dir/statuses" -lm >"$dir/log" 2>&1; then
    "$dir/statuses" | sort >"$dir/said"
    if [ "${1:-}" = write ]; then # the last cell, what to do, stays
        awk -F ' [|] ' 'NR == FNR { said[$2] = $0; next } /^[|] -?[0-9]+ [|] / && $2 in said { sub(/ [|]$/, ""); print said[$2], $NF " |"; next } { print }' \
            "$dir/said" examples/TROUBLE.md >"$dir/written" && cp "$dir/written" examples/TROUBLE.md
    fi
    sed -nE 's/^(\| -?[0-9]+ \| `(WF|IQN|RK)_[A-Z]+` \| .* \|) [^|]*\|$/\1/p' examples/TROUBLE.md | sort >"$dir/told"
    diff "$dir/said" "$dir/told" | sed -n 's/^</to be written:/p; s/^>/to be taken out:/p' | report 'every status with its sentence'
else
    report 'every status with its sentence' <"$dir/log"
fi
echo "1..$(wc -l <"$dir/verdicts" | tr -d ' ')"
! grep -q not "$dir/verdicts"
