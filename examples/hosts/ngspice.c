/* SPDX-License-Identifier: MIT

   ngspice.c - a circuit in libngspice against a mechanical partner: a motor is switched on

       L i' + R i = V - w(t)     ngspice: the back-voltage w is an EXTERNAL source, driven by a waveform; the current is
                                 written at every time point that ngspice accepts
       J w' + d w = i(t)         rk.h, Dormand-Prince; dense output at six fixed times in the window, which quasi-Newton
                                 iterates on

   R = d = 1, L = J = 1/2, V = 2, at rest for t = 0.  Exact: with s = exp(-2 t),
   i = 1 - s (cos 2t - sin 2t), w = 1 - s (cos 2t + sin 2t).

   ngspice cannot go back in time.  A window is repeated as a new transient analysis from 0, with the state of the window
   start, here the current of one inductor, for initial condition; the callbacks add t0. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ngspice/sharedspice.h>

enum { WINDOWS = 4, SAMPLES = 6, STEPS = 5, MOST = 5000 };

typedef struct waveform {
    wf *grid;
    double *x, *c;
} waveform;

/* What the callbacks of ngspice see.  Angular velocity: what the circuit reads; current: what it writes. */
typedef struct link {
    waveform current, velocity;
    double t0, i, error;
} link;

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

static waveform waveform_make(int degree, int columns)
{
    waveform w;
    const size_t bytes = wf_size(degree, columns);
    check(wf_make(&w.grid, degree, columns, memory(bytes), bytes) == WF_OK, "wf_make");
    w.x = (double *)memory((size_t)columns * sizeof(double));
    w.c = (double *)memory((size_t)columns * sizeof(double));
    w.x[wf_push(w.grid, 0)] = 0;
    return w;
}

static void fit(waveform *w)
{
    check(wf_fit(w->grid, 1, w->x, 1, w->c, 1) >= 0, "wf_fit");
}

static double value(const waveform *w, double t)
{
    double v = 0;
    check(wf_eval(w->grid, t, 0, 1, w->c, 1, &v) >= 0, "wf_eval");
    return v;
}

static double exact(double t, double sign)
{
    return 1 - exp(-2 * t) * (cos(2 * t) + sign * sin(2 * t));
}

/* ---- what ngspice calls: its output, its end, an accepted time point, the value of the external source ---- */

static int on_text(char *text, int id, void *user)
{
    (void)id;
    (void)user;
    if (strstr(text, "rror")) fprintf(stderr, "%s\n", text);
    return 0;
}

static int on_start(vecinfoall *all, int id, void *user) /* without it, time points are not sent either */
{
    (void)all;
    (void)id;
    (void)user;
    return 0;
}

static int on_exit_request(int status, NG_BOOL at_once, NG_BOOL quit, int id, void *user)
{
    (void)at_once;
    (void)quit;
    (void)id;
    (void)user;
    exit(status ? status : 1);
}

static int on_time_point(vecvaluesall *all, int count, int id, void *user)
{
    link *l = (link *)user;
    double t = 0, i = 0;
    int j;
    (void)count;
    (void)id;
    for (j = 0; j < all->veccount; j++) {
        if (strcmp(all->vecsa[j]->name, "time") == 0) t = all->vecsa[j]->creal;
        if (strcmp(all->vecsa[j]->name, "l1#branch") == 0) i = all->vecsa[j]->creal;
    }
    if (t == 0) return 0; /* the window start, already there */
    j = wf_push(l->current.grid, l->t0 + t);
    check(j >= 0, wf_message(j));
    l->current.x[j] = l->i = i;
    l->error = fmax(l->error, fabs(i - exact(l->t0 + t, -1)));
    return 0;
}

static int on_external_source(double *voltage, double t, char *name, int id, void *user)
{
    const link *l = (const link *)user;
    (void)name;
    (void)id;
    *voltage = value(&l->velocity, l->t0 + t);
    return 0;
}

static void command(const char *text)
{
    char copy[100];
    strcpy(copy, text); /* ngspice takes char * and may write to it */
    check(ngSpice_Command(copy) == 0, text);
}

/* ---- the mechanical side: hx = the velocity at the samples' times ---- */

