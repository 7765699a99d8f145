/* SPDX-License-Identifier: MIT

   arena_coupled.h - the elastic tube of examples/tube.c in many regimes, and heat between two plates.

   Two plates of depth 1, u = 0 on the outer boundaries, implicit Euler, three sine modes along the interface, so that H
   has rank three in space: the first takes the interface temperature and returns the heat flux, the second the
   reverse.  Converged when temperature and flux of all samples change by less than 1e-8 from one evaluation to the
   next. */
#ifndef ARENA_COUPLED_H_INCLUDED
#define ARENA_COUPLED_H_INCLUDED
#define main tube_main /* the two solvers of the tube, and waveforms of NODES numbers */
#include "../../examples/tube.c"
#undef main
#include "arena.h"

/* ---- the tube ---- */

typedef struct regime {
    const char *name;
    int predict, fluids, solids, windows, limit, columns;
    double dt, wall, wall_later; /* factor on the stiffness; from the middle of the run on */
    int lengths;                 /* of windows: 0 equal, 1 in a cycle of three, 2 in a cycle of five, 3 random */
    double contact;              /* compliance beyond A = 1.02, against that before */
    double noise;                /* of |H(x) - answer of the window before| */
    int area_alone;              /* 1: A alone is judged */
    int mean;                    /* 1: the solid, one step, has the mean pressure; areas between window ends quadratic */
} regime;

static const regime regimes[] = {
    {"constant guess", 0, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0, 0},
    {"linear guess", 1, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0, 0},
    {"quadratic guess", 2, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0, 0},
    {"wall x 3 halfway", 0, 1, 1, 100, 60, 50, 0.01, 1, 3, 0, 1, 0, 0, 0},
    {"wall x 0.6 halfway", 0, 1, 1, 100, 60, 50, 0.01, 1, 0.6, 0, 1, 0, 0, 0},
    {"lengths in a cycle of 3", 0, 1, 1, 30, 120, 50, 0.01, 1, 1, 1, 1, 0, 0, 0},
    {"cycle of 5, wall x 3", 0, 1, 1, 60, 120, 50, 0.01, 1, 3, 2, 1, 0, 0, 0},
    {"random lengths", 0, 1, 1, 60, 120, 50, 0.01, 1, 1, 3, 1, 0, 0, 0},
    {"contact", 0, 1, 1, 60, 150, 50, 0.01, 1, 1, 0, 0.5, 0, 0, 0},
    {"noise 1e-6, A judged", 0, 1, 1, 60, 60, 50, 0.01, 1, 1, 0, 1, 1e-6, 1, 0},
    {"window .01/2", 1, 1, 1, 20, 120, 60, 0.005, 1, 1, 0, 1, 0, 0, 0},
    {"window .01/4", 1, 1, 1, 20, 120, 60, 0.0025, 1, 1, 0, 1, 0, 0, 0},
    {"window .01/8", 1, 1, 1, 20, 120, 60, 0.00125, 1, 1, 0, 1, 0, 0, 0},
    {"sub-steps 1,2", 0, 1, 2, 20, 120, 60, 0.01, 1, 1, 0, 1, 0, 0, 0},
    {"sub-steps 4,1, mean", 0, 4, 1, 40, 60, 50, 0.01, 1, 1, 0, 1, 0, 0, 1},
    {"sub-steps 2,2", 1, 2, 2, 12, 120, 150, 0.01, 1, 1, 0, 1, 0, 0, 0},
    {"sub-steps 4,4", 1, 4, 4, 12, 120, 150, 0.01, 1, 1, 0, 1, 0, 0, 0},
};
#define SHAKE 1e-12 /* far below the tolerances */
enum { REGIMES = (int)(sizeof regimes / sizeof *regimes) };

typedef struct tube {
    const regime *how;
    waveform p, A;
    double v0[NODES], v[NODES], *before, *guess, t0, t1, length;
    chance lengths, noise;
} tube;

static double window_length(tube *s, int window)
{
    static const double three[] = {1, 0.5, 2}, five[] = {1, 0.7, 1.4, 0.6, 2};
    switch (s->how->lengths) {
    case 1: return s->how->dt * three[window % 3];
    case 2: return s->how->dt * five[window % 5];
    case 3: return s->how->dt * between(&s->lengths, 0.6, 2);
    default: return s->how->dt;
    }
}

