/* SPDX-License-Identifier: MIT

   opencl.c - iqn.h with vectors on a device: x, V and W never leave it

   H is one damped Jacobi sweep of -div((1 + 5 u^2) grad u) = 1, u = 0 on the edge of a square.  The
   core says which products it needs, the device forms all of them in one launch and adds them up
   in a second; the core gives weights, and a third launch stores the pair and writes the next x.
   Beside it iqn_step, for which x and H(x) travel. */
#define CL_TARGET_OPENCL_VERSION 120
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <CL/cl.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { GRID = 40, N = GRID * GRID, COLUMNS = 20, SLOTS = COLUMNS + 2, ITEMS = 256, STEPS = 400 };
#define MOST (IQN_DOTS + 2 * COLUMNS)

static const char *const source =
    "double at(global const double *u, int i, int j) {\n"
    "  return i < 0 || j < 0 || i == GRID || j == GRID ? 0 : u[i * GRID + j]; }\n"
    "kernel void sweep(global const double *u, global double *W, int now) {\n"
    "  int i = get_global_id(0), j = get_global_id(1);\n"
    "  double m = at(u, i, j), b[4] = {at(u, i + 1, j), at(u, i - 1, j), at(u, i, j + 1),\n"
    "         at(u, i, j - 1)}, sum = 1 / ((GRID + 1.) * (GRID + 1.)), all = 0;\n"
    "  for (int k = 0; k < 4; k++) { double c = 1 + 2.5 * (m * m + b[k] * b[k]);\n"
    "    sum += c * b[k]; all += c; }\n"
    "  W[now * N + i * GRID + j] = m + 0.9 * (sum - all * m) / all; }\n"
    /* V[now] = hx - x; partial sums of the products with slot = {now, base, pairs...} */
    "kernel void products(int pairs, global const int *slot, global const double *x,\n"
    "                     global double *V, global const double *W, global double *partial) {\n"
    "  int item = get_global_id(0), now = slot[0], base = slot[1], count = 6 + 2 * pairs;\n"
    "  double sum[MOST] = {0};\n"
    "  for (int i = item; i < N; i += ITEMS) {\n"
    "    double h = W[now * N + i], r = h - x[i], v = 0, s = 0;\n"
    "    V[now * N + i] = r; sum[0] += r * r; sum[1] += h * h;\n"
    "    if (base >= 0) { v = r - V[base * N + i]; s = (h - W[base * N + i]) - v; }\n"
    "    sum[2] += v * v; sum[3] += v * r; sum[4] += s * s; sum[5] += s * v;\n"
    "    for (int j = 0; j < pairs; j++) { double a = V[slot[2 + j] * N + i];\n"
    "      sum[6 + 2 * j] += a * r; sum[7 + 2 * j] += a * v; } }\n"
    "  for (int k = 0; k < count; k++) partial[k * ITEMS + item] = sum[k]; }\n"
    "kernel void add(global const double *partial, global double *dot) {\n"
    "  int k = get_global_id(0); dot[k] = 0;\n"
    "  for (int i = 0; i < ITEMS; i++) dot[k] += partial[k * ITEMS + i]; }\n"
    /* the pair, then x = sum of weight[s] V_s + weight[SLOTS + s] W_s */
    "kernel void combine(int now, int base, int store, global const double *weight,\n"
    "                    global double *V, global double *W, global double *x) {\n"
    "  for (int i = get_global_id(0); i < N; i += ITEMS) { double sum = 0;\n"
    "    if (store >= 0) { V[store * N + i] = V[now * N + i] - V[base * N + i];\n"
    "      W[store * N + i] = W[now * N + i] - W[base * N + i]; }\n"
    "    for (int s = 0; s < 2 * SLOTS; s++)\n"
    "      if (weight[s] != 0) sum += weight[s] * (s < SLOTS ? V : W)[s % SLOTS * N + i];\n"
    "    x[i] = sum; } }\n";

static cl_context context;
static cl_command_queue queue;
static cl_kernel sweep, products, add, combine;
static double launches, reductions, up, down; /* of a run; bytes to the device and from it */

static void check(int ok, const char *what)
{
    if (!ok) fprintf(stderr, "failed: %s\n", what), exit(1);
}

static void build(void)
{
    char options[128];
    cl_platform_id platform;
    cl_device_id device = NULL;
    cl_program p;
    cl_int e = clGetPlatformIDs(1, &platform, NULL);
    check(!e && !clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL), "no device");
    context = clCreateContext(NULL, 1, &device, NULL, NULL, &e);
    queue = clCreateCommandQueue(context, device, 0, &e);
    p = clCreateProgramWithSource(context, 1, (const char **)&source, NULL, &e);
    snprintf(options, sizeof options, "-DGRID=%d -DN=%d -DITEMS=%d -DSLOTS=%d -DMOST=%d", GRID, N,
             ITEMS, SLOTS, MOST);
    check(!clBuildProgram(p, 1, &device, options, NULL, NULL), "clBuildProgram");
    sweep = clCreateKernel(p, "sweep", &e), products = clCreateKernel(p, "products", &e);
    add = clCreateKernel(p, "add", &e), combine = clCreateKernel(p, "combine", &e);
}

