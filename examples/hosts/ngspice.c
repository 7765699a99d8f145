/* SPDX-License-Identifier: MIT

   ngspice.c - a circuit in libngspice against a mechanical partner: a motor, its voltage chopped

       L i' + R i = V(t) - w(t)     ngspice: the back-voltage w is an EXTERNAL source, driven by a waveform; the current is
                                    written at every time point that ngspice accepts
       J w' + d w = i(t)            rk.h, Dormand-Prince; dense output at six fixed times in the window, which quasi-Newton
                                    iterates on

   R = d = 1, L = J = 1/2, at rest for t = 0.  V is 2 for 0.3, then 0 for 0.2, and again: i' jumps at every switch.  A window
   ends at each switch, so that no spline crosses one.  Exact: z = i + sqrt(-1) w moves on a spiral to V (1 + sqrt(-1))/2,
   z(t) = z_V + (z(t0) - z_V) exp((-2 + 2 sqrt(-1)) (t - t0)), from switch to switch.

   ngspice cannot go back in time.  A window is repeated as a new transient analysis from 0, with the state of the window
   start, here the current of one inductor, for initial condition; the callbacks add t0. */
#define WF_IMPLEMENTATION
#define IQN_IMPLEMENTATION
#define RK_IMPLEMENTATION
#include "host.h"
#include "iqn.h"
#include "rk.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <ngspice/sharedspice.h>

enum { WINDOWS = 4, SAMPLES = 6, STEPS = 5, MOST = 5000 };
static const double switched[WINDOWS + 1] = {0, 0.3, 0.5, 0.8, 1}, volts[WINDOWS] = {2, 0, 2, 0};

/* What the callbacks of ngspice see.  Angular velocity: what the circuit reads; current: what it writes. */
typedef struct link {
    waveform current, velocity;
    double t0, i, error;
    double z0[2], volt; /* exact current and velocity at the window start, and V in the window */
} link;

static void exact(const link *l, double t, double z[2])
{
    const double s = exp(-2 * (t - l->t0)), c = cos(2 * (t - l->t0)), d = sin(2 * (t - l->t0));
    const double x = l->z0[0] - l->volt / 2, y = l->z0[1] - l->volt / 2;
    z[0] = l->volt / 2 + s * (c * x - d * y);
    z[1] = l->volt / 2 + s * (d * x + c * y);
}

/* ---- what ngspice calls: its output, its end, an accepted time point, the value of the external source ---- */

static int on_text(char *text, int id, void *user)
{
    (void)id, (void)user;
    if (strstr(text, "rror")) fprintf(stderr, "%s\n", text);
    return 0;
}

static int on_start(vecinfoall *all, int id, void *user) /* without it, time points are not sent either */
{
    (void)all, (void)id, (void)user;
    return 0;
}

static int on_exit_request(int status, NG_BOOL at_once, NG_BOOL quit, int id, void *user)
{
    (void)at_once, (void)quit, (void)id, (void)user;
    exit(status ? status : 1);
}

static int on_time_point(vecvaluesall *all, int count, int id, void *user)
{
    link *l = (link *)user;
    double t = 0, i = 0, z[2];
    int j;
    (void)count, (void)id;
    for (j = 0; j < all->veccount; j++) {
        if (strcmp(all->vecsa[j]->name, "time") == 0) t = all->vecsa[j]->creal;
        if (strcmp(all->vecsa[j]->name, "l1#branch") == 0) i = all->vecsa[j]->creal;
    }
    if (t == 0) return 0; /* the window start, already there */
    *write_at(&l->current, l->t0 + t) = l->i = i;
    exact(l, l->t0 + t, z);
    l->error = fmax(l->error, fabs(i - z[0]));
    return 0;
}

static int on_external_source(double *voltage, double t, char *name, int id, void *user)
{
    const link *l = (const link *)user;
    (void)name, (void)id;
    read_at(&l->velocity, l->t0 + t, 0, voltage);
    return 0;
}

static void command(const char *format, double value)
{
    char text[100]; /* ngspice takes char * and may write to it */
    snprintf(text, sizeof text, format, value);
    check(ngSpice_Command(text) == 0, format);
}

