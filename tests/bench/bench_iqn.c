/* SPDX-License-Identifier: MIT

   bench_iqn.c - what a step of iqn.h costs with full columns, beside a hand-written step and the accelerators installed

   Random numbers as H(x): the pairs are independent, none is dropped, each step replaces the oldest.  Every contender has a
   process of its own (bench.h).  make bench OLD=folder: this file compiled with the iqn.h there is one, too.
   The hand-written step (floors.c) is in plain double and checks nothing.               */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include "bench.h"
#include "floors.h"

#ifdef HAVE_SUNDIALS
#    include "peer_sundials.h"
#    include <kinsol/kinsol.h>
#endif

typedef struct problem {
    ptrdiff_t n;
    int m;
} problem;

/* ---- contenders -------------------------------------------------------------------------------------------------------- */

static void hand(const void *user)
{
    const problem *p = (const problem *)user;
    const size_t n = (size_t)p->n, m = (size_t)p->m;
    floor_iqn s;
    double *x = bench_memory(n), *h = bench_memory(n);
    size_t j;
    s.n = p->n;
    s.m = p->m;
    s.slot = 0;
    s.V = bench_memory(n * m);
    s.W = bench_memory(n * m);
    s.r = bench_memory(n);
    s.hx = bench_memory(n);
    s.G = bench_memory(m * m);
    s.L = bench_memory(m * m);
    s.c = bench_memory(m);
    s.b = bench_memory(m);
    s.a = bench_memory(m);
    for (j = 0; j < m; j++) s.G[j * m + j] = 1;
    bench_hello("loops, -O3 -march=native");
    for (;;) {
        bench_random(p->n, h);
        bench_random(p->n, x);
        bench_begin();
        floor_step(&s, x, h);
        bench_end();
    }
}

static void ours(const void *user)
{
    const problem *p = (const problem *)user;
    const size_t bytes = iqn_size(p->n, p->m, 1);
    double *x = bench_memory((size_t)p->n), *h = bench_memory((size_t)p->n);
    void *mem = bench_memory(bytes / sizeof(double) + 1);
    iqn *q;
    int k;
    if (iqn_make(&q, p->n, p->m, 1, mem, bytes) < 0 || iqn_set(q, IQN_GROWTH, 0) < 0 || iqn_set(q, IQN_PATIENCE, 0) < 0)
        exit(1); /* random numbers make no progress: no pair is to go for that */
    for (k = 0;; k++) {
        bench_random(p->n, h);
        bench_random(p->n, x);
        if (k == 2 * p->m) {
            if (iqn_get(q, IQN_PAIRS) < p->m || iqn_get(q, IQN_NDROPPED) > 0) exit(1); /* not the work that is compared */
            bench_hello("iqn.h");
        }
        bench_begin();
        if (iqn_step(q, x, h) < 0) exit(1);
        if (k >= 2 * p->m) bench_end();
    }
}

#ifdef HAVE_SUNDIALS
static SUNContext context;

static int evaluate(N_Vector x, N_Vector h, void *user)
{
    static int called;
    (void)x;
    if (called) bench_end();
    else bench_hello(sundials_name("KINSOL", context));
    called = 1;
    bench_random(((const problem *)user)->n, N_VGetArrayPointer(h));
    bench_begin();
    return 0;
}

static void kinsol(const void *user)
{
    const problem *p = (const problem *)user;
    problem own = *p;
    N_Vector x, scale;
    void *kin;
    SUNContext_Create(NULL, &context);
    x = N_VNew_Serial((sunindextype)p->n, context);
    scale = N_VNew_Serial((sunindextype)p->n, context);
    N_VConst(1, scale);
    N_VConst(0, x);
    kin = KINCreate(context);
    KINSetUserData(kin, &own);
    KINSetMAA(kin, p->m);
    KINSetNumMaxIters(kin, 1000000000);
    KINInit(kin, evaluate, x);
    KINSetFuncNormTol(kin, 1e-300);
    KINSetPrintLevel(kin, 0);
    KINSol(kin, x, KIN_FP, scale, scale);
}
#endif

/* ---- the race ------------------------------------------------------------------------------------------------------------ */

enum { HAND, OURS, OLD, PETSC, KINSOL, SCIPY, COUNT };
static char petsc[400], scipy[400];
static contender all[COUNT] = {{"hand-written", hand, NULL, ""},
                               {"iqn.h", ours, NULL, ""},
                               {"the other iqn.h", NULL, "exit 1", ""},
                               {"PETSc", NULL, petsc, "petsc-dev"},
#ifdef HAVE_SUNDIALS
                               {"KINSOL", kinsol, NULL, "libsundials-dev"},
#else
                               {"KINSOL", NULL, "exit 1", "libsundials-dev"},
#endif
                               {"SciPy", NULL, scipy, "python3-scipy"}};

