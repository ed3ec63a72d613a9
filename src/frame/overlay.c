/* Optional overlays: light gizmos, and shadow maps as panels. Vertices are generated from
 * gl_VertexID. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"
#include "shadow/grey.h"

enum { MARK_VERTICES = 6 * MARK_QUADS, GAP_PX = 8, FRAME_PX = 2 };

static struct gn_program_key overlay_key(const struct gn_frame *frame, enum gn_program_kind kind) {
    struct gn_program_key key = gn_key_of(kind);
    if (frame->plan.encode_srgb && frame->plan.output == GN_OUTPUT_LINEAR8)
        key.features = GN_FEATURE(ENCODE_SRGB);
    return key;
}

/* Its colour as bright as can be; a dark light is grey. */
static void hue_of(const struct gn_light *light, float out[3]) {
    float most = fmaxf(light->color[0], fmaxf(light->color[1], light->color[2]));
    for (int k = 0; k < 3; k++) out[k] = most > 0.0f ? light->color[k] / most : 0.2f;
}

/* Pixels of the picture as large as one of 720 rows. */
static float pixel_scale(const struct gn_frame *frame) {
    return fmaxf((float)frame->picture.height_px / 720.0f, 1.0f);
}

/* ---- marks ---- */

/* A directional light is placed where the ray from the scene's centre towards it leaves the box, or
 * the view. Returns the distance from the centre. */
static float place_directional(const struct gn_frame *frame, const struct gn_pose *pose,
                               const vec3 direction, vec3 place) {
    vec3 centre, out;
    float reach = INFINITY, share = 1.0f;
    glm_vec3_center((float *)pose->box_ws.min, (float *)pose->box_ws.max, centre);
    for (int k = 0; k < 3; k++)
        reach = fminf(reach, 0.5f * (pose->box_ws.max[k] - pose->box_ws.min[k]) /
                                 fmaxf(fabsf(direction[k]), 1e-6f));
    glm_vec3_scale((float *)direction, -reach, out);
    for (int i = 0; i < 6; i++) {
        const float *n = frame->eye.planes[i];
        float inside = glm_vec3_dot((float *)n, centre) + n[3];
        float loss = -glm_vec3_dot((float *)n, out);
        if (inside > 0.0f && loss > 0.0f) share = fminf(share, 0.85f * inside / loss);
    }
    glm_vec3_copy(centre, place);
    glm_vec3_muladds(out, share, place);
    return share * reach;
}

/* surface: kind of the light, how long or wide it is drawn in metres, tangent of its cone, 1 where
 * that is its range. */
static struct gn_instance make_mark(const struct gn_frame *frame, const struct gn_pose *pose,
                                    uint32_t index) {
    const struct gn_light *light = &frame->scene->lights[index];
    struct gn_instance mark = {.base_color = {0, 0, 0, 1}};
    const float size_m = glm_vec3_distance((float *)pose->box_ws.min, (float *)pose->box_ws.max);
    vec3 place, direction;
    gn_pose_light(pose, index, place, direction);
    hue_of(light, mark.base_color);
    mark.surface[0] = (float)light->type;
    mark.surface[1] = light->range_m > 0.0f ? light->range_m : 0.2f * size_m;
    mark.surface[2] = tanf(fminf(light->outer_rad, 1.5f));
    mark.surface[3] = light->range_m > 0.0f ? 1.0f : 0.0f;
    if (!gn_light_types[light->type].has_position)
        mark.surface[1] = 0.5f * place_directional(frame, pose, direction, place);
    /* Rows of world_from_mark, whose Z is the direction of the light. */
    vec3 x, y;
    glm_vec3_ortho(direction, x);
    glm_vec3_normalize(x);
    glm_vec3_cross(direction, x, y);
    for (int r = 0; r < 3; r++) {
        mark.world[r][0] = x[r];
        mark.world[r][1] = y[r];
        mark.world[r][2] = direction[r];
        mark.world[r][3] = place[r];
    }
    return mark;
}

