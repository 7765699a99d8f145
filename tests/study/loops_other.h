/* SPDX-License-Identifier: MIT

   loops_other.h - hosts' own loops, second half: contact, control, games, statistics, electrons.  As loops_fields.h. */
#ifndef LOOPS_OTHER_H_INCLUDED
#define LOOPS_OTHER_H_INCLUDED
#include "loops_kit.h"

enum { PARTS = 24 };

/* C := a positive definite matrix of m numbers, its largest eigenvalue at most most */
static void compliance(chance *c, int m, double most, double *C)
{
    double G[PARTS * PARTS], trace = 0;
    int i, j, k;
    for (i = 0; i < m * m; i++) G[i] = normal(c);
    for (i = 0; i < m; i++)
        for (j = 0; j < m; j++)
            for (C[i * m + j] = 0, k = 0; k < m; k++) C[i * m + j] += G[i * m + k] * G[j * m + k] / m;
    for (i = 0; i < m; i++) { /* the largest eigenvalue is at most the largest sum of a row */
        double row = 0;
        for (j = 0; j < m; j++) row += fabs(C[i * m + j]);
        trace = fmax(trace, row);
    }
    for (i = 0; i < m * m; i++) C[i] *= most / trace;
}

/* ---- stops: springs with play behind a compliance, x = b - C f(x); x: positions ---- */

typedef struct stops {
    int n;
    double C[PARTS * PARTS], play[PARTS], stiff[PARTS], b[PARTS], amplitude[PARTS];
    course loads;
} stops;

static int stops_map(problem *p, const double *x, double *hx)
{
    stops *s = (stops *)p->state;
    double f[PARTS];
    int i, j;
    for (i = 0; i < s->n; i++) f[i] = s->stiff[i] * (fmax(0, x[i] - s->play[i]) + fmin(0, x[i] + s->play[i]));
    for (i = 0; i < s->n; i++)
        for (hx[i] = s->b[i], j = 0; j < s->n; j++) hx[i] -= s->C[i * s->n + j] * f[j];
    return 0;
}

static void stops_start(problem *p, int window, double *x)
{
    stops *s = (stops *)p->state;
    int i;
    (void)x;
    for (i = 0; i < s->n; i++) s->b[i] = s->amplitude[i] * course_at(&s->loads, window) + 0.3 * sin(window * (i + 1));
}

static void stops_build(problem *p, int variant, unsigned long long seed)
{
    stops *s = (stops *)memory(sizeof *s);
    chance c = chance_of(seed, 220);
    int i;
    (void)variant;
    s->n = integer(&c, 2, PARTS);
    compliance(&c, s->n, between(&c, 1.5, 6), s->C);
    s->loads = course_of(&c, 0.5, 0.5);
    for (i = 0; i < s->n; i++) {
        s->play[i] = between(&c, 0.1, 0.6);
        s->stiff[i] = between(&c, 0.5, 1);
        s->amplitude[i] = normal(&c);
    }
    host_is(p, s, s->n, 1e-7);
    p->start = stops_start;
    p->map = stops_map;
}

/* ---- friction: blocks on a belt, one implicit step a window; forces of friction of the last velocities; x: velocities ---- */

typedef struct friction {
    int n;
    double at[PARTS], old[PARTS], dt, spring, grip, slip, belt;
    course belts;
} friction;

static int friction_map(problem *p, const double *x, double *hx)
{
    friction *s = (friction *)p->state;
    double below[PARTS], diagonal[PARTS], above[PARTS];
    const double k = s->spring * s->dt * s->dt;
    int i;
    for (i = 0; i < s->n; i++) {
        const double left = i > 0 ? s->at[i - 1] : 0, right = i + 1 < s->n ? s->at[i + 1] : 0;
        const double rub = -s->grip * clamp((x[i] - s->belt) / s->slip, -1, 1); /* sticks, or slips */
        below[i] = above[i] = -k;
        diagonal[i] = 1 + 2 * k + s->dt;
        hx[i] = s->old[i] + s->dt * (s->spring * (left + right - 2 * s->at[i]) - s->at[i] + rub);
    }
    return solve_tridiagonal(s->n, below, diagonal, above, hx);
}

