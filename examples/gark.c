/* SPDX-License-Identifier: MIT

   gark.c - an implicit-explicit method with four tables: proved, completed by a dense output, and run.

   y' = fE(t, y) + fI(t, y).  Stages zE_i feed fE and stages zI_i feed fI, as many of each as the method likes:

      zE_i = y + h sum_j A(E,E)_ij kE_j + h sum_j A(E,I)_ij kI_j      kE_i = fE(t + cE_i h, zE_i)
      zI_i = y + h sum_j A(I,E)_ij kE_j + h sum_j A(I,I)_ij kI_j      kI_i = fI(t + cI_i h, zI_i), j = i: to be solved
      ynew = y + h sum_j b(E)_j kE_j + h sum_j b(I)_j kI_j

   The recipe: 1. rk_defect_gark says which order the four tables have.  2. Sort the stages so that each meets only
   slopes that are there (schedule, below).  3. Each stage is two calls of rk_combine, the second one with z for y;
   where A(I,I)_ii != 0, solve Z = z + h a_ii fI(Z) and take kI_i = (Z - z)/(h a_ii).  4. So is ynew, and the error
   estimate, with b - bhat for b and no y.  5. So is the dense output, with b(theta); a method that brings none gets one
   here, from the order conditions of the trees with at most three vertices and LAPACK's least squares.

   The problem (KPR, split): u' = [G a + e b - m u^2] + r'/(2u) + m u^2, v' = [e a - b - m v^2] + s'/(2v) + m v^2, brackets
   implicit; a = (u^2 - 1 - r)/(2u), b = (v^2 - 2 - s)/(2v), r = cos(t)/2, s = cos(w t); exact u = sqrt(1 + r) and
   v = sqrt(2 + s).  a and b vanish on the solution: without m the implicit part would have nothing to do. */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

enum { N = 2, MOST = 16, DENSE = 3, E = 0, I = 1 }; /* unknowns, stages, highest uniform order of the dense output */

typedef struct method {
    const char *name, *source;
    int s[2], order_hat; /* order_hat 0: no pair */
    const double *A[4];  /* (E,E), (E,I), (I,E), (I,I): A[2*p + q] has s[p] rows of s[q] numbers */
    const double *b[2], *bhat[2];
} method;

/* ---- published methods ------------------------------------------------------------------------------------------- */

static const double gs2_ee[] = {0, 0, 0, 1. / 2, 0, 0, 1. / 2, 1. / 2, 0}, gs2_ei[] = {0, 0, 1. / 2, 0, 1. / 2, 1. / 2},
    gs2_ie[] = {1. / 4, 0, 0, 1. / 4, 1. / 2, 0}, gs2_ii[] = {1. / 4, 0, 1. / 2, 1. / 4},
    gs2_be[] = {1. / 4, 1. / 2, 1. / 4}, gs2_bi[] = {1. / 2, 1. / 2};
#define GAMMA 0.43586652150845899942 /* of the L-stable SDIRK method with 3 stages: g^3 - 3 g^2 + 3 g/2 - 1/6 = 0 */
#define B1    1.20849664917601007034 /* the other numbers are rational functions of it */
#define B2    -0.64436317068446906975
static const double ei3_ee[] = {0, 0, 0, 1. / 2, 0, 0, 0, 3. / 4, 0},
    ei3_ei[] = {0, 0, 0, 1. / 2, 0, 0, 1.15894519150132660638, -0.40894519150132660638, 0},
    ei3_ie[] = {GAMMA, 0, 0, 0.55880996997674652335, 0.15912329077748297636, 0, 2. / 9, 1. / 3, 4. / 9},
    ei3_ii[] = {GAMMA, 0, 0, 0.28206673924577050029, GAMMA, 0, B1, B2, GAMMA},
    ei3_be[] = {2. / 9, 1. / 3, 4. / 9}, ei3_bi[] = {B1, B2, GAMMA},
    ei3_he[] = {1. / 40, 37. / 40, 1. / 20}, ei3_hi[] = {0.77263012766755107092, 0.22736987233244892908, 0};
