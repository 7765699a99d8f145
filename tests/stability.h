/* SPDX-License-Identifier: MIT

   stability.h - what a Runge-Kutta table does to y' = lambda y, by LAPACK's eigenvalues: the numbers behind the list of
   tables in rk.h, for its test and for the study.  Include it behind the implementations of rk.h and examples/rk_proof.h; link LAPACK.

       R(z) = 1 + z b' (I - zA)^-1 1 = P(z)/Q(z),  Q = det(I - zA),  P = det(I - zA + z 1 b'),  R(z, theta) with b(theta)

   Poles of R are 1/eigenvalues of A, zeros those of A - 1 b'.  |Q(iy)|^2 - |P(iy)|^2 is a polynomial in y^2: where it is
   negative, and only there, |R(iy)| > 1.  With no pole in the left half-plane that decides A-stability (maximum principle),
   and |R(z, theta)| is largest on the axis or at infinity.                                                              */
#ifndef STABILITY_H_INCLUDED
#define STABILITY_H_INCLUDED

#include <complex.h>
#undef I /* a float, and a name of others */
#include <stdlib.h>

extern void dgeev_(const char *jobvl, const char *jobvr, const int *n, double *a, const int *lda, double *wr, double *wi,
                   double *vl, const int *ldvl, double *vr, const int *ldvr, double *work, const int *lwork, int *info,
                   size_t jobvl_length, size_t jobvr_length);
extern void zgesv_(const int *n, const int *nrhs, double complex *a, const int *lda, int *ipiv, double complex *b,
                   const int *ldb, int *info);

enum { STABILITY_MOST = RK_STAGES_MAX };

typedef struct stability {
    double real_axis, imaginary_axis; /* |R| <= 1 on [-real_axis, 0] and i[-imaginary_axis, imaginary_axis]; HUGE_VAL */
    double r_infinity;                /* |R(-inf)|; HUGE_VAL if unbounded */
    double ssp;                       /* contractivity coefficient; HUGE_VAL: no bound; 0 where all stages are coupled */
    double error_norm;                /* sqrt(sum over the trees of order p+1 of (residual/sigma)^2) */
    double dense_max;                 /* largest |b_i(theta)| in the step */
    double dense_growth;              /* implicit: largest |R(z, theta)| in the left half-plane; explicit: 0 */
    int stage_order, a_stable, l_stable;
    int joint; /* of dense outputs from step to step: 1: u' is continuous; 0: u alone */
} stability;

/* The stages that the step uses: those with a weight, and those a used one takes slopes of. */
static int stability_reduce(const rk_table *T, double *A, double *b)
{
    const int s = T->stages, m = s + T->extra;
    int used[STABILITY_MOST], row[STABILITY_MOST], i, j, n = 0, grown = 1;
    for (i = 0; i < s; i++) used[i] = T->b[i] != 0;
    while (grown) {
        grown = 0;
        for (i = 0; i < s; i++)
            for (j = 0; used[i] && j < s; j++)
                if (T->A[i * m + j] != 0 && !used[j]) used[j] = grown = 1;
    }
    for (i = 0; i < s; i++)
        if (used[i]) row[n++] = i;
    for (i = 0; i < n; i++) {
        b[i] = T->b[row[i]];
        for (j = 0; j < n; j++) A[i * n + j] = T->A[row[i] * m + row[j]];
    }
    return n;
}

/* Coefficients of det(I - z (A - 1 w')) in z, by Faddeev and LeVerrier in long double. */
static void stability_determinant(int n, const double *A, const double *w, long double *q)
{
    long double *M = (long double *)calloc((size_t)(2 * n * n + 1), sizeof *M), *N = M + n * n, trace;
    int i, j, k, l;
    q[0] = 1;
    for (k = 1; k <= n; k++) {
        for (i = 0; i < n; i++) M[i * n + i] += q[k - 1];
        for (trace = 0, i = 0; i < n; i++)
            for (j = 0; j < n; j++) {
                N[i * n + j] = 0;
                for (l = 0; l < n; l++) N[i * n + j] += ((long double)A[i * n + l] - (w ? (long double)w[l] : 0)) * M[l * n + j];
                if (i == j) trace += N[i * n + j];
            }
        q[k] = -trace / k;
        memcpy(M, N, (size_t)(n * n) * sizeof *M);
    }
    free(M);
}

