/* SPDX-License-Identifier: MIT

   windows.c - windows of any length: equal, growing, from a list, cut at events

   Two media in one tube of 20 cells, u' = D Lu + K (w - u) + q(t) s, w' = d Lw + K (u - w), L the difference of neighbours,
   zero at both ends; the source q is on until an event, off until the next one, and so on.  Each medium is a solver (rk4, 8
   and 5 sub-steps of every window, cubic waveforms).  The windows

       equal      all of the length --longest
       growing    from --shortest on each --factor times as long as the one before, up to --longest: logarithmic in time
       list       the lengths of --list, one after the other, again and again

   end at an event all the same, so that a window may be as short as chance wants it.  Secant pairs of windows of other lengths
   are kept; `anew` is the same run without them (iqn_discard).  Exact: mode by mode, exp(Mt) of 2 by 2 matrices. */
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"
#include "scene.h"

enum { CELLS = 20, SUB_U = 8, SUB_W = 5, MODES = 3, MOST = 32 };
static const int mode_of[MODES] = {1, 3, 8};
static const double PI = 3.14159265358979323846, D = 1, d = 0.2;

static double exchange; /* K */
static int source;      /* q: 1 or 0 */

static int checked(int status, const char *message)
{
    scene_check(status, message);
    return status;
}

/* ---- the two solvers ---- */

static double shape(int mode, int cell)
{
    return sin(PI * mode * (cell + 1) / (CELLS + 1));
}

/* k = dy/dt in all cells. */
static void slope(double conduct, int heated, const double *y, const double *other, double *k)
{
    int i;
    for (i = 0; i < CELLS; i++) {
        const double left = i > 0 ? y[i - 1] : 0, right = i < CELLS - 1 ? y[i + 1] : 0;
        k[i] = conduct * (left - 2 * y[i] + right) + exchange * (other[i] - y[i]);
        if (heated) k[i] += shape(1, i);
    }
}

/* One medium over the window: reads the other one, writes its own columns. */
static void solve(double conduct, int heated, wf *own, wf *other)
{
    const rk_table *T = rk_find("rk4");
    double k[4 * CELLS], z[CELLS], v[CELLS], t, h;
    int i, j;
    for (j = wf_start(own) + 1; j < wf_columns(own); j++) {
        t = wf_time(own, j - 1);
        h = wf_time(own, j) - t;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, CELLS, wf_column(own, j - 1), k, CELLS, z);
            checked(wf_read(other, t + T->c[i] * h, 0, v), "wf_read");
            slope(conduct, heated, z, v, k + i * CELLS);
        }
        rk_finish(T, h, CELLS, wf_column(own, j - 1), k, CELLS, wf_column(own, j), NULL);
    }
}

/* ---- the exact solution ---- */

/* One mode, y = (u, w), over h: y' = M y + g has y + M^-1 g = exp(Mh) (y_0 + M^-1 g). */
static void exact_mode(int mode, double h, double y[2])
{
    const double lambda = 2 - 2 * cos(PI * mode / (CELLS + 1)), K = exchange;
    const double M[4] = {-D * lambda - K, K, K, -d * lambda - K}, g = source && mode == 1;
    const double mean = (M[0] + M[3]) / 2, det = M[0] * M[3] - M[1] * M[2], root = sqrt(mean * mean - det);
    const double rest[2] = {M[3] * g / det, -M[2] * g / det}; /* M^-1 g */
    const double a = exp(mean * h) * cosh(root * h), b = exp(mean * h) * sinh(root * h) / root;
    const double u = y[0] + rest[0], w = y[1] + rest[1];
    y[0] = a * u + b * ((M[0] - mean) * u + M[1] * w) - rest[0];
    y[1] = a * w + b * (M[2] * u + (M[3] - mean) * w) - rest[1];
}

