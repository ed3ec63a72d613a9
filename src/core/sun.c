#include "core/sun.h"

#include <math.h>

#define DEGREE               (M_PI / 180)
#define DAY_S                86400.0
#define JULIAN_1970          2440587.5
#define JULIAN_2000          2451545.0
#define DYNAMICAL_AHEAD_S    69.0
#define SIDEREAL_DEG_PER_DAY 360.98564736629

static double sin_deg(double deg) { return sin(deg * DEGREE); }

static double cos_deg(double deg) { return cos(deg * DEGREE); }

/* to 0 to 360 */
static double turn_deg(double deg) {
    double rest = fmod(deg, 360);
    return rest < 0 ? rest + 360 : rest;
}

/* to -180 to 180 */
static double half_turn_deg(double deg) { return turn_deg(deg + 180) - 180; }

static double centuries_of(double julian) { return (julian - JULIAN_2000) / 36525; }

/* of the moon's orbit, on which nutation depends; nutation by its largest term */
static double node_deg(double t) { return 125.04 - 1934.136 * t; }

static double nutation_deg(double t) { return -0.00478 * sin_deg(node_deg(t)); }

static double obliquity_deg(double t) {
    double mean_s = 21.448 - t * (46.8150 + t * (0.00059 - t * 0.001813));
    return 23 + 26 / 60.0 + mean_s / 3600 + 0.00256 * cos_deg(node_deg(t));
}

struct gn_sun gn_sun_at_julian(double jde) {
    double t = centuries_of(jde);
    double mean_deg = 280.46646 + t * (36000.76983 + t * 0.0003032);
    double anomaly_deg = 357.52911 + t * (35999.05029 - t * 0.0001537);
    double e = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
    double centre_deg = (1.914602 - t * (0.004817 + t * 0.000014)) * sin_deg(anomaly_deg) +
                        (0.019993 - 0.000101 * t) * sin_deg(2 * anomaly_deg) +
                        0.000289 * sin_deg(3 * anomaly_deg);
    double longitude_deg = mean_deg + centre_deg - 0.00569 + nutation_deg(t);
    double tilt_deg = obliquity_deg(t);
    double y = cos_deg(tilt_deg) * sin_deg(longitude_deg);
    double right_deg = atan2(y, cos_deg(longitude_deg)) / DEGREE;
    double equation_deg =
        half_turn_deg(mean_deg - 0.0057183 - right_deg + nutation_deg(t) * cos_deg(tilt_deg));
    return (struct gn_sun){
        .longitude_deg = turn_deg(longitude_deg),
        .right_ascension_deg = turn_deg(right_deg),
        .declination_deg = asin(sin_deg(tilt_deg) * sin_deg(longitude_deg)) / DEGREE,
        .equation_of_time_s = equation_deg * 240,
        .distance_au = 1.000001018 * (1 - e * e) / (1 + e * cos_deg(anomaly_deg + centre_deg)),
    };
}

struct gn_sun gn_sun_at(double utc_s) {
    return gn_sun_at_julian(JULIAN_1970 + (utc_s + DYNAMICAL_AHEAD_S) / DAY_S);
}

/* apparent sidereal time at Greenwich */
static double sidereal_deg(double utc_s) {
    double julian = JULIAN_1970 + utc_s / DAY_S;
    double t = centuries_of(julian);
    double mean_deg = 280.46061837 + SIDEREAL_DEG_PER_DAY * (julian - JULIAN_2000) +
                      t * t * (0.000387933 - t / 38710000);
    return mean_deg + nutation_deg(t) * cos_deg(obliquity_deg(t));
}

double gn_sun_refraction_deg(double true_deg) {
    double h = fmax(true_deg, -1);
    double air_deg = (1.02 / tan((h + 10.3 / (h + 5.11)) * DEGREE) + 0.0019279) / 60;
    return true_deg >= -1 ? air_deg : air_deg * fabs(tan(DEGREE) / tan(true_deg * DEGREE));
}

struct gn_sun_view gn_sun_view(double utc_s, const struct gn_place *place) {
    struct gn_sun sun = gn_sun_at(utc_s);
    double hour_deg =
        half_turn_deg(sidereal_deg(utc_s) + place->longitude_deg - sun.right_ascension_deg);
    double south = cos_deg(hour_deg) * cos_deg(sun.declination_deg);
    double west = sin_deg(hour_deg) * cos_deg(sun.declination_deg);
    double pole = sin_deg(sun.declination_deg);
    double sine = sin_deg(place->latitude_deg), cosine = cos_deg(place->latitude_deg);
    double up = fmin(fmax(sine * pole + cosine * south, -1), 1);
    double altitude_deg = asin(up) / DEGREE;
    double true_deg = altitude_deg - 8.794 / 3600 / sun.distance_au * cos_deg(altitude_deg);
    return (struct gn_sun_view){
        .sun = sun,
        .hour_angle_deg = hour_deg,
        .azimuth_deg = turn_deg(atan2(west, sine * south - cosine * pole) / DEGREE + 180),
        .true_deg = true_deg,
        .altitude_deg = true_deg + gn_sun_refraction_deg(true_deg),
    };
}

static double true_deg_at(double utc_s, const struct gn_place *place) {
    return gn_sun_view(utc_s, place).true_deg;
}

/* when the limb crosses the horizon between one time and another, to .01 s; NAN where it does not
 */
static double find_crossing(double low_s, double high_s, const struct gn_place *place) {
    if (true_deg_at(low_s, place) >= GN_SUN_RISE_DEG ||
        true_deg_at(high_s, place) < GN_SUN_RISE_DEG)
        return NAN;
    while (fabs(high_s - low_s) > 0.01) {
        double middle_s = (low_s + high_s) / 2;
        *(true_deg_at(middle_s, place) < GN_SUN_RISE_DEG ? &low_s : &high_s) = middle_s;
    }
    return high_s;
}

struct gn_sun_day gn_sun_day(double utc_s, const struct gn_place *place) {
    double noon_s = utc_s;
    for (int i = 0; i < 3; i++) noon_s -= gn_sun_view(noon_s, place).hour_angle_deg * 240;
    struct gn_sun_day day = {
        .noon_s = noon_s,
        .noon_deg = true_deg_at(noon_s, place),
        .rise_s = find_crossing(noon_s - DAY_S / 2, noon_s, place),
        .set_s = find_crossing(noon_s + DAY_S / 2, noon_s, place),
    };
    if (isnan(day.rise_s) && isnan(day.set_s))
        day.kind = day.noon_deg < GN_SUN_RISE_DEG ? GN_SUN_STAYS_DOWN : GN_SUN_STAYS_UP;
    return day;
}

void gn_sun_direction(double azimuth_deg, double altitude_deg, double north_deg, float to_ws[3]) {
    double turned_deg = azimuth_deg - north_deg;
    to_ws[0] = (float)(sin_deg(turned_deg) * cos_deg(altitude_deg));
    to_ws[1] = (float)sin_deg(altitude_deg);
    to_ws[2] = (float)(-cos_deg(turned_deg) * cos_deg(altitude_deg));
}
