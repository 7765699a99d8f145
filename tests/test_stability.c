/* SPDX-License-Identifier: MIT

   test_stability.c - the tool of stability.h against the literature, and the list of tables in rk.h against the tool.  Needs
   LAPACK. */
#define RK_IMPLEMENTATION
#define RK_PROOF_IMPLEMENTATION
#include "rk.h"
#include "examples/rk_proof.h"
#include "check.h"
#include "stability.h"

#ifndef RK_HEADER /* where the header lies that the list of tables is read from */
#    define RK_HEADER "rk.h"
#endif

/* known: HUGE_VAL, or a number */
static void check_size(double is, double known, double off)
{
    if (known > 1e300) CHECK(is > 1e300);
    else CHECK_NEAR(is, known, off);
}

/* Numbers of polynomial roots and of the literature: real and imaginary interval, |R| at infinity, SSP coefficient, error
   norm A_{p+1}, stage order, L-stable. */
TEST(test_numbers_of_the_literature)
{
#define ON_AXES(real, imaginary) real, imaginary, HUGE_VAL
#define A_STABLE HUGE_VAL, HUGE_VAL
    static const struct {
        const char *name;
        double real, imaginary, r, ssp, norm;
        int stage_order, l;
    } known[] = {{"euler", ON_AXES(2, 0), 1, 0.5, 1, 0},
                 {"ssp33", ON_AXES(2.512745, 1.732051), 1, 0.07217, 1, 0},
                 {"ssp43", ON_AXES(5.149486, 2.15618), 2, 0.03608, 1, 0},
                 {"ssp104", ON_AXES(13.91705, 4.921453), 6, 0.002211, 1, 0},
                 {"bs3", ON_AXES(2.512745, 1.732051), 0, 0.04181, 1, 0},
                 {"rk4", ON_AXES(2.785294, 2.828427), 0, 0.0145, 1, 0},
                 {"ss4", ON_AXES(2.785294, 2.828427), 0, 0.01232, 1, 0},
                 {"dp5", ON_AXES(3.306568, 0.997189), 0, 0.0003991, 1, 0},
                 {"tsit5", ON_AXES(3.506847, 0.4779789), 0, 0.0001385, 1, 0},
                 {"verner6", ON_AXES(4.324026, 0), 0, 0.000101, 1, 0},
                 {"dop853", ON_AXES(6.393652, 5.96036), 0, 6.263e-6, 1, 0},
                 {"ars443e", ON_AXES(2.143159, 1.569855), 0, 0.09053, 1, 0},
                 {"ark2e", ON_AXES(2.512745, 1.732051), 0.05025253, 0.04044, 1, 0},
                 {"ark4e", ON_AXES(6.762077, 4.695158), 0, 0.00195, 1, 0},
                 {"ark5e", ON_AXES(3.855492, 0), 0, 0.002476, 1, 0},
                 {"beuler", A_STABLE, 0, HUGE_VAL, 0.5, 1, 1},
                 {"imidpoint", A_STABLE, 1, 2, 0.09317, 1, 0},
                 {"trapezoid", A_STABLE, 1, 2, 0.1179, 2, 0},
                 {"sdirk2", A_STABLE, 0, 2.414214, 0.04168, 1, 1},
                 {"trbdf2", A_STABLE, 0, 2.414214, 0.05719, 2, 1},
                 {"esdirk3", A_STABLE, 0, 0, 0.0007769, 2, 1},
                 {"esdirk4", A_STABLE, 0, 0, 0.00183, 2, 1},
                 {"esdirk4b", A_STABLE, 0, 0, 0.0002595, 2, 1},
                 {"esdirk5", A_STABLE, 0, 0, 0.001272, 2, 1},
                 {"sdirk4", A_STABLE, 0, 0, 0.002504, 1, 1},
                 {"wso3", A_STABLE, 0, 0, 0.1915, 1, 1},
                 {"ark3i", A_STABLE, 0, 0, 0.03663, 2, 1},
                 {"ark4i", A_STABLE, 0, 0, 0.001634, 2, 1}};
    stability a;
    size_t i;
    for (i = 0; i < sizeof known / sizeof *known; i++) {
        CHECK_INT(stability_of(rk_find(known[i].name), 300, &a), 0);
        check_size(a.real_axis, known[i].real, 2e-6 * known[i].real);
        check_size(a.imaginary_axis, known[i].imaginary, 2e-6 * known[i].imaginary);
        check_size(a.r_infinity, known[i].r, 1e-9);
        check_size(a.ssp, known[i].ssp, 1e-6);
        CHECK_NEAR(a.error_norm, known[i].norm, 1e-3 * known[i].norm);
        CHECK_INT(a.stage_order, known[i].stage_order);
        CHECK(a.a_stable == (known[i].real > 1e300) && a.l_stable == known[i].l);
    }
}

