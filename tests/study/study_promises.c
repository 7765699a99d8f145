/* SPDX-License-Identifier: MIT

   study_promises.c - what the status of iqn.h is worth: an answer where there is one, and none where there is none.

   study_promises [WORD] [stops|rings|units|volumes ...]

   stops    springs with play, x = b - C f(x), C positive definite and f rising: always one answer
   rings    fields that are exchanged at once in a ring, affine, a contraction (loop gain 1/2), in units far apart
   units    two fields in units far apart, quiet windows and then a load: evaluations until the limit of both counts
   volumes  closed volumes and pure Neumann interfaces: u'A = u', u'b not 0, no fixed point; "converged" is wrong

   WORD makes the seeds; "dev" are those of the numbers in the study's README. */
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "arena.h"

enum { MOST = 20 };
static double mem[40000];

/* ---- springs with stops ---- */

typedef struct springs {
    int n;
    double C[MOST * MOST], stiff[MOST], play[MOST], b[MOST];
} springs;

static const springs scenes[] = {
    {2, {.557, -.664, -.664, .96}, {37.1, 30.1}, {-.275, .339}, {-1.12, .72}},
    {2, {.146, -.406, -.406, 2}, {26.3, 40.9}, {.169, -.0502}, {2.09, -.806}},
    {2, {1.22, .301, .301, 2.17}, {15.4, 42.2}, {.019, .411}, {-.419, .548}},
};

static void springs_map(const springs *s, const double *x, double *hx)
{
    int i, j;
    copy(s->n, s->b, hx);
    for (j = 0; j < s->n; j++) {
        const double force = s->stiff[j] * fmax(0, x[j] - s->play[j]);
        for (i = 0; i < s->n; i++) hx[i] -= s->C[i * s->n + j] * force;
    }
}

/* Evaluations, < 0: given up. */
static int springs_run(const springs *s, double growth)
{
    double x[MOST] = {0}, hx[MOST];
    int k, end = 0;
    iqn *q;
    iqn_make(&q, s->n, 20, 1, mem, sizeof mem);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-8);
    iqn_set(q, IQN_GROWTH, growth);
    for (k = 0; end == 0 && k < 500; k++) {
        springs_map(s, x, hx);
        if (iqn_step(q, x, hx) < 0) return -k;
        end = iqn_converged(q);
    }
    return end == 1 ? k : -k;
}

static springs springs_of(chance *c, int n)
{
    springs s;
    double G[MOST * MOST];
    int i, j;
    memset(&s, 0, sizeof s);
    s.n = n;
    for (i = 0; i < n * n; i++) G[i] = normal(c);
    for (i = 0; i < n; i++) {
        s.stiff[i] = 30 * between(c, 0.5, 1.5);
        s.play[i] = 0.5 * normal(c);
        s.b[i] = normal(c);
        for (j = 0; j < n; j++) s.C[i * n + j] = product(n, G + i * n, G + j * n) / n;
    }
    return s;
}

static void print_stops(unsigned long long first)
{
    static const int sizes[] = {2, 5, 20};
    int i, k, g;
    printf("springs with stops, three scenes of two: evaluations (-: given up)");
    for (i = 0; i < 3; i++) printf(" %d", springs_run(scenes + i, 5));
    printf("; IQN_GROWTH 0:");
    for (i = 0; i < 3; i++) printf(" %d", springs_run(scenes + i, 0));
    printf("\n");
    for (k = 0; k < 3; k++)
        for (g = 5; g >= 0; g -= 5) {
            int open = 0, sum = 0;
            for (i = 0; i < 100; i++) {
                chance c = chance_of(first + (unsigned long long)i, 300);
                const springs s = springs_of(&c, sizes[k]);
                const int n = springs_run(&s, g);
                open += n < 0;
                sum += abs(n);
            }
            printf("springs with stops, %2d numbers, IQN_GROWTH %d: given up in %d of 100, evaluations %.1f\n",
                   sizes[k], g, open, sum / 100.);
        }
}

/* ---- rings ---- */

typedef struct ring {
    int fields, n;
    double M[4][5][5], load[5], unit[4];
} ring;

static void ring_map(const ring *s, double load, const double *x, double *hx)
{
    int f, i, j;
    for (f = 0; f < s->fields; f++) {
        const int from = (f + s->fields - 1) % s->fields;
        for (i = 0; i < s->n; i++) {
            double sum = f == s->fields - 1 ? load * s->load[i] : 0;
            for (j = 0; j < s->n; j++) sum += s->M[f][i][j] * x[from * s->n + j] / s->unit[from];
            hx[f * s->n + i] = s->unit[f] * sum;
        }
    }
}

