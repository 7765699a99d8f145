/* SPDX-License-Identifier: MIT

   arena.c - many fixed points, many accelerators, one table: how far the defaults of iqn.h are behind the best setting.

   arena DIRECTORY [full|quick|pair|alone] [WORD] [group or family ...]   alone: full, the default and the old one alone;
   pair: the same, quick

   Every family of problems is given to every contender.  A contender is rated on a whole family: evaluations of H of
   the default over its own, summed over the problems that both solve.  It counts as a rival for evaluations where it
   fails in no more windows than the default does.  All store the same number of pairs.  The runs of a coupled family
   differ in the last bits of their first guesses: one run alone would be chance.

   WORD makes the seeds; "judge" and "dev" are 1000000 and 1, as they were for 0.2.0, and a number is itself.  The groups
   charge, linear, tube, heat and bodies are named after the job of a user; told: jobs of which the host tells more
   (several blocks, samples of weight 0, IMVJ, the noise of H); synthetic: nobody's job, no default is tuned on them.
   All but told were there in 0.2.0: 1541 problems. */
#include "arena.h"
#include "arena_kit.h"
#ifdef OLD /* another version of iqn.h, its names begin with iqnold */
#  define IQNOLD_IMPLEMENTATION
#  include "iqnold_kit.h"
#endif
#include "arena_coupled.h"
#include "arena_maps.h"
#include "arena_rivals.h"
#include "arena_run.h"

static const contender contenders[] = {
    {"default", IQN_KIT, -1, LEAST_SQUARES},
    {"iqn.h, one window", IQN_KIT, 0, LEAST_SQUARES},
    {"iqn.h, 8 windows", IQN_KIT, 8, LEAST_SQUARES},
    {"iqn.h, IMVJ", IQN_KIT, 0, GROUPS},
    {"iqn.h, Aitken", IQN_KIT, 0, OMEGA},
    {"one window 1e-6", RIVAL, 0.1, 1e-6, 0, LEAST_SQUARES},
    {"8 windows 1e-3", RIVAL, 0.01, 1e-3, 8, LEAST_SQUARES},
    {"all pairs 1e-6", RIVAL, 0.1, 1e-6, 1000, LEAST_SQUARES},
    {"IMVJ 1e-2", RIVAL, 0.1, 1e-2, 1000, GROUPS},
#ifdef OLD
    {"old default", IQNOLD_KIT, -1, LEAST_SQUARES},
#endif
};
enum { CONTENDERS = (int)(sizeof contenders / sizeof *contenders), RIVALS = 9, MOST = 60, FAMILIES = 110 };

static const family maps[] = {
    {"charge", "box 5", charge_build, 5, 20},
    {"charge", "box 20", charge_build, 20, 20},
    {"charge", "box 60", charge_build, 60, 20},
    {"linear", "load moves", map_build, SEQ_MOVES, 24},
    {"linear", "load at random", map_build, SEQ_RANDOM, 24},
    {"linear", "matrix drifts 1 %", map_build, SEQ_DRIFT1, 24},
    {"linear", "matrix drifts 10 %", map_build, SEQ_DRIFT10, 24},
    {"linear", "added mass drifts", map_build, SEQ_ADDED_DRIFT, 24},
    {"linear", "quadratic, load moves", map_build, SEQ_NONLINEAR, 24},
    {"linear", "matrix changes once", map_build, SEQ_FLIP, 24},
    {"synthetic", "two maps in turn", map_build, SEQ_TURNS, 24},
    {"synthetic", "scale jumps", map_build, SEQ_SCALE, 24},
    {"synthetic", "new H", map_build, SEQ_NEW, 24},
    {"synthetic", "new unstable H", map_build, SEQ_UNSTABLE, 24},
    {"synthetic", "new added mass", map_build, SEQ_NEW_ADDED, 24},
    {"synthetic", "contraction", map_build, CONTRACTION, 60},
    {"synthetic", "random 0.9", map_build, RANDOM09, 60},
    {"synthetic", "random 3", map_build, RANDOM3, 60},
    {"synthetic", "Jordan", map_build, JORDAN, 60},
    {"synthetic", "skew", map_build, SKEW, 60},
    {"synthetic", "added mass 1e1", map_build, ADDED10, 60},
    {"synthetic", "added mass 1e2", map_build, ADDED100, 60},
    {"synthetic", "added mass 1e3", map_build, ADDED1000, 60},
    {"synthetic", "both signs 1e2", map_build, BOTH_SIGNS, 60},
    {"synthetic", "nearly singular", map_build, NEARLY_SINGULAR, 60},
    {"synthetic", "cyclic", map_build, CYCLIC, 60},
    {"synthetic", "1e-4 to 10", map_build, SPREAD, 60},
    {"synthetic", "quadratic", map_build, QUADRATIC, 60},
    {"synthetic", "tanh", map_build, TANH, 60},
    {"synthetic", "sine", map_build, SINE, 60},
    {"synthetic", "noise 1e-9", map_build, NOISY, 60},
};
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