/* Eigenvalues of an n*n matrix, which is destroyed; 0, or LAPACK's complaint. */
static int stability_eigenvalues(int n, double *a, double complex *value)
{
    double wr[4 * STABILITY_MOST], wi[4 * STABILITY_MOST], work[16 * STABILITY_MOST], none[1];
    const int one = 1, room = 16 * STABILITY_MOST;
    int info, i;
    dgeev_("N", "N", &n, a, &n, wr, wi, none, &one, none, &one, work, &room, &info, 1, 1);
    for (i = 0; i < n; i++) value[i] = wr[i] + wi[i] * csqrt(-1);
    return info;
}

static long double stability_value(int degree, const long double *f, long double x)
{
    long double sum = 0;
    int k;
    for (k = degree; k >= 0; k--) sum = sum * x + f[k];
    return sum;
}

/* The smallest x > 0 behind which the polynomial is negative; HUGE_VAL: nowhere.  Its roots are eigenvalues of the
   companion matrix; the sign between them decides, so that a double root does no harm.  size: of each coefficient's terms. */
static double stability_negative(int degree, long double *f, const long double *size)
{
    double M[4 * STABILITY_MOST * STABILITY_MOST] = {0}, root[2 * STABILITY_MOST + 2];
    double complex value[2 * STABILITY_MOST];
    int k, n, low = 0, count = 0, i, j;
    for (k = 0; k <= degree; k++)
        if (fabsl(f[k]) <= 1e-12L * size[k]) f[k] = 0; /* of coefficients rounded to 1e-16 */
    while (degree >= 0 && f[degree] == 0) degree--;
    if (degree < 0) return HUGE_VAL;
    while (f[low] == 0) low++;
    n = degree - low;
    for (i = 0; i < n; i++) {
        M[i * n] = (double)(-f[degree - 1 - i] / f[degree]); /* by columns: the first row */
        if (i + 1 < n) M[i * n + i + 1] = 1;
    }
    if (n > 0 && stability_eigenvalues(n, M, value)) return (double)NAN;
    root[count++] = 0;
    for (i = 0; i < n; i++)
        if (creal(value[i]) > 0 && fabs(cimag(value[i])) <= 1e-5 * creal(value[i])) root[count++] = creal(value[i]);
    for (i = 1; i < count; i++) /* ascending */
        for (j = i; j > 1 && root[j - 1] > root[j]; j--) {
            const double t = root[j];
            root[j] = root[j - 1];
            root[j - 1] = t;
        }
    for (i = 0; i < count; i++) {
        const double last = root[i], next = i + 1 < count ? root[i + 1] : 2 * root[i] + 1;
        long double a = i ? (long double)(root[i - 1] + last) / 2 : 0, b = ((long double)last + (long double)next) / 2;
        if (next - last <= 1e-6 * next || stability_value(degree, f, b) >= 0) continue;
        if (i == 0) return 0;
        for (k = 0; k < 100; k++) { /* positive at a, negative at b */
            const long double mid = (a + b) / 2;
            if (stability_value(degree, f, mid) >= 0) a = mid;
            else b = mid;
        }
        return (double)a;
    }
    return HUGE_VAL;
}

/* |Q|^2 - |P|^2 along -x (which 0) or iy, there in powers of y^2 (which 1). */
static double stability_reach(int n, const long double *p, const long double *q, int which)
{
    long double f[2 * STABILITY_MOST + 1] = {0}, size[2 * STABILITY_MOST + 1] = {0};
    int a, b;
    for (a = 0; a <= n; a++)
        for (b = 0; b <= n; b++) {
            const int k = which ? (a + b) / 2 : a + b, odd = which ? ((a - b) / 2) % 2 : (a + b) % 2;
            if (which && (a + b) % 2) continue;
            f[k] += (odd ? -1 : 1) * (q[a] * q[b] - p[a] * p[b]);
            size[k] += fabsl(q[a] * q[b]) + fabsl(p[a] * p[b]);
        }
    return stability_negative(which ? n : 2 * n, f, size);
}

