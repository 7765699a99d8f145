/* SPDX-License-Identifier: MIT

   sundials_gsl.c - GSL's odeiv2 and SUNDIALS' CVODE, coupled by a field

   Two rows of masses along an interface, 5 nodes on one side, 8 on the other; each mass feels the
   other side's field at its place, by a linear mapping:

       u1'' + 20 pi^2 u1 = 16 pi^2 P u2(t)    GSL, Cash-Karp: no dense output; each accepted step
                                              is written with its time derivative (Hermite data);
                                              the steps differ in every iteration
       u2'' + 20 pi^2 u2 = 16 pi^2 Q u1(t)    CVODE, Adams: CVodeGetDky, its dense output, at nine
                                              fixed times in the window; quasi-Newton iterates on
                                              these samples

   Exact: u1,2 = (1 + y)/4 (cos 2 pi t +- cos 6 pi t) at height y.  Both tolerances are 1e-10; the
   answer is to keep 1e-8.

   To repeat a window: GSL gets state and step size back, and is reset; CVODE its state (ReInit). */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "host.h"
#include "iqn.h"

#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#define PI  3.14159265358979323846
#define K12 (16 * PI * PI)
#define K   (20 * PI * PI)

enum {
    N1 = 5,
    N2 = 8,
    WINDOWS = 10,
    SAMPLES = 9,
    MOST = 2000
}; /* nodes; samples of a window, after its start; columns
                                                                    that GSL may need */

/* y = (u, u') of n masses, forced by the other side's waveform at whatever time is asked for */
static void masses(int n, double t, const double *y, double *f, const waveform *other)
{
    double here[N2];
    int i;
    read_mapped(other, t, 0, n == N1 ? N2 : N1, n, here);
    memcpy(f, y + n, (size_t)n * sizeof *f);
    for (i = 0; i < n; i++) f[n + i] = K12 * here[i] - K * y[i];
}

static int gsl_right_hand_side(double t, const double *y, double *f, void *other)
{
    masses(N1, t, y, f, (const waveform *)other);
    return GSL_SUCCESS;
}

static int cvode_right_hand_side(sunrealtype t, N_Vector y, N_Vector f, void *other)
{
    masses(N2, t, N_VGetArrayPointer(y), N_VGetArrayPointer(f), (const waveform *)other);
    return 0;
}

static double off(int n, double t, double sign, const double *u) /* largest error of the field */
{
    const double swing = cos(2 * PI * t) + sign * cos(6 * PI * t);
    double worst = 0;
    int i;
    for (i = 0; i < n; i++)
        worst = fmax(worst, fabs(u[i] - (1 + (double)i / (n - 1)) / 4 * swing));
    return worst;
}

/* ---- GSL: a window from t0 to t1, every accepted step written ---- */

typedef struct gsl_side {
    gsl_odeiv2_system system;
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
    gsl_odeiv2_evolve *evolve;
    double y[2 * N1], h;
    int steps;
} gsl_side;

static double gsl_window(gsl_side *g, double t0, double t1, waveform *out)
{
    double t = t0, worst = 0;
    gsl_odeiv2_step_reset(g->step);
    gsl_odeiv2_evolve_reset(g->evolve);
    for (; t < t1; g->steps++) {
        const int failed = gsl_odeiv2_evolve_apply(g->evolve, g->control, g->step, &g->system, &t,
                                                   t1, &g->h, g->y);
        check(failed == GSL_SUCCESS, "GSL");
        memcpy(waveform_push(out, t, WF_SLOPE), g->y, sizeof g->y); /* field, derivative */
        worst = fmax(worst, off(N1, t, 1, g->y));
    }
    return worst;
}

/* ---- CVODE: a window through the times s, the dense output written ---- */

static double cvode_window(void *cvode, const double *s, N_Vector y, N_Vector dense, double *hx)
{
    double t = s[0], worst = 0;
    int j;
    CVodeReInit(cvode, t, y);            /* forgets the multistep history */
    CVodeSetStopTime(cvode, s[SAMPLES]); /* stays inside the window */
    for (j = 1; j <= SAMPLES; j++) {
        while (t < s[j]) check(CVode(cvode, s[SAMPLES], y, &t, CV_ONE_STEP) >= 0, "CVode");
        check(CVodeGetDky(cvode, s[j], 0, dense) == CV_SUCCESS, "CVodeGetDky");
        memcpy(hx + (j - 1) * N2, N_VGetArrayPointer(dense), N2 * sizeof *hx);
        worst = fmax(worst, off(N2, s[j], -1, N_VGetArrayPointer(dense)));
    }
    return worst;
}