static void print_row(const race *r, const problem *p)
{
    int k;
    printf("%8ld %4d %10.4g ", (long)p->n, p->m, 1e6 * bench_median(r, HAND));
    for (k = 1; k < COUNT; k++)
        if (k == OLD && !r->here[k]) continue;
        else if (k < r->count && r->here[k])
            printf("| %8.4g %6.2f (%5.2f %6.2f) ", 1e6 * bench_median(r, k), bench_ratio(r, k, HAND, 0.5),
                   bench_ratio(r, k, HAND, 0.25), bench_ratio(r, k, HAND, 0.75));
        else printf("| %8s %6s  %5s %6s  ", "-", "-", "", "");
    printf("\n");
}

static void note(const race *r, const problem *p)
{
    char key[80];
    int k;
    for (k = 0; k < r->count; k++)
        if (r->here[k]) {
            snprintf(key, sizeof key, "iqn %ld %d %s", (long)p->n, p->m, all[k].name);
            bench_note("rows", key, 1e6 * bench_median(r, k), bench_ratio(r, k, HAND, 0.5));
        }
}

static void run(race *r, ptrdiff_t n, int m)
{
    const char *bin = getenv("BENCH_BIN");
    const int scipy_too = n <= 100000 && m <= 20;
    char size[50];
    problem p;
    p.n = n;
    p.m = m;
    snprintf(petsc, sizeof petsc, "exec '%s/peer_petsc' %ld %d", bin ? bin : "build", (long)n, m);
    snprintf(size, sizeof size, "%ld %d", (long)n, m);
    bench_versions(all + OURS, all + OLD, "iqn", size);
    snprintf(scipy, sizeof scipy, "set anderson %ld %d; %s", (long)n, m, bench_scipy);
    bench_race(r, all, scipy_too ? COUNT : SCIPY, &p, 2 * m + 2, n > 100000 ? 7 : 15);
    print_row(r, &p);
    note(r, &p);
}

/* ---- goals, growth, memory ---------------------------------------------------------------------------------------------- */

/* The goals in microseconds were set beside a hand-written step: what counts is the ratio. */
static const struct {
    ptrdiff_t n;
    int m;
    double limit; /* time over that of the hand-written step; 0: none */
    const char *key;
} table[] = {{100, 5, 0, ""},
             {100, 10, 3 / 0.885, "iqn step, N = 100, m = 10, / hand-written (3 us beside 0.885)"},
             {100, 20, 0, ""},
             {100, 50, 0, ""},
             {1000, 10, 0, ""},
             {1000, 20, 15 / 7.51, "iqn step, N = 1e3, m = 20, / hand-written (15 us beside 7.51)"},
             {1000, 50, 60 / 29.6, "iqn step, N = 1e3, m = 50, / hand-written (60 us beside 29.6)"},
             {1000, 200, 0, ""},
             {10000, 20, 0, ""},
             {100000, 10, 0, ""},
             {100000, 20, 1.1, "iqn step, N = 1e5, m = 20, / hand-written"},
             {100000, 50, 0, ""},
             {1000000, 10, 0, ""},
             {1000000, 20, 1.1, "iqn step, N = 1e6, m = 20, / hand-written"}};
enum { CASES = sizeof table / sizeof *table };

static double mine[CASES], floors[CASES];

/* 1.5 ms at m = 200 was set where the hand-written step at m = 50 took 29.6 us. */
static void goal_of_200_columns(void)
{
    double here = 0, t = 0;
    int i;
    for (i = 0; i < CASES; i++) {
        if (table[i].n == 1000 && table[i].m == 50) here = floors[i];
        if (table[i].n == 1000 && table[i].m == 200) t = mine[i];
    }
    bench_goal("iqn step, N = 1e3, m = 200, / hand-written at m = 50 (1500 us beside 29.6)", t / here, 1500 / 29.6);
}

/* Exponents over some rows; the hand-written step has the growth of the theory, and the caches, in it. */
static void growth(const char *name, double theory, const int *rows, int count, int along_n)
{
    double x[CASES], t[CASES], f[CASES], own, hand_written;
    char key[100];
    int i;
    for (i = 0; i < count; i++) {
        x[i] = along_n ? (double)table[rows[i]].n : table[rows[i]].m;
        t[i] = mine[rows[i]];
        f[i] = floors[rows[i]];
    }
    own = bench_exponent(count, x, t);
    hand_written = bench_exponent(count, x, f);
    printf("  %-36s %6.2f   hand-written %6.2f   theory at most %g\n", name, own, hand_written, theory);
    snprintf(key, sizeof key, "growth of the iqn step %s", name);
    bench_goal(key, own, (hand_written > theory ? hand_written : theory) + 0.15);
}