static double rotor(double w, double t0, double t1, const link *l, double *hx)
{
    const rk_table *T = rk_find("dp5");
    const waveform *v = &l->velocity;
    const double h = (t1 - t0) / STEPS;
    double k[7], z, t, s;
    int n, i, j = 0;
    for (n = 0; n < STEPS; n++) {
        t = t0 + n * h;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 1, &w, k, 1, &z);
            k[i] = 2 * (value(&l->current, t + T->c[i] * h) - z);
        }
        for (; j < SAMPLES && (s = (wf_time(v->grid, wf_start(v->grid) + 1 + j) - t) / h) <= 1 + 1e-9; j++)
            rk_dense(T, s, 0, h, 1, &w, k, 1, &hx[j]);
        rk_finish(T, h, 1, &w, k, 1, &w, NULL);
    }
    return w;
}

int main(void)
{
    link l;
    double w = 0, w_start, i_start, hx[SAMPLES], error_w = 0, error_i = 0, worst;
    const double tol = 1e-6;
    const size_t bytes = iqn_size(SAMPLES, 20, 1);
    char text[100];
    /* EXTERNAL takes no DC value beside it: ngspice 39 crashes on that */
    const char *const netlist[] = {"motor",
                                   "V1 1 0 DC 2",
                                   "R1 1 2 1",
                                   "L1 2 3 0.5 ic=0",
                                   "Vback 3 0 external",
                                   ".options reltol=1e-6 abstol=1e-12",
                                   ".end"};
    char lines[7][40], *deck[8] = {NULL};
    iqn *q;
    int n, j, status, total = 0;

    l.current = waveform_make(1, MOST);
    l.velocity = waveform_make(3, SAMPLES + 1);
    l.t0 = l.i = l.error = 0;
    check(ngSpice_Init(on_text, NULL, on_exit_request, on_time_point, on_start, NULL, &l) == 0, "ngSpice_Init");
    check(ngSpice_Init_Sync(on_external_source, NULL, NULL, NULL, &l) == 0, "ngSpice_Init_Sync");
    for (j = 0; j < 7; j++) deck[j] = strcpy(lines[j], netlist[j]);
    check(ngSpice_Circ(deck) == 0, "ngSpice_Circ");

    check(iqn_make(&q, SAMPLES, 20, 1, memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-7);
    for (n = 0; n < WINDOWS; n++) {
        const double t0 = (double)n / WINDOWS, t1 = (double)(n + 1) / WINDOWS;
        double *x = l.velocity.x + wf_start(l.velocity.grid) + 1;
        l.t0 = t0;
        i_start = l.i;
        w_start = w;
        for (j = 1; j <= SAMPLES; j++) /* first guess: constant */
            l.velocity.x[wf_push(l.velocity.grid, t0 + (t1 - t0) * j / SAMPLES)] = w_start;
        do {
            fit(&l.velocity);
            wf_rollback(l.current.grid);
            l.error = 0;
            sprintf(text, "alter @l1[ic] = %.17g", i_start);
            command(text);
            sprintf(text, "tran 1m %.17g 0 1m uic", t1 - t0);
            command(text);
            command("destroy all"); /* or every repetition's results stay in memory */
            fit(&l.current);
            w = rotor(w_start, t0, t1, &l, hx);
            status = iqn_step(q, x, hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(q));
        check(iqn_converged(q) == 1, "no convergence");
        total += (int)iqn_get(q, IQN_ITERATIONS);
        iqn_commit(q);
        for (worst = 0, j = 0; j < SAMPLES; j++)
            worst = fmax(worst, fabs(hx[j] - exact(wf_time(l.velocity.grid, wf_start(l.velocity.grid) + 1 + j), 1)));
        error_w = fmax(error_w, worst);
        error_i = fmax(error_i, l.error);
        wf_advance(l.current.grid, 0, 1, l.current.x, 1);
        wf_advance(l.velocity.grid, 0, 1, l.velocity.x, 1);
    }
    printf("current_at_1 %.9f\nexact %.9f\nvelocity_at_1 %.9f\nexact %.9f\n", l.i, exact(1, -1), w, exact(1, 1));
    printf("error_current %.2e\nerror_velocity %.2e\nerror_allowed %.0e\n", error_i, error_w, tol);
    printf("iterations_average %.1f\n", (double)total / WINDOWS);
    return error_i <= tol && error_w <= tol ? 0 : 1;
}
