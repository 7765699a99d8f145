/* SPDX-License-Identifier: MIT

   octave_iqn.c - iqn.h for Octave and MATLAB, as a MEX function

       mkoctfile --mex -I../.. octave_iqn.c -o iqn.mex          (MATLAB: mex -I../.. octave_iqn.c -output iqn)

       q = iqn ("make", n, columns);                     % x = H(x), n numbers
       q = iqn ("set", q, "tol_relative", 1e-8);         % keys of iqn_set in small letters
       do
         [q, x, done] = iqn ("step", q, x, H (x));       % x becomes the next input, at last the answer
       until done                                        % 1: converged, 2: gave up
       q = iqn ("commit", q);                            % or "discard"
       k = iqn ("get", q, "iterations");

   q is the whole object, an array of numbers without addresses in it: copy it, save it, go back to it. */
#define IQN_IMPLEMENTATION
#include "iqn.h"

#include <mex.h>
#include <string.h>

static const struct {
    const char *name;
    int number;
} keys[] = {{"method", IQN_METHOD}, {"omega", IQN_OMEGA}, {"filter_limit", IQN_FILTER_LIMIT}, {"windows", IQN_WINDOWS},
            {"tol_absolute", IQN_TOL_ABSOLUTE}, {"tol_relative", IQN_TOL_RELATIVE}, {"tol_reduction", IQN_TOL_REDUCTION},
            {"max_iterations", IQN_MAX_ITERATIONS}, {"patience", IQN_PATIENCE}, {"mixing", IQN_MIXING},
            {"noise_level", IQN_NOISE_LEVEL}, {"merge", IQN_MERGE}, {"residual", IQN_RESIDUAL}, {"value", IQN_VALUE},
            {"relative", IQN_RELATIVE}, {"best_relative", IQN_BEST_RELATIVE}, {"pairs", IQN_PAIRS},
            {"iterations", IQN_ITERATIONS}};

/* Ends the call with the header's sentence. */
static int fine(int status)
{
    if (status < 0) mexErrMsgIdAndTxt("iqn:status", "iqn: %s", iqn_message(status));
    return status;
}

static void need(int condition, const char *sentence)
{
    if (!condition) mexErrMsgIdAndTxt("iqn:usage", "iqn: %s", sentence);
}

static double number(const mxArray *a)
{
    need(mxIsDouble(a) && mxGetNumberOfElements(a) == 1, "a number is expected");
    return mxGetScalar(a);
}

static int key_of(const mxArray *a)
{
    char name[32];
    need(mxGetString(a, name, sizeof name) == 0, "a key is expected, such as \"tol_relative\"");
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
        if (strcmp(keys[k].name, name) == 0) return keys[k].number;
    mexErrMsgIdAndTxt("iqn:usage", "iqn: iqn.h has no key %s", name);
    return 0;
}

/* The object in a new array, behind one number: n. */
static iqn *object(const mxArray *old, mxArray **now, size_t *n)
{
    need(mxIsDouble(old) && mxGetNumberOfElements(old) > 8, "q is expected, which \"make\" returns");
    *now = mxDuplicateArray(old);
    *n = (size_t)mxGetPr(*now)[0];
    return (iqn *)(void *)(mxGetPr(*now) + 1);
}

static mxArray *make(int count, const mxArray *in[])
{
    const double n = count > 1 ? number(in[1]) : -1, columns = count > 2 ? number(in[2]) : 20;
    const size_t bytes = iqn_size((ptrdiff_t)n, (int)columns, 1);
    mxArray *out;
    iqn *q;
    need(bytes > 0, "\"make\", n, columns: n numbers, columns from 0 to 10000");
    out = mxCreateDoubleMatrix((mwSize)(bytes / sizeof(double) + 2), 1, mxREAL);
    mxGetPr(out)[0] = n;
    fine(iqn_make(&q, (ptrdiff_t)n, (int)columns, 1, mxGetPr(out) + 1, bytes));
    return out;
}

static void step(iqn *q, size_t n, int results, mxArray *out[], int count, const mxArray *in[])
{
    need(count == 4 && mxIsDouble(in[2]) && mxIsDouble(in[3]) && !mxIsComplex(in[2]) && !mxIsComplex(in[3]),
         "[q, x, done] = iqn (\"step\", q, x, hx) takes real numbers");
    need(mxGetNumberOfElements(in[2]) == n && mxGetNumberOfElements(in[3]) == n, "x and hx: as many numbers as \"make\" was told");
    need(results >= 2, "[q, x, done] = iqn (\"step\", q, x, hx) returns the next input");
    out[1] = mxDuplicateArray(in[2]);
    fine(iqn_step(q, mxGetPr(out[1]), mxGetPr(in[3])));
    if (results > 2) out[2] = mxCreateDoubleScalar(iqn_converged(q));
}

void mexFunction(int results, mxArray *out[], int count, const mxArray *in[]);
void mexFunction(int results, mxArray *out[], int count, const mxArray *in[])
{
    char what[16] = "";
    mxArray *now;
    size_t n;
    iqn *q;
    need(count > 1 && mxGetString(in[0], what, sizeof what) == 0, "iqn (\"make\", n, columns), (\"step\", q, x, hx), \"set\" ..");
    if (strcmp(what, "make") == 0) {
        out[0] = make(count, in);
        return;
    }
    q = object(in[1], &now, &n);
    if (strcmp(what, "step") == 0) step(q, n, results, out, count, in);
    else if (strcmp(what, "set") == 0) {
        need(count == 4, "iqn (\"set\", q, key, value)");
        fine(iqn_set(q, key_of(in[2]), number(in[3])));
    } else if (strcmp(what, "get") == 0) {
        need(count == 3, "iqn (\"get\", q, key)");
        out[0] = mxCreateDoubleScalar(iqn_get(q, key_of(in[2])));
        return;
    } else if (strcmp(what, "commit") == 0) fine(iqn_commit(q));
    else if (strcmp(what, "discard") == 0) fine(iqn_discard(q));
    else mexErrMsgIdAndTxt("iqn:usage", "iqn: make, step, set, get, commit or discard, not %s", what);
    out[0] = now;
}
