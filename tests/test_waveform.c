/* SPDX-License-Identifier: MIT

   test_waveform.c - waveform.h against published values, SciPy, and a dense solve in quadruple precision. */
#define WF_IMPLEMENTATION
#include "waveform.h"
#include "waveform.h" /* twice, on purpose */

#include "check.h"

#include <float.h>

/* ---- the judge: the same spline by the textbook, dense, pivoted, in quadruple precision ------------------------------ */

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

enum { JUDGE = 128 };

typedef struct judge {
    int p, m;
    quad t[JUDGE]; /* a repeated time is a derivative */
    quad u[JUDGE + 32], a[JUDGE][JUDGE];
    double condition; /* row-sum norm of the inverse; that of the matrix is 1 when all columns are values */
} judge;

static quad judge_abs(quad v)
{
    return v < 0 ? -v : v;
}

/* The deriv-th derivatives of all basis functions on the polynomial piece of span: the two recursions, over all functions. */
static void judge_splines(const judge *g, int deriv, int span, quad t, quad *N)
{
    const quad *u = g->u;
    quad B[JUDGE + 32];
    int i, k;
    for (i = 0; i < g->m + g->p; i++) B[i] = i == span;
    for (k = 1; k <= g->p; k++)
        for (i = 0; i < g->m + g->p - k; i++) {
            quad left = u[i + k] - u[i], right = u[i + k + 1] - u[i + 1], v = 0;
            if (k <= g->p - deriv) {
                if (left > 0) v += (t - u[i]) / left * B[i];
                if (right > 0) v += (u[i + k + 1] - t) / right * B[i + 1];
            } else {
                if (left > 0) v += k * B[i] / left;
                if (right > 0) v -= k * B[i + 1] / right;
            }
            B[i] = v;
        }
    for (i = 0; i < g->m; i++) N[i] = deriv > g->p ? 0 : B[i];
}

static int judge_span(const judge *g, quad t)
{
    int k = g->m - 1;
    while (k > g->p && !(g->u[k] < t)) k--;
    return k;
}

/* Solve transpose(A) w = b, or A w = b, by Gauss with pivoting. */
static void judge_solve(const judge *g, int transpose, quad *b)
{
    static quad a[JUDGE][JUDGE];
    int m = g->m, i, j, k, best;
    for (i = 0; i < m; i++)
        for (j = 0; j < m; j++) a[i][j] = transpose ? g->a[j][i] : g->a[i][j];
    for (k = 0; k < m; k++) {
        quad v;
        for (best = k, i = k; i < m; i++)
            if (judge_abs(a[i][k]) > judge_abs(a[best][k])) best = i;
        for (j = 0; j < m; j++) v = a[k][j], a[k][j] = a[best][j], a[best][j] = v;
        v = b[k], b[k] = b[best], b[best] = v;
        for (i = k + 1; i < m; i++) {
            v = a[i][k] / a[k][k];
            if (!(judge_abs(v) > 0)) continue;
            for (j = k; j < m; j++) a[i][j] -= v * a[k][j];
            b[i] -= v * b[k];
        }
    }
    for (i = m - 1; i >= 0; i--) {
        for (j = i + 1; j < m; j++) b[i] -= a[i][j] * b[j];
        b[i] /= a[i][i];
    }
}

static int judge_slope(const judge *g, int j)
{
    return j > 0 && !(g->t[j] > g->t[j - 1]);
}

static const judge *judge_of(const wf *w)
{
    static judge g;
    quad e[JUDGE], sum;
    int i, j, m = wf_columns(w), p = wf_degree(w);
    g.p = p;
    g.m = m;
    for (i = 0; i < m; i++) g.t[i] = (quad)wf_time(w, i);
    for (i = 0; i <= p; i++) g.u[i] = g.t[0];
    for (j = 1; j < m - p; j++) {
        for (sum = 0, i = 0; i < p; i++) sum += g.t[j + i];
        g.u[p + j] = p > 0 ? sum / p : g.t[j - 1];
    }
    for (i = 0; i <= p; i++) g.u[m + i] = g.t[m - 1];
    for (i = 0; i < m; i++)
        judge_splines(&g, judge_slope(&g, i), judge_span(&g, g.t[i]), g.t[i], g.a[i]);
    for (g.condition = 1, i = 0; i < m; i++) { /* row i of the inverse */
        for (j = 0; j < m; j++) e[j] = i == j;
        judge_solve(&g, 1, e);
        for (sum = 0, j = 0; j < m; j++) sum += judge_abs(e[j]);
        if ((double)sum > g.condition) g.condition = (double)sum;
    }
    return &g;
}

