/* SPDX-License-Identifier: MIT

   rk.h - v0.2.0 - Runge-Kutta tables, each verified by its own order conditions, with dense
   output for every one

   In *one* C or C++ file, before the include:

      #define RK_IMPLEMENTATION
      #include "rk.h"

   Elsewhere just include it.  C99, or C++11 and later; needs libc and libm.  Never allocates,
   prints, aborts or keeps a global (but const tables).  The time loop stays yours: you evaluate f
   and solve implicit stages; the header forms every sum over long vectors.

   SYNOPSIS

   An adaptive run of y' = f(t, y) from t to t1; n unknowns, slope i is kept at k + i*n:

      const rk_table *T = rk_find("dp5");
      rk_control C;
      double h = 1e-3 * (t1 - t), sum[4];                   // or rk_first_step, see there
      int i, status = rk_control_make(&C, "PI", T);

      C.stop = t1;
      f(t, y, k);                                           // slope 0
      while (t < t1) {
          for (i = 1; i < T->stages; i++) {
              rk_stage(T, i, h, n, y, k, n, z);             // z = y + h sum_{j<i} a_ij k_j
              f(t + T->c[i] * h, z, k + i * n);             // k_i
          }
          rk_finish(T, h, n, y, k, n, ynew, err);           // y + h sum b_j k_j, and its error
          memset(sum, 0, sizeof sum);
          rk_norm(1e-6, 1e-9, NULL, n, err, y, ynew, sum);  // add the sums of all ranks here
          status = rk_control_step(&C, rk_rms(sum), &t, &h); // moves t, or not; the next h
          if (status < 0) break;                            // RK_ETINY: it cannot go on
          if (status == RK_REJECT) continue;                // y and slope 0 stay
          memcpy(k, k + (T->stages - 1) * n, n * sizeof *k); // FSAL: the last slope is the next 0
          memcpy(y, ynew, n * sizeof *y);
      }

   Without FSAL (rk_is), evaluate f(t, ynew, k) in place of the first memcpy.  k holds (T->stages +
   T->extra)*n numbers.  Dense output belongs between RK_REJECT and the two memcpy, which overwrite
   the y and the slope 0 that it reads: with t0 and h0 kept from before rk_control_step,
   rk_step s = {T, h0, n, y, k, n}, and rk_dense(&s, 0.3, 0, v) is y(t0 + 0.3 h0);
   rk_dense(&s, 0.3, 1, v) is y' there.  dop853: rk_companion between rk_norm and rk_control_step.

   RECIPES
      Implicit stages (rk_is RK_SEQUENTIAL, not RK_EXPLICIT): t_i = t + c_i h, a_ii = T->A[i*m + i]
         with m = stages + extra, J the Jacobian of f, base = z of rk_stage.  a_ii = 0: k_i = f(t_i,
         base).  Else solve Z = base + h a_ii f(t_i, Z), by Newton's method with I - h a_ii J, and
         take k_i = (Z - base)/(h a_ii), not f(t_i, Z), which would multiply the error of the solve
         by h lambda, lambda an eigenvalue of J.  All a_ii != 0 of a stored table are equal (only
         wso3 has four different ones), so that one factorisation serves the step.  Without RK_FSAL,
         i runs from 0 and no slope is known beforehand.
         With a mass matrix M y' = f solve M (Z - base) = h a_ii f(t_i, Z) by M - h a_ii J; M never
         has to be inverted but for an explicit first slope.
      Solve failed: call rk_control_step with an error of HUGE_VAL.  It rejects the step and
         multiplies h by `shrink`, 0.1.
      IMEX, y' = fE + fI: tables E and I of the same c, slopes kE and kI: rk_stage(E, .., y, kE, n,
         z), then rk_stage(I, .., z, kI, n, z) gives base; solve Z = base + h a_ii fI(t_i, Z) with
         a_ii of I; kI_i = (Z - base)/(h a_ii), kE_i = fE(t_i, Z).  ynew: rk_finish of E, then of I
         with that result as its y; err = errE + errI.
         Slope 0 of the next step: ars* have RK_FSAL in both halves.  Of ark* evaluate fE(t, y) and
         fI(t, y) anew: the last row of their explicit A is not b, so y is not the last stage value,
         though rk_is says RK_FSAL of the implicit one.  (The last kI in place of fI(t, y) costs
         ark3 one order.)  Control (only ark* have a pair): rk_control_make with I.
         Dense output of a value: rk_dense of E, then of I with the first result as its y; of a
         derivative: the sum of both.
      Extra stages (index >= stages: verner6, dop853) serve dense output only: compute them as the
         others before rk_dense, which reads stages + extra slopes.
      Predictor of stage i of the next step, of size h2: rk_dense at theta = 1 + c_i h2/h.
      One component: n = 1, y + i, k + i with the same ldk.  So an event is found without touching
         the rest: a root theta* of g(theta), g from rk_dense of the component.  If theta* <= 1, end
         the step there (examples/bounce.c): y from rk_dense at theta*, t = t0 + theta* h0, slope 0
         evaluated anew, for the last slope belongs to t0 + h0.  Or take t, h and C back to what
         they were before rk_control_step and repeat with h = theta* h0.
         Ahead (theta* > 1, a prediction): rk_control_stop(&C, t0 + theta* h0, t, &h); C.stop alone
         does not cut the h at hand.  If the event changes y or f, call rk_control_make anew: its
         history no longer applies.
      A waveform from a step (waveform.h): both ends and dense_order - 1 values inside.  Add slopes
         f(t, y) only if the problem is not stiff, for f multiplies errors by lambda.
      Error of the dense output, one or two evaluations: at each theta of TABLES (`at`) take u
         and v = rk_dense of deriv 0 and 1 and form D = h (v - f(t + theta h, u)); of an implicit
         table filter it: replace D by the solution x of (I - h a_ii J) x = D, the matrix of the
         last stage.  The estimate is the larger |D| divided by the last number of `at`: in nine of
         ten steps of each of eight problems it was 0.19 to 2.0 times the true error.
         The embedded estimate describes only the end of the step.  Filtered by such a solve, it
         alone lets the inside be wrong by 1e4 to 2e5 tolerances.  So control a stiff problem that
         writes waveforms by the larger of the filtered embedded estimate and the dense one.  On
         Prothero-Robinson (esdirk5, lambda -1e6, tolerance 1e-6) this took 48 steps, with the error
         inside below the tolerance; the unfiltered embedded estimate took 149.  These numbers:
         tests/study/study_dense.c.
         Always filter the embedded estimate of sdirk2, sdirk4, trbdf2, esdirk5, ark2i, ark3i and
         ark5i: unfiltered it does not tend to 0 for lambda -> -infinity, it only stays bounded.

   COMPILE-TIME OPTIONS, before the include, the same in every file
      RK_STATIC   every function private to the including file, for a library that embeds this one:
                  define RK_IMPLEMENTATION in every file that includes it
      RK_API      decoration of the public functions, e.g. __declspec(dllexport); default extern

   THE MATHEMATICS
      k_i = f(t + c_i h, y + h sum_j a_ij k_j),  ynew = y + h sum_i b_i k_i,
      y(t + theta h) ~ u(theta) = y + h sum_i b_i(theta) k_i,  b_i(theta) = sum_r d_ir theta^r.
      Order p: sum_i b_i Phi_i(x) = 1/gamma(x) for every rooted tree x of |x| <= p vertices; Phi_i
      is its elementary weight, gamma its density.  Uniform order q of the dense output u, whose
      error inside the step then is O(h^(q+1)): sum_i d_ir Phi_i(x) = 1/gamma(x) if r = |x|, else 0,
      for every power r and |x| <= q.  Trees are generated, not typed in, coloured ones for additive
      methods.
      A dense output of order p - 1 is enough for a method of order p in a converged waveform
      iteration: sample it at p or more points per step, ends included, and interpolate with degree
      p - 1.  (Linear interpolation gives order 2 whatever the method.)
      Stiff problems: let R(z, theta) be the value at theta for y' = lambda y with z = h lambda and
      y = 1.  Every stored implicit table keeps |R(z, theta)| within the bound of TABLES in the
      whole left half-plane; cubic Hermite interpolation does not: z = -1e7 turns an error of 1e-8
      in y into 1.5e-2.  The stiff order q_s: for lambda -> -infinity the error inside the step is
      O(h^q_s), whatever the uniform order is.

      Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I (1993): order conditions,
      dop853, first step.  Hairer & Wanner, the same II (1996): collocation, sdirk4.  Beyer &
      Hedetniemi, SIAM J. Comput. 9 (1980): the trees.  Zennaro, Math. Comp. 46 (1986): dense output
      of rk4.  Kraaijevanger, BIT 31 (1991): contractivity.  Kennedy & Carpenter (KC), Appl. Numer.
      Math. 44 (2003), NASA/TM-2016-219173, Appl. Numer. Math. 136 (2019): ark*, esdirk*.
      Soderlind, ACM Trans. Math. Softw. 29 (2003): the form of step control, H0211 to H312.
      Gustafsson, the same 17 (1991) and 20 (1994): "explicit" and "implicit".  Knoth & Wolke, Appl.
      Numer. Math. 28 (1998): KW3, rk_mis.  Sexton & Reynolds, arXiv 1808.03718: RK_RELAXED.  Sandu,
      SIAM J. Numer. Anal. 57 (2019): MRI-GARK.  Fish, Reynolds & Roberts, J. Comput. Appl. Math.
      438 (2024): IMEX-MRI-SR.  Luan, Chinomona & Reynolds, SIAM J. Sci. Comput. 42 (2020): MERK.
      Dense outputs: dp5 Shampine, Math. Comp. 46 (1986); tsit5 and dop853 their authors'; bs3 and
      ss4 the cubic Hermite.  All others but rk4's are this library's own, by the least
      squares of rk_extend (verner6 and ars* with further conditions).

   TABLES
      s: stages; p: order; pair: order of the embedded weights; dense: uniform order; C1 where u' is
      continuous from step to step; stability: L-stable, A-stable, or X,Y: |R| <= 1 on [-X,0] and
      i[-Y,Y]; bound: largest |R(z, theta)| in the left half-plane; stiff: order
      inside a stiff step; at: the one or two thetas of the dense error estimate, then the number
      that |D| is divided by; SSP: coefficient of strong stability preservation.
      name       s p pair dense stability bound stiff at
     | euler      1 1 -  1 C0  2.00,0.00  -     -  .05 .35 1  Euler 1768
     | heun       2 2 1  2 C0  2.00,0.00  -     -  .20 .60 1  Heun 1900, SSP 1
     | midpoint   2 2 1  2 C0  2.00,0.00  -     -  .45 .65 2  Runge 1895
     | kutta3     3 3 -  2 C0  2.51,1.73  -     -  .05 .95 6  Kutta 1901
     | ssp33      3 3 2  2 C0  2.51,1.73  -     -  .30 .65 2  Shu & Osher 1988, SSP 1; pair 1/3 each
     | ssp43      4 3 2  3 C0  5.15,2.16  -     -  .45 .75 3  Kraaijevanger 1991, SSP 2
     | ssp104    10 4 3  3 C0  13.92,4.92 -     -  .10 .15 2  Ketcheson 2008, SSP 6
     | bs3        4 3 2  3 C1  2.51,1.73  -     -  .40 .65 2  Bogacki & Shampine 1989
     | rk4        4 4 -  3 C0  2.79,2.83  -     -  .25 .80 3  Kutta 1901
     | ss4        5 4 3  3 C1  2.79,2.83  -     -  .05 .35 2  Sofroniou & Spaletta 2004
     | dp5        7 5 4  4 C1  3.31,1.00  -     -  .20 .35 4  Dormand & Prince 1980
     | tsit5      7 5 4  4 C1  3.51,0.48  -     -  .20 .40 4  Tsitouras 2011
     | verner6    9 6 5  5 C1  4.32,0.00  -     -  .15 .25 4  Verner 2010, "robust"; dense: 1 more
     | dop853    12 8 5  7 C1  6.39,5.96  -     -  .35 .90 7  Hairer et al. 1993; dense: 4 more
     | beuler     1 1 -  1 C0  L          1.000 2  .55     1  implicit Euler
     | imidpoint  1 2 -  1 C0  A          1.000 2  .05 .90 3  implicit midpoint rule
     | trapezoid  2 2 -  1 C0  A          1.000 2  .30     2  trapezoidal rule
     | sdirk2     2 2 1  1 C0  L          1.000 3  .45 .85 3  Alexander 1977, pair of Ellsiepen 1999
     | trbdf2     3 2 1  2 C0  L          1.000 3  .10 .60 2  Bank et al. 1985
     | esdirk3    5 3 2  2 C0  L          1.000 4  .10 .80 3  ESDIRK3(2)5L[2]SA, KC 2016
     | esdirk4    6 4 3  3 C0  L          1.005 4  .85 .90 3  ESDIRK4(3)6L[2]SA
     | esdirk4b   7 4 3  3 C0  L          1.013 4  .35 .60 4  ESDIRK4(3)7L[2]SA, error 1/7 of that
     | esdirk5    7 5 4  4 C0  L          1.020 4  .65 .90 4  ESDIRK5(4)7L[2]SA2, KC 2019
     | sdirk4     5 4 3  3 C0  L          1.005 3  .60 .85 3  Hairer & Wanner 1996; all implicit
     | wso3       4 3 -  3 C0  L          1.002 4  .15 .95 .4 weak stage order 3: moving boundaries
     | ars222e    3 2 -  2 C0  2.00,0.00  -     -  .05 .60 2  IMEX halves: Ascher et al. 1997
     | ars222i    3 2 -  2 C0  L          1.000 2  .15 .45 2
     | ars443e    5 3 -  3 C0  2.14,1.57  -     -  .10 .70 2
     | ars443i    5 3 -  3 C0  L          1.003 2  .20 .80 2
     | ark2e      3 2 1  2 C0  2.51,1.73  -     -  .20 .60 2  Giraldo, Kelly & Constantinescu 2013
     | ark2i      3 2 1  2 C0  L          1.000 3  .10 .60 2  = trbdf2
     | ark3e      4 3 2  2 C0  3.66,2.48  -     -  .10 .30 4  ARK3(2)4L[2]SA, KC 2003
     | ark3i      4 3 2  2 C0  L          1.000 3  .15 .80 2
     | ark4e      7 4 3  3 C0  6.76,4.70  -     -  .25 .80 4  ARK4(3)7L[2]SA, KC 2019
     | ark4i      7 4 3  3 C0  L          1.062 3  .45 .60 4
     | ark5e      8 5 4  3 C0  3.86,0.00  -     -  .05 .95 9  ARK5(4)8L[2]SAb
     | ark5i      8 5 4  3 C0  L          1.022 4  .75 .90 5
      generated: Gauss, Radau IIA, Lobatto IIIA, IIIB, IIIC of up to 5 stages (rk_collocation)
      multirate: KW3 ERK22a ERK33a ERK45a IRK21a ESDIRK34a ESDIRK46a (MIS, MRI-GARK), SR21 SR32
                 SR43 (IMEX-MRI-SR), MERK21 MERK32 MERK43 MERK54 (rk_coupling_find)

   DOES NOT
      step, solve, allocate, find roots, handle events or mass matrices, or estimate spectral radii.
      There are no Rosenbrock, stabilised (RKC, ROCK) or low-storage methods, and no method of order
      above 8 but the generated gauss5 (10) and radauIIA5 (9).

   LIMITATIONS
      Generated tables of s stages have dense order s, IIIB s - 1.  That is less than p - 1 for
      Gauss from 2 stages on, Radau IIA and IIIB from 3, IIIA and IIIC from 4.  A converged waveform
      iteration that samples rk_dense at p points still has order p where all parts take the same
      steps, else dense order + 1 or more.  Do not sample the stage values in its place: with
      unequal steps that is order 2 for gauss2 and lobattoIIIB3.
      Of the stored tables only ark5e and ark5i, dense order 3, have less than p - 1.
      The dense output of Lobatto IIIA is not bounded for stiff parts.  Where all stages are coupled
      rk_extend cannot prove a bound: it says RK_UNBOUNDED, bounded or not.  A stiff component that
      is off its slow solution is bounded inside the step, not exact.
      A table with an a_ij or b_i beyond 1e5 cannot be proven in double precision: rk_check refuses.
      A partial sum that overflows, or a term that would (up to 1e327), is caught and redone scaled;
      h times a weight must itself be representable.  NaN and Inf in data stay in their element and
      are reported: RK_NONFINITE.
      Round-off of long runs (rk4, y'' = -y, steps of 1e-4): 5e-14 after 1e6 steps, 4e-13 after 1e7;
      with compensated sums of the increments (rk_combine with y NULL) 5e-15 and 5e-14.  Form the
      time of equal steps as t0 + i*h: after 1e6 additions of 1e-3 it is off by 1.7e-8.

   DETERMINISM
      Every sum over slopes has a fixed order that does not depend on n, alignment, aliasing or the
      processor, whose vectors of two, four or eight numbers are chosen at run time (gcc, clang).
      That of rk_norm depends on n, on whether there are sizes, and on which blocks of 256 numbers
      have a sum of squares too small or too large to be taken at once.  Bits change with
      contraction to fused multiply-adds: -march=native, -ffp-contract, and by default on ARM.
      (clang on ARM fuses no sum over slopes, unless it had to be repeated scaled.)  They change
      with -ffast-math, too.  Under it, and with products fused by gcc, they may depend on n and on
      whether out is y.  With fused products or -ffast-math three promises are weaker.  rk_extend
      with added stages may reach another order.  rk_dense at theta = 1 gives the bits of rk_finish
      only if out is y in both or in neither.  rk_dense_many of several thetas may differ from
      rk_dense.

   THREADS
      No state: any number of threads may call anything on their own arrays and read the same
      tables.

   LICENSE
      MIT; full text and version history at the end of the file.  */

/* not RK_H or RK_H_INCLUDED: the rk.h of another project may use them */
#ifndef RK_H_INCLUDED_TABLES
#define RK_H_INCLUDED_TABLES
#define RK_VERSION 200 /* 10000*major + 100*minor + patch */

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
#define RK_TOLERANCE  2.2e-14 /* a defect above this, 100 rounding errors, is a wrong table */

/* Status: 0 done; above RK_REMARK done, with a remark (RK_REJECT: the step was judged and has to be
   repeated); < 0 nothing done, nothing touched but *defect of the checks and mem of rk_extend.
   rk_is, rk_estimate, rk_coupling_from and rk_coupling_forcing return a number below RK_REMARK, or
   a negative status.  A function that returns a double, a size or a pointer says a bad argument by
   NaN, 0 or NULL, unless its comment says otherwise.  Numbers do not change from 0.2.0 on: hosts in
   other languages carry them by value, and new ones are added at the end. */
#define RK_STATUSES(STATUS)                                                                        \
    STATUS(RK_OK, 0, "done")                                                                       \
    STATUS(RK_EXTRAP, 301, "done; theta lies outside the step, the polynomial was continued")      \
    STATUS(RK_NONFINITE, 302, "done; Inf or NaN in the result: from y, a slope or an overflow")    \
    STATUS(RK_ROWSUM, 303, "done; c is not the row sums of A, yet the order holds with time too")  \
    STATUS(RK_LESS, 304, "done; less than the order asked for was possible, see dense_order")      \
    STATUS(RK_REJECT, 305, "the error is too large or not finite: repeat the step with the new h") \
    STATUS(RK_UNBOUNDED, 306, "done; the dense output is not proven bounded for stiff parts")      \
    STATUS(RK_EARG, -301, "a count, index, order, stride, size, kind or number is out of range")  \
    STATUS(RK_EMEM, -302, "the memory is missing, too small, or not aligned to 8 bytes")           \
    STATUS(RK_ETIMES, -303,                                                                        \
           "the times c fall, lie beyond 1, do not begin at 0 or (relaxed) do not end at 1")       \
    STATUS(RK_ENULL, -304, "a pointer is NULL")                                                    \
    STATUS(RK_ENAN, -305, "a step size, time, theta or tolerance is NaN or infinite")              \
    STATUS(RK_ENAME, -306, "there is no step control of that name")                                \
    STATUS(RK_EOVERLAP, -307, "the memory holds an array of the table itself")                     \
    STATUS(RK_ENODENSE, -308, "this table has no dense output; rk_extend derives one")             \
    STATUS(RK_ENOPAIR, -309, "this table has no embedded weights, so no error estimate")           \
    STATUS(RK_ETABLE, -310,                                                                        \
           "NaN or Inf in the table, A or b beyond 1e5, claims that clash, or the step takes an "  \
           "extra stage")                                                                          \
    STATUS(RK_ESTEP, -311, "the weights of the step, b, do not have the order that is claimed")    \
    STATUS(RK_EPAIR, -312, "embedded weights (a table's: bhat, e, e3) lack the order claimed")     \
    STATUS(RK_EDENSE, -313, "the dense output does not have its order, or does not end in b")      \
    STATUS(RK_ETINY, -314, "the step is as small as it can be, and its error too large")           \
    STATUS(RK_EOTHER, -315, "the two halves do not fit: other numbers of stages, claims or b")     \
    STATUS(RK_EEXPLICIT, -316, "the outer table must be explicit and begin at time 0")

#define RK__ENUM(name, value, text) name = value,
enum { RK_REMARK = 300, RK_STATUSES(RK__ENUM) };

/* ---- tables ---------------------------------------------------------------------------------- */

/* A table is plain data: add your own.  m = stages + extra; all arrays are stored row by row.
   stages and order are at least 1.  order_hat, extra or dense_stiff 0 claims nothing; powers and
   dense_order are both 0 (no dense output) or neither. */
typedef struct rk_table {
    const char *name;
    int stages;           /* s, the slopes of one step */
    int order, order_hat; /* of b and of bhat; order_hat 0: no embedded weights */
    int powers;           /* of theta in d, theta^1 to theta^powers; 0: no dense output */
    int dense_order;      /* uniform order of the dense output in theta */
    int extra;            /* more stages that only the dense output needs; usually 0 */
    const double *A;      /* [m*m], a_ij at A[i*m + j] */
    const double *b, *c;  /* [m], [m]; b_i = 0 for the extra stages */
    const double *bhat;   /* [m], likewise, embedded weights, or NULL if order_hat is 0 */
    const double *e;      /* [s], b - bhat rounded once, or NULL: formed from b and bhat */
    const double *d;      /* [m*powers], b_i(theta) = sum_j d[i*powers + j] theta^(j+1), or NULL */
    const double *e3;     /* [s], b less weights of order 3 (dop853), for rk_companion; or NULL */
    int dense_stiff;      /* stiff order, >= 2, see THE MATHEMATICS; 0: no claim.  Only for an A
                             that begins with rows of zeros (or none), with c_i = 0 there, and is
                             lower triangular with a_ii > 0 in all other rows */
} rk_table;

RK_API const rk_table *rk_find(const char *name); /* NULL if there is none */
RK_API const rk_table *rk_list(int i);            /* i = 0, 1, ...; NULL at the end */

/* Implicit methods of 1..5 stages (Lobatto: 2..5).  The stages are all coupled, but in the four
   that are RK_SEQUENTIAL: gauss1, radauIIA1, lobattoIIIA2, lobattoIIIB2.  The arrays of T lie in
   mem, which must be aligned to 8 bytes and outlive *T, bytes >= rk_size(stages, stages).  Order
   2s, 2s-1, 2s-2 for Gauss, Radau, Lobatto; the dense output is the integral of the polynomial
   through the slopes, of order s (IIIB: s-1).  T->name is "gauss2", "radauIIA3" and so on (rk_find
   has only stored ones).  They have no embedded weights, so no error estimate.  Stiff problems:
   take k from A k = (Z - y)/h; of IIIA and IIIB, whose A is singular, from f(Z_i).
   RK_ENULL, RK_EARG, RK_EMEM. */
enum { RK_GAUSS = 1, RK_RADAU_IIA, RK_LOBATTO_IIIA, RK_LOBATTO_IIIB, RK_LOBATTO_IIIC };
RK_API int rk_collocation(rk_table *T, int family, int stages, void *mem, size_t bytes);

/* Bytes for a table of that many stages with a dense output of that order, rk_extend's work
   included (for rk_extend with order 0 pass RK_ORDER_MAX); 0: bad arguments. */
RK_API size_t rk_size(int stages, int order);

/* ---- a step ---------------------------------------------------------------------------------- */
/* In all of these: n numbers per vector (0 is allowed), slope j at k + j*ldk with ldk >= n; h is
   finite and may be negative.  Outputs and inputs are apart from each other, which is not checked;
   where it says so, out may be y.  RK_NONFINITE: the result overflows, or y or a slope is not
   finite (a slope with h*weight = 0 does not count); the result is written all the same.  NULL is
   allowed for every vector if n = 0, for k of stage 0 and of 0 slopes, and for y of rk_finish
   without ynew.
   RK_ENULL, RK_EARG, RK_ENAN (h). */

/* z = y + h sum_{j<i} a_ij k_j, for i < stages + extra; z may be y.  Where a_ii != 0 the stage is
   implicit and z its base: see RECIPES.  A table that is not RK_SEQUENTIAL wants rk_stages.  A
   slope that is not finite is reported by every later call that reads it. */
RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y,
                    const double *k, ptrdiff_t ldk, double *z);

/* z_i = y + h sum_j a_ij k_j over *all* j, for every stage i < stages: for tables that are not
   RK_SEQUENTIAL, whose slopes k_i = f(t + c_i h, z_i) are solved together; z_i at z + i*ldz, ldz >=
   n. */
RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k,
                     ptrdiff_t ldk, double *z, ptrdiff_t ldz);

/* ynew = y + h sum b_j k_j and err = h sum (b_j - bhat_j) k_j, in units of y, either of them NULL
   when not wanted; ynew may be y.  Also RK_ENOPAIR (err wanted). */
RK_API int rk_finish(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k,
                     ptrdiff_t ldk, double *ynew, double *err);

/* out = y + h sum_{j<slopes} weight_j k_j, slopes <= RK_STAGES_MAX: the sum behind all of these.
   Where h*weight_j is 0 slope j is not read; y NULL for none, out may be y. */
RK_API int rk_combine(double h, int slopes, const double *weight, ptrdiff_t n, const double *y,
                      const double *k, ptrdiff_t ldk, double *out);

/* ---- dense output ---------------------------------------------------------------------------- */

/* A step that was taken from y with size h, its stages + extra slopes at k + j*ldk: the struct
   only points. */
typedef struct rk_step {
    const rk_table *T;
    double h;
    ptrdiff_t n;
    const double *y, *k;
    ptrdiff_t ldk;
} rk_step;

/* deriv = 0: out = y(t + theta h); deriv = r: the r-th derivative in *time* there, y is not read;
   out may be y.  theta within 4 DBL_EPSILON of 0 or 1 counts as that end: deriv = 0 returns y or
   rk_finish's ynew bit for bit.  (With -ffast-math or fused products: if out is y in both or in
   neither.)  RK_EXTRAP: theta outside [0, 1] (a prediction; no setting makes it an error: there are
   none).  RK_EARG also for deriv > 1 if h = 0 or h^(-p) overflows, p = min(deriv - 1, powers).
   Else, for deriv > powers, the result is 0.
   RK_ENULL, RK_EARG, RK_ENAN, RK_ENODENSE, RK_EXTRAP, RK_NONFINITE. */
RK_API int rk_dense(const rk_step *s, double theta, int deriv, double *out);

/* The same at `count` thetas in one sweep over the slopes: out_l at out + l*ldout, ldout >= n; y, k
   and out apart from each other.  One status of rk_dense for all, RK_NONFINITE rather than
   RK_EXTRAP.  Nothing is written if one theta is refused.  RK_OK for count = 0. */
RK_API int rk_dense_many(const rk_step *s, int deriv, int count, const double *theta, double *out,
                         ptrdiff_t ldout);

/* (t - t0)/h with the round-off of the times removed: 0 or 1 when t is within 4 DBL_EPSILON
   max(|t0|, |t0 + h|) of that end, the nearer one if of both.  The host sees to times that are
   finite.  NaN: h is 0. */
RK_API double rk_theta(double t, double t0, double h);

/* The stages + extra weights behind rk_dense: the deriv-th derivative of b_i(theta), per unit of
   theta; not finite where a far theta overflows.  RK_ENULL, RK_EARG, RK_ENAN, RK_ENODENSE,
   RK_EXTRAP. */
RK_API int rk_weights(const rk_table *T, double theta, int deriv, double *weight);

