/* SPDX-License-Identifier: MIT

   study_one_number.c - examples/adaptive.c, which takes the accuracy alone, against the best of all fixed set-ups: table,
   windows, sub-steps of both sides, degree, what is exchanged, tolerance of the iteration.
   study_one_number DIRECTORY ADAPTIVE [PROBLEM...]   ADAPTIVE: the program of examples/adaptive.c */
#include "study.h"

#define WF_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "rk.h"
#include "waveform.h"
#include "examples/adaptive_wave.h"
#include "examples/adaptive_problems.h"

extern FILE *popen(const char *command, const char *type);
extern int pclose(FILE *stream);

enum { GRID = 4096, ACCURACIES = 9, EXCHANGES = 4, MOST = 400000 };
enum { ENDS, HISTORY, SLOPES, DENSE };
static const char *const exchange_name[] = {"step ends", "step ends + history", "step ends + slopes",
                                            "3 within a step"};
static const long most_work = 20000;
static const char *const explicit_tables[] = {"rk4", "dp5", "verner6", "dop853"};
static const char *const stiff_tables[] = {"sdirk2", "esdirk3", "esdirk5", "esdirk5"}; /* beside the explicit ones */

typedef struct set_up {
    double work, error, tol;
    int windows, steps[2], degree, exchange;
    const rk_table *T[2];
} set_up;

static set_up *tried;
static int count;
static long evaluations;

/* ---- the answer on a grid of every segment between events ---- */

static double *answer[2]; /* [segment][GRID + 1][width 1] */
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
    return k == GRID ? b : a + (b - a) * k / GRID;
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

static void answers(const problem *p)
{
    reference r = reference_start(p);
    int s, k, i;
    for (segments = 1; p->event[segments - 1] > 0; segments++) {}
    for (i = 0; i < 2; i++)
        answer[i] = (double *)realloc(answer[i], (size_t)segments * (GRID + 1) * sizeof(double)), largest[i] = 0;
    for (s = 0, phase = 0; s < segments; s++, phase++)
        for (k = 0; k <= GRID; k++) {
            const int at = s * (GRID + 1) + k;
            if (k > 0) reference_to(&r, grid_time(p, s, k));
            reference_output(p, r.y, &answer[0][at], &answer[1][at]);
            for (i = 0; i < 2; i++) largest[i] = fmax(largest[i], fabs(answer[i][at]));
        }
}

/* ---- the least work known for an error, in steps of a quarter of a decade ---- */

enum { BINS = 64, PER_DECADE = 4, SLACK = 4 };
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

/* A window of `steps` equal steps; the slope at its end counts as an evaluation only where the table has none. */
static void sweep(fixed_side *s, const rk_table *T, const double t[2], int steps, int exchange, const wave *in)
{
    const int n = s->m->n, m = T->stages + T->extra, used = exchange == DENSE ? m : T->stages;
    const double h = (t[1] - t[0]) / steps;
    double k[64 * DEEPEST], z[DEEPEST], now;
    const rk_step step = {T, h, n, s->y, k, n};
    int i, j, q;
    memcpy(s->y, s->y0, sizeof s->y);
    s->out.count = s->out.start + 1;
    for (j = 0; j < steps; j++) {
        now = t[0] + j * h;
        for (i = 0; i < used; i++) {
            rk_stage(T, i, h, n, s->y, k, n, z);
            if (i == 0 && j > 0 && rk_is(T, RK_FSAL)) memcpy(k, k + (T->stages - 1) * n, (size_t)n * sizeof(double));
            else evaluate(s, fmin(now + T->c[i] * h, t[1]), h * T->A[i * m + i], z, in, k + i * n);
        }
        for (q = 1; exchange == DENSE && q <= 3; q++) {
            rk_dense(&step, q / 4., 0, z);
            write_output(s, now + h * q / 4, z, in, NULL);
        }
        rk_finish(T, h, n, s->y, k, n, s->y, NULL);
        now = j + 1 < steps ? t[0] + (j + 1) * h : t[1];
        z[0] = s->out.slopes ? s->y[1] : 0; /* where slopes are exchanged the second number of the state is that */
        write_output(s, now, s->y, in, z);
    }
}

static double worst_error(int segment, int window, const set_up *a)
{
    double worst = 0, e;
    int i, j, per;
    for (i = 0; i < 2; i++) {
        const wave *w = &side_[i].out;
        per = (w->count - w->start - 1) / a->steps[i];
        for (j = 1; j <= a->steps[i]; j++) {
            const int at = segment * (GRID + 1) + (window * a->steps[i] + j) * (GRID / (a->windows * a->steps[i]));
            e = fabs(w->value[w->start + j * per] - answer[i][at]) / largest[i];
            if (!(e <= worst)) worst = e; /* NaN, too */
        }
    }
    return worst;
}

