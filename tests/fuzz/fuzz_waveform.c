/* SPDX-License-Identifier: MIT

   fuzz_waveform.c - any sequence of calls of waveform.h with any arguments: see fuzz.h for the driver

   What must hold: no call reads or writes outside its arrays (the sanitizers watch), a negative status leaves object and
   outputs as they were, a copy of the object behaves as the object, times increase, columns stay within the capacity,
   weights reproduce a constant, a stored time returns its sample bit for bit, samples and coefficients tell the same
   story, and scaling times or samples by a power of two changes no other bit.                                            */
#define WF_IMPLEMENTATION
#include "waveform.h"

#ifndef FUZZ_COUNT
#    define FUZZ_COUNT 100000
#endif
#include "fuzz.h"

enum { CAPACITY = 24, GRIDS = 2 };

typedef struct grid {
    wf *w;
    void *mem;
    size_t bytes;
    int degree, capacity, moderate; /* moderate: only times between 2^-20 and 2^20 were offered */
    char kind[CAPACITY];            /* of a column: what it was pushed as */
} grid;

enum { VALUE, SLOPE, BEHIND }; /* BEHIND: the value just behind a break */

typedef struct scene {
    grid g[GRIDS];
    ptrdiff_t n, ldx;
    double *x; /* CAPACITY columns, the last one n long */
    int plain; /* all samples moderate */
} scene;

static size_t room(ptrdiff_t n, ptrdiff_t ld, int columns) /* doubles in so many columns */
{
    return columns > 0 ? (size_t)(ld * (columns - 1) + n) : 0;
}

static int is_slope(const grid *g, int j)
{
    return j > 0 && j < wf_columns(g->w) && g->kind[j] == SLOPE;
}

/* The first time that takes part: wf_restrict and wf_choose hide older ones. */
static double begin_of(const grid *g)
{
    return wf_time(g->w, g->w->hidden);
}

static int is_inside(const grid *g, double t)
{
    const int m = wf_columns(g->w);
    return m > 0 && t >= begin_of(g) && t <= wf_time(g->w, m - 1);
}

static void fill(fuzz *f, scene *s)
{
    const int wild = fuzz_below(f, 4) == 0;
    size_t i;
    s->plain = !wild;
    for (i = 0; i < room(s->n, s->ldx, CAPACITY); i++) s->x[i] = wild ? fuzz_double(f) : 1 + fuzz_unit(f) / 2;
}

/* ---- the object ------------------------------------------------------------------------------------------------------ */

static void refusals_of_make(fuzz *f, grid *g)
{
    const int degree = fuzz_int(f), capacity = fuzz_int(f);
    const size_t need = wf_size(degree, capacity);
    wf *w = g->w;
    if (need == 0) REQUIRE(wf_make(&w, degree, capacity, g->mem, (size_t)-1) < 0);
    else if (need > g->bytes) REQUIRE(wf_make(&w, degree, capacity, g->mem, g->bytes) < 0);
    REQUIRE(wf_make(&w, g->degree, g->capacity, g->mem, g->bytes - 1) < 0);
    REQUIRE(wf_make(&w, g->degree, g->capacity, g->mem, 0) < 0);
    REQUIRE(wf_make(&w, g->degree, g->capacity, (char *)g->mem + 1 + fuzz_below(f, 7), (size_t)-1) < 0);
    REQUIRE(wf_make(&w, g->degree, g->capacity, NULL, g->bytes) < 0);
    REQUIRE(wf_make(NULL, g->degree, g->capacity, g->mem, g->bytes) < 0);
    REQUIRE(w == g->w);
}

static void make(fuzz *f, grid *g)
{
    memset(g, 0, sizeof *g);
    g->degree = fuzz_below(f, 4) ? fuzz_below(f, 6) : fuzz_below(f, WF_MAX_DEGREE + 1);
    g->capacity = 1 + fuzz_below(f, CAPACITY);
    g->bytes = wf_size(g->degree, g->capacity);
    REQUIRE(g->bytes > 0);
    g->mem = malloc(g->bytes);
    REQUIRE(g->mem != NULL);
    memset(g->mem, 0x5a, g->bytes);
    REQUIRE(wf_make(&g->w, g->degree, g->capacity, g->mem, g->bytes) == WF_OK);
    g->moderate = 1;
}

