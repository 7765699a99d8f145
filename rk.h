/* SPDX-License-Identifier: MIT

   rk.h - v0.1.0 - Runge-Kutta tables that prove themselves, with dense output; the time loop stays yours

   In *one* C or C++ file, before the include:

      #define RK_IMPLEMENTATION
      #include "rk.h"

   Elsewhere just include it.  Needs libc and libm only.  Never allocates, prints, aborts or calls you back;
   no globals but const tables, so everything may run in parallel.

   SYNOPSIS    one step of y' = f(t,y) from t to t+h; the slope of stage i is kept at k + i*n

      const rk_table *T = rk_find("dp5");
      for (i = 0; i < T->stages; i++) {
          rk_stage(T, i, h, n, y, k, n, z);                   // z = y + h sum_{j<i} a_ij k_j
          f(t + T->c[i]*h, z, k + i*n);                       // k_i; an implicit stage is solved, see rk_stage
      }
      rk_finish(T, h, n, y, k, n, ynew, err);                 // ynew = y + h sum b_j k_j, err = h sum (b_j - bhat_j) k_j
      rk_dense(T, 0.3, 0, h, n, y, k, n, v);                  // v = y(t + 0.3 h)
      rk_dense(T, 0.3, 1, h, n, y, k, n, v);                  // v = y'(t + 0.3 h)

   COMPILE-TIME OPTIONS
      RK_STATIC     the functions are private to the file that includes the header
      RK_API        decoration of your own, e.g. a dllexport; default extern
*/

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

enum {
    RK_OK = 0,
    RK_EXTRAP = 301,    /* theta outside [0, 1]: the polynomial is continued */
    RK_NONFINITE = 302, /* the result holds Inf or NaN: a slope did, or the exact result overflows */
    RK_EARG = -301,     /* an argument is NULL, NaN, negative or out of range */
    RK_ENODENSE = -302, /* the table has no dense output: see rk_extend */
    RK_ENOPAIR = -303,  /* the table has no embedded weights */
    RK_EMEM = -304      /* memory missing, too small or not aligned for double */
};

/* A table is plain data: add your own.  m = stages + extra; all arrays are stored row by row. */
typedef struct rk_table {
    const char *name;
    int stages;           /* s, the slopes of one step */
    int order, order_hat; /* of b and of bhat; order_hat 0: no pair */
    int dense;            /* powers of theta in d; 0: no dense output */
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

/* Implicit methods of any number of stages 1..5 (Lobatto: 2..5), fully coupled, filled into T from the host's memory, which
   T then points to; bytes >= rk_size(stages, stages).  Order 2s, 2s-1, 2s-2 for Gauss, Radau, Lobatto; the dense output
   is the integral of the polynomial through the slopes, of order s (IIIB: s-1).  Named "gauss2", "radauIIA3" and so on. */
enum { RK_GAUSS = 1, RK_RADAU_IIA, RK_LOBATTO_IIIA, RK_LOBATTO_IIIB, RK_LOBATTO_IIIC };
RK_API int rk_collocation(rk_table *T, int family, int stages, void *mem, size_t bytes);

/* Bytes for a table of that many stages, and for the work of deriving a dense output of that order; 0: bad arguments. */
RK_API size_t rk_size(int stages, int order);

/* z = y + h sum_{j<i} a_ij k_j, for i < stages + extra; slope j at k + j*ldk, ldk >= n; z may be y.
   Where a_ii != 0 the stage is implicit: solve k_i = f(t + c_i h, z + h a_ii k_i).  A method with two tables (IMEX) is
   two calls, the second with z for y.  RK_NONFINITE names the stage whose slopes went wrong: some k_j, j < i. */
RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                    double *z);

/* z_i = y + h sum_j a_ij k_j over *all* j, for every stage i < stages: for fully implicit tables (rk_collocation), whose
   slopes k_i = f(t + c_i h, z_i) are solved together; z_i at z + i*ldz; y, k and z apart from each other. */
RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk, double *z,
                     ptrdiff_t ldz);

