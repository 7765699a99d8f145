/* SPDX-License-Identifier: MIT

   waveform.h - v0.1.0 - B-splines in time, for arrays that depend on it

   In *one* C or C++ file, before the include:

      #define WF_IMPLEMENTATION
      #include "waveform.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates, prints, aborts or keeps a
   global.

   SYNOPSIS

      static double mem[1000], x[50 * N], c[50 * N], v[N]; // N numbers that depend on time
      double t[4], t0 = 0;
      wf *w;
      int j, k, window, sweep;
      if (wf_make(&w, 3, 50, mem, sizeof mem) < 0) return 1; // cubic, at most 50 columns; see wf_size
      wf_set(w, WF_STRICT, 1);                           // to read beyond the stored times is an error
      j = wf_push(w, t0);                                // a time; the return value is its column, or negative
      if (j < 0) return 1;
      sample(t0, x + j * N);
      for (window = 0; window < 3; window++) {
          for (k = 0; k < 4; k++) t[k] = t0 + (k + 1) * h;
          if (wf_begin(w, 4, t, 1, N, x, N) < 0) return 1; // four sub-steps, their columns filled with a first guess
          for (sweep = 0; sweep < 2; sweep++) {          // until the solvers agree
              wf_interpolate(w, t0 + 0.3 * h, 0, N, x, N, v); // one solver reads: v = the value at any time
              for (k = 0; k < 4; k++) {                  // the other one writes its sub-steps
                  j = wf_push(w, t[k]);                  // a stored time: its column, to be overwritten
                  if (j < 0) return 1;
                  sample(t[k], x + j * N);
              }
          }
          t0 = t[3];
          wf_fit(w, N, x, N, c, N);                      // for many evaluations: samples to coefficients once,
          wf_eval(w, t0 - h / 3, 1, N, c, N, v);         //     then cheaper sweeps; here the time derivative
          if (wf_advance(w, 2, N, x, N) < 0) return 1;   // the next window; two older samples stay
      }

   A wf holds the times and the small spline; the samples stay in your array, column j at x + j*ldx (Fortran:
   x(ldx,m)).  Whatever is computed is a short row of weights times columns.  The rows are public, for data on a device
   or spread over processes: wf_weights, wf_basis, wf_mean_weights, wf_error_weights, wf_predict, wf_project.

   After wf_advance the columns behind the window start still hold numbers of the old window.  wf_begin writes a first
   guess into every column that it opens; after a plain wf_push, write the column before anybody reads.  Sub-steps not
   known beforehand: wf_begin with the window end alone, then wf_rollback and wf_push as the solver goes.

   COMPILE-TIME OPTIONS, before the include, the same in every file

      WF_STATIC   every function private to the including file, for a library that embeds this header
      WF_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS

      Columns j = 0 .. m-1 have times t_0 <= t_1 <= ..; a time that occurs twice is a value and its derivative.  The
      spline of degree p = min(degree, m-1) is

         s(t) = sum_i c_i N_i(t),    s(t_j) = x_j  (or s'(t_j) = x_j),    i.e.  A c = x,   A_ji = N_i(t_j) or N_i'(t_j)

      on clamped knots with averages inside (the Greville choice, with which the times interlace the basis functions):

         u_0 = .. = u_p = t_0,  u_{p+j} = (t_j + .. + t_{j+p-1}) / p  for j = 1 .. m-p-1,  u_m = .. = u_{m+p} = t_{m-1}.

      m = p+1 is one polynomial; p = 1 joins the samples by lines; p = 0 holds x_j on (t_{j-1}, t_j], x_0 at t_0: the
      value at a stored time is its sample, the limit from the right is the next column.  At a knot, derivatives that
      jump are the limits from the left, also for a time that is the stored one up to round-off.  A has p-1 diagonals to
      each side and is totally positive, so LU without pivoting does not grow; it is made row by row, and a push remakes
      the last 2p+3 rows only.  Weights on the samples are w(t) = A^-T N(t); wf_fit is L U c = x swept over row blocks
      that stay in cache.

      error      f - s = - sum_j w_j(t) (a (t_j - t)^(p+1) + b (t_j - t)^(p+2)) + higher order: what the operator does
                 to the first two powers it cannot reproduce; a and b from divided differences of the samples near t
      integral   Gauss' rule on every knot span: positive, exact for the spline, no cancellation on short intervals
      noise      max over t of sum_j |w_j(t)| over the values, the Lebesgue constant, sampled at 5 points of every
                 sub-step: an error of size d in the samples shows up as d times it.  About 2, 5, 14, 49 for degree
                 3, 5, 7, 9 on even steps; 3e5 for any degree above 1 if the last step is 1e-6 of the others; 5e7
                 (degree 3) and 6e29 (degree 9) on twelve times whose steps grow by 4

      Times are shifted and scaled to s = (t - origin) 2^-k with |s| <= 4.  This is exact, so offsets of 1e9 and units
      of 1e-300 or 1e300 cost nothing.  To a push two times are one instant when they are within 4 ulp of the largest
      time, or within an ulp for each sub-step of the window if that is less than 1/1000 of the last step.

      de Boor, A Practical Guide to Splines, 1978: basis functions, collocation, knots.  de Boor & Pinkus, Numer. Math.
      27, 1977: elimination without pivoting for totally positive band matrices.

   WHICH FORM

      From samples (wf_interpolate) a time costs one read of all m columns; from coefficients (wf_fit, wf_eval) it costs
      degree+1 columns, after a fit of about two memcpy of the samples.  With degree 3 the fit pays from about 8
      evaluations at 6 samples and 3 at 21 on.  The two arrays look alike: wf_eval, wf_integral and wf_mean on samples
      give wrong numbers without a word, and any change of the grid makes coefficients stale.

   DOES NOT

      take back a single sub-step (push after it is accepted; wf_rollback goes to the window start), keep data monotone
      or positive, smooth, read files, know about processes or devices.

   LIMITATIONS

      At most degree 15.  Time only increases.  A step below 2^-1000 of the span is refused.
      Coefficients may be larger than the samples by the noise constant times 2^p: near 1e308 interpolate, do not fit.
      Samples below 1e-300 lose bits where weights are above 1.
      More than 4096 columns are refused (WF_ELONG) by wf_integral, wf_mean, wf_error, wf_error_weights, wf_quality and
      wf_lower, above degree 1 by wf_interpolate and wf_resample; wf_combine in place, too, and wf_resample in place
      above 2048.  These calls use up to 42 kB of stack.  wf_quality, wf_lower and wf_error cost columns^2.
      wf_error trusts the samples to resolve the function: at a kink it is too small, by one to two powers of ten for
      degree 3 and 4, by three and more for degree 9.
      Steps whose ratio exceeds about 20 ask for degree 1 (wf_quality says so).  With derivatives the degree stays at 2
      or above, and there round-off grows with the ratio of neighbouring steps though the noise is small: two such times
      1e-10 of the neighbouring step apart cost 9 digits, 1e-14 apart all but 3.
      A single sample with its derivative is a constant, to wf_fit.

   DETERMINISM

      The same binary gives the same bits, whatever n, stride, block and thread; wf_fit in place and out of place may
      differ in the last bits.  So may compilers that contract a*b+c (-march=native, -ffp-contract) and those that do
      not.  Under -ffast-math the bits may depend on n, denormal numbers count as zero, and a stored time still returns
      its sample; statuses and NaN tests are not affected.

   THREADS

      Functions on different objects may run at once, and so may those with a const handle on the same object.

   LICENSE

      MIT; full text and version history at the end of the file. */

#ifndef WF_H_INCLUDED
#define WF_H_INCLUDED
#define WF_VERSION 100 /* 10000*major + 100*minor + patch */

#include <stddef.h>

#ifndef WF_API
#  ifndef WF_STATIC
#    define WF_API extern
#  elif defined(__GNUC__)
#    define WF_API static __attribute__((unused))
#  else
#    define WF_API static
#  endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Status: 0 done; > 0 done, with a remark; < 0 nothing done, nothing touched.  The numbers of statuses never change:
   hosts in other languages carry them by value, and new ones are added at the end. */
enum {
    WF_OK = 0,
    WF_EXTRAP = 101,  /* a time lies outside the stored ones: the end polynomial is continued */
    WF_NOISY = 102,   /* noise of the samples is amplified more than a hundredfold: lower the degree (wf_lower).  wf_fit
                         and wf_resample judge it by a bound, to within 2^degree */
    WF_LOWER = 103,   /* wf_lower, wf_predict, wf_error: a lower degree than asked for was used */
    WF_EARG = -101,   /* an argument is NULL, NaN or out of range, or output overlaps input */
    WF_EMEM = -102,   /* memory too small or not aligned for a double */
    WF_EORDER = -103, /* times do not increase */
    WF_EFULL = -104,  /* no column left: make the grid with more */
    WF_EFEW = -105,   /* too few samples */
    WF_ERANGE = -106, /* a weight overflows: the times are too close or too far apart for this */
    WF_ELONG = -107,  /* more columns than this call keeps on the stack: see LIMITATIONS */
    WF_EEXTRAP = -108, /* WF_STRICT: a time lies outside the stored ones */
    WF_ENOISY = -109   /* WF_STRICT: noise of the samples is amplified too much */
};

/* Settings of a grid; they stay until they are set anew. */
enum {
    WF_STRICT = 0 /* 1: what is WF_EXTRAP or WF_NOISY otherwise is an error, and nothing is written.  Set it where a
                     window is iterated: a partner that reads times nobody has written is then found.  Default 0 */
};

enum { WF_MAX_DEGREE = 15 };

