/* A build without libdraco. */
#include "import/draco.h"

bool gn_draco_open(struct gn_draco *draco, const void *data, size_t size, const char **why) {
    (void)draco, (void)data, (void)size;
    *why = "this gnomon-import was built without libdraco; decompress the file first "
           "(gltf-transform can)";
    return false;
}

void gn_draco_close(struct gn_draco *draco) { (void)draco; }

void gn_draco_indices(const struct gn_draco *draco, uint32_t *out) { (void)draco, (void)out; }

bool gn_draco_attribute(const struct gn_draco *draco, uint32_t id, int component, int width,
                        size_t stride, void *out) {
    (void)draco, (void)id, (void)component, (void)width, (void)stride, (void)out;
    return false;
}
