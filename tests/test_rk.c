/* SPDX-License-Identifier: MIT

   test_rk.c - rk.h against rooted trees, exact solutions, __float128 and, where installed, SUNDIALS' own tables. */
#define RK_IMPLEMENTATION
#include "../rk.h"
#include "check.h"

#ifdef HAVE_SUNDIALS
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#endif

/* ---- the tables ---------------------------------------------------------------------------------------------------- */

static void test_every_table_has_its_order_and_not_the_next(void **state)
{
    const rk_table *T;
    int i, p;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        for (p = 1; p <= T->order; p++)
            if (!(rk_defect(T, p) <= RK_TOLERANCE)) fail_msg("%s, order %d: %g", T->name, p, rk_defect(T, p));
        if (!(rk_defect(T, p) > 1e-8)) fail_msg("%s has order %d too: %g", T->name, p, rk_defect(T, p));
    }
}

static void test_every_embedding_has_its_order_and_not_the_next(void **state)
{
    const rk_table *T;
    int i, j, p;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        if (!T->bhat) {
            CHECK_INT(T->order_hat, 0);
            continue;
        }
        for (p = 1; p <= T->order_hat; p++)
            if (!(rk_defect_hat(T, p) <= RK_TOLERANCE)) fail_msg("%s, order %d: %g", T->name, p, rk_defect_hat(T, p));
        if (!(rk_defect_hat(T, p) > 1e-8)) fail_msg("%s has order %d too", T->name, p);
        for (j = 0; j < T->stages; j++) CHECK_NEAR(T->e[j], T->b[j] - T->bhat[j], 4e-16 * (1 + fabs(T->b[j])));
    }
}

static void test_every_dense_output_has_its_order_and_not_the_next(void **state)
{
    const rk_table *T;
    int i, j, k, p;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        CHECK(T->dense_order >= T->order - 1 || strncmp(T->name, "ark5", 4) == 0); /* that pair has 3 of its own */
        for (p = 1; p <= T->dense_order; p++)
            if (!(rk_defect_dense(T, p) <= RK_TOLERANCE)) fail_msg("%s, order %d: %g", T->name, p, rk_defect_dense(T, p));
        if (!(rk_defect_dense(T, p) > 1e-8)) fail_msg("%s has order %d too", T->name, p);
        for (j = 0; j < T->stages + T->extra; j++) { /* it ends in b */
            double sum = 0, size = 1;
            for (k = 0; k < T->dense; k++) {
                sum += T->d[j * T->dense + k];
                size += fabs(T->d[j * T->dense + k]);
            }
            CHECK_NEAR(sum, T->b[j], 4e-16 * size);
        }
    }
}

static void test_collocation_families_have_their_orders(void **state)
{
    double mem[600];
    rk_table T;
    int family, s, p;
    (void)state;
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = family < RK_LOBATTO_IIIA ? 1 : 2; s <= 5; s++) {
            CHECK_INT(rk_collocation(&T, family, s, mem, rk_size(s, s)), RK_OK);
            CHECK_INT(T.order, 2 * s - (family == RK_GAUSS ? 0 : family == RK_RADAU_IIA ? 1 : 2));
            for (p = 1; p <= T.order; p++)
                if (!(rk_defect(&T, p) <= RK_TOLERANCE)) fail_msg("%s, order %d: %g", T.name, p, rk_defect(&T, p));
            if (p <= RK_ORDER_MAX) CHECK(rk_defect(&T, p) > 1e-4);
            CHECK_INT(T.dense_order, family == RK_LOBATTO_IIIB ? s - 1 : s);
            for (p = 1; p <= T.dense_order; p++) CHECK(rk_defect_dense(&T, p) <= RK_TOLERANCE);
            CHECK(rk_defect_dense(&T, p) > 1e-4);
        }
    CHECK(strcmp(T.name, "lobattoIIIC5") == 0);
}

