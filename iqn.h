/* SPDX-License-Identifier: MIT

   iqn.h - v0.1.0 - interface quasi-Newton acceleration of x = H(x) on flat arrays

   In *one* C or C++ file, before the include:

      #define IQN_IMPLEMENTATION
      #include "iqn.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates, prints, aborts or keeps
   a global.

   SYNOPSIS

      size_t bytes = iqn_size(n, 20, 1);             // x has n numbers, up to 20 secant pairs, one block
      iqn *q;
      iqn_make(&q, n, 20, 1, mem, bytes);            // mem: that many bytes of yours
      iqn_set(q, IQN_TOL_RELATIVE, 1e-6);            // the only setting a first run needs
      int status, end = 0;

      for each time window {
          do {
              H(x, hx);                              // your solvers: hx = H(x)
              status = iqn_step(q, x, hx);           // x = the next input, or the answer
          } while (status >= 0 && (end = iqn_converged(q)) == 0);
          if (status < 0) stop;                      // iqn_message(status) says why; x is untouched
          if (end == 2) ...                          // gave up: a smaller time step, or hx if IQN_RELATIVE will do
          iqn_commit(q);                             // end == 1, or 2 tolerated; or iqn_discard(q) and repeat
      }                                              // x keeps the answer: the next first input, or your prediction

   To take a checkpoint, memcpy the iqn_size bytes: there is no pointer into the block.  After a restore in another
   process call iqn_set_sum again.

   COMPILE-TIME OPTIONS, before the include
      IQN_STATIC   every function private to the including file, for a library that embeds this header
      IQN_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS

   r = hx - x is the residual.  Each step makes a secant pair from two iterations of a time window,
      v = r_k - r_(k-1),   w = hx_k - hx_(k-1),      columns of V and W, newest first,
   so J = W V^+ approximates the derivative of hx by r, and r = 0 is expected at
      x = hx + W a,   a = argmin |r + V a|.                                               IQN_ILS = Anderson, type II
   Here |.| weighs each block by IQN_WEIGHT over its size by IQN_SCALING; weight 0: the block only follows
   ("secondary").  Several samples of a waveform as blocks: full QN-WI if all have weights, reduced QN-WI if only the
   last one has.  IQN_IMVJ keeps the derivative of past windows: with groups of pairs V_g, W_g, newest first,
      x = hx + sum W_g a_g,   a_g = argmin |r + V_newer a_newer + V_g a_g|,
   which is J_new = J_old + (W - J_old V) V^+ without any n x n matrix.  A restart forgets (RS_ZERO), puts all groups in
   one (RS_LS), truncates the singular values of J (RS_SVD) or keeps the last IQN_CHUNK windows (RS_SLIDE).
   The first step of all is x += omega r; the first one of a later window is a quasi-Newton step with old pairs.
   IQN_AITKEN: omega_k = -omega_(k-1) r_(k-1)'v / v'v.  All of it is decided on the small matrix V'V, kept per block:
   one read of V per step gives V'r and the new row of V'V, one read of W the update, and a host's sum is called twice.
   Accurate sums are double-double (products and additions without error), so that squaring the condition does no harm:
   as accurate as Householder QR up to a condition of 1e15.  Fast sums are plain and lose twice the digits: the update
   is wrong by 6e-14 at a condition of 1e2, 1e-9 at 1e4, 4e-8 at 1e6, and worthless from 1e8 on.
   What the pairs do not explain, r + V a, is taken over in full (IQN_MIXING 1); added mass multiplies it by a large
   negative slope.  IQN_TIGHTEN withdraws a quasi-Newton step that tripled |r|, goes back to the iterate before, and
   adds only a fifth of it, x = hx + W a - (1 - beta)(r + V a), for the rest of the window: beta 1, 0.2, 0.1 by default.
   To cross ranks, a double-double travels as three numbers on fixed binary grids, whose sums are exact in any order.

   Mehl et al., Comput. Math. Appl. 71 (2016): IQN-ILS, IMVJ.  Haelterman et al., Comput. Struct. 171 (2016): the
   filters.  Scheufele, Mehl, SIAM J. Sci. Comput. 39 (2017): restarts.  Rueth et al., IJNME 122 (2021): waveforms.
   Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26 (2005): sums.  The automatic reuse (see iqn__distrust below) and the
   retreat (iqn__retreat) are this library's own.

   DOES NOT
      evaluate H, know time or meshes (resample pairs with iqn_pair and iqn_push when a grid changes), predict the next
      window, start threads, or change n.

   LIMITATIONS
      IQN_MIXING other than 1 reads V twice, and so does the rest of a window after a retreat.  A retreat needs a
      residual that the least squares sees whole: none with secondary blocks.  On an affine H it costs up to two
      evaluations in the window, for the pair that is withdrawn was a good one.  IQN_MAX_STEP, IQN_DISCARD and IQN_SCALE
      read W twice and call the sum a third time; IQN_RS_SVD calls it once in iqn_commit.  Blocks whose residuals differ
      by more than 1e150 fall out of the range of one Gram matrix.  An H with noise: filter and tolerance cannot be
      smaller than the noise, see IQN_NOISE.

   DETERMINISM
      The same calls give the same bits with gcc and clang at any -O, with -ffast-math, with and without fused
      multiply-add and with SSE2, AVX2 or AVX-512: this half is compiled with its own floating-point options.  (clang
      with -ffast-math and -mfma at once fuses all the same: other last bits, the same accuracy.)  32-bit x87 arithmetic
      (FLT_EVAL_METHOD != 0) loses the accurate level.  On other numbers of ranks results agree to about 1e-30 times the
      square of the condition, before they are rounded to double: mostly in all bits.  With scalings by value or
      residual, and after IQN_RS_SVD: to about 1e-16 times the condition.

   THREADS
      Functions on different objects may run at once, and so may those with a const handle on the same object.

   LICENSE
      MIT; full text and version history at the end of the file. */

#ifndef IQN_H_INCLUDED
#define IQN_H_INCLUDED
#define IQN_VERSION 100 /* 10000*major + 100*minor + patch */

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

/* ---- statuses and keys ------------------------------------------------------------------------------------------- */

/* Status: 0 done; > 0 done, with a remark; < 0 nothing done, nothing touched but counters.  The numbers of statuses
   and keys never change: hosts in other languages carry them by value, and new ones are added at the end. */
enum {
    IQN_OK = 0,           /* quasi-Newton update                                                       */
    IQN_CONVERGED = 201,  /* the limits hold, or r = 0; x = hx                                         */
    IQN_RELAXED = 202,    /* x += omega (hx - x): no usable pair, or a relaxation method               */
    IQN_DROPPED = 203,    /* quasi-Newton update; the filter dropped pairs                             */
    IQN_TIGHTENED = 204,  /* the last step was bad: withdrawn, a damped one from the iterate before    */
    IQN_LIMITED = 205,    /* IQN_MAX_STEP, IQN_DISCARD or IQN_SCALE changed the update (IQN_CLAMP: no remark) */
    IQN_STALLED = 206,    /* no progress for IQN_PATIENCE iterations                                   */
    IQN_NOISE = 207,      /* the same, after |r| had fallen 1e3 times: H returns noise below this      */
    IQN_DIVERGED = 208,   /* the same, and |r| is 1e3 times the least of this window: IQN_MIXING down  */
    IQN_EARG = -201,      /* an argument is NULL, NaN or out of range                                  */
    IQN_EMEM = -202,      /* memory too small or not aligned for a double                              */
    IQN_ENAN = -203,      /* x, hx or hx - x is not finite, here or on another rank                    */
    IQN_ESUM = -204       /* the host's sum reported a failure                                         */
};

/* Keys of iqn_set: the default in brackets.  |.| here is the Euclidean norm of all numbers of all ranks, without
   weights: where fields have different units, set limits per block.  Without any limit only r = 0 is convergence.  In
   the relative limit |hx| counts up to 1e6 times that of the window's first iteration: an x that runs away is no
   answer. */
enum {
    IQN_METHOD = 1,     /* IQN_ILS, IQN_IMVJ, IQN_AITKEN or IQN_CONSTANT                           [IQN_ILS] */
    IQN_OMEGA,          /* relaxation factor of steps without pairs; 0: 0.1 once, then estimated       [0.1] */
    IQN_FILTER,         /* IQN_NOFILTER, IQN_QR1, IQN_QR1_ABSOLUTE, IQN_QR2 or IQN_QR3             [IQN_QR2] */
    IQN_EPSILON,        /* limit of the filter; iterations at 1e-2, 1e-3, 1e-4: tube 803, 829, 846 (strong added mass);
                           manufactured heat, a window: 4.8, 4.5, 4.4 over 10 windows, 3.70, 3.62, 3.34 over 50 [1e-2] */
    IQN_WINDOWS,        /* past windows in the least squares; -1: ILS all that fit, trusted less by age; IMVJ 0 [-1] */
    IQN_LEVEL,          /* IQN_FAST or IQN_ACCURATE sums                                      [IQN_ACCURATE] */
    IQN_TOL_ABSOLUTE,   /* converged when |r| <= limit                                                   [0] */
    IQN_TOL_RELATIVE,   /*           or |r| <= limit |hx|                                                [0] */
    IQN_TOL_REDUCTION,  /*           or |r| <= limit |r of the window's first iteration|                 [0] */
    IQN_MIN_ITERATIONS, /* not converged before                                                          [1] */
    IQN_MAX_ITERATIONS, /* iqn_converged gives up after; 0: never                                        [0] */
    IQN_PATIENCE,       /* iterations without 10 % progress until "stalled"; 0: never, for slow relaxation [20] */
    IQN_TIGHTEN,        /* 1: withdraw a step that tripled |r|; a fifth of the mixing, not below |omega| [1] */
    IQN_MIXING,         /* mixing factor beta, not 0: x = hx + W a - (1 - beta) (r + V a)                [1] */
    IQN_DELAY,          /* further relaxed steps at the start of the run, before the first pair          [0] */
    IQN_MAX_STEP,       /* shorten steps to |x - x_old| <= limit |hx of the window's first iteration|; 0: never [0] */
    IQN_FREEZE,         /* block scalings stay as they are after this many windows; 0: never             [0] */
    IQN_RESTART,        /* of IMVJ: IQN_RS_NONE, _ZERO, _LS, _SVD or _SLIDE                    [IQN_RS_NONE] */
    IQN_CHUNK,          /* windows between restarts, or the length of the slide                          [8] */
    IQN_TRUNCATION,     /* singular values kept by IQN_RS_SVD, relative to the largest                [1e-4] */
    /* Keys of iqn_set_block only; the IQN_TOL_ keys may be given there, too. */
    IQN_LENGTH = 51,    /* local length of the block                         [n/blocks, the last takes the rest] */
    IQN_SCALING,        /* IQN_BY_WEIGHT, IQN_BY_VALUE, IQN_BY_RESIDUAL, IQN_BY_RESIDUAL_SUM     [IQN_BY_WEIGHT] */
    IQN_WEIGHT,         /* factor on the block's residual in the least squares; 0: secondary                 [1] */
    IQN_BOUNDS,         /* IQN_IGNORE, IQN_CLAMP, IQN_DISCARD or IQN_SCALE what leaves the bounds   [IQN_IGNORE] */
    IQN_LOWER,          /* bounds of every x of the block, never LOWER above UPPER                    [-DBL_MAX] */
    IQN_UPPER,          /*                                                                             [DBL_MAX] */
    /* Keys of iqn_get only.  The first four also of iqn_get_block. */
    IQN_RESIDUAL = 101,    /* |r| of the last step                                             */
    IQN_VALUE,             /* |hx| of the last step                                            */
    IQN_RELATIVE,          /* |r| / |hx|                                                       */
    IQN_REDUCTION,         /* |r| / |r of the window's first iteration|                        */
    IQN_BEST,              /* least |r| / |hx| of this window                                  */
    IQN_COLUMNS,           /* pairs in use                                                     */
    IQN_ITERATIONS,        /* steps in this window                                             */
    IQN_FACTOR,            /* omega of the last relaxation                                     */
    IQN_DAMPING,           /* the mixing in use: IQN_MIXING, or what IQN_TIGHTEN made of it    */
    /* Counters since iqn_make, by cause.  If one grows, turn ... */
    IQN_NSTEPS = 151,      /* steps                                                            */
    IQN_NSUMS,             /* calls of the sum                                                 */
    IQN_NDROPPED,          /* pairs the filter dropped:        IQN_EPSILON down, IQN_WINDOWS down */
    IQN_NFULL,             /* pairs that fell off the end:     more columns in iqn_make        */
    IQN_NZERO,             /* pairs that were zero or noise:   the solvers' own tolerances down */
    IQN_NRELAXED,          /* steps without usable pairs:      IQN_WINDOWS up, IQN_EPSILON down */
    IQN_NTIGHTENED,        /* bad steps withdrawn:            IQN_MIXING down, 0.02 to 0.2; IQN_WINDOWS down */
    IQN_NLIMITED,          /* shortened or discarded steps:    IQN_MAX_STEP, IQN_LOWER, IQN_UPPER */
    IQN_NREFUSED,          /* steps refused for NaN or Inf:    look into H; smaller time step  */
    IQN_NSTALLED           /* steps without progress:          tolerance up, solvers' tolerances or IQN_MIXING down */
};
enum { IQN_ILS = 0, IQN_IMVJ, IQN_AITKEN, IQN_CONSTANT };
enum { IQN_NOFILTER = 0, IQN_QR1, IQN_QR1_ABSOLUTE, IQN_QR2, IQN_QR3 };
enum { IQN_FAST = 0, IQN_ACCURATE };
enum { IQN_BY_WEIGHT = 0, IQN_BY_VALUE, IQN_BY_RESIDUAL, IQN_BY_RESIDUAL_SUM };
enum { IQN_IGNORE = 0, IQN_CLAMP, IQN_DISCARD, IQN_SCALE };
enum { IQN_RS_NONE = 0, IQN_RS_ZERO, IQN_RS_LS, IQN_RS_SVD, IQN_RS_SLIDE };

