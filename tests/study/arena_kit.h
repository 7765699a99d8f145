/* SPDX-License-Identifier: MIT

   arena_kit.h - iqn.h as a contender: every key that the arena sets stands in this file.  make arena OLD=FILE compiles it
   a second time, with another prefix, for an older version of the header. */
#ifndef ARENA_KIT_iqn
#define ARENA_KIT_iqn
#include "iqn.h"

static void *iqn_kit_make(const contender *c, problem *p)
{
    const int blocks = p->blocks ? p->blocks : 1;
    const size_t bytes = iqn_size(p->n, p->columns, blocks);
    iqn *q;
    int b;
    if (iqn_make(&q, p->n, p->columns, blocks, memory(bytes), bytes) < 0) fprintf(stderr, "iqn_make\n"), exit(1);
    if (p->reduction > 0) iqn_set(q, IQN_TOL_REDUCTION, p->reduction);
    if (p->relative > 0) iqn_set(q, IQN_TOL_RELATIVE, p->relative);
    if (p->noise > 0) iqn_set(q, IQN_NOISE_LEVEL, p->noise);
    if (p->flags & FIELDS) iqn_set_block(q, -1, IQN_SCALING, IQN_BY_RESIDUAL_SUM);
    for (b = 0; b < blocks - 1 && p->flags & END; b++) iqn_set_block(q, b, IQN_WEIGHT, 0);
    if (c->kind == GROUPS || (p->flags & MULTI && c->windows < 0)) iqn_set(q, IQN_METHOD, IQN_IMVJ);
    else iqn_set(q, IQN_WINDOWS, c->windows);
    if (c->omega > 0) iqn_set(q, IQN_OMEGA, c->omega);
    if (c->kind == OMEGA) iqn_set(q, IQN_METHOD, IQN_AITKEN);
    return q;
}

static int iqn_kit_step(void *q, double *x, const double *hx)
{
    return iqn_step((iqn *)q, x, hx) < 0 ? -1 : iqn_converged((iqn *)q);
}

static void iqn_kit_commit(void *q)
{
    iqn_commit((iqn *)q);
}

static void iqn_kit_discard(void *q)
{
    iqn_discard((iqn *)q);
}

#define IQN_KIT_CALLS iqn_kit_make, iqn_kit_step, iqn_kit_commit, iqn_kit_discard, free
#define IQN_KIT IQN_KIT_CALLS, 0, 0 /* the header's own omega */
#endif
