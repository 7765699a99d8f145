/* SPDX-License-Identifier: MIT

   study_rk.c - Runge-Kutta: error of steps and of dense output against evaluations and time; stability regions; what a
   dense output amplifies; the cost of a step.   study_rk DIRECTORY */
#include "study.h"

#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "examples/rk_proof.h"
#include "../stability.h"

extern void dgesv_(const int *n, const int *nrhs, double *a, const int *lda, int *ipiv, double *b, const int *ldb, int *info);

typedef long double longer;
static const double pi = 3.14159265358979323846, none = (double)NAN;
static double complex unit; /* i */

/* ---- tables: those of the list, then collocation ---- */

enum { TABLES = 100 };
static const rk_table *table[TABLES];
static int tables;

static void gather(void)
{
    static const int family[] = {RK_GAUSS, RK_GAUSS, RK_GAUSS, RK_RADAU_IIA, RK_RADAU_IIA, RK_LOBATTO_IIIC}, stages[] = {2, 3, 4, 2, 3, 3};
    int i;
    unit = csqrt(-1);
    while (tables < TABLES - 6 && rk_tables()[tables].name) table[tables] = rk_tables() + tables, tables++;
    for (i = 0; i < 6; i++) {
        rk_table *T = (rk_table *)scene_memory(sizeof *T);
        size_t bytes = rk_collocation_size(stages[i]);
        scene_check(rk_collocation(T, family[i], stages[i], scene_memory(bytes), bytes), "rk_collocation");
        table[tables++] = T;
    }
}

enum { EXPLICIT, DIAGONAL, FULL };
static int kind(const rk_table *T)
{
    int i, j, m = T->stages + T->extra, worst = EXPLICIT;
    for (i = 0; i < T->stages; i++)
        for (j = i; j < T->stages; j++)
            if (T->A[i * m + j] != 0) worst = j > i ? FULL : worst == FULL ? FULL : DIAGONAL;
    return worst;
}

/* ---- problems: y' = f(t, y) on [0, end], in double and, for a reference trajectory, in long double ---- */

static const double stiffness = 1e6;

#define PROBLEMS_IN(real)                                                                      \
    static void lotka_##real(real t, const real *y, real *f)                                   \
    {                                                                                          \
        (void)t;                                                                               \
        f[0] = y[0] * (1 - y[1]);                                                              \
        f[1] = y[1] * (y[0] - 1);                                                              \
    }                                                                                          \
    static void brusselator_##real(real t, const real *y, real *f)                             \
    {                                                                                          \
        (void)t;                                                                               \
        f[0] = 1 + y[0] * y[0] * y[1] - 4 * y[0];                                              \
        f[1] = 3 * y[0] - y[0] * y[0] * y[1];                                                  \
    }                                                                                          \
    static void vanderpol_##real(real t, const real *y, real *f)                               \
    {                                                                                          \
        (void)t;                                                                               \
        f[0] = y[1];                                                                           \
        f[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) * 1000;                                       \
    }

PROBLEMS_IN(double)
PROBLEMS_IN(longer)

static void prothero(double t, const double *y, double *f)
{
    f[0] = cos(t) - stiffness * (y[0] - sin(t));
}

/* Restricted three bodies: a closed orbit of Arenstorf */
static void arenstorf(double t, const double *y, double *f)
{
    const double mu = 0.012277471, nu = 1 - mu;
    const double d = pow((y[0] + mu) * (y[0] + mu) + y[1] * y[1], 1.5), e = pow((y[0] - nu) * (y[0] - nu) + y[1] * y[1], 1.5);
    (void)t;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = y[0] + 2 * y[3] - nu * (y[0] + mu) / d - mu * (y[0] - nu) / e;
    f[3] = y[1] - 2 * y[2] - nu * y[1] / d - mu * y[1] / e;
}

/* A chain of masses between fixed ends, the three longest waves in it */
enum { MASSES = 256 };
static void chain(double t, const double *y, double *f)
{
    const double c2 = (MASSES + 1.) * (MASSES + 1.);
    int i;
    (void)t;
    for (i = 0; i < MASSES; i++) {
        f[i] = y[MASSES + i];
        f[MASSES + i] = c2 * ((i ? y[i - 1] : 0) - 2 * y[i] + (i < MASSES - 1 ? y[i + 1] : 0));
    }
}

