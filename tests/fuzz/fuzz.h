/* SPDX-License-Identifier: MIT

   fuzz.h - what the three harnesses fuzz_waveform.c, fuzz_iqn.c and fuzz_rk.c share: bytes become arguments, a broken promise aborts.

   A harness defines fuzz_one(), which decodes its bytes into calls of the public functions.  Built with -DFUZZ_LIBFUZZER
   and -fsanitize=fuzzer it is driven by libFuzzer; built plainly it is a test program:

      fuzz_NAME                 FUZZ_COUNT pseudo-random inputs, the same ones everywhere
      fuzz_NAME COUNT [FIRST]   so many, from number FIRST on: a failure names its number
      fuzz_NAME FILE...         inputs that libFuzzer has kept                                                           */
#ifndef FUZZ_H_INCLUDED
#define FUZZ_H_INCLUDED

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRE(condition) ((condition) ? (void)0 : fuzz_fail(#condition, __FILE__, __LINE__))

typedef struct fuzz {
    const unsigned char *at, *end;
} fuzz;

static void fuzz_one(fuzz *f);

static long fuzz_number = -1;

/* Under -ffast-math a comparison with NaN means nothing and denormals are flushed, in the harness as in the headers: there
   only crashes count (make flags sets FUZZ_CRASHES_ONLY). */
static void fuzz_fail(const char *what, const char *file, int line)
{
#ifdef FUZZ_CRASHES_ONLY
    if (line) return;
#endif
    if (fuzz_number >= 0) printf("not ok 1 - input %ld: %s:%d: %s\n", fuzz_number, file, line, what);
    fflush(stdout);
    fprintf(stderr, "%s:%d: %s\n", file, line, what);
    abort();
}

/* ---- bits: comparisons must mean the same under -ffast-math --------------------------------------------------------- */

static uint64_t fuzz_bits(double v)
{
    uint64_t u;
    memcpy(&u, &v, sizeof u);
    return u;
}

static double fuzz_of_bits(uint64_t u)
{
    double v;
    memcpy(&v, &u, sizeof v);
    return v;
}

static int fuzz_finite(double v)
{
    return (fuzz_bits(v) >> 52 & 0x7ff) != 0x7ff;
}

static int fuzz_is_nan(double v)
{
    return (fuzz_bits(v) & ~((uint64_t)1 << 63)) > (uint64_t)0x7ff << 52;
}

/* The same bits, or NaN both. */
static int fuzz_same(double a, double b)
{
    return fuzz_bits(a) == fuzz_bits(b) || (fuzz_is_nan(a) && fuzz_is_nan(b));
}

static int fuzz_all_same(ptrdiff_t n, const double *a, const double *b)
{
    ptrdiff_t i;
    for (i = 0; i < n; i++)
        if (!fuzz_same(a[i], b[i])) return 0;
    return 1;
}

/* ---- decoding: past the end of the input everything is 0 ------------------------------------------------------------- */

static int fuzz_more(const fuzz *f)
{
    return f->at < f->end;
}

static unsigned fuzz_byte(fuzz *f)
{
    return f->at < f->end ? *f->at++ : 0;
}

static int fuzz_below(fuzz *f, int count) /* 0 .. count-1, count <= 256 */
{
    return (int)fuzz_byte(f) % count;
}

static uint64_t fuzz_word(fuzz *f)
{
    uint64_t u = 0;
    int i;
    for (i = 0; i < 8; i++) u = u << 8 | fuzz_byte(f);
    return u;
}

/* In (-1, 1), 16 bits, so that sums and differences of a few are exact. */
static double fuzz_unit(fuzz *f)
{
    const int high = (int)fuzz_byte(f), low = (int)fuzz_byte(f);
    return (double)(high * 256 + low - 32768) / 32769;
}

/* Finite and between 2^-20 and 2^20, or 0. */
static double fuzz_moderate(fuzz *f)
{
    const int kind = fuzz_below(f, 8), power = kind == 2 ? fuzz_below(f, 20) : 0;
    if (kind == 0) return 0;
    if (kind == 1) return 1;
    return ldexp(fuzz_unit(f), power);
}

/* Any bits whatever, the famous ones more often. */
static double fuzz_double(fuzz *f)
{
    double v;
    switch (fuzz_below(f, 24)) {
    case 0: return fuzz_of_bits((uint64_t)0x7ff8 << 48);          /* NaN */
    case 1: return fuzz_of_bits((uint64_t)0x7ff << 52);           /* Inf */
    case 2: return fuzz_of_bits((uint64_t)0xfff << 52);           /* -Inf */
    case 3: return fuzz_of_bits((uint64_t)1);                     /* the smallest denormal */
    case 4: return fuzz_of_bits(fuzz_word(f) & 0x800fffffffffffffu);
    case 5: return DBL_MAX;
    case 6: return -DBL_MAX;
    case 7: return DBL_MIN;
    case 8: return fuzz_of_bits((uint64_t)1 << 63);               /* -0 */
    case 9: return 0;
    case 10: return 1;
    case 11: return 1 + DBL_EPSILON;
    case 12: return -1;
    case 13: return fuzz_of_bits(fuzz_word(f));
    case 14: return 1e9 + fuzz_unit(f);
    case 15: return fuzz_below(f, 256) - 100;
    case 16: v = fuzz_unit(f); return ldexp(v, fuzz_below(f, 256) * 8 - 1020);
    default: return fuzz_moderate(f);
    }
}

/* Any int, the small and the extreme ones more often. */
static int fuzz_int(fuzz *f)
{
    static const int famous[] = {0, 1, -1, 2, 3, INT_MAX, INT_MIN, INT_MAX - 1, 1 << 16, 30000, 100, 15, 16};
    const int kind = fuzz_below(f, 32);
    if (kind < (int)(sizeof famous / sizeof *famous)) return famous[kind];
    if (kind < 28) return fuzz_below(f, 256) - 20;
    return (int)(fuzz_word(f) >> 33) * (kind % 2 ? 1 : -1);
}

/* ---- guarded arrays: `count` doubles with a pattern around and inside; the sanitizers see each access beyond malloc's --- */

#define FUZZ_PATTERN ((uint64_t)0x7ff9dead << 32)

static double *fuzz_alloc(size_t count)
{
    double *p = (double *)malloc(count * sizeof *p + (count == 0));
    size_t i;
    REQUIRE(p != NULL);
    for (i = 0; i < count; i++) p[i] = fuzz_of_bits(FUZZ_PATTERN + i);
    return p;
}

static int fuzz_untouched(size_t count, const double *p)
{
    size_t i;
    for (i = 0; i < count; i++)
        if (fuzz_bits(p[i]) != FUZZ_PATTERN + i) return 0;
    return 1;
}

static void *fuzz_copy(const void *from, size_t bytes)
{
    void *p = malloc(bytes + (bytes == 0));
    REQUIRE(p != NULL);
    if (bytes) memcpy(p, from, bytes);
    return p;
}

/* ---- driver ---------------------------------------------------------------------------------------------------------- */

#ifdef FUZZ_LIBFUZZER
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz f;
    f.at = data;
    f.end = data + size;
    fuzz_one(&f);
    return 0;
}
#else
static void fuzz_run(const unsigned char *data, size_t size)
{
    unsigned char *exact = (unsigned char *)fuzz_copy(data, size); /* so that a read past the end is seen */
    fuzz f;
    f.at = exact;
    f.end = exact + size;
    fuzz_one(&f);
    free(exact);
}

/* Input number i: its length and bytes are a function of i alone (Knuth's 64 bit congruential generator). */
static void fuzz_pseudo_random(long i)
{
    unsigned char data[1024];
    uint64_t state = (uint64_t)i * 0x9e3779b97f4a7c15u + 1;
    size_t size, j;
    state = state * 6364136223846793005u + 1442695040888963407u;
    size = (size_t)(state >> 40) % sizeof data;
    for (j = 0; j < size; j++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        data[j] = (unsigned char)(state >> 56);
    }
    fuzz_number = i;
    fuzz_run(data, size);
}

static int fuzz_file(const char *name)
{
    static unsigned char data[1 << 20];
    FILE *file = fopen(name, "rb");
    size_t size;
    if (!file) return 0;
    size = fread(data, 1, sizeof data, file);
    fclose(file);
    fuzz_run(data, size);
    return 1;
}

int main(int argc, char **argv)
{
    long count = FUZZ_COUNT, first = 0, i;
    char *end = NULL;
    if (argc > 1) {
        count = strtol(argv[1], &end, 10);
        if (*end) {
            for (i = 1; i < argc; i++)
                if (!fuzz_file(argv[i])) return fprintf(stderr, "cannot read %s\n", argv[i]), 2;
            return 0;
        }
        if (argc > 2) first = strtol(argv[2], NULL, 10);
    }
    printf("1..1\n");
    for (i = 0; i < count; i++) fuzz_pseudo_random(first + i);
    printf("ok 1 - %ld pseudo-random inputs\n", count);
    return 0;
}
#endif
#endif
