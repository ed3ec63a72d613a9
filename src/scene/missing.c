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

bool gn_missing_list(struct gn_gltf *g) {
    char list[500] = "";
    for (size_t i = 0, at = 0; i < GN_MISSING_COUNT; i++)
        if (g->is_missing[i] && at < sizeof list)
            at += (size_t)snprintf(list + at, sizeof list - at, "%s%s", at > 0 ? ", " : "",
                                   rows[i].words);
    g->scene->missing = gn_gltf_strdup(g, list);
    if (list[0]) gn_gltf_warn(g, NULL, "shown without %s: not supported yet", list);
    return !g->failed;
}
