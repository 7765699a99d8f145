/* SPDX-License-Identifier: MIT

   fuzz_iqn.c - any sequence of calls of iqn.h with any arguments: see fuzz.h for the driver

   Three objects run side by side.  The twin, a copy made at any moment, sees every call but the refused ones: it must give
   the same bits for ever, so a copy is a checkpoint and a negative status has touched nothing that matters.  The third
   sees all vectors times a power of two: its residuals and iterates must be those of the first times that power, bit for
   bit.
   Besides: x stays untouched by a refusal and finite for finite data of moderate size, pairs stay within the capacity.    */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#ifndef FUZZ_COUNT
#    define FUZZ_COUNT 5000
#endif
#include "fuzz.h"

enum { COLUMNS = 7, BLOCKS = 3 };

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
    int hooked;
    hook h;
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
    s->power = fuzz_below(f, 2) ? fuzz_below(f, 250) * 7 - 870 : fuzz_below(f, 100) - 50;
    s->scalable = s->moderate = 1;
}

static void refusals_of_make(fuzz *f, scene *s)
{
    const ptrdiff_t n = any_length(f);
    const int columns = fuzz_int(f), blocks = fuzz_int(f);
    const size_t need = iqn_size(n, columns, blocks);
    iqn *q = NULL;
    if (n < 0 || columns < 0 || blocks < 1) REQUIRE(need == 0);
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

static void set(fuzz *f, scene *s)
{
    const int kind = fuzz_below(f, 4), block = fuzz_below(f, 8) ? fuzz_below(f, s->blocks + 1) - 1 : fuzz_int(f);
    const int key = kind == 0 ? fuzz_int(f) : kind == 1 ? IQN_LENGTH + fuzz_below(f, 8) : fuzz_below(f, 26);
    const double value = fuzz_below(f, 2) ? fuzz_below(f, 12) : fuzz_double(f);
    int status, same;
    if (kind == 3 || fuzz_below(f, 2)) {
        status = iqn_set(s->q, key, value);
        same = iqn_set(s->twin, key, value);
        iqn_set(s->scaled, key, value);
        REQUIRE(iqn_set(NULL, key, value) < 0);
        if (status >= 0) REQUIRE(fuzz_same(iqn_get(s->q, key), value));
    } else {
        status = iqn_set_block(s->q, block, key, value);
        same = iqn_set_block(s->twin, block, key, value);
        iqn_set_block(s->scaled, block, key, value);
        REQUIRE(iqn_set_block(NULL, block, key, value) < 0);
        if (status >= 0) REQUIRE(block < 0 ? block == -1 : fuzz_same(iqn_get_block(s->q, block, key), value) || value == 0); /* -0 */
    }
    REQUIRE(status == same);
    if (status < 0) return;
    REQUIRE(fuzz_finite(value));
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
    for (i = 0; i < n; i++) {
        const double x = s->x[i];
        switch (kind) {
        case 0: s->x[i] = i < 40 ? fuzz_double(f) : 1; s->hx[i] = i < 40 ? fuzz_double(f) : 2; break;
        case 1: s->hx[i] = x; break;
        case 2: s->x[i] = i < 40 ? fuzz_unit(f) : 1; s->hx[i] = i < 40 ? fuzz_unit(f) : 2; break;
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
        if (s->hx[i] != 0 && fabs(s->hx[i]) < 1e-60) s->scalable = 0;
        if (s->x[i] != 0 && fabs(s->x[i]) < 1e-60) s->scalable = 0;
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
    if (wild) s->scalable = s->moderate = 0;
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
        for (i = 0; status == IQN_SOLVED && i < s->n; i++) REQUIRE(s->x[i] >= s->hx[i] && s->x[i] <= s->hx[i]);
        REQUIRE(iqn_get(s->q, IQN_RESIDUAL) >= 0);
    } else {
        REQUIRE(fuzz_all_same(s->n, x, s->x));
        if (s->moderate && !s->hooked) REQUIRE(status == IQN_ELENGTH); /* lengths of the blocks do not add up */
    }
    compare(s, s->q, s->twin);
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
    if (fuzz_below(f, 2)) {
        REQUIRE(iqn_commit(s->q) == iqn_commit(s->twin));
        iqn_commit(s->scaled);
    } else {
        REQUIRE(iqn_discard(s->q) == iqn_discard(s->twin));
        iqn_discard(s->scaled);
    }
    REQUIRE(iqn_commit(NULL) < 0 && iqn_discard(NULL) < 0);
    compare(s, s->q, s->twin);
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
        default: step(f, &s);
        }
    free(s.mem);
    free(s.twin_mem);
    free(s.scaled_mem);
    free(s.x);
    free(s.hx);
    free(s.A);
    free(s.b);
}