typedef struct wf wf; /* holds no pointers: memcpy of its block is a checkpoint */

/* ---- the grid of a window ---------------------------------------------------------------------------------------- */

/* Bytes for a grid of at most `capacity` columns: history + 1 + sub-steps, twice that with derivatives; about
   16 (degree + 2) bytes each.  0: bad arguments. */
WF_API size_t wf_size(int degree, int capacity);

/* An empty grid in mem[0..bytes-1]; mem must be aligned for a double and outlive *w.  There is no destroy.  memcpy of
   the block is a checkpoint.  WF_EARG, WF_EMEM. */
WF_API int wf_make(wf **w, int degree, int capacity, void *mem, size_t bytes);

/* Change or read a setting.  WF_EARG: unknown key, or the value is out of range; wf_get returns NaN. */
WF_API int wf_set(wf *w, int key, double value);
WF_API double wf_get(const wf *w, int key);

/* Append time t.  Returns the column to write the sample into, or a negative status.  A time equal, up to round-off,
   to a stored one returns the column of that one, to be overwritten; if it has a derivative, write that anew, too.
   WF_EARG, WF_EORDER, WF_EFULL, WF_ERANGE: a stored step would vanish beside the new span. */
WF_API int wf_push(wf *w, double t);

/* As wf_push for a sample and its time derivative, which goes into the next column.  Keeps the order where a window
   has one or two sub-steps.  WF_EARG below degree 2; WF_EORDER if t is stored without derivative and not last. */
WF_API int wf_push_hermite(wf *w, double t);

/* Open a window: roll back, push t[0..count-1] and fill their columns of x with a first guess from the columns up to
   the window start: that of wf_predict for this degree.  They are the columns wf_start()+1 .. wf_columns()-1, one for
   each time.  wf_begin_hermite: two for each time, value and time derivative.  On failure the grid is rolled back and
   x untouched.  WF_LOWER, WF_EARG, WF_EORDER, WF_EFULL, WF_EFEW: push the start first; WF_ERANGE. */
WF_API int wf_begin(wf *w, int count, const double *t, int degree, ptrdiff_t n, double *x, ptrdiff_t ldx);
WF_API int wf_begin_hermite(wf *w, int count, const double *t, int degree, ptrdiff_t n, double *x, ptrdiff_t ldx);

/* Back to the window start: forget every later column.  WF_EFEW: there is none. */
WF_API int wf_rollback(wf *w);

/* Next window: the last sample becomes the start, up to `history` older samples stay in front of it and keep the
   order of the spline.  The columns of x move down with their times; for further arrays on the same grid, column j
   comes from j + (wf_columns() before - wf_columns() after).  WF_EARG, WF_EFEW. */
WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx);

/* Map the times affinely, so that the window [wf_start .. last column] becomes [start, end].  Derivatives in your array
   are yours to multiply by old length / new length.  WF_EARG, WF_EFEW, WF_ERANGE, WF_EORDER: times fall together. */
WF_API int wf_move(wf *w, double start, double end);

/* Lower the working degree until wf_quality's noise is at most `limit` (say 100).  Call it after the last push of the
   window and before wf_fit: a new time, wf_rollback, wf_advance and wf_move raise the degree again.  WF_LOWER: it was
   lowered; WF_NOISY: even the lowest degree is above the limit; WF_EARG, WF_EFEW, WF_ELONG. */
WF_API int wf_lower(wf *w, double limit);

WF_API int wf_columns(const wf *w); /* columns in use */
WF_API int wf_degree(const wf *w);  /* working degree, min(degree, columns - 1) or lower; 0 for a single time */
WF_API int wf_start(const wf *w);   /* column of the window start; older columns are history */
WF_API double wf_time(const wf *w, int column); /* NaN if there is no such column */

/* Chebyshev-Lobatto times, t[0] = a .. t[count-1] = b, count >= 2: where to sample a window that is one polynomial.
   WF_EARG, WF_EORDER: b <= a, or times that fall together. */
WF_API int wf_lobatto(double a, double b, int count, double *t);

/* ---- from samples ------------------------------------------------------------------------------------------------ */

/* weight[0 .. wf_columns()-1]: d^deriv s / dt^deriv (t) = sum_j weight[j] x_j.  A stored time gets one weight 1.
   With more than 4096 columns WF_ERANGE leaves weight undefined.  WF_EXTRAP, WF_NOISY, WF_EARG, WF_EFEW, WF_ERANGE. */
WF_API int wf_weights(const wf *w, double t, int deriv, double *weight);

/* out[0..n-1] = that sum; out outside x.  A stored time (this very double, and what is within round-off of the two
   ends) returns its sample bit for bit, even if others are NaN.  As wf_weights; WF_ELONG. */
WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out);

/* y_k = sum_j weight[k*columns + j] x_j for k < count, in one sweep; columns with weight 0 are not read.  y may be x
   with ldy == ldx, if columns <= 4096.  WF_EARG, WF_ERANGE: a weight is not finite; WF_ELONG. */
WF_API int wf_combine(int count, int columns, const double *weight, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                      double *y, ptrdiff_t ldy);

/* Samples x on the grid `from` to samples y on `to`; y may be x with ldy == ldx.  Exact for polynomials of the
   degree; a time that both grids hold keeps its sample bit for bit.  WF_EXTRAP, WF_NOISY, WF_EARG, WF_EFEW, WF_ERANGE,
   WF_ELONG. */
WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *y,
                       ptrdiff_t ldy);

/* weight, wf_columns(to) rows of wf_columns(from): the samples on `to` of the spline that is nearest to the one on
   `from` in the least-squares sense over the interval of `to`.  Use it to go to fewer columns without aliasing: the
   integral is kept to round-off, the end values are not.  Apply it with wf_combine.  `to` has degree >= 1 and no
   derivatives.  work: wf_columns(to) * (wf_degree(to) + 1).  WF_EXTRAP, WF_EARG, WF_EFEW; WF_ERANGE leaves
   weight undefined. */
WF_API int wf_project(const wf *from, const wf *to, double *weight, double *work);

/* weight[0 .. wf_columns()-1]: the value at t, usually in the next window, of a polynomial.  Degree 0: the last sample.
   1: and the sample nearest to one window length before it.  2: and nearest to two lengths, or, without such history,
   the middle of the window.  Directly after wf_advance the length is that of the window before.  Continuing the spline
   itself is wf_weights.  WF_LOWER: too few samples for this degree; WF_EARG, WF_EFEW, WF_ERANGE. */
WF_API int wf_predict(const wf *w, int degree, double t, double *weight);

/* ---- from coefficients ------------------------------------------------------------------------------------------- */

/* Samples x to coefficients c, wf_columns() columns each; c may be x with ldc == ldx.  WF_NOISY, WF_EARG, WF_EFEW. */
WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c, ptrdiff_t ldc);

/* weight[0 .. wf_degree()]: d^deriv s / dt^deriv (t) = sum_i weight[i] c_{first+i}.  Above the degree all are 0.
   WF_EXTRAP, WF_EARG, WF_EFEW, WF_ERANGE. */
WF_API int wf_basis(const wf *w, double t, int deriv, int *first, double *weight);

/* out[0..n-1] = that sum, with deriv 0 at an end of the grid the sample bit for bit; c: coefficients from wf_fit, not
   samples; out outside c.  Statuses of wf_basis. */
WF_API int wf_eval(const wf *w, double t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out);

/* out + k*ldout = the same at t[k], k < count, with c read once for every 32 times; out outside c and t. */
WF_API int wf_eval_many(const wf *w, int count, const double *t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                        double *out, ptrdiff_t ldout);

/* out[0..n-1] = integral of s from a to b, and the same divided by b - a (s(a) if a == b).  Any a, b; c: coefficients.
   WF_EXTRAP, WF_EARG, WF_EFEW, WF_ERANGE, WF_ELONG. */
WF_API int wf_integral(const wf *w, double a, double b, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out);
WF_API int wf_mean(const wf *w, double a, double b, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out);

/* weight[0 .. wf_columns()-1]: the mean is sum_i weight[i] c_i; the integral is (b - a) times the mean. */
WF_API int wf_mean_weights(const wf *w, double a, double b, double *weight);

/* Turn a row of weights on coefficients into the row on samples: weight := A^-T weight.  With more than 4096 columns
   WF_ERANGE leaves weight undefined.  WF_EARG, WF_EFEW, WF_ERANGE. */
WF_API int wf_on_samples(const wf *w, double *weight);

/* ---- how good is it? --------------------------------------------------------------------------------------------- */

/* out[0..n-1] = estimate of max |f - s| over the window, from the samples x.  Needs degree + 2 columns; with fewer it
   estimates the error of one degree less and says WF_LOWER.  WF_EARG, WF_EFEW, WF_ERANGE, WF_ELONG. */
WF_API int wf_error(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out);

/* The row behind it: f(t) - s(t) is about sum_j weight[j] x_j.  WF_EXTRAP and those of wf_error. */
WF_API int wf_error_weights(const wf *w, double t, double *weight);

/* ratio = longest step / shortest step; noise = Lebesgue constant, DBL_MAX where it overflows (each may be NULL).
   WF_NOISY: it is above 100; WF_EARG, WF_EFEW, WF_ELONG. */
WF_API int wf_quality(const wf *w, double *ratio, double *noise);

/* out[0..n-1]: how far the spline leaves the range of all samples, in multiples of that range, at three points of every
   sub-step; NaN where it is not finite.  x samples, c coefficients.  Above 0.3 or so the degree is too high for these
   data.  WF_EARG, WF_EFEW. */
WF_API int wf_overshoot(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, const double *c, ptrdiff_t ldc,
                        double *out);

