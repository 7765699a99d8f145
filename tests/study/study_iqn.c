/* SPDX-License-Identifier: MIT

   study_iqn.c - quasi-Newton: accuracy levels against condition and cost, a history in single precision, stability maps.
   study_iqn DIRECTORY */
#include "iqn.h" /* before scene.h, whose delayed pairs and waveforms the tube needs */
#include "waveform.h"

#include "study.h"

int tube_main(int argc, char **argv);
#define main tube_main /* the tube's two solvers, from the scene */
#include "examples/tube.c"
#undef main

extern void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
                   const int *ldb, double *work, const int *lwork, int *info, size_t trans_length);

static iqn *make(ptrdiff_t n, int columns)
{
    size_t bytes = iqn_size(n, columns, 1);
    iqn *q;
    scene_check(iqn_make(&q, n, columns, 1, scene_memory(bytes), bytes), "iqn_make");
    return q;
}

/* ---- accuracy levels: min |r + V a|, with a known condition and an optimum of 1e-3 |r| ---- */

static double dot(ptrdiff_t n, const double *a, const double *b)
{
    double s = 0;
    ptrdiff_t i;
    for (i = 0; i < n; i++) s += a[i] * b[i];
    return s;
}

/* q orthonormal, n x m, by Gram-Schmidt twice */
static void orthonormal(ptrdiff_t n, int m, double *q, unsigned long long *seed)
{
    int j, k, pass;
    ptrdiff_t i;
    for (j = 0; j < m; j++) {
        double *c = q + j * n, s;
        for (i = 0; i < n; i++) c[i] = study_random(seed);
        for (pass = 0; pass < 2; pass++)
            for (k = 0; k < j; k++)
                for (s = dot(n, q + k * n, c), i = 0; i < n; i++) c[i] -= s * q[k * n + i];
        for (s = 1 / sqrt(dot(n, c, c)), i = 0; i < n; i++) c[i] *= s;
    }
}

/* V with singular values from 1 down to 1/condition; r = V a + 1e-3 of something orthogonal to it, |a_j| of order 1 */
static void problem(ptrdiff_t n, int m, double condition, double *V, double *r)
{
    unsigned long long seed = 88172645463325252ULL;
    double *Q = study_vector(n * (m + 1)), *R = study_vector(m * m);
    ptrdiff_t i;
    int j, k;
    orthonormal(n, m + 1, Q, &seed);
    orthonormal(m, m, R, &seed);
    memset(V, 0, (size_t)(n * m) * sizeof *V);
    for (j = 0; j < m; j++)
        for (k = 0; k < m; k++)
            for (i = 0; i < n; i++) V[j * n + i] += Q[k * n + i] * pow(condition, -(double)k / (m - 1)) * R[k * m + j];
    memcpy(r, Q + m * n, (size_t)n * sizeof *r);
    for (i = 0; i < n; i++) r[i] *= 1e-3;
    for (k = 0; k < m; k++)
        for (i = 0; i < n; i++) r[i] += V[k * n + i] * (1 - 0.3 * k);
    free(Q), free(R);
}

/* The optimum in long double: modified Gram-Schmidt with every projection done three times. */
static long double optimum(ptrdiff_t n, int m, const double *V, const double *r)
{
    long double *Q = (long double *)scene_memory((size_t)(n * (m + 1)) * sizeof *Q), s = 0;
    ptrdiff_t i;
    int j, k, pass;
    for (j = 0; j <= m; j++) {
        long double *c = Q + j * n;
        for (i = 0; i < n; i++) c[i] = (long double)(j < m ? V[j * n + i] : r[i]);
        for (pass = 0; pass < 3; pass++)
            for (k = 0; k < j; k++) {
                for (s = 0, i = 0; i < n; i++) s += Q[k * n + i] * c[i];
                for (i = 0; i < n; i++) c[i] -= s * Q[k * n + i];
            }
        for (s = 0, i = 0; i < n; i++) s += c[i] * c[i];
        s = sqrtl(s);
        for (i = 0; i < n && j < m; i++) c[i] /= s;
    }
    free(Q);
    return s;
}