/* ---- an object in your memory ------------------------------------------------------------------------------------ */

typedef struct iqn iqn;

/* In a parallel run: replace v[0..count-1] by its sum over all ranks, with the same bits on all of them
   (MPI_Allreduce with MPI_SUM; reduce and broadcast where that does not promise the same bits).  Return 0, or
   anything else to make the step fail with IQN_ESUM.  Every rank makes the same calls of iqn_step, iqn_push and
   iqn_commit, with the same settings, columns and blocks; only lengths differ.  IQN_EARG is found by each rank alone:
   the others wait in their sum. */
typedef int iqn_sum(double *v, int count, void *ctx);

/* Bytes for vectors of n >= 0 local numbers in blocks >= 1 blocks, and at most columns = 0 .. 10000 pairs.  0: bad
   arguments. */
IQN_API size_t iqn_size(ptrdiff_t n, int columns, int blocks);

/* Build in mem[0..bytes-1], which must outlive *q; mem must be aligned for a double.  There is no destroy.  n may be 0
   on ranks without interface.  IQN_EARG, IQN_EMEM. */
IQN_API int iqn_make(iqn **q, ptrdiff_t n, int columns, int blocks, void *mem, size_t bytes);

/* Settings.  block -1 means all blocks.  IQN_LENGTH only before the first step.  IQN_EARG: no such key, block or
   value. */
IQN_API int iqn_set(iqn *q, int key, double value);
IQN_API int iqn_set_block(iqn *q, int block, int key, double value);
IQN_API double iqn_get(const iqn *q, int key); /* keys of iqn_set and iqn_get; NaN: others */
IQN_API double iqn_get_block(const iqn *q, int block, int key); /* block keys, IQN_RESIDUAL ... IQN_REDUCTION */
IQN_API int iqn_set_sum(iqn *q, iqn_sum *sum, void *ctx); /* NULL: one process, the default */

/* ---- a step, and the end of a window ----------------------------------------------------------------------------- */

/* In: x and hx = H(x), n numbers each, not overlapping.  Out: x = the next input, or hx when converged.  x may be
   changed by the host between steps.  The pair of the converged iteration is stored, too: a host with its own
   criterion calls iqn_step on the last iteration as well, and takes hx.  Remarks as above; IQN_EARG (also: the
   lengths of the blocks do not add up to n), IQN_ENAN, IQN_ESUM: x and the pairs are as before, and the same call may
   be made again.  (Where the third sum of IQN_MAX_STEP and bounds fails, the pair is stored and the step counted; the
   same call then completes the step.) */
IQN_API int iqn_step(iqn *q, double *x, const double *hx);

/* 0: go on.  1: at the last step every block with limits met one of its own, and so did x as a whole, or r was 0.
   2: IQN_MAX_ITERATIONS or IQN_PATIENCE ran out without. */
IQN_API int iqn_converged(const iqn *q);

/* The window is accepted: its pairs become past ones, and the oldest window beyond IQN_WINDOWS (at least one is kept
   for the next first step) is dropped; or, IMVJ, a restart may be due.  IQN_EARG, IQN_ESUM (of RS_SVD: call
   again). */
IQN_API int iqn_commit(iqn *q);

/* The window is repeated: its pairs are forgotten, pushed ones, too (push, then commit, to keep them).  IQN_EARG. */
IQN_API int iqn_discard(iqn *q);

/* ---- secant pairs ------------------------------------------------------------------------------------------------ */

/* Store a pair from elsewhere: hx changes by w[0..n-1] when r = hx - x changes by v[0..n-1].  It becomes the newest
   of the current window; the oldest goes if there is no room.  IQN_DROPPED: v is zero, not stored. IQN_EARG (also: 0
   columns), IQN_ENAN (also: w/v out of range), IQN_ESUM. */
IQN_API int iqn_push(iqn *q, const double *v, const double *w);

/* Copy pair j (0 is the newest) to v[0..n-1] and w[0..n-1]; NULL: not wanted.  IQN_EARG: no such pair. */
IQN_API int iqn_pair(const iqn *q, int j, double *v, double *w);

IQN_API int iqn_version(void);
IQN_API const char *iqn_message(int status);

#ifdef __cplusplus
}
#endif
#elif IQN_VERSION != 100
#  error "two different versions of iqn.h in one translation unit"
#endif /* IQN_H_INCLUDED */

/* ------------------------------------------------------------------------------------------------------------------ */
#if defined(IQN_IMPLEMENTATION) && !defined(IQN_IMPLEMENTATION_INCLUDED)
#define IQN_IMPLEMENTATION_INCLUDED

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Error-free sums die under -ffast-math and under contraction, and both change bits: off for this half of the file. */
#if defined(__clang__)
#  pragma float_control(push)
#  pragma float_control(precise, on)
#  pragma clang fp contract(off)
#elif defined(__GNUC__)
#  pragma GCC push_options
#  pragma GCC optimize("no-fast-math", "no-finite-math-only", "fp-contract=off", "tree-vectorize", "vect-cost-model=dynamic")
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
#  define IQN__DISPATCH 1 /* compiled for old processors: ask at run time for FMA; the bits are the same */
#else
#  define IQN__DISPATCH 0
#endif
#ifdef __FP_FAST_FMA
#  define IQN__FMA 1
#else
#  define IQN__FMA 0
#endif

#define IQN__ROWS 8192 /* rows per chunk: work arrays in the cache, long enough for the memory's streams */
#define IQN__PARTS 3   /* numbers that carry one double-double through the host's sum */

/* ---- double-double numbers h + l --------------------------------------------------------------------------------- */

typedef struct iqn__dd {
    double h, l;
} iqn__dd;

static iqn__dd iqn__two_sum(double a, double b)
{
    iqn__dd s;
    double t;
    s.h = a + b;
    t = s.h - a;
    s.l = (a - (s.h - t)) + (b - t);
    return s;
}

static iqn__dd iqn__fast_two_sum(double a, double b)
{
    iqn__dd s;
    s.h = a + b;
    s.l = b - (s.h - a);
    return s;
}

/* a b - p for p = fl(a b): one fused operation, or Dekker's splitting */
IQN__INLINE double iqn__product_error(double a, double b, double p, int fused)
{
    double ah, al, bh, bl, t;
#if defined(__GNUC__)
    if (fused) return __builtin_fma(a, b, -p);
#else
    if (fused) return fma(a, b, -p);
#endif
    t = 134217729.0 * a;
    ah = t - (t - a);
    al = a - ah;
    t = 134217729.0 * b;
    bh = t - (t - b);
    bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}

static iqn__dd iqn__dd_of(double h)
{
    iqn__dd r;
    r.h = h;
    r.l = 0;
    return r;
}

static iqn__dd iqn__add(iqn__dd a, iqn__dd b)
{
    iqn__dd s = iqn__two_sum(a.h, b.h), t = iqn__two_sum(a.l, b.l);
    s = iqn__fast_two_sum(s.h, s.l + t.h);
    return iqn__fast_two_sum(s.h, s.l + t.l);
}

static iqn__dd iqn__mul(iqn__dd a, iqn__dd b)
{
    double p = a.h * b.h;
    return iqn__fast_two_sum(p, iqn__product_error(a.h, b.h, p, IQN__FMA) + (a.h * b.l + a.l * b.h));
}

static iqn__dd iqn__scale(iqn__dd a, double power_of_two)
{
    a.h *= power_of_two;
    a.l *= power_of_two;
    return a;
}

static iqn__dd iqn__shift(iqn__dd a, int k) /* a 2^k */
{
    a.h = ldexp(a.h, k);
    a.l = ldexp(a.l, k);
    return a;
}

static iqn__dd iqn__sub(iqn__dd a, iqn__dd b)
{
    return iqn__add(a, iqn__scale(b, -1));
}

static iqn__dd iqn__div(iqn__dd a, iqn__dd b)
{
    double q0 = a.h / b.h, q1;
    iqn__dd r = iqn__sub(a, iqn__mul(b, iqn__dd_of(q0)));
    q1 = r.h / b.h;
    r = iqn__sub(r, iqn__mul(b, iqn__dd_of(q1)));
    return iqn__add(iqn__fast_two_sum(q0, q1), iqn__dd_of(r.h / b.h));
}

static iqn__dd iqn__sqrt(iqn__dd a) /* a > 0 */
{
    iqn__dd s = iqn__dd_of(sqrt(a.h)), r = iqn__sub(a, iqn__mul(s, s));
    s = iqn__fast_two_sum(s.h, r.h / (2 * s.h));
    r = iqn__sub(a, iqn__mul(s, s));
    return iqn__add(s, iqn__dd_of(r.h / (2 * s.h)));
}

/* ---- bits and exponents ------------------------------------------------------------------------------------------ */

static int iqn__finite(double a) /* on the bits: isfinite folds to 1 under -ffast-math */
{
    uint64_t u;
    memcpy(&u, &a, sizeof u);
    return (u >> 52 & 0x7ff) != 0x7ff;
}

static double iqn__pow2(int k) /* -1022 <= k <= 1023 */
{
    uint64_t u = (uint64_t)(k + 1023) << 52;
    double a;
    memcpy(&a, &u, sizeof a);
    return a;
}

static int iqn__clamp(int k, int limit)
{
    return k > limit ? limit : k < -limit ? -limit : k;
}

/* A norm f 2^e, f in [0.5, 1) or 0: the norm of finite numbers may overflow a double. */
typedef struct iqn__norm {
    double f;
    int e, filler; /* no padding: every byte of a checkpoint is defined */
} iqn__norm;

static iqn__norm iqn__root(double square, int e) /* sqrt(square) 2^e */
{
    iqn__norm a;
    a.f = frexp(sqrt(square), &a.e);
    a.e = square > 0 ? a.e + e : -2000;
    a.filler = 0;
    return a;
}

static double iqn__ratio(iqn__norm a, iqn__norm b) /* a/b; 0/0 = 0 */
{
    return a.f == 0 ? 0 : b.f == 0 ? HUGE_VAL : ldexp(a.f / b.f, a.e - b.e);
}

static iqn__norm iqn__times(iqn__norm a, iqn__norm b)
{
    iqn__norm c = iqn__root(a.f * a.f * b.f * b.f, 0);
    if (c.f > 0) c.e += a.e + b.e;
    return c;
}

static iqn__norm iqn__hypot(iqn__norm a, iqn__norm b)
{
    double s = iqn__ratio(a.e > b.e ? b : a, a.e > b.e ? a : b);
    return a.f == 0 && b.f == 0 ? a
                                : iqn__root((a.e > b.e ? a.f * a.f : b.f * b.f) * (1 + s * s), a.e > b.e ? a.e : b.e);
}

/* ---- the object -------------------------------------------------------------------------------------------------- */

enum { IQN__SETTINGS = IQN_TRUNCATION + 1, IQN__BLOCK_SETTINGS = IQN_UPPER - IQN_LENGTH + 1 };
enum { IQN__COUNTERS = IQN_NSTALLED - IQN_NSTEPS + 1 };

