/* SPDX-License-Identifier: MIT

   trapezoid.c - the trapezoidal rule on both sides of three couplings: order 1, 1 and 2, and who stays stable

   Two masses, each on a spring k to the wall and on a spring c to the other one, u' = v, v' = -(k + c) u + c w, where w is
   the other's u.  Either side takes one step of the trapezoidal rule in a window, which has order 2 and keeps the energy.
   What is left of that depends on what a side reads of the other:

       explicit   the value at the window's start, for the whole step; one pass       degree 0, the first guess
       implicit   the value at the window's end, for the whole step; iterated         degree 0
       waveform   the line between the two; iterated                                  degree 1

   The waveform gives the trapezoidal rule of both masses together.  Printed: the error at the end against the closed form
   and its order, iterations of a window, and the largest |eigenvalue| of a window's map of (u, v) of both, which is 1 for the
   exact solution: above 1 the masses swing up without limit. */
#define IQN_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "iqn.h"
#include "waveform.h"
#include "scene.h"

extern void dgeev_(const char *jobvl, const char *jobvr, const int *n, double *a, const int *lda, double *wr,
                   double *wi, double *vl, const int *ldvl, double *vr, const int *ldvr, double *work, const int *lwork,
                   int *info);

enum { U, V, STATE };

static const struct coupling {
    const char *name;
    int degree, iterated;
} couplings[] = {{"explicit", 0, 0}, {"implicit", 0, 1}, {"waveform", 1, 1}};
enum { COUPLINGS = (int)(sizeof couplings / sizeof *couplings) };

static double wall, between; /* the springs k and c; both masses are 1 */

static int checked(int status, const char *message)
{
    scene_check(status, message);
    return status;
}

/* One step of the trapezoidal rule from t to t + h: `own` goes there, `other` is read after the start and at the end. */
static void step(wf *other, double t, double end, double *own)
{
    const double half = (end - t) / 2, K = wall + between, u = own[U], v = own[V];
    double start, last;
    checked(wf_read(other, t, WF_BEHIND, &start), "wf_read");
    checked(wf_read(other, end, 0, &last), "wf_read");
    own[V] = (v + half * (between * (start + last) - K * (2 * u + half * v))) / (1 + half * half * K);
    own[U] = u + half * (v + own[V]);
}

/* One window, from t to its end: the two waveforms and y, two states, go there.  Returns the iterations. */
static int window(const struct coupling *how, iqn *q, const waveform u[2], double t, double end, double y[2 * STATE])
{
    double now[2 * STATE], x[2], hx[2];
    int i, passes = 0;
    for (i = 0; i < 2; i++) checked(wf_begin(u[i].w, 0, 1, &end, 0), "wf_begin");
    do {
        memcpy(now, y, sizeof now);
        for (i = 0; i < 2; i++) step(u[1 - i].w, t, end, now + STATE * i);
        for (i = 0; i < 2; i++) {
            x[i] = *waveform_window(&u[i]);
            hx[i] = now[STATE * i + U];
        }
        passes++;
        if (how->iterated) checked(iqn_step(q, x, hx), "iqn_step");
        else memcpy(x, hx, sizeof x);
        for (i = 0; i < 2; i++) *waveform_window(&u[i]) = x[i];
    } while (how->iterated && !iqn_converged(q));
    iqn_commit(q);
    memcpy(y, now, sizeof now);
    return passes;
}

/* So many windows of length h; returns the iterations of all. */
static int run(const struct coupling *how, int windows, double h, double y[2 * STATE])
{
    const size_t bytes = iqn_size(2, 4, 1);
    waveform u[2];
    int i, j, total = 0;
    iqn *q;
    checked(iqn_make(&q, 2, 4, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set(q, IQN_TOL_RELATIVE, 1e-13);
    for (i = 0; i < 2; i++) {
        u[i] = waveform_make(how->degree, 1, 2);
        *waveform_push(&u[i], 0, 0) = y[STATE * i + U];
    }
    for (j = 0; j < windows; j++) {
        total += window(how, q, u, j * h, (j + 1) * h, y);
        for (i = 0; i < 2; i++) checked(wf_advance(u[i].w, 0), "wf_advance");
    }
    for (i = 0; i < 2; i++) waveform_free(&u[i]);
    free(q);
    return total;
}

/* The larger error of both masses at `end`; the first one starts at 1, the other at 0. */
static double error_at(double end, const double *y)
{
    const double slow = cos(sqrt(wall) * end), fast = cos(sqrt(wall + 2 * between) * end);
    return fmax(fabs(y[U] - (slow + fast) / 2), fabs(y[STATE + U] - (slow - fast) / 2));
}

/* The map of a window is linear: its columns are what it makes of the unit vectors. */
static double spectral_radius(const struct coupling *how, double h)
{
    const int n = 2 * STATE, lwork = 64, one = 1;
    double map[2 * STATE][2 * STATE] = {{0}}, re[2 * STATE], im[2 * STATE], work[64], largest = 0;
    int i, info;
    for (i = 0; i < n; i++) {
        map[i][i] = 1;
        run(how, 1, h, map[i]);
    }
    dgeev_("N", "N", &n, map[0], &n, re, im, NULL, &one, NULL, &one, work, &lwork, &info);
    scene_check(-info, "dgeev");
    for (i = 0; i < n; i++) largest = fmax(largest, hypot(re[i], im[i]));
    return largest;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"wall", "4", "stiffness of the springs to the wall"},
                        {"between", "2", "stiffness of the spring between the masses"},
                        {"end", "1", "end of the run"},
                        {"windows", "20", "windows of the coarsest run; then twice as many, four times"},
                        {"refine", "5", "runs"},
                        {NULL, NULL, NULL}};
    double end, h, error, before;
    int windows, refine, i, j, total;
    scene_parse(argc, argv, "three couplings with the trapezoidal rule", o);
    wall = scene_perturbed("wall", scene_number(o, "wall", 0, 1e6));
    between = scene_perturbed("between", scene_number(o, "between", 0, 1e6));
    end = scene_number(o, "end", 1e-3, 1e3);
    windows = scene_integer(o, "windows", 1, 100000);
    refine = scene_integer(o, "refine", 1, 10);
    for (i = 0; i < COUPLINGS; i++) {
        for (before = 0, j = 0; j < refine; j++, before = error) {
            const int n = windows << j;
            double y[2 * STATE] = {1, 0, 0, 0};
            total = run(&couplings[i], n, end / n, y);
            error = error_at(end, y);
            printf("%s windows %d error %.3e", couplings[i].name, n, error);
            if (before > 0) printf(" order %.2f", log2(before / error));
            printf(" iterations %.1f\n", (double)total / n);
        }
        for (h = 0.01; h < 200; h *= 10)
            printf("%s dt %g radius %.15g\n", couplings[i].name, h, spectral_radius(&couplings[i], h));
    }
    return 0;
}
