/* SPDX-License-Identifier: MIT

   loops_kit.h - what the hosts of loops.c have in common: loads that change from window to window, and LAPACK. */
#ifndef LOOPS_KIT_H_INCLUDED
#define LOOPS_KIT_H_INCLUDED
#include "arena.h"

extern void dgtsv_(const int *n, const int *nrhs, double *below, double *diagonal, double *above, double *b,
                   const int *ldb, int *info);
extern void dpbsv_(const char *uplo, const int *n, const int *kd, const int *nrhs, double *ab, const int *ldab,
                   double *b, const int *ldb, int *info);
extern void dgesv_(const int *n, const int *nrhs, double *A, const int *lda, int *pivot, double *B, const int *ldb,
                   int *info);
extern void dsyev_(const char *job, const char *uplo, const int *n, double *A, const int *lda, double *w, double *work,
                   const int *lwork, int *info);

enum { HOST_WINDOWS = 11, HOST_COLUMNS = 20, HOST_LIMIT = 3000 };

/* A load over the windows, about 1: a wave, and two jumps that stay */
typedef struct course {
    double size, phase, rate, jump[2];
    int at[2];
} course;

static course course_of(chance *c, double size, double jump)
{
    course a;
    int k;
    a.size = size;
    a.phase = 3.14159265358979 * uniform(c);
    a.rate = between(c, 0.2, 0.9);
    for (k = 0; k < 2; k++) {
        a.at[k] = integer(c, 1, HOST_WINDOWS - 1);
        a.jump[k] = jump * uniform(c);
    }
    return a;
}

static double course_at(const course *a, int window)
{
    double value = 1 + a->size * sin(a->phase + a->rate * window);
    int k;
    for (k = 0; k < 2; k++)
        if (window >= a->at[k]) value += a->jump[k];
    return value;
}

static void fill(ptrdiff_t n, double value, double *x)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++) x[i] = value;
}

static double clamp(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

/* b := A^-1 b, A tridiagonal; the three diagonals are overwritten.  < 0: singular. */
static int solve_tridiagonal(int n, double *below, double *diagonal, double *above, double *b)
{
    const int one = 1;
    int info;
    dgtsv_(&n, &one, below, diagonal, above, b, &n, &info);
    return info == 0 ? 0 : -1;
}

/* b := A^-1 b, A symmetric positive definite, its lower band in LAPACK's layout, overwritten.  < 0: it is not. */
static int solve_band(int n, int band, double *A, double *b)
{
    const int one = 1, rows = band + 1;
    int info;
    dpbsv_("L", &n, &band, &one, A, &rows, b, &n, &info);
    return info == 0 ? 0 : -1;
}

/* b := A^-1 b, A by columns, overwritten.  < 0: singular. */
static int solve_dense(int n, double *A, double *b)
{
    const int one = 1;
    int pivot[64], info;
    dgesv_(&n, &one, A, &n, pivot, b, &n, &info);
    return info == 0 ? 0 : -1;
}

/* The host's unknowns and its windows; the limit is that of |r| / |hx|. */
static void host_is(problem *p, void *state, int n, double limit)
{
    p->state = state;
    p->n = n;
    p->windows = HOST_WINDOWS;
    p->columns = HOST_COLUMNS;
    p->limit = HOST_LIMIT;
    p->relative = limit;
}

#endif
