/* SPDX-License-Identifier: MIT

   cmocka.h - the few names of cmocka that the tests use, for machines it is not built for (32 bits, big-endian) and for
   the memory sanitizer, which wants every line instrumented.  Prints TAP.  Not installed; make portability and make sanitize. */
#ifndef TRUST_CMOCKA_H_INCLUDED
#define TRUST_CMOCKA_H_INCLUDED

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};

static jmp_buf portable_out;

#define cmocka_unit_test(f) {#f, f}
#define fail_msg(...) (printf("# " __VA_ARGS__), printf("\n"), longjmp(portable_out, 1))
#define skip()        longjmp(portable_out, 2)
#define cmocka_run_group_tests(tests, setup, teardown) \
    portable_run(tests, (int)(sizeof(tests) / sizeof *(tests)), (setup) != NULL || (teardown) != NULL)
#define cmocka_run_group_tests_name(name, tests, setup, teardown) cmocka_run_group_tests(tests, setup, teardown)

/* All tests run, whatever the name: nobody asks for one on those machines. */
#define cmocka_set_test_filter(name) ((void)(name))

static inline int portable_run(const struct CMUnitTest *test, int count, int unsupported)
{
    volatile int i, failed = unsupported;
    printf("1..%d\n", count);
    for (i = 0; i < count; i++) {
        void *state = NULL;
        const int way = setjmp(portable_out);
        if (way == 0) test[i].run(&state);
        if (way == 1) failed++;
        printf("%sok %d - %s%s\n", way == 1 ? "not " : "", i + 1, test[i].name, way == 2 ? " # SKIP" : "");
        fflush(stdout);
    }
    return failed;
}
#endif
