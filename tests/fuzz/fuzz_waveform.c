/* SPDX-License-Identifier: MIT

   fuzz_waveform.c - sequences of calls of waveform.h against a second implementation: see fuzz.h for the driver

   Half of the inputs drive an object and a slow model of it: lists of times and samples, knots by the formula of the
   header, dense collocation with pivoting, recursive bases, Gauss' rule and Lagrange's polynomials in quadruple precision.
   Columns, window, samples, degrees, remarks, weights, values, means, coefficients and guesses must agree.
   The other half calls everything with any arguments: no access outside the arrays (the sanitizers watch), a negative
   status leaves what a host sees as it was, and a copy of the object behaves as the object.                             */
#define WF_IMPLEMENTATION
#include "waveform.h"

#ifndef FUZZ_COUNT
#    define FUZZ_COUNT 2000
#endif
#include "fuzz.h"

enum { CAPACITY = 22, N = 2 };

/* ---- the model: a list of columns ------------------------------------------------------------------------------------ */

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#    define EPS ((quad)DBL_EPSILON)
#    define MODEL 1
#else
typedef long double quad;
#    define EPS ((quad)DBL_EPSILON)
#    define MODEL 0
#endif

typedef struct model {
    int degree, limit, history, columns, start;
    int seen; /* columns that were read or guessed */
    double t[CAPACITY], x[CAPACITY][N];
    int kind[CAPACITY]; /* 0, WF_SLOPE, WF_BREAK */
    int opened[CAPACITY]; /* by wf_begin */
    double length, last; /* of the window before; of slivers not */
} model;

static double gap_of_ulps(const model *g, double t) /* one ulp of the largest time */
{
    double most = fmax(fabs(t), fabs(g->t[0]));
    if (g->columns) most = fmax(most, fabs(g->t[g->columns - 1]));
    return nextafter(most, HUGE_VAL) - most;
}

static int newest(const model *g)
{
    return g->columns - 1 - (g->kind[g->columns - 1] == WF_SLOPE);
}

/* The value column of the sample so many samples before the one at a column, at most back to a break. */
static int older(const model *g, int column, int samples)
{
    while (samples-- > 0 && column > 0 && g->kind[column] != WF_BREAK) column -= 1 + (g->kind[column - 1] == WF_SLOPE);
    return column;
}

static int model_append(model *g, double t, int what, int opened)
{
    const int m = g->columns, slope = what & WF_SLOPE ? 1 : 0;
    if (m + 1 + slope > CAPACITY) return WF_EFULL;
    g->t[m] = t, g->kind[m] = what & WF_BREAK, g->opened[m] = opened;
    if (slope) g->t[m + 1] = t, g->kind[m + 1] = WF_SLOPE, g->opened[m + 1] = opened;
    g->columns += 1 + slope;
    return m;
}

/* The column that a push at t means: the first of its time, but for round-off, or for 4096 ulp or an eighth of a step where wf_begin opened it
   behind the start, or what is pushed is a break; or -1. */
static int model_find(const model *g, double t, int what)
{
    int j;
    for (j = 0; j < g->columns; j++) {
        double step = HUGE_VAL, most;
        int k;
        if (j > 0 && !(g->t[j] > g->t[j - 1])) continue;
        for (k = 0; k < g->columns; k++)
            if (g->t[k] > g->t[j] || g->t[k] < g->t[j]) step = fmin(step, fabs(g->t[k] - g->t[j]));
        if (g->opened[j] && (j > g->start || what & WF_BREAK)) most = fmin(4096 * gap_of_ulps(g, t), step / 8);
        else most = fmin(4 * gap_of_ulps(g, t), step / 1000);
        if (fabs(t - g->t[j]) <= (step < HUGE_VAL ? most : 0)) return j;
    }
    return -1;
}

/* What wf_push returns; the model takes the columns. */
static int model_push(model *g, double t, int what)
{
    const int slope = what & WF_SLOPE ? 1 : 0, m = g->columns;
    int j = model_find(g, t, what), after;
    if (slope && g->limit < 2) return WF_EDEGREE;
    if (j < 0) {
        if (what & WF_BREAK || (m > 0 && t <= g->t[m - 1])) return WF_EORDER;
        return model_append(g, t, what, 0);
    }
    after = j + 1 + (j + 1 < m && g->kind[j + 1] == WF_SLOPE);
    if (what & WF_BREAK) {
        if (after == m) return model_append(g, g->t[j], what, g->opened[j]);
        if (g->t[after] > g->t[j]) return WF_EORDER;
        j = after;
    }
    if (j >= g->seen || (!(g->opened[j] && j > g->start) && !fuzz_same(t, g->t[j]))) return WF_ETWICE;
    if (slope && !(j + 1 < m && g->kind[j + 1] == WF_SLOPE)) {
        if (j < m - 1) return WF_ENOSLOPE;
        if (m == CAPACITY) return WF_EFULL;
        g->t[m] = g->t[j], g->kind[m] = WF_SLOPE, g->opened[m] = 0;
        g->columns++;
        return j;
    }
    return !slope && j + 1 < m && g->kind[j + 1] == WF_SLOPE ? WF_ESLOPE : j;
}

static void model_cut(model *g, int m)
{
    g->columns = m;
    if (g->seen > m) g->seen = m;
}

static int model_rollback(model *g)
{
    int j = g->start;
    if (g->columns == 0) return WF_EFEW;
    while (j < g->columns && !(g->t[j] > g->t[g->start])) j++;
    model_cut(g, j);
    return WF_OK;
}

/* Samples of a sliver, which take no part, are forgotten: from column j to the next that is kept it is 20 times closer
   than to what is kept around both. */
static int is_sliver(const model *g, const int *keep, int j)
{
    double before = HUGE_VAL, behind = HUGE_VAL;
    int k = j, q;
    while (k < g->columns && !(keep[k] && g->t[k] > g->t[j])) k++;
    if (k == g->columns) return 0;
    for (q = j; q >= 0 && !(keep[q] && g->t[q] < g->t[j]); q--) continue;
    if (q >= 0) before = g->t[j] - g->t[q];
    for (q = k; q < g->columns && !(g->t[q] > g->t[k]); q++) continue;
    if (q < g->columns) behind = g->t[q] - g->t[k];
    return 20 * (g->t[k] - g->t[j]) <= fmin(before, behind);
}

/* After wf_advance: what is kept is in its order and what it was, the newest sample, and so many older ones, none of
   them from before a break; the model keeps the same. */
