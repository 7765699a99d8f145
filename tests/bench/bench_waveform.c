/* SPDX-License-Identifier: MIT

   bench_waveform.c - what waveform.h costs, as ratios to the memory floor of the same run and beside the peers installed

   Medians over rounds in which the contenders take turns.  Degree 3 (2 for three samples).

      fit        samples to coefficients          / memcpy of the samples
      in place   the same, c = x                  / memcpy of the samples
      eval       one value from coefficients      / out = sum of the same number of weighted columns, a plain loop
      many       4 values in one call             / 4 calls of wf_eval, and / 4 of those plain loops
      interp     one value from the m samples     / out = sum of m weighted columns
      resample   samples on m times to m others   / memcpy of the samples */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define WF_IMPLEMENTATION
#include "waveform.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifdef HAVE_GSL
#    include <gsl/gsl_bspline.h>
#    include <gsl/gsl_linalg.h>
#endif

enum { ROUNDS = 41, CONTENDERS = 12 };

typedef struct setup {
    wf *w, *other;
    int m, degree;
    ptrdiff_t n;
    double *x, *c, *zero, *out, weight[32], t[4];
#ifdef HAVE_GSL
    gsl_bspline_workspace *spline;
    gsl_matrix *lu;
    gsl_permutation *permutation;
    gsl_vector *basis;
#endif
} setup;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* ---- the floor -------------------------------------------------------------------------------------------------- */

/* out = sum of `terms` weighted columns, vectorised at -O2 by gcc (which needs an inner loop of known length) and by
   clang */
#if defined(__clang__)
#    define LANES 1
#elif defined(__AVX__)
#    define LANES 4
#else
#    define LANES 2
#endif
#define SUM(body)                                                                                                      \
    for (i = 0; i + LANES <= n; i += LANES)                                                                            \
        for (k = 0; k < LANES; k++) o[i + k] = body;                                                                   \
    for (k = 0; i < n; i++) o[i + k] = body

static void floor_sum(ptrdiff_t n, int terms, const double *w, const double *x, double *restrict o)
{
    const double *restrict a = x, *restrict b = x + n, *restrict c = x + 2 * n,
                           *restrict d = x + (terms > 3 ? 3 : 0) * n;
    double w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
    ptrdiff_t i, k;
    int j;
    if (terms == 3) {
        SUM(w0 * a[i + k] + w1 * b[i + k] + w2 * c[i + k]);
        return;
    }
    SUM(w0 * a[i + k] + w1 * b[i + k] + w2 * c[i + k] + w3 * d[i + k]);
    for (j = 4; j + 4 <= terms; j += 4) {
        a += 4 * n, b += 4 * n, c += 4 * n, d += 4 * n;
        w0 = w[j], w1 = w[j + 1], w2 = w[j + 2], w3 = w[j + 3];
        SUM(o[i + k] + w0 * a[i + k] + w1 * b[i + k] + w2 * c[i + k] + w3 * d[i + k]);
    }
    for (; j < terms; j++) {
        a = x + j * n;
        w0 = w[j];
        SUM(o[i + k] + w0 * a[i + k]);
    }
}

/* ---- contenders ------------------------------------------------------------------------------------------------- */

static void copy(setup *s)
{
    memcpy(s->c, s->x, (size_t)s->n * (size_t)s->m * sizeof(double));
}

static void fit(setup *s)
{
    wf_fit(s->w, s->n, s->x, s->n, s->c, s->n);
}

static void fit_in_place(setup *s)
{
    wf_fit(s->w, s->n, s->zero, s->n, s->zero, s->n); /* zeros: repeated fits would grow beyond all bounds */
}

static void sum(setup *s)
{
    floor_sum(s->n, s->degree + 1, s->weight, s->c, s->out);
}

static void eval(setup *s)
{
    wf_eval(s->w, 0.47, 0, s->n, s->c, s->n, s->out);
}

static void sum_all(setup *s)
{
    floor_sum(s->n, s->m, s->weight, s->x, s->out);
}

static void interpolate(setup *s)
{
    wf_interpolate(s->w, 0.47, 0, s->n, s->x, s->n, s->out);
}

static void eval_four(setup *s)
{
    int k;
    for (k = 0; k < 4; k++) wf_eval(s->w, s->t[k], 0, s->n, s->c, s->n, s->out + k * s->n);
}

static void eval_many(setup *s)
{
    wf_eval_many(s->w, 4, s->t, 0, s->n, s->c, s->n, s->out, s->n);
}

static void resample(setup *s)
{
    wf_resample(s->w, s->other, s->n, s->x, s->n, s->c, s->n);
}

#ifdef HAVE_GSL
static void gsl_fit(setup *s)
{
    ptrdiff_t i;
    memcpy(s->c, s->x, (size_t)s->n * (size_t)s->m * sizeof(double));
    for (i = 0; i < s->n; i++) {
        gsl_vector_view c = gsl_vector_view_array_with_stride(s->c + i, (size_t)s->n, (size_t)s->m);
        gsl_linalg_LU_svx(s->lu, s->permutation, &c.vector);
    }
}

static void gsl_eval(setup *s)
{
    size_t first, last, j;
    gsl_vector_view out = gsl_vector_view_array(s->out, (size_t)s->n);
    gsl_bspline_eval_nonzero(0.47, s->basis, &first, &last, s->spline);
    gsl_vector_set_zero(&out.vector);
    for (j = first; j <= last; j++) {
        gsl_vector_view c = gsl_vector_view_array(s->c + (ptrdiff_t)j * s->n, (size_t)s->n);
        gsl_vector_axpby(gsl_vector_get(s->basis, j - first), &c.vector, 1, &out.vector);
    }
}
#endif

