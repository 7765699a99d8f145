/* SPDX-License-Identifier: MIT

   stages.c - implicit stages without a Jacobian: an ESDIRK step whose stages are fixed points, accelerated by iqn.h.

      u_t = D u_xx + K u (1 - u) (u - a),   0 < x < 1,   n unknowns, exact boundary values

   has the front u = (1 - tanh((x - c t)/w))/2, w^2 = 8 D/K, c = (1 - 2a) sqrt(K D/2).  A small source makes it the exact
   solution of the n equations, too, so that what is seen is the error in time.  Stage i of each step,

      Z = base + g f(t_i, Z),   g = h a_ii,   starts from the dense output of the last step, continued,

   and is solved to the same residual: by the plain fixed point; with a quasi-Newton step of iqn.h between two
   evaluations, its secant pairs forgotten after each stage (Anderson acceleration, as ARKODE has it) or kept (a stage is
   a window: its pairs serve the next ones, for g J hardly changes); by Newton's method with LAPACK's band solver, the
   Jacobian once a step by differences, of three evaluations where it is known to be tridiagonal (columns three apart at
   once), of n for the blind.  Then k_i = (Z - base)/g.

   stiffness is g times the largest eigenvalue of the diffusion.  Up to 1 nobody needs fewer evaluations than the
   quasi-Newton iteration that keeps its pairs.  Above 1 the plain one diverges.  At 10 a host that knows the pattern of
   its Jacobian needs a third of the evaluations, one that does not needs twenty times as many.  At 100 and more the
   quasi-Newton iteration is out of its depth.

   A linear problem (--K 0 --once 1) is done after one evaluation and one solve where the solver knows the matrix.
   Newton's method does.  Of a quasi-Newton step iqn.h says what it leaves of the residual, rho = |r + V a|
   (IQN_PREDICTED).  The error of Z is then (I - g J)^-1 g J (r + V a), below rho where J has negative eigenvalues.  So a
   stage whose rho is below the tolerance is accepted unseen, any other one goes on. */
#define _POSIX_C_SOURCE 199309L
#define IQN_IMPLEMENTATION
#include "iqn.h"
#define RK_IMPLEMENTATION
#include "rk.h"
#include "scene.h"

#include <time.h>

enum { MOST = 4000, PLAIN = 0, ANDERSON, QUASI, NEWTON, BLIND, SOLVERS };

static int n;
static double D, K, a;
static long evaluations;
static double time_f;

/* Of this process, in seconds */
static double now(void)
{
    struct timespec s;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &s);
    return (double)s.tv_sec + 1e-9 * (double)s.tv_nsec;
}

/* ---- the problem ------------------------------------------------------------------------------------------------- */

static double front(double x, double t)
{
    const double w = K > 0 ? sqrt(8 * D / K) : 0.2, c = (1 - 2 * a) * sqrt(K * D / 2);
    return K > 0 ? 0.5 - 0.5 * tanh((x - 0.4 - c * t) / w) : 0.5 + 0.5 * cos(3 * x + t);
}

static double front_rate(double x, double t)
{
    const double w = K > 0 ? sqrt(8 * D / K) : 0.2, c = (1 - 2 * a) * sqrt(K * D / 2), u = front(x, t);
    return K > 0 ? 2 * c / w * u * (1 - u) : -0.5 * sin(3 * x + t);
}

static double reaction(double u)
{
    return K * u * (1 - u) * (u - a);
}

/* The source is what the exact solution leaves over: its values at all points, prepared once a stage. */
static double source[MOST];
static void prepare(double t)
{
    const double dx = 1. / (n + 1), d = D / (dx * dx);
    double left = front(0, t), here = front(dx, t), right;
    int i;
    for (i = 0; i < n; i++) {
        right = front((i + 2) * dx, t);
        source[i] = front_rate((i + 1) * dx, t) - d * (left - 2 * here + right) - reaction(here);
        if (i == 0) source[i] += d * left;
        if (i == n - 1) source[i] += d * right;
        left = here;
        here = right;
    }
}

static void f(const double *u, double *k)
{
    const double d = D * (n + 1.) * (n + 1.), start = now();
    int i;
    for (i = 0; i < n; i++)
        k[i] = d * ((i > 0 ? u[i - 1] : 0) - 2 * u[i] + (i + 1 < n ? u[i + 1] : 0)) + reaction(u[i]) + source[i];
    time_f += now() - start;
    evaluations++;
}

/* ---- stage equations --------------------------------------------------------------------------------------------- */

extern void dgbtrf_(const int *m, const int *n, const int *kl, const int *ku, double *ab, const int *ldab, int *pivot,
                    int *info);
extern void dgbtrs_(const char *trans, const int *n, const int *kl, const int *ku, const int *nrhs, const double *ab,
                    const int *ldab, const int *pivot, double *b, const int *ldb, int *info, size_t length);

