/* SPDX-License-Identifier: MIT

   table.c - a Butcher tableau, as people write it: what it is, a picture, and a table of rk.h

      build/table FILE      - is standard input; -h lists the options

   One line per row; # begins a comment, lines of dashes are skipped:

      g = 1 - sqrt(2)/2     a constant
      g   | g               c | a_1 a_2 ..; zeros at the end of a row may be left out
      1   | 1-g  g          without bar: all the s numbers of a row, or c and s numbers
      b   | 1-g  g          the name may be missing, but not the bar
      bhat| 1    0          of a pair, likewise

   Numbers are decimals, fractions, names, pi, sqrt, cbrt, cos, sin, + - * / ^ ( ), also as Julia
   (1//3), Fortran (1.d0, 0.5_wp) and LaTeX (\frac{1}{3}, \sqrt{2}, \hline, rows of & and \\) write
   them.  "1-g" and "1 - g" are one number, "1 -g" are two; blanks , & ; [ ] { } stand between
   numbers.  "name X" names the table, "order 5 4" claims orders of b and of bhat.  A line
   "explicit" or "implicit" stands above each half of an IMEX method; b or bhat that one half lacks
   is that of the other.
   Decimals of 6 and more digits are taken as rounded: where the order conditions hold to such
   digits only, these numbers are polished on them.  Whatever else is rational stays so in the C.
   The report is a comment in front of the C text, so that all of it can be pasted.
   Exit: 0; 1: a claim does not hold, the weights do not sum to 1, or there may be a misprint; 2: the
   input is not understood. */
#define _POSIX_C_SOURCE 200809L /* popen */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

#include <complex.h>
#include <ctype.h>
#include <stdarg.h>

enum { MOST = 24, MORE = 9, ROOM = MOST + MORE, LINES = 200, WIDTH = 1000, NAMES = 32 };

void dgeev_(const char *, const char *, const int *, double *, const int *, double *, double *, double *, const int *,
            double *, const int *, double *, const int *, int *);
void dgelsd_(const int *, const int *, const int *, double *, const int *, double *, const int *, double *, const double *, int *,
             double *, const int *, int *, int *);
void dgesv_(const int *, const int *, double *, const int *, int *, double *, const int *, int *);
void zgesv_(const int *, const int *, double complex *, const int *, int *, double complex *, const int *, int *);

/* ---- the text -------------------------------------------------------------------------------- */

/* original as it is, text in ASCII, one character for one, so that columns agree. */
static struct {
    const char *file;
    int lines;
    char original[LINES][WIDTH], text[LINES][WIDTH];
} in;
static int line;       /* which is read */
static const char *at; /* what of it is not read yet */

static void refuse_at(int row, long column, const char *format, ...)
{
    va_list arguments;
    fprintf(stderr, "%s:%d:%ld: ", in.file, row + 1, column + 1);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, "\n  %s\n  %*s^\n", row < in.lines ? in.original[row] : "", (int)column, "");
    exit(2);
}

#define refuse(place, ...) refuse_at(line, (place)-in.text[line], __VA_ARGS__)

/* Signs of papers and web pages: minus, dash, root (\1), points, cross, bar; the backslash of LaTeX (\2). */
static char to_ascii(const char **from)
{
    static const char *const sign[] = {"\u2212-", "\u2013-", "\u221a\1", "\u00b7*", "\u22c5*", "\u00d7*", "\u2502|"};
    char c = *(*from)++;
    size_t i;
    for (i = 0; i < sizeof sign / sizeof *sign; i++) {
        const size_t n = strlen(sign[i]) - 1;
        if (strncmp(*from - 1, sign[i], n) == 0) c = sign[i][n];
    }
    while ((**from & 0xc0) == 0x80) ++*from; /* the rest of a character of several bytes */
    if (c == '\\') c = '\2';
    return c;
}

static void read_text(FILE *file)
{
    for (; in.lines < LINES && fgets(in.original[in.lines], WIDTH, file); in.lines++) {
        char *to = in.text[in.lines], *original = in.original[in.lines];
        const char *from = original;
        if (!strchr(original, '\n') && !feof(file)) refuse_at(in.lines, 0, "the line is too long");
        original[strcspn(original, "\r\n")] = 0;
        while (*from && *from != '#') *to++ = to_ascii(&from);
        for (to = in.text[in.lines]; (to = strstr(to, "\2hline")) != NULL;) memset(to, ' ', strlen("\2hline"));
    }
    if (!feof(file)) refuse_at(LINES, 0, "more than %d lines, or not readable", LINES - 1);
}

/* ---- numbers: sum = product {+- product}, product = power {* or / power} --------------------- */

#define EXACT  9e15L /* whole numbers up to this are doubles, and products of two of them long doubles */
#define DIGITS 6     /* decimals of so many digits behind the point are rounded numbers */

/* v, and as a fraction p/q unless q is 0; rounded: it was made of decimals that are rounded. */
typedef struct number {
    long double v, p, q;
    int rounded;
} number;

static struct {
    char name[16];
    number value;
} constant[NAMES];
static int constants, depth; /* of brackets: inside blanks separate nothing */

static number sum_of(void);

static long double divisor_of(long double a, long double b)
{
    while (b != 0) {
        const long double rest = fmodl(a, b);
        a = b, b = rest;
    }
    return fabsl(a);
}

/* v with the fraction p/q in lowest terms, or none where these are too large. */
static number fraction(long double v, long double p, long double q, int rounded)
{
    number x = {v, 0, 0, rounded};
    long double d;
    if (!(fabsl(p) < EXACT * EXACT && fabsl(q) < EXACT * EXACT) || q == 0) return x;
    d = divisor_of(p, q) * (q < 0 ? -1 : 1);
    if (fabsl(p / d) > EXACT || q / d > EXACT) return x;
    x.p = p / d, x.q = q / d, x.v = x.p / x.q;
    return x;
}

static number combined(number a, number b, char operation)
{
    const int rounded = a.rounded || b.rounded;
    if (operation == '+') return fraction(a.v + b.v, a.p * b.q + b.p * a.q, a.q * b.q, rounded);
    if (operation == '-') return fraction(a.v - b.v, a.p * b.q - b.p * a.q, a.q * b.q, rounded);
    if (operation == '*') return fraction(a.v * b.v, a.p * b.p, a.q * b.q, rounded);
    return fraction(a.v / b.v, a.p * b.q, a.q * b.p, rounded);
}

static void skip_blanks(void)
{
    at += strspn(at, " \t");
}

static size_t name_length(const char *p)
{
    size_t n = 0;
    if (isalpha((unsigned char)*p))
        while (isalnum((unsigned char)p[n]) || p[n] == '_') n++;
    return n;
}

static int is_word(const char *p, const char *word)
{
    return name_length(p) == strlen(word) && strncmp(p, word, strlen(word)) == 0;
}

/* The operator that goes on with a number, or 0: "1-g", "1 - g", but not "1 -g"; 1//3 is a fraction of Julia. */
static char next_operator(const char *set)
{
    const char *p = at + strspn(at, " \t");
    if (!*p || !strchr(set, *p)) return 0;
    if (depth == 0 && p > at && !strchr(" \t", p[1])) return 0;
    at = p + 1 + (*p == '/' && p[1] == '/');
    skip_blanks();
    return *p;
}

/* ( .. ), or behind a name of LaTeX { .. } */
static number in_brackets(void)
{
    const char *open = at, close = *at == '{' ? '}' : ')';
    number v;
    if (*at != '(' && *at != '{') refuse(at, "an opening bracket is due here");
    at++, depth++;
    skip_blanks();
    v = sum_of();
    skip_blanks();
    if (!*at) refuse(open, "this bracket is not closed");
    if (*at != close) refuse(at, "an operator or a closing bracket is due here");
    at++, depth--;
    return v;
}

