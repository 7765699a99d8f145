/* SPDX-License-Identifier: MIT

   table.c - a Butcher tableau, as people write it: what it is, a picture, and a table of rk.h

      build/table FILE            - reads standard input
         --dense ORDER            wanted inside the step; else the best
         --extra N                stages that may be added for it, explicit tables
         --svg PATH               the picture; else NAME.svg beside the program

   One line per row; # begins a comment, lines of dashes are skipped:

      g = 1 - sqrt(2)/2           a constant; numbers are decimals, fractions, sqrt, cbrt, cos, .., pi,
      g   | g                     + - * / ^ ( ).  "1 - g" and "1-g" are one number, "1 -g" are two.
      1   | 1-g   g               c | a_1 a_2 ..: zeros at the end of a row may be left out.
      b   | 1-g   g               Without the bar: all s numbers of a row, or c and s numbers.
      bhat| 1     0               b and bhat may lack their names: | 1-g g

   Also "name X", "order P" or "order P PAIR" (what is claimed), and for the two halves of an IMEX
   method a line "explicit" or "implicit" above each; bhat, and b of the second half, may be missing.
   The report is a comment in front of the C text, so that all of it can be pasted.
   Exit: 0; 1: a claim does not hold, or b does not sum to 1; 2: the input is not understood. */
#define _POSIX_C_SOURCE 200809L /* popen */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"

#include <complex.h>
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 24, MORE = 9, LINES = 200, NAMES = 32 };

static const double pi = 3.14159265358979323846;
static const double complex up = I; /* i, in double */

void dgeev_(const char *, const char *, const int *, double *, const int *, double *, double *,
            double *, const int *, double *, const int *, double *, const int *, int *);
void dgesv_(const int *, const int *, double *, const int *, int *, double *, const int *, int *);
void zgesv_(const int *, const int *, double complex *, const int *, int *, double complex *,
            const int *, int *);

/* ---- the text ------------------------------------------------------------------------------- */

/* One character for one character: columns stay. */
static struct {
    const char *file;
    int lines;
    char original[LINES][1024], text[LINES][1024];
} in;
static int line;       /* that is read */
static const char *at; /* what of it is not read yet */
static int depth;      /* of brackets: blanks count for nothing inside */

static void refuse_at(int row, long column, const char *format, ...)
{
    va_list arguments;
    fprintf(stderr, "%s:%d:%ld: ", in.file, row + 1, column + 1);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, "\n  %s\n  %*s^\n", in.lines > row ? in.original[row] : "", (int)column, "");
    exit(2);
}

#define refuse(place, ...) refuse_at(line, (place)-in.text[line], __VA_ARGS__)

/* Signs that come along from papers and web pages; \1 is a root. */
static void to_ascii(const char *from, char *to)
{
    static const char *const sign[] = {"\u2212-", "\u2013-", "\u221a\1", "\u00b7*", "\u00d7*", "\u2502|"};
    size_t i, n;
    while (*from) {
        for (i = 0; i < sizeof sign / sizeof *sign; i++) {
            n = strlen(sign[i]) - 1;
            if (strncmp(from, sign[i], n) == 0) break;
        }
        if (i < sizeof sign / sizeof *sign) {
            *to++ = sign[i][n];
            from += n;
            continue;
        }
        *to++ = *from++;
        while ((*from & 0xc0) == 0x80) from++; /* what is left of another sign */
    }
    *to = 0;
}

static void read_text(FILE *file)
{
    static char buffer[1024];
    for (; fgets(buffer, sizeof buffer, file); in.lines++) {
        if (in.lines == LINES) refuse_at(LINES, 0, "more than %d lines", LINES);
        if (!strchr(buffer, '\n') && !feof(file)) refuse_at(in.lines, 0, "the line is too long");
        buffer[strcspn(buffer, "\r\n")] = 0;
        strcpy(in.original[in.lines], buffer);
        buffer[strcspn(buffer, "#")] = 0;
        to_ascii(buffer, in.text[in.lines]);
    }
}

/* ---- numbers: sum = product {+- product}, product = power {* or / power} --------------------- */

static struct {
    char name[16];
    long double value;
} constant[NAMES];
static int constants;

static long double sum_of(void);

static int is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static void skip_blanks(void)
{
    while (is_blank(*at)) at++;
}

/* The operator that goes on with a number, or 0: "1-g", "1 - g", but not "1 -g". */
static char next_operator(const char *set)
{
    const char *p = at;
    while (is_blank(*p)) p++;
    if (!*p || !strchr(set, *p)) return 0;
    if (depth == 0 && p > at && !is_blank(p[1])) return 0;
    at = p + 1;
    skip_blanks();
    return *p;
}

static long double in_brackets(const char *of)
{
    const char *open = at;
    long double v;
    if (*at != '(') refuse(at, "%s wants brackets", of);
    at++, depth++;
    skip_blanks();
    v = sum_of();
    skip_blanks();
    if (*at != ')') refuse(*at ? at : open, *at ? "a closing bracket is due here" : "this bracket is not closed");
    at++, depth--;
    return v;
}

static size_t name_length(const char *p)
{
    size_t n = 0;
    if (isalpha((unsigned char)*p))
        while (isalnum((unsigned char)p[n]) || p[n] == '_') n++;
    return n;
}

static long double named(void)
{
    static const struct {
        const char *name;
        long double (*f)(long double);
    } known[] = {{"sqrt", sqrtl}, {"cbrt", cbrtl}, {"cos", cosl}, {"sin", sinl},
                 {"tan", tanl},   {"acos", acosl}, {"exp", expl}, {"log", logl}};
    const char *start = at;
    const size_t n = name_length(at);
    size_t i;
    int j;
    at += n;
    if (n == 2 && strncmp(start, "pi", n) == 0) return acosl(-1);
    for (j = 0; j < constants; j++)
        if (strlen(constant[j].name) == n && strncmp(start, constant[j].name, n) == 0) return constant[j].value;
    for (i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].name) == n && strncmp(start, known[i].name, n) == 0) return known[i].f(in_brackets(known[i].name));
    refuse(start, "the name %.*s is not known; a line \"%.*s = ..\" above defines it", (int)n, start, (int)n, start);
    return 0;
}