static void memory(void)
{
    const double a = (double)iqn_size(200000, 20, 1), b = (double)iqn_size(100000, 20, 1), c = (double)iqn_size(100000, 21, 1);
    const double per_number = (a - b) / 8 / 100000, per_column = (c - b) / 8 / 100000;
    const double m0 = (double)iqn_size(0, 1000, 1), m1 = (double)iqn_size(0, 2000, 1), m2 = (double)iqn_size(0, 3000, 1);
    const double per_square = (m2 - 2 * m1 + m0) / 2e6;
    printf("\nmemory: %.4g doubles per number with 20 columns (2 m + %.3g), %.4g per number and column;"
           " %.3g bytes per column squared\n",
           per_number, per_number - 40, per_column, per_square);
    bench_note("rows", "memory iqn", per_number - 40, per_square);
    bench_goal("memory of iqn: doubles per number beyond 2 m, m = 20", per_number - 40, 8);
    bench_goal("memory of iqn: doubles per number and column", per_column, 2.01);
    bench_goal("memory of iqn: bytes per column squared, one block", per_square, 48);
}

static int count_sum(double *v, int count, void *calls)
{
    (void)v;
    (void)count;
    ++*(int *)calls;
    return 0;
}

/* Calls of the host's sum in one step, with few and with many pairs. */
static void messages(void)
{
    static const int columns[] = {2, 10, 50};
    double x[60], h[60];
    size_t i;
    printf("sums over all processes in a step:");
    for (i = 0; i < sizeof columns / sizeof *columns; i++) {
        const size_t bytes = iqn_size(60, columns[i], 1);
        void *mem = malloc(bytes);
        int calls = 0, before = 0, k;
        char key[40];
        iqn *q;
        if (!mem || iqn_make(&q, 60, columns[i], 1, mem, bytes) < 0 || iqn_set_sum(q, count_sum, &calls) < 0) exit(1);
        for (k = 0; k < 55; k++) {
            before = calls;
            bench_random(60, x);
            bench_random(60, h);
            if (iqn_step(q, x, h) < 0) exit(1);
        }
        printf(" %d with %d pairs%s", calls - before, columns[i], i < 2 ? "," : "\n");
        snprintf(key, sizeof key, "sums %d", columns[i]);
        bench_note("rows", key, calls - before, 0);
        free(mem);
    }
}

int main(int argc, char **argv) /* with the numbers of a problem: a contender */
{
    static const int in_n[] = {10, 13}, in_m[] = {12, 13}, small[] = {5, 6, 7};
    static race r, names;
    int i;
    if (argc == 3) {
        problem p;
        p.n = atol(argv[1]);
        p.m = atoi(argv[2]);
        ours(&p);
    }
    printf("One step of iqn.h, full columns: microseconds, ratio to the hand-written step of the same rounds (quartiles)\n");
    printf("%8s %4s %10s | %-31s%s| %-31s| %-31s| %-31s\n", "N", "m", "hand us", "iqn.h", getenv("BENCH_OLD") ? "| the other iqn.h                 " : " ",
           "PETSc Anderson", "KINSOL, MGS", "SciPy Anderson");
    for (i = 0; i < CASES; i++) {
        run(&r, table[i].n, table[i].m);
        if (i == 0) names = r;
        if (!r.here[OURS]) {
            fprintf(stderr, "bench_iqn: not all pairs were kept\n");
            return 1;
        }
        mine[i] = bench_median(&r, OURS);
        floors[i] = bench_median(&r, HAND);
        if (table[i].limit > 0) bench_goal(table[i].key, bench_ratio(&r, OURS, HAND, 0.5), table[i].limit);
        if (table[i].n == 100 && table[i].m == 10 && r.here[KINSOL])
            bench_goal("iqn step, N = 100, m = 10, / KINSOL here", bench_ratio(&r, OURS, KINSOL, 0.5), 1);
        if (r.here[OLD]) {
            char key[80];
            snprintf(key, sizeof key, "iqn step, N = %ld, m = %d, / the other iqn.h", (long)table[i].n, table[i].m);
            bench_goal(key, bench_ratio(&r, OURS, OLD, 0.5), 1.05);
        }
        if (r.here[PETSC]) {
            char key[80];
            snprintf(key, sizeof key, "iqn step, N = %ld, m = %d, / PETSc", (long)table[i].n, table[i].m);
            bench_goal(key, bench_ratio(&r, OURS, PETSC, 0.5), 1);
        }
    }
    bench_names("iqn", &names, all, COUNT);
    goal_of_200_columns();
    printf("growth, exponents:\n");
    growth("in N, 1e5 to 1e6, m = 20", 1, in_n, 2, 1);
    growth("in m, 10 and 20, N = 1e6", 1, in_m, 2, 0);
    growth("in m, 20 to 200, N = 1000", 3, small, 3, 0);
    memory();
    messages();
    return 0;
}