/* The largest error of both media. */
static double error_of(const double *u, const double *w, double exact[MODES][2])
{
    double worst = 0, e[2];
    int i, m;
    for (i = 0; i < CELLS; i++) {
        for (e[0] = u[i], e[1] = w[i], m = 0; m < MODES; m++) {
            e[0] -= exact[m][0] * shape(mode_of[m], i);
            e[1] -= exact[m][1] * shape(mode_of[m], i);
        }
        worst = fmax(worst, fmax(fabs(e[0]), fabs(e[1])));
    }
    return worst;
}

/* ---- the windows ---- */

typedef struct plan {
    double list[MOST], longest, factor; /* the first lengths; then each is so many times the one before, */
    int count, again;                   /* or the list again */
    double end, event[MOST];
    int events;
} plan;

static double length_of(const plan *p, int window, double before)
{
    if (window < p->count) return p->list[window];
    return p->again ? p->list[window % p->count] : fmin(p->longest, before * p->factor);
}

/* The next window's end: of its own length or at the next event, to the bit, with no sliver of a window before it. */
static double end_of(const plan *p, int next, double t0, double length)
{
    const double stop = next < p->events ? p->event[next] : p->end;
    return t0 + length > stop - 0.01 * length ? stop : t0 + length;
}

/* `count` equal steps from t0 to t1 and a first guess of degree 1. */
static void begin(const waveform *w, int count, double t0, double t1)
{
    double t[SUB_U];
    int i;
    for (i = 1; i < count; i++) t[i - 1] = t0 + (t1 - t0) * i / count;
    t[count - 1] = t1;
    checked(wf_begin(w->w, 1, count, t, 0), "wf_begin");
}

typedef struct media {
    waveform u, w, hw; /* hw: what w would be */
    double exact[MODES][2];
} media;

static void start(media *m)
{
    double *x;
    int i, k;
    m->u = waveform_make(3, CELLS, 2 * SUB_U + 1);
    m->w = waveform_make(3, CELLS, 2 * SUB_W + 1);
    m->hw = waveform_make(3, CELLS, 2 * SUB_W + 1);
    wf_restrict(m->u.w, 3, 0); /* older samples for the guess, not for the spline: events are kinks */
    wf_restrict(m->w.w, 3, 0);
    x = waveform_push(&m->u, 0, 0);
    for (i = 0; i < CELLS; i++)
        for (k = 0; k < MODES; k++) x[i] += shape(mode_of[k], i);
    waveform_push(&m->w, 0, 0);
    for (k = 0; k < MODES; k++) {
        m->exact[k][0] = 1;
        m->exact[k][1] = 0;
    }
}

/* One window: the iterations until the media agree; the error at its end. */
static int window(media *m, iqn *q, double t0, double t1, double *error)
{
    double *x, *hx;
    int k;
    begin(&m->u, SUB_U, t0, t1);
    begin(&m->w, SUB_W, t0, t1);
    checked(wf_copy(m->hw.w, m->w.w), "wf_copy");
    x = waveform_window(&m->w);
    hx = waveform_window(&m->hw);
    do {
        solve(D, source, m->u.w, m->w.w);
        solve(d, 0, m->hw.w, m->u.w);
        checked(iqn_step(q, x, hx), "iqn_step");
    } while (!iqn_converged(q));
    for (k = 0; k < MODES; k++) exact_mode(mode_of[k], t1 - t0, m->exact[k]);
    *error = error_of(wf_column(m->u.w, wf_columns(m->u.w) - 1), wf_column(m->w.w, wf_columns(m->w.w) - 1), m->exact);
    checked(wf_advance(m->u.w, SUB_U), "wf_advance");
    checked(wf_advance(m->w.w, SUB_W), "wf_advance");
    return (int)iqn_get(q, IQN_ITERATIONS);
}