static number named(void)
{
    static const struct {
        const char *name;
        long double (*f)(long double);
    } known[] = {{"sqrt", sqrtl}, {"cbrt", cbrtl}, {"cos", cosl}, {"sin", sinl}};
    const char *start = at;
    const int n = (int)name_length(at);
    number v = {0, 0, 0, 0};
    int j;
    at += n;
    v.v = acosl(-1);
    if (is_word(start, "pi")) return v;
    if (is_word(start, "frac") || is_word(start, "tfrac") || is_word(start, "dfrac")) {
        v = in_brackets();
        return combined(v, in_brackets(), '/');
    }
    for (j = 0; j < constants; j++)
        if (is_word(start, constant[j].name)) return constant[j].value;
    for (j = 0; j < 4; j++)
        if (is_word(start, known[j].name)) {
            const number x = in_brackets();
            v.v = known[j].f(x.v);
            v.rounded = x.rounded;
            return v;
        }
    refuse(start, "the name %.*s is not known; a line \"%.*s = ..\" above would define it", n, start, n, start);
    return v;
}

/* Digits, a point, an exponent of C or of Fortran, a kind of Fortran. */
static number decimal(void)
{
    const char *point = at + strspn(at, "0123456789"), *tail;
    const int digits = *point == '.' ? (int)strspn(point + 1, "0123456789") : 0;
    number v;
    char *end;
    long double x = strtold(at, &end);
    at = end;
    if ((*at == 'd' || *at == 'D') && isdigit((unsigned char)at[1 + (at[1] == '-' || at[1] == '+')])) {
        x *= powl(10, strtol(at + 1, &end, 10));
        at = end;
    }
    for (tail = at; *tail == '_' || (tail > at && isalnum((unsigned char)*tail)); tail++) {}
    at = tail;
    v = digits < 16 ? fraction(x, roundl(x * powl(10, digits)), powl(10, digits), digits >= DIGITS) : fraction(x, 0, 0, 1);
    if (v.q != 0 && fabsl(v.v - x) > 1e-18L * fabsl(x)) v.q = 0; /* an exponent */
    if (v.q == 0 || v.rounded) v.v = x;
    return v;
}

static number factor_of(void)
{
    const int digit = isdigit((unsigned char)at[*at == '.']);
    const number zero = {0, 0, 1, 0};
    if (*at == '-') return at++, combined(zero, factor_of(), '-');
    if (*at == '+') return at++, factor_of();
    if (*at == '\2') return at++, factor_of();
    if (*at == '\1') {
        number v;
        at++;
        v = factor_of();
        v.v = sqrtl(v.v), v.q = 0;
        return v;
    }
    if (*at == '(') return in_brackets();
    if (isalpha((unsigned char)*at)) return named();
    if (!*at) refuse(at, "the line ends where a number is due");
    if (!digit) refuse(at, "a number is due here");
    return decimal();
}

static number power_of(void)
{
    number v = factor_of(), x;
    if (*at != '^') return v;
    at++;
    x = factor_of();
    return fraction(powl(v.v, x.v), powl(v.p, x.v), x.q == 1 && x.v >= 0 ? powl(v.q, x.v) : 0, v.rounded || x.rounded);
}

static number product_of(void)
{
    number v = power_of();
    char c;
    while ((c = next_operator("*/")) != 0) v = combined(v, power_of(), c);
    return v;
}

static number sum_of(void)
{
    number v = product_of();
    char c;
    while ((c = next_operator("+-")) != 0) v = combined(v, product_of(), c);
    return v;
}

/* A whole number, as far as a separator. */
static number number_of(const char *separators)
{
    const char *place = at;
    number v;
    depth = 0;
    v = sum_of();
    if (!(fabsl(v.v) <= 1e30L)) refuse(place, "this number is not finite");
    if (*at && *at != '\2' && !strchr(separators, *at)) refuse(at, "not understood behind a number");
    return v;
}

/* ---- the tableau ----------------------------------------------------------------------------- */

typedef struct row {
    int line, count, bar; /* numbers in front of the bar, or -1 */
    long column[MOST + 1];
    number v[MOST + 1];
} row;

typedef struct half {
    int has_c, has_b, has_hat, in_cells; /* in_cells: of LaTeX, c in the first cell of each row */
    char name[40];
    row stage[MOST], b, hat;
    double A[MOST * MOST], w[2][MOST], e[MOST], c[MOST];    /* w: b and bhat */
    number An[MOST * MOST], wn[2][MOST], en[MOST], cn[MOST]; /* as they were written */
    rk_table T;                                             /* made of these */
} half;

static char name[36] = "mine";
static half tableau[2], *reading = tableau; /* explicit and implicit, or one alone; which is read */
static int halves, claimed[2], doubts; /* claimed: orders of b and bhat; doubts: claims that fail, misprints */

static void read_numbers(row *r)
{
    static const char separators[] = " \t,&;[]{}|";
    for (; *at; at++) {
        if (*at == '|') {
            if (r->bar >= 0) refuse(at, "a second bar");
            r->bar = r->count;
        }
        if (strchr(separators, *at) || (*at == '\2' && !isalpha((unsigned char)at[1]))) continue;
        if (r->count == MOST + 1) refuse(at, "more than %d stages", MOST);
        r->column[r->count] = at - in.text[line];
        r->v[r->count] = number_of(separators);
        r->count++;
        if (!*at || *at == '|' || *at == '\2') at--;
    }
}

/* "b |", "b =", "b 1/6 ..": whether the line begins so; *at is behind it then. */
static int begins_with(const char *word)
{
    if (strncmp(at, word, strlen(word)) != 0 || name_length(at) > strlen(word)) return 0;
    at += strlen(word);
    skip_blanks();
    at += *at && strchr("|=:", *at);
    skip_blanks();
    return 1;
}

static void read_constant(void)
{
    const size_t n = name_length(at);
    if (constants == NAMES || n >= sizeof constant->name) refuse(at, "too many, or too long a name");
    memcpy(constant[constants].name, at, n);
    at = strchr(at, '=') + 1;
    skip_blanks();
    constant[constants].value = number_of(" \t");
    constants++;
}

/* A row with an empty place in front of the bar is b, and after that bhat. */
static void read_row(half *h)
{
    const char *place = at;
    const int hat = begins_with("bhat");
    const int b = !hat && begins_with("b");
    row r;
    memset(&r, 0, sizeof r);
    r.line = line, r.bar = -1;
    read_numbers(&r);
    if (*place == '&') h->in_cells = 1; /* the first cell is empty: b or bhat */
    if (hat || b || *place == '&') r.bar = 0;
    if (r.count == 0) refuse(at, "the line ends where numbers are due");
    if (r.bar != 0) {
        if (h->has_b) refuse(place, "a stage below b: \"explicit\" or \"implicit\" begins the other half");
        if (h->T.stages == MOST) refuse(place, "more than %d stages", MOST);
        h->stage[h->T.stages++] = r;
    } else if (hat || (!b && h->has_b)) {
        if (h->has_hat++) refuse(place, "a second row bhat");
        h->hat = r;
    } else {
        if (h->has_b++) refuse(place, "a second row b");
        h->b = r;
    }
}

static void read_line(void)
{
    const char *place = at = in.text[line] + strspn(in.text[line], " \t"), *behind;
    const size_t n = name_length(at);
    int is_constant;
    behind = at + n + strspn(at + n, " \t");
    is_constant = n > 0 && *behind == '=' && !is_word(at, "b") && !is_word(at, "bhat");
    if (!*at || (!at[strspn(at, "-=+|_ \t")] && strpbrk(at, "-=_"))) return; /* a rule */
    if (is_constant) read_constant();
    else if (begins_with("name")) {
        const size_t length = name_length(at);
        if (length == 0 || length > 31 || at[length + strspn(at + length, " \t")])
            refuse(at, "a name begins with a letter and has at most 31 letters, digits and _");
        memcpy(name, at, length), name[length] = 0;
    } else if (begins_with("order")) {
        claimed[0] = (int)number_of(" \t").v;
        skip_blanks();
        if (*at) claimed[1] = (int)number_of(" \t").v;
    } else if (is_word(at, "explicit") || is_word(at, "implicit")) {
        reading = &tableau[*at == 'i'];
        if (reading->T.stages > 0) refuse(place, "a second half of this kind");
        halves++;
    } else {
        halves += halves == 0;
        read_row(reading);
    }
}

