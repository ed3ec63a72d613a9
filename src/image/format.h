/* The formats of pictures, and reading one at its size or smaller. */
#ifndef GN_IMAGE_FORMAT_H
#define GN_IMAGE_FORMAT_H

#include "image/read.h"
#include "image/scale.h"

enum gn_format { GN_FORMAT_PNG, GN_FORMAT_JPEG, GN_FORMAT_WEBP, GN_FORMAT_KTX2, GN_FORMAT_OTHER };
#define GN_FORMAT_OTHER_TEXT "neither PNG, JPEG, WebP nor KTX2"
enum { GN_FORMAT_HEAD_BYTES = 12 }; /* that identify the format */

/* By the first bytes; NULL is another. */
enum gn_format gn_format_of(const void *data, size_t size);
const char *gn_format_mime(enum gn_format kind); /* not of another */

struct gn_picture_file {
    enum gn_format kind; /* not another */
    const uint8_t *data;
    size_t size;
    uint32_t px[2]; /* filled by gn_picture_size */
    uint32_t rows;  /* that are decoded, where gn_picture_can_stop; what the others would be has the
                       mean colour of these. 0: all */
};
bool gn_picture_can_stop(const struct gn_picture_file *file); /* after some rows */
bool gn_picture_size(struct gn_picture_file *file, struct gn_err *err);
/* The largest shrink of read.h that helps its decoder: 0 where it reads by rows. */
uint32_t gn_picture_most_shrink(const struct gn_picture_file *file);
/* The time of decoding a texel: 1, or 2 where it takes about twice as long as others. */
uint32_t gn_picture_cost(const struct gn_picture_file *file);
/* Bytes that gn_picture_decode takes beside the pixels. */
uint64_t gn_picture_work_bytes(const struct gn_picture_file *file, const uint32_t to[2],
                               uint32_t shrink);
/* RGBA of that size. Where it is smaller than the file's, the decoder first leaves out `shrink`
 * halvings, the fewer the better, then the average is taken (scale.h): no side of `to` is larger
 * than gn_shrunk_px. */
bool gn_picture_decode(const struct gn_picture_file *file, uint32_t shrink, enum gn_scale_kind kind,
                       uint8_t *rgba, const uint32_t to[2], struct gn_err *err);

#endif