static long double factor_of(void)
{
    long double v;
    char *end;
    if (*at == '-') return at++, -factor_of();
    if (*at == '+') return at++, factor_of();
    if (*at == '\1') return at++, sqrtl(factor_of());
    if (*at == '(') return in_brackets("");
    if (isalpha((unsigned char)*at)) return named();
    if (!isdigit((unsigned char)*at) && !(*at == '.' && isdigit((unsigned char)at[1])))
        refuse(at, *at ? "a number is due here" : "the line ends where a number is due");
    v = strtold(at, &end);
    at = end;
    return v;
}

static long double power_of(void)
{
    const long double v = factor_of();
    if (*at != '^') return v;
    at++;
    return powl(v, factor_of());
}

static long double product_of(void)
{
    long double v = power_of();
    const char *place = at;
    char c;
    while ((c = next_operator("*/")) != 0) {
        const long double w = power_of();
        if (c == '/' && w == 0) refuse(place, "division by zero");
        v = c == '*' ? v * w : v / w;
        place = at;
    }
    return v;
}

static long double sum_of(void)
{
    long double v = product_of();
    char c;
    while ((c = next_operator("+-")) != 0) v += c == '+' ? product_of() : -product_of();
    return v;
}

/* ---- the tableau ---------------------------------------------------------------------------- */

typedef struct row {
    int line, count, bar; /* numbers in front of the bar, or -1 */
    long column[MOST + 2];
    long double v[MOST + 2];
} row;

typedef struct half {
    int rows, stages, has_c, has_b, has_hat;
    row stage[MOST], b, hat;
    long double A[MOST][MOST], w[2][MOST], c[MOST]; /* w: b and bhat */
} half;

static struct {
    char name[40];
    int halves, order, pair; /* what is claimed, or 0 */
    half half[2];
} tableau;

static int separates(char c)
{
    return c && strchr(" \t,&;[]{}", c) != NULL;
}

static void read_numbers(row *r)
{
    memset(r, 0, sizeof *r);
    r->line = line, r->bar = -1;
    for (;;) {
        const char *place;
        while (separates(*at)) at++;
        if (!*at) return;
        place = at;
        if (*at == '|') {
            if (r->bar >= 0) refuse(at, "a second bar |");
            r->bar = r->count, at++;
            continue;
        }
        if (r->count == MOST + 1) refuse(at, "more than %d stages", MOST);
        r->column[r->count] = place - in.text[line];
        depth = 0;
        r->v[r->count] = sum_of();
        if (!(fabsl(r->v[r->count++]) <= 1e30L)) refuse(place, "this number is not finite");
        if (*at && *at != '|' && !separates(*at)) refuse(at, "'%c' is not understood in a number", *at);
    }
}

/* Whether the line begins with that word; *at is then behind it and the bar, = or : that follows. */
static int begins_with(const char *word)
{
    const size_t n = strlen(word);
    if (strncmp(at, word, n) != 0 || name_length(at) > n) return 0;
    at += n;
    skip_blanks();
    if (*at && strchr("|=:", *at)) at++;
    skip_blanks();
    return 1;
}

static void read_constant(void)
{
    const size_t n = name_length(at);
    const char *place = at;
    if (constants == NAMES || n >= sizeof constant->name) refuse(at, "too many constants, or too long a name");
    at += n;
    skip_blanks();
    at++;
    skip_blanks();
    constant[constants].value = sum_of();
    memcpy(constant[constants].name, place, n);
    constants++;
    skip_blanks();
    if (*at) refuse(at, "'%c' is not understood behind the constant", *at);
}

static int is_rule(const char *p)
{
    const size_t n = strspn(p, "-=+|_ \t");
    return !p[n] && (strstr(p, "--") || strstr(p, "==") || strstr(p, "__"));
}

static int is_constant(const char *p)
{
    size_t n = name_length(p);
    if (n == 0) return 0;
    while (is_blank(p[n])) n++;
    return p[n] == '=';
}

static void read_row(half *h)
{
    row r;
    const int hat = begins_with("bhat") || begins_with("b^") || begins_with("b*"), b = !hat && begins_with("b");
    const char *place = at;
    read_numbers(&r);
    if (hat || b) r.bar = 0;
    if (r.count == 0) refuse(place, "numbers are due here");
    if (r.bar != 0) {
        if (h->has_b) refuse(place, "a stage below b; \"explicit\" or \"implicit\" begins the other half");
        if (h->rows == MOST) refuse(place, "more than %d stages", MOST);
        h->stage[h->rows++] = r;
    } else if (hat || (!b && h->has_b)) {
        if (h->has_hat) refuse(place, "a second bhat");
        h->hat = r, h->has_hat = 1;
    } else {
        if (h->has_b) refuse(place, "a second b");
        h->b = r, h->has_b = 1;
    }
}

static void read_line(void)
{
    static int half_named;
    half *h = &tableau.half[tableau.halves ? tableau.halves - 1 : 0];
    char *end;
    const char *place;
    at = in.text[line];
    skip_blanks();
    place = at;
    if (!*at || is_rule(at)) return;
    if (begins_with("name")) {
        const size_t n = name_length(at);
        if (n == 0 || n > 31 || at[n + strspn(at + n, " \t")])
            refuse(at, "a name has letters, digits and _, at most 31, and begins with a letter");
        memset(tableau.name, 0, sizeof tableau.name);
        memcpy(tableau.name, at, n);
    } else if (begins_with("order")) {
        tableau.order = (int)strtol(at, &end, 10);
        tableau.pair = (int)strtol(end, &end, 10);
        if (tableau.order < 1 || tableau.pair < 0 || end[strspn(end, " \t")]) refuse(at, "\"order 5\" or \"order 5 4\" is due here");
    } else if (begins_with("explicit") || begins_with("implicit")) {
        if (tableau.halves > 0 && h->rows == 0) refuse(place, "the half above is empty");
        if (tableau.halves == 2) refuse(place, "a third half");
        if (tableau.halves == 1 && !half_named) refuse(place, "the first half has no such line above it");
        half_named = 1, tableau.halves++;
    } else if (is_constant(at) && strncmp(at, "b ", 2) && strncmp(at, "b=", 2) && strncmp(at, "bhat", 4)) {
        read_constant();
    } else {
        if (tableau.halves == 0) tableau.halves = 1;
        read_row(h);
    }
}

/* Weights of a row into v, from number `first` of the row on. */
static void place_row(const row *r, int first, int stages, int whole, long double *v)
{
    const int n = r->count - first;
    if (n > stages) refuse_at(r->line, r->column[first + stages], "%d weights in a row of a tableau with %d stages", n, stages);
    if (whole && n < stages) refuse_at(r->line, r->column[r->count - 1], "%d weights only, but there are %d stages", n, stages);
    memcpy(v, r->v + first, (size_t)n * sizeof *v);
}

