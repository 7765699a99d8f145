/* SPDX-License-Identifier: MIT

   adaptive.c - a coupled run that takes one number, the accuracy: --problem P --accuracy E.

   Both sides step with their own error control and write what they have into a wave; the window is iterated until the
   error of the iteration is a fixed fraction of what the window may contribute; it is accepted, or repeated shorter; the
   next length follows from the estimates.  The same fractions for every problem. */
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

/* What each kind of error may take of the accuracy wanted, per unit of time. */
static const double for_steps = 0.5, for_iteration = 0.1, for_waves = 0.25;
static const double ROUND_OFF = 2e-13; /* changes below it tell nothing */
enum { SWEEPS_MOST = 30, UNMEASURED_MOST = 8, STEPS_MOST = 900, SLOPES_MOST = 16 };

/* ---- one side ---- */

typedef struct side {
    const model *m;
    const rk_table *T;
    double y0[DEEPEST], y[DEEPEST], k[SLOPES_MOST * DEEPEST], slope0[DEEPEST]; /* at the window start; now */
    int known;                                                                 /* slope0 is that of y0 */
    rk_control control;                                                        /* as of the end of the window */
    double h;                                                                  /* the step it proposes */
    double ends[STEPS_MOST];
    int steps;              /* of the window */
    double gain, gain_most; /* |change of what it writes| / |change of what it reads|: last, largest of a window */
    double gain_length;     /* length of that window; 0: not measured yet */
    double most;            /* largest of this window so far */
    int stale;              /* windows since it was measured */
    int least;              /* steps in a window at least: 1, but more where the wave has no history */
    double sensitivity;     /* |df/dw| */
    double inside;          /* error of the dense output */
    double limit;           /* accuracy wanted inside a step, for who reads it */
    wave out;
    long work, rejected;
} side;

static double accuracy, duration; /* E and T: a window of length L may be wrong by E L / T */

static double size_norm(const model *m, const double *v)
{
    double most = 0;
    int i;
    for (i = 0; i < m->n; i++) {
        if (!(fabs(v[i]) <= DBL_MAX)) return HUGE_VAL;
        most = fmax(most, fabs(v[i]) / m->size[i]);
    }
    return most;
}

static void slope(side *s, double t, const double *y, const wave *in, double *k)
{
    double w[WIDEST];
    wave_read(in, t, w);
    s->m->slope(t, y, w, k);
    s->work++;
}

/* Z = z + g f(t, Z); returns Z, and k = f(t, Z) = (Z - z)/g. */
static int solve_stage(side *s, double t, double g, const double *z, const wave *in, double *k)
{
    double w[WIDEST];
    wave_read(in, t, w);
    s->work++;
    return s->m->solve(t, g, z, w, k);
}

/* The embedded error, in units of the sizes, with its companion where the table has one (dop853); raised to the order of
   the step for explicit tables. */
static double embedded(const side *s, double h, const double *err, int calibrate)
{
    double e = size_norm(s->m, err), e3[DEEPEST];
    if (s->T->e3) {
        rk_combine(h, s->T->stages, s->T->e3, s->m->n, NULL, s->k, s->m->n, e3);
        e = rk_companion(e, size_norm(s->m, e3));
    }
    return calibrate ? pow(e, (s->T->order + 1.) / (rk_estimate(s->T) + 1.)) : e;
}

/* The step of size h that was taken from s->y. */
static rk_step taken(const side *s, double h)
{
    rk_step step;
    step.T = s->T;
    step.h = h;
    step.n = step.ldk = s->m->n;
    step.y = s->y;
    step.k = s->k;
    return step;
}

/* v becomes (I - g J)^-1 v by one more stage solve, at the point u with slope du: v is small. */
static int damp(side *s, const double at[2], const double *u, const double *du, const wave *in, double *v)
{
    double z[DEEPEST], k[DEEPEST];
    int i;
    for (i = 0; i < s->m->n; i++) z[i] = u[i] + v[i] - at[1] * du[i];
    if (!solve_stage(s, at[0], at[1], z, in, k)) return 0;
    for (i = 0; i < s->m->n; i++) v[i] = z[i] + at[1] * k[i] - u[i];
    return 1;
}

/* The error of a step of a stiff side, in units of what it may contribute.  The embedded error is damped by the matrix
   of the stages; damped once more it shrinks by 1/(1 + g mu), which tells how long it is remembered: 1/mu, and 1 +
   1/(mu h) errors add up, not duration/h.  Inside the step the defect of the dense output counts, damped alike. */
