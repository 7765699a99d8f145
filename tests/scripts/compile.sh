#!/bin/sh
# SPDX-License-Identifier: MIT
# compile.sh - how the headers may be included: alone, twice, static, in any order, as C and as C++, beside LAPACK's own
# prototypes, never in two versions.  Prints TAP; reads CC, CXX, LDLIBS.
set -u
cc=${CC:-cc} cxx=${CXX:-c++} libs=${LDLIBS:--llapack -lblas}
warn='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror'
top=$(cd "$(dirname "$0")/../.." && pwd)
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

includes() { for file; do echo "#include \"$file\""; done; }
define() { echo '#define WF_IMPLEMENTATION'; echo '#define IQN_IMPLEMENTATION'; echo '#define RK_IMPLEMENTATION'; }
fails_with() { # fails_with TEXT COMMAND...
    text=$1
    shift
    ! "$@" >out 2>&1 && grep -q "$text" out
}

compilers="$cc"
for c in gcc clang; do command -v $c >/dev/null && [ "$(command -v $c)" != "$(command -v "$cc")" ] && compilers="$compilers $c"; done
compilersxx="$cxx"
for c in g++ clang++; do command -v $c >/dev/null && [ "$(command -v $c)" != "$(command -v "$cxx")" ] && compilersxx="$compilersxx $c"; done

for h in waveform iqn rk; do
    { define; includes $h.h; } >alone.c
    cp alone.c alone.cc
    for c in $compilers; do
        for std in c99 c11 c17; do check "$h.h alone, $c -std=$std" $c -std=$std $warn -O2 -I"$top" -c alone.c -o alone.o; done
    done
    for c in tcc x86_64-w64-mingw32-gcc aarch64-linux-gnu-gcc s390x-linux-gnu-gcc; do
        command -v $c >/dev/null && check "$h.h alone, $c" $c -std=c99 -I"$top" -c alone.c -o alone.o
    done
    if echo '#include <math.h>' | $cc -m32 -E -x c - >/dev/null 2>&1; then # doubles that the 387 rounds late
        check "$h.h alone, $cc -m32 -mfpmath=387" $cc -m32 -mfpmath=387 -std=c99 $warn -O2 -I"$top" -c alone.c -o alone.o
    fi
    for c in $compilersxx; do
        for std in c++11 c++17 c++20; do
            check "$h.h alone, $c -std=$std" $c -std=$std $warn -O1 -I"$top" -c alone.cc -o alone.o
        done
    done
    # words that windows.h defines
    check "$h.h behind windows.h's macros" $cc -std=c99 $warn -Dnear= -Dfar= -Dsmall=char -Dhyper=long -Dinterface=struct \
        -DIN= -DOUT= -DOPTIONAL= -I"$top" -c alone.c -o alone.o
    { includes $h.h; define; includes $h.h $h.h; } >twice.c
    check "$h.h twice in one file" $cc -std=c99 $warn -I"$top" -c twice.c -o twice.o
    { echo '#define WF_STATIC'; echo '#define IQN_STATIC'; echo '#define RK_STATIC'; cat alone.c; } >static.c
    check "$h.h static, nothing used, no warning" $cc -std=c99 $warn -O2 -I"$top" -c static.c -o static.o
    { echo '#define WF_STATIC'; echo '#define IQN_STATIC'; echo '#define RK_STATIC'; includes $h.h; } >declared.c
    check "$h.h static, declarations alone, no warning" $cc -std=c99 -Wno-unused-function $warn -I"$top" -c declared.c -o declared.o
    prefix=$(case $h in waveform) echo wf ;; *) echo $h ;; esac)
    { cat static.c; echo "int one(void); int one(void) { return ${prefix}_linked_version(); }"; } >one.c
    { cat static.c; echo "int two(void); int two(void) { return ${prefix}_linked_version(); }"; } >two.c
    { cat alone.c; echo "int one(void); int two(void); int main(void) { return one() + two() == 2 * ${prefix}_linked_version() ? 0 : 1; }"; } >three.c
    check "$h.h static in two files, extern in a third: links" $cc -std=c99 -I"$top" one.c two.c three.c -o three $libs -lm
    check "$h.h static in two files, extern in a third: runs" ./three
    sed 's/^\(#define [A-Z]*_VERSION\) .*/\1 99/; s/_VERSION != [0-9]*/_VERSION != 99/' "$top/$h.h" >"other_$h.h"
    includes $h.h "other_$h.h" >versions.c
    check "$h.h in two versions in one file is refused" fails_with 'two different versions' $cc -std=c99 -I"$top" -I. -c versions.c -o versions.o
done

for order in 'waveform.h iqn.h rk.h' 'waveform.h rk.h iqn.h' 'iqn.h waveform.h rk.h' 'iqn.h rk.h waveform.h' 'rk.h waveform.h iqn.h' 'rk.h iqn.h waveform.h'; do
    { define; includes $order; } >order.c
    check "all three: $order" $cc -std=c99 $warn -I"$top" -c order.c -o order.o
done

# BLIS's cblas.h speaks of pthread_barrier_t, which needs POSIX.
warn="$warn -D_POSIX_C_SOURCE=200809L"
for extra in lapacke.h cblas.h complex.h; do
    if echo "#include <$extra>" | $cc -E -x c - >/dev/null 2>&1; then
        { echo "#include <$extra>"; define; includes waveform.h iqn.h rk.h; } >beside.c
        check "after <$extra>" $cc -std=c99 $warn -I"$top" -c beside.c -o beside.o
        { define; includes waveform.h iqn.h rk.h; echo "#include <$extra>"; } >beside.c
        check "before <$extra>" $cc -std=c99 $warn -I"$top" -c beside.c -o beside.o
    fi
done
echo "1..$count"
