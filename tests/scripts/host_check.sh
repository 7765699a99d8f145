#!/bin/sh
# SPDX-License-Identifier: MIT
# host_check.sh - examples/host_check.c finds what is wrong with a host of the core of iqn.h: 34 mistakes, each a line of its
# host changed, must be found, but those of which the list says that they change nothing (unseen).  Prints TAP; reads CC.
# IQN: another folder with an iqn.h.
set -u
cc=${CC:-cc}
top=$(cd "$(dirname "$0")/../.." && pwd)
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
cp "${IQN:-$top}/iqn.h" . || exit 1
printf '#define IQN_IMPLEMENTATION\n#include "iqn.h"\n' >part.c
$cc -std=c99 -O1 -w -c part.c || { echo 'Bail out! iqn.h does not compile'; exit 1; }
sed 's/^#define IQN_IMPLEMENTATION$//' "$top/examples/host_check.c" >right.c
count=0

# report VERDICT NAME
report() {
    count=$((count + 1))
    echo "$1 $count - $2"
}
# run NAME: what it prints goes to said
run() { $cc -std=c99 -O1 -w -o a.out "$1.c" part.o -lm && timeout 10 ./a.out >said 2>&1; }

if run right; then report ok 'a right host is right'; else
    report 'not ok' 'a right host is right'
    sed 's/^/# /' said
fi
while IFS='|' read -r want name change; do
    sed "$change" right.c >wrong.c
    if cmp -s right.c wrong.c; then report 'not ok' "$name: that line is no longer there"; continue; fi
    run wrong
    case $want-$? in found-0) report 'not ok' "$name: not found" ;;
        unseen-0) report ok "$name: changes nothing that counts" ;;
        *) report ok "$name: $(sed -n 's/^differs/differs/p' said)" ;; esac
done <<'END'
found|pairs not stored|/^    if (store >= 0) {/s/store >= 0/0/
found|V not stored|/^        V\[store\] = v;/d
found|W not stored|/^        W\[store\] = w;/d
found|pairs stored in slot[0]|s/V\[store\] = v;/V[now] = v;/; s/W\[store\] = w;/W[now] = w;/
found|V stored with the other sign|s/V\[store\] = v;/V[store] = difference(\&V[base], \&V[now]);/
found|pairs stored with the other sign|s/v = difference(&V\[now\], &V\[base\]);/v = difference(\&V[base], \&V[now]);/; s/w = difference(&W\[now\], &W\[base\]);/w = difference(\&W[base], \&W[now]);/
found|r stored in place of v|s/V\[store\] = v;/V[store] = V[now];/
found|r and v swapped in the products of the pairs|s/= product(b, pair, &V\[now\]);/= product(b, pair, \&v); \/\/ swapped/; s/product(b, pair, &v);$/product(b, pair, \&V[now]);/
found|pairs in reverse|s/&V\[slot\[2 + j\]\];/\&V[slot[1 + pairs - j]];/
found|RR and HH swapped|s/IQN_DOT_RR\]/IQN_DOT_XX]/; s/IQN_DOT_HH\]/IQN_DOT_RR]/; s/IQN_DOT_XX\]/IQN_DOT_HH]/
found|asked once, in the first step|s/int slot\[SLOTS\], store/static int slot[SLOTS], asked; int store/; s/const int pairs = iqn_ask(q, slot),/const int pairs = asked ? 0 : iqn_ask(q, slot),/; s/    vector v = {{{0}}}, w/    vector v = {{{0}}}, w/; s/    W\[now\] = \*hx;/    asked = 1; W[now] = *hx;/
found|v is r|s/        v = difference(&V\[now\], &V\[base\]);/        v = V[now];/
found|v is 0|s/        v = difference(&V\[now\], &V\[base\]);/        ;/
found|products of the last step|s/double dot\[/static double old[2], dot[/; s/d\[IQN_DOT_RR\] = product(b, &V\[now\], &V\[now\]);/d[IQN_DOT_RR] = old[b]; old[b] = product(b, \&V[now], \&V[now]);/
found|a free slot as scratch|s/    memset(x, 0, sizeof \*x);/    V[(now + 1) % SLOTS] = V[now]; memset(x, 0, sizeof *x);/
found|a stored V changed|s/    memset(x, 0, sizeof \*x);/    if (pairs > 1) V[slot[2]].field[0][0] *= 2; memset(x, 0, sizeof *x);/
found|r is x - hx|s/V\[now\] = difference(hx, x);/V[now] = difference(x, hx);/
found|products in float|s/    double sum = 0;/    float sum = 0;/; s/sum += a->field\[b\]\[i\] \* c->field\[b\]\[i\];/sum += (float)a->field[b][i] * (float)c->field[b][i];/
found|<s, v> with the other sign|s/= product(b, &s, &v);/= -product(b, \&s, \&v);/
unseen|rubbish for the numbers of a block|s/base < 0 ? PART :/base < 0 ? 1e6 :/
unseen|<V, v> by subtraction|s/^            d\[IQN_DOTS + 2 \* j + 1\] = product(b, pair, &v);/            d[IQN_DOTS + 2 * j + 1] = base < 0 ? 0 : product(b, pair, \&V[now]) - product(b, pair, \&V[base]);/
found|V in float|s/        V\[store\] = v;/        V[store] = v; for (k = 0; k < N; k++) ((double *)\&V[store])[k] = (float)((double *)\&V[store])[k];/
found|a slot too few|s/PAIRS = 5, SLOTS = PAIRS + 2/PAIRS = 5, SLOTS = PAIRS + 2, LAST = SLOTS - 2/; s/V\[store\] = v;/V[store > LAST ? LAST : store] = v;/; s/W\[store\] = w;/W[store > LAST ? LAST : store] = w;/
found|products of the second block are 0|s/    double sum = 0;/    double sum = 0; if (b) return 0;/
found|half of the vector in the products|s/for (i = 0; i < PART; i++) sum/for (i = 0; i < PART \/ 2; i++) sum/
found|x formed before the pair is stored|s/    status = iqn_weights(q, dot, weight, &store);/    vector V0[SLOTS], W0[SLOTS]; memcpy(V0, V, sizeof V); memcpy(W0, W, sizeof W); status = iqn_weights(q, dot, weight, \&store);/; s/add(weight\[k\], &V\[k\], x);/add(weight[k], \&V0[k], x);/; s/&W\[k\], x);/\&W0[k], x);/
found|W at weight[PAIRS + s]|s/weight\[SLOTS + k\]/weight[PAIRS + k]/
found|W not used|/add(weight\[SLOTS + k\], &W\[k\], x);/d
found|W[now] is x|s/W\[now\] = \*hx;/W[now] = *x;/
found|x added to the old x|/    memset(x, 0, sizeof \*x);/d
found|no iqn_commit|s/    if (accepted) iqn_commit(q);/    if (accepted) return;/
found|no iqn_discard|s/    else iqn_discard(q);/    else iqn_commit(q);/
found|W of the base changed|s/    memset(x, 0, sizeof \*x);/    if (base >= 0) W[base].field[1][0] *= 1.1; memset(x, 0, sizeof *x);/
found|SS and SV left at 0|s/= product(b, &s, &s);/= 0;/; s/= product(b, &s, &v);/= 0;/
END
echo "1..$count"
