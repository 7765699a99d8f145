/* SPDX-License-Identifier: MIT

   arena_rivals.h - other accelerators, written from their papers and documents with LAPACK, nothing of iqn.h in them.

   least squares  min |r + V a|, pairs of the last k windows; pairs by QR from new to old, those with |R_ii| < limit |v_i|
                  deleted (QR2 of Haelterman et al. 2016, preCICE), or by singular values above rcond (dgelsd)
   IMVJ           groups of pairs, one per window: the newer ones first, each on what those before have left over
                  (Bogaers et al. 2014, Lindner et al. 2015)
   Aitken         Kuettler, Wall 2008
   safeguarded    type II Anderson, ten pairs, regularised; a step after which |r| has doubled is taken back for a plain
                  one, and the pairs are forgotten (Zhang, O'Donoghue, Boyd 2020; cvxgrp/aa)
   KINSOL         Anderson of SUNDIALS as it is installed, anew in every window */
#ifndef ARENA_RIVALS_H_INCLUDED
#define ARENA_RIVALS_H_INCLUDED
#include "arena.h"

extern void dgelsd_(const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b, const int *ldb,
                    double *s, const double *rcond, int *rank, double *work, const int *lwork, int *iwork, int *info);

extern void dgemv_(const char *trans, const int *m, const int *n, const double *alpha, const double *a, const int *lda,
                   const double *x, const int *incx, const double *beta, double *y, const int *incy, size_t length);

enum { QR2, SINGULAR, IMVJ };

typedef struct secant {
    double *v, *w;
    int window;
} secant;

typedef struct rival {
    const contender *how;
    ptrdiff_t n;
    secant *pairs; /* newest first */
    int used, most, window, chained;
    double *x, *r, *Q, *R, *rest, *work, omega, before;
    int accelerated;
} rival;

static void *rival_make(const contender *how, problem *p)
{
    rival *q = (rival *)memory(sizeof *q);
    q->how = how, q->n = p->n, q->omega = how->omega;
    q->most = p->columns;
    q->pairs = (secant *)memory((size_t)(q->most + 1) * sizeof *q->pairs);
    q->x = numbers(p->n), q->r = numbers(p->n), q->rest = numbers(p->n);
    q->Q = numbers((p->n + 1) * (q->most + 1)), q->R = numbers((q->most + 1) * (q->most + 1));
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
    while (q->used) rival_forget(q, q->used - 1);
    free(q->pairs), free(q->x), free(q->r), free(q->Q), free(q->R), free(q->rest), free(q->work), free(q);
}

/* Pair of this evaluation and the one before; keep it as the last one. */
static void rival_learn(rival *q, const double *x, const double *hx)
{
    secant one = {NULL, NULL, 0};
    ptrdiff_t i;
    if (q->chained) {
        if (q->used == q->most) rival_forget(q, q->used - 1);
        one.v = numbers(q->n), one.w = numbers(q->n), one.window = q->window;
        for (i = 0; i < q->n; i++) {
            one.v[i] = hx[i] - x[i] - q->r[i];
            one.w[i] = one.v[i] + x[i] - q->x[i];
        }
        memmove(q->pairs + 1, q->pairs, (size_t)q->used * sizeof *q->pairs);
        q->pairs[0] = one;
        q->used++;
        if (!(length(q->n, one.v) > 0)) rival_forget(q, 0);
    }
    for (i = 0; i < q->n; i++) q->r[i] = hx[i] - x[i];
    copy(q->n, x, q->x);
    q->chained = 1;
}

/* s = Q'u, u -= Q s, m columns */
static void project(const rival *q, int m, double *u, double *s)
{
    const int n = (int)q->n, one = 1;
    const double plus = 1, minus = -1, zero = 0;
    if (m == 0) return;
    dgemv_("T", &n, &m, &plus, q->Q, &n, u, &one, &zero, s, &one, 1);
    dgemv_("N", &n, &m, &minus, q->Q, &n, s, &one, &plus, u, &one, 1);
}

/* rest += V a, x += W a with a = argmin |rest + V a| over pairs first .. end - 1; returns the pairs left of them */
static int rival_qr(rival *q, int first, int end, double *x)
{
    double *a = numbers(q->most + 1), *s = numbers(q->most + 1);
    int j = first, k, pass, m = 0;
    while (j < end) { /* newest first; a pair that is nearly in the span of the newer ones goes for good */
        double *u = q->Q + m * q->n, own = length(q->n, q->pairs[j].v);
        for (k = 0; k <= m; k++) q->R[m * q->most + k] = 0;
        copy(q->n, q->pairs[j].v, u);
        for (pass = 0; pass < 2; pass++) {
            project(q, m, u, s);
            add(m, 1, s, q->R + m * q->most);
        }
        q->R[m * q->most + m] = length(q->n, u);
        if (q->R[m * q->most + m] < fmax(q->how->limit, 1e-14) * own || m >= q->n) {
            rival_forget(q, j);
            end--;
            continue;
        }
        add(q->n, 1 / q->R[m * q->most + m] - 1, u, u);
        m++, j++;
    }
    copy(q->n, q->rest, q->Q + m * q->n);
    project(q, m, q->Q + m * q->n, s);
    for (k = 0; k < m; k++) a[k] = -s[k];
    for (k = m - 1; k >= 0; k--) {
        a[k] /= q->R[k * q->most + k];
        for (j = 0; j < k; j++) a[j] -= q->R[k * q->most + j] * a[k];
    }
    for (k = 0; k < m; k++) {
        add(q->n, a[k], q->pairs[first + k].v, q->rest);
        add(q->n, a[k], q->pairs[first + k].w, x);
    }
    free(a), free(s);
    return m;
}

