/* SPDX-License-Identifier: MIT

   ngspice.c - a circuit in libngspice against a mechanical partner: a motor, its voltage chopped

       L i' + R i = V(t) - w(t)   ngspice: the back-voltage w is an EXTERNAL source, driven by a
                                  waveform; the current is written at every accepted time point
       J w' + d w = i(t)          rk.h, Dormand-Prince; dense output at fixed times in the window,
                                  which quasi-Newton iterates on

   R = d = 1, L = J = 1/2, at rest for t = 0.  V is 2 for 0.3, then 0 for 0.2, and again.  The
   switch lies inside a window, i' jumps there, and w''.  It is a break of the waveform that the
   circuit reads: stored twice, and no spline crosses it (else the error is 50 times as large).
   ngspice steps to it on its own, for a PULSE says when it falls.
   Exact: z = i + sqrt(-1) w moves on a spiral to V (1 + sqrt(-1))/2 from switch to switch.

   ngspice cannot go back in time.  A window is repeated as a new transient analysis from 0, with
   the state of the window start, here the current of one inductor, for initial condition; the
   callbacks add t0. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "host.h"
#include "iqn.h"
#include "rk.h"

#include <stdbool.h>
#include <string.h>
#include <ngspice/sharedspice.h>

enum { WINDOWS = 2, PIECE = 6, SAMPLES = 2 * PIECE + 1, STEPS = 5, MOST = 5000 };
static const double on = 0.3, period = 0.5, volt = 2, tol = 1e-6;

/* Samples of the velocity in a window, the first one its start; at the switch before and after */
static const double at[SAMPLES + 1] = {0,   0.05, 0.1,  0.15, 0.2,  0.25, 0.3,
                                       0.3, 0.33, 0.37, 0.4,  0.43, 0.47, 0.5};

/* What the callbacks of ngspice see.  velocity: the circuit reads it; current: it writes it. */
typedef struct link {
    waveform current, velocity;
    double t0, i, error;
    double z0[2]; /* exact current and velocity at the window start */
} link;

static void spiral(double v, double t, double z[2])
{
    const double x = z[0] - v, y = z[1] - v, s = exp(-2 * t), c = cos(2 * t), d = sin(2 * t);
    z[0] = v + s * (c * x - d * y);
    z[1] = v + s * (d * x + c * y);
}

static void exact(const link *l, double t, double z[2])
{
    memcpy(z, l->z0, sizeof l->z0);
    spiral(volt / 2, fmin(t - l->t0, on), z);
    spiral(0, fmax(t - l->t0 - on, 0), z);
}

/* ---- what ngspice calls: its output, its end, an accepted time point, the external source ---- */

static int on_text(char *text, int id, void *user)
{
    (void)id, (void)user;
    if (strstr(text, "rror")) fprintf(stderr, "%s\n", text);
    return 0;
}

static int on_start(vecinfoall *all, int id, void *user) /* without it no time points come */
{
    (void)all, (void)id, (void)user;
    return 0;
}

static int on_exit(int status, NG_BOOL now, NG_BOOL quit, int id, void *user)
{
    (void)now, (void)quit, (void)id, (void)user;
    exit(status ? status : 1);
}

static int on_time_point(vecvaluesall *all, int count, int id, void *user)
{
    link *l = (link *)user;
    double t = 0, i = 0, z[2];
    int j;
    (void)count, (void)id;
    for (j = 0; j < all->veccount; j++) {
        if (strcmp(all->vecsa[j]->name, "time") == 0) t = all->vecsa[j]->creal;
        if (strcmp(all->vecsa[j]->name, "l1#branch") == 0) i = all->vecsa[j]->creal;
    }
    if (t == 0) return 0; /* the window start, already there */
    *waveform_push(&l->current, l->t0 + t, 0) = l->i = i;
    exact(l, l->t0 + t, z);
    l->error = fmax(l->error, fabs(i - z[0]));
    return 0;
}

static int on_external_source(double *voltage, double t, char *name, int id, void *user)
{
    const link *l = (const link *)user;
    (void)name, (void)id;
    waveform_eval(&l->velocity, l->t0 + t, 0, voltage);
    return 0;
}

static void command(const char *format, double value)
{
    char text[100]; /* ngspice takes char * and may write to it */
    snprintf(text, sizeof text, format, value);
    check(!ngSpice_Command(text), format);
}