/* (I - zA)^-1 1 for all stages, those of the dense output, too. */
static void stability_stages(const rk_table *T, double complex z, double complex *Y)
{
    const int m = T->stages + T->extra, one = 1;
    static double complex M[STABILITY_MOST * STABILITY_MOST];
    int pivot[STABILITY_MOST], info, i, j;
    for (i = 0; i < m; i++) {
        Y[i] = 1;
        for (j = 0; j < m; j++) M[j * m + i] = (i == j) - z * T->A[i * m + j];
    }
    zgesv_(&m, &one, M, &m, pivot, Y, &m, &info);
    for (i = 0; info && i < m; i++) Y[i] = HUGE_VAL; /* a pole */
}

/* R(z, theta); theta < 0: R(z). */
static double complex stability_function(const rk_table *T, double complex z, double theta)
{
    double complex Y[STABILITY_MOST], R = 1;
    double w[STABILITY_MOST];
    int i;
    stability_stages(T, z, Y);
    if (theta < 0 && T->stages > 0 && rk_is(T, RK_STIFFLY_ACCURATE)) return Y[T->stages - 1];
    if (theta < 0) memcpy(w, T->b, (size_t)(T->stages + T->extra) * sizeof *w);
    else rk_weights(T, theta, 0, w);
    for (i = 0; i < T->stages + T->extra; i++) R += z * w[i] * Y[i];
    return R;
}

/* The largest |R(z, theta)| on the imaginary axis, y = 1e-2 to 1e8, with the end of it for infinity. */
static double stability_growth(const rk_table *T, int points)
{
    double complex Y[STABILITY_MOST], z;
    double w[201][STABILITY_MOST], worst = 0;
    int n, i, q;
    for (q = 0; q <= 200; q++)
        if (rk_weights(T, q / 200., 0, w[q]) < 0) return 0;
    for (n = 0; n <= points; n++) {
        z = pow(10, -2 + 10. * n / points) * csqrt(-1);
        stability_stages(T, z, Y);
        for (q = 0; q <= 200; q++) {
            double complex R = 1;
            for (i = 0; i < T->stages + T->extra; i++) R += z * w[q][i] * Y[i];
            worst = fmax(worst, cabs(R));
        }
    }
    return worst;
}

/* Kraaijevanger's conditions at r: with K = [A 0; b' 0], (I + rK)^-1 K >= 0 and (I + rK)^-1 1 >= 0. */
static int stability_monotone(const rk_table *T, double r)
{
    const int s = T->stages, m = s + T->extra;
    double X[STABILITY_MOST + 1];
    int i, j, l;
    for (j = 0; j <= s; j++) /* column s: the vector of ones */
        for (i = 0; i <= s; i++) {
            const double *K = i < s ? T->A + i * m : T->b;
            X[i] = j < s ? K[j] : 1;
            for (l = 0; l < i; l++) X[i] -= r * K[l] * X[l];
            X[i] /= 1 + (i < s ? r * K[i] : 0);
            if (!(X[i] >= -1e-13)) return 0;
        }
    return 1;
}

static double stability_ssp(const rk_table *T)
{
    double low = 0, high = 1;
    int i;
    if (!rk_is(T, RK_SEQUENTIAL) || !stability_monotone(T, 0)) return 0;
    for (; high < 1e6 && stability_monotone(T, high); high *= 2) low = high;
    if (high >= 1e6) return HUGE_VAL;
    for (i = 0; i < 60; i++) {
        const double mid = low + (high - low) / 2;
        if (stability_monotone(T, mid)) low = mid;
        else high = mid;
    }
    return low > 1e-9 ? low : 0;
}

/* Whether sum_j a_ij c_j^(k-1) = c_i^k / k for every stage, and so for b with c = 1. */
static int stability_simplifies(const rk_table *T, int k)
{
    const int m = T->stages + T->extra;
    int i, j;
    for (i = 0; i <= T->stages; i++) {
        const double *row = i < T->stages ? T->A + i * m : T->b;
        double sum = -pow(i < T->stages ? T->c[i] : 1, k) / k, size = fabs(sum);
        for (j = 0; j < T->stages; j++) {
            sum += row[j] * pow(T->c[j], k - 1);
            size += fabs(row[j]);
        }
        if (!(fabs(sum) <= RK_TOLERANCE * size)) return 0;
    }
    return 1;
}

