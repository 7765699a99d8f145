/* SPDX-License-Identifier: MIT

   test_scale.c - sizes that a test machine does not have: strides and lengths beyond 2^31 in memory mapped sparsely, sizes
   that overflow, 1e7 unknowns, 200 columns, 1e5 windows; and other extremes that no test of one header has: microseconds of
   Unix time, a condition of 1e16, loop gains down to -1e6, a solver that fails */
#define _DEFAULT_SOURCE 1 /* mmap's MAP_NORESERVE */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"

#include "check.h"

#if defined(__unix__) && SIZE_MAX > 0xffffffffu
#    include <sys/mman.h>
#    define SPARSE 1
#else
#    define SPARSE 0
#endif

enum { COLUMNS = 200, N = 257 };

/* Columns 2^31 + 8 doubles apart, of which only the first few rows exist in memory. */
TEST(test_columns_2_to_the_31_apart)
{
#if SPARSE
    const ptrdiff_t ld = ((ptrdiff_t)1 << 31) + 8, n = 5;
    const size_t bytes = (size_t)(ld * 6 + n) * sizeof(double);
    double *x = (double *)mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    double *mem = (double *)malloc(wf_size(0, 3, 6)), row[6], out[5], err[5];
    const rk_table *T = rk_find("rk4");
    wf *w = NULL;
    ptrdiff_t i;
    int j, deriv;
    if ((void *)x == MAP_FAILED) {
        printf("# no address space for the columns\n");
        free(mem);
        return;
    }
    CHECK_INT(wf_make(&w, 0, 3, 6, mem, wf_size(0, 3, 6)), WF_OK);
    for (j = 0; j < 6; j++) {
        CHECK_INT(wf_push(w, j, 0), j);
        for (i = 0; i < n; i++) x[j * ld + i] = (double)(i + 1) * j * j * j - j;
    }
    for (deriv = 0; deriv < 2; deriv++) {
        CHECK_INT(wf_weights(w, 2.5, deriv, row), WF_OK);
        CHECK_INT(wf_combine(1, 6, row, n, x, ld, out, n), WF_OK);
        for (i = 0; i < n; i++)
            CHECK_NEAR(out[i], (double)(i + 1) * (deriv ? 18.75 : 15.625) - (deriv ? 1 : 2.5), 1e-11);
    }
    for (j = 0; j < 4; j++)
        for (i = 0; i < n; i++) x[j * ld + i] = j + 1;
    CHECK_INT(rk_update(T, 6, n, x, x, ld, out, NULL), RK_OK);
    for (i = 0; i < n; i++) CHECK_NEAR(out[i], 1 + 6 * (1. / 6 + 2. / 3 + 1 + 4. / 6), 1e-14);
    CHECK_INT(rk_update(T, 6, n, x, x, ld, out, err), RK_ENOPAIR);
    munmap(x, bytes);
    free(mem);
#else
    printf("# needs mmap and 64 bits\n");
#endif
}

/* Sizes are right or refused, never wrapped around: there is no memory to run them in. */
TEST(test_sizes_beyond_2_to_the_31)
{
    static const ptrdiff_t vectors[] = {PTRDIFF_MAX, PTRDIFF_MAX / 8, PTRDIFF_MAX / 16};
    static const int sizes[][2] = {{INT_MAX, 1}, {1, INT_MAX}, {30000, INT_MAX / 8}};
    const ptrdiff_t n = (ptrdiff_t)(PTRDIFF_MAX > 0x7fffffff ? (unsigned long long)3 << 31 : 1u << 20);
    int k;
    CHECK(iqn_size(n, 0, 1) >= (size_t)n * 2 * sizeof(double));
    CHECK(iqn_size(n, 9, 1) - iqn_size(n, 0, 1) >= (size_t)n * 18 * sizeof(double));
    for (k = 0; k < 3; k++) {
        CHECK_INT(iqn_size(vectors[k], 200, 1), 0);
        CHECK_INT(iqn_size(1, sizes[k][0], sizes[k][1]), 0);
        CHECK_INT(wf_size(vectors[k], 1, 2), 0);
    }
    CHECK_INT(wf_size(0, WF_MAX_DEGREE, INT_MAX), 0);
    CHECK_INT(rk_collocation_size(INT_MAX), 0);
    CHECK_INT(rk_mis_size(INT_MAX), 0);
}