static void check_grid(const grid *g)
{
    const int m = wf_columns(g->w);
    int j;
    REQUIRE(m >= 0 && m <= g->capacity);
    REQUIRE(wf_degree(g->w) <= g->degree && wf_degree(g->w) <= (m > 1 ? m - 1 : 0));
    REQUIRE(m == 0 || wf_degree(g->w) >= 0);
    REQUIRE(wf_start(g->w) >= 0 && wf_start(g->w) <= (m > 0 ? m - 1 : 0));
    REQUIRE(fuzz_is_nan(wf_time(g->w, -1)) && fuzz_is_nan(wf_time(g->w, m)) && fuzz_is_nan(wf_time(g->w, INT_MAX)));
    for (j = 0; j < m; j++) {
        REQUIRE(fuzz_finite(wf_time(g->w, j)));
        if (j > 0 && g->kind[j] == VALUE) REQUIRE(wf_time(g->w, j) > wf_time(g->w, j - 1));
        if (j > 0 && g->kind[j] != VALUE) REQUIRE(fuzz_same(wf_time(g->w, j), wf_time(g->w, j - 1)));
        REQUIRE(wf__is_slope(g->w, j) == is_slope(g, j));
    }
}

static double any_time(fuzz *f, const grid *g, int *moderate)
{
    const int m = wf_columns(g->w);
    double t = m > 0 ? wf_time(g->w, fuzz_below(f, m)) : 0;
    switch (fuzz_below(f, 8)) {
    case 0: *moderate = 0; return fuzz_double(f);
    case 1: *moderate = 0; return fuzz_of_bits(fuzz_bits(t) + (uint64_t)(fuzz_below(f, 16) - 8));
    case 2: return t;
    case 3: return t + fuzz_unit(f);
    case 4: return m > 0 ? wf_time(g->w, 0) + (wf_time(g->w, m - 1) - wf_time(g->w, 0)) * fabs(fuzz_unit(f)) : 1;
    default: return (m > 0 ? wf_time(g->w, m - 1) : 0) + fabs(fuzz_unit(f));
    }
}

/* Columns from `columns` on are new: of a value, perhaps behind a break, and perhaps of its derivative. */
static void note_columns(grid *g, int columns, int slope, int behind)
{
    const int m = wf_columns(g->w);
    REQUIRE(m - columns >= 0 && m - columns <= 1 + slope);
    if (m - columns == 1 + slope) g->kind[columns] = behind ? BEHIND : VALUE;
    if (m > columns && slope) g->kind[m - 1] = SLOPE;
}

static int push(wf *w, double t, int slope, int behind)
{
    if (behind) return slope ? wf_push_break_hermite(w, t) : wf_push_break(w, t);
    return slope ? wf_push_hermite(w, t) : wf_push(w, t);
}

static int change_by_push(fuzz *f, grid *g, wf *copy, int kind)
{
    const int columns = wf_columns(g->w), slope = kind >= 9 && kind != 12, behind = kind > 11;
    int moderate = g->moderate, status;
    double t = any_time(f, g, &moderate);
    if (behind && columns > 0 && fuzz_below(f, 4)) t = wf_time(g->w, columns - 1);
    status = push(g->w, t, slope, behind);
    REQUIRE(push(copy, t, slope, behind) == status);
    if (!fuzz_finite(t)) REQUIRE(status < 0);
    if (status < 0) return status;
    REQUIRE(status < wf_columns(g->w));
    note_columns(g, columns, slope, behind);
    if (slope) REQUIRE(is_slope(g, status + 1));
    if (status >= columns && !behind) REQUIRE(fuzz_same(wf_time(g->w, status), t));
    if (behind) REQUIRE(g->kind[status] == BEHIND);
    g->moderate = moderate;
    return status;
}

/* `before` and `old` are the grid and the samples as they were. */
static int change_by_advance(fuzz *f, scene *s, grid *g, wf *copy, double *x, const wf *before, const double *old)
{
    const int history = fuzz_below(f, 4) ? fuzz_below(f, 4) : fuzz_int(f);
    const int status = wf_advance(g->w, history, s->n, s->x, s->ldx);
    int older = 0, shift, j;
    REQUIRE(wf_advance(copy, history, s->n, x, s->ldx) == status);
    if (history < 0) REQUIRE(status < 0);
    if (status < 0) return status;
    shift = wf_columns(before) - wf_columns(g->w);
    REQUIRE(shift >= 0);
    memmove(g->kind, g->kind + shift, (size_t)(CAPACITY - shift));
    g->kind[0] = VALUE; /* of a break that ends the window the value behind it is the start */
    for (j = 0; j < wf_start(g->w); j++) older += !is_slope(g, j);
    REQUIRE(older <= history);
    for (j = 0; j < wf_columns(g->w); j++) {
        REQUIRE(fuzz_same(wf_time(g->w, j), wf_time(before, j + shift)));
        REQUIRE(fuzz_all_same(s->n, s->x + j * s->ldx, old + (j + shift) * s->ldx));
        REQUIRE(g->kind[j] != BEHIND || j > wf_start(g->w));
    }
    return status;
}

