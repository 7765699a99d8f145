#!/bin/sh
# SPDX-License-Identifier: MIT
# kit.sh - does kit.f90 say what the headers say?  Both are brought to one form - every function with a letter for its
# result and each argument (p pointer, d double, i int, l long), the members of the structs, every constant and its value - and
# compared.  Prints the differences: < in the headers, > in kit.f90.  Reads CC, FC (gfortran, for its -fc-prototypes).
set -eu
cc=${CC:-cc} fc=${FC:-gfortran}
here=$(cd "$(dirname "$0")" && pwd)
top=$here/../..
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"

for h in waveform iqn rk; do "$cc" -E -P "$top/$h.h"; done | tr '\n\t' '  ' >headers
"$fc" -std=f2008 -fsyntax-only -fc-prototypes "$here/kit.f90" | grep -v '^#' | tr '\n\t' '  ' >prototypes

functions() { # functions FILE: one line per function
    sed 's/;/;\n/g' "$1" | sed 's/.*}//; s/^ *extern *//' | awk '
        function letter(t) { return t ~ /[*\[]/ ? "p" : t ~ /double/ ? "d" : t ~ /size_t|ptrdiff_t|long/ ? "l" : t ~ /int/ ? "i" : "?" }
        /^[a-z_ *]*[ *](wf|iqn|rk)_[a-z_]+ *\(.*\) *;/ && !/typedef/ && !/iqn_sum *\(/ {
            open = index($0, "(")
            head = substr($0, 1, open - 1)
            sub(/ *$/, "", head)
            name = head
            sub(/.*[ *]/, "", name)
            args = substr($0, open + 1)
            sub(/\) *;.*/, "", args)
            out = letter(substr(head, 1, length(head) - length(name))) " "
            if (args !~ /^ *(void)? *$/) {
                n = split(args, a, ",")
                for (i = 1; i <= n; i++) out = out letter(a[i])
            }
            print name, out
        }'
    grep -o 'typedef struct [a-z_]\{1,\} *{[^}]*}' "$1" | while read -r _ _ name members; do # structs: one line each
        echo "$members" | sed 's/[{}]//g; s/;/;\n/g' | awk -v name="$name" '
            /[a-z]/ {
                c = /\*/ ? "p" : /double/ ? "d" : "i"
                sub(/;.*/, "")
                n = split($0, a, ",")
                for (i = 1; i <= n; i++) out = out c (match(a[i], /\[.*\]/) ? substr(a[i], RSTART, RLENGTH) : "")
            }
            END { print "struct", name, out }'
    done
}

names=$(grep -o 'enum *{[^}]*}' headers | sed 's/enum *{//; s/}//' | tr ',' '\n' | sed 's/=.*//' | tr -d ' ')
{
    for h in waveform iqn rk; do echo "#include \"$top/$h.h\""; done
    echo '#include <stdio.h>'
    printf '%s\n' '#define SAY(name) printf("%s %d\n", #name, name);'
    echo 'int main(void) {'
    for n in $names; do echo "SAY($n)"; done
    echo 'return 0; }'
} >constants.c
"$cc" constants.c -o constants
{ functions headers; ./constants | tr 'A-Z' 'a-z'; } | sort >a
{ functions prototypes; sed -n '/integer(c_int), parameter/,/[^&]$/p' "$here/kit.f90" | grep -o '[a-z_0-9]* = -*[0-9]*' |
    sed 's/ = / /; s/\(_.*\)_constant /\1 /'; } | sort >b
[ "$(wc -l <a)" -gt 60 ] && diff a b
