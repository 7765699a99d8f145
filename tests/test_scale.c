/* SPDX-License-Identifier: MIT

   test_scale.c - sizes that a test machine does not have: strides and lengths beyond 2^31 in memory mapped sparsely, sizes
   that overflow, 200 columns, 1e5 windows */
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

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns_2_to_the_31_apart),
        cmocka_unit_test(test_sizes_beyond_2_to_the_31),
        cmocka_unit_test(test_200_columns),
        cmocka_unit_test(test_1e5_windows),
    };
    check_named(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
