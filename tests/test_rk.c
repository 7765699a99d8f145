/* SPDX-License-Identifier: MIT

   test_rk.c - rk.h against rooted trees, exact solutions, __float128 and, where installed, SUNDIALS' own tables. */
#ifdef __FAST_MATH__ /* which gcc forgets behind a pragma that is taken back */
#    define FAST_MATH
#endif
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "examples/rk_proof.h"
#include "check.h"
#include "column_at.h"

#include <fenv.h>
#ifdef __unix__
#    include <pthread.h>
#endif
#ifdef HAVE_SUNDIALS
#    include <arkode/arkode_butcher_dirk.h>
#    include <arkode/arkode_butcher_erk.h>
#endif

/* All calls of ALL, of the header with bad arguments, have the same status. */
#define ALL(status, ...) all((status), (const int[]){__VA_ARGS__}, sizeof(int[]){__VA_ARGS__} / sizeof(int), #__VA_ARGS__, __LINE__)

/* A call after changes that stay. */
#define CHECK_WITH(status, call, ...) \
    do { \
        __VA_ARGS__; \
        CHECK_INT(call, status); \
    } while (0)

/* The control C after a step from t of size h, or with another stop time: what holds then. */
#define STEP(error, status, ...) \
    do { \
        CHECK_INT(rk_control_step(&C, error, &t, &h), status); \
        CHECK(__VA_ARGS__); \
    } while (0)
#define STOP(stop, t, ...) \
    do { \
        CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK); \
        CHECK(__VA_ARGS__); \
    } while (0)

static void all(int expected, const int *status, size_t count, const char *calls, int line)
{
    size_t i;
    for (i = 0; i < count; i++)
        if (status[i] != expected) fail_msg("line %d: call %d of %s is %d, expected %d", line, (int)i + 1, calls, status[i], expected);
}

/* ---- the functions under test, as the tests below write them --------------------------------------------------------- */

static int is_nan(double v) /* by the bits: the tests run under -ffast-math, too */
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits << 1 > (uint64_t)0xffe << 52;
}

static int is_finite(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits << 1 < (uint64_t)0xffe << 52;
}

static double defect_b(const rk_table *T, int order)
{
    return rk_defect(T, NULL, RK_OF_STEP, order);
}

static double defect_hat(const rk_table *T, int order)
{
    return rk_defect(T, NULL, RK_OF_PAIR, order);
}

static double defect_dense(const rk_table *T, int order)
{
    return rk_defect(T, NULL, RK_OF_DENSE, order);
}

static double defect_pair(const rk_table *T, const rk_table *other, int which, int order)
{
    return rk_defect(T, other, which, order);
}

static rk_step step_of(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk)
{
    rk_step s;
    s.T = T, s.h = h, s.n = n, s.y = y, s.k = k, s.ldk = ldk;
    return s;
}

static double dot(int n, const double *a, const double *b, int ldb)
{
    double sum = 0;
    int i;
    for (i = 0; i < n; i++) sum += a[i] * b[i * ldb];
    return sum;
}

/* A table of the host's own, without pair and dense output. */
static rk_table plain_table(const char *name, int stages, int order, const double *A, const double *b, const double *c)
{
    rk_table T;
    memset(&T, 0, sizeof T);
    T.name = name, T.stages = stages, T.order = order, T.A = A, T.b = b, T.c = c;
    return T;
}

/* The same with as many powers of theta in its dense output as the order of that. */
static rk_table table_with_dense(rk_table T, int order, const double *d)
{
    T.powers = T.dense_order = order, T.d = d;
    return T;
}

static int dense(const rk_table *T, double theta, int deriv, double h, ptrdiff_t n, const double *y, const double *k,
                 ptrdiff_t ldk, double *out)
{
    const rk_step s = step_of(T, h, n, y, k, ldk);
    return rk_dense(&s, theta, deriv, out);
}

static int dense_many(const rk_table *T, int count, const double *theta, int deriv, double h, ptrdiff_t n, const double *y,
                      const double *k, ptrdiff_t ldk, double *out, ptrdiff_t ldout)
{
    const rk_step s = step_of(T, h, n, y, k, ldk);
    return rk_dense_many(&s, deriv, count, theta, out, ldout);
}

/* ---- the tables ---------------------------------------------------------------------------------------------------- */

/* The order is `order` and not one more; of a stored table a missing tree is worth more than 1e-8. */
static void check_order(const rk_table *T, int which, int order, double next)
{
    int p;
    for (p = 1; p <= order; p++)
        if (!(rk_defect(T, NULL, which, p) <= RK_TOLERANCE)) fail_msg("%s, %d, order %d: %g", T->name, which, p, rk_defect(T, NULL, which, p));
    if (p <= RK_ORDER_MAX && !(rk_defect(T, NULL, which, p) > next)) fail_msg("%s, %d: order %d, too", T->name, which, p);
}

TEST(test_every_table_has_its_orders_and_not_the_next)
{
    const rk_table *T;
    int i, j, k;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        check_order(T, RK_OF_STEP, T->order, 1e-8);
        if (T->bhat) check_order(T, RK_OF_PAIR, T->order_hat, 1e-8);
        else CHECK_INT(T->order_hat, 0);
        for (j = 0; T->bhat && j < T->stages; j++) CHECK_NEAR(T->e[j], T->b[j] - T->bhat[j], 4e-16 * (1 + fabs(T->b[j])));
        check_order(T, RK_OF_DENSE, T->dense_order, 1e-8);
        CHECK(T->dense_order >= T->order - 1 || strncmp(T->name, "ark5", 4) == 0 || !rk_is(T, RK_SEQUENTIAL));
        for (j = 0; j < T->stages + T->extra; j++) { /* it ends in b */
            double sum = 0, size = 1;
            for (k = 0; k < T->powers; k++) {
                sum += T->d[j * T->powers + k];
                size += fabs(T->d[j * T->powers + k]);
            }
            CHECK_NEAR(sum, T->b[j], 4e-16 * size);
        }
    }
}

TEST(test_collocation_families_have_their_orders)
{
    double mem[600];
    rk_table T;
    int family, s;
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = family < RK_LOBATTO_IIIA ? 1 : 2; s <= 5; s++) {
            CHECK_INT(rk_collocation(&T, family, s, mem, rk_collocation_size(s)), RK_OK);
            CHECK_INT(T.order, 2 * s - (family == RK_GAUSS ? 0 : family == RK_RADAU_IIA ? 1 : 2));
            check_order(&T, RK_OF_STEP, T.order, 1e-4);
            CHECK_INT(T.dense_order, family == RK_LOBATTO_IIIB ? s - 1 : s);
            check_order(&T, RK_OF_DENSE, T.dense_order, 1e-4);
        }
    CHECK(strcmp(T.name, "lobattoIIIC5") == 0);
}

/* Hairer & Wanner, Solving Ordinary Differential Equations II, tables IV.5.2, IV.5.6, IV.5.10, IV.5.11 */
TEST(test_collocation_tables_are_those_of_the_book)
{
    const double r3 = sqrt(3.), r6 = sqrt(6.);
    const double gauss2[] = {1. / 4, 1. / 4 - r3 / 6, 1. / 4 + r3 / 6, 1. / 4};
    const double radau3[] = {(88 - 7 * r6) / 360,     (296 - 169 * r6) / 1800, (-2 + 3 * r6) / 225,
                             (296 + 169 * r6) / 1800, (88 + 7 * r6) / 360,     (-2 - 3 * r6) / 225,
                             (16 - r6) / 36,          (16 + r6) / 36,          1. / 9};
    const double lobattoB3[] = {1. / 6, -1. / 6, 0, 1. / 6, 1. / 3, 0, 1. / 6, 5. / 6, 0};
    const double lobattoC3[] = {1. / 6, -1. / 3, 1. / 6, 1. / 6, 5. / 12, -1. / 12, 1. / 6, 2. / 3, 1. / 6};
    double mem[600];
    rk_table T;
    int i;
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, mem, sizeof mem), RK_OK);
    for (i = 0; i < 4; i++) CHECK_NEAR(T.A[i], gauss2[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_RADAU_IIA, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], radau3[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIB, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], lobattoB3[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIC, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], lobattoC3[i], 1e-15);
    CHECK_WITH(RK_EARG, rk_collocation(&T, 0, 2, mem, sizeof mem), T.A = NULL);
    CHECK_INT(rk_collocation(NULL, RK_GAUSS, 2, mem, sizeof mem), RK_ENULL);
    ALL(RK_EARG, rk_collocation(&T, RK_GAUSS, 0, mem, sizeof mem), rk_collocation(&T, RK_GAUSS, 6, mem, sizeof mem),
        rk_collocation(&T, RK_LOBATTO_IIIA, 1, mem, sizeof mem));
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, NULL, sizeof mem), RK_EMEM);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, mem, rk_collocation_size(2) - 1), RK_EMEM);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, (char *)mem + 4, sizeof mem - 8), RK_EMEM);
    CHECK(!T.A && rk_extend_size(0, 1) == 0 && rk_extend_size(65, 1) == 0 && rk_extend_size(1, 11) == 0);
}

#ifdef HAVE_SUNDIALS
static void check_against_sundials(const char *name, ARKodeButcherTable B)
{
    const rk_table *T = rk_find(name);
    int i, j;
    CHECK(T && B && T->stages == B->stages);
    for (i = 0; i < T->stages; i++) {
        for (j = 0; j < T->stages; j++) CHECK_NEAR(T->A[i * T->stages + j], B->A[i][j], 4e-15 * fabs(B->A[i][j]));
        CHECK_NEAR(T->b[i], B->b[i], 4e-15 * fabs(B->b[i]));
        CHECK_NEAR(T->c[i], B->c[i], 4e-15 * fabs(B->c[i]));
        if (T->bhat) CHECK_NEAR(T->bhat[i], B->d[i], 4e-15 * fabs(B->d[i]));
    }
    ARKodeButcherTable_Free(B);
}

#define ERK(name, id)  check_against_sundials(name, ARKodeButcherTable_LoadERK(ARKODE_##id))
#define DIRK(name, id) check_against_sundials(name, ARKodeButcherTable_LoadDIRK(ARKODE_##id))

TEST(test_tables_agree_with_those_of_SUNDIALS)
{
    ERK("heun", HEUN_EULER_2_1_2); ERK("bs3", BOGACKI_SHAMPINE_4_2_3); ERK("dp5", DORMAND_PRINCE_7_4_5);
    ERK("ark3e", ARK324L2SA_ERK_4_2_3); ERK("ark4e", ARK437L2SA_ERK_7_3_4); ERK("ark5e", ARK548L2SAb_ERK_8_4_5);
    DIRK("esdirk3", ESDIRK325L2SA_5_2_3); DIRK("esdirk4", ESDIRK436L2SA_6_3_4); DIRK("esdirk4b", ESDIRK437L2SA_7_3_4);
    DIRK("esdirk5", ESDIRK547L2SA2_7_4_5); DIRK("sdirk4", SDIRK_5_3_4); DIRK("ark3i", ARK324L2SA_DIRK_4_2_3);
    DIRK("ark4i", ARK437L2SA_DIRK_7_3_4); DIRK("ark5i", ARK548L2SAb_DIRK_8_4_5);
}
#endif

/* ---- steps --------------------------------------------------------------------------------------------------------- */

/* y0' = -2 t y0^2, y1' = y1 cos t from (1, 1): nonlinear, time-dependent; exact (1/(1+t^2), exp(sin t)). */
static void rhs(double t, const double *y, double *f)
{
    f[0] = -2 * t * y[0] * y[0], f[1] = y[1] * cos(t);
}

static void exact(double t, double y[2])
{
    y[0] = 1 / (1 + t * t), y[1] = exp(sin(t));
}

static double distance(const double *y, double t, int deriv)
{
    double v[2], f[2];
    exact(t, v);
    rhs(t, v, f);
    return deriv ? hypot(y[0] - f[0], y[1] - f[1]) : hypot(y[0] - v[0], y[1] - v[1]);
}

/* All stages of one step: where a_ii is not zero, k = f(t, z + g k) with g = h a_ii, by Newton. */
static void stages(const rk_table *T, double t, double h, const double *y, double *k)
{
    double z[2], all[2 * RK_STAGES_MAX];
    int i, j;
    if (!rk_is(T, RK_SEQUENTIAL)) { /* by repetition: h is small */
        memset(k, 0, (size_t)(2 * T->stages) * sizeof *k);
        for (j = 0; j < 60; j++) {
            CHECK_INT(rk_stages(T, h, 2, y, k, 2, all, 2), RK_OK);
            for (i = 0; i < T->stages; i++) rhs(t + T->c[i] * h, all + 2 * i, k + 2 * i);
        }
        return;
    }
    for (i = 0; i < T->stages + T->extra; i++) {
        const double g = h * T->A[i * (T->stages + T->extra + 1)], s = t + T->c[i] * h;
        CHECK_INT(rk_stage(T, i, h, 2, y, k, 2, z), RK_OK);
        rhs(s, z, k + 2 * i);
        for (j = 0; g != 0 && j < 30; j++) {
            const double u = z[0] + g * k[2 * i];
            k[2 * i] -= (k[2 * i] + 2 * s * u * u) / (1 + 4 * s * u * g);
            k[2 * i + 1] = z[1] * cos(s) / (1 - g * cos(s));
        }
    }
}

/* Errors at the end and the largest inside, of value and derivative, over [0, 1] with that many steps. */
static void integrate(const rk_table *T, int steps, double error[3])
{
    double y[2] = {1, 1}, k[2 * RK_STAGES_MAX], v[2], h = 1. / steps;
    int s, j;
    error[1] = error[2] = 0;
    for (s = 0; s < steps; s++) {
        stages(T, s * h, h, y, k);
        for (j = 1; j < 8; j++) {
            CHECK_INT(dense(T, j / 8., 0, h, 2, y, k, 2, v), RK_OK);
            error[1] = fmax(error[1], distance(v, (s + j / 8.) * h, 0));
            CHECK_INT(dense(T, j / 8., 1, h, 2, y, k, 2, v), RK_OK);
            error[2] = fmax(error[2], distance(v, (s + j / 8.) * h, 1));
        }
        CHECK_INT(rk_update(T, h, 2, y, k, 2, y, NULL), RK_OK);
    }
    error[0] = distance(y, 1, 0);
}

/* Extreme: the observed order within 0.1 in the asymptotic range for every table, by one harness.  Orders 5 and 6 meet
   round-off before they have settled: there the two orders seen with n, 2n and 4n steps are extrapolated to h = 0. */
TEST(test_observed_orders_of_step_dense_output_and_derivative)
{
    const rk_table *T;
    int i;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        double coarse[3], fine[3], finer[3], order;
        const int steps = T->order <= 2 ? 400 : T->order <= 4 ? 100 : T->order == 5 ? 10 : T->order < 9 ? 5 : 1;
        integrate(T, steps, coarse);
        integrate(T, 2 * steps, fine);
        integrate(T, 4 * steps, finer);
        order = log2(coarse[0] / fine[0]);
        if (T->order == 5 || T->order == 6) order = 2 * log2(fine[0] / finer[0]) - order;
        if (T->order == 9) order = log2(fine[0] / finer[0]); /* two steps and four: eight meet round-off, two are too few */
        if (!(fabs(order - T->order) < (T->order == 9 ? 0.5 : 0.1)))
            fail_msg("%s: %g %g %g, order %g", T->name, coarse[0], fine[0], finer[0], order);
        if (!(log2(coarse[1] / fine[1]) > fmin(T->dense_order + 1, T->order) - (T->order < 5 ? 0.1 : 0.4)))
            fail_msg("%s: dense %g %g", T->name, coarse[1], fine[1]);
        if (!(log2(coarse[2] / fine[2]) > T->dense_order - (T->order < 5 ? 0.1 : 0.4)))
            fail_msg("%s: dense derivative %g %g", T->name, coarse[2], fine[2]);
    }
}

/* Fully implicit tables: the slopes by fixed-point iteration, order of the step and of the dense output. */
TEST(test_observed_orders_of_collocation)
{
    double mem[600];
    rk_table T;
    int family, s, pass, i, j, l;
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = 2; s <= 3; s++) {
            double error[2], inside[2];
            CHECK_INT(rk_collocation(&T, family, s, mem, sizeof mem), RK_OK);
            for (pass = 0; pass < 2; pass++) {
                const int steps = (s == 2 ? 100 : 16) << pass;
                double y[2] = {1, 1}, k[6] = {0}, z[6], v[2], h = 1. / steps;
                inside[pass] = 0;
                for (i = 0; i < steps; i++) {
                    for (j = 0; j < 60; j++) {
                        CHECK_INT(rk_stages(&T, h, 2, y, k, 2, z, 2), RK_OK);
                        for (l = 0; l < s; l++) rhs((i + T.c[l]) * h, z + 2 * l, k + 2 * l);
                    }
                    CHECK_INT(dense(&T, 0.4, 0, h, 2, y, k, 2, v), RK_OK);
                    inside[pass] = fmax(inside[pass], distance(v, (i + 0.4) * h, 0));
                    CHECK_INT(rk_update(&T, h, 2, y, k, 2, y, NULL), RK_OK);
                }
                error[pass] = distance(y, 1, 0);
            }
            if (!(fabs(log2(error[0] / error[1]) - T.order) < 0.2))
                fail_msg("%s: order %g", T.name, log2(error[0] / error[1]));
            CHECK(log2(inside[0] / inside[1]) > fmin(T.dense_order + 1, T.order) - 0.2);
        }
    CHECK_INT(rk_stages(&T, 1, 2, NULL, NULL, 2, NULL, 2), RK_ENULL);
    CHECK_INT(rk_stages(&T, 1, 0, NULL, NULL, 0, NULL, 0), RK_OK);
}

TEST(test_the_error_estimate_is_the_difference_of_the_pair)
{
    const rk_table *T;
    int i, j, l;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        double y[2] = {1, 1}, ynew[2], err[2], k[2 * RK_STAGES_MAX];
        stages(T, 0, 0.1, y, k);
        if (!T->bhat) {
            CHECK_INT(rk_update(T, 0.1, 2, y, k, 2, ynew, err), RK_ENOPAIR);
            continue;
        }
        CHECK_INT(rk_update(T, 0.1, 2, y, k, 2, ynew, err), RK_OK);
        for (l = 0; l < 2; l++) {
            double other = y[l];
            for (j = 0; j < T->stages; j++) other += 0.1 * T->bhat[j] * k[2 * j + l];
            CHECK_NEAR(err[l], ynew[l] - other, 1e-15);
        }
        CHECK_INT(rk_update(T, 0.1, 2, NULL, k, 2, NULL, err), RK_OK); /* the error alone */
    }
}

/* The halves of the stored IMEX methods. */
static const char *const imex[6][2] = {{"ars222e", "ars222i"}, {"ars443e", "ars443i"}, {"ark2e", "ark2i"},
                                       {"ark3e", "ark3i"},     {"ark4e", "ark4i"},     {"ark5e", "ark5i"}};

/* ---- proof ---------------------------------------------------------------------------------------------------------- */

TEST(test_imex_pairs_have_their_orders_together)
{
    size_t i;
    int p;
    for (i = 0; i < 6; i++) {
        const rk_table *E = rk_find(imex[i][0]), *I = rk_find(imex[i][1]);
        for (p = 1; p <= I->order; p++)
            if (!(defect_pair(E, I, 0, p) <= RK_TOLERANCE))
                fail_msg("%s: order %d, %g", I->name, p, defect_pair(E, I, 0, p));
        CHECK(defect_pair(E, I, 0, p) > 1e-6);
        for (p = 1; p <= I->order_hat; p++) CHECK(defect_pair(E, I, 1, p) <= RK_TOLERANCE);
        if (I->bhat) CHECK(defect_pair(E, I, 1, p) > 1e-6);
        for (p = 1; p <= I->dense_order; p++) CHECK(defect_pair(E, I, 2, p) <= RK_TOLERANCE);
        CHECK(defect_pair(E, I, 2, p) > 1e-6);
    }
    for (p = 1; p <= 2; p++) { /* trapezoid and Lobatto IIIB (c is not its row sums): Stoermer & Verlet's method */
        double mem[128];
        rk_table B;
        CHECK_INT(rk_collocation(&B, RK_LOBATTO_IIIB, 2, mem, sizeof mem), RK_OK);
        CHECK(defect_pair(rk_find("trapezoid"), &B, 0, p) <= RK_TOLERANCE);
        CHECK(defect_pair(rk_find("trapezoid"), &B, 0, 3) > 1e-2);
    }
    CHECK(is_nan(defect_pair(rk_find("ark3e"), rk_find("ark4i"), 0, 1)));
    CHECK(is_nan(defect_pair(rk_find("ars222e"), rk_find("ars222i"), 1, 1)));
    CHECK(is_nan(defect_pair(NULL, rk_find("ark4i"), 0, 1)));
}

/* y' = y cos t (explicit) + (sin 2y - sin(2 exp(sin t))) (implicit, Newton), y = exp(sin t), as the recipe says: two calls of
   rk_stage, rk_dense and rk_update; slope 0 is the last slope where both halves have RK_FSAL, else evaluated anew. */
TEST(test_observed_orders_of_imex_pairs)
{
    size_t l;
    for (l = 0; l < 6; l++) {
        const rk_table *E = rk_find(imex[l][0]), *I = rk_find(imex[l][1]);
        const int kept = rk_is(E, RK_FSAL) == 1 && rk_is(I, RK_FSAL) == 1, last = I->stages - 1;
        double error[2], inside[2] = {0, 0};
        int pass, s, i, j;
        CHECK_INT(kept, l < 2);
        for (pass = 0; pass < 2; pass++) {
            const int steps = (E->order < 4 ? 80 : 20) << pass;
            double y = 1, v = 0, k[8] = {1}, q[8] = {0}, h = 2. / steps;
            for (s = 0; s < steps; s++) {
                for (i = s > 0 && kept ? 1 : 0; i < E->stages; i++) {
                    const double t = (s + I->c[i]) * h, g = h * I->A[i * (I->stages + 1)], known = sin(2 * exp(sin(t)));
                    double base, z;
                    rk_stage(E, i, h, 1, &y, k, 1, &base);
                    rk_stage(I, i, h, 1, &base, q, 1, &base);
                    for (z = base, j = 0; j < 20; j++) z -= (z - base - g * (sin(2 * z) - known)) / (1 - 2 * g * cos(2 * z));
                    q[i] = sin(2 * z) - known;
                    k[i] = z * cos(t);
                }
                dense(E, 0.4, 0, h, 1, &y, k, 1, &v);
                dense(I, 0.4, 0, h, 1, &v, q, 1, &v);
                inside[pass] = fmax(inside[pass], fabs(v - exp(sin((s + 0.4) * h))));
                rk_update(E, h, 1, &y, k, 1, &y, NULL);
                rk_update(I, h, 1, &y, q, 1, &y, NULL);
                k[0] = k[last], q[0] = q[last];
            }
            error[pass] = fabs(y - exp(sin(2.)));
        }
        if (!(fabs(log2(error[0] / error[1]) - E->order) < (E->order < 5 ? 0.2 : 0.4)))
            fail_msg("%s: order %g, inside %g", E->name, log2(error[0] / error[1]), log2(inside[0] / inside[1]));
        CHECK(log2(inside[0] / inside[1]) > fmin(E->dense_order + 1, E->order) - 0.2);
    }
}

/* Two additive steps of y' = f + g: Strang's splitting (half f, g, half f by the midpoint rule each) as a GARK method has
   order 2, Lie's order 1.  Bad arguments: NaN. */
TEST(test_general_additive_methods)
{
    const double half[] = {1. / 4, 0, 1. / 2, 1. / 4}, none[] = {0, 1}, first[] = {1. / 2, 0}, self[] = {1. / 2};
    const double lie[] = {0}, one[] = {1}, bf[] = {1. / 2, 1. / 2};
    const int s[] = {2, 1}, t[] = {1, 1}, no[] = {1, 0}, many[] = {1, RK_STAGES_MAX + 1};
    const double *A[4], *b[2], *L[4], *d[2];
    A[0] = half;  /* f after f */
    A[1] = none;  /* f after g: the second half step sees all of g */
    A[2] = first; /* g sees the first half of f */
    A[3] = self, b[0] = bf, b[1] = one;
    CHECK(rk_defect_gark(1, 2, s, A, b) <= RK_TOLERANCE && rk_defect_gark(2, 2, s, A, b) <= RK_TOLERANCE);
    CHECK(rk_defect_gark(3, 2, s, A, b) > 1e-2);
    L[0] = lie, L[1] = lie, L[2] = one, L[3] = lie, d[0] = d[1] = one;
    CHECK(rk_defect_gark(1, 2, t, L, d) <= RK_TOLERANCE && rk_defect_gark(2, 2, t, L, d) > 1e-2);
    CHECK(is_nan(rk_defect_gark(1, 5, t, L, d)) && is_nan(rk_defect_gark(1, 0, t, L, d)) && is_nan(rk_defect_gark(1, 2, NULL, L, d)));
    CHECK(is_nan(rk_defect_gark(1, 2, t, NULL, d)) && is_nan(rk_defect_gark(1, 2, t, L, NULL)) && is_nan(rk_defect_gark(0, 2, t, L, d)));
    CHECK(is_nan(rk_defect_gark(11, 2, t, L, d)) && is_nan(rk_defect_gark(1, 2, no, L, d)) && is_nan(rk_defect_gark(1, 2, many, L, d)));
    L[2] = NULL;
    CHECK(is_nan(rk_defect_gark(1, 2, t, L, d)));
    L[2] = one, d[1] = NULL;
    CHECK(is_nan(rk_defect_gark(1, 2, t, L, d)));
}

/* A defect in units of its terms is at most 2, also where the times fall: no span cancels another in the size. */
TEST(test_the_terms_of_a_coupling_whose_times_fall)
{
    double c[4] = {0, 0.9, 0.1, 1}, W[16];
    rk_coupling C = *rk_coupling_find("ERK33a"); /* 4 stages */
    unsigned seed = 1;
    int trial, i, order;
    C.c = c, C.W = W, C.powers = 1;
    for (trial = 0; trial < 200; trial++) {
        for (i = 0; i < 16; i++) W[i] = 0;
        for (i = 0; i < 12; i++) {
            seed = seed * 1103515245u + 12345u;
            if (i % 4 <= i / 4) W[i] = (double)(seed >> 16 & 1023) / 512 - 1;
        }
        for (order = 2; order <= 4; order++) CHECK(rk_defect_coupling(&C, RK_OF_STEP, order) <= 2.000001);
    }
}

TEST(test_multirate_couplings_have_their_orders)
{
    const rk_coupling *C;
    rk_coupling bad;
    double weight[RK_ORDER_MAX * RK_STAGES_MAX];
    int i, p;
    for (i = 0; (C = rk_couplings() + i)->name; i++) {
        for (p = 1; p <= C->order; p++)
            if (!(rk_defect_coupling(C, 0, p) <= RK_TOLERANCE))
                fail_msg("%s: %d %g", C->name, p, rk_defect_coupling(C, 0, p));
        CHECK(rk_defect_coupling(C, 0, p) > 1e-3);
        for (p = 1; C->order_hat && p <= C->order_hat; p++) CHECK(rk_defect_coupling(C, 1, p) <= RK_TOLERANCE);
        if (C->order_hat) CHECK(rk_defect_coupling(C, 1, p) > 1e-4);
        CHECK(rk_coupling_find(C->name) == C);
    }
    CHECK_INT(i, 14);
    bad = *rk_coupling_find("ERK45a");
    memcpy(weight, bad.W, 72 * sizeof *weight);
    weight[7] *= 1 + 1e-9; /* one digit wrong in one coefficient */
    bad.W = weight;
    CHECK(rk_defect_coupling(&bad, 0, 1) > 1e-11);
    CHECK(rk_coupling_time(&bad, 0) == 0 && rk_coupling_time(&bad, 6) == 1 && is_nan(rk_coupling_time(&bad, 7)));
    CHECK_INT(rk_coupling_from(&bad, 2), 1);
    bad = *rk_coupling_find("ERK22a"); /* rows 1/2; -1/2, 1: terms of size 2 in all */
    memcpy(weight, bad.W, 9 * sizeof *weight);
    weight[4] += 1e-9;
    bad.W = weight;
    CHECK_NEAR(rk_defect_coupling(&bad, RK_OF_STEP, 1), 5e-10, 1e-15);
    bad = *rk_coupling_find("ERK45a");
    { /* ten powers, eight of them zero: the polynomials inside have degree 50 */
        double W[10 * 16] = {0};
        rk_coupling wide = *rk_coupling_find("ERK33a");
        memcpy(W, wide.W, 32 * sizeof *W);
        wide.W = W, wide.powers = 10;
        CHECK(rk_defect_coupling(&wide, 0, 3) <= RK_TOLERANCE && rk_defect_coupling(&wide, 0, 6) > 1e-3);
    }
    CHECK(is_nan(rk_defect_coupling(NULL, 0, 1)) && is_nan(rk_defect_coupling(&bad, 0, 7)));
    CHECK(rk_coupling_order(NULL, RK_OF_STEP) == RK_ENULL && rk_coupling_order(&bad, RK_OF_DENSE) == RK_EARG);
    ALL(RK_EARG, rk_coupling_forcing(&bad, 0, weight), rk_coupling_jump(&bad, 7, weight));
    CHECK(!rk_coupling_find("nobody's") && !rk_coupling_find(NULL));
}

/* ARKODE, "Mathematical considerations": of its third-order tables only Knoth & Wolke's qualifies.  The condition of Schlegel
   et al. 2009, beside the order that the engine finds; and the coupling stored as KW3. */
static double mis_condition(const rk_table *T)
{
    double sum = -1. / 3, last = 0, Ac;
    int i, j, m = T->stages + T->extra;
    for (i = 0; i < T->stages; i++) {
        for (Ac = 0, j = 0; j < T->stages; j++) Ac += T->A[i * m + j] * T->c[j];
        if (i > 0) sum += (T->c[i] - T->c[i - 1]) * (Ac + last);
        last = Ac;
    }
    return sum + (1 - T->c[T->stages - 1]) * (0.5 + last);
}

static const double kw_A[] = {0, 0, 0, 1. / 3, 0, 0, -3. / 16, 15. / 16, 0}, kw_b[] = {1. / 6, 3. / 10, 8. / 15},
                    kw_c[] = {0, 1. / 3, 3. / 4};
static const double r38_A[] = {0, 0, 0, 0, 1. / 3, 0, 0, 0, -1. / 3, 1, 0, 0, 1, -1, 1, 0},
                    r38_b[] = {1. / 8, 3. / 8, 3. / 8, 1. / 8}, r38_c[] = {0, 1. / 3, 2. / 3, 1};
static const rk_table kw = {"kw", 3, 3, 0, 0, 0, 0, kw_A, kw_b, kw_c, NULL, NULL, NULL, NULL, 0};
static const rk_table r38 = {"3/8 rule", 4, 4, 0, 0, 0, 0, r38_A, r38_b, r38_c, NULL, NULL, NULL, NULL, 0};

TEST(test_infinitesimal_steps_from_any_outer_table)
{
    static double mem[600];
    const rk_coupling *stored = rk_coupling_find("KW3");
    const rk_table *T;
    rk_coupling C;
    double w[2][RK_ORDER_MAX * RK_STAGES_MAX], falls[3] = {0, 0.5, 0.25};
    rk_table own;
    int i, j, n;
    CHECK_INT(rk_check(&kw, NULL), RK_OK);
    CHECK_INT(rk_mis(&C, &kw, RK_FROM_LAST, mem, rk_mis_size(3)), RK_OK);
    CHECK(C.order == 2 && rk_coupling_order(&C, RK_OF_STEP) == 3 && C.stages == stored->stages && strcmp(C.name, "kw") == 0);
    for (i = 1; i < C.stages; i++) {
        CHECK_NEAR(rk_coupling_time(&C, i), rk_coupling_time(stored, i), 1e-16);
        CHECK_INT(rk_coupling_from(&C, i), rk_coupling_from(stored, i));
        n = rk_coupling_forcing(&C, i, w[0]);
        CHECK_INT(n, rk_coupling_forcing(stored, i, w[1]));
        for (j = 0; j < n * C.stages; j++) CHECK_NEAR(w[0][j], w[1][j], 4e-16);
        CHECK_INT(rk_coupling_jump(&C, i, w[0]), RK_OK);
        for (j = 0; j < C.stages; j++) CHECK(w[0][j] == 0);
    }
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        const int status = rk_mis(&C, T, RK_FROM_LAST, mem, sizeof mem);
        int rises = 1;
        for (j = 1; j < T->stages; j++) rises &= T->c[j] >= T->c[j - 1];
        if (!rk_is(T, RK_EXPLICIT)) CHECK_INT(status, RK_EEXPLICIT);
        else CHECK_INT(status, rises ? RK_OK : RK_ETIMES);
        if (status < 0) continue;
        CHECK_INT(C.order, T->order < 2 ? T->order : 2);
        CHECK_INT(rk_coupling_order(&C, RK_OF_STEP), T->order < 2 ? T->order : T->order > 2 && fabs(mis_condition(T)) < 1e-14 ? 3 : 2);
        CHECK_INT(rk_check_coupling(&C, NULL), RK_OK);
        CHECK_INT(rk_mis(&C, T, RK_RELAXED, mem, sizeof mem), RK_OK);
        CHECK_INT(C.order, T->order < 2 ? T->order : 2);
        CHECK_INT(rk_coupling_order(&C, RK_OF_STEP), T->order < 3 ? T->order : 3);
        CHECK_INT(rk_check_coupling(&C, NULL), RK_OK);
    }
    CHECK(fabs(mis_condition(&kw)) < 1e-15 && fabs(mis_condition(&r38)) < 1e-15 &&
          fabs(mis_condition(rk_find("kutta3"))) > 0.01 && fabs(mis_condition(rk_find("bs3"))) > 0.01);
    CHECK_INT(rk_mis(&C, &r38, RK_FROM_LAST, mem, sizeof mem), RK_OK);
    CHECK_INT(rk_coupling_order(&C, RK_OF_STEP), 3);
    CHECK_INT(rk_mis(&C, &r38, RK_RELAXED, mem, sizeof mem), RK_OK); /* Sexton & Reynolds: of order 4 */
    CHECK_INT(rk_coupling_order(&C, RK_OF_STEP), 4);
    CHECK(rk_defect_coupling(&C, RK_OF_STEP, 5) > 1e-3);
    own = kw;
    CHECK_WITH(RK_ETABLE, rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), own.order = 0);
    CHECK_WITH(RK_OK, rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), own.order = 1); /* no more than the outer table claims */
    CHECK_INT(C.order, 1);
    CHECK_WITH(RK_ETIMES, rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), own.c = falls, C.name = NULL);
    CHECK_WITH(RK_ETIMES, rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), falls[2] = 1.5);
    CHECK_INT(rk_mis(&C, &kw, RK_FROM_START, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_mis(&C, &kw, RK_FROM_LAST, mem, rk_mis_size(3) - 1), RK_EMEM);
    falls[1] = nan("");
    CHECK_INT(rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), RK_ETABLE);
    falls[1] = 0.25, falls[2] = 0.5; /* times that are not the sums of the rows: order 1 always holds */
    CHECK_INT(rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), RK_OK);
    CHECK_INT(C.order, 1);
    C.name = NULL;
    falls[0] = 0.25, falls[1] = 0.5, falls[2] = 0.75; /* it starts at 0 */
    CHECK_INT(rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), RK_EEXPLICIT);
    falls[0] = 0, falls[1] = -0.5; /* the first step goes back */
    CHECK_INT(rk_mis(&C, &own, RK_FROM_LAST, mem, sizeof mem), RK_ETIMES);
    ALL(RK_ENULL, rk_mis(&C, NULL, RK_FROM_LAST, mem, sizeof mem), rk_mis(NULL, &kw, RK_FROM_LAST, mem, sizeof mem));
    CHECK(!C.name && rk_mis_size(0) == 0 && rk_mis_size(RK_STAGES_MAX) == 0 && rk_mis_size(RK_STAGES_MAX - 1) > 0);
}