/* ynew = y + h sum b_j k_j and err = h sum (b_j - bhat_j) k_j, either of them NULL when not wanted; ynew may be y. */
RK_API int rk_finish(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                     double *ynew, double *err);

/* deriv = 0: out = y(t + theta h), from the y of the step's start; deriv = r: the r-th derivative in *time* there.
   theta within 4 rounding errors of 0 or 1 counts as that end, and returns y or rk_finish's ynew bit for bit.
   RK_EXTRAP: theta outside [0, 1] (a prediction). */
RK_API int rk_dense(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y, const double *k,
                    ptrdiff_t ldk, double *out);

/* The m weights behind rk_dense: the deriv-th derivative of b_i(theta), per unit of theta. */
RK_API int rk_weights(const rk_table *T, double theta, int deriv, double *weight);

/* The largest |sum b_i Phi_i(tree) - 1/gamma(tree)| / sum |terms| over all rooted trees with `order` vertices, each leaf
   as a slope's argument (A 1) and as time (c): rounding (<= RK_TOLERANCE) if the table has that order, 1 <= order <= 10.
   A bad argument gives DBL_MAX. */
RK_API double rk_defect(const rk_table *T, int order);
RK_API double rk_defect_hat(const rk_table *T, int order);   /* of bhat */
RK_API double rk_defect_dense(const rk_table *T, int order); /* of b_i(theta), over all its powers of theta */

RK_API int rk_version(void);
RK_API const char *rk_message(int status); /* one clear sentence, never NULL */

#ifdef __cplusplus
}
#endif
#elif RK_VERSION != 100
#error "two different versions of rk.h in one translation unit"
#endif /* RK_H_INCLUDED_TABLES */

/* ------------------------------------------------------------------------------------------------------------------ */
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

#define RK__ROOT2(a, b, c) ((double)(((a) + (b) * 1.41421356237309504880168872421L) / (c))) /* (a + b sqrt 2) / c */

static const double rk__euler[][1] = {{0}, {0}, {1}};
static const double rk__euler_d[][1] = {{1}};

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

/* Bogacki & Shampine 1989; dense output: the cubic through both ends and slopes */
static const double rk__bs3[][4] = {
    {0, 1. / 2, 3. / 4, 1},
    {0},
    {1. / 2},
    {0, 3. / 4},
    {2. / 9, 1. / 3, 4. / 9},
    {2. / 9, 1. / 3, 4. / 9},
    {7. / 24, 1. / 4, 1. / 3, 1. / 8},
    {-5. / 72, 1. / 12, 1. / 9, -1. / 8},
};
static const double rk__bs3_d[][3] = {{1, -4. / 3, 5. / 9}, {0, 1, -2. / 3}, {0, 4. / 3, -8. / 9}, {0, -1, 1}};

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

/* ESDIRK3(2)5L[2]SA, Kennedy & Carpenter 2016 (NASA/TM-2016-219173); dense output derived, bounded for stiff parts */
static const double rk__esdirk3[][5] = {
    {0, 9. / 20, RK__ROOT2(18, 9, 40), 3. / 5, 1},
    {0},
    {9. / 40, 9. / 40},
    {RK__ROOT2(9, 9, 80), RK__ROOT2(9, 9, 80), 9. / 40},
    {RK__ROOT2(8, 7, 80), RK__ROOT2(8, 7, 80), RK__ROOT2(7, -7, 40), 9. / 40},
    {RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(2374, -2374, 2835), 5827. / 7560, 9. / 40},
    {RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(-1181, 1187, 2835), RK__ROOT2(2374, -2374, 2835), 5827. / 7560, 9. / 40},
    {RK__ROOT2(-4800247, 5547709, 16519545), RK__ROOT2(-4800247, 5547709, 16519545),
     RK__ROOT2(11095418, -11095418, 16519545), 30698249. / 44052120, 49563. / 233080},
    {-0.0088057198866539764802, -0.0088057198866539764802, -0.06865001597501925581, 0.073905183223872086065,
     0.012356272524455122705},
};
static const double rk__esdirk3_d[][3] = {
    {1.0032396041371858965, -1.5998124905429866429, 0.77211838853520597492},
    {1.0032396041371858965, -1.5998124905429866429, 0.77211838853520597492},
    {2.1727107781704612693, -7.4860793858855866685, 4.9665104076891191749},
    {-2.6466499456143666207, 9.28749287090366586, -5.8700757295221034721},
    {-0.53254004083046644165, 1.3982114960678940943, -0.64067145523742765264},
};

