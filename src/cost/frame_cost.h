/* How long a GPU takes for a plan at least, by a model: what bounds a pass is the largest of
 * instructions of its lanes, fetches of its lanes and bytes of its memory, each over what the GPU
 * does in a second (gpu.h); vertices come on top, since tiling GPUs place all of a pass before they
 * shade. Passes add up. Not in the model: caches, latency of fetches, early ends of loops, the
 * processor's part; what the display reads. No GL. */
#ifndef GN_COST_FRAME_COST_H
#define GN_COST_FRAME_COST_H

#include "cost/program.h"
#include "cost/raster.h"
#include "frame/plan.h"

enum gn_cost_when { GN_COST_EACH_FRAME, GN_COST_CAMERA_MOVES, GN_COST_KEPT, GN_COST_WHEN_COUNT };
enum gn_cost_limit { GN_COST_INSTRUCTIONS, GN_COST_FETCHES, GN_COST_BYTES, GN_COST_LIMITS };

struct gn_pass_cost {
    uint64_t draws, triangles, vertices, pixels, lanes; /* triangles: that are seen, or hidden */
    double instructions, fetches, bytes;                /* instructions and fetches of all lanes */
    double vertex_instructions;
    double limit_ms[GN_COST_LIMITS], vertex_ms, ms;
    enum gn_cost_limit limit;
};
struct gn_cost_share { /* of the frame's time */
    const char *name;
    double ms;
};
struct gn_frame_cost {
    const struct gn_plan *plan;
    const struct gn_cost_gpu *gpu;
    struct gn_program_cost *programs; /* of the plan's, in their order */
    char (*names)[GN_PROGRAM_NAME];   /* as in the table; the caller's */
    bool *known;                      /* of the programs; false: the table has none of the kind */
    struct gn_pass_cost *passes;
    enum gn_cost_when *when;         /* of the passes */
    double ms[GN_COST_WHEN_COUNT];   /* of passes that are drawn then */
    struct gn_cost_share *materials; /* of the scene's, dearest first, of passes of each frame */
    struct gn_cost_share *lights;    /* of plan->lights, dearest first: what they cost in the
                                        picture, and their maps where those are drawn in each frame */
};
/* counts: as gn_cost_count() makes them. names, counts and when must outlive it. */
void gn_frame_cost_build(struct gn_frame_cost *cost, const struct gn_plan *plan,
                         const struct gn_cost_gpu *gpu, const struct gn_cost_table *table,
                         char (*names)[GN_PROGRAM_NAME], const struct gn_raster_count *counts,
                         enum gn_cost_when *when);
void gn_frame_cost_finish(struct gn_frame_cost *cost);

#endif
