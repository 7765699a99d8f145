/* SPDX-License-Identifier: MIT

   conservation.c - what one side sends is what the other receives, to round-off, though their sub-steps differ

   A heater gives off the flux q_i(t) = (1 + i/cells) exp(-t) (1 + sin(20 t)) through the cells of an interface and
   writes it at its own sub-steps; a store takes it up in sub-steps of another length.  What has been sent in a window
   is the integral of the waveform.  The store can take

       integral   in every sub-step the integral of the waveform over that sub-step                   wf_mean
       sampling   the flux at the end of every sub-step times its length, as most codes do            wf_read
       project    the rise of the running integral, as a spline on its own, coarser grid              wf_resample
       resample   the integral of the spline through the fluxes at its own times                      wf_resample
       weights    the integrals as one matrix times the samples, as a host would take it whose samples are on a device
                  or spread over processes                                          wf_weights_mean, wf_combine
       basis      the rise of the running integral, from coefficients: for many reads                 wf_fit, wf_eval
       float      the matrix again, for samples in float, each cell's times side by side              a loop of the host

   The imbalance is |received - sent| / sent.  Sampling and resampling are as good as the step is short, float rounds to
   seven digits; all others are zero to round-off for any pair of sub-steps and any degree.  The exact heat is known, so
   the error of what was sent is printed beside them.

   Finite volumes and implicit Euler know no fluxes at a time, only their means over a step.  Such a heater pushes the
   running integral, Q_j = Q_(j-1) + h_j mean_j, and the flux is read with deriv 1.  error_means_as_samples and
   error_running_integral are the largest errors of the flux so read, over the largest flux. */
#define WF_IMPLEMENTATION
#include "waveform.h"
#include "scene.h"

static int checked(int status)
{
    scene_check(status, wf_message(status));
    return status;
}

/* flux through cell 0 at time t, and heat through it until then */
static double flux(double t)
{
    return exp(-t) * (1 + sin(20 * t));
}

static double heat(double t)
{
    return 1 - exp(-t) + (20 - exp(-t) * (sin(20 * t) + 20 * cos(20 * t))) / 401;
}

/* The same in all cells: out = v, 2 v and what lies between. */
static void over_cells(int cells, double v, double *out)
{
    int i;
    for (i = 0; i < cells; i++) out[i] = (1 + 1.0 * i / cells) * v;
}

static double sum(int cells, const double *v)
{
    double s = 0;
    int i;
    for (i = 0; i < cells; i++) s += v[i];
    return s;
}

/* The waveform starts at `start`, and has `steps` even sub-steps until `end`. */
static void window(waveform *w, double start, double end, int steps)
{
    int j;
    if (wf_columns(w->w) == 0) waveform_push(w, start, 0);
    wf_rollback(w->w);
    for (j = 1; j <= steps; j++) waveform_push(w, start + (end - start) * j / steps, 0);
}

/* ---- what the store takes up in a window, all cells together ---- */

static double by_integral(const waveform *from, const waveform *to, double *v, int cells)
{
    double all = 0, a, b;
    int j;
    for (j = 1; j < wf_columns(to->w); j++) {
        a = wf_time(to->w, j - 1), b = wf_time(to->w, j);
        checked(wf_mean(from->w, a, b, v));
        all += (b - a) * sum(cells, v);
    }
    return all;
}

static double by_sampling(const waveform *from, const waveform *to, double *v, int cells)
{
    double all = 0;
    int j;
    for (j = 1; j < wf_columns(to->w); j++) {
        waveform_read(from, wf_time(to->w, j), 0, v);
        all += (wf_time(to->w, j) - wf_time(to->w, j - 1)) * sum(cells, v);
    }
    return all;
}

/* From the running integral: its rise in every sub-step, of coefficients that waveform_fit has made. */
static double by_rise(const waveform *integral, const waveform *to, double *v, int cells)
{
    double all = 0, before = 0, now;
    int j;
    for (j = 0; j < wf_columns(to->w); j++, before = now) {
        waveform_eval(integral, wf_time(to->w, j), 0, v);
        now = sum(cells, v);
        if (j > 0) all += now - before;
    }
    return all;
}

/* Row j of the matrix gives the means over the store's sub-step j. */
static void matrix(const waveform *from, const waveform *to, double *weight)
{
    int j;
    for (j = 1; j < wf_columns(to->w); j++, weight += wf_columns(from->w))
        checked(wf_weights_mean(from->w, wf_time(to->w, j - 1), wf_time(to->w, j), weight));
}

static double by_matrix(const waveform *from, const waveform *to, const double *weight, double *y, int cells)
{
    const int rows = wf_columns(to->w) - 1;
    double all = 0;
    int j;
    checked(wf_combine(rows, wf_columns(from->w), weight, cells, wf_column(from->w, 0), cells, y, cells));
    for (j = 0; j < rows; j++, y += cells) all += (wf_time(to->w, j + 1) - wf_time(to->w, j)) * sum(cells, y);
    return all;
}

/* A host with x[cell][time] in float: its own loop. */
static double by_float(int columns, const waveform *to, const double *weight, const float *x, int cells)
{
    double all = 0;
    int j, i, k;
    for (j = 1; j < wf_columns(to->w); j++, weight += columns)
        for (i = 0; i < cells; i++) {
            float mean = 0;
            for (k = 0; k < columns; k++) mean += (float)weight[k] * x[(ptrdiff_t)i * columns + k];
            all += (wf_time(to->w, j) - wf_time(to->w, j - 1)) * (double)mean;
        }
    return all;
}

