/* SPDX-License-Identifier: MIT

   oscillator.c - two masses between three springs, one solver each, with different time steps

       m1 u1'' + (k1 + k12) u1 = k12 u2(t)     side A: an explicit Runge-Kutta table
       m2 u2'' + (k2 + k12) u2 = k12 u1(t)     side B: generalized-alpha

   Each window is iterated until both displacements at its end stand still; in between, each side reads the other's
   waveform.  Exact: u1,2 = (cos 2 pi t +- cos 6 pi t)/2.  The set-up and the published errors are those of Rodenberg and
   Uekermann, arXiv 2511.07616 (2025), and Schueller et al. (2022). */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include "scene.h"

#define PI 3.14159265358979323846
#define K12 (16 * PI * PI) /* the spring between the masses */
#define K (20 * PI * PI)   /* a mass's own two springs, k1 + k12 = k2 + k12; both masses are 1 */

static double exact(int side, double t)
{
    return 0.5 * (cos(2 * PI * t) + (side ? -1 : 1) * cos(6 * PI * t));
}

/* ---- the two solvers: one sub-step of length h from t, the other's displacement read from its waveform ---- */

static int per = 1; /* columns of a sample: 2 with the time derivative, which a solver has for nothing */

static void write_sample(waveform *w, double t, double u, double v)
{
    double *column = per == 2 ? waveform_push_hermite(w, t) : waveform_push(w, t);
    column[0] = u;
    if (per == 2) column[1] = v;
}

static double value(const waveform *w, double t)
{
    double u;
    waveform_eval(w, t, 0, &u);
    return u;
}

typedef struct mass {
    double u, v, a;
} mass;

static const rk_table *table; /* of side A */

static void runge_kutta(mass *m, double t, double h, const waveform *other)
{
    double k[2 * RK_STAGES_MAX], y[2], z[2];
    int i;
    y[0] = m->u;
    y[1] = m->v;
    for (i = 0; i < table->stages; i++) {
        rk_stage(table, i, h, 2, y, k, 2, z);
        k[2 * i] = z[1];
        k[2 * i + 1] = K12 * value(other, t + table->c[i] * h) - K * z[0];
    }
    rk_finish(table, h, 2, y, k, 2, y, NULL);
    m->u = y[0];
    m->v = y[1];
}

static void generalized_alpha(mass *m, double t, double h, const waveform *other)
{
    const double af = 0.4, am = 0.2, gamma = 0.5 - am + af;
    const double beta = (gamma + 0.5) / 4; /* without the square of Chung and Hulbert's: kept, for the published digits */
    const double m0 = (1 - am) / (beta * h * h), m1 = (1 - am) / (beta * h), m2 = (1 - am - 2 * beta) / (2 * beta);
    double f = K12 * value(other, t + (1 - af) * h);
    double u = (f - af * K * m->u + m0 * m->u + m1 * m->v + m2 * m->a) / (K * (1 - af) + m0);
    double a = (u - m->u - h * m->v) / (beta * h * h) - (1 - 2 * beta) / (2 * beta) * m->a;
    m->v += h * ((1 - gamma) * m->a + gamma * a);
    m->u = u;
    m->a = a;
}

/* ---- one side: it solves a window from its start, as often as it is asked to ---- */

typedef struct side {
    void (*step)(mass *m, double t, double h, const waveform *other);
    mass start, now;
    int steps, every; /* sub-steps in a window; write all of them, or the last one only */
    double *u;        /* displacement after every sub-step */
    waveform out;
} side;

/* Time of sub-step j of n in the window [t0, t1]; the last one is the window end to the bit. */
static double substep(double t0, double t1, int j, int n)
{
    return j == n ? t1 : t0 + j * ((t1 - t0) / n);
}

static side side_make(void (*step)(mass *, double, double, const waveform *), double u, double u_other, int steps,
                      int every, waveform out)
{
    side s;
    s.step = step;
    s.start.u = u;
    s.start.v = 0;
    s.start.a = K12 * u_other - K * u;
    s.now = s.start;
    s.steps = steps;
    s.every = every;
    s.u = (double *)scene_memory((size_t)(steps + 1) * sizeof(double));
    s.out = out;
    write_sample(&s.out, 0, u, 0);
    return s;
}

static void solve(side *s, double t0, double t1, const waveform *other)
{
    int j;
    s->now = s->start;
    wf_rollback(s->out.grid);
    for (j = 1; j <= s->steps; j++) {
        s->step(&s->now, substep(t0, t1, j - 1, s->steps), (t1 - t0) / s->steps, other);
        s->u[j] = s->now.u;
        if (s->every || j == s->steps) write_sample(&s->out, substep(t0, t1, j, s->steps), s->now.u, s->now.v);
    }
}

