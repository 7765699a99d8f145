/* SPDX-License-Identifier: MIT

   bench_rk.c - what a step of y' = -y costs by rk.h, beside typed-in loops and the peers installed

   A step starts from a y that stays, with its slope at hand, and ends with the new y (first same as last: with its slope
   too).  Right-hand sides are part of it, through a call for every contender.  esdirk4: the sums before the implicit
   stages.  error: the error estimate of dp5, kept, and the root mean square of its weighted norm; both sides look for
   overflow.  dense: one value inside a step of dp5, its weights formed from theta on both sides; sum: the same with the
   weights at hand on both sides.  The loops (floors.c) are typed in for each method.  Every contender has a process of its
   own (bench.h).                                                                                                         */
#if !defined(_POSIX_C_SOURCE)
#    define _POSIX_C_SOURCE 200809L
#endif
#define RK_IMPLEMENTATION
#include "rk.h"

#include "bench.h"
#include "floors.h"

#ifdef HAVE_GSL
#    include <gsl/gsl_odeiv2.h>
#    include <gsl/gsl_version.h>
#endif
#ifdef HAVE_SUNDIALS
#    include "peer_sundials.h"
#    include <arkode/arkode_erkstep.h>
#endif

enum { STEP, ERROR, DENSE, SUM };

typedef struct problem {
    const char *method;
    int what;
    ptrdiff_t n;
} problem;

typedef struct setup {
    ptrdiff_t n;
    const rk_table *T;
    floor_rk *loops;
    double *y, *k, *z, *err, h, weight[16], scaled[16], sum[4]; /* 4 of 0.2.0 */
    volatile double sink;
} setup;

static void prepare(setup *s, const problem *p)
{
    ptrdiff_t i;
    memset(s, 0, sizeof *s);
    s->n = p->n;
    s->h = 1e-7; /* y stays what it is, however many steps */
    s->T = rk_find(p->method);
    s->y = bench_memory((size_t)(20 * p->n));
    s->z = s->y + p->n;
    s->err = s->z + p->n;
    s->k = s->err + p->n;
    for (i = 0; i < 20 * p->n; i++) s->y[i] = 1 + 1e-3 * (double)(i % 97);
    rk_weights(s->T, 0.3, 0, s->weight);
    for (i = 0; i < 16; i++) s->scaled[i] = s->h * s->weight[i];
}

/* ---- typed-in loops ------------------------------------------------------------------------------------------------------ */

static void hand_step(void *user)
{
    setup *s = (setup *)user;
    s->loops(s->n, s->h, s->y, s->k, s->z);
}

static void hand_error(void *user)
{
    setup *s = (setup *)user;
    s->sink = floor_error(s->n, s->h, 1e-6, 1e-9, s->y, s->z, s->k, s->err);
}

static void hand_dense(void *user)
{
    setup *s = (setup *)user;
    floor_dense(s->n, s->h, 0.3, s->y, s->k, s->z);
}

static void hand_sum(void *user)
{
    setup *s = (setup *)user;
    floor_sum_dp5(s->n, s->scaled, s->y, s->k, s->z);
}

static void hand(const void *user)
{
    static void (*const call[])(void *) = {hand_step, hand_error, hand_dense, hand_sum};
    static const struct {
        const char *method;
        floor_rk *loops;
    } typed[] = {
        {"rk4", floor_rk4}, {"bs3", floor_bs3}, {"dp5", floor_dp5}, {"esdirk4", floor_esdirk4}, {"dop853", floor_dop853}};
    const problem *p = (const problem *)user;
    setup s;
    size_t i;
    prepare(&s, p);
    for (i = 0; i < sizeof typed / sizeof *typed; i++)
        if (strcmp(typed[i].method, p->method) == 0) s.loops = typed[i].loops;
    bench_laps("loops, -O3 -march=native", call[p->what], &s);
}

/* ---- rk.h -------------------------------------------------------------------------------------------------------------- */

static void our_stages(setup *s, int evaluate)
{
    int i;
    for (i = 1; i < s->T->stages; i++) {
        rk_stage(s->T, i, s->h, s->n, s->y, s->k, s->n, s->z);
        if (evaluate) floor_decay(s->n, s->z, s->k + i * s->n);
    }
}