static void circuit(link *l)
{
    /* EXTERNAL takes no DC value beside it: ngspice 39 crashes on that */
    static char lines[][40] = {"motor", "V1 1 0 PULSE(2 0 0.3 1n 1n 1 2)", "R1 1 2 1",
                               "L1 2 3 0.5 ic=0", "Vback 3 0 external",
                               ".options reltol=1e-6 abstol=1e-12", ".end"};
    char *deck[8] = {NULL};
    int j;
    check(!ngSpice_Init(on_text, NULL, on_exit, on_time_point, on_start, NULL, l), "ngSpice_Init");
    check(!ngSpice_Init_Sync(on_external_source, NULL, NULL, NULL, l), "ngSpice_Init_Sync");
    for (j = 0; j < 7; j++) deck[j] = lines[j];
    check(!ngSpice_Circ(deck), "ngSpice_Circ");
}

/* ---- the mechanical side between two switches: from s[0] on; hx = the velocity at s[1] .. */

static double rotor(double w, const double *s, const link *l, double *hx)
{
    const rk_table *T = rk_find("dp5");
    const double h = (s[PIECE] - s[0]) / STEPS;
    double k[7], z, i_there;
    const rk_step done = {T, h, 1, &w, k, 1};
    int n, i, j = 1;
    for (n = 0; n < STEPS; n++) {
        const double t = s[0] + n * h;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 1, &w, k, 1, &z);
            waveform_eval(&l->current, t + T->c[i] * h, 0, &i_there);
            k[i] = 2 * (i_there - z);
        }
        for (; j <= PIECE && s[j] <= t + h * (1 + 1e-9); j++)
            rk_dense(&done, (s[j] - t) / h, 0, &hx[j - 1]);
        rk_finish(T, h, 1, &w, k, 1, &w, NULL);
    }
    return w;
}

int main(void)
{
    static link l;
    const size_t bytes = iqn_size(SAMPLES, 20, 1);
    double w = 0, w_start, i_start, s[SAMPLES + 1], z[2], hx[SAMPLES], error_w = 0, error_i = 0;
    iqn *q;
    int n, j, status;

    l.current = waveform_make(1, 1, MOST);
    l.velocity = waveform_make(5, 1, SAMPLES + 1);
    *waveform_push(&l.current, 0, 0) = *waveform_push(&l.velocity, 0, 0) = 0;
    circuit(&l);
    check(iqn_make(&q, SAMPLES, 20, 1, scene_memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-7);
    for (n = 0; n < WINDOWS; n++) {
        l.t0 = n * period;
        i_start = l.i;
        w_start = w;
        for (j = 0; j <= SAMPLES; j++) s[j] = l.t0 + at[j];
        begin(&l.velocity, SAMPLES, s + 1); /* the switch is there twice: a break */
        do {
            waveform_fit(&l.velocity);
            wf_rollback(l.current.w);
            l.error = 0;
            command("alter @l1[ic] = %.17g", i_start);
            command("tran 1m %.17g 0 1m uic", period);
            command("destroy all", 0); /* or every repetition's results stay in memory */
            waveform_fit(&l.current);
            hx[PIECE] = w = rotor(w_start, s, &l, hx); /* it does not jump at the switch */
            w = rotor(w, s + PIECE + 1, &l, hx + PIECE + 1);
            status = iqn_step(q, waveform_window(&l.velocity), hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(q));
        check(iqn_converged(q) == 1, "no convergence");
        iqn_commit(q);
        for (j = 1; j <= SAMPLES; j++) {
            exact(&l, s[j], z);
            error_w = fmax(error_w, fabs(hx[j - 1] - z[1]));
        }
        error_i = fmax(error_i, l.error);
        memcpy(l.z0, z, sizeof z);
        wf_advance(l.current.w, 0);
        wf_advance(l.velocity.w, 0);
    }
    printf("current_at_1 %.9f\nexact %.9f\n", l.i, l.z0[0]);
    printf("velocity_at_1 %.9f\nexact %.9f\n", w, l.z0[1]);
    printf("error_current %.2e\nerror_velocity %.2e\nerror_allowed %.0e\n", error_i, error_w, tol);
    printf("iterations_average %.1f\n", iqn_get(q, IQN_NSTEPS) / WINDOWS);
    return error_i <= tol && error_w <= tol ? 0 : 1;
}
