/* SPDX-License-Identifier: MIT

   fmi_fmu.h - an FMU of FMI 3.0 or 2.0 for fmi.c: what its description says, its library, and the calls
   that the master makes, one for both versions.  No XML library: tags and attributes, no more.  Every
   number is a double here; what cannot be used ends the program with a sentence. */
#ifndef FMI_FMU_H
#define FMI_FMU_H
#include "fmi3.h"

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FMI_TEXT = 1024, FMI_SIZE = 64 }; /* entries of an array at most */

typedef struct variable {
    char name[256], kind[16]; /* Float64, Int32, Real ...; Enumeration is an integer */
    fmi3Reference reference;
    int size; /* 1, or entries of an array */
    int input, output, continuous;
} variable;

typedef struct fmu {
    char name[64], folder[FMI_TEXT], *description;
    int version, unpacked, event_mode, asks, one_size;
#define FMI_MEMBER(result, function, arguments) result(*function) arguments;
#define FMI_NUMBER3(kind, type) FMI3_GET_SET(FMI_MEMBER, kind, type)
#define FMI_NUMBER2(kind, type) FMI2_GET_SET(FMI_MEMBER, kind, type)
    struct {
        FMI3_FUNCTIONS(FMI_MEMBER)
        FMI3_NUMBERS(FMI_NUMBER3)
    } v3;
    struct {
        FMI2_FUNCTIONS(FMI_MEMBER)
        FMI2_NUMBERS(FMI_NUMBER2)
    } v2;
    fmi2Callbacks callbacks;
    fmi3Instance i;
    fmi3State state; /* the saved one */
} fmu;

static void stop(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
    exit(2);
}

static void fine(fmi3Status status, const fmu *f, const char *what)
{
    if (status > fmi3Warning) stop("%s: %s failed with status %d", f->name, what, (int)status);
}

/* ---- the model description ---- */

/* The next tag behind p, or NULL; comments are passed over. */
static const char *next_tag(const char *p)
{
    while ((p = strchr(p, '<')) != NULL) {
        if (strncmp(p, "<!--", 4) != 0) return p + 1;
        p = strstr(p, "-->");
        if (!p) return NULL;
    }
    return NULL;
}

static int is_tag(const char *tag, const char *name)
{
    const size_t length = strlen(name);
    return strncmp(tag, name, length) == 0 && !isalnum((unsigned char)tag[length]);
}

/* Copies the attribute's text; "" if the tag has none of that name. */
static const char *attribute(const char *tag, const char *name, char *text, size_t size)
{
    const size_t length = strlen(name);
    text[0] = 0;
    while (*tag && *tag != '>') {
        const char *begin = tag, *value = tag + strcspn(tag, "\"'>"), *end;
        if (*value == '>' || !*value) break;
        end = strchr(value + 1, *value);
        if (!end) break;
        while (isspace((unsigned char)*begin)) begin++;
        while (begin < value && strncmp(begin, name, length) != 0) begin += strcspn(begin, " \n\t") + 1;
        if (begin < value && strchr("= ", begin[length])) {
            const size_t count = (size_t)(end - value - 1);
            memcpy(text, value + 1, count < size ? count : size - 1);
            text[count < size ? count : size - 1] = 0;
            return text;
        }
        tag = end + 1;
    }
    return text;
}

static int flag(const char *tag, const char *name)
{
    char text[8];
    attribute(tag, name, text, sizeof text);
    return strcmp(text, "true") == 0 || strcmp(text, "1") == 0;
}

static const char *find_tag(const fmu *f, const char *name)
{
    const char *tag = next_tag(f->description);
    while (tag && !is_tag(tag, name)) tag = next_tag(tag);
    return tag;
}

static int opens(const char *tag) /* <a ...>, not <a .../> */
{
    const char *p = tag;
    while (*p && *p != '>') {
        if ((*p == '"' || *p == '\'') && strchr(p + 1, *p)) p = strchr(p + 1, *p);
        p++;
    }
    return p > tag && p[-1] != '/';
}

