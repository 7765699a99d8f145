/* SPDX-License-Identifier: MIT

   adaptive.c - a coupled run that takes one number, the accuracy: --problem P --accuracy E.

   Both sides step with their own error control and write what they have into a wave; the window is
   iterated until the error of the iteration is a fixed fraction of what the window may contribute;
   it is accepted, or repeated shorter; the next length follows from the estimates.  An event ends a
   window: one whose time is told, or one that the waves show, where a trigger falls below 0.  The
   same fractions for every problem. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include "scene.h"
#include <float.h>
#include "adaptive_wave.h"
#include "adaptive_problems.h"
#include "adaptive_side.h"

typedef struct run {
    const problem *p;
    side s[2];
    reference ref[2];
    double *vector[5]; /* work: samples of a window */
    void *iqn_memory;
    size_t iqn_bytes;
    int degree, guess; /* of the waves at most; of the first guess */
    double error[2], largest[2];
    long windows, sweeps, repeated;
    FILE *log;
} run;

/* Sweep after sweep until the error of the iteration is small.  0: no agreement, a side failed. */
static int iterate(run *r, double t0, double t1)
{
    side *a = &r->s[0], *b = &r->s[1];
    const double L = t1 - t0, unit = L / 2, allowed = for_iteration * accuracy * L / duration;
    const rk_control ca = a->control, cb = b->control;
    const double ha = a->h, hb = b->h;
    double *x = r->vector[0], *hx = r->vector[1], *old = r->vector[2];
    double *va = r->vector[3], *wa = r->vector[4];
    double residual, moved = 0, da = 0, ka, kab;
    int k, n = 0, n_old, na;
    iqn *q = NULL;
    wave_guess(&b->out, r->guess);
    for (k = 1; k <= SWEEPS_MOST; k++) {
        r->sweeps++;
        if (!solve(a, t0, t1, &b->out, k > 1, ca, ha)) return 0;
        if (k == 1) measure_sensitivity(a, t0, &b->out);
        if (k == 1) wave_choose(&a->out, r->degree);
        if (k > 1) {
            na = wave_vector(&a->out, 1, unit, va);
            wave_vector(&a->out, 0, unit, wa);
            da = wave_distance(&a->out, na, va, wa);
            gain_measure(a, da, moved, L);
            wave_choose(&a->out, r->degree);
            if (gain_known(b) && gain_for(b, b->gain, L) * da <= allowed) { /* B stands */
                wave_set_vector(&b->out, unit, hx);
                wave_fit(&b->out, b->out.degree, b->out.history);
                return k;
            }
        }
        if (!solve(b, t0, t1, &a->out, k > 1, cb, hb)) return 0;
        if (k == 1) measure_sensitivity(b, t0, &a->out);
        n_old = n;
        n = wave_vector(&b->out, 1, unit, x);
        if (n == n_old) memcpy(old, hx, (size_t)n * sizeof(double));
        wave_vector(&b->out, 0, unit, hx);
        residual = wave_distance(&b->out, n, x, hx);
        if (k > 1 && n == n_old) gain_measure(b, wave_distance(&b->out, n, hx, old), da, L);
        wave_choose(&b->out, r->degree);
        if (k > 1 && residual <= ROUND_OFF) return k;
        if (gain_known(a) && gain_known(b)) {
            ka = gain_for(a, a->gain, L);
            kab = ka * gain_for(b, b->gain, L);
            if (fmax(ka, kab) * residual / (1 - fmin(kab, 0.9)) <= allowed) return k;
        }
        if (n != n_old) {
            scene_check(iqn_make(&q, n, 20, 1, r->iqn_memory, r->iqn_bytes), "iqn_make");
            iqn_set(q, IQN_OMEGA, 1);
        }
        memcpy(old, x, (size_t)n * sizeof(double));
        scene_check(iqn_step(q, x, hx), "iqn_step");
        moved = wave_distance(&b->out, n, x, old);
        wave_set_vector(&b->out, unit, x);
        wave_fit(&b->out, b->out.degree, b->out.history);
    }
    return 0;
}

/* Start, or start again behind an event: nothing older is of use. */
static void restart(run *r, double t)
{
    double out[2][DEEPEST];
    int i;
    model_output(r->s[1].m, r->s[1].y0, NULL, out[1]);
    model_output(r->s[0].m, r->s[0].y0, out[1], out[0]);
    for (i = 0; i < 2; i++) {
        wave *w = &r->s[i].out;
        w->count = w->start = 0;
        wave_write(w, t, out[i], out[i]);
        wave_fit(w, 1 + w->slopes, 0);
    }
    for (i = 0; i < 2; i++) side_start(&r->s[i], t, r->degree, &r->s[1 - i].out);
    r->guess = 1;
}

/* The window is solved again, with another length. */
static void take_back(run *r, const side *before)
{
    int i;
    for (i = 0; i < 2; i++) {
        r->s[i].control = before[i].control;
        r->s[i].h = before[i].h;
        r->s[i].out.count = r->s[i].out.start + 1;
    }
    r->repeated++;
}

static void report_window(run *r, double t1, double L, int sweeps, double q)
{
    int i;
    for (i = 0; i < 2; i++) judge(&r->ref[i], i, &r->s[i].out, &r->error[i], &r->largest[i]);
    if (!r->log) return;
    fprintf(r->log, "%.15g,%.6g,%d,%d,%d,", t1, L, r->s[0].steps, r->s[1].steps, sweeps);
    fprintf(r->log, "%d,%d,%.3g\n", r->s[0].out.degree, r->guess, q);
}

