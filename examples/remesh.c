/* SPDX-License-Identifier: MIT

   remesh.c - the number of unknowns changes ten times during a coupled run, and nothing restarts.

      u_t = Du u_xx + b(x) (v - u) + su     one solver, n points on 0 < x < 1, reads v as a waveform
      v_t = Dv v_xx + b(x) (u - v) + sv     another one, reads u

   The sources make u = 1 + sin(pi x) (1 + sin(2t)/2), v = 1 + sin(pi x) + sin(2 pi x) cos(t)/2 exact.  In each time
   window both take a step of an SDIRK table, at first with a guess of the other one's waveform; quasi-Newton makes them
   agree (x = H(x): v at the samples of the window), the pair of the table chooses the next window.  b up to 100 times the
   inverse window: a plain iteration needs hundreds of sweeps.

   After every few windows the mesh is refined or coarsened, by the host's transfer, a linear interpolation:
      state, waveform history   column by column; the grid of times knows nothing of n and stays
      secant pairs              iqn_pair, transfer of both halves, iqn_push into an object of the new length, oldest
                                first; iqn_commit makes them a past window
      step control, window      stay as they are  */
#define WF_IMPLEMENTATION
#include "waveform.h"
#define IQN_IMPLEMENTATION
#include "iqn.h"
#define RK_IMPLEMENTATION
#include "rk.h"
#include "scene.h"

enum { MOST = 400, SAMPLES = 2, HISTORY = 4, COLUMNS = HISTORY + 1 + SAMPLES, STAGES = 8, PAIRS = 20 };

static double B;
static int n, degree;

extern void dgtsv_(const int *n, const int *nrhs, double *dl, double *d, double *du, double *b, const int *ldb,
                   int *info);

/* ---- the two solvers --------------------------------------------------------------------------------------------- */

static const double diffusion[2] = {0.01, 0.002}, pi = 3.14159265358979323846;

static double coefficient(double x)
{
    return B * (1 + 0.9 * sin(7 * x));
}

static double exact(int who, double x, double t)
{
    if (who == 0) return 1 + sin(pi * x) * (1 + sin(2 * t) / 2);
    return 1 + sin(pi * x) + sin(2 * pi * x) * cos(t) / 2;
}

static double source(int who, double x, double t)
{
    const double one = sin(pi * x), two = sin(2 * pi * x),
                 exchange = coefficient(x) * (exact(1 - who, x, t) - exact(who, x, t));
    const double rate = who == 0 ? one * cos(2 * t) : -two * sin(t) / 2;
    const double curvature = -pi * pi * (who == 0 ? one * (1 + sin(2 * t) / 2) : one + 2 * two * cos(t));
    return rate - diffusion[who] * curvature - exchange;
}

/* Solve Z - g (D Z_xx - b Z) = base + g (b other + source), k = (Z - base)/g. */
static void implicit_stage(int who, double t, double g, const double *base, const double *other, double *k)
{
    static double lower[MOST], middle[MOST], upper[MOST], Z[MOST];
    const double dx = 1. / (n + 1), d = diffusion[who] / (dx * dx);
    const int one = 1;
    int i, info;
    for (i = 0; i < n; i++) {
        const double x = (i + 1) * dx, b = coefficient(x);
        lower[i] = upper[i] = -g * d;
        middle[i] = 1 + g * (2 * d + b);
        Z[i] = base[i] + g * (b * other[i] + source(who, x, t));
    }
    Z[0] += g * d * exact(who, 0, t);
    Z[n - 1] += g * d * exact(who, 1, t);
    dgtsv_(&n, &one, lower, middle, upper, Z, &n, &info);
    for (i = 0; i < n; i++) k[i] = (Z[i] - base[i]) / g;
}

/* A field in time, the state at the window start, the slopes of the step */
typedef struct field {
    waveform w;
    double y[MOST], k[STAGES * MOST], ynew[MOST], err[MOST];
} field;

/* One step of `mine` over the window from t; out: its samples at the window's times. */
static void window_step(const rk_table *T, int who, double t, double H, field *mine, const field *other, double *out)
{
    double base[MOST], read[MOST];
    const rk_step step = {T, H, n, mine->y, mine->k, n};
    int i, j;
    for (i = 0; i < T->stages; i++) {
        const double time = t + T->c[i] * H;
        rk_stage(T, i, H, n, mine->y, mine->k, n, base);
        waveform_read(&other->w, time, 0, read);
        implicit_stage(who, time, H * T->A[i * T->stages + i], base, read, mine->k + i * n);
    }
    rk_finish(T, H, n, mine->y, mine->k, n, mine->ynew, mine->err);
    for (j = wf_start(mine->w.w) + 1; j < wf_columns(mine->w.w); j++, out += n)
        rk_dense(&step, (wf_time(mine->w.w, j) - t) / H, 0, out);
}