static void chain_exact(double t, double *y)
{
    int i, k;
    for (i = 0; i < 2 * MASSES; i++) y[i] = 0;
    for (k = 1; k <= 3; k++) {
        const double w = 2 * (MASSES + 1) * sin(0.5 * k * pi / (MASSES + 1));
        for (i = 0; i < MASSES; i++) {
            y[i] += sin(k * pi * (i + 1) / (MASSES + 1)) * cos(w * t) / k;
            y[MASSES + i] -= w * sin(k * pi * (i + 1) / (MASSES + 1)) * sin(w * t) / k;
        }
    }
}

static void prothero_exact(double t, double *y)
{
    y[0] = sin(t);
}

enum { GRID = 1 << 15 }; /* times of a reference trajectory */
typedef struct problem {
    const char *name;
    int n, stiff;
    double end;
    void (*f)(double, const double *, double *);
    void (*fl)(longer, const longer *, longer *);
    void (*exact)(double, double *);
    int substeps; /* of the reference, between times */
    double y0[4], published[4], *reference;
} problem;

static problem problems[] = {
    {"Lotka-Volterra", 2, 0, 10, lotka_double, lotka_longer, NULL, 4, {3, 2, 0, 0}, {0.124773125892978115582, 0.934993217251652592050, 0, 0}, NULL},
    {"Brusselator", 2, 0, 20, brusselator_double, brusselator_longer, NULL, 8, {1.5, 3, 0, 0}, {0.498637071268347848649856, 4.59678034945201118320174, 0, 0}, NULL},
    {"chain", 2 * MASSES, 0, 1, chain, NULL, chain_exact, 0, {0, 0, 0, 0}, {0, 0, 0, 0}, NULL},
    {"van der Pol", 2, 1, 0.5, vanderpol_double, vanderpol_longer, NULL, 32, {2, -0.66, 0, 0}, {1.59698414591119907006647, -1.02909806408644277889257, 0, 0}, NULL},
    {"Prothero-Robinson", 1, 1, 5, prothero, NULL, prothero_exact, 0, {0, 0, 0, 0}, {0, 0, 0, 0}, NULL},
};
enum { PROBLEMS = (int)(sizeof problems / sizeof *problems) };

/* Classical Runge-Kutta in long double with a million steps; returns its distance from the published end value. */
static double trajectory(problem *p)
{
    longer y[2], z[2], k[4][2], h = (longer)p->end / GRID / p->substeps;
    int i, j, m;
    double worst = 0;
    p->reference = study_vector((GRID + 1) * (ptrdiff_t)p->n);
    y[0] = (longer)p->y0[0], y[1] = (longer)p->y0[1];
    for (i = 0; i <= GRID; i++) {
        for (m = 0; m < 2; m++) p->reference[2 * i + m] = (double)y[m];
        for (j = 0; j < p->substeps; j++) {
            p->fl(0, y, k[0]);
            for (m = 0; m < 2; m++) z[m] = y[m] + h / 2 * k[0][m];
            p->fl(0, z, k[1]);
            for (m = 0; m < 2; m++) z[m] = y[m] + h / 2 * k[1][m];
            p->fl(0, z, k[2]);
            for (m = 0; m < 2; m++) z[m] = y[m] + h * k[2][m];
            p->fl(0, z, k[3]);
            for (m = 0; m < 2; m++) y[m] += h / 6 * (k[0][m] + 2 * k[1][m] + 2 * k[2][m] + k[3][m]);
        }
    }
    for (m = 0; m < 2; m++) worst = fmax(worst, fabs(p->reference[2 * GRID + m] - p->published[m]));
    return worst;
}

