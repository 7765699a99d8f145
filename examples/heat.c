/* SPDX-License-Identifier: MIT

   heat.c - two plates exchange heat, each with time steps of its own: quasi-Newton on the whole waveform.

       alpha u_t = lambda Lap u,  alpha = rho c      D on [-1,0]x[0,1] takes the temperature at x = 0, returns the heat flux
                                                     N on [ 0,1]x[0,1] takes the flux, returns the temperature
       u = 0 on the outer boundary,  u(0,x,y) = 500 sin(pi y) sin(pi (x+1)/2),  one window, T = 10^4 s

   Linear finite elements on n interior points per direction, SDIRK2 with an embedded error, piecewise linear waveforms.
   The window is repeated: D answers the temperature x with a flux, N the flux with a temperature H(x), both from t = 0;
   quasi-Newton makes the next x, until x = H(x) at T.
   Problem, discretisation and published numbers: N. Kotarsky, P. Birken, arXiv 2502.03265 (2025).
   Relaxation factor: A. Monge, P. Birken, SIAM J. Sci. Comput. 40 (2018); P. Meisrimel, A. Monge, P. Birken,
   arXiv 2007.00410 (2020). */
#include <stddef.h>

#define WF_IMPLEMENTATION
#include "waveform.h"
#define IQN_IMPLEMENTATION
#include "iqn.h"
#define RK_IMPLEMENTATION
#include "rk.h"
#include "scene.h"

void dgbtrf_(const int *m, const int *n, const int *kl, const int *ku, double *ab, const int *ldab, int *ipiv,
             int *info);
void dgbtrs_(const char *trans, const int *n, const int *kl, const int *ku, const int *nrhs, const double *ab,
             const int *ldab, const int *ipiv, double *b, const int *ldb, int *info, size_t trans_length);

typedef struct material {
    double lambda, alpha; /* W/(m K), J/(m^3 K) */
} material;

static const material air = {0.0243, 1.293 * 1005}, water = {0.58, 999.7 * 4192.1}, steel = {48.9, 7836 * 443.0};
static const double pi = 3.14159265358979323846;

static double *vector(ptrdiff_t n)
{
    return (double *)scene_memory((size_t)n * sizeof(double));
}

/* ---- a plate: M u' + A u = (0, -flux), n+1 columns of n nodes, the interface the last (D) or the first (N) ---- */

typedef struct plate {
    material m;
    int neumann, n, nodes, unknowns; /* n (n+1) nodes; D solves for the first n n of them, N for all */
    int interface, gamma;            /* column of the interface, its first node */
    int (*at)[7];                    /* seven entries per row: node, */
    double (*M)[7], (*A)[7];         /* mass, stiffness */
    double *lu, factored;            /* band factors of M + factored A */
    int *pivot, factorisations;
    double *u, *error, *data; /* solution, its local error, the other side's data */
    double *k, *s, *z, *r;    /* stage derivatives, work */
    int steps;                /* equal steps in the window, or 0: */
    double tau, dt0;          /* error per step, first step */
    int last, total;          /* steps of the last window and of all */
} plate;