static void friction_start(problem *p, int window, double *x)
{
    friction *s = (friction *)p->state;
    copy(p->n, x, s->old);
    s->belt = course_at(&s->belts, window);
}

static void friction_accept(problem *p, const double *hx)
{
    friction *s = (friction *)p->state;
    add(p->n, s->dt, hx, s->at);
}

static void friction_build(problem *p, int variant, unsigned long long seed)
{
    friction *s = (friction *)memory(sizeof *s);
    chance c = chance_of(seed, 221);
    int i;
    (void)variant;
    s->n = integer(&c, 3, PARTS);
    s->dt = between(&c, 0.1, 0.4);
    s->spring = between(&c, 1, 20);
    s->grip = between(&c, 0.5, 2);
    s->slip = s->dt * s->grip / between(&c, 0.6, 3);
    s->belts = course_of(&c, 1, 0.8);
    for (i = 0; i < s->n; i++) s->at[i] = 0.3 * uniform(&c);
    host_is(p, s, s->n, 1e-7);
    p->start = friction_start;
    p->map = friction_map;
    p->accept = friction_accept;
}

/* ---- controllers: proportional control with limits of plants that act on each other; x: what the plants are told ---- */

typedef struct controllers {
    int n;
    double G[PARTS * PARTS], gain[PARTS], most[PARTS], wanted[PARTS], w[PARTS];
    course wishes;
} controllers;

static int controllers_map(problem *p, const double *x, double *hx)
{
    controllers *s = (controllers *)p->state;
    int i, j;
    for (i = 0; i < s->n; i++) {
        double y = 0;
        for (j = 0; j < s->n; j++) y += s->G[i * s->n + j] * x[j];
        hx[i] = clamp(s->gain[i] * (s->wanted[i] - y), -s->most[i], s->most[i]);
    }
    return 0;
}

static void controllers_start(problem *p, int window, double *x)
{
    controllers *s = (controllers *)p->state;
    int i;
    (void)x;
    for (i = 0; i < s->n; i++) s->wanted[i] = s->w[i] * course_at(&s->wishes, window + i % 3);
}

static void controllers_build(problem *p, int variant, unsigned long long seed)
{
    controllers *s = (controllers *)memory(sizeof *s);
    chance c = chance_of(seed, 222);
    int i;
    (void)variant;
    s->n = integer(&c, 2, 16);
    s->wishes = course_of(&c, 0.8, 0.8);
    for (i = 0; i < s->n * s->n; i++) s->G[i] = 0.4 * normal(&c) / sqrt(s->n) + (i % (s->n + 1) == 0);
    for (i = 0; i < s->n; i++) {
        s->gain[i] = between(&c, 0.5, 3);
        s->most[i] = between(&c, 0.3, 1.5);
        s->w[i] = 1.5 * normal(&c);
    }
    host_is(p, s, s->n, 1e-7);
    p->start = controllers_start;
    p->map = controllers_map;
}

/* ---- firms: each answers the others' outputs as best it can, up to its capacity; x: outputs ---- */

typedef struct firms {
    int n;
    double cost[PARTS], capacity[PARTS], demand, bent;
    course demands;
} firms;

static int firms_map(problem *p, const double *x, double *hx)
{
    firms *s = (firms *)p->state;
    double all = 0;
    int i;
    for (i = 0; i < s->n; i++) all += x[i];
    for (i = 0; i < s->n; i++) {
        const double others = all - x[i];
        hx[i] = clamp((s->demand - others - s->cost[i]) / (2 + s->bent * fabs(others)), 0, s->capacity[i]);
    }
    return 0;
}