static double stiff_error(side *s, double t, double h, const double *ynew, double *err, const wave *in)
{
    const int n = s->m->n, last = s->T->stages - 1;
    const rk_step step = taken(s, h);
    const double gamma = s->T->A[last * s->T->stages + last];
    const double theta = s->T->order == 3 ? 0.2 : 0.5; /* where the defect tells most, measured */
    const double end[2] = {t + h, h * gamma}, middle[2] = {t + theta * h, h * gamma};
    double u[DEEPEST], du[DEEPEST], v[DEEPEST], e, left, adding = duration / h;
    int i;
    if (!damp(s, end, ynew, s->k + last * n, in, err)) return HUGE_VAL;
    e = size_norm(s->m, err);
    if (!damp(s, end, ynew, s->k + last * n, in, err)) return HUGE_VAL;
    left = size_norm(s->m, err);
    if (left < e) adding = fmin(adding, 1 + gamma / (e / left - 1));
    rk_dense(&step, theta, 0, u);
    rk_dense(&step, theta, 1, du);
    memset(v, 0, sizeof v);
    if (!damp(s, middle, u, du, in, v)) return HUGE_VAL;
    for (i = 0; i < n; i++) v[i] /= 2 * gamma;
    s->inside = size_norm(s->m, v);
    return fmax(e * adding / (for_steps * accuracy), fmax(s->inside, e) / s->limit);
}

/* One step from s->y: the slopes, ynew, and the error in units of what the step may contribute. */
static double attempt(side *s, double t, double h, const wave *in, double *ynew)
{
    const rk_table *T = s->T;
    const int n = s->m->n, calibrate = !s->m->solve && s->control.failures < 3;
    const double length = s->control.failures < 3 ? h : fmax(h, duration / 50),
                 allowed = for_steps * accuracy * length / duration;
    double z[DEEPEST], err[DEEPEST], e;
    int i, ok = 1;
    for (i = 1; i < T->stages; i++) {
        const double a = T->A[i * (T->stages + T->extra) + i];
        rk_stage(T, i, h, n, s->y, s->k, n, z);
        if (a == 0) slope(s, t + T->c[i] * h, z, in, s->k + i * n);
        else ok = ok && solve_stage(s, t + T->c[i] * h, h * a, z, in, s->k + i * n);
    }
    if (!ok || rk_finish(T, h, n, s->y, s->k, n, ynew, err) != RK_OK) return HUGE_VAL;
    if (s->m->solve) return stiff_error(s, t, h, ynew, err, in);
    e = embedded(s, h, err, calibrate);
    return fmax(e, s->sensitivity * wave_unseen(in, T, t, h, z)) / allowed;
}

static void write_step(side *s, double t, double h, double end, const double *ynew, const wave *in)
{
    static const double inner[] = {0.25, 0.5, 0.75};
    const rk_step step = taken(s, h);
    double out[DEEPEST], v[DEEPEST], w[WIDEST];
    int q;
    for (q = 0; s->m->solve && q < 3; q++) {
        rk_dense(&step, inner[q], 0, v);
        wave_read(in, t + inner[q] * h, w);
        model_output(s->m, v, w, out);
        wave_write(&s->out, t + inner[q] * h, out, NULL);
    }
    wave_read(in, end, w);
    model_output(s->m, ynew, w, out);
    memcpy(s->y, ynew, (size_t)s->m->n * sizeof(double));
    if (rk_is(s->T, RK_FSAL)) memcpy(s->k, s->k + (s->T->stages - 1) * s->m->n, (size_t)s->m->n * sizeof(double));
    else slope(s, end, s->y, in, s->k);
    wave_write(&s->out, end, out, s->k);
}

/* --failures N: one call in N fails, in turn by saying so and by NaN in what it writes. */
static double failures;
static unsigned long dice = 12345;

static int fails(void)
{
    if (failures == 0) return 0;
    dice = (dice * 1103515245UL + 12345) % 2147483648UL;
    return (double)(dice / 8) * failures < 2147483648. / 8;
}

