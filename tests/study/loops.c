/* SPDX-License-Identifier: MIT

   loops.c - hosts that have a loop of their own, and it converges: is iqn.h ever behind it?

   loops [WORD] [kind ...]

   27 kinds of hosts' own loops, three hosts of each by WORD, eleven windows of each: loads change from window to window,
   and every kind has kinks.  A host's own loop is x += omega (H(x) - x) with the best of five constant omegas: the one
   that answers every window with the fewest evaluations in all.  All contenders get the same windows: state, first guess
   and limit of |r| / |H(x)| follow from the own loop's answers, so a window that one of them gives up does not spoil the
   next one.  A window given up is repeated by the own loop, and both are counted.

   Then hosts that stop after 4, 8, 16 evaluations, converged or not, and go on.  Then maps with several fixed points: from how many of 20 starts is one reached, of those from which damping reaches one.

   Goals: at most one host of 72 above 1.1 of its own loop; at most one window of 100 given up that the own loop answers. */
#include "arena.h"
#define IQN_IMPLEMENTATION
#include "arena_kit.h"
#ifdef OLD /* another version of iqn.h, its names begin with iqnold */
#  define IQNOLD_IMPLEMENTATION
#  include "iqnold_kit.h"
#endif
#include "arena_rivals.h"
#include "loops_fields.h"
#include "loops_other.h"
#include "loops_several.h"
#include "loops_rivals.h"

static const contender own[] = {
    {"plain", RELAXED, 1, 0, 0, LEAST_SQUARES},
    {"damping .8", RELAXED, 0.8, 0, 0, LEAST_SQUARES},
    {"damping .5", RELAXED, 0.5, 0, 0, LEAST_SQUARES},
    {"damping .3", RELAXED, 0.3, 0, 0, LEAST_SQUARES},
    {"damping .1", RELAXED, 0.1, 0, 0, LEAST_SQUARES},
};

static const contender others[] = {
    {"iqn.h", IQN_KIT_CALLS, 0, 0, -1, LEAST_SQUARES},
    {"omega 1", IQN_KIT_CALLS, 1, 0, -1, LEAST_SQUARES},
#ifdef OLD
    {"old", IQNOLD_KIT_CALLS, 0, 0, -1, LEAST_SQUARES},
    {"old, 1", IQNOLD_KIT_CALLS, 1, 0, -1, LEAST_SQUARES},
#endif
    {"Aitken", RELAXED, 0.5, 0, 0, OMEGA},
    {"Anderson", RIVAL, 1, 1e-8, 0, LEAST_SQUARES},
#ifdef AA
    {"aa II", PEER, 1, 1e-12, 0, LEAST_SQUARES},
    {"aa I", PEER, 1, 1e-8, 0, GROUPS},
#endif
};
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))
enum { OWN = COUNT(own), OTHERS = COUNT(others), HOSTS = 3 };

static const family kinds[] = {
    {"fields", "aquifer", aquifer_build, 0, HOSTS},
    {"fields", "drainage", drainage_build, 0, HOSTS},
    {"fields", "furnace", furnace_build, 0, HOSTS},
    {"fields", "rod", rod_build, 0, HOSTS},
    {"fields", "switching", switching_build, 0, HOSTS},
    {"fields", "magnet", magnet_build, 0, HOSTS},
    {"fields", "freezing", freezing_build, 0, HOSTS},
    {"fields", "infiltration", infiltration_build, 0, HOSTS},
    {"fields", "obstacle", obstacle_build, 0, HOSTS},
    {"fields", "circulation", circulation_build, 0, HOSTS},
    {"fields", "feeder", feeder_build, 0, HOSTS},
    {"fields", "recycle", recycle_build, 0, HOSTS},
    {"fields", "rooms", rooms_build, 0, HOSTS},
    {"other", "stops", stops_build, 0, HOSTS},
    {"other", "friction", friction_build, 0, HOSTS},
    {"other", "controllers", controllers_build, 0, HOSTS},
    {"other", "firms", firms_build, 0, HOSTS},
    {"other", "mixture", mixture_build, 0, HOSTS},
    {"other", "classes", mixture_build, 1, HOSTS},
    {"other", "roads", roads_build, 0, HOSTS},
    {"other", "planning", planning_build, 0, HOSTS},
    {"other", "electrons", electrons_build, 0, HOSTS},
    {"other", "balancing", balancing_build, 0, HOSTS},
    {"other", "sparse", sparse_build, 0, HOSTS},
    {"other", "programs", programs_build, 0, HOSTS},
    {"other", "titration", titration_build, 0, HOSTS},
    {"other", "chord", chord_build, 0, HOSTS},
};

