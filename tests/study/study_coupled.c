/* SPDX-License-Identifier: MIT

   study_coupled.c - end to end: the error of two coupled solvers against all the work of both, over the length of the
   window, sub-steps, degree, what is exchanged, Runge-Kutta order and tolerance of the iteration.
   study_coupled DIRECTORY [MANUFACTURED]   MANUFACTURED: the program of examples/manufactured.c */
#include "study.h"

#define WF_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "rk.h"
#include "waveform.h"

extern FILE *popen(const char *command, const char *type);
extern int pclose(FILE *stream);

/* ---- what was tried, the cheapest per target, Pareto fronts ---- */

typedef struct attempt {
    double work, error, iterations, tol;
    int windows, steps, degree, exchange;
    const char *table;
} attempt;

static const char *const exchange_name[] = {"sub-steps", "sub-steps + history", "sub-steps + slopes", "dense output, 1 within a step", "dense output, 3 within a step"};
enum { SUBSTEPS, HISTORY, HERMITE, DENSE1, DENSE3, EXCHANGES };
enum { MOST = 200000 };
static attempt *tried;
static int count;

static int by_work(const void *a, const void *b)
{
    const attempt *x = (const attempt *)a, *y = (const attempt *)b;
    return (x->work > y->work) - (x->work < y->work);
}

static void report(const char *directory, const char *problem, const char *unit)
{
    static const double targets[] = {1e-2, 1e-4, 1e-8, 1e-12};
    char name[64];
    FILE *csv, *table;
    double best;
    int i, q, degree;
    qsort(tried, (size_t)count, sizeof *tried, by_work);
    sprintf(name, "coupled-%s.csv", problem);
    csv = study_file(directory, name);
    fprintf(csv, "work,error,windows,steps,degree,exchange,table,tolerance,iterations\n");
    for (i = 0; i < count; i++)
        fprintf(csv, "%.0f,%.4g,%d,%d,%d,%s,%s,%.0e,%.3g\n", tried[i].work, tried[i].error, tried[i].windows, tried[i].steps, tried[i].degree,
                exchange_name[tried[i].exchange], tried[i].table, tried[i].tol, tried[i].iterations);
    fclose(csv);

    /* fronts: of all (degree -1) and of every degree alone; a line per point, two blank lines between */
    sprintf(name, "front-%s.dat", problem);
    csv = study_file(directory, name);
    for (degree = -1; degree <= 9; degree++) {
        for (best = HUGE_VAL, i = 0; i < count; i++)
            if ((degree < 0 || tried[i].degree == degree) && tried[i].error < 0.97 * best) {
                best = tried[i].error;
                fprintf(csv, "%.0f %.4g\n", tried[i].work, best);
            }
        fprintf(csv, best < HUGE_VAL ? "\n\n" : "nan nan\n\n\n");
    }
    fclose(csv);

    sprintf(name, "recommend-%s.md", problem);
    table = study_file(directory, name);
    for (i = 0; i < 2; i++) {
        FILE *out = i ? stdout : table;
        fprintf(out, "| error | %s | windows | sub-steps in each | degree | exchanged | method | tolerance | iterations |\n|---|---|---|---|---|---|---|---|---|\n", unit);
        for (q = 0; q < 4; q++) {
            const attempt *a = tried;
            while (a < tried + count && !(a->error <= targets[q])) a++;
            if (a == tried + count) fprintf(out, "| %.0e | not reached | | | | | | | |\n", targets[q]);
            else
                fprintf(out, "| %.0e | %.0f | %d | %d | %d | %s | %s | %.0e | %.1f |\n", targets[q], a->work, a->windows, a->steps, a->degree,
                        exchange_name[a->exchange], a->table, a->tol, a->iterations);
        }
    }
    fclose(table);
}

/* ---- two masses between springs: u1,2 = (cos 2 pi t +- cos 6 pi t)/2 ---- */

static const double pi = 3.14159265358979323846;
static long evaluations;
static const long most_work = 16000; /* the cheapest of all for 1e-12 takes 12288 */

typedef struct side {
    wf *out;
    double y0[2], y[2], c[700]; /* state at the window start, now; coefficients */
} side;

static double exact(int which, double t)
{
    return 0.5 * (cos(2 * pi * t) + (which ? -1 : 1) * cos(6 * pi * t));
}