static int change_by_restriction(fuzz *f, scene *s, grid *g, wf *copy)
{
    const int columns = wf_columns(g->w), start = wf_start(g->w);
    int status, history, j, older = 0;
    if (fuzz_below(f, 2)) {
        const int degree = fuzz_below(f, 8) ? fuzz_below(f, 8) : fuzz_int(f);
        history = fuzz_below(f, 8) ? fuzz_below(f, 6) : fuzz_int(f);
        status = wf_restrict(g->w, degree, history);
        REQUIRE(wf_restrict(copy, degree, history) == status);
        if (degree < 0 || degree > g->degree || history < 0 || columns == 0) REQUIRE(status < 0);
        if (status >= 0) REQUIRE(wf_degree(g->w) <= degree);
    } else {
        double error = -7, again = -7;
        status = history = wf_choose(g->w, s->n, s->x, s->ldx, &error);
        REQUIRE(wf_choose(copy, s->n, s->x, s->ldx, &again) == status);
        if (columns < 2 || s->n < 1) REQUIRE(status < 0);
        if (status < 0) REQUIRE(error >= -7 && error <= -7);
        else REQUIRE(fuzz_same(error, again) && (fuzz_is_nan(error) || error >= 0));
    }
    REQUIRE(wf_columns(g->w) == columns && wf_start(g->w) == start);
    for (j = columns > 0 ? g->w->hidden : 0; j < start; j++) older += g->kind[j] == VALUE;
    if (status >= 0) REQUIRE(older <= history && (g->w->hidden == 0 || older == history));
    return status;
}

static int change_by_begin(fuzz *f, scene *s, grid *g, wf *copy, double *x)
{
    const int count = fuzz_below(f, 8) ? fuzz_below(f, 6) : fuzz_int(f), slopes = fuzz_below(f, 2);
    const int degree = fuzz_below(f, 8) ? fuzz_below(f, 4) - 1 : fuzz_int(f), columns = wf_columns(g->w);
    double t[6];
    int k, moderate = g->moderate, status;
    if (count > 6) return WF_EARG;
    for (k = 0; k < 6; k++) t[k] = k > 0 && fuzz_below(f, 4) ? t[k - 1] + 0.25 + fabs(fuzz_unit(f)) : any_time(f, g, &moderate);
    status = slopes ? wf_begin_hermite(g->w, degree, count, t, s->n, s->x, s->ldx)
                    : wf_begin(g->w, degree, count, t, s->n, s->x, s->ldx);
    REQUIRE((slopes ? wf_begin_hermite(copy, degree, count, t, s->n, x, s->ldx)
                    : wf_begin(copy, degree, count, t, s->n, x, s->ldx)) == status);
    if (columns == 0 || count < 0) REQUIRE(status < 0);
    if (status < 0) return status;
    g->moderate = moderate;
    for (k = 0; k < count * (1 + slopes); k++)
        g->kind[wf_columns(g->w) - count * (1 + slopes) + k] = slopes && k % 2 ? SLOPE : VALUE;
    return status;
}

/* Push, break, roll back, advance, take back, restrict, begin, set a limit: on a copy, too, which must end in the same bits; a
   refusal must change none. */
static void change(fuzz *f, scene *s, grid *g)
{
    const int kind = fuzz_below(f, 24), columns = wf_columns(g->w), start = wf_start(g->w);
    const size_t count = room(s->n, s->ldx, CAPACITY);
    void *before = fuzz_copy(g->mem, g->bytes), *copy = fuzz_copy(g->mem, g->bytes);
    double *x = (double *)fuzz_copy(s->x, count * sizeof *x), *old = (double *)fuzz_copy(s->x, count * sizeof *x);
    wf *w = (wf *)copy;
    int status, begun = 0;
    if (kind < 14) {
        status = change_by_push(f, g, w, kind);
    } else if (kind < 16) {
        status = wf_rollback(g->w);
        REQUIRE(wf_rollback(w) == status);
        if (status >= 0) REQUIRE(wf_start(g->w) == start);
    } else if (kind == 16) {
        const double d = fuzz_below(f, 2) ? fabs(fuzz_unit(f)) : fuzz_double(f);
        status = wf_set(g->w, WF_SAMPLE_ERROR, d);
        REQUIRE(wf_set(w, WF_SAMPLE_ERROR, d) == status);
        if (!fuzz_finite(d) || d < 0) REQUIRE(status < 0);
        else REQUIRE(fuzz_same(wf_get(g->w, WF_SAMPLE_ERROR), d));
    } else if (kind == 17) {
        status = wf_pop(g->w);
        REQUIRE(wf_pop(w) == status);
        if (columns == 0) REQUIRE(status < 0);
        if (status >= 0) REQUIRE(wf_columns(g->w) < columns && wf_start(g->w) == start);
    } else if (kind < 20) {
        status = change_by_restriction(f, s, g, w);
    } else if (kind < 21) {
        status = change_by_begin(f, s, g, w, x);
        begun = status != WF_EARG && status != WF_EFEW; /* rolls back, even if it fails then */
    } else {
        status = change_by_advance(f, s, g, w, x, (const wf *)before, old);
    }
    REQUIRE(fuzz_all_same((ptrdiff_t)count, x, s->x));
    REQUIRE(memcmp(copy, g->mem, g->bytes) == 0);
    if (status < 0) {
        if (!begun) REQUIRE(memcmp(before, g->mem, g->bytes) == 0);
        REQUIRE(fuzz_all_same((ptrdiff_t)count, s->x, old));
    }
    if (wf_columns(g->w) == 0) g->moderate = 1;
    free(before);
    free(copy);
    free(x);
    free(old);
    check_grid(g);
}