/* s weights from number `first` of the row on; `whole`: none may be missing. */
static void place(const row *r, int first, int s, int whole, double *to, number *written)
{
    const int n = r->count - first;
    int j;
    if (n > s) refuse_at(r->line, r->column[first + s], "%d weights, but there are %d stages", n, s);
    if (whole && n < s) refuse_at(r->line, r->column[r->count - 1], "%d weights, but there are %d stages", n, s);
    for (j = 0; j < n; j++) {
        written[j] = r->v[first + j];
        to[j] = (double)written[j].v;
    }
    for (; j < s; j++) written[j].q = 1;
}

/* c where it is not given. */
static void row_sums(half *h)
{
    const int s = h->T.stages;
    int i, j;
    for (i = 0; i < s && !h->has_c; i++)
        for (h->c[i] = 0, j = 0; j < s; j++) h->c[i] += h->A[i * s + j];
}

/* The same of the numbers as they were written, and b - bhat. */
static void written_sums(half *h)
{
    const number zero = {0, 0, 1, 0};
    const int s = h->T.stages;
    int i, j;
    for (i = 0; i < s && !h->has_c; i++)
        for (h->cn[i] = zero, j = 0; j < s; j++) h->cn[i] = combined(h->cn[i], h->An[i * s + j], '+');
    for (i = 0; i < s; i++) h->en[i] = h->has_hat ? combined(h->wn[0][i], h->wn[1][i], '-') : zero;
}

/* Rows into a table, each number and each b - bhat rounded once. */
static void assemble(half *h)
{
    const half *other = &tableau[h == tableau && halves == 2];
    const int s = h->T.stages, last = in.lines > 0 ? in.lines - 1 : 0;
    int i;
    if (s == 0) refuse_at(last, 0, "the text ends without rows \"c | a_1 a_2 ..\"");
    if (halves == 2 && s != other->T.stages) refuse_at(last, 0, "halves of %d and %d stages", s, other->T.stages);
    if (!h->has_b) h->b = other->b, h->has_b = other->has_b;
    if (!h->has_hat) h->hat = other->hat, h->has_hat = other->has_hat;
    if (!h->has_b) refuse_at(last, 0, "the text ends without a row b");
    for (i = 0; i < s; i++) {
        const row *r = &h->stage[i];
        const int has_c = r->bar == 1 || (r->bar < 0 && (h->in_cells || r->count == s + 1));
        if (r->bar > 1) refuse_at(r->line, r->column[1], "one number, c, stands in front of the bar");
        if (r->bar < 0 && !h->in_cells && r->count != s && r->count != s + 1)
            refuse_at(r->line, r->column[r->count - 1], "%d numbers without a bar: %d are due, or %d with c", r->count,
                      s, s + 1);
        if (i > 0 && has_c != h->has_c) refuse_at(r->line, r->column[0], "some rows have c, others not");
        h->has_c = has_c;
        if (has_c) h->cn[i] = r->v[0], h->c[i] = (double)r->v[0].v;
        place(r, has_c, s, 0, h->A + i * s, h->An + i * s);
    }
    row_sums(h);
    place(&h->b, 0, s, 1, h->w[0], h->wn[0]);
    if (h->has_hat) place(&h->hat, 0, s, 1, h->w[1], h->wn[1]);
    written_sums(h);
    for (i = 0; i < s; i++) h->e[i] = (double)h->en[i].v;
    h->T.name = h->name, h->T.A = h->A, h->T.b = h->w[0], h->T.c = h->c;
    if (h->has_hat) h->T.bhat = h->w[1], h->T.e = h->e;
}

/* ---- order conditions ------------------------------------------------------------------------ */

#define FEW_DIGITS 3e-6 /* a defect that numbers of few digits explain */

/* The order that holds up to that defect; *worst is the largest defect of it. */
static int order_of(const rk_table *T, const rk_table *other, int which, double limit, double *worst)
{
    double defect = 0;
    int p;
    for (*worst = 0, p = 0; p < RK_ORDER_MAX; p++, *worst = fmax(*worst, defect)) {
        defect = rk_defect(T, other, which, p + 1);
        if (!(defect <= limit)) break;
    }
    return p;
}

static const char *name_of(const rk_table *other, int which)
{
    if (which == RK_OF_PAIR) return "bhat";
    return other ? "both" : "b";
}

/* The vertex behind the subtree of i. */
static int end_of(const rk_tree *t, int i)
{
    int j = i + 1;
    while (j < t->n && t->level[j] > t->level[i]) j++;
    return j;
}

/* Whether vertex j is a leaf that counts as c.  Where time is apart, a leaf of state is the sum of a row. */
static int is_time(const rk_tree *t, int j, int parts, int apart)
{
    return end_of(t, j) == j + 1 && (!apart || t->colour[j] == parts);
}

/* " c_i^2 a_ij c_j": the factors below vertex i, whose index is `letter`; returns the last letter. */
static char write_vertex(const rk_tree *t, int i, char letter, int parts, int apart, char *out)
{
    static const char *const half_of[] = {"", "E", "I"};
    const int end = end_of(t, i);
    int leaves[3] = {0, 0, 0}, j;
    char last = letter;
    for (j = i + 1; j < end; j = end_of(t, j)) leaves[t->colour[j]] += is_time(t, j, parts, apart);
    for (j = 0; j < 3; j++) {
        if (leaves[j] > 0) sprintf(out + strlen(out), " c%s_%c", half_of[parts == 2 && j < 2 ? j + 1 : 0], letter);
        if (leaves[j] > 1) sprintf(out + strlen(out), "^%d", leaves[j]);
    }
    for (j = i + 1; j < end; j = end_of(t, j)) {
        if (is_time(t, j, parts, apart)) continue;
        sprintf(out + strlen(out), " a%s_%c%c", half_of[parts == 2 ? t->colour[j] + 1 : 0], letter, last + 1);
        last = write_vertex(t, j, (char)(last + 1), parts, apart, out);
    }
    return last;
}

static double weighted(int s, const double *w, const double *phi)
{
    double sum = 0;
    int i;
    for (i = 0; i < s; i++) sum += w[i] * phi[i];
    return sum;
}

/* The condition of that order that is furthest off. */
static void print_worst(const rk_table *T, const rk_table *other, int which, int order)
{
    const rk_table *const both[2] = {T, other};
    const int parts = other ? 2 : 1;
    rk_tree t, worst = {0};
    double most = 0;
    char text[200];
    int apart = 0, i;
    for (t.n = 0; rk_tree_next(&t, T, other, order) == 1;) {
        const rk_table *root = both[t.colour[0] == 1];
        const double r = weighted(T->stages, which ? root->bhat : root->b, t.phi) - 1 / t.gamma;
        if (worst.n == 0 || fabs(r) > fabs(most)) most = r, worst = t;
        for (i = 0; i < order; i++) apart |= t.colour[i] == parts;
    }
    sprintf(text, "sum b%s%s_i", which ? "hat" : "", !other ? "" : worst.colour[0] ? "I" : "E");
    write_vertex(&worst, 0, 'i', parts, apart, text);
    printf("   fails    order %d of %s: %s = 1/%.0f is off by %.1e\n", order, name_of(other, which), text, worst.gamma, most);
}

/* ---- misprints ------------------------------------------------------------------------------- */

enum { CONDITIONS = 400 };

