/* SPDX-License-Identifier: MIT

   fmi.c - a co-simulation master for FMUs of FMI 3.0: waveform iteration over each window

       fmi FMU... CONSUMER.input=PRODUCER.output... [--key value]...

   An FMU is a .fmu file or the folder it was unpacked to; its name is that of the file.  Of every
   FMU the connected outputs are one waveform.  In a window each FMU runs from its saved state, in
   the order given, and reads the inputs that it asks for (intermediate update) from the waveforms
   of the others; one that does not ask holds the value at the end of each step.  What goes back to
   an earlier FMU, or to the same one, is the unknown x of the iteration.

   An event that ends a step early becomes a break: value before and value behind.  The nearest
   sub-step moves to it, so a window keeps its number of columns; for the values behind, x has
   places that are 0 in windows without event.  So the secant pairs of earlier windows stay; those of
   the window with the event belong to its times alone and are forgotten (iqn_discard, --pairs).

   Needs of an FMU: co-simulation, canGetAndSetFMUState, scalar Float64 at the connections. */
#define _XOPEN_SOURCE 700
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"

#include "fmi3.h"
#include "host.h"

#include <ctype.h>
#include <dlfcn.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FMUS = 16, LINKS = 64, EVENTS = 2, TEXT = 1024, STEPS = 64, PAIRS = 40 };

typedef struct variable {
    char name[256];
    fmi3Reference reference;
    int input, output;
} variable;

typedef struct fmu {
    char name[64], folder[TEXT];
    char *description;
    int unpacked, event_mode, asks, one_size;
#define MEMBER(result, name, arguments) result(*name) arguments;
    FMI3_FUNCTIONS(MEMBER)
    fmi3Instance i;
    fmi3State state; /* at the window start */
    int outputs, goes_back;
    fmi3Reference output[LINKS];
    waveform out;   /* of the outputs */
    double from;    /* start of the step at hand */
    double *result; /* columns of the window, where they are part of hx */
} fmu;

typedef struct wire { /* input `reference` of FMU `to` is output number `output` of FMU `from` */
    int to, from, output;
    fmi3Reference reference;
} wire;

static fmu Fmu[FMUS];
static wire Link[LINKS];
static int Fmus, Links;

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

/* ---- the model description: tags and attributes, no more ---- */

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

static variable find_variable(const fmu *f, const char *name)
{
    const char *tag = find_tag(f, "ModelVariables"), *inner;
    variable v;
    char text[64];
    while (tag && !is_tag(tag, "/ModelVariables")) {
        attribute(tag, "name", v.name, sizeof v.name);
        if (strcmp(v.name, name) == 0) {
            inner = next_tag(tag);
            if (!is_tag(tag, "Float64"))
                stop("%s.%s is a %.*s; this master connects Float64 alone", f->name, name, (int)strcspn(tag, " \n\t"),
                     tag);
            if (tag[strcspn(tag, ">") - 1] != '/' && inner && is_tag(inner, "Dimension"))
                stop("%s.%s is an array; this master connects scalars alone", f->name, name);
            v.reference = (fmi3Reference)strtoul(attribute(tag, "valueReference", text, sizeof text), NULL, 10);
            attribute(tag, "causality", text, sizeof text);
            v.input = strcmp(text, "input") == 0;
            v.output = strcmp(text, "output") == 0;
            return v;
        }
        tag = next_tag(tag);
    }
    stop("%s has no variable '%s'", f->name, name);
    return v;
}

/* ---- load an FMU ---- */

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    long size;
    char *text;
    if (!file) stop("cannot read %s: %s", path, strerror(errno));
    fseek(file, 0, SEEK_END);
    size = ftell(file);
    rewind(file);
    text = (char *)scene_memory((size_t)size + 1);
    if (fread(text, 1, (size_t)size, file) != (size_t)size) stop("cannot read %s", path);
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
    if (command("unzip", "-q", path, "-d", f->folder) != 0) stop("unzip could not unpack %s", path);
}

static void remove_unpacked(void)
{
    int k;
    for (k = 0; k < FMUS; k++)
        if (Fmu[k].unpacked) command("rm", "-r", "-f", Fmu[k].folder, NULL);
}

static void log_message(fmi3Environment environment, fmi3Status status, const char *category, const char *message)
{
    fprintf(stderr, "%s: %s: %s\n", ((const fmu *)environment)->name, category ? category : "", message);
    (void)status;
}