static plate plate_make(int n, material m, int neumann)
{
    static const int dx[7] = {0, 0, 0, -1, 1, -1, 1}, dy[7] = {0, -1, 1, 0, 0, -1, 1};
    static const double mass[7] = {5. / 6, -1. / 12, -1. / 12, -1. / 12, -1. / 12, 1. / 4, 1. / 4};
    static const double stiffness[7] = {4, -1, -1, -1, -1, 0, 0};
    plate p;
    int c, r, j, nodes = n * (n + 1), interface = neumann ? 0 : n;

    memset(&p, 0, sizeof p);
    p.m = m, p.neumann = neumann, p.n = n, p.nodes = nodes, p.unknowns = neumann ? nodes : n * n;
    p.interface = interface, p.gamma = interface * n;
    p.at = (int(*)[7])scene_memory((size_t)nodes * sizeof *p.at);
    p.M = (double(*)[7])scene_memory((size_t)nodes * sizeof *p.M);
    p.A = (double(*)[7])scene_memory((size_t)nodes * sizeof *p.A);
    p.lu = vector((3 * n + 4) * (ptrdiff_t)nodes);
    p.pivot = (int *)scene_memory((size_t)nodes * sizeof(int));
    p.factored = -1;
    p.u = vector(nodes), p.error = vector(nodes), p.data = vector(n);
    p.k = vector(2 * nodes), p.s = vector(nodes), p.z = vector(nodes), p.r = vector(nodes);

    for (c = 0; c <= n; c++)
        for (r = 0; r < n; r++)
            for (j = 0; j < 7; j++) {
                int i = c * n + r, column = c + dx[j], row = r + dy[j], inside;
                double half = c == interface && dx[j] == 0 ? 0.5 : 1; /* the other half is the other plate's */
                /* Two quirks of the published digits: seen from the plate, the diagonal neighbour on the interface lies
                   on the other side; seen from the interface, it is an index, which the corner carries to the next column. */
                if (column == interface && c != interface) row = r - dy[j];
                inside = column >= 0 && column <= n && ((row >= 0 && row < n) || (c == interface && column != c));
                p.at[i][j] = inside ? column * n + row : i;
                p.M[i][j] = inside ? m.alpha * half * mass[j] : 0;
                p.A[i][j] = inside ? m.lambda * (n + 1) * (n + 1) * half * stiffness[j] : 0;
            }
    return p;
}

static void plate_free(plate *p)
{
    free(p->at), free(p->M), free(p->A), free(p->lu), free(p->pivot);
    free(p->u), free(p->error), free(p->data), free(p->k), free(p->s), free(p->z), free(p->r);
}

static void initial(plate *p)
{
    int i, n = p->n;
    for (i = 0; i < p->nodes; i++) {
        double x = (double)(i / n - p->interface) / (n + 1), y = (double)(i % n + 1) / (n + 1);
        p->u[i] = 500 * sin(pi * y) * sin(pi * (x + 1) / 2);
    }
}

/* y = M x + a A z */
static void product(const plate *p, const double *x, double a, const double *z, double *y)
{
    int i, j;
    for (i = 0; i < p->nodes; i++)
        for (j = 0, y[i] = 0; j < 7; j++) y[i] += p->M[i][j] * x[p->at[i][j]] + a * p->A[i][j] * z[p->at[i][j]];
}

/* (M + a A) x = b for this side's unknowns, in place; what follows them in b stays. */
static void solve(plate *p, double a, double *b)
{
    int kl = p->n + 1, ld = 3 * kl + 1, one = 1, info, i, j;
    if (p->factored != a) {
        memset(p->lu, 0, (size_t)ld * (size_t)p->unknowns * sizeof(double));
        for (i = 0; i < p->unknowns; i++)
            for (j = 0; j < 7; j++)
                if (p->at[i][j] < p->unknowns)
                    p->lu[2 * kl + i + p->at[i][j] * (ptrdiff_t)(ld - 1)] += p->M[i][j] + a * p->A[i][j];
        dgbtrf_(&p->unknowns, &p->unknowns, &kl, &kl, p->lu, &ld, p->pivot, &info);
        scene_check(info ? -1 : 0, "singular matrix");
        p->factored = a;
        p->factorisations++;
    }
    dgbtrs_("N", &p->unknowns, &kl, &kl, &one, p->lu, &ld, p->pivot, b, &p->unknowns, &info, 1);
}

/* sqrt(scale (M e, e)/alpha), the published norm: rk_norm, which has no M, takes 325 and 284 steps where the published 323
   and 281 are taken (--adaptive 1e-3 --n 32).  e is zero beyond the unknowns */
static double norm(plate *p, double scale, const double *e)
{
    double sum = 0;
    int i;
    product(p, e, 0, e, p->r);
    for (i = 0; i < p->unknowns; i++) sum += p->r[i] * e[i];
    return sqrt(scale * sum / p->m.alpha);
}

/* ---- one SDIRK2 step ----
   Stage i is U = s + a dt k, s = u + dt sum_{j<i} a_ij k_j.  Its increment d = a dt k solves
       M d + a dt A (s + d) = -a dt (0, flux);   D knows d = g - s on the interface and leaves those rows to N. */