static double distance(const problem *p, int at, const double *y)
{
    double y_exact[2 * MASSES], worst = 0;
    const double *ref = p->exact ? y_exact : p->reference + (ptrdiff_t)at * p->n;
    int m, n = p->n == 2 * MASSES ? MASSES : p->n; /* of the chain, the displacements */
    if (p->exact) p->exact(p->end * at / GRID, y_exact);
    for (m = 0; m < n; m++) {
        double d = fabs(y[m] - ref[m]);
        if (!(d <= worst)) worst = d;
    }
    return worst;
}

/* ---- implicit stages: Newton's method on all coupled stages at once, with differences for the Jacobian ---- */

static long evaluations;

static void evaluate(const problem *p, double t, const double *y, double *f)
{
    evaluations++;
    p->f(t, y, f);
}

enum { COUPLED = 2 * RK_STAGES_MAX }; /* unknowns at most: two numbers in each stage */

/* Z_i = z_i + h sum_j a_ij f(Z_j), i, j in first ... first+count-1; k_j = f(Z_j).  n <= 2. */
static int newton(const problem *p, const rk_table *T, int first, int count, double t, double h, const double *z, double *Z, double *k)
{
    double J[2 * COUPLED], f[COUPLED], g[2], M[COUPLED * COUPLED], r[COUPLED], change, size, kept;
    const int n = p->n, N = n * count, m = T->stages + T->extra, one = 1;
    int i, j, a, b, iteration, info, pivot[COUPLED];
    for (iteration = 0; iteration < 30; iteration++) {
        for (j = 0; j < count; j++) {
            evaluate(p, t + T->c[first + j] * h, Z + j * n, f + j * n);
            for (b = 0; b < n; b++) { /* the problems are tiny: differences, not counted */
                const double d = 1e-7 * (fabs(Z[j * n + b]) + 1e-3);
                kept = Z[j * n + b];
                Z[j * n + b] += d;
                p->f(t + T->c[first + j] * h, Z + j * n, g);
                Z[j * n + b] = kept;
                for (a = 0; a < n; a++) J[(j * n + a) * n + b] = (g[a] - f[j * n + a]) / d;
            }
        }
        for (i = 0; i < count; i++)
            for (a = 0; a < n; a++) {
                r[i * n + a] = z[i * n + a] - Z[i * n + a];
                for (j = 0; j < count; j++) {
                    const double ha = h * T->A[(first + i) * m + first + j];
                    r[i * n + a] += ha * f[j * n + a];
                    for (b = 0; b < n; b++) M[(j * n + b) * N + i * n + a] = (i == j && a == b) - ha * J[(j * n + a) * n + b];
                }
            }
        dgesv_(&N, &one, M, &N, pivot, r, &N, &info);
        if (info) return -1;
        for (change = size = 0, i = 0; i < N; i++) {
            Z[i] += r[i];
            change = fmax(change, fabs(r[i]));
            size = fmax(size, fabs(Z[i]));
        }
        if (!(size < 1e10)) return -1;
        if (change <= 4e-16 * size) break;
    }
    for (j = 0; j < count; j++) {
        const double ha = h * T->A[(first + j) * m + first + j];
        if (count == 1 && ha != 0)
            for (a = 0; a < n; a++) k[a] = (Z[a] - z[a]) / ha; /* f would amplify the rounding of Z */
        else evaluate(p, t + T->c[first + j] * h, Z + j * n, k + j * n);
    }
    return 0;
}

/* The last slope of a step is the first of the next one: not counted twice. */
static int first_is_last(const rk_table *T)
{
    const int s = T->stages, m = s + T->extra;
    int j, same = s > 1 && T->A[0] == 0 && T->c[s - 1] == 1;
    for (j = 0; j < s; j++) same = same && T->A[(s - 1) * m + j] == T->b[j];
    return same;
}

/* All slopes of a step at k + i*n, those that only a dense output needs uncounted; 0, or -1 where a stage has no solution */
static int slopes(const problem *p, const rk_table *T, double t, double h, const double *y, double *k, double *z)
{
    const int n = p->n, m = T->stages + T->extra;
    double Z[COUPLED];
    int i, j;
    if (kind(T) == FULL) {
        for (i = 0; i < T->stages; i++)
            for (j = 0; j < n; j++) z[i * n + j] = Z[i * n + j] = y[j];
        return newton(p, T, 0, T->stages, t, h, z, Z, k);
    }
    for (i = 0; i < m; i++) {
        rk_stage(T, i, h, n, y, k, n, z);
        if (T->A[i * m + i] == 0) evaluate(p, t + T->c[i] * h, z, k + i * n);
        else {
            memcpy(Z, z, (size_t)n * sizeof(double));
            if (newton(p, T, i, 1, t, h, z, Z, k + i * n)) return -1;
        }
    }
    evaluations -= T->extra + first_is_last(T);
    return 0;
}

