/* SPDX-License-Identifier: MIT

   petsc_snes.c - iqn.h as a nonlinear solver of PETSc: -snes_type iqn, for any Vec, on any ranks

       cc -shared -fPIC petsc_snes.c $(pkg-config --cflags --libs petsc) -lm -o libiqn.so
       ./any_petsc_program -dll_append ./libiqn.so -snes_type iqn -snes_monitor    # no line of it changes

   F(x) = 0 becomes x = H(x): with a nonlinear preconditioner (-npc_snes_type) H is its solve, without one x - F(x).
   One reduction a step (VecMDotBegin), one VecMAXPY.  Pairs stay from solve to solve, for time steps and continuation.
   Options: -snes_iqn_columns 20, -snes_iqn_windows -1, -snes_iqn_omega 1. */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <petsc/private/snesimpl.h>

#define REAL(z) ((double)PetscRealPart(z))             /* of complex numbers the inner product is the real part */
enum { HALVINGS = 10, MOST = 1000, SLOTS = MOST + 2 }; /* halvings: of a step to an F that is not finite; pairs */

typedef struct plug {
    iqn *q;
    PetscInt columns, windows;
    PetscReal omega;
    Vec *V, *W, v, s;    /* r and hx of iterates and pairs; v, and s = w - v, of the newest */
    Vec with[2 * SLOTS]; /* what is multiplied or added up, the products or factors */
    PetscScalar number[2 * SLOTS];
    double dot[IQN_DOTS + 2 * MOST], weight[2 * SLOTS];
    int slot[SLOTS], slots;
} plug;

static PetscErrorCode reset(SNES snes)
{
    plug *p = (plug *)snes->data;
    PetscCall(VecDestroyVecs(2 * p->slots + 2, &p->V));
    return PetscFree(p->q);
}

static PetscErrorCode destroy(SNES snes)
{
    return PetscFree(snes->data); /* after reset */
}

static PetscErrorCode set_up(SNES snes)
{
    plug *p = (plug *)snes->data;
    const int columns = (int)PetscMin(p->columns, MOST);
    const size_t bytes = iqn_size(IQN_HOST, columns, 1);
    PetscCall(PetscMalloc(bytes, &p->q));
    if (iqn_make(&p->q, IQN_HOST, columns, 1, p->q, bytes) < 0 || iqn_set(p->q, IQN_OMEGA, (double)p->omega) < 0 ||
        iqn_set(p->q, IQN_WINDOWS, p->windows) < 0 || iqn_set(p->q, IQN_PATIENCE, 0) < 0) /* -snes_max_it ends it */
        SETERRQ(PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "an option of -snes_type iqn");
    p->slots = columns + 2;
    PetscCall(VecDuplicateVecs(snes->vec_sol, 2 * p->slots + 2, &p->V));
    p->W = p->V + p->slots;
    p->v = p->W[p->slots];
    p->s = p->W[p->slots + 1];
    return 0;
}

/* p->dot: the products of iqn_weights, summed over the ranks in one reduction */
static PetscErrorCode form_products(plug *p, Vec r, Vec h, int pairs)
{
    PetscScalar *of_r = p->number, *of_v = p->number + SLOTS + 1, hh, ss;
    for (int j = 0; j < pairs; j++) p->with[j] = p->V[p->slot[2 + j]];
    p->with[pairs] = p->v;
    p->with[pairs + 1] = p->s;
    p->with[pairs + 2] = r;
    PetscCall(VecMDotBegin(r, pairs + 3, p->with, of_r));
    PetscCall(VecMDotBegin(p->v, pairs + 2, p->with, of_v));
    PetscCall(VecDotBegin(h, h, &hh));
    PetscCall(VecDotBegin(p->s, p->s, &ss));
    PetscCall(VecMDotEnd(r, pairs + 3, p->with, of_r));
    PetscCall(VecMDotEnd(p->v, pairs + 2, p->with, of_v));
    PetscCall(VecDotEnd(h, h, &hh));
    PetscCall(VecDotEnd(p->s, p->s, &ss));
    for (int j = 0; j < pairs; j++) {
        p->dot[IQN_DOTS + 2 * j] = REAL(of_r[j]);
        p->dot[IQN_DOTS + 2 * j + 1] = REAL(of_v[j]);
    }
    p->dot[IQN_DOT_RR] = REAL(of_r[pairs + 2]);
    p->dot[IQN_DOT_HH] = REAL(hh);
    p->dot[IQN_DOT_VV] = p->slot[1] < 0 ? 0 : REAL(of_v[pairs]);
    p->dot[IQN_DOT_VR] = REAL(of_r[pairs]);
    p->dot[IQN_DOT_SS] = REAL(ss);
    p->dot[IQN_DOT_SV] = REAL(of_v[pairs + 1]);
    return 0;
}