typedef struct least {
    ptrdiff_t n;
    int m;
    double *V, *r, *x, *hx, *A, *b, *zero, work[10000];
    iqn *kit;
} least;

enum { COPY, KIT, HOUSEHOLDER, SOLVERS };

static iqn *loaded(const least *p)
{
    iqn *q = make(p->n, p->m);
    int j;
    iqn_set(q, IQN_FILTER_LIMIT, 1e-16); /* none but the numerically dependent ones */
    for (j = 0; j < p->m; j++) iqn_push(q, p->V + j * p->n, p->V + j * p->n);
    return q;
}

/* x = r + V a: with w = v and hx = r, x = 0, that is what a step returns */
static void solve(int solver, void *ctx)
{
    least *p = (least *)ctx;
    const int n = (int)p->n, one = 1, lwork = 10000;
    int info, j;
    ptrdiff_t i;
    switch (solver) {
    case COPY: memcpy(p->A, p->V, (size_t)(p->n * p->m) * sizeof(double)); break;
    case KIT:
        memset(p->x, 0, (size_t)p->n * sizeof(double));
        iqn_step(p->kit, p->x, p->r);
        iqn_commit(p->kit); /* so that the next step makes no pair */
        break;
    case HOUSEHOLDER:
        memcpy(p->A, p->V, (size_t)(p->n * p->m) * sizeof(double));
        for (i = 0; i < p->n; i++) p->b[i] = -p->r[i];
        dgels_("N", &n, &p->m, &one, p->A, &n, p->b, &n, p->work, &lwork, &info, 1);
        memcpy(p->x, p->r, (size_t)p->n * sizeof(double));
        for (j = 0; j < p->m; j++)
            for (i = 0; i < p->n; i++) p->x[i] += p->V[j * p->n + i] * p->b[j];
        break;
    }
}

static least allocate(ptrdiff_t n, int m)
{
    least p;
    memset(&p, 0, sizeof p);
    p.n = n, p.m = m;
    p.V = study_vector(n * m), p.A = study_vector(n * m), p.r = study_vector(n), p.x = study_vector(n), p.b = study_vector(n);
    return p;
}

static void release(least *p)
{
    free(p->V), free(p->A), free(p->r), free(p->x), free(p->b);
}

static void levels(const char *directory)
{
    FILE *csv = study_file(directory, "iqn-levels.csv");
    least p = allocate(2000, 10);
    int exponent, solver;
    static const int sizes[][2] = {{1000, 10}, {100000, 10}, {100000, 20}, {1000000, 10}};
    size_t k;
    printf("least squares of a step, 10 pairs, optimum 1e-3: excess of the residual over the optimum\n");
    printf("%10s %12s %12s\n", "condition", "iqn.h", "Householder");
    fprintf(csv, "condition,kit,householder\n");
    for (exponent = 0; exponent <= 16; exponent++) {
        double excess[SOLVERS], norm;
        long double best;
        problem(p.n, p.m, pow(10, exponent), p.V, p.r);
        best = optimum(p.n, p.m, p.V, p.r);
        p.kit = loaded(&p);
        for (solver = KIT; solver < SOLVERS; solver++) {
            solve(solver, &p);
            norm = sqrt(dot(p.n, p.x, p.x));
            excess[solver] = fmax(1e-17, (double)(((long double)norm - best) / best));
        }
        fprintf(csv, "1e%d,%.3g,%.3g\n", exponent, excess[KIT], excess[HOUSEHOLDER]);
        if (exponent % 2 == 0)
            printf("%8s%02d %12.1e %12.1e\n", "1e", exponent, excess[KIT], excess[HOUSEHOLDER]);
        free(p.kit);
    }
    fclose(csv);
    release(&p);

    csv = study_file(directory, "iqn-cost.csv");
    fprintf(csv, "n,pairs,copy_s,kit,householder\n");
    printf("cost of a step over a copy of its V: %8s %6s %8s %8s\n", "n", "pairs", "iqn.h", "dgels");
    for (k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        double s[SOLVERS];
        p = allocate(sizes[k][0], sizes[k][1]);
        problem(p.n, p.m, 1e4, p.V, p.r);
        p.kit = loaded(&p);
        study_race(SOLVERS, solve, &p, s);
        fprintf(csv, "%td,%d,%.4g,%.4g,%.4g\n", p.n, p.m, s[COPY], s[KIT] / s[COPY], s[HOUSEHOLDER] / s[COPY]);
        printf("%36s %8td %6d %8.2f %8.2f\n", "", p.n, p.m, s[KIT] / s[COPY], s[HOUSEHOLDER] / s[COPY]);
        free(p.kit);
        release(&p);
    }
    fclose(csv);
}

