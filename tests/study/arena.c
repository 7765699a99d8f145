/* SPDX-License-Identifier: MIT

   arena.c - many fixed points, many accelerators, one table: how far the defaults of iqn.h are behind the best setting.

   arena DIRECTORY [full|quick] [judge|dev|number] [group ...]

   Every family of problems is given to every contender.  A contender is rated on a whole family: evaluations of H of
   the default over its own, summed over the problems that both solve.  It counts as a rival for evaluations where it
   fails in no more windows than the default does.  Development seeds start at 1, judging seeds at 1000000. */
#include "arena_coupled.h"
#include "arena_kit.h"
#include "arena_maps.h"
#include "arena_rivals.h"


#define KIT kit_make, kit_step, kit_commit, kit_discard, kit_release
#define RIVAL rival_make, rival_step, rival_commit, rival_discard, rival_release
static const contender contenders[] = {
    {"default", KIT, 0, 0, 0, KIT_DEFAULT},
    {"one window 1e-2", rival_make, alone_step, rival_commit, rival_discard, rival_release, 0.1, 1e-2, 0, QR2},
    {"one window 1e-4", rival_make, alone_step, rival_commit, rival_discard, rival_release, 0.1, 1e-4, 0, QR2},
    {"one window 1e-6", rival_make, alone_step, rival_commit, rival_discard, rival_release, 0.1, 1e-6, 0, QR2},
    {"one window 1e-8", rival_make, alone_step, rival_commit, rival_discard, rival_release, 0.1, 1e-8, 0, QR2},
    {"8 windows 1e-2", RIVAL, 0.1, 1e-2, 8, QR2},
    {"8 windows 1e-3", RIVAL, 0.01, 1e-3, 8, QR2},
    {"8 windows 1e-8", RIVAL, 0.1, 1e-8, 8, QR2},
    {"16 windows 1e-3", RIVAL, 0.1, 1e-3, 16, QR2},
    {"all pairs 1e-6", RIVAL, 0.1, 1e-6, 1000, QR2},
    {"8 windows, dgelsd 1e-7", RIVAL, 0.1, 1e-7, 8, SINGULAR},
    {"all pairs, dgelsd 1e-10", RIVAL, 0.1, 1e-10, 1000, SINGULAR},
    {"IMVJ 1e-2", RIVAL, 0.1, 1e-2, 1000, IMVJ},
    {"IMVJ 1e-6", RIVAL, 0.1, 1e-6, 1000, IMVJ},
    {"Aitken", rival_make, aitken_step, aitken_commit, rival_discard, rival_release, 0.1, 0, 0, QR2},
    {"safeguarded", rival_make, safeguarded_step, rival_commit, rival_discard, rival_release, 1, 1e-8, 0, QR2},
};
enum { CONTENDERS = (int)(sizeof contenders / sizeof *contenders), MOST = 200 };

static const family families[] = {
    {"single", "contraction", map_build, CONTRACTION, 60, 12},
    {"single", "random 0.9", map_build, RANDOM09, 60, 12},
    {"single", "random 3", map_build, RANDOM3, 60, 12},
    {"single", "Jordan", map_build, JORDAN, 60, 12},
    {"single", "skew", map_build, SKEW, 60, 12},
    {"single", "added mass 1e1", map_build, ADDED10, 60, 12},
    {"single", "added mass 1e2", map_build, ADDED100, 60, 12},
    {"single", "added mass 1e3", map_build, ADDED1000, 60, 12},
    {"single", "both signs 1e2", map_build, BOTH_SIGNS, 60, 12},
    {"single", "nearly singular", map_build, NEARLY_SINGULAR, 60, 12},
    {"single", "cyclic", map_build, CYCLIC, 60, 12},
    {"single", "1e-4 to 10", map_build, SPREAD, 60, 12},
    {"single", "quadratic", map_build, QUADRATIC, 60, 12},
    {"single", "tanh", map_build, TANH, 60, 12},
    {"single", "sine", map_build, SINE, 60, 12},
    {"single", "noise 1e-9", map_build, NOISY, 60, 12},
    {"windows", "H fixed, b moves", map_build, SEQ_MOVES, 24, 6},
    {"windows", "b random", map_build, SEQ_RANDOM, 24, 6},
    {"windows", "H drifts 1 %", map_build, SEQ_DRIFT1, 24, 6},
    {"windows", "H drifts 10 %", map_build, SEQ_DRIFT10, 24, 6},
    {"windows", "added mass drifts", map_build, SEQ_ADDED_DRIFT, 24, 6},
    {"windows", "nonlinear, b moves", map_build, SEQ_NONLINEAR, 24, 6},
    {"windows", "one flip", map_build, SEQ_FLIP, 24, 6},
    {"windows", "two maps in turn", map_build, SEQ_TURNS, 24, 6},
    {"windows", "scale jumps", map_build, SEQ_SCALE, 24, 6},
    {"windows", "new H", map_build, SEQ_NEW, 24, 6},
    {"windows", "new unstable H", map_build, SEQ_UNSTABLE, 24, 6},
    {"windows", "new added mass", map_build, SEQ_NEW_ADDED, 24, 6},
};
enum { MAPS = (int)(sizeof families / sizeof *families), FAMILIES = MAPS + REGIMES + HEAT_CASES };

