/* SPDX-License-Identifier: MIT

   waveform.h - v0.2.0 - B-splines in time, for arrays that depend on it

   In *one* C or C++ file, before the include:

      #define WF_IMPLEMENTATION
      #include "waveform.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates,
   prints, aborts or keeps a global.

   SYNOPSIS

      static double mem[1200], x[50 * N], c[50 * N], v[N];   // N numbers that depend on time
      double t[4], t0 = 0;
      wf *w;
      int j, k, window, turn;
      if (wf_make(&w, 3, 50, mem, sizeof mem) < 0) return 1; // cubic, 50 columns; see wf_size
      wf_set(w, WF_STRICT, 1);                  // to read beyond the stored times is an error
      j = wf_push(w, t0);                       // a time; its column, or a negative status
      if (j < 0) return 1;
      sample(t0, x + j * N);
      for (window = 0; window < 3; window++) {
          for (k = 0; k < 4; k++) t[k] = t0 + (k + 1) * h;
          if (wf_begin(w, 1, 4, t, N, x, N) < 0) return 1; // four sub-steps and a first guess
          for (turn = 0; turn < 2; turn++) { // until the solvers agree
              wf_interpolate(w, t0 + 0.3 * h, 0, N, x, N, v); // one reads: the value at any time
              for (k = 0; k < 4; k++) {         // the other one writes its sub-steps
                  j = wf_push(w, t[k]);         // a stored time: its column, to be overwritten
                  if (j < 0) return 1;
                  sample(t[k], x + j * N);
              }
          }
          t0 = t[3];
          wf_fit(w, N, x, N, c, N);             // for many evaluations: to coefficients once,
          wf_eval(w, t0 - h / 3, 1, N, c, N, v); //    then short sums; here the time derivative
          if (wf_advance(w, 4, N, x, N) < 0) return 1; // the next window; keep 4 older samples:
      }                                         //    a guess of degree 1 needs them

   A wf holds the times, the knots and the factors of the collocation matrix; the columns stay in
   your array x, column j at x + j*ldx, ldx >= n (Fortran: x(ldx,0:columns-1)), which has room for
   `capacity` of them.  Every value, derivative, mean and first guess is a row of weights times
   columns.  The rows are public, for data on a device or spread over processes.

   Functions whose name begins with wf_eval or wf_basis are for *coefficients*, made by wf_fit.  All
   others are for *samples*; wf_combine takes what its weights were made for.

   After wf_advance the columns after that of the window start still hold old numbers.
   wf_begin writes a first guess into every column that it opens; after a plain wf_push, write the
   column before anybody reads.  If the sub-steps are not known beforehand, call wf_begin with the
   window end alone: then the partner that goes first can read a guess at any time of the window.
   The solver that writes calls wf_rollback first, which forgets the guess; then wf_push for each
   step.  wf_pop takes back a step that is rejected.

   TERMS

      column    n numbers that belong together: a value, a derivative or the value behind a break
      sample    the value at a time, with its derivative if it has one; a break has two
      grid      a wf with all its times
      segment   the columns between two breaks, or all of them
      window    from the window start to the last time.  The start is the first time pushed, and
                after wf_advance the time that was last then
      sub-step  the step from one time of the window to the next, named by the time at its end,
                which is the one that is pushed
      behind    later in time, or in a higher column; in front of: earlier, or in a lower one
      history   the samples in front of the window start
      stored    of a time: pushed, whether its column is written yet or not.  For reads, the times
                that wf_restrict leaves out do not count

   COMPILE-TIME OPTIONS, before the include, the same in every file

      WF_STATIC   every function private to the including file, for a library that embeds this one:
                  define WF_IMPLEMENTATION in every file that includes it
      WF_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS

      Columns j = 0 .. m-1 have times t_0 <= t_1 <= ..; a time that occurs more than once has a
      derivative, a break (below), or both.  The degree of the spline is p = min(degree of wf_make,
      m-1), less if wf_restrict or WF_SAMPLE_ERROR ask for less or a pivot underflows, and 0 where a
      value and its derivative are all there is:

         s(t) = sum_i c_i N_i(t),  s(t_j) = x_j  (or s'(t_j) = x_j),  i.e.
         A c = x,  A_ji = N_i(t_j)  (or N_i'(t_j))

      The knots are clamped; each inner knot is a weighted average of p neighbouring times:

         u_0 = .. = u_p = t_0,   u_m = .. = u_{m+p} = t_{m-1},
         u_{p+j} = sum_k v_k t_k / sum_k v_k,  k = j .. j+p-1,  for j = 1 .. m-p-1,
         v_k = 1/(t_k - t_{k-1}) + 1/(t_{k+1} - t_k),  twice the one term at t_0 and t_{m-1}

      (steps between different times; a derivative has the weight of its time; k runs over 1 .. m-2,
      so the time of an end is averaged only with a derivative).  On even steps this is the plain
      average.  Why the weights: a spline is well interpolated at the averages of its own knots.
      Plain averages make the knots averages of the times instead; where steps grow, the averages of
      such knots lie behind the times.  With the weights, the times of an endless grid t_i = g^i are
      the averages of the knots exactly, for every g; there interpolation has norm <= 2 for p = 2
      (Marsden) and <= 27 for p = 3 (de Boor).  The ends of a real grid are worse.  Noise constant
      (see below; here the maximum over all t) of a grid of 12 times, p = 3, plain -> weighted
      averages:

         steps grow by 2     147    -> 6.3      last step 1e-3 of the others    341    -> 4.4
         by 3                1.9e5  -> 17       1e-6                            3.4e5  -> 4.4
         by 10               2e15   -> 534      1e-6, with derivatives          1.6e11 -> 2.0

      The noise that remains comes from the last polynomial pieces, at the end where the steps are
      long.  Where steps differ by factors of 100 and more, in no order, no knots are good: set
      WF_SAMPLE_ERROR.

      Times interlace the basis, t_j < u_{p+j} < t_{j+p-1} for p > 1 (with derivatives and p = 2 a
      time that occurs twice is a knot), so A is regular and has p-1 diagonals to each side.
      Without derivatives A is totally positive and LU without pivoting does not grow.  With them,
      of the two rows of a time the one whose pivot is the larger share of its row goes first.  A
      is factorised row by row; a push remakes about the last 2p+4 rows, but all of them when the
      scale or origin of the times or the degree changes.  Weights on the samples are
      w(t) = A^-T N(t), entries w_j(t); they decay exponentially away from t, and are cut where they
      have fallen to 1e-25 of the largest.  wf_fit is L U c = x, strip by strip of the n numbers, so
      that each sample is read from memory once.

      m = p+1 is one polynomial; p = 1 joins the samples by lines; p = 0 holds x_j on (t_{j-1},
      t_j].  A value or a derivative may jump at a knot or a break.  There the limit from the left
      is returned, also for a t that equals that time up to round-off.  deriv + WF_BEHIND asks for
      the limit from the right; with p = 0 that is the next sample, but at the very first time of a
      segment the sample of that time.

      breaks     a time with a value before and a value behind (wf_push_break) cuts the spline in
                 two.  Each segment of k columns is a spline of its own of degree min(degree,
                 k-1): jumps, kinks and impacts at known times cost no order.  No segment knows
                 the samples of another: the value behind a break makes a line with one more
                 sample, a parabola with two more, or with one that has its derivative.  wf_advance
                 keeps no history across a break
      error      f - s = - sum_j w_j(t) (a (t_j - t)^(p+1) + b (t_j - t)^(p+2)) + higher order: what
                 the operator does to the first two powers it cannot reproduce, a and b from
                 divided differences of the samples near t (for a derivative column the
                 derivative of the bracket by t_j).  A kink hides between samples; it shows
                 when one sample is left out and foretold from its p+1 neighbours
      integral   Gauss' rule on every knot span: positive, exact for the spline, no cancellation on
                 short intervals
      noise      two sums at every t: of |w_j(t)| over the values, the Lebesgue constant, and of
                 |w_j(t)| over the derivatives, divided by the longest step of the segment.  The
                 noise constant is the largest of both at 10 points of every sub-step of the window
                 (between these points the sums may be a little larger).  There an error of size d
                 in the values alone shows up as at most d times it, so does one of d/(longest step)
                 in the derivatives alone, both together as twice that.  On even steps at most about
                 2, 5, 14, 49 for degree 3, 5, 7, 9

      Times become (t - origin) 2^-e with 2^e <= span < 2^(e+1), e <= 1000, of size at most 4 for
      spans below 2^1001.  This is exact, so offsets of 1e9 and units of 1e-300 or 1e300 cost
      nothing.  wf_push treats two times as equal if they differ by at most max(4 ulp, min(k ulp,
      last step / 1000)): an ulp is that of the largest time, k the number of columns from the
      window start on.  For a time equal to a stored one it returns the stored column.

      de Boor, A Practical Guide to Splines, 1978: basis functions, collocation, knots.  de Boor &
      Pinkus, Numer. Math. 27, 1977: elimination without pivoting for totally positive band
      matrices.  Marsden, J. Approx. Theory 10, 1974: the norm 2.

   WHICH FORM

      From samples (wf_interpolate) a time costs one read of the columns around it, up to about 47
      to each side with degree 3; from coefficients (wf_fit, wf_eval) it costs degree+1 columns,
      after a fit, which costs one to three memcpy of the samples where n is 1000 or more, and many
      where it is small.  With degree 3 the fit pays from 3 to 8 evaluations on.  Coefficients are
      stale after you have written a column, and after every call that takes a wf which is not
      const.  Two such calls do no harm: wf_set of WF_STRICT, and a wf_push that returns a stored
      column.

   DOES NOT

      smooth data, keep them monotone or positive, find breaks, know about processes or devices.

   LIMITATIONS

      At most degree 15.  From degree 11 on, with 14 columns or more and no derivatives, the first
      and last steps, up to two at each end, amplify noise more than a hundredfold even on even
      steps (with derivatives degree 15 alone, from 24 columns on).  There wf_quality says WF_NOISY.
      wf_interpolate says so, or with WF_STRICT 2 fails, at those times in these steps where it is
      so.  wf_fit and wf_resample may stay silent, for they know a bound only.
      Time only increases.  A time is refused if the span overflows, or if a stored step is below
      2^(e-1000), where 2^e, e <= 1000, is the largest power of 2 that is not above the span.
      Coefficients may be larger than the samples by the noise constant times 2^p, and by more where
      a history of long steps stands in front of short ones: near 1e308 use wf_interpolate, not
      wf_fit or wf_resample, and for means over more than 128 columns wf_weights_mean with
      wf_combine (the parts that wf_interpolate_mean adds up may overflow).  Samples below 1e-300
      lose bits where weights are above 1.
      Where products of weights and samples differ by factors above 1e300, a sum keeps the largest:
      a weight below 1e-308 of another loses bits or counts as 0.  If its sample is NaN, the sum is
      NaN all the same.
      Only the window is judged, not its history; but wf_weights and wf_interpolate judge the time
      asked for, wherever it lies.  (At a degree p >= 1 and with k sub-steps in the window, wf_error
      sees jumps in the history, too: in its last p/2 + 1 steps, p/2 rounded down, or in its last p
      + 2 - k, whichever are more.)  Where steps of the history are wild (ratios above 1e6 with
      degree 6), its round-off reaches the window: leave it out by wf_restrict.
      Weights further than 256 columns away from a time, 180 from those over which a mean is taken,
      are left out; even at degree 15 they are 1e-25 there, unless the steps are wild and the noise
      constant says so.
      wf_error cannot see what happens between samples that do not show it.  With degree + 2 columns
      it rests on one difference, which may vanish by accident.  Of a wave, at degree 5 or 6 and in
      windows of one to four sub-steps, the estimate of wf_choose is below a third of the error in
      up to 9 % of the windows where a period has 60 sub-steps, 36 % with 16, 74 % with 8; with
      degree + 4 columns (wf_restrict, wf_error) in 0.3 % at most.
      With derivatives the degree stays at 2 or above.  Exception: a single sample with its
      derivative is a constant, whose derivative is 0; at that very time wf_weights and
      wf_interpolate return the stored derivative all the same.

   DETERMINISM

      The same binary gives the same bits, whatever n, stride, thread and splitting of the n
      numbers; wf_fit in place and out of place may differ in the last bits.  So may compilers that
      contract a*b+c (-march=native, -ffp-contract) and those that do not.  Under -ffast-math the
      bits may depend on n, denormal numbers count as zero, and a stored time still returns its
      sample; statuses and NaN tests are not affected, unless a denormal pivot lowers the degree.
      NaN in a sample stays in its component.

   THREADS

      Functions on different objects may run at once, and so may those with a const handle on the
      same object.

   LICENSE

      MIT; full text and version history at the end of the file. */

#ifndef WF_H_INCLUDED
#define WF_H_INCLUDED
#define WF_VERSION 200 /* 10000*major + 100*minor + patch */

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

/* Status: 0 done; above WF_REMARK done, with a remark; < 0 nothing done, nothing touched (wf_begin,
   the means and wf_project may differ, see there).  A function that returns a number (a column, a
   degree, a history) returns it as 0 .. WF_REMARK-1.  Of two remarks WF_EXTRAP is returned.  The
   numbers of statuses do not change from 0.2.0 on: hosts in other languages carry them by value,
   and new ones are added at the end.

   With WF_EXTRAP the end polynomial is continued; a time in front of what wf_restrict leaves is
   outside, too.  wf_fit and wf_resample know the noise constant by a bound only: they say WF_NOISY
   only where it is certainly above 100, and always where it is above 100 * 2^degree.  Where
   WF_EXTRAP or WF_NOISY is listed, WF_STRICT may turn it into WF_EEXTRAP or WF_ENOISY.
   WF_EOVERLAP comes from the functions that say "apart from", WF_ENULL from all that take a
   pointer, unless their comment says otherwise; arrays of n or count numbers may be NULL where that
   is 0. */
#define WF_STATUSES(X)                                                                             \
    X(WF_OK, 0, "done")                                                                            \
    X(WF_EXTRAP, 1000000101, "done; a time lies outside the stored times")                         \
    X(WF_NOISY, 1000000102, "done; noise of the samples is amplified more than a hundredfold")     \
    X(WF_LOWERED, 1000000103, "done by a lower degree than asked for, or than the spline has")     \
    X(WF_EARG, -101, "an argument is NaN or out of range")                                         \
    X(WF_EMEM, -102, "memory missing, too small (see wf_size) or not aligned to 8 bytes")          \
    X(WF_EORDER, -103, "times must increase; a break or a derivative comes at the last time")      \
    X(WF_EFULL, -104, "no column left: make the grid with more (see wf_copy)")                     \
    X(WF_EFEW, -105, "too few samples")                                                            \
    X(WF_ERANGE, -106, "a weight overflows: the times are too close or too far apart for this")    \
    X(WF_EEXTRAP, -108, "WF_STRICT: a time lies outside the stored times: push it before a read")  \
    X(WF_ENOISY, -109, "WF_STRICT 2: noise of the samples is amplified too much")                  \
    X(WF_EOVERLAP, -110, "arrays overlap that must lie apart")                                     \
    X(WF_ENULL, -111, "a pointer is NULL")                                                         \
    X(WF_EKEY, -112, "there is no setting of that number")                                         \
    X(WF_EVALUE, -113, "the value is not one that this setting takes")
#define WF__NUMBER(name, value, text) name = value,
enum { WF_REMARK = 1000000000, WF_STATUSES(WF__NUMBER) };

/* Settings of a grid.  They stay until they are set anew.  A checkpoint of the block holds them;
   wf_copy does not copy them. */
enum {
    WF_STRICT = 0,      /* 1: a read outside the stored times is an error, WF_EEXTRAP, in place of
                           a remark, and nothing is written.  2: WF_NOISY is an error as well,
                           but wf_quality still reports.  0, the default: neither.  Set 1 where
                           a window is iterated: it finds a partner that reads beyond the last
                           time pushed, not one that reads a column not yet written */
    WF_SAMPLE_ERROR = 1 /* d, the error of the samples divided by their range (largest less
                           smallest), such as the relative tolerance of the solver.  Every segment
                           then takes the highest degree q whose noise constant (of its part of
                           the window) is at most max(2, min(5 * 1.6^q, 0.1/d)); if none is, degree
                           1 (with derivatives 2).  wf_set and every call that changes the grid
                           choose anew.  Samples as good as exact: 1e-16.  With it a push costs
                           O(columns), and more where a degree is refused.  0, the default: no
                           limit */
};

enum {
    WF_MAX_DEGREE = 15,
    WF_BEHIND = 1024, /* deriv + WF_BEHIND: the limit from the right */
    WF_AUTO = -1      /* wf_begin: the degree of wf_predict_degree */
};

/* The object begins at mem and holds no pointers: memcpy of wf_size() bytes is a checkpoint, to be
   copied back or, if aligned to 8 bytes, read where it is as a const wf *.  The samples are not in
   it: after a wf_advance they must be restored, too. */
typedef struct wf wf;

/* ---- the grid of a window ------------------------------------------------------------------- */

/* Bytes for a grid of at most `capacity` columns, about 16 (degree + 3) for each.  Columns needed:
   one for each sample of the history (see wf_advance), the window start and each sub-step; twice
   that with derivatives; and 1 or 2 for each break.  0: bad arguments. */
WF_API size_t wf_size(int degree, int capacity);

/* An empty grid in mem[0..bytes-1]; mem must be aligned to 8 bytes and outlive *w.  There is no
   destroy.  WF_EARG; WF_EMEM, also where mem is NULL. */
WF_API int wf_make(wf **w, int degree, int capacity, void *mem, size_t bytes);

/* Change or read a setting.  WF_EKEY, WF_EVALUE; wf_get: NaN of a NULL or of an unknown key. */
WF_API int wf_set(wf *w, int key, double value);
WF_API double wf_get(const wf *w, int key);

/* Append time t.  Returns the column to write the sample into, or a negative status.  A time equal,
   up to round-off, to a stored one returns the column of that one, to be overwritten; at a break,
   of the value before it (wf_push_break: behind it); if it has a derivative, write that anew, too.
   WF_EARG, WF_EORDER, WF_EFULL; WF_ERANGE: the span overflows, or a stored step would vanish
   beside it. */
WF_API int wf_push(wf *w, double t);

/* As wf_push, for a value and its time derivative, in the unit of your times: returns the column of
   the value; the derivative goes into the next one.  With one or two sub-steps in a window and no
   history the spline may then have degree 3 or more, where values alone allow 1 or 2.
   WF_EARG: the degree of wf_make or wf_restrict is below 2.  WF_EORDER: t is stored without
   derivative, and another column stands behind it. */
WF_API int wf_push_hermite(wf *w, double t);

/* A break at the last time t, for an event there: returns a further column, for the value just
   behind it.  The spline begins anew there.  Asked again at the same time it returns the same
   column.  wf_push_break_hermite: for a value and its derivative, as wf_push_hermite.
   At a window end: wf_push_break before wf_advance; the value behind it becomes the new start.
   At a window start, after wf_advance: wf_push_break there; wf_rollback and wf_begin keep it.
   Inside a window: wf_begin with the window end alone, wf_rollback, wf_push up to the event,
   wf_push_break, wf_push on; in the next iteration the same from wf_rollback on.
   WF_EORDER: t is neither the last time nor a break already; else as wf_push. */
WF_API int wf_push_break(wf *w, double t);
WF_API int wf_push_break_hermite(wf *w, double t);

/* Open a window: roll back, push t[0..count-1], and write a first guess into the columns of these
   times, which are the last `count`; wf_begin_hermite: the last 2 * count, value and time
   derivative by turns.  The guess is that of wf_predict for this degree, or WF_AUTO, from the
   columns up to the window start.
   WF_AUTO is wf_predict_degree over the n numbers given: with data spread over processes choose the
   degree from wf_hindsight instead, so that all choose alike.
   `count` may be 0.  WF_LOWERED.  Nothing is touched on WF_ENULL, on WF_EARG (wf_begin_hermite:
   also where the degree of wf_make or wf_restrict is below 2) and on WF_EFEW (push the start
   first).  WF_EORDER: a time is not
   later, by more than round-off, than the one before it.  WF_ERANGE: a time is too far away.
   WF_EFULL.  On these three x is untouched and the grid is rolled back. */
WF_API int wf_begin(wf *w, int degree, int count, const double *t, ptrdiff_t n, double *x,
                    ptrdiff_t ldx);
WF_API int wf_begin_hermite(wf *w, int degree, int count, const double *t, ptrdiff_t n, double *x,
                            ptrdiff_t ldx);

/* Forget the last time: its value and its derivative; of a break, only what is behind it.  For a
   solver that pushes its steps one by one.  After wf_begin the last time is the window end, not the
   step written last: to repeat that step write its column again.  WF_EFEW: only the value of the
   window start and its derivative are left (a break there can be popped, too), or nothing. */
WF_API int wf_pop(wf *w);

/* Back to the window start: forget every later time, if any.  WF_EFEW: the grid is empty. */
WF_API int wf_rollback(wf *w);

/* Next window: the last sample becomes the start, up to `history` older samples stay in front of it
   and keep the degree of the spline up; none from before a break.  The columns of x move down with
   their times; for further arrays on the same grid, column j comes from j + (wf_columns() before -
   wf_columns() after).  In windows of k equal sub-steps each, a guess of degree d needs a history
   of d * k, wf_hindsight after wf_advance one of (d + 1 + ago) * k.  WF_AUTO and wf_predict_degree
   need (d + 5) * k to try degrees up to d at five window ends.  A degree d above 10 is tried at
   15 - d ends at most, for which a history of 15 * k is enough.  WF_EARG, WF_EFEW. */
WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx);

/* Times, window start and breaks of `from` into `to`, which keeps its own degree, capacity and
   settings: a grid that is full goes on in a larger one, the data stay where they are.  What
   wf_restrict has set in `from` is copied, too; but where it has not lowered the degree of `from`,
   `to` has its own degree.  WF_EFULL; WF_EARG, also for derivatives where `to` was made with a
   degree below 2. */
WF_API int wf_copy(wf *to, const wf *from);

/* In place, until the next wf_restrict or wf_advance: the degree is at most `degree`, and the
   spline is made from the columns of up to `history` older samples and the window alone.  The
   columns in front of those stay: first guesses (wf_predict, wf_begin) still read them, wf_advance
   still keeps them; an evaluation there returns WF_EXTRAP.  WF_EARG, also below degree 2 if any
   column is a derivative; WF_EFEW. */
WF_API int wf_restrict(wf *w, int degree, int history);

/* Of NULL: WF_ENULL; of an empty grid: 0; wf_time: NaN of both. */
WF_API int wf_columns(const wf *w); /* columns pushed, those that wf_restrict leaves out, too */
WF_API int wf_degree(const wf *w);  /* the highest p of a segment */
WF_API int wf_start(const wf *w);   /* column of the window start (at a break there, of the value
                                       before it); older columns are history */
WF_API double wf_time(const wf *w, int column); /* NaN if there is no such column */

/* ---- from samples --------------------------------------------------------------------------- */

/* weight[0 .. wf_columns()-1]: d^deriv s / dt^deriv (t) = sum_j weight[j] x_j.  With deriv 0 a
   stored time gets one weight 1; with deriv 1 so does its stored derivative.  WF_EXTRAP, WF_NOISY
   (deriv 0 only), WF_EARG, WF_EFEW, WF_ERANGE. */
WF_API int wf_weights(const wf *w, double t, int deriv, double *weight);

/* out[0..n-1] = that sum; out apart from x.  With deriv 0 a stored time returns its value bit for
   bit, with deriv 1 its stored derivative, even if others are NaN.  A time counts as stored if it
   is the same double.  At the ends of the grid and at breaks round-off is forgiven, too.  Statuses
   of wf_weights, WF_EOVERLAP. */
WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x,
                          ptrdiff_t ldx, double *out);

/* The mean of s between a and b: weight[0 .. wf_columns()-1] on samples, or out[0..n-1], apart from
   x.  a > b is allowed.  If a == b it is s(a).  The integral is b - a times it.
   Means, like reads with deriv above 0, never say WF_NOISY: ask wf_quality.  WF_EXTRAP, WF_EARG,
   WF_EOVERLAP, WF_EFEW; WF_ERANGE leaves out and weight undefined. */
WF_API int wf_weights_mean(const wf *w, double a, double b, double *weight);
WF_API int wf_interpolate_mean(const wf *w, double a, double b, ptrdiff_t n, const double *x,
                               ptrdiff_t ldx, double *out);

/* y_k = sum_j weight[k*columns + j] x_j for k < count, in one sweep; columns with weight 0 are not
   read.  y apart from x.  WF_EARG, WF_EOVERLAP; WF_ERANGE: a weight is not finite. */
WF_API int wf_combine(int count, int columns, const double *weight, ptrdiff_t n, const double *x,
                      ptrdiff_t ldx, double *y, ptrdiff_t ldy);

/* Samples x on the grid `from` to samples y on `to`, apart from each other.  Exact for polynomials
   of the degree; a time that both grids hold, the same double, keeps its sample bit for bit.  A
   derivative column of `to` gets the derivative.  All columns of `to` are asked for, those of its
   history, too.  (If `from` has degree 0, the value behind a break that `from` lacks is the next
   sample.)  The settings of `from` count.  WF_EXTRAP,
   WF_NOISY, WF_EARG, WF_EOVERLAP, WF_EFEW, WF_ERANGE. */
WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                       double *y, ptrdiff_t ldy);

/* weight[r*wf_columns(from) + j], r < wf_columns(to): the samples on `to` of the spline that is
   nearest to the one on `from` in the least-squares sense over the interval of `to`.  Use it to go
   to fewer columns without aliasing: the integral is kept to round-off, the end values are not.
   Apply it with wf_combine.  work[0 .. wf_columns(to) * (wf_degree(to) + 1) - 1], apart from
   weight.  The settings of `from` count.  WF_EXTRAP; WF_EOVERLAP; WF_EARG, where `to` has
   derivatives or columns that wf_restrict leaves out; WF_EFEW, also where a segment of `to` has
   degree 0: a single column, or a grid made with degree 0; WF_ERANGE leaves weight undefined. */
WF_API int wf_project(const wf *from, const wf *to, double *weight, double *work);

/* weight[0 .. wf_columns()-1]: the value at t, usually in the next window, of the polynomial
   through the last sample and those nearest to 1, 2, .. `degree` window lengths before it.
   The length is from the window start to the last time pushed; while the window holds nothing but
   its start, the length of the window before.  If there is none, the guess is the start value:
   WF_LOWERED, but not for degree 0.  `degree`, 0 .. WF_MAX_DEGREE, belongs to this polynomial, not
   to the grid; derivatives have weight 0.  Any t.  WF_LOWERED: at one of these places no sample is
   nearer than 0.499 lengths, or a break lies between; the degree is then lower.  WF_EARG, WF_EFEW,
   WF_ERANGE. */
WF_API int wf_predict(const wf *w, int degree, double t, double *weight);

/* Returns the degree for wf_predict that would have foretold the last window ends best.  A degree
   is judged at those of ago = 0 .. 4 for which wf_hindsight has a row, fewer for a higher degree;
   the first degree that has none ends the search.  The miss at an end is the Euclidean norm over n
   of sum_j weight[j] x_j with the weights of wf_hindsight.  The score of a degree is the square of
   the mean of the roots of its misses.  Beginning with degree 0, a higher one takes the place of
   the best so far where its score is below 1/1.5 of the best.  Behind a jump much larger than the
   change over a window the degree is 0: this begins one or two windows after it and lasts five to
   seven.  With data spread over processes apply the same rule to norms of wf_hindsight.  WF_EARG,
   WF_EFEW. */
WF_API int wf_predict_degree(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx);

/* weight[0 .. wf_columns()-1], the row that wf_predict_degree judges by: sum_j weight[j] x_j is
   guess minus sample.  Places are counted back from the last sample, by the length that wf_predict
   takes: the sample is the one nearest to place `ago`, the guess is made from those nearest to
   places ago + 1, ago + 2, .. ago + 1 + degree.  With windows of equal length this is the guess
   that wf_predict made.  WF_EARG, WF_ERANGE; WF_EFEW: no sample is near one of the places 1
   .. ago + 1 + degree, or degree + ago >= WF_MAX_DEGREE. */
WF_API int wf_hindsight(const wf *w, int degree, int ago, double *weight);

/* ---- from coefficients ---------------------------------------------------------------------- */

/* Samples x to coefficients c, wf_columns() columns each; c may be x with ldc == ldx, else apart
   from it.  Columns that wf_restrict has left out are not touched.  WF_NOISY, WF_EARG,
   WF_EOVERLAP, WF_EFEW; WF_ERANGE: coefficients might be NaN. */
WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c,
                  ptrdiff_t ldc);

/* weight[0 .. wf_degree()]: d^deriv s / dt^deriv (t) = sum_i weight[i] c_{first+i}.  With deriv
   above the degree all are 0.  For many times at once copy each such row to weight[k*wf_columns() +
   first] of a table filled with zeros: then wf_combine reads c once.  WF_EXTRAP, WF_EARG, WF_EFEW,
   WF_ERANGE. */
WF_API int wf_basis(const wf *w, double t, int deriv, int *first, double *weight);

/* out[0..n-1] = that sum, with deriv 0 at an end of the grid the sample bit for bit; out apart from
   c.  Statuses of wf_basis, WF_EOVERLAP. */
WF_API int wf_eval(const wf *w, double t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                   double *out);

/* The mean over [a, b], as wf_weights_mean and wf_interpolate_mean.  weight[0 .. wf_columns()-1],
   on coefficients: all columns, unlike wf_basis. */
WF_API int wf_basis_mean(const wf *w, double a, double b, double *weight);
WF_API int wf_eval_mean(const wf *w, double a, double b, ptrdiff_t n, const double *c,
                        ptrdiff_t ldc, double *out);

/* ---- how good is it? ------------------------------------------------------------------------ */

/* out[0..n-1], apart from x: estimate of max |f - s| over the window, see "error" above; at kinks
   and jumps it is made by leaving out samples one by one.  A segment of degree p that has p + 1
   columns is judged as if its degree were p - 1: WF_LOWERED.  O(columns).  WF_EARG, WF_EOVERLAP,
   WF_EFEW, WF_ERANGE. */
WF_API int wf_error(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out);

/* weight[0 .. wf_columns()-1]: for smooth f, f(t) - s(t) is about sum_j weight[j] x_j.  wf_error
   takes such rows where it leaves out no sample.  WF_LOWERED: the segment of degree p has p + 1
   columns, and the row is s minus the polynomial of degree p - 1 through all of them but the first
   sample, or but its derivative if it has one.  At a stored time all weights are 0, except
   with WF_LOWERED at the first time of the segment, if it has no derivative.  WF_EXTRAP (then
   WF_LOWERED is not told); WF_EARG, WF_ERANGE; WF_EFEW: fewer than two columns in the segment. */
WF_API int wf_error_weights(const wf *w, double t, double *weight);

/* wf_restrict to the degree and history that have the least estimated error, at a noise constant of
   at most 100; of equal ones the highest degree.  Degrees from that of wf_make down to 1 (with
   derivatives 2) are tried; 0 stays 0.  Call it in each window, when its samples are written.  For
   each degree the history is the shortest that gives the first segment of the window degree + 2
   columns: 0 if its own columns are enough, all older samples if even these are too few.  Returns
   the history of the degree taken.  *error (may be NULL) = the largest estimate over n; NaN if no
   degree has one at such a noise constant: the lowest is taken then, whatever its noise.  It
   compares over the n numbers given: with data spread over processes call wf_restrict and wf_error
   for each degree instead.  O(columns) for each degree.  WF_EARG, also n = 0; WF_EFEW. */
WF_API int wf_choose(wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *error);

/* ratio = longest step / shortest step, without what wf_restrict leaves out; noise = the constant
   of the window, DBL_MAX where it overflows (not Inf, which -ffast-math ignores).  Each may be
   NULL.  O(columns).  WF_NOISY: noise is above 100; WF_EFEW. */
WF_API int wf_quality(const wf *w, double *ratio, double *noise);

WF_API int wf_linked_version(void);        /* of the implementation linked in */
WF_API const char *wf_message(int status); /* one clear sentence, never NULL */

#ifdef __cplusplus
}
#endif
#elif WF_VERSION != 200
#  error "two different versions of waveform.h in one translation unit"
#endif /* WF_H_INCLUDED */

/* ---- implementation -------------------------------------------------------------------------- */
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

/* Of an array, rows are the n numbers; of A and its factors, times.  A row of weights has an entry
   for every column. */
#define WF__STACK 2048  /* doubles of samples that a call keeps on the stack */
#define WF__REACH 512   /* columns that one row of weights may touch: at most WF__GATHER + WF__ORDER
                           of the basis, and the tails of A^-T to both sides */
#define WF__GATHER 128  /* columns that an integral gathers before it touches the data */
#define WF__TERMS 4     /* columns that one pass adds up */
#define WF__PASSES 256  /* passes that are gathered before they touch the data */
#define WF__FEW 4       /* numbers from which on vectors pay */
#define WF__MANY 128    /* numbers from which on vectors of eight pay */
#define WF__STRIP 512   /* rows of a result that stay in the first level of cache */
#define WF__BLOCK 4096  /* doubles of a working set that stay in the first two levels */
#define WF__NEAR 24     /* columns that an error estimate judges together */
#define WF__APART 6     /* times degree + 1: columns over which a cut of the grid is forgotten.  On
                           even steps an error estimate keeps 1e-5 of it at most */
#define WF__ERRORS 512  /* rows of an error estimate on the stack */
#define WF__WINDOWS 5   /* window ends at which first guesses are compared */
#define WF__BETTER 1.5  /* how much a higher degree must be better: chance is not to decide */
#define WF__ORDER (WF_MAX_DEGREE + 1)
#define WF__WIDEST (WF__ORDER + 5) /* p + 6: columns that wf__without reads at degree p + 4 */
#define WF__RING (2 * WF__ORDER) /* at least the 2p + 1 coefficients of a step; 2^5, for masks */
#define WF__EVEN  1e-10 /* relative difference of steps that counts as none */
#define WF__POINTS 10   /* of every step, where the noise constant is sampled */
#define WF__NOISE 100   /* noise constant above which a call says WF_NOISY */
#define WF__HOPELESS 1e100 /* |A^-1| beyond which a fit may overflow on the way */
/* A row of weights ends where it falls below this share of its largest entry. */
#define WF__EXACT  1e-25 /* nine digits below round-off */
#define WF__COARSE 1e-4  /* for sums of absolute values */
/* So that no count of bytes overflows a size_t, and no count of numbers an int. */
#define WF__CAPACITY \
    (int)(SIZE_MAX / 512 < INT_MAX / WF__ORDER ? SIZE_MAX / 512 : INT_MAX / WF__ORDER)

struct wf {
    int degree, capacity; /* as asked for */
    int columns, start;   /* in use; column of the window start */
    int p;                /* the highest working degree of the segments that take part */
    int strict;           /* WF_STRICT */
    int limit, hidden;    /* wf_restrict: the highest degree; columns in front that take no part */
    int exponent;         /* s = (t - origin) 2^-exponent, exact but for underflow; with two times
                             or more, and |exponent| < 1000, the span of s is in [1, 2) */
    int spare;            /* with that of wf__place: wf_size is a multiple of a double everywhere */
    double origin, down;  /* 2^-exponent */
    double step; /* the last increase of the time: what is round-off is judged against it */
    double length;        /* of the window before this one */
    double sample_error;  /* WF_SAMPLE_ERROR */
};

/* Breaks cut the columns into segments.  One place for every column. */
struct wf__place {
    int first;   /* the first column of its segment; at that one are valid: */
    int count;   /*    columns in the segment */
    int degree;  /*    its working degree */
    int slopes;  /*    how many of its columns are derivatives */
    int swapped; /* at a value with a derivative: the row of the derivative goes first */
    int spare;   /* a grid behind this one is aligned, too */
};

/* A spline of its own: degree p on `count` columns from `first`, with their scaled times s.
   Knot i is s[0] up to i = p, s[count-1] from i = count on, and u[i] between. */
struct wf__segment {
    int first, count, p;
    const double *s, *u;
};

/* ---- memory: the struct, then t, s, z, u, the factors, the places ---------------------------- */

/* Diagonals of the factors to either side of the main one. */
static int wf__band(int degree)
{
    return degree > 1 ? degree - 1 : 0;
}

static int wf__width(int degree)
{
    return 2 * wf__band(degree) + 1;
}

static double *wf__t(const wf *w)
{
    return (double *)(uintptr_t)(w + 1);
}

static double *wf__s(const wf *w)
{
    return wf__t(w) + w->capacity;
}

/* z = L^-1 E, E = (1, -1, 1, ..), of a segment without derivatives (else not used).  There the
   signs of A^-1 are a checkerboard, so |A^-1| = |A^-1 E| = |U^-1 z|. */
static double *wf__z(const wf *w)
{
    return wf__s(w) + w->capacity;
}

static double *wf__u(const wf *w)
{
    return wf__z(w) + w->capacity;
}

/* The diagonal entry of row r of the factors; entry (r, k) is lu[k - r], |k - r| < degree, or the
   diagonal alone. */
static double *wf__lu(const wf *w, int r)
{
    const int width = wf__width(w->degree);
    return wf__u(w) + w->capacity + (size_t)r * (size_t)width + wf__band(w->degree);
}

static struct wf__place *wf__places(const wf *w)
{
    return (struct wf__place *)(void *)(wf__u(w) +
                                        (size_t)w->capacity * (size_t)(1 + wf__width(w->degree)));
}

static struct wf__segment wf__segment_of(const wf *w, int column)
{
    struct wf__segment g;
    g.first = wf__places(w)[column].first;
    g.count = wf__places(w)[g.first].count;
    g.p = wf__places(w)[g.first].degree;
    g.s = wf__s(w) + g.first;
    g.u = wf__u(w) + g.first;
    return g;
}

WF_API size_t wf_size(int degree, int capacity)
{
    size_t column;
    if (degree < 0 || degree > WF_MAX_DEGREE || capacity < 1 || capacity > WF__CAPACITY) return 0;
    column = (size_t)(4 + wf__width(degree)) * sizeof(double) + sizeof(struct wf__place);
    return sizeof(wf) + (size_t)capacity * column;
}

WF_API int wf_make(wf **w, int degree, int capacity, void *mem, size_t bytes)
{
    const size_t need = wf_size(degree, capacity);
    if (!w) return WF_ENULL;
    if (need == 0) return WF_EARG;
    if (!mem || bytes < need || (uintptr_t)mem % sizeof(double) != 0) return WF_EMEM;
    memset(mem, 0, need);
    *w = (wf *)mem;
    (*w)->degree = degree;
    (*w)->capacity = capacity;
    (*w)->limit = degree;
    (*w)->down = 1;
    return WF_OK;
}

/* ---- scalars --------------------------------------------------------------------------------- */

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

static double wf__nan(void)
{
    const uint64_t bits = (uint64_t)0x7ff8 << 48;
    double nan;
    memcpy(&nan, &bits, sizeof nan);
    return nan;
}

static int wf__min_int(int a, int b)
{
    return a < b ? a : b;
}

static int wf__max_int(int a, int b)
{
    return a > b ? a : b;
}

static double wf__max(double a, double b)
{
    return a > b ? a : b;
}

static double wf__min(double a, double b)
{
    return a < b ? a : b;
}

/* How many of the rows that are left are taken at once. */
static ptrdiff_t wf__up_to(ptrdiff_t left, ptrdiff_t rows)
{
    return left < rows ? left : rows;
}

/* a == b, about which compilers warn for good reasons.  NaN is the same as everything. */
static int wf__same(double a, double b)
{
    return !(a < b || a > b);
}

static void wf__clear(ptrdiff_t count, double *v)
{
    ptrdiff_t i;
    for (i = 0; i < count; i++) v[i] = 0;
}

static void wf__add_row(int count, double factor, const double *from, double *to)
{
    int j;
    for (j = 0; j < count; j++) to[j] += factor * from[j];
}

static void wf__scale_row(int count, double factor, double *row)
{
    int j;
    for (j = 0; j < count; j++) row[j] *= factor;
}

/* WF_OK, or why x with stride ld is no array of columns of n numbers.  Nothing is read at n = 0. */
static int wf__array(ptrdiff_t n, const double *x, ptrdiff_t ld)
{
    if (n > 0 && !x) return WF_ENULL;
    return n < 0 || ld < n ? WF_EARG : WF_OK;
}

/* The same of a handle and two arrays. */
static int wf__handle_and_arrays(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                                 const double *y, ptrdiff_t ldy)
{
    const int status = w ? wf__array(n, x, ldx) : WF_ENULL;
    return status < 0 ? status : wf__array(n, y, ldy);
}

/* ---- columns and times ----------------------------------------------------------------------- */

/* A derivative column repeats the time of the value column in front of it, within its segment. */
static int wf__is_slope(const wf *w, int j)
{
    const double *t = wf__t(w);
    return j > 0 && j < w->columns && wf__places(w)[j].first < j && !(t[j] > t[j - 1]);
}

static int wf__count_slopes(const wf *w, int first, int count)
{
    int j, slopes = 0;
    for (j = first; j < first + count; j++) slopes += wf__is_slope(w, j);
    return slopes;
}

static double wf__ulp(double v)
{
    int e;
    (void)frexp(v, &e);
    return ldexp(1.0, wf__max_int(e - DBL_MANT_DIG, DBL_MIN_EXP - DBL_MANT_DIG));
}

/* One ulp of the largest time, t included. */
static double wf__largest_ulp(const wf *w, double t)
{
    const double *T = wf__t(w);
    return wf__ulp(wf__max(fabs(t), wf__max(fabs(T[0]), fabs(T[w->columns - 1]))));
}

/* Times closer than this are one instant: four ulp, or an ulp for every column of the window, for
   the host may have added up its steps, but then no more than a thousandth of a step: at t = 1e9
   steps of 1e-6 are 8 ulp long and stay distinct. */
static double wf__tolerance(const wf *w, double t)
{
    const double ulp = wf__largest_ulp(w, t);
    const double grown = wf__min((w->columns - w->start) * ulp, w->step / 1000);
    return wf__max(grown, 4 * ulp);
}

/* The first of v[0] <= v[1] <= .. that is not below a, or count. */
static int wf__first_not_below(int count, const double *v, double a)
{
    int low = 0, high = count;
    while (low < high) {
        const int mid = low + (high - low) / 2;
        if (v[mid] < a) low = mid + 1;
        else high = mid;
    }
    return low;
}

/* The first column whose time is not below t. */
static int wf__lower_bound(const wf *w, double t)
{
    return wf__first_not_below(w->columns, wf__t(w), t);
}

/* The first column of the time that column j has. */
static int wf__instant(const wf *w, int j)
{
    const double *T = wf__t(w);
    while (j > 0 && !(T[j] > T[j - 1])) j--;
    return j;
}

