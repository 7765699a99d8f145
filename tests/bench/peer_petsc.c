/* SPDX-License-Identifier: MIT

   peer_petsc.c N M - laps of bench.h: one iteration of PETSc's SNESANDERSON with M vectors on N random numbers         */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#include <petscsnes.h>

#include "bench.h"

#define TEXT_OF(a) #a
#define TEXT(a) TEXT_OF(a)
#define VERSION TEXT(PETSC_VERSION_MAJOR) "." TEXT(PETSC_VERSION_MINOR) "." TEXT(PETSC_VERSION_SUBMINOR)

static PetscErrorCode residual(SNES snes, Vec x, Vec f, void *work)
{
    const PetscScalar *from;
    PetscScalar *to;
    double *h = (double *)work;
    PetscInt n, i;
    static int called;
    (void)snes;
    if (called) bench_end();
    else bench_hello(PetscDefined(USE_DEBUG) ? "PETSc " VERSION " with debugging" : "PETSc " VERSION ", optimised");
    called = 1;
    VecGetLocalSize(f, &n);
    bench_random(n, h);
    bench_begin();
    VecGetArrayRead(x, &from);
    VecGetArray(f, &to);
    for (i = 0; i < n; i++) to[i] = from[i] - h[i];
    VecRestoreArray(f, &to);
    VecRestoreArrayRead(x, &from);
    return 0;
}

int main(int argc, char **argv)
{
    const PetscInt n = argc > 1 ? atoi(argv[1]) : 100, m = argc > 2 ? atoi(argv[2]) : 10;
    char depth[32];
    SNES snes;
    Vec x, f;
    snprintf(depth, sizeof depth, "%d", (int)m);
    argc = 1;
    PetscInitialize(&argc, &argv, NULL, NULL);
    PetscOptionsSetValue(NULL, "-snes_anderson_m", depth);
    VecCreateSeq(PETSC_COMM_SELF, n, &x);
    VecDuplicate(x, &f);
    SNESCreate(PETSC_COMM_SELF, &snes);
    SNESSetType(snes, SNESANDERSON);
    SNESSetFunction(snes, f, residual, bench_memory((size_t)n));
    SNESNGMRESSetRestartType(snes, SNES_NGMRES_RESTART_NONE);
    SNESSetTolerances(snes, 0, 0, 0, 1000000000, 1000000000);
    SNESSetDivergenceTolerance(snes, -1);
    SNESSetFromOptions(snes);
    SNESSolve(snes, NULL, x); /* without end: standard input ends first */
    fprintf(stderr, "PETSc stopped by itself\n");
    return 1;
}
