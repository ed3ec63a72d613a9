/* The place of the sun against published examples: Meeus, Astronomical Algorithms (2nd edition),
 * and Reda and Andreas, Solar Position Algorithm (NREL/TP-560-34302, 2008). */
#include <math.h>
#include <time.h>

#include "core/sun.h"
#include "unit/check.h"

static double utc_s(int year, int month, int day, int hour, int minute, int second) {
    struct tm tm = {.tm_year = year - 1900,
                    .tm_mon = month - 1,
                    .tm_mday = day,
                    .tm_hour = hour,
                    .tm_min = minute,
                    .tm_sec = second};
    return (double)timegm(&tm);
}

static void assert_near(double value, double expected, double error) {
    if (!(fabs(value - expected) <= error)) fail_msg("%.6f, not %.6f", value, expected);
}

/* examples 25.a and 28.a: 13 October 1992 at 0 h of dynamical time */
static void test_the_sun_is_where_meeus_has_it(void **state) {
    (void)state;
    struct gn_sun sun = gn_sun_at_julian(2448908.5);
    assert_near(sun.longitude_deg, 199.90895, 0.00002);
    assert_near(sun.right_ascension_deg, 198.38083, 0.00002);
    assert_near(sun.declination_deg, -7.78507, 0.00002);
    assert_near(sun.distance_au, 0.99766, 0.00001);
    assert_near(sun.equation_of_time_s, 13 * 60 + 42.6, 1);
}

static const struct gn_place golden = {39.742476, -105.1786};

/* table A5.1: 17 October 2003 at 12:30:30, seven hours behind UTC */
static void test_the_sun_is_where_nrel_has_it(void **state) {
    (void)state;
    struct gn_sun_view view = gn_sun_view(utc_s(2003, 10, 17, 19, 30, 30), &golden);
    assert_near(view.azimuth_deg, 194.340241, 0.01);
    assert_near(view.true_deg, 39.872046, 0.01);
    assert_near(view.hour_angle_deg, 11.105902, 0.01);
    assert_near(view.sun.declination_deg, -9.314340, 0.01);
    assert_near(view.sun.right_ascension_deg, 202.227408, 0.01);
    assert_near(view.sun.distance_au, 0.9965422974, 0.00005);
    assert_near(view.sun.equation_of_time_s, 14.641503 * 60, 2.4);
    /* with air of 820 hPa and 11 degrees there, which is thinner than here */
    assert_near(view.altitude_deg - view.true_deg, 0.016332 * 1010 / 820 * 284 / 283, 0.0003);
}

static void test_rise_noon_and_set_are_those_of_nrel(void **state) {
    (void)state;
    struct gn_sun_day day = gn_sun_day(utc_s(2003, 10, 17, 19, 30, 30), &golden);
    assert_int_equal(day.kind, GN_SUN_RISES);
    assert_near(day.rise_s, utc_s(2003, 10, 17, 13, 12, 43), 3);
    assert_near(day.noon_s, utc_s(2003, 10, 17, 18, 46, 5), 3);
    /* the set of SPA is that of this day of UTC, so that of the evening before */
    day = gn_sun_day(utc_s(2003, 10, 16, 19, 0, 0), &golden);
    assert_near(day.set_s, utc_s(2003, 10, 17, 0, 20, 19), 3);
}

/* Bennett's formula (1982) is of the apparent altitude, so it is another one; both are within .1'
 */
static void test_refraction_is_that_of_bennett(void **state) {
    (void)state;
    for (int i = -2; i <= 360; i++) {
        const double h = i * 0.25;
        double lifted = gn_sun_refraction_deg(h), apparent = h + lifted;
        double bennett = 1 / tan((apparent + 7.31 / (apparent + 4.4)) * M_PI / 180) / 60;
        assert_near(lifted, bennett, 0.1 / 60);
    }
    assert_near(gn_sun_refraction_deg(90), 0, 0.00002);
    assert_near(gn_sun_refraction_deg(-0.5667), 34 / 60.0, 0.5 / 60); /* the limb at the horizon */
}

