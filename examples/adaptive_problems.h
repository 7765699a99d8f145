/* SPDX-License-Identifier: MIT

   adaptive_problems.h - coupled problems with known answers for adaptive.c: two sides, each with its own state, each
   reading numbers that the other writes. */
#ifndef ADAPTIVE_PROBLEMS_H_INCLUDED
#define ADAPTIVE_PROBLEMS_H_INCLUDED

enum { DEEPEST = 40 };

static int phase; /* how many events are past */
static const double pi = 3.14159265358979323846;

/* One side: y' = slope(t, y, w), w what the other side writes.  A stiff side solves k = f(t, z + g k) itself. */
typedef struct model {
    int n, width;                      /* numbers of its state; numbers that it writes */
    double y0[DEEPEST], size[DEEPEST]; /* start; typical size of every component, a power of ten is enough */
    void (*slope)(double t, const double *y, const double *w, double *k);
    int (*solve)(double t, double g, const double *z, const double *w, double *k); /* NULL: not stiff */
    void (*output)(const double *y, const double *w, double *out); /* NULL: the first numbers of the state */
    double faster;                                                 /* --vary: y' is 1 + faster times that */
} model;

typedef struct problem {
    const char *name, *help;
    double end, reference_step;
    double event[64]; /* times at which f or its derivatives jump, told to the loop; 0 ends them */
    model side[2];    /* what the second one writes does not depend at once on what it reads */
    double (*exact)(int side, double t);
    double (*trigger)(const double *a, const double *b); /* of what the sides write: below 0 the event is past */
} problem;

/* ---- two masses between springs: the answer is (cos 2 pi t +- cos 6 pi t)/2 ---- */

static void mass(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = 16 * pi * pi * w[0] - 20 * pi * pi * y[0];
}

static double masses_exact(int side, double t)
{
    return 0.5 * (cos(2 * pi * t) + (side ? -1 : 1) * cos(6 * pi * t));
}

/* ---- the same, damped and driven: errors are forgotten ---- */

static void damped_a(double t, const double *y, const double *w, double *k)
{
    mass(t, y, w, k);
    k[1] += 60 * sin(2 * t) - 6 * y[1];
}

static void damped_b(double t, const double *y, const double *w, double *k)
{
    mass(t, y, w, k);
    k[1] -= 6 * y[1];
}

/* ---- the same at rest; a load comes later ---- */

static void loaded(double t, const double *y, const double *w, double *k)
{
    mass(t, y, w, k);
    k[1] += phase ? 100 : 0;
}

/* ---- van der Pol and a pendulum ---- */

static void pol(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = 5 * (1 - y[0] * y[0]) * y[1] - y[0] + w[0];
}

static void pendulum(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = -9.81 * sin(y[0]) - 0.1 * y[1] + 0.5 * w[0];
}

/* ---- two non-linear springs ---- */

static void duffing(double t, const double *y, const double *w, double *k)
{
    k[0] = y[1];
    k[1] = -y[0] - y[0] * y[0] * y[0] + 0.5 * w[0] + cos(1.3 * t);
}

static void hard(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = -25 * y[0] - 2 * y[0] * y[0] * y[0] + 3 * w[0] - 0.05 * y[1];
}

/* ---- a fast and a slow side, rates 1000:1; two normal modes ---- */

static const double slow_rate = 4 * 9.86960440108935861883, fast_rate = 4e6 * 9.86960440108935861883; /* (2 pi)^2 */

static void fast(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = -fast_rate * (y[0] - 0.5 * w[0]);
}

static void slow(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = -slow_rate * (y[0] - 0.3 * w[0]);
}

static double rates_exact(int side, double t)
{
    const double a = slow_rate, b = 0.3 * a, c = fast_rate, d = 0.5 * c;
    const double high = 0.5 * (a + c + sqrt((c - a) * (c - a) + 4 * b * d)), low = (a * c - b * d) / high;
    const double z_low = d / (c - low), x_high = b / (a - high); /* modes (1, z_low) and (x_high, 1) */
    const double high_part = (0.5 - z_low) / (1 - x_high * z_low), low_part = 1 - x_high * high_part;
    const double slowly = low_part * cos(sqrt(low) * t), quickly = high_part * cos(sqrt(high) * t);
    return side == 0 ? z_low * slowly + quickly : slowly + x_high * quickly;
}