static void firms_start(problem *p, int window, double *x)
{
    firms *s = (firms *)p->state;
    (void)x;
    s->demand = 2 * course_at(&s->demands, window);
}

static void firms_build(problem *p, int variant, unsigned long long seed)
{
    firms *s = (firms *)memory(sizeof *s);
    chance c = chance_of(seed, 223);
    int i;
    (void)variant;
    s->n = integer(&c, 2, 10);
    s->bent = between(&c, 0, 0.5);
    s->demands = course_of(&c, 0.4, 0.3);
    for (i = 0; i < s->n; i++) s->cost[i] = between(&c, 0, 0.8), s->capacity[i] = between(&c, 0.1, 0.6);
    host_is(p, s, s->n, 1e-7);
    p->start = firms_start;
    p->map = firms_map;
}

/* ---- mixture: EM for normal distributions, data that wander; x: means, log of deviations, log of shares.  classes: from a
   flat first guess in every window ---- */

enum { DATA = 80 };

typedef struct mixture {
    int kinds, flat;
    double data[DATA], speed[3], apart;
    chance c;
} mixture;

static int mixture_map(problem *p, const double *x, double *hx)
{
    mixture *s = (mixture *)p->state;
    const int K = s->kinds;
    double count[3] = {0}, first[3] = {0}, second[3] = {0};
    int i, k;
    for (i = 0; i < DATA; i++) {
        double part[3], all = 0;
        for (k = 0; k < K; k++) {
            const double z = (s->data[i] - x[k]) * exp(-x[K + k]);
            all += part[k] = exp(x[2 * K + k] - x[K + k] - 0.5 * z * z) + 1e-300;
        }
        for (k = 0; k < K; k++) {
            const double share = part[k] / all;
            count[k] += share;
            first[k] += share * s->data[i];
            second[k] += share * s->data[i] * s->data[i];
        }
    }
    for (k = 0; k < K; k++) {
        const double mean = first[k] / count[k];
        hx[k] = mean;
        hx[K + k] = 0.5 * log(fmax(second[k] / count[k] - mean * mean, 0.05)); /* not narrower than that: a kink */
        hx[2 * K + k] = log(count[k] / DATA);
    }
    return 0;
}

static void mixture_start(problem *p, int window, double *x)
{
    mixture *s = (mixture *)p->state;
    int i, k;
    for (i = 0; i < DATA; i++)
        s->data[i] =
            s->apart * (i % s->kinds) + s->speed[i % s->kinds] * window + (0.6 + 0.2 * (i % s->kinds)) * normal(&s->c);
    (void)p;
    if (window > 0 && !s->flat) return;
    for (k = 0; k < s->kinds; k++) {
        x[k] = s->flat ? 0.5 * s->apart + 0.1 * k : s->apart * k + 0.3;
        x[s->kinds + k] = 0;
        x[2 * s->kinds + k] = -log(s->kinds);
    }
}

static void mixture_build(problem *p, int variant, unsigned long long seed)
{
    mixture *s = (mixture *)memory(sizeof *s);
    int k;
    s->flat = variant;
    s->c = chance_of(seed, 224 + 100 * (unsigned long long)variant);
    s->kinds = integer(&s->c, 2, 3);
    s->apart = between(&s->c, 2.5, 4);
    for (k = 0; k < 3; k++) s->speed[k] = 0.1 * uniform(&s->c);
    host_is(p, s, 3 * s->kinds, 1e-6);
    p->start = mixture_start;
    p->map = mixture_map;
}

/* ---- roads: demand over routes that share links, times of the links, shares of the routes by logit; a toll above a flow;
   x: flows of routes ---- */

typedef struct roads {
    int routes, links, uses[PARTS][8];
    double free[8], room[8], choosy, demand;
    course demands;
} roads;

