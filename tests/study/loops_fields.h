/* SPDX-License-Identifier: MIT

   loops_fields.h - hosts' own loops, first half: fields on grids and flows in networks.  Every kind has a state that a
   window starts from, loads that change from window to window, at least one kink, and a map H that leaves the state alone;
   plain iteration or a constant damping answers nearly every window. */
#ifndef LOOPS_FIELDS_H_INCLUDED
#define LOOPS_FIELDS_H_INCLUDED
#include "loops_kit.h"

enum { CELLS = 256, BAND = 17 };

/* ---- aquifer: unconfined, drains above their elevation alone, cells that nearly fall dry; x: heads by A(h) h = b ---- */

typedef struct aquifer {
    int side;
    double old[CELLS], bottom[CELLS], drain[CELLS], K, river, dt, rain, pumping;
    course rains, wells;
} aquifer;

static double saturated(const aquifer *s, const double *h, int c)
{
    return fmax(h[c] - s->bottom[c], 0.05);
}

static int aquifer_map(problem *p, const double *h, double *hx)
{
    aquifer *s = (aquifer *)p->state;
    const int m = s->side, n = m * m;
    double A[CELLS * BAND];
    int c, k;
    memset(A, 0, sizeof A);
    for (c = 0; c < n; c++) {
        const double storage = 200 / s->dt;
        A[c * (m + 1)] += storage;
        hx[c] = storage * s->old[c] + s->rain * 1e4;
        if (c % m == 0) {
            A[c * (m + 1)] += 2 * s->K * saturated(s, h, c);
            hx[c] += 2 * s->K * saturated(s, h, c) * s->river;
        }
        if (s->drain[c] > 0 && h[c] > s->drain[c]) {
            A[c * (m + 1)] += 400;
            hx[c] += 400 * s->drain[c];
        }
        if (c == (m / 2) * (m + 1)) hx[c] -= s->pumping;
        for (k = 1; k <= m; k += m - 1) { /* the neighbours at c + 1 and c + m */
            const double a = saturated(s, h, c), b = c + k < n ? saturated(s, h, c + k) : 1;
            const double flow = s->K * 2 * a * b / (a + b);
            if (c + k >= n || (k == 1 && c % m == m - 1)) continue;
            A[c * (m + 1)] += flow;
            A[(c + k) * (m + 1)] += flow;
            A[c * (m + 1) + k] -= flow;
        }
    }
    return solve_band(n, m, A, hx);
}

static void aquifer_start(problem *p, int window, double *x)
{
    aquifer *s = (aquifer *)p->state;
    if (window == 0) fill(p->n, 12, x);
    copy(p->n, x, s->old);
    s->dt = window % 4 == 0 ? 3 : s->dt * 1.5;
    s->rain = fmax(0, 2e-3 * (course_at(&s->rains, window) - 0.5));
    s->pumping = 150 * fmax(0, course_at(&s->wells, window));
}

static void aquifer_build(problem *p, int variant, unsigned long long seed)
{
    aquifer *s = (aquifer *)memory(sizeof *s);
    chance c = chance_of(seed, 200);
    int i, every;
    (void)variant;
    s->side = integer(&c, 8, 14);
    every = integer(&c, 3, 5);
    s->K = between(&c, 2, 6);
    s->river = between(&c, 11, 13);
    s->rains = course_of(&c, 0.8, 0.6);
    s->wells = course_of(&c, 0.5, 0.5);
    for (i = 0; i < s->side * s->side; i++) {
        s->bottom[i] = 4 * (1 + uniform(&c));
        s->drain[i] = (i / s->side) % every == 1 ? 12.5 + 0.1 * (i % s->side) : 0;
    }
    host_is(p, s, s->side * s->side, 1e-7);
    p->start = aquifer_start;
    p->map = aquifer_map;
}

/* ---- drainage: manholes in a tree of pipes; flows by depth, surcharge above the crown; x: depths ---- */

enum { HOLES = 24 };

