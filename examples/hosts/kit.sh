#!/bin/sh
# SPDX-License-Identifier: MIT
# kit.sh write - make the interfaces in kit.f90 and kit.py, between two marks, from the headers.
# kit.sh       - are they what the headers say?  Then the compilers' view of them: gfortran's
#                prototypes of kit.f90 and the ctypes of kit.py are brought to one form with the
#                headers - every function with a letter for its result and each argument (p pointer,
#                d double, i int, l long), the members of the structs, every constant and its value
#                - and compared.  Prints TAP, fails if one check does; differences as < in the
#                headers, > in the kit.
# Reads CC, FC (gfortran, for its -fc-prototypes), PYTHON (or the first python3 with NumPy); a check
# without its tool is skipped.
set -u
cc=${CC:-cc} fc=${FC:-gfortran}
for python in "${PYTHON:-python3}" /usr/bin/python3; do # Debian's, where another one is first
    "$python" -c 'import numpy' >/dev/null 2>&1 && break
done
here=$(cd "$(dirname "$0")" && pwd)
top=$here/../..
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1

# ---- the headers, one declaration a line --------------------------------------------------------

for h in waveform iqn rk; do
    echo "header $h;"
    "$cc" -E -P "$top/$h.h" || exit 1
done | tr '\n\t' '  ' | sed 's/  */ /g' >text

constants() { # NAME VALUE
    {
        for h in waveform iqn rk; do echo "#include \"$top/$h.h\""; done
        echo '#include <stdio.h>'
        printf '%s\n' '#define SAY(name) printf("%s %d\n", #name, name);' 'int main(void) {'
        grep -o 'enum *{[^}]*}' text | sed 's/enum *{//; s/}//' | tr ',' '\n' | sed 's/=.*//' |
            tr -d ' ' | grep -v -e '__' -e '^$' | sed 's/.*/SAY(&)/'
        echo 'return 0; }'
    } >constants.c
    "$cc" constants.c -o constants && ./constants
}
constants >named || exit 1

{ # struct NAME MEMBERS; callback RESULT|NAME|ARGUMENTS; function RESULT|NAME|ARGUMENTS
    grep -o 'typedef struct [a-z_]* { *[^}]*}' text |
        sed 's/typedef //; s/[{}]//g; s/ *; */; /g; s/; $//'
    sed 's/;/;\n/g' text | sed 's/.*} *//; s/^ *extern *//; s/^ *//' | awk '
        /^header/ { print }
        match($0, /^[a-z_ *]*[ *](wf|iqn|rk)_[a-z_0-9]+ *\(/) {
            kind = sub(/^typedef /, "") ? "callback" : "function"
            head = substr($0, 1, index($0, "(") - 1)
            args = substr($0, index($0, "(") + 1)
            sub(/ *\) *;.*/, "", args)
            name = head
            sub(/.*[ *]/, "", name)
            print kind " " substr(head, 1, length(head) - length(name)) "|" name "|" args
        }'
} | sed 's/;$//' >declared

# ---- written in Python and in Fortran ------------------------------------------------------------

wrap() { # lines of at most 98 columns, broken after a comma or semicolon; wrap CONTINUED INDENT
    awk -v continued="$1" -v indent="$2" '{
        line = $0
        while (length(line) > 98) {
            most = 98 - length(continued)
            for (i = most; i > 1 && substr(line, i - 1, 2) !~ /[,;] /; i--) {}
            if (i <= length(indent) + 1) for (i = most; i > 1 && substr(line, i, 1) != " "; i--) {}
            if (i <= length(indent) + 1) break
            print substr(line, 1, i - 1) continued
            line = indent substr(line, i + 1)
        }
        print line
    }'
}

write_python() {
    versions=$(for h in waveform iqn rk; do
        sed -n "s/^#define [A-Z]*_VERSION \([0-9]*\).*/$h.h \1, /p" "$top/$h.h"; done | tr -d '\n')
    echo "_versions = \"${versions%, }\""
    echo '_constants = """'
    tr '\n' ' ' <named | sed 's/\([^ ]*\) \([^ ]*\) /\1 \2, /g; s/, $//' | wrap '' ''
    printf '"""\n_declarations = """\n'
    sed -n 's/^struct \([a-z_]*\) *\(.*\)/struct \1 {\2;};/p
        s/^callback \(.*\)|\(.*\)|\(.*\)/typedef \1\2(\3);/p
        s/^function \(.*\)|\(.*\)|\(.*\)/\1\2(\3);/p' declared | tr '\n' ' ' | sed 's/ $//' |
        wrap '' ''
    echo '"""'
}