/* What the condition of a shape lacks, with c for leaves, whatever the sums of the rows are. */
static double residual(const half *h, const double *w, const rk_tree *t)
{
    const int s = h->T.stages;
    double v[RK_ORDER_MAX][MOST];
    int i, j, l, up;
    for (i = t->n - 1; i >= 0; i--)
        for (l = 0; l < s; l++) v[i][l] = 1;
    for (i = t->n - 1; i > 0; i--) { /* each vertex multiplies the one above it */
        for (up = i - 1; t->level[up] >= t->level[i];) up--;
        for (l = 0; l < s; l++) {
            double below = is_time(t, i, 1, 0) ? h->c[l] : 0;
            for (j = 0; j < s && !is_time(t, i, 1, 0); j++) below += h->A[l * s + j] * v[i][j];
            v[up][l] *= below;
        }
    }
    return weighted(s, w, v[0]) - 1 / t->gamma;
}

/* All conditions up to that order, and what the sum of each row lacks of c. */
static int residuals(half *h, int which, int order, double *r)
{
    const rk_table *euler = rk_find("euler"); /* the shapes alone */
    const int s = h->T.stages;
    rk_tree t;
    int n = 0, i, j, p;
    row_sums(h);
    for (t.n = 0, p = 1; p <= order; p++)
        while (rk_tree_next(&t, euler, NULL, p) == 1) r[n++] = residual(h, h->w[which], &t);
    for (i = 0; i < s; i++, n++)
        for (r[n] = -h->c[i], j = 0; j < s; j++) r[n] += h->A[i * s + j];
    return n;
}

/* Gauss and Newton's method in that number; stops where it no longer helps. */
static void fit(half *h, int which, int order, double *x)
{
    double r[CONDITIONS], right[CONDITIONS], left[CONDITIONS], before = HUGE_VAL;
    const double d = 1e-4;
    int step, i;
    for (step = 0; step < 40; step++) {
        const double x0 = *x;
        const int n = residuals(h, which, order, r);
        double over = 0, under = 0, now = 0;
        *x = x0 + d, residuals(h, which, order, right);
        *x = x0 - d, residuals(h, which, order, left);
        *x = x0;
        for (i = 0; i < n; i++) {
            const double slope = (right[i] - left[i]) / (2 * d);
            over += slope * r[i], under += slope * slope, now += r[i] * r[i];
        }
        if (!(under > 0) || (step > 2 && now > 0.9 * before)) return;
        before = now;
        *x = x0 - over / under;
    }
}

/* The order that another number in this place alone gives, or 0: what mends one condition more by
   raising the order by one is no evidence. */
static int order_cured(half *h, int which, int p, double limit, double *x, double *cured)
{
    double r[CONDITIONS], ignored;
    const double was = *x;
    int n, order, failed = 0;
    fit(h, which, p + 1, x);
    *cured = *x;
    order = order_of(&h->T, NULL, which, limit, &ignored);
    *x = was;
    n = residuals(h, which, order < 8 ? order : 8, r);
    while (n-- > 0) failed += fabs(r[n]) > 50 * limit;
    return order > p + 1 || (order > p && failed > 1) ? order : 0;
}

/* A fraction if one with a small denominator is that near. */
static void write_number(double x, char *out)
{
    double rest = x, p0 = 0, q0 = 1, p = 1, q = 0;
    while (q < 1e6) {
        const double whole = floor(rest), p1 = p, q1 = q;
        p = whole * p + p0, q = whole * q + q0, p0 = p1, q0 = q1;
        if (fabs(x - p / q) <= 2e-15 * (1 + fabs(x)) && q < 1e6) {
            sprintf(out, q == 1 ? "%.0f" : "%.0f/%.0f", p, q);
            return;
        }
        rest = 1 / (rest - whole);
    }
    sprintf(out, "%.15g", x);
}

/* Number j of c (i = -2), of the weights (i = -1) or of row i of A. */
static double *entry_of(half *h, int which, int i, int j, char *entry, int *row_line)
{
    const row *weights = which ? &h->hat : &h->b;
    *row_line = i == -1 ? weights->line : h->stage[i == -2 ? j : i].line;
    if (i == -2) sprintf(entry, "c_%d", j + 1);
    if (i == -1) sprintf(entry, "%s_%d", name_of(NULL, which), j + 1);
    if (i >= 0) sprintf(entry, "a_%d,%d", i + 1, j + 1);
    if (i < 0) return (i == -2 ? h->c : h->w[which]) + j;
    return h->A + i * h->T.stages + j;
}

/* Tries every number that the form of the table leaves free; says which ones, up to three, give the highest order. */
static int print_misprint(half *h, int which, double limit)
{
    const int s = h->T.stages, coupled = rk_is(&h->T, RK_SEQUENTIAL) != 1;
    char text[4][200], was[40], is[40], entry[24];
    double cured, ignored;
    int p = order_of(&h->T, NULL, which, limit, &ignored), count = 0, best = 0, i, j, at_line;
    for (i = h->has_c ? -2 : -1; i < s && p < 6; i++)
        for (j = 0; j < s; j++) {
            double *x = entry_of(h, which, i, j, entry, &at_line);
            int order;
            if (i >= 0 && !coupled && j >= i && *x == 0) continue;
            order = order_cured(h, which, p, limit, x, &cured);
            if (order == 0 || order < best) continue;
            if (order > best) best = order, count = 0;
            write_number(*x, was), write_number(cured, is);
            sprintf(text[count < 3 ? count : 3], "line %d: %s = %s for %s gives order %d of %s", at_line + 1, entry, is,
                    was, order, name_of(NULL, which));
            count++;
        }
    row_sums(h);
    doubts += count > 0 && count <= 3;
    for (i = 0; i < count && count <= 3; i++) printf("   MISPRINT%s %s\n", i ? ", or" : "?", text[i]);
    return count > 0 && count <= 3;
}

/* ---- numbers of few digits ------------------------------------------------------------------- */

/* The numbers that may move: those that were rounded, equal ones together. */
typedef struct unknowns {
    int count, of[MOST * MOST + 4 * MOST]; /* of: which unknown each number of the table is, -1: none */
    double value[MOST * MOST + 4 * MOST];
} unknowns;

/* Number i of A, c, b, bhat. */
static double *table_number(half *h, int i, const number **written)
{
    const int s = h->T.stages, k = i - s * s;
    if (k < 0) return *written = &h->An[i], &h->A[i];
    if (k < s) return *written = &h->cn[k], &h->c[k];
    return *written = &h->wn[k / s - 1][k % s], &h->w[k / s - 1][k % s];
}

static int table_numbers(const half *h)
{
    const int s = h->T.stages;
    return s * s + s * (h->has_hat ? 3 : 2);
}

static void find_unknowns(half *h, unknowns *U)
{
    const int n = table_numbers(h), s = h->T.stages;
    const number *written;
    int i, j;
    for (U->count = 0, i = 0; i < n; i++) {
        const double v = *table_number(h, i, &written);
        U->of[i] = -1;
        if (!written->rounded || (i >= s * s && i < s * s + s && !h->has_c)) continue;
        for (j = 0; j < U->count && U->value[j] != v; j++) {}
        if (j == U->count) U->value[U->count++] = v;
        U->of[i] = j;
    }
}

static void set_unknowns(half *h, const unknowns *U, const double *x)
{
    const int n = table_numbers(h);
    const number *ignored;
    int i;
    for (i = 0; i < n; i++)
        if (U->of[i] >= 0) *table_number(h, i, &ignored) = x[U->of[i]];
    row_sums(h);
}

/* What b and bhat lack of their orders, and the rows of c; 0: too many conditions. */
static int all_residuals(half *h, const int order[2], double *r)
{
    int n = residuals(h, RK_OF_STEP, order[0], r);
    if (h->has_hat) n += residuals(h, RK_OF_PAIR, order[1], r + n);
    return n;
}

