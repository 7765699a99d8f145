/* SPDX-License-Identifier: MIT

   adaptive_wave.h - what adaptive.c asks of waveform.h beyond single calls: a wave whose degree and history are those
   of least estimated error, and a first guess of the degree that would have foretold the last window best. */
#ifndef ADAPTIVE_WAVE_H_INCLUDED
#define ADAPTIVE_WAVE_H_INCLUDED

enum { WIDEST = 24, MOST_SAMPLES = 2000, OLDER = 12 };

/* What one side writes and the other reads: samples of `width` numbers, with slopes or without, the window and up to
   OLDER samples before it; and the spline through them. */
typedef struct wave {
    int width, slopes, count, start; /* samples in all; the window starts at sample `start` */
    double size;                     /* typical size of the numbers: errors are relative to it */
    double *t, *value, *slope;
    wf *grid, *part; /* the spline in use; a piece of it, for estimates and guesses */
    void *memory, *part_memory;
    size_t bytes;
    double *sample, *coefficient, *other;
    int degree, history;
    double error; /* estimated, over the size; 0 for a polynomial */
} wave;

static inline wave wave_make(int width, int slopes, double size)
{
    wave w;
    const size_t columns = 2 * MOST_SAMPLES;
    memset(&w, 0, sizeof w);
    w.width = width;
    w.slopes = slopes;
    w.size = size;
    w.t = (double *)scene_memory(MOST_SAMPLES * sizeof(double));
    w.value = (double *)scene_memory(columns * (size_t)width * sizeof(double));
    w.slope = w.value + (size_t)width * MOST_SAMPLES;
    w.bytes = wf_size(WF_MAX_DEGREE, (int)columns);
    w.memory = scene_memory(w.bytes);
    w.part_memory = scene_memory(w.bytes);
    w.sample = (double *)scene_memory(columns * (size_t)width * sizeof(double));
    w.coefficient = (double *)scene_memory(columns * (size_t)width * sizeof(double));
    w.other = (double *)scene_memory(columns * (size_t)width * sizeof(double));
    return w;
}

static inline void wave_write(wave *w, double t, const double *value, const double *slope)
{
    const size_t bytes = (size_t)w->width * sizeof(double);
    if (w->count == MOST_SAMPLES) scene_check(WF_EFULL, wf_message(WF_EFULL));
    w->t[w->count] = t;
    memcpy(w->value + w->width * w->count, value, bytes);
    if (slope) memcpy(w->slope + w->width * w->count, slope, bytes);
    w->count++;
}

static inline void wave_push(const wave *w, wf *grid, int j, int slope, double *x)
{
    const size_t bytes = (size_t)w->width * sizeof(double);
    const int column = slope ? wf_push_hermite(grid, w->t[j]) : wf_push(grid, w->t[j]);
    scene_check(column, wf_message(column));
    memcpy(x + w->width * column, w->value + w->width * j, bytes);
    if (slope) memcpy(x + w->width * (column + 1), w->slope + w->width * j, bytes);
}

/* Samples first .. last on a grid of that degree, the window starting at sample `start`. */
static inline void wave_grid(wave *w, wf **grid, void *memory, int degree, const int range[3])
{
    int j;
    scene_check(wf_make(grid, degree, 2 * (range[2] - range[0] + 1), memory, w->bytes), "wf_make");
    for (j = range[0]; j <= range[2]; j++) {
        wave_push(w, *grid, j, w->slopes, w->sample);
        if (j == range[1]) wf_advance(*grid, OLDER, 0, NULL, 0);
    }
}

static inline void wave_fit(wave *w, int degree, int history)
{
    const int range[3] = {w->start - history, w->start, w->count - 1};
    wave_grid(w, &w->grid, w->memory, degree, range);
    w->degree = degree;
    w->history = history;
    wf_fit(w->grid, w->width, w->sample, w->width, w->coefficient, w->width);
}

static inline void wave_read(const wave *w, double t, double *out)
{
    const int status = wf_eval(w->grid, t, 0, w->width, w->coefficient, w->width, out);
    scene_check(status, wf_message(status));
}

static inline double wave_norm(const wave *w, int count, const double *v)
{
    double most = 0;
    int i;
    for (i = 0; i < count; i++) most = fmax(most, fabs(v[i]));
    return most / w->size;
}

/* The estimated error of the spline in use over the window. */
static inline double wave_error(const wave *w)
{
    double out[WIDEST];
    const int status = wf_error(w->grid, w->width, w->sample, w->width, out);
    scene_check(status, wf_message(status));
    return wave_norm(w, w->width, out);
}

