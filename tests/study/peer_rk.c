/* SPDX-License-Identifier: MIT

   peer_rk.c - adaptive runs by the loop of rk.h's synopsis: evaluations and error at equal tolerance, for peer_rk.py, which
   sets SciPy's numbers beside them.   peer_rk [CONTROLLER]: I is SciPy's law, the default */
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
    double sum[4] = {0};
    rk_norm(tol, tol, NULL, p->n, v, y0, y1, sum);
    return rk_rms(sum);
}

/* The protocol of rk_first_step; k_0 is known. */
static double first_step(const problem *p, const rk_table *T, double tol, const double *y, double *k)
{
    const double one[] = {1}, difference[] = {-1, 1};
    double z[MOST], d0 = norm(p, tol, y, y, NULL), d1 = norm(p, tol, k, y, NULL), h;
    h = rk_first_step(rk_estimate(T), p->end, d0, d1, -1);
    rk_combine(h, 1, one, p->n, y, k, p->n, z);
    evaluate(p, h, z, k + p->n);
    rk_combine(1 / h, 2, difference, p->n, NULL, k, p->n, z);
    return rk_first_step(rk_estimate(T), p->end, d0, d1, norm(p, tol, z, y, NULL));
}

static void run(const problem *p, const rk_table *T, const char *method, double tol)
{
    const int n = p->n, last = T->stages - 1;
    double k[16 * MOST], y[MOST], ynew[MOST], z[MOST], err[MOST], t = 0, h, worst = 0;
    int i, status, rejected = 0;
    rk_control C;
    rk_control_make(&C, method, T);
    C.stop = p->end;
    memcpy(y, p->y0, sizeof y);
    evaluations = 0;
    evaluate(p, 0, y, k);
    h = first_step(p, T, tol, y, k);
    while (t < p->end) {
        double e;
        for (i = 1; i < T->stages; i++) {
            rk_stage(T, i, h, n, y, k, n, z);
            evaluate(p, t + T->c[i] * h, z, k + i * n);
        }
        rk_finish(T, h, n, y, k, n, ynew, err);
        e = norm(p, tol, err, y, ynew);
        if (T->e3) {
            rk_combine(h, T->stages, T->e3, n, NULL, k, n, err);
            e = rk_companion(e, norm(p, tol, err, y, ynew));
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
    printf("%s %s %.0e %ld %d %d %.3e\n", p->name, T->name, tol, evaluations, C.steps, rejected, worst);
}

int main(int argc, char **argv)
{
    static const char *const tables[] = {"bs3", "dp5", "dop853"};
    size_t i, j;
    int e;
    for (i = 0; i < sizeof problems / sizeof *problems; i++)
        for (j = 0; j < 3; j++)
            for (e = 4; e <= (j ? 12 : 8); e += 2) run(problems + i, rk_find(tables[j]), argc > 1 ? argv[1] : "I", pow(10, -e));
    return 0;
}