static void follow_advance(wf *w, model *g, int history)
{
    const int last = newest(g);
    int keep[CAPACITY] = {0}, j, k = g->columns, m = wf_columns(w), begin = last, older_ones = 0;
    while (begin > 0 && g->kind[begin] != WF_BREAK) begin--;
    for (j = m - 1; j >= 0; j--) {
        for (k--; k >= begin && !(fuzz_same(g->t[k], wf_time(w, j)) && fuzz_all_same(N, g->x[k], wf_column(w, j))); k--) continue;
        REQUIRE(k >= begin);
        keep[k] = 1;
    }
    for (j = last; j < g->columns; j++) REQUIRE(keep[j]);
    for (j = begin; j < last; j++) older_ones += keep[j] && g->kind[j] != WF_SLOPE;
    REQUIRE(older_ones <= history);
    for (j = begin; j < last; j++)
        if (!keep[j] && (older_ones < history || j > k)) REQUIRE(is_sliver(g, keep, j));
    if (g->t[last] > g->t[g->start]) { /* a window that is a break alone has no length */
        const double length = g->t[last] - g->t[g->start];
        g->length = length < g->last / 1000 ? g->last : length;
        g->last = length;
    }
    for (m = 0, j = 0; j < g->columns; j++) {
        if (!keep[j]) continue;
        if (j == last) g->start = m;
        g->t[m] = g->t[j], g->kind[m] = g->kind[j], g->opened[m] = g->opened[j];
        memmove(g->x[m++], g->x[j], sizeof g->x[0]);
    }
    g->kind[0] = 0;
    g->columns = g->seen = m;
}

/* ---- the model: the spline of one segment ---------------------------------------------------------------------------- */

typedef struct spline {
    int p, m, column[CAPACITY]; /* which columns take part */
    int slope[CAPACITY];
    quad reach, t[CAPACITY], u[2 * CAPACITY + 40], a[CAPACITY][CAPACITY], inverse[CAPACITY][CAPACITY];
} spline;

static quad qabs(quad v)
{
    return v < 0 ? -v : v;
}

static void bases(const spline *g, int deriv, int span, quad t, quad *out)
{
    const quad *u = g->u;
    quad B[2 * CAPACITY + 40];
    int i, k;
    for (i = 0; i < g->m + g->p; i++) B[i] = i == span;
    for (k = 1; k <= g->p; k++)
        for (i = 0; i < g->m + g->p - k; i++) {
            const quad left = u[i + k] - u[i], right = u[i + k + 1] - u[i + 1];
            const quad a = left > 0 ? B[i] / left : 0, b = right > 0 ? B[i + 1] / right : 0;
            B[i] = k <= g->p - deriv ? (t - u[i]) * a + (u[i + k + 1] - t) * b : k * (a - b);
        }
    for (i = 0; i < g->m; i++) out[i] = deriv > g->p ? 0 : B[i];
}

static int span_of(const spline *g, quad t, int behind)
{
    int k = g->m - 1;
    while (k > g->p && !(behind ? g->u[k] <= t : g->u[k] < t)) k--;
    return k;
}

static quad pull(const spline *g, int j)
{
    int a = j, b = j;
    while (a >= 0 && !(g->t[a] < g->t[j])) a--;
    while (b < g->m && !(g->t[b] > g->t[j])) b++;
    if (a < 0) return 2 / (g->t[b] - g->t[j]);
    if (b == g->m) return 2 / (g->t[j] - g->t[a]);
    return 1 / (g->t[j] - g->t[a]) + 1 / (g->t[b] - g->t[j]);
}

static int invert(spline *g)
{
    static quad a[CAPACITY][CAPACITY];
    const int m = g->m;
    int i, j, k, best;
    for (i = 0; i < m; i++) { /* derivatives have another unit: every row is divided by its largest number */
        quad most = 0;
        for (j = 0; j < m; j++) most = qabs(g->a[i][j]) > most ? qabs(g->a[i][j]) : most;
        if (!(most > 0)) return 0;
        for (j = 0; j < m; j++) a[i][j] = g->a[i][j] / most, g->inverse[i][j] = (i == j) / most;
    }
    for (k = 0; k < m; k++) {
        quad v;
        for (best = k, i = k; i < m; i++)
            if (qabs(a[i][k]) > qabs(a[best][k])) best = i;
        if (!(qabs(a[best][k]) > 0)) return 0;
        for (j = 0; j < m; j++) {
            v = a[k][j], a[k][j] = a[best][j], a[best][j] = v;
            v = g->inverse[k][j], g->inverse[k][j] = g->inverse[best][j], g->inverse[best][j] = v;
        }
        for (v = 1 / a[k][k], j = 0; j < m; j++) a[k][j] *= v, g->inverse[k][j] *= v;
        for (i = 0; i < m; i++) {
            v = a[i][k];
            if (i == k || !(qabs(v) > 0)) continue;
            for (j = 0; j < m; j++) a[i][j] -= v * a[k][j], g->inverse[i][j] -= v * g->inverse[k][j];
        }
    }
    return 1;
}

/* Knots of the documented formula; moved by a rounding of the span, with shake 1 to and fro, with 2 all one way.  0 where the
   matrix is singular. */
static int build(spline *g, int p, int shake)
{
    const int m = g->m;
    quad sum, weights, low, high, v;
    int i, j;
    g->p = p;
    for (i = 0; i <= p; i++) g->u[i] = g->t[0], g->u[m + i] = g->t[m - 1];
    for (j = 1; j < m - p; j++) {
        for (low = high = p > 0 ? pull(g, j) : 1, i = 1; i < p; i++) {
            v = pull(g, j + i);
            low = v < low ? v : low;
            high = v > high ? v : high;
        }
        for (sum = 0, weights = 0, i = 0; i < p; i++) { /* steps even to ten digits are even */
            v = high - low <= (quad)1e-10 * high ? 1 : pull(g, j + i);
            sum += v * g->t[j + i];
            weights += v;
        }
        g->u[p + j] = p > 0 ? sum / weights : g->t[j - 1];
        if (shake) g->u[p + j] += (shake > 1 || j % 2 ? 1 : -1) * EPS / 2 * g->reach;
    }
    for (i = 0; i < m; i++) bases(g, g->slope[i], span_of(g, g->t[i], 0), g->t[i], g->a[i]);
    return invert(g);
}

/* row = weights of the columns that take part; bound: what rounding may do to them. */
static void row_of(const spline *g, const quad *basis, quad *row, quad *bound)
{
    quad size[CAPACITY], through[CAPACITY];
    int i, j;
    for (j = 0; j < g->m; j++)
        for (row[j] = 0, size[j] = 0, i = 0; i < g->m; i++) {
            row[j] += basis[i] * g->inverse[i][j];
            size[j] += qabs(basis[i] * g->inverse[i][j]);
        }
    if (!bound) return;
    for (i = 0; i < g->m; i++)
        for (through[i] = qabs(basis[i]), j = 0; j < g->m; j++) through[i] += qabs(row[j]) * qabs(g->a[j][i]);
    for (j = 0; j < g->m; j++)
        for (bound[j] = 0, i = 0; i < g->m; i++) bound[j] += EPS * through[i] * qabs(g->inverse[i][j]);
}

static void value_row(const spline *g, quad t, int deriv, int behind, quad *row, quad *bound)
{
    quad basis[CAPACITY];
    bases(g, deriv, span_of(g, t, behind), t, basis);
    row_of(g, basis, row, bound);
}

