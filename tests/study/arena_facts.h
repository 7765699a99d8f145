/* SPDX-License-Identifier: MIT

   arena_facts.h - single numbers that the defaults of iqn.h are to reach, each with its goal; a list of those missed. */
#ifndef ARENA_FACTS_H_INCLUDED
#define ARENA_FACTS_H_INCLUDED
#include "arena_coupled.h"
#include "arena_maps.h"
#include "arena_other.h"
#include "arena_run.h"

enum { MISSED = 100 };
typedef struct facts_list {
    unsigned long long seed;
    int quick, missed, all;
    char line[MISSED][160];
} facts_list;

/* Smaller is better. */
static void fact(facts_list *l, const char *name, double now, double goal, const char *remark)
{
    char text[160];
    snprintf(text, sizeof text, "%-68s goal %8.4g  now %8.4g  %s", name, goal, now, remark);
    printf("%s %s\n", now <= goal ? "     " : "  not", text);
    fflush(stdout);
    l->all++;
    if (now <= goal || l->missed == MISSED) return;
    memcpy(l->line[l->missed++], text, sizeof text);
}

static outcome run_built(void (*build)(problem *, int, unsigned long long), int variant, unsigned long long seed, int c)
{
    const family f = {"fact", "", build, variant, 1, 1};
    return run(&f, seed, 0, contenders + c);
}

/* Evaluations, and 1000 for every window that failed */
static double price(outcome o)
{
    return o.evaluations + 1000. * o.failed;
}

/* ---- heat ---- */

static heat_case fact_heat_case; /* for heat_fact_build */

static void heat_fact_build(problem *p, int variant, unsigned long long seed)
{
    (void)variant;
    heat_build_case(p, &fact_heat_case, seed);
}

static double heat_price(int windows, int steps, int weak, double noise, unsigned long long seed, int c)
{
    const heat_case plain = {"", 0.4, 1, 0.1, {steps, steps}, windows, noise, 0.5, SAME};
    const heat_case faint = {"", 0.4, 10, 0.001, {steps, steps}, windows, noise, 1. / 3, SAME};
    fact_heat_case = weak ? faint : plain;
    return price(run_built(heat_fact_build, 0, seed, c));
}

static void facts_heat(facts_list *l)
{
    static const double noises[] = {1e-14, 1e-13, 1e-12};
    const double one = heat_price(10, 1, 0, 0, l->seed, EIGHT_8), four = heat_price(10, 4, 0, 0, l->seed, EIGHT_8);
    const double many = heat_price(50, 1, 0, 0, l->seed, EIGHT_8);
    char name[100];
    size_t i;
    int weak;
    for (weak = 0; weak < 2; weak++)
        for (i = 0; i < sizeof noises / sizeof *noises; i++) {
            snprintf(name, sizeof name, "a: heat 1/1%s, round-off %.0e: as without", weak ? ", weak modes" : "", noises[i]);
            fact(l, name, heat_price(10, 1, weak, noises[i], l->seed, DEFAULT), one + 1, "");
        }
    kit_noise = 1e-10;
    fact(l, "a: heat 1/1, round-off 1e-10 that the host states", heat_price(10, 1, 0, 1e-10, l->seed, DEFAULT), 40,
         kit_noise_known ? "" : "no key yet");
    fact(l, "a: heat 4/4, round-off 1e-10 that the host states", heat_price(10, 4, 0, 1e-10, l->seed, DEFAULT), 85,
         kit_noise_known ? "" : "no key yet");
    kit_noise = 0;
    fact(l, "f: heat 4/4", heat_price(10, 4, 0, 0, l->seed, DEFAULT), 1.06 * four, "1.06 times 8 windows, limit 1e-8");
    fact(l, "f: heat 1/1, 50 windows", heat_price(50, 1, 0, 0, l->seed, DEFAULT), many, "8 windows, limit 1e-8");
}