static void tube_guess(tube *s, int solids)
{
    double *weight = numbers(solids * (3 * solids + 1));
    const int columns = wf_columns(s->A.w);
    int j;
    for (j = 1; j <= solids; j++)
        wf_predict(s->A.w, s->how->predict, substep(s->t1, s->length, j, solids), weight + (j - 1) * columns);
    wf_combine(solids, columns, weight, NODES, wf_column(s->A.w, 0), NODES, s->guess, NODES);
    free(weight);
}

static void tube_start(problem *p, int window, double *x)
{
    tube *s = (tube *)p->state;
    const int solids = s->how->solids, fluids = s->how->fluids;
    int j;
    stiffness = 5000 * sqrt(PI) * (2 * window >= p->windows ? s->how->wall_later : s->how->wall);
    s->length = window_length(s, window);
    s->t0 = window > 0 ? s->t1 : 0;
    s->t1 = s->how->lengths ? s->t0 + s->length : (window + 1) * s->length;
    DT = s->length / fluids;
    if (window > 0) {
        tube_guess(s, solids);
        wf_advance(s->A.w, s->how->mean ? 1 : 2 * solids);
        wf_advance(s->p.w, 2 * fluids);
    }
    copy(p->n, s->guess, x);
    for (j = 1; j <= solids; j++) waveform_push(&s->A, substep(s->t1, s->length, j, solids), 0);
    for (j = 0; j < fluids; j++) copy(NODES, wf_column(s->p.w, wf_start(s->p.w)), s->before + j * NODES);
}

static void tube_disturb(tube *s, ptrdiff_t n, double *hx)
{
    const double *start = wf_column(s->A.w, wf_start(s->A.w));
    double size = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        if (hx[i] > 1.02) hx[i] = 1.02 + s->how->contact * (hx[i] - 1.02);
        size += (hx[i] - start[i % NODES]) * (hx[i] - start[i % NODES]);
    }
    for (i = 0; i < n && s->how->noise > 0; i++) hx[i] += s->how->noise * sqrt(size / (double)n) * normal(&s->noise);
}

static int tube_map(problem *p, const double *x, double *hx)
{
    tube *s = (tube *)p->state;
    const double *pressure = waveform_window(&s->p);
    double change_p, change_A;
    copy(p->n, x, waveform_window(&s->A));
    if (fluid(s->v0, s->v, s->how->fluids, s->t1, s->length, &s->A, &s->p) != 0) return -1;
    solid(s->how->solids, s->t1, s->length, s->how->mean, &s->p, hx);
    tube_disturb(s, p->n, hx);
    change_p = relative_change(s->how->fluids * NODES, pressure, s->before);
    change_A = relative_change((int)p->n, hx, x);
    copy(s->how->fluids * NODES, pressure, s->before);
    return (change_p <= 1e-5 || s->how->area_alone) && change_A <= 1e-5;
}

static void tube_accept(problem *p, const double *x, const double *hx)
{
    tube *s = (tube *)p->state;
    (void)x;
    copy(NODES, s->v, s->v0);
    copy(p->n, hx, waveform_window(&s->A));
}

static void tube_release(problem *p)
{
    tube *s = (tube *)p->state;
    waveform_free(&s->p), waveform_free(&s->A);
    free(s->before), free(s->guess), free(s);
}

static void tube_build_regime(problem *p, const regime *how, unsigned long long seed)
{
    tube *s = (tube *)memory(sizeof *s);
    double *area;
    int i;
    s->how = how;
    s->lengths = chance_of(seed, 1), s->noise = chance_of(seed, 2);
    s->p = waveform_make(how->mean ? 0 : 1, NODES, 3 * how->fluids + 1);
    s->A = waveform_make(1 + how->mean, NODES, 3 * how->solids + 1);
    waveform_push(&s->p, 0, 0);
    area = waveform_push(&s->A, 0, 0);
    for (i = 0; i < NODES; i++) area[i] = 1;
    s->before = numbers(how->fluids * NODES), s->guess = numbers(how->solids * NODES);
    for (i = 0; i < NODES; i++) s->v0[i] = 10;
    for (i = 0; i < how->solids * NODES; i++) s->guess[i] = 1;
    p->n = how->solids * NODES;
    p->windows = how->windows, p->columns = how->columns, p->limit = how->limit, p->ends = 1, p->shake = SHAKE;
    p->start = tube_start, p->map = tube_map, p->accept = tube_accept, p->release = tube_release;
    p->state = s;
}

