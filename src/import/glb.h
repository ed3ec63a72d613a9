/* A .glb in the making: JSON by jansson, one binary chunk. Want of memory ends the process
 * (gn_import_no_memory). */
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

enum gn_glb_component { GN_GLB_U8 = 5121, GN_GLB_U16 = 5123, GN_GLB_U32 = 5125, GN_GLB_F32 = 5126 };
struct gn_glb_accessor {
    const void *data;
    size_t count;
    int width; /* components of an element: 1 to 4 */
    enum gn_glb_component component;
    bool indices;    /* else attributes of vertices */
    bool normalized; /* integers stand for 0..1 */
    bool bounds;     /* write min and max; floats only */
};

void gn_glb_init(struct gn_glb *glb);
void gn_glb_finish(struct gn_glb *glb);

/* Appends to an array of the root, made when it is not there; takes the item; returns its index. */
int gn_glb_add(struct gn_glb *glb, const char *array, json_t *item);
/* A bufferView of a copy of these bytes; returns its index. */
int gn_glb_view(struct gn_glb *glb, const void *data, size_t size);
/* The same with an accessor on it; returns the accessor's index. All floats must be finite. */
int gn_glb_accessor(struct gn_glb *glb, const struct gn_glb_accessor *accessor);
json_t *gn_glb_floats(const float *values, int count);
/* A string of any bytes: what is not UTF-8 becomes question marks. */
json_t *gn_glb_text(const char *text);
/* Says that the file uses an extension; returns its object in the root. */
json_t *gn_glb_extension(struct gn_glb *glb, const char *name);

/* Writes the whole. False when the descriptor takes no more; err says why. */
bool gn_glb_write(struct gn_glb *glb, int fd, struct gn_err *err);

#endif
