#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

static float clamp(float x, float least, float most) { return fminf(fmaxf(x, least), most); }

#define GLOSSINESS "extensions.KHR_materials_pbrSpecularGlossiness"

static struct gn_uv_record read_transform(struct gn_gltf *g, const struct gn_at *transform) {
    struct gn_uv_record record = {.scale = {1, 1}};
    gn_at_floats(g, transform, "offset", 2, record.offset);
    gn_at_floats(g, transform, "scale", 2, record.scale);
    record.rotation_rad = gn_at_float(g, transform, "rotation", 0);
    return record;
}

/* The set and the transform of its coordinates, as an affine map. */
static uint64_t read_uv(struct gn_gltf *g, const struct gn_at *at, float *m, bool *transformed) {
    uint64_t uv_set = gn_at_uint(g, at, "texCoord", 0);
    struct gn_at transform = gn_at_object(g, at, "extensions.KHR_texture_transform");
    *transformed = transform.json != NULL;
    if (!transform.json) return uv_set;
    const struct gn_uv_record record = read_transform(g, &transform);
    gn_uv_make(&record, m);
    return gn_at_uint(g, &transform, "texCoord", uv_set);
}

static int find_uv_set(const uint64_t sets[GN_UV_SETS], uint64_t set) {
    for (int i = 0; i < GN_UV_SETS; i++)
        if (sets[i] == set) return i;
    return -1;
}

void gn_gltf_uv_sets(struct gn_gltf *g, int32_t material, uint64_t sets[GN_UV_SETS]) {
    float m[6];
    bool transformed, others = false;
    uint64_t found[GN_UV_SETS] = {0, 1};
    int count = 0;
    sets[0] = 0;
    sets[1] = 1;
    if (material < 0 || g->failed) return;
    struct gn_at root = gn_at_root(g), materials = gn_at_array(g, &root, "materials");
    struct gn_at at = gn_at_element(&materials, (size_t)material);
    struct gn_at gloss = gn_at_object(g, &at, GLOSSINESS);
    gn_gltf_spare(g, "ignored");
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT && !g->failed; slot++) {
        const bool diffuse = gloss.json && slot == GN_TEXTURE_BASE;
        struct gn_at texture = gn_at_object(
            g, diffuse ? &gloss : &at, diffuse ? "diffuseTexture" : gn_texture_slots[slot].path);
        const uint64_t set = texture.json ? read_uv(g, &texture, m, &transformed) : 0;
        if (gn_gltf_spare(g, "shown without this texture") || !texture.json) continue;
        bool known = false;
        for (int i = 0; i < count; i++) known |= found[i] == set;
        others |= set > 1;
        if (!known && count < GN_UV_SETS) found[count++] = set;
    }
    if (!others) return; /* as the file numbers them */
    if (count == 1) found[1] = found[0] == 0;
    memcpy(sets, found, sizeof found);
}

static enum gn_scale_kind kind_of(int slot) {
    if (slot == GN_TEXTURE_NORMAL) return GN_SCALE_NORMALS;
    return gn_texture_slots[slot].texels == GN_TEXELS_SRGB ? GN_SCALE_COLOR : GN_SCALE_DATA;
}

static void read_texture(struct gn_gltf *g, const struct gn_at *at, bool used,
                         const uint64_t sets[GN_UV_SETS], enum gn_scale_kind kind,
                         struct gn_texture_ref *ref) {
    bool transformed = false;
    int32_t texture = gn_at_ref(g, at, "index", g->file.texture_count, "textures");
    const uint64_t uv_set = read_uv(g, at, ref->uv_from_uv, &transformed);
    const int place = find_uv_set(sets, uv_set);
    ref->texture = -1;
    if (gn_gltf_spare(g, "shown without this texture") || !at->json || g->failed || !used) return;
    if (texture < 0) {
        struct gn_at missing = gn_at_any(at, "index");
        gn_gltf_warn(g, &missing, "missing; shown without this texture");
    } else if (place < 0) {
        gn_gltf_warn(g, at,
                     "texCoord %llu: the material reads sets %llu and %llu, and no third; shown "
                     "without this texture",
                     (unsigned long long)uv_set, (unsigned long long)sets[0],
                     (unsigned long long)sets[1]);
    } else {
        ref->texture = gn_gltf_texture(g, texture, kind);
        ref->uv_set = (uint8_t)place;
    }
}

