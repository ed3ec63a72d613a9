#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "core/srgb.h"
#include "frame/private.h"

float gn_frame_illuminance(const struct gn_pose *pose, uint32_t index, const float color[3]) {
    const struct gn_light *light = &pose->scene->lights[index];
    if (!gn_light_types[light->type].has_position) return gn_luminance(color);
    vec3 place, direction, centre;
    gn_pose_light(pose, index, place, direction);
    glm_vec3_center((float *)pose->box_ws.min, (float *)pose->box_ws.max, centre);
    const float d2 = glm_vec3_distance2(place, centre), /* a lamp in the middle is not at 0 */
        size2 = glm_vec3_distance2((float *)pose->box_ws.min, (float *)pose->box_ws.max);
    return gn_luminance(color) / fmaxf(d2, fmaxf(1e-4f * fminf(size2, 1.0f), 1e-18f));
}

float gn_frame_exposure(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_frame_opts *opts) {
    if (opts->exposure_given) return exp2f(opts->exposure_ev);
    if (frame->auto_exposure.known) return frame->auto_exposure.value;
    float sum = 0.0f, strongest = 0.0f;
    for (uint32_t i = 0; i < frame->scene->light_count; i++) {
        float lux = gn_frame_illuminance(pose, i, frame->scene->lights[i].color);
        sum += lux;
        strongest = fmaxf(strongest, lux);
    }
    frame->auto_exposure.known = true;
    frame->auto_exposure.value = 1.0f;
    if (strongest > 0.0f && isfinite(strongest) && (sum < 0.3f || sum > 30.0f))
        /* keeps the factor a normal float */
        frame->auto_exposure.value =
            exp2f(glm_clamp(roundf(log2f(0.8f * GLM_PIf / strongest)), -126.0f, 126.0f));
    return frame->auto_exposure.value;
}

/* Whether this GPU has what the technique's maps are stored in. */
static bool has_formats(const struct gn_frame *frame, enum gn_technique technique) {
    const struct gn_technique_row *row = &gn_techniques[technique];
    bool fell_back;
    if (row->reads_both && !(gn_caps_encodings(&frame->caps) >> GN_ENCODING_DEPTH & 1))
        return false;
    return !gn_technique_filters_map(technique) ||
           gn_moments_choose(row->stores, GN_MOMENTS_NONE, gn_caps_moments(&frame->caps),
                             &fell_back) != GN_MOMENTS_NONE;
}

static enum gn_technique technique_of(struct gn_frame *frame, const struct gn_frame_light *chosen,
                                      const struct gn_frame_opts *opts,
                                      struct gn_warnings *warnings) {
    const bool has_own = GN_LIGHT_HAS(gn_frame_own_opts(opts, chosen->light), technique);
    const enum gn_technique technique = chosen->opts.technique;
    const struct gn_light *light = &frame->scene->lights[chosen->light];
    struct gn_light_note *note = &frame->notes.lights.at[chosen->light];
    if (note->unknown && !has_own && gn_frame_notice(&note->said, GN_NOTICE_TECHNIQUE, warnings))
        gn_warn(warnings, "light '%s': gnomon_shadow '%s' is not a known technique; using %s",
                light->name, light->technique, gn_techniques[technique].name);
    if (!has_formats(frame, technique)) {
        const enum gn_technique instead = gn_techniques[technique].fallback
                                              ? (enum gn_technique)gn_techniques[technique].fallback
                                              : GN_TECHNIQUE_PCF;
        if (gn_frame_notice(&note->said, GN_NOTICE_MOMENTS, warnings))
            gn_warn(warnings,
                    "light '%s' falls back to %s: this GPU has no renderable format for %s",
                    light->name, gn_techniques[instead].name, gn_techniques[technique].name);
        return instead;
    }
    if (!gn_techniques[technique].on_plane || frame->plane.exists) return technique;
    if (gn_frame_notice(&note->said, GN_NOTICE_PLANE, warnings))
        gn_warn(
            warnings,
            "light '%s' casts no shadow: %s needs a plane; mark one in the scene with gnomon_plane",
            light->name, gn_techniques[technique].name);
    return GN_TECHNIQUE_NONE;
}

