/* SPDX-License-Identifier: MIT

   iqn.h - v0.2.0 - interface quasi-Newton acceleration of x = H(x) on flat arrays

   In *one* C or C++ file, before the include:

      #define IQN_IMPLEMENTATION
      #include "iqn.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates,
   prints, aborts or keeps a global.

   SYNOPSIS

      static double mem[8000 + 42 * N], x[N], hx[N]; // N a constant; x: your first guess; mem: at
                                                     // least iqn_size(N, 20, 1) bytes
      int status, end, window;
      iqn *q;
      if (iqn_make(&q, N, 20, 1, mem, sizeof mem) < 0) return 1; // up to 20 pairs, one block
      iqn_set(q, IQN_TOL_RELATIVE, 1e-6);            // the only setting a first run needs
      for (window = 0; window < 3; window++) {
          do {
              H(x, hx);                              // your solvers: hx = H(x)
              status = iqn_step(q, x, hx);           // x = the next input, or the answer
              end = iqn_converged(q);
          } while (status >= 0 && end == 0);
          if (status < 0) return 1;                  // iqn_message(status) says why; x is untouched
          if (end == 2) return 2;                    // gave up; x is a new input.  Call iqn_discard
                                                     // and repeat with a shorter window; or, if
                                                     // IQN_RELATIVE is small enough: x = hx, then
                                                     // iqn_commit
          iqn_commit(q);                             // accepted; x, the answer, is the next first
      }                                              // input, unless you put a prediction there

   A window is one fixed point to be solved, usually that of one time step.  It ends with iqn_commit
   or iqn_discard.  A run is all windows since iqn_make.

   Where a solver fails at x (a negative volume, NaN): iqn_halve(q, x) goes half of the way back
   to the iterate that the last step started from, and the host evaluates H there.  Where a bound is
   known that the answer does not reach, IQN_LOWER or IQN_UPPER spares most of these failures.

   A checkpoint is a memcpy of the iqn_size(...) bytes at mem, and x.  It may be restored at another
   place p, aligned to 8 bytes: the handle then is (iqn *)p.  Only the sum and its ctx are
   addresses: in another process call iqn_set_sum again.

   COMPILE-TIME OPTIONS, before the include, the same in every file
      IQN_STATIC   every function private to the including file, for a library that embeds this one:
                   define IQN_IMPLEMENTATION in every file that includes it
      IQN_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS

   x is cut into blocks, fields with weights of their own (iqn_make).  A rank is one process of a
   parallel run.  r = hx - x is the residual.

   A step, one call of iqn_step, writes a new x.  It starts from the base: the iterate at which H
   was last evaluated, unless a rule below keeps an earlier one of the window.  The host evaluates H
   at the new x and calls iqn_step again.  That call makes a secant pair of the new iterate and the
   base that the last step started from:
      v = r - r_base,   w = hx - hx_base,      columns of V and W, newest first.
   J = W V^+ approximates the derivative of hx with respect to r, so r = 0 is expected at hx - J r.
   With r and hx of the base, a full step is
      x = hx + W a,   a = argmin |r + V a|.                              IQN_ILS = Anderson, type II
   In this section, but for "Starting over", |.| is the norm of the least squares: the residual of
   each block counts times IQN_WEIGHT / size, see IQN_SCALING, and with M (see below) if one is
   given.  A block of weight 0 only follows ("secondary").  Several samples of a waveform as blocks:
   full QN-WI if all have weights, reduced QN-WI if only the last one has (Rueth et al.).  IQN_IMVJ
   keeps the derivative of past windows: with groups of pairs V_g, W_g, newest first, by default one
   for each window,
      x = hx + sum W_g a_g,   a_g = argmin |r + V_newer a_newer + V_g a_g|,
   which is J_new = J_old + (W - J_old V) V^+ without any n x n matrix.
   A step without pairs, as the first of all, is a relaxation: x = x_base + omega r_base.  The first
   step of a later window uses the pairs of past windows.  IQN_CONSTANT and IQN_AITKEN relax in
   every step and make no pairs; IQN_AITKEN with
      omega_k = -v'(x_k - x_(k-1)) / v'v, weighted, without M,
   where x_k is the iterate as H got it: clamped, or edited by the host.  (Where this is not finite,
   0, or above 1e6 in size, the omega before is kept.)

   Every decision is made on the small matrix V'V, which is kept per block.  A full step reads V
   once, for V'r and the new row of V'V, reads W once, for the update, and calls a host's sum twice.
   V'V is summed in double-double, so that squaring the condition does no harm: as accurate as
   Householder QR up to a condition of 1e14.  In another norm, r'M r with a symmetric positive
   definite M (a mass matrix, an energy), hand M r to iqn_step_metric: V'M V follows from the
   products V'(M r) of two steps.

   Which pairs to trust.  A pair is as good as its uncertainty s_j allows, and the least squares is
      min |r + V a|^2 + sum (s_j a_j)^2,   s_j^2 = (nu |hx_j|)^2 + |v_j|^2 ((D - D_j)^2 + c_j^2).
   nu, D and c_j are relative, s_j has the unit of r:
   - nu (IQN_NOISE_LEVEL) is the relative error of H.  hx_j is the hx, not the hx_base, that pair j
     was made of; of a pushed pair, the hx of the last step, or w where there is none or it is 0.
     With M, |hx_j| is the Euclidean one times (|v_j| with M) / (|v_j| without M).
   - D is the drift of H in this run, D_j what it was when pair j was made.  It grows after a full
     first step of a window, by at most 0.01, the more the worse the pairs of past windows have
     predicted the result.
   - c_j is curvature, usually 0 while H looks affine along the steps taken.  After two surprises in
     one window (|r| rose to ten times |r + V a| times max(1, the steepest |v| / |x - x_base| seen))
     H counts as "curved" for the rest of the run.
   The rules by which D and c_j grow, and by which past pairs that have misled are forgotten, stand
   at iqn__observe_drift, iqn__observe_curvature and iqn__judge...  IQN_IMVJ has no drift.

   A pair is judged by what newer ones, trusted as far as their s_i allow, do not explain of v_j:
      |R_jj|^2 = min over b of |v_j - sum b_i v_i|^2 + sum (s_i b_i)^2,
   the sums over newer pairs i of its group that are kept.  (In IQN_ILS all pairs are one group.
   With all s_i = 0, R is that of V = Q R, newest pairs first.)  With this b, I_j = sum (b_i nu
   |hx_i|)^2 is the squared noise that the pair inherits from newer ones.  A pair is dropped
   - if |R_jj|^2 - I_j <= 0.09 (s_j^2 + I_j), or
   - if |R_jj| <= 1e-14 |v_j|, or
   - if s_j = 0 and the newer pairs i are as many as the numbers of x in blocks with a weight above
     0, on all ranks.  (Pairs with s_j > 0 may be more: the least squares then averages what they
     say.)
   It is left out at once, and forgotten by the next step of the window, or by a push that needs its
   room; if the window ends before that, it is back.
   With IQN_FILTER_LIMIT > 0 all s_j are 0, and the first rule is the textbook's |R_jj| < limit
   |v_j| (QR2).  Where there is no room for a new pair, the oldest goes.  In IQN_ILS without a
   filter limit the one goes that newer pairs explain best, if they explain all but a twentieth of
   it, and if all pairs are of this window or H has proved nonlinear (see below) or curved.

   Steps taken back.  A full step may raise |r| much though H is affine: its pair is exact, and only
   the part r + V a grew, which no pair had seen.  On a strongly nonlinear H the pair is useless,
   and the next step as bad.  So a full step after which |r| > IQN_GROWTH |r_base| is taken back:
   the base stays.  Until H has proved nonlinear, the next step is a probe, x_base + 0.1 (x -
   x_base), which tells the two apart: on an affine H it changes r by 0.1 v up to rounding.
   - Affine, for this window: the pair of the step taken back stays, that of the probe is not
     stored, and no other full step of this window is taken back.
   - Nonlinear, for the rest of the run: of this window, only the pair of the probe stays.  A later
     step that is taken back leaves no pair and is not probed.  In every window the library now
     explores: small steps along r + V a learn the slope of H, usually until all pairs, past ones
     too, explain nine tenths of r.  Then come full steps with the mixing IQN_MIXING / max(1, |v| /
     |x - x_base|), v and x of the last step that was no probe, without M; undivided where past
     pairs predict well.  After a full step that left more than 0.3 of |r|, a tenth of the next one
     is tried first (iqn__plan_exploring).
   In IQN_ILS and IQN_IMVJ the base usually also stays after a relaxation that raised |r|; in
   IQN_ILS with IQN_FILTER_LIMIT 0 also after a first step with past pairs that raised |r|: they
   have misled (unless H has proved curved, but not nonlinear).  Neither counts as a step taken back
   (IQN_WITHDRAWN, IQN_NWITHDRAWN).  Nothing is taken back with IQN_GROWTH 0, where a block has the
   weight 0, where the host has changed x, where the step has converged, or, until H has proved
   nonlinear, where |v| <= 50 nu |hx|: noise proves nothing.

   Starting over.  While the least Euclidean |r| is above 1e-3 of the first, IQN_ILS forgets all
   pairs but that of the last step after half of IQN_PATIENCE steps without progress, and the
   waiting begins anew: up to three times in a window, with IQN_FILTER_LIMIT 0 and IQN_GROWTH > 0
   (iqn__leads_nowhere).

   To cross ranks, a double-double travels as three numbers on binary grids that all ranks share,
   whose sums are exact in any order, on up to 131072 ranks.

   Mehl et al., Comput. Math. Appl. 71 (2016): IQN-ILS, IMVJ.  Haelterman et al., Comput. Struct.
   171 (2016): the filter.  Scheufele, Mehl, SIAM J. Sci. Comput. 39 (2017): restarts.  Rueth et
   al., IJNME 122 (2021): waveforms.  Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26 (2005): sums.  The
   uncertainties, the probe and the exploring are this library's own.

   DOES NOT
      evaluate H, know time or meshes (resample pairs with iqn_pair and iqn_push when a grid
      changes), predict the next window, start threads, or change n.

   LIMITATIONS
      With IQN_MIXING other than 1, while exploring, and where |r| has changed by a factor above
      2^150, a step may read V twice.  Before a probe it reads V once and one column again.
      A probe costs one evaluation, on an affine H at most once a window, unless a bound clamps the
      probe, or the host changes its x or pushes a pair while it is under way.
      Blocks whose residuals differ by more than 1e150 fall out of the range of one Gram matrix.  A
      step that lowers |r| of all blocks together by a factor above 1e150, but not to 0, may leave
      no pair (IQN_NZERO).
      A bound that steps reach again and again may stop the iteration short of the answer, on an
      affine H too: widen it then.
      With IQN_FILTER_LIMIT > 0 no pair is doubted: on a nonlinear H steps may be taken back and
      come again in turns, until IQN_PATIENCE ends that.
      No H converges below its own noise: where that is above 1e-12 of |hx|, set IQN_NOISE_LEVEL to
      it, and a tolerance above it.
      With a metric M, |M r| / |r| has to be between 1e-120 and 1e150.
      With M, V'M V is less accurate, for M times the rounding error of v is not known.
      Pair j is made of two residuals; let |r_j| be the larger one.  In the norm with M, the entry
      of pair i and a newer pair j has an error of 1e-16 |v_i| |r_j|, a diagonal one of 1e-16
      |r_j|^2.

   DETERMINISM
      The same calls give the same bits with gcc at any -O, also with -ffast-math, and with clang at
      any -O without -ffast-math and -ffp-contract=fast; with and without fused multiply-add, and
      with SSE2, AVX2 or AVX-512: the implementation is compiled with its own floating-point
      options.  (With -ffast-math or -ffp-contract=fast clang fuses where the processor can: other
      last bits, the same accuracy; a later -ffp-contract=off prevents that.  Older compilers
      that link with -ffast-math make subnormal numbers 0.)  32-bit x87 arithmetic (FLT_EVAL_METHOD
      != 0) loses the accurate sums.  On other numbers of ranks results agree to about 1e-30 times
      the square of the condition, before they are rounded to double: mostly in all bits.  With
      scalings by value or residual, and where the library explores: to about 1e-16 times the
      condition.

   THREADS
      Functions on different objects may run at once, and so may those with a const handle on the
      same object.

   LICENSE
      MIT; full text and version history at the end of the file. */

#ifndef IQN_H_INCLUDED
#define IQN_H_INCLUDED
#define IQN_VERSION 200 /* 10000*major + 100*minor + patch */

#include <stddef.h>

#ifndef IQN_API
#  ifndef IQN_STATIC
#    define IQN_API extern
#  elif defined(__GNUC__)
#    define IQN_API static __attribute__((unused))
#  else
#    define IQN_API static
#  endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statuses and keys ----------------------------------------------------------------------- */

/* Status: 0 done; above IQN_REMARK done, with a remark (IQN_DROPPED of iqn_push: the pair was not
   stored); < 0 nothing done, and no later call sees a difference but in counters.  iqn_converged
   returns 0, 1 or 2 (or IQN_ENULL), iqn_linked_version a version: no remarks.  A list at the end of
   a comment names the statuses below 0 that the function may return, in brackets for what.  The
   numbers of statuses and keys do not change from 0.2.0 on: hosts in other languages carry them by
   value, and new ones are added at the end.  Numbers that are missing were used by 0.1.0.
   NaN and Inf in x, hx or a pair are refused, unlike in the other two headers: one NaN would spoil
   every later step. */
#define IQN_STATUSES(X)                                                                            \
    X(IQN_OK, 0, "done; iqn_step: quasi-Newton update")                                            \
    X(IQN_SOLVED, 201, "converged: x = hx")                                                        \
    X(IQN_RELAXED, 202, "relaxed, base + omega r: no usable pair, or a relaxation method")         \
    X(IQN_DROPPED, 203, "quasi-Newton update, pairs dropped; iqn_push: v is zero, not stored")     \
    X(IQN_WITHDRAWN, 204, "the last step raised |r| too much and is taken back; x is a new input") \
    X(IQN_STALLED, 206, "no progress for IQN_PATIENCE iterations")                                 \
    X(IQN_NOISE, 207, "no progress for IQN_PATIENCE iterations: noise, or too few columns")        \
    X(IQN_DIVERGED, 208, "no progress for IQN_PATIENCE iterations: |r| > 1000 times its least")    \
    X(IQN_EXPLORED, 209, "x is a small step from its base, to learn the slope of H")               \
    X(IQN_EARG, -201, "a size or a position is out of range")                                      \
    X(IQN_EMEM, -202, "memory missing, too small (see iqn_size) or not aligned to 8 bytes")        \
    X(IQN_EORDER, -203, "wrong order of calls: see the function")                                  \
    X(IQN_EKEY, -204, "no such key, or no such block")                                             \
    X(IQN_EVALUE, -205, "the value is not one that this key takes")                                \
    X(IQN_EOVERLAP, -206, "arrays overlap that must lie apart")                                    \
    X(IQN_ELENGTH, -207, "the lengths of the blocks do not add up to n")                           \
    X(IQN_ENAN, -208, "a number handed over, hx - x or w / |v| is not finite, on some rank")       \
    X(IQN_ESUM, -209, "the sum over the ranks failed")                                             \
    X(IQN_ENULL, -210, "a pointer is NULL")
#define IQN__NUMBER(name, value, text) name = value,
enum { IQN_REMARK = 200, IQN_STATUSES(IQN__NUMBER) };

/* Keys of iqn_set: the default in brackets.  |.| is one of two norms.  The limits IQN_TOL_...,
   IQN_PATIENCE (with IQN_DIVERGED) and the values IQN_RESIDUAL to IQN_BEST_RELATIVE use the
   Euclidean norm of all numbers of all ranks, without weights and without M: where fields have
   different units, set limits per block.  IQN_FILTER_LIMIT, IQN_GROWTH and IQN_PREDICTED use the
   norm of the least squares, with weights, scalings and M.

   Without any limit only r = 0 is convergence.  An x that runs away makes |r| / |hx| small, so
   IQN_TOL_RELATIVE has a guard.  Let h be |hx| of the last committed window, or of this window's
   first step if that is larger (from rest: the first |hx| that is not 0).  Where |hx| > 10 h, |r|
   must also be at most 0.1 |r of the first iteration|.  Where |hx| > 1000 h, it must be at most
   limit * 1000 h in place of limit * |hx|.  The IQN_TOL_RELATIVE of a block has the same guard,
   with the norms of that block.  IQN_TOL_ABSOLUTE and IQN_TOL_REDUCTION have none.  An iteration is
   a step. */
enum {
    IQN_METHOD = 1,       /* IQN_ILS, IQN_IMVJ, IQN_AITKEN or IQN_CONSTANT              [IQN_ILS] */
    IQN_OMEGA = 2,        /* relaxation factor of steps without pairs; IQN_AITKEN: the first omega,
                             and the largest |omega| of a window's first step; not 0        [0.1] */
    IQN_FILTER_LIMIT = 4, /* > 0: drop a pair where |R_jj| < limit |v_j|, the textbook's QR2, and
                             trust all others in full; 0: by uncertainty                      [0] */
    IQN_WINDOWS = 5,      /* ILS: how many past windows take part in the least squares; -1: all for
                             which there is room; 0: the last one, in the first step of a window
                             only.  IMVJ: how many past windows are one group with the current one
                             (-1 stands for 0); older ones are a group each, while there is room.
                             Windows without pairs do not count                              [-1] */
    IQN_TOL_ABSOLUTE = 7,    /* converged when |r| <= limit                                   [0] */
    IQN_TOL_RELATIVE = 8,    /*           or |r| <= limit |hx|                                [0] */
    IQN_TOL_REDUCTION = 9,   /*          or |r| <= limit |r of the window's first iteration|  [0] */
    IQN_MAX_ITERATIONS = 11, /* iqn_converged gives up after so many steps of a window;
                                0: never                                                      [0] */
    IQN_PATIENCE = 12,       /* "stalled" (statuses 206 to 208) after so many steps in a row without
                                progress.  Progress is an |r| 10 % below the mark; it becomes the
                                new mark.  The first mark is the first |r|.  While the least |r| is
                                above 1e-3 of the first, it is progress, too, that more pairs of
                                this window are kept than ever (since the last starting over, if
                                there was one); the mark stays.  After half of these steps IQN_ILS
                                may start over, see above, and count anew: "stalled" may come much
                                later.  0: never; for slow relaxation                        [20] */
    IQN_MIXING = 14,      /* mixing factor beta, not 0: x = hx + W a - (1 - beta) (r + V a)   [1] */
    IQN_NOISE_LEVEL = 21, /* relative error of H (solver tolerances, single precision)    [1e-13] */
    IQN_GROWTH = 22,      /* a full step after which |r| > value |r_base| is taken back, but for the
                             cases under "Steps taken back".  Below 1: also a step that lowered |r|
                             too little, until H has proved nonlinear.  0: no step is taken back;
                             the base moves also where |r| rose by a relaxation, or by a first step
                             made with past pairs (IQN_ILS without a filter limit still forgets
                             pairs that have misled).  Set to 0 within a window: a probe under way
                             is still judged, and small steps still come until the window ends
                                                                                              [5] */
    IQN_MERGE = 23,       /* IMVJ: after every so many windows all past pairs become one group,
                             which drops the pairs that newer ones explain; 0: never          [0] */
    /* Keys of iqn_set_block only; the IQN_TOL_ keys may be given there, too. */
    IQN_LENGTH = 51,  /* local length of the block           [n/blocks, cut off; the last: rest] */
    IQN_SCALING = 52, /* IQN_BY_...: what the block is measured by, see below     [IQN_BY_WEIGHT] */
    IQN_WEIGHT = 53,  /* factor on the block's residual in the least squares; 0: secondary    [1] */
    IQN_LOWER = 55,   /* the next input of the block is clamped to LOWER ... UPPER     [-DBL_MAX] */
    IQN_UPPER = 56,   /* (the answer is hx as it is: H must obey its own bounds)        [DBL_MAX] */
    /* Keys that can be read, not set: by iqn_get all, by iqn_get_block the first four. */
    IQN_RESIDUAL = 101,      /* |r|, r = hx - x of the last step that was done (status >= 0) */
    IQN_VALUE = 102,         /* |hx| of the same step                                      */
    IQN_RELATIVE = 103,      /* |r| / |hx|                                                 */
    IQN_REDUCTION = 104,     /* |r| / |r of the window's first iteration|                  */
    IQN_BEST_RELATIVE = 105, /* least |r| / |hx| of this window                            */
    IQN_PAIRS = 106,         /* pairs in use: iqn_pair takes 0 ... IQN_PAIRS - 1           */
    IQN_ITERATIONS = 107,    /* steps in this window                                       */
    IQN_OMEGA_NOW = 108,     /* omega of the last relaxation                               */
    IQN_PREDICTED = 109,     /* |r + V a| of the last step if it was a full one, else |r| of the
                                base that it started from.  With an affine H and a mixing of 1,
                                the r after a full step is dH/dx times its r + V a         */
    /* Counters since iqn_make.  Right: what to change if one grows. */
    IQN_NSTEPS = 151,     /* steps                                                                */
    IQN_NSUMS = 152,      /* calls of the sum                                                     */
    IQN_NDROPPED = 153,   /* pairs dropped; the next step of the window counts them:
                                                         IQN_NOISE_LEVEL or IQN_FILTER_LIMIT down */
    IQN_NFULL = 154,      /* pairs that made room for new ones: more columns in iqn_make          */
    IQN_NZERO = 155,      /* pairs not stored, v was zero, rounding or out of range:
                                                               the solvers' own tolerances down   */
    IQN_NRELAXED = 156,   /* relaxations:                      more past windows (IQN_WINDOWS)    */
    IQN_NWITHDRAWN = 157, /* steps the library took back, on an affine H mostly one per window:
                                                            a better first guess, shorter windows */
    IQN_NREFUSED = 159,   /* steps refused for NaN or Inf:     iqn_halve, smaller time step       */
    IQN_NSTALLED = 160,   /* steps with status 206 to 208:     more columns if IQN_NFULL grew;
                                                               else tolerance up, IQN_MIXING down */
    IQN_NEXPLORED = 161,  /* small steps to learn slopes:
                                                            a better first guess, shorter windows */
    IQN_NRESTARTED = 162  /* times the library started over, its pairs led nowhere:
                                                            a better first guess, shorter windows */
};
enum { IQN_ILS = 0, IQN_IMVJ = 1, IQN_AITKEN = 2, IQN_CONSTANT = 3 };
enum { IQN_BY_WEIGHT = 0, IQN_BY_VALUE = 1, IQN_BY_RESIDUAL = 2, IQN_BY_RESIDUAL_SUM = 3 };

/* The factor of a block in the least squares is IQN_WEIGHT / size, where size is
      IQN_BY_WEIGHT        1: the fields have one unit, or the weights hold the units
      IQN_BY_VALUE         |hx| of the block at this step
      IQN_BY_RESIDUAL      |r| of the block at this step
      IQN_BY_RESIDUAL_SUM  a copy of a total: |r of the block| / |r| added up over the steps of this
                           window.  All blocks whose total is not 0 renew their copies when one of
                           these has none yet, or its total is ten times more or less than its copy;
                           until then the copies stay, over windows too.  A field that begins with
                           r = 0 has no useful total: take IQN_BY_VALUE for it
   A size of 0 is replaced by |hx| or |r| of all blocks together, by 1 if that is 0, too, and by 1
   with IQN_BY_RESIDUAL_SUM. */

