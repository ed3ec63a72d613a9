#include <string.h>

#include "frame/private.h"

/* With its padding: keys are compared as bytes. */
struct gn_program_key gn_key_of(enum gn_program_kind kind) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = (uint8_t)kind;
    return key;
}

static uint64_t texture_bit(int slot) { return UINT64_C(1) << (GN_FEATURE_FIRST_TEXTURE + slot); }
static uint64_t uv1_bit(int slot) { return UINT64_C(1) << (GN_FEATURE_FIRST_UV1 + slot); }

/* The bits of a slot's texture, if the material has one. */
uint64_t gn_key_texture(const struct gn_material *material, enum gn_texture_slot slot) {
    const struct gn_texture_ref *ref = &material->textures[slot];
    if (ref->texture < 0) return 0;
    return texture_bit(slot) | (ref->uv_set ? uv1_bit(slot) : 0);
}

/* What has no part in a program that only adds or transmits light. */
static uint64_t ambient_features(void) {
    uint64_t features = GN_FEATURE(HEMISPHERE) | GN_FEATURE(EMISSIVE) | GN_FEATURE(ENVIRONMENT) |
                        GN_FEATURE(ENVIRONMENT_DIFFUSE) | GN_FEATURE(ENVIRONMENT_SCALED) |
                        GN_FEATURE(ENVIRONMENT_TURNED) | GN_FEATURE(OCCLUDED);
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
        if (gn_texture_slots[slot].shading == GN_SHADING_EMISSION ||
            gn_texture_slots[slot].shading == GN_SHADING_AMBIENT)
            features |= texture_bit(slot) | uv1_bit(slot);
    return features;
}

/* How its vertices are posed. */
static uint64_t deformation_features(const struct gn_scene *scene, const struct gn_item *item) {
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    const bool eight = gn_geometry_has(geometry, GN_ATTRIBUTE_JOINTS1);
    uint64_t features = item->morph >= 0 ? GN_FEATURE(MORPH) : 0;
    if (item->skin >= 0) features |= eight ? GN_FEATURE(SKIN_8) : GN_FEATURE(SKIN);
    return features;
}

/* The features that the alpha of a masked or blended item depends on. */
static uint64_t cut_features(const struct gn_scene *scene, const struct gn_item *item) {
    const struct gn_material *m = &scene->materials[item->material];
    uint64_t features = GN_FEATURE(ALPHA_MASK) | gn_key_texture(m, GN_TEXTURE_BASE);
    if (gn_geometry_has(&scene->geometries[item->geometry], GN_ATTRIBUTE_COLOR))
        features |= GN_FEATURE(VERTEX_COLOR);
    return features;
}

/* The same; 0 unless it is masked. */
static uint64_t alpha_features(const struct gn_scene *scene, const struct gn_item *item) {
    const bool masked = scene->materials[item->material].alpha == GN_ALPHA_MASK;
    return masked ? cut_features(scene, item) : 0;
}

static uint64_t occlusion_features(const struct gn_frame *frame, const struct gn_item *item) {
    return frame->plan.occlusion.on && gn_item_is_occluded(frame->scene, item)
               ? GN_FEATURE(OCCLUDED)
               : 0;
}

/* Bits of the environment, of a lit item. */
static uint64_t environment_features(const struct gn_frame *frame, const struct gn_item *item) {
    const struct gn_material *m = &frame->scene->materials[item->material];
    uint64_t features = 0;
    if (!frame->plan.environment.light) return 0;
    /* a light map stands for all diffuse light that is not of a light */
    if (!frame->environment.reflected_only && m->textures[GN_TEXTURE_LIGHTMAP].texture < 0)
        features |= GN_FEATURE(ENVIRONMENT_DIFFUSE);
    if (frame->environment.reflected_only ? gn_material_needs_reflections(m)
                                          : gn_material_is_specular(m))
        features |= GN_FEATURE(ENVIRONMENT);
    if (!features) return 0;
    if (features & GN_FEATURE(ENVIRONMENT_DIFFUSE)) features |= occlusion_features(frame, item);
    if (frame->environment.scaled) features |= GN_FEATURE(ENVIRONMENT_SCALED);
    if (frame->environment.turned) features |= GN_FEATURE(ENVIRONMENT_TURNED);
    if (frame->environment.shows_key && features & GN_FEATURE(ENVIRONMENT))
        features |= GN_FEATURE(ENVIRONMENT_KEY);
    return features;
}