/* c where it is not given: the sums of the rows. */
static void row_sums(half *h)
{
    int i, j;
    if (h->has_c) return;
    for (i = 0; i < h->stages; i++)
        for (h->c[i] = 0, j = 0; j < h->stages; j++) h->c[i] += h->A[i][j];
}

static void assemble(half *h, const half *first)
{
    const int s = h->stages = h->rows;
    int i;
    if (s == 0) refuse_at(in.lines ? in.lines - 1 : 0, 0, "no stages: rows \"c | a_1 a_2 ..\", then \"b | ..\"");
    if (!h->has_b && h == first) refuse_at(in.lines - 1, 0, "the text ends without a row b");
    for (i = 0; i < s; i++) {
        const row *r = &h->stage[i];
        const int has_c = r->bar == 1 || (r->bar < 0 && r->count == s + 1);
        if (r->bar > 1) refuse_at(r->line, r->column[1], "one number, c, stands in front of the bar");
        if (r->bar < 0 && r->count != s && r->count != s + 1)
            refuse_at(r->line, r->column[r->count - 1], "%d numbers without a bar: %d are due, or %d with c", r->count, s, s + 1);
        if (i > 0 && has_c != h->has_c) refuse_at(r->line, r->column[0], "some rows have c, others not");
        h->has_c = has_c;
        if (has_c) h->c[i] = r->v[0];
        place_row(r, has_c, s, r->bar < 0, h->A[i]);
    }
    row_sums(h);
    if (h->has_b) place_row(&h->b, 0, s, 1, h->w[0]);
    else memcpy(h->w[0], first->w[0], sizeof h->w[0]);
    if (h->has_hat) place_row(&h->hat, 0, s, 1, h->w[1]);
    if (h != first && s != first->stages) refuse_at(h->stage[0].line, 0, "the halves have %d and %d stages", first->stages, s);
    if (!h->has_b && !h->has_hat && first->has_hat) memcpy(h->w[1], first->w[1], sizeof h->w[1]), h->has_hat = 1;
    if (h != first && h->has_hat != first->has_hat) refuse_at(h->stage[0].line, 0, "bhat in one half only");
}

/* ---- in doubles: each number and each b - bhat rounded once ---------------------------------- */

typedef struct numbers {
    double A[MOST * MOST], b[MOST], c[MOST], bhat[MOST], e[MOST];
} numbers;

static rk_table table_of(const half *h, numbers *to)
{
    const int s = h->stages;
    rk_table T;
    int i, j;
    for (i = 0; i < s; i++) {
        for (j = 0; j < s; j++) to->A[i * s + j] = (double)h->A[i][j];
        to->b[i] = (double)h->w[0][i], to->c[i] = (double)h->c[i], to->bhat[i] = (double)h->w[1][i];
        to->e[i] = (double)(h->w[0][i] - h->w[1][i]);
    }
    memset(&T, 0, sizeof T);
    T.name = tableau.name, T.stages = s, T.A = to->A, T.b = to->b, T.c = to->c;
    if (h->has_hat) T.bhat = to->bhat, T.e = to->e;
    return T;
}

#define FEW_DIGITS 3e-6 /* a defect that few digits explain */

/* The order that holds up to that defect, and the largest defect below it. */
static int order_of(const rk_table *T, const rk_table *other, int which, double tolerance, double *worst)
{
    double defect, ignored;
    int p;
    if (!worst) worst = &ignored;
    for (*worst = 0, p = 0; p < RK_ORDER_MAX; p++, *worst = fmax(*worst, defect)) {
        defect = rk_defect(T, other, which, p + 1);
        if (!(defect <= tolerance)) break;
    }
    return p;
}

static int order_of_half(const half *h, int which, double tolerance)
{
    static numbers room;
    const rk_table T = table_of(h, &room);
    return order_of(&T, NULL, which, tolerance, NULL);
}

/* ---- order conditions, in long double, by name ----------------------------------------------- */

/* A rooted tree as the levels of its vertices in depth-first order; a colour is a half. */
typedef struct tree {
    int n, level[RK_ORDER_MAX], colour[RK_ORDER_MAX];
} tree;

static int parent(const tree *t, int i)
{
    int p = i - 1;
    while (t->level[p] >= t->level[i]) p--;
    return p;
}

static int behind(const tree *t, int i)
{
    int j = i + 1;
    while (j < t->n && t->level[j] > t->level[i]) j++;
    return j;
}

/* The next colouring, or the next tree (Beyer & Hedetniemi 1980), of more vertices after the last. */
static void next_tree(tree *t, int colours)
{
    int i, p = t->n - 1, q;
    for (i = 0; i < t->n; i++) {
        if (++t->colour[i] < colours) return;
        t->colour[i] = 0;
    }
    while (p > 0 && t->level[p] == 1) p--;
    if (p <= 0) {
        for (i = 0, t->n++; i < t->n && i < RK_ORDER_MAX; i++) t->level[i] = i, t->colour[i] = 0;
        return;
    }
    q = parent(t, p);
    for (i = p; i < t->n; i++) t->level[i] = t->level[i - (p - q)];
}

static long double density(const tree *t)
{
    long double gamma = 1;
    int i;
    for (i = 0; i < t->n; i++) gamma *= behind(t, i) - i;
    return gamma;
}

/* sum b_i Phi_i - 1/gamma; h has as many halves as the tree has colours. */
static long double residual(const half *h, int which, const tree *t)
{
    long double v[RK_ORDER_MAX][MOST], sum = -1 / density(t);
    const int s = h->stages;
    int i, k, l;
    for (i = 0; i < t->n; i++)
        for (l = 0; l < s; l++) v[i][l] = 1;
    for (i = t->n - 1; i > 0; i--) {
        const half *own = &h[t->colour[i]];
        long double *above = v[parent(t, i)];
        for (l = 0; l < s; l++) {
            long double a = own->c[l];
            if (behind(t, i) > i + 1)
                for (a = 0, k = 0; k < s; k++) a += own->A[l][k] * v[i][k];
            above[l] *= a;
        }
    }
    for (l = 0; l < s; l++) sum += h[t->colour[0]].w[which][l] * v[0][l];
    return sum;
}

