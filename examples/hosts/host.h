/* SPDX-License-Identifier: MIT

   host.h - what the C hosts share beside the waveform of scene.h: checks, times, and a linear
   mapping between interface nodes */
#ifndef HOST_H
#define HOST_H
#include "waveform.h"

#include "../scene.h"

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

/* A window on these times; first guess: constant. */
static inline void begin(waveform *w, int count, const double *t)
{
    good(wf_begin(w->w, 0, count, t, 0));
}

/* Chebyshev-Lobatto times t[0] = a .. t[count-1] = b, to sample a window that is one polynomial. */
static inline void lobatto(double a, double b, int count, double *t)
{
    int j;
    for (j = 0; j < count; j++)
        t[j] = a + (b - a) * (0.5 - 0.5 * cos(acos(-1.0) * j / (count - 1)));
    t[count - 1] = b;
}

/* The other side's field of `from` nodes where this side has its n.  The mapping of these hosts is
   linear interpolation between even nodes on [0, 1]; any other linear one will do. */
static inline void read_mapped(const waveform *w, double t, int derivative, int from, int n,
                               double *out)
{
    double there[16];
    int i, k;
    check(from <= 16, "read_mapped: more than 16 nodes");
    waveform_eval(w, t, derivative, there);
    for (i = 0; i < n; i++) {
        const double s = (double)i * (from - 1) / (n - 1);
        k = s < from - 2 ? (int)s : from - 2;
        out[i] = there[k] + (s - k) * (there[k + 1] - there[k]);
    }
}
#endif