/* ---- the transfer ------------------------------------------------------------------------------------------------ */

/* out = `count` vectors of m numbers, one after the other, from as many of n; `edge` is their value at both ends.  out may
   be x.  waveform.h does not mind that its times are places here: a column is what all vectors have at one place. */
static void transfer(int count, int m, double edge, const double *x, double *out)
{
    double *column = (double *)scene_memory((size_t)count * sizeof *column);
    waveform w = waveform_make(degree, count, n + 2);
    int i, j;
    for (i = 0; i < n + 2; i++) {
        double *there = waveform_push(&w, (double)i / (n + 1), 0);
        for (j = 0; j < count; j++) there[j] = i > 0 && i <= n ? x[j * n + i - 1] : edge;
    }
    for (i = 0; i < m; i++) {
        waveform_read(&w, (i + 1.) / (m + 1), 0, column);
        for (j = 0; j < count; j++) out[j * m + i] = column[j];
    }
    waveform_free(&w);
    free(column);
}

static iqn *make_iqn(int m, double tolerance, void **mem)
{
    const size_t bytes = iqn_size(SAMPLES * m, PAIRS, 1);
    iqn *q;
    int status;
    *mem = scene_memory(bytes);
    status = iqn_make(&q, SAMPLES * m, PAIRS, 1, *mem, bytes);
    scene_check(status, iqn_message(status));
    iqn_set(q, IQN_TOL_RELATIVE, tolerance);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    return q;
}

/* The secant pairs of q on m points; newest and oldest keep their places. */
static iqn *remesh_pairs(iqn *q, int m, double tolerance, void **mem)
{
    static double v[SAMPLES * MOST], w[SAMPLES * MOST];
    void *old = *mem;
    iqn *fresh = make_iqn(m, tolerance, mem);
    int j = 0, status;
    while (iqn_pair(q, j, NULL, NULL) >= 0) j++;
    while (j-- > 0) {
        iqn_pair(q, j, v, w);
        transfer(SAMPLES, m, 0, v, v);
        transfer(SAMPLES, m, 0, w, w);
        status = iqn_push(fresh, v, w);
        scene_check(status, iqn_message(status));
    }
    iqn_commit(fresh);
    free(old);
    return fresh;
}

static void remesh_field(field *F, int m)
{
    waveform old = F->w;
    F->w = waveform_make(3, m, COLUMNS);
    wf_copy(F->w.w, old.w); /* the times */
    transfer(wf_columns(old.w), m, 1, wf_column(old.w, 0), wf_column(F->w.w, 0));
    transfer(1, m, 1, F->y, F->y);
    waveform_free(&old);
}

/* ---- the run ----------------------------------------------------------------------------------------------------- */

static void open_field(field *F, int who)
{
    double *start;
    int i;
    F->w = waveform_make(3, n, COLUMNS);
    start = waveform_push(&F->w, 0, 0);
    for (i = 0; i < n; i++) F->y[i] = start[i] = exact(who, (i + 1.) / (n + 1), 0);
}

typedef struct run {
    const rk_table *T;
    rk_control C;
    field F[2];
    iqn *q;
    void *mem;
    double t, H, rtol, tolerance, longest;
    int window, changes, last, jump, total, rejected;
} run;

static void start_control(run *R)
{
    rk_control_make(&R->C, "PI", R->T);
    R->C.largest = R->longest;
    R->H = 0.02;
}

/* A window: iterations until both agree; their number */
static int iterate(run *R)
{
    static double hx[SAMPLES * MOST];
    double times[SAMPLES];
    field *F = R->F;
    int k, status, count = 0;
    for (k = 0; k < SAMPLES; k++) times[k] = R->t + (k + 1) * R->H / SAMPLES;
    for (k = 0; k < 2; k++) {
        status = wf_begin(F[k].w.w, 2, SAMPLES, times, 0);
        scene_check(status, wf_message(status));
    }
    do {
        window_step(R->T, 0, R->t, R->H, &F[0], &F[1], waveform_window(&F[0].w));
        window_step(R->T, 1, R->t, R->H, &F[1], &F[0], hx);
        status = iqn_step(R->q, waveform_window(&F[1].w), hx);
        scene_check(status, iqn_message(status));
        count++;
    } while (iqn_converged(R->q) == 0);
    if (iqn_converged(R->q) == 2) {
        fprintf(stderr, "window %d gave up after %d iterations\n", R->window + 1, count);
        exit(1);
    }
    return count;
}

