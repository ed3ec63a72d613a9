/* Planar shadows in the picture's stencil. The plane is drawn after other opaque items, in all
 * light, and its samples are marked as visible. Then each light's casters, projected onto the
 * plane, set a bit of these samples, however many overlap; and the plane is drawn again where bits
 * are set, once for each set of them, with a constant that says which lights are blocked. So every
 * sample shows one shaded value: nothing is blended. Passes are limited to the rectangle where a
 * shadow, or a set of them, can be. A group of lights that is added has marks of its own, and its
 * sets begin with the one of no shadow. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "core/text.h"
#include "frame/private.h"

enum { SEEN = 0x80, SETS = 1 << GN_SHADOWS_MAX }; /* bits below SEEN: a light's shadow each */

/* The lights of a group that can darken the visible plane, as slots, and where. */
struct marks {
    uint32_t group, count, slots[GN_SHADOWS_MAX];
    struct gn_rect all, rects[GN_SHADOWS_MAX];
};

/* ---- where ---- */

static struct gn_rect output_rect(const struct gn_frame *frame) {
    return (struct gn_rect){0, 0, frame->plan.width_px, frame->plan.height_px};
}

static uint32_t pixel_of_ndc(float ndc, float extra_px, uint32_t size_px) {
    const float at = (0.5f * ndc + 0.5f) * (float)size_px + extra_px;
    return (uint32_t)fminf(fmaxf(at, 0.0f), (float)size_px);
}

static uint32_t min_u32(uint32_t a, uint32_t b) { return a < b ? a : b; }
static uint32_t max_u32(uint32_t a, uint32_t b) { return a > b ? a : b; }

/* Width 0: they do not overlap. */
static struct gn_rect intersect_rects(struct gn_rect a, struct gn_rect b) {
    const uint32_t x0 = max_u32(a.x, b.x), x1 = min_u32(a.x + a.width, b.x + b.width),
                   y0 = max_u32(a.y, b.y), y1 = min_u32(a.y + a.height, b.y + b.height);
    if (x0 >= x1 || y0 >= y1) return (struct gn_rect){0};
    return (struct gn_rect){x0, y0, x1 - x0, y1 - y0};
}

/* As gn_pass.rect: width 0 for all of the output. */
static struct gn_rect pass_rect(const struct gn_frame *frame, struct gn_rect rect) {
    const struct gn_rect all = output_rect(frame);
    return rect.width == all.width && rect.height == all.height ? (struct gn_rect){0} : rect;
}

static struct marks marks_of(const struct gn_frame *frame, uint32_t group) {
    const struct gn_light_group *g = &frame->groups[group];
    struct marks marks = {.group = group, .all = output_rect(frame)};
    const uint32_t size[2] = {frame->plan.width_px, frame->plan.height_px};
    if (g->rect.width > 0) marks.all = g->rect;
    for (uint32_t i = g->first_shadow; i < g->first_shadow + g->shadow_count; i++) {
        const struct gn_shadow_view *view = &frame->shadows[i];
        if (view->encoding != GN_ENCODING_STENCIL || view->empty) continue;
        uint32_t low[2], high[2]; /* a pixel wider on each side */
        for (int k = 0; k < 2; k++) {
            low[k] = pixel_of_ndc(view->raster.screen_ndc[0][k], -1.0f, size[k]);
            high[k] = pixel_of_ndc(view->raster.screen_ndc[1][k], 2.0f, size[k]);
        }
        const struct gn_rect shadow = {low[0], low[1], high[0] - low[0], high[1] - low[1]};
        const struct gn_rect rect = intersect_rects(marks.all, shadow);
        if (rect.width == 0) continue;
        marks.rects[marks.count] = rect;
        marks.slots[marks.count++] = i;
    }
    return marks;
}

bool gn_frame_marks_plane(const struct gn_frame *frame, uint32_t group) {
    return marks_of(frame, group).count > 0;
}

/* ---- casters ---- */