/* The window [t0, t1] from its start; with `frozen` by the step ends of the sweep before.  0: failed. */
static int solve(side *s, double t0, double t1, const wave *in, int frozen, rk_control start, double h)
{
    double t = t0, end, e, ynew[DEEPEST], inside = 0;
    int j = 0, n, status;
    const int failing = fails();
    if (failing && dice / 4096 % 2) return 0;
    memcpy(s->y, s->y0, sizeof s->y);
    if (!s->known) slope(s, t0, s->y0, in, s->slope0);
    s->known = 1;
    memcpy(s->k, s->slope0, (size_t)s->m->n * sizeof(double));
    s->out.count = s->out.start + 1;
    s->control = start;
    while (t < t1) {
        n = (int)fmin(1e6, ceil((t1 - t) / fmin(h, (t1 - t0) / s->least) * (1 - 1e-9)));
        if (frozen) end = s->ends[j];
        else if (n <= 2) end = n == 1 ? t1 : 0.5 * (t + t1);
        else end = t + fmin(h, (t1 - t0) / s->least);
        e = attempt(s, t, end - t, in, ynew);
        if (frozen) {
            if (!(e <= 3)) return solve(s, t0, t1, in, 0, start, h);
        } else {
            double now = t;
            h = end - t;
            status = rk_control_step(&s->control, e, &now, &h);
            if (status != RK_OK) s->rejected++;
            if (status < 0 || j == STEPS_MOST) return 0;
            if (status == RK_REJECT) continue;
            s->ends[j] = end;
            s->h = h;
        }
        write_step(s, t, end - t, end, ynew, in);
        inside = fmax(inside, s->inside);
        t = end;
        j++;
    }
    s->steps = j;
    s->inside = inside;
    if (failing) s->out.value[s->out.width * (s->out.count - 1)] = NAN;
    return wf_finite((s->out.count - s->out.start) * s->out.width, s->out.value + s->out.width * s->out.start);
}

static void measure_sensitivity(side *s, double t, const wave *in)
{
    double w[WIDEST], k[DEEPEST];
    int i;
    if (s->m->solve) return;
    wave_read(in, t, w);
    for (i = 0; i < in->width; i++) w[i] += 1e-6 * in->size;
    s->m->slope(t, s->y0, w, k);
    s->work++;
    for (i = 0; i < s->m->n; i++) k[i] -= s->slope0[i];
    s->sensitivity = size_norm(s->m, k) / (1e-6 * in->size);
}

static void first_step(side *s, double t, const wave *in)
{
    double k[DEEPEST], y[DEEPEST], d0 = 0, d1 = 0, d2 = 0, h;
    int i;
    slope(s, t, s->y0, in, s->slope0);
    s->known = 1;
    d0 = size_norm(s->m, s->y0);
    d1 = size_norm(s->m, s->slope0);
    h = fmin(d1 > 0 ? 0.01 * fmax(d0, 1e-4) / d1 : duration, 1e-4 * duration);
    for (i = 0; i < s->m->n; i++) y[i] = s->y0[i] + h * s->slope0[i];
    slope(s, t + h, y, in, k);
    for (i = 0; i < s->m->n; i++) k[i] = (k[i] - s->slope0[i]) / h;
    d2 = size_norm(s->m, k);
    d1 = fmax(d1 * d1, d2);
    s->h = d1 > 0 ? pow(accuracy / d1, 1. / (s->T->order + 1)) : duration / 100;
    s->h = fmin(s->h, duration / 4);
}

/* ---- the run ---- */

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

/* Steps that divide it best: stages per unit of time, over multiples of both steps, at most one step of the slower. */
static double window_length(const side *a, const side *b)
{
    const double most = fmax(a->h, b->h), sa = a->T->stages, sb = b->T->stages;
    double l, cost, least = HUGE_VAL, best = most;
    int which, i;
    for (which = 0; which < 2; which++)
        for (i = 1; i < STEPS_MOST; i++) {
            l = i * (which ? b->h : a->h);
            if (l > most * (1 + 1e-9) || fmin(a->h, b->h) * (STEPS_MOST / 2) < l) break;
            cost = (ceil(l / a->h - 1e-9) * sa + ceil(l / b->h - 1e-9) * sb) / l;
            if (cost < least) least = cost, best = l;
        }
    return best;
}


/* A gain measured in one window, for another length; the least that is safe: a short window says little of a long one. */
static double gain_for(const side *s, double gain, double L)
{
    const double longer = L / s->gain_length;
    return gain * fmax(longer, pow(longer, 4));
}

static int gain_known(const side *s)
{
    return s->gain_length > 0 && s->stale < UNMEASURED_MOST;
}

static void gain_measure(side *s, double changed, double moved, double L)
{
    if (!(moved > ROUND_OFF)) return;
    s->gain = changed / moved;
    s->most = fmax(s->most, s->gain);
    s->gain_most = s->most;
    s->gain_length = L;
    s->stale = 0;
}

