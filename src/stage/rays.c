#include "stage/rays.h"

#include <stdlib.h>

#include "image/write.h"
#include "truth/cast.h"

static bool check_memory(const struct gn_stage *stage, const struct gn_plan *plan,
                         const struct gn_scene_limits *limits, struct gn_err *err) {
    const uint64_t triangles_mb = gn_raycast_bytes(stage->scene) >> 20,
                   pixels_mb = gn_plan_map_bytes(plan) >> 20;
    if (triangles_mb > limits->memory_mb)
        return gn_fail(err,
                       "truth: the triangles of this scene take %llu MB, over the limit "
                       "memory_mb=%llu: raise it by --limit",
                       (unsigned long long)triangles_mb, (unsigned long long)limits->memory_mb);
    if (pixels_mb > limits->maps_mb)
        return gn_fail(err,
                       "truth: the visibility of %u lights takes %llu MB, over the limit "
                       "maps_mb=%llu: raise it by --limit, or use a smaller --size",
                       plan->shadow_count, (unsigned long long)pixels_mb,
                       (unsigned long long)limits->maps_mb);
    return true;
}

static void init_eye(const struct gn_stage *stage, const struct gn_plan *plan,
                     struct gn_ray_eye *eye) {
    const struct gn_frame_view_opts *view = &stage->frame_opts.view;
    const struct gn_box *box = &stage->scene->box;
    double centre[3];
    for (int k = 0; k < 3; k++) centre[k] = .5 * ((double)box->min[k] + (double)box->max[k]);
    const int w = (int)plan->width_px, h = (int)plan->height_px;
    struct gn_framing_opts opts = view->framing;
    struct gn_framing framing;
    opts.aspect = (float)w / (float)h;
    if (view->light_plus_1 > 0) {
        gn_frame_light_camera(&stage->pose, view->light_plus_1 - 1, opts.aspect, &framing.camera,
                              framing.view_from_world, framing.eye_ws);
    } else {
        gn_framing_build(&stage->pose, (uint32_t)view->camera, &opts, &framing);
    }
    gn_ray_eye_look(eye, &framing, w, h);
    if (view->turntable_rad != 0.0f) gn_ray_eye_turn(eye, centre, (double)view->turntable_rad);
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

struct rays {
    uint32_t slots[GN_ALL_SHADOWS_MAX], count; /* of the plan */
    float *seen[GN_ALL_SHADOWS_MAX];
};

static void cast(struct gn_stage *stage, const struct gn_plan *plan, const struct gn_ray_eye *eye,
                 const struct rays *rays) {
    struct gn_raycast triangles;
    struct gn_ray_lamp lamps[GN_ALL_SHADOWS_MAX];
    gn_raycast_init(&triangles, stage->scene, &stage->pose);
    for (uint32_t i = 0; i < rays->count; i++) {
        const uint32_t light = plan->shadows[rays->slots[i]].light;
        const struct gn_frame_light_opts one = gn_frame_light_opts(&stage->frame_opts, light);
        gn_ray_lamp_init(&lamps[i], &stage->pose, light);
        if (one.given & GN_LIGHT_RADIUS) lamps[i].radius = (double)one.radius;
    }
    gn_cast(&(struct gn_cast_opts){.rays = &triangles,
                                   .eye = eye,
                                   .lamps = lamps,
                                   .lamp_count = rays->count,
                                   .samples = stage->settings->run.samples,
                                   .progress = stage->truth.progress,
                                   .user = stage->truth.user},
            rays->seen);
    gn_raycast_finish(&triangles);
}

bool gn_stage_cast(struct gn_stage *stage, const struct gn_plan *plan,
                   const struct gn_scene_limits *limits, struct gn_err *err) {
    struct rays rays = {.count = 0};
    const size_t pixels = (size_t)plan->width_px * plan->height_px;
    free(stage->truth.visibility);
    stage->truth.visibility = NULL;
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        if (plan->shadows[i].encoding == GN_ENCODING_SCREEN) rays.slots[rays.count++] = i;
    if (rays.count == 0) return true;
    if (!check_memory(stage, plan, limits, err)) return false;

    float *texture = gn_picture_alloc(pixels, sizeof *texture, err);
    bool ok = texture;
    for (uint32_t i = 0; ok && i < rays.count; i++)
        ok = (rays.seen[i] = gn_picture_alloc(pixels, sizeof *rays.seen[i], err)) != NULL;
    if (ok) {
        struct gn_ray_eye eye;
        init_eye(stage, plan, &eye);
        cast(stage, plan, &eye, &rays);
        for (uint32_t i = 0; i < rays.count; i++) {
            lay_texture(rays.seen[i], &eye, texture);
            gn_gl_give(stage->gl, plan, rays.slots[i], texture);
        }
        for (size_t i = 0; i < pixels; i++)
            if (rays.seen[0][i] < 0.0f) rays.seen[0][i] = 1.0f; /* the background is lit */
        stage->truth.visibility = rays.seen[0];
        rays.seen[0] = NULL;
    }
    for (uint32_t i = 0; i < rays.count; i++) free(rays.seen[i]);
    free(texture);
    return ok;
}