static void facts_new_grids(facts_list *l)
{
    const heat_case how = {"", 0.4, 1, 0.1, {4, 4}, 10, 0, 0.5, EACH_CALL};
    double mine = 0, its = 0;
    int i, seeds = l->quick ? 3 : 8;
    fact_heat_case = how;
    for (i = 0; i < seeds; i++) {
        mine += run_built(heat_fact_build, 0, l->seed + (unsigned long long)i, DEFAULT).failed;
        its += run_built(heat_fact_build, 0, l->seed + (unsigned long long)i, AITKEN).failed;
    }
    fact(l, "g: a new time grid in every evaluation: windows that fail", mine, its, "those of Aitken");
}

/* ---- sequences ---- */

static void flip_build(problem *p, int variant, unsigned long long seed)
{
    map_build_sized(p, variant, seed, 14);
    p->windows = 24;
    ((core *)p->state)->flip = 8;
}

static void facts_flip(facts_list *l)
{
    double before = 0, first = 0, later = 0, last = 0;
    int i, w, maps = l->quick ? 6 : 20;
    char remark[60];
    for (i = 0; i < maps; i++) {
        const outcome o = run_built(flip_build, SEQ_FLIP, l->seed + (unsigned long long)i, DEFAULT);
        for (w = 4; w < 8; w++) before += o.each[w] / (4. * maps);
        for (w = 9; w < 12; w++) first += o.each[w] / (3. * maps);
        for (w = 12; w < 24; w++) later += o.each[w] / (12. * maps);
        last += 1000. * o.failed / maps;
    }
    snprintf(remark, sizeof remark, "before the change %.1f; the three after it %.1f", before, first);
    fact(l, "b: evaluations a window, from three windows after one change of H", later + last, before + 0.5, remark);
}

/* Evaluations of the default over another's, a window that failed counted as the limit */
static double against(facts_list *l, int variant, int c)
{
    double mine = 0, its = 0;
    int i, maps = l->quick ? 6 : 16;
    for (i = 0; i < maps; i++) {
        outcome a = run_built(map_build, variant, l->seed + (unsigned long long)i, DEFAULT);
        outcome b = run_built(map_build, variant, l->seed + (unsigned long long)i, c);
        mine += a.evaluations + 120. * a.failed, its += b.evaluations + 120. * b.failed;
    }
    return mine / its;
}

static void facts_sequences(facts_list *l)
{
    fact(l, "c: two maps in turn, over least squares in one window", against(l, SEQ_TURNS, ONE_6), 1.05, "");
    fact(l, "c: new H in every window", against(l, SEQ_NEW, ONE_6), 1.05, "");
    fact(l, "c: new unstable H", against(l, SEQ_UNSTABLE, ONE_6), 1.05, "");
    fact(l, "c: new added mass", against(l, SEQ_NEW_ADDED, ONE_6), 1.05, "");
    fact(l, "c: scale jumps", against(l, SEQ_SCALE, ONE_6), 1.05, "");
    fact(l, "d: drift of 1 %, over IMVJ", against(l, SEQ_DRIFT1, IMVJ_6), 1.005, "");
    fact(l, "d: drift of 10 %, over IMVJ", against(l, SEQ_DRIFT10, IMVJ_6), 1.005, "");
    fact(l, "d: drift of added mass, over IMVJ", against(l, SEQ_ADDED_DRIFT, IMVJ_6), 1.005, "");
}

/* ---- the tube ---- */

static regime fact_regime; /* for tube_fact_build */

static void tube_fact_build(problem *p, int variant, unsigned long long seed)
{
    (void)variant;
    tube_build_regime(p, &fact_regime, seed);
}

static outcome tube_run(const facts_list *l, int predict, int fluids, int solids, int windows, double dt, double noise,
                        int mean)
{
    const regime how = {"", predict, fluids, solids, windows, 120, fluids * solids > 1 ? 150 : 50, dt, 1, 1, 0, 1,
                        noise, noise > 0, mean};
    fact_regime = how;
    return run_built(tube_fact_build, 0, l->seed, DEFAULT);
}

