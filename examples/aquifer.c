/* SPDX-License-Identifier: MIT

   aquifer.c - a host's own loop, replaced: ground water under a field with drains, as such codes iterate it

   A square of 24 by 24 cells between two rivers, water table h above an impervious base: SY dh/dt = div(K h grad h) + rain -
   drains - a well; a drain takes C (h - level) where h is above its level.  Implicit Euler, five stress periods of six steps.
   The code linearises by thickness and drains of the last heads x and solves for new heads H(x), by a band Cholesky
   factorisation: that is Picard's iteration, and the loop around it has a largest number of trials, after which it goes on
   with what it has.

       own      x = x + omega (H(x) - x): plain for omega 1, else damped
       aitken   the same with the factor of Aitken, by iqn.h
       iqn      iqn.h, with the host's omega; a step that was not converged is forgotten (--after discard) or kept (commit)

   Where water is thin over its base plain Picard is slow, or swings: thickness enters as the heads themselves, h_new = c/h_old.
   A patch of rock has no water.  Codes mark such cells with a huge number (--dead 1e30); in x it buries all others, because a
   pair is judged by the size of the numbers it comes from.  Give these cells 0 in x, or leave them out.

   --steady 1: rain and rivers alone; exact is Dupuit's h^2 = river^2 + rain s (length - s)/K, also on this grid. */
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "scene.h"

extern void dpbsv_(const char *uplo, const int *n, const int *kd, const int *nrhs, double *ab, const int *ldab,
                   double *b, const int *ldb, int *info);

enum { SIDE = 24, CELLS = SIDE * SIDE, LDAB = SIDE + 1, WELL = CELLS / 2 + SIDE / 2, PERIODS = 5, STEPS = 6 };
static const double K = 4, WIDTH = 100, DRAIN = 400, THIN = 0.01; /* m/day, m, m^2/day, least thickness in m */
static const double rain_of[PERIODS] = {2e-3, 5e-4, 4e-3, 0, 3e-3};

static struct {
    double storage, rain, well, river, dead; /* storage coefficient over the step; m/day; m^3/day; heads in m */
    double old[CELLS], drain[CELLS];         /* heads at the start of the step; levels of drains, 0: none */
    int rock[CELLS];
} site;

static int checked(int status)
{
    scene_check(status, iqn_message(status));
    return status;
}

/* Times the difference of heads: the flow between two places whose heads are a and b. */
static double conductance(double a, double b)
{
    return K * (fmax(a, THIN) + fmax(b, THIN)) / 2;
}

static int drains_in(int c, double head)
{
    return site.drain[c] > 0 && head > site.drain[c];
}

/* The equation of cell c: ab has the lower triangle, column by column, b the right-hand side. */
static void assemble(int c, const double *x, double ab[CELLS][LDAB], double *b)
{
    const int column = c % SIDE, neighbour[2] = {column + 1 < SIDE ? c + 1 : CELLS, c + SIDE};
    double g;
    int k;
    ab[c][0] += site.storage;
    b[c] = site.storage * site.old[c] + site.rain * WIDTH * WIDTH;
    if (c == WELL) b[c] -= site.well;
    if (column == 0 || column == SIDE - 1) {
        g = conductance(x[c], site.river);
        ab[c][0] += g;
        b[c] += g * site.river;
    }
    for (k = 0; k < 2; k++) {
        const int other = neighbour[k];
        if (other >= CELLS || site.rock[other]) continue;
        g = conductance(x[c], x[other]);
        ab[c][0] += g;
        ab[other][0] += g;
        ab[c][other - c] = -g;
    }
    if (drains_in(c, x[c])) {
        ab[c][0] += DRAIN;
        b[c] += DRAIN * site.drain[c];
    }
}

/* H: the heads hx of the linear problem with thickness and drains of the heads x. */
static void solve(const double *x, double *hx)
{
    static const int n = CELLS, kd = SIDE, ldab = LDAB, one = 1;
    static double ab[CELLS][LDAB];
    int c, info;
    memset(ab, 0, sizeof ab);
    for (c = 0; c < CELLS; c++)
        if (!site.rock[c]) {
            assemble(c, x, ab, hx);
        } else {
            ab[c][0] = 1;
            hx[c] = 0;
        }
    dpbsv_("L", &n, &kd, &one, ab[0], &ldab, hx, &n, &info);
    scene_check(-abs(info), "dpbsv");
    for (c = 0; c < CELLS; c++)
        if (site.rock[c]) hx[c] = site.dead;
}

/* What these heads lose or win of the water that comes in, in per cent. */
static double imbalance(const double *h)
{
    double in = 1e-300, out = 0;
    int c;
    for (c = 0; c < CELLS; c++) {
        const int bank = c % SIDE == 0 || c % SIDE == SIDE - 1;
        const double stored = site.storage * (h[c] - site.old[c]);
        double flow = bank ? conductance(h[c], site.river) * (site.river - h[c]) : 0;
        if (site.rock[c]) continue;
        flow -= stored;
        if (drains_in(c, h[c])) flow -= DRAIN * (h[c] - site.drain[c]);
        if (c == WELL) flow -= site.well;
        in += site.rain * WIDTH * WIDTH + fmax(flow, 0);
        out += fmax(-flow, 0);
    }
    return 100 * fabs(in - out) / in;
}

/* The largest |a - b|; NaN counts as a change. */
static double largest_change(const double *a, const double *b)
{
    double largest = 0;
    int c;
    for (c = 0; c < CELLS; c++)
        if (!(fabs(a[c] - b[c]) <= largest)) largest = fabs(a[c] - b[c]);
    return largest;
}

