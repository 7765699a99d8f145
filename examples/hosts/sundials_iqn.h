/* SPDX-License-Identifier: MIT

   sundials_iqn.h - iqn.h as a SUNNonlinearSolver, for any N_Vector; CVODE, ARKODE and IDA run unchanged

       SUNNonlinearSolver nls = SUNNonlinSol_IQN(y, columns, SUNNONLINEARSOLVER_FIXEDPOINT, context);
       CVodeSetNonlinearSolver(cvode, nls);                       or ARKStep..., IDA...

   FIXEDPOINT: x = G(x), as SUNNonlinSol_FixedPoint, whose Anderson columns are these.  ROOTFIND: the integrator's Newton
   iteration with its old Jacobian is the H that is accelerated.  The norm is the integrator's, with its error weights.
   A step is one sum over the ranks where the N_Vector has nvdotprodmultilocal, else four.  SUNDIALS 6 and later. */
#ifndef SUNDIALS_IQN_H
#define SUNDIALS_IQN_H
#include "iqn.h"

#include <stdlib.h>
#include <sundials/sundials_nonlinearsolver.h>

enum { SUN_IQN_MOST = 100, SUN_IQN_SLOTS = SUN_IQN_MOST + 2 };
typedef struct sun_iqn {
    iqn *q;
    SUNNonlinearSolver_Type type;
    SUNNonlinSolSysFn system;
    SUNNonlinSolLSetupFn set_up;
    SUNNonlinSolLSolveFn linear;
    SUNNonlinSolConvTestFn test;
    void *test_data;
    int slots, most, iteration;
    long iterations, failures;
    sunbooleantype call, bad, fresh; /* the linear solver: set it up, its Jacobian is bad, is new */
    N_Vector *V, *W, v, s, scaled, change;     /* r and hx of iterates and pairs; v, and s = w - v, of the newest */
    N_Vector with[2 * SUN_IQN_SLOTS];          /* what is multiplied or added up, */
    sunrealtype number[2 * SUN_IQN_SLOTS + 2]; /* the products or factors */
    double dot[IQN_DOTS + 2 * SUN_IQN_MOST], weight[2 * SUN_IQN_SLOTS];
    int slot[SUN_IQN_SLOTS];
} sun_iqn;

/* out = products of x with c->with, in the metric of the error weights w; summed over the ranks later, if `local` */
static void sun_iqn_multiply(sun_iqn *c, N_Vector x, N_Vector w, int count, sunrealtype *out, int local)
{
    N_VProd(w, x, c->scaled);
    N_VProd(w, c->scaled, c->scaled);
    if (local) N_VDotProdMultiLocal(count, c->scaled, c->with, out);
    else N_VDotProdMulti(count, c->scaled, c->with, out);
}

static void sun_iqn_products(sun_iqn *c, N_Vector r, N_Vector h, N_Vector w, int pairs)
{
    const int local = r->ops->nvdotprodmultilocal && r->ops->nvdotprodmultiallreduce;
    sunrealtype *of_r = c->number, *of_v = of_r + pairs + 2, *rest = of_v + pairs + 2; /* rest: hh, ss */
    for (int j = 0; j < pairs; j++) c->with[j] = c->V[c->slot[2 + j]];
    c->with[pairs] = c->v;
    c->with[pairs + 1] = r;
    sun_iqn_multiply(c, r, w, pairs + 2, of_r, local);
    c->with[pairs + 1] = c->s;
    sun_iqn_multiply(c, c->v, w, pairs + 2, of_v, local);
    c->with[0] = h;
    sun_iqn_multiply(c, h, w, 1, rest, local);
    c->with[0] = c->s;
    sun_iqn_multiply(c, c->s, w, 1, rest + 1, local);
    if (local) N_VDotProdMultiAllReduce(2 * pairs + 6, r, c->number);
    for (int j = 0; j < pairs; j++) {
        c->dot[IQN_DOTS + 2 * j] = (double)of_r[j];
        c->dot[IQN_DOTS + 2 * j + 1] = (double)of_v[j];
    }
    c->dot[IQN_DOT_RR] = (double)of_r[pairs + 1];
    c->dot[IQN_DOT_HH] = (double)rest[0];
    c->dot[IQN_DOT_VV] = c->slot[1] < 0 ? 0 : (double)of_v[pairs];
    c->dot[IQN_DOT_VR] = (double)of_r[pairs];
    c->dot[IQN_DOT_SS] = (double)rest[1];
    c->dot[IQN_DOT_SV] = (double)of_v[pairs + 1];
}

