/* Lookups and warnings that happen once: technique names are resolved at the first build, and a
 * warning is formatted again only when options it depends on change. Building a frame handles no
 * text. */
#include <string.h>

#include "core/hash.h"
#include "frame/private.h"
#include "shadow/planar.h"

void gn_frame_learn_scene(struct gn_frame *frame) {
    const struct gn_scene *scene = frame->scene;
    if (frame->notes.lights.count < scene->light_count) {
        frame->plane.exists = gn_planar_has_plane(scene);
        frame->plane.blended = false;
        /* A blended plane is not drawn yet when the stencil is marked. */
        for (uint32_t i = 0; i < scene->item_count; i++)
            frame->plane.blended |=
                scene->items[i].plane && scene->items[i].receives &&
                gn_material_is_blended(&scene->materials[scene->items[i].material]);
        frame->plane.count = 1;
        for (uint32_t i = 0; i < scene->item_count; i++)
            if (scene->items[i].plane > frame->plane.count)
                frame->plane.count = scene->items[i].plane;
    }
    for (uint32_t i = frame->notes.lights.count; i < scene->light_count; i++) {
        const char *name = scene->lights[i].technique;
        enum gn_technique technique = GN_TECHNIQUE_PCF;
        bool unknown = name && !gn_technique_find(name, strlen(name), &technique);
        GN_LIST_PUSH(&frame->notes.lights) = (struct gn_light_note){
            .technique = unknown ? GN_TECHNIQUE_PCF : technique, .unknown = unknown};
    }
}

void gn_frame_renew_notices(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    const struct gn_frame_shadow_opts *shadow = &opts->shadow;
    const uint64_t of_all = gn_hash(GN_HASH_INIT, &shadow->any, sizeof shadow->any);
    const uint32_t about[GN_NOTICE_ABOUT] = {
        opts->debug.aov,
        opts->output.floats,
        opts->output.linear,
        opts->output.msaa,
        opts->tone,
        opts->background,
        shadow->planar_in_stencil,
        (uint32_t)(shadow->maps_bytes >> 20),
        (uint32_t)gn_hash(of_all, shadow->lights, shadow->light_count * sizeof *shadow->lights)};
    if (memcmp(frame->notes.about, about, sizeof about) == 0) return;
    memcpy(frame->notes.about, about, sizeof about);
    frame->notes.said = 0;
    for (uint32_t i = 0; i < frame->notes.lights.count; i++) frame->notes.lights.at[i].said = 0;
}

bool gn_frame_notice(uint32_t *said, enum gn_notice notice, const struct gn_warnings *warnings) {
    if (!warnings || *said & 1u << notice) return false;
    *said |= 1u << notice;
    return true;
}
