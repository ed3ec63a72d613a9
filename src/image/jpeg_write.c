#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "image/write.h"

enum { QUALITY = 92 };

bool gn_picture_encode_jpeg(const uint8_t *rgba, int width_px, int height_px, struct gn_bytes *out,
                            struct gn_err *err) {
    tjhandle handle = tjInitCompress();
    unsigned char *data = NULL;
    unsigned long size = 0;
    *out = (struct gn_bytes){0};
    bool done = handle &&
                tjCompress2(handle, rgba, width_px, 0, height_px, TJPF_RGBA, &data, &size,
                            TJSAMP_444, QUALITY, TJFLAG_ACCURATEDCT) == 0 &&
                data;
    if (!done) gn_fail(err, "JPEG: %s", tjGetErrorStr2(handle));
    if (done) {
        *out = (struct gn_bytes){.data = malloc(size), .size = size};
        done = out->data || gn_fail(err, "JPEG: out of memory");
    }
    if (out->data && data) memcpy(out->data, data, size);
    tjFree(data);
    if (handle) tjDestroy(handle);
    return done;
}