static int roads_map(problem *p, const double *x, double *hx)
{
    roads *s = (roads *)p->state;
    double flow[8] = {0}, time[8], cost[PARTS], all = 0, least = 1e300;
    int r, l;
    for (r = 0; r < s->routes; r++)
        for (l = 0; l < s->links; l++) flow[l] += s->uses[r][l] * x[r];
    for (l = 0; l < s->links; l++) {
        const double load = flow[l] / s->room[l];
        time[l] = s->free[l] * (1 + 0.15 * pow(load, 4)) + fmax(0, load - 1); /* the toll */
    }
    for (r = 0; r < s->routes; r++) {
        for (cost[r] = 0, l = 0; l < s->links; l++) cost[r] += s->uses[r][l] * time[l];
        least = fmin(least, cost[r]);
    }
    for (r = 0; r < s->routes; r++) all += hx[r] = exp(-s->choosy * (cost[r] - least));
    for (r = 0; r < s->routes; r++) hx[r] *= s->demand / all;
    return 0;
}

static void roads_start(problem *p, int window, double *x)
{
    roads *s = (roads *)p->state;
    s->demand = 2 * fmax(0.2, course_at(&s->demands, window));
    if (window == 0) fill(p->n, s->demand / s->routes, x);
}

static void roads_build(problem *p, int variant, unsigned long long seed)
{
    roads *s = (roads *)memory(sizeof *s);
    chance c = chance_of(seed, 225);
    int r, l;
    (void)variant;
    s->routes = integer(&c, 3, 12);
    s->links = integer(&c, 4, 8);
    s->choosy = between(&c, 0.3, 1.5);
    s->demands = course_of(&c, 0.5, 0.4);
    for (l = 0; l < s->links; l++) s->free[l] = between(&c, 0.5, 2), s->room[l] = between(&c, 0.8, 2);
    for (r = 0; r < s->routes; r++)
        for (l = 0; l < s->links; l++) s->uses[r][l] = l == r % s->links || uniform(&c) > 0.2;
    host_is(p, s, s->routes, 1e-7);
    p->start = roads_start;
    p->map = roads_map;
}

/* ---- planning: value iteration, rewards that change; x: values of states ---- */

enum { STATES = 50, ACTIONS = 4 };

typedef struct planning {
    int n, next[STATES][ACTIONS][3];
    double chances[STATES][ACTIONS][3], reward[STATES][ACTIONS], discount, now;
    course rewards;
} planning;

static int planning_map(problem *p, const double *x, double *hx)
{
    planning *s = (planning *)p->state;
    int i, a, k;
    for (i = 0; i < s->n; i++)
        for (hx[i] = -1e300, a = 0; a < ACTIONS; a++) {
            double value = s->reward[i][a] * (a % 2 ? s->now : 1);
            for (k = 0; k < 3; k++) value += s->discount * s->chances[i][a][k] * x[s->next[i][a][k]];
            hx[i] = fmax(hx[i], value);
        }
    return 0;
}

static void planning_start(problem *p, int window, double *x)
{
    planning *s = (planning *)p->state;
    (void)x;
    s->now = course_at(&s->rewards, window);
}

static void planning_build(problem *p, int variant, unsigned long long seed)
{
    planning *s = (planning *)memory(sizeof *s);
    chance c = chance_of(seed, 226);
    int i, a, k;
    (void)variant;
    s->n = integer(&c, 10, STATES);
    s->discount = between(&c, 0.8, 0.96);
    s->rewards = course_of(&c, 0.5, 0.5);
    for (i = 0; i < s->n; i++)
        for (a = 0; a < ACTIONS; a++) {
            const double u = between(&c, 0.1, 0.8), v = between(&c, 0.05, 0.2);
            s->reward[i][a] = between(&c, 0, 1);
            s->chances[i][a][0] = u;
            s->chances[i][a][1] = v;
            s->chances[i][a][2] = 1 - u - v;
            for (k = 0; k < 3; k++) s->next[i][a][k] = integer(&c, i > 6 ? i - 6 : 0, i + 6 < s->n ? i + 6 : s->n - 1);
        }
    host_is(p, s, s->n, 1e-6);
    p->start = planning_start;
    p->map = planning_map;
}

