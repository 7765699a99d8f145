/* SPDX-License-Identifier: MIT

   arena_kinsol.h - Anderson acceleration of SUNDIALS, which calls H itself.  Anew in every window. */
#ifndef ARENA_KINSOL_H_INCLUDED
#define ARENA_KINSOL_H_INCLUDED
#include "arena.h"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>

typedef struct kinsol_watch {
    judge *j;
    double *x, *hx;
    int verdict;
} kinsol_watch;

static int kinsol_map(N_Vector u, N_Vector g, void *user)
{
    kinsol_watch *w = (kinsol_watch *)user;
    const ptrdiff_t n = w->j->p->n;
    if (!finite_all(n, N_VGetArrayPointer(u))) return -1;
    copy(n, N_VGetArrayPointer(u), w->x);
    w->verdict = evaluate(w->j, w->x, w->hx);
    copy(n, w->hx, N_VGetArrayPointer(g));
    return w->verdict == 0 ? 0 : -1; /* the judge has seen enough */
}

/* 1: the window has converged; the answer is in hx */
static int kinsol_window(judge *j, int columns, double *x, double *hx)
{
    const ptrdiff_t n = j->p->n;
    kinsol_watch w = {NULL, NULL, NULL, 0};
    SUNContext context;
    N_Vector u, scale;
    void *kin;
    SUNContext_Create(NULL, &context);
    w.j = j, w.x = x, w.hx = hx;
    u = N_VNew_Serial((sunindextype)n, context), scale = N_VNew_Serial((sunindextype)n, context);
    copy(n, x, N_VGetArrayPointer(u));
    N_VConst(1, scale);
    kin = KINCreate(context);
    KINSetUserData(kin, &w);
    KINSetMAA(kin, n < columns ? (long)n : columns);
    KINSetNumMaxIters(kin, j->p->limit);
    KINInit(kin, kinsol_map, u);
    KINSetFuncNormTol(kin, 1e-300);
    KINSetErrFile(kin, NULL);
    KINSol(kin, u, KIN_FP, scale, scale);
    KINFree(&kin);
    N_VDestroy(u), N_VDestroy(scale);
    SUNContext_Free(&context);
    return w.verdict == 1;
}

#endif