/* The largest gain of this window, or what is known of it. */
static double gain_most(const side *s, double L)
{
    if (s->most > 0) return s->most;
    return s->gain_length > 0 ? gain_for(s, s->gain_most, L) : 0;
}

/* One sweep after the other until the error of the iteration is small enough.  0: no agreement, or a side failed. */
static int iterate(run *r, double t0, double t1)
{
    side *a = &r->s[0], *b = &r->s[1];
    const double L = t1 - t0, allowed = for_iteration * accuracy * L / duration, unit = L / 2;
    const rk_control ca = a->control, cb = b->control;
    const double ha = a->h, hb = b->h;
    double *x = r->vector[0], *hx = r->vector[1], *old = r->vector[2], *va = r->vector[3], *wa = r->vector[4];
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
        if (n != n_old) scene_check(iqn_make(&q, n, 20, 1, r->iqn_memory, r->iqn_bytes), "iqn_make");
        if (n != n_old) iqn_set(q, IQN_OMEGA, 1);
        memcpy(old, x, (size_t)n * sizeof(double));
        scene_check(iqn_step(q, x, hx), "iqn_step");
        moved = wave_distance(&b->out, n, x, old);
        wave_set_vector(&b->out, unit, x);
        wave_fit(&b->out, b->out.degree, b->out.history);
    }
    return 0;
}

/* The error of the waves in units of what they may contribute; above 4 the window is too long. */
static double interpolation(const run *r, double L, double error[2])
{
    const double allowed = for_waves * accuracy;
    double q = 0;
    int i;
    for (i = 0; i < 2; i++) {
        q = fmax(q, gain_most(&r->s[1 - i], L) * error[i] * duration / L / allowed);
        q = fmax(q, error[i] / allowed);
    }
    return q;
}

static void judge(run *r)
{
    double truth[2][DEEPEST];
    int i, j, c;
    for (i = 0; i < 2; i++) {
        const wave *w = &r->s[i].out;
        for (j = w->start + 1; j < w->count; j++) {
            if (r->p->exact) truth[i][0] = r->p->exact(i, w->t[j]);
            else {
                reference_to(&r->ref[i], w->t[j]);
                reference_output(r->p, r->ref[i].y, truth[0], truth[1]);
            }
            for (c = 0; c < w->width; c++) {
                r->error[i] = fmax(r->error[i], fabs(truth[i][c] - w->value[w->width * j + c]));
                r->largest[i] = fmax(r->largest[i], fabs(truth[i][c]));
            }
        }
    }
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
    for (i = 0; i < 2; i++) {
        side *s = &r->s[i];
        rk_control_make(&s->control, "PI", s->T);
        s->control.order = (s->m->solve ? s->T->order_hat : s->T->order) - 1; /* of the error per unit of time */
        first_step(s, t, &r->s[1 - i].out);
        s->least = s->out.slopes ? (r->degree - 1) / 2 : 1;
        memcpy(s->out.slope, s->slope0, (size_t)s->out.width * sizeof(double));
    }
    r->guess = 1;
}

