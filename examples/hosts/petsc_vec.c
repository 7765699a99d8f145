/* SPDX-License-Identifier: MIT

   petsc_vec.c - iqn.h with vectors of PETSc, distributed over the ranks

   H is one damped Jacobi sweep of -div((1 + 5 u^2) grad u) = 1, u = 0 on the edge of a square;
   quasi-Newton makes a solver of it.  All products of a step are one reduction (VecMDotBegin),
   the next x is one VecMAXPY.  The core sees numbers alone, the same on all ranks.  Beside it
   iqn_step on the arrays of the Vecs, with MPI_Allreduce for its sum. */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <petscdmda.h>
#include <stdlib.h>

enum { GRID = 40, COLUMNS = 20, SLOTS = COLUMNS + 2 };

static DM grid;
static Vec V[SLOTS], W[SLOTS], x, v, s, ghosted;

static PetscErrorCode H(Vec in, Vec out)
{
    const PetscScalar **u;
    PetscScalar **h;
    PetscInt i, j, k, left, low, width, height;
    PetscCall(DMGlobalToLocal(grid, in, INSERT_VALUES, ghosted));
    PetscCall(DMDAVecGetArrayRead(grid, ghosted, &u));
    PetscCall(DMDAVecGetArrayWrite(grid, out, &h));
    PetscCall(DMDAGetCorners(grid, &left, &low, NULL, &width, &height, NULL));
    for (j = low; j < low + height; j++)
        for (i = left; i < left + width; i++) {
            const PetscScalar m = u[j][i];
            const PetscScalar b[4] = {u[j][i + 1], u[j][i - 1], u[j + 1][i], u[j - 1][i]};
            PetscScalar sum = 1 / ((GRID + 1.) * (GRID + 1.)), all = 0;
            for (k = 0; k < 4; k++) {
                const PetscScalar c = 1 + 2.5 * (m * m + b[k] * b[k]);
                sum += c * b[k], all += c;
            }
            h[j][i] = m + 0.9 * (sum - all * m) / all;
        }
    PetscCall(DMDAVecRestoreArrayWrite(grid, out, &h));
    PetscCall(DMDAVecRestoreArrayRead(grid, ghosted, &u));
    return 0;
}

/* All products of a step, summed over the ranks in one reduction. */
static double bytes; /* of all reductions */

static PetscErrorCode form_products(Vec r, Vec h, int pairs, const int *pair, double *dot)
{
    Vec with[COLUMNS + 2];
    PetscScalar of_r[COLUMNS + 2], of_v[COLUMNS + 2];
    int j;
    bytes += (double)(IQN_DOTS + 2 * pairs) * sizeof *dot;
    for (j = 0; j < pairs; j++) with[j] = V[pair[j]];
    with[pairs] = v;
    with[pairs + 1] = r;
    PetscCall(VecMDotBegin(r, pairs + 2, with, of_r));
    with[pairs + 1] = s;
    PetscCall(VecMDotBegin(v, pairs + 2, with, of_v));
    PetscCall(VecDotBegin(h, h, &dot[IQN_DOT_HH]));
    PetscCall(VecDotBegin(s, s, &dot[IQN_DOT_SS]));
    with[pairs + 1] = r;
    PetscCall(VecMDotEnd(r, pairs + 2, with, of_r));
    with[pairs + 1] = s;
    PetscCall(VecMDotEnd(v, pairs + 2, with, of_v));
    PetscCall(VecDotEnd(h, h, &dot[IQN_DOT_HH]));
    PetscCall(VecDotEnd(s, s, &dot[IQN_DOT_SS]));
    for (j = 0; j < pairs; j++) {
        dot[IQN_DOTS + 2 * j] = of_r[j];
        dot[IQN_DOTS + 2 * j + 1] = of_v[j];
    }
    dot[IQN_DOT_VR] = of_r[pairs];
    dot[IQN_DOT_RR] = of_r[pairs + 1];
    dot[IQN_DOT_VV] = of_v[pairs];
    dot[IQN_DOT_SV] = of_v[pairs + 1];
    return 0;
}

static PetscErrorCode combine(const double *weight)
{
    Vec with[2 * SLOTS];
    PetscScalar factor[2 * SLOTS];
    int k, count = 0;
    for (k = 0; k < 2 * SLOTS; k++) {
        if (!(weight[k] != 0)) continue;
        factor[count] = weight[k];
        with[count++] = k < SLOTS ? V[k] : W[k - SLOTS];
    }
    PetscCall(VecZeroEntries(x));
    PetscCall(VecMAXPY(x, count, factor, with));
    return 0;
}

