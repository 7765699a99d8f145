/* SPDX-License-Identifier: MIT

   arena_coupled.h - jobs of users, coupled in time but for the last

   tube     of examples/tube.c, in many regimes
   heat     two plates of depth 1, u = 0 on the outer boundaries, implicit Euler, three sine modes along the interface, so
            that H has rank three in space: the first takes the interface temperature and returns the heat flux, the
            second the reverse.  Converged when temperature and flux of all samples change by less than 1e-8 from one
            evaluation to the next
   pistons  two bodies on springs that stiffen, in a fluid with added mass and drag: the bodies' displacements at the
            samples of a window make accelerations in the fluid, and its forces displacements.  Nothing is tuned on them
   beam     a beam whose tension grows with its deflection, over a channel: the added mass of each sine mode falls with
            its wave number.  Nothing is tuned on it
   charge   a field that screens itself (Poisson-Boltzmann, periodic): long waves slosh, the more the longer the box

   Names end in what the host tells of the run, beyond its limits: see tell. */
#ifndef ARENA_COUPLED_H_INCLUDED
#define ARENA_COUPLED_H_INCLUDED
int tube_main(int argc, char **argv);
#define main tube_main /* the two solvers of the tube, and waveforms of NODES numbers */
#include "../../examples/tube.c"
#undef main
#include "arena.h"

/* "end": the last sample alone is weighted; "IMVJ"; "at once": two fields; "stated": the noise */
static void tell(problem *p, const char *name, int samples, double noise)
{
    p->flags = (strstr(name, "end of") ? END : 0) | (strstr(name, "IMVJ") ? MULTI : 0) | (strstr(name, "at once") ? FIELDS : 0);
    if (p->flags & END) p->blocks = samples;
    if (p->flags & FIELDS) p->blocks = 2;
    if (strstr(name, "stated")) p->noise = noise;
}

/* ---- the tube ---- */

typedef struct regime {
    const char *name;
    int predict, fluids, solids, windows, limit, columns;
    double dt, wall, wall_later; /* factor on the stiffness; from the middle of the run on */
    int lengths;                 /* of windows: 0 equal, 1 in a cycle of three, 2 in a cycle of five, 3 random */
    double contact;              /* compliance beyond A = 1.02, against that before */
    double noise;                /* of |H(x) - answer of the window before|; then A alone is judged */
    int mean;                    /* 1: the solid, one step, has the mean pressure; areas between window ends quadratic */
} regime;

static const regime regimes[] = {
    {"constant guess", 0, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0},
    {"linear guess", 1, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0},
    {"quadratic guess", 2, 1, 1, 100, 60, 50, 0.01, 1, 1, 0, 1, 0, 0},
    {"wall x 3 halfway", 0, 1, 1, 100, 60, 50, 0.01, 1, 3, 0, 1, 0, 0},
    {"wall x 0.6 halfway", 0, 1, 1, 100, 60, 50, 0.01, 1, 0.6, 0, 1, 0, 0},
    {"lengths in a cycle of 3", 0, 1, 1, 30, 120, 50, 0.01, 1, 1, 1, 1, 0, 0},
    {"cycle of 5, wall x 3", 0, 1, 1, 60, 120, 50, 0.01, 1, 3, 2, 1, 0, 0},
    {"random lengths", 0, 1, 1, 60, 120, 50, 0.01, 1, 1, 3, 1, 0, 0},
    {"contact", 0, 1, 1, 60, 150, 50, 0.01, 1, 1, 0, 0.5, 0, 0},
    {"noise 1e-6, A judged", 0, 1, 1, 60, 60, 50, 0.01, 1, 1, 0, 1, 1e-6, 0},
    {"window .01/2", 1, 1, 1, 20, 120, 60, 0.005, 1, 1, 0, 1, 0, 0},
    {"window .01/4", 1, 1, 1, 20, 120, 60, 0.0025, 1, 1, 0, 1, 0, 0},
    {"window .01/8", 1, 1, 1, 20, 120, 60, 0.00125, 1, 1, 0, 1, 0, 0},
    {"sub-steps 1,2", 0, 1, 2, 20, 120, 60, 0.01, 1, 1, 0, 1, 0, 0},
    {"sub-steps 4,1, mean", 0, 4, 1, 40, 60, 50, 0.01, 1, 1, 0, 1, 0, 1},
    {"sub-steps 2,2", 1, 2, 2, 12, 120, 150, 0.01, 1, 1, 0, 1, 0, 0},
    {"sub-steps 4,4", 1, 4, 4, 12, 120, 150, 0.01, 1, 1, 0, 1, 0, 0},
    /* from here on the host tells more */
    {"areas, pressures at once", 1, 1, 1, 40, 120, 100, 0.01, 1, 1, 0, 1, 0, 0},
    {"end of two steps", 0, 1, 2, 20, 120, 60, 0.01, 1, 1, 0, 1, 0, 0},
    {"IMVJ", 1, 1, 1, 40, 120, 400, 0.01, 1, 1, 0, 1, 0, 0},
    {"IMVJ, end of two steps", 0, 1, 2, 20, 120, 400, 0.01, 1, 1, 0, 1, 0, 0},
    {"IMVJ, fields at once", 1, 1, 1, 40, 120, 400, 0.01, 1, 1, 0, 1, 0, 0},
};
#define SHAKE 1e-12 /* far below the tolerances */

