/* SPDX-License-Identifier: MIT

   sundials_gsl.c - two integrators that know nothing of each other, GSL's odeiv2 and SUNDIALS' CVODE, coupled

       u1'' + 20 pi^2 u1 = 16 pi^2 u2(t)    GSL, Cash-Karp: has no dense output, so each accepted step is written with
                                            its time derivative (Hermite data); the steps differ in every iteration
       u2'' + 20 pi^2 u2 = 16 pi^2 u1(t)    CVODE, Adams: its dense output, CVodeGetDky, is sampled at nine fixed times
                                            in the window, and these samples are what quasi-Newton iterates on

   Exact: u1,2 = (cos 2 pi t +- cos 6 pi t)/2.  Both tolerances are 1e-10; the coupled answer is to keep 1e-8. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"

#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#define PI  3.14159265358979323846
#define K12 (16 * PI * PI)
#define K   (20 * PI * PI)

enum { WINDOWS = 10, SAMPLES = 9, MOST = 2000 }; /* samples of a window, behind its start; columns that GSL may need */

/* A side reads one waveform and writes another; a grid's samples stay in the host's array. */
typedef struct waveform {
    wf *grid;
    double *x, *c;
} waveform;

static void check(int ok, const char *what)
{
    if (ok) return;
    fprintf(stderr, "failed: %s\n", what);
    exit(1);
}

static void *memory(size_t bytes)
{
    void *p = malloc(bytes);
    check(bytes > 0 && p != NULL, "memory");
    return p;
}

static waveform waveform_make(int degree, int columns)
{
    waveform w;
    const size_t bytes = wf_size(degree, columns);
    check(wf_make(&w.grid, degree, columns, memory(bytes), bytes) == WF_OK, "wf_make");
    w.x = (double *)memory((size_t)columns * sizeof(double));
    w.c = (double *)memory((size_t)columns * sizeof(double));
    return w;
}

static void fit(waveform *w)
{
    check(wf_fit(w->grid, 1, w->x, 1, w->c, 1) >= 0, "wf_fit");
}

/* y = (u, u'), forced by the other side's waveform at whatever time the integrator asks for */
static void oscillator(double t, const double *y, double *f, const waveform *other)
{
    double u = 0;
    check(wf_eval(other->grid, t, 0, 1, other->c, 1, &u) >= 0, "wf_eval");
    f[0] = y[1];
    f[1] = K12 * u - K * y[0];
}

static int gsl_right_hand_side(double t, const double *y, double *f, void *other)
{
    oscillator(t, y, f, (const waveform *)other);
    return GSL_SUCCESS;
}

static int cvode_right_hand_side(sunrealtype t, N_Vector y, N_Vector f, void *other)
{
    oscillator(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f), (const waveform *)other);
    return 0;
}

static double off(double t, double sign, double u)
{
    return fabs(u - 0.5 * (cos(2 * PI * t) + sign * cos(6 * PI * t)));
}

