/* SPDX-License-Identifier: MIT

   host.h - what the C hosts share: a waveform with its samples, checks, and a linear mapping
   between interface nodes */
#ifndef HOST_H
#define HOST_H
#include "waveform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A time grid and its samples of n numbers, column j at x + j*n; c: the coefficients, from fit. */
typedef struct waveform {
    wf *grid;
    int n;
    double *x, *c;
} waveform;

static inline void check(int ok, const char *what)
{
    if (ok) return;
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static inline int good(int status) /* passes a status on, or ends with its sentence */
{
    check(status >= 0, wf_message(status));
    return status;
}

static inline void *memory(size_t bytes)
{
    void *p = malloc(bytes);
    check(bytes > 0 && p != NULL, "no memory");
    return p;
}

static inline waveform waveform_make(int n, int degree, int columns)
{
    waveform w;
    const size_t bytes = wf_size(degree, columns), numbers = (size_t)n * (size_t)columns;
    good(wf_make(&w.grid, degree, columns, memory(bytes), bytes));
    w.n = n;
    w.x = (double *)memory(numbers * sizeof *w.x);
    w.c = (double *)memory(numbers * sizeof *w.c);
    return w;
}

static inline double *column(const waveform *w, int j)
{
    return w->x + (ptrdiff_t)j * w->n;
}

static inline double *write_at(waveform *w, double t) /* where the sample of time t goes */
{
    return column(w, good(wf_push(w->grid, t)));
}

static inline double *write_behind(waveform *w, double t) /* at an event, the value behind it */
{
    return column(w, good(wf_push_break(w->grid, t)));
}

/* A window on these times; first guess: constant. */
static inline void begin(waveform *w, int count, const double *t)
{
    good(wf_begin(w->grid, count, t, 0, w->n, w->x, w->n));
}

/* Chebyshev-Lobatto times t[0] = a .. t[count-1] = b, to sample a window that is one polynomial. */
static inline void lobatto(double a, double b, int count, double *t)
{
    int j;
    for (j = 0; j < count; j++)
        t[j] = a + (b - a) * (0.5 - 0.5 * cos(acos(-1.0) * j / (count - 1)));
    t[count - 1] = b;
}

/* All samples behind the window start: what an iteration changes. */
static inline double *unknowns(const waveform *w)
{
    return column(w, wf_start(w->grid) + 1);
}

static inline void fit(waveform *w)
{
    good(wf_fit(w->grid, w->n, w->x, w->n, w->c, w->n));
}

static inline void read_at(const waveform *w, double t, int derivative, double *out)
{
    good(wf_eval(w->grid, t, derivative, w->n, w->c, w->n, out));
}

static inline void advance(waveform *w)
{
    good(wf_advance(w->grid, 0, w->n, w->x, w->n));
}

/* The other side's field where this side has its nodes.  The mapping of these hosts is linear
   interpolation between even nodes on [0, 1]; any other linear one will do. */
static inline void read_mapped(const waveform *w, double t, int derivative, int n, double *out)
{
    double there[16];
    int i, k;
    check(w->n <= 16, "read_mapped: more than 16 nodes");
    read_at(w, t, derivative, there);
    for (i = 0; i < n; i++) {
        const double s = (double)i * (w->n - 1) / (n - 1);
        k = s < w->n - 2 ? (int)s : w->n - 2;
        out[i] = there[k] + (s - k) * (there[k + 1] - there[k]);
    }
}
#endif