typedef struct solver {
    int kind, most, fresh; /* fresh: this step has its Jacobian */
    int once;              /* linear: a step of the solver that is known to suffice gets no second look */
    double tolerance;      /* of the residual's root mean square */
    iqn *q;
    double band[4 * MOST]; /* I - g J, factored: ldab = 2 kl + ku + 1 = 4 */
    int pivot[MOST];
    double time; /* in iqn_step or LAPACK */
    long iterations;
} solver;

/* hx = base + g f(Z); the root mean square of hx - Z */
static double residual(const double *base, double g, const double *Z, double *hx)
{
    double sum = 0;
    int i;
    f(Z, hx);
    for (i = 0; i < n; i++) {
        hx[i] = base[i] + g * hx[i];
        sum += (hx[i] - Z[i]) * (hx[i] - Z[i]);
    }
    return sqrt(sum / n);
}

static void jacobian(solver *S, double g, const double *Z)
{
    const double step = 1e-7;
    const int kl = 1, ld = 4, colours = S->kind == BLIND ? n : 3;
    static double at[MOST], f0[MOST], f1[MOST];
    double start;
    int colour, i, j, info;
    f(Z, f0);
    for (colour = 0; colour < colours; colour++) {
        memcpy(at, Z, (size_t)n * sizeof *at);
        for (j = colour; j < n; j += colours) at[j] += step;
        f(at, f1);
        for (j = colour; j < n; j += colours)
            for (i = j > 0 ? j - 1 : 0; i <= j + 1 && i < n; i++)
                S->band[4 * j + 2 + i - j] = (i == j) - g * (f1[i] - f0[i]) / step;
    }
    start = now();
    dgbtrf_(&n, &n, &kl, &kl, S->band, &ld, S->pivot, &info);
    S->time += now() - start;
    S->fresh = info == 0;
}

static void newton_step(solver *S, double *Z, const double *hx)
{
    static double r[MOST];
    const int kl = 1, ld = 4, one = 1;
    const double start = now();
    int i, info;
    for (i = 0; i < n; i++) r[i] = hx[i] - Z[i];
    dgbtrs_("N", &n, &kl, &kl, &one, S->band, &ld, S->pivot, r, &n, &info, 1);
    for (i = 0; i < n; i++) Z[i] += r[i];
    S->time += now() - start;
}

/* Whether the step just made solves a linear stage equation, as far as the solver knows without another evaluation. */
static int suffices(const solver *S)
{
    if (!S->once || S->kind == PLAIN || S->kind == ANDERSON) return 0;
    return S->kind >= NEWTON || iqn_get(S->q, IQN_PREDICTED) <= S->tolerance * sqrt(n);
}

/* Z = base + g f(Z), in place; negative: not within `most` iterations. */
static int solve(solver *S, const double *base, double g, double *Z)
{
    static double hx[MOST];
    int i, status, end = 0;
    if (S->kind >= NEWTON && !S->fresh) jacobian(S, g, Z);
    for (i = 0; i < S->most && !end; i++) {
        const double r = residual(base, g, Z, hx);
        S->iterations++;
        end = r <= S->tolerance;
        if (!isfinite(r)) return -1;
        if (S->q) {
            const double start = now();
            status = iqn_step(S->q, Z, hx);
            scene_check(status, iqn_message(status));
            S->time += now() - start;
        } else if (S->kind == PLAIN || end) memcpy(Z, hx, (size_t)n * sizeof *hx);
        else newton_step(S, Z, hx);
        if (!end && suffices(S)) {
            if (S->kind == QUASI) iqn_commit(S->q);
            return 0;
        }
    }
    if (S->q) memcpy(Z, hx, (size_t)n * sizeof *hx); /* hx of the last iteration is the answer */
    if (S->kind == QUASI) iqn_commit(S->q);
    if (S->kind == ANDERSON) iqn_discard(S->q);
    return end ? 0 : -1;
}

/* ---- a run ------------------------------------------------------------------------------------------------------- */

