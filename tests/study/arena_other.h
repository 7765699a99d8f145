/* SPDX-License-Identifier: MIT

   arena_other.h - strongly coupled problems for judging alone: nothing is tuned on them.

   pistons  two bodies on springs that stiffen, in a fluid with added mass and drag: the bodies' displacements at the
            samples of a window make accelerations in the fluid, and its forces displacements
   beam     a beam whose tension grows with its deflection, over a channel: the added mass of each sine mode falls with
            its wave number
   string   the tube of arena_coupled.h with a wall that has mass and tension
   charge   a field that screens itself (Poisson-Boltzmann, periodic): long waves slosh, the more the longer the box */
#ifndef ARENA_OTHER_H_INCLUDED
#define ARENA_OTHER_H_INCLUDED
#include "arena_coupled.h"

/* ---- pistons and beam: modes q with  m q'' + (k + stiffening) q = f,  f = load - added q'' - drag |q'| q' ---- */

enum { BODIES = 40, SAMPLES = 16 };

typedef struct bodies {
    int beam, modes, samples;
    double dt, time, noise, tol;
    double mass, stiff[BODIES], added[BODIES], drag, harden, load[BODIES];
    double u[BODIES], v[BODIES], fluid_v[BODIES];         /* at the start of the window */
    double now_u[BODIES], now_v[BODIES], now_fluid[BODIES]; /* at its end */
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
};
enum { BODIES_CASES = (int)(sizeof bodies_cases / sizeof *bodies_cases) };

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
    double before[BODIES], velocity[BODIES], q[BODIES], f[BODIES], size = 0;
    int i, j, k, n = s->modes;
    ptrdiff_t a;
    copy(n, s->u, before), copy(n, s->fluid_v, velocity);
    copy(n, s->u, s->now_u), copy(n, s->v, s->now_v);
    for (j = 0; j < s->samples; j++) {
        for (i = 0; i < n; i++) {
            double v;
            for (q[i] = 0, k = 0; k < n; k++) q[i] += s->shape[i][k] * x[j * n + k];
            v = (q[i] - before[i]) / s->dt;
            f[i] = s->load[i] * sin(3 * (s->time + (j + 1) * s->dt) + i) - s->added[i] * (v - velocity[i]) / s->dt -
                   s->drag * fabs(v) * v;
            before[i] = q[i], velocity[i] = v;
        }
        bodies_solid(s, f, s->now_u, s->now_v);
        for (k = 0; k < n; k++)
            for (hx[j * n + k] = 0, i = 0; i < n; i++) hx[j * n + k] += s->shape[i][k] * s->now_u[i];
    }
    copy(n, velocity, s->now_fluid);
    for (a = 0; a < p->n; a++) size += (hx[a] - x[a]) * (hx[a] - x[a]);
    for (size = 0, j = 0; j < s->samples; j++)
        for (k = 0; k < n; k++) {
            double start = 0;
            for (i = 0; i < n; i++) start += s->shape[i][k] * s->u[i];
            size += (hx[j * n + k] - start) * (hx[j * n + k] - start);
        }
    for (a = 0; a < p->n && s->noise > 0; a++) hx[a] += s->noise * sqrt(size / (double)p->n) * normal(&s->c);
    for (i = 0, f[0] = 0; i < p->n; i++) f[0] += (hx[i] - x[i]) * (hx[i] - x[i]);
    return sqrt(f[0]) <= s->tol * sqrt(size);
}

static void bodies_accept(problem *p, const double *x, const double *hx)
{
    bodies *s = (bodies *)p->state;
    (void)x, (void)hx;
    copy(s->modes, s->now_u, s->u), copy(s->modes, s->now_v, s->v), copy(s->modes, s->now_fluid, s->fluid_v);
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
            for (i = 0; i < s->modes; i++) x[j * s->modes + k] += s->shape[i][k] * (s->u[i] + (j + 1) * s->dt * s->v[i]);
}

static void bodies_release(problem *p)
{
    free(p->state);
}

static void bodies_build(problem *p, int variant, unsigned long long seed)
{
    const bodies_case *how = bodies_cases + variant;
    bodies *s = (bodies *)memory(sizeof *s);
    int i, k, n;
    s->c = chance_of(seed, 50 + (unsigned long long)variant);
    s->beam = how->beam, s->samples = how->samples, s->noise = how->noise, s->tol = how->tol;
    s->dt = how->dt * between(&s->c, 0.7, 1.4);
    s->modes = n = s->beam ? BODIES : 2;
    s->mass = 1, s->drag = 0.2 * how->ratio, s->harden = s->beam ? 3000 : 100;
    for (i = 0; i < n; i++) {
        const double wave = i + 1;
        s->stiff[i] = (s->beam ? 10 * wave * wave * wave * wave : 40 * wave) * between(&s->c, 0.8, 1.25);
        s->added[i] = how->ratio * (s->beam ? 1 / (wave * tanh(0.5 * wave)) * tanh(0.5) : between(&s->c, 0.3, 1));
        s->load[i] = how->ratio * between(&s->c, 0.5, 1.5) / (wave * wave);
        for (k = 0; k < n; k++) s->shape[i][k] = sqrt(2. / (n + 1)) * sin((i + 1) * (k + 1) * PI / (n + 1));
    }
    p->n = n * s->samples;
    p->windows = how->windows, p->columns = 50, p->limit = 100, p->ends = 1;
    p->start = bodies_start, p->map = bodies_map, p->accept = bodies_accept, p->release = bodies_release;
    p->state = s;
}

/* ---- charge: rho = exp(potential of the ions - V), V'' = -(rho - mean), periodic; x = log of rho ---- */

typedef struct charge {
    ptrdiff_t n;
    double box, *ions, *work;
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

static void charge_release(problem *p)
{
    charge *s = (charge *)p->state;
    free(s->ions), free(s->work), free(s);
}

/* Long waves weigh more: M = 1 + 10 / (box/2 pi)^2 times the inverse of minus the second derivative */
static void charge_metric(problem *p, const double *r, double *y)
{
    const charge *s = (const charge *)p->state;
    const double weight = 10 * 4 * PI * PI / (s->box * s->box);
    ptrdiff_t i;
    poisson(s->n, s->box, r, y);
    for (i = 0; i < s->n; i++) y[i] = r[i] + weight * y[i];
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
    s->ions = numbers(s->n), s->work = numbers(s->n);
    for (k = 1; k <= 6; k++) {
        const double size = normal(&c) / k, phase = PI * uniform(&c);
        for (i = 0; i < s->n; i++) s->ions[i] += 0.5 * size * sin(2 * PI * k * (double)i / (double)s->n + phase);
    }
    p->n = s->n, p->windows = 1, p->columns = 30, p->limit = 120, p->relative = 1e-9;
    p->start = charge_start, p->map = charge_map, p->metric = charge_metric, p->release = charge_release;
    p->state = s;
}

#endif