/* Newton's method with the least changes; the largest one, or HUGE_VAL: it does not end. */
static double polish(half *h, const int order[2])
{
    enum { ROWS = 2 * CONDITIONS, COLUMNS = MOST * MOST + 4 * MOST, SPACE = 400000 };
    static double J[ROWS * COLUMNS], r[ROWS], right[ROWS], left[ROWS], singular[COLUMNS], work[SPACE], x[COLUMNS];
    static int room_i[SPACE / 8];
    static unknowns U;
    const double d = 1e-5, rank = 1e-9;
    const int one = 1, room = SPACE;
    double most = 0, worst = HUGE_VAL;
    int step, i, j, n, ld, info, found;
    find_unknowns(h, &U);
    if (U.count == 0) return HUGE_VAL;
    memcpy(x, U.value, sizeof x);
    for (step = 0; step < 8; step++) {
        n = all_residuals(h, order, r);
        for (worst = 0, i = 0; i < n; i++) worst = fmax(worst, fabs(r[i]));
        if (worst < 2e-16) break;
        for (j = 0; j < U.count; j++) {
            const double kept = x[j];
            x[j] = kept + d, set_unknowns(h, &U, x), all_residuals(h, order, right);
            x[j] = kept - d, set_unknowns(h, &U, x), all_residuals(h, order, left);
            x[j] = kept;
            for (i = 0; i < n; i++) J[j * n + i] = (right[i] - left[i]) / (2 * d);
        }
        set_unknowns(h, &U, x);
        ld = n > U.count ? n : U.count;
        dgelsd_(&n, &U.count, &one, J, &n, r, &ld, singular, &rank, &found, work, &room, room_i, &info);
        for (j = 0; j < U.count; j++) x[j] -= r[j];
        set_unknowns(h, &U, x);
    }
    for (j = 0; j < U.count; j++) most = fmax(most, fabs(x[j] - U.value[j]));
    for (i = 0; i < h->T.stages; i++) h->e[i] = h->w[0][i] - h->w[1][i];
    if (worst < 1e-15 && most < 10 * FEW_DIGITS) return most;
    set_unknowns(h, &U, U.value);
    return HUGE_VAL;
}

/* ---- stability ------------------------------------------------------------------------------- */

static const double complex upwards = (double complex)I; /* of type double */

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

/* How far |R| <= 1 holds from 0 in that direction; HUGE_VAL beyond 1e4.  Where |R| - 1 grows as y^6 or y^8 only, it is
   lost in rounding up to .1. */
static double reach(const rk_table *T, double complex direction)
{
    double low = 0, step = 1e-3;
    while (step > 1e-9 * low && low < 1e4) {
        if (growth(T, (low + step) * direction) <= 1 + 1e-12) low += step, step *= 1.01;
        else step /= 2;
    }
    if (low >= 1e4) return HUGE_VAL;
    return low < 0.1 ? 0 : low;
}

/* As it is printed: a host may step to it. */
static double rounded_down(double limit)
{
    return floor(100 * limit + 1e-6) / 100;
}

/* Whether A, without extra stages, has an eigenvalue, and so R a pole, in the left half-plane. */
static int has_pole(const rk_table *T)
{
    double A[MOST * MOST], re[MOST], im[MOST], work[4 * MOST];
    const int s = T->stages, one = 1, length = 4 * MOST;
    int i, info, found = 0;
    memcpy(A, T->A, (size_t)(s * s) * sizeof *A);
    dgeev_("N", "N", &s, A, &s, re, im, NULL, &one, NULL, &one, work, &length, &info);
    for (i = 0; i < s; i++) found |= re[i] < -1e-10;
    return found;
}

/* A-stable, by the maximum principle: |R| <= 1 on the imaginary axis, no pole to its left. */
static void print_stability(const rk_table *T)
{
    const double real = rounded_down(reach(T, -1)), imaginary = rounded_down(reach(T, upwards)), far = growth(T, -1e8);
    double worst = 0;
    int i;
    for (i = 0; i < 4000; i++) worst = fmax(worst, growth(T, upwards * pow(10, -3 + i / 400.)));
    printf("   stable   ");
    if (worst <= 1 + 1e-9 && !has_pole(T)) {
        printf("%s-stable, |R| <= 1 on the imaginary axis, %.2g at infinity\n", far < 1e-6 ? "L" : "A",
               far < 1e-6 ? 0 : far);
        return;
    }
    printf("|R| <= 1 on [-%.2f, 0] and i[-%.2f, %.2f]", real, imaginary, imaginary);
    if (rk_is(T, RK_EXPLICIT) != 1)
        printf("; not A-stable: up to %.3g on the imaginary axis, %.2g at infinity", worst, far);
    printf("\n");
}

/* Whether the step is a convex combination of Euler steps of size h/r (Kraaijevanger 1991): with K = [A 0; b^T 0] and
   X = K (I + rK)^-1: X >= 0, r X 1 <= 1, for the stages that b reaches. */
static int is_monotone(const rk_table *T, double r)
{
    const int s = T->stages, m = s + T->extra, n = s + 1;
    double M[(MOST + 1) * (MOST + 1)], X[(MOST + 1) * (MOST + 1)], sum;
    int pivot[MOST + 1], used[MOST + 1] = {0}, info, i, j;
    for (i = 0; i < n * n; i++) { /* LAPACK sees the transposed matrices: (I + rK)^T X^T = K^T */
        const int k = i / n, l = i % n;
        X[i] = 0;
        if (l < s) X[i] = k == s ? T->b[l] : T->A[k * m + l];
        M[i] = (k == l) + r * X[i];
    }
    for (used[s] = 1, j = 0; j < s; j++)
        for (i = 0; i < n * n; i++) used[i % n] |= used[i / n] && X[i] != 0;
    dgesv_(&n, &n, M, &n, pivot, X, &n, &info);
    for (i = 0; i < n; i++) {
        for (sum = 0, j = 0; j < n; j++) sum += r * X[i * n + j];
        for (j = 0; j < n; j++)
            if (used[i] && X[i * n + j] < -1e-13) return 0;
        if (info != 0 || (used[i] && sum > 1 + 1e-12)) return 0;
    }
    return 1;
}

static void print_ssp(const rk_table *T)
{
    double low = 1e-4, high = 1e6;
    int i;
    if (!is_monotone(T, low)) printf("   SSP      coefficient 0\n");
    else if (is_monotone(T, high)) printf("   SSP      for steps of every size\n");
    else {
        for (i = 0; i < 60; i++) {
            const double middle = (low + high) / 2;
            if (is_monotone(T, middle)) low = middle;
            else high = middle;
        }
        printf("   SSP      coefficient %.4g\n", low);
    }
}

/* ---- the picture ----------------------------------------------------------------------------- */

/* The leading terms of the error inside a step, sqrt(sum of (r/sigma)^2) over the trees of `order` vertices with
   r = sum_i b_i(theta) Phi_i - theta^order/gamma: for y' = f(y) with derivatives of size 1. */
static double dense_error(const rk_table *T, const rk_table *other, int order, double theta)
{
    double w[2][RK_STAGES_MAX], sum = 0;
    rk_tree t;
    rk_weights(T, theta, 0, w[0]);
    if (other) rk_weights(other, theta, 0, w[1]);
    for (t.n = 0; rk_tree_next(&t, T, other, order) == 1;) {
        const double r = weighted(T->stages + T->extra, w[t.colour[0] == 1], t.phi) - pow(theta, order) / t.gamma;
        sum += pow(r / t.sigma, 2);
    }
    return sqrt(sum);
}