/* ---- an object in your memory ---------------------------------------------------------------- */

typedef struct iqn iqn;

/* In a parallel run: replace v[0..count-1] by its sum over all ranks, with the same bits on all of
   them (MPI_Allreduce with MPI_SUM; reduce and broadcast where that does not promise the same
   bits).  Return 0; any other number makes the call fail with IQN_ESUM.  All ranks must return 0,
   or none.  Every rank must make the same calls of iqn_step, iqn_push, iqn_commit, iqn_discard and
   iqn_halve, and of their metric forms, with the same settings, columns and blocks; only lengths
   and arrays differ.  That holds for a rank without interface (n = 0), and for iqn_halve on a
   rank on which H did not fail.  Arguments are checked by each rank alone: if one rank refuses, the
   others wait in their sum. */
typedef int iqn_sum(double *v, int count, void *ctx);

/* Bytes for vectors of n >= 0 local numbers in blocks >= 1 blocks, and at most columns = 0 .. 10000
   pairs.  0: an argument is out of range, or the size or columns times blocks too large. */
IQN_API size_t iqn_size(ptrdiff_t n, int columns, int blocks);

/* Build the object in mem[0..bytes-1], aligned to 8 bytes, and keep it there until the last call.
   On success *q is mem.  There is no destroy.  IQN_ENULL (q), IQN_EARG, IQN_EMEM.  For a waveform n
   is the numbers of all its samples: those at one time times the sub-steps.

   x is cut into blocks, one after the other: block 0 is x[0..length0-1], block 1 follows.  A block
   is a field (displacements, fluxes) or a sample of a waveform, with its own weight, scaling,
   limits and bounds.  For other lengths than n/blocks set IQN_LENGTH of every block before the
   first step; they must add up to n.  On several ranks n and the lengths are those of this rank (0
   where it has no interface), and block b is the same field everywhere. */
IQN_API int iqn_make(iqn **q, ptrdiff_t n, int columns, int blocks, void *mem, size_t bytes);

/* Settings, at any time.  In iqn_set_block block -1 means all blocks: all are set, or none.
   IQN_ENULL (q), IQN_EKEY.  IQN_EVALUE (also: IQN_LOWER above IQN_UPPER: to move both, widen
   first).  IQN_EORDER: IQN_LENGTH after the first step of all, or while there are pairs.  Ranges:
   IQN_METHOD and IQN_SCALING: their constants; IQN_OMEGA and IQN_MIXING -1e6 ... 1e6, not 0;
   IQN_FILTER_LIMIT and IQN_NOISE_LEVEL 0 ... 1; IQN_WEIGHT 0 ... 1e150; limits and IQN_GROWTH from
   0 on; bounds: finite; whole numbers: IQN_LENGTH 0 ... n, IQN_WINDOWS -1 ... 1e6, IQN_MERGE 0 ...
   1e6, IQN_MAX_ITERATIONS and IQN_PATIENCE 0 ... 1e9. */
IQN_API int iqn_set(iqn *q, int key, double value);
IQN_API int iqn_set_block(iqn *q, int block, int key, double value);
/* iqn_get: keys of iqn_set, and all that can only be read.  iqn_get_block: keys of iqn_set_block,
   and IQN_RESIDUAL to IQN_REDUCTION.  Before the first step of all, results are 0, but pushed pairs
   are counted.  Between windows they are those of the old one, but IQN_ITERATIONS is 0, and
   IQN_PAIRS counts what the next step will start with, if IQN_WINDOWS stays.  NaN: q NULL, other
   keys, a block below 0 or beyond the last. */
IQN_API double iqn_get(const iqn *q, int key);
IQN_API double iqn_get_block(const iqn *q, int block, int key);
/* sum NULL: one process, the default.  IQN_ENULL (q). */
IQN_API int iqn_set_sum(iqn *q, iqn_sum *sum, void *ctx);

/* ---- a step, and the end of a window --------------------------------------------------------- */

/* In: x and hx = H(x), n numbers each, apart from each other; NULL will do where n = 0.  Out: x =
   the next input, or hx when converged.  The host may change x between steps: such an iterate is
   taken as it comes, and what |r| does there is not held against the pairs.  The converged
   iteration leaves its pair like any other: so a host with its own criterion calls iqn_step on the
   last iteration as well, and takes hx.

   Remarks as above; 206 to 208 take the place of all but 201, and the step is made all the same.
   IQN_ENULL, IQN_EOVERLAP, IQN_ELENGTH, IQN_ENAN, IQN_ESUM, IQN_EORDER (pairs or the last step of
   this window were made with iqn_step_metric): x and the pairs are as before, and when the cause is
   removed, the same call may be made again. */
IQN_API int iqn_step(iqn *q, double *x, const double *hx);

/* The same in the norm r'M r: mr[0..n-1] = M r, r = hx - x, with a symmetric positive definite M
   that couples numbers of one block only.  mr apart from x; it may overlap hx.  M must not change
   after the first step or push: for another M call iqn_make.  The steps of IQN_AITKEN and
   IQN_CONSTANT are those without M.  IQN_EORDER: pairs or the last step of this window were made
   without M. */
IQN_API int iqn_step_metric(iqn *q, double *x, const double *hx, const double *mr);

/* To be called when H failed at x.  In: x as H got it.  Out: x half of the way back to the iterate
   that the last step started from (not clamped).  May be called again, if H fails there, too.  (Not
   counted in IQN_NWITHDRAWN: those steps the library took back.)  IQN_ENULL, IQN_EORDER: no step in
   this window. */
IQN_API int iqn_halve(iqn *q, double *x);

/* 0: go on; also after iqn_commit and iqn_discard.
   1: the last step with a status >= 0 has converged, by the limits as set when it was made.  If
      there are limits of iqn_set, one of these held; of every block that has limits, one of these
      held.  Without limits, and in any case, r = 0 is convergence.
   2: not converged before IQN_MAX_ITERATIONS or IQN_PATIENCE, as set now, ran out.
   A step that was refused changes nothing here: look at its status first.  IQN_ENULL. */
IQN_API int iqn_converged(const iqn *q);

/* The window is accepted: its pairs, pushed ones, too, become past ones.  Without this call
   iqn_converged stays as it is, and the next step still belongs to this window.  Except with
   IQN_IMVJ, pairs of windows older than the last max(1, IQN_WINDOWS) are forgotten.  With
   IQN_WINDOWS -1 none are.  IQN_ENULL. */
IQN_API int iqn_commit(iqn *q);

/* The window is given up and will be repeated: its pairs are forgotten, pushed ones, too.  (To keep
   those, call iqn_commit after the pushes and before the first step.)  x is left to the host: put a
   first guess there before the next step.  Past pairs that this window has lost remain lost, except
   those that its last step dropped.  D, c_j, omega, the counters and the proof "nonlinear" are
   kept, "affine" is forgotten.  To restore everything, copy the object (and x) at the start of the
   window and copy it back.  After iqn_commit there is nothing to discard: 0, and the pairs stay.
   IQN_ENULL. */
IQN_API int iqn_discard(iqn *q);

/* ---- secant pairs ---------------------------------------------------------------------------- */

/* Store a pair from elsewhere: hx changes by w[0..n-1] when r = hx - x changes by v[0..n-1].  It
   becomes the newest of the current window; if there is no room, another one goes as in a step.  v,
   w and mv may overlap.  IQN_DROPPED, not stored: v is zero, v'mv is above 0 in no block, or
   v'mv / v'v overflows.
   IQN_ENULL, IQN_EARG (0 columns), IQN_ELENGTH, IQN_ENAN (also: |w| / |v| out of range), IQN_ESUM,
   IQN_EORDER: pairs or the last step of this window were made in the other norm.
   iqn_push_metric: mv = M v, for iqn_step_metric. */
IQN_API int iqn_push(iqn *q, const double *v, const double *w);
IQN_API int iqn_push_metric(iqn *q, const double *v, const double *w, const double *mv);

/* Copy pair j of those in use (0 is the newest) to v[0..n-1] and w[0..n-1], apart from each other;
   NULL: not wanted.  IQN_ENULL (q), IQN_EARG: no such pair, IQN_EOVERLAP. */
IQN_API int iqn_pair(const iqn *q, int j, double *v, double *w);

IQN_API int iqn_linked_version(void);
IQN_API const char *iqn_message(int status); /* a constant text, never NULL */

#ifdef __cplusplus
}
#endif
#elif IQN_VERSION != 200
#  error "two different versions of iqn.h in one translation unit"
#endif /* IQN_H_INCLUDED */

/* ---- implementation -------------------------------------------------------------------------- */
#if defined(IQN_IMPLEMENTATION) && !defined(IQN_IMPLEMENTATION_INCLUDED)
#define IQN_IMPLEMENTATION_INCLUDED

/* HOW TO READ THIS HALF.  iqn__step is the table of contents, and what stands before it its parts:
      iqn__measure         reads x, hx and V: sums over rows and ranks; nothing after it can fail
      iqn__record          |r| and |hx|; converged?
      iqn__watch_progress  best residual, and how long nothing has improved
      iqn__learn           is there a pair?  does the iterate become the base?  then the weights
      iqn__choose          the step to come, as three factors: of r_base, of W a and of V a
      iqn__apply           reads W (and V where its factor is not 0); writes pair, base and x

   Between two calls the base is the iterate that the last step started from; the iterate at hand
   makes its pair against it.  iqn__learn decides whether the iterate at hand becomes the new base,
   or the old one stays (where a step raised |r| too much, or was made only to learn).  After
   iqn__learn the base is the iterate that the step to come starts from (in the small numbers;
   iqn__apply moves the long ones).  Its r and hx stand in a slot of V and W that no pair uses:
   there is one slot more than columns.  A slot is a place in memory and never moves; a position is
   an index in order[], 0 the newest pair.  Long vectors have n numbers; all decisions are made on
   small ones, of the size of order[].

   Names, but in the loops of the sweeps: `q` the object, `m` where its arrays lie, `in` what the
   host has handed over, `p` the step to come; `b` a block, `s`, `o` and `slot` slots, `j` and `k`
   positions, `e` an exponent: "in units of 2^e"; in->e of the iterate at hand, q->e of the base. */

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Error-free sums die under -ffast-math and under contraction, and both change bits: off for this
   half of the file. */
#if defined(__clang__)
#  pragma float_control(push)
#  pragma float_control(precise, on)
#  pragma clang fp contract(off)
#elif defined(__GNUC__)
#  pragma GCC push_options
#  pragma GCC optimize("no-fast-math", "no-finite-math-only", "fp-contract=off")
#  pragma GCC optimize("no-tree-loop-vectorize", "tree-slp-vectorize")
#  pragma GCC optimize("no-inline-functions-called-once") /* compiles in 0.87 of the time */
#elif defined(_MSC_VER)
#  pragma float_control(precise, on, push)
#  pragma fp_contract(off)
#endif

/* A function inlined into the host's would take over the host's options. */
#if defined(__GNUC__)
#  define IQN__NOINLINE __attribute__((noinline))
#  define IQN__INLINE static inline __attribute__((always_inline))
#  define IQN__RESTRICT __restrict__
#else
#  define IQN__NOINLINE
#  define IQN__INLINE static
#  define IQN__RESTRICT
#endif
#if defined(__GNUC__) && defined(__x86_64__) && !defined(__FMA__)
#  define IQN__DISPATCH 1 /* compiled for old processors: ask at run time for FMA; the same bits */
#else
#  define IQN__DISPATCH 0
#endif
#if IQN__DISPATCH && (defined(__clang__) ? __clang_major__ >= 12 : __GNUC__ >= 8)
#  define IQN__DISPATCH_WIDE 1 /* ... and for vectors of eight */
#else
#  define IQN__DISPATCH_WIDE 0
#endif
/* clang may lack the first; __ARM_FP & 8: for doubles, too */
#if defined(__FP_FAST_FMA) || defined(__FMA__) || (defined(__ARM_FEATURE_FMA) && (__ARM_FP & 8))
#  define IQN__FMA 1
#else
#  define IQN__FMA 0
#endif

#define IQN__CHUNK 1024  /* rows per chunk: r, v and what belongs to them stay in the nearest cache,
                            and a column is read in pieces of two pages */
#define IQN__STRETCH 512 /* rows of a chunk that are summed before their sum joins the others.  Each
                            of eight lanes takes 64 products and sums their rounding errors in plain
                            double: V'r keeps 30 digits of |V| |r| */
#define IQN__AT_ONCE 8   /* rows of the Cholesky factor L that a loop takes at once; some: four */
#define IQN__PARTS 3     /* numbers that carry one double-double through the host's sum */

/* The numbers of a block in the first sum: the squares of r, hx and M r, three numbers each (see
   iqn__norm_of), and that of the step, one number in units of 4^(q->e) */
enum { IQN__OF_R = 0, IQN__OF_HX = 3, IQN__OF_PRODUCT = 6, IQN__OF_STEP = 9, IQN__NORMS = 10 };

/* The empirical numbers of the rules, with what they were measured on (scenes tube and heat, and
   tests/study).  Nonlinear, curved, inexact, steady: see "What a run has learned of H" below. */
#define IQN__DRIFT_RATE 0.01  /* of D: flat from 0.005 to 0.03 on tube, heat and random sequences */
#define IQN__RANK_TEST 0.09   /* least |R_jj|^2 over the squared uncertainty: flat from 0.01 to 1 */
#define IQN__ROUNDING 1e-14    /* below this times |v|, |R_jj| is made of rounding errors */
#define IQN__AT_BOUND 1e-12    /* of |hx| + |x - hx|: if bounds move x by less, it counts as free */
#define IQN__PROBE_PART 0.1    /* length of probes and small steps: noise is divided by it */
#define IQN__AFFINE 0.3        /* a probe off by less proves H affine: measured 3e-8, else > 0.5 */
#define IQN__TELLING 0.1       /* v tells of H if so much of it would still stand out of its noise:
                                  |v| above 3 nu |hx| (sqrt(IQN__RANK_TEST) / 0.1) */
#define IQN__PROBEABLE 0.006   /* the same, to be worth a probe: |v| above 50 nu |hx|.  A probe's
                                  noise counts ten times: 10/50 of |v|, less than IQN__AFFINE */
#define IQN__CURVATURE 0.01    /* c_j of the older pairs after a surprise, and when a run becomes
                                  inexact.  After a full step that stays, times |r| / |r_base|:
                                  nonlinear: older pairs, new one half; inexact: new one only */
#define IQN__SMALL_STEP 1e-6   /* c_j of a pair from a small step */
#define IQN__EXPLAINED 0.1     /* explore until the pairs leave less than this of |r|; not below
                                  IQN__PROBE_PART, see iqn__plan_exploring */
#define IQN__IDLE 3            /* ... or so many pairs in a row did not lower it by a tenth */
#define IQN__DISAPPOINTING 0.3 /* a full step that left more than this of |r| */
#define IQN__DOUBLED 2         /* a full step that raised |r| so much ends a steady run for good */
#define IQN__LUCK 0.5          /* a small step that left less than this of |r| becomes the base */
#define IQN__FORESEEN 0.1      /* steady: a window's 2nd |r| is at most this times the A of
                                  iqn__claim (flat from 0.05 to 0.2) */
#define IQN__CURVED 0.1        /* c_j of the pairs kept when a nonlinear H has a step taken back */
#define IQN__SURPRISE 10       /* |r| so many times above what the steepest slope explains */
#define IQN__MISSED_LEAST 0.1  /* a miss: |r| fell, but stayed far above the prediction and above
                                  this part of |r_base| (flat from 0.01), */
#define IQN__MISSED_MOST 0.5   /* and below this: steps that leave more occur on affine maps, too */
#define IQN__MISSED_OFTEN 3    /* inexact: so many misses in one window (flat to 5) */
#define IQN__REDUNDANT 0.05    /* |R_jj| over |v_j|: memory for such a pair is better used */
#define IQN__RESTARTS 3        /* in a window; none: 28 of 120 curved maps failed in place of 18 */
#define IQN__PROGRESS 0.9      /* a residual below so much of the last milestone */
#define IQN__FAR_DOWN 1e-3     /* of the first residual: what stops there is noise */
#define IQN__FAR_UP 1e3        /* of the least residual: what stops there diverges */
#define IQN__FAR 1e300         /* |x - x_base|^2 of that or more: not known, sums stay finite */
#define IQN__OMEGA_MOST 1e6    /* a larger secant of Aitken is noise over noise */
#define IQN__GUARD_FROM 10     /* x runs away: growth of |hx| from which the guard holds, */
#define IQN__GUARD_FALLEN 0.1  /* the |r| it asks for, relative to the first one, */
#define IQN__GUARD_MOST 1000   /* and the growth from which |hx| counts no further */
#define IQN__RESCALE_AT 10     /* residual-sum scaling: a sum so many times off is replaced */
#define IQN__BITS_TO_SPARE 150 /* powers of 2 that a guess of |r| may be off: 4^150 is in range */

/* ---- double-double numbers h + l ------------------------------------------------------------- */

typedef struct iqn__dd {
    double h, l;
} iqn__dd;

IQN__INLINE iqn__dd iqn__two_sum(double a, double b)
{
    iqn__dd s;
    double t;
    s.h = a + b;
    t = s.h - a;
    s.l = (a - (s.h - t)) + (b - t);
    return s;
}

IQN__INLINE iqn__dd iqn__fast_two_sum(double a, double b) /* |a| >= |b| or a = 0 */
{
    iqn__dd s;
    s.h = a + b;
    s.l = b - (s.h - a);
    return s;
}

/* a b - p for p = fl(a b): one fused operation, or Dekker's splitting at 2^27 + 1 */
IQN__INLINE double iqn__product_error(double a, double b, double p, int fused)
{
    const double split = 134217729.0;
    double ah, al, bh, bl, t;
#if defined(__GNUC__)
    if (fused) return __builtin_fma(a, b, -p);
#else
    if (fused) return fma(a, b, -p);
#endif
    t = split * a;
    ah = t - (t - a);
    al = a - ah;
    t = split * b;
    bh = t - (t - b);
    bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}

/* a b - z for a z near p = fl(a b): where p - z is exact, the same bits fused or not */
IQN__INLINE double iqn__product_rest(double a, double b, double p, double z, int fused)
{
#ifndef __clang__ /* clang's -ffp-contract=fast fuses p = a b with t + p if p has no other use */
    if (fused) return iqn__product_error(a, b, z, fused);
#endif
    return (p - z) + iqn__product_error(a, b, p, fused);
}

/* a double as a double-double */
IQN__INLINE iqn__dd iqn__dd_of(double h)
{
    iqn__dd r;
    r.h = h;
    r.l = 0;
    return r;
}

IQN__INLINE iqn__dd iqn__add(iqn__dd a, iqn__dd b)
{
    iqn__dd s = iqn__two_sum(a.h, b.h), t = iqn__two_sum(a.l, b.l);
    s = iqn__fast_two_sum(s.h, s.l + t.h);
    return iqn__fast_two_sum(s.h, s.l + t.l);
}

/* The low parts' own product is below the last place. */
IQN__INLINE iqn__dd iqn__product(iqn__dd a, iqn__dd b, int fused)
{
    double p = a.h * b.h, error = iqn__product_error(a.h, b.h, p, fused);
    return iqn__fast_two_sum(p, error + (a.h * b.l + a.l * b.h));
}

IQN__INLINE iqn__dd iqn__mul(iqn__dd a, iqn__dd b)
{
    return iqn__product(a, b, IQN__FMA);
}

IQN__INLINE iqn__dd iqn__minus(iqn__dd a)
{
    a.h = -a.h;
    a.l = -a.l;
    return a;
}

IQN__INLINE iqn__dd iqn__sub(iqn__dd a, iqn__dd b)
{
    return iqn__add(a, iqn__minus(b));
}

/* 1 / sqrt(a), a > 0: with e = 1 - a y^2 of a double y it is y (1 + e/2 + 3 e^2/8 + ...) */
static iqn__dd iqn__reciprocal_root(iqn__dd a)
{
    const double y = 1 / sqrt(a.h), p = y * y;
    const iqn__dd square = iqn__fast_two_sum(p, iqn__product_error(y, y, p, IQN__FMA));
    const double e = iqn__sub(iqn__dd_of(1), iqn__mul(a, square)).h;
    return iqn__fast_two_sum(y, y * e * (0.5 + 0.375 * e));
}

/* ---- bits, exponents, norms ------------------------------------------------------------------ */

static int iqn__finite(double a) /* on the bits: isfinite folds to 1 under -ffast-math */
{
    uint64_t u;
    memcpy(&u, &a, sizeof u);
    return (u >> 52 & 0x7ff) != 0x7ff;
}

static int iqn__is_nan(double a)
{
    uint64_t u;
    memcpy(&u, &a, sizeof u);
    return u << 1 > (uint64_t)0x7ff << 53;
}

static double iqn__of_bits(uint64_t u)
{
    double a;
    memcpy(&a, &u, sizeof a);
    return a;
}

static double iqn__nan(void)
{
    return iqn__of_bits((uint64_t)0x7ff8 << 48);
}

static double iqn__pow2(int k) /* -1022 <= k <= 1023 */
{
    return iqn__of_bits((uint64_t)(k + 1023) << 52);
}

IQN__INLINE iqn__dd iqn__shift(iqn__dd a, int k) /* a 2^k */
{
    if (k < -1022 || k > 1023) {
        a.h = ldexp(a.h, k);
        a.l = ldexp(a.l, k);
        return a;
    }
    a.h *= iqn__pow2(k);
    a.l *= iqn__pow2(k);
    return a;
}

static int iqn__clamp(int k, int limit) /* to -limit ... limit */
{
    if (k > limit) return limit;
    return k < -limit ? -limit : k;
}

static double iqn__square(double a)
{
    return a * a;
}

static int iqn__larger(int a, int b)
{
    return a > b ? a : b;
}

/* Least k with a < 2^k, between -900 and 1020.  Everywhere below, the bound of a number is a k with
   |.| < 2^k, if it does not leave this range. */
static int iqn__bound(double a)
{
    int k;
    if (!(a > 0)) return -900;
    if (!iqn__finite(a)) return 1020;
    frexp(a, &k);
    return k > 1020 ? 1020 : iqn__larger(k, -900);
}

/* iqn__bound of a plain sum of squares, with room for its own rounding, and for the 1e-13 that
   iqn__unrolled needs below its bound */
static int iqn__square_bound(double sum)
{
    return iqn__bound(sum * (1 + 1e-12));
}

/* A norm f 2^e, f in [0.5, 1) or 0: the norm of finite numbers may overflow a double. */
typedef struct iqn__norm {
    double f;
    int e, filler; /* no padding: every byte of a checkpoint is defined */
} iqn__norm;

static iqn__norm iqn__norm_at(double a, int e) /* a 2^e; 0 where a is not above 0 */
{
    iqn__norm b;
    int exponent = 0;
    b.filler = 0;
    b.f = a > 0 ? frexp(a, &exponent) : 0;
    b.e = a > 0 ? exponent + e : -2000; /* smaller than any other */
    return b;
}

static iqn__norm iqn__root(double square, int e) /* sqrt(square) 2^e; 0 where it is not above 0 */
{
    return iqn__norm_at(square > 0 ? sqrt(square) : 0, e);
}

static iqn__norm iqn__zero_norm(void)
{
    return iqn__norm_at(0, 0);
}

static iqn__norm iqn__unit_norm(void)
{
    return iqn__norm_at(1, 0);
}

