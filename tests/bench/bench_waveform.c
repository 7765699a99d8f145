/* SPDX-License-Identifier: MIT

   bench_waveform.c - what waveform.h costs, beside copies and plain loops, and the peers installed

      fit          samples to coefficients           / memcpy of the samples; n = 1: / a band substitution, row by row
      value        one value from coefficients       / out = sum of four weighted columns
      slope        the first derivative              / wf_eval of the value
      interpolate  one value from the m samples      / out = sum of m weighted columns
      resample     samples on m times to m others    / memcpy of the samples
      push         a window of m columns, from its start on, and the grid made of it
      rebuild      the grid alone, its times pushed before   / push of the other version
      quality      wf_quality; error: wf_error, one number; both grow with the samples alone

   Degree 3.  Every contender has a process of its own (bench.h).  make bench OLD=folder: this file compiled with the waveform.h
   of that folder, 0.2.0 or later, takes part, and pushes and rebuilds are compared on grids of many kinds.              */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define WF_IMPLEMENTATION
#include "waveform.h"

#include "bench.h"
#include "floors.h"

#ifdef HAVE_GSL
#    include <gsl/gsl_bspline.h>
#    include <gsl/gsl_linalg.h>
#    include <gsl/gsl_version.h>
#endif

#if WF_VERSION < 300 /* 0.2.0 by the calls of today: the samples lie with the host, and a push updates the grid */
#    define wf_size(n, degree, m) ((void)(n), wf_size(degree, m))
#    define wf_make(w, n, degree, m, mem, bytes) wf_make(w, degree, m, mem, bytes)
#    define wf_push(w, t, what) ((what) ? wf_push_hermite(w, t) : wf_push(w, t))
#    define wf_column(w, j) bench_memory((size_t)(p->n * p->m))
#    define wf_fit(w, c) wf_fit(w, s->n, s->x, s->n, c, s->n)
#    define wf_eval(w, t, deriv, c, out) wf_eval(w, t, deriv, s->n, c, s->n, out)
#    define wf_read(w, t, deriv, out) wf_interpolate(w, t, deriv, s->n, s->x, s->n, out)
#    define wf_resample(from, to) wf_resample(from, to, s->n, s->x, s->n, s->c, s->n)
#    define wf_error(w, other, out) wf_error(w, s->n, s->x, s->n, out)
#    define wf_quality(w, noise) wf_quality(w, NULL, noise)
#    define WF_SLOPE 1
#endif

enum { FIT, VALUE, SLOPE, INTERPOLATE, RESAMPLE, PUSH, REBUILD, QUALITY, ERROR };
static const char *const word[] = {"fit", "value", "slope", "interpolate", "resample", "push", "rebuild", "quality", "error"};

typedef struct problem {
    int what;
    ptrdiff_t n;
    int m;              /* columns */
    int degree, slopes; /* 0: 3; whether every second column is a derivative */
    int kind;           /* of the steps, see next_step */
} problem;

typedef struct setup {
    wf *w, *other; /* of resample: the other times; of error: work space */
    int m, degree, what, times;
    ptrdiff_t n;
    double *t, *x, *c, *out, *weight, *band; /* x: the samples of w */
} setup;

static double time_of(int j, int m) /* nearly even */
{
    return (j + (j % (m - 1) ? 0.2 : 0)) / (m - 1);
}

enum { EVEN, CHANCE_2, CHANCE_5, CHANCE_10, GRADED, KINDS };

/* Step j: of length 1, between 1 and 2, 5 or 10 by chance, or down from 1 to 1e-3 in eight steps, and again. */
static double next_step(int kind, int j)
{
    static const double most[] = {1, 2, 5, 10};
    double v;
    bench_random(1, &v);
    return kind == GRADED ? pow(10, -3. * (j % 8) / 7) : pow(most[kind], (1 + v) / 2);
}

