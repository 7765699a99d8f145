/* SPDX-License-Identifier: MIT

   multirate.c - a slow and a fast equation, each with its own step: the KPR problem by every multirate coupling of rk.h.

      u' = G a + e b + r'/(2u)                     slow   a = (u^2 - 1 - r)/(2u)   r = cos(t)/2
      v' = e a - b + s'/(2 sqrt(2 + s))            fast   b = (v^2 - 2 - s)/(2v)   s = cos(w t)

   0 < t < 5, exact u = sqrt(1 + r), v = sqrt(2 + s).  Errors: root mean square over t = 0.1, 0.2, ..., 5.  */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

static double G, w, e;

/* Errors of ARKODE 7.5.0: its checked-in outputs, and where those stop at a loose Newton tolerance the same programs with
   a tight one; SR21, SR32 and MERK54: a program independent of both (ARKODE starts the first fast solve of SR21 and SR32
   from the uncorrected stage, and its MERK54 run ends in round-off). */
static const struct {
    const char *method;
    double hs, u, v;
} reference[] = {
    {"KW3", 0.002, 4.671e-9, 5.637e-10},       {"ERK22a", 0.002, 1.058e-7, 9.569e-8},
    {"ERK33a", 0.002, 4.671e-9, 8.359e-10},    {"ERK45a", 0.002, 1.665e-10, 7.684e-11},
    {"IRK21a", 0.002, 1.039e-9, 1.073e-7},     {"ESDIRK34a", 0.001, 3.771e-10, 3.903e-10},
    {"ESDIRK46a", 0.002, 8.14e-12, 2.453e-11}, {"SR21", 0.001, 2.840e-8, 2.428e-8},
    {"SR32", 0.005, 2.646e-8, 1.931e-8},       {"SR43", 0.01, 7.082e-8, 1.972e-7},
    {"MERK21", 0.001, 2.508e-8, 2.443e-8},     {"MERK32", 0.001, 8.345e-10, 2.735e-10},
    {"MERK43", 0.001, 2.086e-11, 6.766e-12},   {"MERK54", 0.0025, 4.380e-11, 1.353e-11},
};

static void fast(double t, const double *y, double *f)
{
    const double a = (y[0] * y[0] - 1 - cos(t) / 2) / (2 * y[0]), b = (y[1] * y[1] - 2 - cos(w * t)) / (2 * y[1]);
    f[0] = 0;
    f[1] = e * a - b - w * sin(w * t) / (2 * sqrt(2 + cos(w * t)));
}

static double slow_stiff(double t, double u, double v)
{
    return G * (u * u - 1 - cos(t) / 2) / (2 * u) + e * (v * v - 2 - cos(w * t)) / (2 * v);
}

static double slow_mild(double t, double u)
{
    return -sin(t) / (4 * u);
}

/* u = z + g slow(t, u, v), the mild part of the slow function included or not. */
static double solve(double z, double g, double t, double v, int mild)
{
    double u = z, step = 1;
    int i;
    for (i = 0; i < 50 && fabs(step) > 1e-16; i++) {
        const double f = slow_stiff(t, u, v) + (mild ? slow_mild(t, u) : 0);
        const double df = G * (0.5 + (1 + cos(t) / 2) / (2 * u * u)) + (mild ? sin(t) / (4 * u * u) : 0);
        step = (u - z - g * f) / (1 - g * df);
        u -= step;
    }
    return u;
}

/* v' = fast(t, v) + sum_p tau^p F_p from t over `length` in steps of h, the last one shortened; y holds v. */
static void fast_solve(const rk_table *T, double t, double length, double h, int powers, double F[][2], double *y)
{
    const int steps = (int)ceil(length / h - 1e-9);
    double k[2 * RK_STAGES_MAX], z[2];
    int j, i, p;
    for (j = 0; j < steps; j++) {
        const double here = j * h, dt = j + 1 < steps ? h : length - here;
        for (i = 0; i < T->stages; i++) {
            const double tau = (here + T->c[i] * dt) / length;
            double force = 0;
            rk_stage(T, i, dt, 2, y, k, 2, z);
            fast(t + here + T->c[i] * dt, z, k + 2 * i);
            for (p = powers - 1; p >= 0; p--) force = force * tau + F[p][0];
            k[2 * i] += force; /* the slow slope has no second component */
        }
        rk_finish(T, dt, 2, y, k, 2, y, NULL);
    }
}