static double iqn__ratio(iqn__norm a, iqn__norm b) /* a/b; 0/0 = 0 */
{
    if (a.f == 0) return 0;
    return b.f == 0 ? HUGE_VAL : ldexp(a.f / b.f, a.e - b.e);
}

/* big sqrt(1 + (small/big)^2): no square leaves the range */
static iqn__norm iqn__hypot(iqn__norm a, iqn__norm b)
{
    const iqn__norm more = a.e > b.e ? a : b, less = a.e > b.e ? b : a;
    return iqn__root(more.f * more.f * (1 + iqn__square(iqn__ratio(less, more))), more.e);
}

static double iqn__value_of(iqn__norm a)
{
    return ldexp(a.f, a.e);
}

/* The norm of squares in units of 2^1200, 1 and 2^-1200 */
static iqn__norm iqn__norm_of(const double *square)
{
    iqn__norm a = iqn__hypot(iqn__root(square[0], 600), iqn__root(square[1], 0));
    return iqn__hypot(a, iqn__root(square[2], -600));
}

/* ---- the object ------------------------------------------------------------------------------ */

enum { IQN__SETTINGS = IQN_MERGE + 1, IQN__BLOCK_SETTINGS = IQN_UPPER - IQN_LENGTH + 1 };
enum { IQN__COUNTERS = IQN_NRESTARTED - IQN_NSTEPS + 1, IQN__UNUSED = 158 }; /* of 0.1.0 */

/* What the last step was.  Where the host has changed x, it counts as plain; so does a probe after
   a push. */
enum { IQN__PLAIN, IQN__FULL, IQN__PROBE, IQN__SMALL };

struct iqn {
    ptrdiff_t n;
    iqn_sum *sum;
    void *ctx;
    double set[IQN__SETTINGS];
    double counter[IQN__COUNTERS];
    double omega;             /* of the last relaxation, sign and all */
    double best_relative;     /* least |r| / |hx| of this window */
    double drift;             /* D of the mathematics */
    double slope;             /* |r - r_base| / |x - x_base|, as last seen; 0: not yet */
    double steepest;          /* the largest slope of this window; nonlinear: fading, of the run */
    double least_left;        /* least |r + V a| / |r| while exploring: this base, these pairs */
    double rows;              /* numbers with a weight, of all ranks: more pairs than these are
                                 averaged */
    uint64_t handed_out;      /* fingerprint of the x that the last step gave the host */
    iqn__norm residual, value, first;
    iqn__norm accepted_value;  /* |hx| when a window was committed */
    iqn__norm growth_from;     /* see iqn__set_growth_from */
    iqn__norm best, milestone; /* least residual of the window; where progress is counted from */
    iqn__norm claimed;         /* what past pairs were to remove in step 1: A, see iqn__claim */
    iqn__norm predicted;       /* |r + V a| if the last step is a full one, else |r| of its base */
    int columns, blocks;      /* capacities */
    int used;                 /* pairs stored: slots order[0..used-1], newest first */
    int marked;               /* ... of them with dropped[slot]: left out of the last least squares,
                                 forgotten (out of order[0..used-1]) at the next step */
    int base;                 /* the slot that holds r and hx of the base */
    int chained;              /* ... which belongs to this window, so the next step makes a pair */
    int e;                    /* V'r is in units of 2^e; rr and moved of every block in 4^e */
    int window, iterations;   /* number of the current window; steps in it */
    int converged, stepped;   /* the last step is the answer; any step yet: lengths are fixed */
    int since_merge;          /* IMVJ: windows committed since all pairs became one group */
    int waited;               /* see iqn__out_of_patience */
    int most_kept;            /* the most pairs of this window that a least squares has kept */
    int kind;                 /* of the last step */
    int metric;               /* V'V and V'r hold V'M V and V'M r */
    int affine, nonlinear;    /* proved: for this window, for this run */
    int exploring, idle;      /* small steps before full ones; steps since least_left fell */
    int suspicious;           /* the last full step disappointed: try the next one out */
    int surprises, curved;    /* failed predictions of this window; for the run: more than one */
    int missed, inexact;      /* the same of steps that lowered |r|; for the run: more than two */
    int restarts;             /* of this window */
    int steady;               /* past pairs predict first steps: 1; not yet: 0; no longer: -1 */
    int probed;               /* slot of the pair that a probe tests */
};

typedef struct iqn__block {
    ptrdiff_t length;
    double set[IQN__BLOCK_SETTINGS], tol[3];
    iqn__norm residual, value, first, accepted_value, growth_from;
    iqn__norm now, now_value, now_product; /* |r|, |hx|, |M r| of a step that may still fail */
    iqn__norm base_residual, base_value;   /* |r| and |hx| of the base */
    iqn__norm weight;
    double relative_weight; /* the weight beside the largest, see iqn__relative_weight */
    iqn__dd in_S;           /* the square of the weight that S was made with */
    iqn__dd rr;             /* r'M r of the base, in units of 4^e */
    double moved;           /* |x - x_base|^2 of the step just made, in units of 4^e, this rank */
    double now_moved;       /* the same, summed over all ranks: known when its iterate comes back */
    double sum, used_sum;   /* residual-sum scaling: the sum of this window and the one in use */
} iqn__block;

/* Everything in the caller's memory behind struct iqn.  Slot s of V is V + s n, of W it is W + s n;
   row s of the Gram matrix of block b is gram + (b slots + s) slots: only its entries for older
   pairs, and for s itself, are set.  Pair s is stored as v 2^-exponent[s] and w 2^-exponent[s]. */
typedef struct iqn__view {
    int slots;
    iqn__block *block;
    iqn__dd *gram, *Vr, *sums;     /* V'V and V'r per block; sums on the way */
    iqn__dd *S, *y;                /* weighted Gram matrix by slots; by position V'r, then z = what
                                      newer groups leave of it, then y of L y = -z */
    int *assembled;                /* is this slot in S? */
    ptrdiff_t lead;                /* column j of the Cholesky factor L, by positions: Lh + j lead,
                                      Ll + j lead */
    double *Lh, *Ll, *ah, *al;     /* L and the solution a, high and low parts apart */
    double *V, *W;                 /* n x slots */
    double *r, *v, *d, *product;   /* rows of a sweep, see iqn__form; iqn__apply_rows: r as y */
    double *message, *coefficient; /* one message; the solution times 2^e, for stored columns */
    double *size;                  /* |hx| of the pair times 2^-exponent, per block and slot */
    double *drift, *curvature;     /* D_j and c_j of a slot */
    double *apart;                 /* |R_jj|^2 / |v_j|^2 of a slot when last factored */
    double *noise, *doubt;         /* by position: squares of nu |hx_j| and of s_j */
    double *inverse_row;           /* by position, see iqn__inherited_at_most */
    double *inherited;             /* work of iqn__inherited */
    int *order, *exponent, *window, *dropped;
    int *v_bound;         /* per block and slot: bound of |v| there, as stored */
    int *kept;            /* kept pairs as positions in order */
    int weight_exponent;  /* weights are held relative to 2^(weight_exponent - 1): the largest is
                             then in [1, 2).  S is made of squares of these and of the columns as
                             stored.  Not in memory: iqn__relate_weights sets it in every step */
} iqn__view;

/* The next piece of the caller's memory, aligned to 8.  Sizes that do not fit into a size_t stick
   at a number that no request meets; with mem NULL only the size is counted. */
static void *iqn__place(size_t *at, void *mem, size_t count, size_t size)
{
    size_t old = *at, most = (size_t)-1 / 4;
    void *p = mem ? (void *)((char *)mem + old) : NULL;
    int fits = old <= most && count <= (most - old) / size;
    *at = fits ? (old + count * size + 7) / 8 * 8 : most + 1;
    return p;
}

/* One function decides where everything lies; the size is what it ends at.  The long columns stand
   last, behind everything small. */
static size_t iqn__layout(ptrdiff_t n, int columns, int blocks, void *mem, iqn__view *m)
{
    const size_t real = sizeof(double), whole = sizeof(int), dd = sizeof(iqn__dd);
    size_t slots, lead, B, rows, at = 0, entries, numbers;
    if (n < 0 || columns < 0 || blocks < 1 || columns > 10000) return 0;
    /* a message has at most IQN__PARTS (2 slots + 4) <= 10 (columns + 3) numbers per block, counted
       in int */
    if (blocks > INT_MAX / 10 / (columns + 3)) return 0;
    slots = (size_t)columns + 1;
    lead = (slots + IQN__AT_ONCE - 1) / IQN__AT_ONCE * IQN__AT_ONCE;
    B = (size_t)blocks;
    rows = n < IQN__CHUNK ? (size_t)n : (size_t)IQN__CHUNK;
    entries = slots * slots;
    numbers = B * (2 * slots + 4); /* 2 for each slot and IQN__OWN */
    iqn__place(&at, mem, 1, sizeof(struct iqn));
    m->slots = columns + 1;
    m->lead = (ptrdiff_t)lead;
    m->block = (iqn__block *)iqn__place(&at, mem, B, sizeof(iqn__block));
    m->gram = (iqn__dd *)iqn__place(&at, mem, B, entries * dd);
    m->Vr = (iqn__dd *)iqn__place(&at, mem, B * slots, dd);
    m->sums = (iqn__dd *)iqn__place(&at, mem, numbers, dd);
    m->S = (iqn__dd *)iqn__place(&at, mem, entries, dd);
    m->Lh = (double *)iqn__place(&at, mem, slots * lead, real);
    m->Ll = (double *)iqn__place(&at, mem, slots * lead, real);
    m->ah = (double *)iqn__place(&at, mem, slots, real);
    m->al = (double *)iqn__place(&at, mem, slots, real);
    m->y = (iqn__dd *)iqn__place(&at, mem, slots, dd);
    /* one message at a time: the first has 10 B + 2 numbers, here are 3 * 6 B at least */
    m->message = (double *)iqn__place(&at, mem, IQN__PARTS * numbers, real);
    m->coefficient = (double *)iqn__place(&at, mem, slots, real);
    m->size = (double *)iqn__place(&at, mem, B * slots, real);
    m->drift = (double *)iqn__place(&at, mem, slots, real);
    m->curvature = (double *)iqn__place(&at, mem, slots, real);
    m->apart = (double *)iqn__place(&at, mem, slots, real);
    m->noise = (double *)iqn__place(&at, mem, slots, real);
    m->doubt = (double *)iqn__place(&at, mem, slots, real);
    m->inverse_row = (double *)iqn__place(&at, mem, slots, real);
    m->inherited = (double *)iqn__place(&at, mem, slots, real);
    m->order = (int *)iqn__place(&at, mem, slots, whole);
    m->exponent = (int *)iqn__place(&at, mem, slots, whole);
    m->v_bound = (int *)iqn__place(&at, mem, B * slots, whole);
    m->window = (int *)iqn__place(&at, mem, slots, whole);
    m->dropped = (int *)iqn__place(&at, mem, slots, whole);
    m->kept = (int *)iqn__place(&at, mem, slots, whole);
    m->assembled = (int *)iqn__place(&at, mem, slots, whole);
    m->r = (double *)iqn__place(&at, mem, rows, real);
    m->v = (double *)iqn__place(&at, mem, rows, real);
    m->d = (double *)iqn__place(&at, mem, rows, real);
    m->product = (double *)iqn__place(&at, mem, rows, real);
    m->V = (double *)iqn__place(&at, mem, (size_t)n, slots * real);
    m->W = (double *)iqn__place(&at, mem, (size_t)n, slots * real);
    return at > (size_t)-1 / 4 ? 0 : at;
}

/* Pointers are made anew in every call: the block may be moved or copied between calls. */
static iqn__view iqn__open(const iqn *q)
{
    iqn__view m;
    iqn__layout(q->n, q->columns, q->blocks, (void *)(uintptr_t)q, &m);
    return m;
}

static int iqn__method(const iqn *q)
{
    return (int)q->set[IQN_METHOD];
}

static int iqn__has_pairs(const iqn *q)
{
    return iqn__method(q) == IQN_ILS || iqn__method(q) == IQN_IMVJ;
}

/* ILS that trusts pairs by their uncertainty?  Drift is watched, and the choice of the pair that
   makes room is free.  (IMVJ solves for each window apart and uses nu and c_j alone; a filter limit
   means textbook.) */
static int iqn__by_uncertainty(const iqn *q)
{
    return iqn__method(q) == IQN_ILS && !(q->set[IQN_FILTER_LIMIT] > 0);
}

static int iqn__takes_back(const iqn *q)
{
    return q->set[IQN_GROWTH] > 0;
}

/* Do the adaptive rules hold: surprises and misses (curved, inexact), and starting over? */
static int iqn__is_adaptive(const iqn *q)
{
    return iqn__by_uncertainty(q) && iqn__takes_back(q);
}

static int iqn__slot_in_window(const iqn *q, const iqn__view *m, int slot)
{
    return m->window[slot] == q->window;
}

static void iqn__count(iqn *q, int counter)
{
    q->counter[counter - IQN_NSTEPS]++;
}

/* The sums of a block in one call: two for every slot, then four of the block's own, in units of
   4^(in->e) (with columns of V: 2^(in->e); r_base'y of a push: 2^(in->e + q->e)).  y is r in a step
   and v in a push, with a metric M times that.
                       slot: [0]  [1]        own: IQN__RR  IQN__VR          IQN__VV          IQN__VD
      step                   V'y  V'd             r'y      v'y              v'v              v'd
      with a metric          V'y  0               r'y      v'y              v'v, without M   0
      IQN_AITKEN             V'y  not used        r'y      v'(x - x_base)   v'v, without M   0
      push (y = v or M v)    V'y  0               v'y      r_base'y         not used         0
   d is what rounding added to v: v = r - r_base + d. */
enum { IQN__RR, IQN__VR, IQN__VV, IQN__VD, IQN__OWN };

static iqn__dd *iqn__sums_of(const iqn__view *m, int b)
{
    return m->sums + (ptrdiff_t)b * (2 * m->slots + IQN__OWN);
}

static iqn__dd *iqn__own_of(const iqn__view *m, int b)
{
    return iqn__sums_of(m, b) + 2 * m->slots;
}

/* ---- sweeps over the long vectors ------------------------------------------------------------ */

/* Lanes in named scalars: compilers turn them into vector registers without flags, and the order of
   additions, hence every bit of the result, does not depend on the processor.  The loop vectoriser
   would shuffle the lanes, and make short loops longer: that of gcc is off in this half of the
   file, that of clang in the loops marked by this. */
#if defined(__clang__)
#  define IQN__NO_VECTORISER _Pragma("clang loop vectorize(disable) unroll(disable)")
#else
#  define IQN__NO_VECTORISER
#endif
#if defined(__GNUC__) /* 1 KiB ahead: hardware that follows streams stops at the end of a page */
#  define IQN__PREFETCH(p) __builtin_prefetch((const void *)((uintptr_t)(p) + 1024));
#else
#  define IQN__PREFETCH(p)
#endif
#define IQN__FOUR(X) X(0) X(1) X(2) X(3)
#define IQN__EIGHT(X) IQN__FOUR(X) X(4) X(5) X(6) X(7)

/* A kernel is a loop over rows.  It is compiled for two or three kinds of processors from one body,
   and one function chooses.  Fused or split, the bits are the same: only the speed depends on the
   processor.  Bodies that have nothing to fuse do not use `fused`: they are compiled for the wider
   registers.  Those in which most of the time goes are also compiled for registers of eight
   numbers, where the processor has AVX512_VBMI2, as Intel's have from Ice Lake on and AMD's from
   Zen 4 on: earlier ones lower their clock for them.

   A function for a processor chosen at run time holds its loops and nothing else: it calls no
   function, hands its lanes over in memory, and ends in IQN__UPPER_HALVES_CLEAN, for with dirty
   upper halves the host's SSE code runs at a quarter of its speed. */
#if IQN__DISPATCH
#  if IQN__DISPATCH_WIDE && !defined(__clang__) /* untuned, gcc loads at each use */
#    define IQN__AVX2 "avx2,fma,prefer-vector-width=256,tune=icelake-server"
#    define IQN__AVX512 "avx512f,fma,prefer-vector-width=512,tune=icelake-server"
#  else
#    define IQN__AVX2 "avx2,fma"
#    define IQN__AVX512 "avx512f,fma"
#  endif
#  define IQN__UPPER_HALVES_CLEAN __builtin_ia32_vzeroupper();
#  define IQN__COMPILED_FOR(processor, name, parameters, call)                                     \
    __attribute__((target(processor), noinline)) static void name parameters                       \
    {                                                                                              \
        call;                                                                                      \
        IQN__UPPER_HALVES_CLEAN                                                                    \
    }
