/* SPDX-License-Identifier: MIT

   rates.c - two or three rates by recursion: any coupling, made from any table, relaxed; runs that take one tolerance.

   y' = f_0 + f_1 (+ f_2), slowest first, each with a step of its own.  One coupling splits the slow part off and leaves

      v' = f_1 + f_2 + g_0(t),   g_0(t) = sum_p tau^p F_p

   between two of its stages.  That is the same problem once more: f_1 + g_0 is the slow part, f_2 the fast one.  So the
   forcing of a forcing needs nothing new: a slow slope of the inner coupling is k_j = f_1(T_j, z_j) + g_0(T_j), the inner
   forcing g_1 is made of those, and below the last coupling a Runge-Kutta table solves v' = f_2 + g_1(t).  Each level
   keeps a handful of vectors: stages, slopes, and the F_p of one stage.

   Problems: kpr (ARKODE's, w = 1:scale), kpr3 (nested, 1 : scale : scale^2), both with exact solution; brusselator (48
   unknowns, slow advection and diffusion, fast reactions; reference from another program); exchange (a slow species and
   two fast ones; no part keeps the mass, their sum does); springs (a pendulum and a fast spring, neither damped) and
   falling (the same from near the top: errors grow).

   With --tolerance H and the fast steps follow from one number.  Neither the embedded difference e of a step nor the sum s
   of the errors of its fast steps is the error that the step adds, so both are measured, now and then, by steps of half
   the size and by a better fast solver: K e and Kf s are shares of what the step may add, H/T of the tolerance.  Implicit
   couplings solve with LAPACK; IMEX ones take a part of the slow part as implicit.  */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

enum { PARTS = 3, CELLS = 16, MOST = PARTS * RK_STAGES_MAX };

void dgetrf_(const int *, const int *, double *, const int *, int *, int *);
void dgetrs_(const char *, const int *, const int *, const double *, const int *, const int *, double *, const int *, int *);

/* ---- problems: part p of y' = f_0 + f_1 + ... -------------------------------------------------------------------- */

static double G, e,
    scale; /* stiffness and coupling of the KPR problems; how many times as fast a part is as the one before */
static long evaluations[PARTS];

static void kpr(int p, double t, const double *y, double *f)
{
    const double a = (y[0] * y[0] - 1 - cos(t) / 2) / (2 * y[0]);
    const double b = (y[1] * y[1] - 2 - cos(scale * t)) / (2 * y[1]);
    f[0] = f[1] = 0;
    if (p == 0) f[0] = G * a + e * b - sin(t) / (4 * y[0]);
    else f[1] = e * a - b - scale * sin(scale * t) / (2 * sqrt(2 + cos(scale * t)));
}

static void kpr_exact(double t, double *y)
{
    y[0] = sqrt(1 + cos(t) / 2);
    y[1] = sqrt(2 + cos(scale * t));
}

/* The stiff term */
static void kpr_implicit(double t, const double *y, double *f)
{
    f[0] = G * (y[0] * y[0] - 1 - cos(t) / 2) / (2 * y[0]);
    f[1] = 0;
}

static void kpr3(int p, double t, const double *y, double *f)
{
    const double w = scale, x = scale * scale;
    const double a = (y[0] * y[0] - 2 - cos(t) / 2) / (2 * y[0]);
    const double b = (y[1] * y[1] - 2 - cos(w * t)) / (2 * y[1]);
    const double c = (y[2] * y[2] - 2 - cos(x * t)) / (2 * y[2]);
    f[0] = f[1] = f[2] = 0;
    if (p == 0) f[0] = G * a + e * b + e * c - sin(t) / (4 * y[0]);
    if (p == 1) f[1] = e * a - b + c - w * sin(w * t) / (2 * y[1]);
    if (p == 2) f[2] = e * a - b - c - x * sin(x * t) / (2 * y[2]);
}

static void kpr3_exact(double t, double *y)
{
    y[0] = sqrt(2 + cos(t) / 2);
    y[1] = sqrt(2 + cos(scale * t));
    y[2] = sqrt(2 + cos(scale * scale * t));
}

/* Advection to the right and diffusion on a ring; reactions a, b, eps = 0.6, 2, 0.01 of ARKODE's Brusselator. */
static void transport(double speed, double diffusion, const double *y, double *f)
{
    const double dx = 1. / CELLS;
    int i, s;
    for (s = 0; s < 3; s++)
        for (i = 0; i < CELLS; i++) {
            const double *x = y + s * CELLS;
            const double left = x[(i + CELLS - 1) % CELLS], right = x[(i + 1) % CELLS];
            f[s * CELLS + i] = diffusion * (right - 2 * x[i] + left) / (dx * dx) - speed * (right - left) / (2 * dx);
        }
}

static void brusselator(int p, double t, const double *y, double *f)
{
    const double a = 0.6, b = 2, eps = 0.01;
    int i;
    (void)t;
    if (p == 0) transport(0.5, 0.01, y, f);
    for (i = 0; p == 1 && i < CELLS; i++) {
        const double u = y[i], v = y[CELLS + i], w = y[2 * CELLS + i];
        f[i] = a - (w + 1) * u + v * u * u;
        f[CELLS + i] = w * u - v * u * u;
        f[2 * CELLS + i] = (b - w) / eps - w * u;
    }
}

static void brusselator_implicit(double t, const double *y, double *f)
{
    (void)t;
    transport(0, 0.01, y, f);
}

static void brusselator_start(double t, double *y)
{
    const double pi = acos(-1.);
    int i;
    (void)t;
    for (i = 0; i < CELLS; i++) {
        const double wave = 0.1 * sin(2 * pi * i / CELLS);
        y[i] = 0.6 + wave;
        y[CELLS + i] = 2 / 0.6 + wave;
        y[2 * CELLS + i] = 2 + wave;
    }
}

static void exchange(int p, double t, const double *y, double *f)
{
    const double flow = y[0] * y[1] - y[2] / 2, fast = 50 * (y[1] - y[2] * y[2]);
    (void)t;
    f[0] = f[1] = f[2] = 0;
    if (p == 0) f[0] = -flow;
    else {
        f[1] = flow - fast;
        f[2] = fast;
    }
}

static void exchange_start(double t, double *y)
{
    (void)t;
    y[0] = 1;
    y[1] = 0.5;
    y[2] = 0.25;
}