/* x becomes the next input; hx stands in W[now], r in V[now] */
static int sun_iqn_step(sun_iqn *c, N_Vector x, N_Vector w, int pairs)
{
    const int now = c->slot[0], base = c->slot[1];
    int store, count = 0;
    if (base >= 0) {
        N_VLinearSum(1, c->V[now], -1, c->V[base], c->v);
        N_VLinearSum(1, c->W[now], -1, c->W[base], c->s);
        N_VLinearSum(1, c->s, -1, c->v, c->s);
    }
    sun_iqn_products(c, c->V[now], c->W[now], w, pairs);
    if (iqn_weights(c->q, c->dot, c->weight, &store) < 0) return SUN_NLS_CONV_RECVR; /* not finite */
    if (store >= 0) {
        N_VLinearSum(1, c->s, 1, c->v, c->W[store]);
        N_VScale(1, c->v, c->V[store]);
    }
    for (int k = 0; k < 2 * c->slots; k++) {
        if (!(c->weight[k] != 0)) continue;
        c->number[count] = (sunrealtype)c->weight[k];
        c->with[count++] = c->V[k]; /* W stands behind V */
    }
    return N_VLinearCombination(count, c->number, c->with, x);
}

/* Until the integrator's test is content.  The linear solver is set up after the first residual, where it is asked for. */
static int sun_iqn_iterate(SUNNonlinearSolver nls, N_Vector x, N_Vector w, sunrealtype tol, void *mem)
{
    sun_iqn *c = (sun_iqn *)nls->content;
    const int fixed = c->type == SUNNONLINEARSOLVER_FIXEDPOINT;
    int status = SUN_NLS_CONTINUE;
    for (c->iteration = 0; status == SUN_NLS_CONTINUE; c->iteration++, c->iterations++) {
        const int pairs = iqn_ask(c->q, c->slot);
        const N_Vector r = c->V[c->slot[0]], h = c->W[c->slot[0]];
        if (c->iteration == c->most) return SUN_NLS_CONV_RECVR;
        status = c->system(x, fixed ? h : r, mem);
        if (status == 0 && c->call && c->set_up) status = c->set_up(c->bad, &c->fresh, mem);
        c->call = SUNFALSE;
        if (!fixed) N_VScale(-1, r, r);
        if (status == 0 && !fixed) status = c->linear(r, mem);
        if (status != 0) return status;
        N_VLinearSum(1, fixed ? h : r, fixed ? -1 : 1, x, fixed ? r : h); /* the other one of r = h - x, h = x + r */
        N_VScale(1, x, c->change);
        status = sun_iqn_step(c, x, w, pairs);
        if (status != 0) return status;
        N_VLinearSum(1, x, -1, c->change, c->change);
        status = c->test(nls, x, c->change, tol, w, c->test_data);
    }
    return status;
}

