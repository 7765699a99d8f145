/* SPDX-License-Identifier: MIT

   tube.c - flow through an elastic tube: strong added mass

   A one-dimensional incompressible flow (implicit Euler in time, 100 cells) in a tube whose wall answers at once to the
   pressure.  Fluid writes p, solid writes the cross section A; the fixed point A = S(F(A)) of every time step diverges
   under relaxation by more than a few per cent.  The equations and the logged reference run (846 iterations in 100 time
   windows) are those of the elastic-tube-1d tutorial of preCICE. */
#define IQN_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "../iqn.h"
#include "../waveform.h"
#include "scene.h"
#include <time.h>

#define CELLS 100
#define NODES (CELLS + 1)
#define BAND 5                    /* rows and unknowns are interleaved (v_i, p_i); the end conditions reach two nodes in */
#define LDAB (3 * BAND + 1)

extern void dgbsv_(const int *n, const int *kl, const int *ku, const int *nrhs, double *ab, const int *ldab, int *ipiv,
                   double *b, const int *ldb, int *info);

static const double PI = 3.14159265358979323846, DX = 0.1;
static double stiffness; /* c^2 = E / (2 r0), of the wall; the density is 1 */
static double DT;

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
        r[0] = 10 + 3 * sin(10 * PI * t) - y[0];
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

static double relative_change(const double *now, const double *before)
{
    double d = 0, s = 0;
    int i;
    for (i = 0; i < NODES; i++) {
        d += (now[i] - before[i]) * (now[i] - before[i]);
        s += now[i] * now[i];
    }
    return sqrt(d / s);
}

/* The logged reference run: iterations of windows 1 to 8, and of all 100. */
static const int published[8] = {20, 11, 10, 8, 8, 8, 8, 8}, published_total = 846;

