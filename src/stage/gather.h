/* Soft shadows as rays have them: the mean of pictures of one moment, each with hard shadows from
 * another point of every lamp. For what stands still. */
#ifndef GN_STAGE_GATHER_H
#define GN_STAGE_GATHER_H

#include "stage/stage.h"

enum {
    GN_GATHER_POINTS = 64, /* of each lamp, for a whole picture */
    GN_GATHER_PART = 8,    /* pictures in a mean, of which the whole is the mean */
};

/* A picture of a mean that has `count` of them: 64, or another multiple of 32 that gn_lamp_point()
 * takes. */
struct gn_gather_point {
    uint32_t index, count;
    bool aside; /* each is of another part of a pixel, so that outlines are smooth */
};

/* Gives `view` the pose, camera and look of the shown one, with hard shadows of those lights that
 * have soft ones, from that point of each. A plan of the shown view must have been built at its
 * pose. *aside is made when it is NULL: for gn_pose.lights_aside, by light; the caller frees it.
 * False: no light has soft shadows. */
bool gn_gather_share(struct gn_view *view, float (**aside)[3], const struct gn_view *shown,
                     struct gn_gather_point point);
/* Draws it into the view's mean. False: it cannot be gathered (gn_plan.gathers), or GL failed. */
bool gn_gather_add(struct gn_view *view, float (**aside)[3], const struct gn_view *shown,
                   struct gn_gather_point point, struct gn_gl *gl);

/* Before a picture of that time: its soft shadows are gathered at once, from as many points as the
 * kiosk's of a scene that stands, and lie over the pictures that the view draws from then on, which
 * have hard ones and no samples in a pixel. Where no light has a soft shadow, and with a warning
 * where the picture cannot be a mean, the view stays as it is. */
void gn_stage_gather(struct gn_stage *stage, struct gn_view *view, int64_t time_ns,
                     struct gn_warnings *warnings);

#endif