static void load(fmu *f, const char *path)
{
    const char *base = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    const char *tag, *suffix = ".so", *system = "linux";
    struct stat facts;
    char id[256], file[3 * TEXT], version[16];
    void *library, *p;
    snprintf(f->name, sizeof f->name, "%.*s", (int)strcspn(base, "."), base);
    if (stat(path, &facts) != 0) stop("cannot find %s", path);
    if (S_ISDIR(facts.st_mode)) {
        if (!realpath(path, file) || strlen(file) >= TEXT) stop("%s: the path is too long", path);
        memcpy(f->folder, file, strlen(file) + 1);
    } else unpack(path, f);
    snprintf(file, sizeof file, "%s/modelDescription.xml", f->folder);
    f->description = read_text(file);
    tag = find_tag(f, "fmiModelDescription");
    if (!tag) stop("%s is no model description", file);
    if (attribute(tag, "fmiVersion", version, sizeof version)[0] != '3')
        stop("%s is made for FMI %s; this master speaks FMI 3.0", f->name, version);
    tag = find_tag(f, "CoSimulation");
    if (!tag) stop("%s has no CoSimulation interface", f->name);
    if (!flag(tag, "canGetAndSetFMUState"))
        stop("%s cannot go back to a saved state (canGetAndSetFMUState): no iteration", f->name);
    f->event_mode = flag(tag, "hasEventMode");
    f->asks = flag(tag, "providesIntermediateUpdate");
    f->one_size = !flag(tag, "canHandleVariableCommunicationStepSize");
    attribute(tag, "modelIdentifier", id, sizeof id);
#ifdef __APPLE__
    suffix = ".dylib", system = "darwin";
#endif
#if defined(__aarch64__)
    snprintf(file, sizeof file, "%s/binaries/aarch64-%s/%s%s", f->folder, system, id, suffix);
#else
    snprintf(file, sizeof file, "%s/binaries/x86_64-%s/%s%s", f->folder, system, id, suffix);
#endif
    library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) stop("%s", dlerror());
