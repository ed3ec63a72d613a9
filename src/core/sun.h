/* Where the sun stands, by the formulas of Meeus, Astronomical Algorithms (2nd edition, 1998): its
 * place by chapter 25 (lower accuracy), sidereal time by 12, parallax by 40, equation of time
 * by 28. They err by up to .01 degrees from 1900 to 2100, which is 2.4 s of a dial's time. Two
 * causes are outside of them: UT1 is taken as UTC (up to .9 s, .004 degrees of azimuth), and
 * dynamical time as 69 s ahead of UTC (its value in the 2020s; .003 degrees at most from 1900 to
 * 2100).
 *
 * Times are seconds of UTC since 1970 as time() has them, without leap seconds. Angles are in
 * degrees: latitude positive to the north, longitude positive to the east, azimuth from north over
 * east (90), altitude over the horizon. There is no failure: every finite argument has a result. */
#ifndef GN_CORE_SUN_H
#define GN_CORE_SUN_H

#define GN_SUN_RADIUS_DEG 0.26656  /* angular radius at 1 astronomical unit */
#define GN_SUN_TAN_RADIUS 0.00465f /* its tangent, as gnomon_radius of a directional light */
/* True altitude of the centre at which the upper limb rises and sets: 34' of refraction, 16' of the
 * disk (Meeus, chapter 15). */
#define GN_SUN_RISE_DEG   (-0.8333)

struct gn_place {
    double latitude_deg;  /* -90 to 90 */
    double longitude_deg; /* -180 to 180, east positive */
};

/* The sun as seen from the earth's centre: the same at all places. */
struct gn_sun {
    double longitude_deg;       /* apparent, on the ecliptic, 0 to 360 */
    double right_ascension_deg; /* apparent, 0 to 360 */
    double declination_deg;     /* apparent, -23.5 to 23.5 */
    double equation_of_time_s;  /* apparent less mean solar time, -860 to 990: a dial runs ahead */
    double distance_au;         /* astronomical units, .983 to 1.017 */
};

/* The sun as seen from a place at the height of the sea. */
struct gn_sun_view {
    struct gn_sun sun;
    double hour_angle_deg; /* -180 to 180, negative before noon; a dial shows 12 h + this / 15 */
    double azimuth_deg;    /* 0 to 360, from north over east */
    double true_deg;       /* altitude of the centre without air, with parallax */
    double altitude_deg;   /* apparent altitude: true_deg and gn_sun_refraction_deg() */
};

/* What the sun does between two midnights of apparent solar time. */
enum gn_sun_day_kind {
    GN_SUN_RISES, /* it rises, sets, or both */
    GN_SUN_STAYS_UP,
    GN_SUN_STAYS_DOWN,
};

struct gn_sun_day {
    enum gn_sun_day_kind kind;
    double noon_s;        /* upper transit of the meridian */
    double noon_deg;      /* true altitude of the centre then */
    double rise_s, set_s; /* upper limb, in the 12 hours before and after noon; NAN where there is
                           * none, as in the first and last hours of a polar day */
};

struct gn_sun gn_sun_at(double utc_s);
/* The same by a Julian day of dynamical time, as tables of examples have it. */
struct gn_sun gn_sun_at_julian(double jde);
struct gn_sun_view gn_sun_view(double utc_s, const struct gn_place *place);

/* How much air lifts a body of that true altitude, at 1010 hPa and 10 degrees Celsius: Saemundsson
 * (1986), Meeus 16.4, within .1' of Bennett (1982), who is within .07' of measured tables down to
 * the horizon. From -1 degree down it decreases as 1/tan (NOAA's solar calculator), for smoothness:
 * nothing is seen there. */
double gn_sun_refraction_deg(double true_deg);

/* The day whose noon is nearest to the given time. Noon is within 5 s of PyEphem's, rise and set up
 * to 78 degrees of latitude within 10 s; real air moves them by a minute and more. */
struct gn_sun_day gn_sun_day(double utc_s, const struct gn_place *place);

/* A unit vector to what stands at this azimuth and altitude, in a scene where +Y is up and north is
 * -Z, turned by north_deg about +Y, counter-clockwise seen from above: by 90, north is -X. */
void gn_sun_direction(double azimuth_deg, double altitude_deg, double north_deg, float to_ws[3]);

#endif
