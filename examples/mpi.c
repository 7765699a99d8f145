/* SPDX-License-Identifier: MIT

   mpi.c - iqn.h on a distributed interface: every rank owns a piece of x, the last rank owns none.  The whole of the
   communication is the sum below, and with --predict one more in a window, for a first guess of the degree that would
   have foretold the last window ends best.  --trace takes two more in the end: of which degree is the spline through the
   window ends, and how exact is it between them?  mpirun -np 4 build/mpi gives the iterations of mpirun -np 1.

   --fields 2: two solvers, each on a communicator of its own, the first half of the ranks and the rest.  x has a block for
   each field; a rank has the length 0 of the other one's.  The sum of iqn.h goes over both.  The solvers themselves exchange
   what they need over the intercommunicator. */
#define WF_IMPLEMENTATION
#include "waveform.h"
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include "scene.h"

#include <mpi.h>

typedef struct counter {
    MPI_Comm comm;
    int calls;
} counter;

static int sum_over_ranks(double *v, int count, void *ctx)
{
    counter *c = (counter *)ctx;
    c->calls++;
    return MPI_Allreduce(MPI_IN_PLACE, v, count, MPI_DOUBLE, MPI_SUM, c->comm) != MPI_SUCCESS;
}

/* h_i = c_i(t) - d_i x_i + sin(x_i)/2 with d from 0 to `stiff`: stiffer than any relaxation stands */
static void H(long first, long n, long total, double time, double stiff, const double *x, double *h)
{
    long i;
    for (i = 0; i < n; i++) {
        const double s = (double)(first + i) / (double)total;
        h[i] = cos(20 * s + time) - stiff * s * s * s * x[i] + 0.5 * sin(x[i]);
    }
}

/* x = H(x), number by number by Newton's method. */
static void exact(long first, long n, long total, double time, double stiff, double *x)
{
    double h;
    long i;
    int j;
    for (i = 0; i < n; i++) {
        const double s = (double)(first + i) / (double)total;
        for (x[i] = 0, j = 0; j < 50; j++) {
            H(first + i, 1, total, time, stiff, &x[i], &h);
            x[i] += (h - x[i]) / (1 + stiff * s * s * s - 0.5 * cos(x[i]));
        }
    }
}

/* ---- what ranks have to agree on --------------------------------------------------------------------------------- */

enum { DEGREE = 3, COLUMNS = 15 };

/* The degree of a first guess: by the misses of all ranks in one sum. */
static int common_guess(MPI_Comm comm, const waveform *x)
{
    double squares[WF_MISSES];
    scene_check(wf_foretell(x->w, squares), "wf_foretell");
    MPI_Allreduce(MPI_IN_PLACE, squares, WF_MISSES, MPI_DOUBLE, MPI_SUM, comm);
    return wf_foretell(NULL, squares);
}

/* The degree between window ends: by the largest estimate of all ranks. */
static int common_degree(MPI_Comm comm, const waveform *x, const waveform *other)
{
    double estimate[DEGREE + 1];
    scene_check(wf_choose(x->w, other->w, estimate), "wf_choose");
    MPI_Allreduce(MPI_IN_PLACE, estimate, DEGREE + 1, MPI_DOUBLE, MPI_MAX, comm);
    scene_check(wf_choose(x->w, NULL, estimate), "wf_choose");
    return wf_degree(x->w);
}

/* Norms over all ranks, halfway through the last window: of the estimate of wf_error, and of what it estimates. */
static void trace_errors(MPI_Comm comm, const waveform *x, const waveform *other, double t, long n, const double *truth,
                         double norm[2])
{
    double *v = (double *)scene_memory((size_t)(2 * n + 2) * sizeof *v);
    long i;
    scene_check(wf_error(x->w, other->w, v), "wf_error");
    waveform_read(x, t, 0, v + n + 1);
    for (norm[0] = norm[1] = 0, i = 0; i < n; i++) {
        const double off = truth[i] - v[n + 1 + i];
        norm[0] += v[i] * v[i];
        norm[1] += off * off;
    }
    free(v);
    MPI_Allreduce(MPI_IN_PLACE, norm, 2, MPI_DOUBLE, MPI_SUM, comm);
    norm[0] = sqrt(norm[0]), norm[1] = sqrt(norm[1]);
}

