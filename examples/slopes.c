/* SPDX-License-Identifier: MIT

   slopes.c - two integrators of order 4 with 10 and 100 sub-steps in a window: an error of 1e-6

   Copy it and replace what stands under "your own".  How it works, and what changes for N numbers: at the end. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "waveform.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- your own ---------------------------------------------------------------------------------------------------------- */

#define ERROR 1e-6  /* that you want, of the largest value */
#define WINDOW 0.25 /* its steps decide the error, too: by steps half as long a sixteenth of it */
#define END 3.
#define A 100 /* sub-steps of the two integrators in a window */
#define B 10  /* of the side with fewer */

static const double a0 = 1, b0 = 0; /* at time 0 */
static double rate_a(double a, double b) { return 4 * b - a; }
static double rate_b(double b, double a) { return 1 - 2 * b - 4 * a; }

static double read_at(wf *w, double t);

/* A step of y' = rate(y, x) from t to t + h, x read at any time: put your integrator here, or two, by rate == rate_a.  The
   two rates stay, for the slopes; if there are none: "Your own integrator" in ACCURACY.md. */
static double step(double rate(double, double), double t, double h, double y, double slope, wf *x)
{
    double middle = read_at(x, t + h / 2), end = read_at(x, t + h);
    double k2 = rate(y + h / 2 * slope, middle);
    double k3 = rate(y + h / 2 * k2, middle);
    double k4 = rate(y + h * k3, end);
    return y + h / 6 * (slope + 2 * k2 + 2 * k3 + k4);
}

/* ---- the coupling, as it is -------------------------------------------------------------------------------------------- */

#define ROOM (2 * 2 * (A > B ? A : B) + 2) /* two columns a sample: a window, its start, one of history */

static int ok(int status)
{
    if (status < 0) puts(status > -200 ? wf_message(status) : iqn_message(status)), exit(1);
    return status;
}

static double read_at(wf *w, double t)
{
    double v;
    ok(wf_read(w, t, 0, &v));
    return v;
}

/* All steps of a window, from its start: the value in column j, the slope in j + 1 */
static void solve(double rate(double, double), wf *y, wf *x)
{
    for (int j = wf_start(y) + 2; j < wf_columns(y); j += 2) {
        double t = wf_time(y, j - 2), h = wf_time(y, j) - t;
        double y1 = step(rate, t, h, *wf_column(y, j - 2), *wf_column(y, j - 1), x);
        *wf_column(y, j) = y1;
        *wf_column(y, j + 1) = rate(y1, read_at(x, t + h));
    }
}

static void begin(wf *w, double value, double slope)
{
    int j = ok(wf_push(w, 0, WF_SLOPE));
    *wf_column(w, j) = value;
    *wf_column(w, j + 1) = slope;
}

static double error_here(wf *a, wf *b);

int main(void)
{
    static double mem_a[50 + 20 * ROOM], mem_b[50 + 20 * ROOM], mem_h[50 + 20 * ROOM]; /* wf_size, degree 3 */
    static double mem_q[4000 + 50 * 2 * B];                                            /* iqn_size */
    double ta[A], tb[B], error = 0, iterations = 0;
    wf *a, *b, *hb;
    iqn *q;
    int status;
    ok(wf_make(&a, 1, 3, ROOM, mem_a, sizeof mem_a)); /* one number, cubic in time */
    ok(wf_make(&b, 1, 3, ROOM, mem_b, sizeof mem_b));
    ok(wf_make(&hb, 1, 3, ROOM, mem_h, sizeof mem_h));
    ok(iqn_make(&q, 2 * B, 20, 1, mem_q, sizeof mem_q)); /* value and slope of b's samples */
    ok(iqn_set(q, IQN_TOL_RELATIVE, ERROR));
    begin(a, a0, rate_a(a0, b0));
    begin(b, b0, rate_b(b0, a0));
    for (int window = 0; WINDOW * (window + 0.5) < END; window++) { /* END / WINDOW of them, however that is rounded */
        for (int k = 0; k < A; k++) ta[k] = WINDOW * (window + (k + 1.) / A); /* not t += h: that would add up rounding */
        for (int k = 0; k < B; k++) tb[k] = WINDOW * (window + (k + 1.) / B);
        ok(wf_begin(a, 1, A, ta, WF_SLOPE));
        ok(wf_begin(b, 1, B, tb, WF_SLOPE));
        ok(wf_copy(hb, b)); /* what b would be */
        double *x = wf_column(b, wf_start(b) + 2), *hx = wf_column(hb, wf_start(hb) + 2);
        do {
            solve(rate_a, a, b);             /* reads b, writes a */
            solve(rate_b, hb, a);            /* reads a, writes what it would have b be */
            status = ok(iqn_step(q, x, hx)); /* x becomes the next input, at last the answer */
        } while (!iqn_converged(q));
        if (iqn_converged(q) != 1) return printf("%d %s\n", status, iqn_message(status)), 1; /* TROUBLE.md: "It gave up" */
        error = fmax(error, error_here(a, b)); /* of this example: leave it out, in the last printf, too */
        iterations += iqn_get(q, IQN_ITERATIONS);
        ok(iqn_commit(q));
        ok(wf_advance(a, A)); /* samples, not columns */
        ok(wf_advance(b, B));
    }
    printf("error %.2g iterations %g\n", error, iterations);
    return 0;
}

/* ---- the error of this example; for yours see "Am I there?" in ACCURACY.md --------------------------------------------- */

/* a and b swing about a rest and decay: y - rest is exp(-1.5 t) times cosine and sine of w t, by y and y' at 0 */
static double exact(double t, double rest, double y, double slope)
{
    const double w = sqrt(15.75);
    return rest + exp(-1.5 * t) * ((y - rest) * cos(w * t) + (slope + 1.5 * (y - rest)) / w * sin(w * t));
}

/* The largest error of the samples in the window over the size of that side; y and slope are those at time 0 */
static double largest_error(wf *w, double size, double rest, double y, double slope)
{
    double error = 0;
    for (int j = wf_start(w) + 2; j < wf_columns(w); j += 2) {
        double off = fabs(*wf_column(w, j) - exact(wf_time(w, j), rest, y, slope)) / size;
        error = off <= error ? error : off >= 0 ? off : HUGE_VAL; /* NaN, too */
    }
    return error;
}

static double error_here(wf *a, wf *b)
{
    return fmax(largest_error(a, 1, 2. / 9, 1, -1), largest_error(b, 0.4, 1. / 18, 0, -3));
}

/* How it works.  Every sample is two columns, the value and the derivative after it, which the integrator knows anyway.
   Degree 3 then has what it needs at step ends: no value inside a step is handed out.  That is what differs most from the
   first program of README.md.  A solver with a state of its own puts it back at the start of each call of solve
   (hosts/README.md).  With N numbers a sample: N for the 1 of wf_make, 2 * B * N in iqn_make, memory N times as long; a0 and
   b0 are arrays of N, step, rate and read_at fill such, and so long is each column. */
