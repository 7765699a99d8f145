/* SPDX-License-Identifier: MIT

   stiff_side.c - a coupling with a stiff side: its steps by esdirk5 of rk.h, an error of 1e-6

   Copy it and replace what stands under "your own".  A stiff solver of yours (BDF), N numbers, how it works: at the end. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- your own ---------------------------------------------------------------------------------------------------------- */

#define ERROR 1e-6        /* that you want, of the largest value: tolerance of the iteration; the steps decide it, too */
#define TABLE "esdirk5"   /* of the stiff side, a: an esdirk table; for 1e-2 "esdirk3" */
#define FIRST (1 / STIFF) /* the first window: as short as the fastest motion at the start, else a is wrong by 1e-1, unseen */
#define WINDOW 0.0625     /* the longest; each is twice the one before.  Another ERROR: halve it until the answer stays */
#define END 2.
#define STEPS_A 10        /* of the two sides in a window */
#define STEPS_B 10

#define STIFF 1e4
static const double a0 = 0, b0 = 1;                                  /* at time 0 */
static double rate_a(double a, double b) { return STIFF * (b - a); } /* asked at time 0 alone */
static double rate_b(double b, double a) { return 1 - 2 * b - 4 * a; }

/* Your implicit solver: the z of z - g rate_a(z, b) = base */
static double stage_a(double g, double base, double b) { return (base + g * STIFF * b) / (1 + g * STIFF); }

static double read_at(wf *w, double t);

/* A step of y' = rate(y, x) from t to t + h, x read at any time; or a step of your integrator */
static double step_b(double t, double h, double y, double slope, wf *x)
{
    double middle = read_at(x, t + h / 2), end = read_at(x, t + h);
    double k2 = rate_b(y + h / 2 * slope, middle);
    double k3 = rate_b(y + h / 2 * k2, middle);
    double k4 = rate_b(y + h * k3, end);
    return y + h / 6 * (slope + 2 * k2 + 2 * k3 + k4);
}

/* ---- the coupling, as it is -------------------------------------------------------------------------------------------- */

#define INSIDE 4                          /* values that a step of a hands out, no slopes */
#define ROOM_A (2 * INSIDE * STEPS_A + 1) /* columns: a window, its start, one of history */
#define ROOM_B (2 * 2 * STEPS_B + 2)      /* two a step, value and slope */

static int ok(int status) /* -1xx: waveform.h, -2xx: iqn.h, -3xx: rk.h */
{
    if (status >= 0) return status;
    puts(status > -200 ? wf_message(status) : status > -300 ? iqn_message(status) : rk_message(status));
    exit(1);
}

static double read_at(wf *w, double t)
{
    double v;
    ok(wf_read(w, t, 0, &v));
    return v;
}

/* The stiff side: IMPLICIT STAGES in the recipes of rk.h.  first: a' at the start of the window; last: at its end.  They are
   carried along, not asked again: a' of a value that is off by 1e-6 would be off by 1e-2. */
static void solve_a(wf *a, wf *b, const double *first, double *last)
{
    const rk_table *T = rk_find(TABLE);
    const int m = T->stages + T->extra;
    double k[16]; /* a slope for each of the at most 16 stages */
    k[0] = *first;
    for (int j = wf_start(a) + INSIDE; j < wf_columns(a); j += INSIDE) {
        double t = wf_time(a, j - INSIDE), h = wf_time(a, j) - t, *y = wf_column(a, j - INSIDE);
        const rk_step step = {T, h, 1, y, k, 1};
        for (int i = 1; i < T->stages; i++) {
            double g = h * T->A[i * m + i], base, z;
            ok(rk_stage(T, i, h, 1, y, k, 1, &base));
            z = stage_a(g, base, read_at(b, t + T->c[i] * h));
            k[i] = (z - base) / g;
        }
        for (int i = 1; i < INSIDE; i++) ok(rk_dense(&step, (double)i / INSIDE, 0, wf_column(a, j - INSIDE + i)));
        ok(rk_update(T, h, 1, y, k, 1, wf_column(a, j), NULL));
        k[0] = k[T->stages - 1]; /* FSAL: the first slope of the next step */
    }
    *last = k[0];
}

/* The other side, as in slopes.c: the value in column j, the slope in j + 1 */
static void solve_b(wf *y, wf *x)
{
    for (int j = wf_start(y) + 2; j < wf_columns(y); j += 2) {
        double t = wf_time(y, j - 2), h = wf_time(y, j) - t;
        double y1 = step_b(t, h, *wf_column(y, j - 2), *wf_column(y, j - 1), x);
        *wf_column(y, j) = y1;
        *wf_column(y, j + 1) = rate_b(y1, read_at(x, t + h));
    }
}

static double error_here(wf *a, wf *b);