/* ---- results ---- */

/* The largest error at the sub-steps of a window; with a file, also a line for each. */
static double error(const side *s, int which, double t0, double t1, FILE *csv)
{
    double worst = 0, t;
    int j;
    for (j = 1; j <= s->steps; j++) {
        t = substep(t0, t1, j, s->steps);
        worst = fmax(worst, fabs(s->u[j] - exact(which, t)));
        if (csv) fprintf(csv, "%c,%.15g,%.15g,%.15g\n", 'A' + which, t, s->u[j], exact(which, t));
    }
    return worst;
}

/* Published errors: linear with window ends only, piecewise linear, cubic; then the rows of fourth order (e_A alone). */
static const struct {
    double window;
    int na, nb, substeps, degree;
    double e_A, e_B;
} published[] = {
    {0.2, 5, 100, 0, 1, 3.3437602237727053, 1.7357639088739552},
    {0.1, 5, 100, 0, 1, 0.5338006703088117, 0.4833555656170415},
    {0.05, 5, 100, 0, 1, 0.1508046698839, 0.155182751074555},
    {0.2, 5, 100, 1, 1, 0.050868037767638, 0.0509483467981368},
    {0.1, 5, 100, 1, 1, 0.0125680395524709, 0.0121802269844953},
    {0.05, 5, 100, 1, 1, 0.0031251194477872, 0.0030022001419111},
    {0.2, 5, 100, 1, 3, 0.0044898733576939, 0.0044894317643563},
    {0.1, 5, 100, 1, 3, 0.0003007235641515, 0.0003146352046766},
    {0.05, 5, 100, 1, 3, 3.28319292609e-05, 3.15984740062e-05},
    {0.1, 4, 32, 1, 3, 0.0012254505376257, 0},
    {0.05, 4, 64, 1, 3, 7.717328726419836e-05, 0},
    {0.025, 4, 128, 1, 3, 4.825699073562895e-06, 0},
};

