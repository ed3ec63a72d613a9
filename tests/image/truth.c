#include "image/truth.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "core/file.h"
#include "core/hash.h"

/* Part of the cache's key: raise it when the ray caster's answers or the layout change. */
enum { VERSION = 1 };

struct pixel { /* as cached */
    float normal_ws[3], distance_m;
    int32_t item; /* -1: background */
    uint32_t lit;
};

struct header {
    char magic[8];
    uint32_t version, pixel_bytes;
    struct gn_truth_frame frame;
};

/* --- making --- */

struct job {
    const struct gn_raycast *rays;
    const struct gn_truth_frame *frame;
    struct pixel *pixels;
    atomic_int next_row;
};

static void *cast_rows(void *data) {
    struct job *job = data;
    const struct gn_ray_eye *eye = &job->frame->eye;
    for (int y; (y = atomic_fetch_add(&job->next_row, 1)) < eye->height_px;) {
        for (int x = 0; x < eye->width_px; x++) {
            struct pixel *pixel = &job->pixels[(size_t)y * eye->width_px + x];
            struct gn_ray_surface surface;
            *pixel = (struct pixel){.distance_m = INFINITY, .item = -1, .lit = 1};
            if (!gn_raycast_eye(job->rays, eye, x, y, &surface)) continue;
            pixel->item = (int32_t)surface.item;
            pixel->distance_m = (float)surface.distance_m;
            for (int k = 0; k < 3; k++) pixel->normal_ws[k] = (float)surface.normal_ws[k];
            pixel->lit = gn_raycast_visible(job->rays, &job->frame->lamp, &surface);
        }
    }
    return NULL;
}

static void cast_all(struct job *job, int threads) {
    pthread_t thread[16];
    int started = 0;
    threads = threads < 1 ? 2 : threads > 16 ? 16 : threads;
    while (started < threads - 1 && pthread_create(&thread[started], NULL, cast_rows, job) == 0)
        started++;
    cast_rows(job);
    while (started) pthread_join(thread[--started], NULL);
}

/* --- the light's plane --- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void plane_axes(struct gn_truth_frame *frame) {
    const double *f = frame->lamp.direction_ws;
    double upright[3] = {0, fabs(f[1]) < .999, fabs(f[1]) >= .999};
    double *r = frame->right_ws, *u = frame->up_ws;
    for (int k = 0; k < 3; k++)
        r[k] = f[(k + 1) % 3] * upright[(k + 2) % 3] - f[(k + 2) % 3] * upright[(k + 1) % 3];
    double length = sqrt(dot(r, r));
    for (int k = 0; k < 3; k++) r[k] /= length;
    for (int k = 0; k < 3; k++)
        u[k] = r[(k + 1) % 3] * f[(k + 2) % 3] - r[(k + 2) % 3] * f[(k + 1) % 3];
}

/* Along a spot's axis; from a point light, along the axis of the cube's face. */
static double lamp_depth(const struct gn_ray_lamp *lamp, const double point[3]) {
    double v[3];
    for (int k = 0; k < 3; k++) v[k] = point[k] - lamp->position_ws[k];
    if (lamp->type == GN_LIGHT_POINT) return fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
    return dot(v, lamp->direction_ws);
}

static bool to_plane(const struct gn_truth_frame *frame, const double point[3], double out[2]) {
    bool directional = frame->lamp.type == GN_LIGHT_DIRECTIONAL;
    double v[3], depth = directional ? 1 : lamp_depth(&frame->lamp, point);
    if (depth <= 0) return false;
    for (int k = 0; k < 3; k++) v[k] = point[k] - (directional ? 0 : frame->lamp.position_ws[k]);
    out[0] = dot(v, frame->right_ws) / depth;
    out[1] = dot(v, frame->up_ws) / depth;
    return true;
}

bool gn_truth_plane(const struct gn_truth_frame *frame, const float point_ws[3], double out[2]) {
    return to_plane(frame, (double[3]){point_ws[0], point_ws[1], point_ws[2]}, out);
}

struct window {
    double min[2], max[2];
};

