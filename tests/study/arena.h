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

/* ---- random numbers: the same everywhere ---- */

typedef struct chance {
    unsigned long long state;
} chance;

static unsigned long long chance_next(chance *c)
{
    c->state ^= c->state >> 12, c->state ^= c->state << 25, c->state ^= c->state >> 27;
    return c->state;
}

static chance chance_of(unsigned long long seed, unsigned long long stream)
{
    chance c;
    int i;
    c.state = 88172645463325252ULL ^ (seed * 0x9E3779B97F4A7C15ULL) ^ (stream * 0xC2B2AE3D27D4EB4FULL);
    for (i = 0; i < 20; i++) chance_next(&c);
    return c;
}

static double uniform(chance *c) /* in (-1, 1) */
{
    return (double)((chance_next(c) * 2685821657736338717ULL) >> 11) / 4503599627370496.0 - 1;
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

/* A word makes the seeds; "judge" and "dev" are those of 0.2.0, and a number is itself. */
static unsigned long long first_seed(const char *word)
{
    unsigned long long seed = 0;
    if (strcmp(word, "dev") == 0) return 1;
    if (strcmp(word, "judge") == 0) return 1000000;
    if (word[strspn(word, "0123456789")] == 0) return strtoull(word, NULL, 10);
    for (; *word; word++) seed = (seed * 131 + (unsigned char)*word) % 1000000007;
    return 2000000 + seed;
}

/* ---- vectors ---- */

static void *memory(size_t bytes)
{
    void *p = calloc(1, bytes ? bytes : 1);
    if (!p) fprintf(stderr, "no memory\n"), exit(1);
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

/* ---- problems and contenders ---- */

enum { FIELDS = 1, END = 2, MULTI = 4 }; /* two fields of other units; the last sample alone is weighted; IMVJ */

typedef struct problem problem;
struct problem {
    ptrdiff_t n;
    int windows, columns; /* columns: pairs that a contender stores at most, the same for all */
    int limit;            /* evaluations in a window, at most */
    int ends;             /* 1: the run ends with the first window that fails */
    int flags, blocks;    /* what the host tells; equal parts of x, 0: one */
    double reduction;     /* converged when |r| <= reduction |r of the window's first evaluation|; 0: not so */
    double relative;      /*             or |r| <= relative |hx| */
    double shake;         /* first guesses are off by so much, other numbers for every seed: its course hangs on last bits */
    double noise;         /* relative error of H that the host states; 0: it says nothing */
    /* x: the answer of the window before; out: the first guess.  NULL: the answer of the window before. */
    void (*start)(problem *p, int window, double *x);
    /* hx = H(x).  < 0: no answer; 1: the problem's own criterion holds; 0: it does not, or there is none. */
    int (*map)(problem *p, const double *x, double *hx);
    void (*accept)(problem *p, const double *hx); /* the window is done; NULL: nothing to do */
    void (*release)(problem *p); /* what hangs on state; NULL: nothing */
    void *state;
};

typedef struct family {
    const char *group, *name;
    void (*build)(problem *p, int variant, unsigned long long seed);
    int variant, count; /* problems */
} family;

typedef struct contender contender;
struct contender {
    const char *name;
    void *(*make)(const contender *c, problem *p);
    /* x: the next input.  < 0: fails; > 0: the contender itself says that it has converged, or gives up */
    int (*step)(void *state, double *x, const double *hx);
    void (*commit)(void *state), (*discard)(void *state), (*release)(void *state);
    double omega, limit; /* first relaxation; which pairs are dropped */
    int windows, kind;   /* that pairs are kept for */
};
enum { LEAST_SQUARES, GROUPS, OMEGA }; /* kinds: all pairs of some windows; IMVJ; Aitken's */

#endif