struct iqn {
    ptrdiff_t n;
    iqn_sum *sum;
    void *ctx;
    double set[IQN__SETTINGS];
    double counter[IQN__COUNTERS];
    double factor;          /* omega of the last relaxation, sign and all */
    double mixing;          /* IQN_MIXING, or what retreats left of it */
    double least;           /* |r| / |hx| of this window */
    double surprise;        /* what the first update of the last windows left of the residual */
    iqn__norm residual, value, first, first_value;
    iqn__norm best, milestone; /* least residual of this window, and the one that progress is measured from */
    int columns, blocks;    /* capacities */
    int used;               /* pairs stored: slots order[0..used-1], newest first */
    int marked;             /* ... of them dropped[] by the filter at the last step, to be forgotten at the next one */
    int last;               /* the slot that holds r and hx of the last step */
    int chained;            /* ... belongs to this window, so the next step makes a pair */
    int e;                  /* 2^e is the unit of the projections c */
    int window, iterations, converged, stepped;
    int windows;            /* committed since the last restart of IMVJ */
    int waited;             /* iterations since the milestone */
    int quasi;              /* the last step was a quasi-Newton step */
};

typedef struct iqn__block {
    ptrdiff_t length;
    double set[IQN__BLOCK_SETTINGS], tol[3];
    iqn__norm residual, value, first, first_value;
    iqn__norm now, now_value;              /* residual and value of a step that may still fail */
    iqn__norm anchor;                      /* residual of the iterate in slot `last` */
    double sum, used_sum;                  /* residual-sum scaling: the sum of this window and the one in use */
    iqn__norm weight;
} iqn__block;

/* Everything in the caller's memory behind struct iqn.  Slot s of V and W is at + s n; column j of the Gram matrix of
   block b is gram + (b slots + j) slots.  Pair s is stored as v 2^-exponent[s], w 2^-exponent[s]. */
typedef struct iqn__view {
    int slots;
    iqn__block *block;
    iqn__dd *gram, *c, *acc;       /* V'V and V'r per block, sums on the way */
    iqn__dd *S, *L, *y, *alpha;    /* the weighted Gram matrix, its Cholesky factor, right-hand side, solution */
    double *V, *W, *r, *v, *d, *sums, *coefficient, *work;
    int *order, *exponent, *window, *dropped, *kept, *base;
    int top; /* S is in units of 4^top times those of the columns */
} iqn__view;

static void *iqn__take(size_t *at, void *mem, size_t count, size_t size)
{
    size_t old = *at, most = (size_t)-1 / 4;
    void *p = mem ? (void *)((char *)mem + old) : NULL;
    *at = old > most || count > (most - old) / size ? most + 1 : (old + count * size + 7) / 8 * 8;
    return p;
}

static size_t iqn__layout(ptrdiff_t n, int columns, int blocks, void *mem, iqn__view *m)
{
    size_t slots, B, rows, at = 0, pairs, numbers;
    if (n < 0 || columns < 0 || blocks < 1 || columns > 10000 || blocks > INT_MAX / 6 / (columns + 3)) return 0;
    slots = (size_t)columns + 1;
    B = (size_t)blocks;
    rows = n < IQN__ROWS ? (size_t)n : (size_t)IQN__ROWS;
    if (rows < slots) rows = slots;
    pairs = slots * slots;
    numbers = B * (2 * slots + 3);
    iqn__take(&at, mem, 1, sizeof(struct iqn));
    m->slots = columns + 1;
    m->block = (iqn__block *)iqn__take(&at, mem, B, sizeof(iqn__block));
    m->gram = (iqn__dd *)iqn__take(&at, mem, B, pairs * sizeof(iqn__dd));
    m->c = (iqn__dd *)iqn__take(&at, mem, B * slots, sizeof(iqn__dd));
    m->acc = (iqn__dd *)iqn__take(&at, mem, numbers, sizeof(iqn__dd));
    m->S = (iqn__dd *)iqn__take(&at, mem, pairs, sizeof(iqn__dd));
    m->L = (iqn__dd *)iqn__take(&at, mem, pairs, sizeof(iqn__dd));
    m->y = (iqn__dd *)iqn__take(&at, mem, slots, sizeof(iqn__dd));
    m->alpha = (iqn__dd *)iqn__take(&at, mem, slots, sizeof(iqn__dd));
    m->sums = (double *)iqn__take(&at, mem, IQN__PARTS * numbers + 6 * B, sizeof(double));
    m->work = (double *)iqn__take(&at, mem, 5 * pairs, sizeof(double));
    m->coefficient = (double *)iqn__take(&at, mem, slots, sizeof(double));
    m->order = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->exponent = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->window = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->dropped = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->kept = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->base = (int *)iqn__take(&at, mem, slots, sizeof(int));
    m->r = (double *)iqn__take(&at, mem, rows, sizeof(double));
    m->v = (double *)iqn__take(&at, mem, rows, sizeof(double));
    m->d = (double *)iqn__take(&at, mem, rows, sizeof(double));
    m->V = (double *)iqn__take(&at, mem, (size_t)n, slots * sizeof(double));
    m->W = (double *)iqn__take(&at, mem, (size_t)n, slots * sizeof(double));
    return at > (size_t)-1 / 4 ? 0 : at;
}

static iqn__view iqn__open(const iqn *q)
{
    iqn__view m;
    iqn__layout(q->n, q->columns, q->blocks, (void *)(uintptr_t)q, &m);
    return m;
}

/* ---- sweeps over the long vectors -------------------------------------------------------------------------------- */

/* Eight lanes in named scalars: compilers turn them into vector registers without flags, and the order of additions,
   hence every bit of the result, does not depend on the processor.  The loop vectoriser would shuffle the lanes. */
#if defined(__clang__)
#  define IQN__LANES _Pragma("clang loop vectorize(disable) unroll(disable)")
#else
#  define IQN__LANES
#  if defined(__GNUC__)
#    pragma GCC pop_options /* not nested: a nested pop forgets the outer options */
#    pragma GCC push_options
#    pragma GCC optimize("no-fast-math", "no-finite-math-only", "fp-contract=off", "no-tree-loop-vectorize", "tree-slp-vectorize")
#  endif
#endif
#if defined(__GNUC__) /* 4 KiB ahead: a single stream with this much arithmetic leaves the memory idle otherwise */
#  define IQN__PREFETCH(p) __builtin_prefetch((const void *)((uintptr_t)(p) + 4096));
#else
#  define IQN__PREFETCH(p)
#endif
#define IQN__EIGHT(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)
#define IQN__LANE_ZERO(k) double s##k = 0, l##k = 0, u##k = 0;
#define IQN__LANE_FAST(k)           \
    s##k += a[i + k] * r[i + k];    \
    u##k += a[i + k] * d[i + k];
#define IQN__LANE_ACCURATE(k)                                                                                   \
    p = a[i + k] * r[i + k];                                                                                    \
    t = s##k + p;                                                                                               \
    z = t - s##k;                                                                                               \
    l##k += ((s##k - (t - z)) + (p - z)) + iqn__product_error(a[i + k], r[i + k], p, fused);                    \
    s##k = t;                                                                                                   \
    u##k += a[i + k] * d[i + k];
#define IQN__LANE_OUT(k)  \
    lanes[k] = s##k;      \
    lanes[8 + k] = l##k;  \
    lanes[16 + k] = u##k;

static void iqn__sum_lanes(const double *lanes, iqn__dd *out)
{
    int k;
    for (k = 0; k < 8; k++) {
        out[0] = iqn__add(out[0], iqn__fast_two_sum(lanes[k], lanes[8 + k]));
        out[1].h += lanes[16 + k];
    }
}

/* Eight lanes of a'r, of its errors and of a'd over the first n / 8 * 8 rows.  A function for a processor chosen at run
   time holds this loop and nothing else: it calls no function, hands its lanes over in memory, and ends in
   IQN__UPPER_HALVES_CLEAN, for with dirty upper halves the host's SSE code runs at a quarter of its speed. */
IQN__INLINE void iqn__lanes_body(ptrdiff_t n, const double *a, const double *r, const double *d, double *lanes, int fused)
{
    IQN__EIGHT(IQN__LANE_ZERO)
    double p, t, z;
    ptrdiff_t i;
    IQN__LANES
    for (i = 0; i + 8 <= n; i += 8) {
        IQN__PREFETCH(a + i)
        IQN__EIGHT(IQN__LANE_ACCURATE)
    }
    IQN__EIGHT(IQN__LANE_OUT)
}

static void iqn__lanes_plain(ptrdiff_t n, const double *a, const double *r, const double *d, double *lanes)
{
    iqn__lanes_body(n, a, r, d, lanes, IQN__FMA);
}

#if IQN__DISPATCH
#  define IQN__UPPER_HALVES_CLEAN __builtin_ia32_vzeroupper();
__attribute__((target("avx2,fma"), noinline)) static void iqn__lanes_fused(ptrdiff_t n, const double *a, const double *r,
                                                                           const double *d, double *lanes)
{
    iqn__lanes_body(n, a, r, d, lanes, 1);
    IQN__UPPER_HALVES_CLEAN
}
#endif

typedef void iqn__lanes(ptrdiff_t n, const double *a, const double *r, const double *d, double *lanes);

static iqn__lanes *iqn__choose_lanes(void)
{
#if IQN__DISPATCH
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return iqn__lanes_fused;
#endif
    return iqn__lanes_plain;
}

/* out[0] += a'r in double-double, out[1] += a'd in double */
static void iqn__dot_accurate(ptrdiff_t n, const double *a, const double *r, const double *d, iqn__dd *out)
{
    double lanes[24], p;
    ptrdiff_t i;
    iqn__choose_lanes()(n, a, r, d, lanes);
    iqn__sum_lanes(lanes, out);
    for (i = n / 8 * 8; i < n; i++) {
        p = a[i] * r[i];
        out[0] = iqn__add(out[0], iqn__fast_two_sum(p, iqn__product_error(a[i], r[i], p, IQN__FMA)));
        out[1].h += a[i] * d[i];
    }
}

static void iqn__dot_fast(ptrdiff_t n, const double *a, const double *r, const double *d, iqn__dd *out)
{
    IQN__EIGHT(IQN__LANE_ZERO)
    double lanes[24];
    ptrdiff_t i;
    IQN__LANES
    for (i = 0; i + 8 <= n; i += 8) {
        IQN__PREFETCH(a + i)
        IQN__EIGHT(IQN__LANE_FAST)
    }
    IQN__EIGHT(IQN__LANE_OUT)
    iqn__sum_lanes(lanes, out);
    for (; i < n; i++) {
        out[0] = iqn__add(out[0], iqn__dd_of(a[i] * r[i]));
        out[1].h += a[i] * d[i];
    }
}

typedef void iqn__dot(ptrdiff_t n, const double *a, const double *r, const double *d, iqn__dd *out);

#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC pop_options
#  pragma GCC push_options
#  pragma GCC optimize("no-fast-math", "no-finite-math-only", "fp-contract=off", "tree-vectorize", "vect-cost-model=dynamic")
#endif

static iqn__dot *iqn__choose_dot(int level)
{
    return level == IQN_FAST ? iqn__dot_fast : iqn__dot_accurate;
}

/* out[0..2] += the squares of a - b (of a where b is NULL) in units of 2^1200, 1 or 2^-1200, whichever is in range for
   these rows.  square is their plain sum, if that is known, or 0. */
static void iqn__squares(ptrdiff_t n, const double *a, const double *b, double square, double *out)
{
    const double big = iqn__pow2(600), tiny = iqn__pow2(-600);
    const double unit[3] = {iqn__pow2(-600), 1, iqn__pow2(600)};
    double sum[3] = {0, square, 0}, lanes[24], t;
    iqn__dd total[2];
    ptrdiff_t i;
    int k;
    for (k = 0; k < 3 && !(square > tiny && square < big); k++) { /* in the order of iqn__dot_fast, for the same bits */
        memset(lanes, 0, sizeof lanes);
        memset(total, 0, sizeof total);
        for (i = 0; i < n; i++) {
            t = unit[k] * (b ? a[i] - b[i] : a[i]);
            if (i == n / 8 * 8) iqn__sum_lanes(lanes, total);
            if (i < n / 8 * 8) lanes[i & 7] += t * t;
            else total[0] = iqn__add(total[0], iqn__dd_of(t * t));
        }
        if (n % 8 == 0) iqn__sum_lanes(lanes, total);
        sum[k] = total[0].h;
    }
    k = !iqn__finite(sum[1]) || sum[1] >= big ? 0 : sum[1] <= tiny ? 2 : 1;
    out[k] += sum[k];
}

static iqn__norm iqn__norm_of(const double *square)
{
    iqn__norm a = iqn__hypot(iqn__root(square[0], 600), iqn__root(square[1], 0));
    return iqn__hypot(a, iqn__root(square[2], -600));
}

enum { IQN__STEP, IQN__PUSH };

/* One read of V, nothing written but acc and the squares.  With r = (hx - x) 2^-e, r0 the r of the step before and v
   = r - r0:  acc of block b is  V'r and V'd of slot 0, of slot 1, ...,  r'r, v'r, v'v.  Fast: d = v.  Accurate: d is
   what rounding took from v, for V'v = V'r - V'r0 + V'd exactly, and one double-double sum per column is enough.
   Pushing: hx is the new column v, x its w;  r = hx 2^-e, v = r0. */
