/* SPDX-License-Identifier: MIT

   heat.c - two plates exchange heat, each with time steps of its own: quasi-Newton on the whole waveform.

       alpha u_t = lambda Lap u,  alpha = rho c      D on [-1,0]x[0,1] takes the temperature at x = 0, returns the heat flux
                                                     N on [ 0,1]x[0,1] takes the flux, returns the temperature
       u = 0 on the outer boundary,  u(0,x,y) = 500 sin(pi y) sin(pi (x+1)/2),  one window, T = 10^4 s

   Linear finite elements on n interior points per direction, SDIRK2 with an embedded error, piecewise linear waveforms.
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

/* ---- a waveform: a time grid of the kit, and our own array of samples, n each ---- */

typedef struct waveform {
    wf *grid;
    double *x;
    int n;
} waveform;

static waveform waveform_make(int n, int capacity)
{
    waveform w;
    size_t bytes = wf_size(1, capacity);
    scene_check(wf_make(&w.grid, 1, capacity, scene_memory(bytes), bytes), "wf_make");
    w.x = vector((ptrdiff_t)n * capacity);
    w.n = n;
    return w;
}

static double *waveform_push(waveform *w, double t)
{
    int column = wf_push(w->grid, t);
    scene_check(column, wf_message(column));
    return w->x + (ptrdiff_t)column * w->n;
}

static double *waveform_end(const waveform *w)
{
    return w->x + (ptrdiff_t)(wf_columns(w->grid) - 1) * w->n;
}

/* Of degree 1, the coefficients are the samples: there is nothing to fit. */
static void waveform_at(const waveform *w, double t, double *value)
{
    int status = wf_eval(w->grid, t, 0, w->n, w->x, w->n, value);
    scene_check(status, wf_message(status));
}

/* ---- a plate: M u' + A u = (0, -flux), n+1 columns of n nodes, the interface the last (D) or the first (N) ---- */

typedef struct plate {
    int n, nodes, unknowns; /* n (n+1); D solves for the first n n of them, N for all */
    int interface, gamma;   /* column of the interface, its first node */
    double alpha, lambda;
    int (*at)[7];            /* seven entries per row: node, */
    double (*M)[7], (*A)[7]; /* mass, stiffness */
    double *lu, factored;    /* band factors of M + factored A */
    int *pivot, factorisations;
    double *u, *error, *data; /* solution, its local error, the other side's data */
    double *k, *s, *z, *r;    /* stage derivatives, work */
} plate;