static wf *make(ptrdiff_t n, int degree, int m)
{
    const size_t bytes = wf_size(n, degree, m);
    wf *w = NULL;
    wf_make(&w, n, degree, m, bench_memory(bytes / sizeof(double) + 1), bytes);
    return w;
}

static void prepare(setup *s, const problem *p)
{
    const size_t n = (size_t)p->n, m = (size_t)p->m;
    int j;
    s->n = p->n;
    s->m = p->m;
    s->degree = p->degree ? p->degree : 3;
    s->what = p->slopes ? WF_SLOPE : 0;
    s->times = p->slopes ? p->m / 2 : p->m;
    s->t = bench_memory(m);
    s->w = make(p->n, s->degree, p->m);
    s->other = p->what == RESAMPLE ? make(p->n, 3, p->m) : make(0, 5, p->m);
    s->c = bench_memory(n * m);
    s->out = bench_memory(n);
    s->weight = bench_memory(m);
    s->band = bench_memory(7 * m);
    for (j = 0; j < p->m; j++) {
        const double t = time_of(j, p->m);
        s->t[j] = p->degree == 0 ? t : j > 0 ? s->t[j - 1] + next_step(p->kind, j) : 0;
        if (j < s->times) wf_push(s->w, s->t[j], s->what);
        if (p->what == RESAMPLE) wf_push(s->other, j % (p->m - 1) ? t * 0.98 + 0.01 : t, 0);
        s->weight[j] = 1. / p->m;
        s->band[7 * j + 3] = 1;
    }
    s->x = wf_column(s->w, 0);
    bench_random(p->n * p->m, s->x);
    wf_fit(s->w, s->c);
}

/* ---- floors ------------------------------------------------------------------------------------------------------------ */

static void copy(void *user)
{
    setup *s = (setup *)user;
    memcpy(s->c, s->x, (size_t)s->n * (size_t)s->m * sizeof(double));
}

static void band(void *user)
{
    setup *s = (setup *)user;
    floor_band(s->m, s->band, s->x, s->c);
}

static void four(void *user)
{
    setup *s = (setup *)user;
    floor_sum(s->n, 4, s->weight, s->c, s->out);
}

static void all_columns(void *user)
{
    setup *s = (setup *)user;
    floor_sum(s->n, s->m, s->weight, s->x, s->out);
}

static void our_value(void *user)
{
    setup *s = (setup *)user;
    wf_eval(s->w, 0.47, 0, s->c, s->out);
}

static void hand(const void *user)
{
    const problem *p = (const problem *)user;
    setup s;
    prepare(&s, p);
    if (p->what == FIT && p->n == 1) bench_laps("a band substitution", band, &s);
    if (p->what == FIT || p->what == RESAMPLE) bench_laps("memcpy", copy, &s);
    if (p->what == VALUE) bench_laps("loop, -O3 -march=native", four, &s);
    if (p->what == SLOPE) bench_laps("wf_eval of the value", our_value, &s);
    if (p->what == INTERPOLATE) bench_laps("loop, -O3 -march=native", all_columns, &s);
}

/* ---- waveform.h -------------------------------------------------------------------------------------------------------- */

static void our_fit(void *user)
{
    setup *s = (setup *)user;
    wf_fit(s->w, s->c);
}

static void our_slope(void *user)
{
    setup *s = (setup *)user;
    wf_eval(s->w, 0.47, 1, s->c, s->out);
}

static void our_interpolation(void *user)
{
    setup *s = (setup *)user;
    wf_read(s->w, 0.47, 0, s->out);
}

static void our_resample(void *user)
{
    setup *s = (setup *)user;
    wf_resample(s->w, s->other);
}

static void our_pushes(void *user)
{
    setup *s = (setup *)user;
    int j;
    wf_rollback(s->w);
    for (j = 1; j < s->times; j++) wf_push(s->w, s->t[j], s->what);
    wf_degree(s->w);
}

static void our_rebuild(void *user)
{
#if WF_VERSION < 300
    our_pushes(user);
#else
    setup *s = (setup *)user;
    wf_restrict(s->w, s->degree, 1 << 30);
    wf_degree(s->w);
#endif
}