static void circuit(link *l)
{
    /* EXTERNAL takes no DC value beside it: ngspice 39 crashes on that */
    const char *const netlist[] = {"motor",          "V1 1 0 DC 2", "R1 1 2 1", "L1 2 3 0.5 ic=0", "Vback 3 0 external",
                                   ".options reltol=1e-6 abstol=1e-12", ".end"};
    static char lines[7][40];
    char *deck[8] = {NULL};
    int j;
    check(ngSpice_Init(on_text, NULL, on_exit_request, on_time_point, on_start, NULL, l) == 0, "ngSpice_Init");
    check(ngSpice_Init_Sync(on_external_source, NULL, NULL, NULL, l) == 0, "ngSpice_Init_Sync");
    for (j = 0; j < 7; j++) deck[j] = strcpy(lines[j], netlist[j]);
    check(ngSpice_Circ(deck) == 0, "ngSpice_Circ");
}

static void circuit_window(link *l, double start, double length)
{
    command("alter @l1[ic] = %.17g", start);
    command("alter @v1[dc] = %.17g", l->volt);
    command("tran 1m %.17g 0 1m uic", length);
    command("destroy all", 0); /* or every repetition's results stay in memory */
}

/* ---- the mechanical side: hx = the velocity at the times s[1], s[2], ...; returns that at the window end ---- */

static double rotor_window(double w, const double *s, const link *l, double *hx)
{
    const rk_table *T = rk_find("dp5");
    const double h = (s[SAMPLES] - s[0]) / STEPS;
    double k[7], z, i_there;
    const rk_step done = {T, h, 1, &w, k, 1};
    int n, i, j = 1;
    for (n = 0; n < STEPS; n++) {
        const double t = s[0] + n * h;
        for (i = 0; i < T->stages; i++) {
            rk_stage(T, i, h, 1, &w, k, 1, &z);
            read_at(&l->current, t + T->c[i] * h, 0, &i_there);
            k[i] = 2 * (i_there - z);
        }
        for (; j <= SAMPLES && s[j] <= t + h * (1 + 1e-9); j++) rk_dense(&done, (s[j] - t) / h, 0, &hx[j - 1]);
        rk_finish(T, h, 1, &w, k, 1, &w, NULL);
    }
    return w;
}

int main(void)
{
    link l;
    double w = 0, w_start, i_start, s[SAMPLES + 1], z[2], hx[SAMPLES], error_w = 0, error_i = 0;
    const double tol = 1e-6;
    const size_t bytes = iqn_size(SAMPLES, 20, 1);
    iqn *q;
    int n, j, status, total = 0;

    memset(&l, 0, sizeof l);
    l.current = waveform_make(1, 1, MOST);
    l.velocity = waveform_make(1, 3, SAMPLES + 1);
    *write_at(&l.current, 0) = *write_at(&l.velocity, 0) = 0;
    circuit(&l);
    check(iqn_make(&q, SAMPLES, 20, 1, memory(bytes), bytes) == IQN_OK, "iqn_make");
    iqn_set(q, IQN_OMEGA, 1);
    iqn_set(q, IQN_TOL_RELATIVE, 1e-7);
    for (n = 0; n < WINDOWS; n++) {
        l.t0 = s[0] = switched[n];
        l.volt = volts[n];
        for (j = 1; j <= SAMPLES; j++) s[j] = j == SAMPLES ? switched[n + 1] : s[0] + (switched[n + 1] - s[0]) * j / SAMPLES;
        i_start = l.i;
        w_start = w;
        begin(&l.velocity, SAMPLES, s + 1);
        do {
            fit(&l.velocity);
            wf_rollback(l.current.grid);
            l.error = 0;
            circuit_window(&l, i_start, s[SAMPLES] - s[0]);
            fit(&l.current);
            w = rotor_window(w_start, s, &l, hx);
            status = iqn_step(q, unknowns(&l.velocity), hx);
            check(status >= 0, iqn_message(status));
        } while (!iqn_converged(q));
        check(iqn_converged(q) == 1, "no convergence");
        total += (int)iqn_get(q, IQN_ITERATIONS);
        iqn_commit(q);
        for (j = 1; j <= SAMPLES; j++) {
            exact(&l, s[j], z);
            error_w = fmax(error_w, fabs(hx[j - 1] - z[1]));
        }
        error_i = fmax(error_i, l.error);
        memcpy(l.z0, z, sizeof z);
        advance(&l.current);
        advance(&l.velocity);
    }
    printf("current_at_1 %.9f\nexact %.9f\nvelocity_at_1 %.9f\nexact %.9f\n", l.i, l.z0[0], w, l.z0[1]);
    printf("error_current %.2e\nerror_velocity %.2e\nerror_allowed %.0e\n", error_i, error_w, tol);
    printf("iterations_average %.1f\n", (double)total / WINDOWS);
    return error_i <= tol && error_w <= tol ? 0 : 1;
}
