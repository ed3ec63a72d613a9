#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

/* beside maps the environment, or with one texture less (gn_item_is_occluded) occlusion, too */
_Static_assert(GN_MATERIAL_TEXTURES_MAX + 2 * GN_SHADOWS_MAX + 1 <= GN_SAMPLERS_MAX, "samplers");

void gn_frame_choose_slides(struct gn_frame *frame, const struct gn_frame_opts *opts,
                            struct gn_warnings *warnings) {
    uint32_t both = 0; /* lights with two samplers for their shadow: those of a pass at most */
    for (uint32_t i = 0; i < frame->light_count; i++)
        both += gn_techniques[frame->lights[i].technique].reads_both;
    if (both > GN_SHADOWS_MAX) both = GN_SHADOWS_MAX;
    const uint32_t ambient =
        (frame->plan.environment.light ? 1 : 0) +
        (frame->plan.occlusion.on && frame->scene->material_textures < GN_MATERIAL_TEXTURES_MAX);
    const uint32_t left = GN_SAMPLERS_MAX - frame->scene->material_textures - GN_SHADOWS_MAX -
                          both - ambient,
                   most = left < GN_SLIDES_MAX ? left : GN_SLIDES_MAX;
    for (uint32_t i = 0; i < frame->light_count; i++) {
        struct gn_frame_light *light = &frame->lights[i];
        const struct gn_light *l = &frame->scene->lights[light->light];
        light->slide = opts->debug.aov == GN_AOV_COLOR ? gn_slide_of(l) : GN_SLIDE_NONE;
        if (light->slide == GN_SLIDE_NONE) continue;
        uint32_t before = 0; /* lights with a slide, in the scene's order */
        for (uint32_t k = 0; k < frame->light_count; k++)
            before += frame->lights[k].light < light->light &&
                      gn_slide_of(&frame->scene->lights[frame->lights[k].light]) != GN_SLIDE_NONE;
        if (before < most) continue;
        light->slide = GN_SLIDE_NONE;
        if (gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_SLIDES, warnings))
            gn_warn(warnings, "light '%s' has no slide: at most %u slides at once", l->name, most);
    }
}

/* A side in texels on the GPU, where too large a picture is halved until it fits. */
static float shown_px(const struct gn_frame *frame, uint32_t side_px,
                      const struct gn_image *image) {
    uint32_t largest = (uint32_t)frame->caps.max_texture_px;
    uint32_t longer = image->width_px > image->height_px ? image->width_px : image->height_px;
    for (; longer > largest && longer > 1; longer /= 2) side_px = side_px > 1 ? side_px / 2 : 1;
    return (float)side_px;
}

void gn_frame_slide_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_light_group *group, float (*constants)[4]) {
    const struct gn_scene *scene = frame->scene;
    float(*c)[4] = constants + PASS_SLIDES;
    for (uint32_t i = group->first; i < group->first + group->count; i++) {
        if (frame->lights[i].slide == GN_SLIDE_NONE) continue;
        const uint32_t light = frame->lights[i].light;
        const struct gn_image *image =
            &scene->pictures.images[scene->pictures.textures[scene->lights[light].slide].image];
        struct gn_slide_view view;
        const float aspect = (float)image->width_px / (float)image->height_px;
        gn_slide_build(pose, light, frame->lights[i].opts.slide_as_picture ? aspect : 0.0f, &view);
        memcpy(c[SLIDE_U], view.u, sizeof view.u);
        memcpy(c[SLIDE_V], view.v, sizeof view.v);
        memcpy(c[SLIDE_W], view.w, sizeof view.w);
        c[SLIDE_PLACE][0] = shown_px(frame, image->width_px, image);
        c[SLIDE_PLACE][1] = shown_px(frame, image->height_px, image);
        c[SLIDE_PLACE][2] = view.near_m;
        c[SLIDE_PLACE][3] = frame->lights[i].opts.slide_far_m;
        c += SLIDE_SIZE;
    }
}
