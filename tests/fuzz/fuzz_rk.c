/* SPDX-License-Identifier: MIT

   fuzz_rk.c - any sequence of calls of rk.h with any arguments: see fuzz.h for the driver

   The tables are those of the library, generated ones, and ones of random coefficients, NaN among them.  What must hold:
   no call reads or writes outside its arrays (the sanitizers watch), a negative status leaves outputs as they were, sums
   agree with long double sums, RK_NONFINITE is said exactly when it is so, theta = 0 and 1 return the ends bit for bit,
   no defect is NaN, step sizes stay positive and within their limits.                                                    */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "examples/rk_proof.h"

#ifndef FUZZ_COUNT
#    define FUZZ_COUNT 30000
#endif
#include "fuzz.h"

enum { STAGES = 5, TABLES = 39, COUPLINGS = 14 };

typedef struct scene {
    rk_table own, made;
    double number[(STAGES + 1) * (STAGES + 1) * 2 + 8 * STAGES + 64];
    void *mem;
    size_t bytes;
    const rk_table *T;
    int m; /* stages of T, with the extra ones */
    double h;
    ptrdiff_t n, ldk;
    double *y, *k, *out;
    int plain;
    rk_control C;
    int steered; /* C holds the answer of a call */
} scene;

static const char *const methods[] = {"I", "PI", "PID", "", "none"};

static const rk_table *listed(fuzz *f, int most) /* NULL behind the last */
{
    const int i = fuzz_below(f, most);
    return i < TABLES ? rk_tables() + i : NULL;
}

/* ---- tables ---------------------------------------------------------------------------------------------------------- */

static void random_table(fuzz *f, scene *s)
{
    const int wild = fuzz_below(f, 4) == 0, lower = fuzz_below(f, 2);
    rk_table *T = &s->own;
    double *v = s->number;
    int i, j, m;
    memset(T, 0, sizeof *T);
    T->name = "own";
    T->stages = 1 + fuzz_below(f, STAGES);
    T->extra = fuzz_below(f, 4) == 0;
    m = T->stages + T->extra;
    T->order = fuzz_below(f, 4);
    T->order_hat = fuzz_below(f, 3);
    T->powers = fuzz_below(f, 5);
    T->dense_order = fuzz_below(f, 4);
    T->A = v;
    for (i = 0; i < m; i++)
        for (j = 0; j < m; j++) *v++ = lower && j >= i ? 0 : wild ? fuzz_double(f) : fuzz_unit(f);
    T->b = v;
    for (i = 0; i < m; i++) *v++ = i >= T->stages ? 0 : wild ? fuzz_double(f) : 1. / T->stages;
    T->c = v;
    for (i = 0; i < m; i++) *v++ = wild ? fuzz_double(f) : fuzz_unit(f);
    if (fuzz_below(f, 2)) {
        T->bhat = v;
        for (i = 0; i < m; i++) *v++ = wild ? fuzz_double(f) : fuzz_unit(f);
    }
    if (fuzz_below(f, 4)) {
        T->d = v;
        for (i = 0; i < m * T->powers; i++) *v++ = wild ? fuzz_double(f) : fuzz_unit(f);
    }
    switch (fuzz_below(f, 32)) { /* broken in one place */
    case 0: T->A = NULL; break;
    case 1: T->b = NULL; break;
    case 2: T->c = NULL; break;
    case 3: T->stages = -fuzz_below(f, 2); break;
    case 4: T->extra = -1; break;
    case 5: T->stages = INT_MAX; break;
    case 6: T->extra = INT_MAX; break;
    }
}

static void generated_table(fuzz *f, scene *s)
{
    const int family = fuzz_below(f, 8), stages = fuzz_below(f, 8) ? fuzz_below(f, 8) : fuzz_int(f);
    const size_t bytes = rk_collocation_size(stages);
    rk_table T;
    int status;
    memset(&T, 0x5a, sizeof T);
    free(s->mem);
    s->mem = malloc(bytes + 8);
    REQUIRE(s->mem != NULL);
    if (bytes > 0) {
        REQUIRE(rk_collocation(&T, family, stages, s->mem, bytes - 1) < 0);
        REQUIRE(rk_collocation(&T, family, stages, (char *)s->mem + 1 + fuzz_below(f, 7), bytes) < 0);
        REQUIRE(rk_collocation(&T, family, stages, NULL, bytes) < 0 && rk_collocation(NULL, family, stages, s->mem, bytes) < 0);
        REQUIRE(((unsigned char *)&T)[0] == 0x5a && ((unsigned char *)&T)[sizeof T - 1] == 0x5a);
    }
    s->mem = realloc(s->mem, bytes + (bytes == 0));
    REQUIRE(s->mem != NULL);
    status = rk_collocation(&T, family, stages, s->mem, bytes);
    memset(&s->made, 0, sizeof s->made);
    if (status < 0) {
        REQUIRE(((unsigned char *)&T)[0] == 0x5a && ((unsigned char *)&T)[sizeof T - 1] == 0x5a);
        s->T = rk_tables();
        return;
    }
    REQUIRE(T.stages == stages && T.extra == 0);
    s->made = T;
    s->T = &s->made;
    REQUIRE(rk_check(s->T, NULL) >= 0);
}