/* One slow step of size H from t: y becomes the new one. */
static void step(const rk_coupling *C, const rk_table *inner, double t, double H, double hf, double *y)
{
    double z[RK_STAGES_MAX][2], k[2 * RK_STAGES_MAX] = {0}, stiff[2 * RK_STAGES_MAX] = {0};
    double weight[RK_ORDER_MAX * RK_STAGES_MAX], jump[RK_STAGES_MAX], F[RK_ORDER_MAX][2];
    const int split = C->form == RK_FROM_START; /* jumps act on the stiff part of the slow function alone */
    int i, p;
    z[0][0] = y[0];
    z[0][1] = y[1];
    for (i = 0; i < C->stages; i++) {
        const double time = t + C->c[i] * H;
        if (i > 0) {
            const int from = rk_coupling_from(C, i), powers = rk_coupling_forcing(C, i, weight);
            const double d = C->c[i] - C->c[from];
            z[i][0] = z[from][0];
            z[i][1] = z[from][1];
            for (p = 0; p < powers; p++) rk_combine(1, i, weight + p * C->stages, 2, NULL, k, 2, F[p]);
            if (powers) fast_solve(inner, t + C->c[from] * H, d * H, hf, powers, F, z[i]);
            rk_coupling_jump(C, i, jump);
            rk_combine(H, i, jump, 2, z[i], split ? stiff : k, 2, z[i]);
            if (jump[i] != 0) z[i][0] = solve(z[i][0], H * jump[i], time, z[i][1], !split);
        }
        stiff[2 * i] = slow_stiff(time, z[i][0], z[i][1]);
        k[2 * i] = stiff[2 * i] + slow_mild(time, z[i][0]);
    }
    y[0] = z[C->stages - 1][0];
    y[1] = z[C->stages - 1][1];
}

static void run(const rk_coupling *C, double hs, double end, double error[2])
{
    static const char *const inner[] = {"", "", "heun", "kutta3", "rk4", "dp5"};
    const int per_output = (int)floor(0.1 / hs + 0.5), outputs = (int)floor(end / 0.1 + 0.5);
    double y[2], t;
    int i, j;
    y[0] = sqrt(1.5);
    y[1] = sqrt(3.);
    error[0] = error[1] = 0;
    for (i = 0; i < outputs; i++) {
        for (j = 0; j < per_output; j++) step(C, rk_find(inner[C->order]), (i * per_output + j) * hs, hs, hs / w, y);
        t = (i + 1) * per_output * hs;
        error[0] += pow(y[0] - sqrt(1 + cos(t) / 2), 2) / outputs;
        error[1] += pow(y[1] - sqrt(2 + cos(w * t)), 2) / outputs;
    }
    error[0] = sqrt(error[0]);
    error[1] = sqrt(error[1]);
}

enum { REFERENCES = sizeof reference / sizeof *reference };

/* The row of the reference for this coupling, or REFERENCES. */
static size_t reference_of(const rk_coupling *C)
{
    size_t i;
    for (i = 0; i < REFERENCES; i++)
        if (strcmp(reference[i].method, C->name) == 0) break;
    return i;
}

/* One row, the reference errors beside ours where there are any for this step. */
static void report(const rk_coupling *C, double hs, int beside, double error[2])
{
    const size_t i = reference_of(C);
    run(C, hs, 5, error);
    printf("%-9s  hs %-7g order %d   u %.4e  v %.4e", C->name, hs, C->order, error[0], error[1]);
    if (beside && i < REFERENCES && reference[i].hs == hs)
        printf("   reference u %.3e  v %.3e", reference[i].u, reference[i].v);
    printf("\n");
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"method", "ERK45a",
                         "KW3 ERK22a ERK33a ERK45a IRK21a ESDIRK34a ESDIRK46a SR21 SR32 SR43 MERK21 "
                         "MERK32 MERK43 MERK54, or all"},
                        {"hs", "0.002", "slow step, 0.1 divided by a whole number; the fast one is hs/w"},
                        {"G", "-100", "slow stiffness"},
                        {"w", "100", "fast frequency"},
                        {"e", "0.5", "coupling"},
                        {NULL, NULL, NULL}};
    const rk_coupling *C;
    double hs, error[2];
    int usual, status;
    scene_parse(argc, argv, "two rates, one step: errors of multirate couplings on the KPR problem", o);
    hs = scene_number(o, "hs", 1e-5, 0.1);
    G = scene_number(o, "G", -1e6, 0);
    w = scene_number(o, "w", 1, 1e4);
    e = scene_number(o, "e", -1, 1);
    usual = G == -100 && w == 100 && e == 0.5;
    G = scene_perturbed("G", G);
    if (fabs(0.1 / hs - floor(0.1 / hs + 0.5)) > 1e-9 / hs) {
        fprintf(stderr, "--hs must divide 0.1, and %g does not\n", hs);
        return 2;
    }
    if (strcmp(scene_text(o, "method"), "all") == 0) {
        for (C = rk_couplings(); C->name; C++) { /* each at the step of its reference */
            const size_t row = reference_of(C);
            report(C, row < REFERENCES ? reference[row].hs : hs, usual, error);
        }
        return 0;
    }
    C = rk_coupling_find(scene_text(o, "method"));
    if (!C) {
        fprintf(stderr, "--method %s is not one of %s\n", scene_text(o, "method"), o[0].help);
        return 2;
    }
    status = rk_check_coupling(C, NULL); /* it has the order that is printed beside the errors */
    scene_check(status, rk_message(status));
    report(C, hs, usual, error);
    printf("u error %.4e\nv error %.4e\n", error[0], error[1]);
    return 0;
}
