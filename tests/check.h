/* SPDX-License-Identifier: MIT

   check.h - what the tests of waveform.h, iqn.h and rk.h add to cmocka: comparisons of doubles that print both numbers, and one test
   by its name. */
#ifndef CHECK_H_INCLUDED
#define CHECK_H_INCLUDED

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Runs of seconds shrink to a part of that where the tests run many times over: make mutants. */
#ifndef LESS
#    define LESS 1
#endif

/* A test: a function as cmocka wants it, which uses no state. */
#ifdef __GNUC__
#    define TEST(name) static void name(void **state __attribute__((unused)))
#else
#    define TEST(name) static void name(void **state)
#endif

/* `build/test_iqn NAME` runs the tests of that name, which may lack the test_ in front; * stands for any letters. */
static inline void check_named(int argc, char **argv)
{
    static char name[256];
    if (argc < 2) return;
    snprintf(name, sizeof name, "%s%s", strncmp(argv[1], "test_", 5) == 0 ? "" : "test_", argv[1]);
    cmocka_set_test_filter(name);
}

/* A row of examples/EXTREMES.md: what is extreme, and what happens then, with the numbers that this test has seen. */
#define EXTREME(what, ...) (printf("# extreme | %s | ", (what)), printf(__VA_ARGS__), (void)puts(""))

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

#define CHECK(condition) check__true((condition) != 0, #condition, __FILE__, __LINE__)

#define CHECK_INT(value, expected) check__int((long)(value), (long)(expected), #value, __FILE__, __LINE__)

/* |value - expected| <= tolerance; a NaN on either side fails. */
#define CHECK_NEAR(value, expected, tolerance) \
    check__near((value), (expected), (tolerance), #value, __FILE__, __LINE__)

static inline void check__true(int ok, const char *what, const char *file, int line)
{
    if (!ok) fail_msg("%s:%d: %s", file, line, what);
}

static inline void check__int(long value, long expected, const char *what, const char *file, int line)
{
    if (value != expected) fail_msg("%s:%d: %s is %ld, expected %ld", file, line, what, value, expected);
}

static inline void check__near(double value, double expected, double tolerance, const char *what, const char *file, int line)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%s:%d: %s is %.17g, expected %.17g, off by %.3g > %.3g", file, line, what, value, expected,
                 fabs(value - expected), tolerance);
}

#endif
