/* SPDX-License-Identifier: MIT

   bench_threads.c - the host's threads, and what they gain: compile with -fopenmp

   The headers start no threads.  The host does: rk.h works on a slice of the vectors where it is told so (pointers moved, the
   stride as it was), waveform.h on an object of each thread's numbers; iqn.h takes threads for what it takes processes for, each with its part of x and an
   object of its own, and a sum that waits for all.  One thread and all threads in turn, the least of many rounds by the clock,
   and whether the bits are the same.  What memory allows is measured beside them: a copy of the samples.  The goal is a gain
   of 1.5, or that of the copy where that is less.                                                                         */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"

#include "bench.h"
#include <omp.h>

enum { MOST = 64, PAIRS = 20, SAMPLES = 21, STAGES = 7 };

/* ---- a sum over threads -------------------------------------------------------------------------------------------------- */

typedef struct team {
    int threads;
    double *part[MOST];
} team;

static int sum_over_threads(double *v, int count, void *user)
{
    const team *all = (const team *)user;
    double s;
    int i, t;
    memcpy(all->part[omp_get_thread_num()], v, (size_t)count * sizeof *v);
#pragma omp barrier
    for (i = 0; i < count; i++) {
        for (s = 0, t = 0; t < all->threads; t++) s += all->part[t][i];
        v[i] = s;
    }
#pragma omp barrier
    return 0;
}

/* ---- work ---------------------------------------------------------------------------------------------------------------- */

typedef struct setup {
    ptrdiff_t n;
    team all;
    iqn *q[MOST];
    const rk_table *T;
    wf *w[MOST];
    double *x, *h, *k, *c[MOST], *out;
    unsigned long long next;
} setup;

static ptrdiff_t from(const setup *s, int thread) /* where the part of a thread begins */
{
    return s->n * thread / s->all.threads;
}

static double number(ptrdiff_t i, int j)
{
    return (double)((i * 7 + j * 13) % 101) / 101;
}

static void prepare(setup *s, ptrdiff_t n, int threads)
{
    ptrdiff_t i;
    int t, j;
    memset(s, 0, sizeof *s);
    s->n = n;
    s->all.threads = threads;
    for (t = 0; t < threads; t++) {
        const ptrdiff_t part = from(s, t + 1) - from(s, t);
        const size_t bytes = iqn_size(part, PAIRS, 1);
        const size_t room = wf_size(part, 3, SAMPLES);
        void *mem = malloc(bytes);
        s->all.part[t] = bench_memory(8192);
        if (!mem || iqn_make(&s->q[t], part, PAIRS, 1, mem, bytes) < 0 || iqn_set(s->q[t], IQN_GROWTH, 0) < 0 ||
            iqn_set_sum(s->q[t], sum_over_threads, &s->all) < 0)
            exit(1);
        wf_make(&s->w[t], part, 3, SAMPLES, bench_memory(room / sizeof(double) + 1), room);
        for (j = 0; j < SAMPLES; j++) wf_push(s->w[t], j / (SAMPLES - 1.), 0);
        s->c[t] = bench_memory((size_t)(SAMPLES * part));
    }
    s->T = rk_find("dp5");
    s->x = bench_memory((size_t)n);
    s->h = bench_memory((size_t)n);
    s->out = bench_memory((size_t)n);
    s->k = bench_memory((size_t)((STAGES + 1) * n));
    for (j = 0; j <= STAGES; j++) /* the same numbers for any number of threads */
        for (i = 0; i < n; i++) s->k[j * n + i] = number(i, j);
    for (t = 0; t < threads; t++)
        for (j = 0; j < SAMPLES; j++)
            for (i = from(s, t); i < from(s, t + 1); i++) wf_column(s->w[t], j)[i - from(s, t)] = number(i, j);
}

static void new_evaluation(setup *s) /* x and h, the same for any number of threads */
{
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) {
        s->next = s->next * 6364136223846793005ull + 1442695040888963407ull;
        s->x[i] = (double)(s->next >> 40) / 16777216;
        s->h[i] = (double)(s->next >> 16 & 0xffffff) / 16777216;
    }
}

#define EACH_THREAD(s, work)                                                            \
    _Pragma("omp parallel num_threads((s)->all.threads)")                               \
    {                                                                                   \
        const int t = omp_get_thread_num();                                             \
        const ptrdiff_t i = from(s, t), rows = from(s, t + 1) - i;                      \
        work;                                                                           \
    }

static void run_step(setup *s)
{
    EACH_THREAD(s, (void)rows; iqn_step(s->q[t], s->x + i, s->h + i))
}

