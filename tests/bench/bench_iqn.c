/* SPDX-License-Identifier: MIT

   bench_iqn.c - accuracy and speed of one step of iqn.h, as ratios measured in one run

   Accuracy: coefficients and update against Householder QR in quadruple precision, beside LAPACK's Householder QR in double.
   Speed: against the memory floor (V and W read once and 7 more vectors), LAPACK's QR rebuilt each step, and SUNDIALS'
   Anderson acceleration where installed.  Debian's SUNDIALS 6.4.1 is compiled without optimisation: mind that.          */
#define _POSIX_C_SOURCE 199309L
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef HAVE_SUNDIALS
#  include <kinsol/kinsol.h>
#  include <nvector/nvector_serial.h>
#  include <sundials/sundials_context.h>
#endif

extern void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
                   const int *ldb, double *work, const int *lwork, int *info, size_t);

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double random_number(void) /* in [-1, 1) */
{
    static unsigned long long state = 1;
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(state >> 11) / 4503599627370496.0 - 1;
}

static int ascending(const void *a, const void *b)
{
    const double d = *(const double *)a - *(const double *)b;
    return d < 0 ? -1 : d > 0;
}

static double median(double *t, int count)
{
    qsort(t, (size_t)count, sizeof *t, ascending);
    return t[count / 2];
}

static double *vector(size_t count)
{
    double *p = (double *)calloc(count ? count : 1, sizeof *p);
    if (!p) {
        fprintf(stderr, "no memory for %lu numbers\n", (unsigned long)count);
        exit(1);
    }
    return p;
}

/* ---- accuracy ---- */

static quad quad_sqrt(quad a)
{
    quad s = (quad)sqrt((double)a);
    int i;
    if (!(a > 0)) return 0;
    for (i = 0; i < 3; i++) s = (s + a / s) / 2;
    return s;
}

/* min |b + V a| by Householder reflections in quadruple precision; V (n x m) and b are destroyed. */
static void quad_least_squares(int n, int m, quad *V, quad *b, quad *a)
{
    int i, j, k;
    for (k = 0; k < m; k++) {
        quad *v = V + (size_t)k * (size_t)n, s = 0, f, d;
        for (i = k; i < n; i++) s += v[i] * v[i];
        s = quad_sqrt(s);
        if (v[k] > 0) s = -s;
        d = s * (s - v[k]);
        v[k] -= s;
        for (j = k + 1; j <= m; j++) {
            quad *w = j < m ? V + (size_t)j * (size_t)n : b;
            for (f = 0, i = k; i < n; i++) f += v[i] * w[i];
            f /= d;
            for (i = k; i < n; i++) w[i] -= f * v[i];
        }
        a[k] = s; /* R_kk for now */
    }
    for (k = m - 1; k >= 0; k--) {
        quad t = -b[k];
        for (j = k + 1; j < m; j++) t -= V[(size_t)j * (size_t)n + (size_t)k] * a[j];
        a[k] = t / a[k];
    }
}

/* Pairs whose V has m singular values from 1 down to 1/condition; error of the update W a, W = V-like columns of norm 1, and
   the excess of the residual |r + V a| over the best one, both relative to |r|.                                         */
enum { KIT, HOUSEHOLDER, SOLVERS };