/* 0.5 +- Gauss' points and weights on [0, 1], 16 of them, by Newton's method. */
static void gauss(quad *point, quad *weight)
{
    int i, k, turn;
    for (i = 0; i < 16; i++) {
        quad x = (quad)cos(3.14159265358979 * (i + 0.75) / 16.5), slope = 1;
        for (turn = 0; turn < 8; turn++) {
            quad a = 1, b = x;
            for (k = 2; k <= 16; k++) {
                const quad next = ((2 * k - 1) * x * b - (k - 1) * a) / k;
                a = b, b = next;
            }
            slope = 16 * (x * b - a) / (x * x - 1);
            x -= b / slope;
        }
        point[i] = (1 + x) / 2;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/* The integral of all basis functions from a to b, with the end pieces continued. */
static void integrals(const spline *g, quad a, quad b, quad *out)
{
    quad point[16], weight[16], basis[CAPACITY], low, high;
    int k, q, i;
    gauss(point, weight);
    for (i = 0; i < g->m; i++) out[i] = 0;
    for (k = g->p; k < g->m; k++) {
        low = k == g->p || a > g->u[k] ? a : g->u[k];
        high = k == g->m - 1 || b < g->u[k + 1] ? b : g->u[k + 1];
        if (!(high > low)) continue;
        for (q = 0; q < 16; q++) {
            bases(g, 0, k, low + (high - low) * point[q], basis);
            for (i = 0; i < g->m; i++) out[i] += weight[q] * (high - low) * basis[i];
        }
    }
}

/* The noise constant within the window, by its definition. */
static double noise_of(const spline *g, quad start)
{
    quad row[CAPACITY], worst = 1;
    int j, q, i;
    for (j = 1; j < g->m; j++)
        for (q = 1; q <= 3 && g->t[j] > g->t[j - 1] && g->t[j] > start; q++) {
            quad values = 0;
            value_row(g, g->t[j - 1] + (g->t[j] - g->t[j - 1]) * q / 4, 0, 0, row, NULL);
            for (i = 0; i < g->m; i++) values += g->slope[i] ? 0 : qabs(row[i]);
            worst = values > worst ? values : worst;
        }
    return worst < (quad)1e300 ? (double)worst : 1e300;
}

/* ---- the segments of an object, with the degrees that its noise allows ----------------------------------------------- */

typedef struct piece {
    spline exact, shaken[2];
    int first, end; /* columns */
    int remark, certain, slopes, rough; /* rough: derivatives, and noise somewhere, in front of the window, too */
} piece;

/* The columns of first .. end-1 that take part: of samples far closer than their neighbours, the newest alone.  Which
   these are is seen from the weights; that no others are left out is required. */
static void participants(wf *w, const model *g, piece *s)
{
    double row[CAPACITY];
    int used[CAPACITY] = {0}, readable = 1, j, q, k, m = 0; /* readable: everywhere */
    for (j = s->first + 1; j < s->end; j++)
        for (q = 1; q < 4 && g->t[j] > g->t[j - 1]; q++) {
            /* steps beside DBL_MIN: differences of times lose digits, or values cannot be read */
            if (g->t[j] - g->t[j - 1] < 1e-290) readable = 0;
            if (wf_weights(w, g->t[j - 1] + (g->t[j] - g->t[j - 1]) * (0.3 * q - 0.07), 0, row) < 0) readable = 0;
            else
                for (k = s->first; k < s->end; k++) used[k] |= fabs(row[k]) > 0;
        }
    for (j = s->first; j < s->end; j++) {
        const int all = !readable || g->limit < 2 || !(g->t[s->end - 1] > g->t[s->first]);
        if (!all && !used[j]) continue;
        s->exact.column[m] = j;
        s->exact.slope[m] = g->kind[j] == WF_SLOPE;
        s->exact.t[m++] = (quad)g->t[j];
    }
    s->exact.m = m;
    s->exact.reach = (quad)g->t[g->columns - 1] - (quad)g->t[0]; /* which times and knots are rounded to */
    s->certain = readable && m > 0;
    for (j = s->first; j < s->end; j++) { /* left out: a next sample lies 20 times closer than what is around both */
        double before, behind;
        if (!readable || used[j] || g->limit < 2 || !(g->t[s->end - 1] > g->t[s->first])) continue;
        for (k = j; k < s->end && !(used[k] && g->t[k] > g->t[j]); k++) continue;
        REQUIRE(k < s->end);
        for (q = j; q >= s->first && !(used[q] && g->t[q] < g->t[j]); q--) continue;
        before = q >= s->first ? g->t[j] - g->t[q] : HUGE_VAL;
        for (q = k; q < s->end && !(g->t[q] > g->t[k]); q++) continue;
        behind = q < s->end ? g->t[q] - g->t[k] : HUGE_VAL;
        REQUIRE(20 * (g->t[k] - g->t[j]) <= fmin(before, behind));
    }
}

/* The highest degree that is quiet; uncertain where a noise constant is near the limit. */
static void settle(const model *g, piece *s)
{
    spline *e = &s->exact;
    const int left = e->m < s->end - s->first;
    int p = g->limit < e->m - 1 ? g->limit : e->m - 1, lowest, slopes = 0, j, noisy = 0;
    double noise;
    quad start = (quad)g->t[g->start];
    if (!(e->t[e->m - 1] > e->t[0])) { /* a lone sample: a constant */
        e->p = 0;
        s->certain = 0;
        return;
    }
    for (j = 0; j < e->m; j++) slopes += e->slope[j];
    for (j = e->m - 1; j >= 0 && e->column[j] >= g->start; j--) start = e->t[j]; /* or what stands for it */
    lowest = slopes ? 2 : 1;
    if (lowest > p) lowest = p;
    for (;; p--) {
        const int regular = p == 0 ? (e->p = 0, 1) : build(e, p, 0);
        noise = p > 1 && regular ? noise_of(e, start) : 1;
        if (noise > 97 && noise < 103) s->certain = 0;
        noisy = noise > 100 || !regular;
        if (!noisy || p <= lowest) break;
    }
    if (p == 0 && e->m > 1 && e->t[e->m - 1] > e->t[0]) s->certain = s->certain && build(e, 0, 0);
    for (j = 0; j < 2; j++) {
        s->shaken[j] = *e;
        if (p > 0) s->certain = s->certain && build(&s->shaken[j], p, 1 + j);
    }
    s->slopes = slopes;
    s->rough = noisy || (slopes > 0 && p > 1 && noise_of(e, e->t[0]) > 30);
    s->remark = noisy ? WF_NOISY : p < g->limit ? WF_LOWERED : left ? WF_SLIVER : WF_OK;
}

/* The pieces that take part; returns how many. */
static int pieces(wf *w, const model *g, piece *s)
{
    int count = 0, j = older(g, g->start, g->history);
    for (; j < g->columns; j = s[count++].end) {
        s[count].first = j;
        for (s[count].end = j + 1; s[count].end < g->columns && g->kind[s[count].end] != WF_BREAK;) s[count].end++;
        participants(w, g, &s[count]);
        if (s[count].certain) settle(g, &s[count]);
    }
    return count;
}

/* ---- comparisons ----------------------------------------------------------------------------------------------------- */

/* Elimination without a search for pivots grows where derivatives are noisy, and only there. */
static quad slack_of(const piece *s)
{
    return s->rough ? 1000000 : s->slopes ? 2000 : 100;
}

/* A row of the object against one of the model, which counts in columns that take part. */
static void compare_rows(const double *got, const model *g, const piece *s, const quad *row, const quad *bound)
{
    const spline *e = &s->exact;
    quad full[CAPACITY] = {0}, may[CAPACITY] = {0}, most = 0;
    int j;
    for (j = 0; j < e->m; j++) full[e->column[j]] = row[j], may[e->column[j]] = bound[j];
    for (j = 0; j < e->m; j++) most = qabs(row[j]) > most ? qabs(row[j]) : most;
    for (j = 0; j < g->columns; j++) {
        const quad off = qabs((quad)got[j] - full[j]);
        REQUIRE(off <= slack_of(s) * may[j] + (quad)1e-24 * most);
    }
}

/* The bound of a row with what shaken knots do to it, and a shaken time. */
static void widen(const piece *s, quad t, int deriv, int behind, const quad *row, quad *bound)
{
    quad other[CAPACITY];
    int j, k;
    for (k = 0; k < 2; k++) {
        value_row(&s->shaken[k], t, deriv, behind, other, NULL);
        for (j = 0; j < s->exact.m; j++) bound[j] += qabs(other[j] - row[j]);
    }
    for (k = -1; k <= 1; k += 2) {
        const quad away = qabs(t - s->exact.t[0]) + s->exact.reach;
        value_row(&s->exact, t + k * away * EPS, deriv, behind, other, NULL);
        for (j = 0; j < s->exact.m; j++) bound[j] += qabs(other[j] - row[j]);
    }
}

/* Is a derivative of the highest degree asked for so close to a knot that either side is right? */
static int beside_a_knot(const spline *e, quad t, double near)
{
    int i;
    for (i = 0; i <= e->m + e->p; i++)
        if (qabs(e->u[i] - t) <= (quad)near + (e->t[e->m - 1] - e->t[0]) / 1000) return 1;
    return 0;
}

/* Is it a stored time but for round-off?  Those the tests look at. */
static int near_a_time(const model *g, double t)
{
    int j;
    for (j = 0; j < g->columns; j++)
        if ((t < g->t[j] || t > g->t[j]) && fabs(t - g->t[j]) <= (g->opened[j] ? 4100 : 6) * gap_of_ulps(g, t)) return 1;
    return 0;
}

/* A stored value or derivative is returned to the bit; 0 where there is none of that time. */
static int check_stored(wf *w, const model *g, const piece *s, double t, int deriv, int behind)
{
    double weight[CAPACITY], out[N];
    int j = s->first, i;
    while (j < s->end && g->t[j] < t) j++;
    if (deriv == 1 && (j + 1 >= s->end || g->kind[j + 1] != WF_SLOPE)) return 0;
    j += deriv;
    REQUIRE(wf_weights(w, t, deriv + (behind ? WF_BEHIND : 0), weight) == WF_OK);
    REQUIRE(wf_read(w, t, deriv + (behind ? WF_BEHIND : 0), out) == WF_OK);
    for (i = 0; i < g->columns; i++) REQUIRE(fuzz_same(weight[i], i == j));
    REQUIRE(fuzz_all_same(N, out, g->x[j]));
    return 1;
}

static void check_read(wf *w, const model *g, const piece *s, int count, double t, int deriv, int behind)
{
    quad row[CAPACITY], bound[CAPACITY], sum, slack;
    double weight[CAPACITY], out[N], value[N], c[CAPACITY * N];
    const double begin = g->t[s[0].first], end = g->t[g->columns - 1], size = log10(end - g->t[0]);
    double span;
    int f = 0, before = 0, j, i, status, own, stored = 0, expected;
    while (f < count - 1 && (t > g->t[s[f].end - 1] || (behind && t >= g->t[s[f].end - 1]))) f++;
    if (!s[f].certain || s[f].exact.m < 2) return;
    if (deriv > 1 && fabs(size) > 100) return; /* beyond the range of numbers */
    span = g->t[s[f].end - 1] - g->t[s[f].first];
    if (t < begin - span || t > end + span) return; /* far beyond an end: all digits may be gone */
    for (j = s[f].first; j < s[f].end; j++) stored |= t >= g->t[j] && t <= g->t[j];
    if (near_a_time(g, t)) return;
    if (stored && deriv < 2 && s[f].exact.p > 0 && check_stored(w, g, &s[f], t, deriv, behind)) return;
    if (deriv >= s[f].exact.p && (deriv > 0 || s[f].exact.p == 0) && beside_a_knot(&s[f].exact, (quad)t, 6 * gap_of_ulps(g, t))) return;
    own = deriv + (behind ? WF_BEHIND : 0);
    status = wf_weights(w, t, own, weight);
    expected = t < begin || t > end ? WF_EXTRAP : s[f].remark;
    value_row(&s[f].exact, (quad)t, deriv, behind, row, bound);
    widen(&s[f], (quad)t, deriv, behind, row, bound);
    for (j = 0; j < s[f].exact.m; j++)
        if (qabs(row[j]) > (quad)1e290 || qabs(bound[j]) > (quad)1e280) return;
    if (status == WF_ERANGE) return;
    REQUIRE(status >= 0);
    if (!stored || deriv > 1) REQUIRE(status == expected);
    compare_rows(weight, g, &s[f], row, bound);
    REQUIRE(wf_read(w, t, own, out) == status);
    for (i = 0; i < N; i++) {
        for (sum = 0, slack = 0, j = 0; j < g->columns; j++) {
            sum += (quad)weight[j] * (quad)g->x[j][i];
            slack += qabs((quad)weight[j] * (quad)g->x[j][i]);
        }
        REQUIRE(qabs((quad)out[i] - sum) <= 40 * EPS * slack + (quad)1e-290);
    }
    if (wf_fit(w, c) < 0 || wf_eval(w, t, own, c, value) < 0) return;
    for (i = 0; i < f; i++) before += s[i].exact.m;
    for (j = before * N; fabs(size) > 100 && j < (before + s[f].exact.m) * N; j++)
        if (!(fabs(c[j]) <= 1e290)) return; /* derivatives times such steps: beyond the range of numbers */
    for (i = 0; i < N; i++) {
        for (sum = 0, slack = 0, j = 0; j < s[f].exact.m; j++) {
            const quad x = (quad)g->x[s[f].exact.column[j]][i];
            sum += row[j] * x;
            slack += bound[j] * qabs(x);
        }
        REQUIRE(qabs((quad)value[i] - sum) <= 2 * slack_of(&s[f]) * slack + (quad)1e-290);
    }
}

static void check_mean(wf *w, const model *g, const piece *s, int count, double a, double b)
{
    quad full[CAPACITY] = {0}, may[CAPACITY] = {0}, row[CAPACITY], bound[CAPACITY], basis[CAPACITY], most = 0, worst = 100;
    double weight[CAPACITY], out[N];
    int f, j, k, status;
    if (!(b - a > 1e-3 * (g->t[g->columns - 1] - g->t[0]))) return;
    if (near_a_time(g, a) || near_a_time(g, b)) return;
    if (b - g->t[g->columns - 1] > g->t[s[count - 1].end - 1] - g->t[s[count - 1].first]) return; /* far beyond the end */
    if (g->t[s[0].first] - a > g->t[s[0].end - 1] - g->t[s[0].first]) return;
    for (f = 0; f < count; f++) {
        const quad low = f == 0 || a > g->t[s[f].first] ? (quad)a : (quad)g->t[s[f].first];
        const quad high = f == count - 1 || b < g->t[s[f].end - 1] ? (quad)b : (quad)g->t[s[f].end - 1];
        if (!(high > low)) continue;
        if (!s[f].certain || s[f].exact.m < 2) return;
        worst = slack_of(&s[f]) > worst ? slack_of(&s[f]) : worst;
        integrals(&s[f].exact, low, high, basis);
        for (j = 0; j < s[f].exact.m; j++) basis[j] /= (quad)b - (quad)a;
        row_of(&s[f].exact, basis, row, bound);
        for (j = 0; j < s[f].exact.m; j++) full[s[f].exact.column[j]] = row[j], may[s[f].exact.column[j]] = slack_of(&s[f]) * bound[j];
        for (k = 0; k < 2; k++) {
            integrals(&s[f].shaken[k], low, high, basis);
            for (j = 0; j < s[f].exact.m; j++) basis[j] /= (quad)b - (quad)a;
            row_of(&s[f].shaken[k], basis, row, NULL);
            for (j = 0; j < s[f].exact.m; j++) may[s[f].exact.column[j]] += slack_of(&s[f]) * qabs(full[s[f].exact.column[j]] - row[j]);
        }
        for (k = 0; k < 3; k++) { /* the points of the rule are rounded, too */
            const quad t = low + (high - low) * k / 2, away = qabs(t - s[f].exact.t[0]) + s[f].exact.reach;
            value_row(&s[f].exact, t, 1, k == 0, row, NULL);
            for (j = 0; j < s[f].exact.m; j++) may[s[f].exact.column[j]] += 4 * EPS * away * qabs(row[j]);
        }
    }
    for (j = 0; j < g->columns; j++) most = qabs(full[j]) > most ? qabs(full[j]) : most;
    if (most > (quad)1e280) return;
    status = wf_weights_mean(w, a, b, weight);
    if (status == WF_ERANGE) return;
    REQUIRE(status >= 0 && wf_mean(w, b, a, out) == status);
    REQUIRE((status == WF_EXTRAP) == (a < g->t[s[0].first] || b > g->t[g->columns - 1]));
    for (j = 0; j < g->columns; j++)
        REQUIRE(qabs((quad)weight[j] - full[j]) <= may[j] + worst * EPS * most + (quad)1e-290);
}

/* The samples of a guess: the newest, and those nearest to one, two, .. window lengths before it; count, or 0 where two are
   equally near. */
static int guess_nodes(const model *g, int degree, int *node, int *lowered)
{
    const double last = g->t[g->columns - 1];
    double length = last - g->t[g->start];
    int begin = newest(g), count, j, best;
    const int n = begin;
    while (begin > 0 && g->kind[begin] != WF_BREAK) begin--;
    if (!(length > 0)) length = g->length;
    node[0] = n;
    *lowered = 1;
    for (count = 1; count <= degree; count++) {
        const double t = g->t[n] - count * length;
        double second = HUGE_VAL;
        best = begin;
        for (j = begin; j <= n; j++) {
            if (g->kind[j] == WF_SLOPE) continue;
            if (fabs(g->t[j] - t) < fabs(g->t[best] - t)) best = j;
        }
        for (j = 0; j <= n; j++)
            if (g->t[j] < g->t[best] || g->t[j] > g->t[best]) second = fmin(second, fabs(g->t[j] - t));
        if (second <= fabs(g->t[best] - t) * (1 + 1e-9) || fabs(fabs(g->t[best] - t) - 0.499 * length) < 1e-3 * length) return 0;
        if (best >= node[count - 1] || !(fabs(g->t[best] - t) < 0.499 * length)) return count;
        node[count] = best;
    }
    *lowered = 0;
    return count;
}

static quad lagrange(const model *g, int count, const int *node, int i, quad t, int slope)
{
    quad value = 1, rate = 0;
    int k;
    for (k = 0; k < count; k++) {
        const quad gap = (quad)g->t[node[i]] - (quad)g->t[node[k]];
        if (k == i) continue;
        rate = rate * (t - (quad)g->t[node[k]]) / gap + value / gap;
        value *= (t - (quad)g->t[node[k]]) / gap;
    }
    return slope ? rate : value;
}

/* The guess by divided differences, its start a double node where its derivative takes part, at node[nodes]. */
static quad guess_of(const model *g, int nodes, const int *node, int taylor, int i, quad t, int rate, quad *size)
{
    quad z[WF_MAX_DEGREE + 3], d[WF_MAX_DEGREE + 3], value, slope = 0, sum = 0;
    int count = nodes + taylor, j, k;
    if (!taylor) {
        for (*size = 0, j = 0; j < nodes; j++) {
            const quad weight = lagrange(g, nodes, node, j, t, rate);
            sum += weight * (quad)g->x[node[j]][i];
            *size += qabs(weight * (quad)g->x[node[j]][i]);
        }
        return sum;
    }
    for (j = 0; j < count; j++) {
        const int from = node[j > 0 ? j - 1 : 0];
        z[j] = (quad)g->t[from], d[j] = (quad)g->x[from][i];
    }
    for (k = 1; k < count; k++)
        for (j = count - 1; j >= k; j--)
            d[j] = j == 1 && k == 1 ? (quad)g->x[node[0] + 1][i] : (d[j] - d[j - 1]) / (z[j] - z[j - k]);
    for (value = d[count - 1], *size = qabs(value), j = count - 2; j >= 0; j--) {
        slope = slope * (t - z[j]) + value;
        value = value * (t - z[j]) + d[j];
        *size = *size * (qabs(t - z[j]) + 1) + qabs(d[j]);
    }
    for (j = 0; j < nodes; j++) { /* what cancels: samples over the steps between them */
        const quad gap = j > 0 ? z[0] - z[j + 1] : 1, factor = j > 0 ? qabs((t - z[0]) / gap) + 1 : 1;
        *size += qabs((quad)g->x[node[j]][i]) * factor * factor * (rate && j > 0 ? 1 / qabs(gap) : 1);
        if (rate && j > 0) *size += qabs((quad)g->x[node[0]][i]) * factor * factor / qabs(gap);
    }
    return rate ? slope : value;
}

static void check_begin(wf *w, model *g, int degree, int count, const double *t, int what)
{
    model before;
    int node[WF_MAX_DEGREE + 1], nodes, lowered = 0, taylor = 0, k, j, i, status = WF_OK, due;
    due = model_rollback(g);
    before = *g;
    if (due < 0 || (what && g->limit < 2)) {
        REQUIRE(wf_begin(w, degree, count, t, what) < 0);
        if (due == WF_OK) REQUIRE(wf_rollback(w) == WF_OK);
        return;
    }
    nodes = guess_nodes(g, degree, node, &lowered);
    if (nodes && lowered && newest(g) + 1 < g->columns) { /* its derivative takes the place of a sample */
        taylor = 1;
        lowered = nodes + 1 <= degree;
    }
    for (k = 0; k < count && status >= 0; k++) {
        const int again = k > 0 && t[k] <= t[k - 1];
        if (again ? k > 1 && t[k] <= t[k - 2] : t[k] <= g->t[g->columns - 1]) status = WF_EORDER;
        else status = model_append(g, t[k], what | (again ? WF_BREAK : 0), 1);
    }
    if (status < 0) model_cut(g, before.columns);
    g->seen = g->columns;
    due = wf_begin(w, degree, count, t, what);
    if (due == WF_ERANGE && status >= 0) { /* a weight overflows */
        model_cut(g, before.columns);
        g->seen = g->columns;
        return;
    }
    if (status < 0) REQUIRE(due == status);
    else if (nodes) REQUIRE(due == (lowered ? WF_LOWERED : WF_OK));
    REQUIRE(wf_columns(w) == g->columns && wf_start(w) == g->start);
    for (j = before.columns; j < g->columns; j++)
        for (i = 0; i < N; i++) {
            const double got = wf_column(w, j)[i];
            quad slack = 0, sum = nodes ? guess_of(&before, nodes, node, taylor, i, (quad)g->t[j], g->kind[j] == WF_SLOPE, &slack) : 0;
            if (nodes && slack < (quad)1e290) REQUIRE(qabs((quad)got - sum) <= (quad)1e6 * EPS * slack + (quad)1e-280);
            g->x[j][i] = got;
        }
}

/* ---- a run of object and model --------------------------------------------------------------------------------------- */

/* Four times log2 of the steps on van der Pol's equation, mu = 100: RK45 to 1e-4, Radau to 1e-4 and 1e-7,
   BDF to 1e-5 of SciPy 1.10, where they change most. */
static const signed char adaptive_steps[4][48] = {
    {-14, -15, -15, -15, -14, -14, -14, -15, -15, -14, -13, -13, -14, -14, -14, -13, -13, -13, -13, -13, -12, -12, -12, -12,
     -12, -11, -10, -11, -11, -10, -10, -10, -9, -15, -15, -18, -20, -22, -24, -26, -27, -28, -29, -29, -32, -34, -34, -35},
    {-33, -33, -34, -34, -38, -36, -36, -36, -36, -37, -41, -39, -39, -38, -38, -41, -41, -41, -38, -38, -38, -36, -39, -39,
     -39, -38, -38, -38, -38, -38, -38, -37, -37, -37, -36, -36, -34, -33, -32, -30, -28, -24, -19, -11, -1, 6, 12, 20},
    {-46, -46, -46, -46, -46, -46, -45, -45, -45, -45, -45, -45, -45, -44, -44, -44, -44, -44, -44, -43, -43, -43, -43, -43,
     -41, -41, -41, -41, -40, -40, -40, -39, -39, -39, -37, -37, -36, -36, -34, -33, -32, -30, -28, -25, -20, -12, -1, 11},
    {-64, -64, -51, -51, -44, -44, -44, -39, -39, -39, -39, -35, -38, -38, -38, -38, -38, -35, -35, -35, -35, -30, -30, -30,
     -19, -19, -6, -6, 4, 4, 4, 13, 13, 11, 11, 11, 8, 8, 8, 6, 6, 6, 3, 3, 3, -2, -2, -2}};

/* The next step: even, over decades, clustered, graded, jittered, at random doubled, halved and rejected, or that of an
   integrator (*at: how far it is). */
static double next_step(fuzz *f, int pattern, double base, double *step, int *at)
{
    const double u = (1 + fuzz_unit(f)) / 2;
    switch (pattern) {
    case 7: case 8: case 9: case 10: return base * pow(2, adaptive_steps[pattern - 7][(*at)++ % 48] / 4.);
    case 0: return base;
    case 1: return base * pow(10, -6 * u);
    case 2: return base * (fuzz_below(f, 3) ? 1 : 1e-5 * (0.5 + u));
    case 3: return *step *= 2.5;
    case 4: return base * (1 + 1e-10 * u);
    case 5: return base * (0.3 + u);
    default: return *step *= u < 0.3 ? 0.2 : u < 0.6 ? 1 : 1 + 4 * u;
    }
}

static void write_samples(fuzz *f, wf *w, model *g, int first)
{
    int j, i;
    for (j = first; j < g->columns; j++)
        for (i = 0; i < N; i++) wf_column(w, j)[i] = g->x[j][i] = fuzz_unit(f);
}

static void same_list(wf *w, const model *g)
{
    int j;
    REQUIRE(wf_columns(w) == g->columns && wf_start(w) == g->start);
    for (j = 0; j < g->columns; j++) REQUIRE(fuzz_same(wf_time(w, j), g->t[j]) && fuzz_all_same(N, wf_column(w, j), g->x[j]));
}

static void check_all(fuzz *f, wf *w, model *g)
{
    static piece s[CAPACITY];
    double span;
    int count, i, most = 0, certain = 1;
    if (!MODEL || g->columns < 2) return;
    span = g->t[g->columns - 1] - g->t[0];
    REQUIRE(wf_degree(w) <= g->limit);
    g->seen = g->columns;
    count = pieces(w, g, s);
    for (i = 0; i < count; i++) {
        certain = certain && s[i].certain;
        if (s[i].certain && s[i].exact.p > most) most = s[i].exact.p;
    }
    if (certain) REQUIRE(wf_degree(w) == most);
    for (i = 0; i < 6; i++) {
        const double a = fuzz_below(f, 4) ? g->t[0] + span * (fuzz_unit(f) + 1) / 2 : g->t[fuzz_below(f, g->columns)] + span * fuzz_below(f, 2) / 3;
        check_read(w, g, s, count, a, i % 3, fuzz_below(f, 4) == 0);
        if (i < 2) check_mean(w, g, s, count, a, a + span * (fuzz_unit(f) + 1) / 2);
    }
    same_list(w, g);
}

static void modelled(fuzz *f)
{
    static const double units[] = {1, 1, 1, 1e7, 1e-9, 1e-300, 1e-280, 1e280, 1e290};
    static double mem[8192], kept[8192];
    model g = {0}, kept_model = {0};
    const int pattern = fuzz_below(f, 11);
    const double base = units[fuzz_below(f, 9)], offset = fuzz_below(f, 3) ? 0 : fuzz_unit(f) * 1e10 * base;
    double t = offset, step = base, times[4];
    int what, j, k, due, at = fuzz_below(f, 48);
    wf *w = NULL;
    g.degree = g.limit = fuzz_below(f, 3) ? fuzz_below(f, 6) : fuzz_below(f, 12);
    g.history = INT_MAX;
    REQUIRE(wf_make(&w, N, g.degree, CAPACITY, mem, sizeof mem) == WF_OK);
    memcpy(kept, mem, sizeof mem);
    kept_model = g;
    while (fuzz_more(f)) {
        const int columns = g.columns, op = fuzz_below(f, 16);
        double h = next_step(f, pattern, base, &step, &at);
        if (columns) t = g.t[columns - 1];
        if (columns && h < 6 * gap_of_ulps(&g, t + h)) h = step = 6 * gap_of_ulps(&g, t + base);
        if (h > 1e6 * base) h = step = base;
        if (op < 8) { /* a new time, the last one again, or a break there */
            what = fuzz_below(f, 4) == 0 && g.degree > 1 ? WF_SLOPE : 0;
            if (columns && op == 0) what |= WF_BREAK;
            if (columns && op > 1) t += h;
            due = model_push(&g, t, what);
            REQUIRE(wf_push(w, t, what) == due);
            write_samples(f, w, &g, due >= 0 ? due : g.columns);
        } else if (op == 8 && columns) {
            k = fuzz_below(f, columns);
            while (k > 0 && !(g.t[k] > g.t[k - 1])) k--;
            t = g.t[k];
            what = k + 1 < columns && g.kind[k + 1] == WF_SLOPE && fuzz_below(f, 4) ? WF_SLOPE : 0;
            due = model_push(&g, t, what);
            REQUIRE(wf_push(w, t, what) == due);
        } else if (op == 9) {
            due = columns == 0 || newest(&g) <= g.start ? WF_EFEW : WF_OK;
            if (due == WF_OK) model_cut(&g, newest(&g));
            REQUIRE(wf_pop(w) == due);
        } else if (op == 10) {
            REQUIRE(wf_rollback(w) == model_rollback(&g));
        } else if (op == 11) {
            k = fuzz_below(f, 9);
            REQUIRE(wf_advance(w, k) == (columns ? WF_OK : WF_EFEW));
            if (columns) follow_advance(w, &g, k);
        } else if (op == 12) {
            t = columns ? g.t[g.start] : t;
            for (k = 0; k < 4; k++) times[k] = t += k > 0 && fuzz_below(f, 6) == 0 ? 0 : h * (1 + fuzz_below(f, 2));
            check_begin(w, &g, fuzz_below(f, 4), 1 + fuzz_below(f, 4), times, fuzz_below(f, 4) == 0 ? WF_SLOPE : 0);
            for (j = g.start + 1; j < g.columns; j++)
                if (fuzz_below(f, 2)) for (k = 0; k < N; k++) wf_column(w, j)[k] = g.x[j][k] = fuzz_unit(f);
        } else if (op == 13 && fuzz_below(f, 4) == 0) {
            int lowest = 0;
            for (j = 0; j < columns; j++)
                if (g.kind[j] == WF_SLOPE) lowest = 2;
            k = fuzz_below(f, g.degree + 1);
            due = k < lowest ? WF_EDEGREE : WF_OK;
            REQUIRE(wf_restrict(w, k, fuzz_below(f, 6) + 1 > 5 ? INT_MAX : 3) == due);
            if (due == WF_OK) g.limit = k, g.history = w->history;
        } else if (op == 14) { /* a checkpoint, or back to it */
            if (fuzz_below(f, 2)) memcpy(kept, mem, sizeof mem), kept_model = g;
            else memcpy(mem, kept, sizeof mem), g = kept_model, step = base;
        } else if (g.columns > 1) {
            check_all(f, w, &g);
        }
        same_list(w, &g);
    }
    check_all(f, w, &g);
}

/* ---- anything with any arguments -------------------------------------------------------------------------------------- */

typedef struct object {
    wf *w;
    void *mem;
    size_t bytes;
    ptrdiff_t n;
} object;

static void make(fuzz *f, object *o, ptrdiff_t n)
{
    const int degree = fuzz_below(f, 4) ? fuzz_below(f, 6) : fuzz_below(f, WF_MAX_DEGREE + 1), capacity = 1 + fuzz_below(f, CAPACITY);
    o->n = n;
    o->bytes = wf_size(n, degree, capacity);
    REQUIRE(o->bytes > 0);
    o->mem = malloc(o->bytes);
    REQUIRE(o->mem != NULL);
    memset(o->mem, 0x5a, o->bytes);
    REQUIRE(wf_make(&o->w, n, degree, capacity, o->mem, o->bytes) == WF_OK);
    REQUIRE(wf_make(&o->w, n, degree, capacity, o->mem, o->bytes - 1) == WF_EMEM);
}

/* What a host sees of it, as numbers; returns how many. */
static int look(wf *w, ptrdiff_t n, double *v)
{
    int j, k = 0;
    ptrdiff_t i;
    v[k++] = wf_columns(w);
    v[k++] = wf_start(w);
    for (j = 0; j < wf_columns(w); j++) {
        v[k++] = wf_time(w, j);
        for (i = 0; i < n; i++) v[k++] = wf_column(w, j)[i];
    }
    return k;
}

static double any_time(fuzz *f, const wf *w)
{
    const int m = wf_columns(w);
    const double t = m > 0 ? wf_time(w, fuzz_below(f, m)) : 0;
    switch (fuzz_below(f, 8)) {
    case 0: return fuzz_double(f);
    case 1: return fuzz_of_bits(fuzz_bits(t) + (uint64_t)(fuzz_below(f, 16) - 8));
    case 2: return t;
    case 3: return t + fuzz_unit(f);
    default: return (m > 0 ? wf_time(w, m - 1) : 0) + fabs(fuzz_unit(f));
    }
}

/* One call, decoded anew from the same bytes for the object and for its copy. */
static int any_call(fuzz *f, wf *w, ptrdiff_t n, double *out)
{
    double t[6], row[CAPACITY], other[CAPACITY];
    int kind = fuzz_below(f, 20), k, count, status;
    ptrdiff_t i;
    if (kind < 7) {
        double s = any_time(f, w);
        k = fuzz_below(f, 8) ? fuzz_below(f, 4) : fuzz_int(f);
        if (k & WF_BREAK && wf_columns(w) > 0 && fuzz_below(f, 4)) s = wf_time(w, wf_columns(w) - 1);
        count = wf_columns(w);
        status = wf_push(w, s, k);
        if (!fuzz_finite(s)) REQUIRE(status < 0);
        for (; n > 0 && count < wf_columns(w); count++)
            for (i = 0; i < n; i++) wf_column(w, count)[i] = fuzz_below(f, 8) ? fuzz_unit(f) : fuzz_double(f);
        return status < 0 ? status : WF_OK;
    }
    switch (kind) {
    case 7: return wf_pop(w);
    case 8: return wf_rollback(w);
    case 9: return wf_advance(w, fuzz_below(f, 4) ? fuzz_below(f, 4) : fuzz_int(f));
    case 10: return wf_strict(w, fuzz_below(f, 4) ? fuzz_below(f, 3) : fuzz_int(f));
    case 11:
        k = fuzz_below(f, 4) ? fuzz_below(f, 8) : fuzz_int(f);
        return wf_restrict(w, k, fuzz_below(f, 8) ? fuzz_below(f, 6) : fuzz_int(f));
    case 12:
        count = fuzz_below(f, 8) ? fuzz_below(f, 6) : fuzz_int(f);
        for (k = 0; k < 6; k++) t[k] = k > 0 && fuzz_below(f, 4) ? t[k - 1] + 0.25 + fabs(fuzz_unit(f)) : any_time(f, w);
        k = fuzz_below(f, 8) ? fuzz_below(f, 4) - 1 : fuzz_int(f);
        if (count > 6) return WF_EARG;
        status = wf_begin(w, k, count, t, fuzz_below(f, 2));
        return status < 0 ? WF_OK : status; /* it may have rolled back */
    case 13: case 14: case 15:
        k = fuzz_below(f, 4) ? fuzz_below(f, 3) + (fuzz_below(f, 4) ? 0 : WF_BEHIND) : fuzz_int(f);
        t[0] = any_time(f, w);
        status = wf_read(w, t[0], k, n > 0 ? out : NULL);
        if (wf_weights(w, t[0], k, row) >= 0) REQUIRE(status >= 0);
        return status;
    case 16:
        t[0] = any_time(f, w);
        return wf_mean(w, t[0], any_time(f, w), n > 0 ? out : NULL);
    case 17:
        k = fuzz_below(f, 4) ? fuzz_below(f, 4) : fuzz_int(f);
        status = wf_predict(w, k, any_time(f, w), row);
        if (status >= 0) for (k = 0; k < wf_columns(w); k++) REQUIRE(fuzz_finite(row[k]));
        return status < 0 ? status : WF_OK;
    case 18:
        if (fuzz_below(f, 2)) {
            k = fuzz_int(f);
            status = wf_what(w, k);
            REQUIRE((status >= 0) == (k >= 0 && k < wf_columns(w)));
            t[0] = any_time(f, w);
            t[1] = wf_next_break(w, t[0]);
            if (fuzz_finite(t[0])) REQUIRE(t[1] > t[0]);
            if (wf_columns(w) > 0) REQUIRE(wf_valid_from(w) <= wf_time(w, wf_start(w)));
            status = wf_monotone(w);
            return status;
        }
        status = wf_quality(w, &t[0]);
        if (status >= 0) REQUIRE(!(t[0] < 1));
        return status;
    default:
        t[0] = any_time(f, w);
        t[1] = any_time(f, w);
        status = wf_weights_mean(w, t[0], t[1], row);
        if (status >= 0) REQUIRE(wf_weights_mean(w, t[1], t[0], other) == status && fuzz_all_same(wf_columns(w), row, other));
        return status;
    }
}

/* Coefficients, resampling and error estimates of whatever there is. */
static void any_spline(fuzz *f, object *o, object *to, object *work, ptrdiff_t n)
{
    const int m = wf_columns(o->w), k = wf_columns(to->w);
    double *c = fuzz_alloc((size_t)(m * n)), *out = fuzz_alloc((size_t)n), *before = fuzz_alloc(2 + (size_t)k * (size_t)(n + 1));
    double t = any_time(f, o->w);
    int status = wf_fit(o->w, n > 0 ? c : NULL);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)(m * n), c));
    else REQUIRE(wf_eval(o->w, t, fuzz_below(f, 4), c, out) != WF_ESTALE);
    look(to->w, n, before);
    status = wf_resample(o->w, to->w);
    if (status < 0) {
        double *after = fuzz_alloc(2 + (size_t)k * (size_t)(n + 1));
        REQUIRE(fuzz_all_same(look(to->w, n, after), before, after));
        free(after);
    }
    free(out);
    out = fuzz_alloc((size_t)n);
    status = wf_error(o->w, work->w, n > 0 ? out : NULL);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)n, out));
    if (m == 0) REQUIRE(status < 0);
    status = wf_copy(to->w, o->w);
    if (status == WF_OK && to->n == o->n) {
        double *a = fuzz_alloc(2 + (size_t)m * (size_t)(n + 1)), *b = fuzz_alloc(2 + (size_t)m * (size_t)(n + 1));
        REQUIRE(fuzz_all_same(look(o->w, n, a), a, (look(to->w, n, b), b)));
        free(a);
        free(b);
    }
    free(c);
    free(out);
    free(before);
}

