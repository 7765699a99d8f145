/* SPDX-License-Identifier: MIT

   patch.c - a self-consistent field on a line whose mesh is refined in a patch: the norm of the mass matrix

      u(s) = f(s) - strength * integral of exp(-|s - t| / 0.3) u(t) dt + local * sin(3 u(s) + phase(s)),   0 < s < 1

   32 cells, and in the first hundredth of the line, where alone the rough local term acts, as many as you like.  In
   Euclid's norm these nodes outvote the rest the more of them there are, and secants are fitted to what is rough there.  The
   mass matrix M of linear elements weighs by length.  Lumped, it is diagonal, and its norm is Euclid's of scaled unknowns:
   x and H(x) go to iqn_step times the square root of the length that belongs to their node.  A run ends when r'M r (M not
   lumped) has fallen by the square of --tolerance, whatever the norm of the least squares.  With --carry a run begins with
   the secant pairs of the run before, whose rough term had other phases. */
#define IQN_IMPLEMENTATION
#include "iqn.h"
#include "scene.h"

enum { COARSE = 32, MOST = 4096, NODES = COARSE + MOST + 1, LIMIT = 200 };

static const double PATCH = 0.01, REACH = 0.3;

typedef struct field {
    int n; /* nodes */
    double strength, local, s[NODES], weight[NODES], phase[NODES];
} field;

/* xorshift64*, uniform in (0, 1) */
static double uniform(unsigned long long *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 2685821657736338717ULL) >> 11) / 9007199254740992.0;
}

static void field_make(field *f, int cells, unsigned long long seed)
{
    int i;
    f->n = cells + COARSE + 1;
    for (i = 0; i <= cells; i++) f->s[i] = PATCH * i / cells;
    for (i = 1; i <= COARSE; i++) f->s[cells + i] = PATCH + (1 - PATCH) * i / COARSE;
    for (i = 0; i < f->n; i++) {
        const double left = i > 0 ? f->s[i] - f->s[i - 1] : 0, right = i < f->n - 1 ? f->s[i + 1] - f->s[i] : 0;
        f->weight[i] = (left + right) / 2;
        f->phase[i] = 6.283185307179586 * uniform(&seed);
    }
}

/* hx = H(x); the integral by the trapezoidal rule, its two halves by recurrences. */
static void field_map(const field *f, const double *x, double *hx)
{
    double left = 0, right = 0, decay;
    int i;
    for (i = 0; i < f->n; i++) {
        if (i > 0) left = (left + f->weight[i - 1] * x[i - 1]) * exp((f->s[i - 1] - f->s[i]) / REACH);
        hx[i] = 1 + cos(3 * f->s[i]) - f->strength * (left + f->weight[i] * x[i]);
        if (!(f->s[i] > PATCH)) hx[i] += f->local * sin(3 * x[i] + f->phase[i]);
    }
    for (i = f->n - 2; i >= 0; i--) {
        decay = exp((f->s[i] - f->s[i + 1]) / REACH);
        right = (right + f->weight[i + 1] * x[i + 1]) * decay;
        hx[i] -= f->strength * right;
    }
}

/* r'M r, M the mass matrix of linear elements */
static double mass(const field *f, const double *r)
{
    double sum = 0;
    int i;
    for (i = 1; i < f->n; i++) {
        const double h = f->s[i] - f->s[i - 1];
        sum += h / 3 * (r[i - 1] * r[i - 1] + r[i - 1] * r[i] + r[i] * r[i]);
    }
    return sum;
}

/* The pairs of one run into the object of the next, oldest first. */
static void carry_pairs(const iqn *from, iqn *to)
{
    static double v[NODES], w[NODES];
    int j = (int)iqn_get(from, IQN_PAIRS), status;
    while (j-- > 0) {
        scene_check(iqn_pair(from, j, v, w), "iqn_pair");
        status = iqn_push(to, v, w);
        scene_check(status, iqn_message(status));
    }
    iqn_commit(to);
}

/* Evaluations of H until the residual has fallen by the tolerance; LIMIT: it has not.  *last, where there is one, is the
   object of the run before, whose pairs are carried over, and becomes that of this run. */
static int iterations(const field *f, int by_mass, double tolerance, iqn **last)
{
    static double x[NODES], hx[NODES], r[NODES], scale[NODES];
    static void *memory[2];
    const size_t bytes = iqn_size(f->n, 40, 1);
    double norm, first = 0;
    iqn *q;
    int i, k, status;
    void *fresh = scene_memory(bytes);
    scene_check(iqn_make(&q, f->n, 40, 1, fresh, bytes), "iqn_make");
    if (*last) carry_pairs(*last, q);
    free(memory[by_mass]);
    memory[by_mass] = fresh;
    memset(x, 0, sizeof x);
    for (i = 0; i < f->n; i++) scale[i] = by_mass ? sqrt(f->weight[i]) : 1;
    for (k = 1; k < LIMIT; k++) {
        field_map(f, x, hx);
        for (i = 0; i < f->n; i++) r[i] = hx[i] - x[i];
        norm = mass(f, r);
        if (k == 1) first = norm;
        if (norm <= tolerance * tolerance * first) break;
        for (i = 0; i < f->n; i++) x[i] *= scale[i], hx[i] *= scale[i];
        status = iqn_step(q, x, hx);
        scene_check(status, iqn_message(status));
        for (i = 0; i < f->n; i++) x[i] /= scale[i];
    }
    *last = q;
    return k;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"strength", "30", "of the integral; the plain iteration diverges above about 2"},
                        {"local", "0.2", "of the rough term in the patch; below 1/3"},
                        {"tolerance", "1e-6", "by which the residual is to fall"},
                        {"seeds", "10", "phases drawn so many times"},
                        {"carry", "0", "1: each run begins with the secant pairs of the one before"},
                        {NULL, NULL, NULL}};
    static const int cells[] = {4, 16, 64, 256, 1024, 4096};
    static field f;
    double tolerance, total[2];
    int seeds, seed, norm, carry;
    iqn *last[2];
    size_t i;
    scene_parse(argc, argv, "a self-consistent field on a mesh with a refined patch, in two norms", o);
    f.strength = scene_perturbed("strength", scene_number(o, "strength", 0, 1e3));
    f.local = scene_number(o, "local", 0, 0.33);
    tolerance = scene_number(o, "tolerance", 1e-12, 1);
    seeds = scene_integer(o, "seeds", 1, 1000);
    carry = scene_integer(o, "carry", 0, 1);
    for (i = 0; i < sizeof cells / sizeof *cells; i++) {
        total[0] = total[1] = 0;
        last[0] = last[1] = NULL;
        for (seed = 1; seed <= seeds; seed++) {
            field_make(&f, cells[i], (unsigned long long)seed * 7919);
            for (norm = 0; norm < 2; norm++) {
                if (!carry) last[norm] = NULL;
                total[norm] += iterations(&f, norm, tolerance, &last[norm]);
            }
        }
        printf("cells %d iterations euclid %.1f mass %.1f\n", cells[i], total[0] / seeds, total[1] / seeds);
    }
    return 0;
}
