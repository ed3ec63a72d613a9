/* tool_sun: for each line "SECONDS LATITUDE LONGITUDE" of its input, what core/sun.h has of it:
 * azimuth, true and apparent altitude, declination, hour angle, then kind, rise, noon and set of
 * the day. */
#include <stdio.h>

#include "core/sun.h"

int main(void) {
    double utc_s;
    struct gn_place place;
    while (scanf("%lf %lf %lf", &utc_s, &place.latitude_deg, &place.longitude_deg) == 3) {
        struct gn_sun_view view = gn_sun_view(utc_s, &place);
        struct gn_sun_day day = gn_sun_day(utc_s, &place);
        printf("%.5f %.5f %.5f %.5f %.5f %d %.1f %.1f %.1f\n", view.azimuth_deg, view.true_deg,
               view.altitude_deg, view.sun.declination_deg, view.hour_angle_deg, (int)day.kind,
               day.rise_s, day.noon_s, day.set_s);
    }
    return 0;
}
