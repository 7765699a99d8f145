/* SPDX-License-Identifier: MIT

   peer_sundials.h - which SUNDIALS this is: its version, and whether its loops were compiled with optimisation          */
#ifndef PEER_SUNDIALS_H
#define PEER_SUNDIALS_H

#include "bench.h"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_version.h>

/* A dot product of 4000 numbers, over a loop with one sum: 1 where both are optimised, 2 and more where only ours is. */
static double sundials_slowness(SUNContext context)
{
    enum { N = 4000, TIMES = 50 };
    N_Vector v = N_VNew_Serial(N, context);
    const double *p = N_VGetArrayPointer(v);
    double least[2] = {1, 1}, t;
    volatile double sink;
    int k, i;
    N_VConst(1, v);
    for (k = 0; k < TIMES; k++) {
        double s = 0;
        t = bench_clock(0);
        for (i = 0; i < N; i++) s += p[i] * p[i];
        sink = s;
        t = bench_clock(0) - t;
        if (t < least[0]) least[0] = t;
        t = bench_clock(0);
        sink = N_VDotProd(v, v);
        t = bench_clock(0) - t;
        if (t < least[1]) least[1] = t;
    }
    (void)sink;
    N_VDestroy(v);
    return least[1] / least[0];
}

static const char *sundials_name(const char *part, SUNContext context)
{
    static char name[80];
    char version[32] = "";
    SUNDIALSGetVersion(version, 31);
    snprintf(name, sizeof name, "%s %s, %s", part, version,
             sundials_slowness(context) > 1.7 ? "compiled without optimisation" : "optimised");
    return name;
}

#endif