/* A copy in another grid that has room says the same as the first. */
static void copy_of(fuzz *f, const grid *from, grid *to)
{
    const int m = wf_columns(from->w), status = wf_copy(to->w, from->w);
    double a[CAPACITY], b[CAPACITY], t;
    int moderate = from->moderate, j, one;
    if (from == to) REQUIRE(status == WF_EARG);
    if (status < 0) return;
    REQUIRE(wf_columns(to->w) == m && wf_start(to->w) == wf_start(from->w));
    memcpy(to->kind, from->kind, sizeof to->kind);
    to->moderate = from->moderate;
    check_grid(to);
    t = any_time(f, from, &moderate);
    if (to->degree != from->degree || !fuzz_same(wf_get(to->w, WF_SAMPLE_ERROR), wf_get(from->w, WF_SAMPLE_ERROR))) return;
    one = wf_weights(from->w, t, 0, a);
    REQUIRE(wf_weights(to->w, t, 0, b) == one);
    for (j = 0; one >= 0 && j < m; j++) REQUIRE(fuzz_same(a[j], b[j]));
}

static void reject_null(fuzz *f, const grid *g, scene *s)
{
    void *before = fuzz_copy(g->mem, g->bytes);
    double v[CAPACITY * 2], *out = fuzz_alloc(8);
    int first = -7;
    v[0] = wf_columns(g->w) > 0 ? wf_time(g->w, 0) : 0;
    (void)f;
    REQUIRE(wf_push(NULL, 1) < 0 && wf_push_hermite(NULL, 1) < 0 && wf_rollback(NULL) < 0);
    REQUIRE(wf_advance(NULL, 0, s->n, s->x, s->ldx) < 0);
    REQUIRE(wf_advance(g->w, 0, -1, s->x, s->ldx) < 0 && wf_advance(g->w, 0, 2, s->x, 1) < 0);
    REQUIRE(wf_advance(g->w, 0, 1, NULL, 1) < 0 || wf_columns(g->w) == 0);
    REQUIRE(wf_weights(NULL, 0, 0, v) < 0 && wf_weights(g->w, v[0], 0, NULL) < 0 && wf_weights(g->w, v[0], -1, v) < 0);
    REQUIRE(wf_basis(NULL, 0, 0, &first, v) < 0 && wf_basis(g->w, v[0], 0, NULL, v) < 0);
    REQUIRE(wf_basis(g->w, v[0], 0, &first, NULL) < 0 && first == -7);
    REQUIRE(wf_interpolate(NULL, v[0], 0, 1, s->x, 1, out) < 0 && wf_interpolate(g->w, v[0], 0, 1, NULL, 1, out) < 0);
    REQUIRE(wf_interpolate(g->w, v[0], 0, 1, s->x, 1, NULL) < 0 && wf_interpolate(g->w, v[0], 0, 2, s->x, 1, out) < 0);
    REQUIRE(wf_interpolate(g->w, v[0], -1, 1, s->x, 1, out) < 0 && wf_interpolate(g->w, v[0], 0, -1, s->x, 1, out) < 0);
    REQUIRE(wf_eval(NULL, v[0], 0, 1, s->x, 1, out) < 0 && wf_eval(g->w, v[0], 0, 1, NULL, 1, out) < 0);
    REQUIRE(wf_eval(g->w, v[0], 0, 1, s->x, 1, NULL) < 0 && wf_eval(g->w, v[0], 0, 2, s->x, 1, out) < 0);
    REQUIRE(wf_fit(NULL, 1, s->x, 1, out, 1) < 0 && wf_fit(g->w, 1, NULL, 1, out, 1) < 0);
    REQUIRE(wf_fit(g->w, 1, s->x, 1, NULL, 1) < 0 && wf_fit(g->w, 2, s->x, 1, out, 2) < 0);
    REQUIRE(wf_resample(NULL, g->w, 1, s->x, 1, out, 1) < 0 && wf_resample(g->w, NULL, 1, s->x, 1, out, 1) < 0);
    REQUIRE(wf_resample(g->w, g->w, 1, NULL, 1, out, 1) < 0 && wf_resample(g->w, g->w, 1, s->x, 1, NULL, 1) < 0);
    REQUIRE(wf_columns(NULL) <= 0 && wf_degree(NULL) <= 0 && wf_start(NULL) <= 0 && fuzz_is_nan(wf_time(NULL, 0)));
    REQUIRE(fuzz_untouched(8, out));
    REQUIRE(memcmp(before, g->mem, g->bytes) == 0);
    free(out);
    free(before);
}

