/* Light of the sun and of a clear sky by the sun's altitude and the air's turbidity, for a screen.
 *
 * The sun: extinction by Rayleigh scattering and by aerosols, as Preetham, Shirley, Smits, "A
 * Practical Analytic Model for Daylight" (SIGGRAPH 1999), appendix 1, have them, over the air mass
 * of Kasten and Young (1989), at one wavelength for each primary of Rec. 709; ozone and vapour are
 * left out. The sky: the distribution and zenith of the same paper, appendix 2. Below the horizon,
 * where that has no sky, its light decreases as the illuminance of Janiczek and DeYoung, "Computer
 * Programs for Sun and Moon Illuminance" (USNO Circular 171, 1987), without a step.
 *
 * The unit is the scene's: GN_DAYLIGHT_KILOLUX thousand lux are one. Outdoors light varies over
 * nine orders, a screen shows two: all light of a moment, sun and sky alike, has one factor, by
 * which brightness varies with the cube root of illuminance (Stevens 1961), and never falls below
 * GN_DAYLIGHT_FLOOR of a high sun's. Altitudes are apparent and in degrees; turbidity 2 to 10. */
#ifndef GN_ENVIRONMENT_DAYLIGHT_H
#define GN_ENVIRONMENT_DAYLIGHT_H

#define GN_DAYLIGHT_KILOLUX 37.0 /* 133 kilolux above the air are 3.6 */
#define GN_DAYLIGHT_FLOOR   0.04

struct gn_daylight { /* of one altitude and turbidity */
    double altitude_deg, turbidity;
    float sun[3];    /* on a surface that faces it; 0 once the disk has set */
    float ground[3]; /* radiance of a ground that reflects a fifth */
    double strength; /* factor on gn_daylight_sky(), of dusk and the screen */
};

void gn_daylight_build(double altitude_deg, double turbidity, struct gn_daylight *out);
/* Radiance of the sky in a unit direction, +Y up, seen with the sun in another; from the horizon
 * down it is the ground's. The sun's disk is not in it. */
void gn_daylight_sky(const struct gn_daylight *daylight, const float to_sun[3], const float to[3],
                     float rgb[3]);

#endif