static void extended_table(fuzz *f, scene *s)
{
    const int order = fuzz_below(f, 8) ? fuzz_below(f, 7) : fuzz_int(f), extra = fuzz_below(f, 8) ? fuzz_below(f, 3) : fuzz_int(f);
    const rk_table *T = fuzz_below(f, 3) ? listed(f, 12) : &s->own;
    const size_t bytes = T && extra >= 0 && extra < 100 && T->stages < 100 ? rk_extend_size(T->stages + extra, order > 0 ? order : 10) : 0;
    rk_table out;
    void *mem = malloc(bytes + 8);
    int status;
    REQUIRE(mem != NULL);
    memset(&out, 0x5a, sizeof out);
    if (bytes > 0) REQUIRE(rk_extend(&out, T, NULL, order, extra, mem, 0) < 0 && rk_extend(&out, T, NULL, order, extra, NULL, bytes) < 0);
    REQUIRE(rk_extend(NULL, T, NULL, order, extra, mem, bytes) < 0 && rk_extend(&out, NULL, NULL, order, extra, mem, bytes) < 0);
    REQUIRE(bytes == 0 || rk_extend(&out, T, NULL, order, extra, (char *)mem + 1 + fuzz_below(f, 7), bytes) < 0);
    free(mem);
    mem = malloc(bytes + (bytes == 0));
    REQUIRE(mem != NULL);
    status = rk_extend(&out, T, fuzz_below(f, 4) ? NULL : listed(f, 40), order, extra, mem, bytes);
    if (status < 0) {
        REQUIRE(((unsigned char *)&out)[0] == 0x5a && ((unsigned char *)&out)[sizeof out - 1] == 0x5a);
        free(mem);
        return;
    }
    REQUIRE(out.stages + out.extra <= T->stages + T->extra + extra && out.d);
    REQUIRE(rk_check(&out, NULL) != RK_EDENSE);
    free(s->mem);
    s->mem = mem;
    s->made = out;
    s->T = &s->made;
}

static int fits(const rk_table *T)
{
    return T && T->stages >= 1 && T->extra >= 0 && T->stages <= RK_STAGES_MAX - T->extra && T->A && T->b && T->c;
}

static void choose(fuzz *f, scene *s)
{
    switch (fuzz_below(f, 5)) {
    case 0:
    case 1:
        s->T = listed(f, TABLES);
        REQUIRE(rk_find(s->T->name) == s->T);
        break;
    case 2: generated_table(f, s); break;
    case 3: extended_table(f, s); break;
    default: random_table(f, s); s->T = &s->own;
    }
    s->m = fits(s->T) ? s->T->stages + s->T->extra : 1;
}

static void fill(fuzz *f, scene *s)
{
    static const ptrdiff_t block[] = {0, 1, 2, 3, 7, 8, 9, 255, 256, 257, 4095, 4096, 4097, 5, 4, 6};
    const int kind = fuzz_below(f, 64);
    size_t i;
    free(s->y);
    free(s->k);
    free(s->out);
    s->n = kind < 16 ? block[kind] : fuzz_below(f, 10);
    s->ldk = s->n + fuzz_below(f, 3);
    s->plain = fuzz_below(f, 4) > 0;
    s->h = fuzz_below(f, 2) ? fuzz_moderate(f) : fuzz_double(f);
    s->y = fuzz_alloc((size_t)s->n);
    s->k = fuzz_alloc((size_t)(s->ldk * (s->m - 1) + s->n));
    s->out = fuzz_alloc((size_t)(s->n * 2));
    for (i = 0; i < (size_t)s->n; i++) s->y[i] = i >= 40 ? 1 : s->plain ? fuzz_unit(f) : fuzz_double(f);
    for (i = 0; i < (size_t)(s->ldk * (s->m - 1) + s->n); i++) s->k[i] = i >= 200 ? .5 : s->plain ? fuzz_unit(f) : fuzz_double(f);
}