/* Observed: y' = fast + slow with fast = (cos 20t 20 - v, -u), a stiff-free coupled pair, the fast solve by 40 steps of dp5. */
static void multirate_fast(double t, const double *y, double *f)
{
    f[0] = 8 * y[1] + cos(5 * t), f[1] = -8 * y[0];
}

static void multirate_slow(double t, const double *y, double *f)
{
    f[0] = -y[0] * y[1] + 0.5 * sin(t), f[1] = y[0] * y[0] - 0.3 * y[1];
}

static void multirate_step(const rk_coupling *C, double t, double H, double *y)
{
    const rk_table *T = rk_find("dp5");
    double z[RK_STAGES_MAX][2], slow[2 * RK_STAGES_MAX], all[2 * RK_STAGES_MAX], f[2], F[RK_ORDER_MAX][2];
    double w[RK_ORDER_MAX * RK_STAGES_MAX], k[14], x[2];
    int i, j, l, p, n;
    memcpy(z[0], y, sizeof z[0]);
    for (i = 0; i < C->stages; i++) {
        const double time = t + C->c[i] * H;
        if (i > 0) {
            const int from = rk_coupling_from(C, i), relaxed = C->form == RK_RELAXED && i == C->stages - 1;
            const double d = (C->c[i] - C->c[from]) * H, start = t + C->c[from] * H;
            n = rk_coupling_forcing(C, i, w);
            memcpy(z[i], z[from], sizeof z[i]);
            for (p = 0; p < n; p++) rk_combine(1, i, w + p * C->stages, 2, NULL, slow, 2, F[p]);
            for (j = 0; n > 0 && j < 40; j++) {
                for (l = 0; l < 7; l++) {
                    const double tau = (j + T->c[l]) / 40;
                    rk_stage(T, l, d / 40, 2, z[i], k, 2, x);
                    multirate_fast(start + tau * d, x, k + 2 * l);
                    for (p = n - 1, f[0] = f[1] = 0; p >= 0; p--) {
                        f[0] = f[0] * tau + F[p][0], f[1] = f[1] * tau + F[p][1];
                    }
                    k[2 * l] += f[0];
                    k[2 * l + 1] += f[1];
                }
                rk_update(T, d / 40, 2, z[i], k, 2, z[i], NULL);
            }
            rk_coupling_jump(C, i, w);
            rk_combine(H, i, w, 2, z[i], relaxed ? all : slow, 2, z[i]);
        }
        multirate_slow(time, z[i], slow + 2 * i);
        multirate_fast(time, z[i], all + 2 * i);
        all[2 * i] += slow[2 * i];
        all[2 * i + 1] += slow[2 * i + 1];
    }
    memcpy(y, z[C->stages - 1], sizeof z[0]);
}

TEST(test_observed_orders_of_infinitesimal_steps)
{
    static const struct {
        const char *name;
        int form, order;
    } cases[] = {{"heun", RK_FROM_LAST, 2}, {"rk4", RK_FROM_LAST, 2}, {"kw", RK_FROM_LAST, 3}, {"3/8", RK_FROM_LAST, 3},
                 {"bs3", RK_RELAXED, 3},    {"kw", RK_RELAXED, 3},    {"3/8", RK_RELAXED, 4}};
    double mem[64], reference[2] = {0.5, 0.2};
    size_t i;
    int s, pass;
    { /* dp5 on the sum, 1e4 steps */
        const rk_table *T = rk_find("dp5");
        double k[14], x[2], g[2];
        int l;
        for (s = 0; s < 10000; s++) {
            for (l = 0; l < 7; l++) {
                rk_stage(T, l, 1e-4, 2, reference, k, 2, x);
                multirate_fast((s + T->c[l]) * 1e-4, x, k + 2 * l);
                multirate_slow((s + T->c[l]) * 1e-4, x, g);
                k[2 * l] += g[0];
                k[2 * l + 1] += g[1];
            }
            rk_update(T, 1e-4, 2, reference, k, 2, reference, NULL);
        }
    }
    for (i = 0; i < sizeof cases / sizeof *cases; i++) {
        const rk_table *T = rk_find(cases[i].name);
        double error[2];
        rk_coupling C;
        if (!T) T = cases[i].name[0] == '3' ? &r38 : &kw;
        CHECK_INT(rk_mis(&C, T, cases[i].form, mem, sizeof mem), RK_OK);
        CHECK_INT(rk_coupling_order(&C, RK_OF_STEP), cases[i].order);
        for (pass = 0; pass < 2; pass++) {
            const int steps = 64 << pass;
            double y[2] = {0.5, 0.2};
            for (s = 0; s < steps; s++) multirate_step(&C, (double)s / steps, 1. / steps, y);
            error[pass] = hypot(y[0] - reference[0], y[1] - reference[1]);
        }
        if (!(fabs(log2(error[0] / error[1]) - cases[i].order) < 0.3))
            fail_msg("%s, form %d: %g %g, order %g", T->name, C.form, error[0], error[1], log2(error[0] / error[1]));
    }
}

/* A relaxed method keeps every linear invariant of fast + slow: here u + v with slopes that cancel in the sum alone. */
TEST(test_relaxed_steps_keep_linear_invariants_of_the_sum)
{
    double mem[64], y[2] = {0.5, 0.2}, kept = 0.7;
    rk_coupling C;
    double z[5][2], all[10], w[RK_ORDER_MAX * 5];
    int i, s;
    CHECK_INT(rk_mis(&C, &r38, RK_RELAXED, mem, sizeof mem), RK_OK);
    for (s = 0; s < 100; s++) { /* whatever the stages are, the last row keeps u + v: slopes (q, -q) */
        for (i = 0; i < 4; i++) {
            z[i][0] = y[0] + 0.1 * i, z[i][1] = y[1] - 0.3 * i, all[2 * i] = sin(z[i][0] * z[i][1]);
            all[2 * i + 1] = -all[2 * i];
        }
        CHECK_INT(rk_coupling_forcing(&C, 4, w), 0);
        CHECK_INT(rk_coupling_from(&C, 4), 0);
        rk_coupling_jump(&C, 4, w);
        rk_combine(0.1, 4, w, 2, y, all, 2, y);
        CHECK_NEAR(y[0] + y[1], kept, 1e-14);
    }
}

TEST(test_pairs_and_couplings_are_checked_by_one_call)
{
    const rk_coupling *C;
    rk_coupling bad;
    rk_table wrong;
    double defect_, A[64], W[72];
    size_t i;
    int l;
    for (i = 0; i < 6; i++) {
        CHECK_INT(rk_check_imex(rk_find(imex[i][0]), rk_find(imex[i][1]), &defect_), RK_OK);
        CHECK(defect_ == 0);
        CHECK_INT(rk_check_imex(rk_find(imex[i][1]), rk_find(imex[i][0]), NULL), RK_OK);
    }
    CHECK_INT(rk_check_imex(rk_find("ark4e"), rk_find("esdirk4b"), &defect_), RK_ESTEP); /* both of order 4, 7 stages */
    CHECK(defect_ > 1e-6);
    CHECK_INT(rk_check_imex(rk_find("ark3e"), rk_find("ark4i"), NULL), RK_EOTHER);
    CHECK_INT(rk_check_imex(rk_find("ark3e"), NULL, NULL), RK_ENULL);
    wrong = *rk_find("ark3i");
    CHECK_WITH(RK_EOTHER, rk_check_imex(rk_find("ark3e"), &wrong, NULL), wrong.order_hat = 0, wrong.bhat = NULL);
    wrong = *rk_find("ark3e"); /* one coefficient off so that the row sum stays: each half alone is caught, too */
    memcpy(A, wrong.A, 16 * sizeof *A);
    A[8] += 1e-9;
    A[9] -= 1e-9;
    CHECK_WITH(RK_ESTEP, rk_check_imex(&wrong, rk_find("ark3i"), NULL), wrong.A = A);
    for (l = 0; (C = rk_couplings() + l)->name; l++) {
        defect_ = 77;
        CHECK(rk_check_coupling(C, &defect_) == RK_OK && defect_ == 0);
        bad = *C;
        bad.order++;
        if (C->order < 6) CHECK_INT(rk_check_coupling(&bad, &defect_), RK_ESTEP);
        CHECK(C->order == 6 || defect_ > 1e-3);
        bad = *C;
        bad.order_hat++;
        if (C->order_hat > 0) CHECK_INT(rk_check_coupling(&bad, NULL), RK_EPAIR);
    }
    bad = *rk_coupling_find("ERK45a");
    memcpy(W, bad.W, sizeof W);
    W[7] *= 1 + 1e-9;
    CHECK_WITH(RK_ESTEP, rk_check_coupling(&bad, &defect_), bad.W = W);
    CHECK(defect_ > 1e-11);
    W[7] = nan("");
    CHECK_INT(rk_check_coupling(&bad, &defect_), RK_ETABLE);
    CHECK(defect_ > DBL_MAX);
    memcpy(W, rk_coupling_find("ERK45a")->W, sizeof W);
    for (l = 0; l < bad.stages; l++) W[bad.stages * (bad.stages - 1) + l] = HUGE_VAL; /* of the embedded solution */
    CHECK(rk_defect_coupling(&bad, RK_OF_STEP, bad.order) <= RK_TOLERANCE);
    CHECK_INT(rk_check_coupling(&bad, &defect_), RK_ETABLE);
    bad = *rk_coupling_find("ERK45a");
    CHECK_WITH(RK_ETABLE, rk_check_coupling(&bad, &defect_), bad.order = 0);
    CHECK(defect_ > DBL_MAX);
    CHECK_INT(rk_check_coupling(NULL, NULL), RK_ENULL);
    bad = *rk_coupling_find("KW3"); /* the orders hold for any beginning, slopes that depend on time do not */
    for (l = 0; l < bad.stages; l++) W[l] = bad.c[l] + 0.25;
    bad.c = W;
    CHECK(rk_defect_coupling(&bad, RK_OF_STEP, bad.order) <= RK_TOLERANCE);
    defect_ = 0;
    CHECK_INT(rk_check_coupling(&bad, &defect_), RK_ETIMES);
    CHECK(defect_ > DBL_MAX);
    bad.form = RK_RELAXED; /* Euler's method in one jump: nothing reads c_0 but this check */
    bad.stages = 2, bad.order = bad.powers = 1, bad.order_hat = 0;
    memset(W, 0, sizeof W);
    CHECK_WITH(RK_OK, rk_check_coupling(&bad, &defect_), W[0] = W[5] = 1, bad.W = W, bad.c = W + 4);
    W[4] = nan("");
    CHECK_INT(rk_check_coupling(&bad, &defect_), RK_ETIMES);
}

/* Butcher: five explicit stages have no order 5.  Shanks' family comes near as c_2 falls, its terms cancel ever more. */
TEST(test_no_five_explicit_stages_have_order_5)
{
    const double small[] = {1. / 9000, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-11, 1e-13};
    size_t l;
    for (l = 0; l < sizeof small / sizeof *small; l++) {
        const double e = small[l], c[] = {0, e, .3, .75, 1};
        const double b[] = {105. / 1134, 0, 500. / 1134, 448. / 1134, 81. / 1134};
        double A[25] = {0};
        rk_table T = plain_table("shanks", 5, 5, A, b, c);
        int i, j;
        A[5] = e, A[17] = 15. / 8, A[22] = -490. / 81, A[23] = 112. / 81;
        for (i = 2; i < 5; i++) {
            A[5 * i + 1] = c[i] * c[i] / 2, A[5 * i] = c[i];
            for (j = 2; j < i; j++) A[5 * i + 1] -= A[5 * i + j] * c[j];
            A[5 * i + 1] /= e;
            for (j = 1; j < i; j++) A[5 * i] -= A[5 * i + j];
        }
        if (rk_check(&T, NULL) >= 0) fail_msg("c_2 = %g: five explicit stages of order 5", e);
    }
}

/* Extreme: user tables: wrong order claimed, c not row sums, one typo, zero and 32 stages, NaN */
TEST(test_wrong_tables_are_refused_with_the_defect)
{
    const rk_table *T;
    double A[64], b[8], c[8], d[32], defect;
    rk_table bad;
    int i;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        defect = 77;
        CHECK(rk_check(T, &defect) == RK_OK && defect == 0);
        CHECK(T->order > 6 || (rk_check_imex(T, T, &defect) == RK_OK && defect == 0));
    }
    T = rk_find("dp5");
    memcpy(A, T->A, 49 * sizeof *A);
    memcpy(b, T->b, 7 * sizeof *b);
    memcpy(c, T->c, 7 * sizeof *c);
    memcpy(d, T->d, 28 * sizeof *d);
    CHECK_WITH(RK_ETABLE, rk_check(&bad, &defect), bad = *T, bad.A = A, bad.b = b, bad.c = c, bad.d = d, d[9] = HUGE_VAL);
    CHECK(defect > DBL_MAX);
    d[9] = T->d[9];
    CHECK_WITH(RK_ESTEP, rk_check(&bad, &defect), bad.order = 6); /* a wrong claim */
    CHECK(defect > 0.1);
    bad.order = 5;
    CHECK_WITH(RK_EPAIR, rk_check(&bad, NULL), bad.e = T->b); /* not b - bhat */
    CHECK_WITH(RK_ETABLE, rk_check(&bad, NULL), bad.e = d + 9, d[9] = HUGE_VAL, bad.powers = 0);
    CHECK_WITH(RK_EPAIR, rk_check(&bad, &defect), d[9] = T->d[9], bad.powers = 4, bad.e = T->e, bad.order_hat = 5);
    CHECK_WITH(RK_EDENSE, rk_check(&bad, &defect), bad.order_hat = 4, bad.dense_order = 5);
    bad.dense_order = 4;
    A[22] += 1e-6; /* one digit of one coefficient: 7.5e-5 of what sqrt(eps) would pass */
    CHECK_INT(rk_check(&bad, &defect), RK_ESTEP);
    A[22] = T->A[22];
    c[2] += 1e-9; /* autonomous trees do not see this */
    CHECK_INT(rk_check(&bad, &defect), RK_ESTEP);
    CHECK(defect > 1e-11 && defect < 1e-8);
    c[2] = nan("");
    CHECK(!is_finite(defect_b(&bad, 2))); /* under -ffast-math, too */
    CHECK_INT(rk_check(&bad, NULL), RK_ETABLE);
    c[2] = T->c[2];
    for (i = 0; i < 49; i++) A[i] = T->A[i % 7 * 7 + i / 7]; /* rows and columns, explicit and implicit mixed up */
    CHECK(!rk_is(&bad, RK_EXPLICIT) && !rk_is(&bad, RK_SEQUENTIAL));
    CHECK_INT(rk_check(&bad, &defect), RK_ESTEP);
    memcpy(A, T->A, 49 * sizeof *A);
    d[3] += 1e-3; /* no longer ends in b */
    CHECK_INT(rk_check(&bad, &defect), RK_EDENSE);
    CHECK_WITH(RK_ETABLE, rk_check(&bad, NULL), bad.order = 0);
    CHECK_WITH(RK_EARG, rk_check(&bad, NULL), bad.stages = 0);
    CHECK_INT(rk_check(NULL, NULL), RK_ENULL);
}

TEST(test_tables_that_cannot_be_used_are_refused)
{
    static const double A[4] = {0, 0, 1, 0}, b[2] = {1. / 2, 1. / 2}, c[2] = {0, 1}, d[4] = {1, -1. / 2, 0, 1. / 2};
    static const double euler[2] = {1, 0};
    double wrong[4] = {0, 0, 1, 0}, mem[400];
    rk_table T = table_with_dense(plain_table("heun", 2, 2, A, b, c), 2, d), X, Y;
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    X = T;
    X.stages = X.extra = 1; /* b takes the slope of an extra stage, which rk_update would leave out */
    CHECK_INT(rk_check(&X, NULL), RK_ETABLE);
    CHECK_WITH(RK_EDENSE, rk_check(&X, NULL), X.b = euler, X.order = 1);
    CHECK_WITH(RK_ETABLE, rk_check(&X, NULL), X.bhat = b, X.order_hat = 1);
    CHECK_WITH(RK_ETABLE, rk_check(&X, NULL), X.bhat = NULL); /* order_hat without bhat */
    CHECK_WITH(RK_ETABLE, rk_check(&X, NULL), X = T, X.powers = -2);
    CHECK_WITH(RK_ETABLE, rk_check(&X, NULL), X.powers = 2, X.dense_order = -3);
    X = T, X.A = wrong;
    wrong[2] = nan("");
    ALL(RK_ETABLE, rk_extend(&Y, &X, NULL, 0, 0, mem, sizeof mem), rk_extend(&Y, &T, &X, 1, 0, mem, sizeof mem));
    wrong[2] = 1;
    X.b = euler; /* the halves of an IMEX method end in the same b */
    CHECK_INT(rk_extend(&Y, &T, &X, 1, 0, mem, sizeof mem), RK_EOTHER);
    CHECK_INT(rk_extend(&Y, &T, NULL, 2, 0, mem, sizeof mem), RK_OK);
    CHECK_INT(rk_extend(&Y, &Y, NULL, 2, 0, mem, sizeof mem), RK_EOVERLAP); /* mem holds the table's own arrays */
    CHECK_INT(rk_extend(&X, &T, &Y, 1, 0, mem, sizeof mem), RK_EOVERLAP);
    CHECK(Y.A[2] == 1 && Y.b[1] == 1. / 2);
    X = T;
    CHECK_WITH(RK_EOVERLAP, rk_extend(&X, &X, NULL, 1, 0, mem, sizeof mem), X.d = Y.d); /* the dense output that it has, too */
}

/* Eight and sixteen steps of rk4 as one; 64 stages are as many as there may be. */
TEST(test_tables_of_32_and_of_64_stages)
{
    static double A[64 * 64], b[64], c[64], mem[30000];
    const rk_table *T = rk_find("rk4");
    int steps, step, i, j, l;
    for (steps = 8; steps <= 16; steps += 8) {
        const int m = 4 * steps;
        rk_table big = plain_table("rk4 again and again", m, 4, A, b, c), X;
        memset(A, 0, sizeof A);
        for (step = 0; step < steps; step++)
            for (i = 0; i < 4; i++) {
                const int row = 4 * step + i;
                for (l = 0; l < step; l++)
                    for (j = 0; j < 4; j++) A[row * m + 4 * l + j] = T->b[j] / steps;
                for (j = 0; j < 4; j++) A[row * m + 4 * step + j] = T->A[4 * i + j] / steps;
                b[row] = T->b[i] / steps, c[row] = (step + T->c[i]) / steps;
            }
        CHECK_INT(rk_check(&big, NULL), RK_OK);
        CHECK(defect_b(&big, 5) > 1e-8);
        CHECK_INT(rk_extend(&X, &big, NULL, 4, 0, mem, rk_extend_size(m, 4) - 1), RK_EMEM);
        CHECK_INT(rk_extend(&X, &big, NULL, 4, 0, mem, rk_extend_size(m, 4)), RK_OK);
        CHECK_INT(rk_check(&X, NULL), RK_OK);
        CHECK_INT(X.dense_order, 4);
    }
    CHECK(rk_extend_size(65, 4) == 0 && rk_extend_size(RK_STAGES_MAX, RK_ORDER_MAX) > 0);
}

/* Tables that are wrong in widely used libraries */
TEST(test_known_bad_tables_are_refused)
{
    /* ARKIMEX BPR3, explicit half: the last row with 3/5 where 3/4 is meant (order 1 in place of 3); c = 0 1 2/3 1 1 */
    static const double c[] = {0, 1, 2. / 3, 1, 1}, b[] = {1. / 4, 0, 3. / 4, -1. / 2, 1. / 2};
    double E[25] = {0}, I[25] = {0}, defect;
    const rk_table good = plain_table("bpr3e", 5, 3, E, b, c);
    const rk_table implicit = plain_table("bpr3i", 5, 3, I, b, c);
    int i;
    E[5] = 1, E[10] = 4. / 9, E[11] = 2. / 9, E[15] = 1. / 4, E[17] = 3. / 4, E[20] = 1. / 4, E[22] = 3. / 4;
    I[5] = I[6] = I[12] = I[18] = I[24] = 1. / 2, I[10] = 5. / 18, I[11] = -1. / 9, I[15] = 1. / 2;
    I[20] = 1. / 4, I[22] = 3. / 4, I[23] = -1. / 2;
    for (i = 1; i <= 3; i++) CHECK(defect_pair(&good, &implicit, 0, i) <= RK_TOLERANCE);
    CHECK_INT(rk_check(&implicit, NULL), RK_OK);
    CHECK_WITH(RK_ESTEP, rk_check(&good, &defect), E[22] = 3. / 5);
    CHECK(defect_b(&good, 1) <= RK_TOLERANCE && defect_b(&good, 2) > 0.05);
    { /* ARKIMEX L2: both theta^2 entries of the dense output with the same sign: sum b_i(1) != 1 */
        const double g = 1 - 1 / sqrt(2.), cl[] = {g, 1 - g}, A[] = {g, 0, 1 - 2 * g, g}, bl[] = {0.5, 0.5};
        const double d[] = {(1 - g) / (1 - 2 * g), -0.5 / (1 - 2 * g), -g / (1 - 2 * g), -0.5 / (1 - 2 * g)};
        double ok[4];
        rk_table l2 = table_with_dense(plain_table("l2", 2, 2, A, bl, cl), 2, d);
        memcpy(ok, d, sizeof d);
        CHECK_WITH(RK_OK, rk_check(&l2, &defect), ok[3] = -d[3], l2.d = ok);
        CHECK_WITH(RK_EDENSE, rk_check(&l2, &defect), l2.d = d);
        CHECK(defect > 0.1);
    }
    { /* an interpolant of order 6 that is documented as 7 (Vern7's case): DOP853's own of order 6 claimed as 7 */
        static double mem[20000];
        rk_table X;
        CHECK_INT(rk_extend(&X, rk_find("dop853"), NULL, 6, 0, mem, sizeof mem), RK_OK);
        CHECK_INT(rk_check(&X, NULL), RK_OK);
        CHECK_WITH(RK_EDENSE, rk_check(&X, &defect), X.dense_order = 7);
    }
    { /* c[2] = 2 where the row sums to 0.2 (Feagin12's slip), here on RK4: exact for y' = f(y), wrong with time */
        const rk_table *T = rk_find("rk4");
        const double cw[] = {0, 0.5, 2, 1};
        rk_table X = *T;
        CHECK_WITH(RK_ESTEP, rk_check(&X, &defect), X.c = cw);
    }
    { /* Lobatto IIIB with two stages: c is not the row sums and it is right all the same */
        double mem[128];
        rk_table X;
        CHECK_INT(rk_collocation(&X, RK_LOBATTO_IIIB, 2, mem, sizeof mem), RK_OK);
        CHECK_INT(rk_check(&X, NULL), RK_ROWSUM);
    }
}

/* Extreme: weights of size 1e2 that cancel: judged by the size of the terms, not absolutely */
TEST(test_cancelling_weights_are_judged_by_their_size)
{
    /* two stages at almost the same place: b = +-150 in a table of order 2, exactly representable */
    const double g = 1. / 512, A[] = {0, 0, 0, 0.5, 0, 0, 0.5 + g, 0, 0}, c[] = {0, 0.5, 0.5 + g};
    double b[] = {-150 * g / 0.5, 151 + 150 * g / 0.5, -150}, defect;
    rk_table T = plain_table("cancel", 3, 2, A, b, c);
    CHECK_INT(rk_check(&T, &defect), RK_OK);
    b[1] += 1e-9;
    CHECK_INT(rk_check(&T, &defect), RK_ESTEP);
}

TEST(test_properties_are_found_in_the_numbers)
{
    double mem[128], room[600];
    const rk_table *T;
    int s;
    rk_table X;
    for (s = 0; (T = rk_tables() + s)->name; s++) { /* Radau alone is coupled; implicit ones claim a stiff order */
        CHECK_INT(rk_is(T, RK_SEQUENTIAL), strncmp(T->name, "radau", 5) != 0);
        CHECK_INT(rk_is(T, RK_EXPLICIT), T->dense_stiff == 0);
    }
    X = *rk_find("esdirk3");
    for (s = 0; s < X.stages; s++) { /* one number of the last row is not that of b */
        memcpy(room, X.b, (size_t)X.stages * sizeof *room);
        room[s] += 1e-15;
        X.b = room;
        CHECK(rk_is(&X, RK_STIFFLY_ACCURATE) == 0 && rk_is(&X, RK_FSAL) == 0);
        X.b = rk_find("esdirk3")->b;
        CHECK(rk_is(&X, RK_STIFFLY_ACCURATE) == 1 && rk_is(&X, RK_FSAL) == 1);
    }
    CHECK(rk_is(rk_find("dp5"), RK_FSAL) && rk_is(rk_find("bs3"), RK_FSAL) && rk_is(rk_find("esdirk3"), RK_FSAL));
    CHECK(!rk_is(rk_find("rk4"), RK_FSAL) && !rk_is(rk_find("kutta3"), RK_STIFFLY_ACCURATE)); /* c_s = 1 is not enough */
    CHECK(rk_is(rk_find("sdirk2"), RK_STIFFLY_ACCURATE) && !rk_is(rk_find("sdirk2"), RK_FSAL));
    CHECK(rk_is(rk_find("rk4"), RK_EXPLICIT) && rk_is(rk_find("rk4"), RK_SEQUENTIAL) && !rk_is(rk_find("sdirk2"), RK_EXPLICIT));
    CHECK_INT(rk_collocation(&X, RK_RADAU_IIA, 2, mem, sizeof mem), RK_OK);
    CHECK(!rk_is(&X, RK_SEQUENTIAL) && rk_is(&X, RK_STIFFLY_ACCURATE));
    CHECK_INT(rk_is(&X, 99), RK_EARG);
    CHECK_INT(rk_is(NULL, RK_STIFFLY_ACCURATE), RK_ENULL);
    { /* two stages that look alike, the last of them at t + h/2: not the first slope of the next step */
        const double A[] = {0, 0, 1. / 2, 1. / 2}, b[] = {1. / 2, 1. / 2}, c[] = {0, 1. / 2};
        const rk_table half = plain_table("half", 2, 1, A, b, c);
        CHECK_INT(rk_check(&half, NULL), RK_ROWSUM);
        CHECK(!rk_is(&half, RK_FSAL) && rk_is(&half, RK_STIFFLY_ACCURATE));
    }
    { /* the first slope of FSAL is f(t, y): a first row that is not zero in one number is no such slope */
        const double A[] = {0.5, 0, 0.5, 0.5}, b[] = {0.5, 0.5}, c[] = {0, 1};
        const rk_table first = plain_table("first", 2, 1, A, b, c);
        CHECK(!rk_is(&first, RK_FSAL) && rk_is(&first, RK_STIFFLY_ACCURATE));
    }
    CHECK_INT(rk_collocation(&X, RK_GAUSS, 2, mem, sizeof mem), RK_OK);
    CHECK(!rk_is(&X, RK_STIFFLY_ACCURATE));
    CHECK_INT(rk_is(rk_find("trapezoid"), RK_FSAL), 1); /* two stages are enough */
    for (s = 2; s <= 5; s++) {
        CHECK_INT(rk_collocation(&X, RK_LOBATTO_IIIC, s, room, sizeof room), RK_OK);
        CHECK(rk_is(&X, RK_STIFFLY_ACCURATE));
    }
}

/* ---- derived dense output --------------------------------------------------------------------------------------------- */

/* rk_extend in double against the stored extensions, which were derived in 100 digits by another program. */
TEST(test_derived_dense_output_is_the_stored_one)
{
    static const char *const names[] = {"euler",  "heun",    "midpoint", "kutta3",   "ssp33",     "ssp43",     "ssp104",
                                        "bs3",    "rk4",     "beuler",   "imidpoint", "trapezoid", "sdirk2",
                                        "trbdf2", "esdirk3", "esdirk4",  "esdirk4b", "esdirk5",   "sdirk4",    "wso3"};
    static double mem[4000];
    rk_table X;
    size_t i;
    int j;
    for (i = 0; i < sizeof names / sizeof *names; i++) {
        const rk_table *T = rk_find(names[i]);
        CHECK_INT(rk_extend(&X, T, NULL, 0, 0, mem, rk_extend_size(T->stages, RK_ORDER_MAX)), RK_OK);
        CHECK_INT(X.dense_order, T->dense_order); /* the highest that exists, or for implicit ones that stays bounded */
        CHECK_INT(X.powers, T->powers);
        for (j = 0; j < T->stages * T->powers; j++)
            if (!(fabs(X.d[j] - T->d[j]) <= 1e-10 * (1 + fabs(T->d[j]))))
                fail_msg("%s: %d: %.17g %.17g", T->name, j, X.d[j], T->d[j]);
        CHECK_INT(rk_check(&X, NULL), RK_OK);
    }
}

/* Every table, order and number of extra stages in exactly the memory that rk_extend_size asks for: the sanitizers look on. */
TEST(test_rk_extend_size_is_enough)
{
    const rk_table *T;
    int i, order, extra;
    for (i = 0; (T = rk_tables() + i)->name; i++)
        for (order = 0; order <= 6; order += LESS > 1 ? 3 : 1)
            for (extra = 0; extra <= 9; extra += extra < 3 ? 1 : 3) { /* of dop853 the rows that are added cancel to 1e-13 */
                if (extra > 2 && order > 0) break;
                const size_t bytes = rk_extend_size(T->stages + T->extra + extra, order ? order : RK_ORDER_MAX);
                void *mem = malloc(bytes);
                rk_table X;
                int status;
                CHECK(mem != NULL);
                status = rk_extend(&X, T, NULL, order, extra, mem, bytes);
                CHECK(status == RK_OK || status == RK_LESS || status == RK_UNBOUNDED);
                CHECK_INT(rk_check(&X, NULL), RK_OK);
                CHECK(status != RK_OK || X.dense_order >= order);
                CHECK(status != RK_LESS || X.dense_order < order);
                CHECK(status != RK_UNBOUNDED || (order > 0 && !rk_is(T, RK_EXPLICIT)));
                free(mem);
            }
}

/* The extra stages that a generic bootstrap needs for order p */
TEST(test_bootstrapped_dense_output_reaches_the_order_of_the_method)
{
    static const struct {
        const char *name;
        int order, extra;
    } cases[] = {{"dp5", 5, 2}, {"tsit5", 5, 2}, {"rk4", 4, 2}, {"ss4", 4, 2}, {"kutta3", 3, 1}, {"ssp104", 4, 1}};
    static double mem[8000];
    rk_table X;
    size_t i;
    for (i = 0; i < sizeof cases / sizeof *cases; i++) {
        double coarse[3], fine[3];
        const int steps = cases[i].order < 5 ? 100 : 20;
        const size_t bytes = rk_extend_size(rk_find(cases[i].name)->stages + cases[i].extra, cases[i].order);
        CHECK_INT(rk_extend(&X, rk_find(cases[i].name), NULL, cases[i].order, cases[i].extra, mem, bytes), RK_OK);
        CHECK_INT(X.extra, cases[i].extra);
        CHECK_INT(X.dense_order, cases[i].order);
        CHECK_INT(rk_check(&X, NULL), RK_OK);
        integrate(&X, steps, coarse);
        integrate(&X, 2 * steps, fine);
        CHECK(log2(coarse[1] / fine[1]) > cases[i].order - 0.3 && log2(coarse[2] / fine[2]) > cases[i].order - 0.3);
        CHECK_INT(rk_extend(&X, rk_find(cases[i].name), NULL, cases[i].order, cases[i].extra - 1, mem, sizeof mem), RK_LESS);
        CHECK(X.dense_order < cases[i].order);
    }
    for (i = 0; i < 2; i++) { /* order 0 is that of the method; no more stages than it needs */
        CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, i ? 4 : 0, 4, mem, sizeof mem), RK_OK);
        CHECK(X.dense_order == 4 && X.extra == 2);
    }
    CHECK_INT(rk_extend(&X, rk_find("ark4e"), rk_find("ark4i"), 3, 0, mem, sizeof mem), RK_OK); /* a pair */
    CHECK(defect_dense(&X, 3) <= RK_TOLERANCE);
    CHECK_WITH(RK_ENULL, rk_extend(&X, NULL, NULL, 3, 0, mem, sizeof mem), X.name = NULL);
    CHECK_INT(rk_extend(NULL, rk_find("rk4"), NULL, 3, 0, mem, sizeof mem), RK_ENULL);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 11, 0, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), rk_find("bs3"), 3, -1, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 3, 0, mem, rk_extend_size(4, 3) - 1), RK_EMEM);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 3, 0, (char *)mem + 4, sizeof mem - 8), RK_EMEM);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 3, 0, NULL, sizeof mem), RK_EMEM);
    CHECK(X.name == NULL);
}

