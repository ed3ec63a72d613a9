/* Light of the sun and the sky by altitude and turbidity. */
#include <math.h>
#include <string.h>

#include "core/srgb.h"
#include "environment/daylight.h"
#include "environment/environment.h"
#include "unit/check.h"

static const float up[3] = {0, 1, 0};

static float brightness(const struct gn_daylight *d) {
    float to_sun[3] = {cosf((float)d->altitude_deg * 0.0174533f),
                       sinf((float)fmax(d->altitude_deg, 0) * 0.0174533f), 0};
    float rgb[3];
    gn_daylight_sky(d, to_sun, up, rgb);
    return gn_luminance(rgb) + gn_luminance(d->sun);
}

/* Kasten and Young: 1 in the zenith (.9997), 37.9 at the horizon. The share of light at one
 * wavelength is to the power of it, so the logarithms of two altitudes have its ratio. */
static void test_the_air_mass_is_that_of_the_paper(void **state) {
    (void)state;
    struct gn_daylight high, low;
    gn_daylight_build(90, 3, &high);
    gn_daylight_build(30, 3, &low);
    /* the screen's factor is the same for all colours: it goes out of ratios of them */
    const double of_high = log((double)high.sun[2] / (double)high.sun[0]),
                 of_low = log((double)low.sun[2] / (double)low.sun[0]);
    assert_true(fabs(of_low / of_high - 1.9939 / 0.9997) < 0.002); /* their table: 1.9939 */
}

static void test_a_lower_sun_is_redder_and_haze_dims_it(void **state) {
    (void)state;
    double before = 1;
    for (int h = 80; h > 0; h -= 5) {
        struct gn_daylight d;
        gn_daylight_build(h, 3, &d);
        const double blue = (double)(d.sun[2] / d.sun[0]);
        assert_true(d.sun[0] > 0 && blue < before);
        before = blue;
    }
    struct gn_daylight clear, hazy;
    gn_daylight_build(40, 2, &clear);
    gn_daylight_build(40, 8, &hazy);
    assert_true(gn_luminance(hazy.sun) < 0.6f * gn_luminance(clear.sun));
}

static void test_there_is_no_sun_below_the_horizon(void **state) {
    (void)state;
    struct gn_daylight d;
    gn_daylight_build(-0.3, 3, &d);
    assert_true(d.sun[0] == 0 && d.sun[1] == 0 && d.sun[2] == 0);
    gn_daylight_build(0.3, 3, &d);
    assert_true(d.sun[0] > 0);
}

/* a tenth of a degree is 24 seconds and more */
static void test_dusk_has_no_step_and_night_a_floor(void **state) {
    (void)state;
    for (int turbidity = 2; turbidity <= 10; turbidity += 4) {
        struct gn_daylight d;
        gn_daylight_build(-30, turbidity, &d);
        const float night = brightness(&d);
        float before = night;
        assert_true(night > 0.01f && night < 0.15f);
        for (int i = -300; i <= 900; i++) {
            const double h = i * 0.1;
            gn_daylight_build(h, turbidity, &d);
            const float now = brightness(&d);
            assert_true(isfinite(now) && now >= 0.99f * night);
            if (fabsf(now - before) > 0.15f)
                fail_msg("%.1f degrees: from %.3f to %.3f", h, (double)before, (double)now);
            before = now;
        }
    }
}

static void test_the_sky_is_blue_and_brightest_around_the_sun(void **state) {
    (void)state;
    struct gn_daylight d;
    float near_sun[3], away[3];
    const float to_sun[3] = {0, 0.7071f, -0.7071f}, other[3] = {0, 0.7071f, 0.7071f};
    gn_daylight_build(45, 2.5, &d);
    gn_daylight_sky(&d, to_sun, to_sun, near_sun);
    gn_daylight_sky(&d, to_sun, other, away);
    assert_true(away[2] > 2 * away[0]);
    assert_true(gn_luminance(near_sun) > 2 * gn_luminance(away));
}

/* The diffuse light of a level surface from above is that of the sky's mean, and the same with the
 * sun in another direction. */
static void test_an_environment_of_the_sky_turns_with_the_sun(void **state) {
    (void)state;
    static struct gn_environment east, north, brighter;
    const float to_east[3] = {0.8f, 0.6f, 0}, to_north[3] = {0, 0.6f, -0.8f};
    struct gn_daylight d;
    float a[3], b[3], c[3];
    gn_daylight_build(36.87, 3, &d);
    gn_environment_make_sky(&d, to_east, 2, &east);
    gn_environment_make_sky(&d, to_north, 1, &north);
    gn_environment_diffuse(&east.whole, up, a);
    gn_environment_diffuse(&north.whole, up, b);
    gn_environment_diffuse(&east.whole, to_east, c);
    for (int k = 0; k < 3; k++) {
        assert_true(a[k] > 0 && fabsf(a[k] - b[k]) < 0.01f * a[k]);
        assert_true(c[k] > a[k]);
    }
    gn_environment_scale(&east.whole, 2, &brighter.whole);
    gn_environment_diffuse(&brighter.whole, up, b);
    for (int k = 0; k < 3; k++) assert_true(fabsf(b[k] - 2 * a[k]) < 1e-5f);
    for (int i = 0; i < GN_ENVIRONMENT_TEXELS; i += 97) {
        gn_environment_unpack(east.whole.texels[i], a);
        gn_environment_unpack(brighter.whole.texels[i], b);
        for (int k = 0; k < 3; k++) assert_true(fabsf(b[k] - 2 * a[k]) <= 0.001f * b[k] + 1e-6f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_air_mass_is_that_of_the_paper),
        cmocka_unit_test(test_a_lower_sun_is_redder_and_haze_dims_it),
        cmocka_unit_test(test_there_is_no_sun_below_the_horizon),
        cmocka_unit_test(test_dusk_has_no_step_and_night_a_floor),
        cmocka_unit_test(test_the_sky_is_blue_and_brightest_around_the_sun),
        cmocka_unit_test(test_an_environment_of_the_sky_turns_with_the_sun),
    };
    return RUN(tests);
}
