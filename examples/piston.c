/* SPDX-License-Identifier: MIT

   piston.c - a mass on a gas spring: a solver that fails, a bound, and two fields of different units

       m y'' = A (p - p0),  V = V0 + A y     side A: a piston takes the pressure and gives the volume
       p V^gamma = p0 V0^gamma               side B: the gas takes the volume and gives the pressure

   Both sides solve a window at once (parallel coupling): x holds the samples of the volume, in m^3, and of the pressure,
   in Pa, a block each.  Eight orders of magnitude lie between them, so each block is measured by its own values
   (IQN_SCALING).  The piston is thrown at the gas, and in a long window an iterate runs through the end of the cylinder:
   a volume <= 0 has no pressure, the gas fails.  Either the volume is kept above a bound that the answer does not reach
   (--guard lower: IQN_LOWER), or the host goes half of the way back until the gas can answer (--guard withdraw:
   iqn_halve), or both.  Without a guard the run ends there.  In still longer windows the pressure runs away, too: a
   bound from above (--peak: IQN_UPPER) holds it.

   Exact: energy.  The piston turns where the gas has taken m v0^2/2; that gives the least volume.  */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include "scene.h"

static const double MASS = 1, AREA = 1e-2, V0 = 1e-3, P0 = 1e5, GAMMA = 1.4;

/* Energy that the gas has taken from V0 to V, less what the air outside gave. */
static double energy(double V)
{
    return P0 * V0 / (GAMMA - 1) * (pow(V0 / V, GAMMA - 1) - 1) - P0 * (V0 - V);
}

/* The volume below V0 where the energy is that, by bisection. */
static double turning_volume(double e)
{
    double low = 0, high = V0;
    int i;
    for (i = 0; i < 200; i++) {
        const double middle = (low + high) / 2;
        if (energy(middle) > e) low = middle;
        else high = middle;
    }
    return high;
}

/* ---- the two sides ----------------------------------------------------------------------------------------------- */

typedef struct piston {
    double y[2], start[2]; /* position and speed now and at the window start */
} piston;

static double substep(double t0, double t1, int j, int n)
{
    return j == n ? t1 : t0 + j * ((t1 - t0) / n);
}

/* Runge-Kutta 4 under the pressure p, one step between two samples of V. */
static void move(piston *s, double t0, double t1, const waveform *p, waveform *V, int n)
{
    const rk_table *T = rk_find("rk4");
    double k[8], z[2], pressure;
    int j, i;
    memcpy(s->y, s->start, sizeof s->y);
    for (j = 0; j < n; j++) {
        const double t = substep(t0, t1, j, n), h = substep(t0, t1, j + 1, n) - t;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 2, s->y, k, 2, z);
            waveform_eval(p, fmin(t + T->c[i] * h, t1), 0, &pressure);
            k[2 * i] = z[1];
            k[2 * i + 1] = AREA * (pressure - P0) / MASS;
        }
        rk_finish(T, h, 2, s->y, k, 2, s->y, NULL);
        waveform_window(V)[j] = V0 + AREA * s->y[0];
    }
}

/* The gas at its own times; 0: it fails, for there is no volume. */
static int compress(double t0, double t1, const waveform *V, waveform *p, int n)
{
    double volume;
    int j;
    for (j = 1; j <= n; j++) {
        waveform_eval(V, substep(t0, t1, j, n), 0, &volume);
        if (!(volume > 0)) return 0;
        waveform_window(p)[j - 1] = P0 * pow(V0 / volume, GAMMA);
    }
    return 1;
}

/* ---- a window ---------------------------------------------------------------------------------------------------- */

enum { LOWER, WITHDRAW, BOTH, NONE, MOST = 200, MOST_FAILURES = 2000 };

typedef struct run {
    waveform V, p;
    piston piston;
    iqn *q;
    int n_V, n_p, guard, iterations, failures;
    double *x, *hx, *times; /* of x and hx first the volumes, then the pressures after the window start */
} run;