/* ---- one window ---- */

/* Evaluations until |r| <= limit |H(x)|; < 0: so many, and given up.  x: the first guess in, the answer out. */
static int solve(problem *p, const contender *c, void *state, double limit, double *x, double *hx)
{
    int k, status;
    for (k = 1; k <= p->limit; k++) {
        double r = 0;
        ptrdiff_t i;
        if (p->map(p, x, hx) < 0 || !finite_all(p->n, hx)) return -k;
        for (i = 0; i < p->n; i++) r += (hx[i] - x[i]) * (hx[i] - x[i]);
        status = c->step(state, x, hx);
        if (sqrt(r) <= limit * length(p->n, hx)) {
            copy(p->n, hx, x);
            return k;
        }
        if (status != 0 || !finite_all(p->n, x)) return -k;
    }
    return -p->limit;
}

static int run_window(problem *p, const contender *c, void *state, const double *guess)
{
    double *x = numbers(p->n), *hx = numbers(p->n);
    int k;
    copy(p->n, guess, x);
    k = solve(p, c, state, p->relative, x, hx);
    if (k > 0) c->commit(state);
    else c->discard(state);
    free(x);
    free(hx);
    return k;
}

/* ---- one host ---- */

typedef struct score {
    int hosts, above, given_up;
    double logs, worst; /* of evaluations over those of the own loop */
} score;

typedef struct host_score {
    int omega; /* of own[], -1: none answers every window */
    int own;   /* evaluations of it */
    int evaluations[OTHERS], given_up[OTHERS];
} host_score;

/* One host in the making: the own loops and others, and what each needed in every window, < 0: given up */
typedef struct contest {
    problem p;
    int count, trials; /* of contenders; evaluations of a window that the others have */
    const contender *who[OWN + OTHERS];
    void *state[OWN + OTHERS];
    int needed[OWN + OTHERS][HOST_WINDOWS];
} contest;

static void begin(contest *t, const family *f, unsigned long long seed, const contender *rest, int count, int trials)
{
    int c;
    memset(t, 0, sizeof *t);
    f->build(&t->p, f->variant, seed);
    t->count = OWN + count;
    t->trials = trials;
    for (c = 0; c < t->count; c++) {
        t->who[c] = c < OWN ? own + c : rest + (c - OWN);
        t->state[c] = t->who[c]->make(t->who[c], &t->p);
    }
}

static void end(contest *t)
{
    int c;
    for (c = 0; c < t->count; c++) t->who[c]->release(t->state[c]);
    free(t->p.state);
}

/* An omega that has given up a window is out of the contest: it is not asked again. */
static int is_out(const contest *t, int c, int window)
{
    return c < OWN && window > 0 && t->needed[c][window - 1] < 0;
}

/* The answer of a window: that of the first omega left, to a hundredth of the limit if it gets there. */
static void answer(problem *p, const contender *c, double *x)
{
    double *hx = numbers(p->n);
    void *state = c->make(c, p);
    solve(p, c, state, 0.01 * p->relative, x, hx);
    c->release(state);
    free(hx);
}

/* All windows by all contenders; returns how many windows have an answer. */
static int play(contest *t)
{
    double *x = numbers(t->p.n);
    int w, c, first;
    for (w = 0; w < t->p.windows; w++) {
        t->p.start(&t->p, w, x);
        for (c = 0; c < t->count; c++) {
            t->p.limit = c < OWN ? HOST_LIMIT : t->trials;
            t->needed[c][w] = is_out(t, c, w) ? -1 : run_window(&t->p, t->who[c], t->state[c], x);
        }
        t->p.limit = HOST_LIMIT;
        for (first = 0; first < OWN && t->needed[first][w] < 0;) first++;
        if (first == OWN) break;
        answer(&t->p, own + first, x);
        if (t->p.accept) t->p.accept(&t->p, x);
    }
    free(x);
    return w;
}