TEST(test_collocation_is_stable_as_in_the_book)
{
    double mem[600];
    stability a;
    rk_table T;
    int family, s;
    for (family = RK_GAUSS; family <= RK_LOBATTO_IIIC; family++)
        for (s = 2; s <= 4; s++) { /* Hairer & Wanner II, table IV.5.13: Pade approximations */
            CHECK_INT(rk_collocation(&T, family, s, mem, sizeof mem), RK_OK);
            CHECK_INT(stability_of(&T, 300, &a), 0);
            CHECK(a.a_stable && a.l_stable == (family == RK_RADAU_IIA || family == RK_LOBATTO_IIIC));
            CHECK_NEAR(a.r_infinity, a.l_stable ? 0 : 1, 1e-6);
            CHECK_INT(a.stage_order, s - 2 * (family == RK_LOBATTO_IIIB) - (family == RK_LOBATTO_IIIC));
        }
}

/* Where a shipped table never leads: methods that are not A-stable for each of the reasons there are. */
TEST(test_implicit_tables_that_are_not_A_stable)
{
    const double backward[] = {-1}, bc[] = {-1};
    const double nodes[] = {0.1, 0.4}, ends[] = {0.1, 0.4, 1}, last[] = {0, 1, 0}, times[] = {0, 1, 1};
    double A[9], b[3], mem[600];
    rk_table T = {"own", 1, 1, 0, 0, 0, 0, backward, backward, bc, NULL, NULL, NULL, NULL, 0};
    stability a;
    int i;
    CHECK_INT(stability_of(&T, 300, &a), 0); /* implicit Euler with h turned over: R = 1/(1 + z), a pole at -1 */
    CHECK(a.imaginary_axis == HUGE_VAL && !a.a_stable && a.r_infinity < 1e-9);
    CHECK(a.dense_max == 0 && a.stage_order == 0);
    T = *rk_find("trbdf2"); /* with the embedding of order 3 of Hosea & Shampine 1996 as the method: |R| grows like |z| */
    b[0] = (4 - sqrt(2.)) / 12, b[1] = (4 + 3 * sqrt(2.)) / 12, b[2] = (2 - sqrt(2.)) / 6;
    T.b = b, T.bhat = NULL, T.order_hat = 0, T.order = 3;
    CHECK_INT(rk_check(&T, NULL), RK_EDENSE);
    CHECK(rk_defect(&T, NULL, RK_OF_STEP, 3) <= RK_TOLERANCE);
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK(!a.a_stable && a.r_infinity == HUGE_VAL && a.imaginary_axis < HUGE_VAL);
    CHECK_INT(rk_collocation(&T, RK_RADAU_IIA, 2, mem, sizeof mem), RK_OK);
    for (i = 0; i < 4; i++) A[i] = -T.A[i]; /* Radau IIA with h turned over: fine on the axis, poles on the left */
    for (i = 0; i < 2; i++) b[i] = -T.b[i];
    T.A = A, T.b = b, T.d = NULL;
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK(!a.a_stable);
    for (i = 0; i < 6; i++) { /* collocation at 0.1 and 0.4, nodes on average left of the middle: not A-stable */
        const double end = ends[i / 2], other = nodes[1 - i % 2]; /* integrals of (x - other)/(node - other) */
        (i < 4 ? A : b)[i % 4] = end * (end / 2 - other) / (nodes[i % 2] - other);
    }
    T.c = nodes, T.order = 2;
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK(!a.a_stable && a.imaginary_axis < HUGE_VAL && a.stage_order == 2);
    memset(A, 0, sizeof A); /* an implicit stage that the step leaves out: R = 1 + z + z^2 */
    A[3] = A[8] = 1;
    T.b = last, T.c = times, T.stages = 3;
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK(!a.a_stable && a.r_infinity == HUGE_VAL);
    CHECK_NEAR(a.real_axis, 1, 1e-6);
}