/* ---- two rods: the coupled heat equation in one dimension, implicit Euler, full waveform ----
   alpha u_t = lambda u_xx.  D on [-1,0] takes the temperature at 0 and returns the heat flux, N on [0,1] the reverse. */

enum { INNER = 40, STEPS = 5 };
typedef struct rod {
    double lambda, alpha, u[INNER + 1]; /* from the outer end, where u = 0, inwards; the last is the interface */
} rod;

/* One step; value: the interface temperature (D) or the flux into the rod (N).  Returns the other one. */
static double rod_step(rod *p, int neumann, double dt, double value)
{
    const double dx = 1. / (INNER + 1), a = p->alpha * dx / dt, l = p->lambda / dx;
    const int n = INNER + neumann;
    double d[INNER + 1], b[INNER + 1], old = p->u[INNER], f;
    int i;
    for (i = 0; i < n; i++) {
        const double half = i == INNER ? 0.5 : 1; /* half a cell at the interface */
        d[i] = half * (a + 2 * l);
        b[i] = half * a * p->u[i];
    }
    b[n - 1] += neumann ? value : l * value;
    for (i = 1; i < n; i++) { /* off the diagonal -l on both sides */
        f = -l / d[i - 1];
        d[i] += f * l;
        b[i] -= f * b[i - 1];
    }
    p->u[n - 1] = b[n - 1] / d[n - 1];
    for (i = n - 2; i >= 0; i--) p->u[i] = (b[i] + l * p->u[i + 1]) / d[i];
    if (neumann) return p->u[INNER];
    p->u[INNER] = value;
    return l * (p->u[INNER - 1] - value) - 0.5 * a * (value - old); /* what leaves the rod at the interface */
}

/* hx = H(x): both rods over one window, from copies */
static void rods_map(const rod start[2], double dt, const double *x, double *hx, rod end[2])
{
    int j;
    end[0] = start[0], end[1] = start[1];
    for (j = 0; j < STEPS; j++) hx[j] = rod_step(&end[1], 1, dt, rod_step(&end[0], 0, dt, x[j]));
}

static void rods_start(rod p[2], double lambda, double alpha)
{
    int i;
    p[0].lambda = lambda, p[0].alpha = alpha, p[1].lambda = p[1].alpha = 1;
    for (i = 0; i <= INNER; i++) {
        double x = (i + 1.) / (INNER + 1);
        p[0].u[i] = sin(0.5 * PI * x), p[1].u[i] = sin(0.5 * PI * x) * (1 + x * (1 - x));
    }
}

/* ---- a history of our own: what iqn.h would do if it kept its pairs in another precision ---- */

typedef struct history {
    ptrdiff_t n;
    int columns, used, chained, single, window, of_window[100];
    double *V, *W, *x, *hx; /* newest last */
} history;

static history history_make(ptrdiff_t n, int columns, int single)
{
    history h;
    memset(&h, 0, sizeof h);
    h.n = n, h.columns = columns, h.single = single;
    h.V = study_vector(n * (columns + 1)), h.W = study_vector(n * (columns + 1)), h.x = study_vector(n), h.hx = study_vector(n);
    return h;
}

