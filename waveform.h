/* SPDX-License-Identifier: MIT

   waveform.h - v0.1.0 - B-splines in time, for arrays that depend on it

   In *one* C or C++ file, before the include:

      #define WF_IMPLEMENTATION
      #include "waveform.h"

   Elsewhere just include it.  Needs libc and libm only.  Never allocates, prints, aborts or sets a global.

   SYNOPSIS

      wf *w;                                         // a time grid, in your memory
      wf_make(&w, 3, 50, mem, bytes);                // cubic, room for 50 samples; bytes >= wf_size(3, 50)
      j = wf_push(w, t);                             // a new sub-step: write its sample to x + j*ldx
      wf_interpolate(w, s, 0, n, x, ldx, v);         // v[0..n-1] = value at time s
      wf_fit(w, n, x, ldx, c, ldc);                  // many evaluations: samples -> coefficients, once,
      wf_eval(w, s, 1, n, c, ldc, v);                //    then each is cheaper; here the time derivative
      wf_rollback(w);                                // repeat the window, or
      wf_advance(w, 2, n, x, ldx);                   // go on to the next one and keep two older samples           */

#ifndef WF_H_INCLUDED
#define WF_H_INCLUDED
#define WF_VERSION 100 /* 10000*major + 100*minor + patch */

#include <stddef.h>

#ifndef WF_API
#    ifndef WF_STATIC
#        define WF_API extern
#    elif defined(__GNUC__)
#        define WF_API static __attribute__((unused))
#    else
#        define WF_API static
#    endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {                  /* < 0: nothing was done, nothing touched.  > 0: done, with a remark */
    WF_OK     = 0,
    WF_EXTRAP = 101,    /* a time lies outside the stored ones: the end polynomial is continued */
    WF_EARG   = -101,   /* an argument is out of range, NULL, NaN, or output overlaps input */
    WF_EMEM   = -102,   /* memory too small or not aligned for a double */
    WF_EORDER = -103,   /* times do not increase */
    WF_EFULL  = -104,   /* no column left: make the grid with more */
    WF_EFEW   = -105,   /* too few samples */
    WF_ERANGE = -106,   /* a weight is not representable: the times are too close or too far for this derivative */
    WF_ELONG  = -107    /* more columns than fit on the stack of this call: use wf_fit and wf_eval */
};

enum { WF_MAX_DEGREE = 15 };

typedef struct wf wf; /* holds no pointers: memcpy of the block is a checkpoint */

/* Bytes for a grid of at most `capacity` columns; 0 if an argument is bad. */
WF_API size_t wf_size(int degree, int capacity);

/* An empty grid in mem[0..bytes-1], which must be aligned for a double and outlive *w.  There is no destroy. */
WF_API int wf_make(wf **w, int degree, int capacity, void *mem, size_t bytes);

/* Append time t.  Returns the column the sample is to be written into; a time equal, up to round-off, to a stored one
   returns that one's column.  Negative: WF_EORDER, WF_EFULL, WF_EARG. */
WF_API int wf_push(wf *w, double t);

/* As wf_push, for a sample in the returned column and its time derivative in the next one.  Needs degree >= 2. */
WF_API int wf_push_hermite(wf *w, double t);

/* Back to the window start: forget every column after it. */
WF_API int wf_rollback(wf *w);

/* Next window: the last sample becomes its start, up to `history` older samples stay in front of it.  The columns of x
   move down with their times: new column j is old column j + (columns before - columns after). */
WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx);

WF_API int    wf_columns(const wf *w);          /* columns in use */
WF_API int    wf_degree(const wf *w);           /* working degree: min(degree, columns - 1) */
WF_API int    wf_start(const wf *w);            /* column of the window start; columns before it are history */
WF_API double wf_time(const wf *w, int column); /* NaN if there is no such column */

/* value(t) = sum_j weight[j] * x_j over all wf_columns() columns; deriv: order of the time derivative. */
WF_API int wf_weights(const wf *w, double t, int deriv, double *weight);

/* out[0..n-1] = that sum.  A stored time returns its sample bit for bit.  out may not overlap x. */
WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out);

/* Samples x to spline coefficients c, wf_columns() columns each; c may be x. */
WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c, ptrdiff_t ldc);

/* value(t) = sum_i weight[i] * c_{first+i}, i = 0 .. wf_degree(). */
WF_API int wf_basis(const wf *w, double t, int deriv, int *first, double *weight);

/* out[0..n-1] = that sum.  out may not overlap c. */
WF_API int wf_eval(const wf *w, double t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out);

/* out + k*ldout = value at t[k], k = 0 .. count-1, in one sweep over c. */
WF_API int wf_eval_many(const wf *w, int count, const double *t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                        double *out, ptrdiff_t ldout);

/* Samples x on `from` to samples y on `to`; y may be x with ldy == ldx.  A time both grids share keeps its sample bit
   for bit. */
WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *y,
                       ptrdiff_t ldy);

WF_API int         wf_version(void);       /* of the implementation linked in */
WF_API const char *wf_message(int status); /* never NULL */

#ifdef __cplusplus
}
#endif
#elif WF_VERSION != 100
#error "two different versions of waveform.h in one translation unit"
#endif /* WF_H_INCLUDED */

#ifdef WF_IMPLEMENTATION
#ifndef WF_IMPLEMENTATION_INCLUDED
#define WF_IMPLEMENTATION_INCLUDED

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__) || defined(_MSC_VER)
#    define WF__RESTRICT __restrict
#else
#    define WF__RESTRICT
#endif

#define WF__STACK 4096  /* doubles a call may keep on the stack */
#define WF__TERMS 8     /* columns in one fused sweep */
#define WF__ROWS  1024  /* rows of a result that stay in the first level of cache */
#define WF__BLOCK 16384 /* doubles of a working set that stay in the second level */
#define WF__BATCH 32    /* times evaluated in one sweep */
#define WF__ORDER (WF_MAX_DEGREE + 1)

struct wf {
    int degree, capacity; /* as asked for */
    int columns, start;   /* in use; column of the window start */
    int p, slopes;        /* working degree; number of derivative columns */
    int exponent, spare;  /* s = (t - origin) 2^-exponent, exact, so that the s span a length in [1, 2) */
    double origin;
    double down1, down2;  /* 2^-exponent in two factors, neither of which overflows */
    double step;          /* the last increase of the time: what is round-off is judged against it */
};

/* ---- memory: times t, scaled times s, knots u, banded LU factors, in this order behind the struct --------------- */

static int wf__width(int degree)
{
    return degree > 1 ? 2 * degree - 1 : 1;
}

static double *wf__t(const wf *w)
{
    return (double *)(uintptr_t)(w + 1);
}

static double *wf__s(const wf *w)
{
    return wf__t(w) + w->capacity;
}

static double *wf__u(const wf *w)
{
    return wf__s(w) + w->capacity;
}

/* Row r of the factors: lu[b + k - r] is entry (r, k), |k - r| <= b = max(p - 1, 0). */
static double *wf__lu(const wf *w, int r)
{
    return wf__u(w) + w->capacity + w->degree + 1 + (size_t)r * (size_t)wf__width(w->degree);
}

WF_API size_t wf_size(int degree, int capacity)
{
    size_t per_column, fixed;
    if (degree < 0 || degree > WF_MAX_DEGREE || capacity < 1 || capacity > INT_MAX - 2 * WF__ORDER) return 0;
    per_column = (size_t)(3 + wf__width(degree)) * sizeof(double);
    fixed = sizeof(wf) + (size_t)(degree + 1) * sizeof(double);
    if ((size_t)capacity > ((size_t)-1 - fixed) / per_column) return 0;
    return fixed + (size_t)capacity * per_column;
}

WF_API int wf_make(wf **w, int degree, int capacity, void *mem, size_t bytes)
{
    size_t need = wf_size(degree, capacity);
    if (!w || need == 0) return WF_EARG;
    if (!mem || bytes < need || (uintptr_t)mem % sizeof(double) != 0) return WF_EMEM;
    memset(mem, 0, need);
    *w = (wf *)mem;
    (*w)->degree = degree;
    (*w)->capacity = capacity;
    (*w)->down1 = (*w)->down2 = 1;
    return WF_OK;
}

/* ---- scalars ---------------------------------------------------------------------------------------------------- */

/* On the bits, because -ffast-math folds isfinite to true. */
static int wf__finite(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (bits >> 52 & 0x7ff) != 0x7ff;
}

static int wf__all_finite(int n, const double *v)
{
    int i;
    for (i = 0; i < n; i++)
        if (!wf__finite(v[i])) return 0;
    return 1;
}

/* A derivative column repeats the time of the value column in front of it. */
static int wf__is_slope(const wf *w, int j)
{
    const double *t = wf__t(w);
    return j > 0 && j < w->columns && !(t[j] > t[j - 1]);
}

/* Times closer than this are one instant: four ulp, or half an ulp for every sub-step that the host may have added up,
   twice over, but then no more than a thousandth of a step: at t = 1e9 steps of 1e-6 are 8 ulp long and stay distinct. */
static double wf__tolerance(const wf *w, double t)
{
    const double *T = wf__t(w);
    double big = fabs(t), ulp, grown;
    int e;
    if (big < fabs(T[0])) big = fabs(T[0]);
    if (big < fabs(T[w->columns - 1])) big = fabs(T[w->columns - 1]);
    (void)frexp(big, &e);
    ulp = ldexp(1.0, e - 53 < -1074 ? -1074 : e - 53);
    grown = (w->columns - w->start) * ulp;
    if (grown > w->step / 1000) grown = w->step / 1000;
    return grown > 4 * ulp ? grown : 4 * ulp;
}

