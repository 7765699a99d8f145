/* SPDX-License-Identifier: MIT

   study_one_number.c - fixed set-ups for a problem of examples/adaptive.c, and the best of them for each accuracy: table,
   windows, sub-steps of both sides, degree, what is exchanged, tolerance of the iteration; the least work under a
   restriction; and the least work of every table, degree, exchange and tolerance, from which the card is chosen.  make
   onenumber SEARCH=all writes them to tests/study/one-number.txt; make onenumber compares the run that takes the accuracy
   alone with them.
   study_one_number PROBLEM */
#include "study.h"
#include <float.h>

#define WF_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "rk.h"
#include "waveform.h"
#include "examples/adaptive_wave.h"
#include "examples/adaptive_problems.h"

enum { ACCURACIES = 9, EXCHANGES = 4, MOST = 400000, GRID = 4096, LONGEST = 1000 }; /* samples in a window */
enum { ENDS, HISTORY, SLOPES, DENSE };
static const char *const exchange_name[] = {"step ends", "step ends + history", "step ends + slopes",
                                            "3 within a step"};
static const char *const exchange_word[] = {"ends", "older", "slopes", "dense"}; /* the same, short */

/* What is searched: times of the answer, evaluations at most, sub-steps of both sides, and powers of two between them. */
typedef struct extent {
    int grid, steps;
    long work;
    int ratio[2]; /* the first side takes 2^-ratio times the sub-steps of the second, every other power */
} extent;

static extent extent_of(const problem *p)
{
    static const extent even = {GRID, 64, 20000, {0, 0}}, stiff = {GRID, 64, 20000, {-2, 4}};
    static const extent thousand_to_one = {32 * GRID, 1, 300000, {-12, -4}};
    if (strcmp(p->name, "rates") == 0) return thousand_to_one;
    return p->side[0].solve || p->side[1].solve ? stiff : even;
}

static extent bounds;
enum { TABLES = 4, TOLERANCES = 6 };
static const char *const explicit_tables[TABLES] = {"rk4", "dp5", "verner6", "dop853"};
static const char *const stiff_tables[TABLES] = {"sdirk2", "esdirk3", "esdirk5", "esdirk5"}; /* beside the explicit ones */
static const double tols[TOLERANCES] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10};

typedef struct set_up {
    double work, error, tol;
    int windows, steps[2], degree, exchange, table;
    const rk_table *T[2];
} set_up;

static set_up *tried;
static int count;
static long evaluations;

/* ---- the answer on a grid of every segment between events ---- */

static double *answer[2]; /* [segment][bounds.grid + 1][numbers written] */
static double largest[2];
static int segments;

/* Where segment s ends, and the time k steps of the grid into it. */
static double segment_end(const problem *p, int s)
{
    return s < segments - 1 ? p->event[s] : p->end;
}

static double grid_time(const problem *p, int s, double k)
{
    const double a = s > 0 ? p->event[s - 1] : 0, b = segment_end(p, s);
    return k == bounds.grid ? b : a + (b - a) * k / bounds.grid;
}

/* Events that nobody tells are told to the fixed set-ups all the same: those of the reference. */
static problem with_events(problem p)
{
    reference r = reference_start(&p);
    const int steps = 64;
    int k, known = 0;
    phase = 0;
    for (k = 1; k <= steps && p.trigger; k++) {
        reference_to(&r, p.end * k / steps);
        if (r.phase > known) p.event[known++] = r.event;
    }
    p.trigger = NULL;
    return p;
}