/* A first guess of the window: the value at its start. */
static void begin(run *r, waveform *w, int n, double t0, double t1)
{
    int j, status;
    for (j = 1; j <= n; j++) r->times[j - 1] = substep(t0, t1, j, n);
    status = wf_begin(w->w, 0, n, r->times, 0);
    scene_check(status, wf_message(status));
}

/* The samples of both fields as one vector, and back. */
static void gather(const run *r, double *x)
{
    memcpy(x, waveform_window(&r->V), (size_t)r->n_V * sizeof *x);
    memcpy(x + r->n_V, waveform_window(&r->p), (size_t)r->n_p * sizeof *x);
}

static void scatter(const run *r, const double *x)
{
    memcpy(waveform_window(&r->V), x, (size_t)r->n_V * sizeof *x);
    memcpy(waveform_window(&r->p), x + r->n_V, (size_t)r->n_p * sizeof *x);
}

/* hx = H(x); 0: the gas fails at x. */
static int solve(run *r, double t0, double t1)
{
    scatter(r, r->x);
    waveform_fit(&r->V);
    waveform_fit(&r->p);
    if (!compress(t0, t1, &r->V, &r->p, r->n_p)) return 0;
    move(&r->piston, t0, t1, &r->p, &r->V, r->n_V);
    gather(r, r->hx);
    return 1;
}

/* The same, from an x that is taken back as often as the gas fails; 0: it does so in the end. */
static int solve_guarded(run *r, double t0, double t1)
{
    while (!solve(r, t0, t1)) {
        int status;
        if (r->guard == LOWER || r->guard == NONE || r->failures == MOST_FAILURES) return 0;
        r->failures++;
        status = iqn_halve(r->q, r->x);
        scene_check(status, iqn_message(status));
    }
    return 1;
}

/* Whether the window has an answer. */
static int window(run *r, double t0, double t1)
{
    int status;
    begin(r, &r->V, r->n_V, t0, t1);
    begin(r, &r->p, r->n_p, t0, t1);
    gather(r, r->x);
    do {
        if (!solve_guarded(r, t0, t1)) return 0;
        status = iqn_step(r->q, r->x, r->hx);
        scene_check(status, iqn_message(status));
        r->iterations++;
    } while (!iqn_converged(r->q));
    return iqn_converged(r->q) == 1;
}

/* The least volume of the window: where its derivative rises through 0 between two samples. */
static double least_volume(const waveform *V, double t0, double t1, int n)
{
    double least = waveform_window(V)[-1], low, high, middle, rate, value;
    int j, i;
    for (j = 0; j < n; j++) {
        low = substep(t0, t1, j, n), high = substep(t0, t1, j + 1, n);
        for (i = 0; i < 50; i++) {
            middle = (low + high) / 2;
            waveform_eval(V, middle, 1, &rate);
            if (rate < 0) low = middle;
            else high = middle;
        }
        waveform_eval(V, high, 0, &value);
        least = fmin(least, value);
    }
    return least;
}

static void object_make(run *r, const scene_option *o)
{
    static const char *const scalings[] = {"weight", "value", "residual", "sum", NULL};
    static const int keys[] = {IQN_BY_WEIGHT, IQN_BY_VALUE, IQN_BY_RESIDUAL, IQN_BY_RESIDUAL_SUM};
    const int n = r->n_V + r->n_p;
    const size_t bytes = iqn_size(n, 20, 2);
    const double tolerance = scene_number(o, "tol", 1e-14, 1), peak = scene_number(o, "peak", 0, 1e9);
    scene_check(iqn_make(&r->q, n, 20, 2, scene_memory(bytes), bytes), "iqn_make");
    iqn_set(r->q, IQN_OMEGA, scene_number(o, "omega", 1e-3, 10));
    iqn_set(r->q, IQN_MAX_ITERATIONS, MOST);
    iqn_set_block(r->q, 0, IQN_LENGTH, r->n_V);
    iqn_set_block(r->q, 1, IQN_LENGTH, r->n_p);
    iqn_set_block(r->q, -1, IQN_SCALING, keys[scene_choice(o, "scaling", scalings)]);
    iqn_set_block(r->q, -1, IQN_TOL_RELATIVE, tolerance);
    if (r->guard == LOWER || r->guard == BOTH)
        iqn_set_block(r->q, 0, IQN_LOWER, V0 * scene_number(o, "bound", 1e-9, 1));
    if (peak > 0) iqn_set_block(r->q, 1, IQN_UPPER, P0 * peak);
}

