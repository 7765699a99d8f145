/* SPDX-License-Identifier: MIT

   fuzz_iqn.c - any sequence of calls of iqn.h with any arguments: see fuzz.h for the driver

   Four objects run side by side.  The twin, a copy made at any moment, sees every call but the refused ones: it must give
   the same bits for ever, so a copy is a checkpoint and a negative status has touched nothing that matters.  The third
   sees all vectors times a power of two: its residuals and iterates must be those of the first times that power, bit for
   bit.  The fourth has its vectors here (IQN_HOST); every full step of it is judged by a slow second implementation in
   long double: the coefficients must be those of the least squares that the header describes, solved group by group,
   where a pair is trusted by no more than its noise allows and by no less than drift and curvature can take from it; with a
   filter limit they and the choice of pairs are those of the textbook (Householder's QR).  Where that is well conditioned
   the first object's x is the fourth's.
   Besides: x stays untouched by a refusal and finite for finite data of moderate size, pairs stay within the capacity. */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#ifndef FUZZ_COUNT
#    define FUZZ_COUNT 5000
#endif
#include "fuzz.h"

enum { COLUMNS = 7, BLOCKS = 3, MOST_N = 40, SLOTS = COLUMNS + 2 };

/* The host of the fourth object */
typedef struct host {
    iqn *q;
    void *mem;
    int on;                                     /* vectors of at most MOST_N numbers, finite and of ordinary size, no sum */
    double V[SLOTS][MOST_N], W[SLOTS][MOST_N];
    double size[SLOTS][BLOCKS], last[BLOCKS];   /* |hx| of the pair in a slot, of the last step */
    int window[SLOTS], windows, merging;        /* of the pair in a slot; committed so far, since the last merge */
    int steps, pushed, explored;                /* in this window; parts of steps were made */
    int status, same, judged;                   /* same: as the first object did, always */
    double misled;                              /* (0.3 growth)^2 of past pairs that misled, and at most 1 for each step, summed */
    double largest_r[BLOCKS];                   /* of this window */
    double change[MOST_N];                      /* of r since the base before, by this step; no pair where there are no columns */
    double x[MOST_N], condition, largest;       /* the next x; of the least squares behind it, 0: not judged; the largest |hx| */
} host;

typedef struct hook {
    int calls, failing, poisoned; /* fail at that call, put NaN into the sums of that call; < 0: never */
} hook;

typedef struct scene {
    iqn *q, *twin, *scaled;
    void *mem, *twin_mem, *scaled_mem;
    size_t bytes;
    ptrdiff_t n;
    int columns, blocks;
    int power;             /* the third object's vectors are those of the first times 2^power */
    int scalable;          /* ... and nothing with a size of its own was set, nor anything but plain data offered */
    int moderate;          /* no number above 2^20 was offered */
    int solved;            /* this window has had an answer: a host that goes on gets next inputs */
    int hooked, bounded;
    hook h;
    host own;
    double *x, *hx, *A, *b; /* x as the last step left it; a map hx = A x + b */
} scene;

static int sum(double *v, int count, void *ctx)
{
    hook *h = (hook *)ctx;
    h->calls++;
    REQUIRE(count >= 0 && (v || count == 0));
    if (h->calls == h->poisoned && count > 0) v[0] = fuzz_of_bits((uint64_t)0x7ff8 << 48);
    return h->calls == h->failing;
}

static ptrdiff_t any_length(fuzz *f)
{
    switch (fuzz_below(f, 6)) {
    case 0: return PTRDIFF_MAX;
    case 1: return PTRDIFF_MIN;
    case 2: return PTRDIFF_MAX / (1 + fuzz_below(f, 256));
    default: return fuzz_int(f);
    }
}

static void host_make(scene *s);

static void make(fuzz *f, scene *s)
{
    const int kind = fuzz_below(f, 64);
    iqn *q = NULL;
    s->n = kind == 0 && fuzz_below(f, 4) == 0 ? 8190 + fuzz_below(f, 5) : kind < 4 ? 9 + fuzz_below(f, 30) : fuzz_below(f, 8);
    s->columns = fuzz_below(f, COLUMNS + 1);
    s->blocks = 1 + fuzz_below(f, BLOCKS);
    s->bytes = iqn_size(s->n, s->columns, s->blocks);
    REQUIRE(s->bytes > 0);
    s->mem = malloc(s->bytes);
    REQUIRE(s->mem != NULL);
    memset(s->mem, 0x5a, s->bytes);
    REQUIRE(iqn_make(&q, s->n, s->columns, s->blocks, s->mem, s->bytes - 1) < 0);
    REQUIRE(iqn_make(&q, s->n, s->columns, s->blocks, (char *)s->mem + 1 + fuzz_below(f, 7), s->bytes) < 0);
    REQUIRE(iqn_make(&q, s->n, s->columns, s->blocks, NULL, s->bytes) < 0);
    REQUIRE(iqn_make(NULL, s->n, s->columns, s->blocks, s->mem, s->bytes) < 0);
    REQUIRE(iqn_make(&q, -1, s->columns, s->blocks, s->mem, s->bytes) < 0);
    REQUIRE(iqn_make(&q, s->n, -1, s->blocks, s->mem, s->bytes) < 0 && iqn_make(&q, s->n, s->columns, 0, s->mem, s->bytes) < 0);
    REQUIRE(q == NULL && *(unsigned char *)s->mem == 0x5a);
    REQUIRE(iqn_make(&s->q, s->n, s->columns, s->blocks, s->mem, s->bytes) == IQN_OK);
    s->twin_mem = fuzz_copy(s->mem, s->bytes);
    s->twin = (iqn *)s->twin_mem;
    s->scaled_mem = fuzz_copy(s->mem, s->bytes);
    s->scaled = (iqn *)s->scaled_mem;
    s->power = fuzz_below(f, 2) ? fuzz_below(f, 250) * 2 - 250 : fuzz_below(f, 100) - 50;
    s->scalable = s->moderate = 1;
    host_make(s);
}