static void iqn__sweep(const iqn *q, const iqn__view *m, int mode, const double *x, const double *hx, int e)
{
    const int level = (int)q->set[IQN_LEVEL], chained = q->chained;
    iqn__dot *const dot = iqn__choose_dot(level);
    const double s = iqn__pow2(-e), s0 = mode == IQN__PUSH ? iqn__pow2(-q->e) : s;
    double *IQN__RESTRICT r = m->r, *IQN__RESTRICT v = m->v, *IQN__RESTRICT d = m->d, t, z;
    ptrdiff_t start = 0, i, k, rows;
    int b, j;
    for (b = 0; b < q->blocks; b++) {
        iqn__dd *acc = m->acc + (ptrdiff_t)b * (2 * m->slots + 3), *last = acc + 2 * m->slots, pair[2], square[2];
        double *squares = m->sums + 6 * (ptrdiff_t)b;
        const ptrdiff_t end = start + m->block[b].length;
        memset(acc, 0, (size_t)(2 * m->slots + 3) * sizeof *acc);
        memset(squares, 0, 6 * sizeof *squares);
        for (i = start; i < end; i += rows) {
            const double *IQN__RESTRICT r0 = m->V + q->last * q->n + i, *IQN__RESTRICT h = hx + i;
            const double *IQN__RESTRICT a = x + i, *value = mode == IQN__STEP ? h : a;
            rows = end - i < IQN__ROWS ? end - i : IQN__ROWS;
            if (mode == IQN__PUSH)
                for (k = 0; k < rows; k++) r[k] = h[k] * s;
            else
                for (k = 0; k < rows; k++) r[k] = (h[k] - a[k]) * s;
            if (chained && mode == IQN__STEP)
                for (k = 0; k < rows; k++) {
                    t = r0[k] * s;
                    v[k] = r[k] - t;
                    z = v[k] - r[k];
                    d[k] = (z + t) - (r[k] - (v[k] - z));
                }
            else if (chained)
                for (k = 0; k < rows; k++) v[k] = r0[k] * s0;
            memset(square, 0, sizeof square);
            dot(rows, r, r, r, square);
            last[0] = iqn__add(last[0], square[0]);
            memset(square, 0, sizeof square);
            iqn__dot_fast(rows, r, r, r, square);
            iqn__squares(rows, h, mode == IQN__STEP ? a : NULL,
                         e > 250 || e < -250 ? 0 : square[0].h * iqn__pow2(2 * e), squares);
            if (chained) {
                memset(pair, 0, sizeof pair);
                dot(rows, v, r, v, pair);
                last[1] = iqn__add(last[1], pair[0]);
                memset(pair, 0, sizeof pair);
                dot(rows, v, v, v, pair);
                last[2] = iqn__add(last[2], pair[0]);
            }
            memset(square, 0, sizeof square);
            iqn__dot_fast(rows, value, value, value, square);
            iqn__squares(rows, value, NULL, square[0].h, squares + 3);
            for (j = 0; j < q->used; j++)
                dot(rows, m->V + m->order[j] * q->n + i, r,
                    !chained || mode == IQN__PUSH ? r
                    : level == IQN_FAST           ? v
                                                  : d,
                    acc + 2 * m->order[j]);
        }
        start = end;
    }
}

/* ---- sums over the ranks ----------------------------------------------------------------------------------------- */

static int iqn__reduce(iqn *q, double *v, int count)
{
    if (!q->sum) return 0;
    q->counter[IQN_NSUMS - IQN_NSTEPS]++;
    return q->sum(v, count, q->ctx) ? IQN_ESUM : 0;
}

/* a as multiples of 2^(e-48), 2^(e-84), 2^(e-120): with the sum of all |a| below 2^e, the sums of the parts are exact
   in any order on up to 2^17 ranks. */
static double *iqn__pack(iqn__dd a, int e, int level, double *out)
{
    static const int grid[IQN__PARTS] = {48, 84, 120};
    int i;
    if (level == IQN_FAST) {
        *out++ = a.h;
        return out;
    }
    for (e = iqn__clamp(e, 900), i = 0; i < IQN__PARTS; i++) {
        *out = floor(a.h * iqn__pow2(grid[i] - e) + 0.5) * iqn__pow2(e - grid[i]);
        a = iqn__add(a, iqn__dd_of(-*out++));
    }
    return out;
}

static const double *iqn__unpack(const double *in, int level, iqn__dd *a)
{
    if (level == IQN_FAST) {
        *a = iqn__dd_of(*in);
        return in + 1;
    }
    *a = iqn__add(iqn__two_sum(in[0], in[1]), iqn__dd_of(in[2]));
    return in + IQN__PARTS;
}

/* Exponent k with sqrt(a) < 2^k */
static int iqn__root_exponent(double a)
{
    int k;
    frexp(a, &k);
    return a > 0 ? (k + 3000) / 2 - 1499 : -900;
}

/* acc -> its sum over the ranks; |r| and |r0| per block bound every number, which fixes the grids. */
static int iqn__sum_up(iqn *q, const iqn__view *m, int mode, int e)
{
    const int level = (int)q->set[IQN_LEVEL];
    double *out = m->sums;
    const double *in = m->sums;
    int pass, b, j, k, er, ev, status;
    for (pass = 0; pass < 2; pass++) {
        for (b = 0; b < q->blocks; b++) {
            iqn__dd *acc = m->acc + (ptrdiff_t)b * (2 * m->slots + 3);
            const iqn__dd *gram = m->gram + (ptrdiff_t)b * m->slots * m->slots;
            er = m->block[b].now.e - e + 1;
            ev = m->block[b].anchor.e - (mode == IQN__PUSH ? q->e : e) + 1;
            if (mode == IQN__STEP) ev = (ev > er ? ev : er) + 1;
            for (j = 0; j < 2 * q->used + 3; j++) {
                const int pair = j < 2 * q->used, s = pair ? m->order[j / 2] : m->slots;
                const int at = pair ? 2 * s + j % 2 : 2 * s + j - 2 * q->used;
                if (pass) {
                    in = iqn__unpack(in, level, acc + at);
                    continue;
                }
                if (pair) k = iqn__root_exponent(gram[s * (m->slots + 1)].h) + (j % 2 ? ev - 51 : er);
                else k = at == 2 * s ? 2 * er : at == 2 * s + 1 ? er + ev : 2 * ev;
                out = iqn__pack(acc[at], k, level, out);
            }
        }
        if (pass == 0) {
            status = iqn__reduce(q, m->sums, (int)(out - m->sums));
            if (status < 0) return status;
        }
    }
    return 0;
}

/* Sweep and sum: all numbers of this step, on all ranks, nothing else written.  *e: in a guess, out the scale in
   use. */
static int iqn__project(iqn *q, const iqn__view *m, int mode, const double *x, const double *hx, int *e)
{
    iqn__norm r = {0, -2000, 0};
    int b, k, status;
    iqn__sweep(q, m, mode, x, hx, *e);
    status = iqn__reduce(q, m->sums, 6 * q->blocks);
    if (status < 0) return status;
    for (k = 0; k < 6 * q->blocks; k++)
        if (!iqn__finite(m->sums[k])) return IQN_ENAN;
    for (b = 0; b < q->blocks; b++) {
        m->block[b].now = iqn__norm_of(m->sums + 6 * b);
        m->block[b].now_value = iqn__norm_of(m->sums + 6 * b + 3);
        r = iqn__hypot(r, m->block[b].now);
    }
    if (r.f > 0 && (r.e - *e > 150 || r.e - *e < -150)) { /* the guess would cost digits: once more */
        *e = iqn__clamp(r.e, 1000);
        iqn__sweep(q, m, mode, x, hx, *e);
    }
    return iqn__sum_up(q, m, mode, *e);
}

/* ---- the pairs --------------------------------------------------------------------------------------------------- */

static void iqn__count(iqn *q, int counter)
{
    q->counter[counter - IQN_NSTEPS]++;
}

static void iqn__forget(iqn *q, const iqn__view *m, int position) /* the slot becomes free, nothing long moves */
{
    const int slot = m->order[position];
    memmove(m->order + position, m->order + position + 1, (size_t)(m->slots - 1 - position) * sizeof *m->order);
    m->order[m->slots - 1] = slot; /* order is a permutation: used slots, free ones */
    q->marked -= m->dropped[slot];
    m->dropped[slot] = 0;
    q->used--;
}

/* The filter's choice of the last step becomes final, or (at a window's end, where the last pair has not helped yet) is
   withdrawn and left to the first step of the next window. */
static void iqn__settle(iqn *q, const iqn__view *m, int final)
{
    int j;
    for (j = q->used - 1; j >= 0 && q->marked > 0; j--) {
        if (!m->dropped[m->order[j]]) continue;
        m->dropped[m->order[j]] = 0;
        q->marked--;
        if (final) iqn__forget(q, m, j);
        if (final) iqn__count(q, IQN_NDROPPED);
    }
    q->marked = 0;
}

/* Keep the pairs of the current window and of the last `windows` windows that have any. */
static void iqn__expire(iqn *q, const iqn__view *m, int windows)
{
    int j, count = 0, last = q->window;
    for (j = 0; j < q->used; j++) {
        if (m->window[m->order[j]] != last) count++;
        last = m->window[m->order[j]];
        if (count > windows) break;
    }
    while (q->used > j) iqn__forget(q, m, q->used - 1);
}

/* Small algebra of a new pair: its row of V'V, its entry of V'r, its exponent.  Its slot, or -1 if it is zero. */
static int iqn__append(iqn *q, const iqn__view *m, int mode, int e)
{
    const int level = (int)q->set[IQN_LEVEL], slots = m->slots, square = 2 * slots + (mode == IQN__PUSH ? 0 : 2);
    iqn__dd total = {0, 0}, g;
    iqn__norm norm;
    int b, j, s, up, signal = 0;
    for (b = 0; b < q->blocks; b++) { /* a difference of roundings is no information */
        g = m->acc[(ptrdiff_t)b * (2 * slots + 3) + square];
        total = iqn__add(total, g);
        signal |= g.h > 0 && (mode == IQN__PUSH || iqn__ratio(iqn__root(g.h, e), m->block[b].value) > DBL_EPSILON);
    }
    norm = iqn__root(total.h, e);
    if (!signal) iqn__count(q, IQN_NZERO);
    if (!signal || q->columns == 0) return -1;
    if (q->used == q->columns) {
        iqn__forget(q, m, q->used - 1);
        iqn__count(q, IQN_NFULL);
    }
    s = q->last;
    if (mode == IQN__PUSH)
        for (j = slots - 1; s == q->last; j--) s = m->order[j];
    m->exponent[s] = iqn__clamp(norm.e, 1000);
    m->window[s] = q->window;
    up = e - m->exponent[s];
    for (b = 0; b < q->blocks; b++) {
        const iqn__dd *acc = m->acc + (ptrdiff_t)b * (2 * slots + 3);
        iqn__dd *gram = m->gram + (ptrdiff_t)b * slots * slots, *c = m->c + (ptrdiff_t)b * slots;
        for (j = 0; j < q->used; j++) {
            const int o = m->order[j];
            g = acc[2 * o];
            if (mode == IQN__STEP && level == IQN_FAST) g = acc[2 * o + 1];
            else if (mode == IQN__STEP) g = iqn__add(iqn__sub(g, iqn__shift(c[o], q->e - e)), acc[2 * o + 1]);
            gram[s * slots + o] = gram[o * slots + s] = iqn__shift(g, up);
        }
        gram[s * slots + s] = iqn__shift(acc[square], 2 * up);
        c[s] = iqn__shift(acc[2 * slots + 1], up);
    }
    for (j = slots - 1; m->order[j] != s; j--) {}
    for (; j > 0; j--) m->order[j] = m->order[j - 1];
    m->order[0] = s;
    q->used++;
    return s;
}

/* ---- weights, filter, solve: everything below is small ----------------------------------------------------------- */

/* The factor of block b in the least squares, by its scaling. */
static void iqn__weigh(iqn *q, const iqn__view *m)
{
    iqn__norm one = {0.5, 1, 0}, size;
    int b, update = 0;
    if (q->set[IQN_FREEZE] > 0 && q->window >= q->set[IQN_FREEZE]) return;
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        if (q->iterations == 1) block->sum = 0;
        block->sum += iqn__ratio(block->residual, q->residual);
        if (block->sum > 0 && (block->sum >= 10 * block->used_sum || block->sum <= 0.1 * block->used_sum)) update = 1;
    }
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        if (update && block->sum > 0) block->used_sum = block->sum;
        size = one;
        switch ((int)block->set[IQN_SCALING - IQN_LENGTH]) { /* a field that is zero so far is as large as the others */
        case IQN_BY_VALUE: size = block->value.f > 0 ? block->value : q->value; break;
        case IQN_BY_RESIDUAL: size = block->residual.f > 0 ? block->residual : q->residual; break;
        case IQN_BY_RESIDUAL_SUM: size = iqn__root(block->used_sum * block->used_sum, 0); break;
        }
        if (size.f == 0) size = one;
        block->weight = iqn__root(1, 0);
        block->weight.f = frexp(block->set[IQN_WEIGHT - IQN_LENGTH] / size.f, &block->weight.e);
        block->weight.e -= size.e;
    }
}