/* Back to the last event, or the start; the work was done all the same. */
static void back_to(run *r, const run *piece)
{
    const run now = *r;
    int i;
    *r = *piece;
    r->sweeps = now.sweeps;
    r->repeated = now.repeated + now.windows - piece->windows;
    for (i = 0; i < 2; i++) r->s[i].work = now.s[i].work, r->s[i].rejected = now.s[i].rejected;
}

static void march(run *r)
{
    double t = 0, t1, next, L, longest = duration, q, order, found = HUGE_VAL, from = 0, wrong;
    int i, k, event = 0, repeats = 0;
    side before[2];
    static run piece;
    piece = *r;
    restart(r, t);
    while (t < duration) {
        next = fmin(r->p->event[event] > 0 ? r->p->event[event] : duration, found);
        t1 = step_end(t, next, fmin(window_length(&r->s[0], &r->s[1]), longest));
        L = t1 - t;
        memcpy(before, r->s, sizeof before);
        set_limits(r->s, L);
        k = iterate(r, t, t1);
        q = HUGE_VAL;
        order = 1;
        if (k > 0) {
            q = interpolation(r->s, L);
            order = fmin(r->s[0].out.degree, r->s[1].out.degree) + 1;
        }
        if (!(q <= 4)) {
            take_back(r, before);
            longest = L * (k > 0 ? fmax(0.2, fmin(0.8, 0.9 * pow(q, -1 / order))) : 0.5);
            scene_check(++repeats > 100 ? -1 : 0, "no window is good enough");
            continue;
        }
        if (t1 < found && event_in(r->p, &r->s[0].out, &r->s[1].out, &found)) { /* end there */
            take_back(r, before);
            continue;
        }
        repeats = 0;
        longest = fmin(4 * L, 0.9 * L / fmin(r->s[0].steps, r->s[1].steps) * pow(q, -1 / order));
        for (i = 0; i < 2; i++) r->s[i].stale++, r->s[i].least = 1;
        r->windows++;
        report_window(r, t1, L, k, q);
        r->guess = wave_hindsight(&r->s[1].out, r->degree);
        for (i = 0; i < 2; i++) {
            memcpy(r->s[i].y0, r->s[i].y, sizeof r->s[i].y);
            memcpy(r->s[i].slope0, r->s[i].k, (size_t)r->s[i].m->n * sizeof(double));
            wave_advance(&r->s[i].out, OLDER);
        }
        t = t1;
        if (t == next && t < duration) {
            wrong = t == found ? moved_by_event(r->s, r->p, t, L) * (t - from) / duration : 0;
            if (wrong > 1 && accuracy == wanted) { /* solve the piece again, as accurately as its event asks for */
                accuracy = fmax(wanted / wrong, finest);
                back_to(r, &piece);
                t = from;
            } else {
                event += t != found;
                accuracy = wanted;
                from = t;
                phase++;
                piece = *r;
            }
            found = HUGE_VAL;
            longest = duration;
            restart(r, t);
        }
    }
}

int main(int argc, char **argv)
{
    const char *const all = "masses damped load pol stiff heat switch duffing rates tube relay";
    scene_option o[] = {{"problem", "masses", all},
                        {"accuracy", "1e-4", "error wanted, over the largest value"},
                        {"failures", "0", "one call of a solver in so many fails; 0: none"},
                        {"vary", "0", "starts and rates by up to 3 %; which: 1, 2, ...; 0: none"},
                        {"log", "", "write NAME.csv: windows"},
                        {"best", "", "tests/study/one-number.txt: print the best fixed set-up"},
                        {NULL, NULL, NULL}};
    static run r;
    static problem chosen;
    int i, level;
    scene_parse(argc, argv, "a coupled run that takes one number, the accuracy", o);
    chosen = problem_named(scene_text(o, "problem"), all);
    r.p = &chosen;
    accuracy = wanted = scene_number(o, "accuracy", finest, 0.1);
    failures = scene_number(o, "failures", 0, 1e9);
    problem_vary(&chosen, (unsigned long)scene_integer(o, "vary", 0, 1000000));
    duration = r.p->end;
    r.log = scene_file(o, "log", ".csv");
    if (r.log)
        fprintf(r.log, "end,length,steps_A,steps_B,sweeps,degree_A,degree_guess,interpolation\n");
    level = (wanted <= 3e-4) + (wanted <= 3e-6);
    r.degree = 5 + 2 * level;
    for (i = 0; i < 2; i++) {
        side_make(&r.s[i], &r.p->side[i], level);
        r.ref[i] = reference_start(r.p);
    }
    for (i = 0; i < 5; i++)
        r.vector[i] = (double *)scene_memory(2 * MOST_SAMPLES * WIDEST * sizeof(double));
    r.iqn_bytes = iqn_size(2 * MOST_SAMPLES * r.s[1].m->width, 20, 1);
    r.iqn_memory = scene_memory(r.iqn_bytes);
    march(&r);
    r.error[0] = fmax(r.error[0] / r.largest[0], r.error[1] / r.largest[1]);
    printf("accuracy %g\nerror %.3g\nratio %.3g\n", wanted, r.error[0], r.error[0] / wanted);
    printf("evaluations %ld\nevaluations_A %ld\nevaluations_B %ld\n", r.s[0].work + r.s[1].work,
           r.s[0].work, r.s[1].work);
    printf("windows %ld\niterations %.3g\n", r.windows, (double)r.sweeps / (double)r.windows);
    printf("repeated %ld\nrejected %ld\n", r.repeated, r.s[0].rejected + r.s[1].rejected);
    print_best(scene_text(o, "best"), scene_text(o, "problem"), wanted, r.s[0].work + r.s[1].work);
    return 0;
}
