/* SPDX-License-Identifier: MIT

   arena_rivals.h - other accelerators, written from their papers and documents, nothing of iqn.h in them.

   least squares  min |r + V a|, pairs of the last k windows; pairs by QR from new to old, those with |R_ii| < limit |v_i|
                  deleted (QR2 of Haelterman et al. 2016, preCICE); windows 0: pairs of the window before serve the first
                  step alone
   groups         IMVJ: of pairs, one per window: the newer ones first, each on what those before have left over (Bogaers
                  et al. 2014, Lindner et al. 2015)

   Fields of other units are scaled by their residuals in the first evaluation of a window (preCICE's residual
   preconditioner); samples without weight are left out of the least squares (reduced QN-WI). */
#ifndef ARENA_RIVALS_H_INCLUDED
#define ARENA_RIVALS_H_INCLUDED
#include "arena.h"

typedef struct secant {
    double *v, *w;
    int window;
} secant;

typedef struct rival {
    const contender *how;
    const problem *p;
    ptrdiff_t n;
    secant *pairs; /* newest first */
    int used, most, window, chained;
    double *x, *r, *scale, *Q, *R, *rest;
} rival;

static void *rival_make(const contender *how, problem *p)
{
    rival *q = (rival *)memory(sizeof *q);
    ptrdiff_t i;
    q->how = how, q->p = p, q->n = p->n, q->most = p->columns;
    q->pairs = (secant *)memory((size_t)(q->most + 1) * sizeof *q->pairs);
    q->x = numbers(4 * p->n), q->r = q->x + p->n, q->rest = q->r + p->n, q->scale = q->rest + p->n;
    q->Q = numbers((p->n + 1) * (q->most + 1)), q->R = numbers((q->most + 1) * (q->most + 1));
    for (i = 0; i < p->n; i++) q->scale[i] = !(p->flags & END) || i >= p->n - p->n / p->blocks;
    return q;
}

static void rival_forget(rival *q, int j)
{
    free(q->pairs[j].v), free(q->pairs[j].w);
    q->used--;
    memmove(q->pairs + j, q->pairs + j + 1, (size_t)(q->used - j) * sizeof *q->pairs);
}

static void rival_release(void *state)
{
    rival *q = (rival *)state;
    while (q->used) rival_forget(q, 0);
    free(q->pairs), free(q->x), free(q->Q), free(q->R), free(q);
}

/* Pair of this evaluation and the one before; keep it as the last one. */
static void rival_learn(rival *q, const double *x, const double *hx)
{
    secant one = {NULL, NULL, 0};
    ptrdiff_t i, b, part = q->n / (q->p->blocks ? q->p->blocks : 1);
    if (q->chained) {
        if (q->used == q->most) rival_forget(q, q->used - 1);
        one.v = numbers(q->n), one.w = numbers(q->n), one.window = q->window;
        for (i = 0; i < q->n; i++) {
            one.v[i] = hx[i] - x[i] - q->r[i];
            one.w[i] = one.v[i] + x[i] - q->x[i];
        }
        memmove(q->pairs + 1, q->pairs, (size_t)q->used * sizeof *q->pairs);
        q->pairs[0] = one, q->used++;
        if (!(length(q->n, one.v) > 0)) rival_forget(q, 0);
    }
    for (i = 0; i < q->n; i++) q->r[i] = hx[i] - x[i];
    for (b = 0; !q->chained && q->p->flags & FIELDS && b < q->n; b += part)
        for (i = b; i < b + part; i++) q->scale[i] = 1 / fmax(length(part, q->r + b), 1e-300);
    copy(q->n, x, q->x);
    q->chained = 1;
}

/* u -= Q Q'u, s += Q'u, m columns */
static void project(const rival *q, int m, double *u, double *s)
{
    int k;
    for (k = 0; k < m; k++) {
        const double part = product(q->n, q->Q + k * q->n, u);
        s[k] += part, add(q->n, -part, q->Q + k * q->n, u);
    }
}

static void scaled(const rival *q, const double *from, double *to)
{
    ptrdiff_t i;
    for (i = 0; i < q->n; i++) to[i] = q->scale[i] * from[i];
}

/* rest += V a, x += W a with a = argmin |rest + V a| over pairs first .. end - 1; returns the pairs left of them */
static int rival_qr(rival *q, int first, int end, double *x)
{
    double *a = numbers(q->most + 1), *R = q->R, own;
    int j = first, k, m = 0;
    while (j < end) { /* newest first; a pair that is nearly in the span of the newer ones goes for good */
        double *u = q->Q + m * q->n, *s = R + m * q->most;
        scaled(q, q->pairs[j].v, u);
        own = length(q->n, u);
        for (k = 0; k <= m; k++) s[k] = 0;
        project(q, m, u, s), project(q, m, u, s);
        s[m] = length(q->n, u);
        if (!(s[m] >= fmax(q->how->limit, 1e-14) * own) || own == 0 || m >= q->n) {
            rival_forget(q, j);
            end--;
            continue;
        }
        add(q->n, 1 / s[m] - 1, u, u);
        m++, j++;
    }
    scaled(q, q->rest, q->Q + m * q->n);
    project(q, m, q->Q + m * q->n, a);
    for (k = m - 1; k >= 0; k--) {
        a[k] /= -R[k * q->most + k];
        for (j = 0; j < k; j++) a[j] += R[k * q->most + j] * a[k];
        add(q->n, a[k], q->pairs[first + k].v, q->rest);
        add(q->n, a[k], q->pairs[first + k].w, x);
    }
    free(a);
    return m;
}

static int rival_step(void *state, double *x, const double *hx)
{
    rival *q = (rival *)state;
    int j, end;
    while (q->how->windows == 0 && q->chained && q->used && q->pairs[q->used - 1].window < q->window)
        rival_forget(q, q->used - 1);
    rival_learn(q, x, hx);
    if (q->used == 0) {
        add(q->n, q->how->omega, q->r, x);
        return 0;
    }
    copy(q->n, hx, x);
    copy(q->n, q->r, q->rest);
    if (q->how->kind == LEAST_SQUARES) rival_qr(q, 0, q->used, x);
    for (j = 0; q->how->kind == GROUPS && j < q->used;) {
        for (end = j; end < q->used && q->pairs[end].window == q->pairs[j].window;) end++;
        j += rival_qr(q, j, end, x);
    }
    return 0;
}

static void rival_commit(void *state)
{
    rival *q = (rival *)state;
    const int keep = q->how->windows > 0 ? q->how->windows : 1; /* one for the next first step */
    q->window++, q->chained = 0;
    while (q->used && q->pairs[q->used - 1].window < q->window - keep) rival_forget(q, q->used - 1);
}

static void rival_discard(void *state)
{
    rival *q = (rival *)state;
    while (q->used && q->pairs[0].window == q->window) rival_forget(q, 0);
    q->chained = 0;
}

#define RIVAL rival_make, rival_step, rival_commit, rival_discard, rival_release
#endif