static void write(side *s, int hermite, double t, double u, double v)
{
    const int j = wf_push(s->out, t, hermite ? WF_SLOPE : 0);
    scene_check(j, wf_message(j));
    *wf_column(s->out, j) = u;
    if (hermite) *wf_column(s->out, j + 1) = v;
}

/* One side over one window; returns its largest error at the sub-steps. */
static double solve(side *s, int which, const side *other, const rk_table *T, double t0, double t1, int steps, int exchange)
{
    const double h = (t1 - t0) / steps;
    const int m = T->stages + T->extra, within = exchange == DENSE1 ? 1 : exchange == DENSE3 ? 3 : 0;
    const int used = within ? m : T->stages;
    double k[64 * 2], z[2], v[2], w, t, end, worst = 0;
    int i, j, q;
    memcpy(s->y, s->y0, sizeof s->y);
    wf_rollback(s->out);
    for (j = 0; j < steps; j++) {
        t = t0 + j * h;
        end = j == steps - 1 ? t1 : t0 + (j + 1) * h;
        for (i = 0; i < used; i++, evaluations++) {
            rk_stage(T, i, h, 2, s->y, k, 2, z);
            wf_eval(other->out, fmin(t + T->c[i] * h, t1), 0, other->c, &w);
            k[2 * i] = z[1];
            k[2 * i + 1] = 16 * pi * pi * w - 20 * pi * pi * z[0];
        }
        for (q = 1; q <= within; q++) {
            const rk_step done = {T, h, 2, s->y, k, 2};
            rk_dense(&done, (double)q / (within + 1), 0, v);
            write(s, 0, t + h * q / (within + 1), v[0], v[1]);
        }
        rk_finish(T, h, 2, s->y, k, 2, s->y, NULL);
        write(s, exchange == HERMITE, end, s->y[0], s->y[1]);
        worst = fmax(worst, fabs(s->y[0] - exact(which, end)));
    }
    wf_fit(s->out, s->c);
    return worst;
}

static void couple(attempt *a, const rk_table *T)
{
    const int samples = a->exchange == HERMITE ? 2 * a->steps + 2 : (a->exchange == DENSE1 ? 2 : a->exchange == DENSE3 ? 4 : 1) * a->steps + 1;
    const int history = a->exchange == HISTORY ? a->degree - 1 : 0, capacity = samples + history;
    const size_t bytes = wf_size(1, a->degree, capacity);
    side s[2];
    double before, change, e[2];
    int j, k, win, total = 0;
    void *mem[2];
    for (j = 0; j < 2; j++) {
        mem[j] = scene_memory(bytes);
        scene_check(wf_make(&s[j].out, 1, a->degree, capacity, mem[j], bytes), "wf_make");
        s[j].y0[0] = s[j].y[0] = exact(j, 0), s[j].y0[1] = 0;
        write(&s[j], a->exchange == HERMITE, 0, s[j].y0[0], 0);
    }
    a->error = 0, evaluations = 0;
    for (win = 0; win < a->windows && a->error < 1; win++) {
        const double t0 = (double)win / a->windows, t1 = win + 1 == a->windows ? 1 : (win + 1.) / a->windows;
        wf_rollback(s[1].out);
        for (j = 1; j <= a->steps; j++) /* first guess: constant */
            write(&s[1], a->exchange == HERMITE, j == a->steps ? t1 : t0 + j * ((t1 - t0) / a->steps), s[1].y0[0], 0);
        wf_fit(s[1].out, s[1].c);
        for (k = 0; k < 100; k++) {
            before = s[1].y[0];
            change = s[0].y[0];
            e[0] = solve(&s[0], 0, &s[1], T, t0, t1, a->steps, a->exchange);
            e[1] = solve(&s[1], 1, &s[0], T, t0, t1, a->steps, a->exchange);
            change = fmax(fabs(s[0].y[0] - change), fabs(s[1].y[0] - before));
            if (k > 0 && change <= a->tol) break;
            if (!(change < 1e6) || evaluations > most_work) break;
        }
        total += k + 1;
        a->error = fmax(a->error, fmax(e[0], e[1]));
        if (!(a->error < 1) || evaluations > most_work) a->error = HUGE_VAL;
        for (j = 0; j < 2; j++) {
            memcpy(s[j].y0, s[j].y, sizeof s[j].y);
            wf_advance(s[j].out, history);
        }
    }
    a->work = (double)evaluations;
    a->iterations = (double)total / a->windows;
    free(mem[0]), free(mem[1]);
}