static void tube_build(problem *p, int variant, unsigned long long seed)
{
    tube_build_regime(p, regimes + variant, seed);
}

/* ---- heat ---- */

enum { MODES = 3, DEPTH = 40, ALONG = 10, HEAT_STEPS = 10 };

typedef struct heat_case {
    const char *name;
    double lambda, alpha, window; /* of the first plate, the second has 1, 1; length of a window */
    int steps[2], windows;
    double noise; /* hx_i (1 + noise u), u in [-1, 1] */
    double fade;  /* each mode starts with this part of the one before */
    int grids;    /* SAME: equal steps; EACH_WINDOW: uneven, others in every window; EACH_CALL: in every evaluation */
} heat_case;
enum { SAME, EACH_WINDOW, EACH_CALL };

static const heat_case heat_cases[] = {
    {"1/1", 0.4, 1, 0.1, {1, 1}, 10, 0, 0.5, SAME},
    {"1/1, round-off 1e-14", 0.4, 1, 0.1, {1, 1}, 10, 1e-14, 0.5, SAME},
    {"1/1, round-off 1e-13", 0.4, 1, 0.1, {1, 1}, 10, 1e-13, 0.5, SAME},
    {"1/1, round-off 1e-12", 0.4, 1, 0.1, {1, 1}, 10, 1e-12, 0.5, SAME},
    {"1/1, round-off 1e-11", 0.4, 1, 0.1, {1, 1}, 10, 1e-11, 0.5, SAME},
    {"1/1, round-off 1e-10", 0.4, 1, 0.1, {1, 1}, 10, 1e-10, 0.5, SAME},
    {"1/1, 50 windows", 0.4, 1, 0.1, {1, 1}, 50, 0, 0.5, SAME},
    {"4/4", 0.4, 1, 0.1, {4, 4}, 10, 0, 0.5, SAME},
    {"4/4, round-off 1e-13", 0.4, 1, 0.1, {4, 4}, 10, 1e-13, 0.5, SAME},
    {"4/4, round-off 1e-10", 0.4, 1, 0.1, {4, 4}, 10, 1e-10, 0.5, SAME},
    {"weak modes", 0.4, 10, 0.001, {1, 1}, 10, 0, 1. / 3, SAME},
    {"weak modes, 1e-14", 0.4, 10, 0.001, {1, 1}, 10, 1e-14, 1. / 3, SAME},
    {"weak modes, 1e-12", 0.4, 10, 0.001, {1, 1}, 10, 1e-12, 1. / 3, SAME},
    {"weak modes, 1e-10", 0.4, 10, 0.001, {1, 1}, 10, 1e-10, 1. / 3, SAME},
    {"weak modes, 1e-8", 0.4, 10, 0.001, {1, 1}, 10, 1e-8, 1. / 3, SAME},
    {"weak modes, 4/4", 0.4, 10, 0.001, {4, 4}, 10, 0, 1. / 3, SAME},
    {"3/7", 0.4, 1, 0.1, {3, 7}, 10, 0, 0.5, SAME},
    {"7/4, 50 windows", 0.4, 1, 0.1, {7, 4}, 50, 0, 0.5, SAME},
    {"4/7, uneven, new", 0.4, 1, 0.1, {4, 7}, 10, 0, 0.5, EACH_WINDOW},
    {"new grid in every call", 0.4, 1, 0.1, {4, 4}, 10, 0, 0.5, EACH_CALL},
};
enum { HEAT_CASES = (int)(sizeof heat_cases / sizeof *heat_cases) };

