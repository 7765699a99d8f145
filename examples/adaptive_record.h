/* SPDX-License-Identifier: MIT

   adaptive_record.h - what adaptive.c keeps of a run to take it again: windows, step ends, degrees, gains, and what the
   sides wrote; and how far two runs are apart. */
#ifndef ADAPTIVE_RECORD_H_INCLUDED
#define ADAPTIVE_RECORD_H_INCLUDED

enum { AT_LENGTH, AT_TOLD_EVENT, AT_FOUND_EVENT }; /* where a window ends */

/* A window of the run. */
typedef struct kept_window {
    double t0, t1, accuracy;
    int ending;
    int steps[2], first[2], samples[2];       /* of the record's samples: the first one, how many */
    int degree[2], history[2];                /* of the waves as they were read in the last sweep */
    double gain[2], gain_length[2], *ends[2]; /* ends of the steps */
} kept_window;

typedef struct record {
    kept_window *window;
    int windows, room;
    int width[2], samples[2], sample_room[2];
    double *sample[2]; /* rows: time, WF_BREAK or 0, numbers, their slopes */
} record;

static void *more_memory(void *p, size_t bytes)
{
    void *now = realloc(p, bytes);
    if (!now) fprintf(stderr, "no memory for %lu bytes\n", (unsigned long)bytes), exit(1);
    return now;
}

/* Sample j of side i, a row. */
static double *record_sample(const record *r, int i, int j)
{
    return r->sample[i] + (ptrdiff_t)j * (2 + 2 * r->width[i]);
}

/* The samples of a window that side i wrote, after the first `count` ones; returns how many. */
static int record_wave(record *r, int i, int count, const wave *w)
{
    const int per = 1 + w->slopes, start = wf_start(w->w) + per, samples = (wf_columns(w->w) - start) / per;
    const size_t bytes = (size_t)w->width * sizeof(double);
    int j;
    r->width[i] = w->width;
    if (count + samples > r->sample_room[i]) {
        r->sample_room[i] = 2 * (count + samples);
        r->sample[i] = (double *)more_memory(r->sample[i], (size_t)r->sample_room[i] * (2 * bytes + 2 * sizeof(double)));
    }
    for (j = 0; j < samples; j++) {
        const int column = start + per * j;
        double *row = record_sample(r, i, count + j);
        row[0] = wf_time(w->w, column);
        row[1] = wf_what(w->w, column) & WF_BREAK;
        memcpy(row + 2, wf_column(w->w, column), bytes);
        if (w->slopes) memcpy(row + 2 + w->width, wf_column(w->w, column + 1), bytes);
    }
    return samples;
}

/* The window number `at`, solved in so many sweeps; what was kept of it and of later ones is forgotten. */
static void record_window(record *r, long at, double t0, double t1, int ending, int sweeps, const side *s)
{
    kept_window *v;
    int i;
    if (at >= r->room) {
        r->room = 2 * (int)at + 100;
        r->window = (kept_window *)more_memory(r->window, (size_t)r->room * sizeof(kept_window));
    }
    for (; r->windows > at; r->windows--)
        for (i = 0; i < 2; i++) free(r->window[r->windows - 1].ends[i]);
    v = &r->window[r->windows++];
    v->t0 = t0;
    v->t1 = t1;
    v->accuracy = accuracy;
    v->ending = ending;
    for (i = 0; i < 2; i++) {
        const size_t bytes = (size_t)s[i].steps * sizeof(double);
        const int guessed = i == 1 && sweeps == 1; /* what A read was no wave of this window: the wave that B wrote */
        v->first[i] = at > 0 ? v[-1].first[i] + v[-1].samples[i] : 0;
        v->samples[i] = record_wave(r, i, v->first[i], &s[i].out);
        r->samples[i] = v->first[i] + v->samples[i];
        v->degree[i] = guessed ? s[i].out.degree : s[1 - i].read_degree;
        v->history[i] = guessed ? s[i].out.history : s[1 - i].read_history;
        v->gain[i] = s[i].gain;
        v->gain_length[i] = s[i].gain_length;
        v->steps[i] = s[i].steps;
        v->ends[i] = (double *)scene_memory(bytes);
        memcpy(v->ends[i], s[i].ends, bytes);
    }
}

