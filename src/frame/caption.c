/* Texts over the finished picture: one draw, an instance per rectangle. Colours are in the target's
 * encoded space, so the pass comes after all linear ones. A picture that is dimmed has grounds over
 * all of it, the last of them as strong as it takes. */
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "core/srgb.h"
#include "frame/private.h"

static void add_rectangle(struct gn_frame *frame, const struct gn_caption_quad *q, float alpha) {
    /* base_color: the rectangle in pixels, top row first; surface: its place in the atlas, its
     * opacity, 1 for a background. */
    GN_LIST_PUSH(&frame->instances) = (struct gn_instance){
        .base_color = {(float)q->x, (float)q->y, (float)q->width, (float)q->height},
        .surface = {(float)q->atlas_x, (float)q->atlas_y, alpha, q->ground ? 1.0f : 0.0f}};
}

struct bounds {
    int32_t left, top, right, bottom; /* pixels, top row first; empty: right is not above left */
};

static struct bounds visible_bounds(const struct gn_caption_run *run) {
    struct bounds seen = {.left = INT32_MAX, .top = INT32_MAX};
    for (uint32_t i = 0; run && i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        if (run->alpha[q->caption] <= 0.0f) continue;
        if (q->x < seen.left) seen.left = q->x;
        if (q->y < seen.top) seen.top = q->y;
        if (q->x + q->width > seen.right) seen.right = q->x + q->width;
        if (q->y + q->height > seen.bottom) seen.bottom = q->y + q->height;
    }
    return seen;
}

/* The nearest to `by` that moves from..to without leaving 0..size; 0 if nothing is there. */
static int32_t moved_within(int32_t by, int32_t from, int32_t to, int32_t size) {
    const int32_t most = by < size - to ? by : size - to;
    return from >= to ? 0 : most > -from ? most : -from;
}

/* As far to the right and up as the scene, as far as the picture reaches; so are their bounds. */
static void add_quads(struct gn_frame *frame, const struct gn_caption_run *run, struct bounds *seen,
                      const int shift_px[2]) {
    const int32_t x = moved_within(shift_px[0], seen->left, seen->right, (int32_t)run->width_px),
                  y = moved_within(-shift_px[1], seen->top, seen->bottom, (int32_t)run->height_px);
    for (uint32_t i = 0; i < run->quad_count; i++) {
        struct gn_caption_quad q = run->quads[i];
        q.x += x;
        q.y += y;
        const float alpha = run->alpha[q.caption] * (float)(255 - q.faint) / 255.0f;
        if (alpha > 0.0f) add_rectangle(frame, &q, alpha);
    }
    *seen = (struct bounds){seen->left + x, seen->top + y, seen->right + x, seen->bottom + y};
}

/* In a target that is blended as stored the share of light is exact on white, and close below. */
static void add_dimming(struct gn_frame *frame, float share) {
    const struct gn_caption_quad all = {.width = (int32_t)frame->picture.shown_width_px,
                                        .height = (int32_t)frame->picture.shown_height_px,
                                        .ground = true};
    const float least = 1e-4f, light = 1.0f - share > least ? 1.0f - share : least;
    const bool encodes = frame->plan.encode_srgb;
    const float ground = (float)CAPTION_SHADE;
    const float shade = encodes ? ground : powf((ground + 0.055f) / 1.055f, 2.4f);
    float left = encodes ? gn_srgb_encode(light) : light;
    while (left < shade) {
        add_rectangle(frame, &all, 1.0f);
        left /= shade;
    }
    add_rectangle(frame, &all, (1.0f - left) / (1.0f - shade));
}

void gn_frame_add_captions(struct gn_frame *frame, const struct gn_pose *pose,
                           const struct gn_frame_opts *opts) {
    (void)pose;
    const struct gn_caption_run *run = opts->cover.captions;
    struct gn_program_key key = gn_key_of(GN_PROGRAM_CAPTION);
    if (frame->plan.encode_srgb) key.features = GN_FEATURE(ENCODE_SRGB);
    if (opts->debug.aov != GN_AOV_COLOR) return;
    if (run && (run->width_px != frame->picture.shown_width_px ||
                run->height_px != frame->picture.shown_height_px))
        run = NULL;
    const uint32_t first = frame->instances.count;
    struct bounds seen = visible_bounds(run);
    if (run) add_quads(frame, run, &seen, opts->view.shift_px);
    if (opts->cover.dimmed > 0.0f) {
        add_dimming(frame, opts->cover.dimmed);
        seen = (struct bounds){.right = (int32_t)frame->picture.shown_width_px,
                               .bottom = (int32_t)frame->picture.shown_height_px};
    }
    if (seen.right <= seen.left) return;
    const struct gn_rect rect = {
        (uint32_t)seen.left, frame->picture.shown_height_px - (uint32_t)seen.bottom,
        (uint32_t)(seen.right - seen.left), (uint32_t)(seen.bottom - seen.top)};
    struct gn_pass *pass = gn_frame_picture_pass(frame, "captions");
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_CAPTION);
    if (frame->plan.finishes) pass->target.kind = GN_TARGET_ENCODED;
    gn_frame_to_shown(frame, pass);
    pass->rect = gn_frame_turned_rect(frame->picture.turn_deg, frame->picture.shown_width_px,
                                      frame->picture.shown_height_px, rect);
    pass->picture.blend = GN_BLEND_ALPHA;
    pass->depth_write = false;
    pass->picture.reads_atlas = run;
    pass->constants = c;
    pass->constant_count = CAPTION_SIZE;
    c[CAPTION_PX][0] = 2.0f / (float)frame->picture.shown_width_px;
    c[CAPTION_PX][1] = 2.0f / (float)frame->picture.shown_height_px;
    c[CAPTION_PX][2] = frame->picture.turn[0];
    c[CAPTION_PX][3] = frame->picture.turn[1];
    frame->plan.atlas = run ? run->atlas : NULL;
    gn_frame_draw_bare(frame, &key, 6, first, frame->instances.count - first);
    gn_frame_end_pass(frame);
}