static void our_step(void *user) /* first same as last: z of the last stage is the new y */
{
    our_stages((setup *)user, 1);
}

static void our_sums(void *user)
{
    our_stages((setup *)user, 0);
}

static void our_step_and_finish(void *user)
{
    setup *s = (setup *)user;
    our_stages(s, 1);
    rk_finish(s->T, s->h, s->n, s->y, s->k, s->n, s->z, NULL);
}

static void our_error(void *user)
{
    setup *s = (setup *)user;
    memset(s->sum, 0, sizeof s->sum);
    rk_finish(s->T, s->h, s->n, s->y, s->k, s->n, NULL, s->err);
    rk_norm(1e-6, 1e-9, NULL, s->n, s->err, s->y, s->z, s->sum);
    s->sink = rk_rms(s->sum);
}

static void our_dense(void *user)
{
    setup *s = (setup *)user;
    const rk_step done = {s->T, s->h, s->n, s->y, s->k, s->n};
    rk_dense(&done, 0.3, 0, s->z);
}

static void our_sum(void *user)
{
    setup *s = (setup *)user;
    rk_combine(s->h, s->T->stages, s->weight, s->n, s->y, s->k, s->n, s->z);
}

static void ours(const void *user)
{
    const problem *p = (const problem *)user;
    const int same = strcmp(p->method, "dp5") == 0 || strcmp(p->method, "bs3") == 0;
    void (*call)(void *) = same ? our_step : our_step_and_finish;
    setup s;
    prepare(&s, p);
    if (strcmp(p->method, "esdirk4") == 0) call = our_sums;
    if (p->what == ERROR) call = our_error;
    if (p->what == DENSE) call = our_dense;
    if (p->what == SUM) call = our_sum;
    bench_laps("rk.h", call, &s);
}

/* ---- peers -------------------------------------------------------------------------------------------------------------- */

#ifdef HAVE_GSL
typedef struct gsl_setup {
    setup own;
    gsl_odeiv2_step *step;
    gsl_odeiv2_system system;
} gsl_setup;

static int gsl_decay(double t, const double *y, double *f, void *user)
{
    (void)t;
    floor_decay(((setup *)user)->n, y, f);
    return 0;
}

static void gsl_step(void *user)
{
    gsl_setup *g = (gsl_setup *)user;
    gsl_odeiv2_step_apply(g->step, 0, g->own.h, g->own.z, g->own.err, g->own.k, g->own.k + g->own.n, &g->system);
}

static void gsl(const void *user)
{
    const problem *p = (const problem *)user;
    const gsl_odeiv2_step_type *type = strcmp(p->method, "dp5") == 0 ? gsl_odeiv2_step_rkf45 : gsl_odeiv2_step_rk8pd;
    gsl_setup g;
    if (p->what != STEP || (strcmp(p->method, "dp5") != 0 && strcmp(p->method, "dop853") != 0)) exit(0);
    prepare(&g.own, p);
    memset(&g.system, 0, sizeof g.system);
    g.system.function = gsl_decay;
    g.system.dimension = (size_t)p->n;
    g.system.params = &g.own;
    g.step = gsl_odeiv2_step_alloc(type, (size_t)p->n);
    bench_laps("GSL " GSL_VERSION ", as its package was compiled", gsl_step, &g);
}
#endif

#ifdef HAVE_SUNDIALS
typedef struct ark_setup {
    ptrdiff_t n;
    void *ark;
    N_Vector y;
    sunrealtype t;
} ark_setup;