/* ---- evaluation ------------------------------------------------------------------------------------------------------ */

/* What a relative error of eps in each entry of the collocation matrix may do to the sum of the weights. */
static double rounding_of_weights(const grid *g, const double *weight)
{
    const wf *w = g->w;
    const int m = wf_columns(w), p = wf_degree(w);
    double sum = 1;
    int j;
    for (j = 0; j < m; j++) {
        double size = 1, gap;
        if (is_slope(g, j)) {
            gap = HUGE_VAL;
            if (j > 1) gap = wf_time(w, j) - wf_time(w, j - 2);
            if (j + 1 < m && wf_time(w, j + 1) - wf_time(w, j) < gap) gap = wf_time(w, j + 1) - wf_time(w, j);
            size = 4 * p * p / gap;
        }
        if (fabs(weight[j]) > 0) sum += fabs(weight[j]) * size;
    }
    return DBL_EPSILON * 8 * (p + 2) * m * sum;
}

static void evaluate(fuzz *f, scene *s, const grid *g)
{
    const int m = wf_columns(g->w), deriv = fuzz_below(f, 3) ? 0 : fuzz_below(f, 2) ? fuzz_below(f, 5) : fuzz_int(f);
    int moderate = g->moderate, status, first = -7, j, inside;
    const double t = any_time(f, g, &moderate);
    double *weight = fuzz_alloc((size_t)m), *basis = fuzz_alloc(WF_MAX_DEGREE + 1), *out = fuzz_alloc((size_t)s->n);
    void *before = fuzz_copy(g->mem, g->bytes);
    inside = is_inside(g, t);
    status = wf_weights(g->w, t, deriv, weight);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)m, weight));
    if (m == 0 || deriv < 0 || !fuzz_finite(t)) REQUIRE(status < 0);
    if (status >= 0 && inside) REQUIRE(status != WF_EXTRAP);
    for (j = 0; status >= 0 && j < m; j++) REQUIRE(fuzz_finite(weight[j]));
    if (status >= 0 && inside && deriv == 0) {
        double sum = 0;
        for (j = 0; j < m; j++)
            if (!is_slope(g, j)) sum += weight[j];
        REQUIRE(fabs(sum - 1) <= rounding_of_weights(g, weight));
    }
    status = wf_basis(g->w, t, deriv, &first, basis);
    if (status < 0) REQUIRE(first == -7 && fuzz_untouched(WF_MAX_DEGREE + 1, basis));
    else {
        double sum = 0;
        REQUIRE(first >= 0 && first + wf_degree(g->w) < m);
        for (j = 0; j <= wf_degree(g->w); j++) {
            REQUIRE(fuzz_finite(basis[j]));
            if (inside && deriv == 0) REQUIRE(basis[j] >= -1e-12 && basis[j] <= 1 + 1e-12);
            sum += basis[j];
        }
        if (inside && deriv == 0) REQUIRE(fabs(sum - 1) <= 1e-13);
    }
    status = wf_interpolate(g->w, t, deriv, s->n, s->x, s->ldx, out);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, out));
    for (j = 0; status >= 0 && deriv == 0 && j < m; j++)
        if (g->kind[j] == VALUE && j >= g->w->hidden && fuzz_same(wf_time(g->w, j), t)) REQUIRE(fuzz_all_same(s->n, out, s->x + j * s->ldx));
    if (m > 0) REQUIRE(wf_interpolate(g->w, t, deriv, 1, s->x, 1, s->x + fuzz_below(f, m)) < 0); /* out within x */
    REQUIRE(memcmp(before, g->mem, g->bytes) == 0);
    free(before);
    free(weight);
    free(basis);
    free(out);
}

