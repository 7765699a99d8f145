/* SPDX-License-Identifier: MIT

   floors.c - plain loops written for the purpose, for bench_*.c: compile with -O3 -march=native -ffast-math

   Nothing is checked and nothing is general: every count and coefficient is known to the compiler where that helps.     */
#include "floors.h"

#include <math.h>

#ifdef __GNUC__
#    define ALWAYS_INLINE static inline __attribute__((always_inline))
#    define A_CALL        __attribute__((noinline)) /* a right-hand side is not known where the step is compiled */
#    define ONE_BY_ONE __asm__ volatile("") /* vector loops cost more than they save for a few numbers */
#else
#    define ALWAYS_INLINE static inline
#    define A_CALL
#    define ONE_BY_ONE
#endif
enum { FEW = 8 };

/* ---- iqn -------------------------------------------------------------------------------------------------------------------- */

enum { ROWS = 1024 }; /* r and v of a block stay in the first cache */

static ptrdiff_t rows_from(ptrdiff_t i, ptrdiff_t n)
{
    return n - i < ROWS ? n - i : ROWS;
}

/* c_j += V_j'r and b_j += V_j'v, four columns a pass. */
static void add_products(ptrdiff_t rows, ptrdiff_t n, int m, const double *V, const double *r, const double *v, double *c, double *b)
{
    ptrdiff_t i;
    int j;
    for (j = 0; j + 4 <= m; j += 4) {
        const double *p = V + j * n, *q = p + n, *s = q + n, *t = s + n;
        double c0 = 0, c1 = 0, c2 = 0, c3 = 0, b0 = 0, b1 = 0, b2 = 0, b3 = 0;
        for (i = 0; i < rows; i++) {
            c0 += p[i] * r[i], c1 += q[i] * r[i], c2 += s[i] * r[i], c3 += t[i] * r[i];
            b0 += p[i] * v[i], b1 += q[i] * v[i], b2 += s[i] * v[i], b3 += t[i] * v[i];
        }
        c[j] += c0, c[j + 1] += c1, c[j + 2] += c2, c[j + 3] += c3;
        b[j] += b0, b[j + 1] += b1, b[j + 2] += b2, b[j + 3] += b3;
    }
    for (; j < m; j++) {
        double c0 = 0, b0 = 0;
        for (i = 0; i < rows; i++) {
            c0 += V[j * n + i] * r[i];
            b0 += V[j * n + i] * v[i];
        }
        c[j] += c0;
        b[j] += b0;
    }
}

/* a = -G^-1 c by Cholesky, row by row so that the inner loops run along memory. */
static void solve(int m, const double *G, double *restrict L, const double *c, double *restrict a)
{
    int i, j, k;
    for (i = 0; i < m * m; i++) L[i] = G[i];
    for (k = 0; k < m; k++) { /* L' in the upper triangle */
        double *restrict row = L + k * m, one = 1 / sqrt(row[k]);
        for (j = k; j < m; j++) row[j] *= one;
        for (i = k + 1; i < m; i++) {
            double *restrict other = L + i * m, f = row[i];
            for (j = i; j < m; j++) other[j] -= f * row[j];
        }
    }
    for (i = 0; i < m; i++) a[i] = -c[i];
    for (k = 0; k < m; k++) {
        a[k] /= L[k * m + k];
        for (j = k + 1; j < m; j++) a[j] -= a[k] * L[k * m + j];
    }
    for (k = m - 1; k >= 0; k--) {
        double t = a[k];
        for (j = k + 1; j < m; j++) t -= L[k * m + j] * a[j];
        a[k] = t / L[k * m + k];
    }
}

/* x += W a, four columns a pass. */
static void add_columns(ptrdiff_t rows, ptrdiff_t n, int m, const double *W, const double *a, double *restrict x)
{
    ptrdiff_t i;
    int j;
    for (j = 0; j + 4 <= m; j += 4) {
        const double *p = W + j * n, *q = p + n, *s = q + n, *t = s + n, a0 = a[j], a1 = a[j + 1], a2 = a[j + 2], a3 = a[j + 3];
        for (i = 0; i < rows; i++) x[i] += a0 * p[i] + a1 * q[i] + a2 * s[i] + a3 * t[i];
    }
    for (; j < m; j++)
        for (i = 0; i < rows; i++) x[i] += a[j] * W[j * n + i];
}

