#include "environment/daylight.h"

#include <math.h>

#define DEGREE        (M_PI / 180)
#define ABOVE_AIR     3.6    /* of the scene's unit */
#define DISK_DEG      0.2666 /* the sun's radius */
#define HIGH_SUN      2.9    /* illuminance of level ground by sun and sky at 70 degrees */
#define GROUND_ALBEDO 0.2f

/* ---- the sun ---- */

/* Kasten, Young, "Revised optical air mass tables and approximation formula" (1989) */
static double air_mass(double altitude_deg) {
    const double h = fmax(altitude_deg, 0);
    return 1 / (sin(h * DEGREE) + 0.50572 * pow(h + 6.07995, -1.6364));
}

/* Share of the disk over the horizon, smooth at both ends. */
static double share_risen(double altitude_deg) {
    const double x = fmin(fmax((altitude_deg + DISK_DEG) / (2 * DISK_DEG), 0), 1);
    return x * x * (3 - 2 * x);
}

static void sun_color(double altitude_deg, double turbidity, double rgb[3]) {
    static const double wavelength_um[3] = {0.612, 0.549, 0.465};
    const double m = air_mass(altitude_deg), aerosol = 0.04608 * turbidity - 0.04586;
    for (int k = 0; k < 3; k++) {
        const double rayleigh = 0.008735 * pow(wavelength_um[k], -4.08);
        const double haze = aerosol * pow(wavelength_um[k], -1.3);
        rgb[k] = ABOVE_AIR * share_risen(altitude_deg) * exp(-m * (rayleigh + haze));
    }
}

/* ---- the sky ---- */

/* Luminance Y and chromaticities x, y: five coefficients of the distribution, each slope * T +
 * value */
static const double perez[3][5][2] = {
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}},
    {{-0.0193, -0.2592},
     {-0.0665, 0.0008},
     {-0.0004, 0.2125},
     {-0.0641, -0.8989},
     {-0.0033, 0.0452}},
    {{-0.0167, -0.2608},
     {-0.0950, 0.0092},
     {-0.0079, 0.2102},
     {-0.0441, -1.6537},
     {-0.0109, 0.0529}},
};

static double distribution(int of, double turbidity, double cosine_zenith, double to_sun_rad) {
    double c[5];
    for (int i = 0; i < 5; i++) c[i] = perez[of][i][0] * turbidity + perez[of][i][1];
    const double cosine = cos(to_sun_rad);
    return (1 + c[0] * exp(c[1] / cosine_zenith)) *
           (1 + c[2] * exp(c[3] * to_sun_rad) + c[4] * cosine * cosine);
}

static double cubic(const double c[4], double x) {
    return ((c[0] * x + c[1]) * x + c[2]) * x + c[3];
}

/* of the zenith: kcd/m2, x, y */
static void zenith_of(double turbidity, double sun_rad, double out[3]) {
    static const double chromaticity[2][3][4] = {
        {{0.00166, -0.00375, 0.00209, 0},
         {-0.02903, 0.06377, -0.03202, 0.00394},
         {0.11693, -0.21196, 0.06052, 0.25886}},
        {{0.00275, -0.00610, 0.00317, 0},
         {-0.04214, 0.08970, -0.04153, 0.00516},
         {0.15346, -0.26756, 0.06670, 0.26688}},
    };
    const double t = turbidity, chi = (4 / 9.0 - t / 120) * (M_PI - 2 * sun_rad);
    out[0] = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;
    for (int i = 0; i < 2; i++) {
        const double(*c)[4] = chromaticity[i];
        out[1 + i] = (cubic(c[0], sun_rad) * t + cubic(c[1], sun_rad)) * t + cubic(c[2], sun_rad);
    }
}

