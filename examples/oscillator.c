/* SPDX-License-Identifier: MIT

   oscillator.c - two masses between three springs, one solver each, with different time steps

       m1 u1'' + (k1 + k12) u1 = k12 u2(t)     side A: classical Runge-Kutta 4
       m2 u2'' + (k2 + k12) u2 = k12 u1(t)     side B: generalized-alpha

   Each window is iterated until both displacements at its end stand still; in between, each side reads the other's
   waveform.  Exact: u1,2 = (cos 2 pi t +- cos 6 pi t)/2.  The set-up and the published errors are those of Rodenberg and
   Uekermann, arXiv 2511.07616 (2025), and Schueller et al. (2022). */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "../waveform.h"
#include "../iqn.h"
#include "../rk.h"
#include "scene.h"

#define PI 3.14159265358979323846
#define K12 (16 * PI * PI) /* the spring between the masses */
#define K (20 * PI * PI)   /* a mass's own two springs, k1 + k12 = k2 + k12; both masses are 1 */

/* What one side writes: its time grid, its samples and their spline coefficients.  With Hermite data every sample is two
   columns, the displacement and its time derivative; a Runge-Kutta host has that for nothing. */
typedef struct waveform {
    wf *grid;
    int hermite;
    double *sample, *coefficient;
} waveform;

typedef struct mass {
    double u, v, a;
} mass;

static double exact(int side, double t)
{
    return 0.5 * (cos(2 * PI * t) + (side ? -1 : 1) * cos(6 * PI * t));
}

static void write_sample(waveform *w, double t, double u, double v)
{
    int column = w->hermite ? wf_push_hermite(w->grid, t) : wf_push(w->grid, t);
    scene_check(column, wf_message(column));
    w->sample[column] = u;
    if (w->hermite) w->sample[column + 1] = v;
}

static void waveform_make(waveform *w, int degree, int columns, int hermite, const mass *m)
{
    size_t bytes = wf_size(degree, columns);
    int status = wf_make(&w->grid, degree, columns, scene_memory(bytes), bytes);
    scene_check(status, wf_message(status));
    w->hermite = hermite;
    w->sample = (double *)scene_memory((size_t)columns * sizeof(double));
    w->coefficient = (double *)scene_memory((size_t)columns * sizeof(double));
    write_sample(w, 0, m->u, m->v);
}

/* The columns behind the window start: what changes from iteration to iteration. */
static int unknowns(const waveform *w, double **first)
{
    int start = wf_start(w->grid) + (w->hermite ? 2 : 1);
    *first = w->sample + start;
    return wf_columns(w->grid) - start;
}

static void fit(waveform *w)
{
    int status = wf_fit(w->grid, 1, w->sample, 1, w->coefficient, 1);
    scene_check(status, wf_message(status));
}

static double value(const waveform *w, double t)
{
    double u = 0;
    int status = wf_eval(w->grid, t, 0, 1, w->coefficient, 1, &u);
    scene_check(status, wf_message(status));
    return u;
}

/* Time of sub-step j of n in the window [t0, t1]; the last one is the window end to the bit. */
static double substep(double t0, double t1, int j, int n)
{
    return j == n ? t1 : t0 + j * ((t1 - t0) / n);
}

/* From t0 to t1 in n sub-steps: u[j] becomes the displacement at sub-step j, out the waveform of the samples written
   (at every sub-step, or at the window end only). */
static void solve_A(mass *m, double t0, double t1, int n, int every, const waveform *in, waveform *out, double *u)
{
    const rk_table *T = rk_find("rk4");
    double k[4 * 2], y[2], z[2], t, h = (t1 - t0) / n;
    int i, j;
    y[0] = m->u;
    y[1] = m->v;
    for (j = 1; j <= n; j++) {
        t = substep(t0, t1, j - 1, n);
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 2, y, k, 2, z);
            k[2 * i] = z[1];
            k[2 * i + 1] = K12 * value(in, t + T->c[i] * h) - K * z[0];
        }
        rk_finish(T, h, 2, y, k, 2, y, NULL);
        u[j] = y[0];
        if (every || j == n) write_sample(out, substep(t0, t1, j, n), y[0], y[1]);
    }
    m->u = y[0];
    m->v = y[1];
}