static void judge_weights(const judge *g, quad t, int deriv, quad *weight)
{
    judge_splines(g, deriv, judge_span(g, t), t, weight);
    judge_solve(g, 1, weight);
}

/* ---- helpers ---------------------------------------------------------------------------------------------------------- */

static double block[1 << 21];

static wf *grid(int degree, int m, const double *t)
{
    wf *w = NULL;
    int j;
    CHECK_INT(wf_make(&w, degree, m > 0 ? m : 1, block, sizeof block), WF_OK);
    for (j = 0; j < m; j++) CHECK_INT(wf_push(w, t[j]), j);
    return w;
}

/* largest |weight - judge| over times inside, relative to eps times the condition */
static double misfit(const wf *w, int deriv)
{
    const judge *g = judge_of(w);
    double weight[JUDGE], worst = 0, size;
    quad exact[JUDGE];
    int i, j, k;
    for (i = 1; i < g->m; i++)
        for (k = 0; k < 3; k++) {
            double t0 = (double)g->t[i - 1], t = t0 + ((double)g->t[i] - t0) * (0.18 + 0.31 * k);
            CHECK(wf_weights(w, t, deriv, weight) >= 0);
            judge_weights(g, (quad)t, deriv, exact);
            for (size = 0, j = 0; j < g->m; j++) size += (double)judge_abs(exact[j]);
            if (size < 1) size = 1;
            for (j = 0; j < g->m; j++) {
                double off = (double)judge_abs((quad)weight[j] - exact[j]) / (DBL_EPSILON * g->condition * size);
                if (off > worst) worst = off;
            }
        }
    return worst;
}

/* isnan on the bits: these tests also run under -ffast-math, which folds isnan to false */
static int not_a_number(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits << 1 > (uint64_t)0x7ff << 53;
}

static double powi(double x, int k)
{
    double v = 1;
    while (k-- > 0) v *= x;
    return v;
}

