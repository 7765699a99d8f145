/* SPDX-License-Identifier: MIT

   petsc.c - heat through two rods in contact: PETSc's TS on one, a hand-written ESDIRK solver on the other

       u_t = 2 u_xx   -1 < x < 0   hand-written; reads the contact temperature g(t) and g'(t), writes the heat flux q(t)
       2 u_t = u_xx    0 < x < 1   TS, ARKIMEX with adaptive steps; reads q, writes g: its dense output, TSInterpolate,
                                   at eight fixed times in the window, which quasi-Newton iterates on

   u = 0 at both outer ends.  The exact solution exp(-m t) times sin(pi (x+1)/3) left, sin(2 pi (1-x)/3) right, stays
   exact on finite-difference grids where the right one is twice as fine, with m = 8/h^2 sin^2(pi h/6), h the left width:
   what is compared at the end is the error in time alone.

   Half a cell of heat lies on either side of the contact; the left one is in q = -(2 (g - u_last)/h + h/2 g'). */
#include <petscts.h>

#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEFT = 19, RIGHT = 40, WINDOWS = 4, SAMPLES = 8, STEPS = 40 }; /* unknowns; the contact belongs to the right */

static const double pi = 3.14159265358979323846, width = 1. / (LEFT + 1), fine = 1. / RIGHT;

typedef struct waveform {
    wf *grid;
    double *x, *c;
} waveform;

static void check(int ok, const char *what)
{
    if (ok) return;
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void *memory(size_t bytes)
{
    void *p = malloc(bytes);
    check(bytes > 0 && p != NULL, "no memory");
    return p;
}

static waveform waveform_make(int degree, int columns, double start)
{
    waveform w;
    const size_t bytes = wf_size(degree, columns);
    check(wf_make(&w.grid, degree, columns, memory(bytes), bytes) == WF_OK, "wf_make");
    w.x = (double *)memory((size_t)columns * sizeof(double));
    w.c = (double *)memory((size_t)columns * sizeof(double));
    w.x[wf_push(w.grid, 0)] = start;
    return w;
}

static void fit(waveform *w)
{
    check(wf_fit(w->grid, 1, w->x, 1, w->c, 1) >= 0, "wf_fit");
}

static double value(const waveform *w, double t, int derivative)
{
    double v = 0;
    check(wf_eval(w->grid, t, derivative, 1, w->c, 1, &v) >= 0, "wf_eval");
    return v;
}

/* ---- left: k = f(t, z + h a k) for f(t, u)_i = 2/width^2 (u_{i-1} - 2 u_i + u_{i+1}), u_LEFT = g ---- */

static void left_stage(double ha, double g, const double *z, double *k)
{
    const double d = 2 / (width * width), off = -ha * d;
    double pivot[LEFT];
    int i;
    for (i = 0; i < LEFT; i++) k[i] = d * ((i > 0 ? z[i - 1] : 0) - 2 * z[i] + (i < LEFT - 1 ? z[i + 1] : g));
    for (pivot[0] = 1 - 2 * off, i = 1; i < LEFT; i++) {
        pivot[i] = 1 - 2 * off - off * off / pivot[i - 1];
        k[i] -= off / pivot[i - 1] * k[i - 1];
    }
    for (k[LEFT - 1] /= pivot[LEFT - 1], i = LEFT - 2; i >= 0; i--) k[i] = (k[i] - off * k[i + 1]) / pivot[i];
}

static void left_write(const waveform *g, waveform *q, double t, const double *u)
{
    const int j = wf_push(q->grid, t);
    check(j >= 0, wf_message(j));
    q->x[j] = -(2 * (value(g, t, 0) - u[LEFT - 1]) / width + width / 2 * value(g, t, 1));
}

static void left_solve(const rk_table *T, double t0, double t1, double *u, const waveform *g, waveform *q)
{
    double k[8 * LEFT], z[LEFT];
    const double h = (t1 - t0) / STEPS;
    int i, n;
    left_write(g, q, t0, u); /* g' at the window start belongs to this window: the sample there is written again */
    for (n = 0; n < STEPS; n++) {
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, LEFT, u, k, LEFT, z);
            left_stage(h * T->A[i * (T->stages + T->extra) + i], value(g, t0 + (n + T->c[i]) * h, 0), z, k + i * LEFT);
        }
        rk_finish(T, h, LEFT, u, k, LEFT, u, NULL);
        left_write(g, q, n == STEPS - 1 ? t1 : t0 + (n + 1) * h, u);
    }
}