static void refusals_of_make(fuzz *f, scene *s)
{
    const ptrdiff_t n = any_length(f);
    const int columns = fuzz_int(f), blocks = fuzz_int(f);
    const size_t need = iqn_size(n, columns, blocks);
    iqn *q = NULL;
    if ((n < 0 && n != IQN_HOST) || columns < 0 || blocks < 1) REQUIRE(need == 0);
    if (need > 0) { /* no smaller than what the pairs alone take, or the size has wrapped around */
        REQUIRE((double)need >= 16. * (double)n * columns);
        REQUIRE(iqn_make(&q, n, columns, blocks, s->mem, need - 1) < 0);
    } else REQUIRE(iqn_make(&q, n, columns, blocks, s->mem, (size_t)-1) < 0);
    REQUIRE(q == NULL);
}

/* Everything that can be read is the same in both objects. */
static void compare(const scene *s, const iqn *a, const iqn *b)
{
    double *v = fuzz_alloc((size_t)s->n * 4 + 4);
    int key, i;
    for (key = -1; key < 170; key++) {
        if (key == IQN_NSUMS || key == IQN_NREFUSED) continue; /* count the refused calls, too */
        REQUIRE(fuzz_same(iqn_get(a, key), iqn_get(b, key)));
        for (i = -1; i <= s->blocks; i++) REQUIRE(fuzz_same(iqn_get_block(a, i, key), iqn_get_block(b, i, key)));
    }
    REQUIRE(iqn_converged(a) == iqn_converged(b));
    REQUIRE(iqn_get(a, IQN_PAIRS) >= 0 && iqn_get(a, IQN_PAIRS) <= s->columns);
    for (i = 0; i <= s->columns; i++) {
        const int one = iqn_pair(a, i, v, v + s->n), two = iqn_pair(b, i, v + 2 * s->n, v + 3 * s->n);
        REQUIRE(one == two && fuzz_all_same(2 * s->n, v, v + 2 * s->n));
    }
    free(v);
}

/* ---- the fourth object, and its judge --------------------------------------------------------------------------- */

typedef long double real;

static int block_of(const scene *s, ptrdiff_t i)
{
    double end = 0;
    int b = 0;
    while (b < s->blocks && i >= (ptrdiff_t)(end += iqn_get_block(s->q, b, IQN_LENGTH))) b++;
    return b;
}

static real inner(const scene *s, const double *weight, const real *a, const real *b)
{
    real sum = 0;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) {
        const real f = (real)weight[block_of(s, i)];
        sum += f * f * a[i] * b[i];
    }
    return sum;
}

static double norm_of(const scene *s, int block, const double *a)
{
    real sum = 0;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++)
        if (block < 0 || block_of(s, i) == block) sum += (real)a[i] * (real)a[i];
    return (double)sqrtl(sum);
}

/* The factor of every block, the largest 1.  0: not known here (sizes whose square underflows: the header
   takes them for 0). */
static int weights_of(const scene *s, const double *hx, double *weight, double *unit)
{
    int b;
    for (*unit = 0, b = 0; b < s->blocks; b++) {
        const int scaling = (int)iqn_get_block(s->own.q, b, IQN_SCALING);
        const double size = scaling == IQN_BY_VALUE ? norm_of(s, b, hx) : s->own.largest_r[b];
        weight[b] = iqn_get_block(s->own.q, b, IQN_WEIGHT);
        if (scaling != IQN_BY_WEIGHT && !(size > 1e-150)) return 0;
        if (scaling != IQN_BY_WEIGHT) weight[b] /= size;
        *unit = fmax(*unit, weight[b]);
    }
    for (b = 0; b < s->blocks; b++) weight[b] /= *unit;
    return *unit > 0;
}

static void host_make(scene *s)
{
    host *h = &s->own;
    const size_t bytes = iqn_size(IQN_HOST, s->columns, s->blocks);
    REQUIRE(bytes > 0);
    h->mem = malloc(bytes);
    REQUIRE(h->mem != NULL);
    REQUIRE(iqn_make(&h->q, IQN_HOST, s->columns, s->blocks, h->mem, bytes) == IQN_OK);
    h->on = h->same = s->n > 0 && s->n <= MOST_N;
}