/* 1 if x[0..n-1] holds neither NaN nor Inf, else 0; works under -ffast-math. */
WF_API int wf_finite(ptrdiff_t n, const double *x);

WF_API int wf_version(void);               /* of the implementation linked in */
WF_API const char *wf_message(int status); /* one clear sentence, never NULL */

#ifdef __cplusplus
}
#endif
#elif WF_VERSION != 100
#error "two different versions of waveform.h in one translation unit"
#endif /* WF_H_INCLUDED */

#if defined(WF_IMPLEMENTATION) && !defined(WF_IMPLEMENTATION_INCLUDED)
#define WF_IMPLEMENTATION_INCLUDED

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__) || defined(_MSC_VER)
#  define WF__RESTRICT __restrict
#else
#  define WF__RESTRICT
#endif

#define WF__STACK 4096  /* doubles a call may keep on the stack */
#define WF__TERMS 8     /* columns in one fused sweep */
#define WF__ROWS  1024  /* rows of a result that stay in the first level of cache */
#define WF__BLOCK 16384 /* doubles of a working set that stay in the second level */
#define WF__BATCH 32    /* times evaluated in one sweep */
#define WF__ORDER (WF_MAX_DEGREE + 1)
#define WF__NOISE 100   /* Lebesgue constant above which a call says WF_NOISY */
/* So that no count of bytes overflows a size_t, and no count of numbers an int. */
#define WF__CAPACITY (int)(SIZE_MAX / 512 < INT_MAX / WF__ORDER ? SIZE_MAX / 512 : INT_MAX / WF__ORDER)

struct wf {
    int degree, capacity; /* as asked for */
    int columns, start;   /* in use; column of the window start */
    int p, slopes;        /* working degree; number of derivative columns */
    int exponent, strict; /* s = (t - origin) 2^-exponent, exact; the span of s is in [1, 2) if |exponent| < 1000.
                             strict: remarks that are errors, WF_STRICT */
    double origin, down;  /* 2^-exponent */
    double step;          /* the last increase of the time: what is round-off is judged against it */
    double length;        /* of the window before this one */
};

/* ---- memory: behind the struct times t, scaled times s, alternating solution z, knots u, factors of A ------------ */

/* Diagonals of the collocation matrix to each side of the main one. */
static int wf__band(const wf *w)
{
    return w->p > 1 ? w->p - 1 : 0;
}

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

/* L^-1 (1, -1, 1, ..): the inverse of the collocation matrix is a checkerboard of signs, so its norm is that of A^-1
   on this. */
static double *wf__z(const wf *w)
{
    return wf__s(w) + w->capacity;
}

static double *wf__u(const wf *w)
{
    return wf__z(w) + w->capacity;
}

/* Row r of the factors: lu[b + k - r] is entry (r, k), |k - r| <= b = max(p - 1, 0). */
static double *wf__lu(const wf *w, int r)
{
    return wf__u(w) + w->capacity + w->degree + 1 + (size_t)r * (size_t)wf__width(w->degree);
}

WF_API size_t wf_size(int degree, int capacity)
{
    if (degree < 0 || degree > WF_MAX_DEGREE || capacity < 1 || capacity > WF__CAPACITY) return 0;
    return sizeof(wf) + ((size_t)capacity * (size_t)(4 + wf__width(degree)) + (size_t)degree + 1) * sizeof(double);
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
    (*w)->down = 1;
    return WF_OK;
}

/* ---- scalars ----------------------------------------------------------------------------------------------------- */

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

static double wf__ulp(double v)
{
    int e;
    (void)frexp(v, &e);
    return ldexp(1.0, e - 53 < -1074 ? -1074 : e - 53);
}

/* Times closer than this are one instant: four ulp, or an ulp for every sub-step that the host may have added up, but
   then no more than a thousandth of a step: at t = 1e9 steps of 1e-6 are 8 ulp long and stay distinct. */
static double wf__tolerance(const wf *w, double t)
{
    const double *T = wf__t(w);
    double big = fabs(t), ulp, grown;
    if (big < fabs(T[0])) big = fabs(T[0]);
    if (big < fabs(T[w->columns - 1])) big = fabs(T[w->columns - 1]);
    ulp = wf__ulp(big);
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
   the knot span (u_k, u_k+1] of s; outside the knots the end spans are continued.  deriv <= p.  A derivative by s is
   multiplied by down^deriv.  Returns first. */
static int wf__splines(const wf *w, double s, int deriv, double down, double *N)
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
    if (deriv == 0 && p > 0 &&
        ((k == p && !(s < u[p] || s > u[p])) || (k == w->columns - 1 && !(s < u[k + 1] || s > u[k + 1])))) {
        for (j = 0; j <= p; j++) N[j] = 0; /* an end: its sample, to the bit, under -ffast-math, too */
        N[k == p && !(s > u[p]) ? 0 : p] = 1;
        return k - p;
    }
    N[0] = 1;
    for (j = 1; j <= q; j++) { /* Cox - de Boor up to degree q */
        double carry = 0;
        for (r = 0; r < j; r++) {
            double right = u[k + 1 + r], left = u[k + 1 + r - j], old = N[r];
            N[r] = carry + (right - s) / (right - left) * old;
            carry = (s - left) / (right - left) * old;
        }
        N[j] = carry;
    }
    for (j = q + 1; j <= p; j++) { /* each differentiation raises the degree by one: N' = j (N_i / du - N_i+1 / du) */
        double carry = 0;
        for (r = 0; r < j; r++) {
            double share = j * N[r] / (u[k + 1 + r] - u[k + 1 + r - j]) * down;
            N[r] = carry - share;
            carry = share;
        }
        N[j] = carry;
    }
    return k - p;
}

/* ---- the collocation matrix -------------------------------------------------------------------------------------- */

/* Row r of the matrix belongs to column r of the data, but at the last time the derivative's row comes first:
   otherwise the factorisation would meet a zero pivot there. */
static int wf__column(const wf *w, int r)
{
    int m = w->columns;
    return r >= m - 2 && w->p > 1 && wf__is_slope(w, m - 1) ? 2 * m - 3 - r : r;
}

/* LU without pivoting, row by row.  The matrix is totally positive, so nothing grows (de Boor & Pinkus 1977).
   Returns 0 when a pivot has underflowed. */
static int wf__factor(wf *w, int from)
{
    int b = wf__band(w), r, i, k, first, slope;
    double N[WF__ORDER], *z = wf__z(w);
    for (r = from; r < w->columns; r++) {
        double *a = wf__lu(w, r);
        int c = wf__column(w, r);
        slope = wf__is_slope(w, c);
        first = wf__splines(w, wf__s(w)[c], slope, 1, N);
        for (i = 0; i <= 2 * b; i++) a[i] = 0;
        for (i = 0; i <= w->p; i++)
            if (first + i >= r - b && first + i <= r + b) a[b + first + i - r] = N[i];
        if (w->p < 2) a[b] = 1;
        z[r] = (r % 2 == 0) == (c >= r) ? 1 : -1; /* the derivative at the last time enters with the other sign */
        for (k = r > b ? r - b : 0; k < r; k++) {
            const double *pivot = wf__lu(w, k);
            double l = a[b + k - r];
            if (!(fabs(l) > 0)) continue;
            l = a[b + k - r] /= pivot[b];
            for (i = 1; i <= b; i++) a[b + k - r + i] -= l * pivot[b + i];
            z[r] -= l * z[k];
        }
        if (!(fabs(a[b]) > 0)) return 0;
    }
    return 1;
}

/* Exponent of the largest power of two that is at most span, within 1000 so that 2^e and 2^-e are normal numbers. */
static int wf__exponent(double span)
{
    int e = 1;
    if (span > 0) (void)frexp(span, &e);
    e--;
    return e > 1000 ? 1000 : e < -1000 ? -1000 : e;
}

/* Everything that follows from the times, when the first `keep` of them are as they were.  A change of columns
   changes only the last few knots and rows. */
static void wf__build(wf *w, int keep, int degree)
{
    const double *T = wf__t(w);
    double *s = wf__s(w), *u = wf__u(w), origin, span, sum;
    int m = w->columns, i, j, e, p = m > degree ? degree : m - 1, p_min, ok;
    span = T[m - 1] - T[0];
    if (!(span > 0)) p = 0;
    e = wf__exponent(span);
    /* Subtracting the first time is exact where all times are within a factor of two of each other, and no gain
       elsewhere. */
    origin = fabs(T[0]) / 2 > span || fabs(T[m - 1]) / 2 > span ? T[0] : 0;
    if (e != w->exponent || p != w->p || origin < w->origin || origin > w->origin) keep = 0;
    w->exponent = e;
    w->origin = origin;
    w->down = ldexp(1.0, -e);
    for (j = keep; j < m; j++) s[j] = (T[j] - origin) * w->down;
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

/* Is the norm of A^-1, which is at most 2^p or so times the Lebesgue constant, too large?  U v = z backwards, keeping
   p of v. */
static int wf__noisy(const wf *w)
{
    double v[WF__ORDER], worst = 0, sum;
    int b = w->p - 1, m = w->columns, r, k;
    for (r = m - 1; b > 0 && r >= 0; r--) {
        const double *a = wf__lu(w, r) + b;
        for (sum = wf__z(w)[r], k = 1; k <= b && r + k < m; k++) sum -= a[k] * v[(r + k) % WF__ORDER];
        v[r % WF__ORDER] = sum /= a[0];
        if (fabs(sum) > worst) worst = fabs(sum);
    }
    return worst > ldexp(WF__NOISE, w->p);
}

static int wf__lebesgue(const wf *w, double *noise);

/* ---- the window -------------------------------------------------------------------------------------------------- */

static int wf__push(wf *w, double t, int slope)
{
    double *T;
    int m, j, e;
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
            wf__build(w, m - 1, w->degree);
            return j;
        }
        if (!(t > T[m - 1])) return WF_EORDER;
        if (!wf__finite(t - T[0])) return WF_ERANGE;
        e = wf__exponent(t - T[0]);
        for (j = 1; e > w->exponent && j < m; j++) /* a step that is nothing beside the new span? */
            if (T[j] > T[j - 1] && T[j] - T[j - 1] < ldexp(1.0, e - 1000)) return WF_ERANGE;
    }
    if (m + 1 + slope > w->capacity) return WF_EFULL;
    if (m > 0) w->step = t - T[m - 1];
    T[m] = t;
    if (slope) T[m + 1] = t;
    w->columns += 1 + slope;
    w->slopes += slope;
    wf__build(w, m, w->degree);
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