void floor_step(floor_iqn *s, double *x, const double *hx)
{
    const ptrdiff_t n = s->n;
    const int m = s->m, slot = s->slot;
    double r[ROWS], v[ROWS], vv = 0, vr = 0;
    ptrdiff_t i, k;
    int j;
    for (j = 0; j < m; j++) s->c[j] = s->b[j] = 0;
    for (k = 0; k < n; k += ROWS) {
        const ptrdiff_t rows = rows_from(k, n);
        for (i = 0; i < rows; i++) {
            r[i] = hx[k + i] - x[k + i];
            v[i] = r[i] - s->r[k + i];
            vv += v[i] * v[i];
            vr += v[i] * r[i];
        }
        add_products(rows, n, slot, s->V + k, r, v, s->c, s->b); /* all columns but the one that goes */
        add_products(rows, n, m - slot - 1, s->V + (slot + 1) * n + k, r, v, s->c + slot + 1, s->b + slot + 1);
    }
    s->c[slot] = vr;
    s->b[slot] = vv;
    for (j = 0; j < m; j++) s->G[slot * m + j] = s->G[j * m + slot] = s->b[j];
    solve(m, s->G, s->L, s->c, s->a);
    for (k = 0; k < n; k += ROWS) {
        const ptrdiff_t rows = rows_from(k, n);
        double *V = s->V + slot * n + k, *W = s->W + slot * n + k;
        for (i = 0; i < rows; i++) {
            const double h = hx[k + i], residual = h - x[k + i], change = h - s->hx[k + i];
            V[i] = residual - s->r[k + i];
            W[i] = change;
            s->r[k + i] = residual;
            s->hx[k + i] = h;
            r[i] = h + s->a[slot] * change;
        }
        add_columns(rows, n, slot, s->W + k, s->a, r);
        add_columns(rows, n, m - slot - 1, s->W + (slot + 1) * n + k, s->a + slot + 1, r);
        for (i = 0; i < rows; i++) x[k + i] = r[i];
    }
    s->slot = (slot + 1) % m;
}

/* ---- rk ---------------------------------------------------------------------------------------------------------------------- */

A_CALL void floor_decay(ptrdiff_t n, const double *y, double *f)
{
    ptrdiff_t i;
    if (n < FEW)
        for (i = 0; i < n; i++) {
            ONE_BY_ONE;
            f[i] = -y[i];
        }
    else
        for (i = 0; i < n; i++) f[i] = -y[i];
}

/* sum of a_j k_j(i) over the first `terms` stages.  Inlined with a constant row: zeros cost nothing. */
ALWAYS_INLINE double weighted(ptrdiff_t n, ptrdiff_t i, int terms, const double *a, const double *k)
{
    double s = 0;
    int j;
#ifdef __GNUC__
#    pragma GCC unroll 16
#endif
    for (j = 0; j < terms; j++) s += a[j] * k[j * n + i];
    return s;
}

ALWAYS_INLINE void stage(ptrdiff_t n, double h, int terms, const double *a, const double *restrict y, const double *restrict k,
                         double *restrict z)
{
    ptrdiff_t i;
    if (n < FEW)
        for (i = 0; i < n; i++) {
            ONE_BY_ONE;
            z[i] = y[i] + h * weighted(n, i, terms, a, k);
        }
    else
        for (i = 0; i < n; i++) z[i] = y[i] + h * weighted(n, i, terms, a, k);
}

#define STAGE(i) stage(n, h, i, a[i], y, k, z)
#define STAGE_AND_SLOPE(i) \
    STAGE(i);              \
    floor_decay(n, z, k + (i)*n)

void floor_rk4(ptrdiff_t n, double h, const double *y, double *k, double *z)
{
    static const double a[5][4] = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}};
    STAGE_AND_SLOPE(1);
    STAGE_AND_SLOPE(2);
    STAGE_AND_SLOPE(3);
    STAGE(4);
}