/* The largest error of the flux through cell 0, at ten times in every sub-step. */
static double flux_error(const waveform *w, int deriv, double *v)
{
    double worst = 0, t;
    int j, k;
    for (j = 1; j < wf_columns(w->w); j++)
        for (k = 1; k <= 10; k++) {
            t = wf_time(w->w, j - 1) + (wf_time(w->w, j) - wf_time(w->w, j - 1)) * k / 10;
            waveform_read(w, t, deriv, v);
            worst = fmax(worst, fabs(v[0] - flux(t)));
        }
    return worst;
}

int main(int argc, char **argv)
{
    scene_option option[] = {
        {"windows", "10", "time windows in 0 .. 1"},         {"degree", "3", "degree of the waveforms"},
        {"na", "16", "sub-steps of the heater in a window"}, {"nb", "5", "sub-steps of the store in a window"},
        {"cells", "100", "cells of the interface"},          {NULL, NULL, NULL}};
    enum { INTEGRAL, SAMPLING, PROJECT, RESAMPLE, WEIGHTS, BASIS, FLOAT, WAYS };
    static const char *const way[] = {"integral", "sampling", "project", "resample", "weights", "basis", "float"};
    double sent = 0, received[WAYS] = {0}, from_means[2] = {0, 0}, largest = 0, exact, *v, *weight, *y;
    int windows, degree, na, nb, cells, k, j, i;
    waveform a, b, means, running, own; /* fluxes of both sides; means of the heater; running integral; on the store's grid */
    waveform times, *const all[] = {&a, &b, &means, &running, &own, &times}; /* the heater's times without samples */
    float *x;
    scene_parse(argc, argv, "conserve a flux between two sides with different sub-steps", option);
    windows = scene_integer(option, "windows", 1, 100000);
    degree = scene_integer(option, "degree", 1, WF_MAX_DEGREE);
    na = scene_integer(option, "na", 1, 1000);
    nb = scene_integer(option, "nb", 1, 1000);
    cells = scene_integer(option, "cells", 1, 1000000);
    a = waveform_make(degree, cells, na + 1);
    means = waveform_make(degree, cells, na + 1);
    running = waveform_make(degree, cells, na + 1);
    b = waveform_make(degree, cells, nb + 1);
    own = waveform_make(degree, cells, nb + 1);
    times = waveform_make(degree, 0, na + 1);
    v = (double *)scene_memory((size_t)cells * sizeof *v);
    y = (double *)scene_memory((size_t)nb * (size_t)cells * sizeof *y);
    x = (float *)scene_memory((size_t)cells * (size_t)(na + 1) * sizeof *x);
    weight = (double *)scene_memory((size_t)nb * (size_t)(na + 1) * sizeof *weight);
    for (k = 0; k < windows; k++) {
        const double start = 1.0 * k / windows, end = (k + 1.0) / windows;
        for (j = 0; j < 6; j++) window(all[j], start, end, all[j] == &b || all[j] == &own ? nb : na);
        for (j = 0; j <= na; j++) {
            over_cells(cells, flux(wf_time(a.w, j)), wf_column(a.w, j));
            for (i = 0; i < cells; i++) x[(ptrdiff_t)i * (na + 1) + j] = (float)wf_column(a.w, j)[i];
        }
        checked(wf_mean(a.w, start, end, v));
        sent += (end - start) * sum(cells, v);
        received[INTEGRAL] += by_integral(&a, &b, v, cells);
        received[SAMPLING] += by_sampling(&a, &b, v, cells);
        matrix(&times, &b, weight);
        received[WEIGHTS] += by_matrix(&a, &b, weight, y, cells);
        received[FLOAT] += by_float(na + 1, &b, weight, x, cells);
        checked(wf_resample(a.w, b.w));
        checked(wf_mean(b.w, start, end, v));
        received[RESAMPLE] += (end - start) * sum(cells, v);

        over_cells(cells, 0, wf_column(running.w, 0)); /* what has left since the window start */
        for (j = 1; j <= na; j++) {
            double *Q = wf_column(running.w, j);
            checked(wf_mean(a.w, wf_time(a.w, j - 1), wf_time(a.w, j), v));
            for (i = 0; i < cells; i++) Q[i] = Q[i - cells] + (wf_time(a.w, j) - wf_time(a.w, j - 1)) * v[i];
        }
        waveform_fit(&running);
        received[BASIS] += by_rise(&running, &b, v, cells);
        checked(wf_resample(running.w, own.w));
        waveform_fit(&own);
        received[PROJECT] += by_rise(&own, &b, v, cells);

        for (j = 1; j <= na; j++) { /* the heater knows the means over its steps alone */
            const double t = wf_time(a.w, j), before = wf_time(a.w, j - 1), rise = heat(t) - heat(before);
            over_cells(cells, rise / (t - before), wf_column(means.w, j));
            if (j == 1 && k == 0) over_cells(cells, rise / (t - before), wf_column(means.w, 0));
            over_cells(cells, heat(t) - heat(start), wf_column(running.w, j));
            largest = fmax(largest, flux(t));
        }
        from_means[0] = fmax(from_means[0], flux_error(&means, 0, v));
        from_means[1] = fmax(from_means[1], flux_error(&running, 1, v));
        for (j = 0; j < 6; j++) checked(wf_advance(all[j]->w, 0));
    }
    over_cells(cells, heat(1), v);
    exact = sum(cells, v);
    printf("exact %.15g\nsent %.15g\nerror %.3e\n", exact, sent, fabs(sent - exact) / exact);
    for (j = 0; j < WAYS; j++) printf("received_%s %.15g\n", way[j], received[j]);
    for (j = 0; j < WAYS; j++) printf("imbalance_%s %.3e\n", way[j], fabs(received[j] - sent) / sent);
    printf("error_means_as_samples %.3e\nerror_running_integral %.3e\n", from_means[0] / largest, from_means[1] / largest);
    return 0;
}
