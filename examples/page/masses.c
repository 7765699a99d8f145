/* SPDX-License-Identifier: MIT

   masses.c - the two masses of ../oscillator.h for a page (as WebAssembly) and for a terminal

   run() takes the numbers in setting[], couples both solvers over 0 <= t <= 1 and fills lists of numbers: the page draws
   them, main prints them.  Both have the same bits, for nothing but +, -, *, / and sqrt rounds: build it without -ffast-math
   and with -ffp-contract=off.  From a terminal, eleven numbers a line, in the order of the enum below:

       echo 5,5,100,3,1,3,0.5,1e-8,0,0,3 | build/masses */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include "oscillator.h"

/* ---- in: settings; out: lists ---- */

enum { WINDOWS, STEPS_A, STEPS_B, DEGREE, EXCHANGE, METHOD, OMEGA, TOLERANCE, GUESS, OLDER, TABLE, SETTINGS };
enum { ENDS, SAMPLES, SLOPES, MEANS };        /* EXCHANGE: what the partner gets */
enum { NONE, RELAXATION, AITKEN, ILS, IMVJ }; /* METHOD: how the fixed point is found */
static const char *const table_name[] = {"euler", "heun", "kutta3", "rk4", "dp5"};
enum {
    MOST_WINDOWS = 100,
    MOST_STEPS = 100,         /* of a side in a window */
    MOST_ITERATIONS = 100,    /* of a window */
    MOST_EVALUATIONS = 400000 /* of a run: a page answers at once, also where its settings are absurd */
};

/* What is accepted.  GUESS is the degree of the first guess; so many windows are kept for it.  OLDER 1: the spline reads
   them, too.  OMEGA counts for RELAXATION and AITKEN. */
static const struct {
    double least, most;
} range[SETTINGS] = {{1, MOST_WINDOWS}, {1, MOST_STEPS}, {1, MOST_STEPS}, {0, 9},  {ENDS, MEANS}, {NONE, IMVJ},
                     {1e-3, 1},         {1e-14, 1},      {0, 3},          {0, 1}, {0, 4}};

enum {
    NUMBERS,    /* see below */
    CURVE_TIME, /* POINTS times */
    CURVE_A,    /* at these: the waveform that the partner reads */
    CURVE_B,
    EXACT_A, /* at these: the exact solution */
    EXACT_B,
    TIME_A, /* of every sub-step */
    TIME_B,
    U_A, /* after every sub-step: the displacement */
    U_B,
    ERROR_A, /*                    and its error */
    ERROR_B,
    ITERATIONS, /* of every window */
    RESIDUALS,  /* of every iteration */
    LISTS
};
enum { N_ERROR_A, N_ERROR_B, N_ITERATIONS, N_EVALUATIONS, N_UNKNOWNS, N_DEGREE, N_END, N_STATUS, N_COUNT };
/* N_END: 0 solved, 1 a window gave up, 2 MOST_EVALUATIONS.  N_STATUS: of the last step of iqn.h. */

enum { MOST = MOST_WINDOWS * MOST_STEPS, POINTS = 480, POOL = 1 << 17 };
static double setting[SETTINGS], list[LISTS][MOST], pool[POOL];
static int count[LISTS];
static size_t used; /* of pool */
static int fault;   /* the first status < 0 of a run */

/* What a page calls: these four and, for a status < 0, wf_message or iqn_message. */
double *setting_start(void);
double *list_start(int which);
int list_length(int which);
int run(void);

double *setting_start(void)
{
    return setting;
}

double *list_start(int which)
{
    return list[which];
}

int list_length(int which)
{
    return count[which];
}

static void put(int which, double v)
{
    if (count[which] < MOST) list[which][count[which]++] = v;
}

static int ok(int status)
{
    if (status < 0 && !fault) fault = status;
    return status;
}

/* From one array, which every run gives out from its start; the kit refuses NULL. */
static void *memory(size_t bytes)
{
    const size_t doubles = (bytes + sizeof(double) - 1) / sizeof(double);
    void *p = pool + used;
    if (doubles > POOL - used) return NULL;
    used += doubles;
    return p;
}

/* ---- the exact solution ---- */

/* cos 2 pi t by its series: every libm has other last digits. */
static double cosine(double t)
{
    double from = fabs(t - floor(t + 0.5)), sign = 1, c = 1, x;
    int k;
    if (from > 0.25) {
        from = 0.5 - from;
        sign = -1;
    }
    x = 2 * PI * from;
    for (k = 24; k > 0; k -= 2) c = 1 - c * x * x / (k * (k - 1));
    return sign * c;
}

static double exact(int is_b, double t)
{
    const double c = cosine(t), c3 = c * (4 * c * c - 3); /* cos 6 pi t */
    return 0.5 * (is_b ? c - c3 : c + c3);
}

/* ---- a side: it solves a window from its start, as often as it is asked to ---- */

