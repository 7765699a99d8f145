/* SPDX-License-Identifier: MIT

   test_iqn.c - iqn.h against published numbers, Householder QR by LAPACK, and the rows of its list of extremes */
#define IQN_IMPLEMENTATION
#include "../iqn.h"

#include "check.h"

extern void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
                   const int *ldb, double *work, const int *lwork, int *info, size_t);

static iqn *make(void **mem, ptrdiff_t n, int columns, int blocks)
{
    size_t bytes = iqn_size(n, columns, blocks);
    iqn *q = NULL;
    CHECK(bytes > 0);
    *mem = malloc(bytes);
    CHECK(*mem);
    CHECK_INT(iqn_make(&q, n, columns, blocks, *mem, bytes), IQN_OK);
    return q;
}

static double random_number(unsigned long long *state) /* in [-1, 1), the same everywhere */
{
    *state = *state * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

static double distance(int n, const double *a, const double *b) /* max |a - b|; b may be NULL */
{
    double most = 0;
    int i;
    for (i = 0; i < n; i++)
        if (!(fabs(a[i] - (b ? b[i] : 0)) <= most)) most = fabs(a[i] - (b ? b[i] : 0));
    return most;
}

/* ---- published numbers ---- */

/* preCICE 3, AccelerationSerialTest: two fields in one vector; the second call comes with the old iterate, unchanged. */
static void test_two_updates_of_the_serial_acceleration_test(void **state)
{
    static const double start[8] = {1, 1, 1, 1, .2, .2, .2, .2}, first[8] = {1, 2, 3, 4, .1, .1, .1, .1};
    static const double second[8] = {10, 10, 10, 10, .199, .199, .199, .199};
    static const double relaxed[8] = {1, 1.01, 1.02, 1.03, .199, .199, .199, .199};
    static const double expected[8] = {-0.56340134092969, 0.61030991917360,  1.78402117927691,  2.95773243938021,
                                       0.0828025852497734, 0.0828025852497734, 0.0828025852497734, 0.0828025852497734};
    int level;
    (void)state;
    for (level = IQN_FAST; level <= IQN_ACCURATE; level++) {
        void *mem;
        iqn *q = make(&mem, 8, 10, 2);
        double x[8];
        CHECK_INT(iqn_set(q, IQN_OMEGA, 0.01), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_LEVEL, level), IQN_OK);
        memcpy(x, start, sizeof x);
        CHECK_INT(iqn_step(q, x, first), IQN_RELAXED);
        CHECK_NEAR(distance(8, x, relaxed), 0, 1e-15);
        memcpy(x, start, sizeof x);
        CHECK_INT(iqn_step(q, x, second), IQN_OK);
        CHECK_NEAR(distance(8, x, expected), 0, 1e-12);
        free(mem);
    }
}

static void test_aitken_of_the_serial_acceleration_test(void **state)
{
    static const double start[8] = {1, 2, 3, 4, .2, .2, .2, .2}, first[8] = {3.5, 2, 2, 1, .1, .1, .1, .1};
    static const double second[8] = {10, 10, 10, 10, .16, .16, .16, .16}, relaxed[8] = {2, 2, 2.6, 2.8, .16, .16, .16, .16};
    static const double expected[8] = {1.2689851805508461, 2.2390979382674185,  3.2092106959839914,  4.1793234537005644,
                                       0.19880451030866292, 0.19880451030866292, 0.19880451030866292, 0.19880451030866292};
    void *mem;
    iqn *q = make(&mem, 8, 0, 1);
    double x[8];
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 0.4), IQN_OK);
    memcpy(x, start, sizeof x);
    CHECK_INT(iqn_step(q, x, first), IQN_RELAXED);
    CHECK_NEAR(distance(8, x, relaxed), 0, 1e-15);
    memcpy(x, start, sizeof x);
    CHECK_INT(iqn_step(q, x, second), IQN_RELAXED);
    CHECK_NEAR(distance(8, x, expected), 0, 1e-15);
    free(mem);
}

