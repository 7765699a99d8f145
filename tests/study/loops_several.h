/* SPDX-License-Identifier: MIT

   loops_several.h - maps with several fixed points: which of them is reached does not matter, that one is reached does.
   Plain damping reaches one from every start. */
#ifndef LOOPS_SEVERAL_H_INCLUDED
#define LOOPS_SEVERAL_H_INCLUDED
#include "loops_kit.h"

enum { PLAYERS = 60 };

typedef struct several {
    int n;
    double a[PLAYERS], W[PLAYERS * PLAYERS], warm, strength;
    chance starts;
} several;

/* Quantal response of players who do not want to do what the others do: x = 1 / (1 + exp(-(a - strength others) / T)) */
static int logit_map(problem *p, const double *x, double *hx)
{
    several *s = (several *)p->state;
    double all = 0;
    int i;
    for (i = 0; i < s->n; i++) all += x[i];
    for (i = 0; i < s->n; i++) hx[i] = 1 / (1 + exp(-(s->a[i] - s->strength * (all - x[i]) / (s->n - 1)) / s->warm));
    return 0;
}

static int neurons_map(problem *p, const double *x, double *hx) /* x = tanh((W x + a) / T), W symmetric */
{
    several *s = (several *)p->state;
    int i;
    for (i = 0; i < s->n; i++) hx[i] = tanh((product(s->n, s->W + i * s->n, x) + s->a[i]) / s->warm);
    return 0;
}

static int genes_map(problem *p, const double *x, double *hx) /* each is repressed by others: Hill's law */
{
    several *s = (several *)p->state;
    int i, j;
    for (i = 0; i < s->n; i++) {
        double u = 0;
        for (j = 0; j < s->n; j++) u += s->W[i * s->n + j] * fmax(x[j], 0);
        hx[i] = s->a[i] / (1 + pow(u, 3));
    }
    return 0;
}

static void several_start(problem *p, int window, double *x)
{
    several *s = (several *)p->state;
    int i;
    (void)p;
    (void)window;
    for (i = 0; i < s->n; i++) x[i] = 0.5 + 0.005 * uniform(&s->starts);
}

enum { LOGIT_8, LOGIT_30, LOGIT_RANDOM, NEURONS, GENES, SEVERAL };
static const char *const several_names[] = {"logit, 8 players", "logit, 30 players", "logit, random", "neurons",
                                            "genes"};

/* window: a start; every start is a run of its own */
static void several_build(problem *p, int kind, unsigned long long seed)
{
    several *s = (several *)memory(sizeof *s);
    chance c = chance_of(seed, 250 + (unsigned long long)kind);
    int i, j;
    s->starts = chance_of(seed, 260 + (unsigned long long)kind);
    s->n = kind == LOGIT_8 ? 8 : kind == LOGIT_30 ? 30 : integer(&c, 4, 30);
    s->warm = kind == LOGIT_RANDOM ? between(&c, 0.08, 0.2) : kind == NEURONS ? between(&c, 0.3, 0.7) : 0.1;
    s->strength = kind == LOGIT_RANDOM ? between(&c, 3, 16) : 16;
    for (i = 0; i < s->n; i++) {
        s->a[i] = kind == LOGIT_RANDOM ? uniform(&c) : -0.9 + 1.8 * i / (s->n - 1);
        if (kind == NEURONS) s->a[i] = 0.05 * normal(&c);
        if (kind == GENES) s->a[i] = between(&c, 1, 4);
        for (j = 0; j <= i; j++) {
            const double w = kind == NEURONS ? normal(&c) / sqrt(s->n) : between(&c, 0, 2.) / sqrt(s->n);
            s->W[i * s->n + j] = s->W[j * s->n + i] = w;
        }
    }
    host_is(p, s, s->n, 1e-8);
    p->windows = 20;
    p->limit = 500;
    p->start = several_start;
    p->map = kind == NEURONS ? neurons_map : kind == GENES ? genes_map : logit_map;
}

#endif