/* The first column whose time is nearest to t. */
static int wf__nearest(const wf *w, double t)
{
    const double *T = wf__t(w);
    const int j = wf__lower_bound(w, t);
    if (j == w->columns) return wf__instant(w, j - 1);
    if (j > 0 && t - T[j - 1] < T[j] - t) return wf__instant(w, j - 1);
    return j;
}

/* The first column whose time equals t up to round-off, or -1. */
static int wf__find(const wf *w, double t)
{
    const int j = wf__nearest(w, t);
    return fabs(wf__t(w)[j] - t) <= wf__tolerance(w, t) ? j : -1;
}

/* ---- statuses -------------------------------------------------------------------------------- */

/* The status of a call that ends with a remark. */
static int wf__remark(const wf *w, int status)
{
    if (w->strict > 0 && status == WF_EXTRAP) return WF_EEXTRAP;
    if (w->strict > 1 && status == WF_NOISY) return WF_ENOISY;
    return status;
}

/* Of two statuses the one to return: an error before a remark, a remark before none; of two errors
   the first, of two remarks the second, which is to be WF_EXTRAP. */
static int wf__worse(int a, int b)
{
    if (a < 0) return a;
    return b == WF_OK ? a : b;
}

/* ---- basis functions ------------------------------------------------------------------------- */

static double wf__knot(const struct wf__segment *g, int i)
{
    if (i <= g->p) return g->s[0];
    if (i >= g->count) return g->s[g->count - 1];
    return g->u[i];
}

/* Knots i .. i+count-1: inner ones lie side by side, others are gathered in `room`. */
static const double *wf__knots(const struct wf__segment *g, int i, int count, double *room)
{
    int k;
    if (i > g->p && i + count <= g->count) return g->u + i;
    for (k = 0; k < count; k++) room[k] = wf__knot(g, i + k);
    return room;
}

/* The k with knot k < s <= knot k+1, the end spans continued outwards. */
static int wf__span(const struct wf__segment *g, double s)
{
    int low = g->p, high = g->count - 1;
    if (!(g->s[g->count - 1] > g->s[0])) return low; /* a single time */
    while (low < high) {
        const int mid = low + (high - low + 1) / 2;
        if (wf__knot(g, mid) < s) low = mid;
        else high = mid - 1;
    }
    return low;
}

/* The span of s for what jumps at knots: if s is within `margin` of a knot, on either side of it,
   the span in front of this knot, or with `behind` the one that begins there; else wf__span.  A
   quarter of a span is never round-off, whatever the margin: short spans stay apart. */
static int wf__span_beside(const struct wf__segment *g, double s, double margin, int behind)
{
    int k = wf__span(g, s);
    double knot, length;
    if (!behind) {
        for (; k > g->p; k--) {
            knot = wf__knot(g, k);
            length = wf__knot(g, k + 1) - knot;
            if (s - knot > wf__min(margin, 0.25 * length)) break;
        }
        return k;
    }
    for (; k > 0 && k < g->count - 1; k++) { /* p = 0: span 0 is the first time alone */
        knot = wf__knot(g, k + 1);
        length = knot - wf__knot(g, k);
        if (knot - s > wf__min(margin, 0.25 * length)) break;
    }
    return k;
}

/* N[0..p]: the values, or deriv-th derivatives, at s of the basis functions k-p .. k that live
   on the span k.  A derivative by s is multiplied by down^deriv.  deriv <= p; for p = 0 deriv 1 is
   allowed, too, and gives 0. */
static void wf__splines(const struct wf__segment *g, int k, double s, int deriv, double down,
                        double *N)
{
    const int p = g->p, q = p - deriv;
    double room[2 * WF__ORDER];
    const double *knot = wf__knots(g, k - p + 1, 2 * p, room);
    int j, r;
    N[0] = 1;
    for (j = 1; j <= q; j++) { /* Cox - de Boor up to degree q */
        double carry = 0;
        for (r = 0; r < j; r++) {
            const double right = knot[p + r], left = knot[p + r - j], old = N[r];
            N[r] = carry + (right - s) / (right - left) * old;
            carry = (s - left) / (right - left) * old;
        }
        N[j] = carry;
    }
    /* each differentiation raises the degree, from j-1 to j:
       N_i,j' = j (N_i,j-1 / (u_i+j - u_i) - N_i+1,j-1 / (u_i+j+1 - u_i+1)) */
    for (j = q + 1; j <= p; j++) {
        double carry = 0;
        for (r = 0; r < j; r++) {
            const double share = j * N[r] / (knot[p + r] - knot[p + r - j]) * down;
            N[r] = carry - share;
            carry = share;
        }
        N[j] = carry;
    }
}

/* As wf__splines, with the span found from s; at the two ends the value is the sample to the
   bit, under -ffast-math, too.  Returns the first column, counted within the segment. */
static int wf__values(const struct wf__segment *g, double s, double *N)
{
    const int p = g->p, k = wf__span(g, s);
    const int at_start = wf__same(s, g->s[0]), at_end = wf__same(s, g->s[g->count - 1]);
    if (p == 0 || !(at_start || at_end)) {
        wf__splines(g, k, s, 0, 1, N);
        return k - p;
    }
    wf__clear(p + 1, N);
    N[at_start ? 0 : p] = 1;
    return at_start ? 0 : g->count - 1 - p;
}

/* ---- knots ----------------------------------------------------------------------------------- */

/* The weight of a column in the averages that make the knots: 1/step before + 1/step behind its
   time; the ends, which have one step, count it twice. */
static double wf__pull(const wf *w, const struct wf__segment *g, int j)
{
    const int value = wf__is_slope(w, g->first + j) ? j - 1 : j;
    const int next = value + 1 + wf__is_slope(w, g->first + value + 1);
    if (value == 0) return 2 / (g->s[next] - g->s[0]);
    if (next == g->count) return 2 / (g->s[value] - g->s[value - 1]);
    return 1 / (g->s[value] - g->s[value - 1]) + 1 / (g->s[next] - g->s[value]);
}

/* Weighted average of the p times from s[j] on.  Steps that agree in their first ten digits are
   even: there the average is the plain one, so that the weights, 1/step, do not magnify round-off.
   */
static double wf__average(const wf *w, const struct wf__segment *g, int j)
{
    double low = DBL_MAX, high = 0, sum = 0, moment = 0, plain = 0;
    int i;
    for (i = 0; i < g->p; i++) {
        const double pull = wf__pull(w, g, j + i), gap = g->s[j + i] - g->s[j];
        low = wf__min(low, pull);
        high = wf__max(high, pull);
        sum += pull;
        moment += pull * gap;
        plain += gap;
    }
    if (high - low <= WF__EVEN * high) return g->s[j] + plain / g->p;
    return g->s[j] + moment / sum;
}

/* Knots of a segment whose first `keep` columns are as they were.  A time that is added or taken
   away behind them changes the weight of the last one, which has column keep - 1, or keep - 2 and
   keep - 1 with a derivative.  Knot p + j averages columns j .. j + p - 1: the first that reads
   column keep - 2 is the one of j = keep - p - 1. */
static void wf__set_knots(const wf *w, const struct wf__segment *g, int keep)
{
    double *u = wf__u(w) + g->first;
    int j;
    if (g->p == 0) {
        /* the sample holds to the left of its time */
        for (j = 1; j < g->count; j++) u[j] = g->s[j - 1];
        return;
    }
    for (j = wf__max_int(1, keep - g->p - 1); j < g->count - g->p; j++)
        u[g->p + j] = wf__average(w, g, j);
}

/* ---- the collocation matrix ------------------------------------------------------------------ */

/* The row of a time, or its two rows r and r + 1, while they are eliminated.  Both are laid out
   around r: column k is at a[0][k - r + WF__ORDER], and at a[1][k - r + WF__ORDER]. */
typedef double wf__two_rows[2][2 * WF__ORDER + 1];

/* a = row of A for the value, or the slope, at the time of column r, laid out around r. */
static void wf__collocate(const struct wf__segment *g, int r, int slope, double *a)
{
    double N[WF__ORDER];
    int first, i;
    if (slope) {
        const int k = wf__span(g, g->s[r]);
        wf__splines(g, k, g->s[r], 1, 1, N);
        first = k - g->p;
    } else {
        first = wf__values(g, g->s[r], N);
    }
    wf__clear(2 * g->p + 2, a + WF__ORDER - g->p);
    for (i = 0; i <= g->p; i++) {
        const int at = first + i - r + WF__ORDER;
        /* fails with p = 0, r = 1 alone: the derivative of a lone sample, whose entry is 0 */
        if (at >= WF__ORDER - g->p && at <= WF__ORDER + g->p) a[at] = N[i];
    }
}

/* Eliminate column k of the row a, which is laid out around r, by the finished row k. */
static void wf__eliminate(const double *pivot, int band, int k, int r, double *a)
{
    double *at = a + k - r + WF__ORDER;
    int i;
    if (!(fabs(at[0]) > 0)) return;
    at[0] /= pivot[0];
    for (i = 1; i <= band; i++) at[i] -= at[0] * pivot[i];
}

/* Which of the two rows goes first?  The one whose pivot is the larger share of its row.  Either
   may: both rows of A fit into the bands of row r and of row r + 1 of the factors. */
static int wf__second_first(const double *a0, const double *a1, double size0, double size1)
{
    return fabs(a1[WF__ORDER]) * size0 > fabs(a0[WF__ORDER]) * size1;
}

static double wf__size_of(const struct wf__segment *g, const double *a)
{
    double size = 0;
    int i;
    for (i = WF__ORDER - g->p; i <= WF__ORDER + g->p + 1; i++) size = wf__max(size, fabs(a[i]));
    return size;
}

static void wf__store(const wf *w, int band, int row, int shift, const double *a)
{
    double *lu = wf__lu(w, row);
    int i;
    for (i = -band; i <= band; i++) lu[i] = a[WF__ORDER + i + shift];
}

/* The rows of A for the time of row r, a derivative's behind that of its value.  Below degree 2
   A is the identity. */
static void wf__rows_of_time(const struct wf__segment *g, int r, int pair, wf__two_rows a,
                             double *size)
{
    int k;
    for (k = 0; k <= pair; k++) {
        wf__collocate(g, r, k, a[k]);
        if (pair) size[k] = wf__size_of(g, a[k]);
        if (g->p < 2) a[k][WF__ORDER + k] = 1;
    }
}

/* Store the two rows of a time, or the one.  Returns 0 when a pivot is 0: underflowed, or with
   derivatives cancelled. */
static int wf__store_time(const wf *w, const struct wf__segment *g, int r, int pair, wf__two_rows a,
                          const double *size)
{
    const int band = wf__band(g->p), row = g->first + r;
    const int swap = pair && g->p > 1 && wf__second_first(a[0], a[1], size[0], size[1]);
    wf__places(w)[row].swapped = swap;
    wf__store(w, band, row, 0, a[swap]);
    if (!(fabs(a[swap][WF__ORDER]) > 0)) return 0;
    if (!pair) return 1;
    if (g->p > 1) wf__eliminate(wf__lu(w, row), band, r, r, a[!swap]);
    wf__store(w, band, row + 1, 1, a[!swap]);
    return fabs(a[!swap][WF__ORDER + 1]) > 0;
}

/* A = L U by rows, from row `from` on; rows and columns are counted from the first of the
   segment.  Without derivatives A is totally positive and nothing grows (de Boor & Pinkus 1977);
   with them the two rows of a time are put in order.  Returns 0 when a pivot is 0, with NaN for the
   pivots from that time on.  If no lower degree is left, calls that need them say WF_ERANGE. */
static int wf__factor(wf *w, const struct wf__segment *g, int from)
{
    const int band = wf__band(g->p);
    double *z = wf__z(w) + g->first;
    int r, k, pair;
    for (r = from; r < g->count; r += 1 + pair) {
        wf__two_rows a;
        double size[2] = {0, 0};
        pair = wf__is_slope(w, g->first + r + 1);
        wf__rows_of_time(g, r, pair, a, size);
        z[r] = r % 2 == 0 ? 1 : -1;
        for (k = wf__max_int(0, r - band); k < r; k++) {
            wf__eliminate(wf__lu(w, g->first + k), band, k, r, a[0]);
            if (pair) wf__eliminate(wf__lu(w, g->first + k), band, k, r, a[1]);
            z[r] -= a[0][k - r + WF__ORDER] * z[k];
        }
        if (wf__store_time(w, g, r, pair, a, size)) continue;
        for (; r < g->count; r++) wf__lu(w, g->first + r)[0] = wf__nan();
        return 0;
    }
    return 1;
}

/* Row r of the factors belongs to this column of the data. */
static int wf__column_of_row(const wf *w, int r)
{
    if (wf__places(w)[r].swapped) return r + 1;
    return wf__is_slope(w, r) && wf__places(w)[r - 1].swapped ? r - 1 : r;
}

/* ---- rows of weights ------------------------------------------------------------------------- */

/* Weights on the columns first .. first+count-1, at weight[column - origin]. */
struct wf__row {
    int origin, first, count;
    double weight[WF__REACH];
};

/* Where the weights of the row begin: at that of column first. */
static double *wf__entries(struct wf__row *row)
{
    return row->weight + (row->first - row->origin);
}

/* Room for the columns around first .. last of the segment. */
static void wf__open_row(const struct wf__segment *g, int first, int last, struct wf__row *row)
{
    const int end = g->first + g->count;
    row->origin = wf__max_int(g->first, (first + last) / 2 - WF__REACH / 2);
    if (row->origin > end - WF__REACH) row->origin = wf__max_int(g->first, end - WF__REACH);
    row->first = first;
    row->count = last - first + 1;
}

/* A substitution ends when band + 1 consecutive entries are below `share` times the largest.  One
   is not enough: the weight of a derivative may be small although those behind it are not. */
struct wf__tail {
    double share, largest;
    int run, band;
};

static int wf__ends(struct wf__tail *tail, double v)
{
    tail->largest = wf__max(tail->largest, fabs(v));
    if (fabs(v) > tail->share * tail->largest) tail->run = 0;
    else tail->run++;
    return tail->run > tail->band;
}

/* U^T y = v in place; v[0] is row `begin`, from which r and k count, and row high - 1 the last that
   may be written.  v is given up to row given - 1 and counts as 0 from there on, whatever it holds.
   Returns the row behind the last one of y. */
static int wf__solve_down(const wf *w, int begin, int given, int high, struct wf__tail tail,
                          double *v)
{
    const int band = tail.band;
    const int next = wf__width(w->degree) - 1; /* from entry (k, r) to (k + 1, r) */
    const double *lu = wf__lu(w, begin);
    int r, k;
    for (r = 0; r < high - begin; r++) {
        const int above = wf__max_int(r - band, 0);
        const double *a = lu + r + (ptrdiff_t)above * next;
        double y = r < given - begin ? v[r] : 0;
        for (k = above; k < r; k++, a += next) y -= a[0] * v[k];
        v[r] = y / a[0];
        if (wf__ends(&tail, v[r]) && r >= given - begin + band) return begin + r + 1;
    }
    return high;
}

/* L^T x = y in place from row end - 1 down to `low`, likewise.  y counts as 0 in front of
   `begin`; v[-1], v[-2] .. are written.  Returns the row where x begins. */
static int wf__solve_up(const wf *w, int begin, int end, int low, struct wf__tail tail, double *v)
{
    const int band = tail.band, next = wf__width(w->degree) - 1;
    const double *lu = wf__lu(w, begin);
    int r, k;
    for (r = end - begin - 1; r >= low - begin; r--) {
        const double *a = lu + r + (ptrdiff_t)r * next;
        double x = r < 0 ? 0 : v[r];
        for (k = r + 1; k <= r + band && k < end - begin; k++) x -= a[(k - r) * next] * v[k];
        v[r] = x;
        if (wf__ends(&tail, x) && r < -band) return begin + r;
    }
    return low;
}

/* Solve (L U)^T q = v in place.  On entry v[0 .. *count-1] are the nonzero entries, for rows *first
   .. of the factors; let f be this *first.  The solution may fill rows low .. high-1, row r at
   v[r - f]: the caller has room in front of v, down to v[low - f].  Inverses of band matrices decay
   exponentially away from the diagonal: both sweeps end where the entries are negligible.  On
   return *first and *count tell which rows the solution has. */
static void wf__transposed(const wf *w, int band, int low, int high, double share, double *v,
                           int *first, int *count)
{
    const struct wf__tail tail = {share, 0, 0, band};
    const int begin = *first, end = wf__solve_down(w, begin, begin + *count, high, tail, v);
    *first = wf__solve_up(w, begin, end, low, tail, v);
    *count = end - *first;
}

/* Back from rows of the factors to columns of the data: exchange, and undo the unit of the
   derivatives. */
static void wf__unswap_weights(const wf *w, int first, int count, double *v)
{
    const double unit = ldexp(1.0, w->exponent);
    int j;
    for (j = 0; j < count; j++) {
        if (wf__places(w)[first + j].swapped) {
            const double row = v[j];
            v[j] = v[j + 1];
            v[j + 1] = row;
        }
        if (wf__is_slope(w, first + j)) v[j] *= unit;
    }
}

/* A row on the coefficients becomes the row on the samples: w := A^-T w, A = L U. */
static void wf__to_samples(const wf *w, const struct wf__segment *g, double share,
                           struct wf__row *row)
{
    const int low = row->origin, end = g->first + g->count;
    const int limit = wf__min_int(end, low + WF__REACH);
    const int high = limit - wf__is_slope(w, limit); /* no value without its derivative */
    double *v = wf__entries(row);
    int first = row->first, count = row->count;
    if (g->p < 2) return;
    wf__transposed(w, g->p - 1, low, high, share, v, &first, &count);
    /* a value and its derivative stay together, for they may have to be exchanged */
    if (first > low && wf__is_slope(w, first)) row->weight[--first - low] = 0, count++;
    if (wf__is_slope(w, first + count)) row->weight[first + count++ - low] = 0;
    row->first = first;
    row->count = count;
    if (wf__places(w)[g->first].slopes) wf__unswap_weights(w, first, count, wf__entries(row));
}

/* A whole row of weights on coefficients becomes one on samples, in place. */
static void wf__whole_row(const wf *w, double *weight)
{
    int f, first, count;
    for (f = w->hidden; f < w->columns; f += wf__places(w)[f].count) {
        const struct wf__segment g = wf__segment_of(w, f);
        if (g.p < 2) continue;
        first = f;
        count = g.count;
        wf__transposed(w, g.p - 1, f, f + g.count, 0, weight + f, &first, &count);
        if (wf__places(w)[f].slopes) wf__unswap_weights(w, f, g.count, weight + f);
    }
}

/* ---- noise ----------------------------------------------------------------------------------- */

/* What makes the noise of derivatives a number without a unit: the longest step of a segment. */
static double wf__slope_unit(const wf *w, const struct wf__segment *g)
{
    double step = 0;
    int j;
    if (!wf__places(w)[g->first].slopes) return 1; /* not used */
    for (j = 1; j < g->count; j++) step = wf__max(step, g->s[j] - g->s[j - 1]);
    return ldexp(step, w->exponent);
}

/* The larger of two sums of |weight|: over the values, and over the derivatives divided by
   wf__slope_unit. */
static double wf__noise_of(const wf *w, double unit, struct wf__row *row)
{
    const double *v = wf__entries(row);
    double values = 0, slopes = 0;
    int j;
    for (j = 0; j < row->count; j++) {
        if (wf__is_slope(w, row->first + j)) slopes += fabs(v[j]);
        else values += fabs(v[j]);
    }
    return slopes > 0 ? wf__max(values, slopes / unit) : values;
}

/* The column of a segment, counted within it, where the window begins; 0 if the window begins in
   front of the segment.  (No segment that takes part lies wholly in front of the window.)  Noise in
   front of it is not judged: nobody reads there, and long old steps are noisier. */
static int wf__window_in(const wf *w, const struct wf__segment *g)
{
    return wf__max_int(0, w->start - g->first);
}

/* The first coefficient, counted within the segment, whose basis function is not 0 in the
   window. */
static int wf__first_needed(const wf *w, const struct wf__segment *g)
{
    return wf__span_beside(g, g->s[wf__window_in(w, g)], 0, 1) - g->p;
}

/* Time k = 1 .. WF__POINTS inside the step that ends with column j of the segment. */
static double wf__inner_time(const struct wf__segment *g, int j, int k)
{
    return g->s[j - 1] + (g->s[j] - g->s[j - 1]) * k / (WF__POINTS + 1.0);
}

/* The noise constant of a step: the rows of weights at its inner times. */
static double wf__noise_by_rows(const wf *w, const struct wf__segment *g, double unit, int j)
{
    struct wf__row row;
    double worst = 1, size, s;
    int k, first;
    for (k = 1; k <= WF__POINTS; k++) {
        s = wf__inner_time(g, j, k);
        first = g->first + wf__span(g, s) - g->p;
        wf__open_row(g, first, first + g->p, &row);
        wf__splines(g, first - g->first + g->p, s, 0, 1, wf__entries(&row));
        wf__to_samples(w, g, WF__COARSE, &row);
        size = wf__noise_of(w, unit, &row);
        if (!wf__finite(size)) return DBL_MAX;
        worst = wf__max(worst, size);
    }
    return worst;
}

/* C = A^-1 E, E the checkerboard (1, -1, ..), from the last coefficient of a segment downwards; C_r
   stays at c[r modulo WF__RING] while a step can need it. */
struct wf__checker {
    int low; /* rows below are not known yet */
    double c[WF__RING];
};

