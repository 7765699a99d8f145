/* SPDX-License-Identifier: MIT

   delay.c - delay equations: y'(t) = f(t, y(t), y(a)), where a(t, y) lies in the past

   rk.h steps, waveform.h keeps the past: a sample with its slope after every step, read at any time.  Where the past has a
   kink, so has y' (or a higher derivative) later, when a reaches that time.  The scene finds those times by dense output, as
   events: the step ends there, and the waveform has a break.  After as many kinks as the degree they are smooth enough.

       constant   y' = -y(t - 1), y = 1 until 0; exact: sum over n of (-1)^n (t - n + 1)^n / n!, as far as t - n + 1 > 0
       state      y' = y(y(t) - sqrt 2 + 1) / (2 sqrt t), y = 1 until 1 (Feldstein & Neves, SIAM J. Numer. Anal. 21, 1984);
                  exact: sqrt t until 2, then t/4 + 1/2 + (1 - sqrt(1/2)) sqrt t until 5.0294372515248

   The trap: a step as long as the delay cannot see its own error.  Between two breaks there are two samples then, enough for
   a cubic (WF_LOWERED, counted as `lowered`), and Runge-Kutta reads that cubic without error.  Three cures: a step that would
   read what is not known yet is repeated, shorter (wf_strict; --strict 0 shows the trap), the step has a limit (--largest),
   values of the dense output are kept inside it (--inside; it does not help where the read was extrapolated). */
#define RK_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "rk.h"
#include "waveform.h"
#include "scene.h"

static int checked(int status, const char *message)
{
    scene_check(status, message);
    return status;
}

/* ---- the problems ---- */

typedef struct problem {
    const char *name;
    double start, end;
    double (*where)(double t, double y); /* the time that is read, a */
    double (*slope)(double t, double y, double past);
    double (*exact)(double t); /* until the start it is 1 */
} problem;

static double delay_of_one(double t, double y)
{
    (void)y;
    return t - 1;
}

static double minus_past(double t, double y, double past)
{
    (void)t, (void)y;
    return -past;
}

/* Term n counts from t = n - 1 on. */
static double exact_constant(double t)
{
    double sum = 1, power;
    int n, k;
    if (t <= 0) return 1;
    for (n = 1; t - n + 1 > 0; n++) {
        for (power = 1, k = 1; k <= n; k++) power *= -(t - n + 1) / k;
        sum += power;
    }
    return sum;
}

static double delay_by_state(double t, double y)
{
    (void)t;
    return y - sqrt(2) + 1;
}

static double past_over_root(double t, double y, double past)
{
    (void)y;
    return past / (2 * sqrt(t));
}

static double exact_state(double t)
{
    if (t <= 1) return 1;
    return t <= 2 ? sqrt(t) : t / 4 + 0.5 + (1 - sqrt(0.5)) * sqrt(t);
}

static const problem problems[] = {{"constant", 0, 8, delay_of_one, minus_past, exact_constant},
                                   {"state", 1, 5, delay_by_state, past_over_root, exact_state}};

/* ---- the past ---- */

enum { COLUMNS = 20000, INSIDE = 8 };
#define NEAR 1e-9 /* a kink is met; what is lost is a jump of y'' times the square of this */

typedef struct run {
    const problem *P;
    waveform past;
    int degree;
    int beyond, lowered; /* reads of what is not known yet; reads of a lower degree */
} run;

/* f at a stage: reads the past, and counts what was wrong with that. */
static double slope(run *r, double t, double y)
{
    const double a = r->P->where(t, y);
    double past = 1;
    int status = 0;
    if (a > r->P->start) status = wf_read(r->past.w, a, 0, &past);
    if (status == WF_EEXTRAP) r->beyond++;
    else checked(status, wf_message(status));
    if (status == WF_LOWERED) r->lowered++;
    return r->P->slope(t, y, past);
}

/* A sample, from degree 2 on with its slope.  what: 0, or WF_BREAK for what is after a kink. */
static void keep(run *r, double t, double y, double yt, int what)
{
    const int with_slope = r->degree > 1;
    double *sample = waveform_push(&r->past, t, with_slope ? what | WF_SLOPE : what);
    sample[0] = y;
    if (with_slope) sample[1] = yt;
}

static double where_at(const run *r, const rk_step *s, double t, double theta)
{
    double y;
    checked(rk_dense(s, theta, 0, &y), "rk_dense");
    return r->P->where(t + theta * s->h, y);
}

/* The part of the step until a reaches the kink; 1: it does not, or at the end. */
static double until_kink(const run *r, const rk_step *s, double t, double kink)
{
    double low = 0, high = 1;
    int i;
    if (!(where_at(r, s, t, 1) > kink + NEAR)) return 1;
    for (i = 0; i < 60; i++) {
        const double middle = low + (high - low) / 2;
        if (where_at(r, s, t, middle) > kink) high = middle;
        else low = middle;
    }
    return high;
}