/* The omega that answers every window with the fewest evaluations, -1: none */
static int best_omega(const contest *t)
{
    int best = -1, fewest = 0, c, w;
    for (c = 0; c < OWN; c++) {
        int total = 0;
        if (t->needed[c][t->p.windows - 1] < 0) continue;
        for (w = 0; w < t->p.windows; w++) total += t->needed[c][w];
        if (best < 0 || total < fewest) {
            best = c;
            fewest = total;
        }
    }
    return best;
}

static host_score run_host(const family *f, unsigned long long seed)
{
    contest t;
    host_score s;
    int w, c;
    memset(&s, 0, sizeof s);
    begin(&t, f, seed, others, OTHERS, HOST_LIMIT);
    s.omega = play(&t) == t.p.windows ? best_omega(&t) : -1;
    for (w = 0; s.omega >= 0 && w < t.p.windows; w++) {
        const int own_loop = t.needed[s.omega][w];
        s.own += own_loop;
        for (c = 0; c < OTHERS; c++) {
            const int n = t.needed[OWN + c][w];
            s.evaluations[c] += n > 0 ? n : -n + own_loop; /* given up: repeated by the own loop */
            s.given_up[c] += n < 0;
        }
    }
    end(&t);
    return s;
}

/* ---- tables ---- */

static void enter(score *sum, const host_score *s, int c)
{
    const double ratio = (double)s->evaluations[c] / s->own;
    char text[40];
    sum->hosts++;
    sum->above += ratio > 1.1;
    sum->given_up += s->given_up[c];
    sum->logs += log(ratio);
    sum->worst = fmax(sum->worst, ratio);
    if (s->given_up[c]) snprintf(text, sizeof text, "%d (%d)%s", s->evaluations[c], s->given_up[c], ratio > 1.1 ? "*" : " ");
    else snprintf(text, sizeof text, "%d%s", s->evaluations[c], ratio > 1.1 ? "*" : " ");
    printf(" %14s", text);
}

/* Returns 1 if it has a loop of its own. */
static int print_host(score *sum, const family *f, unsigned long long seed)
{
    const host_score s = run_host(f, seed);
    int c;
    if (s.omega < 0) {
        printf("%-14s no constant omega answers every window\n", f->name);
        return 0;
    }
    printf("%-14s %5d: %-15s", f->name, s.own, own[s.omega].name);
    for (c = 0; c < OTHERS; c++) enter(sum + c, &s, c);
    printf("\n");
    fflush(stdout);
    return 1;
}

static void print_loops(int argc, char **argv, unsigned long long first)
{
    score sum[OTHERS];
    int hosts = 0, without = 0, k, i, c;
    memset(sum, 0, sizeof sum);
    printf("hosts' own loops: evaluations of %d windows (windows given up); *: above 1.1 of the own loop, hosts\n%-14s %-22s",
           HOST_WINDOWS, "kind", "own loop: omega");
    for (c = 0; c < OTHERS; c++) printf(" %14s", others[c].name);
    printf("\n");
    for (k = 0; k < COUNT(kinds); k++) {
        for (i = 2; i < argc && strcmp(kinds[k].name, argv[i]) != 0;) i++;
        if (argc > 2 && i == argc) continue;
        for (i = 0; i < kinds[k].count; i++) hosts += print_host(sum, kinds + k, first + (unsigned long long)i);
        without += kinds[k].count;
    }
    without -= hosts;
    printf("\n%d hosts, %d windows; %d more have no loop of their own that answers all\n", hosts, hosts * HOST_WINDOWS, without);
    for (c = 0; c < OTHERS && hosts > 0; c++)
        printf("loops of hosts, %-10s above 1.1: %d of %d (worst %.2f); given up: %d of %d windows; evaluations over the own loop's %.3f\n",
               others[c].name, sum[c].above, hosts, sum[c].worst, sum[c].given_up, hosts * HOST_WINDOWS, exp(sum[c].logs / hosts));
}