/* A fourth-order table of exact coefficients whose pole in the left half-plane lies between any rays that one would probe:
   |R| <= 1 on the whole axis, 4e9 near the pole. */
TEST(test_poles_between_the_rays_are_found)
{
    const double A[] = {0.05644369019642141, 0.08737364553715524, -0.15482180903259027, 0.02003363160352649,
                        -0.0272992579681389, 0.09175222895413197, -0.10397901793315797, -0.09210756857052542,
                        -0.07981781364106252, -0.2002006550677708, 0.3356643653164212, 0.10761764548530364,
                        0.07478994774173542, -0.008327491084850796, -0.12139436885617695, 0.10304589086468668};
    const double b[] = {-0.36400243876210747, -1.2097820723614865, 1.9123271322735969, 0.661457378849997};
    double c[4] = {0};
    rk_table T = {"poles", 4, 2, 0, 0, 0, 0, A, b, c, NULL, NULL, NULL, NULL, 0};
    stability a;
    int i;
    for (i = 0; i < 16; i++) c[i / 4] += A[i];
    CHECK_INT(rk_check(&T, NULL), RK_OK);
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK(a.imaginary_axis > 1e300 && !a.a_stable && !a.l_stable);
    CHECK(cabs(stability_function(&T, -5.2210476885 + 39.657794455 * csqrt(-1), -1)) > 1e8);
}

/* Alexander's method with a last stage that nobody uses: the same verdict as without. */
TEST(test_stages_that_are_not_used_do_not_count)
{
    const double g = 1 - 1 / sqrt(2.), A[] = {g, 0, 0, 1 - g, g, 0, 1 - g, g, 0}, b[] = {1 - g, g, 0}, c[] = {g, 1, 1};
    const rk_table T = {"sdirk2+", 3, 2, 0, 0, 0, 0, A, b, c, NULL, NULL, NULL, NULL, 0};
    stability a, alone;
    CHECK_INT(stability_of(&T, 300, &a), 0);
    CHECK_INT(stability_of(rk_find("sdirk2"), 300, &alone), 0);
    CHECK(a.a_stable && a.l_stable && alone.l_stable && a.r_infinity == 0 && alone.r_infinity == 0);
}

/* R(z) against closed forms, and the product over the steps of a table put together from 8 steps of rk4. */
TEST(test_the_stability_function)
{
    const double complex axis = 3 * csqrt(-1);
    double mem[600];
    double complex R;
    rk_table G;
    R = stability_function(rk_find("rk4"), axis, -1); /* 1 + z + z^2/2 + z^3/6 + z^4/24 */
    CHECK_NEAR(creal(R), 1 - 9. / 2 + 81. / 24, 1e-14);
    CHECK_NEAR(cimag(R), 3 - 27. / 6, 1e-14);
    CHECK_INT(rk_collocation(&G, RK_GAUSS, 2, mem, sizeof mem), RK_OK); /* (1 + z/2 + z^2/12)/(1 - z/2 + z^2/12) */
    R = stability_function(&G, axis, -1);
    CHECK_NEAR(cabs(R), 1, 1e-14);
    CHECK_NEAR(creal(R), (1. / 16 - 9. / 4) / (1. / 16 + 9. / 4), 1e-14);
    CHECK(cabs(stability_function(rk_find("beuler"), 1, -1)) > 1e15); /* a pole */
    CHECK(cabs(stability_function(rk_find("esdirk4b"), 16.65 * csqrt(-1), 0.85)) < 1.02); /* 4.60 with 0.1.0's */
}

/* Of all places of a jump of f(t) inside a step: how many the pair does not see, though the step is wrong by more than 0.002
   of the jump. */
static double blind_share(const rk_table *T)
{
    int p, j, blind = 0;
    for (p = 1; T->bhat && p < 1000; p++) {
        double q = p / 1000. - 1, e = 0, e3 = 0; /* f = 0 before the jump, 1 behind it */
        for (j = 0; j < T->stages; j++) {
            if (!(T->c[j] > p / 1000.)) continue;
            q += T->b[j];
            e += T->b[j] - T->bhat[j];
            if (T->e3) e3 += T->e3[j];
        }
        if (T->e3) e = rk_combined_error(fabs(e), fabs(e3));
        blind += fabs(q) > 0.002 && fabs(e) < 1e-3 * fabs(q);
    }
    return blind / 1000.;
}