#define LIST(cases, untold, group, build, count)                                              \
    for (k = 0; k < COUNT(cases); k++) {                                                      \
        const family one = {k < (untold) ? group : "told", cases[k].name, build, k, count};   \
        f[n++] = one;                                                                         \
    }

static int list_families(family *f)
{
    int n = 0, k;
    LIST(regimes, 17, "tube", tube_build, 5)
    LIST(heat_cases, 20, "heat", heat_build, 5)
    LIST(bodies_cases, 12, "bodies", bodies_build, 4)
    for (k = 0; k < COUNT(maps); k++) f[n++] = maps[k];
    return n;
}

/* ---- the table ---- */

typedef struct rating {
    int failed, runs, common;
    double total, ratio; /* evaluations; those of d over these, on the problems that both solve */
} rating;

static rating rate(int count, outcome (*o)[CONTENDERS], int d, int c)
{
    rating r = {0, 0, 0, 0, 0};
    double mine = 0, its = 0;
    int i;
    for (i = 0; i < count; i++) {
        r.failed += o[i][c].failed, r.runs += o[i][c].failed > 0, r.total += o[i][c].evaluations;
        if (o[i][d].failed || o[i][c].failed) continue;
        mine += o[i][d].evaluations, its += o[i][c].evaluations, r.common++;
    }
    if (r.common) r.ratio = mine / its;
    return r;
}

/* d beside the best of the others, 0: none; *best, *safest: who has fewest evaluations, and fails least often */
static double beside(int count, outcome (*o)[CONTENDERS], int d, int *best, int *safest)
{
    const int mine = rate(count, o, d, d).failed;
    int c, fewest = mine;
    double worst = 0;
    for (*best = *safest = d, c = 0; c < RIVALS; c++) {
        const rating r = rate(count, o, d, c);
        if (r.failed < fewest) fewest = r.failed, *safest = c;
        if (c != d && r.failed <= mine && 2 * r.common >= count && r.ratio > worst) worst = r.ratio, *best = c;
    }
    return worst;
}

/* Of a class of families: users' jobs, told, synthetic; of the first contender, or of each as the default */
typedef struct standing {
    double ratio[FAMILIES], logs; /* log of the default over the old one */
    int families, behind, never, problems, runs, old, compared;
    char far[2000];
} standing;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void enter(standing *s, int count, outcome (*o)[CONTENDERS], int d, const family *f)
{
    const rating mine = rate(count, o, d, d), old = rate(count, o, d, CONTENDERS - 1);
    int best, safest;
    const double ratio = beside(count, o, d, &best, &safest);
    const size_t used = strlen(s->far);
    s->behind += safest != d, s->never += mine.common == 0;
    s->problems += count, s->runs += mine.runs, s->old += old.runs;
    if (old.common) s->logs += log(old.ratio), s->compared++;
    if (ratio > 0) s->ratio[s->families++] = ratio;
    if (ratio > 1.10) snprintf(s->far + used, sizeof s->far - used, " %s %.2f (%s);", f->name, ratio, contenders[best].name);
    if (d > 0) return;
    printf("%-9s %-24s %3d %8.1f  %5.2f %-18s", f->group, f->name, count, mine.total / count, ratio,
           best ? contenders[best].name : "no other converges");
    if (CONTENDERS > RIVALS) printf(" %5.2f", old.ratio);
    printf(" %3d%s%s\n", mine.runs, safest ? "  fewer: " : "", safest ? contenders[safest].name : "");
    fflush(stdout);
}