static double stability_error_norm(const rk_table *T)
{
    double norm = 0;
    rk_tree t;
    for (t.n = 0; rk_tree_next(&t, T, NULL, T->order + 1) == 1;) {
        double residual = -1 / t.gamma;
        int i;
        for (i = 0; i < T->stages; i++) residual += T->b[i] * t.phi[i];
        norm += residual * residual / (t.sigma * t.sigma);
    }
    return sqrt(norm);
}

/* Whether u'(0) = f(y) and u'(1) = f(ynew): weights of one slope alone, that of a stage equal to y or to ynew. */
static int stability_joint(const rk_table *T)
{
    const int m = T->stages + T->extra;
    double w[2][STABILITY_MOST];
    int end, i, j, own;
    for (end = 0; end < 2; end++) {
        int found = 0;
        if (rk_weights(T, end, 1, w[end]) < 0) return 0;
        for (i = 0; i < m; i++) {
            if (fabs(w[end][i]) < 1e-12) continue;
            if (found++ || fabs(w[end][i] - 1) > 1e-12 || fabs(T->c[i] - end) > 1e-15) return 0;
            for (own = 1, j = 0; j < m; j++) own &= fabs(T->A[i * m + j] - (end ? T->b[j] : 0)) < 1e-15;
            if (!own) return 0;
        }
    }
    return 1;
}

/* All of it; 0, or -1: the table cannot be used, or LAPACK failed.  Milliseconds; `points` on the axis for dense_growth. */
static int stability_of(const rk_table *T, int points, stability *a)
{
    static double A[STABILITY_MOST * STABILITY_MOST], b[STABILITY_MOST], w[STABILITY_MOST];
    long double p[STABILITY_MOST + 1], q[STABILITY_MOST + 1], top = 0;
    double complex pole[STABILITY_MOST];
    const int is_explicit = rk_is(T, RK_EXPLICIT);
    int n, i, k, np, nq, left = 0;
    memset(a, 0, sizeof *a);
    if (is_explicit < 0) return -1;
    n = stability_reduce(T, A, b);
    stability_determinant(n, A, NULL, q);
    stability_determinant(n, A, b, p);
    for (k = 0; k <= n; k++) top = fmaxl(top, fmaxl(fabsl(p[k]), fabsl(q[k])));
    for (np = n; np > 0 && fabsl(p[np]) <= 1e-14L * top; np--) p[np] = 0;
    for (nq = n; nq > 0 && fabsl(q[nq]) <= 1e-14L * top; nq--) q[nq] = 0;
    a->real_axis = stability_reach(n, p, q, 0);
    a->imaginary_axis = sqrt(stability_reach(n, p, q, 1));
    a->r_infinity = np > nq ? HUGE_VAL : np < nq ? 0 : (double)fabsl(p[np] / q[nq]);
    if (stability_eigenvalues(n, A, pole)) return -1;
    for (i = 0; i < n; i++) left |= creal(pole[i]) < -1e-9 * cabs(pole[i]) && cabs(pole[i]) > 1e-7;
    a->a_stable = !is_explicit && !left && a->imaginary_axis > 1e300;
    a->l_stable = a->a_stable && a->r_infinity < 1e-9;
    a->ssp = stability_ssp(T);
    for (k = 1; k <= T->order && stability_simplifies(T, k);) k++;
    a->stage_order = k - 1;
    a->error_norm = stability_error_norm(T);
    for (k = 0; k <= 200 && rk_weights(T, k / 200., 0, w) == RK_OK; k++)
        for (i = 0; i < T->stages + T->extra; i++) a->dense_max = fmax(a->dense_max, fabs(w[i]));
    a->dense_growth = is_explicit ? 0 : stability_growth(T, points);
    a->joint = stability_joint(T);
    return 0;
}

#endif