/* The embedded error of y' = lambda y, lambda -> -infinity, over y. */
static double stiff_estimate(const rk_table *T)
{
    double e[RK_STAGES_MAX] = {0};
    rk_table X = *T;
    int j;
    if (!T->bhat || rk_is(T, RK_EXPLICIT)) return 0;
    for (j = 0; j < T->stages; j++) e[j] = T->b[j] - T->bhat[j];
    X.b = e;
    return cabs(stability_function(&X, -1e9, -1) - 1);
}

/* The marks of a line: > evaluates f behind the step, j blind to some jumps, F the estimate does not decay. */
static void check_marks(const char *line, const rk_table *T)
{
    const char *at = strchr(line, '|') + 57, marks[4] = {at[0], at[1], at[2], 0};
    double last = 0;
    int i;
    for (i = 0; i < T->stages; i++) last = fmax(last, T->c[i]);
    if ((strchr(marks, '>') != NULL) != (last > 1)) fail_msg("%s: its last c is %g", T->name, last);
    if ((strchr(marks, 'j') != NULL) != (blind_share(T) > 0.05)) fail_msg("%s: blind at %g", T->name, blind_share(T));
    if ((strchr(marks, 'F') != NULL) != (stiff_estimate(T) > 1e-3)) fail_msg("%s: %g", T->name, stiff_estimate(T));
}

/* The header's list of tables, line by line: name, stages, order, pair, dense order, joint, stability, bound, stiff order,
   marks. */
/* A host may step to the limit as it is printed. */
static void check_rounded_down(const char *name, double limit, double printed)
{
    if (!(printed <= limit + 1e-6 && limit < printed + 0.01 + 1e-6))
        fail_msg("%s: stable up to %.6f, the header says %.2f", name, limit, printed);
}

TEST(test_the_table_in_the_header_is_true)
{
    char line[256];
    FILE *f = fopen("rk.h", "r");
    int found = 0, i;
    if (!f) f = fopen("../rk.h", "r");
    if (!f) f = fopen(RK_HEADER, "r");
    CHECK(f != NULL);
    while (f && fgets(line, sizeof line, f)) {
        char name[32], pair[8], joint[8], region[32], bound[16], stiff[8];
        int stages, order, dense;
        const rk_table *T;
        stability a;
        if (sscanf(line, " | %31s %d %d %7s %d %7s %31s %15s %7s", name, &stages, &order, pair, &dense, joint, region, bound,
                   stiff) != 9)
            continue;
        T = rk_find(name);
        if (!T) fail_msg("the header lists %s, which does not exist", name);
        CHECK_INT(T->stages, stages);
        CHECK_INT(T->order, order);
        CHECK_INT(T->order_hat, pair[0] == '-' ? 0 : atoi(pair));
        CHECK_INT(T->dense_order, dense);
        CHECK_INT(T->dense_stiff, stiff[0] == '-' ? 0 : atoi(stiff));
        CHECK_INT(stability_of(T, 3000, &a), 0);
        CHECK_INT(a.joint, joint[1] - '0');
        if (a.a_stable) {
            CHECK(region[0] == (a.l_stable ? 'L' : 'A') && region[1] == 0);
            if (!(a.dense_growth <= atof(bound) + 1e-6 && a.dense_growth > atof(bound) - 0.0011))
                fail_msg("%s: grows %.6f, the header says %s", name, a.dense_growth, bound);
            CHECK(a.dense_growth < 1.1);
        } else {
            check_rounded_down(name, a.real_axis, atof(region));
            check_rounded_down(name, a.imaginary_axis, atof(strchr(region, ',') + 1));
            CHECK(bound[0] == '-');
        }
        check_marks(line, T);
        found++;
    }
    if (f) fclose(f);
    for (i = 0; rk_tables()[i].name;) i++;
    CHECK_INT(found, i);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_of_the_literature),
        cmocka_unit_test(test_collocation_is_stable_as_in_the_book),
        cmocka_unit_test(test_implicit_tables_that_are_not_A_stable),
        cmocka_unit_test(test_poles_between_the_rays_are_found),
        cmocka_unit_test(test_stages_that_are_not_used_do_not_count),
        cmocka_unit_test(test_the_stability_function),
        cmocka_unit_test(test_the_table_in_the_header_is_true),
    };
    check_named(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
