#include <string.h>

#include "frame/private.h"

static uint32_t texture_features(const struct gn_scene *scene, const struct gn_item *item,
                                 uint32_t slots) {
    const struct gn_material *material = &scene->materials[item->material];
    uint32_t features = 0;
    for (uint32_t slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        const struct gn_texture_ref *ref = &material->textures[slot];
        if (!(slots & 1u << slot) || ref->texture < 0) continue;
        features |= GN_FEATURE_BASE_TEXTURE << slot;
        if (ref->uv_set) features |= GN_FEATURE_BASE_UV1 << slot;
    }
    return features;
}

/* What decides an item's alpha, if anything asks for it. */
static uint32_t alpha_features(const struct gn_scene *scene, const struct gn_item *item) {
    if (scene->materials[item->material].alpha != GN_ALPHA_MASK) return 0;
    uint32_t features =
        GN_FEATURE_ALPHA_MASK | texture_features(scene, item, 1u << GN_TEXTURE_BASE);
    if (scene->geometries[item->geometry].has_color) features |= GN_FEATURE_VERTEX_COLOR;
    return features;
}

static bool is_specular(const struct gn_material *m) {
    return m->metalness > 0.0f || m->roughness < 1.0f ||
           m->textures[GN_TEXTURE_ROUGHNESS].texture >= 0;
}

static bool is_emissive(const struct gn_material *m) {
    return m->emissive[0] > 0.0f || m->emissive[1] > 0.0f || m->emissive[2] > 0.0f;
}

static uint32_t color_features(const struct gn_frame *frame, const struct gn_item *item) {
    const struct gn_scene *scene = frame->scene;
    const struct gn_material *m = &scene->materials[item->material];
    uint32_t slots = 1u << GN_TEXTURE_BASE, features = alpha_features(scene, item);
    if (scene->geometries[item->geometry].has_color) features |= GN_FEATURE_VERTEX_COLOR;
    if (m->alpha == GN_ALPHA_BLEND) features |= GN_FEATURE_ALPHA_BLEND;
    if (frame->plan.output == GN_OUTPUT_LINEAR8 && frame->plan.encode_srgb)
        features |= GN_FEATURE_ENCODE_SRGB;
    if (frame->caps.software && !m->unlit) features |= GN_FEATURE_FLAT_CONSTANTS;
    if (m->unlit) return features | GN_FEATURE_UNLIT | texture_features(scene, item, slots);
    if (m->double_sided) features |= GN_FEATURE_DOUBLE_SIDED;
    if (is_specular(m)) {
        features |= GN_FEATURE_SPECULAR;
        slots |= 1u << GN_TEXTURE_ROUGHNESS;
    }
    if (is_emissive(m)) {
        features |= GN_FEATURE_EMISSIVE;
        slots |= 1u << GN_TEXTURE_EMISSIVE;
    }
    slots |= 1u << GN_TEXTURE_OCCLUSION;
    if (memcmp(scene->sky, scene->ground, sizeof(vec3)) != 0) features |= GN_FEATURE_HEMISPHERE;
    return features | texture_features(scene, item, slots);
}

static bool has_planar_lights(const struct gn_frame *frame) {
    for (uint32_t i = 0; i < frame->light_count; i++)
        if (gn_techniques[frame->lights[i].technique].on_plane) return true;
    return false;
}

static enum gn_receiver receiver_of(const struct gn_frame *frame, const struct gn_item *item,
                                    enum gn_aov aov) {
    if (!item->receives && aov != GN_AOV_VISIBILITY) return GN_RECEIVES_NOTHING;
    return item->plane && has_planar_lights(frame) ? GN_RECEIVES_ALL : GN_RECEIVES_MAPS;
}

bool gn_key_on_plane(const struct gn_frame *frame, uint32_t item,
                     const struct gn_frame_opts *opts) {
    return receiver_of(frame, &frame->scene->items[item], opts->aov) == GN_RECEIVES_ALL;
}

