/* SPDX-License-Identifier: MIT

   delayed.c - delayed pairs (iqn_delay): where both sides take the same equal sub-steps, what a window's H does to a change
   hardly hangs on the time of day, so a pair moved by whole samples is one, too.

   delayed [WORD]

   Evaluations of jobs of the arena whose x holds samples of a waveform, as they are, and with delayed pairs in the first
   window, in the first two, in every window; from the third evaluation of a window on.  The first rows have equal sub-steps
   on both sides; in the last ones, below the line, they differ, and a delayed pair is wrong. */
#include "arena.h"
#include "arena_coupled.h" /* iqn.h, by the tube */
#include "arena_run.h"

enum { EVERY = 1000, COUNT_OF_WAYS = 4 };

typedef struct job {
    const char *name;
    void (*build)(problem *p, int variant, unsigned long long seed);
    const char *variant; /* its name in the arena */
    int samples, equal;
} job;

static const job jobs[] = {
    {"heat 4/4", heat_build, "4/4", 4, 1},
    {"heat 4/4, round-off 1e-13", heat_build, "4/4, round-off 1e-13", 4, 1},
    {"heat 4/4, round-off 1e-10", heat_build, "4/4, round-off 1e-10", 4, 1},
    {"heat 4/4, weak modes", heat_build, "weak modes, 4/4", 4, 1},
    {"beam, 2 steps", bodies_build, "beam 100, 2 steps", 2, 1},
    {"beam, 4 steps", bodies_build, "beam 100, 4 steps", 4, 1},
    {"beam 300, short steps", bodies_build, "beam 300, short steps", 2, 1},
    {"pistons, 2 steps", bodies_build, "pistons 100, 2 steps", 2, 1},
    {"pistons, 8 steps", bodies_build, "pistons 100, 8 steps", 8, 1},
    {"pistons, 4 long steps", bodies_build, "pistons 30, long steps", 4, 1},
    {"tube 2,2", tube_build, "sub-steps 2,2", 2, 1},
    {"tube 4,4", tube_build, "sub-steps 4,4", 4, 1},
    {"heat 3/7", heat_build, "3/7", 7, 0},
    {"heat 7/4", heat_build, "7/4, 50 windows", 4, 0},
    {"heat 4/7, uneven", heat_build, "4/7, uneven, new", 7, 0},
    {"tube 1,2", tube_build, "sub-steps 1,2", 2, 0},
};
enum { JOBS = (int)(sizeof jobs / sizeof *jobs) };

static int samples_now; /* of the job at hand: make of a contender gets the problem alone */

typedef struct delayed {
    iqn *q;
    int most, window, steps; /* windows that delay; this window; steps in it */
} delayed;

static void *delayed_make(const contender *c, problem *p)
{
    delayed *d = (delayed *)memory(sizeof *d);
    const size_t bytes = iqn_size(p->n, p->columns, samples_now);
    if (iqn_make(&d->q, p->n, p->columns, samples_now, memory(bytes), bytes) < 0) {
        fprintf(stderr, "iqn_make\n");
        exit(1);
    }
    if (p->relative > 0) iqn_set(d->q, IQN_TOL_RELATIVE, p->relative);
    d->most = c->windows;
    return d;
}

static int delayed_step(void *state, double *x, const double *hx)
{
    delayed *d = (delayed *)state;
    if (d->window < d->most && d->steps > 1) iqn_delay(d->q);
    d->steps++;
    return iqn_step(d->q, x, hx) < 0 ? -1 : iqn_converged(d->q);
}

static void delayed_commit(void *state)
{
    delayed *d = (delayed *)state;
    iqn_commit(d->q);
    d->window++;
    d->steps = 0;
}

static void delayed_discard(void *state)
{
    delayed *d = (delayed *)state;
    iqn_discard(d->q);
    d->steps = 0;
}

static void delayed_release(void *state)
{
    free(((delayed *)state)->q);
    free(state);
}

#define DELAYED delayed_make, delayed_step, delayed_commit, delayed_discard, delayed_release
static const contender ways[COUNT_OF_WAYS] = {
    {"as it is", DELAYED, 0, 0, 0, LEAST_SQUARES},
    {"first window", DELAYED, 0, 0, 1, LEAST_SQUARES},
    {"two windows", DELAYED, 0, 0, 2, LEAST_SQUARES},
    {"every window", DELAYED, 0, 0, EVERY, LEAST_SQUARES},
};

static int variant_of(const job *j)
{
    int k;
    for (k = 0; j->build == heat_build && k < (int)(sizeof heat_cases / sizeof *heat_cases); k++)
        if (strcmp(heat_cases[k].name, j->variant) == 0) return k;
    for (k = 0; j->build == bodies_build && k < (int)(sizeof bodies_cases / sizeof *bodies_cases); k++)
        if (strcmp(bodies_cases[k].name, j->variant) == 0) return k;
    for (k = 0; j->build == tube_build && k < (int)(sizeof regimes / sizeof *regimes); k++)
        if (strcmp(regimes[k].name, j->variant) == 0) return k;
    fprintf(stderr, "no family %s\n", j->variant);
    exit(1);
}

int main(int argc, char **argv)
{
    const unsigned long long first = first_seed(argc > 1 ? argv[1] : "dev");
    double logs[2][COUNT_OF_WAYS] = {{0}};
    int answered[2][COUNT_OF_WAYS] = {{0}}, j, i, c;
    printf("evaluations, mean of 3 runs (runs that fail)\n%-28s", "");
    for (c = 0; c < COUNT_OF_WAYS; c++) printf("%16s", ways[c].name);
    printf("\n");
    for (j = 0; j < JOBS; j++) {
        double mean[COUNT_OF_WAYS] = {0};
        int failed[COUNT_OF_WAYS] = {0};
        family f = {"", "", NULL, 0, 3};
        f.build = jobs[j].build;
        f.variant = variant_of(jobs + j);
        samples_now = jobs[j].samples;
        for (i = 0; i < 3; i++)
            for (c = 0; c < COUNT_OF_WAYS; c++) {
                const outcome o = run(&f, first + (unsigned long long)i, 0, ways + c);
                mean[c] += o.evaluations / 3.;
                failed[c] += o.failed > 0;
            }
        if (j > 0 && jobs[j - 1].equal && !jobs[j].equal) printf("sub-steps that differ\n");
        printf("%-28s", jobs[j].name);
        for (c = 0; c < COUNT_OF_WAYS; c++) {
            char text[40];
            snprintf(text, sizeof text, failed[c] ? "%.0f (%d)" : "%.0f%.0d", mean[c], failed[c]);
            printf("%16s", text);
            if (failed[c] > 0 || failed[0] > 0) continue;
            logs[jobs[j].equal][c] += log(mean[c] / mean[0]);
            answered[jobs[j].equal][c]++;
        }
        printf("\n");
        fflush(stdout);
    }
    for (i = 1; i >= 0; i--)
        for (c = 1; c < COUNT_OF_WAYS; c++)
            printf("delayed pairs, %s sub-steps, %-12s evaluations %.3f of those without, %d jobs that both answer\n",
                   i ? "equal" : "other", ways[c].name, exp(logs[i][c] / (answered[i][c] ? answered[i][c] : 1)),
                   answered[i][c]);
    return 0;
}
