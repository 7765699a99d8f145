/* SPDX-License-Identifier: MIT

   mpi.c - iqn.h on a distributed interface: every rank owns a piece of x, the last rank owns none.  The whole of the
   communication is the sum below, and with --predict one more in a window, for a first guess of the degree that would
   have foretold the last window ends best.  --trace takes one more in the end: how exact is the spline through the
   window ends between them?  mpirun -np 4 build/mpi gives the iterations of mpirun -np 1.                            */
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

/* ---- the first guess of a window --------------------------------------------------------------------------------- */

enum { ENDS = 5, DEGREES = 10, COLUMNS = DEGREES + ENDS };

/* wf_predict_degree for samples that are spread over ranks: by its rule, on the norms of all misses in one sum. */
static int spread_degree(MPI_Comm comm, const waveform *w)
{
    double squares[DEGREES * ENDS], weight[COLUMNS], *miss = (double *)scene_memory((size_t)(w->n + 1) * sizeof(double));
    double least = 0;
    int degree, ago, i, best = 0;
    for (degree = 0; degree < DEGREES; degree++)
        for (ago = 0; ago < ENDS; ago++) {
            double *square = &squares[degree * ENDS + ago];
            *square = -1; /* the history does not reach so far: on all ranks alike */
            if (wf_hindsight(w->grid, degree, ago, weight) < 0) continue;
            scene_check(wf_combine(1, wf_columns(w->grid), weight, w->n, w->x, w->n, miss, w->n), "wf_combine");
            for (*square = 0, i = 0; i < w->n; i++) *square += miss[i] * miss[i];
        }
    free(miss);
    MPI_Allreduce(MPI_IN_PLACE, squares, DEGREES * ENDS, MPI_DOUBLE, MPI_SUM, comm);
    for (degree = 0; degree < DEGREES; degree++) {
        double mean = 0;
        int ends = 0;
        for (ago = 0; ago < ENDS; ago++)
            if (squares[degree * ENDS + ago] >= 0) mean += sqrt(sqrt(squares[degree * ENDS + ago])), ends++;
        if (ends == 0) break;
        mean /= ends;
        if (degree > 0 && !(mean < least / sqrt(1.5))) continue;
        least = mean;
        best = degree;
    }
    return best;
}

/* x, the answer of window w, joins the window ends. */
static void keep_end(int w, waveform *ends, const double *x)
{
    memcpy(waveform_push(ends, w), x, (size_t)ends->n * sizeof *x);
    if (w > 0) waveform_advance(ends, COLUMNS - 2);
}

/* The first guess of window w + 1. */
static void guess_next(MPI_Comm comm, int ranks, int w, const waveform *ends, double *x)
{
    double weight[COLUMNS];
    int degree, status;
    if (w == 0) return;
    degree = ranks > 1 ? spread_degree(comm, ends) : wf_predict_degree(ends->grid, ends->n, ends->x, ends->n);
    scene_check(degree, wf_message(degree));
    status = wf_predict(ends->grid, degree, w + 1, weight);
    scene_check(status, wf_message(status));
    scene_check(wf_combine(1, wf_columns(ends->grid), weight, ends->n, ends->x, ends->n, x, ends->n), "wf_combine");
}

/* ---- between the window ends ------------------------------------------------------------------------------------- */

/* Norms over all ranks, halfway between two window ends: of what wf_error_weights says that the spline through them
   lacks, and of what it lacks. */
static void trace_errors(MPI_Comm comm, const waveform *ends, double t, const double *truth, double norm[2])
{
    double weight[COLUMNS], *v = (double *)scene_memory((size_t)(2 * ends->n + 1) * sizeof *v);
    const int status = wf_error_weights(ends->grid, t, weight);
    int i;
    scene_check(status, wf_message(status));
    scene_check(wf_combine(1, wf_columns(ends->grid), weight, ends->n, ends->x, ends->n, v, ends->n), "wf_combine");
    waveform_interpolate(ends, t, 0, v + ends->n);
    for (norm[0] = norm[1] = 0, i = 0; i < ends->n; i++) {
        const double off = truth[i] - v[ends->n + i];
        norm[0] += v[i] * v[i];
        norm[1] += off * off;
    }
    free(v);
    MPI_Allreduce(MPI_IN_PLACE, norm, 2, MPI_DOUBLE, MPI_SUM, comm);
    norm[0] = sqrt(norm[0]), norm[1] = sqrt(norm[1]);
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
                               {NULL, NULL, NULL}};
    counter c = {MPI_COMM_WORLD, 0};
    int rank, ranks, owners, columns, windows, predict, trace, w, status = 0, total = 0, most = 0, before;
    long n, first, i;
    double *x, *h, stiff, tol, norm[2];
    size_t bytes;
    waveform ends;
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

    owners = ranks > 1 ? ranks - 1 : 1; /* the last rank has no interface */
    first = rank < owners ? n * rank / owners : n;
    i = rank < owners ? n * (rank + 1) / owners - first : 0;
    bytes = iqn_size(i, columns, 1);
    scene_check(iqn_make(&q, i, columns, 1, scene_memory(bytes), bytes), "iqn_make");
    iqn_set_sum(q, sum_over_ranks, &c);
    iqn_set(q, IQN_TOL_RELATIVE, tol);
    iqn_set(q, IQN_MAX_ITERATIONS, 200);
    x = (double *)scene_memory((size_t)(i + 1) * sizeof *x);
    h = (double *)scene_memory((size_t)(i + 1) * sizeof *h);
    if (predict || trace) ends = waveform_make(3, (int)i, COLUMNS);
    for (w = 0; w < windows; w++) {
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
        if (predict || trace) keep_end(w, &ends, x);
        if (predict) guess_next(c.comm, ranks, w, &ends, x);
    }
    if (trace) {
        exact(first, i, n, 0.1 * (w - 1.5), stiff, h);
        trace_errors(c.comm, &ends, w - 1.5, h, norm);
        if (rank == 0) printf("trace_estimate %.3e\ntrace_error %.3e\n", norm[0], norm[1]);
    }
    if (rank == 0) {
        printf("ranks %d\niterations %d\nsums_per_iteration %d\nnorm %.15e\n", ranks, total, most, iqn_get(q, IQN_VALUE));
        printf("converged %d\n", status == IQN_SOLVED);
    }
    MPI_Finalize();
    return status != IQN_SOLVED;
}
