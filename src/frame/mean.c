/* A mean of pictures: of a scene that stands, from many points of each lamp. One view gathers it,
 * a picture at a time, which is all that the picture is drawn for; another one shows it. It is a
 * mean of means: what half floats round off in one adds up with the number of its pictures. */
#include "blocks.glsl"
#include "frame/private.h"

/* set: of the pass's constants, 0 or 1; most: what is brighter is cut; adds: to what is there. */
static struct gn_pass *add_pass(struct gn_frame *frame, const char *label, uint32_t set,
                                float share, float most, bool adds) {
    struct gn_program_key key = gn_key_of(GN_PROGRAM_MEAN);
    struct gn_pass *pass = gn_frame_picture_pass(frame, label);
    float(*c)[4] =
        gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_MEAN) + set * MEAN_SIZE;
    adds = adds && share < 1.0f; /* the first one of a sum replaces what is there */
    c[MEAN_SHARE][0] = adds ? 1.0f : share;
    c[MEAN_SHARE][1] = most;
    pass->picture.blend = adds ? GN_BLEND_ADD : share < 1.0f ? GN_BLEND_ALPHA : GN_BLEND_OFF;
    pass->depth_write = false;
    pass->constants = c;
    pass->constant_count = MEAN_SIZE;
    if (frame->plan.encode_srgb) key.features |= GN_FEATURE(ENCODE_SRGB);
    if (adds) key.features |= GN_FEATURE(ADDITIVE);
    gn_frame_draw_bare(frame, &key, 3, 0, 1);
    gn_frame_end_pass(frame);
    return pass;
}

void gn_frame_add_mean(struct gn_frame *frame, const struct gn_pose *pose,
                       const struct gn_frame_opts *opts) {
    const struct gn_plan *plan = &frame->plan;
    (void)pose;
    if (plan->gathers) {
        struct gn_pass *pass =
            add_pass(frame, "mean of a part", 0, opts->gather.part, 65504.0f, opts->gather.sums);
        pass->target.kind = GN_TARGET_MEAN;
        pass->target.index = 1;
        if (opts->gather.whole <= 0.0f) return;
        add_pass(frame, "mean", 1, opts->gather.whole, 1.0f, false)->target.kind = GN_TARGET_MEAN;
    } else if (opts->cover.mean > 0.0f && plan->aov == GN_AOV_COLOR) {
        struct gn_pass *pass = add_pass(frame, "mean", 0, opts->cover.mean, 1.0f, false);
        if (plan->finishes) pass->target.kind = GN_TARGET_ENCODED;
        pass->picture.mean_of = opts->cover.mean_of + 1;
    }
}
