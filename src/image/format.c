#include "image/format.h"

#include <stdlib.h>
#include <string.h>

#include "image/ktx2.h"

static uint64_t png_row_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    return gn_png_work_bytes(data, size, px) + UINT64_C(4) * px[0];
}

static bool png_all_rows(const uint8_t *data, size_t size, const uint32_t px[2],
                         gn_picture_row *row, void *user, struct gn_err *err) {
    return gn_png_rows(data, size, px, px[1], row, user, err);
}

static const struct format {
    const char *magic, *form, *mime; /* first bytes, and those from byte 8 on */
    size_t magic_size;
    bool (*size)(const uint8_t *, size_t, uint32_t[2], struct gn_err *);
    uint64_t (*work_bytes)(const uint8_t *, size_t, const uint32_t[2]);
    bool (*read)(const uint8_t *, size_t, const uint32_t[2], uint32_t, uint8_t *, struct gn_err *);
    /* by rows, or NULL */
    uint64_t (*row_bytes)(const uint8_t *, size_t, const uint32_t[2]);
    bool (*rows)(const uint8_t *, size_t, const uint32_t[2], gn_picture_row *, void *,
                 struct gn_err *);
} FORMATS[] = {
    {"\x89PNG\r\n\x1a\n", "", "image/png", 8, gn_png_size, gn_png_work_bytes, gn_png_read,
     png_row_bytes, png_all_rows},
    {"\xff\xd8\xff", "", "image/jpeg", 3, gn_jpeg_size, gn_jpeg_work_bytes, gn_jpeg_read, NULL,
     NULL},
    {"RIFF", "WEBP", "image/webp", 4, gn_webp_size, gn_webp_work_bytes, gn_webp_read, NULL, NULL},
    {GN_KTX2_MAGIC, "", "image/ktx2", 12, gn_ktx2_size, gn_ktx2_work_bytes, gn_ktx2_read,
     gn_ktx2_row_bytes, gn_ktx2_rows},
};

enum gn_format gn_format_of(const void *data, size_t size) {
    enum gn_format i = GN_FORMAT_PNG;
    for (; data && i < GN_FORMAT_OTHER; i++) {
        const struct format *f = &FORMATS[i];
        const size_t form_size = strlen(f->form);
        if (size >= (form_size > 0 ? 8 + form_size : f->magic_size) &&
            memcmp(data, f->magic, f->magic_size) == 0 &&
            memcmp((const char *)data + (form_size > 0 ? 8 : 0), f->form, form_size) == 0)
            return i;
    }
    return GN_FORMAT_OTHER;
}

const char *gn_format_mime(enum gn_format kind) { return FORMATS[kind].mime; }

bool gn_picture_size(struct gn_picture_file *file, struct gn_err *err) {
    return FORMATS[file->kind].size(file->data, file->size, file->px, err);
}

static bool has_rows(const struct gn_picture_file *file) {
    return FORMATS[file->kind].rows &&
           (file->kind != GN_FORMAT_PNG || !gn_png_is_interlaced(file->data));
}

bool gn_picture_can_stop(const struct gn_picture_file *file) {
    return has_rows(file) && file->kind == GN_FORMAT_PNG;
}

uint32_t gn_picture_most_shrink(const struct gn_picture_file *file) {
    return has_rows(file) ? 0 : GN_SHRINK_MOST;
}

uint32_t gn_picture_cost(const struct gn_picture_file *file) {
    const bool deep = file->kind == GN_FORMAT_PNG && gn_png_is_deep(file->data);
    return deep || file->kind == GN_FORMAT_WEBP ? 2 : 1;
}

static bool is_whole(const struct gn_picture_file *file, const uint32_t to[2]) {
    return file->px[0] == to[0] && file->px[1] == to[1];
}

uint64_t gn_picture_work_bytes(const struct gn_picture_file *file, const uint32_t to[2],
                               uint32_t shrink) {
    const struct format *f = &FORMATS[file->kind];
    if ((!is_whole(file, to) && has_rows(file)) || file->rows > 0)
        return f->row_bytes(file->data, file->size, file->px) + gn_scaler_bytes(to);
    const uint64_t bytes = f->work_bytes(file->data, file->size, file->px);
    return is_whole(file, to) ? bytes
                              : bytes + gn_shrunk_bytes(file->px, shrink) + gn_scaler_bytes(to);
}

static bool read_to_scale(const struct gn_picture_file *file, uint32_t shrink,
                          struct gn_scaler *scaler, struct gn_err *err) {
    const struct format *f = &FORMATS[file->kind];
    uint8_t *rgba = malloc(gn_shrunk_bytes(file->px, shrink));
    const bool done = rgba ? f->read(file->data, file->size, file->px, shrink, rgba, err)
                           : gn_fail(err, "out of memory");
    for (uint32_t y = 0; done && y < scaler->from[1]; y++)
        gn_scaler_row(scaler, rgba + (size_t)4 * scaler->from[0] * y);
    free(rgba);
    return done;
}

/* The mean of so many texels, in all that follow. */
static void fill_mean(uint8_t *rgba, size_t read, size_t all) {
    uint64_t sums[4] = {0};
    for (size_t i = 0; i < 4 * read; i++) sums[i % 4] += rgba[i];
    for (size_t i = 4 * read; i < 4 * all; i++) rgba[i] = (uint8_t)(sums[i % 4] / read);
}

static bool decode_top(const struct gn_picture_file *file, enum gn_scale_kind kind, uint8_t *rgba,
                       const uint32_t to[2], struct gn_err *err) {
    struct gn_scaler scaler;
    const uint32_t from[] = {file->px[0], file->rows};
    uint32_t top[] = {to[0], (uint32_t)((uint64_t)to[1] * file->rows / file->px[1])};
    if (top[1] == 0) top[1] = 1;
    if (!gn_scaler_init(&scaler, from, kind, rgba, top)) return gn_fail(err, "out of memory");
    const bool done =
        gn_png_rows(file->data, file->size, file->px, file->rows, gn_scaler_row, &scaler, err);
    gn_scaler_finish(&scaler);
    if (done) fill_mean(rgba, (size_t)top[0] * top[1], (size_t)to[0] * to[1]);
    return done;
}

bool gn_picture_decode(const struct gn_picture_file *file, uint32_t shrink, enum gn_scale_kind kind,
                       uint8_t *rgba, const uint32_t to[2], struct gn_err *err) {
    const struct format *f = &FORMATS[file->kind];
    if (file->rows > 0) return decode_top(file, kind, rgba, to, err);
    if (is_whole(file, to)) return f->read(file->data, file->size, file->px, 0, rgba, err);
    struct gn_scaler scaler;
    const uint32_t from[] = {gn_shrunk_px(file->px[0], shrink), gn_shrunk_px(file->px[1], shrink)};
    if (!gn_scaler_init(&scaler, from, kind, rgba, to)) return gn_fail(err, "out of memory");
    const bool done = has_rows(file)
                          ? f->rows(file->data, file->size, file->px, gn_scaler_row, &scaler, err)
                          : read_to_scale(file, shrink, &scaler, err);
    gn_scaler_finish(&scaler);
    return done;
}
