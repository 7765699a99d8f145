/* SPDX-License-Identifier: MIT

   fluxes.c - fluxes that arrive in full: an atmosphere in steps of 6 minutes, land of 12, ocean of 30

   The atmosphere computes the heat that leaves it for the land and for the ocean, k (T - T_surface)|T - T_surface|^(1/3), in
   every stage of its Runge-Kutta step, from the surfaces' waveforms (extrapolated: the three are coupled once an hour, and
   not iterated).  What has left it in a step is then h sum of b_i times the fluxes of the stages, rk_combine: the very number
   by which its energy changes.  A running integral of it, pushed at every step, is what the surfaces read: the heat of their
   own step is a rise of this integral.  Three ways for the surface, the same model:

       stages     the rise of the running integral of the stages' fluxes
       steps      the rise of a running integral of the fluxes at the ends of the atmosphere's steps, times the step
       sampling   the flux at the end of the surface's step, times that step

   Rain comes in showers, as amounts of the atmosphere's steps.  The land reads its rate at any time: the derivative of a
   running integral of degree 2 with the slopes of wf_monotone is never negative, and its integral is what has fallen.  A
   cubic through the same sums arrives in full, too, but rains upwards between the showers.

   Exact: energy is only exchanged, but for the sun, which heats the land by day and is added up by the land in the same
   manner.  imbalance: |received - sent| over all that was exchanged; drift: the error of the total energy as a temperature
   of the atmosphere. */
#define RK_IMPLEMENTATION
#define WF_IMPLEMENTATION
#include "rk.h"
#include "waveform.h"
#include "scene.h"

enum { LAND, OCEAN, SURFACES, STAGES = 4, MOST = 60 };
enum { BY_STAGES, BY_STEPS, BY_SAMPLING, WAYS };
static const char *const ways[] = {"stages", "steps", "sampling"};
static const double PI = 3.14159265358979323846;
static const double air = 1e7, capacity[SURFACES] = {2e6, 2e8}; /* J/(m^2 K), of the area */
static const double share[SURFACES] = {0.3, 0.7};               /* of the area */
static double exchange;                                         /* k, W/(m^2 K^(4/3)) */

static int checked(int status, const char *message)
{
    scene_check(status, message);
    return status;
}

static double flux(int s, double atmosphere, double surface)
{
    const double d = atmosphere - surface;
    return share[s] * exchange * d * cbrt(fabs(d));
}

static double sun(double t)
{
    return share[LAND] * 300 * fmax(0, sin(2 * PI * t / 86400));
}

typedef struct model {
    int way, steps, steps_of[SURFACES]; /* in a window: of the atmosphere, of the surfaces */
    double T, surface[SURFACES];
    waveform sent[SURFACES], now[SURFACES]; /* running integrals, fluxes */
    waveform seen[SURFACES];                /* temperatures of the surfaces */
    double sent_all, received_all, exchanged, sunshine;
} model;

/* The atmosphere over a window: T, the running integrals from 0 and the fluxes at its times. */
static void atmosphere(model *m, double start, double window)
{
    const rk_table *R = rk_find("ssp33");
    const double h = window / m->steps;
    double k[STAGES], each[SURFACES][STAGES], heat, total[SURFACES] = {0, 0}, z, ends, surface, t, end;
    int i, j, s;
    for (s = 0; s < SURFACES; s++) *wf_column(m->sent[s].w, 0) = 0;
    for (j = 1; j <= m->steps; j++) {
        t = start + (j - 1) * window / m->steps;
        end = start + j * window / m->steps;
        for (i = 0; i < R->stages; i++) {
            rk_stage(R, i, h, 1, &m->T, k, 1, &z);
            for (k[i] = 0, s = 0; s < SURFACES; s++) {
                waveform_read(&m->seen[s], t + R->c[i] * h, 0, &surface);
                each[s][i] = flux(s, z, surface);
                k[i] -= each[s][i] / air;
            }
        }
        rk_finish(R, h, 1, &m->T, k, 1, &m->T, NULL);
        for (s = 0; s < SURFACES; s++) {
            checked(rk_combine(h, R->stages, R->b, 1, NULL, each[s], 1, &heat), "rk_combine");
            m->sent_all += heat;
            m->exchanged += fabs(heat);
            waveform_read(&m->seen[s], end, 0, &surface);
            ends = flux(s, m->T, surface);
            *waveform_push(&m->now[s], end, 0) = ends;
            total[s] += m->way == BY_STAGES ? heat : h * ends;
            *waveform_push(&m->sent[s], end, 0) = total[s];
        }
    }
}

/* A surface over a window: what it gets in a step is a mean over that step. */
static void surface(model *m, int s, double start, double window)
{
    const rk_table *R = rk_find("ssp33");
    const double h = window / m->steps_of[s];
    double k[STAGES], light[STAGES], z, before, after, heat, warmth;
    int i, j;
    for (j = 1; j <= m->steps_of[s]; j++) {
        const double t = start + (j - 1) * window / m->steps_of[s], end = start + j * window / m->steps_of[s];
        waveform_read(m->way == BY_SAMPLING ? &m->now[s] : &m->sent[s], t, 0, &before);
        waveform_read(m->way == BY_SAMPLING ? &m->now[s] : &m->sent[s], end, 0, &after);
        heat = m->way == BY_SAMPLING ? h * after : after - before;
        for (i = 0; i < R->stages; i++) {
            rk_stage(R, i, h, 1, &m->surface[s], k, 1, &z);
            light[i] = s == LAND ? sun(t + R->c[i] * h) : 0;
            k[i] = (heat / h + light[i]) / (share[s] * capacity[s]);
        }
        rk_finish(R, h, 1, &m->surface[s], k, 1, &m->surface[s], NULL);
        checked(rk_combine(h, R->stages, R->b, 1, NULL, light, 1, &warmth), "rk_combine");
        m->sunshine += warmth;
        m->received_all += heat;
        *waveform_push(&m->seen[s], end, 0) = m->surface[s];
    }
    checked(wf_advance(m->seen[s].w, 1), "wf_advance");
}

