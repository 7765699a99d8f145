/* SPDX-License-Identifier: MIT

   study.h - what the programs of make study share: the clock, medians, output files, random numbers.
   Include it first: it asks the C library for the processor time, which other programs on the machine disturb least. */
#ifndef STUDY_H_INCLUDED
#define STUDY_H_INCLUDED
#define _POSIX_C_SOURCE 199309L

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "examples/scene.h"

static inline double study_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int study_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline double study_median(double *a, int n)
{
    qsort(a, (size_t)n, sizeof *a, study_compare);
    return n % 2 ? a[n / 2] : 0.5 * (a[n / 2 - 1] + a[n / 2]);
}

/* Seconds of one call of work(contender, ctx).  The contenders run in turn and the medians are of their ratios to the first
   one in the same round: a slow moment of the machine hits all of them. */
enum { STUDY_CONTENDERS = 16, STUDY_ROUNDS = 15 };
static inline void study_race(int contenders, void (*work)(int contender, void *ctx), void *ctx, double *seconds)
{
    double t[STUDY_CONTENDERS][STUDY_ROUNDS], start;
    int repeat[STUDY_CONTENDERS], round, c, k;
    for (c = 0; c < contenders; c++) { /* as many calls as last 2 ms */
        start = study_now();
        for (k = 0; k < 1000000 && study_now() - start < 2e-3; k++) work(c, ctx);
        repeat[c] = k;
    }
    for (round = 0; round < STUDY_ROUNDS; round++)
        for (c = 0; c < contenders; c++) {
            start = study_now();
            for (k = 0; k < repeat[c]; k++) work(c, ctx);
            t[c][round] = (study_now() - start) / repeat[c];
        }
    for (c = 1; c < contenders; c++)
        for (round = 0; round < STUDY_ROUNDS; round++) t[c][round] /= t[0][round];
    seconds[0] = study_median(t[0], STUDY_ROUNDS);
    for (c = 1; c < contenders; c++) seconds[c] = seconds[0] * study_median(t[c], STUDY_ROUNDS);
}

static inline FILE *study_file(const char *directory, const char *name)
{
    char path[600];
    FILE *f;
    f = snprintf(path, sizeof path, "%s/%s", directory, name) < (int)sizeof path ? fopen(path, "w") : NULL;
    if (!f) {
        fprintf(stderr, "cannot write %s\n", path);
        exit(1);
    }
    return f;
}

static inline double *study_vector(ptrdiff_t n)
{
    return (double *)scene_memory((size_t)n * sizeof(double));
}

/* xorshift64*, uniform in (-1, 1): the same numbers everywhere */
static inline double study_random(unsigned long long *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 2685821657736338717ULL) >> 11) / 4503599627370496.0 - 1;
}

static inline void study_progress(const char *what)
{
    fprintf(stderr, "\r\033[K  %s", what);
    fflush(stderr);
}

#endif
