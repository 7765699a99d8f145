/* SPDX-License-Identifier: MIT

   stiff.c - stiff problems with published end values: Radau IIA and ESDIRK tables of rk.h in one host, by LAPACK.

   M y' = f(t, y).  Coupled stages (radau5, radau9) solve M z = h A' F(z), with offsets z_i = Z_i - y and s n unknowns.
   With A' = V diag(lambda) V^-1 the simplified Newton correction of the residual R is V w,

      (M - h lambda_q J) w_q = (V^-1 R)_q,

   one real system of n equations for the real lambda, one complex system for each pair of conjugates.  Tables with one
   stage after the other solve each with M - h a_ii J.  Either way Jacobian and factors are kept where they serve, after
   Hairer's RADAU5: a new J if the last iteration took more than two evaluations and its rate was above 1e-3, or if it
   failed; h stays where it would change by a factor of .8 to 1.2, and so do the factors.

   Problems of the IVP test set (Mazzia & Magherini 2008; Hairer & Wanner II): van der Pol with eps = 1e-6, Robertson to
   1e11, HIRES, Pollution, and the transistor amplifier, an index-1 DAE whose mass matrix is singular and not diagonal.
   atol is rtol times a typical size of y.  f counts evaluations but those of the differences of J, as SciPy does;
   factors: factorizations, a complex one counted as the four real ones that it costs; error: the largest at the end, in
   tolerances, against the published values.  */
#define RK_IMPLEMENTATION
#include "rk.h"
#include "scene.h"

#include <complex.h>

typedef double complex cplx;

enum { SIZE = 20, COUPLED = 5, SLOPES = 8, STEPS = 200000 };

void zgeev_(const char *, const char *, const int *, cplx *, const int *, cplx *, cplx *, const int *, cplx *, const int *, cplx *,
            const int *, double *, int *);
void zgesv_(const int *, const int *, cplx *, const int *, int *, cplx *, const int *, int *);
void zgetrf_(const int *, const int *, cplx *, const int *, int *, int *);
void zgetrs_(const char *, const int *, const int *, const cplx *, const int *, const int *, cplx *, const int *, int *);
void dgetrf_(const int *, const int *, double *, const int *, int *, int *);
void dgetrs_(const char *, const int *, const int *, const double *, const int *, const int *, double *, const int *, int *);

static const int one = 1;

/* ---- problems ---------------------------------------------------------------------------------------------------- */

typedef struct ode {
    const char *name;
    int n;
    double end, scale; /* scale: a typical size of y; atol = rtol*scale */
    void (*f)(double t, const double *y, double *f);
    const double *start, *published; /* y at 0 and at the end */
    const double *M;                 /* by rows, NULL: the unit matrix */
} ode;