#  define IQN__VERSIONS(name, parameters, ...)                                                     \
    static void name##_plain parameters { name##_body(__VA_ARGS__, 0); }                           \
    IQN__COMPILED_FOR(IQN__AVX2, name##_fused, parameters, name##_body(__VA_ARGS__, 1))
#  define IQN__CHOICE(name, ...)                                                                   \
    if (iqn__has_fma()) name##_fused(__VA_ARGS__);                                                 \
    else name##_plain(__VA_ARGS__);
#  define IQN__KERNEL(name, parameters, ...)                                                       \
    IQN__VERSIONS(name, parameters, __VA_ARGS__)                                                   \
    static void name parameters { IQN__CHOICE(name, __VA_ARGS__) }

IQN__INLINE int iqn__has_fma(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
#  define IQN__KERNEL(name, parameters, ...)                                                       \
    static void name parameters { name##_body(__VA_ARGS__, IQN__FMA); }
#endif

/* `eight` is the body for registers of eight: another one, or the same. */
#if IQN__DISPATCH_WIDE
#  define IQN__WIDE_KERNEL(name, eight, parameters, ...)                                           \
    IQN__VERSIONS(name, parameters, __VA_ARGS__)                                                   \
    IQN__COMPILED_FOR(IQN__AVX512, name##_wide, parameters, eight(__VA_ARGS__, 1))                 \
    static void name parameters                                                                    \
    {                                                                                              \
        if (iqn__has_wide()) name##_wide(__VA_ARGS__);                                             \
        else IQN__CHOICE(name, __VA_ARGS__)                                                        \
    }

IQN__INLINE int iqn__has_wide(void)
{
    return __builtin_cpu_supports("avx512vbmi2");
}
#elif defined(__AVX512F__)
#  define IQN__WIDE_KERNEL(name, eight, parameters, ...)                                           \
    static void name parameters { eight(__VA_ARGS__, IQN__FMA); }
#else
#  define IQN__WIDE_KERNEL(name, eight, parameters, ...) IQN__KERNEL(name, parameters, __VA_ARGS__)
#endif

/* The macros of a lane use the variables of the loop that they stand in.  For lane k of column c: s
   is the sum of a'y, l what rounding takes from it, u the sum of a'd; p is a y rounded, t is s + p
   rounded, and z what of p has arrived in t.
      columns  the two a
      starts   of the two s
      lanes    24 per column: eight s, eight l, eight u */
#define IQN__TWO(X) X(0) X(1)
#define IQN__LANES_OF(X, c) X(c, 0) X(c, 1) X(c, 2) X(c, 3) X(c, 4) X(c, 5) X(c, 6) X(c, 7)
#define IQN__COLUMN(c) const double *a##c = columns[c];
#define IQN__FETCH(c) IQN__PREFETCH(a##c + i)
#define IQN__LANE_START(c, k) double s##c##k = starts[c], l##c##k = 0, u##c##k = 0;
#define IQN__LANE_ADD(c, k)                                           \
    p = a##c[i + k] * y[i + k];                                       \
    t = s##c##k + p;                                                  \
    z = t - s##c##k;                                                  \
    l##c##k += iqn__product_rest(a##c[i + k], y[i + k], p, z, fused); \
    s##c##k = t;                                                      \
    u##c##k += a##c[i + k] * d[i + k];
#define IQN__LANE_OUT_S(c, k) lanes[24 * c + k] = s##c##k;
#define IQN__LANE_OUT_L(c, k) lanes[24 * c + 8 + k] = l##c##k;
#define IQN__LANE_OUT_U(c, k) lanes[24 * c + 16 + k] = u##c##k;
#define IQN__START(c) IQN__LANES_OF(IQN__LANE_START, c)
#define IQN__ADD(c) IQN__LANES_OF(IQN__LANE_ADD, c)
#define IQN__OUT(c)                   \
    IQN__LANES_OF(IQN__LANE_OUT_S, c) \
    IQN__LANES_OF(IQN__LANE_OUT_L, c) \
    IQN__LANES_OF(IQN__LANE_OUT_U, c)

/* Eight lanes each of a'y, of what rounding takes from it, and of a'd, for two columns a; row i is
   in lane i mod 8.  A lane of a'y starts at s = 1.5 2^k with |a| |y| < (1 - 1e-13) 2^k, see
   iqn__square_bound.  By Cauchy all |p| add up to less, so s >= 0.5 2^k + |p| before each p: as in
   iqn__fast_two_sum, t - s and p - z are exact, and every sum is a multiple of 2^(k-53): less their
   starts the lanes add without rounding. */
IQN__INLINE ptrdiff_t iqn__unrolled(ptrdiff_t n, const double *const *columns, const double *y,
                                    const double *d, const double *starts, double *lanes)
{
    const int fused = 1;
    IQN__TWO(IQN__COLUMN)
    IQN__TWO(IQN__START)
    double p, t, z;
    ptrdiff_t i;
    IQN__NO_VECTORISER
    for (i = 0; i + 8 <= n; i += 8) {
        IQN__TWO(IQN__FETCH)
        IQN__TWO(IQN__ADD)
    }
    IQN__TWO(IQN__OUT)
    return i;
}

/* The same one by one: what is left over, and without fused operations everything */
IQN__INLINE void iqn__one_by_one(ptrdiff_t i, ptrdiff_t n, const double *const *columns,
                                 const double *y, const double *d, double *lanes, int fused)
{
    double p, t, z;
    int c;
    for (; i < n; i++)
        for (c = 0; c < 2; c++) {
            const double a = columns[c][i];
            double *lane = lanes + 24 * c + (i & 7);
            p = a * y[i];
            t = lane[0] + p;
            z = t - lane[0];
            lane[8] += iqn__product_rest(a, y[i], p, z, fused);
            lane[0] = t;
            lane[16] += a * d[i];
        }
}

IQN__INLINE void iqn__two_products_body(ptrdiff_t n, const double *const *columns, const double *y,
                                        const double *d, const double *starts, double *lanes,
                                        int fused)
{
    ptrdiff_t i = 0;
    int k;
    if (fused) i = iqn__unrolled(n, columns, y, d, starts, lanes);
    else
        for (k = 0; k < 48; k++) lanes[k] = k % 24 < 8 ? starts[k / 24] : 0;
    iqn__one_by_one(i, n, columns, y, d, lanes, fused);
}

IQN__WIDE_KERNEL(iqn__two_products, iqn__two_products_body,
                 (ptrdiff_t n, const double *const *columns, const double *y, const double *d,
                  const double *starts, double *lanes),
                 n, columns, y, d, starts, lanes)

/* The vectors y and d that columns are multiplied by */
typedef struct iqn__side {
    const double *y, *d;
    int square; /* bound of y'y */
} iqn__side;

/* A column of the sweep and where its products go */
typedef struct iqn__column {
    const double *a;
    int square; /* bound of a'a */
    iqn__dd *exact;
    double *plain; /* NULL: not wanted */
} iqn__column;

IQN__INLINE double iqn__sum_lanes(const double *s)
{
    return (s[0] + s[2]) + (s[1] + s[3]);
}

IQN__INLINE double iqn__sum_eight(const double *s)
{
    return iqn__sum_lanes(s) + iqn__sum_lanes(s + 4);
}

/* The lanes of a column join its sums; those of a'y began at `start`. */
static void iqn__add_lanes(const iqn__column *to, double *lanes, double start)
{
    iqn__dd sum;
    int k;
    for (k = 0; k < 8; k++) lanes[k] -= start;
    sum = iqn__two_sum(iqn__sum_eight(lanes), iqn__sum_eight(lanes + 8));
    *to->exact = iqn__add(*to->exact, sum);
    if (to->plain) *to->plain += iqn__sum_eight(lanes + 16);
}

/* exact += a'y in double-double, plain += a'd in double, for one column or two.  The kernel takes
   two: the first one stands in for a second that is missing. */
static void iqn__dot(ptrdiff_t n, const iqn__side *side, int count, const iqn__column *column)
{
    double starts[2], lanes[48];
    ptrdiff_t i, rows;
    int c;
    for (c = 0; c < 2; c++) {
        const int square = column[c < count ? c : 0].square + side->square;
        starts[c] = 1.5 * iqn__pow2((square + 2001) / 2 - 1000); /* half of it, rounded up */
    }
    for (i = 0; i < n; i += rows) {
        const double *columns[2] = {column[0].a + i, column[count - 1].a + i};
        rows = n - i < IQN__STRETCH ? n - i : IQN__STRETCH;
        iqn__two_products(rows, columns, side->y + i, side->d + i, starts, lanes);
        for (c = 0; c < count; c++) iqn__add_lanes(column + c, lanes + c * 24, starts[c]);
    }
}

#define IQN__COLUMNS_IN(k)                                                                         \
    const double sum##k =                                                                         \
        y[i + k] + ((a0 * w0[i + k] + a1 * w1[i + k]) + (a2 * w2[i + k] + a3 * w3[i + k]));
#define IQN__COLUMNS_OUT(k) y[i + k] = sum##k;

/* y += w0 a0 + w1 a1 + w2 a2 + w3 a3 */
IQN__INLINE void iqn__add_four_columns_body(ptrdiff_t rows, double *IQN__RESTRICT y,
                                            const double *const *w, double a0, double a1,
                                            double a2, double a3, int fused)
{
    const double *w0 = w[0], *w1 = w[1], *w2 = w[2], *w3 = w[3];
    ptrdiff_t i;
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 8 <= rows; i += 8) {
        IQN__EIGHT(IQN__COLUMNS_IN)
        IQN__EIGHT(IQN__COLUMNS_OUT)
    }
    for (; i < rows; i++) {
        IQN__COLUMNS_IN(0)
        IQN__COLUMNS_OUT(0)
    }
}

IQN__WIDE_KERNEL(iqn__add_four_columns, iqn__add_four_columns_body,
                 (ptrdiff_t rows, double *y, const double *const *w, double a0, double a1,
                  double a2, double a3),
                 rows, y, w, a0, a1, a2, a3)

/* What a sweep reads of a chunk, and what it forms: see iqn__form */
typedef struct iqn__rows {
    const double *h, *x, *base; /* hx, x, r_base */
    double unit, base_unit;     /* of r, of r_base: factors */
    double *r, *v, *d;
} iqn__rows;

#define IQN__SQUARES_START(k) double rr##k = 0, vv##k = 0, hh##k = 0;
/* r = now, v = change and d = extra, with change = now - before + extra exactly: iqn__two_sum of
   now and -before, of which `back` has arrived in change */
#define IQN__FORM_IN(k)                                                               \
    const double value##k = h[i + k], now##k = (value##k - x[i + k]) * unit,          \
                 before##k = base[i + k] * base_unit, change##k = now##k - before##k, \
                 back##k = change##k - now##k,                                        \
                 extra##k = (back##k + before##k) - (now##k - (change##k - back##k));
#define IQN__FORM_OUT_R(k) r[i + k] = now##k;
#define IQN__FORM_OUT_V(k) v[i + k] = change##k;
#define IQN__FORM_OUT_D(k) d[i + k] = extra##k;
#define IQN__SQUARES_ADD(k)         \
    rr##k += now##k * now##k;       \
    vv##k += change##k * change##k; \
    hh##k += value##k * value##k;
#define IQN__SQUARES_OUT(k) squares[k] = rr##k, squares[4 + k] = vv##k, squares[8 + k] = hh##k;

/* r, v, d, and four lanes each of r'r, v'v and hx'hx */
IQN__INLINE void iqn__form_rows_body(ptrdiff_t n, const iqn__rows *from, double *squares, int fused)
{
    const double *h = from->h, *x = from->x, *base = from->base;
    const double unit = from->unit, base_unit = from->base_unit;
    double *r = from->r, *v = from->v, *d = from->d;
    ptrdiff_t i;
    IQN__FOUR(IQN__SQUARES_START)
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4) {
        IQN__FOUR(IQN__FORM_IN)
        IQN__FOUR(IQN__FORM_OUT_R)
        IQN__FOUR(IQN__FORM_OUT_V)
        IQN__FOUR(IQN__FORM_OUT_D)
        IQN__FOUR(IQN__SQUARES_ADD)
    }
    IQN__FOUR(IQN__SQUARES_OUT)
    for (; i < n; i++) {
        IQN__FORM_IN(0)
        IQN__FORM_OUT_R(0)
        IQN__FORM_OUT_V(0)
        IQN__FORM_OUT_D(0)
        squares[i & 3] += now0 * now0;
        squares[4 + (i & 3)] += change0 * change0;
        squares[8 + (i & 3)] += value0 * value0;
    }
}

IQN__KERNEL(iqn__form_rows, (ptrdiff_t n, const iqn__rows *from, double *squares), n, from,
            squares)

#define IQN__PLACE 0x9e3779b97f4a7c15u /* odd: 2^64 over the golden ratio */
#define IQN__BITS_IN(k) memcpy(bits + k, x + i + k, sizeof *bits);

IQN__INLINE uint64_t iqn__rotate(uint64_t a, int by)
{
    return a << by | a >> (64 - by);
}

/* Another number for every a: each half in turn takes in the other one's square, folded to 32 bits.
   Without the fold the highest bit of a half would not reach the other one: it changes only the
   upper 32 bits of the square. */
IQN__INLINE uint64_t iqn__mixed(uint64_t a)
{
    uint64_t square = (a & 0xffffffff) * (a & 0xffffffff);
    a ^= (square ^ square >> 32) << 32;
    square = (a >> 32) * (a >> 32);
    return a ^ ((square ^ square >> 32) & 0xffffffff);
}

/* *out += the bits of the x_i, four at a time, under a mask of their place start + i */
IQN__INLINE void iqn__add_bits_body(ptrdiff_t start, ptrdiff_t n, const double *x, uint64_t *out,
                                    int fused)
{
    uint64_t bits[4], place = (uint64_t)start * IQN__PLACE, sum = 0;
    ptrdiff_t i;
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4, place += 4 * IQN__PLACE) {
        IQN__FOUR(IQN__BITS_IN)
        sum += iqn__mixed(place ^ (bits[0] + iqn__rotate(bits[1], 16) + iqn__rotate(bits[2], 32) +
                                   iqn__rotate(bits[3], 48)));
    }
    for (; i < n; i++, place += IQN__PLACE) {
        IQN__BITS_IN(0)
        sum += iqn__mixed(place ^ bits[0]);
    }
    *out += sum;
}

IQN__KERNEL(iqn__add_bits, (ptrdiff_t start, ptrdiff_t n, const double *x, uint64_t *out), start, n,
            x, out)

/* Has the host changed what it was handed?  The sum changes with any one number, and almost surely
   with several.  (Without the squares, x 2^k and changes of sign would add powers of 2, which
   cancel.  Without the masks, equal numbers that change alike would add equal terms.) */
static uint64_t iqn__fingerprint(ptrdiff_t start, ptrdiff_t rows, const double *x)
{
    uint64_t sum = 0;
    iqn__add_bits(start, rows, x, &sum);
    return sum;
}

#define IQN__PAIR_IN(k)                                             \
    const double v##k = (hx[i + k] - x[i + k]) * s - base_r[i + k] * s, \
                 w##k = (hx[i + k] * first - base_hx[i + k] * first) * then;
#define IQN__PAIR_OUT_V(k) v[i + k] = v##k;
#define IQN__PAIR_OUT_W(k) w[i + k] = w##k;

/* base: r and hx; pair: (r - r_base) s and (hx - hx_base) s, which may stand where the base does */
IQN__INLINE void iqn__store_pair_body(ptrdiff_t n, const double *x, const double *hx, double s,
                                      const double *const *base, double *const *pair, int fused)
{
    const double first = s < 1 ? s : 1, then = s < 1 ? 1 : s; /* s in two: no overflow */
    const double *base_r = base[0], *base_hx = base[1];
    double *v = pair[0], *w = pair[1];
    ptrdiff_t i;
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4) {
        IQN__FOUR(IQN__PAIR_IN)
        IQN__FOUR(IQN__PAIR_OUT_V)
        IQN__FOUR(IQN__PAIR_OUT_W)
    }
    for (; i < n; i++) {
        IQN__PAIR_IN(0)
        IQN__PAIR_OUT_V(0)
        IQN__PAIR_OUT_W(0)
    }
}

IQN__KERNEL(iqn__store_pair,
            (ptrdiff_t n, const double *x, const double *hx, double s, const double *const *base,
             double *const *pair),
            n, x, hx, s, base, pair)

#define IQN__BASE_IN(k) const double h##k = hx[i + k], r##k = h##k - x[i + k];
#define IQN__BASE_OUT_R(k) r[i + k] = r##k;
#define IQN__BASE_OUT_H(k) h[i + k] = h##k;

/* hx is kept, and not x: x = hx - r loses less than r = hx - x would */
IQN__INLINE void iqn__store_base_body(ptrdiff_t n, const double *x, const double *hx, double *r,
                                      double *h, int fused)
{
    ptrdiff_t i;
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4) {
        IQN__FOUR(IQN__BASE_IN)
        IQN__FOUR(IQN__BASE_OUT_R)
        IQN__FOUR(IQN__BASE_OUT_H)
    }
    for (; i < n; i++) {
        IQN__BASE_IN(0)
        IQN__BASE_OUT_R(0)
        IQN__BASE_OUT_H(0)
    }
}

IQN__KERNEL(iqn__store_base, (ptrdiff_t n, const double *x, const double *hx, double *r, double *h),
            n, x, hx, r, h)

#define IQN__NEXT_START(k) double s##k = 0;
#define IQN__NEXT_IN(k)                           \
    const double next##k = h[i + k] + y[i + k],   \
                 step##k = (next##k - (h[i + k] - r[i + k])) * unit;
#define IQN__NEXT_OUT(k) x[i + k] = next##k;
#define IQN__NEXT_ADD(k) s##k += step##k * step##k;
#define IQN__NEXT_SQUARES(k) squares[k] = s##k;

/* x = h + y, and four lanes of the square of the step from h - r to x */
IQN__INLINE void iqn__write_next_body(ptrdiff_t n, const double *r, const double *h, double unit,
                                      const double *y, double *x, double *squares, int fused)
{
    ptrdiff_t i;
    IQN__FOUR(IQN__NEXT_START)
    (void)fused;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4) {
        IQN__FOUR(IQN__NEXT_IN)
        IQN__FOUR(IQN__NEXT_OUT)
        IQN__FOUR(IQN__NEXT_ADD)
    }
    IQN__FOUR(IQN__NEXT_SQUARES)
    for (; i < n; i++) {
        IQN__NEXT_IN(0)
        IQN__NEXT_OUT(0)
        squares[i & 3] += step0 * step0;
    }
}

IQN__KERNEL(iqn__write_next,
            (ptrdiff_t n, const double *r, const double *h, double unit, const double *y, double *x,
             double *squares),
            n, r, h, unit, y, x, squares)

#define IQN__SQUARE_ADD(k) s##k += a[i + k] * a[i + k];
#define IQN__SQUARE_OUT(k) lanes[k] = s##k;

/* a'a in plain double, for norms */
static double iqn__plain_square(ptrdiff_t n, const double *a)
{
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0, lanes[4];
    ptrdiff_t i;
    IQN__NO_VECTORISER
    for (i = 0; i + 4 <= n; i += 4) {
        IQN__FOUR(IQN__SQUARE_ADD)
    }
    IQN__FOUR(IQN__SQUARE_OUT)
    for (; i < n; i++) lanes[i & 3] += a[i] * a[i];
    return iqn__sum_lanes(lanes);
}

/* iqn__plain_square of unit (a - b), or of unit a where b is NULL; the same order, the same bits */
static double iqn__scaled_square(ptrdiff_t n, const double *a, const double *b, double unit)
{
    double lanes[4] = {0, 0, 0, 0}, t;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        t = unit * (b ? a[i] - b[i] : a[i]);
        lanes[i & 3] += t * t;
    }
    return iqn__sum_lanes(lanes);
}

/* out[0..2] += the squares of a - b (of a where b is NULL) in units of 2^1200, 1 or 2^-1200,
   whichever is in range for these rows.  square is their plain sum, if that is known, or 0. */
static void iqn__squares(ptrdiff_t n, const double *a, const double *b, double square, double *out)
{
    const double big = iqn__pow2(600), tiny = iqn__pow2(-600);
    if (!(square > tiny && square < big)) square = iqn__scaled_square(n, a, b, 1);
    if (!iqn__finite(square) || square >= big) out[0] += iqn__scaled_square(n, a, b, tiny);
    else if (square <= tiny) out[2] += iqn__scaled_square(n, a, b, big);
    else out[1] += square;
}

/* What a sweep reads.  A step: r = plus - minus, with plus = value = hx and minus = x.  A push: the
   new column itself, plus = v, value = w, no minus.  The work arrays, and the sums of them:
                m->r    m->v             y          IQN__RR   IQN__VR      IQN__VV
      step      r       v = r - r_base   r or M r   r'M r     v'M r        v'v
      push      new v   r_base           v or M v   v'M v     r_base'M v   not used */
typedef struct iqn__input {
    const double *plus, *minus, *value;
    const double *product; /* M r or M v; NULL: M = 1 */
    int push;
    int e;                /* the unit 2^e of r in the sums */
    uint64_t fingerprint; /* of x */
    int edited;           /* out: the host has changed x since the last step, on some rank */
} iqn__input;

/* Must d hold x - x_base?  Aitken's secant takes the step that was made: bounds or the host may
   have changed it. */
static int iqn__needs_step(const iqn *q, const iqn__input *in)
{
    return iqn__method(q) == IQN_AITKEN && !in->push && q->chained;
}

/* A push: m->r is the new v, and m->v is r_base (without a base nobody reads it). */
static void iqn__form_push(const iqn *q, const iqn__view *m, const iqn__input *in, ptrdiff_t i,
                           ptrdiff_t rows)
{
    const double *base = m->V + q->base * q->n + i;
    const double unit = iqn__pow2(-in->e), base_unit = iqn__pow2(-q->e);
    ptrdiff_t k;
    for (k = 0; k < rows; k++) {
        m->r[k] = in->plus[i + k] * unit;
        m->v[k] = base[k] * base_unit;
        m->d[k] = 0;
    }
}

/* Work arrays of rows i..i+rows-1: r 2^-e; v = r - r_base, and d what rounding added to v, so that
   V'v = V'r - V'r_base + V'd exactly.  square: of r, of v, of hx */
static void iqn__form(const iqn *q, const iqn__view *m, const iqn__input *in, ptrdiff_t i,
                      ptrdiff_t rows, double *square)
{
    double lanes[12];
    iqn__rows arrays;
    if (in->push) {
        iqn__form_push(q, m, in, i, rows);
        square[0] = iqn__plain_square(rows, m->r);
        square[1] = iqn__plain_square(rows, m->v);
        square[2] = iqn__plain_square(rows, in->value + i);
        return;
    }
    arrays.h = in->plus + i;
    arrays.x = in->minus + i;
    arrays.base = m->V + q->base * q->n + i;
    arrays.unit = iqn__pow2(-in->e);
    arrays.base_unit = q->chained ? arrays.unit : 0; /* no base: v = r, not used, and d = 0 */
    arrays.r = m->r;
    arrays.v = m->v;
    arrays.d = m->d;
    iqn__form_rows(rows, &arrays, lanes);
    square[0] = iqn__sum_lanes(lanes);
    square[1] = iqn__sum_lanes(lanes + 4);
    square[2] = iqn__sum_lanes(lanes + 8);
}

/* d = x - x_base in units of 2^e */
static void iqn__form_step(const iqn *q, const iqn__view *m, const iqn__input *in, ptrdiff_t i,
                           ptrdiff_t rows)
{
    const double *base_r = m->V + q->base * q->n + i, *base_hx = m->W + q->base * q->n + i;
    const double unit = iqn__pow2(-in->e);
    ptrdiff_t k;
    for (k = 0; k < rows; k++) m->d[k] = (in->minus[i + k] - (base_hx[k] - base_r[k])) * unit;
}

/* Squares of r (a push: v), of hx (w) and of the product, of these rows; square: of iqn__form */
static void iqn__add_norms(const iqn__view *m, const iqn__input *in, int b, ptrdiff_t i,
                           ptrdiff_t rows, const double *square)
{
    double *squares = m->message + IQN__NORMS * (ptrdiff_t)b;
    const double *value = in->value + i;
    /* near 1 the sum at hand will do: where it has lost bits (subnormal), rr is below 2^-600, and
       iqn__squares sums anew */
    const int near_one = in->e <= 200 && in->e >= -200;
    const double rr = near_one ? square[0] * iqn__pow2(2 * in->e) : 0;
    iqn__squares(rows, in->plus + i, in->push ? NULL : in->minus + i, rr, squares + IQN__OF_R);
    iqn__squares(rows, value, NULL, square[2], squares + IQN__OF_HX);
    if (in->product)
        iqn__squares(rows, in->product + i, NULL, 0, squares + IQN__OF_PRODUCT);
}

/* The rows of a sweep at hand, with bounds of r'r and v'v there; y is r, or M r */
typedef struct iqn__chunk {
    ptrdiff_t start, rows;
    int rr, vv;
    iqn__side y;
} iqn__chunk;

/* r'y and v'y (IQN_AITKEN: v'd in place of v'y, with d = x - x_base), and v'v with v'd */
static void iqn__add_own_products(const iqn *q, const iqn__view *m, const iqn__input *in, int b,
                                  const iqn__chunk *chunk)
{
    const ptrdiff_t rows = chunk->rows;
    const int needs_step = iqn__needs_step(q, in);
    iqn__dd *own = iqn__own_of(m, b);
    const iqn__column by_y[2] = {{m->r, chunk->rr, own + IQN__RR, NULL},
                                 {m->v, chunk->vv, own + IQN__VR, NULL}};
    const iqn__column by_v = {m->v, chunk->vv, own + IQN__VV,
                              needs_step ? NULL : &own[IQN__VD].h};
    iqn__side side = {m->d, m->d, 0};
    iqn__dot(rows, &chunk->y, q->chained && !needs_step ? 2 : 1, by_y);
    if (!q->chained) return;
    if (needs_step) {
        side.square = iqn__square_bound(iqn__plain_square(rows, m->d));
        iqn__dot(rows, &side, 1, by_y + 1);
    }
    side.y = m->v;
    side.square = chunk->vv;
    iqn__dot(rows, &side, 1, &by_v);
}

/* V'y and V'd of a pair */
static iqn__column iqn__pair_column(const iqn *q, const iqn__view *m, int b,
                                    const iqn__chunk *chunk, int slot)
{
    iqn__dd *sums = iqn__sums_of(m, b) + 2 * slot;
    iqn__column column;
    column.a = m->V + slot * q->n + chunk->start;
    column.square = 2 * m->v_bound[(ptrdiff_t)b * m->slots + slot];
    column.exact = sums;
    column.plain = &sums[1].h;
    return column;
}

/* The chunk's part of all products: of the block's own, then of the pairs in use, two at a time */
static void iqn__add_products(const iqn *q, const iqn__view *m, const iqn__input *in, int b,
                              const iqn__chunk *chunk)
{
    iqn__column column[2];
    int j, c, count;
    iqn__add_own_products(q, m, in, b, chunk);
    for (j = 0; j < q->used; j += count) {
        count = q->used - j < 2 ? 1 : 2;
        for (c = 0; c < count; c++)
            column[c] = iqn__pair_column(q, m, b, chunk, m->order[j + c]);
        iqn__dot(chunk->rows, &chunk->y, count, column);
    }
}

/* One chunk: forms r, v and d; adds its norms and products */
static void iqn__sweep_rows(const iqn *q, const iqn__view *m, const iqn__input *in, int b,
                            ptrdiff_t start, ptrdiff_t rows)
{
    const double unit = iqn__pow2(-in->e);
    double square[3];
    iqn__chunk chunk;
    ptrdiff_t k;
    iqn__form(q, m, in, start, rows, square);
    iqn__add_norms(m, in, b, start, rows, square);
    chunk.start = start;
    chunk.rows = rows;
    chunk.rr = chunk.y.square = iqn__square_bound(square[0]);
    chunk.vv = iqn__square_bound(square[1]);
    chunk.y.y = m->r;
    chunk.y.d = m->d;
    if (in->product) {
        for (k = 0; k < rows; k++) m->product[k] = in->product[start + k] * unit;
        chunk.y.y = m->product;
        chunk.y.square = iqn__square_bound(iqn__plain_square(rows, m->product));
        memset(m->d, 0, (size_t)rows * sizeof *m->d); /* M d is not known */
    }
    if (iqn__needs_step(q, in)) iqn__form_step(q, m, in, start, rows);
    iqn__add_products(q, m, in, b, &chunk);
}

/* One read of V; nothing is written but chunks of work and sums of this rank. */
static void iqn__sweep(const iqn *q, const iqn__view *m, iqn__input *in)
{
    ptrdiff_t start = 0, i, rows, end;
    int b;
    in->fingerprint = 0;
    memset(m->message, 0, (size_t)q->blocks * IQN__NORMS * sizeof *m->message);
    for (b = 0; b < q->blocks; b++) {
        end = start + m->block[b].length;
        memset(iqn__sums_of(m, b), 0, (size_t)(2 * m->slots + IQN__OWN) * sizeof(iqn__dd));
        for (i = start; i < end; i += rows) {
            rows = end - i < IQN__CHUNK ? end - i : IQN__CHUNK;
            iqn__sweep_rows(q, m, in, b, i, rows);
            if (!in->push) in->fingerprint += iqn__fingerprint(i, rows, in->minus + i);
        }
        start = end;
    }
}

/* ---- exact sums over rows and ranks: iqn__measure -------------------------------------------- */

/* Specification.  A step sends two messages.  The first holds IQN__NORMS doubles per block, whether
   the host has changed x, and how many numbers have a weight; they are added as they are.  The
   second holds for every block double-double sums, two for each pair and four more, each as
   IQN__PARTS = 3 numbers: multiples of 2^(k-48), 2^(k-84) and 2^(k-120), each the nearest to what
   is left of it (up to rounding), where 2^k bounds the sum of its magnitudes over the ranks
   (Cauchy's inequality on norms that the first message has made known).  So all partial sums of
   part 1 stay below 2^49 of its units.  What it leaves is hardly more than half a unit: parts 2 and
   3 stay below 2^36 of theirs, and 2^17 of them add without rounding in the 53 bits of a double, in
   any order, on any tree.  With the same norms, hence the same k, the sum has the same
   bits in any order.  The three together keep 120 bits below 2^k: more than a double-double has,
   but fewer of a product that is far below its bound, as v'v where |v| is far below |r|. */