static void window_add(struct window *w, const double p[2]) {
    for (int k = 0; k < 2; k++) {
        w->min[k] = fmin(w->min[k], p[k]);
        w->max[k] = fmax(w->max[k], p[k]);
    }
}

static void window_cut(struct window *w, const struct window *by) {
    for (int k = 0; k < 2; k++) {
        w->min[k] = fmax(w->min[k], by->min[k]);
        w->max[k] = fmin(w->max[k], by->max[k]);
    }
}

static const struct window empty = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
static const struct window endless = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};

static struct window casters_window(const struct gn_raycast *rays,
                                    const struct gn_truth_frame *frame) {
    struct window w = empty;
    for (uint32_t i = 0; i < rays->bvh.triangle_count; i++) {
        const struct gn_bvh_triangle *t = &rays->bvh.triangles[i];
        if (!gn_raycast_casts(t)) continue;
        for (int c = 0; c < 3; c++) {
            double p[2];
            if (!to_plane(frame, t->p[c], p)) return endless; /* reaches behind the spot */
            window_add(&w, p);
        }
    }
    return w;
}

static void point_of(const struct gn_ray_eye *eye, int x, int y, double distance_m, double out[3]) {
    double sx = ((x + .5) / eye->width_px * 2 - 1) * eye->half_width;
    double sy = (1 - (y + .5) / eye->height_px * 2) * eye->half_height;
    double along = eye->orthographic ? sqrt(fmax(0, distance_m * distance_m - sx * sx - sy * sy))
                                     : distance_m / sqrt(1 + sx * sx + sy * sy);
    double aside = eye->orthographic ? 1 : along;
    for (int k = 0; k < 3; k++)
        out[k] = eye->position_ws[k] + along * eye->forward[k] +
                 aside * (sx * eye->right[k] + sy * eye->up[k]);
}

static double fit_extent(const struct gn_raycast *rays, const struct gn_truth_frame *frame,
                         const struct pixel *pixels) {
    const struct gn_ray_eye *eye = &frame->eye;
    if (frame->lamp.type == GN_LIGHT_POINT) return 2;
    struct window seen = empty, window = casters_window(rays, frame);
    for (int y = 0; y < eye->height_px; y++)
        for (int x = 0; x < eye->width_px; x++) {
            const struct pixel *pixel = &pixels[(size_t)y * eye->width_px + x];
            double point[3], p[2];
            if (pixel->item < 0) continue;
            point_of(eye, x, y, pixel->distance_m, point);
            if (to_plane(frame, point, p)) window_add(&seen, p);
        }
    window_cut(&window, &seen);
    if (frame->lamp.type == GN_LIGHT_SPOT) {
        double t = tan(acos(frame->lamp.cos_cone));
        window_cut(&window, &(struct window){{-t, -t}, {t, t}});
    }
    return fmax(0, fmax(window.max[0] - window.min[0], window.max[1] - window.min[1]));
}

static bool make(struct gn_truth_frame *frame, struct pixel *pixels, const struct gn_scene *scene,
                 const struct gn_truth_opts *opts, struct gn_err *err) {
    if (opts->camera >= scene->camera_count || opts->light >= scene->light_count)
        return gn_fail(err, "has no camera %u or no light %u", opts->camera, opts->light);
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_ray_eye_init(&frame->eye, &pose, opts->camera, opts->width_px, opts->height_px);
    gn_ray_lamp_init(&frame->lamp, &pose, opts->light);
    plane_axes(frame);
    struct gn_raycast rays;
    gn_raycast_init(&rays, scene, &pose);
    struct job job = {.rays = &rays, .frame = frame, .pixels = pixels};
    cast_all(&job, opts->threads);
    frame->extent = fit_extent(&rays, frame, pixels);
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    return true;
}

/* --- keeping --- */

