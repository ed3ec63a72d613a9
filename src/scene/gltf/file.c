/* The container: .glb or .gltf by content, its JSON and BIN chunk; version and required extensions.
 */
#include "scene/private.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/model.h"
#include "scene/gltf/meshopt.h"

enum { HEADER = 12, CHUNK = 8 };
#define CHUNK_JSON 0x4e4f534aU
#define CHUNK_BIN  0x004e4942U

static bool has_bom(const uint8_t *text, size_t size) {
    return size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
}

static bool parse_json(struct gn_gltf *g, const uint8_t *text, size_t size, size_t offset) {
    size_t skip = has_bom(text, size) ? 3 : 0;
    return gn_gltf_parse(g, (const char *)text + skip, size - skip, offset + skip);
}

/* ---- .glb ---- */

static bool read_chunk(struct gn_gltf *g, const uint8_t *data, size_t at) {
    uint32_t length = gn_u32_at(data + at), type = gn_u32_at(data + at + 4);
    const uint8_t *body = data + at + CHUNK;
    if (at == HEADER && type != CHUNK_JSON)
        return gn_gltf_fail(g, NULL, "byte %zu: the first chunk must be JSON", at + 4);
    if (at == HEADER) {
        while (length > 0 && body[length - 1] == 0) length--; /* some exporters pad with zeros */
        return parse_json(g, body, length, at + CHUNK);
    }
    if (type == CHUNK_JSON) return gn_gltf_fail(g, NULL, "byte %zu: a second JSON chunk", at);
    if (type == CHUNK_BIN && g->file.bin.data)
        gn_gltf_warn(g, NULL, "byte %zu: a second BIN chunk", at);
    else if (type == CHUNK_BIN)
        g->file.bin = (struct gn_blob){.data = body, .size = length};
    return true;
}

static bool open_glb(struct gn_gltf *g, const uint8_t *data, size_t size) {
    if (size < HEADER + CHUNK)
        return gn_gltf_fail(g, NULL, "byte %zu: the file ends within the .glb header", size);
    uint32_t version = gn_u32_at(data + 4), length = gn_u32_at(data + 8);
    if (version != 2)
        return gn_gltf_fail(g, NULL,
                            "byte 4: .glb version %" PRIu32 "; only version 2 is read: "
                            "export it again as glTF 2.0",
                            version);
    if (length > size)
        return gn_gltf_fail(g, NULL,
                            "byte 8: length %" PRIu32 ", but the file has %zu bytes: it is "
                            "truncated, copy it again",
                            length, size);
    if (length < HEADER + CHUNK)
        return gn_gltf_fail(g, NULL, "byte 8: a length of %" PRIu32 " is too short", length);
    if (length < size) gn_gltf_warn(g, NULL, "%zu bytes after the end ignored", size - length);
    size = length;

    size_t at = HEADER;
    while (size - at >= CHUNK) {
        uint32_t chunk = gn_u32_at(data + at);
        if (chunk > size - at - CHUNK)
            return gn_gltf_fail(g, NULL, "byte %zu: a chunk of %" PRIu32 " bytes, but %zu are left",
                                at, chunk, size - at - CHUNK);
        if (!read_chunk(g, data, at)) return false;
        at += CHUNK + (size_t)chunk;
    }
    if (at < size)
        gn_gltf_warn(g, NULL, "byte %zu: %zu bytes after the last chunk ignored", at, size - at);
    return true;
}

/* Files that people take for scenes, by their first bytes or the suffix of their name, since .blend
 * files may be compressed, and .usdz is a ZIP archive. */
static const struct other {
    const char *magic, *suffix, *name, *cure;
} OTHERS[] = {
    {"BLENDER", ".blend", "a Blender file",
     "open it in Blender and choose File > Export > glTF 2.0, format .glb"},
    {"#usda", ".usda", "USD", "import it into Blender and export glTF 2.0 (.glb)"},
    {"PXR-USDC", ".usdc", "USD", "import it into Blender and export glTF 2.0 (.glb)"},
    {NULL, ".usdz", "USD", "import it into Blender and export glTF 2.0 (.glb)"},
    {NULL, ".usd", "USD", "import it into Blender and export glTF 2.0 (.glb)"},
    {"ISO-10303-21", ".step", "STEP", "export .glb, .stl or .obj from the CAD program"},
    {NULL, ".stp", "STEP", "export .glb, .stl or .obj from the CAD program"},
    {"#?", ".hdr", "a Radiance picture", "--environment FILE.hdr lights a scene by it"},
    {"\xabKTX 20\xbb", ".ktx2", "a KTX2 texture", "name the scene that uses it"},
};

static const struct other *find_other(const struct gn_gltf *g, const uint8_t *data, size_t size) {
    const char *dot = strrchr(g->path, '.');
    for (size_t i = 0; i < sizeof OTHERS / sizeof OTHERS[0]; i++) {
        const struct other *o = &OTHERS[i];
        const size_t length = o->magic ? strlen(o->magic) : 0;
        if (o->magic && size >= length && memcmp(data, o->magic, length) == 0) return o;
        if (dot && strcasecmp(dot, o->suffix) == 0) return o;
    }
    return NULL;
}

