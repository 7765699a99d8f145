/* SPDX-License-Identifier: MIT

   bench_rk.c - what a Dormand-Prince step of y' = -y and its dense output cost, beside the memory floor of the same run,
   plain loops written for the purpose, and the peers installed.  Contenders take turns; medians over the rounds, ratios
   within each round.

      loops      a step as seven loops with the coefficients typed in, arrays that do not alias, right-hand sides included
      rk.h       the same step by rk_stage and rk_finish; then with the error estimate and its weighted norm
      dense      one value of the quartic inside the step: one plain loop, rk_dense, and 4 values by rk_dense_many (each)
      bound      n = 1e6: the vectors that must move, at the bandwidth of a triad a = b + s c in this run               */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define RK_IMPLEMENTATION
#include "rk.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifdef HAVE_GSL
#    include <gsl/gsl_odeiv2.h>
#endif
#ifdef HAVE_SUNDIALS
#    include <arkode/arkode_erkstep.h>
#    include <nvector/nvector_serial.h>
#    include <sundials/sundials_version.h>
#endif

enum { ROUNDS = 25 };

typedef struct setup {
    ptrdiff_t n;
    double *y, *k, *z, *err, *out, h;
    const rk_table *T;
#ifdef HAVE_GSL
    gsl_odeiv2_step *gsl;
    gsl_odeiv2_system system;
#endif
#ifdef HAVE_SUNDIALS
    SUNContext context;
    N_Vector v, dky;
    void *fixed;
    sunrealtype t;
#endif
} setup;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void decay(ptrdiff_t n, const double *y, double *f)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++) f[i] = -y[i];
}

/* ---- contenders -------------------------------------------------------------------------------------------------------- */

static void triad(setup *s)
{
    const double *restrict b = s->k, *restrict c = s->k + s->n;
    double *restrict a = s->out;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) a[i] = b[i] + 0.1 * c[i];
}

static void loops(setup *s)
{
    const ptrdiff_t n = s->n;
    const double *restrict y = s->y, h = s->h;
    double *restrict z = s->z, *restrict k1 = s->k, *restrict k2 = k1 + n, *restrict k3 = k2 + n, *restrict k4 = k3 + n;
    double *restrict k5 = k4 + n, *restrict k6 = k5 + n, *restrict k7 = k6 + n;
    ptrdiff_t i;
    for (i = 0; i < n; i++) z[i] = y[i] + h / 5 * k1[i];
    decay(n, z, k2);
    for (i = 0; i < n; i++) z[i] = y[i] + h * 3 / 40 * k1[i] + h * 9 / 40 * k2[i];
    decay(n, z, k3);
    for (i = 0; i < n; i++) z[i] = y[i] + h * 44 / 45 * k1[i] - h * 56 / 15 * k2[i] + h * 32 / 9 * k3[i];
    decay(n, z, k4);
    for (i = 0; i < n; i++)
        z[i] = y[i] + h * 19372 / 6561 * k1[i] - h * 25360 / 2187 * k2[i] + h * 64448 / 6561 * k3[i] -
               h * 212 / 729 * k4[i];
    decay(n, z, k5);
    for (i = 0; i < n; i++)
        z[i] = y[i] + h * 9017 / 3168 * k1[i] - h * 355 / 33 * k2[i] + h * 46732 / 5247 * k3[i] + h * 49 / 176 * k4[i] -
               h * 5103 / 18656 * k5[i];
    decay(n, z, k6);
    for (i = 0; i < n; i++)
        z[i] = y[i] + h * 35 / 384 * k1[i] + h * 500 / 1113 * k3[i] + h * 125 / 192 * k4[i] - h * 2187 / 6784 * k5[i] +
               h * 11 / 84 * k6[i];
    decay(n, z, k7);
}

static void ours(setup *s)
{
    int i;
    for (i = 1; i < 7; i++) { /* first same as last: k_1 is there, and the z of the last stage is the new y */
        rk_stage(s->T, i, s->h, s->n, s->y, s->k, s->n, s->z);
        decay(s->n, s->z, s->k + i * s->n);
    }
}

static void ours_with_error(setup *s)
{
    double sum[4] = {0};
    ours(s);
    rk_finish(s->T, s->h, s->n, s->y, s->k, s->n, NULL, s->err);
    rk_norm(1e-6, 1e-9, NULL, s->n, s->err, s->y, s->z, sum);
    s->out[0] = rk_rms(sum);
}