int main(int argc, char **argv)
{
    static const char *const methods[] = {"constant", "aitken", "ils", "imvj", NULL};
    static const char *const settings[] = {"published", "kit", NULL};
    static const int filters[] = {IQN_NOFILTER, IQN_QR1, IQN_QR2, IQN_QR3};
    static const int method_of[] = {IQN_CONSTANT, IQN_AITKEN, IQN_ILS, IQN_IMVJ};
    scene_option o[] = {{"windows", "100", "time windows"},
                        {"dt", "0.01", "length of a window, one time step, in seconds"},
                        {"wall", "1", "factor on the stiffness of the wall"},
                        {"method", "ils", "constant, aitken, ils or imvj"},
                        {"settings", "published", "published, or kit: every default of iqn.h; then no method, reuse, filter, omega"},
                        {"reuse", "8", "past windows whose columns are kept; -1: the header's default"},
                        {"columns", "50", "secant pairs stored at most"},
                        {"qr", "2", "filter QR1, QR2 or QR3"},
                        {"filter", "1e-3", "limit of the filter"},
                        {"mixing", "1", "damping of the quasi-Newton step"},
                        {"omega", "0.01", "relaxation of the first iteration (of all, without quasi-Newton)"},
                        {"predict", "0", "first guess of a window: 0 constant, 1 linear, 2 quadratic in time"},
                        {"tol", "1e-5", "relative change of p and of A"},
                        {"most", "40", "iterations in a window at most"},
                        {"log", "", "write NAME-iterations.log and NAME-convergence.log"},
                        {NULL, NULL, NULL}};
    double v0[NODES], p0[NODES], A0[NODES], v[NODES], p[NODES], before[NODES], A[NODES], hA[NODES], tol, change_p, change_A,
        dropped = 0, past[5 * NODES], weight[5]; /* past: A at the end of the last windows, on the times of grid */
    int predict, windows, most, win, k, i, status, converged, total = 0, failed = 0, columns;
    FILE *iterations, *convergence;
    size_t bytes;
    iqn *q;
    wf *grid;

    scene_parse(argc, argv, "flow through an elastic tube, coupled implicitly in every time window", o);
    windows = scene_integer(o, "windows", 1, 1000000);
    columns = scene_integer(o, "columns", 1, 2000);
    predict = scene_integer(o, "predict", 0, 2);
    tol = scene_number(o, "tol", 1e-13, 1);
    most = scene_integer(o, "most", 1, 100000);
    bytes = iqn_size(NODES, columns, 1);
    status = iqn_make(&q, NODES, columns, 1, scene_memory(bytes), bytes);
    scene_check(status, iqn_message(status));
    if (scene_choice(o, "settings", settings) == 0) {
        iqn_set(q, IQN_METHOD, method_of[scene_choice(o, "method", methods)]);
        iqn_set(q, IQN_WINDOWS, scene_integer(o, "reuse", -1, 1000));
        iqn_set(q, IQN_FILTER, filters[scene_integer(o, "qr", 1, 3)]);
        iqn_set(q, IQN_MIXING, scene_number(o, "mixing", 1e-3, 2));
        iqn_set(q, IQN_EPSILON, scene_number(o, "filter", 0, 1));
        iqn_set(q, IQN_TIGHTEN, 0);
        iqn_set(q, IQN_OMEGA, scene_number(o, "omega", 1e-6, 2));
    }
    bytes = wf_size(2, 5);
    status = wf_make(&grid, 2, 5, scene_memory(bytes), bytes);
    scene_check(status, wf_message(status));
    iterations = scene_file(o, "log", "-iterations.log");
    convergence = scene_file(o, "log", "-convergence.log");
    if (iterations) fprintf(iterations, "TimeWindow TotalIterations Iterations Convergence QNColumns DeletedQNColumns\n");
    if (convergence) fprintf(convergence, "TimeWindow Iteration ResRel(p) ResRel(A)\n");

    DT = scene_number(o, "dt", 1e-9, 10);
    stiffness = scene_number(o, "wall", 1e-6, 1e6) * 5000 * sqrt(PI); /* E = 1e4, r0 = 1 / sqrt(pi) */
    for (i = 0; i < NODES; i++) {
        v0[i] = 10;
        p0[i] = 0;
        A0[i] = A[i] = 1;
    }
    memcpy(past + wf_push(grid, 0) * NODES, A, sizeof A);
    for (win = 1; win <= windows; win++) {
        memcpy(p, p0, sizeof p);
        for (k = 1, converged = 0; !converged && k <= most; k++) {
            memcpy(before, p, sizeof p);
            if (solve_fluid(v0, p0, A0, A, win * DT, v, p) != 0) {
                fprintf(stderr, "window %d iteration %d: the flow has no solution in this tube; the coupling diverges\n", win, k);
                return 1;
            }
            solve_solid(p, hA);
            change_p = relative_change(p, before);
            change_A = relative_change(hA, A);
            converged = change_p <= tol && change_A <= tol;
            if (convergence) fprintf(convergence, "%d %d %.16e %.16e\n", win, k, change_p, change_A);
            status = iqn_step(q, A, hA); /* also when converged: the last secant pair serves the next window */
            scene_check(status, iqn_message(status));
        }
        k--;
        total += k;
        failed += !converged;
        iqn_commit(q);
        if (iterations) {
            fprintf(iterations, "%d %d %d %d %g %g\n", win, total, k, converged, iqn_get(q, IQN_COLUMNS),
                    iqn_get(q, IQN_NDROPPED) - dropped);
            dropped = iqn_get(q, IQN_NDROPPED);
            fflush(iterations);
        }
        printf("window %d iterations %d\n", win, k);
        memcpy(v0, v, sizeof v);
        memcpy(p0, p, sizeof p);
        memcpy(A0, hA, sizeof A); /* the accepted answer ... */
        memcpy(past + wf_push(grid, win * DT) * NODES, hA, sizeof A);
        wf_predict(grid, predict, (win + 1) * DT, weight);
        wf_combine(1, wf_columns(grid), weight, NODES, past, NODES, A, NODES); /* ... and the first guess of the next */
        wf_advance(grid, 3, NODES, past, NODES);
    }
    for (i = 0; i < 8; i++) printf("published_window %d iterations %d\n", i + 1, published[i]);
    printf("published_total %d\nunconverged %d\ntotal %d\n", published_total, failed, total);
    return 0;
}