WF_API int wf_set(wf *w, int key, double value)
{
    int off = !(value < 0) && !(value > 0) && wf__finite(value);
    int on = !(value < 1) && !(value > 1) && wf__finite(value);
    if (!w || key != WF_STRICT || !(on || off)) return WF_EARG;
    w->strict = on;
    return WF_OK;
}

static double wf__nan(void)
{
    const uint64_t bits = (uint64_t)0x7ff8 << 48;
    double nan;
    memcpy(&nan, &bits, sizeof nan);
    return nan;
}

WF_API double wf_get(const wf *w, int key)
{
    if (!w || key != WF_STRICT) return wf__nan();
    return w->strict;
}

/* The status of a call that ended with a remark. */
static int wf__remark(const wf *w, int status)
{
    if (!w->strict) return status;
    if (status == WF_EXTRAP) return WF_EEXTRAP;
    if (status == WF_NOISY) return WF_ENOISY;
    return status;
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
    wf__build(w, w->columns, w->degree);
    return WF_OK;
}

WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    int first, last, j;
    if (!w || history < 0 || n < 0 || (n > 0 && !x) || ldx < n) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    last = w->columns - 1 - wf__is_slope(w, w->columns - 1);
    if (last > w->start) w->length = wf__t(w)[last] - wf__t(w)[w->start];
    for (first = last; history > 0 && first > 0; history--) first -= 1 + wf__is_slope(w, first - 1);
    if (first > 0) {
        for (j = first; n > 0 && j < w->columns; j++)
            memcpy(x + (ptrdiff_t)(j - first) * ldx, x + (ptrdiff_t)j * ldx, (size_t)n * sizeof(double));
        memmove(wf__t(w), wf__t(w) + first, (size_t)(w->columns - first) * sizeof(double));
    }
    w->columns -= first;
    w->start = last - first;
    wf__count_slopes(w);
    wf__build(w, 0, w->degree);
    return WF_OK;
}

static double wf__moved(double t, const double *from, const double *to)
{
    return t < from[1] ? to[0] + (t - from[0]) * ((to[1] - to[0]) / (from[1] - from[0])) : to[1];
}

WF_API int wf_move(wf *w, double start, double end)
{
    double *T, from[2], to[2], gap, old, moved;
    int m, j;
    if (!w || !wf__finite(start) || !wf__finite(end)) return WF_EARG;
    m = w->columns;
    if (m == 0 || w->start + wf__is_slope(w, m - 1) == m - 1) return WF_EFEW;
    T = wf__t(w);
    from[0] = T[w->start];
    from[1] = T[m - 1];
    to[0] = start;
    to[1] = end;
    old = wf__moved(T[0], from, to);
    if (!wf__finite(end - old)) return WF_ERANGE;
    gap = 4 * wf__ulp(fabs(old) > fabs(end) ? old : end);
    for (j = 1; j < m; j++, old = moved) {
        moved = wf__moved(T[j], from, to);
        if (T[j] > T[j - 1] && !(moved - old > gap)) return WF_EORDER;
    }
    for (j = 0; j < m; j++) T[j] = wf__moved(T[j], from, to);
    w->step = 0;
    w->length *= (to[1] - to[0]) / (from[1] - from[0]);
    wf__build(w, 0, w->degree);
    return WF_OK;
}

WF_API int wf_lower(wf *w, double limit)
{
    double noise = 0;
    int status, lowest, degree;
    if (!w || !wf__finite(limit)) return WF_EARG;
    degree = w->p;
    lowest = w->slopes ? 2 : 1;
    for (;;) {
        status = wf__lebesgue(w, &noise);
        if (status < 0) return status;
        if (noise <= limit) return w->p < degree ? WF_LOWER : WF_OK;
        if (w->p <= lowest) return WF_NOISY;
        wf__build(w, 0, w->p - 1);
    }
}

WF_API int wf_lobatto(double a, double b, int count, double *t)
{
    const double pi = 3.14159265358979323846;
    double shortest;
    int j;
    if (!wf__finite(a) || !wf__finite(b) || !wf__finite(b - a) || count < 2 || !t) return WF_EARG;
    shortest = (b - a) * sin(pi / (2.0 * (count - 1))) * sin(pi / (2.0 * (count - 1)));
    if (!(shortest > 4 * wf__ulp(fabs(a) > fabs(b) ? a : b))) return WF_EORDER;
    for (j = 1; j < count - 1; j++)
        t[j] = a + (b - a) * (0.5 + 0.5 * sin(pi * (2 * j - (count - 1)) / (2.0 * (count - 1))));
    t[0] = a;
    t[count - 1] = b;
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
    return w && column >= 0 && column < w->columns ? wf__t(w)[column] : wf__nan();
}

/* ---- long sweeps ------------------------------------------------------------------------------------------------- */

/* clang-format off */
/* At -O2 gcc vectorises only inner loops of known length; other compilers prefer the plain loop. */
#if !defined(__GNUC__) || defined(__clang__)
#  define WF__LANES 1
#elif defined(__AVX__)
#  define WF__LANES 4
#else
#  define WF__LANES 2
#endif

#define WF__LOOP(expression)                                                                                           \
    do {                                                                                                               \
        for (i = 0; i + WF__LANES <= n; i += WF__LANES)                                                                \
            for (k = 0; k < WF__LANES; k++) o[i + k] = expression;                                                     \
        for (k = 0; i < n; i++) o[i + k] = expression;                                                                 \
    } while (0)

#define WF__T1 w0 * p0[i + k]
#define WF__T2 WF__T1 + w1 * p1[i + k]
#define WF__T3 WF__T2 + w2 * p2[i + k]
#define WF__T4 WF__T3 + w3 * p3[i + k]
#define WF__T5 WF__T4 + w4 * p4[i + k]
#define WF__T6 WF__T5 + w5 * p5[i + k]
#define WF__T7 WF__T6 + w6 * p6[i + k]
#define WF__T8 WF__T7 + w7 * p7[i + k]
/* p[0] and g[0] are read even with no term; a pointer that might come from o would end the vectorising. */
#define WF__POINTER(j) const double *WF__RESTRICT p##j = p[j < terms ? j : 0]
#define WF__WEIGHT(j) w##j = g[j < terms ? j : 0]

/* fresh: o = g_0 p_0 + .. (1 to 8 terms); else o = f (o + g_0 p_0 + ..) (0 to 8 terms).  None of the p overlaps o. */
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
    case 1: WF__LOOP(WF__T1); break;
    case 2: WF__LOOP(WF__T2); break;
    case 3: WF__LOOP(WF__T3); break;
    case 4: WF__LOOP(WF__T4); break;
    case 5: WF__LOOP(WF__T5); break;
    case 6: WF__LOOP(WF__T6); break;
    case 7: WF__LOOP(WF__T7); break;
    case 8: WF__LOOP(WF__T8); break;
    case 0: WF__LOOP(f * o[i + k]); break;
    case -1: WF__LOOP(f * (o[i + k] + (WF__T1))); break;
    case -2: WF__LOOP(f * (o[i + k] + (WF__T2))); break;
    case -3: WF__LOOP(f * (o[i + k] + (WF__T3))); break;
    case -4: WF__LOOP(f * (o[i + k] + (WF__T4))); break;
    case -5: WF__LOOP(f * (o[i + k] + (WF__T5))); break;
    case -6: WF__LOOP(f * (o[i + k] + (WF__T6))); break;
    case -7: WF__LOOP(f * (o[i + k] + (WF__T7))); break;
    default: WF__LOOP(f * (o[i + k] + (WF__T8))); /* -8 */
    }
}

/* clang-format on */

/* out = sum of weight[j] * column j.  Zero weights are skipped, so a NaN there does no harm.  The sum is scaled by
   the power of two above sum |weight|: it overflows only if the result does.  The sum itself is taken in units of 2^30,
   for the same reason. */