static void dense_loop(setup *s)
{
    const ptrdiff_t n = s->n;
    const double *restrict y = s->y, *restrict k = s->k;
    double *restrict out = s->out, w[7];
    ptrdiff_t i;
    int j;
    rk_weights(s->T, 0.3, 0, w);
    for (j = 0; j < 7; j++) w[j] *= s->h;
    for (i = 0; i < n; i++)
        out[i] = y[i] + w[0] * k[i] + w[2] * k[i + 2 * n] + w[3] * k[i + 3 * n] + w[4] * k[i + 4 * n] +
                 w[5] * k[i + 5 * n] + w[6] * k[i + 6 * n];
}

static void dense(setup *s)
{
    const rk_step done = {s->T, s->h, s->n, s->y, s->k, s->n};
    rk_dense(&done, 0.3, 0, s->out);
}

static void dense_many(setup *s)
{
    static const double theta[] = {0.2, 0.4, 0.6, 0.8};
    const rk_step done = {s->T, s->h, s->n, s->y, s->k, s->n};
    rk_dense_many(&done, 4, theta, 0, s->out, s->n);
}

#ifdef HAVE_GSL
static int gsl_decay(double t, const double *y, double *f, void *user)
{
    (void)t;
    decay(((setup *)user)->n, y, f);
    return 0;
}

static void gsl(setup *s)
{
    gsl_odeiv2_step_apply(s->gsl, 0, s->h, s->z, s->err, s->k, s->k + s->n, &s->system);
}
#endif

#ifdef HAVE_SUNDIALS
static int ark_decay(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    (void)t;
    decay(((setup *)user)->n, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    return 0;
}

static void arkode(setup *s)
{
    ERKStepEvolve(s->fixed, 1e9, s->v, &s->t, ARK_ONE_STEP);
}

static void arkode_dense(setup *s)
{
    ERKStepGetDky(s->fixed, s->t - 0.7 * s->h, 0, s->dky);
}
#endif

/* ---- the run ------------------------------------------------------------------------------------------------------------- */

static void bench(ptrdiff_t n)
{
    static const struct {
        const char *name;
        void (*run)(setup *);
        double each;
    } contender[] = {
        {"triad", triad, 1},
        {"step: loops", loops, 1},
        {"step: rk.h", ours, 1},
        {"step: rk.h, error norm", ours_with_error, 1},
#ifdef HAVE_GSL
        {"step: GSL rkf45", gsl, 1},
#endif
#ifdef HAVE_SUNDIALS
        {"step: ARKODE, fixed", arkode, 1},
#endif
        {"dense: one loop", dense_loop, 1},
        {"dense: rk_dense", dense, 1},
        {"dense: rk_dense_many/4", dense_many, 4},
#ifdef HAVE_SUNDIALS
        {"dense: ARKODE cubic", arkode_dense, 1},
#endif
    };
    enum { count = sizeof contender / sizeof *contender };
    double time[count][ROUNDS];
    int step = 0, loop = 0;
    setup s;
    ptrdiff_t i;
    int c, r;
    memset(&s, 0, sizeof s);
    s.n = n;
    s.h = 1e-7; /* y stays what it is, however many steps */
    s.T = rk_find("dp5");
    s.y = (double *)malloc((size_t)(14 * n) * sizeof *s.y);
    if (!s.y) {
        fprintf(stderr, "no memory\n");
        exit(1);
    }
    s.z = s.y + n;
    s.err = s.z + n;
    s.k = s.err + n;
    s.out = s.k + 7 * n;
    for (i = 0; i < 14 * n; i++) s.y[i] = 1 + 1e-3 * (double)(i % 97);
#ifdef HAVE_GSL
    s.system.function = gsl_decay;
    s.system.dimension = (size_t)n;
    s.system.params = &s;
    s.gsl = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkf45, (size_t)n);
#endif
#ifdef HAVE_SUNDIALS
    SUNContext_Create(NULL, &s.context);
    s.v = N_VNew_Serial((sunindextype)n, s.context);
    s.dky = N_VNew_Serial((sunindextype)n, s.context);
    N_VConst(1, s.v);
    s.fixed = ERKStepCreate(ark_decay, 0, s.v, s.context);
    ERKStepSetUserData(s.fixed, &s);
    ERKStepSetTableNum(s.fixed, ARKODE_DORMAND_PRINCE_7_4_5);
    ERKStepSetFixedStep(s.fixed, s.h);
    ERKStepSetMaxNumSteps(s.fixed, -1);
#endif
    for (r = 0; r < ROUNDS; r++)
        for (c = 0; c < count; c++) {
            const int repeats = n < 100 ? 3000 : n < 100000 ? 100 : 1; /* short: a round should fit a time slice */
            double start;
            contender[c].run(&s);
            start = now();
            for (i = 0; i < repeats; i++) contender[c].run(&s);
            time[c][r] = (now() - start) / repeats / contender[c].each * 1e6;
        }
    for (c = 0; c < count; c++) {
        if (contender[c].run == loops) step = c;
        if (contender[c].run == dense_loop) loop = c;
    }
    printf("\nn = %-20ld median us   best us   / plain loops%s\n", (long)n, n > 100000 ? "   / bound" : "");
    for (c = 0; c < count; c++) {
        const int is_step = strncmp(contender[c].name, "step", 4) == 0, reference = is_step ? step : loop;
        /* vectors moved, a write counting twice: 5 sums of 2..6 and one of 6 vectors with their writes, six right-hand
           sides; with the error 6 reads, a write and the norm's 3 reads; one dense value 7 reads and a write */
        const double vectors = contender[c].run == ours_with_error ? 56 + 6 + 2 + 3
                               : is_step                           ? 56
                               : contender[c].run == dense_many    ? (7 + 8) / 4.
                                                                   : 9;
        double ratio[ROUNDS], bound[ROUNDS], sorted[ROUNDS];
        for (r = 0; r < ROUNDS; r++) { /* of the same round: other jobs slow both alike */
            ratio[r] = time[c][r] / time[reference][r];
            bound[r] = time[c][r] / (vectors / 4 * time[0][r]);
        }
        memcpy(sorted, time[c], sizeof sorted);
        qsort(sorted, ROUNDS, sizeof *sorted, ascending);
        qsort(ratio, ROUNDS, sizeof *ratio, ascending);
        qsort(bound, ROUNDS, sizeof *bound, ascending);
        printf("%-24s %12.4g %9.4g", contender[c].name, sorted[ROUNDS / 2], sorted[0]);
        if (c > 0) printf("   %10.2f", ratio[ROUNDS / 2]);
        if (c > 0 && n > 100000) printf("   %10.2f", bound[ROUNDS / 2]);
        printf("\n");
    }
#ifdef HAVE_GSL
    gsl_odeiv2_step_free(s.gsl);
#endif
#ifdef HAVE_SUNDIALS
    ERKStepFree(&s.fixed);
    N_VDestroy(s.v);
    N_VDestroy(s.dky);
    SUNContext_Free(&s.context);
#endif
    free(s.y);
}

