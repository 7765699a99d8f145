/* SPDX-License-Identifier: MIT

   adaptive_side.h - one side of adaptive.c: a window solved from its start with steps of its own, each as long as the
   accuracy allows; what it may be wrong by, and how strongly it answers to what it reads. */
#ifndef ADAPTIVE_SIDE_H_INCLUDED
#define ADAPTIVE_SIDE_H_INCLUDED

/* What each kind of error may take of the accuracy wanted, per unit of time. */
static const double for_steps = 0.5, for_iteration = 0.25, for_waves = 0.25;
static const double ROUND_OFF = 2e-13; /* changes below it tell nothing */
enum { SWEEPS_MOST = 30, UNMEASURED_MOST = 8, STEPS_MOST = 900, SLOPES_MOST = 16 };

typedef struct side {
    const model *m;
    const rk_table *T;
    double y0[DEEPEST], y[DEEPEST], before[DEEPEST], k[SLOPES_MOST * DEEPEST], slope0[DEEPEST]; /* at the window start; now */
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

static double wanted; /* E */
static const double finest = 1e-11; /* above round-off */
static double accuracy, duration; /* E, or less before an event, and T: a window of length L may be wrong by E L / T */

/* level 0, 1, 2: few digits to many */
static void side_make(side *s, const model *m, int level)
{
    static const char *const explicit_table[] = {"dp5", "verner6", "dop853"};
    static const char *const stiff_table[] = {"esdirk3", "esdirk5", "esdirk5"};
    s->m = m;
    s->T = rk_find(m->solve ? stiff_table[level] : explicit_table[level]);
    s->out = wave_make(m->width, !m->solve, 1);
    memcpy(s->y0, m->y0, sizeof s->y0);
}

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
    model_slope(s->m, t, y, w, k);
    s->work++;
}

/* Z = z + g f(t, Z); returns Z, and k = f(t, Z) = (Z - z)/g. */
static int solve_stage(side *s, double t, double g, const double *z, const wave *in, double *k)
{
    double w[WIDEST];
    wave_read(in, t, w);
    s->work++;
    return model_solve(s->m, t, g, z, w, k);
}