static void exchange_implicit(double t, const double *y, double *f)
{
    exchange(0, t, y, f);
}

/* A pendulum and a spring of 4*scale radians per unit of time; that part of the pendulum which the spring moves is fast. */
static void springs(int p, double t, const double *y, double *f)
{
    const double w = 4 * scale;
    (void)t;
    memset(f, 0, 4 * sizeof *f);
    if (p == 0) {
        f[0] = y[1];
        f[1] = -sin(y[0]) - 0.02 * y[1];
        f[3] = 0.5 * cos(y[0]);
    } else {
        f[1] = 0.3 * y[2];
        f[2] = w * y[3];
        f[3] = -w * y[2];
    }
}

static void springs_implicit(double t, const double *y, double *f)
{
    (void)t;
    memset(f, 0, 4 * sizeof *f);
    f[0] = y[1];
    f[1] = -0.02 * y[1];
}

static void springs_start(double t, double *y)
{
    (void)t;
    y[0] = 1;
    y[1] = y[3] = 0;
    y[2] = 0.5;
}

static void falling_start(double t, double *y)
{
    springs_start(t, y);
    y[0] = 3.1;
}

/* References: DOP853 and Radau of SciPy, which agree to 6e-15. */
static const struct problem {
    const char *name;
    int n, parts;
    double end;
    void (*f)(int part, double t, const double *y, double *f);
    void (*implicit)(double t, const double *y, double *f); /* which of part 0 an IMEX coupling solves for; NULL: none */
    void (*exact)(double t, double *y);                     /* or the start */
    int known;                          /* numbers at the end that another program computed; 0: exact is exact; -1: none */
    int which[6];
    double reference[6];
} problems[] = {
    {"kpr", 2, 2, 5, kpr, kpr_implicit, kpr_exact, 0, {0}, {0}},
    {"kpr3", 3, 3, 1, kpr3, NULL, kpr3_exact, 0, {0}, {0}},
    {"springs", 4, 2, 10, springs, springs_implicit, springs_start, -1, {0}, {0}},
    {"falling", 4, 2, 10, springs, springs_implicit, falling_start, -1, {0}, {0}},
    {"brusselator",
     3 * CELLS,
     2,
     1,
     brusselator,
     brusselator_implicit,
     brusselator_start,
     6,
     {0, 5, 16, 21, 32, 37},
     {0.6165947916300982, 0.4877482153505917, 3.300101298545736, 3.411592975047313, 1.987746295734164,
      1.990283096526637}},
    {"exchange",
     3,
     2,
     2,
     exchange,
     exchange_implicit,
     exchange_start,
     3,
     {0, 1, 2},
     {0.9959815745882344, 0.2520112017381617, 0.5020072236736028}},
};
static const struct problem *problem;
static double full_end; /* of the problem, whatever --end says */

/* A problem that proves the program: y is a list of weights on all slopes that a step evaluates, so a slope is a unit
   vector, and the argument of each evaluation is a row of the tables of a GARK method: the one that this code is.  A
   level that takes one step of its own in each interval stands for all, for sub-steps only make it more accurate. */
static double table[PARTS][PARTS][RK_STAGES_MAX * RK_STAGES_MAX];
static int evaluated[PARTS];

static void symbols(int p, double t, const double *y, double *f)
{
    const int i = evaluated[p]++;
    int q;
    (void)t;
    memset(f, 0, (size_t)MOST * sizeof *f);
    if (i >= RK_STAGES_MAX) return; /* too many for one method; counted all the same */
    for (q = 0; q < PARTS; q++)
        memcpy(table[p][q] + i * RK_STAGES_MAX, y + q * RK_STAGES_MAX, RK_STAGES_MAX * sizeof *y);
    f[p * RK_STAGES_MAX + i] = 1;
}
static const struct problem proof = {"proof", MOST, PARTS, 1, symbols, NULL, NULL, 0, {0}, {0}};

static void part(int p, double t, const double *y, double *f)
{
    problem->f(p, t, y, f);
    evaluations[p]++;
}

/* ---- one level: a polynomial from above, a coupling, the level below --------------------------------------------- */

typedef struct forcing {
    int powers;
    double start, length;
    const double *F;
} forcing;

/* f += sum_p tau^p F_p at time t */
static void add_forcing(const forcing *g, double t, double *f)
{
    double weight[RK_ORDER_MAX];
    const double tau = g->powers > 0 ? (t - g->start) / g->length : 0;
    int p;
    for (p = 0; p < g->powers; p++) weight[p] = p > 0 ? weight[p - 1] * tau : 1;
    rk_combine(1, g->powers, weight, problem->n, f, g->F, problem->n, f);
}

typedef struct level {
    const rk_coupling *C; /* NULL: the fastest, by a table */
    double h;             /* of its steps, unless adaptive */
    double z[RK_STAGES_MAX][MOST], k[RK_STAGES_MAX * MOST], F[RK_ORDER_MAX * MOST];
    double jumped[RK_STAGES_MAX * MOST]; /* the slopes that jumps take: relaxed slow and fast, IMEX the implicit part */
    rk_control control;
    double tolerance; /* 0: steps of size h */
    double sum;       /* of the errors of its steps, in tolerances of the level above */
    int accepted, rejected, counts, reuse; /* counts: into sum; reuse: slope 0 is known */
} level;

static level levels[PARTS];
static const rk_table *inner;
static int failed; /* a fast solve could not go on: the slow step is to be repeated with a smaller H */

static void solve(int l, double t, double length, const forcing *g, double *y);

/* Whether a later stage, or the embedded row where it is wanted, takes up slope j. */
static int needed(const rk_coupling *C, int j, int embedded)
{
    double weight[RK_ORDER_MAX * RK_STAGES_MAX], jump[RK_STAGES_MAX];
    int i, p, powers;
    for (i = j + 1; i < C->stages + (embedded != 0); i++) {
        powers = rk_coupling_forcing(C, i, weight);
        rk_coupling_jump(C, i, jump);
        if (jump[j] != 0) return 1;
        for (p = 0; p < powers; p++)
            if (weight[p * C->stages + j] != 0) return 1;
    }
    return 0;
}

/* Whether the jump of stage i takes other slopes than the forcing. */
static int jumps_apart(const rk_coupling *C, int i)
{
    return C->form == RK_FROM_START || (C->form == RK_RELAXED && i >= C->stages - 1);
}