/* A time of window v where it is [t0, t1] now: the very same one where nothing has moved. */
static double moved_time(const kept_window *v, double time, double t0, double t1)
{
    if (t0 == v->t0 && t1 == v->t1) return time;
    return time == v->t1 ? t1 : t0 + (time - v->t0) * ((t1 - t0) / (v->t1 - v->t0));
}

/* The steps of window v, each of them in `pieces` that are sampled. */
static void tell_steps(side *s, const kept_window *v, int i, int pieces, double t0, double t1)
{
    double from = t0, end;
    int j, q, n = 0;
    scene_check(v->steps[i] <= STEPS_MOST ? 0 : -1, "too many steps to be halved");
    for (j = 0; j < v->steps[i]; j++, from = end) {
        end = moved_time(v, v->ends[i][j], t0, t1);
        for (q = 1; q < pieces; q++) s->ends[n++] = from + (end - from) * q / pieces;
        s->ends[n++] = end;
    }
    s->steps = n;
}

/* The gains that the run had measured: of a first guess as good as that of a replay none can be.  Where nothing moved
   none was measured, and none matters. */
static void tell_gain(side *s, const kept_window *v, int i, double L)
{
    const int measured = v->gain_length[i] > 0;
    s->gain = s->gain_most = measured ? v->gain[i] : 1;
    s->gain_length = measured ? fmax(v->gain_length[i], L / 2) : L;
    s->stale = 0;
}

/* The first guess is what B wrote in window v of the run. */
static void tell_guess(wave *w, const record *r, const kept_window *v, double t0, double t1)
{
    const double stretch = t1 - t0 == v->t1 - v->t0 ? 1 : (t1 - t0) / (v->t1 - v->t0);
    int i, j;
    wf_rollback(w->w);
    for (j = 0; j < v->samples[1]; j++) {
        const double *row = record_sample(r, 1, v->first[1] + j);
        double slope_now[WIDEST];
        for (i = 0; i < w->width; i++) slope_now[i] = row[2 + w->width + i] / stretch;
        wave_push(w->w, w->width, moved_time(v, row[0], t0, t1), row[1] > 0 ? WF_BREAK : 0, row + 2,
                  w->slopes ? slope_now : NULL);
    }
    wave_fit(w, v->degree[1], v->history[1]);
}

/* What another run writes at the times of the samples of a record, `done` of them so far. */
typedef struct answer {
    double *value[2];
    int done[2];
} answer;

static answer answer_make(const record *r)
{
    answer a;
    int i;
    for (i = 0; i < 2; i++) {
        a.value[i] = (double *)scene_memory((size_t)(r->samples[i] * r->width[i]) * sizeof(double));
        a.done[i] = 0;
    }
    return a;
}

static void answer_free(answer *a)
{
    free(a->value[0]);
    free(a->value[1]);
}

/* The answer of a record itself. */
static answer answer_of(const record *r)
{
    answer a = answer_make(r);
    int i, j;
    for (i = 0; i < 2; i++)
        for (j = 0; j < r->samples[i]; j++)
            memcpy(a.value[i] + j * r->width[i], record_sample(r, i, j) + 2, (size_t)r->width[i] * sizeof(double));
    return a;
}

/* Up to t1, from the wave of the window that ends there, the last one of all or not. */
static void answer_add(answer *a, const record *r, int i, const wave *w, double t1, int last)
{
    for (; a->done[i] < r->samples[i]; a->done[i]++) {
        const double *row = record_sample(r, i, a->done[i]);
        if (row[0] > t1 && !last) return;
        wf_eval(w->use, fmin(row[0], t1), row[1] > 0 ? WF_BEHIND : 0, w->coefficient, a->value[i] + a->done[i] * r->width[i]);
    }
}

/* The largest difference of two answers over the largest number that the side wrote. */
static double answers_apart(const record *r, const answer *a, const answer *b)
{
    double worst = 0;
    int i, j;
    for (i = 0; i < 2; i++) {
        double apart = 0, largest = 0;
        for (j = 0; j < r->samples[i] * r->width[i]; j++) {
            apart = fmax(apart, fabs(a->value[i][j] - b->value[i][j]));
            largest = fmax(largest, fabs(a->value[i][j]));
        }
        if (largest > 0) worst = fmax(worst, apart / largest);
    }
    return worst;
}

#endif
