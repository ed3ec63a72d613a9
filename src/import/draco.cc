#include "import/draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

namespace {

const draco::Mesh *mesh_of(const struct gn_draco *draco) {
    return static_cast<const draco::Mesh *>(draco->mesh);
}

template <typename T>
bool read_attribute(const draco::Mesh &mesh, const draco::PointAttribute &attribute, int width,
                    size_t stride, void *out) {
    for (uint32_t i = 0; i < mesh.num_points(); i++) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        T *to = reinterpret_cast<T *>(static_cast<uint8_t *>(out) + i * stride);
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(value, static_cast<int8_t>(width), to))
            return false;
    }
    return true;
}

} // namespace

bool gn_draco_open(struct gn_draco *draco, const void *data, size_t size, const char **why) {
    *why = "the Draco-compressed data is damaged";
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(static_cast<const char *>(data), size);
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) return false;
        draco::Mesh *mesh = std::move(decoded).value().release();
        draco->mesh = mesh;
        draco->point_count = mesh->num_points();
        draco->triangle_count = mesh->num_faces();
        return true;
    } catch (const std::bad_alloc &) {
        *why = "the Draco-compressed data needs more memory than the limit";
        return false;
    } catch (...) {
        return false;
    }
}

void gn_draco_close(struct gn_draco *draco) {
    delete mesh_of(draco);
    draco->mesh = nullptr;
}

void gn_draco_indices(const struct gn_draco *draco, uint32_t *out) {
    for (uint32_t i = 0; i < draco->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            out[3 * i + k] = mesh_of(draco)->face(draco::FaceIndex(i))[k].value();
}

bool gn_draco_attribute(const struct gn_draco *draco, uint32_t id, int component, int width,
                        size_t stride, void *out) {
    const draco::Mesh &mesh = *mesh_of(draco);
    const draco::PointAttribute *attribute = mesh.GetAttributeByUniqueId(id);
    if (!attribute || width < 1 || width > 4) return false;
    switch (component) {
    case 5120: return read_attribute<int8_t>(mesh, *attribute, width, stride, out);
    case 5121: return read_attribute<uint8_t>(mesh, *attribute, width, stride, out);
    case 5122: return read_attribute<int16_t>(mesh, *attribute, width, stride, out);
    case 5123: return read_attribute<uint16_t>(mesh, *attribute, width, stride, out);
    case 5125: return read_attribute<uint32_t>(mesh, *attribute, width, stride, out);
    case 5126: return read_attribute<float>(mesh, *attribute, width, stride, out);
    default: return false;
    }
}