/* Equal steps.  step: error at the end; dense: largest error at 1/4, 1/2, 3/4 of all steps. */
static int integrate(const problem *p, const rk_table *T, int steps, double *step, double *dense)
{
    static double y[2 * MASSES], v[2 * MASSES], z[20 * 2 * MASSES], k[64 * 2 * MASSES];
    const double h = p->end / steps;
    const int stride = GRID / steps;
    int i, q;
    *step = *dense = 0;
    if (p->exact) p->exact(0, y);
    else memcpy(y, p->y0, (size_t)p->n * sizeof(double));
    for (i = 0; i < steps; i++) {
        if (slopes(p, T, p->end * i / steps, h, y, k, z)) return -1;
        for (q = 1; q < 4 && T->d && dense != step; q++) {
            const rk_step done = {T, h, p->n, y, k, p->n};
            rk_dense(&done, q / 4., 0, v);
            *dense = fmax(*dense, distance(p, i * stride + q * (stride / 4), v));
        }
        rk_update(T, h, p->n, y, k, p->n, y, NULL);
        if (!(fabs(y[0]) < 1e10)) return -1;
    }
    *step = distance(p, GRID, y);
    return 0;
}

static void work_precision(const char *directory)
{
    FILE *csv = study_file(directory, "rk-work.csv");
    int i, j, steps;
    double source[4096], copy_s, start;
    int repeat;
    for (i = 0; i < 4096; i++) source[i] = i;
    fprintf(csv, "problem,table,order,steps,evaluations,step_error,dense_error,seconds,over_copy\n");
    for (i = 0; i < PROBLEMS; i++) {
        problem *p = &problems[i];
        static const double targets[] = {1e-2, 1e-4, 1e-8, 1e-10};
        long least[4] = {0, 0, 0, 0};
        const char *best[4] = {"-", "-", "-", "-"};
        study_progress(p->name);
        if (!p->exact) fprintf(stderr, ", reference off the published end by %.1e", trajectory(p));
        for (j = 0; j < tables; j++) {
            const rk_table *T = table[j];
            if ((kind(T) == EXPLICIT) == p->stiff || (kind(T) == FULL && p->n > 2)) continue;
            for (steps = 4; steps <= GRID / 4; steps *= 2) {
                double step, dense, seconds, ignored;
                static double target[4096];
                int q;
                evaluations = 0;
                if (integrate(p, T, steps, &step, &dense)) continue; /* unstable, or no solution: smaller steps */
                if (!(step < 10)) continue;
                for (start = study_now(), repeat = 0; repeat < 50 && study_now() - start < 1e-3; repeat++) {
                    long counted = evaluations;
                    integrate(p, T, steps, &ignored, &ignored);
                    evaluations = counted;
                }
                seconds = (study_now() - start) / repeat;
                for (start = study_now(), repeat = 0; repeat < 100; repeat++) memcpy(target, source, sizeof target);
                copy_s = (study_now() - start) / repeat / (double)sizeof target * sizeof(double) * p->n * steps * (T->stages + 1);
                fprintf(csv, "%s,%s,%d,%d,%ld,%.4g,%.4g,%.4g,%.4g\n", p->name, T->name, T->order, steps, evaluations, step,
                        T->d ? dense : none, seconds, seconds / copy_s);
                for (q = 0; q < 4; q++)
                    if (step <= targets[q] && (!least[q] || evaluations < least[q])) least[q] = evaluations, best[q] = T->name;
                if (step < 1e-13 || evaluations > 100000) break;
            }
        }
        printf("%-18s fewest evaluations for an error of", p->name);
        for (j = 0; j < 4; j++) printf("  %.0e: %s (%ld)", targets[j], best[j], least[j]);
        printf("\n");
        free(p->reference);
    }
    fclose(csv);
}

