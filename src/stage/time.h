/* How long a GPU takes for frames of a stage, by the model of cost/frame_cost.h, and how large the
 * picture may be for it. */
#ifndef GN_STAGE_TIME_H
#define GN_STAGE_TIME_H

#include "cost/frame_cost.h"
#include "stage/stage.h"

struct gn_stage_time {
    struct gn_frame_cost cost;
    struct gn_frame *builder;
    struct gn_cost_table *table;
    struct gn_raster_count *counts;
    char (*names)[GN_PROGRAM_NAME];
    enum gn_cost_when *when;
};
/* Of the stage's scene and pose at the settings' time, with these options, on a GPU that has all
 * capabilities. The stage must outlive it; its pose is as before. */
bool gn_stage_time_build(struct gn_stage_time *time, struct gn_stage *stage,
                         const struct gn_frame_opts *opts, const struct gn_cost_gpu *gpu,
                         struct gn_warnings *warnings, struct gn_err *err);
void gn_stage_time_finish(struct gn_stage_time *time);

struct gn_stage_parts { /* of a frame's time, ms */
    double fixed;       /* maps, vertices */
    double pixels;      /* of the picture at full size */
    double scaling;     /* on top, where it is drawn smaller */
};
enum { GN_STAGE_SCALE_STEPS = 20, GN_STAGE_REFRESHES_MAX = 4 };
/* The largest share of width and height, of steps of a twentieth from .5 to 1, at which a frame
 * takes one refresh at most; if none does, two, and so on; 1 where that takes as many as at full
 * size, or more than four. Pure. */
double gn_stage_scale_for(const struct gn_stage_parts *ms, double period_ms);
/* That of what the stage shows, also while the camera moves. Takes a tenth of a second, or more. */
double gn_stage_scale(struct gn_stage *stage, const struct gn_cost_gpu *gpu, double period_ms);

#endif