/* A linear contraction of 257 unknowns with 200 pairs: the ring wraps, nothing grows, the answer is the fixed point. */
TEST(test_200_columns)
{
    const size_t bytes = iqn_size(N, COLUMNS, 1);
    void *mem = malloc(bytes);
    static double x[N], h[N], a[N];
    iqn *q = NULL;
    int i, step, window;
    CHECK_INT(iqn_make(&q, N, COLUMNS, 1, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 1000), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-12), IQN_OK);
    for (i = 0; i < N; i++) a[i] = 0.9 * cos(i);
    for (window = 0; window < 12; window++) {
        for (step = 0; step < 60; step++) {
            for (i = 0; i < N; i++) h[i] = a[i] * x[(i + 1) % N] + sin(i * (window + 1.));
            CHECK(iqn_step(q, x, h) >= 0);
            if (iqn_converged(q)) break;
        }
        CHECK(step < 60);
        CHECK(iqn_get(q, IQN_PAIRS) <= COLUMNS);
        CHECK_INT(iqn_commit(q), IQN_OK);
        for (i = 0; i < N; i++) CHECK_NEAR(x[i], a[i] * x[(i + 1) % N] + sin(i * (window + 1.)), 1e-8);
    }
    CHECK(iqn_get(q, IQN_NFULL) + iqn_get(q, IQN_NDROPPED) > 0);
    free(mem);
}

