/* SPDX-License-Identifier: MIT

   peer_rk.c - adaptive runs by the loop of rk.h's synopsis: evaluations and error at equal tolerance, for peer_rk.py, which
   sets SciPy's numbers beside them.   peer_rk [CONTROLLER]: I is SciPy's law, the default.
   peer_rk controllers: what each law of rk_control and its two further settings gain and lose. */
#define RK_IMPLEMENTATION
#include "rk.h"

#include <stdio.h>

enum { MOST = 8 };

static long evaluations;

typedef struct problem {
    const char *name;
    int n;
    double end, y0[MOST], exact[MOST];
    void (*f)(double t, const double *y, double *f);
} problem;

static void brusselator(double t, const double *y, double *f)
{
    (void)t;
    f[0] = 1 + y[0] * y[0] * y[1] - 4 * y[0];
    f[1] = 3 * y[0] - y[0] * y[0] * y[1];
}

static void arenstorf(double t, const double *y, double *f)
{
    const double mu = 0.012277471, nu = 1 - mu, px = y[0] + mu, qx = y[0] - nu, y2 = y[1] * y[1];
    const double d = pow(px * px + y2, 1.5), e = pow(qx * qx + y2, 1.5);
    (void)t;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = y[0] + 2 * y[3] - nu * px / d - mu * qx / e;
    f[3] = y[1] - 2 * y[2] - nu * y[1] / d - mu * y[1] / e;
}

static void van_der_pol(double t, const double *y, double *f)
{
    (void)t;
    f[0] = y[1];
    f[1] = 5 * (1 - y[0] * y[0]) * y[1] - y[0];
}

static void hires(double t, const double *y, double *f)
{
    const double r = 280 * y[5] * y[7];
    (void)t;
    f[0] = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
    f[1] = 1.71 * y[0] - 8.75 * y[1];
    f[2] = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
    f[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
    f[4] = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6];
    f[5] = -r + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
    f[6] = r - 1.81 * y[6];
    f[7] = -r + 1.81 * y[6];
}

/* Ends: Taylor series of 40 digits; a closed orbit; Taylor series; Hairer & Wanner's reference. */
static const problem problems[] = {
    {"brusselator", 2, 20, {1.5, 3}, {0.498637071268347848649856, 4.59678034945201118320174}, brusselator},
    {"arenstorf", 4, 17.0652165601579625588917206249, {0.994, 0, 0, -2.00158510637908252240537862224},
     {0.994, 0, 0, -2.00158510637908252240537862224}, arenstorf},
    {"vanderpol", 2, 20, {2, 0}, {-1.60129687954285390882168437713, 0.198326676338662084549513629203}, van_der_pol},
    {"hires", 8, 321.8122, {1, 0, 0, 0, 0, 0, 0, 0.0057},
     {0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2, 0.2386356198831331e-2,
      0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2}, hires},
};

static void evaluate(const problem *p, double t, const double *y, double *f)
{
    evaluations++;
    p->f(t, y, f);
}

static double norm(const problem *p, double tol, const double *v, const double *y0, const double *y1)
{
    double sum[2] = {0};
    rk_norm(tol, tol, NULL, p->n, v, y0, y1, sum);
    return rk_rms(sum);
}

/* The protocol of rk_first_step; k_0 is known. */
static double first_step(const problem *p, const rk_table *T, double tol, const double *y, double *k)
{
    const double one[] = {1}, difference[] = {-1, 1};
    double z[MOST], d0 = norm(p, tol, y, y, NULL), d1 = norm(p, tol, k, y, NULL), h;
    h = rk_first_step(rk_error_order(T), p->end, d0, d1, -1);
    rk_combine(h, 1, one, p->n, y, k, p->n, z);
    evaluate(p, h, z, k + p->n);
    rk_combine(1 / h, 2, difference, p->n, NULL, k, p->n, z);
    return rk_first_step(rk_error_order(T), p->end, d0, d1, norm(p, tol, z, y, NULL));
}

typedef struct setting {
    const char *name, *method; /* method NULL: by the rows of NOTES */
    double k[5];
} setting;

typedef struct result {
    long evaluations;
    int steps, rejected;
    double error;
} result;

