#include "truth/sight.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "core/arena.h"

/* --- making --- */

struct job {
    const struct gn_raycast *rays;
    const struct gn_truth_frame *frame;
    struct gn_truth_pixel *pixels;
    atomic_int next_row;
};

static void *cast_rows(void *data) {
    struct job *job = data;
    const struct gn_ray_eye *eye = &job->frame->eye;
    for (int y; (y = atomic_fetch_add(&job->next_row, 1)) < eye->height_px;) {
        for (int x = 0; x < eye->width_px; x++) {
            struct gn_truth_pixel *pixel = &job->pixels[(size_t)y * eye->width_px + x];
            struct gn_ray_surface surface;
            *pixel = (struct gn_truth_pixel){.distance_m = INFINITY, .item = -1, .lit = 1};
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
                         const struct gn_truth_pixel *pixels) {
    const struct gn_ray_eye *eye = &frame->eye;
    if (frame->lamp.type == GN_LIGHT_POINT) return 2;
    struct window seen = empty, window = casters_window(rays, frame);
    for (int y = 0; y < eye->height_px; y++)
        for (int x = 0; x < eye->width_px; x++) {
            const struct gn_truth_pixel *pixel = &pixels[(size_t)y * eye->width_px + x];
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

bool gn_truth_cast(struct gn_truth_frame *frame, struct gn_truth_pixel *pixels,
                   const struct gn_scene *scene, const struct gn_truth_opts *opts,
                   struct gn_err *err) {
    if (opts->camera >= scene->camera_count || opts->light >= scene->light_count)
        return gn_fail(err, "has no camera %u or no light %u", opts->camera, opts->light);
    struct gn_pose first;
    const struct gn_pose *pose = opts->pose ? opts->pose : &first;
    if (!opts->pose) gn_pose_init(&first, scene, GN_POSE_DEFAULT);
    gn_ray_eye_init(&frame->eye, pose, opts->camera, opts->width_px, opts->height_px);
    gn_ray_lamp_init(&frame->lamp, pose, opts->light);
    plane_axes(frame);
    struct gn_raycast rays;
    gn_raycast_init(&rays, scene, pose, NULL);
    struct job job = {.rays = &rays, .frame = frame, .pixels = pixels};
    cast_all(&job, opts->threads);
    frame->extent = fit_extent(&rays, frame, pixels);
    gn_raycast_finish(&rays);
    if (!opts->pose) gn_pose_finish(&first);
    return true;
}

/* The arrays of the mask are all in one block. */
void gn_truth_unpack(struct gn_truth *truth, const struct gn_truth_frame *frame,
                     const struct gn_truth_pixel *pixels) {
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

struct gn_truth_opts gn_truth_fill(const struct gn_truth_opts *opts) {
    struct gn_truth_opts o = opts ? *opts : (struct gn_truth_opts){0};
    if (!o.width_px) o.width_px = 640;
    if (!o.height_px) o.height_px = 480;
    return o;
}

bool gn_truth_make(struct gn_truth *truth, const struct gn_scene *scene,
                   const struct gn_truth_opts *opts, struct gn_err *err) {
    struct gn_truth_opts o = gn_truth_fill(opts);
    struct gn_truth_pixel *pixels = gn_xalloc((size_t)o.width_px * o.height_px, sizeof *pixels);
    struct gn_truth_frame frame = {0};
    *truth = (struct gn_truth){0};
    bool ok = gn_truth_cast(&frame, pixels, scene, &o, err);
    if (ok) gn_truth_unpack(truth, &frame, pixels);
    free(pixels);
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

double gn_truth_texel_px(const struct gn_truth *truth, double texel, size_t i) {
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
        band[i] = (float)fmax(2, 2 * gn_truth_texel_px(truth, texel, i));
        sum += band[i];
        seen++;
    }
    return seen ? sum / (double)seen : 2;
}

double gn_truth_facing(const struct gn_truth *truth, size_t i) {
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
        double n_l = truth->mask.item[i] < 0 ? 0 : gn_truth_facing(truth, i);
        safe[i] = INFINITY;
        if (n_l <= .25) continue;
        safe[i] = (float)fmax(5, reach_texels * gn_truth_texel_px(truth, texel, i) / n_l);
    }
}