/* ---- two fields on two communicators ----------------------------------------------------------------------------- */

typedef struct pieces {
    long n, first[2], length[2]; /* of either field: its numbers on all ranks, those here */
    int field;                   /* the one of this rank */
    MPI_Comm between;            /* to the other field's ranks; MPI_COMM_NULL: they are here, too */
} pieces;

static const double unit_of[2] = {1, 1000}; /* the second field in a unit that makes it large */

static void share(pieces *p, long n, int rank, int ranks)
{
    const int half = ranks / 2, field = rank >= half, size = field ? ranks - half : half, own = field ? rank - half : rank;
    MPI_Comm group;
    int f;
    p->n = n, p->field = field, p->between = MPI_COMM_NULL;
    for (f = 0; f < 2; f++) p->first[f] = 0, p->length[f] = ranks == 1 ? n : 0;
    if (ranks == 1) return;
    p->first[field] = n * own / size;
    p->length[field] = n * (own + 1) / size - p->first[field];
    MPI_Comm_split(MPI_COMM_WORLD, field, rank, &group);
    MPI_Intercomm_create(group, 0, MPI_COMM_WORLD, field ? 0 : half, 0, &p->between);
    MPI_Comm_free(&group);
}

/* As H, but each field feels the mean of the other one. */
static void H_two(const pieces *p, double time, double stiff, const double *x, double *h)
{
    static const double push[2] = {-0.9, 0.7};
    double sum[2] = {0, 0}, theirs;
    long i;
    int f;
    for (f = 0; f < 2; f++) {
        H(p->first[f], p->length[f], p->n, time + f, stiff, x + f * p->length[0], h + f * p->length[0]);
        for (i = 0; i < p->length[f]; i++) sum[f] += x[f * p->length[0] + i];
    }
    if (p->between != MPI_COMM_NULL) { /* each side gets the other side's sum */
        MPI_Allreduce(&sum[p->field], &theirs, 1, MPI_DOUBLE, MPI_SUM, p->between);
        sum[1 - p->field] = theirs;
    }
    for (f = 0; f < 2; f++)
        for (i = 0; i < p->length[f]; i++) h[f * p->length[0] + i] += push[f] * sum[1 - f] / (double)p->n;
}