/* All gizmos twice: first pale, through everything, then where they are not hidden. */
static void add_marks_pass(struct gn_frame *frame, const struct gn_pose *pose) {
    const uint32_t first = frame->instances.count, count = frame->scene->light_count;
    struct gn_program_key key = overlay_key(frame, GN_PROGRAM_MARK);
    struct gn_pass *pass = gn_frame_picture_pass(frame, "marks of lights");
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_MARK);
    pass->picture.blend = GN_BLEND_ALPHA;
    pass->depth_write = false;
    pass->constants = c;
    memcpy(c[PASS_CLIP], frame->eye.clip_from_world, sizeof frame->eye.clip_from_world);
    c[MARK_PIXEL][0] = 2.0f * pixel_scale(frame) / (float)frame->plan.width_px;
    c[MARK_PIXEL][1] = 2.0f * pixel_scale(frame) / (float)frame->plan.height_px;
    for (int pale = 1; pale >= 0; pale--)
        for (uint32_t i = 0; i < count; i++) {
            struct gn_instance mark = make_mark(frame, pose, i);
            if (pale) mark.base_color[3] = 0.3f;
            GN_LIST_PUSH(&frame->instances) = mark;
        }
    gn_frame_draw_bare(frame, &key, MARK_VERTICES, first, 2 * count);
    gn_frame_end_pass(frame);
}

/* ---- panels ---- */

struct gn_rect gn_frame_turned_rect(unsigned turn_deg, uint32_t w, uint32_t h, struct gn_rect r) {
    switch (turn_deg) {
    case 90: return (struct gn_rect){r.y, w - r.x - r.width, r.height, r.width};
    case 180: return (struct gn_rect){w - r.x - r.width, h - r.y - r.height, r.width, r.height};
    case 270: return (struct gn_rect){h - r.y - r.height, r.x, r.height, r.width};
    default: return r;
    }
}

static void add_panel_pass(struct gn_frame *frame, uint32_t slot) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    if (view->encoding == GN_ENCODING_STENCIL || view->encoding == GN_ENCODING_SCREEN)
        return; /* it has no map */
    /* Along the lower edge, from the left: a quarter of the height, or less so that all fit. */
    const uint32_t width = frame->picture.width_px, height = frame->picture.height_px;
    const uint32_t gap = (uint32_t)(GAP_PX * pixel_scale(frame)),
                   each = width / frame->shadow_count;
    uint32_t side = height / 4 < each ? height / 4 : each;
    const uint32_t space = side > 4 * gap ? gap : 0;
    side -= space;
    const struct gn_rect rect = {space / 2 + slot * (side + space), space / 2, side,
                                 side * view->map.height_px / view->map.width_px};
    if (rect.height == 0) return;
    char label[48];
    snprintf(label, sizeof label, "panel %u %s", slot, frame->scene->lights[view->light].name);
    struct gn_program_key key = overlay_key(frame, GN_PROGRAM_PANEL);
    key.encoding = (uint8_t)gn_encoding_of_programs(view->encoding);
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_PANEL) +
                   (size_t)slot * PANEL_SIZE;
    const float size[2] = {(float)width, (float)height};
    const struct gn_shadow_grey grey = gn_shadow_grey_of(view);
    const float rectangle[4] = {2.0f * (float)rect.x / size[0] - 1.0f,
                                2.0f * (float)rect.y / size[1] - 1.0f,
                                2.0f * (float)(rect.x + rect.width) / size[0] - 1.0f,
                                2.0f * (float)(rect.y + rect.height) / size[1] - 1.0f};
    memcpy(c[PANEL_RECT], rectangle, sizeof rectangle);
    c[PANEL_GREY][0] = grey.scale;
    c[PANEL_GREY][1] = grey.offset;
    c[PANEL_GREY][2] = grey.power;
    hue_of(&frame->scene->lights[view->light], c[PANEL_FRAME]);
    c[PANEL_FRAME][3] = rect.width > 24 ? FRAME_PX * pixel_scale(frame) : 1.0f;
    c[PANEL_PX][0] = (float)rect.width;
    c[PANEL_PX][1] = (float)rect.height;
    c[PANEL_PX][2] = frame->picture.turn[0];
    c[PANEL_PX][3] = frame->picture.turn[1];
    struct gn_pass *pass = gn_frame_picture_pass(frame, label);
    pass->depth_write = false;
    pass->rect = gn_frame_turned_rect(frame->picture.turn_deg, width, height, rect);
    pass->picture.first_shadow = slot;
    pass->picture.shadow_count = 1;
    pass->picture.reads_codes = true;
    pass->constants = c;
    pass->constant_count = PANEL_SIZE;
    gn_frame_draw_bare(frame, &key, 6, 0, 1);
    gn_frame_end_pass(frame);
}

_Static_assert(GN_ALL_SHADOWS_MAX *PANEL_SIZE <= GN_PASS_SIZE, "room for all panels");

void gn_frame_add_overlay(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts) {
    if (opts->debug.aov != GN_AOV_COLOR) return;
    if (opts->debug.show_lights && frame->scene->light_count > 0) add_marks_pass(frame, pose);
    for (uint32_t i = 0; opts->debug.show_maps && i < frame->shadow_count; i++)
        add_panel_pass(frame, i);
}
