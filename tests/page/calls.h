/* SPDX-License-Identifier: MIT

   calls.h - the two halves around "the calls behind this picture" of examples/page: what a host owns, and both of its
   solvers.  With the calls in between it is a program that prints the errors of both sides and the iterations of a run. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include "oscillator.h"
#include <stdio.h>

enum { ENDS, SAMPLES, SLOPES, MEANS };
static struct {
    int windows, steps_a, steps_b, exchange;
} setting;

static double mem_a[50000], mem_b[50000], mem_h[50000], mem_q[50000], ta[100], tb[100], *x, *hx;
static int window;
static wf *a, *b, *hb;
static iqn *q;
static const rk_table *T;

static struct {
    mass start, now;
    double u[101], error;
} side[2];
static int iterations;

static double exact(int is_b, double t)
{
    return 0.5 * (cos(2 * PI * t) + (is_b ? -1 : 1) * cos(6 * PI * t));
}

static double time_in(int k, int j, int steps)
{
    return mass_time((double)k / setting.windows, (k + 1.0) / setting.windows, j, steps);
}

static void window_is_over(int k)
{
    int s, j;
    for (s = 0; s < 2; s++) {
        const int steps = s ? setting.steps_b : setting.steps_a;
        side[s].start = side[s].now;
        for (j = 1; j <= steps; j++)
            side[s].error = fmax(side[s].error, fabs(side[s].u[j] - exact(s, time_in(k, j, steps))));
    }
}

static void times_of(int k, double *of_a, double *of_b)
{
    const int samples_a = setting.exchange == ENDS ? 1 : setting.steps_a;
    const int samples_b = setting.exchange == ENDS ? 1 : setting.steps_b;
    int j;
    if (k > 0) window_is_over(k - 1);
    for (j = 1; j <= samples_a; j++) of_a[j - 1] = time_in(k, j, samples_a);
    for (j = 1; j <= samples_b; j++) of_b[j - 1] = time_in(k, j, samples_b);
}

static double read_partner(void *partner, double t, double h, double at)
{
    double u = 0;
    if (setting.exchange == MEANS) wf_mean((wf *)partner, t, t + h, &u);
    else wf_read((wf *)partner, at, 0, &u);
    return u;
}

static void solve(int s, wf *own, wf *partner)
{
    const int steps = s ? setting.steps_b : setting.steps_a, per = setting.exchange == SLOPES ? 2 : 1;
    const double h = 1.0 / setting.windows / steps;
    mass *m = &side[s].now;
    double *column;
    int j;
    *m = side[s].start;
    for (j = 1; j <= steps; j++) {
        if (s == 0) mass_runge_kutta(m, time_in(window, j - 1, steps), h, T, read_partner, partner);
        else mass_generalized_alpha(m, time_in(window, j - 1, steps), h, read_partner, partner);
        side[s].u[j] = m->u;
        if (setting.exchange == ENDS && j < steps) continue;
        column = wf_column(own, wf_start(own) + (setting.exchange == ENDS ? 1 : per * j));
        column[0] = m->u;
        if (per == 2) column[1] = m->v;
    }
}

static void solve_a(wf *own, wf *partner)
{
    solve(0, own, partner);
}

static void solve_b(wf *own, wf *partner)
{
    iterations++;
    solve(1, own, partner);
}

static void begin(int windows, int steps_a, int steps_b, int exchange)
{
    int s;
    setting.windows = windows;
    setting.steps_a = steps_a;
    setting.steps_b = steps_b;
    setting.exchange = exchange;
    iterations = 0;
    for (s = 0; s < 2; s++) {
        side[s].start = side[s].now = mass_at_rest(s ? 0 : 1, s ? 1 : 0);
        side[s].error = 0;
    }
}

static void end(void)
{
    window_is_over(setting.windows - 1);
    printf("%.17g %.17g %d\n", side[0].error, side[1].error, iterations);
}
