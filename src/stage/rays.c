#include "stage/rays.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/thread.h"
#include "image/write.h"
#include "stage/occlusion.h"
#include "truth/cast.h"

static bool check_memory(const struct gn_stage *stage, const struct gn_plan *plan,
                         struct gn_err *err) {
    const struct gn_scene_limits limits =
        gn_scene_limits_or_default(&stage->settings->render.limits.all);
    const uint64_t triangles_mb = gn_raycast_bytes(stage->scene) >> 20,
                   pixels_mb = gn_plan_map_bytes(plan) >> 20;
    if (triangles_mb > limits.memory_mb)
        return gn_fail(err,
                       "truth: the triangles of this scene take %llu MB, over the limit "
                       "memory_mb=%llu: raise it by --limit",
                       (unsigned long long)triangles_mb, (unsigned long long)limits.memory_mb);
    if (pixels_mb > limits.maps_mb)
        return gn_fail(err,
                       "truth: the visibility of %u lights takes %llu MB, over the limit "
                       "maps_mb=%llu: raise it by --limit, or use a smaller --size",
                       plan->shadow_count, (unsigned long long)pixels_mb,
                       (unsigned long long)limits.maps_mb);
    return true;
}

/* The rasteriser may draw a pixel of an outline whose middle a ray just misses: it takes the value
 * beside it. */
static float beside(const float *seen, const struct gn_ray_eye *eye, int x, int y) {
    static const int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int i = 0; i < 4; i++) {
        const int u = x + steps[i][0], v = y + steps[i][1];
        if (u < 0 || v < 0 || u >= eye->width_px || v >= eye->height_px) continue;
        const float value = seen[(size_t)v * (size_t)eye->width_px + (size_t)u];
        if (value >= 0.0f) return value;
    }
    return 1.0f;
}

/* The lowest row first, as GL has it. */
static void lay_texture(const float *seen, const struct gn_ray_eye *eye, float *texture) {
    for (int y = 0; y < eye->height_px; y++)
        for (int x = 0; x < eye->width_px; x++) {
            const float value = seen[(size_t)y * (size_t)eye->width_px + (size_t)x];
            texture[(size_t)(eye->height_px - 1 - y) * (size_t)eye->width_px + (size_t)x] =
                value >= 0.0f ? value : beside(seen, eye, x, y);
        }
}

struct gn_rays {
    const struct gn_scene *scene;
    const struct gn_pose *pose;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamps[GN_ALL_SHADOWS_MAX];
    uint32_t slots[GN_ALL_SHADOWS_MAX], count; /* of the plan */
    float *seen[GN_ALL_SHADOWS_MAX];
    int samples;
    /* of a thread */
    struct gn_pose own_pose;
    pthread_t thread;
    bool started;
    atomic_bool cancel, done;
    atomic_uint permille;
};

static bool init_rays(struct gn_rays *rays, const struct gn_stage *stage,
                      const struct gn_view *view, const struct gn_plan *plan, struct gn_err *err) {
    const size_t pixels = (size_t)plan->width_px * plan->height_px;
    rays->scene = view->pose->scene;
    rays->pose = view->pose;
    rays->samples = stage->settings->run.samples;
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        if (plan->shadows[i].encoding == GN_ENCODING_SCREEN) rays->slots[rays->count++] = i;
    if (rays->count == 0) return true;
    if (!check_memory(stage, plan, err)) return false;
    for (uint32_t i = 0; i < rays->count; i++) {
        const uint32_t light = plan->shadows[rays->slots[i]].light;
        gn_ray_lamp_init(&rays->lamps[i], view->pose, light);
        rays->lamps[i].radius =
            (double)gn_frame_light_opts(view->builder, view->pose, &view->opts, light).radius;
        rays->seen[i] = gn_picture_alloc(pixels, sizeof *rays->seen[i], err);
        if (!rays->seen[i]) return false;
    }
    const int width_px = (int)plan->width_px, height_px = (int)plan->height_px;
    struct gn_framing framing;
    gn_frame_camera(view->pose, &view->opts.view, (float)width_px / (float)height_px, &framing);
    gn_ray_eye_look(&rays->eye, &framing, width_px, height_px);
    return true;
}