static int iqn__top(const iqn *q, const iqn__view *m) /* the exponent of the largest weight */
{
    int b, top = -100000;
    for (b = 0; b < q->blocks; b++)
        if (m->block[b].weight.f > 0 && m->block[b].weight.e > top) top = m->block[b].weight.e;
    return top;
}

/* The weighted Gram matrix S and right-hand side y = V'r of the pairs in use, in the order newest to oldest. */
static void iqn__combine(const iqn *q, iqn__view *m)
{
    const int slots = m->slots, used = q->used;
    const int top = iqn__top(q, m);
    int b, i, j;
    m->top = top;
    memset(m->y, 0, (size_t)slots * sizeof *m->y);
    memset(m->S, 0, (size_t)(slots * slots) * sizeof *m->S);
    for (b = 0; b < q->blocks; b++) {
        const iqn__dd *gram = m->gram + (ptrdiff_t)b * slots * slots, *c = m->c + (ptrdiff_t)b * slots;
        const double f = m->block[b].weight.f * 2, w = ldexp(f, m->block[b].weight.e - top), p = w * w;
        const int only = q->blocks == 1;
        iqn__dd w2;
        if (!(p > 0)) continue;
        w2 = iqn__fast_two_sum(p, iqn__product_error(w, w, p, IQN__FMA));
        for (i = 0; i < used; i++) {
            const int s = m->order[i];
            m->y[i] = iqn__add(m->y[i], iqn__mul(w2, c[s]));
            for (j = 0; j <= i; j++) {
                const iqn__dd g = gram[s * slots + m->order[j]];
                m->S[i * slots + j] = only && p == 1 ? g : iqn__add(m->S[i * slots + j], iqn__mul(w2, g));
            }
        }
    }
}

/* One row of the Cholesky factor of S for pair i, against the rows base..count-1 of the kept pairs of its group: with
   R = L' this is column i of the QR factorisation of V.  Returns the square of |R_ii|, before the root. */
static iqn__dd iqn__cholesky_row(const iqn__view *m, int base, int count, int i)
{
    const int slots = m->slots;
    iqn__dd *row = m->L + (ptrdiff_t)count * slots, square = m->S[i * slots + i], t;
    int j, k;
    for (j = base; j < count; j++) {
        const iqn__dd *other = m->L + (ptrdiff_t)j * slots;
        t = m->S[i * slots + m->kept[j]];
        for (k = base; k < j; k++) t = iqn__sub(t, iqn__mul(row[k], other[k]));
        row[j] = iqn__div(t, other[j]);
        square = iqn__sub(square, iqn__mul(row[j], row[j]));
    }
    return square;
}

/* End of the group of pairs that begins at i.  ILS has one group: one least-squares problem.  IMVJ has one for the
   current window (and the past ones of IQN_WINDOWS), and one for each older window: together the old Jacobian. */
static int iqn__group_end(const iqn *q, const iqn__view *m, int i)
{
    int id = m->window[m->order[i]], more = i > 0 || q->set[IQN_WINDOWS] < 0 ? 0 : (int)q->set[IQN_WINDOWS];
    if ((int)q->set[IQN_METHOD] != IQN_IMVJ) return q->used;
    if (id != q->window && more > 0) more--;
    for (; i < q->used; i++) {
        if (m->window[m->order[i]] != id && more-- <= 0) break;
        id = m->window[m->order[i]];
    }
    return i;
}

/* Automatic reuse: the least squares is  |r + V alpha|^2 + sum (0.01 surprise age_j |v_j| alpha_j)^2, as if the pairs
   of past windows had an error that grows with their age in windows.  surprise is |r_2|/|r_1| of the window's first
   update, which knows past pairs only: nothing for a linear H that does not change.  Returns the square of the
   factor. */
static double iqn__distrust(const iqn *q, const iqn__view *m, int j)
{
    const double a = 0.01 * q->surprise * (q->window - m->window[m->order[j]]);
    return a * a;
}

/* Choose the pairs, newest first, and factor: kept[], base[] (where the group of a kept pair begins) and L.  Returns
   how many are kept.  QR1: |R_ii| < limit |R|, absolute: |R_ii| < limit, QR2: |R_ii| < limit |v_i|.  (QR3 is QR2 with
   a cheaper test first; here nothing is cheaper than QR2.)  Below 1e-14 |v_i| (fast sums: 1e-7) |R_ii| is made of
   rounding. */
static int iqn__factor(iqn *q, const iqn__view *m)
{
    const int slots = m->slots, filter = (int)q->set[IQN_FILTER];
    const double floor = (int)q->set[IQN_LEVEL] == IQN_FAST ? 1e-7 : 1e-14,
                 limit = filter == IQN_NOFILTER ? 0 : q->set[IQN_EPSILON];
    const double units = ldexp(1, 2 - 2 * m->top);
    const int ageing = (int)q->set[IQN_METHOD] == IQN_ILS && q->set[IQN_WINDOWS] < 0;
    int i, j, end, count = 0, base;
    iqn__dd d;
    for (i = 0; i < q->used; i = end) {
        double trace = 0, own, least;
        end = iqn__group_end(q, m, i);
        base = count;
        for (j = i; j < end; j++) trace += m->S[j * slots + j].h;
        for (j = i; j < end; j++) {
            own = m->S[j * slots + j].h;
            least = filter == IQN_QR1 ? limit * limit * trace
                    : filter == IQN_QR1_ABSOLUTE && limit > 0
                        ? limit * limit * units * ldexp(1, -2 * m->exponent[m->order[j]])
                        : limit * limit * own;
            d = iqn__cholesky_row(m, base, count, j);
            if ((d.h >= least || (filter <= IQN_QR1_ABSOLUTE && end - i == 1)) && d.h > floor * floor * own) {
                m->base[count] = base;
                if (ageing) d = iqn__add(d, iqn__dd_of(own * iqn__distrust(q, m, j)));
                m->L[count * slots + count] = iqn__sqrt(d);
                m->kept[count++] = j;
                continue;
            }
            trace -= own;
            m->dropped[m->order[j]] = 1;
            q->marked++;
        }
    }
    return count;
}

/* alpha = -argmin: group by group, newest first, each sees what the newer ones have left over.  p = V'r. */
static void iqn__substitute(const iqn__view *m, int count, const iqn__dd *p)
{
    const int slots = m->slots;
    iqn__dd *alpha = m->alpha, t;
    int i, j, base, end;
    for (base = 0; base < count; base = end) {
        for (end = base; end < count && m->base[end] == base; end++) {
            t = p[m->kept[end]];
            for (j = 0; j < base; j++) t = iqn__add(t, iqn__mul(m->S[m->kept[end] * slots + m->kept[j]], alpha[j]));
            t = iqn__scale(t, -1);
            for (j = base; j < end; j++) t = iqn__sub(t, iqn__mul(m->L[end * slots + j], alpha[j]));
            alpha[end] = iqn__div(t, m->L[end * slots + end]);
        }
        for (i = end - 1; i >= base; i--) {
            t = alpha[i];
            for (j = i + 1; j < end; j++) t = iqn__sub(t, iqn__mul(m->L[j * slots + i], alpha[j]));
            alpha[i] = iqn__div(t, m->L[i * slots + i]);
        }
    }
}

/* ---- restarts of IMVJ -------------------------------------------------------------------------------------------- */

/* Eigenvalues of the symmetric n x n matrix A (ld = n) on its diagonal, eigenvectors in the columns of X: cyclic
   Jacobi, until a sweep no longer makes what is off the diagonal smaller. */
static void iqn__eigen(int n, double *A, double *X)
{
    double off, before = HUGE_VAL;
    int i, j, k;
    for (i = 0; i < n * n; i++) X[i] = i % (n + 1) == 0;
    for (;;) {
        for (off = 0, i = 0; i < n; i++)
            for (j = 0; j < i; j++) off += A[i * n + j] * A[i * n + j];
        if (!(off < before)) break;
        before = off;
        for (i = 0; i < n; i++)
            for (j = i + 1; j < n; j++) {
                const double a = A[i * n + j], h = A[j * n + j] - A[i * n + i];
                const double t = a == 0 ? 0 : 2 * a / (fabs(h) + sqrt(h * h + 4 * a * a)) * (h < 0 ? -1 : 1);
                const double c = 1 / sqrt(1 + t * t), s = c * t;
                for (k = 0; k < n; k++) {
                    const double p = A[k * n + i], q = A[k * n + j], u = X[k * n + i], v = X[k * n + j];
                    A[k * n + i] = c * p - s * q;
                    A[k * n + j] = s * p + c * q;
                    X[k * n + i] = c * u - s * v;
                    X[k * n + j] = s * u + c * v;
                }
                for (k = 0; k < n; k++) {
                    const double p = A[i * n + k], q = A[j * n + k];
                    A[i * n + k] = c * p - s * q;
                    A[j * n + k] = s * p + c * q;
                }
            }
    }
}

/* T = W'W of all pairs in use, weighted as V'V is, summed over the ranks */
static int iqn__gram_of_w(iqn *q, const iqn__view *m, double *T)
{
    const int k = q->used;
    ptrdiff_t start, rows, end = 0;
    int b, i, j, status;
    memset(T, 0, (size_t)(k * k) * sizeof *T);
    for (b = 0; b < q->blocks; b++) {
        const double weight = ldexp(2 * m->block[b].weight.f, m->block[b].weight.e - m->top);
        start = end;
        for (end += m->block[b].length; start < end; start += rows) {
            rows = end - start < IQN__ROWS / 8 ? end - start : IQN__ROWS / 8;
            for (i = 0; i < k; i++)
                for (j = 0; j <= i; j++) {
                    const double *wi = m->W + m->order[i] * q->n + start, *wj = m->W + m->order[j] * q->n + start;
                    iqn__dd sum[2] = {{0, 0}, {0, 0}};
                    iqn__dot_fast(rows, wi, wj, wj, sum);
                    T[i * k + j] += weight * weight * sum[0].h;
                }
        }
    }
    status = iqn__reduce(q, T, k * k);
    for (i = 0; i < k; i++)
        for (j = 0; j < i; j++) T[j * k + i] = T[i * k + j];
    return status;
}

/* The columns in use become their linear combinations A (k x count, column by column), in place. */
static void iqn__transform(const iqn *q, const iqn__view *m, double *columns, const double *A, int count)
{
    const int k = q->used, size = q->n < IQN__ROWS ? (int)q->n : IQN__ROWS,
              rows_at_once = size > m->slots ? size / m->slots : 1;
    ptrdiff_t start, rows, r;
    int i, j;
    for (start = 0; start < q->n; start += rows) {
        rows = q->n - start < rows_at_once ? q->n - start : rows_at_once;
        for (j = 0; j < count; j++)
            for (r = 0; r < rows; r++) {
                double t = 0;
                for (i = 0; i < k; i++) t += columns[m->order[i] * q->n + start + r] * A[j * k + i];
                m->r[j * rows + r] = t;
            }
        for (j = 0; j < count; j++)
            memcpy(columns + m->order[j] * q->n + start, m->r + j * rows, (size_t)rows * sizeof *columns);
    }
}

/* Truncated singular value decomposition of the Jacobian J = W M V' that all pairs in use make: J = U s Z', and the
   pairs become (v, w) = (Z_i, s_i U_i).  With V = Q R:  s^2 and X are the eigenpairs of (M R')' W'W (M R'),  Z = Q X,
   U s = W M R' X.  All but the two transformations is small. */