/* a 32-bit generator, so that every run sees the same times */
static double uniform(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/* ---- published and SciPy values ------------------------------------------------------------------------------------------ */

/* preCICE's own unit tests of its B-splines and waveforms */
static void test_values_of_precice_unit_tests(void **state)
{
    static const double t1[] = {0, 1, 3}, x1[] = {1, 2, 3}, t2[] = {0, 0.5, 1}, x2[] = {0, 0, 2};
    double c[3], v;
    wf *w = grid(2, 3, t1);
    (void)state;
    CHECK_INT(wf_interpolate(w, 0.5, 0, 1, x1, 1, &v), WF_OK);
    CHECK_NEAR(v, 37.0 / 24, 5e-16);
    CHECK_INT(wf_fit(w, 1, x1, 1, c, 1), WF_OK);
    CHECK_INT(wf_eval(w, 2, 0, 1, c, 1, &v), WF_OK);
    CHECK_NEAR(v, 8.0 / 3, 8e-16);
    w = grid(2, 3, t2);
    CHECK_INT(wf_interpolate(w, 0.25, 0, 1, x2, 1, &v), WF_OK);
    CHECK_NEAR(v, -0.25, 5e-16);
    CHECK_INT(wf_interpolate(w, 0.75, 0, 1, x2, 1, &v), WF_OK);
    CHECK_NEAR(v, 0.75, 5e-16);
}

/* SciPy 1.10.1: make_interp_spline(t, sin(3 t) + 0.3 t^2, k=p, t=clamped ends and means of p consecutive times) at q, and its
   derivative() there, and integrate(0.2, 2.7) */
static const double scipy_t[] = {0, 0.1, 0.35, 0.4, 0.75, 1.0, 1.6, 1.7, 2.5, 3.0};
static const double scipy_q[] = {0.05, 0.37, 0.9, 1.65, 2.2, 2.99};
static const struct {
    int degree;
    double value[6], slope[6], integral;
} scipy[] = {
    {2,
     {0.15227413585475563, 0.93677762780589657, 0.66040673342767586, -0.15428122457203206, 1.822654971139132,
      3.1226914572087545},
     {2.9852020666133967, 1.5611077103978812, -2.2521643384611654, 1.728087327235613, 4.3147423944796044,
      -1.023510784176761},
     2.3405401792190963},
    {3,
     {0.15033048865413573, 0.93672495625199215, 0.66910290720393584, -0.15361415762024883, 1.6746594457069717,
      3.1389825709279875},
     {2.9950907054212461, 1.5551373630214311, -2.166564094953185, 1.6980051962493903, 4.1703506939318329,
      -2.6025781011832807},
     2.2911531158330045},
    {5,
     {0.15012309984193187, 0.93676556365518349, 0.67042446506358822, -0.15499132850813452, 1.7444939852752415,
      3.1230896100833858},
     {2.9969212214285426, 1.5559367934544706, -2.1723611151628699, 1.6966885374439544, 4.1635025697486885,
      -1.0800054859767823},
     2.3175239847891884},
    {9,
     {0.15018596432201123, 0.93676873002041039, 0.67039160507733164, -0.15512186659931565, 1.7521946104641382,
      3.1379187349654361},
     {2.9963461797446396, 1.5559857064119287, -2.1722087132803058, 1.696275331075491, 4.1365488260029366,
      -2.4626144858947305},
     2.3235585611474652},
};

static void test_values_of_scipy(void **state)
{
    double x[10], c[10], v[6];
    size_t k;
    int i;
    (void)state;
    for (i = 0; i < 10; i++) x[i] = sin(3 * scipy_t[i]) + 0.3 * scipy_t[i] * scipy_t[i];
    for (k = 0; k < sizeof scipy / sizeof *scipy; k++) {
        wf *w = grid(scipy[k].degree, 10, scipy_t);
        double tolerance = DBL_EPSILON * (8 + judge_of(w)->condition);
        CHECK(wf_fit(w, 1, x, 1, c, 1) >= 0);
        CHECK_INT(wf_eval_many(w, 6, scipy_q, 0, 1, c, 1, v, 1), WF_OK);
        for (i = 0; i < 6; i++) CHECK_NEAR(v[i], scipy[k].value[i], tolerance);
        CHECK_INT(wf_eval_many(w, 6, scipy_q, 1, 1, c, 1, v, 1), WF_OK);
        for (i = 0; i < 6; i++) CHECK_NEAR(v[i], scipy[k].slope[i], 100 * tolerance);
        CHECK_INT(wf_mean(w, 0.2, 2.7, 1, c, 1, v), WF_OK);
        CHECK_NEAR(2.5 * v[0], scipy[k].integral, 3 * tolerance);
        CHECK_INT(wf_integral(w, 0.2, 2.7, 1, c, 1, v), WF_OK);
        CHECK_NEAR(v[0], scipy[k].integral, 3 * tolerance);
        for (i = 0; i < 6; i++) {
            CHECK(wf_interpolate(w, scipy_q[i], 0, 1, x, 1, v) >= 0);
            CHECK_NEAR(v[0], scipy[k].value[i], tolerance);
        }
    }
}

/* ---- identities ----------------------------------------------------------------------------------------------------------- */

static void test_weights_agree_with_a_dense_quadruple_solve(void **state)
{
    double t[24];
    unsigned seed = 1;
    int degree, m, j, deriv;
    (void)state;
    for (degree = 0; degree <= WF_MAX_DEGREE; degree++)
        for (m = 2; m <= 24; m += 11) {
            for (t[0] = -0.4, j = 1; j < m; j++) t[j] = t[j - 1] + 0.1 + uniform(&seed);
            for (deriv = 0; deriv <= 2; deriv++) CHECK(misfit(grid(degree, m, t), deriv) < 8);
        }
}

static void test_growth_gives_the_grid_made_at_once(void **state)
{
    static double other[4096];
    double t[40], a[40], b[40];
    unsigned seed = 2;
    int degree, j, k;
    (void)state;
    for (t[0] = 5, j = 1; j < 40; j++) t[j] = t[j - 1] + 0.1 + uniform(&seed);
    for (degree = 0; degree <= 9; degree++) {
        wf *grown, *fresh;
        CHECK_INT(wf_make(&grown, degree, 40, other, sizeof other), WF_OK);
        for (j = 0; j < 40; j++) {
            wf_push(grown, t[j]);
            if (j % 7 == 6) { /* a detour that is taken back leaves no trace */
                wf_rollback(grown);
                for (k = 1; k <= j; k++) wf_push(grown, t[k]);
            }
            fresh = grid(degree, j + 1, t);
            CHECK_INT(wf_weights(fresh, t[j] - 0.07, 0, a), wf_weights(grown, t[j] - 0.07, 0, b));
            CHECK(memcmp(a, b, (size_t)(j + 1) * sizeof *a) == 0);
            CHECK_INT(wf_weights(fresh, t[j / 2] + 0.07, 0, a), wf_weights(grown, t[j / 2] + 0.07, 0, b));
            CHECK(memcmp(a, b, (size_t)(j + 1) * sizeof *a) == 0);
        }
    }
}

static void test_polynomials_are_reproduced_with_every_derivative(void **state)
{
    double t[14], x[28], c[28], v, exact;
    unsigned seed = 3;
    int degree, hermite, j, i, k, deriv;
    (void)state;
    for (t[0] = 0.5, j = 1; j < 14; j++) t[j] = t[j - 1] + 0.05 + 0.1 * uniform(&seed);
    for (degree = 0; degree <= 9; degree++)
        for (hermite = 0; hermite <= (degree > 1); hermite++) {
            wf *w;
            double condition;
            CHECK_INT(wf_make(&w, degree, 28, block, sizeof block), WF_OK);
            for (j = 0; j < 14; j++) {
                k = hermite ? wf_push_hermite(w, t[j]) : wf_push(w, t[j]);
                x[k] = powi(t[j], degree);
                if (hermite) x[k + 1] = degree * powi(t[j], degree - 1);
            }
            CHECK_INT(wf_degree(w), degree);
            condition = judge_of(w)->condition;
            CHECK_INT(wf_fit(w, 1, x, 1, c, 1), WF_OK);
            for (deriv = 0; deriv <= degree + 1; deriv++)
                for (i = 0; i <= 20; i++) {
                    double s = t[0] + (t[13] - t[0]) * i / 20, scale = condition;
                    for (exact = powi(s, degree - deriv), k = 0; k < deriv; k++) exact *= degree - k;
                    if (deriv > degree) exact = 0;
                    for (k = 0; k < deriv; k++) scale *= degree * 30.0;
                    CHECK_INT(wf_eval(w, s, deriv, 1, c, 1, &v), WF_OK);
                    CHECK_NEAR(v, exact, 4 * DBL_EPSILON * scale * powi(t[13], degree));
                }
        }
}

static void test_weights_sum_to_one_and_basis_is_positive(void **state)
{
    double t[11], weight[11], N[WF_MAX_DEGREE + 1], sum;
    unsigned seed = 4;
    int degree, i, j, first;
    (void)state;
    for (t[0] = -3, j = 1; j < 11; j++) t[j] = t[j - 1] + 0.1 + uniform(&seed);
    for (degree = 0; degree <= 9; degree++) {
        wf *w = grid(degree, 11, t);
        double condition = judge_of(w)->condition;
        for (i = 0; i <= 200; i++) {
            double s = t[0] + (t[10] - t[0]) * i / 200;
            CHECK(wf_weights(w, s, 0, weight) >= 0);
            for (sum = 0, j = 0; j < 11; j++) sum += weight[j];
            CHECK_NEAR(sum, 1, 4 * DBL_EPSILON * condition);
            CHECK_INT(wf_basis(w, s, 0, &first, N), WF_OK);
            for (sum = 0, j = 0; j <= degree; j++) {
                CHECK(N[j] >= 0);
                sum += N[j];
            }
            CHECK_NEAR(sum, 1, 8 * DBL_EPSILON);
        }
    }
}

static double worst_error(int degree, int m, int deriv)
{
    double t[257], x[257], c[257], v, worst = 0;
    wf *w;
    int j;
    for (j = 0; j < m; j++) {
        t[j] = 1.0 * j / (m - 1);
        t[j] += 0.1 * sin(6 * t[j]);
        x[j] = sin(12 * t[j] + 0.3);
    }
    w = grid(degree, m, t);
    wf_fit(w, 1, x, 1, c, 1);
    for (j = 0; j <= 4000; j++) {
        double s = t[0] + (t[m - 1] - t[0]) * j / 4000;
        wf_eval(w, s, deriv, 1, c, 1, &v);
        v -= deriv ? 12 * cos(12 * s + 0.3) : sin(12 * s + 0.3);
        if (fabs(v) > worst) worst = fabs(v);
    }
    return worst;
}

static void test_errors_fall_with_order_degree_plus_one(void **state)
{
    int degree;
    (void)state;
    for (degree = 0; degree <= 5; degree++) {
        int m = degree < 5 ? 129 : 65;
        double order = log2(worst_error(degree, m, 0) / worst_error(degree, 2 * m - 1, 0));
        CHECK_NEAR(order, degree + 1, 0.2);
        if (degree < 1) continue;
        order = log2(worst_error(degree, m, 1) / worst_error(degree, 2 * m - 1, 1));
        CHECK_NEAR(order, degree, 0.2);
    }
}

static void test_weights_applied_by_hand_give_the_evaluation(void **state)
{
    double x[9 * 5], c[9 * 5], weight[9], N[4], v[5], u[5], sum;
    double t[9];
    unsigned seed = 5;
    int i, j, first = 0;
    wf *w;
    (void)state;
    for (t[0] = 2, j = 1; j < 9; j++) t[j] = t[j - 1] + 0.1 + uniform(&seed);
    for (i = 0; i < 45; i++) x[i] = uniform(&seed) - 0.5;
    w = grid(3, 9, t);
    CHECK_INT(wf_fit(w, 5, x, 5, c, 5), WF_OK);
    CHECK_INT(wf_weights(w, 3.3, 1, weight), WF_OK);
    CHECK_INT(wf_interpolate(w, 3.3, 1, 5, x, 5, v), WF_OK);
    CHECK_INT(wf_basis(w, 3.3, 1, &first, N), WF_OK);
    CHECK_INT(wf_eval(w, 3.3, 1, 5, c, 5, u), WF_OK);
    for (i = 0; i < 5; i++) {
        for (sum = 0, j = 0; j < 9; j++) sum += weight[j] * x[5 * j + i];
        CHECK_NEAR(v[i], sum, 1e-13);
        for (sum = 0, j = 0; j < 4; j++) sum += N[j] * c[5 * (first + j) + i];
        CHECK_NEAR(u[i], sum, 1e-13);
        CHECK_NEAR(u[i], v[i], 1e-13);
    }
}

/* ---- the window ----------------------------------------------------------------------------------------------------------- */

static void test_window_grows_rolls_back_and_moves_on(void **state)
{
    double x[6 * 2] = {0, 0, 1, 10, 2, 20, 3, 30, -1, -1, -1, -1};
    wf *w;
    int i;
    (void)state;
    CHECK_INT(wf_make(&w, 3, 6, block, sizeof block), WF_OK);
    CHECK_INT(wf_columns(w), 0);
    CHECK_INT(wf_push(w, 0), 0);
    CHECK_INT(wf_degree(w), 0);
    for (i = 1; i <= 3; i++) CHECK_INT(wf_push(w, i), i);
    CHECK_INT(wf_degree(w), 3);
    CHECK_INT(wf_push(w, 2), 2);
    CHECK_INT(wf_columns(w), 4);
    CHECK_INT(wf_rollback(w), WF_OK);
    CHECK_INT(wf_columns(w), 1);
    CHECK_INT(wf_push(w, 1.5), 1);
    CHECK_INT(wf_degree(w), 1);
    CHECK_INT(wf_rollback(w), WF_OK);
    for (i = 1; i <= 3; i++) CHECK_INT(wf_push(w, i), i);
    CHECK_INT(wf_advance(w, 2, 2, x, 2), WF_OK);
    CHECK_INT(wf_columns(w), 3);
    CHECK_INT(wf_start(w), 2);
    CHECK(wf_time(w, 0) == 1 && wf_time(w, 2) == 3 && not_a_number(wf_time(w, 3)) && not_a_number(wf_time(w, -1)));
    CHECK(x[0] == 1 && x[1] == 10 && x[4] == 3 && x[5] == 30);
    CHECK_INT(wf_push(w, 4), 3);
    CHECK_INT(wf_degree(w), 3);
    CHECK_INT(wf_rollback(w), WF_OK);
    CHECK_INT(wf_columns(w), 3);
    CHECK_INT(wf_advance(w, 0, 2, x, 2), WF_OK);
    CHECK_INT(wf_columns(w), 1);
    CHECK(wf_time(w, 0) == 3 && x[0] == 3 && x[1] == 30);
}

static void test_hermite_samples_keep_the_order_of_single_steps(void **state)
{
    double x[8], v, worst[2];
    wf *w;
    int k, i, j;
    (void)state;
    for (k = 0; k < 2; k++) { /* one sub-step, value and derivative at both ends: cubic Hermite, order 4 */
        double h = k ? 0.1 : 0.2;
        CHECK_INT(wf_make(&w, 3, 8, block, sizeof block), WF_OK);
        for (j = 0; j < 2; j++) {
            i = wf_push_hermite(w, 1 + j * h);
            CHECK_INT(i, 2 * j);
            x[i] = sin(1 + j * h);
            x[i + 1] = cos(1 + j * h);
        }
        CHECK_INT(wf_degree(w), 3);
        for (worst[k] = 0, i = 0; i <= 20; i++) {
            double s = 1 + h * i / 20;
            CHECK_INT(wf_interpolate(w, s, 0, 1, x, 1, &v), WF_OK);
            if (fabs(v - sin(s)) > worst[k]) worst[k] = fabs(v - sin(s));
        }
        CHECK_INT(wf_interpolate(w, 1 + h, 1, 1, x, 1, &v), WF_OK);
        CHECK(v == x[3]);
        CHECK_INT(wf_advance(w, 0, 1, x, 1), WF_OK);
        CHECK_INT(wf_columns(w), 2);
        CHECK(x[0] == sin(1 + h) && x[1] == cos(1 + h));
        CHECK_INT(wf_push_hermite(w, 1 + h), 0);
        CHECK_INT(wf_push(w, 2), 2);
        CHECK_INT(wf_push_hermite(w, 2), 2); /* the last sample gets its derivative later */
        CHECK_INT(wf_columns(w), 4);
        CHECK_INT(wf_push(w, 3), 4);
        CHECK_INT(wf_push(w, 4), 5);
        CHECK_INT(wf_push_hermite(w, 3), WF_EORDER);
    }
    CHECK(log2(worst[0] / worst[1]) > 3.8);
}

static void test_mixed_hermite_grids_agree_with_the_judge(void **state)
{
    unsigned seed = 6;
    int degree, pattern, j;
    (void)state;
    for (degree = 2; degree <= 9; degree++)
        for (pattern = 0; pattern < 32; pattern++) {
            double t = 0;
            wf *w;
            CHECK_INT(wf_make(&w, degree, 40, block, sizeof block), WF_OK);
            for (j = 0; j < 12; j++) {
                t += 0.2 + uniform(&seed);
                CHECK(((pattern >> (j % 5)) & 1 ? wf_push_hermite(w, t) : wf_push(w, t)) >= 0);
                if (j == 11 || (j > 0 && pattern % 11 == 0)) CHECK(misfit(w, 0) < 8);
            }
        }
}

static void test_degree_zero_holds_the_later_sample(void **state)
{
    static const double t[] = {0, 1, 3}, x[] = {10, 20, 30};
    wf *w = grid(0, 3, t);
    double v, nearly = nextafter(1.0, 2.0);
    (void)state;
    wf_interpolate(w, 0, 0, 1, x, 1, &v);
    CHECK(v == 10);
    wf_interpolate(w, 0.01, 0, 1, x, 1, &v);
    CHECK(v == 20);
    wf_interpolate(w, 1, 0, 1, x, 1, &v);
    CHECK(v == 20);
    wf_interpolate(w, nearly, 0, 1, x, 1, &v); /* 1 + 1 ulp is still the time 1 */
    CHECK(v == 20);
    wf_interpolate(w, 1.001, 0, 1, x, 1, &v);
    CHECK(v == 30);
    CHECK_INT(wf_interpolate(w, 7, 0, 1, x, 1, &v), WF_EXTRAP);
    CHECK(v == 30);
    CHECK_INT(wf_interpolate(w, -7, 0, 1, x, 1, &v), WF_EXTRAP);
    CHECK(v == 10);
}

/* ---- resampling ----------------------------------------------------------------------------------------------------------- */

static void test_resampling(void **state)
{
    static double other[4096];
    static double x[13 * 5000], y[13 * 5000], z[13 * 5000];
    double t[9], s[13], c[9], v;
    unsigned seed = 7;
    wf *from, *to;
    int i, j, n = 5000;
    (void)state;
    for (t[0] = 0, j = 1; j < 9; j++) t[j] = t[j - 1] + 0.2 + uniform(&seed);
    for (j = 0; j < 13; j++) s[j] = t[8] * j / 12;
    s[5] = t[3]; /* a time that both share */
    for (i = 0; i < 9 * n; i++) x[i] = uniform(&seed);
    from = grid(3, 9, t);
    CHECK_INT(wf_make(&to, 3, 13, other, sizeof other), WF_OK);
    for (j = 0; j < 13; j++) CHECK_INT(wf_push(to, s[j]), j);
    CHECK_INT(wf_resample(from, to, n, x, n, y, n), WF_OK);
    for (i = 0; i < n; i += 617)
        for (j = 0; j < 13; j++) {
            CHECK_INT(wf_fit(from, 1, x + i, n, c, 1), WF_OK);
            CHECK_INT(wf_eval(from, s[j], 0, 1, c, 1, &v), WF_OK);
            CHECK_NEAR(y[j * n + i], v, 1e-15 * 8);
        }
    CHECK(memcmp(y + 5 * n, x + 3 * n, (size_t)n * sizeof *x) == 0);
    memcpy(z, x, sizeof z);
    CHECK_INT(wf_resample(from, to, n, z, n, z, n), WF_OK); /* in place, growing */
    CHECK(memcmp(y, z, sizeof z) == 0);
    CHECK_INT(wf_resample(to, from, n, y, n, y, n), WF_OK); /* in place, shrinking; same grid is the identity */
    CHECK_INT(wf_resample(from, from, n, x, n, z, n), WF_OK);
    CHECK(memcmp(x, z, (size_t)(9 * n) * sizeof *x) == 0);
    CHECK_INT(wf_resample(from, from, n, z, n, z, n), WF_OK);
    CHECK(memcmp(x, z, (size_t)(9 * n) * sizeof *x) == 0);
}

/* ---- statuses ------------------------------------------------------------------------------------------------------------- */

static void test_every_status_is_reached_and_touches_nothing(void **state)
{
    static const double t[] = {0, 1, 2, 3};
    double x[8] = {1, 2, 3, 4, 5, 6, 7, 8}, out[4] = {7, 7, 7, 7}, before[8];
    static double mem[512];
    wf *w = NULL, *none;
    int first = -7;
    (void)state;
    CHECK(wf_size(-1, 3) == 0 && wf_size(WF_MAX_DEGREE + 1, 3) == 0 && wf_size(3, 0) == 0 && wf_size(3, -1) == 0);
    CHECK_INT(wf_make(NULL, 3, 4, mem, sizeof mem), WF_EARG);
    CHECK_INT(wf_make(&w, -1, 4, mem, sizeof mem), WF_EARG);
    CHECK_INT(wf_make(&w, 3, 4, NULL, sizeof mem), WF_EMEM);
    CHECK_INT(wf_make(&w, 3, 4, mem, wf_size(3, 4) - 1), WF_EMEM);
    CHECK_INT(wf_make(&w, 3, 4, (char *)mem + 4, sizeof mem - 4), WF_EMEM);
    CHECK(w == NULL);
    CHECK_INT(wf_make(&none, 3, 4, mem, wf_size(3, 4)), WF_OK);
    CHECK_INT(wf_interpolate(none, 0, 0, 1, x, 1, out), WF_EFEW);
    CHECK_INT(wf_fit(none, 1, x, 1, out, 1), WF_EFEW);
    CHECK_INT(wf_rollback(none), WF_EFEW);
    CHECK_INT(wf_advance(none, 0, 1, x, 1), WF_EFEW);
    w = grid(3, 4, t);
    memcpy(before, w, sizeof before);
    CHECK_INT(wf_push(w, (double)NAN), WF_EARG);
    CHECK_INT(wf_push(w, (double)INFINITY), WF_EARG);
    CHECK_INT(wf_push(NULL, 0), WF_EARG);
    CHECK_INT(wf_push(w, 2.5), WF_EORDER);
    CHECK_INT(wf_push(w, -1), WF_EORDER);
    CHECK_INT(wf_push(w, 4), WF_EFULL);
    CHECK_INT(wf_push_hermite(w, 3), WF_EFULL);
    CHECK_INT(wf_advance(w, -1, 1, x, 1), WF_EARG);
    CHECK_INT(wf_interpolate(w, (double)NAN, 0, 1, x, 1, out), WF_EARG);
    CHECK_INT(wf_interpolate(w, 0, -1, 1, x, 1, out), WF_EARG);
    CHECK_INT(wf_interpolate(w, 0, 0, -1, x, 1, out), WF_EARG);
    CHECK_INT(wf_interpolate(w, 0, 0, 1, NULL, 1, out), WF_EARG);
    CHECK_INT(wf_interpolate(w, 0, 0, 2, x, 1, out), WF_EARG);
    CHECK_INT(wf_interpolate(w, 0, 0, 2, x, 2, x + 1), WF_EARG);
    CHECK_INT(wf_interpolate(w, 1e200, 0, 1, x, 1, out), WF_ERANGE);
    CHECK_INT(wf_basis(w, (double)NAN, 0, &first, out), WF_EARG);
    CHECK_INT(wf_basis(w, 0, 0, NULL, out), WF_EARG);
    CHECK_INT(wf_fit(w, 1, NULL, 1, out, 1), WF_EARG);
    CHECK_INT(wf_fit(w, 2, x, 2, x + 1, 2), WF_EARG);
    CHECK_INT(wf_eval(w, (double)INFINITY, 0, 1, x, 1, out), WF_EARG);
    CHECK_INT(wf_eval_many(w, 1, NULL, 0, 1, x, 1, out, 1), WF_EARG);
    CHECK_INT(wf_resample(w, NULL, 1, x, 1, out, 1), WF_EARG);
    CHECK(memcmp(before, w, sizeof before) == 0 && first == -7 && out[0] == 7 && x[0] == 1 && x[7] == 8);
    CHECK_INT(wf_interpolate(w, 3.1, 0, 1, x, 1, out), WF_EXTRAP);
    CHECK_INT(wf_make(&w, 1, 4, mem, sizeof mem), WF_OK);
    CHECK_INT(wf_push_hermite(w, 0), WF_EARG);
    CHECK_INT(wf_make(&w, 3, 5000, block, sizeof block), WF_OK);
    for (first = 0; first < 5000; first++) wf_push(w, first);
    CHECK_INT(wf_interpolate(w, 0.5, 0, 0, NULL, 0, NULL), WF_ELONG);
    CHECK_INT(wf_resample(w, w, 0, NULL, 0, NULL, 0), WF_ELONG);
    CHECK_INT(wf_version(), WF_VERSION);
}

static void test_every_status_has_a_message(void **state)
{
    static const int status[] = {WF_OK,    WF_EXTRAP, WF_EARG,   WF_EMEM, WF_EORDER,
                                 WF_EFULL, WF_EFEW,   WF_ERANGE, WF_ELONG};
    size_t i;
    (void)state;
    for (i = 0; i < sizeof status / sizeof *status; i++) CHECK(strstr(wf_message(status[i]), "unknown") == NULL);
    CHECK(strstr(wf_message(12345), "unknown") && strstr(wf_message(-9), "unknown"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_of_precice_unit_tests),
        cmocka_unit_test(test_values_of_scipy),
        cmocka_unit_test(test_weights_agree_with_a_dense_quadruple_solve),
        cmocka_unit_test(test_growth_gives_the_grid_made_at_once),
        cmocka_unit_test(test_polynomials_are_reproduced_with_every_derivative),
        cmocka_unit_test(test_weights_sum_to_one_and_basis_is_positive),
        cmocka_unit_test(test_errors_fall_with_order_degree_plus_one),
        cmocka_unit_test(test_weights_applied_by_hand_give_the_evaluation),
        cmocka_unit_test(test_window_grows_rolls_back_and_moves_on),
        cmocka_unit_test(test_hermite_samples_keep_the_order_of_single_steps),
        cmocka_unit_test(test_mixed_hermite_grids_agree_with_the_judge),
        cmocka_unit_test(test_degree_zero_holds_the_later_sample),
        cmocka_unit_test(test_resampling),
        cmocka_unit_test(test_every_status_is_reached_and_touches_nothing),
        cmocka_unit_test(test_every_status_has_a_message),
    };
    return cmocka_run_group_tests_name("waveform", tests, NULL, NULL);
}