/* Steps, and the largest error at their ends. */
static int integrate(run *r, double tol, double largest, int inside, double *error)
{
    const rk_table *T = rk_find("dp5");
    const problem *P = r->P;
    double kink[WF_MAX_DEGREE + 1], t = P->start, t0, h = 0.01, y = 1, k[8], z, ynew, err, sum[2], theta;
    int kinks = 1, met = 0, steps = 0, before, i, status;
    rk_control C, saved;
    rk_step s = {T, 0, 1, NULL, NULL, 1};
    s.y = &y;
    s.k = k;
    checked(rk_control_make(&C, "PI", T), "rk_control_make");
    C.largest = largest;
    rk_control_stop(&C, P->end, t, &h);
    kink[0] = P->start;
    k[0] = slope(r, t, y);
    keep(r, t, y, k[0], 0);
    for (*error = 0; t < P->end;) {
        before = r->beyond;
        for (i = 1; i < T->stages; i++) {
            rk_stage(T, i, h, 1, &y, k, 1, &z);
            k[i] = slope(r, t + T->c[i] * h, z);
        }
        rk_finish(T, h, 1, &y, k, 1, &ynew, &err);
        sum[0] = sum[1] = 0;
        rk_norm(tol, tol, NULL, 1, &err, &y, &ynew, sum);
        saved = C;
        t0 = t;
        s.h = h;
        status = rk_control_step(&C, r->beyond > before ? HUGE_VAL : rk_rms(sum), &t, &h);
        checked(status, rk_message(status));
        if (status == RK_REJECT) continue;
        theta = met < kinks ? until_kink(r, &s, t0, kink[met]) : 1;
        if (theta < 1) { /* once more, up to the kink */
            C = saved;
            t = t0;
            h = s.h;
            rk_control_stop(&C, t0 + theta * s.h, t, &h);
            continue;
        }
        for (i = 1; i <= inside; i++) {
            checked(rk_dense(&s, i / (inside + 1.), 0, &z), "rk_dense");
            *waveform_push(&r->past, t0 + (t - t0) * i / (inside + 1), 0) = z;
        }
        y = ynew;
        k[0] = k[T->stages - 1]; /* FSAL */
        keep(r, t, y, k[0], 0);
        if (met < kinks && P->where(t, y) >= kink[met] - NEAR) { /* a kink of the past has become one of y here */
            if (met < r->degree) {
                keep(r, t, y, k[0], WF_BREAK);
                kink[kinks++] = t;
            }
            met++;
        }
        rk_control_stop(&C, P->end, t, &h);
        *error = fmax(*error, fabs(y - P->exact(t)));
        steps++;
    }
    return steps;
}

int main(int argc, char **argv)
{
    static const char *const names[] = {"constant", "state", NULL};
    scene_option o[] = {
        {"problem", "constant", "constant, or state: a delay that depends on y"},
        {"tolerance", "1e-10", "of the steps, absolute and relative"},
        {"degree", "5", "of the past; from 2 on with slopes"},
        {"largest", "0.2", "step at most; 0: any"},
        {"strict", "1", "1: no read of what is not known yet, the step is repeated, shorter; 0: extrapolated"},
        {"inside", "0", "values of the dense output kept inside every step"},
        {NULL, NULL, NULL}};
    run r = {NULL, {NULL, NULL}, 0, 0, 0};
    double tol, error, inside_error = 0, v;
    int steps, i;
    scene_parse(argc, argv, "delay equations by Runge-Kutta steps and a waveform of the past", o);
    r.P = &problems[scene_choice(o, "problem", names)];
    tol = scene_perturbed("tolerance", scene_number(o, "tolerance", 1e-13, 1));
    r.degree = scene_integer(o, "degree", 1, WF_MAX_DEGREE);
    r.past = waveform_make(r.degree, 1, COLUMNS);
    checked(wf_strict(r.past.w, scene_integer(o, "strict", 0, 1)), "wf_strict");
    steps = integrate(&r, tol, scene_number(o, "largest", 0, 1e3), scene_integer(o, "inside", 0, INSIDE), &error);
    for (i = 0; i <= 1000; i++) {
        const double t = r.P->start + (r.P->end - r.P->start) * i / 1000;
        waveform_read(&r.past, t, 0, &v);
        inside_error = fmax(inside_error, fabs(v - r.P->exact(t)));
    }
    waveform_read(&r.past, r.P->end, 0, &v);
    printf("steps %d\nlowered %d\ny_end %.15g\nexact_y_end %.15g\n", steps, r.lowered, v, r.P->exact(r.P->end));
    printf("error_steps %.3e\nerror %.3e\n", error, inside_error);
    waveform_free(&r.past);
    return 0;
}