/* The first column whose time is not below t. */
static int wf__lower_bound(const wf *w, double t)
{
    const double *T = wf__t(w);
    int low = 0, high = w->columns, mid;
    while (low < high) {
        mid = low + (high - low) / 2;
        if (T[mid] < t) low = mid + 1;
        else high = mid;
    }
    return low;
}

/* The value column whose time equals t up to round-off, or -1. */
static int wf__find(const wf *w, double t)
{
    const double *T = wf__t(w);
    double tolerance = wf__tolerance(w, t);
    int j = wf__lower_bound(w, t);
    if (j < w->columns && T[j] - t <= tolerance && !(j > 0 && t - T[j - 1] < T[j] - t)) return j;
    if (j > 0 && t - T[j - 1] <= tolerance) return j - 1 - wf__is_slope(w, j - 1);
    return -1;
}

/* ---- basis functions --------------------------------------------------------------------------------------------- */

/* The values, or deriv-th time derivatives, at scaled time s of the p+1 basis functions first .. first+p that live on
   the knot span (u_k, u_k+1] of s; outside the knots the end spans are continued.  deriv <= p.  Returns first. */
static int wf__splines(const wf *w, double s, int deriv, double *N)
{
    const double *u = wf__u(w);
    int p = w->p, q = p - deriv, low = p, high = w->columns - 1, k, j, r;
    if (p == 0 && !(u[w->columns] > u[0])) high = 0; /* a single time */
    while (low < high) {
        k = low + (high - low + 1) / 2;
        if (u[k] < s) low = k;
        else high = k - 1;
    }
    k = low;
    N[0] = 1;
    for (j = 1; j <= q; j++) { /* Cox - de Boor up to degree q */
        double carry = 0;
        for (r = 0; r < j; r++) {
            double right = u[k + 1 + r], left = u[k + 1 + r - j], share = N[r] / (right - left);
            N[r] = carry + (right - s) * share;
            carry = (s - left) * share;
        }
        N[j] = carry;
    }
    for (j = q + 1; j <= p; j++) { /* each differentiation raises the degree by one: N' = j (N_i / du - N_i+1 / du) */
        double carry = 0;
        for (r = 0; r < j; r++) {
            double share = j * N[r] / (u[k + 1 + r] - u[k + 1 + r - j]) * w->down1 * w->down2;
            N[r] = carry - share;
            carry = share;
        }
        N[j] = carry;
    }
    return k - p;
}

/* ---- the collocation matrix --------------------------------------------------------------------------------------- */

/* Row r of the matrix belongs to column r of the data, but at the last time the derivative's row comes first:
   otherwise the factorisation would meet a zero pivot there. */
static int wf__column(const wf *w, int r)
{
    int m = w->columns;
    return r >= m - 2 && wf__is_slope(w, m - 1) ? 2 * m - 3 - r : r;
}

/* LU without pivoting, row by row.  The matrix is totally positive, so nothing grows (de Boor & Pinkus 1977).
   Returns 0 when round-off has eaten a pivot. */
static int wf__factor(wf *w, int from)
{
    int b = w->p > 1 ? w->p - 1 : 0, r, i, k, first, slope;
    double N[WF__ORDER], unit = ldexp(1.0, w->exponent);
    for (r = from; r < w->columns; r++) {
        double *a = wf__lu(w, r);
        int c = wf__column(w, r);
        slope = wf__is_slope(w, c);
        first = wf__splines(w, wf__s(w)[c], slope, N);
        for (i = 0; i <= 2 * b; i++) a[i] = 0;
        for (i = 0; i <= w->p; i++)
            if (first + i >= r - b && first + i <= r + b) a[b + first + i - r] = slope ? N[i] * unit : N[i];
        if (w->p < 2) a[b] = 1;
        for (k = r > b ? r - b : 0; k < r; k++) {
            const double *pivot = wf__lu(w, k);
            double l = a[b + k - r];
            if (!(fabs(l) > 0)) continue;
            l = a[b + k - r] /= pivot[b];
            for (i = 1; i <= b; i++) a[b + k - r + i] -= l * pivot[b + i];
        }
        if (!(slope ? fabs(a[b]) > 0 : a[b] > 0) || !wf__all_finite(2 * b + 1, a)) return 0;
    }
    return 1;
}

/* Everything that follows from the times, when the first `keep` of them are as they were.  A change of columns changes
   only the last few knots and rows. */
