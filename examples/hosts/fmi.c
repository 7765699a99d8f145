/* SPDX-License-Identifier: MIT

   fmi.c - a co-simulation master for FMUs of FMI 3.0 and 2.0: waveform iteration over each window

       fmi FMU... [CONSUMER.input=PRODUCER.output...] [--set FMU.variable=value...] [--key value]...

   An FMU is a .fmu file or the folder it was unpacked to; its name is that of the file.  Of every
   FMU the connected outputs are one waveform, whole numbers and discrete ones another, which is
   held.  In a window each FMU runs from its saved state, in the order given, and reads the inputs
   that it asks for (intermediate update) from the waveforms of the others; one that does not ask
   holds the value at the end of each step.  What goes back to an earlier FMU, or to the same one,
   is the unknown x of the iteration; where nothing does, each FMU runs once.

   An event ends the window: the sub-steps are laid out anew up to it, and x keeps its length and its
   meaning.  Then all FMUs handle it, loops at that time are closed as at the start, and the values
   after it are a break at the start of the next window.  So events may lie at a window end, in the
   first sub-step, or several in one sub-step; and one that moves with the iterates is found.

   Needs of an FMU: co-simulation, canGetAndSetFMUState; at connections numbers, also small arrays. */
#define _XOPEN_SOURCE 700
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#include "waveform.h"
#include "iqn.h"

#include "host.h"

#include "fmi_fmu.h"

enum { FMUS = 16, LINKS = 64, NUMBERS = 256, STEPS = 64, PAIRS = 40, CUTS = 1000 };

typedef struct node { /* an FMU and its connected outputs */
    fmu f;
    variable out[LINKS];
    int outputs, at[LINKS];   /* where output k begins in its waveform */
    int numbers[2];           /* of the two waveforms */
    waveform w[2], ahead[2];  /* what the others read: continuous, held; ahead: what it would be */
    int goes_back, at_start;  /* at_start: an event has stopped it at the window start */
    double from;              /* start of the step at hand */
} node;

typedef struct wire { /* input of FMU `to` is output number `output` of FMU `from` */
    int to, from, output;
    variable in;
} wire;

static node Node[FMUS];
static wire Link[LINKS];
static int Nodes, Links;

/* ---- connections ---- */

static node *node_of(const char *text, char *variable_name, size_t size)
{
    const size_t length = strcspn(text, ".");
    int k;
    snprintf(variable_name, size, "%s", text[length] ? text + length + 1 : "");
    for (k = 0; k < Nodes; k++)
        if (strlen(Node[k].f.name) == length && strncmp(Node[k].f.name, text, length) == 0) return &Node[k];
    stop("'%s' names none of the FMUs: FMU.variable", text);
    return NULL;
}

/* Number of the output in its FMU, added if it is new. */
static int add_output(node *n, const variable *v)
{
    const int held = !v->continuous;
    int k;
    for (k = 0; k < n->outputs; k++)
        if (strcmp(n->out[k].name, v->name) == 0) return k;
    if (n->outputs == LINKS || n->numbers[held] + v->size > NUMBERS) stop("%s: too many connected outputs", n->f.name);
    n->out[k] = *v;
    n->at[k] = n->numbers[held];
    n->numbers[held] += v->size;
    n->outputs++;
    return k;
}

static void connect(char *text)
{
    char *equal = strchr(text, '='), in[256], out[256];
    wire *l = &Link[Links];
    variable v;
    node *to, *from;
    if (Links == LINKS) stop("more than %d connections", LINKS);
    *equal = 0;
    to = node_of(text, in, sizeof in);
    from = node_of(equal + 1, out, sizeof out);
    l->to = (int)(to - Node);
    l->from = (int)(from - Node);
    l->in = find_variable(&to->f, in);
    v = find_variable(&from->f, out);
    if (!l->in.input) stop("%s is no input of %s", in, to->f.name);
    if (!v.output) stop("%s is no output of %s", out, from->f.name);
    if (v.size != l->in.size) stop("%s has %d entries, %s has %d", in, l->in.size, out, v.size);
    l->output = add_output(from, &v);
    if (l->to <= l->from) from->goes_back = 1;
    Links++;
}

