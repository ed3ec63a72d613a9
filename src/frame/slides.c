#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

/* How many lights before this one in the scene throw a slide too. */
static uint32_t slide_rank(const struct gn_frame *frame, const struct gn_frame_light *light) {
    uint32_t before = 0;
    for (uint32_t i = 0; i < frame->light_count; i++)
        before += frame->lights[i].light < light->light &&
                  gn_slide_of(&frame->scene->lights[frame->lights[i].light]) != GN_SLIDE_NONE;
    return before;
}

void gn_frame_choose_slides(struct gn_frame *frame, const struct gn_frame_opts *opts,
                            struct gn_warnings *warnings) {
    for (uint32_t i = 0; i < frame->light_count; i++) {
        struct gn_frame_light *light = &frame->lights[i];
        const struct gn_light *l = &frame->scene->lights[light->light];
        light->slide = opts->debug.aov == GN_AOV_COLOR ? gn_slide_of(l) : GN_SLIDE_NONE;
        if (light->slide == GN_SLIDE_NONE || slide_rank(frame, light) < GN_SLIDES_MAX) continue;
        light->slide = GN_SLIDE_NONE;
        if (gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_SLIDES, warnings))
            gn_warn(warnings, "light '%s' has no slide: at most %d slides at once", l->name,
                    GN_SLIDES_MAX);
    }
}

/* In texels, as the GPU has it: too large a picture is halved until it fits. */
static float shown_px(const struct gn_frame *frame, uint32_t side_px,
                      const struct gn_image *image) {
    uint32_t largest = (uint32_t)frame->caps.max_texture_px;
    uint32_t longer = image->width_px > image->height_px ? image->width_px : image->height_px;
    for (; longer > largest && longer > 1; longer /= 2) side_px = side_px > 1 ? side_px / 2 : 1;
    return (float)side_px;
}

static void slide_slot(const struct gn_frame *frame, const struct gn_pose *pose, uint32_t light,
                       float (*c)[4]) {
    const struct gn_scene *scene = frame->scene;
    const struct gn_image *image =
        &scene->pictures.images[scene->pictures.textures[scene->lights[light].slide].image];
    struct gn_slide_view view;
    gn_slide_build(pose, light, &view);
    memcpy(c[SLIDE_U], view.u, sizeof view.u);
    memcpy(c[SLIDE_V], view.v, sizeof view.v);
    memcpy(c[SLIDE_W], view.w, sizeof view.w);
    c[SLIDE_PLACE][0] = shown_px(frame, image->width_px, image);
    c[SLIDE_PLACE][1] = shown_px(frame, image->height_px, image);
    c[SLIDE_PLACE][2] = view.near_m;
}

void gn_frame_slide_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_light_group *group, float (*constants)[4]) {
    float(*c)[4] = constants + PASS_SLIDES;
    for (uint32_t i = group->first; i < group->first + group->count; i++) {
        if (frame->lights[i].slide == GN_SLIDE_NONE) continue;
        slide_slot(frame, pose, frame->lights[i].light, c);
        c += SLIDE_SIZE;
    }
}
