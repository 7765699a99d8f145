/* SPDX-License-Identifier: MIT

   bench_host.c - whether the host's own loops run as fast after a call of the headers as before it

   A function that leaves the upper halves of the vector registers in use slows down every loop compiled for older
   processors until something cleans them: 2.6 (dot), 5.6 (axpy), 4.1 (division) times on a Zen 4, not at all on an
   Emerald Rapids.  Each round: clean, time a loop of the host, call, time the loop again.  A series of rounds gives
   after / before, the quickest tenth of either; the numbers are medians of series, which the loops run in turn.  The last
   row leaves the halves in use on purpose: where it says 1.00, the times prove nothing here.
   The last column asks the processor itself (XGETBV with 1: the state components in use). */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "bench.h"
#include "waveform.h"

#if defined(__GNUC__) && defined(__x86_64__)
#    include <cpuid.h>
#endif

enum { LENGTH = 4096, REPEATS = 10, ROUNDS = 51, SERIES = 11, N = 64, COLUMNS = 8 };

static double a[LENGTH], b[LENGTH];
static volatile double sink;

static void clean(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx")) __asm__ volatile("vzeroupper" ::: "xmm0");
#endif
}

static void soil(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        __asm__ volatile("vpcmpeqd %%ymm0, %%ymm0, %%ymm0\n\tvpcmpeqd %%ymm1, %%ymm1, %%ymm1\n\t"
                         "vpcmpeqd %%ymm2, %%ymm2, %%ymm2\n\tvpcmpeqd %%ymm3, %%ymm3, %%ymm3" ::
                             : "xmm0", "xmm1", "xmm2", "xmm3");
#endif
}

static const char *upper_halves(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    unsigned eax, ebx, ecx, edx;
    if (!__builtin_cpu_supports("avx") || !__get_cpuid_count(13, 1, &eax, &ebx, &ecx, &edx) || !(eax & 4)) return "-";
    __asm__ volatile("xgetbv" : "=a"(eax), "=d"(edx) : "c"(1));
    return eax & 4 ? "in use" : "clean";
#else
    return "-";
#endif
}

/* ---- the host's loops ---- */

static void dot(void)
{
    double s = 0;
    int i;
    for (i = 0; i < LENGTH; i++) s += a[i] * b[i];
    sink = s;
}

static void axpy(void)
{
    int i;
    for (i = 0; i < LENGTH; i++) b[i] += 1e-9 * a[i];
}

static void division(void)
{
    int i;
    for (i = 0; i < LENGTH; i++) b[i] = 1 + a[i] / (2 + b[i]);
}

/* ---- the calls ---- */

static double mem_iqn[8 * N * COLUMNS], mem_wf[2 * COLUMNS * N], x[COLUMNS * N], c[COLUMNS * N], v[N], sum[4];
static iqn *q;
static wf *w;
static const rk_table *T;
static int calls;

static void step(void)
{
    int i;
    for (i = 0; i < N; i++) {
        x[i] = (double)((i * 7 + calls * 13) % 101) / 101;
        v[i] = (double)((i * 11 + calls * 5) % 97) / 97;
    }
    calls++;
    if (iqn_step(q, x, v) < 0) exit(1);
}

static void commit(void)
{
    step();
    if (iqn_commit(q) < 0) exit(1);
}

static void read_samples(void)
{
    if (wf_read(w, 0.3, 0, v) < 0) exit(1);
}

static void fit_and_evaluate(void)
{
    if (wf_fit(w, x) < 0 || wf_eval(w, 0.3, 1, x, v) < 0) exit(1);
}

static void stage_and_finish(void)
{
    if (rk_stage(T, T->stages - 1, 0.1, N, c, x, N, v) < 0 || rk_finish(T, 0.1, N, c, x, N, v, NULL) < 0) exit(1);
}

static void dense_and_norm(void)
{
    const rk_step done = {T, 0.1, N, c, x, N};
    if (rk_dense(&done, 0.3, 0, v) < 0 || rk_norm(1e-6, 1e-6, NULL, N, v, c, c, sum) < 0) exit(1);
}

static void prepare(void)
{
    int i;
    for (i = 0; i < LENGTH; i++) a[i] = b[i] = 1 + (double)(i % 97) / 97;
    for (i = 0; i < COLUMNS * N; i++) x[i] = c[i] = (double)(i % 89) / 89;
    if (iqn_make(&q, N, COLUMNS, 1, mem_iqn, sizeof mem_iqn) < 0) exit(1);
    if (wf_make(&w, N, 3, COLUMNS, mem_wf, sizeof mem_wf) < 0) exit(1);
    for (i = 0; i < COLUMNS; i++) wf_push(w, i / 7., 0);
    memcpy(wf_column(w, 0), c, sizeof c);
    T = rk_find("dp5");
}

static double timed(void (*loop)(void))
{
    const double start = bench_clock(0);
    int r;
    for (r = 0; r < REPEATS; r++) loop();
    return bench_clock(0) - start;
}

static double after_over_before(void (*loop)(void), void (*call)(void))
{
    double before[ROUNDS], after[ROUNDS];
    int r;
    for (r = 0; r < ROUNDS; r++) {
        clean();
        loop();
        before[r] = timed(loop);
        call();
        after[r] = timed(loop);
    }
    clean(); /* the quickest tenth: undisturbed by other jobs, and not the luck of one round */
    return bench_quantile(after, ROUNDS, 0.1) / bench_quantile(before, ROUNDS, 0.1);
}

/* The median of each loop. */
static void many_series(void (*call)(void), double ratio[3])
{
    static void (*const loop[3])(void) = {dot, axpy, division};
    double series[3][SERIES];
    int i, j;
    for (i = 0; i < SERIES; i++)
        for (j = 0; j < 3; j++) series[j][i] = after_over_before(loop[j], call);
    for (j = 0; j < 3; j++) ratio[j] = bench_quantile(series[j], SERIES, 0.5);
}

int main(void)
{
    static const struct {
        const char *name;
        void (*run)(void);
    } call[] = {{"clean", clean},
                {"iqn_step", step},
                {"iqn_step, iqn_commit", commit},
                {"wf_read", read_samples},
                {"wf_fit, wf_eval", fit_and_evaluate},
                {"rk_stage, rk_finish", stage_and_finish},
                {"rk_dense, rk_norm", dense_and_norm},
                {"upper halves in use", soil}};
    size_t k;
    prepare();
    printf("The host's loops of %d numbers, time after a call / before it (1.00: unharmed)\n", LENGTH);
    printf("%-22s %8s %8s %10s   %s\n", "call", "dot", "axpy", "division", "upper halves");
    for (k = 0; k < sizeof call / sizeof *call; k++) {
        const char *halves;
        double ratio[3], most = 0;
        char key[80];
        int j;
        clean();
        call[k].run();
        halves = upper_halves();
        many_series(call[k].run, ratio);
        printf("%-22s %8.2f %8.2f %10.2f   %s\n", call[k].name, ratio[0], ratio[1], ratio[2], halves);
        for (j = 0; j < 3; j++)
            if (ratio[j] > most) most = ratio[j];
        snprintf(key, sizeof key, "host's loop after %s, / before", call[k].name);
        if (call[k].run != clean && call[k].run != soil) bench_goal(key, most, 1.05);
    }
    return 0;
}