/* z = base + g f(t, z), f the slow part or the implicit one of it: Newton's method, J by differences at the start. */
static void solve_implicit(int imex, double t, double g, const double *base, double *z)
{
    static double M[MOST * MOST];
    const int n = problem->n, one = 1;
    double f0[MOST], f1[MOST], r[MOST], change = 1;
    int pivot[MOST], info, i, j, it;
    memcpy(z, base, (size_t)n * sizeof *z);
    for (it = 0; it < 12 && change > 1e-14; it++) {
        if (imex) problem->implicit(t, z, f0);
        else problem->f(0, t, z, f0);
        for (j = 0; it < 2 && j < n; j++) {
            const double kept = z[j], d = 1e-7 * (1 + fabs(kept));
            z[j] += d;
            if (imex) problem->implicit(t, z, f1);
            else problem->f(0, t, z, f1);
            z[j] = kept;
            for (i = 0; i < n; i++) M[j * n + i] = (i == j) - g * (f1[i] - f0[i]) / d;
        }
        if (it < 2) dgetrf_(&n, &n, M, &n, pivot, &info);
        for (i = 0; i < n; i++) r[i] = base[i] + g * f0[i] - z[i];
        dgetrs_("N", &n, &one, M, &n, pivot, r, &n, &info);
        for (change = 0, i = 0; i < n; i++) {
            z[i] += r[i];
            change = fmax(change, fabs(r[i]) / (1 + fabs(z[i])));
        }
    }
}

/* Stage i of level l: the fast solve, then the jump.  Returns g_i: not 0, the stage is implicit and out is its base. */
static double stage(int l, int i, double t, double H, double *out)
{
    level *L = levels + l;
    const rk_coupling *C = L->C;
    const int n = problem->n, from = rk_coupling_from(C, i), count = i < C->stages ? i : C->stages;
    double weight[RK_ORDER_MAX * RK_STAGES_MAX], jump[RK_STAGES_MAX];
    const double c = C->c[from], d = rk_coupling_time(C, i) - c;
    forcing g = {rk_coupling_forcing(C, i, weight), t + c * H, d * H, L->F};
    int p;
    memcpy(out, L->z[from], (size_t)n * sizeof *out);
    for (p = 0; p < g.powers; p++) rk_combine(1, count, weight + p * C->stages, n, NULL, L->k, n, L->F + p * n);
    if (g.powers > 0) solve(l + 1, g.start, g.length, &g, out);
    rk_coupling_jump(C, i, jump);
    rk_combine(H, count, jump, n, out, jumps_apart(C, i) ? L->jumped : L->k, n, out);
    return i < C->stages ? jump[i] : 0;
}

/* The slopes at stage i, of time `time`: slow with the forcing from above; of relaxed methods also what is faster. */
static void slope(int l, int i, double time, const forcing *g)
{
    level *L = levels + l;
    const int n = problem->n;
    double *k = L->k + i * n, *jumped = L->jumped + i * n, f[MOST];
    const double one = 1;
    int p;
    part(l, time, L->z[i], k);
    add_forcing(g, time, k);
    if (L->C->form == RK_FROM_START) problem->implicit(time, L->z[i], jumped);
    if (L->C->form != RK_RELAXED) return;
    memcpy(jumped, k, (size_t)n * sizeof *k);
    for (p = l + 1; p < problem->parts; p++) {
        part(p, time, L->z[i], f);
        rk_combine(1, 1, &one, n, jumped, f, n, jumped);
    }
}

/* Stage i, whose base is in z[i], solved; its slope is (z - base)/(H g_i), for IMEX with the explicit rest. */
static void implicit_stage(int l, int i, double time, double g)
{
    level *L = levels + l;
    const int n = problem->n, imex = L->C->form == RK_FROM_START;
    double base[MOST], solved[MOST], *k = L->k + i * n;
    int c;
    memcpy(base, L->z[i], (size_t)n * sizeof *base);
    solve_implicit(imex, time, g, base, L->z[i]);
    evaluations[l]++;
    for (c = 0; c < n; c++) solved[c] = k[c] = (L->z[i][c] - base[c]) / g;
    if (!imex) return;
    problem->implicit(time, L->z[i], L->jumped + i * n);
    problem->f(l, time, L->z[i], k);
    for (c = 0; c < n; c++) {
        k[c] += solved[c] - L->jumped[i * n + c];
        L->jumped[i * n + c] = solved[c];
    }
}

/* One step of level l from t; y becomes the new one, the embedded one goes to yhat unless that is NULL. */
static void coupled_step(int l, double t, double H, const forcing *g, double *y, double *yhat)
{
    level *L = levels + l;
    const rk_coupling *C = L->C;
    int i;
    memcpy(L->z[0], y, (size_t)problem->n * sizeof *y);
    for (i = 0; i < C->stages; i++) {
        const double time = t + C->c[i] * H, implicit = i > 0 ? stage(l, i, t, H, L->z[i]) : 0;
        if (implicit != 0) implicit_stage(l, i, time, H * implicit);
        else if (needed(C, i, yhat != NULL) && !(i == 0 && L->reuse)) slope(l, i, time, g);
    }
    levels[l + 1].counts = 0; /* the fast steps of the embedded solution are no part of y */
    if (yhat) stage(l, C->stages, t, H, yhat);
    levels[l + 1].counts = 1;
    memcpy(y, L->z[C->stages - 1], (size_t)problem->n * sizeof *y);
}

static void table_step(int l, double t, double h, const forcing *g, double *y, double *err)
{
    double k[RK_STAGES_MAX * MOST], z[MOST], f[MOST];
    const double one = 1;
    const int n = problem->n;
    int i, p;
    for (i = 0; i < inner->stages; i++) {
        const double time = t + inner->c[i] * h;
        rk_stage(inner, i, h, n, y, k, n, z);
        part(l, time, z, k + i * n);
        for (p = l + 1; p < problem->parts; p++) { /* a single rate for the rest */
            part(p, time, z, f);
            rk_combine(1, 1, &one, n, k + i * n, f, n, k + i * n);
        }
        add_forcing(g, time, k + i * n);
    }
    rk_update(inner, h, n, y, k, n, y, err);
}

