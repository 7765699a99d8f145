/* SPDX-License-Identifier: MIT

   arena.c - many fixed points, many accelerators, one table: how far the defaults of iqn.h are behind the best setting.

   arena DIRECTORY [full|quick] [judge|dev|number] [single|windows|charge|tube|heat|bodies|facts|a family ...]

   Every family of problems is given to every contender.  A contender is rated on a whole family: evaluations of H of
   the default over its own, summed over the problems that both solve.  It counts as a rival for evaluations where it
   fails in no more windows than the default does.  All store the same number of pairs.  The runs of a coupled family
   differ in the last bits of their first guesses: one run alone would be chance.  Development seeds start at 1, judging
   seeds at 1000000. */
#include "arena_coupled.h"
#include "arena_maps.h"
#include "arena_other.h"
#include "arena_run.h"
#include "arena_facts.h"


enum { MOST = 200, COUPLED_RUNS = 5 };

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
    {"charge", "box 5", charge_build, 5, 20, 5},
    {"charge", "box 20", charge_build, 20, 20, 5},
    {"charge", "box 60", charge_build, 60, 20, 5},
};
enum { MAPS = (int)(sizeof families / sizeof *families), FAMILIES = MAPS + REGIMES + HEAT_CASES + BODIES_CASES };

static family family_of(int k)
{
    family f = {"tube", NULL, tube_build, 0, COUPLED_RUNS, 1};
    if (k < MAPS) return families[k];
    f.variant = k - MAPS;
    f.quick = f.variant % 2 == 0; /* quick runs: half of the regimes in full, the others with fewer windows */
    if (f.variant < REGIMES) {
        f.name = regimes[f.variant].name;
        return f;
    }
    f.variant -= REGIMES;
    f.quick = 1;
    if (f.variant < HEAT_CASES) {
        f.group = "heat", f.name = heat_cases[f.variant].name, f.build = heat_build;
        return f;
    }
    f.variant -= HEAT_CASES;
    f.count = 4, f.group = "bodies", f.name = bodies_cases[f.variant].name, f.build = bodies_build;
    return f;
}

/* ---- the table ---- */

typedef struct rating {
    int failed, gave_up, false_end, common;
    double total, ratio, median, worst; /* of contender d over this one, on the problems that both solve */
} rating;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static rating rate(int problems, outcome (*o)[CONTENDERS], int d, int c)
{
    rating r;
    double mine = 0, its = 0, each[MOST];
    int i;
    memset(&r, 0, sizeof r);
    for (i = 0; i < problems; i++) {
        r.failed += o[i][c].failed, r.gave_up += o[i][c].gave_up, r.false_end += o[i][c].false_end;
        r.total += o[i][c].evaluations;
        if (o[i][d].failed || o[i][c].failed) continue;
        mine += o[i][d].evaluations, its += o[i][c].evaluations;
        each[r.common++] = (double)o[i][d].evaluations / o[i][c].evaluations;
    }
    if (r.common == 0) return r;
    qsort(each, (size_t)r.common, sizeof *each, ascending);
    r.ratio = mine / its, r.median = each[r.common / 2], r.worst = each[r.common - 1];
    return r;
}

/* What one contender would be as the default: its ratio to the best of the others in every family */
typedef struct standing {
    double ratio[FAMILIES];
    int families, behind, never; /* fails more often than another; arrives in no problem of a family */
} standing;

typedef struct summary {
    standing of[CONTENDERS];
    double ratio[FAMILIES];
    const char *name[FAMILIES];
    int families, behind, windows_failed;
    char safer[FAMILIES][100]; /* the family, what the default failed in, what the safest one did */
} summary;

static void stand(int problems, outcome (*o)[CONTENDERS], int d, standing *s)
{
    const rating mine = rate(problems, o, d, d);
    double worst = 0;
    int c, fewest = mine.failed;
    for (c = 0; c < CONTENDERS; c++) {
        const rating r = rate(problems, o, d, c);
        if (c == METRIC) continue;
        if (r.failed < fewest) fewest = r.failed;
        if (c != d && r.failed <= mine.failed && 2 * r.common >= problems && r.common > 0) worst = fmax(worst, r.ratio);
    }
    s->behind += fewest < mine.failed;
    s->never += mine.common == 0;
    if (worst > 0) s->ratio[s->families++] = worst;
}

static void standings(const summary *s)
{
    double sorted[FAMILIES];
    int c, i;
    printf("\neach setting as the default: median and worst ratio, families more than 1.10 behind, in which another\n"
           "setting fails less often, in which it never arrives\n");
    for (c = 0; c < CONTENDERS; c++) {
        const standing *a = s->of + c;
        int above = 0;
        if (c == METRIC || a->families == 0) continue;
        memcpy(sorted, a->ratio, sizeof sorted);
        qsort(sorted, (size_t)a->families, sizeof *sorted, ascending);
        for (i = 0; i < a->families; i++) above += sorted[i] > 1.10;
        printf("%-24s %5.2f %6.2f %4d of %2d %4d %4d\n", contenders[c].name, sorted[a->families / 2],
               sorted[a->families - 1], above, a->families, a->behind, a->never);
    }
}

static void report(const family *f, int problems, outcome (*o)[CONTENDERS], summary *s)
{
    rating r[CONTENDERS];
    int c, best = 0, safest = 0;
    for (c = 0; c < CONTENDERS; c++) stand(problems, o, c, s->of + c);
    for (c = 0; c < CONTENDERS; c++) {
        r[c] = rate(problems, o, 0, c);
        if (c == METRIC) continue; /* it is told more than the others */
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
    if (safest) {
        printf("  %d: %s", r[safest].failed, contenders[safest].name);
        snprintf(s->safer[s->behind++], sizeof *s->safer, "%s %d, %s %d", f->name, r[0].failed, contenders[safest].name, r[safest].failed);
    }
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
    printf("\nfamilies in which another setting fails less often than the default: %d (goal 0)", s->behind);
    for (i = 0; i < s->behind; i++) printf("%s %s", i ? ";" : ":", s->safer[i]);
    printf("\n");
    standings(s);
}

static int wanted(const char *group, const char *name, int argc, char **argv)
{
    int i;
    for (i = 4; i < argc; i++)
        if (strcmp(group, argv[i]) == 0 || strcmp(name, argv[i]) == 0) return 1;
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
        int count = f.count;
        if (quick) count = f.quick > 0 ? f.quick : 1; /* 0: fewer windows */
        if (!wanted(f.group, f.name, argc, argv)) continue;
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
    if (wanted("facts", "", argc, argv)) facts(first, quick);
    fclose(csv);
    return 0;
}