/* Hairer & Wanner, Solving Ordinary Differential Equations II, tables IV.5.2, IV.5.6, IV.5.10, IV.5.11 */
static void test_collocation_tables_are_those_of_the_book(void **state)
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
    (void)state;
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, mem, sizeof mem), RK_OK);
    for (i = 0; i < 4; i++) CHECK_NEAR(T.A[i], gauss2[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_RADAU_IIA, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], radau3[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIB, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], lobattoB3[i], 1e-15);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIC, 3, mem, sizeof mem), RK_OK);
    for (i = 0; i < 9; i++) CHECK_NEAR(T.A[i], lobattoC3[i], 1e-15);
    T.A = NULL;
    CHECK_INT(rk_collocation(&T, 0, 2, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(NULL, RK_GAUSS, 2, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 0, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 6, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(&T, RK_LOBATTO_IIIA, 1, mem, sizeof mem), RK_EARG);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, NULL, sizeof mem), RK_EMEM);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, mem, rk_size(2, 2) - 1), RK_EMEM);
    CHECK_INT(rk_collocation(&T, RK_GAUSS, 2, (char *)mem + 4, sizeof mem - 8), RK_EMEM);
    CHECK(!T.A && rk_size(0, 1) == 0 && rk_size(65, 1) == 0 && rk_size(1, 11) == 0);
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

static void test_tables_agree_with_those_of_SUNDIALS(void **state)
{
    (void)state;
    check_against_sundials("heun", ARKodeButcherTable_LoadERK(ARKODE_HEUN_EULER_2_1_2));
    check_against_sundials("bs3", ARKodeButcherTable_LoadERK(ARKODE_BOGACKI_SHAMPINE_4_2_3));
    check_against_sundials("dp5", ARKodeButcherTable_LoadERK(ARKODE_DORMAND_PRINCE_7_4_5));
    check_against_sundials("esdirk3", ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK325L2SA_5_2_3));
    check_against_sundials("esdirk4", ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK436L2SA_6_3_4));
    check_against_sundials("esdirk4b", ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK437L2SA_7_3_4));
    check_against_sundials("esdirk5", ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK547L2SA2_7_4_5));
    check_against_sundials("sdirk4", ARKodeButcherTable_LoadDIRK(ARKODE_SDIRK_5_3_4));
    check_against_sundials("ark3e", ARKodeButcherTable_LoadERK(ARKODE_ARK324L2SA_ERK_4_2_3));
    check_against_sundials("ark3i", ARKodeButcherTable_LoadDIRK(ARKODE_ARK324L2SA_DIRK_4_2_3));
    check_against_sundials("ark4e", ARKodeButcherTable_LoadERK(ARKODE_ARK437L2SA_ERK_7_3_4));
    check_against_sundials("ark4i", ARKodeButcherTable_LoadDIRK(ARKODE_ARK437L2SA_DIRK_7_3_4));
    check_against_sundials("ark5e", ARKodeButcherTable_LoadERK(ARKODE_ARK548L2SAb_ERK_8_4_5));
    check_against_sundials("ark5i", ARKodeButcherTable_LoadDIRK(ARKODE_ARK548L2SAb_DIRK_8_4_5));
}
#endif

/* ---- steps --------------------------------------------------------------------------------------------------------- */

/* y0' = -2 t y0^2, y1' = y1 cos t from (1, 1): nonlinear, time-dependent; exact (1/(1+t^2), exp(sin t)). */
static void rhs(double t, const double *y, double *f)
{
    f[0] = -2 * t * y[0] * y[0];
    f[1] = y[1] * cos(t);
}

static void exact(double t, double y[2])
{
    y[0] = 1 / (1 + t * t);
    y[1] = exp(sin(t));
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
    double z[2];
    int i, j;
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
            CHECK_INT(rk_dense(T, j / 8., 0, h, 2, y, k, 2, v), RK_OK);
            error[1] = fmax(error[1], distance(v, (s + j / 8.) * h, 0));
            CHECK_INT(rk_dense(T, j / 8., 1, h, 2, y, k, 2, v), RK_OK);
            error[2] = fmax(error[2], distance(v, (s + j / 8.) * h, 1));
        }
        CHECK_INT(rk_finish(T, h, 2, y, k, 2, y, NULL), RK_OK);
    }
    error[0] = distance(y, 1, 0);
}

