/* SPDX-License-Identifier: MIT

   manufactured.c - heat in two coupled halves with a known answer, implicit Runge-Kutta on both sides.

       u_t = Lap u + f,   u = 1 + g(t) x^2 + 3 y^2 + 1.2 t,   D on [0,1]x[0,1] takes the temperature at x = 1, returns du/dx
                                                              N on [1,2]x[0,1] takes du/dx, returns the temperature
   Second-order differences and a second-order one-sided flux are exact for this u: all errors come from time.
   The stage derivatives k_i = L(u + dt sum_j a_ij k_j) + f(t + c_i dt) are the unknowns, so that a Dirichlet value enters
   by its time derivative: that of the waveform at t + c_i dt.

   g = sin + cos, T = 1: B. Rodenberg, B. Uekermann, arXiv 2511.07616 (2025).  g = sin, T = 10: the set-up of B. Rueth,
   B. Uekermann, M. Mehl, P. Birken, A. Monge, H.-J. Bungartz, Int. J. Numer. Meth. Engng 122 (2021). */
#include <stddef.h>

#define WF_IMPLEMENTATION
#include "waveform.h"
#define IQN_IMPLEMENTATION
#include "iqn.h"
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

void dgbtrf_(const int *m, const int *n, const int *kl, const int *ku, double *ab, const int *ldab, int *ipiv,
             int *info);
void dgbtrs_(const char *trans, const int *n, const int *kl, const int *ku, const int *nrhs, const double *ab,
             const int *ldab, const int *ipiv, double *b, const int *ldb, int *info, size_t trans_length);

static double *vector(ptrdiff_t n)
{
    return (double *)scene_memory((size_t)n * sizeof(double));
}

/* ---- the manufactured solution ---- */

static double with_cosine; /* 1: g = sin + cos, 0: g = sin */

static double exact(double t, double x, double y)
{
    return 1 + (sin(t) + with_cosine * cos(t)) * x * x + 3 * y * y + 1.2 * t;
}

static double exact_dt(double t, double x)
{
    return (cos(t) - with_cosine * sin(t)) * x * x + 1.2;
}

static double source(double t, double x)
{
    return exact_dt(t, x) - 2 * (sin(t) + with_cosine * cos(t)) - 6;
}

/* ---- one side: (m+1)^2 nodes column by column; u and its stage derivatives live on all of them ---- */

typedef struct side {
    int m, nodes, neumann; /* m cells of length h per direction */
    int unknowns, *number; /* nodes off the Dirichlet boundary, and their numbers; -1: on it */
    double h, left;
    double *u, *u0, *k, *U, *rhs; /* solution now and at the window start, stage derivatives and values */
    double *lu, *data;            /* band factors of I - dt A x L, the stages of a node together; interface data */
    int *pivot, factored;
} side;

static double x_of(const side *s, int node)
{
    return s->left + s->h * (node / (s->m + 1));
}

static double y_of(const side *s, int node)
{
    return s->h * (node % (s->m + 1));
}

static side side_make(int m, int neumann, int stages)
{
    side s;
    int p, nodes = (m + 1) * (m + 1);
    ptrdiff_t N;
    s.m = m, s.nodes = nodes, s.neumann = neumann, s.h = 1. / m, s.left = neumann, s.unknowns = s.factored = 0;
    s.number = (int *)scene_memory((size_t)nodes * sizeof(int));
    for (p = 0; p < nodes; p++) {
        int i = p / (m + 1), j = p % (m + 1), inside = j > 0 && j < m && i < m && (i > 0 || neumann);
        s.number[p] = inside ? s.unknowns++ : -1;
    }
    N = (ptrdiff_t)stages * s.unknowns;
    s.u = vector(nodes), s.u0 = vector(nodes), s.data = vector((ptrdiff_t)stages * (m - 1));
    s.k = vector((ptrdiff_t)stages * nodes), s.U = vector((ptrdiff_t)stages * nodes), s.rhs = vector(N);
    s.lu = vector((3 * stages * m - 2) * N);
    s.pivot = (int *)scene_memory((size_t)N * sizeof(int));
    for (p = 0; p < nodes; p++) s.u0[p] = s.u[p] = scene_perturbed("u", exact(0, x_of(&s, p), y_of(&s, p)));
    return s;
}

static void side_free(side *s)
{
    free(s->number), free(s->u), free(s->u0), free(s->data), free(s->k), free(s->U), free(s->rhs), free(s->lu),
        free(s->pivot);
}