/* The host's sum, if there is one */
static int iqn__reduce(iqn *q, double *v, int count)
{
    if (!q->sum) return IQN_OK;
    iqn__count(q, IQN_NSUMS);
    return q->sum(v, count, q->ctx) ? IQN_ESUM : IQN_OK;
}

/* floor(t + 0.5) and not rint: the rounding mode is the host's */
static void iqn__pack(iqn__dd a, int k, double *out)
{
    static const int grid[IQN__PARTS] = {48, 84, 120};
    int i;
    k = k > 1000 ? 1000 : iqn__larger(k, -900); /* 2^(120 - k) and 2^(k - 120) are doubles */
    for (i = 0; i < IQN__PARTS; i++) {
        out[i] = floor(a.h * iqn__pow2(grid[i] - k) + 0.5) * iqn__pow2(k - grid[i]);
        a = iqn__add(a, iqn__dd_of(-out[i]));
    }
}

static iqn__dd iqn__unpack(const double *in)
{
    return iqn__add(iqn__two_sum(in[0], in[1]), iqn__dd_of(in[2]));
}

/* Bound of |x - x_base| <= |hx| + |r| + |hx_base| + |r_base|, whoever changed x */
static int iqn__step_bound(const iqn__block *block)
{
    const int now = iqn__larger(block->now_value.e, block->now.e);
    return iqn__larger(now, iqn__larger(block->base_value.e, block->base_residual.e)) + 2;
}

/* Number j of block b's message: two for each pair, in order, then the block's own four */
static iqn__dd *iqn__entry(const iqn *q, const iqn__view *m, int b, int j)
{
    if (j >= 2 * q->used) return iqn__own_of(m, b) + (j - 2 * q->used);
    return iqn__sums_of(m, b) + 2 * m->order[j / 2] + j % 2;
}

/* The k of the grids of number j of block b's message, a'c: a bound of |a| |c| (Cauchy).  A norm is
   below 2^e; one bit more is for its rounding, another for a sum of two. */
static int iqn__message_bound(const iqn *q, const iqn__view *m, const iqn__input *in, int b, int j)
{
    const iqn__block *block = m->block + b;
    const int r_bound = block->now.e - in->e + 1;
    const int y_bound = in->product ? block->now_product.e - in->e + 1 : r_bound;
    int v_bound = block->base_residual.e - (in->push ? q->e : in->e) + 1;
    if (!in->push) v_bound = iqn__larger(v_bound, r_bound) + 1; /* |r - r_base| */
    if (j < 2 * q->used)
        return m->v_bound[(ptrdiff_t)b * m->slots + m->order[j / 2]] +
               (j % 2 ? v_bound - 51 : y_bound); /* |d| <= 2^-53 |v|, and two bits to spare */
    switch (j - 2 * q->used) {
    case IQN__RR: return r_bound + y_bound;
    case IQN__VR:
        return v_bound + (iqn__needs_step(q, in) ? iqn__step_bound(block) - in->e : y_bound);
    case IQN__VV: return 2 * v_bound;
    default: return 2 * v_bound - 51; /* IQN__VD, as above */
    }
}

/* The second message, if there is a host's sum: pack, sum, unpack, in one order.  k depends on
   norms that all ranks share. */
static int iqn__sum_up(iqn *q, const iqn__view *m, const iqn__input *in)
{
    const int numbers = 2 * q->used + IQN__OWN;
    int b, j, status;
    if (!q->sum) return IQN_OK;
    for (b = 0; b < q->blocks; b++)
        for (j = 0; j < numbers; j++) {
            const int k = iqn__message_bound(q, m, in, b, j);
            double *out = m->message + IQN__PARTS * ((ptrdiff_t)b * numbers + j);
            iqn__pack(*iqn__entry(q, m, b, j), k, out);
        }
    status = iqn__reduce(q, m->message, IQN__PARTS * numbers * q->blocks);
    if (status < 0) return status;
    for (b = 0; b < q->blocks; b++)
        for (j = 0; j < numbers; j++) {
            const double *parts = m->message + IQN__PARTS * ((ptrdiff_t)b * numbers + j);
            *iqn__entry(q, m, b, j) = iqn__unpack(parts);
        }
    return IQN_OK;
}

/* Numbers with a weight, of this rank; their sum bounds how many pairs can be independent. */
static double iqn__rows_with_weight(const iqn *q, const iqn__view *m)
{
    double rows = 0;
    int b;
    for (b = 0; b < q->blocks; b++)
        if (m->block[b].set[IQN_WEIGHT - IQN_LENGTH] > 0) rows += (double)m->block[b].length;
    return rows;
}

/* Is 2^e so far from r that squares might leave the range? */
static int iqn__guess_is_off(iqn__norm r, int e)
{
    const int off = r.e - e;
    return r.f > 0 && (off > IQN__BITS_TO_SPARE || off < -IQN__BITS_TO_SPARE);
}

/* Sweep and sum: all numbers of this step, on all ranks.  On entry in->e is a guess of the unit's
   exponent, on return the exponent in use.  Of what later calls read, a step that fails here leaves
   behind only q->rows and block->now..., which every step sets anew; iqn__record takes over the
   latter. */
static int iqn__measure(iqn *q, const iqn__view *m, iqn__input *in)
{
    const int numbers = IQN__NORMS * q->blocks + 2;
    double *extra = m->message + numbers - 2;
    iqn__norm r = iqn__zero_norm();
    int b, k, status;
    iqn__sweep(q, m, in);
    for (b = 0; b < q->blocks; b++)
        m->message[IQN__NORMS * b + IQN__OF_STEP] = m->block[b].moved;
    extra[0] = in->fingerprint != q->handed_out;
    extra[1] = iqn__rows_with_weight(q, m);
    status = iqn__reduce(q, m->message, numbers);
    if (status < 0) return status;
    for (k = 0; k < numbers; k++)
        if (!iqn__finite(m->message[k])) return IQN_ENAN;
    in->edited = extra[0] > 0;
    q->rows = extra[1];
    for (b = 0; b < q->blocks; b++) {
        const double *squares = m->message + IQN__NORMS * b;
        iqn__block *block = m->block + b;
        block->now = iqn__norm_of(squares + IQN__OF_R);
        block->now_value = iqn__norm_of(squares + IQN__OF_HX);
        block->now_product = iqn__norm_of(squares + IQN__OF_PRODUCT);
        block->now_moved = squares[IQN__OF_STEP];
        r = iqn__hypot(r, block->now);
    }
    if (iqn__guess_is_off(r, in->e)) { /* read V once more, in the right unit */
        in->e = iqn__clamp(r.e, 1000);
        iqn__sweep(q, m, in);
    }
    return iqn__sum_up(q, m, in);
}

/* ---- convergence and progress ---------------------------------------------------------------- */

enum { IQN__NO_LIMIT = 0, IQN__WITHIN = 1, IQN__OUTSIDE = -1 };

/* A limit of 0 is none, though a ratio may underflow to 0. */
static int iqn__at_most(double value, double limit)
{
    return limit > 0 && value <= limit;
}

/* IQN__NO_LIMIT, or does one of the limits absolute, relative, reduction hold?  An x that runs away
   makes |r|/|hx| small: where |hx| has grown much, |r| must have fallen, too. */
static int iqn__within(iqn__norm r, iqn__norm value, iqn__norm first, iqn__norm growth_from,
                       const double *tol)
{
    const double grown = iqn__ratio(value, growth_from), fallen = iqn__ratio(r, first);
    double relative = iqn__ratio(r, value);
    if (!(tol[0] > 0) && !(tol[1] > 0) && !(tol[2] > 0)) return IQN__NO_LIMIT;
    if (grown > IQN__GUARD_MOST && growth_from.f > 0)
        relative = iqn__ratio(r, growth_from) / IQN__GUARD_MOST;
    if (iqn__at_most(iqn__value_of(r), tol[0]) || iqn__at_most(fallen, tol[2]))
        return IQN__WITHIN;
    if (grown > IQN__GUARD_FROM && fallen > IQN__GUARD_FALLEN) return IQN__OUTSIDE;
    return iqn__at_most(relative, tol[1]) ? IQN__WITHIN : IQN__OUTSIDE;
}

/* Growth of |hx| is measured from the last accepted answer or the first one of this window,
   whichever is larger; from rest, from the first that is not 0. */
static void iqn__set_growth_from(iqn__norm *growth_from, iqn__norm value, int first)
{
    if (growth_from->f == 0 || (first && iqn__ratio(value, *growth_from) > 1)) *growth_from = value;
}

/* Take over the norms of a step that cannot fail any more; converged? */
static void iqn__record(iqn *q, const iqn__view *m)
{
    const int first = q->iterations == 0;
    int b, verdict, all = 1, any = 0;
    q->residual = q->value = iqn__zero_norm();
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        block->residual = block->now;
        block->value = block->now_value;
        if (first) block->first = block->residual;
        iqn__set_growth_from(&block->growth_from, block->value, first);
        q->residual = iqn__hypot(q->residual, block->residual);
        q->value = iqn__hypot(q->value, block->value);
        verdict = iqn__within(block->residual, block->value, block->first, block->growth_from,
                              block->tol);
        any |= verdict == IQN__WITHIN;
        all &= verdict != IQN__OUTSIDE;
    }
    if (first) q->first = q->residual;
    iqn__set_growth_from(&q->growth_from, q->value, first);
    verdict = iqn__within(q->residual, q->value, q->first, q->growth_from,
                          q->set + IQN_TOL_ABSOLUTE);
    any |= verdict == IQN__WITHIN;
    all &= verdict != IQN__OUTSIDE;
    q->converged = (any && all) || q->residual.f == 0;
    q->iterations++;
    q->stepped = 1;
    iqn__count(q, IQN_NSTEPS);
}

/* Waiting counts from the last 10 % of progress, from the last starting over, or, while the best
   |r| is above IQN__FAR_DOWN of the first, from when most_kept last grew. */
static int iqn__out_of_patience(const iqn *q)
{
    return q->set[IQN_PATIENCE] > 0 && q->waited >= q->set[IQN_PATIENCE];
}

/* Watch the residuals of this window. */
static void iqn__watch_progress(iqn *q)
{
    if (q->iterations == 1) {
        q->best = q->milestone = q->residual;
        q->best_relative = iqn__ratio(q->residual, q->value);
        q->waited = q->most_kept = 0;
        return;
    }
    if (iqn__ratio(q->residual, q->best) < 1) q->best = q->residual;
    q->best_relative = fmin(q->best_relative, iqn__ratio(q->residual, q->value));
    q->waited++;
    if (iqn__ratio(q->residual, q->milestone) < IQN__PROGRESS) {
        q->milestone = q->residual;
        q->waited = 0;
    }
}

/* Nothing has improved for too long: counts it and returns what to call it, or 0.  To be called
   once in a step, after iqn__choose, which may have kept more pairs. */
static int iqn__stalled(iqn *q)
{
    if (!iqn__out_of_patience(q) || q->converged) return 0;
    iqn__count(q, IQN_NSTALLED);
    if (iqn__ratio(q->residual, q->best) > IQN__FAR_UP) return IQN_DIVERGED;
    return iqn__ratio(q->best, q->first) < IQN__FAR_DOWN ? IQN_NOISE : IQN_STALLED;
}

/* ---- the pairs ------------------------------------------------------------------------------- */

static void iqn__forget(iqn *q, const iqn__view *m, int position) /* nothing long moves */
{
    const int slot = m->order[position], behind = m->slots - 1 - position;
    memmove(m->order + position, m->order + position + 1, (size_t)behind * sizeof *m->order);
    m->order[m->slots - 1] = slot; /* order is a permutation: used slots, free ones */
    q->marked -= m->dropped[slot];
    m->dropped[slot] = 0;
    q->used--;
}

/* Pairs that the last step dropped */
static void iqn__forget_dropped(iqn *q, const iqn__view *m)
{
    int j;
    for (j = q->used - 1; j >= 0; j--) {
        if (!m->dropped[m->order[j]]) continue;
        iqn__forget(q, m, j);
        iqn__count(q, IQN_NDROPPED);
    }
}

static void iqn__forget_current(iqn *q, const iqn__view *m)
{
    int j;
    for (j = q->used - 1; j >= 0; j--)
        if (iqn__slot_in_window(q, m, m->order[j])) iqn__forget(q, m, j);
}

static void iqn__forget_past(iqn *q, const iqn__view *m)
{
    int j;
    for (j = q->used - 1; j >= 0; j--)
        if (!iqn__slot_in_window(q, m, m->order[j])) iqn__forget(q, m, j);
    q->least_left = HUGE_VAL; /* that was of the pairs that went */
    q->idle = 0;
}

static void iqn__keep_newest(iqn *q, const iqn__view *m, int count)
{
    while (q->used > count) iqn__forget(q, m, q->used - 1);
}

/* Keep the pairs of the current window and of the last `windows` windows that have any. */
static void iqn__keep_windows(iqn *q, const iqn__view *m, int windows)
{
    int j, count = 0, last = q->window;
    for (j = 0; j < q->used; j++) {
        if (m->window[m->order[j]] != last) count++;
        last = m->window[m->order[j]];
        if (count > windows) break;
    }
    iqn__keep_newest(q, m, j);
}

static int iqn__past_windows(const iqn *q) /* in the least squares of ILS */
{
    return q->set[IQN_WINDOWS] < 0 ? INT_MAX : (int)q->set[IQN_WINDOWS];
}

/* V'M v of the new v with the pair of a slot, in units of 2^e.  A push: the sum itself.  A step:
   V'(M r) - V'(M r_base), and without M + V'd, see iqn__form. */
static iqn__dd iqn__new_product(const iqn *q, const iqn__view *m, const iqn__input *in, int b,
                                int slot)
{
    const iqn__dd *acc = iqn__sums_of(m, b) + 2 * slot;
    iqn__dd before;
    if (in->push) return acc[0];
    before = iqn__shift(m->Vr[(ptrdiff_t)b * m->slots + slot], q->e - in->e);
    return iqn__add(iqn__sub(acc[0], before), acc[1]);
}

/* v'M v in units of 4^e.  With a metric M v is M r - M r_base, of which the last is gone: v'M v =
   2 v'(M r) - r'(M r) + r_base'(M r_base), for M is symmetric. */
static iqn__dd iqn__new_square(const iqn *q, const iqn__view *m, const iqn__input *in, int b)
{
    const iqn__dd *own = iqn__own_of(m, b);
    iqn__dd g;
    if (in->push) return own[IQN__RR];
    if (!in->product) return own[IQN__VV];
    g = iqn__sub(iqn__add(own[IQN__VR], own[IQN__VR]), own[IQN__RR]);
    return iqn__add(g, iqn__shift(m->block[b].rr, 2 * (q->e - in->e)));
}

/* |v| of the new pair in block b, Euclidean */
static iqn__norm iqn__new_length(const iqn__view *m, const iqn__input *in, int b)
{
    if (in->push) return m->block[b].now;
    return iqn__root(iqn__own_of(m, b)[IQN__VV].h, in->e);
}

/* |hx| in block b as the noise of the new pair sees it.  A push has no hx: that of the last step,
   before the first one |w|.  M hx is not at hand: with a metric, times |v|_M / |v|, so that units
   of M change nothing. */
static iqn__norm iqn__noise_scale(const iqn *q, const iqn__view *m, const iqn__input *in, int b)
{
    const iqn__block *block = m->block + b;
    const iqn__norm in_metric = iqn__root(iqn__new_square(q, m, in, b).h, in->e);
    const iqn__norm length = iqn__new_length(m, in, b);
    iqn__norm size = block->value.f > 0 ? block->value : block->now_value;
    int e;
    if (!in->product || length.f == 0) return size;
    size.f = frexp(size.f * (in_metric.f / length.f), &e);
    size.e += e + in_metric.e - length.e;
    return size;
}

/* May w / |v| leave the range of a double, if |w| is about 2^exponent at most? */
static int iqn__out_of_range(iqn__norm v_norm, int exponent)
{
    return exponent - iqn__clamp(v_norm.e, 1000) > 1000;
}

/* Is there anything to store?  A step: in some block v'v > 0 and |v| > DBL_EPSILON |hx|.  A push:
   in some block v'v > 0.  (With a metric v'M v for v'v.)  In both v'v must be finite in every
   block.  Of a step |w| / |v|, all blocks together, must be in range, too; iqn__learn_pushed asks
   this of a push.  *norm: |v| of all blocks, Euclidean. */
static int iqn__is_news(const iqn *q, const iqn__view *m, const iqn__input *in, iqn__norm *norm)
{
    int b, is_news = 0, finite = 1, exponent = 0; /* of |w| <= |hx| + |hx_base|; 0 is in range */
    *norm = iqn__zero_norm();
    for (b = 0; b < q->blocks; b++) {
        const iqn__block *block = m->block + b;
        const iqn__norm v_norm = iqn__new_length(m, in, b);
        const double square = iqn__new_square(q, m, in, b).h;
        *norm = iqn__hypot(*norm, v_norm);
        exponent = iqn__larger(exponent, iqn__larger(block->value.e, block->base_value.e));
        finite &= iqn__finite(square);
        if (!(square > 0)) continue;
        is_news |= in->push || iqn__ratio(v_norm, block->value) > DBL_EPSILON;
    }
    return is_news && finite && (in->push || !iqn__out_of_range(*norm, exponent));
}

/* The row of V'V and the entry of V'r of slot s in block b.  V'r belongs to the next base, and has
   its unit.  If the base moves, it is v'r, in units of 2^(in->e).  If it stays, it is v'r_base, in
   units of 2^(q->e): a push has summed it, a step takes v'r - v'v + v'd. */
static void iqn__store_products(iqn *q, const iqn__view *m, const iqn__input *in, int b, int s,
                                int base_moves)
{
    const int slots = m->slots, shift = in->e - m->exponent[s];
    const iqn__dd square = iqn__new_square(q, m, in, b), *own = iqn__own_of(m, b);
    const iqn__dd of_base = iqn__add(iqn__sub(own[IQN__VR], square), own[IQN__VD]);
    iqn__dd *gram = m->gram + (ptrdiff_t)b * slots * slots, *Vr = m->Vr + (ptrdiff_t)b * slots;
    int j;
    for (j = 0; j < q->used; j++) {
        const int o = m->order[j];
        gram[s * slots + o] = iqn__shift(iqn__new_product(q, m, in, b, o), shift);
    }
    gram[s * slots + s] = iqn__shift(square, 2 * shift);
    Vr[s] = iqn__shift(own[IQN__VR], shift);
    if (!in->push && !base_moves) Vr[s] = iqn__shift(of_base, shift + in->e - q->e);
}

/* The pair that makes room: the oldest.  In ILS without a filter limit the pair that newer ones
   explain best goes instead, if they explain all but a twentieth of it - unless the oldest is a
   past pair and the run is neither curved nor nonlinear.  (Not with more left than that: on a
   symmetric H recent pairs carry a short recurrence, and the iteration stalls without them.) */
static int iqn__spare(const iqn *q, const iqn__view *m)
{
    const int oldest = q->used - 1, straight = !q->curved && !q->nonlinear;
    int j, least = oldest;
    if (!iqn__by_uncertainty(q)) return oldest;
    if (straight && !iqn__slot_in_window(q, m, m->order[oldest])) return oldest;
    for (j = oldest; j >= 0; j--)
        if (m->apart[m->order[j]] < m->apart[m->order[least]]) least = j;
    return m->apart[m->order[least]] < iqn__square(IQN__REDUNDANT) ? least : oldest;
}

enum { IQN__NO_SLOT = -1 };

/* The last slot of order[] that does not hold the base: a free one */
static int iqn__free_slot(const iqn *q, const iqn__view *m)
{
    int j = m->slots - 1;
    while (m->order[j] == q->base) j--;
    return m->order[j];
}

/* Its slot becomes position 0 of order[]. */
static void iqn__make_newest(const iqn__view *m, int slot)
{
    int j = m->slots - 1;
    while (m->order[j] != slot) j--;
    memmove(m->order + 1, m->order, (size_t)j * sizeof *m->order);
    m->order[0] = slot;
}

/* Small algebra of a new pair.  Its slot, or IQN__NO_SLOT if it is zero, rounding or out of range,
   or there is no column. */
static int iqn__append(iqn *q, const iqn__view *m, const iqn__input *in, int base_moves,
                       double curvature)
{
    iqn__norm norm;
    int b, s;
    if (q->columns == 0) return IQN__NO_SLOT;
    if (!iqn__is_news(q, m, in, &norm)) {
        iqn__count(q, IQN_NZERO);
        return IQN__NO_SLOT;
    }
    if (q->used == q->columns) iqn__forget_dropped(q, m); /* only a push still finds any */
    if (q->used == q->columns) {
        iqn__forget(q, m, iqn__spare(q, m));
        iqn__count(q, IQN_NFULL);
    }
    /* where the base moves, v and w overwrite r and hx of the old one: it is needed no more */
    s = base_moves ? q->base : iqn__free_slot(q, m);
    m->exponent[s] = iqn__clamp(norm.e, 1000);
    m->window[s] = q->window;
    m->drift[s] = q->drift;
    m->curvature[s] = curvature;
    m->apart[s] = 1;
    m->assembled[s] = 0;
    for (b = 0; b < q->blocks; b++) {
        const iqn__norm hx_size = iqn__noise_scale(q, m, in, b);
        const ptrdiff_t at = (ptrdiff_t)b * m->slots + s;
        m->size[at] = ldexp(hx_size.f, hx_size.e - m->exponent[s]);
        m->v_bound[at] = iqn__clamp(iqn__new_length(m, in, b).e - m->exponent[s], 450);
        iqn__store_products(q, m, in, b, s, base_moves);
    }
    iqn__make_newest(m, s);
    q->used++;
    return s;
}

/* ---- weights, and the system of the least squares -------------------------------------------- */

/* Where the sum of one block has become ten times more or less than the one in use, every block
   takes its sum into use (a sum of 0 excepted). */
static void iqn__sum_residuals(const iqn *q, const iqn__view *m)
{
    int b, update = 0;
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        const double before = block->used_sum;
        if (q->iterations == 1) block->sum = 0;
        block->sum += iqn__ratio(block->residual, q->residual);
        if (!(block->sum > 0)) continue;
        update |= block->sum >= IQN__RESCALE_AT * before || block->sum * IQN__RESCALE_AT <= before;
    }
    for (b = 0; b < q->blocks; b++)
        if (update && m->block[b].sum > 0) m->block[b].used_sum = m->block[b].sum;
}

/* The size that a block is measured by.  A value or residual of 0 is replaced by that of all blocks
   together, which may be 0, too. */
static iqn__norm iqn__scale_of(const iqn *q, const iqn__block *block)
{
    iqn__norm size = iqn__unit_norm();
    switch ((int)block->set[IQN_SCALING - IQN_LENGTH]) {
    case IQN_BY_VALUE: size = block->value.f > 0 ? block->value : q->value; break;
    case IQN_BY_RESIDUAL: size = block->residual.f > 0 ? block->residual : q->residual; break;
    case IQN_BY_RESIDUAL_SUM: size = iqn__norm_at(block->used_sum, 0); break;
    }
    return size;
}