/* Coefficients: in place as out of place, and their values those of the samples. */
static void fit(fuzz *f, scene *s, const grid *g)
{
    const int m = wf_columns(g->w), hidden = g->w->hidden, count = fuzz_below(f, 40);
    const ptrdiff_t ldc = s->n + fuzz_below(f, 3);
    double *c = fuzz_alloc(room(s->n, ldc, m)), *d = (double *)fuzz_copy(s->x, room(s->n, s->ldx, m) * sizeof *d);
    double *out = fuzz_alloc((size_t)s->n), *value = fuzz_alloc((size_t)s->n), *t = fuzz_alloc((size_t)count);
    double *weight = fuzz_alloc((size_t)m), *sample = fuzz_alloc((size_t)s->n);
    const int deriv = fuzz_below(f, 2) ? 0 : fuzz_int(f), status = wf_fit(g->w, s->n, s->x, s->ldx, c, ldc);
    double basis[WF_MAX_DEGREE + 1];
    int moderate = g->moderate, k, one, first = 0, same;
    ptrdiff_t i, j;
    same = wf_fit(g->w, s->n, d, s->ldx, d, s->ldx);
    REQUIRE(status == same);
    if (status < 0) {
        REQUIRE(fuzz_untouched(room(s->n, ldc, m), c));
        REQUIRE(fuzz_all_same((ptrdiff_t)room(s->n, s->ldx, m), d, s->x));
    } else {
        REQUIRE(fuzz_untouched(hidden < m ? (size_t)(ldc * hidden) : 0, c));
        for (i = 0; s->plain && g->moderate && status == WF_OK && i < s->n; i++) { /* the same but for the order of the additions */
            double big = 1, tolerance; /* the condition of a B-spline basis grows like 2^degree */
            for (j = hidden; j < m; j++) big += fabs(c[i + j * ldc]);
            tolerance = big * (1e-14 * big + ldexp(DBL_EPSILON, wf_degree(g->w)));
            for (j = hidden; j < m && big < 1e6; j++) REQUIRE(fabs(c[i + j * ldc] - d[i + j * s->ldx]) <= tolerance);
        }
        if (s->n > 1) REQUIRE(wf_fit(g->w, s->n, s->x, s->ldx, s->x + 1, s->ldx) == WF_EOVERLAP); /* half overlapped */
        for (k = 0; k < count; k++) t[k] = any_time(f, g, &moderate);
        for (k = 0; k < count; k++) {
            const int each = wf_eval(g->w, t[k], deriv, s->n, c, ldc, value);
            one = wf_basis(g->w, t[k], deriv, &first, basis);
            REQUIRE(one == each); /* a row of them for wf_combine gives the same bits */
            for (j = 0; j < m; j++) weight[j] = one >= 0 && j >= first && j <= first + wf_degree(g->w) ? basis[j - first] : 0;
            if (one >= 0) {
                REQUIRE(wf_combine(1, m, weight, s->n, c, ldc, out, s->n) == WF_OK);
                REQUIRE(fuzz_all_same(s->n, value, out));
            }
            if (each < 0 || deriv != 0 || !s->plain || !g->moderate) continue;
            if (wf_interpolate(g->w, t[k], 0, s->n, s->x, s->ldx, sample) < 0 || wf_weights(g->w, t[k], 0, weight) < 0) continue;
            for (i = 0; i < s->n; i++) {
                double size = 0, big = 0;
                for (j = hidden; j < m; j++) {
                    size += fabs(weight[j] * s->x[i + j * s->ldx]) + fabs(c[i + j * ldc]);
                    if (big < fabs(s->x[i + j * s->ldx])) big = fabs(s->x[i + j * s->ldx]);
                }
                if (each == WF_EXTRAP || size > 1e6 * big) continue; /* noise amplified beyond what is checked here */
                REQUIRE(fabs(sample[i] - value[i]) <= 1e-13 * size * (1 + size / (big > 0 ? big : 1)));
            }
        }
    }
    free(c);
    free(d);
    free(out);
    free(value);
    free(t);
    free(weight);
    free(sample);
}

static void resample(fuzz *f, scene *s, const grid *from, const grid *to)
{
    const int m = wf_columns(from->w), k = wf_columns(to->w);
    const ptrdiff_t ldy = s->n + fuzz_below(f, 3);
    double *y = fuzz_alloc(room(s->n, ldy, k));
    const int status = wf_resample(from->w, to->w, s->n, s->x, s->ldx, y, ldy);
    int i, j;
    if (status < 0) {
        REQUIRE(fuzz_untouched(room(s->n, ldy, k), y));
    } else
        for (j = 0; j < k; j++) {
            for (i = from->w->hidden; i < m && to->kind[j] == VALUE; i++)
                if (from->kind[i] == VALUE && fuzz_same(wf_time(from->w, i), wf_time(to->w, j)))
                    REQUIRE(fuzz_all_same(s->n, y + j * ldy, s->x + i * s->ldx));
        }
    free(y);
}