static void run(const rk_table *T, solver *S, int steps, double end, int predict)
{
    static double y[MOST], last[MOST], k[RK_STAGES_MAX * MOST], old[RK_STAGES_MAX * MOST], Z[MOST], base[MOST];
    const double h = end / steps;
    const rk_step before = {T, h, n, last, old, n};
    double error = 0;
    int s, i, j, failed = 0, solved = 0;
    for (j = 0; j < n; j++) y[j] = front((j + 1.) / (n + 1), 0);
    for (s = 0; s < steps && !failed; s++) {
        S->fresh = 0;
        for (i = 0; i < T->stages && !failed; i++) {
            const double g = h * T->A[i * T->stages + i];
            rk_stage(T, i, h, n, y, k, n, base);
            prepare((s + T->c[i]) * h);
            if (g == 0) {
                f(base, k + i * n);
                continue;
            }
            memcpy(Z, base, (size_t)n * sizeof *Z);
            if (predict && s > 0) rk_dense(&before, 1 + T->c[i], 0, Z);
            failed = solve(S, base, g, Z) < 0;
            solved++;
            for (j = 0; j < n; j++) k[i * n + j] = (Z[j] - base[j]) / g;
        }
        memcpy(last, y, (size_t)n * sizeof *y);
        memcpy(old, k, (size_t)(n * T->stages) * sizeof *k);
        if (!failed) rk_finish(T, h, n, y, k, n, y, NULL);
    }
    for (j = 0; j < n; j++) error = fmax(error, fabs(y[j] - front((j + 1.) / (n + 1), end)));
    printf(" %8ld %6.2f", evaluations, (double)S->iterations / solved);
    if (failed) printf("  diverges ");
    else printf("  %.3e", error);
}

int main(int argc, char **argv)
{
    static const char *const name[] = {"plain", "Anderson", "quasi-Newton", "Newton", "Newton-blind"};
    scene_option o[] = {{"n", "0", "unknowns; 0: 10, 32, 100, 316 and 1000 one after the other"},
                        {"table", "esdirk4", "an ESDIRK or SDIRK table of rk.h"},
                        {"steps", "20", "time steps"},
                        {"end", "2", "end time"},
                        {"D", "1e-4", "diffusion"},
                        {"K", "4", "reaction; 0: a linear problem"},
                        {"a", "0.2", "its unstable state"},
                        {"tolerance", "1e-8", "of the root mean square residual of a stage"},
                        {"pairs", "15", "secant pairs"},
                        {"predict", "1", "0: a stage starts from its base"},
                        {"once", "0", "1, with K = 0: no second evaluation of a stage whose solver says that one solve sufficed"},
                        {"most", "100", "iterations of a stage"},
                        {NULL, NULL, NULL}};
    static const int sizes[] = {10, 32, 100, 316, 1000};
    static solver S;
    const rk_table *T;
    double end, stiffness;
    int given, steps, pairs, size, kind, status;
    scene_parse(argc, argv, "implicit stages as fixed points: evaluations plain, quasi-Newton, Newton with band solver",
                o);
    given = scene_integer(o, "n", 0, MOST);
    T = rk_find(scene_text(o, "table"));
    if (!T || rk_is(T, RK_SEQUENTIAL) != 1 || rk_is(T, RK_EXPLICIT) == 1 || !T->powers) {
        fprintf(stderr, "--table: %s is no diagonally implicit table of rk.h\n", scene_text(o, "table"));
        return 2;
    }
    steps = scene_integer(o, "steps", 1, 100000);
    end = scene_number(o, "end", 1e-6, 100);
    D = scene_perturbed("D", scene_number(o, "D", 0, 1));
    K = scene_number(o, "K", 0, 1e3);
    a = scene_number(o, "a", 0, 1);
    pairs = scene_integer(o, "pairs", 1, 1000);
    printf("%s, %d steps of %g\n", T->name, steps, end / steps);
    printf("    n stiffness solver       evaluations iterations error  us of f, of the solver\n");
    printf("                                         per stage         per evaluation, iteration\n");
    for (size = 0; size < (given ? 1 : 5); size++)
        for (kind = 0; kind < SOLVERS; kind++) {
            const size_t bytes = iqn_size(given ? given : sizes[size], pairs, 1);
            void *mem = scene_memory(bytes);
            n = given ? given : sizes[size];
            memset(&S, 0, sizeof S);
            S.kind = kind;
            S.tolerance = scene_number(o, "tolerance", 1e-14, 1);
            S.most = scene_integer(o, "most", 1, 10000);
            S.once = scene_integer(o, "once", 0, 1);
            if (kind == ANDERSON || kind == QUASI) {
                status = iqn_make(&S.q, n, pairs, 1, mem, bytes);
                scene_check(status, iqn_message(status));
                iqn_set(S.q, IQN_TOL_ABSOLUTE, S.tolerance * sqrt(n));
                if (kind == ANDERSON) iqn_set(S.q, IQN_OMEGA, 1);
            }
            evaluations = 0;
            time_f = 0;
            stiffness = end / steps * T->A[T->stages * T->stages - 1] * 4 * D * (n + 1.) * (n + 1.);
            printf("%5d %9.3g %-12s", n, stiffness, name[kind]);
            run(T, &S, steps, end, scene_integer(o, "predict", 0, 1));
            printf(" %8.3f %8.3f\n", 1e6 * time_f / (double)evaluations, 1e6 * S.time / (double)S.iterations);
            free(mem);
        }
    return 0;
}