/* Extreme: Prothero & Robinson, y' = lambda (y - cos t) - sin t, lambda = -1e8, h = 0.1: with a start that is off
   by 1e-8 the dense output stays near 1e-5, where the cubic Hermite one (C1) is off by more than 1e-3. */
static double prothero_robinson(const rk_table *T, double off, int hermite)
{
    const double lambda = -1e8, h = 0.1, t0 = 0.5;
    const int m = T->stages + T->extra;
    double y = cos(t0) + off, ynew = 0, k[RK_STAGES_MAX], z = 0, v = 0, worst = 0;
    int i;
    for (i = 0; i < m; i++) {
        const double t = t0 + T->c[i] * h, a = T->A[i * (m + 1)];
        rk_stage(T, i, h, 1, &y, k, 1, &z);
        k[i] = (lambda * (z - cos(t)) - sin(t)) / (1 - h * a * lambda);
    }
    rk_update(T, h, 1, &y, k, 1, &ynew, NULL);
    for (i = 1; i < 50; i++) {
        const double x = i / 50.;
        if (hermite) {
            const double f0 = lambda * (y - cos(t0)) - sin(t0), f1 = lambda * (ynew - cos(t0 + h)) - sin(t0 + h);
            v = (1 - x) * y + x * ynew + x * (x - 1) * ((1 - 2 * x) * (ynew - y) + (x - 1) * h * f0 + x * h * f1);
        } else dense(T, x, 0, h, 1, &y, k, 1, &v);
        worst = fmax(worst, fabs(v - cos(t0 + x * h)));
    }
    return worst;
}

TEST(test_dense_output_stays_bounded_for_stiff_parts)
{
    static const char *const names[] = {"trbdf2", "esdirk3", "esdirk4", "esdirk4b", "esdirk5",
                                        "ark2i",  "ark3i",   "ark4i",   "ark5i"};
    static const double bound[] = {1e-3, 1e-4, 2e-5, 1e-4, 1e-4, 1e-3, 1e-3, 1e-4, 1e-4};
    size_t i;
    for (i = 0; i < sizeof names / sizeof *names; i++) {
        const rk_table *T = rk_find(names[i]);
        if (!(prothero_robinson(T, 0, 0) < bound[i])) fail_msg("%s: %g", names[i], prothero_robinson(T, 0, 0));
        CHECK_NEAR(prothero_robinson(T, 1e-8, 0), prothero_robinson(T, 0, 0), 1e-7); /* nothing is amplified */
    }
    CHECK(prothero_robinson(rk_find("esdirk4"), 1e-8, 0) < 2e-5);
    CHECK(prothero_robinson(rk_find("esdirk4"), 1e-8, 1) > 1e-3); /* what others do */
}

/* Slopes of coupled stages for y' = lambda (y - phi) + dphi: (I/lambda - h A) k = y - phi + dphi/lambda.  Slope 0 is given. */
static void coupled_slopes(const rk_table *T, double t, double h, double lambda, double y, double *k)
{
    double M[RK_STAGES_MAX * RK_STAGES_MAX];
    const int m = T->stages;
    int i, j;
    for (i = 1; i < m; i++) {
        const double ti = t + T->c[i] * h;
        k[i] = y - sin(ti) - 0.5 * cos(2 * ti) + (cos(ti) - sin(2 * ti)) / lambda;
        for (j = 1; j < m; j++) M[(i - 1) * (m - 1) + j - 1] = (i == j) / lambda - h * T->A[i * m + j];
    }
    CHECK_INT(rkp__eliminate(m - 1, M, k + 1), 1);
}

/* Equal steps over [0, 4] of Prothero & Robinson's problem with lambda, the last slope of a step the first of the next:
   the largest error inside the steps behind the first one. */
static double inside_stiff_steps(const rk_table *T, double lambda, int steps)
{
    const double h = 4. / steps;
    const int m = T->stages;
    double y = 0.5 + sin(0.), k[RK_STAGES_MAX], z, u, worst = 0;
    int s, i, j;
    for (s = 0; s < steps; s++) {
        const double t = s * h;
        if (!rk_is(T, RK_SEQUENTIAL)) coupled_slopes(T, t, h, lambda, y, k); /* slope 0 counts in none of them, nor inside */
        for (i = 0; i < m && rk_is(T, RK_SEQUENTIAL); i++) {
            const double ti = t + T->c[i] * h, phi = sin(ti) + 0.5 * cos(2 * ti), dphi = cos(ti) - sin(2 * ti);
            const double g = h * T->A[i * (m + 1)];
            if (i == 0 && s > 0 && rk_is(T, RK_FSAL)) {
                k[0] = k[m - 1];
                continue;
            }
            rk_stage(T, i, h, 1, &y, k, 1, &z);
            u = (z + g * (dphi - lambda * phi)) / (1 - g * lambda);
            k[i] = g != 0 ? (u - z) / g : lambda * (z - phi) + dphi;
        }
        for (j = 1; s > 0 && j < 16; j++) {
            const double tj = t + h * j / 16;
            dense(T, j / 16., 0, h, 1, &y, k, 1, &u);
            worst = fmax(worst, fabs(u - sin(tj) - 0.5 * cos(2 * tj)));
        }
        rk_update(T, h, 1, &y, k, 1, &y, NULL);
    }
    return worst;
}

/* Inside stiff steps the order is dense_stiff, whatever the uniform order is; the errors are those of another program. */
TEST(test_dense_output_has_its_stiff_order)
{
    const rk_table *T;
    int i;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        double coarse, fine, order;
        if (T->dense_stiff == 0 || strncmp(T->name, "ars", 3) == 0 || T->order < 2 || T->stages < 2) continue;
        if (strcmp(T->name, "trapezoid") == 0) continue; /* not damped: the start is remembered */
        coarse = inside_stiff_steps(T, -1e6, 32), fine = inside_stiff_steps(T, -1e6, 64);
        order = log2(coarse / fine);
        if (!(order > T->dense_stiff - 0.35 && order < T->dense_stiff + 0.6))
            fail_msg("%s: %g %g, order %g for %d", T->name, coarse, fine, order, T->dense_stiff);
    }
    CHECK_NEAR(inside_stiff_steps(rk_find("esdirk5"), -1e6, 16) / 5.1e-5, 1, 0.01); /* the only table of orders 4 and 4 */
    CHECK_NEAR(inside_stiff_steps(rk_find("esdirk5"), -1e6, 128) / 1.3e-8, 1, 0.05);
    CHECK_NEAR(inside_stiff_steps(rk_find("esdirk5"), -1e2, 32) / 3.0e-5, 1, 0.02);
    EXTREME("Stiffness 1e6, 64 steps in a time of 4",
            "error inside the steps %.0e by esdirk3, %.0e by radau5; twice the steps: %.0e, %.0e", inside_stiff_steps(rk_find("esdirk3"), -1e6, 64),
            inside_stiff_steps(rk_find("radau5"), -1e6, 64), inside_stiff_steps(rk_find("esdirk3"), -1e6, 128),
            inside_stiff_steps(rk_find("radau5"), -1e6, 128));
}

/* The claim of a stiff order is proven, and refused where it is false. */
TEST(test_a_false_stiff_order_is_refused)
{
    const rk_table *T;
    rk_table X;
    double defect;
    int i;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        X = *T, X.dense_stiff = T->dense_stiff ? T->dense_stiff + 1 : 2;
        CHECK_INT(rk_check(&X, &defect), RK_EDENSE);
        CHECK(defect > RK_TOLERANCE);
        CHECK(rk_is(T, RK_EXPLICIT) != 1 || defect > DBL_MAX); /* no row that could miss it by less */
    }
    X = *rk_find("esdirk4");
    CHECK_WITH(RK_EDENSE, rk_check(&X, NULL), X.dense_stiff = 1);
    CHECK_WITH(RK_EDENSE, rk_check(&X, NULL), X.dense_stiff = -3);
}

/* Tables that are not stiffly accurate: the stiff conditions have to hold for b = d(1), too.  What rk_extend claims rk_check
   accepts, and Prothero & Robinson's problem shows it. */
TEST(test_extended_tables_have_the_stiff_order_that_they_claim)
{
    const double g = 1 - sqrt(0.5), ssp222[] = {g, 0, 1 - 2 * g, g}, half[] = {0.5, 0.5}, nodes[] = {g, 1 - g};
    const double last[] = {0, 0, 0.5, 0.5}, quarter[] = {0.25, 0.75}, ends[] = {0, 1};
    const double one[] = {1}, middle[] = {0.5};
    const rk_table pareschi = plain_table("SSP2(2,2,2), implicit half", 2, 2, ssp222, half, nodes);
    const rk_table uneven = plain_table("uneven", 2, 1, last, quarter, ends);
    const rk_table apart = plain_table("backward Euler, time apart", 1, 1, one, one, middle);
    double mem[500], coarse, fine;
    rk_table X;
    CHECK(rk_extend(&X, &pareschi, NULL, 0, 0, mem, sizeof mem) >= 0);
    CHECK_INT(rk_check(&X, NULL), RK_OK);
    CHECK(X.dense_order == 2 && X.dense_stiff == 2);
    coarse = inside_stiff_steps(&X, -1e9, 32), fine = inside_stiff_steps(&X, -1e9, 64);
    CHECK_NEAR(log2(coarse / fine), 2, 0.2);
    CHECK(rk_extend(&X, &uneven, NULL, 0, 0, mem, sizeof mem) >= 0);
    CHECK_INT(rk_check(&X, NULL), RK_OK);
    CHECK_INT(X.dense_stiff, 0); /* not bounded at theta = 1 */
    CHECK(rk_extend(&X, &apart, NULL, 0, 0, mem, sizeof mem) >= 0);
    CHECK_INT(rk_check(&X, NULL), RK_ROWSUM);
    CHECK_INT(X.dense_stiff, 0);
}

/* rk_extend says what it could not do: unbounded, of a form without proof, less than asked for. */
TEST(test_rk_extend_says_when_it_is_not_bounded)
{
    const double twice[] = {0, 0, 0, 0, 0, 0, .25, .25, .5}, b[] = {.25, .25, .5}, c[] = {0, 0, 1};
    const double behind[] = {.5, 0, .5, 0}, half[] = {.5, .5}, ends[] = {.5, .5};
    const rk_table padded = plain_table("trapezoid, padded", 3, 2, twice, b, c);
    const rk_table last = plain_table("explicit last", 2, 1, behind, half, ends);
    static double mem[4000];
    double k[3], y = 1, u, l = -1e7, room[600];
    int family, s, i, status;
    rk_table X, G;
    CHECK_INT(rk_extend(&X, rk_find("trapezoid"), NULL, 2, 0, mem, sizeof mem), RK_UNBOUNDED); /* it exists */
    CHECK(X.dense_order == 2 && X.dense_stiff == 0 && rk_check(&X, NULL) == RK_OK);
    CHECK_INT(rk_extend(&X, rk_find("trapezoid"), NULL, 0, 0, mem, sizeof mem), RK_OK);
    CHECK(X.dense_order == 1 && X.dense_stiff == 2);
    CHECK_INT(rk_check(&padded, NULL), RK_OK); /* two explicit rows */
    CHECK_INT(rk_extend(&X, &padded, NULL, 0, 0, mem, sizeof mem), RK_OK);
    CHECK_WITH(RK_OK, dense(&X, 0.5, 0, 1, 1, &y, k, 1, &u), k[0] = k[1] = l, k[2] = l * (1 + l / 2) / (1 - l / 2));
    CHECK(fabs(u) <= 1.0001);
    CHECK_INT(rk_extend(&X, &last, NULL, 0, 0, mem, sizeof mem), RK_UNBOUNDED); /* no proof for this form */
    CHECK_INT(rk_collocation(&G, RK_GAUSS, 2, room, sizeof room), RK_OK);
    CHECK_INT(rk_extend(&X, &G, NULL, 0, 0, mem, sizeof mem), RK_OK); /* the collocation polynomial */
    CHECK_INT(rk_check(&X, NULL), RK_OK);
    CHECK(X.dense_order == 2 && X.dense_stiff == 3);
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = 2; s <= 5; s++) { /* A of IIIA (without its row 0) and of IIIC is regular, that of IIIB singular */
            CHECK_INT(rk_collocation(&G, family, s, room, sizeof room), RK_OK);
            status = rk_extend(&X, &G, NULL, 0, 0, mem, sizeof mem);
            if (status < 0 || rk_check(&X, NULL) < 0) fail_msg("%s: %d, %d", G.name, status, rk_check(&X, NULL));
            if (family == RK_LOBATTO_IIIB && s > 2) CHECK_INT(status, RK_UNBOUNDED);
            if (family > RK_RADAU_IIA) continue;
            CHECK(status == RK_OK && X.dense_order == s && X.dense_stiff == (s < 4 ? s + 1 : 4));
            for (i = 0; i < s * s && s < 4; i++) CHECK_NEAR(X.d[i], G.d[i], 1e-12);
        }
    CHECK_INT(rk_extend(&X, rk_find("esdirk4b"), NULL, 4, 0, mem, sizeof mem), RK_UNBOUNDED); /* 1.31 at best */
    CHECK(X.dense_order == 4);
    CHECK_INT(rk_extend(&X, rk_find("esdirk4b"), NULL, 3, 0, mem, sizeof mem), RK_OK);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 4, 0, mem, sizeof mem), RK_LESS);
    CHECK(X.dense_order == 3);
}

/* The slopes of the last step predict implicit stages of the next: theta = 1 + c_i h'/h. */
TEST(test_dense_output_predicts_the_stages_of_the_next_step)
{
    const rk_table *T = rk_find("esdirk4");
    double y[2] = {1, 1}, old[2], k[12], next[12], v[2], z, worst[2] = {0, 0};
    int pass, i;
    for (pass = 0; pass < 2; pass++) {
        const double h = 0.1 / (1 + pass);
        exact(0.3, y);
        stages(T, 0.3, h, y, k);
        memcpy(old, y, sizeof y);
        CHECK_INT(rk_update(T, h, 2, y, k, 2, y, NULL), RK_OK);
        stages(T, 0.3 + h, h, y, next);
        for (i = 1; i < T->stages; i++) {
            CHECK_INT(dense(T, 1 + T->c[i], 0, h, 2, old, k, 2, v), RK_EXTRAP);
            z = y[1] + h * dot(T->stages, T->A + 6 * i, next + 1, 2);
            worst[pass] = fmax(worst[pass], fabs(v[1] - z));
        }
    }
    CHECK(worst[0] < 1e-3 && log2(worst[0] / worst[1]) > 3); /* the constant prediction is off by 0.1 */
}

TEST(test_many_thetas_in_one_sweep)
{
    enum { n = 5003 };
    static double y[n], k[7 * n], one[n], many[4 * n];
    static const double theta[] = {0, 0.3, 1, 1.5};
    const rk_table *T = rk_find("dp5");
    int i, l;
    for (i = 0; i < 7 * n; i++) k[i] = sin(i);
    for (i = 0; i < n; i++) y[i] = cos(i);
    CHECK_INT(dense_many(T, 4, theta, 0, 0.1, n, y, k, n, many, n), RK_EXTRAP);
    for (l = 0; l < 4; l++) {
        CHECK(dense(T, theta[l], 0, 0.1, n, y, k, n, one) >= 0 && memcmp(one, many + l * n, sizeof one) == 0);
    }
    CHECK_INT(dense_many(T, 3, theta, 1, 0.1, n, NULL, k, n, many, n), RK_OK);
    for (l = 0; l < 3; l++) { /* sums without y, element by element */
        double weight[7];
        CHECK_INT(rk_weights(T, theta[l], 1, weight), RK_OK);
        for (i = 0; i < n; i++) CHECK_NEAR(many[l * n + i], dot(7, weight, k + i, n), 1e-14);
    }
    CHECK_WITH(RK_EARG, dense_many(T, -1, theta, 0, 0.1, n, y, k, n, many, n), many[0] = 7);
    CHECK_INT(dense_many(T, 4, NULL, 0, 0.1, n, y, k, n, many, n), RK_ENULL);
    CHECK_INT(dense_many(T, 4, theta, 0, 0.1, n, y, k, n, many, n - 1), RK_EARG);
    CHECK_INT(dense_many(T, 4, theta, 0, 0.1, n, NULL, k, n, many, n), RK_ENULL);
    CHECK(many[0] == 7);
    CHECK_INT(dense_many(T, 4, theta, 0, 0.1, 0, NULL, NULL, 0, NULL, 0), RK_EXTRAP);
}

/* x' = -(1 + t) x y and y' = -e^t x y^2, each solved with the other one as a waveform, to convergence; x = e^-t, y = 1/(1 + t).
   A side hands out its dense output at `points` points of each step, interpolated there with degree points - 1.  The first
   points are not symmetric: with 0, 1/2, 1 the error of a quadratic cancels over the step and hides the loss. */
enum { coupled_most = 128, coupled_points = 6 };
static const double coupled_node[][coupled_points] = {{0}, {0}, {0, 1}, {0, 0.3, 1}, {0, 0.2, 0.6, 1}, {0, 0.25, 0.5, 0.75, 1}, {0, 0.2, 0.4, 0.6, 0.8, 1}};
typedef struct coupled_side {
    int steps;
    double h, y[coupled_most + 1], given[coupled_most][coupled_points];
} coupled_side;

static double coupled_read(int points, const coupled_side *side, double t)
{
    const double *node = coupled_node[points];
    double u = 0;
    int s = (int)floor(t / side->h + 1e-9), p, l;
    if (s > side->steps - 1) s = side->steps - 1;
    for (p = 0; p < points; p++) { /* Lagrange */
        double v = side->given[s][p];
        for (l = 0; l < points; l++)
            if (l != p) v *= (t / side->h - s - node[l]) / (node[p] - node[l]);
        u += v;
    }
    return u;
}

static void coupled_step(const rk_table *T, int points, coupled_side *side, const coupled_side *other, int which, int s)
{
    const double h = side->h, *y = side->y + s;
    double k[RK_STAGES_MAX] = {0}, z[RK_STAGES_MAX], read[RK_STAGES_MAX];
    int i, turn;
    for (i = 0; i < T->stages; i++) read[i] = coupled_read(points, other, (s + T->c[i]) * h);
    for (turn = 0; turn < 40; turn++) { /* nothing is stiff: the stages by repetition */
        CHECK_INT(rk_stages(T, h, 1, y, k, 1, z, 1), RK_OK);
        for (i = 0; i < T->stages; i++) {
            const double t = (s + T->c[i]) * h;
            k[i] = which == 0 ? -(1 + t) * z[i] * read[i] : -exp(t) * read[i] * z[i] * z[i];
        }
    }
    rk_update(T, h, 1, y, k, 1, side->y + s + 1, NULL);
    for (i = 0; i < points; i++) CHECK_INT(dense(T, coupled_node[points][i], 0, h, 1, y, k, 1, &side->given[s][i]), RK_OK);
}

/* The order seen at t = 1 with so many steps of x, and `ratio` times as many of y, and with twice as many of both. */
static double coupled_order(const rk_table *T, int points, int steps, int ratio)
{
    static coupled_side side[2];
    double error[2];
    int pass, turn, which, s, i;
    for (pass = 0; pass < 2; pass++, steps *= 2) {
        memset(side, 0, sizeof side);
        for (which = 0; which < 2; which++) {
            side[which].steps = which ? steps * ratio : steps, side[which].h = 1. / side[which].steps;
            side[which].y[0] = 1;
            for (s = 0; s < side[which].steps; s++)
                for (i = 0; i < points; i++) side[which].given[s][i] = 1;
        }
        for (turn = 0; turn < 30; turn++)
            for (which = 0; which < 2; which++)
                for (s = 0; s < side[which].steps; s++) coupled_step(T, points, side + which, side + 1 - which, which, s);
        error[pass] = hypot(side[0].y[steps] - exp(-1.), side[1].y[steps * ratio] - 0.5);
    }
    return log2(error[0] / error[1]);
}

TEST(test_waveform_iterations_keep_the_order)
{
    static const int stages[] = {0, 3, 3, 4, 3, 4}; /* of generated tables, whose dense order is below p - 1 */
    double mem[512], order;
    int family, ratio, points;
    for (points = 2; points <= 4; points++) { /* rk4, dense order 3: p points keep order p, fewer do not */
        order = coupled_order(rk_find("rk4"), points, 16, 2);
        if (!(fabs(order - points) < 0.35)) fail_msg("rk4 at %d points: order %.2f", points, order);
    }
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++) {
        rk_table T;
        CHECK_INT(rk_collocation(&T, family, stages[family], mem, sizeof mem), RK_OK);
        CHECK(T.dense_order < T.order - 1);
        for (ratio = 1; ratio <= 2; ratio++) {
            order = coupled_order(&T, T.order, T.order > 4 ? 4 : 8, ratio);
            if (!(order > (ratio == 1 ? T.order : T.dense_order + 1) - 0.3)) fail_msg("%s, ratio %d: order %.2f", T.name, ratio, order);
        }
    }
}

/* ---- error norm and step control ------------------------------------------------------------------------------------------ */

/* Every law of the step control, by name or as a row of NOTES. */
static const struct {
    const char *name;
    double k[5];
} law[] = {{"I", {1, 0, 0, 0, 0}}, {"PI", {0.8, -0.31, 0, 0, 0}}, {"PID", {0.58, -0.21, 0.1, 0, 0}},
           {NULL, {0.635, -0.268, 0, 0, 0}},
           {NULL, {1.93, -0.95, 0, 1, 0}},
           {NULL, {0.5, 0.5, 0, -0.5, 0}},
           {NULL, {1.25, 0.5, -0.75, 0.25, 0.75}},
           {NULL, {0.25, 0.25, 0, -0.25, 0}},
           {NULL, {0.125, 0.25, 0.125, -0.375, -0.125}}};
enum { LAWS = sizeof law / sizeof *law };

static rk_control control_by(size_t l, int order)
{
    rk_control C;
    CHECK_INT(rk_control_order(&C, law[l].name ? law[l].name : "I", order), RK_OK);
    if (!law[l].name) memcpy(C.k, law[l].k, sizeof C.k);
    return C;
}

static double norm_of(ptrdiff_t n, const double *v, const double *y, double rtol, double atol)
{
    double sum[2] = {0};
    CHECK_INT(rk_norm(rtol, atol, NULL, n, v, y, NULL, sum), RK_OK);
    return rk_rms(sum);
}

/* Against a plain loop, all lengths to 200, both tolerances, with and without sizes and second ends; in parts as ranks have
   them, in any order; for errors from 1e-140 to 1e140. */
TEST(test_the_norm_is_the_root_of_the_mean_square)
{
    enum { N = 200 };
    static double v[N], y0[N], y1[N], size[N];
    int n, i, way, e;
    for (i = 0; i < N; i++) {
        v[i] = sin(i + 1.), y0[i] = cos(3. * i), y1[i] = 2 * cos(5. * i), size[i] = i % 2 ? 1 + i % 3 : -2;
    }
    for (e = -140; e <= 140; e += 70)
        for (n = 0; n <= N; n += n < 40 ? 1 : 23)
            for (way = 0; way < 4; way++) {
                const double *sizes = way & 1 ? size : NULL, *end = way & 2 ? y1 : NULL, scale = pow(10, e);
                double sum[3] = {0, 0, 7}, parts[2] = {0, 0}, expected = 0, w[N];
                for (i = 0; i < n; i++) {
                    const double unit = 0.5 * (way & 1 ? fabs(size[i]) : 1) + 0.25 * fmax(fabs(y0[i]), way & 2 ? fabs(y1[i]) : 0);
                    expected += v[i] / unit * (v[i] / unit);
                    w[i] = scale * v[i];
                }
                expected = n ? sqrt(expected / n) : 0;
                CHECK_INT(rk_norm(0.25, 0.5, sizes, n, w, y0, end, sum), RK_OK);
                CHECK_NEAR(rk_rms(sum) / scale, expected, 1e-14 * (1 + expected));
                CHECK(sum[1] == n && sum[2] == 7);
                i = n / 3;
                CHECK_INT(rk_norm(0.25, 0.5, sizes ? size + i : NULL, n - i, w + i, y0 + i, end ? y1 + i : NULL, parts), RK_OK);
                CHECK_INT(rk_norm(0.25, 0.5, sizes, i, w, y0, end, parts), RK_OK);
                CHECK_NEAR(rk_rms(parts), rk_rms(sum), 1e-14 * rk_rms(sum));
            }
}

/* NaN and Inf in any input, wherever it stands, are no good step; 0/0 counts 0; what is beyond the range is infinite. */
TEST(test_a_norm_of_what_is_not_finite)
{
    static const struct {
        double sum[2], root;
    } row[] = {{{4, 1}, 2}, {{4, 4}, 1}, {{0, 5}, 0}, {{0, 0}, 0}, {{1e300, 4}, 5e149}, {{1e-300, 4}, 5e-151}};
    const double bad[] = {nan(""), HUGE_VAL, -HUGE_VAL}, y[2] = {0, 0}, large[] = {0, -1e300};
    double in[4][70], sum[2];
    size_t r;
    int n, i, j, k;
    for (r = 0; r < sizeof row / sizeof *row; r++) CHECK_NEAR(rk_rms(row[r].sum), row[r].root, 1e-15 * row[r].root);
    for (i = 0; i < 4; i++)
        for (j = 0; j < 70; j++) in[i][j] = 1;
    for (n = 1; n <= 70; n += n < 20 ? 1 : 10)
        for (i = 0; i < 4; i++) /* v, y0, y1, size */
            for (j = 0; j < n; j++)
                for (k = 0; k < 3; k++) {
                    in[i][j] = bad[k], sum[0] = sum[1] = 0;
                    CHECK_INT(rk_norm(1e-3, 0, i == 3 ? in[3] : NULL, n, in[0], in[1], in[2], sum), RK_OK);
                    CHECK(!(rk_rms(sum) <= DBL_MAX) && !is_nan(rk_rms(sum)));
                    in[i][j] = 1;
                }
    for (i = 0; i < 2; i++)
        for (k = 0; k < 2; k++) {
            sum[0] = sum[1] = 1, sum[i] = bad[k];
            CHECK(!(rk_rms(sum) <= DBL_MAX) && !is_nan(rk_rms(sum)));
        }
    CHECK(norm_of(2, y, y, 0, 0) == 0); /* tolerance 0, y = 0, error 0 */
    CHECK(!is_finite(norm_of(2, large, y, 0, 0)) && !is_finite(norm_of(2, large, y, 0, 1e-300)) && !is_finite(norm_of(2, large, y, 0, 1)));
    CHECK(norm_of(0, NULL, NULL, 1e-3, 1e-6) == 0 && is_nan(rk_rms(NULL)));
    sum[0] = sum[1] = 0;
    ALL(RK_ENAN, rk_norm(bad[0], 1e-6, NULL, 2, y, y, NULL, sum), rk_norm(1, bad[1], NULL, 2, y, y, NULL, sum));
    ALL(RK_EARG, rk_norm(-1, 1e-6, NULL, 2, y, y, NULL, sum), rk_norm(1, -1, NULL, 2, y, y, NULL, sum),
        rk_norm(1, 1, NULL, -1, y, y, NULL, sum));
    ALL(RK_ENULL, rk_norm(1e-3, 1e-6, NULL, 2, NULL, y, NULL, sum), rk_norm(1e-3, 1e-6, NULL, 2, y, NULL, y, sum),
        rk_norm(1e-3, 1e-6, NULL, 2, y, y, NULL, NULL));
    CHECK(sum[0] == 0 && sum[1] == 0);
    for (n = 1; n <= 40; n += n < 20 ? 1 : 5) { /* a NaN among the weights of a sum is no zero, with -ffast-math neither */
        double w[3] = {1, 0, 1}, k3[3 * 70], out[70];
        for (i = 0; i < 3 * 70; i++) k3[i] = 1;
        CHECK_INT(rk_combine(1, 3, w, n, in[0], k3, 70, out), RK_OK);
        CHECK_WITH(RK_NONFINITE, rk_combine(1, 3, w, n, in[0], k3, 70, out), w[1] = bad[0]);
    }
}

/* What the control makes of one error: status, with the time and size in place. */
static int control(rk_control *C, double error, double t, double *h)
{
    return rk_control_step(C, error, &t, h);
}

/* Extreme: error 0, Inf, NaN, 1e300 */
TEST(test_step_control_at_the_extremes)
{
    const rk_table *T = rk_find("dp5");
    const struct {
        double error, h; /* of the first step, of others; a solve that failed; the fourth failure in a row; no growth after it */
        int status;
    } row[] = {{0, 1e4, RK_OK}, {0, 10, RK_OK}, {nan(""), 0.1, RK_REJECT}, {HUGE_VAL, 0.1, RK_REJECT}, {1e300, 0.1, RK_REJECT},
               {1.01, 0.3, RK_REJECT}, {1e-3, 1, RK_OK}};
    rk_control C, saved;
    double h = 1, t = 0, zero = 0, bad = nan("");
    int i;
    CHECK_INT(rk_control_make(&C, "nobody's", T), RK_ENAME);
    ALL(RK_ENULL, rk_control_make(NULL, "PI", T), rk_control_make(&C, NULL, T), rk_control_make(&C, "PI", NULL));
    CHECK_INT(rk_control_make(&C, "PI", rk_find("rk4")), RK_ENOPAIR);
    CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
    CHECK(C.order == 4 && is_nan(C.stop));
    for (i = 0; i < 7; i++) {
        CHECK_WITH(row[i].status, control(&C, row[i].error, 0, &h), h = 1);
        CHECK(h == row[i].h);
    }
    saved = C;
    ALL(RK_EARG, rk_control_step(&C, -1, &t, &h), rk_control_step(&C, 0.5, &t, &zero));
    ALL(RK_ENAN, rk_control_step(&C, 0.5, &bad, &h), rk_control_step(&C, 0.5, &t, &bad));
    ALL(RK_ENULL, rk_control_step(&C, 0.5, NULL, &h), rk_control_step(&C, 0.5, &t, NULL), rk_control_step(NULL, 0.5, &t, &h));
    CHECK(memcmp(&C, &saved, sizeof C) == 0 && h == 1 && t == 0);
    CHECK_WITH(RK_EARG, rk_control_step(&saved, 0.5, &t, &h), saved.order = -1);
    saved = C, saved.safety = 1;
    CHECK_INT(control(&saved, 1.0001, 0, &h), RK_REJECT); /* a first failure: 0.9 at most */
    CHECK(h == (double)0.9);
    h = -1;
    STEP(0.5, RK_OK, h < 0 && t == -1); /* backwards */
    h = DBL_MAX;
    CHECK_INT(control(&C, 0, 0, &h), RK_OK);
    CHECK(h == DBL_MAX);
}

/* A rejected step that can shrink no more ends the loop and changes nothing; an accepted one is never thrown away. */
TEST(test_a_step_too_small_to_move_t_ends_the_loop)
{
    const double starts[] = {1e5, -1e5, 1e-300};
    rk_control C, saved;
    double t, h;
    int i, loops;
    for (i = 0; i < 3; i++) {
        CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
        for (t = starts[i], h = fabs(t), loops = 0; loops < 10000; loops++) {
            const double t_old = t, h_old = h;
            saved = C;
            if (rk_control_step(&C, 1e9, &t, &h) < 0) {
                CHECK(t == t_old && h == h_old && memcmp(&C, &saved, sizeof C) == 0);
                break;
            }
            CHECK(fabs(h) < fabs(h_old));
        }
        CHECK(loops < 400);
        CHECK_INT(rk_control_step(&C, 1e9, &t, &h), RK_ETINY);
    }
    CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
    t = 1e9;
    h = 4e-7; /* accepted, though the control would shrink it to a third of an ulp of t */
    CHECK_WITH(RK_OK, rk_control_step(&C, 1, &t, &h), C.safety = 1e-3);
    CHECK(t > 1e9 && t + h > t);
    for (i = -1; i <= 1; i += 2) { /* the law asks for less than moves t, but the smallest size moves it */
        CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
        CHECK_WITH(RK_REJECT, rk_control_step(&C, HUGE_VAL, &t, &h), C.smallest = 1e-4, C.shrink = 1e-8, t = 1e6, h = i * 1e-3);
        CHECK(t == 1e6 && fabs(h) <= 1e-4 && fabs(h) > 1e-4 - 2e-10 && (t + h) - t == h && C.rejected == 1);
        C.smallest = 1e-12; /* nor does this one */
        h = i * 1e-3;
        STEP(HUGE_VAL, RK_ETINY, t == 1e6 && h == i * 1e-3 && C.rejected == 1);
    }
}

TEST(test_smallest_and_largest_steps)
{
    rk_control C;
    double t = 0, h = 1;
    CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
    CHECK_WITH(RK_OK, rk_control_step(&C, 1e-9, &t, &h), C.largest = 2, C.smallest = 0.25);
    CHECK(h == 2 && t == 1);
    STEP(1e9, RK_REJECT, h == 0.25 && t == 1);
    STEP(1e9, RK_ETINY, h == 0.25 && t == 1);
    h = -1;
    STEP(1e-9, RK_OK, h == -1); /* no growth after a failure */
    STEP(1e-9, RK_OK, h == -2 && t == -1);
    CHECK_INT(rk_control_step(&C, 1e9, &t, &h), RK_REJECT);
    h = -1;
    STEP(1, RK_OK, h <= 0 && h >= (double)-0.9 && h < -0.9 + 1e-15); /* but it may shrink: by `safety` */
}