/* ---- right: 2 u_i' = (u_{i-1} - 2 u_i + u_{i+1})/fine^2, at the contact u_0' = ((u_1 - u_0)/fine + q)/fine ---- */

static PetscErrorCode right_function(TS ts, PetscReal t, Vec U, Vec Udot, Vec F, void *q)
{
    const PetscScalar *u, *dot;
    const double d = 1 / (2 * fine * fine);
    PetscScalar *f;
    PetscInt i;
    PetscFunctionBeginUser;
    (void)ts;
    PetscCall(VecGetArrayRead(U, &u));
    PetscCall(VecGetArrayRead(Udot, &dot));
    PetscCall(VecGetArray(F, &f));
    f[0] = dot[0] - (u[1] - u[0]) * 2 * d - value((const waveform *)q, t, 0) / fine;
    for (i = 1; i < RIGHT; i++) f[i] = dot[i] - d * (u[i - 1] - 2 * u[i] + (i < RIGHT - 1 ? u[i + 1] : 0));
    PetscCall(VecRestoreArrayRead(U, &u));
    PetscCall(VecRestoreArrayRead(Udot, &dot));
    PetscCall(VecRestoreArray(F, &f));
    PetscFunctionReturn(0);
}

static PetscErrorCode right_jacobian(TS ts, PetscReal t, Vec U, Vec Udot, PetscReal shift, Mat J, Mat P, void *q)
{
    const double d = 1 / (2 * fine * fine);
    PetscInt i;
    PetscFunctionBeginUser;
    (void)ts, (void)t, (void)U, (void)Udot, (void)J, (void)q;
    for (i = 0; i < RIGHT; i++) {
        PetscCall(MatSetValue(P, i, i, shift + 2 * d, INSERT_VALUES));
        if (i > 0) PetscCall(MatSetValue(P, i, i - 1, -d, INSERT_VALUES));
        if (i < RIGHT - 1) PetscCall(MatSetValue(P, i, i + 1, i ? -d : -2 * d, INSERT_VALUES));
    }
    PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
    PetscFunctionReturn(0);
}

static PetscErrorCode right_make(TS *ts, Vec *u, waveform *q)
{
    Mat J;
    SNES snes;
    KSP ksp;
    PC pc;
    PetscFunctionBeginUser;
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, RIGHT, u));
    PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, RIGHT, RIGHT, 3, NULL, &J));
    PetscCall(TSCreate(PETSC_COMM_SELF, ts));
    PetscCall(TSSetType(*ts, TSARKIMEX));
    PetscCall(TSARKIMEXSetFullyImplicit(*ts, PETSC_TRUE));
    PetscCall(TSSetIFunction(*ts, NULL, right_function, q));
    PetscCall(TSSetIJacobian(*ts, J, J, right_jacobian, q));
    PetscCall(TSSetTolerances(*ts, 1e-8, NULL, 1e-8, NULL));
    PetscCall(TSSetExactFinalTime(*ts, TS_EXACTFINALTIME_MATCHSTEP));
    PetscCall(TSGetSNES(*ts, &snes)); /* linear: one direct solve per stage */
    PetscCall(SNESSetType(snes, SNESKSPONLY));
    PetscCall(SNESGetKSP(snes, &ksp));
    PetscCall(KSPSetType(ksp, KSPPREONLY));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCLU));
    PetscCall(TSSetSolution(*ts, *u));
    PetscCall(TSSetFromOptions(*ts));
    PetscCall(MatDestroy(&J));
    PetscFunctionReturn(0);
}

/* The window from the state `start`: hx[j-1] = the contact temperature at s[j], j = 1 .. SAMPLES, s[0] the window start.
   To go back in time: state, time, step size, step number, and TSRestartStep, which forgets what earlier steps left. */