/* Before the factor of dusk and of the screen; up over the horizon. */
static void sky_color(double altitude_deg, double turbidity, double up, double to_sun_rad,
                      double rgb[3]) {
    const double sun_rad = (90 - fmax(altitude_deg, 0)) * DEGREE;
    double zenith[3], color[3];
    zenith_of(turbidity, sun_rad, zenith);
    for (int i = 0; i < 3; i++)
        color[i] = zenith[i] * distribution(i, turbidity, fmax(up, 0.02), to_sun_rad) /
                   distribution(i, turbidity, 1, sun_rad);
    const double luminance = color[0] / GN_DAYLIGHT_KILOLUX;
    const double x = luminance * color[1] / color[2];
    const double z = luminance * (1 - color[1] - color[2]) / color[2];
    rgb[0] = fmax(3.2406 * x - 1.5372 * luminance - 0.4986 * z, 0);
    rgb[1] = fmax(-0.9689 * x + 1.8758 * luminance + 0.0415 * z, 0);
    rgb[2] = fmax(0.0557 * x - 0.2040 * luminance + 1.0570 * z, 0);
}

/* 1 with the sun at the horizon, by the polynomial for -5 to -.8 degrees, and its tangent below */
static double dusk(double altitude_deg) {
    const double end = -5 / 90.0, x = fmin(altitude_deg / 90, 0), inside = fmax(x, end);
    const double slope = 21.81 + end * (2 * -258.11 + end * 3 * -858.36);
    const double log10_lux = inside * (21.81 + inside * (-258.11 + inside * -858.36));
    return pow(10, log10_lux + slope * (x - inside));
}

/* Illuminance of level ground by the sky: the mean over rings and sectors of equal weight. */
static void sky_on_ground(double altitude_deg, double turbidity, double rgb[3]) {
    enum { RINGS = 8, SECTORS = 12 };
    const double sun = altitude_deg > 0 ? altitude_deg * DEGREE : 0;
    for (int k = 0; k < 3; k++) rgb[k] = 0;
    for (int i = 0; i < RINGS * SECTORS; i++) {
        const int ring = i / SECTORS;
        const double flat2 = (ring + 0.5) / RINGS, up = sqrt(1 - flat2);
        const double along = sqrt(flat2) * cos(2 * M_PI * (i % SECTORS + 0.5) / SECTORS);
        double part[3];
        sky_color(altitude_deg, turbidity, up,
                  acos(fmin(fmax(along * cos(sun) + up * sin(sun), -1), 1)), part);
        for (int k = 0; k < 3; k++) rgb[k] += M_PI * part[k] / (RINGS * SECTORS);
    }
}

void gn_daylight_build(double altitude_deg, double turbidity, struct gn_daylight *out) {
    double sun[3], sky[3], level[3];
    const double rise = sin(fmax(altitude_deg, 0) * DEGREE), dark = dusk(altitude_deg);
    sun_color(altitude_deg, turbidity, sun);
    sky_on_ground(altitude_deg, turbidity, sky);
    for (int k = 0; k < 3; k++) level[k] = sun[k] * rise + sky[k] * dark;
    const double luminance = 0.2126 * level[0] + 0.7152 * level[1] + 0.0722 * level[2];
    const double share = fmin(luminance / HIGH_SUN, 1);
    const double screen = fmax(pow(share, 1.0 / 3), GN_DAYLIGHT_FLOOR) / share;
    *out = (struct gn_daylight){altitude_deg, turbidity, .strength = dark * screen};
    for (int k = 0; k < 3; k++) {
        out->sun[k] = (float)(sun[k] * screen);
        out->ground[k] = GROUND_ALBEDO * (float)(level[k] * screen / M_PI);
    }
}

void gn_daylight_sky(const struct gn_daylight *daylight, const float to_sun[3], const float to[3],
                     float rgb[3]) {
    double sky[3], cosine = 0;
    for (int k = 0; k < 3; k++) cosine += (double)to_sun[k] * (double)to[k];
    sky_color(daylight->altitude_deg, daylight->turbidity, to[1], acos(fmin(fmax(cosine, -1), 1)),
              sky);
    for (int k = 0; k < 3; k++)
        rgb[k] = to[1] > 0.0f ? (float)(sky[k] * daylight->strength) : daylight->ground[k];
}