static int two_fields(counter *c, const pieces *p, int windows, int columns, double stiff, double tol, int rank, int ranks)
{
    const long n = p->length[0] + p->length[1];
    const size_t bytes = iqn_size(n, columns, 2), numbers = (size_t)(n + 1) * sizeof(double);
    double *x = (double *)scene_memory(numbers), *hx = (double *)scene_memory(numbers), *y = (double *)scene_memory(numbers);
    int w, status = 0, total = 0;
    long i;
    iqn *q;
    scene_check(iqn_make(&q, n, columns, 2, scene_memory(bytes), bytes), "iqn_make");
    iqn_set_sum(q, sum_over_ranks, c);
    iqn_set_block(q, 0, IQN_LENGTH, (double)p->length[0]);
    iqn_set_block(q, 1, IQN_LENGTH, (double)p->length[1]);
    iqn_set_block(q, -1, IQN_SCALING, IQN_BY_VALUE);
    iqn_set_block(q, -1, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    for (w = 0; w < windows; w++) {
        do {
            for (i = 0; i < n; i++) y[i] = x[i] / unit_of[i >= p->length[0]];
            H_two(p, 0.1 * w, stiff, y, hx);
            for (i = 0; i < n; i++) hx[i] *= unit_of[i >= p->length[0]];
            status = iqn_step(q, x, hx);
            scene_check(status, iqn_message(status));
            total++;
        } while (!iqn_converged(q));
        iqn_commit(q);
    }
    if (rank == 0) {
        printf("ranks %d\niterations %d\nsums_per_iteration %g\n", ranks, total, (double)c->calls / total);
        printf("norm_0 %.15e\nnorm_1 %.15e\nconverged %d\n", iqn_get_block(q, 0, IQN_VALUE), iqn_get_block(q, 1, IQN_VALUE),
               status == IQN_SOLVED);
    }
    free(x), free(hx), free(y), free(q);
    return status != IQN_SOLVED;
}

int main(int argc, char **argv)
{
    static scene_option o[] = {{"n", "20000", "length of x over all ranks"},
                               {"windows", "5", "time windows"},
                               {"columns", "40", "secant pairs kept"},
                               {"stiffness", "5", "steepest slope of H"},
                               {"tol", "1e-9", "relative limit"},
                               {"predict", "0", "1: a first guess of each window from the windows before"},
                               {"trace", "0", "1: the error of the spline through the window ends between the last two"},
                               {"fields", "1", "2: two fields of length n on two communicators"},
                               {NULL, NULL, NULL}};
    pieces p;
    counter c = {MPI_COMM_WORLD, 0};
    int rank, ranks, owners, columns, windows, predict, trace, degree, w, status = 0, total = 0, most = 0, before;
    long n, first, i;
    double *x, *h, stiff, tol, norm[2], t;
    size_t bytes;
    waveform ends, other; /* x at the window ends; work space */
    iqn *q;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(c.comm, &rank);
    MPI_Comm_size(c.comm, &ranks);
    scene_parse(argc, argv, "quasi-Newton iteration on a distributed interface", o);
    n = scene_integer(o, "n", 1, 100000000);
    windows = scene_integer(o, "windows", 1, 1000);
    columns = scene_integer(o, "columns", 0, 1000);
    stiff = scene_number(o, "stiffness", 0, 1e6);
    tol = scene_number(o, "tol", 1e-14, 1);
    predict = scene_integer(o, "predict", 0, 1);
    trace = scene_integer(o, "trace", 0, 1);
    if (scene_integer(o, "fields", 1, 2) == 2) {
        share(&p, n, rank, ranks);
        status = two_fields(&c, &p, windows, columns, stiff, tol, rank, ranks);
        if (p.between != MPI_COMM_NULL) MPI_Comm_free(&p.between);
        MPI_Finalize();
        return status;
    }

    owners = ranks > 1 ? ranks - 1 : 1; /* the last rank has no interface */
    first = rank < owners ? n * rank / owners : n;
    i = rank < owners ? n * (rank + 1) / owners - first : 0;
    bytes = iqn_size(i, columns, 1);
    scene_check(iqn_make(&q, i, columns, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set_sum(q, sum_over_ranks, &c);
    iqn_set(q, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    h = (double *)scene_memory((size_t)(i + 1) * sizeof *h);
    ends = waveform_make(DEGREE, i > 0 ? (int)i : 1, COLUMNS); /* a rank without a piece: a zero */
    other = waveform_make(DEGREE + 2, 0, COLUMNS);
    x = waveform_push(&ends, 0, 0);
    for (w = 0; w < windows; w++) {
        if (w > 0) {
            wf_advance(ends.w, COLUMNS - 2);
            t = w;
            status = wf_begin(ends.w, predict ? common_guess(c.comm, &ends) : 0, 1, &t, 0);
            scene_check(status, wf_message(status));
            x = waveform_window(&ends);
        }
        do {
            H(first, i, n, 0.1 * w, stiff, x, h);
            before = c.calls;
            status = iqn_step(q, x, h);
            scene_check(status, iqn_message(status));
            if (c.calls - before > most) most = c.calls - before;
        } while (!iqn_converged(q));
        if (rank == 0) printf("window %d iterations %g %s\n", w + 1, iqn_get(q, IQN_ITERATIONS), iqn_message(status));
        total += (int)iqn_get(q, IQN_ITERATIONS);
        iqn_commit(q);
    }
    if (trace) {
        exact(first, i, n, 0.1 * (w - 1.5), stiff, h);
        degree = common_degree(c.comm, &ends, &other);
        trace_errors(c.comm, &ends, &other, w - 1.5, i, h, norm);
        if (rank == 0) printf("chosen_degree %d\ntrace_estimate %.3e\ntrace_error %.3e\n", degree, norm[0], norm[1]);
    }
    if (rank == 0) {
        printf("ranks %d\niterations %d\nsums_per_iteration %d\nnorm %.15e\n", ranks, total, most, iqn_get(q, IQN_VALUE));
        printf("converged %d\n", status == IQN_SOLVED);
    }
    MPI_Finalize();
    return status != IQN_SOLVED;
}
