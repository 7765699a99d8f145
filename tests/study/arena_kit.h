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
    problem *measured; /* by a metric of its own, or NULL: then this is a host of the core, and the vectors are here */
    int slots;
    double *V, *W, *y, *z;
} kit;

static void *kit_make(const contender *c, problem *p)
{
    kit *k = (kit *)memory(sizeof *k);
    const size_t bytes = iqn_size(p->n, p->columns, 1);
    const int own = c->kind == KIT_METRIC && p->metric != NULL;
    k->block = memory(bytes);
    if (iqn_make(&k->q, own ? IQN_HOST : p->n, p->columns, 1, k->block, bytes) < 0) {
        fprintf(stderr, "iqn_make\n");
        exit(1);
    }
    k->slots = p->columns + 2;
    if (own) k->measured = p, k->V = numbers(k->slots * p->n), k->W = numbers(k->slots * p->n), k->y = numbers(2 * p->n), k->z = numbers(2 * p->n);
    k->judged = p->reduction > 0 || p->relative > 0;
    if (p->reduction > 0) iqn_set(k->q, IQN_TOL_REDUCTION, p->reduction);
    if (p->relative > 0) iqn_set(k->q, IQN_TOL_RELATIVE, p->relative);
    if (kit_noise > 0) iqn_set(k->q, IQN_NOISE_LEVEL, kit_noise);
    if (c->kind == KIT_IMVJ) iqn_set(k->q, IQN_METHOD, IQN_IMVJ);
    if (c->kind == KIT_AITKEN) iqn_set(k->q, IQN_METHOD, IQN_AITKEN);
    if (c->kind == KIT_WINDOWS) iqn_set(k->q, IQN_WINDOWS, c->windows);
    return k;
}

/* A step with the inner product a'M b: see iqn_ask. */
static int kit_measured_step(kit *k, double *x, const double *hx)
{
    const ptrdiff_t n = k->measured->n;
    int slot[100], store, s, j, status;
    const int pairs = iqn_ask(k->q, slot), base = slot[1];
    double dot[200] = {0}, weight[200], *r = k->V + slot[0] * n, *h = k->W + slot[0] * n, *v = k->z, *d = k->z + n;
    double *Mr = k->y, *Mv = k->y + n;
    copy(n, hx, h), copy(n, hx, r), add(n, -1, x, r);
    k->measured->metric(k->measured, h, Mr);
    dot[IQN_DOT_HH] = product(n, h, Mr);
    k->measured->metric(k->measured, r, Mr);
    dot[IQN_DOT_RR] = product(n, r, Mr);
    if (base >= 0) {
        copy(n, r, v), add(n, -1, k->V + base * n, v);
        copy(n, h, d), add(n, -1, k->W + base * n, d), add(n, -1, v, d);
        k->measured->metric(k->measured, d, Mv);
        dot[IQN_DOT_SS] = product(n, d, Mv), dot[IQN_DOT_SV] = product(n, v, Mv);
        k->measured->metric(k->measured, v, Mv);
        dot[IQN_DOT_VV] = product(n, v, Mv), dot[IQN_DOT_VR] = product(n, v, Mr);
    }
    for (j = 0; j < pairs; j++) {
        dot[IQN_DOTS + 2 * j] = product(n, k->V + slot[2 + j] * n, Mr);
        dot[IQN_DOTS + 2 * j + 1] = product(n, k->V + slot[2 + j] * n, Mv);
    }
    status = iqn_weights(k->q, dot, weight, &store);
    if (status < 0) return status;
    if (store >= 0) {
        copy(n, h, d), add(n, -1, k->W + base * n, d);
        copy(n, v, k->V + store * n), copy(n, d, k->W + store * n);
    }
    memset(x, 0, (size_t)n * sizeof *x);
    for (s = 0; s < k->slots; s++) add(n, weight[s], k->V + s * n, x), add(n, weight[k->slots + s], k->W + s * n, x);
    return status;
}

static int kit_step(void *state, double *x, const double *hx)
{
    kit *k = (kit *)state;
    const int status = k->measured ? kit_measured_step(k, x, hx) : iqn_step(k->q, x, hx);
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
    free(k->block), free(k->V), free(k->W), free(k->y), free(k->z), free(k);
}

#endif