/* A step that ends within the rounding of t at the stop time, ends there; one that rounding cannot add to t is too small. */
TEST(test_steps_of_a_few_roundings)
{
    rk_control C;
    int sign, off;
    CHECK_INT(rk_control_order(&C, "I", 4), RK_OK);
    C.shrink = 0.3;
    for (sign = -1; sign <= 1; sign += 2) {
        double t = sign, h = sign * DBL_EPSILON;
        CHECK_INT(rk_control_step(&C, HUGE_VAL, &t, &h), RK_ETINY); /* 1 + 0.3 epsilon is 1, 1 - 0.3 epsilon is not */
        for (off = -3; off <= 3; off++) {
            t = 0, h = sign * (1 + off * DBL_EPSILON), C.stop = sign;
            STEP(1, RK_OK, t == sign);
        }
    }
}

/* A largest step below the spacing of t cannot hold: each accepted step moves t all the same, a rejected one ends the loop. */
TEST(test_a_largest_step_that_does_not_move_t)
{
    rk_control C;
    int sign, i;
    for (sign = -1; sign <= 1; sign += 2) {
        double t = 1, h = sign * 1e-3, last;
        CHECK_INT(rk_control_order(&C, "PI", 4), RK_OK);
        C.largest = 1e-17;
        for (i = 0; i < 5; i++) {
            last = t;
            STEP(0.5, RK_OK, sign * (t - last) > 0 && sign * h > 0);
        }
        CHECK(fabs(h) < 1e-15);
        last = t;
        STEP(2, RK_ETINY, t == last);
    }
}

/* A stop time that is not ahead is ignored, however short the step is. */
TEST(test_a_stop_time_at_hand_or_behind)
{
    const double stops[] = {1, 1 - DBL_EPSILON, 1 + DBL_EPSILON};
    rk_control C;
    int i, j, sign;
    for (sign = -1; sign <= 1; sign += 2)
        for (j = 0; j < 3; j++) {
            double t = 1, h = sign * 4 * DBL_EPSILON;
            CHECK_INT(rk_control_order(&C, "PI", 4), RK_OK);
            C.grow = C.first = 1, C.stop = stops[j];
            for (i = 0; i < 5; i++) {
                const double last = t;
                STEP(0.5, RK_OK, sign * (t - last) > 0);
            }
        }
}

/* The stop time is reached to the bit from either side, and the last two steps are alike. */
TEST(test_the_stop_time_is_reached_to_the_bit)
{
    const double stops[] = {1, 0.1, 1e6, -3, 1e-12, 123.456, 1e-170};
    rk_control C;
    size_t i;
    for (i = 0; i < sizeof stops / sizeof *stops; i++) {
        const double start = i % 2 ? 0.3 : 0, span = stops[i] - start;
        double t = start, h = span / 37, last = 0, before = 0;
        int steps = 0;
        CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
        C.stop = stops[i];
        while (t != C.stop && steps < 1000) {
            before = last, last = h;
            STEP(0.3 + 0.2 * sin(steps), RK_OK, span > 0 ? t <= C.stop : t >= C.stop);
            steps++;
        }
        CHECK(t == stops[i] && steps > 2 && fabs(last) > 0.4 * fabs(before));
    }
}

/* No step goes beyond the stop time, not by a bit: f need not exist there.  t0 + (stop - t0) rounds to more than stop in 910 of these
   cases. */
TEST(test_no_step_goes_beyond_the_stop_time)
{
    int a, b, sign, beyond = 0;
    for (a = 1; a < 100; a++)
        for (b = a + 1; b <= 200; b++)
            for (sign = -1; sign <= 1; sign += 2) {
                const double stop = sign * (b / 100.);
                double t = sign * (a / 100.), h = sign * 100;
                rk_control C;
                volatile double left = stop - t, end = t + left;
                beyond += sign * end > sign * stop;
                CHECK_INT(rk_control_order(&C, "PI", 4), RK_OK);
                CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK);
                end = t + h;
                CHECK(sign * end <= sign * stop);
                STEP(0.5, RK_OK, t == stop);
            }
    CHECK(beyond > 100);
}

/* A step that the stop time has cut to a thousandth is no history: with an error of (h/0.1)^4 every law goes on near the size that it
   had found, 0.075 to 0.09, also where it is the very first step that was cut, or where cuts go on while the size grows.  A cut to 0.7
   is a step like others. */
TEST(test_a_step_cut_short_is_no_history)
{
    size_t k;
    for (k = 0; k < LAWS; k++) {
        rk_control C = control_by(k, 3);
        double t = 0, h = 0.05, size;
        int i;
        for (i = 0; i < 300; i++) rk_control_step(&C, pow(h / 0.1, 4), &t, &h);
        size = h;
        CHECK_INT(rk_control_stop(&C, t + 1e-4, t, &h), RK_OK);
        CHECK_NEAR(h, 1e-4, 1e-12);
        for (i = 0; i < 5; i++) {
            STEP(pow(h / 0.1, 4), RK_OK, h > 0.9 * size && h < 1.25 * size);
        }
        size = h;
        CHECK_INT(rk_control_stop(&C, t + 0.7 * size, t, &h), RK_OK);
        CHECK_INT(rk_control_step(&C, 0.5, &t, &h), RK_OK);
        CHECK_NEAR(C.h[0], 0.7 * size, 1e-3 * size);
        CHECK_INT(rk_control_stop(&C, t + 0.4 * h, t, &h), RK_OK);
        STEP(0.5, RK_OK, C.h[0] == 0 && C.h[1] == 0);
        C = control_by(k, 3); /* the first step */
        t = 0, h = 0.09;
        CHECK_INT(rk_control_stop(&C, 1e-3, t, &h), RK_OK);
        for (i = 0; i < 4; i++) {
            STEP(pow(h / 0.1, 4), RK_OK, h > 0.045 && h < 0.18);
        }
        C = control_by(k, 3); /* every step cut to a quarter, ever longer ones; then no more */
        for (t = 0, h = 1e-3, i = 0; i < 20; i++) rk_control_step(&C, pow(h / 1e-3, 4) / 2, &t, &h);
        for (i = 0; i < 11; i++) {
            const double D = 1e-3 * pow(1.5, i); /* up to 0.058 */
            h = 4 * D;
            CHECK_INT(rk_control_stop(&C, t + D, t, &h), RK_OK);
            CHECK_INT(rk_control_step(&C, pow(h / 0.1, 4), &t, &h), RK_OK);
        }
        C.stop = -1; /* behind */
        for (h = 0.09, i = 0; i < 5; i++) {
            STEP(pow(h / 0.1, 4), RK_OK, h > 0.045 && h < 0.18);
        }
    }
}

/* Two numbers of a coupling that its first order does not read, but every step does. */
TEST(test_a_coupling_of_finite_numbers)
{
    double c[] = {0, 0.5, 1}, W[18] = {0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 0}, G[9] = {0}, defect;
    double *const number[] = {W, G, c + 1, W + 17};
    rk_coupling C = {"mine", RK_FROM_START, 3, 1, 0, 2, NULL, NULL, NULL, NULL};
    size_t k;
    CHECK_WITH(RK_OK, rk_check_coupling(&C, &defect), C.c = c, C.W = W, C.G = G);
    for (k = 0; k < 4; k++) {
        const double keep = *number[k];
        *number[k] = nan("");
        CHECK_INT(rk_check_coupling(&C, &defect), RK_ETABLE);
        *number[k] = keep;
    }
    CHECK_INT(rk_check_coupling(&C, &defect), RK_OK);
    C.order = 2; /* whose conditions overflow */
    CHECK_WITH(RK_ETABLE, rk_check_coupling(&C, &defect), W[0] = 1e308, W[3] = W[4] = 1e308);
    W[0] = W[3] = W[4] = 0.5, C.order = 1, C.order_hat = 2, W[6] = W[7] = 1e308;
    CHECK_INT(rk_check_coupling(&C, &defect), RK_ETABLE);
}

/* c^2 overflows in the condition of the stiff order: that is no proof, with -ffast-math either; the claim is false. */
TEST(test_a_stiff_order_that_overflows_is_not_proven)
{
    static const double A[] = {1, 0, 0, 1}, b[] = {1, 0}, d[] = {1, 0, 0, 0};
    static const double large[] = {2, 1e200};
    size_t k;
    for (k = 0; k < 2; k++) {
        const double c[] = {1, large[k]};
        double defect = -1;
        rk_table T = plain_table("mine", 2, 1, A, b, c);
        T.powers = 2, T.dense_order = 1, T.d = d, T.dense_stiff = 3; /* but theta^2 has no weights */
        CHECK_INT(rk_check(&T, &defect), RK_EDENSE);
        CHECK(defect > 0.4);
    }
}

/* Every coefficient of every controller: h'/h from a history of two errors and two ratios, by Soderlind's formula. */
TEST(test_every_coefficient_of_every_controller)
{
    size_t i;
    for (i = 0; i < LAWS; i++) {
        const double *k = law[i].k, e[] = {0.5, 0.25, 0.75, 0.125}, h[] = {1, 1.25, 0.9, 1.1};
        rk_control C = control_by(i, 2); /* powers of 1/3 */
        int n;
        for (n = 0; n < 4; n++) {
            double next = h[n], wanted = 0.9 * pow(e[n], -1. / 3);
            if (n > 0) {
                const double e2 = n > 1 ? e[n - 2] : e[n - 1], r2 = n > 1 ? h[n - 1] / h[n - 2] : 1;
                wanted = 0.9 * pow(e[n], -k[0] / 3) * pow(e[n - 1], -k[1] / 3) * pow(e2, -k[2] / 3) *
                         pow(h[n] / h[n - 1], k[3]) * pow(r2, k[4]);
            }
            CHECK_INT(control(&C, e[n], 0, &next), RK_OK);
            CHECK_NEAR(next / h[n], wanted, 1e-13);
        }
    }
}

/* y' = -y with e = C h^(p+1): every controller settles where the error is safety^(p+1) */
TEST(test_every_controller_settles)
{
    rk_control C;
    size_t i;
    int j;
    for (i = 0; i < LAWS; i++) {
        double h = 1e-3;
        C = control_by(i, 4);
        for (j = 0; j < 300; j++) CHECK(control(&C, 7 * pow(h, 5), 0, &h) >= 0);
        if (!(7 * pow(h, 5) < 1 && 7 * pow(h, 5) > 0.05)) fail_msg("law %d: h %g error %g", (int)i, h, 7 * pow(h, 5));
    }
}

/* dop853's estimate with its companion: of order 7, as SciPy's and Hairer's; alone it is of order 5. */
TEST(test_the_companion_estimate_of_dop853)
{
    const rk_table *T = rk_find("dop853");
    double e[2], c[2], both[2];
    int pass, l;
    for (pass = 0; pass < 2; pass++)
        for (e[pass] = c[pass] = 0, l = 0; l < 20; l++) { /* the mean of several steps: one alone may be a zero */
            double y[2], err[2], other[2], k[32], h = 0.2 / (1 + pass);
            exact(0.1 * l, y);
            stages(T, 0.1 * l, h, y, k);
            CHECK_INT(rk_update(T, h, 2, y, k, 2, NULL, err), RK_OK);
            CHECK_INT(rk_combine(h, T->stages, T->e3, 2, NULL, k, 2, other), RK_OK);
            e[pass] += hypot(err[0], err[1]);
            c[pass] += hypot(other[0], other[1]);
            both[pass] = rk_combined_error(e[pass], c[pass]);
        }
    CHECK_NEAR(log2(e[0] / e[1]), 6, 0.5);
    CHECK_NEAR(log2(c[0] / c[1]), 4, 0.5);
    CHECK_NEAR(log2(both[0] / both[1]), 8, 1);
    CHECK_NEAR(rk_combined_error(3, 40), 9 / sqrt(9 + 16.), 1e-15);
    CHECK(rk_combined_error(DBL_MAX, DBL_MAX) > 0.99 * DBL_MAX && rk_combined_error(DBL_MAX, DBL_MAX) <= DBL_MAX);
    CHECK(rk_combined_error(1e-300, 1e10) == 0 && rk_combined_error(1e-320, 0) == 1e-320);
    CHECK(rk_combined_error(0, 0) == 0 && rk_combined_error(0, 1) == 0 && is_nan(rk_combined_error(-1, 0)) && is_nan(rk_combined_error(1, -1)));
    CHECK(!(rk_combined_error(HUGE_VAL, 1) <= DBL_MAX) && !is_nan(rk_combined_error(HUGE_VAL, 1)));
    CHECK(!(rk_combined_error(1, nan("")) <= DBL_MAX) && !is_nan(rk_combined_error(1, nan(""))));
    CHECK_INT(rk_error_order(T), 7);
    CHECK_INT(rk_error_order(rk_find("dp5")), 4);
    CHECK_INT(rk_error_order(rk_find("rk4")), RK_ENOPAIR);
    CHECK_INT(rk_error_order(NULL), RK_ENULL);
}

/* A first step from rest: y = 0, y' = cos t or 1 - y, at times up to 1e5 and tolerances down to 1e-14; equilibrium. */
TEST(test_the_first_step_from_rest)
{
    const double starts[] = {0, 1000, 1e5}, tolerances[] = {1e-9, 1e-12, 1e-14}, length = 10;
    int i, j, which;
    for (i = 0; i < 3; i++)
        for (j = 0; j < 3; j++)
            for (which = 0; which < 2; which++) {
                const double t = starts[i], f = which ? 1 : cos(t), d1 = fabs(f) / tolerances[j];
                const double trial = rk_first_step(4, length, 0, d1, -1);
                const double f1 = which ? 1 - trial : cos(t + trial);
                const double h = rk_first_step(4, length, 0, d1, fabs(f1 - f) / trial / tolerances[j]);
                CHECK(trial == (double)(length / 1e4) && t + h > t && h > 1e-4 && h < 1);
            }
    CHECK(rk_first_step(4, 8, 0, 0, -1) == (double)(8 / 1e4) && rk_first_step(4, 8, 1e6, 0, 0) == (double)(8 / 1e2)); /* equilibrium */
    CHECK_NEAR(rk_first_step(4, 1e-9, 1e6, 1, -1), 1e-11, 1e-25); /* not above a hundredth of the length */
    CHECK_NEAR(rk_first_step(4, 10, 1, 2, -1), 0.005, 1e-17);
    CHECK_NEAR(rk_first_step(0, 10, 1, 1, 2), 0.005, 1e-17); /* an error that falls with h itself */
    CHECK_NEAR(rk_first_step(4, 1e9, 1, 1e-2, 1e-2), 1, 1e-12);
    CHECK_NEAR(rk_first_step(4, 1e9, 1, 2, 10), pow(1e-3, 0.2), 1e-12);
    CHECK(is_nan(rk_first_step(4, 0, 1, 1, -1)) && is_nan(rk_first_step(-1, 1, 1, 1, -1)));
    CHECK(is_nan(rk_first_step(4, nan(""), 1, 1, -1)) && is_nan(rk_first_step(4, 1, -1, 1, -1)));
}

/* All error weights of a table go with it, in the memory given: dop853 has a second estimate, dp5 has not. */
TEST(test_extended_tables_keep_their_error_weights)
{
    static double mem[4000];
    const double companion[] = {1, -2, 0.5, 0.5, 0.25, -0.5, 0.25};
    const rk_table *T = rk_find("dop853");
    rk_table X, own;
    int i;
    CHECK(rk_extend(&X, T, NULL, 3, 0, mem, sizeof mem) >= 0 && X.e3 >= mem && X.e3 + T->stages <= mem + 4000);
    CHECK(X.e >= mem && X.e + T->stages <= mem + 4000);
    for (i = 0; i < T->stages; i++) CHECK(X.e3[i] == T->e3[i] && X.e[i] == T->e[i]);
    CHECK(rk_extend(&X, rk_find("dp5"), NULL, 3, 0, mem, sizeof mem) >= 0 && X.e3 == NULL);
    own = *rk_find("dp5");
    own.e3 = companion;
    CHECK(rk_extend(&X, &own, NULL, 4, 0, mem, sizeof mem) >= 0 && memcmp(X.e3, companion, sizeof companion) == 0);
}

/* Nine more stages for an order that none can give, for b has order 4: a slope at ynew, the others at as many times inside. */
TEST(test_added_stages_lie_at_times_of_their_own)
{
    static double mem[4000];
    const rk_table *T = rk_find("rk4");
    int i, j;
    rk_table X;
    CHECK_INT(rk_extend(&X, T, NULL, 5, 9, mem, sizeof mem), RK_LESS);
    CHECK(X.extra == 9 && X.dense_order == 4 && X.c[4] == 1);
    for (i = 5; i < 13; i++) CHECK(X.c[i] > 0.1 && X.c[i] < 0.9);
    for (i = 5; i < 13; i++)
        for (j = 5; j < i; j++) CHECK(fabs(X.c[i] - X.c[j]) > 0.01);
}

/* Where c is not the row sums of A, time is one more argument of f: the dense output holds for it, too.
   So it does where the time of one half is apart: b_2 = theta^2/2 and b_1/4 + 3 b_2/4 = theta^2/2 contradict b_1 + b_2 = theta. */
TEST(test_extended_tables_whose_time_is_apart)
{
    static double A[4] = {0, 0, 1, 0}, b[2] = {1. / 2, 1. / 2}, c[2] = {1. / 4, 3. / 4};
    double mem[1000];
    rk_table T = plain_table("apart", 2, 2, A, b, c), heun = *rk_find("heun"), X;
    int more;
    CHECK_INT(rk_check(&T, NULL), RK_ROWSUM);
    for (more = 0; more <= 3; more += 3) {
        CHECK_INT(rk_extend(&X, &T, NULL, 2, more, mem, sizeof mem), more ? RK_OK : RK_LESS);
        CHECK_INT(X.dense_order, more ? 2 : 1);
        CHECK_INT(rk_check(&X, NULL), RK_ROWSUM);
    }
    T.bhat = heun.bhat, T.order_hat = heun.order_hat;
    CHECK_INT(rk_extend(&X, &heun, &heun, 2, 0, mem, sizeof mem), RK_OK);
    CHECK_INT(rk_extend(&X, &heun, &T, 2, 0, mem, sizeof mem), RK_LESS);
    CHECK_INT(X.dense_order, 1);
}

/* Or the times of both are the row sums of one A and not of the other: then the root's colour counts, for the halves have
   leaves of time of their own.  b_1 = theta - 3/4 theta^2, b_2 = b_3 = b_4 = theta^2/4 meets both. */
TEST(test_halves_that_differ_in_their_times)
{
    static const double A[16] = {0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 0}, b[4] = {0.25, 0.25, 0.25, 0.25};
    static const double rows[4] = {0, 0.5, 0.5, 1}, apart[4] = {0, 0.25, 0.75, 1}, d[8] = {1, -0.75, 0, 0.25, 0, 0.25, 0, 0.25};
    const rk_table T = plain_table("sums of rows", 4, 2, A, b, rows), O = plain_table("apart", 4, 2, A, b, apart);
    const rk_table T_dense = table_with_dense(T, 2, d), O_dense = table_with_dense(O, 2, d);
    double mem[1000];
    rk_table X, other;
    int swapped;
    CHECK_INT(rk_check_imex(&T_dense, &O_dense, NULL), RK_ROWSUM); /* so there is one */
    for (swapped = 0; swapped <= 1; swapped++) {
        CHECK_INT(rk_extend(&X, swapped ? &O : &T, swapped ? &T : &O, 2, 0, mem, sizeof mem), RK_OK);
        CHECK_INT(X.dense_order, 2);
        other = table_with_dense(swapped ? T : O, X.powers, X.d);
        CHECK_INT(rk_check_imex(&X, &other, NULL), RK_ROWSUM);
    }
}

/* Memory that shares a number with the table, though no array begins in it. */
TEST(test_memory_that_shares_numbers_with_the_table)
{
    double mem[1000] = {0};
    const rk_table *rk4 = rk_find("rk4");
    rk_table T = *rk4, X;
    rk_coupling C;
    memcpy(mem, rk4->A, 16 * sizeof *mem);
    CHECK_WITH(RK_EOVERLAP, rk_extend(&X, &T, NULL, 0, 0, mem + 1, sizeof mem - sizeof *mem), T.A = mem);
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem + 15, sizeof mem - 15 * sizeof *mem), RK_EOVERLAP);
    CHECK_INT(rk_mis(&C, &T, RK_FROM_LAST, mem, sizeof mem), RK_EOVERLAP);
    CHECK_INT(rk_mis(&C, &T, RK_FROM_LAST, mem + 15, sizeof mem - 15 * sizeof *mem), RK_EOVERLAP);
    CHECK(memcmp(mem, rk4->A, 16 * sizeof *mem) == 0);
    CHECK(rk_extend(&X, &T, NULL, 0, 0, mem + 16, sizeof mem - 16 * sizeof *mem) >= 0);
    CHECK_INT(rk_mis(&C, &T, RK_FROM_LAST, mem + 16, sizeof mem - 16 * sizeof *mem), RK_OK);
    memcpy(mem + 500, rk4->A, 16 * sizeof *mem); /* behind the memory that is given */
    T.A = mem + 500;
    CHECK(rk_extend(&X, &T, NULL, 0, 0, mem, 500 * sizeof *mem) >= 0);
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, 501 * sizeof *mem), RK_EOVERLAP);
    T = *rk4;
    T.d = mem; /* a dense output of no powers has no numbers */
    T.powers = T.dense_order = 0;
    CHECK(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem) >= 0);
    T.powers = -1; /* nor has one of fewer, which is refused as it is by rk_check */
    ALL(RK_ETABLE, rk_extend(&X, &T, NULL, 0, 0, mem + 28, sizeof mem - 28 * sizeof *mem),
        rk_extend(&X, rk4, &T, 3, 0, mem + 28, sizeof mem - 28 * sizeof *mem), rk_check(&T, NULL));
}

/* What is claimed without numbers behind it, and coefficients that cannot be proven. */
TEST(test_claims_without_numbers)
{
    const double small[4] = {0, 0, 1, 0};
    double A[4] = {0, 0, 1e9, 0}, b[2] = {1, 0}, c[2] = {0, 1e9}, mem[1000];
    rk_table T = *rk_find("rk4"), X;
    CHECK_WITH(RK_OK, rk_check(&T, NULL), T.d = NULL, T.powers = T.dense_order = T.dense_stiff = 0);
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.dense_order = 4);
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.dense_order = 0, T.dense_stiff = 4);
    T = *rk_find("dop853");
    CHECK_INT(rk_error_order(&T), 7);
    T.order_hat = 1; /* no companion of third order */
    CHECK_INT(rk_error_order(&T), 1);
    T = plain_table("large", 2, 1, A, b, c);
    CHECK_INT(rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem), RK_ETABLE);
    X = T;
    CHECK_WITH(RK_ETABLE, rk_extend(&X, &T, &X, 1, 0, mem, sizeof mem), T.A = small); /* the other half has the large ones */
    CHECK_WITH(RK_OK, rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem), T.A = A, A[2] = c[1] = 1);
    b[0] = -(b[1] = 1e6);
    b[0] += 1;
    CHECK_INT(rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem), RK_ETABLE);
}

/* A host that turns round, or takes a size of its own, while a cut is pending. */
TEST(test_a_size_of_the_host_after_a_cut)
{
    rk_control C;
    double h = 1, t = 0;
    CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
    STOP(1.5, t, h == 0.75);
    STOP(1.25, t, h == 0.625 && C.wanted == 1); /* it is what was handed out: the size before the cut counts */
    h = 0.125;
    STOP(1.25, t, h == 0.125 && C.wanted == 0);
    h = -0.1;
    STOP(-1, t, h == (double)-0.1);
    h = 1e-170; /* the product of two such sizes is 0 */
    STOP(1.5e-170, t, h == (double)0.75e-170);
    STOP(1, t, h == (double)1e-170);
}

/* Conditions whose terms are Inf, and Inf - Inf: no defect of 0. */
TEST(test_the_defect_of_a_table_that_overflows_is_infinite)
{
    const double A[9] = {0, 0, 0, 1e200, 0, 0, 1e200, 1e200, 0}, c[3] = {0, 1e200, 2e200};
    const double sums[3][3] = {{0, 1, 1}, {0, 2, -1}, {1, 0, 0}}; /* also of stages that nobody uses */
    int k, order;
    for (k = 0; k < 3; k++) {
        const rk_table T = plain_table("wild", 3, 0, A, sums[k], c);
        for (order = 3; order <= 5; order++) CHECK(!is_finite(rk_defect(&T, NULL, RK_OF_STEP, order)));
        for (order = 3; order <= 5; order++) CHECK(rk_defect(&T, NULL, RK_OF_STEP, order) > 0);
    }
}

/* ---- large times, stops, zeros: kinds of public reports -------------------------------------------------------------- */

typedef void right_hand_side(double t, const double *y, double *k, double parameter);

typedef struct outcome {
    int status, steps, rejected;
} outcome;

/* The loop of the SYNOPSIS from *t to t1 with tolerances of each component (size, atol 1) or one for all (size NULL). */
static outcome go_on(rk_control *C, const rk_table *T, right_hand_side *f, double parameter, int n, double tolerance,
                     const double *size, double *t, double t1, double *h, double *y)
{
    double k[16 * 4], z[4], ynew[4], err[4], e, sum[2];
    outcome r = {0, 0, 0};
    int i;
    CHECK_INT(rk_control_stop(C, t1, *t, h), RK_OK);
    f(*t, y, k, parameter);
    while (*t < t1 && r.status >= 0 && r.steps + r.rejected < 1000000) {
        for (i = 1; i < T->stages; i++) {
            CHECK(rk_stage(T, i, *h, n, y, k, n, z) >= 0);
            f(*t + T->c[i] * *h, z, k + i * n, parameter);
        }
        CHECK(rk_update(T, *h, n, y, k, n, ynew, err) >= 0);
        CHECK_WITH(RK_OK, rk_norm(tolerance, size ? 1 : tolerance, size, n, err, y, ynew, sum), sum[0] = sum[1] = 0);
        e = rk_rms(sum);
        if (T->e3) {
            rk_combine(*h, T->stages, T->e3, n, NULL, k, n, err);
            sum[0] = sum[1] = 0;
            rk_norm(tolerance, size ? 1 : tolerance, size, n, err, y, ynew, sum);
            e = rk_combined_error(e, rk_rms(sum));
        }
        r.status = rk_control_step(C, e, t, h);
        if (r.status == RK_REJECT) r.rejected++;
        if (r.status != RK_OK) continue;
        r.steps++;
        memcpy(y, ynew, (size_t)n * sizeof *y);
        f(*t, y, k, parameter);
    }
    return r;
}

static outcome integrate_adaptively(const char *name, right_hand_side *f, double parameter, int n, double tolerance,
                                    const double *size, double t, double t1, double h, double *y)
{
    outcome r;
    rk_control C;
    CHECK_INT(rk_control_make(&C, "PI", rk_find(name)), RK_OK);
    r = go_on(&C, rk_find(name), f, parameter, n, tolerance, size, &t, t1, &h, y);
    CHECK(r.status < 0 || t == t1);
    return r;
}

static void van_der_pol(double t, const double *y, double *k, double mu)
{
    (void)t;
    k[0] = y[1], k[1] = mu * (1 - y[0] * y[0]) * y[1] - y[0];
}

/* An adaptive run to a tolerance: van der Pol, mu = 5, y(20) to 28 digits by Taylor series of 40 digits. */
TEST(test_an_adaptive_run_meets_its_tolerance)
{
    const double target[] = {-1.60129687954285390882168437713, 0.198326676338662084549513629203};
    double tolerance;
    for (tolerance = 1e-5; tolerance > 1e-10; tolerance *= 1e-2) {
        double y[2] = {2, 0};
        const outcome r = integrate_adaptively("dp5", van_der_pol, 5, 2, tolerance, NULL, 0, 20, 1e-3, y);
        CHECK(r.status == RK_OK && r.steps + r.rejected < 20000);
        CHECK_NEAR(y[0], target[0], 300 * tolerance);
        CHECK_NEAR(y[1], target[1], 300 * tolerance);
    }
}

static void swelling(double t, const double *y, double *k, double omega)
{
    k[0] = cos(omega * t) * y[0];
}

/* y' = cos t y by dp5: the same number of steps with and without output times, but for one cut step at each. */
TEST(test_intervals_cost_one_step_each)
{
    const double ends[] = {30, 1.7};
    int count[2] = {0, 0}, run;
    for (run = 0; run < 2; run++) {
        double t = 0, h = 0.1, y = 1, end;
        rk_control C;
        CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
        for (end = ends[run]; end < 30.001; end += ends[run]) {
            const outcome r = go_on(&C, rk_find("dp5"), swelling, 1, 1, 1e-5, NULL, &t, end, &h, &y);
            count[run] += r.steps + r.rejected;
            CHECK(t == end);
        }
        CHECK_NEAR(y, exp(sin(t)), 2e-4);
    }
    CHECK(count[1] <= count[0] + 18);
}

/* y' = 1 in steps of `largest`: y is t - t0, whatever t0 is; with a stop time and without one, in both directions. */
TEST(test_state_and_time_move_together)
{
    static const double row[][3] = {{1.6e9, 1, 1e-4}, {1e6, 1e-4, 1e-8}, {86400, 1e-3, 1e-6}, {1.6e9, 1e-3, 3e-6}, {-3.5e12, 50, 0.01}, {0, 1, 1e-3}};
    size_t i;
    int way;
    for (i = 0; i < sizeof row / sizeof *row; i++)
        for (way = 0; way < 4; way++) {
            const double sign = way % 2 ? -1 : 1, t0 = row[i][0], t1 = t0 + sign * row[i][1], most = row[i][2];
            double t = t0, h = sign * most, y = 0, last;
            int steps = 0;
            rk_control C;
            CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
            CHECK_WITH(RK_OK, rk_control_stop(&C, way < 2 ? t1 : nan(""), t, &h), C.largest = most);
            while (sign * (t1 - t) > 0 && steps++ < 20000) {
                volatile double end = t + h;
                if (!(fabs(h) <= most * 1.01 && (fabs(h) <= most || end == t1) && end - t == h))
                    fail_msg("from %g, way %d, step %d: h %.17g, end - t %.17g", t0, way, steps, h, end - t);
                y += h;
                last = t;
                STEP(steps % 7 ? 1e-9 : 0.9, RK_OK, sign * (t - last) > 0 && (way > 1 || sign * t <= sign * t1));
            }
            CHECK_NEAR(y / (t - t0), 1, 1e-12);
            CHECK(way > 1 || t == t1);
        }
}

static void turning(double t, const double *y, double *k, double omega)
{
    (void)t;
    k[0] = omega * y[1], k[1] = -omega * y[0];
}

/* An oscillator: from a time of day or of an epoch no worse than from 0.  omega, span, t0, tolerance, error from 0 */
TEST(test_an_oscillator_at_large_times)
{
    static const struct {
        const char *name;
        double omega, span, t0, most;
    } row[] = {{"dp5", 1e6, 1e-3, 86400, 6e-7}, {"bs3", 1e6, 1e-3, 86400, 5e-6}, {"dop853", 1e6, 1e-3, 86400, 3e-7},
               {"dp5", 1e3, 1, 1.6e9, 6e-7},    {"bs3", 1e3, 1, 1.6e9, 5e-6}};
    size_t i;
    int late;
    for (i = 0; i < sizeof row / sizeof *row; i++) {
        double error[2];
        for (late = 0; late < 2; late++) {
            volatile double t0 = late ? row[i].t0 : 0, t1 = t0 + row[i].span; /* rounded, with -ffast-math too */
            double y[2] = {1, 0};
            const outcome r = integrate_adaptively(row[i].name, turning, row[i].omega, 2, 1e-9, NULL, t0, t1, 1e-3 * row[i].span, y);
            CHECK_INT(r.status, RK_OK);
            error[late] = hypot(y[0] - cos(row[i].omega * (t1 - t0)), y[1] + sin(row[i].omega * (t1 - t0)));
        }
        if (!(error[0] < row[i].most && error[1] < row[i].most)) fail_msg("%s: %g from 0, %g late", row[i].name, error[0], error[1]);
    }
}

/* `largest` is dt, and a stop at every step, at every tenth, or at the end: no more steps than fit, but 1 in 200. */
TEST(test_steps_that_fit_the_stop_times_stay_whole)
{
    static const double dt[] = {0.1, 1e-2, 1e-3, 1. / 3}, start[] = {0, 5, 1000, -7};
    int d, s, per, way;
    for (d = 0; d < 4; d++)
        for (s = 0; s < 4; s++)
            for (per = 1; per <= 1000; per *= per == 10 ? 100 : 10)
                for (way = -1; way <= 1; way += 2) {
                    double t = start[s], h = way * dt[d];
                    int n = 0, j;
                    rk_control C;
                    CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
                    C.largest = dt[d];
                    for (j = per; j <= 2000; j += per) {
                        const double stop = start[s] + way * j * dt[d];
                        CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK);
                        while (t != stop && n < 5000) {
                            CHECK_INT(rk_control_step(&C, 1e-6, &t, &h), RK_OK);
                            n++;
                        }
                    }
                    if (n > 2010) fail_msg("dt %g from %g, a stop at every %d: %d steps for 2000", dt[d], start[s], per, n);
                }
}

/* Whatever is asked for, a step that is always rejected ends; so does a run with a tolerance of 0, also from t = 0. */
TEST(test_no_endless_rejections)
{
    static const double start[] = {0, 1, -1, 1e-300, 86400, 1.6e9}, size[] = {1, 1e-3, 1e-12, 1e6};
    const double zero[] = {0, 0};
    size_t i, j;
    int way, failures = 0;
    for (i = 0; i < 6; i++)
        for (j = 0; j < 4; j++)
            for (way = 0; way < 6; way++) {
                double t = start[i], h = way % 2 ? -size[j] : size[j];
                int n = 0;
                rk_control C;
                CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
                CHECK(rk_control_stop(&C, way < 4 ? nan("") : t + 10 * h, t, &h) >= 0); /* t + 10 h may be t */
                while (rk_control_step(&C, way < 2 ? 1.01 : 1e9, &t, &h) == RK_REJECT && n < 1000) n++;
                CHECK(n <= 100 && t == start[i] && n == C.rejected);
                CHECK_INT(rk_control_step(&C, 1e9, &t, &h), n == 100 ? RK_EFAILURES : RK_ETINY);
                failures += n == 100;
            }
    CHECK(failures > 0); /* from t = 0 */
    { /* a first size of the host that does not move t */
        double t = 1.6e9, h = 1e-9;
        rk_control C;
        CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
        CHECK_INT(rk_control_step(&C, 0.1, &t, &h), RK_ETINY);
        STOP(nan(""), t, rk_control_step(&C, 0.1, &t, &h) == RK_OK && t > 1.6e9);
    }
    for (way = 0; way < 2; way++) {
        double y[2] = {1, 0};
        const outcome r = integrate_adaptively("dp5", turning, 1, 2, 0, way ? zero : NULL, 0, 1, 1e-3, y);
        CHECK((r.status == RK_ETINY || r.status == RK_EFAILURES) && r.steps + r.rejected < 1000);
    }
}