/* ---- electrons: a ring of sites, each electron in the mean field of the others; x: densities ---- */

typedef struct electrons {
    int n, filled;
    double site[PARTS], field[PARTS], repels, warm;
    course fields;
} electrons;

static int electrons_map(problem *p, const double *x, double *hx)
{
    electrons *s = (electrons *)p->state;
    const int n = s->n, room = 3 * PARTS;
    double A[PARTS * PARTS], energy[PARTS], work[3 * PARTS], low, high;
    int i, k, info;
    memset(A, 0, sizeof A);
    for (i = 0; i < n; i++) {
        A[i + n * i] = s->site[i] + s->repels * (x[i] - 0.5);
        A[i + n * ((i + 1) % n)] = A[(i + 1) % n + n * i] = -1;
    }
    dsyev_("V", "L", &n, A, &n, energy, work, &room, &info);
    if (info != 0) return -1;
    for (low = energy[0] - 40 * s->warm, high = energy[n - 1] + 40 * s->warm, k = 0; k < 60; k++) {
        double level = 0.5 * (low + high), sum = 0;
        for (i = 0; i < n; i++) sum += 1 / (1 + exp(clamp((energy[i] - level) / s->warm, -60, 60)));
        if (sum < s->filled) low = level;
        else high = level;
    }
    memset(hx, 0, (size_t)n * sizeof *hx);
    for (k = 0; k < n; k++) {
        const double part = 1 / (1 + exp(clamp((energy[k] - low) / s->warm, -60, 60)));
        for (i = 0; i < n; i++) hx[i] += part * A[i + n * k] * A[i + n * k];
    }
    return 0;
}

static void electrons_start(problem *p, int window, double *x)
{
    electrons *s = (electrons *)p->state;
    int i;
    if (window == 0) fill(p->n, (double)s->filled / s->n, x);
    for (i = 0; i < s->n; i++) s->site[i] = s->field[i] * course_at(&s->fields, window);
}

static void electrons_build(problem *p, int variant, unsigned long long seed)
{
    electrons *s = (electrons *)memory(sizeof *s);
    chance c = chance_of(seed, 227);
    int i;
    (void)variant;
    s->n = integer(&c, 5, 10);
    s->filled = s->n / 2;
    s->repels = between(&c, 1, 5);
    s->warm = between(&c, 0.05, 0.3);
    s->fields = course_of(&c, 0.8, 0.6);
    for (i = 0; i < s->n; i++) s->field[i] = 1.5 * normal(&c);
    host_is(p, s, s->n, 1e-6);
    p->start = electrons_start;
    p->map = electrons_map;
}

/* ---- balancing: a table to given sums of its rows and columns, Sinkhorn's loop; x: log of the factors of the rows ---- */

typedef struct balancing {
    int n;
    double K[PARTS][PARTS], row[PARTS], column[PARTS];
    course rows;
} balancing;

static int balancing_map(problem *p, const double *x, double *hx)
{
    balancing *s = (balancing *)p->state;
    double v[PARTS];
    int i, j;
    for (j = 0; j < s->n; j++) {
        double sum = 0;
        for (i = 0; i < s->n; i++) sum += s->K[i][j] * exp(x[i]);
        v[j] = fmin(s->column[j] / sum, 50); /* a factor is limited */
    }
    for (i = 0; i < s->n; i++) {
        double sum = 0;
        for (j = 0; j < s->n; j++) sum += s->K[i][j] * v[j];
        hx[i] = log(s->row[i] / sum);
    }
    for (i = s->n - 1; i >= 0; i--) hx[i] -= hx[0]; /* one factor is free */
    return 0;
}