/* The products of the iterate in slot now, in long double: of a push v stands in the place of r. */
static void products(const scene *s, const int *slot, int pairs, int push, double *dot)
{
    const host *h = &s->own;
    const int count = IQN_DOTS + 2 * pairs, now = slot[0], base = slot[1];
    real sum[IQN_DOTS + 2 * COLUMNS];
    int b, j;
    ptrdiff_t i;
    for (b = 0; b < s->blocks; b++) {
        memset(sum, 0, sizeof sum);
        for (i = 0; i < s->n; i++) {
            const real r = (real)h->V[now][i], hx = (real)h->W[now][i];
            const real rb = base < 0 ? 0 : (real)h->V[base][i], v = base < 0 ? 0 : r - rb;
            const real step = base < 0 ? 0 : hx - (real)h->W[base][i] - v;
            if (block_of(s, i) != b) continue;
            sum[IQN_DOT_RR] += r * r, sum[IQN_DOT_HH] += hx * hx;
            sum[IQN_DOT_VV] += base < 0 ? 1 : v * v;
            sum[IQN_DOT_VR] += push ? r * rb : v * r;
            sum[IQN_DOT_SS] += step * step, sum[IQN_DOT_SV] += step * v;
            for (j = 0; j < pairs; j++) {
                sum[IQN_DOTS + 2 * j] += (real)h->V[slot[2 + j]][i] * r;
                sum[IQN_DOTS + 2 * j + 1] += (real)h->V[slot[2 + j]][i] * v;
            }
        }
        for (j = 0; j < count; j++) dot[b * count + j] = (double)sum[j];
    }
}

/* What is known of a step that is to be judged */
typedef struct judged {
    int slot[SLOTS], pairs; /* newest first, those that were left out, too */
    double weight[BLOCKS], unit;
    real a[SLOTS], left[MOST_N], sum; /* r + V a so far; sum |v_j a_j| */
} judged;

/* What newer pairs of the group that take part leave of pair j (Householder would do; twice Gram and Schmidt in long double) */
static real rest_of(const scene *s, const judged *d, real (*Q)[MOST_N], int count, int j)
{
    int k;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) Q[count][i] = (real)s->own.V[d->slot[j]][i];
    for (k = 0; k < 2 * count; k++) {
        const real f = inner(s, d->weight, Q[count], Q[k % count]);
        for (i = 0; i < s->n; i++) Q[count][i] -= f * Q[k % count][i];
    }
    return sqrtl(inner(s, d->weight, Q[count], Q[count]));
}

/* One group of pairs: is a its least squares?  left becomes r + V a. */
static void judge_group(scene *s, judged *d, int begin, int end, int choice)
{
    host *h = &s->own;
    const real limit = (real)iqn_get(h->q, IQN_FILTER_LIMIT), e = (real)iqn_get(h->q, IQN_PRODUCT_ERROR);
    const real largest = (real)h->largest;
    const real drift = 0.01L * h->windows, most = !(limit > 0) ? drift * drift + (real)h->misled + 1 : 0;
    real Q[SLOTS][MOST_N], v[MOST_N], size, rest, left_norm, least = 1;
    int j, b, count = 0;
    ptrdiff_t i;
    for (j = begin; j < end; j++) {
        for (i = 0; i < s->n; i++) v[i] = (real)h->V[d->slot[j]][i];
        size = sqrtl(inner(s, d->weight, v, v));
        rest = rest_of(s, d, Q, count, j);
        if (choice && limit > 0 && size > 0) { /* rounding: 1e-13 of the squares, more where kept pairs are nearly alike */
            const real ratio = rest * rest / (size * size), error = 1e-13L / (least * least);
            if (d->a[j] != 0) REQUIRE(ratio >= limit * limit * (1 - 1e-6L) - error);
            else REQUIRE(ratio <= fmaxl(limit * limit, 100 * e) * (1 + 1e-6L) + error);
        }
        if (d->a[j] == 0) continue;
        least *= size > 0 ? fminl(1, rest / size) : 0;
        for (i = 0; i < s->n; i++) d->left[i] += d->a[j] * v[i];
        d->sum += size * fabsl(d->a[j]);
        if (!(rest > 0)) continue;
        for (i = 0; i < s->n; i++) Q[count][i] /= rest;
        count++;
    }
    h->condition = fmax(h->condition, (double)(1 / least));
    left_norm = sqrtl(inner(s, d->weight, d->left, d->left));
    for (j = begin; j < end; j++) { /* -<v, r + V a> = s^2 a, with s^2 of what a pair can be doubted by */
        real known = 0, doubt, slack;
        if (d->a[j] == 0) continue;
        for (i = 0; i < s->n; i++) v[i] = (real)h->V[d->slot[j]][i];
        size = sqrtl(inner(s, d->weight, v, v));
        for (b = 0; b < s->blocks && !(limit > 0); b++) {
            const real noise = (real)(iqn_get(h->q, IQN_NOISE_LEVEL) * d->weight[b] * h->size[d->slot[j]][b]);
            known += noise * noise;
        }
        known += 10 * e * size * size;
        doubt = -inner(s, d->weight, v, d->left) * (d->a[j] > 0 ? 1 : -1);
        slack = 1e-13L * size * (left_norm + d->sum + size + largest);
        REQUIRE(doubt >= known * (1 - 1e-9L) * fabsl(d->a[j]) - slack);
        REQUIRE(doubt <= (known + most * size * size) * (1 + 1e-9L) * fabsl(d->a[j]) + slack);
    }
}