static const double ei4_ee[] = {0, 0, 0, 0, 0, 0, 1. / 4, 0, 0, 0, 0, 0, 3. / 32, 9. / 32, 0, 0, 0, 0,
        1932. / 2197, -7200. / 2197, 7296. / 2197, 0, 0, 0, 439. / 216, -8, 3680. / 513, -845. / 4104, 0, 0,
        -8. / 27, 2, -3544. / 2565, 1859. / 4104, -11. / 40, 0},
    ei4_ei[] = {0, 0, 0, 0, 0, 1. / 4, 0, 0, 0, 0, 171. / 416, -15. / 416, 0, 0, 0,
        1368. / 2197, 660. / 2197, 0, 0, 0, 55. / 273, 1555. / 1638, -33. / 7, 575. / 126, 0,
        0, 0, -21. / 8, 25. / 8, 0},
    ei4_ie[] = {1. / 4, 0, 0, 0, 0, 0, -79. / 100, 169. / 100, 0, 0, 0, 0, -23. / 198, 155. / 198, 0, 0, 0, 0,
        55. / 920, 14. / 23, -896. / 10925, 1183. / 87400, 0, 0, 25. / 216, 0, 1408. / 2565, 2197. / 4104, -1. / 5, 0},
    ei4_ii[] = {1. / 4, 0, 0, 0, 0, 13. / 20, 1. / 4, 0, 0, 0, 580. / 1287, -175. / 5148, 1. / 4, 0, 0,
        12698. / 37375, -201. / 2990, 891. / 11500, 1. / 4, 0, 944. / 1365, -400. / 819, 99. / 35, -575. / 252, 1. / 4},
    ei4_be[] = {25. / 216, 0, 1408. / 2565, 2197. / 4104, -1. / 5, 0},
    ei4_bi[] = {944. / 1365, -400. / 819, 99. / 35, -575. / 252, 1. / 4},
    ei4_he[] = {16. / 135, 0, 6656. / 12825, 28561. / 56430, -9. / 50, 2. / 55},
    ei4_hi[] = {41911. / 60060, -83975. / 144144, 3393. / 1120, -27025. / 11088, 103. / 352};

static const method published[] = {
    {"sg2", "Sandu & Guenther, SIAM J. Numer. Anal. 53 (2015), example 6, beta = 1/2", {3, 2}, 0,
     {gs2_ee, gs2_ei, gs2_ie, gs2_ii}, {gs2_be, gs2_bi}, {NULL, NULL}},
    {"exim3", "Sarshar, Roberts & Sandu, SIAM J. Sci. Comput. 41 (2019), one fast step", {3, 3}, 2,
     {ei3_ee, ei3_ei, ei3_ie, ei3_ii}, {ei3_be, ei3_bi}, {ei3_he, ei3_hi}},
    {"exim4", "the same, Fehlberg's explicit part", {6, 5}, 3,
     {ei4_ee, ei4_ei, ei4_ie, ei4_ii}, {ei4_be, ei4_bi}, {ei4_he, ei4_hi}},
};

/* An additive method is the case in which the column alone decides: A(E,E) = A(I,E), A(E,I) = A(I,I). */
static method of_halves(const char *name, const rk_table *explicit_half, const rk_table *implicit_half)
{
    method M = {name, "both halves from rk.h", {0, 0}, 0, {NULL}, {NULL}, {NULL}};
    const rk_table *half[2];
    int p, status = rk_check_imex(explicit_half, implicit_half, NULL);
    scene_check(status, rk_message(status));
    half[E] = explicit_half;
    half[I] = implicit_half;
    for (p = 0; p < 2; p++) {
        M.s[p] = half[p]->stages;
        M.A[p] = M.A[2 + p] = half[p]->A;
        M.b[p] = half[p]->b;
        M.bhat[p] = half[p]->bhat;
    }
    M.order_hat = half[E]->order_hat;
    return M;
}

static const double *numbers(FILE *f, int count)
{
    static double store[4 * MOST * MOST + 4 * MOST];
    static int used;
    double *x = store + used;
    int i;
    used += count;
    for (i = 0; i < count; i++)
        if (fscanf(f, "%lf", x + i) != 1) {
            fprintf(stderr, "--file: %d numbers expected, %d found\n", count, i);
            exit(2);
        }
    return x;
}