/* The tag of the first variable in <ModelVariables>, or of the next one behind a variable; NULL behind the last. */
static const char *next_variable(const char *tag)
{
    int deep = !is_tag(tag, "ModelVariables") && opens(tag);
    while ((tag = next_tag(tag)) != NULL && !is_tag(tag, "/ModelVariables")) {
        if (deep == 0) return tag;
        deep += *tag == '/' ? -1 : opens(tag);
    }
    return NULL;
}

/* The size of an array: the product of its dimensions, numbers or start values of other variables. */
static int array_size(const fmu *f, const char *tag)
{
    char text[64], other[64];
    int size = 1;
    const char *inner = tag;
    if (!opens(tag)) return 1;
    while ((inner = next_tag(inner)) != NULL && *inner != '/') {
        const char *v = find_tag(f, "ModelVariables");
        if (!is_tag(inner, "Dimension")) continue;
        if (*attribute(inner, "valueReference", other, sizeof other)) {
            while ((v = next_variable(v)) != NULL)
                if (strcmp(attribute(v, "valueReference", text, sizeof text), other) == 0) break;
            attribute(v ? v : inner, "start", text, sizeof text);
        }
        size *= atoi(text);
        if (size < 1 || size > FMI_SIZE) stop("%s: an array of 1 to %d entries is expected", f->name, FMI_SIZE);
    }
    return size;
}

static variable read_variable(const fmu *f, const char *tag)
{
    variable v;
    char text[64];
    const char *kind = tag;
    attribute(tag, "name", v.name, sizeof v.name);
    v.reference = (fmi3Reference)strtoul(attribute(tag, "valueReference", text, sizeof text), NULL, 10);
    attribute(tag, "causality", text, sizeof text);
    v.input = strcmp(text, "input") == 0;
    v.output = strcmp(text, "output") == 0;
    if (f->version == 2) kind = next_tag(tag); /* <ScalarVariable ...><Real ...> */
    memset(v.kind, 0, sizeof v.kind);
    for (size_t k = 0; kind && isalnum((unsigned char)kind[k]) && k + 1 < sizeof v.kind; k++) v.kind[k] = kind[k];
    attribute(tag, "variability", text, sizeof text);
    v.continuous = (strncmp(v.kind, "Float", 5) == 0 || strcmp(v.kind, "Real") == 0) && strcmp(text, "discrete") != 0;
    v.size = f->version == 3 ? array_size(f, tag) : 1;
    return v;
}

static int is_number(const variable *v)
{
    return strcmp(v->kind, "String") != 0 && strcmp(v->kind, "Binary") != 0 && strcmp(v->kind, "Clock") != 0;
}

static variable find_variable(const fmu *f, const char *name)
{
    const char *tag = find_tag(f, "ModelVariables");
    variable v;
    while (tag && (tag = next_variable(tag)) != NULL) {
        attribute(tag, "name", v.name, sizeof v.name);
        if (strcmp(v.name, name) != 0) continue;
        v = read_variable(f, tag);
        if (!is_number(&v)) stop("%s.%s is a %s; this master connects numbers alone", f->name, name, v.kind);
        return v;
    }
    stop("%s has no variable '%s'", f->name, name);
    return v;
}

/* ---- load ---- */

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    long size;
    char *text;
    if (!file) stop("cannot read %s: %s", path, strerror(errno));
    fseek(file, 0, SEEK_END);
    size = ftell(file);
    rewind(file);
    text = (char *)calloc(1, (size_t)size + 1);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size) stop("cannot read %s", path);
    fclose(file);
    return text;
}

/* Runs a program of the system; its exit status. */
static int command(const char *program, const char *a, const char *b, const char *c, const char *d)
{
    int status = 1;
    const pid_t child = fork();
    if (child == 0) {
        execlp(program, program, a, b, c, d, (char *)NULL);
        _exit(127);
    }
    waitpid(child, &status, 0);
    return status;
}

