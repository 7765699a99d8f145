/* SPDX-License-Identifier: MIT

   scene.h - what the scenes share: options of the form --key value, checked memory, and, where waveform.h was included
   before, a waveform: a time grid with its samples and coefficients. */
#ifndef SCENE_H_INCLUDED
#define SCENE_H_INCLUDED

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One row per option; a row with key NULL ends the table.  text starts with the default, as the user would type it. */
typedef struct scene_option {
    const char *key, *text, *help;
} scene_option;

static inline void scene_usage(FILE *to, const char *program, const char *purpose, const scene_option *o)
{
    fprintf(to, "%s - %s\n", program, purpose);
    for (; o->key; o++) fprintf(to, "  --%-14s %-14s %s\n", o->key, o->text, o->help);
}

/* Fill the text of every option named in argv.  -h prints the table and ends with 0; anything unknown ends with 2. */
static inline void scene_parse(int argc, char **argv, const char *purpose, scene_option *o)
{
    int i, j;
    for (i = 1; i < argc; i += 2) {
        if (strcmp(argv[i], "-h") == 0 || strcmp(argv[i], "--help") == 0) {
            scene_usage(stdout, argv[0], purpose, o);
            exit(0);
        }
        for (j = 0; o[j].key; j++)
            if (strncmp(argv[i], "--", 2) == 0 && strcmp(argv[i] + 2, o[j].key) == 0) break;
        if (!o[j].key) {
            fprintf(stderr, "%s: unknown option %s; -h lists the options\n", argv[0], argv[i]);
            exit(2);
        }
        if (i + 1 == argc) {
            fprintf(stderr, "%s: option %s needs a value\n", argv[0], argv[i]);
            exit(2);
        }
        o[j].text = argv[i + 1];
    }
}

static inline const char *scene_text(const scene_option *o, const char *key)
{
    while (o->key && strcmp(o->key, key) != 0) o++;
    return o->key ? o->text : "";
}

/* A number in [low, high], or the program ends with 2 and says what was wrong. */
static inline double scene_number(const scene_option *o, const char *key, double low, double high)
{
    const char *text = scene_text(o, key);
    char *end;
    double v = strtod(text, &end);
    if (end == text || *end || !(v >= low && v <= high)) {
        fprintf(stderr, "--%s takes a number from %g to %g, not '%s'\n", key, low, high, text);
        exit(2);
    }
    return v;
}

/* An input of the model that the environment may move by up to 1e-13 of itself: SCENE_PERTURB=1, 2, ... selects how.
   The tests ask for the same verdicts then, for what is said about a scene must not hang on last bits. */
static inline double scene_perturbed(const char *name, double value)
{
    const char *seed = getenv("SCENE_PERTURB");
    unsigned long hash = seed ? strtoul(seed, NULL, 10) : 0;
    if (hash == 0) return value;
    for (; *name; name++) hash = (hash * 33 + (unsigned char)*name) % 1000003;
    return value * (1 + 1e-13 * ((double)(hash * 7919 % 2001) / 1000 - 1));
}

static inline int scene_integer(const scene_option *o, const char *key, int low, int high)
{
    double v = scene_number(o, key, low, high);
    if (v != floor(v)) {
        fprintf(stderr, "--%s takes a whole number, not '%s'\n", key, scene_text(o, key));
        exit(2);
    }
    return (int)v;
}

/* Two numbers A,B in [low, high], or the program ends with 2. */
static inline void scene_pair(const scene_option *o, const char *key, double low, double high, double pair[2])
{
    const char *text = scene_text(o, key);
    int length = 0;
    if (sscanf(text, "%lf,%lf%n", &pair[0], &pair[1], &length) != 2 || text[length] ||
        !(pair[0] >= low && pair[0] <= high && pair[1] >= low && pair[1] <= high)) {
        fprintf(stderr, "--%s takes two numbers A,B from %g to %g, not '%s'\n", key, low, high, text);
        exit(2);
    }
}

static inline void scene_integers(const scene_option *o, const char *key, int low, int high, int pair[2])
{
    double v[2];
    scene_pair(o, key, low, high, v);
    if (v[0] != floor(v[0]) || v[1] != floor(v[1])) {
        fprintf(stderr, "--%s takes two whole numbers, not '%s'\n", key, scene_text(o, key));
        exit(2);
    }
    pair[0] = (int)v[0], pair[1] = (int)v[1];
}

/* The position of the option's text in choices (ended by NULL), or the program ends with 2 and lists them. */
static inline int scene_choice(const scene_option *o, const char *key, const char *const *choices)
{
    int i;
    for (i = 0; choices[i]; i++)
        if (strcmp(scene_text(o, key), choices[i]) == 0) return i;
    fprintf(stderr, "--%s is one of", key);
    for (i = 0; choices[i]; i++) fprintf(stderr, " %s", choices[i]);
    fprintf(stderr, ", not '%s'\n", scene_text(o, key));
    exit(2);
    return -1; /* for a compiler that does not know that exit never returns */
}