static void decay_chain(double t, const double *y, double *k, double unused)
{
    (void)t;
    (void)unused;
    k[0] = -y[0], k[1] = y[0];
}

/* A component and its tolerance are 0, and it moves: rk_first_step gives a size to start with, and the run ends well. */
TEST(test_a_first_step_where_a_tolerance_is_zero)
{
    const double size[] = {1e-9, 0}, one[] = {1}, difference[] = {-1, 1};
    double y[] = {1, 0}, k[4], z[2], s0[2] = {0}, s1[2] = {0}, s2[2] = {0}, h;
    outcome r;
    decay_chain(0, y, k, 0);
    CHECK_INT(rk_norm(1e-6, 1, size, 2, y, y, NULL, s0), RK_OK);
    CHECK_INT(rk_norm(1e-6, 1, size, 2, k, y, NULL, s1), RK_OK);
    h = rk_first_step(4, 5, rk_rms(s0), rk_rms(s1), -1);
    CHECK(h > 0 && h <= 5);
    CHECK_NEAR(rk_first_step(4, 10, 1, 2, HUGE_VAL), 0.005 / 100, 1e-17); /* the trial step left the domain of f */
    rk_combine(h, 1, one, 2, y, k, 2, z);
    decay_chain(h, z, k + 2, 0);
    rk_combine(1 / h, 2, difference, 2, NULL, k, 2, z);
    CHECK_INT(rk_norm(1e-6, 1, size, 2, z, y, NULL, s2), RK_OK);
    h = rk_first_step(4, 5, rk_rms(s0), rk_rms(s1), rk_rms(s2));
    CHECK(h > 1e-8 && h <= 5);
    r = integrate_adaptively("dp5", decay_chain, 0, 2, 1e-6, size, 0, 5, h, y);
    CHECK(r.status == RK_OK && r.steps < 40);
    CHECK_NEAR(y[1], 1 - exp(-5.), 1e-5);
}

/* Vectors that rk.h never sees, here of floats: the rows of the table and of rk_weights, the sums in the host's loop. */
TEST(test_vectors_elsewhere)
{
    enum { N = 3 };
    const rk_table *T = rk_find("dp5");
    float y[N] = {1, 0.5f, 0}, k[7][N], z[N], err = 0;
    double w[7], exact_end[N], exact_inside[N];
    const double h = 0.1;
    int i, j, l;
    for (l = 0; l < N; l++) exact_end[l] = (double)y[l] * exp(-0.1 * (l + 1)), exact_inside[l] = (double)y[l] * exp(-0.04 * (l + 1));
    for (i = 0; i < T->stages; i++) { /* y' = -(l + 1) y */
        for (l = 0; l < N; l++) {
            z[l] = y[l];
            for (j = 0; j < i; j++) z[l] += (float)(h * T->A[i * T->stages + j]) * k[j][l];
            k[i][l] = (float)-(l + 1) * z[l];
        }
    }
    CHECK_INT(rk_weights(T, 0.4, 0, w), RK_OK);
    for (l = 0; l < N; l++) {
        float inside = y[l];
        for (j = 0; j < T->stages; j++) {
            inside += (float)(h * w[j]) * k[j][l];
            err += (float)(h * T->e[j]) * k[j][l];
        }
        CHECK_NEAR((double)inside, exact_inside[l], 3e-7);
        CHECK_NEAR((double)z[l], exact_end[l], 3e-7); /* FSAL: the last stage is the end */
    }
    CHECK(fabs((double)err) < 3e-6);
}

/* Of the couplings only SR32 has a stage behind the end of the step. */
TEST(test_stages_behind_the_step)
{
    const rk_coupling *C;
    for (C = rk_couplings(); C->name; C++) {
        double last = 0;
        int i;
        for (i = 0; i < C->stages; i++) last = fmax(last, rk_coupling_time(C, i));
        CHECK_INT(last > 1, strcmp(C->name, "SR32") == 0);
    }
}

/* Extreme: long integration of 1e7 steps, with and without compensated sums; 1e6 where the machine is emulated */
#ifdef FUZZ_COUNT
enum { long_run = 1000000 };
#else
enum { long_run = 10000000 / LESS / LESS };
#endif

static double round_off(int compensated)
{
    const rk_table *T = rk_find("rk4");
    const double h = 1e-4;
    double y[2] = {1, 0}, low[2] = {0, 0}, k[8], z[2], d[2];
    int s, i, l;
    for (s = 0; s < long_run; s++) {
        for (i = 0; i < 4; i++) {
            rk_stage(T, i, h, 2, y, k, 2, z);
            k[2 * i] = z[1], k[2 * i + 1] = -z[0];
        }
        if (!compensated) {
            rk_update(T, h, 2, y, k, 2, y, NULL);
            continue;
        }
        rk_combine(h, 4, T->b, 2, NULL, k, 2, d);
        for (l = 0; l < 2; l++) {
            const double v = d[l] + low[l];
            volatile double sum = y[l] + v, added = sum - y[l]; /* volatile: -ffast-math would drop the correction */
            low[l] = v - added, y[l] = sum;
        }
    }
    return hypot(y[0] - cos(long_run * h), y[1] + sin(long_run * h)); /* RK4's own error here is 1e-16 or 1e-15 */
}

TEST(test_round_off_of_a_long_integration)
{
    const double plain = round_off(0), compensated = round_off(1);
    CHECK(plain < 2e-12); /* the header: 4e-13 and 5e-14 */
    CHECK(compensated < 2e-13);
    EXTREME("1e7 steps of rk4", "round-off adds up to %.0e in an oscillator of size 1; %.0e by a compensated sum", plain, compensated);
}

/* ---- an ensemble of tables -------------------------------------------------------------------------------------------- */

/* A second tree engine, in long double: t = a o b (b the last child of the root), each tree once, phi(a o b) = phi(a) A phi(b),
   gamma(a o b) = |t| gamma(a)/|a| gamma(b). */
enum { SECOND_TREES = 40, SECOND_ORDER = 6, SECOND_STAGES = 8 };
static int second_left[SECOND_TREES], second_right[SECOND_TREES], second_size[SECOND_TREES], second_count;
static long double second_gamma[SECOND_TREES];

static void second_trees(void)
{
    int n, a, b;
    second_left[0] = second_right[0] = -1, second_size[0] = second_count = 1, second_gamma[0] = 1;
    for (n = 2; n <= SECOND_ORDER; n++)
        for (a = 0; a < second_count; a++)
            for (b = 0; b < second_count && second_size[a] < n; b++) {
                if (second_size[a] + second_size[b] != n || (a > 0 && b > second_right[a])) continue;
                CHECK(second_count < SECOND_TREES);
                second_left[second_count] = a, second_right[second_count] = b, second_size[second_count] = n;
                second_gamma[second_count] = n * second_gamma[a] / second_size[a] * second_gamma[b];
                second_count++;
            }
}

/* The largest residual up to an order: of b, or of the powers of d; leaves as row sums or as c. */
static long double second_residual(const rk_table *T, const double *b, int powers, int order, int time)
{
    static long double phi[SECOND_TREES][SECOND_STAGES];
    const int s = T->stages, ld = powers ? powers : 1;
    long double worst = 0, sum;
    int t, i, j, k;
    for (t = 0; t < second_count; t++) {
        for (i = 0; i < s; i++) {
            phi[t][i] = 1;
            if (t == 0) continue;
            for (sum = 0, j = 0; j < s; j++) sum += (long double)T->A[i * s + j] * phi[second_right[t]][j];
            if (time && second_right[t] == 0) sum = (long double)T->c[i];
            phi[t][i] = phi[second_left[t]][i] * sum;
        }
        if (second_size[t] > order) continue;
        for (k = 1; k <= ld; k++) {
            sum = powers == 0 || k == second_size[t] ? -1 / second_gamma[t] : 0;
            for (i = 0; i < s; i++) sum += (long double)b[i * ld + k - 1] * phi[t][i];
            worst = fmaxl(worst, fabsl(sum));
        }
    }
    return worst;
}

static long double second_verdict(const rk_table *T)
{
    long double worst = 0;
    int time;
    for (time = 0; time < 2; time++) {
        worst = fmaxl(worst, second_residual(T, T->b, 0, T->order, time));
        if (T->bhat) worst = fmaxl(worst, second_residual(T, T->bhat, 0, T->order_hat, time));
        if (T->powers) worst = fmaxl(worst, second_residual(T, T->d, T->powers, T->dense_order, time));
    }
    return worst;
}

static uint64_t ensemble_state;
static double ensemble_random(void) /* in [0, 1) */
{
    ensemble_state = ensemble_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(ensemble_state >> 11) * 0x1p-53;
}

typedef struct specimen {
    rk_table T;
    double A[SECOND_STAGES * SECOND_STAGES], b[SECOND_STAGES], c[SECOND_STAGES], bhat[SECOND_STAGES];
    double d[SECOND_STAGES * SECOND_STAGES];
} specimen;

static void specimen_of(specimen *x, const rk_table *T)
{
    const size_t s = (size_t)T->stages * sizeof(double);
    x->T = *T;
    memcpy(x->A, T->A, s * (size_t)T->stages);
    memcpy(x->b, T->b, s);
    memcpy(x->c, T->c, s);
    if (T->bhat) memcpy(x->bhat, T->bhat, s);
    if (T->powers) memcpy(x->d, T->d, s * (size_t)T->powers);
    x->T.A = x->A, x->T.b = x->b, x->T.c = x->c, x->T.bhat = T->bhat ? x->bhat : NULL, x->T.e = NULL;
    x->T.d = T->powers ? x->d : NULL;
}

/* Four explicit stages of order 4 with free c_2 and c_3: Kutta's family.  Near its poles the coefficients are large. */
static void specimen_kutta(specimen *x, double u, double v)
{
    double *A = x->A, *b = x->b;
    memset(x, 0, sizeof *x);
    x->T = plain_table("family", 4, 4, A, b, x->c);
    x->c[1] = u, x->c[2] = v, x->c[3] = 1, b[1] = (1 - 2 * v) / (12 * u * (u - v) * (1 - u));
    b[2] = (1 - 2 * u) / (12 * v * (v - u) * (1 - v));
    b[3] = (3 - 4 * u - 4 * v + 6 * u * v) / (12 * (1 - u) * (1 - v)), b[0] = 1 - b[1] - b[2] - b[3], A[4] = u;
    A[9] = v * (v - u) / (2 * u * (1 - 2 * u)), A[8] = v - A[9], A[14] = b[2] * (1 - v) / b[3];
    A[13] = (b[1] * (1 - u) - b[2] * A[9]) / b[3], A[12] = 1 - A[13] - A[14];
}

static double *specimen_number(specimen *x, int *which) /* the which-th number, or NULL behind the last */
{
    const int s = x->T.stages;
    int i = *which;
    if (i < s * s) return x->A + i;
    i -= s * s;
    if (i < s) return x->b + i;
    i -= s;
    if (i < s) return x->c + i;
    i -= s;
    if (i < s && x->T.bhat) return x->bhat + i;
    i -= x->T.bhat ? s : 0;
    return i < s * x->T.powers ? x->d + i : NULL;
}

static double specimen_largest(specimen *x)
{
    double top = 0, *v;
    int i;
    for (i = 0; (v = specimen_number(x, &i)) != NULL; i++) top = fmax(top, fabs(*v));
    return top;
}

/* Good tables with every coefficient off by up to 8 eps are accepted; tables with one coefficient off by a share of 1e-10 to
   1e-2 that a second engine sees are refused.  RK_ENSEMBLE: how many (1e5: half a minute). */
TEST(test_an_ensemble_of_good_and_bad_tables)
{
    const char *asked = getenv("RK_ENSEMBLE");
    const int count = asked ? atoi(asked) : 3000 / LESS;
    static specimen x;
    int n, good = 0, bad = 0, skipped = 0;
    second_trees();
    CHECK_INT(second_count, 1 + 1 + 2 + 4 + 9 + 20);
    ensemble_state = 20;
    for (n = 0; n < count; n++) {
        const rk_table *T = rk_tables() + (int)(ensemble_random() * 37);
        const double share = pow(10, -10 + 8 * ensemble_random());
        double *v, kept;
        int i, total;
        if (T && T->stages + T->extra <= SECOND_STAGES && n % 3) specimen_of(&x, T);
        else {
            do specimen_kutta(&x, ensemble_random(), ensemble_random());
            while (!(specimen_largest(&x) < 1e3));
        }
        for (total = 0; (v = specimen_number(&x, &total)) != NULL; total++)
            *v *= 1 + 8 * DBL_EPSILON * (2 * ensemble_random() - 1);
        x.T.dense_stiff = 0;
        if (specimen_largest(&x) < 1e2) {
            if (rk_check(&x.T, &kept) < 0) fail_msg("%d: %s off by 8 eps is refused: %g", n, x.T.name, kept);
            good++;
        }
        i = (int)(ensemble_random() * total), v = specimen_number(&x, &i), kept = *v;
        *v *= 1 + share;
        if (second_verdict(&x.T) > (specimen_largest(&x) < 30 ? 1e-11L : 1e-10L)) {
            if (rk_check(&x.T, NULL) >= 0)
                fail_msg("%d: %s with number %d off by %g is accepted; residual %Lg", n, x.T.name, i, share, second_verdict(&x.T));
            bad++;
        } else skipped++;
    }
    printf("# %d good tables accepted, %d bad ones refused, %d changes without effect\n", good, bad, skipped);
    CHECK(good > count / 2 && bad > count / 4);
}

/* ---- extremes ------------------------------------------------------------------------------------------------------ */

/* Sums of f(2^e y, 2^e k) are 2^e times those of f(y, k), bit for bit, wherever nothing under- or overflows. */
TEST(test_powers_of_two_pass_through_bit_for_bit)
{
    enum { n = 9 };
    const rk_table *T;
    int i, e, l, compared = 0;
    for (i = 0; (T = rk_tables() + i)->name; i++)
        for (e = -900; e <= 900; e += 100) {
            double y[n], k[16 * n], Y[n], K[16 * n], a[4][n], b[4][n];
            for (l = 0; l < n; l++) Y[l] = ldexp(y[l] = cos(l), e);
            for (l = 0; l < 16 * n; l++) K[l] = ldexp(k[l] = sin(l), e);
            CHECK_INT(rk_stage(T, T->stages - 1, 0.1, n, y, k, n, a[0]), RK_OK);
            CHECK_INT(rk_stage(T, T->stages - 1, 0.1, n, Y, K, n, b[0]), RK_OK);
            CHECK_INT(rk_update(T, 0.1, n, y, k, n, a[1], T->bhat ? a[2] : NULL), RK_OK);
            CHECK_INT(rk_update(T, 0.1, n, Y, K, n, b[1], T->bhat ? b[2] : NULL), RK_OK);
            CHECK_INT(dense(T, 0.3, 0, 0.1, n, y, k, n, a[3]), RK_OK);
            CHECK_INT(dense(T, 0.3, 0, 0.1, n, Y, K, n, b[3]), RK_OK);
            for (l = 0; l < n; l++)
                CHECK(ldexp(a[0][l], e) == b[0][l] && ldexp(a[1][l], e) == b[1][l] && ldexp(a[3][l], e) == b[3][l] &&
                      (!T->bhat || ldexp(a[2][l], e) == b[2][l]));
            compared += (T->bhat ? 4 : 3) * n;
        }
    EXTREME("y and slopes from 1e-271 to 1e271", "stages, results and dense values have the digits of sizes near 1: %d of %d, to the last bit",
            compared, compared);
}

#ifndef FAST_MATH
/* One call over n numbers, in place or not, and a call for each piece of them, at addresses that are multiples of 8 only:
   the same bits, for few numbers and around the lengths where another way through the sums begins. */
TEST(test_pieces_give_the_bits_of_the_whole)
{
    static const int lengths[] = {0,   1,   2,   7,   8,   9,   16,  17,   31,   32,  33,
                                  71,  72,  73,  255, 256, 257, 511, 512,  513,  4095, 4096, 4097};
    enum { most = 4097, ld = 4099 };
    static double room[(2 + 16 + 3) * ld + 1];
    static const char *const names[] = {"euler", "rk4", "dp5", "dop853"};
    const double theta[] = {0.3};
    size_t t, i;
    int cut, l, align;
    for (align = 0; align < 2; align++)
        for (t = 0; t < sizeof names / sizeof *names; t++)
            for (i = 0; i < sizeof lengths / sizeof *lengths; i++) {
                const rk_table *T = rk_find(names[t]);
                const int n = lengths[i], cuts[] = {n / 3, n - n / 7};
                double *y = room + align, *same = y + ld, *k = same + ld, *whole = k + 16 * ld, *part = whole + ld,
                       *many = part + ld;
                for (l = 0; l < n; l++) y[l] = same[l] = cos(l);
                for (l = 0; l < 16 * ld; l++) k[l] = sin(l);
                CHECK_INT(rk_update(T, 0.1, n, y, k, ld, whole, NULL), RK_OK);
                CHECK_INT(rk_update(T, 0.1, n, same, k, ld, same, NULL), RK_OK);
                CHECK(memcmp(whole, same, (size_t)n * sizeof *y) == 0);
                for (cut = 0; cut < 2; cut++) {
                    const int c = cuts[cut];
                    CHECK_INT(rk_update(T, 0.1, c, y, k, ld, part, NULL), RK_OK);
                    CHECK_INT(rk_update(T, 0.1, n - c, y + c, k + c, ld, part + c, NULL), RK_OK);
                    CHECK(memcmp(whole, part, (size_t)n * sizeof *y) == 0);
                }
                CHECK_INT(dense(T, 1, 0, 0.1, n, y, k, ld, part), RK_OK); /* the end of the step */
                CHECK(memcmp(whole, part, (size_t)n * sizeof *y) == 0);
                if (T->bhat) {
                    CHECK_INT(rk_update(T, 0.1, n, NULL, k, ld, NULL, whole), RK_OK);
                    for (l = 0; l < n; l++) CHECK_INT(rk_update(T, 0.1, 1, NULL, k + l, ld, NULL, part + l), RK_OK);
                    CHECK(memcmp(whole, part, (size_t)n * sizeof *y) == 0);
                }
                CHECK_INT(dense(T, 0.3, 0, 0.1, n, y, k, ld, whole), RK_OK);
                CHECK_INT(dense_many(T, 1, theta, 0, 0.1, n, y, k, ld, many, ld), RK_OK);
                CHECK(memcmp(whole, many, (size_t)n * sizeof *y) == 0);
            }
}
#endif

/* sum_k d_ik k (k-1) ... (k-r+1) theta^(k-r), term by term */
static void check_weights(const rk_table *T)
{
    static const double theta[] = {0, 0.25, 0.7, 1, 1.5, -0.5};
    double w[RK_STAGES_MAX];
    int j, k, l, r, q;
    for (r = 0; r <= T->powers + 1; r++)
        for (l = 0; l < 6; l++) {
            if (r == 0 && theta[l] == 1) continue; /* b itself */
            CHECK_INT(rk_weights(T, theta[l], r, w), l > 3 ? RK_EXTRAP : RK_OK);
            for (j = 0; j < T->stages + T->extra; j++) {
                double sum = 0, size = 1e-300;
                for (k = r; k <= T->powers; k++) {
                    double term = k > 0 ? T->d[j * T->powers + k - 1] : 0;
                    for (q = 0; q < r; q++) term *= k - q;
                    for (q = 0; q < k - r; q++) term *= theta[l];
                    sum += term;
                    size += fabs(term);
                }
                CHECK_NEAR(w[j], sum, 1e-14 * size);
            }
        }
}

/* Of all tables; polynomials of each degree, those with loops of their own and three beyond. */
TEST(test_weights_of_each_degree)
{
    enum { STAGES = 3, DEGREE = 10 };
    const double zero[STAGES * STAGES] = {0};
    double d[STAGES * DEGREE];
    rk_table T = plain_table("powers", STAGES, 0, zero, zero, zero);
    int i;
    for (i = 0; rk_tables()[i].name; i++) check_weights(rk_tables() + i);
    for (i = 0; i < STAGES * DEGREE; i++) d[i] = sin(3. * i + 1);
    T.d = d;
    for (T.powers = 1; T.powers <= DEGREE; T.powers++) check_weights(&T);
}

#ifdef __unix__
/* Extreme: threads on their own arrays that read the same tables: the bits of one thread alone */
static void *thread_run(void *result)
{
    double e[3];
    int i;
    double *out = (double *)result;
    for (i = 0; rk_tables()[i].name; i++) {
        const rk_table *T = rk_tables() + i;
        integrate(T, 10, e);
        out[2 * i] = e[0] + e[1] + e[2], out[2 * i + 1] = defect_b(T, T->order + 1 < 7 ? T->order + 1 : 7);
    }
    return NULL;
}

TEST(test_threads_on_the_same_tables)
{
    enum { threads = 4 };
    static double result[threads + 1][2 * 64];
    pthread_t id[threads];
    int i;
    for (i = 0; i < threads; i++) CHECK_INT(pthread_create(id + i, NULL, thread_run, result[i]), 0);
    thread_run(result[threads]);
    for (i = 0; i < threads; i++) {
        CHECK_INT(pthread_join(id[i], NULL), 0);
        CHECK(memcmp(result[i], result[threads], sizeof result[i]) == 0);
    }
}
#endif

/* Extreme: theta = 0, 1, 1 + 1 ulp, 2, -1 */
TEST(test_the_ends_of_dense_output_are_the_step_bit_for_bit)
{
    static const double ends[] = {1, 1 + DBL_EPSILON, 1 - DBL_EPSILON / 2};
    const rk_table *T;
    int i, j;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        double y[2], ynew[2], k[2 * RK_STAGES_MAX], v[2];
        exact(0.3, y);
        stages(T, 0.3, 0.1, y, k);
        CHECK_INT(rk_update(T, 0.1, 2, y, k, 2, ynew, NULL), RK_OK);
        for (j = 0; j < 3; j++) {
            CHECK_INT(dense(T, ends[j], 0, 0.1, 2, y, k, 2, v), RK_OK);
            CHECK(memcmp(v, ynew, sizeof v) == 0);
            CHECK_INT(dense(T, j * -DBL_EPSILON, 0, 0.1, 2, y, k, 2, v), RK_OK);
            CHECK(memcmp(v, y, sizeof v) == 0);
        }
        CHECK_INT(dense(T, 2, 0, 0.1, 2, y, k, 2, v), RK_EXTRAP);
        CHECK_NEAR(v[1], exp(sin(0.5)), 0.15);
        CHECK_INT(dense(T, -1, 0, 0.1, 2, y, k, 2, v), RK_EXTRAP);
        CHECK_NEAR(v[1], exp(sin(0.2)), 0.15);
    }
}

/* Stage 0 and a sum of no terms take no slopes: k may be NULL, which must not be moved along (the sanitizer looks). */
TEST(test_no_slopes_where_none_are_read)
{
    static const int lengths[] = {1, 2, 3, 16, 20, 32, 33, 100, 256, 257, 600};
    static const double none[600];
    double y[600], z[600];
    size_t i;
    int j;
    for (j = 0; j < 600; j++) y[j] = cos(j);
    for (i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        const int n = lengths[i];
        memset(z, 0, sizeof z);
        CHECK_INT(rk_stage(rk_find("rk4"), 0, 0.1, n, y, NULL, 0, z), RK_OK);
        CHECK(memcmp(z, y, (size_t)n * sizeof *z) == 0);
        CHECK_INT(rk_combine(1, 0, NULL, n, NULL, NULL, 0, z), RK_OK);
        CHECK(memcmp(z, none, (size_t)n * sizeof *z) == 0); /* 0, and not -0 */
        memset(z, 7, sizeof z);
        CHECK_INT(rk_combine(1, 2, none, n, NULL, none, 0, z), n == 0 ? RK_OK : RK_EARG); /* the stride is too short */
        CHECK_INT(rk_combine(1, 2, none, n, NULL, y, n, z), RK_OK);
        CHECK(memcmp(z, none, (size_t)n * sizeof *z) == 0);
        memcpy(z, y, sizeof z);
        z[n / 2] = HUGE_VAL;
        CHECK_INT(rk_combine(1, 0, NULL, n, z, NULL, 0, z), RK_NONFINITE);
        CHECK(z[n / 2] == HUGE_VAL && (n == 1 || z[0] == y[0]));
    }
}

/* Extreme: h = 0, negative, 1e-300, 1e300 */
TEST(test_extreme_steps)
{
    const rk_table *T = rk_find("dp5");
    double y[2] = {1, 1}, k[14] = {0}, v[2], one[14];
    int j;
    for (j = 0; j < 14; j++) one[j] = 1;
    stages(T, 0, 0, y, k);
    CHECK_INT(rk_update(T, 0, 2, y, k, 2, v, NULL), RK_OK);
    CHECK(memcmp(v, y, sizeof v) == 0);
    CHECK_INT(dense(T, 0.5, 2, 0, 2, y, k, 2, v), RK_EARG); /* y'' would divide by h */
    CHECK_INT(dense(T, 0.5, 3, ldexp(1, -511), 2, y, k, 2, v), RK_NONFINITE); /* h^-2 = 2^1022, and 2^1024 */
    CHECK_INT(dense(T, 0.5, 3, ldexp(1, -512), 2, y, k, 2, v), RK_EARG);
    stages(T, 0, -0.1, y, k);
    CHECK_INT(rk_update(T, -0.1, 2, y, k, 2, v, NULL), RK_OK);
    CHECK_NEAR(v[0], 1 / 1.01, 1e-8);
    CHECK_INT(rk_update(T, 1e-300, 2, y, one, 2, v, NULL), RK_OK);
    CHECK(v[0] == 1);
    CHECK_INT(rk_update(T, 1e300, 2, y, one, 2, v, NULL), RK_OK);
    CHECK_NEAR(v[0] / 1e300, 1, 1e-14);
}

/* Slopes of 1e308: a number is right or it is not finite, and then the status says so; in place, too */
TEST(test_slopes_at_the_end_of_the_range)
{
    const rk_table *T = rk_find("dp5");
    static double y[5001], k[7 * 5001], z[5001];
    int i, j, most;
    for (most = 150; most <= 308; most += 158) {
        for (j = 0; j < 7 * 5001; j++) k[j] = pow(10, most);
        for (i = 0; i < 7; i++) {
            const int status = rk_stage(T, i, 1, 5001, y, k, 5001, z);
            for (j = 0; j < 5001; j++)
                if (is_finite(z[j])) CHECK_NEAR(z[j] / k[0], T->c[i], 1e-14);
            CHECK_INT(status, is_finite(z[0]) && is_finite(z[5000]) ? RK_OK : RK_NONFINITE);
            CHECK(most == 308 || status == RK_OK);
        }
    }
    for (j = 0; j < 5001; j++) y[j] = j % 3 == 0 ? -1e308 : 1e308; /* finite, though their sum is not */
    for (j = 0; j < 5001; j += 7)
        for (i = 0; i < 2; i++) {
            CHECK_INT(rk_stage(T, i, 1e-300, 5001 - j, y, k, 5001, z), RK_OK);
            CHECK(memcmp(z, y, (size_t)(5001 - j) * sizeof *y) == 0);
        }
}

TEST(test_a_NaN_slope_is_reported_and_stays_in_its_element)
{
    const rk_table *T = rk_find("rk4");
    double y[3] = {1, 2, 3}, k[12] = {0}, v[3];
    k[1] = nan("");
    CHECK_INT(rk_stage(T, 1, 0.1, 3, y, k, 3, v), RK_NONFINITE);
    CHECK_INT(rk_update(T, 0.1, 3, y, k, 3, v, NULL), RK_NONFINITE);
    CHECK(v[0] == 1 && v[2] == 3);
    CHECK_INT(rk_stage(T, 2, 0.1, 3, y, k, 3, v), RK_OK); /* a_20 = 0: not read */
    CHECK(v[1] == 2);
}

/* Each function once with each of its arguments spoiled: a status, and the outputs stay. */
TEST(test_every_argument_is_looked_at)
{
    const rk_table *T = rk_find("dp5"), *V = rk_find("verner6");
    const double bad[] = {nan(""), HUGE_VAL, -HUGE_VAL}, theta[] = {0.5}, w[] = {1, 1};
    double y[2] = {1, 1}, k[14] = {0}, v[20], mem[600];
    rk_table X, nine = *V, none = *T;
    int i;
    for (i = 0; i < 20; i++) v[i] = 7;
    for (i = 0; i < 3; i++) {
        ALL(RK_ENAN, rk_combine(bad[i], 2, w, 2, y, k, 2, v), rk_stage(T, 1, bad[i], 2, y, k, 2, v),
            rk_stages(T, bad[i], 2, y, k, 2, v, 2), rk_update(T, bad[i], 2, y, k, 2, v, NULL),
            dense(T, 0.5, 0, bad[i], 2, y, k, 2, v), dense(T, bad[i], 0, 1, 2, y, k, 2, v),
            dense_many(T, 1, bad + i, 0, 1, 2, y, k, 2, v, 2), rk_weights(T, bad[i], 0, v));
        if (i == 1) continue; /* +Inf: a component and its tolerance are 0 */
        CHECK(is_nan(rk_first_step(4, 1, bad[i], 1, -1)) && is_nan(rk_first_step(4, 1, 1, bad[i], -1)));
        CHECK(i == 2 || is_nan(rk_first_step(4, 1, 1, 1, bad[i])));
    }
    ALL(RK_ENULL, rk_stage(NULL, 0, 1, 2, y, k, 2, v), rk_stage(T, 1, 1, 2, NULL, k, 2, v), rk_stage(T, 1, 1, 2, y, NULL, 2, v),
        rk_stages(T, 1, 2, y, NULL, 2, v, 2), rk_stages(T, 1, 2, y, k, 2, NULL, 2), rk_update(NULL, 1, 2, y, k, 2, v, NULL),
        rk_update(T, 1, 2, NULL, k, 2, v, NULL), rk_weights(T, 0.5, 0, NULL), dense(T, 0.5, 0, 1, 2, y, NULL, 2, v),
        dense(T, 0.5, 0, 1, 2, y, k, 2, NULL), dense_many(T, 1, theta, 0, 1, 2, y, k, 2, NULL, 2),
        rk_combine(1, 2, NULL, 2, y, k, 2, v), rk_combine(1, 2, w, 1, y, NULL, 2, v), rk_combine(1, 2, w, 1, y, k, 2, NULL),
        rk_norm(1, 1, NULL, 2, y, NULL, NULL, v));
    ALL(RK_EARG, rk_stage(T, -1, 1, 2, y, k, 2, v), rk_stage(T, 7, 1, 2, y, k, 2, v), rk_stage(T, 1, 1, -1, y, k, 2, v),
        rk_stage(T, 1, 1, 2, y, k, 1, v), rk_stages(T, 1, -1, y, k, 2, v, 2), rk_stages(T, 1, 2, y, k, 1, v, 2),
        rk_stages(T, 1, 2, y, k, 2, v, 1), rk_update(T, 1, -1, y, k, 2, v, NULL), rk_update(T, 1, 2, y, k, 1, v, NULL),
        dense(T, 0.5, -1, 1, 2, y, k, 2, v), dense(T, 0.5, 0, 1, -1, y, k, 2, v), dense(T, 0.5, 0, 1, 2, y, k, 1, v),
        rk_combine(1, 2, w, -1, y, k, 2, v), rk_combine(1, -1, w, 2, y, k, 2, v), rk_combine(1, 2, w, 2, y, k, 1, v),
        rk_combine(1, RK_STAGES_MAX + 1, w, 2, y, k, 2, v));
    CHECK_INT(rk_update(rk_find("rk4"), 1, 2, y, k, 2, v, v + 2), RK_ENOPAIR);
    CHECK_WITH(RK_ENODENSE, dense(&X, 0.5, 0, 1, 2, y, k, 2, v), X = *T, X.d = NULL);
    CHECK_WITH(RK_EARG, rk_stage(&X, 0, 1, 2, y, k, 2, v), X.stages = 0);
    CHECK_WITH(RK_EARG, rk_update(&X, 1, 2, y, k, 2, v, NULL), X.stages = RK_STAGES_MAX + 1);
    CHECK(is_nan(defect_b(NULL, 1)) && is_nan(defect_b(T, 0)) && is_nan(defect_b(T, 11)));
    CHECK(is_nan(defect_hat(rk_find("rk4"), 1)) && is_nan(defect_dense(&X, 1)) && !rk_find("nobody's") && !rk_find(NULL));
    CHECK(is_nan(defect_pair(T, T, 0, 0)) && is_nan(defect_pair(T, T, 0, 11)));
    CHECK(is_nan(defect_pair(T, T, -1, 1)) && is_nan(defect_pair(T, T, 3, 1)));
    nine.extra = 0;
    CHECK(is_nan(defect_pair(V, &nine, 0, 1)));
    CHECK_WITH(RK_EOTHER, rk_extend(&X, V, &nine, 5, 0, mem, sizeof mem), X.name = NULL);
    CHECK_INT(rk_extend(&X, rk_find("rk4"), NULL, 3, 10, mem, sizeof mem), RK_EARG);
    CHECK_WITH(RK_ETABLE, rk_extend(&X, &none, NULL, 3, 0, mem, sizeof mem), none.order = 0);
    CHECK_WITH(RK_ENULL, rk_extend(&X, T, &none, 3, 0, mem, sizeof mem), none.A = NULL);
    CHECK_WITH(RK_EARG, rk_extend(&X, &none, NULL, 3, 1, mem, sizeof mem), none.A = T->A, none.stages = RK_STAGES_MAX);
    CHECK(X.name == NULL);
    for (i = 0; i < 20; i++) CHECK(v[i] == 7);
    CHECK_INT(rk_stage(T, 0, 1, 0, NULL, NULL, 0, NULL), RK_OK);
    CHECK_INT(rk_combine(1, 2, w, 0, NULL, NULL, 0, NULL), RK_OK); /* nothing to do */
    CHECK_INT(rk_combine(1, 0, NULL, 2, y, NULL, 0, v), RK_OK);    /* nothing to add */
    CHECK(v[0] == 1 && v[1] == 1 && v[2] == 7);
}