/* A method of the user's: stages of E and I, order of the pair or 0, then the four tables by rows, b(E), b(I), and
   bhat(E), bhat(I) where there is a pair. */
static method from_file(const char *path)
{
    method M = {path, "a file", {0, 0}, 0, {NULL}, {NULL}, {NULL}};
    FILE *f = fopen(path, "r");
    int p;
    if (!f || fscanf(f, "%d %d %d", &M.s[E], &M.s[I], &M.order_hat) != 3 || M.s[E] < 1 || M.s[E] > MOST || M.s[I] < 1 ||
        M.s[I] > MOST) {
        fprintf(stderr, "--file %s: the numbers of stages, 1 to %d, and the order of the pair come first\n", path,
                MOST);
        exit(2);
    }
    for (p = 0; p < 4; p++) M.A[p] = numbers(f, M.s[p / 2] * M.s[p % 2]);
    for (p = 0; p < 2; p++) M.b[p] = numbers(f, M.s[p]);
    if (M.order_hat > 0) {
        M.bhat[E] = numbers(f, M.s[E]);
        M.bhat[I] = numbers(f, M.s[I]);
    }
    fclose(f);
    return M;
}

/* ---- proof and schedule ------------------------------------------------------------------------------------------ */

static int order_of(const method *M, const double *const *b)
{
    int p = 0;
    while (p < 6 && rk_defect_gark(p + 1, 2, M->s, M->A, b) <= RK_TOLERANCE) p++;
    return p;
}

/* Whether stage i of part p meets only slopes that are there; its own one may be solved for in the implicit part. */
static int ready(const method *M, int p, int i, int there[2][MOST])
{
    int q, j;
    for (q = 0; q < 2; q++)
        for (j = 0; j < M->s[q]; j++) {
            const int own = p == I && q == I && j == i;
            if (M->A[2 * p + q][i * M->s[q] + j] != 0 && !there[q][j] && !own) return 0;
        }
    return 1;
}

/* The stages in an order in which each can be computed, part*MOST + stage; their number, less than s(E) + s(I) where
   some are coupled. */
static int schedule(const method *M, int *list)
{
    int there[2][MOST] = {{0}}, count = 0, before = -1, p, i;
    while (count > before) {
        before = count;
        for (p = 0; p < 2; p++)
            for (i = 0; i < M->s[p]; i++)
                if (!there[p][i] && ready(M, p, i, there)) {
                    there[p][i] = 1;
                    list[count++] = p * MOST + i;
                }
    }
    return count;
}

/* ---- dense output ------------------------------------------------------------------------------------------------ */

extern void dgelsd_(const int *m, const int *n, const int *nrhs, double *A, const int *lda, double *B, const int *ldb,
                    double *s, const double *rcond, int *rank, double *work, const int *lwork, int *iwork, int *info);
extern void dgesv_(const int *n, const int *nrhs, double *A, const int *lda, int *pivot, double *B, const int *ldb,
                   int *info);

/* out_i = sum_j A(p,q)_ij x_j */
static void times(const method *M, int p, int q, const double *x, double *out)
{
    int i, j;
    for (i = 0; i < M->s[p]; i++)
        for (out[i] = 0, j = 0; j < M->s[q]; j++) out[i] += M->A[2 * p + q][i * M->s[q] + j] * x[j];
}

/* The trees of at most `order` <= 3 vertices whose root is of part p: what they make of the stages, in Phi, and with how many
   vertices and which 1/gamma.  q and r colour the other vertices. */
enum { TREES = 11 };
static int trees(const method *M, int p, int order, double Phi[TREES][MOST], int *vertices, double *target)
{
    double one[MOST], c[2][MOST], inner[MOST];
    int count = 0, q, r, i;
    for (i = 0; i < MOST; i++) one[i] = Phi[0][i] = 1;
    vertices[count] = 1;
    target[count++] = 1;
    if (order == 1) return count;
    for (q = 0; q < 2; q++) {
        times(M, p, q, one, c[q]);
        memcpy(Phi[count], c[q], sizeof c[q]);
        vertices[count] = 2;
        target[count++] = 1. / 2;
    }
    if (order == 2) return count;
    for (q = 0; q < 2; q++)
        for (r = 0; r < 2; r++) {
            for (i = 0; i < M->s[p]; i++) Phi[count][i] = c[q][i] * c[r][i]; /* two leaves */
            vertices[count] = 3;
            target[count++] = 1. / 3;
            times(M, q, r, one, inner);
            times(M, p, q, inner, Phi[count]); /* a chain */
            vertices[count] = 3;
            target[count++] = 1. / 6;
        }
    return count;
}

