/* SPDX-License-Identifier: MIT

   stiff_side.c - a coupling with a stiff side: its steps by esdirk5 of rk.h, an error of 1e-6

   Copy it; your own is what is marked so.  Leave out the error by exact: for yours see "Am I there?" in ACCURACY.md.
   A stiff solver that you have, BDF or another, stays: in place of solve_a it writes the values at its own times ta, no slopes.

   a' = 1e4 (b - a) is stiff: esdirk5, ten steps in a window, which hand out the values at 1/4, 1/2, 3/4 and 1 of each by
   rk_dense, no slopes: an error of a stiff a would be 1e4 times as large in a'.  b' = 1 - 2 b - 4 a is as in slopes.c: an
   integrator of order 4, ten steps, with slopes.  a starts with a jump to b in 1e-4: the windows are as short as that at
   first, then twice as long each, up to WINDOW.  (With FIRST as WINDOW a is wrong by 1e-1, b by 1e-2, and nothing says so.)
   With N numbers a sample: N for the 1 of wf_make and of the rk_ calls (in rk_step twice), 2 * STEPS_B * N in iqn_make,
   memory N times as long; k[16 * N] with stage i at k + i * N; base, z and slope are arrays of N, and so is each column.
   Prints the largest error at the ends of the steps, of the largest value, 1. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FIRST (1 / STIFF) /* your own, and the next four: length of the first window; WINDOW, if a starts without a jump */
#define WINDOW 0.0625
#define END 2.
#define STEPS_A 10 /* of the two sides in a window */
#define STEPS_B 10
#define ROOM_A (2 * 4 * STEPS_A + 1) /* columns: four a step; a window, its start, one of history */
#define ROOM_B (2 * 2 * STEPS_B + 2) /* two a step, value and slope */
#define STIFF 1e4                    /* above 21, for the closed form */

static int ok(int status) /* -1xx: waveform.h, -2xx: iqn.h, -3xx: rk.h */
{
    if (status < 0) puts(status > -200 ? wf_message(status) : status > -300 ? iqn_message(status) : rk_message(status)), exit(1);
    return status;
}

static double read_at(wf *w, double t)
{
    double v;
    ok(wf_read(w, t, 0, &v));
    return v;
}

static double rate_b(double b, double a) { return 1 - 2 * b - 4 * a; } /* your own */

/* The stiff side: IMPLICIT STAGES in the recipes of rk.h.  slope: a' at the start of the window; returns that at its end.
   It is carried along, not asked again: a' of a value that is off by 1e-6 would be off by 1e-2. */
static double solve_a(wf *a, wf *b, double slope)
{
    const rk_table *T = rk_find("esdirk5");
    const int m = T->stages + T->extra;
    double k[16]; /* T->stages + T->extra slopes of the one number that the 1s below say */
    for (int j = wf_start(a) + 4; j < wf_columns(a); j += 4) {
        double t = wf_time(a, j - 4), h = wf_time(a, j) - t, *y = wf_column(a, j - 4);
        const rk_step step = {T, h, 1, y, k, 1};
        k[0] = slope;
        for (int i = 1; i < T->stages; i++) {
            double g = h * T->A[i * m + i], base, z;
            rk_stage(T, i, h, 1, y, k, 1, &base);
            z = (base + g * STIFF * read_at(b, t + T->c[i] * h)) / (1 + g * STIFF); /* your own: z - g f(t, z) = base */
            k[i] = (z - base) / g;
        }
        for (int i = 1; i < 4; i++) ok(rk_dense(&step, i / 4., 0, wf_column(a, j - 4 + i)));
        ok(rk_update(T, h, 1, y, k, 1, wf_column(a, j), NULL));
        slope = k[T->stages - 1]; /* FSAL: slope 0 of the next step */
    }
    return slope;
}

/* The other side: the classical method of order 4, value in column j, slope in j + 1 */
static void solve_b(wf *y, wf *x)
{
    for (int j = wf_start(y) + 2; j < wf_columns(y); j += 2) {
        double t = wf_time(y, j - 2), h = wf_time(y, j) - t, y0 = *wf_column(y, j - 2), k1 = *wf_column(y, j - 1);
        double middle = read_at(x, t + h / 2), end = read_at(x, t + h);
        double k2 = rate_b(y0 + h / 2 * k1, middle);
        double k3 = rate_b(y0 + h / 2 * k2, middle);
        double k4 = rate_b(y0 + h * k3, end);
        double y1 = y0 + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        *wf_column(y, j) = y1;
        *wf_column(y, j + 1) = rate_b(y1, end);
    }
}