int main(void)
{
    waveform w1 = waveform_make(5, N1, MOST);
    waveform w2 = waveform_make(7, N2, SAMPLES + 1); /* what GSL reads for u2 */
    gsl_side gsl, gsl_start;
    double start2[2 * N2] = {0}, s[SAMPLES + 1], hx[SAMPLES * N2], error = 0, worst;
    SUNContext context;
    N_Vector y2, dense;
    SUNNonlinearSolver fixed_point;
    void *cvode;
    iqn *q;
    const size_t bytes = iqn_size(SAMPLES * N2, 20, 1);
    int n, i, status, total = 0;

    memset(&gsl, 0, sizeof gsl);
    gsl.system.function = gsl_right_hand_side;
    gsl.system.dimension = 2 * N1;
    gsl.system.params = &w2;
    gsl.step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkck, 2 * N1);
    gsl.control = gsl_odeiv2_control_y_new(1e-10, 1e-10);
    gsl.evolve = gsl_odeiv2_evolve_alloc(2 * N1);
    gsl.h = 1e-3;
    for (i = 0; i < N1; i++) gsl.y[i] = (1 + (double)i / (N1 - 1)) / 2;

    SUNContext_Create(0, &context);
    y2 = N_VNew_Serial(2 * N2, context);
    dense = N_VNew_Serial(2 * N2, context);
    N_VConst(0, y2);
    cvode = CVodeCreate(CV_ADAMS, context);
    check(CVodeInit(cvode, cvode_right_hand_side, 0, y2) == CV_SUCCESS, "CVodeInit");
    CVodeSStolerances(cvode, 1e-10, 1e-10);
    CVodeSetMaxNumSteps(cvode, 100000);
    CVodeSetUserData(cvode, &w1);
    fixed_point = SUNNonlinSol_FixedPoint(y2, 0, context);
    CVodeSetNonlinearSolver(cvode, fixed_point);

    check(iqn_make(&q, SAMPLES * N2, 20, 1, scene_memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-10);

    memcpy(waveform_push(&w1, 0, WF_SLOPE), gsl.y, sizeof gsl.y);
    memcpy(waveform_push(&w2, 0, 0), start2, N2 * sizeof *start2);
    for (n = 0; n < WINDOWS; n++) {
        const double t0 = (double)n / WINDOWS, t1 = (double)(n + 1) / WINDOWS;
        lobatto(t0, t1, SAMPLES + 1, s);
        begin(&w2, SAMPLES, s + 1);
        gsl_start = gsl;
        do {
            waveform_fit(&w2);
            wf_rollback(w1.w);
            gsl = gsl_start;
            worst = gsl_window(&gsl, t0, t1, &w1);
            waveform_fit(&w1);
            memcpy(N_VGetArrayPointer(y2), start2, sizeof start2);
            worst = fmax(worst, cvode_window(cvode, s, y2, dense, hx));
            status = iqn_step(q, waveform_window(&w2), hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(q));
        check(iqn_converged(q) == 1, "no convergence");
        total += (int)iqn_get(q, IQN_ITERATIONS);
        iqn_commit(q);
        error = fmax(error, worst);
        memcpy(start2, N_VGetArrayPointer(y2), sizeof start2);
        wf_advance(w1.w, 0);
        wf_advance(w2.w, 0);
    }
    printf("u1_at_1 %.12f\nexact 1\nerror_max %.2e\nerror_allowed 1e-08\n", gsl.y[N1 - 1], error);
    printf("iterations_average %.1f\nsteps_gsl %d\n", (double)total / WINDOWS, gsl.steps);

    gsl_odeiv2_evolve_free(gsl.evolve);
    gsl_odeiv2_control_free(gsl.control);
    gsl_odeiv2_step_free(gsl.step);
    CVodeFree(&cvode);
    SUNNonlinSolFree(fixed_point);
    N_VDestroy(y2);
    N_VDestroy(dense);
    SUNContext_Free(&context);
    return error <= 1e-8 ? 0 : 1;
}