/* A host that stops after so many evaluations, converged or not, and goes on: "commit" calls iqn_commit all the same. */
static const contender stopping[] = {
    {"iqn.h", IQN_KIT_CALLS, 0, 0, -1, LEAST_SQUARES},
    {"commit", iqn_kit_make, iqn_kit_step, iqn_kit_commit, iqn_kit_commit, free, 0, 0, -1, LEAST_SQUARES},
    {"omega 1", IQN_KIT_CALLS, 1, 0, -1, LEAST_SQUARES},
    {"omega 1, commit", iqn_kit_make, iqn_kit_step, iqn_kit_commit, iqn_kit_commit, free, 1, 0, -1, LEAST_SQUARES},
};

typedef struct open_windows {
    int windows, own, others[COUNT(stopping)]; /* all; not converged: by the own loop, by each of stopping[] */
} open_windows;

static void enter_trials(open_windows *sum, const family *f, unsigned long long seed, int trials)
{
    contest t;
    int best, c, w;
    begin(&t, f, seed, stopping, COUNT(stopping), trials);
    best = play(&t) == t.p.windows ? best_omega(&t) : -1;
    for (w = 0; best >= 0 && w < t.p.windows; w++) {
        sum->windows++;
        sum->own += t.needed[best][w] > trials;
        for (c = 0; c < COUNT(stopping); c++) sum->others[c] += t.needed[OWN + c][w] < 0;
    }
    end(&t);
}

static void print_trials(unsigned long long first)
{
    static const int trials[] = {4, 8, 16};
    int n, k, i, c;
    printf("\na fixed number of trials: windows that have not converged by then\n");
    for (n = 0; n < COUNT(trials); n++) {
        open_windows sum = {0, 0, {0}};
        for (k = 0; k < COUNT(kinds); k++)
            for (i = 0; i < kinds[k].count; i++) enter_trials(&sum, kinds + k, first + (unsigned long long)i, trials[n]);
        printf("%2d trials: own loop %d", trials[n], sum.own);
        for (c = 0; c < COUNT(stopping); c++) printf(", %s %d", stopping[c].name, sum.others[c]);
        printf(" of %d windows\n", sum.windows);
        fflush(stdout);
    }
}

/* Of 20 starts of a game, from which damping reaches a fixed point, those from which c does; *reached: of damping */
static int reaches(int kind, unsigned long long seed, const contender *c, int columns, int *reached)
{
    problem p;
    int w, o, mine = 0;
    double *x;
    memset(&p, 0, sizeof p);
    several_build(&p, kind, seed);
    p.columns = columns;
    x = numbers(p.n);
    for (*reached = w = 0; w < p.windows; w++) {
        void *state = c->make(c, &p);
        int damped = 0;
        p.start(&p, w, x);
        for (o = 0; o < OWN && !damped; o++) {
            void *loop = own[o].make(own + o, &p);
            damped = run_window(&p, own + o, loop, x) > 0;
            own[o].release(loop);
        }
        *reached += damped;
        mine += damped && run_window(&p, c, state, x) > 0;
        c->release(state);
    }
    free(p.state);
    free(x);
    return mine;
}

static void print_several(unsigned long long first)
{
    static const int columns[] = {5, 10, 20, 50};
    int kind, game, c, k;
    printf("\nseveral fixed points: of 20 starts, those that reach one, mean of 5 games (least), with 5, 10, 20, 50 columns\n");
    for (kind = 0; kind < SEVERAL; kind++)
        for (c = 0; c < OTHERS; c++) {
            if (others[c].make == relaxed_make) continue;
            printf("%-18s %-10s", several_names[kind], others[c].name);
            for (k = 0; k < COUNT(columns); k++) {
                int sum = 0, least = 20, of = 0, reached;
                for (game = 0; game < 5; game++) {
                    const int mine = reaches(kind, first + (unsigned long long)game, others + c, columns[k], &reached);
                    sum += mine;
                    of += reached;
                    if (mine + 20 - reached < least) least = mine + 20 - reached;
                }
                printf("  %5.1f of %.1f (%2d)", sum / 5., of / 5., least);
            }
            printf("\n");
            fflush(stdout);
        }
}

int main(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "dev";
    const unsigned long long first = first_seed(word);
    printf("seeds from %llu (%s)\n", first, word);
    print_loops(argc, argv, first);
    if (argc > 2) return 0;
    print_trials(first);
    print_several(first);
    return 0;
}