static void run_fit(setup *s)
{
    EACH_THREAD(s, (void)rows; wf_fit(s->w[t], s->c[t]))
}

static void run_value(setup *s)
{
    EACH_THREAD(s, (void)rows; wf_eval(s->w[t], 0.47, 0, s->c[t], s->out + i))
}

static void run_stages(setup *s)
{
    EACH_THREAD(s, int stage; for (stage = 1; stage < STAGES; stage++)
                       rk_stage(s->T, stage, 0.1, rows, s->k + i, s->k + s->n + i, s->n, s->out + i))
}

/* What memory alone allows: the samples once to the place of the coefficients, a multiple so that it stays a loop. */
static void copy(ptrdiff_t n, const double *x, double *out)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++) out[i] = 0.5 * x[i];
}

static void run_copy(setup *s)
{
    EACH_THREAD(s, int j; for (j = 0; j < SAMPLES; j++) copy(rows, wf_column(s->w[t], j), s->c[t] + j * rows))
}

/* ---- the race ------------------------------------------------------------------------------------------------------------ */

enum { ITERATE, COPY, FIT, VALUE, STAGE_SUMS, WORKS };
static const struct {
    const char *name;
    void (*run)(setup *);
} work[WORKS] = {{"iqn_step, 20 pairs", run_step},
                 {"copy of 21 samples", run_copy},
                 {"wf_fit, 21 samples", run_fit},
                 {"wf_eval", run_value},
                 {"stages of dp5", run_stages}};

/* one has all numbers in one piece. */
static int same(const setup *one, const setup *all, int what)
{
    const int columns = what == COPY || what == FIT ? SAMPLES : 1;
    int t, j, equal = 1;
    if (columns == 1)
        return memcmp(what == ITERATE ? one->x : one->out, what == ITERATE ? all->x : all->out, (size_t)one->n * sizeof(double)) == 0;
    for (t = 0; t < all->all.threads; t++) {
        const ptrdiff_t i = from(all, t), rows = from(all, t + 1) - i;
        for (j = 0; j < columns; j++)
            equal = equal && memcmp(one->c[0] + j * one->n + i, all->c[t] + j * rows, (size_t)rows * sizeof(double)) == 0;
    }
    return equal;
}

/* One work: the least times of one thread and of all, in turn; whether the bits were always the same. */
static int measure(setup *one, setup *all, int what, int rounds, double least[2])
{
    setup *const s[2] = {one, all};
    int r, k, equal = 1;
    least[0] = least[1] = 1e9;
    for (r = what == ITERATE ? -PAIRS - 2 : -1; r < rounds; r++) {
        for (k = 0; k < 2; k++) {
            double t;
            if (what == ITERATE) new_evaluation(s[k]);
            t = bench_clock(0);
            work[what].run(s[k]);
            t = bench_clock(0) - t;
            if (r >= 0 && t < least[k]) least[k] = t;
        }
        equal = equal && same(one, all, what);
    }
    return equal;
}

static void bench(ptrdiff_t n, int threads)
{
    static setup one, all;
    const int rounds = n > 100000 ? 25 : 60;
    double least[WORKS][2];
    int what;
    prepare(&one, n, 1);
    prepare(&all, n, threads);
    for (what = 0; what < WORKS; what++) {
        const int equal = measure(&one, &all, what, rounds, least[what]);
        char key[100];
        printf("%-20s %8ld %12.4g %12.4g %8.2f   %s\n", work[what].name, (long)n, 1e6 * least[what][0], 1e6 * least[what][1],
               least[what][0] / least[what][1], equal ? "same bits" : "other bits");
        snprintf(key, sizeof key, "threads %s %ld", work[what].name, (long)n);
        bench_note("rows", key, least[what][0] / least[what][1], equal);
    }
    for (what = 0; what < WORKS && n == 1000000 && threads > 1; what++) {
        const double memory = least[COPY][1] / least[COPY][0];
        char key[100];
        if (what == COPY) continue;
        snprintf(key, sizeof key, "threads: %s, n = %ld, time / one thread's", work[what].name, (long)n);
        bench_goal(key, least[what][1] / least[what][0], memory > 1 / 1.5 ? memory : 1 / 1.5);
    }
}

int main(void)
{
    const int threads = omp_get_num_procs() < MOST ? omp_get_num_procs() : MOST;
    printf("\nthe host's threads: microseconds with one and with %d, gain (goal at 1e6: 1.5, or the copy's if that is less)\n", threads);
    bench(10000, threads);
    bench(100000, threads);
    bench(1000000, threads);
    return 0;
}