typedef struct drainage {
    int n, below[HOLES];
    double old[HOLES], flow[HOLES], fall[HOLES], wide[HOLES], inflow[HOLES], dt;
    course storm;
} drainage;

/* Flow of the pipe below hole i for the depths d, from its old flow, friction at the old flow */
static double pipe_flow(const drainage *s, const double *d, int i)
{
    const double there = s->below[i] < 0 ? 0.1 : d[s->below[i]];
    const double mean = fmax(0.5 * (d[i] + there), 0.01), area = s->wide[i] * fmin(mean, 1);
    const double slope = s->fall[i] + (d[i] - there) / 50;
    const double friction = 0.02 * fabs(s->flow[i]) / (area * area * pow(fmin(mean, 1), 1.3));
    return (s->flow[i] + s->dt * 9.81 * area * slope) / (1 + s->dt * friction);
}

static int drainage_map(problem *p, const double *x, double *hx)
{
    drainage *s = (drainage *)p->state;
    double gain[HOLES];
    int i;
    copy(p->n, s->inflow, gain);
    for (i = 0; i < s->n; i++) {
        const double q = pipe_flow(s, x, i);
        gain[i] -= q;
        if (s->below[i] >= 0) gain[s->below[i]] += q;
    }
    for (i = 0; i < s->n; i++) {
        const double surface = x[i] < 1 ? 10 + 30 * s->wide[i] : 10; /* the pipe's surface counts below its crown */
        hx[i] = fmax(0.01, s->old[i] + s->dt * gain[i] / surface);
    }
    return 0;
}

static void drainage_start(problem *p, int window, double *x)
{
    drainage *s = (drainage *)p->state;
    int i;
    if (window == 0) fill(p->n, 0.3, x);
    copy(p->n, x, s->old);
    for (i = 0; i < s->n; i++) s->inflow[i] = 0.05 * fmax(0.1, course_at(&s->storm, window)) * (1 + 0.3 * sin(i));
}

static void drainage_accept(problem *p, const double *hx)
{
    drainage *s = (drainage *)p->state;
    double q[HOLES];
    int i;
    for (i = 0; i < s->n; i++) q[i] = pipe_flow(s, hx, i);
    copy(p->n, q, s->flow);
}

static void drainage_build(problem *p, int variant, unsigned long long seed)
{
    drainage *s = (drainage *)memory(sizeof *s);
    chance c = chance_of(seed, 201);
    int i;
    (void)variant;
    s->n = integer(&c, 8, HOLES);
    s->dt = between(&c, 5, 12);
    s->storm = course_of(&c, 0.9, 1.5);
    for (i = 0; i < s->n; i++) {
        s->below[i] = i == 0 ? -1 : integer(&c, i > 3 ? i - 3 : 0, i - 1);
        s->fall[i] = between(&c, 0.001, 0.008);
        s->wide[i] = between(&c, 0.5, 1.5);
    }
    host_is(p, s, s->n, 1e-6);
    p->start = drainage_start;
    p->map = drainage_map;
    p->accept = drainage_accept;
}

/* ---- furnace: walls that radiate to each other, T^4, cooled behind; a spray opens above a temperature; x: T / 1000 K ---- */

enum { WALLS = 20 };

typedef struct furnace {
    int n;
    double see[WALLS][WALLS], radiates, behind[WALLS], burner[WALLS], heat[WALLS], spray;
    course fire;
} furnace;

static int furnace_map(problem *p, const double *x, double *hx)
{
    furnace *s = (furnace *)p->state;
    int i, j;
    for (i = 0; i < s->n; i++) {
        double net = pow(fmax(x[i], 0), 4), k = 1;
        for (j = 0; j < s->n; j++) net -= s->see[i][j] * pow(fmax(x[j], 0), 4);
        if (x[i] > s->spray) k = 1 + 5 * (x[i] - s->spray); /* conductance behind the wall */
        hx[i] = s->behind[i] + (s->heat[i] - s->radiates * net) / k;
    }
    return 0;
}

