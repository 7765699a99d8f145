/* SPDX-License-Identifier: MIT

   bounce.c - events by dense output: a ball falls, hits the floor, loses speed, and bounces on

       y' = v,  v' = -g - drag v |v|;   where y falls through 0: v becomes -e v

   An adaptive explicit table takes its steps as if there were no floor.  After each accepted step the dense output of the
   height alone is searched for the floor; the step then ends there and the control starts anew.  The path is kept in a
   waveform, one window for each flight: the step into the floor is taken back and ends at the bounce, which is a break,
   behind which height and speed begin anew.  How many steps a flight takes is not known: a full grid goes on in a larger one.
   All is known in closed form.  From rest at height H it takes acosh(exp(drag H))/sqrt(g drag) to the floor, upwards with
   speed v atan(v sqrt(drag/g))/sqrt(g drag) to H = log(1 + drag v^2/g)/(2 drag), and it comes back with v/sqrt(1 + drag v^2/g).
   Without drag the flights are parabolas. */
#define WF_IMPLEMENTATION
#include "waveform.h"
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "rk_proof.h"
#include "scene.h"

static const double gravity = 9.81;
static double drag;
static long evaluations;

static void slope(const double *y, double *k)
{
    k[0] = y[1];
    k[1] = -gravity - drag * y[1] * fabs(y[1]);
    evaluations++;
}

/* ---- a table of one's own: Cash & Karp, ACM Trans. Math. Softw. 16, 1990, published without dense output ---- */

static const rk_table *cash_karp(void)
{
    static const double A[36] = {
        0, 0, 0, 0, 0, 0,
        1. / 5, 0, 0, 0, 0, 0,
        3. / 40, 9. / 40, 0, 0, 0, 0,
        3. / 10, -9. / 10, 6. / 5, 0, 0, 0,
        -11. / 54, 5. / 2, -70. / 27, 35. / 27, 0, 0,
        1631. / 55296, 175. / 512, 575. / 13824, 44275. / 110592, 253. / 4096, 0};
    static const double c[6] = {0, 1. / 5, 3. / 10, 3. / 5, 1, 7. / 8};
    static const double b[6] = {37. / 378, 0, 250. / 621, 125. / 594, 0, 512. / 1771};
    static const double bhat[6] = {2825. / 27648, 0, 18575. / 48384, 13525. / 55296, 277. / 14336, 1. / 4};
    static double memory[1000];
    static rk_table T;
    int status;
    T.name = "cashkarp", T.stages = 6, T.order = 5, T.order_hat = 4;
    T.A = A, T.b = b, T.c = c, T.bhat = bhat;
    status = rk_check(&T, NULL); /* typed without a slip: it has its orders */
    scene_check(status, rk_message(status));
    status = rk_extend(&T, &T, NULL, 4, 2, memory, sizeof memory);
    scene_check(status, rk_message(status));
    printf("dense output of order %d, %d stages more\n", T.dense_order, T.extra);
    return &T;
}

/* ---- the event: the first theta at which the height falls through 0 ---- */

static double height(const rk_step *step, double theta)
{
    rk_step one = *step;
    double y = 0;
    one.n = 1; /* the first component alone; y and k stay where they are */
    scene_check(rk_dense(&one, theta, 0, &y), "rk_dense");
    return y;
}

/* Looked for in eight parts, then by bisection to the last bit; 2: there is none. */
static double floor_hit(const rk_step *step)
{
    double low = 0, high = 0, y = step->y[0], next;
    int part, i;
    for (part = 1; part <= 8; part++) {
        high = part / 8.;
        next = height(step, high);
        if (y > 0 && next <= 0) break;
        y = next;
        low = high;
    }
    if (part > 8) return 2;
    for (i = 0; i < 60; i++) {
        const double mid = low + (high - low) / 2;
        if (height(step, mid) > 0) low = mid;
        else high = mid;
    }
    return high;
}

/* ---- what is exact ---- */

static double fall(double from) /* time from rest to the floor */
{
    return drag > 0 ? acosh(exp(drag * from)) / sqrt(gravity * drag) : sqrt(2 * from / gravity);
}

static double flight(double v, double *back) /* time from the floor to the floor, and the speed then */
{
    const double q = drag * v * v / gravity;
    *back = v / sqrt(1 + q);
    if (drag > 0) return atan(v * sqrt(drag / gravity)) / sqrt(gravity * drag) + fall(log1p(q) / (2 * drag));
    return 2 * v / gravity;
}

static double impact(double from) /* speed at the floor, from rest */
{
    return drag > 0 ? sqrt(gravity / drag * -expm1(-2 * drag * from)) : sqrt(2 * gravity * from);
}

/* ---- the path: columns of height and speed, one window for each flight ---- */

static double *path;
static wf *grid;

/* Room for so many columns; what has been kept stays. */
static void make_room(int capacity)
{
    const size_t bytes = wf_size(3, capacity);
    double *longer = (double *)scene_memory((size_t)capacity * sizeof(double));
    wf *larger;
    scene_check(wf_make(&larger, 3, capacity, scene_memory(bytes), bytes), "wf_make");
    if (grid) {
        scene_check(wf_copy(larger, grid), "wf_copy");
        memcpy(longer, path, (size_t)wf_columns(grid) * sizeof(double));
    }
    free(grid);
    free(path);
    grid = larger;
    path = longer;
}