static void march(run *r)
{
    double t = 0, t1, next, L, longest = duration, q, error[2], order;
    int i, k, event = 0, repeats = 0;
    side before[2];
    while (t < duration) {
        next = r->p->event[event] > 0 ? r->p->event[event] : duration;
        if (t == 0 || (event > 0 && t == r->p->event[event - 1])) restart(r, t);
        L = fmin(window_length(&r->s[0], &r->s[1]), longest);
        k = (int)fmin(1e6, ceil((next - t) / L * (1 - 1e-9)));
        t1 = k == 1 ? next : k == 2 ? 0.5 * (t + next) : t + L;
        L = t1 - t;
        memcpy(before, r->s, sizeof before);
        for (i = 0; i < 2; i++) {
            r->s[i].most = 0;
            r->s[i].limit = for_waves * accuracy / fmax(1, gain_most(&r->s[1 - i], L) * duration / L);
        }
        k = iterate(r, t, t1);
        q = HUGE_VAL;
        order = 1;
        if (k > 0) {
            for (i = 0; i < 2; i++)
                error[i] = fmax(r->s[i].inside, wave_error(&r->s[i].out, r->s[i].out.degree, r->s[i].out.history));
            q = interpolation(r, L, error);
            order = fmin(r->s[0].out.degree, r->s[1].out.degree) + 1;
        }
        if (!(q <= 4)) {
            for (i = 0; i < 2; i++) {
                r->s[i].control = before[i].control;
                r->s[i].h = before[i].h;
                r->s[i].out.count = r->s[i].out.start + 1;
            }
            longest = L * (k > 0 ? fmax(0.2, fmin(0.8, 0.9 * pow(q, -1 / order))) : 0.5);
            r->repeated++;
            if (++repeats > 100) {
                fprintf(stderr, "no window from t = %g is good enough\n", t);
                exit(1);
            }
            continue;
        }
        repeats = 0;
        longest = L * fmin(4, 0.9 * pow(q, -1 / order));
        for (i = 0; i < 2; i++) r->s[i].stale++, r->s[i].least = 1;
        r->windows++;
        judge(r);
        if (r->log)
            fprintf(r->log, "%.15g,%.6g,%d,%d,%d,%d,%d,%.3g\n", t1, L, r->s[0].steps, r->s[1].steps, k,
                    r->s[0].out.degree, r->guess, q);
        r->guess = wave_hindsight(&r->s[1].out, r->degree);
        for (i = 0; i < 2; i++) {
            memcpy(r->s[i].y0, r->s[i].y, sizeof r->s[i].y);
            memcpy(r->s[i].slope0, r->s[i].k, (size_t)r->s[i].m->n * sizeof(double));
            wave_advance(&r->s[i].out, OLDER);
        }
        t = t1;
        if (t == r->p->event[event]) event++, phase++;
    }
}

int main(int argc, char **argv)
{
    static const char *const explicit_table[] = {"dp5", "verner6", "dop853"}, *const stiff_table[] = {
                                                                                  "esdirk3", "esdirk5", "esdirk5"};
    scene_option o[] = {{"problem", "masses", "masses, damped, load, pol, stiff, heat, switch, rates"},
                        {"accuracy", "1e-4", "error wanted, over the largest value"},
                        {"failures", "0", "one call of a solver in so many fails; 0: none"},
                        {"log", "", "write NAME.csv: windows"},
                        {NULL, NULL, NULL}};
    static run r;
    static problem chosen;
    int i, level;
    scene_parse(argc, argv, "a coupled run that takes one number, the accuracy", o);
    for (i = 0; i < PROBLEMS && strcmp(problems[i].name, scene_text(o, "problem")) != 0; i++) {}
    if (i == PROBLEMS) {
        fprintf(stderr, "--problem %s is not one of %s\n", scene_text(o, "problem"), o[0].help);
        return 2;
    }
    chosen = problems[i];
    r.p = &chosen;
    accuracy = scene_number(o, "accuracy", 1e-11, 0.1);
    failures = scene_number(o, "failures", 0, 1e9);
    for (i = 0; i < 2; i++) chosen.side[i].y0[0] = scene_perturbed("start", chosen.side[i].y0[0]);
    duration = r.p->end;
    r.log = scene_file(o, "log", ".csv");
    level = accuracy > 3e-4 ? 0 : accuracy > 3e-6 ? 1 : 2;
    r.degree = 5 + 2 * level;
    for (i = 0; i < 2; i++) {
        side *s = &r.s[i];
        s->m = &r.p->side[i];
        s->T = rk_find(s->m->solve ? stiff_table[level] : explicit_table[level]);
        s->out = wave_make(s->m->width, !s->m->solve, 1);
        memcpy(s->y0, s->m->y0, sizeof s->y0);
        r.ref[i] = reference_start(r.p);
    }
    for (i = 0; i < 5; i++) r.vector[i] = (double *)scene_memory(2 * MOST_SAMPLES * WIDEST * sizeof(double));
    r.iqn_bytes = iqn_size(2 * MOST_SAMPLES * r.s[1].m->width, 20, 1);
    r.iqn_memory = scene_memory(r.iqn_bytes);
    march(&r);
    r.error[0] = fmax(r.error[0] / r.largest[0], r.error[1] / r.largest[1]);
    printf("accuracy %g\nerror %.3g\nratio %.3g\nevaluations %ld\nevaluations_A %ld\nevaluations_B %ld\n", accuracy,
           r.error[0], r.error[0] / accuracy, r.s[0].work + r.s[1].work, r.s[0].work, r.s[1].work);
    printf("windows %ld\niterations %.3g\nrepeated %ld\nrejected %ld\n", r.windows,
           (double)r.sweeps / (double)r.windows, r.repeated, r.s[0].rejected + r.s[1].rejected);
    return 0;
}