static void step(plate *p, const waveform *in, double t, double dt)
{
    const rk_table *R = rk_find("sdirk2");
    int i, j, n = p->n, gamma = p->gamma;
    double adt = R->A[0] * dt, *s = p->s, *z = p->z, *d = p->r, *data = p->data, *k = p->k;
    for (i = 0; i < R->stages; i++, k += p->nodes) {
        rk_stage(R, i, dt, p->nodes, p->u, p->k, p->nodes, s);
        waveform_interpolate(in, t + R->c[i] * dt, 0, data);
        memset(k, 0, (size_t)p->nodes * sizeof(double)); /* first the part of d that is known, */
        if (!p->neumann)
            for (j = 0; j < n; j++) k[gamma + j] = data[j] - s[gamma + j];
        for (j = 0; j < p->nodes; j++) z[j] = s[j] + k[j];
        product(p, k, adt, z, d);
        if (p->neumann)
            for (j = 0; j < n; j++) d[gamma + j] += adt * data[j];
        for (j = 0; j < p->nodes; j++) d[j] = -d[j];
        solve(p, adt, d);
        if (!p->neumann) memcpy(d + gamma, k + gamma, (size_t)n * sizeof(double));
        for (j = 0; j < p->nodes; j++) k[j] = d[j] / adt; /* then k */
    }
    for (j = 0; j < p->nodes; j++) p->u[j] = s[j] + d[j]; /* stiffly accurate: the last stage is the step */
    rk_finish(R, dt, p->unknowns, p->u, p->k, p->nodes, NULL, p->error);
}

/* ---- one side over the window, from its initial value: reads `in`, writes a sample per step to `out` ---- */

/* N: the temperature; D: the flux M u' + A u of the last stage, and at t = 0, as in the published digits, a difference */
static void sample(plate *p, int at_start, double *out)
{
    int i;
    if (!p->neumann && !at_start) product(p, p->k + p->nodes, 1, p->u, p->r);
    for (i = p->gamma; i < p->gamma + p->n; i++, out++) {
        *out = p->neumann ? p->u[i] : p->r[i];
        if (!p->neumann && at_start) *out = p->m.lambda * (p->u[i - p->gamma] - p->u[i]);
    }
}

/* The published control: dt_new = dt (e/tau)^(-1/3) (e_old/tau)^(1/6), without limits, and no step is taken back. */
static rk_control adaptive_steps(void)
{
    rk_control C;
    scene_check(rk_control_make(&C, "PI", rk_find("sdirk2")), "rk_control_make");
    C.k[0] = 2. / 3, C.k[1] = -1. / 3;
    C.safety = 1, C.shrink = C.least = 0, C.grow = C.accept = HUGE_VAL;
    C.steps = 1, C.e[0] = C.h[0] = 1; /* e_old of the first step is tau */
    return C;
}

static void integrate(plate *p, double T, const waveform *in, waveform *out)
{
    double t = 0, dt = p->steps ? T / p->steps : p->dt0, e;
    rk_control C = adaptive_steps();
    int done = 0, status;
    initial(p);
    wf_rollback(out->grid);
    sample(p, 1, waveform_push(out, 0));
    for (p->last = 0; !done; p->last++) {
        done = p->steps ? p->last + 1 == p->steps : t + dt >= T;
        if (done && !p->steps) dt = T - t;
        step(p, in, t, dt);
        if (p->steps) t = done ? T : (p->last + 1) * dt;
        else {
            e = norm(p, 1 / ((p->n + 1.) * (p->n + 1.)), p->error);
            status = rk_control_step(&C, e / p->tau, &t, &dt);
            scene_check(status, rk_message(status));
            if (done) t = T;
        }
        sample(p, 0, waveform_push(out, t));
    }
    p->total += p->last;
}

/* T sqrt(tau) / (100 (1 + |q|)), M q = A u0 off the interface, where both plates look like D */
static double first_step(const plate *side, double T)
{
    plate p = plate_make(side->n, side->m, 0);
    size_t gamma = (size_t)p.n * sizeof(double);
    double q;
    if (side->neumann) p.interface = -1; /* for x in u0 */
    initial(&p);
    memset(p.u + p.gamma, 0, gamma);
    product(&p, p.z, 1, p.u, p.s); /* z = 0 */
    memset(p.s + p.gamma, 0, gamma);
    solve(&p, 0, p.s);
    q = norm(&p, 1, p.s);
    plate_free(&p);
    return T * sqrt(side->tau) / (100 * (1 + q));
}