static cl_mem buffer(size_t numbers, double *from)
{
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (from ? CL_MEM_COPY_HOST_PTR : 0);
    return clCreateBuffer(context, flags, numbers * sizeof *from, from, NULL);
}

/* Launches k on a x b items; `count` arguments follow, each as its size and its address. */
static void launch(cl_kernel k, size_t a, size_t b, cl_uint count, ...)
{
    const size_t items[2] = {a, b};
    cl_uint j;
    va_list list;
    va_start(list, count);
    for (j = 0; j < count; j++) {
        const size_t size = va_arg(list, size_t);
        check(!clSetKernelArg(k, j, size, va_arg(list, const void *)), "argument");
    }
    va_end(list);
    launches++;
    check(!clEnqueueNDRangeKernel(queue, k, 2, NULL, items, NULL, 0, NULL, NULL), "launch");
}

static void write(cl_mem m, size_t bytes, const void *from)
{
    up += (double)bytes;
    check(!clEnqueueWriteBuffer(queue, m, CL_TRUE, 0, bytes, from, 0, NULL, NULL), "write");
}

static void read(cl_mem m, size_t bytes, void *to)
{
    down += (double)bytes;
    check(!clEnqueueReadBuffer(queue, m, CL_TRUE, 0, bytes, to, 0, NULL, NULL), "read");
}

static iqn *make(ptrdiff_t n)
{
    const size_t bytes = iqn_size(n, COLUMNS, 1);
    iqn *q;
    launches = reductions = up = down = 0;
    check(iqn_make(&q, n, COLUMNS, 1, malloc(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_TOL_REDUCTION, 1e-8);
    iqn_set(q, IQN_MAX_ITERATIONS, STEPS);
    iqn_set(q, IQN_OMEGA, 1);
    return q;
}

/* A row of the table; H's own launches do not count.  Returns the iterations. */
static int row(const char *name, iqn *q)
{
    const double steps = iqn_get(q, IQN_ITERATIONS);
    check(iqn_converged(q) == 1, "no answer");
    printf("| %s | %.0f | %.0f | %.0f | %.0f | %.0f |\n", name, steps, up / steps, down / steps,
           launches / steps - 1, reductions / steps);
    return (int)steps;
}

#define P(variable) sizeof(variable), &variable /* an argument of a kernel */

static int on_device(double *u)
{
    cl_mem x = buffer(N, u), V = buffer(SLOTS * N, NULL), W = buffer(SLOTS * N, NULL),
           slots = buffer(SLOTS, NULL), partial = buffer(MOST * ITEMS, NULL),
           dots = buffer(MOST, NULL), weights = buffer(2 * SLOTS, NULL);
    double dot[MOST], weight[2 * SLOTS];
    int slot[SLOTS] = {0}, status, store, steps;
    iqn *q = make(IQN_HOST);
    do {
        const int pairs = iqn_ask(q, slot), count = IQN_DOTS + 2 * pairs;
        launch(sweep, GRID, GRID, 3, P(x), P(W), P(slot[0]));
        write(slots, (size_t)(2 + pairs) * sizeof *slot, slot);
        launch(products, ITEMS, 1, 6, P(pairs), P(slots), P(x), P(V), P(W), P(partial));
        launch(add, (size_t)count, 1, 2, P(partial), P(dots));
        read(dots, (size_t)count * sizeof *dot, dot);
        reductions++;
        status = iqn_weights(q, dot, weight, &store);
        check(status >= 0, iqn_message(status));
        write(weights, sizeof weight, weight);
        launch(combine, ITEMS, 1, 7, P(slot[0]), P(slot[1]), P(store), P(weights), P(V), P(W),
               P(x));
    } while (!iqn_converged(q));
    steps = row("core, vectors on the device", q);
    check(!clEnqueueReadBuffer(queue, x, CL_TRUE, 0, N * sizeof *u, u, 0, NULL, NULL), "answer");
    return steps;
}

static int on_host(double *u, double *hu)
{
    const int first = 0;
    cl_mem x = buffer(N, u), hx = buffer(N, NULL);
    iqn *q = make(N);
    do {
        write(x, N * sizeof *u, u);
        launch(sweep, GRID, GRID, 3, P(x), P(hx), P(first));
        read(hx, N * sizeof *u, hu);
        check(iqn_step(q, u, hu) >= 0, "iqn_step");
    } while (!iqn_converged(q));
    return row("iqn_step, vectors on the host", q);
}

int main(void)
{
    static double a[N], b[N], hb[N];
    double off = 0, size = 0;
    int i, steps[2];
    build();
    printf("| numbers: %d | iterations | bytes to the device a step | bytes from it | launches "
           "| reductions |\n|---|---|---|---|---|---|\n", N);
    steps[0] = on_device(a);
    check(launches <= 4.01 * steps[0] && up + down < 1000. * steps[0], "traffic");
    steps[1] = on_host(b, hb);
    for (i = 0; i < N; i++) off += (a[i] - b[i]) * (a[i] - b[i]), size += b[i] * b[i];
    printf("\ndifference %.1e\n", sqrt(off / size));
    return !(sqrt(off / size) < 1e-5 && abs(steps[0] - steps[1]) <= 2 + steps[1] / 10);
}