static int group_end(const scene *s, const judged *d, int begin)
{
    const host *h = &s->own;
    int windows = 1, i;
    if ((int)iqn_get(h->q, IQN_METHOD) != IQN_IMVJ) return d->pairs;
    if (begin == 0 && iqn_get(h->q, IQN_WINDOWS) > 0)
        windows = (int)iqn_get(h->q, IQN_WINDOWS) + (h->window[d->slot[0]] == h->windows);
    for (i = begin + 1; i < d->pairs; i++)
        if (h->window[d->slot[i]] != h->window[d->slot[i - 1]] && --windows == 0) break;
    return i;
}

/* Does v of this step lie on a line with r of its iterate?  Only then half of a bracket takes the place of a step. */
static int on_a_line(const scene *s, const double *r)
{
    const double *v = s->own.change;
    real rr = 0, rv = 0, vv = 0;
    ptrdiff_t i;
    if (s->n == 1) return 1;
    for (i = 0; i < s->n; i++) rr += (real)r[i] * (real)r[i], rv += (real)r[i] * (real)v[i], vv += (real)v[i] * (real)v[i];
    return fabsl(rv) > (1 - 1e-8L) * sqrtl(rr) * sqrtl(vv);
}

/* The weights of a step that was not the answer: full steps are judged, a relaxation is one by omega. */
static void judge(scene *s, const double *weight, const double *r, const double *hx)
{
    host *h = &s->own;
    const int slots = s->columns + 2;
    judged d;
    int all[SLOTS], j, b, base, begin, end, kept = 0, largest = -1, whole = 1, told;
    double factor, times_r, mixing = iqn_get(h->q, IQN_MIXING), error = 1e-12 + 4e-16 / fabs(mixing); /* of times_r, which is 1 + a weight */
    real z, left, predicted;
    const real largest_of_run = (real)h->largest;
    ptrdiff_t i;
    memset(&d, 0, sizeof d);
    d.pairs = iqn_ask(h->q, all); /* for the next step: the base and the pairs of this one */
    base = all[1];
    REQUIRE(base >= 0 && weight[slots + base] == 1);
    times_r = 1 + weight[base];
    memcpy(d.slot, all + 2, (size_t)d.pairs * sizeof *d.slot);
    for (j = 0; j < d.pairs; j++) {
        d.a[j] = (real)weight[slots + d.slot[j]];
        kept += d.a[j] != 0;
        if (d.a[j] != 0 && (largest < 0 || fabsl(d.a[j]) > fabsl(d.a[largest]))) largest = j;
    }
    h->condition = 0;
    if (h->status == IQN_RELAXED) {
        REQUIRE(largest < 0);
        REQUIRE(fabs(times_r - iqn_get(h->q, IQN_OMEGA_NOW)) <= 1e-15 * (1 + fabs(times_r)) || on_a_line(s, r));
    }
    if (largest < 0 || !weights_of(s, hx, d.weight, &d.unit)) return;
    if (!(norm_of(s, -1, h->V[base]) > 1e-150)) return; /* squares underflow */
    factor = times_r / (1 + weight[d.slot[largest]] / (double)d.a[largest]);
    if (!(fabs(factor - 1) <= 1e-9) || h->status == IQN_EXPLORED) return; /* a part of a full step; of times_r 1e-16 the factor is rounding */
    for (i = 0; i < s->n; i++) d.left[i] = (real)h->V[base][i];
    z = sqrtl(inner(s, d.weight, d.left, d.left));
    for (b = 0; b < s->blocks; b++) whole &= d.weight[b] > 0;
    for (begin = 0; begin < d.pairs; begin = end) {
        end = group_end(s, &d, begin);
        judge_group(s, &d, begin, end, whole && kept == (int)iqn_get(h->q, IQN_PAIRS));
    }
    left = sqrtl(inner(s, d.weight, d.left, d.left));
    predicted = (real)(iqn_get(h->q, IQN_PREDICTED) / d.unit);
    told = z * (real)d.unit > 1e-290L; /* else it is less than a double can say */
    if (told) REQUIRE(fabsl(predicted * predicted - left * left) <= 1e-7L * (z * z + d.sum * d.sum) + 1e-13L * (z + d.sum) * largest_of_run);
    REQUIRE((times_r / mixing > -1 || error > 1) && fabs(times_r / mixing) <= 1 + error);
    if (!whole) REQUIRE(fabs(times_r / mixing - 1) <= error);
    else if (told && times_r / mixing < 1 - error) REQUIRE((real)fabs(mixing / times_r) * predicted >= z * (1 - 1e-6L));
    if (z < 1e-6L * largest_of_run) h->condition = 0; /* rounding errors of earlier products are as large */
    h->judged++;
}

