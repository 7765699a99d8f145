/* SPDX-License-Identifier: MIT

   dgels.c - LAPACK's dgels_ for the one shape that the tests ask of it (no transpose, m >= n, full rank), by Householder
   reflections, for machines where LAPACK is not installed.  Not part of the headers, which need no LAPACK. */
#include <math.h>
#include <stddef.h>

void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
            const int *ldb, double *work, const int *lwork, int *info, size_t length);

/* c := (I - 2 v v'/v'v) c */
static void reflect(int m, const double *v, double square, double *c)
{
    double sum = 0;
    int i;
    for (i = 0; i < m; i++) sum += v[i] * c[i];
    for (i = 0; i < m; i++) c[i] -= 2 * sum / square * v[i];
}

void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a, const int *lda, double *b,
            const int *ldb, double *work, const int *lwork, int *info, size_t length)
{
    int i, j, k;
    (void)length;
    *info = *trans == 'N' && *m >= *n && *lwork >= *m ? 0 : -1;
    for (k = 0; *info == 0 && k < *n; k++) {
        double *column = a + k * *lda + k, square = 0, norm = 0;
        for (i = 0; i < *m - k; i++) norm += column[i] * column[i];
        norm = column[0] > 0 ? -sqrt(norm) : sqrt(norm);
        for (i = 0; i < *m - k; i++) work[i] = column[i];
        work[0] -= norm;
        for (i = 0; i < *m - k; i++) square += work[i] * work[i];
        if (!(square > 0)) *info = k + 1;
        for (j = k; *info == 0 && j < *n; j++) reflect(*m - k, work, square, a + j * *lda + k);
        for (j = 0; *info == 0 && j < *nrhs; j++) reflect(*m - k, work, square, b + j * *ldb + k);
    }
    for (j = 0; *info == 0 && j < *nrhs; j++)
        for (k = *n - 1; k >= 0; k--) {
            double *x = b + j * *ldb;
            for (i = k + 1; i < *n; i++) x[k] -= a[i * *lda + k] * x[i];
            x[k] /= a[k * *lda + k];
        }
}