static void furnace_start(problem *p, int window, double *x)
{
    furnace *s = (furnace *)p->state;
    int i;
    if (window == 0) fill(p->n, 0.8, x);
    for (i = 0; i < s->n; i++) s->heat[i] = s->burner[i] * fmax(0.1, course_at(&s->fire, window + i / 5));
}

static void furnace_build(problem *p, int variant, unsigned long long seed)
{
    furnace *s = (furnace *)memory(sizeof *s);
    chance c = chance_of(seed, 202);
    int i, j;
    (void)variant;
    s->n = integer(&c, 4, WALLS);
    s->radiates = between(&c, 0.1, 0.4);
    s->spray = between(&c, 0.9, 1.2);
    s->fire = course_of(&c, 0.5, 0.4);
    for (i = 0; i < s->n; i++) {
        double sum = 0;
        for (j = 0; j < s->n; j++) sum += s->see[i][j] = i == j ? 0 : between(&c, 0.2, 1);
        for (j = 0; j < s->n; j++) s->see[i][j] *= 0.9 / sum;
        s->behind[i] = between(&c, 0.3, 0.5);
        s->burner[i] = i % 3 == 0 ? between(&c, 0.2, 0.7) : 0.1;
    }
    host_is(p, s, s->n, 1e-7);
    p->start = furnace_start;
    p->map = furnace_map;
}

/* ---- thermoelectric: a rod with a current; conductivity falls with T, more behind a transition; x: T ---- */

enum { ROD = 40 };

typedef struct rod {
    int n;
    double old[ROD], current, conducts, dt, transition, drop;
    course currents;
} rod;

static int rod_map(problem *p, const double *x, double *hx)
{
    rod *s = (rod *)p->state;
    double below[ROD], diagonal[ROD], above[ROD];
    int i;
    for (i = 0; i < s->n; i++) {
        const double hot = fmax(0, x[i] - s->transition);
        const double resistance = 1 + 0.5 * x[i] + s->drop * fmin(hot, 0.5);
        const double k = s->conducts * s->n * s->n / (1 + 0.3 * fmax(x[i], 0)); /* of the last iterate */
        below[i] = above[i] = -k;
        diagonal[i] = 1 / s->dt + 2 * k + 1;
        hx[i] = s->old[i] / s->dt + s->current * s->current * resistance;
    }
    return solve_tridiagonal(s->n, below, diagonal, above, hx);
}

static void rod_start(problem *p, int window, double *x)
{
    rod *s = (rod *)p->state;
    copy(p->n, x, s->old);
    s->current = fmax(0, course_at(&s->currents, window));
}

static void rod_build(problem *p, int variant, unsigned long long seed)
{
    rod *s = (rod *)memory(sizeof *s);
    chance c = chance_of(seed, 203);
    (void)variant;
    s->n = integer(&c, 12, ROD);
    s->conducts = between(&c, 0.01, 0.05);
    s->dt = between(&c, 0.2, 0.8);
    s->transition = between(&c, 0.5, 1.2);
    s->drop = between(&c, 0.5, 2);
    s->currents = course_of(&c, 0.4, 0.3);
    host_is(p, s, s->n, 1e-8);
    p->start = rod_start;
    p->map = rod_map;
}

/* ---- switching: a wall whose conductivity changes over a narrow range of T; conductivities of the last iterate; x: T ---- */

typedef struct switching {
    int n;
    double at, narrow, factor, sources[ROD], source, end;
    course powers;
} switching;

static int switching_map(problem *p, const double *x, double *hx)
{
    switching *s = (switching *)p->state;
    double below[ROD], diagonal[ROD], above[ROD], k[ROD + 1];
    int i;
    for (i = 0; i <= s->n; i++) { /* between cells i - 1 and i; both ends have their T */
        const double T = 0.5 * ((i > 0 ? x[i - 1] : 0) + (i < s->n ? x[i] : s->end));
        k[i] = 1 + (s->factor - 1) * clamp((T - s->at) / s->narrow, 0, 1);
    }
    for (i = 0; i < s->n; i++) {
        diagonal[i] = k[i] + k[i + 1];
        above[i] = -k[i + 1];
        if (i > 0) below[i - 1] = -k[i];
        hx[i] = s->source * s->sources[i] / (s->n * s->n) + (i == s->n - 1 ? k[s->n] * s->end : 0);
    }
    return solve_tridiagonal(s->n, below, diagonal, above, hx);
}