static rk_step step_of(const rk_table *T, double h, ptrdiff_t n, const double *y, const double *k, ptrdiff_t ldk)
{
    rk_step d;
    d.T = T;
    d.h = h;
    d.n = n;
    d.y = y;
    d.k = k;
    d.ldk = ldk;
    return d;
}

/* ---- sums ------------------------------------------------------------------------------------------------------------ */

/* out against y + h sum w_j k_j in long double, and the remark against the bits of out. */
static void check_sum(const scene *s, int status, const double *y, double h, int terms, const double *w, const double *out)
{
    int bad = 0, j;
    ptrdiff_t i;
    for (i = 0; i < s->n; i++) {
        long double exact = y ? (long double)y[i] : 0, size = fabsl(exact);
        for (j = 0; j < terms; j++) {
            const long double term = (long double)h * (long double)w[j] * (long double)s->k[j * s->ldk + i];
            exact += term;
            size += fabsl(term);
        }
        if (!fuzz_finite(out[i])) bad = 1;
        if (s->plain && size < 1e300L && size > 1e-290L) /* false also where a weight is not finite */
            REQUIRE(fabsl((long double)out[i] - exact) <= 1e-14L * size);
    }
    if (status == RK_NONFINITE) REQUIRE(bad);
    if (status >= 0 && bad) REQUIRE(status == RK_NONFINITE);
}

static void stage(fuzz *f, scene *s)
{
    const rk_table *T = s->T;
    const int i = fuzz_below(f, 16) ? fuzz_below(f, s->m) : fuzz_int(f);
    double *z = (double *)fuzz_copy(s->y, (size_t)s->n * sizeof *z), *all;
    const int status = rk_stage(T, i, s->h, s->n, s->y, s->k, s->ldk, s->out);
    const int same = rk_stage(T, i, s->h, s->n, z, s->k, s->ldk, z);
    int l;
    REQUIRE(status == same);
    if (!fits(T) || i < 0 || i >= s->m || !fuzz_finite(s->h)) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, s->out) && fuzz_all_same(s->n, z, s->y));
    else {
        REQUIRE(fuzz_all_same(s->n, z, s->out));
        check_sum(s, status, s->y, s->h, i, T->A + i * s->m, s->out);
    }
    free(z);
    if (!fits(T)) return;
    all = fuzz_alloc((size_t)((s->n + 1) * (T->stages - 1) + s->n));
    l = rk_stages(T, s->h, s->n, s->y, s->k, s->ldk, all, s->n + 1);
    if (l < 0) REQUIRE(fuzz_untouched((size_t)((s->n + 1) * (T->stages - 1) + s->n), all));
    else
        for (l = 0; l < T->stages; l++) check_sum(s, RK_OK - 1, s->y, s->h, s->m, T->A + l * s->m, all + l * (s->n + 1));
    free(all);
}

/* rk_combine with good arguments, and with any of them spoiled. */
static void combine(fuzz *f, scene *s)
{
    const int spoil = fuzz_below(f, 10), terms = fuzz_below(f, s->m + 1);
    const double h = spoil == 1 ? fuzz_of_bits((uint64_t)0x7ff << 52) : fuzz_finite(s->h) ? s->h : 1;
    double w[RK_STAGES_MAX];
    int status, j;
    for (j = 0; j < RK_STAGES_MAX; j++) w[j] = j < s->m && s->plain ? fuzz_unit(f) : fuzz_double(f);
    status = rk_combine(h, spoil == 3 ? -1 : spoil == 4 ? RK_STAGES_MAX + 1 : terms, spoil == 5 ? NULL : w, spoil == 2 ? -1 : s->n,
                        fuzz_below(f, 2) ? s->y : NULL, spoil == 6 ? NULL : s->k, spoil == 7 ? s->n - 1 : s->ldk,
                        spoil == 8 ? NULL : s->out);
    if (spoil >= 1 && spoil <= 4) REQUIRE(status < 0);
    if (spoil == 5 && terms > 0) REQUIRE(status < 0);
    if (spoil >= 6 && spoil <= 7 && terms > 0 && s->n > 0) REQUIRE(status < 0);
    if (spoil == 8 && s->n > 0) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, s->out));
}

