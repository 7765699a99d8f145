/* SPDX-License-Identifier: MIT

   fmi3.h - the parts of the FMI 3.0 and 2.0 C interfaces that fmi.c and fmi_body.c use, typed from the
   standards (fmi-standard.org; 3.0: 2.2, 4.2; 2.0: 2.1, 4.2); a host that has the official headers
   takes those */
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

/* T(name, type): the kinds of numbers of FMI 3.0; Enumeration is Int64 */
#define FMI3_NUMBERS(T)                                                                                                \
  T(Float64, double) T(Float32, float) T(Int8, int8_t) T(UInt8, uint8_t) T(Int16, int16_t) T(UInt16, uint16_t)         \
  T(Int32, int32_t) T(UInt32, uint32_t) T(Int64, int64_t) T(UInt64, uint64_t) T(Boolean, bool)
#define FMI3_GET_SET(X, name, type)                                                                                    \
  X(fmi3Status, Get##name, (fmi3Instance i, const fmi3Reference *r, size_t nr, type *v, size_t nv))                    \
  X(fmi3Status, Set##name, (fmi3Instance i, const fmi3Reference *r, size_t nr, const type *v, size_t nv))

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
  X(fmi3Status, GetFMUState, (fmi3Instance i, fmi3State * s))                                                          \
  X(fmi3Status, SetFMUState, (fmi3Instance i, fmi3State s))                                                            \
  X(fmi3Status, FreeFMUState, (fmi3Instance i, fmi3State * s))                                                         \
  X(fmi3Status, DoStep,                                                                                                \
    (fmi3Instance i, double t, double h, bool no_return_before_t, bool *event, bool *terminate, bool *early,           \
     double *reached))

/* ---- 2.0; statuses are those of 3.0 ---- */

typedef struct fmi2Callbacks {
    void (*log)(fmi3Environment, const char *name, fmi3Status, const char *category, const char *message, ...);
    void *(*allocate)(size_t, size_t);
    void (*free)(void *);
    void (*step_finished)(fmi3Environment, fmi3Status);
    fmi3Environment environment;
} fmi2Callbacks;

#define FMI2_NUMBERS(T) T(Real, double) T(Integer, int) T(Boolean, int)
#define FMI2_GET_SET(X, name, type)                                                                                    \
  X(fmi3Status, Get##name, (fmi3Instance i, const fmi3Reference *r, size_t nr, type *v))                               \
  X(fmi3Status, Set##name, (fmi3Instance i, const fmi3Reference *r, size_t nr, const type *v))
#define FMI2_FUNCTIONS(X)                                                                                              \
  X(fmi3Instance, Instantiate,                                                                                         \
    (const char *name, int kind, const char *token, const char *resources, const fmi2Callbacks *callbacks,             \
     int visible, int logging))                                                                                        \
  X(void, FreeInstance, (fmi3Instance i))                                                                              \
  X(fmi3Status, SetupExperiment,                                                                                       \
    (fmi3Instance i, int has_tolerance, double tolerance, double start, int has_stop, double stop))                    \
  X(fmi3Status, EnterInitializationMode, (fmi3Instance i))                                                             \
  X(fmi3Status, ExitInitializationMode, (fmi3Instance i))                                                              \
  X(fmi3Status, Terminate, (fmi3Instance i))                                                                           \
  X(fmi3Status, GetFMUstate, (fmi3Instance i, fmi3State * s))                                                          \
  X(fmi3Status, SetFMUstate, (fmi3Instance i, fmi3State s))                                                            \
  X(fmi3Status, FreeFMUstate, (fmi3Instance i, fmi3State * s))                                                         \
  X(fmi3Status, GetRealStatus, (fmi3Instance i, int kind, double *v))                                                  \
  X(fmi3Status, DoStep, (fmi3Instance i, double t, double h, int no_return_before_t))
#endif
