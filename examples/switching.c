/* SPDX-License-Identifier: MIT

   switching.c - a switched circuit: two solvers, order 4 across ten events

       tau q' = E s(t) - q - a tau i,    u = q + g E s(t)     side A: a capacitor behind a switch gives the voltage u
       L i'   = u - R i                                       side B: a coil takes it and gives the current i

   The switch s goes on and off at ten known times that are no window ends.  There u jumps and i has a kink.  Each side
   takes equal Runge-Kutta 4 steps between two events, reads the other's waveform, and both repeat a window until it
   stands still.  With --breaks 1 every event is stored twice, value before and value behind (wf_push_break), and each
   piece is a spline of its own; with 0 it is one more sample.  Exact: the matrix exponential from event to event. */
#define WF_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "rk.h"
#include "scene.h"

enum { EVENTS = 10, PIECES = EVENTS + 2 };

static const double TAU = 0.5, A = 1, E = 1, G = 0.5, R = 1, L = 0.4, END = 3;

static double event(int k) /* the k-th, k = 1 .. EVENTS */
{
    return 0.29 * k - 0.07 * (k % 3) + 0.003 * k * k / 10;
}

static double source(int events_before) /* voltage while so many events lie behind */
{
    return events_before % 2 ? E : 0;
}

/* ---- the exact solution ---- */

/* (q, i) after time t with the source constant: x + exp(M t) (y - x), M x + b = 0 */
static void exact_piece(double t, double e, double *y)
{
    const double m[4] = {-1 / TAU, -A, 1 / L, -R / L}, mean = (m[0] + m[3]) / 2, det = m[0] * m[3] - m[1] * m[2];
    const double b[2] = {e / TAU, G * e / L}, w = sqrt(det - mean * mean); /* the circuit swings: det > mean^2 */
    const double x[2] = {-(m[3] * b[0] - m[1] * b[1]) / det, -(m[0] * b[1] - m[2] * b[0]) / det};
    const double d[2] = {y[0] - x[0], y[1] - x[1]}, c = cos(w * t), s = sin(w * t) / w;
    y[0] = x[0] + exp(mean * t) * (c * d[0] + s * ((m[0] - mean) * d[0] + m[1] * d[1]));
    y[1] = x[1] + exp(mean * t) * (c * d[1] + s * (m[2] * d[0] + (m[3] - mean) * d[1]));
}

static void exact(double t, double *y)
{
    double from = 0;
    int k;
    y[0] = 0.3;
    y[1] = 0.1;
    for (k = 1; k <= EVENTS && event(k) < t; k++) {
        exact_piece(event(k) - from, source(k - 1), y);
        from = event(k);
    }
    exact_piece(t - from, source(k - 1), y);
}

/* ---- a side: state, waveform of its output ---- */

typedef struct side {
    int is_coil;
    double start, now; /* q or i at the window start, and while it steps */
    waveform out;      /* of u or i */
} side;

static void checked(int status)
{
    scene_check(status, wf_message(status));
}

static double output(const side *s, double e)
{
    return s->is_coil ? s->now : s->now + G * e;
}

static double rate(const side *s, double y, double e, double read)
{
    return s->is_coil ? (read - R * y) / L : (e - y) / TAU - A * read;
}

/* The other side's output at t in a piece that began at `from`: behind an event the value behind it is meant. */
static double read_at(const side *other, double t, double from)
{
    double v = 0;
    waveform_eval(&other->out, t, t > from ? 0 : WF_BEHIND, &v);
    return v;
}

static void write(side *s, double t, double e, int behind)
{
    *(behind ? waveform_push_break(&s->out, t) : waveform_push(&s->out, t)) = output(s, e);
}

/* Runge-Kutta 4 from `from` to `to` in `steps` steps. */
static void solve_piece(side *s, const side *other, double from, double to, int steps, double e)
{
    const rk_table *T = rk_find("rk4");
    const double h = (to - from) / steps;
    double k[4], z;
    int j, i;
    for (j = 0; j < steps; j++) {
        const double t = from + j * h, end = j < steps - 1 ? from + (j + 1) * h : to;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 1, &s->now, k, 1, &z);
            k[i] = rate(s, z, e, read_at(other, i < 3 ? t + T->c[i] * h : end, from));
        }
        rk_finish(T, h, 1, &s->now, k, 1, &s->now, NULL);
        write(s, end, e, 0);
    }
}