static void balancing_start(problem *p, int window, double *x)
{
    balancing *s = (balancing *)p->state;
    double sum = 0;
    int i;
    (void)p;
    (void)x;
    for (i = 0; i < s->n; i++) sum += s->row[i] = fmax(0.1, course_at(&s->rows, window + 2 * i));
    for (i = 0; i < s->n; i++) s->row[i] *= s->n / sum;
}

static void balancing_build(problem *p, int variant, unsigned long long seed)
{
    balancing *s = (balancing *)memory(sizeof *s);
    chance c = chance_of(seed, 228);
    double narrow, at[2][PARTS];
    int i, j;
    (void)variant;
    s->n = integer(&c, 5, PARTS);
    narrow = between(&c, 3, 15);
    s->rows = course_of(&c, 0.7, 0.3);
    for (i = 0; i < s->n; i++) at[0][i] = between(&c, 0, 1), at[1][i] = between(&c, 0, 1), s->column[i] = 1;
    for (i = 0; i < s->n; i++)
        for (j = 0; j < s->n; j++) s->K[i][j] = exp(-narrow * (at[0][i] - at[1][j]) * (at[0][i] - at[1][j]));
    host_is(p, s, s->n, 1e-7);
    p->start = balancing_start;
    p->map = balancing_map;
}

/* ---- sparse: least squares with a price on |x|, a gradient step and a soft threshold (ISTA); x: coefficients ---- */

enum { ROWS = 30, COLUMNS = 40 };

typedef struct sparse {
    int rows, n;
    double A[ROWS][COLUMNS], b[ROWS], truth[COLUMNS], step, price;
    chance c;
} sparse;

static int sparse_map(problem *p, const double *x, double *hx)
{
    sparse *s = (sparse *)p->state;
    double miss[ROWS];
    int i, j;
    for (i = 0; i < s->rows; i++)
        for (miss[i] = -s->b[i], j = 0; j < s->n; j++) miss[i] += s->A[i][j] * x[j];
    for (j = 0; j < s->n; j++) {
        double z = x[j];
        for (i = 0; i < s->rows; i++) z -= s->step * s->A[i][j] * miss[i];
        hx[j] = z > 0 ? fmax(0, z - s->step * s->price) : fmin(0, z + s->step * s->price);
    }
    return 0;
}

static void sparse_start(problem *p, int window, double *x)
{
    sparse *s = (sparse *)p->state;
    int i, j;
    (void)p;
    (void)x;
    if (window % 3 == 0) {
        j = integer(&s->c, 0, s->n - 1);
        s->truth[j] = s->truth[j] != 0 ? 0 : 2 * normal(&s->c);
    }
    for (i = 0; i < s->rows; i++)
        for (s->b[i] = 0.02 * normal(&s->c), j = 0; j < s->n; j++)
            s->b[i] += s->A[i][j] * s->truth[j] * (1 + 0.1 * sin(window + j));
}

static void sparse_build(problem *p, int variant, unsigned long long seed)
{
    sparse *s = (sparse *)memory(sizeof *s);
    double size = 0;
    int i, j;
    (void)variant;
    s->c = chance_of(seed, 229);
    s->rows = integer(&s->c, 12, ROWS);
    s->n = integer(&s->c, s->rows / 2, COLUMNS);
    s->price = between(&s->c, 0.02, 0.2);
    for (i = 0; i < s->rows; i++)
        for (j = 0; j < s->n; j++) s->A[i][j] = normal(&s->c) / sqrt(s->rows);
    for (j = 0; j < s->n; j++) s->truth[j] = j % 5 ? 0 : 2 * normal(&s->c);
    size = 1 + sqrt((double)s->n / s->rows); /* about the largest singular value */
    s->step = 1 / (size * size);
    host_is(p, s, s->n, 1e-6);
    p->start = sparse_start;
    p->map = sparse_map;
}