static void accuracy(double condition, int solver, double *update, double *excess)
{
    enum { N = 2000, M = 10, LW = 100000 };
    double *V = vector(N * M), *W = vector(N * M), *x = vector(N), *h = vector(N), *v = vector(N), *w = vector(N), *work = vector(LW);
    quad *Q = (quad *)malloc(sizeof(quad) * N * (M + 1)), a[M], best, mine, scale, error;
    double mix[M * M], alpha[M];
    size_t bytes = iqn_size(N, M, 1);
    void *mem = malloc(bytes);
    iqn *q;
    int i, j, k, n = N, m = M, one = 1, lw = LW, info;
    if (!Q || !mem || iqn_make(&q, N, M, 1, mem, bytes) < 0) exit(1);
    for (i = 0; i < N * M; i++) Q[i] = (quad)random_number();
    for (j = 0; j < M; j++) /* V = orthonormal, graded, mixed */
        for (k = 0; k <= j; k++) {
            quad d = 0;
            for (i = 0; i < N; i++) d += Q[j * N + i] * Q[k * N + i];
            if (k < j)
                for (i = 0; i < N; i++) Q[j * N + i] -= d * Q[k * N + i];
            else
                for (d = quad_sqrt(d), i = 0; i < N; i++) Q[j * N + i] /= d;
        }
    for (i = 0; i < M * M; i++) mix[i] = random_number() + 3 * (i % (M + 1) == 0);
    for (j = 0; j < M; j++)
        for (i = 0; i < N; i++) {
            quad s = 0;
            for (k = 0; k < M; k++) s += Q[k * N + i] * (quad)(pow(condition, -k / (M - 1.0)) * mix[j * M + k]);
            V[j * N + i] = (double)s;
            W[j * N + i] = random_number() / sqrt((double)N);
        }
    for (i = 0; i < N; i++) {
        quad s = (quad)(1e-3 * random_number());
        for (k = 0; k < M; k++) s += Q[k * N + i] * (quad)(pow(condition, -k / (M - 1.0)) * (k % 2 ? 1 : -1));
        x[i] = 0;
        h[i] = (double)s;
    }
    for (j = M - 1; j >= 0; j--) {
        memcpy(v, V + j * N, N * sizeof *v);
        memcpy(w, W + j * N, N * sizeof *w);
        iqn_push(q, v, w);
    }
    for (i = 0; i < N * M; i++) Q[i] = (quad)V[i];
    for (i = 0; i < N; i++) Q[N * M + i] = (quad)h[i];
    quad_least_squares(N, M, Q, Q + N * M, a);
    if (solver == KIT) {
        iqn_set(q, IQN_FILTER_LIMIT, 1e-16);
        iqn_step(q, x, h);
        for (i = 0; i < N; i++) w[i] = x[i] - h[i]; /* W alpha */
        for (j = 0; j < M; j++) alpha[j] = 0;
        for (i = 0; i < N * M; i++) Q[i] = (quad)W[i];
        for (i = 0; i < N; i++) Q[N * M + i] = -(quad)w[i];
        {
            quad c[M];
            quad_least_squares(N, M, Q, Q + N * M, c); /* W is well conditioned: alpha back from W alpha */
            for (j = 0; j < M; j++) alpha[j] = (double)c[j];
        }
    } else {
        double *A = vector(N * M);
        memcpy(A, V, sizeof(double) * N * M);
        for (i = 0; i < N; i++) v[i] = -h[i];
        dgels_("N", &n, &m, &one, A, &n, v, &n, work, &lw, &info, 1);
        for (j = 0; j < M; j++) alpha[j] = v[j];
        free(A);
    }
    best = mine = scale = error = 0;
    for (i = 0; i < N; i++) {
        quad s = (quad)h[i], t = (quad)h[i], e = 0, u = 0;
        for (j = 0; j < M; j++) {
            s += (quad)V[j * N + i] * a[j];
            t += (quad)V[j * N + i] * (quad)alpha[j];
            u += (quad)W[j * N + i] * a[j];
            e += (quad)W[j * N + i] * ((quad)alpha[j] - a[j]);
        }
        best += s * s;
        mine += t * t;
        scale += u * u;
        error += e * e;
    }
    *update = (double)(quad_sqrt(error) / quad_sqrt(scale));
    *excess = (double)((quad_sqrt(mine) - quad_sqrt(best)) / quad_sqrt(best));
    free(V);
    free(W);
    free(x);
    free(h);
    free(v);
    free(w);
    free(work);
    free(Q);
    free(mem);
}

static void accuracy_table(void)
{
    static const char *const name[SOLVERS] = {"iqn.h", "dgels"};
    double condition, u[SOLVERS], e[SOLVERS];
    int s;
    printf("Least squares, n = 2000, 10 columns: relative error of the update W a | excess of |r + V a| over the optimum\n");
    printf("%-10s", "condition");
    for (s = 0; s < SOLVERS; s++) printf("  %-20s", name[s]);
    for (condition = 1e2; condition < 2e16; condition *= condition < 1e14 ? 100 : 10) {
        printf("\n%-10.0e", condition);
        for (s = 0; s < SOLVERS; s++) {
            accuracy(condition, s, u + s, e + s);
            printf("  %8.1e | %-9.1e", u[s], fabs(e[s]) < 1e-16 ? 0 : e[s]);
        }
    }
    printf("\n(iqn.h drops columns below 1e-14 of their norm)\n\n");
}

/* ---- speed ---- */

static volatile double sink;

static double read_all(size_t count, const double *a)
{
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0, t = now();
    size_t i;
    for (i = 0; i + 8 <= count; i += 8) {
        s0 += a[i];
        s1 += a[i + 1];
        s2 += a[i + 2];
        s3 += a[i + 3];
        s4 += a[i + 4];
        s5 += a[i + 5];
        s6 += a[i + 6];
        s7 += a[i + 7];
    }
    sink = s0 + s1 + s2 + s3 + s4 + s5 + s6 + s7;
    return now() - t;
}

#ifdef HAVE_SUNDIALS
typedef struct source {
    ptrdiff_t n;
    const double *data; /* vectors handed out as H(x), one after the other */
    int call, count;
    double spent;
} source;

static int hand_out(N_Vector u, N_Vector g, void *user)
{
    source *s = (source *)user;
    double t = now();
    (void)u;
    memcpy(N_VGetArrayPointer(g), s->data + s->n * (s->call++ % s->count), (size_t)s->n * sizeof(double));
    s->spent += now() - t;
    return 0;
}