/* b_j(theta) = sum_k d[j*power + k-1] theta^k of uniform order `order` for part p: sum_j d_jk Phi_j(t) = 1/gamma(t) where
   t has k vertices and 0 otherwise, and b(1) = b; the shortest solution.  Returns what is left over. */
static double dense_part(const method *M, int p, int order, int powers, double *d)
{
    enum { ROWS = TREES * (DENSE + 1) + MOST, COLUMNS = MOST * (DENSE + 1), WORK = 20000 };
    static double A[ROWS * COLUMNS], B[ROWS + COLUMNS], s[COLUMNS], work[WORK], Phi[TREES][MOST];
    static int iwork[WORK];
    const int n = M->s[p] * powers, one = 1, room = ROWS, tall = ROWS + COLUMNS, lwork = WORK;
    const double rcond = 1e-10;
    int vertices[TREES], rank, info, rows = 0, count, i, j, k;
    double target[TREES], left = 0;
    memset(A, 0, sizeof A);
    memset(B, 0, sizeof B);
    count = trees(M, p, order, Phi, vertices, target);
    for (i = 0; i < count; i++)
        for (k = 1; k <= powers; k++, rows++) {
            for (j = 0; j < M->s[p]; j++) A[(j * powers + k - 1) * ROWS + rows] = Phi[i][j];
            B[rows] = k == vertices[i] ? target[i] : 0;
        }
    for (j = 0; j < M->s[p]; j++, rows++) {
        for (k = 0; k < powers; k++) A[(j * powers + k) * ROWS + rows] = 1;
        B[rows] = M->b[p][j];
    }
    dgelsd_(&room, &n, &one, A, &room, B, &tall, s, &rcond, &rank, work, &lwork, iwork, &info);
    if (info != 0) return 1;
    memcpy(d, B, (size_t)n * sizeof *d);
    for (i = 0; i < count; i++)
        for (k = 1; k <= powers; k++) {
            double sum = k == vertices[i] ? -target[i] : 0;
            for (j = 0; j < M->s[p]; j++) sum += d[j * powers + k - 1] * Phi[i][j];
            left = fmax(left, fabs(sum));
        }
    for (j = 0; j < M->s[p]; j++) {
        double sum = -M->b[p][j];
        for (k = 0; k < powers; k++) sum += d[j * powers + k];
        left = fmax(left, fabs(sum));
    }
    return left;
}

static void weights(const method *M, int p, int powers, const double *d, double theta, double *b)
{
    int j, k;
    for (j = 0; j < M->s[p]; j++)
        for (b[j] = 0, k = powers - 1; k >= 0; k--) b[j] = (b[j] + d[j * powers + k]) * theta;
}

/* Proof of a dense output: A/theta and b(theta)/theta are a method again, whose step theta h ends inside ours. */
static int dense_order(const method *M, int powers, double d[2][MOST * (DENSE + 1)])
{
    static double A[4][MOST * MOST], b[2][MOST];
    const double *scaled[4], *inside[2];
    int order = 6, p, i, l;
    for (l = 1; l <= powers; l++) {
        const double theta = (double)l / (powers + 1);
        method T = *M;
        for (p = 0; p < 4; p++) {
            for (i = 0; i < M->s[p / 2] * M->s[p % 2]; i++) A[p][i] = M->A[p][i] / theta;
            scaled[p] = A[p];
        }
        for (p = 0; p < 2; p++) {
            weights(M, p, powers, d[p], theta, b[p]);
            for (i = 0; i < M->s[p]; i++) b[p][i] /= theta;
            inside[p] = b[p];
        }
        memcpy(T.A, scaled, sizeof scaled);
        i = order_of(&T, inside);
        if (i < order) order = i;
    }
    return order;
}

