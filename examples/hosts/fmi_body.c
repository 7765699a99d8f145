/* SPDX-License-Identifier: MIT

   fmi_body.c - a small FMU for co-simulation (FMI 3.0; the spring with -DFMI2 also 2.0), of five kinds:

       -DBODY=1  spring: m x" = F - k x - d x'            F in, a = x" and x out
       -DBODY=2  load:   y" = a,  F = -m a - k(t) y       a in, F out; k = 0, 30 from 1.234 on
       -DBODY=3  load:   y" = a,  F = -m a - p(t)         p = 0, 10 from 1.234 on
       -DBODY=4  load:   the same, p = 0, 5 from 1.234 on, 10 from 1.235 on
       -DBODY=5  controller: F = -10 x, sampled at 0, 0.1, 0.2 ...

   A load heavier than the body on the spring: an algebraic loop of gain -2.  Integrates by
   Runge-Kutta 4 in steps of its own and asks for its input at every stage (intermediate update). */
#include "fmi3.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* prototypes */
#define BODY_DECLARE3(result, name, arguments) result fmi3##name arguments;
#define BODY_DECLARE2(result, name, arguments) result fmi2##name arguments;
FMI3_FUNCTIONS(BODY_DECLARE3)
FMI3_GET_SET(BODY_DECLARE3, Float64, double)
FMI3_GET_SET(BODY_DECLARE3, Int32, int32_t)
#ifdef FMI2
FMI2_FUNCTIONS(BODY_DECLARE2)
FMI2_GET_SET(BODY_DECLARE2, Real, double)
#endif

enum { INPUT, OUTPUT, POSITION, VELOCITY };

static const double STEP = 0.004, NEVER = 1e300;

typedef struct body {
    double time, input, y[2];
    int engaged; /* events that have been: the second spring of the load, its force p, samples */
    fmi3Environment environment;
    fmi3Intermediate *update;
} body;

/* The next one */
static double event_time(const body *b)
{
#if BODY == 1
    return (void)b, NEVER;
#elif BODY == 4
    const double times[] = {1.234, 1.235, NEVER};
    return times[b->engaged];
#elif BODY == 5
    return 0.1 * b->engaged;
#else
    return b->engaged ? NEVER : 1.234;
#endif
}

static double output(const body *b)
{
#if BODY == 1
    return b->input - 4 * b->y[0] - 0.2 * b->y[1];
#elif BODY == 2
    return -2 * b->input - (b->engaged ? 30 : 0) * b->y[0];
#elif BODY == 5
    return b->y[0];
#else
    return -2 * b->input - (BODY == 4 ? 5 : 10) * b->engaged;
#endif
}

static double acceleration(const body *b)
{
#if BODY == 1
    return output(b);
#elif BODY == 5
    return (void)b, 0;
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
    b->y[0] = BODY != 5;
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
    while (!(b->time < event_time(b) - 1e-12)) {
        b->engaged++;
        if (BODY == 5) b->y[0] = -10 * b->input;
    }
    *again = *terminate = *nominals = *values = false;
    *has_next = event_time(b) < NEVER;
    *next = event_time(b);
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

fmi3Status fmi3GetInt32(fmi3Instance i, const fmi3Reference *r, size_t nr, int32_t *v, size_t nv)
{
    (void)r;
    if (nr != 1 || nv != 1) return fmi3Error;
    v[0] = ((const body *)i)->engaged;
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
    const bool stops = t < event_time(b) && t + h >= event_time(b);
    const double end = stops ? event_time(b) : t + h;
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

#ifdef FMI2 /* the same body, without events */
fmi3Instance fmi2Instantiate(const char *name, int kind, const char *token, const char *resources, const fmi2Callbacks *callbacks,
                             int visible, int logging)
{
    (void)kind, (void)callbacks, (void)visible, (void)logging;
    return fmi3InstantiateCoSimulation(name, token, resources, false, false, false, false, NULL, 0, NULL, NULL, NULL);
}

fmi3Status fmi2SetupExperiment(fmi3Instance i, int has_tolerance, double tolerance, double start, int has_stop, double stop)
{
    return fmi3EnterInitializationMode(i, has_tolerance, tolerance, start, has_stop, stop);
}

fmi3Status fmi2EnterInitializationMode(fmi3Instance i) { return i ? fmi3OK : fmi3Error; }
fmi3Status fmi2ExitInitializationMode(fmi3Instance i) { return i ? fmi3OK : fmi3Error; }
fmi3Status fmi2Terminate(fmi3Instance i) { return i ? fmi3OK : fmi3Error; }
void fmi2FreeInstance(fmi3Instance i) { fmi3FreeInstance(i); }
fmi3Status fmi2GetReal(fmi3Instance i, const fmi3Reference *r, size_t n, double *v) { return fmi3GetFloat64(i, r, n, v, n); }
fmi3Status fmi2SetReal(fmi3Instance i, const fmi3Reference *r, size_t n, const double *v) { return fmi3SetFloat64(i, r, n, v, n); }
fmi3Status fmi2GetFMUstate(fmi3Instance i, fmi3State *s) { return fmi3GetFMUState(i, s); }
fmi3Status fmi2SetFMUstate(fmi3Instance i, fmi3State s) { return fmi3SetFMUState(i, s); }
fmi3Status fmi2FreeFMUstate(fmi3Instance i, fmi3State *s) { return fmi3FreeFMUState(i, s); }

fmi3Status fmi2DoStep(fmi3Instance i, double t, double h, int no_return_before_t)
{
    bool event, terminate, early;
    double reached;
    return fmi3DoStep(i, t, h, no_return_before_t, &event, &terminate, &early, &reached);
}
#endif
