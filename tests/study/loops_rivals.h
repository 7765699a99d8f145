/* SPDX-License-Identifier: MIT

   loops_rivals.h - what a host has before it takes iqn.h: x + omega (H(x) - x), Aitken's omega, and the accelerator of
   cvxgrp/aa, if its sources are given (make loops AA=folder). */
#ifndef LOOPS_RIVALS_H_INCLUDED
#define LOOPS_RIVALS_H_INCLUDED
#include "arena.h"

typedef struct relaxed {
    ptrdiff_t n;
    double first, omega, *r; /* r: of the step before */
    int steps, aitken;
} relaxed;

static void *relaxed_make(const contender *c, problem *p)
{
    relaxed *q = (relaxed *)memory(sizeof *q);
    q->n = p->n;
    q->first = q->omega = c->omega;
    q->aitken = c->kind == OMEGA;
    q->r = numbers(p->n);
    return q;
}

static int relaxed_step(void *state, double *x, const double *hx)
{
    relaxed *q = (relaxed *)state;
    double down = 0, across = 0;
    ptrdiff_t i;
    for (i = 0; i < q->n; i++) {
        const double r = hx[i] - x[i], change = r - q->r[i];
        down += change * change;
        across += q->r[i] * change;
        q->r[i] = r;
    }
    if (q->aitken && q->steps > 0 && down > 0) q->omega *= -across / down;
    q->steps++;
    add(q->n, q->omega, q->r, x);
    return 0;
}

static void relaxed_end(void *state)
{
    relaxed *q = (relaxed *)state;
    q->steps = 0;
    q->omega = q->first;
}

static void relaxed_release(void *state)
{
    free(((relaxed *)state)->r);
    free(state);
}

#define RELAXED relaxed_make, relaxed_step, relaxed_end, relaxed_end, relaxed_release

#ifdef AA
#  include "aa.h"

typedef struct peer {
    AaWork *work;
    double *f;
    ptrdiff_t n;
} peer;

/* The defaults of its Python module, memory 10; kind: type I or II */
static void *peer_make(const contender *c, problem *p)
{
    peer *q = (peer *)memory(sizeof *q);
    q->n = p->n;
    q->f = numbers(p->n);
    q->work = aa_init((aa_int)p->n, 10, 1, c->kind == GROUPS, c->limit, 1, 1, 1e6, 5, 0);
    return q;
}

static int peer_step(void *state, double *x, const double *hx)
{
    peer *q = (peer *)state;
    copy(q->n, hx, q->f);
    aa_safeguard(q->f, x, q->work);
    aa_apply(q->f, x, q->work);
    copy(q->n, q->f, x);
    return 0;
}

static void peer_end(void *state)
{
    aa_reset(((peer *)state)->work);
}

static void peer_release(void *state)
{
    aa_finish(((peer *)state)->work);
    free(((peer *)state)->f);
    free(state);
}

#  define PEER peer_make, peer_step, peer_end, peer_end, peer_release
#endif
#endif
