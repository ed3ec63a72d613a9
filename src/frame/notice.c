/* Lookups and warnings that happen once: technique names are resolved at the first build, and a
 * warning is formatted again only when options it depends on change. Building a frame handles no
 * text. */
#include <string.h>

#include "frame/private.h"
#include "shadow/planar.h"

static struct gn_light_note note_of(const struct gn_light *light) {
    enum gn_technique technique = GN_TECHNIQUE_PCF;
    bool unknown = light->technique && !gn_technique_find(light->technique, &technique, NULL);
    return (struct gn_light_note){.technique = unknown ? GN_TECHNIQUE_PCF : technique,
                                  .unknown = unknown};
}

/* A plane that is blended is not there when marks are made. */
static bool plane_is_blended(const struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane && scene->items[i].receives &&
            scene->materials[scene->items[i].material].alpha == GN_ALPHA_BLEND)
            return true;
    return false;
}

void gn_frame_take_note(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    if (frame->notes.lights.count < frame->scene->light_count) {
        frame->plane.exists = gn_planar_has_plane(frame->scene);
        frame->plane.blended = plane_is_blended(frame->scene);
    }
    for (uint32_t i = frame->notes.lights.count; i < frame->scene->light_count; i++)
        GN_LIST_PUSH(&frame->notes.lights) = note_of(&frame->scene->lights[i]);
    const uint32_t about[GN_NOTICE_ABOUT] = {opts->shadow.technique_given,
                                             opts->shadow.technique,
                                             opts->shadow.encoding,
                                             opts->debug.aov,
                                             opts->output_float,
                                             opts->output_linear,
                                             opts->msaa,
                                             opts->shadow.planar_in_stencil,
                                             opts->shadow.moments,
                                             opts->shadow.map_px};
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