/* ---- a wave and a stiff relaxation, which starts off its slow manifold ---- */

static void wave_side(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = y[1];
    k[1] = -4 * pi * pi * y[0] + 20 * w[0];
}

static void relax(double t, const double *y, const double *w, double *k)
{
    k[0] = -1000 * (y[0] - tanh(w[0]) - 0.2 * sin(3 * t));
}

static int relax_solve(double t, double g, const double *z, const double *w, double *k)
{
    k[0] = -1000 * (z[0] - tanh(w[0]) - 0.2 * sin(3 * t)) / (1 + 1000 * g);
    return 1;
}

/* ---- two rods side by side: the first is given the temperature where they meet and answers with the heat flux ---- */

enum { CELLS = 10 };
static const double rod_cell = 1. / CELLS;
static const double conductivity[2] = {0.3, 1}, capacity[2] = {1, 2};

static double rod_end(double t)
{
    return sin(5 * t);
}

/* cells 1 .. CELLS-1 beyond the common face, whose temperature is w; the far end moves with time */
static void rod_dirichlet(double t, const double *y, const double *w, double *k)
{
    const double c = conductivity[0] / (capacity[0] * rod_cell * rod_cell);
    int i;
    for (i = 0; i < CELLS - 1; i++)
        k[i] = c * ((i > 0 ? y[i - 1] : w[0]) - 2 * y[i] + (i < CELLS - 2 ? y[i + 1] : rod_end(t)));
}

static void rod_flux(const double *y, const double *w, double *out)
{
    out[0] = conductivity[0] * (y[0] - w[0]) / rod_cell;
}

/* cell 0 is half a cell of each rod at the common face; the far end is at 0 */
static void rod_neumann(double t, const double *y, const double *w, double *k)
{
    const double c = conductivity[1] / (capacity[1] * rod_cell * rod_cell);
    const double face = 0.5 * rod_cell * (capacity[0] + capacity[1]);
    int i;
    (void)t;
    k[0] = (w[0] + conductivity[1] * (y[1] - y[0]) / rod_cell) / face;
    for (i = 1; i < CELLS; i++) k[i] = c * (y[i - 1] - 2 * y[i] + (i < CELLS - 1 ? y[i + 1] : 0));
}

extern void dgtsv_(const int *n, const int *columns, double *lower, double *diagonal, double *upper, double *b,
                   const int *ldb, int *info);

/* (1 - g J) k = f(t, z): f is linear, and J is tridiagonal */
static int rod_solve(int n, double first, double first_next, double c, double g, double *k)
{
    double lower[CELLS], diagonal[CELLS], upper[CELLS];
    const int one = 1;
    int i, info;
    for (i = 0; i < n; i++) lower[i] = upper[i] = -g * c, diagonal[i] = 1 + 2 * g * c;
    diagonal[0] = 1 + g * first;
    upper[0] = -g * first_next;
    dgtsv_(&n, &one, lower, diagonal, upper, k, &n, &info);
    return info == 0;
}

static int rod_dirichlet_solve(double t, double g, const double *z, const double *w, double *k)
{
    const double c = conductivity[0] / (capacity[0] * rod_cell * rod_cell);
    rod_dirichlet(t, z, w, k);
    return rod_solve(CELLS - 1, 2 * c, c, c, g, k);
}

static int rod_neumann_solve(double t, double g, const double *z, const double *w, double *k)
{
    const double c = conductivity[1] / (capacity[1] * rod_cell * rod_cell);
    const double face = 0.5 * rod_cell * (capacity[0] + capacity[1]), first = conductivity[1] / (rod_cell * face);
    rod_neumann(t, z, w, k);
    return rod_solve(CELLS, first, first, c, g, k);
}

#define ONES                                                                                                           \
  {                                                                                                                    \
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1                                                                     \
  }

/* ---- a switched converter: the coil is connected to 10 V and to ground in turn; the capacitor feeds a lamp ---- */

static void coil(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = (phase % 2 ? 0 : 10) - w[0] - 0.1 * y[0];
}

static void capacitor(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = (w[0] - y[0] / 2 - 0.02 * y[0] * y[0] * y[0]) / 0.5;
}

/* ---- a tube of RINGS rings: a fluid that gives way a little, a wall with mass; both waves run at the same time ---- */

enum { RINGS = 8 };
#define RINGS_OF(x) x, x, x, x, x, x, x, x