static void oscillator(const char *directory)
{
    static const char *const names[] = {"heun", "rk4", "dp5", "verner6", "dop853"};
    static const int degrees[] = {1, 2, 3, 5, 7, 9}, steps[] = {1, 2, 4, 8, 16, 32, 64};
    static const double tols[] = {1e-3, 1e-5, 1e-7, 1e-10};
    size_t i, d, j, q;
    int windows, exchange;
    for (i = 0; i < sizeof names / sizeof *names; i++) {
        const rk_table *T = rk_find(names[i]);
        if (!T) continue;
        study_progress("two masses, ");
        fprintf(stderr, "%s", T->name);
        for (windows = 1; windows <= 128; windows *= 2)
            for (j = 0; j < sizeof steps / sizeof *steps && 2. * windows * steps[j] * T->stages * 2 <= most_work; j++)
                for (exchange = 0; exchange < EXCHANGES; exchange++)
                    for (d = 0; d < sizeof degrees / sizeof *degrees; d++)
                        for (q = 0; q < sizeof tols / sizeof *tols; q++) {
                            const int samples = (exchange == HERMITE || exchange == DENSE1 ? 2 : exchange == DENSE3 ? 4 : 1) * steps[j];
                            attempt a = {0, 0, 0, 0, 0, 0, 0, 0, NULL};
                            a.tol = tols[q], a.windows = windows, a.steps = steps[j], a.degree = degrees[d], a.exchange = exchange, a.table = T->name;
                            if ((exchange == HISTORY ? degrees[d] == 1 : degrees[d] > samples + (exchange == HERMITE)) || (exchange == HERMITE && degrees[d] < 2)) continue;
                            couple(&a, T);
                            if (a.error < 1 && count < MOST) tried[count++] = a;
                        }
    }
    study_progress("\r\033[K");
    printf("\ntwo masses, %d set-ups: the cheapest for a target\n", count);
    report(directory, "oscillator", "evaluations of both sides");
}

/* ---- heat with a known answer: the scene, run with every set of options ---- */

static void heat(const char *directory, const char *program)
{
    static const char *const names[] = {"euler", "radau2", "radau3", "gauss2", "gauss3"};
    static const int stages[] = {1, 2, 3, 2, 3}, degrees[] = {1, 2, 3, 5, 7}, steps[] = {1, 2, 5, 10};
    static const double tols[] = {1e-4, 1e-7, 1e-10, 1e-13};
    char command[600], line[200];
    int i, windows, d, j, q;
    count = 0;
    for (i = 0; i < 5; i++)
        for (windows = 1; windows <= 32; windows *= 2)
            for (j = 0; j < 4; j++)
                for (d = 0; d < 5; d++)
                    for (q = 0; q < 4; q++) {
                        attempt a = {0, 0, 0, 0, 0, 0, 0, 0, NULL};
                        double e = -1;
                        FILE *p;
                        a.tol = tols[q], a.windows = windows, a.steps = steps[j], a.degree = degrees[d], a.table = names[i];
                        if (a.degree > a.steps || a.degree > 2 * stages[i]) continue;
                        snprintf(command, sizeof command, "%s --m 10 --method %s --windows %d --steps %d,%d --degree %d --tolerance %g 2>/dev/null", program, names[i],
                                 windows, steps[j], steps[j], degrees[d], tols[q]);
                        p = popen(command, "r");
                        while (p && fgets(line, sizeof line, p)) {
                            sscanf(line, "e_A %lf", &e);
                            sscanf(line, "iterations %lf", &a.iterations);
                        }
                        if (!p || pclose(p) != 0 || !(e >= 0)) continue;
                        a.error = e;
                        a.work = a.iterations * windows * 2 * steps[j] * stages[i];
                        if (e < 1 && count < MOST) tried[count++] = a;
                        if (count % 50 == 0) fprintf(stderr, "\r\033[K  heat, %s, %d set-ups", names[i], count);
                    }
    study_progress("\r\033[K");
    if (!count) {
        printf("\nheat: no answers from %s\n", program);
        return;
    }
    printf("\nheat with a known answer, %d set-ups: the cheapest for a target\n", count);
    report(directory, "heat", "stages solved on both sides");
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: study_coupled DIRECTORY [MANUFACTURED]\n");
        return 2;
    }
    tried = (attempt *)scene_memory(MOST * sizeof *tried);
    oscillator(argv[1]);
    if (argc > 2) heat(argv[1], argv[2]);
    free(tried);
    return 0;
}