static ring ring_of(chance *c, int fields, int n, double apart)
{
    ring s;
    int f, i, j;
    s.fields = fields;
    s.n = n;
    for (f = 0; f < fields; f++) {
        double size = 0;
        s.unit[f] = pow(apart, 0.5 * (uniform(c) + uniform(c)));
        for (i = 0; i < n; i++)
            for (j = 0; j < n; j++) {
                s.M[f][i][j] = normal(c);
                size += s.M[f][i][j] * s.M[f][i][j];
            }
        for (i = 0; i < n; i++)
            for (j = 0; j < n; j++) s.M[f][i][j] *= (f > 0 ? 1 : -1) * pow(0.5, 1. / fields) / sqrt(size);
    }
    for (i = 0; i < n; i++) s.load[i] = normal(c);
    return s;
}

/* 1: a window is given up.  scaling -1: weights. */
static int ring_run(const ring *s, chance *c, int scaling, int *evaluations, int *windows)
{
    double x[MOST] = {0}, hx[MOST];
    int w, k, f;
    iqn *q;
    iqn_make(&q, s->fields * s->n, 30, s->fields, mem, sizeof mem);
    iqn_set_block(q, -1, IQN_TOL_RELATIVE, 1e-4);
    iqn_set_block(q, -1, IQN_TOL_ABSOLUTE, 1e-30);
    for (f = 0; f < s->fields && scaling < 0; f++) iqn_set_block(q, f, IQN_WEIGHT, 1 / s->unit[f]);
    if (scaling >= 0) iqn_set_block(q, -1, IQN_SCALING, scaling);
    for (w = 0; w < 5; w++) {
        const double load = pow(10, 3 * (uniform(c) + uniform(c)));
        int end = 0;
        for (k = 0; end == 0 && k < 300; k++) {
            ring_map(s, load, x, hx);
            iqn_step(q, x, hx);
            end = iqn_converged(q);
        }
        *evaluations += k;
        ++*windows;
        if (end != 1) return 1;
        iqn_commit(q);
    }
    return 0;
}

static void print_rings(unsigned long long first)
{
    static const struct {
        const char *name;
        int scaling;
    } ways[] = {{"weights", -1},
                {"by value", IQN_BY_VALUE},
                {"by residual", IQN_BY_RESIDUAL},
                {"by residual sum", IQN_BY_RESIDUAL_SUM}};
    int fields, n, far, way, i;
    for (fields = 2; fields <= 4; fields++)
        for (n = 1; n <= 5; n += 2)
            for (far = 0; far < 2; far++) {
                printf("rings, %d fields of %d, units %s apart: given up of 100 (evaluations a window):", fields, n,
                       far ? "1e6" : "1  ");
                for (way = 0; way < 4; way++) {
                    int up = 0, evaluations = 0, windows = 0;
                    for (i = 0; i < 100; i++) {
                        chance c = chance_of(first + (unsigned long long)i, 310);
                        const ring s = ring_of(&c, fields, n, far ? 1e6 : 1);
                        up += ring_run(&s, &c, ways[way].scaling, &evaluations, &windows);
                    }
                    printf("  %s %d (%.1f)", ways[way].name, up, (double)evaluations / windows);
                }
                printf("\n");
            }
}

/* ---- units ---- */

/* Evaluations of the window with the load, < 0: given up.  Displacements in m, forces in N / unit; solvers good to noise */
static int units_run(double unit, double quiet, int at_once, double noise, int scaling)
{
    double x[8] = {0}, h[8];
    int w, k, i, end;
    iqn *q;
    iqn_make(&q, 8, 20, 2, mem, sizeof mem);
    iqn_set_block(q, -1, IQN_TOL_RELATIVE, 1e-4);
    if (scaling < 0) iqn_set_block(q, 0, IQN_WEIGHT, 1 / unit);
    else iqn_set_block(q, -1, IQN_SCALING, scaling);
    for (w = 0;; w++) {
        const double load = w < 2 ? quiet : 1;
        for (end = k = 0; end == 0 && k < 200; k++) {
            for (i = 0; i < 4; i++) h[4 + i] = load * (1 + i) - 0.8 * x[i] / unit + (i ? 0.1 * x[i - 1] / unit : 0);
            for (i = 0; i < 4; i++) h[i] = 0.7 * unit * (at_once ? x : h)[4 + i];
            for (i = 0; i < 8; i++) h[i] *= 1 + noise * sin(1e3 * k + 7 * i);
            if (iqn_step(q, x, h) < 0) return -k;
            end = iqn_converged(q);
        }
        if (end != 1 || w == 2) return end == 1 ? k : -k;
        iqn_commit(q);
    }
}