/* h^2 Lap: the neighbours of a node, weights -4 1 1 1 1.  On N's interface the missing one mirrors the inner one; the flux
   q = du/dx then adds -2 q/h to Lap u. */
static void neighbours(const side *s, int node, int at[5])
{
    int column = s->m + 1;
    at[0] = node, at[1] = node - 1, at[2] = node + 1, at[3] = node < column ? node + column : node - column,
    at[4] = node + column;
}

/* K := (I - dt A x L)^-1 K */
static void solve(side *s, const rk_table *R, double dt, double *K)
{
    int S = R->stages, N = S * s->unknowns, kl = S * s->m - 1, ld = 3 * kl + 1, one = 1, info, at[5], p, e, i, j;
    if (!s->factored) {
        for (p = 0; p < s->nodes; p++) {
            if (s->number[p] < 0) continue;
            neighbours(s, p, at);
            for (e = 0; e < 5; e++)
                for (i = 0; i < S && s->number[at[e]] >= 0; i++)
                    for (j = 0; j < S; j++) {
                        int row = s->number[p] * S + i, column = s->number[at[e]] * S + j;
                        s->lu[2 * kl + row + column * (ptrdiff_t)(ld - 1)] +=
                            (e == 0 && i == j) - dt * R->A[i * S + j] * (e ? 1 : -4) / (s->h * s->h);
                    }
        }
        dgbtrf_(&N, &N, &kl, &kl, s->lu, &ld, s->pivot, &info);
        scene_check(info ? -1 : 0, "singular matrix");
        s->factored = 1;
    }
    dgbtrs_("N", &N, &kl, &kl, &one, s->lu, &ld, s->pivot, K, &N, &info, 1);
}

/* From t to t_next = t + dt, which is the same double in all waveforms: a stage there must not fall after the knot. */
static void step(side *s, const rk_table *R, const waveform *in, double t, double t_next, double dt)
{
    int S = R->stages, m = s->m, n = m - 1, i, p, e, at[5];
    for (i = 0; i < S; i++) { /* the known stage derivatives: those of the Dirichlet values */
        double ti = R->c[i] < 1 ? t + R->c[i] * dt : t_next, *k = s->k + (ptrdiff_t)i * s->nodes,
               *data = s->data + i * n;
        waveform_eval(in, ti, s->neumann ? 0 : 1, data);
        for (p = 0; p < s->nodes; p++) k[p] = s->number[p] < 0 ? exact_dt(ti, x_of(s, p)) : 0;
        if (!s->neumann) memcpy(k + m * (m + 1) + 1, data, (size_t)n * sizeof(double));
    }
    rk_stages(R, dt, s->nodes, s->u, s->k, s->nodes, s->U, s->nodes);
    for (i = 0; i < S; i++) { /* the others: (I - dt A x L) k = L(u + dt A k_known) + f, minus 2 q/h on N's interface */
        double ti = t + R->c[i] * dt, *U = s->U + (ptrdiff_t)i * s->nodes;
        for (p = 0; p < s->nodes; p++) {
            double lap = 0;
            if (s->number[p] < 0) continue;
            neighbours(s, p, at);
            for (e = 0; e < 5; e++) lap += (e ? 1 : -4) * U[at[e]];
            s->rhs[s->number[p] * S + i] = lap / (s->h * s->h) + source(ti, x_of(s, p));
            if (s->neumann && p <= m) s->rhs[s->number[p] * S + i] -= 2 * s->data[i * n + p - 1] / s->h;
        }
    }
    solve(s, R, dt, s->rhs);
    for (p = 0; p < s->nodes; p++)
        for (i = 0; i < S && s->number[p] >= 0; i++) s->k[(ptrdiff_t)i * s->nodes + p] = s->rhs[s->number[p] * S + i];
    rk_finish(R, dt, s->nodes, s->u, s->k, s->nodes, s->u, NULL);
    /* Known values replace their integrated derivatives: these drift, by a whole order where the waveform's knots fall
       inside the steps (even degrees). */
    for (p = 0; p < s->nodes; p++)
        if (s->number[p] < 0 && (s->neumann || p < m * (m + 1))) s->u[p] = exact(t_next, x_of(s, p), y_of(s, p));
    if (!s->neumann) waveform_eval(in, t_next, 0, s->u + m * (m + 1) + 1);
}

/* What the other side reads: du/dx from D, u from N. */
static void sample(const side *s, double *out)
{
    int j, m = s->m;
    const double *u = s->u + (s->neumann ? 0 : m * (m + 1)), *v = u - (m + 1), *w = v - (m + 1);
    for (j = 1; j < m; j++) out[j - 1] = s->neumann ? u[j] : (3 * u[j] - 4 * v[j] + w[j]) / (2 * s->h);
}