static inline void *scene_memory(size_t bytes)
{
    void *p = calloc(1, bytes > 0 ? bytes : 1);
    if (!p) {
        fprintf(stderr, "no memory for %lu bytes\n", (unsigned long)bytes);
        exit(1);
    }
    return p;
}

/* End the program when a call of the kit failed; the kit itself never prints. */
static inline void scene_check(int status, const char *message)
{
    if (status < 0) {
        fprintf(stderr, "status %d: %s\n", status, message);
        exit(1);
    }
}

/* The file NAMEsuffix, opened for writing, where NAME is the option's text; NULL if that is empty. */
static inline FILE *scene_file(const scene_option *o, const char *key, const char *suffix)
{
    char name[512];
    FILE *f;
    if (!*scene_text(o, key)) return NULL;
    if (strlen(scene_text(o, key)) + strlen(suffix) >= sizeof name) {
        fprintf(stderr, "--%s is too long a name\n", key);
        exit(2);
    }
    strcpy(name, scene_text(o, key));
    strcat(name, suffix);
    f = fopen(name, "w");
    if (!f) {
        fprintf(stderr, "cannot write %s: %s\n", name, strerror(errno));
        exit(1);
    }
    return f;
}

#ifdef WF_VERSION

/* A time grid and its samples of n numbers, column j at x + j n; c: the coefficients that waveform_fit makes of them. */
typedef struct waveform {
    wf *grid;
    int n;
    double *x, *c;
} waveform;

static inline waveform waveform_make(int degree, int n, int columns)
{
    const size_t bytes = wf_size(degree, columns), numbers = (size_t)n * (size_t)columns;
    waveform w;
    int status = wf_make(&w.grid, degree, columns, scene_memory(bytes), bytes);
    scene_check(status, wf_message(status));
    w.n = n;
    w.x = (double *)scene_memory(numbers * sizeof(double));
    w.c = (double *)scene_memory(numbers * sizeof(double));
    return w;
}

static inline void waveform_free(waveform *w)
{
    free(w->grid), free(w->x), free(w->c);
}

static inline double *waveform_column(const waveform *w, int j)
{
    return w->x + (ptrdiff_t)j * w->n;
}

/* The window start, which a solver reads, and the columns behind it, which it writes. */
static inline double *waveform_begin(const waveform *w)
{
    return waveform_column(w, wf_start(w->grid));
}

static inline double *waveform_end(const waveform *w)
{
    return waveform_column(w, wf_columns(w->grid) - 1);
}

/* Numbers in all columns. */
static inline ptrdiff_t waveform_length(const waveform *w)
{
    return (ptrdiff_t)wf_columns(w->grid) * w->n;
}

/* Where the sample at t is to be written. */
static inline double *waveform_push(waveform *w, double t)
{
    int column = wf_push(w->grid, t);
    scene_check(column, wf_message(column));
    return waveform_column(w, column);
}

/* The same with its time derivative, which is to be written n numbers behind. */
static inline double *waveform_push_hermite(waveform *w, double t)
{
    int column = wf_push_hermite(w->grid, t);
    scene_check(column, wf_message(column));
    return waveform_column(w, column);
}

/* The same for the value behind a jump at the last time. */
static inline double *waveform_push_break(waveform *w, double t)
{
    int column = wf_push_break(w->grid, t);
    scene_check(column, wf_message(column));
    return waveform_column(w, column);
}

static inline void waveform_fit(waveform *w)
{
    int status = wf_fit(w->grid, w->n, w->x, w->n, w->c, w->n);
    scene_check(status, wf_message(status));
}

/* The value or derivative at t, from the coefficients: for many times after one fit. */
static inline void waveform_eval(const waveform *w, double t, int derivative, double *out)
{
    int status = wf_eval(w->grid, t, derivative, w->n, w->c, w->n, out);
    scene_check(status, wf_message(status));
}

/* The same from the samples: without a fit, for few times. */
static inline void waveform_interpolate(const waveform *w, double t, int derivative, double *out)
{
    int status = wf_interpolate(w->grid, t, derivative, w->n, w->x, w->n, out);
    scene_check(status, wf_message(status));
}

/* The mean over [a, b], from the samples. */
static inline void waveform_mean(const waveform *w, double a, double b, double *out)
{
    int status = wf_interpolate_mean(w->grid, a, b, w->n, w->x, w->n, out);
    scene_check(status, wf_message(status));
}

/* The next window; the last `history` samples of this one stay. */
static inline void waveform_advance(waveform *w, int history)
{
    int status = wf_advance(w->grid, history, w->n, w->x, w->n);
    scene_check(status, wf_message(status));
}
#endif
#endif