static void wild(fuzz *f)
{
    object o[2], work;
    const ptrdiff_t n = fuzz_below(f, 5);
    double seen[3][2 + CAPACITY * 6], out[2][8];
    int i;
    for (i = 0; i < 2; i++) make(f, &o[i], n);
    make(f, &work, 0);
    while (fuzz_more(f)) {
        object *a = &o[fuzz_below(f, 8) == 0];
        if (fuzz_below(f, 8) == 0) {
            any_spline(f, a, a == o ? o + 1 : o, &work, n);
        } else {
            void *copy = fuzz_copy(a->mem, a->bytes);
            fuzz again = *f;
            int count = look(a->w, n, seen[0]), m, status, second;
            for (i = 0; i < 16; i++) out[i / 8][i % 8] = -7;
            status = any_call(f, a->w, n, out[0]);
            second = any_call(&again, (wf *)copy, n, out[1]);
            m = look(a->w, n, seen[1]);
            REQUIRE(second == status && look((wf *)copy, n, seen[2]) == m);
            REQUIRE(fuzz_all_same(m, seen[1], seen[2]) && fuzz_all_same(8, out[0], out[1]));
            if (status < 0) REQUIRE(count == m && fuzz_all_same(m, seen[0], seen[1]));
            if (status < 0) for (i = 0; i < 8; i++) REQUIRE(out[0][i] <= -7 && out[0][i] >= -7);
            free(copy);
        }
        REQUIRE(wf_degree(o[0].w) >= 0 && wf_message(fuzz_int(f))[0]);
        for (i = 1; i < wf_columns(a->w); i++) REQUIRE(wf_time(a->w, i) >= wf_time(a->w, i - 1));
    }
    for (i = 0; i < 2; i++) free(o[i].mem);
    free(work.mem);
}

static void fuzz_one(fuzz *f)
{
    if (fuzz_below(f, 2)) modelled(f);
    else wild(f);
}