static void our_quality(void *user)
{
    setup *s = (setup *)user;
    double noise;
    wf_quality(s->w, &noise);
}

static void our_error(void *user)
{
    setup *s = (setup *)user;
    wf_error(s->w, s->other, s->out);
}

static void ours(const void *user)
{
    static void (*const call[])(void *) = {our_fit,    our_value,   our_slope,   our_interpolation, our_resample,
                                           our_pushes, our_rebuild, our_quality, our_error};
    const problem *p = (const problem *)user;
    char who[40];
    setup s;
    prepare(&s, p);
    snprintf(who, sizeof who, "waveform.h %d.%d.%d", WF_VERSION / 10000, WF_VERSION / 100 % 100, WF_VERSION % 100);
    bench_laps(who, call[p->what], &s);
}

/* ---- GSL ---------------------------------------------------------------------------------------------------------------- */

#ifdef HAVE_GSL
typedef struct gsl_setup {
    setup own;
    gsl_bspline_workspace *spline;
    gsl_matrix *lu;
    gsl_permutation *permutation;
    gsl_vector *basis;
} gsl_setup;

static void gsl_fit(void *user)
{
    gsl_setup *g = (gsl_setup *)user;
    setup *s = &g->own;
    ptrdiff_t i;
    memcpy(s->c, s->x, (size_t)s->n * (size_t)s->m * sizeof(double));
    for (i = 0; i < s->n; i++) {
        gsl_vector_view c = gsl_vector_view_array_with_stride(s->c + i, (size_t)s->n, (size_t)s->m);
        gsl_linalg_LU_svx(g->lu, g->permutation, &c.vector);
    }
}

static void gsl_value(void *user)
{
    gsl_setup *g = (gsl_setup *)user;
    setup *s = &g->own;
    size_t first, last, j;
    gsl_vector_view out = gsl_vector_view_array(s->out, (size_t)s->n);
    gsl_bspline_eval_nonzero(0.47, g->basis, &first, &last, g->spline);
    gsl_vector_set_zero(&out.vector);
    for (j = first; j <= last; j++) {
        gsl_vector_view c = gsl_vector_view_array(s->c + (ptrdiff_t)j * s->n, (size_t)s->n);
        gsl_vector_axpby(gsl_vector_get(g->basis, j - first), &c.vector, 1, &out.vector);
    }
}

static void gsl(const void *user)
{
    const problem *p = (const problem *)user;
    const size_t m = (size_t)p->m;
    gsl_setup g;
    gsl_vector *knots = gsl_vector_alloc(m - 2), *row = gsl_vector_alloc(m);
    int sign;
    size_t j;
    if (p->what != FIT && p->what != VALUE) exit(0);
    prepare(&g.own, p);
    g.spline = gsl_bspline_alloc(4, m - 2);
    g.basis = gsl_vector_alloc(4);
    g.lu = gsl_matrix_alloc(m, m);
    g.permutation = gsl_permutation_alloc(m);
    for (j = 0; j < m - 2; j++) gsl_vector_set(knots, j, (double)j / (double)(m - 3));
    gsl_bspline_knots(knots, g.spline);
    for (j = 0; j < m; j++) {
        gsl_bspline_eval(wf_time(g.own.w, (int)j), row, g.spline);
        gsl_matrix_set_row(g.lu, j, row);
    }
    gsl_linalg_LU_decomp(g.lu, g.permutation, &sign);
    bench_laps("GSL " GSL_VERSION ", as its package was compiled", p->what == FIT ? gsl_fit : gsl_value, &g);
}
#endif

/* ---- the race ------------------------------------------------------------------------------------------------------------ */