static int iqn__compress(iqn *q, iqn__view *m)
{
    const int k = q->used, slots = m->slots;
    double *M = m->work, *R = M + slots * slots, *T = R + slots * slots, *X = T + slots * slots, *A = X + slots * slots;
    int i, j, l, b, count, rank = 0, most, status;
    iqn__dd d, *unit = m->y;
    if (k == 0) return IQN_OK;
    iqn__combine(q, m);
    status = iqn__gram_of_w(q, m, T);
    if (status < 0) return status;
    count = iqn__factor(q, m);
    memset(M, 0, (size_t)(k * k) * sizeof *M);
    for (i = 0; i < k; i++) { /* column i: what V'r = unit vector makes of alpha */
        for (j = 0; j < k; j++) unit[j] = iqn__dd_of(i == j ? -1 : 0);
        iqn__substitute(m, count, unit);
        for (j = 0; j < count; j++) M[m->kept[j] * k + i] = m->alpha[j].h;
    }
    for (i = 0; i < k; i++) { /* one QR for all groups; pairs in the span of newer ones give no new direction */
        d = iqn__cholesky_row(m, 0, rank, i);
        m->dropped[m->order[i]] = 0;
        if (!(d.h > 1e-12 * m->S[i * slots + i].h)) continue;
        m->L[rank * slots + rank] = iqn__sqrt(d);
        m->kept[rank++] = i;
    }
    q->marked = 0;
    for (i = 0; i < k; i++) { /* R = L^-1 V_kept' V, rank x k */
        for (j = 0; j < rank; j++) {
            const int o = m->kept[j];
            d = i > o ? m->S[i * slots + o] : m->S[o * slots + i];
            for (l = 0; l < j; l++) d = iqn__sub(d, iqn__mul(m->L[j * slots + l], m->alpha[l]));
            m->alpha[j] = iqn__div(d, m->L[j * slots + j]);
            R[j * k + i] = m->alpha[j].h;
        }
    }
    for (i = 0; i < k; i++) /* A = M R', k x rank; then T = A' T A */
        for (j = 0; j < rank; j++)
            for (A[i * rank + j] = 0, l = 0; l < k; l++) A[i * rank + j] += M[i * k + l] * R[j * k + l];
    for (i = 0; i < k; i++)
        for (j = 0; j < rank; j++)
            for (M[i * rank + j] = 0, l = 0; l < k; l++) M[i * rank + j] += T[i * k + l] * A[l * rank + j];
    for (i = 0; i < rank; i++)
        for (j = 0; j < rank; j++)
            for (T[i * rank + j] = 0, l = 0; l < k; l++) T[i * rank + j] += A[l * rank + i] * M[l * rank + j];
    iqn__eigen(rank, T, X);
    for (count = 0; count < rank; count++) { /* sort, largest first, and cut */
        for (most = count, i = count; i < rank; i++)
            if (T[i * rank + i] > T[most * rank + most]) most = i;
        d.h = T[most * rank + most];
        T[most * rank + most] = T[count * rank + count];
        T[count * rank + count] = d.h;
        for (l = 0; l < rank; l++) {
            d.h = X[l * rank + most];
            X[l * rank + most] = X[l * rank + count];
            X[l * rank + count] = d.h;
        }
        if (!(sqrt(T[count * rank + count]) > q->set[IQN_TRUNCATION] * sqrt(T[0])) && count > 0) break;
    }
    memset(M, 0, (size_t)(count * k) * sizeof *M);
    memset(R, 0, (size_t)(count * k) * sizeof *R);
    for (j = 0; j < count; j++) {
        for (i = 0; i < k; i++)
            for (l = 0; l < rank; l++) M[j * k + i] += A[i * rank + l] * X[l * rank + j];
        for (i = rank - 1; i >= 0; i--) { /* Z = V_kept L^-T X */
            d = iqn__dd_of(X[i * rank + j]);
            for (l = i + 1; l < rank; l++)
                d = iqn__sub(d, iqn__mul(m->L[l * slots + i], iqn__dd_of(R[j * k + m->kept[l]])));
            R[j * k + m->kept[i]] = iqn__div(d, m->L[i * slots + i]).h;
        }
    }
    iqn__transform(q, m, m->W, M, count);
    iqn__transform(q, m, m->V, R, count);
    for (b = 0; b < q->blocks; b++) { /* V'V of the new columns: R' (V'V) R */
        iqn__dd *gram = m->gram + (ptrdiff_t)b * slots * slots;
        for (i = 0; i < k; i++)
            for (j = 0; j < count; j++)
                for (m->L[i * slots + j] = iqn__dd_of(0), l = 0; l < k; l++)
                    m->L[i * slots + j] =
                        iqn__add(m->L[i * slots + j],
                                 iqn__mul(gram[m->order[i] * slots + m->order[l]], iqn__dd_of(R[j * k + l])));
        for (i = 0; i < count; i++)
            for (j = 0; j < count; j++) {
                for (d = iqn__dd_of(0), l = 0; l < k; l++)
                    d = iqn__add(d, iqn__mul(m->L[l * slots + j], iqn__dd_of(R[i * k + l])));
                m->S[i * slots + j] = d;
            }
        for (i = 0; i < count; i++)
            for (j = 0; j < count; j++) gram[m->order[i] * slots + m->order[j]] = m->S[i * slots + j];
    }
    for (j = 0; j < count; j++) {
        m->exponent[m->order[j]] = 0;
        m->window[m->order[j]] = q->window - 1;
    }
    while (q->used > count) iqn__forget(q, m, q->used - 1);
    return IQN_OK;
}

/* At the end of a window: what becomes of the old Jacobian. */
static int iqn__restart(iqn *q, iqn__view *m)
{
    const int mode = (int)q->set[IQN_RESTART], due = q->windows >= q->set[IQN_CHUNK];
    int j, status = IQN_OK;
    if (mode == IQN_RS_SLIDE) iqn__expire(q, m, (int)q->set[IQN_CHUNK]);
    if (!due || mode == IQN_RS_NONE || mode == IQN_RS_SLIDE) return IQN_OK;
    if (mode == IQN_RS_ZERO) iqn__expire(q, m, 1);
    if (mode == IQN_RS_LS)
        for (j = 0; j < q->used; j++) m->window[m->order[j]] = q->window - 1;
    if (mode == IQN_RS_SVD) status = iqn__compress(q, m);
    if (status >= 0) q->windows = 0;
    return status;
}

/* ---- the update -------------------------------------------------------------------------------------------------- */

/* y += W[.] a, four columns at a time */
static void iqn__gather(ptrdiff_t rows, double *IQN__RESTRICT y, const double *const *w, const double *a)
{
    const double *w0 = w[0], *w1 = w[1], *w2 = w[2], *w3 = w[3];
    const double a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3];
    ptrdiff_t k;
    for (k = 0; k < rows; k++) y[k] += (a0 * w0[k] + a1 * w1[k]) + (a2 * w2[k] + a3 * w3[k]);
}

/* r0, h0: the last r and hx become the pair (r - r0) 2^-e, (hx - h0) 2^-e */
static void iqn__difference(ptrdiff_t rows, const double *x, const double *hx, int e, double *IQN__RESTRICT r0,
                            double *IQN__RESTRICT h0)
{
    const double s = iqn__pow2(-e), up = e > 0 ? s : 1, down = e > 0 ? 1 : s; /* the order that cannot overflow */
    ptrdiff_t k;
    for (k = 0; k < rows; k++) {
        r0[k] = (hx[k] - x[k]) * s - r0[k] * s;
        h0[k] = (hx[k] * up - h0[k] * up) * down;
    }
}

static void iqn__store(ptrdiff_t rows, const double *x, const double *hx, double *IQN__RESTRICT r,
                       double *IQN__RESTRICT h)
{
    ptrdiff_t k;
    for (k = 0; k < rows; k++) {
        r[k] = hx[k] - x[k];
        h[k] = hx[k];
    }
}

/* y = what the update adds to hx for rows start .. start+rows-1.  terms pairs: W a, and with mixing -(1-beta)(r + V
   a); terms < 0: relaxation, (omega - 1) r.  The pair of slot `raw` is taken from the work arrays v and d.  y is work
   array r. */
static void iqn__change(const iqn *q, const iqn__view *m, const double *x, const double *hx, ptrdiff_t start,
                        ptrdiff_t rows, int terms, double omega, int raw)
{
    double *y = m->r;
    const double damp = terms < 0 ? 1 - omega : 1 - q->mixing;
    const double *w[4];
    double a[4];
    ptrdiff_t k;
    int j, t, pass;
    memset(y, 0, (size_t)rows * sizeof *y);
    for (pass = 0; pass < (damp != 0 ? 2 : 1); pass++)
        for (j = 0; j < terms; j += 4) {
            for (t = 0; t < 4; t++) {
                const int slot = m->order[m->kept[j + t < terms ? j + t : j]];
                w[t] = slot == raw ? (pass ? m->v : m->d) : (pass ? m->V : m->W) + slot * q->n + start;
                a[t] = j + t < terms ? (pass ? -damp : 1) * m->coefficient[j + t] : 0;
            }
            iqn__gather(rows, y, w, a);
        }
    if (damp != 0 && terms != 0)
        for (k = 0; k < rows; k++) y[k] -= damp * (hx[k] - x[k]);
}

/* Rows start .. start+rows-1 of the iterate that the step starts from: the host's, or after a retreat the one in slot
   `last`, its x in the work array v. */
typedef struct iqn__rows {
    const double *x, *hx;
} iqn__rows;

static iqn__rows iqn__rows_from(const iqn *q, const iqn__view *m, const double *x, const double *hx, int back,
                                ptrdiff_t start, ptrdiff_t rows)
{
    const double *r = m->V + q->last * q->n + start;
    iqn__rows from;
    ptrdiff_t k;
    from.x = back ? m->v : x + start;
    from.hx = back ? m->W + q->last * q->n + start : hx + start;
    if (back)
        for (k = 0; k < rows; k++) m->v[k] = from.hx[k] - r[k];
    return from;
}

/* What the step would do, before it does it, only where a limit or bounds ask for it: one more read of W and one more
   sum.  out: the square of the step in three units, how many bounds of IQN_DISCARD blocks it breaks, and in out[4 + k]
   the ranks whose IQN_SCALE blocks allow a fraction of at most 2^(-k/4) of it. */
enum { IQN__FRACTIONS = 64, IQN__FORESEEN = 5 + IQN__FRACTIONS };

static int iqn__foresee(iqn *q, const iqn__view *m, const double *x, const double *hx, int back, int made, int terms,
                        double omega, double *out)
{
    ptrdiff_t i, k, rows, start = 0, end;
    double *y = m->r, fraction = 1;
    iqn__rows old;
    int b;
    memset(out, 0, IQN__FORESEEN * sizeof *out);
    for (b = 0; b < q->blocks; b++, start = end) {
        const double *set = m->block[b].set, low = set[IQN_LOWER - IQN_LENGTH], high = set[IQN_UPPER - IQN_LENGTH];
        const int bounds = (int)set[IQN_BOUNDS - IQN_LENGTH];
        end = start + m->block[b].length;
        for (i = start; i < end; i += rows) {
            rows = end - i < IQN__ROWS ? end - i : IQN__ROWS;
            if (made >= 0) {
                memcpy(m->v, m->V + made * q->n + i, (size_t)rows * sizeof *y);
                memcpy(m->d, m->W + made * q->n + i, (size_t)rows * sizeof *y);
                iqn__difference(rows, x + i, hx + i, m->exponent[made], m->v, m->d);
            }
            old = iqn__rows_from(q, m, x, hx, back, i, rows);
            iqn__change(q, m, old.x, old.hx, i, rows, terms, omega, made);
            for (k = 0; k < rows; k++) {
                const double to = old.hx[k] + y[k], from = old.x[k], edge = to > high ? high : low;
                y[k] = to - from;
                if (to >= low && to <= high) continue;
                if (bounds == IQN_DISCARD) out[3]++;
                if (bounds == IQN_SCALE && from > low && from < high && (edge - from) / y[k] < fraction)
                    fraction = (edge - from) / y[k];
            }
            iqn__squares(rows, y, NULL, 0, out);
        }
    }
    for (b = 0; b < IQN__FRACTIONS && fraction < pow(2, -b / 4.0); b++) {}
    out[4 + b] = 1;
    return iqn__reduce(q, out, IQN__FORESEEN);
}

/* x = hx + y, or a part of that step, inside the bounds; part < 0: x stays.  In the same read of x and hx the slot
   `made` becomes a pair and the slot `next` takes r and hx. */
static void iqn__update(const iqn *q, const iqn__view *m, double *x, const double *hx, int back, int made, int next,
                        int terms, double omega, double part)
{
    ptrdiff_t i, k, rows, start = 0, end;
    double *y = m->r;
    iqn__rows old;
    int b;
    for (b = 0; b < q->blocks; b++, start = end) {
        const double *set = m->block[b].set, low = set[IQN_LOWER - IQN_LENGTH], high = set[IQN_UPPER - IQN_LENGTH];
        end = start + m->block[b].length;
        for (i = start; i < end; i += rows) {
            rows = end - i < IQN__ROWS ? end - i : IQN__ROWS;
            if (made >= 0)
                iqn__difference(rows, x + i, hx + i, m->exponent[made], m->V + made * q->n + i, m->W + made * q->n + i);
            if (!back) iqn__store(rows, x + i, hx + i, m->V + next * q->n + i, m->W + next * q->n + i);
            if (part < 0) continue;
            old = iqn__rows_from(q, m, x, hx, back, i, rows);
            iqn__change(q, m, old.x, old.hx, i, rows, terms, omega, -1);
            if (part < 1)
                for (k = 0; k < rows; k++) x[i + k] = old.x[k] + part * (old.hx[k] + y[k] - old.x[k]);
            else
                for (k = 0; k < rows; k++) x[i + k] = old.hx[k] + y[k];
            if ((int)set[IQN_BOUNDS - IQN_LENGTH] != IQN_IGNORE && terms != 0)
                for (k = 0; k < rows; k++) x[i + k] = x[i + k] < low ? low : x[i + k] > high ? high : x[i + k];
        }
    }
}