/* Returns the largest |C| on the way; what is not finite makes all that is below so, too. */
static double wf__checker_down(const wf *w, const struct wf__segment *g, int to,
                               struct wf__checker *C)
{
    const int band = g->p - 1;
    const double *z = wf__z(w) + g->first;
    double most = 0;
    int r, k;
    for (r = C->low - 1; r >= to; r--) {
        const double *a = wf__lu(w, g->first + r);
        double sum = z[r];
        for (k = wf__min_int(band, g->count - 1 - r); k > 0; k--)
            sum -= a[k] * C->c[(r + k) & (WF__RING - 1)];
        C->c[r & (WF__RING - 1)] = sum / a[0];
        most = wf__max(most, fabs(sum / a[0]));
    }
    C->low = wf__min_int(C->low, to);
    return most;
}

/* v[r - low] = row r of A^-1 e, where e is E up to row k and 0 behind it, for rows from `low` to k
   + p at least.  Up to row k, L^-1 e is L^-1 E, which is at hand; behind it, it decays. */
static void wf__half_checker(const wf *w, const struct wf__segment *g, int k, int low, double *v)
{
    const int band = g->p - 1, next = wf__width(w->degree) - 1;
    const int limit = wf__min_int(g->count, low + WF__REACH);
    const double *lu = wf__lu(w, g->first + low);
    struct wf__tail tail = {WF__COARSE, 0, 0, band};
    int r, q, end = limit - low; /* these rows count from `low` */
    for (r = 0; r <= k - low; r++) v[r] = wf__z(w)[g->first + low + r];
    for (; r < end; r++) {
        const double *a = lu + r + (ptrdiff_t)r * next; /* the diagonal entry of row r */
        double y = 0;
        for (q = wf__max_int(r - band, 0); q < r; q++) y -= a[q - r] * v[q];
        v[r] = y;
        if (wf__ends(&tail, y)) end = r + 1; /* ends this loop; low + r is k + p or more by now */
    }
    for (r = end - 1; r >= 0; r--) {
        const double *a = lu + r + (ptrdiff_t)r * next;
        const int last = wf__min_int(r + band, end - 1);
        for (q = r + 1; q <= last; q++) v[r] -= a[q - r] * v[q];
        v[r] /= a[0];
    }
}

/* The noise constant of a step, as wf__noise_by_rows, without derivatives.  A fundamental spline
   changes sign at all samples but its own and nowhere else, so within the step the signs of the
   weights are a checkerboard that is turned over between columns j-1 and j.  The sum of |weights|
   is the spline through those signs, with the coefficients 2 A^-1 (E up to column j-1) - A^-1 E. */
static double wf__noise_by_signs(const wf *w, const struct wf__segment *g, int j,
                                 struct wf__checker *C)
{
    double v[WF__REACH], N[WF__ORDER], worst = 1, s, size;
    int span = wf__span(g, g->s[j - 1]), first, i, k;
    const int low = span - g->p; /* rows j, j + 1, .. of A and L are 0 in front of this column */
    wf__checker_down(w, g, low, C);
    wf__half_checker(w, g, j - 1, low, v);
    for (k = 1; k <= WF__POINTS; k++) {
        s = wf__inner_time(g, j, k);
        while (span < g->count - 1 && wf__knot(g, span + 1) < s) span++;
        wf__splines(g, span, s, 0, 1, N);
        first = span - g->p;
        for (size = 0, i = first; i <= span; i++)
            size += N[i - first] * (2 * v[i - low] - C->c[i & (WF__RING - 1)]);
        if (!wf__finite(size)) return DBL_MAX;
        worst = wf__max(worst, fabs(size));
    }
    return worst;
}

/* The noise constant of a segment within the window, at inner points of every step; DBL_MAX if a
   weight overflows.  Above `limit`, any number above it. */
static double wf__lebesgue(const wf *w, const struct wf__segment *g, double limit)
{
    const int slopes = wf__places(w)[g->first].slopes, begin = wf__window_in(w, g);
    const double unit = wf__slope_unit(w, g);
    struct wf__checker C;
    double worst = 1;
    int j;
    if (g->p < 2) return 1;
    C.low = g->count;
    for (j = g->count - 1; j > begin; j--) {
        if (!(g->s[j] > g->s[j - 1])) continue; /* a derivative */
        if (slopes > 0) worst = wf__max(worst, wf__noise_by_rows(w, g, unit, j));
        else worst = wf__max(worst, wf__noise_by_signs(w, g, j, &C));
        if (worst > limit) break;
    }
    return worst;
}

/* That of all segments, or any number above `limit`. */
static double wf__worst_noise(const wf *w, double limit)
{
    double worst = 1;
    int f;
    for (f = w->hidden; f < w->columns; f += wf__places(w)[f].count) {
        const struct wf__segment g = wf__segment_of(w, f);
        worst = wf__max(worst, wf__lebesgue(w, &g, limit));
        if (worst > limit) break;
    }
    return worst;
}

/* Largest sum of |weights| of one coefficient, over the rows of A^-1 that the window needs; values
   and derivatives as in wf__noise_of.  Never below the noise constant.  Without a history it is at
   most about 2^p times the noise constant.  With one it may be any multiple: the first of these
   basis functions reach into the history, whose noise counts here, too. */
static double wf__inverse_with_slopes(const wf *w, const struct wf__segment *g)
{
    const double unit = wf__slope_unit(w, g);
    struct wf__row row;
    double worst = 0, size;
    int r;
    for (r = g->first + wf__first_needed(w, g); r < g->first + g->count; r++) {
        wf__open_row(g, r, r, &row);
        *wf__entries(&row) = 1;
        wf__to_samples(w, g, WF__COARSE, &row);
        size = wf__noise_of(w, unit, &row);
        if (!wf__finite(size)) return DBL_MAX;
        worst = wf__max(worst, size);
    }
    return worst;
}

/* The same without derivatives: A^-1 is a checkerboard, so the sums are |A^-1 (1, -1, ..)|. */
static double wf__inverse(const wf *w, const struct wf__segment *g)
{
    const int first = wf__first_needed(w, g);
    struct wf__checker C;
    double worst;
    C.low = g->count;
    worst = wf__checker_down(w, g, first, &C);
    return wf__finite(C.c[first & (WF__RING - 1)]) ? worst : DBL_MAX;
}

/* DBL_MAX stands for all that overflows: comparisons with NaN mean nothing under -ffast-math. */
static double wf__inverse_norm(const wf *w, const struct wf__segment *g)
{
    if (g->p < 2) return 1;
    return wf__places(w)[g->first].slopes ? wf__inverse_with_slopes(w, g) : wf__inverse(w, g);
}

/* The noise that degree q may have when samples are wrong by a share d of their range: 5 * 1.6^q,
   which is about ten times the noise of even steps (for q <= 7), or 0.1 / d if that is less.  It is
   never below 2. */
static double wf__limit(double d, int q)
{
    double limit = 5;
    for (; q > 0; q--) limit *= 1.6;
    if (d * limit > 0.1) limit = 0.1 / d;
    return wf__max(limit, 2);
}

static int wf__quiet(const wf *w, const struct wf__segment *g)
{
    double limit;
    if (!(w->sample_error > 0) || g->p < 2) return 1;
    limit = wf__limit(w->sample_error, g->p);
    /* a bound, and cheap */
    if (!wf__places(w)[g->first].slopes && wf__inverse(w, g) <= limit) return 1;
    return wf__lebesgue(w, g, limit) <= limit;
}

/* ---- everything that follows from the times -------------------------------------------------- */

/* Exponent of the largest power of two that is at most span, within 1000 so that 2^e and 2^-e
   are normal numbers. */
static int wf__exponent(double span)
{
    int e = 1;
    if (span > 0) (void)frexp(span, &e);
    return wf__max_int(-1000, wf__min_int(e - 1, 1000));
}

/* Scaled times from column `keep` on.  Returns 0 if the unit or the origin has changed, and then
   makes all of them. */
static int wf__scale_times(wf *w, int keep)
{
    const double *T = wf__t(w);
    const double first = T[0], last = T[w->columns - 1], span = last - first;
    /* Subtracting the first time is exact where all times are within a factor of two of each
       other, and no gain elsewhere. */
    const double origin = fabs(first) / 2 > span || fabs(last) / 2 > span ? first : 0;
    const int e = wf__exponent(span);
    const int same = e == w->exponent && wf__same(origin, w->origin);
    int j;
    w->exponent = e;
    w->origin = origin;
    w->down = ldexp(1.0, -e);
    for (j = same ? keep : 0; j < w->columns; j++) wf__s(w)[j] = (T[j] - origin) * w->down;
    return same;
}

/* Knots and factors of one segment whose first `keep` columns are as they were, with the highest
   degree that is quiet and has pivots. */
static void wf__build_segment(wf *w, int first, int keep)
{
    struct wf__place *place = wf__places(w) + first;
    struct wf__segment g = wf__segment_of(w, first);
    int lowest, from;
    g.p = wf__min_int(w->limit, g.count - 1);
    if (!(g.s[g.count - 1] > g.s[0])) g.p = 0;
    lowest = wf__min_int(g.p, place->slopes ? 2 : 1);
    if (g.p != place->degree) keep = 0;
    for (;; g.p--) {
        place->degree = g.p;
        wf__set_knots(w, &g, keep);
        /* new are the knots from keep - 1 on, so the functions from keep - p - 2 on, which no row
           in front of keep - 2p - 1 sees; two more to be safe, and no derivative without its
           value */
        from = wf__max_int(0, keep - 2 * g.p - 3);
        from -= wf__is_slope(w, first + from);
        if (wf__factor(w, &g, from) && wf__quiet(w, &g)) return;
        if (g.p <= lowest) return; /* nothing lower is left: whoever reads it says so */
        keep = 0;
    }
}

/* All that depends on the times, when the first `keep` of them are as they were.  A change of
   columns changes only the last few knots and rows of its segment. */
static void wf__build(wf *w, int keep)
{
    struct wf__place *place = wf__places(w);
    int f;
    if (!wf__scale_times(w, keep)) keep = 0;
    w->p = 0;
    for (f = w->hidden; f < w->columns; f += place[f].count) {
        /* a segment that ends at `keep` may have lost its end */
        if (f + place[f].count >= keep) wf__build_segment(w, f, wf__max_int(0, keep - f));
        w->p = wf__max_int(w->p, place[f].degree);
    }
}

/* ---- the window ------------------------------------------------------------------------------ */

WF_API int wf_set(wf *w, int key, double value)
{
    if (!w) return WF_ENULL;
    if (key != WF_STRICT && key != WF_SAMPLE_ERROR) return WF_EKEY;
    if (!wf__finite(value) || value < 0) return WF_EVALUE;
    if (key == WF_STRICT) {
        if (value > 2 || !wf__same(value, floor(value))) return WF_EVALUE;
        w->strict = (int)value;
        return WF_OK;
    }
    w->sample_error = value;
    if (w->columns > 0) wf__build(w, 0);
    return WF_OK;
}

WF_API double wf_get(const wf *w, int key)
{
    if (w && key == WF_STRICT) return w->strict;
    if (w && key == WF_SAMPLE_ERROR) return w->sample_error;
    return wf__nan();
}

/* Append one column of time t to the last segment, or begin a new one with it. */
static void wf__append(wf *w, double t, int new_segment)
{
    struct wf__place *place = wf__places(w);
    const int m = w->columns++;
    const int first = new_segment || m == 0 ? m : place[m - 1].first;
    wf__t(w)[m] = t;
    place[m].first = first;
    place[m].count = 0;
    place[m].slopes = 0;
    place[m].swapped = 0;
    place[first].count++;
    place[first].slopes += wf__is_slope(w, m);
}

/* Forget the columns from m on. */
static void wf__cut(wf *w, int m)
{
    struct wf__place *place = wf__places(w);
    const int first = place[m - 1].first;
    int j;
    w->columns = m;
    place[first].count = m - first;
    place[first].slopes = wf__count_slopes(w, first, m - first);
    j = wf__instant(w, m - 1);
    w->step = j > 0 ? wf__t(w)[j] - wf__t(w)[j - 1] : 0;
    wf__build(w, m);
}

/* WF_OK, or why t cannot be the next time: it must increase, and no stored step may vanish beside
   the new span.  The new step cannot: what is within 4 ulp of a stored time never comes here. */
static int wf__next_time(const wf *w, double t)
{
    const double *T = wf__t(w);
    const int m = w->columns;
    int j, e;
    if (!(t > T[m - 1])) return WF_EORDER;
    if (!wf__finite(t - T[0])) return WF_ERANGE;
    e = wf__exponent(t - T[0]);
    if (e <= w->exponent) return WF_OK; /* the stored steps have passed this test before */
    for (j = 1; j < m; j++)
        if (T[j] > T[j - 1] && T[j] - T[j - 1] < ldexp(1.0, e - 1000)) return WF_ERANGE;
    return WF_OK;
}

/* Push once more a time whose first column is j.  Returns the column of its value or, with
   `behind`, of the value behind its break, which is opened if the time is the last one.  With
   `slope` a derivative is added where there is none and no other column is in the way. */
static int wf__push_stored(wf *w, int j, int slope, int behind)
{
    const int m = w->columns;
    const int after = j + 1 + wf__is_slope(w, j + 1); /* behind the value and its derivative */
    const int later = after < m && wf__t(w)[after] > wf__t(w)[j];
    const int fresh = behind && after == m; /* a new break */
    if (behind && later) return WF_EORDER;
    if (behind) j = after;
    if (!fresh && (!slope || wf__is_slope(w, j + 1))) return j;
    if (!fresh && j < m - 1) return WF_EORDER; /* no room for a derivative between the columns */
    if (m + fresh + slope > w->capacity) return WF_EFULL;
    if (fresh) wf__append(w, wf__t(w)[m - 1], 1);
    if (slope) wf__append(w, wf__t(w)[j], 0);
    wf__build(w, m);
    return j;
}

static int wf__push(wf *w, double t, int slope, int behind)
{
    int m, j, status;
    if (!w) return WF_ENULL;
    if (!wf__finite(t) || (slope && w->limit < 2)) return WF_EARG;
    m = w->columns;
    if (m > 0) {
        j = wf__find(w, t);
        if (j >= 0) return wf__push_stored(w, j, slope, behind);
        status = wf__next_time(w, t);
        if (status < 0) return status;
    }
    if (behind) return WF_EORDER;
    if (m + 1 + slope > w->capacity) return WF_EFULL;
    if (m > 0) w->step = t - wf__t(w)[m - 1];
    wf__append(w, t, 0);
    if (slope) wf__append(w, t, 0);
    wf__build(w, m);
    return m;
}

WF_API int wf_push(wf *w, double t)
{
    return wf__push(w, t, 0, 0);
}

WF_API int wf_push_hermite(wf *w, double t)
{
    return wf__push(w, t, 1, 0);
}

WF_API int wf_push_break(wf *w, double t)
{
    return wf__push(w, t, 0, 1);
}

WF_API int wf_push_break_hermite(wf *w, double t)
{
    return wf__push(w, t, 1, 1);
}

/* The newest sample: the value column of the last segment's last time. */
static int wf__newest(const wf *w)
{
    return w->columns - 1 - wf__is_slope(w, w->columns - 1);
}

WF_API int wf_pop(wf *w)
{
    if (!w) return WF_ENULL;
    if (wf__newest(w) <= w->start) return WF_EFEW;
    wf__cut(w, wf__newest(w));
    return WF_OK;
}

WF_API int wf_rollback(wf *w)
{
    int end;
    if (!w) return WF_ENULL;
    if (w->columns == 0) return WF_EFEW;
    /* its derivative, and the value behind a break, are columns of the same time */
    for (end = w->start + 1; end < w->columns; end++)
        if (wf__t(w)[end] > wf__t(w)[w->start]) break;
    wf__cut(w, end);
    return WF_OK;
}

/* The oldest column that a break does not part from this one, hidden or not. */
static int wf__oldest(const wf *w, int column)
{
    const int first = wf__places(w)[column].first;
    return first == w->hidden ? 0 : first;
}

/* The value column of the sample that is so many samples in front of the one at a column; at most
   back to wf__oldest. */
static int wf__older(const wf *w, int column, int samples)
{
    const int begin = wf__oldest(w, column);
    int k;
    for (k = 0; k < samples; k++) {
        if (column == begin) break;
        column -= 1 + wf__is_slope(w, column - 1);
    }
    return column;
}

/* Columns first .. end-1 are one segment. */
static void wf__join(wf *w, int first, int end)
{
    struct wf__place *place = wf__places(w);
    int j;
    for (j = first; j < end; j++) {
        place[j].first = first;
        place[j].swapped = 0;
    }
    place[first].count = end - first;
    place[first].slopes = wf__count_slopes(w, first, end - first);
}

/* Forget the columns in front of `first`.  What is left is one segment. */
static void wf__drop(wf *w, int first)
{
    const int count = w->columns - first;
    memmove(wf__t(w), wf__t(w) + first, (size_t)count * sizeof(double));
    w->columns = count;
    w->hidden = 0;
    w->limit = w->degree;
    wf__join(w, 0, count);
    wf__build(w, 0);
}

/* `count` columns from column `first` on move down to column 0. */
static void wf__move_down(int count, int first, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    int j;
    if (first == 0) return;
    for (j = 0; j < count; j++)
        memcpy(x + (ptrdiff_t)j * ldx, x + (ptrdiff_t)(first + j) * ldx,
               (size_t)n * sizeof(double));
}

WF_API int wf_advance(wf *w, int history, ptrdiff_t n, double *x, ptrdiff_t ldx)
{
    int first, last, status = wf__handle_and_arrays(w, n, x, ldx, x, ldx);
    if (status < 0) return status;
    if (history < 0) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    last = wf__newest(w);
    first = wf__older(w, last, history);
    if (last > w->start) w->length = wf__t(w)[last] - wf__t(w)[w->start];
    if (n > 0) wf__move_down(w->columns - first, first, n, x, ldx);
    w->start = last - first;
    wf__drop(w, first);
    return WF_OK;
}

/* Hide the columns in front of `first`: they become a segment of which no spline is made; first
   guesses still read its samples.  The window start
   belongs to the first segment of the grid, for wf_advance drops what lies before a break. */
static void wf__hide(wf *w, int first)
{
    const int own = wf__places(w)[w->start].first, end = own + wf__places(w)[own].count;
    wf__join(w, 0, first);
    wf__join(w, first, end);
    w->hidden = first;
}

WF_API int wf_restrict(wf *w, int degree, int history)
{
    if (!w) return WF_ENULL;
    if (degree < 0 || degree > w->degree || history < 0) return WF_EARG;
    if (w->columns == 0) return WF_EFEW;
    if (degree < 2 && wf__count_slopes(w, 0, w->columns) > 0) return WF_EARG;
    wf__hide(w, wf__older(w, w->start, history));
    w->limit = degree;
    wf__build(w, 0);
    return WF_OK;
}

WF_API int wf_copy(wf *to, const wf *from)
{
    if (!to || !from) return WF_ENULL;
    if (to == from) return WF_EARG;
    if (to->degree < 2 && wf__count_slopes(from, 0, from->columns) > 0) return WF_EARG;
    if (from->columns > to->capacity) return WF_EFULL;
    memcpy(wf__t(to), wf__t(from), (size_t)from->columns * sizeof(double));
    memcpy(wf__places(to), wf__places(from), (size_t)from->columns * sizeof(struct wf__place));
    to->columns = from->columns;
    to->start = from->start;
    to->hidden = from->hidden;
    to->limit = from->limit < from->degree ? wf__min_int(from->limit, to->degree) : to->degree;
    to->step = from->step;
    to->length = from->length;
    to->p = 0;
    if (to->columns > 0) wf__build(to, 0);
    return WF_OK;
}

WF_API int wf_columns(const wf *w)
{
    return w ? w->columns : WF_ENULL;
}

WF_API int wf_degree(const wf *w)
{
    return w ? w->p : WF_ENULL;
}

WF_API int wf_start(const wf *w)
{
    return w ? w->start : WF_ENULL;
}

WF_API double wf_time(const wf *w, int column)
{
    return w && column >= 0 && column < w->columns ? wf__t(w)[column] : wf__nan();
}

/* ---- long sweeps ----------------------------------------------------------------------------- */

/* One pass over the data: o = f (start + g_0 p_0 + ..), the terms added one after the other.  o may
   be start or among the p.  A sum begins with wf__nothing, -0, for -0 + x is x for every x, -0
   included. */
struct wf__pass {
    const double *start, *p[WF__TERMS];
    double g[WF__TERMS], f, *o;
    int terms, moves; /* moves: start is a column, not wf__nothing */
};

static const double wf__nothing[8] = {-0.0, -0.0, -0.0, -0.0, -0.0, -0.0, -0.0, -0.0};

/* Passes over the same n numbers, each of which may read what an earlier one has written. */
struct wf__passes {
    ptrdiff_t n;
    int count;
    struct wf__pass pass[WF__PASSES];
};

/* Vectors of any length give the same bits, for products are not fused with their sums: a compiler
   may fuse them in one loop and not in another. */
#if defined(__clang__)
#  pragma float_control(push)
#  pragma clang fp contract(off)
#elif defined(__GNUC__)
#  pragma GCC push_options
#  pragma GCC optimize("fp-contract=off")
#endif

/* clang-format off */
#if defined(__GNUC__) && FLT_EVAL_METHOD == 0
#  define WF__0(X, L)
#  define WF__1(X, L) X(0, L)
#  define WF__2(X, L) WF__1(X, L) X(1, L)
#  define WF__3(X, L) WF__2(X, L) X(2, L)
#  define WF__4(X, L) WF__3(X, L) X(3, L)
#  define WF__TERM(j, L)                                                                           \
    const double *p##j = pass->p[j];                                                               \
    const double g##j = pass->g[j];
