/* SPDX-License-Identifier: MIT

   study_dense.c - the error of dense output: what its estimate is worth, and what a step control makes of it.

   estimate: D = h (u' - f) at two values of theta, for implicit tables solved with the matrix of the stages; the larger |D|
   over a number, beside the largest true error inside the step.  5 and 95 % of all steps of four lengths, the smallest
   and the largest over the problems the values were chosen on and over others.
   control: y' = lambda (y - phi) + phi', lambda = -1e6, by esdirk5 at a tolerance of 1e-6, the step chosen by the
   embedded estimate as it is, by the same filtered, by the filtered one and D together: steps and largest error inside. */
#define RK_IMPLEMENTATION
#include "rk.h"
#include "../column_at.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 4, SAMPLES = 16, STEPS = 60, LENGTHS = 4 };

extern void dgesv_(const int *n, const int *nrhs, double *a, const int *lda, int *pivot, double *b, const int *ldb,
                   int *info);

/* ---- problems ------------------------------------------------------------------------------------------------------ */

typedef struct problem {
    const char *name;
    int n, chosen, stiff; /* chosen: the thetas were chosen on it */
    double lambda, end, h, y0[MOST];
    void (*f)(double lambda, double t, const double *y, double *f);
} problem;

static void brusselator(double lambda, double t, const double *y, double *f)
{
    (void)lambda, (void)t;
    f[0] = 1 + y[0] * y[0] * y[1] - 4 * y[0];
    f[1] = 3 * y[0] - y[0] * y[0] * y[1];
}

static void wave(double lambda, double t, const double *y, double *f)
{
    (void)lambda, (void)t;
    f[0] = y[1];
    f[1] = -36 * y[0];
}

static double phi(double t)
{
    return sin(t) + 0.5 * cos(2 * t);
}

static void prothero_robinson(double lambda, double t, const double *y, double *f)
{
    f[0] = lambda * (y[0] - phi(t)) + cos(t) - sin(2 * t);
}

static void van_der_pol(double lambda, double t, const double *y, double *f)
{
    (void)t;
    f[0] = y[1];
    f[1] = lambda * ((1 - y[0] * y[0]) * y[1] - y[0]);
}

static void wave_with_stiff_part(double lambda, double t, const double *y, double *f)
{
    f[0] = y[1];
    f[1] = -36 * y[0] + 4 * y[2];
    f[2] = lambda * (y[2] - y[0] - 0.2 * sin(3 * t));
}

static const problem problems[] = {
    {"Brusselator", 2, 1, 0, 0, 8, 0.1, {1.5, 3}, brusselator},
    {"wave", 2, 0, 0, 0, 4, 0.1, {1, 0}, wave},
    {"Prothero-Robinson -10", 1, 0, 0, -1e1, 4, 0.25, {0.5}, prothero_robinson},
    {"Prothero-Robinson -1e2", 1, 1, 0, -1e2, 4, 0.25, {0.5}, prothero_robinson},
    {"Prothero-Robinson -1e4", 1, 0, 1, -1e4, 4, 0.25, {0.5}, prothero_robinson},
    {"Prothero-Robinson -1e6", 1, 1, 1, -1e6, 4, 0.25, {0.5}, prothero_robinson},
    {"van der Pol 1e6", 2, 1, 1, 1e6, 0.6, 0.05, {2, -2. / 3}, van_der_pol},
    {"wave, stiff part", 3, 0, 1, -1e6, 3, 0.1, {1, 0, 1}, wave_with_stiff_part},
};
enum { PROBLEMS = sizeof problems / sizeof *problems };

/* ---- a step -------------------------------------------------------------------------------------------------------- */

static void jacobian(const problem *p, double t, const double *y, double *J)
{
    double f0[MOST], f1[MOST], z[MOST];
    int i, j;
    p->f(p->lambda, t, y, f0);
    for (j = 0; j < p->n; j++) {
        const double d = 1e-7 * fmax(1, fabs(y[j]));
        memcpy(z, y, sizeof z);
        z[j] += d;
        p->f(p->lambda, t, z, f1);
        for (i = 0; i < p->n; i++) J[j * p->n + i] = (f1[i] - f0[i]) / d;
    }
}

/* b := (1 - g J)^-1 b */
static void filter(int n, double g, const double *J, double *b)
{
    double M[MOST * MOST];
    int pivot[MOST], info, one = 1, i;
    for (i = 0; i < n * n; i++) M[i] = (i % (n + 1) == 0) - g * J[i];
    dgesv_(&n, &one, M, &n, pivot, b, &n, &info);
}