/* The dense output of the highest uniform order up to DENSE; its number of powers of theta, 0: none. */
static int dense(const method *M, int order, double d[2][MOST * (DENSE + 1)])
{
    int q, powers;
    for (q = order < DENSE ? order : DENSE; q >= 1; q--) {
        powers = q < order ? q + 1 : q;
        if (dense_part(M, E, q, powers, d[E]) < 1e-12 && dense_part(M, I, q, powers, d[I]) < 1e-12) return powers;
    }
    return 0;
}

/* ---- the problem ------------------------------------------------------------------------------------------------- */

static double G, w, e, m;

static void exact(double t, double *y)
{
    y[0] = sqrt(1 + cos(t) / 2);
    y[1] = sqrt(2 + cos(w * t));
}

static void f_explicit(double t, const double *y, double *k)
{
    k[0] = m * y[0] * y[0] - sin(t) / (4 * y[0]);
    k[1] = m * y[1] * y[1] - w * sin(w * t) / (2 * y[1]);
}

static void f_implicit(double t, const double *y, double *k)
{
    const double a = (y[0] * y[0] - 1 - cos(t) / 2) / (2 * y[0]), b = (y[1] * y[1] - 2 - cos(w * t)) / (2 * y[1]);
    k[0] = G * a + e * b - m * y[0] * y[0];
    k[1] = e * a - b - m * y[1] * y[1];
}