/* The same iterate as the first object's, after that has taken it: x as H got it */
static void host_step(scene *s, const double *x, const double *hx)
{
    host *h = &s->own;
    const int slots = s->columns + 2;
    double dot[BLOCKS * (IQN_DOTS + 2 * COLUMNS)], weight[2 * SLOTS], r[MOST_N];
    int slot[SLOTS], pairs, store, t, b;
    ptrdiff_t i;
    pairs = iqn_ask(h->q, slot);
    REQUIRE(pairs >= 0 && pairs <= s->columns);
    for (i = 0; i < s->n; i++) {
        h->W[slot[0]][i] = hx[i];
        h->V[slot[0]][i] = r[i] = hx[i] - x[i];
    }
    h->largest = fmax(h->largest, norm_of(s, -1, r) + norm_of(s, -1, hx));
    for (b = 0; h->steps == 1 && b < s->blocks; b++) {
        const double base = norm_of(s, b, h->V[slot[1]]), growth = base > 0 ? norm_of(s, b, r) / base : HUGE_VAL;
        h->misled += 0.09 * growth * growth;
    }
    h->misled += 1 + 1e-4; /* at most, by a step that fails */
    for (b = 0; b < s->blocks; b++) h->largest_r[b] = fmax(h->steps > 0 ? h->largest_r[b] : 0, norm_of(s, b, r));
    products(s, slot, pairs, 0, dot);
    h->status = iqn_weights(h->q, dot, weight, &store);
    REQUIRE(h->status >= 0);
    REQUIRE(store == -1 || store == slot[0] || (store == slot[1] && store >= 0));
    for (b = 0; b < s->blocks; b++) h->last[b] = norm_of(s, b, hx);
    for (i = 0; i < s->n; i++) h->change[i] = h->steps > 0 ? h->V[slot[0]][i] - h->V[slot[1]][i] : 0;
    for (i = 0; store >= 0 && i < s->n; i++) {
        h->W[store][i] = h->W[slot[0]][i] - h->W[slot[1]][i];
        h->V[store][i] = h->change[i];
    }
    if (store >= 0) h->window[store] = h->windows, memcpy(h->size[store], h->last, sizeof h->last);
    h->steps++, h->explored |= h->status == IQN_EXPLORED || h->status == IQN_WITHDRAWN;
    for (i = 0; i < s->n; i++)
        for (h->x[i] = 0, t = 0; t < slots; t++) {
            if (weight[t] != 0) h->x[i] += weight[t] * h->V[t][i];
            if (weight[slots + t] != 0) h->x[i] += weight[slots + t] * h->W[t][i];
        }
    if (h->status != IQN_SOLVED && !iqn_converged(h->q)) judge(s, weight, r, hx);
    else h->condition = 0;
}

static void host_push(scene *s, const double *v, const double *w)
{
    host *h = &s->own;
    double dot[BLOCKS * (IQN_DOTS + 2 * COLUMNS)];
    int slot[SLOTS], b;
    const int pairs = iqn_ask(h->q, slot);
    memcpy(h->V[slot[0]], v, (size_t)s->n * sizeof *v);
    memcpy(h->W[slot[0]], w, (size_t)s->n * sizeof *w);
    products(s, slot, pairs, 1, dot);
    if (iqn_push_dots(h->q, dot) != IQN_OK) return;
    h->window[slot[0]] = h->windows;
    h->pushed = 1;
    for (b = 0; b < s->blocks; b++) h->size[slot[0]][b] = h->last[b] > 0 ? h->last[b] : norm_of(s, b, w);
}

static void host_window(scene *s, int commit)
{
    host *h = &s->own;
    int i;
    if (commit) {
        REQUIRE(iqn_commit(h->q) == IQN_OK);
        if (h->steps > 0 || h->pushed) h->windows++, h->merging++;
        if ((int)iqn_get(h->q, IQN_METHOD) == IQN_IMVJ && iqn_get(h->q, IQN_MERGE) > 0 && h->merging >= iqn_get(h->q, IQN_MERGE)) {
            for (i = 0; i < SLOTS; i++) h->window[i] = h->windows - 1;
            h->merging = 0;
        }
    } else {
        REQUIRE(iqn_discard(h->q) == IQN_OK);
        h->misled += h->steps == 1; /* H had no answer to what past pairs have made */
    }
    h->steps = h->pushed = h->explored = 0;
}

/* The fourth beside the first, as long as all that they decided was the same */
static void compare_hosts(scene *s, int status)
{
    host *h = &s->own;
    double size = 1;
    ptrdiff_t i;
    if (h->status != status || !fuzz_same(iqn_get(h->q, IQN_PAIRS), iqn_get(s->q, IQN_PAIRS))) h->same = 0; /* at a limit */
    if (!h->same || !(h->condition > 0 && h->condition < 100) || s->bounded) return;
    if (!(iqn_get(s->q, IQN_FILTER_LIMIT) > 0)) return; /* whether a step was a surprise is decided among rounding errors */
    for (i = 0; i < s->n; i++) size = fmax(size, fabs(s->x[i]) + fabs(h->x[i]));
    for (i = 0; i < s->n; i++) REQUIRE(fabs(h->x[i] - s->x[i]) <= 1e-6 * size);
}