/* From the cached form to the arrays of the mask, all in one block. */
static void unpack(struct gn_truth *truth, const struct gn_truth_frame *frame,
                   const struct pixel *pixels) {
    int w = frame->eye.width_px, h = frame->eye.height_px;
    size_t count = (size_t)w * h;
    float *floats = gn_xalloc(count, 9 * sizeof(float) + sizeof(int32_t) + 1);
    float *point = floats, *normal = point + 3 * count, *distance = normal + 3 * count;
    float *band = distance + count, *safe = band + count;
    int32_t *item = (int32_t *)(safe + count);
    uint8_t *lit = (uint8_t *)(item + count);
    for (size_t i = 0; i < count; i++) {
        double p[3] = {0};
        if (pixels[i].item >= 0)
            point_of(&frame->eye, (int)(i % w), (int)(i / w), pixels[i].distance_m, p);
        for (int k = 0; k < 3; k++) {
            point[3 * i + k] = (float)p[k];
            normal[3 * i + k] = pixels[i].normal_ws[k];
        }
        distance[i] = pixels[i].distance_m;
        band[i] = 2;
        safe[i] = 5;
        item[i] = pixels[i].item;
        lit[i] = pixels[i].lit != 0;
    }
    *truth = (struct gn_truth){.mask = {w, h, lit, item, point, normal, distance, band, safe},
                               .frame = *frame,
                               .memory = floats};
}

static struct gn_truth_opts filled(const struct gn_truth_opts *opts) {
    struct gn_truth_opts o = opts ? *opts : (struct gn_truth_opts){0};
    if (!o.width_px) o.width_px = 640;
    if (!o.height_px) o.height_px = 480;
    return o;
}

bool gn_truth_make(struct gn_truth *truth, const struct gn_scene *scene,
                   const struct gn_truth_opts *opts, struct gn_err *err) {
    struct gn_truth_opts o = filled(opts);
    struct pixel *pixels = gn_xalloc((size_t)o.width_px * o.height_px, sizeof *pixels);
    struct gn_truth_frame frame = {0};
    *truth = (struct gn_truth){0};
    bool ok = make(&frame, pixels, scene, &o, err);
    if (ok) unpack(truth, &frame, pixels);
    free(pixels);
    return ok;
}

static void cache_path(const struct gn_bytes *file, const struct gn_truth_opts *o, char *path,
                       size_t size) {
    uint64_t hash = gn_hash(GN_HASH_INIT, file->data, file->size);
    snprintf(path, size, "build/truth-cache/%016llx-%dx%d-%u-%u.v%d", (unsigned long long)hash,
             o->width_px, o->height_px, o->camera, o->light, VERSION);
}

static bool read_cache(struct gn_truth *truth, const char *path, const struct gn_truth_opts *o) {
    struct gn_bytes bytes;
    struct header header;
    size_t want = sizeof header + (size_t)o->width_px * o->height_px * sizeof(struct pixel);
    if (!gn_file_read(path, want, &bytes, NULL)) return false;
    bool ok = bytes.size == want;
    if (ok) memcpy(&header, bytes.data, sizeof header);
    ok = ok && !memcmp(header.magic, "gntruth", 8) && header.version == VERSION &&
         header.pixel_bytes == sizeof(struct pixel);
    if (ok) unpack(truth, &header.frame, (const struct pixel *)(bytes.data + sizeof header));
    truth->cached = ok;
    gn_bytes_finish(&bytes);
    return ok;
}

static void write_cache(const struct gn_truth_frame *frame, const struct pixel *pixels,
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
    struct gn_truth_opts o = filled(opts);
    struct gn_bytes file;
    char path[256];
    *truth = (struct gn_truth){0};
    if (!gn_file_read(scene_path, 0, &file, err)) return false;
    cache_path(&file, &o, path, sizeof path);
    gn_bytes_finish(&file);
    if (!o.no_cache && read_cache(truth, path, &o)) return true;

    struct gn_scene *scene = gn_scene_load(scene_path, NULL, NULL, err);
    if (!scene) return false;
    struct pixel *pixels = gn_xalloc((size_t)o.width_px * o.height_px, sizeof *pixels);
    struct gn_truth_frame frame = {0};
    bool ok = make(&frame, pixels, scene, &o, err) || gn_fail_prefix(err, "%s", scene_path);
    if (ok && !o.no_cache) write_cache(&frame, pixels, path);
    if (ok) unpack(truth, &frame, pixels);
    free(pixels);
    gn_scene_destroy(scene);
    return ok;
}

