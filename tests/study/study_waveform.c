/* SPDX-License-Identifier: MIT

   study_waveform.c - what a degree, a sample, a fit and an evaluation of a waveform buy and cost.
   study_waveform DIRECTORY [FILE]   FILE: a column of numbers, measured at equal times (an electrocardiogram) */
#include "study.h"

#define WF_IMPLEMENTATION
#include "waveform.h"

static const double pi = 3.14159265358979323846;

enum { SMOOTH, KINKED, ROUGH, KINDS };
static const char *const kind_name[] = {"smooth", "kinked", "rough"};

static double data(int kind, double t) /* on [0, 1] */
{
    if (kind == KINKED) return fabs(t - 1 / pi);
    return cos(2 * pi * t + 1) * exp(-t); /* one swing in a window */
}

enum { FINE = 2000, MOST = 129 };

/* s samples of n numbers in [0, 1], at equal times or Chebyshev-Lobatto ones; the first number of each is that data. */
static wf *grid(ptrdiff_t n, int degree, int chebyshev, int s, int kind)
{
    const size_t bytes = wf_size(n, degree, s);
    wf *w;
    int j;
    scene_check(wf_make(&w, n, degree, s, scene_memory(bytes), bytes), "wf_make");
    for (j = 0; j < s; j++) {
        const double t = chebyshev ? 0.5 - 0.5 * cos(acos(-1.0) * j / (s - 1)) : (double)j / (s - 1);
        scene_check(wf_push(w, t, 0), "wf_push");
        *wf_column(w, j) = data(kind, t);
    }
    return w;
}

/* wf_error of one number; NaN: too few samples for it */
static double estimate_of(wf *w, int degree)
{
    static char block[200000];
    double out;
    wf *other;
    scene_check(wf_make(&other, 0, degree + 2, wf_columns(w), block, sizeof block), "wf_make");
    return wf_error(w, other, &out) == WF_OK ? out : (double)NAN;
}

/* ---- error against degree and samples, and wf_error's estimate of it ---- */

static double error_of(int degree, int chebyshev, int s, int kind, double *estimate)
{
    double c[MOST], v, worst = 0;
    wf *w = grid(1, degree, chebyshev, s, kind);
    int k;
    *estimate = estimate_of(w, degree);
    scene_check(wf_fit(w, c), "wf_fit");
    for (k = 0; k <= FINE; k++) {
        scene_check(wf_eval(w, (double)k / FINE, 0, c, &v), "wf_eval");
        worst = fmax(worst, fabs(v - data(kind, (double)k / FINE)));
    }
    free(w);
    return worst;
}

/* The rough data: window after window of s kept values, every other value of the file; the values between are the truth.
   Root mean square over the range. */
static double rough(const double *file, int length, int degree, int s, double *estimate)
{
    double c[MOST], *x, v, sum = 0, guesses = 0, low = HUGE_VAL, high = -HUGE_VAL;
    int start, j, count = 0, windows = 0;
    wf *w = grid(1, degree, 0, s, SMOOTH);
    x = wf_column(w, 0);
    for (start = 0; start + 2 * s <= length; start += 2 * (s - 1)) {
        for (j = 0; j < s; j++) {
            x[j] = file[start + 2 * j];
            low = fmin(low, x[j]), high = fmax(high, x[j]);
        }
        v = estimate_of(w, degree);
        if (v >= 0) guesses += v, windows++;
        wf_fit(w, c);
        for (j = 0; j < s - 1; j++, count++) {
            wf_eval(w, (j + 0.5) / (s - 1), 0, c, &v);
            sum += (v - file[start + 2 * j + 1]) * (v - file[start + 2 * j + 1]);
        }
    }
    free(w);
    *estimate = windows ? guesses / windows / (high - low) : (double)NAN;
    return sqrt(sum / count) / (high - low);
}

static void accuracy(const char *directory, const double *file, int length)
{
    static const int samples[] = {2, 3, 4, 5, 6, 7, 9, 11, 13, 17, 21, 33, 49, 65, 97, 129};
    FILE *csv = study_file(directory, "waveform-error.csv");
    double ratios[KINDS][200], best[KINDS][2] = {{HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}};
    int degree_of[KINDS][2] = {{0, 0}, {0, 0}, {0, 0}};
    size_t i;
    int kind, chebyshev, degree, count[KINDS] = {0, 0, 0};
    fprintf(csv, "data,times,degree,samples,error,estimate\n");
    for (kind = 0; kind < KINDS; kind++)
        for (chebyshev = 0; chebyshev < 2; chebyshev++)
            for (degree = 0; degree <= 9; degree++)
                for (i = 0; i < sizeof samples / sizeof *samples; i++) {
                    double error = 0, estimate = 0;
                    if (degree >= samples[i]) continue;
                    if (kind == ROUGH) {
                        if (length == 0 || chebyshev) continue;
                        error = rough(file, length, degree, samples[i], &estimate);
                    } else {
                        error = error_of(degree, chebyshev, samples[i], kind, &estimate);
                        if (!chebyshev && degree > 0 && error > 1e-12 && estimate >= 0) ratios[kind][count[kind]++] = estimate / error;
                    }
                    if (samples[i] == 13 && error < best[kind][chebyshev]) {
                        best[kind][chebyshev] = error;
                        degree_of[kind][chebyshev] = degree;
                    }
                    fprintf(csv, "%s,%s,%d,%d,%.6g,%.6g\n", kind_name[kind], chebyshev ? "chebyshev" : "uniform", degree,
                            samples[i], error, estimate);
                }
    fclose(csv);
    printf("error with 13 samples, the best degree of 0 to 9:");
    for (kind = 0; kind < KINDS; kind++)
        for (chebyshev = 0; chebyshev < 2; chebyshev++)
            if (best[kind][chebyshev] < HUGE_VAL)
                printf("%s %s, %s times %.1e (degree %d)", kind + chebyshev ? ";" : "", kind_name[kind],
                       chebyshev ? "Chebyshev-Lobatto" : "equal", best[kind][chebyshev], degree_of[kind][chebyshev]);
    printf("\nwf_error over the true error, equal times: ");
    for (kind = 0; kind < ROUGH; kind++) {
        qsort(ratios[kind], (size_t)count[kind], sizeof(double), study_compare);
        printf("%s least %.2g, median %.2g, most %.2g; ", kind_name[kind], ratios[kind][0], ratios[kind][count[kind] / 2], ratios[kind][count[kind] - 1]);
    }
    printf("\n");
}

