/* SPDX-License-Identifier: MIT

   floors.h - what plain loops written for the purpose reach: floors.c is compiled with -O3 -march=native -ffast-math   */
#ifndef FLOORS_H
#define FLOORS_H

#include <stddef.h>

/* ---- iqn: one quasi-Newton step in plain double: sums of V'r and V'v in one sweep, Cholesky of the Gram matrix, a second
   sweep for x = hx + W a that stores the new pair and the base.  Moves 2 m + 14 words per number: m + 3 read by the first
   sweep; m + 4 read and 5 written by the second, two of these to memory not read before (4 words). */
typedef struct floor_iqn {
    ptrdiff_t n;
    int m, slot; /* the pair that goes next */
    double *V, *W, *r, *hx;    /* n m, n m, n, n */
    double *G, *L, *c, *b, *a; /* m m, m m, m, m, m */
} floor_iqn;

void floor_step(floor_iqn *s, double *x, const double *hx);

/* ---- rk: whole steps of f = -y, the coefficients typed in; k holds the stages, z gets the new y ---------------------- */
typedef void floor_rk(ptrdiff_t n, double h, const double *y, double *k, double *z);
floor_rk floor_rk4, floor_bs3, floor_dp5;
floor_rk floor_esdirk4, floor_dop853; /* the zeros of the table in their places, the other coefficients made up */
void floor_decay(ptrdiff_t n, const double *y, double *f); /* f = -y */
/* The error of dp5 and the root mean square of error / (atol + rtol max(|y|, |z|)); looked at for overflow as rk_norm does. */
double floor_error(ptrdiff_t n, double h, double rtol, double atol, const double *y, const double *z, const double *k,
                   double *error);
/* out = y + sum of six weighted stages of dp5 (the second has no weight). */
void floor_sum_dp5(ptrdiff_t n, const double *weight, const double *y, const double *k, double *out);
/* The same with the weights of dp5 at theta, formed here. */
void floor_dense(ptrdiff_t n, double h, double theta, const double *y, const double *k, double *out);

/* ---- waveform ------------------------------------------------------------------------------------------------------------ */
/* out = sum of `terms` weighted columns. */
void floor_sum(ptrdiff_t n, int terms, const double *weight, const double *x, double *out);
/* n = 1: forward and back substitution with three bands on either side, reciprocals at hand. */
void floor_band(int m, const double *band, const double *x, double *c);

#endif