/* Z = z + g fI(t, Z) by Newton's method, in place; k = (Z - z)/g */
static void solve(double t, double g, double *z, double *k)
{
    const int n = N, one = 1;
    const double unit = 1;
    double base[N], J[N * N], r[N];
    int pivot[N], info, i;
    memcpy(base, z, sizeof base);
    for (i = 0; i < 20; i++) {
        const double da = 0.5 + (1 + cos(t) / 2) / (2 * z[0] * z[0]), db = 0.5 + (2 + cos(w * t)) / (2 * z[1] * z[1]);
        J[0] = 1 - g * (G * da - 2 * m * z[0]);
        J[1] = -g * e * da;
        J[2] = -g * e * db;
        J[3] = 1 + g * (db + 2 * m * z[1]);
        f_implicit(t, z, k);
        rk_combine(g, 1, &unit, N, base, k, N, r);
        r[0] -= z[0];
        r[1] -= z[1];
        dgesv_(&n, &one, J, &n, pivot, r, &n, &info);
        z[0] += r[0];
        z[1] += r[1];
        if (fabs(r[0]) + fabs(r[1]) < 1e-15) break;
    }
    for (i = 0; i < N; i++) k[i] = (z[i] - base[i]) / g;
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

typedef struct slopes {
    double k[2][N * MOST];
} slopes;

static void stages(const method *M, const int *list, double t, double h, const double *y, slopes *S)
{
    double z[N], row[MOST], g;
    int l, p, i, j;
    for (l = 0; l < M->s[E] + M->s[I]; l++) {
        double c = 0; /* time is one more unknown of the explicit part */
        p = list[l] / MOST;
        i = list[l] % MOST;
        for (j = 0; j < M->s[E]; j++) c += M->A[2 * p][i * M->s[E] + j];
        memcpy(row, M->A[2 * p + I] + i * M->s[I], (size_t)M->s[I] * sizeof *row);
        g = p == I ? h * row[i] : 0;
        if (p == I) row[i] = 0;
        rk_combine(h, M->s[E], M->A[2 * p] + i * M->s[E], N, y, S->k[E], N, z);
        rk_combine(h, M->s[I], row, N, z, S->k[I], N, z);
        if (p == E) f_explicit(t + c * h, z, S->k[E] + i * N);
        else if (g != 0) solve(t + c * h, g, z, S->k[I] + i * N);
        else f_implicit(t + c * h, z, S->k[I] + i * N);
    }
}

/* out = y + h sum b(E) kE + h sum b(I) kI, y NULL for none */
static void sum(const method *M, double h, const double *const *b, const double *y, const slopes *S, double *out)
{
    rk_combine(h, M->s[E], b[E], N, y, S->k[E], N, out);
    rk_combine(h, M->s[I], b[I], N, out, S->k[I], N, out);
}

static double off(double t, const double *y)
{
    double x[N];
    exact(t, x);
    return fmax(fabs(y[0] - x[0]), fabs(y[1] - x[1]));
}

/* The largest error of the dense output at 9 times of a step */
static double off_inside(const method *M, double t, double h, int powers, double d[2][MOST * (DENSE + 1)],
                         const double *y, const slopes *S)
{
    double v[N], b[2][MOST], worst = 0;
    const double *at[2];
    int l, p;
    for (l = 1; l < 10; l++) {
        for (p = 0; p < 2; p++) {
            weights(M, p, powers, d[p], l / 10., b[p]);
            at[p] = b[p];
        }
        sum(M, h, at, y, S, v);
        worst = fmax(worst, off(t + l / 10. * h, v));
    }
    return worst;
}

/* Steps of one size with weights b: the largest error at their ends, and inside by the dense output. */
static double fixed_steps(const method *M, const int *list, int steps, double end, const double *const *b, int powers,
                          double d[2][MOST * (DENSE + 1)], double *inside)
{
    const double h = end / steps;
    double y[N], worst = 0;
    slopes S;
    int j;
    memset(&S, 0, sizeof S);
    *inside = 0;
    exact(0, y);
    for (j = 0; j < steps; j++) {
        stages(M, list, j * h, h, y, &S);
        if (powers > 0) *inside = fmax(*inside, off_inside(M, j * h, h, powers, d, y, &S));
        sum(M, h, b, y, &S, y);
        worst = fmax(worst, off((j + 1) * h, y));
    }
    return worst;
}

/* An adaptive run by the pair: b - bhat for b, and no y */
static void adaptive(const method *M, const int *list, double end, double tolerance)
{
    double y[N], ynew[N], err[N], difference[2][MOST], norm[4], t = 0, h = 1e-3, worst = 0;
    const double *estimate[2];
    slopes S;
    rk_control C;
    int p, i, accepted = 0, rejected = 0, status;
    for (p = 0; p < 2; p++) {
        for (i = 0; i < M->s[p]; i++) difference[p][i] = M->b[p][i] - M->bhat[p][i];
        estimate[p] = difference[p];
    }
    memset(&S, 0, sizeof S);
    exact(0, y);
    rk_control_make(&C, "PI", rk_find("bs3"));
    C.order = M->order_hat;
    C.stop = end;
    while (t < end) {
        stages(M, list, t, h, y, &S);
        sum(M, h, M->b, y, &S, ynew);
        sum(M, h, estimate, NULL, &S, err);
        memset(norm, 0, sizeof norm);
        rk_norm(tolerance, tolerance, NULL, N, err, y, ynew, norm);
        status = rk_control_step(&C, rk_rms(norm), &t, &h);
        scene_check(status, rk_message(status));
        if (status == RK_REJECT) {
            rejected++;
            continue;
        }
        accepted++;
        memcpy(y, ynew, sizeof y);
        worst = fmax(worst, off(t, y));
    }
    printf("tolerance %-8g accepted %-5d rejected %-4d error %.3e\n", tolerance, accepted, rejected, worst);
}

static void report(const method *M, int steps, double end, int refinements, double tolerance)
{
    static double d[2][MOST * (DENSE + 1)];
    double error[3] = {0}, last[3] = {0};
    int list[2 * MOST], order = order_of(M, M->b), powers, uniform, r, l, columns = 3;
    printf("\n%s: %s\n", M->name, M->source);
    if (schedule(M, list) != M->s[E] + M->s[I]) {
        fprintf(stderr, "%s: stages that need each other's slopes cannot be computed one after the other\n", M->name);
        exit(2);
    }
    powers = dense(M, order, d);
    uniform = powers ? dense_order(M, powers, d) : 0;
    printf("stages %d explicit, %d implicit, in the order", M->s[E], M->s[I]);
    for (l = 0; l < M->s[E] + M->s[I]; l++) printf(" %c%d", list[l] < MOST ? 'E' : 'I', list[l] % MOST + 1);
    printf("\norder_by_trees %d\n", order);
    if (M->order_hat) printf("pair_by_trees %d\n", order_of(M, M->bhat));
    printf("dense_by_trees %d\n", uniform);
    if (order == 0) return;
    if (!M->order_hat) columns = 2;
    for (r = 0; r <= refinements; r++, steps *= 2) {
        double unused;
        error[0] = fixed_steps(M, list, steps, end, M->b, powers, d, error + 1);
        if (M->order_hat) error[2] = fixed_steps(M, list, steps, end, M->bhat, 0, d, &unused);
        printf("h %-9.3g", end / steps);
        for (l = 0; l < columns; l++) {
            static const char *const name[] = {"error", "inside", "pair"};
            printf(" %s %.3e", name[l], error[l]);
            if (r) printf(" (%.2f)", log2(last[l] / error[l]));
        }
        printf("\n");
        if (r == refinements) {
            printf("observed_order %.3f\nobserved_dense %.3f\n", log2(last[0] / error[0]), log2(last[1] / error[1]));
            if (M->order_hat) printf("observed_pair %.3f\n", log2(last[2] / error[2]));
        }
        memcpy(last, error, sizeof last);
    }
    if (tolerance > 0 && M->order_hat) adaptive(M, list, end, tolerance);
}

int main(int argc, char **argv)
{
    scene_option o[] = {
        {"method", "exim4", "sg2 exim3 exim4 ark2 ark3 ark4 ark5 ars443, or all"},
        {"file", "", "a method of your own: stages E I, order of the pair, A(E,E) A(E,I) A(I,E) A(I,I) b bhat"},
        {"steps", "40", "steps of the coarsest run"},
        {"refine", "4", "how often their number is doubled"},
        {"end", "2", "end time"},
        {"tolerance", "0", "an adaptive run by the pair after that, unless 0"},
        {"G", "-10", "stiffness"},
        {"w", "5", "frequency of v"},
        {"e", "0.5", "coupling"},
        {"m", "0.5", "what one part takes from the other"},
        {NULL, NULL, NULL}};
    static const char *const halves[][3] = {{"ark2", "ark2e", "ark2i"},
                                            {"ark3", "ark3e", "ark3i"},
                                            {"ark4", "ark4e", "ark4i"},
                                            {"ark5", "ark5e", "ark5i"},
                                            {"ars443", "ars443e", "ars443i"}};
    enum { PUBLISHED = sizeof published / sizeof *published, HALVES = sizeof halves / sizeof *halves };
    method all[PUBLISHED + HALVES], mine;
    const char *name;
    double end, tolerance;
    int i, steps, refinements, found = 0;
    scene_parse(argc, argv, "implicit-explicit methods with four tables: proof, pair, dense output, observed orders",
                o);
    name = scene_text(o, "method");
    steps = scene_integer(o, "steps", 1, 100000);
    refinements = scene_integer(o, "refine", 1, 10);
    end = scene_number(o, "end", 1e-3, 100);
    tolerance = scene_number(o, "tolerance", 0, 1);
    G = scene_perturbed("G", scene_number(o, "G", -1e6, 0));
    w = scene_number(o, "w", 0, 1e3);
    e = scene_number(o, "e", -1, 1);
    m = scene_number(o, "m", 0, 10);
    for (i = 0; i < PUBLISHED; i++) all[i] = published[i];
    for (i = 0; i < HALVES; i++)
        all[PUBLISHED + i] = of_halves(halves[i][0], rk_find(halves[i][1]), rk_find(halves[i][2]));
    if (*scene_text(o, "file")) {
        mine = from_file(scene_text(o, "file"));
        report(&mine, steps, end, refinements, tolerance);
        return 0;
    }
    for (i = 0; i < PUBLISHED + HALVES; i++) {
        if (strcmp(name, "all") != 0 && strcmp(name, all[i].name) != 0) continue;
        report(&all[i], steps, end, refinements, tolerance);
        found = 1;
    }
    if (found) return 0;
    fprintf(stderr, "--method %s is not one of %s\n", name, o[0].help);
    return 2;
}