static void wf__build(wf *w, int keep)
{
    const double *T = wf__t(w);
    double *s = wf__s(w), *u = wf__u(w), origin, span, sum;
    int m = w->columns, i, j, e = 0, p = m > w->degree ? w->degree : m - 1, p_min, ok;
    if (m == 0) return;
    span = T[m - 1] - T[0];
    if (!(span > 0)) p = 0;
    else (void)frexp(span / 2, &e);
    /* Subtracting the first time is exact where all times are within a factor of two of each other, and no gain elsewhere. */
    origin = fabs(T[0]) / 2 > span || fabs(T[m - 1]) / 2 > span ? T[0] : 0;
    if (e != w->exponent || p != w->p || origin < w->origin || origin > w->origin) keep = 0;
    w->exponent = e;
    w->origin = origin;
    w->down1 = ldexp(1.0, -(e / 2));
    w->down2 = ldexp(1.0, e / 2 - e);
    for (j = keep; j < m; j++) s[j] = (T[j] - origin) * w->down1 * w->down2;
    p_min = p < 2 ? p : w->slopes ? 2 : 1;
    do {
        w->p = p;
        for (j = 0; j <= p; j++) u[j] = s[0];
        for (j = keep > p + 1 ? keep - p : 1; j < m - p; j++) { /* averaged knots */
            for (sum = 0, i = 1; i < p; i++) sum += s[j + i] - s[j];
            u[p + j] = p ? s[j] + sum / p : s[j - 1];
        }
        for (j = m; j <= m + p; j++) u[j] = s[m - 1];
        ok = wf__factor(w, keep > 2 * p + 2 ? keep - 2 * p - 2 : 0);
        keep = 0;
    } while (!ok && --p >= p_min);
}

/* ---- the window --------------------------------------------------------------------------------------------------- */

static int wf__push(wf *w, double t, int slope)
{
    double *T;
    int m, j;
    if (!w || !wf__finite(t) || (slope && w->degree < 2)) return WF_EARG;
    T = wf__t(w);
    m = w->columns;
    if (m > 0) {
        j = wf__find(w, t);
        if (j >= 0 && (!slope || wf__is_slope(w, j + 1))) return j;
        if (j >= 0 && j < m - 1) return WF_EORDER; /* no room for a derivative between the columns */
        if (j >= 0) {
            if (m == w->capacity) return WF_EFULL;
            T[m] = T[j];
            w->columns++;
            w->slopes++;
            wf__build(w, m - 1);
            return j;
        }
        if (!(t > T[m - 1])) return WF_EORDER;
        if (!wf__finite(t - T[0])) return WF_ERANGE;
    }
    if (m + 1 + slope > w->capacity) return WF_EFULL;
    if (m > 0) w->step = t - T[m - 1];
    T[m] = t;
    if (slope) T[m + 1] = t;
    w->columns += 1 + slope;
    w->slopes += slope;
    wf__build(w, m);
    return m;
}

WF_API int wf_push(wf *w, double t)
{
    return wf__push(w, t, 0);
}

WF_API int wf_push_hermite(wf *w, double t)
{
    return wf__push(w, t, 1);
}

static void wf__count_slopes(wf *w)
{
    int j;
    for (w->slopes = 0, j = 1; j < w->columns; j++) w->slopes += wf__is_slope(w, j);
}

WF_API int wf_rollback(wf *w)
{
    if (!w) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    w->columns = w->start + 1 + wf__is_slope(w, w->start + 1);
    wf__count_slopes(w);
    wf__build(w, w->columns);
    return WF_OK;
}

WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    int first, last, j;
    if (!w || history < 0 || n < 0 || (n > 0 && !x) || ldx < n) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    last = w->columns - 1 - wf__is_slope(w, w->columns - 1);
    for (first = last; history > 0 && first > 0; history--) first -= 1 + wf__is_slope(w, first - 1);
    if (first > 0) {
        for (j = first; n > 0 && j < w->columns; j++)
            memcpy(x + (ptrdiff_t)(j - first) * ldx, x + (ptrdiff_t)j * ldx, (size_t)n * sizeof(double));
        memmove(wf__t(w), wf__t(w) + first, (size_t)(w->columns - first) * sizeof(double));
    }
    w->columns -= first;
    w->start = last - first;
    wf__count_slopes(w);
    wf__build(w, 0);
    return WF_OK;
}

WF_API int wf_columns(const wf *w)
{
    return w ? w->columns : WF_EARG;
}

WF_API int wf_degree(const wf *w)
{
    return w ? w->p : WF_EARG;
}

WF_API int wf_start(const wf *w)
{
    return w ? w->start : WF_EARG;
}

WF_API double wf_time(const wf *w, int column)
{
    const uint64_t bits = (uint64_t)0x7ff8 << 48;
    double nan;
    memcpy(&nan, &bits, sizeof nan);
    return w && column >= 0 && column < w->columns ? wf__t(w)[column] : nan;
}

/* ---- long sweeps --------------------------------------------------------------------------------------------------- */

/* gcc 12 vectorises at -O2 only inner loops of known length; clang prefers the plain loop. */
#ifdef __clang__
#    define WF__LANES 1
#else
#    define WF__LANES 8
#endif

