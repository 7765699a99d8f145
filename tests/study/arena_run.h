/* SPDX-License-Identifier: MIT

   arena_run.h - one contender through all windows of one problem.  The judge alone decides what has converged. */
#ifndef ARENA_RUN_H_INCLUDED
#define ARENA_RUN_H_INCLUDED
#include "arena.h"

typedef struct outcome {
    int evaluations, failed; /* of all windows; windows that failed, and those not run */
} outcome;

/* Evaluations of a window, < 0: it failed.  The judge alone decides what has converged. */
static int run_window(problem *p, const contender *c, void *state, double *x, double *hx)
{
    const int judged = p->reduction > 0 || p->relative > 0; /* the contender knows the limits, too, and may give up */
    double first = 0, r;
    ptrdiff_t i;
    int k, done, status;
    for (k = 1; k <= p->limit; k++) {
        done = p->map(p, x, hx);
        if (done < 0 || !finite_all(p->n, hx)) return -k;
        for (r = 0, i = 0; i < p->n; i++) r += (hx[i] - x[i]) * (hx[i] - x[i]);
        r = sqrt(r);
        if (k == 1) first = r;
        done |= r == 0 || r <= p->reduction * first || (p->relative > 0 && r <= p->relative * length(p->n, hx));
        status = c->step(state, x, hx);
        if (done) return k;
        if (status < 0 || (judged && status > 0) || !finite_all(p->n, x)) return -k;
    }
    return -p->limit;
}

static outcome run(const family *f, unsigned long long seed, int shortened, const contender *c)
{
    problem p;
    chance guess = chance_of(seed, 5);
    outcome o = {0, 0};
    double *x, *hx, *answer;
    void *state;
    ptrdiff_t i;
    int w, k;
    memset(&p, 0, sizeof p);
    f->build(&p, f->variant, seed);
    if (shortened && p.windows > 24) p.windows = 24;
    x = numbers(p.n), hx = numbers(p.n), answer = numbers(p.n);
    state = c->make(c, &p);
    for (w = 0; w < p.windows; w++) {
        copy(p.n, answer, x);
        if (p.start) p.start(&p, w, x);
        for (i = 0; i < p.n && p.shake > 0; i++) x[i] *= 1 + p.shake * uniform(&guess);
        k = run_window(&p, c, state, x, hx);
        o.evaluations += abs(k);
        if (k > 0) {
            copy(p.n, hx, answer);
            if (p.accept) p.accept(&p, hx);
            c->commit(state);
            continue;
        }
        o.failed += p.ends ? p.windows - w : 1;
        if (p.ends) break;
        c->discard(state);
    }
    c->release(state);
    if (p.release) p.release(&p);
    free(p.state), free(x), free(hx), free(answer);
    return o;
}

#endif