#define LOOK_UP(result, function, arguments)                                                                           \
  p = dlsym(library, "fmi3" #function);                                                                                \
  if (!p) stop("%s has no function fmi3%s", file, #function);                                                          \
  memcpy(&f->function, &p, sizeof p);
    FMI3_FUNCTIONS(LOOK_UP)
}

/* ---- connections ---- */

static int fmu_of(const char *text, char *variable_name, size_t size)
{
    const size_t length = strcspn(text, ".");
    int k;
    snprintf(variable_name, size, "%s", text[length] ? text + length + 1 : "");
    for (k = 0; k < Fmus; k++)
        if (strlen(Fmu[k].name) == length && strncmp(Fmu[k].name, text, length) == 0) return k;
    stop("'%s' names none of the FMUs: FMU.variable", text);
    return -1;
}

static void connect(char *text)
{
    char *equal = strchr(text, '='), in[256], out[256];
    wire *l = &Link[Links];
    variable v, u;
    fmu *from;
    if (Links == LINKS) stop("more than %d connections", LINKS);
    *equal = 0;
    l->to = fmu_of(text, in, sizeof in);
    l->from = fmu_of(equal + 1, out, sizeof out);
    from = &Fmu[l->from];
    v = find_variable(&Fmu[l->to], in);
    u = find_variable(from, out);
    if (!v.input) stop("%s is no input of %s", in, Fmu[l->to].name);
    if (!u.output) stop("%s is no output of %s", out, from->name);
    l->reference = v.reference;
    for (l->output = 0; l->output < from->outputs; l->output++)
        if (from->output[l->output] == u.reference) break;
    if (l->output == from->outputs) from->output[from->outputs++] = u.reference;
    if (l->to <= l->from) from->goes_back = 1;
    Links++;
}

/* ---- inputs and outputs ---- */

static void set_inputs(fmu *f, double t, int behind)
{
    double v[LINKS];
    int k;
    for (k = 0; k < Links; k++) {
        const wire *l = &Link[k];
        if (&Fmu[l->to] != f) continue;
        waveform_read(&Fmu[l->from].out, t, behind ? WF_BEHIND : 0, v);
        fine(f->SetFloat64(f->i, &l->reference, 1, &v[l->output], 1), f, "fmi3SetFloat64");
    }
}

static void get_outputs(fmu *f, double *v)
{
    if (f->outputs == 0) return;
    fine(f->GetFloat64(f->i, f->output, (size_t)f->outputs, v, (size_t)f->outputs), f, "fmi3GetFloat64");
}

static void update(fmi3Environment environment, double t, bool set_requested, bool get_allowed, bool step_finished,
                   bool can_return_early, bool *return_early, double *return_time)
{
    fmu *f = (fmu *)environment;
    (void)get_allowed, (void)step_finished, (void)can_return_early, (void)return_time;
    if (return_early) *return_early = false;
    if (set_requested) set_inputs(f, t, !(t > f->from));
}

static void handle_event(fmu *f)
{
    bool again = true, terminate = false, nominals, values, has_next;
    double next;
    while (again && !terminate)
        fine(f->UpdateDiscreteStates(f->i, &again, &terminate, &nominals, &values, &has_next, &next), f,
             "fmi3UpdateDiscreteStates");
    if (terminate) stop("%s asks to end the simulation", f->name);
}

/* ---- a window ---- */

typedef struct window {
    int count, steps, events; /* times; regular ones among them; times that occur twice */
    double start, t[STEPS + 2 * EVENTS];
} window;

static int is_behind(const window *w, int j)
{
    return j > 0 && !(w->t[j] > w->t[j - 1]);
}

/* The sub-step nearest to the event moves to it, and occurs twice.  The end does not move. */
static void insert_event(window *w, double t)
{
    int j, best = 0;
    for (j = 0; j < Fmus; j++)
        if (Fmu[j].one_size)
            stop("%s takes steps of one size (canHandleVariableCommunicationStepSize): no event inside", Fmu[j].name);
    if (w->events == EVENTS) stop("more than %d events in the window at %g: take shorter ones", EVENTS, w->start);
    for (j = 1; j < w->count - 1; j++)
        if (fabs(w->t[j] - t) < fabs(w->t[best] - t) && !is_behind(w, j)) best = j;
    if (best + 1 < w->count && is_behind(w, best + 1)) stop("two events in one sub-step at %g: take more", t);
    memmove(&w->t[best + 1], &w->t[best], (size_t)(w->count - best) * sizeof(double));
    w->t[best] = t;
    w->t[best + 1] = t;
    w->count++;
    w->events++;
}

/* From t to `end` or to an event in front of it; returns the time reached. */
static double advance(fmu *f, double t, double end, int *event)
{
    bool needed = false, terminate = false, early = false;
    double reached = end;
    f->from = t;
    set_inputs(f, end, 0); /* for an FMU that never asks */
    fine(f->DoStep(f->i, t, end - t, false, &needed, &terminate, &early, &reached), f, "fmi3DoStep");
    if (terminate) stop("%s asks to end the simulation at %g", f->name, reached);
    *event = needed;
    return early ? reached : end;
}

/* One FMU through the window: its outputs into `result`, a column each.  Returns the time of an
   event that the window does not know yet, or -HUGE_VAL. */
static double run(fmu *f, const window *w, double *result)
{
    double t = w->start;
    int j, event;
    fine(f->SetFMUState(f->i, f->state), f, "fmi3SetFMUState");
    for (j = 0; j < w->count; j++, result += f->outputs) {
        if (is_behind(w, j)) {
            if (f->event_mode) fine(f->EnterEventMode(f->i), f, "fmi3EnterEventMode");
            set_inputs(f, t, 1);
            if (f->event_mode) handle_event(f);
            get_outputs(f, result);
            if (f->event_mode) fine(f->EnterStepMode(f->i), f, "fmi3EnterStepMode");
            continue;
        }
        t = advance(f, t, w->t[j], &event);
        if (event && !(j + 1 < w->count && is_behind(w, j + 1) && !(t < w->t[j]))) return t;
        get_outputs(f, result);
    }
    return -HUGE_VAL;
}

/* x: the regular columns, then the values behind events, 0 where there are none. */
static int place(const window *w, int j)
{
    int k, behind = 0;
    for (k = 0; k < j; k++) behind += is_behind(w, k);
    return is_behind(w, j) ? w->steps + behind : j - behind;
}

static void copy(const window *w, const fmu *f, double *columns, double *x, int into_x)
{
    const size_t bytes = (size_t)f->outputs * sizeof(double);
    int j;
    for (j = 0; j < w->count; j++) {
        double *a = columns + j * f->outputs, *b = x + place(w, j) * f->outputs;
        memcpy(into_x ? b : a, into_x ? a : b, bytes);
    }
}

/* All of x between the waveforms (or results) and an array. */
static void gather(const window *w, double *x, int results, int into_x)
{
    int k;
    for (k = 0; k < Fmus; k++) {
        if (!Fmu[k].goes_back) continue;
        copy(w, &Fmu[k], results ? Fmu[k].result : waveform_window(&Fmu[k].out), x, into_x);
        x += (w->steps + EVENTS) * Fmu[k].outputs;
    }
}

/* hx = H(x); returns as run does. */
static double evaluate(const window *w)
{
    double event = -HUGE_VAL;
    int k;
    for (k = 0; k < Fmus && !(event >= w->start); k++)
        event = run(&Fmu[k], w, Fmu[k].goes_back ? Fmu[k].result : waveform_window(&Fmu[k].out));
    return event;
}

static void open_window(const window *w, int degree)
{
    int k;
    for (k = 0; k < Fmus; k++)
        if (Fmu[k].outputs > 0) good(wf_begin(Fmu[k].out.w, degree, w->count, w->t, 0));
}

/* Iterate until the waveforms stand still; returns how often all FMUs ran. */
static int solve(window *w, int degree, iqn *q, double *x, double *hx)
{
    int turns = 0, status = 0;
    double event;
    open_window(w, degree);
    do {
        turns++;
        event = evaluate(w);
        if (event >= w->start) { /* a new event: other times, the same window */
            insert_event(w, event);
            open_window(w, degree);
            continue;
        }
        gather(w, x, 0, 1);
        gather(w, hx, 1, 1);
        status = iqn_step(q, x, hx);
        check(status >= 0, iqn_message(status));
        gather(w, x, 0, 0);
    } while (iqn_converged(q) == 0);
    if (iqn_converged(q) == 2) stop("no answer in the window at %g", w->start);
    return turns;
}

/* ---- the loop at the start: inputs are outputs, before time begins ---- */

static void initialise(double start, double end, double tol)
{
    const size_t bytes = iqn_size(FMUS * LINKS, PAIRS, 1);
    static double x[FMUS * LINKS], hx[FMUS * LINKS];
    iqn *q;
    int k, status;
    check(iqn_make(&q, FMUS * LINKS, PAIRS, 1, scene_memory(bytes), bytes) >= 0, "no object for the start");
    iqn_set(q, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_MAX_ITERATIONS, 100);
    for (k = 0; k < Fmus; k++) {
        fine(Fmu[k].EnterInitializationMode(Fmu[k].i, false, 0, start, true, end), &Fmu[k], "initialisation");
        if (Fmu[k].outputs > 0) (void)waveform_push(&Fmu[k].out, start, 0);
    }
    do {
        memset(hx, 0, sizeof hx);
        for (k = 0; k < Fmus; k++)
            if (Fmu[k].outputs > 0)
                memcpy(wf_column(Fmu[k].out.w, 0), x + k * LINKS, (size_t)Fmu[k].outputs * sizeof(double));
        for (k = 0; k < Fmus; k++) {
            set_inputs(&Fmu[k], start, 0);
            get_outputs(&Fmu[k], hx + k * LINKS);
        }
        status = iqn_step(q, x, hx);
        check(status >= 0, iqn_message(status));
    } while (iqn_converged(q) == 0);
    if (iqn_converged(q) == 2) stop("no consistent start");
    for (k = 0; k < Fmus; k++) {
        fine(Fmu[k].ExitInitializationMode(Fmu[k].i), &Fmu[k], "initialisation");
        if (!Fmu[k].event_mode) continue;
        handle_event(&Fmu[k]);
        fine(Fmu[k].EnterStepMode(Fmu[k].i), &Fmu[k], "fmi3EnterStepMode");
    }
    free(q);
}

static void watch(const char *name, double t)
{
    char text[256];
    const fmu *f;
    variable v;
    double value;
    if (!*name) return;
    f = &Fmu[fmu_of(name, text, sizeof text)];
    v = find_variable(f, text);
    fine(f->GetFloat64(f->i, &v.reference, 1, &value, 1), f, "fmi3GetFloat64");
    printf("%.12g %.15g\n", t, value);
}

static iqn *make_iqn(int n, int method, double omega, double tol)
{
    const size_t bytes = iqn_size(n, PAIRS, 1);
    iqn *q;
    const int status = iqn_make(&q, n, PAIRS, 1, scene_memory(bytes), bytes);
    check(status >= 0, iqn_message(status));
    iqn_set(q, IQN_METHOD, method);
    iqn_set(q, IQN_OMEGA, omega);
    iqn_set(q, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    return q;
}

int main(int argc, char **argv)
{
    static const char *const methods[] = {"ils", "imvj", "aitken", "constant", NULL};
    static const char *const pairs[] = {"all", "before", "none", NULL};
    scene_option o[] = {{"stop", "1", "end; the start is 0"},
                        {"windows", "10", "windows up to the end"},
                        {"steps", "4", "sub-steps of a window"},
                        {"degree", "3", "of the waveforms; 0: values are held"},
                        {"tol", "1e-9", "of a window, relative"},
                        {"method", "ils", "ils, imvj, aitken, constant"},
                        {"omega", "0.1", "relaxation factor"},
                        {"pairs", "before", "in use after an event: all, before (it), none"},
                        {"watch", "", "FMU.variable to print at every window end"},
                        {NULL, NULL, NULL}};
    int first = 1, k, n = 0, total = 0, most = 0, windows, steps, degree, win, kept;
    double end, tol, *x, *hx;
    window w;
    iqn *q;

    while (first < argc && strncmp(argv[first], "--", 2) != 0) first++;
    scene_parse(argc - first + 1, argv + first - 1, "a master for FMUs of FMI 3.0", o);
    end = scene_number(o, "stop", 1e-9, 1e9);
    tol = scene_number(o, "tol", 1e-14, 1);
    windows = scene_integer(o, "windows", 1, 1000000);
    steps = scene_integer(o, "steps", 1, STEPS);
    degree = scene_integer(o, "degree", 0, WF_MAX_DEGREE);
    kept = scene_choice(o, "pairs", pairs);
    atexit(remove_unpacked);
    for (k = 1; k < first; k++)
        if (!strchr(argv[k], '=')) {
            if (Fmus == FMUS) stop("more than %d FMUs", FMUS);
            load(&Fmu[Fmus++], argv[k]);
        }
    for (k = 1; k < first; k++)
        if (strchr(argv[k], '=')) connect(argv[k]);
    if (Links == 0) stop("%s FMU... CONSUMER.input=PRODUCER.output...; -h lists the options", argv[0]);

    for (k = 0; k < Fmus; k++) {
        fmu *f = &Fmu[k];
        char token[256], resources[TEXT + 16];
        attribute(find_tag(f, "fmiModelDescription"), "instantiationToken", token, sizeof token);
        snprintf(resources, sizeof resources, "%s/resources/", f->folder);
        f->i = f->InstantiateCoSimulation(f->name, token, resources, false, false, f->event_mode, f->event_mode, NULL,
                                          0, f, log_message, f->asks ? update : NULL);
        if (!f->i) stop("%s could not be instantiated", f->name);
        f->out = waveform_make(degree, f->outputs, 4 * (STEPS + degree));
        f->result = (double *)scene_memory((size_t)((steps + 2 * EVENTS) * (f->outputs + 1)) * sizeof(double));
        if (f->goes_back) n += (steps + EVENTS) * f->outputs;
    }
    if (n == 0) stop("no connection goes back: nothing to iterate");
    x = (double *)scene_memory((size_t)n * sizeof(double));
    hx = (double *)scene_memory((size_t)n * sizeof(double));
    q = make_iqn(n, scene_choice(o, "method", methods), scene_number(o, "omega", -1e3, 1e3), tol);

    initialise(0, end, tol / 100);
    for (win = 0; win < windows; win++) {
        w.start = end * win / windows;
        w.count = w.steps = steps;
        w.events = 0;
        for (k = 0; k < steps; k++) w.t[k] = w.start + (end * (win + 1) / windows - w.start) * (k + 1) / steps;
        for (k = 0; k < Fmus; k++) fine(Fmu[k].GetFMUState(Fmu[k].i, &Fmu[k].state), &Fmu[k], "fmi3GetFMUState");
        memset(x, 0, (size_t)n * sizeof(double));
        memset(hx, 0, (size_t)n * sizeof(double));
        k = solve(&w, degree < 2 ? degree : 2, q, x, hx);
        total += k;
        most = k > most ? k : most;
        if (w.events == 0 || kept == 0) iqn_commit(q);
        else if (kept == 1) iqn_discard(q);
        else q = make_iqn(n, (int)iqn_get(q, IQN_METHOD), iqn_get(q, IQN_OMEGA), tol);
        for (k = 0; k < Fmus; k++)
            if (Fmu[k].outputs > 0) good(wf_advance(Fmu[k].out.w, 2 * steps));
        watch(scene_text(o, "watch"), w.t[w.count - 1]);
    }
    printf("windows %d\niterations %d\niterations_most %d\n", windows, total, most);
    for (k = 0; k < Fmus; k++) {
        Fmu[k].FreeFMUState(Fmu[k].i, &Fmu[k].state);
        Fmu[k].Terminate(Fmu[k].i);
        Fmu[k].FreeInstance(Fmu[k].i);
    }
    return 0;
}
