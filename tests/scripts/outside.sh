#!/bin/sh
# SPDX-License-Identifier: MIT
# outside.sh - the headers as somebody else's compilers and linkers see them.  Prints TAP; reads CC, CXX.
#    names      declared = defined = exported by the C++ build, unmangled = in kit.f90 = in kit.py, function by function;
#               and each is called from a file without implementation, C and C++, linked with the C and the C++ objects
#    machines   clang's view for processors that are not here: no warning.  Syntax alone, with a libc of three small headers
#    casts      the implementation with -Wcast-qual as C, with -Wold-style-cast and -Wcast-qual as C++
#    prototypes with -Wmissing-prototypes as C, -Wmissing-declarations as C++
set -u
cc=${CC:-cc} cxx=${CXX:-c++}
warn='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror'
top=$(cd "$(dirname "$0")/../.." && pwd)
hosts=$top/examples/hosts
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
count=0

check() { # check NAME COMMAND...: ok when the command succeeds
    name=$1
    shift
    count=$((count + 1))
    if "$@" >log 2>&1; then echo "ok $count - $name"; else
        echo "not ok $count - $name"
        sed 's/^/# /' log | head -20
    fi
}
skip() { # skip NAME WHAT
    count=$((count + 1))
    echo "ok $count - $1 # SKIP no $2 here"
}
here() { command -v "$1" >/dev/null; }

prefix() { case $1 in waveform) echo wf ;; *) echo "$1" ;; esac; }

# ---- one list of functions from each side ----------------------------------------------------------------------------

functions='(wf|iqn|rk)_[a-z0-9_]+'
declared() { # declared HEADER: what the header alone declares; types of functions left out
    echo "#include \"$top/$1.h\"" | $cc -I"$top" -E -P -x c - | tr '\n' ' ' | sed 's/typedef[^;{]*;//g' | grep -oE "$functions *\(" | tr -d '( ' | sort -u
}
defined() { # defined OBJECT: its public functions
    nm -g --defined-only "$1" | awk '$2 == "T" { sub(/^_/, "", $3); print $3 }' | sort -u
}
in_fortran() { # but the types of callbacks
    sed -n '/end interface/,$p' "$1" | sed -nE "s/.* function ($2_[a-z0-9_]+)\(.*bind\(c\).*/\1/p" | sort -u
}
in_python() { # what stands between the marks, but types
    sed -n '/^_declarations/,/^"""/p' "$1" | tr '\n' ' ' | sed 's/typedef[^;{]*;//g' | grep -oE "$2_[a-z0-9_]+ *\(" | tr -d '( ' | sort -u
}
same() { # same FILE FILE: two lists; < is in the first alone
    [ -s "$1" ] && diff "$1" "$2"
}

# Every function by its address, with its own type: declared means usable.
caller() { # caller LIST: a C file, a C++ file
    {
        for h in waveform iqn rk; do echo "#include \"$h.h\""; done
        echo 'typedef void any(void);'
        echo '#ifdef __cplusplus'
        echo '#define ANY(f) reinterpret_cast<any *>(f)'
        echo '#else'
        echo '#define ANY(f) (any *)(f)'
        echo '#endif'
        echo 'static any *const functions[] = {'
        sed 's/.*/    ANY(&),/' "$1"
        echo '};'
        echo 'int main(void) {'
        echo '    unsigned i;'
        echo '    for (i = 0; i < sizeof functions / sizeof *functions; i++) if (!functions[i]) return 1;'
        echo "    return i == $(wc -l <"$1") ? 0 : 1;"
        echo '}'
    } >caller.c
    cp caller.c caller.cc
}

declared examples/rk_proof >proof # the comments of rk.h speak of its functions, too
for h in waveform iqn rk; do
    p=$(prefix $h)
    echo "#define $(echo $p | tr a-z A-Z)_IMPLEMENTATION" >$h.c
    echo "#include \"$h.h\"" >>$h.c
    cp $h.c $h.cc
    $cc -std=c99 -O0 -I"$top" -c $h.c -o $h.o && $cxx -std=c++11 -O0 -I"$top" -c $h.cc -o ${h}_cc.o || exit 1
    declared $h | grep "^${p}_" >$h.declared
    cat $h.declared >>all
    if here nm; then
        defined $h.o >$h.defined
        defined ${h}_cc.o >$h.exported
        check "$h.h: what is defined is declared" same $h.declared $h.defined
        check "$h.h: as C++ the same names, none mangled" same $h.declared $h.exported
    else
        skip "$h.h: what is defined is declared" nm
    fi
    in_fortran "$hosts/kit.f90" $p >$h.fortran
    in_python "$hosts/kit.py" $p >$h.python
    check "$h.h: kit.f90 has these functions" same $h.declared $h.fortran
    check "$h.h: kit.py has these functions" same $h.declared $h.python
    # A function with a comment and without a prototype would be in no list: names that comments of the public part use are those
    # of functions, types, or macros of older names
    awk '/^#endif .*_H_INCLUDED/ { exit } { print }' "$top/$h.h" | grep -oE "\b${p}_[a-z0-9_]*[a-z0-9]\b" | grep -v __ | sort -u >$h.written
    sed -nE "s/^typedef .*\b(${p}_[a-z]+);.*/\1/p; s/^typedef [a-z]+ (${p}_[a-z]+)\(.*/\1/p; s/^} (${p}_[a-z]+);/\1/p; s/^ *# *define (${p}_[a-z0-9_]+).*/\1/p" "$top/$h.h" >$h.types
    echo ${p}_proof >>$h.types
    cat $h.declared $h.types proof | sort -u >$h.known
    check "$h.h: comments speak of functions that are declared" sh -c "! comm -23 $h.written $h.known | grep ."
