/* SPDX-License-Identifier: MIT

   numbers.c - iqn.h with vectors of any type of number: the core decides, these loops keep them

       cc -DNUMBER=float numbers.c -lm       cc -DCOMPLEX -DNUMBER="double complex" numbers.c -lm

   real     Chandrasekhar's H equation: x(t) = 1 / (1 - c/2 int t / (t + u) x(u) du), c = 0.99
   complex  a wave behind a lens (Lippmann and Schwinger): x(t) = exp(ikt) + ik int q exp(ik|t-u|) x

   Beside it the same problem in double with iqn_step; a complex number is two real ones there. */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifndef NUMBER
#  define NUMBER float
#endif
#define TEXT(x) #x
#define NAME(x) TEXT(x)
#ifdef COMPLEX
enum { PARTS = 2 };
#else
enum { PARTS = 1 };
#endif
typedef NUMBER number;
typedef double complex wide;

enum { N = 400, COLUMNS = 40, SLOTS = COLUMNS + 2 };
static number V[SLOTS][N], W[SLOTS][N], x[N], v[N], s[N];
static double y[2 * N], hy[2 * N];

/* Row i of H at x, given in any type through get(i). */
static wide row(int i, wide (*get)(int))
{
    const double t = (i + 0.5) / N, k = 20;
    wide sum = 0;
    int j;
    for (j = 0; j < N; j++) {
        const double u = (j + 0.5) / N;
#ifdef COMPLEX
        const double lens = exp(-40 * (u - 0.5) * (u - 0.5));
        sum += 0.5 * (wide)I * k / N * lens * cexp((wide)I * k * fabs(t - u)) * get(j);
#else
        sum += 0.99 / 2 / N * t / (t + u) * get(j);
#endif
    }
#ifdef COMPLEX
    return cexp((wide)I * k * t) + sum;
#else
    (void)k;
    return 1 / (1 - sum);
#endif
}

static wide get_x(int i)
{
    return (wide)x[i];
}

static wide get_y(int i)
{
    return PARTS == 2 ? y[2 * i] + (wide)I * y[2 * i + 1] : y[i];
}

/* ---- a step of the core ---- */

static long products; /* of all steps */

static double product(const number *a, const number *b) /* Re <a, b>, summed in double */
{
    double sum = 0;
    int i;
    for (i = 0; i < N; i++) sum += creal(conj((wide)a[i]) * (wide)b[i]);
    products++;
    return sum;
}

static void form_products(int now, int base, int pairs, const int *pair, double *dot)
{
    int i, j;
    dot[IQN_DOT_RR] = product(V[now], V[now]);
    dot[IQN_DOT_HH] = product(W[now], W[now]);
    for (i = 0; i < N && base >= 0; i++) {
        v[i] = V[now][i] - V[base][i];
        s[i] = W[now][i] - W[base][i] - v[i];
    }
    dot[IQN_DOT_VV] = product(v, v);
    dot[IQN_DOT_VR] = product(v, V[now]);
    dot[IQN_DOT_SS] = product(s, s);
    dot[IQN_DOT_SV] = product(s, v);
    for (j = 0; j < pairs; j++) {
        dot[IQN_DOTS + 2 * j] = product(V[pair[j]], V[now]);
        dot[IQN_DOTS + 2 * j + 1] = product(V[pair[j]], v);
    }
}

static int step(iqn *q)
{
    double dot[IQN_DOTS + 2 * COLUMNS] = {0}, weight[2 * SLOTS];
    int slot[SLOTS], i, j, status, store;
    const int pairs = iqn_ask(q, slot), now = slot[0], base = slot[1];
    for (i = 0; i < N; i++) W[now][i] = (number)row(i, get_x);
    for (i = 0; i < N; i++) V[now][i] = W[now][i] - x[i];
    form_products(now, base, pairs, slot + 2, dot);
    status = iqn_weights(q, dot, weight, &store);
    for (i = 0; i < N && status >= 0; i++) {
        wide sum = 0;
        if (store >= 0) {
            const number w = W[now][i] - W[base][i];
            V[store][i] = v[i];
            W[store][i] = w;
        }
        for (j = 0; j < SLOTS; j++)
            sum += weight[j] * (wide)V[j][i] + weight[SLOTS + j] * (wide)W[j][i];
        x[i] = (number)sum;
    }
    return status;
}

static int flat_step(iqn *q)
{
    int i;
    for (i = 0; i < N; i++) {
        const wide h = row(i, get_y);
        hy[PARTS * i] = creal(h);
        if (PARTS == 2) hy[2 * i + 1] = cimag(h);
    }
    return iqn_step(q, y, hy);
}

static int solve(ptrdiff_t n, int (*one)(iqn *), double limit, size_t *bytes)
{
    const int single = n == IQN_HOST && sizeof(number) / PARTS == sizeof(float);
    iqn *q;
    int status = 0, k = 0;
    *bytes = iqn_size(n, COLUMNS, 1);
    if (iqn_make(&q, n, COLUMNS, 1, malloc(*bytes), *bytes) < 0) exit(1);
    iqn_set(q, IQN_TOL_REDUCTION, limit);
    if (single) iqn_set(q, IQN_NOISE_LEVEL, 1e-7);
    while (status >= 0 && !iqn_converged(q) && k++ < 100) status = one(q);
    if (status < 0 || iqn_converged(q) != 1) puts(iqn_message(status)), exit(1);
    free(q);
    return k;
}

int main(void)
{
    const double limit = sizeof(number) / PARTS == sizeof(float) ? 1e-5 : 1e-10;
    size_t core, flat;
    const int mine = solve(IQN_HOST, step, limit, &core);
    const int theirs = solve(PARTS * N, flat_step, limit, &flat);
    double off = 0;
    int i;
    for (i = 0; i < N; i++) off = fmax(off, cabs(get_x(i) - get_y(i)) / cabs(get_y(i)));
    printf("| numbers | iterations | iqn_step, double | difference | products a step | kB of the "
           "core | kB of vectors | kB of iqn_step |\n|---|---|---|---|---|---|---|---|\n");
    printf("| " NAME(NUMBER) " | %d | %d | %.1e | %.1f | %.0f | %.0f | %.0f |\n", mine, theirs, off,
           (double)products / mine, (double)core / 1e3, (double)(sizeof V + sizeof W) / 1e3,
           (double)flat / 1e3);
    return !(abs(mine - theirs) <= 1 && off < 20 * limit);
}