static void rival_singular(rival *q, double *x)
{
    const int rows = (int)q->n, m = q->used, one = 1, ld = rows > m ? rows : m, lwork = 100000;
    double *b = numbers(ld), *s = numbers(ld), *A = numbers((ptrdiff_t)ld * m);
    int *iwork = (int *)memory(100000 * sizeof *iwork), j, rank, info;
    if (!q->work) q->work = numbers(lwork);
    for (j = 0; j < m; j++) copy(q->n, q->pairs[j].v, A + (ptrdiff_t)j * ld);
    for (j = 0; j < rows; j++) b[j] = -q->rest[j];
    dgelsd_(&rows, &m, &one, A, &ld, b, &ld, s, &q->how->limit, &rank, q->work, &lwork, iwork, &info);
    for (j = 0; j < m; j++) add(q->n, b[j], q->pairs[j].w, x);
    free(b), free(s), free(A), free(iwork);
}

static int rival_step(void *state, double *x, const double *hx)
{
    rival *q = (rival *)state;
    int j, end;
    rival_learn(q, x, hx);
    if (q->used == 0) {
        add(q->n, q->omega, q->r, x);
        return STEP_GOES_ON;
    }
    copy(q->n, hx, x);
    copy(q->n, q->r, q->rest);
    if (q->how->kind == QR2) rival_qr(q, 0, q->used, x);
    if (q->how->kind == SINGULAR) rival_singular(q, x);
    for (j = 0; q->how->kind == IMVJ && j < q->used;) {
        for (end = j; end < q->used && q->pairs[end].window == q->pairs[j].window;) end++;
        j += rival_qr(q, j, end, x);
    }
    return STEP_GOES_ON;
}

static void rival_commit(void *state)
{
    rival *q = (rival *)state;
    const int keep = q->how->windows > 0 ? q->how->windows : 1; /* one for the next first step */
    q->window++, q->chained = 0, q->accelerated = 0;
    while (q->used && q->pairs[q->used - 1].window < q->window - keep) rival_forget(q, q->used - 1);
}

static void rival_discard(void *state)
{
    rival *q = (rival *)state;
    while (q->used && q->pairs[0].window == q->window) rival_forget(q, 0);
    q->chained = 0, q->accelerated = 0;
}

/* Least squares in the window alone: pairs of the window before serve its first step. */
static int alone_step(void *state, double *x, const double *hx)
{
    rival *q = (rival *)state;
    while (q->chained && q->used && q->pairs[q->used - 1].window < q->window) rival_forget(q, q->used - 1);
    return rival_step(state, x, hx);
}

static int aitken_step(void *state, double *x, const double *hx)
{
    rival *q = (rival *)state;
    rival_learn(q, x, hx);
    if (q->used) {
        const double *v = q->pairs[0].v;
        double r = product(q->n, q->r, v), vv = product(q->n, v, v);
        q->omega *= -(r - vv) / vv; /* r before: r - v */
        if (!(fabs(q->omega) > 0 && fabs(q->omega) < DBL_MAX)) q->omega = q->how->omega;
        rival_forget(q, 0);
    }
    add(q->n, q->omega, q->r, x);
    return STEP_GOES_ON;
}

static void aitken_commit(void *state)
{
    rival *q = (rival *)state;
    q->chained = 0;
    q->omega = q->how->omega;
}

static int safeguarded_step(void *state, double *x, const double *hx)
{
    rival *q = (rival *)state;
    const double safeguard = 2;
    double *before = numbers(q->n), now;
    ptrdiff_t i;
    for (i = 0; i < q->n; i++) before[i] = q->x[i] + q->r[i];
    rival_learn(q, x, hx);
    now = length(q->n, q->r);
    if (q->accelerated && now > safeguard * q->before) { /* back to H of the iterate before; all is forgotten */
        while (q->used) rival_forget(q, 0);
        copy(q->n, before, x);
        q->chained = 0, q->accelerated = 0;
    } else if (q->used) {
        while (q->used > 10) rival_forget(q, q->used - 1);
        copy(q->n, hx, x);
        copy(q->n, q->r, q->rest);
        rival_qr(q, 0, q->used, x);
        q->accelerated = 1;
    } else copy(q->n, hx, x);
    q->before = now;
    free(before);
    return STEP_GOES_ON;
}

#endif