done

caller all
check 'every function used from C, linked with C' sh -c "$cc -std=c99 $warn -I'$top' caller.c waveform.o iqn.o rk.o -lm -o by_c && ./by_c"
check 'every function used from C, linked with C++' sh -c "$cc -std=c99 -I'$top' -c caller.c -o caller_c.o && $cxx caller_c.o waveform_cc.o iqn_cc.o rk_cc.o -lm -o by_c && ./by_c"
check 'every function used from C++, linked with C' sh -c "$cxx -std=c++11 $warn -I'$top' caller.cc waveform.o iqn.o rk.o -lm -o by_cc && ./by_cc"
check 'every function used from C++, linked with C++' sh -c "$cxx -std=c++11 $warn -I'$top' caller.cc waveform_cc.o iqn_cc.o rk_cc.o -lm -o by_cc && ./by_cc"

# ---- warnings that a maintainer's own set has --------------------------------------------------------------------------

silent() { # silent COMMAND...: succeeds and says nothing
    "$@" >said 2>&1 && [ ! -s said ] || { head -4 said && echo "... $(grep -c 'warning:\|error:' said) in all" && false; }
}
compilers=$cc compilersxx=$cxx
here clang && [ "$(command -v clang)" != "$(command -v "$cc")" ] && compilers="$compilers clang"
here clang++ && [ "$(command -v clang++)" != "$(command -v "$cxx")" ] && compilersxx="$compilersxx clang++"
quiet='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion'
for h in waveform iqn rk; do
    for c in $compilers; do
        check "$h.h, $c -Wmissing-prototypes" silent $c -std=c99 -fsyntax-only $quiet -Wmissing-prototypes -I"$top" $h.c
        check "$h.h, $c -Wcast-qual" silent $c -std=c99 -fsyntax-only $quiet -Wcast-qual -I"$top" $h.c
    done
    for c in $compilersxx; do
        check "$h.h, $c -Wmissing-declarations" silent $c -std=c++11 -fsyntax-only $quiet -Wmissing-declarations -I"$top" $h.cc
        check "$h.h, $c -Wold-style-cast -Wcast-qual" silent $c -std=c++11 -fsyntax-only $quiet -Wold-style-cast -Wcast-qual -I"$top" $h.cc
    done
done

# ---- other machines ----------------------------------------------------------------------------------------------------

# A libc for syntax: what C99 declares of what the headers use.
mkdir libc
cat >libc/math.h <<'END'
#ifdef __cplusplus
extern "C" {
#endif
#define HUGE_VAL __builtin_huge_val()
#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
double fabs(double), sqrt(double), pow(double, double), exp(double), log(double), log10(double), log2(double), floor(double), ceil(double);
double fmax(double, double), fmin(double, double), ldexp(double, int), frexp(double, int *), copysign(double, double);
double nextafter(double, double), hypot(double, double), cbrt(double), cos(double), sin(double), acos(double), atan2(double, double);
double scalbn(double, int), rint(double), round(double), trunc(double), fmod(double, double), expm1(double), log1p(double), fma(double, double, double);
int ilogb(double);
#ifdef __cplusplus
}
#endif
END
cat >libc/string.h <<'END'
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
void *memcpy(void *, const void *, size_t), *memmove(void *, const void *, size_t), *memset(void *, int, size_t);
int memcmp(const void *, const void *, size_t), strcmp(const char *, const char *), strncmp(const char *, const char *, size_t);
size_t strlen(const char *);
char *strcpy(char *, const char *);
#ifdef __cplusplus
}
#endif
END
machine() { # machine TARGET STANDARD FILE
    clang --target="$1" -std="$2" -O1 $warn -ffreestanding -nostdinc -isystem "$(clang -print-resource-dir)/include" -isystem libc -I"$top" -fsyntax-only "$3"
}
for h in waveform iqn rk; do
    for target in aarch64-linux-gnu armv7-linux-gnueabihf riscv64-linux-gnu wasm32-wasi; do
        if here clang; then
            check "$h.h for $target" machine $target c99 $h.c
            check "$h.h for $target, C++" machine $target c++11 $h.cc
        else
            skip "$h.h for $target" clang
        fi
    done
done
echo "1..$count"
