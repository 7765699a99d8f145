/* SPDX-License-Identifier: MIT

   study_flags.c - the same calls under other compilers and flags: which results keep their bits, and how far the others
   go; and what they take.   study_flags write FILE | study_flags compare FILE | study_flags time
   What the host computes (data, maps, right-hand sides) is rounded after every operation here, so that only the headers'
   own arithmetic can differ. */
#include "study.h"

#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "examples/rk_proof.h"
#include "waveform.h"

enum { GROUPS = 12, MOST = 20000, N = 1000 };
static const char *name[GROUPS];
static int length[GROUPS], groups;
static double *value[GROUPS];

static double *group(const char *what, int count)
{
    name[groups] = what;
    length[groups] = count;
    return value[groups++] = study_vector(count);
}

static double times(double a, double b) { volatile double p = a * b; return p; }
static double plus(double a, double b) { volatile double s = a + b; return s; }

static void fill(int n, double *x)
{
    unsigned long long seed = 42;
    int i;
    for (i = 0; i < n; i++) x[i] = study_random(&seed);
}

static void waveforms(void)
{
    enum { SAMPLES = 9 };
    static double c[N * SAMPLES];
    const size_t bytes = wf_size(N, 5, SAMPLES);
    double *weights = group("wf_weights", SAMPLES * 20), *at = group("wf_fit, wf_eval", N * 20), *slope = group("wf_read, 2nd derivative", N);
    wf *w;
    int j;
    scene_check(wf_make(&w, N, 5, SAMPLES, scene_memory(bytes), bytes), "wf_make");
    for (j = 0; j < SAMPLES; j++) wf_push(w, plus(j, times(0.1, times(j, j))), 0);
    fill(N * SAMPLES, wf_column(w, 0));
    wf_fit(w, c);
    for (j = 0; j < 20; j++) {
        wf_weights(w, times(0.7, j), 0, weights + j * SAMPLES);
        wf_eval(w, times(0.7, j), 0, c, at + j * N);
    }
    wf_read(w, 3.3, 2, slope);
    free(w);
}

/* A weakly nonlinear map with a slow mode */
static void map(const double *x, double *h)
{
    int i;
    for (i = 0; i < N; i++) h[i] = plus(times(-0.9, x[i]), plus(times(0.5, x[(i + 1) % N]), plus(1, times(0.1, times(x[i], x[i])))));
}

static void quasi_newton(void)
{
    static double h[N];
    static const struct {
        const char *what;
        int method;
    } variant[] = {{"iqn_step, IQN-ILS", IQN_ILS}, {"iqn_step, Aitken", IQN_AITKEN}};
    int v, k;
    for (v = 0; v < 2; v++) {
        const size_t bytes = iqn_size(N, 20, 1);
        double *x = group(variant[v].what, N + 12);
        iqn *q;
        scene_check(iqn_make(&q, N, 20, 1, scene_memory(bytes), bytes), "iqn_make");
        iqn_set(q, IQN_METHOD, variant[v].method);
        fill(N, x);
        for (k = 0; k < 12; k++) {
            map(x, h);
            x[N + k] = iqn_step(q, x, h); /* the statuses, too */
        }
        free(q);
    }
}

static void runge_kutta(void)
{
    static const char *const tables[] = {"dp5", "esdirk3"};
    static double y[N], k[20 * N];
    const size_t bytes = rk_collocation_size(4);
    double *T_A = group("rk_collocation, gauss4", 16), *defect = group("rk_defect", 20);
    rk_table T;
    int t, i;
    scene_check(rk_collocation(&T, RK_GAUSS, 4, scene_memory(bytes), bytes), "rk_collocation");
    memcpy(T_A, T.A, 16 * sizeof(double));
    for (t = 0; t < 2; t++) {
        const rk_table *R = rk_find(tables[t]);
        const rk_step done = {R, 0.1, N, y, k, N};
        double *out = group(t ? "rk_stage, rk_update, rk_dense of esdirk3" : "rk_stage, rk_update, rk_dense of dp5", 4 * N);
        fill(N, y);
        fill(R->stages * N, k);
        rk_stage(R, R->stages - 1, 0.1, N, y, k, N, out);
        rk_update(R, 0.1, N, y, k, N, out + N, out + 2 * N);
        rk_dense(&done, 0.37, 0, out + 3 * N);
        for (i = 1; i <= 6; i++) defect[6 * t + i] = rk_defect(R, NULL, RK_OF_STEP, i) <= RK_TOLERANCE; /* the verdict; a residual is all rounding */
    }
}

/* ---- time: microseconds of a call, the least of many ---- */

