/* SPDX-License-Identifier: MIT

   mpi.c - iqn.h on a distributed interface: every rank owns a piece of x, the last rank owns none.  The whole of the
   communication is the sum below, and with --predict one more in a window, for a first guess of the degree that would
   have foretold the last window ends best.  mpirun -np 4 build/mpi gives the iterations of mpirun -np 1.             */
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

/* x, the answer of window w, becomes the first guess of the next one. */
static void guess_next(MPI_Comm comm, int ranks, int w, waveform *ends, double *x)
{
    const size_t bytes = (size_t)ends->n * sizeof *x;
    double weight[COLUMNS];
    int degree, status;
    memcpy(waveform_push(ends, w), x, bytes);
    if (w == 0) return;
    waveform_advance(ends, COLUMNS - 2);
    degree = ranks > 1 ? spread_degree(comm, ends) : wf_predict_degree(ends->grid, ends->n, ends->x, ends->n);
    scene_check(degree, wf_message(degree));
    status = wf_predict(ends->grid, degree, w + 1, weight);
    scene_check(status, wf_message(status));
    scene_check(wf_combine(1, wf_columns(ends->grid), weight, ends->n, ends->x, ends->n, x, ends->n), "wf_combine");
}

int main(int argc, char **argv)
{
    static scene_option o[] = {{"n", "20000", "length of x over all ranks"},
                               {"windows", "5", "time windows"},
                               {"columns", "40", "secant pairs kept"},
                               {"stiffness", "5", "steepest slope of H"},
                               {"tol", "1e-9", "relative limit"},
                               {"predict", "0", "1: a first guess of each window from the windows before"},
                               {NULL, NULL, NULL}};
    counter c = {MPI_COMM_WORLD, 0};
    int rank, ranks, owners, columns, windows, predict, w, status = 0, total = 0, most = 0, before;
    long n, first, i;
    double *x, *h, stiff, tol;
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
    if (predict) ends = waveform_make(1, (int)i, COLUMNS);
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
        if (predict) guess_next(c.comm, ranks, w, &ends, x);
    }
    if (rank == 0) {
        printf("ranks %d\niterations %d\nsums_per_iteration %d\nnorm %.15e\n", ranks, total, most, iqn_get(q, IQN_VALUE));
        printf("converged %d\n", status == IQN_SOLVED);
    }
    MPI_Finalize();
    return status != IQN_SOLVED;
}