/* Dense output derived for any table: *out is T with weights b_i(theta) of uniform order
   out->dense_order and, where T is implicit and they are bounded, stiff order out->dense_stiff.
   order > 0: that order, or else the next lower one that exists; of an implicit table each order is
   tried bounded, then unbounded.  order 0, explicit T: the highest order up to T->order: RK_OK.
   order 0, implicit T: T->order or T->order - 1, whichever is bounded.  If both are, the one with
   the higher stiff order; if these are equal, T->order.  If neither is, the highest lower order
   that is bounded: RK_OK, not RK_LESS.  If no order is bounded, the highest that exists:
   RK_UNBOUNDED.
   Bounded: |R(z, theta)| <= 1.1 at 65 even thetas of the step, for z = -infinity, 12 points of the
   imaginary axis, and i/a_jj for every implicit stage j.
      RK_OK         as asked for
      RK_LESS       of a lower order; bounded where T is implicit
      RK_UNBOUNDED  T is implicit and they are not bounded, or no proof exists for its form (stages
                    all coupled, an a_ii < 0, an explicit stage that is not f(t, y)).  The order
                    may be lower, too: see out->dense_order.  out->dense_stiff is 2 where a proof
                    exists for the form and R is at least finite at -infinity, else 0
   more: for an explicit T without `other`, up to so many (<= 9) stages are added to reach the
   order (T->order if 0): first the slope at ynew if T lacks it, then slopes at values of the dense
   output so far.  They stay even if the order is not reached.  For an implicit T, or with `other`,
   none is added.
   other: the other half of an IMEX method, with the same b, or NULL.  The conditions then hold for
   both, the bound for T: let T be the implicit half, and give the other one d, powers and
   dense_order of *out.
   bytes >= rk_size(T->stages + T->extra + more, order ? order : RK_ORDER_MAX); mem must be aligned
   to 8 bytes, hold no array of T or other, and outlive *out, which points into it and at T's
   name.  *out may be *T.  On failure *out is as it was, mem is not.
   RK_ENULL, RK_EARG, RK_EMEM, RK_EOVERLAP, RK_ETABLE, RK_EOTHER, RK_ESTEP (not even order 1:
   sum b_i is not 1), RK_LESS, RK_UNBOUNDED. */
RK_API int rk_extend(rk_table *out, const rk_table *T, const rk_table *other, int order, int more,
                     void *mem, size_t bytes);

/* ---- error norm and step control ------------------------------------------------------------- */

/* sum[0..2] += sums of (v_i/w_i)^2 with w_i = atol size_i + rtol max(|y0_i|, |y1_i|), sum[3] += n;
   sum[1] and sum[2] take ratios beyond 2^450 and below 2^-450, scaled: add them, do not read them.
   size NULL: all 1; an array of tolerances is size with atol = 1.  y1 may be NULL.  Set sum to
   zero before, add the four numbers of all ranks in any order; then rk_rms(sum) is the root mean
   square, in units of the tolerance.  No overflow or underflow inside, but w_i and v_i/w_i
   themselves must be representable; |size_i| counts; w_i = 0 counts 0 if v_i = 0 and else as
   infinite; NaN or Inf in v, y0, y1 or size gives an infinite rk_rms.
   RK_ENULL, RK_ENAN and RK_EARG (rtol, atol), RK_EARG (n). */
RK_API int rk_norm(double rtol, double atol, const double *size, ptrdiff_t n, const double *v,
                   const double *y0, const double *y1, double sum[4]);
RK_API double rk_rms(const double sum[4]); /* NaN: sum is NULL; of no numbers: 0 */

/* The error of a table with e3: `error` = rk_rms of rk_finish's err, `companion` = rk_rms of h
   sum e3_j k_j (rk_combine), gives error^2/sqrt(error^2 + companion^2/100), after Hairer.
   HUGE_VAL if one is not finite; NaN if one is negative. */
RK_API double rk_companion(double error, double companion);

/* The order of the error estimate: min(order, order_hat); with e3: 2 order_hat - 3 (dop853: 7), and
   the error then has to go through rk_companion (without it set C.order = 5 after
   rk_control_make).  RK_ENULL, RK_EARG, RK_ENOPAIR. */
RK_API int rk_estimate(const rk_table *T);

/* Step control, Soderlind's form.  e_n is the judged error of step n, in units of the tolerance.
   It falls as h^(q+1).  How e_n and q follow from the error handed over is said below.
      h_{n+1} = safety h_n e_n^(-k[0]/(q+1)) e_{n-1}^(-k[1]/(q+1)) e_{n-2}^(-k[2]/(q+1))
                (h_n/h_{n-1})^k[3] (h_{n-1}/h_{n-2})^k[4]
   over accepted steps.  Their count restarts behind a step that `stop` has cut to less than half.
   For the first one counted and for a rejected step: safety h_n e_n^(-1/(q+1)).  For the second
   e_{n-2} is e_{n-1}, and the last factor 1.  e_{n-1} and e_{n-2} count as at least `least`, e_n as
   it is.  A rejected step shrinks to at most 0.9 of its size, or to `smallest`.  When a repeated
   step is accepted, the next one is no larger, unless `stop` had cut it: then it may go back up to
   the size before the cut.
   Plain: e_n is the error, q = order.
   Calibrated (calibrate > 0, explicit tables): the estimate is of the lower order, and 3 to 50
   times the error of the step.  Set calibrate to the relative tolerance behind the error; then
   e_n = (error calibrate)^((order_calibrated+1)/(order+1))/calibrate, and q = order_calibrated.  No
   effect unless order_calibrated > order.
   Per unit step (length > 0): the tolerance is meant per `length` of time, so that the sum of local
   errors over it is the tolerance; e_n is multiplied by length/|h|, q is one less.
   After three rejections of one step in a row, as at a discontinuity, the error is not calibrated,
   q = order even if length > 0, length/|h| counts as at most 50, and each further one shrinks the
   step to at most `again` of its size.
   Fill it with rk_control_make, then change what you like; it is plain data, so memcpy it to repeat
   a window. */
typedef struct rk_control {
    double k[5];              /* the exponents of the law above */
    double safety;            /* 0.9 */
    double grow, first;       /* largest growth: 10; of the first step: 1e4.  After a step that
                                 `stop` had cut it may be more, back to the size before the cut */
    double shrink;            /* smallest factor: 0.1 */
    double again;             /* largest factor from the fourth failure in a row on: 0.3 */
    double accept;            /* largest judged error accepted: 1; HUGE_VAL: every finite one */
    double least;             /* what e_{n-1} and e_{n-2} are at least: 1e-4 */
    double stop;              /* until *t is there, to the bit, no t + h of rk_control_step and
                                 rk_control_stop is beyond it; NaN: none.  The first h is yours:
                                 rk_control_stop cuts it */
    double smallest, largest; /* of |h|; 0: no limit.  Where they clash smallest counts.  After an
                                 accepted step |h| is at least 4 DBL_EPSILON |t|, even above
                                 largest, so that it moves t.  Only the last two steps before
                                 `stop` may be below these bounds.  A step of at most smallest that
                                 is rejected gives RK_ETINY */
    double length, calibrate; /* see above; 0: off */
    int order;                /* of the estimate, rk_estimate */
    int order_calibrated;     /* of the step (explicit tables), used with calibrate */
    /* history, not to be set */
    double wanted;            /* the size before it was fitted to `stop`; 0: it was not */
    double e[2], h[2];        /* the last judged errors and steps; h 0: none */
    int steps, rejected;      /* accepted so far (or INT_MAX); rejected in a row, of this step */
} rk_control;

/* method: "I", "PI", "PID" (ARKODE's coefficients), "explicit" and "implicit" (Gustafsson),
   "H0211", "H0321", "H211", "H312" (Soderlind).  T: the table, which has a pair.
   RK_ENULL, RK_EARG, RK_ENOPAIR, RK_ENAME. */
RK_API int rk_control_make(rk_control *C, const char *method, const rk_table *T);

/* The same for any method whose error estimate has that order, 1 or more: min(order, order_hat) of
   a coupling.
   RK_ENULL, RK_EARG, RK_ENAME. */
RK_API int rk_control_order(rk_control *C, const char *method, int order);

/* Sets the stop time of the next interval (NaN: none).  Brings *h, the size to go on with from t,
   within smallest and largest, and cuts it so that the time is met.  A stop time that is not ahead
   of t counts as none; the one set before is forgotten all the same.  The size before the cut is
   kept: rk_control_step gives it back at the stop time, as far as the error allows.  If *h was cut,
   here or by rk_control_step, and that step has not been accepted yet, this call starts from the
   kept size in place of *h, unless *h now points the other way.
   RK_ENULL, RK_ENAN (t, h), RK_EARG (h is 0). */
RK_API int rk_control_stop(rk_control *C, double stop, double t, double *h);

/* After a step of size *h from *t with that error.  RK_OK: accepted, *t is the end of the step, *h
   the size of the next.  RK_REJECT: *t stays, *h is the size to repeat the step with; also for an
   error that is NaN or infinite, which says "the solve failed".  RK_ETINY: rejected, and the size
   to repeat with (before `stop` cuts it) would not move t, or *h is at `smallest` or below it
   already: nothing changed, end the loop.
   RK_ENULL, RK_ENAN (t, h, t + h), RK_EARG (h is 0, error < 0, C->order < 1). */
RK_API int rk_control_step(rk_control *C, double error, double *t, double *h);

/* First step, after Hairer, Norsett & Wanner I, II.4, in two calls.  order: see rk_estimate.
   length > 0: a length of time the host knows, as what is left to integrate, |t1 - t|.  d0 = |y|
   and d1 = |f(t, y)|, in the norm rk_rms of rk_norm with y for y0, NULL for y1 and sums set to 0.
   d2 < 0: returns a trial size h, 0.01 d0/d1 but at most length/100; length/1e4 where y is within
      its tolerance or f = 0, as of a structure at rest.
   d2 = |f(t + h, y + h f) - f(t, y)|/h: returns the size to start with, at most 100 h and `length`.
   Backwards in time evaluate f(t - h, y - h f) there, and negate the result.
   NaN: a bad argument.  An infinite d2 is one: the trial step left the domain of f.  Then start
   with a smaller size of your own.
      rk_norm(rtol, atol, NULL, n, y, y, NULL, s0);   rk_norm(rtol, atol, NULL, n, k, y, NULL, s1);
      h = rk_first_step(q, t1 - t, rk_rms(s0), rk_rms(s1), -1);
      rk_combine(h, 1, one, n, y, k, n, z);           f(t + h, z, k + n);        // one = {1}
      rk_combine(1 / h, 2, difference, n, NULL, k, n, z);                        // {-1, 1}
      rk_norm(rtol, atol, NULL, n, z, y, NULL, s2);
      h = rk_first_step(q, t1 - t, rk_rms(s0), rk_rms(s1), rk_rms(s2)); */
RK_API double rk_first_step(int order, double length, double d0, double d1, double d2);

/* ---- proof ----------------------------------------------------------------------------------- */

/* Properties of a table, found in its numbers: 1 if it has it, else 0.  RK_ENULL, RK_EARG. */
enum {
    RK_EXPLICIT = 1,     /* a_ij = 0 for j >= i */
    RK_SEQUENTIAL,       /* a_ij = 0 for j > i: one stage after the other; else all are coupled */
    RK_STIFFLY_ACCURATE, /* the last row of A is b, so ynew is the last stage value */
    RK_FSAL              /* stiffly accurate, the first stage y and the last one at t + h: the last
                            slope is slope 0 of the next step.  Of an IMEX method both halves must
                            have it */
};
RK_API int rk_is(const rk_table *T, int property);

/* Whether the table is what it claims: finite, order, order_hat (with e and e3), dense_order,
   dense_stiff (2 to 10, or 0); the dense output ends in b, and the step takes no extra stage
   (orders above 10 are checked up to 10).  *defect, unless NULL: 0 if all
   holds, else the defect that is too large, HUGE_VAL if the table cannot be judged.  Check a table
   of your own once: microseconds up to order 5, about a millisecond for dop853.
   RK_OK, RK_ROWSUM, RK_ENULL, RK_EARG, RK_ETABLE, RK_ESTEP, RK_EPAIR, RK_EDENSE. */
RK_API int rk_check(const rk_table *T, double *defect);

/* The same for the two halves of an IMEX method, each alone and together.  Also RK_EOTHER: they
   differ in stages, extra, or a claim other than dense_stiff. */
RK_API int rk_check_imex(const rk_table *T, const rk_table *other, double *defect);

/* The largest defect over all rooted trees with `order` vertices, 1 <= order <= 10: with r = sum
   b_i Phi_i - 1/gamma and S the sum of |terms|, the larger of |r|/max(S, 1/gamma) and 2.2e-4 |r|,
   so that a defect of at most RK_TOLERANCE means |r| <= 1e-10, too.  Of b(theta) there is an r for
   each power k (1/gamma is subtracted where k = order, else 0), and S is the sum over all powers.
   Rounding (<= RK_TOLERANCE) if that order holds.  Where c is not the row sums of A each leaf is
   taken both as state (the row sums of A) and as time (c).
   which: the weights; other: the other half of an IMEX method, or NULL.
   HUGE_VAL: a number read at this order is Inf or NaN, or a sum overflows.  NaN: a bad argument,
   weights that T does not have, or an `other` of another size or other powers. */
enum { RK_OF_STEP = 0, RK_OF_PAIR = 1, RK_OF_DENSE = 2 }; /* b, bhat, b(theta) in all its powers */
RK_API double rk_defect(const rk_table *T, const rk_table *other, int which, int order);

/* The same for a general-structure additive (GARK) method of `parts` <= 4 parts: stages of part p
   take the slopes of part q by A[p*parts + q], s[p] rows of s[q] numbers. */
RK_API double rk_defect_gark(int order, int parts, const int *s, const double *const *A,
                             const double *const *b);

/* ---- multirate ------------------------------------------------------------------------------- */

/* Multirate couplings: y' = fast(t, y) + slow(t, y).  The slow slopes are k_j = slow(t_j, z_j),
   z_0 = y, t_j = t + c_j H with c_j = rk_coupling_time(C, j).  For i = 1, 2, ..., stages - 1 of a
   step of size H, with from = rk_coupling_from(C, i), powers = rk_coupling_forcing(C, i, w) and g
   of rk_coupling_jump(C, i, g):
      powers > 0: v = the solution at t_i of v'(x) = fast(x, v) + sum_{p < powers} tau^p r_p from
                  v(t_from) = z_from, tau = (x - t_from)/(t_i - t_from), by any method of yours;
                  r_p = sum_{j<i} w_pj k_j, formed once:
                  rk_combine(1, i, w + p*stages, n, NULL, k, ldk, r_p).
      powers = 0: v = z_from, no fast solve.
      base = v + H sum_{j<i} g_j k_j.
      g_i = 0:    z_i = base, k_i = slow(t_i, z_i).
      g_i != 0:   solve z_i = base + H g_i slow(t_i, z_i); k_i = (z_i - base)/(H g_i), see RECIPES.
   The new y is z_{stages-1}; its slope is slope 0 of the next step.  With order_hat > 0, i = stages
   gives the embedded solution z_stages the same way: a fast solve where powers > 0, slopes j <
   stages, z_stages = base.  z_{stages-1} - z_stages is the error, to be judged with rk_norm and
   rk_control_order.
   RK_FROM_START splits the slow part into slowE + slowI.  Jump and implicit solve take slowI alone:
   base = v + H sum_{j<i} g_j kI_j, z_i = base + H g_i slowI(t_i, z_i), kI_i = (z_i - base)/(H g_i),
   or slowI(t_i, z_i) where g_i = 0.  r_p takes both: k_i = slowE(t_i, z_i) + kI_i.
   RK_RELAXED: for i >= stages - 1 (powers = 0) the jump starts at y and takes (slow + fast)(t_j,
   z_j) in place of k_j, so that every linear invariant of the sum is kept exactly.
   Several rates: the fast method of a coupling is a coupling again, whose slow part has the outer
   forcing added. */
enum {
    RK_FROM_LAST = 0, /* MIS and MRI-GARK: each stage goes on from the one before */
    RK_FROM_START,    /* IMEX-MRI-SR: each stage starts from y */
    RK_GROUPS,        /* MERK: a group starts from y, its other stages from the one before */
    RK_RELAXED        /* RMIS */
};
typedef struct rk_coupling {
    const char *name;
    int form;
    int stages, order, order_hat;
    int powers;                /* of tau in W */
    const double *c;           /* [stages], c_0 = 0 */
    const double *W;           /* [powers][stages][stages]: row i - 1 for stage i, the last row for
                                  the embedded solution (zeros without one).  The forcing of i is
                                  sum_p tau^p W_pij k_j / (c_i - c_from), W_pij = W[p][i - 1][j].
                                  Where c_i = c_from the jump is H sum_p W_pij/(p + 1) k_j; of
                                  RK_RELAXED for i >= stages - 1, too, see there; of RK_FROM_START
                                  W is forcing alone.  RK_GROUPS: NULL */
    const double *G;           /* RK_FROM_START: [stages][stages], rows as in W: the jump of every i
                                  is H sum_j G[i - 1][j] kI_j */
    const signed char *groups; /* RK_GROUPS: stages of each group, 1 to 9, stages - 1 in all, then
                                  0; the forcing interpolates the slopes of y and of the group
                                  before.  The embedded solution continues from stage stages - 2
                                  with the forcing of its group */
} rk_coupling;
RK_API const rk_coupling *rk_coupling_find(const char *name); /* NULL if there is none */
RK_API const rk_coupling *rk_coupling_list(int i);            /* i = 0, 1, ...; NULL at the end */
RK_API int rk_coupling_from(const rk_coupling *C, int i);     /* an index; RK_ENULL, RK_EARG */
RK_API double rk_coupling_time(const rk_coupling *C, int i);  /* c_i, i = 0 too; 1 of i = stages;
                                                                 NaN: bad argument */

/* w_pj at weight[p*stages + j] (room for RK_ORDER_MAX*stages); returns the number of powers, 0:
   stage i has no fast solve.  RK_ENULL, RK_EARG. */
RK_API int rk_coupling_forcing(const rk_coupling *C, int i, double *weight);
/* g_0 to g_{stages-1} of i = 1 to stages into weight; all 0 where i has no jump.
   RK_OK, RK_ENULL, RK_EARG. */
RK_API int rk_coupling_jump(const rk_coupling *C, int i, double *weight);

/* A coupling made from an explicit table T with 0 = c_0 <= c_1 <= ... <= 1: a multirate
   infinitesimal-step method (form RK_FROM_LAST, Knoth & Wolke) or its relaxed variant (RK_RELAXED,
   Sexton & Reynolds).  Its orders are found by rk_defect_coupling and stand in *C: min(2, order
   of T) where c is the row sums of A, else 1 or more; 3 or 4 if T meets further conditions; 0 if b
   does not sum to 1.  mem is aligned to 8 bytes, of bytes >= rk_mis_size(T->stages), holds no
   array of T, and outlives *C, which points into it and at T's name.
   RK_ENULL, RK_EARG, RK_EMEM, RK_EOVERLAP, RK_ETABLE, RK_EEXPLICIT (also for c_0 != 0), RK_ETIMES
   (c falls, or goes beyond 1). */
RK_API int rk_mis(rk_coupling *C, const rk_table *T, int form, void *mem, size_t bytes);
RK_API size_t rk_mis_size(int stages); /* 0: not 1 to RK_STAGES_MAX - 1 stages */

/* Whether a coupling has the orders that it claims (above 6: checked up to 6; that takes 0.2 s).
   RK_OK, RK_ENULL, RK_EARG, RK_ETABLE, RK_ETIMES (c_0 is not 0, or the last c of a relaxed one
   not 1), RK_ESTEP, RK_EPAIR. */
RK_API int rk_check_coupling(const rk_coupling *C, double *defect);

/* The largest defect over all coloured trees of that order (<= 6), by the B-series of the exact
   fast solution: one check for all these families.  which: RK_OF_STEP, RK_OF_PAIR (the last row,
   also where order_hat is 0).  NaN, HUGE_VAL as rk_defect. */
RK_API double rk_defect_coupling(const rk_coupling *C, int which, int order);

/* ---- version and messages -------------------------------------------------------------------- */

RK_API int rk_linked_version(void);        /* of the implementation linked in */
RK_API const char *rk_message(int status); /* one clear sentence, never NULL */

#ifdef __cplusplus
}
#endif
#elif RK_VERSION != 200
#  error "two different versions of rk.h in one translation unit"
#endif /* RK_H_INCLUDED_TABLES */

/* ---- implementation -------------------------------------------------------------------------- */
#if defined(RK_IMPLEMENTATION) && !defined(RK_IMPLEMENTATION_INCLUDED)
#define RK_IMPLEMENTATION_INCLUDED

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- numbers and tables ---------------------------------------------------------------------- */

/* RK__INLINE: a call would cost as much as the sum of one number.  RK__APART: never inlined,
   for its size, or for local arrays that callers would set up though they often do without it. */
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#  define RK__INLINE static inline __attribute__((always_inline))
#  define RK__APART  static __attribute__((noinline))
#else
#  define RK__INLINE static inline
#  define RK__APART  static
#endif

#define RK__EXPONENT 0x7ff0000000000000u /* the exponent bits, all of them set in Inf and NaN */
#define RK__CARRY    0x0010000000000000u /* added to all of them it carries into the sign bit */
#define RK__SIGN     0x8000000000000000u

/* By the bits: under -ffast-math isfinite() may be taken for true. */
RK__INLINE int rk__finite(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (bits & RK__EXPONENT) != RK__EXPONENT;
}

/* By the bits, too: with -ffast-math a NaN may be equal to 0. */
RK__INLINE int rk__zero(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits << 1 == 0;
}