/* Rows of weights for other purposes, each with what identifies it. */
static void rows(fuzz *f, scene *s, const grid *g, const grid *to)
{
    const int m = wf_columns(g->w), k = wf_columns(to->w), degree = fuzz_below(f, 8) ? fuzz_below(f, 3) : fuzz_int(f);
    const size_t size = (size_t)(m > 0 ? m : 1);
    double *weight = fuzz_alloc(size), *matrix = fuzz_alloc((size_t)(m * k)), *out = fuzz_alloc((size_t)s->n), *c, sum;
    double *work = fuzz_alloc((size_t)(k * (wf_degree(to->w) + 1))), ratio = -7, noise = -7;
    void *before = fuzz_copy(g->mem, g->bytes);
    int moderate = g->moderate, status, j;
    const double a = any_time(f, g, &moderate), b = any_time(f, g, &moderate);
    status = wf_predict(g->w, degree, a, weight);
    if (m == 0 || !fuzz_finite(a) || degree < 0 || degree > WF_MAX_DEGREE) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched(size, weight));
    free(weight);
    weight = fuzz_alloc(size);
    status = wf_basis_mean(g->w, a, b, weight);
    if (m == 0 || !fuzz_finite(a) || !fuzz_finite(b)) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched(size, weight));
    else if (moderate && is_inside(g, a) && a <= b && is_inside(g, b)) {
        for (sum = 0, j = 0; j < m; j++) sum += weight[j];
        REQUIRE(fabs(sum - 1) <= 1e-8);
    }
    if (wf_weights_mean(g->w, a, b, weight) >= 0)
        for (j = 0; j < m; j++) REQUIRE(fuzz_finite(weight[j]));
    free(weight);
    weight = fuzz_alloc(size);
    status = wf_error_weights(g->w, a, weight);
    if (status < 0) REQUIRE(fuzz_untouched(size, weight));
    status = wf_error(g->w, s->n, s->x, s->ldx, out);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, out));
    free(out);
    out = fuzz_alloc((size_t)s->n);
    status = wf_project(g->w, to->w, matrix, work);
    if (status < 0) REQUIRE(status == WF_ERANGE || fuzz_untouched((size_t)(m * k), matrix));
    else {
        REQUIRE(wf_combine(k, m, matrix, s->n, s->x, s->ldx, s->x, s->ldx) == (s->n > 0 ? WF_EOVERLAP : WF_OK));
    }
    status = wf_quality(g->w, &ratio, &noise);
    if (status < 0) REQUIRE(ratio >= -7 && ratio <= -7 && noise >= -7 && noise <= -7);
    else REQUIRE(!(ratio < 1) && !(noise < 1 - 1e-9) && wf_quality(g->w, NULL, NULL) == status);
    c = fuzz_alloc(room(s->n, s->ldx, m));
    if (wf_fit(g->w, s->n, s->x, s->ldx, c, s->ldx) >= 0) {
        status = wf_eval_mean(g->w, a, b, s->n, c, s->ldx, out);
        if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, out));
        wf_interpolate_mean(g->w, a, b, s->n, s->x, s->ldx, out);
    }
    free(weight);
    weight = fuzz_alloc(size);
    REQUIRE((status = wf_predict_degree(g->w, s->n, s->x, s->ldx)) <= WF_MAX_DEGREE && (status >= 0) == (m > 0));
    status = wf_hindsight(g->w, degree, fuzz_below(f, 4) ? fuzz_below(f, 3) : fuzz_int(f), weight);
    if (status < 0) REQUIRE(fuzz_untouched(size, weight));
    REQUIRE(wf_predict(NULL, 1, a, weight) < 0 && wf_basis_mean(NULL, a, b, weight) < 0 && wf_weights_mean(NULL, a, b, weight) < 0);
    REQUIRE(wf_error(NULL, 1, s->x, 1, weight) < 0 && wf_error_weights(NULL, a, weight) < 0 && wf_quality(NULL, &ratio, NULL) < 0);
    REQUIRE(wf_project(NULL, to->w, matrix, work) < 0 && wf_project(g->w, NULL, matrix, work) < 0 && wf_pop(NULL) < 0);
    REQUIRE(wf_eval_mean(NULL, a, b, 1, s->x, 1, weight) < 0 && wf_interpolate_mean(NULL, a, b, 1, s->x, 1, weight) < 0);
    REQUIRE(wf_copy(NULL, g->w) < 0 && wf_hindsight(NULL, 0, 0, weight) < 0 && wf_predict_degree(NULL, 1, s->x, 1) < 0);
    REQUIRE(memcmp(before, g->mem, g->bytes) == 0);
    free(before);
    free(weight);
    free(matrix);
    free(work);
    free(out);
    free(c);
}