typedef struct tube {
    const regime *how;
    waveform p, A;
    double v0[NODES], v[NODES], before[4 * NODES], t1, length;
    chance lengths, noise;
} tube;

static void tube_start(problem *p, int window, double *x)
{
    tube *s = (tube *)p->state;
    static const double cycle[3][5] = {{1}, {1, 0.5, 2}, {1, 0.7, 1.4, 0.6, 2}};
    const int solids = s->how->solids, fluids = s->how->fluids, lengths = s->how->lengths;
    double times[16];
    int j;
    stiffness = 5000 * sqrt(PI) * (2 * window >= p->windows ? s->how->wall_later : s->how->wall);
    s->length = s->how->dt * (lengths == 3 ? between(&s->lengths, 0.6, 2) : cycle[lengths][window % (1 + 2 * lengths)]);
    s->t1 = lengths ? s->t1 + s->length : (window + 1) * s->length;
    DT = s->length / fluids;
    for (j = 0; j < solids; j++) times[j] = substep(s->t1, s->length, j + 1, solids);
    wf_begin(s->A.w, s->how->predict, solids, times, 0);
    copy(solids * NODES, waveform_window(&s->A), x);
    for (j = 0; j < fluids; j++) copy(NODES, wf_column(s->p.w, wf_start(s->p.w)), s->before + j * NODES);
    if (p->flags & FIELDS) copy(fluids * NODES, s->before, x + solids * NODES);
}

static int tube_map(problem *p, const double *x, double *hx)
{
    tube *s = (tube *)p->state;
    const int areas = s->how->solids * NODES, pressures = s->how->fluids * NODES;
    const double *start = wf_column(s->A.w, wf_start(s->A.w));
    double change_p, change_A, size = 0;
    int i;
    copy(areas, x, waveform_window(&s->A));
    if (fluid(s->v0, s->v, s->how->fluids, s->t1, s->length, &s->A, &s->p) != 0) return -1;
    if (p->flags & FIELDS) { /* the solid has the pressures of x */
        copy(pressures, waveform_window(&s->p), hx + areas);
        copy(pressures, x + areas, waveform_window(&s->p)), copy(pressures, x + areas, s->before);
    }
    solid(s->how->solids, s->t1, s->length, s->how->mean, &s->p, hx);
    if (p->flags & FIELDS) copy(pressures, hx + areas, waveform_window(&s->p));
    for (i = 0; i < areas; i++) {
        if (hx[i] > 1.02) hx[i] = 1.02 + s->how->contact * (hx[i] - 1.02);
        size += (hx[i] - start[i % NODES]) * (hx[i] - start[i % NODES]);
    }
    for (i = 0; i < areas && s->how->noise > 0; i++) hx[i] += s->how->noise * sqrt(size / areas) * normal(&s->noise);
    change_p = relative_change(pressures, waveform_window(&s->p), s->before);
    change_A = relative_change(areas, hx, x);
    copy(pressures, waveform_window(&s->p), s->before);
    return (change_p <= 1e-5 || s->how->noise > 0) && change_A <= 1e-5;
}

static void tube_accept(problem *p, const double *hx)
{
    tube *s = (tube *)p->state;
    copy(NODES, s->v, s->v0);
    copy(s->how->solids * NODES, hx, waveform_window(&s->A));
    wf_advance(s->A.w, s->how->mean ? 1 : 2 * s->how->solids);
    wf_advance(s->p.w, 2 * s->how->fluids);
}

static void tube_release(problem *p)
{
    tube *s = (tube *)p->state;
    waveform_free(&s->p), waveform_free(&s->A);
}