static void plot_dense(FILE *g, const rk_table *T)
{
    const int q = T->dense_order, most = q + 2 < RK_ORDER_MAX ? 2 : 1;
    int i, l;
    fprintf(g,
            "set title 'dense output of order %d: leading errors inside a step'; set size noratio\n"
            "set xlabel 'theta'; set ylabel ''; set xrange [0:1]; set yrange [*:*]; set logscale y\n"
            "set format y '10^{%%T}'; set key bottom center; plot",
            q);
    for (i = 1; i <= most; i++) fprintf(g, " '-' with lines lw 1.5 title 'times h^{%d}',", q + i);
    for (fprintf(g, "\n"), i = 1; i <= most; i++, fprintf(g, "e\n"))
        for (l = 1; l <= 100; l++) {
            const double error = dense_error(T, halves == 2 ? T + 1 : NULL, q + i, l / 100.);
            if (error > 1e-15) fprintf(g, "%g %g\n", l / 100., error);
        }
}

/* |R| on a grid: shaded where it is at most 1, and a line where it is 1. */
static void plot_region(FILE *g, const rk_table *T)
{
    enum { GRID = 140 };
    const int explicit_ = rk_is(T, RK_EXPLICIT) == 1;
    const double size = explicit_ ? fmax(2, 1.25 * fmax(reach(T, -1), reach(T, upwards))) : 12;
    const double left = explicit_ ? -size : -size / 2, right = explicit_ ? 0.4 * size : size;
    int i, j;
    fprintf(g, "$grid << END\n");
    for (i = 0; i <= GRID; i++, fprintf(g, "\n"))
        for (j = 0; j <= GRID; j++) {
            const double x = left + (right - left) * i / GRID, y = 0.9 * size * (2. * j / GRID - 1);
            fprintf(g, "%g %g %g\n", x, y, fmin(growth(T, x + upwards * y), 10));
        }
    fprintf(g,
            "END\nset autoscale; set contour base; unset surface; set cntrparam levels discrete 1\n"
            "set table $edge; splot $grid; unset table; unset contour; set surface; unset key\n"
            "set title '%s: |R(z)| <= 1 is shaded' noenhanced; set xlabel 're z'; set ylabel 'im z'\n"
            "set palette defined (0 'white', 1 '#c5d9ec'); set cbrange [0:1]; unset colorbox\n"
            "set xrange [%g:%g]; set yrange [%g:%g]; set size ratio -1; set zeroaxis lc rgb '#777777'\n"
            "plot $grid using 1:2:($3 <= 1 + 1e-9) with image, $edge with lines lw 1.5 lc rgb '#1b5e9e'\n",
            T->name, left, right, -0.9 * size, 0.9 * size);
}

static void draw(const rk_table *T, const char *path)
{
    const int pictures = halves + (T->powers > 0);
    FILE *g;
    int p;
    printf("   picture  ");
    fflush(stdout);
    if (strcmp(path, "none") == 0) printf("none\n");
    else if (strchr(path, '\'')) printf("none: the path has a quote in it\n");
    else if (system("command -v gnuplot >/dev/null 2>&1") != 0 || !(g = popen("gnuplot", "w")))
        printf("none: install gnuplot-nox for one\n");
    else {
        fprintf(g,
                "set terminal svg size %d,420 font 'sans,12' background rgb 'white'; set output '%s'\n"
                "set linetype 1 lc rgb '#c8442e'; set linetype 2 lc rgb '#2e8b57'\n"
                "set linetype 3 lc rgb '#8a5fb0'; set multiplot layout 1,%d\n",
                480 * pictures, path, pictures);
        for (p = 0; p < halves; p++) plot_region(g, &T[p]);
        if (T->powers > 0) plot_dense(g, T);
        printf("%s%s\n", path, pclose(g) == 0 ? "" : ": gnuplot failed");
    }
}

/* ---- the table in C -------------------------------------------------------------------------- */

/* The number as it was written where that is a fraction, else 17 digits. */
static void print_number(double v, const number *written)
{
    const int whole = written && written->q == 1, fraction_ = written && written->q > 1 && !written->rounded;
    if (fraction_ && (double)written->p / (double)written->q == v) printf("%.0Lf. / %.0Lf", written->p, written->q);
    else if (whole) printf("%.0f", v);
    else printf("%.17g", v);
}

/* Rows of v; written: these numbers as they were, NULL: derived. */
static void print_array(const char *of, const char *what, int rows, int columns, const double *v, const number *written, int ld)
{
    int i, j;
    printf("static const double %s_%s[] = {\n", of, what);
    for (i = 0; i < rows; i++, printf("\n"))
        for (j = 0; j < columns; j++) {
            printf(" %s", j ? "" : "   ");
            print_number(v[i * columns + j], written && i < ld && j < ld ? written + i * ld + j : NULL);
            printf(",");
        }
    printf("};\n");
}

static void print_table(const rk_table *T, const half *h)
{
    const int m = T->stages + T->extra, s = T->stages;
    const char *n = T->name;
    print_array(n, "A", m, m, T->A, h->An, s);
    print_array(n, "b", 1, m, T->b, h->wn[0], s);
    print_array(n, "c", 1, m, T->c, h->cn, s);
    if (T->bhat) print_array(n, "bhat", 1, m, T->bhat, h->wn[1], s);
    if (T->bhat) print_array(n, "e", 1, s, T->e, h->en, s);
    if (T->d) print_array(n, "d", m, T->powers, T->d, NULL, 0);
    printf("static const rk_table %s = {\"%s\", %d, %d, %d, %d, %d, %d, %s_A, %s_b, %s_c,\n    ", n, n, s, T->order, T->order_hat,
           T->powers, T->dense_order, T->extra, n, n, n);
    if (T->bhat) printf("%s_bhat, %s_e, ", n, n);
    else printf("NULL, NULL, ");
    if (T->d) printf("%s_d, NULL, %d};\n", n, T->dense_stiff);
    else printf("NULL, NULL, 0};\n");
}

/* A row of rk.h, zeros at its end left out. */
static void print_row_of_rk(int n, const double *v, const number *written)
{
    int j;
    while (n > 1 && v[n - 1] == 0) n--;
    printf("    {");
    for (j = 0; j < n; j++) {
        print_number(v[j], written ? written + j : NULL);
        printf(j + 1 < n ? ", " : "},\n");
    }
}

/* As the tables of rk.h: c; the rows of A; b unless it is a row of A; bhat and b - bhat; its entry in the list, its line. */
static void print_for_rk(const rk_table *T, const half *h)
{
    const int m = T->stages + T->extra, s = T->stages, accurate = rk_is(T, RK_STIFFLY_ACCURATE) == 1 && T->extra == 0;
    const char *n = T->name;
    int i;
    printf("static const double rk__%s[][%d] = {\n", n, m);
    print_row_of_rk(m, T->c, T->extra ? NULL : h->cn);
    for (i = 0; i < m; i++) print_row_of_rk(m, T->A + i * m, T->extra ? NULL : h->An + i * s);
    if (!accurate) print_row_of_rk(m, T->b, T->extra ? NULL : h->wn[0]);
    if (T->bhat) print_row_of_rk(m, T->bhat, T->extra ? NULL : h->wn[1]);
    if (T->bhat) print_row_of_rk(s, T->e, h->en);
    printf("};\nstatic const double rk__%s_d[][%d] = {\n", n, T->powers);
    for (i = 0; i < m; i++) print_row_of_rk(T->powers, T->d + i * T->powers, NULL);
    printf("};\n    ");
    if (T->extra) printf("{\"%s\", %d, %d, %d, %d, %d, %d, ..}, see verner6\n", n, s, T->order, T->order_hat, T->powers, T->dense_order, T->extra);
    else {
        printf("RK__%s%s(%s, %d, %d, ", T->bhat ? "PAIR" : "SOLO", accurate ? "_SA" : "", n, s, T->order);
        if (T->bhat) printf("%d, ", T->order_hat);
        printf("%d, %d", T->powers, T->dense_order);
        if (accurate || !T->bhat) printf(", %d", T->dense_stiff);
        printf("),\n");
    }
}

/* ---- the report ------------------------------------------------------------------------------ */