static void set_start(const char *text) /* FMU.variable=value, an array as "1 2 3" */
{
    const char *equal = strchr(text, '=');
    char name[256], whole[512], *end;
    double value[FMI_SIZE];
    node *n;
    variable v;
    int k;
    if (!equal) stop("--set FMU.variable=value, not '%s'", text);
    snprintf(whole, sizeof whole, "%.*s", (int)(equal - text), text);
    n = node_of(whole, name, sizeof name);
    v = find_variable(&n->f, name);
    for (k = 0; k < v.size; k++) {
        if (strncmp(++equal, "true", 4) == 0 || strncmp(equal, "false", 5) == 0) {
            value[k] = *equal == 't';
            continue;
        }
        value[k] = strtod(equal, &end);
        if (end == equal) stop("--set %s: %d numbers are expected", text, v.size);
        equal = end;
    }
    set(&n->f, &v, value);
}

/* ---- inputs and outputs ---- */

static void set_inputs(node *n, double t, int behind)
{
    double v[NUMBERS];
    int k;
    for (k = 0; k < Links; k++) {
        const wire *l = &Link[k];
        node *from = &Node[l->from];
        const int held = !from->out[l->output].continuous;
        if (&Node[l->to] != n) continue;
        waveform_read(&from->w[held], t, behind ? WF_BEHIND : 0, v);
        set(&n->f, &l->in, v + from->at[l->output]);
    }
}

/* The outputs that are kept in waveform `held`. */
static void get_outputs(const node *n, int held, double *v)
{
    int k;
    for (k = 0; k < n->outputs; k++)
        if (n->out[k].continuous == !held) get(&n->f, &n->out[k], v + n->at[k]);
}