static void finish_rays(struct gn_rays *rays) {
    for (uint32_t i = 0; i < rays->count; i++) free(rays->seen[i]);
    if (rays->own_pose.scene) gn_pose_finish(&rays->own_pose);
}

static void cast(struct gn_rays *rays, void (*progress)(void *user, double share), void *user) {
    struct gn_raycast triangles;
    gn_raycast_init(&triangles, rays->scene, rays->pose, &rays->cancel);
    if (!atomic_load(&rays->cancel))
        gn_cast(&(struct gn_cast_opts){.rays = &triangles,
                                       .eye = &rays->eye,
                                       .lamps = rays->lamps,
                                       .lamp_count = rays->count,
                                       .samples = rays->samples,
                                       .progress = progress,
                                       .user = user,
                                       .cancel = &rays->cancel},
                rays->seen);
    gn_raycast_finish(&triangles);
}

static bool give(const struct gn_stage *stage, const struct gn_plan *plan,
                 const struct gn_rays *rays, struct gn_err *err) {
    const size_t pixels = (size_t)plan->width_px * plan->height_px;
    float *texture = gn_picture_alloc(pixels, sizeof *texture, err);
    for (uint32_t i = 0; texture && i < rays->count; i++) {
        lay_texture(rays->seen[i], &rays->eye, texture);
        gn_gl_give(stage->gl, plan, rays->slots[i], texture);
    }
    free(texture);
    return texture;
}

static bool cast_now(struct gn_stage *stage, const struct gn_plan *plan, struct gn_rays *rays,
                     struct gn_err *err) {
    const size_t pixels = (size_t)plan->width_px * plan->height_px;
    cast(rays, stage->truth.progress, stage->truth.user);
    if (!give(stage, plan, rays, err)) return false;
    for (size_t i = 0; i < pixels; i++)
        if (rays->seen[0][i] < 0.0f) rays->seen[0][i] = 1.0f; /* the background is lit */
    stage->truth.visibility = rays->seen[0];
    rays->seen[0] = NULL;
    return true;
}

/* The share of its sky that each pixel sees, in place of that of a light. */
static bool cast_occlusion(struct gn_stage *stage, const struct gn_view *view,
                           const struct gn_plan *plan, struct gn_err *err) {
    const int width_px = (int)plan->width_px, height_px = (int)plan->height_px;
    const size_t pixels = (size_t)plan->width_px * plan->height_px;
    const struct gn_sky sky = gn_stage_sky_of(&view->opts.environment);
    struct gn_framing framing;
    struct gn_ray_eye eye;
    struct gn_raycast seen;
    struct gn_occlusion occlusion;
    float *shares =
        check_memory(stage, plan, err) ? gn_picture_alloc(pixels, sizeof *shares, err) : NULL;
    if (!shares) return false;
    gn_frame_camera(view->pose, &view->opts.view, (float)width_px / (float)height_px, &framing);
    gn_ray_eye_look(&eye, &framing, width_px, height_px);
    gn_raycast_init(&seen, view->pose->scene, view->pose, NULL);
    gn_occlusion_init(&occlusion, view->pose->scene, &view->pose->at, &sky, NULL);
    gn_cast(&(struct gn_cast_opts){.rays = &seen,
                                   .eye = &eye,
                                   .occlusion = &occlusion,
                                   .pose = view->pose,
                                   .samples = stage->settings->run.samples,
                                   .progress = stage->truth.progress,
                                   .user = stage->truth.user},
            &shares);
    gn_occlusion_finish(&occlusion);
    gn_raycast_finish(&seen);
    for (size_t i = 0; i < pixels; i++)
        if (shares[i] < 0.0f) shares[i] = 1.0f; /* the background */
    stage->truth.visibility = shares;
    return true;
}