static void wf__combine(ptrdiff_t n, int columns, const double *weight, const double *x, ptrdiff_t ldx, double *out)
{
    const double *p[WF__TERMS];
    double g[WF__TERMS], size = 0, up = 1, down = 1;
    ptrdiff_t i, rows;
    int j, terms, fresh, e;
    for (j = 0; j < columns; j++) size += fabs(weight[j]) / 1073741824;
    if (size > 1.000001 / 1073741824) {
        (void)frexp(size, &e);
        e = e > 992 ? 1022 : e + 30;
        up = ldexp(1.0, e);
        down = ldexp(1.0, -e);
    }
    for (i = 0; i < n; i += rows) {
        rows = (columns <= WF__TERMS && !(up > 1)) || n - i < WF__ROWS ? n - i : WF__ROWS;
        for (fresh = 1, terms = 0, j = 0; j < columns; j++) {
            if (!(fabs(weight[j]) > 0)) continue;
            p[terms] = x + (ptrdiff_t)j * ldx + i;
            g[terms++] = weight[j] * down;
            if (terms < WF__TERMS) continue;
            wf__sweep(rows, fresh, 1, terms, p, g, out + i);
            fresh = terms = 0;
        }
        if (terms) wf__sweep(rows, fresh, 1, terms, p, g, out + i);
        else if (fresh) memset(out + i, 0, (size_t)rows * sizeof(double));
        if (up > 1) wf__sweep(rows, 0, up, 0, p, g, out + i);
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

/* ---- evaluation -------------------------------------------------------------------------------------------------- */

/* The scaled time of t; within round-off of an end it is the end.  Where the deriv-th derivative jumps at knots, a
   time just after a stored one is that one, so that the limit from the left is meant even if the host adds up its
   times otherwise. */
static int wf__scale(const wf *w, double t, int deriv, double *s)
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
    } else if (deriv >= w->p) {
        int j = wf__lower_bound(w, t);
        if (j > 0 && t - T[j - 1] <= wf__tolerance(w, t) && t - T[j - 1] < (T[j] - T[j - 1]) / 4) t = T[j - 1];
    }
    *s = (t - w->origin) * w->down;
    return wf__finite(*s) ? wf__remark(w, status) : WF_ERANGE;
}

static int wf__basis(const wf *w, double t, int deriv, int *first, double *N)
{
    double s = 0;
    int status = wf__scale(w, t, deriv, &s), i;
    if (status < 0) return status;
    if (deriv > w->p) {
        for (i = 0; i <= w->p; i++) N[i] = 0;
        *first = 0;
        return status;
    }
    *first = wf__splines(w, s, deriv, w->down, N);
    return wf__all_finite(w->p + 1, N) ? status : WF_ERANGE;
}

/* Weights on the samples from weights on the coefficients: weight := A^-T weight, A = L U. */
static void wf__transpose_solve(const wf *w, int first, double *weight)
{
    int m = w->columns, b = wf__band(w), r, k;
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

static int wf__weights(const wf *w, double t, int deriv, double *weight)
{
    double s = 0, size = 0, N[WF__ORDER];
    int status, first, j;
    status = wf__basis(w, t, deriv, &first, N);
    if (status < 0) return status;
    wf__scale(w, t, deriv, &s);
    for (j = 0; j < w->columns; j++) weight[j] = 0;
    j = wf__stored(w, t, s, deriv);
    if (j >= 0) weight[j] = 1;
    if (j >= 0 || deriv > w->p) return status;
    for (j = 0; j <= w->p; j++) weight[first + j] = N[j];
    wf__transpose_solve(w, first, weight);
    if (!wf__all_finite(w->columns, weight)) return WF_ERANGE;
    for (j = 0; j < w->columns; j++) size += wf__is_slope(w, j) ? 0 : fabs(weight[j]);
    return status == WF_OK && deriv == 0 && size > WF__NOISE ? wf__remark(w, WF_NOISY) : status;
}

WF_API int wf_weights(const wf *w, double t, int deriv, double *weight)
{
    double buffer[WF__STACK], *row = buffer;
    int status;
    if (!w || deriv < 0 || !weight) return WF_EARG;
    if (w->columns > WF__STACK) row = weight;
    status = wf__weights(w, t, deriv, row);
    if (status >= 0 && row == buffer) memcpy(weight, buffer, (size_t)w->columns * sizeof(double));
    return status;
}

WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    double weight[WF__STACK];
    int status;
    if (!w || deriv < 0 || n < 0 || (n > 0 && (!x || !out)) || ldx < n) return WF_EARG;
    if (wf__overlap(n, w->columns, x, ldx, 1, out, n)) return WF_EARG;
    if (w->columns > WF__STACK) return w->p < 2 ? wf_eval(w, t, deriv, n, x, ldx, out) : WF_ELONG;
    status = wf__weights(w, t, deriv, weight);
    if (status >= 0) wf__combine(n, w->columns, weight, x, ldx, out);
    return status;
}

WF_API int wf_combine(int count, int columns, const double *weight, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                      double *y, ptrdiff_t ldy)
{
    double buffer[WF__STACK];
    ptrdiff_t i, rows;
    int j, inplace;
    if (count < 0 || columns < 1 || (count > 0 && !weight) || n < 0 || ldx < n || ldy < n) return WF_EARG;
    if (n > 0 && count > 0 && (!x || !y)) return WF_EARG;
    inplace = x == y && ldx == ldy;
    if (!inplace && wf__overlap(n, columns, x, ldx, count, y, ldy)) return WF_EARG;
    if (inplace && columns > WF__STACK) return WF_ELONG;
    for (j = 0; j < count; j++)
        if (!wf__all_finite(columns, weight + (ptrdiff_t)j * columns)) return WF_ERANGE;
    for (i = 0; i < n && count > 0; i += rows) {
        const double *from = x + i;
        ptrdiff_t ld = ldx;
        rows = inplace ? WF__STACK / columns : count > 1 ? WF__BLOCK / columns : n;
        if (rows < 64 && !inplace) rows = 64;
        if (rows > n - i) rows = n - i;
        if (inplace) {
            for (j = 0; j < columns; j++)
                memcpy(buffer + j * rows, x + (ptrdiff_t)j * ldx + i, (size_t)rows * sizeof(double));
            from = buffer;
            ld = rows;
        }
        for (j = 0; j < count; j++)
            wf__combine(rows, columns, weight + (ptrdiff_t)j * columns, from, ld, y + (ptrdiff_t)j * ldy + i);
    }
    return WF_OK;
}

/* Row r of a triangular sweep: c_r = own * (src - scale * sum over k = from .. to - 1 of a_rk c_k), in this order,
   because own * src alone may overflow.  src may be c_r. */
static void wf__row(const wf *w, int r, int from, int to, double scale, double own, ptrdiff_t n, const double *src,
                    double *c, ptrdiff_t ldc)
{
    const double *p[WF__ORDER + 1], *a = wf__lu(w, r);
    double g[WF__ORDER + 1], *dst = c + (ptrdiff_t)r * ldc;
    int fresh = src != dst, terms = 0, done = 0, take, k, b = wf__band(w);
    p[0] = src;
    g[0] = 1;
    if (fresh) terms = 1;
    for (k = from; k < to; k++)
        if (fabs(a[b + k - r]) > 0) {
            p[terms] = c + (ptrdiff_t)k * ldc;
            g[terms++] = -a[b + k - r] * scale;
        }
    do {
        take = terms - done < WF__TERMS ? terms - done : WF__TERMS;
        if (take > 0) wf__sweep(n, fresh, !fresh && done + take == terms ? own : 1, take, p + done, g + done, dst);
        done += take;
        if (done == terms && (fresh || take == 0) && (own < 1 || own > 1)) wf__sweep(n, 0, own, 0, p, g, dst);
        fresh = 0;
    } while (done < terms);
}

WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c, ptrdiff_t ldc)
{
    ptrdiff_t i, k, rows;
    double unit, v;
    int m, b, r, column, inplace, status;
    if (!w || n < 0 || (n > 0 && (!x || !c)) || ldx < n || ldc < n) return WF_EARG;
    m = w->columns;
    b = wf__band(w);
    inplace = x == c && ldx == ldc;
    if (m == 0) return WF_EFEW;
    if (!inplace && wf__overlap(n, m, x, ldx, m, c, ldc)) return WF_EARG;
    status = wf__noisy(w) ? wf__remark(w, WF_NOISY) : WF_OK;
    if (status < 0) return status;
    unit = ldexp(1.0, w->exponent);
    for (i = 0; i < n; i += rows, c += rows, x += rows) {
        rows = WF__BLOCK / m < 64 ? 64 : WF__BLOCK / m;
        if (rows > n - i) rows = n - i;
        if (inplace && wf__column(w, m - 1) != m - 1)
            for (k = (ptrdiff_t)(m - 2) * ldc; k < (ptrdiff_t)(m - 2) * ldc + rows; k++) {
                v = c[k];
                c[k] = c[k + ldc];
                c[k + ldc] = v;
            }
        for (r = 0; r < m; r++) { /* L */
            column = wf__column(w, r);
            v = b > 0 && wf__is_slope(w, column) ? unit : 1;
            wf__row(w, r, r > b ? r - b : 0, r, 1 / v, v, rows,
                    inplace ? c + (ptrdiff_t)r * ldc : x + (ptrdiff_t)column * ldx, c, ldc);
        }
        for (r = m - 2; b > 0 && r >= 0; r--) { /* U */
            v = 1 / wf__lu(w, r)[b];
            wf__row(w, r, r + 1, r + b < m ? r + b + 1 : m, 1, v, rows, c + (ptrdiff_t)r * ldc, c, ldc);
        }
    }
    return status;
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
    if (status >= 0 && n > 0) wf__combine(n, w->p + 1, N, c + (ptrdiff_t)first * ldc, ldc, out);
    return status;
}

/* What is needed at one time: the stored column that is the answer, or -1, and the basis. */
struct wf__target {
    int stored, first;
    double N[WF__ORDER];
};

static int wf__aim(const wf *w, double t, int deriv, struct wf__target *g)
{
    double s = 0;
    int status = wf__basis(w, t, deriv, &g->first, g->N);
    if (status < 0) return status;
    wf__scale(w, t, deriv, &s);
    g->stored = wf__stored(w, t, s, deriv);
    return status;
}

