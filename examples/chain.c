/* SPDX-License-Identifier: MIT

   chain.c - more than two solvers: four masses in a row between two walls, each a solver with sub-steps of its own

   Mass i follows u_i'' = k (u_(i-1) - 2 u_i + u_(i+1)) by rk4 in 5, 7, 11 or 6 sub-steps of a window, reads its neighbours'
   waveforms at any time and writes its own, cubic in time.  The unknown x holds the four fields one after the other, a block
   for each with its own length and limit.

       together   every solver reads what all had written in the iteration before: they can run at the same time
       in_turn    every solver reads what those before it have just written.  Nobody reads the first field of x then: it
                  only follows, so its block has no weight

   Printed: the error at the end against the modes of the chain, its order, and iterations in a window by iqn.h and plain. */
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "iqn.h"
#include "rk.h"
#include "waveform.h"
#include "scene.h"

enum { MASSES = 4, MOST = 11, ALL = 5 + 7 + 11 + 6 };
static const int steps_of[MASSES] = {5, 7, 11, 6};
static const double PI = 3.14159265358979323846;

static double spring, tolerance;

static int checked(int status, const char *message)
{
    scene_check(status, message);
    return status;
}

static double value(wf *w, double t)
{
    double u;
    checked(wf_read(w, t, 0, &u), "wf_read");
    return u;
}

/* Solver i over the window: y = (u, v) goes to its end, u is written at every sub-step; left or right NULL: a wall. */
static void solve(double y[2], wf *left, wf *right, wf *own)
{
    const rk_table *T = rk_find("rk4");
    double k[2 * 4], z[2], t, h;
    int i, j;
    for (j = wf_start(own) + 1; j < wf_columns(own); j++) {
        t = wf_time(own, j - 1);
        h = wf_time(own, j) - t;
        for (i = 0; i < T->stages; i++) {
            const double at = t + T->c[i] * h;
            rk_stage(T, i, h, 2, y, k, 2, z);
            k[2 * i] = z[1];
            k[2 * i + 1] = spring * ((left ? value(left, at) : 0) - 2 * z[0] + (right ? value(right, at) : 0));
        }
        rk_finish(T, h, 2, y, k, 2, y, NULL);
        *wf_column(own, j) = y[0];
    }
}

/* The largest error of the masses; at the start the first one is displaced by 1. */
static double error_at(double t, double y[MASSES][2])
{
    double worst = 0, u, angle;
    int i, mode;
    for (i = 0; i < MASSES; i++) {
        for (u = 0, mode = 1; mode <= MASSES; mode++) {
            angle = PI * mode / (MASSES + 1);
            u += 2. / (MASSES + 1) * sin(angle) * sin(angle * (i + 1)) * cos(2 * sqrt(spring) * sin(angle / 2) * t);
        }
        worst = fmax(worst, fabs(u - y[i][0]));
    }
    return worst;
}

static void read_all(const waveform *w, double *x)
{
    int i, j;
    for (i = 0; i < MASSES; i++)
        for (j = 0; j < steps_of[i]; j++) *x++ = waveform_window(&w[i])[j];
}

static void write_all(const double *x, const waveform *w)
{
    int i, j;
    for (i = 0; i < MASSES; i++)
        for (j = 0; j < steps_of[i]; j++) waveform_window(&w[i])[j] = *x++;
}

/* The accelerator: a block for each field, with its own length and limit. */
static iqn *accelerator(int in_turn, int plain)
{
    const size_t bytes = iqn_size(ALL, 40, MASSES);
    int i;
    iqn *q;
    checked(iqn_make(&q, ALL, 40, MASSES, scene_memory(bytes), bytes), "iqn_make");
    for (i = 0; i < MASSES; i++) {
        iqn_set_block(q, i, IQN_LENGTH, steps_of[i]);
        iqn_set_block(q, i, IQN_TOL_RELATIVE, tolerance);
    }
    if (in_turn) iqn_set_block(q, 0, IQN_WEIGHT, 0);
    if (plain) iqn_set(q, IQN_METHOD, IQN_CONSTANT);
    iqn_set(q, IQN_OMEGA, 1); /* the plain iteration converges */
    iqn_set(q, IQN_MAX_ITERATIONS, 100);
    return q;
}