static void finish(scene *s)
{
    const rk_table *T = s->T;
    double *z = (double *)fuzz_copy(s->y, (size_t)s->n * sizeof *z), *err = fuzz_alloc((size_t)s->n), e[RK_STAGES_MAX];
    const int status = rk_update(T, s->h, s->n, s->y, s->k, s->ldk, s->out, NULL);
    const int same = rk_update(T, s->h, s->n, z, s->k, s->ldk, z, NULL);
    int both, j;
    REQUIRE(status == same);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->n, s->out) && fuzz_all_same(s->n, z, s->y));
    else {
        REQUIRE(fuzz_all_same(s->n, z, s->out));
        check_sum(s, status, s->y, s->h, T->stages, T->b, s->out);
        both = rk_update(T, s->h, s->n, s->y, s->k, s->ldk, z, err);
        if (both < 0) REQUIRE(fuzz_untouched((size_t)s->n, err) && fuzz_all_same(s->n, z, s->out));
        else {
            REQUIRE(fuzz_all_same(s->n, z, s->out) && T->bhat);
            for (j = 0; j < T->stages; j++) e[j] = T->e ? T->e[j] : T->b[j] - T->bhat[j];
            check_sum(s, RK_OK - 1, NULL, s->h, T->stages, e, err);
        }
    }
    free(z);
    free(err);
}

static void dense(fuzz *f, scene *s)
{
    const rk_table *T = s->T;
    const int deriv = fuzz_below(f, 3) ? fuzz_below(f, 3) : fuzz_int(f), count = fuzz_below(f, 4);
    double theta[4], *w = fuzz_alloc((size_t)s->m), *many, *end = fuzz_alloc((size_t)s->n);
    rk_step done;
    int status, same, l;
    for (l = 0; l < 4; l++) theta[l] = fuzz_below(f, 4) ? fabs(fuzz_unit(f)) : fuzz_below(f, 2) ? fuzz_below(f, 2) : fuzz_double(f);
    status = rk_weights(T, theta[0], deriv, w);
    if (!fits(T) || !T->d || T->powers < 1 || deriv < 0 || !fuzz_finite(theta[0])) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)s->m, w));
    if (fits(T)) REQUIRE(rk_weights(T, theta[0], 0, NULL) < 0);
    done = step_of(T, s->h, s->n, s->y, s->k, s->ldk);
    same = rk_dense(&done, theta[0], deriv, s->out);
    if (same < 0) REQUIRE(fuzz_untouched((size_t)s->n, s->out));
    if (status < 0) REQUIRE(same < 0);
    if (same >= 0) {
        if (deriv == 0) check_sum(s, same == RK_EXTRAP ? RK_OK : same, s->y, s->h, s->m, w, s->out);
        else if (deriv == 1) check_sum(s, same == RK_EXTRAP ? RK_OK : same, NULL, 1, s->m, w, s->out);
        if (same != RK_NONFINITE) REQUIRE(same == status);
        if (deriv == 0 && theta[0] >= 1 && theta[0] <= 1 && same != RK_NONFINITE && rk_update(T, s->h, s->n, s->y, s->k, s->ldk, end, NULL) >= 0)
            REQUIRE(fuzz_all_same(s->n, end, s->out));
        if (deriv == 0 && theta[0] >= 0 && theta[0] <= 0 && same != RK_NONFINITE) REQUIRE(fuzz_all_same(s->n, s->y, s->out));
        many = fuzz_alloc((size_t)((s->n + 1) * 4));
        l = rk_dense_many(&done, deriv, count, theta, many, s->n + 1);
        if (l < 0) REQUIRE(fuzz_untouched((size_t)((s->n + 1) * 4), many));
        else if (count > 0) REQUIRE(fuzz_all_same(s->n, many, s->out));
        free(many);
    }
    free(w);
    free(end);
}

