/* SPDX-License-Identifier: MIT

   rk.h - v0.1.0 - Runge-Kutta tables, each verified by its own order conditions, with dense output for every one

   In *one* C or C++ file, before the include:

      #define RK_IMPLEMENTATION
      #include "rk.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates, prints, aborts or keeps a
   global (but const tables).  The time loop stays yours: you evaluate f and solve implicit stages; the header forms
   every sum over long vectors.

   SYNOPSIS

      One step of y' = f(t,y) from t to t+h; slope i is kept at k + i*n, T->stages + T->extra slopes in all:

      const rk_table *T = rk_find("dp5");
      for (i = 0; i < T->stages; i++) {
          rk_stage(T, i, h, n, y, k, n, z);                // z = y + h sum_{j<i} a_ij k_j
          f(t + T->c[i]*h, z, k + i*n);                    // k_i; if a_ii != 0 solve k_i = f(t + c_i h, z + h a_ii k_i)
      }
      rk_finish(T, h, n, y, k, n, ynew, err);              // ynew = y + h sum b_j k_j, err = h sum (b_j - bhat_j) k_j
      rk_norm(n, err, y, ynew, 1e-6, 1e-9, sum);           // double sum[4] = {0}; add the sums of all ranks here
      rk_dense(T, rk_theta(s, t, h), 0, h, n, y, k, n, v); // v = y(s); with 1 for 0: y'(s)
      if (rk_control_step(&C, T->order_hat, rk_rms(sum), t, h, &hnext) == RK_OK)
          t += h;                                          // accepted: ynew becomes y
      h = hnext;                                           // either way; sum is set to zero again

      Stages with index >= T->stages (T->extra of them: verner6, dop853) serve dense output only: compute them as the
      others before calling rk_dense, which reads T->stages + T->extra slopes.
      FSAL (rk_is): the last slope is the first of the next step.  If explicit, its z was ynew: rk_finish may get ynew
      NULL; if implicit, z + h a_ii k_i was.
      IMEX: two tables and arrays of slopes, two calls: rk_stage(E, i, h, n, y, kE, n, z),
      rk_stage(I, i, h, n, z, kI, n, z).
      Mass matrix M y' = f: slopes are k_i = M^-1 f; implicit stages solve with M - h a_ii J.  Nothing else changes.
      Predictor of stage i of the next step, of size h2: rk_dense at theta = 1 + c_i h2/h with the last y, h and k.

   COMPILE-TIME OPTIONS, before the include, the same in every file
      RK_STATIC   every function private to the including file, for a library that embeds this header
      RK_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS
      k_i = f(t + c_i h, y + h sum_j a_ij k_j),  ynew = y + h sum_i b_i k_i,
      y(t + theta h) ~ y + h sum_i b_i(theta) k_i,  b_i(theta) = sum_k d_ik theta^k.
      Order p: sum_i b_i Phi_i(t) = 1/gamma(t) for every rooted tree t of at most p vertices.
      Uniform order q of the dense output: sum_i d_ik Phi_i(t) = [k = |t|]/gamma(t) for every k and |t| <= q.
      Trees are generated, not typed in, coloured ones for additive methods; a residual is judged by the size of its
      terms.  Order q = p - 1 keeps order p in a converged waveform iteration if it is sampled at p or more points per
      step, ends included, and interpolated with degree p - 1 (linear interpolation gives order 2 whatever it was
      sampled from).  For stiff partners the dense output must not contain f(y) undamped: all implicit tables here but
      the generated Lobatto IIIA have |R(-inf, theta)| <= 1, R(z, theta) being what y becomes at theta for y' = lambda
      y, z = lambda h: an error of 1e-8 in y stays 1e-8 inside the step at z = -1e7, where cubic Hermite interpolation
      makes 1.5e-2 of it.

      Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I (1993): order conditions, dop853, first step.
      Hairer & Wanner, the same II (1996): collocation, sdirk4.  Beyer & Hedetniemi, SIAM J. Comput. 9 (1980): the
      trees.  Zennaro, Math. Comp. 46 (1986): dense output of rk4.  Kraaijevanger, BIT 31 (1991): contractivity.
      Kennedy & Carpenter, Appl. Numer. Math. 44 (2003), NASA/TM-2016-219173, Appl. Numer. Math. 136 (2019): ark*,
      esdirk*.  Soderlind, ACM Trans. Math. Softw. 29 (2003): the form of step control, H0211 to H312.  Gustafsson, the
      same 17 (1991) and 20 (1994): "explicit" and "implicit".  Chung & Hulbert, J. Appl. Mech. 60 (1993): generalized
      alpha.  Knoth & Wolke, Appl. Numer. Math. 28 (1998): KW3.  Sandu, SIAM J. Numer. Anal. 57 (2019): MRI-GARK.  Fish,
      Reynolds & Roberts, J. Comput. Appl. Math. 438 (2024): IMEX-MRI-SR.  Luan, Chinomona & Reynolds, SIAM J. Sci.
      Comput. 42 (2020): MERK.  Dense outputs for which no source is named are this library's own, by the least squares
      of rk_extend.

   TABLES
      name        s  p  pair dense stability   dense: uniform order; stability: L, A, or |R| <= 1 on [-x,0] and i[-y,y]
     | euler      1  1  -   1   2.00,0.00      Euler 1768
     | heun       2  2  1   2   2.00,0.00      Heun 1900, SSP(2,2)
     | midpoint   2  2  1   2   2.00,0.00      Runge 1895
     | kutta3     3  3  -   2   2.51,1.73      Kutta 1901
     | ssp33      3  3  2   2   2.51,1.73      Shu & Osher 1988, C = 1
     | ssp43      4  3  2   3   5.15,2.16      Kraaijevanger 1991, C = 2
     | ssp104    10  4  3   3   13.92,4.92     Ketcheson 2008, C = 6
     | bs3        4  3  2   3   2.51,1.73      Bogacki & Shampine 1989
     | rk4        4  4  -   3   2.79,2.83      Kutta 1901
     | ss4        5  4  3   3   2.79,2.83      Sofroniou & Spaletta 2004
     | dp5        7  5  4   4   3.31,1.00      Dormand & Prince 1980
     | tsit5      7  5  4   4   3.51,0.48      Tsitouras 2011
     | verner6    9  6  5   5   4.32,0.00      Verner 2010, "robust"; dense output: 1 more stage
     | dop853    12  8  5   7   6.39,5.96      Hairer, Norsett & Wanner 1993; dense output: f(ynew) and 3 more stages
     | beuler     1  1  -   1   L              implicit Euler
     | imidpoint  1  2  -   1   A              implicit midpoint rule
     | trapezoid  2  2  -   1   A              trapezoidal rule
     | sdirk2     2  2  1   2   L              Alexander 1977, pair of Ellsiepen 1999
     | trbdf2     3  2  1   2   L              Bank et al. 1985
     | esdirk3    5  3  2   3   L              ESDIRK3(2)5L[2]SA, Kennedy & Carpenter 2016
     | esdirk4    6  4  3   3   L              ESDIRK4(3)6L[2]SA
     | esdirk4b   7  4  3   4   L              ESDIRK4(3)7L[2]SA, error constant 7 times smaller; 2019
     | esdirk5    7  5  4   4   L              ESDIRK5(4)7L[2]SA2, Kennedy & Carpenter 2019
     | sdirk4     5  4  3   3   L              Hairer & Wanner 1996; no explicit first stage, for index-sensitive partners
     | wso3       4  3  -   3   L              weak stage order 3: keeps its order with time-dependent boundary data
     | ars222e    3  2  -   2   2.00,0.00      IMEX halves, e with i: Ascher, Ruuth & Spiteri 1997
     | ars222i    3  2  -   2   L
     | ars443e    5  3  -   3   2.14,1.57
     | ars443i    5  3  -   3   L
     | ark2e      3  2  1   2   2.51,1.73      Giraldo, Kelly & Constantinescu 2013
     | ark2i      3  2  1   2   L
     | ark3e      4  3  2   2   3.66,2.48      ARK3(2)4L[2]SA, Kennedy & Carpenter 2003
     | ark3i      4  3  2   2   L
     | ark4e      7  4  3   3   6.76,4.70      ARK4(3)7L[2]SA, Kennedy & Carpenter 2019
     | ark4i      7  4  3   3   L
     | ark5e      8  5  4   3   3.86,0.00      ARK5(4)8L[2]SAb
     | ark5i      8  5  4   3   L
      generated: Gauss, Radau IIA, Lobatto IIIA, IIIB, IIIC of up to 5 stages (rk_collocation)
      multirate: KW3 ERK22a ERK33a ERK45a IRK21a ESDIRK34a ESDIRK46a (MIS, MRI-GARK), SR21 SR32 SR43 (IMEX-MRI-SR),
                 MERK21 MERK32 MERK43 MERK54 (rk_coupling_find)

   DOES NOT
      step, solve, allocate, find roots, handle events or mass matrices, or estimate spectral radii: no Rosenbrock,
      stabilised (RKC, ROCK) or low-storage methods, and none of order above 8 (double precision ends there).

   LIMITATIONS
      Dense output of order p-1 without more evaluations of f exists for all stored tables but verner6 and dop853 (extra
      stages) and the halves ark5e and ark5i (order 3).  Generated tables of s stages have dense order s, IIIB s - 1:
      less than p-1 for Gauss, Radau IIA and IIIB with 3 or more stages, IIIA and IIIC with 4 or more: exchange stage
      values.  The dense output of Lobatto IIIA is not bounded for stiff parts; nor is what rk_extend makes of any
      coupled table.  rk_extend adds stages to explicit tables only; those of a stiff table would not be bounded.
      dop853's third-order companion estimate is not included.  sdirk4's and trbdf2's estimates are bounded, not damped.
      A partial sum that overflows is caught and redone scaled; h times a weight must itself be representable.
      Round-off of long runs (rk4, y'' = -y, steps of 1e-4): 5e-14 after 1e6 steps, 4e-13 after 1e7; with compensated
      sums of the increments (rk_combine with y NULL) 5e-15 and 5e-14.  Form t as t0 + i*h: after 1e6 additions of 1e-3
      it is off by 1.7e-8.

   DETERMINISM
      Every sum has a fixed order that does not depend on n, alignment or aliasing.  Bits change with contraction to
      fused multiply-adds (-march=native, -ffp-contract) and with -ffast-math, under which they may depend on n, too.
      rk_dense at theta = 1 and rk_finish run the same code, so they agree bit for bit under any flags.

   THREADS
      No state: any number of threads may call anything on their own arrays, and read the same tables.

   LICENSE
      MIT; full text and version history at the end of the file.  */

/* not RK_H_INCLUDED, nor RK_H: NumPy's randomkit.h has that one */
#ifndef RK_H_INCLUDED_TABLES
#define RK_H_INCLUDED_TABLES
#define RK_VERSION 100 /* 10000*major + 100*minor + patch */

#include <stddef.h>

#ifndef RK_API
#  ifndef RK_STATIC
#    define RK_API extern
#  elif defined(__GNUC__)
#    define RK_API static __attribute__((unused))
#  else
#    define RK_API static
#  endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define RK_STAGES_MAX 64      /* stages of a table, with those for dense output */
#define RK_ORDER_MAX  10      /* the order conditions are generated up to here */
#define RK_TOLERANCE  2.2e-14 /* a scaled residual (rk_defect) above this, 100 rounding errors, is a wrong table */

/* Status: 0 done; > 0 done, with a remark; < 0 nothing done, nothing touched.  The numbers of statuses, properties and
   kinds never change: hosts in other languages carry them by value, and new ones are added at the end. */
enum {
    RK_OK = 0,
    RK_EXTRAP = 301,    /* theta outside [0, 1]: the polynomial is continued */
    RK_NONFINITE = 302, /* the result holds Inf or NaN: a slope did, or the exact result overflows */
    RK_ROWSUM = 303,    /* c is not the row sums of A, yet the order holds for time-dependent f too (Lobatto IIIB) */
    RK_LOWER = 304,     /* rk_extend: the order asked for was not attained, see dense_order */
    RK_REJECT = 305,    /* rk_control_step: repeat the step with the new size */
    RK_EARG = -301,     /* an argument is NULL, NaN or out of range */
    RK_ENODENSE = -302, /* the table has no dense output: see rk_extend */
    RK_ENOPAIR = -303,  /* the table has no embedded weights */
    RK_EMEM = -304,     /* memory too small or not aligned for a double */
    RK_ETABLE = -305,   /* NaN or Inf in the table, an order it cannot have, or extra stages that the step uses */
    RK_EORDER = -306,   /* b does not have the order it claims */
    RK_EHAT = -307,     /* bhat does not have the order it claims */
    RK_EDENSE = -308,   /* the dense output does not have the order it claims, or does not end in b */
    RK_ETINY = -309     /* the next step would not move t */
};

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* A table is plain data: add your own.  m = stages + extra; all arrays are stored row by row. */
typedef struct rk_table {
    const char *name;
    int stages;           /* s, the slopes of one step */
    int order, order_hat; /* of b and of bhat; order_hat 0: no embedded weights */
    int dense;            /* degree in theta of d; 0: no dense output */
    int dense_order;      /* uniform order of the dense output in theta */
    int extra;            /* more stages that only the dense output needs; usually 0 */
    const double *A;      /* [m*m], a_ij at A[i*m + j] */
    const double *b, *c;  /* [m], [m] */
    const double *bhat;   /* [m], embedded weights, or NULL */
    const double *e;      /* [m], b - bhat rounded once, or NULL: formed from b and bhat */
    const double *d;      /* [m*dense], b_i(theta) = sum_j d[i*dense + j] theta^(j+1), or NULL */
} rk_table;

RK_API const rk_table *rk_find(const char *name); /* NULL if there is none of that name */
RK_API const rk_table *rk_list(int i);            /* i = 0, 1, ...; NULL at the end */

/* Implicit methods of 1..5 stages (Lobatto: 2..5), fully coupled, filled into T from the host's memory, which T then
   points to; mem must be aligned for a double and outlive *T, bytes >= rk_size(stages, stages).  Order 2s, 2s-1, 2s-2
   for Gauss, Radau, Lobatto; the dense output is the integral of the polynomial through the slopes, of order s (IIIB:
   s-1).  Named "gauss2", "radauIIA3" and so on.  RK_EARG, RK_EMEM. */
enum { RK_GAUSS = 1, RK_RADAU_IIA, RK_LOBATTO_IIIA, RK_LOBATTO_IIIB, RK_LOBATTO_IIIC };
RK_API int rk_collocation(rk_table *T, int family, int stages, void *mem, size_t bytes);

/* Bytes for a table of that many stages with a dense output of that order, rk_extend's work included; 0: bad
   arguments. */
RK_API size_t rk_size(int stages, int order);

/* ---- a step ------------------------------------------------------------------------------------------------------ */
/* In all of these: n numbers per vector (0 is allowed), slope j at k + j*ldk with ldk >= n; h is finite and may be
   negative.  Outputs overlap nothing but, where it says so, y.  RK_EARG; RK_NONFINITE: a slope with a weight other than
   0 or y is not finite, or the result overflows; it is written all the same. */

/* z = y + h sum_{j<i} a_ij k_j, for i < stages + extra; z may be y.  Where a_ii != 0 the stage is implicit: solve
   k_i = f(t + c_i h, z + h a_ii k_i).  An IMEX method is two calls, the second with z for y; a fully implicit one wants
   rk_stages.  RK_NONFINITE shows the first stage that takes up what went wrong.  RK_EARG, RK_NONFINITE. */
RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                    double *z);

/* out = y + h sum_{j<s} weight_j k_j, s <= RK_STAGES_MAX: the sum behind all of these, zero weights skipped; y NULL for
   none, out may be y.  RK_EARG, RK_NONFINITE. */
RK_API int rk_combine(ptrdiff_t n, const double *y, double h, int s, const double *weight, const double *k,
                      ptrdiff_t ldk, double *out);

/* z_i = y + h sum_j a_ij k_j over *all* j, for every stage i < stages: for fully implicit tables (rk_collocation),
   whose slopes k_i = f(t + c_i h, z_i) are solved together; z_i at z + i*ldz, ldz >= n; y, k and z apart from each
   other.  RK_EARG, RK_NONFINITE. */
RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                     double *z, ptrdiff_t ldz);

/* ynew = y + h sum b_j k_j and err = h sum (b_j - bhat_j) k_j, in units of y, either of them NULL when not wanted; ynew
   may be y, but neither may be a slope.  RK_EARG, RK_ENOPAIR (err wanted), RK_NONFINITE. */
RK_API int rk_finish(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                     double *ynew, double *err);

/* ---- dense output ------------------------------------------------------------------------------------------------ */
/* deriv = 0: out = y(t + theta h), from the y of the step's start; deriv = r: the r-th derivative in *time* there, y is
   not read; out may be y.  k holds T->stages + T->extra slopes.  theta within 4 DBL_EPSILON of 0 or 1 counts as that
   end, and returns y or rk_finish's ynew bit for bit.  RK_EXTRAP: theta outside [0, 1] (a prediction).  RK_EARG also
   for deriv > 1 with h = 0 or an h^(1 - deriv) that overflows.  RK_EARG, RK_ENODENSE, RK_EXTRAP, RK_NONFINITE. */
RK_API int rk_dense(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y, const double *k,
                    ptrdiff_t ldk, double *out);

/* The same at `count` thetas in one sweep over the slopes: out_l at out + l*ldout, ldout >= n; y, k and out apart from
   each other.  The statuses of rk_dense, one for all: nothing is written if one theta is refused. */
RK_API int rk_dense_many(const rk_table *T, int count, const double *theta, int deriv, double h, ptrdiff_t n,
                         const double *y, const double *k, ptrdiff_t ldk, double *out, ptrdiff_t ldout);

/* (t - t0)/h with the round-off of the times removed: 0 or 1 when t is within 4 DBL_EPSILON max(|t0|, |t0 + h|) of that
   end.  The host sees to h != 0 and to a t0 + h that is finite. */
RK_API double rk_theta(double t, double t0, double h);

/* The stages + extra weights behind rk_dense: the deriv-th derivative of b_i(theta), per unit of theta; not finite
   where a far theta overflows.  RK_EARG, RK_ENODENSE, RK_EXTRAP. */
RK_API int rk_weights(const rk_table *T, double theta, int deriv, double *weight);

/* Dense output derived for any table: out = T with b_i(theta) of uniform order `order`, bounded or not; order 0: the
   highest that T's own slopes give, for an implicit T the highest that stays bounded (|R(-inf, theta)| <= 1 for every
   theta).  Explicit tables may add up to `more` (<= 9) stages to get there: the slope at ynew, then bootstrapped ones.
   other: the other half of an IMEX method, with the same b, or NULL; the conditions then hold for both, the bound for
   T: let T be the implicit half; both halves must have the same b.  Where all stages are coupled there is no bound.
   bytes >= rk_size(T->stages + T->extra + more, order ? order : RK_ORDER_MAX); mem must be aligned for a double, hold
   none of T's own arrays, and outlive *out, which points into it and at T's name.  *out may be *T.  On failure *out is
   as it was, mem is not.  RK_LOWER: less than `order` was possible.
   RK_EARG, RK_EMEM, RK_ETABLE, RK_EORDER, RK_LOWER. */
RK_API int rk_extend(rk_table *out, const rk_table *T, const rk_table *other, int order, int more, void *mem,
                     size_t bytes);

/* ---- proof ------------------------------------------------------------------------------------------------------- */
/* Properties of a table, found in its numbers: nonzero if it has it, 0 for any other number. */
enum {
    RK_EXPLICIT = 1, /* a_ij = 0 for j >= i */
    RK_DIAGONAL,     /* a_ij = 0 for j > i: one stage after the other; otherwise all are coupled */
    RK_STIFF,        /* stiffly accurate: the last row of A is b (c_s = 1 is not enough), so ynew is its stage value */
    RK_FSAL          /* that, and the first stage is y itself: the last slope is the next step's first */
};
RK_API int rk_is(const rk_table *T, int property);

/* Whether the table is what it claims: finite, order, order_hat, dense_order, and the dense output ends in b (orders
   above 10 are checked up to 10).  The offending scaled residual goes to *defect unless defect is NULL.  Check a table
   of your own once: microseconds up to order 5, about a millisecond for dop853.
   RK_OK, RK_ROWSUM, RK_EARG, RK_ETABLE, RK_EORDER, RK_EHAT, RK_EDENSE. */
RK_API int rk_check(const rk_table *T, double *defect);

/* The largest |sum b_i Phi_i(tree) - 1/gamma(tree)| / sum |terms| over all rooted trees with `order` vertices, each
   leaf as a slope's argument (A 1) and as time (c): rounding (<= RK_TOLERANCE) if the table has that order, 1 <= order
   <= 10.  A bad argument gives DBL_MAX, here and in the five below. */
RK_API double rk_defect(const rk_table *T, int order);
RK_API double rk_defect_hat(const rk_table *T, int order);   /* of bhat */
RK_API double rk_defect_dense(const rk_table *T, int order); /* of b_i(theta), over all its powers of theta */

/* The same for the two halves of an IMEX method, their slopes coloured; which 0: b, 1: bhat, 2: dense output. */
RK_API double rk_defect_pair(const rk_table *T, const rk_table *other, int which, int order);

