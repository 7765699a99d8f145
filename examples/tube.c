/* SPDX-License-Identifier: MIT

   tube.c - flow through an elastic tube: strong added mass

   A one-dimensional incompressible flow (implicit Euler in time, 100 cells) in a tube whose wall answers at once to the
   pressure.  Fluid writes p, solid writes the cross section A; the fixed point A = S(F(A)) of every time step diverges
   under relaxation by more than a few per cent.  The equations and the logged reference run (846 iterations in 100 time
   windows) are those of the elastic-tube-1d tutorial of preCICE.  With --steps either side takes several time steps in a
   window and reads the other's waveform; a solid with fewer steps than the fluid needs --pressure mean. */
#define IQN_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "iqn.h"
#include "waveform.h"
#include "scene.h"

#define CELLS 100
#define NODES (CELLS + 1)
#define BAND 5                    /* rows and unknowns are interleaved (v_i, p_i); the end conditions reach two nodes in */
#define LDAB (3 * BAND + 1)

extern void dgbsv_(const int *n, const int *kl, const int *ku, const int *nrhs, double *ab, const int *ldab, int *ipiv,
                   double *b, const int *ldb, int *info);

static const double PI = 3.14159265358979323846, DX = 0.1;
static double stiffness; /* c^2 = E / (2 r0), of the wall; the density is 1 */
static double DT;        /* time step of the fluid */
static int inlet_step;   /* the velocity at the inlet, 10 at rest, then 10 + 3 sin(10 pi t), or 13 at once */

/* d row / d unknown, in LAPACK's band storage */
static void put(double *ab, int row, int unknown, double value)
{
    ab[2 * BAND + row - unknown + unknown * LDAB] += value;
}

/* The solid: A = A0 (2 c^2)^2 / (p - 2 c^2)^2, A0 = 1. */
static void solve_solid(const double *p, double *A)
{
    int i;
    for (i = 0; i < NODES; i++) A[i] = pow(2 * stiffness / (p[i] - 2 * stiffness), 2);
}

/* The fluid: one implicit Euler step from (v0, p0, A0) to time t in a tube of new cross section A; y = (v_i, p_i), i = 0... */
static int solve_fluid(const double *v0, const double *p0, const double *A0, const double *A, double t, double *v, double *p)
{
    const int n = 2 * NODES, kl = BAND, ku = BAND, one = 1, ldab = LDAB, N = CELLS;
    double y[2 * NODES], r[2 * NODES], ab[LDAB * 2 * NODES], rr, yy, am, ap, root;
    int pivot[2 * NODES], i, k, info;
    for (i = 0; i <= N; i++) {
        y[2 * i] = v0[i];
        y[2 * i + 1] = p0[i];
    }
    for (k = 0; k < 100; k++) {
        memset(ab, 0, sizeof ab);
        /* inlet: v_0 given, p_0 on the line through p_1 and p_2 */
        r[0] = 10 + 3 * (inlet_step ? 1 : sin(10 * PI * t)) - y[0];
        put(ab, 0, 0, 1);
        r[1] = 2 * y[3] - y[5] - y[1];
        put(ab, 1, 1, 1);
        put(ab, 1, 3, -2);
        put(ab, 1, 5, 1);
        for (i = 1; i < N; i++) {
            const double *V = y + 2 * i, *P = V + 1; /* V[-2], V[0], V[2] are the neighbours' and the own velocity */
            const int row = 2 * i, col = 2 * i;
            am = A[i] + A[i - 1];
            ap = A[i + 1] + A[i];
            r[row] = (v0[i] * A0[i] - V[0] * A[i]) * DX / DT +
                     0.25 * (-ap * V[0] * V[2] - ap * V[0] * V[0] + am * V[-2] * V[0] + am * V[-2] * V[-2] + am * P[-2] -
                             A[i - 1] * P[0] + A[i + 1] * P[0] - ap * P[2]);
            put(ab, row, col - 2, -0.25 * (am * V[0] + 2 * am * V[-2]));
            put(ab, row, col, A[i] * DX / DT - 0.25 * (-ap * V[2] - 2 * ap * V[0] + am * V[-2]));
            put(ab, row, col + 2, 0.25 * ap * V[0]);
            put(ab, row, col - 1, -0.25 * am);
            put(ab, row, col + 1, -0.25 * (A[i + 1] - A[i - 1]));
            put(ab, row, col + 3, 0.25 * ap);
            r[row + 1] = (A0[i] - A[i]) * DX / DT + 0.25 * (am * V[-2] + A[i - 1] * V[0] - A[i + 1] * V[0] - ap * V[2]);
            put(ab, row + 1, col - 2, -0.25 * am);
            put(ab, row + 1, col, -0.25 * (A[i - 1] - A[i + 1]));
            put(ab, row + 1, col + 2, 0.25 * ap);
        }
        /* outlet: v_N on the line through its neighbours, p_N lets the wave out */
        r[2 * N] = 2 * y[2 * N - 2] - y[2 * N - 4] - y[2 * N];
        put(ab, 2 * N, 2 * N, 1);
        put(ab, 2 * N, 2 * N - 2, -2);
        put(ab, 2 * N, 2 * N - 4, 1);
        root = sqrt(stiffness - p0[N] / 2) - (y[2 * N] - v0[N]) / 4;
        r[2 * N + 1] = 2 * (stiffness - root * root) - y[2 * N + 1];
        put(ab, 2 * N + 1, 2 * N + 1, 1);
        put(ab, 2 * N + 1, 2 * N, -root);

        for (rr = yy = 0, i = 0; i < n; i++) {
            rr += r[i] * r[i];
            yy += y[i] * y[i];
        }
        if (!(rr <= 1e300)) return -1;
        if (k >= 1 && rr < 1e-20 * yy) break;
        dgbsv_(&n, &kl, &ku, &one, ab, &ldab, pivot, r, &n, &info);
        if (info != 0) return -1;
        for (i = 0; i < n; i++) y[i] += r[i];
    }
    for (i = 0; i <= N; i++) {
        v[i] = y[2 * i];
        p[i] = y[2 * i + 1];
    }
    return k < 100 ? 0 : -1;
}

