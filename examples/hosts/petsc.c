/* SPDX-License-Identifier: MIT

   petsc.c - heat through two bundles of rods: PETSc's TS on one, a hand-written solver on the other

       u_t = 2 u_xx   -1 < x < 0   5 rods, ESDIRK, 40 steps in a window; reads g(t) and g'(t), the
                                   contact temperatures, writes q(t), the heat fluxes, also that at
                                   the window start, for it holds the new g'
       2 u_t = u_xx    0 < x < 1   8 rods, TS, ARKIMEX with adaptive steps; reads q, writes g at
                                   eight fixed times (TSInterpolate), quasi-Newton iterates on them

   A linear mapping takes the fields from rods to rods; u = 0 at both outer ends.  Exact on grids of
   width h left, h/2 right, so that the error is that in time: exp(-m t) (1 + y)/2 at height y,
   times sin(pi (x+1)/3) left, sin(2 pi (1-x)/3) right, m = 8/h^2 sin^2(pi h/6).  Half a cell of
   heat lies on either side of the contact; the left one is in q = -(2 (g - u_last)/h + h/2 g').
   To repeat a window: the left state; of TS state, time, step size and number; TSRestartStep. */
#include <petscts.h>
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "host.h"
#include "iqn.h"
#include "rk.h"

enum { N1 = 5, N2 = 8, LEFT = 19, RIGHT = 40, WINDOWS = 4, SAMPLES = 8, STEPS = 40 };
static const double pi = 3.14159265358979323846, width = 1. / (LEFT + 1), fine = 1. / RIGHT;
#define PUT INSERT_VALUES
#define HEIGHT(rod, rods) ((1 + (double)(rod) / ((rods) - 1)) / 2)
#define LEFT_EXACT(i) (HEIGHT((i) / LEFT, N1) * sin(pi * ((i) % LEFT + 1) * width / 3))
#define RIGHT_EXACT(rod, y) (HEIGHT(rod, N2) * sin(2 * pi * (y) / 3)) /* y: 1 - x */

/* ---- left: k = f(t, z + h a k), f(t, u)_i = 2/width^2 (u_{i-1} - 2 u_i + u_{i+1}), u_LEFT = g */

extern void dgtsv_(const int *n, const int *nrhs, double *below, double *diagonal, double *above,
                   double *b, const int *ldb, int *info);

static void left_stage(double ha, const double *g, const double *z, double *k)
{
    const double d = 2 / (width * width);
    const int n = LEFT, rods = N1, last = LEFT - 1;
    double below[LEFT], diagonal[LEFT], above[LEFT];
    int i, info;
    for (i = 0; i < LEFT * N1; i++)
        k[i] = d * ((i % n > 0 ? z[i - 1] : 0) - 2 * z[i] + (i % n < last ? z[i + 1] : g[i / n]));
    for (i = 0; i < LEFT; i++) below[i] = above[i] = -ha * d;
    for (i = 0; i < LEFT; i++) diagonal[i] = 1 + 2 * ha * d;
    dgtsv_(&n, &rods, below, diagonal, above, k, &n, &info);
    check(info == 0, "dgtsv");
}

static void left_write(const waveform *g, waveform *q, double t, const double *u)
{
    double value[N1], slope[N1], *sample = waveform_push(q, t, 0);
    int i;
    read_mapped(g, t, 0, N2, N1, value);
    read_mapped(g, t, 1, N2, N1, slope);
    for (i = 0; i < N1; i++)
        sample[i] = -(2 * (value[i] - u[i * LEFT + LEFT - 1]) / width + width / 2 * slope[i]);
}

static void left_window(double t0, double t1, double *u, const waveform *g, waveform *q)
{
    const rk_table *T = rk_find("esdirk3");
    double k[8 * LEFT * N1], z[LEFT * N1], value[N1];
    const double h = (t1 - t0) / STEPS;
    int i, j, n = LEFT * N1;
    left_write(g, q, t0, u); /* its g' is that of this window: the sample is written again */
    for (j = 0; j < STEPS; j++) {
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, n, u, k, n, z);
            read_mapped(g, t0 + (j + T->c[i]) * h, 0, N2, N1, value);
            left_stage(h * T->A[i * (T->stages + T->extra) + i], value, z, k + i * n);
        }
        rk_finish(T, h, n, u, k, n, u, NULL);
        left_write(g, q, j == STEPS - 1 ? t1 : t0 + (j + 1) * h, u);
    }
}

/* ---- right: 2 u_i' = (u_{i-1} - 2 u_i + u_{i+1})/fine^2; u_0' = ((u_1 - u_0)/fine + q)/fine */
static const PetscInt contact[N2] = {0, 40, 80, 120, 160, 200, 240, 280}; /* multiples of RIGHT */
static const char options[] = "-ts_type arkimex -ts_arkimex_fully_implicit -ts_rtol 1e-8 "
                              "-ts_atol 1e-8 -ts_exact_final_time matchstep -snes_type ksponly "
                              "-ksp_type preonly -pc_type lu";

typedef struct right_side {
    Mat A;
    TS ts;
    Vec u, start, dense;
    waveform *q;
} right_side;

static PetscErrorCode right_slope(TS ts, PetscReal t, Vec u, Vec slope, void *side) /* A u + flux */
{
    const right_side *r = (const right_side *)side;
    double flux[N2];
    int rod;
    (void)ts;
    read_mapped(r->q, t, 0, N1, N2, flux);
    for (rod = 0; rod < N2; rod++) flux[rod] /= fine;
    PetscCall(MatMult(r->A, u, slope));
    PetscCall(VecSetValues(slope, N2, contact, flux, ADD_VALUES));
    PetscCall(VecAssemblyBegin(slope));
    PetscCall(VecAssemblyEnd(slope));
    return 0;
}