/* From a = 0, b = 1: b = 1/6 + p exp(l1 t) + q exp(l2 t), l1 and l2 the roots of l l + (STIFF + 2) l + 6 STIFF = 0; a from b' */
static double exact(double t, int of_a)
{
    const double sum = STIFF + 2, l1 = -(sum + sqrt(sum * sum - 24 * STIFF)) / 2, l2 = 6 * STIFF / l1;
    const double q = (rate_b(1, 0) - l1 * 5 / 6) / (l2 - l1), p = 5. / 6 - q;
    const double fast = p * exp(l1 * t), slow = q * exp(l2 * t), b = 1. / 6 + fast + slow;
    return of_a ? (1 - 2 * b - l1 * fast - l2 * slow) / 4 : b;
}

static double larger(double a, double b) { return a > b ? a : b >= 0 ? b : HUGE_VAL; } /* of NaN, too */

/* The largest error at the ends of steps in the window; a, b are at most 1 */
static double largest_error(wf *w, int stride, int of_a)
{
    double error = 0;
    for (int j = wf_start(w) + stride; j < wf_columns(w); j += stride)
        error = larger(error, fabs(*wf_column(w, j) - exact(wf_time(w, j), of_a)));
    return error;
}

int main(void)
{
    static double mem_a[50 + 20 * ROOM_A], mem_b[50 + 20 * ROOM_B], mem_h[50 + 20 * ROOM_B]; /* wf_size, degree 3 */
    static double mem_q[4000 + 50 * 2 * STEPS_B];                                            /* iqn_size */
    double ta[4 * STEPS_A], tb[STEPS_B], error = 0, iterations = 0, next = 0;
    wf *a, *b, *hb;
    iqn *q;
    ok(wf_make(&a, 1, 3, ROOM_A, mem_a, sizeof mem_a));
    ok(wf_make(&b, 1, 3, ROOM_B, mem_b, sizeof mem_b));
    ok(wf_make(&hb, 1, 3, ROOM_B, mem_h, sizeof mem_h));
    ok(iqn_make(&q, 2 * STEPS_B, 20, 1, mem_q, sizeof mem_q)); /* value and slope of b's steps */
    ok(iqn_set(q, IQN_TOL_RELATIVE, 1e-6));  /* your own: the error that you want */
    *wf_column(a, ok(wf_push(a, 0, 0))) = 0; /* your own: the initial values; the stiff side without slopes */
    double slope = STIFF * (1 - 0);          /* your own: a' at the start */
    const int j = ok(wf_push(b, 0, WF_SLOPE));
    *wf_column(b, j) = 1;
    *wf_column(b, j + 1) = rate_b(1, 0);
    /* Times count from the start of the run: EXTREMES.md, "Unix time" */
    for (double t0 = 0, w = FIRST; w > 1e-9 * WINDOW; t0 += w, w = fmin(2 * w, fmin(WINDOW, END - t0))) {
        for (int k = 0; k < 4 * STEPS_A; k++) ta[k] = t0 + w * (k + 1) / (4. * STEPS_A);
        for (int k = 0; k < STEPS_B; k++) tb[k] = t0 + w * (k + 1) / STEPS_B;
        ok(wf_begin(a, 1, 4 * STEPS_A, ta, 0));
        ok(wf_begin(b, 1, STEPS_B, tb, WF_SLOPE));
        ok(wf_copy(hb, b));
        double *x = wf_column(b, wf_start(b) + 2), *hx = wf_column(hb, wf_start(hb) + 2);
        do {
            next = solve_a(a, b, slope); /* reads b, writes a */
            solve_b(hb, a);              /* reads a, writes what it would have b be */
            ok(iqn_step(q, x, hx));
        } while (!iqn_converged(q));
        if (iqn_converged(q) != 1) return puts("gave up"), 1; /* TROUBLE.md has a loop that goes on */
        slope = next;
        error = larger(error, larger(largest_error(a, 4, 1), largest_error(b, 2, 0)));
        iterations += iqn_get(q, IQN_ITERATIONS);
        ok(iqn_commit(q));
        ok(wf_advance(a, 4 * STEPS_A));
        ok(wf_advance(b, STEPS_B));
    }
    printf("error %.2g iterations %g\n", error, iterations);
    return 0;
}