void gn_material_init(struct gn_material *m) {
    struct gn_material_record record;
    gn_material_record_init(&record);
    gn_material_make(&record, ~(uint32_t)GN_MOVES_UV, m);
    m->name = "";
    m->lightmap_intensity = 1;
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++) {
        m->textures[i].texture = -1;
        m->textures[i].uv_from_uv[0] = m->textures[i].uv_from_uv[3] = 1;
    }
}

/* KHR_materials_pbrSpecularGlossiness: no metal, but any reflectance, of a texture its mean; what
 * is reflected is not diffuse. */
static void read_glossiness(struct gn_gltf *g, const struct gn_at *at, bool used,
                            const uint64_t sets[GN_UV_SETS], struct gn_material *m) {
    float specular[3] = {1, 1, 1};
    glm_vec4_one(m->base_color);
    gn_at_floats(g, at, "diffuseFactor", 4, m->base_color);
    gn_at_floats(g, at, "specularFactor", 3, specular);
    m->roughness = 1 - clamp(gn_at_float(g, at, "glossinessFactor", 1), 0, 1);
    m->metalness = 0;
    struct gn_at both = gn_at_object(g, at, "specularGlossinessTexture");
    struct gn_at base = gn_at_object(g, at, "diffuseTexture");
    read_texture(g, &base, used, sets, GN_SCALE_COLOR, &m->textures[GN_TEXTURE_BASE]);
    struct gn_texture_ref *rough = &m->textures[GN_TEXTURE_ROUGHNESS];
    rough->texture = -1;
    read_texture(g, &both, used, sets, GN_SCALE_COLOR, rough);
    if (rough->texture >= 0) {
        float mean[3];
        if (gn_gltf_glossiness(g, 1 - m->roughness, &rough->texture, mean)) {
            m->roughness = 1;
            for (int k = 0; k < 3; k++) specular[k] *= mean[k];
        } else {
            g->is_missing[GN_MISSING_GLOSSINESS_TEXTURES] = true;
            m->roughness = .6f;
            rough->texture = -1;
        }
    }
    float most = 0;
    for (int k = 0; k < 3; k++) {
        m->f0[k] = clamp(specular[k], 0, 1);
        most = fmaxf(most, m->f0[k]);
    }
    for (int k = 0; k < 3; k++) m->base_color[k] = clamp(m->base_color[k] * (1 - most), 0, 1e4f);
    m->base_color[3] = clamp(m->base_color[3], 0, 1);
}

/* Says where numbers will be clamped. */
static void check_range(struct gn_gltf *g, const struct gn_at *at, const char *path, const float *x,
                        uint32_t count, float least, float most) {
    const struct gn_at place = gn_at_any(at, path);
    bool outside = false;
    for (uint32_t k = 0; k < count; k++) outside |= !(x[k] >= least && x[k] <= most * 1.0001f);
    if (outside && !g->failed)
        gn_gltf_warn(g, &place, "outside %g to %g; clamped", (double)least, (double)most);
}

/* The colour of a volume alone, over its thickness at most: where that comes from a texture, and
 * how long the way of the light is, is unknown. Returns the thickness. */
static float read_tint(struct gn_gltf *g, const struct gn_at *at, float tint[3]) {
    struct gn_at volume = gn_at_object(g, at, "extensions.KHR_materials_volume");
    float color[3] = {1, 1, 1};
    const float thickness = gn_at_float(g, &volume, "thicknessFactor", 0);
    const float distance = gn_at_float(g, &volume, "attenuationDistance", INFINITY);
    gn_at_floats(g, &volume, "attenuationColor", 3, color);
    check_range(g, &volume, "attenuationColor", color, 3, 0, 1);
    const float way = thickness > 0 && distance > 0 ? clamp(thickness / distance, 0, 1) : 0;
    for (int k = 0; k < 3; k++) tint[k] = powf(clamp(color[k], 0, 1), way);
    return thickness;
}