typedef struct side {
    int is_b;
    int steps, samples; /* in a window; samples: that the partner gets */
    mass now, start;
    wf *w;                              /* what the partner gets */
    double *c;                          /* the coefficients of this spline */
    double mean, mean_from;             /* the last mean that was read, and the sub-step that it belongs to */
    double all[MOST_STEPS + 1], error; /* u after every sub-step; the largest error so far */
} side;

static int exchange, per; /* the setting; columns of a sample: 2 with slopes */
static const rk_table *table;

/* How a solver reads its partner: the value at that time, from the coefficients. */
static double read_value(void *other, double t, double h, double at)
{
    const side *s = (const side *)other;
    double u = 0;
    (void)t;
    (void)h;
    ok(wf_eval(s->w, at, 0, s->c, &u));
    return u;
}

/* All stages of a sub-step get the mean over the sub-step. */
static double read_mean(void *other, double t, double h, double at)
{
    side *s = (side *)other;
    (void)at;
    if (s->mean_from != t) ok(wf_mean(s->w, t, t + h, &s->mean));
    s->mean_from = t;
    return s->mean;
}

/* The state now, into a column of what the partner gets. */
static void tell(const side *s, int column)
{
    double *x = wf_column(s->w, column);
    if (!x) return;
    x[0] = s->now.u;
    if (per == 2) x[1] = s->now.v;
}

/* A side at time 0, with u of its own and of the other mass. */
static void make(side *s, int is_b, double u, double u_other)
{
    const int degree = (int)setting[DEGREE], kept = (int)setting[GUESS];
    int columns;
    size_t bytes;
    memset(s, 0, sizeof *s);
    s->is_b = is_b;
    s->now = s->start = mass_at_rest(u, u_other);
    s->steps = (int)setting[is_b ? STEPS_B : STEPS_A];
    s->samples = exchange == ENDS ? 1 : s->steps;
    columns = per * (s->samples * (kept + 1) + 1);
    bytes = wf_size(1, degree, columns);
    s->c = (double *)memory((size_t)columns * sizeof(double));
    if (ok(wf_make(&s->w, 1, degree, columns, memory(bytes), bytes)) < 0) return;
    tell(s, ok(wf_push(s->w, 0, per == 2 ? WF_SLOPE : 0)));
    if (setting[OLDER] == 0) ok(wf_restrict(s->w, degree, 0));
}

/* The times of a window, and a first guess at them. */
static void open_window(side *s, double t0, double t1)
{
    double t[MOST_STEPS];
    int j;
    for (j = 1; j <= s->samples; j++) t[j - 1] = mass_time(t0, t1, j, s->samples);
    ok(wf_begin(s->w, (int)setting[GUESS], s->samples, t, per == 2 ? WF_SLOPE : 0));
}

/* The window from its start, with what the other side tells now. */
static void solve(side *s, double t0, double t1, side *other)
{
    mass_read *const read = exchange == MEANS ? read_mean : read_value;
    const double h = (t1 - t0) / s->steps;
    const int first = wf_start(s->w);
    int j;
    ok(wf_fit(other->w, other->c));
    other->mean_from = -1;
    s->now = s->start;
    for (j = 1; j <= s->steps && !fault; j++) {
        const double t = mass_time(t0, t1, j - 1, s->steps);
        if (s->is_b) mass_generalized_alpha(&s->now, t, h, read, other);
        else mass_runge_kutta(&s->now, t, h, table, read, other);
        s->all[j] = s->now.u;
        if (exchange != ENDS) tell(s, first + per * j);
    }
    if (exchange == ENDS) tell(s, first + per);
}

/* The window is over: what the partner reads, every sub-step with its error; then the next window. */
static void accept(side *s, double t0, double t1, int points)
{
    double t, u;
    int j;
    ok(wf_fit(s->w, s->c));
    for (j = t0 > 0 ? 1 : 0; j <= points; j++) {
        t = mass_time(t0, t1, j, points);
        u = 0;
        ok(wf_eval(s->w, t, 0, s->c, &u));
        if (!s->is_b) put(CURVE_TIME, t);
        put(CURVE_A + s->is_b, u);
        put(EXACT_A + s->is_b, exact(s->is_b, t));
    }
    for (j = 1; j <= s->steps; j++) {
        t = mass_time(t0, t1, j, s->steps);
        u = fabs(s->all[j] - exact(s->is_b, t));
        if (!(u <= s->error)) s->error = u;
        put(TIME_A + s->is_b, t);
        put(U_A + s->is_b, s->all[j]);
        put(ERROR_A + s->is_b, u);
    }
    ok(wf_advance(s->w, (int)setting[GUESS] * s->samples));
    s->start = s->now;
}

/* ---- the run ---- */