static void switching_start(problem *p, int window, double *x)
{
    switching *s = (switching *)p->state;
    (void)x;
    s->source = 8 * course_at(&s->powers, window);
    s->end = 0.5 + 0.3 * sin(window);
}

static void switching_build(problem *p, int variant, unsigned long long seed)
{
    switching *s = (switching *)memory(sizeof *s);
    chance c = chance_of(seed, 212);
    int i;
    (void)variant;
    s->n = integer(&c, 8, ROD);
    s->at = between(&c, 0.3, 0.8);
    s->narrow = between(&c, 0.02, 0.3);
    s->factor = between(&c, 0.3, 3);
    s->powers = course_of(&c, 0.5, 0.5);
    for (i = 0; i < s->n; i++) s->sources[i] = between(&c, 0.2, 1.8);
    host_is(p, s, s->n, 1e-7);
    p->start = switching_start;
    p->map = switching_map;
}

/* ---- magnet: a chain of saturating iron and gaps; mu of the last iterate, fields, mu again; x: log mu ---- */

typedef struct magnet {
    int n;
    double knee[ROD], gap[ROD], coil[ROD], drive;
    course currents;
} magnet;

static int magnet_map(problem *p, const double *x, double *hx)
{
    magnet *s = (magnet *)p->state;
    double below[ROD], diagonal[ROD], above[ROD], potential[ROD];
    int i;
    for (i = 0; i < s->n; i++) { /* flux through iron i of nodes i and i + 1; node n is 0; leakage at each node */
        const double a = exp(x[i]), b = i > 0 ? exp(x[i - 1]) : 0;
        diagonal[i] = a + b + s->gap[i];
        above[i] = -a;
        if (i > 0) below[i - 1] = -b;
        potential[i] = s->drive * (a * s->coil[i] - (i > 0 ? b * s->coil[i - 1] : 0));
    }
    if (solve_tridiagonal(s->n, below, diagonal, above, potential) < 0) return -1;
    for (i = 0; i < s->n; i++) {
        const double H = fabs(s->drive * s->coil[i] - potential[i] + (i + 1 < s->n ? potential[i + 1] : 0));
        const double B = H < s->knee[i] ? 20 * H : 20 * s->knee[i] + 0.5 * (H - s->knee[i]); /* a knee */
        hx[i] = log(B / fmax(H, 1e-12) + 0.01);
    }
    return 0;
}

static void magnet_start(problem *p, int window, double *x)
{
    magnet *s = (magnet *)p->state;
    if (window == 0) fill(p->n, 1, x);
    s->drive = 0.1 + fabs(course_at(&s->currents, window));
}

static void magnet_build(problem *p, int variant, unsigned long long seed)
{
    magnet *s = (magnet *)memory(sizeof *s);
    chance c = chance_of(seed, 204);
    int i;
    (void)variant;
    s->n = integer(&c, 6, 30);
    s->currents = course_of(&c, 0.6, 0.5);
    for (i = 0; i < s->n; i++) {
        s->knee[i] = between(&c, 0.05, 0.3);
        s->gap[i] = between(&c, 0.2, 2);
        s->coil[i] = i % 3 == 0 ? between(&c, 0.5, 1.5) : 0;
    }
    host_is(p, s, s->n, 1e-7);
    p->start = magnet_start;
    p->map = magnet_map;
}

/* ---- freezing: conduction with latent heat over a narrow range of T, liquid part of the last iterate; x: T ---- */

typedef struct freezing {
    int n;
    double old[ROD], latent, range, conducts, dt, outside;
    course weather;
} freezing;

static double liquid(const freezing *s, double T)
{
    return clamp(T / s->range, 0, 1);
}