static void fact_first_window(facts_list *l, int steps, int predict)
{
    const outcome o = tube_run(l, predict, steps, steps, 20, 0.01, 0, 0);
    char name[100];
    double later = 0;
    int w;
    for (w = 1; w < 20; w++) later += o.each[w] / 19.;
    snprintf(name, sizeof name, "7: tube, sub-steps %d,%d, guess of degree %d: windows that fail", steps, steps, predict);
    fact(l, name, o.failed, 0, "");
    snprintf(name, sizeof name, "7: the same %d,%d, degree %d: evaluations of the first window", steps, steps, predict);
    fact(l, name, o.failed == 20 ? HUGE_VAL : o.each[0], 40, "");
    snprintf(name, sizeof name, "7: the same %d,%d, degree %d: of later windows", steps, steps, predict);
    fact(l, name, o.failed ? HUGE_VAL : later, 12, "");
}

static void facts_tube(facts_list *l)
{
    static const double noises[] = {1e-8, 1e-6, 1e-4};
    char name[100];
    size_t i;
    int m;
    fact(l, "e: tube, constant guess", price(tube_run(l, 0, 1, 1, 100, 0.01, 0, 0)), 786, "");
    fact(l, "e: tube, quadratic guess", price(tube_run(l, 2, 1, 1, 100, 0.01, 0, 0)), 602, "");
    fact(l, "3: tube, windows .01/4: windows that fail", tube_run(l, 1, 1, 1, 20, 0.0025, 0, 0).failed, 0, "");
    fact(l, "3: tube, windows .01/8: windows that fail", tube_run(l, 1, 1, 1, 20, 0.00125, 0, 0).failed, 0, "");
    for (i = 0; i < sizeof noises / sizeof *noises; i++)
        for (m = 1; m <= 4; m *= 2) {
            snprintf(name, sizeof name, "3: tube, windows .01/%d, noise %.0e: windows that fail", m, noises[i]);
            fact(l, name, tube_run(l, 1, 1, 1, 12, 0.01 / m, noises[i], 0).failed, 0, "");
        }
    fact_first_window(l, 2, 1);
    fact_first_window(l, 2, 2);
    fact_first_window(l, 4, 1);
    fact_first_window(l, 4, 2);
    for (m = 2; m <= (l->quick ? 2 : 16); m *= 2) {
        snprintf(name, sizeof name, "7: fluid %d steps, solid one with the mean pressure: a window", m);
        fact(l, name, price(tube_run(l, 0, m, 1, l->quick ? 20 : 100, 0.01, 0, 1)) / (l->quick ? 20 : 100), 9, "");
    }
}

/* ---- single solves ---- */

static void facts_singles(facts_list *l)
{
    int kind, i, lost = 0, all = 0, gave_up = 0, maps = l->quick ? 6 : 30;
    double worst = 0;
    char remark[60];
    for (kind = CONTRACTION; kind <= SPREAD; kind++)
        for (i = 0; i < maps; i++, all++) {
            const outcome a = run_built(map_build, kind, l->seed + (unsigned long long)i, DEFAULT);
            const outcome b = run_built(map_build, kind, l->seed + (unsigned long long)i, ONE_6);
            if (b.failed) continue;
            lost += a.failed || a.evaluations > b.evaluations + 1;
            worst = fmax(worst, (double)a.evaluations / b.evaluations);
            gave_up += a.gave_up;
        }
    snprintf(remark, sizeof remark, "of %d; worst ratio %.2f", all, worst);
    fact(l, "3: affine singles, more than one evaluation behind limit 1e-6", lost, 0, remark);
    fact(l, "4: of them given up", gave_up, 0, "");
}

static void large_random_build(problem *p, int variant, unsigned long long seed)
{
    map_build_sized(p, variant, seed, 22);
}