/* "b_i c_i^2 a_ij c_j": the factors of vertex i, whose index is `letter`; returns the last letter. */
static char write_vertex(const tree *t, int i, char letter, int halves, char *out)
{
    const int end = behind(t, i);
    int leaves[2] = {0, 0}, j;
    char last = letter;
    for (j = i + 1; j < end; j = behind(t, j)) leaves[t->colour[j]] += behind(t, j) == j + 1;
    for (j = 0; j < 2; j++) {
        if (leaves[j] > 0) sprintf(out + strlen(out), " c%s_%c", halves == 1 ? "" : j ? "2" : "1", letter);
        if (leaves[j] > 1) sprintf(out + strlen(out), "^%d", leaves[j]);
    }
    for (j = i + 1; j < end; j = behind(t, j)) {
        if (behind(t, j) == j + 1) continue;
        sprintf(out + strlen(out), " a%s_%c%c", halves == 1 ? "" : t->colour[j] ? "2" : "1", letter, last + 1);
        last = write_vertex(t, j, (char)(last + 1), halves, out);
    }
    return last;
}

/* The condition of that order that fails most, and by how much. */
static void print_worst(const half *h, int halves, int which, int order)
{
    tree t = {1, {0}, {0}}, worst = t;
    long double most = 0;
    char text[200];
    for (; t.n <= order; next_tree(&t, halves)) {
        const long double r = t.n == order ? residual(h, which, &t) : 0;
        if (fabsl(r) > fabsl(most)) most = r, worst = t;
    }
    sprintf(text, "sum %s%s_i", which ? "bhat" : "b", halves == 1 ? "" : worst.colour[0] ? "2" : "1");
    write_vertex(&worst, 0, 'i', halves, text);
    printf("   order %-2d %s is %.4Lg off, worst at %s = 1/%.0Lf\n", order, which ? "of bhat" : halves == 2 ? "together" : "of b",
           most, text, density(&worst));
}

/* ---- misprints ------------------------------------------------------------------------------- */

enum { CONDITIONS = 1300 };

/* All conditions up to that order, and what each row of A lacks of c. */
static int residuals(half *h, int which, int order, long double *r)
{
    tree t = {1, {0}, {0}};
    int n = 0, i, j;
    row_sums(h);
    for (; t.n <= order; next_tree(&t, 1)) r[n++] = residual(h, which, &t);
    for (i = 0; i < h->stages; i++, n++)
        for (r[n] = -h->c[i], j = 0; j < h->stages; j++) r[n] += h->A[i][j];
    return n;
}

/* Gauss and Newton's method in that one number; whether it brings the conditions near 0. */
static int fit_entry(half *h, int which, int order, long double *x, double tolerance)
{
    static long double r[CONDITIONS], right[CONDITIONS], left[CONDITIONS];
    const long double d = 1e-5L;
    long double before = HUGE_VALL;
    int step, i;
    for (step = 0; step < 40; step++) {
        const long double x0 = *x;
        const int n = residuals(h, which, order, r);
        long double over = 0, under = 0, now = 0, worst = 0;
        *x = x0 + d, residuals(h, which, order, right);
        *x = x0 - d, residuals(h, which, order, left);
        *x = x0;
        for (i = 0; i < n; i++) {
            const long double slope = (right[i] - left[i]) / (2 * d);
            over += slope * r[i], under += slope * slope, now += r[i] * r[i];
            worst = fmaxl(worst, fabsl(r[i]));
        }
        if (!(under > 0) || (step > 2 && now > 0.9L * before)) return worst <= 10 * tolerance;
        before = now;
        *x = x0 - over / under;
    }
    return 0;
}

/* A fraction with a small denominator where there is one. */
static void write_number(long double x, char *out)
{
    long double rest = x, p0 = 0, q0 = 1, p = 1, q = 0;
    int i;
    for (i = 0; i < 12 && q < 1e6L; i++) {
        const long double whole = floorl(rest), p1 = p, q1 = q;
        p = whole * p + p0, q = whole * q + q0, p0 = p1, q0 = q1;
        if (fabsl(x - p / q) <= 1e-15L * fmaxl(1, fabsl(x))) {
            sprintf(out, q == 1 ? "%.0Lf" : "%.0Lf/%.0Lf", p, q);
            return;
        }
        rest = 1 / (rest - whole);
    }
    sprintf(out, "%.16Lg", x);
}

typedef struct cure {
    char entry[16];
    long double was, is;
    int order;
} cure;

/* Whether another number in this place alone raises the order, and so mends two conditions or more. */
static int try_entry(half *h, int which, int p, double tolerance, long double *x, cure *found)
{
    static long double r[CONDITIONS];
    const int other = h->has_hat ? order_of_half(h, !which, tolerance) : 0;
    int i, n, failed = 0, ok;
    found->was = *x;
    ok = fit_entry(h, which, p + 1, x, tolerance);
    found->is = *x;
    ok = ok && (found->order = order_of_half(h, which, tolerance)) > p;
    if (ok && h->has_hat) ok = order_of_half(h, !which, tolerance) >= other;
    *x = found->was;
    n = residuals(h, which, ok ? found->order : p, r);
    for (i = 0; i < n; i++) failed += fabsl(r[i]) > 50 * tolerance;
    return ok && failed > 1;
}

/* All entries that the form of the table leaves free; those of the highest order in best. */
static int search(half *h, int which, int p, double tolerance, cure *best, int most)
{
    const int s = h->stages;
    int i, j, coupled = 0, count = 0;
    cure found;
    for (i = 0; i < s * s; i++) coupled |= i % s > i / s && h->A[i / s][i % s] != 0;
    for (i = h->has_c ? -2 : -1; i < s; i++) /* c, then the weights, then the rows of A */
        for (j = 0; j < s; j++) {
            long double *const x = (i >= 0 ? h->A[i] : i == -1 ? h->w[which] : h->c) + j;
            if (i >= 0 && !coupled && j >= i && *x == 0) continue;
            if (!try_entry(h, which, p, tolerance, x, &found)) continue;
            if (i < 0) sprintf(found.entry, "%s_%d", i == -2 ? "c" : which ? "bhat" : "b", j + 1);
            else sprintf(found.entry, s < 10 ? "a_%d%d" : "a_%d,%d", i + 1, j + 1);
            if (count > 0 && found.order < best->order) continue;
            if (count > 0 && found.order > best->order) count = 0;
            if (count < most) best[count] = found;
            count++;
        }
    row_sums(h);
    return count;
}