WF_API int wf_eval_many(const wf *w, int count, const double *t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                        double *out, ptrdiff_t ldout)
{
    struct wf__target g[WF__BATCH];
    int status = WF_OK, one, j, k, batch;
    ptrdiff_t i, rows;
    if (!w || count < 0 || (count > 0 && !t) || deriv < 0 || n < 0 || ldc < n || ldout < n) return WF_EARG;
    if (n > 0 && count > 0 && (!c || !out || wf__overlap(n, w->columns, c, ldc, count, out, ldout))) return WF_EARG;
    if (n > 0 && count > 0 && t < out + (ptrdiff_t)(count - 1) * ldout + n && out < t + count) return WF_EARG;
    for (j = count - 1; j >= 0; j--) { /* downwards: the first batch is left in the table */
        one = wf__aim(w, t[j], deriv, &g[j % WF__BATCH]);
        if (one < 0) return one;
        if (one > 0) status = one;
    }
    for (j = 0; j < count; j += batch) {
        batch = count - j < WF__BATCH ? count - j : WF__BATCH;
        for (k = 0; j > 0 && k < batch; k++) wf__aim(w, t[j + k], deriv, &g[k]);
        for (i = 0; i < n; i += rows) {
            rows = WF__BLOCK / (w->columns + batch) < 64 ? 64 : WF__BLOCK / (w->columns + batch);
            if (rows > n - i) rows = n - i;
            for (k = 0; k < batch; k++)
                wf__combine(rows, w->p + 1, g[k].N, c + (ptrdiff_t)g[k].first * ldc + i, ldc,
                            out + (ptrdiff_t)(j + k) * ldout + i);
        }
    }
    return status;
}

WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *y,
                       ptrdiff_t ldy)
{
    struct wf__target g[WF__BATCH], *at;
    double buffer[WF__STACK], *c, *dst;
    const double *samples;
    ptrdiff_t i, rows, ld;
    int status, one, m, j, inplace, sets, direct;
    if (!from || !to || n < 0 || (n > 0 && (!x || !y)) || ldx < n || ldy < n) return WF_EARG;
    m = from->columns;
    inplace = x == y && ldx == ldy;
    sets = inplace ? 2 : 1;
    if (m == 0) return WF_EFEW;
    if (!inplace && wf__overlap(n, m, x, ldx, to->columns, y, ldy)) return WF_EARG;
    direct = !inplace && from->p < 2; /* the coefficients are the samples */
    if (!direct && m > WF__STACK / sets) return WF_ELONG;
    status = wf__noisy(from) ? wf__remark(from, WF_NOISY) : WF_OK;
    if (status < 0) return status;
    for (j = 0; j < to->columns; j++) {
        one = wf__aim(from, wf__t(to)[j], wf__is_slope(to, j), &g[j % WF__BATCH]);
        if (one < 0) return one;
        if (one > 0) status = one;
    }
    for (i = 0; i < n; i += rows) { /* rows of coefficients, and of samples if they are going to be overwritten */
        rows = direct ? WF__ROWS : WF__STACK / (m * sets);
        if (rows > n - i) rows = n - i;
        c = buffer;
        samples = x + i;
        ld = ldx;
        if (inplace) {
            for (j = 0; j < m; j++)
                memcpy(buffer + j * rows, x + (ptrdiff_t)j * ldx + i, (size_t)rows * sizeof(double));
            c = buffer + m * rows;
            samples = buffer;
            ld = rows;
        }
        if (!direct) wf_fit(from, rows, samples, ld, c, rows);
        for (j = 0; j < to->columns; j++) {
            at = &g[j % WF__BATCH];
            dst = y + (ptrdiff_t)j * ldy + i;
            if (to->columns > WF__BATCH) wf__aim(from, wf__t(to)[j], wf__is_slope(to, j), at);
            if (at->stored >= 0) memcpy(dst, samples + (ptrdiff_t)at->stored * ld, (size_t)rows * sizeof(double));
            else if (direct) wf__combine(rows, from->p + 1, at->N, samples + (ptrdiff_t)at->first * ld, ld, dst);
            else wf__combine(rows, from->p + 1, at->N, c + at->first * rows, rows, dst);
        }
    }
    return status;
}

/* ---- integrals --------------------------------------------------------------------------------------------------- */

/* Gauss-Legendre points and weights on [0, 1], exact for degree 2 count - 1; Newton's method on the Legendre
   polynomial. */