#define WF__LOOP(expression)                                                                                           \
    do {                                                                                                               \
        for (i = 0; i + WF__LANES <= n; i += WF__LANES)                                                                \
            for (k = i; k < i + WF__LANES; k++) o[k] = expression;                                                     \
        for (k = i; k < n; k++) o[k] = expression;                                                                     \
    } while (0)

#define WF__T1 w0 * p0[k]
#define WF__T2 WF__T1 + w1 * p1[k]
#define WF__T3 WF__T2 + w2 * p2[k]
#define WF__T4 WF__T3 + w3 * p3[k]
#define WF__T5 WF__T4 + w4 * p4[k]
#define WF__T6 WF__T5 + w5 * p5[k]
#define WF__T7 WF__T6 + w6 * p6[k]
#define WF__T8 WF__T7 + w7 * p7[k]
#define WF__POINTER(j) const double *WF__RESTRICT p##j = p[j < terms ? j : 0]
#define WF__WEIGHT(j) w##j = g[j < terms ? j : 0]

/* fresh: o = f * (g_0 p_0 + .. ); else o = f * o + g_0 p_0 + ..; 1 to 8 terms, none of the p overlaps o. */
static void wf__sweep(ptrdiff_t n, int fresh, double f, int terms, const double *const *p, const double *g,
                      double *WF__RESTRICT o)
{
    WF__POINTER(0);
    WF__POINTER(1);
    WF__POINTER(2);
    WF__POINTER(3);
    WF__POINTER(4);
    WF__POINTER(5);
    WF__POINTER(6);
    WF__POINTER(7);
    const double WF__WEIGHT(0), WF__WEIGHT(1), WF__WEIGHT(2), WF__WEIGHT(3), WF__WEIGHT(4), WF__WEIGHT(5),
        WF__WEIGHT(6), WF__WEIGHT(7);
    ptrdiff_t i, k;
    switch (fresh ? terms : -terms) {
    case 1: WF__LOOP(f * (WF__T1)); break;
    case 2: WF__LOOP(f * (WF__T2)); break;
    case 3: WF__LOOP(f * (WF__T3)); break;
    case 4: WF__LOOP(f * (WF__T4)); break;
    case 5: WF__LOOP(f * (WF__T5)); break;
    case 6: WF__LOOP(f * (WF__T6)); break;
    case 7: WF__LOOP(f * (WF__T7)); break;
    case 8: WF__LOOP(f * (WF__T8)); break;
    case -1: WF__LOOP(f * o[k] + (WF__T1)); break;
    case -2: WF__LOOP(f * o[k] + (WF__T2)); break;
    case -3: WF__LOOP(f * o[k] + (WF__T3)); break;
    case -4: WF__LOOP(f * o[k] + (WF__T4)); break;
    case -5: WF__LOOP(f * o[k] + (WF__T5)); break;
    case -6: WF__LOOP(f * o[k] + (WF__T6)); break;
    case -7: WF__LOOP(f * o[k] + (WF__T7)); break;
    case -8: WF__LOOP(f * o[k] + (WF__T8)); break;
    default: break;
    }
}

/* out = sum of weight[j] * column j.  Zero weights are skipped, so a NaN there does no harm.  The sum is scaled by the
   power of two above sum |weight|: it overflows only if the result does. */
static void wf__combine(ptrdiff_t n, int columns, const double *weight, const double *x, ptrdiff_t ldx, double *out)
{
    const double *p[WF__TERMS];
    double g[WF__TERMS], size = 0, up = 1, down = 1;
    ptrdiff_t i, rows;
    int j, terms, fresh, e;
    for (j = 0; j < columns; j++) size += fabs(weight[j]);
    if (size > 1.000001) {
        (void)frexp(size, &e);
        if (e > 1023) e = 1023;
        up = ldexp(1.0, e);
        down = ldexp(1.0, -e);
    }
    for (i = 0; i < n; i += rows) {
        rows = columns <= WF__TERMS || n - i < WF__ROWS ? n - i : WF__ROWS;
        for (fresh = 1, terms = 0, j = 0; j < columns; j++) {
            if (!(fabs(weight[j]) > 0)) continue;
            p[terms] = x + (ptrdiff_t)j * ldx + i;
            g[terms++] = weight[j] * down;
            if (terms < WF__TERMS) continue;
            wf__sweep(rows, fresh, 1, terms, p, g, out + i);
            fresh = terms = 0;
        }
        if (fresh && terms) {
            wf__sweep(rows, 1, up, terms, p, g, out + i);
            continue;
        }
        if (fresh) memset(out + i, 0, (size_t)rows * sizeof(double));
        if (terms) wf__sweep(rows, 0, 1, terms, p, g, out + i);
        if (up > 1) {
            ptrdiff_t k;
            for (k = i; k < i + rows; k++) out[k] *= up;
        }
    }
}

