/* SPDX-License-Identifier: MIT

   recipes.h - a problem with the functions that the recipes of rk.h leave to the host, for tests/scripts/snippets.txt:
   y' = lambda (y - cos t) - sin t with lambda = -1 and -20, y(0) = 1, so y = cos t; its two halves for IMEX. */
#define RK_IMPLEMENTATION
#include "rk.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { n = 2, ROOM = RK_STAGES_MAX * n };

static const double lambda[n] = {-1, -20};

static inline void fI(double t, const double *y, double *k)
{
    for (int j = 0; j < n; j++) k[j] = lambda[j] * (y[j] - cos(t));
}

static inline void fE(double t, const double *y, double *k)
{
    (void)y;
    for (int j = 0; j < n; j++) k[j] = -sin(t);
}

static inline void f(double t, const double *y, double *k)
{
    for (int j = 0; j < n; j++) k[j] = lambda[j] * (y[j] - cos(t)) - sin(t);
}

/* Z - g f(t, Z) = base; the half fI alone where forced is 0 */
static inline void solve_with(double forced, double t, double g, const double *base, double *Z)
{
    for (int j = 0; j < n; j++) Z[j] = (base[j] - g * (lambda[j] * cos(t) + forced * sin(t))) / (1 - g * lambda[j]);
}

static inline void filter(double g, const double *err, double *x)
{
    for (int j = 0; j < n; j++) x[j] = err[j] / (1 - g * lambda[j]);
}

/* The largest distance from cos t or, for deriv 1, from -sin t */
static inline double off(const double *y, double t, int deriv)
{
    double worst = 0;
    for (int j = 0; j < n; j++) worst = fmax(worst, fabs(y[j] - (deriv ? -sin(t) : cos(t))));
    return worst;
}

/* The slopes of an explicit step from y */
static inline void explicit_slopes(const rk_table *T, double t, double h, const double *y, double *k)
{
    double z[n];
    for (int i = 0; i < T->stages; i++) {
        rk_stage(T, i, h, n, y, k, n, z);
        f(t + T->c[i] * h, z, k + i * n);
    }
}
