/* SPDX-License-Identifier: MIT

   column_at.h - column `at` of TABLES in rk.h, read from the header's own text, so that tests and studies judge what is printed there.
   Include it behind rk.h; RK_HEADER: where the header lies, unless here or one folder up. */
#ifndef COLUMN_AT_H_INCLUDED
#define COLUMN_AT_H_INCLUDED

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef RK_HEADER
#    define RK_HEADER "rk.h"
#endif

/* Columns behind the bar: one or two thetas, then the divisor. */
enum { AT_FIRST = 46, AT_SECOND = 50, AT_DIVISOR = 54, AT_WIDTH = 3 };

static inline double column_number(const char *line, int column)
{
    char text[AT_WIDTH + 1] = {0};
    memcpy(text, strchr(line, '|') + column, AT_WIDTH);
    return strtod(text, NULL);
}

/* A single theta is given twice.  0: the table has no line, or the line no such column. */
static inline int column_at(const char *name, double theta[2], double *divisor)
{
    const char *const path[] = {"rk.h", "../rk.h", RK_HEADER};
    char line[256], found[32];
    FILE *f = NULL;
    int i, ok = 0;
    for (i = 0; i < 3 && !f; i++) f = fopen(path[i], "r");
    while (f && !ok && fgets(line, sizeof line, f)) {
        if (sscanf(line, " | %31s", found) != 1 || strcmp(found, name) != 0) continue;
        if (strlen(strchr(line, '|')) < AT_DIVISOR + AT_WIDTH) continue;
        theta[0] = column_number(line, AT_FIRST);
        theta[1] = column_number(line, AT_SECOND);
        *divisor = column_number(line, AT_DIVISOR);
        if (!(theta[1] > 0)) theta[1] = theta[0];
        ok = theta[0] > 0 && theta[0] < 1 && theta[1] < 1 && *divisor > 0;
    }
    if (f) fclose(f);
    return ok;
}

#endif
