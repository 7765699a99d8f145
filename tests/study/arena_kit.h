/* SPDX-License-Identifier: MIT

   arena_kit.h - iqn.h as a contender: every key that the arena sets stands in this file. */
#ifndef ARENA_KIT_H_INCLUDED
#define ARENA_KIT_H_INCLUDED
#include "arena.h"

enum { KIT_DEFAULT, KIT_IMVJ, KIT_WINDOWS, KIT_AITKEN, KIT_METRIC };

static double kit_noise;              /* relative error of H that the host states; 0: it says nothing */
static const int kit_noise_known = 1; /* there is a key for it */

typedef struct kit {
    iqn *q;
    void *block;
    int judged; /* the kit knows the tolerance */
    problem *measured; /* by a metric of its own, or NULL */
    double *r, *y;
} kit;

static void *kit_make(const contender *c, problem *p)
{
    kit *k = (kit *)memory(sizeof *k);
    const size_t bytes = iqn_size(p->n, p->columns, 1);
    k->block = memory(bytes);
    if (iqn_make(&k->q, p->n, p->columns, 1, k->block, bytes) < 0) {
        fprintf(stderr, "iqn_make\n");
        exit(1);
    }
    k->r = numbers(p->n), k->y = numbers(p->n);
    if (c->kind == KIT_METRIC && p->metric) k->measured = p;
    k->judged = p->reduction > 0 || p->relative > 0;
    if (p->reduction > 0) iqn_set(k->q, IQN_TOL_REDUCTION, p->reduction);
    if (p->relative > 0) iqn_set(k->q, IQN_TOL_RELATIVE, p->relative);
    if (kit_noise > 0) iqn_set(k->q, IQN_NOISE_LEVEL, kit_noise);
    if (c->kind == KIT_IMVJ) iqn_set(k->q, IQN_METHOD, IQN_IMVJ);
    if (c->kind == KIT_AITKEN) iqn_set(k->q, IQN_METHOD, IQN_AITKEN);
    if (c->kind == KIT_WINDOWS) iqn_set(k->q, IQN_WINDOWS, c->windows);
    return k;
}

static int kit_step(void *state, double *x, const double *hx)
{
    kit *k = (kit *)state;
    int status;
    if (k->measured) {
        copy(k->measured->n, hx, k->r);
        add(k->measured->n, -1, x, k->r);
        k->measured->metric(k->measured, k->r, k->y);
        status = iqn_step_metric(k->q, x, hx, k->y);
    } else status = iqn_step(k->q, x, hx);
    if (status < 0) return -1;
    return k->judged ? iqn_converged(k->q) : STEP_GOES_ON;
}

static void kit_commit(void *state)
{
    iqn_commit(((kit *)state)->q);
}

static void kit_discard(void *state)
{
    iqn_discard(((kit *)state)->q);
}

static void kit_release(void *state)
{
    kit *k = (kit *)state;
    free(k->block), free(k->r), free(k->y), free(k);
}

#endif
