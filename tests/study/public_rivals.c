/* SPDX-License-Identifier: MIT

   public_rivals.c - a library for study_public.py: iqn.h, and those of KINSOL, PETSc and cvxgrp/aa that are installed, on
   x = H(x) with H from elsewhere.  Nobody has a limit of his own: H counts, and returns x itself once it has seen enough.
   Each takes what its documents name as the default; memory: of those that name none. */
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include <stdlib.h>
#include <string.h>

typedef void map(const double *x, double *hx);

/* Returns 1: converged by its own words, 2: gave up, < 0: refused. */
int run_iqn(int n, int columns, double omega, double limit, int most, map *H, double *x)
{
    const size_t bytes = iqn_size(n, columns, 1);
    void *mem = malloc(bytes);
    double *hx = (double *)malloc((size_t)n * sizeof *hx);
    int k, status = 0, end = 0;
    iqn *q;
    if (!mem || !hx || iqn_make(&q, n, columns, 1, mem, bytes) < 0) return -1;
    iqn_set(q, IQN_TOL_REDUCTION, limit);
    if (omega > 0) iqn_set(q, IQN_OMEGA, omega);
    for (k = 0; k < most && end == 0 && status >= 0; k++) {
        H(x, hx);
        status = iqn_step(q, x, hx);
        end = iqn_converged(q);
    }
    free(mem), free(hx);
    return status < 0 ? status : end;
}

#ifdef HAVE_KINSOL
#  include <kinsol/kinsol.h>
#  include <nvector/nvector_serial.h>
#  include <sundials/sundials_context.h>

static int kinsol_map(N_Vector u, N_Vector g, void *data)
{
    map *H;
    memcpy(&H, data, sizeof H);
    H(N_VGetArrayPointer(u), N_VGetArrayPointer(g));
    return 0;
}

int run_kinsol(int n, int memory, int most, map *H, double *x)
{
    SUNContext context;
    N_Vector u, scale;
    void *kin;
    int status;
    if (SUNContext_Create(NULL, &context) != 0) return -1;
    u = N_VNew_Serial(n, context), scale = N_VNew_Serial(n, context);
    memcpy(N_VGetArrayPointer(u), x, (size_t)n * sizeof *x);
    N_VConst(1, scale);
    kin = KINCreate(context);
    KINSetMAA(kin, memory < n ? memory : n); /* it refuses more */
    KINInit(kin, kinsol_map, u);
    KINSetUserData(kin, &H);
    KINSetNumMaxIters(kin, most);
    KINSetFuncNormTol(kin, 1e-200);
    KINSetErrHandlerFn(kin, NULL, NULL);
    status = KINSol(kin, u, KIN_FP, scale, scale);
    KINFree(&kin), N_VDestroy(u), N_VDestroy(scale), SUNContext_Free(&context);
    return status;
}
#endif

#ifdef HAVE_PETSC
#  include <petscsnes.h>

static PetscErrorCode petsc_map(SNES snes, Vec u, Vec f, void *data)
{
    const double *x;
    double *r;
    PetscInt n, i;
    map *H;
    (void)snes;
    memcpy(&H, data, sizeof H);
    VecGetLocalSize(u, &n), VecGetArrayRead(u, &x), VecGetArray(f, &r);
    H(x, r);
    for (i = 0; i < n; i++) r[i] = x[i] - r[i];
    VecRestoreArrayRead(u, &x), VecRestoreArray(f, &r);
    return 0;
}

/* type: a SNESType: anderson, ngmres, with its own memory of 30 */
int run_petsc(int n, const char *type, int most, map *H, double *x)
{
    SNES snes;
    Vec u, f;
    PetscInitializeNoArguments();
    VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, x, &u), VecDuplicate(u, &f);
    SNESCreate(PETSC_COMM_SELF, &snes);
    SNESSetType(snes, type);
    SNESSetFunction(snes, f, petsc_map, &H);
    SNESSetTolerances(snes, 1e-200, 1e-200, 0, most, 100 * most);
    SNESSolve(snes, NULL, u);
    SNESDestroy(&snes), VecDestroy(&u), VecDestroy(&f);
    return 0;
}
#endif

#ifdef AA
#  include "aa.h"

int run_aa(int n, int type1, int most, map *H, double *x)
{
    AaWork *a = aa_init(n, 10, 1, type1, type1 ? 1e-8 : 1e-12, 1, 1, 1e6, 5, 0);
    double *f = (double *)malloc((size_t)n * sizeof *f);
    int k;
    for (k = 0; k < most && a && f; k++) {
        H(x, f);
        aa_safeguard(f, x, a);
        aa_apply(f, x, a);
        memcpy(x, f, (size_t)n * sizeof *x);
    }
    aa_finish(a), free(f);
    return 0;
}
#endif