/* Four nonlinear equations as a fixed point, from 0 to (-2, 0, -2, -2), relative limit 1e-7, in 5 to 20 iterations. */
static void test_four_equations(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 10, 1);
    double x[4] = {0, 0, 0, 0}, h[4];
    const double expected[4] = {-2, 0, -2, -2};
    (void)state;
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-7), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MAX_ITERATIONS, 100), IQN_OK);
    do {
        h[0] = 2 * x[0] * x[0] - x[1] * x[2] - 8 + x[0];
        h[1] = x[0] * x[0] * x[1] + 2 * x[0] * x[1] * x[2] + x[1] * x[2] * x[2] + x[1] + x[1];
        h[2] = x[2] * x[2] - 4 + x[2];
        h[3] = x[3] * x[3] - 4 + x[3];
        CHECK(iqn_step(q, x, h) >= 0);
    } while (!iqn_converged(q));
    CHECK_INT(iqn_converged(q), 1);
    CHECK(iqn_get(q, IQN_ITERATIONS) >= 5 && iqn_get(q, IQN_ITERATIONS) <= 20);
    CHECK_NEAR(distance(4, x, expected), 0, 1e-6);
    free(mem);
}

/* SUNDIALS kinAnalytic_fp: counts and errors of the returned iterate, plain and with depth 2. */
static void test_three_equations_of_kinsol(void **state)
{
    static const double error[2][3] = {{6.91114e-12, 4.48202e-07, 3.07455e-07}, {1.78138e-10, 3.94722e-09, 6.5144e-10}};
    const double pi = 3.14159265358979323846, exact[3] = {0.5, 1, -pi / 6};
    int i, k, m;
    (void)state;
    for (k = 0; k < 2; k++) {
        void *mem;
        iqn *q = make(&mem, 3, 2 * k, 1);
        double x[3] = {.1, .1, -.1}, u[3], h[3];
        CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER, IQN_NOFILTER), IQN_OK);
        m = 0;
        do {
            memcpy(u, x, sizeof u);
            h[0] = cos((x[1] - 1) * x[2]) / 3 + 1. / 6;
            h[1] = sqrt(x[0] * x[0] + sin(x[2]) + 1.06) / 9 + 0.9;
            h[2] = -exp(-x[0] * (x[1] - 1)) / 20 - (10 * pi - 3) / 60;
            CHECK(iqn_step(q, x, h) >= 0);
            m++;
        } while (distance(3, h, u) >= 1.4901161e-06 && m < 20);
        CHECK_INT(m, 5);
        for (i = 0; i < 3; i++) CHECK_NEAR(fabs(u[i] - exact[i]), error[k][i], 2e-5 * error[k][i] + 2e-16);
        free(mem);
    }
}

/* ---- identities ---- */

/* x = A x + b: the n + 2nd evaluation meets the fixed point, whatever the spectrum of A. */
static void test_affine_maps_end_after_n_plus_2_evaluations(void **state)
{
    unsigned long long seed = 1;
    int n, i, j, k, spread;
    (void)state;
    for (spread = 1; spread <= 10; spread *= 10)
        for (n = 1; n <= 12; n++) {
            void *mem;
            iqn *q = make(&mem, n, n, 1);
            double A[144], b[12], x[12], h[12], scale;
            for (i = 0; i < n * n; i++) A[i] = spread * random_number(&seed);
            for (i = 0; i < n; i++) b[i] = random_number(&seed), x[i] = 0;
            CHECK_INT(iqn_set(q, IQN_EPSILON, 0), IQN_OK);
            for (k = 0; k < n + 2; k++) {
                for (i = 0; i < n; i++)
                    for (h[i] = b[i], j = 0; j < n; j++) h[i] += A[i * n + j] * x[j];
                scale = distance(n, x, NULL) + distance(n, h, NULL);
                CHECK(iqn_step(q, x, h) >= 0);
            }
            CHECK_NEAR(iqn_get(q, IQN_RESIDUAL) / scale, 0, 1e-9);
            free(mem);
        }
}