void floor_bs3(ptrdiff_t n, double h, const double *y, double *k, double *z)
{
    static const double a[4][3] = {{0}, {0.5}, {0, 0.75}, {2. / 9, 1. / 3, 4. / 9}};
    STAGE_AND_SLOPE(1);
    STAGE_AND_SLOPE(2);
    STAGE_AND_SLOPE(3);
}

void floor_dp5(ptrdiff_t n, double h, const double *y, double *k, double *z)
{
    static const double a[7][6] = {{0},
                                   {1. / 5},
                                   {3. / 40, 9. / 40},
                                   {44. / 45, -56. / 15, 32. / 9},
                                   {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                   {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                   {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
    STAGE_AND_SLOPE(1);
    STAGE_AND_SLOPE(2);
    STAGE_AND_SLOPE(3);
    STAGE_AND_SLOPE(4);
    STAGE_AND_SLOPE(5);
    STAGE_AND_SLOPE(6);
}

/* The sums before the five implicit stages; solving them is the host's. */
void floor_esdirk4(ptrdiff_t n, double h, const double *y, double *k, double *z)
{
    static const double a[6][5] = {
        {0}, {.25}, {-.05, -.05}, {-.08, -.08, .5}, {-.7, -.7, 1.6, .7}, {-.02, -.02, .4, .5, -.1}};
    STAGE(1);
    STAGE(2);
    STAGE(3);
    STAGE(4);
    STAGE(5);
}

void floor_dop853(ptrdiff_t n, double h, const double *y, double *k, double *z)
{
    static const double a[13][12] = {{0},
                                     {.05},
                                     {.02, .06},
                                     {.03, 0, .09},
                                     {.2, 0, -.9, .9},
                                     {.04, 0, 0, .2, .1},
                                     {.04, 0, 0, .2, .06, -.02},
                                     {.04, 0, 0, .2, .1, -.02, .01},
                                     {.6, 0, 0, -3, -.9, 28, 20, -43},
                                     {.5, 0, 0, -2.5, -.6, 21, 15, -33, -.02},
                                     {-.9, 0, 0, 5, 1, -8, -19, 23, 2.5, -3},
                                     {2.3, 0, 0, -11, -2, -18, 28, -2.9, -9, 12, .6},
                                     {.05, 0, 0, 0, 0, 4.5, 1.9, -5.8, .3, -.2, .2, .04}};
    STAGE_AND_SLOPE(1);
    STAGE_AND_SLOPE(2);
    STAGE_AND_SLOPE(3);
    STAGE_AND_SLOPE(4);
    STAGE_AND_SLOPE(5);
    STAGE_AND_SLOPE(6);
    STAGE_AND_SLOPE(7);
    STAGE_AND_SLOPE(8);
    STAGE_AND_SLOPE(9);
    STAGE_AND_SLOPE(10);
    STAGE_AND_SLOPE(11);
    STAGE(12);
}

/* As rk_norm and rk_rms: what left the range of the squares is summed again, scaled by the largest ratio. */
static double root_mean_square(ptrdiff_t n, double rtol, double atol, const double *error, const double *y, const double *z)
{
    double largest = 0, sum = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        const double q = fabs(error[i]) / (atol + rtol * fmax(fabs(y[i]), fabs(z[i])));
        largest = q > largest ? q : largest;
    }
    for (i = 0; i < n && largest > 0; i++) {
        const double q = fabs(error[i]) / (atol + rtol * fmax(fabs(y[i]), fabs(z[i]))) / largest;
        sum += q * q;
    }
    return largest * sqrt(sum / (double)n);
}

double floor_error(ptrdiff_t n, double h, double rtol, double atol, const double *y, const double *z, const double *k,
                   double *restrict error)
{
    static const double e[7] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
    const double *k1 = k, *k3 = k + 2 * n, *k4 = k + 3 * n, *k5 = k + 4 * n, *k6 = k + 5 * n, *k7 = k + 6 * n;
    double sum = 0, seen = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        const double a = fabs(y[i]), b = fabs(z[i]);
        const double v = h * (e[0] * k1[i] + e[2] * k3[i] + e[3] * k4[i] + e[4] * k5[i] + e[5] * k6[i] + e[6] * k7[i]);
        const double q = v / (atol + rtol * (a > b ? a : b));
        error[i] = v;
        sum += q * q;
        seen += a + b;
    }
    if (!(sum > 1e-200 && sum < 1e270 && seen < 1e300)) return root_mean_square(n, rtol, atol, error, y, z);
    return sqrt(sum / (double)n);
}

void floor_sum_dp5(ptrdiff_t n, const double *w, const double *y, const double *k, double *restrict out)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++)
        out[i] = y[i] + w[0] * k[i] + w[2] * k[i + 2 * n] + w[3] * k[i + 3 * n] + w[4] * k[i + 4 * n] + w[5] * k[i + 5 * n] +
                 w[6] * k[i + 6 * n];
}