/* The largest estimate of a wave of that degree with the older samples it wants, in w->part; and how far the spline in
   use is from it, at three places of each step.  0: it cannot be judged. */
static inline int wave_compare(wave *w, int degree, int *history, double *error, double *apart)
{
    const int per = 1 + w->slopes, own = per * (w->count - w->start), wanted = (degree + 2 - own + per - 1) / per;
    const int range[3] = {w->start - (wanted > 0 ? wanted : 0), w->start, w->count - 1};
    double a[WIDEST], b[WIDEST], noise;
    int i, j;
    if (range[0] < 0) return 0;
    *history = w->start - range[0];
    wave_grid(w, &w->part, w->part_memory, degree, range);
    if (wf_quality(w->part, NULL, &noise) != WF_OK) return 0;
    if (wf_error(w->part, w->width, w->sample, w->width, a) < 0) return 0;
    *error = wave_norm(w, w->width, a);
    wf_fit(w->part, w->width, w->sample, w->width, w->other, w->width);
    for (*apart = 0, j = 4 * w->start + 1; j < 4 * (w->count - 1); j++) {
        const int k = j / 4;
        const double t = w->t[k] + (w->t[k + 1] - w->t[k]) * (j - 4 * k) / 4;
        wave_read(w, t, a);
        wf_eval(w->part, t, 0, w->width, w->other, w->width, b);
        for (i = 0; i < w->width; i++) a[i] -= b[i];
        *apart = fmax(*apart, wave_norm(w, w->width, a));
    }
    return 1;
}

/* An estimate may vanish by accident: where two splines are farther apart than both estimates allow, that of the lower
   degree, which rests on fewer differences, is wrong. */
static inline void wave_doubt(wave *w, int most)
{
    double error, apart;
    int history;
    const int degree = w->degree + 2 < most ? w->degree + 2 : most;
    if (w->degree >= most || !wave_compare(w, degree, &history, &error, &apart) || !(apart > error + w->error)) return;
    w->error = apart;
    if (!(error < apart)) return;
    w->error = error;
    wave_fit(w, degree, history);
}

/* The degree and the history of least estimated error; returns that error, HUGE_VAL if noise is amplified in all. */
static inline double wave_choose(wave *w, int most)
{
    const int older = w->start < OLDER ? w->start : OLDER, range[3] = {w->start - older, w->start, w->count - 1};
    wave_grid(w, &w->grid, w->memory, most, range);
    w->history = wf_choose(w->grid, w->width, w->sample, w->width, &w->error);
    scene_check(w->history, wf_message(w->history));
    w->degree = wf_degree(w->grid);
    w->error = isnan(w->error) ? HUGE_VAL : w->error / w->size;
    wf_fit(w->grid, w->width, w->sample, w->width, w->coefficient, w->width);
    wave_doubt(w, most);
    return w->error;
}

/* The polynomial of that degree through the newest samples up to `last`; 0: too few samples. */
static inline int wave_polynomial(wave *w, wf **grid, void *memory, int degree, int last)
{
    const int per = degree > 1 ? 1 + w->slopes : 1; /* wf_push_hermite wants degree 2 */
    const int samples = degree / per + 1, odd = samples * per - (degree + 1);
    int j;
    if (last + 1 < samples) return 0;
    scene_check(wf_make(grid, degree, degree + 1, memory, w->bytes), "wf_make");
    for (j = last + 1 - samples; j <= last; j++)
        wave_push(w, *grid, j, per == 2 && !(odd && j == last + 1 - samples), w->sample);
    return 1;
}

/* The degree whose polynomial up to the window start comes nearest to the samples of the window: hindsight, used for
   the next first guess. */
static inline int wave_hindsight(wave *w, int most)
{
    double v[WIDEST], worst, least = HUGE_VAL;
    int degree, best = 0, i, j;
    for (degree = 0; degree <= most; degree++) {
        if (degree > 0 && !wave_polynomial(w, &w->part, w->part_memory, degree, w->start)) continue;
        for (worst = 0, j = w->start + 1; j < w->count; j++) {
            if (degree == 0) memcpy(v, w->value + w->width * w->start, (size_t)w->width * sizeof(double));
            else wf_interpolate(w->part, w->t[j], 0, w->width, w->sample, w->width, v);
            for (i = 0; i < w->width; i++) worst = fmax(worst, fabs(v[i] - w->value[w->width * j + i]));
        }
        if (worst < least) least = worst, best = degree;
    }
    return best;
}