#  define WF__ADD(j, L) t += g##j * *(const wf__load##L *)(p##j + i);
#  define WF__CASE(m, L)                                                                           \
    case m: {                                                                                      \
        WF__##m(WF__TERM, L)                                                                       \
        for (; i + L <= n; i += L, start += step) {                                                \
            wf__pack##L t = *(const wf__load##L *)start;                                           \
            WF__##m(WF__ADD, L)                                                                    \
            *(wf__load##L *)(o + i) = f * t;                                                       \
        }                                                                                          \
        break;                                                                                     \
    }
/* All passes from number `from` on, L at a time.  Returns the first number that is left. */
#  define WF__KERNEL(L, TARGET, CLEAN)                                                             \
    typedef double wf__pack##L __attribute__((vector_size(8 * L)));                                \
    typedef double wf__load##L __attribute__((vector_size(8 * L), aligned(8), may_alias));         \
    TARGET static ptrdiff_t wf__pass##L(ptrdiff_t from, ptrdiff_t n, int count,                    \
                                        const struct wf__pass *pass)                               \
    {                                                                                              \
        const struct wf__pass *end = pass + count;                                                 \
        ptrdiff_t i = from;                                                                        \
        for (; pass < end; pass++) {                                                               \
            const ptrdiff_t step = pass->moves * L;                                                \
            const double *start = pass->start + pass->moves * from, f = pass->f;                   \
            double *o = pass->o;                                                                   \
            i = from;                                                                              \
            switch (pass->terms) {                                                                 \
                WF__CASE(0, L)                                                                     \
                WF__CASE(1, L)                                                                     \
                WF__CASE(2, L)                                                                     \
                WF__CASE(3, L)                                                                     \
                WF__CASE(4, L)                                                                     \
            }                                                                                      \
        }                                                                                          \
        CLEAN                                                                                      \
        return i;                                                                                  \
    }
/* With upper halves in use the host's own vectors would run at a quarter of their speed. */
#  define WF__CLEAN __builtin_ia32_vzeroupper();
#  if defined(__AVX__)
WF__KERNEL(4, , )
#    define WF__NARROW wf__pass4
#  else
WF__KERNEL(2, , )
#    define WF__NARROW wf__pass2
#    if defined(__x86_64__)
WF__KERNEL(4, __attribute__((target("avx2"))), WF__CLEAN)
#      define WF__WIDE wf__pass4
#    endif
#  endif
#  if defined(__x86_64__) && (defined(__clang__) ? __clang_major__ >= 12 : __GNUC__ >= 8)
WF__KERNEL(8, __attribute__((target("avx512f"))), WF__CLEAN)
#    define WF__WIDER wf__pass8
#  endif
#endif
/* clang-format on */

/* The vectors of this processor.  Those of eight where it has vbmi2, which is to say where it need
   not lower its clock for them: Ice Lake, Zen 4 and later. */
static ptrdiff_t wf__vectors(ptrdiff_t i, ptrdiff_t n, int count, const struct wf__pass *pass)
{
    (void)n, (void)count, (void)pass; /* for a processor without vectors */
#ifdef WF__WIDER
    if (n - i >= WF__MANY && __builtin_cpu_supports("avx512vbmi2"))
        i = WF__WIDER(i, n, count, pass);
#endif
#ifdef WF__WIDE
    if (n - i >= WF__FEW && __builtin_cpu_supports("avx2")) i = WF__WIDE(i, n, count, pass);
#endif
#ifdef WF__NARROW
    if (i < n) i = WF__NARROW(i, n, count, pass);
#endif
    return i;
}

/* The numbers that no vector takes. */
static void wf__scalars(ptrdiff_t i, ptrdiff_t n, int count, const struct wf__pass *pass)
{
    int j, k;
    for (; i < n; i++)
        for (k = 0; k < count; k++) {
            double t = pass[k].start[pass[k].moves * i];
            for (j = 0; j < pass[k].terms; j++) t += pass[k].g[j] * pass[k].p[j][i];
            pass[k].o[i] = pass[k].f * t;
        }
}

/* Do all passes, strip by strip, so that what one writes is in cache when the next one reads it.
   The first strip ends where a line of the cache begins. */
static void wf__sweep(struct wf__passes *s)
{
    ptrdiff_t i, end, left;
    for (i = 0; i < s->n; i = end) {
        const int beyond = (int)((uintptr_t)(s->pass[0].o + i) / sizeof(double) % 8);
        /* a single pass reads nothing again: its second strip, now aligned, is all the rest */
        const int whole = i > 0 && s->count == 1;
        end = whole ? s->n : i + wf__up_to(s->n - i, WF__STRIP - beyond);
        left = wf__vectors(i, end, s->count, s->pass);
        wf__scalars(left, end, s->count, s->pass);
    }
    s->count = 0;
}

/* t - scale * sum of a_k c_k for one number, for which a list of passes would cost more than the
   sum. */
static double wf__minus(double t, double scale, int count, const double *a, const double *c,
                        ptrdiff_t ldc)
{
    for (; count > 0; count--, a++, c += ldc)
        if (fabs(*a) > 0) t += -*a * scale * *c;
    return t;
}

/* wf__sum for one number. */
static double wf__sum_one(int columns, const double *weight, double up, const double *x,
                          ptrdiff_t ldx)
{
    /* volatile: a compiler that knows this -0 drops the first addition.  Then clang fuses the first
       product with the second sum under -ffp-contract=fast, in spite of the pragma */
    volatile const double start = -0.0;
    const double down = 1 / up;
    for (; columns > 0; columns--, weight++, x += ldx)
        if (fabs(*weight) > 0) return up * wf__minus(start, -down, columns, weight, x, ldx);
    return 0;
}

#if defined(__clang__)
#  pragma float_control(pop)
#elif defined(__GNUC__)
#  pragma GCC pop_options
#endif

/* The next pass, into o; what has been gathered is done when there is no room. */
static struct wf__pass *wf__next_pass(struct wf__passes *s, const double *start, double *o)
{
    struct wf__pass *pass;
    if (s->count == WF__PASSES) wf__sweep(s);
    pass = &s->pass[s->count++];
    pass->start = start;
    pass->moves = start != wf__nothing;
    pass->o = o;
    pass->f = 1;
    pass->terms = 0;
    return pass;
}

/* To the pass the terms scale * weight[j] * column j, with further passes if there are many.  Zero
   weights are skipped, so a NaN there does no harm.  Returns the last pass. */
static struct wf__pass *wf__add_terms(struct wf__passes *s, struct wf__pass *pass, int columns,
                                      const double *weight, double scale, const double *x,
                                      ptrdiff_t ldx)
{
    int j, terms = pass->terms;
    for (j = 0; j < columns; j++, x += ldx) {
        if (!(fabs(weight[j]) > 0)) continue;
        if (terms == WF__TERMS) {
            pass->terms = terms;
            pass = wf__next_pass(s, pass->o, pass->o);
            terms = 0;
        }
        pass->p[terms] = x;
        pass->g[terms++] = weight[j] * scale; /* may underflow to 0; 0 NaN is NaN */
    }
    pass->terms = terms;
    return pass;
}

/* Ends a sum: the last pass multiplies it by f.  A sum without terms is -0; it is multiplied by -1,
   so that +0 comes out. */
static void wf__close_sum(struct wf__pass *pass, double f)
{
    pass->f = pass->terms + pass->moves > 0 ? f : -1;
}

/* A power of two above sum |weight|, at most 2^1022; 1 if the sum is at most 1 + 1e-6.  It is taken
   in units of 2^30, so that it does not overflow. */
static double wf__above(int columns, const double *weight)
{
    const double unit = 1073741824; /* 2^30 */
    double size = 0;
    int j, e;
    for (j = 0; j < columns; j++) size += fabs(weight[j]) / unit;
    if (size <= (1 + 1e-6) / unit) return 1; /* weights of means sum to 1 and a bit of round-off */
    (void)frexp(size, &e);
    return ldexp(1.0, wf__min_int(e + 30, 1022)); /* 2^-1022 is still a normal number */
}

/* out = sum of weight[j] * column j.  The weights are scaled by wf__above: as long as sum |weight|
   is below 2^1022, the sum overflows only if the result does, or nearly does. */
static void wf__sum(ptrdiff_t n, int columns, const double *weight, const double *x, ptrdiff_t ldx,
                    double *out)
{
    const double up = wf__above(columns, weight);
    struct wf__passes s;
    struct wf__pass *pass;
    ptrdiff_t i;
    if (n < WF__FEW) {
        for (i = 0; i < n; i++) out[i] = wf__sum_one(columns, weight, up, x + i, ldx);
        return;
    }
    s.n = n;
    s.count = 0;
    pass = wf__next_pass(&s, wf__nothing, out);
    wf__close_sum(wf__add_terms(&s, pass, columns, weight, 1 / up, x, ldx), up);
    wf__sweep(&s);
}

/* The same for a row of weights, on the columns it has. */
static void wf__sum_row(struct wf__row *row, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                        double *out)
{
    if (n == 0) return; /* x may be NULL */
    wf__sum(n, row->count, wf__entries(row), x + (ptrdiff_t)row->first * ldx, ldx, out);
}

/* out plus that sum: out is a further column, of weight 1. */
static void wf__add_sum_row(struct wf__row *row, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                            double *out)
{
    const double *weight = wf__entries(row), up = wf__above(row->count, weight), one = 1;
    struct wf__pass *pass;
    struct wf__passes s;
    s.n = n;
    s.count = 0;
    pass = wf__next_pass(&s, wf__nothing, out);
    pass = wf__add_terms(&s, pass, 1, &one, 1 / up, out, n);
    x += (ptrdiff_t)row->first * ldx;
    wf__close_sum(wf__add_terms(&s, pass, row->count, weight, 1 / up, x, ldx), up);
    wf__sweep(&s);
}

/* Does a number of x lie in the one column y?  y begins in front of x, behind it, or between two
   columns of x; only these two can reach it. */
static int wf__column_overlaps(ptrdiff_t n, int columns, const double *x, ptrdiff_t ldx,
                               const double *y)
{
    const ptrdiff_t size = (ptrdiff_t)sizeof(double), stride = ldx * size;
    const ptrdiff_t apart = (ptrdiff_t)((uintptr_t)y - (uintptr_t)x);
    ptrdiff_t j = apart > 0 ? wf__up_to(apart / stride, columns - 1) : 0, last;
    for (last = wf__up_to(j + 1, columns - 1); j <= last; j++) {
        const ptrdiff_t gap = apart - j * stride;
        if (gap < n * size && gap > -n * size) return 1;
    }
    return 0;
}

/* Bytes from the first number of some columns to the end of the last number. */
static uintptr_t wf__bytes(ptrdiff_t n, int columns, ptrdiff_t ld)
{
    return ((uintptr_t)(columns - 1) * (uintptr_t)ld + (uintptr_t)n) * sizeof(double);
}

/* Does a number of x lie in y?  Judged by numbers, so columns may be interleaved. */
static int wf__overlap(ptrdiff_t n, int columns, const double *x, ptrdiff_t ldx, int count,
                       const double *y, ptrdiff_t ldy)
{
    const uintptr_t from = (uintptr_t)x, to = (uintptr_t)y;
    int k;
    if (n == 0) return 0;
    if (from + wf__bytes(n, columns, ldx) <= to || to + wf__bytes(n, count, ldy) <= from) return 0;
    for (k = 0; k < count; k++)
        if (wf__column_overlaps(n, columns, x, ldx, y + (ptrdiff_t)k * ldy)) return 1;
    return 0;
}

/* WF_OK, or why a call cannot read the columns of x, or of coefficients, and write n numbers. */
static int wf__arrays(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, const double *out)
{
    const int status = wf__handle_and_arrays(w, n, x, ldx, out, n);
    if (status < 0) return status;
    return wf__overlap(n, w->columns, x, ldx, 1, out, n) ? WF_EOVERLAP : WF_OK;
}

/* ---- where a time lies ----------------------------------------------------------------------- */

struct wf__site {
    struct wf__segment g;
    double t, s; /* time and scaled time; beyond an end by round-off it is the end */
    int deriv, behind, remark;
};

/* No break among the columns that take part. */
static int wf__unbroken(const wf *w)
{
    return wf__places(w)[w->columns - 1].first == w->hidden;
}

/* A column of the segment that serves time t.  At a break t is the stored time, see wf__snap. */
static int wf__owner(const wf *w, double t, int behind)
{
    const double *T = wf__t(w);
    int j;
    if (wf__unbroken(w)) return w->hidden;
    j = wf__min_int(wf__max_int(wf__lower_bound(w, t), w->hidden), w->columns - 1);
    if (!behind) return j;
    while (j + 1 < w->columns && !(T[j + 1] > t)) j++;
    return j;
}

/* t; but the end of the grid if t lies beyond it by round-off alone, and the time of a break if t
   is within round-off of it, on either side.  At a break WF_BEHIND decides which value is meant. */
static double wf__snap(const wf *w, double t)
{
    const double *T = wf__t(w), begin = T[w->hidden];
    const int last = w->columns - 1;
    int j;
    if (t < begin) return begin - t <= wf__tolerance(w, t) ? begin : t;
    if (t > T[last]) return t - T[last] <= wf__tolerance(w, t) ? T[last] : t;
    if (wf__unbroken(w)) return t;
    j = wf__find(w, t);
    return j >= 0 && wf__places(w)[wf__owner(w, T[j], 1)].first > j ? T[j] : t;
}

/* Where a time lies.  Returns an error or WF_OK; the remark, WF_EXTRAP or none, is left in the site
   for wf__remark. */
static int wf__locate(const wf *w, double t, int deriv, struct wf__site *at)
{
    const double *T = wf__t(w);
    const int m = w->columns;
    if (!wf__finite(t) || deriv < 0) return WF_EARG;
    if (m == 0) return WF_EFEW;
    t = wf__snap(w, t);
    at->behind = deriv >= WF_BEHIND;
    at->deriv = deriv - (at->behind ? WF_BEHIND : 0);
    at->g = wf__segment_of(w, wf__owner(w, t, at->behind));
    at->s = (t - w->origin) * w->down;
    at->t = t;
    at->remark = t < T[w->hidden] || t > T[m - 1] ? WF_EXTRAP : WF_OK;
    return wf__finite(at->s) ? WF_OK : WF_ERANGE;
}

/* The basis at a site: values or derivatives N[0..p] of the functions of columns first ..; all
   0 for a derivative above the degree. */
static int wf__basis(const wf *w, const struct wf__site *at, int *first, double *N)
{
    const struct wf__segment *g = &at->g;
    int k;
    if (at->deriv > g->p) {
        *first = g->first;
        wf__clear(g->p + 1, N);
        return WF_OK;
    }
    if (at->deriv == 0 && g->p > 0) { /* continuous */
        *first = g->first + wf__values(g, at->s, N);
    } else {
        k = at->deriv < g->p
                ? wf__span(g, at->s)
                : wf__span_beside(g, at->s, wf__tolerance(w, at->t) * w->down, at->behind);
        wf__splines(g, k, at->s, at->deriv, w->down, N);
        *first = g->first + k - g->p;
    }
    return wf__all_finite(g->p + 1, N) ? WF_OK : WF_ERANGE;
}

/* The column that holds what is asked for, because the site is a stored time; or -1. */
static int wf__stored(const wf *w, const struct wf__site *at)
{
    const struct wf__segment *g = &at->g;
    const int low = wf__first_not_below(g->count - 1, g->s, at->s);
    const int jumps = g->p == 0 && at->behind && low > 0; /* there the next sample holds */
    if (!wf__same(g->s[low], at->s)) return -1;
    if (at->deriv == 0 && !jumps) return g->first + low;
    return at->deriv == 1 && wf__is_slope(w, g->first + low + 1) ? g->first + low + 1 : -1;
}

/* The row of weights on samples at a site. */
static int wf__weights(const wf *w, const struct wf__site *at, struct wf__row *row)
{
    const struct wf__segment *g = &at->g;
    const int column = wf__stored(w, at);
    double N[WF__ORDER];
    int first, status;
    if (column >= 0) {
        wf__open_row(g, column, column, row);
        *wf__entries(row) = 1;
        return WF_OK;
    }
    status = wf__basis(w, at, &first, N);
    if (status < 0) return status;
    wf__open_row(g, first, first + g->p, row);
    memcpy(wf__entries(row), N, (size_t)(g->p + 1) * sizeof(double));
    wf__to_samples(w, g, WF__EXACT, row);
    return wf__all_finite(row->count, wf__entries(row)) ? WF_OK : WF_ERANGE;
}

/* What wf_weights and wf_interpolate need, and their status. */
static int wf__sample_row(const wf *w, double t, int deriv, struct wf__row *row)
{
    struct wf__site at;
    int status = wf__locate(w, t, deriv, &at);
    if (status == WF_OK) status = wf__weights(w, &at, row);
    if (status < 0) return status;
    if (at.remark == WF_OK && at.deriv == 0 && row->count > 1) { /* a lone weight is 1 */
        const double unit = wf__slope_unit(w, &at.g);
        if (wf__noise_of(w, unit, row) > WF__NOISE) at.remark = WF_NOISY;
    }
    return wf__remark(w, at.remark);
}

/* ---- evaluation: weights --------------------------------------------------------------------- */

WF_API int wf_weights(const wf *w, double t, int deriv, double *weight)
{
    struct wf__row row;
    int status;
    if (!w || !weight) return WF_ENULL;
    status = wf__sample_row(w, t, deriv, &row);
    if (status < 0) return status;
    wf__clear(w->columns, weight);
    memcpy(weight + row.first, wf__entries(&row), (size_t)row.count * sizeof(double));
    return status;
}

WF_API int wf_basis(const wf *w, double t, int deriv, int *first, double *weight)
{
    struct wf__site at;
    double N[WF__ORDER];
    int status, start;
    if (!w || !first || !weight) return WF_ENULL;
    status = wf__locate(w, t, deriv, &at);
    if (status == WF_OK) status = wf__basis(w, &at, &start, N);
    if (status < 0) return status;
    status = wf__remark(w, at.remark);
    if (status < 0) return status;
    /* a short segment at the end: zeros in front of its weights */
    *first = wf__min_int(start, w->columns - 1 - w->p);
    wf__clear(w->p + 1, weight);
    memcpy(weight + (start - *first), N, (size_t)(at.g.p + 1) * sizeof(double));
    return status;
}

/* ---- evaluation: sweeps ---------------------------------------------------------------------- */

WF_API int wf_interpolate(const wf *w, double t, int deriv, ptrdiff_t n, const double *x,
                          ptrdiff_t ldx, double *out)
{
    struct wf__row row;
    int status = wf__arrays(w, n, x, ldx, out);
    if (status == WF_OK) status = wf__sample_row(w, t, deriv, &row);
    if (status >= 0) wf__sum_row(&row, n, x, ldx, out);
    return status;
}

/* Rows of a block of so many columns: WF__BLOCK doubles, so that it stays in cache, but 256 rows at
   least. */
static ptrdiff_t wf__block_rows(ptrdiff_t left, int columns)
{
    return wf__up_to(left, wf__max_int(WF__BLOCK / columns, 256));
}

/* One row of weights needs no second look at x; more are applied to a block of rows that stays
   in cache. */
static void wf__combine(int count, int columns, const double *weight, ptrdiff_t n, const double *x,
                        ptrdiff_t ldx, double *y, ptrdiff_t ldy)
{
    ptrdiff_t i, rows;
    int j;
    for (i = 0; i < n; i += rows) {
        rows = count > 1 ? wf__block_rows(n - i, columns) : n;
        for (j = 0; j < count; j++)
            wf__sum(rows, columns, weight + (ptrdiff_t)j * columns, x + i, ldx,
                    y + (ptrdiff_t)j * ldy + i);
    }
}

WF_API int wf_combine(int count, int columns, const double *weight, ptrdiff_t n, const double *x,
                      ptrdiff_t ldx, double *y, ptrdiff_t ldy)
{
    int j, status = wf__array(n, x, ldx);
    if (status < 0) return status;
    if (count < 0 || columns < 1 || ldy < n) return WF_EARG;
    if (count == 0) return WF_OK;
    if (!weight || (n > 0 && !y)) return WF_ENULL;
    if (wf__overlap(n, columns, x, ldx, count, y, ldy)) return WF_EOVERLAP;
    for (j = 0; j < count; j++)
        if (!wf__all_finite(columns, weight + (ptrdiff_t)j * columns)) return WF_ERANGE;
    wf__combine(count, columns, weight, n, x, ldx, y, ldy);
    return WF_OK;
}

/* Exchange the columns whose rows are exchanged in the factors. */
static void wf__swap_columns(const wf *w, ptrdiff_t n, double *c, ptrdiff_t ldc)
{
    ptrdiff_t i;
    int j;
    for (j = w->hidden; j < w->columns; j++) {
        double *a = c + (ptrdiff_t)j * ldc, *b = a + ldc;
        if (!wf__places(w)[j].swapped) continue;
        for (i = 0; i < n; i++) {
            const double v = a[i];
            a[i] = b[i];
            b[i] = v;
        }
    }
}

/* The column for row r of the factors, and the unit of its samples. */
static int wf__column_and_unit(const wf *w, int slopes, int r, double *unit)
{
    const int column = slopes ? wf__column_of_row(w, r) : r;
    *unit = slopes && wf__is_slope(w, column) ? ldexp(1.0, w->exponent) : 1;
    return column;
}

/* Rows of L c' = x: c'_r = own x_r - sum of l_rk c'_k, k < r, where own is the unit of a
   derivative, else 1.  Where own > 1, own (x_r - sum of l_rk c'_k / own), because own x_r may
   overflow. */