/* What proving a table costs: a check is cheap enough to run whenever a table is loaded. */
static void proof(void)
{
    static const char *const names[] = {"bs3", "dp5", "esdirk4b", "verner6", "dop853"};
    static double mem[8000];
    size_t i;
    int r;
    printf("\nproof                     rk_check us   rk_extend us (own slopes, order of the shipped dense output)\n");
    for (i = 0; i < sizeof names / sizeof *names; i++) {
        const rk_table *T = rk_find(names[i]);
        double check[ROUNDS], extend[ROUNDS], start, defect;
        rk_table X;
        for (r = 0; r < ROUNDS; r++) {
            start = now();
            rk_check(T, &defect);
            check[r] = (now() - start) * 1e6;
            start = now();
            rk_extend(&X, T, NULL, T->dense_order, 0, mem, sizeof mem);
            extend[r] = (now() - start) * 1e6;
        }
        qsort(check, ROUNDS, sizeof *check, ascending);
        qsort(extend, ROUNDS, sizeof *extend, ascending);
        printf("%-24s %12.4g %14.4g\n", names[i], check[ROUNDS / 2], extend[ROUNDS / 2]);
    }
}

int main(void)
{
    printf("rk.h: a Dormand-Prince step of y' = -y with 6 right-hand sides, and its dense output\n");
#ifdef HAVE_SUNDIALS
    {
        char version[32] = "";
        SUNDIALSGetVersion(version, 31);
        printf("ARKODE %s as installed (Debian compiles its package without optimisation: about 4 times slower than "
               "-O3)\n",
               version);
    }
#endif
    bench(10);
    bench(1000);
    bench(1000000);
    proof();
    return 0;
}