typedef struct host {
    ptrdiff_t n;
    wf *w;
    iqn *q;
    double *x, *h, *c, *out; /* 32 iterates of an affine map, and H of them */
    int turn;
} host;
enum { ITERATES = 32, SAMPLED = 21 };
static const rk_table *dp5;
static volatile double seen; /* or a compiler leaves out what nobody reads */

static void fit_call(host *a) { wf_fit(a->w, a->c); }
static void read_call(host *a) { wf_read(a->w, 7.3, 0, a->out); }
static void step_call(host *a)
{
    const ptrdiff_t at = (a->turn++ % ITERATES) * a->n;
    memcpy(a->out, a->x + at, (size_t)a->n * sizeof *a->out);
    iqn_changed(a->q);
    iqn_step(a->q, a->out, a->h + at);
}
static void stages_call(host *a)
{
    int i;
    for (i = 1; i < dp5->stages; i++) rk_stage(dp5, i, 0.1, a->n, a->x, a->h, a->n, a->out);
    rk_update(dp5, 0.1, a->n, a->x, a->h, a->n, a->out, a->c);
}
static void norm_call(host *a)
{
    double sum[2] = {0, 0};
    rk_norm(1e-6, 1e-6, NULL, a->n, a->c, a->x, a->out, sum);
    seen = sum[0];
}

static void time_calls(ptrdiff_t n)
{
    static const struct {
        const char *name;
        void (*call)(host *a);
    } row[] = {{"iqn_step, 20 pairs", step_call}, {"wf_fit, 21 samples", fit_call}, {"wf_read", read_call},
               {"rk: stages of dp5", stages_call}, {"rk_norm", norm_call}};
    const size_t bytes = wf_size(n, 3, SAMPLED), qbytes = iqn_size(n, 20, 1);
    unsigned long long seed = 1;
    ptrdiff_t i;
    size_t r;
    host a = {0, NULL, NULL, NULL, NULL, NULL, NULL, 0};
    a.n = n, a.x = study_vector(ITERATES * n), a.h = study_vector(ITERATES * n), a.c = study_vector(SAMPLED * n);
    a.out = study_vector(n);
    scene_check(wf_make(&a.w, n, 3, SAMPLED, scene_memory(bytes), bytes), "wf_make");
    scene_check(iqn_make(&a.q, n, 20, 1, scene_memory(qbytes), qbytes), "iqn_make");
    for (i = 0; i < SAMPLED; i++) wf_push(a.w, (double)i, 0);
    for (i = 0; i < SAMPLED * n; i++) wf_column(a.w, 0)[i] = study_random(&seed);
    for (i = 0; i < ITERATES * n; i++) {
        a.x[i] = study_random(&seed);
        a.h[i] = 0.9 * cos((double)(i % n)) * a.x[i] + 1;
    }
    for (r = 0; r < sizeof row / sizeof *row; r++) {
        double least = HUGE_VAL, start;
        int calls = n < 10000 ? 200 : 20, round, k;
        for (round = 0; round < 7; round++) {
            for (start = study_now(), k = 0; k < calls; k++) row[r].call(&a);
            least = fmin(least, (study_now() - start) / calls);
        }
        printf("%s,%ld,%.4g\n", row[r].name, (long)n, 1e6 * least);
    }
    free(a.x), free(a.h), free(a.c), free(a.out), free(a.w), free(a.q);
}

int main(int argc, char **argv)
{
    FILE *f = argc == 3 ? fopen(argv[2], strcmp(argv[1], "write") == 0 ? "wb" : "rb") : NULL;
    int g, i;
    dp5 = rk_find("dp5");
    if (argc == 2 && strcmp(argv[1], "time") == 0) {
        for (i = 100; i <= 100000; i *= 10) time_calls(i);
        return 0;
    }
    if (!f) {
        fprintf(stderr, "usage: study_flags write FILE | study_flags compare FILE | study_flags time\n");
        return 2;
    }
    waveforms();
    quasi_newton();
    runge_kutta();
    for (g = 0; g < groups; g++) {
        static double before[MOST];
        double size = 0, worst = 0;
        if (strcmp(argv[1], "write") == 0) {
            fwrite(value[g], sizeof(double), (size_t)length[g], f);
            continue;
        }
        if (fread(before, sizeof(double), (size_t)length[g], f) != (size_t)length[g]) return 1;
        for (i = 0; i < length[g]; i++) size = fmax(size, fabs(before[i]));
        for (i = 0; i < length[g]; i++) worst = fmax(worst, fabs(value[g][i] - before[i]));
        if (memcmp(before, value[g], (size_t)length[g] * sizeof(double)) == 0) printf("%s,same\n", name[g]);
        else printf("%s,%.2g\n", name[g], worst / (size * DBL_EPSILON)); /* in last places of the largest number */
    }
    fclose(f);
    return 0;
}
