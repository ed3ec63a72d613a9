#include "glb.h"

#include "paint.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int gn_glb_texture(struct gn_glb *glb, const char *name, const struct gn_image *image,
                   enum gn_glb_wrap wrap) {
    size_t size;
    void *png = gn_image_png(image, &size);
    const int texture = gn_glb_picture(glb, name, png, size, wrap);
    free(png);
    return texture;
}

bool gn_glb_write(struct gn_glb *glb, const char *path) {
    struct gn_bytes bytes;
    gn_glb_build(glb, &bytes);
    FILE *file = fopen(path, "wb");
    if (file) fwrite(bytes.data, 1, bytes.size, file);
    free(bytes.data);
    bool ok = file && !ferror(file);
    if (file && fclose(file)) ok = false;
    if (!ok) fprintf(stderr, "%s: cannot write the scene: %s\n", path, strerror(errno));
    return ok;
}