/* And again: with -ffast-math 0./0. may be anything. */
static double rk__nan(void)
{
    const uint64_t bits = 0x7ff8000000000000u;
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* Of an array that may be absent. */
static int rk__all_finite(int n, const double *v)
{
    int i;
    if (!v) return 1;
    for (i = 0; i < n; i++)
        if (!rk__finite(v[i])) return 0;
    return 1;
}

/* least <= v <= most, for counts and indices of any width. */
static int rk__within(ptrdiff_t v, ptrdiff_t least, ptrdiff_t most)
{
    return v >= least && v <= most;
}

static ptrdiff_t rk__min(ptrdiff_t a, ptrdiff_t b)
{
    return a < b ? a : b;
}

/* Of several remarks the last one that says something. */
static int rk__later(int remark, int status)
{
    return status ? status : remark;
}

/* Whether a vector of n numbers is not there. */
RK__INLINE int rk__absent(ptrdiff_t n, const double *v)
{
    return n > 0 && !v;
}

/* Rows and columns of A: the stages of the step and those of the dense output alone. */
RK__INLINE int rk__rows(const rk_table *T)
{
    return T->stages + T->extra;
}

/* The numbers of A are found by stages + extra, so these are looked at before any of them. */
RK__INLINE int rk__table_status(const rk_table *T)
{
    if (!T || !T->A || !T->b || !T->c) return RK_ENULL;
    if (T->stages < 1 || T->extra < 0 || T->stages > RK_STAGES_MAX - T->extra) return RK_EARG;
    return RK_OK;
}

/* Length h of the step and the strides of its vectors. */
RK__INLINE int rk__step_status(double h, ptrdiff_t n, ptrdiff_t ld)
{
    if (!rk__finite(h)) return RK_ENAN;
    return n < 0 || ld < n ? RK_EARG : RK_OK;
}

/* ---- sums over long vectors ------------------------------------------------------------------
   out = y + w_0 x_0 + w_1 x_1 + ..., left to right, whatever n and the processor are.  Few numbers
   stay in registers while the terms pass by (rk__tile).  Many are swept in blocks, with the weights
   in registers (rk__sum).  A sum may have to be repeated: where out is y, the y of the block is
   kept for that. */

#define RK__BLOCK    4096 /* numbers of a block: 32 kB of each slope */
#define RK__IN_PLACE 256  /* of a block where out is read as well: it is copied first */
#define RK__PACKS    8    /* packs held at once */
#define RK__SWEPT    8    /* terms of one sweep */

typedef struct rk__terms {
    int count;
    double w[RK_STAGES_MAX];
    const double *x[RK_STAGES_MAX];
} rk__terms;

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

/* By default clang, and gcc but for -std=c99, fuse products with sums where the processor is known
   to do it, as on ARM.  This undoes it for clang, unless -mfma (or a -march that implies it),
   -ffp-contract=fast or -ffast-math asked for it; gcc needs a flag. */
#if defined(__clang__) && !defined(__FMA__)
#  define RK__UNFUSED _Pragma("clang fp contract(off)")
#else
#  define RK__UNFUSED
#endif

/* Packs of L doubles are vectorised at any optimisation level and whatever aliases; products and
   sums are rounded one by one, so that all L give the same bits.  Not where doubles are rounded
   later than that, by the 387. */
#if defined(__GNUC__) && FLT_EVAL_METHOD != 2
#  define RK__AT(L, x, i) (*(const rk__load##L *)((x) + (i)))
#  define RK__SEEN(L, v)  (((rk__bits##L)(v) & RK__EXPONENT) + RK__CARRY)
#  define RK__HOLD(L, q)  rk__pack##L a##q = RK__AT(L, from, q * L);
#  define RK__GAIN(L, q)  a##q += w * RK__AT(L, x, q * L);
#  define RK__LOOK(L, q)  carry |= RK__SEEN(L, a##q);
#  define RK__KEEP(L, q)  *(rk__load##L *)(out + q * L) = a##q;

/* `len` numbers in `few` packs and a last one, which ends with the last number and so may repeat
   some of the pack before: every term with a weight passes by, then all is written if all is
   finite, that is, if no sign bit of `carry` is set (RK__CARRY). */
#  define RK__TILE(L, few)                                                                         \
    case few: {                                                                                    \
        rk__pack##L last = RK__AT(L, from, len - L);                                               \
        RK__##few(RK__HOLD##L)                                                                     \
        for (j = 0; j < s; j++, x += ldk) {                                                        \
            const double w = h * weight[j];                                                        \
            if (rk__zero(w)) continue;                                                             \
            RK__##few(RK__GAIN##L)                                                                 \
            last += w * RK__AT(L, x, len - L);                                                     \
        }                                                                                          \
        carry = RK__SEEN(L, last);                                                                 \
        RK__##few(RK__LOOK##L)                                                                     \
        for (r = 0; r < L; r++) bad |= (int)(carry[r] >> 63);                                      \
        if (bad) break;                                                                            \
        RK__##few(RK__KEEP##L)                                                                     \
        *(rk__load##L *)(out + len - L) = last;                                                    \
        break;                                                                                     \
    }

/* How many numbers the next turn of a tile holds, of the n that are left: all if they fit.  Else
   whole packs, 5 or 8, so that more than 3 L numbers stay for the turn after it: a rest of at most
   3 L would be a case 0 to 2 of rk__tile, which L = 8 lacks.  (Only L = 8 gets more than RK__PACKS
   L numbers, see rk__several.) */
static ptrdiff_t rk__held(ptrdiff_t n, int L)
{
    if (n <= RK__PACKS * L) return n;
    return (n <= (RK__PACKS + 3) * L ? 5 : RK__PACKS) * L;
}

/* A sweep of m <= 8 terms, two packs a turn.  The last turn goes back as far as it takes to end
   with the last number: what it sums again gets the same bits, for nothing that is read is out.
   Where y is absent it points to 2 L zeros, and with `mask` 0 every turn reads these.  One addition
   looks at two packs: their sum is not finite where one of them is not. */
#  define RK__TERM(j) const double w##j = w[j], *x##j = x[j] + i;
#  define RK__SWEEP(m, L)                                                                          \
    case m: {                                                                                      \
        RK__##m(RK__TERM)                                                                          \
        for (r = 0; r < n; r += 2 * L) {                                                           \
            const ptrdiff_t f = rk__min(r, n - 2 * L), g = f & mask;                               \
            const rk__pack##L p = RK__AT(L, y, g) RK__##m(RK__FIRST##L);                           \
            const rk__pack##L q = RK__AT(L, y, g + L) RK__##m(RK__SECOND##L);                      \
            *(rk__load##L *)(out + f) = p;                                                         \
            *(rk__load##L *)(out + f + L) = q;                                                     \
            all += p + q;                                                                          \
        }                                                                                          \
        break;                                                                                     \
    }

/* rk__tile: writes as long as all is finite and returns how many numbers that were.  RK__SHORT: of
   the cases 0 to 3 those that occur for the n that rk__several hands to this L.  A missing case
   would write nothing: change RK__SHORT together with those n.
   rk__sum: adds at most 8 terms, t->x[from] first, to n >= 2 L numbers.  Slopes are read from their
   number i on; y and out point there.  Returns whether one of the sums may not be finite. */
#  define RK__KERNELS(L, TARGET, CLEAN)                                                            \
    typedef double rk__pack##L __attribute__((vector_size(8 * L)));                                \
    typedef double rk__load##L __attribute__((vector_size(8 * L), aligned(8), may_alias));         \
    typedef uint64_t rk__bits##L __attribute__((vector_size(8 * L)));                              \
    TARGET static ptrdiff_t rk__tile##L(double h, int s, const double *weight, ptrdiff_t n,        \
                                        const double *y, const double *k, ptrdiff_t ldk,           \
                                        double *out)                                               \
    {                                                                                              \
        RK__UNFUSED                                                                                \
        static const double zero[RK__PACKS * L] = {0};                                             \
        ptrdiff_t len, i;                                                                          \
        rk__bits##L carry;                                                                         \
        int j, r, bad = 0;                                                                         \
        for (i = 0; i < n; i += len, k += len, out += len) {                                       \
            const double *from = y ? y + i : zero, *x = k;                                         \
            len = rk__held(n - i, L);                                                              \
            switch ((len - 1) / L) {                                                               \
                RK__SHORT##L                                                                       \
                RK__TILE(L, 4)                                                                     \
                RK__TILE(L, 5)                                                                     \
                RK__TILE(L, 6)                                                                     \
                RK__TILE(L, 7)                                                                     \
            }                                                                                      \
            if (bad) break;                                                                        \
        }                                                                                          \
        CLEAN                                                                                      \
        return i;                                                                                  \
    }                                                                                              \
    TARGET static int rk__sum##L(const rk__terms *t, int from, ptrdiff_t i, ptrdiff_t n,           \
                                 const double *y, double *out)                                     \
    {                                                                                              \
        RK__UNFUSED                                                                                \
        static const double zero[2 * L] = {0};                                                     \
        const double *w = t->w + from, *const *x = t->x + from;                                    \
        const ptrdiff_t mask = y ? -1 : 0;                                                         \
        rk__pack##L all = {0};                                                                     \
        double sum = 0;                                                                            \
        ptrdiff_t r;                                                                               \
        int l;                                                                                     \
        y = y ? y : zero;                                                                          \
        switch (rk__min(t->count - from, RK__SWEPT)) {                                             \
            RK__SWEEP(0, L)                                                                        \
            RK__SWEEP(1, L)                                                                        \
            RK__SWEEP(2, L)                                                                        \
            RK__SWEEP(3, L)                                                                        \
            RK__SWEEP(4, L)                                                                        \
            RK__SWEEP(5, L)                                                                        \
            RK__SWEEP(6, L)                                                                        \
            RK__SWEEP(7, L)                                                                        \
            RK__SWEEP(8, L)                                                                        \
        }                                                                                          \
        for (l = 0; l < L; l++) sum += all[l];                                                     \
        CLEAN                                                                                      \
        return !rk__finite(sum);                                                                   \
    }
#  define RK__SHORT2      RK__TILE(2, 0) RK__TILE(2, 1) RK__TILE(2, 2) RK__TILE(2, 3)
#  define RK__HOLD2(q)    RK__HOLD(2, q)
#  define RK__GAIN2(q)    RK__GAIN(2, q)
#  define RK__LOOK2(q)    RK__LOOK(2, q)
#  define RK__KEEP2(q)    RK__KEEP(2, q)
#  define RK__FIRST2(j)   +w##j *RK__AT(2, x##j, f)
#  define RK__SECOND2(j)  +w##j *RK__AT(2, x##j, f + 2)
#  define RK__SHORT4
#  define RK__HOLD4(q)    RK__HOLD(4, q)
#  define RK__GAIN4(q)    RK__GAIN(4, q)
#  define RK__LOOK4(q)    RK__LOOK(4, q)
#  define RK__KEEP4(q)    RK__KEEP(4, q)
#  define RK__FIRST4(j)   +w##j *RK__AT(4, x##j, f)
#  define RK__SECOND4(j)  +w##j *RK__AT(4, x##j, f + 4)
#  define RK__SHORT8      RK__TILE(8, 3)
#  define RK__HOLD8(q)    RK__HOLD(8, q)
#  define RK__GAIN8(q)    RK__GAIN(8, q)
#  define RK__LOOK8(q)    RK__LOOK(8, q)
#  define RK__KEEP8(q)    RK__KEEP(8, q)
#  define RK__FIRST8(j)   +w##j *RK__AT(8, x##j, f)
#  define RK__SECOND8(j)  +w##j *RK__AT(8, x##j, f + 8)

RK__KERNELS(2, , )

/* Four and eight numbers at once, where the processor has such vectors; it is asked at run time
   unless the compiler knows.  Eight on processors made since Ice Lake and Zen 4 (the first that
   have VBMI2); those before lower their clock for them.  The avx512f target brings fused
   multiply-adds, which would give other bits than the other kernels: off.  CLEAN (vzeroupper)
   clears the upper halves of the registers: left set, they would slow the host's SSE code down to a
   quarter. */
#  if defined(__AVX__)
#    define RK__HAS4 1
#    define RK__TARGET4
#    define RK__CLEAN
#  elif defined(__x86_64__)
#    define RK__HAS4    __builtin_cpu_supports("avx2")
#    define RK__TARGET4 __attribute__((target("avx2")))
#    define RK__CLEAN   __builtin_ia32_vzeroupper();
#  endif
#  if defined(__AVX512VBMI2__)
#    define RK__HAS8 1
#    define RK__TARGET8
#  elif defined(__x86_64__) && (defined(__clang__) ? __clang_major__ >= 12 : __GNUC__ >= 8)
#    define RK__HAS8 __builtin_cpu_supports("avx512vbmi2")
#    if defined(__clang__) || defined(__FMA__)
#      define RK__TARGET8 __attribute__((target("avx512f")))
#    else
#      define RK__TARGET8 __attribute__((target("avx512f"), optimize("fp-contract=off")))
#    endif
#  endif
#  ifdef RK__HAS4
RK__KERNELS(4, RK__TARGET4, RK__CLEAN)
#  endif
#  ifdef RK__HAS8
RK__KERNELS(8, RK__TARGET8, RK__CLEAN)
#  endif
#endif

/* By the widest kernel that the processor has and n fills twice; where there is none, one number
   after the other. */
static int rk__sum(const rk__terms *t, int from, ptrdiff_t i, ptrdiff_t n, const double *y,
                   double *out)
{
    RK__UNFUSED
    const ptrdiff_t to = rk__min(t->count, from + RK__SWEPT);
    ptrdiff_t j, r;
    int bad = 0;
#ifdef RK__HAS8
    if (n >= 16 && RK__HAS8) return rk__sum8(t, from, i, n, y, out);
#endif
#ifdef RK__HAS4
    if (n >= 8 && RK__HAS4) return rk__sum4(t, from, i, n, y, out);
#endif
#ifdef RK__KERNELS
    if (n >= 4) return rk__sum2(t, from, i, n, y, out);
#endif
    for (r = 0; r < n; r++) {
        double sum = y ? y[r] : 0;
        for (j = from; j < to; j++) sum += t->w[j] * t->x[j][i + r];
        bad |= !rk__finite(sum);
        out[r] = sum;
    }
    return bad;
}

/* One number, if it is finite. */
RK__INLINE int rk__one(double h, int s, const double *weight, double t, const double *x,
                       ptrdiff_t ldk, double *out)
{
    RK__UNFUSED
    int j;
    for (j = 0; j < s; j++, x += ldk) {
        const double w = h * weight[j];
        if (!rk__zero(w)) t += w * *x;
    }
    if (!rk__finite(t)) return 0;
    *out = t;
    return 1;
}

/* The terms h weight_j k_j without those of weight 0, whose slopes are not read. */
static void rk__collect(double h, int s, const double *weight, const double *k, ptrdiff_t ldk,
                        rk__terms *t)
{
    ptrdiff_t m = 0;
    int j;
    for (j = 0; j < s; j++) {
        t->w[m] = h * weight[j];
        t->x[m] = k + j * ldk;
        m += !rk__zero(t->w[m]);
    }
    t->count = (int)m;
}

/* The terms behind the first eight, added to out: a kernel does not read what it writes. */
RK__APART int rk__add(const rk__terms *t, ptrdiff_t i, ptrdiff_t n, double *out)
{
    double kept[RK__IN_PLACE];
    int j, bad = 0;
    for (j = RK__SWEPT; j < t->count; j += RK__SWEPT) {
        memcpy(kept, out, (size_t)n * sizeof *out);
        bad |= rk__sum(t, j, i, n, kept, out);
    }
    return bad;
}

/* One element again, 2^-64 smaller on the way: a partial sum may overflow, the result not. */
static double rk__rescue(const rk__terms *t, ptrdiff_t i, double y)
{
    volatile double down = 1. / 18446744073709551616.; /* volatile: -ffast-math would cancel it */
    double sum = y * down;
    int j;
    for (j = 0; j < t->count; j++) sum += t->w[j] * down * t->x[j][i];
    return sum / down;
}

/* The same for all of n numbers from number i on that are not finite; y and out begin there. */
RK__APART int rk__repair(const rk__terms *t, ptrdiff_t i, ptrdiff_t n, const double *y, double *out)
{
    int status = RK_OK;
    ptrdiff_t r;
    for (r = 0; r < n; r++) {
        if (rk__finite(out[r])) continue;
        out[r] = rk__rescue(t, i + r, y ? y[r] : 0);
        if (!rk__finite(out[r])) status = RK_NONFINITE;
    }
    return status;
}

/* In blocks.  If a result of a block is not finite, rk__repair sums that number again.  It needs y
   for this, and a kernel does not read what it writes: where out is y, a copy of the block of y is
   kept.  With more than eight terms rk__add copies the block of out.  Both copies are short. */
RK__APART int rk__many(double h, int s, const double *weight, ptrdiff_t n, const double *y,
                       const double *k, ptrdiff_t ldk, double *out)
{
    double kept[RK__IN_PLACE];
    int status = RK_OK, bad;
    rk__terms t;
    ptrdiff_t i, block;
    rk__collect(h, s, weight, k, ldk, &t);
    block = y == out || t.count > RK__SWEPT ? RK__IN_PLACE : RK__BLOCK;
    for (i = 0; i < n; i += block) {
        const ptrdiff_t len = rk__min(n - i, block);
        const double *start = y ? y + i : NULL;
        if (y == out) start = (const double *)memcpy(kept, y + i, (size_t)len * sizeof *y);
        bad = rk__sum(&t, 0, i, len, start, out + i);
        if (t.count > RK__SWEPT) bad |= rk__add(&t, i, len, out + i);
        if (bad && rk__repair(&t, i, len, start, out + i)) status = RK_NONFINITE;
    }
    return status;
}

/* Few numbers in registers, if all results are finite; everything else in blocks.  Where each width
   begins was measured: before that, calls and upper halves cost more than they save; beyond, the
   blocks are faster. */
RK__APART int rk__several(double h, int s, const double *weight, ptrdiff_t n, const double *y,
                          const double *k, ptrdiff_t ldk, double *out)
{
    ptrdiff_t done = 0;
    if (s == 0) k = out; /* no terms: k, perhaps NULL, is never read, but moved along with out */
#ifdef RK__KERNELS
    if (rk__within(n, 2, 16)) done = rk__tile2(h, s, weight, n, y, k, ldk, out);
#  ifdef RK__HAS8
    else if (rk__within(n, 32, 256) && RK__HAS8)
        done = rk__tile8(h, s, weight, n, y, k, ldk, out);
#  endif
#  ifdef RK__HAS4
    else if (rk__within(n, 17, 32) && RK__HAS4)
        done = rk__tile4(h, s, weight, n, y, k, ldk, out);
#  endif
#endif
    if (done == n) return RK_OK; /* n = 0, too, where k may be NULL */
    k += done, out += done, n -= done;
    if (y) y += done;
    return rk__many(h, s, weight, n, y, k, ldk, out);
}

/* One number at once: a call would cost as much as its sum. */
RK__INLINE int rk__combine(double h, int s, const double *weight, ptrdiff_t n, const double *y,
                           const double *k, ptrdiff_t ldk, double *out)
{
    if (n == 1 && rk__one(h, s, weight, y ? *y : 0, k, ldk, out)) return RK_OK;
    return rk__several(h, s, weight, n, y, k, ldk, out);
}

/* Without terms neither the weights, nor the slopes, nor their stride are looked at. */
RK_API int rk_combine(double h, int slopes, const double *weight, ptrdiff_t n, const double *y,
                      const double *k, ptrdiff_t ldk, double *out)
{
    const int status = rk__step_status(h, n, slopes > 0 ? ldk : n);
    if (status < 0) return status;
    if (!rk__within(slopes, 0, RK_STAGES_MAX)) return RK_EARG;
    if (slopes > 0 && (!weight || rk__absent(n, k))) return RK_ENULL;
    if (rk__absent(n, out)) return RK_ENULL;
    return rk__combine(h, slopes, weight, n, y, k, ldk, out);
}

/* ---- a step ---------------------------------------------------------------------------------- */

/* Row i of A up to its diagonal: stage 0 takes no slope, so k and ldk may be anything there. */
RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y,
                    const double *k, ptrdiff_t ldk, double *z)
{
    int status = rk__table_status(T);
    if (status < 0) return status;
    if (i < 0 || i >= rk__rows(T)) return RK_EARG;
    status = rk__step_status(h, n, i > 0 ? ldk : n);
    if (status < 0) return status;
    if (n > 0 && (!y || !z || (i > 0 && !k))) return RK_ENULL;
    return rk__combine(h, i, T->A + i * rk__rows(T), n, y, k, ldk, z);
}

/* A stage of a coupled table takes all slopes, so all stages are formed block by block. */
RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k,
                     ptrdiff_t ldk, double *z, ptrdiff_t ldz)
{
    int status = rk__table_status(T), remark = RK_OK, i, m;
    ptrdiff_t r;
    if (status < 0) return status;
    status = rk__step_status(h, n, rk__min(ldk, ldz));
    if (status < 0) return status;
    if (rk__absent(n, y) || rk__absent(n, k) || rk__absent(n, z)) return RK_ENULL;
    m = rk__rows(T);
    for (r = 0; r < n; r += RK__BLOCK) { /* all sums while the slopes are in the cache */
        const ptrdiff_t len = rk__min(n - r, RK__BLOCK);
        for (i = 0; i < T->stages; i++) {
            const double *a = T->A + i * m;
            status = rk__combine(h, m, a, len, y + r, k + r, ldk, z + i * ldz + r);
            remark = rk__later(remark, status);
        }
    }
    return remark;
}

/* b - bhat: rounded once where the table has it, else formed in `room`. */
static const double *rk__pair_weights(const rk_table *T, double *room)
{
    int j;
    if (T->e) return T->e;
    for (j = 0; j < T->stages; j++) room[j] = T->b[j] - T->bhat[j];
    return room;
}

/* The two rows b and b - bhat; err does not read y, which may be NULL without ynew. */
RK_API int rk_finish(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k,
                     ptrdiff_t ldk, double *ynew, double *err)
{
    const double *e = NULL;
    double room[RK_STAGES_MAX];
    int status = rk__table_status(T), remark = RK_OK;
    ptrdiff_t i;
    if (status < 0) return status;
    status = rk__step_status(h, n, ldk);
    if (status < 0) return status;
    if (rk__absent(n, k) || (ynew && rk__absent(n, y))) return RK_ENULL;
    if (err && !T->bhat) return RK_ENOPAIR;
    if (err) e = rk__pair_weights(T, room);
    for (i = 0; i < n; i += RK__BLOCK) { /* both sums while the slopes are in the cache */
        const ptrdiff_t len = rk__min(n - i, RK__BLOCK);
        if (ynew) status = rk__combine(h, T->stages, T->b, len, y + i, k + i, ldk, ynew + i);
        remark = rk__later(remark, status);
        if (err) status = rk__combine(h, T->stages, e, len, NULL, k + i, ldk, err + i);
        remark = rk__later(remark, status);
    }
    return remark;
}

/* ---- dense output ---------------------------------------------------------------------------- */

#define RK__ULPS (4 * DBL_EPSILON) /* times that differ by so much, relatively, are the same */
#define RK__BATCH 8                /* thetas of one sweep over the slopes */
#define RK__NEAR 512               /* numbers of a block: it stays in the nearest cache */

/* The deriv-th derivative of d_1 theta + d_2 theta^2 + ..., by Horner's rule. */
RK__INLINE double rk__polynomial(int degree, const double *d, double theta, int deriv)
{
    const double *next = d + degree;
    double sum = 0;
    int j, r;
    if (deriv == 0) {
        while (next != d) sum = sum * theta + *--next;
        return sum * theta;
    }
    for (j = degree; j >= deriv; j--) {
        double term = d[j - 1];
        for (r = 0; r < deriv; r++) term *= j - r;
        sum = sum * theta + term;
    }
    return sum;
}

/* The values of `count` polynomials, up to degree 7 by loops of known length. */
#define RK__POWER(j) sum = sum * theta + d[-1 - j];
#define RK__VALUES(m)                                                                              \
    case m:                                                                                        \
        for (i = 0; i < count; i++) {                                                              \
            double sum = 0;                                                                        \
            d += m;                                                                                \
            RK__##m(RK__POWER)                                                                     \
            weight[i] = sum * theta;                                                               \
        }                                                                                          \
        break;
static void rk__values(int count, int degree, const double *d, double theta, double *weight)
{
    int i;
    switch (degree) {
        RK__VALUES(1)
        RK__VALUES(2)
        RK__VALUES(3)
        RK__VALUES(4)
        RK__VALUES(5)
        RK__VALUES(6)
        RK__VALUES(7)
    default:
        for (i = 0; i < count; i++) weight[i] = rk__polynomial(degree, d + i * degree, theta, 0);
    }
}

/* What rk_weights says of theta and deriv; the table was looked at. */
RK__INLINE int rk__theta_status(const rk_table *T, double theta, int deriv)
{
    if (!rk__finite(theta)) return RK_ENAN;
    if (deriv < 0) return RK_EARG;
    if (!T->d || T->powers < 1) return RK_ENODENSE;
    return theta < -RK__ULPS || theta - 1 > RK__ULPS ? RK_EXTRAP : RK_OK;
}

/* theta that is an end up to rounding is that end, where the weights are 0 or b itself: powers of
   theta would miss them by some ulps. */
RK_API int rk_weights(const rk_table *T, double theta, int deriv, double *weight)
{
    int status = rk__table_status(T), i;
    if (status < 0) return status;
    if (!weight) return RK_ENULL;
    status = rk__theta_status(T, theta, deriv);
    if (status < 0) return status;
    if (fabs(theta) <= RK__ULPS) theta = 0;
    if (fabs(theta - 1) <= RK__ULPS) theta = 1;
    if (deriv == 0 && theta == 1) /* as rk_finish, to the bit */
        memcpy(weight, T->b, (size_t)rk__rows(T) * sizeof *weight);
    else if (deriv == 0) rk__values(rk__rows(T), T->powers, T->d, theta, weight);
    else {
        for (i = 0; i < rk__rows(T); i++)
            weight[i] = rk__polynomial(T->powers, T->d + i * T->powers, theta, deriv);
    }
    return status;
}

/* Whether rk__dense_scale is in range.  Judged before each division, for with -ffast-math a
   compiler may make anything of an Inf. */
static int rk__dense_scale_fits(double h, int deriv, int degree)
{
    double scale = 1, size = fabs(h);
    int r;
    for (r = 1; r < deriv && r <= degree; r++) {
        if (scale >= DBL_MAX * fmin(size, 1)) return 0;
        scale /= size;
    }
    return 1;
}

/* h^(1 - deriv), what the weights are multiplied with.  Beyond the degree the weights are 0 and any
   finite factor does. */
RK__INLINE double rk__dense_scale(double h, int deriv, int degree)
{
    double scale = deriv == 0 ? h : 1;
    int r;
    for (r = 1; r < deriv && r <= degree; r++) scale /= h;
    return scale;
}

/* y is read for values only, not for derivatives. */
static int rk__dense_status(const rk_step *s, int deriv)
{
    int status;
    if (!s) return RK_ENULL;
    status = rk__table_status(s->T);
    if (status < 0) return status;
    status = rk__step_status(s->h, s->n, s->ldk);
    if (status < 0) return status;
    if (rk__absent(s->n, s->k) || (deriv == 0 && rk__absent(s->n, s->y))) return RK_ENULL;
    return rk__dense_scale_fits(s->h, deriv, s->T->powers) ? RK_OK : RK_EARG;
}

/* out_l = [y] + scale sum weight_lj k_j for up to RK__BATCH rows of weights.  One row goes in the
   blocks of rk_finish, so that theta = 1 gives its bits under any flags if out is y in both or in
   neither. */
static int rk__dense_batch(const rk_step *s, int count, double weight[][RK_STAGES_MAX], int deriv,
                           double *out, ptrdiff_t ldout)
{
    const double scale = rk__dense_scale(s->h, deriv, s->T->powers);
    const ptrdiff_t block = count > 1 ? RK__NEAR : RK__BLOCK;
    int status, remark = RK_OK, l;
    ptrdiff_t r;
    for (r = 0; r < s->n; r += block) {
        const ptrdiff_t len = rk__min(s->n - r, block);
        const double *y = deriv == 0 ? s->y + r : NULL;
        for (l = 0; l < count; l++) {
            status = rk__combine(scale, rk__rows(s->T), weight[l], len, y, s->k + r, s->ldk,
                                 out + l * ldout + r);
            remark = rk__later(remark, status);
        }
    }
    return remark;
}

/* One row of weights b_i(theta), then the same sum as for a stage. */
RK_API int rk_dense(const rk_step *s, double theta, int deriv, double *out)
{
    double weight[1][RK_STAGES_MAX];
    int status = rk__dense_status(s, deriv);
    if (status < 0) return status;
    if (rk__absent(s->n, out)) return RK_ENULL;
    status = rk_weights(s->T, theta, deriv, weight[0]);
    if (status < 0) return status;
    return rk__later(status, rk__dense_batch(s, 1, weight, deriv, out, s->n));
}

/* A batch of thetas shares one pass over the slopes, part by part, while these are in the cache. */
RK_API int rk_dense_many(const rk_step *s, int deriv, int count, const double *theta, double *out,
                         ptrdiff_t ldout)
{
    double weight[RK__BATCH][RK_STAGES_MAX];
    int status = rk__dense_status(s, deriv), remark = RK_OK, g, l;
    if (status < 0) return status;
    if (count < 0 || ldout < s->n) return RK_EARG;
    if (rk__absent(count, theta)) return RK_ENULL;
    if (count > 0 && rk__absent(s->n, out)) return RK_ENULL;
    for (l = 0; l < count; l++) { /* all or nothing: every theta before the first result */
        status = rk__theta_status(s->T, theta[l], deriv);
        if (status < 0) return status;
        remark = rk__later(remark, status);
    }
    if (s->n == 0) return remark; /* out may be NULL */
    for (g = 0; g < count; g += RK__BATCH) {
        const int batch = (int)rk__min(count - g, RK__BATCH);
        for (l = 0; l < batch; l++) rk_weights(s->T, theta[g + l], deriv, weight[l]);
        status = rk__dense_batch(s, batch, weight, deriv, out + g * ldout, ldout);
        remark = rk__later(remark, status);
    }
    return remark;
}

/* Both ends may be near for a tiny h: then the nearer one is meant. */
RK_API double rk_theta(double t, double t0, double h)
{
    const double t1 = t0 + h, slack = RK__ULPS * fmax(fabs(t0), fabs(t1));
    const double past = fabs(t - t0), left = fabs(t - t1);
    if (!(fabs(h) > 0)) return rk__nan();
    if (left <= slack && left < past) return 1;
    if (past <= slack) return 0;
    return (t - t0) / h;
}

/* ---- error norm and step control ------------------------------------------------------------- */

#define RK__HUGE      2.9073548971824276e135 /* 2^450: ratios beyond 2^+-450 are summed scaled */
#define RK__SHIFT     600                    /* by 2^-+600 */
#define RK__TINY_SUM  1e-200                 /* a sum of squares below this may have lost digits */
#define RK__NORM_BLOCK 256 /* numbers summed again at once if their sum is out of range */
#define RK__REPEAT    0.9  /* largest factor of a rejected step */
#define RK__EVENT     3    /* rejections in a row that tell a discontinuity from a smooth error */
#define RK__EVENT_PER 50   /* from then on length/|h| counts as at most 50 */

typedef struct rk__scale { /* w_i = atol size_i + rtol max(|y0_i|, |y1_i|) */
    double rtol, atol;
    const double *size, *y0, *y1;
} rk__scale;

/* w_i of the norm. */
RK__INLINE double rk__width(const rk__scale *s, ptrdiff_t i)
{
    const double a = fabs(s->y0[i]), b = fabs(s->y1[i]);
    const double atol = s->size ? s->atol * fabs(s->size[i]) : s->atol;
    return atol + s->rtol * (a > b ? a : b);
}

/* The plain sum of [i, end) is not finite, below RK__TINY_SUM or above RK__HUGE^2, or an input is
   not finite: each ratio again, into the sum of its own range.  DBL_MAX makes rk_rms infinite, and
   survives -ffast-math as Inf does not. */
static void rk__norm_careful(const rk__scale *s, ptrdiff_t i, ptrdiff_t end, const double *v,
                             double sum[4])
{
    for (; i < end; i++) {
        const double w = rk__width(s, i), q = fabs(v[i]) / w;
        const double given[] = {s->y0[i], s->y1[i], v[i], s->size ? s->size[i] : 0};
        if (!rk__all_finite(4, given)) sum[1] += DBL_MAX;
        else if (w == 0) sum[1] += v[i] == 0 ? 0 : DBL_MAX;
        else if (!rk__finite(q)) sum[1] += DBL_MAX;
        else if (q > RK__HUGE) sum[1] += ldexp(q, -RK__SHIFT) * ldexp(q, -RK__SHIFT);
        else if (q < 1 / RK__HUGE) sum[2] += ldexp(q, RK__SHIFT) * ldexp(q, RK__SHIFT);
        else sum[0] += q * q;
    }
}

/* The sum of squares on [i, end), in four lanes without sizes; *all is not finite if a y0, y1 or
   size is not. */