static int print_misprint(half *h, int which, double tolerance)
{
    enum { SHOWN = 3 };
    cure best[SHOWN];
    const int p = order_of_half(h, which, tolerance), count = p < 9 ? search(h, which, p, tolerance, best, SHOWN) : 0;
    char was[40], is[40];
    int i;
    for (i = 0; i < count && count <= SHOWN; i++) {
        write_number(best[i].was, was);
        write_number(best[i].is, is);
        printf("   MISPRINT %s %s = %s for %s gives order %d of %s\n", i ? "or" : "?", best[i].entry, is, was, best[i].order,
               which ? "bhat" : "b");
    }
    return count > 0 && count <= SHOWN;
}

/* ---- stability ------------------------------------------------------------------------------- */

/* |R(z)|, R = 1 + z b^T (I - zA)^-1 1; HUGE_VAL at a pole. */
static double growth(const rk_table *T, double complex z)
{
    double complex M[MOST * MOST], x[MOST], R = 1;
    const int s = T->stages, m = s + T->extra, one = 1;
    int pivot[MOST], info, i, j;
    for (i = 0; i < s; i++)
        for (x[i] = 1, j = 0; j < s; j++) M[j * s + i] = (i == j) - z * T->A[i * m + j];
    zgesv_(&s, &one, M, &s, pivot, x, &s, &info);
    for (i = 0; i < s; i++) R += z * T->b[i] * x[i];
    return info == 0 ? cabs(R) : HUGE_VAL;
}

#define STABLE (1 + 1e-12)

/* How far |R| <= 1 holds from 0 in that direction; HUGE_VAL beyond 1e4. */
static double reach(const rk_table *T, double complex direction)
{
    double low = 0, high, step = 1e-3;
    while (low < 1e4 && growth(T, (low + step) * direction) <= STABLE) low += step, step = 1e-3 + 1e-3 * low;
    if (low >= 1e4) return HUGE_VAL;
    for (high = low + step; high - low > 1e-9 * high;) {
        const double middle = (low + high) / 2;
        if (growth(T, middle * direction) <= STABLE) low = middle;
        else high = middle;
    }
    return low < 0.1 ? 0 : low; /* where |R| - 1 grows as y^6 or y^8 */
}

/* Whether |R| <= 1 on the ray at that angle from the negative real axis, at 4000 points. */
static int ray_is_stable(const rk_table *T, double angle, double *worst)
{
    int i;
    *worst = 0;
    for (i = 0; i < 4000; i++) *worst = fmax(*worst, growth(T, -pow(10, -3 + i / 400.) * cexp(up * angle)));
    return *worst <= 1 + 1e-9;
}

/* The largest angle between the negative real axis and a pole 1/lambda, lambda an eigenvalue of A. */
static double free_of_poles(const rk_table *T)
{
    double A[MOST * MOST], re[MOST], im[MOST], work[8 * MOST], angle = pi;
    const int s = T->stages, m = s + T->extra, one = 1, lwork = 8 * MOST;
    int i, info;
    for (i = 0; i < s * s; i++) A[i] = T->A[i % s * m + i / s];
    dgeev_("N", "N", &s, A, &s, re, im, NULL, &one, NULL, &one, work, &lwork, &info);
    for (i = 0; i < s; i++)
        if (hypot(re[i], im[i]) > 1e-10) angle = fmin(angle, atan2(fabs(im[i]), -re[i]));
    return angle;
}

/* By the maximum principle |R| <= 1 in a sector if it is on its rays and no pole lies inside. */
static void print_stability(const rk_table *T)
{
    const double real = reach(T, -1), imaginary = reach(T, up), poles = free_of_poles(T), far = growth(T, -1e10);
    double low = 0, high = pi / 2, worst;
    int i;
    if (rk_is(T, RK_EXPLICIT) == 1) {
        printf("   stable   |R| <= 1 on [-%.2f, 0] and i[-%.2f, %.2f]\n", real, imaginary, imaginary);
        return;
    }
    if (poles > high && ray_is_stable(T, high, &worst)) {
        printf("   stable   %s-stable: |R| <= 1 on the imaginary axis, no pole to its left, |R(-inf)| %.2g\n",
               far < 1e-6 ? "L" : "A", far < 1e-6 ? 0 : far);
        return;
    }
    for (i = 0; i < 12; i++) {
        const double middle = (low + high) / 2;
        if (middle < poles && ray_is_stable(T, middle, &worst)) low = middle;
        else high = middle;
    }
    ray_is_stable(T, pi / 2, &worst);
    printf("   stable   not A-stable: largest |R| on the imaginary axis %.3g, |R(-inf)| %.2g; ", worst, far);
    if (low > 0.01) printf("A(alpha) with alpha = %.1f degrees\n", low * 180 / pi);
    else printf("|R| <= 1 on [-%.4g, 0] and i[-%.4g, %.4g]\n", real, imaginary, imaginary);
}

/* Whether the step is a convex combination of Euler steps of size h/r: with K = [A 0; b^T 0],
   K (I + rK)^-1 >= 0 and r K (I + rK)^-1 1 <= 1 (Kraaijevanger 1991), for stages that b reaches. */
static int is_monotone(const rk_table *T, double r)
{
    const int s = T->stages, m = s + T->extra, n = s + 1;
    double M[(MOST + 1) * (MOST + 1)], K[(MOST + 1) * (MOST + 1)];
    int pivot[MOST + 1], info, used[MOST + 1] = {0}, i, j, sweep;
    used[s] = 1;
    for (i = 0; i < n * n; i++) { /* transposed by LAPACK's order: X (I + rK) = K */
        const int place = i / n, column = i % n;
        K[i] = 0;
        if (column < s) K[i] = place < s ? T->A[place * m + column] : T->b[column];
        M[i] = (place == column) + r * K[i];
    }
    for (sweep = 0; sweep < s; sweep++)
        for (i = 0; i < n * n; i++) used[i % n] |= used[i / n] && K[i] != 0;
    dgesv_(&n, &n, M, &n, pivot, K, &n, &info);
    for (i = 0; i < n; i++) {
        double sum = 0;
        for (j = 0; j < n; j++) sum += r * K[i * n + j];
        for (j = 0; j < n; j++)
            if (used[i] && K[i * n + j] < -1e-13) return 0;
        if (info || (used[i] && sum > 1 + 1e-12)) return 0;
    }
    return 1;
}