/* One update of m pairs against the same least squares solved by LAPACK's Householder QR on the host's own differences. */
static void test_update_equals_householder_qr(void **state)
{
    enum { N = 53, M = 9, LW = 4096 };
    static double r[M + 1][N], h[M + 1][N], V[M * N], b[N], work[LW];
    unsigned long long seed = 7;
    int level, i, k, info, n = N, m = M, one = 1, lw = LW;
    (void)state;
    for (level = IQN_FAST; level <= IQN_ACCURATE; level++) {
        void *mem;
        iqn *q = make(&mem, N, M, 3);
        double x[N], expected[N];
        CHECK_INT(iqn_set(q, IQN_EPSILON, 0), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_LEVEL, level), IQN_OK);
        for (k = 0; k <= M; k++) {
            for (i = 0; i < N; i++) {
                x[i] = random_number(&seed);
                h[k][i] = random_number(&seed);
                r[k][i] = h[k][i] - x[i];
            }
            CHECK_INT(iqn_step(q, x, h[k]), k ? IQN_OK : IQN_RELAXED);
        }
        for (k = 0; k < M; k++)
            for (i = 0; i < N; i++) V[k * N + i] = r[k + 1][i] - r[k][i];
        for (i = 0; i < N; i++) b[i] = -r[M][i];
        dgels_("N", &n, &m, &one, V, &n, b, &n, work, &lw, &info, 1);
        CHECK_INT(info, 0);
        for (i = 0; i < N; i++)
            for (expected[i] = h[M][i], k = 0; k < M; k++) expected[i] += b[k] * (h[k + 1][i] - h[k][i]);
        CHECK_NEAR(distance(N, x, expected), 0, 2e-14);
        free(mem);
    }
}

/* ---- statuses ---- */

static int failing_sum(double *v, int count, void *ctx)
{
    (void)v;
    (void)count;
    return (*(int *)ctx)-- == 0;
}