typedef struct heat {
    const heat_case *how;
    double u[2][MODES][DEPTH + 1], now[2][MODES][DEPTH + 1]; /* from the outer end inwards; the last: the interface */
    int steps[2];
    double time[2][HEAT_STEPS + 1];    /* of the steps of either side, from 0 to 1 */
    double flux[MODES * (HEAT_STEPS + 1)], before[MODES * HEAT_STEPS]; /* samples; the first is that of the start */
    double basis[MODES][ALONG], flux0[MODES];
    int window;
    chance noise, grids;
} heat;

/* One step of mode k; side 0 takes the interface temperature and returns the flux, side 1 the reverse. */
static double plate_step(heat *s, int side, int k, double dt, double value)
{
    const double dx = 1. / (DEPTH + 1), lambda = side ? 1 : s->how->lambda, alpha = side ? 1 : s->how->alpha;
    const double a = alpha * dx / dt, l = lambda / dx, y = lambda * dx * (k + 1) * (k + 1) * PI * PI;
    const int n = DEPTH + side;
    double d[DEPTH + 1], b[DEPTH + 1], *u = s->now[side][k], old = u[DEPTH], f;
    int i;
    for (i = 0; i < n; i++) {
        const double half = i == DEPTH ? 0.5 : 1; /* half a cell at the interface */
        d[i] = half * (a + 2 * l + y);
        b[i] = half * a * u[i];
    }
    b[n - 1] += side ? value : l * value;
    for (i = 1; i < n; i++) { /* off the diagonal -l on both sides */
        f = l / d[i - 1];
        d[i] -= f * l;
        b[i] += f * b[i - 1];
    }
    u[n - 1] = b[n - 1] / d[n - 1];
    for (i = n - 2; i >= 0; i--) u[i] = (b[i] + l * u[i + 1]) / d[i];
    if (side) return u[DEPTH];
    u[DEPTH] = value;
    return l * (u[DEPTH - 1] - value) - 0.5 * a * (value - old) - 0.5 * y * value;
}

/* Value at time t of samples MODES apart, linear between the times */
static double sampled(const double *samples, const double *time, int steps, double t)
{
    int j = 0;
    while (j < steps - 1 && time[j + 1] < t) j++;
    return samples[j * MODES] +
           (t - time[j]) / (time[j + 1] - time[j]) * (samples[(j + 1) * MODES] - samples[j * MODES]);
}

/* Equal steps, or steps that differ by up to 40 %; one in every call: also another number of them */
static void heat_grids(heat *s, int grids)
{
    int side, j;
    for (side = 0; side < 2; side++) {
        s->steps[side] = grids == EACH_CALL ? integer(&s->grids, 3, HEAT_STEPS) : s->how->steps[side];
        for (s->time[side][0] = 0, j = 1; j <= s->steps[side]; j++)
            s->time[side][j] = s->time[side][j - 1] + (grids == SAME ? 1 : 1 + 0.4 * uniform(&s->grids));
        for (j = 1; j <= s->steps[side]; j++) s->time[side][j] /= s->time[side][s->steps[side]];
        s->time[side][s->steps[side]] = 1;
    }
}

/* The solution of the case EACH_CALL, linear in time so that every time grid gives it; else 0 */
static double heat_exact(const heat *s, int k, double t)
{
    return s->how->grids == EACH_CALL ? (1 + s->window + t) / (k + 1) : 0;
}

static int heat_criterion(heat *s, ptrdiff_t n, const double *x, const double *hx)
{
    double difference = 0, all = 0;
    int i;
    for (i = 0; i < MODES * s->steps[0]; i++) {
        double d = s->flux[MODES + i] - s->before[i];
        difference += d * d, all += s->flux[MODES + i] * s->flux[MODES + i];
        s->before[i] = s->flux[MODES + i];
    }
    if (s->how->grids == EACH_CALL) return 0;
    return relative_change((int)n, hx, x) <= 1e-8 && sqrt(difference / all) <= 1e-8;
}