enum { HAND, OURS, OLD, GSL, SCIPY, COUNT };
static char scipy[400];
static contender all[COUNT] = {{"floor", hand, NULL, ""},
                                     {"waveform.h", ours, NULL, ""},
                                     {"the other waveform.h", NULL, "exit 1", ""},
#ifdef HAVE_GSL
                                     {"GSL", gsl, NULL, "libgsl-dev"},
#else
                                     {"GSL", NULL, "exit 1", "libgsl-dev"},
#endif
                                     {"SciPy", NULL, scipy, "python3-scipy"}};

#define SAME 1.05 /* so much the medians of two runs may differ */
static const struct {
    int what;
    ptrdiff_t n;
    int m;
    double limit; /* over the floor; of rows without one: milliseconds; 0: no goal */
    double old;   /* over the other version, SAME: not slower; 0: no goal */
} table[] = {{FIT, 1, 6, 0, SAME},
             {FIT, 1, 21, 0, SAME},
             {FIT, 100, 6, 0, 0},
             {FIT, 100, 21, 0, 0},
             {FIT, 10000, 6, 2, SAME},
             {FIT, 10000, 21, 2, SAME},
             {FIT, 10000, 101, 0, SAME},
             {FIT, 100000, 6, 0, SAME},
             {FIT, 1000000, 6, 2, SAME},
             {FIT, 1000000, 21, 2, SAME},
             {VALUE, 1, 6, 0, 1},
             {VALUE, 100, 6, 0, 0},
             {VALUE, 10000, 6, 1.1, SAME},
             {VALUE, 100000, 6, 0, SAME},
             {VALUE, 1000000, 6, 1.1, SAME},
             {SLOPE, 1, 6, 0, 0},
             {SLOPE, 100, 6, 0, 0},
             {SLOPE, 10000, 6, 1.1, 0},
             {SLOPE, 1000000, 6, 1.1, 0},
             {INTERPOLATE, 1, 6, 0, 0},
             {INTERPOLATE, 10000, 6, 0, 0},
             {INTERPOLATE, 10000, 21, 0, 0},
             {RESAMPLE, 10000, 6, 0, 0},
             {PUSH, 1, 6, 0, 1},
             {PUSH, 1, 21, 0, 1},
             {PUSH, 1, 101, 0, 1},
             {PUSH, 1, 1001, 0, 1},
             {PUSH, 1, 4001, 0, 1},
             {REBUILD, 1, 6, 0, 1},
             {REBUILD, 1, 21, 0, 1},
             {REBUILD, 1, 101, 0, 1},
             {REBUILD, 1, 1001, 0, 1},
             {QUALITY, 1, 101, 0, 0},
             {QUALITY, 1, 1001, 1, 0},
             {QUALITY, 1, 4001, 0, 0},
             {ERROR, 1, 101, 0, 0},
             {ERROR, 1, 1001, 1, 0},
             {ERROR, 1, 4001, 0, 0}};
enum { CASES = sizeof table / sizeof *table };

static double mine[CASES], floors[CASES];

static int row_of(int what, ptrdiff_t n, int m)
{
    int i = 0;
    while (table[i].what != what || table[i].n != n || table[i].m != m) i++;
    return i;
}

static void growth(const char *name, int count, const int *row, const double *x, double theory)
{
    double t[8], f[8], own, least = theory;
    char key[100];
    int i;
    for (i = 0; i < count; i++) {
        t[i] = mine[row[i]];
        f[i] = floors[row[i]];
    }
    own = bench_exponent(count, x, t);
    printf("  %-30s %6.2f", name, own);
    if (f[0] > 0) {
        const double hand_written = bench_exponent(count, x, f);
        printf("   floor %6.2f", hand_written);
        if (hand_written > least) least = hand_written;
    }
    printf("   theory at most %g\n", theory);
    snprintf(key, sizeof key, "growth of waveform %s", name);
    bench_goal(key, own, least + 0.15);
}