/* Over the window in equal steps; all samples are written, or the first and the last only. */
static void integrate(side *s, const rk_table *R, double t0, double t1, int steps, int ends_only, waveform *in,
                      waveform *out)
{
    int j;
    waveform_fit(in);
    memcpy(s->u, s->u0, (size_t)s->nodes * sizeof(double));
    wf_rollback(out->w);
    sample(s, wf_column(out->w, 0));
    for (j = 1; j <= steps; j++) {
        double t = t0 + (t1 - t0) * j / steps;
        step(s, R, in, t0 + (t1 - t0) * (j - 1) / steps, t, (t1 - t0) / steps);
        if (j == steps || !ends_only) sample(s, waveform_push(out, t, 0));
    }
}

/* |u - exact| / |exact| in L2, by the trapezoidal rule */
static double error_of(const side *s, double t)
{
    double error = 0, size = 0;
    int p, m = s->m;
    for (p = 0; p < s->nodes; p++) {
        int i = p / (m + 1), j = p % (m + 1);
        double v = exact(t, x_of(s, p), y_of(s, p)), e = s->u[p] - v;
        double weight = (i == 0 || i == m ? 0.5 : 1) * (j == 0 || j == m ? 0.5 : 1);
        error += weight * e * e, size += weight * v * v;
    }
    return sqrt(error / size);
}

/* |new - old| / |new|; old becomes new */
static double change(ptrdiff_t n, double *old, const double *new)
{
    double difference = 0, size = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        difference += (new[i] - old[i]) * (new[i] - old[i]), size += new[i] * new[i];
        old[i] = new[i];
    }
    return sqrt(difference / size);
}

/* guess[j n ...], j < samples: the waveform of this window continued to sample j + 1 of the next; constant when kind is 0. */
static void predict(const waveform *w, int kind, ptrdiff_t n, int samples, double t, double length, double *guess)
{
    double *weight = vector(wf_columns(w->w));
    int j, status;
    for (j = 0; j < samples; j++, guess += n) {
        double next = t + length * (j + 1) / samples;
        status = kind == 3 ? wf_weights(w->w, next, 0, weight) : wf_predict(w->w, kind, next, weight);
        scene_check(status, wf_message(status));
        wf_combine(1, wf_columns(w->w), weight, n, wf_column(w->w, 0), n, guess, n);
    }
    free(weight);
}

/* ---- numbers to compare with ---- */

enum { FULL, REDUCED, END, RELAXATION };

/* g = sin + cos, published: the largest e_A at the window ends, five steps per window on both sides */
static const struct errors {
    const char *method;
    int degree;
    double e_A[5]; /* 1, 2, 4, 8, 16 windows */
} errors[] = {{"gauss2", 3, {1.288e-6, 4.845e-7, 6.666e-8, 6.993e-9, 6.507e-10}},
              {"gauss3", 5, {7.129e-8, 7.603e-10, 5.217e-11, 0, 0}}};

/* g = sin, implicit Euler, degree 1: iterations per window of an independent implementation (omega 0.1, 20 columns, no
   reuse, QR2 limit 1e-3; relaxation by 0.5) */
static const int windows_of[6] = {2, 5, 10, 20, 50, 100};
static const double iterations_of[4][6] = {{9.0, 8.4, 7.7, 7.2, 6.0, 5.2},
                                           {10.5, 14.2, 14.7, 14.7, 14.2, 12.1},
                                           {5.5, 6.4, 5.9, 5.6, 4.6, 3.6},
                                           {12, 11, 10.8, 10.3, 9.6, 9.3}};

static void print_reference(const char *method, int degree, int windows, double T, int mode)
{
    size_t i;
    int j;
    for (i = 0; i < sizeof errors / sizeof *errors && with_cosine > 0 && T == 1; i++)
        for (j = 0; j < 5 && strcmp(errors[i].method, method) == 0 && errors[i].degree == degree; j++)
            if (windows == 1 << j && errors[i].e_A[j] > 0) {
                printf("published_e_A %.4g\n", errors[i].e_A[j]);
                printf("# published iterations: 15 to 28\n");
            }
    for (j = 0; j < 6 && !(with_cosine > 0) && T == 10 && degree == 1 && strcmp(method, "euler") == 0; j++)
        if (windows == windows_of[j]) printf("reference_iterations %.4g\n", iterations_of[mode][j]);
}

