/* Materials: Phong parameters converted to metallic and roughness. */
#include <math.h>
#include <string.h>

#include "import/private.h"

/* assimp's material keys expand to three arguments each. */
static bool get_color(const struct aiMaterial *material, const char *key, unsigned type, unsigned n,
                      float rgb[3]) {
    struct aiColor4D color;
    if (aiGetMaterialColor(material, key, type, n, &color) != aiReturn_SUCCESS) return false;
    if (!isfinite(color.r + color.g + color.b)) return false;
    rgb[0] = fmaxf(color.r, 0.0f);
    rgb[1] = fmaxf(color.g, 0.0f);
    rgb[2] = fmaxf(color.b, 0.0f);
    return true;
}

static float get_number(const struct aiMaterial *material, const char *key, unsigned type,
                        unsigned n, float fallback) {
    float value = fallback;
    unsigned count = 1;
    if (aiGetMaterialFloatArray(material, key, type, n, &value, &count) != aiReturn_SUCCESS ||
        count < 1 || !isfinite(value))
        return fallback;
    return value;
}

static float clamp_unit(float value) { return fminf(fmaxf(value, 0.0f), 1.0f); }

/* Inverts the renderer's rule exponent = 2 / roughness^4 - 2. No highlight means roughness 1. */
static float rough_from_phong(const struct aiMaterial *material) {
    float specular[3] = {0.0f, 0.0f, 0.0f};
    get_color(material, AI_MATKEY_COLOR_SPECULAR, specular);
    float strength = get_number(material, AI_MATKEY_SHININESS_STRENGTH, 1.0f);
    float shine = fmaxf(fmaxf(specular[0], specular[1]), specular[2]) * strength;
    float exponent = get_number(material, AI_MATKEY_SHININESS, 0.0f);
    if (shine < 0.01f || exponent <= 0.0f) return 1.0f;
    return powf(2.0f / (exponent + 2.0f), 0.25f);
}

static bool is_black(const float rgb[3]) { return rgb[0] + rgb[1] + rgb[2] <= 0.0f; }

static void set_white(float rgb[3]) { rgb[0] = rgb[1] = rgb[2] = 1.0f; }

/* With a base texture the factor is white, except in OBJ, which multiplies both. */
static void read_base(struct gn_import *import, unsigned index, const char *name, bool textured,
                      float rgba[4]) {
    const struct aiMaterial *material = import->scene->mMaterials[index];
    set_white(rgba);
    if (!get_color(material, AI_MATKEY_BASE_COLOR, rgba))
        get_color(material, AI_MATKEY_COLOR_DIFFUSE, rgba);
    bool vertex_colors = false;
    for (unsigned i = 0; i < import->scene->mNumMeshes; i++)
        vertex_colors |= import->scene->mMeshes[i]->mMaterialIndex == index &&
                         import->scene->mMeshes[i]->mColors[0];
    bool made_up = strcmp(name, AI_DEFAULT_MATERIAL_NAME) == 0;
    if ((textured && (import->format != GN_MODEL_OBJ || is_black(rgba))) ||
        (made_up && vertex_colors))
        set_white(rgba);
    for (int k = 0; k < 3; k++) rgba[k] = clamp_unit(rgba[k]);

    /* some exporters write 0 for "opaque"; an invisible model is never intended */
    rgba[3] = clamp_unit(get_number(material, AI_MATKEY_OPACITY, 1.0f));
    if (rgba[3] > 0.0f) return;
    rgba[3] = 1.0f;
    gn_warn(import->warnings, "%s: materials with an opacity of 0 are shown opaque",
            import->opts->model);
}

static json_t *texture_info(const struct gn_import_texture *texture, int uv_set) {
    json_t *info = json_pack("{s:i}", "index", texture->index);
    if (uv_set) json_object_set_new(info, "texCoord", json_integer(uv_set));
    return info;
}

/* Factors over 1 need KHR_materials_emissive_strength. */
static void set_emissive(struct gn_import *import, const struct aiMaterial *material,
                         json_t *object) {
    int uv_set;
    struct gn_import_texture texture =
        gn_import_texture(import, material, aiTextureType_EMISSIVE, false, &uv_set);
    float rgb[3] = {0.0f, 0.0f, 0.0f};
    get_color(material, AI_MATKEY_COLOR_EMISSIVE, rgb);
    if (texture.index >= 0) {
        if (is_black(rgb)) set_white(rgb);
        json_object_set_new(object, "emissiveTexture", texture_info(&texture, uv_set));
    }
    float strength = fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
    if (strength <= 0.0f) return;
    for (int k = 0; k < 3 && strength > 1.0f; k++) rgb[k] /= strength;
    json_object_set_new(object, "emissiveFactor", gn_glb_floats(rgb, 3));
    if (strength <= 1.0f) return;
    gn_glb_extension(&import->glb, "KHR_materials_emissive_strength");
    json_object_set_new(object, "extensions",
                        json_pack("{s:{s:f}}", "KHR_materials_emissive_strength",
                                  "emissiveStrength", (double)strength));
}

int gn_import_material(struct gn_import *import, unsigned index) {
    if (index >= import->scene->mNumMaterials) return -1;
    int *known = &import->materials[index];
    if (*known != GN_IMPORT_UNSEEN) return *known;
    const struct aiMaterial *material = import->scene->mMaterials[index];
    struct aiString name = {0};
    float rgba[4];
    int uv_set;
    aiGetMaterialString(material, AI_MATKEY_NAME, &name);
    enum aiTextureType type = aiGetMaterialTextureCount(material, aiTextureType_BASE_COLOR)
                                  ? aiTextureType_BASE_COLOR
                                  : aiTextureType_DIFFUSE;
    struct gn_import_texture base = gn_import_texture(import, material, type, true, &uv_set);
    read_base(import, index, name.data, base.index >= 0, rgba);
    float metal = clamp_unit(get_number(material, AI_MATKEY_METALLIC_FACTOR, 0.0f));
    float rough =
        clamp_unit(get_number(material, AI_MATKEY_ROUGHNESS_FACTOR, rough_from_phong(material)));
    json_t *surface = json_pack("{s:o,s:f,s:f}", "baseColorFactor", gn_glb_floats(rgba, 4),
                                "metallicFactor", (double)metal, "roughnessFactor", (double)rough);
    if (base.index >= 0)
        json_object_set_new(surface, "baseColorTexture", texture_info(&base, uv_set));
    json_t *object =
        json_pack("{s:o,s:o}", "name", gn_glb_text(name.data), "pbrMetallicRoughness", surface);
    bool has_alpha = base.alpha.has_alpha && !base.opaque;
    if (rgba[3] < 1.0f || (has_alpha && base.alpha.soft))
        json_object_set_new(object, "alphaMode", json_string("BLEND"));
    else if (has_alpha)
        json_object_set_new(object, "alphaMode", json_string("MASK"));
    set_emissive(import, material, object);
    /* OBJ, STL and PLY have no such flag, and their winding is often inconsistent */
    int double_sided = 1;
    unsigned count = 1;
    if (aiGetMaterialIntegerArray(material, AI_MATKEY_TWOSIDED, &double_sided, &count) !=
            aiReturn_SUCCESS ||
        double_sided != 0)
        json_object_set_new(object, "doubleSided", json_true());
    return *known = gn_glb_add(&import->glb, "materials", object);
}