RK__INLINE double rk__norm_lanes(const rk__scale *s, ptrdiff_t i, ptrdiff_t end, const double *v,
                                 double *all)
{
    RK__UNFUSED
    const double *y0 = s->y0, *y1 = s->y1, rtol = s->rtol, atol = s->atol;
    const double *size = s->size ? s->size : y0; /* y0: for `seen` alone, which has it anyway */
    const ptrdiff_t fours = s->size ? i : end - 3; /* with sizes one number after the other */
    double sum[4] = {0, 0, 0, 0}, seen[4] = {0, 0, 0, 0};
    int l;
    for (; i < fours; i += 4)
        for (l = 0; l < 4; l++) {
            const double a = fabs(y0[i + l]), b = fabs(y1[i + l]);
            const double q = v[i + l] / (atol + rtol * (a > b ? a : b));
            sum[l] += q * q;
            seen[l] += a + b;
        }
    for (; i < end; i++) {
        const double q = v[i] / rk__width(s, i);
        sum[0] += q * q;
        /* an infinite size makes q = 0, or with atol = 0 a NaN that -ffast-math may lose */
        seen[0] += fabs(y0[i]) + fabs(y1[i]) + fabs(size[i]);
    }
    *all = (seen[0] + seen[1]) + (seen[2] + seen[3]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* The same on the vectors of the processor. */
#ifdef RK__HAS4
RK__TARGET4 static double rk__norm4(const rk__scale *s, ptrdiff_t i, ptrdiff_t end, const double *v,
                                    double *all)
{
    const double sum = rk__norm_lanes(s, i, end, v, all);
    RK__CLEAN
    return sum;
}
#endif

/* Without size and for a multiple of eight numbers: eight divisions at once, the squares added as
   four and four. */
#ifdef RK__HAS8
#  define RK__ABS8(v) ((rk__pack8)((rk__bits8)(v) & ~RK__SIGN))
RK__TARGET8 static void rk__norm8_lanes(const rk__scale *s, ptrdiff_t i, ptrdiff_t end,
                                        const double *v, double *lanes)
{
    RK__UNFUSED
    rk__pack4 sum = {0}, seen = {0}, half[2];
    for (; i < end; i += 8) {
        const rk__pack8 a = RK__ABS8(RK__AT(8, s->y0, i)), b = RK__ABS8(RK__AT(8, s->y1, i));
        const rk__bits8 larger = (rk__bits8)(a > b);
        const rk__bits8 most = ((rk__bits8)a & larger) | ((rk__bits8)b & ~larger);
        const rk__pack8 q = RK__AT(8, v, i) / (s->atol + s->rtol * (rk__pack8)most);
        *(rk__load8 *)half = q * q;
        sum += half[0];
        sum += half[1];
        *(rk__load8 *)half = a + b;
        seen += half[0];
        seen += half[1];
    }
    memcpy(lanes, &sum, sizeof sum);
    memcpy(lanes + 4, &seen, sizeof seen);
    RK__CLEAN
}

/* Through memory: the registers are clean when the lanes are added. */
static double rk__norm8(const rk__scale *s, ptrdiff_t i, ptrdiff_t end, const double *v,
                        double *all)
{
    double lanes[8];
    rk__norm8_lanes(s, i, end, v, lanes);
    *all = (lanes[4] + lanes[5]) + (lanes[6] + lanes[7]);
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
#endif

/* Few numbers do not pay for the call. */
static double rk__norm_fast(const rk__scale *s, ptrdiff_t i, ptrdiff_t end, const double *v,
                            double *all)
{
#ifdef RK__HAS8
    if (end - i >= 64 && (end - i) % 8 == 0 && !s->size && RK__HAS8)
        return rk__norm8(s, i, end, v, all);
#endif
#ifdef RK__HAS4
    if (end - i > 16 && RK__HAS4) return rk__norm4(s, i, end, v, all);
#endif
    return rk__norm_lanes(s, i, end, v, all);
}

/* The sum of a block is taken as it is if it did not overflow, and is so large that squares that
   underflow do not count; else the block is summed again with three scales. */
RK_API int rk_norm(double rtol, double atol, const double *size, ptrdiff_t n, const double *v,
                   const double *y0, const double *y1, double sum[4])
{
    rk__scale s;
    ptrdiff_t i;
    if (!sum || rk__absent(n, v) || rk__absent(n, y0)) return RK_ENULL;
    if (!rk__finite(rtol) || !rk__finite(atol)) return RK_ENAN;
    if (n < 0 || rtol < 0 || atol < 0) return RK_EARG;
    s.rtol = rtol;
    s.atol = atol;
    s.size = size;
    s.y0 = y0;
    s.y1 = y1 ? y1 : y0;
    for (i = 0; i < n; i += RK__NORM_BLOCK) {
        const ptrdiff_t end = rk__min(i + RK__NORM_BLOCK, n);
        double all;
        const double fast = rk__norm_fast(&s, i, end, v, &all);
        const int fits = fast > RK__TINY_SUM && fast < RK__HUGE * RK__HUGE;
        if (rk__finite(fast) && rk__finite(all) && fits) sum[0] += fast;
        else rk__norm_careful(&s, i, end, v, sum);
    }
    sum[3] += (double)n;
    return RK_OK;
}

/* sum[1] is in units of 2^(2 RK__SHIFT), sum[2] of 2^(-2 RK__SHIFT).  Each is added to the next
   larger one; sum[2] beside sum[1] is below 2^-1800 of it for each number, and left out. */
RK_API double rk_rms(const double sum[4])
{
    int i;
    if (!sum) return rk__nan();
    for (i = 0; i < 4; i++)
        if (!rk__finite(sum[i])) return HUGE_VAL;
    if (!(sum[3] > 0)) return 0;
    if (sum[1] > 0) {
        const double all = sum[1] + ldexp(sum[0], -2 * RK__SHIFT);
        return ldexp(sqrt(all / sum[3]), RK__SHIFT);
    }
    if (sum[0] > 0 && sum[2] == 0) return sqrt(sum[0] / sum[3]); /* nearly always */
    if (sum[0] > 0) return sqrt((sum[0] + ldexp(sum[2], -2 * RK__SHIFT)) / sum[3]);
    return ldexp(sqrt(sum[2] / sum[3]), -RK__SHIFT);
}

/* error^2/hypot(error, companion/10), without overflow; a subnormal result may be 0. */
RK_API double rk_companion(double error, double companion)
{
    if (!rk__finite(error) || !rk__finite(companion)) return HUGE_VAL;
    if (error < 0 || companion < 0) return rk__nan();
    return error == 0 ? 0 : error / hypot(1, companion / 10 / error);
}

/* b - bhat is of the order of the lower one of the two, whichever that is. */
RK_API int rk_estimate(const rk_table *T)
{
    const int status = rk__table_status(T);
    if (status < 0) return status;
    if (!T->bhat || T->order_hat < 1) return RK_ENOPAIR;
    /* error ~ h^(order_hat+1) and companion ~ h^4, so error^2/companion ~ h^(2 order_hat-2) */
    if (T->e3 && T->order_hat >= 3) return 2 * T->order_hat - 3;
    return T->order_hat < T->order ? T->order_hat : T->order;
}

/* The five exponents of a method; NULL: there is none of that name. */
static const double *rk__exponents(const char *method)
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
    const size_t count = sizeof known / sizeof *known;
    size_t i;
    for (i = 0; i < count; i++)
        if (strcmp(known[i].name, method) == 0) return known[i].k;
    return NULL;
}

/* All fields of the control and their defaults; a field that is not named here is 0, which means
   off. */
RK_API int rk_control_order(rk_control *C, const char *method, int order)
{
    const double *k;
    if (!C || !method) return RK_ENULL;
    if (order < 1) return RK_EARG;
    k = rk__exponents(method);
    if (!k) return RK_ENAME;
    memset(C, 0, sizeof *C);
    memcpy(C->k, k, sizeof C->k);
    C->order = C->order_calibrated = order;
    C->safety = 0.9;
    C->grow = 10;
    C->first = 1e4;
    C->shrink = 0.1;
    C->again = 0.3;
    C->accept = 1;
    C->least = 1e-4; /* an exact step must not rule the next two */
    C->stop = rk__nan();
    return RK_OK;
}

/* Of an implicit table the estimate can be as small as the error of the step, or smaller, where the
   problem is stiff: calibrated it would promise too much. */
RK_API int rk_control_make(rk_control *C, const char *method, const rk_table *T)
{
    const int order = rk_estimate(T);
    int status;
    if (order < 0) return order;
    status = rk_control_order(C, method, order);
    if (status < 0) return status;
    if (rk_is(T, RK_EXPLICIT) && T->order > order) C->order_calibrated = T->order;
    return RK_OK;
}

/* From t to the stop time; 0: none lies ahead. */
static double rk__left(const rk_control *C, double t, double h)
{
    const double left = rk__finite(C->stop) ? C->stop - t : 0;
    return (left > 0) == (h > 0) ? left : 0;
}

/* |h| within smallest and largest. */
RK__APART double rk__sized(const rk_control *C, double h)
{
    if (C->largest > 0 && fabs(h) > C->largest) h = copysign(C->largest, h);
    return fabs(h) < C->smallest ? copysign(C->smallest, h) : h;
}

/* The step from t to the stop time, `left` away.  t + left may round to a number beyond it, where
   f need not exist: then an ulp less, and rk__arrive meets it all the same. */
static double rk__last_step(const rk_control *C, double t, double left)
{
    volatile double rest = left, end = t + rest; /* volatile: the sum as it is stored */
    const int beyond = left > 0 ? end > C->stop : end < C->stop;
    return beyond ? nextafter(left, 0) : left;
}

/* h, but not beyond the stop time; C->wanted keeps the size before a cut, 0: none.  A rest of at
   most one step is one step, of less than two is two equal ones.  In either case a step may be
   below C->smallest. */
static double rk__cut(rk_control *C, double t, double h)
{
    const double left = rk__left(C, t, h);
    C->wanted = 0;
    if (left == 0 || fabs(left) >= 2 * fabs(h)) return h;
    C->wanted = h;
    return fabs(left) <= fabs(h) * (1 + RK__ULPS) ? rk__last_step(C, t, left) : left / 2;
}

/* The size before the last cut is what the step control had asked for. */
RK_API int rk_control_stop(rk_control *C, double stop, double t, double *h)
{
    if (!C || !h) return RK_ENULL;
    if (!rk__finite(t) || !rk__finite(*h)) return RK_ENAN;
    if (*h == 0) return RK_EARG;
    C->stop = stop;
    if (C->wanted != 0 && (C->wanted > 0) == (*h > 0)) *h = C->wanted;
    *h = rk__cut(C, t, rk__sized(C, *h));
    return RK_OK;
}

/* The error e that the step is judged by, and the q with which it falls as h^(q+1). */
static double rk__judged(const rk_control *C, double error, double h, int *order)
{
    double per = fabs(h);
    const int calibrated = C->calibrate > 0 && C->order_calibrated > C->order;
    const int smooth = C->rejected < RK__EVENT; /* else length/|h| stays at most RK__EVENT_PER */
    *order = C->order;
    if (!rk__finite(error)) return error;
    if (calibrated && smooth) {
        *order = C->order_calibrated;
        error = pow(error * C->calibrate, (*order + 1.) / (C->order + 1.)) / C->calibrate;
    }
    if (!(C->length > 0)) return error;
    if (smooth) *order -= 1;
    else per = fmax(per, C->length / RK__EVENT_PER);
    return error * (C->length / per);
}

/* Soderlind's product over the history, or the plain law where there is none that applies. */
static double rk__factor(const rk_control *C, double error, double h, int order, int reject)
{
    const int two = C->h[1] != 0;
    const double power = 1 / (order + 1.), e1 = C->e[0], e2 = two ? C->e[1] : e1;
    double r1, r2;
    if (!rk__finite(error)) return 0;
    if (error == 0) return DBL_MAX;
    if (reject || C->h[0] == 0) return C->safety * pow(error, -power);
    r1 = fabs(h / C->h[0]);
    r2 = two ? fabs(C->h[0] / C->h[1]) : 1;
    return C->safety * pow(error, -C->k[0] * power) * pow(e1, -C->k[1] * power) *
           pow(e2, -C->k[2] * power) * pow(r1, C->k[3]) * pow(r2, C->k[4]);
}

/* A factor within the limits of the control; of a NaN the smallest one. */
static double rk__limited(const rk_control *C, double factor, int reject)
{
    double most = C->steps ? C->grow : C->first;
    if (!(factor >= C->shrink)) factor = C->shrink;
    if (reject) most = C->rejected >= RK__EVENT ? C->again : RK__REPEAT;
    else if (C->rejected) most = 1; /* no growth right after a failure */
    return factor < most ? factor : most;
}

/* After a step that the stop time had cut: the larger of `next` and the size wanted before, the
   latter no larger than the error of the cut step allows. */
static double rk__uncut(const rk_control *C, double error, double h, int order, double next)
{
    double back = fabs(C->wanted);
    if (error > 0) back = fmin(back, fabs(h) * C->safety * pow(error, -1 / (order + 1.)));
    return fabs(next) < back ? copysign(back, next) : next;
}

/* `next` is brought within the limits.  RK_ETINY if that would not move t, or if h is not above the
   smallest size; else repeat with it, not beyond the stop time. */
static int rk__reject(rk_control *C, double t, double next, double *h)
{
    const double size = rk__sized(C, next);
    volatile double moved = t + size; /* volatile: the sum as it is stored */
    if (moved == t || fabs(*h) <= C->smallest) return RK_ETINY;
    *h = rk__cut(C, t, size);
    C->rejected++;
    return RK_REJECT;
}

/* The last two accepted steps are the memory of Soderlind's law.  Behind a step that `stop` has cut
   to less than half it begins anew: its error, raised to `least`, would not belong to its h. */
static void rk__remember(rk_control *C, double error, double h)
{
    C->rejected = 0;
    if (C->steps < INT_MAX) C->steps++;
    C->e[1] = C->e[0];
    C->e[0] = error > C->least ? error : C->least;
    C->h[1] = C->h[0];
    C->h[0] = h;
    if (fabs(h) < fabs(C->wanted) / 2) C->h[0] = C->h[1] = 0;
}

/* t + h, or the stop time where that is meant. */
static double rk__arrive(const rk_control *C, double t, double h)
{
    const double end = t + h;
    if (rk__left(C, t, h) == 0) return end;
    return fabs(end - C->stop) <= RK__ULPS * fmax(fabs(t), fabs(end)) ? C->stop : end;
}

/* Go on from the end of the step; the next one has to move t, whatever its limits are. */
static int rk__accept(rk_control *C, double error, double next, double *t, double *h)
{
    *t = rk__arrive(C, *t, *h);
    rk__remember(C, error, *h);
    if (next == 0) next = *h; /* underflow */
    next = rk__sized(C, next);
    if (fabs(next) < RK__ULPS * fabs(*t)) next = copysign(RK__ULPS * *t, next);
    *h = rk__cut(C, *t, next);
    return RK_OK;
}

/* Judge the error, take the factor of the law and the limits, then accept or reject. */
RK_API int rk_control_step(rk_control *C, double error, double *t, double *h)
{
    double judged, next;
    int order, reject;
    if (!C || !t || !h) return RK_ENULL;
    if (!rk__finite(*t) || !rk__finite(*h) || !rk__finite(*t + *h)) return RK_ENAN;
    if (*h == 0 || C->order < 1 || (rk__finite(error) && error < 0)) return RK_EARG;
    judged = rk__judged(C, error, *h, &order);
    reject = !rk__finite(judged) || !(judged <= C->accept);
    next = *h * rk__limited(C, rk__factor(C, judged, *h, order, reject), reject);
    if (!reject && C->wanted != 0) next = rk__uncut(C, judged, *h, order, next);
    if (!rk__finite(next)) next = *h; /* cannot grow */
    return reject ? rk__reject(C, *t, next, h) : rk__accept(C, judged, next, t, h);
}

/* Trial size: explicit Euler changes y by d1 h = 0.01 d0.  Then the h of h^(order+1) max(d1, d2) =
   0.01. */
RK_API double rk_first_step(int order, double length, double d0, double d1, double d2)
{
    const double given[] = {length, d0, d1, d2};
    double trial, most;
    if (!rk__all_finite(4, given)) return rk__nan();
    if (order < 0 || !(length > 0) || d0 < 0 || d1 < 0) return rk__nan();
    trial = length / 1e4; /* a state within its tolerance, or at rest, has no time scale */
    if (d0 >= 1 && d1 > 0) trial = fmin(0.01 * d0 / d1, length / 100);
    if (d2 < 0) return trial;
    most = fmax(d1, d2);
    if (!(most > 0)) return 100 * trial;
    return fmin(fmin(100 * trial, length), pow(0.01 / most, 1 / (order + 1.)));
}

/* ---- the host's memory ----------------------------------------------------------------------- */

#define RK__REACH_MAX 3 /* highest stiff order - 1 that rk_extend asks for: more enlarges |R|, d */

/* rk_extend, with D = max(order, RK__REACH_MAX): A to d take m m + 5 m + m D (rk__lay_out), the
   matrices of the fit m (m + D) + m (m + 2) + 4 m m (rk__derive).  rk_collocation needs less: A, b,
   c, d and 13 bytes for the name. */
RK_API size_t rk_size(int stages, int order)
{
    const size_t m = (size_t)stages, D = (size_t)(order > RK__REACH_MAX ? order : RK__REACH_MAX);
    if (!rk__within(stages, 1, RK_STAGES_MAX) || !rk__within(order, 0, RK_ORDER_MAX)) return 0;
    return m * (7 * m + 2 * D + 7) * sizeof(double);
}

/* The host's memory is read and written as doubles: it has to be aligned for them. */
static int rk__memory_status(const void *mem, size_t bytes, size_t least)
{
    return !mem || (uintptr_t)mem % sizeof(double) || bytes < least ? RK_EMEM : RK_OK;
}

/* ---- collocation: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.5 ------------
   The inner nodes are the zeros of P_s (Gauss), P_s - P_{s-1} but 1 (Radau IIA) or P'_{s-1}
   (Lobatto), P_n being Legendre's polynomials. */

#define RK__NEWTON 13 /* 12 do for s <= 10; no test: the last bit may flip for ever */

/* The polynomial whose zeros are the inner nodes, see above, and its derivative; x in [-1, 1]. */
static void rk__node_polynomial(int family, int s, double x, double *f, double *df)
{
    const int lobatto = family >= RK_LOBATTO_IIIA, n = lobatto ? s - 1 : s;
    double P[3] = {1, 0, 0}, Q[3] = {0, 0, 0}; /* P_k, P_{k-1}, each with two derivatives */
    int k, r;
    for (k = 0; k < n; k++)
        for (r = 2; r >= 0; r--) { /* (k+1) P_{k+1} = (2k+1) x P_k - k P_{k-1}, differentiated */
            const double lower = r > 0 ? r * P[r - 1] : 0;
            const double next = ((2 * k + 1) * (x * P[r] + lower) - k * Q[r]) / (k + 1);
            Q[r] = P[r];
            P[r] = next;
        }
    *f = P[lobatto]; /* of Lobatto the derivative */
    *df = P[lobatto + 1];
    if (family == RK_RADAU_IIA) {
        *f -= Q[0];
        *df -= Q[1];
    }
}

/* The next zero to the right: Newton's iteration from x = -1 for f divided by x - z for each zero z
   known so far.  All zeros that are left are real and lie to the right of -1, so x rises to the
   smallest of them and never passes it. */
static double rk__next_node(int family, int s, const double *known, int count)
{
    double x = -1, f, df;
    int step, j;
    for (step = 0; step < RK__NEWTON; step++) {
        rk__node_polynomial(family, s, x, &f, &df);
        for (j = 0; j < count; j++) df -= f / (x - (2 * known[j] - 1));
        x -= f / df;
    }
    return (1 + x) / 2;
}

/* Nodes c in [0, 1], ascending. */
static void rk__nodes(int family, int s, double *c)
{
    const int first = family >= RK_LOBATTO_IIIA, right = family != RK_GAUSS;
    int i;
    if (first) c[0] = 0;
    if (right) c[s - 1] = 1;
    for (i = first; i < s - right; i++) c[i] = rk__next_node(family, s, c + first, i - first);
}

/* Gauss' nodes and weights on [0, 1]: 1/((1 - x^2) P_s'(x)^2) with x = 2 node - 1. */
static void rk__gauss(int s, double *node, double *weight)
{
    double f, df;
    int i;
    rk__nodes(RK_GAUSS, s, node);
    for (i = 0; i < s; i++) {
        rk__node_polynomial(RK_GAUSS, s, 2 * node[i] - 1, &f, &df);
        weight[i] = 1 / (4 * node[i] * (1 - node[i]) * df * df);
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

/* Its integral from 0 to t, by Gauss' rule: exact for the degree, without cancelling powers. */
static double rk__lagrange_integral(int s, const double *c, int j, double t)
{
    double node[RK_ORDER_MAX], weight[RK_ORDER_MAX], sum = 0;
    int l;
    rk__gauss(s, node, weight);
    for (l = 0; l < s; l++) sum += t * weight[l] * rk__lagrange(s, c, j, t * node[l]);
    return sum;
}

/* Its s coefficients of 1, x, x^2, ...: one factor (x - c_l)/(c_j - c_l) after the other. */
static void rk__lagrange_powers(int s, const double *c, int j, double *p)
{
    int i, l, degree = 0;
    p[0] = 1;
    for (l = 0; l < s; l++) {
        const double gap = c[j] - c[l];
        if (l == j) continue;
        p[degree + 1] = p[degree] / gap;
        for (i = degree; i >= 1; i--) p[i] = (p[i - 1] - c[l] * p[i]) / gap;
        p[0] *= -c[l] / gap;
        degree++;
    }
}

/* a_ij of a family; b and c are known. */
static double rk__collocation_entry(int family, int s, const double *b, const double *c, int i,
                                    int j)
{
    if (family == RK_LOBATTO_IIIB) /* symplectic with IIIA: b_i a_ij + b_j abar_ji = b_i b_j */
        return b[j] * (1 - rk__lagrange_integral(s, c, i, c[j]) / b[i]);
    if (i == s - 1 && c[i] == 1) return b[j]; /* the last row is b */
    if (family != RK_LOBATTO_IIIC) return rk__lagrange_integral(s, c, j, c[i]);
    if (j == 0) return b[0]; /* IIIC: a_i0 = b_0, the rest exact for degree s-2 */
    return rk__lagrange_integral(s - 1, c + 1, j - 1, c[i]) -
           b[0] * rk__lagrange(s - 1, c + 1, j - 1, 0);
}

/* T's arrays one behind the other in mem, the name at the end. */
RK_API int rk_collocation(rk_table *T, int family, int s, void *mem, size_t bytes)
{
    static const char *const names[] = {"gauss", "radauIIA", "lobattoIIIA", "lobattoIIIB",
                                        "lobattoIIIC"};
    const int least = family >= RK_LOBATTO_IIIA ? 2 : 1, most = 5;
    double *A, *b, *c, *d;
    char *name;
    int i, j;
    if (!T) return RK_ENULL;
    if (!rk__within(family, RK_GAUSS, RK_LOBATTO_IIIC)) return RK_EARG;
    if (!rk__within(s, least, most)) return RK_EARG;
    if (rk__memory_status(mem, bytes, rk_size(s, s))) return RK_EMEM;
    A = (double *)mem;
    b = A + s * s;
    c = b + s;
    d = c + s;
    name = (char *)(d + s * s);
    rk__nodes(family, s, c);
    for (j = 0; j < s; j++) b[j] = rk__lagrange_integral(s, c, j, 1);
    for (i = 0; i < s; i++)
        for (j = 0; j < s; j++) A[i * s + j] = rk__collocation_entry(family, s, b, c, i, j);
    for (j = 0; j < s; j++) { /* d_j: the integral of the j-th polynomial, in powers of theta */
        rk__lagrange_powers(s, c, j, d + j * s);
        for (i = 0; i < s; i++) d[j * s + i] /= i + 1;
    }
    memset(T, 0, sizeof *T);
    T->name = strcpy(name, names[family - RK_GAUSS]);
    name += strlen(name);
    name[0] = (char)('0' + s);
    name[1] = 0;
    T->stages = T->powers = T->dense_order = s;
    T->order = 2 * s - 2;
    if (family == RK_RADAU_IIA) T->order = 2 * s - 1;
    if (family == RK_GAUSS) T->order = 2 * s;
    if (family == RK_LOBATTO_IIIB) T->dense_order = s - 1;
    T->A = A;
    T->b = b;
    T->c = c;
    T->d = d;
    return RK_OK;
}

/* ---- rooted trees and order conditions -------------------------------------------------------
   A tree is its level sequence: the depth of each vertex in depth-first order.  The subtrees of a
   vertex are in falling lexicographic order of their own level sequences.  All rooted trees with n
   vertices follow from 0 1 2 ... n-1 (Beyer & Hedetniemi 1980).
   A vertex may carry a colour: which part's slope it is.  Every colouring of every shape is
   visited, so that a coloured tree with symmetries comes more than once: no maximum changes. */

#define RK__PARTS    4
#define RK__RESIDUAL_MAX 1e-10 /* a residual of this size is wrong however large its terms are */
#define RK__COEFFICIENT_MAX 1e5 /* the rounding of such a number is 1e-11 */

typedef struct rk__tree {
    int n, level[RK_ORDER_MAX], colour[RK_ORDER_MAX];
} rk__tree;

/* The tallest tree, 0 1 2 ... n-1, all of the first colour. */
static void rk__tree_first(rk__tree *t, int n)
{
    int i;
    memset(t, 0, sizeof *t);
    t->n = n;
    for (i = 0; i < n; i++) t->level[i] = i;
}

/* In depth-first order the parent is the nearest vertex before i that is one level up. */
static int rk__tree_parent(const rk__tree *t, int i)
{
    int p = i - 1;
    while (t->level[p] >= t->level[i]) p--;
    return p;
}

/* The vertex behind the subtree of i. */
static int rk__tree_end(const rk__tree *t, int i)
{
    int j = i + 1;
    while (j < t->n && t->level[j] > t->level[i]) j++;
    return j;
}

/* The next colouring, or the first one of the next tree: p is the last vertex of level > 1, q its
   parent; from p on the levels repeat those from q to p - 1.  0: that was the last tree. */
static int rk__tree_next(rk__tree *t, int colours)
{
    int i, p = t->n - 1, q;
    for (i = 0; i < t->n; i++) { /* the next colouring, as one counts */
        if (++t->colour[i] < colours) return 1;
        t->colour[i] = 0;
    }
    while (p > 0 && t->level[p] == 1) p--;
    if (p <= 0) return 0;
    q = rk__tree_parent(t, p);
    for (i = p; i < t->n; i++) t->level[i] = t->level[i - (p - q)];
    return 1;
}

/* gamma: the product over all vertices of the size of the subtree that each is the root of. */
static double rk__tree_gamma(const rk__tree *t)
{
    double gamma = 1;
    int i;
    for (i = 0; i < t->n; i++) gamma *= rk__tree_end(t, i) - i;
    return gamma;
}

/* A partitioned method: the stages of part p take the slopes of part q by A[p][q], s[p] rows, ld[q]
   apart.  A vertex of colour p is a slope of part p.  A leaf of colour `parts` is time: it
   multiplies its parent, of colour p, by c[p], where one of colour q multiplies it by the row sums
   of A[p][q]. */
typedef struct rk__method {
    int parts, s[RK__PARTS], ld[RK__PARTS];
    const double *A[RK__PARTS][RK__PARTS], *c[RK__PARTS];
} rk__method;

/* A vertex of colour `parts` has no slopes of its own: only a leaf below the root may have it. */
static int rk__tree_has_meaning(const rk__method *M, const rk__tree *t)
{
    int i;
    for (i = 0; i < t->n; i++)
        if (t->colour[i] == M->parts && (i == 0 || rk__tree_end(t, i) > i + 1)) return 0;
    return 1;
}

/* *sum = sum_j a_j v_j; returns the size of its terms, sum_j |a_j| size_j. */
static double rk__row_times(int s, const double *a, const double *v, const double *size,
                            double *sum)
{
    double total = 0;
    int j;
    *sum = 0;
    for (j = 0; j < s; j++) {
        *sum += a[j] * v[j];
        total += fabs(a[j]) * size[j];
    }
    return total;
}

/* Phi(tree) for each stage of the root's colour, and the size of the terms in it: from the last
   vertex to the first, each multiplies its parent. */
static void rk__tree_phi(const rk__method *M, const rk__tree *t, double *phi, double *size)
{
    double v[RK_ORDER_MAX][RK_STAGES_MAX], sizes[RK_ORDER_MAX][RK_STAGES_MAX], sum;
    int i, l;
    for (i = 0; i < t->n; i++) {
        const int own = t->colour[i] < M->parts ? M->s[t->colour[i]] : 0;
        for (l = 0; l < own; l++) v[i][l] = sizes[i][l] = 1;
    }
    for (i = t->n - 1; i > 0; i--) {
        const int up = rk__tree_parent(t, i), p = t->colour[up], q = t->colour[i];
        for (l = 0; l < M->s[p]; l++) {
            double terms;
            if (q < M->parts)
                terms = rk__row_times(M->s[q], M->A[p][q] + l * M->ld[q], v[i], sizes[i], &sum);
            else { /* a leaf of time */
                sum = M->c[p][l];
                terms = fabs(sum);
            }
            v[up][l] *= sum;
            sizes[up][l] *= terms;
        }
    }
    memcpy(phi, v[0], (size_t)M->s[t->colour[0]] * sizeof *phi);
    memcpy(size, sizes[0], (size_t)M->s[t->colour[0]] * sizeof *size);
}

/* A residual in units that make RK_TOLERANCE its limit.  Relative to the size of its terms; and
   absolute, because beside terms of 1e7 that cancel a true error of 1e-8 would look small. */
static double rk__in_units(double residual, double size)
{
    return fmax(fabs(residual) / size, fabs(residual) * (RK_TOLERANCE / RK__RESIDUAL_MAX));
}

/* sum_i w_i phi_i, the w_i `ld` apart. */
static double rk__weighted(int m, const double *w, int ld, const double *phi)
{
    double sum = 0;
    int i;
    for (i = 0; i < m; i++) sum += w[i * ld] * phi[i];
    return sum;
}

/* The judged residual of one tree.  powers = 0: sum b_i Phi_i = 1/gamma.  Else each b_i is a row
   of that many powers of theta: power k gives 1/gamma where k is the order, 0 elsewhere. */
static double rk__tree_defect(const rk__method *M, const rk__tree *t, const double *b, int powers)
{
    const int m = M->s[t->colour[0]], ld = powers > 0 ? powers : 1;
    double phi[RK_STAGES_MAX], size[RK_STAGES_MAX], target = 1 / rk__tree_gamma(t);
    double scale = 0, worst = 0;
    int i, k;
    rk__tree_phi(M, t, phi, size);
    for (i = 0; i < m * ld; i++) scale += fabs(b[i]) * size[i / ld];
    if (!rk__finite(scale)) return HUGE_VAL; /* NaN, too: 0 times a stage that overflows */
    scale = fmax(scale, target);
    if (powers == 0) return rk__in_units(rk__weighted(m, b, 1, phi) - target, scale);
    if (t->n > powers) worst = rk__in_units(target, scale); /* theta^n is missing */
    for (k = 1; k <= powers; k++) {
        const double want = k == t->n ? target : 0;
        worst = fmax(worst, rk__in_units(rk__weighted(m, b + k - 1, ld, phi) - want, scale));
    }
    return worst;
}

/* The largest over all coloured trees of that order; time_apart = 1: one more colour, the leaf that
   is time. */
static double rk__defect(const rk__method *M, int time_apart, const double *const *b, int powers,
                         int order)
{
    double worst = 0;
    rk__tree t;
    rk__tree_first(&t, order);
    do {
        if (!rk__tree_has_meaning(M, &t)) continue;
        worst = fmax(worst, rk__tree_defect(M, &t, b[t.colour[0]], powers));
    } while (rk__tree_next(&t, M->parts + time_apart));
    return worst;
}

/* Whether the time of a stage is the sum of its row, up to rounding. */
static int rk__is_row_sum(double time, int s, const double *a)
{
    double sum = -time, size = fabs(time);
    int j;
    for (j = 0; j < s; j++) {
        sum += a[j];
        size += fabs(a[j]);
    }
    return rk__finite(size) && fabs(sum) <= RK_TOLERANCE * size;
}

/* Whether the c of a part are not the row sums of its A.  If they are, a leaf of time is the same
   as one of state. */
static int rk__time_is_apart(const rk__method *M)
{
    int p, i;
    for (p = 0; p < M->parts; p++)
        for (i = 0; i < M->s[p]; i++)
            if (!rk__is_row_sum(M->c[p][i], M->s[p], M->A[p][p] + i * M->ld[p])) return 1;
    return 0;
}

/* A table alone is a method of one part. */
static void rk__as_method(const rk_table *T, rk__method *M)
{
    M->parts = 1;
    M->s[0] = M->ld[0] = rk__rows(T);
    M->A[0][0] = T->A;
    M->c[0] = T->c;
}

/* The other half, of the same size: its slopes are of colour 1. */
static void rk__add_half(const rk_table *other, rk__method *M)
{
    int p;
    M->parts = 2;
    M->s[1] = M->ld[1] = rk__rows(other);
    for (p = 0; p < 2; p++) {
        M->A[p][0] = M->A[0][0];
        M->A[p][1] = other->A;
    }
    M->c[1] = other->c;
}

/* The weights of a kind and their powers of theta; NULL where the table has none. */
static const double *rk__weights_of(const rk_table *T, int which, int *powers)
{
    *powers = which == RK_OF_DENSE ? T->powers : 0;
    if (which == RK_OF_STEP) return T->b;
    if (which == RK_OF_PAIR) return T->bhat;
    return which == RK_OF_DENSE && T->powers > 0 ? T->d : NULL;
}

RK_API double rk_defect(const rk_table *T, const rk_table *other, int which, int order)
{
    const double *b[2];
    int powers, powers_other;
    rk__method M;
    if (rk__table_status(T) || (other && rk__table_status(other))) return rk__nan();
    b[0] = rk__weights_of(T, which, &powers);
    if (!b[0] || !rk__within(order, 1, RK_ORDER_MAX)) return rk__nan();
    rk__as_method(T, &M);
    if (other) {
        b[1] = rk__weights_of(other, which, &powers_other);
        if (!b[1] || powers_other != powers || rk__rows(other) != rk__rows(T)) return rk__nan();
        rk__add_half(other, &M);
    }
    return rk__defect(&M, rk__time_is_apart(&M), b, powers, order);
}

/* No colour for time: a general-structure method is given without c. */
RK_API double rk_defect_gark(int order, int parts, const int *s, const double *const *A,
                             const double *const *b)
{
    rk__method M;
    int p, q;
    if (!s || !A || !b || !rk__within(order, 1, RK_ORDER_MAX)) return rk__nan();
    if (!rk__within(parts, 1, RK__PARTS)) return rk__nan();
    M.parts = parts;
    for (p = 0; p < parts; p++) {
        if (!b[p] || !rk__within(s[p], 1, RK_STAGES_MAX)) return rk__nan();
        M.s[p] = M.ld[p] = s[p];
        for (q = 0; q < parts; q++) {
            M.A[p][q] = A[p * parts + q];
            if (!M.A[p][q]) return rk__nan();
        }
    }
    return rk__defect(&M, 0, b, 0, order);
}

/* ---- properties ------------------------------------------------------------------------------ */

static int rk__are_zeros(int n, const double *v)
{
    int i;
    for (i = 0; i < n; i++)
        if (v[i] != 0) return 0;
    return 1;
}

/* Whether a_ij = 0 for j >= i + above. */
static int rk__is_lower(const rk_table *T, int above)
{
    const int m = rk__rows(T);
    int i;
    for (i = 0; i < m; i++)
        if (!rk__are_zeros(m - i - above, T->A + i * m + i + above)) return 0;
    return 1;
}

/* To the bit: ynew then is the last stage value itself. */
static int rk__last_row_is_b(const rk_table *T)
{
    const double *last = T->A + (T->stages - 1) * rk__rows(T);
    int j;
    for (j = 0; j < T->stages; j++)
        if (last[j] != T->b[j]) return 0;
    return 1;
}

/* The first row must be zero as well: k_0 = f(t, y) is what the last slope can stand for. */
static int rk__first_is_last(const rk_table *T)
{
    if (T->stages < 2 || T->c[0] != 0 || T->c[T->stages - 1] != 1) return 0;
    return rk__are_zeros(T->stages, T->A) && rk__last_row_is_b(T);
}

RK_API int rk_is(const rk_table *T, int property)
{
    const int status = rk__table_status(T);
    if (status < 0) return status;
    switch (property) {
    case RK_EXPLICIT: return rk__is_lower(T, 0);
    case RK_SEQUENTIAL: return rk__is_lower(T, 1);
    case RK_STIFFLY_ACCURATE: return rk__last_row_is_b(T);
    case RK_FSAL: return rk__first_is_last(T);
    }
    return RK_EARG;
}

/* ---- stiff parts ------------------------------------------------------------------------------
   Tables A = [0 0; B S]: `first` leading rows of zeros with c_i = 0, whose slopes are f(t, y), then
   S, lower triangular with a_ii > 0.
   d_k is the column of power k of d, and ds_k, bs(theta) are what belongs to the rows of S; ^T:
   transposed, 1: a vector of ones.  For y' = lambda y, z = h lambda, u(theta) = R(z, theta) y.
   As z -> -inf the coefficient of theta^k in R stays bounded if and only if the sum of d_k over the
   leading rows is ds_k^T S^-1 B 1; then R(-inf, theta) = 1 - bs(theta)^T (S^-1 1 + S^-2 B 1).
   If u is bounded, the slopes of the leading rows cancel: u = y + bs(theta)^T S^-1 (Y - y 1), with
   the stage values Y of S.  These lie on the slow solution as z -> -inf.  So u is exact for a slow
   solution theta^r if and only if ds_k^T S^-1 c^r = [k = r] for each k, where [k = r] is 1 if k =
   r, else 0.  Exact for r = 1 to reach, its error there is O(h^(reach+1)): the stiff order,
   dense_stiff, is reach + 1. */

/* Of rows or columns: entries incx and incy apart. */
RK__APART double rk__dot(int n, const double *x, int incx, const double *y, int incy)
{
    double sum = 0;
    int i;
    for (i = 0; i < n; i++) sum += x[i * incx] * y[i * incy];
    return sum;
}

/* The number of leading rows of zeros, or -1 where the table has another form. */
static int rk__leading(int m, const double *A, int ld, const double *c)
{
    int i, first = 0;
    while (first < m && c[first] == 0 && rk__are_zeros(m, A + first * ld)) first++;
    for (i = first; i < m; i++) {
        const double *a = A + i * ld;
        if (!(a[i] > 0) || !rk__are_zeros(m - i - 1, a + i + 1)) return -1;
    }
    return first < m ? first : -1;
}

/* x = S^-1 r, and 0 in the leading rows. */
static void rk__substitute(int m, const double *A, int ld, int first, const double *r, double *x)
{
    int i;
    for (i = 0; i < first; i++) x[i] = 0;
    for (i = first; i < m; i++) {
        const double *a = A + i * ld;
        x[i] = (r[i] - rk__dot(i - first, a + first, 1, x + first, 1)) / a[i];
    }
}

/* u is bounded if and only if growth^T d_k = 0 for all k; R(-inf, theta) = 1 - limit^T b(theta). */
static void rk__stiff_rows(int m, const double *A, int ld, int first, double *growth,
                           double *limit)
{
    double r[RK_STAGES_MAX] = {0}, x[RK_STAGES_MAX];
    int i, j;
    for (i = 0; i < m; i++)
        for (j = 0; j < first; j++) r[i] += A[i * ld + j];
    rk__substitute(m, A, ld, first, r, x);
    for (i = 0; i < m; i++) {
        growth[i] = i < first ? 1 : -x[i];
        r[i] = 1 + x[i];
    }
    rk__substitute(m, A, ld, first, r, limit);
}

/* S^-1 c^power. */
static void rk__stiff_power(int m, const double *A, int ld, int first, const double *c, int power,
                            double *row)
{
    double r[RK_STAGES_MAX];
    int i;
    for (i = 0; i < m; i++) r[i] = pow(c[i], power);
    rk__substitute(m, A, ld, first, r, row);
}

/* Whether sum_i row_i d_ik = [k = power] for every k. */
static int rk__stiff_row_holds(int m, const double *row, const double *d, int powers, int power,
                               double *defect)
{
    int i, k;
    *defect = HUGE_VAL;
    if (power > powers) return 0; /* theta^power is missing */
    for (k = 1; k <= powers; k++) {
        double sum = k == power ? -1 : 0, size = 1;
        for (i = 0; i < m; i++) {
            const double term = row[i] * d[i * powers + k - 1];
            sum += term;
            size += fabs(term);
        }
        *defect = rk__finite(size) ? rk__in_units(sum, size) : HUGE_VAL;
        if (!(*defect <= RK_TOLERANCE)) return 0;
    }
    return 1;
}

/* Whether u stays bounded as z -> -inf and is exact for the slow solutions theta to theta^reach. */
static int rk__has_reach(int m, const double *A, int ld, const double *c, const double *d,
                         int powers, int reach, double *defect)
{
    const int first = rk__leading(m, A, ld, c);
    double row[RK_STAGES_MAX], limit[RK_STAGES_MAX];
    int power;
    if (first < 0) return 0;
    rk__stiff_rows(m, A, ld, first, row, limit);
    if (!rk__stiff_row_holds(m, row, d, powers, 0, defect)) return 0;
    for (power = 1; power <= reach; power++) {
        rk__stiff_power(m, A, ld, first, c, power, row);
        if (!rk__stiff_row_holds(m, row, d, powers, power, defect)) return 0;
    }
    return 1;
}

/* Whether the dense output has the stiff order that the table claims. */
static int rk__stiff_holds(const rk_table *T, double *defect)
{
    const int m = rk__rows(T);
    if (T->dense_stiff == 0) return 1; /* no claim */
    *defect = HUGE_VAL;
    if (!rk__within(T->dense_stiff, 2, RK_ORDER_MAX)) return 0;
    return rk__has_reach(m, T->A, m, T->c, T->d, T->powers, T->dense_stiff - 1, defect);
}

/* ---- claims ---------------------------------------------------------------------------------- */

/* The comparison fails for a NaN, too. */
static int rk__all_small(int n, const double *v)
{
    int i;
    for (i = 0; i < n; i++)
        if (!(fabs(v[i]) <= RK__COEFFICIENT_MAX)) return 0;
    return 1;
}

/* The arrays of a table and how long each is; one that is absent, or not read, has no numbers. */
typedef struct rk__arrays {
    const double *at[7];
    int count[7];
} rk__arrays;

/* A and d are matrices of m rows; e and e3 belong to the stages of the step alone. */
static void rk__arrays_of(const rk_table *T, rk__arrays *a)
{
    const int m = rk__rows(T), s = T->stages;
    const double *const at[] = {T->A, T->b, T->c, T->bhat, T->e, T->e3, T->d};
    const int count[] = {m * m, m, m, m, T->bhat ? s : 0, s, T->d ? m * T->powers : 0};
    int i;
    memcpy(a->at, at, sizeof at);
    for (i = 0; i < 7; i++) a->count[i] = at[i] ? count[i] : 0;
}

/* Asked before defects are formed: those of a low order do not read every number. */
static int rk__table_is_finite(const rk_table *T)
{
    rk__arrays a;
    int i;
    rk__arrays_of(T, &a);
    for (i = 0; i < 7; i++)
        if (!rk__all_finite(a.count[i], a.at[i])) return 0;
    return 1;
}

/* Whether a proof in double precision can be tried: no NaN or Inf, A and b small enough. */
static int rk__is_provable(const rk_table *T)
{
    const int m = rk__rows(T);
    return rk__table_is_finite(T) && rk__all_small(m, T->b) && rk__all_small(m * m, T->A);
}

/* Whether the step takes a slope that is there for dense output only. */
static int rk__takes_extra(const rk_table *T)
{
    const int m = rk__rows(T);
    int i, j;
    for (j = T->stages; j < m; j++) {
        if (T->b[j] != 0 || (T->bhat && T->bhat[j] != 0)) return 1;
        for (i = 0; i < T->stages; i++)
            if (T->A[i * m + j] != 0) return 1;
    }
    return 0;
}

/* Whether the claims fit together, whatever the numbers are. */
static int rk__claims_clash(const rk_table *T)
{
    if (T->order < 1 || T->order_hat < 0 || T->powers < 0 || T->dense_order < 0) return 1;
    if ((T->order_hat > 0) != (T->bhat != NULL)) return 1;
    if ((T->powers > 0) != (T->dense_order > 0)) return 1;
    if (T->powers == 0 && T->dense_stiff != 0) return 1;
    return T->e3 && T->order_hat < 3; /* the estimate's order 2 order_hat - 3 is below order_hat */
}

/* Pointers, then claims, then numbers: what comes later reads what was checked before. */
static int rk__claims_status(const rk_table *T)
{
    const int status = rk__table_status(T);
    if (status < 0) return status;
    if (T->powers > 0 && !T->d) return RK_ENULL;
    if (rk__claims_clash(T) || !rk__is_provable(T) || rk__takes_extra(T)) return RK_ETABLE;
    return RK_OK;
}

/* Whether rk_finish's e is b - bhat. */
static int rk__error_holds(const rk_table *T, double *defect)
{
    double room[RK_STAGES_MAX];
    const double *e = rk__pair_weights(T, room);
    int j;
    for (j = 0; j < T->stages; j++) {
        const double s = fabs(T->b[j]) + fabs(T->bhat[j]);
        *defect = fabs(e[j] - (T->b[j] - T->bhat[j])) / (s + DBL_EPSILON);
        if (!(*defect <= RK_TOLERANCE)) return 0;
    }
    return 1;
}

/* Whether b_i(1) = b_i. */
static int rk__ends_in_b(const rk_table *T, double *defect)
{
    int i, j;
    for (i = 0; i < rk__rows(T); i++) {
        double sum = -T->b[i], size = fabs(T->b[i]) + DBL_EPSILON;
        for (j = 0; j < T->powers; j++) {
            sum += T->d[i * T->powers + j];
            size += fabs(T->d[i * T->powers + j]);
        }
        *defect = fabs(sum) / size;
        if (!(*defect <= RK_TOLERANCE)) return 0;
    }
    return 1;
}

/* Whether all orders up to `order` hold, the last defect looked at in *defect. */
RK__APART int rk__holds(const rk_table *T, const rk_table *other, int which, int order,
                        double *defect)
{
    const ptrdiff_t most = rk__min(order, RK_ORDER_MAX);
    int p;
    for (p = 1; p <= most; p++) {
        *defect = rk_defect(T, other, which, p);
        if (!(*defect <= RK_TOLERANCE)) return 0;
    }
    return 1;
}

/* Whether e3 is the difference of b and weights of order 3. */
static int rk__companion_holds(const rk_table *T, double *defect)
{
    double third[RK_STAGES_MAX] = {0};
    rk_table pair = *T;
    int j;
    if (!T->e3) return 1;
    for (j = 0; j < T->stages; j++) third[j] = T->b[j] - T->e3[j];
    pair.bhat = third;
    return rk__holds(&pair, NULL, RK_OF_PAIR, 3, defect);
}

/* The first claim that fails names the status: step, pair, dense output. */
RK_API int rk_check(const rk_table *T, double *defect)
{
    const int status = rk__claims_status(T);
    double ignored;
    rk__method M;
    if (!defect) defect = &ignored;
    *defect = HUGE_VAL;
    if (status < 0) return status;
    if (!rk__holds(T, NULL, RK_OF_STEP, T->order, defect)) return RK_ESTEP;
    if (T->bhat && !rk__error_holds(T, defect)) return RK_EPAIR;
    if (!rk__companion_holds(T, defect)) return RK_EPAIR;
    if (!rk__holds(T, NULL, RK_OF_PAIR, T->order_hat, defect)) return RK_EPAIR;
    if (T->powers > 0) {
        if (!rk__holds(T, NULL, RK_OF_DENSE, T->dense_order, defect)) return RK_EDENSE;
        if (!rk__ends_in_b(T, defect) || !rk__stiff_holds(T, defect)) return RK_EDENSE;
    }
    *defect = 0;
    rk__as_method(T, &M);
    return rk__time_is_apart(&M) ? RK_ROWSUM : RK_OK;
}

/* The conditions of both halves together are asked for at the orders that both claim. */
static int rk__same_claims(const rk_table *T, const rk_table *other)
{
    return T->order == other->order && T->order_hat == other->order_hat && !T->e3 == !other->e3 &&
           T->powers == other->powers && T->dense_order == other->dense_order;
}

/* Each half alone, then both together; rk_check of a half tells which one is wrong. */
RK_API int rk_check_imex(const rk_table *T, const rk_table *other, double *defect)
{
    int status = rk_check(T, defect), remark;
    double ignored;
    if (status < 0) return status;
    remark = rk_check(other, defect);
    if (remark < 0) return remark;
    if (!defect) defect = &ignored;
    *defect = HUGE_VAL;
    if (rk__rows(T) != rk__rows(other) || T->stages != other->stages) return RK_EOTHER;
    if (!rk__same_claims(T, other)) return RK_EOTHER;
    if (!rk__holds(T, other, RK_OF_STEP, T->order, defect)) return RK_ESTEP;
    if (!rk__holds(T, other, RK_OF_PAIR, T->order_hat, defect)) return RK_EPAIR;
    if (T->powers > 0 && !rk__holds(T, other, RK_OF_DENSE, T->dense_order, defect))
        return RK_EDENSE;
    *defect = 0;
    return rk__later(status, remark);
}

/* ---- dense output for any table --------------------------------------------------------------
   Uniform order q: for every tree of order <= q, sum_i d_ik Phi_i = [k = |t|]/gamma for each
   power k; one matrix for all k.  Its rows (there may be thousands) are rotated one by one into a
   triangle, a one-sided Jacobi iteration gives its singular values, hence the rank, a particular
   solution and the null space, which the conditions leave free.  It is used for wishes, met in the
   mean square over theta: the trees of order q + 1, and for stiff tables a small R(z, theta) at
   infinity and on the imaginary axis.
   Normal equations or a full-rank routine would not do: the matrix is rank deficient by design. */

#define RK__POINTS   RK_ORDER_MAX /* Gauss points for means over theta: exact up to degree 19 */
#define RK__RANK     1e-20 /* squared singular values below this share of the largest are zero */
#define RK__FLAT     1e-9  /* times the largest wish entry; |g_l| not above: no fit, x_l least */
#define RK__MISS     1e-8  /* a first look at whether conditions contradict; rk__proven decides */
#define RK__QUIET    0.01  /* weight of R(z, theta) beside the trees; 0.1 costs accuracy */
#define RK__AXIS     12    /* points y = 2 ... 60 of the imaginary axis */
#define RK__THETAS   64    /* steps of theta in which |R(z, theta)| is looked at */
#define RK__GROWTH   1.1   /* what counts as bounded */

typedef struct rk__fit {
    const rk__method *M;        /* T as laid out, with `other` as the second part */
    const double *b;            /* the dense output has to end in it, d(1) = b */
    int m, order, powers;       /* stages, uniform order, powers of theta */
    int implicit;               /* T is not explicit: without stiff conditions d may be unbounded */
    int first;                  /* leading rows of zeros; -1: T is explicit or has no proof */
    int time_apart;             /* 1: c is not the row sums of A, a leaf may be time, too */
    int reach;                  /* 0: no stiff conditions; else exact for theta^q up to this */
    double *d;                  /* the result, m rows of `powers` */
    double *triangle;           /* m (m+powers): conditions, and a right-hand side for each power */
    double *wishes;             /* m (m+2): wishes, right-hand sides of theta^(order+1) and 1 */
    double *null_space;         /* m m, of which the first `null` columns are used */
    double *V, *G, *U;          /* m m each: singular vectors; wishes on the null space; its V */
    int null;
    double miss, peak;          /* what no d can meet; largest |R(z, theta)| seen */
} rk__fit;

/* Rotate one more row into the upper triangle R of m columns; rows of w numbers, the last w - m
   of them right-hand sides.  What is left in the row is what R contradicts. */
static void rk__rotate(int m, int w, double *R, double *row)
{
    int j, l;
    for (j = 0; j < m; j++) {
        double *u = R + j * w, r, c, s;
        if (row[j] == 0) continue;
        r = hypot(u[j], row[j]);
        c = u[j] / r;
        s = row[j] / r;
        u[j] = r;
        for (l = j + 1; l < w; l++) {
            const double t = c * u[l] + s * row[l];
            row[l] = c * row[l] - s * u[l];
            u[l] = t;
        }
    }
}

/* Turn columns p and q of the r rows of a, w apart, by the angle with cosine c and sine s. */
static void rk__turn(int r, double *a, int w, int p, int q, double c, double s)
{
    int i;
    for (i = 0; i < r; i++) {
        double *x = a + i * w;
        const double u = x[p];
        x[p] = c * u - s * x[q];
        x[q] = s * u + c * x[q];
    }
}

/* a := a V with orthogonal columns, whose lengths are the singular values (one-sided Jacobi);
   a is r rows of w >= m numbers, V m*m. */
static void rk__svd(int r, int m, int w, double *a, double *V)
{
    enum { SWEEPS = 40 }; /* a guard: columns of rounding noise may turn until it stops them */
    int sweep, p, q, i;
    for (i = 0; i < m * m; i++) V[i] = i % (m + 1) == 0;
    for (sweep = 0; sweep < SWEEPS; sweep++) {
        int turned = 0;
        for (p = 0; p < m; p++)
            for (q = p + 1; q < m; q++) {
                const double pp = rk__dot(r, a + p, w, a + p, w);
                const double qq = rk__dot(r, a + q, w, a + q, w);
                const double pq = rk__dot(r, a + p, w, a + q, w);
                double zeta, t, c;
                if (!(fabs(pq) > DBL_EPSILON * sqrt(pp * qq))) continue;
                zeta = (qq - pp) / (2 * pq);
                t = copysign(1, zeta) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                c = 1 / sqrt(1 + t * t);
                rk__turn(r, a, w, p, q, c, c * t);
                rk__turn(m, V, m, p, q, c, c * t);
                turned = 1;
            }
        if (!turned) return;
    }
}

/* One more condition: row^T d_k = [k = power] target for each power k of theta. */
static void rk__require(rk__fit *f, double *row, int power, double target)
{
    const int m = f->m;
    double scale = 0, rest;
    int i, k;
    for (i = 0; i < m; i++) scale = fmax(scale, fabs(row[i]));
    if (!(scale > 0)) scale = 1;
    for (i = 0; i < m; i++) row[i] /= scale;
    for (k = 1; k <= f->powers; k++) row[m + k - 1] = k == power ? target / scale : 0;
    rest = rk__dot(m, row, 1, f->b, 1); /* the sum over k: row^T d(1) = target, and d(1) = b */
    for (k = 0; k < f->powers; k++) rest -= row[m + k];
    f->miss = fmax(f->miss, fabs(rest));
    rk__rotate(m, m + f->powers, f->triangle, row);
    for (k = 0; k < f->powers; k++) f->miss = fmax(f->miss, fabs(row[m + k]));
}

/* One more wish: weight (row^T b(theta) - leading theta^(order+1) - constant) small. */
static void rk__wish(rk__fit *f, double *row, double weight, double leading, double constant)
{
    const int m = f->m;
    int i;
    for (i = 0; i < m; i++) row[i] *= weight;
    row[m] = weight * leading;
    row[m + 1] = weight * constant;
    rk__rotate(m, m + 2, f->wishes, row);
}

/* The sibling before vertex i, or 0. */
static int rk__tree_sibling(const rk__tree *t, int i)
{
    int j = i - 1;
    while (j > 0 && t->level[j] > t->level[i]) j--;
    return t->level[j] == t->level[i] ? j : 0;
}

/* Whether the subtrees of neighbouring siblings j < i are equal: that of j is all that lies
   between.  Equal ones are neighbours, for they are sorted. */
static int rk__tree_repeats(const rk__tree *t, int j, int i)
{
    const int size = i - j;
    return i + size <= t->n && rk__tree_end(t, i) == i + size &&
           memcmp(t->level + i, t->level + j, (size_t)size * sizeof *t->level) == 0;
}

/* The symmetry of the shape: at each vertex, how often equal subtrees repeat.  If k colourings of
   the shape give the same coloured tree, its own symmetry is sigma/k.  All k are visited with
   weight 1/sigma, so the square of its residual counts k/sigma^2 where (k/sigma)^2 would be right:
   good enough for a wish. */
static double rk__tree_sigma(const rk__tree *t)
{
    double sigma = 1;
    int run[RK_ORDER_MAX], i;
    for (i = 1; i < t->n; i++) {
        const int j = rk__tree_sibling(t, i);
        run[i] = j > 0 && rk__tree_repeats(t, j, i) ? run[j] + 1 : 1;
        sigma *= run[i];
    }
    return sigma;
}

/* The trees: conditions up to the order, wishes of the next. */
static void rk__ask_trees(rk__fit *f)
{
    double row[RK_STAGES_MAX + RK_ORDER_MAX], size[RK_STAGES_MAX];
    const ptrdiff_t most = rk__min(f->order + 1, RK_ORDER_MAX);
    rk__tree t;
    int n;
    for (n = 1; n <= most; n++) {
        rk__tree_first(&t, n);
        do {
            const double target = 1 / rk__tree_gamma(&t);
            /* Phi_i depends on the colour of the root only where time is apart */
            if (t.colour[0] != 0 && !f->time_apart) continue;
            if (!rk__tree_has_meaning(f->M, &t)) continue;
            rk__tree_phi(f->M, &t, row, size);
            if (n <= f->order) rk__require(f, row, n, target);
            else rk__wish(f, row, 1 / rk__tree_sigma(&t), target, 0);
        } while (rk__tree_next(&t, f->M->parts + f->time_apart));
    }
}

/* R(iy, theta) = 1 - re^T b(theta) + i im^T b(theta), from the stage values (1 - iyA)^-1 1. */
static void rk__axis_rows(const rk__fit *f, double y, double *re, double *im)
{
    const double *A = f->M->A[0][0];
    double u[RK_STAGES_MAX], v[RK_STAGES_MAX];
    int i;
    for (i = 0; i < f->m; i++) { /* (1 - iy a_ii) (u + iv)_i = 1 + iy sum_{j<i} a_ij (u + iv)_j */
        const double *a = A + i * f->M->ld[0], g = y * a[i], n = 1 + g * g;
        const double p = 1 - y * rk__dot(i, a, 1, v, 1), q = y * rk__dot(i, a, 1, u, 1);
        u[i] = (p - g * q) / n;
        v[i] = (q + g * p) / n;
        re[i] = y * v[i];
        im[i] = y * u[i];
    }
}

/* From 2 to 60 in equal ratios: around the poles 1/a_ii of common tables. */
static double rk__axis_point(int j)
{
    return 2 * pow(30, j / (RK__AXIS - 1.));
}

/* The conditions and wishes for stiff parts. */
static void rk__ask_stiff(rk__fit *f)
{
    const double *A = f->M->A[0][0], weight = RK__QUIET / sqrt((double)RK__AXIS);
    double row[RK_STAGES_MAX + RK_ORDER_MAX], limit[RK_STAGES_MAX + 2];
    double re[RK_STAGES_MAX + 2], im[RK_STAGES_MAX + 2];
    const int ld = f->M->ld[0];
    int power, j;
    rk__stiff_rows(f->m, A, ld, f->first, row, limit);
    rk__require(f, row, 0, 0);
    rk__wish(f, limit, RK__QUIET, 0, 1);
    /* that of theta^1 follows from order 1 and the condition above, where c is the row sums */
    for (power = f->time_apart ? 1 : 2; power <= f->reach; power++) {
        rk__stiff_power(f->m, A, ld, f->first, f->M->c[0], power, row);
        rk__require(f, row, power, 1);
    }
    for (j = 0; j < RK__AXIS; j++) {
        rk__axis_rows(f, rk__axis_point(j), re, im);
        rk__wish(f, re, weight, 0, 1); /* |R|^2 = (1 - re^T b)^2 + (im^T b)^2 */
        rk__wish(f, im, weight, 0, 0);
    }
}

/* The shortest d that meets the conditions R d = rhs: d = V S^-1 (R V S^-1)^T rhs, S the singular
   values of the triangle R; rk__svd leaves R V in R.  Columns of V with S = 0 are the null space.
   miss: the largest number that is left of the right-hand sides. */
static void rk__particular(rk__fit *f)
{
    const int m = f->m, w = m + f->powers;
    double largest = 0;
    int i, k, l;
    rk__svd(m, m, w, f->triangle, f->V);
    for (l = 0; l < m; l++)
        largest = fmax(largest, rk__dot(m, f->triangle + l, w, f->triangle + l, w));
    memset(f->d, 0, (size_t)(m * f->powers) * sizeof *f->d);
    f->null = 0;
    for (l = 0; l < m; l++) {
        const double square = rk__dot(m, f->triangle + l, w, f->triangle + l, w);
        if (!(square > RK__RANK * largest)) {
            for (i = 0; i < m; i++) f->null_space[i * m + f->null] = f->V[i * m + l];
            f->null++;
            continue;
        }
        for (k = 0; k < f->powers; k++) {
            const double y = rk__dot(m, f->triangle + l, w, f->triangle + m + k, w) / square;
            for (i = 0; i < m; i++) {
                f->d[i * f->powers + k] += f->V[i * m + l] * y;
                f->triangle[i * w + m + k] -= f->triangle[i * w + l] * y;
            }
        }
    }
    for (i = 0; i < m; i++)
        for (k = m; k < w; k++) f->miss = fmax(f->miss, fabs(f->triangle[i * w + k]));
}

/* Polynomials x(theta) without constant term and with x(1) given: x = x(1) theta^D plus a
   combination of theta^k - theta^D, k < D, made orthogonal over the points. */
typedef struct rk__basis {
    int powers;
    double node[RK__POINTS], root[RK__POINTS]; /* Gauss' nodes, square roots of the weights */
    /* F: root_i (node_i^k - node_i^D) in row i and column k-1, times W; W: the V of rk__svd */
    double F[RK__POINTS * RK_ORDER_MAX], W[RK_ORDER_MAX * RK_ORDER_MAX];
} rk__basis;

/* The singular value decomposition makes theta^k - theta^D orthogonal over Gauss' points. */
static void rk__basis_make(rk__basis *B, int powers)
{
    const int free_ = powers - 1;
    int i, k;
    B->powers = powers;
    rk__gauss(RK__POINTS, B->node, B->root);
    for (i = 0; i < RK__POINTS; i++) {
        B->root[i] = sqrt(B->root[i]);
        for (k = 1; k < powers; k++)
            B->F[i * free_ + k - 1] =
                B->root[i] * (pow(B->node[i], k) - pow(B->node[i], powers));
    }
    rk__svd(RK__POINTS, free_, free_, B->F, B->W);
}

/* The x nearest to `want` in the mean square, with x(1) = end. */
static void rk__nearest(const rk__basis *B, const double *want, double end, double *x)
{
    const int free_ = B->powers - 1;
    double target[RK__POINTS], rest = end;
    int i, j, k;
    for (k = 0; k < B->powers; k++) x[k] = 0;
    for (i = 0; i < RK__POINTS; i++)
        target[i] = (want[i] - end * pow(B->node[i], B->powers)) * B->root[i];
    for (j = 0; j < free_; j++) {
        const double *F = B->F + j;
        const double y = rk__dot(RK__POINTS, F, free_, target, 1) /
                         rk__dot(RK__POINTS, F, free_, F, free_);
        for (k = 0; k < free_; k++) x[k] += B->W[k * free_ + j] * y;
    }
    for (k = 0; k < free_; k++) rest -= x[k];
    x[free_] = rest;
}

/* lack[i*m + j]: the right-hand side of wish j at node i, less what d gives there. */
static void rk__lacking(const rk__fit *f, const rk__basis *B, double *lack)
{
    const int m = f->m;
    int i, j, n;
    for (i = 0; i < RK__POINTS; i++)
        for (j = 0; j < m; j++) {
            const double *row = f->wishes + j * (m + 2);
            double v = row[m] * pow(B->node[i], f->order + 1) + row[m + 1];
            for (n = 0; n < m; n++)
                v -= row[n] * rk__polynomial(f->powers, f->d + n * f->powers, B->node[i], 0);
            lack[i * m + j] = v;
        }
}

/* Adds Z U x(theta) to d, Z the null space.  U makes the columns g_l of G = wishes Z orthogonal
   (rk__svd leaves G U in G), so each x_l is found alone: the polynomial nearest to
   g_l^T lack(theta) / |g_l|^2 with x_l(1) = (Z u_l)^T (b - d(1)), u_l column l of U. */
static void rk__grant_wishes(rk__fit *f)
{
    const int m = f->m, D = f->powers, null = f->null;
    double lack[RK__POINTS * RK_STAGES_MAX], want[RK__POINTS], x[RK_ORDER_MAX];
    double along[RK_STAGES_MAX], rest[RK_STAGES_MAX], largest = 0;
    rk__basis B;
    int i, k, l;
    for (i = 0; i < m * (m + 2); i++) largest = fmax(largest, fabs(f->wishes[i]));
    for (i = 0; i < m; i++) {
        const double *wish = f->wishes + i * (m + 2);
        for (l = 0; l < null; l++) f->G[i * m + l] = rk__dot(m, wish, 1, f->null_space + l, m);
        rest[i] = f->b[i] - rk__polynomial(D, f->d + i * D, 1, 0);
    }
    rk__svd(m, null, m, f->G, f->U);
    rk__basis_make(&B, D);
    rk__lacking(f, &B, lack);
    for (l = 0; l < null; l++) {
        const double square = rk__dot(m, f->G + l, m, f->G + l, m);
        double end;
        for (i = 0; i < m; i++) along[i] = rk__dot(null, f->null_space + i * m, 1, f->U + l, null);
        end = rk__dot(m, along, 1, rest, 1);
        for (k = 0; k < D; k++) x[k] = end / D; /* the least, where nothing can be gained */
        if (sqrt(square) > RK__FLAT * largest) {
            for (i = 0; i < RK__POINTS; i++)
                want[i] = rk__dot(m, f->G + l, m, lack + i * m, 1) / square;
            rk__nearest(&B, want, end, x);
        }
        for (i = 0; i < m; i++)
            for (k = 0; k < D; k++) f->d[i * D + k] += along[i] * x[k];
    }
}

/* The largest |1 - re^T b(theta) + i im^T b(theta)| over the step; im NULL for none. */
static double rk__largest(const rk__fit *f, const double *re, const double *im)
{
    double p[RK_ORDER_MAX], q[RK_ORDER_MAX] = {0}, worst = 0;
    int k, n;
    for (k = 0; k < f->powers; k++) {
        p[k] = rk__dot(f->m, re, 1, f->d + k, f->powers);
        if (im) q[k] = rk__dot(f->m, im, 1, f->d + k, f->powers);
    }
    for (n = 0; n <= RK__THETAS; n++) {
        const double theta = n / (double)RK__THETAS;
        worst = fmax(worst, hypot(1 - rk__polynomial(f->powers, p, theta, 0),
                                  rk__polynomial(f->powers, q, theta, 0)));
    }
    return worst;
}

/* The largest |R(iy, theta)| over the step. */
static double rk__largest_at(const rk__fit *f, double y)
{
    double re[RK_STAGES_MAX], im[RK_STAGES_MAX];
    rk__axis_rows(f, y, re, im);
    return rk__largest(f, re, im);
}

/* By the maximum principle the largest |R| of the left half-plane is on the axis or at infinity:
   the poles 1/a_ii lie to the right.  A very small or large a_ii acts at i/a_ii. */
static double rk__peak(const rk__fit *f)
{
    const double *A = f->M->A[0][0];
    const int ld = f->M->ld[0];
    double growth[RK_STAGES_MAX], limit[RK_STAGES_MAX], peak;
    int j;
    rk__stiff_rows(f->m, A, ld, f->first, growth, limit);
    peak = rk__largest(f, limit, NULL); /* at infinity R is real */
    for (j = 0; j < RK__AXIS; j++) peak = fmax(peak, rk__largest_at(f, rk__axis_point(j)));
    for (j = f->first; j < f->m; j++) peak = fmax(peak, rk__largest_at(f, 1 / A[j * ld + j]));
    return peak;
}

/* The rest of b - d(1), rounding only, into the last power: d ends in b. */
static void rk__end_in_b(rk__fit *f)
{
    int i;
    for (i = 0; i < f->m; i++) {
        double *d = f->d + i * f->powers;
        d[f->powers - 1] += f->b[i] - rk__polynomial(f->powers, d, 1, 0);
    }
}

/* Whether d has the uniform order and the reach: rk_check will ask for both. */
static int rk__proven(const rk__fit *f)
{
    const rk__method *M = f->M;
    const double *column[2];
    double defect;
    int n;
    column[0] = column[1] = f->d;
    for (n = 1; n <= f->order; n++)
        if (!(rk__defect(M, f->time_apart, column, f->powers, n) <= RK_TOLERANCE)) return 0;
    if (f->reach == 0) return 1;
    return rk__has_reach(f->m, M->A[0][0], M->ld[0], M->c[0], f->d, f->powers, f->reach, &defect);
}

/* The arrays of a table of up to `room` stages, and the work behind them, in the host's memory. */
typedef struct rk__layout {
    int room, m; /* m: stages so far */
    double *A, *b, *c, *bhat, *e, *e3, *d, *work;
} rk__layout;

/* The order of the arrays; rk_size counts them. */
static void rk__lay_out(rk__layout *l, int room, int order, double *mem)
{
    const int powers = order > RK__REACH_MAX ? order : RK__REACH_MAX;
    l->room = room;
    l->A = mem;
    l->b = l->A + room * room;
    l->c = l->b + room;
    l->bhat = l->c + room;
    l->e = l->bhat + room;
    l->e3 = l->e + room;
    l->d = l->e3 + room;
    l->work = l->d + room * powers;
}

/* Rows of A get the length `room`, so that stages can be added. */
static void rk__copy(rk__layout *l, const rk_table *T)
{
    const int m = rk__rows(T), room = l->room;
    const size_t s = (size_t)T->stages * sizeof(double), row = (size_t)m * sizeof(double);
    int i;
    memset(l->A, 0, (size_t)(room * room + 5 * room) * sizeof *l->A);
    for (i = 0; i < m; i++) memcpy(l->A + i * room, T->A + i * m, row);
    memcpy(l->b, T->b, row);
    memcpy(l->c, T->c, row);
    if (T->bhat) memcpy(l->bhat, T->bhat, row);
    if (T->bhat) memmove(l->e, rk__pair_weights(T, l->e), s); /* formed there, or the table's */
    if (T->e3) memcpy(l->e3, T->e3, s);
    l->m = m;
}

/* f and M for the layout's table, alone or with its other half; rk__grow sets the stages. */
static void rk__fit_start(rk__fit *f, rk__method *M, const rk__layout *l, const rk_table *other)
{
    memset(f, 0, sizeof *f);
    f->M = M;
    f->b = l->b;
    f->d = l->d;
    f->triangle = l->work;
    M->parts = other ? 2 : 1;
    M->ld[0] = l->room;
    M->A[0][0] = M->A[1][0] = l->A;
    M->A[0][1] = M->A[1][1] = other ? other->A : NULL;
    M->c[0] = l->c;
    M->c[1] = other ? other->c : NULL;
    M->ld[1] = M->s[1] = l->m;
}

/* b_i(theta) of that order, stiff powers up to `reach`; whether it exists. */
static int rk__derive(rk__fit *f, int order, int reach)
{
    const int m = f->m;
    f->order = order;
    f->reach = reach;
    f->powers = order > reach ? order : reach;
    /* all columns of d are independent (by sum_i c_i^(r-1) d_ik = [k = r]/r and the stiff rows), so
       there are at most m */
    if (f->powers > m) return 0;
    f->V = f->triangle + m * (m + f->powers);
    f->wishes = f->V + m * m;
    f->null_space = f->wishes + m * (m + 2);
    f->G = f->null_space + m * m;
    f->U = f->G + m * m;
    memset(f->triangle, 0, (size_t)(m * (m + f->powers)) * sizeof *f->triangle);
    memset(f->wishes, 0, (size_t)(m * (m + 2)) * sizeof *f->wishes);
    f->miss = f->peak = 0;
    rk__ask_trees(f);
    if (reach > 0) rk__ask_stiff(f);
    rk__particular(f);
    if (!(f->miss <= RK__MISS)) return 0;
    rk__grant_wishes(f);
    rk__end_in_b(f);
    if (!rk__proven(f)) return 0;
    if (reach > 0) f->peak = rk__peak(f);
    return 1;
}

/* The dense output that stays bounded, of that order with the highest reach. */
static int rk__bounded(rk__fit *f, int order)
{
    int reach;
    for (reach = RK__REACH_MAX; reach >= 1; reach--)
        if (rk__derive(f, order, reach) && f->peak <= RK__GROWTH) return 1;
    return 0;
}

/* Of the orders p and p - 1 the one with the highest reach, and p if both have the same: either
   order keeps order p in a coupled run.  If neither is bounded, the highest lower order that is
   bounded. */
static int rk__best_bounded(rk__fit *f, int p)
{
    int reach, order;
    for (reach = RK__REACH_MAX; reach >= 1; reach--)
        for (order = p; order >= 1 && order >= p - 1; order--)
            if (rk__derive(f, order, reach) && f->peak <= RK__GROWTH) return 1;
    for (order = p - 2; order >= 1; order--)
        if (rk__bounded(f, order)) return 1;
    return 0;
}

/* The status of rk_extend; order is what was asked for, 0: the best there is; p is the order of the
   method.  Order 0 of an implicit table: first a bounded one of any order.  Then each order, from
   the highest: with |R| <= RK__GROWTH, unless that was tried before; with R finite at -infinity
   (reach 1), whatever the peak; without stiff conditions.  RK_ESTEP: not even order 1, sum b_i is
   not 1. */
static int rk__choose(rk__fit *f, int order, int p)
{
    int q;
    if (f->first >= 0 && order == 0 && rk__best_bounded(f, p)) return RK_OK;
    for (q = order ? order : p; q >= 1; q--) {
        const int remark = order && q < order ? RK_LESS : RK_OK;
        if (f->first >= 0 && order > 0 && rk__bounded(f, q)) return remark;
        if (f->first >= 0 && rk__derive(f, q, 1)) return RK_UNBOUNDED;
        if (rk__derive(f, q, 0)) return f->implicit ? RK_UNBOUNDED : remark;
    }
    return RK_ESTEP;
}

/* Whether stage i is the slope at ynew: its row is b, its time the end. */
static int rk__is_end(const rk__layout *l, int i)
{
    int j;
    for (j = 0; j < l->m; j++)
        if (l->A[i * l->room + j] != l->b[j]) return 0;
    return fabs(l->c[i] - 1) <= RK_TOLERANCE;
}

/* One more stage.  The first one added is the slope at ynew, unless T has it.  From then on has_end
   is true, and each further one is the slope at u(at[added]).  So at[0] = 1/2 is used only where T
   had the end slope; else the first theta is 1/4 (1/2 does not raise rk4). */
static void rk__add_stage(rk__layout *l, const rk__fit *f, int added)
{
    static const double at[] = {1. / 2, 1. / 4, 3. / 4, 1. / 3, 2. / 3, 1. / 5, 4. / 5, 2. / 5,
                                3. / 5};
    double *row = l->A + l->m * l->room, time = 0;
    int i, has_end = added > 0;
    for (i = 0; i < l->m; i++) has_end |= rk__is_end(l, i);
    for (i = 0; i < l->m; i++) {
        row[i] = l->b[i];
        if (has_end) row[i] = rk__polynomial(f->powers, f->d + i * f->powers, at[added], 0);
        time += row[i];
    }
    /* the sum as computed, not theta: rounding in a row that cancels would set time apart */
    l->c[l->m] = has_end ? time : 1;
    l->m++;
}

/* Stages are added until the dense output has the wanted order: `order`, or if that is 0 the
   method's, p. */
static int rk__grow(rk__layout *l, rk__method *M, rk__fit *f, int order, int p, int more)
{
    const int wanted = order ? order : p;
    int added, status = RK_OK;
    for (added = 0; added <= more; added++) {
        if (added > 0) rk__add_stage(l, f, added - 1);
        f->m = M->s[0] = l->m;
        f->time_apart = rk__time_is_apart(M);
        status = rk__choose(f, order, p);
        if (status < 0 || f->order >= wanted) break;
    }
    return status;
}

/* The layout as a table, its rows of A moved together. */
static void rk__publish(const rk__layout *l, const rk__fit *f, const rk_table *T, rk_table *out)
{
    int i;
    for (i = 1; i < l->m; i++)
        memmove(l->A + i * l->m, l->A + i * l->room, (size_t)l->m * sizeof *l->A);
    *out = *T;
    out->powers = f->powers;
    out->dense_order = f->order;
    out->dense_stiff = f->reach > 0 ? f->reach + 1 : 0;
    out->extra = l->m - T->stages;
    out->A = l->A;
    out->b = l->b;
    out->c = l->c;
    out->bhat = T->bhat ? l->bhat : NULL;
    out->e = T->bhat ? l->e : NULL;
    out->e3 = T->e3 ? l->e3 : NULL;
    out->d = l->d;
}

/* Whether an array of the table shares a number with mem: the later of the two begins before the
   other ends. */
static int rk__has_arrays_inside(const void *mem, size_t bytes, const rk_table *T)
{
    const uintptr_t from = (uintptr_t)mem;
    rk__arrays a;
    int i;
    rk__arrays_of(T, &a);
    for (i = 0; i < 7; i++) {
        const uintptr_t at = (uintptr_t)a.at[i];
        const size_t length = (size_t)a.count[i] * sizeof(double);
        if (length > 0 && (at < from ? from - at < length : at - from < bytes)) return 1;
    }
    return 0;
}

/* Whether the numbers of a table can be relied on; its old dense output has to be finite only. */
static int rk__can_be_extended(const rk_table *T)
{
    return T->powers >= 0 && rk__is_provable(T) && !rk__takes_extra(T);
}

/* Whether T, or T with its other half, can be extended by so many stages. */
static int rk__extend_status(const rk_table *T, const rk_table *other, int order, int more)
{
    int status = rk__table_status(T), i;
    if (status < 0) return status;
    if (!rk__within(order, 0, RK_ORDER_MAX) || !rk__within(more, 0, 9)) return RK_EARG;
    if (rk__rows(T) + more > RK_STAGES_MAX) return RK_EARG;
    if (T->order < 1 || !rk__can_be_extended(T)) return RK_ETABLE;
    if (!other) return RK_OK;
    status = rk__table_status(other);
    if (status < 0) return status;
    if (other->stages != T->stages || other->extra != T->extra) return RK_EOTHER;
    if (!rk__can_be_extended(other)) return RK_ETABLE;
    for (i = 0; i < rk__rows(T); i++) /* the halves have one b */
        if (fabs(T->b[i] - other->b[i]) > RK_TOLERANCE) return RK_EOTHER;
    return RK_OK;
}

/* Lay out the host's memory, copy the table into it, add stages until the order holds, publish. */
RK_API int rk_extend(rk_table *out, const rk_table *T, const rk_table *other, int order, int more,
                     void *mem, size_t bytes)
{
    const int most = order ? order : RK_ORDER_MAX;
    int status = rk__extend_status(T, other, order, more);
    rk__layout l;
    rk__method M;
    rk__fit f;
    int room;
    if (status < 0) return status;
    if (!out) return RK_ENULL;
    room = rk__rows(T) + more;
    if (rk__memory_status(mem, bytes, rk_size(room, most))) return RK_EMEM;
    if (rk__has_arrays_inside(mem, bytes, T)) return RK_EOVERLAP;
    if (other && rk__has_arrays_inside(mem, bytes, other)) return RK_EOVERLAP;
    rk__lay_out(&l, room, most, (double *)mem);
    rk__copy(&l, T);
    rk__fit_start(&f, &M, &l, other);
    f.implicit = !rk_is(T, RK_EXPLICIT);
    f.first = f.implicit ? rk__leading(l.m, l.A, l.room, l.c) : -1;
    /* the slope of an implicit T at a value of its dense output grows with lambda, and `other`
       would need every stage that T gets */
    if (other || f.implicit) more = 0;
    status = rk__grow(&l, &M, &f, order, (int)rk__min(T->order, RK_ORDER_MAX), more);
    if (status >= 0) rk__publish(&l, &f, T, out);
    return status;
}

/* ---- multirate couplings ---------------------------------------------------------------------
   Row i - 1 of W, the forcing, and of G, the jumps, belongs to stage i; the last to the embedded
   solution. */

#define RK__SERIES_ORDER 6 /* the trees of order 7, in three colours, would take 9 times as long */
/* Coefficients of a series: 1 more than its degree.  A slow vertex has degree powers <=
   RK_ORDER_MAX: its slope, of degree powers - 1, integrated.  A fast one has 1 more than its
   children together.  So no vertex adds more than RK_ORDER_MAX. */
#define RK__DEGREE (RK__SERIES_ORDER * RK_ORDER_MAX + 1)

/* Stages per group of a MERK method, 1 to 9, that cover the stages exactly. */
static int rk__groups_status(const rk_coupling *C)
{
    int g = 0, first = 1;
    if (!C->groups) return RK_ENULL;
    while (first < C->stages) {
        if (!rk__within(C->groups[g], 1, RK_ORDER_MAX - 1)) return RK_EARG;
        first += C->groups[g];
        g++;
    }
    return first == C->stages && C->groups[g] == 0 ? RK_OK : RK_EARG;
}

/* W and G are looked at where the form uses them. */
static int rk__coupling_status(const rk_coupling *C, int i)
{
    if (!C || !C->c) return RK_ENULL;
    if (!rk__within(C->form, RK_FROM_LAST, RK_RELAXED)) return RK_EARG;
    if (!rk__within(C->stages, 2, RK_STAGES_MAX) || !rk__within(i, 0, C->stages)) return RK_EARG;
    if (C->form == RK_GROUPS) return rk__groups_status(C);
    if (!C->W || (C->form == RK_FROM_START && !C->G)) return RK_ENULL;
    return rk__within(C->powers, 1, RK_ORDER_MAX) ? RK_OK : RK_EARG;
}

/* The first stage of the group of stage i, and in *before that of the group before.  The first
   group has none before: *before is its own, so that its forcing takes the slope of y alone.  The
   embedded solution goes on from stage stages - 2, and takes the forcing of that stage's group. */
static int rk__group(const rk_coupling *C, int i, int *before)
{
    int g = 0, first = 1;
    if (i == C->stages) i = C->stages - 2;
    *before = first;
    while (first + C->groups[g] <= i) {
        *before = first;
        first += C->groups[g];
        g++;
    }
    return first;
}

/* Whether stage i of a relaxed method is its last, y + H sum b_j (fast + slow)_j, or the embedded
   solution. */
static int rk__relaxes(const rk_coupling *C, int i)
{
    return C->form == RK_RELAXED && i >= C->stages - 1;
}

/* The stage whose value the fast solve of stage i starts from. */
static int rk__from(const rk_coupling *C, int i)
{
    int before;
    if (C->form == RK_FROM_START || rk__relaxes(C, i)) return 0;
    if (i == C->stages) return i - 2; /* embedded: in place of the last stage */
    if (C->form == RK_GROUPS && rk__group(C, i, &before) == i) return 0;
    return i - 1;
}

RK_API int rk_coupling_from(const rk_coupling *C, int i)
{
    const int status = rk__coupling_status(C, i);
    if (status < 0) return status;
    return i == 0 ? RK_EARG : rk__from(C, i);
}

/* c_i; the embedded solution belongs to the end of the step. */
static double rk__stage_time(const rk_coupling *C, int i)
{
    return i == C->stages ? 1 : C->c[i];
}

RK_API double rk_coupling_time(const rk_coupling *C, int i)
{
    return rk__coupling_status(C, i) < 0 ? rk__nan() : rk__stage_time(C, i);
}

/* How far the fast solve of stage i goes, in units of H. */
static double rk__span(const rk_coupling *C, int i)
{
    return rk__relaxes(C, i) ? 0 : rk__stage_time(C, i) - C->c[rk__from(C, i)];
}

/* rk__forcing of a MERK stage: the polynomial through the slopes of y and of the group before,
   times the span, as W holds it. */
static int rk__interpolating_forcing(const rk_coupling *C, int i, double *P)
{
    const int s = C->stages;
    const double span = rk__span(C, i), start = C->c[rk__from(C, i)];
    double x[RK_ORDER_MAX], p[RK_ORDER_MAX];
    int stage[RK_ORDER_MAX], before, nodes, j, k, first = rk__group(C, i, &before);
    nodes = 1 + first - before;
    for (j = 0; j < nodes; j++) {
        stage[j] = j == 0 ? 0 : before + j - 1;
        x[j] = (C->c[stage[j]] - start) / span;
    }
    for (j = 0; j < nodes; j++) {
        rk__lagrange_powers(nodes, x, j, p);
        for (k = 0; k < nodes; k++) P[k * s + stage[j]] = span * p[k];
    }
    return nodes;
}

/* The forcing of stage i times its span, power k of tau on slope j at P[k*stages + j].  Returns
   the number of powers. */
static int rk__forcing(const rk_coupling *C, int i, double *P)
{
    const int s = C->stages;
    int j, k;
    memset(P, 0, (size_t)(s * RK_ORDER_MAX) * sizeof *P);
    if (rk__span(C, i) == 0) return 0;
    if (C->form == RK_GROUPS) return rk__interpolating_forcing(C, i, P);
    for (k = 0; k < C->powers; k++)
        for (j = 0; j < i; j++) P[k * s + j] = C->W[(k * s + i - 1) * s + j];
    return C->powers;
}

/* Tables hold the forcing times its span c_i - c_from, as the papers print it: divided here. */
RK_API int rk_coupling_forcing(const rk_coupling *C, int i, double *weight)
{
    const int status = rk__coupling_status(C, i);
    double span;
    int k, powers;
    if (status < 0) return status;
    if (!weight) return RK_ENULL;
    if (i == 0) return RK_EARG;
    powers = rk__forcing(C, i, weight);
    span = rk__span(C, i);
    for (k = 0; k < powers * C->stages; k++) weight[k] /= span;
    return powers;
}

RK_API int rk_coupling_jump(const rk_coupling *C, int i, double *weight)
{
    const int status = rk__coupling_status(C, i);
    int j, k, s;
    if (status < 0) return status;
    if (!weight) return RK_ENULL;
    if (i == 0) return RK_EARG;
    s = C->stages;
    memset(weight, 0, (size_t)s * sizeof *weight);
    if (C->form == RK_FROM_START) {
        memcpy(weight, C->G + (i - 1) * s, (size_t)s * sizeof *weight);
        return RK_OK;
    }
    if (C->form == RK_GROUPS || rk__span(C, i) != 0) return RK_OK; /* a fast solve, or MERK */
    for (k = 0; k < C->powers; k++) /* the integral of the forcing over tau, at once */
        for (j = 0; j < s; j++) weight[j] += C->W[(k * s + i - 1) * s + j] / (k + 1);
    return RK_OK;
}

/* B-series of the stages for a coloured tree (0: fast; 1: slow, or slow explicit if the slow part
   is split; 2: slow implicit): a polynomial in tau along each fast solve, a jump after it. */
typedef struct rk__series {
    const rk_coupling *C;
    const rk__tree *t;
    double forcing[RK_STAGES_MAX * RK_ORDER_MAX], jump[RK_STAGES_MAX]; /* of the stage */
    double span; /* of the stage's fast solve; |span| in the run for magnitudes */
    /* of the subtree of each vertex a polynomial in tau along the fast solve: first span times its
       slope, then, integrated in place, the solution */
    double series[RK_ORDER_MAX][RK__DEGREE];
    int powers, degree[RK_ORDER_MAX]; /* of the forcing; of each series */
    double value[RK_ORDER_MAX][RK_STAGES_MAX + 1]; /* of the subtree of each vertex at each stage */
} rk__series;

/* The product over the children of v of their values at stage j. */
static double rk__slope_value(const rk__series *S, int v, int j)
{
    const int end = rk__tree_end(S->t, v);
    double product = 1;
    int c;
    for (c = v + 1; c < end; c = rk__tree_end(S->t, c)) product *= S->value[c][j];
    return product;
}

/* series[v] = span times the product of the children's: the fast slope along the solve. */
static void rk__fast_slope(rk__series *S, int v)
{
    const int end = rk__tree_end(S->t, v);
    double product[RK__DEGREE];
    int c, k, l;
    S->series[v][0] = S->span;
    S->degree[v] = 0;
    for (c = v + 1; c < end; c = rk__tree_end(S->t, c)) {
        memset(product, 0, sizeof product);
        for (k = 0; k <= S->degree[v]; k++)
            for (l = 0; l <= S->degree[c]; l++) product[k + l] += S->series[v][k] * S->series[c][l];
        S->degree[v] += S->degree[c];
        memcpy(S->series[v], product, sizeof product);
    }
}

/* series[v] = the forcing by the slow slopes known at stage i. */
static void rk__forced_slope(rk__series *S, int v, int i)
{
    int j, k;
    S->degree[v] = S->powers > 0 ? S->powers - 1 : 0;
    for (j = 0; j < i; j++) {
        const double slope = rk__slope_value(S, v, j);
        for (k = 0; k < S->powers; k++) S->series[v][k] += S->forcing[k * S->C->stages + j] * slope;
    }
}

/* From the slope to the solution that starts at stage `from`; the value at its end. */
static double rk__integrate(rk__series *S, int v, int from)
{
    double *p = S->series[v], sum = 0;
    int k;
    S->degree[v]++;
    for (k = S->degree[v]; k >= 1; k--) p[k] = p[k - 1] / k;
    p[0] = S->value[v][from];
    for (k = S->degree[v]; k >= 0; k--) sum += p[k];
    return sum;
}

/* Whether the jump of stage i takes slopes of that colour. */
static int rk__jumps(const rk_coupling *C, int i, int colour)
{
    if (C->form == RK_FROM_START) return colour == 2;
    return colour == 1 || rk__relaxes(C, i);
}

/* Vertices from the last to the root, so that of all children the series are known, and the values
   at stage i, which the jump of an implicit stage reads. */
static void rk__series_stage(rk__series *S, int i)
{
    const rk_coupling *C = S->C;
    const int from = rk__from(C, i), last = i < C->stages ? i : i - 1; /* embedded: no slope */
    int v, j;
    for (v = S->t->n - 1; v >= 0; v--) {
        const int colour = S->t->colour[v];
        memset(S->series[v], 0, sizeof S->series[v]);
        if (colour == 0) rk__fast_slope(S, v);
        else rk__forced_slope(S, v, i);
        S->value[v][i] = rk__integrate(S, v, from);
        if (!rk__jumps(C, i, colour)) continue;
        for (j = 0; j <= last; j++) S->value[v][i] += S->jump[j] * rk__slope_value(S, v, j);
    }
}

static void rk__absolute(int n, double *v)
{
    int i;
    for (i = 0; i < n; i++) v[i] = fabs(v[i]);
}

/* All stages of one tree, with the terms as they are or their magnitudes. */
static void rk__series_run(rk__series *S, const rk_coupling *C, const rk__tree *t, int magnitude)
{
    const int s = C->stages;
    int i, j;
    S->C = C;
    S->t = t;
    for (j = 0; j < t->n; j++) S->value[j][0] = 0;
    for (i = 1; i <= s; i++) {
        S->powers = rk__forcing(C, i, S->forcing);
        rk_coupling_jump(C, i, S->jump);
        S->span = magnitude ? fabs(rk__span(C, i)) : rk__span(C, i);
        if (magnitude) rk__absolute(s, S->jump);
        if (magnitude) rk__absolute(s * S->powers, S->forcing);
        rk__series_stage(S, i);
    }
}

/* The same recursion twice: with the numbers, and with their absolute values for the size of the
   terms. */
RK_API double rk_defect_coupling(const rk_coupling *C, int which, int order)
{
    double worst = 0;
    int row;
    rk__series S;
    rk__tree t;
    if (rk__coupling_status(C, 0) < 0) return rk__nan();
    if (!rk__within(order, 1, RK__SERIES_ORDER)) return rk__nan();
    if (which != RK_OF_STEP && which != RK_OF_PAIR) return rk__nan();
    row = which == RK_OF_PAIR ? C->stages : C->stages - 1;
    rk__tree_first(&t, order);
    do {
        const double target = 1 / rk__tree_gamma(&t);
        double residual, size;
        rk__series_run(&S, C, &t, 0);
        residual = S.value[0][row] - target;
        rk__series_run(&S, C, &t, 1);
        size = S.value[0][row];
        if (!rk__finite(size)) return HUGE_VAL; /* else the residual is finite as well */
        worst = fmax(worst, rk__in_units(residual, fmax(size, target)));
    } while (rk__tree_next(&t, C->form == RK_FROM_START ? 3 : 2));
    return worst;
}

/* Whether all orders up to `order` hold. */
static int rk__coupling_holds(const rk_coupling *C, int which, int order, double *defect)
{
    const ptrdiff_t most = rk__min(order, RK__SERIES_ORDER);
    int p;
    for (p = 1; p <= most; p++) {
        *defect = rk_defect_coupling(C, which, p);
        if (!(*defect <= RK_TOLERANCE)) return 0;
    }
    return 1;
}

/* Whether the times begin at 0 and, of a relaxed method, end at 1.  The order conditions of the
   step read only the spans of the fast solves: they see no shift of all times, and a relaxed last
   stage has no span. */
static int rk__begins_and_ends(const rk_coupling *C)
{
    const double end = C->c[C->stages - 1];
    if (!rk__zero(C->c[0])) return 0;
    return C->form != RK_RELAXED || (rk__finite(end) && fabs(end - 1) <= RK_TOLERANCE);
}

/* The conditions of a low order do not read all numbers, a step does. */
static int rk__coupling_is_finite(const rk_coupling *C)
{
    const int s = C->stages;
    if (!rk__all_finite(s, C->c)) return 0;
    if (C->form == RK_FROM_START && !rk__all_finite(s * s, C->G)) return 0;
    return C->form == RK_GROUPS || rk__all_finite(C->powers * s * s, C->W);
}

RK_API int rk_check_coupling(const rk_coupling *C, double *defect)
{
    const int status = rk__coupling_status(C, 0);
    double ignored;
    if (!defect) defect = &ignored;
    *defect = HUGE_VAL;
    if (status < 0) return status;
    if (C->order < 1 || C->order_hat < 0) return RK_ETABLE;
    if (!rk__begins_and_ends(C)) return RK_ETIMES;
    if (!rk__coupling_is_finite(C)) return RK_ETABLE;
    if (!rk__coupling_holds(C, RK_OF_STEP, C->order, defect))
        return rk__finite(*defect) ? RK_ESTEP : RK_ETABLE;
    if (!rk__coupling_holds(C, RK_OF_PAIR, C->order_hat, defect))
        return rk__finite(*defect) ? RK_EPAIR : RK_ETABLE;
    *defect = 0;
    return RK_OK;
}

/* The highest order up to that of the outer table that holds. */
static int rk__coupling_order(const rk_coupling *C, int which, int outer)
{
    const ptrdiff_t most = rk__min(outer, RK__SERIES_ORDER);
    int p = 0;
    while (p < most && rk_defect_coupling(C, which, p + 1) <= RK_TOLERANCE) p++;
    return p;
}

/* An outer table of a multirate method: explicit, its times neither falling nor beyond 1. */
static int rk__outer_status(const rk_table *T)
{
    const int status = rk__claims_status(T);
    int i;
    if (status < 0) return status;
    if (T->stages >= RK_STAGES_MAX) return RK_EARG;
    if (!rk_is(T, RK_EXPLICIT) || T->c[0] != 0) return RK_EEXPLICIT;
    for (i = 1; i < T->stages; i++)
        if (T->c[i] < T->c[i - 1]) return RK_ETIMES;
    return T->c[T->stages - 1] <= 1 ? RK_OK : RK_ETIMES;
}

/* A row of W: the weights of the outer table for a stage, less those of the stage it goes on from
   (NULL for a stage that starts from y). */
static void rk__mis_row(double *W, int s, const double *weight, const double *from)
{
    int j;
    for (j = 0; j < s - 1; j++) W[j] = from ? weight[j] - from[j] : weight[j];
}

/* Stage i goes from c_(i-1) to c_i; row i - 1 of W is the difference of rows i and i - 1 of A.  The
   new y, stage s - 1, and the embedded solution both go on from stage s - 2: their rows are b and
   bhat less the last row of A.  Relaxed, these two start from y and take all of b or bhat. */
RK_API int rk_mis(rk_coupling *C, const rk_table *T, int form, void *mem, size_t bytes)
{
    const int status = rk__outer_status(T);
    const double *last;
    double *c, *W;
    int i, s, m;
    if (status < 0) return status;
    if (!C) return RK_ENULL;
    if (form != RK_FROM_LAST && form != RK_RELAXED) return RK_EARG;
    s = T->stages + 1; /* the new y is a stage of its own */
    m = rk__rows(T);
    if (rk__memory_status(mem, bytes, rk_mis_size(T->stages))) return RK_EMEM;
    if (rk__has_arrays_inside(mem, bytes, T)) return RK_EOVERLAP;
    c = (double *)mem;
    W = c + s;
    memset(W, 0, (size_t)(s * s) * sizeof *W);
    memcpy(c, T->c, (size_t)T->stages * sizeof *c);
    c[s - 1] = 1;
    for (i = 1; i < T->stages; i++)
        rk__mis_row(W + (i - 1) * s, s, T->A + i * m, T->A + (i - 1) * m);
    last = form == RK_RELAXED ? NULL : T->A + (T->stages - 1) * m;
    rk__mis_row(W + (s - 2) * s, s, T->b, last);
    if (T->bhat) rk__mis_row(W + (s - 1) * s, s, T->bhat, last);
    memset(C, 0, sizeof *C);
    C->name = T->name;
    C->form = form;
    C->stages = s;
    C->powers = 1;
    C->c = c;
    C->W = W;
    C->order = rk__coupling_order(C, RK_OF_STEP, T->order);
    C->order_hat = rk__coupling_order(C, RK_OF_PAIR, T->order_hat);
    return RK_OK;
}

/* c and the rows of W; the new y is one stage more than the table has. */
RK_API size_t rk_mis_size(int stages)
{
    const size_t s = (size_t)stages + 1;
    return rk__within(stages, 1, RK_STAGES_MAX - 1) ? (s + s * s) * sizeof(double) : 0;
}

/* ---- version and messages -------------------------------------------------------------------- */

RK_API int rk_linked_version(void)
{
    return RK_VERSION;
}

RK_API const char *rk_message(int status)
{
#define RK__MESSAGE(name, value, text)                                                             \
    case name: return text;
    switch (status) {
        RK_STATUSES(RK__MESSAGE)
    }
    return status > RK_OK && status < RK_REMARK ? "done: a result" : "unknown status";
}

/* ---- the tables -------------------------------------------------------------------------------
   From here on only numbers, but for rk_list, rk_find and their like at the very end of them.
   NAME: c; the rows of A; b; for a pair bhat and b - bhat; zeros at the end of a row are left out.
   With _SA (below), and for dop853, b is a row of A and not repeated; of ark* the explicit half has
   the rows of A only and shares the rest.  NAME_d: row i is b_i(theta), from theta^1 on. */

/* clang-format off */

#define RK__ROOT2(a, b, c) /* (a + b sqrt 2) / c */ \
    ((double)(((a) + (b) * 1.41421356237309504880168872421L) / (c)))

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
static const double rk__kutta3_d[][2] = {
    {46. / 51, -25. / 34}, {10. / 51, 8. / 17}, {-5. / 51, 9. / 34},
};

/* Shu & Osher 1988; pair: 1/3 each, order 2; not that of Fekete, Conde & Shadid 2022 */
static const double rk__ssp33[][3] = {
    {0, 1, 1. / 2},
    {0},
    {1},
    {1. / 4, 1. / 4},
    {1. / 6, 1. / 6, 2. / 3},
    {1. / 3, 1. / 3, 1. / 3},
    {-1. / 6, -1. / 6, 1. / 3},
};
static const double rk__ssp33_d[][2] = {
    {16. / 15, -9. / 10}, {1. / 15, 1. / 10}, {-2. / 15, 4. / 5},
};

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
static const double rk__ssp43_d[][3] = {
    {1, -3. / 2, 2. / 3}, {0, 3. / 2, -4. / 3}, {0, -1. / 2, 2. / 3}, {0, 1. / 2},
};

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
static const double rk__bs3_d[][3] = {
    {1, -4. / 3, 5. / 9}, {0, 1, -2. / 3}, {0, 4. / 3, -8. / 9}, {0, -1, 1},
};

/* Kutta 1901; dense output: Zennaro 1986 */
static const double rk__rk4[][4] = {
    {0, 1. / 2, 1. / 2, 1},
    {0},
    {1. / 2},
    {0, 1. / 2},
    {0, 0, 1},
    {1. / 6, 1. / 3, 1. / 3, 1. / 6},
};
static const double rk__rk4_d[][3] = {
    {1, -3. / 2, 2. / 3}, {0, 1, -2. / 3}, {0, 1, -2. / 3}, {0, -1. / 2, 2. / 3},
};

/* Sofroniou & Spaletta 2004 */
static const double rk__ss4[][5] = {
    {0, 2. / 5, 3. / 5, 1, 1},
    {0},
    {2. / 5},
    {-3. / 20, 3. / 4},
    {19. / 44, -15. / 44, 10. / 11},
    {11. / 72, 25. / 72, 25. / 72, 11. / 72},
    {1251515. / 8970912, 3710105. / 8970912, 2519695. / 8970912, 61105. / 8970912,
     119041. / 747576},
    {119041. / 8970912, -595205. / 8970912, 595205. / 8970912, 1309451. / 8970912,
     -119041. / 747576},
};
static const double rk__ss4_d[][3] = { /* cubic Hermite, which is of order 3 for it */
    {1, -37. / 24, 25. / 36}, {0, 25. / 24, -25. / 36}, {0, 25. / 24, -25. / 36},
    {0, 11. / 24, -11. / 36}, {0, -1, 1},
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

/* Tsitouras 2011, with bhat_6 = 1/66 (his table prints a wrong sign,
   his program 1/40); his dense output */
static const double rk__tsit5[][7] = {
    {0, 161. / 1000, 327. / 1000, 9. / 10, 0.98002554090450968573, 1, 1},
    {0},
    {161. / 1000},
    {-0.0084806554923569885444, 0.33548065549235698854},
    {2.8971530571054934321, -6.3594484899750748431, 4.362295432869581411},
    {5.3258648284392566044, -11.748883564062827878, 7.4955393428898362083,
     -0.092495066361755249257},
    {5.8614554429464200287, -12.920969317847109292, 8.1593678985761586432, -0.071584973281400997225,
     -0.028269050394068382909},
    {0.096460766818065229518, 1. / 100, 0.47988965041449957478, 1.3790085741037418932,
     -3.2900695154360806799,
     2.3247105240997739824},
    {0.094680755765839458075, 0.0091835655403432530968, 0.48777052842476157079,
     1.2342975669304789857,
     -2.7077123499835254549, 1.8666284181705870358, 1. / 66},
    {0.0017800110522257714434, 0.00081643445965674690322, -0.0078808780102619960103,
     0.14471100717326290754,
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
    {0.079319780297094873522, 0, 0, 0.35307683922702282027, 0.03670345536339536565,
     0.036362222027862282335,
     -0.0046146127465136175701, -0.024847397784904400907, 0.0239997136160426767},
    {11. / 144, 0, 0, 256. / 693, 0, 125. / 504, 125. / 528, 5. / 72},
    {28. / 477, 0, 0, 212. / 441, -312500. / 366177, 2125. / 1764, 0, -2105. / 35532,
     2995. / 17766},
    {15. / 848, 0, 0, -60. / 539, 312500. / 366177, -375. / 392, 125. / 528, 9145. / 71064,
     -2995. / 17766},
};
static const double rk__verner6_d[][5] = { /* of those with u' = f at both ends the most exact */
    {1, -4.1949972485733957911, 7.8622167193690138045, -6.7574972485733957912, 13. / 6},
    {0},
    {0},
    {0, 8.227762524108148157, -23.843692436383684481, 24.851139147484771533, -2048. / 231},
    {0, 0.64341606406800512566, -1.2868321281360102516, 0.64341606406800512621},
    {0, 2.2549532391734458448, -9.4702239386643520067, 13.415667524887731558, -125. / 21},
    {0, 1.598942548554719631, -7.9327335819579241105, 12.25235163946381054, -125. / 22},
    {0, 0.097021280226204775546, -1.58293144934129844, 3.2220212802262047755, -5. / 3},
    {0, -0.62709840755712774315, 4.2541968151142554863, -7.6270984075571277432, 4},
    {0, -8, 32, -40, 16},
};

/* Hairer, Norsett & Wanner 1993, 8(5) with its dense output: slope 12 is that of ynew,
   13 to 15 are more stages */
static const double rk__dop853[][16] = {
    {0, 0.052600151958767731879, 0.078900227938151597818, 0.11835034190722739673,
     0.28164965809277260327,
     0.33333333333333333333, 1. / 4, 0.30769230769230769231, 0.65128205128205128205, 3. / 5,
     0.85714285714285714286, 1,
     1, 1. / 10, 1. / 5, 0.77777777777777777778},
    {0},
    {0.052600151958767731879},
    {0.019725056984537899454, 0.059175170953613698363},
    {0.029587585476806849182, 0, 0.088762756430420547545},
    {0.2413651341592666855, 0, -0.88454947932828608534, 0.92483400326179200312},
    {0.037037037037037037037, 0, 0, 0.17082860872947387128, 0.12546768756682242502},
    {19. / 512, 0, 0, 0.17025221101954403931, 0.060216538980455960685, -9. / 512},
    {0.037092000118504792711, 0, 0, 0.17038392571223999381, 0.10726203044637328465,
     -0.015319437748624401753,
     0.0082737891638140228876},
    {0.62411095871607571711, 0, 0, -3.3608926294469412941, -0.86821934684172600682,
     27.592099699446708305,
     20.154067550477893409, -43.489884181069958848},
    {0.47766253643826436589, 0, 0, -2.4881146199716676419, -0.59029082683684299637,
     21.230051448181194235,
     15.279233632882423583, -33.288210968984862919, -0.020331201708508626136},
    {-0.93714243008598732572, 0, 0, 5.1863724288440637083, 1.0914373489967295782,
     -8.1497870107469261251,
     -18.520065659996959864, 22.739487099350504282, 2.4936055526796523899, -3.0467644718982195004},
    {2.2733101475165382079, 0, 0, -10.534495466737250198, -2.0008720582248624991,
     -17.958931863118798917,
     27.948884529419960051, -2.8589982771350236947, -8.8728569335306295443, 12.360567175794303065,
     0.64339274601576353036},
    {0.054293734116568762238, 0, 0, 0, 0, 4.4503128927524088814, 1.891517899314500383,
     -5.8012039600105847815,
     0.31116436695781989441, -0.15216094966251607856, 0.20136540080403034837,
     0.044710615727772590518},
    {0.056167502283047952339, 0, 0, 0, 0, 0, 0.25350021021662481109, -0.24623903747080248992,
     -0.12419142326381636047,
     0.15329179827876569731, 0.0082010522956346898849, 0.0075678976605456997614, -4149. / 500000},
    {0.031834648163502140506, 0, 0, 0, 0, 0.028300909672366775529, 0.053541988307438567622,
     -0.054923748571390988465, 0,
     0, -0.00010834732869724932286, 0.00038257109083565841295, -0.0003404650086874045608,
     0.14131244367463250028},
    {-0.42889630158379192341, 0, 0, 0, 0, -4.6976214153611638431, 7.6834211960625990418,
     4.0689898183971100797,
     0.35672718745528110927, 0, 0, 0, -0.0013990241651590146213, 2.947514789152772339,
     -9.1509584721798700108},
    {0.041173689122373881506, 0, 0, 0, 0, 5.6754693391286133222, 2.3872768489717505746,
     -7.4655811424655713184,
     0.6614932157077935761, -0.48634006837553355759, 0.11944219431891463591,
     0.067065923591658885777},
    {0.013120044994194880733, 0, 0, 0, 0, -1.2251564463762044407, -0.49575894965725019152,
     1.664377182454986537,
     -0.35032884874997368169, 0.33417911871301747903, 0.081923206485115712466,
     -0.022355307863886295259},
};
/* its third-order companion, b - bhh of the same book */
static const double rk__dop853_e3[] = {
    -0.18980075407240761571, 0, 0, 0, 0, 4.4503128927524088814, 1.891517899314500383,
    -5.8012039600105847815, -0.42268232132379196293, -0.15216094966251607856,
    0.20136540080403034837, 0.022651792198360825812,
};
static const double rk__dop853_d[][7] = {
    {1, -10.266057073759306578, 48.16185096856645663, -114.93304874997833254, 147.46446875669768308,
     -97.066853630113680831, 25.693933462703749003},
    {0},
    {0},
    {0},
    {0},
    {0, 13.917653631776604414, -154.78787266663715597, 522.92190896082187491,
     -456.25918840208781255,
     -75.531937321357535671, 154.18974869023643374},
    {0, 2.6056037519936094578, -21.622822384626504227, 2.5351820289667551482, 292.25417465990406253,
     -505.4099993329689182, 231.52937917604549568},
    {0, -15.018944223519684516, 160.09447708973047612, -474.30718260376434781,
     135.96036916173837287,
     545.10919452641872234, -357.63911791061412378},
    {0, 3.0505276833184879599, -38.543967291890632505, 174.47140009219884073,
     -337.05134702387712643,
     291.78987509083256014, -93.405324183624310004},
    {0, -1.3278744327655212277, 16.661770430049541997, -74.440278141263033878,
     140.75210016191606336,
     -119.25620210405119949, 37.458323136451633157},
    {0, 2.844533632672879321, -36.558295489910119271, 170.69007169147513661, -345.97484854804955106,
     313.29955362357798519, -104.09964950896230045},
    {0, 0.76571062595278658971, -9.9069955356193663694, 46.802991918874394725,
     -96.51986946699570428,
     88.743166500176165049, -29.840293426660503123},
    {0, -1.0889903364513333108, 14.097013042320002101, -66.682305912943639618,
     137.96299063474374993,
     -127.82216401767992286, 43.533456590011143754},
    {0, 18.148505520854727257, -127.63310949253875295, 357.34195161296572783, -500.7031507909223888,
     349.1703571088289696, -96.324553959188282948},
    {0, -9.1946323924783554, 93.356745932789393432, -282.62726187043632085, 361.14007718803332216,
     -201.85219053352347851, 39.177261675615439165},
    {0, -4.4360363875948939664, 56.681205397766661013, -261.77342902691705527,
     520.97422366889932918,
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
    {1.1213203435596425732, -0.4142135623730950488},
    {-0.1213203435596425732, 0.4142135623730950488},
};

/* Bank et al. 1985; pair: Giraldo, Kelly & Constantinescu 2013 (bounded,
   as that of Hosea & Shampine is not) */
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

/* ESDIRK3(2)5L[2]SA, Kennedy, Carpenter 2016 (NASA/TM-2016-219173) */
static const double rk__esdirk3[][5] = {
    {0, 9. / 20, RK__ROOT2(18, 9, 40), 3. / 5, 1},
    {0},
    {9. / 40, 9. / 40},
    {RK__ROOT2(9, 9, 80), RK__ROOT2(9, 9, 80), 9. / 40},
    {RK__ROOT2(8, 7, 80), RK__ROOT2(8, 7, 80), RK__ROOT2(7, -7, 40), 9. / 40},
    {RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(2374, -2374, 2835),
     5827. / 7560, 9. / 40},
    {RK__ROOT2(-4800247, 5547709, 16519545), RK__ROOT2(-4800247, 5547709, 16519545),
     RK__ROOT2(11095418, -11095418, 16519545), 30698249. / 44052120, 49563. / 233080},
    {RK__ROOT2(-416288, 273788, 3303909), RK__ROOT2(-416288, 273788, 3303909), RK__ROOT2(547576,
     -547576, 3303909),
     81392. / 1101303, 72. / 5827},
};
static const double rk__esdirk3_d[][3] = {
    {0.64330118741244563226, -0.56620627931695725524, 0.098450594033916851526},
    {0.64330118741244563226, -0.56620627931695725524, 0.098450594033916851526},
    {-1.9594640244659975268, 4.4053977520603578526, -2.7927919276203665501},
    {1.1427268458276561166, -1.6089001243856994043, 1.236940474325239055},
    {0.53013480381345014575, -1.6640850690407439378, 1.358950265227293792},
};

/* ESDIRK4(3)6L[2]SA, Kennedy & Carpenter 2016 */
static const double rk__esdirk4[][6] = {
    {0, 1. / 2, RK__ROOT2(2, -1, 4), 5. / 8, 26. / 25, 1},
    {0},
    {1. / 4, 1. / 4},
    {RK__ROOT2(1, -1, 8), RK__ROOT2(1, -1, 8), 1. / 4},
    {RK__ROOT2(5, -7, 64), RK__ROOT2(5, -7, 64), RK__ROOT2(7, 7, 32), 1. / 4},
    {RK__ROOT2(-13796, -54539, 125000), RK__ROOT2(-13796, -54539, 125000), RK__ROOT2(506605,
     132109, 437500),
     RK__ROOT2(-16102, 62416, 109375), 1. / 4},
    {RK__ROOT2(1181, -987, 13782), RK__ROOT2(1181, -987, 13782), RK__ROOT2(-12549, 83801, 273343),
     RK__ROOT2(366752, -56400, 571953), RK__ROOT2(-1515625, -5875000, 90749876), 1. / 4},
    {-480923228411. / 4982971448372, -480923228411. / 4982971448372,
     6709447293961. / 12833189095359,
     3513175791894. / 6748737351361, -498863281070. / 6042575550617,
     2077005547802. / 8945017530137},
    {0.08092570713246383693, 0.08092570713246383693, -0.13516228008303090893,
     -0.018795245050025329255,
     -0.025696966006312281908, 0.017803076874440846229},
};
static const double rk__esdirk4_d[][3] = {
    {0.25207702767367830734, -0.96075594837548595844, 0.69309128566609115036},
    {0.25207702767367830734, -0.96075594837548595844, 0.69309128566609115036},
    {1.0894029669711354253, -0.31649298029787793519, -0.38525231576005415882},
    {-0.77817622752729266172, 3.084196449954472111, -1.8042476028550162833},
    {0.40407630920918960114, -1.3675977565631449639, 0.85526642694002186702},
    {-0.2194571040003889794, 0.521406183657522705, -0.051949079657133725596},
};

/* ESDIRK4(3)7L[2]SA, Kennedy & Carpenter 2019 */
static const double rk__esdirk4b[][7] = {
    {0, 1. / 4, 1200237871921. / 16391473681546, 1. / 2, 395. / 567, 89. / 126, 1},
    {0},
    {1. / 8, 1. / 8},
    {-0.02588834764831844055, -39188347878. / 1513744654945, 1. / 8},
    {0.33838834764831844055, 1748874742213. / 5168247530883, -1748874742213. / 5795261096931,
     1. / 8},
    {-0.35924536183815939261, -6429340993097. / 17896796106705, 9711656375562. / 10370074603625,
     1137589605079. / 3216875020685, 1. / 8},
    {0.23361061091244562876, 405169606099. / 1734380148729, -264468840649. / 6105657584947,
     118647369377. / 6233854714037, 683008737625. / 4934655825458, 1. / 8},
    {-0.40085161500960824424, -5649241495537. / 14093099002237, 5718691255176. / 6089204655961,
     2199600963556. / 4241893152925, 8860614275765. / 11425531467341,
     -3696041814078. / 6641566663007, 1. / 8},
    {-0.24210689376668585609, -1517409284625. / 6267517876163, 8291371032348. / 12587291883523,
     5328310281212. / 10646448185159, 5405006853541. / 7104492075037,
     -4254786582061. / 7445269677723, 19. / 140},
    {-0.15874472124292238815, -0.15874472124292238815, 0.28044273264217214518,
     0.018064548170862165323,
     0.014722801151415503257, 0.014973646235680676816, -3. / 280},
};
static const double rk__esdirk4b_d[][3] = {
    {6.6356755693065978324, -21.843133134061137847, 14.80660594974493177},
    {6.6356755693065978323, -21.843133134061137847, 14.80660594974493177},
    {-10.163928775932125201, 35.607206787952896776, -24.504125597496862864},
    {-2.7749309513052899674, 11.204242944817254912, -7.9107697096170337821},
    {-0.59143471676668848974, 0.90876877988924192214, 0.45817596904464877964},
    {1.2740910451380127836, -3.9238573138541558492, 2.0932647681493174685},
    {-0.015147739747104790599, -0.11009493068296206763, 0.25024267043006685822},
};

/* ESDIRK5(4)7L[2]SA2, the same 2019 */
static const double rk__esdirk5[][7] = {
    {0, 46. / 125, 7121331996143. / 11335814405378, 49. / 353, 3706679970760. / 5295570149437,
     347. / 382, 1},
    {0},
    {23. / 125, 23. / 125},
    {0.22210764773832474449, 791020047304. / 3561426431547, 23. / 125},
    {-0.014049475381926281932, -158159076358. / 11257294102345, -85517644447. / 5003708988389,
     23. / 125},
    {-0.40838859254931465027, -1653327111580. / 4048416487981, 1514767744496. / 9099671765375,
     14283835447591. / 12247432691556, 23. / 125},
    {-0.53929072355881132945, -4540011970825. / 8418487046959, -1790937573418. / 7393406387169,
     10819093665085. / 7266595846747, 4109463131231. / 7386972500302, 23. / 125},
    {-0.039466069109740259325, -188593204321. / 4778616380481, 2809310203510. / 10304234040467,
     1021729336898. / 2364210264653, 870612361811. / 2470410392208,
     -1307970675534. / 8059683598661, 23. / 125},
    {-0.080689466566647432665, -582099335757. / 7214068459310, 615023338567. / 3362626566945,
     3192122436311. / 6174152374399, 6156034052041. / 14430468657929,
     -1011318518279. / 9693750372484,
     1914490192573. / 13754262428401},
    {0.04122339745690717334, 0.04122339745690717334, 0.089736805636807138518,
     -0.084848701245942788984,
     -0.074183645069565183716, -0.057958752816804540347, 0.04480749858169102785},
};
static const double rk__esdirk5_d[][4] = {
    {1.8277112241122952279, -9.6300582718277992266, 14.542869466644924765, -6.779988488039161026},
    {1.8277112241122952279, -9.6300582718277992266, 14.542869466644924765, -6.779988488039161026},
    {-0.91398931455844938823, 3.5526223979092841571, -1.2618715842868137644,
     -1.1041250088137783228},
    {-1.9539215944031731503, 16.311426967164953721, -26.93375311110030369, 13.008412910858811333},
    {0.22513133046351494006, -1.5663480051750921562, 2.2046286859896148249,
     -0.51099592504514847261},
    {-0.30416843085048377971, 3.4726975381183492402, -7.9807958354467320578, 4.6499811173949270848},
    {0.29152556112400092234, -2.510282354361896509, 4.8860529115543851566, -2.4832961183164895699},
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
    {3.03125, -3.40625, 1.4166666666666666667},
    {2.640625, -10.453125, 6.7916666666666666667},
    {-4.296875, 33.984375, -21.875},
    {0, -21.25, 14.166666666666666667},
    {-0.375, 1.125, -0.5},
};

/* Weak stage order 3: Ketcheson, Seibold,
   Shirokoff & Zhou 2020; the 11 printed digits polished on the order conditions */
static const double rk__wso3[][4] = {
    {0.13756543551053851713, 0.80179011575714544682, 2.3317967300217857299, 1},
    {0.13756543551053851713},
    {0.56695122794022445583, 0.23483888781692099099},
    {-1.0835407281283739904, 2.9661822386413242719, 0.44915521950883544849},
    {0.59761291500366268702, -0.43420997583977202636, -0.053058153223335053206,
     0.88965521405944439254},
};
static const double rk__wso3_d[][3] = {
    {1.0394642397676125645, -0.28608973452423706798, -0.15576159023971280952},
    {1.2027023606484343396, -3.7080346488161847582, 2.0711223123279783923},
    {0.10125973549047396593, -0.36169393065095309148, 0.20737604193714407234},
    {-1.34342633590652087, 4.3558183139913749176, -2.1227367640254096551},
};

/* IMEX halves: NAMEe for the explicit, NAMEi for the implicit part */

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
static const double rk__ars443i_d[][3] = {
    {0}, {-1, 13. / 2, -4}, {-9, 27. / 2, -6}, {9, -33. / 2, 8}, {2, -7. / 2, 2},
};

/* Giraldo, Kelly & Constantinescu 2013; the implicit half is trbdf2 */
static const double rk__ark2e[][3] = {
    {0},
    {RK__ROOT2(2, -1, 1)},
    {RK__ROOT2(3, -2, 6), RK__ROOT2(3, 2, 6)},
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
    {0.18764102434672382516, -0.59529747357695494805, 0.97178992772177212347,
     0.43586652150845899942},
    {0.21474028622338914049, -0.48516226388493909282, 0.86872500252038755117,
     0.40169697514116240117},
    {-0.027099261876665315325, -0.11013520969201585523, 0.1030649252013845723,
     0.034169546367296598248},
};
static const double rk__ark3i_d[][2] = {
    {0.70988377079557946195, -0.52224274644885563679},
    {0.1692734874457794933, -0.76457096102273444135},
    {0.67101008517959117152, 0.30077984254218095195},
    {-0.55016734342095012677, 0.98603386492940912619},
};

/* ARK4(3)7L[2]SA, Kennedy & Carpenter 2019 */
static const double rk__ark4e[][7] = {
    {0},
    {247. / 1000},
    {247. / 4000, 2694949928731. / 7487940209513},
    {464650059369. / 8764239774964, 878889893998. / 2444806327765, -952945855348. / 12294611323341},
    {476636172619. / 8159180917465, -1271469283451. / 7793814740893, -859560642026. / 4356155882851,
     1723805262919. / 4571918432560},
    {6338158500785. / 11769362343261, -4970555480458. / 10924838743837,
     3326578051521. / 2647936831840,
     -880713585975. / 1841400956686, -1428733748635. / 8843423958496},
    {760814592956. / 3276306540349, 760814592956. / 3276306540349, -47223648122716. / 6934462133451,
     71187472546993. / 9669769126921, -13330509492149. / 9695768672337,
     11565764226357. / 8513123442827},
};
static const double rk__ark4i[][7] = {
    {0, 247. / 1000, 4276536705230. / 10142255878289, 67. / 200, 3. / 40, 7. / 10, 1},
    {0},
    {247. / 2000, 247. / 2000},
    {624185399699. / 4186980696204, 624185399699. / 4186980696204, 247. / 2000},
    {1258591069120. / 10082082980243, 1258591069120. / 10082082980243,
     -322722984531. / 8455138723562, 247. / 2000},
    {-436103496990. / 5971407786587, -436103496990. / 5971407786587,
     -2689175662187. / 11046760208243,
     4431412449334. / 12995360898505, 247. / 2000},
    {-2207373168298. / 14430576638973, -2207373168298. / 14430576638973,
     242511121179. / 3358618340039,
     3145666661981. / 7780404714551, 5882073923981. / 14490790706663, 247. / 2000},
    {0, 0, 9164257142617. / 17756377923965, -10812980402763. / 74029279521829,
     1335994250573. / 5691609445217,
     2273837961795. / 8368240463276, 247. / 2000},
    {0, 0, 4469248916618. / 8635866897933, -621260224600. / 4094290005349,
     696572312987. / 2942599194819,
     1532940081127. / 5565293938103, 2441. / 20000},
    {0, 0, -0.0014110178419245221818, 0.0056746431225685763313, -0.0019895928121480497637,
     -0.0037240324684960043858,
     29. / 20000},
};
static const double rk__ark4i_d[][3] = {
    {0},
    {0},
    {-5.3313650380609533575, 15.458341216212533094, -9.6108654498341560347},
    {5.4193954419820148882, -13.855688966826933947, 8.2902299609063482604},
    {0.42000550378699882673, 0.04264125013438652688, -0.22791626803119204212},
    {0.30321084668207117107, -0.88552849324075297529, 0.85403999628963558974},
    {0.18875324560986847152, -0.7597650062792326982, 0.69451176066936422668},
};

/* ARK5(4)8L[2]SAb, Kennedy & Carpenter 2019 */
static const double rk__ark5e[][8] = {
    {0},
    {4. / 9},
    {1. / 9, 1183333538310. / 1827251437969},
    {895379019517. / 9750411845327, 477606656805. / 13473228687314, -112564739183. / 9373365219272},
    {-4458043123994. / 13015289567637, -2500665203865. / 9342069639922,
     983347055801. / 8893519644487,
     2185051477207. / 2551468980502},
    {-167316361917. / 17121522574472, 1605541814917. / 7619724128744,
     991021770328. / 13052792161721,
     2342280609577. / 11279663441611, 3012424348531. / 12792462456678},
    {6680998715867. / 14310383562358, 5029118570809. / 3897454228471,
     2415062538259. / 6382199904604,
     -3924368632305. / 6964820224454, -4331110370267. / 15021686902756,
     -3944303808049. / 11994238218192},
    {2193717860234. / 3570523412979, 2193717860234. / 3570523412979,
     5952760925747. / 18750164281544,
     -4412967128996. / 6196664114337, 4151782504231. / 36106512998704,
     572599549169. / 6265429158920,
     -457874356192. / 11306498036315},
};
static const double rk__ark5i[][8] = {
    {0, 4. / 9, 6456083330201. / 8509243623797, 1632083962415. / 14158861528103,
     6365430648612. / 17842476412687,
     18. / 25, 191. / 200, 1},
    {0},
    {2. / 9, 2. / 9},
    {2366667076620. / 8822750406821, 2366667076620. / 8822750406821, 2. / 9},
    {-257962897183. / 4451812247028, -257962897183. / 4451812247028,
     128530224461. / 14379561246022, 2. / 9},
    {-486229321650. / 11227943450093, -486229321650. / 11227943450093,
     -225633144460. / 6633558740617,
     1741320951451. / 6824444397158, 2. / 9},
    {621307788657. / 4714163060173, 621307788657. / 4714163060173, -125196015625. / 3866852212004,
     940440206406. / 7593089888465, 961109811699. / 6734810228204, 2. / 9},
    {2036305566805. / 6583108094622, 2036305566805. / 6583108094622,
     -3039402635899. / 4450598839912,
     -1829510709469. / 31102090912115, -286320471013. / 6931253422520,
     8651533662697. / 9642993110008, 2. / 9},
    {0, 0, 3517720773327. / 20256071687669, 4569610470461. / 17934693873752,
     2819471173109. / 11655438449929,
     3296210113763. / 10722700128969, -1142099968913. / 5710983926999, 2. / 9},
    {0, 0, 520639020421. / 8300446712847, 4550235134915. / 17827758688493,
     1482366381361. / 6201654941325,
     5551607622171. / 13911031047899, -5266607656330. / 36788968843917,
     1074053359553. / 5740751784926},
    {0, 0, 0.11093831878310548816, -0.00044149453865608988849, 0.0028742192909347288968,
     -0.091674663773129788286,
     -0.056825796060827857725, 0.035129416298573518843},
};
static const double rk__ark5i_d[][3] = {
    {0},
    {0},
    {-2.2049752016759282185, 8.2286216147346449789, -5.8499838773229041384},
    {1.4292637513255993323, -2.3881533470358812047, 1.2136812583184054244},
    {-0.22931813290757840886, 1.952002025122555657, -1.4807821237640293539},
    {1.3043240585434459176, -5.2299843032843380991, 4.2330651030431204291},
    {1.1069458225046789019, -3.6398597466042371781, 2.3329308767802237382},
    {-0.40624029779021752443, 1.077373757067255846, -0.44891123705481609937},
};

/* One row of the list: name, stages s, order p, order of the pair, powers of theta D, order q and
   stiff order r of the dense output.  SOLO: without a pair.  _SA: the last row of A is b, else b is
   row s + 1. */
#define RK__ENTRY(x, s, p, phat, D, q, r, b, bhat, e) \
    {#x, s, p, phat, D, q, 0, rk__##x[1], rk__##x[b], rk__##x[0], bhat, e, rk__##x##_d[0], NULL, r}
#define RK__SOLO(x, s, p, D, q, r) RK__ENTRY(x, s, p, 0, D, q, r, s + 1, NULL, NULL)
#define RK__SOLO_SA(x, s, p, D, q, r) RK__ENTRY(x, s, p, 0, D, q, r, s, NULL, NULL)
#define RK__PAIR(x, s, p, phat, D, q) \
    RK__ENTRY(x, s, p, phat, D, q, 0, s + 1, rk__##x[s + 2], rk__##x[s + 3])
#define RK__PAIR_SA(x, s, p, phat, D, q, r) \
    RK__ENTRY(x, s, p, phat, D, q, r, s, rk__##x[s + 1], rk__##x[s + 2])
#define RK__IMEX(x, i, s, p, phat, D, q, r) /* i: the name of the implicit half's arrays, of    \
                                               which the explicit half shares all but A */      \
    {#x "e", s, p, phat, D, q, 0, rk__##x##e[0], rk__##i[s], rk__##i[0], rk__##i[s + 1], \
     rk__##i[s + 2], rk__##i##_d[0], NULL, 0}, \
    {#x "i", s, p, phat, D, q, 0, rk__##i[1], rk__##i[s], rk__##i[0], rk__##i[s + 1], \
     rk__##i[s + 2], rk__##i##_d[0], NULL, r}

static const rk_table rk__tables[] = {
    RK__SOLO(euler, 1, 1, 1, 1, 0),
    RK__PAIR(heun, 2, 2, 1, 2, 2),
    RK__PAIR(midpoint, 2, 2, 1, 2, 2),
    RK__SOLO(kutta3, 3, 3, 2, 2, 0),
    RK__PAIR(ssp33, 3, 3, 2, 2, 2),
    RK__PAIR(ssp43, 4, 3, 2, 3, 3),
    RK__PAIR(ssp104, 10, 4, 3, 3, 3),
    RK__PAIR_SA(bs3, 4, 3, 2, 3, 3, 0),
    RK__SOLO(rk4, 4, 4, 3, 3, 0),
    RK__PAIR_SA(ss4, 5, 4, 3, 3, 3, 0),
    RK__PAIR_SA(dp5, 7, 5, 4, 4, 4, 0),
    RK__PAIR_SA(tsit5, 7, 5, 4, 4, 4, 0),
    {"verner6", 9, 6, 5, 5, 5, 1, rk__verner6[1], rk__verner6[11], rk__verner6[0], rk__verner6[12],
     rk__verner6[13], rk__verner6_d[0], NULL, 0},
    {"dop853", 12, 8, 5, 7, 7, 4, rk__dop853[1], rk__dop853[13], rk__dop853[0], rk__dop853[17],
     rk__dop853[18], rk__dop853_d[0], rk__dop853_e3, 0},
    RK__SOLO(beuler, 1, 1, 1, 1, 2),
    RK__SOLO(imidpoint, 1, 2, 1, 1, 2),
    RK__SOLO_SA(trapezoid, 2, 2, 1, 1, 2),
    RK__PAIR_SA(sdirk2, 2, 2, 1, 2, 1, 3),
    RK__PAIR_SA(trbdf2, 3, 2, 1, 2, 2, 3),
    RK__PAIR_SA(esdirk3, 5, 3, 2, 3, 2, 4),
    RK__PAIR_SA(esdirk4, 6, 4, 3, 3, 3, 4),
    RK__PAIR_SA(esdirk4b, 7, 4, 3, 3, 3, 4),
    RK__PAIR_SA(esdirk5, 7, 5, 4, 4, 4, 4),
    RK__PAIR_SA(sdirk4, 5, 4, 3, 3, 3, 3),
    RK__SOLO_SA(wso3, 4, 3, 3, 3, 4),
    RK__SOLO_SA(ars222e, 3, 2, 2, 2, 0),
    RK__SOLO_SA(ars222i, 3, 2, 2, 2, 2),
    RK__SOLO_SA(ars443e, 5, 3, 3, 3, 0),
    RK__SOLO_SA(ars443i, 5, 3, 3, 3, 2),
    RK__IMEX(ark2, trbdf2, 3, 2, 1, 2, 2, 3),
    RK__IMEX(ark3, ark3i, 4, 3, 2, 2, 2, 3),
    RK__IMEX(ark4, ark4i, 7, 4, 3, 3, 3, 3),
    RK__IMEX(ark5, ark5i, 8, 5, 4, 3, 3, 4),
};

/* ---- the multirate couplings ------------------------------------------------------------------
   The rows of stages 1, 2, ... and of the embedded solution, zeros at the end left out.  Behind
   "tau" the same rows again, of the power tau^1.  The last stage of IRK21a and of ESDIRK* copies
   the one before (a row of zeros), so that the embedded solution, too, goes on from there. */

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
    {-88227. / 47470, 756870829. / 340217490, -713704111. / 1360869960, -31967827. / 340217490,
     129673. / 286680},
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
    {0.24538319991175243725, 0, 0.42042150330440445631, 0, -1.5769926063440662244, 0,
     0.9111879031279093308},
};
static const double rk__esdirk46a_c[] = {
    0, 1. / 5, 1. / 5, 2. / 5, 2. / 5, 3. / 5, 3. / 5, 4. / 5, 4. / 5, 1, 1, 1,
};
static const double rk__esdirk46a_W[][12] = {
    {1. / 5},
    {-1. / 4, 0, 1. / 4},
    {1771023115159. / 1929363690800, 0, -1385150376999. / 1929363690800},
    {914009. / 345800, 0, -1000459. / 345800, 0, 1. / 4},
    {18386293581909. / 36657910125200, 0, 5506531089. / 80566835440, 0,
     -178423463189. / 482340922700},
    {36036097. / 8299200, 0, 4621. / 118560, 0, -38434367. / 8299200, 0, 1. / 4},
    {-247809665162987. / 146631640500800, 0, 10604946373579. / 14663164050080, 0,
     10838126175385. / 5865265620032, 0,
     -24966656214317. / 36657910125200},
    {38519701. / 11618880, 0, 10517363. / 9682400, 0, -23284701. / 19364800, 0,
     -10018609. / 2904720, 0, 1. / 4},
    {-52907807977903. / 33838070884800, 0, 74846944529257. / 73315820250400, 0,
     365022522318171. / 146631640500800, 0,
     -20513210406809. / 109973730375600, 0, -2918009798. / 1870301537},
    {19. / 100, 0, -73. / 300, 0, 127. / 300, 0, 127. / 300, 0, -313. / 300, 0, 1. / 4},
    {0},
    {-1. / 4, 0, 5595. / 8804, 0, -2445. / 8804, 0, -4225. / 8804, 0, 2205. / 4402, 0,
     -567. / 4402},
    /* tau */
    {0},
    {0},
    {-1674554930619. / 964681845400, 0, 1674554930619. / 964681845400},
    {-1007739. / 172900, 0, 1007739. / 172900},
    {-8450070574289. / 18328955062600, 0, -39429409169. / 40283417720, 0,
     173621393067. / 120585230675},
    {-122894383. / 16598400, 0, 14501. / 237120, 0, 121879313. / 16598400},
    {32410002731287. / 15434909526400, 0, -46499276605921. / 29326328100160, 0,
     -34914135774643. / 11730531240064, 0,
     45128506783177. / 18328955062600},
    {-128357303. / 23237760, 0, -35433927. / 19364800, 0, 71038479. / 38729600, 0,
     8015933. / 1452360},
    {136721604296777. / 67676141769600, 0, -349632444539303. / 146631640500800, 0,
     -1292744859249609. / 293263281001600,
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
    {-762580446799. / 588660102960, 11083240219. / 4328383110, -211274129. / 100368304,
     89562055. / 106641323},
    {-3732974. / 2278035, 13857574. / 2278035, -52. / 9, 4. / 3},
};
static const double rk__sr32_G[][5] = {
    {-4. / 7, 4. / 7},
    {-2707004. / 3127425, 919904. / 3127425, 4. / 7},
    {852879271. / 703839675, -1575000496. / 703839675, 5. / 11, 4. / 7},
    {43136869. / 2019912118, -73810600. / 1009956059, -17653551. / 87822266, -13993902. / 43911133,
     4. / 7},
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
static const double rk__merk54_c[] = {
    0, 1. / 2, 1. / 3, 1. / 2, 1. / 4, 1. / 3, 1. / 2, 1. / 2, 2. / 3, 7. / 10, 1,
};
static const signed char rk__merk54_g[] = {1, 2, 3, 3, 1, 0};

static const rk_coupling rk__couplings[] = {
    /* name, form, stages, order, of the pair, powers of tau */
    {"KW3", RK_FROM_LAST, 4, 3, 0, 1, rk__kw3_c, rk__kw3_W[0], NULL, NULL},
    {"ERK22a", RK_FROM_LAST, 3, 2, 1, 1, rk__erk22a_c, rk__erk22a_W[0], NULL, NULL},
    {"ERK33a", RK_FROM_LAST, 4, 3, 2, 2, rk__erk33a_c, rk__erk33a_W[0], NULL, NULL},
    {"ERK45a", RK_FROM_LAST, 6, 4, 3, 2, rk__erk45a_c, rk__erk45a_W[0], NULL, NULL},
    {"IRK21a", RK_FROM_LAST, 4, 2, 1, 1, rk__irk21a_c, rk__irk21a_W[0], NULL, NULL},
    {"ESDIRK34a", RK_FROM_LAST, 8, 3, 2, 1, rk__esdirk34a_c, rk__esdirk34a_W[0], NULL, NULL},
    {"ESDIRK46a", RK_FROM_LAST, 12, 4, 3, 2, rk__esdirk46a_c, rk__esdirk46a_W[0], NULL, NULL},
    {"SR21", RK_FROM_START, 4, 2, 1, 1, rk__sr21_c, rk__sr21_W[0], rk__sr21_G[0], NULL},
    {"SR32", RK_FROM_START, 5, 3, 2, 2, rk__sr32_c, rk__sr32_W[0], rk__sr32_G[0], NULL},
    {"SR43", RK_FROM_START, 7, 4, 3, 2, rk__sr43_c, rk__sr43_W[0], rk__sr43_G[0], NULL},
    {"MERK21", RK_GROUPS, 3, 2, 1, 0, rk__merk21_c, NULL, NULL, rk__merk21_g},
    {"MERK32", RK_GROUPS, 4, 3, 2, 0, rk__merk32_c, NULL, NULL, rk__merk32_g},
    {"MERK43", RK_GROUPS, 7, 4, 3, 0, rk__merk43_c, NULL, NULL, rk__merk43_g},
    {"MERK54", RK_GROUPS, 11, 5, 4, 0, rk__merk54_c, NULL, NULL, rk__merk54_g},
};

/* clang-format on */

RK_API const rk_table *rk_list(int i)
{
    const int count = (int)(sizeof rk__tables / sizeof *rk__tables);
    return i >= 0 && i < count ? rk__tables + i : NULL;
}

RK_API const rk_table *rk_find(const char *name)
{
    int i;
    if (!name) return NULL;
    for (i = 0; rk_list(i); i++)
        if (strcmp(rk_list(i)->name, name) == 0) return rk_list(i);
    return NULL;
}

RK_API const rk_coupling *rk_coupling_list(int i)
{
    const int count = (int)(sizeof rk__couplings / sizeof *rk__couplings);
    return i >= 0 && i < count ? rk__couplings + i : NULL;
}

RK_API const rk_coupling *rk_coupling_find(const char *name)
{
    int i;
    if (!name) return NULL;
    for (i = 0; rk_coupling_list(i); i++)
        if (strcmp(rk_coupling_list(i)->name, name) == 0) return rk_coupling_list(i);
    return NULL;
}

#ifdef __cplusplus
}
#endif
#endif /* RK_IMPLEMENTATION */

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
      0.2.0   what a user of 0.1.0 must change
              rk_combine: h, slopes and weight come first, then n, y, k, ldk, out.
              rk_dense, rk_dense_many: read an rk_step {T, h, n, y, k, ldk} in place of six
              arguments; rk_dense_many: deriv stands before count.  rk_defect_gark: order comes
              first.  rk_version is rk_linked_version.
              rk_defect: (T, other, which, order) takes the place of rk_defect_hat, _dense, _pair:
              rk_defect(T, NULL, RK_OF_STEP, p) is the old one.  rk_defect_coupling: `which`
              replaces `hat`.
              rk_norm: rtol, atol and an array of sizes (or NULL) come first.
              rk_control_make: takes the table; rk_control_step: no order, moves t and h itself.
              rk_first_step: a length of time as second argument.
              rk_table: dense is powers; two fields at the end, zero for none.
              RK_LOWER is RK_LESS, RK_DIAGONAL is RK_SEQUENTIAL, RK_STIFF is RK_STIFFLY_ACCURATE,
              RK_EORDER is RK_ESTEP, RK_EHAT is RK_EPAIR.
              Statuses below -301 have new numbers and say what was wrong; bad arguments of
              functions that return a double give NaN, no longer DBL_MAX or 0.
              RK_ETINY of rk_control_step: this step was rejected and no smaller one is possible;
              before: the next step would not move t.  rk_control: new fields, `failures` is
              `rejected`, `again` acts from the fourth failure in a row on, not the second.
              dop853: hand rk_companion(error, companion) to rk_control_step, whose order is now 7,
              or set C.order = 5 after rk_control_make.
              rk_extend: an order > 0 is tried bounded first; the remark RK_UNBOUNDED says that it
              is not; order 0 of an implicit table is T->order or T->order - 1, if one is bounded.
              rk_is: RK_ENULL, RK_EARG for bad arguments.  RK_FSAL asks for c_s = 1.
              gone: rk_stability, rk_analyse, rk_analysis (development tools, the results stand in
              TABLES); rk_newmark, RK_GENERALIZED_ALPHA, RK_HHT, RK_NEWMARK (no Runge-Kutta
              method); rk_defect_mis (rk_mis and rk_defect_coupling).
              what gives other numbers
              Dense output of sdirk2, esdirk3, esdirk4, esdirk4b, esdirk5, sdirk4 and the halves
              ark3, ark4, ark5: no growth of waves; stiff order 3, was 2 (sdirk2, sdirk4), or 4, was
              3 (the others; ark3 and ark4 stay at 3); uniform order 3 (esdirk4b), 2 (esdirk3), 1
              (sdirk2).  ss4, verner6: other weights of the same order.
              dop853 has its companion estimate.
              rk_first_step: also from rest (y or f = 0).  rk_check refuses residuals above 1e-10
              and coefficients above 1e5, and a stiff order of tables with an a_ii < 0 or a row of
              zeros whose c_i is not 0.
              new: rk_check_imex, rk_check_coupling, rk_mis, rk_mis_size, RK_RELAXED, RK_UNBOUNDED,
              rk_companion, rk_estimate, rk_control_order, rk_control_stop, rk_step;
              stop time, smallest and largest step, error per unit step and calibrated error in the
              control.
      0.1.0   first version  */