/* One step and the estimate of its error */
static double estimated_step(int l, double t, double h, const forcing *g, double *y)
{
    const int n = problem->n;
    double before[MOST], other[MOST], sum[2] = {0};
    int i;
    memcpy(before, y, (size_t)n * sizeof *y);
    if (levels[l].C) {
        coupled_step(l, t, h, g, y, other);
        for (i = 0; i < n; i++) other[i] = y[i] - other[i];
    } else table_step(l, t, h, g, y, other);
    rk_norm(levels[l].tolerance, levels[l].tolerance, NULL, n, other, before, y, sum);
    return rk_rms(sum);
}

static void fixed_steps(int l, double t, double length, const forcing *g, double *y)
{
    const double h = levels[l].h;
    const int steps = (int)ceil(length / h - 1e-9);
    int j;
    for (j = 0; j < steps; j++) {
        const double d = j + 1 < steps ? h : length - j * h;
        if (levels[l].C) coupled_step(l, t + j * h, d, g, y, NULL);
        else table_step(l, t + j * h, d, g, y, NULL);
    }
}

/* The control remembers its step from one interval to the next: rk_control_stop. */
static void adaptive_steps(int l, double t, double end, const forcing *g, double *y)
{
    level *L = levels + l;
    const size_t bytes = (size_t)problem->n * sizeof *y;
    double before[MOST];
    if (failed) return;
    rk_control_stop(&L->control, end, t, &L->h);
    while (t < end) {
        int status;
        double error;
        memcpy(before, y, bytes);
        error = estimated_step(l, t, L->h, g, y);
        status = rk_control_step(&L->control, error, &t, &L->h);
        if (status < 0 && l > 0) failed = 1;
        else scene_check(status, rk_message(status));
        if (status < 0) return;
        if (status == RK_REJECT) {
            memcpy(y, before, bytes);
            L->rejected++;
            continue;
        }
        L->accepted++;
        if (L->counts) L->sum += error * L->tolerance / levels[l - (l > 0)].tolerance;
    }
}

enum { SAMPLES = 9 };
static struct {
    int count; /* 0, or SAMPLES: values of fast solves at these times are kept, the last solve's */
    double at[SAMPLES], v[SAMPLES][MOST];
} inside;

/* Level l and all that is faster from t over `length`, in place */
static void solve(int l, double t, double length, const forcing *g, double *y)
{
    const double end = t + length, slack = 1e-9 * length;
    int j;
    for (j = 0; l == 1 && j < inside.count; j++) {
        if (!(inside.at[j] > t + slack && inside.at[j] <= end + slack)) continue;
        adaptive_steps(l, t, fmin(inside.at[j], end), g, y);
        memcpy(inside.v[j], y, (size_t)problem->n * sizeof *y);
        t = fmin(inside.at[j], end);
    }
    if (levels[l].tolerance > 0) adaptive_steps(l, t, end, g, y);
    else fixed_steps(l, t, end - t, g, y);
}

/* ---- the exact solution at any time ------------------------------------------------------------------------------ */

/* Steps of dop853 to 1e-14, kept, where there is no formula. */
typedef struct kept_step {
    double t, h, *y, *k;
} kept_step;
static kept_step *kept;
static int kept_steps;

static void all_parts(double t, const double *y, double *f)
{
    double g[MOST];
    const double unit = 1;
    int p;
    problem->f(0, t, y, f);
    for (p = 1; p < problem->parts; p++) {
        problem->f(p, t, y, g);
        rk_combine(1, 1, &unit, problem->n, f, g, problem->n, f);
    }
}

/* All slopes of a step, those for dense output, too; its error in tolerances. */
static double reference_step(const rk_table *T, const kept_step *s, double *ynew)
{
    const int n = problem->n;
    double z[MOST], err[MOST], third[MOST], sum[2] = {0, 0}, sum3[2] = {0, 0};
    int i;
    for (i = 0; i < T->stages + T->extra; i++) {
        rk_stage(T, i, s->h, n, s->y, s->k, n, z);
        all_parts(s->t + T->c[i] * s->h, z, s->k + i * n);
    }
    rk_update(T, s->h, n, s->y, s->k, n, ynew, err);
    rk_combine(s->h, T->stages, T->e3, n, NULL, s->k, n, third);
    rk_norm(1e-14, 1e-14, NULL, n, err, s->y, ynew, sum);
    rk_norm(1e-14, 1e-14, NULL, n, third, s->y, ynew, sum3);
    return rk_combined_error(rk_rms(sum), rk_rms(sum3));
}

static void make_reference(void)
{
    enum { STEPS = 40000 };
    const rk_table *T = rk_find("dop853");
    const int n = problem->n, m = T->stages + T->extra;
    double t = 0, h = 1e-4, y[MOST], ynew[MOST];
    rk_control C;
    int status;
    kept = scene_memory(STEPS * sizeof *kept);
    rk_control_make(&C, "PI", T);
    rk_control_stop(&C, problem->end, t, &h);
    problem->exact(0, y);
    while (t < problem->end && kept_steps < STEPS) {
        kept_step *s = kept + kept_steps;
        if (!s->y) s->y = scene_memory((size_t)(n + m * n) * sizeof *y);
        s->t = t, s->h = h, s->k = s->y + n;
        memcpy(s->y, y, (size_t)n * sizeof *y);
        status = rk_control_step(&C, reference_step(T, s, ynew), &t, &h);
        scene_check(status, rk_message(status));
        if (status != RK_OK) continue;
        memcpy(y, ynew, sizeof y);
        kept_steps++;
    }
}

static void exact_at(double t, double *y)
{
    int low = 0, high;
    rk_step s = {rk_find("dop853"), 0, problem->n, NULL, NULL, problem->n};
    if (problem->known == 0) {
        problem->exact(t, y);
        return;
    }
    if (!kept) make_reference();
    for (high = kept_steps - 1; low < high;) { /* the last step that begins at t or before */
        const int middle = (low + high + 1) / 2;
        if (kept[middle].t <= t) low = middle;
        else high = middle - 1;
    }
    s.h = kept[low].h, s.y = kept[low].y, s.k = kept[low].k;
    rk_dense(&s, fmin(1, (t - kept[low].t) / s.h), 0, y);
}

/* ---- a run by one tolerance -------------------------------------------------------------------------------------- */