static int ark_decay(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    (void)t;
    floor_decay(((ark_setup *)user)->n, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    return 0;
}

static void ark_step(void *user)
{
    ark_setup *a = (ark_setup *)user;
    ERKStepEvolve(a->ark, 1e9, a->y, &a->t, ARK_ONE_STEP);
}

static void arkode(const void *user)
{
    const problem *p = (const problem *)user;
    const int bs3 = strcmp(p->method, "bs3") == 0;
    SUNContext context;
    ark_setup a;
    if (p->what != STEP || (!bs3 && strcmp(p->method, "dp5") != 0)) exit(0);
    SUNContext_Create(NULL, &context);
    a.n = p->n;
    a.y = N_VNew_Serial((sunindextype)p->n, context);
    N_VConst(1, a.y);
    a.ark = ERKStepCreate(ark_decay, 0, a.y, context);
    ERKStepSetUserData(a.ark, &a);
    ERKStepSetTableNum(a.ark, bs3 ? ARKODE_BOGACKI_SHAMPINE_4_2_3 : ARKODE_DORMAND_PRINCE_7_4_5);
    ERKStepSetFixedStep(a.ark, 1e-7);
    ERKStepSetMaxNumSteps(a.ark, -1);
    bench_laps(sundials_name("ARKODE", context), ark_step, &a);
}
#endif

/* ---- the race ------------------------------------------------------------------------------------------------------------ */

enum { HAND, OURS, OLD, ODEINT, GSL, ARKODE, SCIPY, COUNT };
static char odeint[400], scipy[400];
static contender all[COUNT] = {{"typed-in loops", hand, NULL, ""},
                                     {"rk.h", ours, NULL, ""},
                                     {"the other rk.h", NULL, "exit 1", ""},
                                     {"odeint", NULL, odeint, "libboost-dev"},
#ifdef HAVE_GSL
                                     {"GSL", gsl, NULL, "libgsl-dev"},
#else
                                     {"GSL", NULL, "exit 1", "libgsl-dev"},
#endif
#ifdef HAVE_SUNDIALS
                                     {"ARKODE", arkode, NULL, "libsundials-dev"},
#else
                                     {"ARKODE", NULL, "exit 1", "libsundials-dev"},
#endif
                                     {"SciPy", NULL, scipy, "python3-scipy"}};

/* Goals as ratios to the typed-in loops, to odeint, and to GSL; 0: none. */
static const struct {
    problem p;
    double hand, odeint, gsl;
} table[] = {{{"dp5", STEP, 1}, 0, 1, 1},
             {{"dp5", STEP, 3}, 0, 1.5, 1},
             {{"dp5", STEP, 10}, 0, 1, 1},
             {{"dp5", STEP, 100}, 1.1, 0, 1},
             {{"dp5", STEP, 1000}, 1.1, 0, 1},
             {{"dp5", STEP, 100000}, 1.1, 0, 1},
             {{"dp5", STEP, 1000000}, 1.1, 0, 1},
             {{"rk4", STEP, 1}, 0, 1.5, 0},
             {{"rk4", STEP, 10}, 0, 1.2, 0},
             {{"rk4", STEP, 1000}, 1.1, 0, 0},
             {{"bs3", STEP, 1}, 0, 0, 0},
             {{"bs3", STEP, 10}, 0, 0, 0},
             {{"bs3", STEP, 1000}, 1.1, 0, 0},
             {{"esdirk4", STEP, 1}, 0, 0, 0},
             {{"esdirk4", STEP, 10}, 0, 0, 0},
             {{"esdirk4", STEP, 1000}, 1.1, 0, 0},
             {{"dop853", STEP, 1}, 0, 1.5, 1},
             {{"dop853", STEP, 10}, 0, 1.2, 1},
             {{"dop853", STEP, 1000}, 1.1, 0, 1},
             {{"dp5", ERROR, 1}, 1.3, 0, 0},
             {{"dp5", ERROR, 10}, 1.3, 0, 0},
             {{"dp5", ERROR, 1000}, 1.3, 0, 0},
             {{"dp5", DENSE, 1}, 1.3, 0, 0},
             {{"dp5", DENSE, 10}, 1.3, 0, 0},
             {{"dp5", DENSE, 1000}, 1.3, 0, 0},
             {{"dp5", SUM, 1}, 1.3, 0, 0},
             {{"dp5", SUM, 10}, 1.3, 0, 0},
             {{"dp5", SUM, 1000}, 1.3, 0, 0}};
enum { CASES = sizeof table / sizeof *table };

static const char *name_of(const problem *p)
{
    static const char *const word[] = {"step", "error and norm", "dense value", "dense, weights known"};
    static char name[60];
    snprintf(name, sizeof name, "%s %s", p->method, word[p->what]);
    return name;
}

static void goal(const race *r, const problem *p, int reference, double limit)
{
    char key[100];
    if (!(limit > 0) || !r->here[reference]) return;
    snprintf(key, sizeof key, "rk %s, n = %ld, / %s", name_of(p), (long)p->n, all[reference].name);
    bench_goal(key, bench_ratio(r, OURS, reference, 0.5), limit);
}

static void print_row(const race *r, const problem *p)
{
    char key[100];
    int k;
    printf("%-24s %8ld %9.4g | %9.4g %6.2f (%5.2f %5.2f)", name_of(p), (long)p->n, 1e6 * bench_median(r, HAND), 1e6 * bench_median(r, OURS),
           bench_ratio(r, OURS, HAND, 0.5), bench_ratio(r, OURS, HAND, 0.25), bench_ratio(r, OURS, HAND, 0.75));
    for (k = 2; k < COUNT; k++)
        if (r->here[k]) printf(" | %6.2f", bench_ratio(r, k, HAND, 0.5));
        else printf(" | %6s", "-");
    printf("\n");
    for (k = 0; k < COUNT; k++)
        if (r->here[k]) {
            snprintf(key, sizeof key, "rk %s %ld %s", name_of(p), (long)p->n, all[k].name);
            bench_note("rows", key, 1e6 * bench_median(r, k), bench_ratio(r, k, HAND, 0.5));
        }
}

int main(int argc, char **argv) /* with the number of a problem: a contender */
{
    const char *bin = getenv("BENCH_BIN");
    static race r, names;
    char row[20];
    double n[2] = {1e5, 1e6}, t[2] = {1, 1}, f[2] = {1, 1};
    int i, k;
    if (argc > 1) ours(&table[atoi(argv[1])].p);
    printf("\nrk.h: microseconds, ratios to typed-in loops of the same rounds (quartiles)\n");
    printf("%-24s %8s %9s | %-30s | %6s | %6s | %6s | %6s | %6s\n", "", "n", "loops us", "rk.h", "other", "odeint", "GSL", "ARKODE", "SciPy");
    for (i = 0; i < CASES; i++) {
        const problem *p = &table[i].p;
        const int step = p->what == STEP, rounds = p->n >= 100000 ? 9 : 15;
        snprintf(odeint, sizeof odeint, "exec '%s/peer_odeint' %s %ld", bin ? bin : "build", step ? p->method : "-", (long)p->n);
        snprintf(row, sizeof row, "%d", i);
        bench_versions(all + OURS, all + OLD, "rk", row);
        snprintf(scipy, sizeof scipy, "set rk %ld; %s", (long)p->n, bench_scipy);
        bench_race(&r, all, strcmp(p->method, "dp5") == 0 && step && p->n < 1000000 ? COUNT : SCIPY, p, 2, rounds);
        if (i == 0) names = r;
        print_row(&r, p);
        goal(&r, p, HAND, table[i].hand);
        goal(&r, p, ODEINT, table[i].odeint);
        goal(&r, p, GSL, table[i].gsl);
        goal(&r, p, OLD, 1.05);
        for (k = 0; k < 2; k++)
            if (step && strcmp(p->method, "dp5") == 0 && (double)p->n == n[k]) {
                t[k] = bench_median(&r, OURS);
                f[k] = bench_median(&r, HAND);
            }
    }
    bench_names("rk", &names, all, COUNT);
    printf("  GSL: rkf45 beside dp5, rk8pd (13 stages) beside dop853, error estimate included; odeint: Fehlberg 7(8) beside dop853\n");
    printf("growth, exponent in n, dp5, 1e5 to 1e6: %.2f, typed-in loops %.2f, theory 1\n", bench_exponent(2, n, t), bench_exponent(2, n, f));
    bench_goal("growth of the dp5 step in n, 1e5 to 1e6", bench_exponent(2, n, t), (bench_exponent(2, n, f) > 1 ? bench_exponent(2, n, f) : 1) + 0.15);
    return 0;
}