static void van_der_pol(double t, const double *y, double *f)
{
    (void)t;
    f[0] = y[1];
    f[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / 1e-6;
}

static void robertson(double t, const double *y, double *f)
{
    (void)t;
    f[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
    f[2] = 3e7 * y[1] * y[1];
    f[1] = -f[0] - f[2];
}

static void hires(double t, const double *y, double *f)
{
    (void)t;
    f[0] = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
    f[1] = 1.71 * y[0] - 8.75 * y[1];
    f[2] = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
    f[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
    f[4] = -1.745 * y[4] + 0.43 * (y[5] + y[6]);
    f[5] = -280 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
    f[6] = 280 * y[5] * y[7] - 1.81 * y[6];
    f[7] = -f[6];
}

/* Reaction j: its rate constant, one or two reactants; then the reactions, from 1, that a substance gains or loses by. */
static void pollution(double t, const double *y, double *f)
{
    static const double rate[25] = {0.35, 26.6,  1.23e4, 8.6e-4, 8.2e-4, 1.5e4,  1.3e-4, 2.4e4, 1.65e4,  9e3,  0.022, 1.2e4, 1.88,
                                    1.63e4, 4.8e6, 3.5e-4, 0.0175, 1e8,    4.44e11, 1240,   2.1,   5.78,    0.0474, 1780,  3.12};
    static const int of[25][2] = {{1},  {2, 4}, {5, 2}, {7}, {7}, {7, 6}, {9},  {9, 6},  {11, 2}, {11, 1}, {13},   {10, 2}, {14},
                                  {1, 6}, {3},    {4},    {4}, {16}, {16}, {17, 6}, {19}, {19},   {1, 4},  {19, 1}, {20}};
    static const int by[20][13] = {{-1, -10, -14, -23, -24, 2, 3, 9, 11, 12, 22, 25},
                                   {-2, -3, -9, -12, 1, 21},
                                   {-15, 1, 17, 19, 22},
                                   {-2, -16, -17, -23, 15},
                                   {-3, 4, 4, 6, 7, 13, 20},
                                   {-6, -8, -14, -20, 3, 18, 18},
                                   {-4, -5, -6, 13},
                                   {4, 5, 6, 7},
                                   {-7, -8},
                                   {-12, 7, 9},
                                   {-9, -10, 8, 11},
                                   {9},
                                   {-11, 10},
                                   {-13, 12},
                                   {14},
                                   {-18, -19, 16},
                                   {-20},
                                   {20},
                                   {-21, -22, -24, 23, 25},
                                   {-25, 24}};
    double r[25];
    int i, j;
    (void)t;
    for (j = 0; j < 25; j++) r[j] = rate[j] * y[of[j][0] - 1] * (of[j][1] ? y[of[j][1] - 1] : 1);
    for (i = 0; i < 20; i++)
        for (f[i] = 0, j = 0; by[i][j] != 0; j++) f[i] += by[i][j] > 0 ? r[by[i][j] - 1] : -r[-by[i][j] - 1];
}

static double diode(double u)
{
    return 1e-6 * (exp(u / 0.026) - 1);
}

static void transistor(double t, const double *y, double *f)
{
    const double in = 0.1 * sin(200 * acos(-1.) * t), a = diode(y[1] - y[2]), b = diode(y[4] - y[5]);
    f[0] = (in - y[0]) / 1000;
    f[1] = 6 / 9e3 - y[1] * 2 / 9e3 - 0.01 * a;
    f[2] = a - y[2] / 9e3;
    f[3] = 6 / 9e3 - y[3] / 9e3 - 0.99 * a;
    f[4] = 6 / 9e3 - y[4] * 2 / 9e3 - 0.01 * b;
    f[5] = b - y[5] / 9e3;
    f[6] = 6 / 9e3 - y[6] / 9e3 - 0.99 * b;
    f[7] = -y[7] / 9e3;
}

static const double capacitors[64] = {
    1e-6, -1e-6, 0, 0, 0, 0, 0, 0, -1e-6, 1e-6, 0, 0, 0, 0, 0, 0, 0, 0, 2e-6, 0, 0, 0, 0, 0, 0, 0, 0, 3e-6, -3e-6, 0, 0, 0,
    0, 0, 0, -3e-6, 3e-6, 0, 0, 0, 0, 0, 0, 0, 0, 4e-6, 0, 0, 0, 0, 0, 0, 0, 0, 5e-6, -5e-6, 0, 0, 0, 0, 0, 0, -5e-6, 5e-6};

static const double vdp_start[] = {2, 0}, vdp_end[] = {1.706167732170483, -0.8928097010247975};
static const double rob_start[] = {1, 0, 0}, rob_end[] = {0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050};
static const double hir_start[] = {1, 0, 0, 0, 0, 0, 0, 0.0057};
static const double hir_end[] = {0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2,
                                 0.2386356198831331e-2, 0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2};
static const double pol_start[] = {0, 0.2, 0, 0.04, 0, 0, 0.1, 0.3, 0.01, 0, 0, 0, 0, 0, 0, 0, 0.007, 0, 0, 0};
static const double pol_end[] = {
    0.5646255480022769e-1, 0.1342484130422339,    0.4139734331099427e-8, 0.5523140207484359e-2, 0.2018977262302196e-6,
    0.1464541863493966e-6, 0.7784249118997964e-1, 0.3245075353396018,    0.7494013383880406e-2, 0.1622293157301561e-7,
    0.1135863833257075e-7, 0.2230505975721359e-2, 0.2087162882798630e-3, 0.1396921016840158e-4, 0.8964884856898295e-2,
    0.4352846369330103e-17, 0.6899219696263405e-2, 0.1007803037365946e-3, 0.1772146513969984e-5, 0.5682943292316392e-4};
static const double tra_start[] = {0, 3, 3, 6, 3, 3, 6, 0};
static const double tra_end[] = {-0.5562145012262709e-2, 0.3006522471903042e1, 0.2849958788608128e1, 0.2926422536206241e1,
                                 0.2704617865010554e1,   0.2761837778393145e1, 0.4770927631616772e1, 0.1236995868091548e1};

static const ode problems[] = {{"vdpol", 2, 2, 1, van_der_pol, vdp_start, vdp_end, NULL},
                               {"robertson", 3, 1e11, 1e-6, robertson, rob_start, rob_end, NULL},
                               {"hires", 8, 321.8122, 1e-2, hires, hir_start, hir_end, NULL},
                               {"pollution", 20, 60, 1e-3, pollution, pol_start, pol_end, NULL},
                               {"transistor", 8, 0.2, 1, transistor, tra_start, tra_end, capacitors}};

/* ---- the linear systems of a step -------------------------------------------------------------------------------- */

typedef struct systems {
    int n, s, pairs;                                /* s: coupled stages, 0: one after the other; complex pairs */
    double gamma, real[SIZE * SIZE];                /* factors of M - h gamma J, gamma the real lambda or a_ii */
    double V0[COUPLED], W0[COUPLED];                /* column of V and row of V^-1 of the real lambda */
    cplx lambda[2], V[2][COUPLED], W[2][COUPLED];   /* those of the pairs, lambda with a positive imaginary part */
    cplx factors[2][SIZE * SIZE];                   /* of M - h lambda J */
    double inverse[COUPLED * COUPLED];              /* A'^-1, by rows: slopes from stages */
    int pivot[SIZE], pivots[2][SIZE];
} systems;

/* Eigenvalues and eigenvectors of A', A without row and column 0. */
static void systems_make(systems *S, const rk_table *T, int n)
{
    const int s = T->stages - 1, m = T->stages, room = 8 * COUPLED;
    cplx A[COUPLED * COUPLED], V[COUPLED * COUPLED], W[COUPLED * COUPLED], lambda[COUPLED], work[8 * COUPLED];
    double more[2 * COUPLED];
    int pivot[COUPLED], info, i, j, q;
    memset(S, 0, sizeof *S);
    S->n = n;
    S->gamma = T->A[m + 1];
    if (rk_is(T, RK_SEQUENTIAL) == 1) return;
    S->s = s;
    S->gamma = T->bhat[0];
    for (i = 0; i < s * s; i++) A[i] = T->A[(1 + i % s) * m + 1 + i / s]; /* by columns */
    zgeev_("N", "V", &s, A, &s, lambda, NULL, &s, V, &s, work, &room, more, &info);
    memcpy(A, V, sizeof A);
    for (i = 0; i < s * s; i++) W[i] = i % (s + 1) == 0;
    zgesv_(&s, &s, A, &s, pivot, W, &s, &info);
    for (q = 0; q < s; q++)
        for (i = 0; i < s; i++)
            for (j = 0; j < s; j++) S->inverse[i * s + j] += creal(V[i + q * s] / lambda[q] * W[q + j * s]);
    for (q = 0; q < s; q++) {
        const int real = fabs(cimag(lambda[q])) < 1e-8;
        for (i = 0; real && i < s; i++) {
            S->V0[i] = creal(V[i + q * s]);
            S->W0[i] = creal(W[q + i * s]);
            if (i == 0) S->W0[0] = creal(W[q]);
        }
        if (real || cimag(lambda[q]) < 0) continue;
        for (i = 0; i < s; i++) {
            S->V[S->pairs][i] = 2 * V[i + q * s]; /* with its conjugate */
            S->W[S->pairs][i] = W[q + i * s];
        }
        S->lambda[S->pairs++] = lambda[q];
    }
}

/* Number i of M - g J, by columns. */
static cplx matrix_entry(const ode *P, const double *J, cplx g, int i)
{
    const int row = i % P->n, column = i / P->n, at = row * P->n + column;
    return (P->M ? P->M[at] : row == column) - g * J[at];
}

/* J by rows.  Returns how many real factorizations this cost, 0: a matrix is singular. */
static int systems_factor(systems *S, const ode *P, double h, const double *J)
{
    const int n = S->n;
    int q, i, info;
    for (i = 0; i < n * n; i++) S->real[i] = creal(matrix_entry(P, J, h * S->gamma, i));
    dgetrf_(&n, &n, S->real, &n, S->pivot, &info);
    for (q = 0; q < S->pairs && info == 0; q++) {
        for (i = 0; i < n * n; i++) S->factors[q][i] = matrix_entry(P, J, h * S->lambda[q], i);
        zgetrf_(&n, &n, S->factors[q], &n, S->pivots[q], &info);
    }
    return info == 0 ? 1 + 4 * S->pairs : 0;
}

/* x = (M - h gamma J)^-1 x: of a residual, or the filter of an error */
static void solve_real(const systems *S, double *x)
{
    int info;
    dgetrs_("N", &S->n, &one, S->real, &S->n, S->pivot, x, &S->n, &info);
}

/* The residuals of the s coupled stages, n numbers each, become their corrections. */
static void correct(const systems *S, double *R)
{
    const int n = S->n, s = S->s;
    double w0[SIZE] = {0}, out[COUPLED * SIZE];
    cplx w[2][SIZE] = {{0}};
    int q, i, l, info;
    for (i = 0; i < s; i++)
        for (l = 0; l < n; l++) {
            w0[l] += S->W0[i] * R[i * n + l];
            for (q = 0; q < S->pairs; q++) w[q][l] += S->W[q][i] * R[i * n + l];
        }
    solve_real(S, w0);
    for (q = 0; q < S->pairs; q++) zgetrs_("N", &n, &one, S->factors[q], &n, S->pivots[q], w[q], &n, &info);
    for (i = 0; i < s; i++)
        for (l = 0; l < n; l++) {
            out[i * n + l] = S->V0[i] * w0[l];
            for (q = 0; q < S->pairs; q++) out[i * n + l] += creal(S->V[q][i] * w[q][l]);
        }
    memcpy(R, out, (size_t)(s * n) * sizeof *R);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* What TABLES of rk.h says of a table: mark F, column `at`. */
typedef struct method {
    const char *name;
    int filtered, looks; /* thetas inside; 0: the pair alone */
    double theta[2], divisor;
} method;

static const method methods[] = {{"radau5", 1, 1, {0.86, 0}, 3.6},    {"radau9", 1, 1, {0.73, 0}, 6.3},
                                 {"esdirk3", 0, 2, {0.1, 0.8}, 3},    {"esdirk4b", 0, 2, {0.35, 0.6}, 4},
                                 {"esdirk5", 1, 2, {0.65, 0.9}, 4}};

typedef struct host {
    const ode *P;
    const method *how;
    const rk_table *T;
    systems S;
    rk_control C;
    double rtol, y[SIZE], ynew[SIZE], k[SLOPES * SIZE], J[SIZE * SIZE];
    double f0[SIZE];                       /* M times slope 0 */
    rk_step last;                          /* the accepted step before, for first guesses; h 0: none */
    double last_y[SIZE], last_k[SLOPES * SIZE];
    double rate;                           /* of the last Newton iteration */
    int careful;                           /* a first or repeated step: its error is filtered twice */
    long f, jacobians, factors, steps, rejected;
} host;

static void evaluate(host *H, double t, const double *y, double *f)
{
    H->P->f(t, y, f);
    H->f++;
}

static void times_mass(const ode *P, const double *x, double *out)
{
    const int n = P->n;
    int i, j;
    if (!P->M) memcpy(out, x, (size_t)n * sizeof *x);
    for (i = 0; P->M && i < n; i++)
        for (out[i] = 0, j = 0; j < n; j++) out[i] += P->M[i * n + j] * x[j];
}

/* Of `count` vectors one behind the other, in tolerances */
static double size_of(const host *H, int count, const double *v, const double *ynew)
{
    double sum[2] = {0, 0};
    int i;
    for (i = 0; i < count; i++)
        rk_norm(H->rtol, H->rtol * H->P->scale, NULL, H->P->n, v + i * H->P->n, H->y, ynew, sum);
    return rk_rms(sum);
}

/* The rows of J, by differences from f(t, y) */
static void differentiate(host *H, double t)
{
    const int n = H->P->n;
    double at[SIZE], f0[SIZE], f1[SIZE];
    int i, j;
    memcpy(at, H->y, sizeof at);
    H->P->f(t, at, f0);
    for (j = 0; j < n; j++) {
        at[j] = H->y[j] + 1.5e-8 * fmax(fabs(H->y[j]), 1e-3 * H->P->scale);
        H->P->f(t, at, f1);
        for (i = 0; i < n; i++) H->J[i * n + j] = (f1[i] - f0[i]) / (at[j] - H->y[j]);
        at[j] = H->y[j];
    }
    H->jacobians++;
}

/* After correction `it`, 1 to `most`, of that size: 1 converged, 0 go on, -1 it does not converge.  The rate is this
   iteration's own: carried over to the next one it saves evaluations, and has ended in wrong answers. */
static int converging(host *H, int it, int most, double size, double *last)
{
    const double limit = fmax(10 * DBL_EPSILON / H->rtol, fmin(0.03, sqrt(H->rtol)));
    const double rate = it > 1 ? size / *last : 0;
    *last = size;
    H->rate = rate;
    if (!(size < 1e100) || rate >= 1) return -1;
    if (it == 1) return size == 0;
    if (pow(rate, most - it) * size / (1 - rate) > limit) return -1;
    return rate / (1 - rate) * size < limit;
}

/* First guess of stage i: the dense output of the last step, continued */
static void predict(const host *H, int i, double h, double *z)
{
    if (H->last.h == 0) memcpy(z, H->y, sizeof H->y);
    else rk_dense(&H->last, 1 + H->T->c[i] * h / H->last.h, 0, z);
}

/* All stages at once; returns the evaluations per stage, 0: not converged. */
static int solve_coupled(host *H, double t, double h)
{
    const rk_table *T = H->T;
    const int n = H->P->n, s = H->S.s, m = T->stages, most = s == 3 ? 7 : 10;
    double z[COUPLED * SIZE], F[COUPLED * SIZE], R[COUPLED * SIZE], v[SIZE], last = 0;
    int it, i, l, done = 0;
    for (i = 0; i < s; i++) {
        predict(H, 1 + i, h, v);
        for (l = 0; l < n; l++) z[i * n + l] = v[l] - H->y[l];
    }
    for (it = 0; it < most && done == 0;) {
        for (i = 0; i < s; i++) {
            for (l = 0; l < n; l++) v[l] = H->y[l] + z[i * n + l];
            evaluate(H, rk_time(&H->C, T->c[1 + i], t, h), v, F + i * n);
        }
        for (i = 0; i < s; i++) { /* R = h A' F - M z */
            times_mass(H->P, z + i * n, v);
            rk_combine(h, s, T->A + (1 + i) * m + 1, n, NULL, F, n, R + i * n);
            for (l = 0; l < n; l++) R[i * n + l] -= v[l];
        }
        correct(&H->S, R);
        for (l = 0; l < s * n; l++) z[l] += R[l];
        it++;
        done = converging(H, it, most, size_of(H, s, R, NULL), &last);
    }
    for (i = 0; i < s; i++) rk_combine(1 / h, s, H->S.inverse + i * s, n, NULL, z, n, H->k + (1 + i) * n);
    for (l = 0; l < n; l++) H->ynew[l] = H->y[l] + z[(s - 1) * n + l]; /* better than rk_update: no sum of slopes */
    return done == 1 ? it : 0;
}

/* One stage after the other, each by Z = base + g f(Z) */
static int solve_sequential(host *H, double t, double h)
{
    const rk_table *T = H->T;
    const int n = H->P->n, m = T->stages, most = 10;
    const double g = h * H->S.gamma;
    double base[SIZE], Z[SIZE], R[SIZE], x[SIZE], last = 0;
    int i, l, it = 0, done = 1, sum = 0;
    for (i = 1; i < m && done == 1; i++) {
        rk_stage(T, i, h, n, H->y, H->k, n, base);
        predict(H, i, h, Z);
        for (it = 0, done = 0; it < most && done == 0;) {
            evaluate(H, rk_time(&H->C, T->c[i], t, h), Z, R);
            for (l = 0; l < n; l++) x[l] = Z[l] - base[l];
            times_mass(H->P, x, H->ynew);
            for (l = 0; l < n; l++) R[l] = g * R[l] - H->ynew[l];
            solve_real(&H->S, R);
            for (l = 0; l < n; l++) Z[l] += R[l];
            it++;
            done = converging(H, it, most, size_of(H, 1, R, NULL), &last);
        }
        for (l = 0; l < n; l++) H->k[i * n + l] = (Z[l] - base[l]) / g;
        sum += it;
    }
    memcpy(H->ynew, Z, sizeof Z);
    return done == 1 ? (sum + m - 2) / (m - 1) : 0;
}

/* ---- its error --------------------------------------------------------------------------------------------------- */

/* M h sum e_i k_i, but M k_0 is f0, which may be no slope of a DAE; filtered for tables of mark F. */
static double error_of_pair(host *H, double h, const double *f0, double *err)
{
    const int n = H->P->n, s = H->T->stages - 1;
    double x[SIZE];
    rk_combine(h, s, H->T->e + 1, n, NULL, H->k + n, n, x);
    times_mass(H->P, x, err);
    rk_combine(h, 1, H->T->e, n, err, f0, n, err);
    if (H->how->filtered || H->P->M) solve_real(&H->S, err);
    return size_of(H, 1, err, H->ynew);
}

/* The defect inside the step: it sees a stiff part that follows its slow solution, as the pair of Radau IIA does not. */
static double error_inside(host *H, double t, double h, double theta)
{
    const rk_step step = {H->T, h, H->P->n, H->y, H->k, H->P->n};
    double u[SIZE], v[SIZE], D[SIZE];
    int l;
    rk_dense(&step, theta, 0, u);
    rk_dense(&step, theta, 1, v);
    evaluate(H, rk_time(&H->C, theta, t, h), u, D);
    times_mass(H->P, v, u);
    for (l = 0; l < H->P->n; l++) D[l] = h * (u[l] - D[l]) / H->how->divisor;
    solve_real(&H->S, D);
    return size_of(H, 1, D, H->ynew);
}

static double error_of_step(host *H, double t, double h, int inside)
{
    const int n = H->P->n;
    double err[SIZE], v[SIZE], f[SIZE], error = error_of_pair(H, h, H->f0, err);
    int l;
    if (error > 1 && H->careful && H->S.s > 0) { /* once more with f(t, y - err): what the filter leaves of stiff parts */
        for (l = 0; l < n; l++) v[l] = H->y[l] - err[l];
        evaluate(H, rk_time(&H->C, 0, t, h), v, f);
        error = error_of_pair(H, h, f, err);
    }
    for (l = 0; inside && error <= 1 && l < H->how->looks; l++) error = fmax(error, error_inside(H, t, h, H->how->theta[l]));
    return error;
}

/* ---- a run ------------------------------------------------------------------------------------------------------- */

static double first_size(host *H)
{
    const double unit[] = {1}, difference[] = {-1, 1}, length = H->P->end;
    const int n = H->P->n, q = rk_error_order(H->T);
    double z[SIZE], k[2 * SIZE], d0, d1, h;
    if (H->P->M) return 1e-6 * length; /* f is not y' */
    memcpy(k, H->f0, (size_t)n * sizeof *k);
    d0 = size_of(H, 1, H->y, NULL);
    d1 = size_of(H, 1, k, NULL);
    h = rk_first_step(q, length, d0, d1, -1);
    rk_combine(h, 1, unit, n, H->y, k, n, z);
    evaluate(H, h, z, k + n);
    rk_combine(1 / h, 2, difference, n, NULL, k, n, z);
    return rk_first_step(q, length, d0, d1, size_of(H, 1, z, NULL));
}

/* Solves the stages, once more with a new Jacobian if the old one does not serve; evaluations per stage, 0: not solved.
   *factored: the size that the factors are for; 0: none.  *age: steps that J is old; -1: there is none. */
static int solve(host *H, double t, double h, double *factored, int *age)
{
    for (;;) {
        int its = 0, cost = 1;
        if (*age < 0) {
            differentiate(H, rk_time(&H->C, 0, t, h));
            *age = 0;
            *factored = 0;
        }
        if (*factored != h) {
            cost = systems_factor(&H->S, H->P, h, H->J);
            H->factors += cost;
            *factored = cost > 0 ? h : 0;
        }
        if (cost > 0) its = H->S.s > 0 ? solve_coupled(H, t, h) : solve_sequential(H, t, h);
        if (its > 0 || *age == 0) return its;
        *age = -1;
    }
}

/* The step counts: y, slope 0 and the guesses go on from its end. */
static void advance(host *H, double h)
{
    const int n = H->P->n;
    memcpy(H->last_y, H->y, sizeof H->y);
    memcpy(H->last_k, H->k, sizeof H->k);
    H->last.T = H->T, H->last.n = H->last.ldk = n, H->last.h = h, H->last.y = H->last_y, H->last.k = H->last_k;
    memcpy(H->y, H->ynew, sizeof H->y);
    memcpy(H->k, H->k + (H->T->stages - 1) * n, (size_t)n * sizeof *H->k); /* FSAL */
    times_mass(H->P, H->k, H->f0);
    H->steps++;
}

/* From 0 to the end; a status, RK_OK at the end. */
static int run(host *H, const ode *P, const method *how, double rtol, int inside)
{
    static const double implicit_law[5] = {1.93, -0.95, 0, 1, 0}; /* Gustafsson's: see CONTROL in rk.h */
    double t = 0, h, factored = 0;
    int age = -1, status = RK_OK;
    memset(H, 0, sizeof *H);
    H->P = P, H->how = how, H->T = rk_find(how->name), H->rtol = rtol, H->careful = 1;
    systems_make(&H->S, H->T, P->n);
    memcpy(H->y, P->start, (size_t)P->n * sizeof *H->y);
    rk_control_make(&H->C, "PI", H->T);
    memcpy(H->C.k, implicit_law, sizeof implicit_law);
    evaluate(H, 0, H->y, H->f0);
    if (!P->M) memcpy(H->k, H->f0, sizeof H->f0); /* of a DAE slope 0 is a guess */
    h = first_size(H);
    rk_control_stop(&H->C, P->end, t, &h);
    while (t < P->end && status >= 0) {
        const int its = solve(H, t, h, &factored, &age);
        const double size = h, error = its > 0 ? error_of_step(H, t, h, inside) : HUGE_VAL;
        H->C.safety = its > 0 ? 0.9 * 15 / (14 + its) : 0.9;
        H->C.shrink = its > 0 ? 0.1 : 0.5;
        if (its == 0) factored = 0;
        status = rk_control_step(&H->C, error, &t, &h);
        if (status == RK_REJECT) {
            H->careful = 1;
            H->rejected++;
        }
        if (H->steps + H->rejected > STEPS) return RK_EFAILURES;
        if (status != RK_OK) continue;
        advance(H, size);
        H->careful = 0;
        age++;
        if (its > 2 && H->rate > 1e-3) age = -1;
        else if (h > 0.8 * size && h < 1.2 * size) { /* the factors stay */
            h = size;
            rk_control_stop(&H->C, P->end, t, &h);
        }
    }
    return status;
}

static double error_at_end(const host *H)
{
    const ode *P = H->P;
    double worst = 0;
    int l;
    for (l = 0; l < P->n; l++) {
        const double exact = P->published[l];
        worst = fmax(worst, fabs(H->y[l] - exact) / (H->rtol * (P->scale + fabs(exact))));
    }
    return worst;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"problem", "all", "vdpol robertson hires pollution transistor, or all"},
                        {"table", "all", "radau5 radau9 esdirk3 esdirk4b esdirk5, or all"},
                        {"rtol", "1e-6", "relative tolerance"},
                        {"inside", "1", "1: the error is looked at inside the step, too"},
                        {NULL, NULL, NULL}};
    static host H;
    const char *problem, *table;
    double rtol;
    size_t p, m;
    int runs = 0, inside;
    scene_parse(argc, argv, "stiff problems with published end values, by Radau IIA and ESDIRK tables", o);
    problem = scene_text(o, "problem");
    table = scene_text(o, "table");
    rtol = scene_number(o, "rtol", 1e-12, 1e-1);
    inside = scene_integer(o, "inside", 0, 1);
    printf("%-10s %-8s %-6s %8s %6s %8s %6s %9s %9s\n", "problem", "table", "rtol", "f", "J", "factors", "steps", "rejected", "error");
    for (p = 0; p < sizeof problems / sizeof *problems; p++)
        for (m = 0; m < sizeof methods / sizeof *methods; m++) {
            int status;
            if (strcmp(problem, "all") != 0 && strcmp(problem, problems[p].name) != 0) continue;
            if (strcmp(table, "all") != 0 && strcmp(table, methods[m].name) != 0) continue;
            runs++;
            status = run(&H, &problems[p], &methods[m], rtol, inside);
            printf("%-10s %-8s %-6g %8ld %6ld %8ld %6ld %9ld ", H.P->name, H.how->name, rtol, H.f, H.jacobians, H.factors, H.steps, H.rejected);
            if (status < 0) printf("%s\n", rk_message(status));
            else printf("%9.2g\n", error_at_end(&H));
        }
    if (runs == 0) {
        fprintf(stderr, "--problem: %s; --table: %s\n", o[0].help, o[1].help);
        return 2;
    }
    return 0;
}
