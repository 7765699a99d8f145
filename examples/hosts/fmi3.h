/* SPDX-License-Identifier: MIT

   fmi3.h - the part of the FMI 3.0 C interface that fmi.c and fmi_body.c use, typed from the
   standard (fmi-standard.org, 2.2, 4.2); a host that has the official headers takes those */
#ifndef FMI3_H
#define FMI3_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void *fmi3Instance, *fmi3Environment, *fmi3State;
typedef uint32_t fmi3Reference;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef void fmi3Log(fmi3Environment, fmi3Status, const char *category, const char *message);
typedef void fmi3Intermediate(fmi3Environment, double time, bool set_requested, bool get_allowed, bool step_finished,
                              bool can_return_early, bool *return_early, double *return_time);

/* X(result, name, arguments): every function of the interface that is called, once */
#define FMI3_FUNCTIONS(X)                                                                                              \
  X(fmi3Instance, InstantiateCoSimulation,                                                                             \
    (const char *name, const char *token, const char *resources, bool visible, bool logging, bool event_mode,          \
     bool early_return, const fmi3Reference *intermediate, size_t count, fmi3Environment environment, fmi3Log *log,    \
     fmi3Intermediate *update))                                                                                        \
  X(void, FreeInstance, (fmi3Instance i))                                                                              \
  X(fmi3Status, EnterInitializationMode,                                                                               \
    (fmi3Instance i, bool has_tolerance, double tolerance, double start, bool has_stop, double stop))                  \
  X(fmi3Status, ExitInitializationMode, (fmi3Instance i))                                                              \
  X(fmi3Status, EnterEventMode, (fmi3Instance i))                                                                      \
  X(fmi3Status, EnterStepMode, (fmi3Instance i))                                                                       \
  X(fmi3Status, UpdateDiscreteStates,                                                                                  \
    (fmi3Instance i, bool *again, bool *terminate, bool *nominals, bool *values, bool *has_next, double *next))        \
  X(fmi3Status, Terminate, (fmi3Instance i))                                                                           \
  X(fmi3Status, GetFloat64, (fmi3Instance i, const fmi3Reference *r, size_t nr, double *v, size_t nv))                 \
  X(fmi3Status, SetFloat64, (fmi3Instance i, const fmi3Reference *r, size_t nr, const double *v, size_t nv))           \
  X(fmi3Status, GetFMUState, (fmi3Instance i, fmi3State * s))                                                          \
  X(fmi3Status, SetFMUState, (fmi3Instance i, fmi3State s))                                                            \
  X(fmi3Status, FreeFMUState, (fmi3Instance i, fmi3State * s))                                                         \
  X(fmi3Status, DoStep,                                                                                                \
    (fmi3Instance i, double t, double h, bool no_return_before_t, bool *event, bool *terminate, bool *early,           \
     double *reached))
#endif
