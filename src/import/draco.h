/* One mesh of KHR_draco_mesh_compression, decoded by libdraco (draco.cc, the only C++ here); a
 * build without it has draco_none.c. May crash on hostile data: see worker.c. */
#ifndef GN_IMPORT_DRACO_H
#define GN_IMPORT_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct gn_draco {
    void *mesh;
    uint32_t point_count, triangle_count;
};

/* False: *why says why not; a text that stays. */
bool gn_draco_open(struct gn_draco *draco, const void *data, size_t size, const char **why);
void gn_draco_close(struct gn_draco *draco);

/* Three for each triangle. */
void gn_draco_indices(const struct gn_draco *draco, uint32_t *out);
/* The attribute of that unique id, width values of the component (glTF's number) for each point,
 * which begin stride bytes apart in out. False: there is none, or it does not fit the component. */
bool gn_draco_attribute(const struct gn_draco *draco, uint32_t id, int component, int width,
                        size_t stride, void *out);

#ifdef __cplusplus
}
#endif
#endif