/* A coupling of the host's own: each field spoiled once; a NaN in it is a defect */
TEST(test_bad_couplings_are_refused)
{
    static const signed char longer[] = {1, 3, 2, 1, 0}, shorter[] = {1, 2, 2, 0}, open_[] = {1, 2, 2, 1, 1, 0};
    static const signed char wide[] = {10, 0}, none[] = {0}, nine[] = {9, 1, 0};
    static const double c[] = {0, .1, .2, .3, .4, .5, .6, .7, .8, .9, 1};
    const signed char *const groups[] = {longer, shorter, open_, none, NULL};
    double w[RK_ORDER_MAX * RK_STAGES_MAX];
    rk_coupling C;
    size_t i;
#define REFUSED(name, field, value, status)                                                                                     \
    do {                                                                                                                \
        C = *rk_coupling_find(name);                                                                                    \
        C.field = value;                                                                                                \
        CHECK_INT(rk_coupling_forcing(&C, 1, w), status);                                                               \
    } while (0)
    REFUSED("KW3", c, NULL, RK_ENULL);
    REFUSED("KW3", form, -1, RK_EARG);
    REFUSED("KW3", form, 4, RK_EARG);
    REFUSED("KW3", stages, 1, RK_EARG);
    REFUSED("KW3", stages, RK_STAGES_MAX + 1, RK_EARG);
    REFUSED("KW3", W, NULL, RK_ENULL);
    REFUSED("KW3", powers, 0, RK_EARG);
    REFUSED("KW3", powers, RK_ORDER_MAX + 1, RK_EARG);
    REFUSED("SR21", G, NULL, RK_ENULL);
    for (i = 0; i < sizeof groups / sizeof *groups; i++) REFUSED("MERK43", groups, groups[i], groups[i] ? RK_EARG : RK_ENULL);
    C = *rk_coupling_find("MERK43");
    C.c = c, C.stages = 11, C.groups = nine;
    CHECK_INT(rk_coupling_forcing(&C, 10, w), 10); /* through y and nine slopes */
    C.groups = wide; /* ten slopes and y: eleven nodes, more than the powers there is room for */
    CHECK_INT(rk_coupling_forcing(&C, 1, w), RK_EARG);
#undef REFUSED
    C = *rk_coupling_find("KW3");
    CHECK(rk_coupling_from(NULL, 1) == RK_ENULL && rk_coupling_from(&C, 0) == RK_EARG && rk_coupling_from(&C, 5) == RK_EARG);
    CHECK(rk_coupling_forcing(&C, 1, NULL) == RK_ENULL && rk_coupling_jump(&C, 1, NULL) == RK_ENULL);
    CHECK(rk_coupling_forcing(&C, 5, w) == RK_EARG && rk_coupling_jump(&C, 0, w) == RK_EARG);
    CHECK(is_nan(rk_coupling_time(NULL, 0)) && is_nan(rk_coupling_time(&C, -1)));
    CHECK(rk_coupling_from(&C, 4) == RK_ENOPAIR && rk_coupling_jump(&C, 4, w) == RK_ENOPAIR && is_nan(rk_coupling_time(&C, 4)));
    CHECK(rk_coupling_from(rk_coupling_find("MERK21"), 3) >= 0 && rk_coupling_time(rk_coupling_find("MERK21"), 3) == 1);
    C = *rk_coupling_find("ERK22a");
    memcpy(w, C.W, 9 * sizeof *w);
    w[0] = nan("");
    C.W = w;
    CHECK(!is_finite(rk_defect_coupling(&C, 0, 1)));
}

TEST(test_every_status_has_its_message)
{
#define VALUE(name, value, text) value,
    static const int statuses[] = {RK_STATUSES(VALUE) 12345};
#undef VALUE
    size_t i, j;
    for (i = 0; i < sizeof statuses / sizeof *statuses; i++)
        for (j = 0; j < i; j++) CHECK(strcmp(rk_message(statuses[i]), rk_message(statuses[j])) != 0);
    CHECK(strcmp(rk_message(7), "done: a result") == 0 && strcmp(rk_message(299), "done: a result") == 0);
    CHECK(strstr(rk_message(RK_REMARK), "unknown") && RK_REMARK == 300 && RK_EXTRAP > RK_REMARK);
    CHECK(strstr(rk_message(12345), "unknown") && strstr(rk_message(-1), "unknown"));
    CHECK_INT(rk_linked_version(), RK_VERSION);
}

/* ---- small print -------------------------------------------------------------------------------- */

/* A last step as long as `smallest`, but for round-off: no shorter one is left, so it is not tried again. */
TEST(test_a_last_step_of_the_smallest_size_is_not_repeated)
{
    rk_control C;
    double t = 0.3, h = 1e-3;
    CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
    C.smallest = 1e-3;
    CHECK_INT(rk_control_stop(&C, 0.301, t, &h), RK_OK);
    CHECK_INT(rk_control_step(&C, 1e9, &t, &h), RK_ETINY);
}

/* Each setting of the control by its formula, for the plain law: h e^(-1/(q+1)) times the safety, within the limits. */
TEST(test_every_setting_of_the_control)
{
#define SETTING(field) offsetof(rk_control, field)
    const double safe = pow(0.5, -1. / 5); /* dp5: of order 4 */
    const struct {
        size_t setting;
        double value, error, h, expected;
        int status;
    } row[] = {{SETTING(safety), 0.9, 0.5, 0.1, 0.1 * 0.9 * safe, RK_OK}, {SETTING(safety), 0.5, 0.5, 0.1, 0.1 * 0.5 * safe, RK_OK},
               {SETTING(grow), 3, 1e-12, 0.1, 0.1 * 3, RK_OK},            {SETTING(shrink), 0.2, 1e30, 0.1, 0.1 * 0.2, RK_REJECT},
               {SETTING(accept), 2, 1.9, 0.1, 0, RK_OK},                  {SETTING(accept), 2, 2.1, 0.1, 0, RK_REJECT},
               {SETTING(largest), 0.11, 0.01, 0.1, 0.11, RK_OK},          {SETTING(largest), 0.11, 0.01, -0.1, -0.11, RK_OK},
               {SETTING(smallest), 0.05, 1e30, 0.05, 0.05, RK_ETINY},     {SETTING(smallest), 0.05, 1e30, 0.1, 0.05, RK_REJECT}};
    size_t i;
    for (i = 0; i < sizeof row / sizeof *row; i++) {
        rk_control C;
        double t = 1, h = row[i].h;
        CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
        CHECK(C.safety == (double)0.9 && C.grow == 10 && C.first == 1e4 && C.accept == 1);
        CHECK(C.shrink == (double)0.1 && C.again == (double)0.3);
        CHECK(C.least == (double)1e-4 && C.smallest == 0 && C.largest == 0);
        CHECK_INT(rk_control_step(&C, 0.5, &t, &h), RK_OK); /* the first step has its own limit */
        memcpy((char *)&C + row[i].setting, &row[i].value, sizeof row[i].value);
        CHECK_WITH(row[i].status, rk_control_step(&C, row[i].error, &t, &h), t = 1, h = row[i].h);
        if (row[i].expected != 0) CHECK_NEAR(h / row[i].expected, 1, 1e-13);
        CHECK_NEAR(t, row[i].status == RK_OK ? 1 + row[i].h : 1, 1e-15);
    }
}

/* A run in intervals of 0.13, where the control would take steps of another size: no interval begins with a rest. */
TEST(test_the_stop_time_does_not_shorten_the_next_interval)
{
    const rk_table *T = rk_find("dp5");
    double t = 0, h = 1, bad = nan(""), zero = 0;
    rk_control C;
    CHECK_INT(rk_control_make(&C, "I", T), RK_OK);
    STOP(3, 0, h == 1 && C.wanted == 0 && C.stop == 3); /* far enough */
    STOP(1.5, 0, h == 0.75 && C.wanted == 1); /* two equal steps */
    STOP(3, 0, h == 1 && C.wanted == 0); /* the cut is undone */
    STOP(0.001, 0, h == (double)0.001 && C.wanted == 1);
    CHECK_WITH(RK_OK, rk_control_step(&C, 0, &t, &h), C.steps = 1, C.h[0] = C.e[0] = 1);
    CHECK(t == (double)0.001 && h <= 1 && h > 1 - 1e-15 && C.wanted == 0); /* the growth limit 10 is for steps that were not cut */
    CHECK_INT(rk_control_stop(&C, 0.002, t, &h), RK_OK);
    CHECK_NEAR(h, 0.001, 1e-18);
    CHECK_INT(rk_control_step(&C, 1e-10, &t, &h), RK_OK);
    CHECK_NEAR(h, 0.001 * 0.9 * 100, 1e-15); /* less than was wanted, by the error of the cut step */
    CHECK_INT(rk_control_stop(&C, t + 0.05, t, &h), RK_OK);
    CHECK_INT(rk_control_step(&C, 8, &t, &h), RK_REJECT);
    CHECK(fabs(C.wanted) < 0.06 && h == C.cut); /* the size before the new cut, not before the last one */
    STEP(1e-30, RK_OK, h < 0.06 && h > 0.02); /* what was wanted before the rejection is forgotten */
    STOP(bad, t, C.wanted == 0);
    ALL(RK_ENULL, rk_control_stop(NULL, 1, t, &h), rk_control_stop(&C, 1, t, NULL));
    ALL(RK_ENAN, rk_control_stop(&C, 1, bad, &h), rk_control_stop(&C, 1, t, &bad));
    CHECK_INT(rk_control_stop(&C, 1, t, &zero), RK_EARG);
}

TEST(test_the_control_of_a_coupling)
{
    rk_control C, same;
    double h[2] = {1, 1}, t[2] = {0, 0};
    CHECK_INT(rk_control_order(&C, "PI", 3), RK_OK);
    CHECK_INT(rk_control_make(&same, "PI", rk_find("esdirk4")), RK_OK); /* its estimate is of order 3, too */
    CHECK_INT(rk_control_step(&C, 1e-3, t, h), RK_OK);
    CHECK_INT(rk_control_step(&same, 1e-3, t + 1, h + 1), RK_OK);
    CHECK(h[0] == h[1] && C.order == 3);
    CHECK_NEAR(h[0], 0.9 * pow(1e-3, -0.25), 1e-15);
    CHECK_INT(rk_control_order(&C, "I", 1), RK_OK);
    same = C, same.order = 0;
    CHECK_INT(rk_control_step(&same, 0.5, t, h), RK_EARG);
    same = C;
    CHECK_INT(rk_control_order(&C, "PI", 0), RK_EARG); /* order_hat of a coupling without an embedded solution */
    CHECK_INT(rk_control_order(&C, "pi", 3), RK_ENAME);
    ALL(RK_ENULL, rk_control_order(&C, NULL, 3), rk_control_order(NULL, "PI", 3));
    CHECK_INT(rk_control_make(&C, "pi", rk_find("dp5")), RK_ENAME);
    CHECK(memcmp(&C, &same, sizeof C) == 0);
}

/* Whole numbers, whose sums are exact in any order. */
TEST(test_sums_of_up_to_thirty_terms)
{
    enum { N = 37, LD = 41 };
    double k[30 * LD], w[30], y[N], out[N];
    int count, i, j;
    for (j = 0; j < 30; j++) {
        w[j] = j % 5 == 2 ? 0 : 1 + j * j % 11;
        for (i = 0; i < LD; i++) k[j * LD + i] = (17 * j + 5 * i) % 23 - 9;
    }
    for (count = 0; count <= 30; count++) {
        double expected[N];
        for (i = 0; i < N; i++) {
            expected[i] = y[i] = i - 11;
            for (j = 0; j < count; j++) expected[i] += 2 * w[j] * k[j * LD + i];
        }
        CHECK_INT(rk_combine(2, count, w, N, y, k, LD, out), RK_OK);
        CHECK(memcmp(out, expected, sizeof out) == 0);
        CHECK_INT(rk_combine(2, count, w, N, y, k, LD, y), RK_OK);
        CHECK(memcmp(y, expected, sizeof y) == 0);
        CHECK_INT(rk_combine(2, count, w, N, NULL, k, LD, out), RK_OK);
        for (i = 0; i < N; i++) CHECK(out[i] == expected[i] - (i - 11));
    }
#ifdef FE_DOWNWARD /* x - x is -0 then */
    fesetround(FE_DOWNWARD);
    i = rk_combine(2, 30, w, N, y, k, LD, out);
    fesetround(FE_TONEAREST);
    CHECK_INT(i, RK_OK);
#endif
}

/* All stages at once, more numbers than a block: as one sum after the other, and nothing behind the end of a vector. */
TEST(test_all_stages_of_long_vectors)
{
    enum { N = 9001, LD = N + 7 };
    static double k[3 * LD], z[3 * LD], y[N], one[N], mem[200];
    rk_table T;
    ptrdiff_t i;
    int j;
    CHECK_INT(rk_collocation(&T, RK_RADAU_IIA, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < N; i++) y[i] = sin(0.3 * (double)i);
    for (i = 0; i < 3 * LD; i++) k[i] = cos(0.7 * (double)i), z[i] = 77;
    CHECK_WITH(RK_NONFINITE, rk_stages(&T, 0.1, N, y, k, LD, z, LD), k[2 * LD + 8999] = HUGE_VAL);
    CHECK_WITH(RK_OK, rk_stages(&T, 0.1, N, y, k, LD, z, LD), k[2 * LD + 8999] = 1);
    for (j = 0; j < 3; j++) {
        CHECK_INT(rk_combine(0.1, 3, T.A + 3 * j, N, y, k, LD, one), RK_OK);
        CHECK(memcmp(one, z + j * LD, sizeof one) == 0);
        for (i = N; i < LD; i++) CHECK(z[j * LD + i] == 77);
    }
    ALL(RK_EARG, rk_stages(&T, 0.1, N, y, k, N - 1, z, LD), rk_stages(&T, 0.1, N, y, k, LD, z, N - 1));
}

/* |R(-inf)| is 0.7/0.3 at the end of the step, or 1.105 there and 1.07 at 63/64 of it: no dense output of it can be bounded. */
TEST(test_no_bounded_dense_output_of_a_step_that_is_not)
{
    const double A[] = {0, 0, 0.7, 0.3}, b[] = {0.7, 0.3}, c[] = {0, 1};
    const double last = 1 / 2.105, A2[] = {0, 0, 1 - last, last};
    const rk_table T = plain_table("theta", 2, 1, A, b, c), near_one = plain_table("near one", 2, 1, A2, A2 + 2, c);
    static double mem[2000];
    rk_table X;
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_UNBOUNDED);
    CHECK_INT(X.dense_order, 1);
    CHECK_INT(rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem), RK_UNBOUNDED);
    CHECK_INT(rk_extend(&X, &near_one, NULL, 1, 0, mem, sizeof mem), RK_UNBOUNDED);
}

/* What rk_extend adds: the slope at ynew unless it is there, states of the dense output, whose c are its row sums; the
   pair stays as it is. */
TEST(test_the_stages_that_rk_extend_adds)
{
    static const char *const names[] = {"rk4", "bs3", "dp5", "tsit5", "kutta3"};
    static double mem[20000];
    rk_table X;
    int i, j, l, n;
    for (n = 0; n < 5; n++) {
        const rk_table *T = rk_find(names[n]);
        const int fsal = rk_is(T, RK_FSAL) == 1;
        CHECK(rk_extend(&X, T, NULL, T->order, 9, mem, sizeof mem) >= 0);
        CHECK_INT(rk_check(&X, NULL), RK_OK);
        CHECK_INT(X.dense_order, T->order);
        CHECK(X.stages == T->stages);
        for (i = X.stages; i < X.stages + X.extra; i++) {
            const int m = X.stages + X.extra;
            double sum = 0;
            for (j = 0; j < m; j++) sum += X.A[i * m + j];
            CHECK_NEAR(sum, X.c[i], 1e-13);
            for (l = 0; l < i; l++) CHECK(memcmp(X.A + l * m, X.A + i * m, (size_t)m * sizeof *X.A) != 0);
            if (i > X.stages || fsal) continue;
            CHECK(X.c[i] == 1); /* at ynew */
            for (j = 0; j < X.stages; j++) CHECK(X.A[i * m + j] == T->b[j]);
        }
        CHECK((X.bhat != NULL) == (T->bhat != NULL) && (X.e != NULL) == (T->bhat != NULL));
        for (j = 0; T->bhat && j < T->stages; j++) CHECK(X.bhat[j] == T->bhat[j] && X.e[j] == T->e[j]);
    }
}

/* Implicit Euler by its own formula, y/(1 - h lambda), also inside the step; KW3 has no embedded row. */
TEST(test_the_numbers_of_the_smallest_methods)
{
    const rk_table *T = rk_find("beuler");
    const rk_coupling *C = rk_coupling_find("KW3");
    double w[4 * RK_ORDER_MAX], z, k, y = 2, u;
    CHECK_INT(rk_check(T, NULL), RK_OK);
    CHECK_INT(rk_stage(T, 0, 0.5, 1, &y, &k, 1, &z), RK_OK);
    k = -3 * (z / (1 + 0.5 * T->A[0] * 3)); /* z = z_base + h a_11 (-3 z) */
    CHECK_INT(rk_update(T, 0.5, 1, &y, &k, 1, &u, NULL), RK_OK);
    CHECK_NEAR(u, 2 / 2.5, 1e-15);
    CHECK_INT(dense(T, 0.25, 0, 0.5, 1, &y, &k, 1, &u), RK_OK);
    CHECK_NEAR(u, 2 + 0.25 * (0.8 - 2), 1e-15);
    CHECK(T->c[0] == 1);
    CHECK_INT(rk_coupling_forcing(C, 4, w), RK_ENOPAIR); /* it has no embedded solution: never an error of 0 */
}

/* The column C1 of TABLES: u'(0) is the first slope and u'(1) the one at ynew, whatever f is. */
TEST(test_the_slopes_of_dense_output_at_the_ends)
{
    static const char *const smooth[] = {"bs3", "dp5", "tsit5", "ss4", "verner6", "dop853"};
    const rk_table *T;
    int i, j, found = 0;
    for (i = 0; (T = rk_tables() + i)->name; i++) {
        const int m = T->stages + T->extra, last = T->order == 8 ? T->stages : T->stages - 1; /* dop853: of the extra ones */
        double w[2][RK_STAGES_MAX];
        int continuous = 1, listed = 0;
        CHECK_INT(rk_weights(T, 0, 1, w[0]), RK_OK);
        CHECK_INT(rk_weights(T, 1, 1, w[1]), RK_OK);
        for (j = 0; j < m; j++)
            if (!(fabs(w[0][j] - (j == 0)) <= 1e-12 && fabs(w[1][j] - (j == last)) <= 1e-12)) continuous = 0;
        if (T->c[0] != 0 || T->c[last] != 1 || memcmp(T->A + last * m, T->b, (size_t)m * sizeof *T->b) != 0) continuous = 0;
        for (j = 0; j < 6; j++) listed |= strcmp(T->name, smooth[j]) == 0;
        if (listed != continuous) fail_msg("%s is C%d", T->name, continuous);
        found += listed;
    }
    CHECK_INT(found, 6);
}

/* The estimate of RECIPES with the numbers of TABLES on y' = lambda (y - phi) + phi', whose local solution is known: within
   0.19 and 2 of the largest error inside in nine of ten steps, for each lambda. */
static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double curve(double t)
{
    return sin(t) + 0.5 * cos(2 * t);
}

static double curve_slope(double lambda, double t, double y)
{
    return lambda * (y - curve(t)) + cos(t) - sin(2 * t);
}

static double estimated_over_true(const rk_step *s, double lambda, double t, double theta, int implicit)
{
    const int last = s->T->stages - 1;
    double u, du, worst = 0;
    int j;
    for (j = 1; j < 16; j++) {
        const double d = j * s->h / 16;
        CHECK_INT(rk_dense(s, j / 16., 0, &u), RK_OK);
        worst = fmax(worst, fabs(u - curve(t + d) - (*s->y - curve(t)) * exp(lambda * d)));
    }
    if (worst < 1e-12 || worst > 0.1 * fabs(*s->y)) return -1; /* rounding, or no step to take */
    CHECK_INT(rk_dense(s, theta, 0, &u), RK_OK);
    CHECK_INT(rk_dense(s, theta, 1, &du), RK_OK);
    du = s->h * (du - curve_slope(lambda, t + theta * s->h, u));
    if (implicit) du /= 1 - s->h * s->T->A[last * s->T->stages + last] * lambda;
    return fabs(du) / worst;
}

TEST(test_the_estimate_of_the_error_of_dense_output)
{
    static double ratio[400];
    const rk_table *T;
    double lambda, theta[2], divisor = 1;
    for (T = rk_tables(); T->name; T++)
        for (lambda = -10; lambda > -2e6; lambda *= 10) {
            const int implicit = rk_is(T, RK_EXPLICIT) != 1, m = T->stages + T->extra;
            int e, i, s, count = 0;
            if (!column_at(T->name, theta, &divisor)) fail_msg("%s has no column at", T->name);
            if (!implicit && lambda < -200) continue;
            if (!rk_is(T, RK_SEQUENTIAL)) continue; /* test_radau_looks_inside_its_steps */
            for (e = 0; e < 4; e++) {
                const double h = (implicit ? 0.25 : 0.0625) / (1 << e);
                double y = 0.5, k[RK_STAGES_MAX], z;
                const rk_step step = step_of(T, h, 1, &y, k, 1);
                for (s = 0; s < 60 && s * h < 4; s++) {
                    for (i = 0; i < m; i++) {
                        const double g = h * T->A[i * m + i] * lambda, at = (s + T->c[i]) * h;
                        CHECK_INT(rk_stage(T, i, h, 1, &y, k, 1, &z), RK_OK);
                        k[i] = curve_slope(lambda, at, z) / (1 - g);
                    }
                    ratio[count] = fmax(estimated_over_true(&step, lambda, s * h, theta[0], implicit),
                                        estimated_over_true(&step, lambda, s * h, theta[1], implicit)) / divisor;
                    if (ratio[count] > 0 && s > 0) count++;
                    CHECK_INT(rk_update(T, h, 1, &y, k, 1, &y, NULL), RK_OK);
                }
            }
            CHECK(count > 20);
            qsort(ratio, (size_t)count, sizeof *ratio, ascending);
            if (!(ratio[count / 20] > 0.19 && ratio[count - 1 - count / 20] < 2))
                fail_msg("%s, lambda %g: %.3f to %.3f", T->name, lambda, ratio[count / 20], ratio[count - 1 - count / 20]);
        }
}

/* ---- ranges of the norm, nodes, rows of a coupling ----------------------------------------------------------------------- */

static long double legendre(int n, long double x)
{
    long double before = 1, now = x;
    int k;
    for (k = 2; k <= n; k++) {
        const long double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now, now = next;
    }
    return n == 0 ? 1 : now;
}

/* Gauss: the zeros of P_s; Radau: of P_s - P_(s-1); Lobatto: of P_s - P_(s-2); between the doubles on both sides of a node
   the polynomial changes its sign. */
TEST(test_nodes_are_zeros_to_the_last_bit_or_two)
{
    static const int back[] = {0, 0, 1, 2, 2, 2};
    double mem[400];
    rk_table T;
    int family, s, i;
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = back[family] == 2 ? 2 : 1; s <= 5; s++) {
            CHECK_INT(rk_collocation(&T, family, s, mem, sizeof mem), RK_OK);
            for (i = 0; i < s; i++) {
                const long double node = (long double)T.c[i], left = 2 * (node - 2.3e-16L) - 1, right = 2 * (node + 2.3e-16L) - 1;
                const long double below = legendre(s, left) - (back[family] ? legendre(s - back[family], left) : 0);
                const long double above = legendre(s, right) - (back[family] ? legendre(s - back[family], right) : 0);
                CHECK(i == 0 || T.c[i] > T.c[i - 1]);
                CHECK(below * above < 0);
            }
        }
}

/* Every row of W takes a stage from where it begins to its end: the sums are the lengths of these ways, of the pair's, too.
   Nothing is written behind the memory asked for. */
TEST(test_rows_of_a_coupling_from_a_table)
{
    static double mem[600];
    const rk_table *T;
    rk_coupling C;
    int t, i, j, form, pairs = 0;
    size_t k;
    for (t = 0; (T = rk_tables() + t)->name; t++)
        for (form = 0; form < 2; form++) {
            const size_t numbers = rk_mis_size(T->stages) / sizeof *mem;
            const double last = form ? 0 : T->c[T->stages - 1];
            for (k = 0; k < 600; k++) mem[k] = 77;
            if (rk_mis(&C, T, form ? RK_RELAXED : RK_FROM_LAST, mem, numbers * sizeof *mem) < 0) continue;
            CHECK_INT(C.stages, T->stages + 1);
            for (i = 1; i <= C.stages; i++) {
                double sum = 0;
                for (j = 0; j < C.stages; j++) sum += C.W[(i - 1) * C.stages + j];
                if (i < T->stages) CHECK_NEAR(sum, T->c[i] - T->c[i - 1], 1e-14);
                if (i == T->stages) CHECK_NEAR(sum, 1 - last, 1e-14);
                if (i > T->stages) CHECK_NEAR(sum, T->bhat ? 1 - last : 0, 1e-14);
            }
            pairs += T->bhat != NULL;
            for (k = numbers; k < 600; k++) CHECK(mem[k] == 77);
        }
    CHECK(pairs > 3);
}

/* Statuses that name what does not fit.  Halves that differ in e3 estimate errors of different orders.  Euler's method with a
   second slope that has no weight: a stage of the step, or one of the dense output. */
TEST(test_halves_and_outer_tables_that_do_not_fit)
{
    static const double A[4] = {0}, b[2] = {1, 0}, d[4] = {1, 0, 0, 0};
    static double mem[4000];
    const rk_table *dop853 = rk_find("dop853");
    const rk_table euler = table_with_dense(plain_table("euler", 2, 1, A, b, A), 1, b);
    rk_table X = *dop853;
    rk_coupling C;
    X.e3 = NULL;
    CHECK(rk_error_order(dop853) != rk_error_order(&X) && rk_check_imex(dop853, dop853, NULL) >= 0);
    ALL(RK_EOTHER, rk_check_imex(dop853, &X, NULL), rk_check_imex(&X, dop853, NULL),
        rk_extend(&X, rk_find("ars222i"), rk_find("ars222e"), 2, 0, mem, sizeof mem), /* two b */
        rk_check_imex(rk_find("dp5"), rk_find("rk4"), NULL), rk_check_imex(rk_find("rk4"), rk_find("ssp43"), NULL)); /* other claims */
        CHECK_INT(rk_mis(&C, rk_find("sdirk2"), RK_FROM_LAST, mem, sizeof mem), RK_EEXPLICIT);
    X = *rk_find("ark4i"); /* another claim of the dense output alone */
    CHECK_WITH(RK_EOTHER, rk_check_imex(rk_find("ark4e"), &X, NULL), X.dense_order--);
    X.c = NULL;
    CHECK(is_nan(rk_defect(rk_find("ark4e"), &X, RK_OF_STEP, 1)));
    CHECK_WITH(RK_OK, rk_check_imex(&euler, &X, NULL), X = euler);
    CHECK_WITH(RK_OK, rk_check(&X, NULL), X.stages = X.extra = 1);
    CHECK_INT(rk_check_imex(&euler, &X, NULL), RK_EOTHER);
    CHECK_WITH(RK_OK, rk_check(&X, NULL), X = euler, X.powers = 2, X.d = d);
    CHECK_INT(rk_check_imex(&euler, &X, NULL), RK_EOTHER);
}

/* c = (0, 1) and c = (0, 1/2): each half has order 2 alone by other weights, together they have not: sum b_i c_i is 1/4 */
TEST(test_halves_that_are_right_alone_and_wrong_together)
{
    static const double A[2][4] = {{0, 0, 1, 0}, {0, 0, 1. / 2, 0}}, c[2][2] = {{0, 1}, {0, 1. / 2}};
    static const double b[2][2] = {{1. / 2, 1. / 2}, {0, 1}}, d[2][4] = {{1, -1. / 2, 0, 1. / 2}, {1, -1, 0, 1}};
    static const double euler[2] = {1, 0};
    rk_table pair[2], dense[2];
    int i;
    for (i = 0; i < 2; i++) {
        dense[i] = table_with_dense(plain_table("half", 2, 1, A[i], b[i], c[i]), 2, d[i]);
        pair[i] = plain_table("half", 2, 1, A[i], euler, c[i]);
        CHECK_WITH(RK_OK, rk_check(&pair[i], NULL), pair[i].bhat = b[i], pair[i].order_hat = 2);
        CHECK_INT(rk_check(&dense[i], NULL), RK_OK);
    }
    CHECK_INT(rk_check_imex(&pair[0], &pair[1], NULL), RK_EPAIR);
    pair[0].bhat = pair[1].bhat = NULL, pair[0].order_hat = pair[1].order_hat = 0;
    CHECK_INT(rk_check_imex(&pair[0], &pair[1], NULL), RK_OK);
    CHECK_INT(rk_check_imex(&dense[0], &dense[1], NULL), RK_EDENSE);
}

/* Times off by more than rk_check allows: what rk_extend claims is less, and is accepted. */
TEST(test_a_stiff_order_that_the_times_miss)
{
    static const double off[4] = {3e-14, 1e-13, 1e-11, 1e-9};
    const rk_table *T;
    double mem[4000], c[64];
    rk_table late, X;
    int i, l, claims = 0;
    for (i = 0; (T = rk_tables() + i)->name; i++)
        for (l = 0; l < 4; l++) {
            late = *T;
            memcpy(c, T->c, (size_t)(T->stages + T->extra) * sizeof *c);
            c[T->stages - 1] += off[l];
            late.c = c;
            late.order = 1; /* what is left of it */
            late.order_hat = 0, late.bhat = late.e = late.e3 = NULL;
            if (rk_extend(&X, &late, NULL, T->order, 0, mem, sizeof mem) < 0) continue;
            claims += X.dense_stiff > 0;
            CHECK(rk_check(&X, NULL) >= 0);
        }
    CHECK(claims > 0);
}

/* An explicit slope at another time than t is f(t + c h, y), off the slow solution by lambda h: no stiff order. */
TEST(test_no_stiff_order_of_an_explicit_slope_ahead)
{
    static const double A[9] = {0, 0, 0, 0, 0, 0, 0.5, 0, 0.5}, b[3] = {1.5, -1, 0.5}, ahead[3] = {0, 0.5, 1}, now[3] = {0, 0, 1};
    rk_table T = table_with_dense(plain_table("by hand", 3, 1, A, b, ahead), 1, b), X;
    double mem[1000];
    CHECK_INT(rk_check(&T, NULL), RK_ROWSUM);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2);
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_UNBOUNDED);
    CHECK_INT(X.dense_stiff, 0);
    CHECK_WITH(RK_OK, rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), T.c = now);
    CHECK(X.dense_stiff >= 2);
    CHECK_INT(rk_check(&X, NULL), RK_OK);
}

/* dp5 with -0 in its last row is dp5: its end slope is not added again.  A row that is b at another time is no end slope. */
TEST(test_what_counts_as_the_end_slope)
{
    static const double A[9] = {0, 0, 0, 1, 0, 0, 0.5, 0.5, 0}, b[3] = {0.5, 0.5, 0}, c[3] = {0, 1, 0.25};
    const rk_table early = plain_table("row b at 1/4", 3, 2, A, b, c);
    rk_table T = *rk_find("dp5"), X, Y;
    double mem[1000], more[1000], minus[49];
    memcpy(minus, T.A, sizeof minus);
    CHECK(minus[6 * 7 + 1] == 0);
    CHECK_WITH(RK_OK, rk_extend(&X, rk_find("dp5"), NULL, 5, 2, mem, sizeof mem), minus[6 * 7 + 1] = -0., T.A = minus);
    CHECK_INT(rk_extend(&Y, &T, NULL, 5, 2, more, sizeof more), RK_OK);
    CHECK(X.extra == 2 && Y.extra == 2 && X.dense_order == 5 && Y.dense_order == 5);
    CHECK(memcmp(X.d, Y.d, (size_t)(9 * X.powers) * sizeof *X.d) == 0 && rk_check(&early, NULL) == RK_ROWSUM);
    CHECK(rk_extend(&X, &early, NULL, 3, 1, mem, sizeof mem) >= 0);
    CHECK(X.extra == 1 && X.c[3] == 1 && X.A[12] == 0.5 && X.A[13] == 0.5);
}

/* The step may not read a slope that is there for dense output only: rk_extend refuses what rk_check refuses. */
TEST(test_a_step_that_takes_an_extra_slope_is_not_extended)
{
    static const double A[4] = {0, 0, 1, 0}, b[2] = {0.5, 0.5}, c[2] = {0, 1};
    rk_table T = plain_table("one and one more", 1, 2, A, b, c), X, other = T;
    double mem[1000];
    T.extra = 1;
    ALL(RK_ETABLE, rk_check(&T, NULL), rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem));
    T = other = plain_table("two", 2, 2, A, b, c);
    CHECK_INT(rk_extend(&X, &T, &other, 0, 0, mem, sizeof mem), RK_OK);
    CHECK_WITH(RK_ETABLE, rk_extend(&X, &T, &other, 0, 0, mem, sizeof mem), other.powers = -1);
}