int main(int argc, char **argv)
{
    static const char *const accelerations[] = {"none", "ils", "reduced", NULL};
    enum { NONE, ILS, REDUCED };
    enum { MOST = 200 };
    scene_option o[] = {{"window", "0.2", "length of a time window"},
                        {"end", "1", "end of the time, a whole number of windows"},
                        {"degree", "3", "of the waveforms, 0 to 9"},
                        {"substeps", "1", "1: write every sub-step, 0: the window end only"},
                        {"na", "5", "sub-steps of side A in a window"},
                        {"nb", "100", "sub-steps of side B in a window"},
                        {"table", "rk4", "Runge-Kutta table of side A, any explicit one of rk.h"},
                        {"tol", "1e-10", "relative change of both displacements at the window end"},
                        {"acceleration", "none", "none, ils (all samples) or reduced (the window end decides)"},
                        {"history", "0", "samples of earlier windows that a waveform keeps"},
                        {"predict", "0", "first guess of a window: degree in time, 0 to 9, as far as the history reaches"},
                        {"hermite", "0", "1: samples with their time derivative"},
                        {"log", "", "write NAME.csv, NAME-iterations.log, NAME-convergence.log"},
                        {NULL, NULL, NULL}};
    double window, end, tol, t0, t1, before, change_A, change_B, e_A = 0, e_B = 0, *x, *hx, *times;
    int degree, every, na, nb, acceleration, history, predict, hermite, windows; /* options */
    int samples, n, win, k, j, status, converged, total = 0;
    side A, B;
    iqn *q;
    size_t bytes;
    FILE *csv, *iterations, *convergence;

    scene_parse(argc, argv, "two masses, one solver each, coupled by waveform iteration", o);
    window = scene_number(o, "window", 1e-4, 1);
    end = scene_number(o, "end", 1e-4, 1e4);
    windows = (int)(end / window + 0.5);
    if (fabs(windows * window - end) > 1e-9 * end) {
        fprintf(stderr, "--window %g does not divide %g\n", window, end);
        return 2;
    }
    table = rk_find(scene_text(o, "table"));
    if (!table || !rk_is(table, RK_EXPLICIT)) {
        fprintf(stderr, "--table %s is not an explicit table of rk.h\n", scene_text(o, "table"));
        return 2;
    }
    degree = scene_integer(o, "degree", 0, 9);
    every = scene_integer(o, "substeps", 0, 1);
    na = scene_integer(o, "na", 1, 100000);
    nb = scene_integer(o, "nb", 1, 100000);
    tol = scene_number(o, "tol", 1e-15, 1);
    acceleration = scene_choice(o, "acceleration", accelerations);
    history = scene_integer(o, "history", 0, 100);
    predict = scene_integer(o, "predict", 0, 9);
    hermite = scene_integer(o, "hermite", 0, 1);
    csv = scene_file(o, "log", ".csv");
    iterations = scene_file(o, "log", "-iterations.log");
    convergence = scene_file(o, "log", "-convergence.log");
    if (csv) fprintf(csv, "side,t,u,exact\n");
    if (iterations) fprintf(iterations, "TimeWindow TotalIterations Iterations Convergence QNColumns\n");
    if (convergence) fprintf(convergence, "TimeWindow Iteration ResRel(u1) ResRel(u2)\n");

    per = hermite ? 2 : 1;
    A = side_make(runge_kutta, scene_perturbed("A", 1), 0, na, every,
                  waveform_make(degree, 1, per * (na + 1 + history)));
    B = side_make(generalized_alpha, 0, scene_perturbed("A", 1), nb, every,
                  waveform_make(degree, 1, per * (nb + 1 + history)));

    samples = every ? nb : 1; /* the unknowns: what B writes in a window */
    n = samples * per;
    x = (double *)scene_memory((size_t)n * sizeof(double));
    times = (double *)scene_memory((size_t)samples * sizeof(double));
    bytes = iqn_size(n, 20, 2);
    status = iqn_make(&q, n, 20, 2, scene_memory(bytes), bytes);
    scene_check(status, iqn_message(status));
    iqn_set(q, IQN_METHOD, acceleration == NONE ? IQN_CONSTANT : IQN_ILS);
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set_block(q, 0, IQN_LENGTH, n - per);
    iqn_set_block(q, 1, IQN_LENGTH, per);
    iqn_set_block(q, 0, IQN_WEIGHT, acceleration != REDUCED); /* reduced: the samples before the window end follow */

    for (win = 0; win < windows; win++) {
        t0 = win * window;
        t1 = win == windows - 1 ? end : (win + 1) * window;
        for (j = 1; j <= samples; j++) times[j - 1] = substep(t0, t1, j, samples);
        status = (hermite ? wf_begin_hermite : wf_begin)(B.out.grid, predict, samples, times, 1, B.out.x, 1);
        scene_check(status, wf_message(status));
        hx = waveform_begin(&B.out) + per; /* behind the window start, which stays */
        for (k = 0, converged = 0; !converged && k < MOST; k++) {
            before = A.now.u;
            memcpy(x, hx, (size_t)n * sizeof(double));
            waveform_fit(&B.out);
            solve(&A, t0, t1, &B.out);
            waveform_fit(&A.out);
            solve(&B, t0, t1, &A.out); /* hx = H(x) */
            change_A = fabs(A.now.u - before) / fabs(A.now.u);
            change_B = fabs(B.now.u - x[n - per]) / fabs(B.now.u);
            converged = change_A <= tol && change_B <= tol;
            if (convergence) fprintf(convergence, "%d %d %.6e %.6e\n", win + 1, k + 1, change_A, change_B);
            status = iqn_step(q, x, hx);
            scene_check(status, iqn_message(status));
            if (!converged) memcpy(hx, x, (size_t)n * sizeof(double)); /* A reads the next x */
        }
        total += k;
        if (iterations)
            fprintf(iterations, "%d %d %d %d %g\n", win + 1, total, k, converged, iqn_get(q, IQN_PAIRS));
        e_A = fmax(e_A, error(&A, 0, t0, t1, csv));
        e_B = fmax(e_B, error(&B, 1, t0, t1, csv));
        iqn_commit(q);
        waveform_advance(&A.out, history);
        waveform_advance(&B.out, history);
        A.start = A.now;
        B.start = B.now;
    }

    for (j = 0; j < (int)(sizeof published / sizeof published[0]); j++)
        if (fabs(window - published[j].window) < 1e-12 && na == published[j].na && nb == published[j].nb &&
            every == published[j].substeps && degree == published[j].degree && !history && !hermite && end == 1 &&
            table == rk_find("rk4")) {
            printf("published_e_A %.16g\n", published[j].e_A);
            if (published[j].e_B > 0) printf("published_e_B %.16g\n", published[j].e_B);
        }
    printf("e_A %.16g\ne_B %.16g\niterations %.4g\n", e_A, e_B, (double)total / windows);
    return 0;
}