/* ---- public functions -------------------------------------------------------------------------------------------- */

typedef struct iqn__range {
    double initial, low, high;
    int whole;
} iqn__range;

static const iqn__range iqn__ranges[IQN__SETTINGS] = {
    {0, 0, 0, 1},
    {IQN_ILS, 0, IQN_CONSTANT, 1},    /* IQN_METHOD */
    {0.1, -1e6, 1e6, 0},              /* IQN_OMEGA */
    {IQN_QR2, 0, IQN_QR3, 1},         /* IQN_FILTER */
    {1e-2, 0, 1, 0},                  /* IQN_EPSILON */
    {-1, -1, 1e6, 1},                 /* IQN_WINDOWS */
    {IQN_ACCURATE, 0, 1, 1},          /* IQN_LEVEL */
    {0, 0, DBL_MAX, 0},               /* IQN_TOL_ABSOLUTE */
    {0, 0, DBL_MAX, 0},               /* IQN_TOL_RELATIVE */
    {0, 0, DBL_MAX, 0},               /* IQN_TOL_REDUCTION */
    {1, 0, 1e9, 1},                   /* IQN_MIN_ITERATIONS */
    {0, 0, 1e9, 1},                   /* IQN_MAX_ITERATIONS */
    {20, 0, 1e9, 1},                  /* IQN_PATIENCE */
    {1, 0, 1, 1},                     /* IQN_TIGHTEN */
    {1, -1e6, 1e6, 0},                /* IQN_MIXING */
    {0, 0, 1e9, 1},                   /* IQN_DELAY */
    {0, 0, DBL_MAX, 0},               /* IQN_MAX_STEP */
    {0, 0, 1e9, 1},                   /* IQN_FREEZE */
    {IQN_RS_NONE, 0, IQN_RS_SLIDE, 1}, /* IQN_RESTART */
    {8, 1, 1e6, 1},                   /* IQN_CHUNK */
    {1e-4, 0, 1, 0},                  /* IQN_TRUNCATION */
};

static const iqn__range iqn__block_ranges[IQN__BLOCK_SETTINGS] = {
    {0, 0, 9e15, 1},                              /* IQN_LENGTH, never read */
    {IQN_BY_WEIGHT, 0, IQN_BY_RESIDUAL_SUM, 1},   /* IQN_SCALING */
    {1, 0, 1e150, 0},                             /* IQN_WEIGHT */
    {IQN_IGNORE, 0, IQN_SCALE, 1},                /* IQN_BOUNDS */
    {-DBL_MAX, -DBL_MAX, DBL_MAX, 0},             /* IQN_LOWER */
    {DBL_MAX, -DBL_MAX, DBL_MAX, 0},              /* IQN_UPPER */
};

static int iqn__allowed(const iqn__range *a, double value)
{
    return value >= a->low && value <= a->high && (!a->whole || value == floor(value));
}

IQN_API IQN__NOINLINE size_t iqn_size(ptrdiff_t n, int columns, int blocks)
{
    iqn__view m;
    return iqn__layout(n, columns, blocks, NULL, &m);
}