static void add_caster_pass(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts, const struct marks *marks,
                            uint32_t index) {
    const uint32_t slot = marks->slots[index];
    const struct gn_shadow_view *view = &frame->shadows[slot];
    const uint8_t bit = (uint8_t)(1u << index);
    char label[48];
    snprintf(label, sizeof label, "shadow %u %.36s", slot, frame->scene->lights[view->light].name);
    struct gn_pass *pass = gn_frame_picture_pass(frame, label);
    pass->picture.only_stencil = true;
    pass->depth_write = false;
    pass->picture.stencil = (struct gn_stencil){.value = SEEN | bit, .reads = SEEN, .writes = bit};
    pass->rect = pass_rect(frame, marks->rects[index]);
    if (marks->group > 0 && index == 0) pass->clear.stencil_bits = SETS - 1;
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_SHADOW + slot * GN_SLOT_SETS);
    mat4 clip_from_world;
    glm_mat4_mul((vec4 *)frame->eye.clip_from_world, (vec4 *)view->raster.tiles[0].clip_from_world,
                 clip_from_world);
    memcpy(c[PASS_CLIP], clip_from_world, sizeof clip_from_world);
    for (int k = 0; k < 4; k++) c[FLAT_PLANE][k] = view->raster.tiles[0].light_from_world[k][2];
    c[FLAT_HEIGHTS][0] = view->code.near_m;
    c[FLAT_HEIGHTS][1] = view->code.far_m;
    pass->constants = c;
    pass->constant_count = FLAT_HEIGHTS + 1;
    const bool behind = glm_vec4_dot(gn_frame_constants(frame, GN_CONSTANTS_PICTURE)[PASS_EYE],
                                     c[FLAT_PLANE]) < 0.0f;
    struct gn_selection casters = {.casts = frame->memory[slot][0].casts,
                                   .view = view,
                                   .mirrored = behind, /* seen as in a mirror */
                                   .opts = opts};
    gn_frame_draw_items(frame, pose, &casters);
    gn_frame_end_pass(frame);
}

/* ---- the plane ---- */

/* The draws of `lit` again, where the marks are this set. */
static void add_set_pass(struct gn_frame *frame, const struct marks *marks, uint32_t set,
                         const struct gn_pass *lit) {
    struct gn_rect rect = marks->all; /* where the set can occur */
    for (uint32_t i = 0; i < marks->count; i++)
        if (set >> i & 1) rect = intersect_rects(rect, marks->rects[i]);
    if (rect.width == 0) return;
    struct gn_pass *pass = gn_frame_begin_pass(frame, GN_PASS_PICTURE);
    *pass = *lit;
    pass->rect = pass_rect(frame, rect);
    for (uint32_t i = 0; i < marks->count; i++)
        if (set >> i & 1)
            gn_text_add(pass->label, sizeof pass->label, "%s %u",
                        set & ((1u << i) - 1) ? "" : ", shadow", marks->slots[i]);
    pass->depth_write = false;
    pass->picture.stencil = (struct gn_stencil){
        .value = (uint8_t)(SEEN | set), .reads = (uint8_t)(SEEN | ((1u << marks->count) - 1))};

    /* the group's constants, without light from the lights of the set */
    const size_t of_pass = GN_PASS_SIZE * sizeof *frame->sets;
    if (!frame->sets) frame->sets = gn_xalloc(GN_GROUPS_MAX * SETS, of_pass);
    float(*c)[4] = frame->sets + (size_t)(marks->group * SETS + set) * GN_PASS_SIZE;
    memcpy(c, gn_frame_constants(frame, GN_CONSTANTS_PICTURE + marks->group), of_pass);
    for (uint32_t i = 0; i < marks->count; i++) {
        const uint32_t at = marks->slots[i] - frame->groups[marks->group].first_shadow;
        if (set >> i & 1) c[PASS_SHADOWS + at * SHADOW_SIZE + SHADOW_CODE][CODE_FAR_END] = 0.0f;
    }
    pass->constants = c;
}

void gn_frame_plane_passes(struct gn_frame *frame, const struct gn_pose *pose,
                           const struct gn_frame_opts *opts, uint32_t group) {
    const struct marks marks = marks_of(frame, group);
    struct gn_selection plane = {.part = GN_PART_PLANE, .opts = opts};
    struct gn_pass lit = *gn_frame_lit_pass(frame, "plane", group);
    if (group > 0) plane.group = &frame->groups[group];
    gn_frame_draw_items(frame, pose, &plane);
    lit.draw_count = frame->draws.count - lit.first_draw;
    lit.picture.stencil = (struct gn_stencil){.value = SEEN, .writes = 0xff};
    frame->passes.count--;
    if (lit.draw_count == 0) return;
    if (group == 0) *gn_frame_begin_pass(frame, GN_PASS_PICTURE) = lit;
    for (uint32_t i = 0; i < marks.count; i++) add_caster_pass(frame, pose, opts, &marks, i);
    for (uint32_t set = group == 0; set < 1u << marks.count; set++)
        add_set_pass(frame, &marks, set, &lit);
}