/* The factor of every block in the least squares. */
static void iqn__weigh(const iqn *q, const iqn__view *m)
{
    int b;
    iqn__sum_residuals(q, m);
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        iqn__norm size = iqn__scale_of(q, block);
        if (size.f == 0) size = iqn__unit_norm();
        block->weight.f = frexp(block->set[IQN_WEIGHT - IQN_LENGTH] / size.f, &block->weight.e);
        block->weight.e -= size.e;
    }
}

/* Weights may differ by more than a double holds; relative to the largest, small ones fade to 0. */
static void iqn__relate_weights(const iqn *q, iqn__view *m)
{
    int b;
    m->weight_exponent = -100000;
    for (b = 0; b < q->blocks; b++) {
        const iqn__norm *weight = &m->block[b].weight;
        if (weight->f > 0 && weight->e > m->weight_exponent) m->weight_exponent = weight->e;
    }
    for (b = 0; b < q->blocks; b++) {
        const iqn__norm *weight = &m->block[b].weight;
        m->block[b].relative_weight = ldexp(2 * weight->f, weight->e - m->weight_exponent);
    }
}

/* The weight of a block over 2^(weight_exponent - 1): the largest is in [1, 2) */
static double iqn__relative_weight(const iqn__view *m, int b)
{
    return m->block[b].relative_weight;
}

/* A product as S has it.  The usual weight is 1: nothing is to be done. */
static iqn__dd iqn__weighted(const iqn__block *block, iqn__dd product)
{
    return block->in_S.h == 1 ? product : iqn__mul(block->in_S, product);
}

/* S of two slots: the sum over the blocks */
static iqn__dd iqn__weighted_product(const iqn *q, const iqn__view *m, int s, int o)
{
    const ptrdiff_t at = (ptrdiff_t)s * m->slots + o, entries = (ptrdiff_t)m->slots * m->slots;
    iqn__dd sum = iqn__weighted(m->block, m->gram[at]);
    int b;
    for (b = 1; b < q->blocks; b++)
        sum = iqn__add(sum, iqn__weighted(m->block + b, m->gram[b * entries + at]));
    return sum;
}

/* The squares of the blocks' weights.  0: S was made with the same ones. */
static int iqn__square_weights(const iqn *q, const iqn__view *m)
{
    int b, changed = 0;
    for (b = 0; b < q->blocks; b++) {
        iqn__dd *in_S = &m->block[b].in_S;
        const double w = iqn__relative_weight(m, b), p = w * w;
        const iqn__dd square = iqn__fast_two_sum(p, iqn__product_error(w, w, p, IQN__FMA));
        changed |= square.h != in_S->h;
        *in_S = square;
    }
    return changed;
}

/* The weighted Gram matrix S and right-hand side y = V'r.  While the weights stay, S lacks only the
   rows of new pairs, which are the first positions: the loop ends at the first pair that S has.
   Where the weights have changed, S lacks all. */
static void iqn__assemble(const iqn *q, const iqn__view *m)
{
    const ptrdiff_t slots = m->slots;
    int b, i, j;
    if (iqn__square_weights(q, m)) memset(m->assembled, 0, (size_t)slots * sizeof *m->assembled);
    for (i = 0; i < q->used && !m->assembled[m->order[i]]; i++) {
        const int s = m->order[i];
        for (j = i; j < q->used; j++) {
            const int o = m->order[j];
            m->S[s * slots + o] = iqn__weighted_product(q, m, s, o);
            m->S[o * slots + s] = m->S[s * slots + o];
        }
        m->assembled[s] = 1;
    }
    for (i = 0; i < q->used; i++) {
        const iqn__dd *Vr = m->Vr + m->order[i];
        m->y[i] = iqn__weighted(m->block, *Vr);
        for (b = 1; b < q->blocks; b++)
            m->y[i] = iqn__add(m->y[i], iqn__weighted(m->block + b, Vr[b * slots]));
    }
}

/* ---- which pairs to trust, and the solution: everything here is small ------------------------ */

/* A group of pairs, positions begin .. end-1, has the factor L L' = S + diag(s_j^2).  Column k of L
   holds 1 / L_kk on its diagonal, zeros if the pair is dropped, and in row `end` what the forward
   substitution makes of the right-hand side: one more row of the same elimination.  The loops take
   four or eight rows at once and begin at a multiple of that: so they also fill rows above the
   diagonal and below row `end`, which are finite, and which no result reads.

   A sum of products is carried as a running double and the running sum of all its errors, and
   renormalised at the end: as accurate as a sum of double-doubles (Ogita, Rump, Oishi), for half of
   the operations. */

/* h + l -= (fh + fl)(ah + al) */
IQN__INLINE void iqn__deduct(double *h, double *l, iqn__dd f, double ah, double al, int fused)
{
    const double p = f.h * ah, error = iqn__product_error(f.h, ah, p, fused);
    const double s = *h - p, t = s - *h;
    *l += ((*h - (s - t)) - (p + t)) - (error + (f.h * al + f.l * ah));
    *h = s;
}

IQN__INLINE iqn__dd iqn__dd_join(double h, double l)
{
    iqn__dd a;
    a.h = h;
    a.l = l;
    return a;
}