#define SHARE     0.25 /* of what a step may add, for its fast steps */
#define KEPT      0.5  /* the next measurement of a worth counts as at least this part of the last */
#define APART     32   /* most steps from one measurement to the next */
#define FINER     0.1  /* fast tolerance of a measurement over that of the step; and of the first step over the tolerance */
#define LEAST_FAST 1e-5
#define MOST_FAST  10. /* limits of the fast tolerance over the slow one */

/* What the estimates of a step are worth: K e is its slow error, Kf s its fast one, over what it may add. */
typedef struct worth {
    double K, Kf, factor;                /* factor: the fast tolerance over the slow one */
    int known, apart, since, measured;   /* steps to the next measurement, since the last; how many there were */
    double worst;                        /* error at the ends of the steps, in tolerances */
} worth;

/* |a - b| in tolerances */
static double distance(const double *a, const double *b, const double *y)
{
    double d[MOST], sum[2] = {0, 0};
    int i;
    for (i = 0; i < problem->n; i++) d[i] = a[i] - b[i];
    rk_norm(levels[0].tolerance, levels[0].tolerance, NULL, problem->n, d, y, NULL, sum);
    return rk_rms(sum);
}

/* The step from y to ynew once more, whole and in halves, by a fast table of higher order at a tenth of the tolerance:
   the slow and the fast error that it adds. */
static void measure(double t, double H, const double *y, const double *ynew, double *slow, double *fast)
{
    const forcing none = {0, 0, 1, NULL};
    const rk_table *T = inner;
    const level kept_level = levels[1];
    const size_t bytes = (size_t)problem->n * sizeof *y;
    const int order = levels[0].C->order;
    double whole[MOST], halves[MOST];
    inner = rk_find(order >= 4 ? "verner6" : "dp5");
    rk_control_make(&levels[1].control, "PI", inner);
    levels[1].tolerance *= FINER;
    memcpy(whole, y, bytes);
    memcpy(halves, y, bytes);
    levels[0].reuse = 1; /* the slow slope at y */
    coupled_step(0, t, H, &none, whole, NULL);
    levels[1].h = kept_level.h;
    coupled_step(0, t, H / 2, &none, halves, NULL);
    levels[0].reuse = 0;
    coupled_step(0, t + H / 2, H / 2, &none, halves, NULL);
    *slow = distance(whole, halves, y) / (1 - pow(2, -order));
    *fast = distance(ynew, whole, y);
    levels[1] = kept_level;
    inner = T;
}

/* difference, s: the embedded difference and the sum of the fast errors of the step from t to t + H */
static void learn(worth *W, double difference, double s, double t, double H, const double *y, const double *ynew)
{
    const double share = H / problem->end;
    double slow, fast, K, Kf;
    measure(t, H, y, ynew, &slow, &fast);
    if (failed) return;
    K = slow / difference / share;
    Kf = s > 0 ? fast / s / share : W->Kf;
    if (W->known) {
        K = fmax(K, KEPT * W->K);
        Kf = fmax(Kf, KEPT * W->Kf);
    }
    W->apart = W->known ? (int)fmin(2 * W->apart, APART) : 1;
    W->K = fmin(fmax(K, 0.02), 1e4);
    W->Kf = fmin(fmax(Kf, 1e-3), 1e4);
    W->known = 1;
    W->since = 0;
    W->measured++;
}

/* The fast error follows its tolerance. */
static void set_fast(worth *W, double s, double least, double most)
{
    const double wanted = s > 0 ? SHARE / (W->Kf * s) : most;
    W->factor = fmin(fmax(W->factor * fmin(fmax(wanted, least), most), LEAST_FAST), MOST_FAST);
}

/* One step from *t; y goes on where it is accepted.  *again: the last one was repeated for its fast error. */
static void shared_step(worth *W, double *t, double *y, int *again)
{
    const forcing none = {0, 0, 1, NULL};
    level *slow = levels, *fast = levels + 1;
    const size_t bytes = (size_t)problem->n * sizeof *y;
    double ynew[MOST], x[MOST], difference, s;
    int status;
    memcpy(ynew, y, bytes);
    fast->tolerance = W->factor * slow->tolerance;
    fast->sum = 0;
    coupled_step(0, *t, slow->h, &none, ynew, x);
    difference = failed ? HUGE_VAL : distance(ynew, x, y);
    s = failed ? 0 : fast->sum;
    failed = 0;
    if (W->since >= W->apart && isfinite(difference) && difference * W->K <= 1 && difference * W->K > 0.01)
        learn(W, difference, s, *t, slow->h, y, ynew);
    failed = 0;
    if (W->known && !*again && W->Kf * s > 2 * SHARE && W->factor > 2 * LEAST_FAST) {
        set_fast(W, s, 0.05, 1);
        slow->rejected++;
        *again = 1;
        return;
    }
    *again = 0;
    status = rk_control_step(&slow->control, W->K * difference + (W->known ? W->Kf * s : 0), t, &slow->h);
    scene_check(status, rk_message(status));
    set_fast(W, s, 0.05, 2);
    if (status == RK_REJECT) {
        slow->rejected++;
        return;
    }
    slow->accepted++;
    W->since++;
    memcpy(y, ynew, bytes);
    exact_at(*t, x);
    W->worst = fmax(W->worst, distance(y, x, x));
}

/* The same error without shares: H by the embedded difference, fast steps to a part of the tolerance. */
static void decoupled_step(worth *W, double *t, double *y)
{
    const forcing none = {0, 0, 1, NULL};
    double before[MOST], x[MOST];
    int status;
    memcpy(before, y, sizeof before);
    x[0] = estimated_step(0, *t, levels[0].h, &none, y);
    if (failed) x[0] = HUGE_VAL;
    failed = 0;
    status = rk_control_step(&levels[0].control, x[0], t, &levels[0].h);
    scene_check(status, rk_message(status));
    if (status == RK_REJECT) {
        memcpy(y, before, sizeof before);
        levels[0].rejected++;
        return;
    }
    levels[0].accepted++;
    exact_at(*t, x);
    W->worst = fmax(W->worst, distance(y, x, x));
}

/* ---- a run ------------------------------------------------------------------------------------------------------- */

static double first_step[PARTS], mass;