static void set(fuzz *f, scene *s)
{
    const int kind = fuzz_below(f, 4), block = fuzz_below(f, 8) ? fuzz_below(f, s->blocks + 1) - 1 : fuzz_int(f);
    const int key = kind == 0 ? fuzz_int(f) : kind == 1 ? IQN_LENGTH + fuzz_below(f, 8) : fuzz_below(f, 27);
    const double value = fuzz_below(f, 2) ? fuzz_below(f, 12) : fuzz_double(f);
    int status, same;
    if (kind == 3 || fuzz_below(f, 2)) {
        status = iqn_set(s->q, key, value);
        same = iqn_set(s->twin, key, value);
        iqn_set(s->scaled, key, value);
        iqn_set(s->own.q, key, value);
        REQUIRE(iqn_set(NULL, key, value) < 0);
        if (status >= 0) REQUIRE(fuzz_same(iqn_get(s->q, key), value));
    } else {
        status = iqn_set_block(s->q, block, key, value);
        same = iqn_set_block(s->twin, block, key, value);
        iqn_set_block(s->scaled, block, key, value);
        if (key != IQN_LENGTH) iqn_set_block(s->own.q, block, key, value);
        REQUIRE(iqn_set_block(NULL, block, key, value) < 0);
        if (status >= 0) REQUIRE(block < 0 ? block == -1 : fuzz_same(iqn_get_block(s->q, block, key), value) || value == 0); /* -0 */
    }
    REQUIRE(status == same);
    if (status < 0) return;
    REQUIRE(fuzz_finite(value));
    if (key == IQN_LOWER || key == IQN_UPPER) s->bounded = 1;
    if (key == IQN_METHOD || key >= IQN_LENGTH) s->own.same = s->own.same && key >= IQN_LENGTH; /* pairs of another method */
    if (key == IQN_TOL_ABSOLUTE || key == IQN_LOWER || key == IQN_UPPER) s->scalable = 0;
    if (key == IQN_SCALING && block >= 0 && s->blocks > 1) s->scalable = 0; /* one block in units of its own, one in units of 1 */
    if (value != 0 && !(fabs(value) > 1e-30 && fabs(value) < 1e30)) s->scalable = 0; /* beside 2^900 out of range */
}

static void set_sum(fuzz *f, scene *s)
{
    REQUIRE(iqn_set_sum(NULL, sum, &s->h) < 0);
    s->hooked = fuzz_below(f, 2);
    REQUIRE(iqn_set_sum(s->q, s->hooked ? sum : NULL, &s->h) >= 0);
    REQUIRE(iqn_set_sum(s->twin, s->hooked ? sum : NULL, &s->h) >= 0);
    REQUIRE(iqn_set_sum(s->scaled, s->hooked ? sum : NULL, &s->h) >= 0);
}

/* x and hx of the next step: any, or from the map at the x of the step before. */
static void evaluate(fuzz *f, scene *s)
{
    const int kind = fuzz_below(f, 16), power = fuzz_below(f, 256) * 8 - 1020;
    const ptrdiff_t n = s->n;
    ptrdiff_t i, j;
    for (i = 0; i < n; i++)
        if (!(fabs(s->x[i]) < 1048576)) break;
    for (j = 0; i < n && j < n; j++) s->x[j] = 1;
    if (i < n) s->own.on = 0; /* another x is refused there */
    for (i = 0; i < n; i++) {
        const double x = s->x[i];
        switch (kind) {
        case 0: if (!s->own.on) s->x[i] = i < 40 ? fuzz_double(f) : 1; s->hx[i] = i < 40 ? fuzz_double(f) : 2; break;
        case 1: s->hx[i] = x; break;
        case 2: if (!s->own.on) s->x[i] = i < 40 ? fuzz_unit(f) : 1; s->hx[i] = i < 40 ? fuzz_unit(f) : 2; break;
        case 3: break; /* the same again */
        case 4: s->hx[i] = x * (1 + DBL_EPSILON * (double)(i % 3)); break;
        case 5: s->hx[i] = i < 40 ? ldexp(fuzz_unit(f), power) : x; break;
        case 6: s->hx[i] = i < 3 ? x + 1 : x; break;
        default:
            s->hx[i] = s->b[i % 8];
            for (j = i; j < n && j < i + 8; j++) s->hx[i] += s->A[i % 8 * 8 + j - i] * s->x[j];
            if (kind > 13) s->hx[i] += s->x[i] * s->x[i] / 8;
        }
    }
    if (kind == 0 || kind == 5) s->scalable = 0;
    for (i = 0; i < n; i++) {
        if (!(fabs(s->hx[i]) < 1e7 && fabs(s->x[i]) < 1e7)) s->scalable = s->moderate = 0;
        if (s->hx[i] != 0 && fabs(s->hx[i]) < 1e-20) s->scalable = 0;
        if (s->x[i] != 0 && fabs(s->x[i]) < 1e-20) s->scalable = 0;
    }
}

