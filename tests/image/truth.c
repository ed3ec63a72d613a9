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
enum { VERSION = 1 };

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

/* --- contacts --- */

static double apart(const float *a, const float *b) {
    return sqrt((double)(a[0] - b[0]) * (a[0] - b[0]) + (double)(a[1] - b[1]) * (a[1] - b[1]) +
                (double)(a[2] - b[2]) * (a[2] - b[2]));
}

/* Next to each other on the screen and, but for slant, in the world: within six pixels' size. */
static bool is_contact(const struct gn_truth *truth, int x, int y) {
    const struct gn_mask_truth *m = &truth->mask;
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    size_t i = (size_t)y * m->width_px + x;
    if (m->item[i] < 0 || m->lit[i] || gn_truth_facing(truth, i) <= 0) return false;
    const float *f = &m->point_ws[3 * i];
    double near = 6 * gn_ray_eye_pixel_m(&truth->frame.eye, (double[3]){f[0], f[1], f[2]});
    for (int n = 0; n < 4; n++) {
        int u = x + step[n][0], v = y + step[n][1];
        if (u < 0 || v < 0 || u >= m->width_px || v >= m->height_px) continue;
        size_t j = (size_t)v * m->width_px + u;
        if (m->item[j] >= 0 && gn_truth_facing(truth, j) < 0 &&
            apart(f, &m->point_ws[3 * j]) < near)
            return true;
    }
    return false;
}

/* Where the shot is dark as it should be, on surfaces that face the light: in the light's plane,
 * with the item. */
struct shade {
    double at[2];
    int32_t item;
};

static size_t find_shades(const struct gn_truth *truth, const struct gn_picture *shot,
                          struct shade *out) {
    const struct gn_mask_truth *m = &truth->mask;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)m->width_px * m->height_px; i++) {
        if (m->item[i] < 0 || m->lit[i] || gn_truth_facing(truth, i) <= 0) continue;
        if (shot->data[i * shot->channels] >= .5f) continue;
        out[count].item = m->item[i];
        count += gn_truth_plane(&truth->frame, &m->point_ws[3 * i], out[count].at);
    }
    return count;
}

static double contact_gap(const struct gn_truth *truth, const struct shade *shades, size_t count,
                          size_t i) {
    double at[2], best = INFINITY;
    if (!gn_truth_plane(&truth->frame, &truth->mask.point_ws[3 * i], at)) return 0;
    for (size_t j = 0; j < count; j++)
        if (shades[j].item == truth->mask.item[i])
            best = fmin(best, hypot(shades[j].at[0] - at[0], shades[j].at[1] - at[1]));
    return best;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void gn_truth_contact(const struct gn_truth *truth, const struct gn_picture *shot, unsigned map_px,
                      struct gn_contact *contact) {
    const struct gn_mask_truth *m = &truth->mask;
    size_t count = (size_t)m->width_px * m->height_px;
    double *gaps = gn_xalloc(count, sizeof *gaps), texel = gn_truth_texel(truth, map_px), sum = 0;
    struct shade *shades = gn_xalloc(count, sizeof *shades);
    size_t shade_count = find_shades(truth, shot, shades);
    *contact = (struct gn_contact){0};
    for (size_t i = 0; i < count; i++) {
        if (!is_contact(truth, (int)(i % m->width_px), (int)(i / m->width_px))) continue;
        bool shown = shot->data[i * shot->channels] >= .5f;
        double gap = shown ? contact_gap(truth, shades, shade_count, i) / texel : 0;
        gaps[contact->contacts++] = gap;
        sum += gap;
    }
    if (contact->contacts) {
        qsort(gaps, contact->contacts, sizeof *gaps, by_size);
        contact->mean = sum / contact->contacts;
        contact->p99 = gaps[(int)(.99 * (contact->contacts - 1) + .5)];
        contact->worst = gaps[contact->contacts - 1];
    }
    free(shades);
    free(gaps);
}