/* I - A singular and b outside its range: there is no fixed point */
static void no_answer_build(problem *p, int variant, unsigned long long seed)
{
    core *s;
    double u[CORE], uu, ub, d;
    int i, j, m;
    map_build_sized(p, CONTRACTION, seed, 2 + (int)(seed % 18));
    s = (core *)p->state;
    m = s->m;
    for (i = 0; i < m; i++) u[i] = normal(&s->c);
    uu = product(m, u, u), ub = product(m, u, s->b);
    for (j = 0; j < m; j++) {
        for (d = 0, i = 0; i < m; i++) d += u[i] * s->A[0][i * m + j];
        for (i = 0; i < m; i++) s->A[0][i * m + j] += u[i] * (u[j] - d) / uu;
    }
    if (fabs(ub) < 0.1 * sqrt(uu)) add(m, 0.5 / sqrt(uu), u, s->b);
    p->reduction = 0, p->relative = pow(10, -variant), p->limit = 200, p->blind = 1;
}

/* H(x) = A (x - x_0) from x_0: the first answer is zero, the fixed point is not. */
static void rest_start(problem *p, int window, double *x)
{
    ptrdiff_t i;
    (void)window;
    for (i = 0; i < p->n; i++) x[i] = ((core *)p->state)->D[i];
}

static int rest_map(problem *p, const double *x, double *hx)
{
    core *s = (core *)p->state;
    double z[CORE];
    int i;
    for (i = 0; i < s->m; i++) z[i] = x[i] - s->D[i];
    for (i = 0; i < s->m; i++) hx[i] = product(s->m, s->A[0] + i * s->m, z);
    return 0;
}

static void rest_build(problem *p, int variant, unsigned long long seed)
{
    core *s;
    ptrdiff_t i;
    map_build_sized(p, variant, seed, 10);
    s = (core *)p->state;
    for (i = 0; i < s->m; i++) s->D[i] = normal(&s->c);
    p->n = s->m, p->start = rest_start, p->map = rest_map;
    p->reduction = 0, p->relative = 1e-6;
}

static void facts_ends(facts_list *l)
{
    int i, k, wrong, stalled = 0, rest = 0, maps = l->quick ? 60 : 300;
    char name[100], remark[60];
    for (k = 3; k <= 6; k += 3) {
        int high = 0;
        for (wrong = 0, i = 0; i < maps; i++) {
            const outcome o = run_built(no_answer_build, k, l->seed + (unsigned long long)i, DEFAULT);
            wrong += o.false_end;
            high += o.false_end && o.reduction > 0.5;
        }
        snprintf(name, sizeof name, "4: no fixed point, limit 1e-%d: \"converged\" with |r| > 0.5 |r_1|", k);
        snprintf(remark, sizeof remark, "of %d; \"converged\" at all: %d", maps, wrong);
        fact(l, name, high, 0, remark);
    }
    maps = l->quick ? 40 : 200;
    for (i = 0; i < maps; i++) {
        stalled += run_built(large_random_build, RANDOM3, l->seed + (unsigned long long)i, DEFAULT).gave_up;
        rest += run_built(rest_build, CONTRACTION, l->seed + (unsigned long long)i, DEFAULT).failed;
    }
    snprintf(remark, sizeof remark, "of %d", maps);
    fact(l, "4: random affine maps of rank 22 given up as stalled", stalled, 0, remark);
    fact(l, "4: starts from rest (first answer zero) that do not converge", rest, 0, remark);
}

static void facts_metric(facts_list *l)
{
    double with = 0, without = 0;
    int i;
    for (i = 0; i < 10; i++) {
        with += price(run_built(charge_build, 60, l->seed + (unsigned long long)i, METRIC));
        without += price(run_built(charge_build, 60, l->seed + (unsigned long long)i, DEFAULT));
    }
    fact(l, "6: charge in a long box, a metric for long waves over none", with / without, 0.95, "");
}

static void facts(unsigned long long seed, int quick)
{
    static facts_list l;
    int i;
    l.seed = seed + 500, l.quick = quick;
    printf("\nfacts\n");
    facts_heat(&l);
    facts_flip(&l);
    facts_sequences(&l);
    facts_tube(&l);
    facts_new_grids(&l);
    facts_metric(&l);
    facts_singles(&l);
    facts_ends(&l);
    printf("\ngoals not met: %d of %d\n", l.missed, l.all);
    for (i = 0; i < l.missed; i++) printf("  %s\n", l.line[i]);
}

#endif