#define RK__SOLO(x, s, p, D, q) \
    {#x, s, p, 0, D, q, 0, rk__##x[1], rk__##x[s + 1], rk__##x[0], NULL, NULL, rk__##x##_d[0]}
#define RK__PAIR(x, s, p, phat, D, q) \
    {#x,         s, p, phat, D, q, 0, rk__##x[1], rk__##x[s + 1], rk__##x[0], rk__##x[s + 2], rk__##x[s + 3], \
     rk__##x##_d[0]}

static const rk_table rk__tables[] = {
    /*       name    s  p  D  q          name   s  p  phat D  q */
    RK__SOLO(euler, 1, 1, 1, 1),
    RK__PAIR(bs3, 4, 3, 2, 3, 3),
    RK__SOLO(rk4, 4, 4, 3, 3),
    RK__PAIR(dp5, 7, 5, 4, 4, 4),
    RK__PAIR(esdirk3, 5, 3, 2, 3, 3),
};

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

/* ---- sums over long vectors --------------------------------------------------------------------------------------- */

#define RK__EXPONENT 0x7ff0000000000000u /* of Inf and NaN; plus RK__CARRY it sets the sign bit, any other does not */
#define RK__CARRY    0x0010000000000000u

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
#  define RK__PACKS(terms)                                             \
      for (; i + RK__LANES <= end; i += RK__LANES) {                   \
          rk__pack t = *(const rk__load *)(y + (i & keep)) terms;      \
          top |= ((rk__bits)t & RK__EXPONENT) + RK__CARRY;             \
          *(rk__load *)(out + i) = t;                                  \
      }
#  define RK__V(j) +w##j **(const rk__load *)(x##j + i)
#else
#  define RK__PACKS(terms)
#endif

#define RK__W(j) +w##j *x##j[i]
#define RK__SUM(m, packs, singles)               \
    case m:                                      \
        RK__PACKS(packs)                         \
        for (; i < end; i++) {                   \
            double t = y[i & keep] singles;      \
            if (!rk__finite(t)) bad = 1;         \
            out[i] = t;                          \
        }                                        \
        break;

/* out = y + sum of m <= 8 terms w_j x_j on [i, end), y NULL for none; returns whether anything is not finite. */
static int rk__sum(ptrdiff_t i, ptrdiff_t end, const double *y, int m, const double *w, const double *const *x,
                   double *out)
{
    static const double zero[8] = {0};
    const ptrdiff_t keep = y ? -1 : 0; /* y absent: read zero[0..] again and again */
    const double w0 = m > 0 ? w[0] : 0, w1 = m > 1 ? w[1] : 0, w2 = m > 2 ? w[2] : 0, w3 = m > 3 ? w[3] : 0;
    const double w4 = m > 4 ? w[4] : 0, w5 = m > 5 ? w[5] : 0, w6 = m > 6 ? w[6] : 0, w7 = m > 7 ? w[7] : 0;
    const double *x0 = m > 0 ? x[0] : zero, *x1 = m > 1 ? x[1] : zero, *x2 = m > 2 ? x[2] : zero;
    const double *x3 = m > 3 ? x[3] : zero, *x4 = m > 4 ? x[4] : zero, *x5 = m > 5 ? x[5] : zero;
    const double *x6 = m > 6 ? x[6] : zero, *x7 = m > 7 ? x[7] : zero;
    int bad = 0;
#ifdef __GNUC__
    rk__bits top = {0};
    int r;
#endif
    if (!y) y = zero;
    switch (m) {
        RK__SUM(0, , )
        RK__SUM(1, RK__V(0), RK__W(0))
        RK__SUM(2, RK__V(0) RK__V(1), RK__W(0) RK__W(1))
        RK__SUM(3, RK__V(0) RK__V(1) RK__V(2), RK__W(0) RK__W(1) RK__W(2))
        RK__SUM(4, RK__V(0) RK__V(1) RK__V(2) RK__V(3), RK__W(0) RK__W(1) RK__W(2) RK__W(3))
        RK__SUM(5, RK__V(0) RK__V(1) RK__V(2) RK__V(3) RK__V(4), RK__W(0) RK__W(1) RK__W(2) RK__W(3) RK__W(4))
        RK__SUM(6, RK__V(0) RK__V(1) RK__V(2) RK__V(3) RK__V(4) RK__V(5),
                RK__W(0) RK__W(1) RK__W(2) RK__W(3) RK__W(4) RK__W(5))
        RK__SUM(7, RK__V(0) RK__V(1) RK__V(2) RK__V(3) RK__V(4) RK__V(5) RK__V(6),
                RK__W(0) RK__W(1) RK__W(2) RK__W(3) RK__W(4) RK__W(5) RK__W(6))
        RK__SUM(8, RK__V(0) RK__V(1) RK__V(2) RK__V(3) RK__V(4) RK__V(5) RK__V(6) RK__V(7),
                RK__W(0) RK__W(1) RK__W(2) RK__W(3) RK__W(4) RK__W(5) RK__W(6) RK__W(7))
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

/* out = y + h sum_j w_j k_j, the zero weights skipped; y NULL for none, y may be out. */
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
    for (j = 0; j < s; j++) {
        w[m] = h * weight[j];
        x[m] = k + j * ldk;
        m += w[m] != 0;
    }
    for (i = 0; i < n; i += rows) {
        const ptrdiff_t end = i + rows < n ? i + rows : n;
        int bad;
        if (y == out) memcpy(old, y + i, (size_t)(end - i) * sizeof *y);
        bad = rk__sum(i, end, y, m < 8 ? m : 8, w, x, out);
        for (j = 8; j < m; j += 8) bad |= rk__sum(i, end, out, m - j < 8 ? m - j : 8, w + j, x + j, out);
        for (r = i; bad && r < end; r++) {
            if (!rk__finite(out[r])) out[r] = rk__rescue(r, y == out ? old[r - i] : y ? y[r] : 0, m, w, x);
            if (!rk__finite(out[r])) status = RK_NONFINITE;
        }
    }
    return status;
}

/* ---- one step ----------------------------------------------------------------------------------------------------- */

RK_API int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk,
                    double *z)
{
    if (rk__misfit(T) || !(i >= 0 && i < T->stages + T->extra) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && (!y || !z || (i > 0 && (!k || !(ldk >= n))))) return RK_EARG;
    return rk__combine(n, y, h, i, T->A + i * (T->stages + T->extra), k, ldk, z);
}

RK_API int rk_stages(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk, double *z,
                     ptrdiff_t ldz)
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

/* ---- dense output ------------------------------------------------------------------------------------------------- */

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
        if (theta == 1 && deriv == 0) weight[i] = T->b[i];
    }
    return theta < 0 || theta > 1 ? RK_EXTRAP : RK_OK;
}