int main(void)
{
    static double mem_a[50 + 20 * ROOM_A], mem_b[50 + 20 * ROOM_B], mem_h[50 + 20 * ROOM_B]; /* wf_size, degree 3 */
    static double mem_q[4000 + 50 * 2 * STEPS_B];                                            /* iqn_size */
    double ta[INSIDE * STEPS_A], tb[STEPS_B], error = 0, iterations = 0, first = rate_a(a0, b0), last = 0;
    wf *a, *b, *hb;
    iqn *q;
    int status;
    ok(wf_make(&a, 1, 3, ROOM_A, mem_a, sizeof mem_a));
    ok(wf_make(&b, 1, 3, ROOM_B, mem_b, sizeof mem_b));
    ok(wf_make(&hb, 1, 3, ROOM_B, mem_h, sizeof mem_h));
    ok(iqn_make(&q, 2 * STEPS_B, 20, 1, mem_q, sizeof mem_q)); /* value and slope of b's steps */
    ok(iqn_set(q, IQN_TOL_RELATIVE, ERROR));
    *wf_column(a, ok(wf_push(a, 0, 0))) = a0; /* the stiff side: no slopes */
    const int j = ok(wf_push(b, 0, WF_SLOPE));
    *wf_column(b, j) = b0;
    *wf_column(b, j + 1) = rate_b(b0, a0);
    /* Times count from the start of the run: EXTREMES.md, "Unix time".  A last w may be rounding of END: that is no window */
    for (double t0 = 0, w = FIRST; w > 1e-9 * WINDOW; t0 += w, w = fmin(2 * w, fmin(WINDOW, END - t0))) {
        for (int k = 0; k < INSIDE * STEPS_A; k++) ta[k] = t0 + w * (k + 1) / (INSIDE * STEPS_A);
        for (int k = 0; k < STEPS_B; k++) tb[k] = t0 + w * (k + 1) / STEPS_B;
        ok(wf_begin(a, 1, INSIDE * STEPS_A, ta, 0));
        ok(wf_begin(b, 1, STEPS_B, tb, WF_SLOPE));
        ok(wf_copy(hb, b)); /* what b would be */
        double *x = wf_column(b, wf_start(b) + 2), *hx = wf_column(hb, wf_start(hb) + 2);
        do {
            solve_a(a, b, &first, &last);    /* reads b, writes a */
            solve_b(hb, a);                  /* reads a, writes what it would have b be */
            status = ok(iqn_step(q, x, hx)); /* x becomes the next input, at last the answer */
        } while (!iqn_converged(q));
        if (iqn_converged(q) != 1) return printf("%d %s\n", status, iqn_message(status)), 1; /* TROUBLE.md: "It gave up" */
        first = last;
        error = fmax(error, error_here(a, b)); /* of this example: leave it out, in the last printf, too */
        iterations += iqn_get(q, IQN_ITERATIONS);
        ok(iqn_commit(q));
        ok(wf_advance(a, INSIDE * STEPS_A));
        ok(wf_advance(b, STEPS_B));
    }
    printf("error %.2g iterations %g\n", error, iterations);
    return 0;
}

/* ---- the error of this example; for yours see "Am I there?" in ACCURACY.md --------------------------------------------- */

/* b = 1/6 + p exp(l1 t) + q exp(l2 t), l1 and l2 the roots of l l + (STIFF + 2) l + 6 STIFF = 0, STIFF above 21; a from b' */
static double exact(double t, int of_a)
{
    const double sum = STIFF + 2, l1 = -(sum + sqrt(sum * sum - 24 * STIFF)) / 2, l2 = 6 * STIFF / l1;
    const double q = (-1 - l1 * 5 / 6) / (l2 - l1), p = 5. / 6 - q;
    const double fast = p * exp(l1 * t), slow = q * exp(l2 * t), b = 1. / 6 + fast + slow;
    return of_a ? (1 - 2 * b - l1 * fast - l2 * slow) / 4 : b;
}

/* The largest error at the ends of steps in the window; a and b are at most 1 */
static double largest_error(wf *w, int stride, int of_a)
{
    double error = 0;
    for (int j = wf_start(w) + stride; j < wf_columns(w); j += stride) {
        double off = fabs(*wf_column(w, j) - exact(wf_time(w, j), of_a));
        error = off <= error ? error : off >= 0 ? off : HUGE_VAL; /* NaN, too */
    }
    return error;
}

static double error_here(wf *a, wf *b) { return fmax(largest_error(a, INSIDE, 1), largest_error(b, 2, 0)); }

/* How it works.  a' = 1e4 (b - a) is stiff: esdirk5, whose steps hand out the values at 1/4, 1/2, 3/4 and 1 by rk_dense, no
   slopes: an error of a stiff a would be 1e4 times as large in a'.  b' = 1 - 2 b - 4 a is as in slopes.c: an integrator of
   order 4, with slopes.  a starts with a jump to b in 1e-4: the windows are as short as that at first, then twice as long
   each, up to WINDOW.  (With FIRST as WINDOW a is wrong by 1e-1, b by 1e-2.  Where nothing moves fast at the start it may.)

   A stiff solver that you have, BDF or another, stays: INSIDE 1, and in place of solve_a it writes the values at its STEPS_A
   times, wf_time(a, j), j from wf_start(a) + 1, and reads b by read_at; first, last, stage_a and rate_a go.  Each call
   starts from its state at the start of the window (hosts/README.md).  Order 2 or 3 needs more steps.  If it chooses its
   times itself: "When a side chooses its own sub-steps" in hosts/README.md.

   With N numbers a sample: N for the 1 of wf_make, and for both 1s of rk_step, rk_stage and rk_update; 2 * STEPS_B * N in
   iqn_make, memory N times as long; k[16 * N], stage i at k + i * N; a0, b0, base, z, first, last, what is read and returned
   are arrays of N, and so long is each column. */