static PetscErrorCode right_make(right_side *r, waveform *q)
{
    const double d = 1 / (2 * fine * fine);
    PetscInt i;
    r->q = q;
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, N2 * RIGHT, &r->u));
    PetscCall(VecDuplicate(r->u, &r->start));
    PetscCall(VecDuplicate(r->u, &r->dense));
    PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, N2 * RIGHT, N2 * RIGHT, 3, NULL, &r->A));
    for (i = 0; i < N2 * RIGHT; i++) {
        PetscCall(MatSetValue(r->A, i, i, -2 * d, PUT));
        if (i % RIGHT > 0) PetscCall(MatSetValue(r->A, i, i - 1, d, PUT));
        if ((i + 1) % RIGHT) PetscCall(MatSetValue(r->A, i, i + 1, i % RIGHT ? d : 2 * d, PUT));
        PetscCall(VecSetValue(r->u, i, RIGHT_EXACT(i / RIGHT, 1 - i % RIGHT * fine), PUT));
    }
    PetscCall(MatAssemblyBegin(r->A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(r->A, MAT_FINAL_ASSEMBLY));
    PetscCall(TSCreate(PETSC_COMM_SELF, &r->ts));
    PetscCall(TSSetRHSFunction(r->ts, NULL, right_slope, r));
    PetscCall(TSSetRHSJacobian(r->ts, r->A, r->A, TSComputeRHSJacobianConstant, NULL));
    PetscCall(PetscOptionsInsertString(NULL, options));
    PetscCall(TSSetSolution(r->ts, r->u));
    PetscCall(TSSetFromOptions(r->ts));
    return 0;
}

/* The window from the state r->start: column j-1 of hx = the contact temperatures at s[j]. */
static PetscErrorCode right_window(right_side *r, const double *s, double dt, double *hx)
{
    PetscReal now;
    int j = 1;
    PetscCall(VecCopy(r->start, r->u));
    PetscCall(TSSetTime(r->ts, s[0]));
    PetscCall(TSSetMaxTime(r->ts, s[SAMPLES]));
    PetscCall(TSSetTimeStep(r->ts, dt));
    PetscCall(TSSetStepNumber(r->ts, 0));
    PetscCall(TSRestartStep(r->ts));
    while (j <= SAMPLES) {
        PetscCall(TSStep(r->ts));
        PetscCall(TSGetTime(r->ts, &now));
        for (; j <= SAMPLES && s[j] <= now + 1e-12 * (s[SAMPLES] - s[0]); j++) {
            PetscCall(TSInterpolate(r->ts, PetscMin(s[j], now), r->dense));
            PetscCall(VecGetValues(r->dense, N2, contact, hx + (j - 1) * N2));
        }
    }
    return 0;
}

int main(int argc, char **argv)
{
    const double m = 8 / (width * width) * pow(sin(pi * width / 6), 2), tol = 2e-7;
    double u1[LEFT * N1], start1[LEFT * N1], s[SAMPLES + 1], hx[SAMPLES * N2], *sample;
    waveform g = waveform_make(5, N2, SAMPLES + 1), q = waveform_make(3, N1, STEPS + 1);
    const size_t bytes = iqn_size(SAMPLES * N2, 20, 1);
    void *room = scene_memory(bytes);
    iqn *accelerate;
    right_side right;
    PetscReal dt = 1e-3, error = 0, left = 0;
    int n, i, status;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(right_make(&right, &q));
    for (i = 0; i < LEFT * N1; i++) u1[i] = LEFT_EXACT(i);
    for (sample = waveform_push(&g, 0, 0), i = 0; i < N2; i++) sample[i] = RIGHT_EXACT(i, 1);
    check(iqn_make(&accelerate, SAMPLES * N2, 20, 1, room, bytes) == IQN_OK, "iqn_make");
    iqn_set(accelerate, IQN_OMEGA, 0.5);
    iqn_set(accelerate, IQN_TOL_RELATIVE, 1e-8);
    for (n = 0; n < WINDOWS; n++) {
        const double t0 = (double)n / WINDOWS, t1 = (double)(n + 1) / WINDOWS;
        memcpy(start1, u1, sizeof u1);
        PetscCall(VecCopy(right.u, right.start));
        if (n > 0) PetscCall(TSGetTimeStep(right.ts, &dt)); /* part of the state */
        lobatto(t0, t1, SAMPLES + 1, s);
        begin(&g, SAMPLES, s + 1);
        do {
            waveform_fit(&g);
            if (n > 0) wf_rollback(q.w);
            memcpy(u1, start1, sizeof u1);
            left_window(t0, t1, u1, &g, &q);
            waveform_fit(&q);
            PetscCall(right_window(&right, s, PetscMin(dt, t1 - t0), hx));
            status = iqn_step(accelerate, waveform_window(&g), hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(accelerate));
        check(iqn_converged(accelerate) == 1, "no convergence");
        iqn_commit(accelerate);
        for (i = 0; i < SAMPLES * N2; i++)
            error = fmax(error, fabs(hx[i] - RIGHT_EXACT(i % N2, 1) * exp(-m * s[i / N2 + 1])));
        wf_advance(g.w, 0);
        wf_advance(q.w, 0);
    }
    for (i = 0; i < LEFT * N1; i++) left = fmax(left, fabs(u1[i] - exp(-m) * LEFT_EXACT(i)));
    printf("error_contact %.2e\nerror_left %.2e\nerror_allowed %.0e\n", error, left, tol);
    printf("iterations_average %.1f\n", iqn_get(accelerate, IQN_NSTEPS) / WINDOWS);
    PetscCall(PetscFinalize());
    return error <= tol && left <= tol ? 0 : 1;
}