RK_API int rk_dense(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y, const double *k,
                    ptrdiff_t ldk, double *out)
{
    double weight[RK_STAGES_MAX], scale = h;
    int status, remark, r;
    if (rk__misfit(T) || !rk__finite(h) || !(n >= 0)) return RK_EARG;
    if (n > 0 && ((deriv == 0 && !y) || !k || !out || !(ldk >= n))) return RK_EARG;
    if (deriv > 1 && h == 0) return RK_EARG;
    status = rk_weights(T, theta, deriv, weight);
    if (status < 0) return status;
    for (r = 0; r < deriv; r++) scale = r == 0 ? 1 : scale / h;
    if (!rk__finite(scale)) return RK_EARG;
    remark = rk__combine(n, deriv == 0 ? y : NULL, scale, T->stages + T->extra, weight, k, ldk, out);
    return remark ? remark : status;
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
            if (c == M->parts)
                abs = fabs(sum = M->c[p][l]);
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

static double rk__defect_table(const rk_table *T, const double *b, int powers, int order)
{
    rk__method M;
    int i, j, m, time = 0;
    if (rk__misfit(T) || !b || !(order >= 1 && order <= RK_ORDER_MAX)) return DBL_MAX;
    m = T->stages + T->extra;
    M.parts = 1;
    M.s[0] = M.ld[0] = m;
    M.A[0][0] = T->A;
    M.c[0] = T->c;
    for (i = 0; i < m; i++) { /* where c is the row sum, time and state are the same leaf */
        double sum = -T->c[i], abs = fabs(T->c[i]);
        for (j = 0; j < m; j++) {
            sum += T->A[i * m + j];
            abs += fabs(T->A[i * m + j]);
        }
        if (!(fabs(sum) <= RK_TOLERANCE * abs)) time = 1;
    }
    return rk__defect(&M, time, &b, powers, order);
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
    double g[8], f, df, sum = 0;
    int l;
    rk__nodes(RK_GAUSS, s, g);
    for (l = 0; l < s; l++) {
        rk__node_polynomial(RK_GAUSS, s, 2 * g[l] - 1, &f, &df);
        sum += t * rk__lagrange(s, c, j, t * g[l]) / (4 * g[l] * (1 - g[l]) * df * df);
    }
    return sum;
}

RK_API size_t rk_size(int stages, int order)
{
    const size_t m = (size_t)stages;
    if (!(stages >= 1 && stages <= RK_STAGES_MAX && order >= 0 && order <= RK_ORDER_MAX)) return 0;
    return (m * m + 5 * m + m * (size_t)(order + 1)) * sizeof(double) + 16;
}

RK_API int rk_collocation(rk_table *T, int family, int s, void *mem, size_t bytes)
{
    static const char *const names[] = {"gauss", "radauIIA", "lobattoIIIA", "lobattoIIIB", "lobattoIIIC"};
    double *A = (double *)mem, *b, *c, *d;
    char *name;
    int i, j, l;
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
                *a = j == 0 ? b[0]
                            : rk__lagrange_integral(s - 1, c + 1, j - 1, c[i]) - b[0] * rk__lagrange(s - 1, c + 1, j - 1, 0);
            else
                *a = i == s - 1 && c[i] == 1 ? b[j] : rk__lagrange_integral(s, c, j, c[i]);
        }
    for (j = 0; j < s; j++) { /* d_j: the Lagrange polynomial multiplied out, then integrated */
        double *p = d + j * s;
        int degree = 0;
        p[0] = 1;
        for (l = 0; l < s; l++) {
            if (l == j) continue;
            p[degree + 1] = 0;
            for (i = ++degree; i >= 0; i--) p[i] = ((i ? p[i - 1] : 0) - c[l] * (i < degree ? p[i] : 0)) / (c[j] - c[l]);
        }
        for (i = 0; i < s; i++) p[i] /= i + 1;
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

/* ---- version and messages ----------------------------------------------------------------------------------------- */

RK_API int rk_version(void)
{
    return RK_VERSION;
}

RK_API const char *rk_message(int status)
{
    switch (status) {
    case RK_OK: return "done";
    case RK_EXTRAP: return "done; theta lies outside the step, the polynomial was continued";
    case RK_NONFINITE: return "done; the result holds Inf or NaN: a slope did, or the result overflows";
    case RK_EARG: return "an argument is NULL, NaN, negative or out of range";
    case RK_ENODENSE: return "this table has no dense output; rk_extend derives one";
    case RK_ENOPAIR: return "this table has no embedded weights, so there is no error estimate";
    case RK_EMEM: return "the memory is missing, smaller than rk_size, or not aligned for double";
    }
    return "not a status of rk.h";
}

#ifdef __cplusplus
}
#endif
#endif /* RK_IMPLEMENTATION */