static double ssp_coefficient(const rk_table *T)
{
    double low = 0, high = 1e6;
    if (!is_monotone(T, 1e-4)) return 0;
    if (is_monotone(T, high)) return HUGE_VAL;
    while (high - low > 1e-10 * high && high > 1e-9) {
        const double middle = (low + high) / 2;
        if (is_monotone(T, middle)) low = middle;
        else high = middle;
    }
    return low;
}

/* ---- a step that the tables take: y' = 2 t y (1 - y), y = 1/(1 + exp(-t^2)), halves 2 t y and -2 t y^2 ---- */

enum { ROOM = MOST + MORE };

static double exact(double t)
{
    return 1 / (1 + exp(-t * t));
}

/* Part `half` of f, both where there is one table alone; r times its derivative is *slope. */
static double part(int p, int halves, double t, double y, double *slope)
{
    const double linear = p == 0 || halves == 1, square = p == 1 || halves == 1;
    *slope = 2 * t * (linear - 2 * square * y);
    return 2 * t * (linear * y - square * y * y);
}

/* All stages at once by Newton's method, then the slopes of both parts at k[half]. */
static void solve_stages(const rk_table *const *T, int halves, double t, double h, double y, double k[2][ROOM])
{
    const int m = T[0]->stages + T[0]->extra, one = 1;
    double Z[ROOM], F[ROOM], J[ROOM * ROOM], slope[2][ROOM], size = 1;
    int pivot[ROOM], info, i, j, p, step;
    for (i = 0; i < m; i++) Z[i] = y;
    for (step = 0; step < 50 && size > 0; step++) {
        for (p = 0; p < halves; p++)
            for (i = 0; i < m; i++) k[p][i] = part(p, halves, t + T[p]->c[i] * h, Z[i], &slope[p][i]);
        for (i = 0; i < m; i++) {
            F[i] = y - Z[i];
            for (j = 0; j < m; j++) {
                J[j * m + i] = i == j;
                for (p = 0; p < halves; p++) {
                    F[i] += h * T[p]->A[i * m + j] * k[p][j];
                    J[j * m + i] -= h * T[p]->A[i * m + j] * slope[p][j];
                }
            }
        }
        dgesv_(&m, &one, J, &m, pivot, F, &m, &info);
        for (size = 0, i = 0; i < m && info == 0; i++) Z[i] += F[i], size = fmax(size, fabs(F[i]));
        if (size < 1e-16) size = 0;
    }
}

/* y(t + theta h); theta < 0: the end of the step. */
static double value(const rk_table *const *T, int halves, double h, double y, double k[2][ROOM], double theta)
{
    double weight[RK_STAGES_MAX];
    int p, i;
    for (p = 0; p < halves; p++) {
        const int m = T[p]->stages + T[p]->extra;
        if (theta >= 0) rk_weights(T[p], theta, 0, weight);
        else memcpy(weight, T[p]->b, (size_t)m * sizeof *weight);
        for (i = 0; i < m; i++) y += h * weight[i] * k[p][i];
    }
    return y;
}

/* The error at t = 2 after so many steps from t = 0. */
static double run_error(const rk_table *const *T, int halves, int steps)
{
    double k[2][ROOM], y = exact(0);
    const double h = 2. / steps;
    int i;
    for (i = 0; i < steps; i++) {
        solve_stages(T, halves, i * h, h, y, k);
        y = value(T, halves, h, y, k, -1);
    }
    return fabs(y - exact(2));
}

/* Of the smallest steps whose errors stand above round-off. */
static void print_run(const rk_table *const *T, int halves)
{
    double error[9];
    int i, n;
    for (n = 0; n < 9; n++) {
        error[n] = run_error(T, halves, 4 << n);
        if (!(error[n] > 1e-13)) break;
    }
    printf("   run      y' = 2 t y (1 - y) to t = 2, error in");
    for (i = n > 4 ? n - 4 : 0; i < n; i++) printf(" %d", 4 << i);
    printf(" steps:");
    for (i = n > 4 ? n - 4 : 0; i < n; i++) printf(" %.1e", error[i]);
    if (n > 1) printf(", order %.2f", log2(error[n - 2] / error[n - 1]));
    printf("\n");
}

/* ---- the picture ----------------------------------------------------------------------------- */

/* |R| on a grid for the contour, and the part of each column where |R| <= 1. */
static void plot_region(FILE *g, const rk_table *T, const char *title)
{
    enum { GRID = 140 };
    const int explicit_ = rk_is(T, RK_EXPLICIT) == 1;
    const double real = reach(T, -1), imaginary = reach(T, up);
    const double size = explicit_ ? fmax(2, fmax(real, imaginary) * 1.25) : 12;
    const double left = explicit_ ? -size : -size / 2, right = explicit_ ? size * 0.4 : size;
    const double top = explicit_ ? size * 0.9 : size * 0.75;
    int i, j;
    fprintf(g, "$grid << END\n");
    for (i = 0; i <= GRID; i++, fprintf(g, "\n"))
        for (j = 0; j <= GRID; j++) {
            const double x = left + (right - left) * i / GRID, y = top * (2. * j / GRID - 1);
            fprintf(g, "%g %g %g\n", x, y, fmin(growth(T, x + up * y), 10));
        }
    fprintf(g, "END\nset contour base; unset surface; set cntrparam levels discrete 1\n"
               "set table $edge; splot $grid; unset table; unset contour; set surface\n"
               "set title '%s: |R(z)| <= 1 is shaded'; unset key; unset logscale\n"
               "set xlabel 're z'; set ylabel 'im z'; set format y '%%g'; set size ratio -1\n"
               "set xrange [%g:%g]; set yrange [%g:%g]\n"
               "set palette defined (0 'white', 1 '#c5d9ec'); set cbrange [0:1]; unset colorbox\n"
               "plot $grid using 1:2:($3 <= 1 + 1e-9) with image, "
               "$edge with lines lw 1.5 lc rgb '#1b5e9e', 0 lc rgb '#777777' lw 0.6, "
               "'+' using (0):(%g + $0 * %g) with lines lc rgb '#777777' lw 0.6\n",
            title, left, right, -top, top, -top, top / 50);
}