static void null_arguments(scene *s)
{
    const rk_table *T = rk_tables();
    double v[8] = {1, 2, 3, 4, 5, 6, 7, 8}, out[8];
    const rk_step good = step_of(T, 1, 1, v, v, 1), no_table = step_of(NULL, 1, 1, v, v, 1), no_y = step_of(T, 1, 1, NULL, v, 1);
    const rk_step no_k = step_of(T, 1, 1, v, NULL, 1);
    memcpy(out, v, sizeof out);
    REQUIRE(rk_stage(NULL, 0, 1, 1, v, v, 1, out) < 0 && rk_stage(T, 0, 1, 1, NULL, v, 1, out) < 0);
    REQUIRE(rk_stage(T, 0, 1, 1, v, v, 1, NULL) < 0 && rk_stage(T, 0, 1, -1, v, v, 1, out) < 0);
    REQUIRE(rk_stages(NULL, 1, 1, v, v, 1, out, 1) < 0 && rk_stages(T, 1, 2, v, v, 2, out, 1) < 0);
    REQUIRE(rk_update(NULL, 1, 1, v, v, 1, out, NULL) < 0 && rk_update(T, 1, 1, v, NULL, 1, out, NULL) < 0);
    REQUIRE(rk_update(T, 1, 1, v, v, 1, out, out + 1) < 0 && rk_update(T, 1, 2, v, v, 1, out, NULL) < 0);
    REQUIRE(rk_dense(NULL, 0, 0, out) < 0 && rk_dense(&no_table, 0, 0, out) < 0 && rk_dense(&no_y, 0, 0, out) < 0);
    REQUIRE(rk_dense(&no_k, 0, 0, out) < 0 && rk_dense(&good, 0, 0, NULL) < 0);
    REQUIRE(rk_dense_many(&good, 0, -1, v, out, 1) < 0 && rk_dense_many(&good, 0, 1, NULL, out, 1) < 0);
    REQUIRE(rk_dense_many(NULL, 0, 1, v, out, 1) < 0 && rk_dense_many(&good, 0, 1, v, out, 0) < 0);
    REQUIRE(rk_check(NULL, NULL) < 0 && rk_check_imex(T, NULL, NULL) < 0 && rk_check_imex(NULL, T, NULL) < 0);
    REQUIRE(rk_check_coupling(NULL, NULL) < 0 && rk_mis(NULL, T, RK_FROM_LAST, out, sizeof out) < 0);
    REQUIRE(rk_control_make(NULL, "I", T) < 0 && rk_control_make(&s->C, NULL, T) < 0 && rk_control_make(&s->C, "I", NULL) < 0);
    REQUIRE(rk_norm(1, 1, NULL, 1, NULL, v, NULL, out) < 0 && rk_norm(1, 1, NULL, -1, v, v, NULL, out) < 0);
    REQUIRE(rk_norm(1, 1, NULL, 1, v, v, NULL, NULL) < 0 && rk_norm(1, 1, NULL, 1, v, NULL, v, out) < 0);
    REQUIRE(rk_combine(1, 1, NULL, 1, v, v, 1, out) < 0 && rk_combine(1, 1, v, 1, v, v, 1, NULL) < 0);
    REQUIRE(rk_find(NULL) == NULL && rk_find("") == NULL && !rk_tables()[TABLES].name);
    REQUIRE(fuzz_is_nan(rk_defect(NULL, NULL, RK_OF_STEP, 1)) && fuzz_is_nan(rk_rms(NULL)));
    REQUIRE(fuzz_is_nan(rk_defect(NULL, T, 0, 1)) && fuzz_is_nan(rk_defect(T, NULL, 7, 1)));
    REQUIRE(rk_coupling_find(NULL) == NULL && !rk_couplings()[COUPLINGS].name);
    REQUIRE(memcmp(out, v, sizeof out) == 0);
}

/* ---- properties, control --------------------------------------------------------------------------------------------- */