static family family_of(int k)
{
    family f = {"tube", NULL, tube_build, 0, 1, 1};
    if (k < MAPS) return families[k];
    f.variant = k - MAPS;
    f.quick = f.variant % 2 == 0; /* quick runs: half of the regimes in full, the others with fewer windows */
    if (f.variant < REGIMES) {
        f.name = regimes[f.variant].name;
        return f;
    }
    f.variant -= REGIMES;
    f.quick = 1, f.group = "heat", f.name = heat_cases[f.variant].name, f.build = heat_build;
    return f;
}

/* ---- one run ---- */

typedef struct outcome {
    int evaluations, failed; /* of all windows; windows that failed, those not run included */
    int gave_up, false_end;  /* of them, by the contender's own word; said to have converged and had not */
} outcome;

static int has_converged(const problem *p, const double *x, const double *hx, double *first)
{
    double r = 0;
    ptrdiff_t i;
    for (i = 0; i < p->n; i++) r += (hx[i] - x[i]) * (hx[i] - x[i]);
    r = sqrt(r);
    if (*first < 0) *first = r;
    if (r == 0) return 1;
    if (p->reduction > 0 && r <= p->reduction * *first) return 1;
    return p->relative > 0 && r <= p->relative * length(p->n, hx);
}

/* A window: 1 converged, 0 not */
static int run_window(problem *p, const contender *c, void *state, double *x, double *hx, outcome *o)
{
    double first = -1;
    int k, own, status;
    for (k = 0; k < p->limit; k++) {
        own = p->map(p, x, hx);
        o->evaluations++;
        if (own < 0 || !finite_all(p->n, hx)) return 0;
        if (has_converged(p, x, hx, &first)) own = 1;
        status = c->step(state, x, hx);
        if (own) return 1;
        if (status == STEP_CONVERGED) o->false_end++;
        if (status == STEP_GIVES_UP) o->gave_up++;
        if (status != STEP_GOES_ON || !finite_all(p->n, x)) return 0;
    }
    return 0;
}

static outcome run(const family *f, unsigned long long seed, int shortened, const contender *c)
{
    problem p;
    outcome o = {0, 0, 0, 0};
    double *x, *hx, *answer;
    void *state;
    int w;
    memset(&p, 0, sizeof p);
    f->build(&p, f->variant, seed);
    if (shortened && p.windows > 24) p.windows = 24;
    x = numbers(p.n), hx = numbers(p.n), answer = numbers(p.n);
    state = c->make(c, &p);
    for (w = 0; w < p.windows; w++) {
        copy(p.n, answer, x);
        if (p.start) p.start(&p, w, x);
        if (run_window(&p, c, state, x, hx, &o)) {
            copy(p.n, hx, answer);
            if (p.accept) p.accept(&p, x, hx);
            c->commit(state);
            continue;
        }
        o.failed += p.ends ? p.windows - w : 1;
        if (p.ends) break;
        c->discard(state);
    }
    c->release(state);
    p.release(&p);
    free(x), free(hx), free(answer);
    return o;
}

/* ---- the table ---- */

typedef struct rating {
    int failed, gave_up, false_end, common;
    double total, ratio, median, worst; /* of the default over this contender, on the problems that both solve */
} rating;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static rating rate(int problems, outcome (*o)[CONTENDERS], int c)
{
    rating r;
    double mine = 0, its = 0, each[MOST];
    int i;
    memset(&r, 0, sizeof r);
    for (i = 0; i < problems; i++) {
        r.failed += o[i][c].failed, r.gave_up += o[i][c].gave_up, r.false_end += o[i][c].false_end;
        r.total += o[i][c].evaluations;
        if (o[i][0].failed || o[i][c].failed) continue;
        mine += o[i][0].evaluations, its += o[i][c].evaluations;
        each[r.common++] = (double)o[i][0].evaluations / o[i][c].evaluations;
    }
    if (r.common == 0) return r;
    qsort(each, (size_t)r.common, sizeof *each, ascending);
    r.ratio = mine / its, r.median = each[r.common / 2], r.worst = each[r.common - 1];
    return r;
}

