#!/bin/sh
# SPDX-License-Identifier: MIT versions.sh - two libraries that vendor different versions of the
# headers, in one program that has a third copy: none disturbs another.  The older version differs
# in its number and in what its objects look like inside.  Prints TAP; reads CC.
set -u
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
count=0 failed=0

check() { # check NAME COMMAND...
    name=$1
    shift
    count=$((count + 1))
    if "$@" >log 2>&1; then echo "ok $count - $name"; else
        echo "not ok $count - $name"
        failed=1
        sed 's/^/# /' log
    fi
}

mkdir old new
for h in waveform.h iqn.h rk.h; do
    cp "$top/$h" new/
    sed -e 's/^\(#define [A-Z]*_VERSION\) .*/\1 99/' -e 's/_VERSION != [0-9]*/_VERSION != 99/' \
        -e 's/^struct \(wf\|iqn\) {/&\n    double only_in_the_old_version[9];/' "$top/$h" >old/$h
done

cat >part.c <<'END'
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include <math.h>
#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)
#define PUBLIC __attribute__((visibility("default")))
static double memory[20000], x[3] = {0.1, 0.2, 0.3};
static wf *w;
static iqn *q;
PUBLIC int NAME(PART, _version)(void);
PUBLIC int NAME(PART, _version)(void) { return wf_linked_version() == iqn_linked_version() ? wf_linked_version() : -1; }
PUBLIC unsigned long NAME(PART, _bytes)(void);
PUBLIC unsigned long NAME(PART, _bytes)(void)
{
    return (unsigned long)(wf_size(1, 3, 50) + iqn_size(3, 5, 1));
}
PUBLIC double NAME(PART, _step)(int i);
PUBLIC double NAME(PART, _step)(int i) /* a step, its output in a waveform, an iteration on it */
{
    const rk_table *T = rk_find("dp5");
    double k[7], y = 1 + i, z, v = 0, hx[3];
    int j;
    if (i == 0) {
        if (wf_make(&w, 1, 3, 50, memory, 80000)) return -1;
        if (iqn_make(&q, 3, 5, 1, memory + 10000, 80000)) return -1;
    }
    for (j = 0; j < T->stages; j++) {
        rk_stage(T, j, 0.1, 1, &y, k, 1, &z);
        k[j] = cos(z);
    }
    rk_finish(T, 0.1, 1, &y, k, 1, &y, 0);
    j = wf_push(w, 0.1 * i, 0);
    if (j < 0) return -2;
    *wf_column(w, j) = y;
    if (wf_read(w, 0.1 * i - 0.03, 0, &v) < 0) return -3;
    for (j = 0; j < 3; j++) hx[j] = 0.3 * cos(x[0] + j * x[1] + x[2]) + 0.01 * v;
    if (iqn_step(q, x, hx) < 0) return -4;
    return v + x[0] + x[1] + x[2];
}
END
cat >main.c <<'END'
#include <stdio.h>
int a_version(void), b_version(void), c_version(void);
unsigned long a_bytes(void), b_bytes(void);
double a_step(int), b_step(int), c_step(int);
int main(void)
{
    int i, same = 1;
    for (i = 0; i < 12; i++) { /* taking turns */
        const double a = a_step(i), b = b_step(i), c = c_step(i);
        printf("%.17g %.17g %.17g\n", a, b, c);
        same = same && a == b && b == c && a > 0;
    }
    printf("versions %d %d %d, ", a_version(), b_version(), c_version());
    printf("bytes %lu %lu\n", a_bytes(), b_bytes());
    same = same && a_version() == 99 && b_version() == c_version() && b_version() != 99;
    return same && a_bytes() != b_bytes() ? 0 : 1;
}
END

static='-DWF_STATIC -DIQN_STATIC -DRK_STATIC'
compile() { # compile OUTPUT VERSION PART FLAGS...
    out=$1 include=$2 part=$3
    shift 3
    $cc -O1 -I"$include" -DPART="$part" "$@" part.c -o "$out"
}
check 'three copies compile, the vendored two static' eval 'compile a.o old a -c $static &&
    compile b.o new b -c $static && compile c.o new c -c'
check 'they link into one program' $cc main.c a.o b.o c.o -o static -lm
check 'static copies of two versions and an extern one, taking turns, give the same bits' ./static
hidden='-shared -fPIC -fvisibility=hidden -lm'
check 'two shared libraries of two versions, hidden visibility' eval '
    compile liba.so old a $hidden &&
    compile libb.so new b $hidden && $cc main.c c.o -o shared -L. -Wl,-rpath,. -la -lb -lm'
check 'the same bits from them' ./shared
echo "1..$count"
exit $failed