static void test_refraction_has_no_step(void **state) {
    (void)state;
    double before = gn_sun_refraction_deg(-90);
    for (int i = -9000; i < 9000; i++) {
        const double h = i * 0.01;
        double lifted = gn_sun_refraction_deg(h);
        assert_near(lifted, before, 0.0075); /* the slope at -1 degree is .7 */
        assert_true(lifted > -0.001 && lifted < 1);
        before = lifted;
    }
}

static void test_polar_days_and_nights_have_neither_rise_nor_set(void **state) {
    (void)state;
    static const struct gn_place tromso = {69.65, 18.96};
    struct gn_sun_day summer = gn_sun_day(utc_s(2026, 6, 21, 11, 0, 0), &tromso);
    assert_int_equal(summer.kind, GN_SUN_STAYS_UP);
    assert_true(isnan(summer.rise_s) && isnan(summer.set_s));
    assert_near(summer.noon_deg, 90 - 69.65 + 23.436, 0.01);
    struct gn_sun_day winter = gn_sun_day(utc_s(2026, 12, 21, 11, 0, 0), &tromso);
    assert_int_equal(winter.kind, GN_SUN_STAYS_DOWN);
    assert_near(winter.noon_deg, 90 - 69.65 - 23.436, 0.01);
}

/* The last sunset before a polar day lies after midnight, so that some days have one of the two. */
static void test_a_polar_day_begins_with_a_rise_without_a_set(void **state) {
    (void)state;
    static const struct gn_place place = {75, 0};
    int kinds[3] = {0}, half = 0;
    for (int day = 0; day < 365; day++) {
        struct gn_sun_day sun = gn_sun_day(utc_s(2026, 1, 1, 12, 0, 0) + day * 86400.0, &place);
        kinds[sun.kind]++;
        half += isnan(sun.rise_s) != isnan(sun.set_s);
    }
    assert_true(kinds[GN_SUN_STAYS_UP] > 90 && kinds[GN_SUN_STAYS_DOWN] > 80);
    assert_true(half <= 2);
    assert_int_equal(kinds[0] + kinds[1] + kinds[2], 365);
}

static void test_everything_is_finite_at_the_poles_and_far_from_now(void **state) {
    (void)state;
    for (int latitude = -90; latitude <= 90; latitude += 45)
        for (int i = 0; i < 88; i++) {
            const double s = -4e9 + i * 1.37e8;
            struct gn_place place = {latitude, 180};
            struct gn_sun_view view = gn_sun_view(s, &place);
            assert_true(view.azimuth_deg >= 0 && view.azimuth_deg <= 360);
            assert_true(fabs(view.altitude_deg) < 91 && fabs(view.hour_angle_deg) <= 180);
            assert_true(isfinite(gn_sun_day(s, &place).noon_s));
        }
}

static void test_north_is_minus_z_and_turns_counter_clockwise(void **state) {
    (void)state;
    static const struct {
        double azimuth, altitude, north;
        float x, y, z;
    } rows[] = {{0, 0, 0, 0, 0, -1},   {90, 0, 0, 1, 0, 0},  {180, 0, 0, 0, 0, 1},
                {270, 0, 0, -1, 0, 0}, {45, 90, 0, 0, 1, 0}, {0, 0, 90, -1, 0, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        float to_ws[3];
        gn_sun_direction(rows[i].azimuth, rows[i].altitude, rows[i].north, to_ws);
        assert_near(to_ws[0], rows[i].x, 1e-6);
        assert_near(to_ws[1], rows[i].y, 1e-6);
        assert_near(to_ws[2], rows[i].z, 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_sun_is_where_meeus_has_it),
        cmocka_unit_test(test_the_sun_is_where_nrel_has_it),
        cmocka_unit_test(test_rise_noon_and_set_are_those_of_nrel),
        cmocka_unit_test(test_refraction_is_that_of_bennett),
        cmocka_unit_test(test_refraction_has_no_step),
        cmocka_unit_test(test_polar_days_and_nights_have_neither_rise_nor_set),
        cmocka_unit_test(test_a_polar_day_begins_with_a_rise_without_a_set),
        cmocka_unit_test(test_everything_is_finite_at_the_poles_and_far_from_now),
        cmocka_unit_test(test_north_is_minus_z_and_turns_counter_clockwise),
    };
    return RUN(tests);
}
