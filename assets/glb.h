/* shape/glb.h, with pictures of paint.h and files. */
#ifndef GN_ASSETS_GLB_H
#define GN_ASSETS_GLB_H

#include "shape/glb.h"

struct gn_image;

/* Stores the picture as PNG; filtering is trilinear. */
int gn_glb_texture(struct gn_glb *glb, const char *name, const struct gn_image *image,
                   enum gn_glb_wrap wrap);
/* Returns false, with a message on stderr, if the file cannot be written. */
bool gn_glb_write(struct gn_glb *glb, const char *path);

#endif