/* a_ii of 6e-5: |R| is 85 at y = 1.7e4, far above the points around the poles of common tables. */
TEST(test_growth_far_up_the_axis_is_seen)
{
    static const double A[9] = {5.8e-5, 0, 0, -0.139, 5.7e-5, 0, -7.9, 0.59, 8.31};
    double b[3], c[3], mem[1000], w[3], largest = 0;
    rk_table T, X;
    int i, j, n, status;
    for (i = 0; i < 3; i++) {
        b[i] = A[6 + i], c[i] = (A[3 * i] + A[3 * i + 1]) + A[3 * i + 2];
    }
    T = plain_table("small a_ii", 3, 1, A, b, c);
    status = rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem);
    CHECK(status >= 0);
    for (n = 0; n <= 16; n++)
        for (j = 0; j <= 100; j++) { /* k = (1 - iy A)^-1 1 by substitution, real and imaginary parts */
            const double y = 1e3 * pow(10, j / 50.);
            double u[3], v[3], re = 1, im = 0;
            CHECK(rk_weights(&X, n / 16., 0, w) >= 0);
            for (i = 0; i < 3; i++) {
                double p = 1, q = 0, g = y * A[4 * i];
                int l;
                for (l = 0; l < i; l++) {
                    p -= y * A[3 * i + l] * v[l];
                    q += y * A[3 * i + l] * u[l];
                }
                u[i] = (p - g * q) / (1 + g * g), v[i] = (q + g * p) / (1 + g * g);
                re -= y * w[i] * v[i];
                im += y * w[i] * u[i];
            }
            largest = fmax(largest, hypot(re, im));
        }
    CHECK(largest > 10); /* seen here: so it is not bounded */
    CHECK_INT(status, RK_UNBOUNDED);
}

/* A run of more steps than an int counts: the count stays, and so does the law. */
TEST(test_the_count_of_steps_has_an_end)
{
    rk_control C, D;
    double t = 0, h = 0.1, u = 0, g = 0.1;
    int i;
    C = control_by(8, 4);
    for (i = 0; i < 4; i++) CHECK_INT(rk_control_step(&C, 0.5, &t, &h), RK_OK);
    D = C, C.steps = INT_MAX, u = t, g = h;
    for (i = 0; i < 4; i++) {
        CHECK_INT(rk_control_step(&C, 0.1 * i + 0.2, &t, &h), RK_OK);
        CHECK_INT(rk_control_step(&D, 0.1 * i + 0.2, &u, &g), RK_OK);
        CHECK(h == g && C.steps == INT_MAX);
    }
}

TEST(test_claims_that_clash_are_refused)
{
    static const double A[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0}, takes[9] = {0, 0, 0, 1, 0, 1. / 4, 0, 0, 0};
    static const double b[3] = {1. / 2, 1. / 2, 0}, half[2] = {1. / 2, 0}, c[3] = {0, 1, 0}, large[3] = {131072, -131071, 0};
    static double zero[RK_STAGES_MAX * RK_STAGES_MAX], one[RK_STAGES_MAX] = {1}, mem[2 * RK_STAGES_MAX * RK_STAGES_MAX];
    double one_large[9] = {0};
    rk_table T = plain_table("heun", 2, 2, A, b, c), X = *rk_find("dop853");
    rk_coupling C;
    int k;
    CHECK_WITH(RK_OK, rk_check(&T, NULL), T.extra = 1);
    T.A = takes; /* the second stage, of the step, takes the slope of the third, of the dense output */
    CHECK_INT(rk_check(&T, NULL), RK_ETABLE);
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.A = A, T.order_hat = -1);
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.order_hat = 0, T.dense_order = -5);
    T.dense_order = 0;
    T.b = large; /* sum b_i = 1 in numbers of which 1e5 is the largest that can be proven */
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.order = 1);
    T.b = b, T.A = one_large;
    for (k = 0; k < 9; k++) { /* nor a coefficient of A, wherever it stands; of order 1 nothing else depends on it */
        if (k == 2 || k == 5) continue;
        CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), one_large[k] = 131072);
        CHECK_WITH(RK_ROWSUM, rk_check(&T, NULL), one_large[k] = 1e5);
        one_large[k] = 0;
    }
    CHECK_WITH(RK_ETABLE, rk_check(&X, NULL), X.order_hat = 2); /* the order of error^2/companion would be 1 */
    T = *rk_find("heun");
    T.b = half; /* sum b_i is 1/2: not even order 1 */
    X.name = "as it was";
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_ESTEP);
    CHECK(strcmp(X.name, "as it was") == 0);
    C = *rk_coupling_find("KW3");
    CHECK(is_nan(rk_defect_coupling(&C, RK_OF_DENSE, 1)));
    CHECK_WITH(RK_ETABLE, rk_check_coupling(&C, NULL), C.order_hat = -1);
    T = plain_table("long", RK_STAGES_MAX, 1, zero, one, zero); /* with the new y one too many for a coupling */
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_INT(rk_mis(&C, &T, RK_FROM_LAST, mem, sizeof mem), RK_EARG);
    CHECK_WITH(RK_OK, rk_mis(&C, &T, RK_FROM_LAST, mem, sizeof mem), T.stages = RK_STAGES_MAX - 1);
    CHECK(C.stages == RK_STAGES_MAX && C.order == 1);
}

/* Noersett's table with the k-th zero of its cubic for the diagonal. */
static void noersett(int k, double *A, double *b, double *c)
{
    const double pi = acos(-1.), g = (1 + 2 / sqrt(3.) * cos(pi / 18 + k * 2 * pi / 3)) / 2;
    b[0] = b[2] = 1 / (6 * (2 * g - 1) * (2 * g - 1)), b[1] = 1 - 2 * b[0];
    memset(A, 0, 9 * sizeof *A);
    A[0] = A[4] = A[8] = c[0] = g, A[3] = 1. / 2 - g, A[6] = 2 * g, A[7] = 1 - 4 * g, c[1] = 1. / 2;
    c[2] = 1 - g;
}

/* Noersett's three stages of order 4: order 4 asks for four powers and eight conditions of three weights, order 3 for four */
TEST(test_a_bounded_output_of_much_lower_order_is_found)
{
    double A[9], b[3], c[3], mem[400];
    rk_table T, X;
    noersett(0, A, b, c);
    T = plain_table("noersett", 3, 4, A, b, c);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_OK);
    CHECK_INT(X.dense_order, 2);
    CHECK_INT(rk_check(&X, NULL), RK_OK);
    CHECK_INT(rk_extend(&X, &T, NULL, 3, 0, mem, sizeof mem), RK_LESS);
    CHECK_INT(X.dense_order, 2);
    noersett(1, A, b, c); /* of order 4 as well, but not A-stable: nothing is bounded but at -infinity, for no row is explicit */
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_UNBOUNDED);
    CHECK_INT(X.dense_stiff, 2);
}

/* Claims that are one too high: no output of that order, an unbounded one of the order below, a bounded one below that. */
TEST(test_a_bounded_output_goes_before_a_higher_order)
{
    static const struct {
        const char *name;
        int claim, order;
    } row[] = {{"trapezoid", 3, 1}, {"esdirk4b", 5, 3}};
    static double mem[2000];
    size_t i;
    rk_table X;
    for (i = 0; i < 2; i++) {
        rk_table T = *rk_find(row[i].name);
        CHECK_WITH(RK_UNBOUNDED, rk_extend(&X, &T, NULL, T.order - 1, 0, mem, sizeof mem), T.order = row[i].claim);
        CHECK_INT(rk_extend(&X, &T, NULL, 0, 0, mem, sizeof mem), RK_OK);
        CHECK_INT(X.dense_order, row[i].order);
    }
}

/* ---- to the letter of the declarations ------------------------------------------------------------------------------ */

/* y' = 3 t^2: the dense output of rk4, of degree 3, is t^3 itself, its derivatives 3 t^2, 6 t, 6, 0, ... in time. */
TEST(test_every_derivative_of_a_cubic)
{
    const rk_table *T = rk_find("rk4");
    const double t0 = 0.5, h = 0.25;
    const double thetas[] = {1.5, 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, -1, 0.25, 0.5, 0.75, 1};
    enum { COUNT = 17, N = 3, LD = 5 };
    double y[N], k[4 * LD] = {0}, out[COUNT * LD], one[N];
    int i, l, r;
    for (l = 0; l < N; l++) y[l] = (l + 1) * t0 * t0 * t0;
    for (i = 0; i < 4; i++)
        for (l = 0; l < N; l++) k[i * LD + l] = (l + 1) * 3 * (t0 + T->c[i] * h) * (t0 + T->c[i] * h);
    for (r = 0; r <= 6; r++) {
        for (i = 0; i < COUNT * LD; i++) out[i] = 77;
        CHECK_INT(dense_many(T, COUNT, thetas, r, h, N, y, k, LD, out, LD), RK_EXTRAP); /* the first is outside, most are not */
        for (i = 0; i < COUNT; i++) {
            const double t = t0 + thetas[i] * h, cubic[] = {t * t * t, 3 * t * t, 6 * t, 6};
            CHECK_INT(dense(T, thetas[i], r, h, N, r ? NULL : y, k, LD, one), thetas[i] > 1 || thetas[i] < 0 ? RK_EXTRAP : RK_OK);
            for (l = 0; l < N; l++) CHECK_NEAR(out[i * LD + l], (l + 1) * (r < 4 ? cubic[r] : 0), 1e-13);
            for (l = 0; l < N; l++) CHECK_NEAR(one[l], (l + 1) * (r < 4 ? cubic[r] : 0), 1e-13);
            for (l = N; l < LD; l++) CHECK(out[i * LD + l] == 77);
        }
    }
    CHECK_INT(dense(T, 0.5, 1, 0, N, NULL, k, LD, one), RK_OK); /* a slope needs no h */
    CHECK_NEAR(one[0], 3 * (t0 + h / 2) * (t0 + h / 2), 0.1);
    CHECK_INT(dense(T, 0.5, 9, 1e-77, N, NULL, k, LD, one), RK_OK); /* beyond the degree: h^-8 is not asked for */
    CHECK(one[0] == 0 && one[1] == 0 && one[2] == 0);
    CHECK_INT(dense(T, 0.5, 5, 1e-103, N, NULL, k, LD, one), RK_EARG);
}

/* theta within 4 DBL_EPSILON of an end is that end; what is refused, and that nothing is written then. */
TEST(test_weights_at_the_ends_and_what_dense_output_refuses)
{
    const double off = 4 * DBL_EPSILON, b[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6}, later[] = {0.5, nan("")};
    const double nine[9] = {0.5};
    const rk_table *T = rk_find("rk4");
    rk_table bad = *T;
    double w[4], y[2] = {1, 1}, k[8], out[4] = {7, 7, 7, 7};
    rk_step step;
    int i;
    CHECK_INT(rk_weights(T, off, 0, w), RK_OK);
    for (i = 0; i < 4; i++) CHECK(w[i] == 0);
    CHECK_INT(rk_weights(T, 1 + off, 0, w), RK_OK);
    for (i = 0; i < 4; i++) CHECK(w[i] == b[i]);
    CHECK_INT(rk_weights(T, -off, 1, w), RK_OK);
    ALL(RK_EXTRAP, rk_weights(T, 1 + 2 * off, 0, w), rk_weights(T, -2 * off, 0, w));
    CHECK_INT(rk_weights(NULL, 0.5, 0, w), RK_ENULL);
    CHECK_WITH(RK_ENODENSE, rk_weights(&bad, 0.5, 0, w), bad.powers = 0);
    CHECK_WITH(RK_EARG, rk_weights(&bad, 0.5, 0, w), bad.stages = 0);
    for (i = 0; i < 8; i++) k[i] = 1;
    ALL(RK_ENULL, rk_dense(NULL, 0.5, 0, out), rk_dense_many(NULL, 0, 1, later, out, 2));
    step = step_of(&bad, 1, 2, y, k, 2);
    ALL(RK_EARG, rk_dense(&step, 0.5, 0, out), rk_dense_many(&step, 0, 1, later, out, 2));
    ALL(RK_ENULL, dense(NULL, 0.5, 0, 1, 2, y, k, 2, out), dense(T, 0.5, 0, 1, 2, NULL, k, 2, out));
    CHECK_INT(dense_many(T, 0, NULL, 0, 1, 2, y, k, 2, NULL, 2), RK_OK); /* no theta */
    CHECK_INT(dense_many(T, 9, nine, 0, 1, 0, NULL, NULL, 0, NULL, 5), RK_OK); /* no numbers */
    CHECK_INT(dense_many(T, 2, later, 0, 1, 2, y, k, 2, out, 2), RK_ENAN); /* the first theta would do */
    for (i = 0; i < 4; i++) CHECK(out[i] == 7);
    CHECK_WITH(RK_NONFINITE, dense(T, 0.5, 0, 1, 2, y, k, 2, out), k[2] = HUGE_VAL); /* of all statuses the gravest */
    CHECK_INT(dense(T, 2, 0, 1, 2, y, k, 2, out), RK_NONFINITE);
    CHECK_INT(dense_many(T, 2, b, 0, 1, 2, y, k, 2, out, 2), RK_NONFINITE);
}

/* Whichever sum of rk_update and whichever block of it is not finite: it is said. */
TEST(test_rk_update_reports_each_of_its_sums)
{
    enum { N = 9000 };
    static const int at[] = {0, 5000, 8999};
    static double y[N], k[7 * N], ynew[N], err[N];
    const rk_table *T = rk_find("dp5");
    size_t i;
    for (i = 0; i < sizeof at / sizeof *at; i++) {
        CHECK_WITH(RK_NONFINITE, rk_update(T, 0.1, N, y, k, N, ynew, err), y[at[i]] = HUGE_VAL); /* err does not read y */
        CHECK_INT(rk_update(T, 0.1, N, y, k, N, NULL, err), RK_OK);
        y[at[i]] = 0;
        k[6 * N + at[i]] = HUGE_VAL; /* b_7 = 0: only err reads it */
        CHECK_INT(rk_update(T, 0.1, N, y, k, N, ynew, err), RK_NONFINITE);
        CHECK_INT(rk_update(T, 0.1, N, y, k, N, ynew, NULL), RK_OK);
        k[6 * N + at[i]] = 0;
    }
    CHECK_INT(rk_update(T, 0.1, N, y, k, N, ynew, err), RK_OK);
}

TEST(test_the_order_of_an_estimate)
{
    static const double zero[4] = {0};
    static const struct {
        int order, order_hat, companion, estimate;
    } row[] = {{5, 4, 0, 4}, {2, 3, 0, 2}, {3, 3, 0, 3}, {8, 5, 1, 7}, {2, 3, 1, 3}, {5, 2, 1, 2}, {1, 1, 0, 1}};
    rk_control C;
    size_t i;
    for (i = 0; i < sizeof row / sizeof *row; i++) {
        rk_table T = plain_table("estimate", 2, row[i].order, zero, zero, zero);
        T.bhat = zero, T.order_hat = row[i].order_hat, T.e3 = row[i].companion ? zero : NULL;
        CHECK_INT(rk_error_order(&T), row[i].estimate);
        CHECK_INT(rk_control_make(&C, "I", &T), RK_OK);
        CHECK(C.order == row[i].estimate);
        CHECK_WITH(row[i].estimate == 7 || row[i].companion * row[i].order_hat == 3 ? RK_OK : RK_EARG,
                   rk_control_make(&C, "I", &T), T.order = 0);
        T.order_hat = 0; /* no embedded weights, whatever bhat says */
        ALL(RK_ENOPAIR, rk_error_order(&T), rk_control_make(&C, "I", &T));
        CHECK_WITH(RK_EARG, rk_error_order(&T), T.stages = 0);
    }
}

/* Whatever the memory held; errors at their limits; steps as small as a number can be. */
TEST(test_the_small_print_of_the_control)
{
    const rk_table *T = rk_find("bs3"); /* order 2: powers of 1/3 */
    const unsigned char *byte;
    rk_control C, off;
    double t = 0, h = 1;
    size_t i;
    memset(&C, 77, sizeof C);
    CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
    off = C;
    memset(&off, 0, offsetof(rk_control, smallest));
    off.order = 0;
    for (byte = (const unsigned char *)&off, i = 0; i < sizeof off; i++) CHECK(byte[i] == 0);
    CHECK_INT(rk_control_step(&C, 1, &t, &h), RK_OK); /* an error of 1 is within the tolerance */
    CHECK_NEAR(h, 0.9, 1e-15);
    h = 1;
    CHECK_INT(rk_control_step(&C, 0, &t, &h), RK_OK); /* no error at all enters the history as 1e-4 */
    h = 1;
    CHECK_INT(rk_control_step(&C, 0.5, &t, &h), RK_OK);
    CHECK_NEAR(h, 0.9 * pow(0.5, -0.8 / 3) * pow(1e-4, 0.31 / 3), 1e-14);
    CHECK_WITH(RK_REJECT, rk_control_step(&C, HUGE_VAL, &t, &h), C.accept = HUGE_VAL); /* every error that is finite */
    C = control_by(6, 2); /* ratios of steps of both directions */
    for (h = 1, i = 0; i < 3; i++) {
        h = i % 2 ? -1 : 1;
        CHECK_INT(rk_control_step(&C, 0.5, &t, &h), RK_OK);
    }
    CHECK_NEAR(h, 0.9 * pow(0.5, -1. / 3), 1e-14); /* k_0 + k_1 + k_2 = 1 */
#ifndef FAST_MATH /* which takes the smallest numbers for 0 */
    CHECK_INT(rk_control_make(&C, "I", T), RK_OK);
    CHECK_WITH(RK_OK, rk_control_step(&C, 1e9, &t, &h), C.accept = HUGE_VAL, t = 0, h = 5e-324);
    CHECK(h == (double)5e-324 && t == (double)5e-324);
#endif
}

/* A rest of up to 1.01 steps is one step; of less than two it is two equal ones. */
TEST(test_the_last_steps_before_a_stop)
{
    static const struct {
        double rest, h, wanted;
    } row[] = {{0.5, 0.5, 1}, {1, 1, 1}, {1 + 2 * DBL_EPSILON, 1 + 2 * DBL_EPSILON, 1}, {1.0078125, 1.0078125, 1},
               {1.015625, 0.5078125, 1}, {1.5, 0.75, 1}, {2, 1, 0}, {3, 1, 0}};
    rk_control C;
    double t, h;
    size_t i;
    int sign;
    for (i = 0; i < sizeof row / sizeof *row; i++)
        for (sign = -1; sign <= 1; sign += 2) {
            CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
            h = sign;
            STOP(sign * row[i].rest, 0, h == sign * row[i].h && C.wanted == sign * row[i].wanted);
            CHECK_INT(rk_control_stop(&C, 5, 5, &h), RK_PASSED); /* there already */
            CHECK(is_nan(C.stop));                               /* nor does a step of the other sign meet it */
            CHECK(h == sign && C.wanted == 0);
        }
    CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
    C.stop = 0;
    for (i = 0; i < 2; i++) { /* the end of a step that misses the stop time by an ulp of its begin, or by more */
        t = -1, h = i ? 1 + 1e-14 : 1 + 2 * DBL_EPSILON;
        STEP(0.5, RK_OK, i ? t > 9e-15 : t == 0);
    }
    for (sign = -1; sign <= 1; sign += 2) { /* ahead in the direction of h, or not */
        const double stops[] = {2, 0, 1, HUGE_VAL, nan("")};
        CHECK_INT(rk_control_make(&C, "I", rk_find("dp5")), RK_OK);
        for (i = 0; i < 5; i++) {
            h = 0.5 * sign;
            CHECK_INT(rk_control_stop(&C, stops[i], 1, &h), i > 2 || (i == 0 && sign > 0) || (i == 1 && sign < 0) ? RK_OK : RK_PASSED);
            CHECK(h == 0.5 * sign && C.start == 1);
        }
    }
}

/* ---- t and y together; the side of a jump -------------------------------------------------------------------------------- */

/* A sum with twice the digits. */
typedef struct exact_sum {
    double high, low;
} exact_sum;

static void add_exactly(exact_sum *s, double x)
{
    volatile double sum = s->high + x, back = sum - s->high; /* volatile: -ffast-math would drop the rest */
    volatile double other = sum - back;
    s->low += (s->high - other) + (x - back);
    s->high = sum;
}

static double spacing(double t)
{
    return nextafter(fabs(t), HUGE_VAL) - fabs(t);
}

/* One run of up to 12 intervals with random stop times, errors and sizes, from any t0 in any direction: what has been added
   to y, the sum of all h, is t - t0; no stage of c <= 1 lies beyond the stop time, none by rk_time on it, nor on the start. */
static void random_run(const rk_table *T, double t0, double sign)
{
    const double size = ensemble_random() < 0.5 ? spacing(t0) * (1 + 20 * ensemble_random())
                                                 : fmax(spacing(t0), 1e-9 + fabs(t0) * pow(10, -12 * ensemble_random()));
    double t = t0, h = sign * size, stop, start, moved = 0;
    exact_sum sum = {0, 0}, passed = {0, 0};
    rk_control C;
    int part, steps, i;
    CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
    if (ensemble_random() < 0.7) C.largest = size;
    for (part = 0; part < 12; part++) {
        const double far = size * (ensemble_random() < 0.5 ? (int)(1 + 10 * ensemble_random()) : 12 * ensemble_random());
        volatile double next = t + sign * far;
        stop = next, start = t;
        if (stop == t) continue;
        CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK);
        for (steps = 0; t != stop && steps < 2000; steps++) {
            const double error = (ensemble_random() < 0.2 ? 20 : 1) * ensemble_random() * pow(fabs(h) / size, C.order + 1);
            const double t1 = t, h1 = h;
            for (i = 0; i < T->stages; i++) {
                volatile double time = t + T->c[i] * h;
                const double asked = rk_time(&C, T->c[i], t, h);
                if (T->c[i] > 1) continue;
                if (sign * time > sign * stop) fail_msg("%s, t %.17g, h %.17g: stage %d beyond %.17g", T->name, t, h, i, stop);
                if (fabs(stop - start) < 4 * spacing(stop)) continue; /* start and stop are neighbours: nothing is between */
                if (!(sign * asked < sign * stop && sign * asked > sign * start))
                    fail_msg("%s, t %.17g, h %.17g: stage %d asks at %.17g", T->name, t, h, i, asked);
                if (!(fabs(asked - time) <= fmax(DBL_EPSILON * fabs(h), 2 * fmax(spacing(start), spacing(stop))))) fail_msg("%.17g for %.17g", asked, time);
            }
            i = rk_control_step(&C, error, &t, &h);
            if (i < 0) return; /* an error too large for the smallest step */
            if (i == RK_REJECT) continue;
            add_exactly(&sum, h1);
            moved += fabs(h1);
            if (fabs((t - t1) - h1) > DBL_EPSILON * (fabs(h1) + fabs(t1 < h1 ? t1 : 0)))
                fail_msg("%s: t from %.17g to %.17g by h %.17g", T->name, t1, t, h1);
        }
        if (t != stop) fail_msg("%s from %.17g: t %.17g, h %.3g, stop %.17g after %d steps", T->name, t0, t, h, stop, steps);
    }
    add_exactly(&passed, t), add_exactly(&passed, -t0);
    if (!(fabs((sum.high - passed.high) + (sum.low - passed.low)) <= DBL_EPSILON * moved))
        fail_msg("%s from %.17g: t has moved by %.17g, y by %.17g", T->name, t0, passed.high, sum.high);
}

TEST(test_the_sum_of_all_steps_is_the_time_that_has_passed)
{
#ifdef FAST_MATH
    return; /* the exact sum of the test is none there */
#endif
    static const char *const names[] = {"dp5", "dop853", "esdirk5", "radau5", "esdirk4", "ss4"};
    int run;
    ensemble_state = 4711;
    for (run = 0; run < 12000 / LESS; run++) {
        const double t0 = run % 10 == 0 ? 0 : pow(10, -3 + 16 * ensemble_random());
        random_run(rk_find(names[run % 6]), run % 3 ? t0 : -t0, run % 2 ? 1 : -1);
    }
}

/* Stops that are a few spacings of t apart, and steps of that size: y' = 1. */
TEST(test_frequent_stops_at_large_times)
{
    static const struct {
        double t0, h, every;
        int n;
    } row[] = {{1.7e9, 1e-6, 1e-5, 1000}, {1.7e9, 1e-6, 1e-4, 100}, {1.7e9, 1e-6, 2e-6, 5000}, {86400, 5e-11, 1e-9, 1000},
               {2460000.5, 2e-9, 1e-8, 1000}, {1.7e9, 1e-4, 1e-3, 100}, {0, 1e-6, 1e-5, 1000}};
    double worst = 0;
    size_t q;
    int j;
    for (q = 0; q < sizeof row / sizeof *row; q++) {
        double t = row[q].t0, h = row[q].h, y = 0;
        rk_control C;
        CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
        C.largest = row[q].h;
        for (j = 1; j <= row[q].n; j++) {
            const double stop = row[q].t0 + j * row[q].every;
            if (!(stop > t)) continue;
            CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK);
            while (t < stop) {
                const double last = h;
                CHECK_INT(rk_control_step(&C, 1e-9, &t, &h), RK_OK);
                y += last;
            }
        }
        if (!(fabs(y / (t - row[q].t0) - 1) < 1e-11)) fail_msg("row %d: y %.17g, t - t0 %.17g", (int)q, y, t - row[q].t0);
        if (row[q].t0 >= 1.7e9) worst = fmax(worst, fabs(y / (t - row[q].t0) - 1));
    }
    EXTREME("Unix time, steps of a microsecond, a stop after every 2 to 100 of them",
            "each stop is met to the bit; y of y' = 1 is off by %.1g of the time that has passed", worst);
}

/* Stop times written as decimal text, with 12 digits: one step each where `largest` is their distance. */
TEST(test_stops_of_twelve_digits_cost_one_step_each)
{
    double t = 0, h = 1e-3;
    int j, n = 0;
    rk_control C;
    CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
    C.largest = 1. / 700;
    for (j = 1; j <= 700; j++) {
        char text[40];
        sprintf(text, "%.6g", j / 700.);
        CHECK_INT(rk_control_stop(&C, atof(text), t, &h), RK_OK);
        for (; t != atof(text); n++) CHECK_INT(rk_control_step(&C, 1e-6, &t, &h), RK_OK);
    }
    CHECK(n <= 701);
}

/* y' = -y + (jump), which 1000 is added to from t = 1 on, asked by < or <=; a stiff part by Newton's formula. */
enum { PLAIN, BY_TIME, TOLD }; /* f asked at t + c h, at rk_time; told on which side of the jump it is */
typedef struct jumping {
    int includes; /* whether t = 1 belongs to what is before */
    double sign;  /* of the direction of time */
    int way, part;
} jumping;

static double jump_slope(const jumping *J, double t, double y)
{
    const double s = J->sign * t;
    int before = J->includes ? s <= 1 : s < 1;
    if (J->way == TOLD) before = J->part == 1;
    return J->sign * (-y + (before ? 0 : 1e3));
}

/* Steps to t = 2, with a stop at the jump; *off: the error in tolerances. */
static int steps_over_a_jump(const rk_table *T, jumping *J, double *off)
{
    const int by_time = J->way == BY_TIME;
    const double tol = 1e-6, exact = exp(-2.) + 1e3 * (1 - exp(-1.));
    const int m = T->stages + T->extra;
    double k[RK_STAGES_MAX], z, y = 1, ynew, err, t = 0, h = 1e-3 * J->sign;
    rk_control C;
    int steps = 0, part, i;
    CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
    for (part = 1; part <= 2; part++) {
        const double stop = J->sign * part;
        J->part = part;
        CHECK_INT(rk_control_stop(&C, stop, t, &h), RK_OK);
        k[0] = jump_slope(J, by_time ? rk_time(&C, 0, t, h) : t, y);
        while (t != stop && steps < 1000) {
            double sum[2] = {0}, third[2] = {0}, e;
            for (i = 1; i < T->stages; i++) {
                const double ti = by_time ? rk_time(&C, T->c[i], t, h) : t + T->c[i] * h, g = h * T->A[i * m + i];
                rk_stage(T, i, h, 1, &y, k, 1, &z);
                k[i] = jump_slope(J, ti, z) / (1 + J->sign * g);
            }
            rk_update(T, h, 1, &y, k, 1, &ynew, &err);
            rk_norm(tol, tol, NULL, 1, &err, &y, &ynew, sum);
            e = rk_rms(sum);
            if (T->e3) {
                rk_combine(h, T->stages, T->e3, 1, NULL, k, 1, &z);
                rk_norm(tol, tol, NULL, 1, &z, &y, &ynew, third);
                e = rk_combined_error(e, rk_rms(third));
            }
            i = rk_control_step(&C, e, &t, &h);
            CHECK(i >= 0);
            if (i == RK_REJECT) continue;
            steps++;
            y = ynew;
            if (t != stop) k[0] = rk_is(T, RK_FSAL) ? k[T->stages - 1] : jump_slope(J, by_time ? rk_time(&C, 0, t, h) : t, y);
        }
    }
    *off = fabs(y - exact) / (tol + tol * exact);
    return steps;
}

/* The steps and the error of a host that tells f its segment. */
TEST(test_a_step_sees_one_side_of_a_jump)
{
    static const char *const names[] = {"bs3", "ss4", "dp5", "tsit5", "verner6", "dop853", "trbdf2", "esdirk3", "esdirk4b", "esdirk5", "ark4i"};
    size_t q;
    int way;
    for (q = 0; q < sizeof names / sizeof *names; q++)
        for (way = 0; way < 4; way++) {
            jumping J = {way % 2, way < 2 ? 1 : -1, TOLD, 0};
            double off, off_told;
            const int told = steps_over_a_jump(rk_find(names[q]), &J, &off_told);
            J.way = BY_TIME;
            CHECK_INT(steps_over_a_jump(rk_find(names[q]), &J, &off), told);
            CHECK_NEAR(off, off_told, 1e-3 * (1 + off_told));
        }
    { /* what the function is for */
        jumping J = {0, 1, PLAIN, 0};
        double off;
        CHECK(steps_over_a_jump(rk_find("dp5"), &J, &off) > 60);
        J.way = BY_TIME;
        CHECK(steps_over_a_jump(rk_find("dp5"), &J, &off) < 15);
    }
}

/* DETEST F2: y' = 55 - 1.5 y where the whole part of t is even, 55 - 0.5 y where it is odd; stops at whole t. */
TEST(test_DETEST_F2_in_as_many_steps_as_the_problem_has)
{
    static const struct {
        const char *name;
        int most;
    } row[] = {{"dp5", 120}, {"dop853", 70}, {"verner6", 120}};
    size_t q;
    for (q = 0; q < sizeof row / sizeof *row; q++) {
        const rk_table *T = rk_find(row[q].name);
        double k[RK_STAGES_MAX], z, y = 110, ynew, err, t = 0, h = 0.01, exact = 110;
        rk_control C;
        int steps = 0, part, i;
        CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
        for (part = 1; part <= 20; part++) {
            const double rate = part % 2 ? 1.5 : 0.5;
            CHECK_INT(rk_control_stop(&C, part, t, &h), RK_OK);
            exact = 55 / rate + (exact - 55 / rate) * exp(-rate);
            while (t != part) {
                double sum[2] = {0};
                for (i = 0; i < T->stages; i++) {
                    const double ti = rk_time(&C, T->c[i], t, h);
                    rk_stage(T, i, h, 1, &y, k, 1, &z);
                    k[i] = 55 - (fmod(floor(ti), 2) == 0 ? 1.5 : 0.5) * z;
                }
                rk_update(T, h, 1, &y, k, 1, &ynew, &err);
                rk_norm(1e-6, 1e-6, NULL, 1, &err, &y, &ynew, sum);
                i = rk_control_step(&C, rk_rms(sum), &t, &h);
                CHECK(i >= 0);
                if (i == RK_OK) y = ynew, steps++;
            }
        }
        if (steps > row[q].most) fail_msg("%s: %d steps", T->name, steps);
        CHECK_NEAR(y, exact, 1e-6 * (1 + exact) * 5);
    }
}

/* IMEX, y' = fE + fI with a jump of fE at a stop, and a fast solve of a multirate step that ends there: both halves ask at
   one time, and the inner control has the stop of its own interval. */
TEST(test_halves_and_inner_solves_see_one_side_of_a_jump)
{
    const rk_table *E = rk_find("ark4e"), *I = rk_find("ark4i"), *T = rk_find("dp5");
    const double tol = 1e-6;
    double y = 1, t = 0, h = 1e-3, exact = 1;
    rk_control C;
    int part, i, steps = 0;
    CHECK_INT(rk_control_make(&C, "PI", I), RK_OK);
    for (part = 1; part <= 2; part++) { /* fI = -y, fE = 0, then 1000 */
        CHECK_INT(rk_control_stop(&C, part, t, &h), RK_OK);
        exact = (part - 1) * 1e3 + (exact - (part - 1) * 1e3) * exp(-1.);
        while (t != part && steps < 1000) {
            double kE[8], kI[8], base, ynew, errE, errI, sum[2] = {0};
            for (i = 0; i < E->stages; i++) {
                const double g = h * I->A[i * I->stages + i], ti = rk_time(&C, E->c[i], t, h);
                rk_stage(E, i, h, 1, &y, kE, 1, &base);
                rk_stage(I, i, h, 1, &base, kI, 1, &base);
                kI[i] = -base / (1 + g);
                kE[i] = ti < 1 ? 0 : 1e3;
            }
            rk_update(E, h, 1, &y, kE, 1, &ynew, &errE);
            rk_update(I, h, 1, &ynew, kI, 1, &ynew, &errI);
            errE += errI;
            rk_norm(tol, tol, NULL, 1, &errE, &y, &ynew, sum);
            i = rk_control_step(&C, rk_rms(sum), &t, &h);
            CHECK(i >= 0);
            if (i == RK_OK) y = ynew, steps++;
        }
    }
    CHECK(steps < 40); /* hundreds by t + c h */
    CHECK_NEAR(y, exact, 100 * tol * exact);
    for (i = 0; i < 2; i++) { /* an outer step from .5 to 1, inner intervals of a third of it: no slope at 1, by < or <= */
        double inner_t, inner_h = 0.01, k[7], z, v = 0;
        rk_control F;
        CHECK_INT(rk_control_make(&F, "PI", T), RK_OK);
        for (inner_t = 0.5, part = 1; part <= 3; part++) {
            const double end = part == 3 ? 1. : 0.5 + part * 0.5 / 3;
            int l, count = 0;
            CHECK_INT(rk_control_stop(&F, end, inner_t, &inner_h), RK_OK);
            while (inner_t != end && count++ < 1000) {
                for (l = 0; l < T->stages; l++) {
                    const double ti = rk_time(&F, T->c[l], inner_t, inner_h);
                    rk_stage(T, l, inner_h, 1, &v, k, 1, &z);
                    k[l] = (i ? ti <= 1 : ti < 1) ? 1. : 1e6;
                }
                rk_update(T, inner_h, 1, &v, k, 1, &v, NULL);
                CHECK_INT(rk_control_step(&F, 0.1, &inner_t, &inner_h), RK_OK);
            }
        }
        CHECK_NEAR(v, 0.5, 1e-13);
    }
}