static double size_of(const double *v, int n)
{
    double most = 0;
    int i;
    for (i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

static double *answer_at(int side, int segment, int k, int width)
{
    return answer[side] + (segment * (bounds.grid + 1) + k) * width;
}

static void answers(const problem *p)
{
    reference r = reference_start(p);
    double *to[2];
    int s, k, i;
    for (segments = 1; p->event[segments - 1] > 0; segments++) {}
    for (i = 0; i < 2; i++)
        answer[i] = study_vector((ptrdiff_t)segments * (bounds.grid + 1) * p->side[i].width);
    for (s = 0, phase = 0; s < segments; s++, phase++)
        for (k = 0; k <= bounds.grid; k++) {
            const double t = grid_time(p, s, k);
            for (i = 0; i < 2; i++) to[i] = answer_at(i, s, k, p->side[i].width);
            if (k > 0 && !p->exact) reference_to(&r, t);
            if (!p->exact) reference_output(p, r.y, to[0], to[1]);
            for (i = 0; i < 2; i++) {
                if (p->exact) to[i][0] = p->exact(i, t);
                largest[i] = fmax(largest[i], size_of(to[i], p->side[i].width));
            }
        }
}

/* ---- the least work known for an error, in steps of a quarter of a decade ---- */

enum { BINS = 64, PER_DECADE = 4, SLACK = 10 };
static double least_work[BINS];

static int bin_of(double error)
{
    const double place = floor(-PER_DECADE * log10(fmax(error, 1e-16)));
    return (int)fmin(BINS - 1, fmax(0, place));
}

/* An error can only grow: a set-up that is that wrong already and will cost more than SLACK times the least work known
   for it is not worth finishing. */
static int pointless(double error, double work)
{
    return error > 0 && work > SLACK * least_work[bin_of(error)];
}

static void remember(double error, double work)
{
    int k;
    for (k = 0; k <= bin_of(error); k++) least_work[k] = fmin(least_work[k], work);
}

/* ---- one set-up ---- */

typedef struct fixed_side {
    const model *m;
    double y0[DEEPEST], y[DEEPEST];
    wave out;
} fixed_side;

static fixed_side side_[2];

static void evaluate(const fixed_side *s, double t, double g, const double *z, const wave *in, double *k)
{
    double w[WIDEST];
    wave_read(in, t, w);
    evaluations++;
    if (g != 0) model_solve(s->m, t, g, z, w, k);
    else model_slope(s->m, t, z, w, k);
}

static void write_output(fixed_side *s, double t, const double *y, const wave *in, const double *slope)
{
    double w[WIDEST], out[DEEPEST];
    wave_read(in, t, w);
    model_output(s->m, y, w, out);
    wave_write(&s->out, t, out, slope);
}

/* Position and velocity: the slope of what is written is known without an evaluation. */
static int moves(const model *m)
{
    return m->n == 2 && m->width == 1;
}

/* The slopes at the end of a step, to the first stage of the next one, if the table has them or the exchange wants them;
   those of what is written to z.  Returns whether they are there. */
static int slopes_at_end(fixed_side *s, const rk_table *T, double t, const wave *in, double *k, double *z)
{
    const int n = s->m->n;
    if (s->out.slopes && moves(s->m)) z[0] = s->y[1];
    if (rk_is(T, RK_FSAL)) memcpy(k, k + (T->stages - 1) * n, (size_t)n * sizeof(double));
    else if (s->out.slopes && !moves(s->m)) evaluate(s, t, 0, s->y, in, k);
    else return 0;
    if (s->out.slopes && !moves(s->m)) memcpy(z, k, (size_t)s->m->width * sizeof(double));
    return 1;
}

/* A window of `steps` equal steps. */
static void sweep(fixed_side *s, const rk_table *T, const double t[2], int steps, int exchange, const wave *in)
{
    const int n = s->m->n, m = T->stages + T->extra, used = exchange == DENSE ? m : T->stages;
    const double h = (t[1] - t[0]) / steps;
    double k[64 * DEEPEST], z[DEEPEST], now;
    const rk_step step = {T, h, n, s->y, k, n};
    int i, j, q, known = 0;
    memcpy(s->y, s->y0, sizeof s->y);
    wf_rollback(s->out.w);
    for (j = 0; j < steps; j++) {
        now = t[0] + j * h;
        for (i = known; i < used; i++) {
            rk_stage(T, i, h, n, s->y, k, n, z);
            evaluate(s, fmin(now + T->c[i] * h, t[1]), h * T->A[i * m + i], z, in, k + i * n);
        }
        for (q = 1; exchange == DENSE && q <= 3; q++) {
            rk_dense(&step, q / 4., 0, z);
            write_output(s, now + h * q / 4, z, in, NULL);
        }
        rk_finish(T, h, n, s->y, k, n, s->y, NULL);
        now = j + 1 < steps ? t[0] + (j + 1) * h : t[1];
        known = slopes_at_end(s, T, now, in, k, z);
        write_output(s, now, s->y, in, z);
    }
}

static double worst_error(int segment, int window, const set_up *a)
{
    double worst = 0, e;
    int i, j, c, per;
    for (i = 0; i < 2; i++) {
        const wave *w = &side_[i].out;
        per = (wf_columns(w->w) - 1 - wf_start(w->w)) / a->steps[i]; /* columns of a step */
        for (j = 1; j <= a->steps[i]; j++) {
            const int k = (window * a->steps[i] + j) * (bounds.grid / (a->windows * a->steps[i]));
            const double *truth = answer_at(i, segment, k, w->width), *value = wf_column(w->w, wf_start(w->w) + j * per);
            for (c = 0; c < w->width; c++) {
                e = fabs(value[c] - truth[c]) / largest[i];
                if (!(e <= worst)) worst = e; /* NaN, too */
            }
        }
    }
    return worst;
}

static void restart(const problem *p, const set_up *a, double t, int fresh)
{
    double out[2][DEEPEST], slope[DEEPEST];
    int i;
    for (i = 0; i < 2; i++) {
        fixed_side *s = &side_[i];
        if (fresh) memcpy(s->y0, p->side[i].y0, sizeof s->y0);
        s->m = &p->side[i];
        s->out.slopes = a->exchange == SLOPES;
        s->out.size = 1;
        s->out.most = a->degree;
        wave_clear(&s->out);
    }
    model_output(side_[1].m, side_[1].y0, NULL, out[1]);
    model_output(side_[0].m, side_[0].y0, out[1], out[0]);
    for (i = 0; i < 2; i++) {
        model_slope(side_[i].m, t, side_[i].y0, out[1 - i], slope); /* what is written is the state's first numbers */
        wave_write(&side_[i].out, t, out[i], slope);
    }
}

/* What B writes stays as it is: the first guess of a window, its slopes left out. */
static void constant_guess(wave *w, double end)
{
    const size_t bytes = (size_t)w->width * sizeof(double);
    double *start = wf_column(w->w, wf_start(w->w)), *slope = start + w->width, kept[WIDEST], zero[WIDEST] = {0};
    wf_rollback(w->w);
    wave_write(w, end, start, zero);
    if (w->slopes) memcpy(kept, slope, bytes), memcpy(slope, zero, bytes);
    wave_fit(w, 1 + w->slopes, 0);
    if (w->slopes) memcpy(slope, kept, bytes);
}

/* The largest change at the window end since the sweep before; HUGE_VAL in the first one. */
static double change_at_end(double before[2][WIDEST], int first)
{
    double most = first ? HUGE_VAL : 0;
    int i, c;
    for (i = 0; i < 2; i++) {
        const wave *w = &side_[i].out;
        const double *now = wf_column(w->w, wf_columns(w->w) - 1 - w->slopes);
        for (c = 0; c < w->width && !first; c++) most = fmax(most, fabs(now[c] - before[i][c]) / largest[i]);
        memcpy(before[i], now, (size_t)w->width * sizeof(double));
    }
    return most;
}

/* Sweeps until the change is small, at most 60; returns how many. */
static int iterate(const set_up *a, const double t[2], int history)
{
    wave *wa = &side_[0].out, *wb = &side_[1].out;
    double before[2][WIDEST];
    int k;
    constant_guess(wb, t[1]);
    for (k = 0; k < 60; k++) {
        sweep(&side_[0], a->T[0], t, a->steps[0], a->exchange, wb);
        wave_fit(wa, a->degree, history);
        sweep(&side_[1], a->T[1], t, a->steps[1], a->exchange, wa);
        wave_fit(wb, a->degree, history);
        if (change_at_end(before, k == 0) <= a->tol || evaluations > bounds.work) return k;
        if (!(size_of(before[0], wa->width) + size_of(before[1], wb->width) < 1e6)) return k;
    }
    return k;
}

static void couple(const problem *p, set_up *a)
{
    const int history = a->exchange == HISTORY ? a->degree - 1 : 0;
    double t[2], worst, done;
    int segment, window, k, i;
    a->error = 0;
    evaluations = 0;
    for (segment = 0, phase = 0; segment < segments && a->error < 1; segment++, phase++) {
        restart(p, a, grid_time(p, segment, 0), segment == 0);
        for (window = 0; window < a->windows && a->error < 1; window++) {
            t[0] = grid_time(p, segment, (double)window * bounds.grid / a->windows);
            t[1] = grid_time(p, segment, (window + 1.) * bounds.grid / a->windows);
            k = iterate(a, t, history);
            worst = worst_error(segment, window, a);
            if (!(worst <= a->error)) a->error = worst;
            if (!(a->error < 1) || evaluations > bounds.work || k == 60) a->error = HUGE_VAL;
            done = (segment * a->windows + window + 1.) / (segments * a->windows);
            if (pointless(a->error, (double)evaluations / done)) a->error = HUGE_VAL;
            for (i = 0; i < 2; i++) {
                memcpy(side_[i].y0, side_[i].y, sizeof side_[i].y);
                wf_advance(side_[i].out.w, history);
            }
        }
    }
    a->work = (double)evaluations;
}

/* ---- all of them ---- */

static int possible(const problem *p, const set_up *a)
{
    int i, samples;
    for (i = 0; i < 2; i++) {
        samples = (a->exchange == SLOPES ? 2 : a->exchange == DENSE ? 4 : 1) * a->steps[i] + (a->exchange == SLOPES);
        if (a->exchange == SLOPES && (p->side[i].solve || a->degree < 2)) return 0;
        if (a->exchange == HISTORY ? a->degree == 1 : a->degree > samples) return 0;
        if (a->windows * a->steps[i] > bounds.grid || samples > LONGEST) return 0;
    }
    return 2. * segments * a->windows * (a->steps[0] * a->T[0]->stages + a->steps[1] * a->T[1]->stages) <=
           (double)bounds.work;
}

/* From loose to tight, also where that does not help: what a tight tolerance costs is asked for. */
static void tolerances(const problem *p, set_up a)
{
    int q;
    for (q = 0; q < TOLERANCES; q++) {
        a.tol = tols[q];
        couple(p, &a);
        if (!(a.error < 1) || count == MOST) return;
        tried[count++] = a;
        remember(a.error, a.work);
    }
}

static void search(const problem *p)
{
    static const int degrees[] = {1, 3, 5, 7, 9};
    size_t d;
    int table, windows, steps, ratio, exchange, k;
    count = 0;
    for (k = 0; k < BINS; k++) least_work[k] = HUGE_VAL;
    for (table = 0; table < TABLES; table++)
        for (windows = 1; windows <= bounds.grid; windows *= 2) {
            fprintf(stderr, "\r\033[K  %s, %s, %d windows", p->name, explicit_tables[table], windows);
            for (steps = 1; steps <= bounds.steps; steps *= 2)
                for (ratio = bounds.ratio[0]; ratio <= bounds.ratio[1]; ratio += 2)
                    for (exchange = 0; exchange < EXCHANGES; exchange++)
                        for (d = 0; d < sizeof degrees / sizeof *degrees; d++) {
                            set_up a;
                            memset(&a, 0, sizeof a);
                            a.windows = windows, a.degree = degrees[d], a.exchange = exchange, a.table = table;
                            a.steps[0] = ratio < 0 ? steps << -ratio : steps;
                            a.steps[1] = ratio > 0 ? steps << ratio : steps;
                            a.T[0] = rk_find((p->side[0].solve ? stiff_tables : explicit_tables)[table]);
                            a.T[1] = rk_find((p->side[1].solve ? stiff_tables : explicit_tables)[table]);
                            if (possible(p, &a)) tolerances(p, a);
                        }
        }
    study_progress("");
}

/* ---- what is kept of it: the cheapest for each accuracy; under each restriction; of each class ---- */

static double accuracy_of(int q)
{
    return pow(10, -2 - q);
}

/* What a restriction allows: from .. to; the tolerance besides at most so many times the accuracy that is wanted. */
typedef struct restriction {
    const char *name;
    int degree[2], exchanges, tables; /* bits of the exchanges and of the tables */
    int windows, steps[2];
    double tol[2], tol_over_wanted;
} restriction;

#define ANY_DEGREE {1, WF_MAX_DEGREE}
#define ANY_EXCHANGE ((1 << EXCHANGES) - 1)
#define ANY_TABLE ((1 << TABLES) - 1)
#define ANY_STEPS {1, MOST}
#define ANY_TOL {0, 1}, HUGE_VAL
static const restriction restrictions[] = {
    {"nothing", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"degree 1", {1, 1}, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"degree 3", {3, 3}, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"degree 1 or 3", {1, 3}, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"degree 5 or more", {5, WF_MAX_DEGREE}, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"step ends alone", ANY_DEGREE, 1 << ENDS, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"step ends and older samples", ANY_DEGREE, 1 << ENDS | 1 << HISTORY, ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"no slopes", ANY_DEGREE, ANY_EXCHANGE & ~(1 << SLOPES), ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"no values within a step", ANY_DEGREE, ANY_EXCHANGE & ~(1 << DENSE), ANY_TABLE, MOST, ANY_STEPS, ANY_TOL},
    {"rk4; stiff sdirk2", ANY_DEGREE, ANY_EXCHANGE, 1 << 0, MOST, ANY_STEPS, ANY_TOL},
    {"dp5; stiff esdirk3", ANY_DEGREE, ANY_EXCHANGE, 1 << 1, MOST, ANY_STEPS, ANY_TOL},
    {"verner6; stiff esdirk5", ANY_DEGREE, ANY_EXCHANGE, 1 << 2, MOST, ANY_STEPS, ANY_TOL},
    {"dop853; stiff esdirk5", ANY_DEGREE, ANY_EXCHANGE, 1 << 3, MOST, ANY_STEPS, ANY_TOL},
    {"tolerance 1e-3 or less", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, {0, 1.001e-3}, HUGE_VAL},
    {"tolerance 1e-2", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, {1e-2, 1}, HUGE_VAL},
    {"tolerance at most the error", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, ANY_STEPS, {0, 1}, 1},
    {"one window", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, 1, ANY_STEPS, ANY_TOL},
    {"one step in a window", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, {1, 1}, ANY_TOL},
    {"8 steps in a window or more", ANY_DEGREE, ANY_EXCHANGE, ANY_TABLE, MOST, {8, MOST}, ANY_TOL}};
enum { RESTRICTIONS = (int)(sizeof restrictions / sizeof *restrictions) };

static int allows(const restriction *r, const set_up *a, double wanted)
{
    int i;
    for (i = 0; i < 2; i++)
        if (a->steps[i] < r->steps[0] || a->steps[i] > r->steps[1]) return 0;
    if (a->degree < r->degree[0] || a->degree > r->degree[1]) return 0;
    if (!(r->exchanges >> a->exchange & 1) || !(r->tables >> a->table & 1)) return 0;
    if (a->windows > r->windows) return 0;
    if (a->tol < r->tol[0] || a->tol > r->tol[1]) return 0;
    return a->tol <= 1.001 * r->tol_over_wanted * wanted; /* 1.001: powers of ten are rounded */
}

/* The cheapest that reaches accuracy q and that is allowed; NULL: none of those tried. */
static const set_up *cheapest(int q, const restriction *r)
{
    const set_up *best = NULL;
    int i;
    for (i = 0; i < count; i++) {
        if (!(tried[i].error <= accuracy_of(q)) || !allows(r, &tried[i], accuracy_of(q))) continue;
        if (!best || tried[i].work < best->work) best = &tried[i];
    }
    return best;
}

static void print_cheapest(const char *name)
{
    int q;
    for (q = 0; q < ACCURACIES; q++) {
        const set_up *a = cheapest(q, &restrictions[0]);
        if (!a) continue;
        printf("best,%s,%.0e,%.0f,%.3g,%s/%s,%d,%d/%d,%d,%s,%.0e\n", name, accuracy_of(q), a->work, a->error,
               a->T[0]->name, a->T[1]->name, a->windows * segments, a->steps[0], a->steps[1], a->degree,
               exchange_name[a->exchange], a->tol);
    }
}

static void print_work(double work)
{
    if (work < HUGE_VAL) printf(",%.0f", work);
    else printf(",-");
}

static void print_restricted(const char *name)
{
    int r, q;
    for (r = 1; r < RESTRICTIONS; r++) {
        printf("under,%s,%s", name, restrictions[r].name);
        for (q = 0; q < ACCURACIES; q++) {
            const set_up *a = cheapest(q, &restrictions[r]);
            print_work(a ? a->work : HUGE_VAL);
        }
        printf("\n");
    }
}

/* Of every table, degree, exchange and tolerance the least work for each accuracy, where it is at most twice the least. */
static void print_classes(const char *name)
{
    static double least[TABLES][WF_MAX_DEGREE + 1][EXCHANGES][TOLERANCES][ACCURACIES];
    double best[ACCURACIES];
    int table, degree, exchange, tol, q, i, kept;
    double *w;
    for (q = 0; q < ACCURACIES; q++) {
        const set_up *a = cheapest(q, &restrictions[0]);
        best[q] = a ? a->work : 0;
    }
    for (w = &least[0][0][0][0][0], i = 0; i < (int)(sizeof least / sizeof *w); i++) w[i] = HUGE_VAL;
    for (i = 0; i < count; i++) {
        const set_up *a = &tried[i];
        for (tol = 0; tols[tol] != a->tol;) tol++;
        for (q = 0; q < ACCURACIES && a->error <= accuracy_of(q); q++) {
            w = &least[a->table][a->degree][a->exchange][tol][q];
            *w = fmin(*w, a->work);
        }
    }
    for (table = 0; table < TABLES; table++)
        for (degree = 1; degree <= WF_MAX_DEGREE; degree++)
            for (exchange = 0; exchange < EXCHANGES; exchange++)
                for (tol = 0; tol < TOLERANCES; tol++) {
                    w = least[table][degree][exchange][tol];
                    for (kept = ACCURACIES; kept > 0 && !(w[kept - 1] <= 2 * best[kept - 1]);) kept--;
                    if (kept == 0) continue;
                    printf("class,%s,%s,%d,%s,%.0e", name, explicit_tables[table], degree, exchange_word[exchange], tols[tol]);
                    for (q = 0; q < kept; q++) print_work(w[q] <= 2 * best[q] ? w[q] : HUGE_VAL);
                    printf("\n");
                }
}

int main(int argc, char **argv)
{
    static problem told;
    char all[200] = "";
    int i;
    for (i = 0; i < PROBLEMS; i++) snprintf(all + strlen(all), sizeof all - strlen(all), " %s", problems[i].name);
    if (argc != 2) {
        fprintf(stderr, "usage: study_one_number PROBLEM, one of%s\n", all);
        return 2;
    }
    tried = (set_up *)scene_memory(MOST * sizeof *tried);
    told = with_events(problem_named(argv[1], all));
    for (i = 0; i < 2; i++) side_[i].out = wave_make(told.side[i].width, 1, 1, WF_MAX_DEGREE);
    bounds = extent_of(&told);
    answers(&told);
    search(&told);
    printf("tried,%s,%d,%ld\n", told.name, count, bounds.work);
    print_cheapest(told.name);
    print_restricted(told.name);
    print_classes(told.name);
    free(tried);
    return 0;
}
