/* SPDX-License-Identifier: MIT

   host_check.c - is my host right?  A host with vectors of its own kind (the core of iqn.h: iqn_ask, iqn_weights) solves one
   affine map, beside iqn_step on flat arrays.  Put your own vectors, products and combination in place of those between the
   two rulers; a right host prints "right", and its counts are those below.  Wrong ones differ from the first wrong step on.

   Twelve numbers in two fields of six, five pairs, four windows, so that pairs must make room, past pairs serve, a step is
   taken back, one window is discarded, and the last one takes six steps by Aitken's rule: every part of the interface is used.
   What it cannot see changes nothing that counts: the numbers of a block (dot[IQN_DOT_VV] of a first step), and rounding. */
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FIELDS = 2, PART = 6, N = FIELDS * PART, PAIRS = 5, SLOTS = PAIRS + 2, WINDOWS = 4, MOST = 60, AITKEN = 6 };

/* ---- your host: from here ------------------------------------------------------------------------------------------- */

typedef struct vector { /* two fields, each in an array of its own */
    double field[FIELDS][PART];
} vector;

static vector V[SLOTS], W[SLOTS];

static double product(int b, const vector *a, const vector *c)
{
    double sum = 0;
    int i;
    for (i = 0; i < PART; i++) sum += a->field[b][i] * c->field[b][i];
    return sum;
}

static vector difference(const vector *a, const vector *c)
{
    vector d;
    int b, i;
    for (b = 0; b < FIELDS; b++)
        for (i = 0; i < PART; i++) d.field[b][i] = a->field[b][i] - c->field[b][i];
    return d;
}

static void add(double factor, const vector *a, vector *x)
{
    int b, i;
    for (b = 0; b < FIELDS; b++)
        for (i = 0; i < PART; i++) x->field[b][i] += factor * a->field[b][i];
}

/* As iqn_step: x in: what H was given; out: the next input. */
static int host_step(iqn *q, vector *x, const vector *hx)
{
    double dot[FIELDS * (IQN_DOTS + 2 * PAIRS)], weight[2 * SLOTS];
    int slot[SLOTS], store, status, b, j, k;
    const int pairs = iqn_ask(q, slot), now = slot[0], base = slot[1];
    vector v = {{{0}}}, w = {{{0}}}, s;
    W[now] = *hx;
    V[now] = difference(hx, x);
    if (base >= 0) {
        v = difference(&V[now], &V[base]);
        w = difference(&W[now], &W[base]);
    }
    s = difference(&w, &v);
    for (b = 0; b < FIELDS; b++) {
        double *d = dot + b * (IQN_DOTS + 2 * pairs);
        d[IQN_DOT_RR] = product(b, &V[now], &V[now]);
        d[IQN_DOT_HH] = product(b, &W[now], &W[now]);
        d[IQN_DOT_VV] = base < 0 ? PART : product(b, &v, &v);
        d[IQN_DOT_VR] = product(b, &v, &V[now]);
        d[IQN_DOT_SS] = product(b, &s, &s);
        d[IQN_DOT_SV] = product(b, &s, &v);
        for (j = 0; j < pairs; j++) {
            const vector *pair = &V[slot[2 + j]];
            d[IQN_DOTS + 2 * j] = product(b, pair, &V[now]);
            d[IQN_DOTS + 2 * j + 1] = product(b, pair, &v);
        }
    }
    status = iqn_weights(q, dot, weight, &store);
    if (status < 0) return status;
    if (store >= 0) {
        V[store] = v;
        W[store] = w;
    }
    memset(x, 0, sizeof *x);
    for (k = 0; k < SLOTS; k++) {
        add(weight[k], &V[k], x);
        add(weight[SLOTS + k], &W[k], x);
    }
    return status;
}

/* The end of a window: accepted, or to be repeated. */
static void host_end(iqn *q, int accepted)
{
    if (accepted) iqn_commit(q);
    else iqn_discard(q);
}

/* ---- your host: to here --------------------------------------------------------------------------------------------- */