static void history_free(history *h)
{
    free(h->V), free(h->W), free(h->x), free(h->hx);
}

/* One iteration through a fresh iqn object that is given the pairs. */
static void history_step(history *h, double *x, const double *hx, double omega, double epsilon, int reuse)
{
    iqn *q = make(h->n, h->columns);
    ptrdiff_t i;
    int j, keep;
    if (h->chained) {
        double *v = h->V + h->used * h->n, *w = h->W + h->used * h->n, big = 0;
        for (i = 0; i < h->n; i++) {
            w[i] = hx[i] - h->hx[i];
            v[i] = w[i] - (x[i] - h->x[i]);
            big = fmax(big, fmax(fabs(v[i]), fabs(w[i])));
        }
        frexp(big, &j); /* scaled by a power of two, as in the header */
        for (i = 0; i < h->n && h->single; i++) {
            w[i] = ldexp((double)(float)ldexp(w[i], -j), j);
            v[i] = ldexp((double)(float)ldexp(v[i], -j), j);
        }
        if (big > 0) h->of_window[h->used++] = h->window;
    }
    keep = 0;
    while (keep < h->used && (h->used - keep > h->columns || h->of_window[keep] < h->window - reuse)) keep++;
    h->used -= keep;
    memmove(h->V, h->V + keep * h->n, (size_t)(h->n * h->used) * sizeof(double));
    memmove(h->W, h->W + keep * h->n, (size_t)(h->n * h->used) * sizeof(double));
    memmove(h->of_window, h->of_window + keep, (size_t)h->used * sizeof(int));
    memcpy(h->x, x, (size_t)h->n * sizeof(double));
    memcpy(h->hx, hx, (size_t)h->n * sizeof(double));
    h->chained = 1;
    iqn_set(q, IQN_OMEGA, omega);
    iqn_set(q, IQN_FILTER_LIMIT, epsilon);
    for (j = 0; j < h->used; j++) iqn_push(q, h->V + j * h->n, h->W + j * h->n);
    scene_check(iqn_step(q, x, hx), "iqn_step");
    free(q);
}

/* ---- the coupled problems as loops over windows: iterations per window, or -1 where they diverge ---- */

typedef struct setting {
    int method; /* of iqn.h */
    double omega, epsilon, tol;
    int reuse, most, windows;
    history *own; /* instead of iqn.h's, or NULL */
    double mixing;
    int by_pressure; /* tube: the unknown is the pressure, the solid is called first */
} setting;

static iqn *accelerator(const setting *s, ptrdiff_t n, int columns)
{
    iqn *q = make(n, columns);
    iqn_set(q, IQN_METHOD, s->method);
    iqn_set(q, IQN_OMEGA, s->omega);
    iqn_set(q, IQN_FILTER_LIMIT, s->epsilon);
    iqn_set(q, IQN_WINDOWS, s->reuse);
    iqn_set(q, IQN_MIXING, s->mixing);
    return q;
}

static int advance(const setting *s, iqn *q, double *x, const double *hx)
{
    if (!s->own) return iqn_step(q, x, hx);
    history_step(s->own, x, hx, s->omega, s->epsilon, s->reuse);
    return 0;
}

static void next_window(const setting *s, iqn *q)
{
    iqn_commit(q);
    if (s->own) s->own->window++, s->own->chained = 0;
}

