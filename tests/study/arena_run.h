/* SPDX-License-Identifier: MIT

   arena_run.h - one contender on one problem, and the contenders. */
#ifndef ARENA_RUN_H_INCLUDED
#define ARENA_RUN_H_INCLUDED
#include "arena_kit.h"
#include "arena_rivals.h"
#ifdef HAVE_SUNDIALS
#  include "arena_kinsol.h"
#endif

#define KIT kit_make, kit_step, kit_commit, kit_discard, kit_release, NULL
#define RIVAL rival_make, rival_step, rival_commit, rival_discard, rival_release, NULL
/* Rows that other files refer to by number */
enum { DEFAULT, ONE_2, ONE_4, ONE_6, ONE_8, EIGHT_2, EIGHT_3, EIGHT_8, SIXTEEN_3, ALL_6, EIGHT_SVD, ALL_SVD, IMVJ_2, IMVJ_6, AITKEN };
static const contender contenders[] = {
    {"default", KIT, 0, 0, 0, KIT_DEFAULT},
    {"one window 1e-2", rival_make, alone_step, rival_commit, rival_discard, rival_release, NULL, 0.1, 1e-2, 0, QR2},
    {"one window 1e-4", rival_make, alone_step, rival_commit, rival_discard, rival_release, NULL, 0.1, 1e-4, 0, QR2},
    {"one window 1e-6", rival_make, alone_step, rival_commit, rival_discard, rival_release, NULL, 0.1, 1e-6, 0, QR2},
    {"one window 1e-8", rival_make, alone_step, rival_commit, rival_discard, rival_release, NULL, 0.1, 1e-8, 0, QR2},
    {"8 windows 1e-2", RIVAL, 0.1, 1e-2, 8, QR2},
    {"8 windows 1e-3", RIVAL, 0.01, 1e-3, 8, QR2},
    {"8 windows 1e-8", RIVAL, 0.1, 1e-8, 8, QR2},
    {"16 windows 1e-3", RIVAL, 0.1, 1e-3, 16, QR2},
    {"all pairs 1e-6", RIVAL, 0.1, 1e-6, 1000, QR2},
    {"8 windows, dgelsd 1e-7", RIVAL, 0.1, 1e-7, 8, SINGULAR},
    {"all pairs, dgelsd 1e-10", RIVAL, 0.1, 1e-10, 1000, SINGULAR},
    {"IMVJ 1e-2", RIVAL, 0.1, 1e-2, 1000, IMVJ},
    {"IMVJ 1e-6", RIVAL, 0.1, 1e-6, 1000, IMVJ},
    {"Aitken", rival_make, aitken_step, aitken_commit, rival_discard, rival_release, NULL, 0.1, 0, 0, QR2},
    {"safeguarded", rival_make, safeguarded_step, rival_commit, rival_discard, rival_release, NULL, 1, 1e-8, 0, QR2},
#ifdef HAVE_SUNDIALS
    {"KINSOL", rival_make, rival_step, rival_commit, rival_discard, rival_release, kinsol_window, 1, 0, 0, QR2},
#endif
    {"iqn.h, one window", KIT, 0, 0, 0, KIT_WINDOWS},
    {"iqn.h, 8 windows", KIT, 0, 0, 8, KIT_WINDOWS},
    {"iqn.h, IMVJ", KIT, 0, 0, 0, KIT_IMVJ},
    {"iqn.h, metric", KIT, 0, 0, 0, KIT_METRIC},
};
enum { CONTENDERS = (int)(sizeof contenders / sizeof *contenders), METRIC = CONTENDERS - 1 };

/* A window: 1 converged, 0 not */
static int run_window(judge *j, const contender *c, void *state, double *x, double *hx, outcome *o)
{
    int verdict, status;
    if (c->window) return c->window(j, j->p->columns, x, hx);
    for (;;) {
        verdict = evaluate(j, x, hx);
        if (verdict < 0) return 0;
        status = c->step(state, x, hx);
        if (verdict) return 1;
        if (status == STEP_CONVERGED) o->false_end++, o->reduction = j->last / j->first;
        if (status == STEP_GIVES_UP) o->gave_up++;
        if (status != STEP_GOES_ON || !finite_all(j->p->n, x)) return 0;
    }
}

/* Among runs of one problem */
static void shake(ptrdiff_t n, double size, chance *c, double *x)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++) x[i] *= 1 + size * uniform(c);
}

static outcome run(const family *f, unsigned long long seed, int shortened, const contender *c)
{
    problem p;
    judge j = {NULL, 0, 0, 0, 0};
    chance c_guess = chance_of(seed, 5);
    outcome o;
    double *x, *hx, *answer;
    void *state;
    int w, done;
    memset(&p, 0, sizeof p), memset(&o, 0, sizeof o);
    f->build(&p, f->variant, seed);
    j.p = &p;
    if (shortened && p.windows > 24) p.windows = 24;
    x = numbers(p.n), hx = numbers(p.n), answer = numbers(p.n);
    state = c->make(c, &p);
    for (w = 0; w < p.windows; w++) {
        copy(p.n, answer, x);
        if (p.start) p.start(&p, w, x);
        if (f->count > 1 && p.shake > 0) shake(p.n, p.shake, &c_guess, x);
        j.in_window = 0, j.first = -1;
        done = run_window(&j, c, state, x, hx, &o);
        if (w < WINDOWS) o.each[w] = (short)j.in_window;
        if (done) {
            copy(p.n, hx, answer);
            if (p.accept) p.accept(&p, x, hx);
            c->commit(state);
            continue;
        }
        o.failed += p.ends ? p.windows - w : 1;
        if (p.ends) break;
        c->discard(state);
    }
    c->release(state);
    p.release(&p);
    o.evaluations = j.evaluations;
    free(x), free(hx), free(answer);
    return o;
}

#endif