static double relative_change(int n, const double *now, const double *before)
{
    double d = 0, s = 0;
    int i;
    for (i = 0; i < n; i++) {
        d += (now[i] - before[i]) * (now[i] - before[i]);
        s += now[i] * now[i];
    }
    return sqrt(d / s);
}

/* Time of step j of n in the window that ends at t1; the last one is the window end to the bit. */
static double substep(double t1, double length, int j, int n)
{
    return j == n ? t1 : t1 - length * (n - j) / n;
}

/* The fluid over a window: v goes from v0 to the window end, p is written at every step. */
static int fluid(const double *v0, double *v, int steps, double t1, double length, const waveform *area, waveform *p)
{
    double before[NODES], A0[NODES], A[NODES], now[NODES], t;
    int j;
    wf_rollback(p->grid);
    memcpy(v, v0, NODES * sizeof *v);
    memcpy(now, waveform_begin(p), sizeof now);
    memcpy(A, waveform_begin(area), sizeof A);
    for (j = 1; j <= steps; j++) {
        t = substep(t1, length, j, steps);
        memcpy(before, now, sizeof now);
        memcpy(A0, A, sizeof A);
        waveform_interpolate(area, t, 0, A);
        if (solve_fluid(v, before, A0, A, t, v, now) != 0) return -1;
        memcpy(waveform_push(p, t), now, sizeof now);
    }
    return 0;
}

/* The solid over a window: the area at every one of its steps, one behind the other, from the pressure at the end of the
   step or from its mean over the step. */
static void solid(int steps, double t1, double length, int mean, const waveform *pressure, double *A)
{
    double p[NODES], t;
    int j;
    for (j = 1; j <= steps; j++) {
        t = substep(t1, length, j, steps);
        if (mean) waveform_mean(pressure, substep(t1, length, j - 1, steps), t, p);
        else waveform_interpolate(pressure, t, 0, p);
        solve_solid(p, A + (ptrdiff_t)(j - 1) * NODES);
    }
}

/* Knobs of iqn.h: the published run's values; with --settings kit the header's own stand, unless the option is given. */
static const struct knob {
    const char *name;
    int key;
    double published, low, high;
} knobs[] = {{"omega", IQN_OMEGA, 0.01, 0, 2},   {"reuse", IQN_WINDOWS, 8, -1, 1000}, {"filter", IQN_FILTER_LIMIT, 1e-3, 0, 1},
             {"mixing", IQN_MIXING, 1, 1e-3, 2}, {"growth", IQN_GROWTH, 0, 0, 1e30},  {"noise", IQN_NOISE_LEVEL, 1e-13, 0, 1},
             {"merge", IQN_MERGE, 0, 0, 1000}};

/* The logged reference run: iterations of windows 1 to 8, and of all 100. */
static const int published[8] = {20, 11, 10, 8, 8, 8, 8, 8}, published_total = 846;