/* A pair from elsewhere. */
static void push(fuzz *f, scene *s)
{
    double *v = fuzz_alloc((size_t)s->n), *w = fuzz_alloc((size_t)s->n);
    const int wild = fuzz_below(f, 4) == 0;
    int status, same;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) {
        v[i] = i >= 40 ? 1 : wild ? fuzz_double(f) : fuzz_unit(f);
        w[i] = i >= 40 ? 1 : wild ? fuzz_double(f) : fuzz_unit(f);
    }
    s->h.calls = 0;
    status = iqn_push(s->q, v, w);
    if (wild) s->scalable = s->moderate = s->own.on = 0;
    if (status >= 0 && s->own.on) host_push(s, v, w);
    if (status >= 0) {
        s->h.calls = 0;
        same = iqn_push(s->twin, v, w);
        REQUIRE(status == same);
    }
    if (s->scalable) {
        for (i = 0; i < s->n; i++) {
            v[i] = ldexp(v[i], s->power);
            w[i] = ldexp(w[i], s->power);
        }
        s->h.calls = 0;
        REQUIRE(iqn_push(s->scaled, v, w) == status);
    }
    if (s->n > 0) REQUIRE(iqn_push(s->q, NULL, w) < 0 && iqn_push(s->q, v, NULL) < 0);
    REQUIRE(iqn_push(NULL, v, w) < 0);
    free(v);
    free(w);
}

static void step(fuzz *f, scene *s)
{
    const size_t size = (size_t)s->n * sizeof *s->x;
    double *x, *y, *g;
    int status, same, all_finite = 1;
    ptrdiff_t i;
    evaluate(f, s);
    for (i = 0; s->own.steps > 0 && i < s->n; i++) /* another x than was given is refused beside own vectors, or is to be told */
        if (!(fabs(s->own.x[i] - s->x[i]) <= 1e-6 * (fabs(s->x[i]) + fabs(s->own.x[i])))) s->own.on = 0;
    x = (double *)fuzz_copy(s->x, size);
    y = (double *)fuzz_copy(s->x, size);
    g = (double *)fuzz_copy(s->hx, size);
    for (i = 0; i < s->n; i++) all_finite &= fuzz_finite(s->x[i]) && fuzz_finite(s->hx[i]);
    s->h.calls = 0;
    s->h.failing = s->hooked && fuzz_below(f, 8) == 0 ? 1 + fuzz_below(f, 2) : -1;
    s->h.poisoned = s->hooked && fuzz_below(f, 8) == 0 ? 1 : -1;
    status = iqn_step(s->q, s->x, s->hx);
    REQUIRE(fuzz_all_same(s->n, s->hx, g));
    if (!all_finite) REQUIRE(status < 0);
    if (status >= 0) {
        REQUIRE(!s->hooked || s->h.calls > 0);
        REQUIRE(!s->hooked || (s->h.calls < s->h.failing || s->h.failing < 0));
        REQUIRE(s->h.poisoned < 0);
        s->h.calls = 0;
        same = iqn_step(s->twin, x, s->hx);
        REQUIRE(status == same && fuzz_all_same(s->n, x, s->x));
        for (i = 0; s->moderate && i < s->n; i++) REQUIRE(fuzz_finite(s->x[i]));
        for (i = 0; status == IQN_SOLVED && s->blocks == 1 && !s->solved && i < s->n; i++)
            REQUIRE(s->x[i] >= s->hx[i] && s->x[i] <= s->hx[i]);
        s->solved |= status == IQN_SOLVED;
        REQUIRE(iqn_get(s->q, IQN_RESIDUAL) >= 0);
    } else {
        REQUIRE(fuzz_all_same(s->n, x, s->x));
        if (s->moderate && !s->hooked) REQUIRE(status == IQN_ELENGTH); /* lengths of the blocks do not add up */
    }
    compare(s, s->q, s->twin);
    if (!s->moderate) s->own.on = 0;
    if (status >= 0 && s->own.on) {
        host_step(s, y, g);
        compare_hosts(s, status);
    }
    if (s->scalable) {
        const double residual = iqn_get(s->q, IQN_RESIDUAL);
        for (i = 0; i < s->n; i++) {
            y[i] = ldexp(y[i], s->power);
            g[i] = ldexp(g[i], s->power);
        }
        s->h.calls = 0;
        same = iqn_step(s->scaled, y, g);
        REQUIRE(same == status);
        for (i = 0; i < s->n; i++) {
            g[i] = ldexp(s->x[i], s->power);
            if (s->x[i] != 0 && fabs(g[i]) < DBL_MIN) s->scalable = 0; /* subnormal: digits are lost */
        }
        REQUIRE(!s->scalable || fuzz_all_same(s->n, y, g));
        REQUIRE(status < 0 || fuzz_same(ldexp(iqn_get(s->scaled, IQN_RESIDUAL), -s->power), residual));
    }
    if (status >= 0 && s->bounded) { /* the first x may lie beyond the bounds, and farther from the next one than it was told */
        REQUIRE(iqn_changed(s->q) == IQN_OK && iqn_changed(s->twin) == IQN_OK && iqn_changed(s->scaled) == IQN_OK);
        if (s->own.on) REQUIRE(iqn_changed(s->own.q) == IQN_OK);
    }
    s->h.failing = s->h.poisoned = -1;
    if (s->n > 0) {
        REQUIRE(iqn_step(s->q, NULL, s->hx) < 0 && iqn_step(s->q, s->x, NULL) < 0 && iqn_step(s->q, s->x, s->x) < 0);
        REQUIRE(iqn_step(NULL, s->x, s->hx) < 0);
    }
    free(x);
    free(y);
    free(g);
}