typedef struct summary {
    double ratio[FAMILIES];
    const char *name[FAMILIES];
    int families, behind, windows_failed;
} summary;

static void report(const family *f, int problems, outcome (*o)[CONTENDERS], summary *s)
{
    rating r[CONTENDERS];
    int c, best = 0, safest = 0;
    for (c = 0; c < CONTENDERS; c++) {
        r[c] = rate(problems, o, c);
        if (r[c].failed < r[safest].failed) safest = c;
        if (c > 0 && r[c].failed <= r[0].failed && 2 * r[c].common >= problems && r[c].common > 0 &&
            (best == 0 || r[c].ratio > r[best].ratio))
            best = c;
    }
    printf("%-8s %-22s %4d %9.1f", f->group, f->name, problems, r[0].total / problems);
    if (best) printf("  %5.2f %5.2f %5.2f  %-24s", r[best].ratio, r[best].median, r[best].worst, contenders[best].name);
    else printf("  %5s %5s %5s  %-24s", "-", "-", "-", r[0].common ? "no other arrives" : "none arrives");
    printf(" %4d", r[0].failed);
    if (r[0].gave_up) printf(" (%d gave up)", r[0].gave_up);
    if (r[0].false_end) printf(" (%d falsely converged)", r[0].false_end);
    if (safest) printf("  %d: %s", r[safest].failed, contenders[safest].name), s->behind++;
    printf("\n");
    if (!best && r[0].failed) return;
    s->name[s->families] = f->name;
    s->ratio[s->families++] = best ? r[best].ratio : 1;
}

static void finish(summary *s)
{
    double sorted[FAMILIES];
    int i, worst = 0;
    if (s->families == 0) return;
    memcpy(sorted, s->ratio, sizeof sorted);
    qsort(sorted, (size_t)s->families, sizeof *sorted, ascending);
    for (i = 0; i < s->families; i++)
        if (s->ratio[i] > s->ratio[worst]) worst = i;
    printf("\nfamilies %d: median %.2f (goal 1.00), worst %.2f (goal 1.10): %s; more than 1.10 behind:", s->families,
           sorted[s->families / 2], s->ratio[worst], s->name[worst]);
    for (i = 0; i < s->families; i++)
        if (s->ratio[i] > 1.10) printf(" %s %.2f;", s->name[i], s->ratio[i]);
    printf("\nfamilies in which another setting fails less often than the default: %d (goal 0)\n", s->behind);
}

static int wanted(const char *group, int argc, char **argv)
{
    int i;
    for (i = 4; i < argc; i++)
        if (strcmp(group, argv[i]) == 0) return 1;
    return argc <= 4;
}

static unsigned long long first_seed(const char *seeds)
{
    if (strcmp(seeds, "dev") == 0) return 1;
    if (strcmp(seeds, "judge") == 0) return 1000000;
    return strtoull(seeds, NULL, 10);
}

int main(int argc, char **argv)
{
    static outcome o[MOST][CONTENDERS];
    static summary s;
    const char *seeds = argc > 3 ? argv[3] : "judge";
    const unsigned long long first = first_seed(seeds);
    const int quick = argc > 2 && strcmp(argv[2], "quick") == 0;
    char path[600];
    FILE *csv;
    int k, i, c;
    if (argc < 2) {
        fprintf(stderr, "usage: arena DIRECTORY [full|quick] [judge|dev|number] [group ...]\n");
        return 2;
    }
    snprintf(path, sizeof path, "%s/arena.csv", argv[1]);
    csv = fopen(path, "w");
    if (!csv) {
        fprintf(stderr, "cannot write %s\n", path);
        return 1;
    }
    fprintf(csv, "group,family,seed,setting,evaluations,failed,gave_up,false_end\n");
    printf("seeds from %llu (%s)\n%-8s %-22s %4s %9s  %-18s %-24s %s\n", first, seeds, "", "family", "", "default",
           "over best: all median worst", "best setting", "failed  fewest");
    for (k = 0; k < FAMILIES; k++) {
        const family f = family_of(k);
        const int count = quick && f.quick > 0 ? f.quick : f.count;
        if (!wanted(f.group, argc, argv)) continue;
        for (i = 0; i < count; i++)
            for (c = 0; c < CONTENDERS; c++) {
                o[i][c] = run(&f, first + (unsigned long long)i, quick && f.quick == 0, contenders + c);
                fprintf(csv, "%s,\"%s\",%llu,\"%s\",%d,%d,%d,%d\n", f.group, f.name, first + (unsigned long long)i,
                        contenders[c].name, o[i][c].evaluations, o[i][c].failed, o[i][c].gave_up, o[i][c].false_end);
            }
        report(&f, count, o, &s);
        fflush(stdout);
    }
    finish(&s);
    fclose(csv);
    return 0;
}