bool gn_stage_cast_sun(const struct gn_stage *stage, const struct gn_view *view,
                       const struct gn_plan *plan, const float (*to_ws)[3], uint32_t count,
                       float *out, struct gn_err *err) {
    struct gn_framing framing;
    struct gn_ray_eye eye;
    struct gn_raycast seen;
    if (!check_memory(stage, plan, err)) return false;
    struct gn_ray_lamp *lamps = gn_xalloc(count, sizeof *lamps);
    for (uint32_t i = 0; i < count; i++) {
        lamps[i] = (struct gn_ray_lamp){.type = GN_LIGHT_DIRECTIONAL, .range_m = INFINITY};
        for (int k = 0; k < 3; k++) lamps[i].direction_ws[k] = -(double)to_ws[i][k];
    }
    gn_frame_camera(view->pose, &view->opts.view, (float)plan->width_px / (float)plan->height_px,
                    &framing);
    gn_ray_eye_look(&eye, &framing, (int)plan->width_px, (int)plan->height_px);
    gn_raycast_init(&seen, view->pose->scene, view->pose, NULL);
    gn_cast(&(struct gn_cast_opts){.rays = &seen,
                                   .eye = &eye,
                                   .lamps = lamps,
                                   .lamp_count = count,
                                   .sums = true,
                                   .samples = 1,
                                   .progress = stage->truth.progress,
                                   .user = stage->truth.user},
            &out);
    gn_raycast_finish(&seen);
    free(lamps);
    return true;
}

bool gn_stage_cast(struct gn_stage *stage, const struct gn_view *view, const struct gn_plan *plan,
                   struct gn_err *err) {
    struct gn_rays rays = {.count = 0};
    if (view->rays) return give(stage, plan, view->rays, err);
    free(stage->truth.visibility);
    stage->truth.visibility = NULL;
    if (plan->aov == GN_AOV_OCCLUSION)
        return view->opts.shadow.any.technique != GN_TECHNIQUE_TRUTH ||
               cast_occlusion(stage, view, plan, err);
    bool ok = init_rays(&rays, stage, view, plan, err);
    if (ok && rays.count > 0) ok = cast_now(stage, plan, &rays, err);
    finish_rays(&rays);
    return ok;
}

/* ---- in a thread ---- */

static void note_progress(void *user, double share) {
    struct gn_rays *rays = user;
    atomic_store(&rays->permille, (unsigned)(1000.0 * share));
}

static void *cast_in_thread(void *user) {
    struct gn_rays *rays = user;
    gn_thread_lower_priority(); /* and that of those that it starts */
    cast(rays, note_progress, rays);
    atomic_store(&rays->done, true);
    return NULL;
}

static void copy_pose(struct gn_rays *rays, const struct gn_pose *pose) {
    gn_pose_init(&rays->own_pose, pose->scene, pose->at.clips);
    if (pose->at.over >= 0) gn_pose_choose_over(&rays->own_pose, pose->at.clips, pose->at.over);
    gn_pose_choose_variant(&rays->own_pose, pose->at.variant);
    rays->own_pose.at = pose->at;
    rays->own_pose.at.fade = 1; /* it has not kept what that fades from */
    gn_pose_step(&rays->own_pose, pose->at.time_ns);
    rays->pose = &rays->own_pose;
}

static bool start(struct gn_rays *rays, struct gn_err *err) {
    if (rays->count == 0) return gn_fail(err, "truth: no light casts a shadow here");
    const int error = pthread_create(&rays->thread, NULL, cast_in_thread, rays);
    rays->started = error == 0;
    return rays->started || gn_fail(err, "truth: no thread: %s", strerror(error));
}

struct gn_rays *gn_rays_begin(const struct gn_stage *stage, const struct gn_view *view,
                              const struct gn_plan *plan, struct gn_err *err) {
    struct gn_rays *rays = gn_xalloc(1, sizeof *rays);
    bool ok = init_rays(rays, stage, view, plan, err);
    if (ok) copy_pose(rays, view->pose);
    ok = ok && start(rays, err);
    if (ok) return rays;
    gn_rays_destroy(rays);
    return NULL;
}

double gn_rays_progress(const struct gn_rays *rays) {
    return atomic_load(&rays->permille) / 1000.0;
}

bool gn_rays_are_done(const struct gn_rays *rays) { return atomic_load(&rays->done); }

void gn_rays_destroy(struct gn_rays *rays) {
    if (!rays) return;
    atomic_store(&rays->cancel, true);
    if (rays->started) pthread_join(rays->thread, NULL);
    finish_rays(rays);
    free(rays);
}