static void tube_build(problem *p, int variant, unsigned long long seed)
{
    tube *s = (tube *)memory(sizeof *s);
    const regime *how = regimes + variant;
    double *area;
    int i;
    s->how = how;
    s->lengths = chance_of(seed, 1), s->noise = chance_of(seed, 2);
    s->p = waveform_make(how->mean ? 0 : 1, NODES, 3 * how->fluids + 1);
    s->A = waveform_make(1 + how->mean, NODES, 3 * how->solids + 1);
    waveform_push(&s->p, 0, 0);
    area = waveform_push(&s->A, 0, 0);
    for (i = 0; i < NODES; i++) area[i] = 1, s->v0[i] = 10;
    tell(p, how->name, how->solids, 0);
    p->n = how->solids * NODES + (p->flags & FIELDS ? how->fluids * NODES : 0);
    p->windows = how->windows, p->columns = how->columns, p->limit = how->limit, p->ends = 1, p->shake = SHAKE;
    p->start = tube_start, p->map = tube_map, p->accept = tube_accept, p->release = tube_release, p->state = s;
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
    {"end of 4/4", 0.4, 1, 0.1, {4, 4}, 20, 0, 0.5, SAME}, /* from here on the host tells more */
    {"end of 3/7", 0.4, 1, 0.1, {3, 7}, 20, 0, 0.5, SAME},
    {"4/4, IMVJ", 0.4, 1, 0.1, {4, 4}, 20, 0, 0.5, SAME},
    {"IMVJ, end of 4/4", 0.4, 1, 0.1, {4, 4}, 20, 0, 0.5, SAME},
    {"1/1, 1e-10, stated", 0.4, 1, 0.1, {1, 1}, 10, 1e-10, 0.5, SAME},
    {"4/4, 1e-10, stated", 0.4, 1, 0.1, {4, 4}, 10, 1e-10, 0.5, SAME},
};

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
        d[i] = half * (a + 2 * l + y), b[i] = half * a * u[i];
    }
    b[n - 1] += side ? value : l * value;
    for (i = 1; i < n; i++) { /* off the diagonal -l on both sides */
        f = l / d[i - 1];
        d[i] -= f * l, b[i] += f * b[i - 1];
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

/* x on the grid of the host: that of the second plate, but for EACH_CALL, where it is one of equal steps */
static int heat_map(problem *p, const double *x, double *hx)
{
    heat *s = (heat *)p->state;
    const int samples = s->how->steps[1];
    double temperature[MODES * (HEAT_STEPS + 1)], grid[HEAT_STEPS + 1], change;
    int j, k, i;
    memcpy(grid, s->time[1], sizeof grid);
    for (j = 0; j <= samples && s->how->grids == EACH_CALL; j++) grid[j] = (double)j / samples;
    if (s->how->grids == EACH_CALL) heat_grids(s, EACH_CALL);
    memcpy(s->now, s->u, sizeof s->u);
    memset(hx, 0, (size_t)p->n * sizeof *hx);
    for (k = 0; k < MODES; k++) {
        double *T = temperature + k, *F = s->flux + k;
        T[0] = s->u[1][k][DEPTH], F[0] = s->flux0[k];
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
    change = relative_change(MODES * s->steps[0], s->flux + MODES, s->before);
    memcpy(s->before, s->flux + MODES, sizeof s->before);
    return s->how->grids != EACH_CALL && relative_change((int)p->n, hx, x) <= 1e-8 && change <= 1e-8;
}

static void heat_accept(problem *p, const double *hx)
{
    heat *s = (heat *)p->state;
    int k;
    (void)hx;
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

static void heat_build(problem *p, int variant, unsigned long long seed)
{
    heat *s = (heat *)memory(sizeof *s);
    const heat_case *how = heat_cases + variant;
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
    tell(p, how->name, how->steps[1], how->noise);
    p->start = heat_start, p->map = heat_map, p->accept = heat_accept, p->state = s;
}

/* ---- pistons and beam: modes q with  m q'' + (k + stiffening) q = f,  f = load - added q'' - drag |q'| q' ---- */

enum { BODIES = 40, SAMPLES = 16 };

typedef struct moving {
    double u[BODIES], v[BODIES], fluid[BODIES]; /* velocity of the fluid at the bodies */
} moving;

typedef struct bodies {
    int modes, samples;
    double dt, time, noise, tol;
    double mass, stiff[BODIES], added[BODIES], drag, harden, load[BODIES];
    moving start, now;            /* at the start of the window, and at its end */
    double shape[BODIES][BODIES]; /* orthogonal: what travels are values at points, not modes */
    chance c;
} bodies;

typedef struct bodies_case {
    const char *name;
    int beam, samples, windows;
    double ratio, dt, noise, tol; /* added mass over mass, length of a step, noise of |H(x) - start|, of the change */
} bodies_case;

static const bodies_case bodies_cases[] = {
    {"pistons 10, 1 step", 0, 1, 30, 10, 0.05, 0, 1e-7},
    {"pistons 100, 2 steps", 0, 2, 30, 100, 0.05, 0, 1e-7},
    {"pistons 100, 8 steps", 0, 8, 20, 100, 0.05, 0, 1e-7},
    {"pistons 30, long steps", 0, 4, 20, 30, 0.3, 0, 1e-7},
    {"pistons 100, noise 1e-6", 0, 4, 20, 100, 0.05, 1e-6, 1e-4},
    {"pistons 100, noise 1e-4", 0, 4, 20, 100, 0.05, 1e-4, 1e-2},
    {"beam 10, 1 step", 1, 1, 40, 10, 0.02, 0, 1e-7},
    {"beam 100, 2 steps", 1, 2, 20, 100, 0.02, 0, 1e-7},
    {"beam 100, 4 steps", 1, 4, 20, 100, 0.02, 0, 1e-7},
    {"beam 300, short steps", 1, 2, 20, 300, 0.005, 0, 1e-7},
    {"beam 100, noise 1e-8", 1, 2, 20, 100, 0.02, 1e-8, 1e-6},
    {"beam 100, noise 1e-4", 1, 2, 20, 100, 0.02, 1e-4, 1e-2},
    {"pistons, end of 4 steps", 0, 4, 20, 1, 0.05, 0, 1e-7}, /* from here on the host tells more */
    {"pistons 100, IMVJ", 0, 2, 20, 100, 0.05, 0, 1e-7},
};

/* One implicit Euler step of the solid under the forces f; the stiffening, harden |q|^2, by Newton's method. */
static void bodies_solid(const bodies *s, const double *f, double *u, double *v)
{
    const double dt = s->dt, inertia = s->mass / (dt * dt);
    double tension = 0, g, slope, d, old[BODIES], e;
    int i, k;
    copy(s->modes, u, old);
    for (i = 0; i < s->modes; i++) tension += s->harden * old[i] * old[i];
    for (k = 0; k < 100; k++) { /* g(tension) = harden |q(tension)|^2 - tension, falling and convex */
        for (g = -tension, slope = -1, i = 0; i < s->modes; i++) {
            e = (double)(i + 1) * (i + 1), d = inertia + s->stiff[i] + tension * e;
            u[i] = (f[i] + inertia * (old[i] + dt * v[i])) / d;
            g += s->harden * e * u[i] * u[i];
            slope -= 2 * s->harden * e * u[i] * u[i] * e / d;
        }
        tension -= g / slope;
        if (fabs(g) <= 1e-14 * (1 + tension)) break;
    }
    for (i = 0; i < s->modes; i++) v[i] = (u[i] - old[i]) / dt;
}

static int bodies_map(problem *p, const double *x, double *hx)
{
    bodies *s = (bodies *)p->state;
    double before[BODIES], f[BODIES], size = 0, change = 0;
    const int n = s->modes;
    int i, j, k;
    s->now = s->start;
    copy(n, s->start.u, before);
    for (j = 0; j < s->samples; j++) {
        for (i = 0; i < n; i++) {
            double v, q = 0;
            for (k = 0; k < n; k++) q += s->shape[i][k] * x[j * n + k];
            v = (q - before[i]) / s->dt;
            f[i] = s->load[i] * sin(3 * (s->time + (j + 1) * s->dt) + i) -
                   s->added[i] * (v - s->now.fluid[i]) / s->dt - s->drag * fabs(v) * v;
            before[i] = q, s->now.fluid[i] = v;
        }
        bodies_solid(s, f, s->now.u, s->now.v);
        for (k = 0; k < n; k++)
            for (hx[j * n + k] = 0, i = 0; i < n; i++) hx[j * n + k] += s->shape[i][k] * s->now.u[i];
    }
    for (j = 0; j < s->samples; j++)
        for (k = 0; k < n; k++) {
            double start = 0;
            for (i = 0; i < n; i++) start += s->shape[i][k] * s->start.u[i];
            size += (hx[j * n + k] - start) * (hx[j * n + k] - start);
        }
    for (i = 0; i < p->n && s->noise > 0; i++) hx[i] += s->noise * sqrt(size / (double)p->n) * normal(&s->c);
    for (i = 0; i < p->n; i++) change += (hx[i] - x[i]) * (hx[i] - x[i]);
    return sqrt(change) <= s->tol * sqrt(size);
}

static void bodies_accept(problem *p, const double *hx)
{
    bodies *s = (bodies *)p->state;
    (void)hx;
    s->start = s->now;
    s->time += s->samples * s->dt;
}

/* Constant velocity */
static void bodies_start(problem *p, int window, double *x)
{
    bodies *s = (bodies *)p->state;
    int i, j, k;
    (void)window;
    memset(x, 0, (size_t)p->n * sizeof *x);
    for (j = 0; j < s->samples; j++)
        for (k = 0; k < s->modes; k++)
            for (i = 0; i < s->modes; i++) x[j * s->modes + k] += s->shape[i][k] * (s->start.u[i] + (j + 1) * s->dt * s->start.v[i]);
}

static void bodies_build(problem *p, int variant, unsigned long long seed)
{
    const bodies_case *how = bodies_cases + variant;
    bodies *s = (bodies *)memory(sizeof *s);
    int i, k, n;
    s->c = chance_of(seed, 50 + (unsigned long long)variant);
    s->samples = how->samples, s->noise = how->noise, s->tol = how->tol;
    s->dt = how->dt * between(&s->c, 0.7, 1.4);
    s->modes = n = how->beam ? BODIES : 2;
    s->mass = 1, s->drag = 0.2 * how->ratio, s->harden = how->beam ? 3000 : 100;
    for (i = 0; i < n; i++) {
        const double wave = i + 1;
        s->stiff[i] = (how->beam ? 10 * wave * wave * wave * wave : 40 * wave) * between(&s->c, 0.8, 1.25);
        s->added[i] = how->ratio * (how->beam ? 1 / (wave * tanh(0.5 * wave)) * tanh(0.5) : between(&s->c, 0.3, 1));
        s->load[i] = how->ratio * between(&s->c, 0.5, 1.5) / (wave * wave);
        for (k = 0; k < n; k++) s->shape[i][k] = sqrt(2. / (n + 1)) * sin((i + 1) * (k + 1) * PI / (n + 1));
    }
    p->n = n * s->samples;
    tell(p, how->name, s->samples, 0);
    p->windows = how->windows, p->columns = 50, p->limit = 100, p->ends = 1;
    p->start = bodies_start, p->map = bodies_map, p->accept = bodies_accept, p->state = s;
}

/* ---- charge: rho = exp(potential of the ions - V), V'' = -(rho - mean), periodic; x = log of rho ---- */

typedef struct charge {
    ptrdiff_t n;
    double box, ions[400], work[400];
} charge;

/* V'' = -(rho - mean) on n points of a ring, mean of V zero */
static void poisson(ptrdiff_t n, double box, const double *rho, double *V)
{
    const double h = box / (double)n;
    double mean = 0, field = 0, sum = 0, tilt;
    ptrdiff_t i;
    for (i = 0; i < n; i++) mean += rho[i] / (double)n;
    for (V[0] = 0, i = 1; i < n; i++) {
        V[i] = V[i - 1] + h * field;
        field -= h * (rho[i] - mean);
    }
    tilt = (V[n - 1] + h * field) / (double)n; /* V must come back to V[0] */
    for (i = 0; i < n; i++) V[i] -= tilt * (double)i;
    for (i = 0; i < n; i++) sum += V[i] / (double)n;
    for (i = 0; i < n; i++) V[i] -= sum;
}

static int charge_map(problem *p, const double *x, double *hx)
{
    charge *s = (charge *)p->state;
    double sum = 0;
    ptrdiff_t i;
    poisson(s->n, s->box, x, s->work);
    for (i = 0; i < s->n; i++) {
        hx[i] = exp(s->ions[i] - s->work[i]);
        sum += hx[i] / (double)s->n;
    }
    for (i = 0; i < s->n; i++) hx[i] /= sum;
    return 0;
}

static void charge_start(problem *p, int window, double *x)
{
    ptrdiff_t i;
    (void)window;
    for (i = 0; i < p->n; i++) x[i] = 1;
}

/* variant: length of the box */
static void charge_build(problem *p, int variant, unsigned long long seed)
{
    charge *s = (charge *)memory(sizeof *s);
    chance c = chance_of(seed, 90);
    ptrdiff_t i;
    int k;
    s->n = integer(&c, 64, 400), s->box = variant;
    for (k = 1; k <= 6; k++) {
        const double size = normal(&c) / k, phase = PI * uniform(&c);
        for (i = 0; i < s->n; i++) s->ions[i] += 0.5 * size * sin(2 * PI * k * (double)i / (double)s->n + phase);
    }
    p->n = s->n, p->windows = 1, p->columns = 30, p->limit = 120, p->relative = 1e-9;
    p->start = charge_start, p->map = charge_map, p->state = s;
}

#endif