int main(void)
{
    waveform w1 = waveform_make(5, MOST), w2 = waveform_make(7, SAMPLES + 1); /* w2.x: what GSL reads in place of u2 */
    gsl_odeiv2_system system = {gsl_right_hand_side, NULL, 2, NULL};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkck, 2);
    gsl_odeiv2_control *control = gsl_odeiv2_control_y_new(1e-10, 1e-10);
    gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(2);
    double y1[2], start1[2] = {1, 0}, start2[2] = {0, 0}, h1, start_h1 = 1e-3, s[SAMPLES + 1], hx[SAMPLES], error = 0,
                  worst, t;
    SUNContext context;
    N_Vector y2, dense;
    SUNNonlinearSolver fixed_point;
    void *cvode;
    iqn *q;
    const size_t bytes = iqn_size(SAMPLES, 20, 1);
    int n, j, status, total = 0, steps = 0;

    SUNContext_Create(0, &context);
    y2 = N_VNew_Serial(2, context);
    dense = N_VNew_Serial(2, context);
    N_VConst(0, y2);
    cvode = CVodeCreate(CV_ADAMS, context);
    check(CVodeInit(cvode, cvode_right_hand_side, 0, y2) == CV_SUCCESS, "CVodeInit");
    CVodeSStolerances(cvode, 1e-10, 1e-10);
    CVodeSetMaxNumSteps(cvode, 100000);
    CVodeSetUserData(cvode, &w1);
    fixed_point = SUNNonlinSol_FixedPoint(y2, 0, context);
    CVodeSetNonlinearSolver(cvode, fixed_point);
    system.params = &w2;

    check(iqn_make(&q, SAMPLES, 20, 1, memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-10);

    j = wf_push_hermite(w1.grid, 0);
    w1.x[j] = start1[0];
    w1.x[j + 1] = start1[1];
    w2.x[wf_push(w2.grid, 0)] = start2[0];
    for (n = 0; n < WINDOWS; n++) {
        const double t0 = (double)n / WINDOWS, t1 = (double)(n + 1) / WINDOWS;
        wf_lobatto(t0, t1, SAMPLES + 1, s);
        for (j = 1; j <= SAMPLES; j++) w2.x[wf_push(w2.grid, s[j])] = start2[0]; /* first guess: constant */
        do {
            worst = 0;
            fit(&w2);

            /* GSL, from the window start: state, step size and what its objects remember */
            wf_rollback(w1.grid);
            gsl_odeiv2_step_reset(step);
            gsl_odeiv2_evolve_reset(evolve);
            y1[0] = start1[0];
            y1[1] = start1[1];
            h1 = start_h1;
            for (t = t0; t < t1; steps++) {
                check(gsl_odeiv2_evolve_apply(evolve, control, step, &system, &t, t1, &h1, y1) == GSL_SUCCESS, "GSL");
                j = wf_push_hermite(w1.grid, t);
                check(j >= 0, wf_message(j));
                w1.x[j] = y1[0];
                w1.x[j + 1] = y1[1];
                worst = fmax(worst, off(t, 1, y1[0]));
            }
            fit(&w1);

            /* CVODE: ReInit forgets its multistep history, the stop time keeps it inside the window */
            N_VGetArrayPointer(y2)[0] = start2[0];
            N_VGetArrayPointer(y2)[1] = start2[1];
            CVodeReInit(cvode, t0, y2);
            CVodeSetStopTime(cvode, t1);
            for (t = t0, j = 1; j <= SAMPLES; j++) {
                while (t < s[j]) check(CVode(cvode, t1, y2, &t, CV_ONE_STEP) >= 0, "CVode");
                check(CVodeGetDky(cvode, s[j], 0, dense) == CV_SUCCESS, "CVodeGetDky");
                hx[j - 1] = N_VGetArrayPointer(dense)[0];
                worst = fmax(worst, off(s[j], -1, hx[j - 1]));
            }
            status = iqn_step(q, w2.x + wf_start(w2.grid) + 1, hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(q));
        check(iqn_converged(q) == 1, "no convergence");
        total += (int)iqn_get(q, IQN_ITERATIONS);
        iqn_commit(q);
        error = fmax(error, worst);
        start1[0] = y1[0];
        start1[1] = y1[1];
        start_h1 = h1;
        start2[0] = N_VGetArrayPointer(y2)[0];
        start2[1] = N_VGetArrayPointer(y2)[1];
        wf_advance(w1.grid, 0, 1, w1.x, 1);
        wf_advance(w2.grid, 0, 1, w2.x, 1);
    }
    printf("u1_at_1 %.12f\nexact 1\nerror_max %.2e\nerror_allowed 1e-08\n", start1[0], error);
    printf("iterations_average %.1f\nsteps_gsl %d\n", (double)total / WINDOWS, steps);

    gsl_odeiv2_evolve_free(evolve);
    gsl_odeiv2_control_free(control);
    gsl_odeiv2_step_free(step);
    CVodeFree(&cvode);
    SUNNonlinSolFree(fixed_point);
    N_VDestroy(y2);
    N_VDestroy(dense);
    SUNContext_Free(&context);
    return error <= 1e-8 ? 0 : 1;
}