static void print_units(void)
{
    static const double units[] = {1, 1e2, 1e4, 1e6, 1e9, 1e-4, 1e-9};
    static const char *const names[] = {"weights", "by weight 1", "by value", "by residual", "by residual sum"};
    int way, once, noisy, i;
    printf("units 1, 1e2, 1e4, 1e6, 1e9, 1e-4, 1e-9 apart: evaluations of the window with the load (-: given up)\n");
    for (noisy = 0; noisy < 2; noisy++)
        for (way = -1; way < 4; way++) {
            if (way == 0) continue;
            for (once = 0; once < 2; once++) {
                printf("units, solvers good to %s, %s, %-16s", noisy ? "1e-7" : "1e-9", once ? "at once" : "in turn",
                       names[way + 1]);
                for (i = 0; i < 7; i++) printf(" %3d", units_run(units[i], 1e-9, once, noisy ? 1e-7 : 1e-9, way));
                printf("\n");
            }
        }
}

/* ---- closed volumes ---- */

typedef struct plain_chance {
    unsigned long long state;
} plain_chance;

static double plain_uniform(plain_chance *c) /* in [0, 1) */
{
    c->state = c->state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(c->state >> 11) / 9007199254740992.;
}

static double plain_normal(plain_chance *c)
{
    double sum = -6;
    int i;
    for (i = 0; i < 12; i++) sum += plain_uniform(c);
    return sum;
}

/* 1: iqn_converged says 1 */
static int volume_run(unsigned long long seed, double limit)
{
    plain_chance c;
    double A[MOST][MOST], u[MOST], b[MOST], x[MOST] = {0}, hx[MOST], uu = 0;
    int n, i, j, k, end = 0;
    iqn *q;
    c.state = seed;
    n = 2 + (int)(18 * plain_uniform(&c));
    for (i = 0; i < n; i++) {
        u[i] = plain_normal(&c);
        b[i] = plain_normal(&c);
        uu += u[i] * u[i];
        for (j = 0; j < n; j++) A[i][j] = 0.3 * plain_normal(&c) / sqrt(n);
    }
    for (j = 0; j < n; j++) { /* u'A = u' */
        double miss = u[j];
        for (i = 0; i < n; i++) miss -= u[i] * A[i][j];
        hx[j] = miss;
    }
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) A[i][j] += u[i] * hx[j] / uu;
    iqn_make(&q, n, 20, 1, mem, sizeof mem);
    iqn_set(q, IQN_TOL_RELATIVE, limit);
    for (k = 0; end == 0 && k < 300; k++) {
        for (i = 0; i < n; i++) hx[i] = b[i] + product(n, A[i], x);
        if (iqn_step(q, x, hx) < 0) break;
        end = iqn_converged(q);
    }
    return end == 1;
}

static void print_volumes(unsigned long long first)
{
    static const double limits[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
    int l, i;
    printf("closed volumes without a fixed point, limits 1e-2 1e-3 1e-4 1e-5 1e-6: \"converged\" in");
    for (l = 0; l < 5; l++) {
        int wrong = 0;
        for (i = 0; i < 1000; i++)
            wrong += volume_run(99 + 31 * (unsigned long long)i + 31000 * (first - 1), limits[l]);
        printf(" %d", wrong);
    }
    printf(" of 1000 maps\n");
}

static int chosen(int argc, char **argv, const char *name)
{
    int i;
    for (i = 2; i < argc && strcmp(argv[i], name) != 0;) i++;
    return argc <= 2 || i < argc;
}

int main(int argc, char **argv)
{
    const unsigned long long first = first_seed(argc > 1 ? argv[1] : "dev");
    if (chosen(argc, argv, "stops")) print_stops(first);
    if (chosen(argc, argv, "rings")) print_rings(first);
    if (chosen(argc, argv, "units")) print_units();
    if (chosen(argc, argv, "volumes")) print_volumes(first);
    return 0;
}