static void unpack(const char *path, fmu *f)
{
    strcpy(f->folder, "/tmp/fmuXXXXXX");
    if (!mkdtemp(f->folder)) stop("cannot make %s", f->folder);
    f->unpacked = 1;
    if (command("unzip", "-oq", path, "-d", f->folder) != 0) stop("unzip could not unpack %s", path);
}

static void log_message(fmi3Environment environment, fmi3Status status, const char *category, const char *message)
{
    fprintf(stderr, "%s: %s: %s\n", ((const fmu *)environment)->name, category ? category : "", message);
    (void)status;
}

static void log_message2(fmi3Environment environment, const char *name, fmi3Status status, const char *category,
                         const char *message, ...)
{
    (void)name;
    log_message(environment, status, category, message);
}

static void *look_up(void *library, const char *prefix, const char *function)
{
    char name[64];
    snprintf(name, sizeof name, "%s%s", prefix, function);
    return dlsym(library, name);
}

#define FMI_LOOK_UP(prefix, into, needed, function)                                                                    \
  p = look_up(library, prefix, #function);                                                                             \
  if (!p && needed) stop("%s has no function %s%s", file, prefix, #function);                                          \
  memcpy(&f->into.function, &p, sizeof p);
#define FMI_NEEDED3(result, function, arguments) FMI_LOOK_UP("fmi3", v3, 1, function)
#define FMI_WANTED3(result, function, arguments) FMI_LOOK_UP("fmi3", v3, 0, function)
#define FMI_LOOK3(kind, type) FMI3_GET_SET(FMI_WANTED3, kind, type)
#define FMI_WANTED2(result, function, arguments) FMI_LOOK_UP("fmi2", v2, 0, function)
#define FMI_LOOK2(kind, type) FMI2_GET_SET(FMI_WANTED2, kind, type)

static void load_library(fmu *f, const char *id)
{
    const char *suffix = ".so", *system = "linux";
    char file[3 * FMI_TEXT];
    void *library, *p;
    int bits64 = sizeof(void *) == 8;
#ifdef __APPLE__
    suffix = ".dylib", system = "darwin";
#endif
#ifdef __aarch64__
    const char *machine = "aarch64";
#else
    const char *machine = "x86_64";
#endif
    if (f->version == 3) snprintf(file, sizeof file, "%s/binaries/%s-%s/%s%s", f->folder, machine, system, id, suffix);
    else snprintf(file, sizeof file, "%s/binaries/%s%s/%s%s", f->folder, system, bits64 ? "64" : "32", id, suffix);
    library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) stop("%s", dlerror());
    if (f->version == 3) {
        FMI3_FUNCTIONS(FMI_NEEDED3)
        FMI3_NUMBERS(FMI_LOOK3)
    } else {
        FMI2_FUNCTIONS(FMI_WANTED2)
        if (!f->v2.Instantiate || !f->v2.DoStep || !f->v2.SetFMUstate) stop("%s lacks functions of FMI 2.0", file);
        FMI2_NUMBERS(FMI_LOOK2)
    }
}

static void load(fmu *f, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *tag;
    struct stat facts;
    char id[256], file[3 * FMI_TEXT], version[16];
    snprintf(f->name, sizeof f->name, "%.*s", (int)strcspn(base, "."), base);
    if (stat(path, &facts) != 0) stop("cannot find %s", path);
    if (S_ISDIR(facts.st_mode)) {
        if (!realpath(path, file) || strlen(file) >= FMI_TEXT) stop("%s: the path is too long", path);
        memcpy(f->folder, file, strlen(file) + 1);
    } else unpack(path, f);
    snprintf(file, sizeof file, "%s/modelDescription.xml", f->folder);
    f->description = read_text(file);
    tag = find_tag(f, "fmiModelDescription");
    if (!tag) stop("%s is no model description", file);
    f->version = atoi(attribute(tag, "fmiVersion", version, sizeof version));
    if (f->version != 2 && f->version != 3) stop("%s is made for FMI %s; this master speaks 2.0 and 3.0", f->name, version);
    tag = find_tag(f, "CoSimulation");
    if (!tag) stop("%s has no CoSimulation interface", f->name);
    if (!flag(tag, f->version == 3 ? "canGetAndSetFMUState" : "canGetAndSetFMUstate"))
        stop("%s cannot go back to a saved state (canGetAndSetFMUState): no iteration", f->name);
    f->event_mode = flag(tag, "hasEventMode");
    f->asks = flag(tag, "providesIntermediateUpdate");
    f->one_size = !flag(tag, "canHandleVariableCommunicationStepSize");
    attribute(tag, "modelIdentifier", id, sizeof id);
    load_library(f, id);
}

static void unload(fmu *f)
{
    if (f->unpacked) command("rm", "-r", "-f", f->folder, NULL);
}

/* ---- calls ---- */

#define FMI_INSTANCE3(f)                                                                                               \
  f->v3.InstantiateCoSimulation(f->name, token, resources, false, false, f->event_mode, f->event_mode, NULL, 0, f,     \
                                log_message, f->asks ? update : NULL)

static void instantiate(fmu *f, fmi3Intermediate *update)
{
    const char *tag = find_tag(f, "fmiModelDescription");
    char token[256], resources[FMI_TEXT + 32];
    attribute(tag, f->version == 3 ? "instantiationToken" : "guid", token, sizeof token);
    snprintf(resources, sizeof resources, f->version == 3 ? "%s/resources/" : "file://%s/resources", f->folder);
    if (f->version == 2) {
        const fmi2Callbacks callbacks = {log_message2, calloc, free, NULL, f};
        f->callbacks = callbacks;
        f->i = f->v2.Instantiate(f->name, 1, token, resources, &f->callbacks, 0, 0);
    } else {
        f->i = FMI_INSTANCE3(f);
        if (!f->i && f->event_mode) { /* some have the attribute and refuse the mode */
            f->event_mode = 0;
            f->i = FMI_INSTANCE3(f);
        }
    }
    if (!f->i) stop("%s could not be instantiated", f->name);
}

static void enter_initialization(fmu *f, double start, double end)
{
    if (f->version == 2) fine(f->v2.SetupExperiment(f->i, 0, 0, start, 1, end), f, "fmi2SetupExperiment");
    fine(f->version == 3 ? f->v3.EnterInitializationMode(f->i, false, 0, start, true, end)
                         : f->v2.EnterInitializationMode(f->i),
         f, "EnterInitializationMode");
}

static void exit_initialization(fmu *f)
{
    fine(f->version == 3 ? f->v3.ExitInitializationMode(f->i) : f->v2.ExitInitializationMode(f->i), f,
         "ExitInitializationMode");
}

#define FMI_GET3(kind_, type)                                                                                          \
  if (strcmp(kind, #kind_) == 0 && f->v3.Get##kind_) {                                                                 \
    type a[FMI_SIZE];                                                                                                  \
    fine(f->v3.Get##kind_(f->i, &v->reference, 1, a, (size_t)v->size), f, "fmi3Get" #kind_);                           \
    for (int k = 0; k < v->size; k++) out[k] = (double)a[k];                                                           \
    return;                                                                                                            \
  }
#define FMI_SET3(kind_, type)                                                                                          \
  if (strcmp(kind, #kind_) == 0 && f->v3.Set##kind_) {                                                                 \
    type a[FMI_SIZE];                                                                                                  \
    for (int k = 0; k < v->size; k++) a[k] = (type)(whole ? rint(in[k]) : in[k]);                                      \
    fine(f->v3.Set##kind_(f->i, &v->reference, 1, a, (size_t)v->size), f, "fmi3Set" #kind_);                           \
    return;                                                                                                            \
  }
#define FMI_GET2(kind_, type)                                                                                          \
  if (strcmp(kind, #kind_) == 0 && f->v2.Get##kind_) {                                                                 \
    type a;                                                                                                            \
    fine(f->v2.Get##kind_(f->i, &v->reference, 1, &a), f, "fmi2Get" #kind_);                                           \
    out[0] = (double)a;                                                                                                \
    return;                                                                                                            \
  }
#define FMI_SET2(kind_, type)                                                                                          \
  if (strcmp(kind, #kind_) == 0 && f->v2.Set##kind_) {                                                                 \
    const type a = (type)(whole ? rint(in[0]) : in[0]);                                                                \
    fine(f->v2.Set##kind_(f->i, &v->reference, 1, &a), f, "fmi2Set" #kind_);                                           \
    return;                                                                                                            \
  }

static const char *plain_kind(const fmu *f, const variable *v)
{
    if (strcmp(v->kind, "Enumeration") != 0) return v->kind;
    return f->version == 3 ? "Int64" : "Integer";
}

/* v->size numbers */
static void get(const fmu *f, const variable *v, double *out)
{
    const char *kind = plain_kind(f, v);
    if (f->version == 3) {
        FMI3_NUMBERS(FMI_GET3)
    } else {
        FMI2_NUMBERS(FMI_GET2)
    }
    stop("%s.%s: a %s cannot be read", f->name, v->name, v->kind);
}

static void set(const fmu *f, const variable *v, const double *in)
{
    const char *kind = plain_kind(f, v);
    const int whole = strncmp(kind, "Float", 5) != 0 && strcmp(kind, "Real") != 0;
    if (f->version == 3) {
        FMI3_NUMBERS(FMI_SET3)
    } else {
        FMI2_NUMBERS(FMI_SET2)
    }
    stop("%s.%s: a %s cannot be set", f->name, v->name, v->kind);
}

static void save(fmu *f)
{
    fine(f->version == 3 ? f->v3.GetFMUState(f->i, &f->state) : f->v2.GetFMUstate(f->i, &f->state), f, "GetFMUState");
}

static void restore(fmu *f)
{
    fine(f->version == 3 ? f->v3.SetFMUState(f->i, f->state) : f->v2.SetFMUstate(f->i, f->state), f, "SetFMUState");
}

/* From t to `end`, or to an event in front of it: returns the time reached; *event, *over: it asks for event mode, for the end. */
static double do_step(fmu *f, double t, double end, int *event, int *over)
{
    bool needed = false, terminate = false, early = false;
    double reached = end;
    if (f->version == 3)
        fine(f->v3.DoStep(f->i, t, end - t, false, &needed, &terminate, &early, &reached), f, "fmi3DoStep");
    else {
        const fmi3Status status = f->v2.DoStep(f->i, t, end - t, 0);
        terminate = status == fmi3Discard; /* in 2.0: not all of the step */
        if (!terminate) fine(status, f, "fmi2DoStep");
        else if (f->v2.GetRealStatus) fine(f->v2.GetRealStatus(f->i, 2, &reached), f, "fmi2GetRealStatus");
    }
    *event = needed;
    *over = terminate;
    return early || terminate ? reached : end;
}

static void enter_event_mode(fmu *f)
{
    if (f->event_mode) fine(f->v3.EnterEventMode(f->i), f, "fmi3EnterEventMode");
}

/* The events at this time; returns whether the FMU asks for the end of the simulation. */
static int update_discrete_states(fmu *f)
{
    bool again = f->event_mode, terminate = false, nominals, values, has_next;
    double next;
    while (again && !terminate)
        fine(f->v3.UpdateDiscreteStates(f->i, &again, &terminate, &nominals, &values, &has_next, &next), f,
             "fmi3UpdateDiscreteStates");
    return terminate;
}

static void enter_step_mode(fmu *f)
{
    if (f->event_mode) fine(f->v3.EnterStepMode(f->i), f, "fmi3EnterStepMode");
}

static void terminate(fmu *f)
{
    if (f->state && f->version == 3) f->v3.FreeFMUState(f->i, &f->state);
    if (f->state && f->version == 2) f->v2.FreeFMUstate(f->i, &f->state);
    if (f->version == 3) {
        f->v3.Terminate(f->i);
        f->v3.FreeInstance(f->i);
    } else {
        f->v2.Terminate(f->i);
        f->v2.FreeInstance(f->i);
    }
}
#endif