/* From 0 to the end; returns the root mean square error: over time for exact solutions, else of what is known. */
static double run(double *component)
{
    const int n = problem->n, outputs = problem->known != 0 ? 1 : (int)floor(problem->end / 0.1 + 0.5);
    const forcing none = {0, 0, 1, NULL};
    double y[MOST], x[MOST], total = 0, length = problem->end / outputs;
    int i, j, l;
    for (l = 0; l < PARTS; l++) {
        evaluations[l] = 0;
        levels[l].accepted = levels[l].rejected = 0;
        levels[l].h = first_step[l];
    }
    problem->exact(0, y);
    for (mass = 0, i = 0; i < n; i++) {
        component[i] = 0;
        mass -= y[i];
    }
    for (j = 0; j < outputs; j++) {
        solve(0, j * length, length, &none, y);
        problem->exact((j + 1) * length, x);
        for (i = 0; i < problem->known; i++) x[problem->which[i]] = problem->reference[i];
        if (problem->known < 0) exact_at(problem->end, x);
        for (i = 0; i < (problem->known > 0 ? problem->known : n); i++) {
            const int q = problem->known > 0 ? problem->which[i] : i;
            component[i] += pow(y[q] - x[q], 2) / outputs;
        }
    }
    for (i = 0; i < n; i++) {
        total += component[i];
        component[i] = sqrt(component[i]);
        mass += y[i];
    }
    return sqrt(total / (problem->known > 0 ? problem->known : n));
}

static void print_run(double h, double error, const double *component)
{
    int i;
    printf("H %-10.4g error %.3e", h, error);
    for (i = 0; i < (problem->known ? 0 : problem->n); i++) printf(" %c %.3e", "uvw"[i], component[i]);
    printf("  evaluations");
    for (i = 0; i < problem->parts; i++) printf(" %ld", evaluations[i]);
}

/* The order of one step as it is coded, by rk_defect_gark; -1: more than RK_STAGES_MAX evaluations of a part. */
static int order_of_code(int parts)
{
    static double A[PARTS][PARTS][RK_STAGES_MAX * RK_STAGES_MAX];
    const struct problem *given = problem;
    const double *tables[PARTS * PARTS], *b[PARTS];
    const forcing none = {0, 0, 1, NULL};
    struct problem symbolic = proof;
    double y[MOST] = {0};
    int p, q, i, order = 0;
    symbolic.parts = parts;
    problem = &symbolic;
    for (p = 0; p < parts; p++) {
        evaluated[p] = 0;
        levels[p].h = 2; /* longer than any interval: one step each */
    }
    coupled_step(0, 0, 1, &none, y, NULL);
    problem = given;
    for (p = 0; p < parts; p++) {
        if (evaluated[p] > RK_STAGES_MAX) return -1;
        b[p] = y + p * RK_STAGES_MAX;
        for (q = 0; q < parts; q++) {
            for (i = 0; i < evaluated[p]; i++)
                memcpy(A[p][q] + i * evaluated[q], table[p][q] + i * RK_STAGES_MAX,
                       (size_t)evaluated[q] * sizeof(double));
            tables[p * parts + q] = A[p][q];
        }
    }
    while (order < 5 && rk_defect_gark(order + 1, parts, evaluated, tables, b) <= RK_TOLERANCE) order++;
    return order;
}

/* H halved again and again, all other steps with it */
static double halve(double hs, double ratio, int refinements)
{
    double component[MOST], error = 0, last = 0;
    int r, l;
    for (r = 0; r <= refinements; r++, hs /= 2) {
        for (l = 0; l < PARTS; l++) first_step[l] = l > 0 ? first_step[l - 1] / ratio : hs;
        error = run(component);
        print_run(hs, error, component);
        if (r > 0) printf("  order %.2f", log2(last / error));
        printf("\n");
        if (r == refinements && r > 0) printf("observed_order %.3f\n", log2(last / error));
        last = error;
    }
    return error;
}

/* One rate for all: the step with which the table has the same error, and what that costs */
static void single_rate(const char *name, double target, double h)
{
    const rk_coupling *C = levels[0].C;
    const rk_table *T = inner;
    const long slow = evaluations[0], fastest = evaluations[problem->parts - 1];
    double component[MOST], error = 0;
    int i;
    inner = rk_find(name);
    levels[0].C = NULL;
    first_step[0] = h;
    for (i = 0; i < 6; i++) {
        error = run(component);
        if (fabs(log(error / target)) < 0.02) break;
        h *= isfinite(error) ? fmin(2, fmax(0.25, pow(target / error, 1. / inner->order))) : 0.25;
        if (i < 5) first_step[0] = h;
    }
    printf("one rate, %s:\n", inner->name);
    print_run(first_step[0], error, component);
    printf("\nsaved_slow %.1f\nsaved_fast %.2f\n", (double)evaluations[0] / (double)slow,
           (double)evaluations[problem->parts - 1] / (double)fastest);
    levels[0].C = C;
    inner = T;
}

/* From 0 to the end without stops between; y is the end. */
static worth one_tolerance(const rk_coupling *C, double tolerance, double fraction, int shares, double *y)
{
    worth W = {1, 1, FINER, 0, 0, 0, 0, 0};
    double t = 0;
    int l, again = 0;
    for (l = 0; l < problem->parts; l++) {
        level *L = levels + l;
        if (L->C) rk_control_order(&L->control, "PI", C->order < C->order_hat ? C->order : C->order_hat);
        else rk_control_make(&L->control, "PI", inner);
        L->tolerance = l > 0 ? fraction * levels[l - 1].tolerance : tolerance;
        L->h = 1e-3 * pow(0.1, l);
        L->accepted = L->rejected = L->reuse = 0;
        L->counts = 1;
    }
    problem->exact(0, y);
    rk_control_stop(&levels[0].control, problem->end, t, &levels[0].h);
    while (t < problem->end) {
        if (shares) shared_step(&W, &t, y, &again);
        else decoupled_step(&W, &t, y);
    }
    return W;
}

/* One tolerance: shares of it, or (also with three rates) each level a fraction of it; twice: another run at ten times the
   tolerance, a ninth of the difference of the two ends is the error of this one. */