/* y: pressure, velocity at the right end of each ring; w: area and its rate.  A pulse comes in on the left. */
static void blood(double t, const double *y, const double *w, double *k)
{
    const double dx = 1. / RINGS, bulk = 20, friction = 0.5, pulse = sin(pi * t);
    double in = w[0] * pulse * pulse, out;
    int i;
    for (i = 0; i < RINGS; i++) {
        const double next = i + 1 < RINGS ? y[i + 1] : 0;
        out = 0.5 * (w[i] + (i + 1 < RINGS ? w[i + 1] : w[i])) * y[RINGS + i];
        k[i] = -bulk * (w[RINGS + i] + (out - in) / dx) / w[i];
        k[RINGS + i] = (y[i] - next) / dx - friction * y[RINGS + i];
        in = out;
    }
}

/* y: area and its rate; w: pressure.  mass a'' = p - 8 (sqrt a - 1) - a'/5 */
static void vessel(double t, const double *y, const double *w, double *k)
{
    const double mass_of_wall = 0.1;
    int i;
    (void)t;
    for (i = 0; i < RINGS; i++) {
        k[i] = y[RINGS + i];
        k[RINGS + i] = (w[i] - 8 * (sqrt(y[i]) - 1) - 0.2 * y[RINGS + i]) / mass_of_wall;
    }
}

/* ---- a heater and a room: it goes off where the room is warm enough, and on again; nobody knows when ---- */

static void heater(double t, const double *y, const double *w, double *k)
{
    (void)t;
    k[0] = (phase % 2 ? 0 : 8) - 3 * (y[0] - w[0]);
}

static void room(double t, const double *y, const double *w, double *k)
{
    k[0] = 2 * (w[0] - y[0]) - 0.5 * (y[0] - sin(t));
}

static double thermostat(const double *heat, const double *warm)
{
    (void)heat;
    return phase % 2 ? warm[0] - 1 : 1.5 - warm[0];
}

static const problem problems[] = {
    {"masses",
     "two masses between springs",
     1,
     1. / 512,
     {0},
     {{2, 1, {1, 0}, {1, 10}, mass, NULL, NULL, 0}, {2, 1, {0, 0}, {1, 10}, mass, NULL, NULL, 0}},
     masses_exact,
     NULL},
    {"damped",
     "the same, damped and driven",
     10,
     1. / 256,
     {0},
     {{2, 1, {1, 0}, {1, 10}, damped_a, NULL, NULL, 0}, {2, 1, {0, 0}, {1, 10}, damped_b, NULL, NULL, 0}},
     NULL,
     NULL},
    {"load",
     "the same at rest, hit by a load at 0.36999",
     1,
     1. / 512,
     {0.36999},
     {{2, 1, {0, 0}, {1, 10}, loaded, NULL, NULL, 0}, {2, 1, {0, 0}, {1, 10}, mass, NULL, NULL, 0}},
     NULL,
     NULL},
    {"pol",
     "van der Pol and a pendulum",
     20,
     1. / 1024,
     {0},
     {{2, 1, {2, 0}, {1, 10}, pol, NULL, NULL, 0}, {2, 1, {0.5, 0}, {1, 1}, pendulum, NULL, NULL, 0}},
     NULL,
     NULL},
    {"stiff",
     "a wave and a stiff relaxation",
     2,
     1. / 1024,
     {0},
     {{2, 1, {1, 0}, {1, 10}, wave_side, NULL, NULL, 0}, {1, 1, {0}, {1}, relax, relax_solve, NULL, 0}},
     NULL,
     NULL},
    {"heat",
     "two rods, the end of one moves",
     2,
     1. / 1024,
     {0},
     {{CELLS - 1, 1, {0}, ONES, rod_dirichlet, rod_dirichlet_solve, rod_flux, 0},
      {CELLS, 1, {0}, ONES, rod_neumann, rod_neumann_solve, NULL, 0}},
     NULL,
     NULL},
    {"switch",
     "a coil switched in turn, a capacitor with a lamp",
     4,
     1. / 128,
     {0.4, 1, 1.4, 2, 2.4, 3, 3.4},
     {{1, 1, {0}, {1}, coil, NULL, NULL, 0}, {1, 1, {0}, {1}, capacitor, NULL, NULL, 0}},
     NULL,
     NULL},
    {"duffing",
     "two non-linear springs",
     10,
     1. / 256,
     {0},
     {{2, 1, {1, 0}, {1, 1}, duffing, NULL, NULL, 0}, {2, 1, {1, 0}, {1, 10}, hard, NULL, NULL, 0}},
     NULL,
     NULL},
    {"rates",
     "a fast and a slow side, 1000:1",
     1,
     1. / 32768,
     {0},
     {{2, 1, {0.5, 0}, {1, 1e3}, fast, NULL, NULL, 0}, {2, 1, {1, 0}, {1, 10}, slow, NULL, NULL, 0}},
     rates_exact,
     NULL},
    {"tube",
     "a pulse in an elastic tube",
     1,
     1. / 1024,
     {0},
     {{2 * RINGS, RINGS, {0}, ONES, blood, NULL, NULL, 0}, {2 * RINGS, 2 * RINGS, {RINGS_OF(1)}, ONES, vessel, NULL, NULL, 0}},
     NULL,
     NULL},
    {"relay",
     "a heater that switches off and on as the room asks",
     6,
     1. / 256,
     {0},
     {{1, 1, {0}, {1}, heater, NULL, NULL, 0}, {1, 1, {0}, {1}, room, NULL, NULL, 0}},
     NULL,
     thermostat},
};
enum { PROBLEMS = (int)(sizeof problems / sizeof *problems) };