typedef void contender(setup *);

static void race(setup *s, contender *const *c, int count, double *median)
{
    static double time[CONTENDERS][ROUNDS];
    int k, r, i, repeat[CONTENDERS], rounds = s->n > 100000 ? 9 : ROUNDS;
    for (k = 0; k < count; k++) {
        double t = now();
        c[k](s);
        t = now() - t;
        repeat[k] = t > 3e-4 ? 1 : (int)(3e-4 / (t + 1e-8)) + 1;
    }
    for (r = 0; r < rounds; r++)
        for (k = 0; k < count; k++) {
            double t = now();
            for (i = 0; i < repeat[k]; i++) c[k](s);
            time[k][r] = (now() - t) / repeat[k];
        }
    for (k = 0; k < count; k++) {
        qsort(time[k], (size_t)rounds, sizeof(double), ascending);
        median[k] = time[k][rounds / 2];
    }
}

static double *memory(size_t doubles)
{
    double *p = malloc(doubles * sizeof(double));
    if (!p) exit(1);
    memset(p, 0, doubles * sizeof(double));
    return p;
}

static void bench(ptrdiff_t n, int m)
{
    contender *const all[] = {copy,        fit,      sum, eval, sum_all, interpolate, eval_four, eval_many, resample,
#ifdef HAVE_GSL
                              gsl_fit,     gsl_eval,
#endif
                              fit_in_place};
    enum { COUNT = sizeof all / sizeof *all };
    double t[COUNT];
    setup s;
    size_t bytes = wf_size(3, m);
    void *mem = memory(bytes / 8), *mem2 = memory(bytes / 8);
    int j;
    ptrdiff_t i;
    s.n = n;
    s.m = m;
    s.x = memory((size_t)n * (size_t)m);
    s.c = memory((size_t)n * (size_t)m);
    s.zero = memory((size_t)n * (size_t)m);
    s.out = memory((size_t)n * 4);
    wf_make(&s.w, 3, m, mem, bytes);
    wf_make(&s.other, 3, m, mem2, bytes);
    for (j = 0; j < m; j++) {
        double tau = (j + (j % (m - 1) ? 0.2 : 0)) / (m - 1);
        wf_push(s.w, tau);
        wf_push(s.other, j % (m - 1) ? tau * 0.98 + 0.01 : tau);
        s.weight[j] = 1.0 / m;
        for (i = 0; i < n; i++) s.x[j * n + i] = (double)((i * 7 + j * 13) % 101) / 101;
    }
    for (j = 0; j < 4; j++) s.t[j] = 0.11 + 0.25 * j;
    s.degree = wf_degree(s.w);
    if (m == 3) s.weight[3] = 0;
#ifdef HAVE_GSL
    {
        gsl_vector *knots = gsl_vector_alloc((size_t)(m - s.degree + 1));
        int sign;
        s.spline = gsl_bspline_alloc((size_t)s.degree + 1, (size_t)(m - s.degree + 1));
        s.basis = gsl_vector_alloc((size_t)m);
        s.lu = gsl_matrix_alloc((size_t)m, (size_t)m);
        s.permutation = gsl_permutation_alloc((size_t)m);
        for (j = 0; j <= m - s.degree; j++) gsl_vector_set(knots, (size_t)j, (double)j / (m - s.degree));
        gsl_bspline_knots(knots, s.spline);
        for (j = 0; j < m; j++) {
            gsl_bspline_eval(wf_time(s.w, j), s.basis, s.spline);
            gsl_matrix_set_row(s.lu, (size_t)j, s.basis);
        }
        gsl_linalg_LU_decomp(s.lu, s.permutation, &sign);
        gsl_vector_free(knots);
        gsl_vector_free(s.basis);
        s.basis = gsl_vector_alloc((size_t)s.degree + 1);
    }
#endif
    race(&s, all, COUNT, t);
    if (n == 1)
        printf(
            "       1 %3d | nanoseconds: fit %.0f, eval %.0f, 4 in eval_many %.0f, interpolate %.0f, resample %.0f\n",
            m, t[1] * 1e9, t[3] * 1e9, t[7] * 1e9, t[5] * 1e9, t[8] * 1e9);
    else {
        printf("%8ld %3d | %9.2f %6.2f %8.2f | %9.2f %6.2f | %6.2f %6.2f | %6.2f | %8.2f", (long)n, m, t[0] * 1e6,
               t[1] / t[0], t[COUNT - 1] / t[0], t[2] * 1e6, t[3] / t[2], t[7] / t[6], t[7] / (4 * t[2]), t[5] / t[4],
               t[8] / t[0]);
#ifdef HAVE_GSL
        printf(" | %7.1f %7.1f", t[9] / t[1], t[10] / t[3]);
#endif
        printf("\n");
    }
    fflush(stdout);
#ifdef HAVE_GSL
    gsl_bspline_free(s.spline);
    gsl_vector_free(s.basis);
    gsl_matrix_free(s.lu);
    gsl_permutation_free(s.permutation);
#endif
    free(mem);
    free(mem2);
    free(s.x);
    free(s.c);
    free(s.zero);
    free(s.out);
}

int main(void)
{
    static const ptrdiff_t n[] = {1, 100, 10000, 1000000};
    static const int m[] = {3, 6, 11, 21};
    int i, j;
    printf("waveform.h: microseconds of the floor, ratios to it\n");
    printf("       n   m |    memcpy    fit in place |       sum   eval | many/4 /sum   | interp | resample"
#ifdef HAVE_GSL
           " | GSL fit, eval, over ours"
#endif
           "\n");
    for (i = 0; i < 4; i++)
        for (j = 0; j < 4; j++) bench(n[i], m[j]);
    return 0;
}
