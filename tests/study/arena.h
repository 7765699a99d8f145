/* SPDX-License-Identifier: MIT

   arena.h - what problems and contenders of the arena are.  A problem is a sequence of windows, each a fixed point
   x = H(x); a contender moves from (x, H(x)) to the next x.  The judge alone decides what has converged. */
#ifndef ARENA_H_INCLUDED
#define ARENA_H_INCLUDED

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "waveform.h"
#include "iqn.h"

/* ---- random numbers: the same everywhere ---- */

typedef struct chance {
    unsigned long long state;
} chance;

static chance chance_of(unsigned long long seed, unsigned long long stream)
{
    chance c;
    int i;
    c.state = 88172645463325252ULL ^ (seed * 0x9E3779B97F4A7C15ULL) ^ (stream * 0xC2B2AE3D27D4EB4FULL);
    if (c.state == 0) c.state = 1;
    for (i = 0; i < 20; i++) {
        c.state ^= c.state >> 12, c.state ^= c.state << 25, c.state ^= c.state >> 27;
    }
    return c;
}

static double uniform(chance *c) /* in (-1, 1) */
{
    c->state ^= c->state >> 12, c->state ^= c->state << 25, c->state ^= c->state >> 27;
    return (double)((c->state * 2685821657736338717ULL) >> 11) / 4503599627370496.0 - 1;
}

static double between(chance *c, double low, double high)
{
    return low + (high - low) * 0.5 * (1 + uniform(c));
}

static int integer(chance *c, int low, int high)
{
    return low + (int)((high - low + 1) * 0.4999999999 * (1 + uniform(c)));
}

static double normal(chance *c) /* twelve uniform numbers: no logarithm that differs between libraries */
{
    double s = 0;
    int k;
    for (k = 0; k < 12; k++) s += 0.5 * uniform(c);
    return s;
}

/* ---- problems ---- */

typedef struct problem problem;
struct problem {
    ptrdiff_t n;
    int windows, columns; /* columns: pairs that a contender stores at most, the same for all */
    int limit;            /* evaluations in a window, at most */
    int ends;             /* 1: the run ends with the first window that fails */
    double reduction;     /* converged when |r| <= reduction |r of the window's first evaluation|; 0: not so */
    double relative;      /*             or |r| <= relative |hx| */
    double shake;         /* first guesses are off by so much, other numbers for every seed: its course hangs on last bits */
    int blind;            /* 1: the limits are for the contender alone, which must say itself when it is done */
    /* x: the answer of the window before; out: the first guess.  NULL: the answer of the window before. */
    void (*start)(problem *p, int window, double *x);
    /* hx = H(x).  < 0: no answer; 1: the problem's own criterion holds; 0: it does not, or there is none. */
    int (*map)(problem *p, const double *x, double *hx);
    void (*metric)(problem *p, const double *r, double *y); /* y = M r, for the contender that asks; NULL: none */
    void (*accept)(problem *p, const double *x, const double *hx); /* the window is done; NULL: nothing to do */
    void (*release)(problem *p);
    void *state;
};

typedef struct family {
    const char *group, *name;
    void (*build)(problem *p, int variant, unsigned long long seed);
    int variant, count, quick; /* problems in full and in quick runs; 0: all of them, with at most 24 windows */
} family;

/* ---- the judge: counts, and decides what has converged ---- */

typedef struct judge {
    problem *p;
    int evaluations, in_window;
    double first, last; /* |r| of the window's first evaluation, < 0: there was none; of the last one */
} judge;

static int evaluate(judge *j, const double *x, double *hx); /* 1: converged; 0: not; -1: no answer, or the limit */

/* ---- contenders ---- */

typedef struct contender contender;
struct contender {
    const char *name;
    void *(*make)(const contender *c, problem *p);
    /* x: the next input.  < 0: fails; STEP_CONVERGED, STEP_GIVES_UP: what the contender itself says; else 0 */
    int (*step)(void *state, double *x, const double *hx);
    void (*commit)(void *state), (*discard)(void *state), (*release)(void *state);
    int (*window)(judge *j, int columns, double *x, double *hx); /* or: a whole window, H called by the contender */
    double omega, limit;
    int windows, kind;
};
enum { STEP_GOES_ON = 0, STEP_CONVERGED = 1, STEP_GIVES_UP = 2 };

/* ---- one run ---- */

enum { WINDOWS = 100 };
typedef struct outcome {
    int evaluations, failed; /* of all windows; windows that failed, those not run included */
    int gave_up, false_end;  /* of them, by the contender's own word; said to have converged and had not */
    double reduction;        /* |r| over the first |r| where it said so */
    short each[WINDOWS];     /* evaluations of every window; 0: not run */
} outcome;

/* ---- vectors ---- */

static void *memory(size_t bytes)
{
    void *p = calloc(1, bytes ? bytes : 1);
    if (!p) {
        fprintf(stderr, "no memory\n");
        exit(1);
    }
    return p;
}

static double *numbers(ptrdiff_t n)
{
    return (double *)memory((size_t)n * sizeof(double));
}

static void copy(ptrdiff_t n, const double *from, double *to)
{
    memcpy(to, from, (size_t)n * sizeof *to);
}

static double product(ptrdiff_t n, const double *a, const double *b)
{
    double s = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) s += a[i] * b[i];
    return s;
}

static double length(ptrdiff_t n, const double *a)
{
    return sqrt(product(n, a, a));
}

static void add(ptrdiff_t n, double a, const double *x, double *y) /* y += a x */
{
    ptrdiff_t i;
    for (i = 0; i < n; i++) y[i] += a * x[i];
}

static int finite_all(ptrdiff_t n, const double *x)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++)
        if (!(fabs(x[i]) <= DBL_MAX)) return 0;
    return 1;
}

static int evaluate(judge *j, const double *x, double *hx)
{
    const problem *p = j->p;
    double r = 0;
    ptrdiff_t i;
    int own;
    if (j->in_window == p->limit) return -1;
    j->evaluations++, j->in_window++;
    own = p->map(j->p, x, hx);
    if (own < 0 || !finite_all(p->n, hx)) return -1;
    for (i = 0; i < p->n; i++) r += (hx[i] - x[i]) * (hx[i] - x[i]);
    r = sqrt(r);
    if (j->first < 0) j->first = r;
    j->last = r;
    if (own || r == 0) return 1;
    if (p->blind) return 0;
    if (p->reduction > 0 && r <= p->reduction * j->first) return 1;
    return p->relative > 0 && r <= p->relative * length(p->n, hx);
}

#endif