static inline problem problem_named(const char *name, const char *all)
{
    int i;
    for (i = 0; i < PROBLEMS && strcmp(problems[i].name, name) != 0; i++) {}
    if (i == PROBLEMS) {
        fprintf(stderr, "--problem %s is not one of %s\n", name, all);
        exit(2);
    }
    return problems[i];
}

/* ---- what the loops call ---- */

static void model_slope(const model *m, double t, const double *y, const double *w, double *k)
{
    int i;
    m->slope(t, y, w, k);
    for (i = 0; m->faster != 0 && i < m->n; i++) k[i] *= 1 + m->faster;
}

static int model_solve(const model *m, double t, double g, const double *z, const double *w, double *k)
{
    int i, solved = m->solve(t, g * (1 + m->faster), z, w, k);
    for (i = 0; m->faster != 0 && i < m->n; i++) k[i] *= 1 + m->faster;
    return solved;
}

static void model_output(const model *m, const double *y, const double *w, double *out)
{
    if (m->output) m->output(y, w, out);
    else memcpy(out, y, (size_t)m->width * sizeof(double));
}

/* Another problem of the same kind: starts and rates of both sides by up to 3 % of themselves. */
static inline void problem_vary(problem *p, unsigned long seed)
{
    int i, j;
    for (i = 0; i < 2; i++) p->side[i].y0[0] = scene_perturbed("start", p->side[i].y0[0]);
    for (i = 0; i < 2 && seed > 0; i++)
        for (j = 0; j <= p->side[i].n; j++) {
            seed = (seed * 1103515245UL + 12345) % 2147483648UL;
            if (j < p->side[i].n) p->side[i].y0[j] *= 1 + 0.06 * ((double)seed / 2147483648. - 0.5);
            else p->side[i].faster = 0.06 * ((double)seed / 2147483648. - 0.5);
        }
    if (seed > 0) p->exact = NULL;
}

/* The fixed set-up of least work that the study has found for the accuracy wanted, and the work in parts of its. */
static inline void print_best(const char *file, const char *name, double wanted, long work)
{
    char line[300], best[200] = "", whose[20], set_up[200];
    double error, least = HUGE_VAL, evaluations;
    FILE *f = *file ? fopen(file, "r") : NULL;
    if (*file && !f) fprintf(stderr, "cannot read %s\n", file);
    while (f && fgets(line, sizeof line, f)) {
        if (sscanf(line, "best,%19[^,],%*[^,],%lf,%lf,%199[^\n]", whose, &evaluations, &error, set_up) != 4) continue;
        if (strcmp(whose, name) != 0 || error > wanted || evaluations >= least) continue;
        least = evaluations;
        strcpy(best, set_up);
    }
    if (f) fclose(f);
    if (*best) printf("best %s\nbest_evaluations %.0f\nwork_ratio %.3g\n", best, least, (double)work / least);
}

/* ---- the reference: both sides as one system, order 8, small steps ---- */

typedef struct reference {
    const problem *p;
    double t, y[2 * DEEPEST];
    int phase; /* its own count of events, where nobody tells them */
    double event; /* the last of them */
} reference;