/* How many of the lights with maps are asked about their shadows: those for the plane come last. */
static uint32_t shadows_on(const struct gn_frame *frame, const struct gn_light_group *group,
                           enum gn_receiver receiver) {
    uint32_t count = receiver == GN_RECEIVES_NOTHING ? 0 : group->shadow_count;
    while (receiver == GN_RECEIVES_MAPS && count > 0 &&
           gn_techniques[frame->lights[group->first + count - 1].technique].on_plane)
        count--;
    return count;
}

/* The lights of a group, and what their techniques take. */
static void set_lights(const struct gn_frame *frame, const struct gn_light_group *group,
                       const struct gn_frame_opts *opts, enum gn_receiver receiver,
                       struct gn_program_key *key) {
    key->light_count = (uint8_t)group->count;
    key->shadow_count = (uint8_t)shadows_on(frame, group, receiver);
    for (uint32_t i = 0; i < group->count; i++) {
        const struct gn_frame_light *light = &frame->lights[group->first + i];
        key->lights[i].type = (uint8_t)frame->scene->lights[light->light].type;
        key->lights[i].slide = (uint8_t)light->slide;
        if (i >= key->shadow_count) continue;
        key->lights[i].technique = (uint8_t)light->technique;
        key->lights[i].encoding = (uint8_t)light->encoding;
        key->lights[i].moments = (uint8_t)light->moments;
        key->lights[i].cascades = light->cascades > 1;
        if (!gn_techniques[light->technique].taps) continue;
        key->taps = (uint8_t)(opts->taps ? opts->taps : GN_TAPS_DEFAULT);
        key->taps_turn = !opts->taps_fixed;
    }
}

struct gn_program_key gn_key_lit(const struct gn_frame *frame, uint32_t index,
                                 const struct gn_frame_opts *opts) {
    const struct gn_item *item = &frame->scene->items[index];
    const struct gn_material *m = &frame->scene->materials[item->material];
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = opts->aov == GN_AOV_COLOR ? GN_PROGRAM_LIT : GN_PROGRAM_AOV;
    key.aov = (uint8_t)opts->aov;
    key.features = opts->aov == GN_AOV_COLOR ? color_features(frame, item)
                                             : alpha_features(frame->scene, item);
    if (opts->aov != GN_AOV_COLOR && m->double_sided) key.features |= GN_FEATURE_DOUBLE_SIDED;
    if (opts->aov == GN_AOV_COLOR ? m->unlit : opts->aov != GN_AOV_VISIBILITY) return key;
    enum gn_receiver receiver = receiver_of(frame, item, opts->aov);
    set_lights(frame, &frame->groups[0], opts, receiver, &key);
    if (frame->group_count > 1) key.receiver = (uint8_t)receiver;
    return key;
}

struct gn_program_key gn_key_additive(const struct gn_frame *frame,
                                      const struct gn_program_key *lit,
                                      const struct gn_light_group *group,
                                      const struct gn_frame_opts *opts) {
    const uint32_t once = GN_FEATURE_HEMISPHERE | GN_FEATURE_EMISSIVE |
                          GN_FEATURE_EMISSIVE_TEXTURE | GN_FEATURE_EMISSIVE_UV1 |
                          GN_FEATURE_OCCLUSION_TEXTURE | GN_FEATURE_OCCLUSION_UV1;
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = lit->kind;
    key.features = (lit->features & ~once) | GN_FEATURE_ADDITIVE;
    set_lights(frame, group, opts, (enum gn_receiver)lit->receiver, &key);
    return key;
}

struct gn_program_key gn_key_caster(const struct gn_frame *frame, uint32_t item,
                                    const struct gn_shadow_view *view) {
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = view->encoding == GN_ENCODING_DEPTH     ? GN_PROGRAM_DEPTH
               : view->encoding == GN_ENCODING_STENCIL ? GN_PROGRAM_FLAT
                                                       : GN_PROGRAM_DISTANCE;
    key.features = alpha_features(frame->scene, &frame->scene->items[item]);
    if (key.kind != GN_PROGRAM_DISTANCE) return key;
    key.encoding = (uint8_t)view->encoding;
    if (view->perspective && view->encoding != GN_ENCODING_MASK)
        key.features |= GN_FEATURE_PERSPECTIVE;
    return key;
}