/* The embedded error, in units of the sizes; raised to the order of the step for explicit tables. */
static double embedded(const side *s, double h, const double *err, int calibrate)
{
    double e = size_norm(s->m, err), v[DEEPEST];
    if (s->T->e3) {
        rk_combine(h, s->T->stages, s->T->e3, s->m->n, NULL, s->k, s->m->n, v);
        e = rk_companion(e, size_norm(s->m, v));
    }
    return calibrate ? pow(e, (s->T->order + 1.) / (rk_estimate(s->T) + 1.)) : e;
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
    const double gamma = s->T->A[last * s->T->stages + last];
    const double theta = s->T->order == 3 ? 0.2 : 0.5; /* where the defect tells most, measured */
    const double end[2] = {t + h, h * gamma}, middle[2] = {t + theta * h, h * gamma};
    const rk_step step = {s->T, h, n, s->y, s->k, n};
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
    const int n = s->m->n, calibrate = !s->m->solve && s->control.rejected < 3;
    const double length = s->control.rejected < 3 ? h : fmax(h, duration / 50),
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
    const rk_step step = {s->T, h, s->m->n, s->y, s->k, s->m->n};
    static const double inner[] = {0.25, 0.5, 0.75};
    double out[DEEPEST], v[3 * DEEPEST], w[WIDEST];
    int q;
    if (s->m->solve) rk_dense_many(&step, 0, 3, inner, v, s->m->n);
    for (q = 0; s->m->solve && q < 3; q++) {
        wave_read(in, t + inner[q] * h, w);
        model_output(s->m, v + q * s->m->n, w, out);
        wave_write(&s->out, t + inner[q] * h, out, NULL);
    }
    wave_read(in, end, w);
    model_output(s->m, ynew, w, out);
    memcpy(s->y, ynew, (size_t)s->m->n * sizeof(double));
    if (rk_is(s->T, RK_FSAL)) memcpy(s->k, s->k + (s->T->stages - 1) * s->m->n, (size_t)s->m->n * sizeof(double));
    else slope(s, end, s->y, in, s->k);
    wave_write(&s->out, end, out, s->out.slopes ? s->k : NULL);
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

static int all_finite(int n, const double *v) /* v - v is 0 for a number, NaN for NaN and Inf */
{
    int i;
    for (i = 0; i < n; i++)
        if (!(v[i] - v[i] <= 0)) return 0;
    return 1;
}

/* Where a step of about h from t ends, so that none before `end` is a short rest. */
static double step_end(double t, double end, double h)
{
    const double steps = ceil((end - t) / h * (1 - 1e-9));
    if (steps <= 1) return end;
    return steps == 2 ? 0.5 * (t + end) : t + h;
}

/* The window [t0, t1] from its start; with `frozen` by the step ends of the sweep before.  0: failed. */
static int solve(side *s, double t0, double t1, const wave *in, int frozen, rk_control start, double h)
{
    double t = t0, at, end, e, ynew[DEEPEST], inside = 0;
    int j = 0, status;
    const int failing = fails();
    if (failing && dice / 4096 % 2) return 0;
    memcpy(s->before, s->y, sizeof s->y);
    memcpy(s->y, s->y0, sizeof s->y);
    if (!s->known) slope(s, t0, s->y0, in, s->slope0);
    s->known = 1;
    memcpy(s->k, s->slope0, (size_t)s->m->n * sizeof(double));
    s->out.count = s->out.start + 1;
    s->control = start;
    while (t < t1) {
        end = frozen ? s->ends[j] : step_end(t, t1, fmin(h, (t1 - t0) / s->least));
        e = attempt(s, t, end - t, in, ynew);
        if (frozen) {
            if (!(e <= 3)) return solve(s, t0, t1, in, 0, start, h);
        } else {
            at = t;
            h = end - t;
            status = rk_control_step(&s->control, e, &at, &h);
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
    if (failing) s->out.value[s->out.width * (s->out.count - 1)] = (double)NAN;
    return all_finite((s->out.count - s->out.start) * s->out.width, s->out.value + s->out.width * s->out.start);
}

static void measure_sensitivity(side *s, double t, const wave *in)
{
    double w[WIDEST], k[DEEPEST];
    int i;
    if (s->m->solve) return;
    wave_read(in, t, w);
    for (i = 0; i < in->width; i++) w[i] += 1e-6 * in->size;
    model_slope(s->m, t, s->y0, w, k);
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

/* At the start, or behind an event. */
static void side_start(side *s, double t, int degree, const wave *in)
{
    rk_control_make(&s->control, "PI", s->T);
    s->control.order = (s->m->solve ? s->T->order_hat : s->T->order) - 1; /* per unit step */
    first_step(s, t, in);
    s->least = s->out.slopes ? (degree - 1) / 2 : 1; /* the first wave has its degree */
    if (t > 0 && s->least > 2) s->least--;             /* behind an event 2 less is cheaper: 0.8 to 0.95 of the work */
    memcpy(s->out.slope, s->slope0, (size_t)s->out.width * sizeof(double));
}

/* An error e at an event that was found moves its time by e / rate of the trigger, and a state by that times the jump of
   its slope: how many times e, at most, for an event at t, the end of a window of length L. */
static double moved_by_event(side *s, const problem *p, double t, double L)
{
    double a[WIDEST], b[WIDEST], before[DEEPEST], behind[DEEPEST], jump = 0;
    const double d = 1e-3 * L; /* for a derivative of one digit */
    int i, j;
    for (i = 0; i < 2; i++) {
        slope(&s[i], t, s[i].y0, &s[1 - i].out, before);
        phase++;
        slope(&s[i], t, s[i].y0, &s[1 - i].out, behind);
        phase--;
        for (j = 0; j < s[i].m->n; j++) behind[j] -= before[j];
        jump = fmax(jump, size_norm(s[i].m, behind));
    }
    wave_read(&s[0].out, t - d, a);
    wave_read(&s[1].out, t - d, b);
    return jump * d / fabs(p->trigger(a, b));
}

/* ---- how strongly it answers: measured from sweep to sweep ---- */

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
    double state[DEEPEST];
    int i;
    if (!(moved > ROUND_OFF)) return;
    for (i = 0; i < s->m->n; i++) state[i] = s->y[i] - s->before[i];
    s->gain = fmax(changed, size_norm(s->m, state)) / moved; /* the later windows hear of the state */
    s->most = fmax(s->most, changed / moved);
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

/* What the waves of a window of length L may be wrong by, as far as is known before it is solved. */
static void set_limits(side *s, double L)
{
    int i;
    for (i = 0; i < 2; i++) {
        s[i].most = 0;
        s[i].limit = for_waves * accuracy / fmax(1, gain_most(&s[1 - i], L) * duration / L);
    }
}

/* The error of the waves in units of what they may contribute; above 4 the window is too long. */
static double interpolation(const side *s, double L)
{
    double q = 0;
    int i;
    for (i = 0; i < 2; i++) {
        const double error = fmax(s[i].inside, s[i].out.error) / (for_waves * accuracy);
        q = fmax(q, fmax(1, gain_most(&s[1 - i], L) * duration / L) * error);
    }
    return q;
}

/* The length of a window that the steps of both sides divide best: stages per unit of time, over multiples of both
   steps, at most one step of the slower side. */
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

#endif