static void update(fmi3Environment environment, double t, bool set_requested, bool get_allowed, bool step_finished,
                   bool can_return_early, bool *return_early, double *return_time)
{
    const fmu *f = (const fmu *)environment;
    int k;
    (void)get_allowed, (void)step_finished, (void)can_return_early, (void)return_time;
    if (return_early) *return_early = false;
    for (k = 0; k < Nodes; k++)
        if (set_requested && &Node[k].f == f) set_inputs(&Node[k], t, !(t > Node[k].from));
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

/* ---- loops at one time: the start, and events.  Inputs are outputs; both are the last samples. ---- */

static double *last_sample(const waveform *w)
{
    return wf_column(w->w, wf_columns(w->w) - 1);
}

/* The last samples of all continuous outputs, one after the other, out of the waveforms into x or back. */
static void last_samples(double *x, int into_x)
{
    int k;
    for (k = 0; k < Nodes; k++) {
        const size_t count = (size_t)Node[k].numbers[0];
        double *sample;
        if (count == 0) continue;
        sample = last_sample(&Node[k].w[0]);
        memcpy(into_x ? x : sample, into_x ? sample : x, count * sizeof(double));
        x += count;
    }
}

/* Held outputs into their last samples; returns whether one has changed. */
static int hold_outputs(node *n)
{
    double held[NUMBERS];
    const size_t bytes = (size_t)n->numbers[1] * sizeof(double);
    int changed;
    if (bytes == 0) return 0;
    get_outputs(n, 1, held);
    changed = memcmp(last_sample(&n->w[1]), held, bytes) != 0;
    memcpy(last_sample(&n->w[1]), held, bytes);
    return changed;
}

/* hx: the continuous outputs that the inputs of the last samples give.  Returns whether a held one has changed. */
static int evaluate_at(double t, int behind, double *hx)
{
    int k, changed = 0;
    for (k = 0; k < Nodes; k++) {
        set_inputs(&Node[k], t, behind);
        get_outputs(&Node[k], 0, hx);
        hx += Node[k].numbers[0];
        changed |= hold_outputs(&Node[k]);
    }
    return changed;
}

static void close_loops(double t, int behind, double tol)
{
    static double x[FMUS * NUMBERS], hx[FMUS * NUMBERS];
    int k, n = 0, changed, turns = 0;
    iqn *q;
    for (k = 0; k < Nodes; k++) n += Node[k].numbers[0];
    q = make_iqn(n, IQN_ILS, 0.1, tol);
    last_samples(x, 1);
    do {
        changed = evaluate_at(t, behind, hx);
        scene_check(n > 0 ? iqn_step(q, x, hx) : 0, "iqn_step");
        last_samples(x, 0);
        if (iqn_converged(q) == 2 || ++turns > CUTS) stop("no consistent values at %g", t);
    } while (changed || (n > 0 && iqn_converged(q) == 0));
    for (k = 0; k < Nodes; k++) set_inputs(&Node[k], t, behind);
    free(q);
}

/* The FMUs in event mode, or just initialised; returns whether one asks for the end. */
static int update_and_close(double t, int behind, double tol)
{
    int k, turn, over = 0;
    for (turn = 0; turn < 2; turn++) { /* the second time with what the others have set */
        for (k = 0; k < Nodes; k++) over |= update_discrete_states(&Node[k].f);
        close_loops(t, behind, tol);
    }
    for (k = 0; k < Nodes; k++) enter_step_mode(&Node[k].f);
    return over;
}

/* At the last time of all waveforms, t: values after it are a break.  Returns whether an FMU asks for the end. */
static int handle_events(double t, double tol)
{
    int k, held;
    for (k = 0; k < Nodes; k++) {
        enter_event_mode(&Node[k].f);
        for (held = 0; held < 2; held++) {
            waveform *v = &Node[k].w[held];
            const int last = wf_columns(v->w) - 1, broken = last > 0 && !(wf_time(v->w, last) > wf_time(v->w, last - 1));
            const double *before = last_sample(v);
            if (Node[k].numbers[held] > 0 && !broken)
                memcpy(waveform_push(v, wf_time(v->w, last), WF_BREAK), before, (size_t)Node[k].numbers[held] * sizeof(double));
        }
    }
    return update_and_close(t, 1, tol);
}

/* ---- a window ---- */

typedef struct window {
    int steps, cut, event, over; /* cut: an event has been seen at the end; event: is there now; over: so is the simulation's end */
    double start, end, t[STEPS];
} window;

static int same_time(double a, double b)
{
    return fabs(a - b) <= 1e-12 * (1 + fabs(b));
}

static void open_window(window *w, double end, int degree)
{
    int k, held;
    w->end = end;
    for (k = 0; k < w->steps; k++) w->t[k] = w->start + (end - w->start) * (k + 1) / w->steps;
    w->t[w->steps - 1] = end;
    for (k = 0; k < Nodes; k++)
        for (held = 0; held < 2; held++) {
            if (Node[k].numbers[held] == 0) continue;
            good(wf_begin(Node[k].w[held].w, held ? 0 : degree, w->steps, w->t, 0));
            good(wf_copy(Node[k].ahead[held].w, Node[k].w[held].w));
        }
}

/* Where sub-step j ends; in front of the first one the start has one column, or two with a break. */
static double *window_column(const window *w, const waveform *of, int j)
{
    return wf_column(of->w, wf_columns(of->w) - w->steps + j);
}

/* One FMU through the window, its outputs into `ahead`.  Returns the time of an event in front of the end, else the end. */
static double run(node *n, window *w)
{
    double t = w->start, reached;
    int j, held, event, over;
    restore(&n->f);
    n->at_start = 0;
    for (j = 0; j < w->steps; j++) {
        n->from = t;
        set_inputs(n, w->t[j], 0); /* for an FMU that never asks */
        reached = do_step(&n->f, t, w->t[j], &event, &over);
        n->at_start = (event || over) && same_time(reached, w->start);
        if ((event || over) && !same_time(reached, w->end)) return reached;
        w->event |= event;
        w->over |= over;
        t = w->t[j];
        for (held = 0; held < 2; held++)
            if (n->numbers[held] > 0) get_outputs(n, held, window_column(w, &n->ahead[held], j));
    }
    return w->end;
}

/* hx = H(x), and what does not go back: FMUs further on read it at once.  Returns as run does; *changed: held numbers have. */
static double evaluate(window *w, int *changed)
{
    double reached = w->end;
    int k, held;
    *changed = w->event = w->over = 0;
    for (k = 0; k < Nodes; k++) Node[k].at_start = 0;
    for (k = 0; k < Nodes && same_time(reached, w->end); k++) {
        node *n = &Node[k];
        reached = run(n, w);
        for (held = 0; held < 2; held++) {
            const size_t bytes = (size_t)(w->steps * n->numbers[held]) * sizeof(double);
            if (bytes == 0 || (n->goes_back && !held)) continue;
            if (n->goes_back && memcmp(window_column(w, &n->w[1], 0), window_column(w, &n->ahead[1], 0), bytes) != 0) *changed = 1;
            memcpy(window_column(w, &n->w[held], 0), window_column(w, &n->ahead[held], 0), bytes);
        }
    }
    return reached;
}

/* All of x between the waveforms, or what they would be, and an array. */
static void gather(const window *w, double *x, int ahead, int into_x)
{
    int k;
    for (k = 0; k < Nodes; k++) {
        const size_t count = (size_t)(w->steps * Node[k].numbers[0]);
        double *columns;
        if (!Node[k].goes_back || count == 0) continue;
        columns = window_column(w, ahead ? &Node[k].ahead[0] : &Node[k].w[0], 0);
        memcpy(into_x ? x : columns, into_x ? columns : x, count * sizeof(double));
        x += count;
    }
}

/* Events at the start: FMUs that have them stand there, the others go back.  Returns 1 where one asks for the end. */
static int handle_at_start(window *w, double tol)
{
    int k, held;
    for (k = 0; k < Nodes; k++) {
        if (!Node[k].at_start) restore(&Node[k].f);
        for (held = 0; held < 2; held++)
            if (Node[k].numbers[held] > 0) good(wf_rollback(Node[k].w[held].w));
    }
    w->over = handle_events(w->start, tol);
    for (k = 0; k < Nodes; k++) save(&Node[k].f);
    if (w->over) w->end = w->start;
    return w->over;
}

/* An FMU whose steps have one size cannot be cut at an event. */
static void refuse_one_size(const window *w)
{
    int k;
    for (k = 0; k < Nodes; k++)
        if (Node[k].f.one_size)
            stop("%s takes steps of one size (canHandleVariableCommunicationStepSize): no event inside the window at %g",
                 Node[k].f.name, w->start);
}

/* One step of the iteration over the waveforms; returns whether they stand still. */
static int step(const window *w, iqn *q, double *x, double *hx)
{
    gather(w, x, 0, 1);
    gather(w, hx, 1, 1);
    scene_check(iqn_step(q, x, hx), "iqn_step");
    gather(w, x, 0, 0);
    if (iqn_converged(q) == 2) stop("no answer in the window at %g", w->start);
    return iqn_converged(q) == 1;
}

/* Iterate until the waveforms stand still; returns how often all FMUs ran. */
static int solve(window *w, int degree, double tol, iqn *q, double *x, double *hx)
{
    int turns = 0, changed, still = 0;
    open_window(w, w->end, degree);
    w->cut = 0;
    while (!still) {
        const double reached = evaluate(w, &changed);
        if (++turns > CUTS) stop("no answer in the window at %g: its event moves", w->start);
        if (same_time(reached, w->end)) {
            const int stands = q ? step(w, q, x, hx) : 1;
            still = stands && !changed;
            continue;
        }
        refuse_one_size(w);
        if (same_time(reached, w->start)) { /* an event that was a rounding after the last window's end */
            if (handle_at_start(w, tol)) return turns;
            open_window(w, w->end, degree);
            continue;
        }
        open_window(w, reached, degree); /* an event: a shorter window, whose pairs are those of other times */
        w->cut = 1;
        if (q) iqn_discard(q);
    }
    if (q) iqn_commit(q);
    return turns;
}

static void initialise(double start, double end, double tol)
{
    int k, held;
    for (k = 0; k < Nodes; k++) {
        enter_initialization(&Node[k].f, start, end);
        for (held = 0; held < 2; held++) (void)waveform_push(&Node[k].w[held], start, 0);
    }
    close_loops(start, 0, tol);
    for (k = 0; k < Nodes; k++) exit_initialization(&Node[k].f);
}

/* The window's end, with its event: values after it are a break.  Returns whether an FMU asks for the end. */
static int end_window(const window *w, double tol)
{
    int k, held;
    if (!(w->end > w->start)) return w->over; /* it has not even begun */
    for (k = 0; k < Nodes; k++)
        for (held = 0; held < 2; held++)
            if (Node[k].numbers[held] > 0) good(wf_advance(Node[k].w[held].w, held ? 0 : 2 * w->steps));
    if (w->over || !(w->event || w->cut)) return w->over; /* cut: an FMU that is an ulp short of its event says nothing */
    return handle_events(w->end, tol);
}

/* ---- results ---- */

static void watch(const char *name, double t)
{
    char text[256];
    double value[FMI_SIZE];
    const node *n;
    variable v;
    if (!*name) return;
    n = node_of(name, text, sizeof text);
    v = find_variable(&n->f, text);
    get(&n->f, &v, value);
    printf("%.12g %.15g\n", t, value[0]);
}

static void write_value(FILE *csv, const fmu *f, const variable *v) /* of an array its entries, with spaces between */
{
    double value[FMI_SIZE];
    int j;
    get(f, v, value);
    for (j = 0; j < v->size; j++) fprintf(csv, "%c%.16g", j > 0 ? ' ' : ',', value[j]);
}

/* A row of all outputs that are numbers; a row of names where t is NaN. */
static void write_row(FILE *csv, double t)
{
    const int names = t != t;
    int k;
    if (!csv) return;
    if (names) fprintf(csv, "time");
    else fprintf(csv, "%.16g", t);
    for (k = 0; k < Nodes; k++) {
        const fmu *f = &Node[k].f;
        const char *tag = find_tag(f, "ModelVariables");
        while (tag && (tag = next_variable(tag)) != NULL) {
            const variable v = read_variable(f, tag);
            if (!v.output || !is_number(&v)) continue;
            if (names) fprintf(csv, Nodes > 1 ? ",%s.%s" : ",%.0s%s", f->name, v.name);
            else write_value(csv, f, &v);
        }
    }
    fputc('\n', csv);
}

static void remove_unpacked(void)
{
    int k;
    for (k = 0; k < Nodes; k++) unload(&Node[k].f);
}

static void make_waveforms(int degree)
{
    int k, held;
    for (k = 0; k < Nodes; k++)
        for (held = 0; held < 2; held++) {
            Node[k].w[held] = waveform_make(held ? 0 : degree, Node[k].numbers[held], 4 * (STEPS + degree));
            Node[k].ahead[held] = waveform_make(held ? 0 : degree, Node[k].numbers[held], 4 * (STEPS + degree));
        }
}

/* Takes --set and what follows out of the arguments, for it may come several times; returns how many are left. */
static int take_starts(int argc, char **argv, const char **starts, int *set_count)
{
    int k, count = 1;
    for (k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--set") != 0) argv[count++] = argv[k];
        else if (k + 1 < argc && *set_count < LINKS) starts[(*set_count)++] = argv[++k];
        else stop("--set FMU.variable=value, at most %d times", LINKS);
    }
    return count;
}

/* FMUs, then connections, of the arguments in front of the options */
static void load_all(int count, char **argv)
{
    int k;
    for (k = 1; k < count; k++) {
        if (strchr(argv[k], '=')) continue;
        if (Nodes == FMUS) stop("more than %d FMUs", FMUS);
        load(&Node[Nodes++].f, argv[k]);
    }
    for (k = 1; k < count; k++)
        if (strchr(argv[k], '=')) connect(argv[k]);
    if (Nodes == 0) stop("%s FMU... [CONSUMER.input=PRODUCER.output...]; -h lists the options", argv[0]);
}

/* Returns how many numbers go back in a sub-step: those that are iterated. */
static int instantiate_all(void)
{
    int k, n = 0;
    for (k = 0; k < Nodes; k++) {
        instantiate(&Node[k].f, update);
        if (Node[k].goes_back) n += Node[k].numbers[0];
    }
    return n;
}

typedef struct plan { /* of a simulation */
    int windows, degree;
    double end, tol;
    const char *watched;
    FILE *csv;
} plan;

/* All windows, from w->start = 0; an event on the way makes one more. */
static void simulate(const plan *p, window *w, iqn *q, double *x, double *hx)
{
    const double tol = p->tol / 100;
    int k, turns, over, win = 0, made = 0, total = 0, most = 0;
    write_row(p->csv, NAN);
    initialise(0, p->end, tol);
    over = update_and_close(0, 0, tol);
    write_row(p->csv, 0);
    for (w->start = 0; !over && win < p->windows; made++) {
        const double regular = p->end * (win + 1) / p->windows;
        w->end = regular;
        for (k = 0; k < Nodes; k++) save(&Node[k].f);
        turns = solve(w, p->degree < 2 ? p->degree : 2, tol, q, x, hx);
        total += turns;
        most = turns > most ? turns : most;
        over = end_window(w, tol);
        w->start = w->end;
        if (!same_time(w->end, regular) && !over) continue;
        win++;
        watch(p->watched, w->end);
        write_row(p->csv, w->end);
    }
    if (over) fprintf(stderr, "an FMU asks to end the simulation at %g\n", w->end);
    printf("windows %d\niterations %d\niterations_most %d\n", made, total, most);
}

int main(int argc, char **argv)
{
    static const char *const methods[] = {"ils", "imvj", "aitken", "constant", NULL};
    scene_option o[] = {{"stop", "1", "end; the start is 0"},
                        {"windows", "10", "windows up to the end"},
                        {"steps", "4", "sub-steps of a window"},
                        {"degree", "3", "of the waveforms; 0: values are held"},
                        {"tol", "1e-9", "of a window, relative"},
                        {"method", "ils", "ils, imvj, aitken, constant"},
                        {"omega", "0.1", "relaxation factor"},
                        {"watch", "", "FMU.variable to print at every window end"},
                        {"csv", "", "file for all outputs at every window end"},
                        {NULL, NULL, NULL}};
    const char *starts[LINKS];
    int first = 1, k, n, set_count = 0;
    double *x, *hx;
    plan p;
    window w;
    iqn *q = NULL;

    argc = take_starts(argc, argv, starts, &set_count);
    while (first < argc && argv[first][0] != '-') first++;
    scene_parse(argc - first + 1, argv + first - 1,
                "FMU... [CONSUMER.input=PRODUCER.output...] [--set FMU.variable=value...]: a master for FMI 3.0 and 2.0", o);
    p.end = scene_number(o, "stop", 1e-9, 1e12);
    p.tol = scene_number(o, "tol", 1e-14, 1);
    p.windows = scene_integer(o, "windows", 1, 1000000);
    p.degree = scene_integer(o, "degree", 0, WF_MAX_DEGREE);
    p.watched = scene_text(o, "watch");
    w.steps = scene_integer(o, "steps", 1, STEPS);
    atexit(remove_unpacked);
    load_all(first, argv);
    n = w.steps * instantiate_all();
    for (k = 0; k < set_count; k++) set_start(starts[k]);
    make_waveforms(p.degree);
    x = (double *)scene_memory((size_t)(n + 1) * sizeof(double));
    hx = (double *)scene_memory((size_t)(n + 1) * sizeof(double));
    if (n > 0) q = make_iqn(n, scene_choice(o, "method", methods), scene_number(o, "omega", -1e3, 1e3), p.tol);
    p.csv = scene_file(o, "csv", "");
    simulate(&p, &w, q, x, hx);
    if (p.csv) fclose(p.csv);
    for (k = 0; k < Nodes; k++) terminate(&Node[k].f);
    free(x);
    free(hx);
    free(q);
    return 0;
}