static int wf__overlap(ptrdiff_t n, int columns, const double *x, ptrdiff_t ldx, int count, const double *y,
                       ptrdiff_t ldy)
{
    uintptr_t x0 = (uintptr_t)x, y0 = (uintptr_t)y;
    if (n == 0 || columns == 0 || count == 0) return 0;
    return x0 < (uintptr_t)(y + (ptrdiff_t)(count - 1) * ldy + n) &&
           y0 < (uintptr_t)(x + (ptrdiff_t)(columns - 1) * ldx + n);
}

/* ---- evaluation ------------------------------------------------------------------------------------------------------ */

/* The scaled time of t; within round-off of an end it is the end. */
static int wf__scale(const wf *w, double t, double *s)
{
    const double *T = wf__t(w);
    int m = w->columns, status = WF_OK;
    if (!wf__finite(t)) return WF_EARG;
    if (m == 0) return WF_EFEW;
    if (t < T[0]) {
        if (T[0] - t <= wf__tolerance(w, t)) t = T[0];
        else status = WF_EXTRAP;
    } else if (t > T[m - 1]) {
        if (t - T[m - 1] <= wf__tolerance(w, t)) t = T[m - 1];
        else status = WF_EXTRAP;
    } else if (w->p == 0) { /* the value jumps just after a stored time: it must not do so within round-off of it */
        int j = wf__lower_bound(w, t);
        if (j > 0 && t - T[j - 1] <= wf__tolerance(w, t) && t - T[j - 1] < (T[j] - T[j - 1]) / 4) t = T[j - 1];
    }
    *s = (t - w->origin) * w->down1 * w->down2;
    return wf__finite(*s) ? status : WF_ERANGE;
}

static int wf__basis(const wf *w, double t, int deriv, int *first, double *N)
{
    double s = 0;
    int status = wf__scale(w, t, &s), i;
    if (status < 0) return status;
    if (deriv > w->p) {
        for (i = 0; i <= w->p; i++) N[i] = 0;
        *first = 0;
        return status;
    }
    *first = wf__splines(w, s, deriv, N);
    return wf__all_finite(w->p + 1, N) ? status : WF_ERANGE;
}

/* Weights on the samples from weights on the coefficients: weight := A^-T weight, A = L U. */
static void wf__transpose_solve(const wf *w, int first, double *weight)
{
    int m = w->columns, b = w->p > 1 ? w->p - 1 : 0, r, k;
    double unit;
    if (b == 0) return;
    for (r = first; r < m; r++) {
        double v = weight[r];
        for (k = r - b > first ? r - b : first; k < r; k++) v -= wf__lu(w, k)[b + r - k] * weight[k];
        weight[r] = v / wf__lu(w, r)[b];
    }
    for (r = m - 2; r >= 0; r--) {
        double v = weight[r];
        for (k = r + 1; k <= r + b && k < m; k++) v -= wf__lu(w, k)[b + r - k] * weight[k];
        weight[r] = v;
    }
    if (!w->slopes) return;
    if (wf__is_slope(w, m - 1)) {
        double v = weight[m - 1];
        weight[m - 1] = weight[m - 2];
        weight[m - 2] = v;
    }
    unit = ldexp(1.0, w->exponent);
    for (r = 1; r < m; r++)
        if (wf__is_slope(w, r)) weight[r] *= unit;
}

/* The column that holds the deriv-th derivative at scaled time s itself, or -1. */
static int wf__stored(const wf *w, double t, double s, int deriv)
{
    int j = wf__lower_bound(w, t);
    if (j == w->columns || (j > 0 && !(s > wf__s(w)[j - 1]))) j = j > 0 ? j - 1 : 0;
    if (wf__is_slope(w, j)) j--;
    if (wf__s(w)[j] < s || wf__s(w)[j] > s) return -1;
    if (deriv == 0) return j;
    return deriv == 1 && wf__is_slope(w, j + 1) ? j + 1 : -1;
}

WF_API int wf_weights(const wf *w, double t, int deriv, double *weight)
{
    double s = 0, N[WF__ORDER];
    int status, first, j;
    if (!w || deriv < 0 || !weight) return WF_EARG;
    status = wf__basis(w, t, deriv, &first, N);
    if (status < 0) return status;
    wf__scale(w, t, &s);
    for (j = 0; j < w->columns; j++) weight[j] = 0;
    j = wf__stored(w, t, s, deriv);
    if (j >= 0) {
        weight[j] = 1;
        return status;
    }
    for (j = 0; j <= w->p; j++) weight[first + j] = N[j];
    wf__transpose_solve(w, first, weight);
    return status;
}

WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    double weight[WF__STACK];
    int status;
    if (!w || deriv < 0 || n < 0 || (n > 0 && (!x || !out)) || ldx < n) return WF_EARG;
    if (wf__overlap(n, w->columns, x, ldx, 1, out, n)) return WF_EARG;
    if (w->columns > WF__STACK) return WF_ELONG;
    status = wf_weights(w, t, deriv, weight);
    if (status < 0) return status;
    if (!wf__all_finite(w->columns, weight)) return WF_ERANGE;
    wf__combine(n, w->columns, weight, x, ldx, out);
    return status;
}

/* dst = own * src + sum g p, where src may be dst. */
static void wf__row(ptrdiff_t n, double own, const double *src, int terms, const double **p, double *g, double *dst)
{
    int fresh = src != dst, take;
    if (fresh) {
        p[terms] = src;
        g[terms++] = own;
    }
    for (; terms > 0; terms -= take, p += take, g += take) {
        take = terms < WF__TERMS ? terms : WF__TERMS;
        wf__sweep(n, fresh, fresh ? 1 : own, take, p, g, dst);
        fresh = 0;
        own = 1;
    }
}

WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c, ptrdiff_t ldc)
{
    const double *p[WF__ORDER + 1];
    double g[WF__ORDER + 1], unit;
    ptrdiff_t i, k, rows;
    int m, b, r, j, terms, inplace;
    if (!w || n < 0 || (n > 0 && (!x || !c)) || ldx < n || ldc < n) return WF_EARG;
    m = w->columns;
    inplace = x == c && ldx == ldc;
    if (m == 0) return WF_EFEW;
    if (!inplace && wf__overlap(n, m, x, ldx, m, c, ldc)) return WF_EARG;
    b = w->p > 1 ? w->p - 1 : 0;
    unit = ldexp(1.0, w->exponent);
    for (i = 0; i < n; i += rows) {
        rows = WF__BLOCK / m < 64 ? 64 : WF__BLOCK / m;
        if (rows > n - i) rows = n - i;
        if (inplace && b > 0 && wf__is_slope(w, m - 1))
            for (k = i; k < i + rows; k++) {
                double *y = c + (ptrdiff_t)(m - 2) * ldc + k, v = y[0];
                y[0] = y[ldc];
                y[ldc] = v;
            }
        for (r = 0; r < m; r++) { /* c := L^-1 x */
            const double *a = wf__lu(w, r);
            int column = b > 0 ? wf__column(w, r) : r;
            double *dst = c + (ptrdiff_t)r * ldc + i, own = b > 0 && wf__is_slope(w, column) ? unit : 1;
            for (terms = 0, j = r > b ? r - b : 0; j < r; j++)
                if (fabs(a[b + j - r]) > 0) {
                    p[terms] = c + (ptrdiff_t)j * ldc + i;
                    g[terms++] = -a[b + j - r];
                }
            if (inplace && terms == 0)
                for (k = 0; own != 1 && k < rows; k++) dst[k] *= own;
            else wf__row(rows, own, inplace ? dst : x + (ptrdiff_t)column * ldx + i, terms, p, g, dst);
        }
        for (r = m - 2; b > 0 && r >= 0; r--) { /* c := U^-1 c */
            const double *a = wf__lu(w, r);
            double *dst = c + (ptrdiff_t)r * ldc + i, own = 1 / a[b];
            for (terms = 0, j = r + 1; j <= r + b && j < m; j++)
                if (fabs(a[b + j - r]) > 0) {
                    p[terms] = c + (ptrdiff_t)j * ldc + i;
                    g[terms++] = -a[b + j - r] * own;
                }
            if (terms) wf__row(rows, own, dst, terms, p, g, dst);
            else if (own != 1)
                for (k = 0; k < rows; k++) dst[k] *= own;
        }
    }
    return WF_OK;
}

WF_API int wf_basis(const wf *w, double t, int deriv, int *first, double *weight)
{
    double N[WF__ORDER];
    int status, start;
    if (!w || deriv < 0 || !first || !weight) return WF_EARG;
    status = wf__basis(w, t, deriv, &start, N);
    if (status < 0) return status;
    *first = start;
    memcpy(weight, N, (size_t)(w->p + 1) * sizeof(double));
    return status;
}

WF_API int wf_eval(const wf *w, double t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out)
{
    double N[WF__ORDER];
    int status, first;
    if (!w || deriv < 0 || n < 0 || (n > 0 && (!c || !out)) || ldc < n) return WF_EARG;
    if (wf__overlap(n, w->columns, c, ldc, 1, out, n)) return WF_EARG;
    status = wf__basis(w, t, deriv, &first, N);
    if (status >= 0) wf__combine(n, w->p + 1, N, c + (ptrdiff_t)first * ldc, ldc, out);
    return status;
}

