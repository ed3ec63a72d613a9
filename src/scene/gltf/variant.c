/* KHR_materials_variants: their names, and the materials of a primitive in each. */
#include "scene/private.h"

#include <string.h>

#define VARIANTS "extensions.KHR_materials_variants"

bool gn_gltf_variants(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), list = gn_at_array(g, &root, VARIANTS ".variants");
    struct gn_scene_variants *variants = &g->scene->variants;
    size_t count = gn_at_size(&list);
    gn_gltf_spare(g, "ignored");
    if (count > GN_VARIANTS_MAX) {
        gn_gltf_warn(g, &list, "%zu; only the first %d can be chosen", count, GN_VARIANTS_MAX);
        count = GN_VARIANTS_MAX;
    }
    GN_NEW(g, g->memory.scene, variants->names, count);
    for (size_t i = 0; i < count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&list, i);
        variants->names[i] = gn_gltf_strdup(g, gn_at_name(g, &at));
        variants->count++;
    }
    return !g->failed;
}

size_t gn_gltf_variant_most(struct gn_gltf *g, const struct gn_at *primitive) {
    struct gn_at mappings = gn_at_array(g, primitive, VARIANTS ".mappings");
    const size_t count = gn_at_size(&mappings);
    gn_gltf_spare(g, "ignored");
    return 1 + (count < g->scene->variants.count ? count : g->scene->variants.count);
}

/* The bits of the variants of a mapping; a variant that an earlier mapping has stays with that. */
static uint64_t read_bits(struct gn_gltf *g, const struct gn_at *mapping, uint64_t taken) {
    struct gn_at root = gn_at_root(g), all = gn_at_array(g, &root, VARIANTS ".variants");
    struct gn_at list = gn_at_array(g, mapping, "variants");
    uint64_t bits = 0;
    for (size_t i = 0; i < gn_at_size(&list) && !g->failed; i++) {
        struct gn_at at = gn_at_element(&list, i);
        const int32_t variant = gn_at_ref_here(g, &at, gn_at_size(&all), "variants");
        gn_gltf_spare(g, "ignored");
        if (variant >= 0 && (uint32_t)variant < g->scene->variants.count)
            bits |= UINT64_C(2) << variant;
    }
    return bits & ~taken;
}

size_t gn_gltf_variant_materials(struct gn_gltf *g, const struct gn_at *primitive,
                                 struct gn_variant_material *out) {
    struct gn_at mappings = gn_at_array(g, primitive, VARIANTS ".mappings");
    gn_gltf_spare(g, "ignored");
    uint64_t taken = 1;
    size_t count = 1;
    out[0].material =
        gn_at_spare_ref(g, primitive, "material", g->file.material_count, "materials");
    for (size_t i = 0; i < gn_at_size(&mappings) && !g->failed; i++) {
        struct gn_at mapping = gn_at_item(g, &mappings, i);
        const int32_t material =
            gn_at_ref(g, &mapping, "material", g->file.material_count, "materials");
        const uint64_t bits = g->failed ? 0 : read_bits(g, &mapping, taken);
        if (gn_gltf_spare(g, "ignored") || !bits) continue;
        taken |= bits;
        size_t at = 0;
        while (at < count && out[at].material != material) at++;
        if (at == count) out[count++] = (struct gn_variant_material){.material = material};
        if (at > 0) out[at].in |= bits;
    }
    uint64_t others = 0;
    for (size_t i = 1; i < count; i++) others |= out[i].in;
    out[0].in = ~others;
    return count;
}

/* The items of a primitive follow each other, material by material, as many of each as its node has
 * instances. */
void gn_gltf_variant_planes(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        const uint32_t instances = g->placed[item->node].instance_count;
        const uint32_t copies = item->skin < 0 && instances > 0 ? instances : 1;
        const bool follows = i >= copies && scene->items[i - copies].node == item->node;
        if (follows && item->hidden_in & 1) item->plane = scene->items[i - copies].plane;
    }
}
