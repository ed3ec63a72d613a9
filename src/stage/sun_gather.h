/* Hours of sun of a view that stands, a position of the sun at a time, for a kiosk. The GPU adds
 * the pictures of a part of the positions, which is then added here, so that half floats round off
 * nothing that is seen. */
#ifndef GN_STAGE_SUN_GATHER_H
#define GN_STAGE_SUN_GATHER_H

#include "stage/sun_hours.h"

enum { GN_SUN_PART = 48 }; /* positions that the GPU adds */

struct gn_sun_gather {
    struct gn_sun_hours hours;        /* those of the day */
    struct gn_sun_hours_picture seen; /* upright: the day's hours, by the positions so far */
    float *rgba;                      /* of a picture, as the output has it */
    uint8_t *bytes;                   /* of the upright one in false colours */
    uint32_t order[GN_SUN_POSITIONS]; /* of the positions: each beginning of it is of all the day */
    uint32_t drawn, added, painted;   /* positions by the GPU; in the sums; in the last picture */
    uint32_t width_px, height_px;     /* of the output */
    unsigned turn_deg;                /* as gn_frame_output_opts has it */
};

/* Bytes for each pixel, on the GPU and here. */
enum { GN_SUN_GATHER_BYTES = 3 * 8 + 4 + 4 + 16 + 16 + 4 };

/* Gives `view` the pose, camera and output of the shown one. */
void gn_sun_gather_share(const struct gn_sun_gather *gather, struct gn_view *view,
                         const struct gn_view *shown, enum gn_sun_look look);
/* Of the day that the shown view's moment is in. Draws its surfaces. False: there are none, or GL
 * failed; what is there is to be finished, too. */
bool gn_sun_gather_begin(struct gn_sun_gather *gather, struct gn_view *view,
                         const struct gn_view *shown, const struct gn_settings *settings,
                         struct gn_gl *gl, struct gn_err *err);
/* Adds the next position; the light stands as before afterwards. */
bool gn_sun_gather_add(struct gn_sun_gather *gather, struct gn_view *view,
                       const struct gn_view *shown, struct gn_gl *gl, struct gn_err *err);
/* Whether there are twice as many positions as in the last picture, or all. */
bool gn_sun_gather_may_paint(const struct gn_sun_gather *gather);
/* Makes a picture of them, in false colours with a legend, which becomes the view's mean. */
bool gn_sun_gather_paint(struct gn_sun_gather *gather, const struct gn_view *view,
                         const struct gn_settings *settings, struct gn_gl *gl,
                         struct gn_warnings *warnings, struct gn_err *err);
void gn_sun_gather_finish(struct gn_sun_gather *gather);

#endif