static void properties(fuzz *f, scene *s)
{
    const int order = fuzz_below(f, 8) ? fuzz_below(f, 5) : fuzz_int(f), cheap = s->m <= 8 && (order < 6 || order > RK_ORDER_MAX);
    double d, before;
    int status;
    if (cheap) {
        d = rk_defect(s->T, NULL, fuzz_below(f, 5) - 1, order);
        REQUIRE(d >= 0 || fuzz_is_nan(d));
        if (fits(s->T) && order >= 1 && order < 6) REQUIRE(rk_defect(s->T, NULL, RK_OF_STEP, order) >= 0);
        d = rk_defect(s->T, rk_tables(), fuzz_below(f, 5) - 1, order > 3 ? 3 : order);
        REQUIRE(d >= 0 || fuzz_is_nan(d));
        before = d = 7;
        status = rk_check(s->T, &d);
        REQUIRE(!fuzz_same(d, before) && !fuzz_is_nan(d));
        REQUIRE((status >= 0) == (d <= 0));
        status = rk_check_imex(s->T, listed(f, 40), &d);
        REQUIRE(status < 0 || d <= 0);
    }
    for (status = 0; status < 6; status++) (void)rk_is(s->T, status);
    (void)rk_is(s->T, fuzz_int(f));
    (void)rk_is(NULL, RK_FSAL);
    if (cheap && order < 4 && fits(s->T)) { /* both parts of an additive method are this table */
        const int parts = fuzz_below(f, 6), size[4] = {s->m, s->m, s->m, fuzz_below(f, 8) ? s->m : 0};
        const double *A[16], *b[4];
        int i;
        for (i = 0; i < 16; i++) A[i] = fuzz_below(f, 64) ? s->T->A : NULL;
        for (i = 0; i < 4; i++) b[i] = fuzz_below(f, 16) ? s->T->b : NULL;
        d = rk_defect_gark(order, parts, size, A, b);
        REQUIRE(d >= 0 || fuzz_is_nan(d));
        if (parts < 1 || parts > 4 || order < 1) REQUIRE(fuzz_is_nan(d));
    }
    if (fits(s->T) && s->m <= 8) { /* a multirate method from it, in exactly the memory asked for */
        const size_t bytes = rk_mis_size(s->T->stages);
        void *mem = malloc(bytes);
        rk_coupling C;
        REQUIRE(mem != NULL);
        status = rk_mis(&C, s->T, fuzz_below(f, 8) ? RK_FROM_LAST + 3 * fuzz_below(f, 2) : fuzz_int(f), mem, bytes);
        if (status >= 0) {
            REQUIRE(C.stages == s->T->stages + 1 && C.order <= s->T->order && C.order_hat <= s->T->order_hat);
            if (rk_check(s->T, NULL) >= 0) REQUIRE(rk_check_coupling(&C, NULL) == RK_OK); /* it states what T has */
        }
        REQUIRE(rk_mis(&C, s->T, RK_FROM_LAST, mem, bytes - 1) < 0);
        free(mem);
    }
}

static void norms(fuzz *f, scene *s)
{
    double sum[3] = {0, 0, 0}, keep[2], rms;
    const double rtol = fuzz_below(f, 2) ? 1e-3 : fuzz_double(f), atol = fuzz_below(f, 2) ? 1e-6 : fuzz_double(f);
    const double *size = fuzz_below(f, 4) ? NULL : s->y;
    const int status = rk_norm(rtol, atol, size, s->n, s->k, s->y, fuzz_below(f, 2) ? s->y : NULL, sum);
    int i, finite = 1;
    memset(keep, 0, sizeof keep);
    if (!fuzz_finite(rtol) || !fuzz_finite(atol) || rtol < 0 || atol < 0) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_all_same(2, sum, keep));
    rms = rk_rms(sum);
    REQUIRE(rms >= 0);
    for (i = 0; i < (int)s->n; i++) finite &= fuzz_finite(s->k[i]);
    if (status >= 0 && !finite) REQUIRE(!fuzz_finite(rms));
    if (status >= 0 && s->plain && atol >= 1e-6 && !size) REQUIRE(fuzz_finite(rms));
    for (i = 0; i < 3; i++) sum[i] = fabs(fuzz_double(f));
    rms = rk_rms(sum);
    REQUIRE(!fuzz_is_nan(rms));
    rms = rk_first_step(fuzz_int(f), fuzz_double(f), sum[0], sum[1], sum[2]);
    REQUIRE(fuzz_is_nan(rms) || rms >= 0);
    rms = rk_combined_error(fuzz_double(f), fuzz_double(f));
    REQUIRE(fuzz_is_nan(rms) || rms >= 0);
}

/* A stop time, and the time to ask f at before it. */
static void stop(fuzz *f, scene *s)
{
    const double to = fuzz_below(f, 2) ? fuzz_moderate(f) : fuzz_double(f), c = fuzz_below(f, 8) ? fabs(fuzz_unit(f)) : fuzz_double(f);
    const double t = fuzz_below(f, 4) ? fuzz_moderate(f) : fuzz_double(f), h = fuzz_below(f, 4) ? fuzz_unit(f) : fuzz_double(f);
    const rk_control before = s->C;
    double next = h, asked;
    volatile double end, time;
    const int status = rk_control_stop(&s->C, to, t, &next);
    REQUIRE(rk_control_stop(NULL, to, t, &next) < 0 && rk_control_stop(&s->C, to, t, NULL) < 0);
    if (status < 0) {
        REQUIRE(fuzz_same(next, h) && memcmp(&before, &s->C, sizeof before) == 0);
        return;
    }
    REQUIRE(fuzz_finite(next) && (next > 0) == (h > 0));
    REQUIRE((status == RK_PASSED) == (fuzz_finite(to) && !(h > 0 ? to > t : to < t)));
    end = t + next, time = t + c * next, asked = rk_time(&s->C, c, t, next);
    REQUIRE(fuzz_finite(asked) == fuzz_finite(time) || fabs(t) > 1e300 || fabs(next) > 1e300);
    if (status != RK_OK || !fuzz_finite(to) || !fuzz_finite(to - t)) return;
    REQUIRE(h > 0 ? end <= to : end >= to);
    if (c >= 0 && c <= 1 && fabs(next) > 1e-300) REQUIRE(h > 0 ? asked <= to : asked >= to);
}