/* Height and speed at t, in the two columns that `push` makes. */
static void keep(int (*push)(wf *, double), double t, const double *y)
{
    int column = push(grid, t);
    if (column == WF_EFULL) {
        make_room(2 * wf_columns(grid) + 2);
        column = push(grid, t);
    }
    scene_check(column, wf_message(column));
    path[column] = y[0];
    path[column + 1] = y[1];
}

/* The largest distance of the path from the parabola of this flight, without drag. */
static double path_error(double t0, double v0, double t1)
{
    double worst = 0, y = 0;
    int i;
    for (i = 1; i < 40; i++) {
        const double t = t0 + (t1 - t0) * i / 40, past = t - t0;
        scene_check(wf_interpolate(grid, t, 0, 1, path, 1, &y), "wf_interpolate");
        worst = fmax(worst, fabs(y - (v0 - gravity / 2 * past) * past));
    }
    return worst;
}

int main(int argc, char **argv)
{
    scene_option o[] = {{"table", "dp5", "explicit table with a pair, or cashkarp, typed in here"},
                        {"tolerance", "1e-9", "of a step"},
                        {"bounces", "10", "how many"},
                        {"height", "1", "y(0), from rest"},
                        {"restitution", "0.8", "e: speed after over speed before"},
                        {"drag", "0", "of the air"},
                        {NULL, NULL, NULL}};
    double y[2] = {1, 0}, ynew[2], err[2], z[2], k[2 * RK_STAGES_MAX], sum[2], t = 0, h, theta, tol, e;
    double exact, v, v0 = 0, last = 0, worst = 0, shape = 0;
    int bounces, count = 0, i, status;
    rk_control C;
    const rk_table *T;
    scene_parse(argc, argv, "a ball on the floor: events by dense output, the path in a waveform", o);
    T = strcmp(scene_text(o, "table"), "cashkarp") == 0 ? cash_karp() : rk_find(scene_text(o, "table"));
    tol = scene_number(o, "tolerance", 1e-14, 1e-2);
    bounces = scene_integer(o, "bounces", 1, 100);
    y[0] = scene_number(o, "height", 1e-6, 1e6);
    e = scene_number(o, "restitution", 0.1, 1);
    drag = scene_number(o, "drag", 0, 100);
    if (!T || rk_is(T, RK_EXPLICIT) != 1 || rk_control_make(&C, "PI", T) < 0) {
        fprintf(stderr, "--table %s is not an explicit table with a pair\n", scene_text(o, "table"));
        return 2;
    }
    make_room(8);
    exact = fall(y[0]);
    v = impact(y[0]);
    keep(wf_push_hermite, 0, y);
    h = rk_first_step(rk_estimate(T), exact, y[0] / tol, gravity / tol, -1);
    while (count < bounces) {
        rk_step step;
        const double t0 = t, taken = h;
        for (i = 0; i < T->stages + T->extra; i++) {
            rk_stage(T, i, h, 2, y, k, 2, z);
            slope(z, k + 2 * i);
        }
        rk_finish(T, h, 2, y, k, 2, ynew, err);
        memset(sum, 0, sizeof sum);
        rk_norm(tol, tol, NULL, 2, err, y, ynew, sum);
        status = rk_control_step(&C, rk_rms(sum), &t, &h);
        scene_check(status, rk_message(status));
        if (status == RK_REJECT) continue;
        keep(wf_push_hermite, t, ynew);
        step.T = T, step.h = taken, step.n = 2, step.y = y, step.k = k, step.ldk = 2;
        theta = floor_hit(&step);
        if (theta > 1) { /* no event: go on */
            memcpy(y, ynew, sizeof y);
            continue;
        }
        scene_check(wf_pop(grid), "wf_pop");
        scene_check(rk_dense(&step, theta, 0, ynew), "rk_dense");
        t = t0 + theta * taken; /* the step ends here */
        y[0] = 0;
        y[1] = ynew[1];
        keep(wf_push_hermite, t, y);
        worst = fmax(worst, fabs(t - exact));
        if (drag == 0 && count > 0) shape = fmax(shape, path_error(last, v0, t));
        printf("bounce %d time %.15g speed %.6g  exact %.15g %.6g\n", ++count, t, -y[1], exact, v);
        y[1] *= -e; /* and the next flight starts here */
        last = t;
        v0 = e * v;
        exact += flight(v0, &v);
        keep(wf_push_break_hermite, t, y);
        scene_check(wf_advance(grid, 0, 1, path, 1), "wf_advance"); /* what is behind the break is the new start */
        rk_control_make(&C, "PI", T);
        h = fmin(taken, (exact - last) / 10);
    }
    printf("evaluations %ld\n", evaluations);
    printf("largest error of a bounce %.3e\n", worst);
    if (drag == 0) printf("largest error of the path %.3e\n", shape);
    free(grid);
    free(path);
    return 0;
}