static int freezing_map(problem *p, const double *x, double *hx)
{
    freezing *s = (freezing *)p->state;
    double below[ROD], diagonal[ROD], above[ROD];
    const double k = s->conducts * s->n * s->n;
    int i;
    for (i = 0; i < s->n; i++) {
        below[i] = above[i] = -k;
        diagonal[i] = 1 / s->dt + k * (i == s->n - 1 ? 1 : 2);
        hx[i] = (s->old[i] - s->latent * (liquid(s, x[i]) - liquid(s, s->old[i]))) / s->dt;
    }
    hx[0] += k * s->outside;
    return solve_tridiagonal(s->n, below, diagonal, above, hx);
}

static void freezing_start(problem *p, int window, double *x)
{
    freezing *s = (freezing *)p->state;
    if (window == 0) fill(p->n, 1, x);
    copy(p->n, x, s->old);
    s->outside = -2 + 4 * (course_at(&s->weather, window) - 1);
}

static void freezing_build(problem *p, int variant, unsigned long long seed)
{
    freezing *s = (freezing *)memory(sizeof *s);
    chance c = chance_of(seed, 205);
    (void)variant;
    s->n = integer(&c, 10, ROD);
    s->latent = between(&c, 0.5, 4);
    s->range = between(&c, 0.8, 2);
    s->conducts = between(&c, 0.01, 0.05);
    s->dt = between(&c, 0.3, 1.5);
    s->weather = course_of(&c, 0.7, 0.5);
    host_is(p, s, s->n, 1e-6);
    p->start = freezing_start;
    p->map = freezing_map;
}

/* ---- infiltration: Richards in a column, K and capacity of the last iterate, ponding at the top; x: pressure heads ---- */

typedef struct infiltration {
    int n;
    double old[ROD], alpha[ROD], dt, rain;
    course rains;
} infiltration;

static double wet(const infiltration *s, int i, double h) /* water content */
{
    return h < 0 ? 0.05 + 0.35 * exp(s->alpha[i] * h) : 0.4;
}

static double passes(const infiltration *s, int i, double h) /* conductivity */
{
    return exp(1.5 * s->alpha[i] * fmin(h, 0));
}

static int infiltration_map(problem *p, const double *x, double *hx)
{
    infiltration *s = (infiltration *)p->state;
    double below[ROD], diagonal[ROD], above[ROD];
    const double dz = 2. / s->n;
    int i;
    for (i = 0; i < s->n; i++) {
        const double capacity = 1e-3 + (x[i] < 0 ? 0.35 * s->alpha[i] * exp(s->alpha[i] * x[i]) : 0);
        const double up = i > 0 ? 0.5 * (passes(s, i, x[i]) + passes(s, i - 1, x[i - 1])) : 0;
        const double down = i + 1 < s->n ? 0.5 * (passes(s, i, x[i]) + passes(s, i + 1, x[i + 1])) : passes(s, i, x[i]);
        diagonal[i] = capacity * dz / s->dt + (up + (i + 1 < s->n ? down : 0)) / dz;
        above[i] = -down / dz;
        if (i > 0) below[i - 1] = -up / dz;
        hx[i] = (capacity * x[i] - (wet(s, i, x[i]) - wet(s, i, s->old[i]))) * dz / s->dt + up - down;
    }
    hx[0] += s->rain;
    if (x[0] > 0) diagonal[0] += 5; /* ponds, and runs off */
    return solve_tridiagonal(s->n, below, diagonal, above, hx);
}

static void infiltration_start(problem *p, int window, double *x)
{
    infiltration *s = (infiltration *)p->state;
    if (window == 0) fill(p->n, -1, x);
    copy(p->n, x, s->old);
    s->rain = fmax(0, 0.3 * course_at(&s->rains, window));
}

static void infiltration_build(problem *p, int variant, unsigned long long seed)
{
    infiltration *s = (infiltration *)memory(sizeof *s);
    chance c = chance_of(seed, 206);
    int i;
    (void)variant;
    s->n = integer(&c, 12, ROD);
    s->dt = between(&c, 0.02, 0.08);
    s->rains = course_of(&c, 1, 1);
    for (i = 0; i < s->n; i++) s->alpha[i] = i < s->n / 2 ? 1.5 : between(&c, 1, 3);
    host_is(p, s, s->n, 1e-6);
    p->start = infiltration_start;
    p->map = infiltration_map;
}