/* x: what H is evaluated at next; hx stands in W[now], r in V[now] */
static PetscErrorCode next_input(SNES snes, int pairs, Vec x)
{
    plug *p = (plug *)snes->data;
    const int now = p->slot[0], base = p->slot[1];
    int k, store, status, count = 0;
    if (base >= 0) {
        PetscCall(VecWAXPY(p->v, -1, p->V[base], p->V[now]));
        PetscCall(VecWAXPY(p->s, -1, p->W[base], p->W[now]));
        PetscCall(VecAXPY(p->s, -1, p->v));
    }
    PetscCall(form_products(p, p->V[now], p->W[now], pairs));
    status = iqn_weights(p->q, p->dot, p->weight, &store);
    PetscCheck(status >= 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "iqn.h: %s", iqn_message(status));
    PetscCall(PetscInfo(snes, "iqn.h: %s\n", iqn_message(status)));
    if (store >= 0) {
        PetscCall(VecWAXPY(p->W[store], 1, p->v, p->s));
        PetscCall(VecCopy(p->v, p->V[store]));
    }
    for (k = 0; k < 2 * p->slots; k++) {
        if (!(p->weight[k] != 0)) continue;
        p->number[count] = p->weight[k];
        p->with[count++] = p->V[k]; /* W stands behind V */
    }
    PetscCall(VecZeroEntries(x));
    return VecMAXPY(x, count, p->number, p->with);
}

static PetscErrorCode judge(SNES snes, PetscReal norm)
{
    snes->norm = norm;
    PetscCall(SNESLogConvergenceHistory(snes, norm, 0));
    PetscCall(SNESMonitor(snes, snes->iter, norm));
    return (*snes->ops->converged)(snes, snes->iter, 0, 0, norm, &snes->reason, snes->cnvP);
}

/* F(x); where it is not finite, x goes back towards the base, half of the way each time */
static PetscErrorCode function(SNES snes, Vec x)
{
    plug *p = (plug *)snes->data;
    PetscReal norm;
    for (int k = 0; k <= HALVINGS; k++) {
        PetscCall(SNESComputeFunction(snes, x, snes->vec_func));
        PetscCall(VecNorm(snes->vec_func, NORM_2, &norm));
        if (!PetscIsInfOrNanReal(norm) || iqn_halve(p->q, NULL) < 0) break;
        (void)iqn_ask(p->q, p->slot);
        PetscCall(VecAXPBYPCZ(x, 0.5, -0.5, 0.5, p->W[p->slot[1]], p->V[p->slot[1]]));
    }
    return judge(snes, norm);
}

static PetscErrorCode solve(SNES snes)
{
    plug *p = (plug *)snes->data;
    const Vec x = snes->vec_sol, f = snes->vec_func;
    PetscReal norm;
    snes->reason = SNES_CONVERGED_ITERATING;
    snes->iter = 0;
    PetscCall(function(snes, x));
    while (!snes->reason && snes->iter < snes->max_its) {
        const int pairs = iqn_ask(p->q, p->slot);
        const Vec r = p->V[p->slot[0]], hx = p->W[p->slot[0]];
        snes->iter++;
        if (snes->npc) {
            PetscCall(VecCopy(x, hx));
            PetscCall(SNESSolve(snes->npc, snes->vec_rhs, hx));
            PetscCall(SNESGetNPCFunction(snes, f, &norm)); /* of hx, which may be the answer */
            PetscCall(judge(snes, norm));
            if (snes->reason) PetscCall(VecCopy(hx, x));
            if (snes->reason) break;
        } else PetscCall(VecWAXPY(hx, -1, f, x));
        PetscCall(VecWAXPY(r, -1, x, hx));
        PetscCall(next_input(snes, pairs, x));
        if (!snes->npc) PetscCall(function(snes, x));
    }
    if (!snes->reason) snes->reason = SNES_DIVERGED_MAX_IT;
    (void)(snes->reason > 0 ? iqn_commit(p->q) : iqn_discard(p->q));
    return 0;
}

static PetscErrorCode set_from_options(SNES snes, PetscOptionItems *PetscOptionsObject)
{
    plug *p = (plug *)snes->data;
    PetscOptionsHeadBegin(PetscOptionsObject, "iqn.h");
    PetscCall(PetscOptionsInt("-snes_iqn_columns", "pairs", "", p->columns, &p->columns, NULL));
    PetscCall(PetscOptionsInt("-snes_iqn_windows", "IQN_WINDOWS", "", p->windows, &p->windows, NULL));
    PetscCall(PetscOptionsReal("-snes_iqn_omega", "IQN_OMEGA", "", p->omega, &p->omega, NULL));
    PetscOptionsHeadEnd();
    return 0;
}

PETSC_EXTERN PetscErrorCode SNESCreate_IQN(SNES snes);
PETSC_EXTERN PetscErrorCode SNESCreate_IQN(SNES snes)
{
    plug *p;
    PetscCall(PetscNew(&p));
    p->columns = 20;
    p->windows = -1;
    p->omega = 1;
    snes->data = p;
    snes->ops->setup = set_up;
    snes->ops->solve = solve;
    snes->ops->reset = reset;
    snes->ops->destroy = destroy;
    snes->ops->setfromoptions = set_from_options;
    snes->usesnpc = PETSC_TRUE;
    return 0;
}

PETSC_EXTERN PetscErrorCode PetscDLLibraryRegister_iqn(void);
PETSC_EXTERN PetscErrorCode PetscDLLibraryRegister_iqn(void) /* what -dll_append libiqn.so calls */
{
    return SNESRegister("iqn", SNESCreate_IQN);
}