/* The same for a general-structure additive (GARK) method of `parts` <= 4 parts: stages of part p take the slopes of
   part c by A[p*parts + c], s[p] rows of s[c] numbers. */
RK_API double rk_defect_gark(int parts, const int *s, const double *const *A, const double *const *b, int order);

/* What keeps an explicit table from order 3 as a multirate infinitesimal-step (MIS) method:
   sum_{i>1} (c_i - c_{i-1}) (Ac_i + Ac_{i-1}) + (1 - c_s)(1/2 + Ac_s) - 1/3. */
RK_API double rk_defect_mis(const rk_table *T);

/* ---- stability --------------------------------------------------------------------------------------------------- */
/* R(z) = 1 + z b' (I - zA)^-1 1, z and R as (re, im); any |z|.  RK_NONFINITE: z is a pole, or R overflows.  RK_EARG
   also for more than 16 stages that are all coupled; so, too, rk_analyse.  RK_EARG, RK_NONFINITE. */
RK_API int rk_stability(const rk_table *T, const double z[2], double R[2]);

typedef struct rk_analysis {
    double real_axis;      /* |R| <= 1 on [-real_axis, 0]; DBL_MAX: to 1e10, in steps of 0.02, 2 per cent beyond 60 */
    double imaginary_axis; /* |R(iy)| <= 1 for |y| <= imaginary_axis, likewise; 0 if violated at once */
    double r_infinity;     /* |R(-inf)|; DBL_MAX if unbounded */
    double ssp;        /* strong stability preserving (contractivity) coefficient; DBL_MAX: no bound (implicit Euler);
                          0 also where all stages are coupled */
    double error_norm; /* sqrt(sum over the trees of order p+1 of (residual/sigma)^2); 0 for p >= 10 */
    double dense_max;  /* max |b_i(theta)| over [0, 1]: what the dense output makes of an error in a slope; 0: none */
    int stage_order;   /* at most T->order */
    int a_stable, l_stable; /* A: |R| <= 1 where Re z <= 0, where all stages are coupled judged along six rays and the
                               axis: a pole between the rays goes unseen; L: also R(-inf) = 0 */
} rk_analysis;
RK_API int rk_analyse(const rk_table *T, rk_analysis *a); /* milliseconds; RK_EARG, RK_ETABLE */

/* ---- step control ------------------------------------------------------------------------------------------------ */
/* sum[0..2] += sums of (v_i/w_i)^2 with w_i = atol + rtol max(|y0_i|, |y1_i|) (y1 may be NULL), sum[3] += n.  Add the
   four numbers of all ranks, in any order, and of blocks with other tolerances; then rk_rms(sum) is the root mean
   square, in units of the tolerance.  No overflow or underflow inside; w_i = 0 counts 0 if v_i = 0 and else as
   infinite; NaN or Inf in v, y0 or y1 gives an infinite rk_rms.  RK_EARG.  rk_rms(NULL) and that of no numbers are
   0. */
RK_API int rk_norm(ptrdiff_t n, const double *v, const double *y0, const double *y1, double rtol, double atol,
                   double sum[4]);
RK_API double rk_rms(const double sum[4]);

/* Step control, Soderlind's form, e_n the error in units of the tolerance, p the order of the error estimate:
      h' = safety h e_n^(-k0/(p+1)) e_{n-1}^(-k1/(p+1)) e_{n-2}^(-k2/(p+1)) (h_n/h_{n-1})^k3 (h_{n-1}/h_{n-2})^k4
   over accepted steps, within the limits below; safety h e_n^(-1/(p+1)) for the first step and for a rejected one.
   A rejected step shrinks to at most 0.9, to at most `again` from the second time on; the step after a rejection does
   not grow; an accepted error below 1e-4 enters the history as 1e-4.  Fill it with rk_control_make, then change what
   you like; it is plain data, so memcpy it to repeat a window. */
typedef struct rk_control {
    double k[5];
    double safety;      /* 0.9 */
    double grow, first; /* largest growth: 10; of the first step: 1e4 */
    double shrink;      /* smallest factor: 0.1 */
    double again;       /* largest factor after a second failure in a row: 0.3 */
    double e[2], h[2];  /* history: the last errors and steps */
    int steps, failures;
} rk_control;

/* method: "I", "PI", "PID" (ARKODE's coefficients), "explicit" and "implicit" (Gustafsson), "H0211", "H0321", "H211",
   "H312" (Soderlind).  RK_EARG. */
RK_API int rk_control_make(rk_control *C, const char *method);

/* After a step of size h from t with that error (in units of the tolerance): the next size in *hnext.  order: that of
   the estimate, T->order_hat.  RK_OK: accepted; RK_REJECT: repeat from t (also for NaN and Inf); RK_ETINY: the next
   step would not move t, C and *hnext untouched; whether this one was good is then error <= 1.  RK_EARG. */
RK_API int rk_control_step(rk_control *C, int order, double error, double t, double h, double *hnext);

/* First step, after Hairer, Norsett & Wanner I, II.4, with d0 taken as at least 1e-4 in place of their absolute limits:
   with norms d0 = |y|, d1 = |f(t,y)| and d2 < 0 a trial size h; then with d2 = |f(t+h, y+hf) - f(t,y)|/h the size to
   start with.  0: d1 and d2 are 0 and tell nothing, take a guess of your own; or a bad argument.  rk_rms of rk_norm is
   the norm. */
RK_API double rk_first_step(int order, double d0, double d1, double d2);

/* Structural dynamics by one parameter, the spectral radius rho in [0, 1] at infinite frequency (HHT: [1/2, 1]); a+,
   v+, u+ are the values at t + h, coef = am, af, gamma, beta:
      M ((1-am) a+ + am a) + C ((1-af) v+ + af v) + K ((1-af) u+ + af u) = f(t + (1-af) h),
      u+ = u + h v + h^2 ((1/2 - beta) a + beta a+),  v+ = v + h ((1-gamma) a + gamma a+).
   beta is (1 - am + af)^2/4: the square is missing in a widely copied code.  Unconditionally stable; order 2, Newmark's
   only for rho = 1.  RK_EARG. */
enum { RK_GENERALIZED_ALPHA = 1, RK_HHT, RK_NEWMARK };
RK_API int rk_newmark(int kind, double rho, double coef[4]);

/* ---- multirate --------------------------------------------------------------------------------------------------- */
/* Multirate couplings: y' = fast(t,y) + slow(t,y), the slow slopes k_j = slow(T_j, z_j) taken `stages` times a step,
   the fast part integrated by any method of yours.  Stage 0 is y, stage `stages - 1` the new y, row `stages` the
   embedded one.  Stage i > 0 in two parts, with from = rk_coupling_from(C, i), c_i = rk_coupling_time(C, i) and d = c_i
   - c_from:
      d != 0: v' = fast(t, v) + sum_p tau^p sum_{j<i} w_pj k_j from v = z_from at t + c_from H to t + c_i H, where
              tau runs from 0 to 1 and rk_coupling_forcing gives w: a few vectors, formed once with rk_combine
      then    z_i = v (or z_from when d = 0) + H sum_{j<=i} g_j k_j,  g = rk_coupling_jump(C, i)
   where g_i != 0 asks for a solve.  Form 1 splits the slow part: the forcing takes explicit and implicit slopes
   together, k_j = (slowE + slowI)(T_j, z_j), the jump the implicit ones alone, slowI(T_j, z_j). */
typedef struct rk_coupling {
    const char *name;
    int form; /* 0: MIS and MRI-GARK, each stage goes on from the one before; 1: IMEX-MRI-SR, each from y; 2: MERK */
    int stages, order, order_hat;
    int powers;                /* of tau in W */
    const double *c;           /* [stages] */
    const double *W;           /* form 0, 1: [powers][stages][stages], one row for each of stage 1, 2, ..., stages */
    const double *G;           /* form 1: [stages][stages], the jumps on the implicit slopes */
    const signed char *groups; /* form 2: stages per group, at most 9, stages - 1 in all, then 0; the forcing
                                  interpolates the slopes of y and of the group before */
} rk_coupling;
RK_API const rk_coupling *rk_coupling_find(const char *name); /* NULL if there is none of that name */
RK_API const rk_coupling *rk_coupling_list(int i);            /* i = 0, 1, ...; NULL at the end */
RK_API int rk_coupling_from(const rk_coupling *C, int i);     /* an index, or RK_EARG */
RK_API double rk_coupling_time(const rk_coupling *C, int i); /* i = 0, too; a bad argument gives DBL_MAX */
/* w_pj at weight[p*stages + j] (room for RK_ORDER_MAX*stages); returns the number of powers, 0 when d = 0.  RK_EARG. */
RK_API int rk_coupling_forcing(const rk_coupling *C, int i, double *weight);
RK_API int rk_coupling_jump(const rk_coupling *C, int i, double *weight); /* weight[stages]; RK_EARG */

/* The largest scaled residual over all coloured trees of that order (<= 6), by the B-series of the exact fast solution:
   one check for all these families.  hat: of the embedded row.  A bad argument gives DBL_MAX. */
RK_API double rk_defect_coupling(const rk_coupling *C, int hat, int order);

/* ---- version and messages ---------------------------------------------------------------------------------------- */
RK_API int rk_version(void);                /* of the implementation linked in */
RK_API const char *rk_message(int status); /* one clear sentence, never NULL */

#ifdef __cplusplus
}
#endif
#elif RK_VERSION != 100
#error "two different versions of rk.h in one translation unit"
#endif /* RK_H_INCLUDED_TABLES */

/* ---- implementation ---------------------------------------------------------------------------------------------- */
#if defined(RK_IMPLEMENTATION) && !defined(RK_IMPLEMENTATION_INCLUDED)
#define RK_IMPLEMENTATION_INCLUDED

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the tables --------------------------------------------------------------------------------------------------
   Row by row: c; the rows of A; b; and for a pair bhat and b - bhat.  Zeros at the end of a row are left out. */

/* clang-format off */

#define RK__ROOT2(a, b, c) ((double)(((a) + (b) * 1.41421356237309504880168872421L) / (c))) /* (a + b sqrt 2) / c */

/* Euler 1768 */
static const double rk__euler[][1] = {
    {0},
    {0},
    {1},
};
static const double rk__euler_d[][1] = {{1}};

/* Heun 1900; the two-stage SSP method */
static const double rk__heun[][2] = {
    {0, 1},
    {0},
    {1},
    {1. / 2, 1. / 2},
    {1},
    {-1. / 2, 1. / 2},
};
static const double rk__heun_d[][2] = {{1, -1. / 2}, {0, 1. / 2}};

/* Runge 1895 */
static const double rk__midpoint[][2] = {
    {0, 1. / 2},
    {0},
    {1. / 2},
    {0, 1},
    {1},
    {-1, 1},
};
static const double rk__midpoint_d[][2] = {{1, -1}, {0, 1}};

/* Kutta 1901 */
static const double rk__kutta3[][3] = {
    {0, 1. / 2, 1},
    {0},
    {1. / 2},
    {-1, 2},
    {1. / 6, 2. / 3, 1. / 6},
};
static const double rk__kutta3_d[][2] = {{46. / 51, -25. / 34}, {10. / 51, 8. / 17}, {-5. / 51, 9. / 34}};

/* Shu & Osher 1988; pair: Fekete, Conde & Shadid 2022 */
static const double rk__ssp33[][3] = {
    {0, 1, 1. / 2},
    {0},
    {1},
    {1. / 4, 1. / 4},
    {1. / 6, 1. / 6, 2. / 3},
    {1. / 3, 1. / 3, 1. / 3},
    {-1. / 6, -1. / 6, 1. / 3},
};
static const double rk__ssp33_d[][2] = {{16. / 15, -9. / 10}, {1. / 15, 1. / 10}, {-2. / 15, 4. / 5}};

/* Kraaijevanger 1991; pair: Fekete, Conde & Shadid 2022 */
static const double rk__ssp43[][4] = {
    {0, 1. / 2, 1, 1. / 2},
    {0},
    {1. / 2},
    {1. / 2, 1. / 2},
    {1. / 6, 1. / 6, 1. / 6},
    {1. / 6, 1. / 6, 1. / 6, 1. / 2},
    {1. / 4, 1. / 4, 1. / 4, 1. / 4},
    {-1. / 12, -1. / 12, -1. / 12, 1. / 4},
};
static const double rk__ssp43_d[][3] = {{1, -3. / 2, 2. / 3}, {0, 3. / 2, -4. / 3}, {0, -1. / 2, 2. / 3}, {0, 1. / 2}};

/* Ketcheson 2008; pair: Fekete, Conde & Shadid 2022 */
static const double rk__ssp104[][10] = {
    {0, 1. / 6, 1. / 3, 1. / 2, 2. / 3, 1. / 3, 1. / 2, 2. / 3, 5. / 6, 1},
    {0},
    {1. / 6},
    {1. / 6, 1. / 6},
    {1. / 6, 1. / 6, 1. / 6},
    {1. / 6, 1. / 6, 1. / 6, 1. / 6},
    {1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 15},
    {1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 6},
    {1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 6, 1. / 6},
    {1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 6, 1. / 6, 1. / 6},
    {1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 15, 1. / 6, 1. / 6, 1. / 6, 1. / 6},
    {1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10, 1. / 10},
    {1. / 5, 0, 0, 3. / 10, 0, 0, 1. / 5, 0, 3. / 10},
    {-1. / 10, 1. / 10, 1. / 10, -1. / 5, 1. / 10, 1. / 10, -1. / 10, 1. / 10, -1. / 5, 1. / 10},
};
static const double rk__ssp104_d[][3] = {
    {41. / 65, -1041. / 910, 279. / 455},
    {751. / 1820, -0.33489010989010989011, 0.022252747252747252747},
    {137. / 910, 513. / 1820, -121. / 364},
    {-113. / 1820, 0.51675824175824175824, -0.35467032967032967033},
    {-12. / 91, 82. / 455, 47. / 910},
    {99. / 455, -21. / 65, 187. / 910},
    {-21. / 260, 0.55467032967032967033, -0.3739010989010989011},
    {-43. / 182, 1567. / 1820, -191. / 364},
    {-283. / 1820, 0.40631868131868131868, -0.15082417582417582418},
    {116. / 455, -909. / 910, 384. / 455},
};

/* Bogacki & Shampine 1989; dense output: the cubic through both ends and slopes */
static const double rk__bs3[][4] = {
    {0, 1. / 2, 3. / 4, 1},
    {0},
    {1. / 2},
    {0, 3. / 4},
    {2. / 9, 1. / 3, 4. / 9},
    {7. / 24, 1. / 4, 1. / 3, 1. / 8},
    {-5. / 72, 1. / 12, 1. / 9, -1. / 8},
};
static const double rk__bs3_d[][3] = {{1, -4. / 3, 5. / 9}, {0, 1, -2. / 3}, {0, 4. / 3, -8. / 9}, {0, -1, 1}};

/* Kutta 1901; dense output: Zennaro 1986 */
static const double rk__rk4[][4] = {
    {0, 1. / 2, 1. / 2, 1},
    {0},
    {1. / 2},
    {0, 1. / 2},
    {0, 0, 1},
    {1. / 6, 1. / 3, 1. / 3, 1. / 6},
};
static const double rk__rk4_d[][3] = {{1, -3. / 2, 2. / 3}, {0, 1, -2. / 3}, {0, 1, -2. / 3}, {0, -1. / 2, 2. / 3}};

/* Sofroniou & Spaletta 2004 */
static const double rk__ss4[][5] = {
    {0, 2. / 5, 3. / 5, 1, 1},
    {0},
    {2. / 5},
    {-3. / 20, 3. / 4},
    {19. / 44, -15. / 44, 10. / 11},
    {11. / 72, 25. / 72, 25. / 72, 11. / 72},
    {1251515. / 8970912, 3710105. / 8970912, 2519695. / 8970912, 61105. / 8970912, 119041. / 747576},
    {119041. / 8970912, -595205. / 8970912, 595205. / 8970912, 1309451. / 8970912, -119041. / 747576},
};
static const double rk__ss4_d[][3] = {
    {0.99337491846053489889, -1.5350415851272015656, 25. / 36},
    {0.033125407697325505545, 1.0085412589693411611, -25. / 36},
    {-0.033125407697325505545, 1.0747920743639921722, -25. / 36},
    {-0.072875896934116112198, 0.53120923026744944553, -11. / 36},
    {0.079500978473581213307, -1.0795009784735812133, 1},
};