/* What the counters mean, and what to change if one grows, stands beside the keys in iqn.h. */
static void print_counters(const iqn *q)
{
    static const struct {
        const char *name;
        int key;
    } row[] = {{"steps", IQN_NSTEPS},         {"dropped", IQN_NDROPPED},     {"full", IQN_NFULL},
               {"zero", IQN_NZERO},           {"relaxed", IQN_NRELAXED},     {"withdrawn", IQN_NWITHDRAWN},
               {"refused", IQN_NREFUSED},     {"stalled", IQN_NSTALLED},     {"sums", IQN_NSUMS},
               {"pairs", IQN_PAIRS},          {"omega", IQN_OMEGA_NOW},      {"residual", IQN_RESIDUAL},
               {"reduction", IQN_REDUCTION},  {"relative", IQN_RELATIVE},    {"best", IQN_BEST_RELATIVE},
               {"predicted", IQN_PREDICTED}};
    size_t i;
    for (i = 0; i < sizeof row / sizeof *row; i++) printf("counter %s %g\n", row[i].name, iqn_get(q, row[i].key));
}

int main(int argc, char **argv)
{
    static const char *const methods[] = {"constant", "aitken", "ils", "imvj", NULL};
    static const char *const settings[] = {"published", "kit", NULL};
    static const char *const weights[] = {"all", "end", NULL};
    static const char *const guesses[] = {"0", "1", "2", "3", "4", "5", "6", "auto", NULL};
    static const char *const pressures[] = {"end", "mean", NULL};
    static const char *const inlets[] = {"sine", "step", NULL};
    static const int method_of[] = {IQN_CONSTANT, IQN_AITKEN, IQN_ILS, IQN_IMVJ};
    scene_option o[] = {{"windows", "100", "time windows"},
                        {"dt", "0.01", "length of a window in seconds"},
                        {"steps", "1,1", "time steps of fluid,solid in a window"},
                        {"degree", "", "of the waveforms between the steps; 1, or with --pressure mean 2, of the area"},
                        {"pressure", "end", "that the solid gets: at the end of its step, or the mean over it"},
                        {"inlet", "sine", "velocity at the inlet: sine, or step: at once 3 more"},
                        {"wall", "1", "factor on the stiffness of the wall over the density of the fluid"},
                        {"settings", "published", "published, or kit: the defaults of iqn.h for what is not given below"},
                        {"method", "ils", "constant, aitken, ils or imvj"},
                        {"columns", "50", "secant pairs stored at most"},
                        {"weigh", "all", "samples in the least squares: all, or end: the window end"},
                        {"reuse", "", "past windows whose columns are kept; -1: the header's choice"},
                        {"filter", "", "limit of the filter QR2; 0: by uncertainty"},
                        {"mixing", "", "mixing factor of the quasi-Newton step"},
                        {"omega", "", "relaxation of the first iteration (of all, without quasi-Newton)"},
                        {"growth", "", "take back steps that raised the residual more than so many times; 0: never"},
                        {"noise", "", "relative error of the solvers"},
                        {"merge", "", "of imvj: windows until past pairs become one problem; 0: never"},
                        {"predict", "0", "first guess of a window: degree in time, 0 to 6, or auto: by hindsight"},
                        {"tol", "1e-5", "relative change of p and of A"},
                        {"most", "40", "iterations in a window at most"},
                        {"counters", "0", "1: print what iqn.h has counted, and its last step"},
                        {"log", "", "write NAME-iterations.log and NAME-convergence.log"},
                        {NULL, NULL, NULL}};
    double v0[NODES], v[NODES], *before, *hA, *times, *x, length, tol, t1, change_p, change_A, dropped = 0;
    int predict, windows, most, columns, degree, history, kit, mean, steps[2], fluids, solids, win, k, j;
    int status, converged, total = 0, failed = 0;
    size_t bytes, sent, answered;
    FILE *iterations, *convergence;
    waveform p, A;
    iqn *q;

    scene_parse(argc, argv, "flow through an elastic tube, coupled implicitly in every time window", o);
    windows = scene_integer(o, "windows", 1, 1000000);
    length = scene_number(o, "dt", 1e-9, 10);
    inlet_step = scene_choice(o, "inlet", inlets);
    mean = scene_choice(o, "pressure", pressures);
    degree = *scene_text(o, "degree") ? scene_integer(o, "degree", 1, WF_MAX_DEGREE) : 1 + mean;
    stiffness = scene_number(o, "wall", 1e-6, 1e6) * 5000 * sqrt(PI); /* E = 1e4, r0 = 1 / sqrt(pi) */
    stiffness = scene_perturbed("wall", stiffness);
    columns = scene_integer(o, "columns", 1, 2000);
    predict = scene_choice(o, "predict", guesses);
    if (predict > 6) predict = WF_AUTO;
    tol = scene_number(o, "tol", 1e-13, 1);
    most = scene_integer(o, "most", 1, 100000);
    kit = scene_choice(o, "settings", settings);
    scene_integers(o, "steps", 1, 1000, steps);
    fluids = steps[0], solids = steps[1];
    DT = length / fluids;
    iterations = scene_file(o, "log", "-iterations.log");
    convergence = scene_file(o, "log", "-convergence.log");
    if (iterations) fprintf(iterations, "TimeWindow TotalIterations Iterations Convergence QNColumns DeletedQNColumns\n");
    if (convergence) fprintf(convergence, "TimeWindow Iteration ResRel(p) ResRel(A)\n");

    history = predict > 2 ? predict : 2; /* windows that stay for the first guess; with the mean one makes the area quadratic */
    if (predict == WF_AUTO) history = 8;
    if (mean) history = 1;
    p = waveform_make(mean ? 0 : degree, NODES, (history + 1) * fluids + 1);
    A = waveform_make(degree, NODES, (history + 1) * solids + 1);
    waveform_push(&p, 0);
    x = waveform_push(&A, 0);
    for (j = 0; j < NODES; j++) x[j] = 1;
    sent = (size_t)fluids * NODES * sizeof(double);
    answered = (size_t)solids * NODES * sizeof(double);
    before = (double *)scene_memory(sent);
    hA = (double *)scene_memory(answered);
    times = (double *)scene_memory((size_t)solids * sizeof(double));
    for (j = 0; j < NODES; j++) v0[j] = 10;

    bytes = iqn_size(NODES * solids, columns, solids); /* a block for every sample of the area */
    status = iqn_make(&q, NODES * solids, columns, solids, scene_memory(bytes), bytes);
    scene_check(status, iqn_message(status));
    iqn_set(q, IQN_METHOD, method_of[scene_choice(o, "method", methods)]);
    for (j = 0; j < (int)(sizeof knobs / sizeof *knobs); j++)
        if (*scene_text(o, knobs[j].name))
            iqn_set(q, knobs[j].key, scene_number(o, knobs[j].name, knobs[j].low, knobs[j].high));
        else if (!kit) iqn_set(q, knobs[j].key, knobs[j].published);
    for (j = 0; j < solids - 1 && scene_choice(o, "weigh", weights) == 1; j++) iqn_set_block(q, j, IQN_WEIGHT, 0);

    for (win = 1; win <= windows; win++) {
        t1 = win * length;
        for (j = 0; j < solids; j++) times[j] = substep(t1, length, j + 1, solids);
        status = wf_begin(A.grid, predict, solids, times, NODES, A.x, NODES);
        scene_check(status, wf_message(status));
        x = waveform_begin(&A) + NODES;
        for (j = 0; j < fluids; j++)
            memcpy(before + j * NODES, waveform_begin(&p), NODES * sizeof(double));
        for (k = 0, converged = 0; !converged && k < most; k++) {
            const double *new_p = waveform_begin(&p) + NODES;
            if (fluid(v0, v, fluids, t1, length, &A, &p) != 0) {
                fprintf(stderr, "window %d iteration %d: the flow has no solution in this tube; the coupling diverges\n", win,
                        k + 1);
                return 1;
            }
            solid(solids, t1, length, mean, &p, hA);
            change_p = relative_change(fluids * NODES, new_p, before);
            change_A = relative_change(solids * NODES, hA, x);
            memcpy(before, new_p, sent);
            converged = change_p <= tol && change_A <= tol;
            if (convergence) fprintf(convergence, "%d %d %.16e %.16e\n", win, k + 1, change_p, change_A);
            status = iqn_step(q, x, hA); /* also when converged: the last secant pair serves the next window */
            scene_check(status, iqn_message(status));
        }
        total += k;
        failed += !converged;
        iqn_commit(q);
        if (iterations) {
            fprintf(iterations, "%d %d %d %d %g %g\n", win, total, k, converged, iqn_get(q, IQN_PAIRS),
                    iqn_get(q, IQN_NDROPPED) - dropped);
            dropped = iqn_get(q, IQN_NDROPPED);
            fflush(iterations);
        }
        printf("window %d iterations %d\n", win, k);
        memcpy(v0, v, sizeof v);
        memcpy(x, hA, answered); /* the accepted answer, and from it the first guess of the next window */
        waveform_advance(&A, history * solids);
        waveform_advance(&p, history * fluids);
    }
    for (j = 0; j < 8; j++) printf("published_window %d iterations %d\n", j + 1, published[j]);
    printf("published_total %d\nunconverged %d\ntotal %d\n", published_total, failed, total);
    if (scene_integer(o, "counters", 0, 1)) print_counters(q);
    return 0;
}
