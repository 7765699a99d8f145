/* SPDX-License-Identifier: MIT

   opencl.c - iqn.h with vectors on a device: x, V and W never leave it

   H is one damped Jacobi sweep of -div((1 + 5 u^2) grad u) = 1, u = 0 on the edge of a square;
   quasi-Newton makes a solver of it.  The core says which products it needs, the device forms all
   of them in one launch and adds them up in a second; the core gives weights, and a third launch
   stores the pair and writes the next x.  Beside it iqn_step on arrays of the host. */
#define CL_TARGET_OPENCL_VERSION 120
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <CL/cl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { GRID = 40, N = GRID * GRID, COLUMNS = 20, SLOTS = COLUMNS + 2, ITEMS = 256, STEPS = 400 };
#define MOST (IQN_DOTS + 2 * COLUMNS)

static const char *const source =
    "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n"
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
    "  double sum[MOST];\n"
    "  for (int k = 0; k < count; k++) sum[k] = 0;\n"
    "  for (int i = item; i < N; i += ITEMS) {\n"
    "    double h = W[now * N + i], r = h - x[i], v = 0, s = 0;\n"
    "    V[now * N + i] = r; sum[0] += r * r; sum[1] += h * h;\n"
    "    if (base >= 0) { v = r - V[base * N + i]; s = (h - W[base * N + i]) - v; }\n"
    "    sum[2] += v * v; sum[3] += v * r; sum[4] += s * s; sum[5] += s * v;\n"
    "    for (int j = 0; j < pairs; j++) { double a = V[slot[2 + j] * N + i];\n"
    "      sum[6 + 2 * j] += a * r; sum[7 + 2 * j] += a * v; } }\n"
    "  for (int k = 0; k < count; k++) partial[k * ITEMS + item] = sum[k]; }\n"
    "kernel void add(global const double *partial, global double *dot) {\n"
    "  int k = get_global_id(0); double sum = 0;\n"
    "  for (int i = 0; i < ITEMS; i++) sum += partial[k * ITEMS + i];\n"
    "  dot[k] = sum; }\n"
    /* the pair, then x = sum of weight[s] V_s + weight[SLOTS + s] W_s */
    "kernel void combine(int now, int base, int store, global const double *weight,\n"
    "                    global double *V, global double *W, global double *x) {\n"
    "  for (int i = get_global_id(0); i < N; i += ITEMS) { double sum = 0;\n"
    "    if (store >= 0) { double v = V[now * N + i] - V[base * N + i];\n"
    "      double w = W[now * N + i] - W[base * N + i];\n"
    "      V[store * N + i] = v; W[store * N + i] = w; }\n"
    "    for (int s = 0; s < SLOTS; s++) {\n"
    "      if (weight[s] != 0) sum += weight[s] * V[s * N + i];\n"
    "      if (weight[SLOTS + s] != 0) sum += weight[SLOTS + s] * W[s * N + i]; }\n"
    "    x[i] = sum; } }\n";

static void check(int ok, const char *what)
{
    if (ok) return;
    fprintf(stderr, "failed: %s\n", what);
    exit(1);
}

static cl_context context;
static cl_device_id device;
static cl_command_queue queue;
static int launches;
static size_t up, down;

static cl_mem buffer(size_t numbers)
{
    const double zero = 0;
    cl_int e;
    cl_mem m = clCreateBuffer(context, CL_MEM_READ_WRITE, numbers * sizeof(double), NULL, &e);
    check(e == CL_SUCCESS, "clCreateBuffer");
    clEnqueueFillBuffer(queue, m, &zero, sizeof zero, 0, numbers * sizeof zero, 0, NULL, NULL);
    return m;
}

static void launch(cl_kernel k, cl_uint dimensions, size_t a, size_t b)
{
    const size_t size[2] = {a, b};
    check(clEnqueueNDRangeKernel(queue, k, dimensions, NULL, size, NULL, 0, NULL, NULL) == CL_SUCCESS, "launch");
    launches++;
}

static void argument(cl_kernel k, cl_uint position, size_t size, const void *value)
{
    check(clSetKernelArg(k, position, size, value) == CL_SUCCESS, "argument");
}

static void write(cl_mem m, size_t bytes, const void *from)
{
    clEnqueueWriteBuffer(queue, m, CL_TRUE, 0, bytes, from, 0, NULL, NULL);
    up += bytes;
}

static cl_program build(void)
{
    char options[128];
    cl_platform_id platform;
    cl_int e;
    cl_program p;
    if (clGetPlatformIDs(1, &platform, NULL) != CL_SUCCESS) check(0, "no OpenCL platform");
    check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL) == CL_SUCCESS, "device");
    context = clCreateContext(NULL, 1, &device, NULL, NULL, &e);
    queue = clCreateCommandQueue(context, device, 0, &e);
    p = clCreateProgramWithSource(context, 1, (const char **)&source, NULL, &e);
    snprintf(options, sizeof options, "-DGRID=%d -DN=%d -DITEMS=%d -DSLOTS=%d -DMOST=%d", GRID, N, ITEMS, SLOTS, MOST);
    check(clBuildProgram(p, 1, &device, options, NULL, NULL) == CL_SUCCESS, "clBuildProgram");
    return p;
}

