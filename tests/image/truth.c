#include "image/truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "core/file.h"
#include "core/hash.h"

/* Part of the cache's key: raise it when the ray caster's answers or the layout change. */
enum { VERSION = 3 };

struct header {
    char magic[8];
    uint32_t version, pixel_bytes;
    struct gn_truth_frame frame;
};

/* --- keeping --- */

static void cache_path(const struct gn_bytes *file, const struct gn_truth_opts *o, char *path,
                       size_t size) {
    uint64_t hash = gn_hash(GN_HASH_INIT, file->data, file->size);
    snprintf(path, size, "build/truth-cache/%016llx-%dx%d-%u-%u.v%d", (unsigned long long)hash,
             o->width_px, o->height_px, o->camera, o->light, VERSION);
}

static bool read_cache(struct gn_truth *truth, const char *path, const struct gn_truth_opts *o) {
    struct gn_bytes bytes;
    struct header header;
    size_t want =
        sizeof header + (size_t)o->width_px * o->height_px * sizeof(struct gn_truth_pixel);
    if (!gn_file_read(path, want, &bytes, NULL)) return false;
    bool ok = bytes.size == want;
    if (ok) memcpy(&header, bytes.data, sizeof header);
    ok = ok && !memcmp(header.magic, "gntruth", 8) && header.version == VERSION &&
         header.pixel_bytes == sizeof(struct gn_truth_pixel);
    if (ok)
        gn_truth_unpack(truth, &header.frame,
                        (const struct gn_truth_pixel *)(bytes.data + sizeof header));
    truth->cached = ok;
    gn_bytes_finish(&bytes);
    return ok;
}

static void write_cache(const struct gn_truth_frame *frame, const struct gn_truth_pixel *pixels,
                        const char *path) {
    size_t count = (size_t)frame->eye.width_px * frame->eye.height_px;
    struct header header = {"gntruth", VERSION, sizeof *pixels, *frame};
    uint8_t *bytes = gn_xalloc(1, sizeof header + count * sizeof *pixels);
    memcpy(bytes, &header, sizeof header);
    memcpy(bytes + sizeof header, pixels, count * sizeof *pixels);
    mkdir("build", 0777);
    mkdir("build/truth-cache", 0777);
    gn_file_write(path, bytes, sizeof header + count * sizeof *pixels, NULL);
    free(bytes);
}

bool gn_truth_load(struct gn_truth *truth, const char *scene_path, const struct gn_truth_opts *opts,
                   struct gn_err *err) {
    struct gn_truth_opts o = gn_truth_fill(opts);
    struct gn_bytes file;
    char path[256];
    *truth = (struct gn_truth){0};
    if (!gn_file_read(scene_path, 0, &file, err)) return false;
    cache_path(&file, &o, path, sizeof path);
    gn_bytes_finish(&file);
    if (!o.no_cache && read_cache(truth, path, &o)) return true;

    struct gn_scene *scene = gn_scene_load(scene_path, NULL, NULL, err);
    if (!scene) return false;
    struct gn_truth_pixel *pixels = gn_xalloc((size_t)o.width_px * o.height_px, sizeof *pixels);
    struct gn_truth_frame frame = {0};
    bool ok =
        gn_truth_cast(&frame, pixels, scene, &o, err) || gn_fail_prefix(err, "%s", scene_path);
    if (ok && !o.no_cache) write_cache(&frame, pixels, path);
    if (ok) gn_truth_unpack(truth, &frame, pixels);
    free(pixels);
    gn_scene_destroy(scene);
    return ok;
}