static void all_growth(void)
{
    const double columns[] = {101, 1001, 4001}, samples[] = {6, 21, 101}, n[] = {1e4, 1e6};
    const int fit[] = {row_of(FIT, 10000, 6), row_of(FIT, 10000, 21), row_of(FIT, 10000, 101)};
    const int wide[] = {row_of(FIT, 10000, 6), row_of(FIT, 1000000, 6)};
    const int value[] = {row_of(VALUE, 10000, 6), row_of(VALUE, 1000000, 6)};
    int what;
    printf("growth, exponents:\n");
    growth("fit in samples, n = 1e4", 3, fit, samples, 1);
    growth("fit in n, 6 samples", 2, wide, n, 1);
    growth("value in n, 6 samples", 2, value, n, 1);
    for (what = PUSH; what <= ERROR; what++) {
        if (what == REBUILD) continue;
        const int row[] = {row_of(what, 1, 101), row_of(what, 1, 1001), row_of(what, 1, 4001)};
        char name[40];
        snprintf(name, sizeof name, "%s in samples", word[what]);
        growth(name, 3, row, columns, 1);
    }
}

static void note(const race *r, const problem *p)
{
    char key[100];
    int k;
    for (k = 0; k < COUNT; k++)
        if (r->here[k]) {
            snprintf(key, sizeof key, "waveform %s %ld %d %s", word[p->what], (long)p->n, p->m, all[k].name);
            bench_note("rows", key, 1e6 * bench_median(r, k), r->here[HAND] ? bench_ratio(r, k, HAND, 0.5) : 0);
        }
}

static void print_row(const race *r, const problem *p)
{
    int k;
    printf("%-12s %8ld %5d ", word[p->what], (long)p->n, p->m);
    if (r->here[HAND])
        printf("%10.4g | %10.4g %7.2f (%6.2f %6.2f)", 1e6 * bench_median(r, HAND), 1e6 * bench_median(r, OURS), bench_ratio(r, OURS, HAND, 0.5),
               bench_ratio(r, OURS, HAND, 0.25), bench_ratio(r, OURS, HAND, 0.75));
    else printf("%10s | %10.4g", "-", 1e6 * bench_median(r, OURS));
    if (r->here[OLD]) printf(" | %8.2f", bench_ratio(r, OURS, OLD, 0.5));
    for (k = GSL; k < COUNT; k++)
        if (r->here[k]) printf(" | %8.2f", bench_ratio(r, k, HAND, 0.5));
    printf("\n");
}

static void run_the_other_on(const problem *p)
{
    char row[100];
    snprintf(row, sizeof row, "%d %ld %d %d %d %d", p->what, (long)p->n, p->m, p->degree, p->slopes, p->kind);
    bench_versions(all + OURS, all + OLD, "waveform", row);
}

/* A window pushed, and the grid made of it, over the same by the other version, on grids of all kinds. */
static void beside_the_other(void)
{
    static const int columns[] = {6, 21, 101, 1001};
    static race r;
    problem p = {PUSH, 1, 0, 0, 0, 0};
    int i, what;
    printf("a window pushed and its grid made, over the other waveform.h: degrees 3, 5, 7, 9, values alone and with derivatives,\n");
    printf("steps even, by chance within a factor of 2, 5 and 10, and graded by 1000: geometric mean, largest, grids above 1\n");
    for (what = PUSH; what <= REBUILD; what++)
        for (i = 0; i < 4; i++) {
            double sum = 0, most = 0;
            int grids = 0, above = 0;
            char key[100];
            p.what = what;
            p.m = columns[i];
            for (p.degree = 3; p.degree <= 9; p.degree += 2)
                for (p.slopes = 0; p.slopes < 2; p.slopes++)
                    for (p.kind = EVEN; p.kind < KINDS; p.kind++) {
                        double ratio;
                        run_the_other_on(&p);
                        bench_race(&r, all + OURS, 2, &p, 2, 7);
                        if (!r.here[1]) continue;
                        ratio = bench_ratio(&r, 0, 1, 0.5);
                        sum += log(ratio);
                        grids++;
                        above += ratio > 1;
                        if (ratio > most) most = ratio;
                    }
            if (grids == 0) continue;
            printf("  %-8s %5d columns %6.2f %6.2f %3d of %d\n", word[what], p.m, exp(sum / grids), most, above, grids);
            snprintf(key, sizeof key, "waveform %s, %d columns, %d grids, / the other waveform.h", word[what], p.m, grids);
            bench_goal(key, exp(sum / grids), 1);
        }
}