static void restart(const problem *p, const set_up *a, double t, int fresh)
{
    double out[2][DEEPEST], zero[DEEPEST] = {0};
    int i;
    for (i = 0; i < 2; i++) {
        fixed_side *s = &side_[i];
        if (fresh) memcpy(s->y0, p->side[i].y0, sizeof s->y0);
        s->m = &p->side[i];
        s->out.width = 1;
        s->out.slopes = a->exchange == SLOPES;
        s->out.size = 1;
        s->out.count = s->out.start = 0;
    }
    model_output(side_[1].m, side_[1].y0, NULL, out[1]);
    model_output(side_[0].m, side_[0].y0, out[1], out[0]);
    for (i = 0; i < 2; i++) {
        zero[0] = side_[i].out.slopes ? side_[i].y0[1] : 0;
        wave_write(&side_[i].out, t, out[i], zero);
    }
}

static void couple(const problem *p, set_up *a)
{
    double t[2], before[2], change, start, worst, done;
    int segment, window, k, i, history;
    a->error = 0;
    evaluations = 0;
    for (segment = 0, phase = 0; segment < segments; segment++, phase++) {
        restart(p, a, grid_time(p, segment, 0), segment == 0);
        for (window = 0; window < a->windows && a->error < 1; window++) {
            wave *wa = &side_[0].out, *wb = &side_[1].out;
            t[0] = grid_time(p, segment, (double)window * GRID / a->windows);
            t[1] = grid_time(p, segment, (window + 1.) * GRID / a->windows);
            history = a->exchange == HISTORY ? a->degree - 1 : 0;
            start = wb->value[wb->start];
            wb->count = wb->start + 1;
            wave_write(wb, t[1], &start, &start);
            if (wb->slopes) wb->slope[wb->count - 1] = 0;
            if (wb->slopes) start = wb->slope[wb->start], wb->slope[wb->start] = 0;
            wave_fit(wb, 1 + wb->slopes, 0);
            if (wb->slopes) wb->slope[wb->start] = start;
            before[0] = before[1] = HUGE_VAL;
            for (k = 0; k < 60; k++) {
                sweep(&side_[0], a->T[0], t, a->steps[0], a->exchange, wb);
                wave_fit(wa, a->degree, history < wa->start ? history : wa->start);
                sweep(&side_[1], a->T[1], t, a->steps[1], a->exchange, wa);
                wave_fit(wb, a->degree, history < wb->start ? history : wb->start);
                change = fmax(fabs(wa->value[wa->count - 1] - before[0]) / largest[0],
                              fabs(wb->value[wb->count - 1] - before[1]) / largest[1]);
                before[0] = wa->value[wa->count - 1];
                before[1] = wb->value[wb->count - 1];
                if (change <= a->tol) break;
                if (!(fabs(before[0]) + fabs(before[1]) < 1e6) || evaluations > most_work) break;
            }
            worst = worst_error(segment, window, a);
            if (!(worst <= a->error)) a->error = worst;
            if (!(a->error < 1) || evaluations > most_work || k == 60) a->error = HUGE_VAL;
            done = (segment * a->windows + window + 1.) / (segments * a->windows);
            if (pointless(a->error, (double)evaluations / done)) a->error = HUGE_VAL;
            for (i = 0; i < 2; i++) {
                memcpy(side_[i].y0, side_[i].y, sizeof side_[i].y);
                wave_advance(&side_[i].out, history);
            }
        }
        if (!(a->error < 1)) break;
    }
    a->work = (double)evaluations;
}

/* ---- all of them ---- */

static int possible(const problem *p, const set_up *a)
{
    int i, samples;
    for (i = 0; i < 2; i++) {
        samples = (a->exchange == SLOPES ? 2 : a->exchange == DENSE ? 4 : 1) * a->steps[i] + (a->exchange == SLOPES);
        if (a->exchange == SLOPES && (p->side[i].solve || p->side[i].n != 2 || a->degree < 2)) return 0;
        if (a->exchange == HISTORY ? a->degree == 1 : a->degree > samples) return 0;
        if (a->windows * a->steps[i] > GRID || samples > MOST_SAMPLES / 2) return 0;
    }
    return 2. * segments * a->windows * (a->steps[0] * a->T[0]->stages + a->steps[1] * a->T[1]->stages) <=
           (double)most_work;
}