void gn_truth_finish(struct gn_truth *truth) {
    free(truth->memory);
    *truth = (struct gn_truth){0};
}

/* --- measures --- */

double gn_truth_texel(const struct gn_truth *truth, unsigned map_px) {
    return truth->frame.extent / map_px;
}

/* Of a texel on a surface that faces light and eye. */
static double texel_px(const struct gn_truth *truth, double texel, size_t i) {
    const float *f = &truth->mask.point_ws[3 * i];
    const struct gn_ray_lamp *lamp = &truth->frame.lamp;
    double p[3] = {f[0], f[1], f[2]};
    double size = lamp->type == GN_LIGHT_DIRECTIONAL ? texel : texel * lamp_depth(lamp, p);
    return size / gn_ray_eye_pixel_m(&truth->frame.eye, p);
}

double gn_truth_band(struct gn_truth *truth, unsigned map_px) {
    size_t count = (size_t)truth->mask.width_px * truth->mask.height_px, seen = 0;
    float *band = (float *)truth->mask.band_px; /* ours: the mask only looks at it */
    double texel = gn_truth_texel(truth, map_px), sum = 0;
    for (size_t i = 0; i < count; i++) {
        band[i] = 2;
        if (truth->mask.item[i] < 0) continue;
        band[i] = (float)fmax(2, 2 * texel_px(truth, texel, i));
        sum += band[i];
        seen++;
    }
    return seen ? sum / (double)seen : 2;
}

/* Cosine of the angle between the normal and the direction to the light. */
static double facing(const struct gn_truth *truth, size_t i) {
    const struct gn_ray_lamp *lamp = &truth->frame.lamp;
    double sum = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        double to = lamp->type == GN_LIGHT_DIRECTIONAL
                        ? -lamp->direction_ws[k]
                        : lamp->position_ws[k] - truth->mask.point_ws[3 * i + k];
        sum += to * truth->mask.normal_ws[3 * i + k];
        length += to * to;
    }
    return length > 0 ? sum / sqrt(length) : 0;
}

void gn_truth_safe(struct gn_truth *truth, unsigned map_px, double reach_texels) {
    size_t count = (size_t)truth->mask.width_px * truth->mask.height_px;
    float *safe = (float *)truth->mask.safe_px; /* as band_px */
    double texel = gn_truth_texel(truth, map_px);
    for (size_t i = 0; i < count; i++) {
        double n_l = truth->mask.item[i] < 0 ? 0 : facing(truth, i);
        safe[i] = INFINITY;
        if (n_l <= .25) continue;
        safe[i] = (float)fmax(5, reach_texels * texel_px(truth, texel, i) / n_l);
    }
}

static double apart(const float *a, const float *b) {
    return sqrt((double)(a[0] - b[0]) * (a[0] - b[0]) + (double)(a[1] - b[1]) * (a[1] - b[1]) +
                (double)(a[2] - b[2]) * (a[2] - b[2]));
}

/* Next to each other on the screen and, but for slant, in the world: within six pixels' size. */
static bool is_contact(const struct gn_truth *truth, int x, int y) {
    const struct gn_mask_truth *m = &truth->mask;
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    size_t i = (size_t)y * m->width_px + x;
    if (m->item[i] < 0 || m->lit[i] || facing(truth, i) <= 0) return false;
    const float *f = &m->point_ws[3 * i];
    double near = 6 * gn_ray_eye_pixel_m(&truth->frame.eye, (double[3]){f[0], f[1], f[2]});
    for (int n = 0; n < 4; n++) {
        int u = x + step[n][0], v = y + step[n][1];
        if (u < 0 || v < 0 || u >= m->width_px || v >= m->height_px) continue;
        size_t j = (size_t)v * m->width_px + u;
        if (m->item[j] >= 0 && facing(truth, j) < 0 && apart(f, &m->point_ws[3 * j]) < near)
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
        if (m->item[i] < 0 || m->lit[i] || facing(truth, i) <= 0) continue;
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
