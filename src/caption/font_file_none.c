#include "caption/font.h"

static bool fail(struct gn_err *err) {
    return gn_fail(
        err, "this gnomon was built without FreeType (libfreetype-dev), so it reads no fonts");
}

struct gn_font *gn_font_open_bytes(const uint8_t *data, size_t size, struct gn_err *err) {
    (void)data, (void)size;
    fail(err);
    return NULL;
}

struct gn_font *gn_font_open_in(const char *path, const char *folder, struct gn_err *err) {
    (void)folder;
    fail(err);
    if (path) gn_fail_prefix(err, "%s", path);
    return NULL;
}

struct gn_font *gn_font_open_file(const char *path, struct gn_err *err) {
    return gn_font_open_in(path, "", err);
}