static double tube_iterations(const setting *s, double wall, double dt)
{
    double v0[NODES], p0[NODES], A0[NODES], v[NODES], p[NODES], A[NODES], answer[NODES], before[NODES];
    double *x = s->by_pressure ? p : A, *other = s->by_pressure ? A : p;
    iqn *q = accelerator(s, NODES, s->method == IQN_IMVJ ? 300 : 50);
    int i, k, win, total = 0, converged = 1;
    DT = dt;
    stiffness = wall * 5000 * sqrt(PI);
    for (i = 0; i < NODES; i++) v0[i] = 10, p0[i] = 0, A0[i] = A[i] = 1;
    for (win = 1; win <= s->windows && converged; win++) {
        memcpy(p, p0, sizeof p);
        for (k = 0, converged = 0; !converged && k < s->most; k++) {
            memcpy(before, other, sizeof before);
            if (s->by_pressure) solve_solid(p, A);
            if (solve_fluid(v0, p0, A0, A, win * DT, v, s->by_pressure ? answer : p) != 0) break;
            if (!s->by_pressure) solve_solid(p, answer);
            converged = relative_change(NODES, other, before) <= s->tol && relative_change(NODES, answer, x) <= s->tol;
            if (advance(s, q, x, answer) < 0) break;
        }
        total += k;
        memcpy(x, answer, sizeof answer);
        next_window(s, q);
        memcpy(v0, v, sizeof v), memcpy(p0, p, sizeof p), memcpy(A0, A, sizeof A);
    }
    free(q);
    return converged ? (double)total / s->windows : -1;
}

static double rods_iterations(const setting *s, double lambda, double alpha, double dt)
{
    double x[STEPS], hx[STEPS], r, size;
    iqn *q = accelerator(s, STEPS, s->method == IQN_IMVJ ? 100 : 20);
    rod start[2], end[2];
    int j, k, win, total = 0, converged = 1;
    rods_start(start, lambda, alpha);
    for (win = 0; win < s->windows && converged; win++) {
        for (j = 0; j < STEPS; j++) x[j] = start[1].u[INNER];
        for (k = 0, converged = 0; !converged && k < s->most; k++) {
            rods_map(start, dt, x, hx, end);
            for (r = size = 0, j = 0; j < STEPS; j++) r += (hx[j] - x[j]) * (hx[j] - x[j]), size += hx[j] * hx[j];
            if (!(r < 1e200)) break;
            converged = r <= s->tol * s->tol * size;
            if (advance(s, q, x, hx) < 0) break;
        }
        total += k;
        next_window(s, q);
        start[0] = end[0], start[1] = end[1];
    }
    free(q);
    return converged ? (double)total / s->windows : -1;
}

/* ---- single precision ---- */

static void single_precision(const char *directory)
{
    FILE *csv = study_file(directory, "iqn-single.csv");
    static const double tols[] = {1e-5, 1e-6, 1e-8, 1e-10, 1e-12};
    static const double ratios[] = {0.1, 1, 10, 100};
    size_t i, k;
    int single;
    printf("history in single precision: iterations per window, double | single\n");
    fprintf(csv, "problem,tolerance,double,single\n");
    for (i = 0; i < sizeof tols / sizeof *tols; i++) {
        double count[2];
        for (single = 0; single < 2; single++) {
            history h = history_make(NODES, 50, single);
            setting s = {IQN_ILS, 0.01, 1e-3, 0, 8, 100, 30, NULL, 1, 0};
            s.tol = tols[i], s.own = &h;
            count[single] = tube_iterations(&s, 1, 0.01);
            history_free(&h);
        }
        fprintf(csv, "tube,%.0e,%g,%g\n", tols[i], count[0], count[1]);
        printf("  %-24s tolerance %.0e %8.2f | %.2f\n", "tube, 30 windows", tols[i], count[0], count[1]);
    }
    for (k = 0; k < sizeof ratios / sizeof *ratios; k++)
        for (i = 2; i < sizeof tols / sizeof *tols; i += 2) {
            double count[2];
            for (single = 0; single < 2; single++) {
                history h = history_make(STEPS, 20, single);
                setting s = {IQN_ILS, 0.1, 1e-2, 0, 8, 100, 20, NULL, 1, 0};
                s.tol = tols[i], s.own = &h;
                count[single] = rods_iterations(&s, ratios[k], 1, 0.02);
                history_free(&h);
            }
            fprintf(csv, "rods %g,%.0e,%g,%g\n", ratios[k], tols[i], count[0], count[1]);
            printf("  rods, conductivity %-5g tolerance %.0e %8.2f | %.2f\n", ratios[k], tols[i], count[0], count[1]);
        }
    fclose(csv);
}