IQN_API IQN__NOINLINE int iqn_make(iqn **q, ptrdiff_t n, int columns, int blocks, void *mem, size_t bytes)
{
    size_t need = iqn_size(n, columns, blocks);
    iqn__view m;
    int i, b;
    if (!q || need == 0) return IQN_EARG;
    if (!mem || bytes < need || (uintptr_t)mem % sizeof(double)) return IQN_EMEM;
    memset(mem, 0, need);
    *q = (iqn *)mem;
    (*q)->n = n;
    (*q)->columns = columns;
    (*q)->blocks = blocks;
    for (i = 0; i < IQN__SETTINGS; i++) (*q)->set[i] = iqn__ranges[i].initial;
    (*q)->mixing = (*q)->set[IQN_MIXING];
    m = iqn__open(*q);
    for (b = 0; b < blocks; b++) {
        m.block[b].length = n / blocks + (b == blocks - 1 ? n % blocks : 0);
        for (i = 0; i < IQN__BLOCK_SETTINGS; i++) m.block[b].set[i] = iqn__block_ranges[i].initial;
    }
    for (i = 0; i < m.slots; i++) m.order[i] = i;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_set(iqn *q, int key, double value)
{
    if (!q || key < 1 || key >= IQN__SETTINGS || !iqn__finite(value)) return IQN_EARG;
    if (!iqn__allowed(iqn__ranges + key, value) || (key == IQN_MIXING && value == 0)) return IQN_EARG;
    q->set[key] = value;
    if (key == IQN_MIXING) q->mixing = value;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_set_block(iqn *q, int block, int key, double value)
{
    iqn__view m;
    int b, tol = key >= IQN_TOL_ABSOLUTE && key <= IQN_TOL_REDUCTION;
    if (!q || block < -1 || block >= q->blocks || !iqn__finite(value)) return IQN_EARG;
    if (!tol && (key < IQN_LENGTH || key - IQN_LENGTH >= IQN__BLOCK_SETTINGS)) return IQN_EARG;
    if (!iqn__allowed(tol ? iqn__ranges + key : iqn__block_ranges + (key - IQN_LENGTH), value)) return IQN_EARG;
    if (key == IQN_LENGTH && (q->stepped || q->used || value > (double)q->n)) return IQN_EARG;
    m = iqn__open(q);
    for (b = block < 0 ? 0 : block; b < q->blocks && (block < 0 || b == block); b++) {
        if (key == IQN_LOWER && value > m.block[b].set[IQN_UPPER - IQN_LENGTH]) return IQN_EARG;
        if (key == IQN_UPPER && value < m.block[b].set[IQN_LOWER - IQN_LENGTH]) return IQN_EARG;
    }
    for (b = block < 0 ? 0 : block; b < q->blocks && (block < 0 || b == block); b++)
        if (tol) m.block[b].tol[key - IQN_TOL_ABSOLUTE] = value;
        else if (key == IQN_LENGTH) m.block[b].length = (ptrdiff_t)value;
        else m.block[b].set[key - IQN_LENGTH] = value;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_set_sum(iqn *q, iqn_sum *sum, void *ctx)
{
    if (!q) return IQN_EARG;
    q->sum = sum;
    q->ctx = ctx;
    return IQN_OK;
}

static double iqn__nan(void)
{
    const uint64_t u = (uint64_t)0x7ff8 << 48;
    double a;
    memcpy(&a, &u, sizeof a);
    return a;
}

IQN_API IQN__NOINLINE double iqn_get(const iqn *q, int key)
{
    if (!q) return iqn__nan();
    if (key >= 1 && key < IQN__SETTINGS) return q->set[key];
    switch (key) {
    case IQN_RESIDUAL: return ldexp(q->residual.f, q->residual.e);
    case IQN_VALUE: return ldexp(q->value.f, q->value.e);
    case IQN_RELATIVE: return iqn__ratio(q->residual, q->value);
    case IQN_REDUCTION: return iqn__ratio(q->residual, q->first);
    case IQN_COLUMNS: return q->used - q->marked;
    case IQN_ITERATIONS: return q->iterations;
    case IQN_BEST: return q->least;
    case IQN_FACTOR: return q->factor;
    case IQN_DAMPING: return q->mixing;
    }
    if (key >= IQN_NSTEPS && key - IQN_NSTEPS < IQN__COUNTERS) return q->counter[key - IQN_NSTEPS];
    return iqn__nan();
}

IQN_API IQN__NOINLINE double iqn_get_block(const iqn *q, int block, int key)
{
    const iqn__block *b;
    if (!q || block < 0 || block >= q->blocks) return iqn__nan();
    b = iqn__open(q).block + block;
    if (key >= IQN_TOL_ABSOLUTE && key <= IQN_TOL_REDUCTION) return b->tol[key - IQN_TOL_ABSOLUTE];
    if (key == IQN_LENGTH) return (double)b->length;
    if (key > IQN_LENGTH && key - IQN_LENGTH < IQN__BLOCK_SETTINGS) return b->set[key - IQN_LENGTH];
    switch (key) {
    case IQN_RESIDUAL: return ldexp(b->residual.f, b->residual.e);
    case IQN_VALUE: return ldexp(b->value.f, b->value.e);
    case IQN_RELATIVE: return iqn__ratio(b->residual, b->value);
    case IQN_REDUCTION: return iqn__ratio(b->residual, b->first);
    }
    return iqn__nan();
}

/* 0: no limit set, 1: one of them holds, -1: none holds.  An x that runs away makes |r|/|hx| small: values count up
   to 1e6 times those of the window's first iteration. */
static int iqn__within(iqn__norm r, iqn__norm value, iqn__norm first, iqn__norm first_value, const double *tol)
{
    iqn__norm one = {0.5, 1, 0};
    if (iqn__ratio(value, first_value) > 1e6) {
        value.f = first_value.f;
        value.e = first_value.e + 20;
    }
    if (!(tol[0] > 0) && !(tol[1] > 0) && !(tol[2] > 0)) return 0;
    return iqn__ratio(r, one) <= tol[0] || iqn__ratio(r, value) <= tol[1] || iqn__ratio(r, first) <= tol[2] ? 1 : -1;
}

/* Take over the norms of a step that cannot fail any more. */
static void iqn__judge(iqn *q, const iqn__view *m)
{
    int b, k, none, all = 1, any = 0;
    q->residual = q->value = iqn__root(0, 0);
    for (b = 0; b < q->blocks; b++) {
        iqn__block *block = m->block + b;
        block->residual = block->now;
        block->value = block->now_value;
        if (q->iterations == 0) block->first = block->residual;
        if (q->iterations == 0 || block->first_value.f == 0) block->first_value = block->value; /* not 0 */
        q->residual = iqn__hypot(q->residual, block->residual);
        q->value = iqn__hypot(q->value, block->value);
        k = iqn__within(block->residual, block->value, block->first, block->first_value, block->tol);
        any |= k;
        all &= k >= 0;
    }
    if (q->iterations == 0) q->first = q->residual;
    if (q->iterations == 0 || q->first_value.f == 0) q->first_value = q->value;
    k = iqn__within(q->residual, q->value, q->first, q->first_value, q->set + IQN_TOL_ABSOLUTE);
    any |= k;
    all &= k >= 0;
    none = q->residual.f == 0;
    q->iterations++;
    q->stepped = 1;
    q->converged = ((any && all) || none) && q->iterations >= q->set[IQN_MIN_ITERATIONS];
    iqn__count(q, IQN_NSTEPS);
}

/* Watch the residuals of this window.  The remark of this step, or 0. */
static int iqn__watch(iqn *q)
{
    int status = 0;
    if (q->iterations == 1) {
        q->best = q->milestone = q->residual;
        q->least = iqn__ratio(q->residual, q->value);
        q->waited = q->quasi = 0;
        q->mixing = q->set[IQN_MIXING];
        return 0;
    }
    if (q->iterations == 2 && q->quasi) q->surprise = fmin(1, iqn__ratio(q->residual, q->first));
    if (iqn__ratio(q->residual, q->best) < 1) q->best = q->residual;
    q->least = fmin(q->least, iqn__ratio(q->residual, q->value));
    q->waited++;
    if (iqn__ratio(q->residual, q->milestone) < 0.9) {
        q->milestone = q->residual;
        q->waited = 0;
    }
    if (q->set[IQN_PATIENCE] > 0 && q->waited >= q->set[IQN_PATIENCE]) {
        iqn__count(q, IQN_NSTALLED);
        status = iqn__ratio(q->residual, q->best) > 1e3 ? IQN_DIVERGED
                 : iqn__ratio(q->best, q->first) < 1e-3 ? IQN_NOISE
                                                        : IQN_STALLED;
    }
    return status;
}

/* Strong added mass: where the pairs do not explain r, hx multiplies it by a large negative slope, and one bad step
   leaves the range in which secants mean anything.  If the last quasi-Newton step tripled the residual that the least
   squares sees, withdraw it: no pair, a fifth of the mixing, and again from the iterate before, whose r and hx are
   still in slot `last` and whose V'r is still in c.  Not below the relaxation factor, so that the number of retreats
   is bounded. */
static int iqn__retreat(iqn *q, const iqn__view *m)
{
    const double omega = q->set[IQN_OMEGA] == 0 ? 0.1 : fabs(q->set[IQN_OMEGA]),
                 least = fmax(omega, 0.1 * fabs(q->set[IQN_MIXING]));
    iqn__norm now = iqn__root(0, 0), then = now;
    int b, back, whole = 1;
    for (b = 0; b < q->blocks; b++) {
        const iqn__block *block = m->block + b;
        whole &= block->weight.f > 0;
        now = iqn__hypot(now, iqn__times(block->weight, block->residual));
        then = iqn__hypot(then, iqn__times(block->weight, block->anchor));
    }
    back = whole && q->set[IQN_TIGHTEN] > 0 && q->chained && q->quasi && !q->converged && fabs(q->mixing) > least &&
           iqn__ratio(now, then) > 3;
    if (back) {
        q->mixing = copysign(fmax(0.2 * fabs(q->mixing), least), q->mixing);
        iqn__count(q, IQN_NTIGHTENED);
    } else
        for (b = 0; b < q->blocks; b++) m->block[b].anchor = m->block[b].residual;
    return back;
}

/* omega of the step: Aitken's secant on v = r - r0 in the weighted norm, every time or (automatic) once a window */
static double iqn__relaxation(iqn *q, const iqn__view *m)
{
    const int aitken = (int)q->set[IQN_METHOD] == IQN_AITKEN;
    const double given = q->set[IQN_OMEGA], omega = given < 0 || given > 0 ? given : 0.1, size = fabs(omega);
    double rv = 0, vv = 0, secant;
    int b, top = iqn__top(q, m);
    if (!aitken && omega == given) return q->factor = omega;
    if (q->factor == 0) return q->factor = omega;
    if (!q->chained) {
        if (aitken && fabs(q->factor) > size) q->factor = q->factor < 0 ? -size : size;
        return q->factor;
    }
    for (b = 0; b < q->blocks; b++) {
        const iqn__dd *last = m->acc + (ptrdiff_t)b * (2 * m->slots + 3) + 2 * m->slots;
        const double w = ldexp(m->block[b].weight.f, m->block[b].weight.e - top);
        rv += w * w * iqn__sub(last[1], last[2]).h;
        vv += w * w * last[2].h;
    }
    secant = -q->factor * rv / vv;
    if (!q->quasi && (aitken || q->iterations == 2) && iqn__finite(secant) && fabs(secant) > 0 && fabs(secant) <= 1e6)
        q->factor = secant;
    return q->factor;
}

/* The part of a step of `size` times |hx of the first iteration| that IQN_MAX_STEP allows. */
static double iqn__shortened(const iqn *q, double size)
{
    const double most = q->set[IQN_MAX_STEP];
    return most > 0 && size > most && q->first_value.f > 0 ? most / size : 1;
}

/* The part of the step that IQN_MAX_STEP and the bounds allow; < 0: none, relax instead. */
static double iqn__part(const iqn *q, const double *foreseen)
{
    double part = iqn__shortened(q, iqn__ratio(iqn__norm_of(foreseen), q->first_value));
    int k;
    if (!iqn__finite(foreseen[0]) || foreseen[3] > 0) return -1; /* what overflows is in the first unit */
    for (k = IQN__FRACTIONS; k > 0 && !(foreseen[4 + k] > 0); k--) {}
    if (k == IQN__FRACTIONS) return -1;
    if (k > 0 && pow(2, -k / 4.0) < part) part = pow(2, -k / 4.0);
    return part;
}

static int iqn__windows(const iqn *q) /* past windows in the least squares of ILS */
{
    return q->set[IQN_WINDOWS] < 0 ? INT_MAX : (int)q->set[IQN_WINDOWS];
}

static int iqn__covered(const iqn *q, const iqn__view *m) /* the lengths of the blocks add up to n */
{
    ptrdiff_t length = 0;
    int b;
    for (b = 0; b < q->blocks; b++) length += m->block[b].length;
    return length == q->n;
}

IQN_API IQN__NOINLINE int iqn_step(iqn *q, double *x, const double *hx)
{
    iqn__view m;
    iqn__norm before;
    double omega = 1, part = 1, mixing, foreseen[IQN__FORESEEN];
    int b, j, e, made = -1, next, terms = -1, status, remark, quasi_method, ahead, back;
    if (!q || (q->n > 0 && (!x || !hx || x == hx))) return IQN_EARG;
    m = iqn__open(q);
    if (!iqn__covered(q, &m)) return IQN_EARG;
    quasi_method = (int)q->set[IQN_METHOD] <= IQN_IMVJ;
    before = q->residual;
    e = q->stepped && before.f > 0 ? iqn__clamp(before.e, 1000) : 0;
    status = iqn__project(q, &m, IQN__STEP, x, hx, &e);
    if (status < 0) {
        if (status == IQN_ENAN) iqn__count(q, IQN_NREFUSED);
        return status;
    }

    /* nothing can fail from here on, but for the extra sum of limits and bounds */
    iqn__settle(q, &m, 1);
    iqn__judge(q, &m);
    remark = iqn__watch(q);
    mixing = q->mixing;
    back = iqn__retreat(q, &m);
    if (q->chained && quasi_method && !back) {
        if ((int)q->set[IQN_METHOD] == IQN_ILS) iqn__expire(q, &m, iqn__windows(q));
        if (q->counter[0] > 1 + q->set[IQN_DELAY]) made = iqn__append(q, &m, IQN__STEP, e);
    }
    for (b = 0; b < q->blocks && !back; b++)
        for (j = made >= 0; j < q->used; j++) {
            const int o = m.order[j];
            m.c[b * m.slots + o] = m.acc[b * (2 * m.slots + 3) + 2 * o];
        }
    if (!back) {
        q->e = e;
        iqn__weigh(q, &m);
    }
    if (q->converged) terms = 0;
    else if (quasi_method && q->used > 0) {
        iqn__combine(q, &m);
        terms = iqn__factor(q, &m);
        iqn__substitute(&m, terms, m.y);
        for (j = 0; j < terms; j++) {
            m.coefficient[j] = ldexp(m.alpha[j].h, q->e);
            if (!iqn__finite(m.coefficient[j])) terms = 0;
        }
        if (terms == 0) terms = -1;
    }
    if (terms < 0) omega = iqn__relaxation(q, &m);
    ahead = q->set[IQN_MAX_STEP] > 0;
    for (b = 0; b < q->blocks; b++) ahead |= (int)m.block[b].set[IQN_BOUNDS - IQN_LENGTH] >= IQN_DISCARD;
    status = q->converged ? IQN_CONVERGED
             : back       ? IQN_TIGHTENED
             : terms < 0  ? IQN_RELAXED
             : q->marked  ? IQN_DROPPED
                          : IQN_OK;
    if (ahead && terms != 0) {
        if (iqn__foresee(q, &m, x, hx, back, made, terms, omega, foreseen)) {
            if (back) { /* the same retreat next time */
                q->mixing = mixing;
                return IQN_ESUM;
            }
            status = IQN_ESUM; /* x stays, the pair is kept: the next call with the same x and hx makes no other */
            remark = 0;
            part = -1;
        } else if ((part = iqn__part(q, foreseen)) < 0) {
            if (terms > 0) omega = q->set[IQN_OMEGA] == 0 ? 0.1 : q->set[IQN_OMEGA];
            terms = -1;
            part = iqn__shortened(q, fabs(omega) * iqn__ratio(q->residual, q->first_value));
            status = IQN_LIMITED;
        } else if (part < 1) status = IQN_LIMITED;
        if (status == IQN_LIMITED) iqn__count(q, IQN_NLIMITED);
    }
    if (terms < 0) iqn__count(q, IQN_NRELAXED);
    next = made >= 0 ? m.order[m.slots - 1] : q->last;
    iqn__update(q, &m, x, hx, back, made, next, terms, omega, part);
    q->last = next;
    q->chained = 1;
    q->quasi = terms > 0;
    return remark && !q->converged ? remark : status;
}

IQN_API IQN__NOINLINE int iqn_converged(const iqn *q)
{
    if (!q) return 0;
    if (q->converged) return 1;
    if (q->set[IQN_PATIENCE] > 0 && q->waited >= q->set[IQN_PATIENCE]) return 2;
    return q->set[IQN_MAX_ITERATIONS] > 0 && q->iterations >= q->set[IQN_MAX_ITERATIONS] ? 2 : 0;
}

IQN_API IQN__NOINLINE int iqn_commit(iqn *q)
{
    iqn__view m;
    if (!q) return IQN_EARG;
    m = iqn__open(q);
    iqn__settle(q, &m, 0);
    if (q->iterations > 0 || (q->used > 0 && m.window[m.order[0]] == q->window)) { /* pushed pairs are pairs */
        q->window++;
        q->windows++;
    }
    q->iterations = q->chained = q->converged = q->waited = 0;
    if ((int)q->set[IQN_METHOD] == IQN_IMVJ) return iqn__restart(q, &m);
    iqn__expire(q, &m, iqn__windows(q) > 1 ? iqn__windows(q) : 1);
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_discard(iqn *q)
{
    iqn__view m;
    if (!q) return IQN_EARG;
    m = iqn__open(q);
    iqn__settle(q, &m, 0);
    while (q->used > 0 && m.window[m.order[0]] == q->window) iqn__forget(q, &m, 0);
    q->iterations = q->chained = q->converged = q->waited = 0;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_push(iqn *q, const double *v, const double *w)
{
    iqn__view m;
    ptrdiff_t k;
    iqn__norm of_v = iqn__root(0, 0), of_w = of_v;
    int b, e = 0, s, status;
    if (!q || (q->n > 0 && (!v || !w)) || q->columns == 0) return IQN_EARG;
    m = iqn__open(q);
    if (!iqn__covered(q, &m)) return IQN_EARG;
    status = iqn__project(q, &m, IQN__PUSH, w, v, &e);
    if (status < 0) return status;
    for (b = 0; b < q->blocks; b++) {
        of_v = iqn__hypot(of_v, m.block[b].now);
        of_w = iqn__hypot(of_w, m.block[b].now_value);
    }
    if (of_v.f > 0 && of_w.e - iqn__clamp(of_v.e, 1000) > 1000) return IQN_ENAN;
    s = iqn__append(q, &m, IQN__PUSH, e);
    if (s < 0) return IQN_DROPPED;
    for (k = 0; k < q->n; k++) {
        m.V[s * q->n + k] = v[k] * iqn__pow2(-m.exponent[s]);
        m.W[s * q->n + k] = w[k] * iqn__pow2(-m.exponent[s]);
    }
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_pair(const iqn *q, int j, double *v, double *w)
{
    iqn__view m;
    ptrdiff_t k;
    double s;
    if (!q || j < 0 || j >= q->used) return IQN_EARG;
    m = iqn__open(q);
    s = iqn__pow2(m.exponent[m.order[j]]);
    for (k = 0; v && k < q->n; k++) v[k] = m.V[m.order[j] * q->n + k] * s;
    for (k = 0; w && k < q->n; k++) w[k] = m.W[m.order[j] * q->n + k] * s;
    return IQN_OK;
}

IQN_API IQN__NOINLINE int iqn_version(void)
{
    return IQN_VERSION;
}

IQN_API IQN__NOINLINE const char *iqn_message(int status)
{
    switch (status) {
    case IQN_OK: return "quasi-Newton update";
    case IQN_CONVERGED: return "converged";
    case IQN_RELAXED: return "relaxed: no usable secant pair";
    case IQN_DROPPED: return "quasi-Newton update, pairs dropped by the filter";
    case IQN_TIGHTENED: return "a bad quasi-Newton step withdrawn, a damped one from the iterate before";
    case IQN_LIMITED: return "IQN_MAX_STEP or the bounds changed the update";
    case IQN_STALLED: return "no progress for IQN_PATIENCE iterations";
    case IQN_NOISE: return "no progress for IQN_PATIENCE iterations: noise of the solvers";
    case IQN_DIVERGED: return "diverging for IQN_PATIENCE iterations";
    case IQN_EARG: return "an argument is NULL, NaN or out of range";
    case IQN_EMEM: return "memory too small or not aligned for a double";
    case IQN_ENAN: return "x, hx or hx - x is not finite, here or on another rank";
    case IQN_ESUM: return "the sum over the ranks failed";
    }
    return "unknown status";
}

#if defined(__clang__)
#  pragma float_control(pop)
#elif defined(__GNUC__)
#  pragma GCC pop_options
#elif defined(_MSC_VER)
#  pragma float_control(pop)
#endif

#ifdef __cplusplus
}
#endif
#endif /* IQN_IMPLEMENTATION */

/* ------------------------------------------------------------------------------------------------------------------

VERSION HISTORY
   0.1.0  first version

LICENSE

Copyright (c) 2026 the authors of waveform.h, iqn.h and rk.h

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
persons to whom the Software is furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE. */