/* ---- obstacle: a membrane over a moving obstacle, a sweep of projected Gauss-Seidel is H; x: deflections ---- */

typedef struct obstacle {
    int side;
    double push[CELLS], load, height, at;
    course loads, heights;
} obstacle;

static int obstacle_map(problem *p, const double *x, double *hx)
{
    obstacle *s = (obstacle *)p->state;
    const int m = s->side;
    int i, j;
    copy(p->n, x, hx);
    for (i = 0; i < m; i++)
        for (j = 0; j < m; j++) {
            const double round = (i - s->at) * (i - s->at) + (j - m / 2.) * (j - m / 2.);
            double sum = s->load * s->push[i * m + j];
            sum += (i > 0 ? hx[(i - 1) * m + j] : 0) + (i + 1 < m ? hx[(i + 1) * m + j] : 0);
            sum += (j > 0 ? hx[i * m + j - 1] : 0) + (j + 1 < m ? hx[i * m + j + 1] : 0);
            hx[i * m + j] = fmax(sum / 4, s->height - 4 * round / (m * m));
        }
    return 0;
}

static void obstacle_start(problem *p, int window, double *x)
{
    obstacle *s = (obstacle *)p->state;
    (void)x;
    s->load = 4 * course_at(&s->loads, window) / (s->side * s->side);
    s->height = 0.5 * course_at(&s->heights, window);
    s->at = s->side * (0.3 + 0.04 * window);
}

static void obstacle_build(problem *p, int variant, unsigned long long seed)
{
    obstacle *s = (obstacle *)memory(sizeof *s);
    chance c = chance_of(seed, 207);
    int i;
    (void)variant;
    s->side = integer(&c, 6, 14);
    s->loads = course_of(&c, 1, 0.5);
    s->heights = course_of(&c, 0.3, 0.3);
    for (i = 0; i < s->side * s->side; i++) s->push[i] = uniform(&c);
    host_is(p, s, s->side * s->side, 1e-6);
    p->start = obstacle_start;
    p->map = obstacle_map;
}

/* ---- circulation: a closed loop, heated below and cooled above; flow by buoyancy, then temperatures carried by it; the
   flow turns round; x: temperatures ---- */

typedef struct circulation {
    int n;
    double old[ROD], dt, friction, lift, power, cooling;
    course powers;
} circulation;

static int circulation_map(problem *p, const double *x, double *hx)
{
    circulation *s = (circulation *)p->state;
    const int n = s->n;
    double A[ROD * ROD], buoyancy = 0, flow;
    int i;
    memset(A, 0, sizeof A);
    for (i = 0; i < n; i++) buoyancy += s->lift * x[i] * cos(6.28318530717959 * (i + 0.5) / n) / n;
    /* friction flow + |flow| flow = buoyancy */
    flow = 2 * buoyancy / (s->friction + sqrt(s->friction * s->friction + 4 * fabs(buoyancy)));
    for (i = 0; i < n; i++) {
        const double turn = 6.28318530717959 * (i + 0.5) / n, carried = n * fabs(flow);
        const double heat = sin(turn + 0.4) > 0.7 ? s->power : 0, cool = sin(turn + 0.4) < -0.7 ? s->cooling : 0;
        const int from = (i + (flow > 0 ? n - 1 : 1)) % n;
        A[i + n * i] = 1 / s->dt + carried + cool;
        A[i + n * from] -= carried;
        hx[i] = s->old[i] / s->dt + heat;
    }
    return solve_dense(n, A, hx);
}

static void circulation_start(problem *p, int window, double *x)
{
    circulation *s = (circulation *)p->state;
    int i;
    for (i = 0; window == 0 && i < s->n; i++) x[i] = 1 + 0.1 * cos(i);
    copy(p->n, x, s->old);
    s->power = 3 * fmax(0.1, course_at(&s->powers, window));
}