static PetscErrorCode step(iqn *q, int *status)
{
    double dot[IQN_DOTS + 2 * COLUMNS], weight[2 * SLOTS];
    int slot[SLOTS], store;
    const int pairs = iqn_ask(q, slot), now = slot[0], base = slot[1];
    PetscCall(H(x, W[now]));
    PetscCall(VecWAXPY(V[now], -1, x, W[now]));
    if (base >= 0) {
        PetscCall(VecWAXPY(v, -1, V[base], V[now]));
        PetscCall(VecWAXPY(s, -1, W[base], W[now]));
        PetscCall(VecAXPY(s, -1, v)); /* s = w - v */
    }
    PetscCall(form_products(V[now], W[now], pairs, slot + 2, dot));
    *status = iqn_weights(q, dot, weight, &store);
    if (*status < 0) return 0;
    if (store >= 0) {
        PetscCall(VecAXPY(s, 1, v)); /* w */
        PetscCall(VecCopy(v, V[store]));
        PetscCall(VecCopy(s, W[store]));
    }
    return combine(weight);
}

static int sum(double *numbers, int count, void *ctx)
{
    (void)ctx;
    return MPI_Allreduce(MPI_IN_PLACE, numbers, count, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
}

static PetscErrorCode flat(iqn *q)
{
    PetscScalar *in;
    const PetscScalar *out;
    PetscCall(VecZeroEntries(x));
    do {
        PetscCall(H(x, W[0]));
        PetscCall(VecGetArray(x, &in));
        PetscCall(VecGetArrayRead(W[0], &out));
        if (iqn_step(q, in, out) < 0) return 1;
        PetscCall(VecRestoreArrayRead(W[0], &out));
        PetscCall(VecRestoreArray(x, &in));
    } while (!iqn_converged(q));
    return 0;
}

static iqn *make(ptrdiff_t n)
{
    const size_t size = iqn_size(n, COLUMNS, 1);
    iqn *q = NULL;
    (void)iqn_make(&q, n, COLUMNS, 1, malloc(size), size);
    iqn_set(q, IQN_TOL_REDUCTION, 1e-8);
    iqn_set(q, IQN_MAX_ITERATIONS, 400);
    iqn_set(q, IQN_OMEGA, 1);
    return q;
}

int main(int argc, char **argv)
{
    PetscReal norm, other;
    PetscInt here;
    double sums, steps, beside; /* sums: as PETSc counts them, which counts none on one rank */
    int k, status = 0, ranks;
    iqn *q, *f;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_GHOSTED, DM_BOUNDARY_GHOSTED,
                           DMDA_STENCIL_STAR, GRID, GRID, PETSC_DECIDE, PETSC_DECIDE, 1, 1, NULL,
                           NULL, &grid));
    PetscCall(DMSetUp(grid));
    PetscCall(DMCreateLocalVector(grid, &ghosted));
    PetscCall(DMCreateGlobalVector(grid, &x));
    PetscCall(VecDuplicate(x, &v));
    PetscCall(VecDuplicate(x, &s));
    for (k = 0; k < SLOTS; k++) {
        PetscCall(VecDuplicate(x, &V[k]));
        PetscCall(VecDuplicate(x, &W[k]));
    }
    q = make(IQN_HOST);
    sums = petsc_allreduce_ct;
    while (status >= 0 && !iqn_converged(q)) PetscCall(step(q, &status));
    sums = petsc_allreduce_ct - sums;
    PetscCall(VecNorm(x, NORM_2, &norm));
    PetscCall(VecGetLocalSize(x, &here));
    f = make(here);
    if (status < 0 || iqn_set_sum(f, sum, NULL) < 0) return puts(iqn_message(status)), 1;
    PetscCall(flat(f));
    PetscCall(VecNorm(x, NORM_2, &other));
    steps = iqn_get(q, IQN_ITERATIONS);
    beside = iqn_get(f, IQN_ITERATIONS);
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "| ranks | iterations | reductions a step | bytes in them | iqn_step: "
                          "iterations | reductions | difference |\n|---|---|---|---|---|---|---|\n"
                          "| %d | %.0f | %.2f | %.0f | %.0f | %.2f | %.1e |\n",
                          ranks, steps, sums / steps, bytes / steps, beside,
                          iqn_get(f, IQN_NSUMS) / beside, fabs(other - norm) / norm));
    if (iqn_converged(q) != 1 || iqn_converged(f) != 1 || sums > 1.01 * steps) return 1;
    if (fabs(steps - beside) > 2 + beside / 10 || !(fabs(other - norm) < 1e-6 * norm)) return 1;
    return PetscFinalize();
}