static void choose_encoding(struct gn_frame *frame, const struct gn_frame_opts *opts,
                            struct gn_frame_light *light, struct gn_warnings *warnings) {
    const enum gn_encoding encoding = GN_MAP_FORMAT_ENCODING(light->opts.map_format);
    const enum gn_moments moments = GN_MAP_FORMAT_MOMENTS(light->opts.map_format);
    const struct gn_technique_row *technique = &gn_techniques[light->technique];
    uint32_t *said = &frame->notes.lights.at[light->light].said;
    bool fell_back, moments_fell_back = false;
    light->encoding =
        gn_encoding_choose(light->technique, encoding, gn_caps_encodings(&frame->caps), &fell_back);

    /* A format can be requested for the moments of a filtered map, or for an unfiltered map, not
     * for both; of a technique that reads both (cone) for either. */
    const bool filters_map = gn_technique_filters_map(light->technique);
    if (filters_map)
        light->moments = gn_moments_choose(technique->stores, moments,
                                           gn_caps_moments(&frame->caps), &moments_fell_back);
    const bool wants_map = encoding != GN_ENCODING_AUTO, wants_moments = moments;
    const bool has_map = wants_map && light->encoding == encoding; /* it reads map and moments */
    if ((filters_map ? moments_fell_back || (wants_map && !has_map) : wants_moments) &&
        gn_frame_notice(said, GN_NOTICE_ENCODING, warnings))
        gn_warn(warnings, "%s does not support map format %s%s; using %s", technique->name,
                wants_map ? gn_encodings[encoding].name : gn_moments[moments].name,
                moments_fell_back ? " on this GPU" : "",
                filters_map ? gn_moments[light->moments].name : gn_encodings[light->encoding].name);
    if (fell_back && gn_frame_notice(said, GN_NOTICE_ENCODING, warnings))
        gn_warn(warnings, "this GPU cannot render to map format %s; using %s",
                gn_encodings[encoding].name, gn_encodings[light->encoding].name);
    if (light->encoding != GN_ENCODING_MASK) return;
    if (!opts->shadow.planar_in_stencil) {
        if (opts->shadow.planar_points && light->opts.radius > 0.0f)
            light->encoding = GN_ENCODING_MEAN;
        return;
    }
    if (!frame->plane.blended)
        light->encoding = GN_ENCODING_STENCIL;
    else if (gn_frame_notice(&frame->notes.said, GN_NOTICE_BLENDED, warnings))
        gn_warn(warnings,
                "the plane is transparent: its shadows use a mask instead of the stencil");
}

static bool casts_shadow(const struct gn_frame_light *light) {
    return light->technique != GN_TECHNIQUE_NONE;
}

/* Of equal lights the last; there is at least one light. */
static uint32_t find_weakest(const struct gn_frame *frame, bool casting) {
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < frame->light_count; i++) {
        if (casting && !casts_shadow(&frame->lights[i])) continue;
        if (found == UINT32_MAX || frame->lights[i].illuminance <= frame->lights[found].illuminance)
            found = i;
    }
    return found;
}

/* Lights are added in linear space: a picture that the shaders encode, without a linear copy, has
 * the lights of one pass. */
static bool can_add_light(const struct gn_frame *frame) {
    return !frame->plan.encode_srgb || frame->caps.has & 1u << GN_CAP_RGBA16F;
}

static void warn_of_limit(struct gn_frame *frame, uint32_t light, enum gn_notice notice,
                          uint32_t most, struct gn_warnings *warnings) {
    if (!gn_frame_notice(&frame->notes.lights.at[light].said, notice, warnings)) return;
    gn_warn(warnings, "light '%s' %s: at most %u %slights at once%s",
            frame->scene->lights[light].name,
            notice == GN_NOTICE_MAPS ? "casts no shadow" : "is left out", most,
            notice == GN_NOTICE_MAPS ? "shadowed " : "",
            can_add_light(frame) ? "" : " on a GPU without srgb and rgba16f targets");
}

/* How often the items are drawn for a light at most: once per tile, or per cascade. */
static uint32_t count_views(const struct gn_frame *frame, const struct gn_frame_light *light) {
    const enum gn_light_type type = frame->scene->lights[light->light].type;
    if (gn_techniques[light->technique].on_screen) return 0;
    if (!gn_light_types[type].has_position && !gn_techniques[light->technique].on_plane)
        return GN_CASCADES_MAX;
    return gn_shadow_tile_count(type, light->technique);
}

/* What an item costs beside its triangles: it is placed, culled and sorted for each map. */
enum { ITEM_TRIANGLES = 100 };

/* The weakest lights cast no shadow where the triangles of all maps exceed the limit: a few hundred
 * bytes can ask for sixteen lights and a million instances. */