static void test_every_status_is_reached_and_negative_ones_touch_nothing(void **state)
{
    enum { N = 5 };
    void *mem;
    size_t bytes = iqn_size(N, 3, 2);
    unsigned char *before = (unsigned char *)malloc(bytes);
    const double nan = strtod("nan", NULL), inf = strtod("inf", NULL);
    double x[N] = {1, 2, 3, 4, 5}, h[N] = {2, 1, 4, 3, 6}, keep[N], bad[N];
    iqn *q = NULL;
    int i, calls;
    (void)state;
    CHECK_INT(iqn_size(-1, 3, 1), 0);
    CHECK_INT(iqn_size(5, -1, 1), 0);
    CHECK_INT(iqn_size(5, 3, 0), 0);
    CHECK_INT(iqn_size((ptrdiff_t)((size_t)-1 / 16), 1000, 1), 0);
    mem = malloc(bytes + 8);
    CHECK_INT(iqn_make(NULL, N, 3, 2, mem, bytes), IQN_EARG);
    CHECK_INT(iqn_make(&q, -1, 3, 2, mem, bytes), IQN_EARG);
    CHECK_INT(iqn_make(&q, N, 3, 2, NULL, bytes), IQN_EMEM);
    CHECK_INT(iqn_make(&q, N, 3, 2, mem, bytes - 1), IQN_EMEM);
    CHECK_INT(iqn_make(&q, N, 3, 2, (char *)mem + 4, bytes), IQN_EMEM);
    CHECK(q == NULL);
    CHECK_INT(iqn_make(&q, N, 3, 2, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    for (i = 0; i < N; i++) h[i] += i * i;
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    memcpy(before, mem, bytes);
    CHECK_INT(iqn_set(q, 0, 1), IQN_EARG);
    CHECK_INT(iqn_set(q, IQN_RESIDUAL, 1), IQN_EARG);
    CHECK_INT(iqn_set(q, IQN_OMEGA, nan), IQN_EARG);
    CHECK_INT(iqn_set(q, IQN_OMEGA, inf), IQN_EARG);
    CHECK_INT(iqn_set(q, IQN_EPSILON, -1), IQN_EARG);
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 1.5), IQN_EARG);
    CHECK_INT(iqn_set(NULL, IQN_OMEGA, 1), IQN_EARG);
    CHECK_INT(iqn_set_block(q, 2, IQN_WEIGHT, 1), IQN_EARG);
    CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 1), IQN_EARG);
    CHECK_INT(iqn_step(NULL, x, h), IQN_EARG);
    CHECK_INT(iqn_step(q, NULL, h), IQN_EARG);
    CHECK_INT(iqn_step(q, x, NULL), IQN_EARG);
    CHECK_INT(iqn_step(q, x, x), IQN_EARG);
    CHECK_INT(iqn_push(q, x, NULL), IQN_EARG);
    CHECK_INT(iqn_pair(q, 1, x, NULL), IQN_EARG);
    CHECK_INT(iqn_commit(NULL), IQN_EARG);
    CHECK_INT(iqn_discard(NULL), IQN_EARG);
    CHECK_INT(iqn_set_sum(NULL, NULL, NULL), IQN_EARG);
    CHECK(memcmp(before, mem, bytes) == 0);
    CHECK(!iqn__finite(iqn_get(q, 99)));
    CHECK_INT(iqn_version(), IQN_VERSION);
    for (i = -210; i < 220; i++) CHECK(iqn_message(i) != NULL && iqn_message(i)[0]);

    /* a failed step leaves x and the pairs: the next good step gives the bits it gives without the failures */
    memcpy(keep, x, sizeof x);
    for (i = 0; i < 3; i++) {
        memcpy(bad, h, sizeof h);
        bad[i + 1] = i == 0 ? nan : i == 1 ? inf : -inf;
        CHECK_INT(iqn_step(q, x, bad), IQN_ENAN);
        CHECK_INT(iqn_step(q, bad, h), IQN_ENAN);
        CHECK_INT(iqn_push(q, bad, h), IQN_ENAN);
        CHECK_INT(iqn_push(q, h, bad), IQN_ENAN);
        CHECK(memcmp(x, keep, sizeof x) == 0);
    }
    for (i = 0; i < 2; i++) {
        calls = i;
        CHECK_INT(iqn_set_sum(q, failing_sum, &calls), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_ESUM);
        CHECK(memcmp(x, keep, sizeof x) == 0);
    }
    iqn_set_sum(q, NULL, NULL);
    for (i = 0; i < N; i++) h[i] = 1 + x[(i + 1) % N];
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    memcpy(mem, before, bytes);
    CHECK_INT(iqn_step(q, keep, h), IQN_OK);
    CHECK(memcmp(x, keep, sizeof x) == 0);

    for (i = 0; i < N; i++) h[i] = x[i] * (1 + 1e-12);
    CHECK_INT(iqn_step(q, x, h), IQN_CONVERGED);
    CHECK(memcmp(x, h, sizeof x) == 0);
    CHECK_INT(iqn_converged(q), 1);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_converged(q), 0);
    CHECK_INT(iqn_set(q, IQN_EPSILON, 1), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MAX_ITERATIONS, 2), IQN_OK);
    for (i = 0; i < N; i++) h[i] = 10 * i + x[i];
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_converged(q), 0);
    for (i = 0; i < N; i++) h[i] = 7 * i * i + x[i];
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_converged(q), 2);
    CHECK_INT(iqn_discard(q), IQN_OK);
    free(before);
    free(mem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_updates_of_the_serial_acceleration_test),
        cmocka_unit_test(test_aitken_of_the_serial_acceleration_test),
        cmocka_unit_test(test_four_equations),
        cmocka_unit_test(test_three_equations_of_kinsol),
        cmocka_unit_test(test_affine_maps_end_after_n_plus_2_evaluations),
        cmocka_unit_test(test_update_equals_householder_qr),
        cmocka_unit_test(test_every_status_is_reached_and_negative_ones_touch_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