/* ---- programs: min c'x, A x = b, x >= 0 by Douglas-Rachford splitting, b moves; x: the point that is reflected ---- */

enum { EQUATIONS = 12 };

typedef struct programs {
    int rows, n;
    double A[EQUATIONS * COLUMNS], G[EQUATIONS * EQUATIONS], cost[COLUMNS], inside[COLUMNS], b[EQUATIONS];
    course moves;
} programs;

static int programs_map(problem *p, const double *z, double *hz)
{
    programs *s = (programs *)p->state;
    double y[COLUMNS], G[EQUATIONS * EQUATIONS], miss[EQUATIONS];
    int i, j;
    for (j = 0; j < s->n; j++) y[j] = 2 * fmax(z[j], 0) - z[j] - s->cost[j];
    for (i = 0; i < s->rows; i++) miss[i] = product(s->n, s->A + i * s->n, y) - s->b[i];
    copy(s->rows * s->rows, s->G, G);
    if (solve_dense(s->rows, G, miss) < 0) return -1;
    for (i = 0; i < s->rows; i++) add(s->n, -miss[i], s->A + i * s->n, y); /* A y = b */
    for (j = 0; j < s->n; j++) hz[j] = z[j] + y[j] - fmax(z[j], 0);
    return 0;
}

static void programs_start(problem *p, int window, double *z)
{
    programs *s = (programs *)p->state;
    int i, j;
    (void)p;
    (void)z;
    for (i = 0; i < s->rows; i++)
        for (s->b[i] = 0, j = 0; j < s->n; j++)
            s->b[i] += s->A[i * s->n + j] * s->inside[j] * fmax(0, course_at(&s->moves, window + j % 4));
}

static void programs_build(problem *p, int variant, unsigned long long seed)
{
    programs *s = (programs *)memory(sizeof *s);
    chance c = chance_of(seed, 232);
    int i, j;
    (void)variant;
    s->rows = integer(&c, 3, EQUATIONS);
    s->n = integer(&c, s->rows + 2, 3 * s->rows);
    s->moves = course_of(&c, 0.3, 0.3);
    for (i = 0; i < s->rows * s->n; i++) s->A[i] = normal(&c);
    for (j = 0; j < s->n; j++) { /* a price of a feasible dual: the program has an answer */
        s->inside[j] = between(&c, 0, 1);
        s->cost[j] = between(&c, 0, 1);
        for (i = 0; i < s->rows; i++) s->cost[j] += 0.3 * s->A[i * s->n + j] * sin(i);
    }
    for (i = 0; i < s->rows; i++)
        for (j = 0; j < s->rows; j++) s->G[i * s->rows + j] = product(s->n, s->A + i * s->n, s->A + j * s->n);
    host_is(p, s, s->n, 1e-6);
    p->start = programs_start;
    p->map = programs_map;
}

/* ---- titration: metals and a ligand that bind in steps, one metal falls out; free ligand of the last iterate; x: log of
   the free concentrations ---- */

typedef struct titration {
    int metals;
    double bind[4][3], metal[4], ligand, falls;
    course doses;
} titration;

static int titration_map(problem *p, const double *x, double *hx)
{
    titration *s = (titration *)p->state;
    const double L = exp(clamp(x[s->metals], -40, 10));
    double taken = 1;
    int i, k;
    (void)p;
    for (i = 0; i < s->metals; i++) {
        double power = 1, sum = 1, weighted = 0, M;
        for (k = 0; k < 3; k++) {
            power *= L;
            sum += s->bind[i][k] * power;
            weighted += (k + 1) * s->bind[i][k] * power / L;
        }
        M = s->metal[i] / sum;
        if (i == 0) M = fmin(M, s->falls / L); /* falls out */
        hx[i] = log(M);
        taken += weighted * exp(clamp(x[i], -40, 10));
    }
    hx[s->metals] = log(s->ligand / taken);
    return 0;
}