static iqn *make(ptrdiff_t n)
{
    const size_t bytes = iqn_size(n, COLUMNS, 1);
    iqn *q;
    check(iqn_make(&q, n, COLUMNS, 1, malloc(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_TOL_REDUCTION, 1e-8);
    iqn_set(q, IQN_MAX_ITERATIONS, STEPS);
    iqn_set(q, IQN_OMEGA, 1);
    return q;
}

/* The solution into u; returns the iterations. */
static int on_device(cl_program p, double *u)
{
    cl_kernel sweep = clCreateKernel(p, "sweep", NULL), products = clCreateKernel(p, "products", NULL);
    cl_kernel add = clCreateKernel(p, "add", NULL), combine = clCreateKernel(p, "combine", NULL);
    cl_mem x = buffer(N), V = buffer((size_t)SLOTS * N), W = buffer((size_t)SLOTS * N), partial = buffer(MOST * ITEMS);
    cl_mem dots = buffer(MOST), weights = buffer(2 * SLOTS), slots = buffer(SLOTS);
    double dot[MOST], weight[2 * SLOTS];
    int slot[SLOTS] = {0}, status, store, k;
    iqn *q = make(IQN_HOST);
    do {
        const int pairs = iqn_ask(q, slot), count = IQN_DOTS + 2 * pairs;
        argument(sweep, 0, sizeof x, &x), argument(sweep, 1, sizeof W, &W), argument(sweep, 2, sizeof(int), &slot[0]);
        launch(sweep, 2, GRID, GRID);
        launches--; /* H's own */
        write(slots, (size_t)(2 + pairs) * sizeof(int), slot);
        argument(products, 0, sizeof(int), &pairs), argument(products, 1, sizeof slots, &slots);
        argument(products, 2, sizeof x, &x), argument(products, 3, sizeof V, &V);
        argument(products, 4, sizeof W, &W), argument(products, 5, sizeof partial, &partial);
        launch(products, 1, ITEMS, 1);
        argument(add, 0, sizeof partial, &partial), argument(add, 1, sizeof dots, &dots);
        launch(add, 1, (size_t)count, 1);
        clEnqueueReadBuffer(queue, dots, CL_TRUE, 0, (size_t)count * sizeof *dot, dot, 0, NULL, NULL);
        down += (size_t)count * sizeof *dot;
        status = iqn_weights(q, dot, weight, &store);
        check(status >= 0, iqn_message(status));
        write(weights, sizeof weight, weight);
        for (k = 0; k < 2; k++) argument(combine, (cl_uint)k, sizeof(int), &slot[k]);
        argument(combine, 2, sizeof(int), &store), argument(combine, 3, sizeof weights, &weights);
        argument(combine, 4, sizeof V, &V), argument(combine, 5, sizeof W, &W), argument(combine, 6, sizeof x, &x);
        launch(combine, 1, ITEMS, 1);
    } while (!iqn_converged(q));
    check(iqn_converged(q) == 1, "no answer on the device");
    clEnqueueReadBuffer(queue, x, CL_TRUE, 0, N * sizeof(double), u, 0, NULL, NULL);
    return (int)iqn_get(q, IQN_ITERATIONS);
}

static double at(const double *u, int i, int j)
{
    return i < 0 || j < 0 || i == GRID || j == GRID ? 0 : u[i * GRID + j];
}

static int on_host(double *u, double *hu)
{
    iqn *q = make(N);
    int i, j, k;
    do {
        for (i = 0; i < GRID; i++)
            for (j = 0; j < GRID; j++) {
                const double m = at(u, i, j),
                             b[4] = {at(u, i + 1, j), at(u, i - 1, j), at(u, i, j + 1), at(u, i, j - 1)};
                double sum = 1 / ((GRID + 1.) * (GRID + 1.)), all = 0;
                for (k = 0; k < 4; k++) {
                    const double c = 1 + 2.5 * (m * m + b[k] * b[k]);
                    sum += c * b[k], all += c;
                }
                hu[i * GRID + j] = m + 0.9 * (sum - all * m) / all;
            }
        check(iqn_step(q, u, hu) >= 0, "iqn_step");
    } while (!iqn_converged(q));
    check(iqn_converged(q) == 1, "no answer on the host");
    return (int)iqn_get(q, IQN_ITERATIONS);
}

int main(void)
{
    static double a[N], b[N], hb[N];
    const int device_steps = on_device(build(), a), host_steps = on_host(b, hb);
    double off = 0, size = 0;
    int i;
    for (i = 0; i < N; i++) off += (a[i] - b[i]) * (a[i] - b[i]), size += b[i] * b[i];
    printf("| | iterations | launches a step | bytes up | bytes down | sums a step "
           "|\n|---|---|---|---|---|---|\n");
    printf("| device | %d | %.0f | %.0f | %.0f | 1 |\n", device_steps, (double)launches / device_steps,
           (double)up / device_steps, (double)down / device_steps);
    printf("| iqn_step | %d | | | | |\n\ndifference %.1e\n", host_steps, sqrt(off / size));
    check(sqrt(off / size) < 1e-5, "the answers differ");
    check(abs(device_steps - host_steps) <= 2 + host_steps / 10, "the iterations differ");
    check(launches == 3 * device_steps && up + down < 1024 * (size_t)device_steps, "traffic");
    return 0;
}
