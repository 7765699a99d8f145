/* SPDX-License-Identifier: MIT

   fmi_body.c - a small FMU for co-simulation (FMI 3.0), of three kinds:

       -DBODY=1  spring: m x" = F - k x - d x'            F in, a = x" out
       -DBODY=2  load:   y" = a,  F = -m a - k(t) y       a in, F out; k = 0, 30 from 1.234 on
       -DBODY=3  load:   y" = a,  F = -m a - p(t)         p = 0, 10 from 1.234 on

   A load heavier than the body on the spring: an algebraic loop of gain -2.  Integrates by
   Runge-Kutta 4 in steps of its own and asks for its input at every stage (intermediate update). */
#include "fmi3.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INPUT, OUTPUT, POSITION, VELOCITY };

static const double EVENT = 1.234, STEP = 0.004;

typedef struct body {
    double time, input, y[2];
    int engaged; /* the second spring of the load, or its force p */
    fmi3Environment environment;
    fmi3Intermediate *update;
} body;

static double output(const body *b)
{
#if BODY == 1
    return b->input - 4 * b->y[0] - 0.2 * b->y[1];
#elif BODY == 2
    return -2 * b->input - (b->engaged ? 30 : 0) * b->y[0];
#else
    return -2 * b->input - (b->engaged ? 10 : 0);
#endif
}

static double acceleration(const body *b)
{
#if BODY == 1
    return output(b);
#else
    return b->input;
#endif
}

static void ask(body *b, double t)
{
    bool early = false;
    double when = t;
    if (b->update) b->update(b->environment, t, true, false, false, false, &early, &when);
}

static void step(body *b, double h)
{
    const double t = b->time, y[2] = {b->y[0], b->y[1]}, c[4] = {0, 0.5, 0.5, 1};
    double k[4][2];
    int i, j;
    for (i = 0; i < 4; i++) {
        for (j = 0; j < 2; j++) b->y[j] = y[j] + (i > 0 ? c[i] * h * k[i - 1][j] : 0);
        if (i != 2) ask(b, t + c[i] * h);
        k[i][0] = b->y[1];
        k[i][1] = acceleration(b);
    }
    for (j = 0; j < 2; j++) b->y[j] = y[j] + h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
    b->time = t + h;
}

fmi3Instance fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                         bool logging, bool event_mode, bool early_return,
                                         const fmi3Reference *intermediate, size_t count, fmi3Environment environment,
                                         fmi3Log *log, fmi3Intermediate *update)
{
    body *b = (body *)calloc(1, sizeof *b);
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)intermediate;
    (void)count, (void)log;
    if (!b || (BODY != 1 && !(event_mode && early_return))) return free(b), NULL;
    b->environment = environment;
    b->update = update;
    b->y[0] = 1;
    return b;
}

void fmi3FreeInstance(fmi3Instance i)
{
    free(i);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance i, bool has_tolerance, double tolerance, double start,
                                       bool has_stop, double stop)
{
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    ((body *)i)->time = start;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance i)
{
    return i ? fmi3OK : fmi3Error;
}

fmi3Status fmi3EnterEventMode(fmi3Instance i)
{
    return i ? fmi3OK : fmi3Error;
}

fmi3Status fmi3EnterStepMode(fmi3Instance i)
{
    return i ? fmi3OK : fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, bool *again, bool *terminate, bool *nominals, bool *values,
                                    bool *has_next, double *next)
{
    body *b = (body *)i;
    if (BODY != 1 && !(b->time < EVENT)) b->engaged = 1;
    *again = *terminate = *nominals = *values = false;
    *has_next = BODY != 1 && !b->engaged;
    *next = EVENT;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance i)
{
    return i ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance i, const fmi3Reference *r, size_t nr, double *v, size_t nv)
{
    const body *b = (const body *)i;
    size_t j;
    if (nr != nv) return fmi3Error;
    for (j = 0; j < nr; j++) {
        if (r[j] > VELOCITY) return fmi3Error;
        if (r[j] == INPUT) v[j] = b->input;
        else v[j] = r[j] == OUTPUT ? output(b) : b->y[r[j] - POSITION];
    }
    return fmi3OK;
}

fmi3Status fmi3SetFloat64(fmi3Instance i, const fmi3Reference *r, size_t nr, const double *v, size_t nv)
{
    if (nr != 1 || nv != 1 || r[0] != INPUT) return fmi3Error;
    ((body *)i)->input = v[0];
    return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3State *s)
{
    if (!*s) *s = malloc(sizeof(body));
    if (!*s) return fmi3Error;
    memcpy(*s, i, sizeof(body));
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3State s)
{
    memcpy(i, s, sizeof(body));
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3State *s)
{
    (void)i;
    free(*s);
    *s = NULL;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance i, double t, double h, bool no_return_before_t, bool *event, bool *terminate,
                      bool *early, double *reached)
{
    body *b = (body *)i;
    const bool stops = BODY != 1 && !b->engaged && t < EVENT && t + h >= EVENT;
    const double end = stops ? EVENT : t + h;
    const int count = (int)ceil((end - t) / STEP);
    int j;
    (void)no_return_before_t;
    b->time = t;
    for (j = 0; j < count; j++) step(b, (end - b->time) / (count - j));
    b->time = end;
    ask(b, end); /* the output belongs to the input there */
    *event = stops;
    *terminate = false;
    *early = stops && end < t + h;
    *reached = end;
    return fmi3OK;
}