static void titration_start(problem *p, int window, double *x)
{
    titration *s = (titration *)p->state;
    if (window == 0) fill(p->n, -3, x);
    s->ligand = 0.3 * fmax(0.05, course_at(&s->doses, window)) * (1 + 0.3 * window);
}

static void titration_build(problem *p, int variant, unsigned long long seed)
{
    titration *s = (titration *)memory(sizeof *s);
    chance c = chance_of(seed, 230);
    int i, k;
    (void)variant;
    s->metals = integer(&c, 1, 4);
    s->falls = between(&c, 0.01, 0.1);
    s->doses = course_of(&c, 0.5, 0.5);
    for (i = 0; i < s->metals; i++) {
        s->metal[i] = between(&c, 0.05, 0.5);
        for (k = 0; k < 3; k++) s->bind[i][k] = exp((k + 1) * between(&c, 0.5, 3));
    }
    host_is(p, s, s->metals + 1, 1e-7);
    p->start = titration_start;
    p->map = titration_map;
}

/* ---- chord: implicit Euler of reactions, Newton's method with the Jacobian of the start of the run; x: concentrations ---- */

typedef struct chord {
    int n;
    double old[PARTS], rate[PARTS], flow[PARTS], J[PARTS * PARTS], dt, inlet;
    course inlets;
} chord;

/* d x / dt */
static void chord_rates(const chord *s, const double *x, double *f)
{
    int i;
    for (i = 0; i < s->n; i++) f[i] = (i == 0 ? s->inlet : s->flow[i - 1] * x[i - 1]) - s->flow[i] * x[i];
    for (i = 0; i + 1 < s->n; i++) { /* x_i + x_i+1 -> 2 x_i+1, up to a rate */
        const double r = fmin(s->rate[i] * x[i] * x[i + 1], 3);
        f[i] -= r;
        f[i + 1] += r;
    }
}

static int chord_map(problem *p, const double *x, double *hx)
{
    chord *s = (chord *)p->state;
    double f[PARTS], A[PARTS * PARTS];
    int i;
    chord_rates(s, x, f);
    for (i = 0; i < s->n; i++) hx[i] = -(x[i] - s->old[i] - s->dt * f[i]);
    copy(s->n * s->n, s->J, A);
    if (solve_dense(s->n, A, hx) < 0) return -1;
    for (i = 0; i < s->n; i++) hx[i] += x[i];
    return 0;
}

static void chord_start(problem *p, int window, double *x)
{
    chord *s = (chord *)p->state;
    if (window == 0) fill(p->n, 0.5, x);
    copy(p->n, x, s->old);
    s->inlet = fmax(0.1, course_at(&s->inlets, window));
}

static void chord_build(problem *p, int variant, unsigned long long seed)
{
    chord *s = (chord *)memory(sizeof *s);
    chance c = chance_of(seed, 231);
    double x[PARTS] = {0}, f[PARTS], g[PARTS];
    int i, j;
    (void)variant;
    s->n = integer(&c, 3, PARTS);
    s->dt = between(&c, 0.2, 0.8);
    s->inlets = course_of(&c, 0.7, 0.7);
    for (i = 0; i < s->n; i++) s->rate[i] = between(&c, 0.3, 3), s->flow[i] = between(&c, 0.5, 2);
    fill(s->n, 0.5, x);
    chord_rates(s, x, f);
    for (j = 0; j < s->n; j++) { /* J = 1 - dt df/dx, by columns */
        x[j] += 1e-6;
        chord_rates(s, x, g);
        x[j] -= 1e-6;
        for (i = 0; i < s->n; i++) s->J[i + s->n * j] = (i == j) - s->dt * (g[i] - f[i]) / 1e-6;
    }
    host_is(p, s, s->n, 1e-8);
    p->start = chord_start;
    p->map = chord_map;
}

#endif