static void adaptive(const rk_coupling *C, double tolerance, double fraction, int shares, int twice)
{
    double y[MOST], coarse[MOST], x[MOST], error = 0;
    worth W;
    int l, i;
    memset(evaluations, 0, sizeof evaluations);
    if (twice) one_tolerance(C, 10 * tolerance, fraction, shares, coarse);
    W = one_tolerance(C, tolerance, fraction, shares, y);
    printf("tolerance %-7g", tolerance);
    for (l = 0; l < problem->parts; l++)
        printf("  level %d: accepted %d rejected %d", l + 1, levels[l].accepted, levels[l].rejected);
    printf("\nmeasured %d\nevaluations", W.measured);
    for (i = 0; i < problem->parts; i++) printf(" %ld", evaluations[i]);
    exact_at(problem->end, x);
    printf("\nerror_at_end %.3f\n", distance(y, x, x));
    for (i = 0; i < problem->known; i++) error = fmax(error, fabs(x[problem->which[i]] - problem->reference[i]));
    if (problem->known > 0 && problem->end == full_end) printf("reference_off %.1e\n", error);
    if (twice) printf("estimated_error %.3f\n", distance(y, coarse, y) / 9);
    printf("error_per_tolerance %.3f\n", W.worst);
}

/* ---- values inside a step ---------------------------------------------------------------------------------------- */

/* Largest errors of a run of equal steps: at their ends, inside by the fast solves of the stages, inside by one more fast
   solve. */
typedef struct inside_errors {
    double ends, stages, more;
} inside_errors;

/* v' = fast + p(t) from y, p the polynomial of that degree through the slow slopes at t + H, t, t - H, t - 2 H (slow[0] is the newest);
   then theta (ynew - v(end)) is added. */
static void one_more_solve(double t, double H, int degree, double slow[4][MOST], const double *y, const double *ynew)
{
    const int n = problem->n;
    double F[4 * MOST], v[MOST];
    forcing g = {4, t, H, F};
    int c, j;
    for (c = 0; c < n; c++) { /* Newton's form in u = (time - t)/H through 1, 0, -1, -2 */
        const double d1 = slow[0][c] - slow[1][c], e1 = slow[1][c] - slow[2][c], f1 = slow[2][c] - slow[3][c];
        const double d2 = degree >= 2 ? (d1 - e1) / 2 : 0, d3 = degree >= 3 ? (d1 - 2 * e1 + f1) / 6 : 0;
        F[c] = slow[1][c];
        F[n + c] = degree >= 1 ? d1 - d2 - d3 : 0;
        F[2 * n + c] = d2;
        F[3 * n + c] = d3;
    }
    memcpy(v, y, (size_t)n * sizeof *v);
    solve(1, t, H, &g, v);
    for (j = 0; j < SAMPLES; j++)
        for (c = 0; c < n; c++) inside.v[j][c] += (j + 1.) / (SAMPLES + 1) * (ynew[c] - v[c]);
}

static double worst_inside(void)
{
    double x[MOST], worst = 0;
    int j;
    for (j = 0; j < SAMPLES; j++) {
        exact_at(inside.at[j], x);
        worst = fmax(worst, distance(inside.v[j], x, x));
    }
    return worst;
}

static inside_errors run_inside(const rk_coupling *C, int steps)
{
    const forcing none = {0, 0, 1, NULL};
    const double H = problem->end / steps;
    const int degree = C->order - 2;
    const size_t bytes = (size_t)problem->n * sizeof(double);
    double y[MOST], ynew[MOST], x[MOST], slow[4][MOST];
    inside_errors E = {0, 0, 0};
    int q, j;
    problem->exact(0, y);
    problem->f(0, 0, y, slow[0]);
    levels[1].h = H / 20;
    for (q = 0; q < steps; q++) {
        const double t = q * H;
        for (j = 0; j < SAMPLES; j++) inside.at[j] = t + (j + 1) * H / (SAMPLES + 1);
        inside.count = SAMPLES;
        memcpy(ynew, y, bytes);
        coupled_step(0, t, H, &none, ynew, NULL);
        exact_at(t + H, x);
        E.ends = fmax(E.ends, distance(ynew, x, x));
        E.stages = fmax(E.stages, worst_inside());
        for (j = 3; j > 0; j--) memcpy(slow[j], slow[j - 1], bytes);
        problem->f(0, t + H, ynew, slow[0]);
        if (q >= degree - 1) { /* else slopes are missing */
            one_more_solve(t, H, degree, slow, y, ynew);
            E.more = fmax(E.more, worst_inside());
        }
        inside.count = 0;
        memcpy(y, ynew, bytes);
    }
    return E;
}

/* Errors relative to 1 + |y|, and the orders that they go with. */
static void measure_inside(const rk_coupling *C, double hs)
{
    const int steps = (int)ceil(problem->end / hs - 1e-9);
    inside_errors coarse, fine;
    inner = rk_find("verner6");
    rk_control_make(&levels[1].control, "PI", inner);
    levels[0].tolerance = 1;
    levels[1].tolerance = 1e-13;
    coarse = run_inside(C, steps);
    fine = run_inside(C, 2 * steps);
    printf("at_ends %.2e %.2f\ninside_stages %.2e %.2f\ninside_more %.2e %.2f\n", fine.ends, log2(coarse.ends / fine.ends),
           fine.stages, log2(coarse.stages / fine.stages), fine.more, log2(coarse.more / fine.more));
}

/* ---- couplings from tables --------------------------------------------------------------------------------------- */

/* Kutta's 3/8 rule and the table behind KW3: tables of the host's own.  Sexton & Reynolds, J. Comput. Appl. Math. (2019),
   give 3 and 3 for the orders of their MIS methods, 4 and 3 relaxed.  The condition for 4, besides those of the table:
   sum_i b_i sum_{k <= i} (c_k - c_{k-1}) ((Ac)_k + (Ac)_{k-1}) = 1/12. */
static const double rule38_A[] = {0, 0, 0, 0, 1. / 3, 0, 0, 0, -1. / 3, 1, 0, 0, 1, -1, 1, 0};
static const double rule38_b[] = {1. / 8, 3. / 8, 3. / 8, 1. / 8}, rule38_c[] = {0, 1. / 3, 2. / 3, 1};
static const double kw_A[] = {0, 0, 0, 1. / 3, 0, 0, -3. / 16, 15. / 16, 0};
static const double kw_b[] = {1. / 6, 3. / 10, 8. / 15}, kw_c[] = {0, 1. / 3, 3. / 4};
static const rk_table rule38 = {.name = "rule38", .stages = 4, .order = 4, .A = rule38_A, .b = rule38_b, .c = rule38_c};
static const rk_table kw = {.name = "kw", .stages = 3, .order = 3, .A = kw_A, .b = kw_b, .c = kw_c};