/* rk_time by its words. */
TEST(test_the_time_to_ask_f_at)
{
    const double bad = nan("");
    rk_control C;
    double h = 0.25, t = 1;
    CHECK(rk_time(NULL, 0.5, 1, 0.25) == 1.125 && rk_time(NULL, 1, 1, 0.25) == 1.25);
    CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
    CHECK(rk_time(&C, 1, 1, 0.25) == 1.25 && rk_time(&C, 0, 1, 0.25) == 1); /* no stop, no start */
    CHECK_INT(rk_control_stop(&C, 1.25, t, &h), RK_OK);
    CHECK(rk_time(&C, 0, 1, 0.25) == nextafter(1, 2) && rk_time(&C, 1, 1, 0.25) == nextafter(1.25, 1));
    CHECK(rk_time(&C, 0.5, 1, 0.25) == 1.125 && rk_time(&C, 1.04, 1, 0.25) == 1.26);
    CHECK(is_nan(rk_time(&C, bad, 1, 0.25)) && is_nan(rk_time(&C, 1, bad, 0.25)) && is_nan(rk_time(&C, 1, 1, bad)));
    STEP(0.5, RK_OK, t == 1.25);
    CHECK(rk_time(&C, 0, t, h) == 1.25); /* whose side it is the next rk_control_stop says */
    CHECK(rk_time(&C, 1, 1, 0.25) == nextafter(1.25, 1)); /* of the step before, for its extra stages */
    STOP(2, t, rk_time(&C, 0, t, h) == nextafter(1.25, 2));
    CHECK_INT(rk_control_make(&C, "PI", rk_find("dp5")), RK_OK);
    h = -0.5;
    CHECK_INT(rk_control_stop(&C, 0, 0.5, &h), RK_OK); /* backwards, to 0 */
    CHECK(rk_time(&C, 0, 0.5, h) == 0.5 - 0.5 * DBL_EPSILON && rk_time(&C, 1, 0.5, h) == 0.5 * DBL_EPSILON);
}

/* ---- Radau IIA with its pair --------------------------------------------------------------------------------------------- */

/* radau5 and radau9 behind stage 0 are the generated tables; err is Hairer's: h gamma (u'(t) - f(t, y)), and for 3 stages in
   offsets z the published (-13 - 7 sqrt 6, -13 + 7 sqrt 6, -1)/3 gamma. */
TEST(test_radau_and_its_pair)
{
    static const char *const names[] = {"radau5", "radau9"};
    const double r6 = sqrt(6.), published[] = {(-13 - 7 * r6) / 3, (-13 + 7 * r6) / 3, -1. / 3};
    double mem[100], k[6], y = 1, err, slope;
    int q, i, j, l;
    for (q = 0; q < 2; q++) {
        const rk_table *T = rk_find(names[q]);
        const int s = 3 + 2 * q, m = s + 1;
        rk_table G;
        rk_step step = step_of(T, 0.3, 1, &y, k, 1);
        CHECK_INT(rk_collocation(&G, RK_RADAU_IIA, s, mem, sizeof mem), RK_OK);
        CHECK(T->stages == m && T->order == G.order && T->powers == s && T->order_hat == s);
        for (i = 0; i < s; i++) {
            CHECK_NEAR(T->c[i + 1], G.c[i], 2e-16);
            CHECK_NEAR(T->b[i + 1], G.b[i], 2e-16);
            for (j = 0; j < s; j++) CHECK_NEAR(T->A[(i + 1) * m + j + 1], G.A[i * s + j], 2e-16);
            for (j = 0; j < s; j++) CHECK_NEAR(T->d[(i + 1) * s + j], G.d[i * s + j], 1e-13);
        }
        for (l = 0; l < 100; l++) {
            for (i = 0; i < m; i++) k[i] = cos(7. * l + 3 * i);
            CHECK_INT(rk_update(T, 0.3, 1, &y, k, 1, NULL, &err), RK_OK);
            CHECK_INT(rk_dense(&step, 0, 1, &slope), RK_OK);
            CHECK_NEAR(err, 0.3 * T->bhat[0] * (slope - k[0]), 1e-15);
        }
        { /* gamma is an eigenvalue of A: det(A - gamma I) = 0 by elimination */
            double S[25], x[5] = {0};
            for (i = 0; i < s * s; i++) S[i] = G.A[i] - (i / s == i % s) * T->bhat[0];
            CHECK_INT(rkp__eliminate(s, S, x), 0);
        }
    }
    for (j = 0; j < 3; j++) {
        const rk_table *T = rk_find("radau5");
        double sum = 0;
        for (i = 0; i < 3; i++) sum += T->bhat[0] * published[i] * T->A[(1 + i) * 4 + 1 + j];
        CHECK_NEAR(T->bhat[1 + j] - T->b[1 + j], sum, 1e-15);
    }
}

/* Sizes: seven matrices m by m, two of m rows of powers, seven vectors; names and claims of all generated tables. */
TEST(test_sizes_and_names_of_generated_tables)
{
    static const char *const names[] = {"gauss", "radauIIA", "lobattoIIIA", "lobattoIIIB", "lobattoIIIC"};
    double mem[400];
    rk_table T;
    int family, s;
    CHECK(rk_extend_size(1, 0) == (7 + 6 + 7) * sizeof(double) && rk_extend_size(2, 3) == (28 + 12 + 14) * sizeof(double));
    CHECK(rk_extend_size(5, 4) == (175 + 40 + 35) * sizeof(double) && rk_extend_size(64, 10) == (7 * 4096 + 1280 + 448) * sizeof(double));
    CHECK(rk_extend_size(1, -1) == 0 && rk_extend_size(-1, 3) == 0 && rk_collocation_size(0) == 0 && rk_collocation_size(6) == 0);
    for (family = 0; family < 5; family++)
        for (s = family < 2 ? 1 : 2; s <= 5; s++) {
            const size_t length = strlen(names[family]);
            memset(&T, 77, sizeof T);
            CHECK_INT(rk_collocation(&T, RK_GAUSS + family, s, mem, rk_collocation_size(s)), RK_OK);
            CHECK(strncmp(T.name, names[family], length) == 0 && T.name[length] == '0' + s && T.name[length + 1] == 0);
            CHECK(rk_collocation_size(s) == (size_t)(2 * s * s + 2 * s + 2) * sizeof(double));
            CHECK(T.stages == s && T.powers == s && T.extra == 0 && T.order_hat == 0 && T.dense_stiff == 0);
            CHECK(!T.bhat && !T.e && !T.e3 && rk_check(&T, NULL) >= 0);
        }
    CHECK_INT(rk_collocation(&T, RK_GAUSS - 1, 2, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIC + 1, 2, mem, sizeof mem), RK_EARG);
}

/* Residuals by hand, in units of the terms: sum b_i c_i of 3/2 and -1; what is missing to 1 where the terms are less than that. */
TEST(test_defects_in_units_of_their_terms)
{
    const double zero[4] = {0}, A[4] = {0, 0, -1. / 2, 0}, b[2] = {2, -1}, c[2] = {3. / 4 + 1e-9, 1}, half[1] = {1. / 2};
    rk_table T = plain_table("apart", 2, 2, A, b, c);
    CHECK_NEAR(rk_defect(&T, NULL, RK_OF_STEP, 2), 2e-9 / 2.5, 1e-15);
    T = plain_table("half", 1, 1, zero, half, zero);
    CHECK_NEAR(rk_defect(&T, NULL, RK_OF_STEP, 1), 1. / 2, 1e-15);
    T.b = zero;
    CHECK_NEAR(rk_defect(&T, NULL, RK_OF_STEP, 1), 1, 1e-15);
    T.d = half;
    CHECK(is_nan(rk_defect(&T, NULL, RK_OF_DENSE, 1))); /* no powers of it */
}

/* Forms for which no stiff order is claimed, though their numbers would pass: no implicit stage, a pole in the left half-plane,
   coupled stages, theta^2 missing; the trapezoidal rule with the quadratic output, whose z theta^2 grows with z. */
TEST(test_forms_without_a_stiff_order)
{
    const double zero[1] = {0}, one[2] = {1, 0}, coupled[4] = {3, 3, 1, 1}, times[2] = {6, 2}, minus[1] = {-1};
    const double poles[4] = {1, -3, 1, -2}, at_poles[2] = {-2, -1};
    const double falls[4] = {-4.2, 0, -0.7, 3.9}, row_sums[2] = {-4.2, 3.2}, weights[2] = {0.3, 0.7};
    const double trapezoid[4] = {0, 0, 0.5, 0.5}, ends[2] = {0, 1}, quadratic[4] = {1, -0.5, 0, 0.5};
    double mem[200];
    rk_table X;
    rk_table T = table_with_dense(plain_table("euler", 1, 1, zero, one, zero), 1, one);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2);
    T = table_with_dense(plain_table("forward from the end", 1, 1, minus, one, minus), 1, one);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2); /* R = 1 + z theta/(1 + z) has its pole at z = -1 */
    T = plain_table("a pole at z = -1/4.2", 2, 1, falls, weights, row_sums);
    CHECK_INT(rk_extend(&X, &T, NULL, 1, 0, mem, sizeof mem), RK_UNBOUNDED);
    CHECK_INT(X.dense_stiff, 0);
    T = table_with_dense(plain_table("coupled, singular", 2, 1, coupled, one, times), 1, one);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2);
    T = table_with_dense(plain_table("coupled, eigenvalues -1/2 +- i", 2, 1, poles, one, at_poles), 1, one);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2);
    T = table_with_dense(plain_table("backward Euler of a frozen time", 1, 1, one, one, zero), 1, one);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2); /* theta^1 needs a c that is the row sums */
    T = table_with_dense(plain_table("trapezoid", 2, 2, trapezoid, trapezoid + 2, ends), 2, quadratic);
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_WITH(RK_EDENSE, rk_check(&T, NULL), T.dense_stiff = 2);
}

/* A companion is a difference of weights of order 3.  Its order 2 q - 3 asks for a pair of order 3 at least. */
TEST(test_companions_are_checked)
{
    double companion[12] = {0}, defect;
    rk_table T = *rk_find("ssp104");
    int i;
    T.e3 = companion;
    CHECK(T.order_hat == 3);
    for (i = 0; i < 10; i++) companion[i] = 2 * (T.b[i] - T.bhat[i]); /* both have order 3 */
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    companion[9] += 1e-9;
    CHECK_INT(rk_check(&T, &defect), RK_EPAIR);
    CHECK(defect > 1e-11 && defect < 1e-8);
    T = *rk_find("dop853");
    memset(companion, 0, sizeof companion);
    T.e3 = companion, companion[0] = 1;
    CHECK_WITH(RK_EPAIR, rk_check(&T, NULL), companion[1] = -1); /* the sum is 0, which is order 1 */
    T = *rk_find("bs3"); /* its pair has order 2 */
    CHECK_WITH(RK_ETABLE, rk_check(&T, NULL), T.e3 = companion);
    T = *rk_find("rk4");
    CHECK_WITH(RK_ENULL, rk_check(&T, NULL), T.d = NULL);
}

/* Each half is looked at alone first; halves that do not fit have no defect that a number could be. */
TEST(test_either_half_of_a_pair_may_be_wrong)
{
    double e[4] = {0}, defect;
    rk_table T = *rk_find("ark3e"), other = *rk_find("ark3i");
    CHECK_INT(rk_check_imex(NULL, &other, &defect), RK_ENULL);
    T.e = other.e = e; /* not b - bhat */
    ALL(RK_EPAIR, rk_check_imex(&T, rk_find("ark3i"), &defect), rk_check_imex(rk_find("ark3e"), &other, &defect));
    CHECK_INT(rk_check_imex(rk_find("ark3e"), rk_find("ark4i"), &defect), RK_EOTHER);
    CHECK(defect > DBL_MAX);
}

/* The jump of a relaxed method has the weights b, here 2 and -1: terms of size 3, and nothing written behind them. */
TEST(test_the_jump_of_a_relaxed_method)
{
    const double A[4] = {0, 0, 1, 0}, b[2] = {2, -1}, c[2] = {0, 1}, euler[2] = {1, 0};
    rk_table T = plain_table("two and minus one", 2, 1, A, b, c);
    double mem[12], w[4] = {7, 7, 7, 7};
    rk_coupling C;
    T.bhat = euler, T.order_hat = 1;
    memset(&C, 77, sizeof C);
    CHECK_INT(rk_mis(&C, &T, RK_RELAXED, mem, sizeof mem), RK_OK);
    CHECK(C.order == 1 && C.order_hat == 1 && C.W == mem + 3 && !C.G && !C.groups);
    CHECK_INT(rk_coupling_jump(&C, 2, w), RK_OK);
    CHECK(w[0] == 2 && w[1] == -1 && w[2] == 0 && w[3] == 7 && rk_defect_coupling(&C, RK_OF_STEP, 1) <= RK_TOLERANCE);
    mem[6] += 1e-9;
    CHECK_NEAR(rk_defect_coupling(&C, RK_OF_STEP, 1), 1e-9 / 3, 1e-15);
}

/* No fast solve ends at the last time of a relaxed method, and no condition reads it; times of slopes do. */
TEST(test_the_last_time_of_a_relaxed_coupling)
{
    static const double wrong[] = {7, 1 - 1e-9, HUGE_VAL};
    double mem[200], defect = 0;
    rk_coupling C;
    size_t i;
    CHECK_INT(rk_mis(&C, rk_find("bs3"), RK_RELAXED, mem, sizeof mem), RK_OK);
    CHECK_INT(rk_check_coupling(&C, NULL), RK_OK);
    CHECK_WITH(RK_OK, rk_check_coupling(&C, NULL), mem[C.stages - 1] = 1 - DBL_EPSILON);
    for (i = 0; i < 3; i++) {
        mem[C.stages - 1] = wrong[i];
        CHECK(rk_defect_coupling(&C, RK_OF_STEP, C.order) <= RK_TOLERANCE);
        CHECK_INT(rk_check_coupling(&C, &defect), RK_ETIMES);
        CHECK(defect > DBL_MAX);
    }
    mem[C.stages - 1] = nan("");
    CHECK_INT(rk_check_coupling(&C, NULL), RK_ETIMES);
}

/* Luan, Chinomona & Reynolds 2020, the times of each group in ascending order: interpolation has its order with other ones, too. */
TEST(test_the_times_of_the_groups)
{
    static const struct {
        const char *name;
        double c[11];
    } known[] = {{"MERK21", {0, 1. / 2, 1}}, {"MERK32", {0, 1. / 2, 2. / 3, 1}},
                 {"MERK43", {0, 1. / 2, 1. / 3, 1. / 2, 1. / 3, 5. / 6, 1}},
                 {"MERK54", {0, 1. / 2, 1. / 3, 1. / 2, 1. / 4, 1. / 3, 1. / 2, 1. / 2, 2. / 3, 7. / 10, 1}}};
    size_t i;
    int j;
    for (i = 0; i < sizeof known / sizeof *known; i++) {
        const rk_coupling *C = rk_coupling_find(known[i].name);
        for (j = 0; j < C->stages; j++) CHECK_NEAR(C->c[j], known[i].c[j], 1e-16);
        CHECK(C->c[C->stages - 1] == 1 && C->powers == 0);
    }
}

/* Butcher's count of rooted trees, and sum over the trees of 1/(sigma gamma) = 1/n (the series of exp has them all once). */
TEST(test_the_tree_generator_meets_every_tree_once)
{
    static const int counts[] = {0, 1, 1, 2, 4, 9, 20, 48, 115, 286, 719};
    rk_tree t;
    int n;
    for (t.n = 0, n = 1; n <= RK_ORDER_MAX; n++) {
        int count = 0;
        double labellings = 0; /* n!/(sigma gamma) of each; they sum to (n-1)! */
        for (; rk_tree_next(&t, rk_find("euler"), NULL, n) == 1; count++) labellings += 1 / (t.sigma * t.gamma);
        CHECK_INT(count, counts[n]);
        CHECK_NEAR(labellings * n, 1, 1e-13);
    }
}

/* The conditions of both halves, in each colouring, and of times that are not the sums of the rows. */
TEST(test_order_conditions_one_by_one)
{
    const rk_table *E = rk_find("ark3e"), *I = rk_find("ark3i");
    const double late[] = {1, 1, 1, 1};
    rk_table X = *E;
    rk_tree t;
    int count = 0, i;
    for (t.n = 0; rk_tree_next(&t, E, I, 3) == 1; count++) {
        const double *b = t.colour[0] ? I->b : E->b;
        CHECK_NEAR(b[0] * t.phi[0] + b[1] * t.phi[1] + b[2] * t.phi[2] + b[3] * t.phi[3], 1 / t.gamma, 1e-14);
    }
    CHECK_INT(count, 2 * 8);
    for (X.c = late, count = 0; rk_tree_next(&t, &X, NULL, 2) == 1; count++)
        for (i = 0; i < 4; i++) CHECK_NEAR(t.phi[i], t.colour[1] ? 1 : E->c[i], 1e-15);
    CHECK_INT(count, 2); /* a leaf of state, a leaf of time */
    ALL(RK_ENULL, rk_tree_next(NULL, E, I, 3), rk_tree_next(&t, NULL, I, 3), (X.A = NULL, rk_tree_next(&t, E, &X, 3)));
    ALL(RK_EARG, rk_tree_next(&t, E, I, 0), rk_tree_next(&t, E, I, RK_ORDER_MAX + 1));
    CHECK_INT(rk_tree_next(&t, E, rk_find("bs3"), 3) == 1 && rk_tree_next(&t, E, rk_find("ssp33"), 3) == RK_EOTHER, 1);
}

/* For published ones the derived has a principal error no larger than the published one's. */
static double error_of_dense(const rk_table *T)
{
    double worst = 0, weight[RK_STAGES_MAX];
    rk_tree t;
    int i, j;
    for (t.n = 0, i = 1; i < 50; i++) {
        rk_weights(T, i / 50., 0, weight);
        while (rk_tree_next(&t, T, NULL, T->dense_order + 1) == 1) {
            double r = -pow(i / 50., T->dense_order + 1) / t.gamma;
            for (j = 0; j < T->stages + T->extra; j++) r += weight[j] * t.phi[j];
            worst += r * r / (t.sigma * t.sigma) / 50;
        }
    }
    return sqrt(worst);
}

TEST(test_derived_dense_output_is_as_good_as_published)
{
    static double mem[4000];
    rk_table X;
    CHECK_INT(rk_extend(&X, rk_find("dp5"), NULL, 4, 0, mem, sizeof mem), RK_OK);
    CHECK(error_of_dense(&X) <= error_of_dense(rk_find("dp5")));
    CHECK_NEAR(error_of_dense(&X), 5.4e-4, 2e-5); /* the published one's */
    CHECK_INT(rk_extend(&X, rk_find("tsit5"), NULL, 4, 0, mem, sizeof mem), RK_OK);
    CHECK(error_of_dense(&X) <= error_of_dense(rk_find("tsit5")));
}

/* ---- white box: a private function of rk_proof.h, for what no public one shows ------------------------------------------ */

/* The stiff conditions themselves: a wrong number spoils the uniform order, too, and that is looked at first. */
TEST(test_the_stiff_conditions_alone)
{
    const rk_table *T = rk_find("esdirk4");
    double d[18], two[2] = {1. / 2 + 1e-9, 1. / 2}, defect;
    rk_table X = *T;
    int i;
    CHECK(rkp__stiff_holds(T, &defect));
    X.d = d;
    for (i = 0; i < 3; i++) { /* the explicit slope counts 1 in the sum that keeps theta^(i+1) bounded */
        memcpy(d, T->d, sizeof d);
        d[i] += i % 2 ? 2e-11 : -2e-11;
        CHECK(!rkp__stiff_holds(&X, &defect) && defect > RK_TOLERANCE && defect <= 2.1e-11);
    }
    X = *rk_find("trapezoid"); /* as z -> -inf the two slopes cancel: terms of 1/2 and 1/2, and 1 */
    X.d = two;
    CHECK(!rkp__stiff_holds(&X, &defect));
    CHECK_NEAR(defect, 1e-9 / 2, 1e-15);
}

/* What column `at` and the divisor of a table say: Prothero & Robinson's problem to t = 10, rtol = atol = 1e-6, controlled by
   the filtered pair, alone or with the look inside.  Returns the largest error inside, in tolerances. */
static double controlled_inside(const rk_table *T, double theta, double divisor, int *steps)
{
    const double lambda = -1e6, tol = 1e-6;
    double t = 0, h = 1e-3, y = 0.5, k[8], ynew, worst = 0;
    rk_control C;
    int j;
    CHECK_INT(rk_control_make(&C, "PI", T), RK_OK);
    CHECK_INT(rk_control_stop(&C, 10, t, &h), RK_OK);
    for (*steps = 0, k[0] = 1; t < 10 && *steps < 10000;) { /* slope 0: cos 0 - sin 0 */
        const double filter = 1 - h * T->bhat[0] * lambda, t0 = t, h0 = h;
        const rk_step step = step_of(T, h, 1, &y, k, 1);
        double x, u, v, error, sum[2] = {0}, inside[2] = {0};
        coupled_slopes(T, t, h, lambda, y, k);
        CHECK_INT(rk_update(T, h, 1, &y, k, 1, &ynew, &x), RK_OK);
        x /= filter;
        rk_norm(tol, tol, NULL, 1, &x, &y, &ynew, sum);
        error = rk_rms(sum);
        if (theta > 0) {
            const double at = t + theta * h;
            rk_dense(&step, theta, 0, &u);
            rk_dense(&step, theta, 1, &v);
            x = h * (v - lambda * (u - sin(at) - 0.5 * cos(2 * at)) - cos(at) + sin(2 * at)) / divisor / filter;
            rk_norm(tol, tol, NULL, 1, &x, &y, &ynew, inside);
            error = fmax(error, rk_rms(inside));
        }
        j = rk_control_step(&C, error, &t, &h);
        CHECK(j >= 0);
        if (j == RK_REJECT) continue;
        ++*steps;
        for (j = 1; j < 10; j++) {
            const double at = t0 + j * h0 / 10;
            rk_dense(&step, j / 10., 0, &u);
            worst = fmax(worst, fabs(u - sin(at) - 0.5 * cos(2 * at)) / (tol + tol * fabs(u)));
        }
        y = ynew, k[0] = k[T->stages - 1];
    }
    return worst;
}

TEST(test_radau_looks_inside_its_steps)
{
    static const char *const names[] = {"radau5", "radau9"};
    int q, alone, both;
    for (q = 0; q < 2; q++) {
        const rk_table *T = rk_find(names[q]);
        double theta[2], divisor = 1, blind, off;
        CHECK(column_at(names[q], theta, &divisor));
        CHECK_NEAR(divisor * T->bhat[0], 1, 0.015); /* gamma times the defect */
        blind = controlled_inside(T, 0, 1, &alone), off = controlled_inside(T, theta[0], divisor, &both);
        if (!(blind > 1e3 && off < 3 && both < 150)) fail_msg("%s: %g in %d steps, %g in %d", T->name, blind, alone, off, both);
    }
}


int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_table_has_its_orders_and_not_the_next),
        cmocka_unit_test(test_collocation_families_have_their_orders),
        cmocka_unit_test(test_collocation_tables_are_those_of_the_book),
#ifdef HAVE_SUNDIALS
        cmocka_unit_test(test_tables_agree_with_those_of_SUNDIALS),
#endif
        cmocka_unit_test(test_observed_orders_of_step_dense_output_and_derivative),
        cmocka_unit_test(test_observed_orders_of_collocation),
        cmocka_unit_test(test_the_error_estimate_is_the_difference_of_the_pair),
        cmocka_unit_test(test_imex_pairs_have_their_orders_together),
        cmocka_unit_test(test_observed_orders_of_imex_pairs),
        cmocka_unit_test(test_general_additive_methods),
        cmocka_unit_test(test_the_terms_of_a_coupling_whose_times_fall),
        cmocka_unit_test(test_multirate_couplings_have_their_orders),
        cmocka_unit_test(test_infinitesimal_steps_from_any_outer_table),
        cmocka_unit_test(test_observed_orders_of_infinitesimal_steps),
        cmocka_unit_test(test_relaxed_steps_keep_linear_invariants_of_the_sum),
        cmocka_unit_test(test_pairs_and_couplings_are_checked_by_one_call),
        cmocka_unit_test(test_no_five_explicit_stages_have_order_5),
        cmocka_unit_test(test_wrong_tables_are_refused_with_the_defect),
        cmocka_unit_test(test_tables_that_cannot_be_used_are_refused),
        cmocka_unit_test(test_tables_of_32_and_of_64_stages),
        cmocka_unit_test(test_known_bad_tables_are_refused),
        cmocka_unit_test(test_cancelling_weights_are_judged_by_their_size),
        cmocka_unit_test(test_properties_are_found_in_the_numbers),
        cmocka_unit_test(test_derived_dense_output_is_the_stored_one),
        cmocka_unit_test(test_rk_extend_size_is_enough),
        cmocka_unit_test(test_bootstrapped_dense_output_reaches_the_order_of_the_method),
        cmocka_unit_test(test_dense_output_stays_bounded_for_stiff_parts),
        cmocka_unit_test(test_dense_output_has_its_stiff_order),
        cmocka_unit_test(test_a_false_stiff_order_is_refused),
        cmocka_unit_test(test_extended_tables_have_the_stiff_order_that_they_claim),
        cmocka_unit_test(test_rk_extend_says_when_it_is_not_bounded),
        cmocka_unit_test(test_dense_output_predicts_the_stages_of_the_next_step),
        cmocka_unit_test(test_many_thetas_in_one_sweep),
        cmocka_unit_test(test_waveform_iterations_keep_the_order),
        cmocka_unit_test(test_the_norm_is_the_root_of_the_mean_square),
        cmocka_unit_test(test_a_norm_of_what_is_not_finite),
        cmocka_unit_test(test_step_control_at_the_extremes),
        cmocka_unit_test(test_a_step_too_small_to_move_t_ends_the_loop),
        cmocka_unit_test(test_smallest_and_largest_steps),
        cmocka_unit_test(test_steps_of_a_few_roundings),
        cmocka_unit_test(test_a_largest_step_that_does_not_move_t),
        cmocka_unit_test(test_a_stop_time_at_hand_or_behind),
        cmocka_unit_test(test_the_stop_time_is_reached_to_the_bit),
        cmocka_unit_test(test_no_step_goes_beyond_the_stop_time),
        cmocka_unit_test(test_a_step_cut_short_is_no_history),
        cmocka_unit_test(test_a_coupling_of_finite_numbers),
        cmocka_unit_test(test_a_stiff_order_that_overflows_is_not_proven),
        cmocka_unit_test(test_every_coefficient_of_every_controller),
        cmocka_unit_test(test_every_controller_settles),
        cmocka_unit_test(test_the_companion_estimate_of_dop853),
        cmocka_unit_test(test_the_first_step_from_rest),
        cmocka_unit_test(test_extended_tables_keep_their_error_weights),
        cmocka_unit_test(test_added_stages_lie_at_times_of_their_own),
        cmocka_unit_test(test_extended_tables_whose_time_is_apart),
        cmocka_unit_test(test_halves_that_differ_in_their_times),
        cmocka_unit_test(test_memory_that_shares_numbers_with_the_table),
        cmocka_unit_test(test_claims_without_numbers),
        cmocka_unit_test(test_a_size_of_the_host_after_a_cut),
        cmocka_unit_test(test_the_defect_of_a_table_that_overflows_is_infinite),
        cmocka_unit_test(test_an_adaptive_run_meets_its_tolerance),
        cmocka_unit_test(test_intervals_cost_one_step_each),
        cmocka_unit_test(test_state_and_time_move_together),
        cmocka_unit_test(test_an_oscillator_at_large_times),
        cmocka_unit_test(test_steps_that_fit_the_stop_times_stay_whole),
        cmocka_unit_test(test_no_endless_rejections),
        cmocka_unit_test(test_a_first_step_where_a_tolerance_is_zero),
        cmocka_unit_test(test_vectors_elsewhere),
        cmocka_unit_test(test_stages_behind_the_step),
        cmocka_unit_test(test_round_off_of_a_long_integration),
        cmocka_unit_test(test_an_ensemble_of_good_and_bad_tables),
        cmocka_unit_test(test_powers_of_two_pass_through_bit_for_bit),
#ifndef FAST_MATH
        cmocka_unit_test(test_pieces_give_the_bits_of_the_whole),
#endif
        cmocka_unit_test(test_weights_of_each_degree),
#ifdef __unix__
        cmocka_unit_test(test_threads_on_the_same_tables),
#endif
        cmocka_unit_test(test_the_ends_of_dense_output_are_the_step_bit_for_bit),
        cmocka_unit_test(test_no_slopes_where_none_are_read),
        cmocka_unit_test(test_extreme_steps),
        cmocka_unit_test(test_slopes_at_the_end_of_the_range),
        cmocka_unit_test(test_a_NaN_slope_is_reported_and_stays_in_its_element),
        cmocka_unit_test(test_every_argument_is_looked_at),
        cmocka_unit_test(test_bad_couplings_are_refused),
        cmocka_unit_test(test_every_status_has_its_message),
        cmocka_unit_test(test_a_last_step_of_the_smallest_size_is_not_repeated),
        cmocka_unit_test(test_every_setting_of_the_control),
        cmocka_unit_test(test_the_stop_time_does_not_shorten_the_next_interval),
        cmocka_unit_test(test_the_control_of_a_coupling),
        cmocka_unit_test(test_sums_of_up_to_thirty_terms),
        cmocka_unit_test(test_all_stages_of_long_vectors),
        cmocka_unit_test(test_no_bounded_dense_output_of_a_step_that_is_not),
        cmocka_unit_test(test_the_stages_that_rk_extend_adds),
        cmocka_unit_test(test_the_numbers_of_the_smallest_methods),
        cmocka_unit_test(test_the_slopes_of_dense_output_at_the_ends),
        cmocka_unit_test(test_the_estimate_of_the_error_of_dense_output),
        cmocka_unit_test(test_nodes_are_zeros_to_the_last_bit_or_two),
        cmocka_unit_test(test_rows_of_a_coupling_from_a_table),
        cmocka_unit_test(test_halves_and_outer_tables_that_do_not_fit),
        cmocka_unit_test(test_halves_that_are_right_alone_and_wrong_together),
        cmocka_unit_test(test_a_stiff_order_that_the_times_miss),
        cmocka_unit_test(test_no_stiff_order_of_an_explicit_slope_ahead),
        cmocka_unit_test(test_what_counts_as_the_end_slope),
        cmocka_unit_test(test_a_step_that_takes_an_extra_slope_is_not_extended),
        cmocka_unit_test(test_growth_far_up_the_axis_is_seen),
        cmocka_unit_test(test_the_count_of_steps_has_an_end),
        cmocka_unit_test(test_claims_that_clash_are_refused),
        cmocka_unit_test(test_a_bounded_output_of_much_lower_order_is_found),
        cmocka_unit_test(test_a_bounded_output_goes_before_a_higher_order),
        cmocka_unit_test(test_every_derivative_of_a_cubic),
        cmocka_unit_test(test_weights_at_the_ends_and_what_dense_output_refuses),
        cmocka_unit_test(test_rk_update_reports_each_of_its_sums),
        cmocka_unit_test(test_the_order_of_an_estimate),
        cmocka_unit_test(test_the_small_print_of_the_control),
        cmocka_unit_test(test_the_last_steps_before_a_stop),
        cmocka_unit_test(test_the_sum_of_all_steps_is_the_time_that_has_passed),
        cmocka_unit_test(test_frequent_stops_at_large_times),
        cmocka_unit_test(test_stops_of_twelve_digits_cost_one_step_each),
        cmocka_unit_test(test_a_step_sees_one_side_of_a_jump),
        cmocka_unit_test(test_DETEST_F2_in_as_many_steps_as_the_problem_has),
        cmocka_unit_test(test_halves_and_inner_solves_see_one_side_of_a_jump),
        cmocka_unit_test(test_the_time_to_ask_f_at),
        cmocka_unit_test(test_radau_and_its_pair),
        cmocka_unit_test(test_sizes_and_names_of_generated_tables),
        cmocka_unit_test(test_defects_in_units_of_their_terms),
        cmocka_unit_test(test_forms_without_a_stiff_order),
        cmocka_unit_test(test_companions_are_checked),
        cmocka_unit_test(test_either_half_of_a_pair_may_be_wrong),
        cmocka_unit_test(test_the_jump_of_a_relaxed_method),
        cmocka_unit_test(test_the_last_time_of_a_relaxed_coupling),
        cmocka_unit_test(test_the_times_of_the_groups),
        cmocka_unit_test(test_the_tree_generator_meets_every_tree_once),
        cmocka_unit_test(test_order_conditions_one_by_one),
        cmocka_unit_test(test_derived_dense_output_is_as_good_as_published),
        cmocka_unit_test(test_the_stiff_conditions_alone),
        cmocka_unit_test(test_radau_looks_inside_its_steps),
    };
    check_named(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
