/* A .glb under construction: JSON by jansson and one binary chunk. Running out of memory ends the
 * process (gn_import_no_memory). */
#ifndef GN_IMPORT_GLB_H
#define GN_IMPORT_GLB_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_glb {
    json_t *root;
    uint8_t *bin;
    size_t size, room;
};

enum gn_glb_component {
    GN_GLB_I8 = 5120,
    GN_GLB_U8,
    GN_GLB_I16,
    GN_GLB_U16,
    GN_GLB_U32 = 5125,
    GN_GLB_F32 = 5126
};
struct gn_glb_accessor {
    const void *data;
    size_t count;
    int width; /* components per element: 1 to 4 */
    enum gn_glb_component component;
    bool indices;    /* index buffer; otherwise a vertex attribute */
    bool normalized; /* integers represent 0..1 */
    bool bounds;     /* write min and max; floats only */
};

void gn_glb_init(struct gn_glb *glb);

/* Appends an item to an array of the root, creating the array if needed. Takes ownership of the
 * item; returns its index. */
int gn_glb_add(struct gn_glb *glb, const char *array, json_t *item);
/* A copy of these bytes in the binary chunk, at a multiple of 4, which is returned. */
size_t gn_glb_append(struct gn_glb *glb, const void *data, size_t size);
/* Adds a bufferView with a copy of these bytes; returns its index. */
int gn_glb_view(struct gn_glb *glb, const void *data, size_t size);
/* Adds a bufferView and an accessor on it; returns the accessor's index. Floats must be finite. */
int gn_glb_accessor(struct gn_glb *glb, const struct gn_glb_accessor *accessor);
json_t *gn_glb_floats(const float *values, int count);
/* A JSON string; bytes that are not UTF-8 become question marks. */
json_t *gn_glb_text(const char *text);
/* Adds the extension to extensionsUsed; returns its object in the root. */
json_t *gn_glb_extension(struct gn_glb *glb, const char *name);

/* Writes the complete file. Fails when the descriptor cannot be written. */
bool gn_glb_write(struct gn_glb *glb, int fd, struct gn_err *err);

#endif
