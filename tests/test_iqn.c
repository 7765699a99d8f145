/* SPDX-License-Identifier: MIT

   test_iqn.c - iqn.h against published numbers, Householder QR by LAPACK, and the rows of its list of extremes */
#ifdef __FAST_MATH__
#    define FAST_HOST 1 /* asked before the header's own options of compilation, which gcc leaves in the macro */
#endif
enum { PROCESSORS = 3 };
static int old_processor; /* 1: as if there were no AVX-512; 2: neither AVX2 nor FMA */
#if defined(__GNUC__) && defined(__x86_64__)
#    define __builtin_cpu_supports(name) (old_processor < (name[3] == '5' ? 1 : 2) && __builtin_cpu_supports(name))
#endif
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include "check.h"
#include <limits.h>
#include <pthread.h>
#ifdef __SANITIZE_ADDRESS__
#    include <sanitizer/asan_interface.h>
#else
#    define ASAN_POISON_MEMORY_REGION(start, bytes) ((void)(start))
#    define ASAN_UNPOISON_MEMORY_REGION(start, bytes) ((void)(start))
#endif

extern void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
                   const int *ldb, double *work, const int *lwork, int *info, size_t);

static iqn *make(void **mem, ptrdiff_t n, int columns, int blocks)
{
    size_t bytes = iqn_size(n, columns, blocks);
    iqn *q = NULL;
    CHECK(bytes > 0);
    *mem = malloc(bytes);
    CHECK(*mem);
    CHECK_INT(iqn_make(&q, n, columns, blocks, *mem, bytes), IQN_OK);
    return q;
}

/* The accelerator of the textbooks: every pair in full, but for numerically dependent ones; no step is withdrawn. */
static void textbook(iqn *q)
{
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-16), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_GROWTH, 0), IQN_OK);
}

static double random_number(unsigned long long *state) /* in [-1, 1), the same everywhere */
{
    *state = *state * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

static double distance(int n, const double *a, const double *b) /* max |a - b|; b may be NULL */
{
    double most = 0;
    int i;
    for (i = 0; i < n; i++)
        if (!(fabs(a[i] - (b ? b[i] : 0)) <= most)) most = fabs(a[i] - (b ? b[i] : 0));
    return most;
}

/* ---- every array apart, between fences ---- */

/* The arrays of the view in the order of memory */
static const size_t fields[] = {
    offsetof(iqn__view, block),      offsetof(iqn__view, gram),   offsetof(iqn__view, Vr),      offsetof(iqn__view, sums),
    offsetof(iqn__view, S),          offsetof(iqn__view, Lh),     offsetof(iqn__view, Ll),      offsetof(iqn__view, ah),
    offsetof(iqn__view, al),         offsetof(iqn__view, y),      offsetof(iqn__view, message),    offsetof(iqn__view, coefficient),
    offsetof(iqn__view, size),       offsetof(iqn__view, drift),  offsetof(iqn__view, curvature), offsetof(iqn__view, apart),
    offsetof(iqn__view, noise),      offsetof(iqn__view, doubt),  offsetof(iqn__view, inverse_row),   offsetof(iqn__view, inherited),
    offsetof(iqn__view, order),      offsetof(iqn__view, exponent), offsetof(iqn__view, v_bound), offsetof(iqn__view, window),
    offsetof(iqn__view, dropped),    offsetof(iqn__view, kept),   offsetof(iqn__view, assembled), offsetof(iqn__view, r),
    offsetof(iqn__view, v),          offsetof(iqn__view, d),      offsetof(iqn__view, product), offsetof(iqn__view, V),
    offsetof(iqn__view, W)};
enum { FIELDS = sizeof fields / sizeof *fields, FENCE = 1024, FENCE_BYTE = 0x5a }; /* doubles of 1e127, ints of 1e9 */
typedef struct fenced {
    iqn__view there, apart; /* the arrays in the object, and their copies between fences */
    size_t bytes[FIELDS];
} fenced;

static char *array_of(const iqn__view *m, int i)
{
    char *p;
    memcpy(&p, (const char *)m + fields[i], sizeof p);
    return p;
}

static fenced fence(const iqn *q)
{
    fenced f;
    int i;
    f.there = f.apart = iqn__open(q);
    for (i = 0; i < FIELDS; i++) {
        const char *end = i + 1 < FIELDS ? array_of(&f.there, i + 1) : (const char *)q + iqn_size(q->n, q->columns, q->blocks);
        char *p;
        f.bytes[i] = (size_t)(end - array_of(&f.there, i));
        p = (char *)malloc(f.bytes[i] + 2 * FENCE);
        CHECK(p);
        memset(p, FENCE_BYTE, f.bytes[i] + 2 * FENCE);
        p += FENCE;
        memcpy(p, array_of(&f.there, i), f.bytes[i]);
        memcpy((char *)&f.apart + fields[i], &p, sizeof p);
        ASAN_POISON_MEMORY_REGION(p - FENCE, FENCE);
        ASAN_POISON_MEMORY_REGION(p + f.bytes[i], FENCE);
    }
    return f;
}

static void take_down(fenced *f)
{
    int i, k;
    for (i = 0; i < FIELDS; i++) {
        char *p = array_of(&f->apart, i), *end = p + f->bytes[i];
        ASAN_UNPOISON_MEMORY_REGION(p - FENCE, f->bytes[i] + 2 * FENCE);
        for (k = 0; k < FENCE; k++) CHECK(p[k - FENCE] == FENCE_BYTE && end[k] == FENCE_BYTE);
        memcpy(array_of(&f->there, i), p, f->bytes[i]);
        free(p - FENCE);
    }
}

static int fenced_step(iqn *q, double *x, const double *hx, const double *product)
{
    fenced f = fence(q);
    const int status = iqn__step(q, f.apart, x, hx, product);
    take_down(&f);
    return status;
}

static int fenced_push(iqn *q, const double *v, const double *w, const double *product)
{
    fenced f = fence(q);
    const int status = iqn__push(q, f.apart, v, w, product);
    take_down(&f);
    return status;
}

/* ---- published numbers ---- */

/* preCICE 3, AccelerationSerialTest: two fields in one vector; the second call comes with the old iterate, unchanged. */
static void test_two_updates_of_the_serial_acceleration_test(void **state)
{
    static const double start[8] = {1, 1, 1, 1, .2, .2, .2, .2}, first[8] = {1, 2, 3, 4, .1, .1, .1, .1};
    static const double second[8] = {10, 10, 10, 10, .199, .199, .199, .199};
    static const double relaxed[8] = {1, 1.01, 1.02, 1.03, .199, .199, .199, .199};
    static const double expected[8] = {-0.56340134092969, 0.61030991917360,  1.78402117927691,  2.95773243938021,
                                       0.0828025852497734, 0.0828025852497734, 0.0828025852497734, 0.0828025852497734};
    (void)state;
    {
        void *mem;
        iqn *q = make(&mem, 8, 10, 2);
        double x[8];
        CHECK_INT(iqn_set(q, IQN_OMEGA, 0.01), IQN_OK);
        memcpy(x, start, sizeof x);
        CHECK_INT(iqn_step(q, x, first), IQN_RELAXED);
        CHECK_NEAR(distance(8, x, relaxed), 0, 1e-15);
        memcpy(x, start, sizeof x);
        CHECK_INT(iqn_step(q, x, second), IQN_OK);
        CHECK_NEAR(distance(8, x, expected), 0, 1e-12);
        free(mem);
    }
}

static void test_aitken_of_the_serial_acceleration_test(void **state)
{
    static const double start[8] = {1, 2, 3, 4, .2, .2, .2, .2}, first[8] = {3.5, 2, 2, 1, .1, .1, .1, .1};
    static const double second[8] = {10, 10, 10, 10, .16, .16, .16, .16}, relaxed[8] = {2, 2, 2.6, 2.8, .16, .16, .16, .16};
    double h[8]; /* the published residuals: there the second call comes with the old iterate, here with the relaxed one */
    int i;
    static const double expected[8] = {1.2689851805508461, 2.2390979382674185,  3.2092106959839914,  4.1793234537005644,
                                       0.19880451030866292, 0.19880451030866292, 0.19880451030866292, 0.19880451030866292};
    void *mem;
    iqn *q = make(&mem, 8, 0, 1);
    double x[8];
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 0.4), IQN_OK);
    memcpy(x, start, sizeof x);
    CHECK_INT(iqn_step(q, x, first), IQN_RELAXED);
    CHECK_NEAR(distance(8, x, relaxed), 0, 1e-15);
    for (i = 0; i < 8; i++) h[i] = x[i] + (second[i] - start[i]);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    for (i = 0; i < 8; i++) x[i] += start[i] - relaxed[i];
    CHECK_NEAR(distance(8, x, expected), 0, 1e-15);
    free(mem);
}

/* Four nonlinear equations as a fixed point, from 0 to (-2, 0, -2, -2), relative limit 1e-7, in 5 to 20 iterations. */
static void test_four_equations(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 10, 1);
    double x[4] = {0, 0, 0, 0}, h[4];
    const double expected[4] = {-2, 0, -2, -2}; /* of eight solutions, the one that the published method finds */
    (void)state;
    CHECK_INT(iqn_set(q, IQN_GROWTH, 0), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-7), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MAX_ITERATIONS, 100), IQN_OK);
    do {
        h[0] = 2 * x[0] * x[0] - x[1] * x[2] - 8 + x[0];
        h[1] = x[0] * x[0] * x[1] + 2 * x[0] * x[1] * x[2] + x[1] * x[2] * x[2] + x[1] + x[1];
        h[2] = x[2] * x[2] - 4 + x[2];
        h[3] = x[3] * x[3] - 4 + x[3];
        CHECK(iqn_step(q, x, h) >= 0);
    } while (!iqn_converged(q));
    CHECK_INT(iqn_converged(q), 1);
    CHECK(iqn_get(q, IQN_ITERATIONS) >= 5 && iqn_get(q, IQN_ITERATIONS) <= 20);
    CHECK_NEAR(distance(4, x, expected), 0, 1e-6);
    free(mem);
}

/* SUNDIALS kinAnalytic_fp: counts and errors of the returned iterate, plain and with depth 2. */
static void test_three_equations_of_kinsol(void **state)
{
    static const double error[2][3] = {{6.91114e-12, 4.48202e-07, 3.07455e-07}, {1.78138e-10, 3.94722e-09, 6.5144e-10}};
    const double pi = 3.14159265358979323846, exact[3] = {0.5, 1, -pi / 6};
    int i, k, m;
    (void)state;
    for (k = 0; k < 2; k++) {
        void *mem;
        iqn *q = make(&mem, 3, 2 * k, 1);
        double x[3] = {.1, .1, -.1}, u[3], h[3];
        CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
        textbook(q);
        m = 0;
        do {
            memcpy(u, x, sizeof u);
            h[0] = cos((x[1] - 1) * x[2]) / 3 + 1. / 6;
            h[1] = sqrt(x[0] * x[0] + sin(x[2]) + 1.06) / 9 + 0.9;
            h[2] = -exp(-x[0] * (x[1] - 1)) / 20 - (10 * pi - 3) / 60;
            CHECK(iqn_step(q, x, h) >= 0);
            m++;
        } while (distance(3, h, u) >= 1.4901161e-06 && m < 20);
        CHECK_INT(m, 5);
        for (i = 0; i < 3; i++) CHECK_NEAR(fabs(u[i] - exact[i]), error[k][i], 2e-5 * error[k][i] + 2e-16);
        free(mem);
    }
}

/* ---- identities ---- */

/* x = A x + b: the n + 2nd evaluation meets the fixed point, whatever the spectrum of A; withdrawn steps come on top, two
   at most.                                                                                                            */
static void test_affine_maps_end_after_n_plus_2_evaluations(void **state)
{
    unsigned long long seed = 1;
    int n, i, j, k, spread, withdraw;
    (void)state;
    for (spread = 1; spread <= 10; spread *= 10)
        for (n = 1, withdraw = 0; n <= 12; n += withdraw, withdraw = !withdraw) {
            void *mem;
            iqn *q = make(&mem, n, n, 1);
            double A[144], b[12], x[12], h[12], scale = 1;
            for (i = 0; i < n * n; i++) A[i] = spread * random_number(&seed);
            for (i = 0; i < n; i++) b[i] = random_number(&seed), x[i] = 0;
            textbook(q);
            CHECK_INT(iqn_set(q, IQN_GROWTH, withdraw ? 10 : 0), IQN_OK);
            for (k = 0; k < n + 2 + (int)iqn_get(q, IQN_NWITHDRAWN); k++) {
                for (i = 0; i < n; i++)
                    for (h[i] = b[i], j = 0; j < n; j++) h[i] += A[i * n + j] * x[j];
                scale = distance(n, x, NULL) + distance(n, h, NULL);
                CHECK(iqn_step(q, x, h) >= 0);
            }
            CHECK_NEAR(iqn_get(q, IQN_RESIDUAL) / scale, 0, 1e-9);
            CHECK(iqn_get(q, IQN_NWITHDRAWN) <= 2 * withdraw);
            free(mem);
        }
}

/* One update of m pairs against the same least squares solved by LAPACK's Householder QR on the host's own differences. */
static void test_update_equals_householder_qr(void **state)
{
    enum { N = 53, M = 9, LW = 4096 };
    static double r[M + 1][N], h[M + 1][N], V[M * N], b[N], work[LW];
    unsigned long long seed = 7;
    int i, k, info, n = N, m = M, one = 1, lw = LW;
    (void)state;
    {
        void *mem;
        iqn *q = make(&mem, N, M, 3);
        double x[N], expected[N];
        textbook(q);
        for (k = 0; k <= M; k++) {
            for (i = 0; i < N; i++) {
                x[i] = random_number(&seed);
                h[k][i] = random_number(&seed);
                r[k][i] = h[k][i] - x[i];
            }
            CHECK_INT(iqn_step(q, x, h[k]), k ? IQN_OK : IQN_RELAXED);
        }
        for (k = 0; k < M; k++)
            for (i = 0; i < N; i++) V[k * N + i] = r[k + 1][i] - r[k][i];
        for (i = 0; i < N; i++) b[i] = -r[M][i];
        dgels_("N", &n, &m, &one, V, &n, b, &n, work, &lw, &info, 1);
        CHECK_INT(info, 0);
        for (i = 0; i < N; i++)
            for (expected[i] = h[M][i], k = 0; k < M; k++) expected[i] += b[k] * (h[k + 1][i] - h[k][i]);
        CHECK_NEAR(distance(N, x, expected), 0, 2e-14);
        free(mem);
    }
}

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;

static quad quad_sqrt(quad a)
{
    quad s = (quad)sqrt((double)a);
    s = (s + a / s) / 2;
    return (s + a / s) / 2;
}

/* |r| falls far in one step: v'v keeps its 30 digits, up to where the pair is no longer stored. */
static void test_the_square_of_a_pair_that_fell_far(void **state)
{
    enum { N = 1000 };
    static const double fall[] = {1e-20, 1e-100, 1e-130, 1e-136, 1e-140, 1e-149};
    static double x[N], hx[N];
    int i, t, f;
    (void)state;
    for (f = 0; f < 6; f++) {
        void *mem;
        iqn *q = make(&mem, N, 3, 1);
        iqn__view m;
        iqn__dd stored;
        quad right = 0;
        for (t = 0; t < 2; t++) {
            for (i = 0; i < N; i++) {
                x[i] = 0;
                hx[i] = t == 0 ? sin(i + 1) : fall[f] * cos(i);
            }
            CHECK(iqn_step(q, x, hx) >= 0);
        }
        CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
        m = iqn__open(q);
        stored = m.gram[m.order[0] * (m.slots + 1)];
        for (i = 0; i < N; i++) right += (quad)m.V[m.order[0] * N + i] * (quad)m.V[m.order[0] * N + i];
        CHECK_NEAR((double)(((quad)stored.h + (quad)stored.l) / right - 1), 0, 1e-28);
        free(mem);
    }
}

/* Pairs made by steps, condition 1e4 .. 1e14: the update against Householder QR in quadruple precision on the same pairs.
   The error allowed is what Householder QR in double may lose, 1e-16 times the condition, and for the accurate level 1e-3
   of that.                                                                                                           */
static void test_accuracy_at_conditions_up_to_1e14(void **state)
{
    enum { N = 60, M = 6 };
    static quad Q[M + 1][N];
    double power;
    (void)state;
    for (power = 4; power <= 14; power += 2) {
        unsigned long long seed = 17;
        void *mem;
        iqn *q = make(&mem, N, M, 1);
        double x[N], h[N], v[N], w[M][N], r[N], base[N], error = 0, size = 0;
        quad a[M], s, d, f;
        int i, j, k;
        textbook(q);
        for (i = 0; i < N; i++) base[i] = random_number(&seed), r[i] = 1e-3 * random_number(&seed);
        /* differences: plus and minus the same vector, and smaller and smaller parts of others; r has more digits than fit
           into r - r0, so that rounding those has to be accounted for */
        for (k = 0; k <= M; k++) {
            for (i = 0; i < N; i++) {
                if (k > 0) r[i] += (k % 2 ? 1 : -1) * base[i] + pow(10, -power * (k - 1) / (M - 1.0)) * random_number(&seed);
                h[i] = 1e-30 * random_number(&seed);
                x[i] = h[i] - r[i];
                r[i] = h[i] - x[i];
            }
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_get(q, IQN_PAIRS), M);
        for (j = 0; j < M; j++) {
            CHECK_INT(iqn_pair(q, j, v, w[j]), IQN_OK);
            for (i = 0; i < N; i++) Q[j][i] = (quad)v[i];
        }
        for (i = 0; i < N; i++) Q[M][i] = (quad)r[i];
        for (k = 0; k < M; k++) {
            for (s = 0, i = k; i < N; i++) s += Q[k][i] * Q[k][i];
            s = Q[k][k] > 0 ? -quad_sqrt(s) : quad_sqrt(s);
            d = s * (s - Q[k][k]);
            Q[k][k] -= s;
            for (j = k + 1; j <= M; j++) {
                for (f = 0, i = k; i < N; i++) f += Q[k][i] * Q[j][i];
                for (f /= d, i = k; i < N; i++) Q[j][i] -= f * Q[k][i];
            }
            a[k] = s;
        }
        for (k = M - 1; k >= 0; k--) {
            for (s = -Q[M][k], j = k + 1; j < M; j++) s -= Q[j][k] * a[j];
            a[k] = s / a[k];
        }
        for (i = 0; i < N; i++) {
            for (s = 0, j = 0; j < M; j++) s += a[j] * (quad)w[j][i];
            d = (quad)x[i] - (quad)h[i] - s;
            error += (double)(d * d);
            size += (double)(s * s);
        }
        CHECK_NEAR(sqrt(error / size), 0, 1e-19 * pow(10, power) + 2e-15);
        free(mem);
    }
}

/* V'r of the base and V'V where the base stayed behind: a relaxation that raised |r|, then a full step that is taken back and
   its probe.  All of them have some 30 digits, as everywhere: the rounding of v = r - r_base is accounted for. */
static void test_products_are_exact_where_the_base_stays(void **state)
{
    enum { N = 50 };
    static const double slope[] = {30, 100, 1e4};
    size_t c;
    (void)state;
    for (c = 0; c < sizeof slope / sizeof *slope; c++) {
        unsigned long long seed = 5 + c;
        void *mem;
        iqn *q = make(&mem, N, 10, 1);
        const iqn__view m = iqn__open(q);
        double x[N], h[N], b[N], a[N];
        int i, j, k, step, stayed = 0;
        for (i = 0; i < N; i++) x[i] = random_number(&seed), b[i] = random_number(&seed), a[i] = slope[c] * random_number(&seed);
        for (step = 0; step < 8; step++) {
            const int base = q->base;
            for (i = 0; i < N; i++) h[i] = b[i] + a[i] * x[i];
            CHECK(iqn_step(q, x, h) >= 0);
            stayed += step > 0 && q->base == base;
            for (j = 0; j < q->used; j++) {
                const int s = m.order[j];
                const double *v = m.V + (ptrdiff_t)s * N, *r = m.V + (ptrdiff_t)q->base * N;
                quad vr = 0, vv = 0, rr = 0, product;
                for (i = 0; i < N; i++) {
                    vr += (quad)v[i] * (quad)r[i];
                    vv += (quad)v[i] * (quad)v[i];
                    rr += (quad)r[i] * (quad)r[i];
                }
                product = ((quad)m.Vr[s].h + (quad)m.Vr[s].l) * (quad)ldexp(1, q->e);
                CHECK_NEAR((double)((product - vr) / quad_sqrt(vv * rr)), 0, 1e-24);
                for (k = j; k < q->used; k++) {
                    const int o = m.order[k];
                    const double *u = m.V + (ptrdiff_t)o * N;
                    quad uv = 0, uu = 0;
                    for (i = 0; i < N; i++) {
                        uv += (quad)u[i] * (quad)v[i];
                        uu += (quad)u[i] * (quad)u[i];
                    }
                    product = (quad)m.gram[s * m.slots + o].h + (quad)m.gram[s * m.slots + o].l;
                    CHECK_NEAR((double)((product - uv) / quad_sqrt(uu * vv)), 0, 1e-24);
                }
            }
        }
        CHECK(stayed > 0);
        free(mem);
    }
}
#else
static void test_accuracy_at_conditions_up_to_1e14(void **state)
{
    (void)state; /* no quadruple precision here */
}

static void test_products_are_exact_where_the_base_stays(void **state)
{
    (void)state;
}
#endif

/* ---- statuses ---- */

static int failing_sum(double *v, int count, void *ctx)
{
    (void)v;
    (void)count;
    return (*(int *)ctx)-- == 0;
}

static void test_every_status_is_reached_and_negative_ones_touch_nothing(void **state)
{
    enum { N = 5 };
    void *mem;
    size_t bytes = iqn_size(N, 3, 2);
    unsigned char *before = (unsigned char *)malloc(bytes);
    const double nan = strtod("nan", NULL), inf = strtod("inf", NULL);
    double x[N] = {1, 2, 3, 4, 5}, h[N] = {2, 1, 4, 3, 6}, keep[N], bad[N];
    iqn *q = NULL;
    int i, calls;
    (void)state;
    CHECK_INT(iqn_size(-1, 3, 1), 0);
    CHECK_INT(iqn_size(5, -1, 1), 0);
    CHECK_INT(iqn_size(5, 3, 0), 0);
    CHECK_INT(iqn_size((ptrdiff_t)((size_t)-1 / 16), 1000, 1), 0);
    mem = malloc(bytes + 8);
    CHECK_INT(iqn_make(NULL, N, 3, 2, mem, bytes), IQN_ENULL);
    CHECK_INT(iqn_make(&q, -1, 3, 2, mem, bytes), IQN_EARG);
    CHECK_INT(iqn_make(&q, N, 3, 2, NULL, bytes), IQN_EMEM);
    CHECK_INT(iqn_make(&q, N, 3, 2, mem, bytes - 1), IQN_EMEM);
    CHECK_INT(iqn_make(&q, N, 3, 2, (char *)mem + 4, bytes), IQN_EMEM);
    CHECK(q == NULL);
    CHECK_INT(iqn_make(&q, N, 3, 2, mem, bytes), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_GROWTH, 0), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    for (i = 0; i < N; i++) h[i] += i * i;
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    memcpy(before, mem, bytes);
    CHECK_INT(iqn_set(q, 0, 1), IQN_EKEY);
    CHECK_INT(iqn_set(q, IQN_RESIDUAL, 1), IQN_EKEY);
    CHECK_INT(iqn_set(q, IQN_OMEGA, nan), IQN_EVALUE);
    CHECK_INT(iqn_set(q, IQN_OMEGA, inf), IQN_EVALUE);
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, -1), IQN_EVALUE);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 0), IQN_EVALUE);
    CHECK_INT(iqn_set(q, 3, 1), IQN_EKEY);
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 1.5), IQN_EVALUE);
    CHECK_INT(iqn_set(NULL, IQN_OMEGA, 1), IQN_ENULL);
    CHECK_INT(iqn_set_block(q, 2, IQN_WEIGHT, 1), IQN_EKEY);
    CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 1), IQN_EORDER);
    CHECK_INT(iqn_step(NULL, x, h), IQN_ENULL);
    CHECK_INT(iqn_step(q, NULL, h), IQN_ENULL);
    CHECK_INT(iqn_step(q, x, NULL), IQN_ENULL);
    CHECK_INT(iqn_step(q, x, x), IQN_EOVERLAP);
    CHECK_INT(iqn_push(q, x, NULL), IQN_ENULL);
    CHECK_INT(iqn_pair(q, 1, x, NULL), IQN_EARG);
    CHECK_INT(iqn_pair(NULL, 0, x, NULL), IQN_ENULL);
    CHECK_INT(iqn_commit(NULL), IQN_ENULL);
    CHECK_INT(iqn_discard(NULL), IQN_ENULL);
    CHECK_INT(iqn_set_sum(NULL, NULL, NULL), IQN_ENULL);
    CHECK(memcmp(before, mem, bytes) == 0);
    CHECK(!iqn__finite(iqn_get(q, 99)));
    CHECK_INT(iqn_linked_version(), IQN_VERSION);
    CHECK(strcmp(iqn_message(IQN_ENULL), "a pointer is NULL") == 0);
    CHECK(strstr(iqn_message(IQN_EARG), "NULL") == NULL);
    for (i = -211; i < 220; i++) CHECK(iqn_message(i) != NULL && iqn_message(i)[0]);
    CHECK(strcmp(iqn_message(2), "done: a result") == 0 && strcmp(iqn_message(199), "done: a result") == 0);
    CHECK(strstr(iqn_message(IQN_REMARK), "unknown") && IQN_REMARK == 200 && IQN_SOLVED > IQN_REMARK);
    CHECK(strstr(iqn_message(IQN_REMARK + 99), "unknown") && strstr(iqn_message(-1), "unknown"));

    /* a failed step leaves x and the pairs: the next good step gives the bits it gives without the failures */
    memcpy(keep, x, sizeof x);
    for (i = 0; i < 3; i++) {
        memcpy(bad, h, sizeof h);
        bad[i + 1] = i == 0 ? nan : i == 1 ? inf : -inf;
        CHECK_INT(iqn_step(q, x, bad), IQN_ENAN);
        CHECK_INT(iqn_step(q, bad, h), IQN_ENAN);
        CHECK_INT(iqn_push(q, bad, h), IQN_ENAN);
        CHECK_INT(iqn_push(q, h, bad), IQN_ENAN);
        CHECK(memcmp(x, keep, sizeof x) == 0);
    }
    for (i = 0; i < 2; i++) {
        calls = i;
        CHECK_INT(iqn_set_sum(q, failing_sum, &calls), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_ESUM);
        CHECK(memcmp(x, keep, sizeof x) == 0);
    }
    iqn_set_sum(q, NULL, NULL);
    for (i = 0; i < N; i++) h[i] = 1 + x[(i + 1) % N];
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    memcpy(mem, before, bytes);
    CHECK_INT(iqn_step(q, keep, h), IQN_OK);
    CHECK(memcmp(x, keep, sizeof x) == 0);

    for (i = 0; i < N; i++) h[i] = x[i] * (1 + 1e-12);
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK(memcmp(x, h, sizeof x) == 0);
    CHECK_INT(iqn_converged(q), 1);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_converged(q), 0);
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MAX_ITERATIONS, 2), IQN_OK);
    for (i = 0; i < N; i++) h[i] = 10 * i + x[i];
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_converged(q), 0);
    for (i = 0; i < N; i++) h[i] = 7 * i * i + x[i];
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_converged(q), 2);
    CHECK_INT(iqn_discard(q), IQN_OK);
    free(before);
    free(mem);
}

/* ---- problems for the extremes ---- */

typedef struct affine { /* h = A x + b, n <= 64 */
    int n;
    double A[64 * 64], b[64], x[64], h[64];
} affine;

static void affine_make(affine *p, int n, double low, double high, unsigned long long seed)
{
    int i, j, k;
    double Q[64 * 64], d;
    p->n = n;
    for (i = 0; i < n * n; i++) Q[i] = random_number(&seed);
    for (j = 0; j < n; j++) { /* rows of Q orthonormal: A = Q' diag Q has the eigenvalues low .. high */
        for (k = 0; k < j; k++) {
            for (d = 0, i = 0; i < n; i++) d += Q[j * n + i] * Q[k * n + i];
            for (i = 0; i < n; i++) Q[j * n + i] -= d * Q[k * n + i];
        }
        for (d = 0, i = 0; i < n; i++) d += Q[j * n + i] * Q[j * n + i];
        for (i = 0; i < n; i++) Q[j * n + i] /= sqrt(d);
    }
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++)
            for (p->A[i * n + j] = 0, k = 0; k < n; k++)
                p->A[i * n + j] += Q[k * n + i] * Q[k * n + j] * (n > 1 ? low + (high - low) * k / (n - 1) : low);
    for (i = 0; i < n; i++) p->b[i] = random_number(&seed), p->x[i] = 0;
}

static void affine_apply(affine *p)
{
    int i, j;
    for (i = 0; i < p->n; i++)
        for (p->h[i] = p->b[i], j = 0; j < p->n; j++) p->h[i] += p->A[i * p->n + j] * p->x[j];
}

/* Iterations until |r| <= tol |hx|, at most 500; the status of the last step in *status. */
static int affine_solve(affine *p, iqn *q, double tol, int *status)
{
    int k, s = 0;
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, tol), IQN_OK);
    for (k = 1; k <= 500; k++) {
        affine_apply(p);
        s = iqn_step(q, p->x, p->h);
        if (s < 0 || iqn_converged(q)) break;
    }
    if (status) *status = s;
    return k;
}

/* ---- extremes: each test names its row ---- */

static void test_n_0_and_n_1_and_n_2(void **state)
{
    int n, status;
    (void)state;
    for (n = 0; n <= 2; n++) {
        void *mem;
        affine p;
        iqn *q = make(&mem, n, 20, 1);
        affine_make(&p, n, -3, 5, 3);
        CHECK(affine_solve(&p, q, 1e-12, &status) <= n + 2);
        CHECK_INT(status, IQN_SOLVED);
        CHECK_INT(iqn_commit(q), IQN_OK);
        free(mem);
    }
}

static void test_more_columns_than_rows_keep_no_noise(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 20, 1);
    double x = 0.3, h;
    int k;
    (void)state;
    textbook(q);
    for (k = 0; k < 20; k++) { /* the last residuals are equal or noise */
        h = cos(3 * x) - 2 * x;
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK(fabs(x) < 10);
        CHECK(iqn_get(q, IQN_PAIRS) <= (iqn_converged(q) ? 2 : 1)); /* the last pair is not filtered yet */
    }
    CHECK_NEAR(x, cos(3 * x) - 2 * x, 1e-15);
    free(mem);
}

static void test_zero_residuals_at_once_later_and_in_one_block(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 10, 2);
    double x[4] = {1, 2, 3, 4}, h[4] = {1, 2, 3, 4};
    const double a[4] = {1, 2, 3, 4};
    int k;
    (void)state;
    CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, IQN_BY_RESIDUAL), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK(memcmp(x, a, sizeof x) == 0);
    CHECK_INT(iqn_commit(q), IQN_OK);
    for (k = 0; k < 8; k++) { /* block 0 always at rest */
        h[0] = x[0];
        h[1] = x[1];
        h[2] = 1 - 0.5 * x[2];
        h[3] = 2 - 3 * x[3];
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK(x[0] == 1 && x[1] == 2);
    }
    CHECK_NEAR(x[2], 2. / 3, 1e-14);
    CHECK_NEAR(x[3], 0.5, 1e-14);
    free(mem);
}

static void test_two_identical_residuals_and_identical_columns(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 10, 1);
    double x[3] = {0, 0, 0}, h[3];
    int k, i;
    (void)state;
    for (k = 0; k < 40; k++) { /* r is the same for ever: H(x) = x + c */
        for (i = 0; i < 3; i++) h[i] = x[i] + 1 + i;
        CHECK(iqn_step(q, x, h) > 0);
        CHECK(distance(3, x, NULL) < 1e3);
    }
    CHECK_INT(iqn_converged(q), 2);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 0);
    CHECK_INT(iqn_discard(q), IQN_OK);
    for (k = 0; k < 12; k++) /* the same pair again and again, once off by 1e-15 */
        CHECK(iqn_push(q, (const double[3]){1, 2, 3 + (k == 5) * 4e-15}, (const double[3]){3, 2, 1}) == IQN_OK);
    for (i = 0; i < 3; i++) x[i] = 0, h[i] = 1;
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
    CHECK(distance(3, x, NULL) < 10);
    free(mem);
}

/* f(2^k x) = 2^k f(x) bit for bit: residuals of 1e-270 and 1e270, no overflow in a norm, no absolute threshold anywhere. */
static void test_scaling_by_powers_of_two_is_exact(void **state)
{
    static double path[2][40][12];
    int scale, level, k, i;
    (void)state;
    for (level = 0; level < 2; level++)
        for (scale = -900; scale <= 900; scale += 300) {
            void *mem;
            affine p;
            iqn *q = make(&mem, 12, 20, 3);
            affine_make(&p, 12, -4, 3, 5);
            for (i = 0; i < 12; i++) p.b[i] = ldexp(p.b[i], scale);
            CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, level ? IQN_BY_VALUE : IQN_BY_RESIDUAL_SUM), IQN_OK);
            for (k = 0; k < 40; k++) {
                affine_apply(&p);
                CHECK(iqn_step(q, p.x, p.h) >= 0);
                if (k % 7 == 6) CHECK_INT(iqn_commit(q), IQN_OK);
                for (i = 0; i < 12; i++) path[scale != -900][k][i] = ldexp(p.x[i], -scale);
            }
            CHECK(memcmp(path[0], path[scale != -900], sizeof path[0]) == 0);
            free(mem);
        }
}

static void test_residuals_of_1e308_and_denormal_ones(void **state)
{
    static const double size[4] = {1e308, 1e300, 1e-300, 1e-310};
    volatile double denormal = 1e-310;
    const int sizes = denormal * 4 > 0 ? 4 : 3; /* the linker's -Ofast makes the processor take them for zero */
    int i, k, status;
    (void)state;
    for (k = 0; k < sizes; k++) {
        void *mem;
        iqn *q = make(&mem, 200, 10, 1);
        double x[200], h[200];
        for (i = 0; i < 200; i++) x[i] = 0, h[i] = size[k] * (i % 2 ? 1 : -0.5);
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        for (i = 0; i < 200; i++) CHECK(iqn__finite(x[i]) && x[i] != 0);
        CHECK(iqn_get(q, IQN_RELATIVE) == 1);
        for (i = 0; i < 200; i++) h[i] = size[k] * (i % 2 ? 0.5 : -0.5);
        status = iqn_step(q, x, h);
        CHECK(status == IQN_OK);
        for (i = 0; i < 200; i++) CHECK(iqn__finite(x[i]));
        free(mem);
    }
}

static void test_blocks_that_differ_by_1e12(void **state)
{
    int scaling, i, j, k;
    (void)state;
    for (scaling = IQN_BY_VALUE; scaling <= IQN_BY_RESIDUAL_SUM; scaling++) {
        void *mem;
        affine p;
        iqn *q = make(&mem, 10, 20, 2);
        affine_make(&p, 10, -4, 3, 11);
        for (i = 0; i < 10; i++) { /* the second half in units 1e12 times smaller */
            for (j = 0; j < 10; j++) p.A[i * 10 + j] *= (i < 5 ? 1 : 1e12) / (j < 5 ? 1 : 1e12);
            p.b[i] *= i < 5 ? 1 : 1e12;
        }
        CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, scaling), IQN_OK);
        CHECK_INT(iqn_set_block(q, -1, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
        for (k = 0; k < 60 && !iqn_converged(q); k++) {
            affine_apply(&p);
            CHECK(iqn_step(q, p.x, p.h) >= 0);
        }
        CHECK_INT(iqn_converged(q), 1);
        CHECK(k < 25);
        CHECK(iqn_get_block(q, 0, IQN_RELATIVE) <= 1e-10 && iqn_get_block(q, 1, IQN_RELATIVE) <= 1e-10);
        free(mem);
    }
}

static void test_contraction_0_999999_and_expansion_minus_1e6(void **state)
{
    void *mem;
    affine p;
    iqn *q = make(&mem, 8, 20, 1);
    int status;
    (void)state;
    affine_make(&p, 8, 0.5, 0.999999, 2);
    CHECK(affine_solve(&p, q, 1e-9, &status) <= 20);
    CHECK_INT(status, IQN_SOLVED);
    free(mem);
    q = make(&mem, 8, 20, 1);
    affine_make(&p, 8, -1e6, 0.5, 2);
    CHECK(affine_solve(&p, q, 1e-9, &status) <= 30);
    CHECK_INT(status, IQN_SOLVED);
    free(mem);
    q = make(&mem, 8, 20, 1); /* I - A singular and b outside its range: no fixed point, and it says so */
    affine_make(&p, 8, 0.2, 1, 2);
    affine_solve(&p, q, 1e-12, &status);
    CHECK(status == IQN_STALLED || status == IQN_NOISE || status == IQN_DIVERGED);
    CHECK_INT(iqn_converged(q), 2);
    free(mem);
    q = make(&mem, 8, 0, 1); /* relaxation alone cannot follow an expansion */
    affine_make(&p, 8, -50, 0.5, 2);
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
    CHECK(affine_solve(&p, q, 1e-9, &status) <= 40);
    CHECK_INT(status, IQN_DIVERGED);
    free(mem);
}

/* H returns noise of 1e-11: found within IQN_PATIENCE iterations of the floor, and no x is worse than 1e3 times the best. */
static void test_noise_floor(void **state)
{
    void *mem;
    affine p;
    iqn *q = make(&mem, 10, 20, 1);
    unsigned long long seed = 4;
    double best = HUGE_VAL, worst = 0;
    int k, i, status = 0, reached = 0;
    (void)state;
    affine_make(&p, 10, -5, 0.9, 6);
    for (k = 1; k <= 300 && !iqn_converged(q); k++) {
        affine_apply(&p);
        for (i = 0; i < 10; i++) p.h[i] += 1e-11 * random_number(&seed);
        status = iqn_step(q, p.x, p.h);
        CHECK(status >= 0);
        if (iqn_get(q, IQN_RESIDUAL) < best) best = iqn_get(q, IQN_RESIDUAL);
        if (!reached && best < 3e-10) reached = k;
        if (reached && iqn_get(q, IQN_RESIDUAL) > worst) worst = iqn_get(q, IQN_RESIDUAL);
    }
    CHECK_INT(status, IQN_NOISE);
    CHECK(reached > 0 && k - reached <= 80);
    CHECK(worst <= 1e3 * best);
    free(mem);
}

static void test_omega_negative_and_2(void **state)
{
    void *mem;
    iqn *q;
    double x, h;
    int k;
    (void)state;
    for (k = -1; k <= 2; k += k < 0 ? 2 : 1) {
        q = make(&mem, 1, 0, 1);
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_OMEGA, k), IQN_OK);
        x = 1;
        h = 3;
        CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
        CHECK_NEAR(x, 1 + 2 * k, 1e-15);
        free(mem);
    }
}

static void test_aitken_with_equal_and_zero_residuals(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 0, 1);
    double x[2] = {0, 0}, h[2] = {1, 1};
    int k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    for (k = 0; k < 5; k++) { /* equal residuals: omega stays */
        h[0] = x[0] + 1;
        h[1] = x[1] + 1;
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        CHECK(iqn_get(q, IQN_OMEGA_NOW) == 0.1);
    }
    memcpy(h, x, sizeof x);
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    h[0] += 1;
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK(iqn__finite(x[0]) && iqn__finite(x[1]));
    free(mem);
}

static void test_commit_and_discard_without_step_and_1e5_windows(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 6, 1);
    double x[3] = {0, 0, 0}, h[3];
    int w, k, i, most = 0;
    (void)state;
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_discard(q), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    for (w = 0; w < 100000 / LESS; w++) {
        for (k = 0; k < 50 && !iqn_converged(q); k++) {
            for (i = 0; i < 3; i++) h[i] = sin(0.01 * w + i) + 2 - 1.5 * x[i] - 0.3 * x[(i + 1) % 3];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        if (k > most && w > 0) most = k;
        if (w % 10 == 3) iqn_discard(q);
        else iqn_commit(q);
        CHECK(iqn_get(q, IQN_PAIRS) <= 6);
    }
    CHECK(most <= 8);
    free(mem);
}

static void test_a_window_of_one_iteration_does_not_count_for_reuse(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 10, 1);
    double x[3] = {0, 0, 0}, h[3] = {1, 2, 3};
    int k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 1), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    h[0] = 5;
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    for (k = 0; k < 3; k++) {
        CHECK_INT(iqn_commit(q), IQN_OK);
        CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
        CHECK_INT(iqn_step(q, x, h), IQN_OK); /* old columns, no relaxation */
    }
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 0), IQN_OK); /* reuse 0: the old column serves the first step, then it goes */
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    h[1] = -4;
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
    free(mem);
}

/* What the filter drops in a window's last step is decided again in the next window: the last pair had not helped yet. */
static void test_filter_of_the_last_step_is_withdrawn(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 10, 1);
    const double v[2][3] = {{1, 2, 3}, {1, 2, 3.001}}, w[3] = {1, 0, 0};
    double x[3] = {0, 0, 0}, h[3] = {1, 1, 1};
    (void)state;
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-2), IQN_OK);
    CHECK_INT(iqn_push(q, v[0], w), IQN_OK);
    CHECK_INT(iqn_push(q, v[1], w), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 2);
    CHECK_INT(iqn_get(q, IQN_NDROPPED), 0);
    free(mem);
}

static void test_filter_limits_0_1_and_1e_16(void **state)
{
    static const double limit[3] = {0, 1, 1e-16};
    int k, status, n;
    (void)state;
    for (k = 0; k < 3; k++) {
        void *mem;
        affine p;
        iqn *q = make(&mem, 10, 20, 1);
        affine_make(&p, 10, -0.8, 0.9, 8);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, limit[k]), IQN_OK);
        n = affine_solve(&p, q, 1e-9, &status);
        if (k == 1) CHECK(iqn_get(q, IQN_PAIRS) <= 2); /* only the newest can pass; the last step does not filter */
        else CHECK(n <= 12 && status == IQN_SOLVED);
        free(mem);
    }
}

/* Any column out of 200, exact rank 3: drop, bounded weights, no NaN. */
static void test_200_columns_of_rank_3(void **state)
{
    enum { N = 50 };
    void *mem;
    iqn *q = make(&mem, N, 200, 1);
    unsigned long long seed = 9;
    double base[6][N], v[N], w[N], x[N], h[N];
    int i, j, k;
    (void)state;
    for (k = 0; k < 6; k++)
        for (i = 0; i < N; i++) base[k][i] = random_number(&seed);
    for (j = 0; j < 250; j++) {
        double a = random_number(&seed), b = random_number(&seed), c = random_number(&seed);
        for (i = 0; i < N; i++) {
            v[i] = a * base[0][i] + b * base[1][i] + c * base[2][i];
            w[i] = a * base[3][i] + b * base[4][i] + c * base[5][i];
        }
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
    }
    CHECK_INT(iqn_get(q, IQN_PAIRS), 200);
    CHECK_INT(iqn_get(q, IQN_NFULL), 50);
    textbook(q);
    for (i = 0; i < N; i++) x[i] = 0, h[i] = base[0][i] + 2 * base[1][i] - base[2][i];
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 3);
    for (i = 0; i < N; i++) CHECK_NEAR(x[i], h[i] - base[3][i] - 2 * base[4][i] + base[5][i], 1e-9);
    free(mem);
}

/* First step of a new window with IMVJ and reuse 0 is x = hx - J r, J = W (V'V)^-1 V' by LAPACK; seen elsewhere: -2 J r. */
static void test_imvj_starts_a_window_with_minus_J_r(void **state)
{
    enum { N = 30, M = 5 };
    int info, one = 1, n = N, m = M, lw = 1000, restart, i, k;
    (void)state;
    for (restart = 0; restart < 2; restart++) {
        unsigned long long seed = 21;
        void *mem;
        iqn *q = make(&mem, N, 10, 1);
        double x[N], h[M + 2][N], r[M + 2][N], V[M * N], b[N], work[1000], expected[N];
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_MERGE, restart), IQN_OK);
        textbook(q);
        for (k = 0; k <= M + 1; k++) {
            for (i = 0; i < N; i++) {
                x[i] = random_number(&seed);
                h[k][i] = random_number(&seed);
                r[k][i] = h[k][i] - x[i];
            }
            if (k == M + 1) CHECK_INT(iqn_commit(q), IQN_OK);
            CHECK(iqn_step(q, x, h[k]) >= 0);
        }
        for (k = 0; k < M; k++)
            for (i = 0; i < N; i++) V[k * N + i] = r[k + 1][i] - r[k][i];
        for (i = 0; i < N; i++) b[i] = -r[M + 1][i];
        dgels_("N", &n, &m, &one, V, &n, b, &n, work, &lw, &info, 1);
        for (i = 0; i < N; i++)
            for (expected[i] = h[M + 1][i], k = 0; k < M; k++) expected[i] += b[k] * (h[k + 1][i] - h[k][i]);
        CHECK_NEAR(distance(N, x, expected), 0, 2e-14);
        free(mem);
    }
}

/* Matrix-free IMVJ against the definition with dense N x N matrices, three windows: J+ = J + (W - J V) V^+. */
static void test_imvj_equals_its_dense_definition(void **state)
{
    enum { N = 12, M = 3 };
    unsigned long long seed = 33;
    void *mem;
    iqn *q = make(&mem, N, 20, 1);
    double J[N * N] = {0}, Jw[N * N], x[N], h[M + 1][N], r[M + 1][N], V[M * N], P[N * N], work[1000];
    int window, k, i, j, l, info, n = N, m, lw = 1000;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
    textbook(q);
    for (window = 0; window < 3; window++) {
        for (k = 0; k <= M; k++) {
            for (i = 0; i < N; i++) {
                x[i] = random_number(&seed);
                h[k][i] = random_number(&seed);
                r[k][i] = h[k][i] - x[i];
            }
            CHECK(iqn_step(q, x, h[k]) >= 0);
        }
        m = M;
        for (k = 0; k < M; k++)
            for (i = 0; i < N; i++) V[k * N + i] = r[k + 1][i] - r[k][i];
        for (i = 0; i < N * N; i++) P[i] = i % (N + 1) == 0;
        dgels_("N", &n, &m, &n, V, &n, P, &n, work, &lw, &info, 1); /* rows 0..M-1 of P: V^+ */
        memcpy(Jw, J, sizeof J);
        for (l = 0; l < M; l++)
            for (i = 0; i < N; i++) {
                double d = h[l + 1][i] - h[l][i];
                for (j = 0; j < N; j++) d -= J[i * N + j] * (r[l + 1][j] - r[l][j]);
                for (j = 0; j < N; j++) Jw[i * N + j] += d * P[j * N + l];
            }
        memcpy(J, Jw, sizeof J);
        for (i = 0; i < N; i++) {
            double y = h[M][i];
            for (j = 0; j < N; j++) y -= J[i * N + j] * r[M][j];
            CHECK_NEAR(x[i], y, 1e-12);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    free(mem);
}

/* Mixing: x = hx + W a - (1 - beta)(r + V a); kinAnalytic_fp of SUNDIALS with depth 2 and damping 0.5 takes 8 evaluations. */
static void test_mixing_of_kinsol(void **state)
{
    const double pi = 3.14159265358979323846;
    void *mem;
    iqn *q = make(&mem, 3, 2, 1);
    double x[3] = {.1, .1, -.1}, u[3], h[3];
    int m = 0;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_OMEGA, 0.5), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MIXING, 0.5), IQN_OK);
    textbook(q);
    do {
        memcpy(u, x, sizeof u);
        h[0] = cos((x[1] - 1) * x[2]) / 3 + 1. / 6;
        h[1] = sqrt(x[0] * x[0] + sin(x[2]) + 1.06) / 9 + 0.9;
        h[2] = -exp(-x[0] * (x[1] - 1)) / 20 - (10 * pi - 3) / 60;
        CHECK(iqn_step(q, x, h) >= 0);
        m++;
    } while (distance(3, h, u) >= 1.4901161e-06 && m < 20);
    CHECK_INT(m, 8);
    free(mem);
}

/* Secondary data: the coefficients come from the primary block alone, and the secondary one follows them. */
static void test_secondary_blocks_only_follow(void **state)
{
    enum { N = 8 };
    unsigned long long seed = 12;
    int k, i, scale;
    (void)state;
    for (scale = -350; scale <= 700; scale += 350) { /* of the primary block: its weight is 2^-scale */
        void *mem[2];
        iqn *all = make(&mem[0], 2 * N, 5, 2), *alone = make(&mem[1], N, 5, 1);
        double x[2 * N], h[2 * N], y[N], g[N];
        CHECK_INT(iqn_set_block(all, -1, IQN_SCALING, IQN_BY_VALUE), IQN_OK);
        CHECK_INT(iqn_set_block(all, 0, IQN_WEIGHT, 0), IQN_OK);
        for (k = 0; k < 6; k++) {
            for (i = 0; i < 2 * N; i++) {
                x[i] = ldexp(random_number(&seed), i < N ? 0 : scale);
                h[i] = ldexp(random_number(&seed), i < N ? 0 : scale);
            }
            memcpy(y, x + N, sizeof y);
            memcpy(g, h + N, sizeof g);
            CHECK_INT(iqn_step(all, x, h), iqn_step(alone, y, g));
            for (i = 0; i < N; i++) CHECK_NEAR(ldexp(x[N + i], -scale), ldexp(y[i], -scale), 1e-14);
        }
        free(mem[0]);
        free(mem[1]);
    }
}

/* Where weights differ by 1e300, the least squares sees the block of the largest, wherever it stands. */
static void test_the_largest_weight_is_the_unit(void **state)
{
    int large;
    (void)state;
    for (large = 0; large < 2; large++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 2);
        double x[2] = {0, 0}, h[2], v[2];
        int k;
        CHECK_INT(iqn_set_block(q, large, IQN_WEIGHT, 1e150), IQN_OK);
        CHECK_INT(iqn_set_block(q, 1 - large, IQN_WEIGHT, 1e-150), IQN_OK);
        for (k = 0; k < 2; k++) {
            h[large] = 1 - 3 * x[large];
            h[1 - large] = 1 - x[1 - large];
            CHECK_INT(iqn_step(q, x, h), k == 0 ? IQN_RELAXED : IQN_OK);
        }
        CHECK_NEAR(x[large], 0.25, 1e-14);
        v[large] = 0, v[1 - large] = 1; /* beside the other this is nothing, however small the limit */
        CHECK_INT(iqn_commit(q), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-300), IQN_OK);
        CHECK_INT(iqn_push(q, v, v), IQN_OK);
        x[large] = 3;
        CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
        CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
        free(mem);
    }
}

static void test_push_refuses_blocks_that_do_not_add_up(void **state)
{
    void *mem;
    iqn *q = make(&mem, 7, 3, 3);
    double v[7] = {1, 2, 3, 4, 5, 6, 7};
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 7), IQN_OK);
    CHECK_INT(iqn_push(q, v, v), IQN_ELENGTH);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 0);
    free(mem);
}

static void test_convergence_measures(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 10, 2);
    double x[4] = {0, 0, 0, 0}, h[4] = {3, 4, 0.3, 0.4};
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_TOL_ABSOLUTE, 5.5), IQN_OK); /* holds: |r| = 5 */
    CHECK_INT(iqn_set_block(q, 1, IQN_TOL_REDUCTION, 0.5), IQN_OK); /* does not */
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK_NEAR(iqn_get_block(q, 0, IQN_RESIDUAL), 5, 1e-15);
    CHECK_NEAR(iqn_get_block(q, 1, IQN_VALUE), 0.5, 1e-15);
    CHECK_NEAR(iqn_get(q, IQN_RESIDUAL), sqrt(25.25), 1e-14);
    memcpy(h, x, sizeof x);
    h[2] += 0.1;
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK_NEAR(iqn_get_block(q, 1, IQN_REDUCTION), 0.2, 1e-14);
    memcpy(h, x, sizeof x);
    h[2] += 0.3;
    CHECK(iqn_step(q, x, h) != IQN_SOLVED); /* 0.6 > 0.5 */
    CHECK_INT(iqn_set_block(q, 1, IQN_TOL_ABSOLUTE, 0.4), IQN_OK); /* either of two limits */
    memcpy(h, x, sizeof x);
    h[2] += 0.3;
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    memcpy(h, x, sizeof x);
    h[0] += 6; /* the other block does not hold */
    CHECK(iqn_step(q, x, h) != IQN_SOLVED);
    memcpy(h, x, sizeof x);
    h[0] += 5;
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK); /* and the one over all */
    h[2] += 0.1;
    CHECK(iqn_step(q, x, h) != IQN_SOLVED);
    free(mem);
}

/* ---- pairs, checkpoints, ranks ---- */

static void test_pairs_read_and_pushed_give_the_same_update(void **state)
{
    enum { N = 20 };
    unsigned long long seed = 5;
    void *mem[2];
    iqn *a = make(&mem[0], N, 8, 2), *b = make(&mem[1], N, 8, 2);
    double x[N], y[N], h[N], v[N], w[N];
    int k, i;
    (void)state;
    for (k = 0; k < 6; k++) {
        for (i = 0; i < N; i++) x[i] = random_number(&seed), h[i] = random_number(&seed);
        CHECK(iqn_step(a, x, h) >= 0);
    }
    CHECK_INT(iqn_commit(a), IQN_OK);
    for (k = 4; k >= 0; k--) {
        CHECK_INT(iqn_pair(a, k, v, w), IQN_OK);
        CHECK_INT(iqn_push(b, v, w), IQN_OK);
    }
    CHECK_INT(iqn_commit(b), IQN_OK);
    for (i = 0; i < N; i++) x[i] = y[i] = random_number(&seed), h[i] = random_number(&seed);
    CHECK_INT(iqn_step(a, x, h), IQN_OK);
    CHECK_INT(iqn_step(b, y, h), IQN_OK);
    CHECK_NEAR(distance(N, x, y), 0, 1e-13);
    free(mem[0]);
    free(mem[1]);
}

static void test_checkpoint_in_a_file_mid_window_is_bit_identical(void **state)
{
    size_t bytes = iqn_size(12, 8, 3);
    void *mem, *copy = malloc(bytes);
    affine p, other;
    iqn *q = make(&mem, 12, 8, 3), *restored = (iqn *)copy;
    FILE *file = tmpfile();
    int k;
    (void)state;
    CHECK(file != NULL);
    affine_make(&p, 12, -7, 2, 31);
    for (k = 0; k < 60; k++) {
        affine_apply(&p);
        CHECK(iqn_step(q, p.x, p.h) >= 0);
        if (k % 9 == 8) CHECK_INT(iqn_commit(q), IQN_OK);
        if (k == 30) {
            other = p;
            CHECK_INT(fwrite(mem, 1, bytes, file), bytes);
        }
        if (k > 30) {
            if (k == 31) {
                rewind(file);
                CHECK_INT(fread(copy, 1, bytes, file), bytes);
            }
            affine_apply(&other);
            CHECK(iqn_step(restored, other.x, other.h) >= 0);
            if (k % 9 == 8) CHECK_INT(iqn_commit(restored), IQN_OK);
            CHECK(memcmp(p.x, other.x, 12 * sizeof(double)) == 0);
        }
    }
    fclose(file);
    free(mem);
    free(copy);
}

/* Ranks in one process: the step is called again and again, and the hook fails until the sums of all ranks are known.
   That a failed step leaves no trace is part of the promise.                                                         */
typedef struct ranks {
    int count, call, known;     /* ranks; call within the step; how many sums of the step are complete */
    double sum[4][4096];
    int length[4];
} ranks;

static int replayed_sum(double *v, int count, void *ctx)
{
    ranks *all = (ranks *)ctx;
    const int call = all->call++;
    int i;
    CHECK(call < 4 && count <= 4096);
    if (call < all->known) {
        CHECK_INT(all->length[call], count);
        memcpy(v, all->sum[call], (size_t)count * sizeof *v);
        return 0;
    }
    all->length[call] = count;
    for (i = 0; i < count; i++) all->sum[call][i] += v[i];
    return 1; /* stop here: the sum is not complete */
}

static int step_on_ranks(ranks *all, iqn **q, double *x, const double *h, const ptrdiff_t *first)
{
    int r, status = 0, done = 0;
    all->known = 0;
    while (!done) {
        memset(all->sum[all->known], 0, sizeof all->sum[0]);
        for (r = 0; r < all->count; r++) {
            const int before = status;
            all->call = 0;
            status = iqn_step(q[r], x + first[r], h + first[r]);
            if (status != IQN_ESUM) {
                CHECK(r == 0 || status == before); /* the same decision everywhere */
                CHECK(all->call <= 2);             /* at most two sums */
                done = 1;
            }
        }
        if (!done) all->known++;
    }
    return status;
}

static void test_sums_over_1_2_3_and_64_ranks(void **state)
{
    enum { N = 97, STEPS = 25, COLUMNS = 12 };
    static const int counts[4] = {1, 2, 3, 64};
    static double path[4][STEPS][N];
    static ranks all;
    double x[N], h[N];
    int c, r, k, i;
    (void)state;
        for (c = 0; c < 4; c++) {
            iqn *q[64];
            void *mem[64];
            ptrdiff_t first[65];
            all.count = counts[c];
            for (r = 0; r <= all.count; r++) first[r] = N * (ptrdiff_t)r / all.count;
            if (all.count == 3) first[1] = first[2]; /* one rank without interface */
            for (r = 0; r < all.count; r++) {
                q[r] = make(&mem[r], first[r + 1] - first[r], COLUMNS, 1);
                iqn_set_sum(q[r], replayed_sum, &all);
            }
            for (i = 0; i < N; i++) x[i] = 0;
            for (k = 0; k < STEPS; k++) {
                for (i = 0; i < N; i++) h[i] = cos(i) - (1.5 + 0.02 * i) * x[i] + 0.4 * sin(x[(i + 1) % N]);
                CHECK(step_on_ranks(&all, q, x, h, first) >= 0);
                if (k % 10 == 9)
                    for (r = 0; r < all.count; r++) CHECK_INT(iqn_commit(q[r]), IQN_OK);
                memcpy(path[c][k], x, sizeof x);
                CHECK(distance(N, path[c][k], path[0][k]) <= 1e-13);
            }
            for (r = 0; r < all.count; r++) free(mem[r]);
        }
}

/* A NaN on one rank of three: every rank says IQN_ENAN, and the next good step goes on. */
static void test_nan_on_one_rank(void **state)
{
    static ranks all;
    iqn *q[3];
    void *mem[3];
    const ptrdiff_t first[4] = {0, 2, 4, 6};
    double x[6] = {0, 0, 0, 0, 0, 0}, h[6] = {1, 2, 3, 4, 5, 6};
    int r;
    (void)state;
    all.count = 3;
    for (r = 0; r < 3; r++) {
        q[r] = make(&mem[r], 2, 4, 1);
        iqn_set_sum(q[r], replayed_sum, &all);
    }
    CHECK_INT(step_on_ranks(&all, q, x, h, first), IQN_RELAXED);
    h[3] = iqn__nan();
    CHECK_INT(step_on_ranks(&all, q, x, h, first), IQN_ENAN);
    h[3] = 3;
    CHECK_INT(step_on_ranks(&all, q, x, h, first), IQN_OK);
    for (r = 0; r < 3; r++) free(mem[r]);
}

/* A pair pushed in the middle of a window, where r is of another size than 1: its entry of V'r, and so those of V'V with the
   pairs to come, keep all digits.  The step after the push is withdrawn, too: that uses V'r again.                        */
static void test_pairs_pushed_amid_a_window_at_any_scale(void **state)
{
    static const int scales[9] = {0, -900, -500, -145, -60, 60, 145, 500, 900};
    static double path[2][8][4];
    int c, k, i;
    (void)state;
    for (c = 0; c < 9; c++) {
        unsigned long long seed = 77;
        void *mem;
        iqn *q = make(&mem, 4, 6, 2);
        double x[4], h[4], v[4], w[4], g[4];
        textbook(q);
        for (k = 0; k < 8; k++) {
            for (i = 0; i < 4; i++) {
                x[i] = ldexp(random_number(&seed), scales[c]);
                h[i] = x[i] + ldexp(random_number(&seed), scales[c] + (k == 4 ? 6 : 0));
                v[i] = ldexp(random_number(&seed), scales[c]);
                w[i] = ldexp(random_number(&seed), scales[c]);
            }
            CHECK(iqn_step(q, x, h) >= 0);
            if (k == 1 || k == 3 || k == 6) CHECK_INT(iqn_push(q, v, w), IQN_OK);
            for (i = 0; i < 4; i++) g[i] = ldexp(x[i], -scales[c]);
            memcpy(path[c > 0][k], g, sizeof g);
        }
        CHECK(memcmp(path[0], path[c > 0], sizeof path[0]) == 0);
        free(mem);
    }
}

/* The next two inline loops of the header, which a gcc that is not asked for a standard would fuse here. */
#if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC push_options
#    pragma GCC optimize("fp-contract=off")
#endif

/* The products without error by one fused operation and by splitting are the same bits, so the processor does not matter. */
static void test_fused_and_split_products_agree(void **state)
{
    enum { N = 43 };
    unsigned long long seed = 8;
    double a[N], r[N], d[N];
    int n, i;
    (void)state;
#ifdef FAST_HOST
    printf("# inlined into a host with -ffast-math, the splitting is not what it is in the header\n");
    return;
#endif
    for (i = 0; i < N; i++) a[i] = random_number(&seed), r[i] = random_number(&seed), d[i] = 1e-17 * random_number(&seed);
    for (i = 0; i < N; i++) {
        const double p = a[i] * r[i], split = iqn__product_error(a[i], r[i], p, 0), fused = iqn__product_error(a[i], r[i], p, 1);
        CHECK(memcmp(&split, &fused, sizeof split) == 0);
    }
    for (n = 0; n < N; n++) {
        const double *of[2] = {a, d}, start[2] = {3 * 64, 3 * 1e-15};
        double here[48], everywhere[48];
        iqn__two_products_body(n, of, r, d, start, everywhere, 0);
        for (old_processor = 0; old_processor < PROCESSORS; old_processor++) {
            iqn__two_products(n, of, r, d, start, here);
            CHECK(memcmp(here, everywhere, sizeof here) == 0);
        }
    }
    old_processor = 0;
}

/* The loops of the small factor, likewise; and its entries are those of L, row `end` included, to 30 digits. */
static void test_fused_and_split_factors_agree(void **state)
{
    enum { N = 11, COLUMNS = 12 };
    unsigned long long seed = 9;
    void *mem;
    iqn *q = make(&mem, 0, COLUMNS, 1);
    const iqn__view m = iqn__open(q);
    double h[PROCESSORS + 1][COLUMNS + 4], l[PROCESSORS + 1][COLUMNS + 4];
    const ptrdiff_t lead = m.lead;
    int i, j, k, t;
    (void)state;
#ifdef FAST_HOST
    free(mem);
    return;
#endif
    for (i = 0; i < (COLUMNS + 1) * lead; i++) m.Lh[i] = random_number(&seed), m.Ll[i] = 1e-17 * random_number(&seed);
    for (k = 0; k < N; k++) {
        const size_t bytes = (size_t)lead * sizeof(double), needed = (size_t)(N + 1 - k) * sizeof(double);
        const iqn__dd f = iqn__two_sum(1.25, 1e-17 * k);
        double before[COLUMNS + 4], before_low[COLUMNS + 4];
        memcpy(before, m.Lh + k * lead, bytes);
        memcpy(before_low, m.Ll + k * lead, bytes);
        for (t = PROCESSORS; t >= 0; t--) {
            old_processor = t % PROCESSORS;
            memcpy(m.Lh + k * lead, before, bytes);
            memcpy(m.Ll + k * lead, before_low, bytes);
            if (t == PROCESSORS) iqn__eliminate_body(&m, 2, k, N, 0), iqn__scale_body(lead, m.Lh + k * lead, m.Ll + k * lead, f, 0);
            else iqn__eliminate(&m, 2, k, N), iqn__scale(lead, m.Lh + k * lead, m.Ll + k * lead, f);
            memcpy(h[t] + k, m.Lh + k * lead + k, needed);
            memcpy(l[t] + k, m.Ll + k * lead + k, needed);
            CHECK(memcmp(h[t] + k, h[PROCESSORS] + k, needed) == 0 && memcmp(l[t] + k, l[PROCESSORS] + k, needed) == 0);
        }
#ifdef __SIZEOF_FLOAT128__
        for (i = k; i <= N; i++) {
            quad sum = (quad)before[i] + (quad)before_low[i];
            double size = fabs(before[i]);
            for (j = 2; j < k; j++) {
                const quad L_ij = (quad)m.Lh[j * lead + i] + (quad)m.Ll[j * lead + i];
                const quad L_kj = (quad)m.Lh[j * lead + k] + (quad)m.Ll[j * lead + k];
                sum -= L_ij * L_kj;
                size += fabs((double)(L_ij * L_kj));
            }
            CHECK_NEAR((double)(sum * ((quad)f.h + (quad)f.l) - ((quad)h[0][i] + (quad)l[0][i])), 0, 3e-31 * size);
        }
#endif
    }
    for (t = PROCESSORS; t >= 0; t--) {
        old_processor = t % PROCESSORS;
        if (t == PROCESSORS) iqn__back_body(&m, 2, N, 0);
        else iqn__back(&m, 2, N);
        memcpy(h[t], m.ah + 2, (N - 2) * sizeof *m.ah);
        memcpy(l[t], m.al + 2, (N - 2) * sizeof *m.al);
        CHECK(memcmp(h[t], h[PROCESSORS], (N - 2) * sizeof *m.ah) == 0);
        CHECK(memcmp(l[t], l[PROCESSORS], (N - 2) * sizeof *m.al) == 0);
    }
#ifdef __SIZEOF_FLOAT128__
    for (k = N - 1; k >= 2; k--) {
        quad sum = (quad)m.Lh[k * lead + N] + (quad)m.Ll[k * lead + N];
        const quad diagonal = (quad)m.Lh[k * lead + k] + (quad)m.Ll[k * lead + k];
        double size = fabs((double)sum);
        for (i = k + 1; i < N; i++) {
            const quad L_ik = (quad)m.Lh[k * lead + i] + (quad)m.Ll[k * lead + i], a_i = (quad)m.ah[i] + (quad)m.al[i];
            sum -= L_ik * a_i;
            size += fabs((double)(L_ik * a_i));
        }
        CHECK_NEAR((double)(sum * diagonal - ((quad)m.ah[k] + (quad)m.al[k])), 0, 3e-31 * size * fabs((double)diagonal));
    }
#endif
    free(mem);
}

#if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC pop_options
#endif

/* Powers of two, also those that are no double themselves. */
static void test_shift_by_more_than_a_double_holds(void **state)
{
    static const int power[] = {0, -1, 52, -1022, 1023, -1023, 1024, -1500, 1500, -1900, 1900};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof power / sizeof *power; k++) {
        const double h = ldexp(1.25, -power[k] / 2), l = ldexp(1.75, -power[k] / 2 - 60);
        const iqn__dd a = iqn__shift(iqn__dd_join(h, l), power[k]);
        CHECK(a.h == ldexp(h, power[k]) && a.l == ldexp(l, power[k]));
    }
}

/* "push, then commit, to keep them", with no step before; and bounds that cross are refused. */
static void test_pushed_pairs_are_kept_by_commit(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    const double v[2] = {-1, 0}, w[2] = {.5, 0}, h[2] = {1, 1};
    double x[2] = {0, 0};
    (void)state;
    CHECK_INT(iqn_push(q, v, w), IQN_OK);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    CHECK_INT(iqn_discard(q), IQN_OK);
    CHECK_INT((int)iqn_get(q, IQN_PAIRS), 1);
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 5), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_UPPER, 1), IQN_EVALUE);
    CHECK_INT(iqn_set_block(q, -1, IQN_UPPER, 6), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 7), IQN_EVALUE);
    free(mem);
}

/* Aitken at its edges: a secant of more than 1e6 is noise and omega stays; a new window starts with |omega| at most the given
   one and the sign that the last one had.                                                                               */
static void test_aitken_of_noise_and_over_windows(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 0, 1);
    double x = 0, h = 1;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
    h = x + 1 + 1e-9; /* the secant is 1e8 */
    CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
    CHECK(iqn_get(q, IQN_OMEGA_NOW) == 0.1);
    h = x + 1.1;
    CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
    CHECK_NEAR(iqn_get(q, IQN_OMEGA_NOW), -1, 1e-6);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
    CHECK(iqn_get(q, IQN_OMEGA_NOW) == -0.1);
    free(mem);
}

/* Residual-sum scaling as published: the sum starts anew in every window, and new weights are taken when a sum has changed
   tenfold; a field that is zero so far does not count.                                                                  */
static void test_residual_sum_starts_anew_in_every_window(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 5, 3);
    iqn__view m = iqn__open(q);
    double x[3], h[3];
    int window, k, b;
    (void)state;
    CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, IQN_BY_RESIDUAL_SUM), IQN_OK);
    for (window = 0; window < 2; window++) {
        for (k = 0; k < 3; k++) { /* window 0: |r| = 0.8, 0.6, 0; window 1: 0.8, 0.03, 0 */
            for (b = 0; b < 3; b++) x[b] = k + b;
            h[0] = x[0] + 0.8;
            h[1] = x[1] + (window ? 0.03 : 0.6) * (k % 2 ? -1 : 1);
            h[2] = x[2];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
        CHECK_NEAR(m.block[0].sum, window ? 3 * 0.8 / sqrt(0.6409) : 2.4, 1e-14);
        CHECK_NEAR(m.block[1].sum, window ? 3 * 0.03 / sqrt(0.6409) : 1.8, 1e-14);
        CHECK_NEAR(m.block[1].used_sum, window ? 0.03 / sqrt(0.6409) : 0.6, 1e-14); /* of the first step: 0.037 <= 0.1 0.6 */
        CHECK_NEAR(m.block[2].used_sum, 0, 0);
    }
    free(mem);
}

/* Start from rest: hx is 0 in the first iteration, of x as a whole or in one block, yet |r| <= limit |hx| is met later.                                                                                         */
static void test_a_first_window_from_rest(void **state)
{
    int kind, k;
    (void)state;
    for (kind = 0; kind < 4; kind++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 2);
        double x[2], h[2];
        x[0] = 2;
        x[1] = kind < 2 ? 2 : 1;
        if (kind == 3) CHECK_INT(iqn_set_block(q, -1, IQN_TOL_RELATIVE, 1e-6), IQN_OK);
        else CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-6), IQN_OK);
        for (k = 0; k < 15 && !iqn_converged(q); k++) {
            h[0] = 1 - x[0] / 2;
            h[1] = 1 - x[1] / 2;
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_converged(q), 1);
        CHECK_NEAR(x[0], 2. / 3, 1e-6);
        CHECK_NEAR(x[1], 2. / 3, 1e-6);
        free(mem);
    }
}

/* hx grows from 1e-9 to 2 under a healthy contraction: that is progress, not a stall. */
static void test_a_ramp_is_no_stall(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 0, 1);
    double x = -1 / 0.3, h;
    int k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-6), IQN_OK);
    for (k = 0; k < 200 && !iqn_converged(q); k++) {
        h = 2 + 0.6 * (x - 2);
        if (k == 0) h = 1e-9;
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK(iqn_converged(q) < 2);
        if (k > 2) CHECK_NEAR(iqn_get(q, IQN_BEST_RELATIVE), iqn_get(q, IQN_RELATIVE), 0); /* it falls all the time */
    }
    CHECK_INT(iqn_converged(q), 1);
    free(mem);
}

/* In a full store a pushed pair takes the room of one that the last step has dropped, the oldest or the middle one, and not its
   mark: none that is in use goes before the next pair comes. */
static void test_a_push_takes_the_room_of_a_dropped_pair(void **state)
{
    static const double twin[4] = {1, 2, 3, 0}, other[4] = {0, 1, 0, 0}, newest[4] = {1, 2, 3.0001, 0}, w[4] = {0, 0, 0, 1};
    int middle;
    (void)state;
    for (middle = 0; middle < 2; middle++) {
        void *mem;
        iqn *q = make(&mem, 4, 3, 1);
        double x[4] = {0, 0, 0, 0}, h[4] = {1, 1, 1, 1}, got[4];
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-2), IQN_OK);
        CHECK_INT(iqn_push(q, middle ? other : twin, w), IQN_OK);
        CHECK_INT(iqn_push(q, middle ? twin : other, w), IQN_OK);
        CHECK_INT(iqn_push(q, newest, w), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_DROPPED); /* the twin, in the plane of the two others up to 1e-4 */
        CHECK_INT(iqn_get(q, IQN_PAIRS), 2);
        CHECK_INT(iqn_push(q, w, w), IQN_OK);
        CHECK_INT(iqn_get(q, IQN_PAIRS), 3);
        CHECK_INT(iqn_get(q, IQN_NDROPPED), 1);
        CHECK_INT(iqn_get(q, IQN_NFULL), 0);
        CHECK_INT(iqn_pair(q, 2, got, NULL), IQN_OK);
        CHECK_NEAR(distance(4, got, other), 0, 1e-15);
        CHECK(iqn_step(q, x, h) >= 0); /* nothing is dropped any more: the oldest makes room for the pair of this step */
        CHECK_INT(iqn_get(q, IQN_NFULL), 1);
        CHECK_INT(iqn_pair(q, 1, got, NULL), IQN_OK);
        CHECK_NEAR(distance(4, got, w), 0, 1e-15);
        free(mem);
    }
}

/* w too large beside v: refused, instead of an infinite pair. */
static void test_push_of_an_infinite_slope(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 3, 1);
    const double v = 1e-200, w = 1e200;
    (void)state;
    CHECK_INT(iqn_push(q, &v, &w), IQN_ENAN);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 0);
    free(mem);
}

/* Aitken by value: the same factors for data of any size. */
static void test_aitken_by_value_at_any_scale(void **state)
{
    int c, k;
    (void)state;
    for (c = -900; c <= 900; c += 300) {
        void *mem;
        iqn *q = make(&mem, 1, 0, 1);
        double x = 0, h;
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
        CHECK_INT(iqn_set_block(q, 0, IQN_SCALING, IQN_BY_VALUE), IQN_OK);
        for (k = 0; k < 3; k++) {
            h = ldexp(2, c) - 3 * x;
            CHECK(iqn_step(q, &x, &h) >= 0);
        }
        CHECK_NEAR(iqn_get(q, IQN_OMEGA_NOW), 0.25, 1e-14);
        CHECK_NEAR(ldexp(x, -c), 0.5, 1e-14);
        free(mem);
    }
}

/* ---- a metric, steps taken back, convergence and patience ---- */

/* M = C'C + 1 in every block, C random */
static void metric_make(int n, double *M, unsigned long long *seed)
{
    double C[400];
    int i, j, k;
    for (i = 0; i < n * n; i++) C[i] = random_number(seed);
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++)
            for (M[i * n + j] = i == j, k = 0; k < n; k++) M[i * n + j] += C[k * n + i] * C[k * n + j];
}

static void metric_apply(int n, const double *M, const double *v, double *Mv)
{
    int i, j;
    for (i = 0; i < n; i++)
        for (Mv[i] = 0, j = 0; j < n; j++) Mv[i] += M[i * n + j] * v[j];
}

/* M = L L'; out = L' v */
static void metric_root(int n, const double *M, const double *v, double *out)
{
    double L[400];
    int i, j, k;
    for (i = 0; i < n; i++)
        for (j = 0; j <= i; j++) {
            double s = M[i * n + j];
            for (k = 0; k < j; k++) s -= L[i * n + k] * L[j * n + k];
            L[i * n + j] = i == j ? sqrt(s) : s / L[j * n + j];
        }
    for (j = 0; j < n; j++)
        for (out[j] = 0, i = j; i < n; i++) out[j] += L[i * n + j] * v[i];
}

static int sum_of_one_rank(double *v, int count, void *ctx)
{
    (void)v, (void)count, (void)ctx;
    return 0;
}

/* Two blocks with metrics of their own and the weights 1 and 3; pairs from steps and from pushes: every update equals the
   dense least squares |L'(r + V a)|, M = L L', by LAPACK's Householder QR. */
static void metric_equals_dense_weighted_least_squares(int with_sum, int power)
{
    enum { N = 12, B = 2, ALL = N * B, M = 6, LW = 1000 };
    double metric[B][N * N], x[ALL], h[M + 2][ALL], r[M + 2][ALL], Mr[ALL], v[ALL], w[ALL], Mv[ALL], pv[ALL], pw[ALL];
    double V[M * ALL], a[ALL], work[LW], expected[ALL];
    const double weight[B] = {1, 3};
    unsigned long long seed = 99;
    int info, one = 1, n = ALL, lw = LW, m, b, i, j, k;
    void *mem;
    iqn *q = make(&mem, ALL, M + 1, B);
    textbook(q);
    if (with_sum) CHECK_INT(iqn_set_sum(q, sum_of_one_rank, NULL), IQN_OK);
    CHECK_INT(iqn_set_block(q, 1, IQN_WEIGHT, weight[1]), IQN_OK);
    for (b = 0; b < B; b++) {
        metric_make(N, metric[b], &seed);
        for (i = 0; i < N * N; i++) metric[b][i] = ldexp(metric[b][i], power);
    }
    for (i = 0; i < ALL; i++) pv[i] = random_number(&seed), pw[i] = random_number(&seed);
    for (i = N; i < ALL; i++) pv[i] = 0; /* of one field only */
    for (k = 0; k < M; k++) {
        for (i = 0; i < ALL; i++) {
            x[i] = random_number(&seed);
            h[k][i] = x[i] + random_number(&seed);
            r[k][i] = h[k][i] - x[i];
        }
        for (b = 0; b < B; b++) metric_apply(N, metric[b], r[k] + b * N, Mr + b * N);
        CHECK(iqn_step_metric(q, x, h[k], Mr) >= 0);
        if (k == 2) { /* a pair from elsewhere, amid the window */
            for (b = 0; b < B; b++) metric_apply(N, metric[b], pv + b * N, Mv + b * N);
            CHECK_INT(iqn_push(q, pv, pw), IQN_EORDER);
            CHECK_INT(iqn_push_metric(q, pv, pw, Mv), IQN_OK);
        }
        if (k < 3) continue;
        for (m = 0, j = 0; j < (int)iqn_get(q, IQN_PAIRS); j++, m++) {
            CHECK_INT(iqn_pair(q, j, v, w), IQN_OK);
            for (b = 0; b < B; b++) {
                metric_root(N, metric[b], v + b * N, V + j * ALL + b * N);
                for (i = 0; i < N; i++) V[j * ALL + b * N + i] *= weight[b];
            }
        }
        CHECK_INT(m, k + 1);
        for (b = 0; b < B; b++) {
            metric_root(N, metric[b], r[k] + b * N, a + b * N);
            for (i = 0; i < N; i++) a[b * N + i] *= -weight[b];
        }
        dgels_("N", &n, &m, &one, V, &n, a, &n, work, &lw, &info, 1);
        memcpy(expected, h[k], sizeof expected);
        for (j = 0; j < m; j++) {
            CHECK_INT(iqn_pair(q, j, NULL, w), IQN_OK);
            for (i = 0; i < ALL; i++) expected[i] += a[j] * w[i];
        }
        CHECK_NEAR(distance(ALL, x, expected), 0, 1e-12);
    }
    CHECK_INT(iqn_step(q, x, h[0]), IQN_EORDER); /* the pairs are those of another norm */
    CHECK_INT(iqn_step_metric(q, x, h[0], NULL), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, x, h[0], x), IQN_EOVERLAP);
    CHECK_INT(iqn_push_metric(q, pv, pw, NULL), IQN_ENULL);
    free(mem);
}

static void test_metric_equals_dense_weighted_least_squares(void **state)
{
    static const int power[] = {0, 300, -300}; /* what travels between ranks is in units of M, too */
    int k, with_sum;
    (void)state;
    for (k = 0; k < 3; k++)
        for (with_sum = 0; with_sum < 2; with_sum++) metric_equals_dense_weighted_least_squares(with_sum, power[k]);
}

/* By the default rule, too, a pair that lives in one field only is a pair. */
static void test_a_pair_of_one_field_with_a_metric(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 5, 2);
    const double v[4] = {1, 2, 0, 0}, w[4] = {3, 1, 0, 0}, Mv[4] = {4, 5, 0, 0}, h[4] = {2, 3, 4, 6}, Mr[4] = {3, 3, 2, 4};
    double x[4] = {1, 2, 3, 4};
    (void)state;
    CHECK_INT(iqn_push_metric(q, v, w, Mv), IQN_OK);
    CHECK_INT(iqn_step_metric(q, x, h, Mr), IQN_OK);
    CHECK(iqn_get(q, IQN_PAIRS) == 1 && iqn_get(q, IQN_NDROPPED) == 0);
    free(mem);
}

/* With M = 2^20 the metric changes nothing: the same statuses, and iterates to rounding errors, with all default rules. */
static void test_a_multiple_of_1_as_metric(void **state)
{
    void *mem[2];
    affine p, s;
    iqn *q[2];
    double my[14];
    int k, i;
    (void)state;
    affine_make(&p, 14, -30, 0.9, 5);
    s = p;
    for (k = 0; k < 2; k++) {
        q[k] = make(&mem[k], 14, 20, 2);
        textbook(q[k]); /* nothing is learned from the course of |r|: the second one's x is edited where a last bit differs */
    }
    for (k = 0; k < 14; k++) {
        affine_apply(&p);
        affine_apply(&s);
        for (i = 0; i < 14; i++) my[i] = ldexp(s.h[i] - s.x[i], 20);
        CHECK_INT(iqn_step(q[0], p.x, p.h), iqn_step_metric(q[1], s.x, s.h, my));
        CHECK_NEAR(distance(14, p.x, s.x), 0, 1e-6);
        if (k == 8) CHECK_INT(iqn_commit(q[0]), iqn_commit(q[1]));
        for (i = 0; i < 14 && k == 8; i++) p.b[i] += 0.1 * i, s.b[i] += 0.1 * i;
        memcpy(s.x, p.x, sizeof s.x);
    }
    for (k = 0; k < 2; k++) free(mem[k]);
}

/* H fails at x: half of the way back, and again; then the host's x is taken as it comes. */
static void test_halving_goes_half_of_the_way_back(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {1, 2}, h[2] = {5, 7}, bad[2], to[2];
    int i;
    (void)state;
    CHECK_INT(iqn_halve(q, x), IQN_EORDER);
    CHECK_INT(iqn_halve(NULL, x), IQN_ENULL);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK_INT(iqn_halve(q, NULL), IQN_ENULL);
    memcpy(to, x, sizeof x);
    bad[0] = bad[1] = iqn__nan();
    for (i = 1; i <= 2; i++) {
        CHECK_INT(iqn_step(q, x, bad), IQN_ENAN);
        CHECK_INT(iqn_halve(q, x), IQN_OK);
        CHECK_NEAR(x[0], 1 + (to[0] - 1) / (1 << i), 1e-15);
        CHECK_NEAR(x[1], 2 + (to[1] - 2) / (1 << i), 1e-15);
    }
    for (i = 0; i < 2; i++) h[i] = 5 + i - 0.5 * x[i];
    CHECK(iqn_step(q, x, h) >= 0);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 1);
    CHECK_INT(iqn_get(q, IQN_NREFUSED), 2);
    free(mem);
}

/* A step that raises |r| much is withdrawn, and one probe finds H affine: at most one evaluation more than n + 2 with the
   textbook's rules, never a small step. */
static void test_a_probe_finds_an_affine_map(void **state)
{
    int n, k, i, status, withdrawn = 0;
    (void)state;
    for (n = 4; n <= 20; n += 2) {
        void *mem;
        affine p;
        iqn *q = make(&mem, n, n + 5, 1);
        double keep[64], base[64] = {0}, least = 0;
        int relaxed = 0;
        affine_make(&p, n, -300, 0.9, (unsigned)n);
        CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, 1e-9), IQN_OK);
        for (k = 1; k < 60 && !iqn_converged(q); k++) {
            affine_apply(&p);
            memcpy(keep, p.x, sizeof keep);
            status = iqn_step(q, p.x, p.h);
            CHECK(status >= 0 && status != IQN_EXPLORED);
            for (i = 0; i < n && status == IQN_WITHDRAWN; i++) /* back to a tenth of the way */
                CHECK_NEAR(p.x[i], base[i] + 0.1 * (keep[i] - base[i]), 1e-12 * (1 + fabs(base[i]) + fabs(keep[i])));
            if (status != IQN_WITHDRAWN && !(relaxed && iqn_get(q, IQN_RESIDUAL) > least)) { /* where the next step starts */
                memcpy(base, keep, sizeof base);
                least = iqn_get(q, IQN_RESIDUAL);
            }
            relaxed = status == IQN_RELAXED;
        }
        CHECK_INT(iqn_converged(q), 1);
        CHECK(k - 1 <= n + 4);
        CHECK(iqn_get(q, IQN_NWITHDRAWN) <= 1);
        CHECK_INT(iqn_get(q, IQN_NEXPLORED), 0);
        withdrawn += (int)iqn_get(q, IQN_NWITHDRAWN);
        free(mem);
    }
    CHECK(withdrawn > 0);
}

/* A strongly nonlinear H from several starts: proved by the probe, explored by small steps, solved. */
static void test_a_nonlinear_map_is_explored(void **state)
{
    enum { N = 6 };
    double explored = 0, before = 0, withdrawn = 0;
    int start, k, i, status, window;
    (void)state;
    for (start = -2; start <= 2; start++) {
        void *mem;
        iqn *q = make(&mem, N, 30, 1);
        double x[N], h[N];
        CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, 1e-8), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, 0), IQN_OK);
        for (i = 0; i < N; i++) x[i] = start;
        for (window = 0; window < 2; window++) {
            for (status = k = 0; k < 300 && !iqn_converged(q); k++) {
                for (i = 0; i < N; i++)
                    h[i] = x[i] + 1 + window + i - 4 * (1 + i) * (x[i] + x[i] * x[i] * x[i]) + 0.3 * x[(i + 1) % N];
                status = iqn_step(q, x, h);
                CHECK(status >= 0);
                if (status == IQN_EXPLORED) explored++;
            }
            CHECK_INT(status, IQN_SOLVED);
            CHECK_INT(iqn_commit(q), IQN_OK);
        }
        withdrawn += iqn_get(q, IQN_NWITHDRAWN);
        CHECK(iqn_get(q, IQN_NEXPLORED) >= explored - before);
        before = explored;
        free(mem);
    }
    CHECK(withdrawn > 0);
    CHECK(explored > 0);
}

/* The host moves x far away: no step is withdrawn there, and the iteration goes on from the host's x. */
static void test_a_host_that_edits_x_is_respected(void **state)
{
    int edit, k, back[2] = {0, 0};
    (void)state;
    for (edit = 0; edit < 2; edit++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 1);
        double x[2] = {0, 0}, h[2];
        CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
        for (k = 1; k < 20 && !iqn_converged(q); k++) {
            h[0] = 0.5 * x[0] - 0.2 * x[1] + 1;
            h[1] = 0.3 * x[1] + 1;
            if (edit == 0 && k == 3) h[0] = 50; /* H itself jumps */
            back[edit] += iqn_step(q, x, h) == IQN_WITHDRAWN;
            if (edit == 1 && k == 2) x[0] = 50, x[1] = -40;
        }
        CHECK_INT(iqn_converged(q), 1);
        free(mem);
    }
    CHECK(back[0] > 0);
    CHECK_INT(back[1], 0);
}

/* u'A = u', u'b != 0: no fixed point.  x runs away, |r| / |hx| becomes small, and that is not convergence. */
static void test_without_a_fixed_point_nothing_converges(void **state)
{
    unsigned long long seed = 1;
    int t, i, j, k, n;
    (void)state;
    for (t = 0; t < 100; t++) {
        double A[400], b[20], x[20], h[20], u[20], s = 0, d;
        void *mem;
        iqn *q;
        n = 2 + t % 18;
        q = make(&mem, n, 30, 1);
        for (i = 0; i < n; i++) u[i] = random_number(&seed), s += u[i] * u[i];
        for (i = 0; i < n * n; i++) A[i] = random_number(&seed) / sqrt(n);
        for (j = 0; j < n; j++) {
            for (d = 0, i = 0; i < n; i++) d += u[i] * A[i * n + j];
            for (i = 0; i < n; i++) A[i * n + j] += u[i] * (u[j] - d) / s;
        }
        for (i = 0; i < n; i++) b[i] = random_number(&seed), x[i] = 0;
        CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, t % 2 ? 1e-3 : 1e-6), IQN_OK);
        for (k = 1; k < 200 && !iqn_converged(q); k++) {
            for (i = 0; i < n; i++)
                for (h[i] = b[i], j = 0; j < n; j++) h[i] += A[i * n + j] * x[j];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK(iqn_converged(q) != 1 || iqn_get(q, IQN_REDUCTION) <= 0.5);
        free(mem);
    }
}

/* Flat for n steps is no stall while every step brings an independent pair; IQN_PATIENCE 0 never gives up. */
static void test_patience_knows_new_pairs(void **state)
{
    enum { N = 22 };
    unsigned long long seed = 3;
    double A[N * N], b[N], x[N], h[N], y = 0, g;
    void *mem;
    iqn *q;
    int t, i, j, k;
    (void)state;
    for (t = 0; t < 40; t++) {
        q = make(&mem, N, 50, 1);
        for (i = 0; i < N * N; i++) A[i] = 5 * random_number(&seed) / sqrt(N);
        for (i = 0; i < N; i++) b[i] = random_number(&seed), x[i] = 0;
        CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, 1e-8), IQN_OK);
        for (k = 1; k < 100 && !iqn_converged(q); k++) {
            for (i = 0; i < N; i++)
                for (h[i] = b[i], j = 0; j < N; j++) h[i] += A[i * N + j] * x[j];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_converged(q), 1);
        free(mem);
    }
    for (t = 0; t < 2; t++) {
        q = make(&mem, 1, 0, 1);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, t ? 0 : 5), IQN_OK);
        for (k = 0; k < 30; k++) {
            g = y + 1;
            CHECK(iqn_step(q, &y, &g) > 0);
        }
        CHECK_INT(iqn_converged(q), t ? 0 : 2);
        if (t) CHECK_INT(iqn_get(q, IQN_NSTALLED), 0);
        else CHECK(iqn_get(q, IQN_NSTALLED) > 5);
        free(mem);
    }
}

/* ---- every key, every loop, every output ---- */

typedef struct lengths { /* of the messages of a step */
    int calls, count[4];
} lengths;

static int counting_sum(double *v, int count, void *ctx)
{
    lengths *l = (lengths *)ctx;
    (void)v;
    if (l->calls < 4) l->count[l->calls] = count;
    l->calls++;
    return 0;
}

static void test_the_length_of_the_messages(void **state)
{
    int blocks, k;
    (void)state;
    for (blocks = 1; blocks <= 3; blocks++) {
        void *mem;
        affine p;
        lengths l;
        iqn *q = make(&mem, 9, 20, blocks);
        affine_make(&p, 9, -2, 0.9, 1);
        CHECK_INT(iqn_set_sum(q, counting_sum, &l), IQN_OK);
        for (k = 0; k < 6; k++) {
            const int pairs = k > 0 ? k - 1 : 0;
            memset(&l, 0, sizeof l);
            affine_apply(&p);
            CHECK(iqn_step(q, p.x, p.h) >= 0);
            CHECK_INT(l.calls, 2);
            CHECK_INT(l.count[0], 10 * blocks + 2);
            CHECK_INT(l.count[1], 3 * (2 * pairs + 4) * blocks);
        }
        free(mem);
    }
}

/* Two windows of two blocks of a nonlinear map with a key set: all that a host can see, in one number. */
static double seen_with(int method, int block, int key, double value)
{
    enum { N = 6 };
    void *mem;
    iqn *q = make(&mem, N, 20, 2);
    double x[N], h[N], sum = 0;
    int k, i, window, s;
    if (method >= 0) CHECK_INT(iqn_set(q, IQN_METHOD, method), IQN_OK);
    CHECK_INT(block < 0 ? iqn_set(q, key, value) : iqn_set_block(q, block, key, value), IQN_OK);
    if (key == IQN_LENGTH) CHECK_INT(iqn_set_block(q, 1 - block, key, N - value), IQN_OK);
    if (key == IQN_LENGTH) CHECK_INT(iqn_set_block(q, 0, IQN_WEIGHT, 5), IQN_OK);
    for (i = 0; i < N; i++) x[i] = 0.1 * i;
    for (window = 0; window < 3; window++) {
        for (k = 0; k < 5; k++) {
            for (i = 0; i < N; i++)
                h[i] = (i < 3 ? 1 : 7) + window - (1.5 + i) * x[i] + 0.4 * sin(3 * x[(i + 1) % N]) + 0.1 * x[(i + 3) % N];
            s = iqn_step(q, x, h);
            CHECK(s >= 0);
            for (i = 0; i < N; i++) sum += x[i] * cos(1 + i + 10 * k + 100 * window);
            sum += iqn_converged(q) * 1e3 + (k == 4 ? s : 0);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    free(mem);
    return sum;
}

static void test_every_key_has_an_effect(void **state)
{
    static const struct { int method, block, key; double one, two; } row[] = {
        {-1, -1, IQN_METHOD, IQN_ILS, IQN_IMVJ},       {-1, -1, IQN_METHOD, IQN_AITKEN, IQN_CONSTANT},
        {-1, -1, IQN_OMEGA, 0.1, 0.2},                 {IQN_CONSTANT, -1, IQN_OMEGA, 0.1, -0.1},
        {-1, -1, IQN_FILTER_LIMIT, 0, 0.5},            {-1, -1, IQN_FILTER_LIMIT, 1e-16, 0.5},
        {-1, -1, IQN_WINDOWS, -1, 0},                  {-1, -1, IQN_WINDOWS, 0, 1},
        {IQN_IMVJ, -1, IQN_WINDOWS, 0, 1},             {-1, -1, IQN_TOL_ABSOLUTE, 0, 1},
        {-1, -1, IQN_TOL_RELATIVE, 0, 0.5},            {-1, -1, IQN_TOL_REDUCTION, 0, 0.5},
        {-1, 1, IQN_TOL_ABSOLUTE, 0, 1},               {-1, 1, IQN_TOL_RELATIVE, 0, 0.5},
        {-1, 1, IQN_TOL_REDUCTION, 0, 0.5},            {-1, -1, IQN_MAX_ITERATIONS, 0, 3},
        {-1, -1, IQN_MIXING, 1, 0.5},
        {-1, -1, IQN_NOISE_LEVEL, 1e-13, 0.1},         {-1, -1, IQN_GROWTH, 0, 1},
        {IQN_IMVJ, -1, IQN_MERGE, 0, 1},               {IQN_IMVJ, -1, IQN_MERGE, 1, 3},
        {-1, 0, IQN_LENGTH, 3, 2},                     {-1, 1, IQN_SCALING, IQN_BY_WEIGHT, IQN_BY_VALUE},
        {-1, 1, IQN_SCALING, IQN_BY_WEIGHT, IQN_BY_RESIDUAL},
        {-1, 1, IQN_SCALING, IQN_BY_VALUE, IQN_BY_RESIDUAL_SUM},
        {-1, 0, IQN_WEIGHT, 1, 0},                     {-1, 1, IQN_WEIGHT, 1, 3},
        {-1, 1, IQN_LOWER, -1e9, 0.9},                 {-1, 1, IQN_UPPER, 1e9, 0.9},
        {IQN_AITKEN, 1, IQN_UPPER, 1e9, 0.9},          {IQN_AITKEN, 1, IQN_WEIGHT, 1, 3}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        const double one = seen_with(row[k].method, row[k].block, row[k].key, row[k].one);
        const double two = seen_with(row[k].method, row[k].block, row[k].key, row[k].two);
        if (one == two) fprintf(stderr, "ERROR: row %d of the keys, key %d: no effect\n", (int)k, row[k].key);
        CHECK(one != two);
    }
}

/* x = 0, h = (0.5, 5, 6, -7) with omega 1: clamped in every component, from either side, in the block with bounds alone */
static void test_bounds_clamp_every_component(void **state)
{
    static const double h[8] = {0.5, 5, 6, -7, 0.5, 5, 6, -7}, expected[8] = {0.5, 5, 6, -7, 0.5, 1, 1, -2};
    void *mem;
    iqn *q = make(&mem, 8, 0, 2);
    double x[8] = {0};
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
    CHECK_INT(iqn_set_block(q, 1, IQN_UPPER, 1), IQN_OK);
    CHECK_INT(iqn_set_block(q, 1, IQN_LOWER, -2), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK_NEAR(distance(8, x, expected), 0, 0);
    free(mem);
}

/* Aitken: two blocks as one; and after a step that bounds have cut short, the secant of the step that was made. */
static void test_aitken_of_blocks_and_of_bounded_steps(void **state)
{
    void *mem;
    iqn *q;
    double x[4], h[4], y = 0, g;
    int blocks, k, i;
    (void)state;
    for (blocks = 1; blocks <= 2; blocks++) {
        for (i = 0; i < 4; i++) x[i] = i + 1;
        q = make(&mem, 4, 3, blocks);
        CHECK_INT(iqn_push(q, x, x), IQN_OK); /* of another method: nobody asks */
        q->base = iqn__open(q).order[2];      /* any free slot */
        CHECK(q->base > 0);
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_OMEGA, 0.3), IQN_OK);
        for (k = 0; k < 5; k++) {
            for (i = 0; i < 4; i++) h[i] = 1 - 0.15 * (i + 1) * x[i];
            CHECK_INT(fenced_step(q, x, h, NULL), IQN_RELAXED);
        }
        CHECK_NEAR(x[3], 0.625069892177764, 1e-13);
        free(mem);
    }
    q = make(&mem, 1, 0, 1);
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 2), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_UPPER, 15), IQN_OK);
    for (k = 0; k < 2; k++) { /* 0 -> 20, cut to 15 -> 20/3, the fixed point */
        g = 10 - 0.5 * y;
        CHECK_INT(iqn_step(q, &y, &g), IQN_RELAXED);
    }
    CHECK_NEAR(iqn_get(q, IQN_OMEGA_NOW), 2. / 3, 1e-15);
    CHECK_NEAR(y, 20. / 3, 1e-14);
    free(mem);
}

/* IQN_WINDOWS lowered before or after iqn_commit: the first step of the next window takes the same pairs. */
static void test_fewer_past_windows_count_at_once(void **state)
{
    enum { N = 12 };
    static const int windows[] = {-1, 2, 1, 0};
    double x[N], h[N], next[2];
    void *mem;
    size_t row;
    int after, w, i, pairs[2], status;
    (void)state;
    for (row = 0; row < sizeof windows / sizeof *windows; row++) {
        for (after = 0; after < 2; after++) {
            iqn *q = make(&mem, N, 40, 1);
            CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-3), IQN_OK);
            for (i = 0; i < N; i++) x[i] = 0;
            for (w = 0; w < 4; w++) {
                do {
                    for (i = 0; i < N; i++) h[i] = 1 + 0.3 * w * i - (1 + 0.07 * i) * x[i] + 0.8 * x[(i + 1) % N];
                    status = iqn_step(q, x, h);
                } while (status >= 0 && w < 3 && !iqn_converged(q));
                if (w < 2) CHECK_INT(iqn_commit(q), IQN_OK);
                if (w != 2) continue;
                if (after) CHECK_INT(iqn_commit(q), IQN_OK);
                CHECK_INT(iqn_set(q, IQN_WINDOWS, windows[row]), IQN_OK);
                if (!after) CHECK_INT(iqn_commit(q), IQN_OK);
            }
            pairs[after] = (int)iqn_get(q, IQN_PAIRS);
            next[after] = x[3];
            free(mem);
        }
        CHECK_INT(pairs[1], pairs[0]);
        CHECK(next[1] == next[0]);
    }
}

/* All of a'y in one lane, with a'a hardly below a power of 2: 2^59 - 8 from 64 squares near 2^53, and y = -a.  No bit is lost. */
static void test_a_lane_that_takes_all_loses_nothing(void **state)
{
    static double a[IQN__STRETCH], y[IQN__STRETCH], zero[IQN__STRETCH];
    unsigned long long seed = 59;
    int run, i;
    (void)state;
    for (run = 0; run < 300; run++) {
        int64_t rest = ((int64_t)1 << 59) - 8;
        iqn__dd exact = iqn__dd_of(0);
        const iqn__column column = {a, 59, &exact, NULL};
        iqn__side side = {y, zero, 0};
        for (i = 0; i < 64; i++) { /* the last few take what is left: each time a square root of it stays */
            const double most = floor(sqrt((double)rest));
            const double entry = i < 58 ? floor(most / sqrt(64. - i) * (1 + 0.01 * random_number(&seed))) : most;
            rest -= (int64_t)entry * (int64_t)entry;
            a[8 * i] = entry;
            y[8 * i] = -a[8 * i];
        }
        for (rest = 0, i = 0; i < 64; i++) rest += (int64_t)a[8 * i] * (int64_t)a[8 * i];
        CHECK(rest > ((int64_t)1 << 59) - 100 && rest < (int64_t)1 << 59);
        side.square = iqn__square_bound(iqn__plain_square(IQN__STRETCH, y));
        iqn__dot(IQN__STRETCH, &side, 1, &column);
        CHECK((int64_t)exact.h + (int64_t)exact.l == -rest);
    }
}

/* A compiler that is told of fused multiply-add makes use of it, clang without __FP_FAST_FMA, too. */
static void test_fused_where_the_compiler_may(void **state)
{
    int may = 0;
    (void)state;
#if defined(__FMA__) || defined(__FP_FAST_FMA) || (defined(__ARM_FEATURE_FMA) && (__ARM_FP & 8))
    may = 1;
#endif
    CHECK_INT(IQN__FMA, may);
}

/* The loops over long vectors against plain ones, at every length. */
static void test_loops_at_every_length(void **state)
{
    unsigned long long seed = 2;
    double a[40], r[40], d[40], w[4][40], y[40], sum, square, with;
    const double *column[4] = {w[0] + 1, w[1] + 1, w[2] + 1, w[3] + 1};
    const double coefficient[4] = {1, -2, 3, 0.5};
    int n, i, count;
    (void)state;
    for (i = 0; i < 40; i++) {
        a[i] = random_number(&seed), r[i] = random_number(&seed), d[i] = random_number(&seed), y[i] = 0;
        w[0][i] = a[i], w[1][i] = r[i], w[2][i] = d[i], w[3][i] = a[i] * r[i];
    }
    for (n = 0; n <= 40; n++) {
        for (sum = square = with = 0, i = 0; i < n; i++) sum += a[i] * r[i], square += a[i] * a[i], with += a[i] * d[i];
        for (count = 1; count <= 2; count++) { /* the last column is a */
            const iqn__side side = {r, d, 6};
            iqn__dd exact[2];
            double plain[2];
            iqn__column of[2];
            memset(exact, 0, sizeof exact);
            memset(plain, 0, sizeof plain);
            for (i = 0; i < 2; i++) of[i].a = i == count - 1 ? a : d, of[i].square = 6, of[i].exact = exact + i, of[i].plain = plain + i;
            of[count - 1].plain = count % 2 ? plain + count - 1 : NULL;
            iqn__dot(n, &side, count, of);
            CHECK_NEAR(exact[count - 1].h, sum, 1e-14);
            CHECK_NEAR(plain[count - 1], count % 2 ? with : 0, 1e-14);
            for (i = count; i < 2; i++) CHECK(exact[i].h == 0 && plain[i] == 0);
        }
        CHECK_NEAR(iqn__plain_square(n, a), square, 1e-14);
#ifndef FAST_HOST /* clang fuses in one of them */
        CHECK(iqn__scaled_square(n, a, NULL, 1) == iqn__plain_square(n, a));
#endif
        for (square = 0, i = 0; i < n; i++) square += (a[i] - r[i]) * (a[i] - r[i]);
        CHECK_NEAR(iqn__scaled_square(n, a, r, 0.5), square / 4, 1e-14);
        memset(y, 0, sizeof y);
        if (n > 0) iqn__add_four_columns(n - 1, y + 1, column, coefficient[0], coefficient[1], coefficient[2], coefficient[3]); /* from 1 to n - 1: nothing in front, nothing behind */
        for (i = 0; i < 40; i++)
            CHECK_NEAR(y[i], i > 0 && i < n ? a[i] - 2 * r[i] + 3 * d[i] + 0.5 * a[i] * r[i] : 0, 1e-15);
    }
}

/* Numbers first .. first + n - 1 of an array of 44 are as they should be, and the others untouched: 77. */
static void check_rows(const double *is, const double *should, int n)
{
    int i;
    for (i = 0; i < 44; i++) CHECK_NEAR(is[i], i >= 1 && i <= n ? should[i] : 77, 1e-15);
}

/* The loops that form and write vectors, at every length, in place where a step does so. */
static void test_vectors_at_every_length(void **state)
{
    enum { N = 44 };
    unsigned long long seed = 3;
    double x[N], hx[N], r0[N], h0[N], y[N], out[4][N], should[4][N], squares[12], sum[4];
    int n, i, k;
    (void)state;
    for (i = 0; i < N; i++) {
        x[i] = random_number(&seed), hx[i] = random_number(&seed), y[i] = random_number(&seed);
        r0[i] = random_number(&seed), h0[i] = random_number(&seed);
    }
    for (n = 0; n <= 42; n++) {
        iqn__rows of;
        const double bound[2] = {-0.3, 0.4};
        memset(sum, 0, sizeof sum);
        for (k = 0; k < 4; k++)
            for (i = 0; i < N; i++) out[k][i] = 77;
        for (i = 1; i <= n; i++) {
            should[0][i] = (hx[i] - x[i]) * 0.5;
            should[1][i] = should[0][i] - r0[i] * 0.25;
            sum[0] += should[0][i] * should[0][i], sum[1] += should[1][i] * should[1][i], sum[2] += hx[i] * hx[i];
        }
        of.h = hx + 1, of.x = x + 1, of.base = r0 + 1, of.unit = 0.5, of.base_unit = 0.25;
        of.r = out[0] + 1, of.v = out[1] + 1, of.d = out[2] + 1;
        iqn__form_rows(n, &of, squares);
        check_rows(out[0], should[0], n);
        check_rows(out[1], should[1], n);
        for (i = 0; i < N; i++) CHECK(i >= 1 && i <= n ? fabs(out[2][i]) < 1e-15 : out[2][i] == 77);
        for (k = 0; k < 3; k++) CHECK_NEAR(iqn__sum_lanes(squares + 4 * k), sum[k], 1e-14);
        for (k = 0; k < 2; k++) { /* units above and below 1: what is stored stands where the base stood */
            const double unit = k ? 4 : 0.25, *base[2] = {out[0] + 1, out[1] + 1};
            double *pair[2] = {out[0] + 1, out[1] + 1};
            for (i = 0; i < N; i++) {
                const int inside = i >= 1 && i <= n;
                out[0][i] = inside ? r0[i] : 77, out[1][i] = inside ? h0[i] : 77;
                should[0][i] = (hx[i] - x[i]) * unit - r0[i] * unit, should[1][i] = (hx[i] - h0[i]) * unit;
            }
            iqn__store_pair(n, x + 1, hx + 1, unit, base, pair);
            for (i = 0; i < N; i++) CHECK_NEAR(out[0][i], i >= 1 && i <= n ? should[0][i] : 77, 1e-14);
            for (i = 0; i < N; i++) CHECK_NEAR(out[1][i], i >= 1 && i <= n ? should[1][i] : 77, 1e-14);
        }
        for (i = 0; i < N; i++) should[0][i] = hx[i] - x[i], out[0][i] = out[1][i] = out[2][i] = out[3][i] = 77;
        iqn__store_base(n, x + 1, hx + 1, out[0] + 1, out[1] + 1);
        check_rows(out[0], should[0], n);
        check_rows(out[1], hx, n);
        memset(sum, 0, sizeof sum);
        for (i = 1; i <= n; i++) {
            should[2][i] = h0[i] + y[i];
            should[3][i] = fmin(fmax(should[2][i], bound[0]), bound[1]);
            sum[2] += pow((should[2][i] - (h0[i] - r0[i])) * 0.5, 2);
            sum[3] += pow((should[3][i] - (h0[i] - r0[i])) * 0.5, 2);
        }
        iqn__write_next(n, r0 + 1, h0 + 1, 0.5, y + 1, out[2] + 1, squares);
        CHECK_NEAR(iqn__sum_lanes(squares), sum[2], 1e-14);
        check_rows(out[2], should[2], n);
        iqn__write_next_within(n, r0 + 1, h0 + 1, 0.5, bound, y + 1, out[3] + 1, squares);
        CHECK_NEAR(iqn__sum_lanes(squares), sum[3], 1e-14);
        check_rows(out[3], should[3], n);
    }
}

/* A processor without AVX-512, and without AVX2 and FMA: the loops are right, and steps have the same bits. */
static void test_loops_of_an_old_processor(void **state)
{
    for (old_processor = 1; old_processor < PROCESSORS; old_processor++) {
        test_loops_at_every_length(state);
        test_vectors_at_every_length(state);
    }
    old_processor = 0;
}

static void test_steps_of_an_old_processor(void **state)
{
    enum { N = 303, COLUMNS = 9, STEPS = 24 };
    static double path[PROCESSORS][STEPS][N];
    int k, i;
    (void)state;
    for (old_processor = 0; old_processor < PROCESSORS; old_processor++) {
        void *mem;
        iqn *q = make(&mem, N, COLUMNS, 3);
        double x[N] = {0}, h[N];
        CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, IQN_BY_VALUE), IQN_OK);
        for (k = 0; k < STEPS; k++) {
            for (i = 0; i < N; i++) h[i] = 0.1 + 0.4 * x[i] * x[(i + 1) % N] + (i % 7) / 14. * x[(i + N / 2) % N] + 1e-3 * (i % 11);
            CHECK(iqn_step(q, x, h) >= 0);
            memcpy(path[old_processor][k], x, sizeof x);
        }
        CHECK(iqn_get(q, IQN_PAIRS) > 4);
        free(mem);
    }
    old_processor = 0;
#ifndef FAST_HOST /* clang fuses where it may */
    for (k = 1; k < PROCESSORS; k++) CHECK(memcmp(path[0], path[k], sizeof path[0]) == 0);
#endif
}

/* Without bounds of the host x stays a double all the same. */
static void test_a_step_out_of_range_ends_at_the_largest_double(void **state)
{
    double x[5] = {0}, h[5] = {1e305, -1e305, 1, 1e305, 2};
    void *mem;
    iqn *q = make(&mem, 5, 3, 1);
    (void)state;
    CHECK_INT(iqn_set(q, IQN_OMEGA, 1e6), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK(x[0] == DBL_MAX && x[1] == -DBL_MAX && x[3] == DBL_MAX);
    CHECK_NEAR(x[2], 1e6, 1e-9);
    CHECK_NEAR(x[4], 2e6, 1e-9);
    free(mem);
}

/* hx moves by 1e300 while r moves by 1e-9, in the same block and beside it: w / |v| is no number, and no pair. */
static void test_a_step_whose_pair_is_out_of_range(void **state)
{
    int blocks;
    (void)state;
    for (blocks = 1; blocks <= 2; blocks++) {
        double x[2] = {1e300, 1}, h[2] = {1e300, 1 + 1e-9};
        void *mem;
        iqn *q = make(&mem, 2, 4, blocks);
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        x[0] = h[0] = x[1] = 1;
        h[1] = 1 + 2e-9;
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        CHECK(x[0] == 1);
        CHECK_NEAR(x[1], 1 + 2e-10, 1e-15);
        CHECK(iqn_get(q, IQN_PAIRS) == 0 && iqn_get(q, IQN_NZERO) == 1);
        free(mem);
    }
}

/* One block falls by more than 1e150 in a step, which the other does not: v'v of the first is no number. */
static void test_a_block_that_falls_out_of_range_leaves_no_pair(void **state)
{
    int weight;
    (void)state;
    for (weight = 0; weight <= 1; weight++) {
        double x[2] = {0, 0}, h[2] = {1e100, 1e260};
        void *mem;
        iqn *q = make(&mem, 2, 4, 2);
        CHECK_INT(iqn_set_block(q, 1, IQN_WEIGHT, weight), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        x[0] = x[1] = 0, h[0] = 2, h[1] = 3;
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        CHECK(iqn_get(q, IQN_PAIRS) == 0 && iqn_get(q, IQN_NZERO) == 1 && iqn_get(q, IQN_NDROPPED) == 0);
        CHECK_NEAR(x[0], 0.2, 1e-15);
        CHECK_NEAR(x[1], 0.3, 1e-15);
        free(mem);
    }
}

/* w / |v| = 1e300: without noise a pair is kept, as at any other scale; with noise it goes, and passes none on. */
static void test_noise_far_above_a_pair(void **state)
{
    int noisy;
    (void)state;
    for (noisy = 0; noisy <= 1; noisy++) {
        static const double v[3][3] = {{1e-150, 0, 0}, {0, 1e-150, 0}, {0, 0, 1}},
                            w[3][3] = {{1e150, 0, 0}, {0, 1e150, 0}, {0, 0, 1}};
        double x[3] = {0}, h[3] = {1e-152, 1e-152, 1};
        void *mem;
        iqn *q = make(&mem, 3, 4, 1);
        int k;
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, noisy ? 1e-13 : 0), IQN_OK);
        for (k = 2; k >= 0; k--) CHECK_INT(iqn_push(q, v[k], w[k]), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), noisy ? IQN_DROPPED : IQN_OK);
        CHECK(iqn_get(q, IQN_PAIRS) == (noisy ? 1 : 3));
        if (noisy) CHECK(iqn__open(q).noise[0] == 0 && iqn__open(q).noise[1] == 0);
        CHECK_NEAR(x[2], 0, 1e-12);
        if (!noisy) CHECK(fabs(x[0] / -1e148 - 1) < 1e-12 && fabs(x[1] / -1e148 - 1) < 1e-12);
        free(mem);
    }
}

/* |r| / |hx| and |r| / |first r| underflow to 0, which is no convergence where their limits are not set. */
static void test_a_limit_that_is_not_set_is_not_met(void **state)
{
    static const int set[] = {IQN_TOL_ABSOLUTE, IQN_TOL_RELATIVE, IQN_TOL_REDUCTION};
    size_t i;
    (void)state;
    for (i = 0; i < 3; i++) {
        double x[2] = {0, 1}, h[2] = {1e300, 1e300};
        void *mem;
        iqn *q = make(&mem, 2, 4, 1);
        CHECK_INT(iqn_set(q, set[i], 1e-100), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        x[0] = 0, h[0] = 1e-30; /* the absolute limit is not met: the ratios are 1e-330 */
        x[1] = h[1] = set[i] == IQN_TOL_REDUCTION ? 0 : 1e300;
        CHECK_INT(iqn_step(q, x, h), set[i] == IQN_TOL_ABSOLUTE ? IQN_RELAXED : IQN_SOLVED);
        free(mem);
    }
}

/* Nothing is written beside x, v and w; bad questions have the answer NaN. */
static void test_guards_behind_outputs(void **state)
{
    int n, i, k;
    (void)state;
    for (n = 1; n <= 18; n++) {
        void *mem;
        iqn *q = make(&mem, n, 4, 1);
        double x[20], h[20], v[20], w[20];
        for (i = 0; i < 20; i++) x[i] = h[i] = v[i] = w[i] = 77;
        for (i = 0; i < n; i++) x[i] = 0;
        for (k = 0; k < 4; k++) {
            for (i = 0; i < n; i++) h[i] = i + 1 - 0.1 * (i + 1) * x[i];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_pair(q, 0, v, w), IQN_OK);
        CHECK_INT(iqn_pair(q, 0, v, v), IQN_EOVERLAP);
        for (i = n; i < 20; i++) CHECK(x[i] == 77 && v[i] == 77 && w[i] == 77);
        CHECK(!iqn__finite(iqn_get_block(q, -1, IQN_RESIDUAL)));
        CHECK(!iqn__finite(iqn_get_block(q, 1, IQN_RESIDUAL)));
        CHECK(!iqn__finite(iqn_get_block(NULL, 0, IQN_RESIDUAL)));
        CHECK(!iqn__finite(iqn_get(q, IQN_NSTEPS + 7)) && !iqn__finite(iqn_get(q, 3)));
        free(mem);
    }
}

/* IQN_MERGE 2: after every second window the past pairs are one group; the count starts anew. */
static void test_merging_every_second_window(void **state)
{
    static const int groups[6] = {1, 1, 2, 1, 2, 1};
    void *mem;
    iqn *q = make(&mem, 6, 40, 1);
    iqn__view m = iqn__open(q);
    unsigned long long seed = 6;
    double x[6], h[6];
    int window, k, i, count;
    (void)state;
    textbook(q);
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MERGE, 2), IQN_OK);
    for (window = 0; window < 6; window++) {
        for (k = 0; k < 2; k++) {
            for (i = 0; i < 6; i++) x[i] = random_number(&seed), h[i] = random_number(&seed);
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
        for (count = i = 0; i < q->used; i++) count += i == 0 || m.window[m.order[i]] != m.window[m.order[i - 1]];
        CHECK_INT(count, groups[window]);
    }
    free(mem);
}

/* Counters by cause */
static void test_counters(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {0, 0}, h[2];
    int k;
    (void)state;
    for (k = 0; k < 3; k++) { /* r is the same for ever: pairs of rounding errors, relaxation */
        h[0] = x[0] + 1;
        h[1] = x[1] + 2;
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    }
    CHECK_INT(iqn_get(q, IQN_NSTEPS), 3);
    CHECK_INT(iqn_get(q, IQN_NRELAXED), 3);
    CHECK_INT(iqn_get(q, IQN_NZERO), 2);
    h[0] = x[0];
    h[1] = x[1];
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK_INT(iqn_get(q, IQN_NRELAXED), 3);
    CHECK_INT(iqn_get(q, IQN_NSUMS), 0);
    free(mem);
}

/* ---- time grids, threads ---- */

/* u' = -u - 2 x + 30 cos 2t for two components in a window of length 1, implicit Euler with s steps: hx = the samples u. */
static void solve(int s, double t0, const double *u0, const double *x, double *hx)
{
    int j, i;
    for (j = 0; j < s; j++)
        for (i = 0; i < 2; i++) {
            const double before = j ? hx[2 * (j - 1) + i] : u0[i], t = t0 + (j + 1.) / s;
            hx[2 * j + i] = (before + (30 * cos(2 * t + i) - 2 * x[2 * j + i]) / s) / (1 + 1. / s);
        }
}

/* The fixed point x = u of the same steps */
static void together(int s, double t0, const double *u0, double *u)
{
    int j, i;
    for (j = 0; j < s; j++)
        for (i = 0; i < 2; i++)
            u[2 * j + i] = ((j ? u[2 * (j - 1) + i] : u0[i]) + 30 * cos(2 * (t0 + (j + 1.) / s) + i) / s) / (1 + 3. / s);
}

static double iterate(iqn *q, int s, double t0, const double *u0, double *x, int *first) /* |r| after one update over |r| before */
{
    double hx[32], reduction = 1;
    int k, status;
    for (k = 1; k <= 100; k++) {
        solve(s, t0, u0, x, hx);
        status = iqn_step(q, x, hx);
        CHECK(status >= 0);
        if (k == 1) *first = status;
        if (k == 2) reduction = iqn_get(q, IQN_REDUCTION);
        if (iqn_converged(q)) break;
    }
    CHECK_INT(iqn_converged(q), 1);
    return reduction;
}

/* Samples of two numbers at 0, 1/2 and 1, to 1/16, .. 1 by straight lines; 0 at 0. */
static void to_16_sub_steps(const double *coarse, double *fine)
{
    int j, i;
    for (j = 1; j <= 16; j++)
        for (i = 0; i < 2; i++) {
            const double begin = j > 8 ? coarse[i] : 0, end = coarse[j > 8 ? 2 + i : i];
            fine[2 * (j - 1) + i] = begin + (end - begin) * ((j - 1) % 8 + 1) / 8;
        }
}

/* One side refines from 2 to 16 sub-steps after the first window: the pairs follow by iqn_pair and iqn_push, and
   the waveform of the second window is that of 16 steps.  Frozen on the first grid it would be 18 % off.                   */
static void test_one_side_refines_from_2_to_16_sub_steps(void **state)
{
    void *coarse_mem, *fine_mem, *bare_mem;
    iqn *coarse = make(&coarse_mem, 4, 20, 2), *fine = make(&fine_mem, 32, 20, 16), *bare = make(&bare_mem, 32, 20, 16);
    double u0[2] = {0, 0}, x[32] = {0}, y[32], exact[32], frozen[4], v[4], w[4], V[32], W[32];
    double carried, alone;
    int j, first;
    (void)state;
    CHECK_INT(iqn_set(coarse, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    CHECK_INT(iqn_set(fine, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    CHECK_INT(iqn_set(bare, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    iterate(coarse, 2, 0, u0, x, &first);
    CHECK_INT(iqn_commit(coarse), IQN_OK);
    memcpy(u0, x + 2, sizeof u0);
    for (j = (int)iqn_get(coarse, IQN_PAIRS) - 1; j >= 0; j--) { /* the sample at the window's start never changes: 0 */
        CHECK_INT(iqn_pair(coarse, j, v, w), IQN_OK);
        to_16_sub_steps(v, V);
        to_16_sub_steps(w, W);
        CHECK_INT(iqn_push(fine, V, W), IQN_OK);
    }
    CHECK_INT(iqn_commit(fine), IQN_OK);
    for (j = 0; j < 32; j++) x[j] = y[j] = u0[j % 2];
    carried = iterate(fine, 16, 1, u0, x, &first);
    CHECK(first == IQN_OK || first == IQN_DROPPED); /* quasi-Newton from the first step on */
    alone = iterate(bare, 16, 1, u0, y, &first);
    CHECK_INT(first, IQN_RELAXED);
    CHECK(carried < 0.5 && alone > 0.8); /* against relaxation */
    together(16, 1, u0, exact);
    together(2, 1, u0, frozen);
    CHECK_NEAR(distance(32, x, exact), 0, 1e-8);
    CHECK(fabs(frozen[2] - exact[30]) > 0.02 * fabs(exact[30]));
    free(coarse_mem);
    free(fine_mem);
    free(bare_mem);
}

/* Ranks as threads, each with an object and a sum of its own that waits for the others.  No cmocka inside the threads. */
enum { RANKS = 3, SPACE = 4096 };
typedef struct party {
    pthread_mutex_t lock;
    pthread_cond_t turn;
    int arrived, done, round, wrong, count;
    double part[RANKS][SPACE], total[SPACE];
} party;

typedef struct rank {
    party *all;
    int number, kind, calls, status[12];
    iqn *q;
} rank;

static int meeting_sum(double *v, int count, void *ctx)
{
    rank *me = (rank *)ctx;
    party *all = me->all;
    int round, i, r;
    pthread_mutex_lock(&all->lock);
    me->calls++;
    memcpy(all->part[me->number], v, (size_t)count * sizeof *v);
    if (all->arrived++ == 0) all->count = count;
    if (all->count != count || all->done) all->wrong = 1; /* another length, or a rank that has gone on without */
    round = all->round;
    if (all->arrived == RANKS || all->wrong) {
        for (i = 0; i < count; i++)
            for (all->total[i] = 0, r = 0; r < RANKS; r++) all->total[i] += all->part[r][i];
        all->arrived = 0;
        all->round++;
        pthread_cond_broadcast(&all->turn);
    }
    while (all->round == round && !all->wrong) pthread_cond_wait(&all->turn, &all->lock);
    memcpy(v, all->total, (size_t)count * sizeof *v);
    i = all->wrong;
    pthread_mutex_unlock(&all->lock);
    return i;
}

/* All kinds of steps: ordinary; r = 0 on one rank; NaN on one rank; 1e200 (a second sweep); a pair pushed that is zero on
   one rank; bounds; the commit of a merge.                                                */
static void *run_rank(void *arg)
{
    rank *me = (rank *)arg;
    const int n = me->number == 1 ? 0 : 3;
    double x[3] = {0, 0, 0}, h[3], v[3] = {0, 0, 0}, w[3] = {1, 2, 3};
    int k, i, s = 0;
    for (k = 0; k < 8; k++) {
        for (i = 0; i < n; i++) {
            h[i] = cos(i + me->number) - (1.5 + 0.3 * i) * x[i];
            if (k == 3 && me->number == 0) h[i] = x[i];
            if (k == 4 && me->number == 2) h[i] = iqn__nan();
            if (k == 5) h[i] *= 1e200;
            if (me->number == 2) v[i] = i + 1;
        }
        me->status[s++] = iqn_step(me->q, x, h);
        for (i = 0; k == 5 && i < n; i++) x[i] = 0.1 * i;
        if (k == 2) me->status[s++] = iqn_push(me->q, v, w);
        if (k == 6) me->status[s++] = iqn_commit(me->q);
    }
    pthread_mutex_lock(&me->all->lock);
    me->all->done++;
    if (me->all->arrived) me->all->wrong = 1; /* another rank still waits for a sum that this one never calls */
    pthread_cond_broadcast(&me->all->turn);
    pthread_mutex_unlock(&me->all->lock);
    return NULL;
}

static void test_every_rank_calls_the_sum_equally_often(void **state)
{
    static party all;
    static rank each[RANKS];
    pthread_t thread[RANKS];
    int kind, r, k, threads;
    (void)state;
    for (kind = 0; kind < 4; kind++) { /* bit 0: IMVJ, merging; bit 1: bounds */
        void *mem[RANKS];
        memset(&all, 0, sizeof all);
        pthread_mutex_init(&all.lock, NULL);
        pthread_cond_init(&all.turn, NULL);
        for (r = 0; r < RANKS; r++) {
            memset(&each[r], 0, sizeof each[r]);
            each[r].all = &all;
            each[r].number = r;
            each[r].q = make(&mem[r], r == 1 ? 0 : 3, 5, 1);
            CHECK_INT(iqn_set_sum(each[r].q, meeting_sum, &each[r]), IQN_OK);
            if (kind & 1) {
                CHECK_INT(iqn_set(each[r].q, IQN_METHOD, IQN_IMVJ), IQN_OK);
                CHECK_INT(iqn_set(each[r].q, IQN_MERGE, 1), IQN_OK);
            }
            if (kind & 2) {
                CHECK_INT(iqn_set_block(each[r].q, 0, IQN_UPPER, 0.5), IQN_OK);
            }
        }
        for (threads = 0; threads < RANKS; threads++)
            if (pthread_create(&thread[threads], NULL, run_rank, &each[threads]) != 0) {
                pthread_mutex_lock(&all.lock);
                all.wrong = 1;
                pthread_cond_broadcast(&all.turn);
                pthread_mutex_unlock(&all.lock);
                break;
            }
        for (r = 0; r < threads; r++) pthread_join(thread[r], NULL);
        CHECK_INT(all.wrong, 0);
        for (r = 0; r < RANKS; r++) {
            CHECK_INT(each[r].calls, each[0].calls);
            CHECK_INT(iqn_get(each[r].q, IQN_NSUMS), each[0].calls);
            for (k = 0; k < 12; k++) CHECK_INT(each[r].status[k], each[0].status[k]);
            CHECK_INT(iqn_get(each[r].q, IQN_NREFUSED), 1);
            free(mem[r]);
        }
        pthread_mutex_destroy(&all.lock);
        pthread_cond_destroy(&all.turn);
    }
}

typedef struct reader {
    const iqn *q;
    double seen;
} reader;

static void *run_reader(void *arg)
{
    reader *me = (reader *)arg;
    double v[20], w[20];
    int k, j, i;
    for (k = 0; k < 200; k++)
        for (me->seen = iqn_get(me->q, IQN_RESIDUAL) + iqn_get_block(me->q, 0, IQN_VALUE) + iqn_converged(me->q), j = 0; iqn_pair(me->q, j, v, w) == 0; j++)
            for (i = 0; i < 20; i++) me->seen += v[i] * w[i];
    return NULL;
}

/* Any number of objects: each thread solves on its own one as it would alone; and four threads read the same one. */
static void *run_alone(void *arg)
{
    affine *p = (affine *)arg;
    const size_t bytes = iqn_size(p->n, 20, 1);
    void *mem = malloc(bytes);
    iqn *q = NULL;
    int k;
    if (!mem || iqn_make(&q, p->n, 20, 1, mem, bytes) < 0) return NULL;
    for (k = 0; k < 30; k++) {
        affine_apply(p);
        if (iqn_step(q, p->x, p->h) < 0) break;
    }
    free(mem);
    return p;
}

static void test_threads_on_different_objects_and_reading_the_same(void **state)
{
    static affine p[4], reference[4];
    void *mem;
    iqn *q = make(&mem, 20, 6, 1);
    reader readers[4];
    pthread_t thread[8];
    int i, started;
    (void)state;
    affine_make(&p[0], 20, -3, 0.5, 40);
    for (i = 0; i < 5; i++) {
        affine_apply(&p[0]);
        CHECK(iqn_step(q, p[0].x, p[0].h) >= 0);
    }
    for (i = 0; i < 4; i++) {
        affine_make(&p[i], 10 + i, -4, 0.9, 50 + (unsigned)i);
        reference[i] = p[i];
        CHECK(run_alone(&reference[i]) != NULL);
        readers[i].q = q;
        readers[i].seen = 0;
    }
    for (started = 0; started < 8; started++)
        if (pthread_create(&thread[started], NULL, started < 4 ? run_alone : run_reader, started < 4 ? (void *)&p[started] : (void *)&readers[started - 4]) != 0) break;
    for (i = 0; i < started; i++) pthread_join(thread[i], NULL);
    CHECK_INT(started, 8);
    for (i = 0; i < 4; i++) {
        CHECK(memcmp(p[i].x, reference[i].x, sizeof(double) * (size_t)p[i].n) == 0);
        CHECK(readers[i].seen == readers[0].seen && iqn__finite(readers[i].seen) && readers[i].seen != 0);
    }
    free(mem);
}

/* ---- the mathematics of the header's comment, dense and anew in every step ---------------------- */

/* Every step from all pairs by Householder's QR of their vectors: no Gram matrix, no factor that is kept, no units. */
enum { MODEL_N = 10, MODEL_PAIRS = 64, MODEL_BLOCKS = 2 };
enum { MODEL_PLAIN, MODEL_FULL, MODEL_PROBE, MODEL_SMALL };
typedef struct model_pair {
    long double v[MODEL_N], w[MODEL_N], size[MODEL_BLOCKS], drift, curvature, apart;
    int window, dropped;
} model_pair;

typedef struct model {
    /* settings; by_window: IMVJ */
    int columns, windows, by_window, metric, whole, rows, scaling[MODEL_BLOCKS]; /* whole: every block has a weight */
    int ranks, merge; /* ranks with the same numbers */
    long double noise, mixing, omega, growth, limit, given[MODEL_BLOCKS];
    /* what is known */
    model_pair pair[MODEL_PAIRS]; /* newest first */
    int used, window, iteration, chained, kind, unmerged;
    long double r[MODEL_N], h[MODEL_N]; /* of the base */
    long double weight[MODEL_BLOCKS], sum[MODEL_BLOCKS], used_sum[MODEL_BLOCKS], value[MODEL_BLOCKS];
    long double drift, claimed, predicted, slope, steepest, unexplained;
    int affine, nonlinear, exploring, suspicious, idle, surprises, curved, missed, inexact, steady;
    long double first, best, milestone; /* |r| without weights */
    int waited, independent, restarts, restarted;
    /* for the host */
    int in_use, dropped, fell_off, zero, withdrawn, explored, misled;
} model;

typedef struct model_plan {
    int moves, learns, withdrawn, probes;
    long double curvature;
} model_plan;

static int model_block(int i)
{
    return i < 4 ? 0 : 1;
}

static long double model_norm(const model *m, const long double *v, int block) /* of one block, or of all: -1; on all ranks */
{
    long double sum = 0;
    int i;
    for (i = 0; i < MODEL_N; i++)
        if (block < 0 || model_block(i) == block) sum += v[i] * v[i];
    return sqrtl(m->ranks * sum);
}

/* Row i of the root C of the metric M = C'C: on the diagonal, and right of it within the block */
static long double model_root(int i, int j)
{
    if (i == j) return 0.7L + 0.2L * i;
    return j == i + 1 && model_block(i) == model_block(j) ? 0.5L : 0;
}

/* The vector whose Euclidean norm the least squares sees */
static void model_see(const model *m, const long double *v, long double *out)
{
    int i, j;
    for (i = 0; i < MODEL_N; i++) {
        out[i] = m->metric ? 0 : v[i];
        for (j = 0; j < MODEL_N && m->metric; j++) out[i] += model_root(i, j) * v[j];
        out[i] *= m->weight[model_block(i)];
    }
}

static long double model_length(const model *m, const long double *v)
{
    long double seen[MODEL_N];
    model_see(m, v, seen);
    return model_norm(m, seen, -1);
}

static long double model_weighted(const model *m, const long double *v) /* without M: that of a step is not known */
{
    return hypotl(m->weight[0] * model_norm(m, v, 0), m->weight[1] * model_norm(m, v, 1));
}

static void model_forget(model *m, int j)
{
    memmove(m->pair + j, m->pair + j + 1, (size_t)(m->used - j - 1) * sizeof *m->pair);
    m->used--;
}

static void model_forget_window(model *m, int current)
{
    int j;
    for (j = m->used - 1; j >= 0; j--)
        if ((m->pair[j].window == m->window) == current) model_forget(m, j);
}

static void model_keep_windows(model *m, int windows)
{
    int j, count = 0, last = m->window;
    for (j = 0; j < m->used; j++) {
        if (m->pair[j].window != last) count++;
        last = m->pair[j].window;
        if (count > windows) break;
    }
    while (m->used > j) model_forget(m, m->used - 1);
}

/* The scalings of IQN_SCALING.  A sum of residuals is that of the last time when some block's had changed tenfold. */
static void model_weigh(model *m, const long double *r, const long double *h)
{
    int b, update = 0;
    for (b = 0; b < MODEL_BLOCKS; b++) {
        if (m->iteration == 1) m->sum[b] = 0;
        m->sum[b] += model_norm(m, r, b) / model_norm(m, r, -1);
        update |= m->sum[b] >= 10 * m->used_sum[b] || m->sum[b] <= m->used_sum[b] / 10;
    }
    for (b = 0; b < MODEL_BLOCKS; b++) {
        long double size = 1;
        if (update) m->used_sum[b] = m->sum[b];
        if (m->scaling[b] == IQN_BY_VALUE) size = model_norm(m, h, b);
        if (m->scaling[b] == IQN_BY_RESIDUAL) size = model_norm(m, r, b);
        if (m->scaling[b] == IQN_BY_RESIDUAL_SUM) size = m->used_sum[b];
        m->weight[b] = m->given[b] / size;
    }
}

/* s_j^2 of the comment, and the part of it that is noise */
static long double model_noise(const model *m, const model_pair *p)
{
    long double sum = 0;
    int b;
    for (b = 0; b < MODEL_BLOCKS; b++) sum += m->weight[b] * m->weight[b] * p->size[b] * p->size[b];
    return sum * m->noise * m->noise;
}

static int model_weighs_drift(const model *m)
{
    return !m->by_window && !(m->limit > 0);
}

static long double model_doubt(const model *m, const model_pair *p)
{
    const long double aged = model_weighs_drift(m) ? m->drift - p->drift : 0, own = model_length(m, p->v);
    if (m->limit > 0) return 0;
    return model_noise(m, p) + own * own * (aged * aged + p->curvature * p->curvature);
}

/* a = argmin |target + sum a_j v_j|^2 + sum (s_j a_j)^2: Householder's QR of the pairs with the s_j below them.  Returns the
   square of what is left. */
static long double model_solve(const model *m, int kept, const int *of, const long double *target, long double *a)
{
    static long double A[MODEL_PAIRS + 1][MODEL_N + MODEL_PAIRS];
    const int rows = MODEL_N + kept;
    long double left = 0, s, f;
    int i, j, k;
    memset(A, 0, sizeof A);
    for (j = 0; j < kept; j++) {
        model_see(m, m->pair[of[j]].v, A[j]);
        A[j][MODEL_N + j] = sqrtl(model_doubt(m, &m->pair[of[j]]) / m->ranks);
    }
    model_see(m, target, A[kept]);
    for (k = 0; k < kept; k++) {
        for (s = 0, i = k; i < rows; i++) s += A[k][i] * A[k][i];
        s = A[k][k] > 0 ? -sqrtl(s) : sqrtl(s);
        A[k][k] -= s;
        for (j = k + 1; j <= kept; j++) {
            for (f = 0, i = k; i < rows; i++) f += A[k][i] * A[j][i];
            for (f /= s * A[k][k], i = k; i < rows; i++) A[j][i] += f * A[k][i];
        }
        a[k] = s; /* R_kk */
    }
    for (k = kept - 1; k >= 0; k--) {
        for (f = -A[kept][k], j = k + 1; j < kept; j++) f -= A[j][k] * a[j];
        a[k] = f / a[k];
    }
    for (i = kept; i < rows; i++) left += A[kept][i] * A[kept][i];
    return m->ranks * left;
}

/* Is pair j more than its own uncertainty and the noise of the newer ones? */
static int model_trusts(model *m, int kept, const int *of, int j)
{
    model_pair *p = &m->pair[j];
    long double b[MODEL_PAIRS], inherited = 0;
    const long double own = model_length(m, p->v), rest = model_solve(m, kept, of, p->v, b);
    int i;
    p->apart = rest / (own * own);
    if (m->limit > 0) return kept < m->rows && rest >= m->limit * m->limit * own * own;
    if (kept >= m->rows && !(model_doubt(m, p) > 0)) return 0; /* without uncertainty: the next one fits noise */
    for (i = 0; i < kept; i++) inherited += b[i] * b[i] * model_noise(m, &m->pair[of[i]]);
    return rest - inherited > 0.09L * (model_doubt(m, p) + inherited);
}

/* |hx| of a block as the noise of a pair sees it: in a metric times |v|_M / |v| */
static void model_sizes(const model *m, model_pair *p)
{
    model plain = *m;
    long double seen[MODEL_N];
    int b;
    plain.weight[0] = plain.weight[1] = 1;
    model_see(&plain, p->v, seen);
    for (b = 0; b < MODEL_BLOCKS; b++) p->size[b] = m->value[b] * model_norm(m, seen, b) / model_norm(m, p->v, b);
}

/* Where there is no room: the oldest pair, or the one that newer ones explain best. */
static void model_make_room(model *m)
{
    const int oldest = m->used - 1, alone = m->pair[oldest].window == m->window;
    int j, spare = oldest;
    for (j = m->used - 1; j >= 0; j--)
        if (m->pair[j].apart < m->pair[spare].apart) spare = j;
    if (!(m->pair[spare].apart < 0.0025L) || !(m->curved || m->nonlinear || alone)) spare = oldest;
    model_forget(m, model_weighs_drift(m) ? spare : oldest);
    m->fell_off++;
}

static void model_forget_dropped(model *m)
{
    int j;
    for (j = m->used - 1; j >= 0; j--)
        if (m->pair[j].dropped) model_forget(m, j), m->dropped++;
}

static void model_append(model *m, const model_pair *p, long double curvature)
{
    if (m->used == m->columns) model_forget_dropped(m); /* a push finds what the step before has dropped */
    if (m->used == m->columns) model_make_room(m);
    memmove(m->pair + 1, m->pair, (size_t)m->used++ * sizeof *m->pair);
    m->pair[0] = *p;
    m->pair[0].drift = m->drift;
    m->pair[0].curvature = curvature;
    m->pair[0].apart = 1;
    m->pair[0].window = m->window;
    m->pair[0].dropped = 0;
}

static void model_push(model *m, const double *v, const double *w)
{
    model_pair p;
    int i;
    for (i = 0; i < MODEL_N; i++) p.v[i] = (long double)v[i], p.w[i] = (long double)w[i];
    model_sizes(m, &p);
    model_append(m, &p, 0);
    if (m->kind == MODEL_PROBE) m->kind = MODEL_PLAIN;
}

static void model_curve(model *m, long double c)
{
    int j;
    for (j = 0; j < m->used; j++) m->pair[j].curvature = hypotl(m->pair[j].curvature, c);
}

/* After a quasi-Newton step: drift from the second residual of a window, or surprise; what becomes of a bad step.  A v that is not
   three times its noise tells nothing of H, nor does a probe of one that is not 50 times. */
static void model_judge_full(model *m, const model_pair *new_pair, long double now, long double growth, model_plan *p)
{
    const int may = m->whole && m->growth > 0, old = m->used > 0 && m->pair[m->used - 1].window != m->window;
    const long double stands_out = model_length(m, new_pair->v) / sqrtl(model_noise(m, new_pair));
    const int tells = stands_out > 3;
    const int bad = may && growth > (m->nonlinear ? fmaxl(1, m->growth) : m->growth) && (m->nonlinear || stands_out > 50);
    int stale = 0;
    if (model_weighs_drift(m) && m->iteration == 2 && m->claimed > 0) {
        m->drift += 0.01L * fminl(1, now / m->claimed);
        stale = growth > 1 && (m->nonlinear || !m->curved);
        if (m->nonlinear && m->steady == 0) m->steady = now <= 0.1L * m->claimed;
    }
    if (m->steady == 1 && (growth > 2 || stale)) m->steady = -1;
    if (stale) {
        model_forget_window(m, 0);
        m->unexplained = (long double)INFINITY, m->idle = 0;
        m->misled++;
    } else if (!old && !m->nonlinear && tells && model_weighs_drift(m) && m->growth > 0 &&
               now >= 10 * fmaxl(1, m->steepest) * m->predicted) {
        if (growth > 1) {
            if (++m->surprises > 1) m->curved = 1;
            model_curve(m, 0.01L);
        } else if (growth > 0.1L && growth < 0.5L && ++m->missed == 3 && !m->inexact) {
            m->inexact = 1;
            model_curve(m, 0.01L);
        }
    }
    m->suspicious = m->nonlinear && growth > 0.3L;
    if (stale && may) {
        p->moves = 0;
        return;
    }
    if (!bad && m->nonlinear) {
        p->curvature = 0.005L * growth;
        model_curve(m, 0.01L * growth);
    }
    if (!bad || (!m->nonlinear && m->affine)) {
        if (!m->nonlinear && m->inexact) p->curvature = 0.01L * growth;
        return;
    }
    p->withdrawn = 1;
    p->moves = 0;
    p->probes = !m->nonlinear;
    if (!m->nonlinear) return;
    p->learns = 0;
    model_curve(m, 0.1L);
}

/* A tenth of the step that failed: is v a tenth of its v? */
static void model_judge_probe(model *m, const model_pair *new_pair, model_plan *p)
{
    long double off[MODEL_N];
    int i;
    for (i = 0; i < MODEL_N; i++) off[i] = 10 * new_pair->v[i] - m->pair[0].v[i];
    p->moves = 0;
    if (model_length(m, off) < 0.3L * model_length(m, m->pair[0].v)) {
        m->affine = 1;
        p->learns = 0;
        return;
    }
    m->nonlinear = m->exploring = m->suspicious = 1;
    model_forget_window(m, 1);
    model_curve(m, 0.1L);
    p->curvature = 1e-6L;
}

/* The pair of this iterate and the base; what becomes of the base */
static void model_learn(model *m, const long double *x, const long double *r, const long double *h, int edited, model_plan *p)
{
    const long double now = model_length(m, r), before = model_length(m, m->r), growth = now / before;
    const int kind = edited ? MODEL_PLAIN : m->kind;
    long double moved[MODEL_N];
    model_pair new_pair;
    int i;
    for (i = 0; i < MODEL_N; i++) {
        new_pair.v[i] = r[i] - m->r[i];
        new_pair.w[i] = h[i] - m->h[i];
        moved[i] = x[i] - (m->h[i] - m->r[i]);
    }
    model_sizes(m, &new_pair);
    if (!edited && kind != MODEL_PROBE) {
        m->slope = model_weighted(m, new_pair.v) / model_weighted(m, moved);
        m->steepest = fmaxl(m->steepest, m->slope);
    }
    if (kind == MODEL_FULL) model_judge_full(m, &new_pair, now, growth, p);
    else if (kind == MODEL_PROBE) model_judge_probe(m, &new_pair, p);
    else if (kind == MODEL_SMALL) {
        p->curvature = 1e-6L;
        p->moves = growth < 0.5L;
    } else if (!edited && growth > 1 && m->growth > 0 && m->whole) { /* a relaxation that raised |r| by more than noise */
        const long double length = model_length(m, new_pair.v);
        p->moves = !(m->limit > 0) && !(length * length > 0.09L * model_noise(m, &new_pair));
    }
    if (p->learns) model_append(m, &new_pair, p->curvature);
}

/* End of the group that begins with pair j: everything; or the current window with so many past ones, then one each. */
static int model_group_end(const model *m, int j)
{
    int windows = j == 0 && m->windows > 0 ? m->windows : 0, last;
    if (!m->by_window) return m->used;
    last = m->pair[j].window;
    if (last != m->window && windows > 0) windows--; /* of the current window there is none yet */
    for (; j < m->used; j++) {
        if (m->pair[j].window == last) continue;
        if (windows-- == 0) break;
        last = m->pair[j].window;
    }
    return j;
}

/* Which pairs, and their coefficients at the base; each group sees what the newer ones leave: in rest.  Returns how many. */
static int model_coefficients(model *m, int *of, long double *a, long double *rest)
{
    int kept = 0, base, i, j, k, end;
    memcpy(rest, m->r, sizeof m->r);
    for (j = 0; j < m->used; j = end) {
        base = kept;
        for (end = model_group_end(m, j); j < end; j++) {
            if (model_trusts(m, kept - base, of + base, j)) of[kept++] = j;
            else m->pair[j].dropped = 1;
        }
        model_solve(m, kept - base, of + base, rest, a + base);
        for (i = 0; i < MODEL_N; i++)
            for (k = base; k < kept; k++) rest[i] += a[k] * m->pair[of[k]].v[i];
    }
    if (m->iteration > 1) return kept;
    for (m->claimed = 0, j = 0; j < kept; j++)
        if (m->pair[of[j]].window != m->window) m->claimed = hypotl(m->claimed, a[j] * model_length(m, m->pair[of[j]].v));
    return kept;
}

/* x = x_base + factor[0] r_base + factor[1] W a + factor[2] V a, of a nonlinear run; the kind of this step */
static int model_explore(model *m, long double left, long double *factor)
{
    const long double slope = fmaxl(1, m->slope), along = fminl(1, 0.1L / (slope * left)), mixing = m->mixing / slope;
    const int suspicious = m->suspicious;
    m->idle++;
    if (left < 0.9L * m->unexplained) m->unexplained = left, m->idle = 0;
    m->suspicious = 0;
    factor[0] = mixing, factor[1] = 1, factor[2] = mixing - 1;
    if (m->steady == 1 && left * m->steepest <= 1) { /* as on an affine H */
        factor[0] = m->mixing, factor[2] = m->mixing - 1;
        return MODEL_FULL;
    }
    if (suspicious) factor[0] *= 0.1L, factor[1] *= 0.1L, factor[2] *= 0.1L;
    else if (left > 0.1L && m->idle < 3) factor[0] = factor[2] = along, factor[1] = 0;
    else return MODEL_FULL;
    m->explored++;
    return MODEL_SMALL;
}

/* Iterations since |r| fell by a tenth or a new independent pair came; after half of the patience all starts anew. */
enum { MODEL_PATIENCE = 6 };

static void model_watch(model *m, const long double *r)
{
    long double now = 0;
    int i;
    for (i = 0; i < MODEL_N; i++) now += r[i] * r[i];
    now = sqrtl(now);
    if (m->iteration == 1) {
        m->first = m->best = m->milestone = now;
        m->waited = m->independent = 0;
        return;
    }
    m->best = fminl(m->best, now);
    m->waited++;
    if (now < 0.9L * m->milestone) m->milestone = now, m->waited = 0;
}

static void model_start_over(model *m, model_plan *p)
{
    const int newest = p->learns;
    if (m->waited - 1 < MODEL_PATIENCE / 2 || m->restarts == 3 || !(m->growth > 0) || m->best < 1e-3L * m->first) return;
    if (m->used == newest || !model_weighs_drift(m)) return;
    while (m->used > newest) model_forget(m, m->used - 1);
    m->waited = m->independent = m->suspicious = 0;
    m->unexplained = (long double)INFINITY, m->idle = 0;
    m->restarts++, m->restarted++;
    if (newest) return;
    p->moves = 1;
    p->probes = p->withdrawn = 0;
}

/* The status of a step whose patience is at an end, or that of the step */
static int model_status(const model *m, const long double *r, int status)
{
    long double now = 0;
    int i;
    for (i = 0; i < MODEL_N; i++) now += r[i] * r[i];
    if (m->waited < MODEL_PATIENCE) return status;
    if (sqrtl(now) > 1e3L * m->best) return IQN_DIVERGED;
    return m->best < 1e-3L * m->first ? IQN_NOISE : IQN_STALLED;
}

static void model_note_independent(model *m, int kept, const int *of)
{
    int j, independent = 0;
    for (j = 0; j < kept; j++) independent += m->pair[of[j]].window == m->window;
    if (independent <= m->independent) return;
    if (m->best > 1e-3L * m->first) m->waited = 0;
    m->independent = independent;
}

/* The next x; returns the status.  edited: x is not what the last step gave. */
static int model_step(model *m, const double *x_in, const double *hx, int edited, long double *next)
{
    long double x[MODEL_N], r[MODEL_N], h[MODEL_N], a[MODEL_PAIRS], rest[MODEL_N], factor[3];
    int of[MODEL_PAIRS], kept = 0, i, j;
    model_plan p = {1, 1, 0, 0, 0};
    for (i = 0; i < MODEL_N; i++) {
        x[i] = (long double)x_in[i];
        h[i] = (long double)hx[i];
        r[i] = h[i] - x[i];
    }
    for (i = 0; i < MODEL_BLOCKS; i++) m->value[i] = model_norm(m, h, i);
    model_forget_dropped(m);
    m->iteration++;
    model_watch(m, r);
    if (!m->by_window && m->chained) model_keep_windows(m, m->windows < 0 ? INT_MAX : m->windows);
    if (m->chained) {
        model_learn(m, x, r, h, edited, &p);
        model_start_over(m, &p);
        m->withdrawn += p.withdrawn;
    } else m->exploring = m->nonlinear && m->growth > 0;
    if (p.moves) {
        memcpy(m->r, r, sizeof r);
        memcpy(m->h, h, sizeof h);
        m->unexplained = (long double)INFINITY;
    }
    m->chained = 1;
    model_weigh(m, r, h);
    m->predicted = model_length(m, m->r);
    if (p.probes) { /* a tenth of the way to the iterate whose pair is the newest */
        m->kind = MODEL_PROBE;
        for (i = 0; i < MODEL_N; i++) next[i] = m->h[i] - m->r[i] + 0.1L * (m->pair[0].w[i] - m->pair[0].v[i]);
    } else {
        kept = model_coefficients(m, of, a, rest);
        model_note_independent(m, kept, of);
        factor[0] = kept ? m->mixing : m->omega;
        factor[1] = 1, factor[2] = m->mixing - 1;
        m->kind = kept ? MODEL_FULL : MODEL_PLAIN;
        if (kept && m->exploring) m->kind = model_explore(m, model_length(m, rest) / m->predicted, factor);
        if (m->kind == MODEL_FULL) m->predicted = model_length(m, rest);
        for (i = 0; i < MODEL_N; i++) {
            next[i] = m->h[i] + (factor[0] - 1) * m->r[i];
            for (j = 0; j < kept; j++)
                next[i] += a[j] * (factor[1] * m->pair[of[j]].w[i] + factor[2] * m->pair[of[j]].v[i]);
        }
    }
    for (m->in_use = m->used, j = 0; j < m->used; j++) m->in_use -= m->pair[j].dropped;
    if (p.withdrawn) return model_status(m, r, IQN_WITHDRAWN);
    if (kept == 0) return model_status(m, r, p.probes ? IQN_OK : IQN_RELAXED);
    if (m->kind == MODEL_SMALL) return model_status(m, r, IQN_EXPLORED);
    return model_status(m, r, m->in_use < m->used ? IQN_DROPPED : IQN_OK);
}

static void model_end_window(model *m)
{
    int j;
    for (j = 0; j < m->used; j++) m->pair[j].dropped = 0;
    m->iteration = m->kind = m->chained = m->affine = m->surprises = m->missed = m->restarts = m->suspicious = 0;
    m->steepest = m->nonlinear ? m->steepest / 2 : 0;
}

static void model_commit(model *m)
{
    int j;
    model_end_window(m);
    m->window++;
    if (m->by_window && m->merge > 0 && ++m->unmerged == m->merge)
        for (m->unmerged = j = 0; j < m->used; j++) m->pair[j].window = m->window - 1;
    if (!m->by_window) model_keep_windows(m, m->windows < 0 ? INT_MAX : m->windows > 1 ? m->windows : 1);
}

static void model_discard(model *m)
{
    model_end_window(m);
    model_forget_window(m, 1);
}

/* A map that is affine but for `curve`; a window changes it, little or much. */
static void model_map(int window, double change, double curve, const double *x, double *hx)
{
    int i;
    for (i = 0; i < MODEL_N; i++) {
        const double slope = 0.9 - 0.35 * i + change * sin(3 * i + window);
        hx[i] = (i < 4 ? 1 : 40) * cos(i + 0.2 * window) + slope * x[i] + 0.3 * x[(i + 1) % MODEL_N] - 0.2 * x[(i + 7) % MODEL_N] +
                curve * sin(x[i]);
    }
}

static void model_metric(const double *r, double *mr) /* C'C r */
{
    int i, j, k;
    for (i = 0; i < MODEL_N; i++)
        for (mr[i] = 0, k = 0; k < MODEL_N; k++)
            for (j = 0; j < MODEL_N; j++) mr[i] += (double)(model_root(k, i) * model_root(k, j)) * r[j];
}

typedef struct model_run {
    double noise, change, curve, mixing, weight, growth, limit;
    int scaling, windows, columns, method, steps, windows_run;
    int metric, ranks, edit, push, discard, merge; /* edit to merge: every so many steps or windows; 0: never */
} model_run;

/* All ranks have the same numbers as this one. */
static int sum_of_like_ranks(double *v, int count, void *ctx)
{
    int i;
    for (i = 0; i < count; i++) v[i] *= *(const int *)ctx;
    return 0;
}

static iqn *model_start(const model_run *run, model *m, void **mem)
{
    iqn *q = make(mem, MODEL_N, run->columns, MODEL_BLOCKS);
    int b;
    memset(m, 0, sizeof *m);
    m->columns = run->columns;
    m->windows = run->windows;
    m->by_window = run->method == IQN_IMVJ;
    m->metric = run->metric;
    m->whole = run->weight > 0;
    m->ranks = run->ranks > 1 ? run->ranks : 1;
    m->merge = run->merge;
    m->rows = m->ranks * (m->whole ? MODEL_N : 4);
    m->noise = (long double)run->noise;
    m->mixing = (long double)run->mixing;
    m->growth = (long double)run->growth;
    m->limit = (long double)run->limit;
    m->omega = 0.25L;
    m->unexplained = (long double)INFINITY;
    CHECK_INT(iqn_set(q, IQN_METHOD, run->method), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 4), IQN_OK);
    CHECK_INT(iqn_set_block(q, 1, IQN_LENGTH, MODEL_N - 4), IQN_OK);
    for (b = 0; b < MODEL_BLOCKS; b++) {
        m->weight[b] = m->given[b] = b ? (long double)run->weight : 1;
        m->scaling[b] = run->scaling;
        CHECK_INT(iqn_set_block(q, b, IQN_SCALING, run->scaling), IQN_OK);
        CHECK_INT(iqn_set_block(q, b, IQN_WEIGHT, (double)m->given[b]), IQN_OK);
    }
    if (run->ranks > 0) CHECK_INT(iqn_set_sum(q, sum_of_like_ranks, (void *)(uintptr_t)&run->ranks), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MERGE, run->merge), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_GROWTH, run->growth), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, run->limit), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_PATIENCE, MODEL_PATIENCE), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, (double)m->omega), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, run->noise), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MIXING, run->mixing), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_WINDOWS, m->windows), IQN_OK);
    return q;
}

/* What the object knows is what the model knows. */
static void model_compare(const model *m, const iqn *q, double size)
{
    double v[MODEL_N], w[MODEL_N];
    const iqn__view view = iqn__open(q);
    int i, j, taken = 0, seen[MODEL_PAIRS];
    CHECK_NEAR(q->drift, (double)m->drift, 1e-9);
    CHECK_NEAR(q->slope, (double)m->slope, 1e-7 * (1 + (double)m->slope));
    CHECK_NEAR(q->steepest, (double)m->steepest, 1e-7 * (1 + (double)m->steepest));
    CHECK_NEAR(iqn__value_of(q->claimed), (double)m->claimed, 1e-7 * size);
    CHECK_NEAR(iqn_get(q, IQN_PREDICTED), (double)m->predicted, 1e-7 * size);
    CHECK_INT(q->affine, m->affine);
    CHECK_INT(q->nonlinear, m->nonlinear);
    CHECK_INT(q->exploring, m->exploring);
    CHECK_INT(q->suspicious, m->suspicious);
    CHECK_INT(q->idle, m->idle);
    CHECK_INT(q->surprises, m->surprises);
    CHECK_INT(q->curved, m->curved);
    CHECK_INT(q->missed, m->missed);
    CHECK_INT(q->inexact, m->inexact);
    CHECK_INT(q->steady, m->steady);
    CHECK_INT(iqn_get(q, IQN_PAIRS), m->in_use);
    CHECK_INT(iqn_get(q, IQN_NDROPPED), m->dropped);
    CHECK_INT(iqn_get(q, IQN_NFULL), m->fell_off);
    CHECK_INT(iqn_get(q, IQN_NWITHDRAWN), m->withdrawn);
    CHECK_INT(iqn_get(q, IQN_NEXPLORED), m->explored);
    CHECK_INT(iqn_get(q, IQN_NRESTARTED), m->restarted);
    CHECK_INT(q->used, m->used);
    for (i = 0; i < view.slots; i++) seen[i] = 0;
    for (i = 0; i < view.slots; i++) seen[view.order[i]]++;
    for (i = 0; i < view.slots; i++) CHECK_INT(seen[i], 1); /* used slots, free ones */
    for (j = 0; j < m->used; j++) {
        const int slot = view.order[j];
        CHECK_NEAR(view.curvature[slot], (double)m->pair[j].curvature, 1e-7 * (1e-6 + (double)m->pair[j].curvature));
        CHECK_NEAR(view.drift[slot], (double)m->pair[j].drift, 1e-9);
        CHECK_NEAR(view.apart[slot], (double)m->pair[j].apart, 1e-7);
        if (m->pair[j].dropped) continue;
        CHECK_INT(iqn_pair(q, taken++, v, w), IQN_OK);
        for (i = 0; i < MODEL_N; i++) {
            CHECK_NEAR(v[i], (double)m->pair[j].v[i], 1e-13 * size);
            CHECK_NEAR(w[i], (double)m->pair[j].w[i], 1e-13 * size);
        }
    }
    CHECK_INT(iqn_pair(q, taken, v, w), IQN_EARG);
}

/* What a step leaves in its work arrays and in free columns means nothing to the next one: it may as well be NaN. */
static void poison(const iqn *q)
{
    const iqn__view m = iqn__open(q);
    const size_t slots = (size_t)m.slots, real = sizeof(double), B = (size_t)q->blocks;
    int j, i, b;
    memset(m.sums, 0xff, B * (2 * slots + 4) * sizeof *m.sums);
    memset(m.Lh, 0xff, (size_t)((const char *)m.y - (const char *)m.Lh)); /* the factor and the solution */
    memset(m.y, 0xff, slots * sizeof *m.y);
    memset(m.message, 0xff, (size_t)((const char *)m.size - (const char *)m.message)); /* a message, the coefficients */
    memset(m.noise, 0xff, (size_t)((const char *)m.order - (const char *)m.noise)); /* by position */
    memset(m.kept, 0x7f, slots * sizeof *m.kept);
    memset(m.r, 0xff, (size_t)((const char *)m.V - (const char *)m.r));
    for (j = q->used; j < m.slots; j++) {
        const int slot = m.order[j];
        for (b = 0; b < q->blocks; b++) {
            const ptrdiff_t at = b * (ptrdiff_t)slots;
            for (i = 0; i < m.slots; i++) {
                memset(m.gram + (at + slot) * (ptrdiff_t)slots + i, 0xff, sizeof *m.gram);
                memset(m.gram + (at + i) * (ptrdiff_t)slots + slot, 0xff, sizeof *m.gram);
            }
            memset(m.Vr + at + slot, 0xff, sizeof *m.Vr);
            memset(m.size + at + slot, 0xff, real);
            memset(m.v_bound + at + slot, 0x7f, sizeof *m.v_bound);
        }
        for (i = 0; i < m.slots; i++) {
            memset(m.S + slot * (ptrdiff_t)slots + i, 0xff, sizeof *m.S);
            memset(m.S + i * (ptrdiff_t)slots + slot, 0xff, sizeof *m.S);
        }
        memset(m.drift + slot, 0xff, real);
        memset(m.curvature + slot, 0xff, real);
        memset(m.apart + slot, 0xff, real);
        m.exponent[slot] = m.window[slot] = INT_MAX;
        if (slot == q->base) continue;
        memset(m.V + slot * q->n, 0xff, (size_t)q->n * real);
        memset(m.W + slot * q->n, 0xff, (size_t)q->n * real);
    }
}

typedef struct model_seen { /* of all runs: nothing must be missing */
    int dropped, aged, crowded, withdrawn, affine, nonlinear, explored, surprised, curved, inexact, misled, fell_off, restarted;
} model_seen;

static void model_follow(const model_run *run, model_seen *seen)
{
    static model m;
    void *mem;
    iqn *q = model_start(run, &m, &mem);
    double x[MODEL_N], h[MODEL_N], r[MODEL_N], mr[MODEL_N], w[MODEL_N];
    int window, k, i, n = 0, edited, status;
    for (i = 0; i < MODEL_N; i++) x[i] = 0.1 * i;
    for (window = 0; window < run->windows_run; window++) {
        for (k = 0; k < run->steps + window % 2; k++, n++) {
            long double next[MODEL_N];
            double size = 1;
            if ((edited = run->edit > 0 && n % run->edit == run->edit - 1)) x[n % MODEL_N] += 3;
            model_map(window, run->change, run->curve, x, h);
            for (i = 0; i < MODEL_N; i++) r[i] = h[i] - x[i], size = fmax(size, fabs(x[i]) + fabs(h[i]));
            model_metric(r, mr);
            status = model_step(&m, x, h, edited, next);
            CHECK_INT(fenced_step(q, x, h, run->metric ? mr : NULL), status);
            for (i = 0; i < MODEL_N; i++) size = fmax(size, fabs((double)next[i]));
            for (i = 0; i < MODEL_N; i++) CHECK_NEAR(x[i], (double)next[i], 1e-9 * size);
            seen->crowded += m.in_use > MODEL_N;
            seen->affine += m.affine;
            seen->surprised += m.surprises;
            model_compare(&m, q, size);
            poison(q);
            if (run->push == 0 || n % run->push != run->push - 1) continue;
            for (i = 0; i < MODEL_N; i++) r[i] = cos(n + 2 * i), w[i] = sin(3 * n + i);
            model_metric(r, mr);
            CHECK_INT(fenced_push(q, r, w, run->metric ? mr : NULL), IQN_OK);
            model_push(&m, r, w);
        }
        if (run->discard > 0 && window % run->discard == run->discard - 1) {
            CHECK_INT(iqn_discard(q), IQN_OK);
            model_discard(&m);
        } else {
            CHECK_INT(iqn_commit(q), IQN_OK);
            model_commit(&m);
        }
    }
    seen->dropped += m.dropped;
    seen->aged += m.drift > 0;
    seen->withdrawn += m.withdrawn;
    seen->nonlinear += m.nonlinear;
    seen->explored += m.explored;
    seen->curved += m.curved;
    seen->inexact += m.inexact;
    seen->misled += m.misled;
    seen->fell_off += m.fell_off;
    seen->restarted += m.restarted;
    free(mem);
}

/* Noise, drift, scalings, mixing, past windows, probes, small steps, a metric, a host that edits and pushes: x, the pairs, what
   is known of H and the counters are those of the model. */
static void test_every_step_is_that_of_the_comment(void **state)
{
    static const model_run runs[] = {
        {1e-6, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-6, 2, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {3e-3, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {0.03, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 2, 0, 0, 0, 0},
        {0.1, 1, 0.01, 0.6, 3, 0, 0, IQN_BY_VALUE, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {3e-3, 0.3, 0.01, 1, 0.1, 0, 0, IQN_BY_VALUE, 1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {3e-3, 0.3, 0.01, 0.4, 2, 0, 0, IQN_BY_RESIDUAL, 2, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-6, 1, 0.01, 1, 1, 0, 0, IQN_BY_RESIDUAL, 0, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {3e-3, 0.3, 0.01, 1, 0.5, 0, 0, IQN_BY_RESIDUAL_SUM, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-6, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_RESIDUAL_SUM, 1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-6, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 5, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {0.03, 1, 0.01, -0.5, 7, 0, 0, IQN_BY_RESIDUAL_SUM, 3, 7, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-3, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, 0, 40, IQN_IMVJ, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-3, 0.3, 0.01, 0.5, 3, 0, 0, IQN_BY_VALUE, 1, 40, IQN_IMVJ, 4, 6, 0, 3, 0, 0, 0, 2},
        {0.03, 1, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, 2, 40, IQN_IMVJ, 4, 5, 0, 0, 0, 0, 0, 0},
        {1e-3, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_RESIDUAL, -1, 9, IQN_IMVJ, 4, 5, 0, 0, 0, 0, 0, 0},
        {0.3, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        {0.2, 0.3, 0.01, 1, 1, 0, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 4, 5, 0, 0, 0, 0, 0, 0},
        /* steps taken back */
        {1e-6, 0.3, 0.01, 1, 1, 2, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 14, 3, 0, 0, 0, 0, 0, 0},
        {1e-6, 0.3, 3, 1, 1, 2, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 14, 3, 0, 3, 0, 0, 0, 0},
        {1e-4, 0.3, 8, 0.7, 2, 3, 0, IQN_BY_VALUE, -1, 30, IQN_ILS, 20, 3, 0, 0, 0, 0, 0, 0},
        {1e-4, 2, 20, 1, 1, 5, 0, IQN_BY_RESIDUAL, 2, 12, IQN_ILS, 20, 3, 0, 0, 0, 0, 2, 0},
        {1e-4, 0.3, 5, 1, 1, 2, 0, IQN_BY_WEIGHT, 1, 40, IQN_IMVJ, 20, 3, 0, 0, 0, 0, 0, 0},
        {1e-3, 0.3, 0.5, 1, 1, 20, 0, IQN_BY_WEIGHT, -1, 6, IQN_ILS, 16, 3, 0, 0, 0, 0, 0, 0},
        {1e-4, 0.3, 3, 1, 1, 2, 0, IQN_BY_RESIDUAL_SUM, -1, 40, IQN_ILS, 20, 3, 0, 0, 7, 0, 0, 0},
        {1e-3, 0.3, 3, 1, 3, 2, 0, IQN_BY_WEIGHT, -1, 20, IQN_ILS, 20, 3, 0, 2, 0, 5, 2, 0},
        {1e-3, 0.3, 3, 1, 1, 2, 1e-3, IQN_BY_WEIGHT, 0, 20, IQN_ILS, 8, 6, 0, 0, 0, 0, 0, 0},
        {1e-4, 0.3, 0.3, 1, 1, 5, 0, IQN_BY_WEIGHT, -1, 60, IQN_IMVJ, 5, 9, 0, 0, 0, 0, 4, 3},
        {1e-4, 0.3, 3, 1, 1, 1, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 14, 2, 0, 0, 0, 0, 0, 0},
        {1e-4, 0.3, 3, 2, 1, 0, 0, IQN_BY_WEIGHT, 0, 40, IQN_ILS, 12, 2, 0, 0, 0, 0, 0, 0},
        {1e-3, 0.3, 3, 1, 0, 2, 0, IQN_BY_VALUE, -1, 40, IQN_ILS, 12, 3, 0, 0, 0, 4, 0, 0},
        {0, 0.3, 3, 0.5, 0, 2, 1e-2, IQN_BY_WEIGHT, 1, 40, IQN_ILS, 8, 3, 0, 1, 0, 0, 0, 0},
        /* in a metric */
        {1e-3, 0.3, 0.01, 1, 2, 5, 0, IQN_BY_WEIGHT, -1, 40, IQN_ILS, 6, 4, 1, 0, 0, 0, 0, 0},
        {1e-3, 1, 4, 0.8, 1, 2, 0, IQN_BY_VALUE, -1, 30, IQN_ILS, 16, 3, 1, 2, 5, 6, 0, 0},
        {1e-2, 0.3, 1, 1, 1, 2, 0, IQN_BY_RESIDUAL, 1, 30, IQN_IMVJ, 10, 4, 1, 0, 0, 4, 3, 1},
    };
    model_seen seen;
    size_t k;
    (void)state;
    memset(&seen, 0, sizeof seen);
    for (k = 0; k < sizeof runs / sizeof *runs; k++) model_follow(runs + k, &seen);
    CHECK(seen.dropped > 5);
    CHECK(seen.aged > 5);
    CHECK(seen.crowded > 5); /* more uncertain pairs than rows take part */
    CHECK(seen.withdrawn > 5);
    CHECK(seen.affine > 0);
    CHECK(seen.nonlinear > 3);
    CHECK(seen.explored > 20);
    CHECK(seen.surprised > 0);
    CHECK(seen.curved > 0);
    CHECK(seen.inexact > 0);
    CHECK(seen.misled > 0);
    CHECK(seen.fell_off > 5);
    CHECK(seen.restarted > 0);
}

/* In two rows with a weight the two newest pairs are nearly parallel, so that rounding leaves more than 1e-14 of a third
   one: it is not kept, for nothing says that pairs are uncertain. */
static void test_exact_pairs_are_at_most_as_many_as_rows(void **state)
{
    int k, t, way;
    (void)state;
    for (way = 0; way < 3; way++)
        for (t = 0; t < 20; t++) {
            void *mem;
            iqn *q = make(&mem, 4, 10, 2);
            double x[4] = {1, 2, 3, 4}, h[4] = {2, 4, 5, 9};
            CHECK_INT(iqn_set_block(q, 1, IQN_WEIGHT, 0), IQN_OK);
            CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0), IQN_OK);
            if (way == 0) CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-16), IQN_OK);
            if (way == 1) CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
            for (k = 0; k < 5; k++) {
                const double v[4] = {k < 3 ? sin(t + k) : 1, k < 3 ? 1 : 1e-8 * cos(t + 2 * k), sin(k), 1}, w[4] = {1, k, t, 1};
                CHECK_INT(iqn_push(q, v, w), IQN_OK);
            }
            CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
            CHECK_INT(iqn_get(q, IQN_PAIRS), 2);
            free(mem);
        }
}

/* The host may answer what it likes: hx = x + growth r */
static int answer_with(iqn *q, double *x, const double *r, double growth)
{
    double h[2];
    int i;
    for (i = 0; i < 2; i++) h[i] = x[i] + growth * r[i];
    return iqn_step(q, x, h);
}

static double curvature_of_pair(const iqn *q, int j)
{
    const iqn__view m = iqn__open(q);
    return m.curvature[m.order[j]];
}

/* In a nonlinear run a full step that left growth |r| makes every pair curved by 0.01 growth, and its own by half of that;
   one that is taken back makes no pair, and those there are curved by a tenth. */
static void test_a_full_step_of_a_nonlinear_run_ages_the_pairs(void **state)
{
    static const double growth[] = {0.25, 3, 100};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof growth / sizeof *growth; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 10, 1);
        double x[2] = {1, 2}, h[2], r[2];
        int i, t, taken_back = growth[k] > 5;
        for (t = 0; t < 2; t++) { /* one pair, then a full step */
            h[0] = 1 + 0.5 * x[0], h[1] = 3 - 2 * x[1];
            for (i = 0; i < 2; i++) r[i] = h[i] - x[i];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        q->nonlinear = 1;
        CHECK_INT(answer_with(q, x, r, growth[k]) == IQN_WITHDRAWN, taken_back);
        CHECK_INT(q->used, taken_back ? 1 : 2);
        CHECK_NEAR(curvature_of_pair(q, q->used - 1), taken_back ? 0.1 : 0.01 * growth[k], 1e-15);
        if (!taken_back) CHECK_NEAR(curvature_of_pair(q, 0), 0.005 * growth[k], 1e-15);
        free(mem);
    }
}

/* Pairs of past windows after the second residual: they stay where |r| fell, and go where it rose; in a curved run they stay.
   Where they go the new pair stays, and the base is the better iterate - not so without taking back, nor where the least squares
   sees a part of the residual only. */
static void test_stale_pairs_go_after_the_second_residual(void **state)
{
    static const struct {
        double growth;
        int curved, nonlinear, stay, without;
    } row[] = {{0.9, 0, 0, 1, 0}, {2, 0, 0, 0, 0}, {20, 0, 0, 0, 0}, {2, 1, 0, 1, 0},  {0.9, 0, 1, 1, 0},
               {2, 0, 1, 0, 0},   {2, 1, 1, 0, 0}, {20, 0, 1, 0, 0}, {20, 1, 1, 0, 0}, {20, 0, 0, 0, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 10, 1);
        const iqn__view m = iqn__open(q);
        double x[2] = {1, 2}, h[2], r[2] = {0, 0}, before;
        int i, t, j, old = 0;
        for (t = 0; t < 4; t++) {
            h[0] = 1 + t + 0.5 * x[0], h[1] = 3 - 2 * x[1];
            for (i = 0; i < 2; i++) r[i] = h[i] - x[i];
            CHECK(iqn_step(q, x, h) >= 0);
            if (t == 2) CHECK_INT(iqn_commit(q), IQN_OK);
        }
        CHECK_INT(q->iterations, 1);
        q->curved = row[k].curved, q->nonlinear = row[k].nonlinear, q->kind = IQN__FULL;
        if (row[k].without) CHECK_INT(iqn_set(q, IQN_GROWTH, 0), IQN_OK);
        before = iqn__value_of(m.block->base_residual);
        CHECK(answer_with(q, x, r, row[k].growth) != IQN_WITHDRAWN);
        for (j = 0; j < q->used; j++) old += m.window[m.order[j]] != q->window;
        CHECK_INT(old > 0, row[k].stay);
        if (!row[k].stay) CHECK_INT(q->used, 1);
        CHECK_NEAR(iqn__value_of(m.block->base_residual) / before, row[k].stay || row[k].without ? row[k].growth : 1, 1e-12);
        free(mem);
    }
}

/* What a step of one window made doubtful is no doubt of the next: commit and discard end it. */
static void test_a_disappointment_ends_with_its_window(void **state)
{
    int k, i, t;
    (void)state;
    for (k = 0; k < 2; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 10, 1);
        double x[2] = {1, 2}, h[2], r[2] = {0, 0};
        for (t = 0; t < 2; t++) { /* one pair, then a full step */
            h[0] = 1 + 0.5 * x[0], h[1] = 3 - 2 * x[1];
            for (i = 0; i < 2; i++) r[i] = h[i] - x[i];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        q->nonlinear = 1;
        CHECK_INT(iqn_set(q, IQN_TOL_ABSOLUTE, 1e3), IQN_OK); /* the disappointing step meets the limit: nobody tries the next */
        CHECK_INT(answer_with(q, x, r, 0.5), IQN_SOLVED);
        CHECK_INT(q->suspicious, 1);
        CHECK_INT(k ? iqn_commit(q) : iqn_discard(q), IQN_OK);
        CHECK_INT(q->suspicious, 0);
        free(mem);
    }
}

/* |hx| times |v|_M / |v| is a norm as all are, f 2^e with f in [0.5, 1), whatever M is. */
static void test_the_scale_of_noise_is_a_norm(void **state)
{
    double M;
    (void)state;
    for (M = 0.125; M < 9; M *= 1.25) {
        void *mem;
        iqn *q = make(&mem, 2, 10, 1);
        const iqn__view m = iqn__open(q);
        double x[2] = {1, 2}, h[2] = {3, 5}, y[2];
        iqn__input in;
        iqn__norm size;
        int i, t;
        for (t = 0; t < 2; t++) {
            for (i = 0; i < 2; i++) y[i] = M * (h[i] - x[i]);
            CHECK(iqn_step_metric(q, x, h, y) >= 0);
        }
        for (i = 0; i < 2; i++) y[i] = M * (h[i] - x[i]);
        memset(&in, 0, sizeof in);
        in.minus = x, in.plus = in.value = h, in.product = y, in.e = q->e;
        iqn__sweep(q, &m, &in);
        size = iqn__noise_scale(q, &m, &in, 0);
        CHECK(size.f >= 0.5 && size.f < 1);
        CHECK_NEAR(ldexp(size.f, size.e) / (sqrt(M) * sqrt(34)), 1, 1e-14);
        free(mem);
    }
}

/* ---- the small parts one by one ----------------------------------------------------------------- */

/* Behind the object every array follows the one before it, aligned to 8, with the numbers that its comment gives it; the last
   one ends with the memory. */
static void test_the_arrays_fill_the_memory(void **state)
{
    static const int shapes[][3] = {{7, 0, 1}, {0, 3, 2}, {9, 4, 3}, {1023, 7, 1}, {1025, 8, 2}, {2400, 10, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        const size_t n = (size_t)shapes[k][0], slots = (size_t)shapes[k][1] + 1, B = (size_t)shapes[k][2];
        const size_t lead = slots + (8 - slots % 8) % 8, rows = n < 1024 ? n : 1024, real = sizeof(double), whole = sizeof(int);
        void *mem;
        iqn *q = make(&mem, shapes[k][0], shapes[k][1], shapes[k][2]);
        const iqn__view m = iqn__open(q);
        const size_t numbers = B * (2 * slots + 4); /* per block and slot V'r and V'd, and r'r, v'r, v'v, v'd */
        const size_t bytes[FIELDS] = {B * sizeof(iqn__block), 16 * B * slots * slots, 16 * B * slots, 16 * numbers,
                                          16 * slots * slots, slots * lead * real, slots * lead * real, slots * real, slots * real,
                                          16 * slots, 3 * numbers * real, slots * real, B * slots * real,
                                          slots * real, slots * real, slots * real, slots * real, slots * real, slots * real,
                                          slots * real, slots * whole, slots * whole, B * slots * whole, slots * whole, slots * whole,
                                          slots * whole, slots * whole, rows * real, rows * real, rows * real, rows * real, n * slots * real,
                                          n * slots * real};
        const char *at = (const char *)mem + (sizeof(struct iqn) + 7) / 8 * 8;
        int i;
        for (i = 0; i < FIELDS; i++) {
            CHECK(array_of(&m, i) == at);
            at += (bytes[i] + 7) / 8 * 8;
        }
        CHECK_INT(at - (const char *)mem, iqn_size(shapes[k][0], shapes[k][1], shapes[k][2]));
        CHECK_INT(m.slots, slots);
        CHECK_INT(m.lead, lead);
        CHECK_INT(sizeof q->set / sizeof *q->set, 24);        /* up to IQN_MERGE */
        CHECK_INT(sizeof q->counter / sizeof *q->counter, 12); /* from IQN_NSTEPS to IQN_NRESTARTED */
        CHECK_INT(sizeof m.block->set / sizeof *m.block->set, 6);
        free(mem);
    }
}

/* The largest size that is given is the largest below a quarter of what a size_t holds; the largest number of blocks is where
   ten numbers for each of columns + 3 still fit into an int. */
static void test_the_largest_sizes(void **state)
{
    static const int columns[] = {0, 1, 7, 100};
    const size_t most = (size_t)-1 / 4;
    size_t k;
    (void)state;
    for (k = 0; k < sizeof columns / sizeof *columns; k++) {
        ptrdiff_t low = 0, high = (ptrdiff_t)((size_t)-1 / 2), step = (ptrdiff_t)sizeof(double) * 2 * (columns[k] + 1);
        int few = 1, many = INT_MAX;
        while (high - low > 1) {
            const ptrdiff_t middle = low + (high - low) / 2;
            if (iqn_size(middle, columns[k], 1) > 0) low = middle;
            else high = middle;
        }
        CHECK(iqn_size(low, columns[k], 1) <= most);
        CHECK((double)low * (double)step <= (double)most); /* and not beyond what a size_t counts */
        CHECK(iqn_size(low, columns[k], 1) > most - (size_t)step);
        CHECK(iqn_size(low, columns[k], 1) == iqn_size(low - 1000, columns[k], 1) + 1000 * (size_t)step);
        while (many - few > 1) {
            const int middle = few + (many - few) / 2;
            if (iqn_size(3, columns[k], middle) > 0) few = middle;
            else many = middle;
        }
        CHECK(10LL * few * (columns[k] + 3) <= INT_MAX);
        if (sizeof(size_t) < 8) continue; /* there the memory is the bound */
        CHECK(10LL * (few + 1) * (columns[k] + 3) > INT_MAX - 10LL * (columns[k] + 3)); /* INT_MAX / 10 is rounded down */
    }
    CHECK((iqn_size(3, 10000, 1) > 0) == (sizeof(size_t) >= 8)); /* 5 GB */
    CHECK_INT(iqn_size(3, 10001, 1), 0);
}

/* A number for the ranks is three multiples of 2^(k-48), 2^(k-84) and 2^(k-120), about half a unit of the one before at most; they
   give it back to half a unit of the last.  Beyond 2^900 grids stay where they are. */
static void test_numbers_for_the_ranks_are_on_their_grids(void **state)
{
    static const int unit[3] = {48, 84, 120}, exponent[] = {0, 1, -7, 60, -61, 300, -300, 900, -900, 1000};
    unsigned long long seed = 44;
    double out[3], far_out[3];
    int t, i, part;
    (void)state;
    for (t = 0; t < 900; t++) {
        const int k = exponent[t % 10];
        const iqn__dd a = iqn__shift(iqn__two_sum(random_number(&seed), 0x1p-54 * random_number(&seed)), k);
        iqn__dd back;
        iqn__pack(a, k, out);
        for (part = 0; part < 3; part++) {
            const double multiple = ldexp(out[part], unit[part] - k);
            CHECK(multiple == floor(multiple));
            CHECK(fabs(multiple) <= (part ? ldexp(1.05, 35) : ldexp(1, 48))); /* the low part is not asked how to round */
        }
        back = iqn__sub(iqn__unpack(out), a);
        CHECK_NEAR(ldexp(back.h, -k), 0, 0x1p-121);
    }
    for (i = -1; i <= 1; i += 2)
        for (part = 0; part < 3; part++) {
            const int limit = i < 0 ? -900 : 1000;
            const iqn__dd a = iqn__shift(iqn__dd_of(1.5), limit - unit[part]); /* one and a half units: two */
            iqn__pack(a, 1200 * i, far_out);
            CHECK(far_out[part] == ldexp(2, limit - unit[part]));
        }
    CHECK_INT(iqn__bound(0), -900);
    CHECK_INT(iqn__bound(1e-300), -900);
    CHECK_INT(iqn__bound(1e300), 997);
    CHECK_INT(iqn__bound(DBL_MAX), 1020);
    CHECK_INT(iqn__bound(HUGE_VAL), 1020);
    for (t = -890; t <= 1010; t++) {
        const double a = ldexp(0.5 + 0.499 * fabs(random_number(&seed)), t), bound = ldexp(1, iqn__bound(a));
        CHECK(a < bound);
        CHECK(bound <= 2 * a);
    }
}

/* What bounds number j of a block's second message by Cauchy's inequality, in units of 2^e: norms[] are those of r, y (M r), v and
   of the step. */
static double bound_of_the_message(const iqn *q, const iqn__view *m, const iqn__input *in, int b, int j, const double *norms)
{
    const double unit = ldexp(1, in->e), r = norms[0] / unit, y = norms[1] / unit, v = norms[2] / unit, step = norms[3] / unit;
    const int slot = j < 2 * q->used ? m->order[j / 2] : 0;
    double column;
    if (j == 2 * q->used + IQN__RR) return r * y;
    if (j == 2 * q->used + IQN__VR) return v * (iqn__method(q) == IQN_AITKEN ? step : y);
    if (j == 2 * q->used + IQN__VV) return v * v;
    column = sqrt(iqn__plain_square(q->n / 2, m->V + slot * q->n + b * q->n / 2)); /* there are two blocks */
    return column * (j % 2 ? ldexp(v, -52) : y);
}

/* Every number of the second message is below the bound of its grids, and that is Cauchy's to eight bits: columns, r, v and what
   rounding takes from it, with a metric and with Aitken's step; fields differ in size. */
static void test_the_bounds_of_the_messages(void **state)
{
    static const struct {
        int method, metric;
        double unit;
    } row[] = {{IQN_ILS, 0, 1},    {IQN_ILS, 1, 1},       {IQN_AITKEN, 0, 1},  {IQN_ILS, 0, 1e9},
               {IQN_ILS, 1, 1e-9}, {IQN_AITKEN, 0, 1e-7}, {IQN_AITKEN, 0, 1e9}};
    enum { N = 30, STEPS = 5 };
    size_t t;
    (void)state;
    for (t = 0; t < sizeof row / sizeof *row; t++) {
        unsigned long long seed = 3;
        void *mem;
        iqn *q = make(&mem, N, 8, 2);
        const iqn__view m = iqn__open(q);
        double x[N], h[N], mr[N], old_x[N] = {0}, old_r[N] = {0};
        iqn__input in;
        int i, b, j, step;
        CHECK_INT(iqn_set(q, IQN_METHOD, row[t].method), IQN_OK);
        textbook(q);
        for (step = 0; step <= STEPS; step++) {
            const double large = row[t].method == IQN_ILS ? 100 : 0.01, last = step < STEPS ? 1 : large; /* |r| of the last one: larger or smaller */
            for (i = 0; i < N; i++) {
                x[i] = row[t].unit * (i < N / 2 ? 1 : 1e5) * random_number(&seed);
                h[i] = x[i] + last * row[t].unit * (i < N / 2 ? 1 : 1e3) * random_number(&seed);
                mr[i] = 1e4 * (h[i] - x[i]);
            }
            if (step == STEPS) break;
            memcpy(old_x, x, sizeof x);
            for (i = 0; i < N; i++) old_r[i] = h[i] - x[i];
            CHECK((row[t].metric ? iqn_step_metric(q, x, h, mr) : iqn_step(q, x, h)) >= 0);
        }
        memset(&in, 0, sizeof in);
        in.minus = x, in.plus = in.value = h, in.product = row[t].metric ? mr : NULL, in.e = q->e;
        CHECK_INT(iqn__measure(q, &m, &in), IQN_OK);
        for (b = 0; b < 2; b++) {
            double square[4] = {0, 0, 0, 0};
            for (i = b * N / 2; i < (b + 1) * N / 2; i++) {
                const double r = h[i] - x[i], y = in.product ? mr[i] : r, v = r - old_r[i], s = x[i] - old_x[i];
                square[0] += r * r, square[1] += y * y, square[2] += v * v, square[3] += s * s;
            }
            for (i = 0; i < 4; i++) square[i] = sqrt(square[i]);
            for (j = 0; j < 2 * q->used + 3; j++) {
                const int k = iqn__message_bound(q, &m, &in, b, j);
                const double entry = fabs(iqn__entry(q, &m, b, j)->h), least = bound_of_the_message(q, &m, &in, b, j, square);
                CHECK(entry < ldexp(1, k));
                CHECK(least < ldexp(1, k));
                CHECK(ldexp(1, k) < 256 * least);
            }
        }
        free(mem);
    }
}

/* |r| and |hx| against limits, at the limits themselves, and with an |hx| that has grown from the start. */
static void test_limits_at_the_limits(void **state)
{
    static const struct {
        double r, value, first, start, tol[3];
        int within;
    } row[] = {
        {1, 1, 1, 1, {0, 0, 0}, IQN__NO_LIMIT},       {0, 1, 1, 1, {0, 0, 0}, IQN__NO_LIMIT},
        {1, 4, 4, 4, {1, 0, 0}, IQN__WITHIN},         {1.0625, 4, 4, 4, {1, 0, 0}, IQN__OUTSIDE},
        {1, 4, 4, 4, {0, 0.25, 0}, IQN__WITHIN},      {1, 3.9375, 4, 4, {0, 0.25, 0}, IQN__OUTSIDE},
        {1, 4, 8, 4, {0, 0, 0.125}, IQN__WITHIN},     {1.0625, 4, 8, 4, {0, 0, 0.125}, IQN__OUTSIDE},
        {1, 4, 8, 4, {0.5, 0.25, 0.1}, IQN__WITHIN},  {1, 4, 8, 4, {0.5, 0.125, 0.125}, IQN__WITHIN},
        {1, 4, 8, 4, {1, 0.125, 0.1}, IQN__WITHIN},   {1, 4, 8, 4, {0.5, 0.125, 0.1}, IQN__OUTSIDE},
        {1, 40, 1, 4, {0, 0.5, 0}, IQN__WITHIN},      {1, 40.5, 1, 4, {0, 0.5, 0}, IQN__OUTSIDE},
        {1, 40.5, 8, 4, {0, 0.5, 0}, IQN__OUTSIDE},   {1, 40.5, 10, 4, {0, 0.5, 0}, IQN__WITHIN},
        {1, 4000, 16, 4, {0, 0.00025, 0}, IQN__WITHIN}, {1, 8000, 16, 4, {0, 0.00024, 0}, IQN__OUTSIDE},
        {1, 8000, 16, 4, {0, 0.00026, 0}, IQN__WITHIN}, {1, 8000, 8, 4, {1, 0.00026, 0}, IQN__WITHIN},
        {1, 8000, 8, 4, {0, 0, 0.125}, IQN__WITHIN},  {1, 8, 8, 0, {0, 0.125, 0}, IQN__OUTSIDE},
        {1, 8, 16, 0, {0, 0.125, 0}, IQN__WITHIN},    {0, 0, 0, 0, {0, 1e-3, 0}, IQN__WITHIN}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        CHECK_INT(iqn__within(iqn__root(row[k].r * row[k].r, 0), iqn__root(row[k].value * row[k].value, 0),
                              iqn__root(row[k].first * row[k].first, 0), iqn__root(row[k].start * row[k].start, 0), row[k].tol),
                  row[k].within);
    }
}

/* The |hx| that growth is measured from: the first that is not 0, or a larger one of the first iteration. */
static void test_where_growth_is_measured_from(void **state)
{
    static const struct {
        double start, value;
        int first;
        double expected;
    } row[] = {{0, 2, 0, 2}, {0, 2, 1, 2}, {0, 0, 1, 0}, {1, 2, 0, 1}, {1, 2, 1, 2}, {2, 1, 1, 2}, {2, 1, 0, 2}, {0.5, 0.25, 0, 0.5}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        iqn__norm start = iqn__root(row[k].start * row[k].start, 0);
        iqn__set_growth_from(&start, iqn__root(row[k].value * row[k].value, 0), row[k].first);
        CHECK(iqn__value_of(start) == row[k].expected);
    }
}

/* What a residual means after those before: 10 % below the milestone is progress; without it for IQN_PATIENCE iterations, 1000
   times the least diverges, and a least below a thousandth of the first is noise; at these numbers themselves it is not. */
static void test_progress_at_its_limits(void **state)
{
    static const struct {
        double first, best, milestone, residual;
        int waited, patience, iterations, converged, status, waits;
    } row[] = {
        {16, 10, 10, 8.9, 3, 5, 4, 0, 0, 0},         {16, 10, 10, 9.1, 3, 5, 4, 0, 0, 4},
        {16, 10, 10, 9, 3, 5, 4, 0, 0, 4},           {16, 1, 1, 1.5, 3, 5, 4, 0, 0, 4},
        {16, 10, 10, 9.1, 4, 5, 4, 0, IQN_STALLED, 5}, {16, 10, 10, 9.1, 7, 0, 4, 0, 0, 8},
        {16, 10, 10, 9.1, 4, 5, 4, 1, 0, 5},         {16, 1, 1, 1000, 4, 5, 4, 0, IQN_STALLED, 5},
        {16, 1, 1, 1001, 4, 5, 4, 0, IQN_DIVERGED, 5}, {1000, 1, 1, 2, 4, 5, 4, 0, IQN_STALLED, 5},
        {1001, 1, 1, 2, 4, 5, 4, 0, IQN_NOISE, 5},   {1001, 2, 1.0625, 1, 4, 5, 4, 0, IQN_NOISE, 5},
        {16, 1, 1, 9, 9, 5, 1, 0, 0, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 0, 1);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, row[k].patience), IQN_OK);
        q->first = iqn__root(row[k].first * row[k].first, 0);
        q->best = iqn__root(row[k].best * row[k].best, 0);
        q->milestone = iqn__root(row[k].milestone * row[k].milestone, 0);
        q->residual = iqn__root(row[k].residual * row[k].residual, 0);
        q->value = iqn__root(4, 0);
        q->best_relative = 3;
        q->waited = row[k].waited, q->iterations = row[k].iterations, q->converged = row[k].converged;
        iqn__watch_progress(q);
        CHECK_INT(iqn__stalled(q), row[k].status);
        CHECK_INT(q->waited, row[k].waits);
        CHECK_INT((int)iqn_get(q, IQN_NSTALLED), row[k].status != 0);
        CHECK_NEAR(iqn__value_of(q->best), row[k].iterations == 1 ? row[k].residual : fmin(row[k].best, row[k].residual), 1e-15);
        CHECK_NEAR(q->best_relative, row[k].iterations == 1 ? row[k].residual / 2 : fmin(3, row[k].residual / 2), 1e-15);
        free(mem);
    }
}

/* A new independent pair is progress, but not one more of the same, and not where |r| has fallen to a thousandth. */
static void test_a_new_pair_ends_the_waiting(void **state)
{
    static const struct {
        double best;
        int had, now, waited, independent;
    } row[] = {{0.5, 2, 3, 0, 3}, {0.5, 3, 3, 7, 3}, {0.5, 4, 3, 7, 4}, {0.0005, 2, 3, 7, 3}, {0.001, 2, 3, 7, 3}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 0, 1);
        q->first = iqn__root(1, 0), q->best = iqn__root(row[k].best * row[k].best, 0);
        q->waited = 7, q->most_kept = row[k].had;
        iqn__note_kept(q, row[k].now);
        CHECK_INT(q->waited, row[k].waited);
        CHECK_INT(q->most_kept, row[k].independent);
        free(mem);
    }
}

/* The noise that a row of the factor inherits is that of b with L'b = row; what is asked first is never less, and is what its
   comment says. */
static void test_inherited_noise(void **state)
{
    enum { N = 15 };
    unsigned long long seed = 12;
    void *mem;
    iqn *q = make(&mem, 0, N, 1);
    const iqn__view m = iqn__open(q);
    int base, i, j, k;
    (void)state;
    for (k = 0; k < N; k++) {
        m.noise[k] = 1e-3 * (1 + k % 4);
        for (i = 0; i < (int)m.lead; i++) m.Lh[k * m.lead + i] = i == k ? 1 / (1.5 + 0.1 * k) : random_number(&seed);
    }
    for (base = 0; base < 4; base += 3)
        for (k = base; k < N; k++) {
            double b[N], sum = 0, most = 0;
            for (i = k - 1; i >= base; i--) { /* L' b = row k */
                for (b[i] = m.Lh[i * m.lead + k], j = i + 1; j < k; j++) b[i] -= m.Lh[i * m.lead + j] * b[j];
                b[i] /= 1.5 + 0.1 * i;
                sum += b[i] * b[i] * m.noise[i];
            }
            for (i = base; i < k; i++) most += fabs(m.Lh[i * m.lead + k]) * m.inverse_row[i];
            CHECK_NEAR(iqn__inherited(&m, base, k), sum, 1e-12 * sum);
            CHECK_NEAR(iqn__inherited_at_most(&m, base, k), most * most, 1e-12 * most * most);
            CHECK(most * most >= sum * (1 - 1e-12));
            m.inverse_row[k] = sqrt(sum + m.noise[k]) / (1.5 + 0.1 * k); /* L_kk */
        }
    free(mem);
}

/* The bound that is asked first is exact for the second pair, and never less for others; a pair that is dropped adds nothing. */
static void test_the_quick_bound_of_inherited_noise(void **state)
{
    enum { N = 12, PAIRS = 9, TWIN = 5 };
    static const double level[] = {0.05, 0};
    unsigned long long seed = 31;
    int i, k, t;
    (void)state;
    for (t = 0; t < 2; t++) {
        void *mem;
        iqn *q = make(&mem, N, PAIRS, 1);
        const iqn__view m = iqn__open(q);
        double x[N], h[N], v[N], w[N];
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, level[t]), IQN_OK);
        for (k = 0; k < PAIRS; k++) {
            for (i = 0; i < N; i++) v[i] = k == TWIN ? v[i] : random_number(&seed), w[i] = random_number(&seed);
            CHECK_INT(iqn_push(q, v, w), IQN_OK);
        }
        for (i = 0; i < N; i++) x[i] = random_number(&seed), h[i] = random_number(&seed);
        memset(m.inverse_row, 0xff, PAIRS * sizeof *m.inverse_row);
        CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
        CHECK(m.dropped[m.order[PAIRS - TWIN]]);
        for (k = 1; k < PAIRS; k++) {
            const double exact = level[t] > 0 ? iqn__inherited(&m, 0, k) : 0, most = iqn__inherited_at_most(&m, 0, k);
            if (k == 1) CHECK_NEAR(most, exact, 1e-12 * exact);
            CHECK(most >= exact * (1 - 1e-12));
        }
        free(mem);
    }
}

/* A pair below the noise is no progress: patience ends as if there were none. */
static void test_a_pair_that_is_dropped_does_not_end_the_waiting(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 5, 1);
    double x = 0, h;
    int k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 1), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_PATIENCE, 4), IQN_OK);
    for (k = 1; k <= 5; k++) {
        h = x + 1 + 1e-3 * k;
        CHECK_INT(iqn_step(q, &x, &h), k < 5 ? IQN_RELAXED : IQN_STALLED);
    }
    CHECK(iqn_get(q, IQN_NDROPPED) > 0);
    free(mem);
}

/* A step is taken back only where every block has a weight: else |r| as the least squares sees it is not the whole. */
static void test_taking_back_needs_every_block(void **state)
{
    int blind;
    (void)state;
    for (blind = -1; blind < 2; blind++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 2);
        double x[2] = {0, 0}, h[2] = {1, 1};
        const double r[2] = {1, 1}, v[2] = {-2, -2}, w[2] = {-1, -1};
        if (blind >= 0) CHECK_INT(iqn_set_block(q, blind, IQN_WEIGHT, 0), IQN_OK);
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_OK);
        CHECK_INT(answer_with(q, x, r, 100) == IQN_WITHDRAWN, blind < 0);
        free(mem);
    }
}

/* |r| ten times of what a full step should have left, and of the steepest slope above 1 times that, is a surprise; one pair of a
   past window alone leaves the question open, and so does a v below three times its noise, 1e-13 |hx|. */
static void test_what_is_a_surprise(void **state)
{
    static const struct {
        double r, steepest, growth;
        int past, noisy, surprises;
    } row[] = {{9, 0, 2, 0, 0, 0},  {10, 0, 2, 0, 0, 1}, {10, 1, 2, 0, 0, 1}, {10, 0, 1, 0, 0, 0}, {5, 0, 2, 0, 0, 0},
               {15, 1, 2, 0, 0, 1}, {29, 3, 2, 0, 0, 0}, {31, 3, 2, 0, 0, 1}, {31, 3, 2, 1, 0, 0}, {31, 3, 2, 0, 1, 0}};
    iqn__input in;
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 2, 1);
        iqn__view m = iqn__open(q);
        const double one = 1;
        CHECK_INT(iqn_push(q, &one, &one), IQN_OK);
        q->window += row[k].past;
        q->predicted = iqn__root(1, 0);
        q->steepest = row[k].steepest;
        memset(&in, 0, sizeof in);
        iqn__own_of(&m, 0)[IQN__VV] = iqn__dd_of(row[k].noisy ? 8.9e-26 : 9.1e-26); /* v'v, hx = 1 */
        m.block[0].value = iqn__unit_norm();
        iqn__weigh(q, &m);
        iqn__relate_weights(q, &m);
        iqn__observe_curvature(q, &m, &in, iqn__root(row[k].r * row[k].r, 0), row[k].growth);
        CHECK_INT(q->surprises, row[k].surprises);
        CHECK_NEAR(curvature_of_pair(q, 0), row[k].surprises ? 0.01 : 0, 1e-15);
        free(mem);
    }
}

/* Three full steps of a window that leave 0.1 to 0.5 of |r|, and ten times of what they should, make the pairs inexact: all are
   then curved by 0.01, once in a run, and that of a later full step by 0.01 |r| / |r_base|. */
static void test_what_makes_a_run_inexact(void **state)
{
    static const struct {
        double r, growth;
        int past, commit, inexact;
    } row[] = {{10, 0.2, 0, 0, 1}, {9, 0.2, 0, 0, 0}, {10, 0.1, 0, 0, 0}, {10, 0.5, 0, 0, 0}, {10, 0.2, 1, 0, 0}, {10, 0.2, 0, 1, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 1);
        iqn__view m = iqn__open(q);
        const double v[2] = {-2, 0}, w[2] = {-1, 0};
        double x[2] = {0, 0}, h[2] = {1, 0};
        iqn__input in;
        int i;
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
        q->predicted = iqn__root(1, 0);
        memset(&in, 0, sizeof in);
        iqn__own_of(&m, 0)[IQN__VV] = iqn__dd_of(1);
        iqn__weigh(q, &m);
        iqn__relate_weights(q, &m);
        for (i = 0; i < 5; i++) {
            CHECK_NEAR(curvature_of_pair(q, 0), row[k].inexact && i > 2 ? 0.01 : 0, 1e-15);
            CHECK_INT(q->inexact, row[k].inexact && i > 2);
            if (row[k].commit && i == 2) CHECK_INT(iqn_commit(q), IQN_OK);
            q->window += row[k].past && i == 0;
            iqn__observe_curvature(q, &m, &in, iqn__root(row[k].r * row[k].r, 0), row[k].growth);
        }
        CHECK(iqn_step(q, x, h) >= 0);
        q->window -= row[k].past; /* the pushed pair again of this window */
        h[0] = x[0], h[1] = x[1] + 3;
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_NEAR(curvature_of_pair(q, 0), row[k].inexact ? 0.03 : 0, 1e-15);
        free(mem);
    }
}

/* H that is another one in every call, with the same fixed point: each pair is off by a part of |r|. */
static void test_an_inexact_run_converges(void **state)
{
    unsigned seed;
    int failed = 0, all = 0;
    (void)state;
    for (seed = 1; seed <= 40; seed++) {
        enum { N = 6 };
        void *mem;
        iqn *q = make(&mem, N, 40, 1);
        double x[N], h[N];
        unsigned state_of = seed * 2654435761u;
        int i, k, window;
        CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, 1e-10), IQN_OK);
        for (window = 0; window < 4; window++) {
            for (i = 0; i < N; i++) x[i] = 1 + 0.1 * ((i * 7 + window) % 5);
            for (k = 0; k < 60 && iqn_converged(q) == 0; k++) {
                for (i = 0; i < N; i++) {
                    const int other = (i * 11 + k) % N;
                    state_of = state_of * 1664525u + 1013904223u;
                    h[i] = -0.5 * x[i] + 0.2 * (state_of / 4294967296.0 - 0.5) * x[other];
                }
                CHECK(iqn_step(q, x, h) >= 0);
                all++;
            }
            failed += iqn_converged(q) != 1;
            CHECK_INT(iqn_commit(q), IQN_OK);
        }
        free(mem);
    }
    CHECK_INT(failed, 0);
    CHECK(all < 2400); /* 2003; with pairs that are believed in full 2942 */
}

/* Pairs of past windows are stale where the second residual is larger than the first; the same one says nothing. */
static void test_a_residual_that_stays_does_not_condemn_past_pairs(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 2, 1);
    (void)state;
    q->iterations = 2;
    q->claimed = iqn__root(1, 0);
    CHECK_INT(iqn__observe_drift(q, iqn__root(1, 0), 1), 0);
    CHECK_INT(iqn__observe_drift(q, iqn__root(1, 0), 1 + DBL_EPSILON), 1);
    free(mem);
}

/* A second residual of a tenth of A makes a nonlinear run steady; only where past pairs claimed to remove A, and not again after
   a full step has doubled |r| or past pairs have misled. */
static void test_what_makes_a_run_steady(void **state)
{
    static const struct {
        double r, growth; /* over A; of the second residual over the first */
        int iterations, nonlinear, limit, before, after;
    } row[] = {{0.099, 0.9, 2, 1, 0, 0, 1},  {0.101, 0.9, 2, 1, 0, 0, 0}, {0.099, 0.9, 3, 1, 0, 0, 0}, {0.099, 0.9, 2, 0, 0, 0, 0},
               {0.099, 0.9, 2, 1, 1, 0, 0},  {0.099, 0.9, 2, 1, 0, -1, -1}, {0.5, 0.9, 2, 1, 0, 1, 1},  {0.099, 1.1, 2, 1, 0, 0, -1},
               {0.5, 1.1, 2, 1, 0, 1, -1},   {0.5, 1.9, 3, 1, 0, 1, 1},   {0.5, 2.1, 3, 1, 0, 1, -1},  {0.5, 2.1, 3, 1, 0, 0, 0},
               {0.5, 6, 3, 1, 0, 1, -1},     {0.5, 6, 3, 1, 1, 1, -1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 2, 1);
        const iqn__view m = iqn__open(q);
        const double one = 1;
        iqn__plan p;
        iqn__input in;
        memset(&p, 0, sizeof p);
        memset(&in, 0, sizeof in);
        CHECK_INT(iqn_push(q, &one, &one), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, row[k].limit ? 1e-3 : 0), IQN_OK);
        q->window++;
        q->iterations = row[k].iterations;
        q->nonlinear = row[k].nonlinear, q->steady = row[k].before;
        q->claimed = iqn__root(1, 0);
        iqn__judge_full(q, &m, &in, iqn__root(row[k].r * row[k].r, 0), row[k].growth, &p);
        CHECK_INT(q->steady, row[k].after);
        q->claimed = iqn__zero_norm(); /* no past pair took part */
        q->steady = 0;
        CHECK_INT(iqn__observe_drift(q, iqn__zero_norm(), 0.5), 0);
        CHECK_INT(q->steady, 0);
        free(mem);
    }
}

/* The steepest slope of a window is nothing to the next one; in a nonlinear run half of it counts, after commit and discard. */
static void test_the_steepest_slope_fades(void **state)
{
    int k;
    (void)state;
    for (k = 0; k < 4; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 2, 1);
        double x = 1;
        const double h = 2;
        CHECK(iqn_step(q, &x, &h) >= 0);
        q->steepest = 8;
        q->nonlinear = k % 2;
        CHECK_INT(k / 2 ? iqn_commit(q) : iqn_discard(q), IQN_OK);
        CHECK_NEAR(q->steepest, k % 2 ? 4 : 0, 0);
        free(mem);
    }
}

/* Two blocks of one number: what a step has measured of them, by hand.  Weights are powers of two. */
static iqn *two_measured(void **mem, const double *value, const double *vv, const int *weight)
{
    iqn *q = make(mem, 2, 2, 2);
    iqn__view m = iqn__open(q);
    int b;
    for (b = 0; b < 2; b++) {
        m.block[b].value = iqn__root(value[b] * value[b], 0);
        m.block[b].weight = iqn__root(1, weight[b]);
        iqn__own_of(&m, b)[IQN__VV] = iqn__dd_of(vv[b]);
    }
    return q;
}

/* |10 v - v_probed| / |v_probed|, weighted, from the squares and the product of the two */
static void test_the_error_of_a_probe(void **state)
{
    static const struct {
        double square[2], product[2], probed[2];
        int weight[2];
        double expected;
    } row[] = {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0},
               {{0.01, 0}, {0.1, 0}, {1, 0}, {0, 0}, 0},
               {{0.04, 0.01}, {0.2, 0.1}, {1, 1}, {0, 0}, 0.70710678118654752}, /* 10 v = 2 and 1 for 1 and 1 */
               {{0.01, 0.04}, {0.1, 0.2}, {1, 1}, {0, 0}, 0.70710678118654752},
               {{0.01, 0.01}, {-0.1, 0.3}, {1, 9}, {0, 0}, 0.89442719099991588}, /* -1 and 1 for 1 and 3 */
               {{0.01, 0.04}, {0.1, 0.2}, {1, 1}, {0, 3}, 0.99227787671366763}, /* the second in other units: sqrt(64 / 65) */
               {{0.0099, 0}, {0.1, 0}, {1, 0}, {0, 0}, 0}};                 /* rounding: less than nothing */
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        static const double one[2] = {1, 1};
        iqn *q = two_measured(&mem, one, row[k].square, row[k].weight);
        iqn__view m = iqn__open(q);
        iqn__input in;
        int b;
        memset(&in, 0, sizeof in);
        for (b = 0; b < 2; b++) {
            iqn__sums_of(&m, b)[2] = iqn__dd_of(row[k].product[b]); /* of slot 1 */
            m.gram[(b * m.slots + 1) * m.slots + 1] = iqn__dd_of(row[k].probed[b]);
        }
        q->probed = 1;
        iqn__relate_weights(q, &m);
        CHECK_NEAR(iqn__probe_error(q, &m, &in), row[k].expected, row[k].expected > 0 ? 1e-14 : 0);
        free(mem);
    }
}

/* A pair is above the noise where its square is more than 0.09 of that of 0.1 |hx|, over all blocks with their weights. */
static void test_what_is_above_the_noise(void **state)
{
    static const struct {
        double value[2], square[2];
        int weight[2], above;
    } row[] = {{{10, 10}, {0.17, 0}, {0, 0}, 0},  {{10, 10}, {0.19, 0}, {0, 0}, 1},  {{10, 10}, {0, 0.17}, {0, 0}, 0},
               {{10, 10}, {0, 0.19}, {0, 0}, 1},  {{10, 20}, {0.4, 0}, {0, 0}, 0},   {{10, 20}, {0.2, 0.3}, {0, 0}, 1},
               {{20, 10}, {0.4, 0}, {0, 0}, 0},   {{20, 10}, {0.3, 0.2}, {0, 0}, 1}, {{10, 10}, {0.19, 0}, {0, 1}, 0},
               {{10, 10}, {0, 0.13}, {0, 1}, 1},  {{10, 10}, {0, 0.11}, {0, 1}, 0},  {{10, 10}, {0.13, 0}, {1, 0}, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = two_measured(&mem, row[k].value, row[k].square, row[k].weight);
        iqn__view m = iqn__open(q);
        iqn__input in;
        memset(&in, 0, sizeof in);
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0.1), IQN_OK);
        iqn__relate_weights(q, &m);
        CHECK_INT(iqn__above_noise(q, &m, &in, 1), row[k].above);
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0.05), IQN_OK);
        CHECK_INT(iqn__above_noise(q, &m, &in, 0.5), row[k].above);
        free(mem);
    }
}

/* Where the base is after a step whose |r| was 2 and is now: after a small one it goes along where |r| is less than half; after a
   relaxation where |r| has not grown; and wherever nothing was learned. */
static void test_where_the_base_goes(void **state)
{
    static const struct {
        int kind;
        double r;
        int moves;
    } row[] = {{IQN__SMALL, 1, 0},  {IQN__SMALL, -1, 0},  {IQN__SMALL, 0.9375, 1}, {IQN__SMALL, 2, 1},
               {IQN__PLAIN, -2, 1}, {IQN__PLAIN, -2.5, 0}, {IQN__PLAIN, 1, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 5, 1);
        double x = 1, h = 3, base = 0;
        CHECK_INT(iqn_set(q, IQN_OMEGA, 0.5), IQN_OK);
        CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
        CHECK(x == 2);
        q->kind = row[k].kind;
        h = x + row[k].r;
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK_INT(iqn_halve(q, &base), IQN_OK); /* half of the way to the base */
        CHECK_NEAR(base, row[k].moves ? 1 : 0.5, 1e-15);
        free(mem);
    }
}

/* A full step that raised |r| by less than hx is rounded to has no pair to probe: the run goes on from there. */
static void test_a_bad_step_within_rounding_is_not_taken_back(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {0, 1e6}, h[2] = {DBL_EPSILON, 1e6};
    (void)state;
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    q->kind = IQN__FULL;
    h[0] = x[0] + 10 * DBL_EPSILON;
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK_INT(iqn_get(q, IQN_NZERO), 1);
    CHECK_INT(iqn_get(q, IQN_NWITHDRAWN), 0);
    CHECK_NEAR(x[0], h[0] - 9 * DBL_EPSILON, 1e-30);
    free(mem);
}

/* After half of the patience the pairs lead nowhere: at most three times in a window, not below a thousandth of the first |r|, and
   not where IQN_GROWTH is 0. */
static void test_when_pairs_lead_nowhere(void **state)
{
    static const struct {
        double growth, best;
        int restarts, waited, patience, nowhere;
    } row[] = {{5, 0.5, 0, 4, 6, 1},   {5, 0.5, 0, 3, 6, 0},    {5, 0.5, 2, 4, 6, 1}, {5, 0.5, 3, 4, 6, 0},
               {1, 0.5, 0, 4, 6, 1},   {0.5, 0.5, 0, 4, 6, 1},  {0, 0.5, 0, 4, 6, 0}, {5, 0.001, 0, 4, 6, 1},
               {5, 0.0009, 0, 4, 6, 0}, {5, 0.5, 0, 2, 2, 1},   {5, 0.5, 0, 2, 1, 1}, {5, 0.5, 0, 1, 1, 0},
               {5, 0.5, 0, 9, 0, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 2, 1);
        CHECK_INT(iqn_set(q, IQN_GROWTH, row[k].growth), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, row[k].patience), IQN_OK);
        q->first = iqn__root(1, 0), q->best = iqn__root(row[k].best * row[k].best, 0);
        q->restarts = row[k].restarts, q->waited = row[k].waited;
        CHECK_INT(iqn__leads_nowhere(q), row[k].nowhere);
        q->converged = 1;
        CHECK_INT(iqn__leads_nowhere(q), 0);
        free(mem);
    }
}

/* Starting over, the base moves also to an iterate that was to be taken back: then nothing is taken back. */
static void test_starting_over_takes_nothing_back(void **state)
{
    double x = 0, h = 1;
    int made;
    (void)state;
    for (made = 0; made < 2; made++) {
        void *mem;
        iqn *q = make(&mem, 1, 3, 1);
        iqn__view m = iqn__open(q);
        iqn__plan p;
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK_INT(iqn_push(q, &h, &h), IQN_OK);
        CHECK_INT(iqn_push(q, &h, &h), IQN_OK);
        memset(&p, 0, sizeof p);
        p.made = made ? m.order[0] : IQN__NO_SLOT;
        p.taken_back = p.probes = 1;
        iqn__start_over(q, &m, &p);
        CHECK_INT(iqn_get(q, IQN_PAIRS), made);
        CHECK_INT(p.moves, !made);
        CHECK_INT(p.taken_back, made);
        CHECK_INT(p.probes, made);
        free(mem);
    }
}

/* H(x) = x + b - A x with A = diag(1, -50), b = (1, 0.1), from 0: the second step raises |r| from 1.08 to 10 and is taken back, and
   the probe proves H affine.  Half of a patience of 2 has run out by then: the pair stays all the same, and the run converges. */
static void test_pairs_that_a_probe_proves_stay(void **state)
{
    static const int statuses[] = {IQN_RELAXED, IQN_OK, IQN_WITHDRAWN};
    void *mem;
    iqn *q = make(&mem, 2, 4, 1);
    double x[2] = {0, 0}, h[2];
    int k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_PATIENCE, 2), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_REDUCTION, 1e-10), IQN_OK);
    for (k = 0; k < 4; k++) {
        const int status = (h[0] = 1, h[1] = 0.1 + 51 * x[1], iqn_step(q, x, h));
        if (k < 3) CHECK_INT(status, statuses[k]);
    }
    CHECK(q->affine);
    CHECK_INT(iqn_get(q, IQN_PAIRS), 2);
    CHECK_INT(iqn_get(q, IQN_NRESTARTED), 0);
    for (k = 4; k < 8 && iqn_converged(q) != 1; k++) {
        h[0] = 1, h[1] = 0.1 + 51 * x[1];
        CHECK(iqn_step(q, x, h) >= 0);
    }
    CHECK_INT(iqn_converged(q), 1);
    free(mem);
}

/* A new window of a nonlinear run explores, unless IQN_GROWTH is 0 by now. */
static void test_a_new_window_explores_where_growth_is_watched(void **state)
{
    static const double growth[] = {5, 0.5, 0};
    size_t k;
    (void)state;
    for (k = 0; k < 3; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 2, 1);
        double x = 0;
        const double h = 1;
        CHECK_INT(iqn_set(q, IQN_GROWTH, growth[k]), IQN_OK);
        q->nonlinear = 1;
        CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
        CHECK_INT(q->exploring, growth[k] > 0);
        free(mem);
    }
}

/* Rounding errors prove nothing: an affine H, iterated far below its tolerance in every window, is not called nonlinear, and later
   windows do not explore.  Hardly one is called curved or inexact.  Also with a filter limit, and with noise as large as
   IQN_NOISE_LEVEL says.  (Without a look at the noise: 56 of the 90.) */
static void test_noise_does_not_prove_an_affine_h_nonlinear(void **state)
{
    enum { N = 3 };
    static const struct {
        double limit, noise;
    } row[] = {{0, 0}, {1e-10, 0}, {0, 1e-6}};
    unsigned long long seed = 63;
    int run, window, k, i, j, misjudged = 0;
    (void)state;
    for (run = 0; run < 90; run++) {
        const double size = pow(3, run % 3), noise = row[run % 9 / 3].noise;
        double A[N][N], x[N] = {0}, h[N];
        void *mem;
        iqn *q = make(&mem, N, 20, 1);
        for (i = 0; i < N; i++)
            for (j = 0; j < N; j++) A[i][j] = size * random_number(&seed);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, row[run % 9 / 3].limit), IQN_OK);
        if (noise > 0) CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, noise), IQN_OK);
        for (window = 0; window < 10; window++) {
            for (k = 0; k < 14 && iqn_converged(q) != 1; k++) {
                for (i = 0; i < N; i++) {
                    h[i] = 1 + sin(0.3 * window + i);
                    for (j = 0; j < N; j++) h[i] += A[i][j] * x[j];
                    h[i] *= 1 + noise * random_number(&seed);
                }
                CHECK(iqn_step(q, x, h) >= 0);
            }
            CHECK(!q->nonlinear);
            CHECK_INT(iqn_get(q, IQN_NEXPLORED), 0);
            CHECK_INT(iqn_commit(q), IQN_OK);
        }
        misjudged += q->curved || q->inexact;
        free(mem);
    }
    CHECK(misjudged < 6);
}

/* A step of a block that nobody can measure makes no slope, whatever the other block did. */
static void test_a_step_too_long_to_measure_is_no_slope(void **state)
{
    double x[2] = {0, 0}, h[2];
    void *mem;
    iqn *q = make(&mem, 2, 5, 2);
    int k;
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 1e155), IQN_OK);
    for (k = 0; k < 2; k++) {
        h[0] = k == 0 ? 1 : 2e155, h[1] = 1 + 0.5 * x[1];
        CHECK(iqn_step(q, x, h) >= 0);
    }
    CHECK(q->slope <= 1);
    free(mem);
}

/* Once H has proved nonlinear, a step is taken back only where it raised |r|, whatever IQN_GROWTH is, and what comes next is another
   x: also where IQN_GROWTH was 0 in the first step of the window.  (With a filter limit, for then doubt has no effect.) */
static void test_no_x_comes_twice_in_a_nonlinear_run(void **state)
{
    enum { N = 5 };
    unsigned long long seed = 3;
    int run, k, i, j, taken_back = 0;
    (void)state;
    for (run = 0; run < 120; run++) {
        const int late = run % 2;
        void *mem;
        iqn *q = make(&mem, N, 10, 1);
        double A[N][N], b[N], x[N], h[N], last[N] = {0};
        for (i = 0; i < N; i++) {
            b[i] = random_number(&seed), x[i] = random_number(&seed);
            for (j = 0; j < N; j++) A[i][j] = random_number(&seed);
        }
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-8), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_GROWTH, late ? 0 : 0.2), IQN_OK);
        if (late) q->nonlinear = 1;
        for (k = 0; k < 40; k++) {
            const int nonlinear = q->nonlinear;
            const double least = k > 0 ? iqn__value_of(q->best) : 0;
            int status, same;
            for (i = 0; i < N; i++) {
                double y = b[i];
                for (j = 0; j < N; j++) y += A[i][j] * x[j];
                h[i] = y + (late ? 4 * sin(3 * y) : 2 * sin(2 * y));
            }
            status = iqn_step(q, x, h);
            CHECK(status >= 0);
            same = memcmp(x, last, sizeof x) == 0;
            memcpy(last, x, sizeof x);
            if (late) CHECK_INT(iqn_set(q, IQN_GROWTH, 5), IQN_OK);
            if (!nonlinear || status != IQN_WITHDRAWN) continue;
            taken_back++;
            CHECK(!same);
            CHECK(iqn_get(q, IQN_RESIDUAL) > least);
        }
        free(mem);
    }
    CHECK(taken_back > 10);
}

/* More than 0.09 of what is uncertain, and not as much as that. */
static void test_what_stands_out(void **state)
{
    (void)state;
    CHECK(!iqn__stands_out(0.09, 1, 0));
    CHECK(iqn__stands_out(0.0901, 1, 0));
    CHECK(!iqn__stands_out(1.0899, 0, 1));
    CHECK(iqn__stands_out(1.0901, 0, 1));
    CHECK(iqn__stands_out(1e-300, 0, 0));
    CHECK(!iqn__stands_out(0, 0, 0));
}

/* One bit of one number, the order of two numbers: the host has changed x. */
static void test_a_fingerprint_sees_every_bit(void **state)
{
    enum { N = 9 };
    unsigned long long seed = 6;
    double x[N];
    uint64_t right, bits;
    int i, bit;
    (void)state;
    for (i = 0; i < N; i++) x[i] = random_number(&seed);
    for (bit = 0; bit < 64; bit++)
        for (i = 0; i < N; i++) {
            const double keep = x[i];
            right = iqn__fingerprint(100, N, x);
            memcpy(&bits, x + i, sizeof bits);
            bits ^= (uint64_t)1 << bit;
            memcpy(x + i, &bits, sizeof bits);
            CHECK(iqn__fingerprint(100, N, x) != right);
            x[i] = keep;
        }
    for (i = 1; i < N; i++) {
        double other[N];
        memcpy(other, x, sizeof x);
        other[i] = x[i - 1], other[i - 1] = x[i];
        CHECK(iqn__fingerprint(100, N, other) != right);
    }
    CHECK(iqn__fingerprint(100, 4, x) + iqn__fingerprint(104, N - 4, x + 4) == right); /* in pieces, too */
}

/* The terms of two groups of four do not cancel where one number of each changes its sign, doubles or is halved: not
   once in 2.4 million (chance: once in 2^32).  With 32 bits of a square in place of all: once in 1e5 sign changes. */
static void test_a_fingerprint_sees_two_alike(void **state)
{
    static const double factor[] = {-1, 2, 0.5};
    unsigned long long seed = 11;
    double x[8], other[8];
    int i, run;
    (void)state;
    for (run = 0; run < 2400000 / LESS; run++) {
        const int one = run / 3 % 4;
        for (i = 0; i < 8; i++) x[i] = random_number(&seed);
        memcpy(other, x, sizeof x);
        other[one] *= factor[run % 3];
        other[4 + one] *= factor[run % 3];
        if (iqn__fingerprint(8, 8, other) == iqn__fingerprint(8, 8, x)) fail_msg("run %d", run);
    }
}

/* Nor is a field that changes as a whole overlooked: halved, doubled, negated, or only its first two numbers, or one
   component of vectors of four. */
static void test_a_fingerprint_sees_whole_fields(void **state)
{
    static const double factor[] = {0.5, 2, 8, -1, -2, -0.5};
    static double x[256], other[256];
    int n, i, f, kind, component;
    (void)state;
    for (kind = 0; kind < 3; kind++) {
        for (i = 0; i < 256; i++) x[i] = kind == 0 ? sin(i + 1) : kind == 1 ? 1 : (i % 4 == 1 || i % 4 == 2 ? -i - 1 : i + 1);
        for (n = 1; n <= 256; n++)
            for (f = 0; f < 6; f++) {
                for (i = 0; i < n; i++) other[i] = factor[f] * x[i];
                CHECK(iqn__fingerprint(0, n, other) != iqn__fingerprint(0, n, x));
                for (i = 0; i < n; i++) other[i] = i < 2 ? factor[f] * x[i] : x[i];
                CHECK(iqn__fingerprint(0, n, other) != iqn__fingerprint(0, n, x));
                for (component = 0; component < 4 && component < n; component++) {
                    for (i = 0; i < n; i++) other[i] = i % 4 == component ? factor[f] * x[i] : x[i];
                    CHECK(iqn__fingerprint(0, n, other) != iqn__fingerprint(0, n, x));
                }
            }
    }
}

/* So the host may halve or negate x of an affine H, and no step is taken back for it. */
static void test_a_field_changed_by_the_host_is_no_bad_step(void **state)
{
    static const double factor[] = {0.5, 8, -1};
    enum { N = 64 };
    double x[N], hx[N];
    int i, t, f;
    (void)state;
    for (f = 0; f < 3; f++) {
        void *mem;
        iqn *q = make(&mem, N, 10, 1);
        for (i = 0; i < N; i++) x[i] = 1;
        for (t = 0; t < 7; t++) {
            for (i = 0; i < N && t == 4; i++) x[i] *= factor[f];
            for (i = 0; i < N; i++) hx[i] = (i % 3 - 0.8) * 0.4 * x[i] + 2 + sin(i + 1);
            CHECK(iqn_step(q, x, hx) >= 0);
        }
        CHECK(iqn_get(q, IQN_NWITHDRAWN) == 0);
        free(mem);
    }
}

/* A step whose length overflows once the ranks' are added: the steps after it are not refused for that. */
static void test_a_step_too_long_to_add_up(void **state)
{
    double x[1] = {0}, hx[1], v[1] = {1}, w[1] = {2};
    int two = 2;
    void *mem;
    iqn *q = make(&mem, 1, 3, 1);
    (void)state;
    CHECK_INT(iqn_set_sum(q, sum_of_like_ranks, &two), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 1.7), IQN_OK);
    hx[0] = ldexp(1, -512);
    CHECK(iqn_step(q, x, hx) >= 0);
    hx[0] = 1.5;
    CHECK(iqn_step(q, x, hx) >= 0);
    CHECK(iqn_push(q, v, w) >= 0);
    free(mem);
}

/* An affine H of n numbers whose derivative has entries up to `size`. */
typedef struct random_map {
    int n;
    double J[64], b[8];
} random_map;

static void random_map_make(random_map *a, int n, double size, unsigned long long *seed)
{
    int i;
    a->n = n;
    for (i = 0; i < n * n; i++) a->J[i] = size * random_number(seed);
    for (i = 0; i < n; i++) a->b[i] = random_number(seed);
}

static void random_map_apply(const random_map *a, const double *x, double *hx)
{
    int i, j;
    for (i = 0; i < a->n; i++)
        for (hx[i] = a->b[i], j = 0; j < a->n; j++) hx[i] += a->J[i * a->n + j] * x[j];
}

/* Steps of q from x, until it has converged. */
static void random_map_run(const random_map *H, iqn *q, double *x, int most)
{
    double hx[8];
    int k;
    for (k = 0; k < most && !iqn_converged(q); k++) {
        random_map_apply(H, x, hx);
        CHECK(iqn_step(q, x, hx) >= 0);
    }
}

/* A probe that a bound has clamped, for the first guess lies outside, is no proof that an affine H is not. */
static void test_a_clamped_probe_proves_nothing(void **state)
{
    unsigned long long seed = 5;
    int run, k, withdrawn = 0;
    (void)state;
    for (run = 0; run < 300; run++) {
        double x[3], d[3], v[3], w[3];
        random_map H;
        void *mem;
        iqn *q = make(&mem, 3, 10, 1);
        random_map_make(&H, 3, 3, &seed);
        iqn_set(q, IQN_GROWTH, 2);
        iqn_set_block(q, -1, IQN_LOWER, 0);
        for (k = 0; k < 3; k++) {
            x[k] = -0.1 * (1 + random_number(&seed));
            d[k] = random_number(&seed);
        }
        random_map_apply(&H, d, w);
        for (k = 0; k < 3; k++) {
            w[k] -= H.b[k];
            v[k] = w[k] - d[k];
        }
        CHECK(iqn_push(q, v, w) >= 0);
        iqn_set(q, IQN_TOL_RELATIVE, 1e-9);
        random_map_run(&H, q, x, 6);
        withdrawn += iqn_get(q, IQN_NWITHDRAWN) > 0;
        CHECK_INT(q->nonlinear, 0);
        free(mem);
    }
    CHECK(withdrawn > 30);
}

/* A number at its bound that misses it by round-off is not clamped; one beyond it, or infinite, is. */
static void test_what_counts_as_clamped(void **state)
{
    static const double bound[2] = {0.99, 2};
    const struct {
        double h, y, x;
        int clamped;
    } row[] = {{0.5, 0.49, 0.99, 0},
               {0.99, -DBL_EPSILON, 0.99, 0},
               {2, 2 * DBL_EPSILON, 2, 0},
               {0.99, -1e-9, 0.99, 1},
               {1.5, 0.5 + 1e-9, 2, 1},
               {1, 0.5, 1.5, 0},
               {1, HUGE_VAL, 2, 1},
               {1, -HUGE_VAL, 0.99, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        const double r = 0;
        double x, squares[4];
        CHECK_INT(iqn__write_next_within(1, &r, &row[k].h, 1, bound, &row[k].y, &x, squares), row[k].clamped);
        CHECK_NEAR(x, row[k].x, 1e-15);
    }
}

/* A mixing of 30 multiplies what a full step leaves: no surprise on an affine H. */
static void test_a_large_mixing_is_no_curvature(void **state)
{
    unsigned long long seed = 6;
    int run;
    (void)state;
    for (run = 0; run < 200; run++) {
        double x[8] = {0};
        random_map H;
        void *mem;
        iqn *q = make(&mem, 8, 20, 1);
        random_map_make(&H, 8, 0.3, &seed);
        iqn_set(q, IQN_TOL_RELATIVE, 1e-9);
        iqn_set(q, IQN_MIXING, 30);
        random_map_run(&H, q, x, 40);
        CHECK_INT(iqn_converged(q), 1);
        CHECK(q->curved == 0 && q->surprises == 0);
        free(mem);
    }
}

/* IQN_WINDOWS 0: the first step of a window was made with past pairs, and what they miss is their age. */
static void test_pairs_kept_for_one_step_are_past_ones(void **state)
{
    unsigned long long seed = 7;
    int run;
    (void)state;
    for (run = 0; run < 200; run++) {
        double x[8] = {0};
        random_map H;
        void *mem;
        iqn *q = make(&mem, 8, 20, 1);
        random_map_make(&H, 8, 0.3, &seed);
        iqn_set(q, IQN_TOL_RELATIVE, 1e-9);
        iqn_set(q, IQN_WINDOWS, 0);
        random_map_run(&H, q, x, 40);
        CHECK_INT(iqn_converged(q), 1);
        iqn_commit(q);
        random_map_make(&H, 8, 0.3, &seed);
        random_map_run(&H, q, x, 2);
        CHECK_INT(q->missed, 0);
        free(mem);
    }
}

/* |hx| grown by more than a double holds: the guard compares |r| with limit 1000 h all the same. */
static void test_the_guard_of_a_growth_that_overflows(void **state)
{
    static const double from[2] = {1e-150, 1e-160};
    double x[1], hx[1];
    int k;
    (void)state;
    for (k = 0; k < 2; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 3, 1);
        iqn_set(q, IQN_TOL_RELATIVE, 1e-6);
        x[0] = 1e145;
        hx[0] = from[k];
        CHECK(iqn_step(q, x, hx) >= 0);
        hx[0] = 1e150;
        x[0] = hx[0] * (1 - 1e-15);
        CHECK(iqn_step(q, x, hx) >= 0);
        CHECK_INT(iqn_converged(q), 0);
        free(mem);
    }
}

/* |r| falls by 2^535 in one step: squares that are subnormal in the old unit are summed anew. */
static void test_a_residual_far_below_the_one_before(void **state)
{
    double x[1] = {0}, hx[1];
    void *mem;
    iqn *q = make(&mem, 1, 3, 1);
    (void)state;
    hx[0] = ldexp(1, 245);
    CHECK(iqn_step(q, x, hx) >= 0);
    x[0] = 0;
    hx[0] = ldexp(1.3, -290);
    CHECK(iqn_step(q, x, hx) >= 0);
    CHECK_NEAR(iqn_get(q, IQN_RESIDUAL) / hx[0], 1, 1e-15);
    free(mem);
}

/* Where the pairs explain all of r but 1e-11 of it, this is what IQN_PREDICTED says. */
static void test_what_is_left_of_nearly_nothing(void **state)
{
    enum { N = 12, M = 4 };
    unsigned long long seed = 21;
    void *mem;
    iqn *q = make(&mem, N, M, 1);
    double x[N] = {0}, h[N], v[N], left = 1e-11;
    int i, k;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0), IQN_OK);
    for (i = 0; i < N; i++) h[i] = 0;
    for (k = 0; k < M; k++) { /* in the first numbers alone */
        const double part = random_number(&seed);
        for (i = 0; i < N; i++) v[i] = i < M ? random_number(&seed) : 0, h[i] += part * v[i];
        CHECK_INT(iqn_push(q, v, v), IQN_OK);
    }
    h[N - 1] = left;
    CHECK_INT(iqn_step(q, x, h), IQN_OK);
    CHECK_NEAR(iqn_get(q, IQN_PREDICTED), left, 1e-3 * left);
    free(mem);
}

/* H answers otherwise at the same x: a slope over no distance is not infinite, it is not known. */
static void test_no_slope_over_no_distance(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {1, 1}, h[2] = {2, 3}, slope;
    int k;
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 1), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_UPPER, 1), IQN_OK); /* x stays */
    for (k = 0; k < 4; k++) {
        slope = q->slope;
        h[0] = 2 + 0.01 * k;
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK(x[0] == 1 && x[1] == 1);
        CHECK(q->slope == slope && q->steepest == 0);
    }
    free(mem);
}

/* |r| that has grown exactly IQN_GROWTH times is not "more than so many times".  One number and one pair: nothing should be left,
   so that any growth above 1 is a surprise; IQN_GROWTH 0 looks at none of it. */
static void test_growth_at_its_limit(void **state)
{
    static const struct {
        double limit, growth;
        int withdrawn, surprises;
    } row[] = {{5, 5, 0, 1},     {5, 5.0625, 1, 1}, {1, 1.5, 1, 1}, {1, 1, 0, 0},
               {0.5, 0.75, 1, 0}, {0.5, 1.25, 1, 1}, {0, 100, 0, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 5, 1);
        double x = 0, h = 1, v = -2, w = -1;
        CHECK_INT(iqn_set(q, IQN_GROWTH, row[k].limit), IQN_OK);
        CHECK_INT(iqn_push(q, &v, &w), IQN_OK);
        CHECK_INT(iqn_step(q, &x, &h), IQN_OK); /* |r| = 1 */
        h = x - row[k].growth;
        CHECK_INT(iqn_step(q, &x, &h) == IQN_WITHDRAWN, row[k].withdrawn);
        CHECK_INT(q->surprises, row[k].surprises);
        free(mem);
    }
}

/* The answer is hx, wherever the next step would have started from: here the limit holds after a step that was only there to learn. */
static void test_the_answer_is_that_of_the_last_call(void **state)
{
    int kind;
    (void)state;
    for (kind = IQN__PLAIN; kind <= IQN__SMALL; kind++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 1);
        double x[2] = {0, 0}, h[2] = {1, 2};
        int k;
        for (k = 0; k < 2; k++) {
            h[0] = 1 + k, h[1] = 2 + 0.5 * k;
            CHECK(iqn_step(q, x, h) >= 0);
        }
        q->kind = kind;
        CHECK_INT(iqn_set(q, IQN_TOL_ABSOLUTE, 100), IQN_OK);
        h[0] = x[0] + 5, h[1] = x[1] - 7;
        CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
        CHECK(memcmp(x, h, sizeof x) == 0);
        CHECK_INT((int)iqn_get(q, IQN_NWITHDRAWN), 0);
        free(mem);
    }
}

/* Half of the way back to the base, wherever that is kept. */
static void test_halving_from_any_base(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 3, 1);
    double x[2] = {1, 2}, h[2], from[2], to[2];
    int k, i;
    (void)state;
    for (k = 0; k < 7; k++) {
        memcpy(from, x, sizeof x);
        h[0] = cos(x[0] + k), h[1] = 0.3 * x[0] - 0.2 * x[1] + k;
        textbook(q); /* the base is the last iterate */
        CHECK(iqn_step(q, x, h) >= 0);
        memcpy(to, x, sizeof x);
        CHECK_INT(iqn_halve(q, x), IQN_OK);
        for (i = 0; i < 2; i++) CHECK_NEAR(x[i], 0.5 * (from[i] + to[i]), 1e-14 * (1 + fabs(from[i]) + fabs(to[i])));
    }
    free(mem);
}

/* With one number, too, an array that is NULL is refused; and a push where there is no column. */
static void test_null_arrays_of_one_number(void **state)
{
    void *mem[2];
    iqn *q = make(&mem[0], 1, 3, 1), *none = make(&mem[1], 1, 0, 1);
    double a = 1, b = 2, c = 3;
    (void)state;
    CHECK_INT(iqn_step(q, NULL, &b), IQN_ENULL);
    CHECK_INT(iqn_step(q, &a, NULL), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, NULL, &b, &c), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, &a, NULL, &c), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, &a, &b, NULL), IQN_ENULL);
    CHECK_INT(iqn_push(q, NULL, &b), IQN_ENULL);
    CHECK_INT(iqn_push(q, &a, NULL), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, NULL, &b, &c), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, &a, NULL, &c), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, &a, &b, NULL), IQN_ENULL);
    CHECK_INT(iqn_push(none, &a, &b), IQN_EARG);
    CHECK_INT(iqn_push_metric(none, &a, &b, &c), IQN_EARG);
    CHECK_INT(iqn_step(q, &a, &b), IQN_RELAXED);
    CHECK_INT(iqn_halve(q, NULL), IQN_ENULL);
    CHECK_INT(iqn_push(q, &a, &b), IQN_OK);
    CHECK_INT(iqn_pair(q, 0, &a, &a), IQN_EOVERLAP);
    CHECK_INT(iqn_set_block(q, 0, IQN_TOL_RELATIVE, 0.25), IQN_OK);
    CHECK(iqn_get_block(q, 0, IQN_TOL_RELATIVE) == 0.25);
    free(mem[0]);
    free(mem[1]);
}

/* Two nearly parallel pairs explain a residual of 1e305 with coefficients of 1e311, which are no numbers: relaxation. */
static void test_coefficients_beyond_all_numbers(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    const double v[2][2] = {{1, 0}, {1, 1e-6}}, w[2] = {1e-9, 1e-9};
    double x[2] = {0, 0};
    const double h[2] = {0, 1e305};
    int j;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0), IQN_OK);
    for (j = 0; j < 2; j++) CHECK_INT(iqn_push(q, v[j], w), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    CHECK(x[0] == 0);
    CHECK_NEAR(x[1], 1e304, 1e290);
    free(mem);
}

/* V is read once where the last |r|, or 1 in the first step, is a fair guess of this one: the unit of the sums is that of the guess. */
static void test_a_fair_guess_of_the_unit_stays(void **state)
{
    static const int power[] = {2, 200, -200}; /* |r| = 2^power, then half of it */
    size_t k;
    (void)state;
    for (k = 0; k < sizeof power / sizeof *power; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 5, 1);
        double x = 0, h = ldexp(1, power[k]);
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK_INT(q->e, power[k] == 2 ? 0 : power[k] + 1);
        h = x + ldexp(0.5, power[k]);
        CHECK(iqn_step(q, &x, &h) >= 0);
        CHECK_INT(q->e, power[k] + 1);
        free(mem);
    }
}

/* A bound moves x by 1e200 times |r|: how far, nobody can square, and the next step goes on. */
static void test_a_bound_far_away_is_no_error(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 5, 1);
    double x = 0, h = 1e-190;
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, 1e10), IQN_OK);
    CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
    CHECK(x == 1e10);
    CHECK(iqn__open(q).block[0].moved == 1e300); /* 1e400 times |r|^2: not known */
    h = 2e10;
    CHECK(iqn_step(q, &x, &h) >= 0);
    CHECK(x >= 1e10 && x <= 1e300);
    free(mem);
}

/* Two columns of 1e308 and more cancel in a row: no NaN is handed out. */
static void test_columns_that_cancel_beyond_the_range(void **state)
{
    static const double v[2][2] = {{1, 0}, {0, 1}}, w[2] = {1e200, 0}, h[2] = {1e200, -1e200};
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {0, 0};
    (void)state;
    CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0), IQN_OK);
    CHECK_INT(iqn_push(q, v[0], w), IQN_OK);
    CHECK_INT(iqn_push(q, v[1], w), IQN_OK);
    CHECK(iqn_step(q, x, h) >= 0); /* a = (-1e200, 1e200) */
    CHECK(iqn__finite(x[0]) && iqn__finite(x[1]));
    free(mem);
}

/* A sum of residuals that is exactly tenfold the one in use, or its tenth, takes its place; less does not. */
static void test_a_tenfold_sum_of_residuals(void **state)
{
    static const struct {
        double sum, used;
        int update;
    } row[] = {{9, 1, 1}, {9, 1.0625, 0}, {9, 100, 1}, {9, 99, 0}, {9, 101, 1}, {9, 0.9375, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 0, 1);
        const iqn__view m = iqn__open(q);
        q->residual = m.block[0].residual = iqn__root(4, 0);
        q->iterations = 2;
        m.block[0].sum = row[k].sum, m.block[0].used_sum = row[k].used;
        iqn__sum_residuals(q, &m);
        CHECK(m.block[0].sum == 10);
        CHECK(m.block[0].used_sum == (row[k].update ? 10 : row[k].used));
        free(mem);
    }
}

/* A block that is at rest in a window keeps the sum that is in use while the one of another is replaced. */
static void test_a_block_at_rest_keeps_its_sum_of_residuals(void **state)
{
    static const double r[2][2] = {{0.03, 0.04}, {1, 0}};
    void *mem;
    iqn *q = make(&mem, 2, 3, 2);
    const iqn__view m = iqn__open(q);
    double x[2] = {1, 1}, h[2];
    int k, i;
    (void)state;
    CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, IQN_BY_RESIDUAL_SUM), IQN_OK);
    for (k = 0; k < 2; k++) {
        m.block[0].used_sum = 0.06; /* far below: it is replaced */
        for (i = 0; i < 2; i++) h[i] = x[i] + r[k][i];
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_NEAR(m.block[0].used_sum, k == 0 ? 0.6 : 1, 1e-14);
        CHECK_NEAR(m.block[1].used_sum, 0.8, 1e-14);
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    free(mem);
}

/* |x - x_base| is at most the sum of four norms below 2^e, which is below 2^(e + 2), whichever of them is the largest. */
static void test_the_bound_of_a_step(void **state)
{
    int which;
    (void)state;
    for (which = 0; which < 4; which++) {
        iqn__block block;
        iqn__norm small = iqn__root(1, 3), large = iqn__root(1, 30);
        memset(&block, 0, sizeof block);
        block.now = which == 0 ? large : small;
        block.now_value = which == 1 ? large : small;
        block.base_residual = which == 2 ? large : small;
        block.base_value = which == 3 ? large : small;
        CHECK_INT(iqn__step_bound(&block), large.e + 2);
    }
}

/* While the weights stay, a step computes the rows of new pairs alone; where they change, all. */
static void test_the_small_matrix_is_kept(void **state)
{
    enum { N = 6 };
    void *mem;
    iqn *q = make(&mem, N, 8, 2);
    const iqn__view m = iqn__open(q);
    double x[N] = {0}, h[N], wrong = 0;
    iqn__dd *mark = NULL;
    int k, i;
    (void)state;
    textbook(q);
    for (k = 0; k < 7; k++) {
        for (i = 0; i < N; i++) h[i] = cos(i + k * k);
        if (k == 5) CHECK_INT(iqn_set_block(q, 1, IQN_WEIGHT, 3), IQN_OK);
        CHECK(iqn_step(q, x, h) >= 0);
        if (k == 3) { /* the product of an older pair with itself, a little wrong */
            mark = m.S + (ptrdiff_t)m.order[1] * m.slots + m.order[1];
            wrong = mark->h *= 1 + 1e-9;
        }
        if (k == 4) CHECK(mark->h == wrong);
        if (k == 5) CHECK(mark->h != wrong);
    }
    free(mem);
}

/* A window without steps and pairs is none: it does not count for IQN_MERGE. */
static void test_empty_windows_do_not_merge(void **state)
{
    enum { N = 6 };
    int empty, groups[2];
    (void)state;
    for (empty = 0; empty < 2; empty++) {
        void *mem;
        iqn *q = make(&mem, N, 20, 1);
        const iqn__view m = iqn__open(q);
        double x[N] = {0}, h[N];
        int window, k, i, j;
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_MERGE, 4), IQN_OK);
        textbook(q);
        for (window = 0; window < 3; window++) {
            for (k = 0; k < 3; k++) {
                for (i = 0; i < N; i++) h[i] = cos(i * i + 3 * k + 10 * window);
                CHECK(iqn_step(q, x, h) >= 0);
            }
            CHECK_INT(iqn_commit(q), IQN_OK);
            if (empty) CHECK_INT(iqn_commit(q), IQN_OK);
        }
        for (groups[empty] = 1, j = 1; j < q->used; j++) groups[empty] += m.window[m.order[j]] != m.window[m.order[j - 1]];
        CHECK_INT(groups[empty], 3);
        free(mem);
    }
}

/* Multiplying a column touches its numbers alone. */
static void test_scaling_leaves_what_is_behind(void **state)
{
    double h[13], l[13];
    int n, i;
    (void)state;
    for (n = 0; n <= 12; n += 4) {
        for (i = 0; i < 13; i++) h[i] = 1 + i, l[i] = 0;
        iqn__scale(n, h, l, iqn__dd_of(0.5));
        for (i = 0; i < 13; i++) CHECK(h[i] == (i < n ? 0.5 : 1) * (1 + i) && l[i] == 0);
    }
}

/* ---- settings and small print ------------------------------------------------------------------ */

enum { SETTING_N = 12, SETTING_WINDOWS = 4 };

/* Two fields of different size, weakly nonlinear, another right-hand side in every window. */
static void setting_map(int window, const double *x, double *hx)
{
    int i;
    for (i = 0; i < SETTING_N; i++) {
        const double left = x[(i + 1) % SETTING_N], right = x[(i + SETTING_N - 1) % SETTING_N];
        const double size = i < SETTING_N / 2 ? 1 : 30;
        hx[i] = size * (1 + 0.3 * sin(window + i)) - 1.3 * x[i] + 0.4 * (left - 0.7 * right) + 0.05 * size * sin(x[i] / size);
    }
}

/* Every iterate of some windows, summed with a weight of its own, after one setting: block -2 none, -1 all or the whole. */
static double setting_run(int columns, int key, int block, double value, int method)
{
    void *mem;
    iqn *q = make(&mem, SETTING_N, columns, 2);
    double x[SETTING_N], hx[SETTING_N], sum = 0;
    int window, i, k = 0, end;
    for (i = 0; i < SETTING_N; i++) x[i] = 0.1 * i;
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-7), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_METHOD, method), IQN_OK);
    if (block > -2) CHECK_INT(key < IQN_LENGTH && block < 0 ? iqn_set(q, key, value) : iqn_set_block(q, block, key, value), IQN_OK);
    for (window = 0; window < SETTING_WINDOWS; window++) {
        do {
            setting_map(window, x, hx);
            CHECK(iqn_step(q, x, hx) >= 0);
            end = iqn_converged(q);
            for (i = 0; i < SETTING_N; i++) sum += x[i] * cos(0.1 * ++k);
        } while (end == 0 && iqn_get(q, IQN_ITERATIONS) < 60);
        sum += 100 * end + iqn_get(q, IQN_PAIRS);
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    free(mem);
    return sum;
}

/* The numbers next to the ends: inside they are accepted, outside refused, and halves where they must be whole. */
static void neighbours_of_the_range(iqn *q, int key, double lowest, double highest)
{
    const int blocked = key >= IQN_LENGTH, whole = key == IQN_METHOD || key == IQN_WINDOWS || key == IQN_MAX_ITERATIONS ||
                                                   key == IQN_PATIENCE || key == IQN_MERGE || key == IQN_SCALING;
    const double below = lowest > 0 || lowest < 0 ? fabs(lowest) * DBL_EPSILON : DBL_MIN, above = highest * DBL_EPSILON;
    const double value[4] = {lowest - (whole ? 1 : below), lowest + (whole ? 1 : below), highest - (whole ? 1 : above),
                             highest + (whole ? 1 : above)};
    int i, status;
    for (i = 0; i < 4; i++) {
        if (blocked) { /* a lower bound is not above an upper one */
            CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, -DBL_MAX), IQN_OK);
            CHECK_INT(iqn_set_block(q, 0, IQN_UPPER, DBL_MAX), IQN_OK);
        }
        status = blocked ? iqn_set_block(q, 0, key, value[i]) : iqn_set(q, key, value[i]);
        CHECK_INT(status, i == 0 || i == 3 ? IQN_EVALUE : IQN_OK);
    }
    status = blocked ? iqn_set_block(q, 0, key, lowest + 0.5) : iqn_set(q, key, lowest + 0.5);
    CHECK_INT(status, whole ? IQN_EVALUE : IQN_OK);
}

/* Of every key: its default is what the comment says, the ends of its range are accepted, what lies beyond is refused, and
   another value changes the run; of a key of blocks: in either block. */
static void test_every_setting_has_its_default_its_range_and_its_effect(void **state)
{
    static const struct {
        int key;
        double standard, other, lowest, highest, beyond;
        int method, columns;
    } row[] = {
        {IQN_METHOD, IQN_ILS, IQN_AITKEN, IQN_ILS, IQN_CONSTANT, 4, IQN_ILS, 8},
        {IQN_OMEGA, 0.1, 0.2, -1e6, 1e6, 1.1e6, IQN_ILS, 8},
        {IQN_FILTER_LIMIT, 0, 0.3, 0, 1, 1.5, IQN_ILS, 8},
        {IQN_WINDOWS, -1, 0, -1, 1e6, 2e6, IQN_ILS, 40},
        {IQN_TOL_ABSOLUTE, 0, 1, 0, DBL_MAX, -1, IQN_ILS, 8},
        {IQN_TOL_RELATIVE, 0, 0.5, 0, DBL_MAX, -1, IQN_ILS, 8},
        {IQN_TOL_REDUCTION, 0, 0.5, 0, DBL_MAX, -1, IQN_ILS, 8},
        {IQN_MAX_ITERATIONS, 0, 3, 0, 1e9, 1.5, IQN_ILS, 8},
        {IQN_PATIENCE, 20, 20, 0, 1e9, -1, IQN_ILS, 8}, /* its effect: below */
        {IQN_MIXING, 1, 0.3, -1e6, 1e6, 0, IQN_ILS, 8},
        {IQN_NOISE_LEVEL, 1e-13, 0.1, 0, 1, 1.5, IQN_ILS, 8},
        {IQN_GROWTH, 5, 1e-3, 0, DBL_MAX, -1, IQN_ILS, 8},
        {IQN_MERGE, 0, 1, 0, 1e6, 0.5, IQN_IMVJ, 40},
        {IQN_SCALING, IQN_BY_WEIGHT, IQN_BY_RESIDUAL_SUM, 0, IQN_BY_RESIDUAL_SUM, 4, IQN_ILS, 8},
        {IQN_SCALING, IQN_BY_WEIGHT, IQN_BY_VALUE, 0, IQN_BY_RESIDUAL_SUM, -1, IQN_ILS, 8},
        {IQN_SCALING, IQN_BY_WEIGHT, IQN_BY_RESIDUAL, 0, IQN_BY_RESIDUAL_SUM, 1.5, IQN_ILS, 8},
        {IQN_WEIGHT, 1, 3, 0, 1e150, 1.1e150, IQN_ILS, 8},
        {IQN_LOWER, -DBL_MAX, 14, -DBL_MAX, DBL_MAX, (double)INFINITY, IQN_ILS, 8},
        {IQN_UPPER, DBL_MAX, 0.4, -DBL_MAX, DBL_MAX, (double)INFINITY, IQN_ILS, 8},
    };
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        const int key = row[k].key, blocked = key >= IQN_LENGTH;
        const double untouched = setting_run(row[k].columns, key, -2, 0, row[k].method);
        const double all = setting_run(row[k].columns, key, -1, row[k].other, row[k].method);
        void *mem;
        iqn *q = make(&mem, SETTING_N, row[k].columns, 2);
        CHECK((blocked ? iqn_get_block(q, 1, key) : iqn_get(q, key)) == row[k].standard);
        CHECK_INT(blocked ? iqn_set_block(q, 0, key, row[k].lowest) : iqn_set(q, key, row[k].lowest), IQN_OK);
        CHECK((blocked ? iqn_get_block(q, 0, key) : iqn_get(q, key)) == row[k].lowest);
        CHECK_INT(blocked ? iqn_set_block(q, 1, key, row[k].highest) : iqn_set(q, key, row[k].highest), IQN_OK);
        CHECK((blocked ? iqn_get_block(q, 1, key) : iqn_get(q, key)) == row[k].highest);
        CHECK_INT(blocked ? iqn_set_block(q, 1, key, row[k].beyond) : iqn_set(q, key, row[k].beyond), IQN_EVALUE);
        CHECK((blocked ? iqn_get_block(q, 1, key) : iqn_get(q, key)) == row[k].highest);
        neighbours_of_the_range(q, key, row[k].lowest, row[k].highest);
        free(mem);
        if (key != IQN_TOL_RELATIVE) /* the run has its own */
            CHECK(setting_run(row[k].columns, key, -1, row[k].standard, row[k].method) == untouched);
        if (row[k].other != row[k].standard && key != IQN_METHOD && key != IQN_WEIGHT) CHECK(all != untouched);
        if (blocked) {
            const double first = setting_run(row[k].columns, key, 0, row[k].other, row[k].method);
            const double second = setting_run(row[k].columns, key, 1, row[k].other, row[k].method);
            CHECK(first != untouched);
            CHECK(second != untouched);
            CHECK(first != second);
        }
    }
    CHECK(setting_run(8, IQN_METHOD, -2, 0, IQN_AITKEN) != setting_run(8, IQN_METHOD, -2, 0, IQN_ILS));
}

/* Relaxation by a constant factor is a closed formula: every length, every component, both bounds. */
static void test_relaxation_and_bounds_of_every_length(void **state)
{
    enum { MOST = 601 }; /* rows are taken by 256 */
    int n, i, blocks;
    (void)state;
    for (n = 1; n < MOST; n += n < 40 ? 1 : 280)
        for (blocks = 1; blocks <= 2 && blocks <= n; blocks++) {
            double x[MOST + 1], hx[MOST + 1], start[MOST + 1], moved = 0;
            void *mem;
            iqn *q = make(&mem, n, 4, blocks);
            CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
            CHECK_INT(iqn_set(q, IQN_OMEGA, 0.5), IQN_OK);
            CHECK_INT(iqn_set_block(q, -1, IQN_UPPER, 1), IQN_OK);
            CHECK_INT(iqn_set_block(q, -1, IQN_LOWER, -2), IQN_OK);
            for (i = 0; i <= n; i++) {
                start[i] = x[i] = i % 3 - 1;
                hx[i] = i % 7 - 3.5;
            }
            CHECK(fenced_step(q, x, hx, NULL) >= 0);
            for (i = 0; i < n; i++) {
                const double free_one = start[i] + 0.5 * (hx[i] - start[i]);
                CHECK_NEAR(x[i], free_one > 1 ? 1 : free_one < -2 ? -2 : free_one, 1e-15);
            }
            CHECK(x[n] == start[n]);
            for (i = 0; i < n; i++) moved += (x[i] - start[i]) * (x[i] - start[i]);
            for (i = 0; i < blocks; i++) moved -= ldexp(iqn__open(q).block[i].moved, 2 * q->e);
            CHECK_NEAR(moved, 0, 1e-12);
            free(mem);
        }
}

/* r_k = 2^-k: each limit is met at the iteration that the formula names, and the norms read back are those of r. */
static void test_limits_are_met_at_the_iteration_they_name(void **state)
{
    static const struct {
        int key, per_block;
        double limit;
        int expected;
    } row[] = {{IQN_TOL_ABSOLUTE, 0, 0.13, 4},   {IQN_TOL_ABSOLUTE, 0, 0.125, 4}, {IQN_TOL_ABSOLUTE, 0, 0.12, 5},
               {IQN_TOL_REDUCTION, 0, 0.26, 3},  {IQN_TOL_REDUCTION, 0, 0.25, 3}, {IQN_TOL_REDUCTION, 0, 0.24, 4},
               {IQN_TOL_RELATIVE, 0, 0.1, 3},    {IQN_TOL_RELATIVE, 0, 0.09, 4},  {IQN_TOL_RELATIVE, 0, 0.045, 5},
               {IQN_TOL_ABSOLUTE, 1, 0.13, 4},   {IQN_TOL_REDUCTION, 1, 0.26, 3}, {IQN_MAX_ITERATIONS, 0, 6, 6}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) { /* H = (x + 2)/2 - .. : x = 1 + .., hx = x/2 + 1, fixed point 2 */
        double x[2] = {0, 2}, hx[2];
        int count = 0, end;
        void *mem;
        iqn *q = make(&mem, 2, 4, 2);
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_OMEGA, 1), IQN_OK);
        CHECK_INT(row[k].per_block ? iqn_set_block(q, 0, row[k].key, row[k].limit) : iqn_set(q, row[k].key, row[k].limit), IQN_OK);
        do { /* x_0 = 2 - 2^(1-k), r_0 = 2^-k; the second block is solved from the start */
            hx[0] = x[0] / 2 + 1;
            hx[1] = 2;
            CHECK(iqn_step(q, x, hx) >= 0);
            CHECK_NEAR(iqn_get(q, IQN_RESIDUAL), ldexp(1, -count), 1e-15);
            CHECK_NEAR(iqn_get(q, IQN_REDUCTION), ldexp(1, -count), 1e-15);
            CHECK_NEAR(iqn_get_block(q, 0, IQN_RESIDUAL), ldexp(1, -count), 1e-15);
            CHECK(iqn_get_block(q, 1, IQN_RESIDUAL) == 0 && iqn_get_block(q, 1, IQN_VALUE) == 2);
            CHECK_NEAR(iqn_get_block(q, 0, IQN_VALUE), 2 - ldexp(1, -count), 1e-15);
            CHECK_NEAR(iqn_get(q, IQN_VALUE), sqrt(4 + pow(2 - ldexp(1, -count), 2)), 4e-15);
            CHECK_NEAR(iqn_get(q, IQN_RELATIVE), ldexp(1, -count) / sqrt(4 + pow(2 - ldexp(1, -count), 2)), 1e-15);
            CHECK_NEAR(iqn_get_block(q, 0, IQN_RELATIVE), ldexp(1, -count) / (2 - ldexp(1, -count)), 1e-15);
            end = iqn_converged(q);
            count++;
            CHECK_INT(iqn_get(q, IQN_ITERATIONS), count);
        } while (end == 0 && count < 12);
        CHECK_INT(count, row[k].expected);
        CHECK_INT(end, row[k].key == IQN_MAX_ITERATIONS ? 2 : 1);
        free(mem);
    }
}

/* A residual that stays: patience ends after so many iterations, 0 never; the counters name what happened. */
/* A shift: |r| stays as it is for n steps, and every one of them brings an independent pair. */
static void test_a_new_independent_pair_is_no_stall(void **state)
{
    enum { N = 12 };
    double x[N] = {0}, hx[N];
    void *mem;
    iqn *q = make(&mem, N, 20, 1);
    int i, k, end = 0, status;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-10), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_PATIENCE, 1), IQN_OK);
    for (k = 0; k < N + 2 && !end; k++) {
        for (i = 0; i < N; i++) hx[i] = 0.999 * x[(i + 1) % N] + (i == 0);
        status = iqn_step(q, x, hx);
        end = iqn_converged(q);
        CHECK(status >= 0 && (status == IQN_STALLED || status == IQN_NOISE || status == IQN_DIVERGED) == (end == 2));
        CHECK_INT(iqn_get(q, IQN_NSTALLED), 0);
    }
    CHECK_INT(end, 1);
    free(mem);
}

/* A residual that turns and never falls: every pair misleads.  After half of the patience without a new independent pair all but
   the newest go, three times in a window; by the textbooks never, nor where |r| has fallen to 1e-4 of the first. */
static void test_starting_over(void **state)
{
    static const struct {
        int method, growth, limit, patience, far_down, times;
    } row[] = {{IQN_ILS, 5, 0, 20, 0, 3}, {IQN_ILS, 5, 0, 6, 0, 3},   {IQN_ILS, 5, 0, 0, 0, 0},    {IQN_ILS, 0, 0, 20, 0, 0},
               {IQN_ILS, 5, 1, 20, 0, 0}, {IQN_IMVJ, 5, 0, 20, 0, 0}, {IQN_AITKEN, 5, 0, 20, 0, 0}, {IQN_ILS, 5, 0, 20, 1, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 4, 3, 1);
        int window, i, t, again, before, waits;
        CHECK_INT(iqn_set(q, IQN_METHOD, row[k].method), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_GROWTH, row[k].growth), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-12 * row[k].limit), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, row[k].patience), IQN_OK);
        for (window = 0; window < 2; window++) {
            double x[4] = {0, 0, 0, 0}, hx[4];
            before = (int)iqn_get(q, IQN_NRESTARTED);
            for (waits = 0, t = 0; t < 100 && iqn_converged(q) != 2; t++) {
                again = (int)iqn_get(q, IQN_NRESTARTED);
                for (i = 0; i < 4; i++) hx[i] = x[i] + (row[k].far_down && t == 0 ? 1e4 : 1) * (1 + 0.4 * cos(t * (i + 1.)));
                CHECK(iqn_step(q, x, hx) >= 0);
                if ((int)iqn_get(q, IQN_NRESTARTED) == again) {
                    waits++;
                    continue;
                }
                CHECK(iqn_get(q, IQN_PAIRS) <= 1); /* none where the step was to be taken back: see the next test */
                CHECK(waits > row[k].patience / 2);
                waits = 0;
            }
            CHECK_INT((int)iqn_get(q, IQN_NRESTARTED) - before, row[k].times);
            CHECK_INT(iqn_converged(q), row[k].patience ? 2 : 0);
            CHECK_INT(iqn_commit(q), IQN_OK);
        }
        free(mem);
    }
}

/* Half of the patience is gone when a step of a nonlinear run is taken back, which leaves no pair: without any, the old base would
   lead to the same x as before, so the next step starts from this iterate. */
static void test_starting_over_without_a_pair_moves_the_base(void **state)
{
    int waited;
    (void)state;
    for (waited = 0; waited < 2; waited++) {
        void *mem;
        iqn *q = make(&mem, 2, 10, 1);
        const iqn__view m = iqn__open(q);
        double x[2] = {1, 2}, h[2], r[2] = {0, 0}, before;
        int i, t;
        for (t = 0; t < 2; t++) { /* one pair, then a full step */
            h[0] = 1 + 0.5 * x[0], h[1] = 3 - 2 * x[1];
            for (i = 0; i < 2; i++) r[i] = h[i] - x[i];
            CHECK(iqn_step(q, x, h) >= 0);
        }
        q->nonlinear = 1;
        q->waited = waited ? 10 : 0;
        before = iqn__value_of(m.block->base_residual);
        CHECK(answer_with(q, x, r, 20) >= 0);
        CHECK_INT(iqn_get(q, IQN_NRESTARTED), waited);
        CHECK_INT(q->used, !waited);
        CHECK_NEAR(iqn__value_of(m.block->base_residual) / before, waited ? 20 : 1, 1e-12);
        free(mem);
    }
}

static void test_patience_and_the_counters(void **state)
{
    static const int patience[] = {0, 1, 2, 5, 20};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof patience / sizeof *patience; k++) {
        double x[3] = {0, 1, 2}, hx[3];
        int i, count = 0, gave_up = 0;
        void *mem;
        iqn *q = make(&mem, 3, 4, 1);
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_PATIENCE, patience[k]), IQN_OK);
        for (count = 1; count <= 60 && !gave_up; count++) {
            for (i = 0; i < 3; i++) hx[i] = x[i] + 1;
            CHECK(iqn_step(q, x, hx) >= 0);
            gave_up = iqn_converged(q) == 2;
        }
        if (patience[k] == 0) CHECK(!gave_up);
        else CHECK_INT(count - 1, patience[k] + 1); /* the first iteration cannot be without progress */
        CHECK_INT(iqn_get(q, IQN_NSTALLED), gave_up);
        CHECK_INT(iqn_get(q, IQN_NEXPLORED), 0);
        CHECK_INT(iqn_get(q, IQN_NSTEPS), count - 1);
        CHECK_INT(iqn_get(q, IQN_NRELAXED), count - 1);
        CHECK_INT(iqn_get(q, IQN_NWITHDRAWN), 0);
        CHECK_INT(iqn_get(q, IQN_NREFUSED), 0);
        CHECK_INT(iqn_get(q, IQN_NSUMS), 0);
        hx[0] = (double)NAN;
        CHECK(iqn_step(q, x, hx) < 0);
        CHECK_INT(iqn_get(q, IQN_NREFUSED), 1);
        CHECK_INT(iqn_get(q, IQN_NSTEPS), count - 1);
        for (i = 0; i < 3; i++) hx[i] = x[i]; /* solved: a step, but not one of relaxation */
        CHECK(iqn_step(q, x, hx) >= 0);
        CHECK_INT(iqn_get(q, IQN_NRELAXED), count - 1);
        free(mem);
    }
}

/* One field in one block, in two and in five: the same iterates to round-off, whatever the method. */
static void test_blocks_of_one_field_change_nothing(void **state)
{
    int method, blocks, k, i;
    (void)state;
    for (method = IQN_ILS; method <= IQN_CONSTANT; method++)
        for (blocks = 2; blocks <= 5; blocks += 3) {
            double x[2][SETTING_N], hx[SETTING_N];
            void *mem[2];
            iqn *q[2];
            q[0] = make(&mem[0], SETTING_N, 8, 1);
            q[1] = make(&mem[1], SETTING_N, 8, blocks);
            for (i = 0; i < SETTING_N; i++) x[0][i] = x[1][i] = 0.1 * i;
            for (k = 0; k < 2; k++) CHECK_INT(iqn_set(q[k], IQN_METHOD, method), IQN_OK);
            for (k = 0; k < 8; k++) {
                setting_map(0, x[0], hx);
                CHECK(iqn_step(q[0], x[0], hx) >= 0);
                setting_map(0, x[1], hx);
                CHECK(iqn_step(q[1], x[1], hx) >= 0);
                CHECK_NEAR(distance(SETTING_N, x[0], x[1]), 0, 1e-7 * (1 + distance(SETTING_N, x[0], NULL)));
                CHECK_NEAR(iqn_get(q[0], IQN_RESIDUAL) / iqn_get(q[1], IQN_RESIDUAL), 1, 1e-6);
            }
            free(mem[0]);
            free(mem[1]);
        }
}

static int not_a_number(double v) /* on the bits: these tests also run under -ffast-math */
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits << 1 > (uint64_t)0x7ff << 53;
}

/* Of every key: 0 is refused where the comment says so, nowhere else. */
static void test_zero_is_a_value_but_for_two_keys(void **state)
{
    static const int keys[] = {IQN_METHOD,        IQN_OMEGA,          IQN_FILTER_LIMIT, IQN_WINDOWS,     IQN_TOL_ABSOLUTE, IQN_TOL_RELATIVE,
                               IQN_TOL_REDUCTION, IQN_MAX_ITERATIONS, IQN_PATIENCE,     IQN_MIXING,      IQN_NOISE_LEVEL,  IQN_GROWTH,
                               IQN_MERGE,         IQN_LENGTH,         IQN_SCALING,      IQN_WEIGHT,      IQN_LOWER,        IQN_UPPER};
    void *mem;
    iqn *q = make(&mem, 4, 3, 2);
    size_t k;
    (void)state;
    for (k = 0; k < sizeof keys / sizeof *keys; k++) {
        const int refused = keys[k] == IQN_OMEGA || keys[k] == IQN_MIXING;
        const int status = keys[k] < IQN_LENGTH ? iqn_set(q, keys[k], 0) : iqn_set_block(q, 0, keys[k], 0);
        CHECK_INT(status, refused ? IQN_EVALUE : IQN_OK);
    }
    free(mem);
}

/* The host is handed r and hx of its choice: when is the relative limit met?  Once |hx| is more than ten times what it was
   at the start of the window and in the last one, |r| must have fallen to a tenth, too; from 1000 times on |hx| counts no
   further.  Limits of x as a whole and of its only block alike. */
static void test_growth_and_the_relative_limit(void **state)
{
    static const struct {
        double accepted, value[2], r[2]; /* accepted: |hx| of the window before; 0: there is none */
        int converged;
    } row[] = {{0, {5, 49}, {1, 0.4}, 1},        {0, {5, 51}, {1, 0.4}, 0},      {0, {5, 51}, {1, 0.11}, 0},
               {0, {5, 51}, {1, 0.09}, 1},       {100, {5, 51}, {1, 0.4}, 1},    {100, {5, 1010}, {1, 0.4}, 0},
               {3, {5, 51}, {1, 0.4}, 0},        {3, {5, 49}, {1, 0.4}, 1},      {0, {5, 4000}, {1000, 39}, 1},
               {0, {5, 4000}, {1000, 41}, 0},    {0, {5, 50000}, {1000, 49}, 1}, {0, {5, 50000}, {1000, 51}, 0}, {0, {1, 1e5}, {100, 9}, 1},
               {0, {1, 1e5}, {1000, 11}, 0},     {0, {5, 5}, {1, 0.051}, 0},     {0, {5, 5}, {1, 0.049}, 1}};
    size_t k;
    int blocked, step;
    (void)state;
    for (blocked = 0; blocked < 2; blocked++)
        for (k = 0; k < sizeof row / sizeof *row; k++) {
            void *mem;
            iqn *q = make(&mem, 1, 0, 1);
            double x, h;
            CHECK_INT(iqn_set(q, IQN_METHOD, IQN_CONSTANT), IQN_OK);
            CHECK_INT(blocked ? iqn_set_block(q, 0, IQN_TOL_RELATIVE, 0.01) : iqn_set(q, IQN_TOL_RELATIVE, 0.01), IQN_OK);
            for (step = 0; step < 2 && row[k].accepted > 0; step++) { /* the window before went from 1 to what it accepted */
                h = step ? row[k].accepted : 1;
                x = h - 0.5;
                CHECK(iqn_step(q, &x, &h) >= 0);
            }
            if (row[k].accepted > 0) CHECK_INT(iqn_commit(q), IQN_OK);
            for (step = 0; step < 2; step++) {
                h = row[k].value[step];
                x = h - row[k].r[step];
                CHECK(iqn_step(q, &x, &h) >= 0);
            }
            CHECK_INT(iqn_converged(q), row[k].converged);
            free(mem);
        }
}

/* Merged pairs are past ones: to repeat a window forgets none of them. */
static void test_merged_pairs_outlive_a_repeated_window(void **state)
{
    void *mem;
    iqn *q = make(&mem, 6, 40, 1);
    unsigned long long seed = 8;
    double x[6], h[6];
    int window, k, i;
    (void)state;
    textbook(q);
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_IMVJ), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_MERGE, 2), IQN_OK);
    for (window = 0; window < 6; window++) {
        for (k = 0; k < 2; k++) {
            for (i = 0; i < 6; i++) x[i] = random_number(&seed), h[i] = random_number(&seed);
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_discard(q), IQN_OK);
        CHECK_INT(iqn_get(q, IQN_PAIRS), window);
        for (k = 0; k < 2; k++) {
            for (i = 0; i < 6; i++) x[i] = random_number(&seed), h[i] = random_number(&seed);
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
    }
    free(mem);
}

/* A pushed pair is as uncertain as the answers: below the noise of |hx| it is dropped, above it is used. */
static void test_a_pushed_pair_has_the_noise_of_the_answer(void **state)
{
    int large;
    (void)state;
    for (large = 0; large < 2; large++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 1);
        double x[2] = {0, 0}, h[2] = {0.5, 0.25}, v[2] = {1, 0.5}, w[2] = {0.5, -1};
        if (large) x[0] = 1000 - 0.5, h[0] = 1000;
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0.1), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        CHECK_INT(iqn_discard(q), IQN_OK);
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
        if (large) x[0] = 1000 - 0.5, h[0] = 1000;
        CHECK_INT(iqn_step(q, x, h), large ? IQN_RELAXED : IQN_OK);
        CHECK_INT(iqn_get(q, IQN_PAIRS), large ? 0 : 1);
        free(mem);
    }
}

/* A window of a push alone is one, whatever was stored where: with IQN_WINDOWS 1 the older pairs go. */
static void test_a_push_alone_makes_a_window(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 5, 1);
    double x[3] = {0, 0, 0}, h[3], v[3] = {1, 2, 3}, out[3];
    int window, k, i;
    (void)state;
    textbook(q);
    CHECK_INT(iqn_set(q, IQN_WINDOWS, 1), IQN_OK);
    for (window = 0; window < 8; window++) {
        for (k = 0; k < 2 + window % 2; k++) {
            for (i = 0; i < 3; i++) h[i] = cos(i * i + 3 * k + 10 * window);
            CHECK(iqn_step(q, x, h) >= 0);
            poison(q);
        }
        CHECK_INT(iqn_commit(q), IQN_OK);
        v[0] = window;
        CHECK_INT(iqn_push(q, v, v), IQN_OK);
        poison(q);
        for (k = 0; k < 2; k++) { /* the second one is empty */
            CHECK_INT(iqn_commit(q), IQN_OK);
            CHECK_INT((int)iqn_get(q, IQN_PAIRS), 1);
            CHECK_INT(iqn_pair(q, 0, out, NULL), IQN_OK);
            CHECK_NEAR(distance(3, out, v), 0, 1e-14);
        }
    }
    free(mem);
}

/* Before the first answer it is as uncertain as its own w. */
static void test_a_pair_pushed_before_any_answer(void **state)
{
    int large;
    (void)state;
    for (large = 0; large < 2; large++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 1);
        double x[2] = {0, 0}, h[2] = {0.5, 0.25}, v[2] = {1, 0.5}, w[2] = {0.5, -1};
        if (large) w[0] = 100;
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 0.1), IQN_OK);
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), large ? IQN_RELAXED : IQN_OK);
        free(mem);
    }
}

/* Where the host has moved x, or after a probe, nothing is learned about the slope of H. */
static void test_an_edited_iterate_says_nothing_about_the_slope(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 5, 1);
    double x[2] = {0, 0}, h[2], slope;
    int k;
    (void)state;
    for (k = 0; k < 4; k++) {
        slope = q->slope;
        if (k == 2) x[0] += 5;
        h[0] = 1 - 3 * x[0];
        h[1] = 2 - 3 * x[1];
        CHECK(iqn_step(q, x, h) >= 0);
        if (k == 1) CHECK_NEAR(q->slope, 4, 1e-12); /* r = 1 - 4 x */
        if (k == 2) CHECK(q->slope == slope);
    }
    free(mem);
}

#if defined(__SIZEOF_FLOAT128__) && !defined(FAST_HOST) /* inlined into such a host it is not what it is in the header */
static quad quad_of(iqn__dd a)
{
    return (quad)a.h + (quad)a.l;
}

static double quad_off(iqn__dd a, quad exact) /* relative */
{
    const double off = (double)((quad_of(a) - exact) / exact);
    return fabs(off);
}

/* The small arithmetic has the accuracy of its name: some 104 bits in every operation, whatever the low parts. */
static void test_double_double_arithmetic(void **state)
{
    unsigned long long seed = 31;
    int k;
    (void)state;
    for (k = 0; k < 2000; k++) {
        iqn__dd a = iqn__two_sum(1.5 + 0.5 * random_number(&seed), 0x1p-54 * random_number(&seed));
        iqn__dd b = iqn__two_sum(1.5 + 0.5 * random_number(&seed), 0x1p-54 * random_number(&seed));
        iqn__dd root;
        a = iqn__shift(a, k % 7);
        root = iqn__reciprocal_root(a);
        CHECK_NEAR(quad_off(iqn__add(a, b), quad_of(a) + quad_of(b)), 0, 1e-31);
        CHECK_NEAR(quad_off(iqn__mul(a, b), quad_of(a) * quad_of(b)), 0, 1e-31);
        CHECK_NEAR((double)(quad_of(root) * quad_of(root) * quad_of(a) - 1), 0, 1e-31);
        CHECK_NEAR((double)(quad_of(iqn__sub(a, b)) - (quad_of(a) - quad_of(b))), 0, 1e-29);
        b.h = -a.h + 0x1p-50 * (k % 3); /* what is left is of the size of the low parts, and as accurate */
        CHECK_NEAR(quad_off(iqn__add(a, b), quad_of(a) + quad_of(b)), 0, 1e-31);
    }
}
/* Sums of products beside quadruple precision, in parts of |a| |r|, for one column and for two of many sizes. */
static void test_sums_of_products(void **state)
{
    enum { N = IQN__CHUNK };
    static const int rows[] = {1, 6, 100, N}, sizes[] = {0, -40, 30, -300};
    static double a[2][N], r[N];
    unsigned long long seed = 41;
    size_t length, first;
    int c, count, i, n;
    (void)state;
    for (length = 0; length < 4; length++)
        for (first = 0; first < 4; first++)
            for (count = 1; count <= 2; count++) {
                iqn__dd exact[2];
                double plain[2] = {0, 0};
                iqn__side side;
                iqn__column column[2];
                n = rows[length];
                for (i = 0; i < n; i++) r[i] = ldexp(random_number(&seed), 12);
                side.y = side.d = r;
                side.square = iqn__bound(iqn__plain_square(n, r));
                memset(exact, 0, sizeof exact);
                for (c = 0; c < count; c++) {
                    const int size = sizes[(first + (size_t)c) % 4];
                    for (i = 0; i < n; i++) a[c][i] = ldexp(random_number(&seed), size) + (size == 0 ? 2e-12 * r[i] : 0);
                    column[c].a = a[c];
                    column[c].square = iqn__bound(iqn__plain_square(n, a[c]));
                    column[c].exact = exact + c;
                    column[c].plain = plain + c;
                }
                iqn__dot(n, &side, count, column);
                for (c = 0; c < count; c++) {
                    const double size = sqrt(iqn__plain_square(n, a[c]) * iqn__plain_square(n, r));
                    quad sum = 0;
                    for (i = 0; i < n; i++) sum += (quad)a[c][i] * (quad)r[i];
                    CHECK_NEAR((double)((quad_of(exact[c]) - sum) / (quad)size), 0, 3e-30);
                }
            }
}

/* A field in small units beside one in large ones has the same digits in its part of the Gram matrix. */
static void test_gram_matrix_of_small_units(void **state)
{
    enum { N = 40 };
    unsigned long long seed = 43;
    double x[2 * N], h[2 * N], v[2][2 * N], w[2 * N];
    int block, i, k;
    void *mem;
    iqn *q = make(&mem, 2 * N, 5, 2);
    const iqn__view m = iqn__open(q);
    (void)state;
    for (k = 0; k < 3; k++) { /* differences of numbers in [1, 2) are exact */
        memset(x, 0, sizeof x);
        for (i = 0; i < 2 * N; i++) h[i] = ldexp(1.5 + 0.5 * random_number(&seed), i < N ? 0 : -60);
        CHECK(iqn_step(q, x, h) >= 0);
    }
    for (k = 0; k < 2; k++) CHECK_INT(iqn_pair(q, k, v[k], w), IQN_OK);
    for (block = 0; block < 2; block++) {
        const int s = m.order[0], o = m.order[1], slots = m.slots;
        quad sum = 0, square = 0;
        for (i = block * N; i < (block + 1) * N; i++) {
            sum += (quad)v[0][i] * (quad)v[1][i];
            square += (quad)v[0][i] * (quad)v[0][i];
        }
        sum -= quad_of(iqn__shift(m.gram[(block * slots + s) * slots + o], m.exponent[s] + m.exponent[o]));
        CHECK_NEAR((double)(sum / square), 0, 3e-30);
    }
    free(mem);
}
#else
static void test_double_double_arithmetic(void **state)
{
    (void)state;
}

static void test_sums_of_products(void **state)
{
    (void)state;
}

static void test_gram_matrix_of_small_units(void **state)
{
    (void)state;
}
#endif

/* Lengths are fixed by the first step, with or without columns. */
static void test_lengths_are_fixed_by_the_first_step(void **state)
{
    int columns;
    (void)state;
    for (columns = 0; columns < 2; columns++) {
        void *mem;
        iqn *q = make(&mem, 4, columns, 2);
        double x[4] = {0}, h[4] = {1, 2, 3, 4};
        CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 1), IQN_OK);
        CHECK_INT(iqn_set_block(q, 1, IQN_LENGTH, 3), IQN_OK);
        CHECK_INT(iqn_set_block(q, 1, IQN_LENGTH, -1), IQN_EVALUE);
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 2), IQN_EORDER);
        CHECK(iqn_get_block(q, 0, IQN_LENGTH) == 1);
        free(mem);
    }
}

/* A block without a size of its own yet is as large as the others together. */
static void test_a_field_that_is_zero_is_as_large_as_the_others(void **state)
{
    static const int scaling[] = {IQN_BY_WEIGHT, IQN_BY_VALUE, IQN_BY_RESIDUAL};
    static const double expected[] = {1, 0.1, 0.2}; /* 1, 1/|hx| and 1/|r| below */
    size_t k;
    (void)state;
    for (k = 0; k < 3; k++) {
        void *mem;
        iqn *q = make(&mem, 4, 3, 2);
        iqn__view m = iqn__open(q);
        double x[4] = {3, 4, 0, 0}, h[4] = {6, 8, 0, 0};
        CHECK_INT(iqn_set_block(q, -1, IQN_SCALING, scaling[k]), IQN_OK);
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_NEAR(iqn__value_of(m.block[0].weight), expected[k], 1e-15);
        CHECK_NEAR(iqn__value_of(m.block[1].weight), expected[k], 1e-15);
        memset(h, 0, sizeof h);
        CHECK(iqn_step(q, x, h) >= 0); /* all is zero */
        if (scaling[k] == IQN_BY_VALUE) CHECK_NEAR(iqn__value_of(m.block[0].weight), 1, 1e-15);
        free(mem);
    }
}

/* In a metric, too: x, H and M in other units give the same iterates. */
static void test_units_of_a_metric_change_nothing(void **state)
{
    static const int power[][2] = {{0, 0}, {200, 0}, {-200, 0}, {0, 100}, {90, -20}, {-300, 40}, {0, -60}, {0, -100}, {50, 400},
                                   {-50, -400}};
    double first[8][4];
    size_t k;
    int step, i;
    (void)state;
    for (k = 0; k < sizeof power / sizeof *power; k++) {
        const double unit = ldexp(1, power[k][0]), of_M = ldexp(1, power[k][1]);
        void *mem;
        iqn *q = make(&mem, 4, 8, 1);
        double x[4] = {0}, h[4], mr[4];
        for (step = 0; step < 7; step++) {
            for (i = 0; i < 4; i++)
                h[i] = (1 + i) * unit - (0.4 + 0.3 * i) * x[i] + 0.125 * x[(i + 1) % 4];
            for (i = 0; i < 4; i++) mr[i] = of_M * ((2 + i) * (h[i] - x[i]) - 0.5 * (h[3 - i] - x[3 - i]));
            CHECK(iqn_step_metric(q, x, h, mr) >= 0);
            for (i = 0; i < 4; i++) {
                if (k == 0) first[step][i] = x[i];
                CHECK_NEAR(x[i] / unit, first[step][i], 1e-9 * (1 + fabs(first[step][i])));
            }
        }
        free(mem);
    }
}

/* One field of two in other units, with its weight in the inverse ones: x is the same in its units to round-off. */
static void test_units_of_a_block_change_nothing(void **state)
{
    static const int power[] = {0, 20, -20, 100, -100, 200};
    double first[8][4];
    size_t k;
    int step, i;
    (void)state;
    for (k = 0; k < sizeof power / sizeof *power; k++) {
        const double unit = ldexp(1, power[k]);
        void *mem;
        iqn *q = make(&mem, 4, 8, 2);
        double x[4] = {0}, h[4], y[4];
        CHECK_INT(iqn_set_block(q, 1, IQN_WEIGHT, 1 / unit), IQN_OK);
        for (step = 0; step < 6; step++) {
            for (i = 0; i < 4; i++) y[i] = x[i] / (i < 2 ? 1 : unit);
            for (i = 0; i < 4; i++) h[i] = (i < 2 ? 1 : unit) * ((1 + i) - (0.4 + 0.3 * i) * y[i] + 0.125 * y[(i + 1) % 4]);
            CHECK(iqn_step(q, x, h) >= 0);
            for (i = 0; i < 4; i++) {
                const double in_units = x[i] / (i < 2 ? 1 : unit);
                if (k == 0) first[step][i] = in_units;
                CHECK_NEAR(in_units, first[step][i], 1e-12 * (1 + fabs(first[step][i])));
            }
        }
        free(mem);
    }
}

/* Converged means x = hx, bounds or not. */
static void test_a_converged_step_is_the_answer_beyond_the_bounds_too(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 4, 1);
    double x[3] = {0, 0, 0};
    const double h[3] = {1.5, 0.5, -2};
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_UPPER, 1), IQN_OK);
    CHECK_INT(iqn_set_block(q, 0, IQN_LOWER, -1), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_ABSOLUTE, 10), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
    CHECK(memcmp(x, h, sizeof x) == 0);
    free(mem);
}

/* v'(x - x_base) = 0 gives no omega: the last one stays. */
static void test_aitken_keeps_omega_where_its_secant_is_zero(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 0, 1);
    double x[2] = {0, 0};
    const double first[2] = {1, 0}, second[2] = {1.5, 1}; /* r = (1, 0), then (1, 1) */
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_OMEGA, 0.5), IQN_OK);
    CHECK_INT(iqn_step(q, x, first), IQN_RELAXED);
    CHECK(x[0] == 0.5 && x[1] == 0);
    CHECK_INT(iqn_step(q, x, second), IQN_RELAXED);
    CHECK(x[0] == 1 && x[1] == 0.5);
    CHECK(iqn_get(q, IQN_OMEGA_NOW) == 0.5);
    free(mem);
}

/* v and d are the difference of two residuals and what rounding took from it, whichever is larger. */
static void test_a_difference_of_residuals_keeps_what_rounding_takes(void **state)
{
    enum { N = 43 };
    double x[N] = {0}, h[N], old[N], square[3];
    void *mem;
    iqn *q = make(&mem, N, 4, 1);
    iqn__view m;
    iqn__input in;
    unsigned long long seed = 5;
    int i, lost = 0;
    (void)state;
    for (i = 0; i < N; i++) h[i] = old[i] = random_number(&seed) * pow(10, i % 7);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    m = iqn__open(q);
    for (i = 0; i < N; i++) {
        x[i] = 0;
        h[i] = random_number(&seed) * pow(10, i % 5);
    }
    memset(&in, 0, sizeof in);
    in.minus = x, in.plus = in.value = h, in.e = q->e;
    iqn__form(q, &m, &in, 0, N, square);
    for (i = 0; i < N; i++) { /* the larger one first: its difference to the sum is exact */
        const double unit = ldexp(1, -q->e), a = h[i] * unit, b = old[i] * unit;
        const double large = fabs(a) > fabs(b) ? a : -b, small = fabs(a) > fabs(b) ? -b : a;
        volatile double sum = a - b, rest = sum - large, error = small - rest; /* volatile: -ffast-math would drop them */
        CHECK(m.r[i] == a && m.v[i] == sum && m.d[i] == -error);
        lost += m.d[i] != 0;
    }
    CHECK(lost > N / 2);
    free(mem);
}

/* What the next step of a nonlinear run is: small along the step while the last one disappointed, small along the rest
   while that is large and falls, else full; all divided by the slope where this is above 1.  Steady, and the steepest slope
   leaves no more than |r| of the rest: full, as on an affine map. */
static void test_the_steps_of_exploring(void **state)
{
    static const struct {
        double slope, unexplained, mixing, rest; /* rest: how much of |r| the one pair leaves */
        int idle, suspicious, small, left_idle, steady;
        double steepest;
    } row[] = {{0.5, 10, 1, 0.8, 0, 0, 1, 0, 0, 0}, {2, 10, 1, 0.8, 0, 0, 1, 0, 0, 0},   {2, 10, 1, 0.8, 2, 0, 1, 0, 0, 0},
               {2, 0.8, 1, 0.8, 1, 0, 1, 2, 0, 0},  {2, 0.8, 1, 0.8, 2, 0, 0, 3, 0, 0},  {4, 0.95, 1, 0.8, 7, 0, 1, 0, 0, 0},
               {2, 10, 0.5, 0.05, 0, 0, 0, 0, 0, 0}, {0.5, 10, 1, 0.05, 1, 0, 0, 0, 0, 0}, {0.1, 10, 0.7, 0.8, 0, 1, 1, 0, 0, 0},
               {3, 10, 0.7, 0.8, 0, 1, 1, 0, 0, 0},  {1e-3, 10, 1, 0.12, 0, 0, 1, 0, 0, 0}, {3, 10, 0.7, 0.05, 0, 1, 1, 0, 0, 0},
               {2, 10, 0.7, 0.8, 0, 0, 0, 0, 1, 1.24}, {2, 10, 0.7, 0.8, 0, 0, 1, 0, 1, 1.26}, {2, 10, 0.7, 0.8, 0, 0, 1, 0, -1, 1.24},
               {2, 10, 0.7, 0.8, 0, 0, 1, 0, 0, 1.24}, {2, 0.8, 1, 0.8, 1, 1, 0, 2, 1, 0.5}, {4, 10, 0.7, 0.05, 0, 0, 0, 0, 1, 19.9},
               {4, 10, 0.7, 0.05, 0, 0, 0, 0, 1, 20.1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 4, 1);
        const double v[2] = {-2, 0}, w[2] = {1, 1}, part = sqrt(1 - row[k].rest * row[k].rest), slope = fmax(1, row[k].slope);
        const int whole = row[k].steady > 0 && row[k].steepest * row[k].rest <= 1;
        const double along = fmin(1, 0.1 / (slope * row[k].rest)), mixing = whole ? row[k].mixing : row[k].mixing / slope;
        double x[2] = {0, 0}, h[2];
        iqn__plan p;
        iqn__view m;
        h[0] = part, h[1] = row[k].rest; /* |r| = 1, and v explains the first number */
        CHECK_INT(iqn_push(q, v, w), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_MIXING, row[k].mixing), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_OK);
        m = iqn__open(q);
        memset(&p, 0, sizeof p);
        iqn__relate_weights(q, &m);
        p.terms = iqn__solve(q, &m);
        CHECK_INT(p.terms, 1);
        CHECK_NEAR(iqn_get(q, IQN_PREDICTED), row[k].rest, 1e-12);
        q->predicted = iqn__seen_of_base(q, &m); /* as iqn__choose leaves it */
        q->slope = row[k].slope, q->least_left = row[k].unexplained, q->idle = row[k].idle;
        q->suspicious = row[k].suspicious;
        q->steady = row[k].steady, q->steepest = row[k].steepest;
        iqn__plan_exploring(q, &m, &p);
        CHECK_INT(p.kind, row[k].small ? IQN__SMALL : IQN__FULL);
        CHECK_INT(iqn_get(q, IQN_NEXPLORED), row[k].small);
        CHECK_NEAR(iqn_get(q, IQN_PREDICTED), row[k].small ? 1 : row[k].rest, 1e-12);
        CHECK_INT(q->idle, row[k].left_idle);
        CHECK_INT(q->suspicious, 0);
        if (row[k].suspicious && row[k].small) {
            CHECK_NEAR(p.times_r, 0.1 * mixing, 1e-13);
            CHECK_NEAR(p.times_w, 0.1, 1e-13);
            CHECK_NEAR(p.times_v, 0.1 * (mixing - 1), 1e-13);
        } else if (row[k].small) {
            CHECK_NEAR(p.times_r, along, 1e-12);
            CHECK_NEAR(p.times_w, 0, 0);
            CHECK_NEAR(p.times_v, along, 1e-12);
        } else {
            CHECK_NEAR(p.times_r, mixing, 1e-13);
            CHECK_NEAR(p.times_w, 1, 0);
            CHECK_NEAR(p.times_v, mixing - 1, 1e-13);
        }
        free(mem);
    }
}

/* What the pairs left unexplained is forgotten with them: new ones are not idle for explaining less than the forgotten
   ones did.  Past pairs that misled go after the first step, all but the last at a new start. */
static void test_forgotten_pairs_do_not_end_exploring(void **state)
{
    static const double first[4] = {1, 0.6, 0.4, 0.3}, zero[4] = {0, 0, 0, 0};
    static const double change[4] = {-3, -0.1, -0.1, -0.1}; /* of number k of r, in answer k */
    void *mem;
    iqn *q = make(&mem, 4, 10, 1);
    double x[4] = {0, 0, 0, 0}, h[4];
    int i, k;
    (void)state;
    CHECK_INT(iqn_push(q, first, zero), IQN_OK);
    CHECK_INT(iqn_commit(q), IQN_OK);
    q->nonlinear = 1;
    CHECK(iqn_step(q, x, first) >= 0);
    CHECK_INT(q->kind, IQN__FULL);
    CHECK(q->least_left < 1e-3);
    for (k = 0; k < 4; k++) {
        for (i = 0; i < 4; i++) h[i] = x[i] + first[i] + (i == k ? change[i] : 0);
        if (k == 3) q->waited = 11;
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_INT(q->used, k < 3 ? k + 1 : 1);
        CHECK_INT(q->idle, 0);
        CHECK_INT(q->kind, IQN__SMALL); /* left: 0.62, 0.39, 0.24; of the last pair alone 0.97 */
    }
    CHECK_INT((int)iqn_get(q, IQN_NRESTARTED), 1);
    free(mem);
}

/* A filter limit trusts every pair in full, noise or not: the base stays where a relaxation raised |r|. */
static void test_a_filter_limit_knows_no_noise(void **state)
{
    int limit;
    (void)state;
    for (limit = 0; limit < 2; limit++) {
        void *mem;
        iqn *q = make(&mem, 1, 5, 1);
        double x = 1, h = 1.02, before = x;
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 1e-2), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, limit ? 1e-16 : 0), IQN_OK);
        CHECK_INT(iqn_step(q, &x, &h), IQN_RELAXED);
        before = x;
        h = x + 0.0205;
        CHECK_INT(iqn_step(q, &x, &h), limit ? IQN_OK : IQN_RELAXED);
        CHECK(x != before);
        CHECK_NEAR(iqn__open(q).V[q->base], limit ? 0.02 : 0.0205, 1e-12); /* r of the base */
        free(mem);
    }
}

/* Lengths that do not add up stop a step, too, and a step with a metric. */
static void test_steps_refuse_lengths_that_do_not_add_up(void **state)
{
    void *mem;
    iqn *q = make(&mem, 4, 5, 2);
    double x[4] = {1, 2, 3, 4};
    const double h[4] = {2, 3, 4, 6};
    (void)state;
    CHECK_INT(iqn_set_block(q, 0, IQN_LENGTH, 1), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_ELENGTH);
    CHECK_INT(iqn_step_metric(q, x, h, h), IQN_ELENGTH);
    CHECK(x[0] == 1 && x[3] == 4 && iqn_get(q, IQN_NSTEPS) == 0);
    CHECK_INT(iqn_set_block(q, 1, IQN_LENGTH, 3), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    free(mem);
}

/* With a metric, too: every argument is looked at, and a rank without interface passes NULL. */
static void test_every_argument_of_the_metric_calls(void **state)
{
    void *mem[3];
    iqn *q = make(&mem[0], 2, 3, 1), *none = make(&mem[1], 2, 0, 1), *empty = make(&mem[2], 0, 3, 1);
    double x[2] = {0, 0}, h[2] = {1, 2}, mr[2] = {2, 4};
    (void)state;
    CHECK_INT(iqn_step_metric(NULL, x, h, mr), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, NULL, h, mr), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, x, NULL, mr), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, x, h, NULL), IQN_ENULL);
    CHECK_INT(iqn_step_metric(q, x, x, mr), IQN_EOVERLAP);
    CHECK_INT(iqn_step_metric(q, x, h, x + 1), IQN_EOVERLAP);
    CHECK_INT(iqn_push_metric(NULL, x, h, mr), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, NULL, h, mr), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, x, NULL, mr), IQN_ENULL);
    CHECK_INT(iqn_push_metric(q, x, h, NULL), IQN_ENULL);
    CHECK_INT(iqn_push_metric(none, x, h, mr), IQN_EARG);
    CHECK_INT(iqn_get(q, IQN_NSTEPS), 0);
    CHECK(iqn_step_metric(empty, NULL, NULL, NULL) >= 0);
    CHECK_INT(iqn_push_metric(empty, NULL, NULL, NULL), IQN_DROPPED);
    CHECK_INT(iqn_halve(empty, NULL), IQN_OK);
    CHECK_INT(iqn_push_metric(q, h, h, mr), IQN_OK); /* one pair with a metric: from now on with it */
    CHECK_INT(iqn_step(q, x, h), IQN_EORDER);
    CHECK_INT(iqn_push(q, h, h), IQN_EORDER);
    CHECK(iqn_step_metric(q, x, h, mr) >= 0);
    CHECK_INT(iqn_discard(q), IQN_OK);
    CHECK_INT(iqn_step_metric(q, x, h, mr), IQN_RELAXED);
    CHECK_INT(iqn_step(q, x, h), IQN_EORDER);
    free(mem[0]);
    free(mem[1]);
    free(mem[2]);
}

/* The same field many times over, longer than the chunks of a sweep: every copy does what one alone does, and norms grow by
   the root of the number. */
static void test_many_copies_of_a_field_change_nothing(void **state)
{
    enum { N = 7, COPIES = 3000 };
    static double x[N * COPIES], h[N * COPIES];
    affine p;
    void *mem[2];
    iqn *one = make(&mem[0], N, 12, 1), *many = make(&mem[1], N * COPIES, 12, 1);
    const double root = sqrt((double)COPIES);
    volatile ptrdiff_t length = N * COPIES; /* of a constant gcc 12 -O3 says that the loop leaves the array */
    int k, i, status, withdrawn = 0;
    (void)state;
    affine_make(&p, N, -300, 0.9, 3);
    for (k = 0; k < 7; k++) {
        affine_apply(&p);
        for (i = 0; i < N * COPIES; i++) {
            h[i] = p.h[i % N];
            if (k == 0) x[i] = p.x[i % N];
        }
        status = iqn_step(one, p.x, p.h);
        CHECK_INT(iqn_step(many, x, h), status);
        withdrawn += status == IQN_WITHDRAWN;
        for (i = 0; i < N * COPIES; i++) CHECK_NEAR(x[i], p.x[i % N], 1e-8 * (1 + distance(N, p.x, NULL)));
        CHECK_NEAR(iqn_get(many, IQN_RESIDUAL) / iqn_get(one, IQN_RESIDUAL), root, 1e-7 * root);
        for (i = 0; i < N * COPIES; i++) x[i] = p.x[i % N];
        many->handed_out = iqn__fingerprint(0, length, x); /* x is set to the other's, last bits and all */
        if (one->kind == IQN__FULL) CHECK_NEAR(iqn__value_of(many->predicted) / iqn__value_of(one->predicted), root, 1e-5 * root);
    }
    CHECK(withdrawn > 0);
    free(mem[0]);
    free(mem[1]);
}

/* A block that does not exist, a key of another kind, no object: an error and nothing else. */
static void test_keys_and_blocks_that_do_not_exist(void **state)
{
    static const int bad_blocks[] = {-3, 2, 3, 1000000};
    void *mem;
    iqn *q = make(&mem, 4, 3, 2);
    double v[4];
    size_t k;
    (void)state;
    for (k = 0; k < sizeof bad_blocks / sizeof *bad_blocks; k++) {
        CHECK(iqn_set_block(q, bad_blocks[k], IQN_WEIGHT, 1) < 0);
        CHECK(not_a_number(iqn_get_block(q, bad_blocks[k], IQN_WEIGHT)));
        CHECK(not_a_number(iqn_get_block(q, bad_blocks[k], IQN_RESIDUAL)));
    }
    CHECK(not_a_number(iqn_get_block(q, -1, IQN_WEIGHT)));
    CHECK(not_a_number(iqn_get_block(NULL, 0, IQN_WEIGHT)));
    CHECK(not_a_number(iqn_get(q, IQN_LENGTH))); /* of a block */
    CHECK_INT(iqn_set(q, IQN_LENGTH, 1), IQN_EKEY);
    CHECK(not_a_number(iqn_get(NULL, IQN_OMEGA)));
    CHECK(not_a_number(iqn_get(q, 0)) && not_a_number(iqn_get(q, 999)) && not_a_number(iqn_get(q, IQN_WEIGHT)));
    CHECK(not_a_number(iqn_get_block(q, 0, IQN_NSTEPS)) && not_a_number(iqn_get_block(q, 0, IQN_OMEGA)));
    CHECK(iqn_set(q, IQN_WEIGHT, 1) < 0 && iqn_set(q, IQN_NSTEPS, 1) < 0 && iqn_set(NULL, IQN_OMEGA, 1) < 0);
    CHECK(iqn_set_block(q, 0, IQN_OMEGA, 1) < 0 && iqn_set_block(NULL, 0, IQN_WEIGHT, 1) < 0);
    CHECK(iqn_set(q, IQN_OMEGA, 0) < 0 && iqn_set(q, IQN_MIXING, 0) < 0 && iqn_set(q, IQN_OMEGA, (double)NAN) < 0);
    CHECK(iqn_pair(q, 0, v, v) < 0 && iqn_pair(q, -1, v, NULL) < 0 && iqn_pair(NULL, 0, v, NULL) < 0);
    CHECK_INT(iqn_converged(NULL), IQN_ENULL);
    CHECK(iqn_commit(NULL) < 0 && iqn_discard(NULL) < 0);
    free(mem);
}

/* H' = 0.7 times rotations: the next residual is 0.7 times what the last step was to leave. */
static void test_what_a_step_leaves_of_the_residual(void **state)
{
    enum { N = 20 };
    static double mem[8000];
    double x[N] = {0}, hx[N], left = 0;
    iqn *q;
    int i, step;
    (void)state;
    CHECK_INT(iqn_make(&q, N, 10, 1, mem, sizeof mem), IQN_OK);
    for (step = 0; step < 8; step++) {
        double sum = 0;
        for (i = 0; i < N; i += 2) {
            const double c = 0.7 * cos(0.4 * i + 0.3), s = 0.7 * sin(0.4 * i + 0.3);
            hx[i] = 1 + c * x[i] - s * x[i + 1];
            hx[i + 1] = -2 + s * x[i] + c * x[i + 1];
        }
        for (i = 0; i < N; i++) sum += (hx[i] - x[i]) * (hx[i] - x[i]);
        if (step > 1) CHECK_NEAR(sqrt(sum), 0.7 * left, 1e-12 * left); /* the first step knows no pairs */
        CHECK(iqn_step(q, x, hx) >= 0);
        left = iqn_get(q, IQN_PREDICTED);
        if (step == 0) CHECK_NEAR(left, sqrt(sum), 1e-13 * left);
    }
}

/* |H'| > 1: plain repetition diverges.  One number, affine: two points tell the fixed point. */
static int overshooting_steps(int metric, double mass)
{
    void *mem;
    iqn *q = make(&mem, 1, 0, 1);
    double x = 3, hx, mr;
    int k;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    CHECK_INT(iqn_set(q, IQN_TOL_ABSOLUTE, 1e-12), IQN_OK);
    for (k = 0; k < 30 && iqn_converged(q) == 0; k++) {
        hx = 1 - 1.5 * x;
        mr = mass * (hx - x);
        if (metric) CHECK(iqn_step_metric(q, &x, &hx, &mr) >= 0);
        else CHECK(iqn_step(q, &x, &hx) >= 0);
    }
    CHECK_NEAR(x, 0.4, 1e-12);
    free(mem);
    return k;
}

/* A method without pairs follows one with pairs, in the norm that these were made in, and hands back to it. */
static void test_aitken_takes_over_from_a_method_with_a_metric(void **state)
{
    int metric, with_sum;
    (void)state;
    for (with_sum = 0; with_sum < 2; with_sum++) {
        double omega[2] = {0, 0};
        for (metric = 0; metric < 2; metric++) {
            void *mem;
            iqn *q = make(&mem, 3, 5, 1);
            double x[3] = {1, 2, 3}, h[3], mr[3];
            int i, t;
            CHECK_INT(iqn_set(q, IQN_GROWTH, 0), IQN_OK);
            if (with_sum) CHECK_INT(iqn_set_sum(q, sum_of_one_rank, NULL), IQN_OK);
            for (t = 0; t < 9; t++) {
                if (t == 2 || t == 6) {
                    CHECK_INT(iqn_commit(q), IQN_OK);
                    CHECK_INT(iqn_set(q, IQN_METHOD, t == 2 ? IQN_AITKEN : IQN_ILS), IQN_OK);
                    for (i = 0; i < 3; i++) x[i] = 1 + i;
                }
                for (i = 0; i < 3; i++) h[i] = 1 + 0.1 * t - (0.5 + i) * x[i];
                for (i = 0; i < 3; i++) mr[i] = 7 * (h[i] - x[i]); /* a multiple of 1: the same steps with and without */
                CHECK(metric ? iqn_step_metric(q, x, h, mr) >= 0 : iqn_step(q, x, h) >= 0);
                if (t == 5) omega[metric] = iqn_get(q, IQN_OMEGA_NOW);
            }
            CHECK(iqn_get(q, IQN_PAIRS) > 0);
            CHECK_INT(metric ? iqn_step(q, x, h) : iqn_step_metric(q, x, h, mr), IQN_EORDER);
            free(mem);
        }
        CHECK_NEAR(omega[1], omega[0], 1e-12 * fabs(omega[0]));
    }
}

static void test_aitken_does_not_see_the_metric(void **state)
{
    (void)state;
    CHECK_INT(overshooting_steps(1, 1), overshooting_steps(0, 0));
    CHECK_INT(overshooting_steps(1, 100), overshooting_steps(0, 0));
    CHECK_INT(overshooting_steps(1, 0.01), overshooting_steps(0, 0));
}

/* From the half step that is left to the fixed point: the secant of one affine number is exact. */
static void test_aitken_after_a_step_that_was_halved(void **state)
{
    void *mem;
    iqn *q = make(&mem, 1, 0, 1);
    double x = 3, hx;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
    hx = 1 - 1.5 * x;
    CHECK(iqn_step(q, &x, &hx) >= 0);
    CHECK_INT(iqn_halve(q, &x), IQN_OK);
    hx = 1 - 1.5 * x;
    CHECK(iqn_step(q, &x, &hx) >= 0);
    CHECK_NEAR(x, 0.4, 1e-12);
    free(mem);
}

/* One number with the slope -1.5, an affine H: wherever the host puts x, Aitken's secant is that of the points it saw. */
static void test_aitken_takes_the_step_that_was_made(void **state)
{
    static const double put[] = {2.9, 4, -1e6, 3.0000001};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof put / sizeof *put; k++) {
        void *mem;
        iqn *q = make(&mem, 1, 0, 1);
        double x = 3, hx;
        CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
        hx = 1 - 1.5 * x;
        CHECK(iqn_step(q, &x, &hx) >= 0);
        x = put[k];
        hx = 1 - 1.5 * x;
        CHECK(iqn_step(q, &x, &hx) >= 0);
        CHECK_NEAR(iqn_get(q, IQN_OMEGA_NOW), 0.4, 1e-8);
        CHECK_NEAR(x, 0.4, 1e-8);
        free(mem);
    }
}

/* Affine H whose b moves from window to window: past pairs stay good.  Where the host overwrites x after the first step, the
   rise of |r| is its doing, and no past pair goes for it. */
static void test_an_edited_iterate_does_not_condemn_past_pairs(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 10, 1);
    const iqn__view m = iqn__open(q);
    double x[2] = {1, 2}, h[2];
    int t, j, old = 0;
    (void)state;
    for (t = 0; t < 6; t++) {
        h[0] = 1 + (t > 3) + 0.5 * x[0] + 0.1 * x[1], h[1] = 3 - 2 * x[1];
        if (t == 5) x[0] = 500, h[0] = 2 + 0.5 * x[0] + 0.1 * x[1];
        CHECK(iqn_step(q, x, h) >= 0);
        if (t == 3) CHECK_INT(iqn_commit(q), IQN_OK);
    }
    for (j = 0; j < q->used; j++) old += m.window[m.order[j]] != q->window;
    CHECK(old > 0);
    CHECK_NEAR(q->drift, 0, 0);
    free(mem);
}

/* Noise of 1e-2 is stated, and a relaxation raised |r| by less: its pair is noise, and staying at the base would give the
   same x again and again.  In a metric, too. */
static void test_a_pair_below_the_noise_does_not_hold_the_base(void **state)
{
    int with, k;
    (void)state;
    for (with = 0; with < 2; with++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 2);
        double x[2] = {1, 1}, h[2], mr[2], before;
        CHECK_INT(iqn_set(q, IQN_NOISE_LEVEL, 1e-2), IQN_OK);
        for (k = 0; k < 6; k++) {
            before = x[0];
            h[0] = h[1] = x[0] + 0.02 + 0.2 * (x[0] - 1);
            mr[0] = mr[1] = ldexp(h[0] - x[0], -100);
            CHECK_INT(with ? iqn_step_metric(q, x, h, mr) : iqn_step(q, x, h), IQN_RELAXED);
            CHECK(x[0] != before);
        }
        free(mem);
    }
}

/* Pairs of a past window that were found stale are forgotten: the rise of |r| is explained, and no sign of curvature. */
static void test_what_stale_pairs_explain_is_no_curvature(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 10, 1);
    double x[2] = {1, 2}, h[2], r[2] = {0, 0};
    int i, t;
    (void)state;
    for (t = 0; t < 4; t++) {
        h[0] = 1 + t + 0.5 * x[0], h[1] = 3 - 2 * x[1];
        for (i = 0; i < 2; i++) r[i] = h[i] - x[i];
        CHECK(iqn_step(q, x, h) >= 0);
        if (t == 2) CHECK_INT(iqn_commit(q), IQN_OK);
    }
    CHECK_INT(q->kind, IQN__FULL);
    CHECK(answer_with(q, x, r, 1000) >= 0);
    CHECK_INT(q->used, 1);
    CHECK_INT(q->surprises, 0);
    free(mem);
}

/* IQN_PAIRS counts the pairs that iqn_pair numbers: a pair that the last step dropped is neither counted nor given. */
static void test_pairs_are_numbered_as_they_are_counted(void **state)
{
    void *mem;
    iqn *q = make(&mem, 3, 10, 1);
    const double v[3][3] = {{4, 0, 0}, {1, 2, 3}, {1, 2, 3.001}}, w[3] = {1, 0, 0};
    double x[3] = {0, 0, 0}, h[3] = {1, 1, 1}, out[3];
    int j;
    (void)state;
    CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, 1e-2), IQN_OK);
    for (j = 0; j < 3; j++) CHECK_INT(iqn_push(q, v[j], w), IQN_OK);
    CHECK_INT(iqn_step(q, x, h), IQN_DROPPED);
    CHECK_INT((int)iqn_get(q, IQN_PAIRS), 2);
    CHECK_INT(iqn_pair(q, 0, out, NULL), IQN_OK);
    CHECK_NEAR(distance(3, out, v[2]), 0, 1e-15);
    CHECK_INT(iqn_pair(q, 1, out, NULL), IQN_OK);
    CHECK_NEAR(distance(3, out, v[0]), 0, 1e-15);
    CHECK_INT(iqn_pair(q, 2, out, NULL), IQN_EARG);
    CHECK_INT(iqn_commit(q), IQN_OK);
    CHECK_INT(iqn_pair(q, 1, out, NULL), IQN_OK); /* pardoned */
    CHECK_NEAR(distance(3, out, v[1]), 0, 1e-15);
    free(mem);
}

/* A window in which |hx| ran away is discarded: in its repetition |hx| is measured from the last accepted answer again, so
   that a small |r| / |hx| at a far larger |hx| is no convergence. */
static void test_a_discarded_window_leaves_no_mark_on_the_guard(void **state)
{
    int far;
    (void)state;
    for (far = 0; far < 2; far++) {
        void *mem;
        iqn *q = make(&mem, 2, 5, 2);
        double x[2] = {1, 1}, h[2] = {1, 1};
        CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-2), IQN_OK);
        CHECK_INT(iqn_set_block(q, -1, IQN_TOL_RELATIVE, 1e-2), IQN_OK);
        CHECK_INT(iqn_step(q, x, h), IQN_SOLVED);
        CHECK_INT(iqn_commit(q), IQN_OK);
        if (far) {
            h[0] = 1e9, h[1] = 1e9;
            CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
            CHECK_INT(iqn_discard(q), IQN_OK);
        }
        x[0] = x[1] = 1, h[0] = h[1] = 2;
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        x[0] = x[1] = 1e4, h[0] = h[1] = 1e4 + 1;
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_INT(iqn_converged(q), 0);
        free(mem);
    }
}

/* A symmetric affine H of 60 numbers with as many eigenvalues: the pairs of recent steps carry a short recurrence, and 20 or 30 columns
   are enough.  (None of these converged while the pair that newer ones explain best always made room.) */
static void test_few_columns_are_enough_on_a_symmetric_h(void **state)
{
    enum { N = 60 };
    unsigned long long seed = 5;
    int run, i, k;
    (void)state;
    for (run = 0; run < 10; run++) {
        double b[N], side[N], x[N] = {0}, h[N];
        void *mem;
        iqn *q = make(&mem, N, run % 2 ? 30 : 20, 1);
        for (i = 0; i < N; i++) b[i] = random_number(&seed), side[i] = 0.5 * random_number(&seed);
        CHECK_INT(iqn_set(q, IQN_TOL_RELATIVE, 1e-9), IQN_OK);
        for (k = 0; k < 300 && !iqn_converged(q); k++) {
            for (i = 0; i < N; i++)
                h[i] = b[i] - (1 + 30. * i / N) * x[i] + (i > 0 ? side[i - 1] * x[i - 1] : 0) + (i < N - 1 ? side[i] * x[i + 1] : 0);
            CHECK(iqn_step(q, x, h) >= 0);
        }
        CHECK_INT(iqn_converged(q), 1);
        CHECK(iqn_get(q, IQN_NFULL) > 0);
        free(mem);
    }
}

/* Three columns are full and a fourth pair comes.  (0,1,gap,0) explains (0,1,0,0) but for the gap: if that is below a twentieth this
   pair goes, else the oldest, (1,0,0,0); the oldest always by the textbooks, and where it is of a past window of a straight run. */
static void test_which_pair_makes_room(void **state)
{
    static const struct {
        int past, curved, nonlinear, method;
        double limit, gap;
        int oldest_goes;
    } row[] = {{0, 0, 0, IQN_ILS, 0, 0.3, 1},     {1, 0, 0, IQN_ILS, 0, 0.3, 1},      {0, 1, 0, IQN_ILS, 0, 0.3, 1},
               {0, 0, 1, IQN_ILS, 0, 0.3, 1},     {0, 0, 0, IQN_ILS, 0, 0.049, 0},    {1, 0, 0, IQN_ILS, 0, 0.049, 1},
               {0, 1, 0, IQN_ILS, 0, 0.049, 0},   {0, 0, 1, IQN_ILS, 0, 0.049, 0},    {1, 1, 0, IQN_ILS, 0, 0.051, 1},
               {0, 0, 0, IQN_ILS, 1e-16, 1e-3, 1}, {0, 0, 0, IQN_IMVJ, 0, 1e-3, 1}};
    static const double w[4] = {1, 1, 1, 1};
    double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 4, 3, 1);
        double x[4] = {0, 0, 0, 0}, h[4] = {1, 1, 1, 1}, out[4];
        int j;
        v[2][2] = row[k].gap;
        CHECK_INT(iqn_set(q, IQN_METHOD, row[k].method), IQN_OK);
        CHECK_INT(iqn_set(q, IQN_FILTER_LIMIT, row[k].limit), IQN_OK);
        for (j = 0; j < 3; j++) {
            CHECK_INT(iqn_push(q, v[j], w), IQN_OK);
            if (j == 0 && row[k].past) CHECK_INT(iqn_commit(q), IQN_OK);
        }
        CHECK_INT(iqn_step(q, x, h), IQN_OK);
        q->curved = row[k].curved, q->nonlinear = row[k].nonlinear;
        CHECK_INT(iqn_push(q, v[3], w), IQN_OK);
        CHECK_INT((int)iqn_get(q, IQN_PAIRS), 3);
        CHECK_INT((int)iqn_get(q, IQN_NFULL), 1);
        CHECK_INT(iqn_pair(q, 2, out, NULL), IQN_OK);
        CHECK_NEAR(distance(4, out, v[row[k].oldest_goes ? 1 : 0]), 0, 1e-15);
        if (row[k].limit == 0 && row[k].method == IQN_ILS && !row[k].past) { /* "below a twentieth" */
            const iqn__view m = iqn__open(q);
            m.apart[m.order[1]] = 0.05 * 0.05;
            CHECK_INT(iqn__spare(q, &m), 2);
        }
        CHECK_INT(iqn_push(q, w, w), IQN_OK); /* the newest, never tried, stays */
        CHECK_INT(iqn_pair(q, 1, out, NULL), IQN_OK);
        CHECK_NEAR(distance(4, out, v[3]), 0, 1e-15);
        free(mem);
    }
}

/* A difference of residuals is a pair where in one block at least it is more than a rounding of hx, which is 1 here. */
static void test_a_rounding_of_the_answer_is_no_pair(void **state)
{
    static const struct {
        double change[2];
        int pair;
    } row[] = {{{DBL_EPSILON, 0}, 0},   {{0, DBL_EPSILON}, 0},      {{2 * DBL_EPSILON, 0}, 1}, {{0, 2 * DBL_EPSILON}, 1},
               {{0.25, DBL_EPSILON}, 1}, {{DBL_EPSILON, 0.25}, 1}, {{DBL_EPSILON, DBL_EPSILON}, 0}};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof row / sizeof *row; k++) {
        void *mem;
        iqn *q = make(&mem, 2, 3, 2);
        double x[2] = {0.5, 0.5};
        const double h[2] = {1, 1};
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        x[0] = 0.5 - row[k].change[0], x[1] = 0.5 - row[k].change[1];
        CHECK(iqn_step(q, x, h) >= 0);
        CHECK_INT(q->used, row[k].pair);
        CHECK_INT(iqn_get(q, IQN_NZERO), !row[k].pair);
        free(mem);
    }
}

/* A pair that is pushed, wherever it is kept, ends a probe: its pair may have gone.  One that is refused does not. */
static void test_a_push_ends_a_probe(void **state)
{
    static const double nothing[3] = {0, 0, 0};
    double v[3] = {1, 1, 1};
    void *mem;
    iqn *q = make(&mem, 3, 3, 1);
    const iqn__view m = iqn__open(q);
    int k;
    (void)state;
    q->base = 3; /* any slot: 2, 1 and 0 are free */
    for (k = 0; k < 3; k++) {
        q->kind = IQN__PROBE;
        CHECK_INT(iqn_push(q, nothing, nothing), IQN_DROPPED);
        CHECK_INT(q->kind, IQN__PROBE);
        v[k] = 2;
        CHECK_INT(iqn_push(q, v, v), IQN_OK);
        CHECK_INT(m.order[0], 2 - k);
        CHECK_INT(q->kind, IQN__PLAIN);
    }
    free(mem);
}

/* Growth is measured from the accepted answer, of one iteration, too. */
static void test_the_answer_of_one_iteration_counts(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 2, 2);
    const iqn__view m = iqn__open(q);
    double x[2] = {0, 0};
    const double h[2] = {3, 4};
    int k;
    (void)state;
    CHECK_INT(iqn_commit(q), IQN_OK); /* of nothing: no window to count */
    CHECK_INT(q->since_merge, 0);
    CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
    for (k = 0; k < 2; k++) { /* the second window is empty */
        CHECK_INT(iqn_commit(q), IQN_OK);
        CHECK_NEAR(iqn__value_of(q->growth_from), 5, 1e-15);
        CHECK_NEAR(iqn__value_of(m.block[1].growth_from), 4, 1e-15);
    }
    free(mem);
}

/* The end of a window changes neither products nor columns, nor what the last step has found. */
static void test_the_end_of_a_window_leaves_what_is_stored(void **state)
{
    enum { N = 6 };
    int way, k;
    (void)state;
    for (way = 0; way < 2; way++) {
        void *mem;
        iqn *q = make(&mem, N, 4, 3);
        const iqn__view m = iqn__open(q);
        double x[N] = {0}, h[N] = {1, 2, 3, 4, 5, 6};
        unsigned char *const small = (unsigned char *)m.gram, *const end = (unsigned char *)m.order;
        unsigned char *const norms = (unsigned char *)&q->best, *i;
        for (k = 0; k < 3; k++) CHECK(iqn_step(q, x, h) >= 0);
        for (i = small; i < end; i++) *i = (unsigned char)(i - small);
        for (i = norms; i < (unsigned char *)&q->columns; i++) *i = (unsigned char)(i - norms);
        for (k = 0; k < 10 * N; k++) m.V[k] = k;
        CHECK_INT(way ? iqn_discard(q) : iqn_commit(q), IQN_OK);
        for (i = small; i < end; i++) CHECK(*i == (unsigned char)(i - small));
        for (i = norms; i < (unsigned char *)&q->columns; i++) CHECK(*i == (unsigned char)(i - norms));
        for (k = 0; k < 10 * N; k++) CHECK(m.V[k] == k);
        free(mem);
    }
}

/* Without columns every step is a relaxation, and no pair is missed. */
static void test_no_columns_no_pairs(void **state)
{
    void *mem;
    iqn *q = make(&mem, 2, 0, 1);
    double x[2] = {1, 2}, h[2] = {2, 5};
    int k;
    (void)state;
    for (k = 0; k < 4; k++) {
        CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
        CHECK_INT(iqn_get(q, IQN_PAIRS), 0);
        CHECK_INT(iqn_get(q, IQN_NFULL) + iqn_get(q, IQN_NZERO), 0);
    }
    CHECK_NEAR(x[1], 5 - 3 * pow(0.9, 4), 1e-14);
    free(mem);
}

/* Aitken on ranks: what travels is the step that was made, by bounds, iqn_halve or the host, from 1e-6 to 1e6 of x; one rank
   with a sum gives the same omega as without. */
static void test_aitken_on_ranks_takes_the_step_that_was_made(void **state)
{
    static const double edit[] = {1, 1 + 1e-6, 3, 1e6, -1e-3};
    size_t k;
    (void)state;
    for (k = 0; k < sizeof edit / sizeof *edit; k++) {
        double omega[2], x[3], h[3];
        int with, i, t;
        for (with = 0; with < 2; with++) {
            void *mem;
            iqn *q = make(&mem, 3, 0, 1);
            CHECK_INT(iqn_set(q, IQN_METHOD, IQN_AITKEN), IQN_OK);
            if (with) CHECK_INT(iqn_set_sum(q, sum_of_one_rank, NULL), IQN_OK);
            for (i = 0; i < 3; i++) x[i] = 1 + i;
            for (t = 0; t < 4; t++) {
                for (i = 0; i < 3; i++) h[i] = 1 - (0.5 + i) * x[i];
                CHECK_INT(iqn_step(q, x, h), IQN_RELAXED);
                if (t == 1) x[1] *= edit[k];
                if (t == 2) CHECK_INT(iqn_halve(q, x), IQN_OK);
            }
            omega[with] = iqn_get(q, IQN_OMEGA_NOW);
            free(mem);
        }
        CHECK_NEAR(omega[1], omega[0], 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_aitken_on_ranks_takes_the_step_that_was_made),
        cmocka_unit_test(test_few_columns_are_enough_on_a_symmetric_h),
        cmocka_unit_test(test_which_pair_makes_room),
        cmocka_unit_test(test_a_rounding_of_the_answer_is_no_pair),
        cmocka_unit_test(test_no_columns_no_pairs),
        cmocka_unit_test(test_a_push_ends_a_probe),
        cmocka_unit_test(test_the_answer_of_one_iteration_counts),
        cmocka_unit_test(test_the_end_of_a_window_leaves_what_is_stored),
        cmocka_unit_test(test_a_pair_of_one_field_with_a_metric),
        cmocka_unit_test(test_a_discarded_window_leaves_no_mark_on_the_guard),
        cmocka_unit_test(test_aitken_takes_the_step_that_was_made),
        cmocka_unit_test(test_an_edited_iterate_does_not_condemn_past_pairs),
        cmocka_unit_test(test_a_pair_below_the_noise_does_not_hold_the_base),
        cmocka_unit_test(test_what_stale_pairs_explain_is_no_curvature),
        cmocka_unit_test(test_pairs_are_numbered_as_they_are_counted),
        cmocka_unit_test(test_two_updates_of_the_serial_acceleration_test),
        cmocka_unit_test(test_aitken_of_the_serial_acceleration_test),
        cmocka_unit_test(test_four_equations),
        cmocka_unit_test(test_three_equations_of_kinsol),
        cmocka_unit_test(test_affine_maps_end_after_n_plus_2_evaluations),
        cmocka_unit_test(test_update_equals_householder_qr),
        cmocka_unit_test(test_the_square_of_a_pair_that_fell_far),
        cmocka_unit_test(test_accuracy_at_conditions_up_to_1e14),
        cmocka_unit_test(test_products_are_exact_where_the_base_stays),
        cmocka_unit_test(test_every_status_is_reached_and_negative_ones_touch_nothing),
        cmocka_unit_test(test_n_0_and_n_1_and_n_2),
        cmocka_unit_test(test_more_columns_than_rows_keep_no_noise),
        cmocka_unit_test(test_zero_residuals_at_once_later_and_in_one_block),
        cmocka_unit_test(test_two_identical_residuals_and_identical_columns),
        cmocka_unit_test(test_scaling_by_powers_of_two_is_exact),
        cmocka_unit_test(test_residuals_of_1e308_and_denormal_ones),
        cmocka_unit_test(test_blocks_that_differ_by_1e12),
        cmocka_unit_test(test_contraction_0_999999_and_expansion_minus_1e6),
        cmocka_unit_test(test_noise_floor),
        cmocka_unit_test(test_omega_negative_and_2),
        cmocka_unit_test(test_aitken_with_equal_and_zero_residuals),
        cmocka_unit_test(test_a_window_of_one_iteration_does_not_count_for_reuse),
        cmocka_unit_test(test_filter_of_the_last_step_is_withdrawn),
        cmocka_unit_test(test_filter_limits_0_1_and_1e_16),
        cmocka_unit_test(test_200_columns_of_rank_3),
        cmocka_unit_test(test_imvj_starts_a_window_with_minus_J_r),
        cmocka_unit_test(test_imvj_equals_its_dense_definition),
        cmocka_unit_test(test_mixing_of_kinsol),
        cmocka_unit_test(test_secondary_blocks_only_follow),
        cmocka_unit_test(test_the_largest_weight_is_the_unit),
        cmocka_unit_test(test_push_refuses_blocks_that_do_not_add_up),
        cmocka_unit_test(test_convergence_measures),
        cmocka_unit_test(test_pairs_read_and_pushed_give_the_same_update),
        cmocka_unit_test(test_checkpoint_in_a_file_mid_window_is_bit_identical),
        cmocka_unit_test(test_sums_over_1_2_3_and_64_ranks),
        cmocka_unit_test(test_nan_on_one_rank),
        cmocka_unit_test(test_a_first_window_from_rest),
        cmocka_unit_test(test_a_ramp_is_no_stall),
        cmocka_unit_test(test_push_of_an_infinite_slope),
        cmocka_unit_test(test_aitken_by_value_at_any_scale),
        cmocka_unit_test(test_pairs_pushed_amid_a_window_at_any_scale),
        cmocka_unit_test(test_metric_equals_dense_weighted_least_squares),
        cmocka_unit_test(test_a_multiple_of_1_as_metric),
        cmocka_unit_test(test_halving_goes_half_of_the_way_back),
        cmocka_unit_test(test_a_probe_finds_an_affine_map),
        cmocka_unit_test(test_a_nonlinear_map_is_explored),
        cmocka_unit_test(test_a_host_that_edits_x_is_respected),
        cmocka_unit_test(test_without_a_fixed_point_nothing_converges),
        cmocka_unit_test(test_patience_knows_new_pairs),
        cmocka_unit_test(test_the_length_of_the_messages),
        cmocka_unit_test(test_every_key_has_an_effect),
        cmocka_unit_test(test_bounds_clamp_every_component),
        cmocka_unit_test(test_aitken_of_blocks_and_of_bounded_steps),
        cmocka_unit_test(test_fewer_past_windows_count_at_once),
        cmocka_unit_test(test_a_lane_that_takes_all_loses_nothing),
        cmocka_unit_test(test_fused_where_the_compiler_may),
        cmocka_unit_test(test_loops_at_every_length),
        cmocka_unit_test(test_vectors_at_every_length),
        cmocka_unit_test(test_loops_of_an_old_processor),
        cmocka_unit_test(test_steps_of_an_old_processor),
        cmocka_unit_test(test_a_step_out_of_range_ends_at_the_largest_double),
        cmocka_unit_test(test_a_step_whose_pair_is_out_of_range),
        cmocka_unit_test(test_a_block_that_falls_out_of_range_leaves_no_pair),
        cmocka_unit_test(test_noise_far_above_a_pair),
        cmocka_unit_test(test_a_limit_that_is_not_set_is_not_met),
        cmocka_unit_test(test_guards_behind_outputs),
        cmocka_unit_test(test_merging_every_second_window),
        cmocka_unit_test(test_counters),
        cmocka_unit_test(test_every_step_is_that_of_the_comment),
        cmocka_unit_test(test_exact_pairs_are_at_most_as_many_as_rows),
        cmocka_unit_test(test_a_full_step_of_a_nonlinear_run_ages_the_pairs),
        cmocka_unit_test(test_stale_pairs_go_after_the_second_residual),
        cmocka_unit_test(test_a_disappointment_ends_with_its_window),
        cmocka_unit_test(test_the_scale_of_noise_is_a_norm),
        cmocka_unit_test(test_zero_is_a_value_but_for_two_keys),
        cmocka_unit_test(test_many_copies_of_a_field_change_nothing),
        cmocka_unit_test(test_every_argument_of_the_metric_calls),
        cmocka_unit_test(test_lengths_are_fixed_by_the_first_step),
        cmocka_unit_test(test_a_field_that_is_zero_is_as_large_as_the_others),
        cmocka_unit_test(test_units_of_a_metric_change_nothing),
        cmocka_unit_test(test_units_of_a_block_change_nothing),
        cmocka_unit_test(test_a_converged_step_is_the_answer_beyond_the_bounds_too),
        cmocka_unit_test(test_aitken_keeps_omega_where_its_secant_is_zero),
        cmocka_unit_test(test_a_difference_of_residuals_keeps_what_rounding_takes),
        cmocka_unit_test(test_the_steps_of_exploring),
        cmocka_unit_test(test_forgotten_pairs_do_not_end_exploring),
        cmocka_unit_test(test_a_filter_limit_knows_no_noise),
        cmocka_unit_test(test_steps_refuse_lengths_that_do_not_add_up),
        cmocka_unit_test(test_growth_and_the_relative_limit),
        cmocka_unit_test(test_merged_pairs_outlive_a_repeated_window),
        cmocka_unit_test(test_a_pushed_pair_has_the_noise_of_the_answer),
        cmocka_unit_test(test_an_edited_iterate_says_nothing_about_the_slope),
        cmocka_unit_test(test_double_double_arithmetic),
        cmocka_unit_test(test_sums_of_products),
        cmocka_unit_test(test_gram_matrix_of_small_units),
        cmocka_unit_test(test_fused_and_split_products_agree),
        cmocka_unit_test(test_fused_and_split_factors_agree),
        cmocka_unit_test(test_shift_by_more_than_a_double_holds),
        cmocka_unit_test(test_pushed_pairs_are_kept_by_commit),
        cmocka_unit_test(test_aitken_of_noise_and_over_windows),
        cmocka_unit_test(test_residual_sum_starts_anew_in_every_window),
        cmocka_unit_test(test_one_side_refines_from_2_to_16_sub_steps),
        cmocka_unit_test(test_every_rank_calls_the_sum_equally_often),
        cmocka_unit_test(test_threads_on_different_objects_and_reading_the_same),
        cmocka_unit_test(test_every_setting_has_its_default_its_range_and_its_effect),
        cmocka_unit_test(test_relaxation_and_bounds_of_every_length),
        cmocka_unit_test(test_limits_are_met_at_the_iteration_they_name),
        cmocka_unit_test(test_starting_over),
        cmocka_unit_test(test_starting_over_without_a_pair_moves_the_base),
        cmocka_unit_test(test_patience_and_the_counters),
        cmocka_unit_test(test_a_new_independent_pair_is_no_stall),
        cmocka_unit_test(test_a_push_takes_the_room_of_a_dropped_pair),
        cmocka_unit_test(test_blocks_of_one_field_change_nothing),
        cmocka_unit_test(test_keys_and_blocks_that_do_not_exist),
        cmocka_unit_test(test_aitken_does_not_see_the_metric),
        cmocka_unit_test(test_aitken_takes_over_from_a_method_with_a_metric),
        cmocka_unit_test(test_aitken_after_a_step_that_was_halved),
        cmocka_unit_test(test_the_arrays_fill_the_memory),
        cmocka_unit_test(test_the_largest_sizes),
        cmocka_unit_test(test_numbers_for_the_ranks_are_on_their_grids),
        cmocka_unit_test(test_the_bounds_of_the_messages),
        cmocka_unit_test(test_limits_at_the_limits),
        cmocka_unit_test(test_where_growth_is_measured_from),
        cmocka_unit_test(test_progress_at_its_limits),
        cmocka_unit_test(test_a_new_pair_ends_the_waiting),
        cmocka_unit_test(test_a_pair_that_is_dropped_does_not_end_the_waiting),
        cmocka_unit_test(test_inherited_noise),
        cmocka_unit_test(test_the_quick_bound_of_inherited_noise),
        cmocka_unit_test(test_what_stands_out),
        cmocka_unit_test(test_a_fingerprint_sees_every_bit),
        cmocka_unit_test(test_a_fingerprint_sees_two_alike),
        cmocka_unit_test(test_columns_that_cancel_beyond_the_range),
        cmocka_unit_test(test_a_fingerprint_sees_whole_fields),
        cmocka_unit_test(test_a_field_changed_by_the_host_is_no_bad_step),
        cmocka_unit_test(test_a_step_too_long_to_add_up),
        cmocka_unit_test(test_the_guard_of_a_growth_that_overflows),
        cmocka_unit_test(test_a_clamped_probe_proves_nothing),
        cmocka_unit_test(test_what_counts_as_clamped),
        cmocka_unit_test(test_a_large_mixing_is_no_curvature),
        cmocka_unit_test(test_pairs_kept_for_one_step_are_past_ones),
        cmocka_unit_test(test_a_residual_far_below_the_one_before),
        cmocka_unit_test(test_what_is_left_of_nearly_nothing),
        cmocka_unit_test(test_no_slope_over_no_distance),
        cmocka_unit_test(test_growth_at_its_limit),
        cmocka_unit_test(test_taking_back_needs_every_block),
        cmocka_unit_test(test_what_is_a_surprise),
        cmocka_unit_test(test_what_makes_a_run_inexact),
        cmocka_unit_test(test_an_inexact_run_converges),
        cmocka_unit_test(test_a_residual_that_stays_does_not_condemn_past_pairs),
        cmocka_unit_test(test_what_makes_a_run_steady),
        cmocka_unit_test(test_the_steepest_slope_fades),
        cmocka_unit_test(test_the_error_of_a_probe),
        cmocka_unit_test(test_what_is_above_the_noise),
        cmocka_unit_test(test_where_the_base_goes),
        cmocka_unit_test(test_a_bad_step_within_rounding_is_not_taken_back),
        cmocka_unit_test(test_when_pairs_lead_nowhere),
        cmocka_unit_test(test_starting_over_takes_nothing_back),
        cmocka_unit_test(test_pairs_that_a_probe_proves_stay),
        cmocka_unit_test(test_a_new_window_explores_where_growth_is_watched),
        cmocka_unit_test(test_no_x_comes_twice_in_a_nonlinear_run),
        cmocka_unit_test(test_noise_does_not_prove_an_affine_h_nonlinear),
        cmocka_unit_test(test_a_step_too_long_to_measure_is_no_slope),
        cmocka_unit_test(test_the_answer_is_that_of_the_last_call),
        cmocka_unit_test(test_halving_from_any_base),
        cmocka_unit_test(test_null_arrays_of_one_number),
        cmocka_unit_test(test_coefficients_beyond_all_numbers),
        cmocka_unit_test(test_a_bound_far_away_is_no_error),
        cmocka_unit_test(test_a_fair_guess_of_the_unit_stays),
        cmocka_unit_test(test_a_tenfold_sum_of_residuals),
        cmocka_unit_test(test_a_block_at_rest_keeps_its_sum_of_residuals),
        cmocka_unit_test(test_the_bound_of_a_step),
        cmocka_unit_test(test_the_small_matrix_is_kept),
        cmocka_unit_test(test_empty_windows_do_not_merge),
        cmocka_unit_test(test_scaling_leaves_what_is_behind),
        cmocka_unit_test(test_a_pair_pushed_before_any_answer),
        cmocka_unit_test(test_a_push_alone_makes_a_window),
        /* the slow ones last */
        cmocka_unit_test(test_commit_and_discard_without_step_and_1e5_windows),
        cmocka_unit_test(test_what_a_step_leaves_of_the_residual),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