/* From loose to tight, as long as that helps. */
static void tolerances(const problem *p, set_up a)
{
    static const double tols[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
    double before = HUGE_VAL;
    size_t q;
    for (q = 0; q < sizeof tols / sizeof *tols; q++) {
        a.tol = tols[q];
        couple(p, &a);
        if (!(a.error < 1) || count == MOST) return;
        tried[count++] = a;
        remember(a.error, a.work);
        if (a.error > 0.97 * before) return;
        before = a.error;
    }
}

static void search(const problem *p)
{
    static const int degrees[] = {1, 3, 5, 7, 9};
    const int uneven = p->side[0].solve || p->side[1].solve;
    size_t table, d;
    int windows, steps, ratio, exchange, k;
    count = 0;
    for (k = 0; k < BINS; k++) least_work[k] = HUGE_VAL;
    for (table = 0; table < sizeof explicit_tables / sizeof *explicit_tables; table++)
        for (windows = 1; windows <= GRID; windows *= 2) {
            fprintf(stderr, "\r\033[K  %s, %s, %d windows", p->name, explicit_tables[table], windows);
            for (steps = 1; steps <= 64; steps *= 2)
                for (ratio = uneven ? -2 : 0; ratio <= (uneven ? 4 : 0); ratio += 2)
                    for (exchange = 0; exchange < EXCHANGES; exchange++)
                        for (d = 0; d < sizeof degrees / sizeof *degrees; d++) {
                            set_up a;
                            memset(&a, 0, sizeof a);
                            a.windows = windows, a.degree = degrees[d], a.exchange = exchange;
                            a.steps[0] = ratio < 0 ? steps << -ratio : steps;
                            a.steps[1] = ratio > 0 ? steps << ratio : steps;
                            a.T[0] = rk_find((p->side[0].solve ? stiff_tables : explicit_tables)[table]);
                            a.T[1] = rk_find((p->side[1].solve ? stiff_tables : explicit_tables)[table]);
                            if (possible(p, &a)) tolerances(p, a);
                        }
        }
    study_progress("");
}

/* ---- the run that takes one number ---- */

static int one_number(const char *program, const char *name, double accuracy, double *error, double *work)
{
    char command[600], line[200];
    FILE *f;
    *error = *work = -1;
    snprintf(command, sizeof command, "%s --problem %s --accuracy %.0e 2>/dev/null", program, name, accuracy);
    f = popen(command, "r");
    while (f && fgets(line, sizeof line, f)) {
        sscanf(line, "error %lf", error);
        sscanf(line, "evaluations %lf", work);
    }
    return f && pclose(f) == 0 && *work > 0;
}

static void report(const char *directory, const char *program, const problem *p, double *ratios, int *found)
{
    char name[64];
    FILE *dots, *csv;
    double accuracy, error, work, least;
    int i, q, best;
    snprintf(name, sizeof name, "one-number-%s-all.csv", p->name);
    dots = study_file(directory, name);
    for (i = 0; i < count; i++) fprintf(dots, "%.0f,%.3g\n", tried[i].work, tried[i].error);
    fclose(dots);
    snprintf(name, sizeof name, "one-number-%s.csv", p->name);
    csv = study_file(directory, name);
    fprintf(csv, "accuracy,error,work,best,ratio\n");
    for (q = 0; q < ACCURACIES; q++) {
        accuracy = pow(10, -2 - q);
        if (!one_number(program, p->name, accuracy, &error, &work)) {
            printf("| %s | %.0e | failed | | | |\n", p->name, accuracy);
            continue;
        }
        for (best = -1, least = HUGE_VAL, i = 0; i < count; i++)
            if (tried[i].error <= accuracy && tried[i].work < least) least = tried[i].work, best = i;
        fprintf(csv, "%.0e,%.3g,%.0f,%.0f,%.3g\n", accuracy, error, work, best < 0 ? -1 : least,
                best < 0 ? -1 : work / least);
        printf("| %s | %.0e | %.3g | %.0f | ", p->name, accuracy, error / accuracy, work);
        if (best < 0) printf("- | | none of %d up to %ld |\n", count, most_work);
        else {
            const set_up *a = &tried[best];
            printf("%.0f | %.2f | %s/%s, %d windows of %d/%d steps, degree %d, %s, tolerance %.0e |\n", least,
                   work / least, a->T[0]->name, a->T[1]->name, a->windows * segments, a->steps[0], a->steps[1],
                   a->degree, exchange_name[a->exchange], a->tol);
            ratios[(*found)++] = work / least;
        }
    }
    fclose(csv);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    static problem told;
    double ratios[PROBLEMS * ACCURACIES];
    int i, j, wanted, found = 0;
    if (argc < 3) {
        fprintf(stderr, "usage: study_one_number DIRECTORY ADAPTIVE [PROBLEM...]\n");
        return 2;
    }
    tried = (set_up *)scene_memory(MOST * sizeof *tried);
    for (i = 0; i < 2; i++) side_[i].out = wave_make(1, 1, 1);
    printf("| problem | accuracy | error / accuracy | evaluations | of the best fixed set-up | ratio | that set-up "
           "|\n|---|---|---|---|---|---|---|\n");
    for (i = 0; i < PROBLEMS; i++) {
        for (wanted = argc == 3, j = 3; j < argc; j++) wanted = wanted || strcmp(argv[j], problems[i].name) == 0;
        if (!wanted) continue;
        told = with_events(problems[i]);
        count = 0;
        if (told.side[1].width == 1) { /* the tube's sides write many numbers: no search */
            answers(&told);
            search(&told);
        }
        report(argv[1], argv[2], &told, ratios, &found);
    }
    if (found > 0) {
        const double median = study_median(ratios, found);
        printf("\nwork over that of the best fixed set-up: median %.2f, largest %.2f, of %d\n", median,
               ratios[found - 1], found);
    }
    free(tried);
    return 0;
}