static const rk_table *table_of(const char *name)
{
    if (strcmp(name, "rule38") == 0) return &rule38;
    if (strcmp(name, "kw") == 0) return &kw;
    return rk_find(name);
}

/* A stored coupling, or mis-TABLE, or rmis-TABLE; NULL: there is none. */
static const rk_coupling *coupling_of(const char *name, int implicit, rk_coupling *made)
{
    const int relaxed = strncmp(name, "rmis-", 5) == 0, mis = relaxed || strncmp(name, "mis-", 4) == 0;
    const rk_table *T = mis ? table_of(strchr(name, '-') + 1) : NULL;
    double jump[RK_STAGES_MAX];
    const rk_coupling *C = rk_coupling_find(name);
    int i, status;
    if (T) {
        const size_t bytes = rk_mis_size(T->stages);
        status = rk_check(T, NULL); /* two of these tables are typed in above */
        scene_check(status, rk_message(status));
        status = rk_mis(made, T, relaxed ? RK_RELAXED : RK_FROM_LAST, scene_memory(bytes), bytes);
        scene_check(status, rk_message(status));
        made->order = rk_coupling_order(made, RK_OF_STEP); /* rk_mis states what always holds */
        if (made->order_hat) made->order_hat = rk_coupling_order(made, RK_OF_PAIR);
        return made;
    }
    for (i = 1; i < (C ? C->stages : 0); i++) {
        rk_coupling_jump(C, i, jump);
        if (jump[i] != 0 && !implicit) return NULL; /* with equal steps: multirate.c */
    }
    return C;
}

int main(int argc, char **argv)
{
    static const char *const single[] = {"", "euler", "heun", "kutta3", "rk4", "dp5"};
    static const char *const pairs[] = {"", "bs3", "bs3", "bs3", "dp5", "dp5"};
    static const char *const controls[] = {"shares", "decoupled", NULL};
    scene_option o[] = {{"problem", "kpr3", "kpr kpr3 brusselator exchange springs falling"},
                        {"method", "KW3",
                         "KW3 ERK22a ERK33a ERK45a MERK21 .. MERK54, mis-TABLE or rmis-TABLE: TABLE is "
                         "an explicit one of rk.h, rule38 or kw; with --tolerance also the implicit ones"},
                        {"inner", "", "table of the fastest part; one of the coupling's order unless given"},
                        {"hs", "0.05", "slowest step"},
                        {"ratio", "10", "of a step to the next faster one"},
                        {"refine", "3", "how often hs is halved"},
                        {"tolerance", "0", "of the whole run, unless 0: then equal steps"},
                        {"control", "shares", "with two rates; or decoupled"},
                        {"fraction", "0.1", "of the tolerance, for the next faster level (decoupled)"},
                        {"twice", "0", "1: a run at ten times the tolerance, too, that says how large the error is"},
                        {"inside", "0", "1: errors and orders inside steps of hs and hs/2, two rates"},
                        {"end", "0", "of the run, unless 0: then that of the problem"},
                        {"scale", "10", "of a time scale to the next faster one (kpr, kpr3); spring: 4*scale"},
                        {"G", "-1", "stiffness of the slow equation (kpr, kpr3)"},
                        {"e", "0.5", "coupling (kpr, kpr3)"},
                        {NULL, NULL, NULL}};
    rk_coupling made;
    const rk_coupling *C;
    struct problem chosen;
    double hs, ratio, tolerance, error;
    int refinements, l, order, shares, look;
    size_t i;
    scene_parse(argc, argv, "two or three rates by recursion, any explicit coupling at each level", o);
    for (i = 0; i < sizeof problems / sizeof *problems; i++)
        if (strcmp(problems[i].name, scene_text(o, "problem")) == 0) problem = problems + i;
    tolerance = scene_number(o, "tolerance", 0, 1);
    shares = scene_choice(o, "control", controls) == 0;
    look = scene_integer(o, "inside", 0, 1);
    C = coupling_of(scene_text(o, "method"), tolerance > 0 || look, &made);
    if (!problem || !C) {
        fprintf(stderr, "--problem is one of %s; --method is one of %s\n", o[0].help, o[1].help);
        return 2;
    }
    inner = table_of(*scene_text(o, "inner") ? scene_text(o, "inner") : single[C->order]);
    hs = scene_number(o, "hs", 1e-5, 1);
    ratio = scene_number(o, "ratio", 1, 1e4);
    refinements = scene_integer(o, "refine", 0, 10);
    scale = scene_number(o, "scale", 1, 1e4);
    G = scene_perturbed("G", scene_number(o, "G", -1e6, 0));
    e = scene_number(o, "e", -10, 10);
    chosen = *problem;
    full_end = chosen.end;
    if (scene_number(o, "end", 0, 100) > 0) chosen.end = scene_number(o, "end", 0, 100);
    problem = &chosen;
    order = rk_coupling_order(C, RK_OF_STEP);
    printf("%s on %s, the fastest part by %s\norder_by_trees %d\n", C->name, problem->name, inner->name, order);
    for (l = 0; l + 1 < problem->parts; l++) levels[l].C = C;
    if (look && (problem->parts > 2 || (C->form == RK_FROM_START && !problem->implicit))) {
        fprintf(stderr, "--inside 1: two rates\n");
        return 2;
    }
    if (look) {
        measure_inside(C, hs);
        return 0;
    }
    if (tolerance > 0) {
        inner = table_of(*scene_text(o, "inner") ? scene_text(o, "inner") : pairs[C->order]);
        if (!C->order_hat || !inner->order_hat) {
            fprintf(stderr, "--tolerance: %s needs an embedded row, and %s a pair\n", C->name, inner->name);
            return 2;
        }
        if (problem->parts > 2) shares = 0;
        if (C->form == RK_FROM_START && !problem->implicit) {
            fprintf(stderr, "--problem %s has no implicit part\n", problem->name);
            return 2;
        }
        adaptive(C, tolerance, scene_number(o, "fraction", 1e-6, 1), shares, scene_integer(o, "twice", 0, 1));
        return 0;
    }
    printf("order_of_code %d\n", order_of_code(problem->parts));
    error = halve(hs, ratio, refinements);
    printf("mass_defect %.3e\n", mass);
    single_rate(single[C->order], error, hs * pow(0.5, refinements) / pow(ratio, problem->parts - 1));
    return 0;
}