/* Leaves out the last ones of too many. */
static void limit_textures(struct gn_gltf *g, const struct gn_at *at, struct gn_material *m) {
    int count = 0;
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        if (m->textures[slot].texture < 0 || ++count <= GN_MATERIAL_TEXTURES_MAX) continue;
        const char *path = gn_texture_slots[slot].path, *dot = strrchr(path, '.');
        gn_gltf_warn(g, at, "more than %d textures; shown without the %s", GN_MATERIAL_TEXTURES_MAX,
                     dot ? dot + 1 : path);
        m->textures[slot].texture = -1;
    }
}

static void read_record(struct gn_gltf *g, const struct gn_at *at, struct gn_material_record *r) {
    gn_material_record_init(r);
    for (size_t i = 0; i < gn_material_property_count; i++) {
        const struct gn_property *p = &gn_material_properties[i];
        float *to = (float *)r + p->first;
        if (p->components == 1)
            *to = gn_at_float(g, at, p->path, p->fallback);
        else
            gn_at_floats(g, at, p->path, p->components, to);
        check_range(g, at, p->path, to, p->components, p->least, p->most);
    }
}

/* The numbers of a material. What a clip may change of it decides how it is read. */
static void read_properties(struct gn_gltf *g, const struct gn_at *at, size_t index, bool used,
                            struct gn_material *m) {
    struct gn_material_record own, *r = gn_gltf_record(g, GN_THING_MATERIAL, index, &m->record);
    if (!r) r = &own;
    read_record(g, at, r);
    const float thickness = read_tint(g, at, r->tint);
    m->moves = g->to_scene.moves[index];
    if (m->unlit) {
        m->moves &= ~(uint32_t)GN_MOVES_LAYERS;
        memset(r->factors, 0, sizeof r->factors);
    }
    gn_material_make(r, ~(uint32_t)GN_MOVES_UV, m);
    for (int slot = 0; m->record && slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        struct gn_at texture = gn_at_object(g, at, gn_texture_slots[slot].path);
        struct gn_at transform = gn_at_object(g, &texture, "extensions.KHR_texture_transform");
        r->uv[slot] = read_transform(g, &transform);
    }
    struct gn_at coat = gn_at_object(g, at, GN_CLEARCOAT);
    if (used && m->factors[GN_FACTOR_TRANSMISSION] > 0 && thickness > 0)
        g->is_missing[GN_MISSING_VOLUME] = true;
    if (used && m->factors[GN_FACTOR_COAT] > 0 && gn_at_any(&coat, "clearcoatNormalTexture").json)
        g->is_missing[GN_MISSING_COAT_NORMALS] = true;
}

static void read_material(struct gn_gltf *g, const struct gn_at *at, size_t index, bool used,
                          const uint64_t sets[GN_UV_SETS], struct gn_material *m) {
    static const char *const alphas[] = {
        [GN_ALPHA_OPAQUE] = "OPAQUE", [GN_ALPHA_MASK] = "MASK", [GN_ALPHA_BLEND] = "BLEND"};
    gn_material_init(m);
    m->name = gn_gltf_strdup(g, gn_at_name(g, at));
    m->double_sided = gn_at_flag(g, at, "doubleSided", false);
    m->unlit = gn_at_object(g, at, "extensions.KHR_materials_unlit").json != NULL;
    const char *alpha = gn_at_text(g, at, "alphaMode");
    struct gn_at alpha_at = gn_at_any(at, "alphaMode");
    int word = gn_json_word(alpha_at.json, alphas, 3);
    if (word >= 0)
        m->alpha = (enum gn_alpha)word;
    else if (alpha)
        gn_gltf_warn(g, &alpha_at, "'%.20s' is none of OPAQUE, MASK, BLEND; taken as OPAQUE",
                     alpha);
    read_properties(g, at, index, used, m);
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
        struct gn_at texture = gn_at_object(g, at, gn_texture_slots[slot].path);
        gn_gltf_spare(g, "shown without this texture");
        const bool needless =
            gn_texture_slots[slot].shading >= GN_SHADING_LAYERS && !gn_material_reads(m, slot);
        read_texture(g, &texture, used && !needless, sets, kind_of(slot), &m->textures[slot]);
    }
    struct gn_at gloss = gn_at_object(g, at, GLOSSINESS);
    struct gn_at specular = gn_at_object(g, at, "extensions.KHR_materials_specular");
    if (gloss.json)
        read_glossiness(g, &gloss, used, sets, m);
    else if (used && (gn_at_any(&specular, "specularTexture").json ||
                      gn_at_any(&specular, "specularColorTexture").json))
        g->is_missing[GN_MISSING_SPECULAR_TEXTURES] = true;
    if (used) gn_missing_of_material(g, at);
    m->lightmap_intensity =
        clamp(gn_at_float(g, at, "extensions.MOZ_lightmap.intensity", 1), 0, 1e9f);
    if (used) gn_extras_material(g, at, find_uv_set(sets, 1), m);
    limit_textures(g, at, m);
    gn_gltf_spare(g, "ignored");
}