/* ---- maps ---- */

/* The last two: the defaults of iqn.h, by either unknown of the tube. */
static const struct {
    const char *name;
    int method;
    double mixing, omega, filter;
    int by_pressure;
} methods[] = {{"constant", IQN_CONSTANT, 1, 0.01, 1e-2, 0}, {"Aitken", IQN_AITKEN, 1, 0.01, 1e-2, 0},
               {"IQN-ILS", IQN_ILS, 1, 0.01, 1e-2, 0}, {"IQN-IMVJ", IQN_IMVJ, 1, 0.01, 1e-2, 0},
               {"IQN-ILS-damped", IQN_ILS, 0.05, 0.01, 1e-2, 0}, {"IQN-IMVJ-damped", IQN_IMVJ, 0.05, 0.01, 1e-2, 0},
               {"defaults-area", IQN_ILS, 1, 0.1, 0, 0}, {"defaults-pressure", IQN_ILS, 1, 0.1, 0, 1}};
enum { METHODS = (int)(sizeof methods / sizeof *methods) };

static void maps(const char *directory)
{
    FILE *csv = study_file(directory, "map-tube.csv");
    int m, i, j, works[2][METHODS];
    memset(works, 0, sizeof works);
    fprintf(csv, "method,wall,dt,iterations\n");
    for (m = 0; m < METHODS; m++) {
        for (i = 0; i <= 12; i++) /* wall 0.01 to 1e4 of the scene's */
            for (j = 0; j <= 8; j++) {
                setting s = {IQN_ILS, 0.01, 1e-2, 1e-5, -1, 400, 3, NULL, 1, 0}; /* the header's own reuse */
                double wall = pow(10, -2 + i / 2.), dt = 0.73 * pow(10, -4 + j / 2.), count; /* no multiple of the inflow's half period */
                s.method = methods[m].method, s.mixing = methods[m].mixing, s.by_pressure = methods[m].by_pressure;
                s.omega = methods[m].omega, s.epsilon = methods[m].filter;
                count = tube_iterations(&s, wall, dt);
                works[0][m] += count > 0;
                fprintf(csv, "%s,%g,%g,%g\n", methods[m].name, wall, dt, count);
            }
        study_progress("stability map: tube");
    }
    fclose(csv);
    csv = study_file(directory, "map-heat.csv");
    fprintf(csv, "method,conductivity,capacity,iterations\n");
    for (m = 0; m < 4; m++)
        for (i = -12; i <= 12; i++)
            for (j = -12; j <= 12; j++) {
                setting s = {IQN_ILS, 0.5, 1e-2, 1e-8, -1, 100, 5, NULL, 1, 0};
                double lambda = pow(10, i / 2.), alpha = pow(10, j / 2.), count;
                s.method = methods[m].method, s.mixing = methods[m].mixing;
                count = rods_iterations(&s, lambda, alpha, 0.02);
                works[1][m] += count > 0;
                fprintf(csv, "%s,%g,%g,%g\n", methods[m].name, lambda, alpha, count);
            }
    fclose(csv);
    printf("\r\033[Kcells that converge, of %d tube and %d heat cells:", 13 * 9, 25 * 25);
    for (m = 0; m < METHODS; m++) {
        printf("%s %s %d", m ? ";" : "", methods[m].name, works[0][m]);
        if (m < 4) printf(" and %d", works[1][m]);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: study_iqn DIRECTORY\n");
        return 2;
    }
    study_progress("quasi-Newton: accuracy levels");
    levels(argv[1]);
    study_progress("quasi-Newton: single precision");
    single_precision(argv[1]);
    maps(argv[1]);
    return 0;
}