/* Iterate, estimate the error, accept or not.  The pairs of a rejected window are kept: the map is the same, of a longer
   window.  first: the mesh has just changed. */
static int one_window(run *R, int first)
{
    const int count = iterate(R);
    double sum[2] = {0};
    int k, status;
    for (k = 0; k < 2; k++) rk_norm(R->rtol, R->rtol, NULL, n, R->F[k].err, R->F[k].y, R->F[k].ynew, sum);
    status = rk_control_step(&R->C, rk_rms(sum), &R->t, &R->H);
    scene_check(status, rk_message(status));
    iqn_commit(R->q);
    R->total += count;
    R->rejected += status == RK_REJECT;
    if (status == RK_REJECT) return 0;
    for (k = 0; k < 2; k++) {
        memcpy(R->F[k].y, R->F[k].ynew, (size_t)n * sizeof *R->F[k].y);
        wf_advance(R->F[k].w.w, HISTORY);
    }
    R->window++;
    printf("window %3d  t %.4f  n %3d  iterations %2d  next window %.4f\n", R->window, R->t, n, count, R->H);
    if (first && count - R->last > R->jump) R->jump = count - R->last;
    R->last = count;
    return 1;
}

static void change_mesh(run *R, int m, int carry)
{
    int k;
    R->changes++;
    for (k = 0; k < 2; k++) remesh_field(&R->F[k], m);
    if (carry) R->q = remesh_pairs(R->q, m, R->tolerance, &R->mem);
    else {
        free(R->mem);
        R->q = make_iqn(m, R->tolerance, &R->mem);
        start_control(R);
        for (k = 0; k < 2; k++) wf_advance(R->F[k].w.w, 0);
    }
    n = m;
}

static double largest_error(const run *R)
{
    double error = 0;
    int k, i;
    for (k = 0; k < 2; k++)
        for (i = 0; i < n; i++) error = fmax(error, fabs(R->F[k].y[i] - exact(k, (i + 1.) / (n + 1), R->t)));
    return error;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"n", "49", "points of the coarsest mesh; refined: 2n + 1, 4n + 3"},
                        {"every", "8", "windows between two changes of the mesh"},
                        {"changes", "10", "how often the mesh changes"},
                        {"carry", "1", "0: pairs, history and step control start anew on each mesh"},
                        {"transfer", "3", "degree of the spline between meshes"},
                        {"b", "1000", "strength of the coupling"},
                        {"table", "sdirk4", "an SDIRK table of rk.h with a pair"},
                        {"longest", "0.05", "longest window"},
                        {"rtol", "1e-4", "of a step"},
                        {"tolerance", "1e-7", "of the iteration, relative"},
                        {NULL, NULL, NULL}};
    static const int cycle[] = {1, 2, 4, 2};
    static run R;
    int coarse, every, changes, carry, mesh, k;
    scene_parse(argc, argv, "a coupled run whose mesh changes: history, secant pairs and step control are carried over",
                o);
    n = coarse = scene_integer(o, "n", 4, MOST / 5);
    every = scene_integer(o, "every", 2, 1000);
    changes = scene_integer(o, "changes", 0, 1000);
    carry = scene_integer(o, "carry", 0, 1);
    degree = scene_integer(o, "transfer", 1, WF_MAX_DEGREE);
    B = scene_perturbed("b", scene_number(o, "b", 0, 1e6));
    R.rtol = scene_number(o, "rtol", 1e-12, 1);
    R.tolerance = scene_number(o, "tolerance", 1e-14, 1);
    R.longest = scene_number(o, "longest", 1e-6, 10);
    R.T = rk_find(scene_text(o, "table"));
    if (!R.T || !R.T->order_hat || R.T->stages > STAGES || R.T->A[0] == 0 || rk_is(R.T, RK_SEQUENTIAL) != 1) {
        fprintf(stderr, "--table: %s is no SDIRK table of rk.h with a pair\n", scene_text(o, "table"));
        return 2;
    }
    for (k = 0; k < 2; k++) open_field(&R.F[k], k);
    R.q = make_iqn(n, R.tolerance, &R.mem);
    start_control(&R);
    for (mesh = 0; mesh <= changes; mesh++) {
        if (mesh > 0) change_mesh(&R, cycle[mesh % 4] * (coarse + 1) - 1, carry);
        for (k = 0; k < every;) k += one_window(&R, mesh > 0 && k == 0);
    }
    printf("changes %d\niterations %d\nrejected %d\nworst_jump %d\n", R.changes, R.total, R.rejected, R.jump);
    printf("end %.4f\nerror %.3e\n", R.t, largest_error(&R));
    free(R.mem);
    return 0;
}