/* ---- relaxation factors in closed form ---- */

/* What a plate answers to a change of temperature at its interface within one implicit Euler step */
static double response(const plate *p, double dt)
{
    double dx = 1. / (p->n + 1), a = p->m.alpha * dx * dx, b = 6 * p->m.lambda * dt, w = 0;
    int j;
    for (j = 1; j <= p->n; j++) {
        double s = sin(j * pi * dx);
        w += 3 * dt * dx * dx * s * s / (2 * a + b + (a - b) * cos(j * pi * dx));
    }
    return (6 * dt * dx * (a + b / 2) - (a - b) * (a - b) * w) / (18 * dt * dt * dx * dx * dx);
}

static double theta_step(const plate *D, const plate *N, double dt)
{
    return 1 / (1 + response(D, dt) / response(N, dt));
}

static double theta_plateau(material D, material N)
{
    return 1 / (1 + sqrt(D.lambda * D.alpha / (N.lambda * N.alpha)));
}

/* For the plateau: more than one step, and heat passes a cell. */
static int is_long(const plate *p, double T)
{
    return T * p->m.lambda > p->m.alpha / ((p->n + 1.) * (p->n + 1.));
}

/* ---- acceleration of the temperature waveform, all its samples at once ---- */

typedef struct accelerator {
    waveform x;         /* the iterate and its grid; on the same grid */
    double *hx, *x_old; /* H(x), and the iterate that it answers */
    iqn *q;             /* the pairs, and the method */
    int method, columns;
    double omega, filter;
} accelerator;

/* The initial guess is constant in time. */
static accelerator accelerator_make(const scene_option *o, double theta, const plate *N, int capacity)
{
    static const char *const methods[] = {"ils", "relaxation", NULL};
    accelerator a;
    a.method = scene_choice(o, "method", methods) ? IQN_CONSTANT : IQN_ILS;
    a.omega = a.method == IQN_ILS ? scene_number(o, "omega", 1e-12, 2) : theta;
    a.filter = scene_number(o, "filter", 0, 1), a.columns = scene_integer(o, "columns", 0, 1000);
    a.x = waveform_make(1, N->n, capacity), a.q = NULL;
    a.hx = vector((ptrdiff_t)N->n * capacity), a.x_old = vector((ptrdiff_t)N->n * capacity);
    memcpy(waveform_push(&a.x, 0), N->u, (size_t)N->n * sizeof(double));
    return a;
}

static void accelerator_free(accelerator *a)
{
    waveform_free(&a->x), free(a->hx), free(a->x_old), free(a->q);
}

/* x, n numbers per sample, from the grid `from` to the grid `to`; work has room for the latter. */
static void regrid(const wf *from, const wf *to, double *x, double *work, int n)
{
    int status = wf_resample(from, to, n, x, n, work, n);
    scene_check(status, wf_message(status));
    memcpy(x, work, (size_t)wf_columns(to) * (size_t)n * sizeof(double));
}

/* Take the time grid of h for the iterate, and carry the history over: a pair consists of two waveforms, so sample both.
   The last iteration's pair is formed here, because the new object has not seen that iteration. */