/* ---- noise: the largest sum of |weights| when each time step is `grade` times the last ---- */

static void noise(const char *directory)
{
    static const double grades[] = {1, 1.5, 2, 3, 4, 6, 10, 30, 100};
    FILE *csv = study_file(directory, "waveform-noise.csv");
    size_t i;
    int degree, j;
    fprintf(csv, "grade,degree,amplification\n");
    for (degree = 1; degree <= 7; degree++)
        for (i = 0; i < sizeof grades / sizeof *grades; i++) {
            double t = 0, step = 1, noise;
            size_t bytes = wf_size(0, degree, 8);
            wf *w;
            scene_check(wf_make(&w, 0, degree, 8, scene_memory(bytes), bytes), "wf_make");
            for (j = 0; j < 8; j++, t += step, step *= grades[i]) wf_push(w, t, 0);
            wf_quality(w, &noise);
            fprintf(csv, "%g,%d,%.6g\n", grades[i], degree, noise);
            free(w);
        }
    fclose(csv);
}

/* ---- cost, over a copy of the samples in the same run ---- */

typedef struct cost {
    wf *w;
    ptrdiff_t n;
    int s, k;
    double *x, *c, *out;
} cost;

enum { COPY, COPY_ONE, FIT, EVAL, READ, CONTENDERS };

static void work(int contender, void *ctx)
{
    cost *q = (cost *)ctx;
    const double t = fmod(0.07 + 0.61803398875 * (q->k += 1), 1);
    switch (contender) {
    case COPY: memcpy(q->c, q->x, (size_t)(q->n * q->s) * sizeof(double)); break;
    case COPY_ONE: memcpy(q->out, q->x + q->n * (q->k % q->s), (size_t)q->n * sizeof(double)); break;
    case FIT: wf_fit(q->w, q->c); break;
    case EVAL: wf_eval(q->w, t, 0, q->c, q->out); break;
    case READ: wf_read(q->w, t, 0, q->out); break;
    }
}

static void costs(const char *directory)
{
    static const ptrdiff_t lengths[] = {1, 100, 10000, 300000};
    static const int samples[] = {2, 6, 21}, degrees[] = {0, 1, 2, 3, 5, 7, 9};
    FILE *csv = study_file(directory, "waveform-cost.csv");
    size_t i, j, d;
    int k;
    fprintf(csv, "n,samples,degree,copy_s,fit,evaluate,read,break_even\n");
    printf("%8s %7s %6s | over a copy of the samples: fit | over a copy of one sample: evaluate, from samples | fit pays after\n",
           "n", "samples", "degree");
    for (i = 0; i < sizeof lengths / sizeof *lengths; i++)
        for (j = 0; j < sizeof samples / sizeof *samples; j++)
            for (d = 0; d < sizeof degrees / sizeof *degrees; d++) {
                cost q = {NULL, lengths[i], samples[j], 0, NULL, NULL, NULL};
                double s[CONTENDERS], pays;
                if (degrees[d] >= q.s) continue;
                q.w = grid(q.n, degrees[d], 0, q.s, 0);
                q.x = wf_column(q.w, 0), q.c = study_vector(q.n * q.s), q.out = study_vector(q.n);
                for (k = 0; k < q.n * q.s; k++) q.x[k] = sin(k);
                study_race(CONTENDERS, work, &q, s);
                pays = s[FIT] / (s[READ] - s[EVAL]);
                if (!(pays > 0)) pays = HUGE_VAL;
                fprintf(csv, "%td,%d,%d,%.4g,%.4g,%.4g,%.4g,%.4g\n", q.n, q.s, degrees[d], s[COPY], s[FIT] / s[COPY],
                        s[EVAL] / s[COPY_ONE], s[READ] / s[COPY_ONE], pays);
                if ((degrees[d] == 1 || degrees[d] == 3 || degrees[d] == 9) && q.n > 1)
                    printf("%8td %7d %6d | %8.2f | %8.2f %8.2f | %6.1f\n", q.n, q.s, degrees[d], s[FIT] / s[COPY],
                           s[EVAL] / s[COPY_ONE], s[READ] / s[COPY_ONE], pays);
                free(q.w), free(q.c), free(q.out);
            }
    fclose(csv);
}

int main(int argc, char **argv)
{
    double *file = study_vector(1000000);
    int length = 0;
    FILE *f = argc > 2 ? fopen(argv[2], "r") : NULL;
    if (argc < 2) {
        fprintf(stderr, "usage: study_waveform DIRECTORY [FILE]\n");
        return 2;
    }
    while (f && length < 1000000 && fscanf(f, "%lf", &file[length]) == 1) length++;
    if (f) fclose(f);
    study_progress("waveform: errors");
    accuracy(argv[1], file, length);
    noise(argv[1]);
    study_progress("waveform: costs\r\033[K");
    costs(argv[1]);
    free(file);
    return 0;
}