static void wf__gauss(int count, double *point, double *weight)
{
    int i, k, pass;
    for (i = 0; i < count; i++) {
        double x = cos(3.14159265358979323846 * (i + 0.75) / (count + 0.5)), slope = 1;
        for (pass = 0; pass < 6; pass++) {
            double a = 1, b = x;
            for (k = 2; k <= count; k++) {
                double next = ((2 * k - 1) * x * b - (k - 1) * a) / k;
                a = b;
                b = next;
            }
            slope = count * (x * b - a) / (x * x - 1);
            x -= b / slope;
        }
        point[i] = 0.5 + 0.5 * x;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/* The polynomial piece that starts at s ends at the next knot, or at `end` if that comes first. */
static double wf__piece(const wf *w, double s, double end)
{
    const double *u = wf__u(w);
    int low = w->p, high = w->columns + 1, mid;
    while (low < high) {
        mid = low + (high - low) / 2;
        if (u[mid] > s) high = mid;
        else low = mid + 1;
    }
    return low <= w->columns && u[low] < end ? u[low] : end;
}

WF_API int wf_mean_weights(const wf *w, double a, double b, double *weight)
{
    double N[WF__ORDER], point[WF__ORDER], gauss[WF__ORDER], sa = 0, sb = 0, s, next;
    int status, other, count, first, i, j;
    if (!w || !weight) return WF_EARG;
    status = wf__scale(w, a, 0, &sa);
    other = wf__scale(w, b, 0, &sb);
    if (status < 0 || other < 0) return status < 0 ? status : other;
    if (other > 0) status = other;
    /* the weights grow at most like (distance / span)^degree outside the grid: what overflows there is refused
       beforehand */
    other = wf__basis(w, a, 0, &first, N);
    if (other >= 0) other = wf__basis(w, b, 0, &first, N);
    if (other < 0) return other;
    for (i = 0; i < w->columns; i++) weight[i] = 0;
    if (!(sa < sb || sb < sa)) {
        for (i = 0; i <= w->p; i++) weight[first + i] = N[i];
        return status;
    }
    if (sb < sa) {
        s = sa;
        sa = sb;
        sb = s;
    }
    count = w->p / 2 + 1;
    wf__gauss(count, point, gauss);
    for (s = sa; s < sb; s = next) {
        next = wf__piece(w, s, sb);
        for (j = 0; j < count; j++) {
            first = wf__splines(w, s + point[j] * (next - s), 0, 1, N);
            for (i = 0; i <= w->p; i++) weight[first + i] += gauss[j] * ((next - s) / (sb - sa)) * N[i];
        }
    }
    return status;
}

/* out = length * mean */
static int wf__mean(const wf *w, double a, double b, int integral, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                    double *out)
{
    double weight[WF__STACK], sa = 0, sb = 0, length;
    int status, j;
    if (!w || n < 0 || (n > 0 && (!c || !out)) || ldc < n) return WF_EARG;
    if (wf__overlap(n, w->columns, c, ldc, 1, out, n)) return WF_EARG;
    if (w->columns > WF__STACK) return WF_ELONG;
    status = wf_mean_weights(w, a, b, weight);
    if (status < 0) return status;
    wf__scale(w, a, 0, &sa);
    wf__scale(w, b, 0, &sb);
    length = integral ? ldexp(sb - sa, w->exponent) : 1;
    for (j = 0; j < w->columns; j++) weight[j] *= length;
    if (!wf__all_finite(w->columns, weight)) return WF_ERANGE;
    wf__combine(n, w->columns, weight, c, ldc, out);
    return status;
}

WF_API int wf_integral(const wf *w, double a, double b, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out)
{
    return wf__mean(w, a, b, 1, n, c, ldc, out);
}

WF_API int wf_mean(const wf *w, double a, double b, ptrdiff_t n, const double *c, ptrdiff_t ldc, double *out)
{
    return wf__mean(w, a, b, 0, n, c, ldc, out);
}

WF_API int wf_on_samples(const wf *w, double *weight)
{
    double buffer[WF__STACK], *row = buffer;
    if (!w || !weight) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    if (w->columns > WF__STACK) row = weight;
    else memcpy(buffer, weight, (size_t)w->columns * sizeof(double));
    wf__transpose_solve(w, 0, row);
    if (!wf__all_finite(w->columns, row)) return WF_ERANGE;
    if (row == buffer) memcpy(weight, buffer, (size_t)w->columns * sizeof(double));
    return WF_OK;
}

/* ---- projection and prediction ----------------------------------------------------------------------------------- */

/* The scaled time s of `from` in the scaled time of `to`: no offset ever takes part. */
static double wf__rescale(const wf *from, const wf *to, double s)
{
    return ldexp(s, from->exponent - to->exponent) + ldexp(from->origin - to->origin, -to->exponent);
}

/* Add the integrals over [a, b] of to_i to_k to the band G (entry (i, k), k >= i, at i (p+1) + k - i) and of to_i
   from_j to M; a and b are scaled times of `to`. */
static void wf__products(const wf *from, const wf *to, double a, double b, double *G, double *M)
{
    double point[WF__ORDER], gauss[WF__ORDER], N[WF__ORDER], F[WF__ORDER];
    int count = (from->p > to->p ? from->p + to->p : 2 * to->p) / 2 + 1, p = to->p, q, i, k, first, other;
    wf__gauss(count, point, gauss);
    for (q = 0; q < count; q++) {
        double s = a + point[q] * (b - a), g = gauss[q] * (b - a);
        first = wf__splines(to, s, 0, 1, N);
        other = wf__splines(from, wf__rescale(to, from, s), 0, 1, F);
        for (i = 0; i <= p; i++) {
            for (k = i; k <= p; k++) G[(first + i) * (p + 1) + k - i] += g * N[i] * N[k];
            for (k = 0; k <= from->p; k++) M[(ptrdiff_t)(first + i) * from->columns + other + k] += g * N[i] * F[k];
        }
    }
}

WF_API int wf_project(const wf *from, const wf *to, double *weight, double *work)
{
    double a, b, end, knot, last, s = 0, *row;
    int m, mf, p, r, k, j, status, other;
    if (!from || !to || !weight || !work || to->slopes) return WF_EARG;
    m = to->columns;
    mf = from->columns;
    p = to->p;
    if (mf == 0 || p < 1) return WF_EFEW;
    status = wf__scale(from, wf__t(to)[0], 0, &s);
    other = wf__scale(from, wf__t(to)[m - 1], 0, &s);
    if (status < 0 || other < 0) return status < 0 ? status : other;
    if (other > 0) status = other;
    for (j = 0; j < m * (p + 1); j++) work[j] = 0;
    for (r = 0; r < m; r++)
        for (j = 0; j < mf; j++) weight[(ptrdiff_t)r * mf + j] = 0;
    end = wf__s(to)[m - 1];
    for (a = wf__s(to)[0]; a < end; a = b) { /* over the pieces on which both splines are polynomials */
        b = wf__piece(to, a, end);
        last = wf__rescale(to, from, b);
        knot = wf__piece(from, wf__rescale(to, from, a), last);
        if (knot < last) b = wf__rescale(from, to, knot);
        if (!(b > a)) b = nextafter(a, end);
        wf__products(from, to, a, b, work, weight);
    }
    for (r = 0; r < m; r++) { /* weight := G^-1 weight, G = L D L' in place */
        row = weight + (ptrdiff_t)r * mf;
        for (k = 1; k <= p && r + k < m; k++) {
            double l = work[r * (p + 1) + k] / work[r * (p + 1)];
            for (j = k; j <= p && r + j < m; j++) work[(r + k) * (p + 1) + j - k] -= l * work[r * (p + 1) + j];
            for (j = 0; j < mf; j++) row[(ptrdiff_t)k * mf + j] -= l * row[j];
        }
    }
    for (r = m - 1; r >= 0; r--) {
        row = weight + (ptrdiff_t)r * mf;
        for (k = 1; k <= p && r + k < m; k++)
            for (j = 0; j < mf; j++) row[j] -= work[r * (p + 1) + k] * row[(ptrdiff_t)k * mf + j];
        for (j = 0; j < mf; j++) row[j] /= work[r * (p + 1)];
    }
    for (r = 0; r < m; r++) { /* coefficients to samples: weight := L (U weight) */
        row = weight + (ptrdiff_t)r * mf;
        for (j = 0; j < mf; j++) row[j] *= wf__lu(to, r)[p - 1];
        for (k = 1; k < p && r + k < m; k++)
            for (j = 0; j < mf; j++) row[j] += wf__lu(to, r)[p - 1 + k] * row[(ptrdiff_t)k * mf + j];
    }
    for (r = m - 1; r >= 0; r--) {
        row = weight + (ptrdiff_t)r * mf;
        for (k = 1; k < p && r - k >= 0; k++)
            for (j = 0; j < mf; j++) row[j] += wf__lu(to, r)[p - 1 - k] * row[-(ptrdiff_t)k * mf + j];
        wf__transpose_solve(from, 0, row);
        if (!wf__all_finite(mf, row)) status = WF_ERANGE;
    }
    return status;
}

/* The value column nearest to t, which is at most the last time. */
static int wf__nearest(const wf *w, double t)
{
    const double *T = wf__t(w);
    int j = wf__lower_bound(w, t);
    if (j > 0 && t - T[j - 1] < T[j] - t) j--;
    return j - wf__is_slope(w, j);
}

/* A first guess: the polynomial through a few samples, newest first. */
struct wf__guess {
    int count, node[3];
    double value[3]; /* their weights */
};

/* Choose the samples: the last one, and those nearest to one and two window lengths before it. */
static int wf__guess_nodes(const wf *w, int degree, struct wf__guess *g)
{
    const double *T = wf__t(w);
    double length;
    int j;
    g->node[0] = wf__nearest(w, T[w->columns - 1]);
    length = T[g->node[0]] - T[w->start];
    if (!(length > 0)) length = w->length; /* this one is still empty */
    for (g->count = 1; g->count <= degree; g->count++) {
        j = wf__nearest(w, T[g->node[0]] - g->count * length);
        if (g->count == 2 && j == g->node[1]) j = wf__nearest(w, T[g->node[0]] - length / 2);
        if (j == g->node[0] || (g->count == 2 && j == g->node[1])) break;
        g->node[g->count] = j;
    }
    return g->count <= degree ? WF_LOWER : WF_OK;
}

/* Lagrange's polynomials at time t, or their derivatives by the product rule. */
static int wf__guess_weights(const wf *w, double t, int slope, struct wf__guess *g)
{
    const double *T = wf__t(w);
    int i, k;
    for (i = 0; i < g->count; i++) {
        double value = 1, rate = 0;
        for (k = 0; k < g->count; k++) {
            double gap = T[g->node[i]] - T[g->node[k]];
            if (k == i) continue;
            rate = rate * ((t - T[g->node[k]]) / gap) + value / gap;
            value *= (t - T[g->node[k]]) / gap;
        }
        g->value[i] = slope ? rate : value;
    }
    return wf__all_finite(g->count, g->value) ? WF_OK : WF_ERANGE;
}

WF_API int wf_predict(const wf *w, int degree, double t, double *weight)
{
    struct wf__guess g;
    int status, i;
    if (!w || degree < 0 || degree > 2 || !wf__finite(t) || !weight) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    status = wf__guess_nodes(w, degree, &g);
    if (wf__guess_weights(w, t, 0, &g) < 0) return WF_ERANGE;
    for (i = 0; i < w->columns; i++) weight[i] = 0;
    for (i = 0; i < g.count; i++) weight[g.node[i]] = g.value[i];
    return status;
}

static void wf__guess_column(const struct wf__guess *g, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    const double *p[3];
    int i;
    for (i = 0; i < g->count; i++) p[i] = x + (ptrdiff_t)g->node[i] * ldx;
    wf__sweep(n, 1, 1, g->count, p, g->value, out);
}

static int wf__begin(wf *w, int slopes, int count, const double *t, int degree, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    struct wf__guess g;
    int status, column, k;
    if (!w || count < 0 || (count > 0 && !t) || degree < 0 || degree > 2) return WF_EARG;
    if (n < 0 || (n > 0 && !x) || ldx < n) return WF_EARG;
    status = wf_rollback(w);
    if (status < 0) return status;
    status = wf__guess_nodes(w, degree, &g);
    for (k = 0; k < count; k++) {
        int end = w->columns;
        column = wf__push(w, t[k], slopes);
        if (column >= 0 && column < end) column = WF_EORDER; /* a stored time once more */
        if (column >= 0 && wf__guess_weights(w, t[k], 0, &g) < 0) column = WF_ERANGE;
        if (column >= 0) continue;
        wf_rollback(w);
        return column;
    }
    for (k = 0; k < count; k++) {
        column = w->columns - (count - k) * (1 + slopes);
        wf__guess_weights(w, t[k], 0, &g);
        wf__guess_column(&g, n, x, ldx, x + (ptrdiff_t)column * ldx);
        wf__guess_weights(w, t[k], 1, &g);
        if (slopes) wf__guess_column(&g, n, x, ldx, x + (ptrdiff_t)(column + 1) * ldx);
    }
    return status;
}

WF_API int wf_begin(wf *w, int count, const double *t, int degree, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    return wf__begin(w, 0, count, t, degree, n, x, ldx);
}

WF_API int wf_begin_hermite(wf *w, int count, const double *t, int degree, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    return wf__begin(w, 1, count, t, degree, n, x, ldx);
}

/* ---- how good is it? --------------------------------------------------------------------------------------------- */

/* d[0..order]: the divided difference over columns first .. first+order, in scaled times. */
static void wf__difference(const wf *w, int first, int order, double *d)
{
    double D[WF__ORDER + 2][WF__ORDER + 2], gap, unit = ldexp(1.0, w->exponent);
    const double *s = wf__s(w) + first;
    int i, j, k;
    for (i = 0; i <= order; i++)
        for (j = 0; j <= order; j++) D[i][j] = j == i - wf__is_slope(w, first + i);
    for (k = 1; k <= order; k++)
        for (i = 0; i + k <= order; i++) {
            gap = s[i + k] - s[i];
            for (j = 0; j <= order; j++) D[i][j] = gap > 0 ? (D[i + 1][j] - D[i][j]) / gap : j == i + 1 ? unit : 0;
        }
    for (j = 0; j <= order; j++) d[j] = D[0][j];
}

/* What the spline with these weights makes of (t_j - t)^order, in scaled times, with the sign of f - s. */
static double wf__defect(const wf *w, double s, int order, const double *weight)
{
    double sum = 0, power;
    int i, j;
    for (j = 0; j < w->columns; j++) {
        for (power = 1, i = 1; i < order; i++) power *= wf__s(w)[j] - s;
        sum -= weight[j] * power * (wf__is_slope(w, j) ? order * w->down : wf__s(w)[j] - s);
    }
    return sum;
}

/* f(t) - s(t) is about sum_i d[i] x_{first+i}, i <= *order: the polynomial through these columns has the terms a (t_j
   - t)^(p+1) and b (t_j - t)^(p+2), whose defects are known.  With p+1 columns in all it is the difference of s to
   the polynomial without the first of them. */
static int wf__error_row(const wf *w, double t, double *weight, int *start, int *order, double *d)
{
    const double *sites = wf__s(w);
    double s = 0, a, b = 0, shift = 0, lower[WF__ORDER + 2];
    int status = wf__weights(w, t, 0, weight), m = w->columns, p = w->p, first, i;
    if (status < 0) return status;
    if (m < 2) return WF_EFEW;
    wf__scale(w, t, 0, &s);
    *order = m > p + 2 ? p + 2 : m - 1;
    first = wf__lower_bound(w, t) - (*order + 1) / 2;
    if (first > m - 1 - *order) first = m - 1 - *order;
    if (first < 0) first = 0;
    first -= wf__is_slope(w, first); /* no derivative without its value */
    if (m > p + 1) a = wf__defect(w, s, p + 1, weight);
    else
        for (a = 1, i = 1; i < m; i++) a *= s - sites[i];
    if (*order == p + 2) b = wf__defect(w, s, p + 2, weight);
    for (i = 0; i < *order; i++) shift += s - sites[first + i];
    wf__difference(w, first, *order, d);
    wf__difference(w, first, *order - 1, lower);
    for (i = 0; i <= *order; i++)
        d[i] = *order == p + 2 ? (b + a * shift) * d[i] + (i < *order ? a * lower[i] : 0) : a * d[i];
    *start = first;
    if (!wf__all_finite(*order + 1, d)) return WF_ERANGE;
    return status == WF_EXTRAP ? status : m > p + 1 ? WF_OK : WF_LOWER;
}

WF_API int wf_error_weights(const wf *w, double t, double *weight)
{
    double d[WF__ORDER + 2], buffer[WF__STACK];
    int status, first, order, j;
    if (!w || !weight) return WF_EARG;
    if (w->columns > WF__STACK) return WF_ELONG;
    status = wf__error_row(w, t, buffer, &first, &order, d);
    for (j = 0; status >= 0 && j < w->columns; j++) weight[j] = j >= first && j <= first + order ? d[j - first] : 0;
    return status;
}

WF_API int wf_error(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    double weight[WF__STACK], value[WF__ROWS], d[WF__ORDER + 2], best[WF__ORDER + 2], size, most;
    const double *T;
    ptrdiff_t i, k, rows;
    int status = WF_OK, first, order, j, q, pass, from = 0, fresh = 1;
    if (!w || n < 0 || (n > 0 && (!x || !out)) || ldx < n) return WF_EARG;
    if (wf__overlap(n, w->columns, x, ldx, 1, out, n)) return WF_EARG;
    if (w->columns < 2 || !(wf__t(w)[w->columns - 1] > wf__t(w)[w->start])) return WF_EFEW;
    if (w->columns > WF__STACK) return WF_ELONG;
    T = wf__t(w);
    for (pass = 0; pass < 2; pass++) /* look first, then touch */
        for (j = w->start + 1; j < w->columns; j++) {
            if (wf__is_slope(w, j)) continue;
            for (most = -1, q = 1; q < 4; q++) { /* the error of even degrees may vanish in the middle */
                status = wf__error_row(w, T[j - 1] + (T[j] - T[j - 1]) * (0.25 * q), weight, &first, &order, d);
                if (status < 0) return status;
                for (size = 0, k = 0; k <= order; k++) size += fabs(d[k]);
                if (!(size > most)) continue;
                most = size;
                from = first;
                memcpy(best, d, sizeof best);
            }
            for (i = 0; pass == 1 && i < n; i += rows) {
                rows = n - i < WF__ROWS ? n - i : WF__ROWS;
                wf__combine(rows, order + 1, best, x + (ptrdiff_t)from * ldx + i, ldx, value);
                for (k = 0; k < rows; k++) {
                    double v = fabs(value[k]), old = out[i + k];
                    out[i + k] = fresh || v > old || !wf__finite(v) ? v : old;
                }
            }
            fresh = fresh && pass == 0;
        }
    return status;
}

static int wf__lebesgue(const wf *w, double *noise)
{
    double weight[WF__STACK], size;
    const double *T = wf__t(w);
    int j, k, i, status;
    *noise = 1;
    if (w->columns == 0) return WF_EFEW;
    if (w->columns > WF__STACK) return WF_ELONG;
    for (j = 1; w->p > 1 && j < w->columns; j++)
        for (k = 1; k < 6; k++) {
            status = wf__weights(w, T[j - 1] + (T[j] - T[j - 1]) * (k / 6.0), 0, weight);
            if (status < 0 && status != WF_ENOISY) { /* a weight overflows */
                *noise = DBL_MAX;
                return WF_NOISY;
            }
            for (size = 0, i = 0; i < w->columns; i++) size += wf__is_slope(w, i) ? 0 : fabs(weight[i]);
            if (size > *noise) *noise = size;
        }
    return *noise > WF__NOISE ? WF_NOISY : WF_OK;
}

WF_API int wf_quality(const wf *w, double *ratio, double *noise)
{
    double lebesgue, step, longest = 0, shortest = 0;
    int j, status;
    if (!w) return WF_EARG;
    status = wf__lebesgue(w, &lebesgue);
    if (status < 0) return status;
    for (j = 1; j < w->columns; j++) {
        step = wf__s(w)[j] - wf__s(w)[j - 1];
        if (step > longest) longest = step;
        if (step > 0 && !(shortest > 0 && shortest < step)) shortest = step;
    }
    if (ratio) *ratio = shortest > 0 ? longest / shortest : 1;
    if (noise) *noise = lebesgue;
    return status;
}

WF_API int wf_overshoot(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, const double *c, ptrdiff_t ldc,
                        double *out)
{
    double low[WF__ROWS], high[WF__ROWS], v[WF__ROWS];
    ptrdiff_t i, k, rows;
    const double *T, *sample;
    int j, q;
    if (!w || n < 0 || (n > 0 && (!x || !c || !out)) || ldx < n || ldc < n) return WF_EARG;
    if (wf__overlap(n, w->columns, x, ldx, 1, out, n) || wf__overlap(n, w->columns, c, ldc, 1, out, n)) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    T = wf__t(w);
    for (i = 0; i < n; i += rows) {
        rows = n - i < WF__ROWS ? n - i : WF__ROWS;
        for (j = 0; j < w->columns; j++) {
            if (wf__is_slope(w, j)) continue;
            sample = x + (ptrdiff_t)j * ldx + i;
            for (k = 0; k < rows; k++) {
                if (j == 0 || sample[k] < low[k]) low[k] = sample[k];
                if (j == 0 || sample[k] > high[k]) high[k] = sample[k];
            }
        }
        for (k = 0; k < rows; k++) out[i + k] = 0;
        for (j = 1; j < w->columns; j++)
            for (q = 1; q < 4 && T[j] > T[j - 1]; q++) {
                wf_eval(w, T[j - 1] + (T[j] - T[j - 1]) * (0.25 * q), 0, rows, c + i, ldc, v);
                for (k = 0; k < rows; k++) {
                    double range = high[k] / 2 - low[k] / 2;
                    double over = v[k] > high[k] ? v[k] / 2 - high[k] / 2 : low[k] / 2 - v[k] / 2;
                    if (!wf__finite(v[k])) out[i + k] = wf_time(NULL, 0); /* NaN */
                    else if (range > 0 && over > range * out[i + k]) out[i + k] = over / range;
                }
            }
    }
    return WF_OK;
}

WF_API int wf_finite(ptrdiff_t n, const double *x)
{
    ptrdiff_t i;
    if (n > 0 && !x) return 0;
    for (i = 0; i < n; i++)
        if (!wf__finite(x[i])) return 0;
    return 1;
}

/* ---- messages ---------------------------------------------------------------------------------------------------- */

WF_API int wf_version(void)
{
    return WF_VERSION;
}

WF_API const char *wf_message(int status)
{
    switch (status) {
    case WF_OK:
        return "ok";
    case WF_EXTRAP:
        return "a time lies outside the stored times: the end polynomial was continued";
    case WF_NOISY:
        return "noise of the samples is amplified more than a hundredfold: lower the degree or even out the steps";
    case WF_LOWER:
        return "a lower degree than asked for was used";
    case WF_EARG:
        return "an argument is NULL, NaN, out of range, or output overlaps input";
    case WF_EMEM:
        return "memory is missing, too small (see wf_size) or not aligned for a double";
    case WF_EORDER:
        return "times must increase";
    case WF_EFULL:
        return "no column is left: make the grid with a larger capacity";
    case WF_EFEW:
        return "too few samples: push some first";
    case WF_ERANGE:
        return "a weight overflows: the times are too close or too far apart for this";
    case WF_EEXTRAP:
        return "a time lies outside the stored times: push it and write its sample before it is read";
    case WF_ENOISY:
        return "noise of the samples is amplified too much: lower the degree or even out the steps";
    case WF_ELONG:
        return "too many columns for this call: use a smaller grid, or wf_fit and wf_eval";
    default:
        return status > 0 ? "unknown remark" : "unknown status of waveform.h";
    }
}

#ifdef __cplusplus
}
#endif
#endif /* WF_IMPLEMENTATION */

/* MIT License

   Copyright (c) 2026 the authors of waveform.h, iqn.h and rk.h

   Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
   documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
   rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to
   permit persons to whom the Software is furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
   Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
   WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT.  IN NO EVENT SHALL THE AUTHORS
   OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
   OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

   Version history
      0.1.0   first version */
