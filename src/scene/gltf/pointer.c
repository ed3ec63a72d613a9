/* KHR_animation_pointer: which things animations name beside nodes' transforms, before the things
 * are read. Each gets a record (scene/property.h), which whoever reads the thing fills. */
#include "scene/private.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *prefix;
    enum gn_thing thing;
} arrays[] = {{"/extensions/KHR_lights_punctual/lights/", GN_THING_LIGHT},
              {"/cameras/", GN_THING_CAMERA},
              {"/materials/", GN_THING_MATERIAL},
              {"/nodes/", GN_THING_NODE}};

/* A specular-glossiness material has others in their place. */
#define NOT_GLOSSY                                                                                 \
    (GN_MOVES_BASE | GN_MOVES_METAL | GN_MOVES_ROUGH | GN_MOVES_F0 | GN_MOVES_TRANSMISSION |       \
     GN_MOVES_UV)

/* Of the file. */
static size_t count_things(struct gn_gltf *g, enum gn_thing thing) {
    struct gn_at root = gn_at_root(g);
    if (thing == GN_THING_NODE) return g->file.node_count;
    if (thing == GN_THING_MATERIAL) return g->file.material_count;
    struct gn_at list = gn_at_array(
        g, &root, thing == GN_THING_LIGHT ? "extensions.KHR_lights_punctual.lights" : "cameras");
    gn_gltf_spare(g, "ignored");
    return gn_at_size(&list);
}

static bool is_glossy(struct gn_gltf *g, size_t material) {
    struct gn_at root = gn_at_root(g), list = gn_at_array(g, &root, "materials");
    struct gn_at at = gn_at_item(g, &list, material);
    return gn_at_object(g, &at, "extensions.KHR_materials_pbrSpecularGlossiness").json;
}

bool gn_gltf_find_property(struct gn_gltf *g, const char *pointer, struct gn_property *property,
                           uint32_t *index) {
    for (size_t i = 0; pointer && i < sizeof arrays / sizeof *arrays; i++) {
        const size_t length = strlen(arrays[i].prefix);
        if (strncmp(pointer, arrays[i].prefix, length) != 0) continue;
        const char *digits = pointer + length;
        const size_t count = strspn(digits, "0123456789");
        if (count == 0 || count > 9 || (digits[0] == '0' && count > 1)) return false;
        *index = (uint32_t)strtoul(digits, NULL, 10);
        return *index < count_things(g, arrays[i].thing) &&
               gn_property_find(arrays[i].thing, digits + count, property) &&
               !(property->moves & NOT_GLOSSY && is_glossy(g, *index)) && !g->failed;
    }
    return false;
}

static void claim_record(struct gn_gltf *g, const struct gn_property *property, uint32_t index) {
    uint32_t *record = &g->to_scene.record[property->thing][index];
    if (property->thing == GN_THING_MATERIAL) g->to_scene.moves[index] |= property->moves;
    if (property->thing == GN_THING_LIGHT &&
        property->first == offsetof(struct gn_light_record, range_m) / sizeof(float))
        g->to_scene.range_moves[index] = true;
    if (*record) return;
    *record = g->scene->animation.record_floats + 1;
    g->scene->animation.record_floats += gn_record_size(property->thing);
    g->scene->animation.names[property->thing] = true;
}

static void scan_channel(struct gn_gltf *g, const struct gn_at *channel) {
    struct gn_property property;
    uint32_t index;
    struct gn_at target = gn_at_object(g, channel, "target");
    const char *path = gn_at_text(g, &target, "path");
    if (!path || strcmp(path, "pointer") != 0) return;
    const char *pointer = gn_at_text(g, &target, "extensions.KHR_animation_pointer.pointer");
    if (!g->failed && gn_gltf_find_property(g, pointer, &property, &index))
        claim_record(g, &property, index);
}

/* Whether nodes are shown: their records are filled here. */
static void read_visibility(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), nodes = gn_at_array(g, &root, "nodes");
    for (size_t i = 0; i < g->file.node_count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&nodes, i);
        const bool visible = gn_at_flag(g, &at, "extensions.KHR_node_visibility.visible", true);
        const uint32_t record = g->to_scene.record[GN_THING_NODE][i];
        const int32_t n = g->to_scene.node[i];
        if (n < 0 || g->failed) continue;
        g->scene->nodes[n].hidden = !visible;
        g->scene->nodes[n].record = record;
        if (record) g->scene->animation.records[record - 1] = visible;
        g->scene->animation.has_hidden |= !visible || record;
    }
}

bool gn_gltf_pointers(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), animations = gn_at_array(g, &root, "animations");
    struct gn_scene_animation *animation = &g->scene->animation;
    for (int i = 0; i < GN_THING_COUNT; i++)
        g->to_scene.record[i] =
            gn_gltf_alloc(g, &g->memory.load, count_things(g, i), sizeof **g->to_scene.record);
    GN_NEW(g, &g->memory.load, g->to_scene.moves, g->file.material_count);
    g->to_scene.range_moves =
        gn_gltf_alloc(g, &g->memory.load, count_things(g, GN_THING_LIGHT), sizeof(bool));
    for (size_t i = 0; i < gn_at_size(&animations) && !g->failed; i++) {
        struct gn_at at = gn_at_element(&animations, i), list = gn_at_array(g, &at, "channels");
        gn_gltf_spare(g, "not played");
        for (size_t k = 0; k < gn_at_size(&list) && !g->failed; k++) {
            struct gn_at channel = gn_at_item(g, &list, k);
            scan_channel(g, &channel);
            gn_gltf_spare(g, "not played");
        }
    }
    if (g->failed) return false;
    GN_NEW(g, g->memory.scene, animation->records, animation->record_floats);
    if (!g->failed) read_visibility(g);
    return !g->failed;
}

void *gn_gltf_record(struct gn_gltf *g, enum gn_thing thing, size_t index, uint32_t *record) {
    *record = g->to_scene.record[thing][index];
    return *record ? g->scene->animation.records + *record - 1 : NULL;
}