static reference reference_start(const problem *p)
{
    reference r;
    memset(&r, 0, sizeof r);
    r.p = p;
    memcpy(r.y, p->side[0].y0, (size_t)p->side[0].n * sizeof(double));
    memcpy(r.y + p->side[0].n, p->side[1].y0, (size_t)p->side[1].n * sizeof(double));
    return r;
}

static void reference_output(const problem *p, const double *y, double *a, double *b)
{
    model_output(&p->side[1], y + p->side[0].n, NULL, b);
    model_output(&p->side[0], y, b, a);
}

static void reference_step(reference *r, double h)
{
    const rk_table *T = rk_find("dop853");
    const problem *p = r->p;
    const int n = p->side[0].n + p->side[1].n;
    double k[12 * 2 * DEEPEST], z[2 * DEEPEST], a[DEEPEST], b[DEEPEST];
    int i;
    for (i = 0; i < T->stages; i++) {
        rk_stage(T, i, h, n, r->y, k, n, z);
        reference_output(p, z, a, b);
        model_slope(&p->side[0], r->t + T->c[i] * h, z, b, k + i * n);
        model_slope(&p->side[1], r->t + T->c[i] * h, z + p->side[0].n, a, k + i * n + p->side[0].n);
    }
    rk_finish(T, h, n, r->y, k, n, r->y, NULL);
    r->t += h;
}

static int reference_past(const reference *r)
{
    double a[DEEPEST], b[DEEPEST];
    reference_output(r->p, r->y, a, b);
    return r->p->trigger(a, b) < 0;
}

/* A step, or one up to the event in it, to round-off; then behind it. */
static void reference_events(reference *r, double h)
{
    const reference before = *r;
    double early = 0, late = h;
    int i;
    reference_step(r, h);
    if (!r->p->trigger || !reference_past(r)) return;
    for (i = 0; i < 60; i++) {
        const double middle = 0.5 * (early + late);
        *r = before;
        reference_step(r, middle);
        if (reference_past(r)) late = middle;
        else early = middle;
    }
    *r = before;
    reference_step(r, late);
    r->event = r->t;
    r->phase = ++phase;
    reference_step(r, h - late);
}

static void reference_to(reference *r, double t)
{
    const int steps = (int)ceil((t - r->t) / r->p->reference_step), phase_of_run = phase;
    int j;
    if (r->p->trigger) phase = r->phase;
    for (j = 0; j < steps; j++) reference_events(r, (t - r->t) / (steps - j));
    r->t = t;
    phase = phase_of_run;
}

/* Whether the trigger falls below 0 in the window that both waves hold, and the first time where it has. */
static inline int event_in(const problem *p, const wave *a, const wave *b, double *found)
{
    double va[WIDEST], vb[WIDEST], early = b->t[b->start], late, middle;
    int j;
    for (j = 4 * b->start + 1; p->trigger && j <= 4 * (b->count - 1); j++, early = late) { /* 4 times a sample */
        const int k = (j - 1) / 4;
        late = b->t[k] + (b->t[k + 1] - b->t[k]) * (j - 4 * k) / 4;
        wave_read(a, late, va);
        wave_read(b, late, vb);
        if (p->trigger(va, vb) >= 0) continue;
        for (middle = 0.5 * (early + late); early < middle && middle < late; middle = 0.5 * (early + late)) {
            wave_read(a, middle, va);
            wave_read(b, middle, vb);
            *(p->trigger(va, vb) < 0 ? &late : &early) = middle;
        }
        *found = late;
        return 1;
    }
    return 0;
}

/* The largest error of the samples of a window that side i wrote, and the largest true number. */
static inline void judge(reference *r, int i, const wave *w, double *error, double *largest)
{
    double truth[2][DEEPEST];
    int j, c;
    for (j = w->start + 1; j < w->count; j++) {
        if (r->p->exact) truth[i][0] = r->p->exact(i, w->t[j]);
        else {
            reference_to(r, w->t[j]);
            reference_output(r->p, r->y, truth[0], truth[1]);
        }
        for (c = 0; c < w->width; c++) {
            *error = fmax(*error, fabs(truth[i][c] - w->value[w->width * j + c]));
            *largest = fmax(*largest, fabs(truth[i][c]));
        }
    }
}

#endif