/* Is a setting out of its range? */
static int refused(void)
{
    int i;
    for (i = 0; i < SETTINGS; i++) {
        const double v = setting[i];
        if (!(v >= range[i].least && v <= range[i].most)) return 1;
        if (i != OMEGA && i != TOLERANCE && v != floor(v)) return 1;
    }
    return 0;
}

/* For n unknowns, as set; 20 columns. */
static iqn *make_iqn(int n)
{
    static const int methods[] = {IQN_CONSTANT, IQN_CONSTANT, IQN_AITKEN, IQN_ILS, IQN_IMVJ};
    const int method = (int)setting[METHOD];
    const size_t bytes = iqn_size(n, 20, 1);
    iqn *q = NULL;
    if (ok(iqn_make(&q, n, 20, 1, memory(bytes), bytes)) < 0) return NULL;
    ok(iqn_set(q, IQN_METHOD, methods[method]));
    ok(iqn_set(q, IQN_TOL_ABSOLUTE, setting[TOLERANCE]));
    ok(iqn_set(q, IQN_MAX_ITERATIONS, MOST_ITERATIONS));
    if (method == NONE) ok(iqn_set(q, IQN_OMEGA, 1));
    if (method == RELAXATION || method == AITKEN) ok(iqn_set(q, IQN_OMEGA, setting[OMEGA]));
    return q;
}

static side A, B;

/* A window: both solvers in turn until their data agree.  1: they do, 2: given up, 0: MOST_EVALUATIONS, or a fault. */
static int solve_window(iqn *q, int n, double *x, double t0, double t1)
{
    const int evaluations = A.steps * table->stages + B.steps; /* in an iteration: right-hand sides of A, solves of B */
    double *number = list[NUMBERS], *hx = wf_column(B.w, wf_start(B.w) + per);
    int k, end = 0;
    for (k = 0; end == 0 && !fault; k++) {
        if (number[N_EVALUATIONS] + evaluations > MOST_EVALUATIONS) break;
        memcpy(x, hx, (size_t)n * sizeof(double));
        solve(&A, t0, t1, &B); /* reads x */
        solve(&B, t0, t1, &A); /* writes hx = H(x) */
        number[N_EVALUATIONS] += evaluations;
        number[N_STATUS] = ok(iqn_step(q, x, hx));
        end = iqn_converged(q);
        put(RESIDUALS, iqn_get(q, IQN_RESIDUAL));
        if (end == 0) memcpy(hx, x, (size_t)n * sizeof(double));
    }
    put(ITERATIONS, k);
    number[N_ITERATIONS] += k;
    return end;
}

/* All lists empty, but for zeros in NUMBERS; all memory free. */
static void begin(void)
{
    int i;
    for (i = 0; i < LISTS; i++) count[i] = 0;
    for (i = 0; i < N_COUNT; i++) put(NUMBERS, 0);
    used = 0;
    fault = 0;
}

/* 0, or the first status < 0; the lists hold what there is. */
int run(void)
{
    double *number = list[NUMBERS], *x, t0, t1;
    int windows, window, n, end = 1;
    iqn *q;
    begin();
    if (refused()) return WF_EARG;
    windows = (int)setting[WINDOWS];
    exchange = (int)setting[EXCHANGE];
    per = exchange == SLOPES ? 2 : 1;
    if (per == 2) setting[DEGREE] = fmax(2, setting[DEGREE]); /* a slope wants a parabola */
    table = rk_find(table_name[(int)setting[TABLE]]);
    make(&A, 0, 1, 0);
    make(&B, 1, 0, 1);
    n = B.samples * per; /* the unknown: what B tells in a window, which A reads first */
    x = (double *)memory((size_t)n * sizeof(double));
    q = make_iqn(n);

    for (window = 0; window < windows && end == 1 && !fault; window++) {
        t0 = (double)window / windows;
        t1 = (window + 1.0) / windows;
        open_window(&A, t0, t1);
        open_window(&B, t0, t1);
        end = solve_window(q, n, x, t0, t1);
        number[N_DEGREE] = fmax(wf_degree(A.w), wf_degree(B.w));
        accept(&A, t0, t1, POINTS / windows);
        accept(&B, t0, t1, POINTS / windows);
        ok(iqn_commit(q));
    }
    if (end == 2) number[N_END] = 1;
    if (end == 0) number[N_END] = 2;
    number[N_ERROR_A] = A.error;
    number[N_ERROR_B] = B.error;
    number[N_UNKNOWNS] = n;
    return fault;
}

#ifndef __wasm__
#  include <stdio.h>

/* In: lines of eleven numbers.  Out, for each: the status, and every list, a line each. */
int main(void)
{
    int i = 0, j;
    while (scanf("%lf,", &setting[i]) == 1) {
        if (++i < SETTINGS) continue;
        printf("%d\n", run());
        for (i = 0; i < LISTS; i++) {
            for (j = 0; j < count[i]; j++) printf("%.17g ", list[i][j]);
            puts("");
        }
        i = 0;
    }
    return 0;
}
#endif