typedef struct loop {
    int accelerated, trials, discard, best; /* by iqn.h; evaluations in a step at most; what to do then */
    double omega, close;                    /* of the host; heads that change by less have converged */
    iqn *q;
    int evaluations, open; /* so far, and steps that were not converged */
} loop;

/* A time step: x, the old heads, becomes the new ones. */
static void step(loop *l, double *x)
{
    double hx[CELLS], best[CELLS], change = 0, least = HUGE_VAL;
    int k, c;
    memcpy(best, x, sizeof best);
    for (k = 0; k < l->trials; k++) {
        solve(x, hx);
        l->evaluations++;
        change = largest_change(hx, x);
        if (change < least) {
            least = change;
            memcpy(best, hx, sizeof best);
        }
        if (change <= l->close) break;
        if (l->accelerated) checked(iqn_step(l->q, x, hx));
        else
            for (c = 0; c < CELLS; c++) x[c] += l->omega * (hx[c] - x[c]);
    }
    memcpy(x, l->best ? best : hx, sizeof hx);
    if (!(change <= l->close)) l->open++;
    if (!(change <= l->close) && l->discard) iqn_discard(l->q);
    else iqn_commit(l->q);
}

/* Heads at the start, rock and drains; steady: neither of these. */
static void prepare(int steady, double *x)
{
    int c;
    for (c = 0; c < CELLS; c++) {
        const int row = c / SIDE, column = c % SIDE, patch = row >= 3 && row < 7 && column >= 15 && column < 20;
        x[c] = site.river + 4;
        site.rock[c] = !steady && site.dead >= 0 && patch;
        if (site.rock[c]) x[c] = site.dead;
        else if (!steady && row % 5 == 4 && column > 1) site.drain[c] = site.river + 5 + 0.05 * column;
    }
}

/* Against Dupuit. */
static double error_of(const double *x)
{
    const double length = (SIDE + 1) * WIDTH;
    double worst = 0;
    int c;
    for (c = 0; c < CELLS; c++) {
        const double s = (c % SIDE + 1) * WIDTH;
        worst = fmax(worst, fabs(x[c] - sqrt(site.river * site.river + site.rain * s * (length - s) / K)));
    }
    return worst;
}

int main(int argc, char **argv)
{
    static const char *const methods[] = {"own", "aitken", "iqn", NULL};
    static const char *const afters[] = {"commit", "discard", NULL};
    static const char *const takes[] = {"last", "best", NULL};
    scene_option o[] = {{"method", "iqn", "own, aitken or iqn"},
                        {"omega", "1", "relaxation of the own loop, and of iqn.h where it has no pair"},
                        {"trials", "400", "evaluations in a step at most"},
                        {"after", "discard", "a step that was not converged: commit, or discard its pairs"},
                        {"take", "last", "heads of such a step: last, or best: the H(x) of the least change"},
                        {"river", "8", "heads of the rivers"},
                        {"days", "30", "length of a stress period"},
                        {"dead", "0", "what the code writes into cells of rock; -1: no rock"},
                        {"columns", "20", "secant pairs at most"},
                        {"reuse", "-1", "past steps whose pairs take part; -1: the header's choice"},
                        {"steady", "0", "1: one step without end, rain and rivers alone, beside Dupuit's solution"},
                        {NULL, NULL, NULL}};
    double x[CELLS], length, worst = 0;
    int steady, columns, period, j;
    size_t bytes;
    loop l;
    memset(&l, 0, sizeof l);
    scene_parse(argc, argv, "ground water with drains: a Picard loop, and the same by iqn.h", o);
    l.accelerated = scene_choice(o, "method", methods);
    l.omega = scene_number(o, "omega", 1e-3, 2);
    l.trials = scene_integer(o, "trials", 1, 100000);
    l.discard = scene_choice(o, "after", afters);
    l.best = scene_choice(o, "take", takes);
    l.close = 1e-6;
    steady = scene_integer(o, "steady", 0, 1);
    columns = scene_integer(o, "columns", 1, CELLS);
    site.river = scene_perturbed("river", scene_number(o, "river", 0.1, 1000));
    site.dead = scene_number(o, "dead", -1, 1e100);
    length = scene_number(o, "days", 1e-3, 1e6);
    bytes = iqn_size(CELLS, columns, 1);
    checked(iqn_make(&l.q, CELLS, columns, 1, scene_memory(bytes), bytes));
    iqn_set(l.q, IQN_OMEGA, l.omega);
    iqn_set(l.q, IQN_WINDOWS, scene_integer(o, "reuse", -1, 1000));
    if (l.accelerated == 1) iqn_set(l.q, IQN_METHOD, IQN_AITKEN);
    prepare(steady, x);
    for (period = 0; period < (steady ? 1 : PERIODS); period++) {
        double days = length * 0.2 / (pow(1.2, STEPS) - 1);
        site.rain = rain_of[period];
        site.well = steady ? 0 : 250;
        for (j = 0; j < (steady ? 1 : STEPS); j++, days *= 1.2) {
            site.storage = steady ? 0 : 0.02 * WIDTH * WIDTH / days;
            memcpy(site.old, x, sizeof x);
            step(&l, x);
            worst = fmax(worst, imbalance(x));
        }
    }
    printf("evaluations %d\nunconverged %d\nimbalance %.3e\n", l.evaluations, l.open, worst);
    printf("pairs_not_stored %g\nwell_head %.10g\n", iqn_get(l.q, IQN_NZERO), x[WELL]);
    if (steady) printf("error %.3e\n", error_of(x));
    free(l.q);
    return 0;
}