/* The same for side B.  beta lacks the square of Chung and Hulbert's: kept, for the published digits. */
static void solve_B(mass *m, double t0, double t1, int n, int every, const waveform *in, waveform *out, double *u)
{
    const double af = 0.4, am = 0.2, gamma = 0.5 - am + af, beta = (gamma + 0.5) / 4, h = (t1 - t0) / n;
    const double m0 = (1 - am) / (beta * h * h), m1 = (1 - am) / (beta * h), m2 = (1 - am - 2 * beta) / (2 * beta);
    double f, un, an;
    int j;
    for (j = 1; j <= n; j++) {
        f = K12 * value(in, substep(t0, t1, j - 1, n) + (1 - af) * h);
        un = (f - af * K * m->u + m0 * m->u + m1 * m->v + m2 * m->a) / (K * (1 - af) + m0);
        an = (un - m->u - h * m->v) / (beta * h * h) - (1 - 2 * beta) / (2 * beta) * m->a;
        m->v += h * ((1 - gamma) * m->a + gamma * an);
        m->u = un;
        m->a = an;
        u[j] = un;
        if (every || j == n) write_sample(out, substep(t0, t1, j, n), un, m->v);
    }
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
    scene_option o[] = {{"window", "0.2", "length of a time window; a whole number of them makes 1"},
                        {"degree", "3", "of the waveforms, 0 to 9"},
                        {"substeps", "1", "1: write every sub-step, 0: the window end only"},
                        {"na", "5", "sub-steps of side A in a window"},
                        {"nb", "100", "sub-steps of side B in a window"},
                        {"tol", "1e-10", "relative change of both displacements at the window end"},
                        {"acceleration", "none", "none, ils (all samples) or reduced (the window end decides)"},
                        {"history", "0", "samples of earlier windows that a waveform keeps"},
                        {"hermite", "0", "1: samples with their time derivative"},
                        {"log", "", "write NAME.csv, NAME-iterations.log, NAME-convergence.log"},
                        {NULL, NULL, NULL}};
    double window, tol, t0, t1, before, change_A, change_B, e_A = 0, e_B = 0, *uA, *uB, *x, *hx;
    mass A = {1, 0, 0}, B = {0, 0, 0}, A0, B0;
    waveform wA, wB;
    iqn *q = NULL;
    size_t bytes;
    FILE *csv, *iterations, *convergence;
    int degree, every, na, nb, m, per, acceleration, history, hermite, windows, win, k, j, status, converged, total = 0;

    scene_parse(argc, argv, "two masses, one solver each, coupled by waveform iteration", o);
    window = scene_number(o, "window", 1e-4, 1);
    degree = scene_integer(o, "degree", 0, 9);
    every = scene_integer(o, "substeps", 0, 1);
    na = scene_integer(o, "na", 1, 100000);
    nb = scene_integer(o, "nb", 1, 100000);
    tol = scene_number(o, "tol", 1e-15, 1);
    acceleration = scene_choice(o, "acceleration", accelerations);
    history = scene_integer(o, "history", 0, 100);
    hermite = scene_integer(o, "hermite", 0, 1);
    windows = (int)(1 / window + 0.5);
    if (fabs(windows * window - 1) > 1e-9) {
        fprintf(stderr, "--window %g does not divide 1\n", window);
        return 2;
    }
    csv = scene_file(o, "log", ".csv");
    iterations = scene_file(o, "log", "-iterations.log");
    convergence = scene_file(o, "log", "-convergence.log");
    if (csv) fprintf(csv, "side,t,u,exact\n");
    if (iterations) fprintf(iterations, "TimeWindow TotalIterations Iterations Convergence QNColumns\n");
    if (convergence) fprintf(convergence, "TimeWindow Iteration ResRel(u1) ResRel(u2)\n");

    per = hermite ? 2 : 1;    /* columns of a sample */
    m = (every ? nb : 1);     /* samples that B writes in a window */
    uA = (double *)scene_memory((size_t)(na + 1) * sizeof(double));
    uB = (double *)scene_memory((size_t)(nb + 1) * sizeof(double));
    x = (double *)scene_memory((size_t)(m * per) * sizeof(double));
    A.a = K12 * B.u - K * A.u;
    B.a = K12 * A.u - K * B.u;
    waveform_make(&wA, degree, (na + 1 + history) * per, hermite, &A);
    waveform_make(&wB, degree, (nb + 1 + history) * per, hermite, &B);
    if (acceleration != NONE) {
        bytes = iqn_size(m * per, 20, 2);
        status = iqn_make(&q, m * per, 20, 2, scene_memory(bytes), bytes);
        scene_check(status, iqn_message(status));
        iqn_set(q, IQN_OMEGA, 1);
        if (acceleration == REDUCED) { /* the window end decides, the samples before it follow */
            iqn_set_block(q, 0, IQN_LENGTH, (m - 1) * per);
            iqn_set_block(q, 1, IQN_LENGTH, per);
            iqn_set_block(q, 0, IQN_WEIGHT, 0);
        }
    }

    for (win = 0; win < windows; win++) {
        t0 = win * window;
        t1 = win == windows - 1 ? 1 : (win + 1) * window;
        A0 = A;
        B0 = B;
        for (j = 1; j <= m; j++) write_sample(&wB, substep(t0, t1, j, m), B.u, 0); /* first guess: constant */
        for (k = 1, converged = 0; !converged && k <= MOST; k++) {
            before = A.u;
            A = A0;
            B = B0;
            fit(&wB);
            unknowns(&wB, &hx);
            memcpy(x, hx, (size_t)(m * per) * sizeof(double)); /* what A reads; B overwrites it with H of it */
            wf_rollback(wA.grid);
            solve_A(&A, t0, t1, na, every, &wB, &wA, uA);
            fit(&wA);
            wf_rollback(wB.grid);
            solve_B(&B, t0, t1, nb, every, &wA, &wB, uB);
            change_A = fabs(A.u - before) / fabs(A.u);
            change_B = fabs(B.u - x[(m - 1) * per]) / fabs(B.u);
            converged = change_A <= tol && change_B <= tol;
            if (convergence) fprintf(convergence, "%d %d %.6e %.6e\n", win + 1, k, change_A, change_B);
            if (q) {
                status = iqn_step(q, x, hx);
                scene_check(status, iqn_message(status));
                if (!converged) memcpy(hx, x, (size_t)(m * per) * sizeof(double));
            }
        }
        k--;
        total += k;
        if (iterations)
            fprintf(iterations, "%d %d %d %d %d\n", win + 1, total, k, converged, q ? (int)iqn_get(q, IQN_COLUMNS) : 0);
        if (q) iqn_commit(q);
        for (j = 1; j <= na; j++) {
            before = substep(t0, t1, j, na);
            e_A = fmax(e_A, fabs(uA[j] - exact(0, before)));
            if (csv) fprintf(csv, "A,%.15g,%.15g,%.15g\n", before, uA[j], exact(0, before));
        }
        for (j = 1; j <= nb; j++) {
            before = substep(t0, t1, j, nb);
            e_B = fmax(e_B, fabs(uB[j] - exact(1, before)));
            if (csv) fprintf(csv, "B,%.15g,%.15g,%.15g\n", before, uB[j], exact(1, before));
        }
        wf_advance(wA.grid, history, 1, wA.sample, 1);
        wf_advance(wB.grid, history, 1, wB.sample, 1);
    }

    for (j = 0; j < (int)(sizeof published / sizeof published[0]); j++)
        if (fabs(window - published[j].window) < 1e-12 && na == published[j].na && nb == published[j].nb &&
            every == published[j].substeps && degree == published[j].degree && !history && !hermite) {
            printf("published_e_A %.16g\n", published[j].e_A);
            if (published[j].e_B > 0) printf("published_e_B %.16g\n", published[j].e_B);
        }
    printf("e_A %.16g\ne_B %.16g\niterations %.4g\n", e_A, e_B, (double)total / windows);
    return 0;
}
