/* Hours of sun as a picture in false colours, with a legend. */
#ifndef GN_STAGE_HOURS_PICTURE_H
#define GN_STAGE_HOURS_PICTURE_H

#include "stage/sun_hours.h"

/* Fills rgba, of width x height pixels, row 0 on top, sRGB. Colours are in bands of the same
 * number of hours, twelve at most, and of a surface without sun; those of surfaces are shaded
 * slightly by their normal, so that their shape is seen. The legend is in the upper left corner,
 * where it fits there with letters of 7 pixels; its font is that of captions. */
void gn_hours_picture_draw(const struct gn_sun_hours *hours,
                           const struct gn_sun_hours_picture *picture,
                           const struct gn_settings *settings, uint8_t *rgba, int width_px,
                           int height_px, struct gn_warnings *warnings);

#endif