static void test_observed_orders_of_step_dense_output_and_derivative(void **state)
{
    const rk_table *T;
    int i;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        double coarse[3], fine[3];
        const int steps = T->order <= 2 ? 400 : T->order <= 4 ? 100 : T->order <= 6 ? 30 : 6;
        integrate(T, steps, coarse);
        integrate(T, 2 * steps, fine);
        if (!(fabs(log2(coarse[0] / fine[0]) - T->order) < (T->order < 5 ? 0.1 : 0.5)))
            fail_msg("%s: %g %g, order %g", T->name, coarse[0], fine[0], log2(coarse[0] / fine[0]));
        if (!(log2(coarse[1] / fine[1]) > fmin(T->dense_order + 1, T->order) - (T->order < 5 ? 0.1 : 0.4)))
            fail_msg("%s: dense %g %g", T->name, coarse[1], fine[1]);
        if (!(log2(coarse[2] / fine[2]) > T->dense_order - (T->order < 5 ? 0.1 : 0.4)))
            fail_msg("%s: dense derivative %g %g", T->name, coarse[2], fine[2]);
    }
}

/* Fully implicit tables: the slopes by fixed-point iteration, order of the step and of the dense output. */
static void test_observed_orders_of_collocation(void **state)
{
    double mem[600];
    rk_table T;
    int family, s, pass, i, j, l;
    (void)state;
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
                    CHECK_INT(rk_dense(&T, 0.4, 0, h, 2, y, k, 2, v), RK_OK);
                    inside[pass] = fmax(inside[pass], distance(v, (i + 0.4) * h, 0));
                    CHECK_INT(rk_finish(&T, h, 2, y, k, 2, y, NULL), RK_OK);
                }
                error[pass] = distance(y, 1, 0);
            }
            if (!(fabs(log2(error[0] / error[1]) - T.order) < 0.2))
                fail_msg("%s: order %g", T.name, log2(error[0] / error[1]));
            CHECK(log2(inside[0] / inside[1]) > fmin(T.dense_order + 1, T.order) - 0.2);
        }
    CHECK_INT(rk_stages(&T, 1, 2, NULL, NULL, 2, NULL, 2), RK_EARG);
    CHECK_INT(rk_stages(&T, 1, 0, NULL, NULL, 0, NULL, 0), RK_OK);
}

static void test_the_error_estimate_is_the_difference_of_the_pair(void **state)
{
    const rk_table *T;
    int i, j, l;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        double y[2] = {1, 1}, ynew[2], err[2], k[2 * RK_STAGES_MAX];
        stages(T, 0, 0.1, y, k);
        if (!T->bhat) {
            CHECK_INT(rk_finish(T, 0.1, 2, y, k, 2, ynew, err), RK_ENOPAIR);
            continue;
        }
        CHECK_INT(rk_finish(T, 0.1, 2, y, k, 2, ynew, err), RK_OK);
        for (l = 0; l < 2; l++) {
            double other = y[l];
            for (j = 0; j < T->stages; j++) other += 0.1 * T->bhat[j] * k[2 * j + l];
            CHECK_NEAR(err[l], ynew[l] - other, 1e-15);
        }
        CHECK_INT(rk_finish(T, 0.1, 2, NULL, k, 2, NULL, err), RK_OK); /* the error alone */
    }
}

/* ---- extremes ------------------------------------------------------------------------------------------------------ */

/* extremes.md, rk.h: theta = 0, 1, 1 + 1 ulp, 2, -1 */
static void test_the_ends_of_dense_output_are_the_step_bit_for_bit(void **state)
{
    static const double ends[] = {1, 1 + DBL_EPSILON, 1 - DBL_EPSILON / 2};
    const rk_table *T;
    int i, j;
    (void)state;
    for (i = 0; (T = rk_list(i)) != NULL; i++) {
        double y[2], ynew[2], k[2 * RK_STAGES_MAX], v[2];
        exact(0.3, y);
        stages(T, 0.3, 0.1, y, k);
        CHECK_INT(rk_finish(T, 0.1, 2, y, k, 2, ynew, NULL), RK_OK);
        for (j = 0; j < 3; j++) {
            CHECK_INT(rk_dense(T, ends[j], 0, 0.1, 2, y, k, 2, v), RK_OK);
            CHECK(memcmp(v, ynew, sizeof v) == 0);
            CHECK_INT(rk_dense(T, j * -DBL_EPSILON, 0, 0.1, 2, y, k, 2, v), RK_OK);
            CHECK(memcmp(v, y, sizeof v) == 0);
        }
        CHECK_INT(rk_dense(T, 2, 0, 0.1, 2, y, k, 2, v), RK_EXTRAP);
        CHECK_NEAR(v[1], exp(sin(0.5)), 0.15);
        CHECK_INT(rk_dense(T, -1, 0, 0.1, 2, y, k, 2, v), RK_EXTRAP);
        CHECK_NEAR(v[1], exp(sin(0.2)), 0.15);
    }
}