/* Arenstorf's orbit with a simple step control: pairs only */
static void adaptive(const char *directory)
{
    FILE *csv = study_file(directory, "rk-adaptive.csv");
    static const problem p = {"Arenstorf", 4, 0, 17.0652165601579625588917206249, arenstorf, NULL, NULL, 0, {0.994, 0, 0, -2.00158510637908252240537862224}, {0, 0, 0, 0}, NULL};
    int j, e, q;
    fprintf(csv, "table,tolerance,evaluations,rejected,error\n");
    printf("%-18s closed to 1e-3 and to 1e-6 with evaluations:", p.name);
    for (j = 0; j < tables; j++) {
        const rk_table *T = table[j];
        long needed[2] = {0, 0};
        if (kind(T) != EXPLICIT || !T->order_hat || T->order < 3) continue;
        for (e = 4; e <= 26; e++) {
            double tol = pow(10, -e / 2.), t = 0, h = 1e-4, y[4], ynew[4], err[4], k[64 * 4], z[4], norm, error = 0;
            int rejected = 0;
            memcpy(y, p.y0, sizeof y);
            evaluations = 0;
            while (t < p.end && evaluations < 300000) {
                if (t + h > p.end) h = p.end - t;
                slopes(&p, T, t, h, y, k, z);
                rk_update(T, h, 4, y, k, 4, ynew, err);
                for (norm = 0, q = 0; q < 4; q++) norm = fmax(norm, fabs(err[q]) / (tol * (1 + fabs(ynew[q]))));
                if (norm <= 1) {
                    t = t + h >= p.end ? p.end : t + h;
                    memcpy(y, ynew, sizeof y);
                } else rejected++;
                h *= norm > 0 ? fmin(5, fmax(0.2, 0.9 * pow(norm, -1. / (T->order_hat + 1)))) : 5;
                if (!(h > 1e-12)) break;
            }
            if (t < p.end) continue;
            for (q = 0; q < 4; q++) error = fmax(error, fabs(y[q] - p.y0[q]));
            fprintf(csv, "%s,%.3g,%ld,%d,%.4g\n", T->name, tol, evaluations, rejected, error);
            for (q = 0; q < 2; q++)
                if (error <= (q ? 1e-6 : 1e-3) && !needed[q]) needed[q] = evaluations;
        }
        printf(" %s %ld %ld;", T->name, needed[0], needed[1]);
    }
    printf("\n");
    fclose(csv);
}

/* ---- stability ---- */

/* |R(z, theta)| for weights b(theta); b == NULL: the step's own. */
static double amplification(const rk_table *T, double complex z, const double *b)
{
    double complex Y[RK_STAGES_MAX], R = 1;
    int i;
    if (!b) return cabs(stability_function(T, z, -1));
    stability_stages(T, z, Y);
    for (i = 0; i < T->stages + T->extra; i++) R += z * b[i] * Y[i];
    return cabs(R);
}