static void control(fuzz *f, scene *s)
{
    const double error = fuzz_below(f, 2) ? fabs(fuzz_moderate(f)) : fuzz_double(f);
    const double t = fuzz_below(f, 2) ? fuzz_moderate(f) : fuzz_double(f), h = fuzz_below(f, 2) ? fabs(fuzz_unit(f)) : fuzz_double(f);
    const rk_table *T = fuzz_below(f, 4) ? rk_find("bs3") : fuzz_below(f, 2) ? s->T : NULL;
    rk_control before = s->C;
    double now = t, next = h;
    volatile double end;
    int status, i;
    if (!s->steered || fuzz_below(f, 8) == 0) {
        status = rk_control_make(&s->C, methods[fuzz_below(f, (int)(sizeof methods / sizeof *methods))], T);
        if (status < 0) REQUIRE(memcmp(&before, &s->C, sizeof before) == 0);
        else s->steered = 1;
        if (status >= 0 && fuzz_below(f, 2)) s->C.stop = fuzz_moderate(f);
        for (i = 0; status >= 0 && i < 5; i++)
            if (fuzz_below(f, 8) == 0) s->C.k[i] = fuzz_unit(f);
        if (status >= 0 && fuzz_below(f, 8) == 0) s->C.smallest = fabs(fuzz_unit(f)), s->C.largest = 1 + s->C.smallest;
        return;
    }
    status = rk_control_step(&s->C, error, &now, &next);
    REQUIRE(rk_control_step(NULL, error, &now, &next) < 0 && rk_control_step(&before, error, NULL, &next) < 0);
    REQUIRE(rk_control_step(&before, error, &now, NULL) < 0);
    if (status < 0) {
        REQUIRE(fuzz_same(now, t) && fuzz_same(next, h) && memcmp(&before, &s->C, sizeof before) == 0);
        return;
    }
    REQUIRE(fuzz_finite(next) && (next > 0) == (h > 0) && fabs(next) > 0);
    if (!fuzz_finite(error)) REQUIRE(status == RK_REJECT);
    if (status == RK_REJECT) REQUIRE(fuzz_same(now, t));
    if (s->C.smallest > 0 || fuzz_finite(s->C.stop)) return; /* these two have the last word */
    REQUIRE(fabs(next) >= fabs(h) * s->C.shrink * (1 - 1e-12) - DBL_EPSILON * fabs(now) || fabs(next) < 1e-300);
    if (status == RK_REJECT) REQUIRE(fabs(next) < fabs(h) || fabs(h) < 1e-300);
    if (fuzz_finite(now)) REQUIRE(now + next > now || now + next < now);
    end = now + next;
    if (fuzz_finite(end)) REQUIRE(fabs(end - now - next) <= DBL_EPSILON * fabs(next)); /* t moves by h */
}

static void couplings(fuzz *f)
{
    const rk_coupling *C = rk_couplings() + fuzz_below(f, COUPLINGS);
    double *w, v;
    size_t room;
    int i, status;
    REQUIRE(rk_coupling_find(C->name) == C && C->stages > 0);
    room = (size_t)C->stages * RK_ORDER_MAX;
    w = fuzz_alloc(room);
    i = fuzz_below(f, 2) ? fuzz_below(f, C->stages + 1) : fuzz_int(f);
    status = rk_coupling_forcing(C, i, w);
    if (i < 0 || i > C->stages) REQUIRE(status < 0);
    if (status < 0) REQUIRE(fuzz_untouched(room, w));
    else REQUIRE(status <= RK_ORDER_MAX);
    REQUIRE(rk_coupling_forcing(NULL, i, w) < 0 && rk_coupling_forcing(C, 1, NULL) < 0);
    free(w);
    w = fuzz_alloc((size_t)C->stages);
    status = rk_coupling_jump(C, i, w);
    if (status < 0) REQUIRE(fuzz_untouched((size_t)C->stages, w));
    REQUIRE(rk_coupling_jump(NULL, i, w) < 0 && rk_coupling_jump(C, 1, NULL) < 0);
    REQUIRE(rk_coupling_from(C, i) < C->stages);
    (void)rk_coupling_from(NULL, i);
    v = rk_coupling_time(C, i);
    (void)v;
    (void)rk_coupling_time(NULL, i);
    if (C->stages < 6) {
        v = rk_defect_coupling(C, fuzz_below(f, 2), fuzz_below(f, 3));
        REQUIRE(v >= 0 || fuzz_is_nan(v));
    }
    REQUIRE(fuzz_is_nan(rk_defect_coupling(NULL, 0, 1)));
    free(w);
}