#define IQN__ROW_IN(k) double h##k = h[k], l##k = l[k];
#define IQN__ROW_LESS(k) iqn__deduct(&h##k, &l##k, f, Lh[at + k], Ll[at + k], fused);
#define IQN__ROW_DONE(k) t = iqn__two_sum(h##k, l##k), h##k = t.h, l##k = t.l;
#define IQN__ROW_OUT_H(k) h[k] = h##k;
#define IQN__ROW_OUT_L(k) l[k] = l##k;
#define IQN__ROW_TIMES(k)                                 \
    t = iqn__product(iqn__dd_join(h##k, l##k), f, fused); \
    h##k = t.h;                                           \
    l##k = t.l;

/* n numbers times f; n is a multiple of four */
IQN__INLINE void iqn__scale_body(ptrdiff_t n, double *h, double *l, iqn__dd f, int fused)
{
    ptrdiff_t i;
    iqn__dd t;
    for (i = 0; i < n; i += 4, h += 4, l += 4) {
        IQN__FOUR(IQN__ROW_IN)
        IQN__FOUR(IQN__ROW_TIMES)
        IQN__FOUR(IQN__ROW_OUT_H)
        IQN__FOUR(IQN__ROW_OUT_L)
    }
}

IQN__KERNEL(iqn__scale, (ptrdiff_t n, double *h, double *l, iqn__dd f), n, h, l, f)

/* Takes from column k its part along the columns begin .. k-1: L_ik L_kk = S_ik - sum L_ij L_kj.
   The rows begin at the last multiple of `rows` up to k.  The L_kj lie apart: they are copied to
   where the solution will stand. */
#define IQN__ELIMINATE(name, rows, ROWS)                                                           \
    IQN__INLINE void name(const iqn__view *m, int begin, int k, int end, int fused)                \
    {                                                                                              \
        const double *Lh = m->Lh, *Ll = m->Ll;                                                     \
        ptrdiff_t i, j, at;                                                                        \
        iqn__dd f, t;                                                                              \
        for (j = begin; j < k; j++) {                                                              \
            m->ah[j] = Lh[j * m->lead + k];                                                        \
            m->al[j] = Ll[j * m->lead + k];                                                        \
        }                                                                                          \
        for (i = k / rows * rows; i <= end; i += rows) {                                           \
            double *h = m->Lh + k * m->lead + i, *l = m->Ll + k * m->lead + i;                     \
            ROWS(IQN__ROW_IN)                                                                      \
            for (j = begin; j < k; j++) {                                                          \
                at = j * m->lead + i;                                                              \
                f = iqn__dd_join(m->ah[j], m->al[j]);                                              \
                ROWS(IQN__ROW_LESS)                                                                \
            }                                                                                      \
            ROWS(IQN__ROW_DONE)                                                                    \
            ROWS(IQN__ROW_OUT_H)                                                                   \
            ROWS(IQN__ROW_OUT_L)                                                                   \
        }                                                                                          \
    }

IQN__ELIMINATE(iqn__eliminate_body, 4, IQN__FOUR)
IQN__ELIMINATE(iqn__eliminate_eight, 8, IQN__EIGHT)

/* Back substitution, L'a = what stands in row `end`: each a_k, once known, leaves the equations of
   those before it. */
IQN__INLINE void iqn__back_body(const iqn__view *m, int begin, int end, int fused)
{
    double *h = m->ah, *l = m->al;
    const double *Lh = m->Lh, *Ll = m->Ll;
    ptrdiff_t j, k;
    for (k = begin; k < end; k++) {
        h[k] = Lh[k * m->lead + end];
        l[k] = Ll[k * m->lead + end];
    }
    for (k = end - 1; k >= begin; k--) {
        const ptrdiff_t at = k * m->lead + k;
        const iqn__dd sum = iqn__fast_two_sum(h[k], l[k]);
        const iqn__dd a = iqn__product(sum, iqn__dd_join(Lh[at], Ll[at]), fused);
        for (j = begin; j < k; j++)
            iqn__deduct(h + j, l + j, a, Lh[j * m->lead + k], Ll[j * m->lead + k], fused);
        h[k] = a.h;
        l[k] = a.l;
    }
}

IQN__WIDE_KERNEL(iqn__eliminate, iqn__eliminate_eight,
                 (const iqn__view *m, int begin, int k, int end), m, begin, k, end)
IQN__KERNEL(iqn__back, (const iqn__view *m, int begin, int end), m, begin, end)

/* End of the group of pairs that starts at `begin`.  ILS has one group: one least-squares problem.
   IMVJ: the newest group holds the current window, if it has pairs, and so many past ones as
   IQN_WINDOWS says (one window at least); each older window is a group, all these together the old
   Jacobian. */
static int iqn__group_end(const iqn *q, const iqn__view *m, int begin)
{
    int windows = 1, i;
    if (iqn__method(q) != IQN_IMVJ) return q->used;
    if (begin == 0 && q->set[IQN_WINDOWS] > 0)
        windows = (int)q->set[IQN_WINDOWS] + iqn__slot_in_window(q, m, m->order[0]);
    for (i = begin + 1; i < q->used; i++)
        if (m->window[m->order[i]] != m->window[m->order[i - 1]] && --windows == 0) break;
    return i;
}

/* (nu |hx_j|)^2, in the units of S */
static double iqn__noise_of(const iqn *q, const iqn__view *m, int slot)
{
    double sum = 0;
    int b;
    for (b = 0; b < q->blocks; b++)
        sum += iqn__square(q->set[IQN_NOISE_LEVEL] * iqn__relative_weight(m, b) *
                           m->size[(ptrdiff_t)b * m->slots + slot]);
    return sum;
}

/* |v_j|^2 ((D - D_j)^2 + c_j^2), in the units of S: with the noise it is s_j^2 */
static double iqn__drift_and_curvature_of(const iqn *q, const iqn__view *m, int slot, double S_jj)
{
    const double drift = iqn__by_uncertainty(q) ? q->drift - m->drift[slot] : 0;
    return S_jj * (drift * drift + iqn__square(m->curvature[slot]));
}

/* I_k of the mathematics, the noise that row k inherits: sum (b_i nu |hx_i|)^2, with b from L'b =
   row k of L.  A guide for a decision: plain double will do. */
static double iqn__inherited(const iqn__view *m, int begin, int k)
{
    double *b = m->inherited, sum = 0, t;
    int i, j;
    for (i = k - 1; i >= begin; i--) {
        const double *column = m->Lh + i * m->lead;
        double lane[4] = {0, 0, 0, 0}; /* additions that wait for one another take the time */
        for (j = i + 1; j + 4 <= k; j += 4) {
            lane[0] += column[j] * b[j];
            lane[1] += column[j + 1] * b[j + 1];
            lane[2] += column[j + 2] * b[j + 2];
            lane[3] += column[j + 3] * b[j + 3];
        }
        for (t = column[k]; j < k; j++) t -= column[j] * b[j];
        b[i] = (t - ((lane[0] + lane[1]) + (lane[2] + lane[3]))) * column[i];
        sum += b[i] * b[i] * m->noise[i];
    }
    return sum;
}

/* An upper bound of it, for a hundredth of the work.  With N = diag(nu |hx_i|), I_k is |b'N|^2, and
   b' = sum over i of L_ki (row i of the inverse of L).  So |b'N| <= sum |L_ki| inverse_row_i, where
   inverse_row_i is at least |(row i of the inverse) N|.  Row k of the inverse is (e_k - b') / L_kk:
   iqn__examine sets inverse_row_k^2 to (noise_k + I_k, or its bound) / L_kk^2. */
static double iqn__inherited_at_most(const iqn__view *m, int begin, int k)
{
    double sum = 0;
    int i;
    for (i = begin; i < k; i++) sum += fabs(m->Lh[i * m->lead + k]) * m->inverse_row[i];
    return sum * sum;
}

/* |R_jj|^2 beside s_j^2 and I_j: see "A pair is dropped if" */
static int iqn__stands_out(double square, double doubt, double inherited)
{
    return square - inherited > IQN__RANK_TEST * (doubt + inherited);
}

/* Is pair k kept?  others: how many newer pairs of its group are kept.  square is |R_kk|^2 of the
   mathematics: the pivot before the doubt of position k is added.  Sets m->apart[slot],
   m->doubt[k], and without a filter limit m->noise[k] and m->inverse_row[k], as far as the decision
   gets. */
static int iqn__examine(const iqn *q, const iqn__view *m, int begin, int k, int others,
                        double square)
{
    const int slot = m->order[k];
    const double S_jj = m->S[(ptrdiff_t)slot * (m->slots + 1)].h, limit = q->set[IQN_FILTER_LIMIT];
    const int fits_all_rows = others >= q->rows; /* one more would fit noise */
    double inherited;
    m->doubt[k] = 0;
    m->apart[slot] = square / S_jj;
    if (!(square > iqn__square(IQN__ROUNDING) * S_jj)) return 0;
    if (limit > 0) return !fits_all_rows && square >= limit * limit * S_jj;
    m->noise[k] = iqn__noise_of(q, m, slot);
    m->doubt[k] = m->noise[k] + iqn__drift_and_curvature_of(q, m, slot, S_jj);
    if (fits_all_rows && !(m->doubt[k] > 0)) return 0; /* else it takes part in an average */
    inherited = iqn__inherited_at_most(m, begin, k);
    if (!iqn__stands_out(square, m->doubt[k], inherited)) inherited = iqn__inherited(m, begin, k);
    m->inverse_row[k] = sqrt((inherited + m->noise[k]) / (square + m->doubt[k]));
    return iqn__stands_out(square, m->doubt[k], inherited);
}

/* z = V'(r + V a) so far, of the pair at this position: what the groups before have left over */
static iqn__dd iqn__left_over(const iqn__view *m, int position, int count)
{
    const iqn__dd *S = m->S + (ptrdiff_t)m->order[position] * m->slots;
    iqn__dd z = m->y[position];
    int j;
    for (j = 0; j < count; j++) {
        const int k = m->kept[j];
        z = iqn__add(z, iqn__mul(S[m->order[k]], iqn__dd_join(m->ah[k], m->al[k])));
    }
    return z;
}

/* Zeros for IQN__AT_ONCE rows.  The loops read rows in groups of so many; iqn__fill_column sets
   only a part of the first and of the last group. */
static void iqn__clear_rows(const iqn__view *m, ptrdiff_t at)
{
    memset(m->Lh + at, 0, IQN__AT_ONCE * sizeof *m->Lh);
    memset(m->Ll + at, 0, IQN__AT_ONCE * sizeof *m->Ll);
}

/* Column k of the factor before elimination: S and, in row `end`, -z */
static void iqn__fill_column(const iqn__view *m, int k, int end)
{
    const iqn__dd *S = m->S + (ptrdiff_t)m->order[k] * m->slots;
    const int *order = m->order;
    double *h = m->Lh + k * m->lead, *l = m->Ll + k * m->lead;
    int i;
    iqn__clear_rows(m, k * m->lead + k / IQN__AT_ONCE * IQN__AT_ONCE);
    iqn__clear_rows(m, k * m->lead + end / IQN__AT_ONCE * IQN__AT_ONCE);
    for (i = k; i < end; i++) {
        h[i] = S[order[i]].h;
        l[i] = S[order[i]].l;
    }
    h[end] = -m->y[k].h;
    l[end] = -m->y[k].l;
}

/* Choose the pairs of a group, newest first, factor and solve for them: a = argmin, where the group
   sees what newer groups have left over.  Returns how many pairs are kept so far. */
static int iqn__solve_group(iqn *q, const iqn__view *m, int begin, int end, int count)
{
    const int before = count;
    int k;
    for (k = begin; k < end; k++) {
        const ptrdiff_t first = k / IQN__AT_ONCE * IQN__AT_ONCE, at = k * m->lead;
        const ptrdiff_t rows = (end + IQN__AT_ONCE - first) / IQN__AT_ONCE * IQN__AT_ONCE;
        double *h = m->Lh + at, *l = m->Ll + at;
        iqn__dd f = iqn__dd_of(0);
        m->y[k] = iqn__left_over(m, k, before);
        iqn__fill_column(m, k, end);
        iqn__eliminate(m, begin, k, end);
        if (iqn__examine(q, m, begin, k, count - before, h[k])) {
            m->kept[count++] = k;
            f = iqn__reciprocal_root(iqn__add(iqn__dd_join(h[k], l[k]), iqn__dd_of(m->doubt[k])));
        } else {
            m->dropped[m->order[k]] = 1;
            m->inverse_row[k] = m->noise[k] = 0; /* dropped: older pairs inherit no noise of it */
            q->marked++;
        }
        iqn__scale(rows, h + first, l + first, f);
        m->y[k] = iqn__dd_join(h[end], l[end]);
        h[k] = f.h;
        l[k] = f.l;
    }
    iqn__back(m, begin, end);
    return count;
}

/* On n unknowns |r| may stay level for n steps.  So one more pair kept counts as progress, unless
   |r| has fallen to where noise is the reason. */
static void iqn__note_kept(iqn *q, int kept)
{
    if (kept <= q->most_kept) return;
    if (iqn__ratio(q->best, q->first) > IQN__FAR_DOWN) q->waited = 0;
    q->most_kept = kept;
}

/* Solve for the coefficients of the stored columns.  Returns how many; 0: no usable pair. */
static int iqn__solve(iqn *q, const iqn__view *m)
{
    int i, j, end, terms = 0, kept = 0;
    iqn__assemble(q, m);
    for (i = 0; i < q->used; i = end) {
        end = iqn__group_end(q, m, i);
        terms = iqn__solve_group(q, m, i, end, terms);
    }
    for (j = 0; j < terms; j++) {
        m->coefficient[j] = m->ah[m->kept[j]] * iqn__pow2(q->e);
        kept += iqn__slot_in_window(q, m, m->order[m->kept[j]]);
        if (!iqn__finite(m->coefficient[j])) return 0;
    }
    iqn__note_kept(q, kept);
    return terms;
}

/* A weighted sum of squares, in units of 4^e, as a norm */
static iqn__norm iqn__weighted_norm(const iqn__view *m, double square, int e)
{
    return iqn__root(square, e + m->weight_exponent - 1);
}

/* A, with A^2 = sum (|v_j| a_j)^2 over pairs of past windows: what they were asked to remove, each
   for itself (|V a| is small where large parts cancel, whose errors do not) */
static iqn__norm iqn__claim(const iqn *q, const iqn__view *m, int terms)
{
    double sum = 0;
    int j;
    for (j = 0; j < terms; j++) {
        const int slot = m->order[m->kept[j]];
        if (iqn__slot_in_window(q, m, slot)) continue;
        sum += m->S[(ptrdiff_t)slot * (m->slots + 1)].h * iqn__square(m->ah[m->kept[j]]);
    }
    return iqn__weighted_norm(m, sum, q->e);
}

/* |r + V a| of the base.  With L L' = S + diag(s_j^2) and L y = -z the least squares of a group
   leaves |r + V a|^2 = r'r - y'y - sum (s_j a_j)^2, and its r + V a is the r of the next group: the
   kept pairs of all groups take their parts off.  iqn__solve_group has left y in m->y. */
static iqn__norm iqn__norm_left(const iqn *q, const iqn__view *m, int terms)
{
    iqn__dd sum = iqn__weighted(m->block, m->block->rr);
    int b, j;
    for (b = 1; b < q->blocks; b++)
        sum = iqn__add(sum, iqn__weighted(m->block + b, m->block[b].rr));
    for (j = 0; j < terms; j++) {
        const int k = m->kept[j];
        iqn__deduct(&sum.h, &sum.l, m->y[k], m->y[k].h, m->y[k].l, IQN__FMA);
        sum.l -= m->doubt[k] * iqn__square(m->ah[k]);
    }
    return iqn__weighted_norm(m, sum.h + sum.l, q->e);
}

/* ---- a step: what to learn from the iterate, and where to go next ----------------------------
   What a run has learned of H.  The first three stay for the rest of the run:
   - nonlinear: a probe has shown it.
   - curved: in one window |r| rose twice to far more than the steepest slope explains.
   - inexact: in one window |r| fell three times by far less than the pairs predicted.  H changes
     from call to call, or is a little curved.
   - steady: it is nonlinear, and past pairs have predicted the first step of a window.  A full step
     that doubles |r|, or that past pairs have misled, ends this for the rest of the run.
   - affine: a probe has shown it, for this window.
   growth: |r| / |r_base|, in the norm of the least squares. */

typedef struct iqn__plan {
    int moves;        /* the iterate becomes the base; else the old one stays, see HOW TO READ */
    int learns;       /* a pair of iterate and base is stored */
    double curvature; /* ... with this c_j */
    int taken_back;   /* the last step was bad */
    int probes;       /* the next one finds out why */
    int made, next;   /* slot of the new pair or IQN__NO_SLOT; slot of the base after this step */
    int terms;        /* pairs in the update */
    int kind;         /* of the step to come */
    double times_r, times_w, times_v; /* x = x_base + times_r r_base + times_w W a + times_v V a */
} iqn__plan;

/* |r| as the least squares sees it: of the step that has just been measured, and of the base */
static iqn__norm iqn__seen_now(const iqn *q, const iqn__view *m, const iqn__input *in)
{
    double sum = 0;
    int b;
    for (b = 0; b < q->blocks; b++)
        sum += iqn__square(iqn__relative_weight(m, b)) * iqn__own_of(m, b)[IQN__RR].h;
    return iqn__weighted_norm(m, sum, in->e);
}

static iqn__norm iqn__seen_of_base(const iqn *q, const iqn__view *m)
{
    double sum = 0;
    int b;
    for (b = 0; b < q->blocks; b++)
        sum += iqn__square(iqn__relative_weight(m, b)) * m->block[b].rr.h;
    return iqn__weighted_norm(m, sum, q->e);
}

/* Taking steps back needs a residual that the least squares sees whole: every block has a weight.
   Nothing is taken back with IQN_GROWTH 0, nor is the answer. */
static int iqn__may_take_back(const iqn *q, const iqn__view *m)
{
    int b, whole = 1;
    for (b = 0; b < q->blocks; b++) whole &= m->block[b].weight.f > 0;
    return whole && iqn__takes_back(q) && !q->converged;
}

/* |r - r_base| / |x - x_base| of the last step, in the weighted norm without M.  |r - r_base| = |v|
   is in units of in->e, |x - x_base| in those of q->e, for the base has not moved yet. */
static void iqn__observe_slope(iqn *q, const iqn__view *m, const iqn__input *in)
{
    double changed = 0, moved = 0, slope;
    int b;
    for (b = 0; b < q->blocks; b++) {
        const double weight = iqn__square(iqn__relative_weight(m, b));
        changed += weight * iqn__own_of(m, b)[IQN__VV].h;
        moved += weight * m->block[b].now_moved;
        if (m->block[b].now_moved >= IQN__FAR) return;
    }
    slope = ldexp(sqrt(changed / moved), in->e - q->e);
    if (!iqn__finite(slope)) return; /* x did not move */
    q->slope = slope;
    q->steepest = fmax(q->steepest, slope);
}

/* The second residual of a window, after a full first step, tells what the pairs of past windows
   were worth: D grows by 0.01 min(1, |r| / A), and with |r| <= 0.1 A a nonlinear run is steady.
   Returns 1 where |r| rose: they have misled.  (0 where the run is curved but not nonlinear: there
   their age need not be the cause.) */
static int iqn__observe_drift(iqn *q, iqn__norm r, double growth)
{
    const int past_pairs_at_work = q->iterations == 2 && q->claimed.f > 0;
    const double unforeseen = iqn__ratio(r, q->claimed);
    if (!iqn__by_uncertainty(q) || !past_pairs_at_work) return 0;
    q->drift += IQN__DRIFT_RATE * fmin(1, unforeseen);
    if (q->nonlinear && q->steady == 0 && unforeseen <= IQN__FORESEEN) q->steady = 1;
    return growth > 1 && (q->nonlinear || !q->curved);
}

/* c_j = hypot(c_j, c) for all pairs: they are believed less */
static void iqn__add_curvature(const iqn *q, const iqn__view *m, double c)
{
    int j;
    for (j = 0; j < q->used; j++) {
        double *curvature = m->curvature + m->order[j];
        *curvature = sqrt(iqn__square(*curvature) + c * c);
    }
}

/* Is the new pair above its noise, even if it were only `part` as long?  What iqn__examine asks of
   the newest one. */
static int iqn__above_noise(const iqn *q, const iqn__view *m, const iqn__input *in, double part)
{
    double square = 0, noise = 0;
    int b;
    for (b = 0; b < q->blocks; b++) {
        const iqn__norm size = iqn__noise_scale(q, m, in, b);
        const double w = iqn__relative_weight(m, b);
        square += w * w * iqn__new_square(q, m, in, b).h;
        noise += iqn__square(w * q->set[IQN_NOISE_LEVEL] * ldexp(size.f, size.e - in->e));
    }
    return iqn__stands_out(part * part * square, noise, 0);
}

/* On an affine H a full step leaves (1 + mixing (dH/dx - 1)) (r + V a): its norm is hardly above
   |r + V a| times max(1, steepest slope of r seen * max(1, |mixing|)).  A rise of |r| to ten times
   that is a surprise: H is curved, or by far steeper in a direction that no step had taken, and no
   pair so far is believed to better than 1 %.  After a second surprise in one window the run counts
   as curved: later windows do not blame such a failure on the age of their pairs.  Where past pairs
   take part now, their age may be the cause, and nothing is concluded; nor where v is near its
   noise.  Steps that lower |r|, but again and again by much less than predicted, prove, once for
   all, that the pairs are off by some part of |r|: the run is inexact. */
static void iqn__observe_curvature(iqn *q, const iqn__view *m, const iqn__input *in, iqn__norm r,
                                   double growth)
{
    const int past_pairs = q->used > 0 && !iqn__slot_in_window(q, m, m->order[q->used - 1]);
    const double steepest = q->steepest * fmax(1, fabs(q->set[IQN_MIXING]));
    int proof;
    if (past_pairs || q->nonlinear || !iqn__is_adaptive(q)) return;
    if (iqn__ratio(r, q->predicted) < IQN__SURPRISE * fmax(1, steepest)) return;
    if (!iqn__above_noise(q, m, in, IQN__TELLING)) return;
    if (growth > 1 && ++q->surprises > 1) q->curved = 1;
    if (growth > IQN__MISSED_LEAST && growth < IQN__MISSED_MOST) q->missed++;
    proof = !q->inexact && q->missed == IQN__MISSED_OFTEN;
    if (proof) q->inexact = 1;
    if (growth > 1 || proof) iqn__add_curvature(q, m, IQN__CURVATURE);
}

/* After a full step there are six cases, in this order.  The pair is stored, with c_j = 0, and the
   base moves, but where a case says otherwise. */
static void iqn__judge_full(iqn *q, const iqn__view *m, const iqn__input *in, iqn__norm r,
                            double growth, iqn__plan *p)
{
    const int misled = iqn__observe_drift(q, r, growth), may_take_back = iqn__may_take_back(q, m);
    /* nonlinear: a step taken back leaves no pair, so one that lowered |r| is not taken back */
    const double most = q->nonlinear ? fmax(1, q->set[IQN_GROWTH]) : q->set[IQN_GROWTH];
    const int bad = growth > most && may_take_back;
    if (misled) iqn__forget_past(q, m);
    else iqn__observe_curvature(q, m, in, r, growth);
    q->suspicious = q->nonlinear && growth > IQN__DISAPPOINTING;
    if (q->steady && (misled || growth > IQN__DOUBLED)) q->steady = -1;
    if (misled && may_take_back) {
        /* Whichever of iterate and base is the next base, a full step comes out the same: their r
           and hx differ by v and w of the new pair, so only its a differs.  Later pairs are better
           made against the base, whose |r| is less. */
        p->moves = 0;
    } else if (bad && q->nonlinear) { /* taken back; its pair is useless, others are doubted */
        p->taken_back = q->exploring = 1; /* IQN_GROWTH may have been 0 so far in this window */
        p->moves = p->learns = 0;
        iqn__add_curvature(q, m, IQN__CURVED);
    } else if (bad && !q->affine && iqn__above_noise(q, m, in, IQN__PROBEABLE)) {
        /* taken back, until a probe of its pair tells why */
        p->taken_back = p->probes = 1;
        p->moves = 0;
    } else if (q->nonlinear) { /* the new pair is the slope at half of the step: half the doubt */
        p->curvature = 0.5 * IQN__CURVATURE * growth;
        iqn__add_curvature(q, m, IQN__CURVATURE * growth);
    } else if (q->inexact) {
        p->curvature = IQN__CURVATURE * growth;
    } /* else H is affine, or only past pairs were wrong: the new pair is good */
}

/* |v / IQN__PROBE_PART - v_probed| / |v_probed| for the v of the probe, in the weighted norm: on an
   affine H the square root of rounding errors.  Against IQN__AFFINE plain double will do. */
static double iqn__probe_error(const iqn *q, const iqn__view *m, const iqn__input *in)
{
    const int s = q->probed, shift = in->e - m->exponent[s];
    double error = 0, probed_sum = 0;
    int b;
    for (b = 0; b < q->blocks; b++) {
        const double weight = iqn__square(iqn__relative_weight(m, b));
        const double square = iqn__shift(iqn__new_square(q, m, in, b), 2 * shift).h;
        const double product = iqn__shift(iqn__new_product(q, m, in, b, s), shift).h;
        const double probed = m->gram[((ptrdiff_t)b * m->slots + s) * m->slots + s].h;
        error += weight * (square / iqn__square(IQN__PROBE_PART) - 2 * product / IQN__PROBE_PART +
                           probed);
        probed_sum += weight * probed;
    }
    return error > 0 ? sqrt(error / probed_sum) : 0;
}

/* After a probe.  Affine: the long pair is exact, the short one no news.  Nonlinear: of this window
   only the short one is of use. */
static void iqn__judge_probe(iqn *q, const iqn__view *m, const iqn__input *in, iqn__plan *p)
{
    p->moves = 0;
    if (iqn__probe_error(q, m, in) < IQN__AFFINE) {
        q->affine = 1;
        p->learns = 0;
        return;
    }
    q->nonlinear = q->exploring = q->suspicious = 1;
    iqn__forget_current(q, m);
    iqn__add_curvature(q, m, IQN__CURVED);
    p->curvature = IQN__SMALL_STEP;
}

/* After any step of ILS or IMVJ within a window: is there a pair, does the base move? */
static void iqn__judge(iqn *q, const iqn__view *m, const iqn__input *in, iqn__plan *p)
{
    const int kind = in->edited ? IQN__PLAIN : q->kind, textbook = q->set[IQN_FILTER_LIMIT] > 0;
    const iqn__norm r = iqn__seen_now(q, m, in);
    const double growth = iqn__ratio(r, iqn__seen_of_base(q, m));
    p->learns = 1;
    if (!in->edited && kind != IQN__PROBE) iqn__observe_slope(q, m, in);
    switch (kind) {
    case IQN__FULL: iqn__judge_full(q, m, in, r, growth, p); break;
    case IQN__PROBE: iqn__judge_probe(q, m, in, p); break;
    case IQN__SMALL: /* made to learn: the base stays, unless |r| was halved by luck */
        p->curvature = IQN__SMALL_STEP;
        p->moves = growth < IQN__LUCK;
        break;
    default: /* a relaxation that raised |r|: back to the better iterate - but if its pair is noise
                (a filter limit keeps the newest), the same x would come again */
        if (!in->edited && growth > 1 && iqn__may_take_back(q, m))
            p->moves = !textbook && !iqn__above_noise(q, m, in, 1);
    }
}

/* The iterate becomes the base: its r'r and V'r are those of the sums. */
static void iqn__move_base(iqn *q, const iqn__view *m, const iqn__input *in, const iqn__plan *p)
{
    const int first_old = p->made >= 0 ? 1 : 0; /* position 0: iqn__append has set its V'r */
    int b, j;
    q->e = in->e;
    q->least_left = HUGE_VAL;
    for (b = 0; b < q->blocks; b++) {
        const iqn__dd *acc = iqn__sums_of(m, b);
        m->block[b].base_residual = m->block[b].residual;
        m->block[b].base_value = m->block[b].value;
        m->block[b].rr = iqn__own_of(m, b)[IQN__RR];
        for (j = first_old; j < q->used; j++)
            m->Vr[(ptrdiff_t)b * m->slots + m->order[j]] = acc[2 * m->order[j]];
    }
}

/* Go on from this iterate: nothing is taken back, and there is no probe.  Where no pair was made,
   the same step would come again from the old base. */
static void iqn__go_on(iqn__plan *p)
{
    p->moves = 1;
    p->probes = p->taken_back = 0;
}

/* Was half of the patience gone before this step?  (q->waited counts this step, too: hence - 1.)
   Then the pairs lead nowhere.  But far down it is noise that stops |r|, and a probe that has just
   proved H affine says that the pairs are good. */
static int iqn__leads_nowhere(const iqn *q)
{
    const double half = 0.5 * q->set[IQN_PATIENCE];
    const int proved_affine = q->kind == IQN__PROBE && q->affine;
    if (q->converged || proved_affine || !iqn__is_adaptive(q)) return 0;
    if (q->restarts == IQN__RESTARTS || iqn__ratio(q->best, q->first) < IQN__FAR_DOWN) return 0;
    return half > 0 && q->waited - 1 >= half;
}

/* Forget all pairs but that of this iterate, keep what is known of H.  If there is no such pair (a
   step of a nonlinear run was to be taken back), only a relaxation is left, and from the old base
   it may have been made before: then the base moves all the same. */
static void iqn__start_over(iqn *q, const iqn__view *m, iqn__plan *p)
{
    const int count = p->made >= 0 ? 1 : 0;
    if (q->used == count) return;
    if (count == 0) iqn__go_on(p);
    iqn__keep_newest(q, m, count);
    iqn__count(q, IQN_NRESTARTED);
    q->restarts++;
    q->waited = q->most_kept = q->suspicious = 0;
    q->least_left = HUGE_VAL; /* that was of the pairs that went */
    q->idle = 0;
}

/* The pair of the iterate and the base, and whether the iterate becomes the base */
static void iqn__learn_pair(iqn *q, const iqn__view *m, const iqn__input *in, iqn__plan *p)
{
    iqn__judge(q, m, in, p);
    /* IQN_WINDOWS 0: what iqn_commit has kept for the first step of this window goes now */
    if (iqn__method(q) == IQN_ILS) iqn__keep_windows(q, m, iqn__past_windows(q));
    if (q->converged) p->moves = 1; /* the answer is hx of this iterate, read from the base */
    if (p->learns) p->made = iqn__append(q, m, in, p->moves, p->curvature);
    if (p->learns && p->made < 0) iqn__go_on(p);
    if (iqn__leads_nowhere(q)) iqn__start_over(q, m, p);
    if (p->taken_back) iqn__count(q, IQN_NWITHDRAWN);
}

/* The first step of a window.  IQN_WINDOWS may have been lowered since iqn_commit; 0 keeps the last
   window for this step. */
static void iqn__begin_window(iqn *q, const iqn__view *m)
{
    q->exploring = q->nonlinear && iqn__takes_back(q);
    if (iqn__method(q) == IQN_ILS) iqn__keep_windows(q, m, iqn__larger(1, iqn__past_windows(q)));
}

/* Learn: the new pair, the base, the weights. */
static void iqn__learn(iqn *q, iqn__view *m, const iqn__input *in, iqn__plan *p)
{
    p->moves = 1;
    p->made = IQN__NO_SLOT;
    iqn__relate_weights(q, m); /* those of the step that led to this iterate judge it */
    if (!q->chained) iqn__begin_window(q, m);
    else if (iqn__has_pairs(q)) iqn__learn_pair(q, m, in, p);
    q->probed = p->made;
    p->next = q->base; /* where the base moves, its slot holds the new pair: it needs a free one */
    if (p->moves && p->made >= 0) p->next = m->order[m->slots - 1];
    if (p->moves) iqn__move_base(q, m, in, p);
    iqn__weigh(q, m);
    iqn__relate_weights(q, m);
}

/* omega of the step: IQN_OMEGA, but for IQN_AITKEN after the first relaxation of the run (omega is
   not 0).  There in the first step of a window the last omega, at most IQN_OMEGA large; in any
   other the secant -v'(x - x_base) / v'v in the weighted norm, if it is usable. */
static double iqn__update_omega(iqn *q, const iqn__view *m)
{
    const double given = q->set[IQN_OMEGA], most = fabs(given);
    double vd = 0, vv = 0, secant;
    int b;
    if (iqn__method(q) != IQN_AITKEN || q->omega == 0) {
        q->omega = given;
        return given;
    }
    if (!q->chained) {
        if (fabs(q->omega) > most) q->omega = copysign(most, q->omega);
        return q->omega;
    }
    for (b = 0; b < q->blocks; b++) {
        const iqn__dd *own = iqn__own_of(m, b);
        const double weight = iqn__square(iqn__relative_weight(m, b));
        vd += weight * own[IQN__VR].h; /* see iqn__needs_step */
        vv += weight * own[IQN__VV].h;
    }
    secant = -vd / vv;
    if (iqn__finite(secant) && fabs(secant) > 0 && fabs(secant) <= IQN__OMEGA_MOST)
        q->omega = secant;
    return q->omega;
}

/* x_base + omega r_base */
static void iqn__plan_relaxation(iqn *q, const iqn__view *m, iqn__plan *p)
{
    p->kind = IQN__PLAIN;
    p->times_r = iqn__update_omega(q, m);
}

/* x_base + (W - V) a + mixing (r_base + V a) */
static void iqn__plan_full(iqn__plan *p, double mixing)
{
    p->kind = IQN__FULL;
    p->times_r = mixing;
    p->times_w = 1;
    p->times_v = mixing - 1;
}

/* x_base + 0.1 (x_s - x_base): s is the slot of the newest pair, and x_s - x_base = w_s - v_s */
static void iqn__plan_probe(const iqn *q, const iqn__view *m, iqn__plan *p)
{
    p->kind = IQN__PROBE;
    p->terms = 1;
    m->kept[0] = 0;
    m->coefficient[0] = ldexp(IQN__PROBE_PART, m->exponent[q->probed]);
    p->times_r = 0;
    p->times_w = 1;
    p->times_v = -1;
}

/* A step to learn from: short enough for H to be affine along it, long enough to stand above noise;
   IQN__PROBE_PART sets its length. */
static void iqn__plan_small(iqn *q, iqn__plan *p, double times_r, double times_w, double times_v)
{
    p->kind = IQN__SMALL;
    p->times_r = times_r;
    p->times_w = times_w;
    p->times_v = times_v;
    iqn__count(q, IQN_NEXPLORED);
}

/* A nonlinear run.  In this order:
   - steady, and the steepest slope times |r + V a| is at most |r|: a full step, also
     after a disappointing one, for it will hardly raise |r|;
   - after a disappointing full step: a tenth of the next one, for an exact pair along it;
   - while the pairs leave much of r unexplained, and this still falls: a small step along what they
     leave, of length 0.1 |r| / slope;
   - else a full step, in which r + V a is taken times mixing / slope.
   slope: at least 1. */
static void iqn__plan_exploring(iqn *q, const iqn__view *m, iqn__plan *p)
{
    const iqn__norm r = q->predicted; /* so far |r| of the base */
    const iqn__norm rest = iqn__norm_left(q, m, p->terms);
    const double left = iqn__ratio(rest, r), slope = fmax(1, q->slope);
    const double part = IQN__PROBE_PART;
    const double along = part / (slope * left); /* taken where left > part: below 1 */
    const double mixing = q->set[IQN_MIXING] / slope;
    q->idle++;
    if (left < IQN__PROGRESS * q->least_left) {
        q->least_left = left;
        q->idle = 0;
    }
    if (q->steady > 0 && q->steepest * left <= 1) iqn__plan_full(p, q->set[IQN_MIXING]);
    else if (q->suspicious) iqn__plan_small(q, p, part * mixing, part, part * (mixing - 1));
    else if (left > IQN__EXPLAINED && q->idle < IQN__IDLE) iqn__plan_small(q, p, along, 0, along);
    else iqn__plan_full(p, mixing);
    if (p->kind == IQN__FULL) q->predicted = rest;
    q->suspicious = 0;
}

/* Choose the step: the answer, a probe, a quasi-Newton step, exploring, or relaxation. */
static void iqn__choose(iqn *q, const iqn__view *m, iqn__plan *p)
{
    q->predicted = iqn__seen_of_base(q, m); /* |r| of the base; a full step sets |r + V a| */
    if (q->converged) {
        p->times_r = 1; /* x = hx of the base, which is this iterate */
        return;
    }
    if (p->probes) {
        iqn__plan_probe(q, m, p);
        return;
    }
    if (iqn__has_pairs(q) && q->used > 0) p->terms = iqn__solve(q, m);
    if (p->terms == 0) iqn__plan_relaxation(q, m, p);
    else if (q->exploring) iqn__plan_exploring(q, m, p);
    else {
        iqn__plan_full(p, q->set[IQN_MIXING]);
        q->predicted = iqn__norm_left(q, m, p->terms);
    }
    if (q->iterations == 1) q->claimed = iqn__claim(q, m, p->terms);
}

/* ---- the update ------------------------------------------------------------------------------ */

/* y += factor times the columns of the update, rows from `start` */
static void iqn__add_columns(const iqn *q, const iqn__view *m, const iqn__plan *p, double factor,
                             const double *columns, ptrdiff_t start, ptrdiff_t rows, double *y)
{
    const double *w[4];
    double a[4];
    int j, t;
    for (j = 0; j < p->terms; j += 4) {
        for (t = 0; t < 4; t++) {
            const int inside = j + t < p->terms;
            w[t] = columns + m->order[m->kept[inside ? j + t : j]] * q->n + start;
            a[t] = inside ? factor * m->coefficient[j + t] : 0;
        }
        iqn__add_four_columns(rows, y, w, a[0], a[1], a[2], a[3]);
    }
}

/* iqn__write_next within bounds.  Those of a step are +-DBL_MAX at most, so an infinite number is
   clamped, too; an answer has no bounds.  Where W a was inf - inf, x = h.  Whether any number was
   clamped, by more than round-off at the bound. */
static int iqn__write_next_within(ptrdiff_t rows, const double *r, const double *h, double unit,
                                   const double *bound, const double *y, double *x, double *squares)
{
    int clamped = 0;
    ptrdiff_t k;
    memset(squares, 0, 4 * sizeof *squares);
    for (k = 0; k < rows; k++) {
        const double next = iqn__is_nan(y[k]) ? h[k] : h[k] + y[k];
        const double t = next < bound[0] ? bound[0] : next;
        const double rounding = IQN__AT_BOUND * (fabs(h[k]) + fabs(y[k]));
        x[k] = t > bound[1] ? bound[1] : t;
        clamped |= x[k] != next && !(fabs(x[k] - next) < rounding);
        squares[k & 3] += iqn__square((x[k] - (h[k] - r[k])) * unit);
    }
    return clamped;
}

/* Rows start .. start+rows-1: the pair, the base, and the next x.  Whether a bound clamped it. */
static int iqn__apply_rows(const iqn *q, const iqn__view *m, const iqn__input *in,
                           const iqn__plan *p, iqn__block *block, double *x, ptrdiff_t start,
                           ptrdiff_t rows)
{
    const double *hx = in->value + start;
    const double *old[2] = {m->V + q->base * q->n + start, m->W + q->base * q->n + start};
    double *r = m->V + p->next * q->n + start, *h = m->W + p->next * q->n + start;
    const double unit = iqn__pow2(-q->e);
    const double bound[2] = {q->converged ? -HUGE_VAL : block->set[IQN_LOWER - IQN_LENGTH],
                             q->converged ? HUGE_VAL : block->set[IQN_UPPER - IQN_LENGTH]};
    const int bounded = bound[0] > -DBL_MAX || bound[1] < DBL_MAX;
    double *y = m->r, squares[4];
    int clamped = 0;
    ptrdiff_t k;
    x += start;
    if (p->made >= 0) {
        double *pair[2] = {m->V + p->made * q->n + start, m->W + p->made * q->n + start};
        iqn__store_pair(rows, x, hx, iqn__pow2(-m->exponent[p->made]), old, pair);
    }
    if (p->moves) iqn__store_base(rows, x, hx, r, h);
    memset(y, 0, (size_t)rows * sizeof *y);
    if (p->times_w != 0) iqn__add_columns(q, m, p, p->times_w, m->W, start, rows, y);
    if (p->times_v != 0) iqn__add_columns(q, m, p, p->times_v, m->V, start, rows, y);
    if (p->times_r != 1)
        for (k = 0; k < rows; k++) y[k] -= (1 - p->times_r) * r[k];
    iqn__write_next(rows, r, h, unit, y, x, squares);
    if (bounded || !iqn__finite(iqn__sum_lanes(squares)))
        clamped = iqn__write_next_within(rows, r, h, unit, bound, y, x, squares);
    block->moved += iqn__sum_lanes(squares);
    return clamped;
}

/* An answer is no relaxation, though its plan is plain: iqn__choose sets no kind for it. */
static int iqn__relaxes(const iqn *q, const iqn__plan *p)
{
    return p->kind == IQN__PLAIN && !q->converged;
}

/* Apply: one read of W and of what V is needed; everything long is written here. */
static void iqn__apply(iqn *q, const iqn__view *m, const iqn__input *in, const iqn__plan *p,
                       double *x)
{
    ptrdiff_t i, rows, start = 0, end;
    int b, clamped = 0;
    q->handed_out = 0;
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        end = start + block->length;
        block->moved = 0;
        for (i = start; i < end; i += rows) {
            rows = end - i < IQN__CHUNK ? end - i : IQN__CHUNK;
            clamped |= iqn__apply_rows(q, m, in, p, block, x, i, rows);
            q->handed_out += iqn__fingerprint(i, rows, x + i);
        }
        if (!(block->moved < IQN__FAR)) block->moved = IQN__FAR;
        start = end;
    }
    /* a probe that a bound has clamped is no tenth of a step: to all ranks it counts as edited */
    if (clamped && p->kind == IQN__PROBE) q->handed_out++;
    q->base = p->next;
    q->chained = 1;
    q->kind = p->kind;
    if (iqn__relaxes(q, p)) iqn__count(q, IQN_NRELAXED);
}

/* ---- the whole step -------------------------------------------------------------------------- */

static int iqn__lengths_add_up(const iqn *q, const iqn__view *m)
{
    ptrdiff_t length = 0;
    int b;
    for (b = 0; b < q->blocks; b++) length += m->block[b].length;
    return length == q->n;
}

/* With pairs made without M there is no product M v, and the other way round. */
static int iqn__other_norm(const iqn *q, const double *product)
{
    return q->metric != (product != NULL) && (q->used > 0 || q->chained);
}

/* One status for a step: the gravest remark first */
static int iqn__remark(const iqn *q, const iqn__plan *p)
{
    if (q->converged) return IQN_SOLVED;
    if (p->taken_back) return IQN_WITHDRAWN;
    if (iqn__relaxes(q, p)) return IQN_RELAXED;
    if (p->kind == IQN__SMALL) return IQN_EXPLORED;
    return q->marked ? IQN_DROPPED : IQN_OK;
}

/* The view is handed in, so that a test can set fences between its arrays. */
static int iqn__step(iqn *q, iqn__view m, double *x, const double *hx, const double *product)
{
    iqn__plan plan;
    iqn__input in;
    int status, stalled;
    memset(&plan, 0, sizeof plan);
    memset(&in, 0, sizeof in);
    in.minus = x;
    in.plus = in.value = hx;
    in.product = product;
    in.e = q->residual.f > 0 ? iqn__clamp(q->residual.e, 1000) : 0;
    if (!iqn__lengths_add_up(q, &m)) return IQN_ELENGTH;
    if (iqn__other_norm(q, product)) return IQN_EORDER;
    q->metric = product != NULL;
    status = iqn__measure(q, &m, &in); /* one read of V, two sums: may fail */
    if (status == IQN_ENAN) iqn__count(q, IQN_NREFUSED);
    if (status < 0) return status;
    iqn__forget_dropped(q, &m);
    iqn__record(q, &m);
    iqn__watch_progress(q);
    iqn__learn(q, &m, &in, &plan);
    iqn__choose(q, &m, &plan);
    iqn__apply(q, &m, &in, &plan, x); /* one read of W */
    stalled = iqn__stalled(q);
    return stalled ? stalled : iqn__remark(q, &plan);
}

/* ---- public functions ------------------------------------------------------------------------ */

IQN_API IQN__NOINLINE size_t iqn_size(ptrdiff_t n, int columns, int blocks)
{
    iqn__view m;
    return iqn__layout(n, columns, blocks, NULL, &m);
}

typedef struct iqn__range {
    int key;
    double initial, low, high;
    int whole, not_zero;
} iqn__range;

static const iqn__range iqn__ranges[] = {
    {IQN_METHOD, IQN_ILS, IQN_ILS, IQN_CONSTANT, 1, 0},
    {IQN_OMEGA, 0.1, -1e6, 1e6, 0, 1},
    {IQN_FILTER_LIMIT, 0, 0, 1, 0, 0},
    {IQN_WINDOWS, -1, -1, 1e6, 1, 0},
    {IQN_TOL_ABSOLUTE, 0, 0, DBL_MAX, 0, 0},
    {IQN_TOL_RELATIVE, 0, 0, DBL_MAX, 0, 0},
    {IQN_TOL_REDUCTION, 0, 0, DBL_MAX, 0, 0},
    {IQN_MAX_ITERATIONS, 0, 0, 1e9, 1, 0},
    {IQN_PATIENCE, 20, 0, 1e9, 1, 0},
    {IQN_MIXING, 1, -1e6, 1e6, 0, 1},
    {IQN_NOISE_LEVEL, 1e-13, 0, 1, 0, 0},
    {IQN_GROWTH, 5, 0, DBL_MAX, 0, 0},
    {IQN_MERGE, 0, 0, 1e6, 1, 0},
    {IQN_LENGTH, 0, 0, 9e15, 1, 0}, /* below 2^53 */
    {IQN_SCALING, IQN_BY_WEIGHT, 0, IQN_BY_RESIDUAL_SUM, 1, 0},
    {IQN_WEIGHT, 1, 0, 1e150, 0, 0},
    {IQN_LOWER, -DBL_MAX, -DBL_MAX, DBL_MAX, 0, 0},
    {IQN_UPPER, DBL_MAX, -DBL_MAX, DBL_MAX, 0, 0},
};
enum { IQN__RANGES = sizeof iqn__ranges / sizeof *iqn__ranges };

IQN_API IQN__NOINLINE int iqn_make(iqn **q, ptrdiff_t n, int columns, int blocks, void *mem,
                                   size_t bytes)
{
    size_t need = iqn_size(n, columns, blocks);
    iqn__view m;
    int i, b;
    if (!q) return IQN_ENULL;
    if (need == 0) return IQN_EARG;
    if (!mem || bytes < need || (uintptr_t)mem % sizeof(double)) return IQN_EMEM;
    memset(mem, 0, need);
    *q = (iqn *)mem;
    (*q)->n = n;
    (*q)->columns = columns;
    (*q)->blocks = blocks;
    m = iqn__open(*q);
    for (b = 0; b < blocks; b++) m.block[b].length = n / blocks;
    m.block[blocks - 1].length += n % blocks;
    for (i = 0; i < IQN__RANGES; i++) {
        const iqn__range *range = iqn__ranges + i;
        if (range->key < IQN__SETTINGS) (*q)->set[range->key] = range->initial;
        if (range->key > IQN_LENGTH) /* lengths: see above */
            for (b = 0; b < blocks; b++) m.block[b].set[range->key - IQN_LENGTH] = range->initial;
    }
    for (i = 0; i < m.slots; i++) m.order[i] = i;
    return IQN_OK;
}

static const iqn__range *iqn__range_of(int key)
{
    int i;
    for (i = 0; i < IQN__RANGES; i++)
        if (iqn__ranges[i].key == key) return iqn__ranges + i;
    return NULL;
}

static int iqn__allowed(const iqn__range *a, double value)
{
    if (!iqn__finite(value) || value < a->low || value > a->high) return 0;
    if (a->whole && value != floor(value)) return 0;
    return !a->not_zero || value != 0;
}

IQN_API IQN__NOINLINE int iqn_set(iqn *q, int key, double value)
{
    const iqn__range *range = iqn__range_of(key);
    if (!q) return IQN_ENULL;
    if (!range || key >= IQN_LENGTH) return IQN_EKEY;
    if (!iqn__allowed(range, value)) return IQN_EVALUE;
    q->set[key] = value;
    return IQN_OK;
}

static int iqn__is_tolerance(int key)
{
    return key >= IQN_TOL_ABSOLUTE && key <= IQN_TOL_REDUCTION;
}

/* A value that is out of range for the state of this block */
static int iqn__refused(const iqn *q, const iqn__block *block, int key, double value)
{
    if (key == IQN_LOWER) return value > block->set[IQN_UPPER - IQN_LENGTH];
    if (key == IQN_UPPER) return value < block->set[IQN_LOWER - IQN_LENGTH];
    return key == IQN_LENGTH && value > (double)q->n;
}

IQN_API IQN__NOINLINE int iqn_set_block(iqn *q, int block, int key, double value)
{
    const iqn__range *range = iqn__range_of(key);
    iqn__view m;
    int b, first = block < 0 ? 0 : block, last;
    if (!q) return IQN_ENULL;
    if (block < -1 || block >= q->blocks || !range) return IQN_EKEY;
    if (key < IQN_LENGTH && !iqn__is_tolerance(key)) return IQN_EKEY;
    if (!iqn__allowed(range, value)) return IQN_EVALUE;
    if (key == IQN_LENGTH && (q->stepped || q->used)) return IQN_EORDER;
    m = iqn__open(q);
    last = block < 0 ? q->blocks - 1 : block;
    for (b = first; b <= last; b++)
        if (iqn__refused(q, m.block + b, key, value)) return IQN_EVALUE;
    for (b = first; b <= last; b++)
        if (iqn__is_tolerance(key)) m.block[b].tol[key - IQN_TOL_ABSOLUTE] = value;
        else if (key == IQN_LENGTH) m.block[b].length = (ptrdiff_t)value;
        else m.block[b].set[key - IQN_LENGTH] = value;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_set_sum(iqn *q, iqn_sum *sum, void *ctx)
{
    if (!q) return IQN_ENULL;
    q->sum = sum;
    q->ctx = ctx;
    return IQN_OK;
}

IQN_API IQN__NOINLINE double iqn_get(const iqn *q, int key)
{
    if (!q) return iqn__nan();
    if (key < IQN_LENGTH) return iqn__range_of(key) ? q->set[key] : iqn__nan();
    switch (key) {
    case IQN_RESIDUAL: return iqn__value_of(q->residual);
    case IQN_VALUE: return iqn__value_of(q->value);
    case IQN_RELATIVE: return iqn__ratio(q->residual, q->value);
    case IQN_REDUCTION: return iqn__ratio(q->residual, q->first);
    case IQN_PAIRS: return q->used - q->marked;
    case IQN_ITERATIONS: return q->iterations;
    case IQN_BEST_RELATIVE: return q->best_relative;
    case IQN_OMEGA_NOW: return q->omega;
    case IQN_PREDICTED: return iqn__value_of(q->predicted);
    }
    if (key < IQN_NSTEPS || key > IQN_NRESTARTED || key == IQN__UNUSED) return iqn__nan();
    return q->counter[key - IQN_NSTEPS];
}

IQN_API IQN__NOINLINE double iqn_get_block(const iqn *q, int block, int key)
{
    const iqn__block *b;
    if (!q || block < 0 || block >= q->blocks) return iqn__nan();
    b = iqn__open(q).block + block;
    if (iqn__is_tolerance(key)) return b->tol[key - IQN_TOL_ABSOLUTE];
    switch (key) {
    case IQN_LENGTH: return (double)b->length;
    case IQN_RESIDUAL: return iqn__value_of(b->residual);
    case IQN_VALUE: return iqn__value_of(b->value);
    case IQN_RELATIVE: return iqn__ratio(b->residual, b->value);
    case IQN_REDUCTION: return iqn__ratio(b->residual, b->first);
    }
    if (key < IQN_LENGTH || !iqn__range_of(key)) return iqn__nan();
    return b->set[key - IQN_LENGTH];
}

/* Do two arrays of n numbers share a byte?  Those that only touch do not. */
static int iqn__overlap(const double *a, const double *b, ptrdiff_t n)
{
    const uintptr_t i = (uintptr_t)a, j = (uintptr_t)b, bytes = (uintptr_t)n * sizeof *a;
    return i < j ? j - i < bytes : i - j < bytes;
}

/* M r of no numbers, where the host may hand over NULL: inside, NULL says that there is no M. */
static const double iqn__nothing[1] = {0};

IQN_API IQN__NOINLINE int iqn_step(iqn *q, double *x, const double *hx)
{
    if (!q || (q->n > 0 && (!x || !hx))) return IQN_ENULL;
    if (iqn__overlap(x, hx, q->n)) return IQN_EOVERLAP;
    return iqn__step(q, iqn__open(q), x, hx, NULL);
}

IQN_API IQN__NOINLINE int iqn_step_metric(iqn *q, double *x, const double *hx, const double *mr)
{
    if (!q || (q->n > 0 && (!x || !hx || !mr))) return IQN_ENULL;
    if (iqn__overlap(x, hx, q->n) || iqn__overlap(x, mr, q->n)) return IQN_EOVERLAP;
    return iqn__step(q, iqn__open(q), x, hx, mr ? mr : iqn__nothing);
}

IQN_API IQN__NOINLINE int iqn_halve(iqn *q, double *x)
{
    const double *r, *h;
    iqn__view m;
    ptrdiff_t k;
    if (!q || (q->n > 0 && !x)) return IQN_ENULL;
    if (!q->chained) return IQN_EORDER;
    m = iqn__open(q);
    r = m.V + q->base * q->n;
    h = m.W + q->base * q->n;
    for (k = 0; k < q->n; k++) x[k] = 0.5 * x[k] + 0.5 * (h[k] - r[k]);
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_converged(const iqn *q)
{
    if (!q) return IQN_ENULL;
    if (q->converged) return 1;
    if (iqn__out_of_patience(q)) return 2;
    if (!(q->set[IQN_MAX_ITERATIONS] > 0)) return 0;
    return q->iterations >= q->set[IQN_MAX_ITERATIONS] ? 2 : 0;
}

/* Only a next step of this window would forget the pairs that its last one left out: they stay, and
   the first step of the next window decides anew. */
static void iqn__pardon_dropped(iqn *q, const iqn__view *m)
{
    memset(m->dropped, 0, (size_t)m->slots * sizeof *m->dropped);
    q->marked = 0;
}

/* The base belongs to the window; proofs of curvature belong to the run. */
static void iqn__end_window(iqn *q, const iqn__view *m)
{
    int b;
    q->growth_from = q->accepted_value;
    for (b = 0; b < q->blocks; b++) m->block[b].growth_from = m->block[b].accepted_value;
    q->iterations = q->chained = q->converged = q->waited = q->affine = 0;
    q->surprises = q->missed = q->restarts = q->suspicious = 0;
    q->steepest *= q->nonlinear ? 0.5 : 0;
}

/* IMVJ: every IQN_MERGE windows all past pairs become one group. */
static void iqn__merge(iqn *q, const iqn__view *m)
{
    int j;
    if (!(q->set[IQN_MERGE] > 0) || q->since_merge < q->set[IQN_MERGE]) return;
    for (j = 0; j < q->used; j++) m->window[m->order[j]] = q->window - 1;
    q->since_merge = 0;
}

IQN_API IQN__NOINLINE int iqn_commit(iqn *q)
{
    iqn__view m;
    int b, pushed;
    if (!q) return IQN_ENULL;
    m = iqn__open(q);
    iqn__pardon_dropped(q, &m);
    if (q->iterations > 0) {
        q->accepted_value = q->value;
        for (b = 0; b < q->blocks; b++) m.block[b].accepted_value = m.block[b].value;
    }
    pushed = q->used > 0 && iqn__slot_in_window(q, &m, m.order[0]);
    if (q->iterations > 0 || pushed) {
        q->window++;
        q->since_merge++;
    }
    iqn__end_window(q, &m);
    if (iqn__method(q) == IQN_IMVJ) iqn__merge(q, &m);
    else iqn__keep_windows(q, &m, iqn__larger(1, iqn__past_windows(q)));
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_discard(iqn *q)
{
    iqn__view m;
    if (!q) return IQN_ENULL;
    m = iqn__open(q);
    iqn__pardon_dropped(q, &m);
    iqn__forget_current(q, &m);
    iqn__end_window(q, &m);
    return IQN_OK;
}

/* The small algebra of a pair from elsewhere; *slot may be IQN__NO_SLOT */
static int iqn__learn_pushed(iqn *q, const iqn__view *m, iqn__input *in, int *slot)
{
    iqn__norm v_norm = iqn__zero_norm(), w_norm = v_norm;
    int b, status;
    if (!iqn__lengths_add_up(q, m)) return IQN_ELENGTH;
    if (iqn__other_norm(q, in->product)) return IQN_EORDER;
    q->metric = in->product != NULL;
    status = iqn__measure(q, m, in);
    if (status < 0) return status;
    for (b = 0; b < q->blocks; b++) {
        v_norm = iqn__hypot(v_norm, m->block[b].now);
        w_norm = iqn__hypot(w_norm, m->block[b].now_value);
    }
    if (v_norm.f > 0 && iqn__out_of_range(v_norm, w_norm.e)) return IQN_ENAN;
    *slot = iqn__append(q, m, in, 0, 0);
    if (*slot >= 0 && q->kind == IQN__PROBE) q->kind = IQN__PLAIN; /* its pair may have gone */
    return *slot >= 0 ? IQN_OK : IQN_DROPPED;
}

static int iqn__push(iqn *q, iqn__view m, const double *v, const double *w, const double *product)
{
    iqn__input in;
    int slot = IQN__NO_SLOT, status;
    double unit;
    ptrdiff_t k;
    memset(&in, 0, sizeof in);
    in.plus = v;
    in.value = w;
    in.product = product;
    in.push = 1;
    status = iqn__learn_pushed(q, &m, &in, &slot);
    if (slot < 0) return status;
    unit = iqn__pow2(-m.exponent[slot]);
    for (k = 0; k < q->n; k++) {
        m.V[slot * q->n + k] = v[k] * unit;
        m.W[slot * q->n + k] = w[k] * unit;
    }
    return status;
}

IQN_API IQN__NOINLINE int iqn_push(iqn *q, const double *v, const double *w)
{
    if (!q || (q->n > 0 && (!v || !w))) return IQN_ENULL;
    if (q->columns == 0) return IQN_EARG;
    return iqn__push(q, iqn__open(q), v, w, NULL);
}

IQN_API IQN__NOINLINE int iqn_push_metric(iqn *q, const double *v, const double *w,
                                          const double *mv)
{
    if (!q || (q->n > 0 && (!v || !w || !mv))) return IQN_ENULL;
    if (q->columns == 0) return IQN_EARG;
    return iqn__push(q, iqn__open(q), v, w, mv ? mv : iqn__nothing);
}

/* The slot of pair j of those in use */
static int iqn__slot_in_use(const iqn__view *m, int j)
{
    int i;
    for (i = 0;; i++)
        if (!m->dropped[m->order[i]] && j-- == 0) return m->order[i];
}

IQN_API IQN__NOINLINE int iqn_pair(const iqn *q, int j, double *v, double *w)
{
    iqn__view m;
    ptrdiff_t k, from;
    double unit;
    int slot;
    if (!q) return IQN_ENULL;
    if (j < 0 || j >= q->used - q->marked) return IQN_EARG;
    if (v && w && iqn__overlap(v, w, q->n)) return IQN_EOVERLAP;
    m = iqn__open(q);
    slot = iqn__slot_in_use(&m, j);
    unit = iqn__pow2(m.exponent[slot]);
    from = slot * q->n;
    for (k = 0; k < q->n; k++) {
        if (v) v[k] = m.V[from + k] * unit;
        if (w) w[k] = m.W[from + k] * unit;
    }
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_linked_version(void)
{
    return IQN_VERSION;
}

IQN_API IQN__NOINLINE const char *iqn_message(int status)
{
#define IQN__TEXT(name, value, text) case name: return text;
    switch (status) {
        IQN_STATUSES(IQN__TEXT)
    }
#undef IQN__TEXT
    return status > IQN_OK && status < IQN_REMARK ? "done: a result" : "unknown status";
}

#if defined(__clang__)
#  pragma float_control(pop)
#elif defined(__GNUC__)
#  pragma GCC pop_options
#elif defined(_MSC_VER)
#  pragma float_control(pop) /* fp_contract has no push and pop: it stays off */
#endif

#ifdef __cplusplus
}
#endif
#endif /* IQN_IMPLEMENTATION */

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

      0.2.0  What a user of 0.1.0 must change:
             - IQN_EPSILON -> IQN_FILTER_LIMIT (default 0: by uncertainty; QR2 with a limit e is
               IQN_FILTER_LIMIT e), IQN_CONVERGED -> IQN_SOLVED, IQN_COLUMNS -> IQN_PAIRS, IQN_BEST
               -> IQN_BEST_RELATIVE, IQN_FACTOR -> IQN_OMEGA_NOW, IQN_TIGHTENED and IQN_NTIGHTENED
               -> IQN_WITHDRAWN and IQN_NWITHDRAWN;
             - IQN_RESTART IQN_RS_LS with IQN_CHUNK c is IQN_MERGE c, IQN_RS_NONE is IQN_MERGE 0,
               the default;
             - IQN_LOWER and IQN_UPPER clamp as soon as they are set;
             - statuses below 0: one for every cause; -203 and -204 now mean other things (NaN is
               -208, a failed sum -209).  Keys and counters keep their numbers, but 109, once
               IQN_DAMPING, is IQN_PREDICTED;
             - iqn_size asks for other sizes; a checkpoint of 0.1.0 cannot be read;
             - on several ranks all call iqn_discard, as they call iqn_step; iqn_commit no longer
               sums;
             - NULL has a status of its own, IQN_ENULL, also as the handle of iqn_converged;
             - iqn_version is iqn_linked_version.
             What gives other iterations: one rule of which pairs to trust; the pair of a step that
             is taken back goes only where a probe has proved H nonlinear.  IQN_WINDOWS >= 0 weighs
             drift, too.  "Converged" asks for |r| <= 0.1 |r of the first iteration| where |hx| has
             grown tenfold; a new independent pair is progress.  IQN_AITKEN takes the step that was
             made, also where the host changed x.  iqn_pair and IQN_PAIRS leave out what the last
             step dropped.  Where all pairs are of this window, or H has proved curved or nonlinear,
             a pair of which newer ones leave less than 0.05 makes room, not the oldest: a single
             window with slopes of 1e-4 to 10 in 23 evaluations (the oldest: 28); the tube
             (examples/tube.c) in windows of half the length in 160 (223).  Pairs that lead
             nowhere are forgotten: 28 failures of 120 become 18.
             New: IQN_NOISE_LEVEL, IQN_GROWTH, IQN_MERGE, IQN_PREDICTED, iqn_step_metric,
             iqn_push_metric, iqn_halve, IQN_EXPLORED, IQN_NEXPLORED, IQN_NRESTARTED, IQN_ENULL.
             Removed, with what condemned it (figures of the day):
             IQN_TIGHTEN         with 1, the default, 967 of 4480 single solves took longer, 48
                                 less; steps are taken back by IQN_GROWTH now, with 0 none
             IQN_FILTER, QR1     deviated from its definition in 123 of 419 sequences, unnoticed
             IQN_QR1_ABSOLUTE    no scene used it; IQN_QR2 is IQN_FILTER_LIMIT, and IQN_QR3 did the
                                 same; IQN_NOFILTER is IQN_FILTER_LIMIT 1e-14
             IQN_LEVEL           fast sums (IQN_FAST beside IQN_ACCURATE): 1.3 times faster at best,
                                 wrong by 1e-9 at condition 1e4
             IQN_DELAY           tube: 836 evaluations with 1, 808 without; with 3 it diverges
             IQN_FREEZE          tube, two sub-steps of the solid: 449 frozen after one window, 457
                                 not
             IQN_MIN_ITERATIONS  tube: 808 with 1 or 3; the host's loop can count
             IQN_MAX_STEP        did not save one of the diverging tubes, for a third sum in every
                                 step
             IQN_BOUNDS          of its modes (IQN_IGNORE, IQN_CLAMP, IQN_DISCARD, IQN_SCALE) only
                                 clamping needs no further sum: it is what bounds do
             IQN_RS_SVD          lost digits with the square of the condition (0.27 wrong at 1e7);
                                 the tube takes 828 iterations with it (and IQN_TRUNCATION), 829
                                 with IQN_MERGE 1
             IQN_RS_SLIDE, _ZERO tube: 1069, as without a restart
             IQN_OMEGA 0         (estimated) with pairs the same bits as 0.1 in 200 sequences
             IQN_DAMPING, IQN_LIMITED, IQN_NLIMITED: went with the above
      0.1.0  first version */