/* The run from 0 to the end.  count: windows, those that did not converge, iterations of all. */
static double run(const plan *p, double tol, int reuse, int keep, int count[3])
{
    const size_t bytes = iqn_size(SUB_W * CELLS, 40, 1);
    double t0 = 0, t1, length = 0, error, worst = 0;
    int next = 0;
    media m;
    iqn *q;
    checked(iqn_make(&q, SUB_W * CELLS, 40, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set(q, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_WINDOWS, reuse);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    start(&m);
    count[0] = count[1] = count[2] = 0;
    for (source = 1; t0 < p->end; t0 = t1) {
        length = length_of(p, count[0], length);
        t1 = end_of(p, next, t0, length);
        count[2] += window(&m, q, t0, t1, &error);
        count[1] += iqn_converged(q) != 1;
        count[0]++;
        if (keep) iqn_commit(q);
        else iqn_discard(q);
        worst = fmax(worst, error);
        if (next < p->events && t1 >= p->event[next]) {
            next++;
            source = !source;
        }
    }
    waveform_free(&m.u);
    waveform_free(&m.w);
    waveform_free(&m.hw);
    free(q);
    return worst;
}

/* Increasing numbers with commas in between, in (0, high); nothing: none. */
static int numbers(const scene_option *o, const char *key, double high, double *to)
{
    const char *text = scene_text(o, key);
    int n = 0, length;
    while (*text) {
        if (n == MOST || sscanf(text, "%lf%n", &to[n], &length) != 1 || !(to[n] > 0 && to[n] < high)) {
            fprintf(stderr, "--%s takes up to %d numbers above 0 and below %g, with commas, not '%s'\n", key, MOST,
                    high, scene_text(o, key));
            exit(2);
        }
        n++;
        text += length;
        text += *text == ',';
    }
    return n;
}

int main(int argc, char **argv)
{
    static const char *const kinds[] = {"equal", "growing", "list", NULL};
    enum { EQUAL, GROWING, LIST };
    scene_option o[] = {{"windows", "equal", "equal, growing or list"},
                        {"longest", "0.2", "length of the equal windows, and of the longest of the growing ones"},
                        {"shortest", "0.002", "length of the first of the growing windows"},
                        {"factor", "1.2", "of the growing windows"},
                        {"list", "0.1,0.05,0.3,0.01,0.2", "lengths of windows"},
                        {"events", "", "increasing times at which the source is switched"},
                        {"exchange", "8", "between the media"},
                        {"end", "4", "end of the time"},
                        {"tol", "1e-8", "relative limit"},
                        {"reuse", "-1", "past windows whose pairs are kept (IQN_WINDOWS); -1: all"},
                        {NULL, NULL, NULL}};
    plan p;
    double tol, error;
    int kept[3], anew[3], kind, reuse, i;
    scene_parse(argc, argv, "two media in windows of any length", o);
    kind = scene_choice(o, "windows", kinds);
    p.end = scene_number(o, "end", 1e-3, 1e3);
    p.longest = scene_number(o, "longest", 1e-6, 10);
    p.factor = scene_number(o, "factor", 1, 1e3);
    p.again = kind == LIST;
    p.count = kind == LIST ? numbers(o, "list", 10, p.list) : 1;
    if (kind == EQUAL) p.list[0] = p.longest;
    if (kind == GROWING) p.list[0] = scene_number(o, "shortest", 1e-9, 10);
    p.events = numbers(o, "events", p.end, p.event);
    for (i = 1; i < p.events; i++)
        if (!(p.event[i] > p.event[i - 1])) p.count = 0;
    if (p.count == 0) {
        fprintf(stderr, "--list takes a length at least, --events takes increasing times\n");
        return 2;
    }
    exchange = scene_perturbed("exchange", scene_number(o, "exchange", 0, 50));
    tol = scene_number(o, "tol", 1e-13, 1);
    reuse = scene_integer(o, "reuse", -1, 1000);
    run(&p, tol, reuse, 0, anew);
    error = run(&p, tol, reuse, 1, kept);
    printf("windows %d\nunconverged %d\niterations %.2f\n", kept[0], kept[1], (double)kept[2] / kept[0]);
    printf("anew_unconverged %d\nanew_iterations %.2f\nerror %.3e\n", anew[1], (double)anew[2] / anew[0], error);
    return 0;
}