/* The order, also where it holds to few digits only. */
static int judge(const rk_table *T, const rk_table *other, int which)
{
    double ignored, worst;
    const int p = order_of(T, other, which, FEW_DIGITS, &worst);
    if (order_of(T, other, which, RK_TOLERANCE, &ignored) < p)
        printf("   digits   order %d of %s holds to %.1e only\n", p, name_of(other, which), worst);
    return p;
}

/* Numbers of few digits become those nearest that meet the order conditions. */
static void polish_half(half *h)
{
    const int order[2] = {h->T.order, h->T.order_hat};
    double ignored, most;
    if (order_of(&h->T, NULL, RK_OF_STEP, RK_TOLERANCE, &ignored) >= order[0] &&
        (!h->has_hat || order_of(&h->T, NULL, RK_OF_PAIR, RK_TOLERANCE, &ignored) >= order[1]))
        return;
    most = halves == 2 || order[0] > 8 ? HUGE_VAL : polish(h, order);
    if (most < 1) printf("   polished on the order conditions; no number moves by more than %.1e\n", most);
    else printf("   polished  no: write the numbers with more digits for rk_check and a dense output\n");
}

static void print_rows(const half *h)
{
    const int s = h->T.stages;
    int i, j, apart = 0;
    for (i = 0; i < s; i++) {
        double sum = 0;
        for (j = 0; j < s; j++) sum += h->A[i * s + j];
        if (fabs(sum - h->c[i]) <= 1e-13 * (1 + fabs(sum))) continue;
        printf(apart++ ? "; of row %d %.6g more" : "   rows     the sum of row %d is %.6g more than c", i + 1, sum - h->c[i]);
    }
    if (apart > 0) printf("\n");
    else printf("   rows     c is the sum of each row%s\n", h->has_c ? "" : ", as none is given");
}

/* sqrt(sum of (r/sigma)^2) over the trees of that order, of b, of bhat or of their difference (which 3). */
static double principal(const rk_table *T, int which, int order)
{
    double sum = 0;
    rk_tree t;
    for (t.n = 0; rk_tree_next(&t, T, NULL, order) == 1;) {
        const double b = weighted(T->stages, T->b, t.phi), hat = T->bhat ? weighted(T->stages, T->bhat, t.phi) : 0;
        const double r = which == 3 ? b - hat : (which ? hat : b) - 1 / t.gamma;
        sum += pow(r / t.sigma, 2);
    }
    return sqrt(sum);
}

/* The numbers by which Dormand and Prince compare methods. */
static void print_constants(const rk_table *T)
{
    const int p = T->order, q = T->order_hat;
    double largest = 0;
    int i;
    if (p >= RK_ORDER_MAX) return;
    for (i = 0; i < T->stages * T->stages; i++) largest = fmax(largest, fabs(T->A[i]));
    for (i = 0; i < T->stages; i++) largest = fmax(largest, fmax(fabs(T->b[i]), fabs(T->c[i])));
    printf("   error    A_%d = %.3g", p + 1, principal(T, RK_OF_STEP, p + 1));
    if (T->bhat && q + 2 <= RK_ORDER_MAX && q >= 1) {
        const double hat = principal(T, RK_OF_PAIR, q + 1);
        printf("; of the pair Ahat_%d = %.3g, B = %.3g, C = %.3g", q + 1, hat, principal(T, RK_OF_PAIR, q + 2) / hat,
               principal(T, 3, q + 2) / hat);
    }
    printf("; D = %.3g\n", largest);
}

/* Powers k for which all stages are exact (sum_j a_ij c_j^(k-1) = c_i^k/k, and b), and for which b A^j does not see what
   they lack. */
static void print_stage_orders(const rk_table *T)
{
    const int s = T->stages;
    double lack[MOST], next[MOST];
    int stage = 0, weak = 0, strong = 1, k, i, j, l;
    for (k = 1; k <= T->order; k++) {
        double seen = 0, off = 0;
        for (i = 0; i < s; i++)
            for (lack[i] = -pow(T->c[i], k) / k, j = 0; j < s; j++) lack[i] += T->A[i * s + j] * pow(T->c[j], k - 1);
        for (i = 0; i < s; i++) off = fmax(off, fabs(lack[i]));
        for (l = 0; l < s; l++) {
            seen = fmax(seen, fabs(weighted(s, T->b, lack)));
            for (i = 0; i < s; i++) next[i] = weighted(s, T->A + i * s, lack);
            memcpy(lack, next, sizeof lack);
        }
        strong = strong && off < 1e-12;
        if (strong) stage = k;
        if (seen > 1e-12) break;
        weak = k;
    }
    printf("   stages   order %d, weak stage order %d\n", stage, weak);
}

/* Of the embedded method. */
static void print_pair_stability(const rk_table *T)
{
    rk_table hat = *T;
    double worst = 0;
    int i;
    hat.b = T->bhat;
    if (rk_is(T, RK_EXPLICIT) == 1) {
        const double real = rounded_down(reach(&hat, -1)), imaginary = rounded_down(reach(&hat, upwards));
        printf("   pair     |Rhat| <= 1 on [-%.2f, 0] and i[-%.2f, %.2f]\n", real, imaginary, imaginary);
        return;
    }
    for (i = 0; i < 4000; i++) worst = fmax(worst, growth(&hat, upwards * pow(10, -3 + i / 400.)));
    printf("   pair     |Rhat| at most %.3g on the imaginary axis, %.2g at infinity\n", worst, growth(&hat, -1e8));
}

static void report_half(half *h)
{
    static const char *const form[] = {"fully implicit", "diagonally implicit", "explicit"};
    rk_table *T = &h->T;
    int outside = 0, i;
    T->order = judge(T, NULL, RK_OF_STEP);
    if (T->bhat) T->order_hat = judge(T, NULL, RK_OF_PAIR);
    polish_half(h);
    for (i = 0; i < T->stages; i++) outside |= T->c[i] > 1 + 1e-14 || T->c[i] < 0;
    printf("   %s: %d stages, %s, order %d", T->name, T->stages, form[rk_is(T, RK_SEQUENTIAL) + rk_is(T, RK_EXPLICIT)],
           T->order);
    if (T->bhat) printf(", pair %d", T->order_hat);
    if (rk_is(T, RK_STIFFLY_ACCURATE) == 1) printf(", stiffly accurate");
    if (rk_is(T, RK_FSAL) == 1) printf(", FSAL");
    printf("%s\n", outside ? ", a stage outside the step" : "");
    print_rows(h);
    if (!print_misprint(h, RK_OF_STEP, RK_TOLERANCE) && (!T->bhat || !print_misprint(h, RK_OF_PAIR, RK_TOLERANCE)))
        print_misprint(h, RK_OF_STEP, FEW_DIGITS);
    if (T->order < RK_ORDER_MAX) print_worst(T, NULL, RK_OF_STEP, T->order + 1);
    if (T->bhat && T->order_hat < RK_ORDER_MAX) print_worst(T, NULL, RK_OF_PAIR, T->order_hat + 1);
    print_constants(T);
    print_stage_orders(T);
    print_stability(T);
    if (T->bhat) print_pair_stability(T);
    print_ssp(T);
}

/* The order of both halves together goes into both tables. */
static void report_together(rk_table *T)
{
    T[0].order = T[1].order = judge(&T[0], &T[1], RK_OF_STEP);
    if (T->bhat) T[0].order_hat = T[1].order_hat = judge(&T[0], &T[1], RK_OF_PAIR);
    printf("   together: order %d", T->order);
    if (T->bhat) printf(", pair %d", T->order_hat);
    printf("\n");
    if (T->order < RK_ORDER_MAX) print_worst(&T[0], &T[1], RK_OF_STEP, T->order + 1);
}

