/* What a file asks for and is shown without: one list, for the warning at load, `inspect`, `ctl
 * status` and the information page. */
#include "scene/private.h"

#include <string.h>

static const struct {
    const char *words, *extension;
} rows[GN_MISSING_COUNT] = {
#define GN_X(NAME, words, extension) [GN_MISSING_##NAME] = {words, extension},
    GN_MISSING(GN_X)
#undef GN_X
};

void gn_missing_of_material(struct gn_gltf *g, const struct gn_at *material) {
    struct gn_at all = gn_at_any(material, "extensions");
    for (size_t i = 0; i < GN_MISSING_COUNT && json_is_object(all.json); i++)
        if (rows[i].extension && json_object_get(all.json, rows[i].extension))
            g->is_missing[i] = true;
}

/* Whether a reader, or a row of the list, stands for the extension; or it changes no picture. */
static bool is_known(const char *name) {
    static const char *const others[] = {"KHR_draco_mesh_compression", "KHR_materials_volume",
                                         "KHR_xmp_json_ld", "KHR_xmp"};
    for (size_t i = 0; i < GN_MISSING_COUNT; i++)
        if (rows[i].extension && strcmp(rows[i].extension, name) == 0) return true;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(others[i], name) == 0) return true;
    return gn_gltf_supports(name);
}

static void add_name(char *list, size_t size, const char *name) {
    const size_t at = strlen(list);
    snprintf(list + at, size - at, "%s%.60s", at > 0 ? ", " : "", name);
}

bool gn_missing_list(struct gn_gltf *g) {
    char list[500] = "";
    const json_t *added[sizeof list / 3 + 1]; /* a name takes three bytes at least */
    size_t count = 0;
    for (size_t i = 0; i < GN_MISSING_COUNT; i++)
        if (g->is_missing[i]) add_name(list, sizeof list, rows[i].words);
    const json_t *used = json_object_get(g->file.json, "extensionsUsed");
    for (size_t i = 0; i < json_array_size(used) && strlen(list) + 1 < sizeof list; i++) {
        const char *name = json_string_value(json_array_get(used, i));
        bool is_new = name && *name && !is_known(name);
        for (size_t k = 0; k < count && is_new; k++)
            is_new = !json_equal(added[k], json_array_get(used, i));
        if (!is_new) continue;
        added[count++] = json_array_get(used, i);
        add_name(list, sizeof list, name);
    }
    for (char *c = list; *c; c++)
        if ((unsigned char)*c < ' ' || (unsigned char)*c >= 127) *c = '?'; /* a file's names */
    g->scene->missing = gn_gltf_strdup(g, list);
    if (list[0]) gn_gltf_warn(g, NULL, "shown without %s: not supported yet", list);
    return !g->failed;
}