static result run(const problem *p, const rk_table *T, const setting *set, double tol)
{
    result r;
    const int n = p->n, last = T->stages - 1;
    double k[16 * MOST], y[MOST], ynew[MOST], z[MOST], err[MOST], t = 0, h, worst = 0;
    int i, status, rejected = 0;
    rk_control C;
    rk_control_make(&C, set->method ? set->method : "I", T);
    if (!set->method) memcpy(C.k, set->k, sizeof C.k);
    memcpy(y, p->y0, sizeof y);
    evaluations = 0;
    evaluate(p, 0, y, k);
    h = first_step(p, T, tol, y, k);
    rk_control_stop(&C, p->end, t, &h);
    while (t < p->end) {
        double e;
        for (i = 1; i < T->stages; i++) {
            rk_stage(T, i, h, n, y, k, n, z);
            evaluate(p, t + T->c[i] * h, z, k + i * n);
        }
        rk_update(T, h, n, y, k, n, ynew, err);
        e = norm(p, tol, err, y, ynew);
        if (T->e3) {
            rk_combine(h, T->stages, T->e3, n, NULL, k, n, err);
            e = rk_combined_error(e, norm(p, tol, err, y, ynew));
        }
        status = rk_control_step(&C, e, &t, &h);
        if (status < 0) break;
        rejected += status == RK_REJECT;
        if (status == RK_REJECT) continue;
        memcpy(y, ynew, sizeof y);
        if (rk_is(T, RK_FSAL)) memcpy(k, k + last * n, (size_t)n * sizeof *k);
        else evaluate(p, t, y, k);
    }
    for (i = 0; i < n; i++) worst = fmax(worst, fabs(y[i] - p->exact[i]));
    r.evaluations = evaluations;
    r.steps = C.steps;
    r.rejected = rejected;
    r.error = worst;
    return r;
}

enum { TABLES = 3, PROBLEMS = sizeof problems / sizeof *problems };
static const char *const tables[TABLES] = {"bs3", "dp5", "dop853"};

/* Evaluations for an error of `wanted`, by a line through the two runs around it in logarithms; 0: no run reaches it. */
static double evaluations_for(int count, const result *r, double wanted)
{
    int i;
    for (i = 1; i < count; i++) {
        const double a = log(r[i - 1].error), b = log(r[i].error), x = (log(wanted) - a) / (b - a);
        if (r[i - 1].error >= wanted && r[i].error < wanted)
            return exp((1 - x) * log((double)r[i - 1].evaluations) + x * log((double)r[i].evaluations));
    }
    return 0;
}

/* A row for each setting: evaluations for equal errors, geometric mean over problems, tables and errors, over those of PI;
   the best and the worst of these; rejected steps; by which power of the tolerance the error falls, least and most. */
static void controllers(void)
{
    static const setting sets[] = {{"PI", "PI", {0}}, {"I", "I", {0}}, {"PID", "PID", {0}},
        {"explicit", NULL, {0.635, -0.268}}, {"implicit", NULL, {1.93, -0.95, 0, 1}},
        {"H0211", NULL, {0.5, 0.5, 0, -0.5}}, {"H0321", NULL, {1.25, 0.5, -0.75, 0.25, 0.75}},
        {"H211", NULL, {0.25, 0.25, 0, -0.25}}, {"H312", NULL, {0.125, 0.25, 0.125, -0.375, -0.125}}};
    enum { SETS = sizeof sets / sizeof *sets, TOLERANCES = 17, WANTED = 3 };
    static const double wanted[WANTED] = {1e-3, 1e-5, 1e-7};
    static double first[PROBLEMS][TABLES][WANTED];
    int s, i, j, e, w;
    printf("law          evaluations best worst rejected power\n");
    for (s = 0; s < SETS; s++) {
        double sum = 0, best = HUGE_VAL, worst = 0, low = HUGE_VAL, high = 0;
        long steps = 0, rejected = 0;
        int cases = 0;
        for (i = 0; i < PROBLEMS; i++)
            for (j = 0; j < TABLES; j++) {
                result r[TOLERANCES];
                double power;
                int count = 0;
                for (e = 3; e <= (j ? 11 : 9); e++, count++) {
                    r[count] = run(problems + i, rk_find(tables[j]), sets + s, pow(10, -e));
                    steps += r[count].steps;
                    rejected += r[count].rejected;
                }
                power = log10(r[1].error / r[count - 1].error) / (count - 2); /* the loosest tolerance may be too loose */
                low = fmin(low, power);
                high = fmax(high, power);
                for (w = 0; w < WANTED; w++) {
                    const double needs = evaluations_for(count, r, wanted[w]);
                    if (s == 0) first[i][j][w] = needs;
                    if (!(needs > 0) || !(first[i][j][w] > 0)) continue;
                    sum += log(needs / first[i][j][w]);
                    best = fmin(best, needs / first[i][j][w]);
                    worst = fmax(worst, needs / first[i][j][w]);
                    cases++;
                }
            }
        printf("%-16s | %.2f | %.2f | %.2f | %.0f %% | %.2f to %.2f\n", sets[s].name, exp(sum / cases), best, worst,
               100. * (double)rejected / (double)(steps + rejected), low, high);
    }
}

int main(int argc, char **argv)
{
    setting set = {"", "I", {0}};
    int i, j, e;
    if (argc > 1 && strcmp(argv[1], "controllers") == 0) {
        controllers();
        return 0;
    }
    if (argc > 1) set.method = argv[1];
    for (i = 0; i < PROBLEMS; i++)
        for (j = 0; j < TABLES; j++)
            for (e = 4; e <= (j ? 12 : 8); e += 2) {
                const result r = run(problems + i, rk_find(tables[j]), &set, pow(10, -e));
                printf("%s %s %.0e %ld %d %d %.3e\n", problems[i].name, tables[j], pow(10, -e), r.evaluations, r.steps, r.rejected, r.error);
            }
    return 0;
}