/* All solvers once: y goes to the end of the window, hu is what they write. */
static void call_all(int in_turn, const waveform *u, const waveform *hu, double y[MASSES][2])
{
    const waveform *before = in_turn ? hu : u;
    int i;
    for (i = 0; i < MASSES; i++) checked(wf_copy(hu[i].w, u[i].w), "wf_copy");
    for (i = 0; i < MASSES; i++)
        solve(y[i], i > 0 ? before[i - 1].w : NULL, i < MASSES - 1 ? u[i + 1].w : NULL, hu[i].w);
}

/* The time from 0 to 1 in so many windows: the error at the end; iterations of all windows, 0: one did not converge. */
static double run(int windows, int in_turn, int plain, int *total)
{
    double y[MASSES][2] = {{1, 0}, {0, 0}, {0, 0}, {0, 0}}, now[MASSES][2], x[ALL], hx[ALL], t[MOST];
    waveform u[MASSES], hu[MASSES];
    iqn *q = accelerator(in_turn, plain);
    int i, j, w, failed = 0;
    for (i = 0; i < MASSES; i++) {
        u[i] = waveform_make(3, 1, MOST + 1);
        hu[i] = waveform_make(3, 1, MOST + 1);
        *waveform_push(&u[i], 0, 0) = y[i][0];
    }
    for (*total = 0, w = 0; w < windows; w++) {
        for (i = 0; i < MASSES; i++) {
            for (j = 0; j < steps_of[i]; j++) t[j] = (w + (j + 1.) / steps_of[i]) / windows;
            checked(wf_begin(u[i].w, 1, steps_of[i], t, 0), "wf_begin");
        }
        do {
            memcpy(now, y, sizeof now);
            call_all(in_turn, u, hu, now);
            read_all(u, x);
            read_all(hu, hx);
            checked(iqn_step(q, x, hx), "iqn_step");
            write_all(x, u);
        } while (!iqn_converged(q));
        *total += (int)iqn_get(q, IQN_ITERATIONS);
        failed += iqn_converged(q) != 1;
        iqn_commit(q);
        memcpy(y, now, sizeof y);
        for (i = 0; i < MASSES; i++) checked(wf_advance(u[i].w, 0), "wf_advance");
    }
    if (failed > 0) *total = 0;
    for (i = 0; i < MASSES; i++) {
        waveform_free(&u[i]);
        waveform_free(&hu[i]);
    }
    free(q);
    return error_at(1, y);
}

int main(int argc, char **argv)
{
    static const char *const ways[] = {"together", "in_turn"};
    scene_option o[] = {{"spring", "39.4784176", "stiffness of the five springs over the mass"},
                        {"windows", "10", "time windows of the coarsest run; then twice as many, four times"},
                        {"refine", "4", "runs"},
                        {"tol", "1e-11", "relative limit of every field"},
                        {NULL, NULL, NULL}};
    double error, before;
    int windows, refine, way, j, iterations, plain;
    scene_parse(argc, argv, "four solvers with sub-steps 5, 7, 11 and 6 in a window", o);
    spring = scene_perturbed("spring", scene_number(o, "spring", 1e-6, 1e6));
    windows = scene_integer(o, "windows", 1, 10000);
    refine = scene_integer(o, "refine", 1, 10);
    tolerance = scene_number(o, "tol", 1e-14, 1);
    for (way = 0; way < 2; way++)
        for (before = 0, j = 0; j < refine; j++, before = error) {
            const int n = windows << j;
            run(n, way, 1, &plain);
            error = run(n, way, 0, &iterations);
            printf("%s windows %d error %.3e", ways[way], n, error);
            if (before > 0) printf(" order %.2f", log2(before / error));
            printf(" iterations %.1f plain %.1f\n", (double)iterations / n, (double)plain / n);
        }
    return 0;
}