static void circulation_build(problem *p, int variant, unsigned long long seed)
{
    circulation *s = (circulation *)memory(sizeof *s);
    chance c = chance_of(seed, 208);
    (void)variant;
    s->n = integer(&c, 8, 20);
    s->dt = between(&c, 0.05, 0.3);
    s->friction = between(&c, 0.4, 1.2);
    s->lift = between(&c, 0.5, 2);
    s->cooling = between(&c, 2, 6);
    s->powers = course_of(&c, 0.6, 0.6);
    host_is(p, s, s->n, 1e-7);
    p->start = circulation_start;
    p->map = circulation_map;
}

/* ---- feeder: constant powers on a radial network, a backward and a forward sweep; loads are shed at low voltage; x:
   voltages, real and imaginary ---- */

enum { BUSES = 30 };

typedef struct feeder {
    int n, parent[BUSES];
    double r[BUSES], x[BUSES], P[BUSES], Q[BUSES], load;
    course loads;
} feeder;

static int feeder_map(problem *p, const double *v, double *hx)
{
    feeder *s = (feeder *)p->state;
    double I[2 * BUSES];
    int i;
    for (i = 0; i < s->n; i++) { /* I = conj(S / V) */
        const double a = v[2 * i], b = v[2 * i + 1], square = fmax(a * a + b * b, 1e-2);
        const double served = s->load * clamp((sqrt(square) - 0.5) / 0.2, 0, 1); /* shed from .7 to .5 */
        I[2 * i] = served * (s->P[i] * a + s->Q[i] * b) / square;
        I[2 * i + 1] = served * (s->P[i] * b - s->Q[i] * a) / square;
    }
    for (i = s->n - 1; i > 0; i--) {
        I[2 * s->parent[i]] += I[2 * i];
        I[2 * s->parent[i] + 1] += I[2 * i + 1];
    }
    for (i = 0; i < s->n; i++) {
        const double *from = i > 0 ? hx + 2 * s->parent[i] : NULL;
        hx[2 * i] = (from ? from[0] : 1) - s->r[i] * I[2 * i] + s->x[i] * I[2 * i + 1];
        hx[2 * i + 1] = (from ? from[1] : 0) - s->r[i] * I[2 * i + 1] - s->x[i] * I[2 * i];
    }
    return 0;
}

static void feeder_start(problem *p, int window, double *x)
{
    feeder *s = (feeder *)p->state;
    int i;
    for (i = 0; window == 0 && i < s->n; i++) x[2 * i] = 1;
    s->load = fmax(0.1, course_at(&s->loads, window));
}

static void feeder_build(problem *p, int variant, unsigned long long seed)
{
    feeder *s = (feeder *)memory(sizeof *s);
    chance c = chance_of(seed, 209);
    double stress;
    int i;
    (void)variant;
    s->n = integer(&c, 6, BUSES);
    stress = between(&c, 0.2, 0.7);
    s->loads = course_of(&c, 0.3, 0.4);
    for (i = 0; i < s->n; i++) {
        s->parent[i] = i == 0 ? 0 : integer(&c, i > 2 ? i - 2 : 0, i - 1);
        s->r[i] = between(&c, 0.3, 1) / s->n;
        s->x[i] = between(&c, 0.3, 1) / s->n;
        s->P[i] = stress * between(&c, 0.2, 1) / s->n;
        s->Q[i] = 0.4 * s->P[i];
    }
    host_is(p, s, 2 * s->n, 1e-8);
    p->start = feeder_start;
    p->map = feeder_map;
}

/* ---- recycle: feed and recycle into a reactor, a separator, a purge that opens when inerts pile up; x: flows of the
   recycle A, B, inert, and its temperature ---- */

typedef struct recycle {
    double rate, energy, rise, split[3], purge, cooler, feed;
    course feeds;
} recycle;