static void bound_triangles(struct gn_frame *frame, const struct gn_frame_opts *opts,
                            struct gn_warnings *warnings) {
    const struct gn_scene *scene = frame->scene;
    const uint64_t items = (uint64_t)scene->item_count * ITEM_TRIANGLES,
                   each = scene->triangle_count > items ? scene->triangle_count : items;
    uint64_t views = 1; /* the picture */
    if (opts->shadow.triangles == 0) return;
    for (uint32_t i = 0; i < frame->light_count; i++)
        if (casts_shadow(&frame->lights[i])) views += count_views(frame, &frame->lights[i]);
    while (views > 1 && each > opts->shadow.triangles / views) {
        struct gn_frame_light *light = &frame->lights[find_weakest(frame, true)];
        if (gn_frame_notice(&frame->notes.lights.at[light->light].said, GN_NOTICE_TRIANGLES,
                            warnings))
            gn_warn(warnings,
                    "light '%s' casts no shadow: its maps are over the limit "
                    "triangles_per_frame=%llu",
                    scene->lights[light->light].name, (unsigned long long)opts->shadow.triangles);
        views -= count_views(frame, light);
        light->technique = GN_TECHNIQUE_NONE;
    }
}

static bool has_planar_light(const struct gn_frame *frame) {
    for (uint32_t i = 0; i < frame->light_count; i++)
        if (gn_techniques[frame->lights[i].technique].on_plane) return true;
    return false;
}

void gn_frame_choose_lights(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts, struct gn_warnings *warnings) {
    bool visibility = opts->debug.aov == GN_AOV_VISIBILITY;
    const uint32_t most = can_add_light(frame) ? GN_ALL_LIGHTS_MAX : GN_LIGHTS_MAX,
                   most_maps = can_add_light(frame) ? GN_ALL_SHADOWS_MAX : GN_SHADOWS_MAX;
    frame->light_count = 0;
    for (uint32_t i = 0; i < frame->scene->light_count; i++) {
        if (visibility ? (int)i != opts->debug.light : opts->debug.aov != GN_AOV_COLOR) continue;
        struct gn_frame_light l = {.light = i, .opts = gn_frame_light_opts(frame, pose, opts, i)};
        if (!l.opts.on) continue;
        l.technique = technique_of(frame, &l, opts, warnings);
        l.illuminance = gn_frame_illuminance(pose, i, l.opts.color);
        if (casts_shadow(&l)) choose_encoding(frame, opts, &l, warnings);
        if (frame->light_count == most) { /* full: replaces the weakest, or is that itself */
            const uint32_t least = find_weakest(frame, false);
            struct gn_frame_light *at = &frame->lights[least];
            const bool stays = at->illuminance >= l.illuminance;
            warn_of_limit(frame, stays ? i : at->light, GN_NOTICE_LIGHTS, most, warnings);
            if (stays) continue;
            memmove(at, at + 1, (--frame->light_count - least) * sizeof *at);
        }
        frame->lights[frame->light_count++] = l;
    }
    uint32_t maps = 0;
    for (uint32_t i = 0; i < frame->light_count; i++) maps += casts_shadow(&frame->lights[i]);
    for (; maps > most_maps; maps--) {
        struct gn_frame_light *light = &frame->lights[find_weakest(frame, true)];
        warn_of_limit(frame, light->light, GN_NOTICE_MAPS, most_maps, warnings);
        light->technique = GN_TECHNIQUE_NONE;
    }
    bound_triangles(frame, opts, warnings);
    frame->shadow_specular = false;
    for (uint32_t i = 0; i < frame->light_count; i++)
        frame->shadow_specular |=
            casts_shadow(&frame->lights[i]) &&
            frame->lights[i].opts.specular != 1.0f - frame->lights[i].opts.strength;
    /* those that cast shadows first, else in the scene's order; gn_frame_group_lights() then orders
     * them within their groups, planar ones as the last of those that cast shadows */
    struct gn_frame_light open[GN_ALL_LIGHTS_MAX];
    uint32_t open_count = 0;
    frame->shadow_count = 0;
    for (uint32_t i = 0; i < frame->light_count; i++)
        if (casts_shadow(&frame->lights[i]))
            frame->lights[frame->shadow_count++] = frame->lights[i];
        else
            open[open_count++] = frame->lights[i];
    memcpy(&frame->lights[frame->shadow_count], open, open_count * sizeof *open);
    for (uint32_t i = 0; i < frame->shadow_count; i++) /* visible or not */
        frame->plan.stencil |= frame->lights[i].encoding == GN_ENCODING_STENCIL;
    gn_frame_choose_slides(frame, opts, warnings);
    gn_frame_group_lights(frame, pose);
    gn_frame_add_plane_slots(frame);
    gn_frame_take_floor(frame, pose, opts);
    if (frame->plane.shown < frame->plane.count && frame->scene->planes_named &&
        has_planar_light(frame) && gn_frame_notice(&frame->notes.said, GN_NOTICE_PLANES, warnings))
        gn_warn(warnings, "planar shadows are on %u of %u planes: %s", frame->plane.shown,
                frame->plane.count,
                frame->plan.stencil ? "the stencil has one" : "there are too many lights for more");
}