static void window(fuzz *f, scene *s)
{
    const int commit = fuzz_below(f, 2);
    host_window(s, commit);
    if (commit) {
        s->solved = 0;
        REQUIRE(iqn_commit(s->q) == iqn_commit(s->twin));
        iqn_commit(s->scaled);
    } else {
        s->solved = 0;
        REQUIRE(iqn_discard(s->q) == iqn_discard(s->twin));
        iqn_discard(s->scaled);
    }
    REQUIRE(iqn_commit(NULL) < 0 && iqn_discard(NULL) < 0);
    compare(s, s->q, s->twin);
}

/* H has failed, or the host has another x. */
static void change(fuzz *f, scene *s)
{
    double *x = (double *)fuzz_copy(s->x, (size_t)s->n * sizeof *s->x), *y = (double *)fuzz_copy(s->x, (size_t)s->n * sizeof *s->x);
    int status, halved = 0;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) y[i] = ldexp(y[i], s->power);
    if (fuzz_below(f, 2)) {
        halved = 1;
        status = iqn_halve(s->q, s->x);
        REQUIRE(status == iqn_halve(s->twin, x) && fuzz_all_same(s->n, x, s->x));
        if (s->scalable) REQUIRE(status == iqn_halve(s->scaled, y));
        for (i = 0; s->scalable && i < s->n; i++) REQUIRE(fuzz_same(y[i], ldexp(s->x[i], s->power)));
        REQUIRE(status == IQN_OK || status == IQN_EORDER);
    } else {
        status = iqn_changed(s->q);
        REQUIRE(iqn_changed(s->twin) == IQN_OK && iqn_changed(s->scaled) == IQN_OK);
        for (i = 0; i < s->n; i++) s->x[i] = fuzz_unit(f);
    }
    s->own.explored |= halved && status == IQN_OK;
    if (status == IQN_OK && s->own.on) REQUIRE((halved ? iqn_halve(s->own.q, NULL) : iqn_changed(s->own.q)) == IQN_OK);
    REQUIRE(iqn_halve(NULL, x) < 0 && iqn_changed(NULL) < 0 && (s->n == 0 || iqn_halve(s->own.q, x) == IQN_EHOST));
    free(x);
    free(y);
}

static void read(fuzz *f, scene *s)
{
    double *v = fuzz_alloc((size_t)s->n);
    const int j = fuzz_int(f), block = fuzz_int(f), key = fuzz_int(f);
    const char *message = iqn_message(fuzz_below(f, 2) ? fuzz_int(f) : fuzz_below(f, 2) ? -fuzz_below(f, 256) : fuzz_below(f, 256));
    REQUIRE(message && message[0] && iqn_linked_version() == IQN_VERSION);
    iqn_get(s->q, key);
    iqn_get_block(s->q, block, key);
    REQUIRE(fuzz_is_nan(iqn_get(NULL, key)) && fuzz_is_nan(iqn_get_block(NULL, 0, key)));
    if (iqn_pair(s->q, j, v, NULL) < 0) REQUIRE(fuzz_untouched((size_t)s->n, v));
    else REQUIRE(iqn_pair(s->q, j, NULL, NULL) >= 0);
    REQUIRE(iqn_pair(NULL, 0, v, v) < 0);
    REQUIRE(iqn_converged(NULL) == 0 || iqn_converged(NULL) < 0);
    free(v);
}

static void fuzz_one(fuzz *f)
{
    scene s;
    ptrdiff_t i;
    memset(&s, 0, sizeof s);
    make(f, &s);
    s.h.failing = s.h.poisoned = -1;
    s.x = fuzz_alloc((size_t)s.n);
    s.hx = fuzz_alloc((size_t)s.n);
    s.A = fuzz_alloc(64);
    s.b = fuzz_alloc(8);
    for (i = 0; i < s.n; i++) s.x[i] = s.hx[i] = 0;
    for (i = 0; i < 64; i++) s.A[i] = fuzz_unit(f);
    for (i = 0; i < 8; i++) s.b[i] = fuzz_unit(f);
    while (fuzz_more(f))
        switch (fuzz_below(f, 16)) {
        case 0: set(f, &s); break;
        case 1: set_sum(f, &s); break;
        case 2: push(f, &s); break;
        case 3: window(f, &s); break;
        case 4: read(f, &s); break;
        case 5: refusals_of_make(f, &s); break;
        case 6: memcpy(s.twin_mem, s.mem, s.bytes); break;
        case 7: change(f, &s); break;
        default: step(f, &s);
        }
    free(s.mem);
    free(s.twin_mem);
    free(s.scaled_mem);
    free(s.own.mem);
    free(s.x);
    free(s.hx);
    free(s.A);
    free(s.b);
}