/* The error inside a step, from the exact value, for three sizes. */
static void plot_dense(FILE *g, const rk_table *const *T, int halves)
{
    static const double size[] = {0.4, 0.2, 0.1};
    double k[2][ROOM];
    int i, j;
    for (i = 0; i < 3; i++) {
        const double t = 0.5, h = size[i];
        solve_stages(T, halves, t, h, exact(t), k);
        fprintf(g, "$dense%d << END\n", i);
        for (j = 1; j <= 100; j++)
            fprintf(g, "%g %g\n", j / 100., fabs(value(T, halves, h, exact(t), k, j / 100.) - exact(t + j / 100. * h)) + 1e-18);
        fprintf(g, "END\n");
    }
    fprintf(g, "set title \"dense output, y' = 2 t y (1 - y) from t = 0.5: error inside a step of h\"\n"
               "set size noratio; set xlabel 'theta'; set ylabel ''; set xrange [0:1]; set yrange [*:*]\n"
               "set logscale y; set format y '10^{%%T}'; set key bottom right\n"
               "plot $dense0 with lines lw 1.5 title 'h = 0.4', $dense1 with lines lw 1.5 title 'h = 0.2', "
               "$dense2 with lines lw 1.5 title 'h = 0.1'\n");
}

static void draw(const rk_table *const *T, int halves, const char *path)
{
    FILE *g;
    int p;
    if (strpbrk(path, "'\n")) {
        printf("   picture  none: the path has a quote in it\n");
        return;
    }
    if (system("command -v gnuplot >/dev/null 2>&1") != 0 || !(g = popen("gnuplot", "w"))) {
        printf("   picture  none: install gnuplot-nox for one\n");
        return;
    }
    fprintf(g, "set terminal svg size %d,420 font 'sans,12' background rgb 'white'\nset output '%s'\n"
               "set linetype 1 lc rgb '#c8442e'; set linetype 2 lc rgb '#2e8b57'; set linetype 3 lc rgb '#8a5fb0'\n"
               "set multiplot layout 1,%d\n", 480 * (halves + (T[0]->powers > 0)), path, halves + (T[0]->powers > 0));
    for (p = 0; p < halves; p++) plot_region(g, T[p], T[p]->name);
    if (T[0]->powers > 0) plot_dense(g, T, halves);
    fprintf(g, "unset multiplot\n");
    printf("   picture  %s%s\n", path, pclose(g) == 0 ? "" : ": gnuplot failed");
}

/* ---- the table in C -------------------------------------------------------------------------- */

static void print_array(const char *name, const char *part_, int rows, int columns, const double *v)
{
    int i, j;
    printf("static const double %s_%s[] = {\n", name, part_);
    for (i = 0; i < rows; i++)
        for (j = 0; j < columns; j++) printf("%s%.17g,%s", j ? " " : "    ", v[i * columns + j], j < columns - 1 ? "" : "\n");
    printf("};\n");
}

static void print_table(const rk_table *T)
{
    const int m = T->stages + T->extra;
    const char *n = T->name;
    print_array(n, "A", m, m, T->A);
    print_array(n, "b", 1, m, T->b);
    print_array(n, "c", 1, m, T->c);
    if (T->bhat) print_array(n, "bhat", 1, m, T->bhat);
    if (T->bhat) print_array(n, "e", 1, T->stages, T->e);
    if (T->d) print_array(n, "d", m, T->powers, T->d);
    printf("static const rk_table %s = {\"%s\", %d, %d, %d, %d, %d, %d,\n    %s_A, %s_b, %s_c, ", n, n, T->stages,
           T->order, T->order_hat, T->powers, T->dense_order, T->extra, n, n, n);
    if (T->bhat) printf("%s_bhat, %s_e, ", n, n);
    else printf("NULL, NULL, ");
    if (T->d) printf("%s_d, NULL, %d};\n", n, T->dense_stiff);
    else printf("NULL, NULL, 0};\n");
}

/* ---- the report ------------------------------------------------------------------------------ */

/* The highest q with A c^(k-1) = c^k/k for k <= q. */
static int stage_order(const half *h)
{
    int q, i, j;
    for (q = 0; q < RK_ORDER_MAX; q++)
        for (i = 0; i < h->stages; i++) {
            long double sum = -powl(h->c[i], q + 1) / (q + 1);
            for (j = 0; j < h->stages; j++) sum += h->A[i][j] * powl(h->c[j], q);
            if (fabsl(sum) > 1e-13L) return q;
        }
    return q;
}

static void print_rows(const half *h)
{
    int i, j, apart = 0;
    for (i = 0; i < h->stages; i++) {
        long double sum = 0;
        for (j = 0; j < h->stages; j++) sum += h->A[i][j];
        if (fabsl(sum - h->c[i]) <= 1e-13L * (1 + fabsl(sum))) continue;
        printf(apart++ ? "; row %d: %.6Lg, c %.6Lg" : "   rows     the sum of row %d is %.6Lg, c is %.6Lg", i + 1, sum, h->c[i]);
    }
    printf(apart ? "\n" : "   rows     c is the sum of each row of A; stage order %d\n", stage_order(h));
}

/* Order of b or of bhat, told with what it rests on; -1: does not hold exactly. */
static int judge(const rk_table *T, const rk_table *other, int which, int *few)
{
    double worst;
    const int exact_ = order_of(T, other, which, RK_TOLERANCE, NULL), p = order_of(T, other, which, FEW_DIGITS, &worst);
    if (p == exact_) return p;
    printf("   digits   order %d%s holds to %.1e only: the numbers have too few digits for rk_check\n", p,
           which ? " of bhat" : other ? " together" : "", worst);
    *few = 1;
    return p;
}

static const char *form_of(const rk_table *T)
{
    if (rk_is(T, RK_EXPLICIT) == 1) return "explicit";
    if (rk_is(T, RK_SEQUENTIAL) != 1) return "fully implicit";
    return "diagonally implicit";
}

static void report_half(half *h, rk_table *T)
{
    int outside = 0, i, few = 0;
    double ssp;
    T->order = judge(T, NULL, RK_OF_STEP, &few);
    if (T->bhat) T->order_hat = judge(T, NULL, RK_OF_PAIR, &few);
    for (i = 0; i < T->stages; i++) outside |= T->c[i] > 1 + 1e-14 || T->c[i] < 0;
    printf("   %s: %d stages, %s, order %d", T->name, T->stages, form_of(T), T->order);
    if (T->bhat) printf(", pair %d", T->order_hat);
    printf("%s%s%s\n", rk_is(T, RK_STIFFLY_ACCURATE) == 1 ? ", stiffly accurate" : "", rk_is(T, RK_FSAL) == 1 ? ", FSAL" : "",
           outside ? ", a stage lies outside the step" : "");
    print_rows(h);
    if (!print_misprint(h, RK_OF_STEP, RK_TOLERANCE) && !(T->bhat && print_misprint(h, RK_OF_PAIR, RK_TOLERANCE)) && few)
        print_misprint(h, RK_OF_STEP, FEW_DIGITS);
    if (T->order < RK_ORDER_MAX) print_worst(h, 1, RK_OF_STEP, T->order + 1);
    if (T->bhat && T->order_hat < RK_ORDER_MAX && T->order_hat < T->order) print_worst(h, 1, RK_OF_PAIR, T->order_hat + 1);
    print_stability(T);
    ssp = ssp_coefficient(T);
    printf(ssp < HUGE_VAL ? "   SSP      coefficient %.4g\n" : "   SSP      for every step size\n", ssp);
}