write_fortran() {
    awk '{  list = list (list ? ", " : "") tolower($1) " = " $2
            if (++n % 60 == 0) { print "    integer(c_int), parameter :: " list; list = "" }
        }
        END { if (list) print "    integer(c_int), parameter :: " list }' named |
        wrap ' &' '        '
    nullable=' iqn_halve.x iqn_pair.v iqn_pair.w rk_combine.y rk_update.ynew rk_update.err iqn_best.x iqn_best.hx '
    awk -v nullable="$nullable rk_norm.size " '
        function put(line) { print substr("                    ", 1, deep) line }
        function last(text) { sub(/\[.*/, "", text); sub(/.*[ *]/, "", text); return text }
        function simple(text) { # the Fortran type of a C type without its stars
            if (text ~ /double/) return "real(c_double)"
            if (text ~ /size_t/) return "integer(c_size_t)"
            if (text ~ /ptrdiff_t/) return "integer(kit_long)"
            return text ~ /int/ ? "integer(c_int)" : "?"
        }
        function argument(text, place,    stars, base, direction) { # declaration, up to the name
            stars = gsub(/[*\[]/, "&", text)
            base = text
            sub(/^ *(const )?/, "", base)
            sub(/[ *].*/, "", base)
            direction = text ~ /^ *const/ ? "intent(in)" : "intent(inout)"
            if (!stars) return simple(text) ", value :: "
            if (index(nullable, " " place " ")) return "type(c_ptr), value :: "
            if (base in called) return "type(c_funptr), value :: "
            if (base in struct) return "type(" base "), " direction " :: "
            if (base == "char") return "character(kind=c_char), intent(in) :: "
            if (base ~ /^(wf|iqn)$/ && stars > 1) return "type(c_ptr), intent(out) :: "
            if (base ~ /^(wf|iqn)$/) return "type(c_ptr), value :: "
            if (base == "void" && text !~ /mem/) return "type(c_ptr), value :: "
            if (base == "void") return "real(c_double), intent(inout), target :: "
            return stars == 1 ? simple(text) ", " direction " :: " : "type(c_ptr), intent(in) :: "
        }
        function routine(result, name, args,    n, i, a, names, kind, before) {
            n = args ~ /^ *(void)? *$/ ? 0 : split(args, a, ", *")
            for (i = 1; i <= n; i++)
                names = names (i > 1 ? ", " : "") (last(a[i]) == "T" ? "tab" : last(a[i]))
            result = result ~ /\*/ ? "type(c_ptr)" : simple(result)
            put(result " function " name "(" names ") bind(c)")
            deep += 4
            put("import")
            before = ""
            for (i = 1; i <= n; i++) {
                kind = argument(a[i], name "." last(a[i]))
                text = last(a[i]) == "T" ? "tab" : last(a[i])
                if (kind !~ /value|^type|c_ptr/ || a[i] ~ /\*const \*/) text = text "(*)"
                if (kind == before) line = line ", " text
                else {
                    if (before) put(line)
                    line = kind text
                }
                before = kind
            }
            if (before) put(line)
            deep -= 4
            put("end function")
        }
        function members(text,    n, i, j, m, item, a, base, list) {
            n = split(text, m, ";")
            for (i = 1; i <= n; i++) {
                base = m[i] ~ /\*/ ? "type(c_ptr)" : simple(m[i])
                list = m[i]
                sub(/^ *(const |signed )*[a-z_]+ /, "", list)
                gsub(/[* ]/, "", list)
                gsub(/\[/, "(", list)
                gsub(/\]/, ")", list)
                put(base " :: " tolower(list))
            }
        }
        BEGIN { deep = 4 }
        /^struct/ {
            struct[$2] = 1
            text = $0
            sub(/^struct [a-z_]* */, "", text)
            put("type, bind(c) :: " $2)
            deep = 8
            members(text)
            deep = 4
            put("end type")
            next
        }
        /^header/ { header = "! " $2 ".h"; next }
        {
            kind = $1
            sub(/^[a-z]* /, "")
            split($0, part, "|")
            if (kind == "callback") called[part[2]] = 1
            kinds[++count] = kind
            texts[count] = $0
            headers[count] = header
        }
        END {
            put("abstract interface")
            deep = 8
            for (i = 1; i <= count; i++) if (kinds[i] == "callback") {
                split(texts[i], part, "|")
                routine(part[1], part[2], part[3])
            }
            deep = 4
            put("end interface")
            put("interface")
            deep = 8
            for (i = 1; i <= count; i++) if (kinds[i] == "function") {
                if (headers[i] != headers[i - 1]) put(headers[i])
                split(texts[i], part, "|")
                routine(part[1], part[2], part[3])
            }
            deep = 4
            put("end interface")
        }' declared | wrap ' &' '                '
}

renewed() { # renewed FILE WRITER: the file with what stands between its marks written anew
    $2 >made
    awk '/made from the headers: end/ { inside = 0 }
        !inside { print }
        /made from the headers: begin/ {
            inside = 1
            while ((getline line <"made") > 0) print line
        }' "$here/$1"
}

if [ "${1:-}" = write ]; then
    renewed kit.f90 write_fortran >kit.f90 && cp kit.f90 "$here/kit.f90"
    renewed kit.py write_python >kit.py && cp kit.py "$here/kit.py"
    exit
fi

# ---- checked -------------------------------------------------------------------------------------

functions() { # functions FILE: one line per function and per struct
    sed 's/;/;\n/g' "$1" | sed 's/.*}//; s/^ *extern *//' | awk '
        function letter(t) {
            if (t ~ /[*\[]/) return "p"
            if (t ~ /double/) return "d"
            if (t ~ /size_t|ptrdiff_t|long/) return "l"
            return t ~ /int/ ? "i" : "?"
        }
        /^[a-z_ *]*[ *](wf|iqn|rk)_[a-z_0-9]+ *\(.*\) *;/ && !/typedef/ {
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
    grep -o 'typedef struct [a-z_]\{1,\} *{[^}]*}' "$1" | while read -r _ _ name members; do
        echo "$members" | sed 's/[{}]//g; s/;/;\n/g' | awk -v name="$name" '
            /[a-z]/ {
                c = /\*/ ? "p" : /double/ ? "d" : /size_t|ptrdiff_t|long|int64|intptr/ ? "l" : "i"
                sub(/;.*/, "")
                n = split($0, a, ",")
                for (i = 1; i <= n; i++)
                    out = out c (match(a[i], /\[.*\]/) ? substr(a[i], RSTART, RLENGTH) : "")
            }
            END { print "struct", name, out }'
    done
}

count=0 failed=0
check() { # check NAME COMMAND...
    name=$1
    shift
    count=$((count + 1))
    if "$@" >log 2>&1; then echo "ok $count - $name"; else
        echo "not ok $count - $name"
        failed=1
        head -40 log | sed 's/^/# /'
    fi
}
skip() {
    count=$((count + 1))
    echo "ok $count - $1 # SKIP not here; Debian has it in $2"
}

fresh() {
    renewed "$1" "$2" >anew
    diff anew "$here/$1" || { echo "run: sh examples/hosts/kit.sh write"; return 1; }
}
check 'kit.f90 is what kit.sh write makes' fresh kit.f90 write_fortran
check 'kit.py is what kit.sh write makes' fresh kit.py write_python

callbacks=$(sed -n 's/^callback [^|]*|\([^|]*\)|.*/\1/p' declared | tr '\n' '|')
functions text | grep -vE "^(${callbacks}none) " >headers
tr 'A-Z' 'a-z' <named >>headers
sort -o headers headers
check 'the headers have their functions' sh -c '[ "$(wc -l <headers)" -gt 150 ]'

fortran() {
    "$fc" -std=f2008 -fsyntax-only -fc-prototypes "$here/kit.f90" | grep -v '^#' |
        tr '\n\t' '  ' >prototypes
    { functions prototypes | grep -vE "^(${callbacks}none) "
      sed -n '/integer(c_int), parameter/,/[^&]$/p' "$here/kit.f90" |
          grep -o '[a-z_0-9]* = -*[0-9]*' |
          sed 's/ = / /'; } | sort >kit
    diff headers kit
}
if "$fc" -fsyntax-only -fc-prototypes "$here/kit.f90" >/dev/null 2>&1; then
    check 'gfortran sees in kit.f90 what the headers say' fortran
else
    skip 'gfortran sees in kit.f90 what the headers say' gfortran
fi

ctypes() {
    if [ -z "${KIT_LIBRARY:-}" ]; then
        "$cc" -shared -fPIC -DWF_IMPLEMENTATION -DIQN_IMPLEMENTATION -DRK_IMPLEMENTATION -x c \
            "$top/waveform.h" "$top/iqn.h" "$top/rk.h" -x none -lm -o libkit.so || return 1
        export KIT_LIBRARY="$dir/libkit.so"
    fi
    PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$here "$python" -c '
import ctypes, kit
letters = {ctypes.c_int: "i", ctypes.c_double: "d", ctypes.c_size_t: "l", ctypes.c_ssize_t: "l"}
letter = lambda t: letters.get(t, "p")
for name, value in sorted(vars(kit).items()):
    if isinstance(value, ctypes._CFuncPtr):
        print(name, letter(value.restype), "".join(map(letter, value.argtypes)))
    elif isinstance(value, type) and issubclass(value, ctypes.Structure):
        array = lambda t: issubclass(t, ctypes.Array)
        member = lambda t: letter(t._type_) + f"[{t._length_}]" if array(t) else letter(t)
        print("struct", name, "".join(member(t) for _, t in value._fields_))
    elif isinstance(value, int) and name.startswith(("WF_", "IQN_", "RK_")):
        print(name.lower(), value)' | sed 's/ $//' | sort >kit
    sed 's/ $//' headers | sort | diff - kit
}
if "$python" -c 'import numpy' >/dev/null 2>&1; then
    check 'ctypes sees in kit.py what the headers say' ctypes
else
    skip 'ctypes sees in kit.py what the headers say' python3-numpy
fi
echo "1..$count"
exit $failed