/* The same grid with all times scaled by 2^k has the same weights; samples scaled by 2^k have values scaled by 2^k. */
static void scale(fuzz *f, scene *s, const grid *g)
{
    const int m = wf_columns(g->w), k = fuzz_below(f, 2) ? fuzz_below(f, 256) * 7 - 890 : fuzz_below(f, 200) - 100;
    int moderate = g->moderate, status, j;
    double t = any_time(f, g, &moderate), *weight, *other, *y;
    void *mem;
    wf *w;
    ptrdiff_t i;
    if (m == 0 || !moderate || wf_start(g->w) > 0 || g->w->limit < g->degree) return;
    mem = malloc(g->bytes);
    weight = fuzz_alloc((size_t)m);
    other = fuzz_alloc((size_t)m);
    REQUIRE(mem && wf_make(&w, g->degree, g->capacity, mem, g->bytes) == WF_OK);
    for (j = 0; j < m; j++) {
        if (is_slope(g, j)) continue;
        status = push(w, ldexp(wf_time(g->w, j), k), is_slope(g, j + 1), g->kind[j] == BEHIND);
        if (status != j) break; /* pushed one by one they were distinct; now they need not be */
    }
    if (j == m && wf_degree(w) == wf_degree(g->w)) {
        status = wf_weights(g->w, t, 0, weight);
        REQUIRE(wf_weights(w, ldexp(t, k), 0, other) == status);
        for (j = 0; status >= 0 && j < m; j++)
            if (!is_slope(g, j)) REQUIRE(fuzz_same(weight[j], other[j]));
    }
    if (s->plain && s->n > 0) {
        y = (double *)fuzz_copy(s->x, room(s->n, s->ldx, m) * sizeof *y);
        for (i = 0; i < (ptrdiff_t)room(s->n, s->ldx, m); i++) y[i] = ldexp(y[i], k);
        free(other);
        other = fuzz_alloc((size_t)s->n * 2);
        status = wf_interpolate(g->w, t, 0, s->n, s->x, s->ldx, other);
        REQUIRE(wf_interpolate(g->w, t, 0, s->n, y, s->ldx, other + s->n) == status);
        for (i = 0; status >= 0 && i < s->n; i++) { /* where no product is denormal */
            double smallest = HUGE_VAL, largest = 0;
            wf_weights(g->w, t, 0, weight);
            for (j = 0; j < m; j++) {
                const double v = fabs(weight[j] * s->x[i + j * s->ldx]);
                if (v > 0 && v < smallest) smallest = v;
                if (v > largest) largest = v;
            }
            if (largest < 1e30 && (smallest > 1e-30 || !(largest > 0))) REQUIRE(fuzz_same(ldexp(other[i], k), other[s->n + i]));
        }
        free(y);
    }
    free(weight);
    free(other);
    free(mem);
}

static void fuzz_one(fuzz *f)
{
    scene s;
    int i;
    s.n = fuzz_below(f, 5);
    s.ldx = s.n + fuzz_below(f, 3);
    s.x = fuzz_alloc(room(s.n, s.ldx, CAPACITY) + 2);
    for (i = 0; i < GRIDS; i++) make(f, &s.g[i]);
    fill(f, &s);
    while (fuzz_more(f)) {
        grid *g = &s.g[fuzz_below(f, 8) == 0];
        switch (fuzz_below(f, 16)) {
        case 0: REQUIRE(wf_message(fuzz_int(f)) && wf_message(fuzz_int(f))[0] && wf_linked_version() == WF_VERSION); break;
        case 1: refusals_of_make(f, g); break;
        case 2: reject_null(f, g, &s); break;
        case 3: fill(f, &s); break;
        case 4: case 5: case 6: evaluate(f, &s, g); break;
        case 7: fit(f, &s, g); break;
        case 8: resample(f, &s, g, &s.g[fuzz_below(f, GRIDS)]); break;
        case 9: scale(f, &s, g); break;
        case 10: rows(f, &s, g, &s.g[fuzz_below(f, GRIDS)]); break;
        case 11: copy_of(f, g, &s.g[fuzz_below(f, GRIDS)]); break;
        default: change(f, &s, g);
        }
    }
    for (i = 0; i < GRIDS; i++) free(s.g[i].mem);
    free(s.x);
}
