/* SPDX-License-Identifier: MIT

   leaves.h - what surrounds the leaves of examples/page/tree.txt, so that each runs: two windows of a waveform, a fixed
   point that has made a step, one on vectors of the host, a step of Runge-Kutta.  A call that returns a status < 0 ends the
   program with its sentence. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"
#include "rk.h"
#include <stdio.h>
#include <stdlib.h>

enum { n = 4, n0 = 2, steps = 4, columns = 64 };

static double mem[1 << 20], mem_force[20000], mem_other[20000], mem_q[40000], mem_core[20000];
static double x[n], hx[n], v[n], t[steps], t_next[steps], dot[100], weight[100], estimate[16], sum[2], y[n], k[RK_STAGES_MAX * n];
static double t0, t1, h;
static int slot[100], status, pairs, store, history, j;
static void *ctx;
static wf *w, *other, *force;
static iqn *q, *core;
static const rk_table *T;
static const rk_coupling *G;
static rk_control C;
static rk_step step;
static const char *leaf;

static int ok(int value)
{
    const char *sentence = rk_message(value);
    if (value >= 0) return value;
    if (value > -300) sentence = iqn_message(value);
    if (value > -200) sentence = wf_message(value);
    printf("%s: status %d: %s\n", leaf, value, sentence);
    exit(1);
    return 0;
}

#define wf_make(...) ok(wf_make(__VA_ARGS__))
#define wf_push(...) ok(wf_push(__VA_ARGS__))
#define wf_begin(...) ok(wf_begin(__VA_ARGS__))
#define wf_read(...) ok(wf_read(__VA_ARGS__))
#define wf_mean(...) ok(wf_mean(__VA_ARGS__))
#define wf_advance(...) ok(wf_advance(__VA_ARGS__))
#define wf_rollback(...) ok(wf_rollback(__VA_ARGS__))
#define wf_restrict(...) ok(wf_restrict(__VA_ARGS__))
#define wf_strict(...) ok(wf_strict(__VA_ARGS__))
#define wf_monotone(...) ok(wf_monotone(__VA_ARGS__))
#define wf_error(...) ok(wf_error(__VA_ARGS__))
#define wf_choose(...) ok(wf_choose(__VA_ARGS__))
#define iqn_make(...) ok(iqn_make(__VA_ARGS__))
#define iqn_set(...) ok(iqn_set(__VA_ARGS__))
#define iqn_set_block(...) ok(iqn_set_block(__VA_ARGS__))
#define iqn_set_sum(...) ok(iqn_set_sum(__VA_ARGS__))
#define iqn_step(...) ok(iqn_step(__VA_ARGS__))
#define iqn_halve(...) ok(iqn_halve(__VA_ARGS__))
#define iqn_best(...) ok(iqn_best(__VA_ARGS__))
#define iqn_commit(...) ok(iqn_commit(__VA_ARGS__))
#define iqn_discard(...) ok(iqn_discard(__VA_ARGS__))
#define iqn_ask(...) ok(iqn_ask(__VA_ARGS__))
#define iqn_weights(...) ok(iqn_weights(__VA_ARGS__))
#define rk_control_make(...) ok(rk_control_make(__VA_ARGS__))
#define rk_control_stop(...) ok(rk_control_stop(__VA_ARGS__))
#define rk_control_step(...) ok(rk_control_step(__VA_ARGS__))
#define rk_stage(...) ok(rk_stage(__VA_ARGS__))
#define rk_dense(...) ok(rk_dense(__VA_ARGS__))

/* The answer is 2 in each number. */
static void H(const double *in, double *out)
{
    int i;
    for (i = 0; i < n; i++) out[i] = 2 + 0.1 * (i + 1) * (in[(i + 1) % n] - 2);
}

static int sum_over_ranks(double *numbers, int count, void *context)
{
    (void)numbers;
    (void)count;
    (void)context;
    return 0;
}

static void fill(wf *to)
{
    int column, i;
    for (column = 0; column < wf_columns(to); column++)
        for (i = 0; i < n; i++) wf_column(to, column)[i] = sin(wf_time(to, column) + i);
}

static void times(double from)
{
    int i;
    for (i = 0; i < steps; i++) {
        t[i] = from + (i + 1) * h;
        t_next[i] = t[i] + steps * h;
    }
}

/* A window of four sub-steps is over, the next one has been written. */
static void waveforms(void)
{
    wf *const both[2] = {w, force};
    int i;
    for (i = 0; i < 2; i++) {
        times(0);
        wf_push(both[i], 0, 0);
        wf_begin(both[i], 0, steps, t, 0);
        wf_advance(both[i], steps);
        times(t0);
        wf_begin(both[i], 0, steps, t, 0);
        fill(both[i]);
    }
    t1 = t0 + steps * h;
}

static void begin(const char *name)
{
    int i;
    leaf = name;
    h = 0.25;
    t0 = steps * h;
    wf_make(&w, n, 3, columns, mem, sizeof mem);
    wf_make(&force, n, 3, columns, mem_force, sizeof mem_force);
    wf_make(&other, 0, 5, columns, mem_other, sizeof mem_other);
    waveforms();
    iqn_make(&q, n, 20, 1, mem_q, sizeof mem_q);
    iqn_make(&core, IQN_HOST, 20, 1, mem_core, sizeof mem_core);
    for (i = 0; i < n; i++) x[i] = 1;
    for (i = 0; i < IQN_DOTS; i++) dot[i] = 1;
    H(x, hx);
    iqn_step(q, x, hx);
    T = rk_find("dp5");
    for (i = 0; i < n; i++) y[i] = k[i] = 1;
    step.T = T;
    step.h = h;
    step.n = step.ldk = n;
    step.y = y;
    step.k = k;
    sum[0] = sum[1] = 1;
    G = NULL;
}

static void end(void)
{
    if (T) return;
    printf("%s: no such table\n", leaf);
    exit(1);
}