static double largest(int n, const double *v)
{
    double most = 0;
    int i;
    for (i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

/* k_i from Z = z + g f(Z), by Newton's method; the Jacobian is renewed now and then. */
static void implicit_slope(const problem *p, double t, double g, const double *z, double *k)
{
    double Z[MOST], J[MOST * MOST], r[MOST] = {0};
    int i, count;
    memcpy(Z, z, (size_t)p->n * sizeof *Z);
    for (count = 0; count < 12; count++) {
        if (count % 3 == 0) jacobian(p, t, Z, J);
        p->f(p->lambda, t, Z, r);
        for (i = 0; i < p->n; i++) r[i] = z[i] + g * r[i] - Z[i];
        filter(p->n, g, J, r);
        for (i = 0; i < p->n; i++) Z[i] += r[i];
        if (largest(p->n, r) < 1e-15) break;
    }
    for (i = 0; i < p->n; i++) k[i] = (Z[i] - z[i]) / g;
}

static void slopes(const rk_table *T, const problem *p, double t, double h, const double *y, double *k)
{
    const int m = T->stages + T->extra;
    int i;
    for (i = 0; i < m; i++) {
        const double g = h * T->A[i * m + i];
        double z[MOST];
        rk_stage(T, i, h, p->n, y, k, p->n, z);
        if (g == 0) p->f(p->lambda, t + T->c[i] * h, z, k + i * p->n);
        else implicit_slope(p, t + T->c[i] * h, g, z, k + i * p->n);
    }
}

/* The exact solution at t + d from y at t: a formula, or small steps of another method. */
static void local_solution(const problem *p, double t, double d, double *y)
{
    const rk_table *T = rk_find(p->stiff ? "esdirk5" : "dop853");
    double k[RK_STAGES_MAX * MOST];
    int i;
    if (p->f == prothero_robinson) {
        y[0] = phi(t + d) + (y[0] - phi(t)) * exp(p->lambda * d);
        return;
    }
    for (i = 0; i < 4; i++) {
        slopes(T, p, t + i * d / 4, d / 4, y, k);
        rk_update(T, d / 4, p->n, y, k, p->n, y, NULL);
    }
}

static double error_inside(const rk_step *s, const problem *p, double t)
{
    double exact[MOST], u[MOST], worst = 0;
    int i, j;
    memcpy(exact, s->y, (size_t)p->n * sizeof *exact);
    for (j = 1; j < SAMPLES; j++) {
        local_solution(p, t + (j - 1) * s->h / SAMPLES, s->h / SAMPLES, exact);
        rk_dense(s, j / (double)SAMPLES, 0, u);
        for (i = 0; i < p->n; i++) u[i] -= exact[i];
        worst = fmax(worst, largest(p->n, u));
    }
    return worst;
}

static double defect(const rk_step *s, const problem *p, double t, double theta)
{
    const int m = s->T->stages + s->T->extra, last = s->T->stages - 1;
    double u[MOST], du[MOST], f[MOST], J[MOST * MOST];
    int i;
    rk_dense(s, theta, 0, u);
    rk_dense(s, theta, 1, du);
    p->f(p->lambda, t + theta * s->h, u, f);
    for (i = 0; i < p->n; i++) du[i] = s->h * (du[i] - f[i]);
    jacobian(p, t, s->y, J);
    if (rk_is(s->T, RK_EXPLICIT) != 1) filter(p->n, s->h * s->T->A[last * m + last], J, du);
    return largest(p->n, du);
}

/* ---- estimate ------------------------------------------------------------------------------------------------------ */

/* Column `at` of TABLES in rk.h. */
struct rule {
    const char *table;
    double theta[2], number;
};

static double estimate(const struct rule *r, const rk_step *s, const problem *p, double t)
{
    return fmax(defect(s, p, t, r->theta[0]), defect(s, p, t, r->theta[1])) / r->number;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Estimate over true error of up to `room` steps of one length; errors below round-off do not count. */
static int ratios(const struct rule *r, const problem *p, double h, double *ratio)
{
    const rk_table *T = rk_find(r->table);
    const int steps = (int)fmin(STEPS, floor(p->end / h));
    double y[MOST], k[RK_STAGES_MAX * MOST], error;
    const rk_step s = {T, h, p->n, y, k, p->n};
    int i, count = 0;
    memcpy(y, p->y0, sizeof y);
    for (i = 0; i < steps; i++) {
        slopes(T, p, i * h, h, y, k);
        error = i == 0 && p->stiff ? 0 : error_inside(&s, p, i * h); /* no initial layer */
        if (error > 1e-12 * largest(p->n, y) && error < 0.1 * largest(p->n, y))
            ratio[count++] = estimate(r, &s, p, i * h) / error;
        rk_update(T, h, p->n, y, k, p->n, y, NULL);
    }
    return count;
}

static void print_estimate(const struct rule *r, double range[2])
{
    static double ratio[LENGTHS * STEPS];
    const int implicit = rk_is(rk_find(r->table), RK_EXPLICIT) != 1;
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {0, 0};
    int i, e;
    for (i = 0; i < PROBLEMS; i++) {
        const problem *p = problems + i;
        const double shorter = p->lambda != 0 && !implicit ? 4 : 1;
        int count = 0, at;
        if (p->stiff && !implicit) continue;
        for (e = 0; e < LENGTHS; e++) count += ratios(r, p, p->h / shorter / (1 << e), ratio + count);
        if (count < 5) continue;
        qsort(ratio, (size_t)count, sizeof *ratio, ascending);
        at = count / 20;
        low[p->chosen] = fmin(low[p->chosen], ratio[at]);
        high[p->chosen] = fmax(high[p->chosen], ratio[count - 1 - at]);
    }
    printf("%-10s %.2f %.2f %4g   chosen on: %.2f .. %.2f   others: %.2f .. %.2f\n", r->table, r->theta[0], r->theta[1],
           r->number, low[1], high[1], low[0], high[0]);
    range[0] = fmin(range[0], fmin(low[0], low[1]));
    range[1] = fmax(range[1], fmax(high[0], high[1]));
}

/* ---- control ------------------------------------------------------------------------------------------------------- */

enum { RAW = 0, FILTERED, BOTH };

static void print_control(const struct rule *r, const problem *p, double tolerance, int kind)
{
    static const char *const name[] = {"embedded", "filtered", "filtered and D"};
    const rk_table *T = rk_find(r->table);
    double y[MOST], ynew[MOST], err[MOST], k[RK_STAGES_MAX * MOST], J[MOST * MOST], t = 0, h = 1e-3, inside = 0, end;
    rk_step s = {T, 0, p->n, y, k, p->n};
    rk_control C;
    memcpy(y, p->y0, sizeof y);
    rk_control_make(&C, "I", T);
    C.stop = p->end;
    while (t < p->end) {
        double e, error;
        slopes(T, p, t, h, y, k);
        rk_update(T, h, p->n, y, k, p->n, ynew, err);
        jacobian(p, t, y, J);
        if (kind != RAW) filter(p->n, h * T->A[T->stages * T->stages - 1], J, err);
        s.h = h;
        e = largest(p->n, err);
        if (kind == BOTH) e = fmax(e, estimate(r, &s, p, t));
        error = error_inside(&s, p, t);
        if (rk_control_step(&C, e / tolerance, &t, &h) != RK_OK) continue;
        inside = fmax(inside, error);
        memcpy(y, ynew, sizeof y);
    }
    end = fabs(y[0] - phi(t));
    printf("%-10s %-16s %4d steps, error inside %.2g, at the end %.2g tolerances\n", r->table, name[kind], C.steps,
           inside / tolerance, end / tolerance);
}

int main(void)
{
    double range[2] = {HUGE_VAL, 0};
    const rk_table *T;
    struct rule r;
    int kind;
    printf("|D| at two thetas over a number, over the true error: 5 and 95 %% of the steps, worst problem\n");
    for (T = rk_tables(); T->name; T++) {
        r.table = T->name;
        if (!column_at(T->name, r.theta, &r.number)) {
            printf("%s has no column at in rk.h\n", T->name);
            return 1;
        }
        if (rk_is(T, RK_SEQUENTIAL) == 1) print_estimate(&r, range); /* radau5, radau9: examples/stiff.c */
    }
    printf("all: %.2f .. %.2f\n\nstep control, Prothero-Robinson, lambda -1e6, tolerance 1e-6\n", range[0], range[1]);
    for (T = rk_tables(); T->name; T++) {
        r.table = T->name;
        column_at(T->name, r.theta, &r.number);
        for (kind = RAW; strncmp(T->name, "esdirk", 6) == 0 && kind <= BOTH; kind++) print_control(&r, problems + 5, 1e-6, kind);
    }
    return 0;
}