/* The weights are polynomials of theta, as in Hairer, Norsett & Wanner, II.6. */
void floor_dense(ptrdiff_t n, double h, double theta, const double *y, const double *k, double *restrict out)
{
    static const double d[4][7] = {
        {1, 0, 0, 0, 0, 0, 0},
        {-8048581381. / 2820520608, 0, 131558114200. / 32700410799, -1754552775. / 470086768,
         127303824393. / 49829197408, -282668133. / 205662961, 40617522. / 29380423},
        {8663915743. / 2820520608, 0, -68118460800. / 10900136933, 14199869525. / 1410260304,
         -318862633887. / 49829197408, 2019193451. / 616988883, -110615467. / 29380423},
        {-12715105075. / 11282082432, 0, 87487479700. / 32700410799, -10690763975. / 1880347072,
         701980252875. / 199316789632, -1453857185. / 822651844, 69997945. / 29380423}};
    double w[7];
    int j;
    for (j = 0; j < 7; j++) w[j] = h * theta * (d[0][j] + theta * (d[1][j] + theta * (d[2][j] + theta * d[3][j])));
    floor_sum_dp5(n, w, y, k, out);
}

/* ---- waveform ------------------------------------------------------------------------------------------------------------ */

void floor_sum(ptrdiff_t n, int terms, const double *w, const double *x, double *restrict out)
{
    ptrdiff_t i;
    int j = terms % 4;
    const double *a = x, *b = x + n, *c = x + 2 * n, *d = x + 3 * n;
    switch (j) {
    case 1:
        for (i = 0; i < n; i++) out[i] = w[0] * a[i];
        break;
    case 2:
        for (i = 0; i < n; i++) out[i] = w[0] * a[i] + w[1] * b[i];
        break;
    case 3:
        for (i = 0; i < n; i++) out[i] = w[0] * a[i] + w[1] * b[i] + w[2] * c[i];
        break;
    default:
        j = 4;
        for (i = 0; i < n; i++) out[i] = w[0] * a[i] + w[1] * b[i] + w[2] * c[i] + w[3] * d[i];
    }
    for (; j < terms; j += 4) {
        a = x + j * n, b = a + n, c = b + n, d = c + n;
        for (i = 0; i < n; i++) out[i] += w[j] * a[i] + w[j + 1] * b[i] + w[j + 2] * c[i] + w[j + 3] * d[i];
    }
}

/* band: row j holds three factors of the forward substitution, the reciprocal pivot, three entries above it. */
void floor_band(int m, const double *band, const double *x, double *restrict c)
{
    double p = 0, q = 0, r = 0;
    int j;
    for (j = 0; j < m; j++) {
        const double *f = band + 7 * j, t = x[j] - f[0] * p - f[1] * q - f[2] * r;
        p = q, q = r, r = t;
        c[j] = t;
    }
    p = q = r = 0;
    for (j = m - 1; j >= 0; j--) {
        const double *f = band + 7 * j, t = (c[j] - f[4] * r - f[5] * q - f[6] * p) * f[3];
        p = q, q = r, r = t;
        c[j] = t;
    }
}