/* x on the grid of the host: that of the second plate, but for EACH_CALL, where it is one of equal steps */
static int heat_map(problem *p, const double *x, double *hx)
{
    heat *s = (heat *)p->state;
    const int samples = s->how->steps[1];
    double temperature[MODES * (HEAT_STEPS + 1)], grid[HEAT_STEPS + 1];
    int j, k, i;
    memcpy(grid, s->time[1], sizeof grid);
    for (j = 0; j <= samples && s->how->grids == EACH_CALL; j++) grid[j] = (double)j / samples;
    if (s->how->grids == EACH_CALL) heat_grids(s, EACH_CALL);
    memcpy(s->now, s->u, sizeof s->u);
    memset(hx, 0, (size_t)p->n * sizeof *hx);
    for (k = 0; k < MODES; k++) {
        double *T = temperature + k, *F = s->flux + k;
        T[0] = s->u[1][k][DEPTH];
        F[0] = s->flux0[k];
        for (j = 1; j <= samples; j++)
            T[j * MODES] = product(ALONG, x + (j - 1) * ALONG, s->basis[k]) * 2 / (ALONG + 1) - heat_exact(s, k, grid[j]);
        for (j = 1; j <= s->steps[0]; j++)
            F[j * MODES] = plate_step(s, 0, k, s->how->window * (s->time[0][j] - s->time[0][j - 1]),
                                      sampled(T, grid, samples, s->time[0][j]));
        for (j = 1; j <= s->steps[1]; j++)
            T[j * MODES] = plate_step(s, 1, k, s->how->window * (s->time[1][j] - s->time[1][j - 1]),
                                      sampled(F, s->time[0], s->steps[0], s->time[1][j]));
        for (j = 1; j <= samples; j++)
            add(ALONG, sampled(T, s->time[1], s->steps[1], grid[j]) + heat_exact(s, k, grid[j]), s->basis[k],
                hx + (j - 1) * ALONG);
    }
    for (i = 0; i < p->n && s->how->noise > 0; i++) hx[i] *= 1 + s->how->noise * uniform(&s->noise);
    return heat_criterion(s, p->n, x, hx);
}

static void heat_accept(problem *p, const double *x, const double *hx)
{
    heat *s = (heat *)p->state;
    int k;
    (void)x, (void)hx;
    memcpy(s->u, s->now, sizeof s->u);
    for (k = 0; k < MODES; k++) s->flux0[k] = s->flux[s->steps[0] * MODES + k];
}

/* The guess: what the interface has at the start of the window */
static void heat_start(problem *p, int window, double *x)
{
    heat *s = (heat *)p->state;
    int j, k;
    s->window = window;
    heat_grids(s, s->how->grids);
    memset(x, 0, (size_t)p->n * sizeof *x);
    for (j = 0; j < s->how->steps[1]; j++)
        for (k = 0; k < MODES; k++) add(ALONG, s->u[1][k][DEPTH] + heat_exact(s, k, 0), s->basis[k], x + j * ALONG);
}

static void heat_release(problem *p)
{
    free(p->state);
}

static void heat_build_case(problem *p, const heat_case *how, unsigned long long seed)
{
    heat *s = (heat *)memory(sizeof *s);
    int i, k, side;
    s->how = how;
    s->noise = chance_of(seed, 3), s->grids = chance_of(seed, 4);
    for (k = 0; k < MODES; k++) {
        for (i = 0; i < ALONG; i++) s->basis[k][i] = sin((k + 1) * PI * (i + 1) / (ALONG + 1));
        for (side = 0; side < 2; side++)
            for (i = 0; i <= DEPTH && how->grids != EACH_CALL; i++)
                s->u[side][k][i] = pow(how->fade, k) * sin(0.5 * PI * (i + 1) / (DEPTH + 1));
    }
    p->n = how->steps[1] * ALONG;
    p->windows = how->windows, p->columns = how->steps[0] > 1 ? 100 : 50, p->limit = 120, p->ends = 1, p->shake = SHAKE;
    if (how->grids == EACH_CALL) p->relative = 1e-11;
    p->start = heat_start, p->map = heat_map, p->accept = heat_accept, p->release = heat_release;
    p->state = s;
}

static void heat_build(problem *p, int variant, unsigned long long seed)
{
    heat_build_case(p, heat_cases + variant, seed);
}

#endif
