/* SPDX-License-Identifier: MIT

   rates.c - two or three rates by recursion: any explicit coupling, made from any table, relaxed, adaptive.

   y' = f_0 + f_1 (+ f_2), slowest first, each with a step of its own.  One coupling splits the slow part off and leaves

      v' = f_1 + f_2 + g_0(t),   g_0(t) = sum_p tau^p F_p

   between two of its stages.  That is the same problem once more: f_1 + g_0 is the slow part, f_2 the fast one.  So the
   forcing of a forcing needs nothing new: a slow slope of the inner coupling is k_j = f_1(T_j, z_j) + g_0(T_j), the inner
   forcing g_1 is made of those, and below the last coupling a Runge-Kutta table solves v' = f_2 + g_1(t).  Each level
   keeps a handful of vectors: stages, slopes, and the F_p of one stage.

   Problems: kpr (ARKODE's, w = 1:scale), kpr3 (nested, 1 : scale : scale^2), both with exact solution; brusselator (48
   unknowns, slow advection and diffusion, fast reactions; reference from another program); exchange (a slow species and
   two fast ones; no part keeps the mass, their sum does).  */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

enum { PARTS = 3, CELLS = 16, MOST = PARTS * RK_STAGES_MAX };

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
static void brusselator(int p, double t, const double *y, double *f)
{
    const double a = 0.6, b = 2, eps = 0.01, speed = 0.5, diffusion = 0.01, dx = 1. / CELLS;
    int i, s;
    (void)t;
    if (p == 1)
        for (i = 0; i < CELLS; i++) {
            const double u = y[i], v = y[CELLS + i], w = y[2 * CELLS + i];
            f[i] = a - (w + 1) * u + v * u * u;
            f[CELLS + i] = w * u - v * u * u;
            f[2 * CELLS + i] = (b - w) / eps - w * u;
        }
    for (s = 0; s < (p == 0 ? 3 : 0); s++)
        for (i = 0; i < CELLS; i++) {
            const double *x = y + s * CELLS;
            const double left = x[(i + CELLS - 1) % CELLS], right = x[(i + 1) % CELLS];
            f[s * CELLS + i] = diffusion * (right - 2 * x[i] + left) / (dx * dx) - speed * (right - left) / (2 * dx);
        }
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

/* References: DOP853 and Radau of SciPy, which agree to 6e-15. */
static const struct problem {
    const char *name;
    int n, parts;
    double end;
    void (*f)(int part, double t, const double *y, double *f);
    void (*exact)(double t, double *y); /* or the start */
    int known;                          /* numbers at the end that another program computed; 0: exact is exact */
    int which[6];
    double reference[6];
} problems[] = {
    {"kpr", 2, 2, 5, kpr, kpr_exact, 0, {0}, {0}},
    {"kpr3", 3, 3, 1, kpr3, kpr3_exact, 0, {0}, {0}},
    {"brusselator",
     3 * CELLS,
     2,
     1,
     brusselator,
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
     exchange_start,
     3,
     {0, 1, 2},
     {0.9959815745882344, 0.2520112017381617, 0.5020072236736028}},
};
static const struct problem *problem;

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
static const struct problem proof = {"proof", MOST, PARTS, 1, symbols, NULL, 0, {0}, {0}};

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
    double z[RK_STAGES_MAX][MOST], k[RK_STAGES_MAX * MOST], both[RK_STAGES_MAX * MOST], F[RK_ORDER_MAX * MOST];
    rk_control control;
    double tolerance; /* 0: steps of size h */
    int accepted, rejected;
} level;

static level levels[PARTS];
static const rk_table *inner;

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

/* Stage i of level l: the fast solve, then the jump. */
static void stage(int l, int i, double t, double H, double *out)
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
    rk_combine(H, count, jump, n, out, C->form == RK_RELAXED && i >= C->stages - 1 ? L->both : L->k, n, out);
}

/* The slopes at stage i: slow with the forcing from above; relaxed methods also add what is faster. */
static void slope(int l, int i, double time, const forcing *g)
{
    level *L = levels + l;
    const int n = problem->n;
    double *k = L->k + i * n, *both = L->both + i * n, f[MOST];
    const double one = 1;
    int p;
    part(l, time, L->z[i], k);
    add_forcing(g, time, k);
    if (L->C->form != RK_RELAXED) return;
    memcpy(both, k, (size_t)n * sizeof *k);
    for (p = l + 1; p < problem->parts; p++) {
        part(p, time, L->z[i], f);
        rk_combine(1, 1, &one, n, both, f, n, both);
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
        if (i > 0) stage(l, i, t, H, L->z[i]);
        if (needed(C, i, yhat != NULL)) slope(l, i, t + C->c[i] * H, g);
    }
    if (yhat) stage(l, C->stages, t, H, yhat);
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
    rk_control_stop(&L->control, end, t, &L->h);
    while (t < end) {
        int status;
        memcpy(before, y, bytes);
        status = rk_control_step(&L->control, estimated_step(l, t, L->h, g, y), &t, &L->h);
        scene_check(status, rk_message(status));
        if (status == RK_REJECT) memcpy(y, before, bytes);
        if (status == RK_REJECT) L->rejected++;
        else L->accepted++;
    }
}

/* Level l and all that is faster from t over `length`, in place */
static void solve(int l, double t, double length, const forcing *g, double *y)
{
    if (levels[l].tolerance > 0) adaptive_steps(l, t, t + length, g, y);
    else fixed_steps(l, t, length, g, y);
}

