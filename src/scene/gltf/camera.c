/* Cameras, in the order of the nodes that have one. An invalid one is dropped with a warning. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>

#define NEAR_MOST_M 1e16f /* near times far must fit a float */

/* A required number. */
static float needed_float(struct gn_gltf *g, const struct gn_at *up, const char *key) {
    struct gn_at at = gn_at_any(up, key);
    if (!at.json) gn_gltf_fail(g, &at, "missing");
    return gn_at_float(g, up, key, 0);
}

/* As a clip changes it. */
static void fill_record(struct gn_gltf *g, int32_t index, struct gn_camera *camera) {
    struct gn_camera_record *r = gn_gltf_record(g, GN_THING_CAMERA, (size_t)index, &camera->record);
    if (!r) return;
    *r = (struct gn_camera_record){camera->yfov_rad, camera->aspect, camera->xmag_m,
                                   camera->ymag_m,   camera->near_m, camera->far_m};
}

static void add_camera(struct gn_gltf *g, const struct gn_at *at, int32_t index, uint32_t node) {
    struct gn_scene *scene = g->scene;
    struct gn_camera camera = {.node = node};
    struct gn_at perspective = gn_at_object(g, at, "perspective");
    struct gn_at orthographic = gn_at_object(g, at, "orthographic");
    const char *name = gn_at_name(g, at);
    gn_at_text(g, at, "type"); /* must be a string; the object that is there says the type */
    if (!perspective.json && !orthographic.json)
        gn_gltf_fail(g, at, "is neither perspective nor orthographic");
    bool in_range = false;
    if (perspective.json) {
        camera.yfov_rad = needed_float(g, &perspective, "yfov");
        camera.near_m = needed_float(g, &perspective, "znear");
        camera.far_m = gn_at_float(g, &perspective, "zfar", 0);
        camera.aspect = gn_at_float(g, &perspective, "aspectRatio", 0);
        if (!(camera.aspect >= 1e-3f && camera.aspect <= 1e3f)) camera.aspect = 0; /* none */
        in_range = camera.yfov_rad > 1e-3f && camera.yfov_rad < GLM_PIf - 1e-3f &&
                   camera.near_m > 0 && camera.near_m < NEAR_MOST_M;
    } else {
        camera.orthographic = true;
        camera.xmag_m = fabsf(needed_float(g, &orthographic, "xmag"));
        camera.ymag_m = fabsf(needed_float(g, &orthographic, "ymag"));
        camera.near_m = needed_float(g, &orthographic, "znear");
        camera.far_m = needed_float(g, &orthographic, "zfar");
        in_range = camera.xmag_m > 0 && camera.ymag_m > 0 && camera.near_m >= 0 &&
                   camera.near_m < NEAR_MOST_M && camera.far_m > 0;
    }
    bool deep = camera.far_m == 0 || camera.far_m > camera.near_m;
    if (g->failed) return;
    if (!in_range || !deep) {
        gn_gltf_warn(g, at, "invalid camera: %s; ignored",
                     deep ? "its field or near plane is out of range" : "zfar is not beyond znear");
        return;
    }
    camera.name = name && *name ? gn_gltf_strdup(g, name) : scene->nodes[node].name;
    fill_record(g, index, &camera);
    scene->cameras[scene->camera_count++] = camera;
}

bool gn_gltf_cameras(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), nodes = gn_at_array(g, &root, "nodes");
    struct gn_at definitions = gn_at_array(g, &root, "cameras");
    struct gn_scene *scene = g->scene;
    GN_NEW(g, g->memory.scene, scene->cameras, (uint64_t)scene->node_count + 1);
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++) {
        if (g->placed[i].bare) continue;
        struct gn_at node = gn_at_element(&nodes, g->placed[i].json);
        int32_t camera = gn_at_spare_ref(g, &node, "camera", gn_at_size(&definitions), "cameras");
        if (camera < 0 || g->failed) continue;
        struct gn_at definition = gn_at_element(&definitions, (size_t)camera);
        add_camera(g, &definition, camera, i);
        gn_gltf_spare(g, "ignored");
    }
    return !g->failed;
}