bool gn_gltf_open(struct gn_gltf *g, const uint8_t *data, size_t size) {
    if (size == 0) return gn_gltf_fail(g, NULL, "byte 0: the file is empty");
    if (size >= 4 && memcmp(data, "glTF", 4) == 0) return open_glb(g, data, size);
    size_t start = has_bom(data, size) ? 3 : 0;
    while (start < size && data[start] && strchr(" \t\r\n", data[start])) start++;
    if (start < size && data[start] == '{') return parse_json(g, data, size, 0);
    char others[80] = "";
    for (size_t i = 0, used = 0; i < GN_MODEL_FORMAT_COUNT && used < sizeof others; i++)
        used += (size_t)snprintf(others + used, sizeof others - used, "%s%s", i ? " " : "",
                                 gn_model_formats[i].suffix);
    const struct other *other = find_other(g, data, size);
    if (other)
        return gn_gltf_fail(g, NULL,
                            "%s; what can be read is .glb and .gltf, and %s through "
                            "gnomon-import: %s",
                            other->name, others, other->cure);
    return gn_gltf_fail(g, NULL,
                        "byte %zu: neither .glb ('glTF') nor .gltf ('{'); what can be read is .glb "
                        "and .gltf, and %s through gnomon-import: export it as .glb",
                        start, others);
}

/* ---- versions and extensions ---- */

/* Beside those that properties of materials belong to (scene/property.h). */
static const char *const SUPPORTED[] = {
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
    "MOZ_lightmap",
    "KHR_materials_pbrSpecularGlossiness",
    "EXT_texture_webp",
    "KHR_texture_basisu",
    "KHR_materials_variants",
    "KHR_animation_pointer",
    "KHR_node_visibility",
};

static const struct cure {
    const char *extension, *what_to_do;
} CURES[] = {
    {"KHR_draco_mesh_compression", "decompress it first (gltf-transform can)"},
    {"EXT_meshopt_compression", "decompress it first (gltf-transform can)"}, /* not in this build */
    {"KHR_meshopt_compression", "decompress it first (gltf-transform can)"},
    {"EXT_texture_avif", "export it with PNG or JPEG pictures"},
};

bool gn_gltf_supports(const char *name) {
    char extension[80];
    for (size_t i = 0; i < gn_material_property_count; i++)
        if (sscanf(gn_material_properties[i].path, "extensions.%79[^.]", extension) == 1 &&
            strcmp(extension, name) == 0)
            return true;
    for (size_t i = 0; i < sizeof SUPPORTED / sizeof SUPPORTED[0]; i++)
        if (strcmp(SUPPORTED[i], name) == 0) return true;
    return (strcmp(name, "EXT_meshopt_compression") == 0 ||
            strcmp(name, "KHR_meshopt_compression") == 0) &&
           gn_meshopt_is_read();
}

static bool lists_extension(const struct gn_gltf *g, const char *list, const char *extension) {
    const json_t *names = json_object_get(g->file.json, list);
    for (size_t i = 0; i < json_array_size(names); i++) {
        const char *name = json_string_value(json_array_get(names, i));
        if (name && strcmp(name, extension) == 0) return true;
    }
    return false;
}

bool gn_gltf_requires(const struct gn_gltf *g, const char *extension) {
    return lists_extension(g, "extensionsRequired", extension);
}

bool gn_gltf_uses(const struct gn_gltf *g, const char *extension) {
    return gn_gltf_requires(g, extension) || lists_extension(g, "extensionsUsed", extension);
}

/* Makes each list an array of objects, so that other files need not check. */
static void check_arrays(struct gn_gltf *g) {
    static const char *const names[] = {
        "buffers", "bufferViews", "accessors", "images", "samplers", "textures",  "materials",
        "meshes",  "skins",       "cameras",   "nodes",  "scenes",   "animations"};
    struct gn_at root = gn_at_root(g);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        struct gn_at array = gn_at_array(g, &root, names[k]);
        if (gn_gltf_spare(g, "ignored")) json_object_del(root.json, names[k]);
        for (size_t i = 0; i < gn_at_size(&array) && !g->failed; i++) {
            gn_at_item(g, &array, i);
            if (gn_gltf_spare(g, "taken as empty"))
                json_array_set_new(array.json, i, json_object());
        }
    }
}

bool gn_gltf_check_support(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), asset = gn_at_object(g, &root, "asset");
    const char *version = gn_at_text(g, &asset, "version");
    const char *least = gn_at_text(g, &asset, "minVersion");
    struct gn_at version_at = gn_at_any(&asset, "version"),
                 least_at = gn_at_any(&asset, "minVersion");
    if (g->failed) return false;
    if (!version) return gn_gltf_fail(g, &version_at, "missing; only glTF 2.0 is read");
    char *end = NULL;
    if (strtol(version, &end, 10) != 2 || *end != '.')
        return gn_gltf_fail(g, &version_at, "'%.20s'; only glTF 2.0 is read: export it again",
                            version);
    if (least && strcmp(least, "2.0") != 0)
        return gn_gltf_fail(g, &least_at, "'%.20s'; only glTF 2.0 is read", least);

    struct gn_at required = gn_at_array(g, &root, "extensionsRequired");
    for (size_t i = 0; i < gn_at_size(&required); i++) {
        struct gn_at at = gn_at_element(&required, i);
        const char *name = json_string_value(at.json), *cure = "export the scene without it";
        if (!name) return gn_gltf_fail(g, &at, "must be a string");
        for (size_t k = 0; k < sizeof CURES / sizeof CURES[0]; k++)
            if (strcmp(CURES[k].extension, name) == 0) cure = CURES[k].what_to_do;
        if (!gn_gltf_supports(name))
            return gn_gltf_fail(g, &at, "%.80s is not supported; %s", name, cure);
    }
    if (!g->failed) check_arrays(g);
    return !g->failed;
}
