#include "scene/private.h"

#include <math.h>
#include <string.h>

static float clamp(float x, float least, float most) { return fminf(fmaxf(x, least), most); }

static void read_texture(struct gn_gltf *g, const struct gn_at *at, bool used,
                         struct gn_texture_ref *ref) {
    uint64_t uv_set = gn_at_uint(g, at, "texCoord", 0);
    int32_t texture = gn_at_ref(g, at, "index", g->file.texture_count, "textures");
    ref->texture = -1;
    struct gn_at transform = gn_at_extension(g, at, "extensions.KHR_texture_transform");
    if (transform.json) { /* as an affine map; the rotation is clockwise, since v points down */
        float offset[2] = {0, 0}, scale[2] = {1, 1};
        gn_at_floats(g, &transform, "offset", 2, offset);
        gn_at_floats(g, &transform, "scale", 2, scale);
        uv_set = gn_at_uint(g, &transform, "texCoord", uv_set);
        float angle = gn_at_float(g, &transform, "rotation", 0);
        float c = cosf(angle), s = sinf(angle), *m = ref->uv_from_uv;
        m[0] = c * scale[0];
        m[1] = -s * scale[0];
        m[2] = s * scale[1];
        m[3] = c * scale[1];
        memcpy(m + 4, offset, sizeof offset);
        for (int i = 0; i < 6; i++) m[i] += 0; /* no -0: transforms are compared as bytes */
    }
    if (!at->json || g->failed || !used) return;
    if (texture < 0) {
        struct gn_at place = gn_at_any(at, "index");
        gn_gltf_fail(g, &place, "missing");
    } else if (uv_set > 1) {
        gn_gltf_warn(g, at, "texCoord %llu: only sets 0 and 1 are read; shown without this texture",
                     (unsigned long long)uv_set);
    } else {
        ref->texture = gn_gltf_texture(g, texture);
        ref->uv_set = (uint8_t)uv_set;
    }
}

/* glTF's default material, and the defaults of every other. */
static void init_material(struct gn_material *m) {
    m->name = "";
    glm_vec4_one(m->base_color);
    m->roughness = m->metalness = m->occlusion_strength = 1;
    m->alpha_cutoff = .5f;
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++) {
        m->textures[i].texture = -1;
        m->textures[i].uv_from_uv[0] = m->textures[i].uv_from_uv[3] = 1;
    }
}

static void read_material(struct gn_gltf *g, const struct gn_at *at, bool used,
                          struct gn_material *m) {
    static const char *const alphas[] = {
        [GN_ALPHA_OPAQUE] = "OPAQUE", [GN_ALPHA_MASK] = "MASK", [GN_ALPHA_BLEND] = "BLEND"};
    init_material(m);
    m->name = gn_gltf_strdup(g, gn_at_text(g, at, "name"));
    m->double_sided = gn_at_flag(g, at, "doubleSided", false);
    m->unlit = gn_at_extension(g, at, "extensions.KHR_materials_unlit").json != NULL;
    const char *alpha = gn_at_text(g, at, "alphaMode");
    struct gn_at alpha_at = gn_at_any(at, "alphaMode");
    int word = gn_json_word(alpha_at.json, alphas, 3);
    if (word >= 0)
        m->alpha = (enum gn_alpha)word;
    else if (alpha)
        gn_gltf_warn(g, &alpha_at, "'%.20s' is none of OPAQUE, MASK, BLEND; taken as OPAQUE",
                     alpha);
    m->alpha_cutoff = clamp(gn_at_float(g, at, "alphaCutoff", .5f), 0, 2);

    struct gn_at pbr = gn_at_object(g, at, "pbrMetallicRoughness");
    gn_at_floats(g, &pbr, "baseColorFactor", 4, m->base_color);
    for (int k = 0; k < 4; k++) m->base_color[k] = clamp(m->base_color[k], 0, k < 3 ? 1e4f : 1);
    m->roughness = clamp(gn_at_float(g, &pbr, "roughnessFactor", 1), 0, 1);
    m->metalness = clamp(gn_at_float(g, &pbr, "metallicFactor", 1), 0, 1);
    struct gn_at strong = gn_at_extension(g, at, "extensions.KHR_materials_emissive_strength");
    float strength = gn_at_float(g, &strong, "emissiveStrength", 1);
    gn_at_floats(g, at, "emissiveFactor", 3, m->emissive);
    for (int k = 0; k < 3; k++)
        m->emissive[k] = clamp(clamp(m->emissive[k], 0, 1e9f) * clamp(strength, 0, 1e9f), 0, 1e9f);

    struct gn_at occlusion = gn_at_object(g, at, "occlusionTexture");
    m->occlusion_strength = clamp(gn_at_float(g, &occlusion, "strength", 1), 0, 1);
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        const struct gn_texture_slot_row *row = &gn_texture_slots[slot];
        struct gn_at parent = *row->parent ? gn_at_object(g, at, row->parent) : *at;
        struct gn_at texture = gn_at_object(g, &parent, row->key);
        read_texture(g, &texture, used, &m->textures[slot]);
    }
    if (used && gn_at_object(g, at, "normalTexture").json)
        g->is_missing[GN_MISSING_NORMAL_MAPS] = true;
}

bool gn_gltf_materials(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_at root = gn_at_root(g), materials = gn_at_array(g, &root, "materials");
    scene->material_count = (uint32_t)g->file.material_count + 1;
    scene->materials =
        gn_gltf_alloc(g, g->memory.scene, scene->material_count, sizeof *scene->materials);
    bool *used = gn_gltf_alloc(g, &g->memory.load, scene->material_count, sizeof *used);
    if (g->failed) return false;
    for (uint32_t i = 0; i < scene->item_count; i++) used[scene->items[i].material] = true;
    for (size_t i = 0; i < g->file.material_count && !g->failed; i++) {
        struct gn_at at = gn_at_item(g, &materials, i);
        if (!g->failed) read_material(g, &at, used[i], &scene->materials[i]);
    }
    init_material(&scene->materials[g->file.material_count]);
    return !g->failed;
}