static void wf__fit_down(const wf *w, const struct wf__segment *g, struct wf__passes *s,
                         const double *x, ptrdiff_t ldx, double *c, ptrdiff_t ldc)
{
    const int band = wf__band(g->p), slopes = wf__places(w)[g->first].slopes;
    int r;
    for (r = g->first; r < g->first + g->count; r++) {
        const int back = wf__min_int(band, r - g->first);
        double own, *o = c + (ptrdiff_t)r * ldc;
        const int column = wf__column_and_unit(w, slopes, r, &own);
        const double *start = x + (ptrdiff_t)(x == c ? r : column) * ldx; /* see wf__swap_columns */
        const double outer = wf__max(own, 1);
        struct wf__pass *pass = wf__next_pass(s, own < 1 ? wf__nothing : start, o);
        if (own < 1) pass = wf__add_terms(s, pass, 1, &own, 1, start, ldx);
        pass = wf__add_terms(s, pass, back, wf__lu(w, r) - back, -1 / outer, o - back * ldc, ldc);
        pass->f = outer;
    }
}

/* Rows of U c = c' in place: c_r = 1 / u_rr (c_r - sum of u_rk c_k), k > r. */
static void wf__fit_up(const wf *w, const struct wf__segment *g, struct wf__passes *s, double *c,
                       ptrdiff_t ldc)
{
    const int band = wf__band(g->p), end = g->first + g->count;
    int r;
    for (r = end - 1; r >= g->first; r--) {
        const int ahead = wf__min_int(band, end - 1 - r);
        const double *u = wf__lu(w, r);
        double *o = c + (ptrdiff_t)r * ldc;
        struct wf__pass *pass = wf__next_pass(s, o, o);
        pass = wf__add_terms(s, pass, ahead, u + 1, -1, o + ldc, ldc);
        pass->f = 1 / u[0];
    }
}

#if defined(__GNUC__) && !defined(__clang__) /* as wf__minus, else not inlined here */
#  pragma GCC push_options
#  pragma GCC optimize("fp-contract=off")
#endif

/* wf__fit_down and wf__fit_up for one number. */
static void wf__fit_one(const wf *w, const struct wf__segment *g, int in_place, const double *x,
                        ptrdiff_t ldx, double *c, ptrdiff_t ldc)
{
    const int band = wf__band(g->p), width = wf__width(w->degree);
    const int slopes = wf__places(w)[g->first].slopes;
    const double *a = wf__lu(w, g->first);
    double *to = c + (ptrdiff_t)g->first * ldc, unit;
    int r;
    for (r = 0; r < g->count; r++, a += width, to += ldc) { /* L */
        const int back = wf__min_int(r, band), row = g->first + r;
        const int column = wf__column_and_unit(w, slopes, row, &unit);
        const double outer = wf__max(unit, 1), inner = unit / outer; /* see wf__fit_down */
        const double own = inner * x[(ptrdiff_t)(in_place ? row : column) * ldx];
        *to = outer * wf__minus(own, 1 / outer, back, a - back, to - back * ldc, ldc);
    }
    if (band == 0) return;
    for (r = 0; r < g->count; r++) { /* U, from the last row up: r rows lie behind */
        a -= width;
        to -= ldc;
        *to = 1 / a[0] * wf__minus(*to, 1, wf__min_int(r, band), a + 1, to + ldc, ldc);
    }
}

#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC pop_options
#endif

static void wf__fit_rows(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c,
                         ptrdiff_t ldc)
{
    struct wf__passes s;
    ptrdiff_t i;
    int f;
    if (x == c) wf__swap_columns(w, n, c, ldc);
    s.n = n;
    s.count = 0;
    for (f = w->hidden; f < w->columns; f += wf__places(w)[f].count) {
        const struct wf__segment g = wf__segment_of(w, f);
        if (n >= WF__FEW) {
            wf__fit_down(w, &g, &s, x, ldx, c, ldc);
            if (g.p > 1) wf__fit_up(w, &g, &s, c, ldc);
            continue;
        }
        for (i = 0; i < n; i++) wf__fit_one(w, &g, x == c, x + i, ldx, c + i, ldc);
    }
    if (s.count > 0) wf__sweep(&s);
}

/* The status of a fit: WF_ERANGE where its sums might overflow; WF_NOISY where |A^-1| is above
   2^p WF__NOISE somewhere and the noise constant, which costs more and is asked last, above
   WF__NOISE. */
static int wf__judge(const wf *w)
{
    int f, loud = 0;
    for (f = w->hidden; f < w->columns; f += wf__places(w)[f].count) {
        const struct wf__segment g = wf__segment_of(w, f);
        const double norm = wf__inverse_norm(w, &g);
        if (norm > WF__HOPELESS) return WF_ERANGE;
        loud |= norm > ldexp(WF__NOISE, g.p);
    }
    loud = loud && wf__worst_noise(w, WF__NOISE) > WF__NOISE;
    return wf__remark(w, loud ? WF_NOISY : WF_OK);
}

WF_API int wf_fit(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *c,
                  ptrdiff_t ldc)
{
    ptrdiff_t i, rows;
    int status = wf__handle_and_arrays(w, n, x, ldx, c, ldc);
    if (status < 0) return status;
    if (w->columns == 0) return WF_EFEW;
    if (!(x == c && ldx == ldc) && wf__overlap(n, w->columns, x, ldx, w->columns, c, ldc))
        return WF_EOVERLAP;
    status = wf__judge(w);
    if (status < 0) return status;
    for (i = 0; i < n; i += rows) {
        /* roughly, more passes than are gathered: by blocks that stay in cache in between */
        rows = 2 * w->columns > WF__PASSES ? wf__block_rows(n - i, w->columns) : n;
        wf__fit_rows(w, rows, x + i, ldx, c + i, ldc);
    }
    return status;
}

WF_API int wf_eval(const wf *w, double t, int deriv, ptrdiff_t n, const double *c, ptrdiff_t ldc,
                   double *out)
{
    struct wf__site at;
    double N[WF__ORDER];
    int status = wf__arrays(w, n, c, ldc, out), first;
    if (status == WF_OK) status = wf__locate(w, t, deriv, &at);
    if (status == WF_OK) status = wf__basis(w, &at, &first, N);
    if (status == WF_OK) status = wf__remark(w, at.remark);
    if (status < 0 || n == 0) return status; /* c may be NULL */
    wf__sum(n, at.g.p + 1, N, c + (ptrdiff_t)first * ldc, ldc, out);
    return status;
}

/* What is needed at one time: the stored column that is the answer, or -1 and the basis. */
struct wf__target {
    int stored, first, count;
    double N[WF__ORDER];
};

static int wf__aim(const wf *w, double t, int deriv, struct wf__target *target)
{
    struct wf__site at;
    int status = wf__locate(w, t, deriv, &at);
    if (status < 0) return status;
    target->stored = wf__stored(w, &at);
    target->count = at.g.p + 1;
    if (target->stored < 0) status = wf__basis(w, &at, &target->first, target->N);
    if (status < 0) return status;
    return wf__remark(w, at.remark);
}

/* Column j of `to` asks `from` for this derivative.  At the first time of a segment behind a break
   it asks for the limit from the right.  There T[first] repeats the time of the column in front.
   (Where wf_restrict has cut, T[first] is later than that.) */
static int wf__asked(const wf *to, int j)
{
    const double *T = wf__t(to);
    const int first = wf__places(to)[j].first;
    const int behind = first > 0 && !(T[first] < T[j]) && !(T[first - 1] < T[first]);
    return wf__is_slope(to, j) + (behind ? WF_BEHIND : 0);
}

/* By coefficients of a few rows at a time, kept in `c`. */
static void wf__resample_rows(const wf *from, const wf *to, ptrdiff_t n, const double *x,
                              ptrdiff_t ldx, double *y, ptrdiff_t ldy, double *c)
{
    struct wf__target target;
    int j;
    wf__fit_rows(from, n, x, ldx, c, n);
    for (j = 0; j < to->columns; j++) {
        double *out = y + (ptrdiff_t)j * ldy;
        wf__aim(from, wf__t(to)[j], wf__asked(to, j), &target);
        if (target.stored < 0) wf__sum(n, target.count, target.N, c + target.first * n, n, out);
        else memcpy(out, x + (ptrdiff_t)target.stored * ldx, (size_t)n * sizeof(double));
    }
}

/* The status of asking for all times of `to`. */
static int wf__resample_status(const wf *from, const wf *to)
{
    struct wf__target target;
    int status = wf__judge(from), j;
    for (j = 0; j < to->columns; j++)
        status = wf__worse(status, wf__aim(from, wf__t(to)[j], wf__asked(to, j), &target));
    return status;
}

/* For a long grid: a row of weights for every time, which is short beside the grid.  Of a row only
   WF_ERANGE counts, and it is asked for before y is touched.  Its WF_NOISY does not: wf__judge has
   told that of the window, and the history is not judged.  (WF_ENOISY, with WF_STRICT 2, fills the
   row all the same.) */
static int wf__resample_long(const wf *from, const wf *to, ptrdiff_t n, const double *x,
                             ptrdiff_t ldx, double *y, ptrdiff_t ldy)
{
    struct wf__row row;
    int j;
    for (j = 0; j < to->columns; j++)
        if (wf__sample_row(from, wf__t(to)[j], wf__asked(to, j), &row) == WF_ERANGE)
            return WF_ERANGE;
    for (j = 0; j < to->columns; j++) {
        wf__sample_row(from, wf__t(to)[j], wf__asked(to, j), &row);
        wf__sum_row(&row, n, x, ldx, y + (ptrdiff_t)j * ldy);
    }
    return WF_OK;
}

WF_API int wf_resample(const wf *from, const wf *to, ptrdiff_t n, const double *x, ptrdiff_t ldx,
                       double *y, ptrdiff_t ldy)
{
    double c[WF__STACK];
    ptrdiff_t i, rows;
    int status = wf__handle_and_arrays(from, n, x, ldx, y, ldy);
    if (status < 0) return status;
    if (!to) return WF_ENULL;
    if (from->columns == 0) return WF_EFEW;
    if (wf__overlap(n, from->columns, x, ldx, to->columns, y, ldy)) return WF_EOVERLAP;
    status = wf__resample_status(from, to);
    if (status < 0) return status;
    if (from->columns > WF__STACK / WF__FEW) { /* coefficients of so few rows gain nothing */
        return wf__worse(wf__resample_long(from, to, n, x, ldx, y, ldy), status);
    }
    for (i = 0; i < n; i += rows) {
        rows = wf__up_to(n - i, WF__STACK / from->columns);
        wf__resample_rows(from, to, rows, x + i, ldx, y + i, ldy, c);
    }
    return status;
}

/* ---- integrals ------------------------------------------------------------------------------- */

/* Gauss-Legendre points and weights on [0, 1], exact for degree 2 count - 1; Newton's method on
   the Legendre polynomial from the usual first guess, which needs five steps at most. */