/* 1e5 windows of 0.1 with four sub-steps each: times are stored, so that each is what was pushed. */
TEST(test_1e5_windows)
{
    enum { CAPACITY = 12 };
    const size_t bytes = wf_size(2, 3, CAPACITY), qbytes = iqn_size(2, 5, 1);
    void *mem = malloc(bytes), *qmem = malloc(qbytes);
    double *x, out[2], v[2] = {1, 1}, g[2];
    wf *w = NULL;
    iqn *q = NULL;
    int window, i, j, most = 0;
    long iterations = 0;
    CHECK_INT(wf_make(&w, 2, 3, CAPACITY, mem, bytes), WF_OK);
    CHECK_INT(iqn_make(&q, 2, 5, 1, qmem, qbytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-8), IQN_OK);
    CHECK_INT(wf_push(w, 0, 0), 0);
    x = wf_column(w, 0);
    x[0] = 1, x[1] = 0;
    for (window = 0; window < 100000; window++) {
        for (i = 1; i <= 4; i++) {
            const double t = (window + i / 4.) * 0.1;
            j = wf_push(w, t, 0);
            CHECK(j >= 0);
            CHECK(wf_time(w, j) >= t && wf_time(w, j) <= t);
            x[2 * j] = cos(t), x[2 * j + 1] = sin(t);
        }
        if (window % 3 == 0) { /* the window is repeated: the same times find the same columns */
            CHECK_INT(wf_rollback(w), WF_OK);
            for (i = 1; i <= 4; i++) CHECK(wf_push(w, (window + i / 4.) * 0.1, 0) >= 0);
        }
        if (window % 1000 == 0) {
            CHECK_INT(wf_read(w, (window + 0.6) * 0.1, 0, out), WF_OK);
            CHECK_NEAR(out[0], cos((window + 0.6) * 0.1), 1e-7);
        }
        if (wf_columns(w) > most) most = wf_columns(w);
        CHECK_INT(wf_advance(w, 2), WF_OK);
        do {
            g[0] = 0.5 * cos(v[1]) + 0.1 * sin(window), g[1] = 0.5 * sin(v[0]);
            CHECK(iqn_step(q, v, g) >= 0);
            iterations++;
        } while (!iqn_converged(q));
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    CHECK_INT(most, 7);
    CHECK(iterations < 1000000);
    CHECK(iqn_get(q, IQN_NSTEPS) <= (double)iterations && iqn_get(q, IQN_NSTEPS) >= (double)iterations);
    free(mem), free(qmem);
}

/* ---- extremes of clocks and of loops --------------------------------------------------------------------------- */

/* A wave of 100 us sampled every microsecond, in windows of 10, by a clock that starts at t0; read between the samples.  The times are
   what the clock can hold: at 1.7e9 its numbers are 0.24 us apart.  by_count: values are those at the times before rounding, as of a
   solver whose step is 1e-6.  Returns the largest error; lost: samples without a column. */
static double microseconds(double t0, int by_count, int *lost)
{
    enum { SUB = 10, CAPACITY = 40 };
    const double omega = 2 * acos(-1.) / 100e-6;
    const size_t bytes = wf_size(1, 3, CAPACITY);
    void *mem = malloc(bytes);
    double t[SUB], v, worst = 0;
    wf *w = NULL;
    int window, k, j;
    CHECK_INT(wf_make(&w, 1, 3, CAPACITY, mem, bytes), WF_OK);
    CHECK_INT(wf_push(w, t0, 0), 0);
    *wf_column(w, 0) = 0;
    for (window = 0, *lost = 0; window < 200; window++) {
        const int start = wf_start(w);
        for (k = 0; k < SUB; k++) t[k] = t0 + (window * SUB + k + 1) * 1e-6;
        CHECK(wf_begin(w, 1, SUB, t, 0) >= 0);
        *lost += start + SUB + 1 - wf_columns(w);
        for (k = 0; k < SUB; k++) {
            j = wf_push(w, t[k], 0);
            CHECK(j == start + 1 + k && wf_time(w, j) >= t[k] && wf_time(w, j) <= t[k]);
            *wf_column(w, j) = sin(omega * (by_count ? (window * SUB + k + 1) * 1e-6 : t[k] - t0));
        }
        for (k = 0; window > 0 && k < 5 * SUB; k++) {
            volatile double time = t0 + (window * SUB + k / 5.) * 1e-6;
            CHECK_INT(wf_read(w, time, 0, &v), WF_OK);
            worst = fmax(worst, fabs(v - sin(omega * (time - t0))));
        }
        CHECK_INT(wf_advance(w, 4), WF_OK);
    }
    free(mem);
    return worst;
}

TEST(test_microseconds_of_unix_time)
{
    int lost, lost_late;
    const double error = microseconds(0, 0, &lost), late = microseconds(1.7e9, 0, &lost_late);
    const double solver = microseconds(0, 1, &lost), solver_late = microseconds(1.7e9, 1, &lost_late);
    const double half_a_spacing = (nextafter(1.7e9, 2e9) - 1.7e9) / 2, slope = 2 * acos(-1.) / 100e-6;
    CHECK_INT(lost, 0);
    CHECK_INT(lost_late, 0);
    CHECK(error < 1e-5 && late < 3 * error);
    CHECK(solver < 1e-5 && solver_late < 1.5 * half_a_spacing * slope);
    EXTREME("Unix time, samples every microsecond, 100 a period",
            "doubles are %.2g apart there, and %d of 2000 samples are lost; sampled at the rounded times a cubic is off by %.0e of the wave, from 0 by "
            "%.0e; by a solver whose step is 1e-6 by %.0e, from 0 by %.0e",
            nextafter(1.7e9, 2e9) - 1.7e9, lost_late, late, error, solver_late, solver);
}

/* Calls of H until iqn.h ends: h_i = x_i + b_i - s_i (x_i - 1), s_i from 1 to 1e-16.  The method knows no axes, so that any symmetric
   map of these eigenvalues takes the same way.  largest: |x_i| on the way; the answer is 1 everywhere. */
static int ill_conditioned(double limit, int *status, double *largest)
{
    enum { UNKNOWNS = 16 };
    const size_t bytes = iqn_size(UNKNOWNS, 40, 1);
    void *mem = malloc(bytes);
    double x[UNKNOWNS] = {0}, h[UNKNOWNS];
    iqn *q = NULL;
    int calls, i;
    CHECK_INT(iqn_make(&q, UNKNOWNS, 40, 1, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, limit), IQN_OK);
    for (calls = 0, *largest = 0; !iqn_converged(q); calls++) {
        for (i = 0; i < UNKNOWNS; i++) h[i] = x[i] - pow(10, -16. * i / (UNKNOWNS - 1)) * (x[i] - 1);
        *status = iqn_step(q, x, h);
        CHECK(*status >= 0);
        for (i = 0; i < UNKNOWNS; i++) *largest = fmax(*largest, fabs(x[i]));
    }
    free(mem);
    return calls;
}

/* Directions that |r| does not see are left as they are, and a limit that pairs in double cannot meet ends with a status. */
TEST(test_a_condition_of_1e16)
{
    int status, late_status;
    double largest, late_largest;
    const int calls = ill_conditioned(1e-7, &status, &largest), late = ill_conditioned(1e-13, &late_status, &late_largest);
    CHECK_INT(status, IQN_SOLVED);
    CHECK(calls <= 24);
    CHECK(late_status == IQN_SOLVED || late_status == IQN_NOISE || late_status == IQN_STALLED);
    CHECK(late <= 120 && largest < 5 && late_largest < 5);
    EXTREME("Condition 1e16, 16 unknowns",
            "the residual falls by 1e-7 in %d calls of H; a limit of 1e-13 ends after %d with status %d; no x on the way is above %.1f times the answer", calls,
            late, late_status, fmax(largest, late_largest));
}

/* Calls of H for 10 unknowns with gains from `gain` to 0.5; with columns 0 by relaxation alone. */
static int loop_calls(double gain, int columns, int *end)
{
    enum { UNKNOWNS = 10 };
    const size_t bytes = iqn_size(UNKNOWNS, columns, 1);
    void *mem = malloc(bytes);
    double x[UNKNOWNS] = {0}, h[UNKNOWNS];
    iqn *q = NULL;
    int calls, i;
    CHECK_INT(iqn_make(&q, UNKNOWNS, columns, 1, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK);
    for (calls = 0; !iqn_converged(q); calls++) {
        for (i = 0; i < UNKNOWNS; i++) h[i] = 1 + i + (gain + (0.5 - gain) * i / (UNKNOWNS - 1)) * x[i];
        CHECK(iqn_step(q, x, h) >= 0);
    }
    *end = iqn_converged(q);
    free(mem);
    return calls;
}

TEST(test_loop_gains_of_minus_2_and_minus_1000)
{
    static const double gain[] = {-2, -1000, -1e6};
    int calls[3], end, k, relaxed;
    for (k = 0; k < 3; k++) {
        calls[k] = loop_calls(gain[k], 20, &end);
        CHECK_INT(end, 1);
        CHECK(calls[k] <= 20); /* n + 2 in exact arithmetic */
    }
    relaxed = loop_calls(-1000, 0, &end); /* 0.1 times a gain of -1000 diverges, and says so */
    CHECK_INT(end, 2);
    EXTREME("Loop gains of -2, -1000, -1e6, 10 unknowns",
            "%d, %d and %d calls of H to 1e-9; relaxation alone diverges, and gives up after %d", calls[0], calls[1], calls[2], relaxed);
}

/* H has a logarithm, and fails where an x is not positive.  The host goes half of the way back as often as it fails. */
TEST(test_a_solver_that_fails)
{
    enum { UNKNOWNS = 8 };
    const size_t bytes = iqn_size(UNKNOWNS, 20, 1);
    void *mem = malloc(bytes);
    double x[UNKNOWNS], h[UNKNOWNS];
    iqn *q = NULL;
    int calls = 0, failures = 0, row = 0, most = 0, fails, i;
    CHECK_INT(iqn_make(&q, UNKNOWNS, 20, 1, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
    for (i = 0; i < UNKNOWNS; i++) x[i] = 5 + i;
    while (!iqn_converged(q) && calls + failures < 500) {
        for (fails = i = 0; i < UNKNOWNS; i++) fails |= !(x[i] > 0);
        if (fails) {
            CHECK_INT(iqn_halve(q, x), IQN_OK);
            failures++, row++;
            if (row > most) most = row;
            continue;
        }
        for (i = 0; i < UNKNOWNS; i++) h[i] = 1 + 0.2 * i - 20 * log(x[i]) + 0.5 * x[(i + 1) % UNKNOWNS];
        CHECK(iqn_step(q, x, h) >= 0);
        calls++, row = 0;
    }
    CHECK_INT(iqn_converged(q), 1);
    for (i = 0; i < UNKNOWNS; i++) CHECK_NEAR(x[i], 1 + 0.2 * i - 20 * log(x[i]) + 0.5 * x[(i + 1) % UNKNOWNS], 1e-6);
    CHECK(failures > 0);
    EXTREME("A solver that fails where x is not positive", "`iqn_halve` %d times, at most %d in a row: the answer after %d calls of H", failures,
            most, calls);
    free(mem);
}

/* h_i = g_i x_i + 1 with three different gains: three pairs are enough, whatever n is. */
static int calls_of_three_gains(ptrdiff_t n, double *error)
{
    static const double gain[] = {-3, 0.5, 0.9};
    const size_t bytes = iqn_size(n, 3, 1);
    double *mem = (double *)malloc(bytes), *x = (double *)calloc((size_t)n, sizeof *x), *h = (double *)malloc((size_t)n * sizeof *h);
    iqn *q = NULL;
    ptrdiff_t i;
    int calls = 0;
    if (!mem || !x || !h) calls = -1;
    else CHECK_INT(iqn_make(&q, n, 3, 1, mem, bytes), IQN_OK);
    if (q) CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    while (q && !iqn_converged(q)) {
        for (i = 0; i < n; i++) h[i] = gain[i % 3] * x[i] + 1;
        CHECK(iqn_step(q, x, h) >= 0);
        calls++;
    }
    for (*error = 0, i = 0; q && i < n; i++) *error = fmax(*error, fabs(x[i] * (1 - gain[i % 3]) - 1));
    if (q) CHECK_INT(iqn_converged(q), 1);
    free(mem), free(x), free(h);
    return calls;
}

TEST(test_1e7_unknowns)
{
    const ptrdiff_t n = (SIZE_MAX > 0xffffffffu ? 10000000 : 1000000) / LESS / LESS; /* 1 GB */
    double error, few_error;
    const int few = calls_of_three_gains(12, &few_error), calls = calls_of_three_gains(n, &error);
    if (calls < 0) {
        printf("# no memory for %.0e unknowns\n", (double)n);
        return;
    }
    CHECK_INT(calls, few);
    CHECK(error < 1e-8 && few_error < 1e-8);
    EXTREME("1e7 unknowns", "three different gains, 3 columns: %d calls of H, as with 12 unknowns; error %.0e", calls, error);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns_2_to_the_31_apart),
        cmocka_unit_test(test_sizes_beyond_2_to_the_31),
        cmocka_unit_test(test_200_columns),
        cmocka_unit_test(test_1e5_windows),
        cmocka_unit_test(test_microseconds_of_unix_time),
        cmocka_unit_test(test_a_condition_of_1e16),
        cmocka_unit_test(test_loop_gains_of_minus_2_and_minus_1000),
        cmocka_unit_test(test_a_solver_that_fails),
        cmocka_unit_test(test_1e7_unknowns),
    };
    check_named(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
