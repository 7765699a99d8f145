/* SPDX-License-Identifier: MIT

   conservation.c - what one side sends is what the other receives, to round-off, though their sub-steps differ

   A heater gives off the flux q_i(t) = (1 + i/cells) exp(-t) (1 + sin(20 t)) through the cells of an interface and
   writes it at its own sub-steps; a store takes it up in sub-steps of another length.  What has been sent in a window
   is the integral of the waveform.  The store can take

       integral   in every sub-step the integral of the waveform over that sub-step             wf_eval_mean
       sampling   the flux at the end of every sub-step times its length, as most codes do       wf_eval
       project    the integral of the nearest spline on its own, coarser grid                    wf_project
       resample   the integral of the spline through the values at its own times                 wf_resample
       weights    the integrals as one matrix times the samples, as a host would take it whose samples
                  are on a device or spread over processes                          wf_weights_mean, wf_combine
       basis      the same matrix for its coefficients                              wf_basis_mean, wf_combine

   The imbalance is |received - sent| / sent.  Sampling and resampling are as good as the step is short; all others are
   zero to round-off for any pair of sub-steps and any degree.  The exact heat is known, so the error of what was sent is
   printed beside them. */
#define WF_IMPLEMENTATION
#include "waveform.h"
#include "scene.h"

static int checked(int status)
{
    scene_check(status, wf_message(status));
    return status;
}

static wf *grid(int degree, int columns)
{
    wf *w = NULL;
    size_t bytes = wf_size(degree, columns);
    checked(wf_make(&w, degree, columns, scene_memory(bytes), bytes));
    return w;
}

static double *columns(int count, int cells)
{
    return (double *)scene_memory((size_t)count * (size_t)cells * sizeof(double));
}

/* heat through cell 0 until time t */
static double heat(double t)
{
    return 1 - exp(-t) + (20 - exp(-t) * (sin(20 * t) + 20 * cos(20 * t))) / 401;
}

static double sum(int cells, const double *v)
{
    double s = 0;
    int i;
    for (i = 0; i < cells; i++) s += v[i];
    return s;
}

static int integral(const wf *w, double a, double b, int n, const double *c, int ldc, double *out)
{
    int status = wf_eval_mean(w, a, b, n, c, ldc, out), i;
    for (i = 0; i < n; i++) out[i] *= b - a;
    return status;
}

/* What the store takes up in a window if row j of the matrix gives the means over its sub-step j. */
static double matrix(int (*mean)(const wf *, double, double, double *), const wf *from, const wf *to, int n, const double *x,
                     double *weight, double *y)
{
    const int rows = wf_columns(to) - 1, length = wf_columns(from);
    double all = 0;
    int j;
    for (j = 0; j < rows; j++) checked(mean(from, wf_time(to, j), wf_time(to, j + 1), weight + (ptrdiff_t)j * length));
    checked(wf_combine(rows, length, weight, n, x, n, y, n));
    for (j = 0; j < rows; j++) all += (wf_time(to, j + 1) - wf_time(to, j)) * sum(n, y + (ptrdiff_t)j * n);
    return all;
}

int main(int argc, char **argv)
{
    scene_option option[] = {
        {"windows", "10", "time windows in 0 .. 1"},         {"degree", "3", "degree of the waveforms"},
        {"na", "16", "sub-steps of the heater in a window"}, {"nb", "5", "sub-steps of the store in a window"},
        {"cells", "100", "cells of the interface"},          {NULL, NULL, NULL}};
    static const char *const way[] = {"integral", "sampling", "project", "resample", "weights", "basis"};
    double sent = 0, received[6] = {0, 0, 0, 0, 0, 0}, exact;
    double *x, *c, *y, *d, *v, *weight, *work;
    int windows, degree, na, nb, cells, k, j, i;
    wf *a, *b;
    scene_parse(argc, argv, "conserve a flux between two sides with different sub-steps", option);
    windows = scene_integer(option, "windows", 1, 100000);
    degree = scene_integer(option, "degree", 1, WF_MAX_DEGREE);
    na = scene_integer(option, "na", 1, 1000);
    nb = scene_integer(option, "nb", 1, 1000);
    cells = scene_integer(option, "cells", 1, 1000000);
    a = grid(degree, na + 1);
    b = grid(degree, nb + 1);
    x = columns(na + 1, cells);
    c = columns(na + 1, cells);
    y = columns(nb + 1, cells);
    d = columns(nb + 1, cells);
    v = columns(1, cells);
    weight = columns(nb + 1, na + 1);
    work = columns(nb + 1, degree + 1);
    for (k = 0; k < windows; k++) {
        double start = 1.0 * k / windows, end = (k + 1.0) / windows, t = start, next;
        checked(wf_push(a, start));
        checked(wf_push(b, start));
        for (j = 1; j <= na; j++) checked(wf_push(a, start + (end - start) * j / na));
        for (j = 1; j <= nb; j++) checked(wf_push(b, start + (end - start) * j / nb));
        for (j = 0; j <= na; j++) { /* the heater writes */
            t = wf_time(a, j);
            for (i = 0; i < cells; i++)
                x[(ptrdiff_t)j * cells + i] = (1 + 1.0 * i / cells) * exp(-t) * (1 + sin(20 * t));
        }
        checked(wf_fit(a, cells, x, cells, c, cells));
        checked(integral(a, start, end, cells, c, cells, v));
        sent += sum(cells, v);
        for (j = 0; j < nb; j++) { /* the store takes up */
            t = wf_time(b, j);
            next = wf_time(b, j + 1);
            checked(integral(a, t, next, cells, c, cells, v));
            received[0] += sum(cells, v);
            checked(wf_eval(a, next, 0, cells, c, cells, v));
            received[1] += (next - t) * sum(cells, v);
        }
        received[4] += matrix(wf_weights_mean, a, b, cells, x, weight, y);
        received[5] += matrix(wf_basis_mean, a, b, cells, c, weight, y);
        checked(wf_project(a, b, weight, work));
        checked(wf_combine(nb + 1, na + 1, weight, cells, x, cells, y, cells));
        checked(wf_fit(b, cells, y, cells, d, cells));
        checked(integral(b, start, end, cells, d, cells, v));
        received[2] += sum(cells, v);
        checked(wf_resample(a, b, cells, x, cells, y, cells));
        checked(wf_fit(b, cells, y, cells, d, cells));
        checked(integral(b, start, end, cells, d, cells, v));
        received[3] += sum(cells, v);
        checked(wf_advance(a, 0, 0, NULL, 0));
        checked(wf_advance(b, 0, 0, NULL, 0));
    }
    for (exact = 0, i = 0; i < cells; i++) exact += (1 + 1.0 * i / cells) * heat(1);
    printf("exact %.15g\nsent %.15g\nerror %.3e\n", exact, sent, fabs(sent - exact) / exact);
    for (j = 0; j < 6; j++) printf("received_%s %.15g\n", way[j], received[j]);
    for (j = 0; j < 6; j++) printf("imbalance_%s %.3e\n", way[j], fabs(received[j] - sent) / sent);
    return 0;
}