static plate plate_make(int n, material m, int neumann)
{
    static const int dx[7] = {0, 0, 0, -1, 1, -1, 1}, dy[7] = {0, -1, 1, 0, 0, -1, 1};
    static const double mass[7] = {5. / 6, -1. / 12, -1. / 12, -1. / 12, -1. / 12, 1. / 4, 1. / 4};
    static const double stiffness[7] = {4, -1, -1, -1, -1, 0, 0};
    plate p;
    int c, r, j, nodes = n * (n + 1), interface = neumann ? 0 : n;

    p.n = n, p.nodes = nodes, p.unknowns = neumann ? nodes : n * n;
    p.interface = interface, p.gamma = interface * n;
    p.alpha = m.alpha, p.lambda = m.lambda;
    p.at = (int(*)[7])scene_memory((size_t)nodes * sizeof *p.at);
    p.M = (double(*)[7])scene_memory((size_t)nodes * sizeof *p.M);
    p.A = (double(*)[7])scene_memory((size_t)nodes * sizeof *p.A);
    p.lu = vector((3 * n + 4) * (ptrdiff_t)nodes);
    p.pivot = (int *)scene_memory((size_t)nodes * sizeof(int));
    p.factored = -1, p.factorisations = 0;
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

/* sqrt(scale (M e, e)/alpha); e is zero beyond the unknowns */
static double norm(plate *p, double scale, const double *e)
{
    double sum = 0;
    int i;
    product(p, e, 0, e, p->r);
    for (i = 0; i < p->unknowns; i++) sum += p->r[i] * e[i];
    return sqrt(scale * sum / p->alpha);
}

/* ---- one SDIRK2 step ----
   Stage i is U = s + a dt k, s = u + dt sum_{j<i} a_ij k_j.  Its increment d = a dt k solves
       M d + a dt A (s + d) = -a dt (0, flux);   D knows d = g - s on the interface and leaves those rows to N. */
static void step(plate *p, const waveform *in, double t, double dt, double *error)
{
    const rk_table *R = rk_find("sdirk2");
    int i, j, n = p->n, neumann = p->unknowns == p->nodes;
    double adt = R->A[0] * dt, *s = p->s, *z = p->z, *d = p->r, *data = p->data, *k = p->k;
    for (i = 0; i < R->stages; i++, k += p->nodes) {
        rk_stage(R, i, dt, p->nodes, p->u, p->k, p->nodes, s);
        waveform_at(in, t + R->c[i] * dt, data);
        memset(k, 0, (size_t)p->nodes * sizeof(double)); /* first the part of d that is known, */
        for (j = 0; j < n && !neumann; j++) k[p->gamma + j] = data[j] - s[p->gamma + j];
        for (j = 0; j < p->nodes; j++) z[j] = s[j] + k[j];
        product(p, k, adt, z, d);
        for (j = 0; j < n && neumann; j++) d[p->gamma + j] += adt * data[j];
        for (j = 0; j < p->nodes; j++) d[j] = -d[j];
        solve(p, adt, d);
        for (j = 0; j < n && !neumann; j++) d[p->gamma + j] = k[p->gamma + j];
        for (j = 0; j < p->nodes; j++) k[j] = d[j] / adt; /* then k */
    }
    for (j = 0; j < p->nodes; j++) p->u[j] = s[j] + d[j]; /* stiffly accurate: the last stage is the step */
    rk_finish(R, dt, p->unknowns, p->u, p->k, p->nodes, NULL, error);
}

/* ---- one side over the window, from its initial value: reads `in`, writes a sample per step to `out` ---- */

typedef struct stepping {
    int steps;       /* equal steps, or 0: */
    double tau, dt0; /* error per step, first step */
    int last, total; /* steps of the last call and of all */
} stepping;

static void integrate(plate *p, stepping *s, double T, const waveform *in, waveform *out)
{
    int i, n = p->n, done = 0, neumann = p->unknowns == p->nodes;
    double t = 0, dt = s->steps ? T / s->steps : s->dt0, e, e_old = s->tau, *first;
    initial(p);
    wf_rollback(out->grid);
    first = waveform_push(out, 0);
    for (i = 0; i < n; i++) /* the flux at t = 0 is one more quirk of the published digits */
        first[i] = neumann ? p->u[p->gamma + i] : p->lambda * (p->u[i] - p->u[p->gamma + i]);
    for (s->last = 0; !done; s->last++) {
        done = s->steps ? s->last + 1 == s->steps : t + dt >= T;
        if (done && !s->steps) dt = T - t;
        step(p, in, t, dt, p->error);
        t = done ? T : s->steps ? (s->last + 1) * dt : t + dt;
        if (!neumann) product(p, p->k + p->nodes, 1, p->u, p->r); /* flux = M u' + A u */
        memcpy(waveform_push(out, t), (neumann ? p->u : p->r) + p->gamma, (size_t)n * sizeof(double));
        if (!s->steps) { /* PI control */
            e = norm(p, 1 / ((n + 1.) * (n + 1.)), p->error);
            dt *= pow(s->tau / e, 1. / 3) * pow(s->tau / e_old, -1. / 6);
            e_old = e;
        }
    }
    s->total += s->last;
}

/* T sqrt(tau) / (100 (1 + |q|)), M q = A u0 off the interface, where both plates look like D */
static double first_step(int n, material m, int neumann, double tau, double T)
{
    plate p = plate_make(n, m, 0);
    size_t gamma = (size_t)n * sizeof(double);
    double q;
    if (neumann) p.interface = -1;
    initial(&p);
    memset(p.u + p.gamma, 0, gamma);
    memset(p.z, 0, (size_t)p.nodes * sizeof(double));
    product(&p, p.z, 1, p.u, p.s);
    memset(p.s + p.gamma, 0, gamma);
    solve(&p, 0, p.s);
    q = norm(&p, 1, p.s);
    plate_free(&p);
    return T * sqrt(tau) / (100 * (1 + q));
}

/* ---- relaxation factors in closed form ---- */

/* What side m answers to a change of temperature at its interface within one implicit Euler step */
static double response(int n, material m, double dt)
{
    double dx = 1. / (n + 1), a = m.alpha * dx * dx, b = 6 * m.lambda * dt, w = 0;
    int j;
    for (j = 1; j <= n; j++) {
        double s = sin(j * pi * dx);
        w += 3 * dt * dx * dx * s * s / (2 * a + b + (a - b) * cos(j * pi * dx));
    }
    return (6 * dt * dx * (a + b / 2) - (a - b) * (a - b) * w) / (18 * dt * dt * dx * dx * dx);
}

static double theta_step(int n, material D, material N, double dt)
{
    return 1 / (1 + response(n, D, dt) / response(n, N, dt));
}

static double theta_plateau(material D, material N)
{
    return 1 / (1 + sqrt(D.lambda * D.alpha / (N.lambda * N.alpha)));
}

/* ---- acceleration of the temperature waveform, all its samples at once ---- */

typedef struct accelerator {
    waveform x;             /* the iterate and its grid; on the same grid */
    double *hx;             /* H(x), */
    double *x_old, *hx_old; /* those of the last iteration, */
    iqn *q;                 /* the pairs, and the method */
    int method, columns;
    double omega, filter;
} accelerator;

static ptrdiff_t length(const waveform *w)
{
    return (ptrdiff_t)wf_columns(w->grid) * w->n;
}

/* y on the grid `to` from x on the grid `from`, n numbers per sample */
static void sample(const wf *from, const double *x, const wf *to, double *y, int n)
{
    int j, status;
    for (j = 0; j < wf_columns(to); j++) {
        status = wf_eval(from, wf_time(to, j), 0, n, x, n, y + (ptrdiff_t)j * n);
        scene_check(status, wf_message(status));
    }
}

static void regrid(const wf *from, const wf *to, double *x, double *work, int n)
{
    sample(from, x, to, work, n);
    memcpy(x, work, (size_t)wf_columns(to) * (size_t)n * sizeof(double));
}

/* Take the time grid of h for the iterate, and carry the history over: a pair consists of two waveforms, so sample both.
   The last iteration's pair is formed here, because the new object has not seen that iteration. */
static void move(accelerator *a, const waveform *h)
{
    const wf *from = a->x.grid, *to = h->grid;
    ptrdiff_t N = length(h), most = N > length(&a->x) ? N : length(&a->x), i;
    size_t bytes = iqn_size(N, a->columns, 1);
    double *v = vector(most), *w = vector(most), *work = vector(N);
    int n = h->n, j = a->q ? (int)iqn_get(a->q, IQN_COLUMNS) : 0;
    iqn *q;

    scene_check(iqn_make(&q, N, a->columns, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set(q, IQN_METHOD, a->method);
    iqn_set(q, IQN_OMEGA, a->omega);
    iqn_set(q, IQN_EPSILON, a->filter); /* of QR2 */
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
        regrid(from, to, a->hx_old, work, n);
        for (i = 0; i < N; i++) {
            w[i] = h->x[i] - a->hx_old[i];
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
    size_t bytes = (size_t)length(&a->x) * sizeof(double);
    int status;
    sample(h->grid, h->x, a->x.grid, a->hx, h->n);
    memcpy(a->x_old, a->x.x, bytes);
    memcpy(a->hx_old, a->hx, bytes);
    status = iqn_step(a->q, a->x.x, a->hx);
    scene_check(status, iqn_message(status));
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

static const struct published *find(const char *pair, double adaptive, const int steps[2])
{
    size_t i;
    for (i = 0; i < sizeof published / sizeof *published; i++) {
        const struct published *p = &published[i];
        int equal = adaptive > 0 ? p->adaptive == adaptive
                                 : !(p->adaptive > 0) && p->last[0] == steps[0] && p->last[1] == steps[1];
        if (equal && strcmp(p->pair, pair) == 0) return p;
    }
    return NULL;
}

int main(int argc, char **argv)
{
    static const char *const pairs[] = {"air_steel",   "water_steel", "air_water", "steel_air",
                                        "steel_water", "water_air",   NULL};
    static const char *const methods[] = {"ils", "relaxation", NULL};
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
    int pair, k, j, n, most, capacity, is_long, steps[2], converged = 0;
    double adaptive, tol, T, dt, theta, residual, ratio[2];
    material D, N, side[2];
    plate plates[2];
    stepping s[2] = {{0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}};
    waveform flux, h;
    accelerator a;
    const struct published *p;

    scene_parse(argc, argv, "two plates exchange heat, each with time steps of its own", o);
    pair = scene_choice(o, "pair", pairs);
    D = materials[pair][0], N = materials[pair][1];
    if (*scene_text(o, "ratio")) {
        scene_pair(o, "ratio", 1e-9, 1e9, ratio);
        D = N = steel;
        D.lambda *= ratio[0], D.alpha *= ratio[1];
    }
    side[0] = D, side[1] = N;
    n = scene_integer(o, "n", 2, 1000);
    T = scene_number(o, "T", 1e-300, 1e300);
    most = scene_integer(o, "iterations", 1, 10000);
    adaptive = scene_number(o, "adaptive", 0, 1e300);
    tol = adaptive > 0 ? adaptive : scene_number(o, "tolerance", 0, 1);
    scene_integers(o, "steps", 1, 1000000, steps);

    for (j = 0; j < 2; j++) {
        plates[j] = plate_make(n, side[j], j);
        s[j].tau = adaptive / 5;
        if (adaptive > 0) s[j].dt0 = first_step(n, side[j], j, s[j].tau, T);
        else s[j].steps = steps[j];
    }

    /* Long: more than one step, and heat passes a cell of either plate. */
    is_long = (adaptive > 0 || steps[0] > 1 || steps[1] > 1) && T * D.lambda > D.alpha / ((n + 1.) * (n + 1.)) &&
              T * N.lambda > N.alpha / ((n + 1.) * (n + 1.));
    dt = scene_number(o, "dt", 0, 1e300);
    if (dt > 0) is_long = 0;
    else dt = adaptive > 0 ? s[0].dt0 : T / (steps[0] < steps[1] ? steps[0] : steps[1]);
    theta = is_long ? theta_plateau(D, N) : theta_step(n, D, N, dt);
    if (strcmp(scene_text(o, "theta"), "auto") != 0) theta = scene_number(o, "theta", 1e-6, 2);
    a.method = scene_choice(o, "method", methods) ? IQN_CONSTANT : IQN_ILS;
    a.omega = a.method == IQN_ILS ? scene_number(o, "omega", 1e-12, 2) : theta;
    a.filter = scene_number(o, "filter", 0, 1), a.columns = scene_integer(o, "columns", 0, 1000);

    capacity =
        1 + (adaptive > 0 ? 50000 : (steps[0] > steps[1] ? steps[0] : steps[1]) * scene_integer(o, "refine", 1, 1000));
    flux = waveform_make(n, capacity), h = waveform_make(n, capacity), a.x = waveform_make(n, capacity);
    a.hx = vector((ptrdiff_t)n * capacity), a.x_old = vector((ptrdiff_t)n * capacity),
    a.hx_old = vector((ptrdiff_t)n * capacity);
    a.q = NULL;
    initial(&plates[1]);
    memcpy(waveform_push(&a.x, 0), plates[1].u, (size_t)n * sizeof(double)); /* initial guess: constant in time */

    for (k = 0; k < most && !converged; k++) {
        double change = 0, size = 0, *new, *old;
        integrate(&plates[0], &s[0], T, &a.x, &flux);
        integrate(&plates[1], &s[1], T, &flux, &h);
        new = waveform_end(&h), old = waveform_end(&a.x);
        for (j = 0; j < n; j++) change += (new[j] - old[j]) * (new[j] - old[j]), size += new[j] * new[j];
        residual = sqrt(change / size);
        printf("residual %d %.9g\n", k + 1, residual);
        converged = residual <= tol;
        if (converged) continue;
        if (k == 0 || scene_integer(o, "carry", 0, 1)) move(&a, &h);
        accelerate(&a, &h);
        if (k == 0) s[1].steps *= scene_integer(o, "refine", 1, 1000);
    }

    p = n == 100 && a.method == IQN_ILS && !*scene_text(o, "ratio") ? find(pairs[pair], adaptive, steps) : NULL;
    for (j = 0; p && j < 6 && p->residual[j] > 0; j++) printf("published_residual %d %.9g\n", j + 1, p->residual[j]);
    if (p) {
        printf("published_iterations %d\n", j);
        printf("published_T_gamma %.12f\n", p->T_gamma);
        printf("published_steps %d %d\n", p->last[0], p->last[1]);
        printf("published_totals %d %d\n", p->total[0], p->total[1]);
    }
    if (a.method == IQN_CONSTANT) {
        printf("theta_one_step %.16g\n", theta_step(n, D, N, dt));
        printf("theta_plateau %.16g\n", theta_plateau(D, N));
        printf("theta %.16g\n", theta);
    }
    printf("factorisations %d\n", plates[0].factorisations + plates[1].factorisations);
    printf("iterations %d\n", k);
    printf("T_gamma %.12f\n", waveform_end(&h)[n / 2]);
    printf("steps %d %d\n", s[0].last, s[1].last);
    printf("totals %d %d\n", s[0].total, s[1].total);
    plate_free(&plates[0]), plate_free(&plates[1]);
    free(flux.grid), free(flux.x), free(h.grid), free(h.x), free(a.x.grid), free(a.x.x);
    free(a.hx), free(a.x_old), free(a.hx_old), free(a.q);
    return converged ? 0 : 1;
}
