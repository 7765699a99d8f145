/* SPDX-License-Identifier: MIT

   slopes.c - two integrators of order 4 with 10 and 100 sub-steps in a window: an error of 1e-6

   Copy it; your own is what is marked so.  Your solver begins each call at the window start.  Leave out the error by exact:
   for yours see "Am I there?" in ACCURACY.md.

   Every sample is two columns, the value and the derivative after it, which the integrator knows anyway.  Degree 3 then has
   what it needs at step ends: no value inside a step is asked for.  What differs from the first program of README.md is
   marked, too: slopes.  With N numbers a sample: N for the 1 of wf_make, 2 * B * N in iqn_make, memory N times as long; v,
   y0, y1 and the k of solve are arrays of N, and so is each column.  Prints the largest error over all samples, of the
   largest value of its side. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "waveform.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define WINDOW 0.25 /* your own, and the next three */
#define END 3.
#define A 100 /* sub-steps of the two solvers in a window */
#define B 10  /* of the side with fewer */
#define ROOM (2 * 2 * (A > B ? A : B) + 2) /* slopes: two columns a sample */

static int ok(int status)
{
    if (status < 0) puts(status > -200 ? wf_message(status) : iqn_message(status)), exit(1);
    return status;
}

/* Your own: a' and b' */
static double rate_a(double a, double b) { return 4 * b - a; }
static double rate_b(double b, double a) { return 1 - 2 * b - 4 * a; }

/* y' of your solver at time t; the other solver's x is read at any time */
static double rate_at(double rate(double, double), double t, double y, wf *x)
{
    double v;
    ok(wf_read(x, t, 0, &v));
    return rate(y, v);
}

/* Your own, or this one: the classical method of order 4, on the times of y */
static void solve(double rate(double, double), wf *y, wf *x)
{
    for (int j = wf_start(y) + 2; j < wf_columns(y); j += 2) { /* slopes: value in column j, slope in j + 1 */
        double t = wf_time(y, j - 2), h = wf_time(y, j) - t, y0 = *wf_column(y, j - 2), k1 = *wf_column(y, j - 1);
        double k2 = rate_at(rate, t + h / 2, y0 + h / 2 * k1, x);
        double k3 = rate_at(rate, t + h / 2, y0 + h / 2 * k2, x);
        double k4 = rate_at(rate, t + h, y0 + h * k3, x);
        double y1 = y0 + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        *wf_column(y, j) = y1;
        *wf_column(y, j + 1) = rate_at(rate, t + h, y1, x); /* slopes */
    }
}

/* a and b swing about a rest and decay: y - rest is exp(-1.5 t) times cosine and sine of w t, by y and y' at 0 */
static double exact(double t, double rest, double y, double slope)
{
    const double w = sqrt(15.75);
    return rest + exp(-1.5 * t) * ((y - rest) * cos(w * t) + (slope + 1.5 * (y - rest)) / w * sin(w * t));
}

static double larger(double a, double b) { return a > b ? a : b >= 0 ? b : HUGE_VAL; } /* of NaN, too */

/* The largest error of the samples in the window, which are columns j, j + 2, .. */
static double largest_error(wf *w, double rest, double y, double slope)
{
    double error = 0;
    for (int j = wf_start(w) + 2; j < wf_columns(w); j += 2)
        error = larger(error, fabs(*wf_column(w, j) - exact(wf_time(w, j), rest, y, slope)));
    return error;
}

int main(void)
{
    static double mem_a[50 + 20 * ROOM], mem_b[50 + 20 * ROOM], mem_h[50 + 20 * ROOM]; /* wf_size, degree 3 */
    static double mem_q[4000 + 50 * 2 * B];                                            /* iqn_size; slopes: 2 * B */
    double ta[A], tb[B], error = 0, iterations = 0;
    wf *a, *b, *hb;
    iqn *q;
    int j;
    ok(wf_make(&a, 1, 3, ROOM, mem_a, sizeof mem_a));
    ok(wf_make(&b, 1, 3, ROOM, mem_b, sizeof mem_b));
    ok(wf_make(&hb, 1, 3, ROOM, mem_h, sizeof mem_h));
    ok(iqn_make(&q, 2 * B, 20, 1, mem_q, sizeof mem_q)); /* slopes: 2 * B numbers */
    ok(iqn_set(q, IQN_TOL_RELATIVE, 1e-6));              /* your own: the error that you want */
    j = ok(wf_push(a, 0, WF_SLOPE));     /* slopes: WF_SLOPE for 0 */
    *wf_column(a, j) = 1;                /* your own: the initial values */
    *wf_column(a, j + 1) = rate_a(1, 0); /* slopes */
    j = ok(wf_push(b, 0, WF_SLOPE));     /* slopes */
    *wf_column(b, j) = 0;                /* your own */
    *wf_column(b, j + 1) = rate_b(0, 1); /* slopes */
    for (int window = 0; window < END / WINDOW; window++) {
        for (int k = 0; k < A; k++) ta[k] = WINDOW * (window + (k + 1.) / A); /* not t += h: that would add up rounding */
        for (int k = 0; k < B; k++) tb[k] = WINDOW * (window + (k + 1.) / B);
        ok(wf_begin(a, 1, A, ta, WF_SLOPE)); /* slopes: WF_SLOPE for 0, here and in the next line */
        ok(wf_begin(b, 1, B, tb, WF_SLOPE));
        ok(wf_copy(hb, b));
        double *x = wf_column(b, wf_start(b) + 2), *hx = wf_column(hb, wf_start(hb) + 2); /* slopes: + 2 */
        do {
            solve(rate_a, a, b);
            solve(rate_b, hb, a);
            ok(iqn_step(q, x, hx));
        } while (!iqn_converged(q));
        if (iqn_converged(q) != 1) return puts("gave up"), 1; /* TROUBLE.md has a loop that goes on */
        error = larger(error, largest_error(a, 2. / 9, 1, -1) / 1); /* of the largest a and b */
        error = larger(error, largest_error(b, 1. / 18, 0, -3) / 0.4);
        iterations += iqn_get(q, IQN_ITERATIONS);
        ok(iqn_commit(q));
        ok(wf_advance(a, A)); /* samples, not columns */
        ok(wf_advance(b, B));
    }
    printf("error %.2g iterations %g\n", error, iterations);
    return 0;
}