bool gn_key_is_floor(const struct gn_frame *frame, uint32_t item) {
    return frame->floor.is_apart && item == frame->floor.item;
}

bool gn_key_is_tinted(const struct gn_scene *scene, const struct gn_item *item) {
    const struct gn_material *m = &scene->materials[item->material];
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    return gn_material_is_tinted(m) ||
           (gn_material_is_transmissive(m) && (gn_geometry_has(geometry, GN_ATTRIBUTE_COLOR) ||
                                               (m->double_sided && geometry->watertight)));
}

static uint64_t color_features(const struct gn_frame *frame, const struct gn_item *item) {
    const struct gn_scene *scene = frame->scene;
    const struct gn_material *m = &scene->materials[item->material];
    uint64_t features = alpha_features(scene, item);
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
        if (gn_material_reads(m, slot) &&
            (slot != GN_TEXTURE_NORMAL || gn_geometry_has(geometry, GN_ATTRIBUTE_TANGENT)))
            features |= gn_key_texture(m, slot);
    const uint64_t attributes = geometry->attributes >> GN_PLAIN_ATTRIBUTE_COUNT;
    features |= attributes << GN_FEATURE_FIRST_ATTRIBUTE;
    if (m->alpha == GN_ALPHA_BLEND) features |= GN_FEATURE(ALPHA_BLEND);
#define GN_X(NAME, ...)                                                                            \
    if (gn_material_has(m, GN_LAYER_##NAME)) features |= GN_FEATURE(NAME);
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
    if (gn_key_is_tinted(scene, item)) features |= GN_FEATURE(TINTED);
    if (!frame->plan.tones_sum) features |= gn_frame_tone_feature(frame);
    if (frame->plan.output == GN_OUTPUT_LINEAR8 && frame->plan.encode_srgb)
        features |= GN_FEATURE(ENCODE_SRGB);
    if (frame->caps.software && !m->unlit) features |= GN_FEATURE(FLAT_CONSTANTS);
    if (m->unlit) return features | GN_FEATURE(UNLIT);
    if (m->shadow_catcher) features |= GN_FEATURE(CATCHER);
    if (m->double_sided) features |= GN_FEATURE(DOUBLE_SIDED);
    if (gn_material_is_specular(m)) {
        features |= GN_FEATURE(SPECULAR);
        if (gn_material_has_f0(m)) features |= GN_FEATURE(REFLECTANCE);
        if (frame->shadow_specular) features |= GN_FEATURE(SHADOW_SPECULAR);
    }
    if (gn_material_is_metal(m)) features |= GN_FEATURE(METAL);
    if (gn_material_is_emissive(m)) features |= GN_FEATURE(EMISSIVE);
    features |= environment_features(frame, item);
    if (memcmp(scene->environment.sky, scene->environment.ground, sizeof(vec3)) != 0 &&
        !(features & GN_FEATURE(ENVIRONMENT_DIFFUSE)))
        features |= GN_FEATURE(HEMISPHERE);
    return features;
}

static enum gn_receiver receiver_of(const struct gn_frame *frame, const struct gn_item *item,
                                    enum gn_aov aov) {
    if (!item->receives && aov != GN_AOV_VISIBILITY) return GN_RECEIVES_NOTHING;
    /* What is blended is drawn with what else is: on the first plane. */
    const bool blended = gn_material_is_blended(&frame->scene->materials[item->material]);
    if (item->plane > (blended ? 1 : frame->plane.shown)) return GN_RECEIVES_MAPS;
    for (uint32_t i = 0; item->plane && i < frame->light_count; i++)
        if (gn_techniques[frame->lights[i].technique].on_plane) return GN_RECEIVES_ALL;
    return GN_RECEIVES_MAPS;
}

bool gn_key_on_plane(const struct gn_frame *frame, uint32_t item,
                     const struct gn_frame_opts *opts) {
    return receiver_of(frame, &frame->scene->items[item], opts->debug.aov) == GN_RECEIVES_ALL;
}

uint32_t gn_key_further_plane(const struct gn_frame *frame, uint32_t item,
                              const struct gn_frame_opts *opts) {
    const uint32_t plane = frame->scene->items[item].plane;
    return plane > 1 && gn_key_on_plane(frame, item, opts) ? plane : 0;
}

/* The lights of a group, and what their techniques need. */
static void set_lights(const struct gn_frame *frame, const struct gn_light_group *group,
                       const struct gn_frame_opts *opts, enum gn_receiver receiver,
                       struct gn_program_key *key) {
    key->light_count = (uint8_t)group->count;
    /* How many of the lights with maps the item's shadows come from: planar ones are last
     * (group.c). */
    uint32_t shadows = receiver == GN_RECEIVES_NOTHING ? 0 : group->shadow_count;
    while (receiver == GN_RECEIVES_MAPS && shadows > 0 &&
           gn_techniques[frame->lights[group->first + shadows - 1].technique].on_plane)
        shadows--;
    key->shadow_count = (uint8_t)shadows;
    for (uint32_t i = 0; i < group->count; i++) {
        const struct gn_frame_light *light = &frame->lights[group->first + i];
        key->lights[i].type = (uint8_t)frame->scene->lights[light->light].type;
        key->lights[i].slide = (uint8_t)light->slide;
        key->lights[i].slide_ends = light->slide != GN_SLIDE_NONE && light->opts.slide_far_m > 0.0f;
        key->lights[i].ranged = gn_light_types[key->lights[i].type].has_position &&
                                (frame->scene->lights[light->light].range_m > 0.0f ||
                                 frame->scene->lights[light->light].range_moves);
        if (i >= key->shadow_count) continue;
        key->lights[i].technique = (uint8_t)light->technique;
        key->lights[i].encoding = (uint8_t)gn_encoding_of_programs(light->encoding);
        key->lights[i].moments = (uint8_t)gn_moments_of_programs(light->moments);
        key->lights[i].cascades = light->cascades > 1;
        key->lights[i].radius_set = gn_techniques[light->technique].filter_radius_px > 0.0f &&
                                    light->opts.filter_radius_px > 0.0f;
        key->lights[i].taps =
            (uint8_t)gn_taps_count(gn_techniques[light->technique].taps, (int)light->opts.taps);
        if (key->lights[i].taps) key->taps_turn = !opts->shadow.taps_fixed;
    }
}

struct gn_program_key gn_key_lit(const struct gn_frame *frame, uint32_t index,
                                 const struct gn_frame_opts *opts) {
    const struct gn_item *item = &frame->scene->items[index];
    const struct gn_material *m = &frame->scene->materials[item->material];
    struct gn_program_key key =
        gn_key_of(opts->debug.aov == GN_AOV_COLOR ? GN_PROGRAM_LIT : GN_PROGRAM_AOV);
    key.aov = (uint8_t)opts->debug.aov;
    key.features = opts->debug.aov == GN_AOV_COLOR ? color_features(frame, item)
                                                   : alpha_features(frame->scene, item);
    key.features |= deformation_features(frame->scene, item);
    if (opts->debug.aov != GN_AOV_COLOR && m->double_sided)
        key.features |= GN_FEATURE(DOUBLE_SIDED);
    if (opts->debug.aov != GN_AOV_COLOR && frame->plan.gathers)
        key.features |= GN_FEATURE(TRANSPARENT);
    if (opts->debug.aov == GN_AOV_OCCLUSION) key.features |= occlusion_features(frame, item);
    if (opts->debug.aov == GN_AOV_COLOR ? m->unlit : opts->debug.aov != GN_AOV_VISIBILITY)
        return key;
    if (opts->debug.aov == GN_AOV_VISIBILITY && opts->debug.faced)
        key.features |= GN_FEATURE(FACED);
    enum gn_receiver receiver = receiver_of(frame, item, opts->debug.aov);
    set_lights(frame, &frame->groups[0], opts, receiver, &key);
    if (gn_key_is_floor(frame, index)) { /* its visibility */
        struct gn_program_light *light = &key.lights[0];
        const uint8_t type = light->type;
        memset(light, 0, sizeof *light);
        light->type = type;
        light->technique = GN_TECHNIQUE_PLANAR;
        light->encoding = GN_ENCODING_MEAN;
        key.taps_turn = false;
    }
    if (frame->group_count > 1) key.receiver = (uint8_t)receiver;
    return key;
}

void gn_key_take_part(bool rest, struct gn_program_key *key) {
    if (!(key->features & (GN_FEATURE(ALPHA_BLEND) | GN_FEATURE(TRANSMISSION)))) return;
    if (rest)
        key->features |= GN_FEATURE(BLENDED_REST);
    else if (key->features & GN_FEATURE(TRANSMISSION)) {
        key->features &= ~(GN_FEATURE(TRANSMISSION) | GN_FEATURE(TINTED));
        key->features |= GN_FEATURE(ALPHA_MASK);
    } else
        key->features ^= GN_FEATURE(ALPHA_BLEND) | GN_FEATURE(ALPHA_MASK);
}

struct gn_program_key gn_key_tint(const struct gn_program_key *lit) {
    const uint64_t lost = GN_FEATURE(TONE_NEUTRAL) | GN_FEATURE(TONE_ACES) | GN_FEATURE(TONE_AGX) |
                          GN_FEATURE(FLAT_CONSTANTS) | GN_FEATURE(SHADOW_SPECULAR) |
                          ambient_features();
    struct gn_program_key key = gn_key_of(lit->kind);
    key.features = (lit->features & ~lost) | GN_FEATURE(UNLIT);
    return key;
}

struct gn_program_key gn_key_additive(const struct gn_frame *frame,
                                      const struct gn_program_key *lit,
                                      const struct gn_light_group *group,
                                      const struct gn_frame_opts *opts) {
    const uint64_t once = GN_FEATURE(ENVIRONMENT_KEY) | ambient_features();
    struct gn_program_key key = gn_key_of(lit->kind);
    key.features = (lit->features & ~once) | GN_FEATURE(ADDITIVE);
    set_lights(frame, group, opts, (enum gn_receiver)lit->receiver, &key);
    return key;
}

struct gn_program_key gn_key_caster(const struct gn_frame *frame, uint32_t item,
                                    const struct gn_shadow_view *view) {
    struct gn_program_key key =
        gn_key_of(gn_encoding_is_depth(view->encoding)    ? GN_PROGRAM_DEPTH
                  : view->encoding == GN_ENCODING_STENCIL ? GN_PROGRAM_FLAT
                                                          : GN_PROGRAM_DISTANCE);
    const struct gn_item *what = &frame->scene->items[item];
    key.features = alpha_features(frame->scene, what);
    const struct gn_material *m = &frame->scene->materials[what->material];
    if (gn_material_is_blended(m)) {
        key.features =
            m->alpha == GN_ALPHA_OPAQUE ? GN_FEATURE(ALPHA_MASK) : cut_features(frame->scene, what);
        key.features |= GN_FEATURE(ALPHA_DITHER) | gn_key_texture(m, GN_TEXTURE_TRANSMISSION);
    }
    key.features |= deformation_features(frame->scene, what);
    if (key.kind != GN_PROGRAM_DISTANCE) return key;
    key.encoding = (uint8_t)view->encoding;
    if (view->perspective && !gn_techniques[view->technique].on_plane)
        key.features |= GN_FEATURE(PERSPECTIVE);
    return key;
}

void gn_key_add_middle(const struct gn_shadow_view *view, struct gn_program_key *key) {
    key->features |= GN_FEATURE(MIDDLE);
    if (view->perspective) key->features |= GN_FEATURE(PERSPECTIVE);
}