static void move(accelerator *a, const waveform *h)
{
    const wf *from = a->x.grid, *to = h->grid;
    ptrdiff_t N = waveform_length(h), most = N > waveform_length(&a->x) ? N : waveform_length(&a->x), i;
    size_t bytes = iqn_size(N, a->columns, 1);
    double *v = vector(most), *w = vector(most), *work = vector(N);
    int n = h->n, j = a->q ? (int)iqn_get(a->q, IQN_PAIRS) : 0;
    iqn *q;

    scene_check(iqn_make(&q, N, a->columns, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set(q, IQN_METHOD, a->method);
    iqn_set(q, IQN_OMEGA, a->omega);
    iqn_set(q, IQN_FILTER_LIMIT, a->filter); /* of QR2 */
    iqn_set(q, IQN_GROWTH, 0);
    iqn_set(q, IQN_WINDOWS, 0);
    while (j-- > 0) {
        iqn_pair(a->q, j, v, w);
        regrid(from, to, v, work, n);
        regrid(from, to, w, work, n);
        iqn_push(q, v, w);
    }
    regrid(from, to, a->x.x, work, n);
    if (a->q) {
        regrid(from, to, a->x_old, work, n);
        regrid(from, to, a->hx, work, n);
        for (i = 0; i < N; i++) {
            w[i] = h->x[i] - a->hx[i];
            v[i] = w[i] - (a->x.x[i] - a->x_old[i]);
        }
        iqn_push(q, v, w);
    }
    wf_rollback(a->x.grid);
    for (j = 0; j < wf_columns(to); j++) waveform_push(&a->x, wf_time(to, j));
    free(a->q), free(v), free(w), free(work);
    a->q = q;
}

static void accelerate(accelerator *a, const waveform *h)
{
    int status = wf_resample(h->grid, a->x.grid, h->n, h->x, h->n, a->hx, h->n);
    scene_check(status, wf_message(status));
    memcpy(a->x_old, a->x.x, (size_t)waveform_length(&a->x) * sizeof(double));
    status = iqn_step(a->q, a->x.x, a->hx);
    scene_check(status, iqn_message(status));
}

/* |H(x) - x| / |H(x)| at the window end */
static double residual(const waveform *x, const waveform *h)
{
    const double *new = waveform_end(h), *old = waveform_end(x);
    double change = 0, size = 0;
    int j;
    for (j = 0; j < h->n; j++) change += (new[j] - old[j]) * (new[j] - old[j]), size += new[j] * new[j];
    return sqrt(change / size);
}

/* ---- published rows, n = 100 ---- */

static const struct published {
    const char *pair;
    double adaptive, residual[6], T_gamma;
    int last[2], total[2];
} published[] = {
    {"air_steel", 0, {4.71977744, 4.24663479, 1.94852206e-8}, 87.598475901714, {8, 8}, {24, 24}},
    {"water_steel",
     0,
     {4.73601421, 4.06628018, 3.50929073e-3, 4.56425393e-4, 5.40087194e-6, 1.41488193e-7},
     118.449295813079,
     {8, 808},
     {48, 4848}},
    {"water_steel", 0.1, {4.73757689, 4.06772552, 7.07888188e-3}, 118.768943542014, {22, 40}, {44, 118}},
    {"water_steel", 0.01, {4.73627265, 4.06518966, 5.37844329e-3}, 118.839268648776, {47, 100}, {85, 296}},
};

static void print_published(const char *pair, double adaptive, const int steps[2])
{
    const struct published *p = published, *end = p + sizeof published / sizeof *published;
    int j;
    for (; p < end; p++) {
        int same_steps = adaptive > 0 || (p->last[0] == steps[0] && p->last[1] == steps[1]);
        if (!same_steps || p->adaptive != adaptive || strcmp(p->pair, pair) != 0) continue;
        for (j = 0; j < 6 && p->residual[j] > 0; j++) printf("published_residual %d %.9g\n", j + 1, p->residual[j]);
        printf("published_iterations %d\npublished_T_gamma %.12f\n", j, p->T_gamma);
        printf("published_steps %d %d\n", p->last[0], p->last[1]);
        printf("published_totals %d %d\n", p->total[0], p->total[1]);
    }
}

int main(int argc, char **argv)
{
    static const char *const pairs[] = {"air_steel",   "water_steel", "air_water", "steel_air",
                                        "steel_water", "water_air",   NULL};
    const material materials[][2] = {{air, steel}, {water, steel}, {air, water},
                                     {steel, air}, {steel, water}, {water, air}};
    scene_option o[] = {
        {"pair", "air_steel", "materials of D and N: air_steel, water_steel, air_water or reversed"},
        {"ratio", "", "L,C instead of a pair: N is steel, D has L times its conductivity, C times its heat capacity"},
        {"steps", "8,8", "equal steps of D,N in the window"},
        {"adaptive", "0", "tolerance of adaptive steps and of the iteration; 0: equal steps"},
        {"tolerance", "1e-6", "of the iteration with equal steps: change of the temperature at T, relative"},
        {"iterations", "50", "at most"},
        {"n", "100", "interior points per direction and plate"},
        {"T", "1e4", "length of the window in seconds"},
        {"method", "ils", "ils (quasi-Newton) or relaxation"},
        {"omega", "0.1", "relaxation of the first update of ils"},
        {"columns", "20", "secant pairs, at most"},
        {"filter", "1e-2", "limit of the filter QR2"},
        {"theta", "auto", "relaxation factor; auto: closed form for one step, plateau for long windows"},
        {"dt", "0", "time step of the closed form; 0: the larger one, or the first of D"},
        {"refine", "1", "after iteration 1 N takes this many times its equal steps"},
        {"carry", "0", "1: move history and iterate to the time grid of every iteration; 0: stay on the first"},
        {NULL, NULL, NULL}};
    int pair, k, n, most, capacity, refine, carry, plateau, steps[2], converged = 0;
    double adaptive, tol, T, dt, theta, theta_one, theta_long, change, ratio[2];
    material side[2];
    plate D, N;
    waveform flux, h; /* h = H(x) */
    accelerator a;

    scene_parse(argc, argv, "two plates exchange heat, each with time steps of its own", o);
    pair = scene_choice(o, "pair", pairs);
    side[0] = materials[pair][0], side[1] = materials[pair][1];
    if (*scene_text(o, "ratio")) {
        scene_pair(o, "ratio", 1e-9, 1e9, ratio);
        side[0] = side[1] = steel;
        side[0].lambda *= ratio[0], side[0].alpha *= ratio[1];
    }
    side[0].lambda = scene_perturbed("D", side[0].lambda), side[1].lambda = scene_perturbed("N", side[1].lambda);
    n = scene_integer(o, "n", 2, 1000);
    T = scene_number(o, "T", 1e-300, 1e300);
    most = scene_integer(o, "iterations", 1, 10000);
    adaptive = scene_number(o, "adaptive", 0, 1e300);
    tol = adaptive > 0 ? adaptive : scene_number(o, "tolerance", 0, 1);
    scene_integers(o, "steps", 1, 1000000, steps);
    refine = scene_integer(o, "refine", 1, 1000);
    carry = scene_integer(o, "carry", 0, 1);
    dt = scene_number(o, "dt", 0, 1e300);

    D = plate_make(n, side[0], 0), N = plate_make(n, side[1], 1);
    if (adaptive > 0) {
        D.tau = N.tau = adaptive / 5;
        D.dt0 = first_step(&D, T), N.dt0 = first_step(&N, T);
    } else D.steps = steps[0], N.steps = steps[1];

    plateau = !(dt > 0) && (D.steps != 1 || N.steps != 1) && is_long(&D, T) && is_long(&N, T);
    if (!(dt > 0)) dt = adaptive > 0 ? D.dt0 : T / fmin(D.steps, N.steps);
    theta_one = theta_step(&D, &N, dt), theta_long = theta_plateau(D.m, N.m);
    theta = plateau ? theta_long : theta_one;
    if (strcmp(scene_text(o, "theta"), "auto") != 0) theta = scene_number(o, "theta", 1e-6, 2);

    capacity = 1 + (adaptive > 0 ? 50000 : (int)fmax(D.steps, N.steps) * refine);
    flux = waveform_make(1, n, capacity), h = waveform_make(1, n, capacity);
    initial(&N);
    a = accelerator_make(o, theta, &N, capacity);

    for (k = 0; k < most && !converged; k++) {
        integrate(&D, T, &a.x, &flux);
        integrate(&N, T, &flux, &h);
        change = residual(&a.x, &h);
        printf("residual %d %.9g\n", k + 1, change);
        converged = change <= tol;
        if (converged) continue;
        if (k == 0 || carry) move(&a, &h);
        accelerate(&a, &h);
        if (k == 0) N.steps *= refine;
    }

    if (n == 100 && a.method == IQN_ILS && !*scene_text(o, "ratio")) print_published(pairs[pair], adaptive, steps);
    if (a.method == IQN_CONSTANT)
        printf("theta_one_step %.16g\ntheta_plateau %.16g\ntheta %.16g\n", theta_one, theta_long, theta);
    printf("factorisations %d\niterations %d\n", D.factorisations + N.factorisations, k);
    printf("T_gamma %.12f\n", waveform_end(&h)[n / 2]);
    printf("steps %d %d\ntotals %d %d\n", D.last, N.last, D.total, N.total);
    plate_free(&D), plate_free(&N), waveform_free(&flux), waveform_free(&h), accelerator_free(&a);
    return converged ? 0 : 1;
}