/* Dormand & Prince 1980; dense output: Shampine 1986 */
static const double rk__dp5[][7] = {
    {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
    {0},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
    {5179. / 57600, 0, 7571. / 16695, 393. / 640, -92097. / 339200, 187. / 2100, 1. / 40},
    {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40},
};
static const double rk__dp5_d[][4] = {
    {1, -8048581381. / 2820520608, 8663915743. / 2820520608, -12715105075. / 11282082432},
    {0},
    {0, 131558114200. / 32700410799, -68118460800. / 10900136933, 87487479700. / 32700410799},
    {0, -1754552775. / 470086768, 14199869525. / 1410260304, -10690763975. / 1880347072},
    {0, 127303824393. / 49829197408, -318862633887. / 49829197408, 701980252875. / 199316789632},
    {0, -282668133. / 205662961, 2019193451. / 616988883, -1453857185. / 822651844},
    {0, 40617522. / 29380423, -110615467. / 29380423, 69997945. / 29380423},
};

/* Tsitouras 2011, with bhat_7 = 1/66 (his table prints a wrong sign, his program 1/40); his dense output */
static const double rk__tsit5[][7] = {
    {0, 161. / 1000, 327. / 1000, 9. / 10, 0.98002554090450968573, 1, 1},
    {0},
    {161. / 1000},
    {-0.0084806554923569885444, 0.33548065549235698854},
    {2.8971530571054934321, -6.3594484899750748431, 4.362295432869581411},
    {5.3258648284392566044, -11.748883564062827878, 7.4955393428898362083, -0.092495066361755249257},
    {5.8614554429464200287, -12.920969317847109292, 8.1593678985761586432, -0.071584973281400997225,
     -0.028269050394068382909},
    {0.096460766818065229518, 1. / 100, 0.47988965041449957478, 1.3790085741037418932, -3.2900695154360806799,
     2.3247105240997739824},
    {0.094680755765839458075, 0.0091835655403432530968, 0.48777052842476157079, 1.2342975669304789857,
     -2.7077123499835254549, 1.8666284181705870358, 1. / 66},
    {0.0017800110522257714434, 0.00081643445965674690322, -0.0078808780102619960103, 0.14471100717326290754,
     -0.58235716545255522502, 0.45808210592918694666, -1. / 66},
};
static const double rk__tsit5_d[][4] = {
    {1, -2.7637061972748258687, 2.9132554618219126554, -1.0530884977290215572},
    {0, 0.1317, -0.2234, 0.1017},
    {0, 3.9302962368947515174, -5.9410338721315047357, 2.4906272856512527931},
    {0, -12.411077166933677039, 30.33818863028232165, -16.548102889244902718},
    {0, 37.509313416511039179, -88.178904894766401078, 47.379521962819281219},
    {0, -27.896526289197287789, 65.091894674793671508, -34.870657861496609736},
    {0, 3. / 2, -4, 5. / 2},
};

/* Verner 2010, 6(5) "robust"; one more stage, at 1/2, gives dense output of order 5 */
static const double rk__verner6[][10] = {
    {0, 9. / 50, 1. / 6, 1. / 4, 53. / 100, 3. / 5, 4. / 5, 1, 1, 1. / 2},
    {0},
    {9. / 50},
    {29. / 324, 25. / 324},
    {1. / 16, 0, 3. / 16},
    {79129. / 250000, 0, -261237. / 250000, 19663. / 15625},
    {1336883. / 4909125, 0, -25476. / 30875, 194159. / 185250, 8225. / 78546},
    {-2459386. / 14727375, 0, 19504. / 30875, 2377474. / 13615875, -6157250. / 5773131, 902. / 735},
    {2699. / 7410, 0, -252. / 1235, -1393253. / 3993990, 236875. / 72618, -135. / 49, 15. / 22},
    {11. / 144, 0, 0, 256. / 693, 0, 125. / 504, 125. / 528, 5. / 72},
    {0.079319780297094873522, 0, 0, 0.35307683922702282027, 0.03670345536339536565, 0.036362222027862282335,
     -0.0046146127465136175701, -0.024847397784904400907, 0.0239997136160426767},
    {11. / 144, 0, 0, 256. / 693, 0, 125. / 504, 125. / 528, 5. / 72},
    {28. / 477, 0, 0, 212. / 441, -312500. / 366177, 2125. / 1764, 0, -2105. / 35532, 2995. / 17766},
    {15. / 848, 0, 0, -60. / 539, 312500. / 366177, -375. / 392, 125. / 528, 9145. / 71064, -2995. / 17766},
};
static const double rk__verner6_d[][5] = {
    {0.97194774791619525595, -4.0407098621124696988, 7.609746450614771108, -6.6312621141962744429, 13. / 6},
    {0},
    {0},
    {0.17653662164798829649, 7.2568111050442125265, -22.254862841551789813, 24.0567243500688242, -2048. / 231},
    {-1.3534159349546361773, 8.0872037063185041007, -13.467575542727735847, 6.7337877713638679234},
    {1.517111592287399423, -6.0891605184072509812, 4.1837803919222427991, 6.588665359594434156, -125. / 21},
    {-0.37544680819233622083, 3.6638999936125688455, -11.311754855688950098, 13.941862276329323534, -125. / 22},
    {-0.20408279186819621552, 1.2194766355012839609, -3.4196765761550643797, 4.1403938436330877454, -5. / 3},
    {0.26734957316358563826, -2.0975210599568487536, 6.6603429735865262307, -8.8301714867932631153, 4},
    {0, -8, 32, -40, 16},
};

/* Hairer, Norsett & Wanner 1993, 8(5) with its dense output: slope 13 is that of ynew, 14 to 16 are more stages */
static const double rk__dop853[][16] = {
    {0, 0.052600151958767731879, 0.078900227938151597818, 0.11835034190722739673, 0.28164965809277260327,
     0.33333333333333333333, 1. / 4, 0.30769230769230769231, 0.65128205128205128205, 3. / 5, 0.85714285714285714286, 1,
     1, 1. / 10, 1. / 5, 0.77777777777777777778},
    {0},
    {0.052600151958767731879},
    {0.019725056984537899454, 0.059175170953613698363},
    {0.029587585476806849182, 0, 0.088762756430420547545},
    {0.2413651341592666855, 0, -0.88454947932828608534, 0.92483400326179200312},
    {0.037037037037037037037, 0, 0, 0.17082860872947387128, 0.12546768756682242502},
    {19. / 512, 0, 0, 0.17025221101954403931, 0.060216538980455960685, -9. / 512},
    {0.037092000118504792711, 0, 0, 0.17038392571223999381, 0.10726203044637328465, -0.015319437748624401753,
     0.0082737891638140228876},
    {0.62411095871607571711, 0, 0, -3.3608926294469412941, -0.86821934684172600682, 27.592099699446708305,
     20.154067550477893409, -43.489884181069958848},
    {0.47766253643826436589, 0, 0, -2.4881146199716676419, -0.59029082683684299637, 21.230051448181194235,
     15.279233632882423583, -33.288210968984862919, -0.020331201708508626136},
    {-0.93714243008598732572, 0, 0, 5.1863724288440637083, 1.0914373489967295782, -8.1497870107469261251,
     -18.520065659996959864, 22.739487099350504282, 2.4936055526796523899, -3.0467644718982195004},
    {2.2733101475165382079, 0, 0, -10.534495466737250198, -2.0008720582248624991, -17.958931863118798917,
     27.948884529419960051, -2.8589982771350236947, -8.8728569335306295443, 12.360567175794303065,
     0.64339274601576353036},
    {0.054293734116568762238, 0, 0, 0, 0, 4.4503128927524088814, 1.891517899314500383, -5.8012039600105847815,
     0.31116436695781989441, -0.15216094966251607856, 0.20136540080403034837, 0.044710615727772590518},
    {0.056167502283047952339, 0, 0, 0, 0, 0, 0.25350021021662481109, -0.24623903747080248992, -0.12419142326381636047,
     0.15329179827876569731, 0.0082010522956346898849, 0.0075678976605456997614, -4149. / 500000},
    {0.031834648163502140506, 0, 0, 0, 0, 0.028300909672366775529, 0.053541988307438567622, -0.054923748571390988465, 0,
     0, -0.00010834732869724932286, 0.00038257109083565841295, -0.0003404650086874045608, 0.14131244367463250028},
    {-0.42889630158379192341, 0, 0, 0, 0, -4.6976214153611638431, 7.6834211960625990418, 4.0689898183971100797,
     0.35672718745528110927, 0, 0, 0, -0.0013990241651590146213, 2.947514789152772339, -9.1509584721798700108},
    {0.041173689122373881506, 0, 0, 0, 0, 5.6754693391286133222, 2.3872768489717505746, -7.4655811424655713184,
     0.6614932157077935761, -0.48634006837553355759, 0.11944219431891463591, 0.067065923591658885777},
    {0.013120044994194880733, 0, 0, 0, 0, -1.2251564463762044407, -0.49575894965725019152, 1.664377182454986537,
     -0.35032884874997368169, 0.33417911871301747903, 0.081923206485115712466, -0.022355307863886295259},
};
static const double rk__dop853_d[][7] = {
    {1, -10.266057073759306578, 48.16185096856645663, -114.93304874997833254, 147.46446875669768308,
     -97.066853630113680831, 25.693933462703749003},
    {0},
    {0},
    {0},
    {0},
    {0, 13.917653631776604414, -154.78787266663715597, 522.92190896082187491, -456.25918840208781255,
     -75.531937321357535671, 154.18974869023643374},
    {0, 2.6056037519936094578, -21.622822384626504227, 2.5351820289667551482, 292.25417465990406253,
     -505.4099993329689182, 231.52937917604549568},
    {0, -15.018944223519684516, 160.09447708973047612, -474.30718260376434781, 135.96036916173837287,
     545.10919452641872234, -357.63911791061412378},
    {0, 3.0505276833184879599, -38.543967291890632505, 174.47140009219884073, -337.05134702387712643,
     291.78987509083256014, -93.405324183624310004},
    {0, -1.3278744327655212277, 16.661770430049541997, -74.440278141263033878, 140.75210016191606336,
     -119.25620210405119949, 37.458323136451633157},
    {0, 2.844533632672879321, -36.558295489910119271, 170.69007169147513661, -345.97484854804955106,
     313.29955362357798519, -104.09964950896230045},
    {0, 0.76571062595278658971, -9.9069955356193663694, 46.802991918874394725, -96.51986946699570428,
     88.743166500176165049, -29.840293426660503123},
    {0, -1.0889903364513333108, 14.097013042320002101, -66.682305912943639618, 137.96299063474374993,
     -127.82216401767992286, 43.533456590011143754},
    {0, 18.148505520854727257, -127.63310949253875295, 357.34195161296572783, -500.7031507909223888,
     349.1703571088289696, -96.324553959188282948},
    {0, -9.1946323924783554, 93.356745932789393432, -282.62726187043632085, 361.14007718803332216,
     -201.85219053352347851, 39.177261675615439165},
    {0, -4.4360363875948939664, 56.681205397766661013, -261.77342902691705527, 520.97422366889932918,
     -461.17279991013966677, 149.72683625798562581},
};

/* Implicit: dense output derived so that it stays bounded for stiff parts, see rk_extend */

/* backward Euler */
static const double rk__beuler[][1] = {
    {1},
    {1},
    {1},
};
static const double rk__beuler_d[][1] = {{1}};

/* implicit midpoint rule */
static const double rk__imidpoint[][1] = {
    {1. / 2},
    {1. / 2},
    {1},
};
static const double rk__imidpoint_d[][1] = {{1}};

/* trapezoidal rule */
static const double rk__trapezoid[][2] = {
    {0, 1},
    {0},
    {1. / 2, 1. / 2},
};
static const double rk__trapezoid_d[][1] = {{1. / 2}, {1. / 2}};

/* Alexander 1977; pair: Ellsiepen 1999 */
static const double rk__sdirk2[][2] = {
    {RK__ROOT2(2, -1, 2), 1},
    {RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(0, 1, 2), RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(-4, 5, 4), RK__ROOT2(8, -5, 4)},
    {RK__ROOT2(4, -3, 4), RK__ROOT2(-4, 3, 4)},
};
static const double rk__sdirk2_d[][2] = {
    {1.4142135623730950488, -0.7071067811865475244},
    {-0.4142135623730950488, 0.7071067811865475244},
};

/* Bank et al. 1985; pair: Giraldo, Kelly & Constantinescu 2013 (bounded, as that of Hosea & Shampine is not) */
static const double rk__trbdf2[][3] = {
    {0, RK__ROOT2(2, -1, 1), 1},
    {0},
    {RK__ROOT2(2, -1, 2), RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(0, 1, 4), RK__ROOT2(0, 1, 4), RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(4, -1, 8), RK__ROOT2(4, -1, 8), RK__ROOT2(0, 1, 4)},
    {RK__ROOT2(-4, 3, 8), RK__ROOT2(-4, 3, 8), RK__ROOT2(4, -3, 4)},
};
static const double rk__trbdf2_d[][2] = {
    {0.7071067811865475244, -0.3535533905932737622},
    {0.7071067811865475244, -0.3535533905932737622},
    {-0.4142135623730950488, 0.7071067811865475244},
};

/* ESDIRK3(2)5L[2]SA, Kennedy & Carpenter 2016 (NASA/TM-2016-219173) */
static const double rk__esdirk3[][5] = {
    {0, 9. / 20, RK__ROOT2(18, 9, 40), 3. / 5, 1},
    {0},
    {9. / 40, 9. / 40},
    {RK__ROOT2(9, 9, 80), RK__ROOT2(9, 9, 80), 9. / 40},
    {RK__ROOT2(8, 7, 80), RK__ROOT2(8, 7, 80), RK__ROOT2(7, -7, 40), 9. / 40},
    {RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(2374, -2374, 2835), 5827. / 7560, 9. / 40},
    {RK__ROOT2(-4800247, 5547709, 16519545), RK__ROOT2(-4800247, 5547709, 16519545),
     RK__ROOT2(11095418, -11095418, 16519545), 30698249. / 44052120, 49563. / 233080},
    {RK__ROOT2(-416288, 273788, 3303909), RK__ROOT2(-416288, 273788, 3303909), RK__ROOT2(547576, -547576, 3303909),
     81392. / 1101303, 72. / 5827},
};
static const double rk__esdirk3_d[][3] = {
    {1.0032396041371858965, -1.5998124905429866429, 0.77211838853520597492},
    {1.0032396041371858965, -1.5998124905429866429, 0.77211838853520597492},
    {2.1727107781704612693, -7.4860793858855866685, 4.9665104076891191749},
    {-2.6466499456143666207, 9.28749287090366586, -5.8700757295221034721},
    {-0.53254004083046644165, 1.3982114960678940943, -0.64067145523742765264},
};

/* ESDIRK4(3)6L[2]SA, Kennedy & Carpenter 2016 */
static const double rk__esdirk4[][6] = {
    {0, 1. / 2, RK__ROOT2(2, -1, 4), 5. / 8, 26. / 25, 1},
    {0},
    {1. / 4, 1. / 4},
    {RK__ROOT2(1, -1, 8), RK__ROOT2(1, -1, 8), 1. / 4},
    {RK__ROOT2(5, -7, 64), RK__ROOT2(5, -7, 64), RK__ROOT2(7, 7, 32), 1. / 4},
    {RK__ROOT2(-13796, -54539, 125000), RK__ROOT2(-13796, -54539, 125000), RK__ROOT2(506605, 132109, 437500),
     RK__ROOT2(-16102, 62416, 109375), 1. / 4},
    {RK__ROOT2(1181, -987, 13782), RK__ROOT2(1181, -987, 13782), RK__ROOT2(-12549, 83801, 273343),
     RK__ROOT2(366752, -56400, 571953), RK__ROOT2(-1515625, -5875000, 90749876), 1. / 4},
    {-480923228411. / 4982971448372, -480923228411. / 4982971448372, 6709447293961. / 12833189095359,
     3513175791894. / 6748737351361, -498863281070. / 6042575550617, 2077005547802. / 8945017530137},
    {0.08092570713246383693, 0.08092570713246383693, -0.13516228008303090893, -0.018795245050025329255,
     -0.025696966006312281908, 0.017803076874440846229},
};
static const double rk__esdirk4_d[][3] = {
    {0.76152222777249253204, -2.4420867112844707413, 1.6649768484762617085},
    {0.76152222777249253204, -2.4420867112844707413, 1.6649768484762617085},
    {0.20053603772649800934, 2.2667497853763300312, -2.0796281521896247092},
    {-0.71031040771887373877, 2.893453310347143095, -1.6813702830561061903},
    {1.177128842543854607, -3.5823277652996338594, 2.2969439023418457566},
    {-1.1903989280964639417, 3.306298092145102216, -1.8658991640486382743},
};

/* ESDIRK4(3)7L[2]SA, Kennedy & Carpenter 2019 */
static const double rk__esdirk4b[][7] = {
    {0, 1. / 4, 1200237871921. / 16391473681546, 1. / 2, 395. / 567, 89. / 126, 1},
    {0},
    {1. / 8, 1. / 8},
    {-0.02588834764831844055, -39188347878. / 1513744654945, 1. / 8},
    {0.33838834764831844055, 1748874742213. / 5168247530883, -1748874742213. / 5795261096931, 1. / 8},
    {-0.35924536183815939261, -6429340993097. / 17896796106705, 9711656375562. / 10370074603625,
     1137589605079. / 3216875020685, 1. / 8},
    {0.23361061091244562876, 405169606099. / 1734380148729, -264468840649. / 6105657584947,
     118647369377. / 6233854714037, 683008737625. / 4934655825458, 1. / 8},
    {-0.40085161500960824424, -5649241495537. / 14093099002237, 5718691255176. / 6089204655961,
     2199600963556. / 4241893152925, 8860614275765. / 11425531467341, -3696041814078. / 6641566663007, 1. / 8},
    {-0.24210689376668585609, -1517409284625. / 6267517876163, 8291371032348. / 12587291883523,
     5328310281212. / 10646448185159, 5405006853541. / 7104492075037, -4254786582061. / 7445269677723, 19. / 140},
    {-0.15874472124292238815, -0.15874472124292238815, 0.28044273264217214518, 0.018064548170862165323,
     0.014722801151415503257, 0.014973646235680676816, -3. / 280},
};
static const double rk__esdirk4b_d[][4] = {
    {3.4544540840242976565, 52.70329963203942187, -165.48800926630967616, 108.92940393523634838},
    {3.4544540840242976565, 52.70329963203942187, -165.48800926630967616, 108.92940393523634838},
    {-4.6385928661751467937, -95.48442619668626856, 292.94086724809107789, -191.87869577070575383},
    {-1.9244618938749695348, -0.48038159548902357292, 18.380846124044847333, -15.457460350785923062},
    {1.4599473291506628825, -14.215726288293981814, 27.739224433048816694, -14.20793544173829555},
    {-0.7730282912401607654, 1.0710400598108279499, 1.7302989134938112689, -2.5848121826313040505},
    {-0.032772445908981101585, 3.7028947565796022578, -9.8152181860592008751, 6.2700958753885797189},
};

/* ESDIRK5(4)7L[2]SA2, Kennedy & Carpenter 2019 */
static const double rk__esdirk5[][7] = {
    {0, 46. / 125, 7121331996143. / 11335814405378, 49. / 353, 3706679970760. / 5295570149437, 347. / 382, 1},
    {0},
    {23. / 125, 23. / 125},
    {0.22210764773832474449, 791020047304. / 3561426431547, 23. / 125},
    {-0.014049475381926281932, -158159076358. / 11257294102345, -85517644447. / 5003708988389, 23. / 125},
    {-0.40838859254931465027, -1653327111580. / 4048416487981, 1514767744496. / 9099671765375,
     14283835447591. / 12247432691556, 23. / 125},
    {-0.53929072355881132945, -4540011970825. / 8418487046959, -1790937573418. / 7393406387169,
     10819093665085. / 7266595846747, 4109463131231. / 7386972500302, 23. / 125},
    {-0.039466069109740259325, -188593204321. / 4778616380481, 2809310203510. / 10304234040467,
     1021729336898. / 2364210264653, 870612361811. / 2470410392208, -1307970675534. / 8059683598661, 23. / 125},
    {-0.080689466566647432665, -582099335757. / 7214068459310, 615023338567. / 3362626566945,
     3192122436311. / 6174152374399, 6156034052041. / 14430468657929, -1011318518279. / 9693750372484,
     1914490192573. / 13754262428401},
    {0.04122339745690717334, 0.04122339745690717334, 0.089736805636807138518, -0.084848701245942788984,
     -0.074183645069565183716, -0.057958752816804540347, 0.04480749858169102785},
};
static const double rk__esdirk5_d[][4] = {
    {2.9586402196609611407, -16.397380377367352143, 25.910407275959555027, -12.511133187362904284},
    {2.9586402196609611407, -16.397380377367352143, 25.910407275959555027, -12.511133187362904284},
    {1.5478639465335888018, -11.178765744013963701, 23.483457376769090357, -13.579919089038472776},
    {-4.281673851455550767, 30.240373317795750523, -50.331165235919871405, 24.804630942099959862},
    {-1.81003414303641016, 10.61179965171222623, -18.251846087652863387, 9.8024966652099364528},
    {-1.8942177268815032667, 12.987331783310698554, -23.963183379182609154, 12.707783711969474354},
    {1.5207813355179531104, -9.8659782540700073205, 17.241922774067143535, -8.7127258555150893253},
};

/* Hairer & Wanner 1996, table IV.6.5 */
static const double rk__sdirk4[][5] = {
    {1. / 4, 3. / 4, 11. / 20, 1. / 2, 1},
    {1. / 4},
    {1. / 2, 1. / 4},
    {17. / 50, -1. / 25, 1. / 4},
    {371. / 1360, -137. / 2720, 15. / 544, 1. / 4},
    {25. / 24, -49. / 48, 125. / 16, -85. / 12, 1. / 4},
    {59. / 48, -17. / 96, 225. / 32, -85. / 12},
    {-3. / 16, -27. / 32, 25. / 32, 0, 1. / 4},
};
static const double rk__sdirk4_d[][3] = {
    {3.0308134261251618709, -3.3487346316527058805, 1.3595878721942106763},
    {2.638660417563228419, -10.194305842437176462, 6.5348120915406147099},
    {-4.295055942188174462, 33.744727631886274502, -21.63717168969810004},
    {0, -85. / 4, 85. / 6},
    {-0.37441790150021582785, 1.0483128422036078407, -0.42389494070339201282},
};

/* Weak stage order 3: Ketcheson, Seibold, Shirokoff & Zhou 2020; the 11 printed digits polished on the order conditions */
static const double rk__wso3[][4] = {
    {0.13756543551053851713, 0.80179011575714544682, 2.3317967300217857299, 1},
    {0.13756543551053851713},
    {0.56695122794022445583, 0.23483888781692099099},
    {-1.0835407281283739904, 2.9661822386413242719, 0.44915521950883544849},
    {0.59761291500366268702, -0.43420997583977202636, -0.053058153223335053206, 0.88965521405944439254},
};
static const double rk__wso3_d[][3] = {
    {1.0394642397676125645, -0.28608973452423706798, -0.15576159023971280952},
    {1.2027023606484343396, -3.7080346488161847582, 2.0711223123279783923},
    {0.10125973549047396593, -0.36169393065095309148, 0.20737604193714407234},
    {-1.34342633590652087, 4.3558183139913749176, -2.1227367640254096551},
};

/* IMEX pairs: NAMEe for the explicit, NAMEi for the implicit part */

/* ARS(2,2,2), Ascher, Ruuth & Spiteri 1997 */
static const double rk__ars222e[][3] = {
    {0, RK__ROOT2(2, -1, 2), 1},
    {0},
    {RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(0, -1, 2), RK__ROOT2(2, 1, 2)},
};
static const double rk__ars222i[][3] = {
    {0, RK__ROOT2(2, -1, 2), 1},
    {0},
    {0, RK__ROOT2(2, -1, 2)},
    {0, RK__ROOT2(0, 1, 2), RK__ROOT2(2, -1, 2)},
};
static const double rk__ars222e_d[][2] = {
    {1.4794322297131357546, -2.186539010899683279},
    {-0.67801956149908974484, 2.3851263426856372692},
    {0.19858733178595399024, -0.19858733178595399024},
};
static const double rk__ars222i_d[][2] = {
    {0},
    {1.4142135623730950488, -0.7071067811865475244},
    {-0.4142135623730950488, 0.7071067811865475244},
};

/* ARS(4,4,3), Ascher, Ruuth & Spiteri 1997 */
static const double rk__ars443e[][5] = {
    {0, 1. / 2, 2. / 3, 1. / 2, 1},
    {0},
    {1. / 2},
    {11. / 18, 1. / 18},
    {5. / 6, -5. / 6, 1. / 2},
    {1. / 4, 7. / 4, 3. / 4, -7. / 4},
};
static const double rk__ars443i[][5] = {
    {0, 1. / 2, 2. / 3, 1. / 2, 1},
    {0},
    {0, 1. / 2},
    {0, 1. / 6, 1. / 2},
    {0, -1. / 2, 1. / 2, 1. / 2},
    {0, 3. / 2, -3. / 2, 1. / 2, 1. / 2},
};
static const double rk__ars443e_d[][3] = {
    {1.2250089022692693665, -2.6517594121265093393, 1.6767505098572399728},
    {0.22500890226926936648, 3.8482405878734906607, -2.3232494901427600272},
    {2.0250801204234242983, -10.365834709138584054, 9.0907545887151597553},
    {-2.0250801204234242983, 7.3658347091385840536, -7.0907545887151597553},
    {-0.45001780453853873296, 1.8035188242530186786, -1991. / 1471},
};
static const double rk__ars443i_d[][3] = {{0}, {-1, 13. / 2, -4}, {-9, 27. / 2, -6}, {9, -33. / 2, 8}, {2, -7. / 2, 2}};

/* Giraldo, Kelly & Constantinescu 2013 */
static const double rk__ark2e[][3] = {
    {0},
    {RK__ROOT2(2, -1, 1)},
    {RK__ROOT2(3, -2, 6), RK__ROOT2(3, 2, 6)},
};
static const double rk__ark2i[][3] = {
    {0, RK__ROOT2(2, -1, 1), 1},
    {0},
    {RK__ROOT2(2, -1, 2), RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(0, 1, 4), RK__ROOT2(0, 1, 4), RK__ROOT2(2, -1, 2)},
    {RK__ROOT2(4, -1, 8), RK__ROOT2(4, -1, 8), RK__ROOT2(0, 1, 4)},
    {RK__ROOT2(-4, 3, 8), RK__ROOT2(-4, 3, 8), RK__ROOT2(4, -3, 4)},
};
static const double rk__ark2i_d[][2] = {
    {0.7071067811865475244, -0.3535533905932737622},
    {0.7071067811865475244, -0.3535533905932737622},
    {-0.4142135623730950488, 0.7071067811865475244},
};

/* ARK3(2)4L[2]SA, Kennedy & Carpenter 2003 */
static const double rk__ark3e[][4] = {
    {0},
    {0.87173304301691799883},
    {0.52758901197630041156, 0.072410988023699588438},
    {0.39909600767607013206, -0.43755765461351944372, 1.0384616469374493117},
};
static const double rk__ark3i[][4] = {
    {0, 0.87173304301691799883, 3. / 5, 1},
    {0},
    {0.43586652150845899942, 0.43586652150845899942},
    {0.2576482460664272458, -0.093514767574886245216, 0.43586652150845899942},
    {0.18764102434672382516, -0.59529747357695494805, 0.97178992772177212347, 0.43586652150845899942},
    {0.21474028622338914049, -0.48516226388493909282, 0.86872500252038755117, 0.40169697514116240117},
    {-0.027099261876665315325, -0.11013520969201585523, 0.1030649252013845723, 0.034169546367296598248},
};
static const double rk__ark3i_d[][2] = {
    {0.65553336166480366353, -0.46789233731807983837},
    {-0.051614215463176512051, -0.543683258113778436},
    {0.87771759172431780997, 0.094072335997454313501},
    {-0.48163673792594496145, 0.91750325943440396086},
};

/* ARK4(3)7L[2]SA, Kennedy & Carpenter 2019 */
static const double rk__ark4e[][7] = {
    {0},
    {247. / 1000},
    {247. / 4000, 2694949928731. / 7487940209513},
    {464650059369. / 8764239774964, 878889893998. / 2444806327765, -952945855348. / 12294611323341},
    {476636172619. / 8159180917465, -1271469283451. / 7793814740893, -859560642026. / 4356155882851,
     1723805262919. / 4571918432560},
    {6338158500785. / 11769362343261, -4970555480458. / 10924838743837, 3326578051521. / 2647936831840,
     -880713585975. / 1841400956686, -1428733748635. / 8843423958496},
    {760814592956. / 3276306540349, 760814592956. / 3276306540349, -47223648122716. / 6934462133451,
     71187472546993. / 9669769126921, -13330509492149. / 9695768672337, 11565764226357. / 8513123442827},
};
static const double rk__ark4i[][7] = {
    {0, 247. / 1000, 4276536705230. / 10142255878289, 67. / 200, 3. / 40, 7. / 10, 1},
    {0},
    {247. / 2000, 247. / 2000},
    {624185399699. / 4186980696204, 624185399699. / 4186980696204, 247. / 2000},
    {1258591069120. / 10082082980243, 1258591069120. / 10082082980243, -322722984531. / 8455138723562, 247. / 2000},
    {-436103496990. / 5971407786587, -436103496990. / 5971407786587, -2689175662187. / 11046760208243,
     4431412449334. / 12995360898505, 247. / 2000},
    {-2207373168298. / 14430576638973, -2207373168298. / 14430576638973, 242511121179. / 3358618340039,
     3145666661981. / 7780404714551, 5882073923981. / 14490790706663, 247. / 2000},
    {0, 0, 9164257142617. / 17756377923965, -10812980402763. / 74029279521829, 1335994250573. / 5691609445217,
     2273837961795. / 8368240463276, 247. / 2000},
    {0, 0, 4469248916618. / 8635866897933, -621260224600. / 4094290005349, 696572312987. / 2942599194819,
     1532940081127. / 5565293938103, 2441. / 20000},
    {0, 0, -0.0014110178419245221818, 0.0056746431225685763313, -0.0019895928121480497637, -0.0037240324684960043858,
     29. / 20000},
};
static const double rk__ark4i_d[][3] = {
    {0},
    {0},
    {-5.4400152284585431241, 15.81827538042144982, -9.8621494236454829945},
    {5.158985108924948253, -13.221722645083000897, 7.9166739722194818454},
    {0.55959211549034742911, -0.32375245307529901077, -0.0011091765248551068429},
    {0.65951921096248009323, -1.8549932190132190645, 1.4671963577816927567},
    {0.061918793080767348779, -0.41780706324993084793, 0.47938827016916349915},
};

/* ARK5(4)8L[2]SAb, Kennedy & Carpenter 2019 */
static const double rk__ark5e[][8] = {
    {0},
    {4. / 9},
    {1. / 9, 1183333538310. / 1827251437969},
    {895379019517. / 9750411845327, 477606656805. / 13473228687314, -112564739183. / 9373365219272},
    {-4458043123994. / 13015289567637, -2500665203865. / 9342069639922, 983347055801. / 8893519644487,
     2185051477207. / 2551468980502},
    {-167316361917. / 17121522574472, 1605541814917. / 7619724128744, 991021770328. / 13052792161721,
     2342280609577. / 11279663441611, 3012424348531. / 12792462456678},
    {6680998715867. / 14310383562358, 5029118570809. / 3897454228471, 2415062538259. / 6382199904604,
     -3924368632305. / 6964820224454, -4331110370267. / 15021686902756, -3944303808049. / 11994238218192},
    {2193717860234. / 3570523412979, 2193717860234. / 3570523412979, 5952760925747. / 18750164281544,
     -4412967128996. / 6196664114337, 4151782504231. / 36106512998704, 572599549169. / 6265429158920,
     -457874356192. / 11306498036315},
};
static const double rk__ark5i[][8] = {
    {0, 4. / 9, 6456083330201. / 8509243623797, 1632083962415. / 14158861528103, 6365430648612. / 17842476412687,
     18. / 25, 191. / 200, 1},
    {0},
    {2. / 9, 2. / 9},
    {2366667076620. / 8822750406821, 2366667076620. / 8822750406821, 2. / 9},
    {-257962897183. / 4451812247028, -257962897183. / 4451812247028, 128530224461. / 14379561246022, 2. / 9},
    {-486229321650. / 11227943450093, -486229321650. / 11227943450093, -225633144460. / 6633558740617,
     1741320951451. / 6824444397158, 2. / 9},
    {621307788657. / 4714163060173, 621307788657. / 4714163060173, -125196015625. / 3866852212004,
     940440206406. / 7593089888465, 961109811699. / 6734810228204, 2. / 9},
    {2036305566805. / 6583108094622, 2036305566805. / 6583108094622, -3039402635899. / 4450598839912,
     -1829510709469. / 31102090912115, -286320471013. / 6931253422520, 8651533662697. / 9642993110008, 2. / 9},
    {0, 0, 3517720773327. / 20256071687669, 4569610470461. / 17934693873752, 2819471173109. / 11655438449929,
     3296210113763. / 10722700128969, -1142099968913. / 5710983926999, 2. / 9},
    {0, 0, 520639020421. / 8300446712847, 4550235134915. / 17827758688493, 1482366381361. / 6201654941325,
     5551607622171. / 13911031047899, -5266607656330. / 36788968843917, 1074053359553. / 5740751784926},
    {0, 0, 0.11093831878310548816, -0.00044149453865608988849, 0.0028742192909347288968, -0.091674663773129788286,
     -0.056825796060827857725, 0.035129416298573518843},
};
static const double rk__ark5i_d[][3] = {
    {0},
    {0},
    {-4.0397220788196716726, 13.915565255332069054, -9.7021806407765847594},
    {1.5980988332251452142, -2.9202882964227861679, 1.5769811258057645058},
    {-0.65736532335267473518, 3.2993111013036913304, -2.400044009500068701},
    {3.2219699446942072733, -11.194466337666355055, 8.279901251274376029},
    {1.8118881351853490165, -5.8170843546268039511, 3.8052131721221203965},
    {-0.93486951093235509625, 2.7169626320801847895, -1.559870898925607471},
};

/* name, s, p, (p of the pair,) powers and order of the dense output; _SA: b is the last row of A */
#define RK__ROWS(x, s, p, phat, D, q, b, bhat, e) \
    {#x, s, p, phat, D, q, 0, rk__##x[1], rk__##x[b], rk__##x[0], bhat, e, rk__##x##_d[0]}
#define RK__SOLO(x, s, p, D, q)          RK__ROWS(x, s, p, 0, D, q, s + 1, NULL, NULL)
#define RK__SOLO_SA(x, s, p, D, q)       RK__ROWS(x, s, p, 0, D, q, s, NULL, NULL)
#define RK__PAIR(x, s, p, phat, D, q)    RK__ROWS(x, s, p, phat, D, q, s + 1, rk__##x[s + 2], rk__##x[s + 3])
#define RK__PAIR_SA(x, s, p, phat, D, q) RK__ROWS(x, s, p, phat, D, q, s, rk__##x[s + 1], rk__##x[s + 2])
#define RK__IMEX(x, s, p, phat, D, q) /* the explicit part shares all but A */                                       \
    {#x "e",        s, p, phat, D, q, 0, rk__##x##e[0], rk__##x##i[s], rk__##x##i[0], rk__##x##i[s + 1], \
     rk__##x##i[s + 2], rk__##x##i_d[0]},                                                                \
    {#x "i",        s, p, phat, D, q, 0, rk__##x##i[1], rk__##x##i[s], rk__##x##i[0], rk__##x##i[s + 1], \
     rk__##x##i[s + 2], rk__##x##i_d[0]}

static const rk_table rk__tables[] = {
    RK__SOLO(euler, 1, 1, 1, 1),
    RK__PAIR(heun, 2, 2, 1, 2, 2),
    RK__PAIR(midpoint, 2, 2, 1, 2, 2),
    RK__SOLO(kutta3, 3, 3, 2, 2),
    RK__PAIR(ssp33, 3, 3, 2, 2, 2),
    RK__PAIR(ssp43, 4, 3, 2, 3, 3),
    RK__PAIR(ssp104, 10, 4, 3, 3, 3),
    RK__PAIR_SA(bs3, 4, 3, 2, 3, 3),
    RK__SOLO(rk4, 4, 4, 3, 3),
    RK__PAIR_SA(ss4, 5, 4, 3, 3, 3),
    RK__PAIR_SA(dp5, 7, 5, 4, 4, 4),
    RK__PAIR_SA(tsit5, 7, 5, 4, 4, 4),
    {"verner6", 9, 6, 5, 5, 5, 1, rk__verner6[1], rk__verner6[11], rk__verner6[0], rk__verner6[12],
     rk__verner6[13], rk__verner6_d[0]},
    {"dop853", 12, 8, 5, 7, 7, 4, rk__dop853[1], rk__dop853[13], rk__dop853[0], rk__dop853[17],
     rk__dop853[18], rk__dop853_d[0]},
    RK__SOLO(beuler, 1, 1, 1, 1),
    RK__SOLO(imidpoint, 1, 2, 1, 1),
    RK__SOLO_SA(trapezoid, 2, 2, 1, 1),
    RK__PAIR_SA(sdirk2, 2, 2, 1, 2, 2),
    RK__PAIR_SA(trbdf2, 3, 2, 1, 2, 2),
    RK__PAIR_SA(esdirk3, 5, 3, 2, 3, 3),
    RK__PAIR_SA(esdirk4, 6, 4, 3, 3, 3),
    RK__PAIR_SA(esdirk4b, 7, 4, 3, 4, 4),
    RK__PAIR_SA(esdirk5, 7, 5, 4, 4, 4),
    RK__PAIR_SA(sdirk4, 5, 4, 3, 3, 3),
    RK__SOLO_SA(wso3, 4, 3, 3, 3),
    RK__SOLO_SA(ars222e, 3, 2, 2, 2),
    RK__SOLO_SA(ars222i, 3, 2, 2, 2),
    RK__SOLO_SA(ars443e, 5, 3, 3, 3),
    RK__SOLO_SA(ars443i, 5, 3, 3, 3),
    RK__IMEX(ark2, 3, 2, 1, 2, 2),
    RK__IMEX(ark3, 4, 3, 2, 2, 2),
    RK__IMEX(ark4, 7, 4, 3, 3, 3),
    RK__IMEX(ark5, 8, 5, 4, 3, 3),
};

/* clang-format on */

RK_API const rk_table *rk_list(int i)
{
    return i >= 0 && i < (int)(sizeof rk__tables / sizeof *rk__tables) ? rk__tables + i : NULL;
}

RK_API const rk_table *rk_find(const char *name)
{
    int i;
    for (i = 0; name && rk_list(i); i++)
        if (strcmp(rk_list(i)->name, name) == 0) return rk_list(i);
    return NULL;
}

/* ---- sums over long vectors -------------------------------------------------------------------------------------- */

#define RK__EXPONENT                                                                                               \
        0x7ff0000000000000u /* of Inf and NaN; plus RK__CARRY it sets the sign bit, any other does not */
#define RK__CARRY 0x0010000000000000u

/* Comparing with isfinite() would not survive -ffast-math. */
static int rk__finite(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (bits & RK__EXPONENT) != RK__EXPONENT;
}

static int rk__misfit(const rk_table *T)
{
    return !T || !(T->stages >= 1 && T->extra >= 0 && T->stages <= RK_STAGES_MAX - T->extra) || !T->A || !T->b || !T->c;
}

#ifdef __GNUC__ /* short vectors, so that the sums are vectorised at any optimisation level and whatever aliases */
#  ifdef __AVX__
#    define RK__LANES 4
#  else
#    define RK__LANES 2
#  endif
typedef double rk__pack __attribute__((vector_size(8 * RK__LANES)));
typedef double rk__load __attribute__((vector_size(8 * RK__LANES), aligned(8), may_alias));
typedef uint64_t rk__bits __attribute__((vector_size(8 * RK__LANES)));
#  define RK__PACKS(m)                                                                                                 \
            for (; i + RK__LANES <= end; i += RK__LANES) {                                                             \
                rk__pack t = *(const rk__load *)(y + (i & keep)) RK__##m(RK__PACK);                                    \
                top |= ((rk__bits)t & RK__EXPONENT) + RK__CARRY;                                                       \
                *(rk__load *)(out + i) = t;                                                                            \
            }
#  define RK__PACK(j) +w##j **(const rk__load *)(x##j + i)
#else
#  define RK__PACKS(m)
#endif

/* RK__m(F) is F(0) F(1) ... F(m-1). */
#define RK__0(F)
#define RK__1(F) F(0)
#define RK__2(F) RK__1(F) F(1)
#define RK__3(F) RK__2(F) F(2)
#define RK__4(F) RK__3(F) F(3)
#define RK__5(F) RK__4(F) F(4)
#define RK__6(F) RK__5(F) F(5)
#define RK__7(F) RK__6(F) F(6)
#define RK__8(F) RK__7(F) F(7)

#define RK__TERM(j)   const double w##j = w[j], *x##j = x[j];
#define RK__SINGLE(j) +w##j *x##j[i]
#define RK__SUM(m)                                                                                                     \
    {                                                                                                                  \
        RK__##m(RK__TERM)                                                                                              \
        RK__PACKS(m)                                                                                                   \
        for (; i < end; i++) {                                                                                         \
            double t = y[i & keep] RK__##m(RK__SINGLE);                                                                \
            if (!rk__finite(t)) bad = 1;                                                                               \
            out[i] = t;                                                                                                \
        }                                                                                                              \
        break;                                                                                                         \
    }

/* out = y + sum of m <= 8 terms w_j x_j on [i, end), y NULL for none; returns whether anything is not finite. */
static int rk__sum(ptrdiff_t i, ptrdiff_t end, const double *y, int m, const double *w, const double *const *x,
                   double *out)
{
    static const double zero[8] = {0};
    const ptrdiff_t keep = y ? -1 : 0; /* y absent: read zero[0..] again and again */
    int bad = 0;
#ifdef __GNUC__
    rk__bits top = {0};
    int r;
#endif
    if (!y) y = zero;
    switch (m) {
    case 0: RK__SUM(0)
    case 1: RK__SUM(1)
    case 2: RK__SUM(2)
    case 3: RK__SUM(3)
    case 4: RK__SUM(4)
    case 5: RK__SUM(5)
    case 6: RK__SUM(6)
    case 7: RK__SUM(7)
    default: RK__SUM(8)
    }
#ifdef __GNUC__
    for (r = 0; r < RK__LANES; r++) bad |= (int)(top[r] >> 63);
#endif
    return bad;
}

/* One element again, 2^-64 smaller on the way: partial sums may overflow though the result does not. */
static double rk__rescue(ptrdiff_t i, double y, int m, const double *w, const double *const *x)
{
    volatile double small = 1. / 18446744073709551616.;
    double t = y * small;
    int j;
    for (j = 0; j < m; j++) t += w[j] * small * x[j][i];
    return t / small;
}

static int rk__combine(ptrdiff_t n, const double *y, double h, int s, const double *weight, const double *k,
                       ptrdiff_t ldk, double *out)
{
    const double *x[RK_STAGES_MAX];
    double w[RK_STAGES_MAX], old[256];
    const ptrdiff_t rows = y == out ? 256 : 4096;
    int j, m = 0, status = RK_OK;
    ptrdiff_t i, r;
    w[0] = 0;
    x[0] = k;
    for (j = 0; n > 0 && j < s; j++) {
        w[m] = h * weight[j];
        x[m] = k + j * ldk;
        m += w[m] != 0;
    }
    for (i = 0; i < n; i += rows) {
        const ptrdiff_t end = i + rows < n ? i + rows : n;
        int bad;
        if (y && y == out) memcpy(old, y + i, (size_t)(end - i) * sizeof *y);
        for (bad = j = 0; j == 0 || j < m; j += 8)
            bad |= rk__sum(i, end, j ? out : y, m - j < 8 ? m - j : 8, w + j, x + j, out);
        for (r = i; bad && r < end; r++) {
            if (!rk__finite(out[r])) out[r] = rk__rescue(r, y == out ? old[r - i] : y ? y[r] : 0, m, w, x);
            if (!rk__finite(out[r])) status = RK_NONFINITE;
        }
    }
    return status;
}

RK_API int rk_combine(ptrdiff_t n, const double *y, double h, int s, const double *weight, const double *k,
                      ptrdiff_t ldk, double *out)
{
    if (!(n >= 0) || !(s >= 0 && s <= RK_STAGES_MAX) || !rk__finite(h) || (s > 0 && !weight)) return RK_EARG;
    if (n > 0 && (!out || (s > 0 && (!k || !(ldk >= n))))) return RK_EARG;
    return rk__combine(n, y, h, s, weight, k, ldk, out);
}

/* ---- one step ---------------------------------------------------------------------------------------------------- */

RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                    double *z)
{
    if (rk__misfit(T) || !(i >= 0 && i < T->stages + T->extra) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && (!y || !z || (i > 0 && (!k || !(ldk >= n))))) return RK_EARG;
    return rk__combine(n, y, h, i, T->A + i * (T->stages + T->extra), k, ldk, z);
}

RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                     double *z, ptrdiff_t ldz)
{
    ptrdiff_t r;
    int i, m, remark = RK_OK;
    if (rk__misfit(T) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && (!y || !k || !z || !(ldk >= n && ldz >= n))) return RK_EARG;
    m = T->stages + T->extra;
    for (r = 0; r < n; r += 4096) /* all sums while the slopes are in the cache */
        for (i = 0; i < T->stages; i++)
            if (rk__combine(n - r < 4096 ? n - r : 4096, y + r, h, m, T->A + i * m, k + r, ldk, z + i * ldz + r))
                remark = RK_NONFINITE;
    return remark;
}

RK_API int rk_finish(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                     double *ynew, double *err)
{
    double e[RK_STAGES_MAX];
    ptrdiff_t i;
    int j, remark = RK_OK;
    if (rk__misfit(T) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && ((!y && ynew) || !k || !(ldk >= n))) return RK_EARG;
    if (err && !T->bhat) return RK_ENOPAIR;
    for (j = 0; err && j < T->stages; j++) e[j] = T->e ? T->e[j] : T->b[j] - T->bhat[j];
    for (i = 0; i < n; i += 4096) { /* both sums while the slopes are in the cache */
        const ptrdiff_t rows = n - i < 4096 ? n - i : 4096;
        if (ynew && rk__combine(rows, y + i, h, T->stages, T->b, k + i, ldk, ynew + i)) remark = RK_NONFINITE;
        if (err && rk__combine(rows, NULL, h, T->stages, e, k + i, ldk, err + i)) remark = RK_NONFINITE;
    }
    return remark;
}

/* ---- dense output ------------------------------------------------------------------------------------------------ */

RK_API int rk_weights(const rk_table *T, double theta, int deriv, double *weight)
{
    int i, j, r;
    if (rk__misfit(T) || !rk__finite(theta) || !(deriv >= 0) || !weight) return RK_EARG;
    if (!T->d || T->dense < 1) return RK_ENODENSE;
    if (fabs(theta) <= 4 * DBL_EPSILON) theta = 0;
    if (fabs(theta - 1) <= 4 * DBL_EPSILON) theta = 1;
    for (i = 0; i < T->stages + T->extra; i++) {
        const double *d = T->d + i * T->dense;
        double sum = 0;
        for (j = T->dense; j >= 1 && j >= deriv; j--) { /* d_j theta^j, differentiated deriv times */
            double term = d[j - 1];
            for (r = 0; r < deriv; r++) term *= j - r;
            sum = sum * theta + term;
        }
        weight[i] = deriv == 0 ? sum * theta : sum;
        if (deriv == 0 && (theta == 0 || theta == 1)) weight[i] = theta == 0 ? 0 : T->b[i];
    }
    return theta < 0 || theta > 1 ? RK_EXTRAP : RK_OK;
}

/* The checks, the weights and the power of h that the dense output shares: out = [y] + scale sum weight_j k_j. */
static int rk__dense_weights(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y,
                             const double *k, ptrdiff_t ldk, double *weight, double *scale)
{
    int r;
    if (rk__misfit(T) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && ((deriv == 0 && !y) || !k || !(ldk >= n))) return RK_EARG;
    if (deriv > 1 && h == 0) return RK_EARG;
    *scale = h;
    for (r = 0; r < deriv && r <= T->dense; r++) *scale = r == 0 ? 1 : *scale / h;
    if (!rk__finite(*scale)) return RK_EARG;
    return rk_weights(T, theta, deriv, weight);
}

RK_API int rk_dense(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y, const double *k,
                    ptrdiff_t ldk, double *out)
{
    double weight[RK_STAGES_MAX], scale;
    int status, remark;
    if (n > 0 && !out) return RK_EARG;
    status = rk__dense_weights(T, theta, deriv, h, n, y, k, ldk, weight, &scale);
    if (status < 0) return status;
    remark = rk__combine(n, deriv == 0 ? y : NULL, scale, T->stages + T->extra, weight, k, ldk, out);
    return remark ? remark : status;
}

RK_API int rk_dense_many(const rk_table *T, int count, const double *theta, int deriv, double h, ptrdiff_t n,
                         const double *y, const double *k, ptrdiff_t ldk, double *out, ptrdiff_t ldout)
{
    double weight[8][RK_STAGES_MAX], scale[8];
    int l, g, status, remark = RK_OK;
    ptrdiff_t r;
    if (!(count >= 0) || (count > 0 && !theta) || (n > 0 && (!out || !(ldout >= n)))) return RK_EARG;
    for (l = 0; l < count; l++) { /* all or nothing: every theta is looked at before the first result */
        status = rk__dense_weights(T, theta[l], deriv, h, n, y, k, ldk, weight[0], scale);
        if (status < 0) return status;
        if (status) remark = status;
    }
    for (g = 0; g < count; g += 8) {
        const int group = count - g < 8 ? count - g : 8;
        for (l = 0; l < group; l++) rk__dense_weights(T, theta[g + l], deriv, h, n, y, k, ldk, weight[l], scale + l);
        for (r = 0; r < n; r += 512) /* the slopes of these rows stay in the nearest cache */
            for (l = 0; l < group; l++)
                if (rk__combine(n - r < 512 ? n - r : 512, deriv == 0 ? y + r : NULL, scale[l], T->stages + T->extra,
                                weight[l], k + r, ldk, out + (g + l) * ldout + r))
                    remark = RK_NONFINITE;
    }
    return remark;
}

RK_API double rk_theta(double t, double t0, double h)
{
    const double slack = 4 * DBL_EPSILON * fmax(fabs(t0), fabs(t0 + h)), past = t - t0;
    if (fabs(past) <= slack) return 0;
    if (fabs(past - h) <= slack) return 1;
    return past / h;
}

/* ---- collocation: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.5 -------------------------------- */

/* The polynomial on [-1, 1] whose zeros are the inner nodes, and its derivative, from Legendre's P_n, P_n', P_n''. */
static void rk__node_polynomial(int family, int s, double x, double *f, double *df)
{
    const int n = family >= RK_LOBATTO_IIIA ? s - 1 : s;
    double P[3] = {1, 0, 0}, Q[3] = {0, 0, 0}; /* P_k and P_{k-1} with two derivatives each */
    int k, r;
    for (k = 0; k < n; k++)
        for (r = 2; r >= 0; r--) {
            const double next = ((2 * k + 1) * (x * P[r] + r * (r ? P[r - 1] : 0)) - k * Q[r]) / (k + 1);
            Q[r] = P[r];
            P[r] = next;
        }
    r = family >= RK_LOBATTO_IIIA;
    *f = P[r] - (family == RK_RADAU_IIA ? Q[0] : 0);
    *df = P[r + 1] - (family == RK_RADAU_IIA ? Q[1] : 0);
}

/* Nodes c in [0, 1], ascending.  Newton's iteration from the left end, divided by the zeros known so far, moves
   monotonically to the next one. */
static void rk__nodes(int family, int s, double *c)
{
    const int right = family != RK_GAUSS, first = family >= RK_LOBATTO_IIIA;
    int i, j, step;
    if (first) c[0] = 0;
    if (right) c[s - 1] = 1;
    for (i = first; i < s - right; i++) {
        double x = -1, f, df;
        for (step = 0; step < 60; step++) {
            rk__node_polynomial(family, s, x, &f, &df);
            for (j = first; step < 57 && j < i; j++) df -= f / (x - (2 * c[j] - 1));
            if (step < 57 && family == RK_RADAU_IIA) df -= f / (x - 1);
            x -= f / df;
        }
        c[i] = (1 + x) / 2;
    }
}

/* Value at x of the j-th Lagrange polynomial on the s nodes c. */
static double rk__lagrange(int s, const double *c, int j, double x)
{
    double v = 1;
    int l;
    for (l = 0; l < s; l++)
        if (l != j) v *= (x - c[l]) / (c[j] - c[l]);
    return v;
}

/* Its integral from 0 to t, by Gauss' rule: exact for the degree, and without cancelling powers. */
static double rk__lagrange_integral(int s, const double *c, int j, double t)
{
    double g[RK_ORDER_MAX], f, df, sum = 0;
    int l;
    rk__nodes(RK_GAUSS, s, g);
    for (l = 0; l < s; l++) {
        rk__node_polynomial(RK_GAUSS, s, 2 * g[l] - 1, &f, &df);
        sum += t * rk__lagrange(s, c, j, t * g[l]) / (4 * g[l] * (1 - g[l]) * df * df);
    }
    return sum;
}

/* Its s coefficients of 1, x, x^2, ... */
static void rk__lagrange_powers(int s, const double *c, int j, double *p)
{
    int i, l, degree = 0;
    p[0] = 1;
    for (l = 0; l < s; l++) {
        if (l == j) continue;
        for (i = ++degree; i >= 0; i--) p[i] = ((i ? p[i - 1] : 0) - c[l] * (i < degree ? p[i] : 0)) / (c[j] - c[l]);
    }
}

RK_API size_t rk_size(int stages, int order)
{
    const size_t m = (size_t)stages;
    if (!(stages >= 1 && stages <= RK_STAGES_MAX && order >= 0 && order <= RK_ORDER_MAX)) return 0;
    return (m * (7 * m + 2 * (size_t)order + 8) + 16) * sizeof(double); /* the arrays, and rk__derive's work */
}

RK_API int rk_collocation(rk_table *T, int family, int s, void *mem, size_t bytes)
{
    static const char *const names[] = {"gauss", "radauIIA", "lobattoIIIA", "lobattoIIIB", "lobattoIIIC"};
    double *A = (double *)mem, *b, *c, *d;
    char *name;
    int i, j;
    if (!T || !(family >= RK_GAUSS && family <= RK_LOBATTO_IIIC)) return RK_EARG;
    if (!(s >= (family >= RK_LOBATTO_IIIA ? 2 : 1) && s <= 5)) return RK_EARG;
    if (!mem || (uintptr_t)mem % sizeof(double) || bytes < rk_size(s, s)) return RK_EMEM;
    b = A + s * s;
    c = b + s;
    d = c + s;
    name = (char *)(d + s * s);
    rk__nodes(family, s, c);
    for (j = 0; j < s; j++) b[j] = rk__lagrange_integral(s, c, j, 1);
    for (i = 0; i < s; i++)
        for (j = 0; j < s; j++) {
            double *a = A + i * s + j;
            if (family == RK_LOBATTO_IIIB) /* the adjoint of IIIA */
                *a = b[j] * (1 - rk__lagrange_integral(s, c, i, c[j]) / b[i]);
            else if (family == RK_LOBATTO_IIIC) /* a_i1 = b_1, the rest exact for degree s-2 */
                *a = j == 0 || i == s - 1 ? b[j] /* the last row is b */
                            : rk__lagrange_integral(s - 1, c + 1, j - 1, c[i]) -
                                  b[0] * rk__lagrange(s - 1, c + 1, j - 1, 0);
            else *a = i == s - 1 && c[i] == 1 ? b[j] : rk__lagrange_integral(s, c, j, c[i]);
        }
    for (j = 0; j < s; j++) { /* d_j: the integral of the j-th polynomial, in powers of theta */
        rk__lagrange_powers(s, c, j, d + j * s);
        for (i = 0; i < s; i++) d[j * s + i] /= i + 1;
    }
    strcpy(name, names[family - RK_GAUSS]);
    name[strlen(name) + 1] = 0;
    name[strlen(name)] = (char)('0' + s);
    memset(T, 0, sizeof *T);
    T->name = name;
    T->stages = T->dense = T->dense_order = s;
    if (family == RK_LOBATTO_IIIB) T->dense_order = s - 1;
    T->order = 2 * s - (family == RK_GAUSS ? 0 : family == RK_RADAU_IIA ? 1 : 2);
    T->A = A;
    T->b = b;
    T->c = c;
    T->d = d;
    return RK_OK;
}

/* ---- rooted trees and order conditions ---------------------------------------------------------------------------
   A tree is its level sequence: the depth of each vertex in depth-first order, larger subtrees first.  All rooted trees
   with n vertices follow from 0 1 2 ... n-1 (Beyer & Hedetniemi 1980).  A vertex may carry a colour: which table's slope
   it is.  Each colouring of each shape is visited; two that differ only by symmetry are both visited, which costs time
   and changes no maximum. */

#define RK__PARTS 4

typedef struct rk__tree {
    int n, level[RK_ORDER_MAX], colour[RK_ORDER_MAX];
} rk__tree;

static void rk__tree_first(rk__tree *t, int n)
{
    int i;
    memset(t, 0, sizeof *t);
    t->n = n;
    for (i = 0; i < n; i++) t->level[i] = i;
}

static int rk__tree_next(rk__tree *t, int colours)
{
    int i, p = t->n - 1, q;
    for (i = 0; i < t->n; i++) { /* the next colouring, as one counts */
        if (++t->colour[i] < colours) return 1;
        t->colour[i] = 0;
    }
    while (p > 0 && t->level[p] == 1) p--;
    if (p <= 0) return 0;
    for (q = p - 1; t->level[q] != t->level[p] - 1;) q--;
    for (i = p; i < t->n; i++) t->level[i] = t->level[i - (p - q)];
    return 1;
}

static int rk__tree_parent(const rk__tree *t, int i)
{
    int p = i - 1;
    while (t->level[p] >= t->level[i]) p--;
    return p;
}

static int rk__tree_is_leaf(const rk__tree *t, int i)
{
    return i + 1 == t->n || t->level[i + 1] <= t->level[i];
}

/* gamma: the product over all vertices of the size of the subtree below each. */
static double rk__tree_gamma(const rk__tree *t)
{
    double gamma = 1;
    int i, j;
    for (i = 0; i < t->n; i++) {
        for (j = i + 1; j < t->n && t->level[j] > t->level[i];) j++;
        gamma *= j - i;
    }
    return gamma;
}

/* A partitioned method: the stages of a slope of colour p take the slopes of colour c by A[p][c], s[p] rows with a
   stride of ld[c].  A leaf of colour `parts` is time: c[p] in place of A 1. */
typedef struct rk__method {
    int parts, s[RK__PARTS], ld[RK__PARTS];
    const double *A[RK__PARTS][RK__PARTS], *c[RK__PARTS];
} rk__method;

/* Phi(tree) for each stage of the root's colour, and with absolute values throughout the size of the terms in it. */
static void rk__tree_phi(const rk__method *M, const rk__tree *t, double *phi, double *size)
{
    double v[RK_ORDER_MAX][RK_STAGES_MAX], a[RK_ORDER_MAX][RK_STAGES_MAX];
    int i, j, l;
    for (i = 0; i < t->n; i++)
        for (l = 0; t->colour[i] < M->parts && l < M->s[t->colour[i]]; l++) v[i][l] = a[i][l] = 1;
    for (i = t->n - 1; i > 0; i--) {
        const int up = rk__tree_parent(t, i), p = t->colour[up], c = t->colour[i];
        for (l = 0; l < M->s[p]; l++) {
            double sum = 0, abs = 0;
            if (c == M->parts) abs = fabs(sum = M->c[p][l]);
            else
                for (j = 0; j < M->s[c]; j++) {
                    const double e = M->A[p][c][l * M->ld[c] + j];
                    sum += e * v[i][j];
                    abs += fabs(e) * a[i][j];
                }
            v[up][l] *= sum;
            a[up][l] *= abs;
        }
    }
    for (l = 0; l < M->s[t->colour[0]]; l++) {
        phi[l] = v[0][l];
        size[l] = a[0][l];
    }
}

/* The largest scaled residual of sum_i b_i Phi_i(t) = 1/gamma(t) over all coloured trees of that order.  powers > 0: each
   b_i is a row of that many powers of theta, and power k must give 1/gamma(t) where k is the order and 0 elsewhere. */
static double rk__defect(const rk__method *M, int time, const double *const *b, int powers, int order)
{
    double worst = 0, phi[RK_STAGES_MAX], size[RK_STAGES_MAX];
    const int colours = M->parts + time, ld = powers > 0 ? powers : 1, last = powers > order ? powers : order;
    rk__tree t;
    int i, k;
    rk__tree_first(&t, order);
    do {
        const double *w = b[t.colour[0] < M->parts ? t.colour[0] : 0], target = 1 / rk__tree_gamma(&t);
        double scale = 0;
        for (i = 0; i < order; i++)
            if (t.colour[i] == M->parts && (i == 0 || !rk__tree_is_leaf(&t, i))) break;
        if (i < order) continue; /* time has no slopes of its own */
        rk__tree_phi(M, &t, phi, size);
        for (i = 0; i < M->s[t.colour[0]] * ld; i++) scale += fabs(w[i]) * size[i / ld];
        if (scale < target) scale = target;
        for (k = powers > 0 ? 1 : order; k <= last; k++) {
            const double *column = powers == 0 ? w : k <= powers ? w + k - 1 : NULL;
            double sum = k == order ? -target : 0;
            for (i = 0; column && i < M->s[t.colour[0]]; i++) sum += column[i * ld] * phi[i];
            if (!rk__finite(sum)) return DBL_MAX;
            if (fabs(sum) > worst * scale) worst = fabs(sum) / scale;
        }
    } while (rk__tree_next(&t, colours));
    return worst;
}

/* Whether c differs from the row sums: else time and state are the same leaf. */
static int rk__time_is_apart(const rk_table *T)
{
    const int m = T->stages + T->extra;
    int i, j, apart = 0;
    for (i = 0; i < m; i++) {
        double sum = -T->c[i], abs = fabs(T->c[i]);
        for (j = 0; j < m; j++) {
            sum += T->A[i * m + j];
            abs += fabs(T->A[i * m + j]);
        }
        if (!(fabs(sum) <= RK_TOLERANCE * abs)) apart = 1;
    }
    return apart;
}

static void rk__as_method(const rk_table *T, rk__method *M)
{
    M->parts = 1;
    M->s[0] = M->ld[0] = T->stages + T->extra;
    M->A[0][0] = T->A;
    M->c[0] = T->c;
}

static double rk__defect_table(const rk_table *T, const double *b, int powers, int order)
{
    rk__method M;
    if (rk__misfit(T) || !b || !(order >= 1 && order <= RK_ORDER_MAX)) return DBL_MAX;
    rk__as_method(T, &M);
    return rk__defect(&M, rk__time_is_apart(T), &b, powers, order);
}

/* The symmetry of the tree: at each vertex, how often equal subtrees (neighbours in this order) repeat. */
static double rk__tree_sigma(const rk__tree *t)
{
    double sigma = 1;
    int run[RK_ORDER_MAX], i, j, l;
    for (i = 1; i < t->n; i++) {
        run[i] = 1;
        for (j = i - 1; j > 0 && t->level[j] > t->level[i];) j--;
        if (j > 0 && t->level[j] == t->level[i]) { /* j is the sibling before i */
            for (l = 0; l < i - j && i + l < t->n && t->level[i + l] == t->level[j + l];) l++;
            if (l == i - j) run[i] = run[j] + 1; /* equal, since no subtree is larger than the one before it */
        }
        sigma *= run[i];
    }
    return sigma;
}

RK_API double rk_defect(const rk_table *T, int order)
{
    return rk__defect_table(T, T ? T->b : NULL, 0, order);
}

RK_API double rk_defect_hat(const rk_table *T, int order)
{
    return rk__defect_table(T, T ? T->bhat : NULL, 0, order);
}

RK_API double rk_defect_dense(const rk_table *T, int order)
{
    return rk__defect_table(T, T && T->dense > 0 ? T->d : NULL, T ? T->dense : 0, order);
}

RK_API double rk_defect_pair(const rk_table *T, const rk_table *other, int which, int order)
{
    const rk_table *part[2];
    const double *b[2];
    rk__method M;
    int p, q;
    part[0] = T;
    part[1] = other;
    if (rk__misfit(T) || rk__misfit(other) || T->stages != other->stages || T->extra != other->extra) return DBL_MAX;
    if (!(order >= 1 && order <= RK_ORDER_MAX) || !(which >= 0 && which <= 2)) return DBL_MAX;
    if (which == 2 && (T->dense < 1 || T->dense != other->dense)) return DBL_MAX;
    M.parts = 2;
    for (p = 0; p < 2; p++) {
        b[p] = which == 0 ? part[p]->b : which == 1 ? part[p]->bhat : part[p]->d;
        if (!b[p]) return DBL_MAX;
        M.s[p] = M.ld[p] = T->stages + T->extra;
        M.c[p] = part[p]->c;
        for (q = 0; q < 2; q++) M.A[p][q] = part[q]->A;
    }
    return rk__defect(&M, rk__time_is_apart(T) || rk__time_is_apart(other), b, which == 2 ? T->dense : 0, order);
}

RK_API double rk_defect_gark(int parts, const int *s, const double *const *A, const double *const *b, int order)
{
    rk__method M;
    int p, q;
    if (!(parts >= 1 && parts <= RK__PARTS) || !s || !A || !b || !(order >= 1 && order <= RK_ORDER_MAX)) return DBL_MAX;
    M.parts = parts;
    for (p = 0; p < parts; p++) {
        if (!(s[p] >= 1 && s[p] <= RK_STAGES_MAX) || !b[p]) return DBL_MAX;
        M.s[p] = M.ld[p] = s[p];
        for (q = 0; q < parts; q++)
            if (!(M.A[p][q] = A[p * parts + q])) return DBL_MAX;
    }
    return rk__defect(&M, 0, b, 0, order);
}

RK_API double rk_defect_mis(const rk_table *T)
{
    double sum = -1. / 3, last = 0, Ac;
    int i, j, m;
    if (rk__misfit(T)) return DBL_MAX;
    m = T->stages + T->extra;
    for (i = 0; i < T->stages; i++) {
        for (Ac = 0, j = 0; j < T->stages; j++) Ac += T->A[i * m + j] * T->c[j];
        if (i > 0) sum += (T->c[i] - T->c[i - 1]) * (Ac + last);
        last = Ac;
    }
    sum += (1 - T->c[T->stages - 1]) * (0.5 + last);
    return rk__finite(sum) ? fabs(sum) : DBL_MAX;
}

RK_API int rk_is(const rk_table *T, int property)
{
    int i, j, m, first = 1;
    if (rk__misfit(T)) return 0;
    m = T->stages + T->extra;
    if (property == RK_STIFF || property == RK_FSAL) {
        const double *last = T->A + (T->stages - 1) * m;
        for (j = 0; j < T->stages; j++) {
            if (last[j] != T->b[j]) return 0;
            if (T->A[j] != 0) first = 0;
        }
        return property == RK_STIFF || (first && T->c[0] == 0 && T->stages > 1);
    }
    for (i = 0; i < m; i++)
        for (j = property == RK_EXPLICIT ? i : i + 1; j < m; j++)
            if (T->A[i * m + j] != 0) return 0;
    return property == RK_EXPLICIT || property == RK_DIAGONAL;
}

/* Whether all orders up to `order` hold, the last scaled residual looked at in *defect. */
static int rk__holds(const rk_table *T, const double *b, int powers, int order, double *defect)
{
    int p;
    for (p = 1; p <= order && p <= RK_ORDER_MAX; p++)
        if (!((*defect = rk__defect_table(T, b, powers, p)) <= RK_TOLERANCE)) return 0;
    return 1;
}

/* Whether some number of the table is NaN or Inf. */
static int rk__not_finite(const rk_table *T)
{
    const int m = T->stages + T->extra;
    int i, bad = 0;
    for (i = 0; i < m * m; i++) bad |= !rk__finite(T->A[i]);
    for (i = 0; i < m; i++) {
        bad |= !rk__finite(T->b[i]) || !rk__finite(T->c[i]) || (T->bhat && !rk__finite(T->bhat[i]));
        bad |= T->bhat && T->e && !rk__finite(T->e[i]);
    }
    for (i = 0; T->d && i < m * T->dense; i++) bad |= !rk__finite(T->d[i]);
    return bad;
}

/* Whether the step takes a slope that is there for dense output only. */
static int rk__takes_extra(const rk_table *T)
{
    const int m = T->stages + T->extra;
    int i, j, takes = 0;
    for (j = T->stages; j < m; j++) {
        takes |= T->b[j] != 0 || (T->bhat && T->bhat[j] != 0);
        for (i = 0; i < T->stages; i++) takes |= T->A[i * m + j] != 0;
    }
    return takes;
}

RK_API int rk_check(const rk_table *T, double *defect)
{
    double worst = 0;
    int i, j, m;
    if (rk__misfit(T) || (T->dense > 0 && !T->d)) return RK_EARG;
    m = T->stages + T->extra;
    if (!defect) defect = &worst;
    *defect = DBL_MAX;
    if (T->dense < 0 || rk__not_finite(T) || rk__takes_extra(T)) return RK_ETABLE;
    if (T->order < 1 || (T->bhat ? T->order_hat < 1 : T->order_hat != 0)) return RK_ETABLE;
    if (T->dense > 0 && T->dense_order < 1) return RK_ETABLE;
    for (i = 0; T->bhat && T->e && i < T->stages; i++) /* rk_finish uses e */
        if (fabs(T->e[i] - (T->b[i] - T->bhat[i])) > RK_TOLERANCE * (fabs(T->b[i]) + fabs(T->bhat[i]))) return RK_EHAT;
    if (!rk__holds(T, T->b, 0, T->order, defect)) return RK_EORDER;
    if (T->bhat && !rk__holds(T, T->bhat, 0, T->order_hat, defect)) return RK_EHAT;
    if (T->dense > 0 && !rk__holds(T, T->d, T->dense, T->dense_order, defect)) return RK_EDENSE;
    for (i = 0; T->dense > 0 && i < m; i++) {
        double sum = -T->b[i], size = fabs(T->b[i]) + DBL_EPSILON;
        for (j = 0; j < T->dense; j++) {
            sum += T->d[i * T->dense + j];
            size += fabs(T->d[i * T->dense + j]);
        }
        if (!((*defect = fabs(sum) / size) <= RK_TOLERANCE)) return RK_EDENSE;
    }
    *defect = 0;
    return rk__time_is_apart(T) ? RK_ROWSUM : RK_OK;
}

/* ---- dense output for any table --------------------------------------------------------------------------------
   Uniform order q: for every tree of order <= q, sum_i B_ik Phi_i = [k = |t|]/gamma for each power k; one matrix for all
   k.  Its rows (there may be hundreds) are rotated one by one into a triangle, a one-sided Jacobi iteration gives its
   singular values, hence the rank, a particular solution and the null space.  There the error of order q+1, integrated
   over theta, is made smallest.  Normal equations or a full-rank routine (dgels) would not do: the matrix is rank
   deficient by design.

   Implicit tables, A = [0 0; a Ah] or Ah: for z -> -inf the dense output stays bounded if and only if each power has
   B_1k = Bh_k' Ah^-1 a, one more row, and tends to R(inf, theta) = 1 - bh(theta)' (Ah^-1 1 + Ah^-2 a), which joins the
   sum to be minimised. */

/* Rotate one more row into the upper triangle R of m columns; rows of w numbers, the last w - m are right-hand sides. */
static void rk__rotate(int m, int w, double *R, double *row)
{
    int j, l;
    for (j = 0; j < m; j++) {
        double *u = R + j * w;
        const double r = hypot(u[j], row[j]), c = r > 0 ? u[j] / r : 1, s = r > 0 ? row[j] / r : 0;
        for (l = j; row[j] != 0 && l < w; l++) {
            const double t = c * u[l] + s * row[l];
            row[l] = l == j ? row[j] : c * row[l] - s * u[l];
            u[l] = t;
        }
        row[j] = 0;
    }
}

/* a := a V with orthogonal columns, whose lengths are the singular values; a is r rows of w >= m numbers, V m*m. */
static void rk__svd(int r, int m, int w, double *a, double *V)
{
    int sweep, p, q, i, turned = 1;
    for (i = 0; i < m * m; i++) V[i] = i % (m + 1) == 0;
    for (sweep = 0; sweep < 40 && turned; sweep++)
        for (turned = 0, p = 0; p < m; p++)
            for (q = p + 1; q < m; q++) {
                double pp = 0, qq = 0, pq = 0, zeta, t, c, s;
                for (i = 0; i < r; i++) {
                    pp += a[i * w + p] * a[i * w + p];
                    qq += a[i * w + q] * a[i * w + q];
                    pq += a[i * w + p] * a[i * w + q];
                }
                if (!(fabs(pq) > DBL_EPSILON * sqrt(pp * qq))) continue;
                turned = 1;
                zeta = (qq - pp) / (2 * pq);
                t = (zeta < 0 ? -1 : 1) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                c = 1 / sqrt(1 + t * t);
                s = c * t;
                for (i = 0; i < r + m; i++) {
                    double *x = i < r ? a + i * w : V + (i - r) * m;
                    const double u = x[p];
                    x[p] = c * u - s * x[q];
                    x[q] = s * u + c * x[q];
                }
            }
}

static double rk__dot(int n, const double *x, int incx, const double *y, int incy)
{
    double sum = 0;
    int i;
    for (i = 0; i < n; i++) sum += x[i * incx] * y[i * incy];
    return sum;
}

/* The rows above for an implicit table, row and limit; returns 0: none, 1: only the limit, 2: both. */
static int rk__stiff_rows(int m, const double *A, int ld, double *row, double *limit)
{
    double x[RK_STAGES_MAX], y[RK_STAGES_MAX], z[RK_STAGES_MAX];
    int i, j, first = 1;
    for (i = 0; i < m; i++) {
        if (A[i] != 0) first = 0;
        for (j = i + 1; j < m; j++)
            if (A[i * ld + j] != 0) return 0;
    }
    for (i = first; i < m; i++)
        if (A[i * ld + i] == 0) return 0;
    if (first >= m) return 0;
    row[0] = 1;
    limit[0] = 0;
    for (i = first; i < m; i++) { /* Ah x = a, Ah y = 1, Ah z = x */
        const double *a = A + i * ld;
        x[i] = first ? a[0] : 0;
        y[i] = 1;
        for (j = first; j < i; j++) {
            x[i] -= a[j] * x[j];
            y[i] -= a[j] * y[j];
        }
        x[i] /= a[i];
        y[i] /= a[i];
        z[i] = (x[i] - rk__dot(i - first, a + first, 1, z + first, 1)) / a[i];
        row[i] = -x[i];
        limit[i] = y[i] + z[i];
    }
    return 1 + first;
}

/* Rotates into R the conditions up to order q, with q right-hand sides, and into N those of order q + 1, with the powers
   q + 1 and 0 of theta; the stiff rows, too.  Returns the largest residual that no weights can remove. */
static double rk__dense_conditions(const rk__method *M, int q, double *R, double *N, int implicit, const double *stiff,
                                   const double *limit)
{
    const int m = M->s[0];
    double row[RK_STAGES_MAX + RK_ORDER_MAX], size[RK_STAGES_MAX], miss = 0;
    rk__tree t;
    int i, k, n;
    for (n = 1; n <= q + 1 && n <= RK_ORDER_MAX; n++) {
        rk__tree_first(&t, n);
        do {
            double scale = 0;
            if (t.colour[0] != 0) continue; /* the weights do not depend on the root's colour */
            rk__tree_phi(M, &t, row, size);
            for (i = 0; i < m; i++) scale = fmax(scale, fabs(row[i]));
            if (n > q) scale = rk__tree_sigma(&t);
            if (!(scale > 0)) scale = 1;
            for (i = 0; i < m; i++) row[i] /= scale;
            for (k = 0; k < q || k < 2; k++) row[m + k] = k + 1 == n ? 1 / (rk__tree_gamma(&t) * scale) : 0;
            if (n > q) {
                row[m] = 1 / (rk__tree_gamma(&t) * scale);
                row[m + 1] = 0;
                rk__rotate(m, m + 2, N, row);
                continue;
            }
            rk__rotate(m, m + q, R, row);
            for (k = 0; k < q; k++) miss = fmax(miss, fabs(row[m + k]));
        } while (rk__tree_next(&t, M->parts));
    }
    if (implicit == 2) {
        for (i = 0; i < m + q; i++) row[i] = i < m ? stiff[i] : 0;
        rk__rotate(m, m + q, R, row);
        for (k = 0; k < q; k++) miss = fmax(miss, fabs(row[m + k]));
    }
    if (implicit) {
        for (i = 0; i < m; i++) row[i] = 0.1 * limit[i];
        row[m] = 0;
        row[m + 1] = 0.1;
        rk__rotate(m, m + 2, N, row);
    }
    return miss;
}

/* Solves R d = its right-hand sides by the singular values of R; orthonormal columns that R sends to 0 into Z, whose
   number is returned.  *miss grows to what is left over. */
static int rk__dense_particular(int m, int q, double *R, double *V, double *d, double *Z, double *miss)
{
    const int w = m + q;
    double top = 0;
    int i, k, l, null = 0;
    rk__svd(m, m, w, R, V);
    for (l = 0; l < m; l++) top = fmax(top, rk__dot(m, R + l, w, R + l, w));
    memset(d, 0, (size_t)(m * q) * sizeof *d);
    for (l = 0; l < m; l++) {
        const double square = rk__dot(m, R + l, w, R + l, w);
        if (!(square > 1e-20 * top)) {
            for (i = 0; i < m; i++) Z[i * m + null] = V[i * m + l];
            null++;
            continue;
        }
        for (k = 0; k < q; k++) {
            const double y = rk__dot(m, R + l, w, R + m + k, w) / square;
            for (i = 0; i < m; i++) d[i * q + k] += V[i * m + l] * y;
            for (i = 0; i < m; i++) R[i * w + m + k] -= R[i * w + l] * y;
        }
    }
    for (i = 0; i < m; i++)
        for (k = 0; k < q; k++) *miss = fmax(*miss, fabs(R[i * w + m + k]));
    return null;
}

/* Adds to d what makes N (d + Z x(theta)) nearest to n1 theta^(q+1) + n0 in the mean over theta, with d(1) = b: decoupled
   by the singular vectors of N Z, one polynomial x for each.  G, U, old: m*m numbers each. */
static void rk__dense_smallest(int m, int q, int null, const double *b, const double *N, const double *Z, double *d,
                               double *G, double *U, double *old)
{
    enum { POINTS = RK_ORDER_MAX };
    double F[POINTS * RK_ORDER_MAX], W[RK_ORDER_MAX * RK_ORDER_MAX], g[POINTS], root[POINTS], lack[RK_STAGES_MAX];
    double f, df, top = 0;
    int i, j, k, l, n;
    for (i = 0; i < m; i++)
        for (l = 0; l < null; l++) G[i * m + l] = rk__dot(m, N + i * (m + 2), 1, Z + l, m);
    rk__svd(m, null, m, G, U);
    rk__nodes(RK_GAUSS, POINTS, g);
    for (i = 0; i < POINTS; i++) { /* with the square roots of Gauss' weights, so that sums are integrals */
        rk__node_polynomial(RK_GAUSS, POINTS, 2 * g[i] - 1, &f, &df);
        root[i] = sqrt(1 / (4 * g[i] * (1 - g[i]) * df * df));
        for (k = 1; k < q; k++) F[i * (q - 1) + k - 1] = root[i] * (pow(g[i], k) - pow(g[i], q));
    }
    rk__svd(POINTS, q - 1, q - 1, F, W);
    for (i = 0; i < m * (m + 2); i++) top = fmax(top, fabs(N[i]));
    for (i = 0; i < m; i++) {
        lack[i] = b[i];
        for (k = 0; k < q; k++) lack[i] -= d[i * q + k];
    }
    memcpy(old, d, (size_t)(m * q) * sizeof *d); /* q <= m columns: the particular solution is kept while d grows */
    for (l = 0; l < null; l++) {
        double x[RK_ORDER_MAX] = {0}, target[POINTS], direction[RK_STAGES_MAX], end;
        const double sigma = sqrt(rk__dot(m, G + l, m, G + l, m));
        for (i = 0; i < m; i++) direction[i] = rk__dot(null, Z + i * m, 1, U + l, null);
        end = rk__dot(m, direction, 1, lack, 1);
        if (sigma > 1e-9 * top && q > 1) {
            for (i = 0; i < POINTS; i++) { /* what is asked of x(theta), less end theta^q */
                double want = 0;
                for (j = 0; j < m; j++) {
                    double v = N[j * (m + 2) + m] * pow(g[i], q + 1) + N[j * (m + 2) + m + 1];
                    for (n = 0; n < m; n++)
                        for (k = 0; k < q; k++) v -= N[j * (m + 2) + n] * old[n * q + k] * pow(g[i], k + 1);
                    want += G[j * m + l] * v;
                }
                target[i] = (want / (sigma * sigma) - end * pow(g[i], q)) * root[i];
            }
            for (j = 0; j < q - 1; j++) {
                const double y = rk__dot(POINTS, F + j, q - 1, target, 1) / rk__dot(POINTS, F + j, q - 1, F + j, q - 1);
                for (k = 0; k < q - 1; k++) x[k] += W[k * (q - 1) + j] * y;
            }
            for (x[q - 1] = end, k = 0; k < q - 1; k++) x[q - 1] -= x[k];
        } else /* nothing to minimise: the shortest */
            for (k = 0; k < q; k++) x[k] = end / q;
        for (i = 0; i < m; i++)
            for (k = 0; k < q; k++) d[i * q + k] += direction[i] * x[k];
    }
}

/* b_i(theta) of order q and degree q into d, for the m stages of colour 0 of M; returns whether it exists.  work holds
   6 m^2 + (q + 2) m numbers; *peak is max |R(inf, theta)|, 0 for explicit tables. */
static int rk__derive(const rk__method *M, const double *b, int q, double *d, double *work, double *peak)
{
    const int m = M->s[0];
    double *R = work, *V = R + m * (m + q), *N = V + m * m, *Z = N + m * (m + 2), *G = Z + m * m, *U = G + m * m;
    double stiff[RK_STAGES_MAX], limit[RK_STAGES_MAX], miss;
    const int implicit = rk__stiff_rows(m, M->A[0][0], M->ld[0], stiff, limit);
    const double *column[2];
    int i, k, n, null;
    memset(work, 0, (size_t)(m * (m + q)) * sizeof *work);
    memset(N, 0, (size_t)(m * (m + 2)) * sizeof *N);
    miss = rk__dense_conditions(M, q, R, N, implicit, stiff, limit);
    null = rk__dense_particular(m, q, R, V, d, Z, &miss);
    if (!(miss <= 1e-8)) return 0; /* a first look; the trees decide at the end */
    rk__dense_smallest(m, q, null, b, N, Z, d, G, U, V);
    for (i = 0; i < m; i++) { /* end in b to the last bits */
        double rest = b[i];
        for (k = 0; k < q; k++) rest -= d[i * q + k];
        d[i * q + q - 1] += rest;
    }
    column[0] = column[1] = d;
    for (n = 1; n <= q; n++)
        if (!(rk__defect(M, 0, column, q, n) <= RK_TOLERANCE)) return 0;
    *peak = 0;
    for (n = 0; implicit && n <= 64; n++) {
        double r = 1;
        for (i = 0; i < m; i++)
            for (k = 0; k < q; k++) r -= d[i * q + k] * pow(n / 64., k + 1) * limit[i];
        *peak = fmax(*peak, fabs(r));
    }
    return 1;
}

/* Whether an array of the table that rk_extend reads begins in mem. */
static int rk__holds_arrays(const void *mem, size_t bytes, const rk_table *T)
{
    const double *array[5];
    int i, holds = 0;
    array[0] = T->A;
    array[1] = T->b;
    array[2] = T->c;
    array[3] = T->bhat;
    array[4] = T->e;
    for (i = 0; i < 5; i++) holds |= array[i] && (uintptr_t)array[i] - (uintptr_t)mem < bytes;
    return holds;
}

RK_API int rk_extend(rk_table *out, const rk_table *T, const rk_table *other, int order, int more, void *mem,
                     size_t bytes)
{
    static const double at[] = {1. / 2, 1. / 4, 3. / 4, 1. / 3, 2. / 3, 1. / 5, 4. / 5, 2. / 5, 3. / 5};
    double *A = (double *)mem, *b, *c, *bhat, *e, *d, *work, peak = 0;
    int i, j, k, m, M, q = 0, added = 0;
    rk__method X;
    if (rk__misfit(T) || !out || !(order >= 0 && order <= RK_ORDER_MAX) || !(more >= 0 && more <= 9)) return RK_EARG;
    if (other && (rk__misfit(other) || other->stages != T->stages || other->extra != T->extra)) return RK_EARG;
    m = T->stages + T->extra;
    if (m + more > RK_STAGES_MAX || T->order < 1) return RK_EARG;
    if (rk__not_finite(T) || (other && rk__not_finite(other))) return RK_ETABLE;
    for (i = 0; other && i < m; i++)
        if (fabs(T->b[i] - other->b[i]) > RK_TOLERANCE) return RK_EARG;
    M = m + more;
    if (!mem || (uintptr_t)mem % sizeof(double) || bytes < rk_size(M, order ? order : RK_ORDER_MAX)) return RK_EMEM;
    if (rk__holds_arrays(mem, bytes, T) || (other && rk__holds_arrays(mem, bytes, other))) return RK_EARG;
    if (other || !rk_is(T, RK_EXPLICIT)) more = 0; /* a slope at a bootstrapped state is not bounded for stiff parts */
    b = A + M * M;
    c = b + M;
    bhat = c + M;
    e = bhat + M;
    d = e + M;
    work = d + M * (order ? order : RK_ORDER_MAX);
    memset(A, 0, (size_t)(M * M + 4 * M) * sizeof *A);
    for (i = 0; i < m; i++) {
        for (j = 0; j < m; j++) A[i * M + j] = T->A[i * m + j];
        b[i] = T->b[i];
        c[i] = T->c[i];
        if (T->bhat) bhat[i] = T->bhat[i];
        if (T->bhat) e[i] = T->e ? T->e[i] : T->b[i] - T->bhat[i];
    }
    X.parts = other ? 2 : 1;
    X.ld[0] = M;
    X.A[0][0] = X.A[1][0] = A;
    if (other) X.A[0][1] = X.A[1][1] = other->A;
    X.c[0] = X.c[1] = c;
    X.ld[1] = X.s[1] = m;
    for (;;) {
        X.s[0] = m;
        for (q = order ? order : T->order < RK_ORDER_MAX ? T->order : RK_ORDER_MAX; q >= 1; q--)
            if (q <= m && rk__derive(&X, b, q, d, work, &peak) && (order || peak <= 1 + 1e-9)) break;
        if (q < 1) return RK_EORDER; /* not even consistent */
        if (added == more || q >= (order ? order : T->order)) break;
        c[m] = 1;
        for (i = 0; added == 0 && i < m; i++) /* is the slope at ynew among the stages? */
            if (memcmp(A + i * M, b, (size_t)m * sizeof *b) == 0) c[m] = 0;
        if (added > 0 || c[m] == 0) c[m] = at[added];
        for (j = 0; j < m; j++) {
            A[m * M + j] = c[m] == 1 ? b[j] : 0;
            for (k = q; c[m] < 1 && k >= 1; k--) A[m * M + j] = (A[m * M + j] + d[j * q + k - 1]) * c[m];
        }
        m++;
        added++;
    }
    for (i = 1; i < m && m < M; i++) memmove(A + i * m, A + i * M, (size_t)m * sizeof *A);
    *out = *T;
    out->dense = out->dense_order = q;
    out->extra = m - T->stages;
    out->A = A;
    out->b = b;
    out->c = c;
    out->bhat = T->bhat ? bhat : NULL;
    out->e = T->bhat ? e : NULL;
    out->d = d;
    return order && q < order ? RK_LOWER : RK_OK;
}

/* ---- stability and other properties ------------------------------------------------------------------------------ */

#define RK__COUPLED 16 /* most stages of a table whose stages are all coupled */

typedef struct rk__complex {
    double re, im;
} rk__complex;

static rk__complex rk__times(rk__complex a, rk__complex b)
{
    rk__complex c;
    c.re = a.re * b.re - a.im * b.im;
    c.im = a.re * b.im + a.im * b.re;
    return c;
}

static rk__complex rk__over(rk__complex a, rk__complex b) /* Smith's division: no overflow on the way */
{
    rk__complex c;
    if (fabs(b.re) >= fabs(b.im)) {
        const double r = b.im / b.re, s = b.re + b.im * r;
        c.re = (a.re + a.im * r) / s;
        c.im = (a.im - a.re * r) / s;
    } else {
        const double r = b.re / b.im, s = b.re * r + b.im;
        c.re = (a.re * r + a.im) / s;
        c.im = (a.im * r - a.re) / s;
    }
    return c;
}

static rk__complex rk__weighted(int n, const double *w, const rk__complex *Y)
{
    rk__complex sum = {0, 0};
    int j;
    for (j = 0; j < n; j++) {
        if (w[j] == 0) continue; /* Y_j may be infinite */
        sum.re += w[j] * Y[j].re;
        sum.im += w[j] * Y[j].im;
    }
    return sum;
}

/* p Y_i - q sum_j a_ij Y_j = p, one stage after the other */
static void rk__substitute(const rk_table *T, rk__complex z, rk__complex p, rk__complex q, rk__complex *Y)
{
    const int m = T->stages + T->extra;
    int i;
    for (i = 0; i < T->stages; i++) {
        const double a = T->A[i * (m + 1)];
        rk__complex own = p, sum = rk__weighted(i, T->A + i * m, Y);
        sum = rk__times(a == 0 ? z : q, sum);
        sum.re += a == 0 ? 1 : p.re;
        sum.im += a == 0 ? 0 : p.im;
        own.re -= a * q.re;
        own.im -= a * q.im;
        Y[i] = a == 0 ? sum : rk__over(sum, own);
    }
}

/* the same where all stages are coupled, by elimination */
static void rk__eliminate(const rk_table *T, rk__complex p, rk__complex q, rk__complex *Y)
{
    const int s = T->stages, m = s + T->extra;
    rk__complex a[RK__COUPLED][RK__COUPLED + 1], t;
    const rk__complex one = {1, 0};
    int i, j, l, top, empty;
    for (i = 0; i < s; i++) {
        for (empty = 1, j = 0; j < s; j++) {
            const double e = T->A[i * m + j];
            if (e != 0) empty = 0;
            a[i][j].re = -e * q.re;
            a[i][j].im = -e * q.im;
        }
        a[i][s] = empty ? one : p; /* a row of zeros stays Y_i = 1 */
        a[i][i].re += a[i][s].re;
        a[i][i].im += a[i][s].im;
    }
    for (i = 0; i < s; i++) {
        for (top = i, j = i + 1; j < s; j++)
            if (hypot(a[j][i].re, a[j][i].im) > hypot(a[top][i].re, a[top][i].im)) top = j;
        for (l = i; l <= s; l++) {
            t = a[i][l];
            a[i][l] = a[top][l];
            a[top][l] = t;
        }
        for (j = i + 1; j < s; j++) {
            const rk__complex f = rk__over(a[j][i], a[i][i]);
            for (l = i; l <= s; l++) {
                t = rk__times(f, a[i][l]);
                a[j][l].re -= t.re;
                a[j][l].im -= t.im;
            }
        }
    }
    for (i = s - 1; i >= 0; i--) {
        Y[i] = a[i][s];
        for (j = i + 1; j < s; j++) {
            t = rk__times(a[i][j], Y[j]);
            Y[i].re -= t.re;
            Y[i].im -= t.im;
        }
        Y[i] = rk__over(Y[i], a[i][i]);
    }
}

/* R(z) from the stage values Y = (I - zA)^-1 1; where |z| > 1 the rows are divided by z, so that nothing grows that need
   not, and a stiffly accurate table's R is the last of them: in 1 + z b' Y all digits would cancel. */
static rk__complex rk__R(const rk_table *T, rk__complex z)
{
    const rk__complex one = {1, 0};
    const int large = hypot(z.re, z.im) > 1;
    const rk__complex p = large ? rk__over(one, z) : one, q = large ? one : z;
    rk__complex Y[RK_STAGES_MAX], R;
    if (rk_is(T, RK_DIAGONAL)) rk__substitute(T, z, p, q, Y);
    else rk__eliminate(T, p, q, Y);
    if (rk_is(T, RK_STIFF)) return Y[T->stages - 1];
    R = rk__times(z, rk__weighted(T->stages, T->b, Y));
    R.re += 1;
    return R;
}

/* What rk__R can do. */
static int rk__no_stability(const rk_table *T)
{
    return rk__misfit(T) || (T->stages > RK__COUPLED && !rk_is(T, RK_DIAGONAL));
}

RK_API int rk_stability(const rk_table *T, const double z[2], double R[2])
{
    rk__complex a;
    if (rk__no_stability(T) || !z || !R || !rk__finite(z[0]) || !rk__finite(z[1])) return RK_EARG;
    a.re = z[0];
    a.im = z[1];
    a = rk__R(T, a);
    R[0] = a.re;
    R[1] = a.im;
    if (rk__finite(a.re) && rk__finite(a.im)) return RK_OK;
    R[0] = HUGE_VAL;
    R[1] = 0;
    return RK_NONFINITE;
}

static int rk__contracts(const rk_table *T, double r, double re, double im, double slack)
{
    rk__complex z;
    double size;
    z.re = r * re;
    z.im = r * im;
    z = rk__R(T, z);
    size = hypot(z.re, z.im);
    return rk__finite(size) && size <= 1 + 1e-13 + slack * r;
}

/* How far |R| <= 1 from 0 along that direction; DBL_MAX: beyond 1e10. */
static double rk__reach(const rk_table *T, double re, double im, double slack)
{
    double low = 0, high = 0, mid;
    int i;
    while (high < 1e10 && rk__contracts(T, high, re, im, slack)) {
        low = high;
        high = high < 60 ? high + 0.02 : high * 1.02;
    }
    if (high >= 1e10) return DBL_MAX;
    for (i = 0; i < 60; i++) {
        mid = low + (high - low) / 2;
        if (rk__contracts(T, mid, re, im, slack)) low = mid;
        else high = mid;
    }
    return low;
}

/* Whether |R(iy)| > 1 for the smallest y: the sign of the first power of y in |R|^2 - 1, R's powers being b' A^(k-1) 1. */
static int rk__leaves_at_once(const rk_table *T)
{
    double c[25], v[RK_STAGES_MAX], u[RK_STAGES_MAX];
    const int m = T->stages + T->extra;
    int i, j, k;
    for (j = 0; j < m; j++) v[j] = 1;
    for (c[0] = 1, k = 1; k < 25; k++) {
        c[k] = rk__dot(m, T->b, 1, v, 1);
        for (i = 0; i < m; i++) u[i] = rk__dot(m, T->A + i * m, 1, v, 1);
        memcpy(v, u, (size_t)m * sizeof *v);
    }
    for (k = 2; k < 25; k += 2) {
        double sum = 0, size = 0;
        for (i = 0; i <= k; i++) {
            sum += ((2 * i - k) / 2 % 2 ? -1 : 1) * c[i] * c[k - i];
            size += fabs(c[i] * c[k - i]);
        }
        if (fabs(sum) > 1e-12 * size) return sum > 0;
    }
    return 0;
}

/* Kraaijevanger's conditions at r: with K = [A 0; b' 0], (I + rK)^-1 K >= 0 and (I + rK)^-1 1 >= 0. */
static int rk__is_monotone(const rk_table *T, double r)
{
    const int s = T->stages, m = s + T->extra;
    double X[RK_STAGES_MAX + 1];
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

/* The largest r for which that is so, by doubling and bisection. */
static double rk__ssp(const rk_table *T)
{
    double low = 0, high = 1;
    int i;
    if (!rk_is(T, RK_DIAGONAL) || !rk__is_monotone(T, 0)) return 0;
    for (; high < 1e6 && rk__is_monotone(T, high); high *= 2) low = high;
    if (high >= 1e6) return DBL_MAX;
    for (i = 0; i < 60; i++) {
        const double mid = low + (high - low) / 2;
        if (rk__is_monotone(T, mid)) low = mid;
        else high = mid;
    }
    return low > 1e-9 ? low : 0;
}

/* Whether sum_j a_ij c_j^(k-1) = c_i^k / k for every stage, and so for b with c = 1. */
static int rk__has_stage_order(const rk_table *T, int k)
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

static double rk__error_norm(const rk_table *T)
{
    double phi[RK_STAGES_MAX], size[RK_STAGES_MAX], norm = 0;
    rk__method M;
    rk__tree t;
    if (T->order < 1 || T->order >= RK_ORDER_MAX) return 0;
    rk__as_method(T, &M);
    rk__tree_first(&t, T->order + 1);
    do {
        double residual;
        rk__tree_phi(&M, &t, phi, size);
        residual = (rk__dot(M.s[0], T->b, 1, phi, 1) - 1 / rk__tree_gamma(&t)) / rk__tree_sigma(&t);
        norm += residual * residual;
    } while (rk__tree_next(&t, 1));
    return sqrt(norm);
}

RK_API int rk_analyse(const rk_table *T, rk_analysis *a)
{
    const double pi = 3.14159265358979323846;
    double z[2] = {-1e300, 0}, R[2], weight[RK_STAGES_MAX], last = 0, slack;
    int i, k, m, explicit_, diagonal;
    if (rk__no_stability(T) || !a) return RK_EARG;
    if (rk__not_finite(T)) return RK_ETABLE;
    m = T->stages + T->extra;
    explicit_ = rk_is(T, RK_EXPLICIT);
    diagonal = rk_is(T, RK_DIAGONAL);
    for (i = 0; i < T->stages; i++) last += fabs(T->A[i * m + T->stages - 1]);
    if (last == 0) z[0] = -1e8; /* Lobatto IIIB: A is singular, R loses digits in proportion to |z| */
    slack = last == 0 && !explicit_ ? 1e-14 : 0;
    a->real_axis = rk__reach(T, -1, 0, slack);
    a->imaginary_axis = rk__leaves_at_once(T) ? 0 : rk__reach(T, 0, 1, slack);
    a->r_infinity = DBL_MAX;
    if (!explicit_ && rk_stability(T, z, R) == RK_OK && hypot(R[0], R[1]) < sqrt(-z[0])) /* else it grows with z */
        a->r_infinity = hypot(R[0], R[1]);
    a->a_stable = !explicit_ && a->imaginary_axis == DBL_MAX;
    for (i = 0; diagonal && i < T->stages; i++) /* the poles are 1/a_ii */
        if (T->A[i * (m + 1)] < 0) a->a_stable = 0;
    for (i = 1; !diagonal && a->a_stable && i <= 6; i++)
        a->a_stable = rk__reach(T, cos(pi / 2 + i * pi / 12), sin(pi / 2 + i * pi / 12), slack) == DBL_MAX;
    a->l_stable = a->a_stable && a->r_infinity < 1e-9;
    a->ssp = rk__ssp(T);
    for (k = 1; k <= T->order && rk__has_stage_order(T, k);) k++;
    a->stage_order = k - 1;
    a->error_norm = rk__error_norm(T);
    a->dense_max = 0;
    for (k = 0; k <= 200 && rk_weights(T, k / 200., 0, weight) == RK_OK; k++)
        for (i = 0; i < m; i++) a->dense_max = fmax(a->dense_max, fabs(weight[i]));
    return RK_OK;
}

/* ---- error norm and step control --------------------------------------------------------------------------------- */

RK_API int rk_norm(ptrdiff_t n, const double *v, const double *y0, const double *y1, double rtol, double atol,
                   double sum[4])
{
    const double huge = ldexp(1, 450); /* ratios beyond 2^+-450 are summed 2^-+600 times as large */
    ptrdiff_t i, r;
    if (!(n >= 0) || !(rtol >= 0) || !(atol >= 0) || !rk__finite(rtol) || !rk__finite(atol) || !sum) return RK_EARG;
    if (n > 0 && (!v || !y0)) return RK_EARG;
    if (!y1) y1 = y0;
    for (r = 0; r < n; r += 256) {
        const ptrdiff_t end = r + 256 < n ? r + 256 : n;
        double s[4] = {0, 0, 0, 0}, all[4] = {0, 0, 0, 0}; /* all: not finite if some y is not */
        for (i = r; i + 4 <= end; i += 4) {
            int l;
            for (l = 0; l < 4; l++) {
                const double a = fabs(y0[i + l]), b = fabs(y1[i + l]), q = v[i + l] / (atol + rtol * (a > b ? a : b));
                s[l] += q * q;
                all[l] += a + b;
            }
        }
        for (; i < end; i++) {
            const double a = fabs(y0[i]), b = fabs(y1[i]), q = v[i] / (atol + rtol * (a > b ? a : b));
            s[0] += q * q;
            all[0] += a + b;
        }
        s[0] = (s[0] + s[1]) + (s[2] + s[3]);
        all[0] = (all[0] + all[1]) + (all[2] + all[3]);
        if (rk__finite(s[0]) && rk__finite(all[0]) && s[0] > 1e-200) {
            sum[0] += s[0];
            continue;
        }
        for (i = r; i < end; i++) { /* out of range, or exactly zero: one by one */
            const double a = fabs(y0[i]), b = fabs(y1[i]), w = atol + rtol * (a > b ? a : b), q = fabs(v[i]) / w;
            if (!rk__finite(v[i]) || !rk__finite(y0[i]) || !rk__finite(y1[i]) || (w == 0 ? v[i] != 0 : !rk__finite(q)))
                sum[1] += DBL_MAX; /* makes rk_rms infinite; an infinity here may be optimised away by -ffast-math */
            else if (w == 0) continue;
            else if (q > huge) sum[1] += ldexp(q, -600) * ldexp(q, -600);
            else if (q < 1 / huge) sum[2] += ldexp(q, 600) * ldexp(q, 600);
            else sum[0] += q * q;
        }
    }
    sum[3] += (double)n;
    return RK_OK;
}

RK_API double rk_rms(const double sum[4])
{
    int i;
    for (i = 0; sum && i < 4; i++)
        if (!rk__finite(sum[i])) return HUGE_VAL;
    if (!sum || !(sum[3] > 0)) return 0;
    if (sum[1] > 0) return ldexp(sqrt((sum[1] + ldexp(sum[0], -1200)) / sum[3]), 600);
    if (sum[0] > 0) return sqrt((sum[0] + ldexp(sum[2], -1200)) / sum[3]);
    return ldexp(sqrt(sum[2] / sum[3]), -600);
}

RK_API int rk_control_make(rk_control *C, const char *method)
{
    static const struct {
        const char *name;
        double k[5];
    } known[] = {{"I", {1, 0, 0, 0, 0}},
                 {"PI", {0.8, -0.31, 0, 0, 0}},
                 {"PID", {0.58, -0.21, 0.1, 0, 0}},
                 {"explicit", {0.367 + 0.268, -0.268, 0, 0, 0}},
                 {"implicit", {0.98 + 0.95, -0.95, 0, 1, 0}},
                 {"H0211", {1. / 2, 1. / 2, 0, -1. / 2, 0}},
                 {"H0321", {5. / 4, 1. / 2, -3. / 4, 1. / 4, 3. / 4}},
                 {"H211", {1. / 4, 1. / 4, 0, -1. / 4, 0}},
                 {"H312", {1. / 8, 1. / 4, 1. / 8, -3. / 8, -1. / 8}}};
    size_t i;
    for (i = 0; C && method && i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, method) == 0) {
            memset(C, 0, sizeof *C);
            memcpy(C->k, known[i].k, sizeof C->k);
            C->safety = 0.9;
            C->grow = 10;
            C->first = 1e4;
            C->shrink = 0.1;
            C->again = 0.3;
            return RK_OK;
        }
    return RK_EARG;
}

RK_API int rk_control_step(rk_control *C, int order, double error, double t, double h, double *hnext)
{
    const double power = 1 / (order + 1.);
    double factor;
    volatile double moved;
    int reject;
    if (!C || !hnext || !(order >= 0) || !rk__finite(t) || !rk__finite(h) || h == 0) return RK_EARG;
    if (rk__finite(error) && error < 0) return RK_EARG; /* in this order: -ffast-math may take NaN < 0 for true */
    reject = !rk__finite(error) || !(error <= 1);
    if (!rk__finite(error)) factor = 0;
    else if (error == 0) factor = DBL_MAX;
    else if (reject || C->steps == 0) /* no history yet, or none that applies */
        factor = C->safety * pow(error, -power);
    else {
        const double e1 = C->e[0], e2 = C->steps > 1 ? C->e[1] : e1;
        const double r1 = fabs(h / C->h[0]), r2 = C->steps > 1 ? fabs(C->h[0] / C->h[1]) : 1;
        factor = C->safety * pow(error, -C->k[0] * power) * pow(e1, -C->k[1] * power) * pow(e2, -C->k[2] * power) *
                 pow(r1, C->k[3]) * pow(r2, C->k[4]);
    }
    if (!(factor >= C->shrink)) factor = C->shrink;
    if (reject && factor > (C->failures ? C->again : 0.9)) factor = C->failures ? C->again : 0.9;
    if (!reject && factor > (C->steps ? C->grow : C->first)) factor = C->steps ? C->grow : C->first;
    if (!reject && C->failures && factor > 1) factor = 1; /* no growth right after a failure */
    if (!rk__finite(h * factor)) factor = 1;              /* cannot grow */
    moved = t + h * factor;
    if (moved == t) return RK_ETINY;
    *hnext = h * factor;
    if (reject) {
        C->failures++;
        return RK_REJECT;
    }
    C->e[1] = C->e[0];
    C->e[0] = error > 1e-4 ? error : 1e-4; /* a step that happened to be exact must not rule the next two */
    C->h[1] = C->h[0];
    C->h[0] = h;
    C->steps++;
    C->failures = 0;
    return RK_OK;
}

RK_API double rk_first_step(int order, double d0, double d1, double d2)
{
    const double trial = d1 > 0 ? 0.01 * fmax(d0, 1e-4) / d1 : 0, most = fmax(d1, d2);
    if (!(order >= 0) || !rk__finite(d0) || !rk__finite(d1) || !rk__finite(d2) || !(d0 >= 0 && d1 >= 0)) return 0;
    if (d2 < 0 || !(most > 0)) return d2 < 0 ? trial : 100 * trial;
    return trial > 0 ? fmin(100 * trial, pow(0.01 / most, 1 / (order + 1.))) : pow(0.01 / most, 1 / (order + 1.));
}

RK_API int rk_newmark(int kind, double rho, double coef[4])
{
    const double alpha = (1 - rho) / (1 + rho);
    double m = 0, f = 0;
    if (!(kind >= RK_GENERALIZED_ALPHA && kind <= RK_NEWMARK) || !coef) return RK_EARG;
    if (!rk__finite(rho) || !(rho >= (kind == RK_HHT ? 0.5 : 0) && rho <= 1)) return RK_EARG;
    if (kind == RK_GENERALIZED_ALPHA) {
        m = (2 * rho - 1) / (rho + 1);
        f = rho / (rho + 1);
    }
    if (kind == RK_HHT) f = alpha;
    coef[0] = m;
    coef[1] = f;
    coef[2] = kind == RK_NEWMARK ? 0.5 + alpha : 0.5 - m + f;
    coef[3] = kind == RK_NEWMARK ? (1 + alpha) * (1 + alpha) / 4 : (1 - m + f) * (1 - m + f) / 4; /* squared */
    return RK_OK;
}

/* ---- multirate couplings ---------------------------------------------------------------------------------------
   The rows of stages 1, 2, ... and of the embedded solution, zeros at the end left out. */

/* clang-format off */

/* Knoth & Wolke 1998 */
static const double rk__kw3_c[] = {0, 1. / 3, 3. / 4, 1};
static const double rk__kw3_W[][4] = {
    {1. / 3},
    {-25. / 48, 15. / 16},
    {17. / 48, -51. / 80, 8. / 15},
    {0},
};
/* MRI-GARK: Sandu 2019 */
static const double rk__erk22a_c[] = {0, 1. / 2, 1};
static const double rk__erk22a_W[][3] = {
    {1. / 2},
    {-1. / 2, 1},
    {1. / 2},
};
static const double rk__erk33a_c[] = {0, 1. / 3, 2. / 3, 1};
static const double rk__erk33a_W[][4] = {
    {1. / 3},
    {-1. / 3, 2. / 3},
    {0, -2. / 3, 1},
    {1. / 12, -1. / 3, 7. / 12},
    /* tau */
    {0},
    {0},
    {1. / 2, 0, -1. / 2},
    {0},
};
static const double rk__erk45a_c[] = {0, 1. / 5, 2. / 5, 3. / 5, 4. / 5, 1};
static const double rk__erk45a_W[][6] = {
    {1. / 5},
    {-53. / 16, 281. / 80},
    {-36562993. / 71394880, 34903117. / 17848720, -88770499. / 71394880},
    {-7631593. / 71394880, -166232021. / 35697440, 6068517. / 1519040, 8644289. / 8924360},
    {277061. / 303808, -209323. / 1139280, -1360217. / 1139280, -148789. / 56964, 147889. / 45120},
    {-88227. / 47470, 756870829. / 340217490, -713704111. / 1360869960, -31967827. / 340217490, 129673. / 286680},
    /* tau */
    {0},
    {503. / 80, -503. / 80},
    {-1365537. / 35697440, 4963773. / 7139488, -1465833. / 2231090},
    {66974357. / 35697440, 21445367. / 7139488, -3, -8388609. / 4462180},
    {-18227. / 7520, 2, 1, 5, -41933. / 7520},
    {6213. / 1880, -6213. / 1880},
};
static const double rk__irk21a_c[] = {0, 1, 1, 1};
static const double rk__irk21a_W[][4] = {
    {1},
    {-1. / 2, 0, 1. / 2},
    {0},
    {-1. / 2, 0, 1. / 2},
};
static const double rk__esdirk34a_c[] = {0, 1. / 3, 1. / 3, 2. / 3, 2. / 3, 1, 1, 1};
static const double rk__esdirk34a_W[][8] = {
    {1. / 3},
    {-0.43586652150845899942, 0, 0.43586652150845899942},
    {-0.30457906119445049704, 0, 0.63791239452778383038},
    {0.21169131056402666017, 0, -0.64755783207248565958, 0, 0.43586652150845899942},
    {0.44542093880554950296, 0, 0.88137848056161982804, 0, -0.99346608603383599766},
    {-0.43586652150845899942, 0, 0, 0, 0, 0, 0.43586652150845899942},
    {0},
    {0.24538319991175243725, 0, 0.42042150330440445631, 0, -1.5769926063440662244, 0, 0.9111879031279093308},
};
static const double rk__esdirk46a_c[] = {0, 1. / 5, 1. / 5, 2. / 5, 2. / 5, 3. / 5, 3. / 5, 4. / 5, 4. / 5, 1, 1, 1};
static const double rk__esdirk46a_W[][12] = {
    {1. / 5},
    {-1. / 4, 0, 1. / 4},
    {1771023115159. / 1929363690800, 0, -1385150376999. / 1929363690800},
    {914009. / 345800, 0, -1000459. / 345800, 0, 1. / 4},
    {18386293581909. / 36657910125200, 0, 5506531089. / 80566835440, 0, -178423463189. / 482340922700},
    {36036097. / 8299200, 0, 4621. / 118560, 0, -38434367. / 8299200, 0, 1. / 4},
    {-247809665162987. / 146631640500800, 0, 10604946373579. / 14663164050080, 0, 10838126175385. / 5865265620032, 0,
     -24966656214317. / 36657910125200},
    {38519701. / 11618880, 0, 10517363. / 9682400, 0, -23284701. / 19364800, 0, -10018609. / 2904720, 0, 1. / 4},
    {-52907807977903. / 33838070884800, 0, 74846944529257. / 73315820250400, 0, 365022522318171. / 146631640500800, 0,
     -20513210406809. / 109973730375600, 0, -2918009798. / 1870301537},
    {19. / 100, 0, -73. / 300, 0, 127. / 300, 0, 127. / 300, 0, -313. / 300, 0, 1. / 4},
    {0},
    {-1. / 4, 0, 5595. / 8804, 0, -2445. / 8804, 0, -4225. / 8804, 0, 2205. / 4402, 0, -567. / 4402},
    /* tau */
    {0},
    {0},
    {-1674554930619. / 964681845400, 0, 1674554930619. / 964681845400},
    {-1007739. / 172900, 0, 1007739. / 172900},
    {-8450070574289. / 18328955062600, 0, -39429409169. / 40283417720, 0, 173621393067. / 120585230675},
    {-122894383. / 16598400, 0, 14501. / 237120, 0, 121879313. / 16598400},
    {32410002731287. / 15434909526400, 0, -46499276605921. / 29326328100160, 0, -34914135774643. / 11730531240064, 0,
     45128506783177. / 18328955062600},
    {-128357303. / 23237760, 0, -35433927. / 19364800, 0, 71038479. / 38729600, 0, 8015933. / 1452360},
    {136721604296777. / 67676141769600, 0, -349632444539303. / 146631640500800, 0, -1292744859249609. / 293263281001600,
     0, 8356250416309. / 54986865187800, 0, 17282943803. / 3740603074},
    {3. / 25, 0, -29. / 300, 0, 71. / 300, 0, 71. / 300, 0, -149. / 300},
    {0},
    {0},
};
/* IMEX-MRI-SR: Fish, Reynolds & Roberts 2024 */
static const double rk__sr21_c[] = {0, 3. / 5, 4. / 15, 1};
static const double rk__sr21_W[][4] = {
    {3. / 5},
    {14. / 165, 2. / 11},
    {-13. / 54, 137. / 270, 11. / 15},
    {-1. / 4, 1. / 2, 3. / 4},
};
static const double rk__sr21_G[][4] = {
    {-11. / 23, 11. / 23},
    {-6692. / 52371, -18355. / 52371, 11. / 23},
    {11621. / 90666, -215249. / 226665, 17287. / 50370, 11. / 23},
    {-31. / 12, -1. / 6, 11. / 4},
};
static const double rk__sr32_c[] = {0, 23. / 34, 4. / 5, 17. / 15, 1};
static const double rk__sr32_W[][5] = {
    {23. / 34},
    {71. / 70, -3. / 14},
    {124. / 1155, 4. / 7, 5. / 11},
    {162181. / 187680, 119. / 1380, 11. / 32, -5. / 17},
    {76355. / 74834, -46. / 31, 67. / 34, -36. / 71},
    /* tau */
    {0},
    {-14453. / 63825, 14453. / 63825},
    {-2101267877. / 1206582300, 2476735438. / 301645575, -13575085. / 2098404},
    {-762580446799. / 588660102960, 11083240219. / 4328383110, -211274129. / 100368304, 89562055. / 106641323},
    {-3732974. / 2278035, 13857574. / 2278035, -52. / 9, 4. / 3},
};
static const double rk__sr32_G[][5] = {
    {-4. / 7, 4. / 7},
    {-2707004. / 3127425, 919904. / 3127425, 4. / 7},
    {852879271. / 703839675, -1575000496. / 703839675, 5. / 11, 4. / 7},
    {43136869. / 2019912118, -73810600. / 1009956059, -17653551. / 87822266, -13993902. / 43911133, 4. / 7},
    {-179. / 4140, 799. / 14490, 1. / 14, -1. / 12},
};
static const double rk__sr43_c[] = {0, 1. / 4, 3. / 4, 11. / 20, 1. / 2, 1, 1};
static const double rk__sr43_W[][7] = {
    {1. / 4},
    {9. / 8, -3. / 8},
    {187. / 2340, 7. / 9, -4. / 13},
    {64. / 165, 1. / 6, -3. / 5, 6. / 11},
    {1816283. / 549120, -2. / 9, -4. / 11, -1. / 6, -2561809. / 1647360},
    {0, 7. / 11, -2203. / 264, 10825. / 792, -85. / 12, 841. / 396},
    {1. / 400, 49. / 12, 43. / 6, -7. / 10, -85. / 12, -2963. / 1200},
    /* tau */
    {0},
    {-11. / 4, 11. / 4},
    {-1228. / 2925, -92. / 225, 808. / 975},
    {-2572. / 2805, 167. / 255, 199. / 136, -1797. / 1496},
    {-1816283. / 274560, 253. / 36, -23. / 44, 76. / 3, -20775791. / 823680},
    {0, 107. / 132, 1289. / 88, -9275. / 792, 0, -371. / 99},
    {-1. / 200, -137. / 24, -235. / 16, 1237. / 80, 0, 2963. / 600},
};
static const double rk__sr43_G[][7] = {
    {-1. / 4, 1. / 4},
    {1. / 4, -1. / 2, 1. / 4},
    {13. / 100, -7. / 30, -11. / 75, 1. / 4},
    {6. / 85, -301. / 1360, -99. / 544, 45. / 544, 1. / 4},
    {0, -9. / 4, -19. / 48, -75. / 16, 85. / 12, 1. / 4},
    {0},
    {0},
};
/* MERK: Luan, Chinomona & Reynolds 2020; all is Lagrange interpolation through these times */
static const double rk__merk21_c[] = {0, 1. / 2, 1};
static const signed char rk__merk21_g[] = {1, 1, 0};
static const double rk__merk32_c[] = {0, 1. / 2, 2. / 3, 1};
static const signed char rk__merk32_g[] = {1, 1, 1, 0};
static const double rk__merk43_c[] = {0, 1. / 2, 1. / 3, 1. / 2, 1. / 3, 5. / 6, 1};
static const signed char rk__merk43_g[] = {1, 2, 2, 1, 0};
static const double rk__merk54_c[] = {0, 1. / 2, 1. / 3, 1. / 2, 1. / 4, 1. / 3, 1. / 2, 1. / 2, 2. / 3, 7. / 10, 1};
static const signed char rk__merk54_g[] = {1, 2, 3, 3, 1, 0};

static const rk_coupling rk__couplings[] = {
    /* name, form, stages, order, of the pair, powers of tau */
    {"KW3", 0, 4, 3, 0, 1, rk__kw3_c, rk__kw3_W[0], NULL, NULL},
    {"ERK22a", 0, 3, 2, 1, 1, rk__erk22a_c, rk__erk22a_W[0], NULL, NULL},
    {"ERK33a", 0, 4, 3, 2, 2, rk__erk33a_c, rk__erk33a_W[0], NULL, NULL},
    {"ERK45a", 0, 6, 4, 3, 2, rk__erk45a_c, rk__erk45a_W[0], NULL, NULL},
    {"IRK21a", 0, 4, 2, 1, 1, rk__irk21a_c, rk__irk21a_W[0], NULL, NULL},
    {"ESDIRK34a", 0, 8, 3, 2, 1, rk__esdirk34a_c, rk__esdirk34a_W[0], NULL, NULL},
    {"ESDIRK46a", 0, 12, 4, 3, 2, rk__esdirk46a_c, rk__esdirk46a_W[0], NULL, NULL},
    {"SR21", 1, 4, 2, 1, 1, rk__sr21_c, rk__sr21_W[0], rk__sr21_G[0], NULL},
    {"SR32", 1, 5, 3, 2, 2, rk__sr32_c, rk__sr32_W[0], rk__sr32_G[0], NULL},
    {"SR43", 1, 7, 4, 3, 2, rk__sr43_c, rk__sr43_W[0], rk__sr43_G[0], NULL},
    {"MERK21", 2, 3, 2, 1, 0, rk__merk21_c, NULL, NULL, rk__merk21_g},
    {"MERK32", 2, 4, 3, 2, 0, rk__merk32_c, NULL, NULL, rk__merk32_g},
    {"MERK43", 2, 7, 4, 3, 0, rk__merk43_c, NULL, NULL, rk__merk43_g},
    {"MERK54", 2, 11, 5, 4, 0, rk__merk54_c, NULL, NULL, rk__merk54_g},
};

/* clang-format on */

RK_API const rk_coupling *rk_coupling_list(int i)
{
    return i >= 0 && i < (int)(sizeof rk__couplings / sizeof *rk__couplings) ? rk__couplings + i : NULL;
}

RK_API const rk_coupling *rk_coupling_find(const char *name)
{
    int i;
    for (i = 0; name && rk_coupling_list(i); i++)
        if (strcmp(rk_coupling_list(i)->name, name) == 0) return rk_coupling_list(i);
    return NULL;
}

static int rk__no_coupling(const rk_coupling *C, int i)
{
    int g, first = 1;
    if (!C || !C->c || !(C->form >= 0 && C->form <= 2) || !(C->stages >= 2 && C->stages <= RK_STAGES_MAX)) return 1;
    if (!(i >= 1 && i <= C->stages) || (C->form == 1 && !C->G)) return 1;
    if (C->form < 2) return !C->W || !(C->powers >= 1 && C->powers <= RK_ORDER_MAX);
    if (!C->groups) return 1;
    for (g = 0; C->groups[g] > 0 && C->groups[g] < RK_ORDER_MAX && first < C->stages; g++) first += C->groups[g];
    return first != C->stages || C->groups[g] != 0; /* groups of 1 to 9 that cover the stages */
}

/* The first stage of the group of stage i, and of the group before (0: none); the embedded row belongs to the group
   before the last. */
static int rk__group(const rk_coupling *C, int i, int *before)
{
    int g, first = 1;
    if (i == C->stages) i = C->stages - 2;
    for (g = 0, *before = 0; first + C->groups[g] <= i; g++) {
        *before = first;
        first += C->groups[g];
    }
    return first;
}

static int rk__from(const rk_coupling *C, int i)
{
    int before;
    if (C->form == 1) return 0;
    if (C->form == 0 || i == C->stages) return i == C->stages ? i - 2 : i - 1;
    return rk__group(C, i, &before) == i ? 0 : i - 1;
}

RK_API int rk_coupling_from(const rk_coupling *C, int i)
{
    return rk__no_coupling(C, i) ? RK_EARG : rk__from(C, i);
}

RK_API double rk_coupling_time(const rk_coupling *C, int i)
{
    if (rk__no_coupling(C, i == 0 ? 1 : i)) return DBL_MAX;
    return i == C->stages ? 1 : C->c[i];
}

/* The forcing of stage i times d, power k of its tau on slope j at P[k*stages + j].  Returns the number of powers. */
static int rk__forcing(const rk_coupling *C, int i, double *P)
{
    const int s = C->stages, from = rk__from(C, i);
    const double d = rk_coupling_time(C, i) - C->c[from];
    double x[RK_ORDER_MAX], p[RK_ORDER_MAX];
    int j, k, before, nodes;
    memset(P, 0, (size_t)(s * RK_ORDER_MAX) * sizeof *P);
    if (d == 0) return 0;
    if (C->form < 2) {
        for (k = 0; k < C->powers; k++)
            for (j = 0; j < i; j++) P[k * s + j] = C->W[(k * s + i - 1) * s + j];
        return C->powers;
    }
    nodes = rk__group(C, i, &before); /* the polynomial through the slopes of y and of the group before */
    nodes = before ? 1 + nodes - before : 1;
    for (j = 0; j < nodes; j++) x[j] = ((j ? C->c[before + j - 1] : 0) - C->c[from]) / d;
    for (j = 0; j < nodes; j++) {
        rk__lagrange_powers(nodes, x, j, p);
        for (k = 0; k < nodes; k++) P[k * s + (j ? before + j - 1 : 0)] = d * p[k];
    }
    return nodes;
}

RK_API int rk_coupling_forcing(const rk_coupling *C, int i, double *weight)
{
    int k, powers;
    double d;
    if (rk__no_coupling(C, i) || !weight) return RK_EARG;
    powers = rk__forcing(C, i, weight);
    d = rk_coupling_time(C, i) - C->c[rk__from(C, i)];
    for (k = 0; k < powers * C->stages; k++) weight[k] /= d;
    return powers;
}

RK_API int rk_coupling_jump(const rk_coupling *C, int i, double *weight)
{
    int j, k, s;
    if (rk__no_coupling(C, i) || !weight) return RK_EARG;
    s = C->stages;
    for (j = 0; j < s; j++) {
        weight[j] = C->form == 1 ? C->G[(i - 1) * s + j] : 0;
        for (k = 0; C->form == 0 && rk_coupling_time(C, i) == C->c[rk__from(C, i)] && k < C->powers; k++)
            weight[j] += C->W[(k * s + i - 1) * s + j] / (k + 1);
    }
    return RK_OK;
}

#define RK__DEGREE (6 * RK_ORDER_MAX + 4) /* order 6: at most five children of that many powers, and the integrals */

/* B-series coefficients of all stages for the coloured tree t (0 fast, 1 slow, explicit where split, 2 slow implicit): a
   polynomial in tau along each fast solve, a jump after it.  size: with absolute values throughout.  value[vertex][stage]. */
static void rk__coupling_series(const rk_coupling *C, const rk__tree *t, int size, double value[][RK_STAGES_MAX + 1])
{
    double P[RK_STAGES_MAX * RK_ORDER_MAX], g[RK_STAGES_MAX], p[RK_ORDER_MAX][RK__DEGREE], q[RK__DEGREE], product;
    int degree[RK_ORDER_MAX], i, j, k, l, v, c, powers, last;
    for (v = 0; v < t->n; v++) value[v][0] = 0;
    for (i = 1; i <= C->stages; i++) {
        const int from = rk__from(C, i);
        const double d = rk_coupling_time(C, i) - C->c[from];
        powers = rk__forcing(C, i, P);
        rk_coupling_jump(C, i, g);
        for (j = 0; size && j < C->stages; j++) {
            g[j] = fabs(g[j]);
            for (k = 0; k < powers; k++) P[k * C->stages + j] = fabs(P[k * C->stages + j]);
        }
        for (v = t->n - 1; v >= 0; v--) {
            memset(p[v], 0, sizeof p[v]);
            if (t->colour[v] == 0) { /* v' = d times the product of the children's polynomials */
                p[v][0] = d;
                degree[v] = 0;
                for (c = v + 1; c < t->n; c++) {
                    if (t->level[c] != t->level[v] + 1 || rk__tree_parent(t, c) != v) continue;
                    memset(q, 0, sizeof q);
                    for (k = 0; k <= degree[v]; k++)
                        for (l = 0; l <= degree[c]; l++) q[k + l] += p[v][k] * p[c][l];
                    degree[v] += degree[c];
                    memcpy(p[v], q, sizeof q);
                }
            } else degree[v] = powers ? powers - 1 : 0;
            last = i < C->stages ? i : i - 1; /* the embedded row has no slope of its own */
            for (j = 0; t->colour[v] != 0 && j < i; j++) {
                for (product = 1, c = v + 1; c < t->n; c++)
                    if (t->level[c] == t->level[v] + 1 && rk__tree_parent(t, c) == v) product *= value[c][j];
                for (k = 0; k < powers; k++) p[v][k] += P[k * C->stages + j] * product;
            }
            for (k = ++degree[v]; k >= 1; k--) p[v][k] = p[v][k - 1] / k; /* integrate, from the value at the start */
            p[v][0] = value[v][from];
            value[v][i] = 0;
            for (k = degree[v]; k >= 0; k--) value[v][i] += p[v][k];
            for (j = 0; t->colour[v] == (C->form == 1 ? 2 : 1) && j <= last; j++) {
                for (product = 1, c = v + 1; c < t->n; c++)
                    if (t->level[c] == t->level[v] + 1 && rk__tree_parent(t, c) == v) product *= value[c][j];
                value[v][i] += g[j] * product;
            }
        }
    }
}

RK_API double rk_defect_coupling(const rk_coupling *C, int hat, int order)
{
    double value[RK_ORDER_MAX][RK_STAGES_MAX + 1], size[RK_ORDER_MAX][RK_STAGES_MAX + 1], worst = 0;
    int row;
    rk__tree t;
    if (rk__no_coupling(C, 1) || !(order >= 1 && order <= 6)) return DBL_MAX;
    row = hat ? C->stages : C->stages - 1;
    rk__tree_first(&t, order);
    do {
        const double target = 1 / rk__tree_gamma(&t);
        double residual;
        rk__coupling_series(C, &t, 0, value);
        rk__coupling_series(C, &t, 1, size);
        residual = fabs(value[0][row] - target) / fmax(size[0][row], target);
        if (!rk__finite(residual)) return DBL_MAX;
        if (residual > worst) worst = residual;
    } while (rk__tree_next(&t, C->form == 1 ? 3 : 2));
    return worst;
}

/* ---- version and messages ---------------------------------------------------------------------------------------- */

RK_API int rk_version(void)
{
    return RK_VERSION;
}

RK_API const char *rk_message(int status)
{
    switch (status) {
    case RK_OK:
        return "done";
    case RK_EXTRAP:
        return "done; theta lies outside the step, the polynomial was continued";
    case RK_NONFINITE:
        return "done; the result holds Inf or NaN: a slope did, or the result overflows";
    case RK_EARG:
        return "an argument is NULL, NaN, negative or out of range";
    case RK_ENODENSE:
        return "this table has no dense output; rk_extend derives one";
    case RK_ENOPAIR:
        return "this table has no embedded weights, so there is no error estimate";
    case RK_ROWSUM:
        return "done; c is not the row sums of A, but the order holds for time-dependent problems too";
    case RK_LOWER:
        return "done; the dense output has a lower order than asked for, see dense_order";
    case RK_REJECT:
        return "the error is too large or not finite: repeat the step with the new size";
    case RK_ETABLE:
        return "the table holds NaN or Inf, claims an order it cannot have, or uses extra stages in the step";
    case RK_EORDER:
        return "b does not have the order the table claims";
    case RK_EHAT:
        return "bhat does not have the order the table claims";
    case RK_EDENSE:
        return "the dense output does not have the order the table claims, or does not end in b";
    case RK_ETINY:
        return "the next step is too small to move t";
    case RK_EMEM:
        return "the memory is missing, smaller than rk_size, or not aligned for double";
    }
    return "not a status of rk.h";
}

#ifdef __cplusplus
}
#endif
#endif /* RK_IMPLEMENTATION */

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