static double preset(const scene_option *o, const char *key, double low, double high, double value)
{
    return strcmp(scene_text(o, key), "auto") == 0 ? value : scene_number(o, key, low, high);
}

int main(int argc, char **argv)
{
    static const char *const methods[] = {"gauss1", "gauss2", "gauss3", "gauss4", "euler", "radau2", "radau3", NULL};
    static const int stages[] = {1, 2, 3, 4, 1, 2, 3};
    static const char *const solutions[] = {"sin", "sin+cos", NULL};
    static const char *const modes[] = {"full", "reduced", "end", "relaxation", NULL};
    static const char *const judged[] = {"all", "end", NULL};
    scene_option o[] = {
        {"method", "gauss2", "gauss1, gauss2, gauss3, gauss4, (implicit) euler, radau2, radau3"},
        {"degree", "3", "of the waveforms"},
        {"windows", "4", "how many; below 1: how long"},
        {"g", "sin+cos", "g(t): sin+cos or sin; auto below means"},
        {"T", "auto", "end of the time: 1 for sin+cos, 10 for sin"},
        {"steps", "5,5", "of D,N in each window"},
        {"mode", "full", "full; reduced: least squares at the window end; end: exchange that only; relaxation"},
        {"weight", "auto", "mode reduced, of the other samples: 1e-3; 0, as published, with --reuse 0: twice the iterations"},
        {"judge", "all", "samples that the tolerance is for: all, or end: those at the window end"},
        {"tolerance", "auto", "relative change of interface temperature and flux: 1e-12 or 1e-5"},
        {"omega", "auto", "relaxation of the first iteration, 0.1, or of all in mode relaxation, 0.5"},
        {"columns", "200", "secant pairs, at most"},
        {"reuse", "auto",
         "windows whose pairs are kept: 8; 0 in mode reduced with --weight 0, where old pairs mislead; -1: left to the kit"},
        {"filter", "1e-9", "limit of QR2; the map is affine, so its pairs are nearly exact"},
        {"predict", "0", "first guess: 0 constant, 1 linear, 2 quadratic in time, 3 the spline continued"},
        {"delay", "0", "windows in which a secant pair holds later in the window, too: as many steps of D as of N only"},
        {"m", "auto", "cells per direction and side: 24 or 10"},
        {NULL, NULL, NULL}};
    rk_table R;
    side D, N;
    waveform temperature, flux, h; /* h: N's answer to the temperature */
    iqn *q;
    void *table;
    size_t bytes;
    ptrdiff_t unknowns, first, flux_length;
    int ends, method, degree, windows, mode, delay, columns, m, n, samples, kind, steps[2], total = 0, converged = 1, status, w, j;
    double T, tolerance, weight, worst[2] = {0, 0}, *old_x, *old_flux, *guess, *times, *x, *hx, *new_flux;

    scene_parse(argc, argv, "heat with a known answer, implicit Runge-Kutta in two coupled halves", o);
    method = scene_choice(o, "method", methods);
    degree = scene_integer(o, "degree", 1, WF_MAX_DEGREE);
    with_cosine = scene_choice(o, "g", solutions);
    T = preset(o, "T", 1e-6, 1e6, with_cosine > 0 ? 1 : 10);
    windows = scene_number(o, "windows", 1e-9, 1e6) < 1 ? (int)(T / scene_number(o, "windows", 1e-9, 1e6) + 0.5)
                                                        : scene_integer(o, "windows", 1, 1000000);
    mode = scene_choice(o, "mode", modes);
    ends = scene_choice(o, "judge", judged);
    tolerance = preset(o, "tolerance", 0, 1, with_cosine > 0 ? 1e-12 : 1e-5);
    columns = scene_integer(o, "columns", 0, 1000);
    kind = scene_integer(o, "predict", 0, 3);
    m = (int)preset(o, "m", 3, 200, with_cosine > 0 ? 24 : 10);
    scene_integers(o, "steps", 1, 1000000, steps);
    delay = scene_integer(o, "delay", 0, 1000000);
    if (delay > 0 && (steps[0] != steps[1] || mode != FULL)) {
        fprintf(stderr, "--delay takes as many steps of D as of N, and mode full\n");
        return 2;
    }

    bytes = rk_collocation_size(stages[method]);
    table = scene_memory(bytes);
    status = rk_collocation(&R, method < 4 ? RK_GAUSS : RK_RADAU_IIA, stages[method], table, bytes);
    scene_check(status, rk_message(status));
    status = rk_check(&R, NULL);
    scene_check(status, rk_message(status));
    D = side_make(m, 0, R.stages), N = side_make(m, 1, R.stages);

    n = m - 1;
    samples = mode == END ? 1 : steps[1]; /* besides the one at the window start, which is known */
    temperature = waveform_make(degree, n, samples + 1), h = waveform_make(degree, n, samples + 1);
    flux = waveform_make(degree, n, steps[0] + 1);
    old_x = vector((ptrdiff_t)n * samples), old_flux = vector((ptrdiff_t)n * (steps[0] + 1));
    guess = vector((ptrdiff_t)n * samples);
    times = vector(samples);
    waveform_push(&temperature, 0, 0), waveform_push(&h, 0, 0), waveform_push(&flux, 0, 0);

    unknowns = (ptrdiff_t)n * samples; /* one block per sample */
    bytes = iqn_size(unknowns, columns, samples);
    status = iqn_make(&q, unknowns, columns, samples, scene_memory(bytes), bytes);
    scene_check(status, iqn_message(status));
    iqn_set(q, IQN_METHOD, mode == RELAXATION ? IQN_CONSTANT : IQN_ILS);
    iqn_set(q, IQN_OMEGA, preset(o, "omega", 1e-9, 2, mode == RELAXATION ? 0.5 : 0.1));
    iqn_set(q, IQN_FILTER_LIMIT, scene_number(o, "filter", 0, 1));
    iqn_set(q, IQN_GROWTH, 0);
    weight = preset(o, "weight", 0, 1, preset(o, "reuse", -1, 1000, 8) == 0 ? 0 : 1e-3);
    iqn_set(q, IQN_WINDOWS, preset(o, "reuse", -1, 1000, mode == REDUCED && !(weight > 0) ? 0 : 8));
    for (j = 0; j < samples - 1 && mode == REDUCED; j++) iqn_set_block(q, j, IQN_WEIGHT, weight);

    for (w = 0; w < windows && converged; w++) {
        double t0 = T * w / windows, t1 = T * (w + 1) / windows;
        for (j = 0; j < samples; j++) times[j] = t0 + (t1 - t0) * (j + 1) / samples;
        sample(&N, wf_column(temperature.w, 0));
        status = wf_begin(temperature.w, 0, samples, times, 0);
        scene_check(status, wf_message(status));
        x = waveform_window(&temperature);
        if (kind > 0 && w > 0) memcpy(x, guess, (size_t)unknowns * sizeof(double));
        for (j = 0, converged = 0; j < 200 && !converged; j++, total++) {
            integrate(&D, &R, t0, t1, steps[0], mode == END, &temperature, &flux);
            integrate(&N, &R, t0, t1, steps[1], mode == END, &flux, &h);
            hx = waveform_window(&h);
            new_flux = waveform_window(&flux);
            flux_length = (wf_columns(flux.w) - 1) * (ptrdiff_t)n;
            memcpy(old_x, x, (size_t)unknowns * sizeof(double));
            first = ends ? unknowns - n : 0; /* what is judged: all samples, or the last one of either side */
            converged = change(unknowns - first, old_x + first, hx + first) <= tolerance;
            first = ends ? flux_length - n : 0;
            converged = change(flux_length - first, old_flux + first, new_flux + first) <= tolerance && converged;
            status = iqn_step(q, x, hx);
            scene_check(status, iqn_message(status));
            if (w < delay && j > 0 && !converged) scene_check(iqn_delay(q), "iqn_delay");
        }
        worst[0] = fmax(worst[0], error_of(&D, t1)), worst[1] = fmax(worst[1], error_of(&N, t1));
        memcpy(D.u0, D.u, (size_t)D.nodes * sizeof(double));
        memcpy(N.u0, N.u, (size_t)N.nodes * sizeof(double));
        iqn_commit(q);
        predict(&temperature, kind, n, samples, t1, t1 - t0, guess);
        wf_advance(temperature.w, 0), wf_advance(h.w, 0), wf_advance(flux.w, 0);
    }

    if (steps[0] == 5 && steps[1] == 5) print_reference(methods[method], degree, windows, T, mode);
    if (!converged) printf("# window %d did not converge\n", w);
    printf("e_A %.6g\ne_B %.6g\niterations %.2f\n", worst[0], worst[1], (double)total / w);
    side_free(&D), side_free(&N);
    waveform_free(&temperature), waveform_free(&h), waveform_free(&flux);
    free(old_x), free(old_flux), free(guess), free(times), free(q), free(table);
    return converged ? 0 : 1;
}
