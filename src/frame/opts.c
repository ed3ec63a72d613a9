/* What holds for a light: its own options, else those of all lights, else what the scene has. */
#include <math.h>
#include <string.h>

#include "core/srgb.h"
#include "frame/private.h"

const struct gn_light_opts *gn_frame_own_opts(const struct gn_frame_opts *opts, uint32_t light) {
    static const struct gn_light_opts nothing;
    for (uint32_t i = 0; i < opts->shadow.light_count; i++)
        if (opts->shadow.lights[i].light == light) return &opts->shadow.lights[i];
    return &nothing;
}

static void lay_over(struct gn_light_opts *holds, const struct gn_light_opts *over) {
    for (size_t word = 0; word < sizeof *over / 4; word++)
        if (over->given >> word & 1)
            memcpy((char *)holds + 4 * word, (const char *)over + 4 * word, 4);
    holds->given |= over->given;
}

static float strongest_of(const float color[3]) {
    return fmaxf(color[0], fmaxf(color[1], color[2]));
}

/* A hue keeps the intensity: how bright it is itself does not count. */
static void set_hue(float color[3], int srgb, const struct gn_light *light) {
    const float intensity = strongest_of(color);
    float hue[3];
    memcpy(hue, light->color, sizeof hue);
    for (int k = 0; k < 3 && srgb >= 0; k++)
        hue[k] = gn_srgb_decode((float)(srgb >> (16 - 8 * k) & 0xff) / 255);
    const float most = strongest_of(hue);
    for (int k = 0; k < 3; k++) color[k] = intensity * (most > 0 ? hue[k] / most : 1);
}

static void set_intensity(float color[3], float intensity, const struct gn_light *light) {
    const float now = strongest_of(color),
                to = intensity < 0 ? strongest_of(light->color) : intensity;
    for (int k = 0; k < 3; k++) color[k] = now > 0 ? color[k] * (to / now) : to;
}

/* A colour that is set does not follow an animation of the scene's. */
enum { COLOR_GIVEN = GN_LIGHT_GIVEN(color) | GN_LIGHT_GIVEN(hue) | GN_LIGHT_GIVEN(intensity) };

struct gn_light_opts gn_frame_light_opts(const struct gn_frame *frame, const struct gn_pose *pose,
                                         const struct gn_frame_opts *opts, uint32_t light) {
    const struct gn_light *l = &frame->scene->lights[light];
    const struct gn_light_opts *own = gn_frame_own_opts(opts, light);
    /* that the scene names, else pcf: gn_frame_learn_scene() */
    const enum gn_technique technique = frame->notes.lights.at[light].technique;
    const bool colored = (opts->shadow.any.given | own->given) & COLOR_GIVEN;
    struct gn_light_opts holds = {
        .light = light,
        .technique = technique,
        .map_format = GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE),
        .map_px = l->map_px,
        .strength = l->shadow_strength,
        .specular = l->shadow_specular,
        .slide_far_m = l->slide_far_m,
        .radius = l->radius,
        .on = true,
    };
    memcpy(holds.color, colored ? l->color : pose->lights[light].color, sizeof holds.color);
    lay_over(&holds, &opts->shadow.any);
    /* a light that casts no shadow in the scene casts none, whatever holds for all */
    if (technique == GN_TECHNIQUE_NONE) holds.technique = technique;
    lay_over(&holds, own);
    if (GN_LIGHT_HAS(&holds, hue)) set_hue(holds.color, holds.hue, l);
    if (GN_LIGHT_HAS(&holds, intensity)) set_intensity(holds.color, holds.intensity, l);
    if (holds.specular < 0.0f) holds.specular = 1.0f - holds.strength;
    if (holds.slide_far_m < 0.0f) holds.slide_far_m = l->slide_far_m;
    return holds;
}