static PetscErrorCode right_solve(TS ts, const double *s, double dt, Vec start, Vec u, Vec dense, double *hx)
{
    const PetscScalar *a;
    PetscReal now;
    int j = 1;
    PetscFunctionBeginUser;
    PetscCall(VecCopy(start, u));
    PetscCall(TSSetTime(ts, s[0]));
    PetscCall(TSSetMaxTime(ts, s[SAMPLES]));
    PetscCall(TSSetTimeStep(ts, dt));
    PetscCall(TSSetStepNumber(ts, 0));
    PetscCall(TSRestartStep(ts));
    while (j <= SAMPLES) {
        PetscCall(TSStep(ts));
        PetscCall(TSGetTime(ts, &now));
        for (; j <= SAMPLES && s[j] <= now + 1e-12 * (s[SAMPLES] - s[0]); j++) {
            PetscCall(TSInterpolate(ts, PetscMin(s[j], now), dense));
            PetscCall(VecGetArrayRead(dense, &a));
            hx[j - 1] = a[0];
            PetscCall(VecRestoreArrayRead(dense, &a));
        }
    }
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    const rk_table *T = rk_find("esdirk3");
    const double m = 8 / (width * width) * pow(sin(pi * width / 6), 2), tol = 2e-7;
    double u1[LEFT], start1[LEFT], s[SAMPLES + 1], hx[SAMPLES], error = 0, left = 0;
    waveform g = waveform_make(5, SAMPLES + 1, sin(pi / 3)), q = waveform_make(3, STEPS + 1, 0);
    const size_t bytes = iqn_size(SAMPLES, 20, 1);
    iqn *accelerate;
    TS ts;
    Vec u2, start2, dense;
    PetscReal dt = 1e-3;
    PetscInt i;
    int n, j, status, total = 0;

    PetscFunctionBeginUser;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(right_make(&ts, &u2, &q));
    PetscCall(VecDuplicate(u2, &start2));
    PetscCall(VecDuplicate(u2, &dense));
    for (j = 0; j < LEFT; j++) u1[j] = sin(pi * (j + 1) * width / 3);
    for (i = 0; i < RIGHT; i++) PetscCall(VecSetValue(u2, i, sin(2 * pi * (1 - i * fine) / 3), INSERT_VALUES));
    PetscCall(VecAssemblyBegin(u2));
    PetscCall(VecAssemblyEnd(u2));
    check(iqn_make(&accelerate, SAMPLES, 20, 1, memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(accelerate, IQN_OMEGA, 0.5);
    iqn_set(accelerate, IQN_TOL_RELATIVE, 1e-8);

    for (n = 0; n < WINDOWS; n++) {
        const double t0 = (double)n / WINDOWS, t1 = (double)(n + 1) / WINDOWS;
        double *x = g.x + wf_start(g.grid) + 1;
        memcpy(start1, u1, sizeof u1);
        PetscCall(VecCopy(u2, start2));
        if (n > 0) PetscCall(TSGetTimeStep(ts, &dt)); /* for all iterations of the window, like the rest of the state */
        wf_lobatto(t0, t1, SAMPLES + 1, s);
        for (j = 1; j <= SAMPLES; j++) { /* first guess: constant */
            check(wf_push(g.grid, s[j]) >= 0, "wf_push");
            x[j - 1] = x[-1];
        }
        do {
            fit(&g);
            wf_rollback(q.grid);
            memcpy(u1, start1, sizeof u1);
            left_solve(T, t0, t1, u1, &g, &q);
            fit(&q);
            PetscCall(right_solve(ts, s, PetscMin(dt, t1 - t0), start2, u2, dense, hx));
            status = iqn_step(accelerate, x, hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(accelerate));
        check(iqn_converged(accelerate) == 1, "no convergence");
        total += (int)iqn_get(accelerate, IQN_ITERATIONS);
        iqn_commit(accelerate);
        for (j = 0; j < SAMPLES; j++) error = fmax(error, fabs(hx[j] - exp(-m * s[j + 1]) * sin(pi / 3)));
        wf_advance(g.grid, 0, 1, g.x, 1);
        wf_advance(q.grid, 0, 1, q.x, 1);
    }
    for (j = 0; j < LEFT; j++) left = fmax(left, fabs(u1[j] - exp(-m) * sin(pi * (j + 1) * width / 3)));
    printf("contact_at_1 %.10f\nexact %.10f\n", hx[SAMPLES - 1], exp(-m) * sin(pi / 3));
    printf("error_contact %.2e\nerror_left %.2e\nerror_allowed %.0e\n", error, left, tol);
    printf("iterations_average %.1f\n", (double)total / WINDOWS);
    PetscCall(VecDestroy(&u2));
    PetscCall(VecDestroy(&start2));
    PetscCall(VecDestroy(&dense));
    PetscCall(TSDestroy(&ts));
    PetscCall(PetscFinalize());
    return error <= tol && left <= tol ? 0 : 1;
}