/* Of all three, in J/m^2. */
static double energy(const model *m)
{
    double e = air * m->T;
    int s;
    for (s = 0; s < SURFACES; s++) e += share[s] * capacity[s] * m->surface[s];
    return e;
}

/* Showers over `windows` hours, monotone or by a cubic: the least rate over the mean rate, and |received - sent| over sent. */
static void rain(int windows, int steps, int monotone, double *least, double *lost)
{
    waveform w = waveform_make(monotone ? 2 : 3, 1, 2 * steps + 2);
    double fallen, sent = 0, received = 0, rate, before, after;
    unsigned long chance = 1;
    int i, j, k;
    *least = 0;
    waveform_push(&w, 0, monotone ? WF_SLOPE : 0);
    for (k = 0; k < windows; k++) {
        *wf_column(w.w, 0) = fallen = 0;
        for (j = 1; j <= steps; j++) {
            chance = (chance * 1664525 + 1013904223) & 0xffffffff;
            if (chance >> 31) fallen += pow((double)(chance >> 16 & 0x7fff) / 0x7fff, 3);
            *waveform_push(&w, 3600. * k + 3600. * j / steps, monotone ? WF_SLOPE : 0) = fallen;
        }
        if (monotone) checked(wf_monotone(w.w), "wf_monotone");
        for (before = 0, j = 1; j <= 7; j++, before = after) { /* a surface of seven steps */
            waveform_read(&w, 3600. * k + 3600. * j / 7, 0, &after);
            received += after - before;
        }
        for (i = 0; i <= 200; i++) {
            waveform_read(&w, 3600. * k + 18. * i, 1, &rate);
            *least = fmin(*least, rate);
        }
        sent += fallen;
        checked(wf_advance(w.w, 0), "wf_advance");
    }
    *least *= 3600. * windows / sent;
    *lost = fabs(received - sent) / sent;
    waveform_free(&w);
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"windows", "1000", "hours"},
                        {"air", "10", "steps of the atmosphere in a window of an hour"},
                        {"land", "5", "steps of the land"},
                        {"ocean", "2", "steps of the ocean"},
                        {"degree", "1", "of the running integral in time"},
                        {"exchange", "12", "W/(m^2 K^(4/3))"},
                        {NULL, NULL, NULL}};
    model m;
    double before, least, lost;
    int windows, degree, way, w, s;
    scene_parse(argc, argv, "an atmosphere, land and ocean exchange heat in steps of their own", o);
    windows = scene_integer(o, "windows", 1, 10000000);
    degree = scene_integer(o, "degree", 1, WF_MAX_DEGREE);
    exchange = scene_perturbed("exchange", scene_number(o, "exchange", 0, 1000));
    for (way = 0; way < WAYS; way++) {
        memset(&m, 0, sizeof m);
        m.way = way;
        m.steps = scene_integer(o, "air", 1, MOST);
        m.steps_of[LAND] = scene_integer(o, "land", 1, MOST);
        m.steps_of[OCEAN] = scene_integer(o, "ocean", 1, MOST);
        m.T = 290;
        m.surface[LAND] = 280;
        m.surface[OCEAN] = 288;
        for (s = 0; s < SURFACES; s++) {
            m.sent[s] = waveform_make(degree, 1, m.steps + 1);
            m.now[s] = waveform_make(degree, 1, m.steps + 1);
            m.seen[s] = waveform_make(1, 1, MOST + 3);
            waveform_push(&m.sent[s], 0, 0);
            *waveform_push(&m.now[s], 0, 0) = flux(s, m.T, m.surface[s]);
            *waveform_push(&m.seen[s], 0, 0) = m.surface[s];
        }
        before = energy(&m);
        for (w = 0; w < windows; w++) {
            atmosphere(&m, 3600. * w, 3600);
            for (s = 0; s < SURFACES; s++) {
                surface(&m, s, 3600. * w, 3600);
                checked(wf_advance(m.sent[s].w, 0), "wf_advance");
                checked(wf_advance(m.now[s].w, 0), "wf_advance");
            }
        }
        printf("%s imbalance %.3e drift %.3e\n", ways[way], fabs(m.received_all - m.sent_all) / m.exchanged,
               (energy(&m) - before - m.sunshine) / air);
        if (way == BY_STAGES) printf("air %.10g\nland %.10g\nocean %.10g\n", m.T, m.surface[LAND], m.surface[OCEAN]);
        for (s = 0; s < SURFACES; s++) waveform_free(&m.sent[s]), waveform_free(&m.now[s]), waveform_free(&m.seen[s]);
    }
    for (way = 0; way < 2; way++) {
        rain(windows, m.steps, way == 0, &least, &lost);
        printf("rain_%s least %.3e imbalance %.3e\n", way == 0 ? "monotone" : "cubic", least, lost);
    }
    return 0;
}