static void regions(const char *directory)
{
    FILE *csv = study_file(directory, "rk-stability.csv"), *map;
    int j, q, x, y;
    char name[64];
    fprintf(csv, "table,kind,order,dense_order,real,imaginary,R_infinity,max_b_theta,dense_amplification,amplification_next_step\n");
    printf("%-14s %5s %5s | stable to -x, to iy | R(-inf) | dense output: max |b(theta)|, amplification in the stable region, 1 step ahead\n", "table", "order", "dense");
    for (j = 0; j < tables; j++) {
        const rk_table *T = table[j];
        double grown = 0, ahead = 0, b[64], R;
        stability a;
        scene_check(stability_of(T, 500, &a), T->name);
        for (q = 1; T->d && q <= 40; q++) { /* theta in (0, 2] */
            if (rk_weights(T, q / 20., 0, b) < 0) continue;
            for (y = 0; y <= 20; y++) { /* from the origin outwards, to where the step is unstable */
                const double complex direction = cexp(unit * pi * (0.5 + y / 40.));
                for (x = 1; x <= 80; x++) {
                    const double complex z = direction * (kind(T) == EXPLICIT ? x * 0.2 : pow(10, -2 + x / 8.));
                    if (!(amplification(T, z, NULL) <= 1 + 1e-7)) break;
                    R = amplification(T, z, b);
                    if (q <= 20) grown = fmax(grown, R);
                    else ahead = fmax(ahead, R);
                }
            }
        }
        fprintf(csv, "%s,%d,%d,%d,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", T->name, kind(T), T->order, T->dense_order, a.real_axis, a.imaginary_axis, a.r_infinity, a.dense_max, grown, ahead);
        printf("%-14s %5d %5d | %8.2f %8.2f | %8.2g | %8.2f %8.2g %8.2g\n", T->name, T->order, T->dense_order, a.real_axis, a.imaginary_axis, a.r_infinity, a.dense_max, grown, ahead);
        if (kind(T) != EXPLICIT) continue;
        sprintf(name, "region-%.40s.dat", T->name);
        map = study_file(directory, name);
        for (x = 0; x <= 90; x++, fprintf(map, "\n"))
            for (y = 0; y <= 60; y++) fprintf(map, "%g %g %.5g\n", -8 + x * 0.1, y * 0.1, fmin(9, amplification(T, -8 + x * 0.1 + unit * y * 0.1, NULL)));
        fclose(map);
    }
    fclose(csv);
}

/* ---- the cost of a step, without its right-hand sides ---- */

typedef struct large {
    const rk_table *T;
    ptrdiff_t n;
    double *y, *k, *z;
} large;

static void step_work(int contender, void *ctx)
{
    large *p = (large *)ctx;
    const rk_step done = {p->T, 0.1, p->n, p->y, p->k, p->n};
    int i;
    switch (contender) {
    case 0: memcpy(p->z, p->y, (size_t)p->n * sizeof(double)); break;
    case 1:
        for (i = 0; i < p->T->stages; i++) rk_stage(p->T, i, 0.1, p->n, p->y, p->k, p->n, p->z);
        rk_update(p->T, 0.1, p->n, p->y, p->k, p->n, p->z, NULL);
        break;
    case 2: rk_update(p->T, 0.1, p->n, p->y, p->k, p->n, p->z, p->z + p->n); break;
    case 3: rk_dense(&done, 0.37, 0, p->z); break;
    }
}

static void costs(const char *directory)
{
    FILE *csv = study_file(directory, "rk-cost.csv");
    static const ptrdiff_t sizes[] = {100, 10000, 300000};
    int i, j;
    fprintf(csv, "n,table,copy_s,step,dense\n");
    printf("cost over a copy of the state (n = 100 | 10000 | 300000): all stages and the step; one dense output\n");
    for (j = 0; j < tables; j++) {
        if (kind(table[j]) != EXPLICIT) continue;
        printf("%-14s", table[j]->name);
        for (i = 0; i < 3; i++) {
            large p = {table[j], sizes[i], NULL, NULL, NULL};
            double s[4];
            ptrdiff_t at, length = sizes[i] * (table[j]->stages + table[j]->extra);
            p.y = study_vector(p.n), p.z = study_vector(2 * p.n), p.k = study_vector(length);
            for (at = 0; at < length; at++) p.k[at] = (double)at / (double)length;
            study_race(table[j]->d ? 4 : 3, step_work, &p, s);
            fprintf(csv, "%td,%s,%.4g,%.4g,%.4g\n", p.n, table[j]->name, s[0], s[1] / s[0], table[j]->d ? s[3] / s[0] : none);
            printf(" | %7.1f; %5.1f", s[1] / s[0], table[j]->d ? s[3] / s[0] : none);
            free(p.y), free(p.z), free(p.k);
        }
        printf("\n");
    }
    fclose(csv);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: study_rk DIRECTORY\n");
        return 2;
    }
    gather();
    work_precision(argv[1]);
    adaptive(argv[1]);
    study_progress("Runge-Kutta: stability\r\033[K");
    regions(argv[1]);
    costs(argv[1]);
    return 0;
}