/* extremes.md, rk.h: h = 0, negative, 1e-300, 1e300; NaN and Inf refused */
static void test_extreme_steps(void **state)
{
    const rk_table *T = rk_find("dp5");
    double y[2] = {1, 1}, k[14] = {0}, v[2], one[14];
    int j;
    (void)state;
    for (j = 0; j < 14; j++) one[j] = 1;
    stages(T, 0, 0, y, k);
    CHECK_INT(rk_finish(T, 0, 2, y, k, 2, v, NULL), RK_OK);
    CHECK(memcmp(v, y, sizeof v) == 0);
    CHECK_INT(rk_dense(T, 0.5, 2, 0, 2, y, k, 2, v), RK_EARG); /* y'' would divide by h */
    stages(T, 0, -0.1, y, k);
    CHECK_INT(rk_finish(T, -0.1, 2, y, k, 2, v, NULL), RK_OK);
    CHECK_NEAR(v[0], 1 / 1.01, 1e-8);
    CHECK_INT(rk_finish(T, 1e-300, 2, y, one, 2, v, NULL), RK_OK);
    CHECK(v[0] == 1);
    CHECK_INT(rk_finish(T, 1e300, 2, y, one, 2, v, NULL), RK_OK);
    CHECK_NEAR(v[0] / 1e300, 1, 1e-14);
    v[0] = 7;
    CHECK_INT(rk_finish(T, nan(""), 2, y, k, 2, v, NULL), RK_EARG);
    CHECK_INT(rk_finish(T, HUGE_VAL, 2, y, k, 2, v, NULL), RK_EARG);
    CHECK_INT(rk_stage(T, 1, nan(""), 2, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_dense(T, nan(""), 0, 0.1, 2, y, k, 2, v), RK_EARG);
    CHECK(v[0] == 7);
}

/* extremes.md, rk.h: stages equal to 1e308, no overflow where the result is finite, in place too */
static void test_large_slopes_overflow_only_when_the_result_does(void **state)
{
    const rk_table *T = rk_find("dp5");
    static double y[5001], k[7 * 5001], z[5001];
    int i, j;
    (void)state;
    for (j = 0; j < 7 * 5001; j++) k[j] = 1e308;
    for (i = 0; i < 7; i++) {
        CHECK_INT(rk_stage(T, i, 1, 5001, y, k, 5001, z), RK_OK);
        for (j = 0; j < 5001; j++) CHECK_NEAR(ldexp(z[j], -1000), T->c[i] * ldexp(1e308, -1000), 1e-5);
    }
    CHECK_INT(rk_stage(T, 5, 1, 5001, y, k, 5001, y), RK_OK); /* in place */
    for (j = 0; j < 5001; j++) CHECK_NEAR(ldexp(y[j], -1000), ldexp(1e308, -1000), 1e-5);
    y[3] = 1e308;
    CHECK_INT(rk_stage(T, 5, 1, 5001, y, k, 5001, y), RK_NONFINITE); /* 2e308 */
}

static void test_a_NaN_slope_is_reported_and_stays_in_its_element(void **state)
{
    const rk_table *T = rk_find("rk4");
    double y[3] = {1, 2, 3}, k[12] = {0}, v[3];
    (void)state;
    k[1] = nan("");
    CHECK_INT(rk_stage(T, 1, 0.1, 3, y, k, 3, v), RK_NONFINITE);
    CHECK_INT(rk_finish(T, 0.1, 3, y, k, 3, v, NULL), RK_NONFINITE);
    CHECK(v[0] == 1 && v[2] == 3);
    CHECK_INT(rk_stage(T, 2, 0.1, 3, y, k, 3, v), RK_OK); /* a_20 = 0: not read */
    CHECK(v[1] == 2);
}

static void test_bad_arguments_get_a_status_and_touch_nothing(void **state)
{
    const rk_table *T = rk_find("rk4");
    rk_table bad = *T;
    double y[2] = {1, 1}, k[8] = {0}, v[4] = {7, 7, 7, 7};
    (void)state;
    CHECK_INT(rk_stage(NULL, 0, 1, 2, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, -1, 1, 2, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, 4, 1, 2, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, 1, 1, -1, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, 1, 1, 2, NULL, k, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, 1, 1, 2, y, NULL, 2, v), RK_EARG);
    CHECK_INT(rk_stage(T, 1, 1, 2, y, k, 1, v), RK_EARG);
    CHECK_INT(rk_stage(T, 0, 1, 0, NULL, NULL, 0, NULL), RK_OK);
    CHECK_INT(rk_finish(NULL, 1, 2, y, k, 2, v, NULL), RK_EARG);
    CHECK_INT(rk_finish(T, 1, 2, NULL, k, 2, v, NULL), RK_EARG);
    CHECK_INT(rk_finish(T, 1, 2, y, k, 1, v, NULL), RK_EARG);
    CHECK_INT(rk_finish(T, 1, 2, y, k, 2, v, v + 2), RK_ENOPAIR);
    CHECK_INT(rk_dense(T, 0.5, -1, 1, 2, y, k, 2, v), RK_EARG);
    CHECK_INT(rk_weights(T, 0.5, 0, NULL), RK_EARG);
    bad.d = NULL;
    CHECK_INT(rk_dense(&bad, 0.5, 0, 1, 2, y, k, 2, v), RK_ENODENSE);
    bad.stages = 0;
    CHECK_INT(rk_stage(&bad, 0, 1, 2, y, k, 2, v), RK_EARG);
    bad.stages = RK_STAGES_MAX + 1;
    CHECK_INT(rk_finish(&bad, 1, 2, y, k, 2, v, NULL), RK_EARG);
    CHECK(v[0] == 7 && v[1] == 7 && v[2] == 7);
    CHECK(rk_defect(NULL, 1) == DBL_MAX && rk_defect(T, 0) == DBL_MAX && rk_defect(T, 11) == DBL_MAX);
    CHECK(rk_defect_hat(T, 1) == DBL_MAX && rk_defect_dense(&bad, 1) == DBL_MAX);
    CHECK(!rk_find("nobody's") && !rk_find(NULL) && !rk_list(-1));
}

static void test_every_status_has_its_message(void **state)
{
    static const int statuses[] = {RK_OK, RK_EXTRAP, RK_NONFINITE, RK_EARG, RK_ENODENSE, RK_ENOPAIR, RK_EMEM, 12345};
    size_t i, j;
    (void)state;
    for (i = 0; i < sizeof statuses / sizeof *statuses; i++)
        for (j = 0; j < i; j++) CHECK(strcmp(rk_message(statuses[i]), rk_message(statuses[j])) != 0);
    CHECK_INT(rk_version(), RK_VERSION);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_table_has_its_order_and_not_the_next),
        cmocka_unit_test(test_every_embedding_has_its_order_and_not_the_next),
        cmocka_unit_test(test_every_dense_output_has_its_order_and_not_the_next),
        cmocka_unit_test(test_collocation_families_have_their_orders),
        cmocka_unit_test(test_collocation_tables_are_those_of_the_book),
#ifdef HAVE_SUNDIALS
        cmocka_unit_test(test_tables_agree_with_those_of_SUNDIALS),
#endif
        cmocka_unit_test(test_observed_orders_of_step_dense_output_and_derivative),
        cmocka_unit_test(test_observed_orders_of_collocation),
        cmocka_unit_test(test_the_error_estimate_is_the_difference_of_the_pair),
        cmocka_unit_test(test_the_ends_of_dense_output_are_the_step_bit_for_bit),
        cmocka_unit_test(test_extreme_steps),
        cmocka_unit_test(test_large_slopes_overflow_only_when_the_result_does),
        cmocka_unit_test(test_a_NaN_slope_is_reported_and_stays_in_its_element),
        cmocka_unit_test(test_bad_arguments_get_a_status_and_touch_nothing),
        cmocka_unit_test(test_every_status_has_its_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