/* 0.045 and 0.21 us were set where a typed-in step of dp5 with n = 10 took 0.062 us: a measure of the processor. */
static double processor(void)
{
    double y[10] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, z[10], k[70] = {-1}, least = 1, t;
    int i, j;
    for (i = 0; i < 200; i++) {
        t = bench_clock(0);
        for (j = 0; j < 1000; j++) floor_dp5(10, 1e-7, y, k, z);
        t = (bench_clock(0) - t) / 1000;
        if (t < least) least = t;
    }
    return least / 0.062e-6;
}

int main(int argc, char **argv) /* with the numbers of a problem: a contender */
{
    static race r, names;
    const double speed = processor();
    int i;
    if (argc == 7) {
        const problem p = {atoi(argv[1]), atol(argv[2]), atoi(argv[3]), atoi(argv[4]), atoi(argv[5]), atoi(argv[6])};
        ours(&p);
    }
    printf("\nwaveform.h: microseconds, ratios to the floor of the same rounds (quartiles)%s\n",
           getenv("BENCH_OLD") ? "; it over the other waveform.h" : "");
    printf("%-12s %8s %5s %10s | %-35s | %s%8s | %8s\n", "", "n", "m", "floor us", "waveform.h", getenv("BENCH_OLD") ? "   other | " : "",
           "GSL", "SciPy");
    for (i = 0; i < CASES; i++) {
        const problem now = {table[i].what, table[i].n, table[i].m, 0, 0, 0}, *p = &now;
        char key[160];
        const int with_scipy = (p->what == FIT || p->what == VALUE) && p->n * p->m <= 1000000;
        run_the_other_on(p);
        snprintf(scipy, sizeof scipy, "set spline %ld %d %s; %s", (long)p->n, p->m, p->what == FIT ? "fit" : "value", bench_scipy);
        bench_race(&r, all, with_scipy ? COUNT : SCIPY, p, 2, p->n * p->m > 1000000 ? 7 : 15);
        if (i == 0) names = r;
        print_row(&r, p);
        note(&r, p);
        mine[i] = bench_median(&r, OURS);
        floors[i] = r.here[HAND] ? bench_median(&r, HAND) : 0;
        snprintf(key, sizeof key, "waveform %s, n = %ld, %d samples, %s", word[p->what], (long)p->n, p->m,
                 r.here[HAND] ? r.who[HAND] : "ms");
        if (table[i].limit > 0) bench_goal(key, r.here[HAND] ? bench_ratio(&r, OURS, HAND, 0.5) : 1e3 * mine[i], table[i].limit);
        snprintf(key, sizeof key, "waveform %s, n = %ld, %d samples, / the other waveform.h", word[p->what], (long)p->n, p->m);
        if (table[i].old > 0 && r.here[OLD]) bench_goal(key, bench_ratio(&r, OURS, OLD, 0.5), table[i].old);
    }
    bench_goal("waveform fit, n = 1, 6 samples, us (0.045 scaled by the processor)", 1e6 * mine[0], 0.045 * speed);
    bench_goal("waveform fit, n = 1, 21 samples, us (0.21 scaled by the processor)", 1e6 * mine[1], 0.21 * speed);
    bench_goal("waveform value, n = 1, us (0.025 scaled by the processor)", 1e6 * mine[row_of(VALUE, 1, 6)], 0.025 * speed);
    bench_names("waveform", &names, all, COUNT);
    printf("  floor: memcpy (fit, resample; n = 1: a band substitution), plain loops (value, interpolate), the value (slope)\n");
    all_growth();
    if (getenv("BENCH_OLD")) beside_the_other();
    return 0;
}