static void wf__gauss(int count, double *point, double *weight)
{
    int i, k, pass;
    for (i = 0; i < count; i++) {
        double x = cos(3.14159 * (i + 0.75) / (count + 0.5)), slope = 1;
        for (pass = 0; pass < 6; pass++) {
            double a = 1, b = x;
            for (k = 2; k <= count; k++) {
                const double next = ((2 * k - 1) * x * b - (k - 1) * a) / k;
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

/* The segment that scaled time s lies in; at a break, the one that begins there. */
static struct wf__segment wf__segment_at(const wf *w, double s)
{
    int low = w->hidden, high = w->columns - 1;
    while (low < high) { /* the last column not behind s */
        const int mid = low + (high - low + 1) / 2;
        if (wf__s(w)[mid] <= s) low = mid;
        else high = mid - 1;
    }
    return wf__segment_of(w, low);
}

/* The polynomial piece that starts at s ends at the next knot or break, or at `end` if that
   comes first. */
static double wf__piece(const wf *w, double s, double end)
{
    const struct wf__segment g = wf__segment_at(w, s);
    int low = g.p, high = g.count, mid;
    while (low < high) { /* the first knot above s, or the last one */
        mid = low + (high - low) / 2;
        if (wf__knot(&g, mid) > s) high = mid;
        else low = mid + 1;
    }
    return wf__knot(&g, low) > s && wf__knot(&g, low) < end ? wf__knot(&g, low) : end;
}

/* A mean, piece by piece, by Gauss' rule.  `at` is where the next piece begins: it moves from the
   smaller of the two times up to the larger one, `end`. */
struct wf__mean {
    struct wf__segment a; /* of time a, and the basis there: the mean where a == b */
    int first;
    double N[WF__ORDER];
    double at, end, length; /* scaled times */
    int count; /* of Gauss' points: exact to degree 2 count - 1, which is p or more */
    double point[WF__ORDER], gauss[WF__ORDER];
};

static int wf__open_mean(const wf *w, double a, double b, struct wf__mean *M)
{
    struct wf__site at[2];
    int status, worst = WF_OK, k;
    for (k = 1; k >= 0; k--) { /* that of a stays in M */
        status = wf__locate(w, k == 0 ? a : b, 0, &at[k]);
        /* outside the grid the basis grows with the distance, so the two ends tell: a basis that
           would overflow is refused here; weights on samples that would, in wf__mean_row */
        if (status == WF_OK) status = wf__basis(w, &at[k], &M->first, M->N);
        if (status < 0) return status;
        worst = wf__worse(at[k].remark, worst);
    }
    M->at = wf__min(at[0].s, at[1].s);
    M->end = wf__max(at[0].s, at[1].s);
    M->length = M->end - M->at;
    M->a = at[0].g;
    M->count = 0;
    return wf__finite(M->length) ? wf__remark(w, worst) : WF_ERANGE;
}

/* Add the piece from M->at to `next`, which lies in span k, to the row. */
static void wf__add_piece(const struct wf__segment *g, int k, double next, const struct wf__mean *M,
                          struct wf__row *row)
{
    const double length = next - M->at;
    double N[WF__ORDER], *v = row->weight + (g->first + k - g->p - row->origin);
    int i, q;
    for (q = 0; q < M->count; q++) {
        wf__splines(g, k, M->at + M->point[q] * length, 0, 1, N);
        for (i = 0; i <= g->p; i++) v[i] += M->gauss[q] * (length / M->length) * N[i];
    }
}

/* The row, on coefficients, of the next part of the mean: the pieces from M->at on within one
   segment and WF__GATHER + p + 1 columns.  Moves M->at to where it ends. */
static struct wf__segment wf__mean_part(const wf *w, struct wf__mean *M, struct wf__row *row)
{
    const struct wf__segment g = wf__segment_at(w, M->at);
    const int last = g.first + g.count - 1, points = g.p / 2 + 1;
    /* wf__span gives a knot to the span that ends there; a piece begins here: ask a bit later */
    const int first = g.first + wf__span(&g, nextafter(M->at, M->end)) - g.p;
    wf__open_row(&g, first, wf__min_int(last, first + WF__GATHER + g.p), row);
    wf__clear(row->count, wf__entries(row));
    if (M->count != points) wf__gauss(points, M->point, M->gauss);
    M->count = points; /* the next segment may have another degree */
    while (M->at < M->end) {
        const double next = wf__piece(w, M->at, M->end);
        const int k = wf__span(&g, next); /* the knot at the end of the piece is of its span */
        if (g.first + k - g.p > first + WF__GATHER) break;
        wf__add_piece(&g, k, next, M, row);
        M->at = next;
        /* the segment ends: the next part is of the next one or, where there is none, of this */
        if (!(next < g.s[g.count - 1])) break;
    }
    return g;
}

/* The row of the next part of the mean, on samples or on coefficients; WF_OK or WF_ERANGE.  The
   mean of an empty interval is the value there. */
static int wf__mean_row(const wf *w, struct wf__mean *M, int samples, struct wf__row *row)
{
    const struct wf__segment g = M->length > 0 ? wf__mean_part(w, M, row) : M->a;
    if (!(M->length > 0)) {
        wf__open_row(&g, M->first, M->first + g.p, row);
        memcpy(wf__entries(row), M->N, (size_t)(g.p + 1) * sizeof(double));
    }
    if (samples) wf__to_samples(w, &g, WF__EXACT, row);
    return wf__all_finite(row->count, wf__entries(row)) ? WF_OK : WF_ERANGE;
}

static int wf__mean_weights(const wf *w, double a, double b, int samples, double *weight)
{
    struct wf__mean M;
    struct wf__row row;
    int status, j;
    if (!w || !weight) return WF_ENULL;
    status = wf__open_mean(w, a, b, &M);
    if (status < 0) return status;
    wf__clear(w->columns, weight);
    do {
        if (wf__mean_row(w, &M, samples, &row) < 0) return WF_ERANGE;
        for (j = 0; j < row.count; j++) weight[row.first + j] += wf__entries(&row)[j];
    } while (M.at < M.end);
    return status;
}

WF_API int wf_weights_mean(const wf *w, double a, double b, double *weight)
{
    return wf__mean_weights(w, a, b, 1, weight);
}

WF_API int wf_basis_mean(const wf *w, double a, double b, double *weight)
{
    return wf__mean_weights(w, a, b, 0, weight);
}

static int wf__apply_mean(const wf *w, double a, double b, int samples, ptrdiff_t n,
                          const double *x, ptrdiff_t ldx, double *out)
{
    struct wf__mean M;
    struct wf__row row;
    int status = wf__arrays(w, n, x, ldx, out), add = 0;
    if (status == WF_OK) status = wf__open_mean(w, a, b, &M);
    if (status < 0) return status;
    do {
        if (wf__mean_row(w, &M, samples, &row) < 0) return WF_ERANGE;
        if (n == 0) continue; /* x may be NULL */
        if (add) wf__add_sum_row(&row, n, x, ldx, out);
        else wf__sum_row(&row, n, x, ldx, out);
        add = 1;
    } while (M.at < M.end);
    return status;
}

WF_API int wf_interpolate_mean(const wf *w, double a, double b, ptrdiff_t n, const double *x,
                               ptrdiff_t ldx, double *out)
{
    return wf__apply_mean(w, a, b, 1, n, x, ldx, out);
}

WF_API int wf_eval_mean(const wf *w, double a, double b, ptrdiff_t n, const double *c,
                        ptrdiff_t ldc, double *out)
{
    return wf__apply_mean(w, a, b, 0, n, c, ldc, out);
}

/* ---- projection ------------------------------------------------------------------------------ */

/* The scaled time s of `from` in the scaled time of `to`: of the origins only the difference
   enters. */
static double wf__rescale(const wf *from, const wf *to, double s)
{
    return ldexp(s, from->exponent - to->exponent) +
           ldexp(from->origin - to->origin, -to->exponent);
}

/* The basis at scaled time s, hardly ever a knot; returns its first column. */
static int wf__inner_basis(const wf *w, double s, double *N, int *p)
{
    const struct wf__segment g = wf__segment_at(w, s);
    const int k = wf__span(&g, s);
    wf__splines(&g, k, s, 0, 1, N);
    *p = g.p;
    return g.first + k - g.p;
}

/* With T_i the functions of `to` and F_j those of `from`: add the integrals of T_i T_k over [a, b]
   to the band G (entry (i, k), k >= i, at i (p+1) + k - i), and those of T_i F_j to the rows of M;
   a and b are scaled times of `to`. */
static void wf__products(const wf *from, const wf *to, double a, double b, double *G, double *M)
{
    double point[WF__ORDER], gauss[WF__ORDER], N[WF__ORDER], F[WF__ORDER];
    const int p = to->p, count = (wf__max_int(from->p, p) + p) / 2 + 1;
    int q, i, k, first, other, pn, pf;
    wf__gauss(count, point, gauss);
    for (q = 0; q < count; q++) {
        const double s = a + point[q] * (b - a), g = gauss[q] * (b - a);
        first = wf__inner_basis(to, s, N, &pn);
        other = wf__inner_basis(from, wf__rescale(to, from, s), F, &pf);
        for (i = 0; i <= pn; i++) {
            for (k = i; k <= pn; k++) G[(first + i) * (p + 1) + k - i] += g * N[i] * N[k];
            for (k = 0; k <= pf; k++)
                M[(ptrdiff_t)(first + i) * from->columns + other + k] += g * N[i] * F[k];
        }
    }
}

/* G and M over the pieces on which both splines are polynomials. */
static void wf__gram(const wf *from, const wf *to, double *G, double *M)
{
    const double end = wf__s(to)[to->columns - 1];
    double a, b, knot, last;
    for (a = wf__s(to)[0]; a < end; a = b) {
        b = wf__piece(to, a, end);
        last = wf__rescale(to, from, b);
        knot = wf__piece(from, wf__rescale(to, from, a), last);
        if (knot < last) b = wf__rescale(from, to, knot);
        /* rounded to the scale of `to` the knot is `a`: the next double lies beyond it */
        if (!(b > a)) b = nextafter(a, end);
        if (!(b > a)) b = DBL_MIN; /* next to 0 where denormal numbers count as 0 */
        wf__products(from, to, a, b, G, M);
    }
}

/* M := G^-1 M with G = L D L' made in place, m rows of `count` numbers. */
static void wf__solve_gram(int m, int p, int count, double *G, double *M)
{
    int r, j, k;
    for (r = 0; r < m; r++)
        for (k = 1; k <= p && r + k < m; k++) {
            const double l = G[r * (p + 1) + k] / G[r * (p + 1)];
            for (j = k; j <= p; j++) G[(r + k) * (p + 1) + j - k] -= l * G[r * (p + 1) + j];
            wf__add_row(count, -l, M + (ptrdiff_t)r * count, M + (ptrdiff_t)(r + k) * count);
        }
    for (r = m - 1; r >= 0; r--) {
        double *row = M + (ptrdiff_t)r * count;
        for (k = 1; k <= p && r + k < m; k++)
            wf__add_row(count, -G[r * (p + 1) + k], row + (ptrdiff_t)k * count, row);
        wf__scale_row(count, 1 / G[r * (p + 1)], row);
    }
}

/* M holds a row for each coefficient of `to`, which has no derivatives: M := L U M makes it one for
   each sample. */
static void wf__multiply(const wf *to, int count, double *M)
{
    int r, k;
    for (r = 0; r < to->columns; r++) {
        const struct wf__segment g = wf__segment_of(to, r);
        double *row = M + (ptrdiff_t)r * count;
        wf__scale_row(count, wf__lu(to, r)[0], row);
        for (k = 1; k < g.p && r + k < g.first + g.count; k++)
            wf__add_row(count, wf__lu(to, r)[k], row + (ptrdiff_t)k * count, row);
    }
    for (r = to->columns - 1; r >= 0; r--) {
        const struct wf__segment g = wf__segment_of(to, r);
        double *row = M + (ptrdiff_t)r * count;
        for (k = 1; k < g.p && r - k >= g.first; k++)
            wf__add_row(count, wf__lu(to, r)[-k], row - (ptrdiff_t)k * count, row);
    }
}

/* WF_OK, or why `to` cannot hold a projection. */
static int wf__project_to(const wf *to)
{
    int f;
    if (to->hidden > 0) return WF_EARG;
    for (f = 0; f < to->columns; f += wf__places(to)[f].count) {
        if (wf__places(to)[f].slopes) return WF_EARG;
        if (wf__places(to)[f].degree < 1) return WF_EFEW;
    }
    return WF_OK;
}

/* The status of asking `from` for the interval of `to`. */
static int wf__covers(const wf *from, const wf *to)
{
    struct wf__site site;
    int end, status, remark = WF_OK;
    for (end = 0; end < 2; end++) {
        status = wf__locate(from, wf__t(to)[end ? to->columns - 1 : 0], 0, &site);
        if (status < 0) return status;
        remark = wf__worse(remark, site.remark);
    }
    return wf__remark(from, remark);
}

WF_API int wf_project(const wf *from, const wf *to, double *weight, double *work)
{
    int m, mf, status, r;
    if (!from || !to || !weight || !work) return WF_ENULL;
    m = to->columns;
    mf = from->columns;
    if (mf == 0 || m == 0) return WF_EFEW;
    status = wf__project_to(to);
    if (status == WF_OK) status = wf__covers(from, to);
    if (status < 0) return status;
    if ((uintptr_t)work < (uintptr_t)(weight + (ptrdiff_t)m * mf) &&
        (uintptr_t)weight < (uintptr_t)(work + (ptrdiff_t)m * (to->p + 1)))
        return WF_EOVERLAP;
    wf__clear((ptrdiff_t)m * (to->p + 1), work);
    wf__clear((ptrdiff_t)m * mf, weight);
    wf__gram(from, to, work, weight);
    wf__solve_gram(m, to->p, mf, work, weight);
    wf__multiply(to, mf, weight);
    for (r = 0; r < m; r++) {
        wf__whole_row(from, weight + (ptrdiff_t)r * mf);
        if (!wf__all_finite(mf, weight + (ptrdiff_t)r * mf)) status = WF_ERANGE;
    }
    return status;
}

/* ---- first guesses, wf_begin ----------------------------------------------------------------- */

/* The polynomial through a few samples, newest first. */
struct wf__guess {
    int count, node[WF__ORDER];
    int target; /* in hindsight: the sample that is foretold */
    double weight[WF__ORDER];
};

/* Choose the samples for a degree: the one at `newest`, and those nearest to 1, 2, .. window
   lengths before it, behind the last break.  A place with no sample nearer than half a length
   ends the list. */
static int wf__guess_nodes(const wf *w, int degree, int newest, struct wf__guess *guess)
{
    const double *T = wf__t(w);
    const int begin = wf__oldest(w, newest), last = w->columns - 1;
    double length = T[last] - T[w->start], reach;
    int j, older, close;
    if (!(length > 0)) length = w->length; /* this window is still empty */
    reach = 0.499 * length; /* half a length away is too far, whatever the round-off */
    guess->node[0] = newest;
    for (guess->count = 1; guess->count <= degree; guess->count++) {
        const double t = T[newest] - guess->count * length;
        j = wf__nearest(w, t);
        if (j < begin && !(T[j] < T[begin])) j = begin; /* at a break: the value behind it */
        older = j >= begin && j < guess->node[guess->count - 1];
        close = fabs(T[j] - t) < reach;
        if (!older || !close) break;
        guess->node[guess->count] = j;
    }
    return guess->count <= degree ? WF_LOWERED : WF_OK;
}

/* Lagrange's polynomials at time t, or their derivatives by the product rule. */
static int wf__guess_weights(const wf *w, double t, int slope, struct wf__guess *guess)
{
    const double *T = wf__t(w);
    int i, k;
    for (i = 0; i < guess->count; i++) {
        double value = 1, rate = 0;
        for (k = 0; k < guess->count; k++) {
            const double gap = T[guess->node[i]] - T[guess->node[k]];
            if (k == i) continue;
            rate = rate * ((t - T[guess->node[k]]) / gap) + value / gap;
            value *= (t - T[guess->node[k]]) / gap;
        }
        guess->weight[i] = slope ? rate : value;
    }
    return wf__all_finite(guess->count, guess->weight) ? WF_OK : WF_ERANGE;
}

static void wf__guess_row(const wf *w, const struct wf__guess *guess, double *weight)
{
    int i;
    wf__clear(w->columns, weight);
    for (i = 0; i < guess->count; i++) weight[guess->node[i]] = guess->weight[i];
}

/* WF_OK, or why a guess of this degree cannot be asked for. */
static int wf__may_guess(const wf *w, int degree, const double *weight)
{
    if (!w || !weight) return WF_ENULL;
    if (degree < 0 || degree > WF_MAX_DEGREE) return WF_EARG;
    return w->columns == 0 ? WF_EFEW : WF_OK;
}

WF_API int wf_predict(const wf *w, int degree, double t, double *weight)
{
    struct wf__guess guess;
    int status = wf__may_guess(w, degree, weight);
    if (status == WF_OK && !wf__finite(t)) status = WF_EARG;
    if (status < 0) return status;
    status = wf__guess_nodes(w, degree, wf__newest(w), &guess);
    if (wf__guess_weights(w, t, 0, &guess) < 0) return WF_ERANGE;
    wf__guess_row(w, &guess, weight);
    return status;
}

/* The guess of this degree for the sample `ago` lengths before the newest one.  It is made from
   those ago + 1, ago + 2, .. lengths before the newest one. */
static int wf__hindsight(const wf *w, int degree, int ago, struct wf__guess *guess)
{
    /* `ago` newer samples and the one to be foretold come first in the list of nodes */
    if (ago >= WF_MAX_DEGREE - degree) return WF_EFEW;
    if (wf__guess_nodes(w, degree + 1 + ago, wf__newest(w), guess) != WF_OK) return WF_EFEW;
    guess->target = guess->node[ago];
    guess->count = degree + 1;
    memmove(guess->node, guess->node + ago + 1, (size_t)guess->count * sizeof *guess->node);
    return wf__guess_weights(w, wf__t(w)[guess->target], 0, guess);
}

WF_API int wf_hindsight(const wf *w, int degree, int ago, double *weight)
{
    struct wf__guess guess;
    int status = ago < 0 ? WF_EARG : wf__may_guess(w, degree, weight);
    if (status == WF_OK) status = wf__hindsight(w, degree, ago, &guess);
    if (status < 0) return status;
    wf__guess_row(w, &guess, weight);
    weight[guess.target] = -1;
    return WF_OK;
}

static void wf__guess_column(const struct wf__guess *guess, ptrdiff_t n, const double *x,
                             ptrdiff_t ldx, double *out)
{
    const double up = wf__above(guess->count, guess->weight);
    struct wf__passes s;
    struct wf__pass *pass;
    int i;
    s.n = n;
    s.count = 0;
    pass = wf__next_pass(&s, wf__nothing, out);
    for (i = 0; i < guess->count; i++) {
        const double *column = x + (ptrdiff_t)guess->node[i] * ldx;
        pass = wf__add_terms(&s, pass, 1, &guess->weight[i], 1 / up, column, ldx);
    }
    wf__close_sum(pass, up);
    wf__sweep(&s);
}

/* The norm of what a guess misses its target by; DBL_MAX where that is no number, for comparisons
   with NaN mean nothing under -ffast-math.  Squares are taken of shares of the largest miss so far,
   which neither overflow nor vanish. */
static double wf__miss(const struct wf__guess *guess, ptrdiff_t n, const double *x, ptrdiff_t ldx)
{
    double miss[WF__STRIP], largest = DBL_MIN, sum = 0, norm;
    ptrdiff_t i, k, rows;
    for (i = 0; i < n; i += rows) {
        const double *target = x + (ptrdiff_t)guess->target * ldx + i;
        const double before = largest;
        rows = wf__up_to(n - i, WF__STRIP);
        wf__guess_column(guess, rows, x + i, ldx, miss);
        for (k = 0; k < rows; k++) {
            miss[k] -= target[k];
            largest = wf__max(largest, fabs(miss[k]));
        }
        sum *= before / largest * (before / largest);
        for (k = 0; k < rows; k++) {
            const double share = miss[k] / largest;
            sum += share * share;
        }
    }
    norm = largest * sqrt(sum);
    return wf__finite(norm) ? norm : DBL_MAX;
}

/* The mean of the square roots of the misses at the last window ends; negative if the history is
   too short.  The iterations that the host's solvers need grow with the logarithm of the miss, and
   a root resembles it more than a square does: a jump is seen, and does not outweigh all the other
   ends. */
static double wf__mean_miss(const wf *w, int degree, ptrdiff_t n, const double *x, ptrdiff_t ldx)
{
    struct wf__guess guess;
    double sum = 0;
    int ago, ends = 0;
    for (ago = 0; ago < WF__WINDOWS; ago++) {
        if (wf__hindsight(w, degree, ago, &guess) != WF_OK) continue;
        sum += sqrt(wf__miss(&guess, n, x, ldx));
        ends++;
    }
    return ends > 0 ? sum / ends : -1;
}

WF_API int wf_predict_degree(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx)
{
    double least = 0, miss;
    int degree, best = 0, status = wf__handle_and_arrays(w, n, x, ldx, x, ldx);
    if (status < 0) return status;
    if (w->columns == 0) return WF_EFEW;
    for (degree = 0; degree < WF_MAX_DEGREE; degree++) {
        miss = wf__mean_miss(w, degree, n, x, ldx);
        if (miss < 0) break;
        if (degree > 0 && !(miss < least / sqrt(WF__BETTER))) continue;
        least = miss;
        best = degree;
    }
    return best;
}

/* Push a time that is not stored yet and see that the guess has weights for it; where it has none
   the caller rolls back. */
static int wf__push_guessed(wf *w, int slopes, double t, struct wf__guess *guess)
{
    int column;
    if (wf__find(w, t) >= 0) return WF_EORDER; /* wf__push would take it as stored */
    column = wf__push(w, t, slopes, 0);
    if (column < 0) return column;
    if (wf__guess_weights(w, t, 0, guess) < 0) return WF_ERANGE;
    return slopes ? wf__guess_weights(w, t, 1, guess) : WF_OK;
}

/* Push the times of a window; on failure roll back. */
static int wf__push_window(wf *w, int slopes, int count, const double *t, struct wf__guess *guess)
{
    int k, status;
    for (k = 0; k < count; k++) {
        status = wf__push_guessed(w, slopes, t[k], guess);
        if (status == WF_OK) continue;
        wf_rollback(w);
        return status;
    }
    return WF_OK;
}

/* The guess, or with `slope` its derivative, into every second column from `column` on, or, where
   there are no derivatives, into all. */
static void wf__fill(const wf *w, struct wf__guess *guess, int column, int slope, ptrdiff_t n,
                     double *x, ptrdiff_t ldx)
{
    const int per = 1 + wf__is_slope(w, slope ? column : column + 1);
    if (n == 0) return; /* x may be NULL */
    for (; column < w->columns; column += per) { /* finite: wf__push_guessed has asked */
        wf__guess_weights(w, wf__t(w)[column], slope, guess);
        wf__guess_column(guess, n, x, ldx, x + (ptrdiff_t)column * ldx);
    }
}

static int wf__times(int count, const double *t)
{
    if (count > 0 && !t) return WF_ENULL;
    return count < 0 || !wf__all_finite(count, t) ? WF_EARG : WF_OK;
}

static int wf__begin(wf *w, int slopes, int degree, int count, const double *t, ptrdiff_t n,
                     double *x, ptrdiff_t ldx)
{
    struct wf__guess guess;
    int status, pushed, first;
    status = wf__handle_and_arrays(w, n, x, ldx, x, ldx);
    if (status == WF_OK) status = wf__times(count, t);
    if (status < 0) return status;
    if ((slopes && w->limit < 2) || degree < WF_AUTO || degree > WF_MAX_DEGREE) return WF_EARG;
    status = wf_rollback(w);
    if (status < 0) return status;
    if (degree == WF_AUTO) degree = wf_predict_degree(w, n, x, ldx);
    status = wf__guess_nodes(w, degree, wf__newest(w), &guess);
    first = w->columns;
    pushed = wf__push_window(w, slopes, count, t, &guess);
    if (pushed < 0) return pushed;
    wf__fill(w, &guess, first, 0, n, x, ldx);
    if (slopes) wf__fill(w, &guess, first + 1, 1, n, x, ldx);
    return status;
}

WF_API int wf_begin(wf *w, int degree, int count, const double *t, ptrdiff_t n, double *x,
                    ptrdiff_t ldx)
{
    return wf__begin(w, 0, degree, count, t, n, x, ldx);
}

WF_API int wf_begin_hermite(wf *w, int degree, int count, const double *t, ptrdiff_t n, double *x,
                            ptrdiff_t ldx)
{
    return wf__begin(w, 1, degree, count, t, n, x, ldx);
}

/* ---- how good is it? ------------------------------------------------------------------------- */

/* A short row of weights on the samples: columns first .. first+order. */
struct wf__stencil {
    int first, order;
    double d[WF__WIDEST];
};

/* Lagrange's form of the divided difference, where all times differ. */
static void wf__plain_difference(const double *s, int order, double *d)
{
    int i, j;
    for (i = 0; i <= order; i++) {
        double product = 1;
        for (j = 0; j < i; j++) product *= s[i] - s[j];
        for (j = i + 1; j <= order; j++) product *= s[i] - s[j];
        d[i] = 1 / product;
    }
}

/* The table of differences: a derivative is a time that occurs twice. */
static void wf__confluent_difference(const wf *w, int first, int order, double *d)
{
    double D[WF__WIDEST][WF__WIDEST];
    const double *s = wf__s(w) + first;
    int i, j, k;
    for (i = 0; i <= order; i++)
        for (j = 0; j <= order; j++) D[i][j] = j == i - wf__is_slope(w, first + i);
    for (k = 1; k <= order; k++)
        for (i = 0; i + k <= order; i++) {
            const double gap = s[i + k] - s[i];
            for (j = 0; j <= order; j++) {
                if (gap > 0) D[i][j] = (D[i + 1][j] - D[i][j]) / gap;
                else D[i][j] = j == i + 1;
            }
        }
    for (j = 0; j <= order; j++) d[j] = D[0][j];
}

/* The divided difference over columns first .. first+order, in scaled times; derivatives, too, are
   by scaled time until wf__unscale. */
static void wf__difference(const wf *w, int first, int order, struct wf__stencil *e)
{
    e->first = first;
    e->order = order;
    if (wf__places(w)[wf__places(w)[first].first].slopes)
        wf__confluent_difference(w, first, order, e->d);
    else wf__plain_difference(wf__s(w) + first, order, e->d);
}

/* A stencil for derivatives by the times of the host.  WF_ERANGE: a weight overflows. */
static int wf__unscale(const wf *w, struct wf__stencil *e)
{
    int i;
    for (i = 0; i <= e->order; i++)
        if (wf__is_slope(w, e->first + i)) e->d[i] = ldexp(e->d[i], w->exponent);
    return wf__all_finite(e->order + 1, e->d) ? WF_OK : WF_ERANGE;
}

/* Where a stencil of order+1 columns begins: around column j, or as near to j as the segment
   allows.  It does not begin with a derivative. */
static int wf__stencil_first(const wf *w, const struct wf__segment *g, int j, int order)
{
    const int middle = j - (order + 1) / 2, last = g->first + g->count - 1 - order;
    const int first = wf__max_int(g->first, wf__min_int(middle, last));
    return first - wf__is_slope(w, first);
}

/* The error of the spline at one scaled time s, for the two powers that it does not reproduce,
   f(z) = (z - s)^(p+1) and (z - s)^(p+2). */
struct wf__defect {
    double s, one, two;
};

/* The coefficients of the splines through samples of these powers, for every centre at once.  Of
   f(z) = (z - c)^q let them be a_i,q(c): a_i,p(c) = psi_i(c) = (u_i+1 - c) .. (u_i+p - c)
   (Marsden), and the derivative by c is -q a_i,q-1(c).  So with a knot m_i in the
   middle of each function, one_i = a_i,p+1(m_i) and two_i = a_i,p+2(m_i),

      a_i,p+1(c) = one_i + (p+1) int_c^m_i psi_i(z) dz
      a_i,p+2(c) = two_i + (p+2) (one_i (m_i - c) + (p+1) int_c^m_i (z - c) psi_i(z) dz)

   and all numbers are as small as the steps around them.  As f is 0 at its centre (and so is
   f', for a derivative), the samples ask for sum_i A_ji a_i,q(t_j) = 0, for q = p+1 and then for
   q = p+2: twice L U = A on a right-hand side. */
struct wf__powers {
    struct wf__segment g;
    int low, high; /* the coefficients at hand, counted within the segment */
    int good;      /* a column of the grid: for steps that end in front of it the coefficients are
                      right, the cut at `high` is too far away */
    int count;     /* of Gauss' points: exact to degree p+1 */
    double point[WF__ORDER], gauss[WF__ORDER], one[WF__REACH], two[WF__REACH];
};

static double wf__middle(const struct wf__segment *g, int i)
{
    return wf__knot(g, i + (g->p + 1) / 2);
}

/* moment[k] = int_c^m_i (z - c)^k psi_i(z) dz, k = 0 and 1; psi_i as in struct wf__powers. */
static void wf__moments(const struct wf__powers *P, int i, double c, double *moment)
{
    const int p = P->g.p;
    double room[WF__ORDER], m, zeroth = 0, first = 0;
    const double *u = wf__knots(&P->g, i, p + 1, room);
    int q, r;
    m = u[(p + 1) / 2];
    for (q = 0; q < P->count; q++) {
        const double gap = P->point[q] * (m - c);
        double psi = P->gauss[q] * (m - c);
        for (r = 1; r <= p; r++) psi *= u[r] - c - gap;
        zeroth += psi;
        first += psi * gap;
    }
    moment[0] = zeroth;
    moment[1] = first;
}

/* Right-hand sides for the rows of A: for one_i or, with `second`, for two_i, when one_i is
   known. */
static void wf__power_sides(const wf *w, const struct wf__powers *P, int second, double *side)
{
    const struct wf__segment *g = &P->g;
    double a[2 * WF__ORDER + 1], moment[2];
    int r, k;
    for (r = P->low; r < P->high; r++) {
        const int column = wf__column_of_row(w, g->first + r), slope = wf__is_slope(w, column);
        const double c = g->s[r]; /* that of `column`, too: a pair shares its time */
        double sum = 0;
        wf__collocate(g, r, slope, a);
        for (k = wf__max_int(P->low, r - g->p); k <= wf__min_int(r + g->p, P->high - 1); k++) {
            const double entry = a[k - r + WF__ORDER];
            if (!(fabs(entry) > 0)) continue;
            wf__moments(P, k, c, moment);
            sum -= entry * (g->p + 1) * moment[second];
            if (second) sum -= entry * P->one[k - P->low] * (wf__middle(g, k) - c);
        }
        side[r - P->low] = second ? (g->p + 2) * sum : sum;
    }
}

/* L U v = v in place, rows low .. high-1 alone. */
static void wf__solve_between(const wf *w, const struct wf__powers *P, double *v)
{
    const int band = wf__band(P->g.p), rows = P->high - P->low;
    int r, k;
    for (r = 0; r < rows; r++) {
        const double *a = wf__lu(w, P->g.first + P->low + r);
        for (k = wf__max_int(0, r - band); k < r; k++) v[r] -= a[k - r] * v[k];
    }
    for (r = rows - 1; r >= 0; r--) {
        const double *a = wf__lu(w, P->g.first + P->low + r);
        for (k = r + 1; k <= wf__min_int(r + band, rows - 1); k++) v[r] -= a[k - r] * v[k];
        v[r] /= a[0];
    }
}

/* The powers around column `begin` of a segment and behind it, as far as there is room. */
static void wf__open_powers(const wf *w, int begin, struct wf__powers *P)
{
    int apart;
    P->g = wf__segment_of(w, begin);
    apart = WF__APART * (P->g.p + 1);
    begin -= P->g.first;
    P->low = wf__max_int(0, begin - apart);
    P->low -= wf__is_slope(w, P->g.first + P->low);
    P->high = wf__min_int(P->g.count, P->low + WF__REACH);
    P->high -= wf__is_slope(w, P->g.first + P->high);
    P->good = P->g.first + (P->high < P->g.count ? P->high - apart : P->high);
    P->count = (P->g.p + 3) / 2;
    wf__gauss(P->count, P->point, P->gauss);
    wf__power_sides(w, P, 0, P->one);
    wf__solve_between(w, P, P->one);
    wf__power_sides(w, P, 1, P->two);
    wf__solve_between(w, P, P->two);
}

/* The defect at scaled time s, whose basis is N for the coefficients from `first` on, counted
   within the segment. */
static void wf__defect_at(const struct wf__powers *P, double s, int first, const double *N,
                          struct wf__defect *defect)
{
    const struct wf__segment *g = &P->g;
    double moment[2];
    int i;
    defect->s = s;
    defect->one = defect->two = 0;
    for (i = 0; i <= g->p; i++) {
        const int k = first + i;
        const double one = P->one[k - P->low], two = P->two[k - P->low];
        wf__moments(P, k, s, moment);
        defect->one -= N[i] * (one + (g->p + 1) * moment[0]);
        defect->two -= N[i] * two;
        defect->two -=
            N[i] * (g->p + 2) * (one * (wf__middle(g, k) - s) + (g->p + 1) * moment[1]);
    }
}

/* With p+1 columns the samples say nothing of the error.  Told instead is how far the spline is
   from the polynomial of one degree less through all columns but the first.  (If the first sample
   has a derivative: through all but this derivative.)  It is the product of (s - s_i), i >= 1,
   times the divided difference. */
static void wf__lower_defect(const struct wf__segment *g, struct wf__defect *defect)
{
    int i;
    defect->one = 1;
    for (i = 1; i < g->count; i++) defect->one *= defect->s - g->s[i];
}

/* The divided differences around a step: `high` of order p+2, `low` of order p+1.  With fewer
   than p+3 columns there is `high` alone, of the order that they allow. */
struct wf__differences {
    struct wf__segment g;
    int both;
    struct wf__stencil low, high;
};

static int wf__open_differences(const wf *w, const struct wf__segment *g, int j,
                                struct wf__differences *around)
{
    const int order = wf__min_int(g->p + 2, g->count - 1);
    const int first = wf__stencil_first(w, g, j, order);
    if (g->count < 2) return WF_EFEW;
    around->g = *g;
    around->both = order == g->p + 2;
    wf__difference(w, first, order, &around->high);
    if (around->both) wf__difference(w, first, order - 1, &around->low);
    return g->count > g->p + 1 ? WF_OK : WF_LOWERED;
}

/* Around s the polynomial through the stencil is sum_q f_q (z - s)^q, so the error of the spline
   there is one f_(p+1) + two f_(p+2).  Of the divided differences, high = f_(p+2), and low =
   f_(p+1) + f_(p+2) sum_i (s_i - s), i over the columns of low: f_(p+1) follows. */
static void wf__mix(const wf *w, const struct wf__differences *around, struct wf__defect *defect,
                    struct wf__stencil *e)
{
    const double *s = wf__s(w) + around->high.first;
    double two = defect->two;
    int i;
    *e = around->high;
    /* with p+1 columns another defect takes its place */
    if (around->g.count <= around->g.p + 1) wf__lower_defect(&around->g, defect);
    for (i = 0; i < e->order; i++) two += defect->one * (defect->s - s[i]);
    for (i = 0; i <= e->order; i++) e->d[i] *= around->both ? two : defect->one;
    if (around->both) wf__add_row(e->order, defect->one, around->low.d, e->d);
}

/* The defect at a site; 0 at a stored time. */
static int wf__defect_of(const wf *w, const struct wf__site *at, struct wf__defect *defect)
{
    struct wf__powers P;
    double N[WF__ORDER];
    int first, status = wf__basis(w, at, &first, N);
    if (status < 0) return status;
    defect->s = at->s;
    defect->one = defect->two = 0;
    if (wf__stored(w, at) >= 0) return WF_OK;
    wf__open_powers(w, first, &P);
    wf__defect_at(&P, at->s, first - at->g.first, N, defect);
    return WF_OK;
}

WF_API int wf_error_weights(const wf *w, double t, double *weight)
{
    struct wf__stencil e;
    struct wf__defect defect;
    struct wf__differences around;
    struct wf__site at;
    int status, lowered, j;
    if (!w || !weight) return WF_ENULL;
    status = wf__locate(w, t, 0, &at);
    if (status == WF_OK) status = wf__defect_of(w, &at, &defect);
    if (status == WF_OK) status = wf__remark(w, at.remark);
    if (status < 0) return status;
    lowered = wf__open_differences(w, &at.g, wf__lower_bound(w, t), &around);
    if (lowered < 0) return lowered;
    wf__mix(w, &around, &defect, &e);
    if (wf__unscale(w, &e) < 0) return WF_ERANGE;
    wf__clear(w->columns, weight);
    for (j = 0; j <= e.order; j++) weight[e.first + j] = e.d[j];
    return status == WF_OK ? lowered : status;
}

/* The sum of |weights| of a row, those of derivatives over a unit of time. */
static double wf__size_of_row(const wf *w, const struct wf__stencil *e, double unit)
{
    double sum = 0;
    int i;
    for (i = 0; i <= e->order; i++)
        sum += fabs(e->d[i]) / (wf__is_slope(w, e->first + i) ? unit : 1);
    return sum;
}

/* The worst of three places in the step that ends with column j: the error of even degrees may
   vanish in the middle.  What makes the rows comparable is the step itself: neither the unit of the
   host's times nor the length of the grid has a say. */
static int wf__step_row(const wf *w, const struct wf__powers *P, int j, struct wf__stencil *worst)
{
    const struct wf__segment *g = &P->g;
    const double end = g->s[j - g->first], begin = g->s[j - g->first - 1];
    struct wf__stencil e;
    struct wf__defect defect;
    struct wf__differences around;
    double N[WF__ORDER], most = -1, size;
    int status = wf__open_differences(w, g, j, &around), span = wf__span(g, begin), q;
    for (q = 1; q < 4; q++) {
        const double s = begin + (end - begin) * (0.25 * q);
        while (span < g->count - 1 && wf__knot(g, span + 1) < s) span++;
        wf__splines(g, span, s, 0, 1, N);
        wf__defect_at(P, s, span - g->p, N, &defect);
        wf__mix(w, &around, &defect, &e);
        size = wf__size_of_row(w, &e, end - begin);
        if (!wf__finite(size)) return WF_ERANGE;
        if (!(size > most)) continue;
        most = size;
        *worst = e;
    }
    return wf__unscale(w, worst) < 0 ? WF_ERANGE : status;
}

/* Leave one out: sample j minus the polynomial of degree `degree` through the columns around it.
   Of a sample with a derivative the value alone is left out; the degree is odd there, for with an
   even one it may be the middle of a symmetric stencil, where a value has no weight.  0 where there
   is none: at the first sample, at the last one if the degree is above 0, with too few columns. */
static int wf__without(const wf *w, int j, int degree, struct wf__stencil *e)
{
    const struct wf__segment g = wf__segment_of(w, j);
    const int slope = wf__is_slope(w, j + 1);
    double own;
    int i;
    if (slope && degree % 2 == 0) degree--;
    if (degree < 0 || wf__is_slope(w, j) || j == g.first) return 0;
    /* degree 0 compares with the sample before */
    if (degree > 0 && j + 1 + slope >= g.first + g.count) return 0;
    if (g.count < degree + 2) return 0;
    wf__difference(w, wf__stencil_first(w, &g, j, degree + 1), degree + 1, e);
    own = e->d[j - e->first];
    for (i = 0; i <= e->order; i++) e->d[i] /= own;
    return wf__unscale(w, e) == WF_OK;
}

/* Suppose that a jump lies in the longer of the two steps beside a sample, where it is seen least.
   When the sample is left out, the line through its neighbours misses it by the share shorter /
   (before + behind) of the jump: 1/2 on even steps, less on others.  Returned is the factor
   that makes this share 1/2, at most 2.  It is used for all degrees above 0. */
static double wf__unseen(double before, double behind)
{
    return wf__min(2, 0.5 * (before + behind) / wf__min(before, behind));
}

/* As wf__without, for jumps anywhere in the steps beside the sample. */
static int wf__witness(const wf *w, int j, int degree, struct wf__stencil *e)
{
    const double *s = wf__s(w) + j;
    const int next = 1 + wf__is_slope(w, j + 1);
    if (!wf__without(w, j, degree, e)) return 0;
    if (degree > 0) wf__scale_row(e->order + 1, wf__unseen(s[0] - s[-1], s[next] - s[0]), e->d);
    return 1;
}

/* How much a leave-one-out counts.  The defect is right for smooth data and blind to kinks; a
   sample left out sees them and is ten times too pessimistic on smooth data, because it leaves a
   gap of two steps.  A second degree, higher or with few columns lower, tells which it is: from the
   lower to the higher one smooth data lose most of their error, kinks and jumps keep it. */
struct wf__doubt {
    int degree;   /* the second degree; the tables of wf__doubt_of hold it minus p */
    double rough; /* the ratio of the errors, higher degree over lower, from which on a sample left
                     out counts in full */
    int power;    /* below, it counts by that power of ratio / rough */
};

/* Measured on smooth data, gusts, turbulence, impacts, valves, circuits, jumps and an
   electrocardiogram: tests/study/README.md. */
static struct wf__doubt wf__doubt_of(const wf *w, const struct wf__segment *g)
{
    /* few: p < 3, p >= 3; values: p < 2, p >= 2; slopes: fewer than p + 6 columns, others */
    static const struct wf__doubt few[2] = {{-1, 1.7, 3}, {-2, 1.7, 3}};
    static const struct wf__doubt values[2] = {{2, 0.6, 2}, {2, 0.8, 3}};
    static const struct wf__doubt slopes[2] = {{2, 1.2, 2}, {4, 1.44, 1}};
    struct wf__doubt doubt = values[g->p > 1];
    if (wf__places(w)[g->first].slopes > 0) doubt = slopes[g->count >= g->p + 6];
    /* with few columns a lower degree.  Neither resolves smooth data, and the ratio is near 1 for
       these, too: so `rough` is above 1.  (p = 2, samples with derivatives: both degrees are 1, the
       ratio is 1, and a sample left out counts by 1.7^-3.) */
    if (g->count < g->p + 4) doubt = few[g->p > 2];
    doubt.degree += g->p;
    return doubt;
}

/* max(defect, out share^power), share = min(1, (higher / lower) / rough): see struct wf__doubt. */
static double wf__blend(const struct wf__doubt *doubt, double defect, double out, double lower,
                        double higher)
{
    double share = 1; /* also where only the second degree reads a NaN: the ratio is not known */
    int k;
    if (!wf__finite(out)) return out; /* a NaN among the samples that a defect need not read */
    if (!wf__finite(defect)) return defect; /* before a comparison that -ffast-math may turn */
    if (wf__finite(lower) && wf__finite(higher) && higher < doubt->rough * lower)
        share = higher / (doubt->rough * lower);
    for (k = 0; k < doubt->power; k++) out *= share;
    return wf__max(out, defect);
}

/* most[i] = the larger of it and v[i]; what is not finite stays.  v is looked at before the
   comparison, which -ffast-math may turn. */
static void wf__raise(ptrdiff_t n, const double *v, double *most)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++)
        if (wf__finite(most[i]) && (!wf__finite(v[i]) || v[i] > most[i])) most[i] = v[i];
}

/* most[i] = the largest |stencil * x| so far. */
static void wf__raise_stencil(const struct wf__stencil *e, ptrdiff_t n, const double *x,
                              ptrdiff_t ldx, double *most)
{
    double value[WF__ERRORS];
    ptrdiff_t i;
    if (n == 0) return; /* x may be NULL */
    wf__sum(n, e->order + 1, e->d, x + (ptrdiff_t)e->first * ldx, ldx, value);
    for (i = 0; i < n; i++) value[i] = fabs(value[i]);
    wf__raise(n, value, most);
}

/* No sub-step behind the window start. */
static int wf__is_empty(const wf *w)
{
    const double *T = wf__t(w);
    return w->columns < 2 || !(T[w->columns - 1] > T[w->start]);
}

/* Does the step that ends with column j of the grid lie in the segment and in the window? */
static int wf__is_step(const wf *w, const struct wf__segment *g, int j)
{
    return j > g->first && j > w->start && wf__t(w)[j] > wf__t(w)[j - 1];
}

/* Raise most[0..n-1], n at most WF__ERRORS, to the error around columns begin .. begin + WF__NEAR -
   1 of one segment: so many at a time, so that a kink does not change how smooth data far from it
   are judged. */
static int wf__error_near(const wf *w, const struct wf__powers *P, int begin, ptrdiff_t n,
                          const double *x, ptrdiff_t ldx, double *most)
{
    const struct wf__segment *g = &P->g;
    const int end = wf__min_int(begin + WF__NEAR, g->first + g->count);
    double defect[WF__ERRORS] = {0}, out[WF__ERRORS] = {0}, second[WF__ERRORS] = {0};
    const struct wf__doubt doubt = wf__doubt_of(w, g);
    const double *higher = doubt.degree > g->p ? second : out,
                 *lower = doubt.degree > g->p ? out : second;
    struct wf__stencil e;
    ptrdiff_t i;
    int j, told, status = WF_OK;
    for (j = begin; j < end; j++) {
        if (wf__is_step(w, g, j)) {
            told = wf__step_row(w, P, j, &e);
            if (told < 0) return told;
            status = wf__worse(status, told);
            wf__raise_stencil(&e, n, x, ldx, defect);
        }
        /* with p = 0 the window start would be a witness of the step in front of it alone */
        if (g->p == 0 && j == w->start) continue;
        if (wf__witness(w, j, g->p, &e)) wf__raise_stencil(&e, n, x, ldx, out);
        if (wf__witness(w, j, doubt.degree, &e)) wf__raise_stencil(&e, n, x, ldx, second);
    }
    for (i = 0; i < n; i++) defect[i] = wf__blend(&doubt, defect[i], out[i], lower[i], higher[i]);
    wf__raise(n, defect, most);
    return status;
}

/* wf_error of at most WF__ERRORS numbers. */
static int wf__error_rows(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    struct wf__powers P;
    double most[WF__ERRORS] = {0};
    int begin, end, told, status = WF_OK;
    P.good = 0;
    for (begin = w->start; begin < w->columns; begin = end) {
        const struct wf__segment g = wf__segment_of(w, begin);
        end = wf__min_int(begin + WF__NEAR, g.first + g.count);
        /* true in every new segment, for `good` is at most the end of the old one */
        if (P.good < end) wf__open_powers(w, begin, &P);
        told = wf__error_near(w, &P, begin, n, x, ldx, most);
        if (told < 0) return told;
        status = wf__worse(status, told);
    }
    if (n > 0) memcpy(out, most, (size_t)n * sizeof(double));
    return status;
}

WF_API int wf_error(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *out)
{
    ptrdiff_t rows;
    int status = wf__arrays(w, n, x, ldx, out);
    if (status < 0) return status;
    if (wf__is_empty(w)) return WF_EFEW;
    for (;; x += rows, out += rows) {
        rows = wf__up_to(n, WF__ERRORS);
        status = wf__error_rows(w, rows, x, ldx, out);
        n -= rows;
        /* the grid alone decides on the status, so that of the first rows is that of all */
        if (status < 0 || n == 0) return status;
    }
}

/* The largest estimate of all n numbers; NaN where there is none.  One that is not finite is
   returned as it is. */
static double wf__largest_error(const wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx)
{
    double out[WF__ERRORS], largest = 0;
    ptrdiff_t i, k;
    for (i = 0; i < n; i += WF__ERRORS) {
        const ptrdiff_t rows = wf__up_to(n - i, WF__ERRORS);
        if (wf__error_rows(w, rows, x + i, ldx, out) < 0) return wf__nan();
        for (k = 0; k < rows; k++)
            if (wf__finite(largest) && (out[k] > largest || !wf__finite(out[k]))) largest = out[k];
    }
    return largest;
}

/* How many older samples the window's first segment needs to have degree + 2 columns, which are
   enough for an estimate; all there are, if these are too few. */
static int wf__wanted(const wf *w, int degree)
{
    const int own = wf__places(w)[w->start].first, end = own + wf__places(w)[own].count,
              begin = wf__oldest(w, w->start);
    int first = w->start, history = 0;
    while (end - first < degree + 2 && first > begin) {
        first -= 1 + wf__is_slope(w, first - 1);
        history++;
    }
    return history;
}

/* Restrict the grid to a degree and the samples it wants; returns the error, or NaN: it cannot be
   chosen.  Where the spline has a lower degree than asked for: NaN, for that degree's own try
   tells; not so at `lowest`. */
static double wf__try(wf *w, int degree, int lowest, ptrdiff_t n, const double *x, ptrdiff_t ldx)
{
    wf_restrict(w, degree, wf__wanted(w, degree));
    if (w->p < degree && degree > lowest) return wf__nan();
    if (wf_quality(w, NULL, NULL) != WF_OK) return wf__nan();
    return wf__largest_error(w, n, x, ldx);
}

WF_API int wf_choose(wf *w, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *error)
{
    double least = wf__nan(), estimate;
    int degree, lowest, best;
    if (!w || (n > 0 && !x)) return WF_ENULL;
    if (n < 1 || ldx < n) return WF_EARG;
    if (wf__is_empty(w)) return WF_EFEW;
    lowest = wf__min_int(w->degree, wf__count_slopes(w, 0, w->columns) > 0 ? 2 : 1);
    best = lowest;
    for (degree = w->degree; degree >= lowest; degree--) {
        estimate = wf__try(w, degree, lowest, n, x, ldx);
        if (!wf__finite(estimate)) continue;
        if (wf__finite(least) && !(estimate < least)) continue;
        least = estimate;
        best = degree;
    }
    wf_restrict(w, best, wf__wanted(w, best));
    if (error) *error = least;
    return wf__wanted(w, best);
}

/* Longest step over shortest step; times that occur twice are no step. */
static double wf__step_ratio(const wf *w)
{
    const double *s = wf__s(w);
    double longest = 0, shortest = DBL_MAX;
    int j;
    for (j = w->hidden + 1; j < w->columns; j++) {
        const double step = s[j] - s[j - 1];
        longest = wf__max(longest, step);
        if (step > 0) shortest = wf__min(shortest, step);
    }
    return longest > 0 ? longest / shortest : 1;
}

WF_API int wf_quality(const wf *w, double *ratio, double *noise)
{
    double worst;
    if (!w) return WF_ENULL;
    if (w->columns == 0) return WF_EFEW;
    worst = wf__worst_noise(w, DBL_MAX);
    if (ratio) *ratio = wf__step_ratio(w);
    if (noise) *noise = worst;
    return worst > WF__NOISE ? WF_NOISY : WF_OK;
}

/* ---- messages -------------------------------------------------------------------------------- */

WF_API int wf_linked_version(void)
{
    return WF_VERSION;
}

WF_API const char *wf_message(int status)
{
#define WF__TEXT(name, value, text) case name: return text;
    switch (status) {
        WF_STATUSES(WF__TEXT)
    }
#undef WF__TEXT
    return status > WF_OK && status < WF_REMARK ? "done: a result" : "unknown status";
}

#ifdef __cplusplus
}
#endif
#endif /* WF_IMPLEMENTATION */

/* MIT License

   Copyright (c) 2026 the authors of waveform.h, iqn.h and rk.h

   Permission is hereby granted, free of charge, to any person obtaining a copy of this software
   and associated documentation files (the "Software"), to deal in the Software without
   restriction, including without limitation the rights to use, copy, modify, merge, publish,
   distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
   Software is furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in all copies or
   substantial portions of the Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING
   BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
   NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
   DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
   OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

   Version history

      0.2.0   Knots are weighted averages: uneven steps give other (better) numbers, even ones the
              same.
              New: wf_begin, wf_set and wf_get (WF_STRICT, WF_SAMPLE_ERROR), wf_push_break (and
              their forms with derivatives), wf_pop, wf_copy, wf_predict_degree, wf_hindsight,
              wf_restrict, wf_choose, WF_BEHIND, means from samples.
              What a user of 0.1.0 must change:
              - remarks are above WF_REMARK, so that they are never columns: WF_EXTRAP and
                WF_NOISY have new numbers, a test status > 0 becomes status > WF_REMARK; WF_LOWER is
                WF_LOWERED; what was WF_EARG is WF_ENULL of a NULL, WF_EOVERLAP of an overlap;
              - wf_quality: the noise is that of the window, no longer of its history; derivatives
                count, too;
              - wf_lower(w, limit) after every push: wf_set(w, WF_SAMPLE_ERROR, d) once;
              - wf_mean -> wf_eval_mean, wf_mean_weights -> wf_basis_mean, wf_integral -> (b - a)
                times wf_eval_mean;
              - wf_on_samples is gone: wf_weights, wf_weights_mean and wf_error_weights give rows on
                samples;
              - wf_resample and wf_combine need an output apart from the input;
              - wf_predict of degree 2 needs a sample two window lengths back, and says WF_LOWERED
                when a sample it wants is not there;
              - wf_error is larger at kinks and jumps, which it did not see; wf_overshoot is gone;
              - wf_eval_many is gone: rows of wf_basis for wf_combine do the same;
              - wf_move, wf_lobatto, wf_finite are gone: no use for them was found;
              - wf_version is wf_linked_version;
              - WF_ELONG is gone with the limit of 4096 columns; wf_size asks for more bytes; wf_fit
                may say WF_ERANGE.
      0.1.0   first version */