/* w continued beyond its newest sample by the polynomial of that degree, lower where there are too few. */
static inline void wave_guess(wave *w, int degree)
{
    w->error = 0;
    while (!wave_polynomial(w, &w->grid, w->memory, degree, w->count - 1)) degree--;
    w->degree = degree;
    wf_fit(w->grid, w->width, w->sample, w->width, w->coefficient, w->width);
}

/* The next window: the last sample becomes its start. */
static inline void wave_advance(wave *w, int keep)
{
    const int first = w->count - 1 > keep ? w->count - 1 - keep : 0, left = w->count - first;
    const size_t bytes = (size_t)left * (size_t)w->width * sizeof(double);
    memmove(w->t, w->t + first, (size_t)left * sizeof(double));
    memmove(w->value, w->value + w->width * first, bytes);
    memmove(w->slope, w->slope + w->width * first, bytes);
    w->count = left;
    w->start = left - 1;
}

static const double NOISE_MOST = 100; /* wf_choose amplifies noise no more than that */

/* Round-off of what is read at t: that of the largest sample, or of the weighted ones where a polynomial is continued. */
static inline double wave_round_off(const wave *w, double t)
{
    const int status = wf_weights(w->grid, t, 0, w->other), columns = wf_columns(w->grid);
    double sum, worst = wave_norm(w, w->count * w->width, w->value) * w->size;
    int i, j;
    scene_check(status, wf_message(status));
    for (j = 0; j < w->width; j++) {
        for (sum = 0, i = 0; i < columns; i++) sum += fabs(w->other[i] * w->sample[w->width * i + j]);
        worst = fmax(worst, sum);
    }
    return NOISE_MOST * DBL_EPSILON * worst;
}

/* |h sum b_i w(t + c_i h) - integral of w|: what the abscissae of a step do not see of its input, beyond what the wave
   itself does not know.  Round-off is nothing unseen, and does not fall with h: steps would shrink without end. */
static inline double wave_unseen(const wave *w, const rk_table *T, double t, double h, double *integral)
{
    double v[WIDEST], worst = 0, end = t + h;
    int i, j, status;
    if (w->error == 0 && w->degree < T->order) return 0; /* seen; its mean far beyond the samples is round-off */
    status = wf_eval_mean(w->grid, t, end, w->width, w->coefficient, w->width, integral);
    scene_check(status, wf_message(status));
    for (j = 0; j < w->width; j++) integral[j] *= end - t;
    for (i = 0; i < T->stages; i++) {
        if (T->b[i] == 0) continue;
        wave_read(w, t + T->c[i] * h, v);
        for (j = 0; j < w->width; j++) integral[j] -= h * T->b[i] * v[j];
    }
    for (j = 0; j < w->width; j++) worst = fmax(worst, fabs(integral[j]));
    if (worst <= h * w->error * w->size) return 0;
    return fmax(0, worst - h * (w->error * w->size + wave_round_off(w, end)));
}

/* The samples of the window as one vector x, slopes times `unit`, all over the size: from the samples themselves, or
   from the spline in use at their times (what was read last).  Returns the length of x. */
static inline int wave_vector(const wave *w, int from_spline, double unit, double *x)
{
    double *at = x;
    int i, j, d;
    for (j = w->start + 1; j < w->count; j++)
        for (d = 0; d <= w->slopes; d++, at += w->width) {
            if (from_spline) wf_eval(w->grid, w->t[j], d, w->width, w->coefficient, w->width, at);
            else memcpy(at, (d ? w->slope : w->value) + w->width * j, (size_t)w->width * sizeof(double));
            for (i = 0; i < w->width; i++) at[i] *= (d ? unit : 1) / w->size;
        }
    return (int)(at - x);
}

static inline void wave_set_vector(wave *w, double unit, const double *x)
{
    int i, j, d;
    for (j = w->start + 1; j < w->count; j++)
        for (d = 0; d <= w->slopes; d++, x += w->width)
            for (i = 0; i < w->width; i++)
                (d ? w->slope : w->value)[w->width * j + i] = x[i] * w->size / (d ? unit : 1);
}

/* The largest difference of two such vectors, values alone. */
static inline double wave_distance(const wave *w, int n, const double *x, const double *y)
{
    double most = 0;
    int i, per = w->width * (1 + w->slopes);
    for (i = 0; i < n; i++)
        if (i % per < w->width) most = fmax(most, fabs(x[i] - y[i]));
    return most;
}

#endif
