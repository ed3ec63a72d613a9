#include "scene/attribute.h"

#include "scene/private.h"

#define BIT(component) (1u << ((component)-GN_I8))
enum {
    TYPES_SIGNED = BIT(GN_F32) | BIT(GN_I8) | BIT(GN_I16),
    TYPES_UNSIGNED = BIT(GN_F32) | BIT(GN_U8) | BIT(GN_U16),
    TYPES_ANY = TYPES_SIGNED | TYPES_UNSIGNED,
};

const struct gn_attribute_row gn_attributes[GN_ATTRIBUTE_COUNT] = {
#define GN_X(NAME, name, type, field, semantic, least, components, types, format, missing)         \
    [GN_ATTRIBUTE_##NAME] = {#name,                                                                \
                             semantic,                                                             \
                             least,                                                                \
                             components,                                                           \
                             TYPES_##types,                                                        \
                             GN_ATTRIBUTE_##format,                                                \
                             missing,                                                              \
                             (components) * sizeof(type),                                          \
                             GN_GPU_BYTES_##format(components)},
    GN_ATTRIBUTES(GN_X)
#undef GN_X
};
_Static_assert(offsetof(struct gn_scene_buffers, colors) ==
                   offsetof(struct gn_scene_buffers, attributes[GN_ATTRIBUTE_COLOR]),
               "the arrays by name are those by number");

uint32_t gn_scene_vertex_bytes(const struct gn_scene *scene) {
    uint32_t bytes = 0;
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++)
        if (scene->buffers.attributes[i]) bytes += gn_attributes[i].gpu_bytes;
    return bytes;
}