/* Seconds per iteration of KINSOL's fixed-point solver with depth m, the map itself subtracted. */
static double kinsol(ptrdiff_t n, int m, const double *data, int count, int reps)
{
    SUNContext context;
    source s;
    double t, result;
    void *kin;
    N_Vector u, scale;
    long iterations = 0;
    SUNContext_Create(NULL, &context);
    s.n = n;
    s.data = data;
    s.call = 0;
    s.count = count;
    s.spent = 0;
    u = N_VNew_Serial((sunindextype)n, context);
    scale = N_VNew_Serial((sunindextype)n, context);
    N_VConst(1, scale);
    N_VConst(0, u);
    kin = KINCreate(context);
    KINSetUserData(kin, &s);
    KINSetMAA(kin, m);
    KINSetNumMaxIters(kin, m + reps);
    KINInit(kin, hand_out, u);
    KINSetFuncNormTol(kin, 1e-300);
    KINSetPrintLevel(kin, 0);
    {
        FILE *quiet = fopen("/dev/null", "w");
        if (quiet) {
            KINSetErrFile(kin, quiet);
            t = now();
            KINSol(kin, u, KIN_FP, scale, scale);
            t = now() - t;
            fclose(quiet);
        } else t = 0;
    }
    KINGetNumNonlinSolvIters(kin, &iterations);
    result = iterations > 0 ? (t - s.spent) / (double)iterations : 0;
    KINFree(&kin);
    N_VDestroy(u);
    N_VDestroy(scale);
    SUNContext_Free(&context);
    return result;
}
#endif

/* LAPACK: copy V and r, factor, solve, update: what "QR rebuilt each step" costs */
static double rebuilt(int n, int m, const double *V, const double *W, double *A, double *b, double *work, int lwork, double *x)
{
    int one = 1, info, i, j;
    double t = now();
    memcpy(A, V, sizeof(double) * (size_t)n * (size_t)m);
    for (i = 0; i < n; i++) b[i] = -x[i];
    dgels_("N", &n, &m, &one, A, &n, b, &n, work, &lwork, &info, 1);
    for (j = 0; j < m; j++)
        for (i = 0; i < n; i++) x[i] += b[j] * W[(size_t)j * (size_t)n + (size_t)i];
    return now() - t;
}

static void speed(ptrdiff_t n, int m)
{
    enum { MOST = 101 };
    const int reps = n >= 1000000 ? 11 : n >= 100000 ? 31 : MOST, fresh = 2 * m + 8;
    double floor_[MOST], ours[MOST], qr[MOST], f, kin = 0;
    double *data = vector((size_t)n * (size_t)fresh), *x = vector((size_t)n), *h, *A = vector((size_t)n * (size_t)m), *b = vector((size_t)n);
    const int lwork = 64 * m + 64;
    double *work = vector((size_t)lwork);
    size_t bytes = iqn_size(n, m, 1), i;
    void *mem = malloc(bytes);
    iqn *q;
    int k;
    if (!mem || iqn_make(&q, n, m, 1, mem, bytes) < 0) exit(1);
    iqn_set(q, IQN_FILTER_LIMIT, 1e-16);
    iqn_set(q, IQN_GROWTH, 0);
    for (i = 0; i < (size_t)n * (size_t)fresh; i++) data[i] = random_number();
    for (k = -m - 2; k < reps; k++) {
        const int at = k < 0 ? 0 : k;
        double t;
        h = data + (ptrdiff_t)((k + m + 2) % fresh) * n;
        memcpy(x, data + (ptrdiff_t)((k + m + 5) % fresh) * n, (size_t)n * sizeof *x);
        t = now();
        iqn_step(q, x, h);
        ours[at] = now() - t;
        floor_[at] = read_all((size_t)n * (size_t)(2 * m + 7), data);
        if (k >= 0 && k < (n >= 100000 ? 3 : reps)) qr[k] = rebuilt((int)n, m, data, data + n * m, A, b, work, lwork, x);
    }
#ifdef HAVE_SUNDIALS
    kin = kinsol(n, m, data, fresh, n >= 100000 ? 5 : 50);
#endif
    f = median(floor_, reps);
    printf("%-9ld %-4d %9.3f  %8.2f  %8.1f  ", (long)n, m, 1e3 * f, median(ours, reps) / f,
           median(qr, n >= 100000 ? 3 : reps) / f);
    if (kin > 0) printf("%8.1f", kin / f);
    else printf("%8s", "-");
    printf("  %8.1f\n", (double)bytes / (double)(1 << 20));
    fflush(stdout);
    free(data);
    free(x);
    free(A);
    free(b);
    free(work);
    free(mem);
}

int main(void)
{
    static const long n[3] = {1000, 100000, 1000000};
    static const int m[4] = {5, 10, 20, 50};
    int i, j;
    accuracy_table();
    printf("One step, ratio to the floor: reading V, W and 7 more vectors once\n");
    printf("%-9s %-4s %9s  %8s  %8s  %8s  %8s\n", "n", "cols", "floor ms", "iqn.h", "dgels", "KINSOL", "MiB");
    for (i = 0; i < 3; i++)
        for (j = 0; j < 4; j++)
            if (!(n[i] == 1000000 && m[j] == 50)) speed(n[i], m[j]);
            else printf("%-9ld %-4d left out: 1.7 GB\n", n[i], m[j]);
#ifdef HAVE_SUNDIALS
    printf("KINSOL: fixed point, modified Gram-Schmidt; Debian compiles SUNDIALS 6.4.1 without optimisation\n");
#endif
    return 0;
}