/* hx = load + A x: two fields that answer each other; the first two numbers of each are stiff. */
static void H(int window, const double *x, double *hx)
{
    int i, j;
    for (i = 0; i < N; i++) {
        hx[i] = ((5 * i + 3 * window) % 7 - 3) * (1 + 0.5 * window);
        for (j = 0; j < N; j++)
            hx[i] += (i % PART < 2 ? 10 : 0.2) * ((3 * i * i + 7 * j + 2 * i * j) % 11 - 5) / 10. * x[j];
    }
}

typedef struct trace { /* what iqn.h said in every step */
    int steps[WINDOWS], status[WINDOWS][MOST], taken_back, full;
    double r[WINDOWS][MOST], answer[N];
} trace;

/* All windows, by the host above or by iqn_step */
static void solve(int by_host, trace *t)
{
    static double mem[2][4000];
    double x[N] = {0}, hx[N];
    vector X = {{{0}}}, HX;
    int window, k, end;
    iqn *q;
    memset(t, 0, sizeof *t);
    if (iqn_make(&q, by_host ? IQN_HOST : N, PAIRS, FIELDS, mem[by_host], sizeof mem[by_host]) < 0) return;
    iqn_set(q, IQN_TOL_REDUCTION, 1e-3);
    for (window = 0; window < WINDOWS; window++) {
        const int most = window < WINDOWS - 1 ? MOST : AITKEN;
        if (most == AITKEN) iqn_set(q, IQN_METHOD, IQN_AITKEN);
        for (k = 0, end = 0; k < most && end == 0; k++) {
            if (by_host) memcpy(x, &X, sizeof x); /* your vectors to flat ones and back, for H */
            H(window, x, hx);
            memcpy(&HX, hx, sizeof HX);
            t->status[window][k] = by_host ? host_step(q, &X, &HX) : iqn_step(q, x, hx);
            if (t->status[window][k] < 0) return;
            t->r[window][k] = iqn_get(q, IQN_RESIDUAL);
            t->steps[window] = k + 1;
            end = iqn_converged(q);
        }
        host_end(q, window != 1); /* the second window is given up, and repeated with another load */
    }
    memcpy(t->answer, by_host ? (const void *)&X : (const void *)x, sizeof x);
    t->taken_back = (int)iqn_get(q, IQN_NWITHDRAWN);
    t->full = (int)iqn_get(q, IQN_NFULL);
}

/* Sums in another order differ by 1e-8 at the end of a window. */
static int same(double a, double b)
{
    return fabs(a - b) <= 1e-6 * b;
}

/* Prints the first step that differs, and returns 1; 0: none does. */
static int differ(const trace *host, const trace *right)
{
    int w, k;
    for (w = 0; w < WINDOWS; w++) {
        for (k = 0; k < right->steps[w]; k++) {
            const int status = host->status[w][k];
            if (k < host->steps[w] && status >= 0 && same(host->r[w][k], right->r[w][k])) continue;
            printf("differs in window %d, step %d: ", w + 1, k + 1);
            if (status < 0) printf("%s\n", iqn_message(status));
            else if (k >= host->steps[w]) printf("ended before\n");
            else printf("|r| %.9g for %.9g\n", host->r[w][k], right->r[w][k]);
            return 1;
        }
        if (host->steps[w] != right->steps[w]) {
            printf("differs in window %d: %d steps for %d\n", w + 1, host->steps[w], right->steps[w]);
            return 1;
        }
    }
    return 0;
}

int main(void)
{
    static trace host, right;
    double off = 0;
    int w, i;
    solve(1, &host);
    solve(0, &right);
    for (w = 0; w < WINDOWS; w++) printf("window %d  %2d steps, iqn_step %2d\n", w + 1, host.steps[w], right.steps[w]);
    printf("taken back  %d\nmade room  %d\n", right.taken_back, right.full);
    for (i = 0; i < N; i++) off = fmax(off, fabs(host.answer[i] - right.answer[i]));
    if (right.steps[0] == 0 || differ(&host, &right) || !(off < 1e-4)) {
        printf("wrong: a status < 0: V, a slot or a product.  |r| differs: from the second step on H, r or x;\n"
               "from the third step on what is stored or how x is combined; from the second window on iqn_commit;\n"
               "in the third window iqn_discard.\n");
        return 1;
    }
    printf("right\n");
    return 0;
}
