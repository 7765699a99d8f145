/* SPDX-License-Identifier: MIT

   oscillator.h - two masses between three springs, and the two solvers that oscillator.c and page/masses.c couple

       m1 u1'' + (k1 + k12) u1 = k12 u2(t)     side A: an explicit Runge-Kutta table
       m2 u2'' + (k2 + k12) u2 = k12 u1(t)     side B: generalized-alpha

   Exact: u1,2 = (cos 2 pi t +- cos 6 pi t)/2.  Include rk.h before. */
#ifndef OSCILLATOR_H_INCLUDED
#define OSCILLATOR_H_INCLUDED

#include <stddef.h>

#define PI 3.14159265358979323846
#define K12 (16 * PI * PI) /* the spring between the masses */
#define K (20 * PI * PI)   /* a mass's own two springs, k1 + k12 = k2 + k12; both masses are 1 */

typedef struct mass {
    double u, v, a; /* displacement, velocity, acceleration */
} mass;

/* The displacement of the other mass at time `at`, for a sub-step of length h from t. */
typedef double mass_read(void *other, double t, double h, double at);

/* Displaced by u, without velocity; the acceleration is that of the equation. */
static inline mass mass_at_rest(double u, double u_other)
{
    mass m;
    m.u = u;
    m.v = 0;
    m.a = K12 * u_other - K * u;
    return m;
}

/* Time of sub-step j of n in the window [t0, t1]; the last one is the window end to the bit. */
static inline double mass_time(double t0, double t1, int j, int n)
{
    return j == n ? t1 : t0 + j * ((t1 - t0) / n);
}

/* A sub-step of u' = v, v' = k12 u_other - K u by an explicit table. */
static inline void mass_runge_kutta(mass *m, double t, double h, const rk_table *table, mass_read *read, void *other)
{
    double k[2 * RK_STAGES_MAX], y[2], z[2];
    int i;
    y[0] = m->u;
    y[1] = m->v;
    for (i = 0; i < table->stages; i++) {
        rk_stage(table, i, h, 2, y, k, 2, z);
        k[2 * i] = z[1];
        k[2 * i + 1] = K12 * read(other, t, h, t + table->c[i] * h) - K * z[0];
    }
    rk_finish(table, h, 2, y, k, 2, y, NULL);
    m->u = y[0];
    m->v = y[1];
}

/* A sub-step of Chung and Hulbert's method, alpha_f = 0.4, alpha_m = 0.2. */
static inline void mass_generalized_alpha(mass *m, double t, double h, mass_read *read, void *other)
{
    const double af = 0.4, am = 0.2, gamma = 0.5 - am + af;
    const double beta = (gamma + 0.5) / 4; /* without the square of Chung and Hulbert's: kept, for the published digits */
    const double m0 = (1 - am) / (beta * h * h), m1 = (1 - am) / (beta * h), m2 = (1 - am - 2 * beta) / (2 * beta);
    const double f = K12 * read(other, t, h, t + (1 - af) * h);
    const double u = (f - af * K * m->u + m0 * m->u + m1 * m->v + m2 * m->a) / (K * (1 - af) + m0);
    const double a = (u - m->u - h * m->v) / (beta * h * h) - (1 - 2 * beta) / (2 * beta) * m->a;
    m->v += h * ((1 - gamma) * m->a + gamma * a);
    m->u = u;
    m->a = a;
}

#endif /* OSCILLATOR_H_INCLUDED */