static void print_standing(const char *name, const standing *s)
{
    double sorted[FAMILIES];
    int i, above = 0;
    if (s->families == 0) return;
    memcpy(sorted, s->ratio, sizeof sorted);
    qsort(sorted, (size_t)s->families, sizeof *sorted, ascending);
    for (i = 0; i < s->families; i++) above += sorted[i] > 1.10;
    printf("%-24s %5.2f %6.2f %4d of %2d %4d %4d %5d of %d\n", name, sorted[s->families / 2], sorted[s->families - 1], above,
           s->families, s->behind, s->never, s->runs, s->problems);
}

static void finish(standing (*all)[CONTENDERS])
{
    static const char *const classes[] = {"users' jobs", "told more", "synthetic"};
    const standing *s = &all[0][0], *more = &all[2][0];
    int k, c;
    printf("\nratio: median, worst, above 1.10 in; another fails less often in; never converges in; runs that fail\n"
           "the default, by class of families\n");
    for (k = 0; k < 3; k++) print_standing(classes[k], all[k]);
    printf("each setting as the default, users' jobs\n");
    for (c = 0; c < RIVALS; c++) print_standing(contenders[c].name, all[0] + c);
    printf("each setting as the default, told more\n");
    for (c = 0; c < RIVALS; c++) print_standing(contenders[c].name, all[1] + c);
    for (k = 0; k < 3; k++) printf("more than 1.10 behind, %s:%s\n", classes[k], all[k]->far);
    printf("runs that fail: %d of %d (goal 45 of 1541)", s->runs + more->runs, s->problems + more->problems);
    if (CONTENDERS > RIVALS)
        printf("; old default %d; evaluations beside it, geometric mean of %d families: %.3f (goal 1.03); users' jobs %.3f", s->old + more->old,
               s->compared + more->compared, exp((s->logs + more->logs) / fmax(1, s->compared + more->compared)),
               exp(s->logs / fmax(1, s->compared)));
    printf("\n");
}

int main(int argc, char **argv)
{
    static outcome o[MOST][CONTENDERS];
    static standing all[3][CONTENDERS];
    static family f[FAMILIES];
    const char *word = argc > 3 ? argv[3] : "judge";
    const unsigned long long first = first_seed(word);
    const char *mode = argc > 2 ? argv[2] : "full";
    const int quick = strcmp(mode, "quick") == 0 || strcmp(mode, "pair") == 0, families = list_families(f);
    const int alone = strcmp(mode, "pair") == 0 || strcmp(mode, "alone") == 0;
    char path[600];
    FILE *csv;
    int k, i, c;
    snprintf(path, sizeof path, "%s/arena.csv", argc > 1 ? argv[1] : ".");
    csv = fopen(path, "w");
    if (!csv) return fprintf(stderr, "arena DIRECTORY [full|quick|pair|alone] [WORD] [group or family ...]: cannot write %s\n", path), 2;
    fprintf(csv, "group,family,seed,setting,evaluations,failed\n");
    printf("seeds from %llu (%s)\n%-34s %3s %8s  over the best of others   %sfailed\n", first, word, "family", "", "default",
           CONTENDERS > RIVALS ? "  old " : "");
    for (k = 0; k < families; k++) {
        const int count = quick ? (f[k].count + 4) / 5 : f[k].count;
        const int class = strcmp(f[k].group, "told") == 0 ? 1 : strcmp(f[k].group, "synthetic") == 0 ? 2 : 0;
        for (i = 4; i < argc && strcmp(f[k].group, argv[i]) != 0 && strcmp(f[k].name, argv[i]) != 0;) i++;
        if (argc > 4 && i == argc) continue;
        for (i = 0; i < count; i++)
            for (c = 0; c < CONTENDERS; c++) {
                o[i][c].failed = 1; /* who does not run */
                if (!alone || c == 0 || c >= RIVALS) o[i][c] = run(f + k, first + (unsigned long long)i, quick, contenders + c);
                fprintf(csv, "%s,\"%s\",%llu,\"%s\",%d,%d\n", f[k].group, f[k].name, first + (unsigned long long)i,
                        contenders[c].name, o[i][c].evaluations, o[i][c].failed);
            }
        for (c = 0; c < RIVALS; c++) enter(&all[class][c], count, o, c, f + k);
    }
    finish(all);
    return fclose(csv) != 0;
}