/* A window: pieces between its start, the events inside and its end. */
typedef struct window {
    int pieces, events; /* events before its start */
    double t[PIECES + 1];
} window;

static window window_of(double from, double to)
{
    window w;
    int k;
    w.pieces = 0;
    w.events = 0;
    w.t[0] = from;
    for (k = 1; k <= EVENTS; k++) {
        if (event(k) <= from) w.events = k;
        else if (event(k) < to) w.t[++w.pieces] = event(k);
    }
    w.t[++w.pieces] = to;
    return w;
}

static void solve(side *s, const side *other, const window *w, int steps, int breaks)
{
    int p;
    checked(wf_rollback(s->out.grid));
    s->now = s->start;
    for (p = 0; p < w->pieces; p++) {
        const double e = source(w->events + p);
        if (p > 0 && breaks) write(s, w->t[p], e, 1);
        solve_piece(s, other, w->t[p], w->t[p + 1], steps, e);
    }
    waveform_fit(&s->out);
}

/* A first guess: the last value at all sub-steps. */
static void guess(side *s, const window *w, int steps, double *t)
{
    int p, j;
    for (p = 0; p < w->pieces; p++)
        for (j = 0; j < steps; j++) t[p * steps + j] = w->t[p] + (w->t[p + 1] - w->t[p]) * (j + 1) / steps;
    checked(wf_begin(s->out.grid, 0, w->pieces * steps, t, 1, s->out.x, 1));
    waveform_fit(&s->out);
}

static side side_make(int is_coil, int degree, int columns)
{
    side s;
    double y[2];
    exact(0, y);
    s.is_coil = is_coil;
    s.start = s.now = y[is_coil];
    s.out = waveform_make(degree, 1, columns);
    checked(wf_set(s.out.grid, WF_STRICT, 1));
    write(&s, 0, source(0), 0);
    return s;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"substeps", "4", "steps of each side between two events"},
                        {"windows", "12", "windows in [0, 3]"},
                        {"degree", "3", "of the waveforms"},
                        {"breaks", "1", "0: an event is one more sample"},
                        {"tol", "1e-12", "of the change of the current in an iteration"},
                        {NULL, NULL, NULL}};
    double error[2] = {0, 0}, y[2], last, change, *t;
    int steps, windows, degree, breaks, win, j, total = 0;
    double tol;
    side capacitor, coil;

    scene_parse(argc, argv, "a switched circuit: two solvers, order 4 across ten events", o);
    steps = scene_integer(o, "substeps", 1, 1000);
    windows = scene_integer(o, "windows", 1, 1000);
    degree = scene_integer(o, "degree", 1, WF_MAX_DEGREE);
    breaks = scene_integer(o, "breaks", 0, 1);
    tol = scene_number(o, "tol", 1e-15, 1);
    capacitor = side_make(0, degree, PIECES * (steps + 2));
    coil = side_make(1, degree, PIECES * (steps + 2));
    t = (double *)scene_memory((size_t)(PIECES * steps) * sizeof(double));
    for (win = 0; win < windows; win++) {
        const double from = END * win / windows, to = END * (win + 1) / windows;
        const window w = window_of(from, to);
        guess(&coil, &w, steps, t);
        change = 1;
        for (j = 0; change > tol && j < 50; j++) {
            last = coil.now;
            solve(&capacitor, &coil, &w, steps, breaks);
            solve(&coil, &capacitor, &w, steps, breaks);
            change = fabs(coil.now - last);
            total++;
        }
        exact(to, y);
        if (fabs(capacitor.now - y[0]) > error[0]) error[0] = fabs(capacitor.now - y[0]);
        if (fabs(coil.now - y[1]) > error[1]) error[1] = fabs(coil.now - y[1]);
        capacitor.start = capacitor.now;
        coil.start = coil.now;
        waveform_advance(&capacitor.out, degree - 1);
        waveform_advance(&coil.out, degree - 1);
    }
    printf("events %d\niterations %d\nerror_q %.6e\nerror_i %.6e\n", EVENTS, total, error[0], error[1]);
    return 0;
}