static int sun_iqn_solve(SUNNonlinearSolver nls, N_Vector y0, N_Vector x, N_Vector w, sunrealtype tol,
                         sunbooleantype call, void *mem)
{
    sun_iqn *c = (sun_iqn *)nls->content;
    (void)y0;
    c->iterations = c->failures = 0;
    c->call = call;
    c->bad = c->fresh = SUNFALSE;
    for (;;) {
        const int status = sun_iqn_iterate(nls, x, w, tol, mem);
        (void)(status == SUN_NLS_SUCCESS ? iqn_commit(c->q) : iqn_discard(c->q));
        c->failures += status != SUN_NLS_SUCCESS;
        if (status <= SUN_NLS_SUCCESS || c->fresh || !c->set_up) return status;
        c->call = c->bad = SUNTRUE; /* once more, with a new Jacobian */
        N_VConst(0, x);
    }
}

/* ---- what the integrator asks for ---- */

#define SUN_IQN_SET(member, kind) \
    static int sun_iqn_set_##member(SUNNonlinearSolver nls, kind x) { ((sun_iqn *)nls->content)->member = x; return 0; }
#define SUN_IQN_GET(member, kind) \
    static int sun_iqn_get_##member(SUNNonlinearSolver nls, kind *x) { *x = ((sun_iqn *)nls->content)->member; return 0; }
SUN_IQN_SET(system, SUNNonlinSolSysFn)
SUN_IQN_SET(set_up, SUNNonlinSolLSetupFn)
SUN_IQN_SET(linear, SUNNonlinSolLSolveFn)
SUN_IQN_SET(most, int)
SUN_IQN_GET(iterations, long)
SUN_IQN_GET(iteration, int)
SUN_IQN_GET(failures, long)
static SUNNonlinearSolver_Type sun_iqn_type(SUNNonlinearSolver nls) { return ((sun_iqn *)nls->content)->type; }

static int sun_iqn_set_test(SUNNonlinearSolver nls, SUNNonlinSolConvTestFn test, void *data)
{
    ((sun_iqn *)nls->content)->test = test;
    ((sun_iqn *)nls->content)->test_data = data;
    return 0;
}

static int sun_iqn_free(SUNNonlinearSolver nls)
{
    sun_iqn *c = (sun_iqn *)nls->content;
    N_VDestroyVectorArray(c->V, 2 * c->slots + 4);
    free(c->q);
    free(c);
    SUNNonlinSolFreeEmpty(nls);
    return 0;
}

static SUNNonlinearSolver SUNNonlinSol_IQN(N_Vector y, int columns, SUNNonlinearSolver_Type type, SUNContext context)
{
    static const struct _generic_SUNNonlinearSolver_Ops ops = {
        sun_iqn_type, NULL, NULL, sun_iqn_solve, sun_iqn_free, sun_iqn_set_system, sun_iqn_set_set_up, sun_iqn_set_linear,
        sun_iqn_set_test, sun_iqn_set_most, sun_iqn_get_iterations, sun_iqn_get_iteration, sun_iqn_get_failures};
    const int most = columns < SUN_IQN_MOST ? columns : SUN_IQN_MOST;
    const size_t bytes = iqn_size(IQN_HOST, most, 1);
    SUNNonlinearSolver nls = SUNNonlinSolNewEmpty(context);
    sun_iqn *c = (sun_iqn *)calloc(1, sizeof *c);
    if (!nls || !c || iqn_make(&c->q, IQN_HOST, most, 1, malloc(bytes), bytes) < 0) return NULL;
    iqn_set(c->q, IQN_OMEGA, 1);
    iqn_set(c->q, IQN_PATIENCE, 0); /* the integrator counts */
    iqn_set(c->q, IQN_WINDOWS, 0);  /* of the last solve: its pairs in the first iteration alone */
    nls->content = c;
    *nls->ops = ops;
    c->type = type;
    c->slots = most + 2;
    c->V = N_VCloneVectorArray(2 * c->slots + 4, y);
    if (!c->V) return NULL;
    c->W = c->V + c->slots;
    c->v = c->W[c->slots];
    c->s = c->W[c->slots + 1];
    c->scaled = c->W[c->slots + 2];
    c->change = c->W[c->slots + 3];
    return nls;
}
#endif
