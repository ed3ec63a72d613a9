/* The view of each light that has shadows: how large its map is, how many cascades it has. */
#include "frame/private.h"
#include "shadow/cascade.h"

/* The side that a light's map, or each of its tiles, is asked to have; 0: it has none. */
static uint32_t asked_px(const struct gn_frame *frame, const struct gn_frame_light *light,
                         const struct gn_frame_opts *opts) {
    const uint32_t own_px = gn_techniques[light->technique].map_px;
    const uint32_t of_light_px = frame->scene->lights[light->light].map_px;
    if (light->encoding == GN_ENCODING_STENCIL) return 0;
    return opts->shadow.map_px ? opts->shadow.map_px
           : of_light_px       ? of_light_px
           : own_px            ? own_px
                               : 1024;
}

static void say_smaller(struct gn_frame *frame, const struct gn_frame_light *light, uint32_t asked,
                        uint32_t map_px, struct gn_warnings *warnings) {
    if (map_px >= asked ||
        !gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_MAP_PX, warnings))
        return;
    gn_warn(warnings,
            "light '%s': map tiles of %u px exceed the texture size of this GPU; using %u px",
            frame->scene->lights[light->light].name, asked, map_px);
}

void gn_frame_fit_shadows(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts, struct gn_warnings *warnings) {
    for (uint32_t i = 0; i < frame->shadow_count; i++) {
        struct gn_frame_light *light = gn_frame_light_of_slot(frame, i);
        const uint32_t asked = asked_px(frame, light, opts),
                       most = gn_frame_most_px(frame, light, 1);
        const struct gn_light *l = &frame->scene->lights[light->light];
        struct gn_shadow_opts shadow = {.technique = light->technique,
                                        .encoding = light->encoding,
                                        .moments = light->moments,
                                        .map_px = asked < most ? asked : most,
                                        .all_receive = opts->debug.aov == GN_AOV_VISIBILITY,
                                        .cascades = opts->shadow.cascades ? opts->shadow.cascades
                                                                          : GN_CASCADES_MAX};
        gn_frame_make_memories(frame, i, gn_shadow_tile_count(l->type, light->technique));
        light->cascades = shadow.cascades = gn_frame_choose_cascades(frame, pose, opts, i, &shadow);
        if (shadow.cascades > 1) gn_frame_make_memories(frame, i, GN_CASCADE_MEMORIES);
        const uint32_t most_each = gn_frame_most_px(frame, light, shadow.cascades);
        if (shadow.map_px > most_each) shadow.map_px = most_each;
        say_smaller(frame, light, asked, shadow.map_px, warnings);
        /* An empty one keeps its slot: programs do not change with what is in view. */
        gn_shadow_fit(pose, light->light, &frame->eye, &shadow, frame->memory[i],
                      &frame->shadows[i]);
    }
}