WF_API int wf_eval_many(const wf *w, int count, const double *t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                        double *out, ptrdiff_t ldout)
{
    double N[WF__BATCH * WF__ORDER];
    int first[WF__BATCH], status = WF_OK, one, j, k, batch;
    ptrdiff_t i, rows;
    if (!w || count < 0 || (count > 0 && !t) || deriv < 0 || n < 0 || ldc < n || ldout < n) return WF_EARG;
    if (n > 0 && count > 0 && (!c || !out || wf__overlap(n, w->columns, c, ldc, count, out, ldout))) return WF_EARG;
    for (j = 0; j < count; j++) {
        one = wf__basis(w, t[j], deriv, &first[0], N);
        if (one < 0) return one;
        if (one > 0) status = one;
    }
    for (j = 0; j < count; j += batch) {
        batch = count - j < WF__BATCH ? count - j : WF__BATCH;
        for (k = 0; k < batch; k++) wf__basis(w, t[j + k], deriv, &first[k], N + k * WF__ORDER);
        for (i = 0; i < n; i += rows) { /* rows of c that stay in the second level of cache */
            rows = WF__BLOCK / (w->columns + batch) < 64 ? 64 : WF__BLOCK / (w->columns + batch);
            if (rows > n - i) rows = n - i;
            for (k = 0; k < batch; k++)
                wf__combine(rows, w->p + 1, N + k * WF__ORDER, c + (ptrdiff_t)first[k] * ldc + i, ldc,
                            out + (ptrdiff_t)(j + k) * ldout + i);
        }
    }
    return status;
}

WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *y,
                       ptrdiff_t ldy)
{
    double buffer[WF__STACK], N[WF__ORDER], s = 0;
    const double *samples = x;
    double *c;
    ptrdiff_t i, rows, lds = ldx;
    int status = WF_OK, one, m, j, k, first, slope, inplace, blocks;
    if (!from || !to || n < 0 || (n > 0 && (!x || !y)) || ldx < n || ldy < n) return WF_EARG;
    m = from->columns;
    inplace = x == y && ldx == ldy;
    blocks = inplace ? 2 : 1;
    if (m == 0) return WF_EFEW;
    if (!inplace && wf__overlap(n, m, x, ldx, to->columns, y, ldy)) return WF_EARG;
    if (m > WF__STACK / blocks) return WF_ELONG;
    for (j = 0; j < to->columns; j++) {
        one = wf__basis(from, wf__t(to)[j], wf__is_slope(to, j), &first, N);
        if (one < 0) return one;
        if (one > 0) status = one;
    }
    for (i = 0; i < n; i += rows) { /* rows of coefficients, and of samples if they are going to be overwritten */
        rows = WF__STACK / (m * blocks);
        if (rows > n - i) rows = n - i;
        c = buffer;
        samples = x + i;
        if (inplace) {
            for (j = 0; j < m; j++)
                memcpy(buffer + j * rows, x + (ptrdiff_t)j * ldx + i, (size_t)rows * sizeof(double));
            c = buffer + m * rows;
            samples = buffer;
            lds = rows;
        }
        wf_fit(from, rows, samples, lds, c, rows);
        for (j = 0; j < to->columns; j++) {
            double t = wf__t(to)[j], *dst = y + (ptrdiff_t)j * ldy + i;
            slope = wf__is_slope(to, j);
            wf__scale(from, t, &s);
            k = wf__stored(from, t, s, slope);
            if (k >= 0) memcpy(dst, samples + (ptrdiff_t)k * lds, (size_t)rows * sizeof(double));
            if (k >= 0) continue;
            wf__basis(from, t, slope, &first, N);
            wf__combine(rows, from->p + 1, N, c + first * rows, rows, dst);
        }
    }
    return status;
}

/* ---- messages -------------------------------------------------------------------------------------------------------- */

WF_API int wf_version(void)
{
    return WF_VERSION;
}

WF_API const char *wf_message(int status)
{
    switch (status) {
    case WF_OK: return "ok";
    case WF_EXTRAP: return "a time lies outside the stored times: the end polynomial was continued";
    case WF_EARG: return "an argument is NULL, NaN, out of range, or output overlaps input";
    case WF_EMEM: return "memory is missing, too small (see wf_size) or not aligned for a double";
    case WF_EORDER: return "times must increase";
    case WF_EFULL: return "no column is left: make the grid with a larger capacity";
    case WF_EFEW: return "too few samples: push some first";
    case WF_ERANGE: return "a weight overflows: the times are too close or too far apart for this";
    case WF_ELONG: return "too many columns for this call: use wf_fit and wf_eval";
    default: return status > 0 ? "unknown remark" : "unknown status of waveform.h";
    }
}

#ifdef __cplusplus
}
#endif
#endif /* WF_IMPLEMENTATION_INCLUDED */
#endif /* WF_IMPLEMENTATION */

/* MIT License

   Copyright (c) 2026 the authors of waveform.h, iqn.h and rk.h

   Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
   documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
   rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
   persons to whom the Software is furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
   Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
   WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT.  IN NO EVENT SHALL THE AUTHORS OR
   COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
   OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

   Version history
      0.1.0   first version                                                                                              */