/* ---- a run ------------------------------------------------------------------------------------------------------- */

static double first_step[PARTS], mass;

/* From 0 to the end; returns the root mean square error: over time for exact solutions, else of what is known. */
static double run(double *component)
{
    const int n = problem->n, outputs = problem->known ? 1 : (int)floor(problem->end / 0.1 + 0.5);
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
        for (i = 0; i < (problem->known ? problem->known : n); i++) {
            const int q = problem->known ? problem->which[i] : i;
            component[i] += pow(y[q] - x[q], 2) / outputs;
        }
    }
    for (i = 0; i < n; i++) {
        total += component[i];
        component[i] = sqrt(component[i]);
        mass += y[i];
    }
    return sqrt(total / (problem->known ? problem->known : n));
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

/* H by the embedded row, the steps inside by the pair of the table to a fixed part of the tolerance */
static void adaptive(const rk_coupling *C, double tolerance, double fraction)
{
    double component[MOST], error;
    int l;
    for (l = 0; l < problem->parts; l++) {
        if (levels[l].C) rk_control_order(&levels[l].control, "PI", C->order_hat);
        else rk_control_make(&levels[l].control, "PI", inner);
        levels[l].tolerance = l > 0 ? fraction * levels[l - 1].tolerance : tolerance;
        first_step[l] = 1e-3 * pow(0.1, l);
    }
    error = run(component);
    printf("tolerance %-7g", tolerance);
    for (l = 0; l < problem->parts; l++)
        printf("  level %d: accepted %d rejected %d", l + 1, levels[l].accepted, levels[l].rejected);
    printf("\n");
    print_run(problem->end / levels[0].accepted, error, component);
    printf("\nerror_per_tolerance %.3f\n", error / tolerance);
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
static const rk_coupling *coupling_of(const char *name, rk_coupling *made)
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
        if (jump[i] != 0) return NULL; /* asks for a solve: see multirate.c */
    }
    return C;
}

int main(int argc, char **argv)
{
    static const char *const single[] = {"", "euler", "heun", "kutta3", "rk4", "dp5"};
    static const char *const pairs[] = {"", "bs3", "bs3", "bs3", "dp5", "dp5"};
    scene_option o[] = {{"problem", "kpr3", "kpr kpr3 brusselator exchange"},
                        {"method", "KW3",
                         "KW3 ERK22a ERK33a ERK45a MERK21 .. MERK54, mis-TABLE or rmis-TABLE: TABLE is "
                         "an explicit one of rk.h, rule38 or kw"},
                        {"inner", "", "table of the fastest part; one of the coupling's order unless given"},
                        {"hs", "0.05", "slowest step"},
                        {"ratio", "10", "of a step to the next faster one"},
                        {"refine", "3", "how often hs is halved"},
                        {"tolerance", "0", "steps by the embedded rows, unless 0"},
                        {"fraction", "0.1", "of the tolerance, for the next faster level"},
                        {"scale", "10", "of a time scale to the next faster one (kpr, kpr3)"},
                        {"G", "-1", "stiffness of the slow equation (kpr, kpr3)"},
                        {"e", "0.5", "coupling (kpr, kpr3)"},
                        {NULL, NULL, NULL}};
    rk_coupling made;
    const rk_coupling *C;
    double hs, ratio, tolerance, error;
    int refinements, l, order;
    size_t i;
    scene_parse(argc, argv, "two or three rates by recursion, any explicit coupling at each level", o);
    for (i = 0; i < sizeof problems / sizeof *problems; i++)
        if (strcmp(problems[i].name, scene_text(o, "problem")) == 0) problem = problems + i;
    C = coupling_of(scene_text(o, "method"), &made);
    if (!problem || !C) {
        fprintf(stderr, "--problem is one of %s; --method is one of %s\n", o[0].help, o[1].help);
        return 2;
    }
    inner = table_of(*scene_text(o, "inner") ? scene_text(o, "inner") : single[C->order]);
    hs = scene_number(o, "hs", 1e-5, 1);
    ratio = scene_number(o, "ratio", 1, 1e4);
    refinements = scene_integer(o, "refine", 0, 10);
    tolerance = scene_number(o, "tolerance", 0, 1);
    scale = scene_number(o, "scale", 1, 1e4);
    G = scene_perturbed("G", scene_number(o, "G", -1e6, 0));
    e = scene_number(o, "e", -10, 10);
    order = rk_coupling_order(C, RK_OF_STEP);
    printf("%s on %s, the fastest part by %s\norder_by_trees %d\n", C->name, problem->name, inner->name, order);
    for (l = 0; l + 1 < problem->parts; l++) levels[l].C = C;
    if (tolerance > 0) {
        inner = table_of(*scene_text(o, "inner") ? scene_text(o, "inner") : pairs[C->order]);
        if (!C->order_hat || !inner->order_hat) {
            fprintf(stderr, "--tolerance: %s needs an embedded row, and %s a pair\n", C->name, inner->name);
            return 2;
        }
        adaptive(C, tolerance, scene_number(o, "fraction", 1e-6, 1));
        return 0;
    }
    printf("order_of_code %d\n", order_of_code(problem->parts));
    error = halve(hs, ratio, refinements);
    printf("mass_defect %.3e\n", mass);
    single_rate(single[C->order], error, hs * pow(0.5, refinements) / pow(ratio, problem->parts - 1));
    return 0;
}