int main(int argc, char **argv)
{
    static const char *const guards[] = {"lower", "withdraw", "both", "none", NULL};
    scene_option o[] = {
        {"window", "0.01", "length of a window"},
        {"windows", "6", "how many"},
        {"speed", "15", "of the piston towards the gas at the start"},
        {"na", "40", "sub-steps of the piston in a window"},
        {"nb", "50", "sub-steps of the gas"},
        {"degree", "3", "of the waveforms"},
        {"omega", "1", "relaxation factor of the first step"},
        {"guard", "lower", "lower (a bound for the volume), withdraw (where the gas fails), both or none"},
        {"bound", "0.1", "of the volume in units of its start"},
        {"peak", "0", "a bound for the pressure in units of its start; 0: none"},
        {"scaling", "value", "what a field is measured by: weight (units), value, residual or sum"},
        {"tol", "1e-8", "relative change of each field"},
        {NULL, NULL, NULL}};
    double length, speed, exact, least = V0, drift = 0, change[2] = {0, 0};
    int windows, degree, win, b;
    run r;
    scene_parse(argc, argv, "a mass on a gas spring: a solver that fails, a bound, two fields of different units", o);
    length = scene_number(o, "window", 1e-5, 1);
    windows = scene_integer(o, "windows", 1, 10000);
    speed = scene_perturbed("speed", scene_number(o, "speed", 1e-3, 1000));
    memset(&r, 0, sizeof r);
    r.n_V = scene_integer(o, "na", 1, 10000);
    r.n_p = scene_integer(o, "nb", 1, 10000);
    degree = scene_integer(o, "degree", 1, 9);
    r.guard = scene_choice(o, "guard", guards);
    r.piston.start[1] = -speed;
    r.V = waveform_make(degree, 1, r.n_V + degree);
    r.p = waveform_make(degree, 1, r.n_p + degree);
    *waveform_push(&r.V, 0, 0) = V0;
    *waveform_push(&r.p, 0, 0) = P0;
    r.x = (double *)scene_memory((size_t)(r.n_V + r.n_p) * sizeof *r.x);
    r.hx = (double *)scene_memory((size_t)(r.n_V + r.n_p) * sizeof *r.hx);
    r.times = (double *)scene_memory((size_t)(r.n_V + r.n_p) * sizeof *r.times);
    object_make(&r, o);

    exact = turning_volume(MASS * speed * speed / 2);
    for (win = 0; win < windows; win++) {
        const double t0 = win * length, t1 = (win + 1) * length, *y = r.piston.y;
        if (!window(&r, t0, t1)) break;
        for (b = 0; b < 2; b++) change[b] = fmax(change[b], iqn_get_block(r.q, b, IQN_RELATIVE));
        iqn_commit(r.q);
        waveform_fit(&r.V);
        least = fmin(least, least_volume(&r.V, t0, t1, r.n_V));
        drift = fmax(drift, fabs((MASS * y[1] * y[1] / 2 + energy(V0 + AREA * y[0])) / (MASS * speed * speed / 2) - 1));
        memcpy(r.piston.start, y, sizeof r.piston.start);
        wf_advance(r.V.w, degree - 1);
        wf_advance(r.p.w, degree - 1);
    }
    printf("windows %d\niterations %d\nfailures %d\n", win, r.iterations, r.failures);
    printf("least_volume %.12e\nexact_least_volume %.12e\n", least, exact);
    printf("change_of_volume %.1e\nchange_of_pressure %.1e\n", change[0], change[1]); /* in the last iterations */
    printf("error %.3e\ndrift %.3e\n", fabs(least / exact - 1), drift);
    if (win < windows) printf("window %d has no answer\n", win + 1);
    return win < windows;
}