/* A coupling of random numbers and fields: refused, or used within its arrays. */
static void own_coupling(fuzz *f)
{
    enum { MOST = 5, POWERS = 2 };
    double c[MOST], W[POWERS * MOST * MOST], G[MOST * MOST], w[RK_ORDER_MAX * MOST];
    signed char groups[MOST + 1] = {0};
    rk_coupling C;
    int i, status;
    for (i = 0; i < MOST; i++) c[i] = fuzz_below(f, 8) ? fuzz_unit(f) : fuzz_double(f);
    for (i = 0; i < POWERS * MOST * MOST; i++) W[i] = i % 3 ? fuzz_unit(f) : 0;
    for (i = 0; i < MOST * MOST; i++) G[i] = i % 3 ? fuzz_unit(f) : 0;
    for (i = 0; i < MOST; i++) groups[i] = (signed char)(fuzz_below(f, 16) ? fuzz_below(f, 3) : fuzz_below(f, 256) - 128);
    memset(&C, 0, sizeof C);
    C.name = "own";
    C.form = fuzz_below(f, 4);
    C.stages = fuzz_below(f, 8) ? fuzz_below(f, MOST + 1) : -1;
    C.powers = fuzz_below(f, POWERS + 1);
    C.c = fuzz_below(f, 16) ? c : NULL;
    C.W = fuzz_below(f, 16) ? W : NULL;
    C.G = fuzz_below(f, 16) ? G : NULL;
    C.groups = fuzz_below(f, 16) ? groups : NULL;
    i = fuzz_below(f, MOST + 2);
    memset(w, 0, sizeof w);
    status = rk_coupling_forcing(&C, i, w);
    REQUIRE(status <= RK_ORDER_MAX && (status < 0) == (rk_coupling_from(&C, i) < 0));
    if (i < 1 || i > C.stages) REQUIRE(status < 0);
    REQUIRE((rk_coupling_jump(&C, i, w) < 0) == (status < 0));
    (void)rk_coupling_time(&C, i);
    if (rk_check_coupling(&C, NULL) != RK_ENULL) (void)rk_defect_coupling(&C, fuzz_below(f, 2), 1 + fuzz_below(f, 3));
}

static void scalars(fuzz *f)
{
    const char *message = rk_message(fuzz_below(f, 2) ? fuzz_int(f) : fuzz_below(f, 2) ? 250 + fuzz_below(f, 100) : -250 - fuzz_below(f, 100));
    const int stages = fuzz_int(f), order = fuzz_int(f);
    REQUIRE(message && message[0] && rk_linked_version() == RK_VERSION);
    if (stages < 1 || order < 0) REQUIRE(rk_extend_size(stages, order) == 0);
}

static void fuzz_one(fuzz *f)
{
    scene s;
    memset(&s, 0, sizeof s);
    random_table(f, &s);
    choose(f, &s);
    fill(f, &s);
    while (fuzz_more(f)) {
        ptrdiff_t i;
        for (i = 0; i < 2 * s.n; i++) s.out[i] = fuzz_of_bits(FUZZ_PATTERN + (uint64_t)i);
        switch (fuzz_below(f, 16)) {
        case 0: choose(f, &s); fill(f, &s); break;
        case 1: fill(f, &s); break;
        case 2: null_arguments(&s); break;
        case 3: properties(f, &s); break;
        case 4: norms(f, &s); break;
        case 5: case 6: control(f, &s); break;
        case 7:
            if (s.steered) stop(f, &s);
            break;
        case 8: if (fuzz_below(f, 2)) couplings(f); else own_coupling(f); break;
        case 9: scalars(f); break;
        case 10: case 11: stage(f, &s); break;
        case 12: if (fuzz_below(f, 2)) finish(&s); else combine(f, &s); break;
        default: dense(f, &s);
        }
    }
    free(s.mem);
    free(s.y);
    free(s.k);
    free(s.out);
}