/* The order of both halves together goes into both tables. */
static int report_together(rk_table *T)
{
    int few = 0, p;
    const int order = judge(&T[0], &T[1], RK_OF_STEP, &few);
    printf("   together: order %d", order);
    for (p = 0; p < 2; p++) T[p].order = order;
    if (T[0].bhat) {
        const int pair = judge(&T[0], &T[1], RK_OF_PAIR, &few);
        printf(", pair %d", pair);
        for (p = 0; p < 2; p++) T[p].order_hat = pair;
    }
    printf("\n");
    if (order < RK_ORDER_MAX) print_worst(tableau.half, 2, RK_OF_STEP, order + 1);
    return order;
}

static void extend(rk_table *T, int halves, int dense, int extra)
{
    static double room[2][ROOM * (7 * ROOM + 27)];
    const rk_table given[2] = {T[0], T[1]};
    int p, status = RK_OK;
    for (p = 0; p < halves && status >= 0; p++)
        status = rk_extend(&T[p], &given[p], halves == 2 ? &given[1 - p] : NULL, dense, extra, room[p], sizeof room[p]);
    if (status < 0) {
        printf("   dense    none: %s\n", rk_message(status));
        T[0] = given[0], T[1] = given[1];
        return;
    }
    printf("   dense    order %d", T->dense_order);
    if (T->extra > 0) printf(" with %d more stages", T->extra);
    if (T[halves - 1].dense_stiff > 0) printf(", %d in a stiff step", T[halves - 1].dense_stiff);
    printf("%s%s\n", status == RK_LESS ? ", less than wanted" : "", status == RK_UNBOUNDED ? ", not for stiff problems" : "");
}

static int claim_fails(const char *of, int claimed, int found)
{
    if (claimed <= found) return 0;
    printf("   CLAIM    order %d of %s does not hold\n", claimed, of);
    return 1;
}

static const char *options(int argc, char **argv, int *dense, int *extra, const char **svg)
{
    const char *file = NULL;
    int i, ok = argc > 1;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--dense") == 0 && i + 1 < argc) *dense = atoi(argv[++i]);
        else if (strcmp(argv[i], "--extra") == 0 && i + 1 < argc) *extra = atoi(argv[++i]);
        else if (strcmp(argv[i], "--svg") == 0 && i + 1 < argc) *svg = argv[++i];
        else if (!file && (argv[i][0] != '-' || !argv[i][1])) file = argv[i];
        else ok = 0;
    }
    if (ok && file && *dense >= 0 && *dense <= RK_ORDER_MAX && *extra >= 0 && *extra <= MORE) return file;
    fprintf(stderr, "usage: table [--dense ORDER] [--extra N] [--svg PATH] FILE\n"
                    "FILE (- is standard input) has a Butcher tableau: rows \"c | a_1 a_2 ..\", then \"b | ..\", perhaps\n"
                    "\"bhat | ..\"; the first comment of examples/table.c says the rest.  ORDER 0 to %d, N 0 to %d.\n",
            RK_ORDER_MAX, MORE);
    exit(2);
}

/* The file's name up to its end, where that is a name. */
static void name_after(const char *file)
{
    const char *slash = strrchr(file, '/'), *start = slash ? slash + 1 : file;
    const size_t n = name_length(start);
    strcpy(tableau.name, "mine");
    if (n > 0 && n < 32 && (start[n] == '.' || !start[n])) memcpy(tableau.name, start, n), tableau.name[n] = 0;
}

int main(int argc, char **argv)
{
    static numbers room[2];
    static char names[2][48], path[4096];
    const char *svg = NULL, *slash = strrchr(argv[0], '/');
    rk_table T[2];
    const rk_table *both[2] = {&T[0], &T[1]};
    int dense = 0, extra = 0, p, failed, order, n;
    FILE *file;
    in.file = options(argc, argv, &dense, &extra, &svg);
    name_after(in.file);
    file = strcmp(in.file, "-") ? fopen(in.file, "r") : stdin;
    if (!file) {
        fprintf(stderr, "%s: cannot be read\n", in.file);
        return 2;
    }
    read_text(file);
    for (line = 0; line < in.lines; line++) read_line();
    n = tableau.halves ? tableau.halves : 1;
    printf("/* of %s:\n", in.file);
    for (p = 0; p < n; p++) {
        assemble(&tableau.half[p], tableau.half);
        T[p] = table_of(&tableau.half[p], &room[p]);
    }
    if (n == 1) T[1] = T[0];
    for (p = 0; p < n; p++) {
        sprintf(names[p], n == 1 ? "%s" : p ? "%s_i" : "%s_e", tableau.name);
        if (n == 2 && rk_is(&T[0], RK_EXPLICIT) != 1) names[p][strlen(names[p]) - 1] = p ? '2' : '1';
        T[p].name = names[p];
        report_half(&tableau.half[p], &T[p]);
    }
    order = n == 2 ? report_together(T) : T[0].order;
    failed = claim_fails("b", tableau.order, order) | claim_fails("bhat", tableau.pair, T[0].order_hat);
    if (order < 1 || (T[0].bhat && T[0].order_hat < 1)) {
        printf("   %s does not sum to 1: no table */\n", order < 1 ? "b" : "bhat");
        return 1;
    }
    extend(T, n, dense, extra);
    print_run(both, n);
    if (!svg) {
        snprintf(path, sizeof path, "%.*s%s.svg", slash ? (int)(slash - argv[0] + 1) : 0, argv[0], tableau.name);
        svg = path;
    }
    fflush(stdout);
    draw(both, n, svg);
    printf("*/\n");
    for (p = 0; p < n; p++) print_table(&T[p]);
    return failed;
}