/* ---- tangents ---- */

static struct gn_at normal_texture(struct gn_gltf *g, struct gn_at at[3], int32_t material) {
    at[0] = gn_at_root(g);
    at[1] = gn_at_array(g, &at[0], "materials");
    at[2] = gn_at_item(g, &at[1], (size_t)material);
    return gn_at_object(g, &at[2], "normalTexture");
}

int32_t gn_gltf_tangents(struct gn_gltf *g, int32_t material) {
    if (material < 0 || g->failed) return GN_TANGENTS_NONE;
    float m[6];
    bool transformed = false;
    struct gn_at above[3], at = normal_texture(g, above, material);
    const bool lit = !gn_at_object(g, &above[2], "extensions.KHR_materials_unlit").json;
    if (gn_gltf_spare(g, "ignored") || !at.json || !lit) return GN_TANGENTS_NONE;
    uint64_t sets[GN_UV_SETS];
    gn_gltf_uv_sets(g, material, sets);
    const int uv_set = find_uv_set(sets, read_uv(g, &at, m, &transformed));
    if (gn_gltf_spare(g, "shown without this texture") || g->failed || uv_set < 0)
        return GN_TANGENTS_NONE; /* read_texture() warns */
    return transformed ? GN_TANGENTS_MATERIAL + material : GN_TANGENTS_UV + uv_set;
}

struct gn_texture_ref gn_gltf_tangents_uv(struct gn_gltf *g, int32_t tangents) {
    struct gn_texture_ref ref = {.texture = -1, .uv_from_uv = {1, 0, 0, 1}};
    bool transformed = false;
    if (tangents < GN_TANGENTS_MATERIAL) {
        ref.uv_set = (uint8_t)(tangents - GN_TANGENTS_UV);
        return ref;
    }
    struct gn_at above[3], at = normal_texture(g, above, tangents - GN_TANGENTS_MATERIAL);
    uint64_t sets[GN_UV_SETS];
    gn_gltf_uv_sets(g, tangents - GN_TANGENTS_MATERIAL, sets);
    const int uv_set = find_uv_set(sets, read_uv(g, &at, ref.uv_from_uv, &transformed));
    ref.uv_set = uv_set > 0 ? (uint8_t)uv_set : 0;
    return ref;
}

bool gn_gltf_materials(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_at root = gn_at_root(g), materials = gn_at_array(g, &root, "materials");
    scene->material_count = (uint32_t)g->file.material_count + 1;
    GN_NEW(g, g->memory.scene, scene->materials, scene->material_count + 1);
    bool *used = gn_gltf_alloc(g, &g->memory.load, scene->material_count, sizeof *used);
    if (g->failed) return false;
    for (uint32_t i = 0; i < scene->item_count; i++) used[scene->items[i].material] = true;
    for (size_t i = 0; i < g->file.material_count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&materials, i);
        uint64_t sets[GN_UV_SETS];
        gn_gltf_uv_sets(g, (int32_t)i, sets);
        if (!g->failed) read_material(g, &at, i, used[i], sets, &scene->materials[i]);
    }
    gn_material_init(&scene->materials[g->file.material_count]);
    return !g->failed;
}