static int recycle_map(problem *p, const double *x, double *hx)
{
    recycle *s = (recycle *)p->state;
    const double A = s->feed + x[0], B = x[1], inert = 0.05 * s->feed + x[2], total = fmax(A + B + inert, 1e-6);
    const double inlet = (s->feed + fmax(total - s->feed, 0) * x[3]) / total; /* the feed has 1 */
    double T = inlet, converted = 0, kept;
    int k;
    for (k = 0; k < 60; k++) { /* the reactor itself: bisected would do, its own damped loop does */
        const double speed = s->rate * exp(s->energy * (1 - 1 / fmax(T, 0.3)));
        converted = speed / (total / s->feed + speed);
        T = 0.5 * T + 0.5 * (inlet + s->rise * converted * A / total);
    }
    kept = 1 - (inert / total > 0.3 ? fmin(1, s->purge + 2 * (inert / total - 0.3)) : s->purge);
    hx[0] = kept * s->split[0] * A * (1 - converted);
    hx[1] = kept * s->split[1] * (B + A * converted);
    hx[2] = kept * s->split[2] * inert;
    hx[3] = fmax(1, T - s->cooler); /* the cooler has a size */
    return 0;
}

static void recycle_start(problem *p, int window, double *x)
{
    recycle *s = (recycle *)p->state;
    if (window == 0) {
        x[0] = x[1] = x[2] = 0.5;
        x[3] = 1;
    }
    s->feed = fmax(0.3, course_at(&s->feeds, window));
}

static void recycle_build(problem *p, int variant, unsigned long long seed)
{
    recycle *s = (recycle *)memory(sizeof *s);
    chance c = chance_of(seed, 210);
    (void)variant;
    s->rate = between(&c, 0.3, 1.5);
    s->energy = between(&c, 2, 8);
    s->rise = between(&c, 0.2, 0.5);
    s->split[0] = between(&c, 0.9, 0.99);
    s->split[1] = between(&c, 0.02, 0.2);
    s->split[2] = 0.99;
    s->purge = between(&c, 0.02, 0.1);
    s->cooler = between(&c, 0.05, 0.3);
    s->feeds = course_of(&c, 0.3, 0.3);
    host_is(p, s, 4, 1e-7);
    p->start = recycle_start;
    p->map = recycle_map;
}

/* ---- rooms: walls between rooms, radiators with a proportional band and a largest power; x: temperatures ---- */

typedef struct rooms {
    int n;
    double wall[WALLS][WALLS], leak[WALLS], band, most, outside, sun;
    course weather;
} rooms;

static int rooms_map(problem *p, const double *x, double *hx)
{
    rooms *s = (rooms *)p->state;
    int i, j;
    for (i = 0; i < s->n; i++) {
        double sum = s->leak[i] * s->outside + (i % 3 == 0 ? s->sun : 0), k = s->leak[i];
        for (j = 0; j < s->n; j++) sum += s->wall[i][j] * x[j], k += s->wall[i][j];
        hx[i] = (sum + s->most * clamp((20 - x[i]) / s->band, 0, 1)) / k;
    }
    return 0;
}

static void rooms_start(problem *p, int window, double *x)
{
    rooms *s = (rooms *)p->state;
    if (window == 0) fill(p->n, 18, x);
    s->outside = 5 + 10 * (course_at(&s->weather, window) - 1);
    s->sun = 5 * fmax(0, sin(0.8 * window));
}

static void rooms_build(problem *p, int variant, unsigned long long seed)
{
    rooms *s = (rooms *)memory(sizeof *s);
    chance c = chance_of(seed, 211);
    int i, j;
    (void)variant;
    s->n = integer(&c, 3, WALLS);
    s->band = between(&c, 4, 12);
    s->most = between(&c, 15, 40);
    s->weather = course_of(&c, 0.6, 0.5);
    for (i = 0; i < s->n; i++) {
        s->leak[i] = between(&c, 0.3, 1.5);
        for (j = 0; j < i; j++) s->wall[i][j] = s->wall[j][i] = i - j < 3 ? between(&c, 0.2, 2) : 0;
    }
    host_is(p, s, s->n, 1e-7);
    p->start = rooms_start;
    p->map = rooms_map;
}

#endif