/* The largest |R(z, theta)| of the left half-plane: sampled on the imaginary axis and at infinity, the poles lie to the right. */
static double bound_inside(const rk_table *T)
{
    double complex M[ROOM * ROOM], x[ROOM];
    double w[ROOM], worst = 0;
    const int m = T->stages + T->extra, one = 1;
    int pivot[ROOM], info, n, i, j, q;
    for (n = 0; n <= 1200; n++) {
        const double complex z = upwards * pow(10, -2 + 10 * n / 1200.);
        for (i = 0; i < m; i++)
            for (x[i] = 1, j = 0; j < m; j++) M[j * m + i] = (i == j) - z * T->A[i * m + j];
        zgesv_(&m, &one, M, &m, pivot, x, &m, &info);
        for (q = 0; q <= 100; q++) {
            double complex R = 1;
            rk_weights(T, q / 100., 0, w);
            for (i = 0; i < m; i++) R += z * w[i] * x[i];
            worst = fmax(worst, cabs(R));
        }
    }
    return worst;
}

enum { GRID_AT = 19, DRAWS = 400 };

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Column `at` of rk.h.  Leading terms: the error inside is sum_t w_t r_t(theta) over the trees of order q + 1, the defect
   h (u' - f(u)) its derivative; the w_t, what the problem is, are drawn.  Two thetas are taken for which the larger
   defect over the largest error varies least, and for the divisor the middle of the ratio. */
static void print_at(const rk_table *T)
{
    static double error[DRAWS], defect[DRAWS][GRID_AT], ratio[DRAWS];
    double best = 0, chosen[2] = {0.5, 0.5}, middle = 1;
    unsigned long state = 1;
    int i, j, l, n;
    rk_tree t;
    if (T->dense_order + 1 > 8) return;
    memset(error, 0, sizeof error);
    for (n = 0; n < DRAWS; n++) {
        double inside[101] = {0};
        memset(defect[n], 0, sizeof defect[n]);
        for (t.n = 0; rk_tree_next(&t, T, NULL, T->dense_order + 1) == 1;) {
            double w = 0, weight[RK_STAGES_MAX];
            for (i = 0; i < 12; i++) { /* nearly normal */
                state = (state * 1103515245 + 12345) % 2147483648u;
                w += (double)state / 2147483648. - 0.5;
            }
            for (l = 1; l <= 100; l++) {
                rk_weights(T, l / 100., 0, weight);
                inside[l] += w / t.sigma * (weighted(T->stages + T->extra, weight, t.phi) - pow(l / 100., t.n) / t.gamma);
            }
            for (l = 1; l <= GRID_AT; l++) {
                rk_weights(T, l / 20., 1, weight);
                defect[n][l - 1] += w / t.sigma * (weighted(T->stages + T->extra, weight, t.phi) - t.n * pow(l / 20., t.n - 1) / t.gamma);
            }
        }
        for (l = 1; l <= 100; l++) error[n] = fmax(error[n], fabs(inside[l]));
    }
    for (i = 0; i < GRID_AT; i++)
        for (j = i; j < GRID_AT; j++) {
            for (n = 0; n < DRAWS; n++) ratio[n] = fmax(fabs(defect[n][i]), fabs(defect[n][j])) / error[n];
            qsort(ratio, DRAWS, sizeof *ratio, ascending);
            if (!(ratio[DRAWS / 20] / ratio[DRAWS - 1 - DRAWS / 20] > best)) continue;
            best = ratio[DRAWS / 20] / ratio[DRAWS - 1 - DRAWS / 20];
            middle = sqrt(ratio[DRAWS / 20] * ratio[DRAWS - 1 - DRAWS / 20]);
            chosen[0] = (i + 1) / 20., chosen[1] = (j + 1) / 20.;
        }
    printf("   at       %.2f %.2f, divisor %.2g; within %.2f of it in 9 of 10 problems\n", chosen[0], chosen[1], middle, sqrt(1 / best));
}

/* Into *out: T with dense output where there is one; the weights of the second half serve both. */
static void extend(const rk_table *T, int order, int extra, rk_table *out)
{
    static double room[ROOM * (7 * ROOM + 27)];
    const int l = halves - 1;
    const int status = rk_extend(&out[l], &T[l], l ? T : NULL, order, extra, room, sizeof room);
    if (status < 0) out[l] = T[l];
    if (l) out[0] = T[0];
    if (l && status >= 0) out[0].d = out[1].d, out[0].powers = out[1].powers, out[0].dense_order = out[1].dense_order;
    printf("   dense    ");
    if (status < 0) printf("none: %s\n", rk_message(status));
    else {
        printf("order %d", out[l].dense_order);
        if (out[l].extra > 0) printf(" with %d more stages", out[l].extra);
        if (out[l].dense_stiff > 0) printf(", %d inside a stiff step", out[l].dense_stiff);
        if (status == RK_LESS) printf(", less than wanted");
        if (status == RK_UNBOUNDED) printf(", not for stiff problems");
        else if (rk_is(&out[l], RK_EXPLICIT) != 1) printf(", bounded by %.3f for stiff parts", bound_inside(&out[l]));
        printf("\n");
        if (l == 0) print_at(&out[0]);
    }
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"dense", "0", "order wanted inside the step; 0: the best"},
                        {"extra", "0", "stages that may be added for it, explicit tables"},
                        {"form", "own", "own: an rk_table of yours; rk: rows as in rk.h, for a table of its list"},
                        {"svg", "", "the picture, or none; else NAME.svg beside the program"},
                        {NULL, NULL, NULL}};
    static const char *const suffix[] = {"", "_e", "_i"}, *const forms[] = {"own", "rk", NULL};
    static char path[4096];
    const char *slash = strrchr(argv[0], '/');
    char ask[] = "-h", *help[] = {argv[0], ask};
    rk_table given[2], T[2];
    FILE *file;
    int p, form;
    in.file = argc > 1 ? argv[argc - 1] : "-h";
    scene_parse(strcmp(in.file, "-h") ? argc - 1 : 2, strcmp(in.file, "-h") ? argv : help,
                "a Butcher tableau in FILE, the last argument: what it is, and a table of rk.h", o);
    form = scene_choice(o, "form", forms);
    file = strcmp(in.file, "-") ? fopen(in.file, "r") : stdin;
    if (!file) {
        fprintf(stderr, "%s: cannot be read\n", in.file);
        return 2;
    }
    read_text(file);
    for (line = 0; line < in.lines; line++) read_line();
    halves += halves == 0;
    if (halves == 1) tableau[0] = *reading;
    for (p = 0; p < halves; p++) assemble(&tableau[p]);
    printf("/* %s\n", in.file);
    for (p = 0; p < halves; p++) {
        sprintf(tableau[p].name, "%s%s", name, suffix[halves == 2 ? p + 1 : 0]);
        report_half(&tableau[p]);
        given[p] = tableau[p].T;
    }
    if (halves == 2) report_together(given);
    if (given->order < 1 || (given->bhat && given->order_hat < 1)) {
        printf("   %s does not sum to 1: no table */\n", given->order < 1 ? "b" : "bhat");
        return 1;
    }
    extend(given, scene_integer(o, "dense", 0, RK_ORDER_MAX), scene_integer(o, "extra", 0, MORE), T);
    snprintf(path, sizeof path, "%.*s%s.svg", slash ? (int)(slash - argv[0] + 1) : 0, argv[0], name);
    draw(T, *scene_text(o, "svg") ? scene_text(o, "svg") : path);
    if (claimed[0] > given->order || claimed[1] > given->order_hat) {
        printf("   CLAIMED  order %d, pair %d: found %d, %d\n", claimed[0], claimed[1], given->order, given->order_hat);
        doubts++;
    }
    printf("*/\n");
    for (p = 0; p < halves; p++) {
        if (form == 1 && T[p].d) print_for_rk(&T[p], &tableau[p]);
        else print_table(&T[p], &tableau[p]);
    }
    return doubts > 0;
}
